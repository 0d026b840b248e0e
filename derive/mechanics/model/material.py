"""Material points: the particle at a given place of a body, and the motion of this particle.

A place need not move with a particle: the point of contact of a rolling ball moves along the floor, but no particle of
the ball does. A force on a body acts on the particle that is at the place of the force.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

from sympy import Expr, ImmutableDenseMatrix, Symbol

from derive.algebra.expressions import stand_in
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import PlacedBody, after
from derive.mechanics.kinematics.places import Axes, Location

Vector: TypeAlias = tuple[Expr, ...]
Held: TypeAlias = tuple[tuple[Symbol, Expr], ...]
GROUND, MASSLESS = "ground", "massless"


@dataclass(frozen=True)
class MaterialPoint:
    """A particle of a body: its place, with symbols for the constant position of the particle in the body.

    place   the components of the place; the symbols are constant when the components are differentiated
    held    pairs of a symbol and its value; the values are substituted after differentiation
    """

    place: Vector
    held: Held = ()

    @property
    def values(self) -> dict[Symbol, Expr]:
        return dict(self.held)


def particle_of(body: PlacedBody, at: Location) -> MaterialPoint:
    """The particle of a rigid body at a place: its path is r(q) + R(q) rho with constant rho = R^T (r_place - r)."""
    arm = ImmutableDenseMatrix((at - body.at).components)
    names = [stand_in(f"rho_{i}") for i in range(len(arm))]
    turn = body.turned.in_space if isinstance(body.turned, Axes) else after(((2, body.turned),))[:2, :2]
    carried = turn * ImmutableDenseMatrix(names)
    place = tuple(a + b for a, b in zip(body.at.components, carried, strict=True))
    return MaterialPoint(place, tuple(zip(names, turn.T * arm, strict=True)))


def at_rest_in(axes: Axes, at: Location) -> MaterialPoint:
    """The particle of a surface at a place; the surface, such as a turntable, is at rest in the given axes."""
    arm = axes.in_space.T * ImmutableDenseMatrix(at.components)
    names = [stand_in(f"rho_{i}") for i in range(len(arm))]
    return MaterialPoint(tuple(axes.in_space * ImmutableDenseMatrix(names)), tuple(zip(names, arm, strict=True)))


def material_point(verb: str, of: Any, at: Location) -> MaterialPoint:
    """The material point on which a force at a place acts.

    of   the object on which the force acts. For a placed body, the result is the particle of the body at `at`. For a
         particle, the result is this particle, even if it is not at `at`. For None or "massless", the result is a
         point that moves with `at`
    """
    if of is None or of == MASSLESS:
        return MaterialPoint(at.components)
    if isinstance(of, PlacedBody):
        return particle_of(of, at)
    if hasattr(of, "mass") and isinstance(getattr(of, "at", None), Location):
        return MaterialPoint(of.at.components)
    message = f"`{verb}` must act on a particle or on a body that is placed or held"
    help_line = Spelled(
        'give the particle or the body as `of=`, or write `of="massless"`',
        "name the particle or the body, `of: ball`, or write `of: massless`",
    )
    raise Rejected(Complaint("wrong-argument", message, help=help_line))
