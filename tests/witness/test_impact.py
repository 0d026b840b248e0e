"""Impacts by the balance of momenta alone."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from sympy import Integer, Rational, symbols

from derive.algebra.expressions import rate
from derive.mechanics.model.description import Struck
from derive.witness import impact
from derive.witness.description import Body, Description, Force, Impact, Meeting, Particle
from derive.witness.impact import _blueprint, after
from derive.witness.trial import Trial
from tests.mechanics.test_material_points import HIT
from tests.stock.described import solved
from tests.witness.systems import l, m, phi, x, y

M, v, K, e = symbols("M v K e", positive=True)
ZERO = Integer(0)


def result(of: Impact) -> tuple[Trial, dict[object, float]]:
    trial = Trial(_blueprint(of), 0)
    found = after(of, trial)
    assert found is not None
    return trial, {**found.rates, **found.impulses}


def test_a_ball_bounces_off_a_slope_whatever_the_length_of_the_normal() -> None:
    """It falls with v on a slope of normal (3, 4): K = 2 m v 4/5."""
    of = Description(((x, "length"), (y, "length")), (Particle(m, (x, y)),))
    ball = Force((ZERO, ZERO), (x, y))
    for size in (1, 7):
        meeting = Meeting(None, ball, (Integer(3 * size), Integer(4 * size)), Integer(1), (K,))
        hit = Impact(of, (), (meeting,), ((x, ZERO), (y, ZERO)), ((rate(y), -v),))
        trial, found = result(hit)
        assert found[K] == pytest.approx(8 / 5 * trial.numbers[m] * trial.numbers[v], rel=1e-10)


def test_an_impact_at_the_end_of_a_rod_turns_it() -> None:
    """x_dot = K/M and phi_dot = -6 K/(M l) for a rod that stands upright, struck at its upper end."""
    third = (ZERO, M * l**2 / 12, ZERO)
    rod = Body(M, (x, y), (ZERO, ZERO), ((ZERO,) * 3, third, (ZERO,) * 3), ((2, phi),), (0, 1))
    of = Description(((x, "length"), (y, "length"), (phi, "angle")), (), (rod,))
    at = tuple((q, ZERO) for q in (x, y, phi))
    trial, found = result(Impact(of, (Force((K, ZERO), (x, y + l / 2), body=0),), (), at, ()))
    mass, length, impulse = (trial.numbers[s] for s in (M, l, K))
    assert found[rate(x)] == pytest.approx(impulse / mass, rel=1e-10)
    assert found[rate(phi)] == pytest.approx(-6 * impulse / (mass * length), rel=1e-9)


def test_two_that_stay_together_have_one_velocity() -> None:
    of = Description(((x, "length"), (y, "length")), (Particle(m, (x, ZERO)), Particle(M, (y, ZERO))))
    one, other = Force((ZERO, ZERO), (x, ZERO)), Force((ZERO, ZERO), (y, ZERO))
    letters = symbols("K_x K_y", real=True)
    hit = Impact(of, (), (Meeting(one, other, (), ZERO, letters),), ((x, ZERO), (y, ZERO)), ((rate(x), v),))
    trial, found = result(hit)
    share = trial.numbers[m] / (trial.numbers[m] + trial.numbers[M])
    assert found[rate(x)] == pytest.approx(found[rate(y)]) == pytest.approx(share * trial.numbers[v])
    assert Rational(1) and letters[0] in found


def test_a_wrong_rate_after_an_impact_is_refused_and_the_right_one_is_witnessed(tmp_path: Path) -> None:
    steps = solved(tmp_path, HIT)
    rate_after = steps["phi_dot_after"]
    assert [e.detail for e in rate_after.step.evidence if e.compared == "witness"] == ["2 impacts"]
    (struck,) = {fact for each in rate_after.ancestors() for fact in each.facts if isinstance(fact, Struck)}
    assert impact.testimony(struck.impact, rate_after)
    wrong = impact.testimony(struck.impact, replace(rate_after, value=rate_after.value / 2))
    assert wrong is not None and wrong.detail.startswith("the momentum balance gives")
