"""The stand-in course of the tests of commands, and commands that do nothing."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

import pytest

from derive.cli import running
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    monkeypatch.delenv("DERIVE_ROOT", raising=False)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    return stand_in_course(tmp_path, monkeypatch)


@pytest.fixture
def handed(monkeypatch: pytest.MonkeyPatch) -> list[Namespace]:
    found: list[Namespace] = []

    def take(arguments: Namespace) -> int:
        found.append(arguments)
        return 7

    monkeypatch.setattr(running, "exit_code", take)
    return found
