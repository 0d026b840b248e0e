"""The page of complaints is made from the code and the golden complaints, and misses none."""

from __future__ import annotations

import ast
import re
import runpy
from pathlib import Path

import pytest

from tests.courses import ROOT

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


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_code_beside_its_message_is_told_of_whatever_function_takes_it(path: Path) -> None:
    for call in (n for n in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(n, ast.Call)):
        for code, message in zip(call.args, call.args[1:], strict=False):
            if isinstance(code, ast.Constant) and re.fullmatch(r"[a-z]+(-[a-z]+)+", str(code.value)):
                if " " in ast.unparse(message) and isinstance(message, ast.JoinedStr | ast.Constant):
                    assert code.value in MADE["messages"]()
