"""Sets built again at each edit, by one process that keeps what it has loaded.

Many times in a second the times of all files are compared. That takes a hundredth of a processor, and needs neither a
package nor a thread, beside which it would not be safe to fork; and it sees what is edited over a network. An edit ends
the build that is under way, and what that has finished is kept: so several files saved at once are one edit.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from derive import FOLDER
from derive.building.cache import folder_digest
from derive.building.loaded import load
from derive.building.named import check_asked
from derive.building.sets import Edits, Ended, Options, Report, Superseded, built_set
from derive.building.tex import chosen_engine
from derive.errors import BuildFailed, Complaint, DeriveError

__all__ = ["Shown", "watch"]

EVERY, ENGINE_EVERY = 0.04, 1.0  # seconds between two looks at the files
WRITTEN, DEPTH = (".yaml", ".py", ".j2"), 4

Seen = Mapping[str, tuple[int, int, int]]


@dataclass(frozen=True)
class Shown:
    """How somebody who edits is told.

    under_way  what is done just now
    wrote      a PDF that changed, and how many seconds that took
    built      what a build did
    refused    why there was none
    ended      each piece of work that is done
    """

    under_way: Callable[[str], None]
    wrote: Callable[[Path, float], None]
    built: Callable[[Report], None]
    refused: Callable[[Sequence[Complaint]], None]
    ended: Callable[[Ended], None] = lambda _: None


def watch(root: Path, asked: Mapping[str, tuple[str, ...]], options: Options, shown: Shown) -> None:
    """Build these problems of these sets, all of a set where none is named, and again at each edit; it has no end."""
    chosen_engine(options.engine)  # or what is wrong with it, before anything is built
    for set_id, names in asked.items():
        check_asked(root, set_id, names)
    watching = _Watch(root, asked, options, shown)
    while True:
        watching.build()
        watching.wait()


class _Watch:
    """What has been loaded and seen."""

    def __init__(self, root: Path, asked: Mapping[str, tuple[str, ...]], options: Options, shown: Shown):
        self.root, self.asked, self.options, self.shown = root, asked, options, shown
        self.own = Path(FOLDER)
        self.folders = [root / "problems", *(each / "templates" for each in (root, self.own, self.own.parent))]
        self.loaded, self.engine = folder_digest(self.own, "*.py"), seen_in([self.own])
        load(root, derives=True, draws=True)
        self.files: Seen = {}

    def build(self) -> None:
        """All that is asked, in order, until nothing is edited meanwhile."""
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
                message = "derive itself has been edited, and what is loaded is derive as it was"
                raise BuildFailed(Complaint("restart", message, help="end this and start it again"))
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
        """What is said of files that are not what they were is of no use, such as of one that was half written."""
        if self._edited():
            raise Superseded

    def wait(self) -> None:
        """Until there is an edit."""
        looked = time.monotonic()
        while not self._edited():
            time.sleep(EVERY)
            if time.monotonic() - looked > ENGINE_EVERY:
                looked, before, self.engine = time.monotonic(), self.engine, seen_in([self.own])
                if self.engine != before:
                    self.files = {}


def seen_in(folders: Sequence[Path]) -> Seen:
    """When each file that somebody writes was written, and which it is; not those of editors' own."""
    found, waiting = {}, [(str(folder), 0) for folder in folders]
    while waiting:
        folder, depth = waiting.pop()
        try:
            with os.scandir(folder) as entries:
                for entry in entries:
                    if entry.name.startswith((".", "__pycache__")):
                        continue
                    if entry.is_dir() and depth < DEPTH:  # a link may lead back
                        waiting.append((entry.path, depth + 1))
                    elif entry.name.endswith(WRITTEN):
                        facts = entry.stat()
                        found[entry.path] = (facts.st_mtime_ns, facts.st_size, facts.st_ino)
        except OSError:  # what is taken away meanwhile is seen next time
            continue
    return found
