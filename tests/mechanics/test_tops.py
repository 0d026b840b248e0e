"""The symmetric top: what it says about itself, in letters and with numbers, at every tilt."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Integer, Rational, Symbol, cos, pi, sin, sqrt

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import PLUS_MINUS, Relation, explicit, rate, scalar
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Composite,
    Cuboid,
    Disc,
    Rod,
    let,
    moment_of_inertia,
    put_in,
    real_where,
    roots,
    stability,
    stable_where,
    symbolic_body,
)
from derive.mechanics.answers import quadratics
from derive.mechanics.lagrange import kept_momentum
from derive.mechanics.rest import stable_where as border
from derive.steps.record import Run, recorded
from derive.steps.signs import sign_known
from tests.mechanics.spinning_top import S, a, g, m, motion_of, rates_of, sleeping
from tests.mechanics.verbs import verbs_as_imported

DISC_ON_ROD = {a: Rational(1, 10), g: Rational(49, 5), S: 30 * pi}
phi_dot, theta = scalar("phi_dot"), scalar("theta")


@pytest.fixture(scope="module")
def top() -> SimpleNamespace:
    return motion_of(verbs_as_imported())


@pytest.fixture(scope="module")
def upright() -> SimpleNamespace:
    return sleeping(verbs_as_imported())


def at(top: SimpleNamespace, tilt: Any, numbers: dict[Symbol, Any] | None = None) -> SimpleNamespace:
    return rates_of(verbs_as_imported(), top, tilt, numbers)


def test_the_disc_on_the_rod_has_the_moments_of_the_book(top: SimpleNamespace) -> None:
    mass, distance, across, along = (q.value for q in top.top.values)
    assert (mass, distance) == (3 * m / 2, a / 2)
    assert (along, across) == (m * a**2 / 2, 2 * m * a**2 / 3)


def test_a_body_by_its_letters_needs_principal_axes_through_the_point() -> None:
    with recorded(Run()), pytest.raises(Rejected, match="are not principal"):
        symbolic_body(Cuboid((a, a, 2 * a), m), about="corner")
    with recorded(Run()):
        rod = symbolic_body(Rod(a, m), about="end")
    assert [q.value for q in rod.values] == [a / 2, m * a**2 / 3] and rod.mass == m and rod.moments[2] == 0


def test_the_spin_is_what_the_momentum_of_the_last_angle_keeps(top: SimpleNamespace) -> None:
    assert equal(top.kept.value, Relation(scalar("psi_dot") + phi_dot * cos(theta), "=", S))


def test_the_tilt_obeys_the_equation_of_fowles_and_cassiday(top: SimpleNamespace) -> None:
    M, l, I_x, I_z = (q.symbol for q in top.top.values)
    expected = (
        I_x * rate(theta, 2)
        + I_z * S * phi_dot * sin(theta)
        - I_x * phi_dot**2 * sin(theta) * cos(theta)
        - M * g * l * sin(theta)
    )
    assert (top.tilting.value.left - expected).expand() == 0


def test_steady_precession_is_a_quadratic_in_its_rate(top: SimpleNamespace) -> None:
    M, l, I_x, I_z = (q.symbol for q in top.top.values)
    expected = (I_x * cos(theta) * phi_dot**2 - I_z * S * phi_dot + M * g * l) * sin(theta)
    assert top.steady.step.outcome == "of_equation"
    assert (top.steady.value.left - expected).expand() == 0


def test_at_45_degrees_there_are_two_rates_and_their_numbers_are_these(top: SimpleNamespace) -> None:
    found = at(top, pi / 4, DISC_ON_ROD)
    assert found.together.step.outcome == "two"
    both = 3 * sqrt(2) / 8 * (S + PLUS_MINUS * sqrt(S**2 - 4 * sqrt(2) * g / a))
    assert (explicit(found.together.value) - both).expand() == 0
    numbers = [float(explicit(each.value).subs(DISC_ON_ROD)) for each in (found.slow, found.fast)]
    assert numbers == pytest.approx([1.5848446, 98.3800215], abs=1e-6)
    assert [each * 30 / float(pi) for each in numbers] == pytest.approx([15.134, 939.460], abs=1e-3)


@pytest.mark.parametrize("numbers", [None, DISC_ON_ROD])
def test_the_condition_for_two_rates_is_solved_for_the_spin(top: SimpleNamespace, numbers: Any) -> None:
    condition = at(top, pi / 4, numbers).condition
    assert condition.value.left == S and condition.value.operator == ">="
    assert (condition.value.right**2 - 4 * sqrt(2) * g / a).expand() == 0


def test_a_spin_below_the_threshold_has_no_steady_precession(top: SimpleNamespace) -> None:
    found = at(top, pi / 4, {**DISC_ON_ROD, S: 20 * pi / 3})
    assert found.together.step.outcome == "none"
    assert found.slow is found.fast
    assert found.slow.step.stands_for == ("slow_precession", "fast_precession")
    assert isinstance(found.slow.value, Relation) and found.slow.value.operator == "<"


def test_at_the_threshold_the_two_rates_coincide(top: SimpleNamespace) -> None:
    found = at(top, pi / 3, {a: Rational(1, 10), g: Integer(10), S: Integer(20)})
    assert found.together.step.outcome == "double"
    assert found.slow is found.fast and found.slow.step.outcome == "coinciding"
    assert explicit(found.slow.value).subs({a: Rational(1, 10), g: 10, S: 20}) == 15


def test_a_horizontal_axis_has_one_rate(top: SimpleNamespace) -> None:
    found = at(top, pi / 2)
    assert found.together.step.outcome == "linear"
    assert found.together is found.slow is found.fast
    assert found.slow.value == 3 * g / (2 * a * S)
    assert found.condition.step.outcome == "always"


def test_below_the_horizontal_one_rate_goes_forward_and_one_backward_at_any_spin(top: SimpleNamespace) -> None:
    found = at(top, 2 * pi / 3)
    outcomes = [each.step.outcome for each in (found.together, found.slow, found.fast)]
    assert outcomes == ["opposite", "nearer", "farther"]
    numbers = {a: 1, g: 1, S: Rational(1, 100)}
    assert explicit(found.slow.value).subs(numbers) > 0 > explicit(found.fast.value).subs(numbers)
    assert found.condition.step.outcome == "always"


def test_a_reversed_spin_reverses_both_rates(top: SimpleNamespace) -> None:
    reversed_top = at(motion_of(verbs_as_imported(), -S), pi / 4, DISC_ON_ROD)
    before = at(top, pi / 4, DISC_ON_ROD)
    assert (explicit(reversed_top.slow.value) + explicit(before.slow.value)).expand() == 0
    assert (explicit(reversed_top.fast.value) + explicit(before.fast.value)).expand() == 0


def test_a_tilt_in_letters_leaves_the_square_of_the_spin(top: SimpleNamespace) -> None:
    alpha = scalar("alpha")
    found = at(top, alpha)
    assert found.together.step.outcome == "conditional"
    assert (found.slow.step.outcome, found.fast.step.outcome) == ("smaller_where_real", "larger_where_real")
    assert found.condition.step.outcome == "squared"
    assert found.condition.value == Relation(S**2, ">=", 8 * g * cos(alpha) / a)


@pytest.mark.parametrize("tilt", [Integer(0), pi])
def test_a_vertical_axis_has_no_rate_of_precession(top: SimpleNamespace, tilt: Any) -> None:
    with pytest.raises(Rejected, match="does not depend on phi_dot here"):
        at(top, tilt)


def test_every_line_of_precession_is_proved(top: SimpleNamespace) -> None:
    found = at(top, pi / 6, DISC_ON_ROD)
    for quantity in (found.together, found.slow, found.fast):
        assert {evidence.grade for evidence in quantity.step.evidence} == {Grade.PROVED}


def test_only_a_quadratic_equation_has_two_roots_together() -> None:
    x = scalar("x")
    with recorded(Run()):
        from sympy import Eq

        cubic = let("cubic", lambda: Eq(x**3, 1))
        with pytest.raises(Rejected, match="not a linear or quadratic equation in x"):
            roots(cubic, x, together="both")


def test_a_factor_that_may_vanish_is_told_beside_the_roots() -> None:
    x, alpha = scalar("x"), scalar("alpha")
    with recorded(Run()):
        from sympy import Eq

        apart = let("apart", lambda: Eq((x**2 - a * x - g) * sin(alpha), 0))
        (first, second) = roots(apart, x, together="both")
    assert dict(first.parents[0].step.roles)["excluded"] == Relation(sin(alpha), "!=", 0)
    assert (first.value + second.value - a).expand() == 0


# --- the upright top ---


def test_upright_the_momentum_of_precession_is_that_of_the_spin(upright: SimpleNamespace) -> None:
    assert upright.upright.value == Symbol("I_z", positive=True) * S


def test_the_tilt_sees_this_potential_energy(upright: SimpleNamespace) -> None:
    """Goldstein, section 5.7, with both momenta I_z S."""
    M, l, I_x, I_z = (Symbol(name, positive=True) for name in ("M", "l", "I_x", "I_z"))
    c = cos(theta)
    expected = I_z * S**2 / 2 + M * g * l * c + (I_z * S) ** 2 * (1 - c) / (2 * I_x * (1 + c))
    assert equal(upright.V.value, expected)
    assert not upright.V.value.has(sin)


def test_the_top_sleeps_at_the_border_too(upright: SimpleNamespace) -> None:
    M, l, I_x, I_z = (Symbol(name, positive=True) for name in ("M", "l", "I_x", "I_z"))
    assert upright.condition.step.outcome == "with_border" and upright.condition.value.operator == ">="
    assert equal(upright.condition.value.right, 2 * sqrt(I_x * M * g * l) / I_z)
    assert upright.here.value.right.subs(DISC_ON_ROD) == 28


def test_where_the_border_is_unstable_it_does_not_belong_to_the_condition() -> None:
    """A soft spring, U = (1/2) k x^2 - c x^4: at k = 0 there is a maximum."""
    k, x = Symbol("k", positive=True), scalar("x")
    with recorded(Run(coordinates={x: "length"})):
        U = let("energy", lambda: (k - g) * x**2 / 2 - m * x**4, symbol="U", kind="energy")
        found = stable_where(stability(U, {x: 0}, k))
        assert found.step.outcome == "without_border" and found.value == Relation(k, ">", g)
        stiff = stability(let("other", lambda: k * x**2 / 2, symbol="W", kind="energy"), {x: 0}, key="stiff")
        with pytest.raises(Rejected, match="has no condition"):
            stable_where(stiff)


# --- wrong laws ---


def test_a_border_that_is_not_the_one_of_the_energy_is_refused() -> None:
    k, x = Symbol("k", positive=True), scalar("x")
    with recorded(Run(coordinates={x: "length"})):
        U = let("energy", lambda: (k - g) * x**2 / 2 + m * x**4, symbol="U", kind="energy")
        stable = stability(U, {x: 0}, k)
        fact = stable.needed(border.StableWhere)
        object.__setattr__(fact, "condition", Relation(k, ">", 2 * g))
        with pytest.raises(Unverified):
            stable_where(stable)


def test_a_momentum_that_keeps_another_value_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept_momentum, "Relation", lambda left, mark, right: Relation(left, mark, 2 * right))
    with pytest.raises(Unverified):
        motion_of(verbs_as_imported())


def test_a_wrong_formula_for_the_roots_is_refused(top: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quadratics, "FOUR", Integer(3))
    with pytest.raises(Unverified):
        at(top, pi / 4, DISC_ON_ROD)


def test_a_moment_without_a_part_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.mechanics.rotation import added_moments

    monkeypatch.setattr(added_moments, "_squares_beside", lambda way, k: Integer(0))
    body = Composite(Disc(a, m).at(0, 0, a), Rod(a, m).at(0, 0, a / 2))
    with recorded(Run()), pytest.raises(Unverified):
        moment_of_inertia(body, "x", about="origin")


def test_what_is_constant_is_put_in_at_all_times(upright: SimpleNamespace) -> None:
    from derive.mechanics.kinematics.coordinates import AtOneMoment

    assert upright.V.fact(AtOneMoment) is None
    with recorded(Run()):
        assert put_in(upright.V, {theta: 0}, key="there").fact(AtOneMoment) is not None


def test_the_sign_of_an_expression_is_told_by_its_letters_or_else_by_their_numbers() -> None:
    b = Symbol("b", real=True)
    assert (sign_known(a * g), sign_known(-a), sign_known(b), sign_known(a - a)) == (1, -1, None, 0)
    with recorded(Run(numbers={b: Integer(-2)})):
        assert (sign_known(b), sign_known(a * b), sign_known(b + 2)) == (-1, -1, 0)
    assert sign_known(b) is None


def greatest_tilt(spin: float, push: tuple[float, float], turns: int = 6000) -> float:
    """Of an upright top with I_x = M g l = 1, which is stable from I_z S = 2 on: the way of its axis, integrated.

    n'' = -n'.n' n + I_z S n x n' + n x (n x Z), after a push that gives the axis a velocity.
    """
    import math

    def cross(u: Any, v: Any) -> tuple[float, float, float]:
        return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]

    def rates(state: Any) -> tuple[float, ...]:
        n, v = state[:3], state[3:]
        turning, falling = cross(n, v), cross(n, cross(n, (0, 0, 1)))
        speed = sum(each * each for each in v)
        return (*v, *(-speed * n[k] + spin * turning[k] + falling[k] for k in range(3)))

    state, step, least = (0.0, 0.0, 1.0, *push, 0.0), 0.02, 1.0
    for _ in range(turns):
        slopes: list[Any] = []
        for part in (0, step / 2, step / 2, step):
            slopes.append(rates([s + part * k for s, k in zip(state, slopes[-1] if slopes else state, strict=True)]))
        moved = [(a + 2 * b + 2 * c + d) * step / 6 for a, b, c, d in zip(*slopes, strict=True)]
        state = tuple(s + d for s, d in zip(state, moved, strict=True))
        least = min(least, state[2])
    return math.acos(least)


@pytest.mark.parametrize("change", [0, 1e-4, -1e-4])
def test_at_the_border_the_upright_top_withstands_every_small_push(change: float) -> None:
    assert greatest_tilt(2 + change, (1e-3, 0)) < 0.1
    assert greatest_tilt(2 + change, (1e-2, 0)) > greatest_tilt(2 + change, (1e-3, 0))


def test_below_the_border_the_smallest_push_topples_it() -> None:
    assert greatest_tilt(1.8, (1e-3, 0)) > 0.5


def test_two_rates_that_differ_need_more_than_that_they_are_real(top: SimpleNamespace) -> None:
    slow = at(top, pi / 4).slow
    with recorded(Run()):
        real, different = (real_where(slow, S, f"condition_{apart}", distinct=apart) for apart in (False, True))
    assert (real.value.operator, different.value.operator) == (">=", ">")
    assert real.value.sides == different.value.sides
    assert dict(different.step.words)["seen"] == "radicand"
