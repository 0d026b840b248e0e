"""Equimomental particles: together they have the mass, the centre of mass and the second moments of a body.

The particles of a standard shape need no integral. They come from a known set of particles, from slices weighted by a
quadrature rule that is exact for the powers that occur, or from known second moments.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce
from operator import add
from typing import Any, ClassVar

from sympy import Expr, ImmutableDenseMatrix, Integer, Matrix, Rational, cancel, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Cross, Dot, column, explicit
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.regions import Point
from derive.steps.step import Route, is_zero

Particles = list[tuple[Expr, ImmutableMatrix]]

HALF = Rational(1, 2)

# Nodes from 0 to 1 with their weights: Simpson's rule is exact up to third powers, Boole's rule up to fifth powers.
SIMPSON = ((Integer(0), Rational(1, 6)), (Rational(1, 2), Rational(2, 3)), (Integer(1), Rational(1, 6)))
BOOLE = tuple((Rational(k, 4), Rational(w, 90)) for k, w in enumerate((7, 32, 12, 32, 7)))


def summed(particles: Iterable[tuple[Expr, ImmutableMatrix]], of: Callable[[ImmutableMatrix], Any]) -> Any:
    """The sum of mass times a function of the place; the value of the function is a number, a vector or a tensor."""
    return reduce(add, (mass * of(place) for mass, place in particles))


def counted_from(point: Point, place: ImmutableMatrix) -> ImmutableMatrix:
    """A place relative to a point, by projections on the axes of the point.

    This function does not use the code of the integrals, so particles can check the integrals.
    """
    way = [place[j] - point.position[j] for j in range(3)]
    return column(*(sum(point.axes[j, k] * way[j] for j in range(3)) for k in range(3)))


class OfParticles:
    """A base class of bodies with equimomental particles."""

    is_of_particles: ClassVar[bool] = True  # whether the particles are found without an integral

    def particles(self) -> Particles:
        """Particles with the mass, centre of mass and second moments of the body. If `is_of_particles` is true, they
        are found without integrals, so they can check integrals.

        Source: Routh, *Dynamics of a System of Rigid Bodies*, elementary part, chapter 1.
        """
        raise AttributeError(f"{type(self).__name__} must define its equimomental particles")

    def another_way(
        self, integrand: Callable[[ImmutableMatrix], Any], point: Point, of: Callable[[Any], Any] = lambda found: found
    ) -> dict[str, Route]:
        """A second route to the integral of f(r) dm, where f is at most quadratic in the position r from a point.

        integrand   the function f of the position
        of          a function that extracts this integral from a result
        """

        def by_particles(found: Any) -> tuple[Any, Any]:
            return of(found), summed(self.particles(), lambda r: explicit(integrand(counted_from(point, r))))

        return {"particles": by_particles}


def squared_distance(r: Any, n: Any) -> Any:
    """|n x r|^2: the squared distance of r from an axis through the origin along the unit vector n."""
    arm = Cross(n, r)
    return Dot(arm, arm)


def tensor_at(r: Any) -> ImmutableMatrix:
    """r.r 1 - r r: the inertia tensor of a unit mass at r."""
    square = sum((x**2 for x in r), Integer(0))
    return ImmutableDenseMatrix(3, 3, lambda i, j: square * int(i == j) - r[i] * r[j])


def disc_of_particles(mass: Expr, radius: Expr, height: Expr) -> Particles:
    """A disc perpendicular to the z axis: half of the mass at the centre, an eighth at each end of two perpendicular
    diameters."""
    return [(mass / 2, column(0, 0, height)), *ring_of_particles(mass / 2, radius, height)]


def ring_of_particles(mass: Expr, radius: Expr, height: Expr) -> Particles:
    """A ring perpendicular to the z axis: a quarter of the mass at each end of two perpendicular diameters."""
    rim = ((radius, 0), (-radius, 0), (0, radius), (0, -radius))
    return [(mass / 4, column(x, y, height)) for x, y in rim]


def on_diameters(mass: Expr, radius: Expr) -> Particles:
    """Six equal particles at the ends of three perpendicular diameters of a sphere about the origin."""
    along = ([radius * int(k == axis) for k in range(3)] for axis in range(3))
    return [(mass / 6, ImmutableDenseMatrix(sign * column(*end))) for end in along for sign in (1, -1)]


def sliced(
    mass: Expr,
    ends: tuple[Expr, Expr],
    radius: Callable[[Expr], Expr],
    weight: Callable[[Expr], Expr],
    slice_of: Callable[[Expr, Expr, Expr], Particles] = disc_of_particles,
) -> Particles:
    """Slices perpendicular to the z axis at the nodes of Boole's rule. The mass of a slice is proportional to `weight`
    times the weight of its node in this rule.

    radius   the radius of the slice at z
    weight   the mass of the slice at z per length, up to a constant factor; for a solid, the squared radius
    """
    low, high = ends
    at = [(low + part * (high - low), share) for part, share in BOOLE]
    total = sum((share * weight(z) for z, share in at), Integer(0))
    found: Particles = []
    for z, share in at:
        part = cancel(mass * share * weight(z) / total)
        if part != 0:
            found += slice_of(part, radius(z), z)
    return found


def drawn_out(flat: Particles, ends: tuple[Expr, Expr]) -> Particles:
    """Particles for a flat body that is extended evenly along z: copies of its particles at both ends and in the
    middle. Their masses have the weights of Simpson's rule, which is exact up to third powers of z."""
    low, high = ends
    return [
        (share * mass, column(place[0], place[1], low + part * (high - low)))
        for part, share in SIMPSON
        for mass, place in flat
    ]


def stretched(particles: Iterable[tuple[Expr, ImmutableMatrix]], by: tuple[Expr, Expr, Expr]) -> Particles:
    """The same particles, with their coordinates along each axis scaled by these factors."""
    return [(mass, column(*(x * s for x, s in zip(place, by, strict=True)))) for mass, place in particles]


def without(whole: Particles, removed: Particles) -> Particles:
    """The particles of a body from which another body is removed; the particles of the removed body have negative
    mass."""
    return [*whole, *((-mass, place) for mass, place in removed)]


def from_moments(
    mass: Expr,
    centre: ImmutableMatrix,
    second: ImmutableMatrix | None = None,
    about_origin: tuple[Expr, Expr, Expr] = (Integer(0),) * 3,
) -> Particles:
    """Pairs of particles about the centre of mass, with given second moments.

    second         S_ij, the sums of m x_i x_j about the centre of mass
    about_origin   in place of `second`, for a body without products of inertia: the sums of m x^2, m y^2 and m z^2
                   about the origin

    A Cholesky decomposition gives S = sum of D_k l_k l_k^T. For each k, a pair of particles with the total mass D_k/L^2
    is at +-L l_k from the centre of mass, where L^2 is the trace of S divided by the mass. The rest of the mass is at
    the centre of mass.
    Source: Routh, *Dynamics of a System of Rigid Bodies*, elementary part, chapter 1.
    """
    left = Matrix(second) if second is not None else Matrix.diag(*about_origin) - mass * centre * centre.T
    trace = tidied(left.trace())
    if is_zero(trace):
        return [(mass, ImmutableDenseMatrix(centre))]
    reach, found, spent = sqrt(trace / mass), [], Integer(0)
    for k in range(3):
        pivot = left[k, k]
        if is_zero(pivot):
            continue
        along = (left[:, k] / pivot).applyfunc(tidied)
        left = (left - pivot * along * along.T).applyfunc(tidied)
        share = tidied(mass * pivot / trace)
        spent += share
        found += [(share / 2, ImmutableDenseMatrix(centre + sign * reach * along)) for sign in (1, -1)]
    rest = tidied(mass - spent)
    return found if rest == 0 else [*found, (rest, ImmutableDenseMatrix(centre))]
