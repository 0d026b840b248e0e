"""The command in this process and in one of its own, with a stand-in for the derivation."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from fake_course import Course

import derive

PACKAGE = Path(derive.__file__).resolve().parent.parent

# The stand-in for the derivation, then the real command, in a process of its own.
STARTED = (
    "import pytest, pathlib, sys; sys.path.insert(0, sys.argv.pop(1)); import fake_course; "
    "from derive.cli.options import main"
)
STAND_IN = f"{STARTED}; m = pytest.MonkeyPatch(); fake_course.replace_derivation(m); sys.exit(main())"


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-P", "-c", STAND_IN, str(Path(__file__).parents[1]), *arguments]


def alone(course: Course) -> dict[str, str]:
    return alone_in(course.root)


def alone_in(root: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(PACKAGE), "DERIVE_ROOT": str(root)}
