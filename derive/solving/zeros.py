"""All real zeros of a force in closed form: each factor is solved, or the whole force is rejected.

A product vanishes only if one of its factors vanishes. Each factor is solved completely, so all zeros are found.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sympy import (
    Abs,
    Add,
    Expr,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    cos,
    expand,
    expand_trig,
    factor_list,
    igcd,
    pi,
    sin,
    sqrt,
    tan,
    together,
)
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR8

from derive.algebra.expressions import Relation
from derive.algebra.ranges import never_vanishes_within, without_abs
from derive.algebra.tidy import tidied
from derive.solving.attainable import within_one
from derive.solving.relations import positive
from derive.solving.root_of_factor import roots_of
from derive.steps.record import assume
from derive.steps.signs import sign_for_all

HIGHEST = 6  # polynomials in the coordinate are solved up to this degree
ZERO, ONE = Integer(0), Integer(1)


class Unsolved(Exception):
    """This module does not find the zeros of a factor in closed form."""

    def __init__(self, factor: Expr):
        self.factor = factor
        super().__init__(str(factor))


@dataclass(frozen=True)
class Zero:
    """A value of the coordinate at which the force vanishes.

    exists   the condition under which this value is real and, for a positive coordinate, positive; None if there is no
             such condition
    """

    value: Expr
    exists: Relation | None = None


def zeros_of(force: Expr, q: Symbol) -> list[Zero]:
    """All real zeros. For a sine or cosine of the coordinate, only zeros within one turn are returned. Zeros of any
    other function are positive if the coordinate is positive. Raises `Unsolved` if a factor cannot be solved."""
    found: dict[Expr, Zero] = {}
    for factor in factors_of(force, q):
        for zero in _of_factor(factor, q):
            found.setdefault(tidied(zero.value), Zero(without_abs(zero.value), zero.exists))
    return sorted(found.values(), key=_order)


def zeros_nearby(value: Expr, x: Symbol) -> list[Zero]:
    """Real zeros of a function; for a periodic factor, only a few of its zeros. Raises `Unsolved` if a factor cannot be
    solved."""
    numerator = value.as_numer_denom()[0]
    for form in (numerator, tidied(TR8(numerator.expand()))):
        factors = [base for f in Mul.make_args(form) if (base := f.as_base_exp()[0]).has(x)]
        try:
            return [zero for factor in factors for zero in _of_wave(factor, x) or _turned(factor, x)]
        except Unsolved as unsolved:
            last = unsolved
    raise last


def _of_wave(function: Expr, x: Symbol) -> list[Zero]:
    """Seven successive zeros of sin(k x + c) or cos(k x + c). For any other function the list is empty."""
    slope = function.args[0].diff(x) if isinstance(function, sin | cos) else x
    if slope.has(x):
        return []
    start = (pi / 2 if isinstance(function, cos) else ZERO) - function.args[0].subs(x, 0)
    return [Zero(tidied((start + n * pi) / slope)) for n in range(-3, 4)]


def _turned(factor: Expr, x: Symbol) -> list[Zero]:
    """The zeros of a factor; if the factor repeats after a full turn, also the zeros one turn before and after."""
    turns = (0, -1, 1) if factor.has(sin, cos) and factor.subs(x, x + 2 * pi) == factor else (0,)
    return [Zero(zero.value + 2 * n * pi, zero.exists) for zero in zeros_of(factor, x) for n in turns]


def _order(zero: Zero) -> tuple[bool, int, str]:
    """Return a sort key: zeros without a condition come first."""
    value = zero.value
    rank = 0 if value == 0 else 1 if value == pi else 2 if not value.could_extract_minus_sign() else 3
    return zero.exists is not None, rank, str(value)


def factors_of(force: Expr, q: Symbol) -> Iterator[Expr]:
    """The factors of the numerator that contain the coordinate."""
    value = together(force.rewrite(cos) if force.has(tan) else force).as_numer_denom()[0]
    value = _in_sine_and_cosine(value, q)
    try:
        _, factors = factor_list(value)
    except PolynomialError:
        factors = [(f.as_base_exp()[0], 1) for f in Mul.make_args(value)]
    for factor, _ in factors:
        if factor.has(q):
            yield factor


def _in_sine_and_cosine(value: Expr, q: Symbol) -> Expr:
    """Write the value in sin u and cos u, where u is q or a fraction of q, in the form with more factors."""
    angles = {f.args[0] for f in value.atoms(sin, cos) if f.has(q)}
    if not angles:
        return expand(value)
    u = _part(angles, q)
    s, c = sin(u), cos(u)
    spread_out = expand(expand_trig(value))
    polynomial = spread_out.as_poly(s, c)
    if polynomial is None:
        raise Unsolved(value)
    both: Expr = Integer(0)
    for (n, m), coefficient in polynomial.terms():
        both += coefficient * c**m * (s if n % 2 else ONE) * expand((1 - c**2) ** (n // 2))
    by_cosine = expand(both)
    forms = [spread_out, by_cosine]
    return max(forms, key=lambda form: len(_factors_or_none(form)))


def _factors_or_none(value: Expr) -> list[Expr]:
    try:
        return [f for f, _ in factor_list(value)[1]]
    except PolynomialError:
        return []


def _part(angles: set[Expr], q: Symbol) -> Expr:
    """The largest fraction q/n such that each angle is an integer multiple of q/n plus a constant."""
    numbers = [angle.coeff(q) for angle in (expand(angle) for angle in angles)]
    if not all(number.is_Rational and number != 0 for number in numbers):
        raise Unsolved(next(iter(angles)))
    denominator = 1
    for number in numbers:
        denominator = denominator * number.q // igcd(denominator, number.q)
    return q / denominator


def _of_factor(factor: Expr, q: Symbol) -> list[Zero]:
    functions = {f for f in factor.atoms(sin, cos) if f.has(q)}
    if not functions:
        return _of_lengths(factor, q)
    angles = {f.args[0] for f in functions}
    if len(angles) > 1 or factor.xreplace(dict.fromkeys(functions, ONE)).has(q):
        raise Unsolved(factor)
    u = angles.pop()
    parts = int(1 / u.coeff(q)) if u.coeff(q) else 1
    return [Zero(parts * z.value, z.exists) for z in _of_angle(factor, u) if _is_one_turn(parts * z.value, parts)]


def _is_one_turn(value: Expr, parts: int) -> bool:
    """Whether the value may be within one turn, -pi < value <= pi."""
    return parts == 1 or not value.is_number or bool(-pi < value and value <= pi)


def _of_angle(factor: Expr, u: Expr) -> list[Zero]:
    s, c = sin(u), cos(u)
    polynomial = factor.as_poly(s, c)
    if polynomial is None:
        raise Unsolved(factor)
    if not factor.has(s):
        return [zero for value in _sure_roots(factor, c) for zero in _with_cosine(value)]
    if not factor.has(c):
        return [zero for value in _sure_roots(factor, s) for zero in _with_sine(value)]
    terms = dict(polynomial.terms())
    if set(terms) == {(1, 0), (0, 1)}:
        place = atan(tidied(-terms[0, 1] / terms[1, 0]))
        return [Zero(place), Zero(place + pi if sign_for_all(place) == -1 else place - pi)]
    raise Unsolved(factor)


def _with_cosine(value: Expr) -> list[Zero]:
    if value in (1, -1):
        return [Zero(acos(value))]
    exists, never = within_one(value)
    return [] if never else [Zero(acos(value), exists), Zero(-acos(value), exists)]


def _with_sine(value: Expr) -> list[Zero]:
    if value in (1, -1):
        return [Zero(asin(value))]
    exists, never = within_one(value)
    if never:
        return []
    other = pi - asin(value) if sign_for_all(value) != -1 else -pi - asin(value)
    return [Zero(asin(value), exists), Zero(other, exists)]


def _sure_roots(factor: Expr, x: Expr) -> list[Expr]:
    """The roots of a polynomial in a cosine or a sine. Raises `Unsolved` if a root is real only under a condition, or
    if the degree is too high."""
    if (values := _of_one_power(factor, x)) is not None:
        return values
    found = [root for root, _ in _roots(factor, x)]
    if any(root.exists is not None for root in found):
        raise Unsolved(factor)
    return [root.value for root in found]


def _roots(factor: Expr, x: Expr) -> list[tuple[Zero, int | None]]:
    """The real roots of a polynomial of first or second degree in x, each with the condition under which it is real.

    The second entry of each pair is the sign of the root where the root is real, or None if the sign is unknown.
    """
    polynomial = factor.as_poly(x)
    if polynomial is None or polynomial.degree() > 2:
        raise Unsolved(factor)
    found = roots_of(polynomial)
    if len(found) == 1:
        return [(Zero(found[0].value), sign_for_all(found[0].value))]
    inside = found[0].discriminant
    sign = sign_for_all(inside)
    if sign == -1:
        return []
    exists = positive(inside) if sign is None else None
    kept = found[::-1] if sign != 0 else found[:1]
    return [(Zero(root.value, exists), root.sign_where_real(sign_for_all)) for root in kept]


def _of_lengths(factor: Expr, q: Symbol) -> list[Zero]:
    """The zeros of a polynomial in q, of a square root minus a constant, or of a sum of two powers of q."""
    if q.is_positive and any(p.exp.free_symbols for p in factor.atoms(Pow) if p.base == q):
        return [Zero(value) for value in _of_two_powers(factor, q)]
    roots = [p for p in factor.atoms(Pow) if p.exp.is_Rational and not p.exp.is_Integer and p.has(q)]
    if roots:
        return _of_root(factor, roots, q)
    if (values := _of_one_power(factor, q)) is not None:
        return [zero for value in values for zero in _allowed(Zero(value), sign_for_all(value), q)]
    return [zero for root, sign in _roots(factor, q) for zero in _allowed(root, sign, q)]


def _of_two_powers(factor: Expr, q: Symbol) -> list[Expr]:
    """The positive root of A q^a + B q^b, where q^(a - b) = -B/A."""
    terms: dict[Expr, Expr] = {}
    for term in Add.make_args(expand(factor)):
        outside, inside = term.as_independent(q, as_Add=False)
        power = _exponent(inside, q)
        if power.has(q):
            raise Unsolved(factor)
        terms[expand(power)] = terms.get(expand(power), ZERO) + outside
    if len(terms) != 2:
        raise Unsolved(factor)
    (one, a), (other, b) = terms.items()
    apart = tidied(one - other)
    value = tidied(-b / a)
    sign = 1 if _is_square_of_letters(value) else sign_for_all(value)
    if sign is None or not never_vanishes_within(apart):
        raise Unsolved(factor)
    if apart.could_extract_minus_sign():
        apart, value = -apart, 1 / value
    return [] if sign < 0 else [value ** (1 / apart)]


def _exponent(product: Expr, q: Symbol) -> Expr:
    """The exponent of q in a product of powers of q: a + b for q^a q^b; q itself for any other product."""
    parts = [f.as_base_exp() for f in Mul.make_args(product) if f != 1]
    return Add(*(power for _, power in parts)) if all(base == q for base, _ in parts) else q


def _of_one_power(factor: Expr, x: Expr) -> list[Expr] | None:
    """The real roots of A x^n + B, with n > 2; None for any other polynomial. Raises `Unsolved` if the factor is not a
    polynomial of degree at most `HIGHEST`, or if the sign of -B/A is unknown."""
    polynomial = factor.as_poly(x)
    if polynomial is None or polynomial.degree() > HIGHEST:
        raise Unsolved(factor)
    terms = polynomial.terms()
    if polynomial.degree() < 3 or len(terms) != 2 or terms[1][0] != (0,):
        return None
    return _of_power(int(polynomial.degree()), tidied(-terms[1][1] / terms[0][1]), factor)


def _of_power(n: int, value: Expr, factor: Expr) -> list[Expr]:
    """The real roots of q^n = v."""
    sign = 1 if _is_square_of_letters(value) else sign_for_all(value)
    if sign is None:
        raise Unsolved(factor)
    if n % 2:
        return [sign * (sign * value) ** Rational(1, n)]
    return [] if sign < 0 else [value ** Rational(1, n), -(value ** Rational(1, n))]


def _of_root(factor: Expr, roots: list[Expr], q: Symbol) -> list[Zero]:
    """The zeros of A sqrt(P) + B, where P = a q^2 + c: the solutions of P = (B/A)^2, if -B/A is not negative."""
    root = roots[0]
    linear = factor.as_poly(root)
    if len(roots) > 1 or root.exp != Rational(1, 2) or linear is None or linear.degree() != 1:
        raise Unsolved(factor)
    a, b = linear.all_coeffs()
    if a.has(q) or b.has(q):
        raise Unsolved(factor)
    size = tidied(-b / a)
    sign = sign_for_all(size)
    if sign is None:
        raise Unsolved(factor)
    if sign == -1:
        return []
    inside = expand(root.base - size**2).as_poly(q)
    if inside is None or inside.degree() != 2 or inside.coeff_monomial(q) != 0:
        raise Unsolved(factor)
    square = tidied(-inside.coeff_monomial(1) / inside.LC())
    sign = sign_for_all(square)
    if sign == -1:
        return []
    exists = positive(square) if sign is None else None
    both = [Zero(sqrt(square), exists), Zero(-sqrt(square), exists)]
    return both[:1] if q.is_positive or sign == 0 else both


def _allowed(zero: Zero, sign: int | None, q: Symbol) -> list[Zero]:
    """Return a list with the zero if the coordinate can have this value; otherwise an empty list. `sign` is the sign of
    the zero.

    If the sign is unknown, a zero of a positive coordinate gets the condition that its value is positive. Raises
    `Unsolved` if the zero already has another condition. A value such as l^2 needs no condition: its symbols are
    assumed not to vanish.
    """
    if not q.is_positive:
        return [zero]
    value = zero.value
    if sign is None and (_is_square_of_letters(value) or _is_square_of_letters(-value)):
        return [zero] if _is_square_of_letters(value) else []
    if sign is None and zero.exists is not None:
        raise Unsolved(value)
    return [] if sign in (0, -1) else [zero if sign == 1 else Zero(value, positive(value))]


def _is_square_of_letters(value: Expr) -> bool:
    """Whether a value that may be zero is positive if its symbols do not vanish, such as l^2 for a momentum l.

    If the result is true, record the assumption that these symbols do not vanish.
    """
    above, below = value.as_numer_denom()
    parts = [f.as_base_exp() for f in Mul.make_args(above) if not f.is_positive]
    letters = [base.args[0] if isinstance(base, Abs) else base if power.is_even else None for base, power in parts]
    if not letters or not _is_size(below) or not all(isinstance(s, Symbol) and s.is_real for s in letters):
        return False
    for letter in letters:
        assume(Relation(letter, "!=", Integer(0)))
    return True


def _is_size(below: Expr) -> bool:
    """Whether a denominator is positive wherever it does not vanish, such as c^2 or |c|."""
    parts = (f.as_base_exp() for f in Mul.make_args(below) if not f.is_positive)
    return all(isinstance(base, Abs) or bool(base.is_real and power.is_even) for base, power in parts)
