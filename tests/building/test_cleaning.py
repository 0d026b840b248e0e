"""What builds made is taken away, and nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.class_record import RECORD
from derive.building.cleaning import cleaned
from derive.errors import Misused


@pytest.fixture
def root(tmp_path: Path) -> Path:
    for name in ("hw1", "hw2"):
        (tmp_path / "problems" / name).mkdir(parents=True)
        (tmp_path / "problems" / name / "set.yaml").write_text("title: A set\nproblems: []\n")
    for name in ("hw1", "gone"):
        (tmp_path / "build" / name / ".derived").mkdir(parents=True)
        (tmp_path / "build" / name / ".derived" / "one").write_bytes(bytes(100))
        (tmp_path / "build" / name / "one.pdf").write_bytes(bytes(1000))
    (tmp_path / "build" / "note.txt").write_text("mine")
    return tmp_path


def files(root: Path) -> set[str]:
    return {str(path.relative_to(root / "build")) for path in (root / "build").rglob("*") if path.is_file()}


def clean(root: Path, *sets: str, cache: bool = False) -> list[tuple[str, int]]:
    return [(str(path.relative_to(root)), size) for path, size in cleaned(root, sets, cache, lambda _: None)]


def test_every_folder_of_a_set_goes_also_of_one_that_is_no_more(root: Path) -> None:
    assert clean(root) == [("build/gone", 1100), ("build/hw1", 1100)]
    assert files(root) == {"note.txt"}
    assert (root / "problems" / "hw1" / "set.yaml").exists()


def test_the_cache_goes_alone_and_the_documents_stay(root: Path) -> None:
    assert clean(root, cache=True) == [("build/gone/.derived", 100), ("build/hw1/.derived", 100)]
    assert {"hw1/one.pdf", "gone/one.pdf"} <= files(root)
    assert clean(root, cache=True) == []


def test_only_the_sets_that_are_named_go(root: Path) -> None:
    assert clean(root, "hw1") == [("build/hw1", 1100)]
    assert clean(root, "hw2") == [], "which was not built"
    assert clean(root, "gone") == [("build/gone", 1100)]


def test_the_record_of_a_class_stays_as_long_as_there_is_a_set(root: Path) -> None:
    for name in ("hw1", "gone"):
        (root / "build" / name / RECORD).write_text("the seed")
    assert clean(root) == [("build/gone", 1108), ("build/hw1", 1100)]
    assert "hw1/.class.json" in files(root) and files(root) <= {"note.txt", "hw1/.class.json", "hw1/.lock"}
    assert clean(root) == []


@pytest.mark.parametrize("name", ["hw", "..", "", "../problems", "/"])
def test_what_is_no_set_is_not_removed(root: Path, name: str) -> None:
    with pytest.raises(Misused, match="no set is called"):
        clean(root, "hw1", name)
    assert "hw1/one.pdf" in files(root), "a wrong name stops it before anything goes"


def test_a_link_is_not_followed(root: Path) -> None:
    (root / "build" / "linked").symlink_to(root / "problems")
    clean(root)
    assert (root / "problems" / "hw1" / "set.yaml").exists()


def test_there_need_be_nothing(tmp_path: Path) -> None:
    (tmp_path / "problems").mkdir()
    assert clean(tmp_path) == []
