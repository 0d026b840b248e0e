"""The command in this process and in one of its own, with a stand-in for the derivation."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import derive
from tests.fake_course import Course

PACKAGE = Path(derive.__file__).resolve().parent.parent

# The stand-in for the derivation, then the real command, in a process of its own.
STAND_IN = (
    "import sys; from derive.cli.options import main; from tests.fake_course import Lasting, replace_derivation; "
    "replace_derivation(Lasting()); sys.exit(main())"
)


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-P", "-c", STAND_IN, *arguments]


def alone(course: Course) -> dict[str, str]:
    return alone_in(course.root)


def alone_in(root: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(PACKAGE), "DERIVE_ROOT": str(root)}
