"""What a quantity says of the body and the points that it belongs to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from derive.mechanics.bodies.regions import Point
from derive.steps.step import Fact


@dataclass(frozen=True)
class OfBody(Fact):
    """The body that a tensor belongs to: whatever has mass points and integrates over its mass."""

    missing = "belongs to no body"
    body: Any


@dataclass(frozen=True)
class AboutPoint(Fact):
    """The point that a tensor or an angular momentum is about."""

    missing = "is about no point"
    point: Point


@dataclass(frozen=True)
class CountedFrom(Fact):
    """The point that a place is counted from."""

    start: Point
