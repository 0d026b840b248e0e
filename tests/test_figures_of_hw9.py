"""The printed figures of the homework: each quantity that a statement names has its letter, and nothing covers a
label."""

from __future__ import annotations

import json
from functools import cache
from itertools import combinations, pairwise
from math import hypot
from typing import Any

import pytest

from derive.algebra.expressions import explicit
from derive.building.drawings import HEIGHT, WIDTH, numbers_of
from derive.course.problem import Problem
from derive.figures.annotations import Cone
from derive.figures.marks import Drawing
from derive.figures.pieces import Piece, Stroke, Tag
from derive.page.depiction import placement_of
from derive.render.drawing.camera import Numbers
from derive.render.drawing.canvas import labels_of, sheet_of
from derive.render.drawing.picture import picture
from derive.render.notation.notation import Notation
from tests.courses import ROOT, rendered_once, solved_once

PROBLEMS = ("euler", "block", "top", "cone", "slab")
CM = 72 / 2.54
BESIDE_TEXT, HIGH = 0.45 * 17.0, 6.0  # centimetres
IMPORTANT = {"edge", "asked", "given", "rod", "bar", "ground", "angle", "turn", "spring"}
NAMED = {  # quantities that a statement names, as labels of its figure
    "euler": {"x", "y", "z", "omega", "L"},
    "block": {"x", "y", "z", "a", "2*a", "3*a", "omega"},
    "top": {"x", "y", "z", "Z", "phi", "theta", "psi", "a", "a/2", "C", "M*g"},
    "cone": {"x", "y", "z", "R", "h", "C"},
    "slab": {"x", "y", "O", "C", "R", "a", "theta", "g"},
}


@cache
def figures(name: str) -> tuple[Problem, dict[str, tuple[Drawing, str]]]:
    """Return the drawings of a problem except plots, each with the part next to which it appears."""
    problem, solved = solved_once(ROOT, f"hw9/{name}")
    placed = json.loads(rendered_once(ROOT, f"hw9/{name}", only={"json"}).texts["json"])["drawings"]
    where = {each["key"]: each["at"] for each in placed}
    return problem, {d.key: (d, where[d.key]) for d in solved.drawings if isinstance(d, Drawing) and d.key in where}


def drawn(problem: Problem, drawing: Drawing) -> list[Piece]:
    placement = placement_of(problem, drawing.key)
    width = (placement.width if placement else None) or WIDTH
    return picture(drawing, Numbers(numbers_of(problem, placement, drawing)), width, width * HEIGHT / WIDTH)


def spots_of(stroke: Stroke) -> list[tuple[float, float]]:
    """Return a spot for each typographic point along a line."""
    found: list[tuple[float, float]] = []
    for (x, y), (u, v) in pairwise(stroke.spots):
        steps = max(1, round(hypot(u - x, v - y)))
        found += [(x + (u - x) * i / steps, y + (v - y) * i / steps) for i in range(steps + 1)]
    return found


def inside(extent: Any, spot: tuple[float, float]) -> bool:
    left, below, right, above = extent
    return bool(left + 0.5 < spot[0] < right - 0.5 and below + 0.5 < spot[1] < above - 0.5)


@pytest.mark.parametrize("name", PROBLEMS)
def test_all_that_a_statement_names_has_its_letter_in_the_figure_beside_it(name: str) -> None:
    problem, found = figures(name)
    shown = [drawing for drawing, at in found.values() if at == "statement"]
    letters = {str(p.label) for drawing in shown for p in drawn(problem, drawing) if isinstance(p, Tag)}
    assert NAMED[name] <= letters


@pytest.mark.parametrize("name", PROBLEMS)
def test_no_label_covers_another_or_a_line_that_counts(name: str) -> None:
    problem, found = figures(name)
    for drawing, _ in found.values():
        pieces = drawn(problem, drawing)
        labels = labels_of(pieces, Notation())
        for one, other in combinations(labels, 2):
            (a, b, c, d), (e, f, g, h) = one.extent, other.extent
            assert c <= e or g <= a or d <= f or h <= b, (drawing.key, one.label, other.label)
        lines = [spot for p in pieces if isinstance(p, Stroke) and p.pen in IMPORTANT for spot in spots_of(p)]
        for label in labels:
            assert not any(inside(label.extent, spot) for spot in lines), (drawing.key, label.label)


@pytest.mark.parametrize("name", PROBLEMS)
def test_a_figure_has_room_beside_the_text(name: str) -> None:
    problem, found = figures(name)
    for drawing, _ in found.values():
        sheet = sheet_of(drawn(problem, drawing), Notation(), "")
        assert sheet.width < BESIDE_TEXT * CM, drawing.key
        assert sheet.height < HIGH * CM, drawing.key


def test_what_is_asked_is_in_no_figure_of_a_statement() -> None:
    _, found = figures("block")
    assert {key: at for key, (_, at) in found.items()} == {"axes": "statement", "vectors": "d"}
    _, found = figures("slab")
    assert found["forces"][1] != "statement"


def test_the_tip_of_the_angular_momentum_of_the_block_goes_round_the_axis() -> None:
    _, found = figures("block")
    (cone,) = [mark for mark in found["vectors"][0].marks if isinstance(mark, Cone)]
    axis, momentum = explicit(cone.axis), explicit(cone.value)
    assert [13 * entry / momentum[0] for entry in momentum] == [13, 20, 15]
    assert [entry / axis[0] for entry in axis] == [1, 2, 3]
