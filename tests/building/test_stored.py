"""Steps kept between builds: taken again when only words change, and never when anything else does."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.building import solution
from derive.building.solution import rendered
from derive.render.rendered import Rendered
from tests.courses import course_in


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return course_in(tmp_path)


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> tuple[Rendered, str]:
    """The page of the course as it is, and what is kept of it: derived once for all tests."""
    course = course_in(tmp_path_factory.mktemp("known"))
    return rendered(course, "hw9/block", None, course / "kept.json"), (course / "kept.json").read_text()


@pytest.fixture
def kept(course: Path, known: tuple[Rendered, str]) -> Path:
    file = course / "kept.json"
    file.write_text(known[1])
    return file


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
    course: Path, kept: Path, known: tuple[Rendered, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    forbid_deriving(monkeypatch)
    assert rendered(course, "hw9/block", None, kept) == known[0]


def test_new_words_need_no_new_derivation(course: Path, kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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
        ("block.py", "return I,", "return  I,"),
    ],
)
def test_any_other_change_is_derived_anew(
    course: Path, kept: Path, monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str
) -> None:
    change(course, file, old, new)
    forbid_deriving(monkeypatch)
    with pytest.raises(AssertionError, match="derived again"):
        rendered(course, "hw9/block", None, kept)


def test_what_is_derived_anew_is_kept_in_turn(course: Path, kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    change(course, "block.yaml", "axis: diagonal", "axis: z")
    fresh = rendered(course, "hw9/block", None, kept)
    forbid_deriving(monkeypatch)
    assert rendered(course, "hw9/block", None, kept) == fresh


def test_a_changed_reference_is_compared_anew(course: Path, kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (course / "problems" / "hw9" / "reference.yaml").write_text("[]\n")
    forbid_deriving(monkeypatch)
    with pytest.raises(AssertionError, match="derived again"):
        rendered(course, "hw9/block", None, kept)


@pytest.mark.parametrize("damage", ["", "{", "[]", '{"of": 1}'])
def test_a_damaged_file_is_as_good_as_none(
    course: Path, kept: Path, monkeypatch: pytest.MonkeyPatch, damage: str
) -> None:
    key = json.loads(kept.read_text())["of"]
    kept.write_text(damage.replace("1", f'"{key}"'))
    forbid_deriving(monkeypatch)
    with pytest.raises(AssertionError, match="derived again"):
        rendered(course, "hw9/block", None, kept)


def test_an_altered_line_is_not_believed(course: Path, kept: Path, known: tuple[Rendered, str]) -> None:
    altered = kept.read_text().replace(", 13, 12]", ", 13, 22]")
    assert altered != kept.read_text()
    kept.write_text(altered)
    assert rendered(course, "hw9/block", None, kept) == known[0]
