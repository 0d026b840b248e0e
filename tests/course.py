"""A course in a temporary folder: the repository's own problems, edited as an instructor would edit them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The problems as their tests know them, apart from problems/hw9, so that an instructor's edit breaks no test.
PINNED = ROOT / "tests" / "problems"


def course_in(
    folder: Path,
    edits: Mapping[str, str] | None = None,
    script: Mapping[str, str] | None = None,
    problem: str = "block",
) -> Path:
    """A course with one pinned problem, each edit a piece of its text that occurs once."""
    problems = folder / "problems" / "hw9"
    problems.mkdir(parents=True)
    (folder / "templates").symlink_to(ROOT / "templates")
    heading = (PINNED / "set.yaml").read_text(encoding="utf-8")
    (problems / "set.yaml").write_text(heading.replace("- block", f"- {problem}"), encoding="utf-8")
    for name, changes in ((f"{problem}.yaml", edits), (f"{problem}.py", script)):
        text = (PINNED / name).read_text(encoding="utf-8")
        for old, new in (changes or {}).items():
            assert text.count(old) == 1, f"{old!r} occurs {text.count(old)} times in {name}"
            text = text.replace(old, new)
        (problems / name).write_text(text, encoding="utf-8")
    return folder
