"""A worker as the server sees it: it stays warm, and one that hangs or dies is replaced."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.preview.asking import Shown, Warm
from tests.courses import PINNED, course_in

ENDLESS = "while True:\n        pass"
DYING = "import os\n\n    os._exit(1)"


@pytest.fixture
def warm(tmp_path: Path) -> Iterator[Warm]:
    asked = Warm(course_in(tmp_path), limit=30)
    yield asked
    asked.end()


def begins_with(warm: Warm, lines: str) -> None:
    """The script of the problem does this before all else."""
    good = (PINNED / "block.py").read_text()
    head = re.search(r"def solve\(.*?\):\n", good, re.DOTALL)
    assert head
    bad = f"{good[: head.end()]}    {lines}\n{good[head.end() :]}"
    (warm.root / "problems" / "hw9" / "block.py").write_text(bad if lines else good)


def asked(warm: Warm) -> Shown:
    shown = warm.page("hw9/block", None)
    assert shown is not None
    return shown


def test_one_process_answers_one_question_after_another(warm: Warm) -> None:
    assert asked(warm).main
    first = warm._process
    assert asked(warm).main and warm._process is first


def test_what_takes_too_long_is_ended_and_told_and_the_next_question_is_answered(warm: Warm) -> None:
    warm.limit = 3
    begins_with(warm, ENDLESS)
    assert "took over 3 s" in asked(warm).complaints[0]
    warm.limit = 30
    begins_with(warm, "")
    assert asked(warm).main


def test_what_is_idle_by_a_newer_edit_is_given_up(warm: Warm) -> None:
    begins_with(warm, ENDLESS)
    assert warm.page("hw9/block", None, lambda: True) is None


def test_a_worker_that_dies_is_told_of_and_replaced(warm: Warm) -> None:
    begins_with(warm, DYING)
    assert "ended its process" in asked(warm).complaints[0]
    begins_with(warm, "")
    assert asked(warm).main
