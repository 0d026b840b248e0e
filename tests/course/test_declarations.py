"""Letters as a file declares them: kinds, ranges, and what is said of neither."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import pi

from derive.course.problem import run_solve
from derive.steps.record import Run
from tests.stock.described import PENDULUM, edited, loaded, messages

WITH_RANGE = ("{l: length, m: mass", "{l: length, alpha: 'angle in (0, pi/2)', m: mass")


def test_a_letter_may_lie_in_a_range(tmp_path: Path) -> None:
    problem = loaded(tmp_path, edited(PENDULUM, WITH_RANGE))
    (lies,) = problem.ranges.values()
    assert (lies.least, lies.greatest, lies.closed) == (0, pi / 2, (False, False))
    assert problem.symbols["alpha"].symbol.is_positive
    run = Run()
    run_solve(problem, run)
    assert [str(each) for each in run.assumed] == ["alpha > 0", "alpha < pi/2"]


@pytest.mark.parametrize(("written", "is_positive"), [("(-1 m/s, 1 m/s)", None), ("(0, 2 m/s)", True)])
def test_a_speed_whose_range_begins_below_zero_is_not_positive(
    written: str, is_positive: bool | None, tmp_path: Path
) -> None:
    text = edited(PENDULUM, (WITH_RANGE[0], WITH_RANGE[1].replace("angle in (0, pi/2)", f"speed in {written}")))
    assert loaded(tmp_path, text).symbols["alpha"].symbol.is_positive is is_positive


def test_a_root_of_a_square_has_the_sign_that_the_range_settles(tmp_path: Path) -> None:
    at = ("[l*sin(theta), -l*cos(theta)]", "[l*sqrt(sin(alpha)**2)*theta, 0]")
    problem = loaded(tmp_path, edited(PENDULUM, WITH_RANGE, at, ("equations_of_motion", "kinetic_energy")))
    ((energy,),) = run_solve(problem).values()  # type: ignore[attr-defined]
    assert "Abs" not in str(energy.value)


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("angle in (0, 90)", "`90` needs a unit: `alpha` must be an angle"),
        ("angle in (pi, 0)", "the range of `alpha` is from pi to 0, but its first end must be less than its second"),
        ("angle in 0 to pi", "`0 to pi` is not a range for `alpha`"),
        ("length in (-1 m, 1 m)", "`alpha` is a length, which is positive, but its range begins below zero"),
        ("angel in (0, pi)", "the kind of `alpha` must be a known kind, but it is `angel in (0, pi)`"),
    ],
)
def test_what_is_no_range_is_told(written: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(PENDULUM, (WITH_RANGE[0], WITH_RANGE[1].replace("angle in (0, pi/2)", written))))
    assert [message.partition(": ")[2] for message in found] == [said]
