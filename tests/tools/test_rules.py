"""The page of rules and the list of those with checks only are made from the records."""

from __future__ import annotations

import subprocess
import sys

from tests.courses import ROOT


def test_the_pages_of_rules_are_up_to_date() -> None:
    """In a process of its own, which has no rules that tests make up."""
    source = (
        "from tools.rules import *; assert document() == DOCUMENT.read_text(encoding='utf-8');"
        "text = SOUNDNESS.read_text(encoding='utf-8'); assert soundness(text) == text"
    )
    found = subprocess.run([sys.executable, "-c", source], cwd=ROOT, capture_output=True, text=True)
    assert found.returncode == 0, f"run `python -P -m tools.rules`\n{found.stderr}"
