"""The tidy form of a result: one fraction, common factors in front, roots of numbers in the numerator.

`tidied()` simplifies a result as you would by hand, without changing its value. `derive.render.notation.notation`
decides how the result is displayed.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations
from typing import Any

from sympy import (
    Add,
    Expr,
    Function,
    ImmutableDenseMatrix,
    Integer,
    MatrixBase,
    Mul,
    Pow,
    Rational,
    Symbol,
    cos,
    cosh,
    expand,
    factor_list,
    fraction,
    radsimp,
    sin,
    sqrt,
    sqrtdenest,
    tan,
)
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR10i, bottom_up

from derive.algebra.coefficients import is_multiplied_out
from derive.algebra.expressions import PLUS_MINUS, Relation, explicit
from derive.algebra.factors_in_front import fraction_of, in_front, product_of
from derive.algebra.length import shortest
from derive.algebra.lowest_terms import Outside, in_lowest_terms, is_squarefree, shared_factor, squares_turned
from derive.algebra.normal_form import vanishes
from derive.algebra.ranges import without_abs
from derive.algebra.samples import is_zero_everywhere
from derive.algebra.squares import differences_of_squares


def tidied(value: Any) -> Any:
    """The explicit value in its tidy form; each entry of a matrix and each side of a relation is tidied."""
    value = without_abs(_signs_squared(explicit(value)))
    if isinstance(value, Relation):
        return Relation(tidied(value.left), value.operator, tidied(value.right))
    if isinstance(value, MatrixBase):
        return ImmutableDenseMatrix(value.applyfunc(tidied))
    tidy = _tidied_scalar(value)
    known = without_abs(tidy)
    return tidy if known == tidy else without_abs(_tidied_scalar(known))  # |sin a|/sin^2 a is 1/sin a where sin a > 0


def _signs_squared(value: Any) -> Any:
    if PLUS_MINUS not in value.free_symbols:
        return value
    powers = [p for p in value.atoms(Pow) if p.base == PLUS_MINUS and p.exp.is_Integer]
    return value.xreplace({p: PLUS_MINUS if p.exp % 2 else Integer(1) for p in powers}) if powers else value


@lru_cache(maxsize=4096, typed=True)
def _tidied_scalar(value: Expr) -> Expr:
    if value.is_Atom or value.is_number and not value.has(Pow):
        return value
    if (sum_of_angles := _by_addition_theorem(value)) is not None:
        return sum_of_angles
    if value.has(tan):
        value = value.replace(lambda e: isinstance(e, Add) and e.has(tan), _by_secant)
        return shortest([_in_tidy_form(each) for each in {value, _with_one_function(value)}])
    return _in_tidy_form(value)


def _with_one_function(value: Expr) -> Expr:
    """Write tan a as sin a/cos a if the value also contains sin a or cos a."""
    angles = {function.args[0] for function in value.atoms(sin, cos)}
    return value.xreplace({t: sin(t.args[0]) / cos(t.args[0]) for t in value.atoms(tan) if t.args[0] in angles})


def _in_tidy_form(value: Expr) -> Expr:
    if isinstance(value, Function):
        return value.func(*(_tidied_scalar(arg) for arg in value.args))
    if _has_roots(value):
        if value.atoms(Add) and is_zero_everywhere(value) is not False and vanishes(value):
            return Integer(0)
        value = _denested(_roots_drawn_out(_roots_in_the_numerator(_roots_drawn_out(value))))
        return _differences_in_front(shortest((in_front(value), in_front(_expanded_above(value)), *_by_squares(value))))
    of_one_angle = [value, *_by_half_angle(value)]
    fractions = map(_as_one_fraction, [*of_one_angle, *_by_one_angle(value)])
    return _differences_in_front(shortest([*fractions, *(form for each in of_one_angle for form in _by_squares(each))]))


def _differences_in_front(value: Expr) -> Expr:
    """Write v^2 + 2 g R cos a - 2 g R as v^2 - 2 g R (1 - cos a), in each sum of the value."""
    if not value.atoms(cos, cosh):
        return value
    return value.replace(lambda part: part.is_Add and len(part.args) > 2, _difference_in_front)


def _difference_in_front(total: Expr) -> Expr:
    for function in sorted(total.atoms(cos, cosh), key=str):
        for front in total.args:
            if front.free_symbols and not front.has(function) and -front * function in total.args:
                rest = [term for term in total.args if term not in (front, -front * function)]
                return Add(*rest, Mul(front, 1 - function))
    return total


def _by_addition_theorem(value: Expr) -> Expr | None:
    """Return cos(a -+ b) for cos a cos b +- sin a sin b, and sin(a +- b) for sin a cos b +- cos a sin b; else None."""
    terms = [_two_turning(term) for term in value.args] if value.is_Add and len(value.args) == 2 else []
    found = [term for term in terms if term is not None]
    if len(found) != 2:
        return None
    (sign, first), (other, second) = sorted(found, key=lambda term: term[1].keys() != {cos})
    alike = sign == other
    if first.keys() == {cos} and second.keys() == {sin} and first[cos] == second[sin]:
        a, b = sorted(first[cos], key=str)
        return sign * _of_two_letters(cos, a - b if alike else a + b)
    if first.keys() == second.keys() == {sin, cos} and first[sin] == second[cos] and first[cos] == second[sin]:
        (a,), (b,) = first[sin], first[cos]
        return sign * _of_two_letters(sin, a + b if alike else a - b)
    return None


def _by_secant(total: Expr) -> Expr:
    """Write 1 + tan^2 as 1/cos^2, also if both terms have a common factor."""
    for tangent in sorted(total.atoms(tan), key=str):
        found = total.as_poly(tangent)
        if found is None or found.degree() != 2 or found.nth(1) != 0 or found.nth(0).has(tan):
            continue
        if (found.nth(2) - found.nth(0)).expand() == 0:
            return found.nth(0) / cos(tangent.args[0]) ** 2
    return total


def _of_two_letters(function: type, angle: Expr) -> Expr:
    """The sine or cosine of a sum or difference of two symbols; it is unevaluated if the symbols are real."""
    if not all(letter.is_real for letter in angle.free_symbols):
        return function(angle)
    turned = angle.could_extract_minus_sign()
    found = function(-angle if turned else angle, evaluate=False)
    return -found if turned and function is sin else found


def _two_turning(term: Expr) -> tuple[int, dict[type, set[Symbol]]] | None:
    """The sign of a term, and the angles of its sines and of its cosines. The result is None unless the term is plus or
    minus a product of two sines or cosines of different symbols."""
    number, product = term.as_coeff_Mul()
    if abs(number) != 1 or len(product.args) != 2 or not product.is_Mul:
        return None
    found: dict[type, set[Symbol]] = {}
    for function in product.args:
        if not isinstance(function, sin | cos) or not function.args[0].is_Symbol:
            return None
        found.setdefault(type(function), set()).add(function.args[0])
    return (int(number), found) if len(set().union(*found.values())) == 2 else None


def _as_one_fraction(value: Expr) -> Expr:
    try:
        expanded = in_lowest_terms(value)
    except Outside:
        return in_front(value)
    return _with_term_in_common(expanded if is_multiplied_out(value) else shortest((expanded, in_front(value))))


def _with_term_in_common(value: Expr) -> Expr:
    """Write 2 g (2 u + a v)/(4 u + b w) as g (u + a v/2)/(u + b w/4), so that both sums contain the same term. If all
    terms of the denominator are single symbols, with or without a number, the value is unchanged."""
    above, below = fraction(value) if value.is_Mul else (value, Integer(1))
    number, factors = above.as_coeff_Mul()
    sums = [part for part in Mul.make_args(factors) if part.is_Add]
    if not (number.is_Integer and number > 1 and len(sums) == 1 and below.is_Add):
        return value
    coefficients = {term: each for each, term in (part.as_coeff_Mul() for part in below.args)}
    if all(term.is_Symbol for term in coefficients):
        return value
    for each, term in (part.as_coeff_Mul() for part in sums[0].args):
        if each > 1 and coefficients.get(term) == number * each:
            upper, lower = (
                Add(*(part / by for part in of.args)) for of, by in ((sums[0], each), (below, number * each))
            )
            return Mul(*(part for part in Mul.make_args(factors) if part != sums[0]), upper, Pow(lower, -1))
    return value


def _by_squares(value: Expr) -> list[Expr]:
    try:
        return squares_turned(value) if value.atoms(sin, cos) else []
    except Outside:
        return []


def _by_one_angle(value: Expr) -> list[Expr]:
    """Write cos a cos b + sin a sin b as cos(a - b), and similar sums."""
    angles = {function.args[0] for function in value.atoms(sin, cos)}
    if len(angles) < 2 or not value.atoms(sin):
        return []
    spread_out = expand(value)
    found = bottom_up(spread_out, lambda part: _turned_together(part) if part.is_Add else part)
    return [found] if found != spread_out else []


def _by_half_angle(value: Expr) -> list[Expr]:
    """Write sin(2 a) as 2 sin a cos a if the value also contains sin a or cos a, because these may be common
    factors."""
    angles = {function.args[0] for function in value.atoms(sin, cos)}
    doubled = [turn for turn in value.atoms(sin) if turn.args[0] / 2 in angles]
    halves = {turn: 2 * sin(turn.args[0] / 2) * cos(turn.args[0] / 2) for turn in doubled}
    return [value.xreplace(halves)] if halves else []


def _turned_together(total: Expr) -> Expr:
    """Combine pairs of terms, c cos a cos b and c sin a sin b, or c sin a cos b and c cos a sin b, into one term."""
    seen: dict[Any, set[int]] = {}
    for n, term in enumerate(total.args):
        number, product = term.as_coeff_Mul()
        turning = [factor.as_base_exp()[0] for factor in Mul.make_args(product)]
        for one, other in combinations([f for f in turning if isinstance(f, sin | cos)], 2):
            if one.args != other.args:
                key = abs(number), product / (one * other), frozenset((one.args, other.args)), one.func == other.func
                seen.setdefault(key, set()).add(n)
    paired = set().union(*(terms for terms in seen.values() if len(terms) > 1))
    if not paired:
        return total
    apart = [term for n, term in enumerate(total.args) if n not in paired]
    return Add(TR10i(Add(*(total.args[n] for n in sorted(paired)))), *apart)


def _has_roots(value: Expr) -> bool:
    return any(power.exp.is_Rational and not power.exp.is_Integer for power in value.atoms(Pow))


def _denested(value: Expr) -> Expr:
    """Simplify a numerical factor with nested roots by taking the root of its square: (8 sqrt(2) - 11) sqrt(146 + 103
    sqrt(2))/14 becomes sqrt(2 - sqrt(2))/2."""
    number, letters = value.as_independent(*value.free_symbols, as_Add=False) if value.free_symbols else (value, 1)
    nested = [f for f in Mul.make_args(number) if f.is_Pow and f.exp.is_Rational and f.base.atoms(Pow)]
    if not nested or number.is_Add or any(abs(f.exp) != Rational(1, 2) for f in nested):
        return value
    square = radsimp(expand(number**2)).expand()
    if not square.is_real or not square.is_positive or len(Add.make_args(square)) > 2:
        return value
    content, rest = square.primitive()
    found = sqrt(content) * sqrtdenest(sqrt(rest))
    found = found if number.is_positive else -found
    return shortest((value, found * letters))


def _roots_in_the_numerator(value: Expr) -> Expr:
    """Write 1/(1 + sqrt(2)) as sqrt(2) - 1. A root of symbols stays in the denominator."""
    numerator, denominator = fraction_of(product_of(value))
    value = numerator / denominator
    if denominator.is_number or not denominator.has(Pow):
        return radsimp(value) if len(Add.make_args(denominator)) <= 4 else value
    above, below = (part.as_independent(*part.free_symbols, as_Add=False) for part in (numerator, denominator))
    return radsimp(above[0] / below[0]) * above[1] / below[1]


def _expanded_above(value: Expr) -> Expr:
    numerator, denominator = fraction_of(product_of(value))
    return expand(numerator) / denominator


def _roots_drawn_out(value: Expr) -> Expr:
    """Take powers of factors out of each root, as far as the signs allow it: sqrt(397 M^2 a^4/14) = M a^2 sqrt(397/14).

    The square root of the square of a real factor of unknown sign is its absolute value.
    """
    return value.replace(lambda e: isinstance(e, Pow) and e.exp.is_Rational and not e.exp.is_Integer, _drawn_out)


@lru_cache(maxsize=1024)  # several values have the same radicands
def _drawn_out(power: Pow) -> Expr:
    base = shortest((power.base, *_by_squares(power.base)))
    parts = fraction_of(product_of(base))
    (outside, inside), (below, under) = (_square_free(part, power.exp.q) for part in parts)
    root = Rational(1, power.exp.q)
    return (outside / below) ** power.exp.p * Pow(inside / under, root) ** power.exp.p


def _square_free(part: Expr, q: int) -> tuple[Expr, Expr]:
    """A polynomial as (outside, inside) with part = outside^q * inside, where outside is known to be non-negative."""
    outside, inside = Integer(1), Integer(1)
    for piece in Mul.make_args(part):
        out, kept = _square_free_factor(piece, q)
        outside, inside = outside * out, inside * kept
    return outside, inside


def _square_free_factor(part: Expr, q: int) -> tuple[Expr, Expr]:
    if part.is_number:
        return Integer(1), part
    try:
        if is_squarefree(part):
            return Integer(1), part
        content, factors = factor_list(part)
    except (Outside, PolynomialError):
        return Integer(1), part
    outside, inside = Integer(1), content
    for base, power in factors:
        is_size = q == 2 and power % 2 == 0 and base.is_real and not base.is_nonnegative
        whole = power // q if base.is_nonnegative or is_size else 0
        outside *= (abs(base) if is_size else base) ** whole
        inside *= base ** (power - q * whole)
    # A sum from which no factor was taken is kept as written, not multiplied out.
    return (outside, part) if outside == 1 else (outside, inside)


def common_factor(entries: list[Expr]) -> Expr:
    """The common factor of the entries of a vector or tensor: M a^2/12 of M a^2 diag(13, 10, 5)/12."""
    present = [entry for entry in entries if entry != 0]
    if not present:
        return Integer(1)
    number, powers = shared_factor(present)
    if len(present) > 1 and all(map(_leads_negative, present)):
        number = -number
    top = differences_of_squares(Mul(*(base**power for base, power in powers.items() if power > 0)))
    return number * top * Mul(*(base**power for base, power in powers.items() if power < 0))


def _leads_negative(entry: Expr) -> bool:
    return bool(entry.could_extract_minus_sign())


def factored_matrix(matrix: Any) -> tuple[Expr, Any]:
    """A matrix as (common factor, remaining matrix)."""
    common = common_factor(list(matrix))
    return common, ImmutableDenseMatrix(matrix.applyfunc(lambda e: tidied(e / common)))


def size_and_rest(v: Any) -> tuple[Expr, Any]:
    """A vector as (absolute value of its common factor, remaining vector). The magnitude of the vector is this absolute
    value times the magnitude of the remaining vector."""
    common, rest = factored_matrix(v)
    if common.is_nonnegative:
        return common, rest
    return (-common if common.is_nonpositive else abs(common)), rest
