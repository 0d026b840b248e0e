"""Measure the times of derive, divided by the least time that the same work could take. Run by `make bench`.

    cold build of a set       / two pdflatex passes on its TeX and `import sympy`             aim 2
    cold build of the library / the same                                                      aim 3
    edit of a word to PDF     / one pdflatex pass on the problem's TeX and `import sympy`     aim 1.5
    edit of a given to PDF    / the same                                                      aim 2.5
    edit of a word, warm      / one pdflatex pass; until `derive build --watch` writes the PDF aim 1.2
    make, nothing to do       in milliseconds                                                 aim 30
    derive --help             / `python -P -c pass`                                           aim 3

All times are measured one after another in a copy of the repository, so a slow machine changes the seconds but hardly
the ratios. Each time is the median of several repetitions (the library is built once). No test depends on these
figures.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from derive.building.cache import Cache, Kept, digest
from derive.building.tex import chosen_engine, typeset

ROOT = Path(__file__).resolve().parent.parent
ROUNDS = 5
SET, PROBLEM, LIBRARY = "hw9", "block", "library"


def seconds(work: Callable[[], object], before: Callable[[], object] = lambda: None, rounds: int = ROUNDS) -> float:
    """Return the median time of `work`; `before` runs before each round, and its time is not counted."""
    times = []
    for _ in range(rounds):
        before()
        started = time.perf_counter()
        work()
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def run(*command: str) -> Callable[[], object]:
    return lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def copied_tree(folder: Path) -> Path:
    """Copy the sources and link the environment."""
    ignored = shutil.ignore_patterns(".venv*", ".git", "build", "__pycache__", ".*_cache", ".hypothesis")
    tree = Path(shutil.copytree(ROOT, folder / "tree", ignore=ignored))
    (tree / ".venv").symlink_to(ROOT / ".venv")
    return tree


class Edited:
    """The file of a problem; each edit writes a new text."""

    def __init__(self, file: Path):
        self.file, self.text, self.edits = file, file.read_text(), 0

    def word(self) -> None:
        self._replace(r"^title: .*$", lambda edit: f"title: A block, edited {edit} times")

    def given(self) -> None:
        self._replace(r"^  sides: .*$", lambda edit: f"  sides: [a, 2*a, {edit + 3}*a]")

    def _replace(self, pattern: str, line: Callable[[int], str]) -> None:
        self.edits += 1
        self.text, found = re.subn(pattern, line(self.edits), self.text, count=1, flags=re.MULTILINE)
        assert found, pattern
        self.file.write_text(self.text)


@contextmanager
def watched(tree: Path) -> Iterator[Callable[[str], None]]:
    """Run `derive build --watch` and yield a function that waits until it prints a text."""
    command = [sys.executable, "-P", "-m", "derive", "build", "--watch", SET]
    with subprocess.Popen(command, cwd=tree, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        lines = iter(process.stdout.readline, "")
        until: Callable[[str], None] = lambda said: next(filter(lambda line: said in line, lines)) and None  # noqa: E731
        try:
            until(f"{SET}: derived")
            yield until
        finally:
            process.send_signal(signal.SIGINT)


def warm(tree: Path, edit: Callable[[], None]) -> float:
    """Return the median time from an edit to the problem's PDF while `derive build --watch` runs."""
    times = []
    with watched(tree) as until:
        for _ in range(ROUNDS):
            edit()
            started = time.perf_counter()
            until(f"/{PROBLEM}.pdf (")
            times.append(time.perf_counter() - started)
            until(f"{SET}: derived")
    return statistics.median(times)


def two_passes(pages: Path, folder: Path) -> float:
    """Return the time of two TeX passes on a whole document: twice the time of a pass with known page numbers."""
    engine, scratch, tex = chosen_engine(None), folder / "scratch.pdf", pages.read_text()
    beside = [(file.name, file.read_bytes()) for file in pages.parent.glob("*-*.pdf")]
    noted = Kept(Cache(folder / "noted" / pages.parent.name), digest("numbers"))
    typeset(tex, scratch, engine, numbers=noted, included=beside)
    return 2 * seconds(lambda: typeset(tex, scratch, engine, numbers=noted, included=beside), rounds=3)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        tree = copied_tree(Path(folder))
        os.chdir(tree)
        outputs, python = tree / "build", sys.executable
        clean, make, make_library = (run("make", "--silent", target) for target in ("clean", SET, LIBRARY))
        make()
        edited = Edited(tree / "problems" / SET / f"{PROBLEM}.yaml")
        page = (outputs / SET / f"{PROBLEM}.tex").read_text()

        pass_ = seconds(lambda: typeset(page, Path(folder) / "scratch.pdf", chosen_engine(None)))
        passes = two_passes(outputs / SET / "solutions.tex", Path(folder))
        sympy = seconds(run(python, "-P", "-c", "import sympy"))
        cold = seconds(make, before=clean)
        word = seconds(make, before=edited.word)
        given = seconds(make, before=edited.given)
        idle = seconds(make, rounds=4 * ROUNDS)
        warm_word = warm(tree, edited.word)
        usage = seconds(run(python, "-P", "-m", "derive", "--help"), rounds=2 * ROUNDS)
        empty = seconds(run(python, "-P", "-c", "pass"), rounds=2 * ROUNDS)
        library = seconds(make_library, rounds=1)
        library_passes = two_passes(outputs / LIBRARY / "solutions.tex", Path(folder))

    for name, took, least, of, aim in (
        (f"cold build of {SET}", cold, passes + sympy, "2 passes + sympy", "2"),
        (f"cold build of the {LIBRARY}", library, library_passes + sympy, "2 passes + sympy", "3"),
        ("edit of a word to PDF", word, pass_ + sympy, "1 pass + sympy", "1.5"),
        ("edit of a given to PDF", given, pass_ + sympy, "1 pass + sympy", "2.5"),
        ("edit of a word, warm", warm_word, pass_, "1 pass", "1.2"),
        ("derive --help", usage, empty, "python -P -c pass", "3"),
    ):
        print(f"{name:25}{took:6.2f} s {took / least:6.2f} x {of:18} aim {aim}")
    print(f"{'make, nothing to do':25}{1000 * idle:6.0f} ms{'':28} aim 30 ms")
    print(f"(one pass {pass_:.2f} s, import sympy {sympy:.2f} s, python -P -c pass {empty:.3f} s)")


if __name__ == "__main__":
    main()
