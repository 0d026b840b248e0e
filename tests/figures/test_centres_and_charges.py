"""Tests of central forces, nails, charges with their fields, accelerated supports, and tables with a hole."""

from __future__ import annotations

from pathlib import Path

from sympy import symbols

from derive.figures.annotations import PointMark
from derive.figures.parts import ConnectionMark, ParticleMark, RopeBelowMark, RopeMark
from derive.figures.pieces import Patch, Stroke, Tag
from derive.figures.surfaces import TableMark
from derive.figures.surroundings import FieldMark, FixedEnd, MovingEnd, WayMark
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from tests.figures.test_connected import drawings, library, of_class

M, m, q, a, r = symbols("M m q a r", positive=True)


def test_a_centre_of_force_is_a_point_or_a_particle_with_its_mass(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    (tmp_path / "two").mkdir()
    alone = drawings(tmp_path / "one", library("planet_canonical"))["system"]
    assert [len(of_class(alone, kind)) for kind in (ParticleMark, PointMark, WayMark)] == [1, 1, 1]
    sun = drawings(tmp_path / "two", library("kepler"))["system"]
    assert {mark.label for mark in of_class(sun, ParticleMark)} == {m, M}
    assert (len(of_class(sun, PointMark)), len(of_class(sun, WayMark))) == (0, 1)


def test_a_spring_that_turns_on_a_table_is_fixed_to_a_nail(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("oscillator_2d"))["system"]
    assert not of_class(drawn, FixedEnd)
    assert [list(mark.at) for mark in of_class(drawn, PointMark)] == [[0, 0]]


def test_a_charge_is_written_next_to_the_mass_and_its_fields_start_at_one_point(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("drift"))["system"]
    (ion,) = of_class(drawn, ParticleMark)
    assert (str(ion.label), str(ion.charge)) == ("m", "q")
    paper = OnPaper(Numbers(dict.fromkeys(drawn.letters, 1.0)), FLAT, 60.0)
    (tag,) = (piece for piece in ion.pieces(paper) if isinstance(piece, Tag))
    assert [str(part) for part in tag.label] == ["m", ", ", "q"]
    starts = [
        piece.spots[0]
        for field in of_class(drawn, FieldMark)
        for piece in field.pieces(paper)
        if isinstance(piece, Stroke)
    ]
    assert len(starts) == 2 and starts[0] == starts[1]
    assert len([mark for mark in of_class(drawn, ConnectionMark) if mark.label is None]) == 3


def test_the_acceleration_of_a_support_is_the_label_of_its_arrow(tmp_path: Path) -> None:
    (support,) = of_class(drawings(tmp_path, library("elevator"))["system"], MovingEnd)
    assert str(support.motion) == "a"


def test_a_pivot_that_rises_hangs_from_a_ceiling_and_any_other_moving_pivot_is_on_a_slider(tmp_path: Path) -> None:
    for name, is_on_slider in (("elevator", False), ("shaken_pendulum", True)):
        drawing = drawings(tmp_path, library(name))["system"]
        (support,) = of_class(drawing, MovingEnd)
        paper = OnPaper(Numbers(dict.fromkeys(drawing.letters, 1.0)), FLAT, 60.0)
        pieces = support.pieces(paper)
        assert any(isinstance(piece, Patch) for piece in pieces) == is_on_slider


def test_a_table_hides_the_string_below_its_hole(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("table_with_hole"))["system"]
    (table,) = of_class(drawn, TableMark)
    (below,) = of_class(drawn, RopeBelowMark)
    ropes = [mark for mark in of_class(drawn, RopeMark) if mark is not below]
    assert len(ropes) == 1 and below.layer < table.layer < ropes[0].layer
