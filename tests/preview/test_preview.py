"""A preview as an instructor has it: a command, a browser, edits of a file."""

from __future__ import annotations

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import derive.preview.preview
from derive.cli.running import Ending
from derive.preview.server import Pages, Server, server
from tests.browser import browser_page
from tests.building.test_workers import is_gone
from tests.courses import ROOT, course_in
from tests.waiting import until


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return course_in(tmp_path)


class Preview:
    def __init__(self, root: Path):
        command = [sys.executable, "-P", "-m", "derive", "--root", str(root), "preview", "hw9/block", "--port", "0"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True, cwd=ROOT, env=os.environ)
        assert self.process.stdout
        self.address = self.process.stdout.readline().split()[0]
        self.port = int(self.address.split(":")[2].partition("/")[0])

    def asked(self) -> socket.socket:
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=30)
        connection.sendall(b"GET /block.html HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        return connection

    def workers(self) -> list[int]:
        own = f"/proc/{self.process.pid}/task"
        return [int(each) for task in os.listdir(own) for each in Path(own, task, "children").read_text().split()]

    def ended(self, signum: int = signal.SIGINT) -> int:
        self.process.send_signal(signum)
        return self.process.wait(10)

    def said(self) -> str:
        assert self.process.stderr
        return self.process.stderr.read()


@pytest.fixture
def preview(course: Path) -> Iterator[Preview]:
    made = Preview(course)
    yield made
    made.process.kill()
    with made.process:
        pass


def endless(course: Path) -> None:
    script = course / "problems" / "hw9" / "block.py"
    lines = f"    open({str(course / 'begun')!r}, 'w').close()\n    while True:\n        pass\n"
    script.write_text(
        re.sub(r"(def solve\(.*?\):\n)", lambda found: found[1] + lines, script.read_text(), flags=re.DOTALL)
    )


OTHERS = [pytest.param(signum, marks=pytest.mark.long) for signum in (signal.SIGTERM, signal.SIGHUP)]


@pytest.mark.long
@pytest.mark.parametrize("signum", [signal.SIGINT, *OTHERS])
def test_while_it_is_busy_it_ends_at_once_with_its_worker_and_without_a_word(
    preview: Preview, course: Path, signum: int
) -> None:
    assert preview.address.startswith("http://127.0.0.1:")
    endless(course)
    with preview.asked():
        until((course / "begun").exists)
        (worker,) = preview.workers()
        assert preview.ended(signum) == 0
    assert is_gone(worker)
    assert preview.said() == ""


@pytest.mark.long
def test_its_worker_ends_with_it_when_it_is_killed(preview: Preview, course: Path) -> None:
    endless(course)
    with preview.asked():
        until((course / "begun").exists)
        (worker,) = preview.workers()
        preview.ended(signal.SIGKILL)
    assert is_gone(worker)


@pytest.mark.long
def test_it_serves_on_when_nobody_reads_what_it_says(preview: Preview, course: Path) -> None:
    assert preview.process.stdout
    preview.process.stdout.close()
    for title in ("A brick", "A homogeneous brick"):
        file = course / "problems" / "hw9" / "block.yaml"
        file.write_text(re.sub("^title: .*$", f"title: {title}", file.read_text(), flags=re.MULTILINE))
        time.sleep(0.5)
        with preview.asked() as connection:
            assert title.encode() in b"".join(iter(lambda: connection.recv(1 << 16), b""))
    assert preview.ended() == 0
    assert preview.said() == ""


def served_until(course: Path, ending: Ending) -> None:
    derive.preview.preview.preview(course, "hw9", "", 0, None, 60, lambda at: None, lambda *shown: None, ending)


def test_it_ends_where_the_exception_of_a_signal_was_lost_in_a_library(course: Path) -> None:
    ending, started = Ending(), time.monotonic()
    ending.number = signal.SIGTERM
    served_until(course, ending)
    assert time.monotonic() - started < 30


def test_an_edit_for_which_there_are_too_few_descriptors_does_not_end_it(
    course: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    edits = 0

    def refused(*_: object) -> None:
        raise OSError(24, "Too many open files")

    def edited(*_: object) -> Iterator[object]:
        nonlocal edits
        for _ in range(2):
            edits += 1
            monkeypatch.setattr(derive.preview.preview, "problem_set", refused)
            yield

    monkeypatch.setattr(derive.preview.preview, "_edits", edited)
    served_until(course, Ending())
    assert edits == 2


def test_a_problem_that_the_set_lists_anew_has_a_page(course: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, served = course / "problems" / "hw9", list[Pages]()

    def edits(*_: object) -> Iterator[object]:
        shutil.copy(folder / "block.yaml", folder / "brick.yaml")
        with (folder / "set.yaml").open("a") as heading:
            heading.write("  - brick\n")
        yield
        assert served[0].names == {"block", "brick"}
        (folder / "set.yaml").write_text("problems: [")
        yield
        assert served[0].names == {"block", "brick"}

    def noted(pages: Pages, *how: Any) -> Server:
        served.append(pages)
        return server(pages, *how)

    monkeypatch.setattr(derive.preview.preview, "_edits", edits)
    monkeypatch.setattr(derive.preview.preview, "server", noted)
    served_until(course, Ending())
    assert served


def test_scripts_of_other_sets_are_watched_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    watched: list[Path] = []
    monkeypatch.setattr(derive.preview.preview, "watch", lambda *folders, **how: watched.extend(folders) or [])
    assert [*derive.preview.preview._edits(tmp_path, Ending())] == []
    assert tmp_path / "problems" in watched


@pytest.mark.browser
def test_the_open_page_follows_the_file_keeps_its_place_and_shows_faults(preview: Preview, course: Path) -> None:
    file = course / "problems" / "hw9" / "block.yaml"
    text = file.read_text()
    with browser_page() as page:
        page.goto(preview.address, timeout=60_000)
        page.wait_for_selector("body[data-edition]")
        page.evaluate("scrollTo(0, 900)")
        time.sleep(0.2)
        file.write_text(text.replace("A uniform block", "A homogeneous brick"))
        page.wait_for_selector("main:has-text('A homogeneous brick')")
        assert abs(page.evaluate("scrollY") - 900) < 60
        file.write_text(text.replace("points:", "pints:", 1))
        page.wait_for_selector("#complaints", state="visible")
        assert "did you mean `points`?" in page.inner_text("#complaints")
        assert "A homogeneous brick" in page.inner_text("main")
        file.write_text(text)
        page.wait_for_selector("#complaints", state="hidden")
        assert "A uniform block" in page.inner_text("main")


@pytest.mark.browser
def test_a_page_has_its_style_its_drawings_and_its_script_and_may_run_no_other(preview: Preview) -> None:
    with browser_page() as page:
        refused: list[str] = []
        page.on("console", lambda said: refused.append(said.text) if "Content Security Policy" in said.text else None)
        page.goto(preview.address, timeout=60_000)
        page.wait_for_selector("body[data-edition]")
        assert page.evaluate("getComputedStyle(document.querySelector('math')).fontFamily").startswith('"derive math"')
        assert page.evaluate("[...document.fonts].some((font) => font.status === 'loaded')")
        assert [each for each in refused if "favicon" not in each] == []
        page.evaluate("document.querySelector('main').innerHTML = '<img src=x onerror=document.title=\\'taken\\'>'")
        page.wait_for_timeout(300)
        assert page.title() != "taken"
        assert refused
