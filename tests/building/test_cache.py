"""What builds keep: found under what it depends on and nowhere else, whole, shared, and not without end."""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from derive.building.cache import NO_CACHE, Cache, digest, engine_digest, file_digest, folder_digest
from derive.building.sets import Options, built_set
from derive.building.signatures import SIGNATURE_BYTES
from derive.building.solution import rendered
from tests.courses import course_in
from tests.fake_course import Course, stand_in_course

ONE, TWO, THREE = digest("one"), digest("two"), digest("three")


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "kept")


# --- digests ---------------------------------------------------------------------------------------------------------


def test_a_digest_is_of_the_parts_and_of_where_they_end() -> None:
    parts = [("ab", "c"), ("a", "bc"), ("abc",), ("abc", ""), ("", "abc"), ()]
    assert len({digest(*each) for each in parts}) == len(parts)
    assert digest("ω") == digest("ω".encode())


def test_a_folder_is_digested_with_names_and_contents_below_it(tmp_path: Path) -> None:
    found = [folder_digest(tmp_path)]
    for change in (
        lambda: (tmp_path / "a").mkdir(),
        lambda: (tmp_path / "a" / "x.py").write_text("1"),
        lambda: (tmp_path / "a" / "x.py").write_text("2"),
        lambda: (tmp_path / "a" / "x.py").rename(tmp_path / "a" / "y.py"),
        lambda: (tmp_path / "a").rename(tmp_path / "b"),
    ):
        change()
        found.append(folder_digest(tmp_path))
    assert found[1] == found[0], "an empty folder says nothing"
    assert len(set(found)) == 5
    (tmp_path / "__pycache__").mkdir()
    (tmp_path / "__pycache__" / "z.py").write_text("compiled")
    (tmp_path / "notes.txt").write_text("no module")
    assert folder_digest(tmp_path, "*.py") == found[-1]


def test_the_packages_count_by_their_versions() -> None:
    assert engine_digest("sympy") != engine_digest("mpmath") != engine_digest("sympy", "mpmath")
    assert engine_digest("no such package") == engine_digest("no such package")


def test_what_is_no_file_has_no_digest(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "empty").touch()
    assert [file_digest(tmp_path / name) for name in ("pipe", "none", ".")] == ["", "", ""]
    assert file_digest(tmp_path / "empty") == digest("")


# --- kept and recalled -----------------------------------------------------------------------------------------------


def test_a_value_is_found_under_its_own_digest_alone(tmp_path: Path, cache: Cache) -> None:
    data = {"value": ["1/2", None]}
    cache.keep(ONE, b"\0%PDF")
    cache.keep_data(TWO, data)
    assert (cache.get(ONE), cache.get_data(TWO), cache.get(THREE)) == (b"\0%PDF", data, None)
    (tmp_path / "kept" / ONE).rename(tmp_path / "kept" / THREE)
    assert cache.get(THREE) is None, "nor under a name that it was given later"


def test_a_value_that_is_kept_again_replaces_the_first(cache: Cache) -> None:
    cache.keep(ONE, b"first")
    cache.keep(ONE, b"second")
    assert cache.get(ONE) == b"second"


def test_a_fresh_cache_finds_nothing_and_keeps_for_the_next(tmp_path: Path, cache: Cache) -> None:
    cache.keep(ONE, b"before")
    fresh = Cache(tmp_path / "kept", fresh=True)
    assert fresh.get(ONE) is None
    fresh.keep(ONE, b"anew")
    assert cache.get(ONE) == b"anew"


def test_without_a_folder_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    NO_CACHE.keep(ONE, b"1")
    assert (NO_CACHE.get(ONE), list(tmp_path.iterdir())) == (None, [])


def test_what_was_altered_or_is_no_file_counts_as_none(tmp_path: Path, cache: Cache) -> None:
    cache.keep(ONE, b"12345")
    file = tmp_path / "kept" / ONE
    raw = file.read_bytes()
    for altered in (raw[:-1], raw + b"6", raw[:SIGNATURE_BYTES], b"", raw[:-1] + b"6"):
        file.write_bytes(altered)
        assert cache.get(ONE) is None
    file.unlink()
    os.mkfifo(file)
    assert cache.get(ONE) is None
    cache.keep(ONE, b"12345")
    assert cache.get(ONE) == b"12345", "a pipe is replaced"
    (tmp_path / "kept" / TWO).mkdir()
    assert cache.get(TWO) is None
    cache.keep(TWO, b"1")
    (warning,) = cache.unkept
    assert (warning.code, warning.severity) == ("not-kept", "warning")
    assert warning.message.endswith("a folder is where a file should be")


def test_a_cache_that_cannot_be_written_costs_a_warning_and_no_page(course: Course) -> None:
    course.outputs.mkdir(parents=True)
    (course.outputs / ".derived").write_text("in the way")
    (course.outputs / ".manifest.json").mkdir()
    for said in ("first", "edited"):
        course.problem("one", said)
        report = built_set(course.root, "hw1", Options(), lambda _: None)
        assert not report.failed
        assert {warning.code for warning in report.warnings} == {"not-kept"}
        assert [warning.message for warning in report.warnings] == [
            "results cannot be stored for the next build: cannot write in `build/hw1/.derived`: "
            "a file is where a folder should be",
            "results cannot be stored for the next build: cannot write `build/hw1/.manifest.json`: "
            "a folder is where a file should be",
        ]
        assert said in (course.outputs / "solutions.pdf").read_text()


def test_a_page_whose_steps_cannot_be_kept_says_so_and_is_there(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    kept = Cache(tmp_path / "kept")
    kept.folder.write_text("in the way") if kept.folder else None
    page = rendered(root, "hw9/block", cache=kept, only=())
    assert [warning.code for warning in page.warnings if warning.code == "not-kept"] == ["not-kept"]


def test_a_link_is_replaced_and_what_it_leads_to_is_left_alone(tmp_path: Path, cache: Cache) -> None:
    victim = tmp_path / "victim"
    victim.write_text("mine")
    os.utime(victim, (0, 0))
    cache.keep(ONE, b"1")
    (tmp_path / "kept" / TWO).symlink_to(victim)
    assert cache.get(TWO) is None
    cache.keep(TWO, b"2")
    assert (cache.get(TWO), victim.read_text(), victim.stat().st_mtime) == (b"2", "mine", 0)


# --- not without end -------------------------------------------------------------------------------------------------


def test_what_was_used_longest_ago_is_let_go(tmp_path: Path) -> None:
    cache = Cache(tmp_path, limit=2 * (SIGNATURE_BYTES + 10))
    for age, key in enumerate((TWO, ONE)):
        cache.keep(key, bytes(10))
        os.utime(tmp_path / key, (age, age))
    assert cache.get(TWO), "and is now the last that was used"
    cache.keep(THREE, bytes(10))
    cache.evict()
    assert {file.name for file in tmp_path.iterdir()} == {TWO, THREE}


def test_a_value_above_the_limit_is_not_kept_and_leaves_the_others(tmp_path: Path) -> None:
    cache = Cache(tmp_path, limit=100)
    cache.keep(ONE, b"1")
    cache.keep(TWO, bytes(200))
    cache.evict()
    assert (cache.get(ONE), cache.get(TWO)) == (b"1", None)


def test_a_file_that_another_build_lets_go_meanwhile_is_no_obstacle(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed = [tmp_path / "kept" / ONE, tmp_path / "kept" / "gone"]
    monkeypatch.setattr(Path, "iterdir", lambda _: iter(listed))
    full = Cache(tmp_path / "kept", limit=0)
    full.keep(ONE, b"1")
    full.evict()
    assert not (tmp_path / "kept" / ONE).exists()


# --- builds ----------------------------------------------------------------------------------------------------------


def built(course: Course, options: Options | None = None) -> int:
    return built_set(course.root, "hw1", options or Options(), lambda _: None).derived


def test_a_pickle_laid_where_results_are_kept_does_not_run(course: Course) -> None:
    built(course)

    class Trap:
        def __reduce__(self) -> tuple[Callable[[str], int], tuple[str]]:
            return os.system, (f"touch {course.root}/taken",)

    for file in (course.outputs / ".derived").iterdir():
        file.write_bytes(pickle.dumps(Trap()))
    (course.outputs / "one.pdf").unlink()
    assert built(course) == 2
    assert not (course.root / "taken").exists()


def test_an_edit_that_is_taken_back_is_neither_derived_nor_typeset(course: Course) -> None:
    built(course)
    before = course.contents()
    course.problem("one", "edited")
    built(course)
    course.derived(), course.typeset()
    course.problem("one", "first")
    assert built(course) == 0
    assert (course.derived(), course.typeset()) == ([], [])
    assert course.contents() == before


def test_what_is_recalled_warns_again_and_has_its_own_drawings(course: Course) -> None:
    course.problem("one", "draws")
    course.problem("two", "warn")
    built(course)
    course.problem("one", "first")
    course.problem("two", "second")
    built(course)
    assert not (course.outputs / "one-axes.pdf").exists()
    course.problem("one", "draws")
    course.problem("two", "warn")
    report = built_set(course.root, "hw1", Options(), lambda _: None)
    assert [warning.code for warning in report.warnings] == ["unshown"]
    assert (course.outputs / "one-axes.pdf").read_text() == "draws"


def test_pages_are_typeset_again_if_only_a_drawing_looks_different(
    course: Course, monkeypatch: pytest.MonkeyPatch
) -> None:
    solution = sys.modules["derive.building.solution"]
    plain = solution.rendered
    for look in (b"one look", b"another"):
        files = (("one-axes.pdf", look),)
        monkeypatch.setattr(solution, "rendered", lambda *a, f=files, **k: replace(plain(*a, **k), files=f))
        course.heading("one")
        course.problem("one", "first" + " " * len(look))  # which reads as before
        built(course)
        assert "one.tex" in course.typeset()
        assert (course.outputs / "one-axes.pdf").read_bytes() == look


def test_a_forced_build_takes_nothing_of_what_is_kept(course: Course) -> None:
    built(course)
    course.derived(), course.typeset()
    assert built(course, Options(force=True)) == 2
    assert len(course.derived()) == 2
    assert course.typeset() == ["one.tex", "problems.tex", "report.tex", "solutions.tex", "two.tex"]
    assert built(course) == 0
