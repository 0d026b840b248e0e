"""What a drawing is made of on paper, and what a mark may ask of the paper on which it is drawn.

These few pieces are all that `derive.render.drawing` knows: a mark says of itself which of them it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from derive.figures.space import Spot, Vector


@dataclass(frozen=True)
class Stroke:
    """A line on paper, drawn with one of the pens of `derive.render.drawing.canvas`, perhaps with heads at its ends."""

    spots: tuple[Spot, ...]
    pen: str
    head: bool = False
    tail: bool = False


@dataclass(frozen=True)
class Patch:
    """A surface on paper that hides what is drawn before it."""

    spots: tuple[Spot, ...]


@dataclass(frozen=True)
class Bullet:
    """A point on paper."""

    spot: Spot

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


@dataclass(frozen=True)
class Tag:
    """A label: what it says, the spot that it belongs to, the side on which it would best stand."""

    label: Any
    spot: Spot
    towards: Spot
    gap: float = 3.0

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


Piece: TypeAlias = Stroke | Patch | Bullet | Tag
Edge: TypeAlias = tuple[int, int]  # two corners, by their places in a list
Lengths: TypeAlias = tuple[tuple[Any, tuple[Edge, ...]], ...]  # a name, and the edges that are of this length


class Numbers(Protocol):
    """The values of expressions, by the numbers of their letters."""

    def of(self, expr: Any) -> float: ...

    def vector(self, column: Any) -> Vector: ...


class Paper(Protocol):
    """What a mark needs to be drawn: numbers, the direction to the eye, points per unit of length, the body's size, the
    places that say how large it is; spots for places; and the outlines of surfaces, which hide what is behind them.
    """

    @property
    def numbers(self) -> Numbers: ...

    @property
    def eye(self) -> Vector: ...

    @property
    def scale(self) -> float: ...

    @property
    def reach(self) -> float: ...

    @property
    def fixed(self) -> tuple[Vector, ...]: ...

    def spot(self, place: Vector) -> Spot: ...

    def spots(self, *places: Vector) -> tuple[Spot, ...]: ...

    def polyhedron(
        self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: Lengths
    ) -> list[Piece]: ...

    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]: ...
