"""The instants at which a drawing shows velocities: the start of a requested motion, and a blow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Expr, Integer, Symbol

from derive.figures.velocities import Moment
from derive.mechanics import System
from derive.mechanics.kinematics.places import Location
from derive.stock.keys.blows import DescribedBlow
from derive.stock.keys.results import Result

SOLUTION = "solution"


def started(results: Sequence[Result], system: System) -> Moment | None:
    """Return the positions and velocities at which solutions of equations of motion begin; of two the first."""
    at: dict[Symbol, Expr] = {}
    rates: dict[Symbol, Expr] = {}
    for result in results:
        if result.verb.name == SOLUTION and {"q", "start_rate"} <= result.values.keys():
            q = result.values["q"]
            if q in system.coordinates:
                at.setdefault(q, result.values.get("start", Integer(0)))
                rates.setdefault(q, result.values["start_rate"])
    return Moment(at, rates) if rates else None


def struck(blow: DescribedBlow | None, system: System) -> Moment | None:
    """Return what acts in a blow, and where."""
    if blow is None:
        return None
    by_name: Mapping[str, Symbol] = {q.name: q for q in system.coordinates}
    at, rates = ({by_name[name]: value for name, value in known} for known in (blow.at, blow.before))
    pushes, meeting = [], []
    for act in blow.acts:
        if act.maker == "impulse":
            components, place = act.of
            pushes.append((Location(tuple(components)), place))
        elif act.maker == "collision":
            meeting += [place for place in act.of[:2] if place is not None]
    return Moment(at, rates, tuple(pushes), tuple(meeting))
