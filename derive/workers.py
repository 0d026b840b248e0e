"""Forked workers: each job runs in a child of one warm process, with a time limit, and can be killed at any moment.

What a job returns or raises comes back to the parent. A child leads a process group of its own, so that killing it
takes its TeX along, and it ends by itself if the parent is gone. The parent starts no threads, so forking is safe.
"""

from __future__ import annotations

import contextlib
import gc
import multiprocessing
import os
import signal
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from typing import Any

from derive.errors import BuildFailed, Complaint, DeriveError

TIME_LIMIT = 120.0
_TICK = 0.2


class Bug(Exception):
    """Something in derive itself failed inside a worker; carries that worker's traceback."""

    def __init__(self, summary: str, trace: str):
        super().__init__(summary, trace)

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def trace(self) -> str:
        return str(self.args[1])


@dataclass(frozen=True)
class Job:
    """A piece of work, named as the user knows it."""

    name: str
    work: Callable[[], Any]
    limit: float = TIME_LIMIT


@dataclass(frozen=True)
class Outcome:
    """What became of a job: its value, or the error that ended it."""

    job: Job
    value: Any
    error: DeriveError | Bug | None
    seconds: float


@dataclass
class _Worker:
    job: Job
    child: ForkProcess
    pipe: Connection
    started: float = field(default_factory=time.monotonic)

    @property
    def seconds(self) -> float:
        return time.monotonic() - self.started


class Crew:
    """At most `size` workers at a time; leaving the `with` block kills whatever still runs."""

    def __init__(self, size: int, tick: Callable[[list[str]], None] | None = None):
        self._size = max(1, size)
        self._tick = tick or (lambda _: None)
        self._waiting: deque[Job] = deque()
        self._running: list[_Worker] = []
        self._fork = multiprocessing.get_context("fork")
        self._lifeline = os.pipe()

    def __enter__(self) -> Crew:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._running:
            _kill(worker)
        for end in self._lifeline:
            os.close(end)

    def put(self, job: Job) -> None:
        self._waiting.append(job)

    def outcomes(self) -> Iterator[Outcome]:
        """Each job's outcome as it ends; more jobs may be put meanwhile."""
        while self._waiting or self._running:
            while self._waiting and len(self._running) < self._size:
                self._running.append(self._started(self._waiting.popleft()))
            self._tick([worker.job.name for worker in self._running])
            wait([worker.pipe for worker in self._running], timeout=_TICK)
            for worker in list(self._running):
                outcome = _outcome(worker)
                if outcome:
                    self._running.remove(worker)
                    yield outcome

    def _started(self, job: Job) -> _Worker:
        ours, theirs = self._fork.Pipe(duplex=False)
        child = self._fork.Process(target=_child, args=(job.work, theirs, self._lifeline), daemon=False)
        child.start()
        with contextlib.suppress(OSError):  # the child does the same; whoever is first
            os.setpgid(child.pid or 0, child.pid or 0)
        theirs.close()
        return _Worker(job, child, ours)


def done(job: Job) -> Any:
    """The value of one job, run in a worker."""
    with Crew(1) as crew:
        crew.put(job)
        outcome = next(crew.outcomes())
    if outcome.error:
        raise outcome.error
    return outcome.value


def _outcome(worker: _Worker) -> Outcome | None:
    job, seconds = worker.job, worker.seconds
    if worker.pipe.poll():
        try:
            value, error = worker.pipe.recv()
        except EOFError:
            worker.child.join()
            value, error = None, _died(job, worker.child.exitcode or 0)
    elif seconds > job.limit:
        help_ = "look for an endless loop in its script, or raise `--time-limit`"
        value, error = None, BuildFailed(Complaint("time-limit", f"{job.name} took over {job.limit:g} s", help=help_))
    else:
        return None
    _kill(worker)
    return Outcome(job, value, error, seconds)


def _died(job: Job, code: int) -> BuildFailed:
    why = f"signal {-code}" if code < 0 else f"exit code {code}"
    return BuildFailed(Complaint("worker-died", f"{job.name} ended without a word: {why}", help="was memory short?"))


def _kill(worker: _Worker) -> None:
    with contextlib.suppress(OSError):
        os.killpg(worker.child.pid or 0, signal.SIGKILL)
    worker.child.join()
    worker.pipe.close()


def _child(work: Callable[[], Any], pipe: Connection, lifeline: tuple[int, int]) -> None:
    with contextlib.suppress(OSError):
        os.setpgid(0, 0)
    for signum in (signal.SIGINT, signal.SIGTERM):
        signal.signal(signum, signal.SIG_DFL)
    os.close(lifeline[1])
    threading.Thread(target=_end_with_parent, args=(lifeline[0],), daemon=True).start()
    # A worker is short-lived: collecting garbage in it often costs more than the garbage.
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
    # What a script prints is for the person at the terminal, not part of the answer.
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    value: Any = None
    error: DeriveError | Bug | None = None
    try:
        value = work()
    except DeriveError as stopped:
        error = stopped
    except BaseException as bug:
        error = Bug(f"{type(bug).__name__}: {bug}", traceback.format_exc())
    sys.stdout.flush()
    pipe.send((value, error))
    pipe.close()


def _end_with_parent(lifeline: int) -> None:
    os.read(lifeline, 1)  # returns when the last writer, the parent, is gone
    os.killpg(0, signal.SIGKILL)
