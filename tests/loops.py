"""Tests of many cases: one test that loops over small cases, and a sample of long cases.

`over` makes one test of many small cases, because pytest takes longer to report a case than the case takes. `sampled`
leaves out most of the cases that take long; `DERIVE_ALL_TESTS=1 make test` tries all of them.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")


ALL = bool(os.environ.get("DERIVE_ALL_TESTS"))


def sampled(cases: Iterable[T], every: int = 3) -> list[T]:
    """Return one case of `every` cases; all cases if all tests are asked for."""
    return list(cases)[:: 1 if ALL else every]


def over(cases: Iterable[Any]) -> Callable[[Callable[[Any], None]], Callable[[], None]]:
    """Run a test for all cases, and report all cases that fail."""

    def looped(test: Callable[[Any], None]) -> Callable[[], None]:
        def run() -> None:
            failures = {}
            for case in (found := list(cases)):
                try:
                    test(case)
                except AssertionError as failure:
                    failures[str(case) if isinstance(case, (str, Path)) else case.name] = str(failure)
            assert found
            assert not failures, "\n\n".join(f"{case}:\n{why}" for case, why in failures.items())

        run.__name__, run.__doc__ = test.__name__, test.__doc__
        return run

    return looped
