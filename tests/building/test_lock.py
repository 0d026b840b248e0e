"""One build of a set at a time."""

from __future__ import annotations

import os
from pathlib import Path

from derive.building.lock import locked


def test_who_comes_second_waits_and_is_told_so(tmp_path: Path) -> None:
    asked, release = os.pipe(), os.pipe()
    child = os.fork()
    if not child:
        with locked(tmp_path, lambda: None):
            os.write(asked[1], b"x")
            os.read(release[0], 1)
        os._exit(0)
    os.read(asked[0], 1)
    waited = []

    def waiting() -> None:
        waited.append(True)
        os.write(release[1], b"x")

    with locked(tmp_path, waiting):
        assert waited == [True]
    os.waitpid(child, 0)
