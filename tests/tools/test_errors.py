"""The page of complaints is made from the code and the golden complaints, and misses none."""

from __future__ import annotations

import ast
import re
import runpy
from itertools import pairwise

from tests.courses import ROOT
from tools.trees import nodes_of

MADE = runpy.run_path(str(ROOT / "tools" / "errors.py"))
MODULES = sorted((ROOT / "derive").rglob("*.py"))
OF_A_SCRIPT = {"routes"}  # raised by a script of the tests itself


def test_the_page_of_complaints_is_up_to_date() -> None:
    text = MADE["DOCUMENT"].read_text(encoding="utf-8")
    assert MADE["document"]() == text, "run `python -P -m tools.errors`"
    said = MADE["messages"]()  # each as it is put together in the code
    assert said["no-erratum"] == ["the document is right about `…`, so this is not an erratum"]
    assert "unknown unit `…`…" in said["unknown-unit"]
    assert "… took more than … GiB of memory" in said["memory-limit"]
    examples = MADE["examples"]()  # the golden complaints
    assert examples.keys() - OF_A_SCRIPT <= said.keys()
    assert len(examples) >= 50
    assert all("error[" in each for each in examples.values())


def test_every_code_has_a_cause_and_a_mend_and_none_is_spare() -> None:
    assert MADE["told"]().keys() == MADE["messages"]().keys()
    for code, (cause, fix) in MADE["told"]().items():
        assert cause.endswith(".") and fix.endswith("."), code
        assert cause != fix, code


def test_a_code_beside_its_message_is_told_of_whatever_function_takes_it() -> None:
    calls = [(path, node) for path in MODULES for node in nodes_of(path) if isinstance(node, ast.Call)]
    for path, call in calls:
        for code, message in pairwise(call.args):
            if isinstance(code, ast.Constant) and re.fullmatch(r"[a-z]+(-[a-z]+)+", str(code.value)):
                if isinstance(message, ast.JoinedStr | ast.Constant) and " " in ast.unparse(message):
                    assert code.value in MADE["messages"](), path
