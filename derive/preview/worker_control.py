"""How the server controls the worker of a preview: it sends a question, waits, and replaces a slow worker.

The worker has the limits of a build's workers.
"""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from derive.building.files import of_system
from derive.building.workers import Job, died, job_of, lines_told, memory_limit, overtaxed
from derive.errors import BuildFailed, Complaint, DeriveError

STEP = 0.05  # seconds between two checks whether an answer is still needed
PATIENCE = 1.0  # seconds after which work is stopped if a newer edit has made it useless


@dataclass(frozen=True)
class Shown:
    """The content for a browser: the main part of a page, or the errors in the files of the problem."""

    main: str = ""
    complaints: tuple[str, ...] = ()
    seconds: float = 0.0


class _Worker:
    """The worker's process, and the server's ends of its pipes: questions, answers, trace, and a lifeline.

    Nothing is written to the lifeline. When the server ends, the lifeline closes, and then the process ends, too.
    """

    def __init__(self, root: Path):
        limit, pipes = memory_limit(), _pipes(4)
        (questions, self._asks), (self._answers, answers), (self.trace, traced), (lifeline, self._lifeline) = pipes
        theirs = (questions, answers, traced, lifeline)
        try:
            command = [sys.executable, "-P", "-m", "derive.preview.worker", str(root), str(limit), *map(str, theirs)]
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                pass_fds=theirs,
                env={**os.environ, "PYTHONIOENCODING": "utf-8:backslashreplace"},  # for output of a script
                start_new_session=True,  # Ctrl-C goes to the server, which ends the worker
            )
        except OSError:
            self._close()
            raise
        finally:
            for end in theirs:
                os.close(end)
        os.set_blocking(self.trace, False)
        self._said = b""
        self._asked = 0
        self._guard = threading.Lock()

    @property
    def process(self) -> int:
        return self._process.pid

    def ask(self, **question: Any) -> None:
        self._asked += 1
        with suppress(BrokenPipeError):  # reading the answer will show that the process has ended
            os.write(self._asks, json.dumps({"number": self._asked, **question}).encode() + b"\n")

    def answer(self, seconds: float) -> bytes | None:
        if select.select([self._answers], [], [], seconds)[0]:
            more = os.read(self._answers, 1 << 16)
            if not more:
                return b""
            self._said += more
        line, ended, rest = self._said.partition(b"\n")
        if not ended:
            return None
        self._said = rest
        return line + ended

    def read(self, line: bytes) -> dict[str, Any] | None:
        """Return the answer in a line; None if the line is not an answer to the last question."""
        try:
            said = json.loads(line)
        except ValueError:
            return None
        return said if isinstance(said, dict) and said.get("number") == self._asked else None

    def ended(self) -> int:
        """Return the exit code of the process; 0 if it has not ended after a second."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(1)
        return self._process.returncode or 0

    def is_alive(self) -> bool:
        with self._guard:
            return self._process.poll() is None

    def kill(self) -> None:
        with self._guard, suppress(OSError):
            os.killpg(self._process.pid, signal.SIGKILL)

    def end(self) -> None:
        self.kill()
        with self._guard:
            self._process.wait()
        self._close()

    def _close(self) -> None:
        for end in (self._asks, self._answers, self.trace, self._lifeline):
            os.close(end)


def _pipes(number: int) -> list[tuple[int, int]]:
    """Return `number` pipes; if there are too few descriptors, close the pipes already made and raise the error."""
    found: list[tuple[int, int]] = []
    try:
        while len(found) < number:
            found.append(os.pipe())
    except OSError:
        for end in (end for pipe in found for end in pipe):
            os.close(end)
        raise
    return found


@dataclass
class Warm:
    """A worker whose process is started when it is first needed, but never after the end of the preview."""

    root: Path
    limit: float
    _worker: _Worker | None = field(default=None, repr=False)
    _asking: threading.RLock = field(default_factory=threading.RLock, repr=False)
    _over: bool = False

    def page(self, problem_id: str, detail: str | None, idle: Callable[[], bool] = lambda: False) -> Shown | None:
        """Return the page of a problem; None if `idle` says that this page is not needed any more, or if the preview is
        over."""
        started = time.monotonic()
        with self._asking:
            try:
                said = self._said(problem_id, detail, idle, started)
            except OSError as error:
                said = {"error": of_system(error, "the worker of the preview cannot start") or _refused(error)}
            except DeriveError as error:
                said = {"error": error}
        if said is None:
            return None
        stopped = said.get("error")
        if isinstance(stopped, DeriveError):
            return Shown(complaints=tuple(each.shown() for each in stopped.complaints))
        return Shown(said.get("main", ""), tuple(said.get("complaints", ())), time.monotonic() - started)

    def _said(
        self, problem_id: str, detail: str | None, idle: Callable[[], bool], started: float
    ) -> dict[str, Any] | None:
        worker = self.begun()
        if worker is None:
            return None
        worker.ask(problem=problem_id, detail=detail, limit=self.limit)
        job = partial(job_of, self.root, problem_id, lambda: None, self.limit)
        while (line := worker.answer(STEP)) is None:
            seconds = time.monotonic() - started
            if seconds > PATIENCE and idle():
                self._end()
                return None
        if not line:
            return None if self._over else self._ended(died(job(), worker.ended(), lines_told(worker.trace)))
        if (said := worker.read(line)) is None:
            return self._ended(_disturbed(job()))
        if limit := said.get("limit"):
            return self._ended(overtaxed(job(), limit, lines_told(worker.trace)))
        if said.get("ends"):
            self._end()
        return said

    def begun(self) -> _Worker | None:
        """Return the process, and start it if necessary; None after the end of the preview."""
        with self._asking:
            if self._worker is not None and not self._worker.is_alive():
                self._end()
            if self._worker is None and not self._over:
                self._worker = _Worker(self.root)
            return self._worker

    def _ended(self, error: DeriveError) -> dict[str, Any]:
        self._end()
        return {"error": error}

    def _end(self) -> None:
        if self._worker is not None:
            self._worker.end()
            self._worker = None

    def end(self) -> None:
        """End the worker permanently; a waiting question gets no answer."""
        self._over = True
        worker = self._worker
        if worker is not None:
            worker.kill()
        if self._asking.acquire(timeout=2):
            try:
                self._end()
            finally:
                self._asking.release()


def _disturbed(job: Job) -> BuildFailed:
    message = f"{job.name} has written into the file descriptor on which its process answers"
    help_ = "a script may write to standard output and to files that it opens itself"
    return BuildFailed(Complaint("worker-died", message, help=help_))


def _refused(error: OSError) -> BuildFailed:
    reason = (error.strerror or str(error)).lower()
    return BuildFailed(Complaint("system", f"the worker of the preview cannot start: {reason}"))
