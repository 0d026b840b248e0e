"""Dashed outlines of the bodies of a system at another value of one coordinate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sympy import Expr

from derive.algebra.expressions import as_expr
from derive.errors import Complaint, Rejected
from derive.figures.marks import InWords, Mark, Position, Surface
from derive.figures.parts import BOB
from derive.figures.pieces import Bullet, InNumbers, Paper, Patch, Piece, Stroke
from derive.figures.placed_bodies import placed_outline, with_its_shape
from derive.figures.positions import name_of
from derive.figures.space import Vector
from derive.mechanics.model.system import System

__all__ = ["dashed_at"]


@dataclass(frozen=True)
class Ghost(Surface):
    """The dashed outline of a surface for another value of a coordinate.

    of              the surface at the other value
    letter, value   the coordinate and its other value; None if several coordinates differ
    """

    of: Surface = None  # type: ignore[assignment]
    letter: Any = None
    value: Any = None

    def places(self, numbers: InNumbers) -> list[Vector]:
        return self.of.places(numbers)

    def pieces(self, paper: Paper) -> list[Piece]:
        patches = [piece for piece in self.of.pieces(paper) if isinstance(piece, Patch)]
        return [Stroke((*patch.spots, patch.spots[0]), "trace") for patch in patches]

    def in_words(self) -> InWords | None:
        if not self.of.name:
            return None
        return "ghost", {"name": self.of.name, "letter": self.letter, "value": self.value}


@dataclass(frozen=True)
class HollowParticle(Surface):
    """A particle at its initial position, as a hollow disc."""

    at: Position

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.at)]

    def pieces(self, paper: Paper) -> list[Piece]:
        spot = paper.spot(*self.places(paper.numbers))
        return [Bullet(spot, BOB, "ink"), Bullet(spot, 0.8 * BOB, "blank")]

    def in_words(self) -> InWords | None:
        return None


def dashed_at(system: System, values: Mapping[Any, Any]) -> list[Mark]:
    """Return dashed outlines of the bodies of a system for another value of one coordinate, such as its value at
    equilibrium.

    values   the coordinate and its other value: `{theta: 0}`
    """
    known: dict[Any, Expr] = {name_of(None, letter): as_expr(value) for letter, value in values.items()}
    if len(known) != 1 or not known.keys() <= {*system.coordinates}:
        raise Rejected(Complaint("wrong-argument", "`dashed_at` needs one coordinate of the system and its value"))
    ((letter, value),) = known.items()
    shown = [mark for body in system.bodies for mark in placed_outline(with_its_shape(body.moved(known)))]
    return [Ghost(of=mark, letter=letter, value=value) for mark in shown if isinstance(mark, Surface)]
