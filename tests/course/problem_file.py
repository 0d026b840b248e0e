"""The file of a problem in a folder of its own, edited as a test needs it."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.course.problem import Problem, load_problem, run_solve
from derive.errors import Rejected

PROBLEM = """\
title: A block turning about its long diagonal
solve: block.py
points: 10

symbols: {a: length, M: mass, omega: angular speed}
given:
  sides: [a, 2*a, 3*a]
  mass: M
  axis: diagonal
  rate: omega

statement: >
  A uniform block of mass <<mass>> and sides <<sides>> turns
  at the rate <<rate>>.

parts:
  - ask: Find the inertia tensor about the centre.
    answer: inertia_tensor
    points: 3
  - ask: Find the angle between <<spin>> and <<angular_momentum>>.
    answer: angle_between
    form: {unit: degree, figures: 4}
  - ask: What torque must the bearings supply?
    answer: [torque, magnitude]
    form: {magnitude: {unit: N m}}

wording:
  torque:
    zero: No torque is needed.
  spin: It turns.
show: {spin: result}
figures: 3
note: Balance your wheels.
"""
SCRIPT = '''\
"""A script for the tests."""

from derive.given import AngularSpeed, Direction, Lengths, Mass


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed):
    return sides, mass, axis, rate
'''
SET = "course: Physics 311\ntitle: Homework 9\nproblems: [block]\n"


def at(root: Path, problem: str = PROBLEM, script: str = SCRIPT, heading: str = SET) -> Path:
    folder = root / "problems" / "hw9"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "block.yaml").write_text(problem, encoding="utf-8")
    (folder / "block.py").write_text(script, encoding="utf-8")
    (folder / "set.yaml").write_text(heading, encoding="utf-8")
    return root


def edited(*edits: tuple[str, str]) -> str:
    text = PROBLEM
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def loaded(root: Path, *edits: tuple[str, str]) -> Problem:
    return load_problem(at(root, edited(*edits)), "hw9/block")


def faults(root: Path, problem: str = PROBLEM, script: str = SCRIPT) -> list[str]:
    with pytest.raises(Rejected) as caught:
        run_solve(load_problem(at(root, problem, script), "hw9/block"))
    return [f"{c.place.line if c.place else 0} {c.code}" for c in caught.value.complaints]
