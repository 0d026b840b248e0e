"""The instants at which a drawing shows velocities: the start of a requested motion, and an impact."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Integer, Symbol

from derive.algebra.expressions import TIME, Relation, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.figures.velocities import Moment
from derive.mechanics import Impact, System
from derive.mechanics.impacts.impact import Collision, Impulse
from derive.mechanics.kinematics.places import Location
from derive.steps.signs import sign_known
from derive.stock.keys.results import Result

SOLUTION, SPEED, FLIGHT = "solution", "speed", "flight"


def started(results: Sequence[Result], system: System) -> Moment | None:
    """Return the positions and velocities at which the requested motions begin. The result also has the coordinates of
    a requested flight in a plane. Return None if no such motion or flight is requested."""
    at: dict[Symbol, Expr] = {}
    rates: dict[Symbol, Expr] = {}
    for result in results:
        if result.verb.name in (SOLUTION, SPEED) and {"q", "start_rate"} <= result.values.keys():
            q = result.values["q"]
            if q in system.coordinates:
                at.setdefault(q, result.values.get("start", Integer(0)))
                rates.setdefault(q, result.values["start_rate"])
    letters = [scalar(name) for name in "xy"]
    is_flight = any(result.verb.name == FLIGHT for result in results)
    is_free = not {str(q) for q in system.coordinates} & {"x", "y"} and len(system.places[0].components) == 2
    flight = letters if is_flight and is_free else ()
    return Moment(at, rates, flight=flight) if rates or flight else None


def check_starts(results: Sequence[Result], assumed: Sequence[Relation]) -> None:
    """Reject an assumption about rates, such as the direction of slip, that is known to be false at the start of a
    requested motion."""
    at: dict[Symbol, Expr] = {}
    rates: dict[Symbol, Expr] = {}
    for result in results:
        if result.verb.name == SOLUTION and "q" in result.values:
            q = result.values["q"]
            at.setdefault(q, result.values.get("start", Integer(0)))
            rates.setdefault(rate(q), result.values.get("start_rate", Integer(0)))
    for each in assumed:
        slip = explicit(each.residual)
        at_start = tidied(slip.subs({**rates, **at, TIME: Integer(0)}))
        if each.operator == ">" and slip.free_symbols & rates.keys() and sign_known(at_start) == -1:
            message = f"at the start {each.left} is {at_start}, but the direction of slip requires a positive value"
            raise Rejected(Complaint("contradiction", message, help="reverse `direction`, or correct the start"))


def struck(impact: Impact) -> Moment:
    """Return the positions and rates just before an impact, the given impulses with the places where they act, and the
    places that collide."""
    pushes = [act for act in impact.acts if isinstance(act, Impulse) and len(act.at) > 1]  # not the angular impulses
    meeting = [place for act in impact.acts if isinstance(act, Collision) for place in (act.start, act.end) if place]
    rates = {q: impact.before[rate(q)] for q in impact.moving}
    return Moment(impact.at, rates, [(Location(push.components), Location(push.at)) for push in pushes], meeting)
