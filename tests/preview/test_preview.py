"""A preview as an instructor has it: a command, a browser, edits of a file."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import derive.preview.preview
from derive.preview.server import Pages, Server, server
from tests.browser import browser_page
from tests.courses import ROOT, course_in


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return course_in(tmp_path)


class Preview:
    """The command while it runs, and where it serves."""

    def __init__(self, root: Path):
        command = [sys.executable, "-P", "-m", "derive", "--root", str(root), "preview", "hw9/block", "--port", "0"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT, env=os.environ)
        assert self.process.stdout
        self.address = self.process.stdout.readline().split()[0]

    def ended(self) -> int:
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(10)


@pytest.fixture
def preview(course: Path) -> Iterator[Preview]:
    made = Preview(course)
    yield made
    made.process.kill()
    with made.process:
        pass


def test_an_interrupt_ends_it_cleanly_with_its_worker(preview: Preview) -> None:
    assert preview.address.startswith("http://127.0.0.1:")
    assert preview.ended() == 0


def test_a_problem_that_the_set_lists_anew_has_a_page(course: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, served = course / "problems" / "hw9", list[Pages]()

    def edits(root: Path) -> Iterator[object]:
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
    derive.preview.preview.preview(course, "hw9", "", 0, None, 60, lambda at: None, lambda name, shown: None)
    assert served


def test_scripts_of_other_sets_are_watched_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    watched: list[Path] = []
    monkeypatch.setattr("watchfiles.watch", lambda *folders, **how: watched.extend(folders) or [])
    assert [*derive.preview.preview._edits(tmp_path)] == []
    assert tmp_path / "problems" in watched


@pytest.mark.browser
def test_the_open_page_follows_the_file_keeps_its_place_and_shows_faults(preview: Preview, course: Path) -> None:
    file = course / "problems" / "hw9" / "block.yaml"
    text = file.read_text()
    with browser_page() as page:
        page.goto(preview.address, timeout=60_000)
        page.wait_for_function("document.body.dataset.edition >= 1")
        page.evaluate("scrollTo(0, 900)")
        time.sleep(0.2)
        file.write_text(text.replace("A uniform block", "A homogeneous brick"))
        page.wait_for_function("document.querySelector('main').textContent.includes('A homogeneous brick')")
        assert abs(page.evaluate("scrollY") - 900) < 60
        file.write_text(text.replace("points:", "pints:", 1))
        page.wait_for_function("!document.getElementById('complaints').hidden")
        assert "did you mean `points`?" in page.inner_text("#complaints")
        assert "A homogeneous brick" in page.inner_text("main")
        file.write_text(text)
        page.wait_for_function("document.getElementById('complaints').hidden")
        assert "A uniform block" in page.inner_text("main")
