"""Which extrema of a plot are marked, and a plot against the time."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, symbols

from derive.building.solution import rendered
from derive.errors import DeriveError
from derive.figures.extrema import extrema
from tests.courses import ROOT
from tests.stock.described import complaints, course_with, edited

x = symbols("x", real=True)
BEATS = (ROOT / "problems" / "library" / "oscillations" / "beats.yaml").read_text(encoding="utf-8")


def page(folder: Path, text: str) -> str:
    return " ".join(rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"].split())


@pytest.mark.parametrize(("end", "said"), [("2 s", "has a minimum of"), ("60 s", "has 66 extrema within the range")])
def test_an_oscillation_against_the_time_is_drawn_without_a_mark_at_each_extremum(
    tmp_path: Path, end: str, said: str
) -> None:
    text = page(tmp_path, edited(BEATS, ("range: [0 s, 60 s]", f"range: [0 s, {end}]")))
    assert "A plot of x_1 and x_2 against t from 0 s" in text and said in text, text


def test_the_end_of_a_range_has_a_unit_of_its_kind(tmp_path: Path) -> None:
    wrong = complaints(tmp_path, edited(BEATS, ("range: [0 s, 60 s]", "range: [0 s, 60 m]")))
    assert any("must be a time" in each.message for each in wrong)


def test_a_value_at_an_extremum_that_is_zero_up_to_rounding_is_zero() -> None:
    found = extrema((3 * cos(x) - 1) ** 2 / 4, x, 0.3, 2)
    assert [(each.kind, each.value) for each in found] == [("minimum", 0.0)]


DRIVEN = """\
title: A driven cart
solve: system
symbols: {m: mass, k: spring constant, F_0: force, omega: angular speed}
given:
  coordinates: {x: length}
  particles: {cart: {mass: m, at: [x, 0]}}
  potential: k*x**2/2
  forces: {components: [F_0*cos(omega*t), 0], at: cart}
  results: {motion: {solution: motion_x, for: x, start: 0}}
drawings:
  growth:
    plot: motion
    against: t
    range: [0 s, 9 s]
    cases: [{m: 1 kg, k: 4 N/m, F_0: 1 N, omega: 2 rad/s}]
statement: A cart of mass <<m>>, driven by $F_0\\cos\\omega t$.
parts:
  - ask: Find the motion.
    answer: motion
"""


def test_numbers_at_which_a_curve_has_no_value_are_reported(tmp_path: Path) -> None:
    """At resonance, the solution for other frequencies has no value."""
    with pytest.raises(DeriveError, match="do not satisfy omega != omega_0"):
        page(tmp_path, DRIVEN)
