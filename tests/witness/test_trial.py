"""Numbers and states that satisfy what is assumed, what keeps the system, and what is given."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import Integer, Rational, Symbol, cos, pi, sin, symbols

from derive.algebra.expressions import Relation, rate
from derive.algebra.ranges import Range, within
from derive.witness.dynamics import Blueprint
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Given, Trial, drawn
from tests.witness.systems import ON_A_STRING, PENDULUM, g, l, m, r, theta


def trial(**more: object) -> Trial:
    return Trial(Blueprint(ON_A_STRING), 0, **more)  # type: ignore[arg-type]


def test_a_letter_has_one_number_in_a_trial_and_another_in_the_next() -> None:
    assert drawn(m, 3) == drawn(m, 3) != drawn(m, 4)
    with within({l: Range(Integer(2), Integer(3))}):
        assert all(2 < drawn(l, n) < 3 for n in range(20))


def test_numbers_satisfy_what_the_page_assumes() -> None:
    assumed = [Relation(g, "<", m * l)]
    for number in range(5):
        found = Trial(Blueprint(PENDULUM), number, assumed)
        assert found.numbers[g] < found.numbers[m] * found.numbers[l]
    with pytest.raises(NotComputable):
        Trial(Blueprint(PENDULUM), 0, [Relation(m, "<", 0)])


def test_a_state_keeps_the_constraint_and_its_rate() -> None:
    found = trial()
    state = found.state()
    assert state.q[0] == pytest.approx(found.numbers[l], abs=1e-9)
    assert state.v[0] == pytest.approx(0, abs=1e-9)


def test_a_state_has_what_is_given() -> None:
    state = trial().state([Given(cos(theta), Rational(1, 3)), Given(rate(theta) ** 2, Integer(4))])
    assert np.cos(state.q[1]) == pytest.approx(1 / 3, abs=1e-9)
    assert state.v[1] ** 2 == pytest.approx(4, abs=1e-8)


def test_what_contradicts_the_constraint_is_not_found() -> None:
    with pytest.raises(Contradiction) as of_places:
        trial().state([Given(r, 2 * l)])
    assert not of_places.value.of_rates
    with pytest.raises(Contradiction) as of_rates:
        trial().state([Given(rate(r), Integer(1))])
    assert of_rates.value.of_rates


def test_a_formula_has_its_value_at_a_state_and_changes_along_the_motion() -> None:
    found = Trial(Blueprint(PENDULUM), 1)
    state = found.state()
    response = found.dynamics.response(state)
    energy = m * l**2 * rate(theta) ** 2 / 2 - m * g * l * cos(theta)
    formulas = found.formulas([energy, rate(theta, 2)])
    assert formulas.rate_at(state, response)[0] == pytest.approx(0, abs=1e-12)
    assert formulas.at(state, response)[1] == response.a[0]


def test_a_momentum_may_be_given_by_its_letter() -> None:
    p = symbols("p")
    found = Trial(Blueprint(PENDULUM), 0, momenta={p: theta})
    state = found.state([Given(theta, pi / 4), Given(p, Integer(2))])
    assert found.dynamics.momenta(state)[0] == pytest.approx(2, rel=1e-9)


def test_a_formula_with_a_momentum_changes_along_the_motion() -> None:
    """For the pendulum, p^2/(2 m l^2) - m g l cos(theta) is constant, and p changes at the rate -m g l sin(theta)."""
    p = Symbol("p_theta", real=True)
    found = Trial(Blueprint(PENDULUM), 1, momenta={p: theta})
    state = found.state()
    formulas = found.formulas([p**2 / (2 * m * l**2) - m * g * l * cos(theta), p, -m * g * l * sin(theta)])
    changes, values = formulas.rate_at(state, found.dynamics.response(state)), formulas.at(state)
    assert changes[0] == pytest.approx(0, abs=1e-8)
    assert changes[1] == pytest.approx(values[2], abs=1e-8)
