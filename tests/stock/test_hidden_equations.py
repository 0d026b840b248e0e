"""Equations that the author hides, although the sentence of another step refers to them by number."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import Rejected
from tests.stock.described import PENDULUM, course_with, edited

SWINGS = edited(PENDULUM, ("answer: equations_of_motion", "answer: frequency"))


def page(folder: Path, text: str) -> str:
    return rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"]


def test_an_equation_to_which_a_sentence_refers_cannot_be_hidden(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        page(tmp_path, f"{SWINGS}show: {{linearised_theta: hidden}}\n")
    (complaint,) = caught.value.complaints
    assert complaint.code == "not-shown" and "refers to the equation of `linearised_theta`" in complaint.message
    assert complaint.place is not None and complaint.place.line == SWINGS.count("\n") + 1


def test_its_result_alone_may_be_shown(tmp_path: Path) -> None:
    text = page(tmp_path, f"{SWINGS}show: {{linearised_theta: result}}\n")
    assert "θ̈ + ω_0² θ = 0" in text


CRATE = """\
title: A crate on a truck
solve: system
symbols: {m: mass, g: acceleration, A: positive acceleration, mu_s: coefficient of friction}
given:
  coordinates: {x: length, y: length}
  particles: {crate: {mass: m, at: [x, y]}}
  surfaces: {bed: {through: [A*t**2/2, 0], along: [1, 0]}}
  contacts: {of: crate, on: bed, normal: N, friction: {static: mu_s, force: F}}
  gravity: g
statement: A crate lies on a truck that accelerates.
parts:
  - {ask: Find the friction., answer: F}
"""


def test_an_acceleration_that_a_constraint_states_is_not_repeated(tmp_path: Path) -> None:
    """Where static friction keeps the velocity, x_ddot = A is an equation of the page."""
    assert page(tmp_path, CRATE).count("x\u0308 = A ") == 1
