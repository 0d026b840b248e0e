"""Test by conservation of energy whether a motion of one coordinate reaches a place or turns back before it."""

from __future__ import annotations

from itertools import islice

from sympy import Dummy, Expr, Integer, Rational, oo

from derive.algebra.expressions import Relation, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.motion.facts import ByEnergy
from derive.solving.relations import positive
from derive.solving.unknowns import left_over, letter_of, mark_for, meaning, with_unknown
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assume, assumed
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

TRIED, PARTS, SIGNS = 24, [Rational(n, 16) for n in range(1, 16)], {">": 1, "<": -1}  # PARTS of a distance


def squared_by_energy(speed: Quantity) -> Expr:
    """Return the squared rate f(q) that a step finds from conservation of energy; reject other quantities."""
    assert speed.symbol == rate(speed.needed(ByEnergy).coordinate) ** 2
    return explicit(speed.value)


def condition_to_reach(
    of: Quantity, speed: Quantity, unknown: Expr, place: Expr, there: Expr | None = None
) -> Relation | None:
    """Return the condition on the symbols under which a motion reaches a place; None if it always reaches the place.
    of        the result that refers to the place, for messages
    speed     the squared rate of a coordinate by conservation of energy, f(q)
    unknown   the coordinate q, or a function of q such as cos(q)
    place     the value of `unknown` at the place, which may be infinite
    there     the limit of f at the place, if f has no value there; by default f is evaluated at `place`
    The motion turns back where f = 0. The motion reaches the place if f is not negative at the place, nor between the
    start and the place. If the sign of f at the place depends on the symbols, the condition is f > 0 there. Between the
    start and the place, algebra decides the sign of f or, if algebra cannot decide, numerical values do.
    Errors: the motion turns back before the place, always or for some values of the symbols.
    """
    q = speed.needed(ByEnergy).coordinate
    there = tidied(_put(explicit(speed.value), unknown, place) if there is None else there)
    if sign_known(there) == -1:
        message = f"`{of.key}`: the motion does not reach {unknown} = {place}, since {rate(q)}**2 would be negative"
        raise Rejected(Complaint("not-reached", message, help=f"it would be {there}"))
    if not _is_free_by_algebra(speed, unknown, place) and _is_barred(speed, unknown, place, there):
        message = f"`{of.key}`: the motion need not reach {unknown} = {place}: on the way {rate(q)}**2 can be negative"
        raise Rejected(Complaint("not-reached", message, help="state with `assume:` when the motion reaches the place"))
    return positive(there) if sign_known(there) is None else None


def assume_reached(of: Quantity, speed: Quantity, unknown: Expr, place: Expr, there: Expr | None = None) -> None:
    """Assume that the motion reaches a place; the page states under which condition this is true."""
    condition = condition_to_reach(of, speed, unknown, place, there)
    if condition is not None:
        assume(Relation(condition.left, ">=", condition.right))


def _is_free_by_algebra(speed: Quantity, unknown: Expr, place: Expr) -> bool:
    """Whether algebra shows that f is positive between start and place, if f is not negative at the place."""
    squared, mark = explicit(speed.value), mark_for(unknown)
    written = with_unknown(squared, unknown, mark)
    if left_over(written, unknown) or place in (oo, -oo):
        return False
    polynomial = written.as_poly(mark)
    if polynomial is not None and polynomial.degree() <= 1:
        return True  # a linear function that is not negative at the ends is not negative between them
    known = speed.needed(ByEnergy)
    begin = unknown.xreplace({known.coordinate: known.start})
    return sign_known(tidied(written.xreplace({mark: place + part_of_the_way() * (begin - place)}))) == 1


def _put(squared: Expr, unknown: Expr, place: Expr) -> Expr:
    """Return f at this value of the unknown; if f also contains q outside the unknown, substitute the value of q."""
    found = with_unknown(squared, unknown, place)
    return squared.xreplace(meaning(unknown, place)) if left_over(found, unknown) else found


def part_of_the_way() -> Expr:
    """Return an expression for an arbitrary number between 0 and 1."""
    way = Dummy("s", positive=True)
    return way / (1 + way)


def _is_barred(speed: Quantity, unknown: Expr, place: Expr, there: Expr) -> bool:
    """Whether, numerically, the squared rate is negative somewhere between the start and a place."""
    known = speed.needed(ByEnergy)
    q = letter_of(unknown)
    squared, start, there = map(with_numbers, (explicit(speed.value), known.start, there))
    is_far = place in (oo, -oo)
    finite = Integer(0) if is_far else with_numbers(meaning(unknown, place)[q])
    conditions = [
        with_numbers(each.residual) * SIGNS[each.operator[0]] for each in assumed() if each.operator[0] in SIGNS
    ]
    letters = set().union(*map(letters_of, (squared, start, there, finite, *conditions))) - {q}
    for point in islice(points(letters, seed_of(squared)), TRIED):
        try:
            if value_at(there, point) < 0 or any(value_at(each, point) < 0 for each in conditions):
                continue
            begin, end = value_at(start, point), value_at(finite, point)
            for part in PARTS:
                far = (1 if place == oo else -1) * (abs(begin) + 1) * part / (1 - part)
                here = begin + (far if is_far else (end - begin) * part)
                if value_at(squared, {**point, q: here}) < 0:
                    return True
        except (Undefined, NoNumber, TypeError):
            continue
    return False
