"""The outlines of the bodies of a system at their positions, rotated in space or by an angle in a plane."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, ClassVar

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Rational, cos, diff, sin, sqrt

from derive.algebra.expressions import TIME, column
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.figures.annotations import LargePoint, Line, PointMark, Support
from derive.figures.bodies import EDGE, ORIGIN, Pose, X, Y, Z, in_space, round_outline, widest_of, words_of
from derive.figures.links import Link, is_fixed, links_about_fixed, moving_in, same
from derive.figures.marks import Mark, Position, Surface
from derive.figures.parts import BarMark, ConnectionMark, WheelMark, beside
from derive.figures.pieces import InNumbers, Paper, Patch, Piece, Stroke, Tag
from derive.figures.positions import column_of
from derive.figures.space import Spot, Vector, hull, numeric
from derive.figures.surfaces import Cavity, Circle, Hole, Revolved, ThinRod
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd
from derive.figures.tops import follows_nodes, seen_upright, sizes_of_top, stance_values, turns_about_axes
from derive.figures.turning import angle_marks, downwards, moving_end
from derive.mechanics.bodies.boundary import Boundary, Extruded, Faces, Hollowed, Rim, Round, Segment
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.bodies.regions import Point
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.no_slip import Rolling
from derive.mechanics.model.system import System
from derive.steps.step import is_zero

ACROSS = column(0, 0, 1)
# Lengths relative to the distance of the centre of mass from the fixed point.
# The height and radius of the cone of a top of unknown shape, and the height of the end of its stem.
TOP, WIDE, STEM = Rational(4, 3), Rational(3, 5), Rational(8, 5)
SHAFT = Rational(3, 4)  # the length of the shaft of a rotating body
STEPS = 24  # number of steps along the side of a round body


@dataclass(frozen=True)
class SilhouetteMark(Surface):
    """A convex body in a plane, given by the corners of its profile in any order."""

    corners: tuple[Position, ...]

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(corner) for corner in self.corners]

    def pieces(self, paper: Paper) -> list[Piece]:
        spots = hull(paper.spots(*self.places(paper.numbers)))
        return [Patch(spots, "body"), Stroke((*spots, spots[0]), "edge")]


@dataclass(frozen=True)
class ThickBar(BarMark):
    """A thin rod with mass, drawn as a thick line and described as a body."""

    pen: ClassVar[str] = "rod"
    layer: ClassVar[int] = 2

    def _beside(self, spots: tuple[Spot, ...], gap: float) -> Tag:
        """Return the label at two thirds of the line, because the centre of mass is marked at the middle of the
        line."""
        (x, y), (u, v) = spots
        return beside(self.label, (x + (u - x) / 3, y + (v - y) / 3), (u, v), gap)


def placed_marks(system: System, placed: Any) -> Iterable[Mark]:
    """Yield the outline of a body of a system, its support, and its rotation angle."""
    placed = with_its_shape(placed)
    outline = placed_outline(placed)
    yield from outline
    if placed.rim is not None:
        yield from _centre_in_rim(system, placed)
        return
    centre: Location = placed.centre
    in_space = len(centre.components) == 3
    square = tidied(Add(*(c**2 for c in (centre - placed.at).components)))
    if outline or square == 0:
        named = not in_space and any(isinstance(mark, ThickBar) for mark in outline)
        sort = LargePoint if any(isinstance(mark, ThickBar | ThinRod) for mark in outline) else PointMark
        yield sort(column_of(centre), label=placed.body.mass if named and placed.body.mass.is_Symbol else None)
    else:
        yield from _axis_to(centre, placed)
    if square != 0 and is_fixed(system, placed.at):
        yield from (
            (PointMark(column_of(placed.at)),) if in_space and _rolls(system, placed) else _holder(system, placed)
        )
    elif square != 0:
        yield from moving_end(system, placed.at, True)
    pivoted = pivot_of(system, placed) if square == 0 and not in_space else None
    if square != 0 and not moving_in(system, square):
        angles = angle_marks(system, _line_of_centre(placed, sqrt(square), outline))
        yield from (seen_upright(each) for each in angles) if follows_nodes(placed) else angles
        if in_space and not _rolls(system, placed):
            yield from turns_about_axes(system, placed, _far_end(placed))
            yield from sizes_of_top(placed)
    elif pivoted is not None:
        yield from _pivoted(system, pivoted, outline)
    elif not in_space:
        yield from own_angle(system, placed, outline)
        if square == 0 and is_fixed(system, centre):
            yield FixedEnd(column_of(centre), downwards(2), True)


def _centre_in_rim(system: System, placed: Any) -> Iterable[Mark]:
    """Yield the line from the centre of the rim to the centre of mass, and the angle of this line. If the two centres
    coincide, yield the rotation angle of the body instead."""
    hub, centre = placed.hub, placed.centre
    yield PointMark(column_of(hub))
    if same(hub, centre):
        yield from own_angle(system, placed, placed_outline(placed))
        return
    right = hub + Location((placed.rim[1], Integer(0)))
    yield Line(column_of(hub), column_of(right), "construction", label=placed.rim[1])
    link = Link(hub, centre, sqrt(tidied(Add(*(c**2 for c in (centre - hub).components)))), True)
    yield Line(column_of(hub), column_of(centre), "construction", label=link.length)
    yield PointMark(column_of(centre))
    yield from angle_marks(system, link)


def _line_of_centre(placed: Any, size: Expr, outline: list[Mark]) -> Link:
    """Return the line from `placed.at` to the centre of mass; on a disc, the line continues to the rim."""
    way = placed.centre - placed.at
    for mark in outline:
        if isinstance(mark, WheelMark) and same(Location(tuple(mark.centre)), placed.at):
            return Link(placed.at, placed.at + mark.radius / size * way, mark.radius, True)
    return Link(placed.at, placed.centre, size, True)


def _rolls(system: System, placed: Any) -> bool:
    return any((r := each.fact(Rolling)) is not None and r.body.body is placed.body for each in system.conditions)


def pivot_of(system: System, placed: Any) -> Link | None:
    """Return the line to the centre of mass from the fixed point about which the whole body rotates; None if there is
    no such point."""
    for link in links_about_fixed(system, placed.centre):
        if not link.is_constant:
            continue
        c, s = cos(placed.turned), sin(placed.turned)
        x, y = link.way.components
        own = x * c + y * s, y * c - x * s
        if all(vanishes(diff(each, q)) for each in own for q in moving_in(system, each)):
            return link
    return None


def _pivoted(system: System, link: Link, outline: list[Mark]) -> Iterable[Mark]:
    """Yield the marks of a body that rotates about a fixed point."""
    for mark in outline:
        if isinstance(mark, WheelMark) and is_zero(mark.radius - link.length):
            yield FixedEnd(column_of(link.start), downwards(2), True)
            yield ConnectionMark(column_of(link.start), column_of(link.end))
            yield from angle_marks(system, link)
        elif isinstance(mark, ThickBar):
            ways = [Location(tuple(end)) - link.start for end in (mark.start, mark.end)]
            far, other = (_kept(system, Add(*(c**2 for c in way.components))) for way in ways)
            radius = sqrt(far)
            if 0 in (far, other):
                yield FixedEnd(column_of(link.start), downwards(2), True)
            elif is_zero(far - other) and radius.is_Symbol:
                yield Circle(column_of(link.start), ACROSS, radius)
                yield PointMark(column_of(link.start))
                yield ConnectionMark(column_of(link.start), mark.start, label=radius)
            else:
                yield PointMark(column_of(link.start))
                told = link.length if link.length.as_coeff_Mul()[1].is_Symbol else None
                yield ConnectionMark(column_of(link.start), column_of(link.end), label=told)
            yield from angle_marks(system, link)


def _kept(system: System, value: Expr) -> Expr:
    """Simplify a value that is constant during the motion: set all its coordinates and the time to zero."""
    return tidied(value.xreplace(dict.fromkeys(moving_in(system, value), Integer(0))))


def _axis_to(centre: Location, placed: Any) -> Iterable[Mark]:
    """Yield the marks of a body of unknown shape: the line to its centre of mass, or a top."""
    size = sqrt(tidied(Add(*(c**2 for c in (centre - placed.at).components))))
    if _is_top(placed):
        start, way = column_of(placed.at), column_of(centre - placed.at)
        along = way / size
        yield Revolved(((Integer(0), Integer(0)), (TOP * size, WIDE * size)), start, along)
        yield ThinRod(start + TOP * way, start + STEM * way)
        yield Line(start, start + way, "hidden", label=size)
    else:
        yield ConnectionMark(column_of(placed.at), column_of(centre), label=size)
    yield PointMark(column_of(centre), label=placed.body.mass)


def _is_top(placed: Any) -> bool:
    """Whether a body of unknown shape is drawn as a top."""
    on_axis = placed.body.middle.position - placed.point.position
    is_upright = on_axis[0] == on_axis[1] == 0 and numeric(on_axis[2]) > 0
    return follows_nodes(placed) and getattr(placed.body, "moments", None) is not None and is_upright


def _holder(system: System, placed: Any) -> Iterable[Mark]:
    """Yield the joint, the hinge, the support or the ceiling that holds a body."""
    at = column_of(placed.at)
    way = (placed.centre - placed.at).components
    if len(way) == 2:
        yield FixedEnd(at, downwards(2), True, column_of(placed.centre - placed.at))
    elif TIME in moving_in(system, *way):
        if placed.turned.turns[0][0] == 2:
            size = sqrt(tidied(Add(*(c**2 for c in way))))
            away = downwards(3) if numeric(way[-1].subs(stance_values(system))) > 0 else -downwards(3)
            yield BarMark(at, at + SHAFT * size * away)
        yield FixedEnd(at, 0 * at, True)
    else:
        yield Support(at) if numeric(way[-1]) > 0 else FixedEnd(at, downwards(3), True)


def with_its_shape(placed: Any) -> Any:
    """Return the placed body; a body given by symbols is replaced by a body with the shape that the symbols
    describe."""
    known = getattr(placed.body, "shape", None)
    if known is None:
        return placed
    body, about = known
    return replace(placed, body=body, point=body.point(about))


def _far_end(placed: Any) -> Location:
    """Return the place on the z axis of a body at which its rotations are drawn."""
    parts = getattr(placed.body, "parts", ()) or (placed.body,)
    ends = [part_end for part in parts for part_end in _ends_on_axis(part)]
    held = placed.point.position
    far = max(ends, key=lambda z: numeric(z - held[2]), default=None)
    if far is None and _is_top(placed):
        far = held[2] + STEM * (placed.body.middle.position[2] - held[2])
    elif far is None or numeric(far - held[2]) <= 0:
        far = placed.body.middle.position[2]
    end: Location = placed.at + placed.seen_in_space(column(0, 0, far - held[2]))
    return end


def _ends_on_axis(part: Any) -> list[Expr]:
    """Return the ends of a round part on the z axis of the whole body."""
    body = getattr(part, "body", part)
    if not isinstance(getattr(body, "boundary", None), Round):
        return []
    places = [z * Z for z in body.boundary.ends]
    seen = [part.seen(place) for place in places] if body is not part else places
    return [place[2] for place in seen if place[0] == place[1] == 0]


def _of_parts(placed: Any) -> list[Mark]:
    """Return the marks of the parts of a body. In space a rod is drawn in pieces, so that bodies on the rod hide the
    pieces behind them."""
    marks: list[Mark] = []
    for part in placed.body.parts:
        if part.sign < 0:
            there = _placed_part(placed, part)
            found = _cut_out(placed_outline(there), placed.is_plane) if there is not None else []
            if not found:
                return []
            marks = [*(_towards(mark, placed.centre) for mark in marks), *found]
            continue
        if part.body.boundary is None and not hasattr(part.body, "parts"):
            continue
        there = _placed_part(placed, part)
        if there is None:
            continue
        if _is_line(part.body) and not placed.is_plane:
            marks += _in_pieces(there, [other.centre for other in placed.body.parts if not _is_line(other.body)], part)
        else:
            marks += placed_outline(there)
    return marks


def _cut_out(outline: list[Mark], is_plane: bool) -> list[Mark]:
    """Return the holes of a removed part, as far as they can be drawn."""
    surfaces = [mark for mark in outline if isinstance(mark, SilhouetteMark | WheelMark)]
    if is_plane:
        return [Hole(mark) for mark in surfaces]
    return [
        Cavity(mark)
        for mark in outline
        if isinstance(mark, Revolved) and mark.profile[0][1] == mark.profile[-1][1] == 0
    ]


def _towards(mark: Mark, centre: Location) -> Mark:
    """Turn the pointer of a disc with a hole towards the centre of mass."""
    if not isinstance(mark, WheelMark) or same(Location(tuple(mark.centre)), centre):
        return mark
    return replace(mark, pointer=column_of(centre) - mark.centre)


def _placed_part(placed: Any, part: Any) -> Any:
    """Return a part of a body as a placed body; None if it cannot be drawn."""
    own = ImmutableDenseMatrix(part.position - placed.point.position)
    at = placed.at + placed.seen_in_space(own)
    point = part.body.point(part.of)
    if isinstance(placed.turned, Axes):
        turned = Axes(ImmutableDenseMatrix(placed.turned.in_space * part.turn))
        return PlacedBody(part.body, turned, point, at)
    return replace(placed, body=part.body, point=point, at=at) if part.turn.is_Identity else None


def _is_line(body: Any) -> bool:
    return isinstance(body.boundary, Round) and body.boundary.is_line


def _in_pieces(there: Any, centres: list[Any], part: Any) -> list[Mark]:
    """Return a rod in space, cut at the centres of other parts that are on the rod."""
    at, (lower, upper) = _place_in(there), there.body.boundary.ends
    along = part.turn * Z
    ways = [centre - part.seen(ORIGIN) for centre in centres]
    heights = [(along.T * way)[0] for way in ways if is_zero(ImmutableDenseMatrix(along.cross(way)))]
    cuts = sorted((z for z in heights if numeric(lower) < numeric(z) < numeric(upper)), key=numeric)
    surface = round_outline(there.body.boundary, Pose(at, at(Z) - at(ORIGIN)), words_of(there.body))
    assert isinstance(surface, ThinRod)
    pieces = pairwise([lower, *cuts, upper])
    return [
        replace(surface, start=at(a * Z), end=at(b * Z), name=surface.name if a == lower else "") for a, b in pieces
    ]


def own_angle(system: System, placed: Any, outline: list[Mark]) -> Iterable[Mark]:
    """Yield the rotation angle: for a bar, drawn at its start; for a disc, drawn at its centre with an arrowhead that
    shows the positive sense."""
    for mark in outline:
        if isinstance(mark, WheelMark) and mark.pointer is not None and (rolled := _rolled_angle(system, placed)):
            angle, sense = rolled
            x, y = mark.pointer
            onwards = sense * ImmutableDenseMatrix([-y, x])
            yield AngleBetween(mark.centre, ImmutableDenseMatrix([1, 0]), mark.pointer, True, onwards, label=angle)
            continue
        if isinstance(mark, ThickBar):
            start, end = Location(tuple(mark.start)), Location(tuple(mark.end))
        elif isinstance(mark, WheelMark) and any(turn.is_Symbol for turn in (placed.turned, -placed.turned)):
            start = Location(tuple(mark.centre))
            end = start + mark.radius * Location(tuple(mark.pointer))
        else:
            continue
        square = tidied(Add(*(c**2 for c in (end - start).components)))
        for angle in angle_marks(system, Link(start, end, sqrt(square), True)):
            if isinstance(mark, WheelMark) and isinstance(angle, AngleBetween) and angle.label.is_Symbol:
                yield replace(angle, growing=diff(angle.b, angle.label))
            else:
                yield angle


def _rolled_angle(system: System, placed: Any) -> tuple[Expr, int] | None:
    """Return the coordinate that equals the rotation angle of a rolling body up to a sign, and this sign; None if
    there is no such coordinate."""
    for q, value in system.known.items():
        if system.coordinates.get(q) in ("angle", None) and moving_in(system, value):
            for sense in (1, -1):
                if is_zero(tidied(placed.turned - sense * value)):
                    return q, sense
    return None


def placed_outline(placed: Any) -> list[Mark]:
    """Return the outline of a body at its place; an empty list if the shape is unknown or cannot be drawn."""
    if placed.rim is not None:
        hub, radius = placed.rim
        ahead = column_of(Location((cos(placed.turned), sin(placed.turned))))
        pointer = ahead if same(hub, placed.centre) else None
        label, measures = radius if pointer is not None else None, (("radius", radius),)
        return [WheelMark(column_of(hub), radius, pointer, label=label, name="round_body", measures=measures)]
    shown = _as_it_looks(placed)
    body, boundary = shown.body, getattr(shown.body, "boundary", None)
    if hasattr(body, "parts"):
        return _of_parts(shown)
    if boundary is None:
        return []
    at, words = _place_in(shown), words_of(body)
    if body is not placed.body:
        words["measures"] = ()
    match boundary:
        case Round(ends=(lower, upper)) if boundary.is_line:
            return [ThickBar(at(lower * Z), at(upper * Z), label=upper - lower, **words)]
        case Segment(start, end):
            return [ThickBar(at(start), at(end), **words)]
    if shown.across is None:
        return in_space(boundary, Pose(at, at(Z) - at(ORIGIN)), words)
    return _in_plane(boundary, at, shown.across, words)


def _as_it_looks(placed: Any) -> Any:
    """Replace a body that has no shape by the body that represents it in drawings, with the same centre of mass."""
    look = getattr(placed.body, "look", None)
    if look is None:
        return placed
    shift = look.middle.position - placed.body.middle.position
    return replace(placed, body=look, point=Point(placed.point.name, placed.point.position + shift))


def _place_in(placed: Any) -> Callable[[Position], Position]:
    """Return the function that converts a place in body axes to the same place in the drawing."""
    held = placed.point.position

    def at(own: Position) -> Position:
        return column_of(placed.at + placed.seen_in_space(ImmutableDenseMatrix(own - held)))

    return at


def _in_plane(boundary: Boundary | None, at: Callable[[Position], Position], across: int, words: Any) -> list[Mark]:
    """Return the silhouette of a body in a plane.

    across   the index of the body axis perpendicular to the plane
    """
    match boundary:
        case Faces():
            corners = tuple(map(at, boundary.corners))
            return [SilhouetteMark(corners, **words), *_sides(boundary, corners)]
        case Round() if across == 2:
            return [_wheel(boundary, at, words)]
        case Round(ends=(lower, upper)):
            side = Y if across == 0 else X
            heights = [lower + (upper - lower) * Rational(k, STEPS) for k in range(STEPS + 1)]
            spots = [sign * boundary.radius_at(z) * side + z * Z for z in heights for sign in (-1, 1)]
            return [SilhouetteMark(tuple(map(at, spots)), **words)]
        case Rim() if across == 2:
            return [SilhouetteMark(tuple(dict.fromkeys(map(at, boundary.places(EDGE)))), **words)]
        case Extruded(section) if across == 2:
            return _in_plane(section, at, across, words)
        case Hollowed(whole, removed) if across == 2 and not removed.is_closed:
            return [_wheel(whole, at, words), Hole(_wheel(removed, at, {}))]
    return []


def _wheel(boundary: Round, at: Callable[[Position], Position], words: dict[str, Any]) -> WheelMark:
    centre, (_, radius) = at(ORIGIN), widest_of(boundary)
    return WheelMark(centre, radius, at(X) - centre, is_ring=boundary.is_curve, label=radius, **words)


def _sides(boundary: Faces, corners: tuple[Position, ...]) -> Iterable[Mark]:
    """Yield a dimension line for each edge length with a symbol, if the body has at most four corners."""
    for length, edges in boundary.edges if len(corners) <= 4 else ():
        if length.as_coeff_Mul()[1].is_Symbol:
            start, end = (corners[i] for i in edges[-1])
            yield DistanceMark(start, end, label=length)
