"""How long derive takes, as ratios to the least that the same work could take. Run by `make bench`.

    cold build of the set   over two pdflatex passes on its TeX and `import sympy`            aim 1.5
    edit to PDF             over one pdflatex pass on the problem's TeX and `import sympy`    aim 2
    make, nothing changed   in milliseconds                                                   aim 30
    derive --help           over `python -c pass`                                             aim 3

Everything is measured side by side in one run, in a copy of the tree, each figure the median of several, so that a slow
machine changes the seconds and hardly the ratios. These are figures to look at; no test depends on them.
"""

from __future__ import annotations

import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from derive.building.cache import Cache, Kept, digest
from derive.building.tex import chosen_engine, typeset

ROOT = Path(__file__).resolve().parent.parent
ROUNDS = 5
SET, PROBLEM = "hw9", "block"


def seconds(work: Callable[[], object], before: Callable[[], object] = lambda: None, rounds: int = ROUNDS) -> float:
    """The median time of `work`, with `before` done before each round and not counted."""
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
    """The sources as they are, and the environment by a link."""
    ignored = shutil.ignore_patterns(".venv*", ".git", "build", "__pycache__", ".*_cache", ".hypothesis")
    tree = Path(shutil.copytree(ROOT, folder / "tree", ignore=ignored))
    (tree / ".venv").symlink_to(ROOT / ".venv")
    return tree


def edited(file: Path) -> None:
    """Reword the title, as an instructor would."""
    text = file.read_text()
    file.write_text(re.sub(r"^title: (.*)$", r"title: \1 once more", text, count=1, flags=re.MULTILINE))


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        tree = copied_tree(Path(folder))
        os.chdir(tree)
        outputs = tree / "build" / SET
        clean = run("make", "--silent", "clean")
        make = run("make", "--silent", SET)
        make()
        pages = (outputs / "solutions.tex").read_text()
        page = (outputs / f"{PROBLEM}.tex").read_text()
        engine, scratch = chosen_engine(None), Path(folder) / "scratch.pdf"
        python, script = sys.executable, tree / "problems" / SET / f"{PROBLEM}.yaml"

        noted = Kept(Cache(Path(folder) / "noted"), digest("numbers"))  # with the page numbers known, one pass is one
        typeset(pages, scratch, engine, numbers=noted)
        whole_pass = seconds(lambda: typeset(pages, scratch, engine, numbers=noted))
        one_pass = seconds(lambda: typeset(page, scratch, engine))
        sympy = seconds(run(python, "-c", "import sympy"))
        cold = seconds(make, before=clean)
        edit = seconds(make, before=lambda: edited(script))
        idle = seconds(make, rounds=4 * ROUNDS)
        usage = seconds(run(str(Path(python).with_name("derive")), "--help"), rounds=2 * ROUNDS)
        empty = seconds(run(python, "-c", "pass"), rounds=2 * ROUNDS)

    print(
        f"cold build of {SET}     {cold:.2f} s   {cold / (2 * whole_pass + sympy):.2f} x (2 passes + sympy)   aim 1.5"
    )
    print(f"edit to PDF           {edit:.2f} s   {edit / (one_pass + sympy):.2f} x (1 pass + sympy)     aim 2")
    print(f"make, nothing to do   {1000 * idle:.0f} ms                                aim 30 ms")
    print(f"derive --help         {usage:.2f} s   {usage / empty:.2f} x python -c pass          aim 3")
    print(f"(one pass {whole_pass:.2f} s, import sympy {sympy:.2f} s, python -c pass {empty:.3f} s)")


if __name__ == "__main__":
    main()
