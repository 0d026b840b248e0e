"""`python -P -m tests.style` lists the words that our texts avoid: each place in prose, comments and messages.

Texts are the comments, docstrings and string literals of the code, and whole files of the documentation.
"""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from tests.courses import ROOT
from tools.trees import nodes_of

# words to write -> pattern of the words that they replace
INSTEAD = {
    "is not a, is not one": r"(?<!there )\b(?:is|are|was|were|be) no (?!longer|more|matter|doubt)(?=[a-z])"
    r"|\b(?:is|are) none\b",
    "says, shows, reports, specifies, states": r"\b(?:is|are|was|be) told\b|\btells?\b|\b(?:is|are) said\b",
    "is, appears, is allowed": r"\bstands? (?:in|at|under|on|for itself|alone|beside|there|behind|before|first)\b"
    r"|\bmay stand\b|\bstanding\b",
    "inertia tensor, parallel-axis theorem": r"\btensors? of inertia\b|\btheorem of parallel axes\b",
    "potential energy, equilibrium": r"\benergy of place\b|\bstates? of rest\b",
    "the author, you": r"\bsomebody\b|\bwhoever\b|\bone knows\b",
    "again, fix, also, the same, unchanged": r"\banew\b|\bmend(?:s|ed)?\b|\bbesides\b|\balike\b|\bas it stands\b",
    "numerically, measured from, minus": r"\bin numbers\b|\bcounted from\b|\bless the\b",
    "stationary at": r"\blevel at\b",
    "except, return, is unknown": r"\bbut for\b|\bhand(?:s|ed)? on\b|\bnothing says\b",
    "depends on, does not know, other than": r"\bgoes by\b|\bknows no\b|\botherwise than\b",
    "at one instant, rotating axes": r"\bat one moment\b|\bturning axes\b",
    "documents, establish(), architecture": r"\bpapers\b|\bthe door\b|\bthe house\b",
    "error": r"\bcomplaints?\b|\bfaults?\b",
}
ANY = re.compile("|".join(f"(?:{pattern})" for pattern in INSTEAD.values()))
PROSE = ("README.md", "CONTRIBUTING.md", "NOTATION.md", "docs", "templates/phrases")


def texts_of_code(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the line and text of each comment, and of each string with a space, in a module."""
    for line, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if comment := re.search(r"(?:^|\s)# .*", text):
            yield line, comment[0]
    for node in nodes_of(path):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.lineno, node.value


def texts(path: Path) -> Iterator[tuple[int, str]]:
    if path.suffix == ".py":
        yield from texts_of_code(path)
    else:
        yield from enumerate(re.sub(r"`[^`\n]*`", "``", path.read_text(encoding="utf-8")).splitlines(), 1)


def files(*under: str) -> list[Path]:
    found = [ROOT / each for each in under]
    inside = [
        path for each in found if each.is_dir() for path in each.rglob("*") if path.suffix in {".py", ".md", ".yaml"}
    ]
    return sorted({*(each for each in found if each.is_file()), *inside})


def uses(path: Path) -> Iterator[tuple[int, str, str]]:
    """Yield the line, the words to write, and the words that were found."""
    if not ANY.search(path.read_text(encoding="utf-8")):
        return
    for line, text in texts(path):
        if not ANY.search(text):
            continue
        for instead, pattern in INSTEAD.items():
            for match in re.finditer(pattern, text):
                yield line + text[: match.start()].count("\n") * (path.suffix == ".py"), instead, match[0]


def counts(*under: str) -> Counter[str]:
    return Counter(instead for path in files(*under) for _, instead, _ in uses(path))


def main() -> None:
    for path in files(*(sys.argv[1:] or ("derive", *PROSE))):
        for line, instead, found in uses(path):
            print(f"{path.relative_to(ROOT)}:{line}: {found!r} -> {instead}")


if __name__ == "__main__":
    main()
