"""Collect the terms of an energy or an equation of motion by products of rates, with coefficients in brackets."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from functools import lru_cache, partial
from itertools import permutations

from sympy import Abs, Add, Dummy, Expr, Integer, Mul, Pow, Rational, Symbol, cos, fraction, igcd, ilcm, sin
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.coefficients import Coefficient, Factored, Outside, coefficients
from derive.algebra.expressions import TIME, depends_on_time, rate
from derive.algebra.length import length
from derive.algebra.lowest_terms import factored
from derive.algebra.tidy import tidied

LONGEST_PRODUCT = 60  # greatest `length` of a value whose factored form is tried


def by_accelerations(value: Expr, moving: Sequence[Symbol]) -> Expr:
    return with_constants_in_front(by_rates(value, moving, 2), moving)


def with_constants_in_front(value: Expr, moving: Sequence[Symbol]) -> Expr:
    """Write the common factors of a sum in front of it: (2/5) m a^2 (phi_ddot + psi_ddot cos(theta)).

    The common factors are a number, constants, sines and cosines. A sum such as m l^2 theta_ddot + m g l sin(theta) is
    unchanged, because the common number and constants are not the whole coefficient of any term. A sum is also
    unchanged if its terms have no constant in common and all numerical coefficients are integers.
    """
    terms = Add.make_args(value)
    if len(terms) < 2:
        return value
    letters = {*(rate(q, n) for q in moving for n in range(3)), TIME}
    numbers = [term.as_coeff_Mul()[0] for term in terms]
    powers = [_powers(term) for term in terms]
    constants = [{b: n for b, n in each.items() if not b.free_symbols & letters} for each in powers]
    shared = _shared(constants)
    number = Rational(igcd(*(n.p for n in numbers)), ilcm(*(n.q for n in numbers)))
    if not any(abs(n) == number and each == shared for n, each in zip(numbers, constants, strict=True)):
        return value
    if not shared and all(n.q == 1 for n in numbers):
        return value
    shared |= {b: n for b, n in _shared(powers).items() if isinstance(b, sin | cos)}
    number = -number if all(n < 0 for n in numbers) else number
    common = Mul(number, *(b**n for b, n in shared.items()))
    return Mul(*Mul.make_args(common), Add(*(term / common for term in terms)), evaluate=False)


def _shared(powers: Sequence[dict[Expr, Expr]]) -> dict[Expr, Expr]:
    """The bases that occur in all terms, each with its least power. A base with a symbolic power is included only if
    its power is the same in all terms."""
    found = {base: {each[base] for each in powers} for base in powers[0] if all(base in each for each in powers)}
    return {base: min(of) for base, of in found.items() if len(of) == 1 or all(n.is_Rational for n in of)}


def _powers(product: Expr) -> dict[Expr, Expr]:
    """The bases of a product and their powers, without rational factors. A factor may be an unevaluated product, whose
    bases are also included."""
    found: dict[Expr, Expr] = {}
    for factor in Mul.make_args(product):
        inner = _powers(factor) if factor.is_Mul else {} if factor.is_Rational else dict([factor.as_base_exp()])
        for base, power in inner.items():
            found[base] = found.get(base, Integer(0)) + power
    return found


def by_rates(value: Expr, moving: Sequence[Symbol], highest: int = 1, halves: bool = False) -> Expr:
    """Collect the terms by the rates that they contain.

    highest   the highest order of the rates: 1 for velocities, 2 to include accelerations
    halves    whether a squared rate may have the coefficient (1/2)(...), as in a kinetic energy
    """
    if (directed := _by_directions(value)) is not None:
        plain, turning = directed
        return Add(*Add.make_args(by_rates(plain, moving, highest, halves)), *turning, evaluate=plain == 0)
    orders = [rate(q, n) for n in range(highest, 0, -1) for q in moving]
    rooted = [term for term in Add.make_args(value) if _has_root_of(term, moving)]
    if rooted and len(rooted) < len(Add.make_args(value)):
        gathered = by_rates(
            Add(*(term for term in Add.make_args(value) if term not in rooted)), moving, highest, halves
        )
        apart = [*Add.make_args(gathered), *_alike_together(map(tidied, rooted))]
        return Add(*(term for term in apart if term != 0), evaluate=False)
    present = [s for s in orders if value.has(s)]
    try:
        gathered = _gathered(value, present) if present else []
    except PolynomialError:
        gathered = []
    if not gathered:
        return _with_differences(_level(tidied(value.expand()), value, moving), moving)
    parts: list[Expr] = []
    for powers, c in gathered:
        part = _with_its_rates(c, [(s, n) for s, n in zip(present, powers, strict=True) if n], halves)
        part = part if any(powers) else _level(part, part, moving)
        # Terms without rates are not put in one bracket.
        level = Add.make_args(_with_differences(part, moving)) if not any(powers) else ()
        parts += [_with_short_sums(term, moving) for term in level] if not any(powers) else [part]
    parts = [part for part in parts if part != 0]  # a part such as sin^2 + cos^2 - 1 is zero
    return Add(*parts, evaluate=len(parts) < 2)


def _alike_together(terms: Iterable[Expr]) -> list[Expr]:
    numbers: dict[Expr, Expr] = {}
    for term in terms:
        number, rest = term.as_coeff_Mul()
        numbers[rest] = numbers.get(rest, Integer(0)) + number
    return [Mul(number, rest, evaluate=not rest.is_Add) for rest, number in numbers.items()]


def _by_directions(value: Expr) -> tuple[Expr, list[Expr]] | None:
    """Split a sum such as k u - k l u/|u| into the part without a direction u/|u| and the terms with a direction.

    Return None if the sum does not contain a direction, or if it is not a polynomial in its directions.

    With s = u/|u|, which is 1 or -1, |u| is s u and s^2 is 1, so only the first power of each s is left.
    """
    powers = {power for power in value.atoms(Pow) if isinstance(power.base, Abs) and power.exp.is_Integer}
    if not any(power.exp.is_negative for power in powers):
        return None
    ways = {size: Dummy("s", real=True) for size in sorted(value.atoms(Abs), key=str)}
    named: dict[Expr, Expr] = {size: s * size.args[0] for size, s in ways.items()}
    named |= {power: ways[power.base] ** (power.exp % 2) * power.base.args[0] ** power.exp for power in powers}
    polynomial = value.xreplace(named).expand().as_poly(*ways.values())
    if polynomial is None:
        return None
    found: dict[tuple[int, ...], Expr] = {}
    for exponents, coefficient in polynomial.terms():
        odd = tuple(n % 2 for n in exponents)
        found[odd] = found.get(odd, Integer(0)) + coefficient
    plain = found.pop((0,) * len(ways), Integer(0))
    turning = []
    for odd, coefficient in found.items():
        direction = Mul(*(size.args[0] / size for size, n in zip(ways, odd, strict=True) if n))
        turning += [Mul(front, direction)] if (front := tidied(coefficient)) != 0 else []
    return plain, turning


def _level(found: Expr, value: Expr, moving: Sequence[Symbol]) -> Expr:
    """Avoid a common denominator that contains a coordinate, but no sine or cosine: l^2/(m r^3) - G M m/r^2, not
    (l^2 - G M m^2 r)/(m r^3)."""
    below = found.as_numer_denom()[1]
    return by_terms(value.expand()) if below.has(*moving) and not below.has(sin, cos) else found


def _with_differences(value: Expr, moving: Collection[Symbol]) -> Expr:
    """Combine a coordinate with the constant from which it is measured, or with another coordinate.

    For example, k y - m g - k l becomes k (y - l) - m g, and k x + K x - K y becomes k x + K (x - y).
    """
    terms = list(Add.make_args(value))
    for q in moving:
        for term in [each for each in terms if each.has(q) and not _varies(each / q, moving)]:
            times = term / q
            constants = [each for each in terms if not _varies(each, moving) and (-each / times).is_Symbol]
            if len(constants) == 1:
                terms = [each for each in terms if each not in (term, constants[0])]
                terms.append(Mul(times, Add(q, constants[0] / times), evaluate=not times.is_number))
    measured = Add(*terms, evaluate=False) if len(terms) < len(Add.make_args(value)) else value
    return min((with_differences_of_coordinates(value, moving), measured), key=length)


def with_differences_of_coordinates(value: Expr, moving: Collection[Symbol]) -> Expr:
    """Combine pairs of terms into a multiple of the difference of two coordinates, m g x + k (x - y), if other terms
    are left and the result is not longer."""
    terms = list(Add.make_args(value.expand()))
    found: list[Expr] = []
    for p, q in permutations(moving, 2):
        for term in [each for each in terms if each.has(p) and not _varies(each / p, moving)]:
            times = term / p
            if not term.could_extract_minus_sign() and -times * q in terms:
                terms = [each for each in terms if each not in (term, -times * q)]
                found.append(Mul(*Mul.make_args(times), p - q, evaluate=False))
    apart = Add(*terms, *found, evaluate=False)
    return apart if terms and found and length(apart) <= length(value) else value


def _varies(term: Expr, moving: Collection[Symbol]) -> bool:
    return bool(term.has(*moving)) or depends_on_time(term)


def with_weights_in_front(value: Expr, moving: Sequence[Symbol], weights: Collection[Symbol]) -> Expr:
    """Write a kinetic energy with common factors in front of brackets: (1/2) m (r_dot^2 + r^2 phi_dot^2).

    The common number and constants of all terms are in front if one of the constants contains a mass or a moment of
    inertia, and if the numbers have a simple common factor. Otherwise, terms with the same numerical factor and the
    same constants share a bracket.
    """
    letters = {*moving, *(rate(q) for q in moving), TIME}
    terms = [_apart(term, letters) for term in Add.make_args(value)]
    if len(terms) < 2:
        return value
    shared = set.intersection(*(set(constants) for _, constants, _ in terms))
    number = _common_number([number for number, _, _ in terms])
    if number is not None and any(each.free_symbols & set(weights) for each in shared):
        rest = [Mul(n / number, *(c for c in constants if c not in shared), *others) for n, constants, others in terms]
        return Mul(number, *sorted(shared, key=str), Add(*rest), evaluate=False)
    groups: dict[tuple[Expr, ...], list[Expr]] = {}
    for n, constants, others in terms:
        groups.setdefault((n, *sorted(constants, key=str)), []).append(Mul(*others))
    parts: list[Expr] = []
    for front, others in groups.items():
        if len(others) > 1 and len(front) > 1:
            parts.append(Mul(*front, Add(*others), evaluate=False))
        else:
            parts += [Mul(*front, each) for each in others]
    return Add(*parts, evaluate=False) if len(parts) < len(terms) else value


def with_constants_together(value: Expr, moving: Collection[Symbol]) -> Expr:
    """Collect the terms with the same function of the coordinates: -2 (M + m) g l cos(theta)."""
    gathered: dict[Expr, list[Expr]] = {}
    for term in Add.make_args(value):
        number, constants, others = _apart(term, moving)
        gathered.setdefault(Mul(*others), []).append(number * Mul(*constants))
    return Add(*(tidied(Add(*constants)) * function for function, constants in gathered.items()))


def _with_short_sums(value: Expr, moving: Collection[Symbol]) -> Expr:
    """Collect constants in each factor that is a sum, if that is shorter: l ((M + m) g - m l omega^2 cos(theta))."""

    def together(sum_of: Expr) -> Expr:
        return min((sum_of, with_constants_together(sum_of, moving)), key=length)

    return Mul(*(together(f) if f.is_Add else f for f in Mul.make_args(value)))


def _apart(term: Expr, letters: Collection[Symbol]) -> tuple[Expr, list[Expr], list[Expr]]:
    number, constants, others = Integer(1), [], []
    for each in Mul.make_args(term):
        if each.is_Rational:
            number *= each
        elif each.free_symbols & set(letters):
            others.append(each)
        else:
            constants.append(each)
    return number, constants, others


def _common_number(numbers: Sequence[Expr]) -> Expr | None:
    """The common factor of the numbers: 1/2 for 1/2, 1 and 3/2. None if there is no simple common factor, as for 1/2
    and 3/4."""
    below = ilcm(*(n.q for n in numbers))
    if below > 2 and len({n.q for n in numbers}) > 1:
        return None
    return Rational(igcd(*(int(n * below) for n in numbers)), below)


def _gathered(value: Expr, letters: Sequence[Symbol]) -> list[tuple[tuple[int, ...], Coefficient]]:
    """The result of `coefficients`, or of SymPy if `coefficients` raises `Outside`; empty if the value is not a
    polynomial in these symbols."""
    try:
        return coefficients(value, letters)
    except Outside:
        polynomial = value.expand().as_poly(*letters)
        if polynomial is None:
            return []
        return [(n, Coefficient(partial(Add, c), len(Add.make_args(c.expand())))) for n, c in polynomial.terms()]


def _has_root_of(term: Expr, moving: Sequence[Symbol]) -> bool:
    """Whether the term contains a root with a coordinate, such as sqrt(a^2 + x^2)."""
    return any(root.base.has(*moving) for root in _roots_in(term))


@lru_cache(maxsize=4096)  # many factors occur in several terms of a sum
def _roots_in(expr: Expr) -> frozenset[Pow]:
    inside = frozenset(root for part in expr.args if part.args for root in _roots_in(part))
    is_root = isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer
    return inside | {expr} if is_root else inside


def by_products(value: Expr, moving: Sequence[Symbol]) -> Expr:
    """Collect the terms by rates and by products of the coordinates.

    A bracket with terms of both signs is preceded by a minus sign: I_x omega_x_dot - (I_y - I_z) omega_y omega_z.
    """
    rates = [rate(q, n) for n in (2, 1) for q in moving]
    present = [s for s in (*rates, *moving) if value.has(s)]
    try:
        gathered = value.expand().as_poly(*present) if present else None
    except PolynomialError:
        gathered = None
    if gathered is None:
        return by_rates(value, moving, 2)
    parts = []
    for powers, coefficient in gathered.terms():
        product = Mul(*(s**n for s, n in zip(present, powers, strict=True)))
        signs = {term.could_extract_minus_sign() for term in Add.make_args(coefficient)}
        parts.append(-Mul(-coefficient, product) if len(signs) == 2 else coefficient * product)
    return Add(*parts)


def _with_its_rates(coefficient: Coefficient, rates: list[tuple[Symbol, int]], halves: bool) -> Expr:
    return _with_one(_times_rates(coefficient, rates, halves))


def _with_one(product: Expr) -> Expr:
    """Divide the sum in the numerator of a product by the denominator of the product. Do this only if a term of the sum
    then has no symbol in its denominator, and if the result is not longer.

    For example, (p^2 + r^2) r_dot^2/p^2 becomes (1 + r^2/p^2) r_dot^2.
    """
    above, below = product.as_numer_denom()
    sums = [part for part in Mul.make_args(above) if part.is_Add]
    number, letters = below.as_coeff_Mul()
    if len(sums) != 1 or letters == 1 or below.has(Add):
        return product
    whole = [term for term in sums[0].args if fraction(term / letters)[1].is_Rational]
    if not whole:
        return product
    divisor = igcd(number, *(term.as_coeff_Mul()[0].p for term in whole)) * letters
    rest = Mul(*(part for part in Mul.make_args(above) if part is not sums[0]), divisor / below)
    return min((Mul(rest, Add(*(term / divisor for term in sums[0].args))), product), key=length)


def _times_rates(coefficient: Coefficient, rates: list[tuple[Symbol, int]], halves: bool) -> Expr:
    """Multiply a coefficient by powers of rates: (1/2)(I + M R^2/4) q_dot^2."""
    powers = [s**n for s, n in rates]
    if halves and any(n == 2 for _, n in rates) and coefficient.terms > 1:
        inside, whole = _spread(_tidied(coefficient, Integer(2)).value), _shortest(_tidied(coefficient, Integer(1)))
        if _has_fractions_inside(inside) or length(inside) > length(whole):  # (3/4) m (R - a)^2
            return Mul(whole, *powers)
        has_number = inside.is_Mul and not inside.args[0].is_Integer and inside.args[0].is_Rational
        written = not has_number and not inside.as_numer_denom()[1].free_symbols
        return Mul(Rational(1, 2), inside, *powers, evaluate=not written)
    found = _tidied(coefficient, Integer(1))
    spread_out = _spread(found.value)
    if _has_fractions_inside(spread_out):  # (3/20) m (1 + 5 cos^2 a), not 3 m (cos^2 a/4 + 1/20)
        spread_out = found.value
    return Mul(_shortest(Factored(spread_out, found.is_prime and spread_out == found.value)), *powers)


def _tidied(coefficient: Coefficient, times: Integer) -> Factored:
    if coefficient.written:
        number, turning = tidied(coefficient.angles).as_coeff_Mul()
        if not any(part.as_base_exp()[0].is_Add for part in Mul.make_args(turning)):
            return coefficient.written(times * number, turning)
    return Factored(tidied(times * coefficient.whole()), False)


def _shortest(found: Factored) -> Expr:
    return found.value if found.is_prime else _shorter_as_product(found.value)


def _has_fractions_inside(value: Expr) -> bool:
    """Whether the value is a product in which a sum has a numerical fraction as a term: m (cos^2 a/4 + 1/20)."""
    sums = [f for f in Mul.make_args(value) if f.is_Add] if value.is_Mul else []
    return any(term.is_Rational and not term.is_Integer for f in sums for term in f.args)


def _shorter_as_product(value: Expr) -> Expr:
    """The value or its factored form, whichever is shorter: (l + x)^2, not l^2 + 2 l x + x^2.

    A long value is left unchanged, because factoring it may take a long time.
    """
    return value if length(value) > LONGEST_PRODUCT else min((value, factored(value)), key=length)


def spread(value: Expr) -> Expr:
    """Move a numerical denominator into a sum if this leaves a term without a denominator: I + M a^2/4, not
    (4 I + M a^2)/4.

    The form a (3 g - 2 l omega^2)/6 is kept, because a (g/2 - l omega^2/3) is not simpler.
    """
    return _spread(tidied(value))


def _spread(value: Expr) -> Expr:
    number, letters = value.as_coeff_Mul()
    sums = [f for f in Mul.make_args(letters) if f.is_Add]
    if number.q == 1 or len(sums) != 1 or letters.as_numer_denom()[1].has(Add):
        return value
    terms = [term * Rational(1, number.q) for term in sums[0].args]
    if all(term.as_coeff_Mul()[0].q > 1 for term in terms):
        return value
    return Mul(number.p, *(f for f in Mul.make_args(letters) if f is not sums[0]), Add(*terms))


def by_terms(value: Expr) -> Expr:
    """Tidy each term of a sum, without a common denominator; factor the denominator of a term if that is shorter."""
    return Add(*(_shorter(tidied(term)) for term in Add.make_args(value)))


def _shorter(term: Expr) -> Expr:
    numerator, denominator = term.as_numer_denom()
    return min((term, numerator / factored(denominator)), key=length)


def spread_or_by_terms(value: Expr, *others: Expr) -> Expr:
    """Return one product or a sum of tidy terms, whichever is shorter; `others` are further forms of the value, whose
    tidy terms are also tried.

    If a sine or cosine remains in the denominator, return the tidy terms of the first form in `others`, or of the value
    if `others` is empty.
    """
    if tidied(value).as_numer_denom()[1].has(sin, cos):
        return by_terms(others[0] if others else value)
    forms = [spread(value), by_terms(value.expand()), *(by_terms(other) for other in others)]
    return min(forms, key=length)
