"""The outline of a body, seen from one of its points or on a leaning axis, as its profile or its corners have it."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integer, Rational

from derive.algebra.expressions import AXES, column, scalar
from derive.errors import Complaint, Rejected
from derive.figures.annotations import Axis, LengthMark, Line
from derive.figures.marks import Mark, Position, Surface
from derive.figures.surfaces import Circle, Polyhedron, Revolved, ThinRod
from derive.mechanics.bodies.body import Body, RoundBody
from derive.mechanics.bodies.edged_bodies import EdgedBody
from derive.mechanics.bodies.regions import Point
from derive.steps.step import is_zero

__all__ = ["outline"]

ORIGIN = column(0, 0, 0)
X, Y, Z = UNIT = tuple(column(*(int(i == k) for k in range(3))) for i in range(3))
THIN = Rational(1, 20)  # half the thickness with which a disc is drawn, in terms of its radius
CURVED = 48  # circles by which a curved side is drawn, close together where it may come to a tip


def outline(body: Any, about: str | None = None, named: bool = True) -> list[Mark]:
    """The outline of a body, in the axes that begin at one of its points.

    body    a body of `derive.mechanics`
    about   the name of the point, otherwise the one at which the body's own axes begin
    named   whether its measures and the axes are written beside it
    """
    if not isinstance(body, RoundBody | EdgedBody):
        raise Rejected(Complaint("wrong-argument", f"there is no outline of a {type(body).__name__}"))
    point: Point = body.point(about or body.reference)
    if isinstance(body, EdgedBody):
        return _with_edges(body, point, named)
    surface = round_outline(body, point.seen(ORIGIN), point.axes.T * Z)
    return [surface, *_measures(body, point)] if named else [surface]


# --- bodies with edges -----------------------------------------------------------------------------------------------


def _with_edges(body: EdgedBody, point: Point, named: bool) -> list[Mark]:
    """With a name beside one edge of each length; beside a flat one dimension lines, in its plane."""
    corners = tuple(point.seen(corner) for corner in body.corners)
    lengths = tuple((length if named and body.faces else None, edges) for length, edges in body.edges)
    marks: list[Mark] = [Polyhedron(corners, body.faces, lengths, **_words(body))]
    if named:
        reaches = (max((corner[k] for corner in body.corners), key=in_units) for k in range(3))
        ends = [point.seen(reach * along) for reach, along in zip(reaches, UNIT, strict=True)]
        marks += [Axis(end, end, along, label=scalar(name)) for end, along, name in zip(ends, UNIT, AXES, strict=True)]
    if named and not body.faces:
        middle = sum(corners, ORIGIN) / len(corners)
        ends_of = ((length, corners[edges[0][0]], corners[edges[0][1]]) for length, edges in body.edges)
        marks += [LengthMark(a, b, (a + b) / 2 - middle, label=length) for length, a, b in ends_of]
    return marks


# --- round bodies ----------------------------------------------------------------------------------------------------


def round_outline(body: RoundBody, through: Position, along: Position) -> Surface:
    """The surface of a body that is round about its z axis, wherever that axis is in the drawing.

    through   where its own z is zero
    along     the direction in which its own z grows, a unit vector (3)
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
    """Whether all of it is on its axis."""
    return isinstance(body, RoundBody) and body.is_straight and all(body.radius_at(end) == 0 for end in body.ends)


def _profile(body: RoundBody) -> tuple[tuple[Expr, Expr], ...]:
    """Heights of its own z with the radius there: the two ends, or many if the side between them is curved."""
    lower, upper = body.ends
    parts = [Rational(k, CURVED) for k in ((0, CURVED) if body.is_straight else range(CURVED + 1))]
    heights = [lower + (upper - lower) * part**2 * (3 - 2 * part) for part in parts]
    return tuple((z, body.radius_at(z)) for z in heights)


def _words(body: Body) -> dict[str, Any]:
    return {"name": body.seen_as or body.name, "measures": tuple(body.measures.items())}


def _measures(body: RoundBody, point: Point) -> list[Mark]:
    """The radius where it is widest, the height beside it, and the axes from the point."""
    profile = [(point.seen(column(0, 0, z))[2], radius) for z, radius in _profile(body)]
    (low, below), (high, above) = sorted((profile[0], profile[-1]), key=lambda end: not end[0].is_nonpositive)
    wide, radius = max([(low, below), (high, above), *profile], key=lambda ring: in_units(ring[1]))
    start = body.radius_at(point.position[2])
    marks: list[Mark] = [
        Axis(start * along, start * along, along, label=scalar(name)) for along, name in zip((X, Y), "xy", strict=True)
    ]
    # Above a base that is on top the axis must first leave the far part of the rim behind.
    top = high + radius / 4 if in_units(above) > in_units(below) else high
    marks.append(Axis(high * Z, top * Z, Z, label=scalar("z")))
    if _is_told(radius, body):
        marks.append(Line(wide * Z + radius * Y, wide * Z, "hidden", label=radius))
    if _is_told(high - low, body):
        marks.append(Line(low * Z, high * Z, "hidden"))
        marks.append(LengthMark(low * Z, high * Z, None, radius, label=high - low))
    return marks


def _is_told(length: Expr, body: Body) -> bool:
    """Whether it is one of the lengths that say how large a body is."""
    return length != 0 and any(is_zero(length - measure) for measure in body.measures.values())


def in_units(length: Expr) -> float:
    """A length with every letter one, to put lengths in order."""
    return float(length.subs(dict.fromkeys(length.free_symbols, Integer(1))))
