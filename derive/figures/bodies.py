"""The outline of each kind of body, seen from one of its points, and of round bodies on a leaning axis."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from typing import Any

from sympy import Expr, Integer, Rational

from derive.algebra.expressions import AXES, column, scalar
from derive.errors import Complaint, Rejected
from derive.figures.marks import (
    Axis,
    BallMark,
    Box,
    Circle,
    ConeMark,
    CylinderMark,
    Length,
    Line,
    Mark,
    Polygon,
    RodMark,
)
from derive.mechanics.bodies.body import Cuboid
from derive.mechanics.bodies.regions import Point
from derive.mechanics.bodies.solids import Ball, Cone, Cylinder
from derive.mechanics.bodies.thin_bodies import Disc, Hoop, Plate, Rod

ORIGIN = column(0, 0, 0)
X, Y, Z = UNIT = tuple(column(*(int(i == k) for k in range(3))) for i in range(3))
THIN = Rational(1, 20)  # half the thickness with which a disc is drawn, in terms of its radius

OnAxis = Callable[[Expr], Any]  # where a point of a body's own z axis is in the drawing


def outline(body: Any, about: str | None = None, named: bool = True) -> list[Mark]:
    """The outline of a body, in the axes that begin at one of its points.

    body    a body of `derive.mechanics`
    about   the name of the point, otherwise the one at which the body's own axes begin
    named   whether its measures and the axes are written beside it
    """
    if not hasattr(body, "reference"):
        raise Rejected(Complaint("wrong-argument", f"there is no outline of a {type(body).__name__}"))
    point: Point = body.point(about or body.reference)
    if not body.is_round:
        return _with_edges(body, point, named)
    marks = round_outline(body, lambda z: point.seen(column(0, 0, z)), Z)
    return [*marks, *_measures(body, point)] if named else marks


# --- bodies with edges -----------------------------------------------------------------------------------------------


def _with_edges(body: Any, point: Point, named: bool) -> list[Mark]:
    """A block or a plate, whose own axes are along its edges."""
    if not isinstance(body, Cuboid | Plate):
        raise Rejected(Complaint("wrong-argument", f"there is no outline of {body.name}"))
    corner = point.seen(ORIGIN)
    ends = [corner + side * along for side, along in zip(body.sides, UNIT, strict=False)]
    marks: list[Mark] = [_edged(body, corner, named)]
    if named:
        ends += [corner] * (3 - len(ends))
        marks += [Axis(end, end, along, label=scalar(name)) for end, along, name in zip(ends, UNIT, AXES, strict=True)]
    if named and isinstance(body, Plate):
        marks += [Length(corner, ends[0], -Y, label=body.sides[0]), Length(corner, ends[1], -X, label=body.sides[1])]
    return marks


def _edged(body: Any, corner: Any, named: bool) -> Mark:
    if isinstance(body, Cuboid):
        return Box(corner, body.sides, body.sides if named else ())
    a, b = body.sides
    return Polygon((corner, corner + a * X, corner + a * X + b * Y, corner + b * Y))


# --- round bodies ----------------------------------------------------------------------------------------------------


@singledispatch
def round_outline(body: Any, on_axis: OnAxis, along: Any) -> list[Mark]:
    """The outline of a body that is round about its z axis, wherever that axis is in the drawing.

    on_axis   where a point of the axis is, by the body's own z
    along     the direction of the axis, a unit vector (3)
    """
    raise Rejected(Complaint("wrong-argument", f"there is no outline of {body.name}"))


@round_outline.register
def _(body: Cone, on_axis: OnAxis, along: Any) -> list[Mark]:
    return [ConeMark(on_axis(Integer(0)), on_axis(body.height), body.radius)]


@round_outline.register
def _(body: Cylinder, on_axis: OnAxis, along: Any) -> list[Mark]:
    return [CylinderMark(on_axis(Integer(0)), on_axis(body.height), body.radius)]


@round_outline.register
def _(body: Ball, on_axis: OnAxis, along: Any) -> list[Mark]:
    return [BallMark(on_axis(Integer(0)), body.radius)]


@round_outline.register
def _(body: Disc, on_axis: OnAxis, along: Any) -> list[Mark]:
    half = THIN * body.radius * along
    return [CylinderMark(on_axis(Integer(0)) - half, on_axis(Integer(0)) + half, body.radius, thin=True)]


@round_outline.register
def _(body: Hoop, on_axis: OnAxis, along: Any) -> list[Mark]:
    return [Circle(on_axis(Integer(0)), along, body.radius)]


@round_outline.register
def _(body: Rod, on_axis: OnAxis, along: Any) -> list[Mark]:
    return [RodMark(on_axis(Integer(0)), on_axis(body.length), body.length)]


def _measures(body: Any, point: Point) -> list[Mark]:
    """The radius where it is widest, the height beside it, and the axes from the point."""
    low, high = sorted(_ends(body, point), key=lambda z: not z.is_nonpositive)
    radius = getattr(body, "radius", Integer(0))
    wide = point.seen(column(0, 0, body.height)) if isinstance(body, Cone) else low * Z
    starts = [Integer(0) if isinstance(body, Cone | Rod) and wide != ORIGIN else radius] * 2
    marks: list[Mark] = [
        Axis(start * along, start * along, along, label=scalar(name))
        for start, along, name in zip(starts, (X, Y), "xy", strict=True)
    ]
    # Above a base that is on top the axis must first leave the far part of the rim behind.
    top = high + radius / 4 if isinstance(body, Cone) and wide != ORIGIN else high
    marks.append(Axis(high * Z, top * Z, Z, label=scalar("z")))
    if radius != 0:
        marks.append(Line(wide + radius * Y, wide, "hidden", label=radius))
    if low != high and not isinstance(body, Ball):
        marks.append(Line(low * Z, high * Z, "hidden"))
        marks.append(Length(low * Z, high * Z, None, radius, label=high - low))
    return marks


def _ends(body: Any, point: Point) -> list[Expr]:
    """The two ends of a round body on its axis, as z from the point."""
    if isinstance(body, Ball):
        ends = [-body.radius, body.radius]
    else:
        ends = [Integer(0), getattr(body, "height", getattr(body, "length", Integer(0)))]
    return [point.seen(column(0, 0, end))[2] for end in ends]
