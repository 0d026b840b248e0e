"""Watching: an edit is built at once, its own page first; a fault is told, and watching goes on until an interrupt."""

from __future__ import annotations

import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.building import watch as watching
from derive.building.sets import Options, Report
from derive.building.watch import Shown, seen_in, watch
from derive.errors import BuildFailed, Misused
from tests.cli.started import alone, alone_in, command
from tests.courses import ROOT, course_in
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


class Told:
    def __init__(self) -> None:
        self.lines: list[str] = []
        self.shown = Shown(
            lambda _: None,
            lambda path, _: self.lines.append(path.name),
            lambda report: self.lines.append(f"{report.derived} derived{', failed' if report.failed else ''}"),
            lambda complaints: self.lines.extend(complaint.code for complaint in complaints),
        )

    def new(self) -> list[str]:
        lines, self.lines = self.lines, []
        return lines


@pytest.fixture
def told() -> Told:
    return Told()


def watched(course: Course, told: Told, *names: str) -> watching._Watch:
    return watching._Watch(course.root, {"hw1": names}, Options(jobs=1), told.shown)


def test_an_edit_derives_its_problem_alone_and_writes_its_page_before_those_of_the_set(
    course: Course, told: Told
) -> None:
    watched_set = watched(course, told)
    watched_set.build()
    assert told.new() == ["two.pdf", "one.pdf", "2 derived"]
    course.derived(), course.typeset()
    course.problem("two", "edited")
    watched_set.wait(), watched_set.build()
    assert told.new() == ["two.pdf", "1 derived"]
    assert course.derived() == ["hw1/two None"]
    assert "edited" in (course.outputs / "solutions.pdf").read_text()
    course.problem("two", "second")
    watched_set.wait(), watched_set.build()
    assert told.new() == ["two.pdf", "0 derived"], "what is taken back is known"


def test_of_a_set_one_problem_may_be_watched(course: Course, told: Told) -> None:
    watched_problem = watched(course, told, "two")
    watched_problem.build()
    assert (told.new(), course.derived()) == (["two.pdf", "1 derived"], ["hw1/two None"])
    assert not (course.outputs / "solutions.pdf").exists()
    assert not (course.outputs / ".built").exists(), "make has the rest to do"
    course.problem("one", "edited")
    watched_problem.wait(), watched_problem.build()
    assert (told.new(), course.derived()) == (["0 derived"], [])


@pytest.mark.usefixtures("workers")
def test_an_edit_ends_the_build_of_what_was_there_before(
    course: Course, told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    course.problem("two", "loop")
    watched_set = watched(course, told)
    edited = watched_set._edited

    def edited_soon() -> bool:
        if "one.pdf" in told.lines:
            course.problem("two", "second")
            monkeypatch.setattr(watched_set, "_edited", edited)
        return edited()

    monkeypatch.setattr(watched_set, "_edited", edited_soon)
    watched_set.build()
    assert told.new() == ["one.pdf", "two.pdf", "1 derived"], "what was finished is kept, and nothing is told twice"


def test_a_complaint_about_a_file_that_is_being_written_is_not_told(
    course: Course, told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    (course.folder / "set.yaml").write_text("")
    built_set = watching.built_set

    def saved_meanwhile(*given: object) -> Report:
        monkeypatch.setattr(watching, "built_set", built_set)
        try:
            return built_set(*given)  # type: ignore[arg-type]
        finally:
            course.heading("one", "two")

    monkeypatch.setattr(watching, "built_set", saved_meanwhile)
    watched(course, told).build()
    assert told.new() == ["two.pdf", "one.pdf", "2 derived"]


def test_a_change_of_derive_itself_is_told_and_builds_nothing(
    course: Course, told: Told, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = tmp_path / "derive" / "tidy.py"
    module.parent.mkdir()
    module.write_text("old")
    monkeypatch.setattr(watching, "FOLDER", module.parent)
    monkeypatch.setattr(watching, "ENGINE_EVERY", 0.0)
    watched_set = watched(course, told)
    watched_set.build()
    told.new()
    module.write_text("new and longer")
    watched_set.wait(), watched_set.build()
    assert told.new() == ["restart"]
    module.write_text("old")
    course.problem("one", "edited")
    watched_set.wait(), watched_set.build()
    assert told.new() == ["one.pdf", "1 derived"]


def test_what_there_is_not_is_told_before_anything_is_watched(course: Course, told: Told) -> None:
    for asked, code in (({"hw2": ()}, "no-such-set"), ({"hw1": ("three",)}, "no-such-problem")):
        with pytest.raises(Misused, match=code):
            watch(course.root, asked, Options(), told.shown)
    with pytest.raises(BuildFailed, match="no-tex"):
        watch(course.root, {"hw1": ()}, Options(engine="lualatex"), told.shown)
    with pytest.raises(Misused, match="no-such-engine"):
        watch(course.root, {"hw1": ()}, Options(engine="word"), told.shown)


def test_only_what_somebody_writes_is_looked_at(tmp_path: Path) -> None:
    deep = tmp_path / "library" / "tops"
    deep.mkdir(parents=True)
    (deep / "back").symlink_to(tmp_path)
    before = seen_in([tmp_path, tmp_path / "nowhere"])
    for name in ("top.yaml~", ".top.yaml.swp", ".#top.yaml", "top.pdf", "4913"):
        (deep / name).write_text("x")
    assert seen_in([tmp_path]) == before
    (deep / "top.yaml").write_text("x")
    assert str(deep / "top.yaml") in seen_in([tmp_path])


class Process:
    def __init__(self, arguments: list[str], environment: dict[str, str]):
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(arguments, env=environment, stdout=pipe, stderr=subprocess.STDOUT, text=True)
        self.limit = threading.Timer(120, self.process.kill)  # after which it has no more lines
        self.limit.start()

    def __iter__(self) -> Iterator[str]:
        assert self.process.stdout
        return iter(self.process.stdout.readline, "")

    def end(self, number: int) -> tuple[int, str]:
        self.process.send_signal(number)
        rest, _ = self.process.communicate()
        self.limit.cancel()
        return self.process.returncode, rest

    def until(self, said: str) -> list[str]:
        lines = []
        for line in self:
            lines.append(line)
            if said in line:
                return lines
        raise AssertionError(lines)


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.long)])
def test_a_fault_is_told_and_an_interrupt_is_a_good_end(course: Course, number: int) -> None:
    process = Process(command("build", "--watch", "hw1"), alone(course))
    process.until("derived 2 of 2")
    course.problem("one", "refuse")
    assert "`mass` must be a mass" in process.until("hw1: derived 0 of 2 problems, failed")[0]
    for name in ("one", "two"):
        course.problem(name, f"edited {name}")
    assert "wrote build/hw1/one.pdf (" in "".join(process.until("hw1: derived"))
    course.problem("one", "loop")
    time.sleep(0.3)  # while it works, or before
    assert process.end(number) == (0 if number == signal.SIGINT else 143, "")


@pytest.mark.long
def test_words_and_templates_of_the_course_are_read_again(course: Course, tmp_path: Path) -> None:
    root = course_in(tmp_path / "real", problem="euler")
    shutil.copytree(ROOT / "templates", root / "templates")
    arguments = [sys.executable, "-P", "-m", "derive", "build", "--watch", "hw9/euler"]
    process = Process(arguments, alone_in(root))
    process.until("derived 1 of 1")
    page = root / "build" / "hw9" / "euler.tex"
    edits = (
        ("phrases/en/page.yaml", "points\n  solutions: Solutions", "points\n  solutions: Worked out"),
        ("latex/document.tex.j2", r"{\headheight}{14pt}", r"{\headheight}{15pt}"),
    )
    for file, old, new in edits:
        text = (root / "templates" / file).read_text()
        assert text.count(old) == 1
        assert new not in page.read_text()
        (root / "templates" / file).write_text(text.replace(old, new))
    while not all(new.rpartition(": ")[2] in page.read_text() for *_, new in edits):
        process.until("hw9: derived")
    assert process.end(signal.SIGINT) == (0, "")
