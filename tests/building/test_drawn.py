"""The files of drawings: which numbers they are drawn with, when they are drawn anew, where a fault is told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Symbol

from derive.algebra.expressions import column
from derive.building import drawn
from derive.building.cache import NO_CACHE, Cache
from derive.building.drawn import drawing_files, numbers_of
from derive.course.placement import Placement
from derive.course.problem import Problem, load_problem
from derive.errors import Complaint, Place, Rejected
from derive.figures.annotations import Arrow
from derive.figures.marks import Drawing
from derive.page.wording import Text, phrases
from derive.render.notation.notation import Notation
from tests.courses import ROOT, course_in

HERE = Place("problems/hw9/block.yaml", 3, 1, "vectors:", 8)


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> Problem:
    return load_problem(course_in(tmp_path_factory.mktemp("course")), "hw9/block")


def letters(**kinds: str) -> dict[str, Any]:
    return {name: SimpleNamespace(symbol=Symbol(name, positive=True), kind=kind) for name, kind in kinds.items()}


def numbers(problem: Any, *values: tuple[Any, Any]) -> dict[str, float]:
    placement = Placement("vectors", HERE, values=values) if values else None
    return {letter.name: number for letter, number in numbers_of(problem, placement).items()}


def test_a_letter_has_its_own_number_or_a_stand_in_of_its_kind() -> None:
    declared = letters(a="length", b="length", m="mass")
    known = SimpleNamespace(symbols=declared, amounts={declared["m"].symbol: 7})
    assert numbers(known) == {"a": 1.0, "b": 1.5, "m": 7.0}


def test_what_a_drawing_says_of_its_letters_goes_before() -> None:
    declared = letters(a="length", b="length", c="length")
    a, b, c = (each.symbol for each in declared.values())
    known = SimpleNamespace(symbols=declared, amounts={a: 7, b: 2})
    assert numbers(known, (a, a - a + 4)) == {"a": 4.0, "b": 2.0, "c": 3.0}
    assert numbers(known, (c, 2 * b + a)) == {"a": 7.0, "b": 2.0, "c": 11.0}


def files_of(problem: Problem, cache: Cache, length: int = 1, alt: str = "") -> dict[str, bytes]:
    shown = SimpleNamespace(key="vectors", stem="block-vectors", alt=(Text(alt),))
    arrow = Arrow(column(0, 0, 0), column(length, 0, 0), 1)
    page: Any = SimpleNamespace(illustrations=(shown,))
    words = phrases(ROOT / "templates")
    return dict(drawing_files(problem, [Drawing("vectors", (arrow,))], page, words, Notation({}), cache))


@pytest.fixture
def drawings(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Each drawing made notes itself here, and says in its files the how manieth it is."""
    made: list[str] = []

    def draw(*_: object) -> SimpleNamespace:
        made.append("drawn")
        return SimpleNamespace(pdf=b"pdf %d" % len(made), svg=b"svg %d" % len(made))

    monkeypatch.setattr(drawn, "_drawn", draw)
    return made


def test_a_drawing_is_two_files_and_is_made_once(problem: Problem, drawings: list[str], tmp_path: Path) -> None:
    first = files_of(problem, Cache(tmp_path))
    assert first == {"block-vectors.pdf": b"pdf 1", "block-vectors.svg": b"svg 1"}
    assert files_of(problem, Cache(tmp_path)) == first
    assert len(drawings) == 1


@pytest.mark.parametrize(
    "change",
    [
        lambda problem, cache: files_of(problem, cache, length=2),
        lambda problem, cache: files_of(problem, cache, alt="other words"),
        lambda problem, cache: files_of(problem, Cache(cache.folder, fresh=True)),
        lambda problem, _: files_of(problem, NO_CACHE),
    ],
)
def test_a_drawing_that_shows_or_says_something_else_is_made_anew(
    problem: Problem, drawings: list[str], tmp_path: Path, change: Callable[[Problem, Cache], Any]
) -> None:
    files_of(problem, Cache(tmp_path))
    change(problem, Cache(tmp_path))
    assert len(drawings) == 2


def test_one_file_that_is_lost_makes_both_anew(problem: Problem, drawings: list[str], tmp_path: Path) -> None:
    files_of(problem, Cache(tmp_path))
    next(tmp_path.iterdir()).unlink()
    assert set(files_of(problem, Cache(tmp_path)).values()) == {b"pdf 2", b"svg 2"}


def test_what_cannot_be_drawn_is_told_where_the_problem_asks_for_it(
    problem: Problem, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise Rejected(Complaint("drawing", "the sides are negative"))

    monkeypatch.setattr(drawn, "_drawn", refuse)
    with pytest.raises(Rejected) as caught:
        files_of(problem, NO_CACHE)
    place = caught.value.complaints[0].place
    assert place
    assert place.text.strip() == "vectors:"
