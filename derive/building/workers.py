"""Workers: each job runs in a forked child process, has a time limit, and can be killed.

The result or the error of a job is sent to the parent. A child has its own process group, so that killing the child
also kills a TeX process that it started. A child ends if its parent ends.
"""

from __future__ import annotations

import contextlib
import faulthandler
import fcntl
import gc
import heapq
import multiprocessing
import os
import re
import resource
import select
import signal
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from pathlib import Path
from typing import Any

from derive.building.files import of_system
from derive.building.scratch import Scratch
from derive.building.time_limit import ended_by_clock, ended_by_processor_time, limited, wall_clock_limit
from derive.errors import BuildFailed, Complaint, DeriveError, Misused, OutOfTime, Place

TIME_LIMIT = 120.0
GIB = 2**30
MEMORY_LIMIT, SMALLEST_MEMORY = 4.0, 0.25  # GiB
TIME, MEMORY, TOO_DEEP = "time-limit", "memory-limit", "too-deep"  # error codes of the limits
_TICK = 0.1
_NAMED = 5  # the largest number of steps that a message names


class Bug(Exception):
    """An error in derive itself inside a worker, with that worker's traceback."""

    def __init__(self, summary: str, trace: str):
        super().__init__(summary, trace)

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def trace(self) -> str:
        return str(self.args[1])


@dataclass(frozen=True)
class Job:
    """A piece of work, with a name that the user knows. `shown_as` is the path of `file` in messages.

    Among waiting jobs, a job of the lowest `rank` begins first.
    """

    name: str
    work: Callable[[], Any]
    limit: float = TIME_LIMIT
    file: Path | None = None
    shown_as: str = ""
    rank: float = 0.0


def job_of(root: Path, problem_id: str, work: Callable[[], Any], limit: float = TIME_LIMIT) -> Job:
    """Return a job for a problem. Problems with long files begin first."""
    from derive.course.problem_set import found_path

    path = found_path(root, problem_id) or f"problems/{problem_id}.yaml"
    file = root / path
    length = sum(each.stat().st_size for each in (file, file.with_suffix(".py")) if each.is_file())
    return Job(f"`{problem_id}`", work, limit, file, path, rank=-length)


@dataclass(frozen=True)
class Outcome:
    """The outcome of a job: its value, or the error that ended it."""

    job: Job
    value: Any
    error: DeriveError | Bug | None
    seconds: float


@dataclass(frozen=True)
class Ended:
    """A finished piece of work: how it ended, its name, and its time.

    how   `derived`, `kept`, `typeset`, `made` or `failed`
    """

    how: str
    of: str
    seconds: float = 0.0


@dataclass
class _Worker:
    job: Job
    child: ForkProcess
    pipe: Connection
    trace: int  # a pipe to which a worker that is stopped writes the lines that it was running
    started: float = field(default_factory=time.monotonic)

    @property
    def seconds(self) -> float:
        return time.monotonic() - self.started


class Crew:
    """At most `size` workers at a time; leaving the `with` block kills running workers."""

    def __init__(self, size: int, tick: Callable[[Mapping[str, float]], None] | None = None):
        """`tick` is called repeatedly with the names of the running jobs, each with the seconds that it has run."""
        self._size = max(1, size)
        self._tick = tick or (lambda _: None)
        self._waiting: list[tuple[float, int, Job]] = []  # a heap
        self._put = 0
        self._running: list[_Worker] = []
        self._fork = multiprocessing.get_context("fork")

    def __enter__(self) -> Crew:
        self._scratch = Scratch()
        self._lifeline = _pipe()
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._running:
            _kill(worker)
        for end in self._lifeline:
            os.close(end)
        self._scratch.cleanup()

    def put(self, job: Job) -> None:
        self._put += 1
        heapq.heappush(self._waiting, (job.rank, self._put, job))

    def start(self) -> None:
        """Start waiting jobs while workers are free; do not wait for any result."""
        while self._waiting and len(self._running) < self._size:
            self._running.append(self._started(heapq.heappop(self._waiting)[2]))

    def outcomes(self) -> Iterator[Outcome]:
        """Yield the outcome of each job as soon as the job ends; jobs may be added meanwhile."""
        while self._waiting or self._running:
            self.start()
            self._tick({worker.job.name: worker.seconds for worker in self._running})
            wait([worker.pipe for worker in self._running], timeout=_TICK)
            for worker in list(self._running):
                outcome = _outcome(worker)
                if outcome:
                    self._running.remove(worker)
                    yield outcome

    def _started(self, job: Job) -> _Worker:
        limit = memory_limit()
        try:
            ours, theirs = self._fork.Pipe(duplex=False)
            trace, traced = os.pipe()
            os.set_blocking(trace, False)
            told = (job, theirs, self._lifeline, traced, limit, self._scratch.name)
            child = self._fork.Process(target=_child, args=told)
            with _undisturbed():
                child.start()
        except OSError as error:
            raise of_system(error, f"cannot start a process for {job.name}") or error from None
        with contextlib.suppress(OSError):  # the child makes the same call, and may make it first
            os.setpgid(child.pid or 0, child.pid or 0)
        theirs.close()
        os.close(traced)
        return _Worker(job, child, ours, trace)


def under_way(running: Mapping[str, float], set_id: str = "") -> str:
    """Return text such as `block 2 s, pages of top 1 s`."""
    longest = sorted(running.items(), key=lambda each: -each[1])
    named = [(job.removeprefix("the ").replace(f"`{set_id}/", "`").replace("`", ""), s) for job, s in longest]
    return ", ".join(f"{name} {seconds:.0f} s" for name, seconds in named)


def _pipe() -> tuple[int, int]:
    try:
        return os.pipe()
    except OSError as error:
        raise of_system(error) or error from None


@contextlib.contextmanager
def _undisturbed() -> Iterator[None]:
    """Delay signals during a fork, because Python could lose them."""
    signals = (signal.SIGINT, signal.SIGTERM)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def memory_limit() -> int:
    """Return how many bytes of memory a worker may use; DERIVE_MEMORY gives the limit in GiB."""
    text = os.environ.get("DERIVE_MEMORY", "").strip()
    if not text:
        return round(MEMORY_LIMIT * GIB)
    if not re.fullmatch(r"\d{1,5}(\.\d{1,3})?", text, re.ASCII) or float(text) < SMALLEST_MEMORY:
        allowed = f"a number of GiB from {SMALLEST_MEMORY:g} to 99999.999, with at most three decimals"
        message = f"DERIVE_MEMORY must be {allowed}, but it is `{text[:40]}`"
        raise Misused(Complaint("memory-limit", message))
    return round(float(text) * GIB)


def done(job: Job) -> Any:
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
            value, error = None, died(job, worker.child.exitcode or 0, lines_told(worker.trace))
        except Exception as unread:  # the value cannot be read outside of the worker's process
            value, error = None, Bug(f"{type(unread).__name__}: {unread}", traceback.format_exc())
        if isinstance(error, str):
            error = overtaxed(job, error, lines_told(worker.trace))
    else:
        return None
    _kill(worker)
    return Outcome(job, value, error, seconds)


def _stopped(job: Job, code: str, message: str, help_: str, trace: str, notes: Iterable[str] = ()) -> BuildFailed:
    place = (_line_in(trace, job) or Place(job.shown_as, 1)) if job.file else None
    if place and place.path == job.shown_as and (reference := _reference_in(trace, job)):
        place, help_ = Place(reference, 1), f"check what this file states about {job.name}"
    return BuildFailed(Complaint(code, message, place, tuple(notes), help_))


def _reference_in(trace: str, job: Job) -> str:
    """Return the path of the reference file, if the worker was reading it or comparing steps with it."""
    path = f"{'/'.join(job.shown_as.split('/')[:2])}/reference.yaml"
    compares = re.search(r'^  File ".+/derive/course/reference/', trace, re.MULTILINE)
    there = compares and job.file and (job.file.parents[job.shown_as.count("/")] / path).is_file()
    return path if there else ""


def too_long(job: Job, trace: str, late: OutOfTime | None = None) -> BuildFailed:
    """Return the error of a worker at its time limit."""
    late = late or OutOfTime()
    asked = f", most recently for `{late.answers[-1]}`" if late.answers else ""
    took = f"{job.name} took over {job.limit:g} s of processor time{asked}"
    waited = f"{job.name} waited for over {job.limit:g} s{asked}"
    by_clock = f"{job.name} took over {wall_clock_limit(job.limit):g} s by the clock{asked}"
    message = waited if late.waited else by_clock if ended_by_clock(trace) else took
    notes = [f"it was at {', in '.join(late.doing)}"] if late.doing else []
    if late.finished:
        last = ", ".join(f"`{key}`" for key in late.finished[-_NAMED:])
        before = f" and {more} before them" if (more := len(late.finished) - _NAMED) > 0 else ""
        kept = "finished, and kept for the next attempt" if late.kept else "finished"
        notes.append(f"{kept}: {last}{before}")
    in_script = not late.doing and not late.answers
    help_ = "look for an endless loop in its script" if in_script else "ask for fewer answers, use fewer letters"
    return _stopped(job, TIME, message, f"{help_}, or raise `--time-limit`", trace, notes)


def died(job: Job, code: int, trace: str) -> BuildFailed:
    """Return the error of a worker that ended unexpectedly, with an exit code or by a signal."""
    if ended_by_processor_time(code) or ended_by_clock(trace):
        return too_long(job, trace)
    why = f"signal {-code}" if code < 0 else f"exit code {code}"
    message = f"{job.name} ended without a message: {why}"
    help_ = "check whether memory is short" if code < 0 else "look for a line of its script that ends the program"
    return _stopped(job, "worker-died", message, help_, trace)


def overtaxed(job: Job, what: str, trace: str) -> BuildFailed:
    """Return the error of a worker that reached the limit of its memory or of its stack."""
    if what == TOO_DEEP:
        help_ = "look for an endless recursion in its script, or for an expression with very many brackets"
        return _stopped(
            job, TOO_DEEP, f"calls or brackets in {job.name} are nested deeper than Python allows", help_, trace
        )
    message = f"{job.name} took more than {memory_limit() / GIB:g} GiB of memory"
    help_ = "look for a value that grows without bound, or set DERIVE_MEMORY to more GiB"
    return _stopped(job, MEMORY, message, help_, trace)


def lines_told(trace: int) -> str:
    """Return the lines that a worker has written to `trace`, without waiting for more."""
    try:
        return os.read(trace, 1 << 16).decode(errors="replace")
    except OSError:
        return ""


def _line_in(trace: str, job: Job) -> Place | None:
    """Return the innermost running line that belongs to a script in the folder of the problem's file, or None."""
    for name, line in re.findall(r'^  File "(.+)", line (\d+) in ', trace, re.MULTILINE):
        file = Path(name)
        if job.file and file.parent == job.file.parent:
            try:
                text = file.read_text(encoding="utf-8").splitlines()[int(line) - 1]
            except (OSError, ValueError, IndexError):
                text = ""
            indent = len(text) - len(text.lstrip())
            shown_as = f"{job.shown_as.rpartition('/')[0]}/{file.name}"
            return Place(shown_as, int(line), indent + 1, text[:150], max(1, len(text[:150].strip())))
    return None


def _kill(worker: _Worker) -> None:
    with contextlib.suppress(OSError):
        os.killpg(worker.child.pid or 0, signal.SIGKILL)
    worker.child.join()
    worker.pipe.close()
    with contextlib.suppress(OSError):
        os.close(worker.trace)


def _child(job: Job, pipe: Connection, lifeline: tuple[int, int], trace: int, limit: int, scratch: str) -> None:
    with contextlib.suppress(OSError):
        os.setpgid(0, 0)
    os.close(lifeline[1])
    confine(lifeline[0], trace, limit)
    tempfile.tempdir = scratch
    # A worker is short-lived, so it needs little garbage collection.
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
    # The output of a script is for the user and not part of the worker's result.
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    value, error = attempt(job, trace)
    with contextlib.suppress(OSError, ValueError):
        sys.stdout.flush()
    try:
        pipe.send((value, error))
    except MemoryError:
        pipe.send((None, MEMORY))
    except Exception as bug:  # the value cannot be sent to the parent
        pipe.send((None, _bug(bug)))
    pipe.close()


def attempt(job: Job, trace: int) -> tuple[Any, DeriveError | Bug | str | None]:
    """Do the work of a job within its time limit, and return its value or its error.

    If a limit of memory or nesting is reached, the error is the code of this limit.
    """
    try:
        with limited(job.limit, trace):
            return job.work(), None
    except DeriveError as stopped:
        return None, stopped
    except OutOfTime as late:
        return None, too_long(job, _trail(late), late)
    except (MemoryError, RecursionError) as short:
        return None, _limit_reached(trace, short)
    except OSError as refused:
        return None, of_system(refused) or _bug(refused)
    except BaseException as bug:  # also SystemExit, which a script may raise
        return None, _bug(bug)


def _bug(error: BaseException) -> Bug:
    return Bug(f"{type(error).__name__}: {error}", _short_trace(error))


def confine(lifeline: int, trace: int, limit: int) -> None:
    """Make this process a worker: it ends with its parent, has a memory limit, and writes a trace if it crashes."""
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
    # On Linux, the system kills the process when the parent ends.
    with contextlib.suppress(OSError, AttributeError):
        own = os.open(f"/proc/self/fd/{lifeline}", os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        fcntl.fcntl(own, fcntl.F_SETSIG, signal.SIGKILL)
        fcntl.fcntl(own, fcntl.F_SETOWN, -os.getpgrp())
        fcntl.fcntl(own, fcntl.F_SETFL, fcntl.fcntl(own, fcntl.F_GETFL) | os.O_ASYNC)
    threading.Thread(target=_end_with_parent, args=(lifeline,), daemon=True).start()
    faulthandler.enable(trace, all_threads=False)
    _limit_memory(limit)


def _limit_memory(limit: int) -> None:
    """Limit the memory of this process and of each program that it starts, if the system supports this."""
    with contextlib.suppress(OSError, ValueError):
        soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
        known = [each for each in (limit, soft, hard) if each != resource.RLIM_INFINITY]
        resource.setrlimit(resource.RLIMIT_DATA, (min(known), hard))


def _limit_reached(trace: int, error: MemoryError | RecursionError) -> str:
    """Write the traceback of the error, and return the error code of the limit that was exceeded."""
    with contextlib.suppress(OSError):
        os.write(trace, _trail(error).encode()[: select.PIPE_BUF * 8])
    return MEMORY if isinstance(error, MemoryError) else TOO_DEEP


def _trail(error: BaseException) -> str:
    trail, lines = error.__traceback__, []
    while trail:
        lines.append(f'  File "{trail.tb_frame.f_code.co_filename}", line {trail.tb_lineno} in x\n')
        trail = trail.tb_next
    return "".join([*lines[-80:][::-1], *lines[:-80][:20][::-1]])


def _short_trace(error: BaseException) -> str:
    """Return the traceback of an error; the traceback of a deep recursion is shortened."""
    return "".join(traceback.format_exception(type(error), error, error.__traceback__, limit=-60))


def _end_with_parent(lifeline: int) -> None:
    os.read(lifeline, 1)  # returns when the last writer, the parent, is gone
    os.killpg(0, signal.SIGKILL)
