"""Facts that link a quantity to a body and its points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sympy import Symbol

from derive.mechanics.bodies.regions import Point, Region
from derive.steps.step import Fact


@dataclass(frozen=True)
class OfBody(Fact):
    """The body to which an inertia tensor belongs; the distribution of mass in this body is known."""

    missing = "does not belong to a body"
    body: Any


@dataclass(frozen=True)
class AboutPoint(Fact):
    """The point of reference of a tensor or an angular momentum."""

    missing = "is not about a point"
    point: Point


@dataclass(frozen=True)
class CountedFrom(Fact):
    """The point from which a place is measured."""

    start: Point


@dataclass(frozen=True)
class Integrated(Fact):
    """The variables of an evaluated integral: the result, such as a volume, no longer depends on them."""

    missing = "is not an integral over a body"
    eliminates: tuple[Symbol, ...]

    @classmethod
    def over(cls, region: Region) -> Integrated:
        return cls(region.names)
