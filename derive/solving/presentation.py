"""Write expressions as in a textbook: factored or term by term, squares completed, roots as one fraction."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from itertools import chain, permutations, product

from sympy import (
    Add,
    Dummy,
    Expr,
    Integer,
    Mul,
    Pow,
    Symbol,
    cancel,
    cos,
    expand,
    factor,
    factor_terms,
    sin,
    sqrt,
    together,
)
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR5, TR6, TR8

from derive.algebra.collect import by_terms, spread
from derive.algebra.expressions import explicit
from derive.algebra.length import length, shortest
from derive.algebra.lowest_terms import factored
from derive.algebra.tidy import tidied
from derive.steps.signs import sign_for_all

ZERO = Integer(0)
LARGEST = 2500  # greatest length of an expression that is multiplied out and factored


SHORT = 40  # greatest length of a value whose products of sines and cosines are written as sums


def presented(value: Expr, *, in_sums: bool = True) -> Expr:
    """The shortest of a few textbook forms of the value, such as factored or as separate terms.

    in_sums     whether products of sines and cosines may become sums
    """
    value = explicit(value)
    tidy = tidied(value)
    forms, size = [tidy], length(tidy)
    if size <= LARGEST:
        forms.append(spread(tidy))
        below = tidy.as_numer_denom()[1]
        if not any(f.is_Add for f in Mul.make_args(below)):
            forms.append(by_terms(tidy.expand()))
        if in_sums and size <= SHORT and not below.has(sin, cos) and not _turns_under_root(tidy):
            in_sum = tidied(TR8(tidy.expand()))
            forms += [] if _has_an_angle_and_its_double(in_sum) else [in_sum]
        if below.has(sin):
            forms.append(Add(*(tidied(without_sine_below(term)) for term in Add.make_args(value))))
    apart = shortest(forms)
    product = factored(tidy) if size <= LARGEST else tidy
    return product if length(product) < length(apart) else apart  # a^2 - b^2 is not factored


def _has_an_angle_and_its_double(value: Expr) -> bool:
    angles = {function.args[0] for function in value.atoms(sin, cos)}
    return any(2 * angle in angles for angle in angles)


def without_positive(value: Expr, *, in_equation: bool = False) -> Expr:
    """Drop the factors that are known to be positive, so that the sign of the value stays the same.

    in_equation     whether to drop numbers as well; the zeros stay the same, but the sign of the value may change
    """
    factors = (f for f in Mul.make_args(value) if not (in_equation and f.is_Rational and f.is_nonzero))
    return Mul(*(f for f in factors if sign_for_all(f) != 1))


def without_sine_below(value: Expr) -> Expr:
    """Remove sines from the denominator where this makes the value shorter: (1 - cos a)/(1 + cos a), not
    (1 - cos a)^2/sin^2 a."""
    before = factored(value)
    above, below = before.as_numer_denom()
    for sine in sorted(below.atoms(sin), key=str):
        c, mark = cos(sine.args[0]), Dummy("c", real=True)
        odd = sine if below.as_powers_dict()[sine] % 2 else Integer(1)
        ups, downs = (
            (part * odd).replace(partial(_is_power_of, sine), partial(_by_cosine, c)).xreplace({c: mark})
            for part in (above, below)
        )
        if not downs.has(sine):
            above, below = (part.xreplace({mark: c}) for part in cancel(ups / downs).as_numer_denom())
    return min((before, factored(above) / factored(below)), key=length)


def _is_power_of(sine: Expr, e: Expr) -> bool:
    return isinstance(e, Pow) and e.base == sine and e.exp.is_Integer and e.exp > 1


def _by_cosine(c: Expr, power: Expr) -> Expr:
    return (1 - c**2) ** (power.exp // 2) * power.base ** (power.exp % 2)


def _turns_under_root(value: Expr) -> bool:
    """Whether sines or cosines are under a root in the value; the squares under this root should stay visible."""
    roots = (power for power in value.atoms(Pow) if not power.exp.is_Integer)
    return any(root.base.has(sin, cos) for root in roots)


MOST_LETTERS = 4  # for more symbols, squares that include linear terms are not completed
LONGEST_SQUARED = 120  # greatest number of operations of a quadratic form in which squares are completed


def by_letters(value: Expr, letters: Sequence[Symbol]) -> Expr:
    """Write a polynomial of first or second degree in the symbols in a short form, such as completed squares. Any other
    expression is returned in its tidy form."""
    value = explicit(value)
    present = [p for p in letters if value.has(p)]
    if not present:
        return tidied(value)
    try:
        gathered = value.expand().as_poly(*present)
    except PolynomialError:
        gathered = None
    if gathered is None or gathered.total_degree() > 2:
        return tidied(value)
    parts: dict[int, list[tuple[Expr, Expr]]] = {}
    for powers, c in gathered.terms():
        parts.setdefault(sum(powers), []).append((Mul(*(p**n for p, n in zip(present, powers, strict=True))), c))
    quadratic = _written([(m, spread(c)) for m, c in parts.get(2, [])])
    linear = shortest([_added((m, spread(c)) for m, c in parts.get(1, [])), tidied(_added(parts.get(1, [])))])
    rest = tidied(Add(*(c for _, c in parts.get(0, []))))
    apart = Add(*(by_one_square(part) for part in (quadratic, linear, rest)))
    if not parts.get(1) or len(present) > MOST_LETTERS:
        return apart
    return shortest([apart, _squares(chain(*parts.values()), present)])  # (p - q A)^2, including terms linear in p


def by_one_square(value: Expr) -> Expr:
    """Write m_1 + m_2 sin^2 a, not m_1 + m_2 - m_2 cos^2 a, if this is shorter."""
    if not value.has(sin, cos):
        return value
    if value.is_Add:
        value = shortest([value, *(expand(square(value)) for square in (TR5, TR6))])
    if value.is_Add:
        return Add(*(by_one_square(term) for term in value.args))
    sign: Expr = Integer(1)
    factors: list[Expr] = []
    for part in Mul.make_args(value):
        if part.is_Mul:
            part = by_one_square(part)
        base, power = part.as_base_exp()
        if base.is_Add and power.is_Integer:
            base = shortest([base, *(factor_terms(expand(square(base))) for square in (TR5, TR6))])
            if power.is_negative and base.could_extract_minus_sign():
                base, sign = -base, sign * Integer(-1) ** power
        factors.append(base**power)
    return _without_minus(sign * Mul(*factors))


def _without_minus(value: Expr) -> Expr:
    """Write (b - a) c, not -(a - b) c."""
    number, rest = value.as_coeff_Mul()
    turned = next((f for f in Mul.make_args(rest) if f.is_Add and any(map(_is_taken_off, f.args))), None)
    if not number.is_negative or turned is None:
        return value
    return -number * Mul(-turned, *(f for f in Mul.make_args(rest) if f is not turned))


def _is_taken_off(term: Expr) -> bool:
    return bool(term.could_extract_minus_sign())


def _written(terms: Sequence[tuple[Expr, Expr]]) -> Expr:
    """A quadratic form, with squares completed if this is shorter."""
    mixed = {p for monomial, _ in terms if monomial.is_Mul for p in monomial.free_symbols}
    if not mixed:
        return _added(terms)
    together = [term for term in terms if term[0].free_symbols & mixed]
    coupled = _added(together)
    alone = _added(term for term in terms if not term[0].free_symbols & mixed)
    orders = permutations(sorted(mixed, key=str)) if len(mixed) <= 3 and coupled.count_ops() <= LONGEST_SQUARED else ()
    return alone + shortest([coupled, tidied(coupled), *(_squares(together, order) for order in orders)])


def _squares(terms: Iterable[tuple[Expr, Expr]], order: Sequence[Symbol]) -> Expr:
    """Complete the squares, a (p + b q/a)^2 + ..., one symbol after the other."""
    squares: list[Expr] = []
    rest = {_letters_in(monomial): c for monomial, c in terms}
    for p in order:
        a = tidied(rest.pop((p, p), ZERO))
        if a == 0:
            continue
        beside = {_without(p, letters): tidied(rest.pop(letters) / (2 * a)) for letters in list(rest) if p in letters}
        above, below = tidied(p + Add(*(Mul(*others, c) for others, c in beside.items()))).as_numer_denom()
        squares.append(spread(a / below**2) * above**2)
        for (one, b), (other, c) in product(beside.items(), repeat=2):
            letters = tuple(sorted(one + other, key=str))
            rest[letters] = rest.get(letters, ZERO) - a * b * c
        rest = {letters: tidied(c) for letters, c in rest.items()}
    return Add(*squares, tidied(Add(*(Mul(*letters, c) for letters, c in rest.items()))))


def _letters_in(monomial: Expr) -> tuple[Symbol, ...]:
    """The symbols of a monomial, repeated by their powers: (p, p) for p^2, (p, q) for p q."""
    powers = sorted(monomial.as_powers_dict().items(), key=str) if monomial != 1 else []
    return tuple(sorted((p for p, n in powers for _ in range(int(n))), key=str))


def _without(p: Symbol, letters: tuple[Symbol, ...]) -> tuple[Symbol, ...]:
    at = letters.index(p)
    return letters[:at] + letters[at + 1 :]


def _added(terms: Iterable[tuple[Expr, Expr]]) -> Expr:
    return Add(*(m * c for m, c in terms))


def as_one_root(value: Expr) -> Expr:
    """Write sqrt(k/m - b^2/(2 m^2)), not sqrt(2) sqrt(2 k m - b^2)/(2 m). A value of a different form is returned
    unchanged."""
    factors = Mul.make_args(value)
    outside = Mul(*(f for f in factors if not (f.is_Pow and f.base.is_Add)))
    sign, square = sign_for_all(outside), (value**2).expand()
    is_plain = all(f.is_Rational or not f.is_number for f in factors)
    return value if is_plain or outside == value or not sign or not square.is_Add else sign * sqrt(square)


def roots_together(value: Expr) -> Expr:
    """Write p c/sqrt(p^2 + m^2 c^2), not p/(m sqrt(1 + p^2/(m^2 c^2))).

    The terms under each root are combined into one fraction, unless this makes the expression longer.
    """

    def in_one(base: Expr, exponent: Expr) -> Expr:
        whole = together(roots_together(base))
        above, below = min((whole, cancel(whole)), key=length).as_numer_denom()
        above, below = (min((part, factor(part)), key=length) for part in (above, below))
        return Pow(above, exponent) / Pow(below, exponent)

    is_root = lambda e: isinstance(e, Pow) and e.exp.is_Rational and not e.exp.is_Integer  # noqa: E731
    if not value.has(Pow):
        return value
    rooted = value.replace(is_root, lambda e: in_one(e.base, e.exp))
    return min((tidied(rooted), rooted, value), key=length)
