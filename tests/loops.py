"""One test that loops over many small cases, because pytest takes longer to report a case than the case takes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any


def over(cases: Iterable[Any]) -> Callable[[Callable[[Any], None]], Callable[[], None]]:
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
