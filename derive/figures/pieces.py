"""What a drawing is made of on paper, and what a mark may ask of the paper on which it is drawn.

These few pieces are all that `derive.render.drawing` knows: a mark says of itself which of them it is.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

from derive.figures.space import NOUGHT, Spot, Stance, Vector


@dataclass(frozen=True)
class Stroke:
    """A line on paper, drawn with one of the pens of `derive.render.drawing.canvas`, perhaps with heads at its ends."""

    spots: tuple[Spot, ...]
    pen: str
    head: bool = False
    tail: bool = False


@dataclass(frozen=True)
class Patch:
    """A surface on paper that hides what is drawn before it; `fill` is one of the colours of `drawing.canvas`."""

    spots: tuple[Spot, ...]
    fill: str = "blank"


@dataclass(frozen=True)
class Bullet:
    """A point on paper, as a disc of a size in points."""

    spot: Spot
    size: float = 1.6
    fill: str = "line"

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


@dataclass(frozen=True)
class Tag:
    """A label: what it says, the spot that it belongs to, the side on which it would best stand.

    way   of the label of a line: half of it, so that the label may slide along and stand on the other side
    on    whether it stands on the spot itself, or as far from it as `towards` and its opposite, if that is free
    """

    label: Any
    spot: Spot
    towards: Spot
    gap: float = 3.0
    way: Spot | None = None
    on: bool = False

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


Piece: TypeAlias = Stroke | Patch | Bullet | Tag
Edge: TypeAlias = tuple[int, int]  # two corners, by their places in a list
EdgeNames: TypeAlias = tuple[tuple[Any, tuple[Edge, ...]], ...]  # a name, and the edges that are of this length


class InNumbers(Protocol):
    """The values of expressions, by the numbers of their letters."""

    def of(self, expr: Any) -> float: ...

    def vector(self, column: Any) -> Vector: ...

    def along(self, column: Any, letter: Any, ends: tuple[Any, Any], steps: int) -> list[Vector]: ...


@dataclass(frozen=True)
class Paper(ABC):
    """What a mark needs to be drawn: numbers, the direction one looks from, points per unit of length, the size of the
    bodies, their middle and far ends; and outlines of surfaces, which hide what is behind them.
    """

    numbers: InNumbers
    stance: Stance
    scale: float = 1.0
    reach: float = 1.0
    middle: Vector = NOUGHT
    fixed: tuple[Vector, ...] = field(default=(), repr=False)
    drawn: tuple[Spot, ...] = field(default=((0.0, 0.0),), repr=False)  # where there is something already, for the last

    def spot(self, place: Vector) -> Spot:
        right, up = self.stance.spot(place)
        return right * self.scale, up * self.scale

    def spots(self, *places: Vector) -> tuple[Spot, ...]:
        return tuple(self.spot(place) for place in places)

    @abstractmethod
    def polyhedron(self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: EdgeNames) -> list[Piece]:
        """What has flat faces, each given by its corners, with names beside some of its edges."""

    @abstractmethod
    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]:
        """What is round about an axis, as circles from one end to the other."""
