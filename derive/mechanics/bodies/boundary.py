"""The boundary of a body: a geometric shape, described by places in body axes. A drawing projects this boundary.

The `boundary` of a body is one of these records. It is None if no record describes the body, for example if the body
consists of parts, or if only its moments are known.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain
from typing import TypeAlias

from sympy import Add, Expr, Rational, Symbol, pi
from sympy.matrices import ImmutableMatrix

from derive.mechanics.bodies.regions import Bounds
from derive.steps.step import is_zero

# a formula for the places of a curve, the variable in this formula, and the first and the last value of the variable
Curve: TypeAlias = tuple[ImmutableMatrix, Symbol, Expr, Expr]


@dataclass(frozen=True)
class Round:
    """All places between two heights, at a distance of at most `radius_at(z)` from the z axis.

    is_curve   whether the mass is on a curve: on the axis, or on one circle
    """

    ends: tuple[Expr, Expr]
    radius_at: Callable[[Expr], Expr]
    is_curve: bool = False

    @property
    def is_straight(self) -> bool:
        """Whether the radius is a linear function of z."""
        z = Symbol("z_along", real=True)
        return bool(self.radius_at(z).diff(z, 2) == 0)

    @property
    def is_flat(self) -> bool:
        return bool(self.ends[0] == self.ends[1])

    @property
    def is_closed(self) -> bool:
        """Whether the radius is zero at both ends."""
        return all(self.radius_at(end) == 0 for end in self.ends)

    @property
    def is_line(self) -> bool:
        """Whether all places are on the axis."""
        return self.is_straight and self.is_closed


@dataclass(frozen=True)
class Faces:
    """One flat face or several.

    corners   the positions of the corners
    faces     the indices of the corners of each face, in order round the face; empty for a single face
    edges     the lengths that a drawing shows, each with the edges of this length, as pairs of indices
    """

    corners: tuple[ImmutableMatrix, ...]
    faces: tuple[tuple[int, ...], ...] = ()
    edges: tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...] = ()


@dataclass(frozen=True)
class Segment:
    """A straight line between two places."""

    start: ImmutableMatrix
    end: ImmutableMatrix


@dataclass(frozen=True)
class Rim:
    """The closed edge of a flat body in the plane of x and y.

    curves   the curves of the edge, in order
    radius   the ends and the length of the straight line that a drawing labels with this length; None if no line has a
             label
    """

    curves: tuple[Curve, ...]
    radius: tuple[ImmutableMatrix, ImmutableMatrix, Expr] | None = None

    def places(self, steps: int) -> list[ImmutableMatrix]:
        """Distinct places along the edge, from this number of equal steps along each curve."""
        found = chain.from_iterable(_along(curve, steps) for curve in self.curves)
        return list(dict.fromkeys(found))


@dataclass(frozen=True)
class Extruded:
    """A solid whose cross-section is a flat figure in the plane of x and y, extended along z."""

    section: Boundary


@dataclass(frozen=True)
class Ellipsoidal:
    """An ellipsoid about the origin with its axes along the body axes."""

    semi_axes: tuple[Expr, Expr, Expr]


@dataclass(frozen=True)
class Toroidal:
    """A ring of round cross-section about the z axis.

    radius    the distance from the axis to the middle of the cross-section
    section   the radius of the cross-section
    """

    radius: Expr
    section: Expr


@dataclass(frozen=True)
class Hollowed:
    """A round body from which a smaller round body about the same axis is removed."""

    whole: Round
    removed: Round


Boundary: TypeAlias = Round | Faces | Segment | Rim | Extruded | Ellipsoidal | Toroidal | Hollowed


def of_map(place: ImmutableMatrix, limits: Bounds) -> Boundary | None:
    """The boundary of a position map, if it can be found from the form of the map. It is then a straight line, the
    closed edge of a flat body in the plane of x and y, or an ellipsoid.

    Return None for every other map, for example if the limits of a flat body are not constant.
    """
    if len(limits) == 1 and is_zero(place.diff(limits[0][0], 2)):
        u, *ends = limits[0]
        start, end = (place.xreplace({u: at}) for at in ends)
        return Segment(start, end)
    if len(limits) == 2 and [x == 0 for x in place] == [False, False, True]:
        return _rim(place, limits)
    return _stretched_ball(place, limits)


def _rim(place: ImmutableMatrix, limits: Bounds) -> Rim | None:
    """The edge: the curves on which one variable is at a limit. Return None if a limit contains a variable, or
    if there is a hole."""
    if any(end.free_symbols & {x for x, *_ in limits} for _, *ends in limits for end in ends):
        return None
    (u, *u_ends), (v, *v_ends) = limits
    sides = (
        (u, u_ends[0], v, v_ends),
        (v, v_ends[1], u, u_ends),
        (u, u_ends[1], v, v_ends[::-1]),
        (v, v_ends[0], u, u_ends[::-1]),
    )
    curves = [(place.xreplace({held: end}), letter, first, last) for held, end, letter, (first, last) in sides]
    # If both limits of one variable give the same curve, this curve is a seam, not an edge. The limits of the other
    # variable then give the edge, or the edge and a hole.
    seamless = [curves[k::2] for k in (0, 1) if curves[1 - k] == _reversed(curves[3 - k])]
    lines = [[each] for each in seamless[0] if _is_long(each)] if seamless else [curves]
    return Rim(tuple(lines[0])) if len(lines) == 1 else None


def _along(curve: Curve, steps: int) -> list[ImmutableMatrix]:
    place, letter, first, last = curve
    return [place.xreplace({letter: first + (last - first) * Rational(k, steps)}) for k in range(steps + 1)]


def _reversed(curve: Curve) -> Curve:
    place, letter, first, last = curve
    return place, letter, last, first


def _is_long(curve: Curve) -> bool:
    return len(set(_along(curve, 3))) > 1


def _stretched_ball(place: ImmutableMatrix, limits: Bounds) -> Ellipsoidal | None:
    """The ellipsoid of a map that scales a ball of radius 1, in spherical coordinates, along each axis; None for any
    other map."""
    if [tuple(ends) for _, *ends in limits] != [(0, 1), (0, pi), (0, 2 * pi)]:
        return None
    r, *angles = (letter for letter, *_ in limits)
    (a, x), (b, y), (c, z) = ((entry / r).as_independent(r, *angles, as_Add=False) for entry in place)
    is_ball = is_zero(Add(*(each**2 for each in (x, y, z))) - 1) and all(size.is_positive for size in (a, b, c))
    return Ellipsoidal((a, b, c)) if is_ball else None
