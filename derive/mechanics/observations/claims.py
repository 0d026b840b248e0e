"""Predicates of observations.

They compute numbers at trial points: of the answer, and of the first line of its derivation before any simplification.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from sympy import Expr, Integer, MatrixBase, Poly, Rational, Symbol, minimal_polynomial, pi, sqrt

from derive.algebra.expressions import Relation, bound, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, value_at
from derive.steps.rule import Judged, Naming, Predicate
from derive.steps.step import Quantity
from derive.steps.trial_numbers import Point, assumptions_about, everywhere, real_at, trial_points

CLOSE = Rational(1, 10**15)


def forms(quantity: Quantity) -> list[Expr]:
    """Return the value of a quantity and the first line of its derivation, if this line is an expression."""
    first = quantity.step.chain[0].expr
    lines = [quantity.value] + ([bound(first, dict(quantity.step.names))] if isinstance(first, Expr) else [])
    return [explicit(line) for line in lines]


def same(one: Expr, other: Expr) -> bool:
    """Whether two numbers agree within the precision of the computation."""
    return bool(abs(one - other) <= CLOSE * (abs(one) + abs(other)))


def numbers(values: Iterable[Any], *more: Any) -> list[Point]:
    """Return trial points for all symbols of these values."""
    letters = {s for value in (*values, *more) for s in letters_of(explicit(value))}
    return trial_points(letters, *assumptions_about(letters))


def for_each_form(quantity: Quantity, is_so: Callable[[Expr, Point], bool | None], *others: Any) -> bool:
    """Whether a statement about a quantity is true of its value, and of its first line where this line has a number."""
    value, *lines = forms(quantity)
    points = numbers([value], *others)
    return everywhere(points, lambda point: is_so(value, point)) and all(
        _nowhere_false(numbers([line], *others), line, is_so) for line in lines
    )


def _nowhere_false(points: Iterable[Point], line: Expr, is_so: Callable[[Expr, Point], bool | None]) -> bool:
    def verdicts() -> Iterator[bool | None]:
        for point in points:
            try:
                yield is_so(line, point)
            except (Undefined, NoNumber):
                yield None

    return all(verdict is not False for verdict in verdicts())


# --- frequencies ---




# --- frequencies ---


def squared_rate(facts: Judged, number: Expr) -> Expr:
    """Return the square of an angular frequency, from the frequency or, if the answer is one, from the period."""
    return 4 * pi**2 / number**2 if facts.words["seen"] == "period" else number**2


def swings_like_a_pendulum(facts: Judged, length: Expr) -> bool:
    """Whether omega^2 l = g, and the length has no gravity in it, or is the value of a symbol of the page."""
    of, g = facts.quantities["of"], facts.inputs["g"]
    found = facts.inputs.get("equal", length)
    if "equal" not in facts.inputs and g in found.free_symbols or isinstance(found, Symbol) and found == length == g:
        return False

    def is_so(line: Expr, point: Point) -> bool:
        return same(squared_rate(facts, value_at(line, point)).evalf(30) * value_at(found, point), value_at(g, point))

    return for_each_form(of, is_so, found, g)


def is_value_of_a_symbol(facts: Judged, found: Expr) -> bool:
    """Whether the length in letters is the value of the symbol that the sentence names."""
    told = facts.inputs["length"]
    values = [value for q in facts.quantities.values() for name, value in named_values(q) if name == told]
    return any(everywhere(numbers([v, found]), lambda point, v=v: same(value_at(v, point), value_at(found, point))) for v in values)


def named_values(quantity: Quantity) -> Iterator[tuple[Any, Expr]]:
    """Yield each symbol that a step introduces, with its value."""
    if isinstance(quantity.symbol, Symbol):
        yield quantity.symbol, quantity.value
    elif isinstance(quantity.symbol, MatrixBase) and isinstance(quantity.value, MatrixBase):
        yield from zip(quantity.symbol, quantity.value, strict=True)


def swings_in_the_field(facts: Judged, field: Expr) -> bool:
    """Whether omega^2 l is the stated acceleration, which does not contain l and differs from g."""
    of, length, g = facts.quantities["of"], facts.inputs["length"], facts.inputs["g"]
    if length in field.free_symbols or g not in field.free_symbols:
        return False

    def is_so(line: Expr, point: Point) -> bool:
        number = squared_rate(facts, value_at(line, point)).evalf(30) * value_at(length, point)
        return same(number, value_at(field, point)) and not same(number, value_at(g, point))

    return for_each_form(of, is_so, field, g, length)


def orbital(facts: Judged, ratio: Expr, at: Mapping[Any, Expr] | None = None) -> bool:
    """Whether the radial frequency is this multiple of the orbital rate at the radius of the circular orbit.

    at   values of symbols for a special case
    """
    of, rate = facts.quantities["of"], facts.inputs["orbital_rate"]
    special = {s: explicit(v) for s, v in (at or {}).items()}

    def is_so(line: Expr, point: Point) -> bool:
        there = {**point, **{s: value_at(v, point) for s, v in special.items()}}
        return same(value_at(line, there), value_at(ratio, there) * abs(value_at(rate, there)))

    return for_each_form(of, is_so, rate, ratio, *special.values())


def orbital_ratio(wanted: Callable[[Expr], bool]) -> Predicate:
    """Judge the ratio of the radial frequency and the orbital rate."""

    def is_so(facts: Judged) -> bool:
        return wanted(facts.result) and orbital(facts, facts.result)

    return is_so


def closes_for(ratio: int) -> Naming:
    """Judge a special value of a symbol for which the radial frequency is this multiple of the orbital rate."""

    def is_so(facts: Judged, told: Relation) -> bool:
        return orbital(facts, Integer(ratio), {told.left: told.right})

    return is_so


def rate_on_the_circle(facts: Judged, told: Relation) -> bool:
    """Whether the rate in letters, such as l/(m r_0^2), has the value of the orbital rate on the circular orbit."""
    names = dict(entry for q in facts.quantities.values() for entry in named_values(q))
    value, rate = explicit(bound(told.right, names)), facts.inputs["orbital_rate"]
    return everywhere(numbers([value, rate]), lambda point: same(value_at(value, point), value_at(rate, point)))


def ratio_of_modes(rational: bool) -> Predicate:
    """Judge the ratio of two frequencies by its minimal polynomial: this has degree 1 for a rational number."""

    def is_so(facts: Judged) -> bool:
        slow, fast = (facts.quantities[role] for role in ("slow", "fast"))
        ratio = facts.result
        degree = Poly(minimal_polynomial(ratio, Symbol("z"))).degree()

        def agrees(line: Expr, point: Point) -> bool:
            return same(value_at(line, point), ratio.evalf(30) * value_at(slow.value, point))

        return (degree == 1) == rational and for_each_form(fast, agrees, slow.value)

    return is_so


def all_frequencies_are_equal(facts: Judged) -> bool:
    """Whether the equations have only one frequency: M^-1 K is a multiple of the unit matrix at all trial points."""
    linear, of = facts.inputs["system"], facts.quantities["of"]
    mass, stiffness = linear
    size = mass.shape[0]

    def is_so(line: Expr, point: Point) -> bool:
        square = value_at(line, point) ** 2
        return all(
            same(value_at(stiffness[i, j], point), square * value_at(mass[i, j], point))
            if stiffness[i, j] != 0 or mass[i, j] != 0
            else True
            for i in range(size)
            for j in range(size)
        )

    return size > 1 and for_each_form(of, is_so, *mass, *stiffness)


def isochronous(facts: Judged) -> bool:
    """Whether T = mu q_dot^2/2 and U have d^2U/ds^2 = omega^2 with ds = sqrt(mu) dq, at all trial points.

    The derivatives are difference quotients of the energies; U must not be a square of q with a constant mu, for which
    the equation of motion is linear anyway.
    """
    q, mu, energy, square = (facts.inputs[role] for role in ("q", "mu", "energy", "square"))
    step = Rational(1, 10**9)

    def force(point: Point, at: Expr) -> Expr:
        ahead, behind = (value_at(energy, {**point, q: at + s * step}) for s in (1, -1))
        return (ahead - behind) / (2 * step) / sqrt(value_at(mu, {**point, q: at}))

    def is_so(point: Point) -> bool:
        small = {**point, q: point[q] / (1 + abs(point[q]))}
        at, apart = small[q], Rational(1, 10**5)
        slope = (force(small, at + apart) - force(small, at - apart)) / (2 * apart) / sqrt(value_at(mu, small))
        return bool(abs((slope / value_at(square, small)).evalf(30) - 1) < Rational(1, 10**6))

    curved = not everywhere(numbers([mu]), lambda point: same(value_at(mu, point), value_at(mu, {**point, q: Integer(0)})))
    return curved and everywhere(numbers([q, mu, energy, square]), is_so)


def is_the_length_along_the_path(facts: Judged, told: Relation) -> bool:
    """Whether m s_dot^2/2 is the kinetic energy, and m omega^2 s^2/2 the potential energy above its least value."""
    q, mu, energy, square, mass = (facts.inputs[role] for role in ("q", "mu", "energy", "square", "mass"))
    s = told.right
    low = energy.xreplace({q: facts.inputs["lowest"]})

    def is_so(point: Point) -> bool:
        small = {**point, q: point[q] / (1 + abs(point[q]))}
        kinetic = same(value_at(s.diff(q), small) ** 2 * value_at(mass, small), value_at(mu, small))
        height = value_at(energy - low, small)
        return kinetic and same(value_at(s, small) ** 2 * value_at(mass * square, small) / 2, height)

    return everywhere(numbers([q, mu, energy, square, s, mass]), is_so)


def is_harmonic_along_the_path(facts: Judged, told: Relation) -> bool:
    """Whether the equation is s_ddot + omega^2 s = 0 for the s of the sentence."""
    s, square = facts.inputs["path"].left, facts.inputs["square"]
    left = explicit(told.left)
    stiffness = left.coeff(s)
    return (
        explicit(told.right) == 0
        and left.coeff(rate(s, 2)) == 1
        and len(left.as_ordered_terms()) == 2
        and everywhere(numbers([stiffness, square]), lambda p: same(value_at(stiffness, p), value_at(square, p)))
    )
