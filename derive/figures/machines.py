"""Whole scenes of mechanics in plain expressions: a cone, a symmetric top, a slab rolled on a cylinder.

Each is a list of marks for `drawing()`, so that a script can add its own marks to it.
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Rational, Symbol, cos, pi, sin

from derive.expressions import column, scalar
from derive.figures.marks import (
    AngleMark,
    Arrow,
    Axis,
    Circle,
    ConeMark,
    CylinderMark,
    Dot,
    Length,
    Line,
    Mark,
    Polygon,
    RodMark,
    Support,
    Turn,
)

ORIGIN = column(0, 0, 0)
X, Y, Z = column(1, 0, 0), column(0, 1, 0), column(0, 0, 1)
TO_THE_RIGHT = 2 * pi / 3  # as one usually looks at a drawing
THIN = Rational(1, 20)  # the thickness of a disc that is drawn as a solid, in terms of its radius


def cone(radius: Expr, height: Expr, apex: str = "below", measured: bool = True) -> list[Mark]:
    """A circular cone on the z axis, with its axes: its apex at the origin below, or its base there and the apex above.

    radius, height   lengths
    apex             "below" or "above"
    measured         whether its radius and height are written beside it
    """
    below = apex == "below"
    tip, base = (ORIGIN, height * Z) if below else (height * Z, ORIGIN)
    marks: list[Mark] = [ConeMark(tip, base, radius)]
    marks += [
        Axis(ORIGIN if below else radius * X, ORIGIN if below else radius * X, X, label=scalar("x")),
        Axis(ORIGIN if below else radius * Y, ORIGIN if below else radius * Y, Y, label=scalar("y")),
        Axis(height * Z, (height + radius / 4 if below else height) * Z, Z, label=scalar("z")),
        Line(ORIGIN, height * Z, "hidden"),
    ]
    if measured:
        marks += [
            Line(base, base + radius * Y, "hidden", label=radius),
            Length(radius * -Y, radius * -Y + height * Z, -Y, label=height),
        ]
    return marks


def top(
    tilt: Expr,
    length: Expr,
    disc_radius: Expr,
    disc_at: Expr,
    precession: Any = None,
    spin: Any = None,
    weight: Any = None,
    azimuth: Expr = TO_THE_RIGHT,
    angle: Any = None,
) -> list[Mark]:
    """A disc on a thin rod that stands on its lower end and leans: the pivot, the vertical, the tilt and the turning.

    tilt               angle between the rod and the vertical Z; `angle` is its name, if it is not a letter itself
    length             of the rod, from the pivot
    disc_radius        radius of the disc, whose middle is at `disc_at` from the pivot
    precession, spin   names of the rates round the vertical and round the rod; nothing is drawn for one without a name
    weight             name of the weight, which acts in the middle of the disc
    azimuth            from which side one sees it lean
    """
    e = column(sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt))
    thick = THIN * disc_radius
    named = angle if angle is not None else tilt
    marks: list[Mark] = [
        Support(ORIGIN, label=scalar("O")),
        RodMark(ORIGIN, (disc_at - thick) * e),
        CylinderMark((disc_at - thick) * e, (disc_at + thick) * e, disc_radius),
        RodMark((disc_at + thick) * e, length * e),
        Axis(ORIGIN, Rational(5, 4) * length * Z, label=Symbol("Z", real=True)),
        AngleMark(ORIGIN, Z, e, Rational(7, 10) * disc_at, label=named),
        Dot(disc_at * e),
    ]
    if spin is not None:
        marks += [
            Line(length * e, Rational(5, 4) * length * e, "construction"),
            Turn(Rational(9, 8) * length * e, e, Rational(1, 9), label=spin),
        ]
    if precession is not None and tilt != 0:  # upright, one cannot tell the two turns apart
        marks.append(Turn(Rational(11, 10) * length * Z, Z, Rational(1, 7), label=precession))
    if weight is not None:
        marks.append(Arrow(disc_at * e, -Z, Rational(1, 2), False, label=weight))
    return marks


def slab_on_cylinder(
    radius: Expr, thickness: Expr, angle: Expr, centre: Any = None, weight: Any = None, half_length: Expr | None = None
) -> list[Mark]:
    """A slab rolled on a fixed cylinder, seen along its axis: x to the right, y upwards, angles clockwise.

    radius        of the cylinder; its axis is the origin O
    thickness     of the slab
    angle         by which it has turned, positive to the right; balanced on top at zero
    centre        the two quantities (x, y) that say where its centre is: drawn with the contact and how far it moved
    weight        name of the weight, which acts in the centre
    half_length   of the slab, as drawn; one and a half radii and half its thickness if it is left out
    """
    reach = half_length if half_length is not None else Rational(3, 2) * radius + thickness / 2
    along, across = column(cos(angle), -sin(angle), 0), column(sin(angle), cos(angle), 0)
    contact = radius * across
    foot = contact - radius * angle * along  # the point of the face under the centre, R q behind the contact
    corners = [foot + s * reach * along + h * across for s, h in ((-1, 0), (1, 0), (1, thickness), (-1, thickness))]
    marks: list[Mark] = [
        Circle(ORIGIN, Z, radius, True),
        Polygon(tuple(corners)),
        Line(ORIGIN, Rational(13, 10) * radius * Y + thickness * Y, "construction"),
        Line(ORIGIN, contact, "construction", label=radius),
        Dot(ORIGIN, label=Symbol("O", real=True)),
        AngleMark(ORIGIN, Y, across, Rational(2, 5) * radius, label=angle),
        Length(corners[1], corners[2], along, label=thickness),
    ]
    if centre is None:
        return marks
    place, keys = column(centre[0].value, centre[1].value, 0), tuple(quantity.key for quantity in centre)
    marks += [
        Line(foot, foot + thickness * across, "hidden"),
        Line(contact, contact + thickness * across, "hidden"),
        Dot(contact, label=Symbol("P", real=True)),
        Dot(place, label=Symbol("C", real=True), keys=keys),
        Length(foot + thickness * across, contact + thickness * across, across, label=radius * angle),
    ]
    return marks if weight is None else [*marks, Arrow(place, -Y, Rational(1, 4), False, label=weight, keys=keys)]
