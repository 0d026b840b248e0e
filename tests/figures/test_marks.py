"""A class of marks that a test defines is drawn, described and encoded like the other marks."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from sympy import Symbol

from derive.algebra.expressions import column
from derive.figures import drawing, outline
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import InWords, Mark, Position
from derive.figures.pieces import Paper, Piece, Stroke
from derive.page.depiction import alternative
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.drawing.camera import Numbers, best_stance, stance_from
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from tests.courses import ROOT
from tests.figures.scenery import CONE, a, pieces_of, plane, strokes


@dataclass(frozen=True)
class Spring(Mark):
    start: Position
    end: Position
    turns: int

    @property
    def ends(self) -> tuple[Position, ...]:
        return self.start, self.end

    @property
    def directions(self) -> tuple[Position, ...]:
        return (self.end - self.start,)

    def pieces(self, paper: Paper) -> list[Piece]:
        (x, y), (u, v) = paper.spots(*(paper.numbers.vector(end) for end in self.ends))
        parts = [i / self.turns for i in range(self.turns + 1)]
        return [Stroke(tuple((x + (u - x) * t, y + (v - y) * t + i % 2) for i, t in enumerate(parts)), "thin")]

    def in_words(self) -> InWords:
        return "body", {"name": "a spring", "measures": (("length", self.label),)}


SPRING = Spring(column(0, 0, 0), column(a, 0, 0), 6, label=Symbol("l"), keys=("stretch",))


def test_a_mark_of_ones_own_is_drawn_and_fills_the_drawing() -> None:
    (stroke,) = strokes(pieces_of(plane(SPRING)), "thin")
    assert len(stroke.spots) == 7
    (x, y), (u, v) = stroke.spots[0], stroke.spots[-1]
    assert abs(hypot(u - x, v - y) - 5 * 72 / 2.54) < 0.1


def test_a_mark_of_ones_own_is_told_and_kept() -> None:
    found = drawing("one", outline(CONE), SPRING)
    assert list(drawings_from_data(drawings_to_data([found]))) == [found]
    assert found.keys == ("stretch",)
    assert a in found.letters
    assert Symbol("l") not in found.letters
    told = inline_text(alternative(None, found, None, phrases(templates_of(ROOT))), Notation())
    assert "a spring of length l" in told


def test_one_looks_so_that_the_direction_of_a_mark_is_seen() -> None:
    towards_the_eye = Spring(column(0, 0, 0), column(a, 0, 0), 6)
    turned = best_stance(drawing("one", outline(CONE), towards_the_eye), Numbers({a: 1.0}))
    assert hypot(turned.right[0], turned.up[0]) > 1.5 * hypot(stance_from(25, 18).right[0], stance_from(25, 18).up[0])
