"""The table of verbs in the documentation is made from the table by which they are checked."""

from __future__ import annotations

import runpy

import derive.stock.keys.results  # noqa: F401
from derive.mechanics.in_results import RESULT_VERBS as VERBS
from tests.courses import ROOT

MADE = runpy.run_path(str(ROOT / "tools" / "result_verbs.py"))


def test_the_table_in_the_documentation_is_up_to_date() -> None:
    text = MADE["DOCUMENT"].read_text(encoding="utf-8")
    assert MADE["updated"](text) == text, "run `python -P -m tools.result_verbs`"


def test_every_verb_has_its_line_with_its_keys() -> None:
    lines = {line.split("`")[1]: line for line in MADE["table"]().splitlines()[2:]}
    assert lines.keys() == VERBS.keys()
    assert all(f"`{key}`" in lines[name] for name, verb in VERBS.items() for key in verb.keys)
