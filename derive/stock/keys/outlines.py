"""Drawings of described bodies."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from sympy import Expr, Rational, cos, sin

from derive.algebra.expressions import column, explicit, vector
from derive.algebra.tidy import tidied
from derive.course.placement import POLHODES
from derive.figures import (
    arc,
    arrow,
    axis_of_rotation,
    centre_mark,
    drawing,
    outline,
    point_mark,
    principal_outline,
    vectors_in,
)
from derive.figures.annotations import Projection
from derive.figures.bodies import ORIGIN, is_in_plane, seen_outline, torus_section, widest_of
from derive.figures.marks import PLANE, SPACE, Drawing, Mark, ShownPolhodes, noted
from derive.figures.polhodes import example_values, polhode_marks, ratios_of
from derive.figures.scenes import LONG
from derive.figures.surroundings import FixedEnd
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.boundary import Faces, Hollowed, Round, Toroidal
from derive.mechanics.bodies.regions import Point
from derive.steps.step import Quantity, is_zero


def name_of_drawing(body: Body) -> str:
    return body.called.replace(" ", "_") or "body"


def drawn(answers: Any, about: str = "", is_named: bool = False, key: str = "", shown: Sequence[str] = ()) -> None:
    """Draw the outline of a body, by default under the name of the body.

    about      the name of a point. If this name is `centre`, and the corners of the body are symmetric about one point,
        the axes begin at this point. In all other cases the axes begin at the reference point of the body
    is_named   whether `about` is a point that the problem names, such as a pivot
    shown      the marks of SHOWS that are drawn in addition to the outline
    """
    body = answers.body
    origin = "centre" if about == "centre" and _has_known_centre(body) else body.reference
    marks = _with_element(body, origin) if "element" in shown else seen_outline(body, origin)
    if not marks:
        return
    view = PLANE if is_in_plane(body) else SPACE
    if is_named and view == PLANE:
        at = body.point(origin).seen(body.point(about).position)
        marks.append(FixedEnd(at, column(0, 0, 0), True))
    more = [_SHOWS[name](answers, body.point(origin)) for name in shown if name in _SHOWS]
    drawing(key or name_of_drawing(body), marks, more, view=view, values=_proportions(body))


def sketched(key: str) -> None:
    """Begin a plane drawing to which the problem adds all marks."""
    drawing(key, view=PLANE)


# --- what a problem names --------------------------------------------------------------------------------------


def _masses(answers: Any, origin: Point) -> list[Mark]:
    """Return the centre of mass of each part of a body, with the mass of the part; leave out parts that are cut out."""
    parts = [part for part in getattr(answers.body, "parts", ()) if part.sign > 0]
    return [point_mark(origin.seen(part.centre), part.body.mass) for part in parts]


def _centre(answers: Any, origin: Point) -> list[Mark]:
    return [centre_mark(answers.body, origin.name)]


def _principal(answers: Any, origin: Point) -> list[Mark]:
    """Return arrows along the principal axes; they begin at the point about which the inertia tensor is taken."""
    at = origin.seen(answers.body.point(answers.about).position)
    return [arrow(axis, at, SHORT) for axis in answers.principal_axes]


def _direction(answers: Any, origin: Point) -> list[Mark]:
    """Return the axis of `moment_about`, with arcs for the angles in its components."""
    body, along = answers.body, answers.described.direction
    if along is None:
        return []
    at = origin.seen(body.point(answers.about).position)
    if along.is_name:
        return [axis_of_rotation(body.direction(along.named), at)]
    components = along.components
    return [arrow(column(*components), at, label=vector("n")), *_inclination(components), *_azimuth(components)]


def _azimuth(components: Sequence[Expr]) -> list[Mark]:
    """Return the projection of a direction on the plane of x and y, and the arc from the x axis to the projection."""
    x, y, _ = components
    angles = [f.args[0] for f in x.atoms(cos) if f.args[0].is_Symbol and is_zero(y * f - x * sin(f.args[0]))]
    if not angles:
        return []
    flat = column(cos(angles[0]), sin(angles[0]), 0)
    return [Projection(ORIGIN, column(*components), LONG), arc(column(1, 0, 0), flat, label=angles[0])]


def _with_element(body: Body, origin: str) -> list[Mark]:
    """Return the outline of a body with the element of its integrals, such as a slice of a round solid."""
    if isinstance(body.boundary, Toroidal):
        return torus_section(body)
    return outline(body, origin, sliced=True)


_SHOWS: dict[str, Callable[[Any, Point], list[Mark]]] = {
    "masses": _masses,
    "centre_of_mass": _centre,
    "principal_axes": _principal,
    "direction": _direction,
}
SHOWS = (*_SHOWS, "element")
SHORT = Rational(4, 5)  # the length of the arrows of principal axes, relative to the body


def _has_known_centre(body: Body) -> bool:
    """Whether the corners of a body with faces are symmetric about one point, the centre."""
    corners = body.boundary.corners if isinstance(body.boundary, Faces) else ()
    twice = sum(corners, column(0, 0, 0)) * Rational(2, max(len(corners), 1))
    return bool(corners) and all(twice - corner in corners for corner in corners)


def _proportions(body: Body) -> dict[Expr, Expr]:
    """Return substitute sizes for the drawing, such as a fraction of the radius of a torus for the radius of its
    section."""
    match body.boundary:
        case Toroidal(radius, section):
            small, large = section, radius / 4
        case Hollowed(whole, removed):
            small, large = widest_of(removed)[1], widest_of(whole)[1] * Rational(3, 5)
        case _:
            return {}
    return {small: large} if small.is_Symbol and not large.has(small) else {}


def _inclination(components: Sequence[Expr]) -> list[Mark]:
    """Return the arc from one of the body's axes to a direction."""
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
    """Draw a body that is round or has faces, with its axes and its axis of rotation or angular velocity; draw nothing
    for other bodies.

    If `has_angle` is true and the axis of rotation is given, a second drawing shows the angle between the angular
    velocity and the angular momentum.
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
