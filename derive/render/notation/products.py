"""The printed form of a product or sum: its sign, and the order of numerical factors, symbols and terms."""

from __future__ import annotations

import re
from collections.abc import Iterable
from enum import IntEnum, auto
from typing import Any

from sympy import Add, Expr, Integer, MatrixBase, Mul, Pow, Rational, cos, factorint, fraction, gcd, ilcm, sin, tan

from derive.algebra import expressions as ex
from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import scaled
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.tidy import factored_matrix
from derive.render.notation.layout import (
    DOT,
    EITHER_SIGN,
    MINUS,
    THIN_SPACE,
    TIMES,
    Applied,
    Array,
    Digits,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Name,
    Operator,
    Raised,
    Row,
    Upright,
    begins_with_number,
    ends_in_differential,
    first_of,
    is_differential,
    is_enclosed,
    is_number,
    last_of,
    row,
)


def decimal(number: Rational, point: str = ".") -> Layout:
    """Return a number in decimals: 1.5, not 3/2, or 2.657*10^-26; 1/3 remains a fraction."""
    sign = (MINUS,) if number < 0 else ()
    places = _places(number.q)
    if places is None:
        return row(*sign, Fraction(Digits(str(abs(number.p))), Digits(str(number.q))))
    power, front = _power_of_ten(abs(number))
    digits = Digits(_point_before(_places(front.q) or 0, front).replace(".", point))
    return row(*sign, digits, TIMES, times_ten_to(power)) if power else row(*sign, digits)


def _places(denominator: int) -> int | None:
    found = {}
    for prime in (2, 5):
        found[prime] = 0
        while denominator % prime == 0:
            denominator, found[prime] = denominator // prime, found[prime] + 1
    return max(found.values()) if denominator == 1 else None


def _point_before(places: int, number: Rational) -> str:
    digits = str(number.p * 10**places // number.q).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}" if places else digits


def unit_behind_number(name: str) -> Layout:
    """Return the unit as it is printed after a number: 1/s^2 as `s^-2`, because the 1 could be read as a factor."""
    only_below = re.fullmatch(r"1/([A-Za-z]+)(?:\^(\d+))?", name)
    return Upright(f"{only_below[1]}^-{only_below[2] or 1}" if only_below else name)


def rounded_number(text: str, point: str = ".") -> Layout:
    """Return a rounded number such as -1.50 or 2.66*10^-26 with all its digits, including final zeros."""
    digits, _, power = text.lstrip("-").partition("e")
    sign = [MINUS] if text.startswith("-") else []
    return row(*sign, Digits(digits.replace(".", point)), *([TIMES, times_ten_to(int(power))] if power else []))


def _power_of_ten(number: Rational) -> tuple[int, Rational]:
    """Split a very small or a large round number into a power of ten and a factor from 1 to 10. For any other number,
    the power is 0."""
    power = 0
    while number and number * Integer(10) ** -power < 1:
        power -= 1
    while number * Integer(10) ** -power >= 10:
        power += 1
    front = number * Integer(10) ** -power
    is_round = number.q == 1 and number.p % 10 ** max(power + 1 - max(4, power // 2), 0) == 0
    return (power, front) if power < -4 or power > 6 and is_round else (0, number)


def times_ten_to(power: int) -> Layout:
    return Raised(Digits("10"), row(MINUS, Digits(str(-power))) if power < 0 else Digits(str(power)))


def present(value: Any) -> Any:
    """Return a vector or tensor with its common factor in front, and a scalar with tangents in place of quotients of
    sine and cosine."""
    if not isinstance(value, MatrixBase):
        return with_tangents(value) if isinstance(value, Expr) else value
    if all(entry == 0 for entry in value):
        return value
    if value.free_symbols and all(entry.is_Symbol or entry == 0 for entry in value):
        return value
    factor, rest = factored_matrix(value)
    return value if factor == 1 else scaled(factor, rest)


def with_tangents(value: Expr) -> Expr:
    """Write tan a for sin a/cos a, and the same for equal powers; cos a/sin a is unchanged, because it is defined at
    90 degrees."""
    if not value.has(sin) or not value.has(cos):
        return value
    return value.replace(lambda part: bool(part.is_Mul), _with_tangent)


def _with_tangent(product: Expr) -> Expr:
    powers = dict(each.as_base_exp() for each in product.args)
    for base, power in powers.items():
        below = cos(base.args[0]) if isinstance(base, sin) else None
        if below in powers and powers[below] == -power and power.is_positive:
            kept = (each for each in product.args if each.as_base_exp()[0] not in (base, below))
            product = Mul(*kept, tan(base.args[0]) ** power)
    return product


def sign_and_size(term: Any) -> tuple[Operator | None, Any]:
    """Return the sign printed before a scalar, if any, and the scalar without this sign."""
    if not isinstance(term, Expr) or ex.is_matrix(term):
        return None, term
    as_written = isinstance(term, ex.Factors)
    factors = list(term.args if as_written else Mul.make_args(term))
    if ex.PLUS_MINUS in factors:
        factors.remove(ex.PLUS_MINUS)
        return EITHER_SIGN, ex.Factors(*factors) if as_written and len(factors) > 1 else Mul(*factors)
    if as_written and len(factors) > 1 and factors[0] == -1:
        return MINUS, ex.Factors(*factors[1:]) if len(factors) > 2 else factors[1]
    negative = (term.is_Mul or term.is_Rational) and term.as_coeff_Mul()[0].is_negative
    return (MINUS, -term) if negative else (None, term)


def roots_last(terms: list[Any]) -> list[Any]:
    """If any term has a unit, put terms with roots of sums last. Then the sum has the same order with numbers as with
    symbols.
    """

    def is_root(term: Any) -> bool:
        return any(isinstance(f, Pow) and f.exp == Rational(1, 2) and f.base.is_Add for f in Mul.make_args(term))

    return sorted(terms, key=is_root) if any(term.has(ex.Amount) for term in terms) else terms


def positive_first(terms: list[Any]) -> list[Any]:
    """If the first term is negative, put the positive terms before the others: b + c - a, not -a + b + c. A term with
    both signs is not moved: -beta +- i omega."""
    if not terms or sign_and_size(terms[0])[0] is not MINUS:
        return terms
    others = [term for term in terms if ex.PLUS_MINUS not in term.free_symbols]
    positive = [term for term in others if sign_and_size(term)[0] is not MINUS]
    return [*positive, *(term for term in terms if term not in positive)]


def number_and_letters(expr: Expr) -> tuple[list[Expr], list[Expr]]:
    """Return two lists: the numerical factors (13, sqrt(14), pi) and the other factors; a factor of 1 is omitted."""
    factors = [f for factor in Mul.make_args(expr) for f in with_content_apart(factor) if f != 1]
    numbers = [f for f in factors if f.is_number and not f.has(ex.Amount)]
    rational = Mul(*(f for f in numbers if f.is_Rational))
    numbers = [*([rational] if rational != 1 else []), *(f for f in numbers if not f.is_Rational)]
    numbers.sort(key=lambda f: (0 if f.is_Rational else 1, str(f)))
    return numbers, [f for f in factors if not f.is_number or f.has(ex.Amount)]


def root_cancelled(above: list[Expr], below: list[Expr]) -> tuple[list[Expr], list[Expr]]:
    """Write sqrt(14)/14 as 1/sqrt(14), sqrt(14)/7 as 2/sqrt(14), sqrt(14)/168 as 1/(12 sqrt(14))."""
    if len(below) != 1 or not below[0].is_Integer:
        return above, below
    root = next((f for f in above if isinstance(f, Pow) and f.exp == Rational(1, 2) and f.base.is_Integer), None)
    if root is None:
        return above, below
    times = next((f for f in above if f.is_Integer), Rational(1))
    left = times * root.base / below[0]
    if left.p != times and not (left.q == 1 and times == 1):
        return above, below
    others = [f for f in above if f is not root and not f.is_Integer]
    return [*([Rational(left.p)] if left.p != 1 else []), *others], [*([Rational(left.q)] if left.q != 1 else []), root]


def under_one_root(number: Expr) -> list[Expr]:
    """Write 7 sqrt(2779)/397 as the factors 7 and sqrt(7/397). Return no factors if this form is neither shorter nor
    simpler."""
    square = number**2
    if number.is_Rational or not square.is_Rational or square.q == 1 or square < 0:
        return []
    times = Rational(*(Mul(*(Integer(p) ** (n // 2) for p, n in factorint(n).items())) for n in (square.p, square.q)))
    inside = square / times**2
    above, below = root_cancelled(*(number_and_letters(part)[0] for part in fraction(number)))
    saved = _digits(*above, *below) - _digits(times, inside)
    if 1 in (inside.p, inside.q) or saved < 0 or saved == 0 and times.q > 1:
        return []
    return [*([times] if times != 1 else []), ex.Root(inside)]


def _digits(*numbers: Expr) -> int:
    fractions = [number**2 if number.is_Pow else number for number in numbers]
    return sum(len(str(n)) for number in fractions for n in (number.p, number.q) if n != 1)


def with_content_apart(factor: Expr) -> tuple[Expr, ...]:
    """Split 12 a^2 + 12 b^2 into 12 and a^2 + b^2; a sum with fractions is unchanged."""
    if not isinstance(factor, Add):
        return (factor,)
    content, rest = factor.primitive()
    return (content, rest) if content.is_Integer else (factor,)


def gathered(expr: Expr) -> Expr:
    """Combine powers of each symbol, then write roots under one sign."""
    return roots_together(higher_roots_together(powers_together(expr)))


def roots_together(expr: Expr) -> Expr:
    """Combine square roots: sqrt(M) sqrt(g)/sqrt(I + M a^2) as the root of a fraction, 1/(sqrt(L) sqrt(C)) as
    1/sqrt(L C), and l^(3/2) sqrt(g) as l sqrt(g l).

    A single root is unchanged.
    """
    factors = Mul.make_args(expr)
    if any(isinstance(f, Pow) and f.exp == Rational(1, 2) for f in factors):
        factors = tuple(part for f in factors for part in _with_plain_root(f))
    roots = [f for f in factors if isinstance(f, Pow) and (abs(f.exp) == Rational(1, 2) or _is_fourth_root(f))]
    if len(roots) < 2 or not any(root.free_symbols or root.has(ex.Amount) for root in roots):
        return expr
    sign = -1 if all(root.exp < 0 for root in roots) else 1
    squares = (Mul.make_args(Pow(root.base, 2 * sign * root.exp)) for root in roots)
    inside = Mul(*sorted((f for square in squares for f in square), key=lambda f: f != -1), evaluate=False)
    others = Mul(*(f for f in factors if f not in roots))
    if sign < 0:
        return Mul(others, Pow(ex.Root(inside), -1))
    times, under = _below_under_root(others.as_coeff_Mul()[0], inside.as_coeff_Mul()[0])
    if times != 1 and (not inside.has(Add) or fraction(inside)[1] != 1):
        others, inside = others / times, Mul(under, *(f for f in inside.args if not f.is_Rational), evaluate=False)
    return Mul(others, ex.Root(inside))


def _with_plain_root(factor: Expr) -> tuple[Expr, ...]:
    """Split l^(3/2) into l and sqrt(l)."""
    base, power = factor.as_base_exp()
    if not (power.is_Rational and power.q == 2 and power > 1):
        return (factor,)
    return Pow(base, Integer(power)), Pow(base, Rational(1, 2))


def _below_under_root(number: Rational, inside: Rational) -> tuple[Rational, Rational]:
    """Return the factor in front of a root that can be moved inside it, and the new number under the root. These
    two numbers are 1/3 and 2/3 for sqrt(6)/3 = sqrt(2/3), and 1/2 and 1/2 for sqrt(2)/2 = sqrt(1/2)."""
    shared = gcd(number.q, inside.p) if inside.q == 1 else Rational(1)
    return Rational(1, shared), inside / shared**2


def higher_roots_together(expr: Expr) -> Expr:
    """Write J^(2/3)/(M^(1/3) g^(1/3)) as (J^2/(M g))^(1/3), and M^(4/3) g^(1/3) as M (M g)^(1/3)."""
    factors = Mul.make_args(expr)
    roots = [f for f in factors if isinstance(f, Pow) and f.exp.is_Rational and not f.exp.is_Integer]
    if len(roots) < 2 or not any(root.free_symbols and root.exp.q > 2 for root in roots):
        return expr
    index = ilcm(*(root.exp.q for root in roots))
    square = [root for root in roots if abs(root.exp) == Rational(1, 2)]
    if index == 4 and square and all(root in square or _is_fourth_root(root) for root in roots):
        return expr
    wholes = [int(root.exp) if root.exp > 0 else 0 for root in roots]
    inside = [Pow(root.base, index * (root.exp - n)) for root, n in zip(roots, wholes, strict=True)]
    outside = [Pow(root.base, n) for root, n in zip(roots, wholes, strict=True)]
    return Mul(*(f for f in factors if f not in roots), *outside, ex.Root(Mul(*inside), Integer(index)))


def powers_together(expr: Expr) -> Expr:
    """Combine powers of one symbol if an exponent contains a symbol: r^(n - 1), not r^n/r."""
    factors = Mul.make_args(expr)
    open_bases = {f.base for f in factors if isinstance(f, Pow) and f.exp.free_symbols}
    shared = {b for b in open_bases if sum(f.as_base_exp()[0] == b for f in factors) > 1}
    others = [f for f in factors if f.as_base_exp()[0] not in shared]
    exponents = {b: Add(*(p for base, p in (f.as_base_exp() for f in factors) if base == b)) for b in shared}
    return Mul(*others, *(Pow(b, n) for b, n in exponents.items())) if shared else expr


def _is_fourth_root(factor: Pow) -> bool:
    """Return whether the factor is the fourth root of an integer or of a sum, or a power of this root."""
    return bool((factor.base.is_Integer or factor.base.is_Add) and factor.exp.is_Rational and factor.exp.q == 4)


FORCE = dimension_of_kind("force")


class Place(IntEnum):
    """The places of factors in a product, in the order of print."""

    COEFFICIENT = auto()  # a coefficient of friction or of restitution: mu N, mu m g
    PER_MASS = auto()  # the gravitational constant comes before the masses
    MASS = auto()  # also a moment of inertia, a spring constant, a charge
    SUM_OF_MASSES = auto()
    COUPLING = auto()  # an energy, an angular momentum, a constant of a force law
    ACCELERATION = auto()  # also an electric or magnetic field, so that it is printed after the charge: q E
    LENGTH = auto()
    SPEED = auto()  # b v_0^2
    SUM = auto()
    OTHER = auto()  # numbers, momenta
    RATE = auto()
    SWINGING = auto()  # sums with functions: m l^2 omega^2 (1 - cos a)
    FORCE = auto()  # after a coefficient of friction, and after a sum with functions: mu N, (a - b cos a) F
    EXPONENTIAL = auto()  # also a sum with functions of time
    ROOT = auto()
    CHANGING = auto()  # rates of coordinates, and the time: r r_dot, not r_dot r


def rank_of_dimension(dimension: Dimension | None) -> Place:
    """Return the place of a factor with this dimension."""
    if dimension is None or dimension.is_number:
        return Place.OTHER
    if dimension.current:
        return Place.ACCELERATION if dimension.mass else Place.MASS
    if dimension.mass < 0:
        return Place.PER_MASS
    if dimension.mass and not (dimension.length and dimension.time):
        return Place.MASS  # also a density: sigma a^2
    if dimension.mass:
        return Place.FORCE if dimension == FORCE else Place.COUPLING if dimension.length >= 2 else Place.OTHER
    if dimension.length and dimension.time:
        return Place.SPEED if dimension.length == -dimension.time else Place.ACCELERATION
    return Place.LENGTH if dimension.length else Place.RATE


def rank_of_sum(places: Iterable[Place]) -> Place:
    """Return the place of a sum. Sums of masses or accelerations come early: (M + m) r_dot^2, m (a + g) l."""
    return {frozenset({Place.MASS}): Place.SUM_OF_MASSES, frozenset({Place.ACCELERATION}): Place.ACCELERATION}.get(
        frozenset(places), Place.SUM
    )


def side_by_side(items: list[Layout]) -> Layout:
    placed: list[Layout] = []
    for item in items:
        if placed and _needs_dot(placed[-1], item):
            placed.append(DOT)
        elif placed and _ends_in_bare_function(placed[-1]) and isinstance(first_of(item), Name):
            placed.append(THIN_SPACE)  # before a vector: a dot would mean a scalar product
        placed.append(item)
    return row(*placed)


def _needs_dot(before: Layout, item: Layout) -> bool:
    numeric = begins_with_number(item) and not (is_enclosed(before) and is_enclosed(item))
    return numeric or _would_be_argument(before, item)


def _would_be_argument(before: Layout, item: Layout) -> bool:
    """Return whether a factor after a function could be misread as part of the argument: cos x a^n is printed as
    cos x·a^n."""
    first = first_of(item)
    letter = first.base if isinstance(first, Raised) else first
    is_read_on = isinstance(letter, Fraction) or isinstance(letter, Name) and letter.style == "scalar"
    return is_read_on and _ends_in_bare_function(before)


def _ends_in_bare_function(layout: Layout) -> bool:
    last = last_of(layout)
    return isinstance(last, Applied) and not isinstance(last.argument, Fenced)


def between_factors(before: Layout, after: Layout) -> Layout | None:
    """Return the mark between two adjacent factors, such as a dot; None if no mark is needed."""
    if begins_with_number(after):
        return DOT
    if isinstance(first_of(after), Applied):
        return THIN_SPACE
    last = last_of(before)
    if isinstance(last, Fraction) and is_differential(first_of(last.above)) and _is_letter(after):
        return THIN_SPACE
    if is_enclosed(after) or is_enclosed(last) or is_number(before) or ends_in_differential(before):
        return THIN_SPACE
    if _is_letter(last) and _is_letter(after) and (_is_letter(before) or not _begins_with_vector(after)):
        return None if last != after else DOT
    starts_integral = isinstance(after, Row) and isinstance(after.items[0], IntegralSign)
    return THIN_SPACE if starts_integral or isinstance(after, IntegralSign) or _begins_with_vector(after) else DOT


def _is_letter(layout: Layout) -> bool:
    return isinstance(layout, Name) or isinstance(layout, Raised) and isinstance(layout.base, Name)


def _begins_with_vector(layout: Layout) -> bool:
    """Return whether the layout begins with a vector or a tensor; a dot before a vector would mean a scalar product."""
    first = first_of(layout)
    return isinstance(first, Array) or (isinstance(first, Name) and first.style != "scalar")
