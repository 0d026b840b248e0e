"""A course in a temporary folder: the repository's own problems, edited as an instructor would edit them."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from derive.building.cache import Cache
from derive.building.derivations import Solved, steps_key
from derive.building.solution import rendered
from derive.course.problem import Problem, load_problem
from derive.render.rendered import Rendered

ROOT = Path(__file__).resolve().parent.parent

# Copies of the problems for the tests, separate from problems/hw9, so that an instructor's edit breaks no test.
PINNED = ROOT / "tests" / "problems"


def course_in(
    folder: Path,
    edits: Mapping[str, str] | None = None,
    script: Mapping[str, str] | None = None,
    problem: str = "block",
) -> Path:
    """Return a course with one pinned problem. Each edit replaces a piece of its text that occurs once."""
    problems = folder / "problems" / "hw9"
    problems.mkdir(parents=True)
    heading = (PINNED / "set.yaml").read_text(encoding="utf-8")
    (problems / "set.yaml").write_text(heading.replace("- block", f"- {problem}"), encoding="utf-8")
    for name, changes in ((f"{problem}.yaml", edits), (f"{problem}.py", script)):
        if not changes and not (PINNED / name).exists():  # a problem without a script of its own
            continue
        text = (PINNED / name).read_text(encoding="utf-8")
        for old, new in (changes or {}).items():
            assert text.count(old) == 1, f"{old!r} occurs {text.count(old)} times in {name}"
            text = text.replace(old, new)
        (problems / name).write_text(text, encoding="utf-8")
    return folder


def kept() -> Cache:
    return Cache(Path(os.environ["XDG_STATE_HOME"]) / "derivations")


def rendered_once(
    root: Path,
    problem_id: str,
    detail: str | None = None,
    draws: bool = False,
    only: Collection[str] | None = None,
) -> Rendered:
    return rendered(root, problem_id, detail, kept(), draws, only)


def solved_once(root: Path, problem_id: str) -> tuple[Problem, Solved]:
    """Return the problem and its steps, before they become a page."""
    rendered_once(root, problem_id, only=())
    problem = load_problem(root, problem_id)
    solved = Solved.from_data(kept().get_data(steps_key(problem)))
    assert solved is not None
    return problem, solved


def library_drawings(name: str) -> dict[str, Any]:
    """Return the drawings of a problem of the library by their keys; the problem is derived once for all tests."""
    return {each.key: each for each in solved_once(ROOT, f"library/{name}")[1].drawings if hasattr(each, "marks")}
