"""The time limit of a worker. It counts processor time, so that a problem does not fail because the machine is busy.

At the limit, `OutOfTime` is raised inside the work. It is also raised if the work hardly uses the processor during a
whole interval of wall-clock time. These intervals are as long as the limit, but at least one second.
"""

from __future__ import annotations

import faulthandler
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

from derive.errors import OutOfTime

__all__ = ["wall_clock_limit", "ended_by_clock", "ended_by_processor_time", "limited"]

GRACE = 2.0  # seconds of processor time in which `OutOfTime` can propagate out of the work
IDLE = 0.02  # work that uses a smaller share of the processor than this counts as waiting
PATIENCE = 10  # see `wall_clock_limit`
_WATCHDOG = "Timeout ("  # `faulthandler` begins its output with this text


@contextmanager
def limited(seconds: float, trace: int) -> Iterator[None]:
    """Limit the time of the work in the `with` block. If the work does not stop at the limit, its traceback is written
    to the file descriptor `trace`."""
    used, told = time.process_time(), False

    def stop(*_: object, waited: bool = False) -> NoReturn:
        nonlocal told
        if told:  # the work caught `OutOfTime` and continued
            signal.raise_signal(signal.SIGVTALRM)
        told = True
        raise OutOfTime(waited)

    def look(*_: object) -> None:
        nonlocal used
        used, before = time.process_time(), used
        if used - before < IDLE * seconds:
            stop(waited=True)

    handlers = {signal.SIGPROF: stop, signal.SIGALRM: look}
    previous = {signum: signal.signal(signum, handler) for signum, handler in handlers.items()}
    faulthandler.register(signal.SIGVTALRM, trace, all_threads=False, chain=True)  # the signal then ends this process
    faulthandler.dump_traceback_later(wall_clock_limit(seconds), exit=True, file=trace)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    signal.setitimer(signal.ITIMER_REAL, max(seconds, 1), max(seconds, 1))
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds + GRACE)
    try:
        yield
    finally:
        for timer in (signal.ITIMER_PROF, signal.ITIMER_REAL, signal.ITIMER_VIRTUAL):
            signal.setitimer(timer, 0)
        faulthandler.cancel_dump_traceback_later()
        for signum, handler in previous.items():
            signal.signal(signum, handler)


def wall_clock_limit(seconds: float) -> float:
    """Return the wall-clock time after which work with this limit is stopped, however much of the processor it used."""
    return PATIENCE * (seconds + 6)


def ended_by_processor_time(code: int) -> bool:
    """Return whether a process with this exit code or signal was ended because it reached its limit of processor
    time."""
    return code == -signal.SIGVTALRM


def ended_by_clock(trace: str) -> bool:
    """Return whether a process that wrote this trace was ended because it reached its limit of wall-clock time."""
    return trace.startswith(_WATCHDOG)
