"""What a killed process left is removed by the next build, and nothing that another is still using."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest

from derive.building.files import write
from derive.building.scratch import HELD, PREFIX, Scratch, sweep
from derive.building.sets import Options, built_set
from tests.courses import ROOT
from tests.fake_course import stand_in_course

# Begins to write a file, and has some scratch, until somebody ends it.
AT_WORK = """
import os, sys, time
from pathlib import Path
from derive.building.scratch import Scratch
from derive.building import files
scratch = Scratch()
def slow(_):
    print(scratch.name, flush=True)
    time.sleep(60)
os.fsync = slow
files.write(Path(sys.argv[1]), "half")
"""


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    monkeypatch.setenv("TMPDIR", str(folder))
    sweep.cache_clear()
    return folder


def at_work(file: Path) -> subprocess.Popen[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-P", "-c", AT_WORK, str(file)]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
    assert process.stdout and process.stdout.readline()
    return process


def test_what_a_killed_process_left_is_swept_and_nothing_that_one_at_work_holds(
    tmp_path: Path, temporary: Path
) -> None:
    outputs = tmp_path / "build"
    outputs.mkdir()
    with at_work(outputs / "one.pdf") as process:
        sweep(outputs)
        assert len([*outputs.iterdir()]) == len([*temporary.iterdir()]) == 1
        process.send_signal(signal.SIGKILL)
    sweep.cache_clear()
    sweep(outputs)
    assert [*outputs.iterdir()] == [*temporary.iterdir()] == []


def left_by_hand(folder: Path) -> None:
    (folder / f"{PREFIX}abcdefgh").mkdir()
    (folder / f"{PREFIX}notes").mkdir()
    (folder / f"{PREFIX}notes" / HELD).touch()
    (folder / "derive-abcdefgh").mkdir()
    (folder / "derive-abcdefgh" / HELD).touch()
    (folder / "other").mkdir()
    (folder / "other" / HELD).touch()
    (folder / f"{PREFIX}hgfedcba").symlink_to(folder / "other")


def test_folders_and_files_of_others_stay(tmp_path: Path, temporary: Path) -> None:
    left_by_hand(temporary)
    before = sorted(temporary.rglob("*"))
    for name in (".notes", "notes.part", "one.pdf"):
        (tmp_path / name).touch()
    (tmp_path / ".link.part").symlink_to("notes.part")
    sweep(tmp_path)
    assert sorted(temporary.rglob("*")) == before
    assert {path.name for path in tmp_path.iterdir()} >= {".notes", "notes.part", "one.pdf", ".link.part"}


def test_scratch_is_empty_at_first_and_gone_at_the_end(temporary: Path) -> None:
    with Scratch() as name:
        assert os.listdir(name) == []
        assert Path(name).is_relative_to(temporary)
    assert [*temporary.iterdir()] == []


def test_a_file_that_a_build_took_for_one_that_is_left_is_begun_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begin: Callable[..., tuple[int, str]] = tempfile.mkstemp
    begun: list[str] = []

    def swept(**how: str) -> tuple[int, str]:
        handle, name = begin(**how)
        begun.append(name)
        if len(begun) == 1:
            os.unlink(name)
        return handle, name

    monkeypatch.setattr(tempfile, "mkstemp", swept)
    assert write(tmp_path / "one.txt", "whole")
    assert (tmp_path / "one.txt").read_text() == "whole"
    assert len(begun) == 2


def test_a_build_sweeps_its_folder_and_what_it_keeps_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    course = stand_in_course(tmp_path, monkeypatch)
    kept = course.outputs / ".derived"
    kept.mkdir(parents=True)
    for folder in (course.outputs, kept):
        (folder / ".one.pdf.abcdefgh.part").write_text("half")
    built_set(course.root, "hw1", Options(), lambda _: None)
    assert not [*course.outputs.rglob("*.part")]
