"""Wait for what another process or thread does."""

from __future__ import annotations

import time
from collections.abc import Callable


def until(condition: Callable[[], bool]) -> None:
    for _ in range(4500):
        if condition():
            return
        time.sleep(0.02)
    raise AssertionError("it never came")
