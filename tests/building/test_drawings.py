"""The files of drawings: which numbers they are drawn with, when they are drawn anew, where a fault is told."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from math import isqrt
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Integer, Symbol

from derive.algebra.dimensions import dimension
from derive.algebra.expressions import column
from derive.building import drawings as files
from derive.building.cache import NO_CACHE, Cache
from derive.building.drawings import POINTS_PER_CM, WIDE, WIDTH, drawing_files, numbers_of
from derive.building.set_document import problem_document
from derive.building.sets import Options, built_set
from derive.building.solution import rendered
from derive.building.tex import chosen_engine, typeset
from derive.course.placement import Placement
from derive.course.problem import Problem, load_problem
from derive.course.problem_set import problem_set
from derive.errors import Complaint, Place, Rejected
from derive.figures import drawing, point_mark
from derive.figures.annotations import Arrow
from derive.figures.marks import Drawing
from derive.page.template import templates_of
from derive.page.wording import Text, phrases
from derive.render.drawing import lettering
from derive.render.drawing.lettering import Lettered, letters_of
from derive.render.notation.notation import Notation
from derive.render.rendered import Rendered
from tests.building.test_derivations import forbid_deriving
from tests.courses import ROOT, course_in, rendered_once

CAPTION = "  vectors:\n"
MASS = dimension(1, 0, 0)
HERE = Place("problems/hw9/block.yaml", 3, 1, "vectors:", 8)
FILES = ["block-axes.pdf", "block-axes.svg", "block-vectors.pdf", "block-vectors.svg"]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Rendered:
    return rendered_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block", draws=True)


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> Problem:
    return load_problem(course_in(tmp_path_factory.mktemp("course")), "hw9/block")


SHAPE = files.HEIGHT / files.WIDTH


def letters(**kinds: str) -> dict[str, Any]:
    return {name: SimpleNamespace(symbol=Symbol(name, positive=True), kind=kind) for name, kind in kinds.items()}


def numbers(problem: Any, *values: tuple[Any, Any]) -> dict[str, float]:
    placement = Placement("vectors", HERE, values=values) if values else None
    return {letter.name: number for letter, number in numbers_of(problem, placement).items()}


def test_a_letter_has_its_own_number_or_a_stand_in_of_its_kind() -> None:
    declared = letters(a="length", b="length", m="mass")
    known = SimpleNamespace(symbols=declared, assumed=(), amounts={declared["m"].symbol: 7})
    assert numbers(known) == {"a": 1.0, "b": 1.5, "m": 7.0}


def test_what_a_drawing_says_of_its_letters_goes_before() -> None:
    declared = letters(a="length", b="length", c="length")
    a, b, c = (each.symbol for each in declared.values())
    known = SimpleNamespace(symbols=declared, assumed=(), amounts={a: 7, b: 2})
    assert numbers(known, (a, a - a + 4)) == {"a": 4.0, "b": 2.0, "c": 3.0}
    assert numbers(known, (c, 2 * b + a)) == {"a": 7.0, "b": 2.0, "c": 11.0}


def files_of(
    problem: Problem,
    cache: Cache,
    length: Any = 1,
    alt: str = "",
    label: Any = None,
    kinds: Mapping[Any, Any] | None = None,
) -> dict[str, bytes]:
    shown = SimpleNamespace(key="vectors", stem="block-vectors", alt=(Text(alt),), at="a")
    arrow = Arrow(column(0, 0, 0), column(length, 0, 0), 1, label=label)
    page: Any = SimpleNamespace(illustrations=(shown,))
    words = phrases(templates_of(ROOT))
    return dict(drawing_files(problem, [Drawing("vectors", (arrow,))], page, words, Notation(kinds or {}), cache))


@pytest.fixture
def drawings(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    made: list[str] = []

    def draw(*_: object) -> tuple[SimpleNamespace, SimpleNamespace]:
        made.append("drawn")
        return SimpleNamespace(pdf=b"pdf %d" % len(made)), SimpleNamespace(svg=b"svg %d" % len(made))

    monkeypatch.setattr(files, "_drawn", draw)
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


def test_what_is_said_of_a_letter_makes_those_drawings_anew_that_have_it(
    problem: Problem, drawings: list[str], tmp_path: Path
) -> None:
    a, b, c = (Symbol(name, positive=True) for name in "abc")

    def is_made_anew(said: Symbol | None = None, kinds: Mapping[Any, Any] | None = None) -> bool:
        before = len(drawings)
        own = Placement("vectors", HERE, values=((said, Integer(7)),) if said else ())
        files_of(replace(problem, drawings=(own,)), Cache(tmp_path), length=a, label=a * b, kinds=kinds)
        return len(drawings) > before

    assert is_made_anew()
    assert not is_made_anew(c) and is_made_anew(a)
    assert not is_made_anew(a, {c: MASS}) and is_made_anew(a, {b: MASS})


def test_each_letter_is_set_once_in_each_font(
    problem: Problem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    a, b = (Symbol(name, positive=True) for name in "ab")
    made: list[str] = []

    def noted(texts: Collection[str], font: str) -> dict[str, Lettered]:
        made.extend(f"{text} {font}" for text in texts)
        return letters_of(texts, font)

    monkeypatch.setattr(lettering, "letters_of", noted)
    for length, label in ((1, a), (-1, a), (1, b), (2, b)):
        assert files_of(problem, Cache(tmp_path), length=length, label=label)
    assert made == ["$a$ cm", "$a$ stix", "$b$ cm", "$b$ stix"]
    kept = files_of(problem, Cache(tmp_path), length=-1, label=a)
    assert kept == files_of(problem, NO_CACHE, length=-1, label=a)


def test_a_file_that_is_lost_makes_both_anew(problem: Problem, drawings: list[str], tmp_path: Path) -> None:
    files_of(problem, Cache(tmp_path))
    next(tmp_path.iterdir()).unlink()
    assert set(files_of(problem, Cache(tmp_path)).values()) == {b"pdf 2", b"svg 2"}


def test_what_cannot_be_drawn_is_told_where_the_problem_asks_for_it(
    problem: Problem, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise Rejected(Complaint("drawing", "the sides are negative"))

    monkeypatch.setattr(files, "_drawn", refuse)
    with pytest.raises(Rejected) as caught:
        files_of(problem, NO_CACHE)
    place = caught.value.complaints[0].place
    assert place
    assert place.text.strip() == "vectors:"


def test_each_drawing_is_a_pdf_and_an_svg(block: Rendered) -> None:
    files = dict(block.files)
    assert list(files) == FILES
    assert files["block-axes.pdf"].startswith(b"%PDF")
    assert b"<title>A drawing in space of a block" in files["block-axes.svg"]


def test_an_edit_of_the_given_redraws_and_one_of_the_words_does_not(
    tmp_path: Path, block: Rendered, monkeypatch: pytest.MonkeyPatch
) -> None:
    course, kept = course_in(tmp_path), Cache(tmp_path / "kept")
    assert rendered(course, "hw9/block", None, kept, draws=True).files == block.files
    file = course / "problems" / "hw9" / "block.yaml"
    file.write_text(file.read_text().replace("points: 10", "points: 10\nnote: words"))
    with monkeypatch.context() as patch:
        forbid_deriving(patch)
        patch.setattr(files, "_drawn", lambda *_: pytest.fail("drawn again"))
        assert rendered(course, "hw9/block", None, kept, draws=True).files == block.files
    file.write_text(file.read_text().replace("[a, 2*a, 3*a]", "[a, 2*a, 2*a]"))
    changed = dict(rendered(course, "hw9/block", None, kept, draws=True).files)
    assert all(changed[name] != content for name, content in block.files)


def test_a_kept_drawing_that_was_altered_is_drawn_again(tmp_path: Path, block: Rendered) -> None:
    course, kept = course_in(tmp_path), Cache(tmp_path / "kept")
    rendered(course, "hw9/block", None, kept, draws=True)
    sheets = [file for file in (tmp_path / "kept").iterdir() if b"%PDF-" in file.read_bytes()]
    assert len(sheets) == 2
    sheets[0].write_bytes(sheets[0].read_bytes().replace(b"%%EOF", b"%%EOG"))
    sheets[1].write_bytes(b"[]")
    assert rendered(course, "hw9/block", None, kept, draws=True).files == block.files


def test_a_width_and_numbers_of_its_own_change_only_that_drawing(tmp_path: Path, block: Rendered) -> None:
    edits = {CAPTION: CAPTION + "    width: 3 cm\n"}
    changed = dict(rendered_once(course_in(tmp_path, edits), "hw9/block", draws=True).files)
    same = {name for name, content in block.files if changed[name] == content}
    assert same == {"block-axes.pdf", "block-axes.svg"}


def test_a_build_writes_the_drawings_beside_the_page_and_fixes_them(tmp_path: Path) -> None:
    course = course_in(tmp_path)

    def build() -> list[str]:
        report = built_set(course, "hw9", Options(), lambda _: None)
        assert not report.failed, report.complaints
        return sorted(path.name for path in report.changed)

    outputs = course / "build" / "hw9"
    assert set(FILES) < set(build())
    assert (outputs / "block.pdf").read_bytes().count(b"/Subtype /Form") >= 2
    assert build() == []
    (outputs / FILES[0]).unlink()
    assert build() == [FILES[0]]
    script = course / "problems" / "hw9" / "block.py"
    script.write_text(script.read_text().replace('drawing("axes"', 'drawing("edges"'))
    assert "block-edges.pdf" in build()
    assert not (outputs / FILES[0]).exists(), "a drawing that is gone leaves no file"


def test_a_tex_source_compiles_where_it_lies_and_without_its_drawings(tmp_path: Path, block: Rendered) -> None:
    root = course_in(tmp_path)
    tex = problem_document(root, block, problem_set(root, "hw9"))
    pages = {}
    for name, included in (("with", block.files), ("without", ())):
        target = tmp_path / f"{name}.pdf"
        typeset(tex, target, chosen_engine(None), included=included)
        pages[name] = target.read_bytes()
    assert pages["with"] != pages["without"]


def test_a_view_of_its_own_changes_only_that_drawing(tmp_path: Path, block: Rendered) -> None:
    edits = {CAPTION: CAPTION + "    view: {azimuth: 60, elevation: 40}\n"}
    found = rendered_once(course_in(tmp_path, edits), "hw9/block", draws=True)
    same = {name for name, content in block.files if dict(found.files)[name] == content}
    assert same == {"block-axes.pdf", "block-axes.svg"} and not found.warnings


def many_labels(count: int, **more: Any) -> Drawing:
    side = isqrt(count)
    marks = [point_mark(column(5 * (i % side), 4 * (i // side), 0), label=Symbol(f"p_{i}")) for i in range(count)]
    return replace(drawing("points", marks, view="plane"), **more)


@pytest.mark.parametrize(("count", "width", "cm"), [(4, None, WIDTH), (36, None, WIDE), (36, WIDTH, WIDTH)])
def test_a_drawing_with_many_labels_is_larger_unless_its_author_chooses_the_width(
    count: int, width: float | None, cm: float
) -> None:
    sheet, _ = files._drawn(many_labels(count, values=()), {}, Notation(), None, (width, SHAPE), "", NO_CACHE)
    assert sheet.labels == count
    assert sheet.width / POINTS_PER_CM == pytest.approx(cm, abs=1.2)


def test_the_author_chooses_the_width_of_a_force_diagram() -> None:
    alone = replace(many_labels(4), body_size=20.0)
    small, _ = files._drawn(alone, {}, Notation(), None, (None, SHAPE), "", NO_CACHE)
    wide, _ = files._drawn(alone, {}, Notation(), None, (9.0, SHAPE), "", NO_CACHE)
    assert small.width < 3 * POINTS_PER_CM < 8 * POINTS_PER_CM < wide.width
