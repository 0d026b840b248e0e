"""Springs between blocks, beads on straight wires, and the arrows of motors."""

from __future__ import annotations

import pytest

from derive.figures.annotations import Turn
from derive.figures.parts import BLOCK, ConnectionMark, SpringMark
from derive.figures.pieces import Tag
from derive.figures.surroundings import DistanceMark
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from tests.courses import library_drawings
from tests.figures.test_connected import of_class

PAPER = OnPaper(Numbers({}), FLAT, 60.0)


def test_the_turns_of_a_spring_are_between_the_blocks_at_its_ends() -> None:
    drawn = library_drawings("three_masses")["system"]
    first, second, *_ = springs = of_class(drawn, SpringMark)
    half = BLOCK[0] / 2
    assert [spring.covered for spring in springs] == [(0, half), (half, half), (half, half), (half, 0)]
    paper = OnPaper(Numbers(dict.fromkeys(drawn.letters, 1.0)), FLAT, 60.0)
    spots = second.pieces(paper)[0].spots
    assert spots[1][0] - spots[0][0] > half and spots[-1][0] - spots[-2][0] > half
    assert len(first.pieces(paper)[0].spots) > 6


def test_the_distance_along_a_straight_wire_has_a_dimension_line() -> None:
    drawn = library_drawings("turning_wire")["system"]
    assert [str(mark.label) for mark in of_class(drawn, DistanceMark)] == ["r"]
    assert list(of_class(drawn, DistanceMark)[0].aside) == [0, 0, -1]  # the angle from the vertical is above the wire
    assert not [mark for mark in of_class(drawn, ConnectionMark) if mark.label is not None]


def test_the_torque_of_a_motor_is_on_the_side_away_from_its_arm() -> None:
    (turn,) = of_class(library_drawings("driven_arm")["system"], Turn)
    paper = OnPaper(Numbers(dict.fromkeys(turn.middle.free_symbols, 0.5)), FLAT, 60.0)
    x, y = paper.spot(paper.numbers.vector(turn.middle))
    (tag,) = (piece for piece in turn.pieces(paper) if isinstance(piece, Tag))
    assert tag.towards[0] * y == pytest.approx(tag.towards[1] * x, abs=0.5) and tag.towards[0] < 0 > tag.towards[1]
