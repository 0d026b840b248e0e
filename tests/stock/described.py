"""A problem that is told by its `given:` alone, in a folder of its own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from derive.building.calls import Calls
from derive.course.problem import Problem, load_problem, run_solve
from derive.errors import DeriveError
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.memory import Memory
from derive.steps.record import Run
from derive.steps.step import Quantity

PENDULUM = """\
title: A pendulum
solve: system
symbols: {l: length, m: mass, g: acceleration, k: spring constant, omega: angular speed}
given:
  coordinates: {theta: angle}
  places: {A: [l*sin(theta), -l*cos(theta)]}
  particles: {bob: {mass: m, at: A}}
  gravity: g
statement: A bob.
parts:
  - ask: Find what is asked.
    answer: equations_of_motion
"""


CART_WITH_DRAG = """\
title: A cart with drag
solve: system
symbols: {m: mass, k: spring constant, b: damping constant, a: length, x_0: length}
given:
  coordinates: {x: length}
  places: {wall: [0, 0], cart: [a + x, 0]}
  particles: {cart: {mass: m, at: cart}}
  springs: {constant: k, length: a, from: wall, to: cart}
  damping: {constant: b, at: cart}
  results:
    weak: {solution: motion_x, for: x, start: x_0, case: underdamped}
    strong: {solution: motion_x, for: x, start: x_0, case: overdamped}
"""


def course_with(folder: Path, text: str) -> Path:
    problems = folder / "problems" / "trial"
    problems.mkdir(parents=True, exist_ok=True)
    (problems / "set.yaml").write_text("course: C\ntitle: T\nproblems: [one]\n", encoding="utf-8")
    (problems / "one.yaml").write_text(text, encoding="utf-8")
    return folder


def edited(text: str, *edits: tuple[str, str]) -> str:
    for old, new in edits:
        assert text.count(old) == 1, f"{old!r} occurs {text.count(old)} times"
        text = text.replace(old, new)
    return text


def loaded(folder: Path, text: str) -> Problem:
    return load_problem(course_with(folder, text), "trial/one")


def solved(folder: Path, text: str, calls: Calls | None = None) -> dict[str, Quantity]:
    """Every step by its key.

    calls   the calls of verbs of other problems, which are not made again; for tests that leave the engine unchanged
    """
    run = Run(memory=Memory(Calls() if calls is None else calls))
    return with_ancestors(returned_quantities(run_solve(loaded(folder, text), run)))


def complaints(folder: Path, text: str, calls: Calls | None = None) -> list[Any]:
    with pytest.raises(DeriveError) as refused:
        solved(folder, text, calls)
    return list(refused.value.complaints)


def messages(folder: Path, text: str) -> list[str]:
    return [f"{c.place.line if c.place else 0}: {c.message}" for c in complaints(folder, text)]
