"""Outcomes that are tried numerically: a true one is accepted; a false one is refused, and so is one that no numbers
fulfil."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Integer, Rational, acos, cos, exp, sin, sqrt, symbols

from derive.algebra.expressions import TIME, Relation, scalar
from derive.mechanics.answers.quadratics import Quadratic
from derive.mechanics.rest import claims
from derive.steps.record import assume, recorded
from derive.steps.rule import RULES, Judged
from tests.rules import holds, stated_rightly

m, k, b, S, l = symbols("m k b S l", positive=True)
alpha, beta = symbols("alpha beta", real=True)
u, omega, x = scalar("u"), scalar("omega"), scalar("x")
ZERO = Integer(0)
NEVER = Relation(m, "<", ZERO)  # an equilibrium that exists for no numbers


def linear(stiffness: Any, turning: Any = ZERO, **more: Any) -> dict[str, Any]:
    """The matrices of m x_ddot + c x_dot + k x = 0."""
    matrices = {"stiffness": stiffness, "turning": turning, "mass": m}
    return {role: ImmutableDenseMatrix([[value]]) for role, value in matrices.items()} | {"conditions": ()} | more


def turning(stiffness: Any, **more: Any) -> dict[str, Any]:
    eye, turn = ImmutableDenseMatrix([[1, 0], [0, 1]]), ImmutableDenseMatrix([[0, -S], [S, 0]])
    return {"stiffness": stiffness * eye, "turning": turn, "mass": m * eye, "conditions": ()} | more


UNDERDAMPED = sqrt(k / m - b**2 / (4 * m**2))
NOT_SMALL = Relation(b**2, "<", 4 * m * k)
FORWARDS = ImmutableDenseMatrix([cos(k * TIME), sin(k * TIME)])
GROWING = ImmutableDenseMatrix([exp(S * TIME), 2 * exp(S * TIME)])

RIGHT_AND_WRONG: list[tuple[str, str, Judged, list[Judged]]] = [
    (
        "vibrations.gyroscopic_frequency",
        "oscillating",
        Judged(sqrt(k / m), linear(k)),
        [Judged(sqrt(2 * k / m), linear(k)), Judged(sqrt(k / m), linear(-k)), Judged(-sqrt(k / m), linear(k))],
    ),
    (
        "vibrations.gyroscopic_frequency",
        "growing",
        Judged(sqrt(k / m), linear(-k)),
        [Judged(sqrt(k / m), linear(k)), Judged(sqrt(2 * k / m), linear(-k))],
    ),
    (
        "vibrations.gyroscopic_frequency",
        "conditional",
        Judged(sqrt(alpha / m), linear(alpha, conditions=(Relation(alpha, ">", ZERO),))),
        [Judged(sqrt(alpha / m), linear(alpha)), Judged(sqrt(alpha / m), linear(2 * alpha))],
    ),
    ("vibrations.gyroscopic_frequency", "free", Judged(ZERO, linear(ZERO)), [Judged(ZERO, linear(k))]),
    (
        "vibrations.gyroscopic_stability",
        "stable",
        Judged(None, linear(k)),
        [Judged(None, linear(-k)), Judged(None, linear(alpha)), Judged(None, turning(-k))],
    ),
    (
        "vibrations.gyroscopic_stability",
        "unstable",
        Judged(None, linear(-k)),
        [Judged(None, linear(k)), Judged(None, linear(alpha)), Judged(None, turning(-k))],
    ),
    (
        "vibrations.gyroscopic_stability",
        "depends",
        Judged(c := Relation(S**2, ">", 4 * m * k), turning(-k, conditions=(c,))),
        [
            Judged(c := Relation(S**2, ">", factor * m * k), turning(-k, conditions=(c,)))
            for factor in (1, 3, Rational(39, 10), Rational(41, 10), 5, 16, 100)
        ],
    ),
    (
        "vibrations.gyroscopic_motion",
        "circle_forwards",
        Judged(FORWARDS, linear(k)),
        [Judged(ImmutableDenseMatrix([FORWARDS[1], FORWARDS[0]]), linear(k))],
    ),
    (
        "vibrations.gyroscopic_motion",
        "departing",
        Judged(GROWING, linear(S)),
        [Judged(GROWING.subs(S, -S), linear(S)), Judged(GROWING.subs(S, alpha), linear(alpha))],
    ),
    (
        "vibrations.damped_frequency",
        "conditional",
        Judged(UNDERDAMPED, linear(k, b, beta=b / (2 * m), conditions=(NOT_SMALL,))),
        [
            Judged(UNDERDAMPED, linear(k, b, beta=b / m, conditions=(NOT_SMALL,))),
            Judged(UNDERDAMPED, linear(k, b, beta=b / (2 * m), conditions=(Relation(b**2, "<", 2 * m * k),))),
            Judged(UNDERDAMPED, linear(k, b, beta=b / (2 * m), conditions=(Relation(b**2, ">", 4 * m * k),))),
        ],
    ),
    (
        "vibrations.damped_rate",
        "oscillator",
        Judged(b / (2 * m), linear(k, b)),
        [Judged(b / m, linear(k, b)), Judged(-b / (2 * m), linear(k, b))],
    ),
    (
        "vibrations.damped_shape",
        "in_phase",
        Judged(ImmutableDenseMatrix([m, 2 * k]), linear(k)),
        [Judged(ImmutableDenseMatrix([m, alpha]), linear(alpha)), Judged(ImmutableDenseMatrix([m, m - k]), linear(k))],
    ),
    (
        "vibrations.mode_frequency",
        "oscillating",
        Judged(sqrt(k / m), linear(k)),
        [Judged(sqrt(2 * k / m), linear(k)), Judged(sqrt(alpha / m), linear(alpha)), Judged(-sqrt(k / m), linear(k))],
    ),
    (
        "vibrations.frequency_squared",
        "stable",
        Judged(k / m, {}),
        [Judged(k / m - b, {}), Judged(alpha, {}), Judged(-k, {})],
    ),
]


@pytest.mark.parametrize(("rule", "outcome", "right", "wrong"), RIGHT_AND_WRONG)
def test_a_false_outcome_is_refused(rule: str, outcome: str, right: Judged, wrong: list[Judged]) -> None:
    assert holds(rule, outcome, right)
    assert [facts for facts in wrong if holds(rule, outcome, facts)] == []


@pytest.mark.parametrize(("rule", "outcome", "right", "wrong"), RIGHT_AND_WRONG)
def test_an_outcome_that_no_numbers_confirm_is_refused(
    rule: str, outcome: str, right: Judged, wrong: list[Judged]
) -> None:
    assert not holds(rule, outcome, replace(right, inputs={**right.inputs, "exists": NEVER}))


# --- equilibria ---


FACTORS = [(Integer(1), True), (Rational(11, 10), False), (Rational(9, 10), False), (Integer(30), False)]


@pytest.mark.parametrize(("factor", "right"), FACTORS)
def test_an_equilibrium_exists_just_where_its_condition_says(factor: Any, right: bool) -> None:
    """A bead on a turning hoop, cos x = k/m; the force is sin x (k - m cos x)."""
    force = Relation(sin(x) * (k - m * cos(x)), "=", ZERO)
    inputs = {"sought": (x,), "distances": (), "condition_0": force, "exists": Relation(m, ">", factor * k)}
    assert claims.under_its_condition(Judged(acos(k / m), inputs)) == right
    assert not claims.anywhere(Judged(acos(k / m), {**inputs, "exists": NEVER}))
    del inputs["exists"]
    assert not claims.anywhere(Judged(acos(k / m), inputs))
    assert claims.anywhere(Judged(acos(k / (k + m)), inputs))


@pytest.mark.parametrize(("factor", "right"), FACTORS)
def test_an_equilibrium_is_stable_just_where_its_condition_says(factor: Any, right: bool) -> None:
    inputs = {
        "potential_here": k * x**2 - m * x**2 + m * x**4,
        "coordinates": (x,),
        "place": (ZERO,),
        "condition": Relation(k, ">", factor * m),
    }
    assert claims.depends(None)(Judged(2 * k - 2 * m, inputs)) == right
    assert not claims.depends(None)(Judged(2 * k - 2 * m, {**inputs, "exists": NEVER}))


# --- answers ---


@pytest.mark.parametrize(
    ("value", "right"), [(k / m + 2, True), (k * m, False), (k + m, False), (alpha**2 + 1, True), (alpha, False)]
)
def test_a_cosine_is_called_greater_than_one_only_if_it_always_is(value: Any, right: bool) -> None:
    facts = Judged(Relation(value, ">", Integer(1)), {"unknown": cos(x)})
    assert holds("answers.roots_absent", "none_reached", facts) == right


@pytest.mark.parametrize(("difference", "right"), [(k**2 + m, True), (k - m / 2, False), (k - m, False)])
def test_a_comparison_holds_always_only_if_its_sign_is_the_same_for_all_numbers(difference: Any, right: bool) -> None:
    facts = Judged(
        Relation(difference, ">", ZERO), {"sign": 1, "difference": difference}, words={"comparison": "greater_than"}
    )
    assert holds("answers.where", "always", facts) == right
    with recorded():
        assume(Relation(k, ">", m))
        assert holds("answers.where", "always", facts)


@pytest.mark.parametrize(
    ("value", "condition", "right"),
    [
        (sqrt(k - m), Relation(k, ">", m), True),
        (sqrt(k - m), Relation(k, ">", 2 * m), False),
        (sqrt(k - m), Relation(k, ">", m * Rational(101, 100)), False),
        (sqrt(k - m), Relation(k, "<", m), False),
        (sqrt(k + m), None, True),
        (sqrt(k - m), None, False),
    ],
)
def test_a_frequency_is_real_just_where_its_condition_says(value: Any, condition: Any, right: bool) -> None:
    inputs = {"positive": Integer(1), "equation": Relation(u**2, "=", value**2), "unknown": u, "count": 1}
    facts = Judged(
        value, inputs | ({"condition": condition} if condition is not None else {}), words={"asked": "roots"}
    )
    assert stated_rightly("answers.roots", "only", facts) == right


def test_a_root_under_a_condition_that_nothing_fulfils_is_refused() -> None:
    place = {"positive": Integer(0), "letter": u}
    assert stated_rightly("answers.extremum_place", "least", Judged(k / m, place))
    assert not stated_rightly("answers.extremum_place", "least", Judged(sqrt(-k), place))
    assert not stated_rightly("answers.extremum_place", "least", Judged(k / m, place | {"existing": NEVER}))


@pytest.mark.parametrize("value", [-k, alpha, sqrt(-k), k - m])
def test_a_period_is_not_negative_and_real_somewhere(value: Any) -> None:
    assert stated_rightly("vibrations.period", "generic", Judged(k / m))
    assert not stated_rightly("vibrations.period", "generic", Judged(value))


@pytest.mark.parametrize("turn", [1, -1])
def test_the_smaller_of_two_roots_is_tried_where_they_are_real(turn: int) -> None:
    both = Quadratic(Integer(1), -2 * k, m)
    facts = Judged(k + turn * sqrt(k**2 - m), {"quadratic": both})
    assert holds("answers.one_of_two", "smaller_where_real", facts) == (turn == -1)
    imaginary = Quadratic(Integer(1), ZERO, m)
    assert not holds("answers.one_of_two", "smaller_where_real", Judged(turn * sqrt(-m), {"quadratic": imaginary}))


@pytest.mark.parametrize(("outcome", "turn"), [("least", 1), ("greatest", -1)])
def test_an_extremum_is_tried_beside_its_place(outcome: str, turn: int) -> None:
    inputs: dict[str, Any] = {"letter": u, "value": turn * (k * (u - m) ** 2 + b), "place": m}
    other = {"least": "greatest", "greatest": "least"}[outcome]
    assert holds("answers.extremum_place", outcome, Judged(m, inputs))
    assert not holds("answers.extremum_place", other, Judged(m, inputs))
    assert not holds("answers.extremum_place", outcome, Judged(m, inputs | {"value": turn * alpha * (u - m) ** 2}))
    assert not holds("answers.extremum_place", outcome, Judged(m, inputs | {"place": m + Rational(1, 100) * k}))
    assert not holds("answers.extremum_place", outcome, Judged(m, inputs | {"condition": NEVER}))


def test_every_rule_that_is_tried_here_is_a_rule() -> None:
    assert {rule for rule, *_ in RIGHT_AND_WRONG} <= set(RULES)
