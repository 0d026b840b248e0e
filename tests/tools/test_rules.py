"""The page of rules and the list of those with checks only are made from the records."""

from __future__ import annotations

import runpy

from tests.courses import ROOT

MADE = runpy.run_path(str(ROOT / "tools" / "rules.py"))


def test_the_pages_of_rules_are_up_to_date() -> None:
    assert MADE["document"]() == MADE["DOCUMENT"].read_text(encoding="utf-8"), "run `python -P -m tools.rules`"
    text = MADE["SOUNDNESS"].read_text(encoding="utf-8")
    assert MADE["soundness"](text) == text, "run `python -P -m tools.rules`"
