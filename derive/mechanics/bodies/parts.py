"""Parts of a larger body: for each part, the place of one of its points, its rotation, and whether the part is a
cavity."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, cos, eye, sin
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Cross, Dot, as_expr, column, explicit
from derive.errors import Complaint, Rejected, Unverified
from derive.steps.step import is_zero

NO_TURN = ImmutableDenseMatrix(eye(3))


@dataclass(frozen=True)
class PlacedPart:
    """A body as a part of a larger body.

    body       the part, as a body of its own
    of         the point of the part that stays fixed when the part is rotated
    position   the place of this point, in the axes of the larger body
    turn       rotation matrix; its columns are the axes of the part, by components along the axes of the larger body
    sign       1, or -1 for a cavity
    """

    body: Any
    of: str
    position: ImmutableMatrix
    turn: ImmutableMatrix = NO_TURN
    sign: int = 1

    def __post_init__(self) -> None:
        if not is_zero(self.turn.det() - 1):
            raise Unverified(Complaint("unverified", "the axes of a part are not rotated axes of the larger body"))

    @classmethod
    def as_it_lies(cls, body: Any) -> PlacedPart:
        return cls(body, body.reference, body.point(body.reference).position)

    def at(self, *place: Any, of: str = "centre") -> PlacedPart:
        """Return the same part with one of its points at a place: x, y or x, y, z, or one argument with these
        components, such as `point(x, y)`."""
        self.body.point(of)  # raises an error if the part has no such point
        return replace(self, position=place_of(*place), of=of)

    def turned(self, axis: Any, angle: Any) -> PlacedPart:
        """Return the same part, rotated right-handed by an angle about an axis through its fixed point. This axis is
        parallel to the axis "x", "y" or "z" of the larger body."""
        turn = turn_about(axis, angle)
        made = replace(self, turn=ImmutableDenseMatrix(turn * self.turn))
        if any(not is_zero(way) for way in turn.T * made.turn - self.turn):
            raise Unverified(Complaint("unverified", f"the reverse rotation about {axis} does not restore the part"))
        return made

    def named(self, called: str) -> PlacedPart:
        return replace(self, body=self.body.named(called))

    def seen(self, place: ImmutableMatrix) -> ImmutableMatrix:
        """A place of the part, converted from the axes of the part to the axes of the larger body."""
        held = self.body.point(self.of).position
        return ImmutableDenseMatrix((self.position + self.turn * (place - held)).expand())

    @property
    def centre(self) -> ImmutableMatrix:
        """The centre of mass of the part, in the axes of the larger body."""
        return self.seen(self.body.middle.position)

    @property
    def mass(self) -> Expr:
        signed: Expr = self.sign * self.body.mass
        return signed

    @property
    def particles(self) -> list[tuple[Expr, ImmutableMatrix]]:
        """The particles of the part, in the axes of the larger body; the particles of a cavity have negative mass.

        The particles are rotated and shifted without `seen`, so that they can check `seen`.
        """
        held = self.body.point(self.of).position
        shift = [self.position[i] - sum(self.turn[i, j] * held[j] for j in range(3)) for i in range(3)]
        turned = (
            (mass, [sum(self.turn[i, j] * place[j] for j in range(3)) for i in range(3)])
            for mass, place in self.body.particles()
        )
        return [(self.sign * mass, column(*(a + b for a, b in zip(way, shift, strict=True)))) for mass, way in turned]


def place_of(*place: Any) -> ImmutableMatrix:
    """A place in body axes; with two components it is in the plane of x and y."""
    if len(place) == 1:
        inside = getattr(place[0], "components", place[0])
        place = tuple(inside) if isinstance(inside, tuple | list) else place
    if len(place) not in (2, 3):
        message = f"a place must have two components or three, not {len(place)}"
        raise Rejected(Complaint("wrong-argument", message, help="write .at(x, y, z)"))
    return column(*(as_expr(x) for x in (*place, 0)[:3]))


def turn_about(axis: Any, angle: Any) -> ImmutableMatrix:
    """The matrix of a right-handed rotation about an axis."""
    named = {(1, 0, 0): "x", (0, 1, 0): "y", (0, 0, 1): "z"}.get(tuple(getattr(axis, "components", ())), axis)
    if named not in ("x", "y", "z"):
        raise Rejected(Complaint("no-such-axis", 'a rotation must be about "x", "y" or "z"'))
    i = "xyz".index(named)
    j, k = (i + 1) % 3, (i + 2) % 3
    turn = eye(3).as_mutable()
    turn[j, j], turn[j, k], turn[k, j], turn[k, k] = cos(angle), -sin(angle), sin(angle), cos(angle)
    if not turns_right_handed(turn, named, angle):
        raise Unverified(Complaint("unverified", f"the matrix does not rotate about {named} by {angle}"))
    return ImmutableDenseMatrix(turn)


def turns_right_handed(turn: Any, axis: Any, angle: Expr) -> bool:
    """Whether the matrix maps each unit vector v along an axis to v_parallel + v_perp cos(angle) + (n x v) sin(angle).
    Here n is the unit vector along the axis of rotation; v_parallel and v_perp are parallel and perpendicular to n."""
    n = column(*(int(axis == other) for other in "xyz"))
    for k in range(3):
        v = column(*(int(k == i) for i in range(3)))
        along = explicit(Dot(n, v)) * n
        if not is_zero(turn * v - along - (v - along) * cos(angle) - explicit(Cross(n, v)) * sin(angle)):
            return False
    return bool(axis in ("x", "y", "z"))


def name_of_body(called: str) -> str:
    """Return a name that keys and indices can contain: one or two words of lower-case letters; reject other names."""
    if not re.fullmatch(r"[a-z]+( [a-z]+)?", called):
        help_line = 'use one or two words of lower-case letters, such as "upper rod"'
        raise Rejected(Complaint("name", f"`{called}` is not a valid name for a body", help=help_line))
    return called
