"""The stand-in course of the tests of commands."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    monkeypatch.delenv("DERIVE_ROOT", raising=False)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    return stand_in_course(tmp_path, monkeypatch)
