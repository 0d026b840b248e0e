"""What equations of motion make of a quantity, for motions of any kind."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, Integer, Symbol, cos, sin, symbols

from derive.algebra.equality import Grade
from derive.algebra.expressions import Factors, Relation, Terms, explicit
from derive.errors import Rejected
from derive.mechanics import coordinate, rate_under
from derive.steps.establish import Scope, establish
from derive.steps.rule import RULES
from derive.steps.step import Quantity

M, k, b, g, l = symbols("M k b g l", positive=True)
x = coordinate("x", "length")
theta = coordinate("theta")
NONE = Integer(0)


both = SimpleNamespace(letters={**x.letters, **theta.letters})


def named(key: str, value: Expr, moving: Any, kind: str | None = None) -> Quantity:
    return establish(
        RULES["answers.let"],
        Symbol(key, real=True),
        lambda: value,
        {},
        key=key,
        kind=kind,
        scope=Scope(coordinates=moving.letters),
    )


def equation(left: Expr, moving: Any, right: Expr = NONE, key: str = "motion") -> Quantity:
    return establish(
        RULES["answers.let"],
        None,
        lambda: Relation(left, "=", right),
        {},
        outcome="equation",
        key=key,
        scope=Scope(coordinates=moving.letters),
    )


def test_the_energy_of_an_oscillator_is_conserved() -> None:
    energy = named("E", (M * x.rate**2 + k * x.symbol**2) / 2, x, "energy")
    found = rate_under(energy, [equation(M * x.acceleration + k * x.symbol, x)])
    assert found.value == 0
    assert found.step.outcome == "conserved"
    assert found.step.kind == "power"
    assert found.step.grade is Grade.PROVED


def test_friction_takes_energy_at_the_rate_of_its_power() -> None:
    energy = named("E", (M * x.rate**2 + k * x.symbol**2) / 2, x, "energy")
    found = rate_under(energy, [equation(M * x.acceleration + k * x.symbol, x, -b * x.rate)])
    assert (found.value + b * x.rate**2).expand() == 0
    assert found.step.outcome == "changes"


def test_the_energy_of_a_pendulum_of_any_amplitude_is_conserved() -> None:
    q = theta.symbol
    energy = named("E", M * l**2 * theta.rate**2 / 2 - M * g * l * cos(q), theta, "energy")
    assert rate_under(energy, [equation(l * theta.acceleration + g * sin(q), theta)]).value == 0


def test_the_small_amplitude_energy_of_a_large_pendulum_is_not_conserved() -> None:
    q = theta.symbol
    energy = named("E", M * l**2 * theta.rate**2 / 2 + M * g * l * q**2 / 2, theta, "energy")
    assert rate_under(energy, [equation(l * theta.acceleration + g * sin(q), theta)]).step.outcome == "changes"


def test_each_equation_is_multiplied_by_what_the_quantity_needs() -> None:
    y = coordinate("y", "length")
    both = {**x.letters, **y.letters}
    turning = establish(
        RULES["answers.let"],
        Symbol("l_z", real=True),
        lambda: M * (x.symbol * y.rate - y.symbol * x.rate),
        {},
        key="l_z",
        scope=Scope(coordinates=both),
    )
    pulls = [equation(M * q.acceleration + k * q.symbol, q, key=q.symbol.name) for q in (x, y)]
    found = rate_under(turning, pulls)
    assert found.value == 0
    assert [found_sum.key for found_sum in found.parents[:1]] == ["l_z_sum"]
    products = [p.step for p in found.parents[0].parents if p.step.rule == "motion.product"]
    assert {p.key: dict(p.roles)["factor"] for p in products} == {"l_z_x": -y.symbol, "l_z_y": x.symbol}
    assert {p.outcome for p in products} == {"one_of_several"}
    told = dict(found.parents[0].step.roles)
    assert (told["factor_1"], told["factor_2"]) == (-y.symbol, x.symbol)


def test_the_coefficients_of_a_common_product_stand_together_in_the_sum() -> None:
    A, B, C = symbols("A B C", positive=True)
    u, v, w = (coordinate(name, "angular speed") for name in ("u", "v", "w"))
    letters = SimpleNamespace(letters={**u.letters, **v.letters, **w.letters})
    own = {"x": (A, u, B - C, v, w), "y": (B, v, C - A, u, w), "z": (C, w, A - B, u, v)}
    euler = [
        equation(moment * at.rate - left * p.symbol * q.symbol, letters, key=key)
        for key, (moment, at, left, p, q) in own.items()
    ]
    energy = named("T", (A * u.symbol**2 + B * v.symbol**2 + C * w.symbol**2) / 2, letters)
    (gathered,) = (form for form in rate_under(energy, euler).parents[0].step.chain if form.because == "gathered")
    assert gathered.expr.right == Factors(Terms(B - C, C - A, A - B), u.symbol * v.symbol * w.symbol)


def test_what_does_not_move_needs_no_equation() -> None:
    found = rate_under(named("n", k, x), [equation(M * x.acceleration + k * x.symbol, x)])
    assert found.value == 0
    assert len(found.parents) == 1


def test_only_the_last_line_rests_on_the_equations() -> None:
    energy = named("E", (M * x.rate**2 + k * x.symbol**2) / 2, x)
    *forms, last = rate_under(energy, [equation(M * x.acceleration + k * x.symbol, x)]).step.chain
    assert [form.because for form in forms] == ["put_in", "chain_rule"]
    assert last.because == "motion"
    assert all(explicit(form.expr).has(x.acceleration) for form in forms)


@pytest.mark.parametrize(
    ("equations", "message"),
    [
        ([], "derive cannot solve 0 equations of motion for any rate"),
        ([equation(k * x.symbol, x)], "derive cannot solve 1 equation of motion for any rate"),
        (
            [equation(M * x.acceleration + M * l * theta.acceleration, both)],
            "derive cannot solve 1 equation of motion for x_ddot, theta_ddot",
        ),
        ([equation(M * x.acceleration, x)] * 2, "derive cannot solve 2 equations of motion for x_ddot"),
        ([equation(x.acceleration**2 - k, x)], "derive cannot solve 1 equation of motion for x_ddot"),
    ],
)
def test_equations_must_determine_the_motion(equations: list[Quantity], message: str) -> None:
    with pytest.raises(Rejected) as refusal:
        rate_under(named("E", x.rate**2, x), equations)
    assert refusal.value.complaints[0].message == message


def test_a_value_is_no_equation() -> None:
    energy = named("E", x.rate**2, x)
    with pytest.raises(Rejected) as refusal:
        rate_under(energy, [energy])
    assert refusal.value.complaints[0].message == "`E` is not an equation"


def test_a_rate_that_the_equations_do_not_give_is_refused() -> None:
    with pytest.raises(Rejected):
        rate_under(named("jerk", x.acceleration, x), [equation(M * x.acceleration + k * x.symbol, x)])
