"""The pieces of which a mark consists (lines, areas, points and labels), and `Paper`, which gives a mark
the numbers, the projection and the scale for its pieces.

`derive.render.drawing` draws these pieces only.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

from derive.figures.space import NOUGHT, Spot, Stance, Vector, plus, size_of


@dataclass(frozen=True)
class Stroke:
    """A line on the paper, drawn with a pen of `derive.render.drawing.canvas`.

    head   whether there is an arrowhead at the end of the line
    tail   whether there is an arrowhead at the start of the line
    """

    spots: tuple[Spot, ...]
    pen: str
    head: bool = False
    tail: bool = False


@dataclass(frozen=True)
class Patch:
    """A surface on the paper that hides earlier pieces; `fill` is a colour of `derive.render.drawing.canvas`."""

    spots: tuple[Spot, ...]
    fill: str = "blank"


@dataclass(frozen=True)
class Bullet:
    """A point on the paper, drawn as a disc; `size` is its radius in points."""

    spot: Spot
    size: float = 1.6
    fill: str = "line"

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


@dataclass(frozen=True)
class Tag:
    """A label near a spot.

    towards   the direction from the spot to the label
    gap       the distance between the spot and the label, in points
    way       for the label of a line, a vector along the line. The label may be shifted by at most 0.6 of this vector,
              in either direction, and it may be on the other side of the line
    on        whether the label is on the spot; then it may be shifted by `towards` or in the opposite direction, if
              the spot is occupied
    round     for the symbol of an angle: the vertex and the arc; the symbol is between the lines or just
              outside the arc
    outside   for a label on a block: if the block has no room, the label is outside the block at this distance from the
              spot, in points
    """

    label: Any
    spot: Spot
    towards: Spot
    gap: float = 3.0
    way: Spot | None = None
    on: bool = False
    outside: float = 0.0
    round: tuple[Spot, tuple[Spot, ...]] | None = None

    @property
    def spots(self) -> tuple[Spot, ...]:
        return (self.spot,)


Piece: TypeAlias = Stroke | Patch | Bullet | Tag
Edge: TypeAlias = tuple[int, int]  # two corners, by their indices in a list
EdgeNames: TypeAlias = tuple[tuple[Any, tuple[Edge, ...]], ...]  # pairs of a label and the edges with this label


class InNumbers(Protocol):
    """The interface of an object that evaluates expressions, with numbers for their symbols."""

    def of(self, expr: Any) -> float: ...

    def vector(self, column: Any) -> Vector: ...

    def along(self, column: Any, letter: Any, ends: tuple[Any, Any], steps: int) -> list[Vector]: ...


@dataclass(frozen=True)
class Paper(ABC):
    """The data from which a mark computes its pieces, and methods that return the pieces of solids.

    numbers   the object that evaluates expressions
    stance    the projection onto the paper
    scale     points on the paper per unit of length
    reach     the size of the bodies: the greatest distance of `fixed` from `middle`
    middle    the centre of the box around the bodies
    fixed     the outermost points of the bodies
    drawn     spots that are already in use, for the last layer of marks
    """

    numbers: InNumbers
    stance: Stance
    scale: float = 1.0
    reach: float = 1.0
    middle: Vector = NOUGHT
    fixed: tuple[Vector, ...] = field(default=(), repr=False)
    drawn: tuple[Spot, ...] = field(default=((0.0, 0.0),), repr=False)

    @property
    def is_of_a_point(self) -> bool:
        """Whether all bodies are at one point, as in the force diagram of a particle."""
        return all(size_of(plus(place, self.middle, -1.0)) < 1e-9 * self.reach for place in self.fixed)

    def spot(self, place: Vector) -> Spot:
        right, up = self.stance.spot(place)
        return right * self.scale, up * self.scale

    def spots(self, *places: Vector) -> tuple[Spot, ...]:
        return tuple(self.spot(place) for place in places)

    @abstractmethod
    def polyhedron(self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: EdgeNames) -> list[Piece]:
        """Return the pieces of a solid with flat faces, with labels at some edges.

        Each face is a sequence of indices in `corners`.
        """

    @abstractmethod
    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]:
        """Return the pieces of a solid of revolution, given by circles from one end to the other."""
