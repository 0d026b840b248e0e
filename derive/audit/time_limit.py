"""A limit of processor time for one claim or answer, and the errors of SymPy that leave a claim undecided."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from time import process_time
from typing import NoReturn

import sympy

# SymPy raises these errors for expressions that it cannot handle. A claim is then undecided, and an answer is not read.
FAULTS = (
    ValueError,
    TypeError,
    ArithmeticError,
    LookupError,
    AttributeError,
    NotImplementedError,
    sympy.polys.polyerrors.BasePolynomialError,
)
AGAIN = 0.5  # seconds of processor time after which the limit is enforced again


class LimitReached(BaseException):
    """The limit is reached. This class is not an `Exception`, so that handlers in SymPy do not catch it."""


@contextmanager
def time_limited(seconds: float) -> Iterator[None]:
    """Limit the time of the work in the `with` block."""

    def stop(*_: object) -> NoReturn:
        signal.setitimer(signal.ITIMER_PROF, AGAIN)  # the exception is lost if it is raised while a cache is cleared
        raise LimitReached

    begun = process_time()
    before = signal.signal(signal.SIGPROF, stop)
    left, _ = signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before if before is not None else signal.SIG_DFL)
        if left:
            signal.setitimer(signal.ITIMER_PROF, max(left - (process_time() - begun), 0.01))
