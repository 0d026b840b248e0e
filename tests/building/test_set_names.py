"""Names of sets: which there are, which cannot be, and what a build may be asked for."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.set_names import (
    check_asked,
    misnamed_sets,
    outputs_without_set,
    set_folder,
    set_names,
    wrong_set_name,
)
from derive.errors import Misused
from tests.courses import course_in


def test_a_set_is_a_folder_with_its_file(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "problems" / "notes").mkdir()
    assert set_names(root) == ["hw9"]
    assert set_folder(root, "hw9") == root / "build" / "hw9"


@pytest.mark.parametrize("name", ["build", "test", "a b", "-x", ".hidden", "é"])
def test_names_that_make_has_or_no_file_should_have_are_refused(name: str) -> None:
    assert wrong_set_name(name)


def test_a_folder_with_such_a_name_is_left_out_with_a_warning(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "problems" / "tests").mkdir()
    (root / "problems" / "tests" / "set.yaml").write_text("")
    (warning,) = misnamed_sets(root)
    assert warning.severity == "warning" and "tests" in warning.message and set_names(root) == ["hw9"]


def test_only_a_set_and_problems_that_there_are_can_be_asked_for(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    check_asked(root, "hw9", ["block"])
    for set_id, problems in (("hw8", []), ("hw9", ["blok"])):
        with pytest.raises(Misused):
            check_asked(root, set_id, problems)


def test_outputs_of_a_set_that_was_removed_are_named(tmp_path: Path) -> None:
    for name in ("hw1", "hw2"):
        (tmp_path / "build" / name).mkdir(parents=True)
        (tmp_path / "build" / name / ".manifest.json").write_text("")
    (tmp_path / "problems" / "hw2").mkdir(parents=True)
    (tmp_path / "problems" / "hw2" / "set.yaml").write_text("title: A\n")
    (told,) = outputs_without_set(tmp_path)
    assert "`build/hw1`" in told.message and told.help == "`derive clean hw1` removes them"
