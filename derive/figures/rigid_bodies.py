"""Draw a rigid body with known principal moments but unknown shape as an ellipsoid with approximately these moments."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Add, Expr, Rational, sqrt

from derive.algebra.expressions import AXES, scalar
from derive.figures.annotations import Arrow, Axis, Line, PointMark
from derive.figures.bodies import ORIGIN, UNIT
from derive.figures.marks import Mark
from derive.figures.surfaces import EllipsoidMark
from derive.mechanics.rotation.euler_equations import RigidBody
from derive.steps.step import Quantity

__all__ = ["principal_outline"]

THICK = Rational(1, 12)  # added fraction of the sum of the moments, so that flat and thin bodies get a thickness
LONG = Rational(6, 5), Rational(19, 20)  # lengths of arrows, relative to the body


def principal_outline(moments: Sequence[Any], *vectors: Quantity) -> list[Mark]:
    """Return the marks of a body with these principal moments about its centre of mass, and of its principal axes.

    moments   three principal moments, about x, y and z
    vectors   vectors with three components along the principal axes, drawn from the centre of mass; at most two are
              drawn
    """
    sizes = semi_axes([moment.value if isinstance(moment, Quantity) else moment for moment in moments])
    marks: list[Mark] = [EllipsoidMark(ORIGIN, sizes, name=RigidBody.id), PointMark(ORIGIN)]
    for size, along, axis in zip(sizes, UNIT, AXES, strict=True):
        marks += [Line(ORIGIN, size * along, "hidden"), Axis(size * along, size * along, along, label=scalar(axis))]
    for vector, size in zip(vectors, LONG, strict=False):
        marks.append(Arrow(ORIGIN, vector.value, size, label=vector.symbol))
    return marks


def semi_axes(moments: Sequence[Expr]) -> tuple[Expr, Expr, Expr]:
    """Return the semi-axes, up to a factor, of a uniform ellipsoid with approximately these moments; its I_x is
    (M/5)(b^2 + c^2)."""
    whole = Add(*moments)
    a, b, c = (sqrt(whole - 2 * moment + THICK * whole) for moment in moments)
    return a, b, c
