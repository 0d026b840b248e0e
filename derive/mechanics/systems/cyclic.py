"""Cyclic coordinates: those that the Lagrangian does not contain, so that their momenta are constant."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.expressions import Relation, TimeRate
from derive.errors import Complaint, Rejected
from derive.mechanics.systems.coordinates import Coordinate, OfCoordinate, required
from derive.mechanics.systems.dalembert import Matter
from derive.mechanics.systems.lagrangian import generalized_force, generalized_momentum
from derive.steps.establish import Lines, establish
from derive.steps.step import Fact, Quantity, compared_with, is_zero

__all__ = ["conserved_momentum"]


@dataclass(frozen=True)
class OfMomentum(Fact):
    """The momentum that is conserved."""

    missing = "is not the conservation of a momentum"
    momentum: Quantity


def conserved_momentum(of: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Lagrange's equation of a cyclic coordinate, d/dt dL/dq_dot = 0.

    of   the Lagrangian, J
    q    a coordinate that it does not contain
    Second route: d'Alembert's principle, sum of (m a - F) . dr/dq = 0, from places and forces.
    Errors: L does not depend on q, or contains q itself; a force without a potential energy acts along q.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6.
    """
    required(of.coordinates, q, "conserved_momentum", of)
    force = generalized_force(of, q)
    if force.value != 0:
        message = f"`conserved_momentum`: `{of.key}` contains {q.symbol.name}, so its momentum is not constant"
        raise Rejected(Complaint("not-cyclic", message))
    matter = of.needed(Matter)
    if not is_zero(matter.other_force_along(q.symbol)):
        message = f"`conserved_momentum`: a force that is not in `{of.key}` acts along {q.symbol.name}"
        raise Rejected(Complaint("not-cyclic", message))
    momentum = generalized_momentum(of, q)
    moving = list(of.coordinates)

    def by_virtual_work() -> Relation:
        return Relation(matter.inertia_along(q.symbol) - matter.force_along(q.symbol), "=", 0)

    return establish(
        "cyclic.conserved_momentum",
        None,
        lambda p, _: Relation(TimeRate(p, *moving), "=", 0),
        {"momentum": momentum, "coordinate": q.symbol},
        lines=Lines(before=[], result=False, arranged=lambda found: found),
        routes={"virtual_work": compared_with(by_virtual_work)},
        key=key or f"conserved_{q.symbol.name}",
        parents=[force, momentum],
        facts=[OfMomentum(momentum), OfCoordinate(q)],
    )
