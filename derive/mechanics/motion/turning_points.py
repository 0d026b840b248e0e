"""Test by conservation of energy whether a motion of one coordinate reaches a place or turns back before it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import islice

from sympy import Dummy, Expr, Integer, Rational, cos, diff, oo, pi, sin

from derive.algebra.expressions import Relation, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.motion.facts import Arrival, ByEnergy, SignedRate
from derive.solving.relations import positive
from derive.solving.unknowns import left_over, letter_of, mark_for, meaning, with_unknown
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero

QUARTERS = [n * pi / 2 for n in range(-4, 5)]
# number of sets of trial numbers, fractions of a distance, signs of operators
TRIED, PARTS, SIGNS = 24, [Rational(n, 16) for n in range(1, 16)], {">": 1, "<": -1}


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
    place     the value of `unknown` at the place; it may be infinite
    there     the limit of f at the place, if f has no value there; by default f is evaluated at `place`

    The motion turns back where f = 0. The motion reaches the place if f is negative neither at the place nor between
    the start and the place. If the sign of f at the place depends on the symbols, the condition is f > 0 there.
    Errors: the motion turns back before the place, always or for some values of the symbols; the place is an unstable
    equilibrium, which the motion only approaches.
    """
    begun = speed.needed(ByEnergy)
    q = begun.coordinate
    if place not in (oo, -oo) and is_zero(unknown.xreplace({q: begun.start}) - place):
        return None  # the motion starts at the place
    there = tidied(_put(explicit(speed.value), unknown, place) if there is None else there)
    if sign_known(there) == -1:
        message = f"`{of.key}`: the motion does not reach {unknown} = {place}, since {rate(q)}**2 would be negative"
        raise Rejected(Complaint("not-reached", message, help=f"{rate(q)}**2 would be {there} at this place"))
    if is_zero(there):
        _require_turning_point(of, explicit(speed.value), unknown, place)
    if not _is_free_by_algebra(speed, unknown, place) and _is_barred(speed, unknown, place, there):
        message = f"`{of.key}`: the motion need not reach {unknown} = {place}: on the way {rate(q)}**2 can be negative"
        help_line = "state with `assume:` the condition for reaching the place"
        raise Rejected(Complaint("not-reached", message, help=help_line))
    return positive(there) if sign_known(there) is None else None


def arrivals(
    of: Quantity,
    others: Sequence[Quantity],
    places: Iterable[tuple[Expr, Expr]],
    limit: Callable[[Expr], Expr] | None = None,
) -> list[Arrival]:
    """Return an `Arrival` for each motion and each place at which a result is evaluated.

    of, others   the result, and other results that are substituted into it
    places       pairs of a coordinate, or a function of a coordinate, and the constant value of this expression at the
                 place
    limit        a function that maps the squared rate f(q) to the limit of f at the place; by default f is evaluated at
                 the place

    Errors: the motion does not reach the place; the sign of a rate is wrong or unknown at the place.
    """
    return [
        _arrival(of, others, speed, unknown, place, limit(explicit(speed.value)) if limit is not None else None)
        for speed in _latest_speeds(of, *others)
        for unknown, place in places
        if unknown.free_symbols == {speed.needed(ByEnergy).coordinate}
    ]


def _arrival(
    of: Quantity, others: Sequence[Quantity], speed: Quantity, unknown: Expr, place: Expr, there: Expr | None
) -> Arrival:
    condition = condition_to_reach(of, speed, unknown, place, there)
    is_found = any(each.rests_on(speed) for each in others)
    operator = ">=" if _sign_of_slope(explicit(speed.value), unknown, place) in (1, -1) else ">"
    reached = None if is_found or condition is None else Relation(condition.left, operator, condition.right)
    begun = speed.needed(ByEnergy)
    come = Arrival(begun, explicit(speed.value), unknown, place, reached, is_found, lasts=_may_end(speed))
    ancestors = (each for quantity in (of, *others) for each in quantity.ancestors())
    root = next((each for each in ancestors if each.fact(SignedRate) and each.rests_on(speed)), None)
    if root is None or is_zero(begun.start_rate):
        # There is no signed rate to check; or the motion starts from rest and reaches only places ahead of its start.
        return come
    sense = root.needed(SignedRate).sense
    ahead = _side_of_start(come, sense)
    if ahead in (0, 1):
        return replace(come, sense=sense)
    if ahead is None or unknown != begun.coordinate or not _turns_back(come, sense):
        raise _unknown_sign(of, come, ahead)
    if of.fact(SignedRate) is None or place in (oo, -oo):
        message = (
            f"`{of.key}`: the motion turns back before {unknown} = {place}, so `{root.key}` has the opposite sign there"
        )
        raise Rejected(
            Complaint("sign-of-rate", message, help=f"substitute {unknown} = {place} into `{root.key}` instead")
        )
    return replace(come, sense=sense, turned=True)


def words_of(arrivals: Sequence[Arrival]) -> dict[str, str]:
    """Return {"lasts": "contact"} or {"lasts": "taut"} for a sentence: the contact or the tension must last until the
    motion reaches these places. Return an empty mapping if the sentence states no condition or nothing must last."""
    lasting = next((each.lasts for each in arrivals if each.reached is not None and each.lasts), "")
    return {"lasts": lasting} if lasting else {}


def _may_end(speed: Quantity) -> str:
    """Return the word for what may end during the motion: "contact" with a surface that cannot pull, or "taut" for the
    tension of a string; otherwise an empty text.
    """
    kept = [fact for each in speed.ancestors() if (fact := each.fact(Constrained)) is not None]
    enforcers = {each.enforcer for fact in kept for each in fact.constraints}
    return "contact" if "surface" in enforcers else "taut" if "string" in enforcers else ""


def _require_turning_point(of: Quantity, squared: Expr, unknown: Expr, place: Expr) -> None:
    """Check that a motion is known to come to a place where its rate vanishes: the motion turns back there."""
    sign = _sign_of_slope(squared, unknown, place)
    if sign == 0:
        message = f"`{of.key}`: the motion does not reach {unknown} = {place} in a finite time"
        raise Rejected(Complaint("not-reached", message, help="this place is an equilibrium; the motion approaches it"))
    if sign is None:
        message = f"`{of.key}`: it is not known whether the motion reaches {unknown} = {place}, where its rate vanishes"
        help_line = f"state with `assume:` the sign of {_slope(squared, unknown, place)}"
        raise Rejected(Complaint("not-reached", message, help=help_line))


def _sign_of_slope(squared: Expr, unknown: Expr, place: Expr) -> int | None:
    """Return the sign of the slope of f = q_dot^2 at a place; None if it is unknown.

    If f and its slope vanish at the place, the place is an unstable equilibrium, and the motion only approaches it. At
    infinity the result is 1, since a motion with f = 0 there, with the escape velocity, does go to infinity.
    """
    if place in (oo, -oo):
        return 1
    at_end = isinstance(unknown, sin | cos) and abs(place) == 1
    return 0 if at_end else sign_known(_slope(squared, unknown, place))


def _slope(squared: Expr, unknown: Expr, place: Expr) -> Expr:
    mark = mark_for(unknown)
    return tidied(diff(with_unknown(squared, unknown, mark), mark).xreplace({mark: place}))


def common_condition(of: Quantity, arrivals: Sequence[Arrival]) -> Relation | None:
    """Return the condition under which the motion comes to all these places; None if there is no condition."""
    found = list(dict.fromkeys(each.reached for each in arrivals if each.reached is not None))
    if len(found) > 1:
        message = f"`{of.key}` at these places depends on different conditions, such as {found[0]} and {found[1]}"
        raise Rejected(Complaint("not-reached", message, help="substitute one place after the other"))
    return found[0] if found else None


def _latest_speeds(*quantities: Quantity) -> list[Quantity]:
    """Return the squared rates from conservation of energy from which these results were derived.

    A squared rate of an earlier motion, which leads to the start of a later motion, is left out.
    """
    found = {each.key: each for of in quantities for each in of.ancestors() if each.fact(ByEnergy)}.values()
    return [each for each in found if not any(other is not each and other.rests_on(each) for other in found)]


def _unknown_sign(of: Quantity, come: Arrival, ahead: int | None) -> Rejected:
    q = come.begun.coordinate
    message = f"`{of.key}` contains {rate(q)}, whose sign at {come.unknown} = {come.place} is unknown"
    if come.unknown != q:
        needed = f"substitute a value of {q}"
    elif ahead is None:
        needed = "state with `assume:` on which side of the start this place lies"
    else:
        needed = "state with `assume:` that the motion turns back before this place"
    return Rejected(Complaint("sign-of-rate", message, help=f"{needed}, or use the squared rate"))


def _side_of_start(come: Arrival, sense: int) -> int | None:
    """Return 1 if the place lies ahead of the start, -1 if it lies behind, 0 if it is the start, and None if this is
    unknown."""
    q, start = come.begun.coordinate, come.begun.start
    if come.place in (oo, -oo):
        return sense if come.place == oo else -sense
    change = come.place - come.unknown.xreplace({q: start})
    first, second = (tidied(diff(come.unknown, q, n).xreplace({q: start})) for n in (1, 2))
    return sign_known(tidied(change * second if is_zero(first) else change * first * sense))


def _turns_back(come: Arrival, sense: int) -> bool:
    """Whether the squared rate is known to be negative somewhere ahead of the start."""
    q, squared = come.begun.coordinate, come.squared
    if squared.has(sin, cos):
        ahead = (each for each in QUARTERS if sign_known(sense * (each - come.begun.start)) == 1)
        return any(sign_known(tidied(squared.xreplace({q: each}))) == -1 for each in ahead)
    if sense == -1 and q.is_nonnegative:
        squared, sense = squared.xreplace({q: 1 / q}), 1  # 1/q goes to infinity as the distance q goes to zero
    above, below = (part.as_poly(q) for part in tidied(squared).as_numer_denom())
    if above is None or below is None:
        return False
    far_away = sign_known(tidied(above.LC() / below.LC()))
    return far_away is not None and far_away * sense ** (above.degree() - below.degree()) == -1


def _is_free_by_algebra(speed: Quantity, unknown: Expr, place: Expr) -> bool:
    """Whether algebra shows that f is not negative between the start and the place."""
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
