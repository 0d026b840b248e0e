"""The drawing of a body that is described, where one can be made."""

from __future__ import annotations

from typing import Any

from sympy import cos

from derive.algebra.expressions import column
from derive.figures import arc, axis_of_rotation, drawing, outline, principal_outline, vectors_in
from derive.figures.bodies import is_in_plane, seen_outline
from derive.figures.marks import PLANE, SPACE, Mark
from derive.mechanics.bodies.body import Body, RoundBody
from derive.mechanics.bodies.edged_bodies import EdgedBody
from derive.mechanics.bodies.regions import Point
from derive.steps.step import is_zero
from derive.stock.keys.directions import Axis


def drawn(body: Body) -> None:
    """Its outline, under its name; of a body that lies in a plane as it is seen there."""
    if marks := seen_outline(body):
        drawing(body.called.replace(" ", "_") or "body", marks, view=PLANE if is_in_plane(body) else SPACE)


def _inclination(along: Axis, at: Point) -> list[Mark]:
    """The arc from one of the body's axes to that of the rotation, where the angle between them is a letter."""
    if along.is_name:
        return []
    components = along.components
    for k in (2, 0, 1):
        angle = next((f.args[0] for f in components[k].atoms(cos) if f.args[0].is_Symbol), None)
        if angle is not None and is_zero(components[k] - cos(angle)) and is_zero(1 - sum(c**2 for c in components)):
            own = column(*(int(i == k) for i in range(3)))
            return [arc(own, column(*components), label=angle, at=at)]
    return []


def drawn_turning(answers: Any, has_angle: bool) -> None:
    """A body with the axis about which it turns, and with its angular momentum where that angle is asked for."""
    body, described = answers.body, answers.described
    if not isinstance(body, RoundBody | EdgedBody):
        return
    if not described.along:
        drawing("body", outline(body))
        return
    at = body.point(answers.about)
    turning = axis_of_rotation(body.direction(described.along.named), at, rate=described.rate)
    drawing("body", outline(body), turning, *_inclination(described.along, at))
    if has_angle:
        answer = answers.asks()["angle_between"]
        drawing("vectors", vectors_in(body, answers.spin, answers.angular_momentum, angle=answer(), at=at))


def drawn_free(answers: Any, turns: bool) -> None:
    """A body of which the principal moments are known, and as it `turns` in any way its angular velocity and angular
    momentum: they are in different directions, whatever is asked of them."""
    vectors = (answers.changing, answers.angular_momentum) if turns else ()
    drawing("body", principal_outline(answers.described.moments, *vectors))
