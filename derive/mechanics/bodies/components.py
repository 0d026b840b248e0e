"""The components of a centre of mass that do not vanish, each as one integral."""

from __future__ import annotations

from typing import Any

from derive.algebra.expressions import Factors, Ratio, component_names
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.regions import Point, Region
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import Subject


def centre_components(body: Any, start: Point, region: Region, letter: str, key: str) -> dict[int, Quantity]:
    """Those components of the centre of mass of a body, from a point, that do not vanish, by the axis."""
    there = start.seen(body.middle.position)
    return {k: _component(body, start, region, k, letter, key) for k in range(3) if not is_zero(there[k])}


def _component(body: Any, start: Point, region: Region, k: int, letter: str, key: str) -> Quantity:
    """x_C = (rho/M) integral of x dV; sigma and dA, lambda and dl of a thin body.

    body    uniform, of mass M
    start   the point from which x is counted
    Second route: the mean position of the body's equimomental particles.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """
    rho, at = body.density, region.position[k]
    integral = region.integral(at)

    def mean_of_particles(found: Any) -> tuple[Any, Any]:
        return found, sum(m * start.seen(r)[k] for m, r in body.particles()) / body.mass

    return establish(
        "bodies.centre_component",
        component_names(letter)[k],
        lambda density, mass: Factors(Ratio(density, mass), integral),
        {"density": rho, "mass": body.mass},
        lines=Lines(between=worked_integral(region, at, rho.symbol / body.mass, body.size), put_in=None),
        routes={"particles": mean_of_particles},
        kind="length",
        parents=body.radii(start, region),
        telling=Telling(words={"start": start.name}),
        key=f"{key}_{'xyz'[k]}",
        scope=Scope(about=Subject(body=body, point=start)),
    )
