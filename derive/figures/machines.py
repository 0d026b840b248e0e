"""A whole scene of mechanics: a top that leans on its pivot.

It is a list of marks for `drawing()`, so that a script can add its own marks to it.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

from sympy import Add, Expr, Rational, Symbol, cos, pi, sin

from derive.algebra.expressions import column, scalar
from derive.figures.annotations import AngleMark, Arrow, Axis, Line, PointMark, Support, Turn
from derive.figures.bodies import ORIGIN, Z, in_units, is_line, round_outline
from derive.figures.marks import Mark
from derive.figures.surfaces import ThinRod
from derive.mechanics.rotation.composite import Composed, Part
from derive.steps.step import Quantity

__all__ = ["leaning_top"]

TO_THE_RIGHT = 2 * pi / 3  # as one usually looks at a drawing


def leaning_top(
    body: Composed,
    tilt: Expr,
    angle: Any = None,
    precession: Any = None,
    spin: Any = None,
    weight: Any = None,
    azimuth: Expr = TO_THE_RIGHT,
) -> list[Mark]:
    """A body on a leaning axis that stands on a pivot: the vertical Z, the tilt, the turning about both axes.

    body               parts on one axis, each at a height above the pivot
    tilt               angle between that axis and the vertical; `angle` is its name, if it is not a letter itself
    precession, spin   names of the rates round the vertical and round the axis; nothing is drawn for one without a name
    weight             name of the weight, or the pair of it and the distance of the centre of mass from the pivot
    azimuth            to which side it leans
    """
    e = column(sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt))
    far = max((_ends(part)[1] for part in body.parts), key=in_units)
    near = min((part.at for part in body.parts if not is_line(part.body)), key=in_units, default=far / 2)
    named = angle if angle is not None else tilt
    marks: list[Mark] = [
        Support(ORIGIN, label=scalar("O")),
        *(mark for part in body.parts for mark in _part(part, body, e)),
        Axis(ORIGIN, Rational(5, 4) * far * Z, label=Symbol("Z", real=True)),
        AngleMark(ORIGIN, Z, e, Rational(7, 10) * near, label=named),
    ]
    if spin is not None:
        marks += [
            Line(far * e, Rational(5, 4) * far * e, "construction"),
            Turn(Rational(9, 8) * far * e, e, Rational(1, 9), label=spin),
        ]
    if precession is not None and tilt != 0:  # upright, one cannot tell the two turns apart
        marks.append(Turn(Rational(11, 10) * far * Z, Z, Rational(1, 7), label=precession))
    return marks if weight is None else [*marks, *_weight(weight, body, e)]


def _ends(part: Part) -> tuple[Expr, Expr]:
    """The heights above the pivot between which a part lies."""
    lower, upper = part.body.ends
    middle = part.body.middle.position[2]
    return part.at - middle + lower, part.at - middle + upper


def _part(part: Part, whole: Composed, e: Any) -> list[Mark]:
    """The surface of a part on the leaning axis; a rod in pieces, so that the bodies on it hide what is behind them."""
    surface = round_outline(part.body, (part.at - part.body.middle.position[2]) * e, e)
    if not isinstance(surface, ThinRod):
        return [surface]
    start, end = _ends(part)
    cuts = [other.at for other in whole.parts if not is_line(other.body) and in_units(other.at - start) > 0]
    pieces = pairwise([start, *(cut for cut in cuts if in_units(cut) < in_units(end)), end])
    return [replace(surface, start=a * e, end=b * e, name=surface.name if a == start else "") for a, b in pieces]


def _weight(weight: Any, body: Composed, e: Any) -> list[Mark]:
    """The weight in the centre of mass of the whole: as derived, or of the parts."""
    name, distance = weight if isinstance(weight, tuple) else (weight, None)
    keys: tuple[str, ...] = ()
    if isinstance(distance, Quantity):
        centre, keys = distance.value * e, (distance.key,)
    else:
        masses = [part.body.mass for part in body.parts]
        moments = [part.body.mass * part.at for part in body.parts]
        centre = (Add(*moments) / Add(*masses)).cancel() * e
    return [PointMark(centre, keys=keys), Arrow(centre, -Z, Rational(1, 2), False, label=name, keys=keys)]
