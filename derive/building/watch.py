"""Builds of sets after each edit, in one process that loads its modules only once.

The times and sizes of the files are compared many times a second, which also detects edits on a network drive. An edit
stops the running build; finished work is kept.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from derive import FOLDER
from derive.building.cache import folder_digest
from derive.building.preload import preload
from derive.building.set_names import check_asked
from derive.building.sets import Edits, Options, Report, Superseded, built_set
from derive.building.tex import chosen_engine
from derive.building.workers import Ended
from derive.course.problem_set import COURSE
from derive.errors import BuildFailed, Complaint, DeriveError

__all__ = ["Shown", "watch"]

EVERY, ENGINE_EVERY = 0.04, 1.0  # seconds between two comparisons of the author's files, and of derive's modules
WRITTEN, DEPTH = (".yaml", ".py", ".j2"), 4

Seen = Mapping[str, tuple[int, int, int]]


@dataclass(frozen=True)
class Shown:
    """The functions that inform an author who edits.

    under_way  a function that shows the work that is being done
    wrote      a function that reports that a PDF has changed, and after how many seconds
    built      a function that shows the report of a finished build
    refused    a function that shows the errors that prevented a build
    ended      a function that reports a finished piece of work
    """

    under_way: Callable[[str], None]
    wrote: Callable[[Path, float], None]
    built: Callable[[Report], None]
    refused: Callable[[Sequence[Complaint]], None]
    ended: Callable[[Ended], None] = lambda _: None


def watch(root: Path, asked: Mapping[str, tuple[str, ...]], options: Options, shown: Shown) -> None:
    """Build these problems of these sets, and build them again after each edit, until interrupted."""
    chosen_engine(options.engine)  # raises errors about the engine before anything is built
    for set_id, names in asked.items():
        check_asked(root, set_id, names)
    watching = _Watch(root, asked, options, shown)
    while True:
        watching.build()
        watching.wait()


class _Watch:
    def __init__(self, root: Path, asked: Mapping[str, tuple[str, ...]], options: Options, shown: Shown):
        self.root, self.asked, self.options, self.shown = root, asked, options, shown
        self.own = Path(FOLDER)
        folders = (each / "templates" for each in (root, self.own, self.own.parent))
        self.folders = [root / COURSE, root / "problems", *folders]
        self.loaded, self.engine = folder_digest(self.own, "*.py"), seen_in([self.own])
        preload(root, derives=True, draws=True)
        self.files: Seen = {}

    def build(self) -> None:
        """Build all requested sets in order; begin again if a file was edited meanwhile."""
        while self._edited():
            self.files, begun = seen_in(self.folders), time.monotonic()
            try:
                for set_id, names in self.asked.items():
                    self._build(set_id, replace(self.options, only=names), begun)
            except Superseded:
                continue

    def _build(self, set_id: str, options: Options, begun: float) -> None:
        def wrote(path: Path) -> None:
            self.shown.wrote(path, time.monotonic() - begun)

        try:
            if folder_digest(self.own, "*.py") != self.loaded:
                message = "derive itself has been edited, but this command still uses the modules that it loaded before"
                raise BuildFailed(Complaint("restart", message, help="stop this command and start it again"))
            edits = Edits(self._edited, wrote)
            report = built_set(self.root, set_id, options, self.shown.under_way, edits, self.shown.ended)
        except DeriveError as error:
            self._check_edited()
            self.shown.refused(error.complaints)
        else:
            self._check_edited()
            self.shown.built(report)

    def _edited(self) -> bool:
        return seen_in(self.folders) != self.files

    def _check_edited(self) -> None:
        if self._edited():
            raise Superseded

    def wait(self) -> None:
        looked = time.monotonic()
        while not self._edited():
            time.sleep(EVERY)
            if time.monotonic() - looked > ENGINE_EVERY:
                looked, before, self.engine = time.monotonic(), self.engine, seen_in([self.own])
                if self.engine != before:
                    self.files = {}


def seen_in(paths: Sequence[Path]) -> Seen:
    """Return the time, size and identity of each of these files, and of each file in these folders that an author may
    have written."""
    found, waiting = dict[str, tuple[int, int, int]](), list[tuple[str, int]]()
    for path in paths:
        if path.is_file():
            facts = path.stat()
            found[str(path)] = (facts.st_mtime_ns, facts.st_size, facts.st_ino)
        else:
            waiting.append((str(path), 0))
    while waiting:
        folder, depth = waiting.pop()
        try:
            with os.scandir(folder) as entries:
                for entry in entries:
                    if entry.name.startswith((".", "__pycache__")):
                        continue
                    if entry.is_dir() and depth < DEPTH:  # a link may lead back to a folder above it
                        waiting.append((entry.path, depth + 1))
                    elif entry.name.endswith(WRITTEN):
                        facts = entry.stat()
                        found[entry.path] = (facts.st_mtime_ns, facts.st_size, facts.st_ino)
        except OSError:  # the folder was just removed, which the next comparison detects
            continue
    return found
