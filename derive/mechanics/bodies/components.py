"""Integrals over the mass of a body, line by line, and the components of a centre of mass by such integrals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer
from sympy.core.symbol import Str

from derive.algebra.expressions import AXES, Factors, Ratio, component_names
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies import claims
from derive.mechanics.bodies.facts import Integrated
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.regions import Region
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity
from derive.steps.subject import Subject

__all__ = ["centre_component"]


@dataclass(frozen=True)
class OverMass:
    """The law, the inputs and the lines of an integral over the mass of a body."""

    law: Callable[..., Any]
    inputs: dict[str, Any]
    lines: Lines


def over_mass(body: Any, region: Region, weight: Expr, mean: bool = False) -> OverMass:
    """The law, the inputs and the lines of the integral of f dm, where f is a function of the position. In dm, the
    density is the symbol of an earlier step, or the formula of the density.

    weight   the function f of the position, by which dm is multiplied
    mean     whether to divide the integral by the mass
    """
    rho = body.density
    if weight == 0:
        return OverMass(lambda: Integer(0), {}, Lines(put_in=None))
    sign = -1 if weight.could_extract_minus_sign() else 1
    whole = region.integral(sign * weight)
    if body.front == rho.symbol:
        front = rho.symbol / body.mass if mean else rho.symbol
        lines = Lines(between=worked_integral(region, weight, front, body.size), put_in=None)
        if mean:
            both = {"density": rho, "mass": body.mass}
            return OverMass(lambda density, mass: Factors(sign * Ratio(density, mass), whole), both, lines)
        return OverMass(lambda density: Factors(sign * density, whole), {"density": rho}, lines)
    front = tidied(body.front / body.mass) if mean else body.front
    between = [
        form
        for form in worked_integral(region, weight, front, body.size)
        if form.because != "mass_collected" or not (mean or rho.step.kind == "mass")
    ]
    value = tidied(rho.symbol * tidied(region.integral(weight) / body.size))
    is_by_mass = rho.step.kind == "mass" and not mean and value != 0
    after = [Form(value, "by_mass", Level.BRIEF)] if is_by_mass else []
    return OverMass(lambda: Factors(sign * front, whole), {}, Lines(between=between, put_in=None, after=after))


CENTRE_COMPONENT = Rule(
    "bodies.centre_component",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2",
    outcomes={"on_axis": claims.is_round, "generic": claims.counted_along_one_axis},
    evidence={"particles": ROUTE, "quadrature": CHECK},
    statements=[claims.from_its_point_along_the_axis],
)


def centre_component(
    body: Any,
    axis: str,
    origin: str | None = None,
    coordinates: str | None = None,
    symbol: str = "r_C",
    key: str | None = None,
) -> Quantity:
    """Component of the centre of mass, x_C = (rho/M) integral of x dV; for a thin body with sigma dA or lambda dl in
    place of rho dV.

    body         a body of mass M
    axis         "x", "y" or "z": the body axis of the component
    origin       the name of the point from which to measure; by default the `reference` of the body
    coordinates  "cartesian" or "cylindrical", for a body whose limits are known in both systems

    Second route: the mean position of the body's equimomental particles.
    Check: for a body defined by a position map, a numerical sum over cells takes the place of the second route.
    Outcomes: on_axis (the body is a solid that is round about this axis), generic.
    Errors: no such axis, no such point, no such coordinates.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """
    if axis not in AXES:
        raise Rejected(Complaint("no-such-axis", f'a component must be along "x", "y" or "z", not along "{axis}"'))
    start, k = body.point(origin or body.reference), AXES.index(axis)
    region = body.within(start, coordinates)
    integral = over_mass(body, region, region.position[k], mean=True)
    return establish(
        CENTRE_COMPONENT,
        component_names(symbol)[k],
        integral.law,
        integral.inputs,
        lines=integral.lines,
        routes=body.another_way(lambda r: r[k] / body.mass, start),
        outcome="on_axis" if axis == "z" and is_round_solid(body) else "generic",
        kind="length",
        parents=[body.density, *body.radii(start, region)],
        facts=[Integrated.over(region)],
        phrase_data=PhraseData(words={"start": start.name}, outcome_data={"along": Str(axis)}),
        key=key or f"centre_of_mass_{axis}",
        scope=Scope(about=Subject(body=body, point=start)),
    )


def is_round_solid(body: Any) -> bool:
    """Whether the body is a solid that is round about z, so that its centre of mass is on this axis."""
    return bool(body.is_round and body.filling == "volume")


def is_its_own_image(body: Any) -> bool:
    """Whether the body has inversion symmetry: `is_lopsided` is false, and for each particle at r from the centre of
    mass there is an equal particle at -r."""
    if body.is_lopsided:
        return False
    centre = body.middle.position
    seen = {(m, ImmutableDenseMatrix((r - centre).expand())) for m, r in body.particles()}
    return all((m, -r) in seen for m, r in seen)
