"""Positions by their components along fixed axes: formulas in coordinates, constants and time."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, atan2, cos, eye, pi, sin
from sympy.matrices import ImmutableMatrix

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, as_expr
from derive.errors import Complaint, Rejected, Unverified
from derive.steps.step import Quantity, value_behind

__all__ = ["Axes", "Location", "X", "Y", "Z", "point", "space", "t"]


@dataclass(frozen=True)
class Location:
    """A position, or a displacement between two positions: two components in a plane, or three in space, in m.

    components   the components along fixed axes; the last axis points upwards
    found        pairs (index, step) for the components that a step has derived
    """

    components: tuple[Expr, ...]
    found: tuple[tuple[int, Quantity], ...] = field(default=(), compare=False)

    def __add__(self, other: Any) -> Location:
        if not isinstance(other, Location):
            return NotImplemented
        if len(other.components) != len(self.components):
            message = "one place has two components and the other has three"
            raise Rejected(Complaint("wrong-argument", message, help="give all places in a plane, or all in space"))
        return Location(tuple(a + b for a, b in zip(self.components, other.components, strict=True)))

    def __mul__(self, factor: Any) -> Location:
        return NotImplemented if isinstance(factor, Location) else Location(tuple(factor * c for c in self.components))

    def __neg__(self) -> Location:
        return Location(tuple(-c for c in self.components))

    def __sub__(self, other: Location) -> Location:
        return self + -other

    __rmul__ = __mul__

    def with_values(self, values: Any) -> Location:
        """Return the position with values substituted for symbols; the same object if nothing changes."""
        moved = tuple(c.subs(values) for c in self.components)
        return self if moved == self.components else Location(moved)

    def turned(self, angle: Any) -> Location:
        """Return the displacement rotated in its plane; a positive angle rotates counterclockwise."""
        if len(self.components) != 2:
            message = "`turned` rotates a displacement in a plane, but this one has three components"
            raise Rejected(Complaint("wrong-argument", message, help="for axes in space use `space.turned(Z, phi)`"))
        (x, y), c, s = self.components, cos(0 + angle), sin(0 + angle)
        return Location((x * c - y * s, x * s + y * c))

    @property
    def height(self) -> Expr:
        return self.components[-1]


def point(*components: Any) -> Location:
    """Return the position (x, y) in a vertical plane, with y upwards, or (x, y, z) in space, with z upwards, in m.

    A component may be a step, such as a result of `components`. Laws then show the symbol of this step in heights and
    velocities.
    """
    if len(components) not in (2, 3):
        raise Rejected(Complaint("wrong-argument", f"`point` needs two components or three, not {len(components)}"))
    found = tuple((i, c) for i, c in enumerate(components) if isinstance(c, Quantity))
    try:
        return Location(tuple(as_expr(value_behind(c)) for c in components), found)
    except TypeError:
        raise Rejected(Complaint("wrong-argument", "`point` needs expressions, one for each component")) from None


def angle_of(direction: Location) -> Expr | None:
    """Return the angle of a unit vector in a plane, measured counterclockwise from the first axis; None if the angle is
    unknown."""
    x, y = direction.components
    if x.is_number and y.is_number:
        return atan2(y, x)
    inside = dict.fromkeys(each.args[0] for c in (x, y) for each in c.atoms(cos, sin))
    for angle, sign, quarters in product(inside, (1, -1), range(4)):
        found: Expr = sign * angle + quarters * pi / 2
        if equal(cos(found), x) and equal(sin(found), y):
            return found
    return None


X, Y, Z = point(1, 0, 0), point(0, 1, 0), point(0, 0, 1)


@dataclass(frozen=True)
class Axes:
    """Three perpendicular axes.

    in_space   a rotation matrix; its columns are the unit vectors of these axes, by components along the fixed axes
    turns      the rotations from the fixed axes to these axes, in order: pairs of the index of an axis and the angle

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.4.
    """

    in_space: ImmutableMatrix
    turns: tuple[tuple[int, Expr], ...] = ()

    def turned(self, about: Location, angle: Any) -> Axes:
        """Return these axes after a rotation about one of them, X, Y or Z.

        angle   a coordinate, a constant angle or `rate*t`
        """
        if about not in (X, Y, Z):
            message = "`turned` rotates axes about one of them: X, Y or Z"
            raise Rejected(Complaint("wrong-argument", message))
        i = (X, Y, Z).index(about)
        turned = Axes(ImmutableDenseMatrix(self.in_space * turn_about(i, angle)), (*self.turns, (i, 0 + angle)))
        _check_turned(self, turned, about, angle)
        return turned

    def place(self, *components: Any) -> Location:
        """Return the position with three given components along these axes, in m; all axes have the same origin."""
        if len(components) != 3:
            raise Rejected(Complaint("wrong-argument", f"`place` needs three components, not {len(components)}"))
        along = point(*components)
        found = self.in_space * ImmutableDenseMatrix(along.components)
        if not equal(ImmutableDenseMatrix(self.in_space.T * found), ImmutableDenseMatrix(along.components)):
            raise Unverified(Complaint("unverified", "`place`: the components along the axes are not the given ones"))
        return Location(tuple(found))


def turn_about(axis: int, angle: Any) -> ImmutableMatrix:
    """Return the matrix of a right-handed rotation about the first, second or third axis."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    c, s = cos(angle), sin(angle)
    turn = eye(3).as_mutable()
    turn[j, j], turn[j, k], turn[k, j], turn[k, k] = c, -s, s, c
    return ImmutableDenseMatrix(turn)


def _check_turned(before: Axes, after: Axes, about: Location, angle: Any) -> None:
    """Check a rotation by the angle a about the unit vector e with Rodrigues' formula.

    Each unit vector v of the old axes becomes v cos a + (e x v) sin a + e (e.v)(1 - cos a).
    """
    e = before.in_space * ImmutableDenseMatrix(about.components)
    for i in range(3):
        v = before.in_space[:, i]
        carried = v * cos(angle) + e.cross(v) * sin(angle) + e * e.dot(v) * (1 - cos(angle))
        if not equal(ImmutableDenseMatrix(after.in_space[:, i]), ImmutableDenseMatrix(carried)):
            raise Unverified(
                Complaint("unverified", "`turned`: the new axes are not the old axes rotated by the angle")
            )


space = Axes(ImmutableDenseMatrix(eye(3)))
t = TIME
