"""Measure the times of pages for a browser. Run by `make bench`.

    edit of a word, previewed    from the change of the file until `derive preview` reports the page     aim 0.3 s
    edit of a given, previewed   the same, minus the time of the derivation alone without a cache        aim 0.3 s
    HTML of a set                divided by the time of its PDFs, with derivations from the cache        aim 0.5
    HTML of a set, cold          the same, with everything derived and drawn                             aim 0.5

Each edit writes a text that was not in the file before. The derivation alone is timed for the same edit, just after it,
in a process that, like the preview, has derived the problem before. The pages of the set are those that a build makes.
They are made one after another, in a process that has loaded all modules. Each figure is the least of several runs,
except for "cold", which is a single run.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from http.client import HTTPConnection
from pathlib import Path
from typing import Any

from bench.ratios import PROBLEM, ROUNDS, SET, Edited, copied_tree, seconds
from derive.building.cache import Cache, Kept, digest
from derive.building.preload import preload
from derive.building.set_document import index_page, problem_document, problem_page, the_document
from derive.building.solution import derived, rendered
from derive.building.tex import chosen_engine, typeset
from derive.building.workers import Job, done
from derive.course.names import SOLUTIONS
from derive.course.problem import load_problem
from derive.course.problem_set import problem_set
from derive.render.formats import HTML, TYPESET
from derive.render.rendered import Rendered

LIMIT = 1000.0  # seconds allowed for one stage

# --- an edited page --------------------------------------------------------------------------------------------------


@contextmanager
def previewed(tree: Path) -> Iterator[Callable[[], str]]:
    """Run `derive preview` and yield a function that waits until the page has changed and returns the new page."""
    command = [sys.executable, "-P", "-m", "derive", "preview", f"{SET}/{PROBLEM}", "--port", "0"]
    with subprocess.Popen(command, cwd=tree, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        host = process.stdout.readline().split("/")[2]
        asked = HTTPConnection(host, timeout=LIMIT)
        asked.request("GET", f"/{PROBLEM}/events")
        events, shown = asked.getresponse(), ""

        def another() -> str:
            nonlocal shown
            before = shown
            while shown in ("", before):
                line = events.readline()
                shown = json.loads(line[5:])["main"] if line.startswith(b"data:") else shown
            return shown

        try:
            another()
            yield another
        finally:
            asked.close()
            process.send_signal(signal.SIGINT)


def edits(tree: Path) -> dict[str, float]:
    """Return the seconds until an edited page is reported, for a word and for a given, and those of the derivation
    alone.
    """
    edited = Edited(tree / "problems" / SET / f"{PROBLEM}.yaml")
    alone: Callable[[], Any] = lambda: derived(load_problem(tree, f"{SET}/{PROBLEM}"))  # noqa: E731
    alone()
    with previewed(tree) as another:
        edited.given()
        another()  # this loads all modules that draw
        words = [_until(edited.word, another) for _ in range(2 * ROUNDS)]
        givens = [(_until(edited.given, another), seconds(alone, rounds=1)) for _ in range(ROUNDS)]
    return dict(zip(("given", "derivation", "word"), map(min, (*zip(*givens, strict=True), words)), strict=True))


def _until(edit: Callable[[], None], another: Callable[[], str]) -> float:
    started = time.perf_counter()
    edit()
    another()
    return time.perf_counter() - started


# --- the pages of a set ----------------------------------------------------------------------------------------------


def pages(root: Path, cache: Cache, formats: tuple[str, ...]) -> list[Rendered]:
    ids = problem_set(root, SET).problems
    return [rendered(root, problem, None, cache, draws=True, only=formats) for problem in ids]


def html(root: Path, cache: Cache) -> None:
    heading, problems = problem_set(root, SET), pages(root, cache, (HTML,))
    for problem in problems:
        problem_page(root, problem, heading)
    index_page(root, heading, problems)


def pdf(root: Path, cache: Cache) -> None:
    heading, problems, engine = problem_set(root, SET), pages(root, cache, TYPESET), chosen_engine(None)
    documents = {each.id.rpartition("/")[2]: (problem_document(root, each, heading), None) for each in problems}
    for kind, _ in heading.documents:
        numbers = Kept(cache, digest("numbers", kind)) if kind == SOLUTIONS else None
        documents[kind] = the_document(kind)(root, heading, problems), numbers
    files = [file for each in problems for file in each.files if file[0].endswith(".pdf")]
    with tempfile.TemporaryDirectory() as folder:
        for name, (tex, numbers) in documents.items():
            typeset(tex, Path(folder) / f"{name}.pdf", engine, numbers=numbers, included=files, formats=cache)


def in_a_worker(work: Callable[[], None]) -> Callable[[], None]:
    """Return a function that does `work` in a process that has made no page before."""
    return lambda: done(Job("pages", work, LIMIT))


def sets(tree: Path, folder: Path) -> dict[str, tuple[float, float]]:
    """Return the seconds of HTML and of PDF, with derivations from the cache and without."""
    preload(tree, derives=True, draws=True)
    caches = Cache(folder / "html"), Cache(folder / "pdf")
    works = [in_a_worker(partial(make, tree, cache)) for make, cache in zip((html, pdf), caches, strict=True)]
    cold = [seconds(work, rounds=1) for work in works]
    times = zip(*([seconds(work, rounds=1) for work in works] for _ in range(ROUNDS)), strict=True)
    return {"": tuple(map(min, times)), ", cold": tuple(cold)}


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        tree = copied_tree(Path(folder))
        os.chdir(tree)
        took = edits(tree)
        print(f"{'edit of a word, previewed':28}{took['word']:6.2f} s{'':36} aim 0.3 s")
        told = f"{took['derivation']:.2f} s of derivation"
        more = took["given"] - took["derivation"]
        print(f"{'edit of a given, previewed':28}{took['given']:6.2f} s {more:6.2f} s over {told:22} aim 0.3 s")
        for how, (web, kind) in sets(tree, Path(folder)).items():
            print(f"{f'HTML of {SET}{how}':28}{web:6.2f} s {web / kind:6.2f} x its PDFs{'':18} aim 0.5")


if __name__ == "__main__":
    main()
