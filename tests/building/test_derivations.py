"""Steps kept between builds: taken again when only words change, and never when anything else does."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from derive.building import solution
from derive.building.cache import Cache
from derive.building.derivations import Solved, steps_key
from derive.building.solution import rendered
from derive.course.problem import load_problem
from derive.render.rendered import Rendered
from tests.courses import course_in


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return course_in(tmp_path)


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> tuple[Rendered, Path]:
    course = course_in(tmp_path_factory.mktemp("known"))
    page = rendered(course, "hw9/block", None, Cache(course / "kept"))
    return page, course / "kept" / steps_key(load_problem(course, "hw9/block"))


@pytest.fixture
def kept(course: Path, known: tuple[Rendered, Path]) -> Cache:
    (course / "kept").mkdir()
    shutil.copy(known[1], course / "kept")
    return Cache(course / "kept")


def change(course: Path, name: str, old: str, new: str) -> None:
    file = course / "problems" / "hw9" / name
    text = file.read_text()
    assert text.count(old) == 1
    file.write_text(text.replace(old, new))


def forbid_deriving(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("derived again")

    monkeypatch.setattr(solution, "run_solve", refuse)


def test_what_was_kept_gives_the_same_page(
    course: Path, kept: Cache, known: tuple[Rendered, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    forbid_deriving(monkeypatch)
    assert rendered(course, "hw9/block", None, kept) == known[0]


def test_new_words_need_no_new_derivation(course: Path, kept: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    change(course, "block.yaml", "title: A block turning", "title: A brick turning")
    change(course, "block.yaml", "answer: inertia_tensor\n    points: 3", "answer: inertia_tensor\n    points: 3.0")
    forbid_deriving(monkeypatch)
    assert "A brick turning" in rendered(course, "hw9/block", "full", kept).texts["text"]


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("block.yaml", "[a, 2*a, 3*a]", "[a, 2*a, 4*a]"),
        ("block.yaml", "axis: diagonal", "axis: z"),
        ("block.yaml", "mass: M\n", "mass: 2 kg\n"),
        ("block.yaml", "figures: 4}", "figures: 3}"),
        ("block.yaml", "unit: degree", "unit: rad"),
        ("block.yaml", "answer: [cosine, angle_between]", "answer: [angle_between, cosine]"),
        ("block.yaml", "omega: angular speed", "omega: angular speed, b: length"),
        ("block.yaml", "parts:\n", "define: none\nparts:\n"),
        ("block.yaml", "parts:\n", "define: {v_0: a*omega}\nparts:\n"),
        ("block.py", "return I,", "return  I,"),
    ],
)
def test_any_other_change_is_derived_anew(
    course: Path, kept: Cache, monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str
) -> None:
    change(course, file, old, new)
    forbid_deriving(monkeypatch)
    with pytest.raises(AssertionError, match="derived again"):
        rendered(course, "hw9/block", None, kept)


def test_what_is_derived_anew_is_kept_in_turn(course: Path, kept: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    change(course, "block.yaml", "axis: diagonal", "axis: z")
    fresh = rendered(course, "hw9/block", None, kept)
    forbid_deriving(monkeypatch)
    assert rendered(course, "hw9/block", None, kept) == fresh


def test_a_changed_reference_is_compared_anew(course: Path, kept: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    (course / "problems" / "hw9" / "reference.yaml").write_text("[]\n")
    forbid_deriving(monkeypatch)
    with pytest.raises(AssertionError, match="derived again"):
        rendered(course, "hw9/block", None, kept)


def test_a_changed_module_beside_the_script_is_derived_anew(course: Path) -> None:
    change(course, "block.py", "def solve(", "from helper import X\n\n\ndef solve(")
    keys = set()
    for text in ("X = 1", "X = 2"):
        (course / "problems" / "hw9" / "helper.py").write_text(text)
        problem = load_problem(course, "hw9/block")
        keys.add(steps_key(problem))
    assert len(keys) == 2
    assert problem.inputs == tuple(f"problems/hw9/{name}" for name in ("block.yaml", "block.py", "helper.py"))


def test_a_changed_reference_of_its_own_is_compared_anew(course: Path) -> None:
    own = "reference:\n  source: a book\n  entries: [{part: 2, answer: kinetic_energy, states: 1}]\n"
    file = course / "problems" / "hw9" / "block.yaml"
    keys = []
    for text in (file.read_text(), file.read_text() + own, file.read_text() + own.replace("states: 1", "states: 2")):
        file.write_text(text)
        keys.append(steps_key(load_problem(course, "hw9/block")))
    assert len(set(keys)) == 3


def test_a_damaged_file_is_as_good_as_none(
    course: Path, kept: Cache, known: tuple[Rendered, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = course / "kept" / known[1].name
    whole = file.read_bytes()
    forbid_deriving(monkeypatch)
    for damaged in (b"", whole[:32], whole[:-1], whole + b" ", bytes([whole[0] ^ 1]) + whole[1:]):
        file.write_bytes(damaged)
        with pytest.raises(AssertionError, match="derived again"):
            rendered(course, "hw9/block", None, kept)


def test_an_altered_line_is_not_believed(course: Path, kept: Cache, known: tuple[Rendered, Path]) -> None:
    file = course / "kept" / known[1].name
    altered = file.read_bytes().replace(b", 13, 12]", b", 13, 22]")
    assert altered != file.read_bytes()
    file.write_bytes(altered)
    assert rendered(course, "hw9/block", None, kept) == known[0]
    assert file.read_bytes() == known[1].read_bytes(), "and the right line is kept again"


def test_what_differs_from_its_reference_is_not_kept_and_told_again(course: Path) -> None:
    (course / "problems" / "hw9" / "reference.yaml").write_text(
        "- problem: block\n"
        "  symbols: {a: length, M: mass, omega: angular speed}\n"
        "  given: {sides: [a, 2*a, 3*a], mass: M, axis: diagonal, rate: omega}\n"
        "  entries: [{part: 2, answer: kinetic_energy_about_axis, states: 7/23*M*a**2*omega**2}]\n"
    )
    page = rendered(course, "hw9/block", None, Cache(course / "kept"))
    assert (page.agreed, bool(page.warnings)) == (False, True)
    assert not (course / "kept" / steps_key(load_problem(course, "hw9/block"))).exists()


@pytest.mark.parametrize("data", [None, [], {}, {"derivation": 3}, {"values": {"steps": []}}])
def test_data_of_another_shape_are_no_derivation(data: object) -> None:
    assert Solved.from_data(data) is None


def test_what_json_cannot_hold_is_derived_and_not_kept(
    course: Path, known: tuple[Rendered, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(_: Solved) -> None:
        raise ValueError("no JSON")

    monkeypatch.setattr(Solved, "to_data", refuse)
    assert rendered(course, "hw9/block", None, Cache(course / "kept")) == known[0]
    assert not (course / "kept" / known[1].name).exists()
