"""The drawing of a body that is described, where one can be made."""

from __future__ import annotations

from typing import Any

from derive.figures import axis_of_rotation, drawing, outline, vectors_in
from derive.mechanics.bodies.body import Body, RoundBody
from derive.mechanics.bodies.edged_bodies import EdgedBody


def drawn(body: Body) -> None:
    """Its outline, under its name."""
    if isinstance(body, RoundBody | EdgedBody):
        drawing(body.called.replace(" ", "_") or "body", outline(body))


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
    drawing("body", outline(body), turning)
    if has_angle:
        answer = answers.asks()["angle_between"]
        drawing("vectors", vectors_in(body, answers.spin, answers.angular_momentum, angle=answer(), at=at))
