"""Rolling without slipping: where a flat body is when it has rolled on a fixed cylinder.

Axes: x to the right, y upwards, the origin on the cylinder's axis. Angles are measured clockwise from the vertical, so
that a body that rolls to the right turns by a positive angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sympy import Expr, cos, diff, integrate, sin

from derive.algebra.expressions import Factors, Terms, explicit, scalar
from derive.algebra.tidy import tidied
from derive.mechanics.systems.coordinates import Coordinate
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.record import require_constant
from derive.steps.step import Fact, Level, Quantity

__all__ = ["rolled_centre"]


@dataclass(frozen=True)
class Contact(Fact):
    """Where a rolling body touches the ground, components in m."""

    missing = "touches nothing"
    place: tuple[Expr, ...]


def rolled_centre(
    radius: Expr, height: Expr, angle: Coordinate, symbols: tuple[str, str] = ("x", "y")
) -> tuple[Quantity, Quantity]:
    """Centre of a flat body rolled on a cylinder, x = (R + h) sin q - R q cos q and y = (R + h) cos q + R q sin q.

    radius   R of the fixed cylinder, m
    height   h of the centre of mass above the face that touches it, m
    angle    q by which the body has turned, clockwise; at q = 0 it lies balanced on top
    symbols  names of x and y
    The contact has moved by the arc R q along the body, so the point of the face under the centre is R q behind it.
    Second route: the particle of the body at the contact has no velocity, and at q = 0 the centre is at (0, R + h).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3 (rolling constraints).
    """
    q = angle.symbol
    require_constant("rolled_centre", "radius", radius)
    name_x, name_y = symbols
    behind_x, behind_y = radius * q * cos(q), radius * q * sin(q)
    above = Terms(radius, height)
    values: dict[str, Any] = {
        name_x: Terms(Factors(above, sin(q)), -behind_x),
        name_y: Terms(Factors(above, cos(q)), behind_y),
    }
    contact = {name_x: radius * sin(q), name_y: radius * cos(q)}

    def at_rest(found: Expr, name: str) -> tuple[Expr, Expr]:
        """The velocity of the centre, per unit rate, is that of turning about the contact, clockwise."""
        across = values[name_y].doit() - contact[name_y], values[name_x].doit() - contact[name_x]
        turning = across[0] if name == name_x else -across[1]
        return diff(found, q), turning

    def arc_of_contact() -> Expr:
        """The way of the contact on the cylinder from q = 0, counted along its tangent, to the right at the top."""
        speed = diff(contact[name_x], q) * cos(q) - diff(contact[name_y], q) * sin(q)
        return integrate(tidied(speed), (q, 0, q))

    def along_normal() -> Expr:
        """How far the centre is from the axis of the cylinder, along the normal at the contact."""
        return explicit(values[name_x]) * sin(q) + explicit(values[name_y]) * cos(q)

    def one(name: str, balanced: Expr) -> Quantity:
        return establish(
            "rolling.rolled_centre",
            scalar(name),
            lambda *_: values[name],
            {"angle": q},
            telling=Telling(
                formulas={"arc": (radius * q, arc_of_contact()), "above": (explicit(above), along_normal())}
            ),
            lines=Lines(put_in=None, law=Level.BRIEF, result=False, arranged=explicit),
            routes={
                "no_slip": lambda found: at_rest(found, name),
                "balanced": lambda found: (found.subs(q, 0), balanced),
            },
            outcome="across" if name == name_x else "up",
            facts=[Contact(tuple(contact.values()))],
            key=name,
            kind="length",
            scope=Scope(coordinates=angle.letters),
        )

    return one(name_x, radius * 0), one(name_y, radius + height)
