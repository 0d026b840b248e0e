"""The pieces of a drawing, and the interface `Paper` that a mark uses to be drawn.

`derive.render.drawing` draws only these pieces; each mark defines its own pieces.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

from derive.figures.space import NOUGHT, Spot, Stance, Vector


@dataclass(frozen=True)
class Stroke:
    """A line on paper, drawn with a pen of `derive.render.drawing.canvas`, with optional arrowheads at its ends."""

    spots: tuple[Spot, ...]
    pen: str
    head: bool = False
    tail: bool = False


@dataclass(frozen=True)
class Patch:
    """A surface on paper that hides earlier pieces; `fill` is one of the colours of `drawing.canvas`."""

    spots: tuple[Spot, ...]
    fill: str = "blank"


@dataclass(frozen=True)
class Bullet:
    """A point on paper, drawn as a disc with a size in points."""

    spot: Spot
    size: float = 1.6
    fill: str = "line"

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


@dataclass(frozen=True)
class Tag:
    """A label: its content, the spot to which it belongs, and its preferred side.

    way   for the label of a line, half of the line: the label may slide along it or change to its other side
    on    whether it is on the spot itself, or shifted by `towards` or its opposite, if these places are free
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
Edge: TypeAlias = tuple[int, int]  # two corners, by their indices in a list
EdgeNames: TypeAlias = tuple[tuple[Any, tuple[Edge, ...]], ...]  # a name, and the edges with this length


class InNumbers(Protocol):
    """The values of expressions, given numbers for their symbols."""

    def of(self, expr: Any) -> float: ...

    def vector(self, column: Any) -> Vector: ...

    def along(self, column: Any, letter: Any, ends: tuple[Any, Any], steps: int) -> list[Vector]: ...


@dataclass(frozen=True)
class Paper(ABC):
    """Everything that a mark needs to be drawn: numbers, the viewing direction, points per unit of length, and the
    size, centre and outermost places of the bodies. It draws the outlines of surfaces, which hide marks behind them.
    """

    numbers: InNumbers
    stance: Stance
    scale: float = 1.0
    reach: float = 1.0
    middle: Vector = NOUGHT
    fixed: tuple[Vector, ...] = field(default=(), repr=False)
    drawn: tuple[Spot, ...] = field(default=((0.0, 0.0),), repr=False)  # spots already in use, for the last marks

    def spot(self, place: Vector) -> Spot:
        right, up = self.stance.spot(place)
        return right * self.scale, up * self.scale

    def spots(self, *places: Vector) -> tuple[Spot, ...]:
        return tuple(self.spot(place) for place in places)

    @abstractmethod
    def polyhedron(self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: EdgeNames) -> list[Piece]:
        """A solid with flat faces, each given by its corners, with labels at some of its edges."""

    @abstractmethod
    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]:
        """A solid of revolution, as circles from one end to the other."""
