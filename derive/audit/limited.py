"""The limit of processor time for one claim, and the errors of SymPy that leave a claim undecided."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager

import sympy

# SymPy raises these for expressions of a document that it cannot handle; the claim is then undecided, with the reason.
FAULTS = (ValueError, TypeError, ZeroDivisionError, AttributeError, NotImplementedError, sympy.SympifyError)


AGAIN = 0.5  # seconds after which the limit is enforced again


class OutOfTime(BaseException):
    """The limit is reached; not an `Exception`, so that no handler in SymPy catches it."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    def stop(*_: object) -> None:
        signal.setitimer(signal.ITIMER_VIRTUAL, AGAIN)  # the exception is lost if it is raised while a cache is cleared
        raise OutOfTime

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
