"""Facts about rotation that results pass to later steps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from sympy import (
    Expr,
    Integer,
    Symbol,
    diff,
)

from derive.algebra.expressions import (
    explicit,
    rate,
)
from derive.algebra.tidy import tidied
from derive.steps.step import Fact

ZERO = Integer(0)


@dataclass(frozen=True)
class Disturbed(Fact):
    """A perturbed steady rotation about a principal axis.

    axis    the index of the axis: 0, 1 or 2 for x, y or z
    speed   the rate of the steady rotation
    of      the rate of the angular momentum; all its components vanish for the steady rotation
    """

    missing = "is not an equation of a perturbed rotation"
    axis: int
    speed: Expr
    of: RateOfMomentum

    @property
    def moving(self) -> tuple[Symbol, ...]:
        """The components of the angular velocity."""
        return self.of.moving

    def by_particles(self) -> Any:
        """The sum of m r x a."""
        return self.of.by_particles()

    @property
    def across(self) -> tuple[int, int]:
        """The indices of the two axes perpendicular to the axis of the rotation, in right-handed order."""
        return (self.axis + 1) % 3, (self.axis + 2) % 3

    @property
    def steadily(self) -> dict[Symbol, Expr]:
        return {w: self.speed if k == self.axis else ZERO for k, w in enumerate(self.moving)}

    @cached_property
    def moments(self) -> tuple[Expr, ...]:
        """The coefficients of the angular accelerations in the torque from the particles."""
        torque = explicit(self.by_particles())
        return tuple(tidied(diff(torque[k], rate(w))) for k, w in enumerate(self.moving))


@dataclass(frozen=True)
class RateOfMomentum(Fact):
    """The rate of an angular momentum.

    of       the same rate from the particles of the body
    moving   the components of omega, which change
    """

    missing = "is not the rate of an angular momentum"
    of: RateByParticles
    moving: tuple[Symbol, ...]

    def by_particles(self) -> Any:
        """The sum of m r x a."""
        return self.of.rate()


class RateByParticles(Fact):
    """The rate of change of a quantity of a body, without equations of motion. A subclass computes it for one quantity,
    such as the angular momentum."""

    missing = "is not derived from a body, so the accelerations of its particles are unknown"

    def rate(self) -> Any:
        """Return the rate from the accelerations of the particles of the body, as a sum or an integral over its
        mass."""
        raise NotImplementedError  # defined in subclasses; not abstract, so that `Quantity.fact` accepts the class

    def in_any_axes(self, torque: Any) -> Any:
        """Return the rate of a scalar if a torque acts; for a vector, the scalar product of the vector with its rate.
        The body axes are arbitrary, so the tensor may have products of inertia."""
        raise NotImplementedError  # defined in subclasses; not abstract, so that `Quantity.fact` accepts the class
