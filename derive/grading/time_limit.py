"""A limit of processor time for one answer; it may be inside of the time limit of a job, whose clock goes on."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn


class OutOfTime(BaseException):
    """Raised at the limit; no handler of errors of calculations catches it."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    def stop(*_: object) -> NoReturn:
        raise OutOfTime

    before = signal.signal(signal.SIGPROF, stop)
    left, _ = signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        unused, _ = signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before if before is not None else signal.SIG_DFL)
        if left:
            signal.setitimer(signal.ITIMER_PROF, max(left - (seconds - unused), 0.01))
