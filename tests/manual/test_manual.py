"""Whoever follows the manual sees what it shows: page by page, in a course of its own.

Of the fenced blocks of a page
    sh             are commands, carried out one after the other; `# exit code 1` behind one says how it ends
    text           are lines that the commands just above tell, in this order, `...` standing for anything
    yaml a/b.yaml  are written to that file, and so is python
    diff a/b.yaml  change that file
    python derive/a.py  are lines of that module
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.courses import PINNED, ROOT

PAGES = ["README.md", *sorted(f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md"))]
FENCED = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.DOTALL | re.MULTILINE)
LINKED = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")
RUN = {"sh", "text"}
OF_THIS_MACHINE = ("make", "open", "xdg-open", ".")  # carried out by no test here: see tests/tools/test_make.py


@dataclass(frozen=True)
class Block:
    sort: str
    path: str
    text: str


def blocks(page: str) -> list[Block]:
    found = [Block(*groups) for groups in FENCED.findall((ROOT / page).read_text(encoding="utf-8"))]
    return [block for block in found if block.sort in RUN or block.path]


def commands(text: str) -> Iterator[tuple[str, int]]:
    """Each with the exit code that it has."""
    for line in text.splitlines():
        command, _, remark = line.partition(" #")
        if command.strip():
            ends = re.search(r"exit code (\d+)", remark)
            yield command.strip(), int(ends[1]) if ends else 0


class Reader:
    def __init__(self, root: Path, capfd: pytest.CaptureFixture[str]):
        self.root, self.capfd, self.told = root, capfd, ""

    def follow(self, block: Block) -> None:
        match block.sort:
            case "sh":
                self.told = "".join(self.carried_out(command, code) for command, code in commands(block.text))
            case "text":
                self.finds(block.text)
            case "diff":
                self.change(self.root / block.path, block.text)
            case _ if block.path.startswith("derive/"):
                assert block.text in (ROOT / block.path).read_text(encoding="utf-8"), f"{block.path} has it otherwise"
            case _:
                path = self.root / block.path
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(block.text, encoding="utf-8")

    def carried_out(self, command: str, code: int) -> str:
        first, *rest = shlex.split(command)
        if first in OF_THIS_MACHINE:
            return ""
        if Path(first).name == "derive" and rest[0] == "preview":
            return self.served(rest)
        if Path(first).name == "derive" and not re.search(r"[|>;]", command):
            try:
                ended = main(rest)
            except SystemExit as ending:
                ended = int(ending.code or 0)
            out, err = self.capfd.readouterr()
        else:
            path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
            done = subprocess.run(
                ["bash", "-c", command], cwd=self.root, env={**os.environ, "PATH": path}, capture_output=True, text=True
            )
            ended, out, err = done.returncode, done.stdout, done.stderr
        assert ended == code, f"{command}: exit code {ended}\n{out}{err}"
        return out + err

    def served(self, arguments: list[str]) -> str:
        started = [sys.executable, "-P", "-m", "derive", *arguments, "--port", "0"]
        with subprocess.Popen(started, cwd=self.root, stdout=subprocess.PIPE, text=True) as server:
            assert server.stdout is not None
            line = server.stdout.readline()
            server.terminate()
        return line

    def finds(self, text: str) -> None:
        pieces = [re.escape(piece) for piece in re.split(r"\n? *\.\.\. *\n?", text.strip("\n"))]
        pattern = r"[\s\S]*".join(pieces)
        assert re.search(pattern, self.told), f"not told:\n{text}\nbut\n{self.told}"

    def change(self, path: Path, text: str) -> None:
        lines = [line for line in text.splitlines() if line]
        before = "".join(f"{line[1:]}\n" for line in lines if line[0] in " -")
        after = "".join(f"{line[1:]}\n" for line in lines if line[0] in " +")
        whole = path.read_text(encoding="utf-8")
        assert whole.count(before) == 1, f"{path.name} has these lines {whole.count(before)} times:\n{before}"
        path.write_text(whole.replace(before, after), encoding="utf-8")


@pytest.fixture
def reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Reader:
    shutil.copytree(ROOT / "templates", tmp_path / "templates")
    homework = tmp_path / "problems" / "hw9"
    homework.mkdir(parents=True)
    for name in ("block.yaml", "block.py", "set.yaml"):
        shutil.copy(PINNED / name, homework)
    (tmp_path / "problems" / "library").symlink_to(ROOT / "problems" / "library")
    monkeypatch.chdir(tmp_path)
    return Reader(tmp_path, capfd)


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page)])
def test_a_page_of_the_manual_can_be_followed(page: str, reader: Reader) -> None:
    for block in blocks(page):
        reader.follow(block)


def test_most_pages_have_something_to_follow() -> None:
    assert {"README.md", "docs/first-set.md", "docs/commands.md", "docs/scripts.md"} <= {p for p in PAGES if blocks(p)}


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_leads_to_is_there(page: str) -> None:
    here = ROOT / page
    for path, heading in LINKED.findall(here.read_text(encoding="utf-8")):
        target = here.parent / path if path else here
        assert target.exists(), path
        if heading:
            titles = re.findall(r"^#+ (.*)$", target.read_text(encoding="utf-8"), re.MULTILINE)
            assert heading in {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}, heading


def test_the_contents_of_the_manual_have_every_page() -> None:
    listed = {path for path, _ in LINKED.findall((ROOT / "docs" / "README.md").read_text(encoding="utf-8"))}
    assert {Path(page).name for page in PAGES if page.startswith("docs/")} - {"README.md"} <= listed


def test_every_command_is_told_of(tmp_path: Path) -> None:
    from derive.cli.running import COMMANDS

    told = "".join(block.text for page in PAGES for block in blocks(page) if block.sort == "sh")
    assert {name for name in COMMANDS if not re.search(rf"\bderive {name}\b", told)} == set()
