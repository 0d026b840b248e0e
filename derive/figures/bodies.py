"""The outline of a body from its profile or corners, relative to one of its points or on an inclined axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain
from typing import Any

from sympy import Add, Expr, Integer, Rational, pi, sqrt

from derive.algebra.expressions import AXES, column, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.figures.annotations import Axis, CentreMark, LengthMark, Line
from derive.figures.marks import Mark, Position, Surface
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
from derive.mechanics.bodies.body import Body, OfRadius, RoundBody
from derive.mechanics.bodies.edged_bodies import EdgedBody
from derive.mechanics.bodies.general import Solid
from derive.mechanics.bodies.regions import Point
from derive.mechanics.bodies.solids import Ellipsoid, Torus, Tube
from derive.mechanics.bodies.thin_bodies import Annulus
from derive.steps.step import is_zero

__all__ = ["centre_mark", "outline"]

ORIGIN = column(0, 0, 0)
X, Y, Z = UNIT = tuple(column(*(int(i == k) for k in range(3))) for i in range(3))
THIN = Rational(1, 40)  # half the drawn thickness of a disc, relative to its radius
EDGE = 32  # steps along each side of the edge of a flat body
CUT, SLICE = Rational(11, 20), Rational(1, 20)  # place and thickness of a slice, relative to the height
BESIDE_IT = 17.0  # points between the dimension line for a slice's height and that for the whole
CURVED = 48  # circles that draw a curved side, closer together at its ends, which may be tips


def outline(body: Any, about: str | None = None, named: bool = True, sliced: bool = False) -> list[Mark]:
    """The outline of a body, in axes that begin at one of its points.

    body    a body of `derive.mechanics`
    about   the name of the point; by default the origin of the body's own axes
    named   whether its measures and its axes are labelled
    sliced  whether a slice across the axis of a round solid is marked, as for an integral over its height
    """
    found = seen_outline(body, about, named) if isinstance(body, Body) else []
    if sliced and isinstance(body, RoundBody) and body.filling == "volume":
        found = _with_slice(found, body, body.point(about or body.reference))
    if not found:
        raise Rejected(Complaint("wrong-argument", f"the outline of a {type(body).__name__} is unknown"))
    return found


def seen_outline(body: Body, about: str | None = None, named: bool = True) -> list[Mark]:
    """The outline of a body; an empty list if it is unknown."""
    point: Point = body.point(about or body.reference)
    if isinstance(body, EdgedBody):
        return _with_edges(body, point, named)
    if isinstance(body, RoundBody):
        surface = round_outline(body, point.seen(ORIGIN), point.axes.T * Z)
        return [surface, *_measures(body, point)] if named else [surface]
    if isinstance(body, Torus):
        return _torus(body, point, named)
    if (semi_axes := semi_axes_of(body)) is not None:
        return _ellipsoid(body, semi_axes, point, named)
    in_plane = is_in_plane(body)
    found = _of_parts(body.parts, point, named, in_plane) if hasattr(body, "parts") else _by_its_map(body, point, named)
    if found and named:
        for along, name in list(zip(UNIT, AXES, strict=True))[: 2 if in_plane else 3]:
            start = _end_on(found, along)
            found.append(Axis(start, start, along, label=scalar(name)))
    return found


def _end_on(marks: Sequence[Mark], along: Position) -> Position:
    """The start of a visible axis: the end of a thin rod that lies on it from the origin, else the origin."""
    for mark in marks:
        if isinstance(mark, ThinRod) and ORIGIN in (mark.start, mark.end):
            _, end = sorted((mark.start, mark.end), key=lambda place: place != ORIGIN)
            if all(is_zero(entry) for entry in end.cross(along)) and in_units(end.dot(along)) > 0:
                return end
    return ORIGIN


def axes_at(body: Body, about: str) -> list[Mark]:
    """The axes that begin at a point of the body."""
    if isinstance(body, EdgedBody):
        return body_axes(body, body.point(about))
    return [mark for mark in outline(body, about) if isinstance(mark, Axis)]


def is_in_plane(body: Body) -> bool:
    """Whether a body of several parts should be shown in the plane of its parts."""
    return hasattr(body, "parts") and body.flat_across == "z"


# --- bodies with edges -----------------------------------------------------------------------------------------------


def _with_edges(body: EdgedBody, point: Point, named: bool) -> list[Mark]:
    """The outline, with a label at one edge of each length; for a flat body, with dimension lines in its plane."""
    corners = tuple(point.seen(corner) for corner in body.corners)
    lengths = tuple((length if named and body.faces else None, edges) for length, edges in body.edges)
    marks: list[Mark] = [Polyhedron(corners, body.faces, lengths, **_words(body))]
    if named:
        marks += body_axes(body, point)
    if named and not body.faces:
        middle = sum(corners, ORIGIN) / len(corners)
        ends_of = ((length, corners[edges[0][0]], corners[edges[0][1]]) for length, edges in body.edges)
        marks += [LengthMark(a, b, (a + b) / 2 - middle, label=length) for length, a, b in ends_of]
    return marks


def body_axes(body: EdgedBody, point: Point) -> list[Mark]:
    """The axes that begin at a point of the body: dashed inside it, unless they are edges, and arrows outside."""
    corners = [point.seen(corner) for corner in body.corners]
    reaches = (max((corner[k] for corner in corners), key=in_units) for k in range(3))
    ends = [reach * along for reach, along in zip(reaches, UNIT, strict=True)]
    marks: list[Mark] = [
        Axis(end, end, along, label=scalar(name)) for end, along, name in zip(ends, UNIT, AXES, strict=True)
    ]
    if ORIGIN not in corners:
        marks += [Line(ORIGIN, end, "hidden") for end in ends if end != ORIGIN]
    return marks


# --- round bodies ----------------------------------------------------------------------------------------------------


def round_outline(body: RoundBody, through: Position, along: Position) -> Surface:
    """The surface of a body of revolution about its z axis, for any position of that axis in the drawing.

    through   the place of its own z = 0
    along     the direction of its own z axis, a unit vector (3)
    """
    lower, upper = body.ends
    if is_line(body):
        return ThinRod(through + lower * along, through + upper * along, **_words(body))
    if lower != upper:
        return Revolved(_profile(body), through, along, **_words(body))
    radius = body.radius_at(lower)
    if body.filling == "length":
        return Circle(through + lower * along, along, radius, **_words(body))
    half = THIN * radius
    return Revolved(((lower - half, radius), (lower + half, radius)), through, along, **_words(body))


def is_line(body: Body) -> bool:
    """Whether the whole body lies on its axis."""
    return isinstance(body, RoundBody) and body.is_straight and all(body.radius_at(end) == 0 for end in body.ends)


def _profile(body: RoundBody) -> tuple[tuple[Expr, Expr], ...]:
    """Heights along its own z axis with the radius there: both ends, or many heights if the side is curved."""
    lower, upper = body.ends
    parts = [Rational(k, CURVED) for k in ((0, CURVED) if body.is_straight else range(CURVED + 1))]
    heights = [lower + (upper - lower) * part**2 * (3 - 2 * part) for part in parts]
    return tuple((z, body.radius_at(z)) for z in heights)


def _words(body: Body) -> dict[str, Any]:
    return {"name": body.id, "measures": tuple(body.measures.items())}


def _measures(body: RoundBody, point: Point) -> list[Mark]:
    """The radius at the widest place, the height next to the body, and the axes from the point."""
    profile = [(point.seen(column(0, 0, z))[2], radius) for z, radius in _profile(body)]
    (low, below), (high, above) = sorted((profile[0], profile[-1]), key=lambda end: not end[0].is_nonpositive)
    wide, radius = max([(low, below), (high, above), *profile], key=lambda ring: in_units(ring[1]))
    start = body.radius_at(point.position[2])
    marks: list[Mark] = [
        Axis(start * along, start * along, along, label=scalar(name)) for along, name in zip((X, Y), "xy", strict=True)
    ]
    # If the base is on top, the axis arrow must start beyond the far part of the rim.
    top = high + radius / 4 if in_units(above) > in_units(below) else high
    marks.append(Axis(high * Z, top * Z, Z, label=scalar("z")))
    if _is_told(radius, body):
        marks.append(Line(wide * Z + radius * Y, wide * Z, "hidden", label=radius))
    if _is_told(high - low, body):
        marks.append(Line(low * Z, high * Z, "hidden"))
        marks.append(LengthMark(low * Z, high * Z, None, radius, label=high - low))
    return marks


def widest_of(body: RoundBody) -> tuple[Expr, Expr]:
    """The height of the widest place, and the radius there."""
    return max(_profile(body), key=lambda ring: in_units(ring[1]))


def _with_slice(marks: Sequence[Mark], body: RoundBody, point: Point) -> list[Mark]:
    """Add a slice at the height z from the point, with its radius; existing dimension lines move outwards."""
    z = scalar("z")
    lower, upper = body.ends
    at = lower + CUT * (upper - lower)
    near, far = sorted((at, at + SLICE * (upper - lower)), key=lambda own: in_units(_height(point, own)))
    radius = max((radius for _, radius in _profile(body)), key=in_units)
    rings = tuple((_height(point, own), body.radius_at(at)) for own in (near, far))
    label = tidied(body.radius_at(point.along_body(z)))
    slice_of_it = SliceMark(rings, ORIGIN, Z, label=label, height=z, thickness=(scalar("d"), z))
    moved = [replace(mark, beyond=BESIDE_IT) if isinstance(mark, LengthMark) else mark for mark in marks]
    return [*moved, slice_of_it, LengthMark(ORIGIN, _height(point, near) * Z, None, radius, label=z)]


def _height(point: Point, own: Expr) -> Expr:
    """The z coordinate measured from a point on the axis, for a height `own` along the body's own axis."""
    return point.seen(column(0, 0, own))[2]


def centre_mark(body: Body, about: str | None = None, label: Any = "C") -> Mark:
    """Mark the centre of mass of a body with its name, but without its coordinates, which the problem asks for."""
    return CentreMark(body.point(about or body.reference).seen(body.middle.position), label=scalar(label))


def _is_told(length: Expr, body: Body) -> bool:
    """Whether the length is one of the measures of the body."""
    return length != 0 and any(is_zero(length - measure) for measure in body.measures.values())


def in_units(length: Expr) -> float:
    """The length with all symbols set to one, to sort lengths."""
    return float(length.subs(dict.fromkeys(length.free_symbols, Integer(1))))


# --- bodies of several parts, and others -----------------------------------------------------------------------------


def _of_parts(parts: Sequence[Any], whole: Point, named: bool, in_plane: bool) -> list[Mark]:
    """All parts at their places; empty if the outline of a part is unknown, or if a hole would be visible inside."""
    marks: list[Mark] = []
    for part in parts:
        body, held = part.body, part.body.point(part.of).position
        point = Point(part.of, held - part.turn.T * (part.position - whole.position), part.turn.T * whole.axes)
        aside = X if in_plane else Y
        if part.sign < 0:
            found = _hollow(body, point, -aside, named, in_plane)
        elif isinstance(body, RoundBody):
            surface = round_outline(body, point.seen(ORIGIN), point.axes.T * Z)
            found = [surface, *(_sizes(body, point, aside) if named else [])]
        elif isinstance(body, EdgedBody):
            found = _with_edges(body, point, named)[:1]
        elif hasattr(body, "parts"):
            found = _of_parts(body.parts, point, named, in_plane)
        elif hasattr(body, "whole_and_removed"):
            found = _with_room(body, point, named)
        else:
            found = []
        if not found:
            return []
        told = [mark.label for mark in marks]
        marks += [mark for mark in found if mark.label is None or mark.label not in told]  # label equal sizes once
    return marks


def _hollow(body: Body, point: Point, aside: Position, named: bool, in_plane: bool) -> list[Mark]:
    """A removed part, if it has no rim or is shown in its plane; else empty."""
    if isinstance(body, EdgedBody) and in_plane:
        return [Hole(mark) for mark in _with_edges(body, point, named=False) if isinstance(mark, Surface)]
    if not isinstance(body, RoundBody) or is_line(body):
        return []
    origin, along = point.seen(ORIGIN), point.axes.T * Z
    sizes = _sizes(body, point, aside) if named else []
    if all(body.radius_at(end) == 0 for end in body.ends):
        return [Cavity(round_outline(body, origin, along)), *sizes]
    if not in_plane or body.filling != "area":
        return []
    middle, radius = origin + body.ends[0] * along, body.radius_at(body.ends[0])
    return [Hole(Circle(middle, along, radius, filled=True, **_words(body))), *sizes]


def _sizes(body: RoundBody, point: Point, aside: Position) -> list[Mark]:
    """The radius at the widest place, and the length, for a body with any orientation."""
    along, origin = point.axes.T * Z, point.seen(ORIGIN)
    low, high = body.ends
    wide, radius = widest_of(body)
    marks: list[Mark] = []
    if _is_told(radius, body):
        middle = origin + wide * along
        marks.append(Line(middle + radius * aside, middle, "hidden", label=radius))
    if _is_told(high - low, body):
        marks.append(LengthMark(origin + low * along, origin + high * along, None, radius, label=high - low))
    return marks


def semi_axes_of(body: Body) -> tuple[Expr, Expr, Expr] | None:
    """The semi-axes of an ellipsoid about its origin, also if it is given by a map as a stretched ball."""
    if isinstance(body, Ellipsoid):
        return body.semi_axes
    place, limits = body.map() if isinstance(body, Solid) else (None, ())
    if place is None or [tuple(ends) for _, *ends in limits] != [(0, 1), (0, pi), (0, 2 * pi)]:
        return None
    r, *angles = (letter for letter, *_ in limits)
    (a, x), (b, y), (c, z) = ((entry / r).as_independent(r, *angles, as_Add=False) for entry in place)
    is_ball = is_zero(Add(*(each**2 for each in (x, y, z))) - 1) and all(size.is_positive for size in (a, b, c))
    return (a, b, c) if is_ball else None


def _ellipsoid(body: Body, semi_axes: tuple[Expr, Expr, Expr], point: Point, named: bool) -> list[Mark]:
    """The ellipsoid, with its semi-axes dashed and labelled, and with axes beyond them."""
    centre = point.seen(ORIGIN)
    words = {**_words(body), "name": Ellipsoid.id, "measures": (("semi_axes", semi_axes),)}
    marks: list[Mark] = [EllipsoidMark(centre, semi_axes, **words)]
    for size, along, name in zip(semi_axes, UNIT, AXES, strict=True) if named else ():
        end = centre + size * along
        marks += [Line(centre, end, "hidden", label=size), Axis(end, end, along, label=scalar(name))]
    return marks


def _torus(body: Torus, point: Point, named: bool) -> list[Mark]:
    """The torus, with both radii along y, and with axes outside it."""
    centre = point.seen(ORIGIN)
    marks: list[Mark] = [TorusMark(centre, body.radius, body.section, **_words(body))]
    if not named:
        return marks
    middle, edge = centre + body.radius * Y, centre + (body.radius + body.section) * Y
    marks += [Line(centre, middle, "hidden", label=body.radius), Line(middle, edge, "hidden", label=body.section)]
    ends = (centre + (body.radius + body.section) * X, edge, centre)
    return [*marks, *(Axis(e, e, along, label=scalar(name)) for e, along, name in zip(ends, UNIT, AXES, strict=True))]


def _by_its_map(body: Body, point: Point, named: bool) -> list[Mark]:
    """A straight wire, or a plate in the xy plane whose edge is given by the limits of its map."""
    if hasattr(body, "whole_and_removed"):
        return _with_room(body, point, named)
    if not hasattr(body, "map"):
        return []
    place, limits = body.map()
    if len(limits) == 1 and is_zero(place.diff(limits[0][0], 2)):
        u, *ends = limits[0]
        start, end = (point.seen(place.xreplace({u: at})) for at in ends)
        length = tidied(sqrt((end - start).dot(end - start)))
        return [ThinRod(start, end, **_words(body)), *([LengthMark(start, end, None, label=length)] if named else [])]
    spots = edge_of(body)
    if not spots:
        return []
    rim = Polyhedron(tuple(point.seen(spot) for spot in spots), **_words(body))
    if not named or not isinstance(body, OfRadius):
        return [rim]
    return [rim, (Line(point.seen(-body.radius * X), point.seen(ORIGIN), "edge", label=body.radius))]


def _with_room(body: Any, point: Point, named: bool) -> list[Mark]:
    """A body minus a smaller body of the same kind, which leaves a cavity, a bore or a hole."""
    whole, removed = body.whole_and_removed()
    centre, along = point.seen(ORIGIN), point.axes.T * Z
    marks: list[Mark]
    if isinstance(body, Annulus):
        rim, edge = (Circle(centre, along, each.radius, filled=True) for each in (whole, removed))
        marks = [replace(rim, **_words(body)), Hole(edge)]
    else:
        outer, inner = (round_outline(each, centre, along) for each in (whole, removed))
        room: type[Cavity] = Bore if isinstance(body, Tube) else Cavity
        marks = [replace(outer, **_words(body)), room(replace(inner, name=""))]
    sizes = [*_sizes(whole, point, Y), *_sizes(removed, point, -Y)] if named else []
    return [*marks, *{mark.label: mark for mark in sizes}.values()]


def edge_of(body: Body) -> list[Position]:
    """Places along the whole edge of a flat body in the xy plane, from the limits of its map; empty if the body has a
    hole."""
    if not hasattr(body, "map") or body.flat_across != "z":
        return []
    place, limits = body.map()
    if len(limits) != 2 or any(end.free_symbols & {x for x, *_ in limits} for _, *ends in limits for end in ends):
        return []
    (u, *u_ends), (v, *v_ends) = limits
    sides = [
        (u, u_ends[0], v, v_ends),
        (v, v_ends[1], u, u_ends),
        (u, u_ends[1], v, v_ends[::-1]),
        (v, v_ends[0], u, u_ends[::-1]),
    ]
    curves = [
        [place.xreplace({held: end, letter: first + (last - first) * Rational(k, EDGE)}) for k in range(EDGE + 1)]
        for held, end, letter, (first, last) in sides
    ]
    # Two limits with the same curve form a seam, not an edge; the rest is one closed line, or an edge and a hole.
    seamless = [curves[k::2] for k in (0, 1) if curves[1 - k] == curves[3 - k][::-1]]
    rounds = [curve for curve in seamless[0] if len(set(curve)) > 1] if seamless else [[*chain(*curves)]]
    return list(dict.fromkeys(rounds[0])) if len(rounds) == 1 else []
