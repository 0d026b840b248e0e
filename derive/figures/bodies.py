"""Outlines of bodies, computed from their boundaries: in axes through a point of the body, or at any position and
orientation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sympy import Expr, Rational, cos, pi, sin, sqrt

from derive.algebra.expressions import AXES, column, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.figures.annotations import AngleMark, Axis, CentreMark, LengthMark, Line, PointMark
from derive.figures.marks import Mark, Position, Surface
from derive.figures.space import numeric
from derive.figures.surfaces import (
    Bore,
    Cavity,
    Circle,
    EllipsoidMark,
    Hole,
    Polyhedron,
    Revolved,
    SliceMark,
    ThinRod,
    TorusMark,
)
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.boundary import Boundary, Ellipsoidal, Faces, Hollowed, Rim, Round, Segment, Toroidal
from derive.mechanics.bodies.regions import Point
from derive.mechanics.bodies.solids import Ellipsoid
from derive.steps.step import is_zero

__all__ = ["centre_mark", "outline"]

ORIGIN = column(0, 0, 0)
X, Y, Z = UNIT = tuple(column(*(int(i == k) for k in range(3))) for i in range(3))
THIN = Rational(1, 40)  # half the drawn thickness of a disc, relative to its radius
EDGE = 32  # number of steps along each curve of the edge of a flat body
CUT, SLICE = Rational(11, 20), Rational(1, 20)  # height and thickness of a slice, relative to the height of the body
BESIDE_IT = 17.0  # distance between the dimension lines of a slice and of the whole height, in points
# the marked point in the section of a torus: its polar angle, and its distance from the centre divided by the radius of
# the section
TILT, INSIDE = 5 * pi / 18, Rational(4, 5)
CURVED = 48  # number of steps along a curved side; the steps are shorter at the ends, which may be tips


def outline(body: Any, about: str | None = None, named: bool = True, sliced: bool = False) -> list[Mark]:
    """Return the outline of a body, in axes whose origin is one of the body's points.

    body    a body of `derive.mechanics`
    about   the name of the point; by default the `reference` of the body
    named   whether to label the measures of the body and to draw its axes
    sliced  whether to mark a slice perpendicular to the axis of a round solid, as for an integral over the height

    Raise `Rejected` if the outline is unknown.
    """
    found = seen_outline(body, about, named) if isinstance(body, Body) else []
    if sliced and found and isinstance(body.boundary, Round) and body.filling == "volume":
        found = _with_slice(found, body.boundary, body.point(about or body.reference))
    if not found:
        raise Rejected(Complaint("wrong-argument", f"the outline of a {type(body).__name__} is unknown"))
    return found


def seen_outline(body: Body, about: str | None = None, named: bool = True) -> list[Mark]:
    """Return the outline of a body; an empty list if the outline is unknown."""
    point: Point = body.point(about or body.reference)
    boundary = body.boundary
    if isinstance(boundary, Ellipsoidal):
        return _ellipsoid(boundary, point, named)
    if isinstance(boundary, Toroidal):
        return _torus(boundary, words_of(body), point, named)
    if hasattr(body, "parts"):
        found = _of_parts(body.parts, point, named, is_in_plane(body))
    else:
        found = in_space(boundary, _pose(point), words_of(body), named)
    if not found or not named:
        return found
    if isinstance(boundary, Faces):
        return [*found, *body_axes(boundary, point), *([] if boundary.faces else _edge_lengths(boundary, point))]
    if isinstance(boundary, Round):
        return [*found, *_measures(body, boundary, point)]
    found += _sizes(body, boundary, point, Y)
    for along, name in list(zip(UNIT, AXES, strict=True))[: 2 if is_in_plane(body) else 3]:
        start = max(_end_on(found, along), _reach(body, point, along), key=lambda end: numeric(end.dot(along)))
        found.append(Axis(start, start, along, label=scalar(name)))
    return found


def _reach(body: Body, point: Point, along: Position) -> Position:
    """Return the place at which an axis leaves a body; the origin if this place is unknown."""
    match body.boundary:
        case Rim() as rim:
            ends = [point.seen(place) for place in rim.places(EDGE)]
        case Hollowed(whole):
            ends = _ends_of_round(whole, point.seen, point.axes.T, along)
        case _:
            parts = [part for part in getattr(body, "parts", ()) if part.sign > 0]
            ends = [
                end
                for part in parts
                if isinstance(part.body.boundary, Round) and not part.body.boundary.is_flat
                for end in _ends_of_round(part.body.boundary, _seen_of(part, point), point.axes.T * part.turn, along)
            ]
    on_axis = [end for end in ends if all(is_zero(entry) for entry in end.cross(along))]
    return max((ORIGIN, *on_axis), key=lambda end: numeric(end.dot(along)))


def _seen_of(part: Any, point: Point) -> Callable[[Position], Position]:
    return lambda place: point.seen(part.seen(place))


def _ends_of_round(
    boundary: Round, seen: Callable[[Position], Position], turn: Position, along: Position
) -> list[Position]:
    """Return the two ends of a round body along an axis; an empty list if this axis is neither parallel nor
    perpendicular to the axis of the body."""
    own = turn.T * along
    if own[2] != 0:
        return [seen(z * Z) for z in boundary.ends] if abs(own[2]) == 1 else []
    wide, radius = widest_of(boundary)
    return [seen(wide * Z + side * radius * own) for side in (1, -1)]


def _end_on(marks: Sequence[Mark], along: Position) -> Position:
    """Return the start of the visible part of an axis: the far end of a thin rod from the origin along the axis, or the
    origin."""
    for mark in marks:
        if isinstance(mark, ThinRod) and ORIGIN in (mark.start, mark.end):
            _, end = sorted((mark.start, mark.end), key=lambda place: place != ORIGIN)
            if all(is_zero(entry) for entry in end.cross(along)) and numeric(end.dot(along)) > 0:
                return end
    return ORIGIN


def axes_at(body: Body, about: str) -> list[Mark]:
    """Return the axes that begin at a point of the body."""
    if isinstance(body.boundary, Faces):
        return body_axes(body.boundary, body.point(about))
    return [mark for mark in outline(body, about) if isinstance(mark, Axis)]


def is_in_plane(body: Body) -> bool:
    """Return whether a body has several parts and is drawn in its plane."""
    return hasattr(body, "parts") and body.flat_across == "z"


def words_of(body: Any) -> dict[str, Any]:
    """Return the name of a body and its measures, for the description of its surface."""
    return {"name": body.id, "measures": tuple(getattr(body, "measures", {}).items())}


# --- surfaces in space -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Pose:
    """The position and orientation of a body in a drawing in space.

    at      a function from a position in body axes to the position in the drawing
    along   the direction of the z axis of the body in the drawing, as a unit vector
    """

    at: Callable[[Position], Position]
    along: Position


def _pose(point: Point) -> Pose:
    return Pose(point.seen, point.axes.T * Z)


def in_space(boundary: Boundary | None, pose: Pose, words: dict[str, Any], named: bool = False) -> list[Mark]:
    """Return the surfaces of a body in space, in any position; an empty list if the body cannot be drawn.

    named   whether to label the edges with their lengths, if the body has faces
    """
    match boundary:
        case Round():
            return [round_outline(boundary, pose, words)]
        case Faces(corners, faces, edges):
            lengths = tuple((length if named and faces else None, at) for length, at in edges)
            return [Polyhedron(tuple(map(pose.at, corners)), faces, lengths, **words)]
        case Segment(start, end):
            return [ThinRod(pose.at(start), pose.at(end), **words)]
        case Rim():
            return [Polyhedron(tuple(map(pose.at, boundary.places(EDGE))), **words)]
        case Hollowed(whole, removed):
            outer = _flat_circle(whole, pose, words) if whole.is_flat else round_outline(whole, pose, words)
            return [outer, _room(removed, pose, {})]
    return []


def round_outline(boundary: Round, pose: Pose, words: dict[str, Any]) -> Surface:
    """Return the surface of a body of revolution, for any position of its axis in the drawing."""
    (lower, upper), through, along = boundary.ends, pose.at(ORIGIN), pose.along
    if boundary.is_line:
        return ThinRod(through + lower * along, through + upper * along, **words)
    if not boundary.is_flat:
        return Revolved(_profile(boundary), through, along, **words)
    radius = boundary.radius_at(lower)
    if boundary.is_curve:
        return Circle(through + lower * along, along, radius, **words)
    half = THIN * radius
    return Revolved(((lower - half, radius), (lower + half, radius)), through, along, **words)


def _room(removed: Round, pose: Pose, words: dict[str, Any]) -> Cavity:
    """Return the mark of a removed round part: a hole in a flat body, a closed cavity, or a bore."""
    if removed.is_flat:
        return Hole(_flat_circle(removed, pose, words))
    return (Cavity if removed.is_closed else Bore)(round_outline(removed, pose, words))


def _flat_circle(boundary: Round, pose: Pose, words: dict[str, Any]) -> Circle:
    height = boundary.ends[0]
    middle = pose.at(ORIGIN) + height * pose.along
    return Circle(middle, pose.along, boundary.radius_at(height), filled=True, **words)


def _profile(boundary: Round) -> tuple[tuple[Expr, Expr], ...]:
    """Return pairs of a height in body axes and the radius at this height: the two ends for a straight side, many
    heights for a curved side."""
    lower, upper = boundary.ends
    parts = [Rational(k, CURVED) for k in ((0, CURVED) if boundary.is_straight else range(CURVED + 1))]
    heights = [lower + (upper - lower) * part**2 * (3 - 2 * part) for part in parts]
    return tuple((z, boundary.radius_at(z)) for z in heights)


def widest_of(boundary: Round) -> tuple[Expr, Expr]:
    """Return the height, in body axes, at which a round body is widest, and the radius at this height."""
    return max(_profile(boundary), key=lambda ring: numeric(ring[1]))


# --- bodies of several parts -----------------------------------------------------------------------------------------


def _of_parts(parts: Sequence[Any], whole: Point, named: bool, in_plane: bool) -> list[Mark]:
    """Return the marks of all parts, each label once; an empty list if a part, or a removed part, cannot be drawn."""
    marks: list[Mark] = []
    for part in parts:
        body, held = part.body, part.body.point(part.of).position
        point = Point(part.of, held - part.turn.T * (part.position - whole.position), part.turn.T * whole.axes)
        aside = X if in_plane else Y
        if part.sign < 0:
            found = _hollow(body, point, -aside, named, in_plane)
        elif hasattr(body, "parts"):
            found = _of_parts(body.parts, point, named, in_plane)
        else:
            found = in_space(body.boundary, _pose(point), words_of(body), named)
            found += _sizes(body, body.boundary, point, aside) if named else []
        if not found:
            return []
        told = [mark.label for mark in marks]
        marks += [mark for mark in found if mark.label is None or mark.label not in told]
    # If the body is drawn in its plane, thin rods are drawn over the other parts, so that the whole rods are visible.
    return sorted(marks, key=lambda mark: in_plane and isinstance(mark, ThinRod))


def _hollow(body: Body, point: Point, aside: Position, named: bool, in_plane: bool) -> list[Mark]:
    """Return the marks of a removed part; an empty list if it cannot be drawn."""
    boundary, pose = body.boundary, _pose(point)
    if isinstance(boundary, Faces) and in_plane:
        return [Hole(mark) for mark in in_space(boundary, pose, words_of(body)) if isinstance(mark, Surface)]
    if not isinstance(boundary, Round) or boundary.is_line or boundary.is_curve:
        return []
    if not (boundary.is_closed or boundary.is_flat and in_plane):
        return []
    return [_room(boundary, pose, words_of(body)), *(_sizes(body, boundary, point, aside) if named else [])]


# --- lengths and axes ------------------------------------------------------------------------------------------------


def _sizes(body: Body, boundary: Boundary | None, point: Point, aside: Position) -> list[Mark]:
    """Return lines labelled with the radius and the lengths of a body; the body may have any orientation."""
    match boundary:
        case Round():
            return _round_sizes(body, boundary, point, aside)
        case Segment(start, end):
            ends = point.seen(start), point.seen(end)
            way = ends[1] - ends[0]
            return [LengthMark(*ends, None, label=tidied(sqrt(way.dot(way))))]
        case Rim(_, (start, end, radius)):
            return [Line(point.seen(start), point.seen(end), "edge", label=radius)]
        case Hollowed(whole, removed):
            sizes = [*_round_sizes(body, whole, point, aside), *_round_sizes(body, removed, point, -aside)]
            return list({mark.label: mark for mark in sizes}.values())
    return []


def _round_sizes(body: Body, boundary: Round, point: Point, aside: Position) -> list[Mark]:
    along, origin = point.axes.T * Z, point.seen(ORIGIN)
    low, high = boundary.ends
    wide, radius = widest_of(boundary)
    marks: list[Mark] = []
    if _is_told(radius, body):
        middle = origin + wide * along
        marks.append(Line(middle + radius * aside, middle, "hidden", label=radius))
    if _is_told(high - low, body):
        marks.append(LengthMark(origin + low * along, origin + high * along, None, radius, label=high - low))
    return marks


def _edge_lengths(boundary: Faces, point: Point) -> list[Mark]:
    """Return dimension lines for the edge lengths of a flat body."""
    corners = tuple(map(point.seen, boundary.corners))
    middle = sum(corners, ORIGIN) / len(corners)
    is_isosceles = len(corners) == 3 and any(len(edges) == 2 for _, edges in boundary.edges)
    shown = ((length, edge) for length, edges in boundary.edges for edge in edges[: 2 if is_isosceles else 1])
    ends_of = ((length, *(corners[i] for i in edge)) for length, edge in shown)
    return [LengthMark(a, b, (a + b) / 2 - middle, label=length) for length, a, b in ends_of]


def body_axes(boundary: Faces, point: Point) -> list[Mark]:
    """Return the axes from a point of the body: arrows outside the body, and dashed lines inside it.

    If the point is a corner, there are no dashed lines.
    """
    corners = [point.seen(corner) for corner in boundary.corners]
    reaches = (max((corner[k] for corner in corners), key=numeric) for k in range(3))
    ends = [reach * along for reach, along in zip(reaches, UNIT, strict=True)]
    marks: list[Mark] = [
        Axis(end, end, along, label=scalar(name)) for end, along, name in zip(ends, UNIT, AXES, strict=True)
    ]
    if ORIGIN not in corners:
        marks += [Line(ORIGIN, end, "hidden") for end in ends if end != ORIGIN]
    return marks


def _measures(body: Body, boundary: Round, point: Point) -> list[Mark]:
    profile = [(point.seen(column(0, 0, z))[2], radius) for z, radius in _profile(boundary)]
    (low, below), (high, above) = sorted((profile[0], profile[-1]), key=lambda end: not end[0].is_nonpositive)
    wide, radius = max([(low, below), (high, above), *profile], key=lambda ring: numeric(ring[1]))
    start = boundary.radius_at(point.position[2])
    marks: list[Mark] = [
        Axis(start * along, start * along, along, label=scalar(name)) for along, name in zip((X, Y), "xy", strict=True)
    ]
    # If the upper end is wider, the axis is longer, so that its arrowhead is beyond the far part of the rim.
    top = high + radius / 4 if numeric(above) > numeric(below) else high
    marks.append(Axis(high * Z, top * Z, Z, label=scalar("z")))
    if _is_told(radius, body):
        marks.append(Line(wide * Z + radius * Y, wide * Z, "hidden", label=radius))
    if _is_told(high - low, body):
        marks.append(Line(low * Z, high * Z, "hidden"))
        marks.append(LengthMark(low * Z, high * Z, None, radius, label=high - low))
    return marks


def _with_slice(marks: Sequence[Mark], boundary: Round, point: Point) -> list[Mark]:
    """Add a slice at the height z above the point, with its radius and a dimension line for z."""
    z = scalar("z")
    lower, upper = boundary.ends
    at = lower + CUT * (upper - lower)
    near, far = sorted((at, at + SLICE * (upper - lower)), key=lambda own: numeric(_height(point, own)))
    _, radius = widest_of(boundary)
    rings = tuple((_height(point, own), boundary.radius_at(at)) for own in (near, far))
    label = tidied(boundary.radius_at(point.along_body(z)))
    slice_of_it = SliceMark(rings, ORIGIN, Z, label=label, height=z, thickness=(scalar("d"), z))
    moved = [replace(mark, beyond=BESIDE_IT) if isinstance(mark, LengthMark) else mark for mark in marks]
    return [*moved, slice_of_it, LengthMark(ORIGIN, _height(point, near) * Z, None, radius, label=z)]


def _height(point: Point, own: Expr) -> Expr:
    """Convert the height `own` in body axes to z measured from a point on the axis."""
    return point.seen(column(0, 0, own))[2]


def centre_mark(body: Body, about: str | None = None, label: Any = "C") -> Mark:
    """Mark the centre of mass of a body with a label, but without its coordinates, which the problem asks for."""
    return CentreMark(body.point(about or body.reference).seen(body.middle.position), label=scalar(label))


def _is_told(length: Expr, body: Body) -> bool:
    """Return whether the length is one of the measures of the body."""
    return length != 0 and any(is_zero(length - measure) for measure in body.measures.values())


def _ellipsoid(boundary: Ellipsoidal, point: Point, named: bool) -> list[Mark]:
    """Return the ellipsoid; if `named`, with labelled semi-axes and with axes beyond their ends."""
    centre, semi_axes = point.seen(ORIGIN), boundary.semi_axes
    marks: list[Mark] = [EllipsoidMark(centre, semi_axes, name=Ellipsoid.id, measures=(("semi_axes", semi_axes),))]
    for size, along, name in zip(semi_axes, UNIT, AXES, strict=True) if named else ():
        end = centre + size * along
        marks += [Line(centre, end, "hidden", label=size), Axis(end, end, along, label=scalar(name))]
    return marks


def torus_section(body: Body) -> list[Mark]:
    """Return the section of a torus by the plane of y and z, with its axes and both radii. One point of the section is
    marked with its polar coordinates."""
    boundary = body.boundary
    assert isinstance(boundary, Toroidal)
    (distance, *_), (angle, *_), *_ = body.map()[1]
    radius, section = boundary.radius, boundary.section
    middle = radius * Y
    way = cos(TILT) * Y + sin(TILT) * Z
    discs: list[Mark] = [Circle(side * middle, X, section, filled=True) for side in (1, -1)]
    return [
        *discs,
        Axis(ORIGIN, (radius + section) * Y, Y, label=scalar("y")),
        Axis(ORIGIN, section * Z, Z, label=scalar("z")),
        LengthMark(ORIGIN, middle, -Z, section, label=radius),
        Line(-middle, -middle + section * (sin(TILT) * Z - cos(TILT) * Y), "hidden", label=section),
        Line(middle, middle + INSIDE * section * way, "construction", label=distance),
        PointMark(middle + INSIDE * section * way),
        PointMark(middle),
        AngleMark(middle, Y, way, section / 2, label=angle),
    ]


def _torus(boundary: Toroidal, words: dict[str, Any], point: Point, named: bool) -> list[Mark]:
    centre, radius, section = point.seen(ORIGIN), boundary.radius, boundary.section
    marks: list[Mark] = [TorusMark(centre, radius, section, **words)]
    if not named:
        return marks
    middle, edge = centre + radius * Y, centre + (radius + section) * Y
    marks += [Line(centre, middle, "hidden", label=radius), Line(middle, edge, "hidden", label=section)]
    ends = (centre + (radius + section) * X, edge, centre)
    return [*marks, *(Axis(e, e, along, label=scalar(name)) for e, along, name in zip(ends, UNIT, AXES, strict=True))]
