"""Drawings of described bodies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Expr, Rational, cos

from derive.algebra.expressions import column, explicit, vector
from derive.algebra.tidy import tidied
from derive.course.placement import POLHODES
from derive.figures import arc, arrow, axis_of_rotation, drawing, outline, principal_outline, vectors_in
from derive.figures.bodies import is_in_plane, seen_outline, widest_of
from derive.figures.marks import PLANE, SPACE, Drawing, Mark, ShownPolhodes, noted
from derive.figures.polhodes import example_values, polhode_marks, ratios_of
from derive.figures.surroundings import FixedEnd
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.boundary import Faces, Hollowed, Round, Toroidal
from derive.steps.step import Quantity, is_zero


def drawn(body: Body, about: str = "", is_named: bool = False) -> None:
    """Draw the outline of a body, under the name of the body; a flat body is drawn in its plane.

    about      the name of a point; the axes begin at this point only if it is the centre of mass, and the position of
               the centre is known by symmetry
    is_named   whether `about` is a point that the problem names, such as a pivot; in a plane, a small circle shows it
    """
    if marks := seen_outline(body, "centre" if about == "centre" and _has_known_centre(body) else None):
        key, view = body.called.replace(" ", "_") or "body", PLANE if is_in_plane(body) else SPACE
        if is_named and view == PLANE:
            at = body.point(body.reference).seen(body.point(about).position)
            marks.append(FixedEnd(at, column(0, 0, 0), True))
        drawing(key, marks, view=view, values=_proportions(body))


def _has_known_centre(body: Body) -> bool:
    """Whether each corner of a body with faces has an opposite corner, so that the centre is known by symmetry."""
    corners = body.boundary.corners if isinstance(body.boundary, Faces) else ()
    twice = sum(corners, column(0, 0, 0)) * Rational(2, max(len(corners), 1))
    return bool(corners) and all(twice - corner in corners for corner in corners)


def _proportions(body: Body) -> dict[Expr, Expr]:
    """Return substitute values for the drawing: the radius of the section of a torus, or of a hole, is a fixed fraction
    of the radius of the body."""
    match body.boundary:
        case Toroidal(radius, section):
            small, large = section, radius / 4
        case Hollowed(whole, removed):
            small, large = widest_of(removed)[1], widest_of(whole)[1] * Rational(3, 5)
        case _:
            return {}
    return {small: large} if small.is_Symbol and not large.has(small) else {}


def _inclination(components: Sequence[Expr]) -> list[Mark]:
    """Return the arc from one of the body's axes to a direction, if the angle between them is a symbol."""
    for k in (2, 0, 1):
        angle = next((f.args[0] for f in components[k].atoms(cos) if f.args[0].is_Symbol), None)
        if angle is None:
            continue
        size = tidied(components[k] / cos(angle))
        if not size.has(angle) and is_zero(size**2 - sum(c**2 for c in components)):
            own = column(*(int(i == k) for i in range(3)))
            return [arc(own, column(*components), label=angle)]
    return []


def drawn_turning(answers: Any, has_angle: bool) -> None:
    """Draw a body with its axes at the point about which it rotates, and its axis of rotation if `along` gives it.

    Nothing is drawn if the boundary of the body is neither round nor made of faces.
    If the angular velocity is known at one instant only, an arrow shows its direction. If `along` gives the axis
    and `has_angle` is true, a second drawing shows the angle between the angular velocity and the angular
    momentum.
    """
    body, described = answers.body, answers.described
    if not isinstance(body.boundary, Round | Faces):
        return
    at = body.point(answers.about).name
    shown = outline(body, at)
    if not described.along:
        start = column(*described.start) if described.start else None
        turns = [] if start is None else [arrow(start, label=vector("omega")), *_inclination(described.start)]
        drawing("body", shown, turns)
        return
    turning = axis_of_rotation(body.direction(described.along.named), rate=described.rate)
    along = () if described.along.is_name else described.along.components
    drawing("body", shown, turning, _inclination(along) if along else [])
    if has_angle:
        angle = answers.angle_between
        drawing("vectors", vectors_in(body, answers.spin, answers.angular_momentum, angle=angle, about=at))


def drawn_free(answers: Any, turns: bool) -> None:
    """Draw a body with known principal moments; if `turns` is true, also its angular velocity and angular momentum."""
    vectors = (answers.changing, answers.angular_momentum) if turns else ()
    drawing("body", principal_outline(answers.described.moments, *vectors))


def drawn_polhodes(inertia: Quantity, momentum: Any, keys: Sequence[str]) -> None:
    """Draw the sphere of constant angular momentum with the curves of constant energy.

    keys   the keys of the steps after which the drawing is placed
    """
    moments = [explicit(inertia.value[i, i]) for i in range(3)]
    values = tuple(example_values(moments).items())
    shown = ShownPolhodes(momentum, ratios_of(moments))
    noted(Drawing(POLHODES, tuple(polhode_marks(moments, keys)), SPACE, values=values, polhodes=shown))
