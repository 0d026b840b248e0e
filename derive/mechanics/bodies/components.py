"""One component of a centre of mass, as an integral."""

from __future__ import annotations

from typing import Any

from sympy import ImmutableDenseMatrix

from derive.algebra.expressions import AXES, Factors, Ratio, component_names
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.integration import worked_integral
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Quantity
from derive.steps.subject import Subject

__all__ = ["centre_component"]


def centre_component(
    body: Any,
    axis: str,
    origin: str | None = None,
    coordinates: str | None = None,
    symbol: str = "r_C",
    key: str | None = None,
) -> Quantity:
    """A component of the centre of mass, x_C = (rho/M) integral of x dV; sigma and dA, lambda and dl of a thin body.

    body         uniform, of mass M
    axis         "x", "y" or "z": along which of the body's axes
    origin       the point from which it is counted, by default where the body's own axes begin
    coordinates  "cartesian" or "cylindrical", where the body has both
    Second route: the mean position of the body's equimomental particles.
    Errors: no such axis, no such point, no such coordinates.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """
    if axis not in AXES:
        raise Rejected(Complaint("no-such-axis", f'a component is along "x", "y" or "z", not along "{axis}"'))
    start, k = body.point(origin or body.reference), AXES.index(axis)
    region, rho = body.within(start, coordinates), body.density
    at = region.position[k]

    def mean_of_particles(found: Any) -> tuple[Any, Any]:
        return found, sum(m * start.seen(r)[k] for m, r in body.particles()) / body.mass

    return establish(
        "bodies.centre_component",
        component_names(symbol)[k],
        lambda density, mass: Factors(Ratio(density, mass), region.integral(at)),
        {"density": rho, "mass": body.mass},
        lines=Lines(between=worked_integral(region, at, rho.symbol / body.mass, body.size), put_in=None),
        routes={"particles": mean_of_particles},
        kind="length",
        parents=body.radii(start, region),
        telling=Telling(words={"start": start.name}),
        key=key or f"centre_of_mass_{axis}",
        scope=Scope(about=Subject(body=body, point=start)),
    )


def is_its_own_image(body: Any) -> bool:
    """Whether each particle has its like on the other side of the centre."""
    if body.is_lopsided:
        return False
    centre = body.middle.position
    seen = {(m, ImmutableDenseMatrix((r - centre).expand())) for m, r in body.particles()}
    return all((m, -r) in seen for m, r in seen)
