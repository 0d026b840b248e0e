"""Bodies: a region of space filled with mass, its density, its centre of mass and its named directions.

Lengths in the unit of the sides, axes along the edges, origin at the corner from which the edges start.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import product
from operator import mul
from typing import Any

from sympy import Expr, Integer, Integral, MatMul, Pow, Rational, Symbol, Tuple
from sympy.matrices import ImmutableMatrix

from derive.errors import Complaint, Rejected
from derive.expressions import Factors, MassIntegral, Ratio, column, scalar, vector
from derive.mechanics.direction import Direction
from derive.step import Level, Quantity, compared_with, establish

Limits = tuple[tuple[Symbol, Expr, Expr], ...]


@dataclass(frozen=True)
class Point:
    """A named point of a body, in the body's own axes."""

    name: str
    position: ImmutableMatrix


@dataclass(frozen=True)
class Cuboid:
    """A uniform block. Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.

    sides   three lengths, along x, y and z
    mass    mass
    """

    sides: tuple[Expr, Expr, Expr]
    mass: Expr

    @property
    def volume(self) -> Expr:
        return reduce(mul, self.sides, Integer(1))

    @property
    def corner(self) -> Point:
        return Point("corner", column(0, 0, 0))

    @property
    def middle(self) -> Point:
        return Point("centre", column(*(side / 2 for side in self.sides)))

    def point(self, name: str) -> Point:
        points = {"corner": self.corner, "centre": self.middle}
        if name not in points:
            known = ", ".join(f'"{known}"' for known in points)
            raise Rejected(Complaint("no-such-point", f'a cuboid has no point "{name}"', help=f"it has {known}"))
        return points[name]

    @cached_property
    def density(self) -> Quantity:
        return density(self)

    @cached_property
    def centre(self) -> Quantity:
        return centre_of_mass(self)

    def limits(self, origin: ImmutableMatrix) -> Limits:
        """Limits of x, y, z measured from a point, outermost first."""
        names = (scalar(axis) for axis in "xyz")
        return tuple((name, -start, side - start) for name, side, start in zip(names, self.sides, origin, strict=True))

    def integral(self, integrand: Expr, origin: ImmutableMatrix) -> Integral:
        """The volume integral of a function of x, y, z measured from a point, not yet carried out."""
        return Integral(integrand, *reversed(self.limits(origin)))

    def mass_integral(self, integrand: Any, origin: ImmutableMatrix, density: Expr) -> MassIntegral:
        """The integral of f(r) dm, f written with the name r."""
        limits = self.limits(origin)
        position = column(*(name for name, _, _ in limits))
        inward = [Tuple(*limit) for limit in reversed(limits)]
        return MassIntegral(integrand, vector("r"), density, position, Integer(1), *inward)

    def particles(self) -> list[tuple[Expr, ImmutableMatrix]]:
        """Six equal particles, at the centres of the faces, with the block's mass, centre and second moments.

        Two of them, at +-side/2, give 2 (M/6)(side/2)^2 = M side^2/12. No integral is used, so what is computed from
        them checks what is computed by integrals. Source: Routh, *Elementary Rigid Dynamics*, ch. 1 (equimomental
        bodies).
        """
        found = []
        for axis, end in product(range(3), (0, 1)):
            place = [side * (Rational(1, 2) if k != axis else end) for k, side in enumerate(self.sides)]
            found.append((self.mass / 6, column(*place)))
        return found

    def direction(self, axis: Direction) -> Quantity:
        """A vector along the axis: a named edge, the long diagonal, or given components."""
        edges = {name: column(*(int(name == other) for other in "xyz")) for name in "xyz"}
        named: Mapping[str, ImmutableMatrix] = {**edges, "diagonal": column(*self.sides)}
        if axis.name is not None and axis.name not in named:
            raise Rejected(
                Complaint("no-such-axis", f"a cuboid has no axis `{axis.name}`", help="use diagonal, x, y or z")
            )
        along = named[axis.name] if axis.name is not None else column(*(axis.components or ()))
        return axis_vector(along, axis.name or "components")


def axis_vector(along: ImmutableMatrix, name: str) -> Quantity:
    """A vector d along the axis of rotation: a definition. Source: none needed."""
    return establish(
        "bodies.axis_vector",
        vector("d"),
        lambda: along,
        {},
        outcome="edge" if name in {"x", "y", "z"} else name,
        definition=True,
        words={"axis": name},
    )


def density(body: Cuboid) -> Quantity:
    """Density of a uniform body, rho = M/V.

    body    mass M, volume V
    Second route: the integral of rho over the body gives M back.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 4.2.
    """
    sides = _gathered(body.sides)
    return establish(
        "bodies.density",
        Symbol("rho", positive=True),
        lambda mass: Ratio(mass, sides),
        {"mass": body.mass},
        routes={"mass_given_back": lambda rho: (body.integral(rho, body.corner.position), body.mass)},
        kind="density",
    )


def _gathered(sides: tuple[Expr, ...]) -> Expr:
    """A cube's volume is written a^3, a block's a * 2a * 3a."""
    if len(set(sides)) == 1:
        return Pow(sides[0], len(sides))
    return Factors(*sides)


def centre_of_mass(body: Cuboid) -> Quantity:
    """Centre of mass, r_C = (1/M) integral of r dm, from the corner.

    body    mass, region
    Second route: the mean position of the block's equimomental particles.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """
    rho = body.density
    whole = body.mass_integral(vector("r"), body.corner.position, rho.symbol)

    def mean_of_particles() -> Any:
        total = column(0, 0, 0)
        for mass, place in body.particles():
            total = total + mass * place
        return total / body.mass

    return establish(
        "bodies.centre_of_mass",
        vector("r_C"),
        lambda mass: MatMul(Pow(mass, -1), whole, evaluate=False),
        {"mass": body.mass},
        routes={"particles": compared_with(mean_of_particles)},
        parents=[rho],
        kind="length",
        put_in=Level.FULL,
        context={"point": body.middle},
    )
