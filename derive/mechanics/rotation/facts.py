"""Facts that results hand on besides their value, for the steps that rest on them."""

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
    """A steady rotation about a principal axis that is disturbed.

    axis    "x", "y" or "z"
    speed   its rate
    of      the rate of its angular momentum, of which each component vanishes
    """

    missing = "is not an equation of a disturbed rotation"
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
        """The two other axes, in right-handed order."""
        return (self.axis + 1) % 3, (self.axis + 2) % 3

    @property
    def steadily(self) -> dict[Symbol, Expr]:
        return {w: self.speed if k == self.axis else ZERO for k, w in enumerate(self.moving)}

    @cached_property
    def moments(self) -> tuple[Expr, ...]:
        """What the particles have before the angular acceleration about each axis."""
        torque = explicit(self.by_particles())
        return tuple(tidied(diff(torque[k], rate(w))) for k, w in enumerate(self.moving))


@dataclass(frozen=True)
class RateOfMomentum(Fact):
    """The rate of an angular momentum: by the particles of the body, and the components of omega that change."""

    missing = "is not the rate of an angular momentum"
    of: RateByParticles
    moving: tuple[Symbol, ...]

    def by_particles(self) -> Any:
        """The sum of m r x a."""
        return self.of.rate()


class RateByParticles(Fact):
    """The rate of change of a quantity of a body, without its equations of motion; each has its class."""

    missing = "is not made of particles"

    def rate(self) -> Any:
        """What the particles contribute, by their accelerations."""
        raise NotImplementedError

    def in_any_axes(self, torque: Any) -> Any:
        """The same for a torque, of a body whose tensor is not diagonal."""
        raise NotImplementedError
