"""Numerical vectors in space, and spots on the paper, after numbers are substituted for the symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import acos, atan2, cos, hypot, pi, sin, sqrt
from types import MappingProxyType
from typing import Any, TypeAlias

from sympy import Expr, Float, Symbol

from derive.algebra.expressions import as_expr

Vector: TypeAlias = tuple[float, float, float]
Spot: TypeAlias = tuple[float, float]

NOUGHT: Vector = (0.0, 0.0, 0.0)
STEPS = 96  # number of straight segments in a circle


def numeric(value: Expr, known: Mapping[Symbol, Any] = MappingProxyType({})) -> float:
    """Return a numerical value of an expression. Its symbols are replaced by distinct numbers from 0.6 upwards, which
    are possible values of lengths and, if there are only a few, of acute angles.

    known   symbol -> value, for some symbols; a value may contain other symbols
    """
    value = as_expr(value).subs(known)
    letters = sorted(value.free_symbols, key=str)
    return float(value.xreplace({letter: Float(0.6 + 0.07 * i) for i, letter in enumerate(letters)}).evalf())


def plus(a: Vector, b: Vector, times: float = 1.0) -> Vector:
    return a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def size_of(a: Vector) -> float:
    return sqrt(dot(a, a))


def unit(a: Vector) -> Vector:
    """Return the unit vector along a vector; zero for a zero vector."""
    size = size_of(a)
    return (a[0] / size, a[1] / size, a[2] / size) if size > 0 else a


def angle_of(a: Vector, b: Vector) -> float:
    """Return the angle between two vectors, from 0 to pi."""
    return acos(max(-1.0, min(1.0, dot(unit(a), unit(b)))))


def across(a: Vector) -> tuple[Vector, Vector]:
    """Return two unit vectors u and v such that u, v and the direction `a` are perpendicular and right-handed."""
    n = unit(a)
    helper: Vector = (0.0, 0.0, 1.0) if abs(n[2]) < 0.9 else (1.0, 0.0, 0.0)
    u = unit(cross(helper, n))
    return u, cross(n, u)


def rim(centre: Vector, radius: float, normal: Vector) -> list[Vector]:
    """Return the points of a circle perpendicular to `normal`; the last point is equal to the first."""
    u, v = across(normal)
    angles = [2 * pi * i / STEPS for i in range(STEPS + 1)]
    return [plus(plus(centre, u, radius * cos(t)), v, radius * sin(t)) for t in angles]


def mean(places: list[Vector]) -> Vector:
    x, y, z = (sum(place[k] for place in places) / len(places) for k in range(3))
    return x, y, z


def direction(start: Spot, end: Spot) -> Spot:
    """Return the unit vector from one spot on the paper to another; upwards if the spots coincide."""
    x, y = end[0] - start[0], end[1] - start[1]
    size = hypot(x, y)
    return (x / size, y / size) if size > 1e-9 else (0.0, 1.0)


def midway(a: Spot, b: Spot) -> Spot:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def hull(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """Return the convex hull of spots, counterclockwise, by Graham's scan."""
    first = min(spots, key=lambda s: (s[1], s[0]))
    rest = sorted(
        {s for s in spots if s != first},
        key=lambda s: (atan2(s[1] - first[1], s[0] - first[0]), hypot(s[0] - first[0], s[1] - first[1])),
    )
    outline = [first]
    for spot in rest:
        while len(outline) > 1 and _turns_right(outline[-2], outline[-1], spot):
            outline.pop()
        outline.append(spot)
    return tuple(outline)


def is_within(spot: Spot, corners: Sequence[Spot]) -> bool:
    """Return whether a spot is inside an outline. A horizontal line from the spot to the right then crosses the outline
    an odd number of times."""
    x, y = spot
    if not (min(c[0] for c in corners) < x < max(c[0] for c in corners)):
        return False
    met = 0
    for (a, b), (c, d) in pairwise([*corners, corners[0]]):
        if (b > y) != (d > y) and x < a + (y - b) / (d - b) * (c - a):
            met += 1
    return met % 2 == 1


def _turns_right(a: Spot, b: Spot, c: Spot) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 1e-12


@dataclass(frozen=True)
class Stance:
    """A parallel projection: the directions in space that are right and up on the paper, and towards the viewer."""

    right: Vector
    up: Vector
    eye: Vector

    def spot(self, place: Vector) -> Spot:
        return dot(place, self.right), dot(place, self.up)
