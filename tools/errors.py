"""Write docs/errors.md: every error code, with some of its messages, its cause, its fix and perhaps an example.

The messages come from the code, the examples from the stored expected outputs of the tests, and the causes and fixes
from tools/errors.yaml.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import yaml

from tools.trees import nodes_of

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT, TOLD = ROOT / "docs" / "errors.md", ROOT / "tools" / "errors.yaml"
EXAMPLES = ROOT / "tests" / "complaints"
MOST = 5  # the greatest number of messages shown for one code

_CODE = re.compile(r"[a-z]+(-[a-z]+)*")
_SAID = re.compile(r"(?:error|warning)\[([a-z-]+)\]: ")
_RAISING = {"Complaint", "Misfit", "complaint", "error", "rejected", "refuse", "refused", "_fault", "_stopped"}

_BEGINNING = """\
# Errors and how to fix them

`tools/errors.py` writes this page from the code, the tests and `tools/errors.yaml`; do not edit the page.

A message about a file states the file, the line and the column, a code such as `wrong-kind`, and what is wrong. It
shows the line, and a fix if there is one. Errors that are found together are reported together; earlier outputs stay
unchanged. In the messages below, `…` replaces names and numbers of your problem.
"""


@cache
def messages() -> dict[str, list[str]]:
    """Return the codes of errors and warnings in the modules of derive, each with its messages in the order of the
    modules."""
    found: dict[str, list[str]] = {}
    for file in sorted((ROOT / "derive").rglob("*.py")):
        for code, message in _raised_in(file) if _may_raise(file) else ():
            told = found.setdefault(code, [])
            if message and message not in told:
                told.append(message)
    return dict(sorted(found.items()))


def _may_raise(file: Path) -> bool:
    source = file.read_text(encoding="utf-8")
    return any(name in source for name in _RAISING)


def _raised_in(file: Path) -> Iterator[tuple[str, str]]:
    nodes = nodes_of(file)
    functions = [node for node in nodes if isinstance(node, ast.FunctionDef)]
    assignments = sorted((node for node in nodes if isinstance(node, ast.Assign)), key=lambda each: each.lineno)
    names = _named_texts(assignments)
    for call in (node for node in nodes if isinstance(node, ast.Call)):
        at = _code_at(call)
        if at is not None:
            message = call.args[at + 1] if len(call.args) > at + 1 else ast.Constant("")
            around = [f.lineno for f in functions if f.lineno <= call.lineno <= (f.end_lineno or 0)]
            start = max(around, default=call.lineno)
            within = {**names, **_named_texts([each for each in assignments if start <= each.lineno < call.lineno])}
            for code in (text for text in _texts(call.args[at], within) if _CODE.fullmatch(text)):
                yield from ((code, text) for text in _texts(message, within) if text.strip("… "))
                yield code, ""


def _code_at(call: ast.Call) -> int | None:
    """Return the position of the code among the arguments of a call, or None if the call reports no error."""
    function = getattr(call.func, "attr", getattr(call.func, "id", ""))
    if function not in _RAISING:
        return None
    return 1 if function.endswith("_stopped") and len(call.args) > 1 else 0 if call.args else None


def _named_texts(assignments: Iterable[ast.Assign]) -> dict[str, list[ast.expr]]:
    """Return the expression that is assigned last to each name."""
    return {
        name.id: [value]
        for node in assignments
        for target in node.targets
        for name, value in _pairs(target, node.value)
        if isinstance(name, ast.Name)
    }


def _pairs(target: ast.expr, value: ast.expr) -> list[tuple[ast.expr, ast.expr]]:
    """Return the targets of an assignment with their values; a tuple of targets gives several pairs."""
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and len(target.elts) == len(value.elts):
        return list(zip(target.elts, value.elts, strict=True))
    return [(target, value)]


def _texts(node: ast.expr, names: dict[str, list[ast.expr]], depth: int = 3) -> list[str]:
    """Return the possible texts of an expression, with `…` in place of each inserted value."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.JoinedStr):
        parts = [str(p.value) if isinstance(p, ast.Constant) else "…" for p in node.values]
        return [re.sub(r"…[ …]*…", "…", "".join(parts))]
    if isinstance(node, ast.IfExp):
        return [*_texts(node.body, names, depth), *_texts(node.orelse, names, depth)]
    if isinstance(node, ast.BinOp):
        return [left + right for left in _texts(node.left, names, depth) or ["…"]
                for right in _texts(node.right, names, depth) or ["…"]]  # fmt: skip
    if isinstance(node, ast.Name) and depth:
        return [text for value in names.get(node.id, []) for text in _texts(value, names, depth - 1)]
    return []


@cache
def examples() -> dict[str, str]:
    """Return, for each code, the shortest example in the stored expected outputs of the tests."""
    found: dict[str, list[str]] = {}
    for file in sorted(EXAMPLES.rglob("*.txt")):
        for said in _each_complaint(file.read_text(encoding="utf-8")):
            code = _SAID.search(said)
            if code:
                found.setdefault(code[1], []).append(said)
    return {code: min(said, key=len) for code, said in found.items()}


def _each_complaint(text: str) -> Iterator[str]:
    lines: list[str] = []
    for line in text.splitlines():
        if _SAID.search(line) and not line.startswith(" ") and lines:
            yield "\n".join(lines)
            lines = []
        lines.append(line)
    yield "\n".join(lines)


@cache
def told() -> dict[str, tuple[str, str]]:
    """Return the cause and the fix of each code."""
    read = yaml.safe_load(TOLD.read_text(encoding="utf-8"))
    return {code: (entry["cause"], entry["fix"]) for code, entry in read.items()}


def document() -> str:
    """Return the whole page."""
    return "\n".join([_BEGINNING, *(_entry(code, said) for code, said in messages().items())])


def _entry(code: str, said: list[str]) -> str:
    cause, fix = told()[code]
    lines = [f"## {code}", "", *(f"- {_in_words(message)}" for message in said[:MOST])]
    if said[MOST:]:
        lines.append(f"- and {len(said) - MOST} more like these")
    lines += [*([""] if said else []), f"**Cause.** {cause}", "", f"**Fix.** {fix}", ""]
    if code in examples():
        lines += ["```", examples()[code], "```", ""]
    return "\n".join(lines)


def _in_words(message: str) -> str:
    return re.sub(r"(?<!`)<<", "\\\\<<", " ".join(message.split()))


def main() -> None:
    DOCUMENT.write_text(document(), encoding="utf-8")


if __name__ == "__main__":
    main()
