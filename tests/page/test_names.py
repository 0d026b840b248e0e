"""Tests of the names that prose may mention: inputs, axes, and steps by their keys."""

from __future__ import annotations

from pathlib import Path

from derive.page.names import page_names
from derive.page.template import templates_of
from derive.page.wording import Math, phrases
from tests.courses import ROOT, course_in, solved_once


def test_what_is_given_the_axes_and_the_steps_have_names(tmp_path: Path) -> None:
    problem, solved = solved_once(course_in(tmp_path), "hw9/block")
    names = page_names(problem, solved.derivation, phrases(templates_of(ROOT)))
    assert {"x", "y", "z", "t", "torque", "inertia_tensor"} <= names.keys()
    assert {given.name for given in problem.givens} <= names.keys()
    step = solved.derivation.step("torque")
    assert names["torque"] == Math(step.symbol)
