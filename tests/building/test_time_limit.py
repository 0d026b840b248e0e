"""The limit of a worker's time: it counts what the processor does, and no work gets past it."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from derive.building import time_limit
from derive.building.cache import Cache
from derive.building.solution import rendered
from derive.building.workers import Job, done, job_of
from derive.errors import BuildFailed, Complaint, DeriveError, OutOfTime, during
from derive.steps.memory import Memory
from tests.courses import course_in
from tests.stock.described import PENDULUM, course_with


def stopped(work: Callable[[], object], limit: float = 0.4) -> tuple[Complaint, float]:
    started = time.monotonic()
    with pytest.raises(BuildFailed) as caught:
        done(Job("`x`", work, limit))
    (complaint,) = caught.value.complaints
    assert complaint.code == "time-limit"
    return complaint, time.monotonic() - started


def endless() -> None:
    while True:
        pass


def catches_all() -> None:
    while True:
        with suppress(BaseException):
            for _ in range(10**9):
                pass


def one_long_instruction() -> None:
    with suppress(OutOfTime):
        sum(range(10**10))
    sum(range(10**12))


@pytest.mark.parametrize("work", [endless, catches_all, one_long_instruction])
def test_no_work_gets_past_its_limit(work: Callable[[], object], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time_limit, "GRACE", 0.3)
    assert stopped(work)[0].message == "`x` took over 0.4 s of processor time"


def test_work_that_only_waits_is_said_to_wait() -> None:
    assert stopped(lambda: time.sleep(60))[0].message == "`x` waited for over 0.4 s"


@pytest.mark.long
def test_work_that_waits_and_catches_all_is_ended_too() -> None:
    def waits() -> None:
        while True:
            with suppress(BaseException):
                time.sleep(60)

    assert stopped(waits)[1] < 10


def test_work_that_is_stopped_by_the_clock_is_not_said_to_use_the_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    """The work uses a little of the processor, so that it does not count as waiting."""

    def slow() -> None:
        while True:
            time.sleep(0.05)
            sum(range(100_000))

    monkeypatch.setattr(time_limit, "PATIENCE", 0.05)
    assert stopped(slow, 2)[0].message == "`x` took over 0.4 s by the clock"


def test_a_busy_machine_costs_no_work_its_time() -> None:
    """A little work of the processor may take longer by the clock than its limit is."""

    def little_work() -> float:
        began, clock = time.process_time(), time.monotonic()
        while time.process_time() - began < 0.15:
            time.sleep(0.01)  # as a processor that has other work lets it wait
            sum(range(200_000))
        return time.monotonic() - clock

    assert done(Job("`x`", little_work, 0.3)) > 0.3


def test_the_words_for_long_work_are_told_from_the_inside_out_and_only_at_the_limit() -> None:
    def work() -> None:
        with during(lambda: "the whole"):
            with during(lambda: "an earlier part"):
                pass
            with during(lambda: "the determinant of 8 rows"):
                endless()

    def refused() -> None:
        with during(lambda: str(1 / 0)):
            raise ValueError("of the work")

    assert stopped(work)[0].notes == ("it was at the determinant of 8 rows, in the whole",)
    with pytest.raises(ValueError, match="of the work"):
        refused()


def test_the_part_the_step_and_what_is_finished_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root, cache = course_with(tmp_path, PENDULUM), Cache(tmp_path / "kept")
    job = job_of(root, "trial/one", lambda: rendered(root, "trial/one", cache=cache), 1)
    with monkeypatch.context() as patched:
        patched.setattr("derive.mechanics.lagrange.lagrangian.by_accelerations", lambda *_: endless())
        with pytest.raises(BuildFailed) as caught:
            done(job)
    (complaint,) = caught.value.complaints
    assert complaint.message == "`trial/one` took over 1 s of processor time, most recently for `equations_of_motion`"
    at, finished = complaint.notes
    assert at == "it was at `equation_of_motion` of `lagrangian`, `theta`, in part (a)"
    assert finished.startswith("finished, and kept for the next attempt: `") and finished.endswith("`lagrangian`")
    recalled: list[str] = []
    monkeypatch.setattr(Memory, "_put_on_record", lambda self, left, run: recalled.append(str(left[-2])))
    with suppress(DeriveError, AttributeError):
        rendered(root, "trial/one", cache=cache)
    assert recalled


@pytest.mark.parametrize("handler", ["SIGPROF", "SIGALRM"])
def test_behind_the_work_no_timer_is_left(tmp_path: Path, handler: str) -> None:
    code = (
        "import signal, sys, time\n"
        "from derive.building.time_limit import limited\n"
        "with limited(0.2, 2): pass\n"
        f"assert signal.getsignal(signal.{handler}) == signal.SIG_DFL\n"
        "end = time.process_time() + 0.5\n"
        "while time.process_time() < end: pass\n"
        "print('whole')\n"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, cwd=course_in(tmp_path))
    assert (run.stdout, run.stderr) == ("whole\n", "")
