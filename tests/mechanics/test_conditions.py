"""Inequalities worked until one letter stands alone, and those that cannot be."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr, Integer, Rational, pi, sin, sqrt, symbols

from derive.algebra.equality import Compared, Grade
from derive.algebra.expressions import Amount, Relation
from derive.errors import Rejected
from derive.mechanics import let, limiting_case, where
from derive.steps.numeric import comparison_of
from derive.steps.step import Quantity

R, a, b, g, M = symbols("R a b g M", positive=True)
u, v = symbols("u v", real=True)


def quantity(value: Expr) -> Quantity:
    return let("v", lambda: value)


def condition(value: Expr, letter: Expr = R, mark: str = ">") -> Relation:
    return where(quantity(value), mark, 0, letter).value


@pytest.mark.parametrize(
    ("value", "bound"),
    [
        (R - a / 2, Relation(R, ">", a / 2)),
        (a - 2 * R, Relation(R, "<", a / 2)),
        (M * g * (R - a / 2) / (M * a**2 + 1), Relation(R, ">", a / 2)),
        (-M * (R - a), Relation(R, "<", a)),
        (R**2 - a**2 / 4, Relation(R, ">", a / 2)),
        (2 * a * g - R**2, Relation(R, "<", sqrt(2) * sqrt(a * g))),
        (R * a - b**2, Relation(R, ">", b**2 / a)),
        (R - pi, Relation(R, ">", pi)),
        (R - a + b, Relation(R, ">", a - b)),
    ],
)
def test_a_quantity_is_positive_beyond_its_bound(value: Expr, bound: Relation) -> None:
    assert condition(value) == bound


def test_where_zero_is_allowed_the_mark_says_so() -> None:
    assert condition(R - a, mark=">=") == Relation(R, ">=", a)
    assert condition(a - R, mark=">=") == Relation(R, "<=", a)


def test_another_letter_may_be_the_one_to_solve_for() -> None:
    assert condition(R - a / 2, a) == Relation(a, "<", 2 * R)


def test_a_multiple_of_a_letter_stands_for_it() -> None:
    """Where the radius was given as 2b, it is b that the condition is about."""
    assert condition(2 * b - a / 2, 2 * b) == Relation(b, ">", a / 4)


def test_of_several_letters_one_that_will_do_is_solved_for() -> None:
    assert condition(b - 3 * a / 2, b - a) == Relation(a, "<", 2 * b / 3)


@pytest.mark.parametrize(
    ("value", "outcome", "mark"),
    [
        (M * g * a, "always", ">"),
        (R + a, "always", ">"),
        (-M / (R + a), "never", "<"),
        (Integer(0), "equal", "="),
        (R - R, "equal", "="),
        (Rational(1, 3), "always", ">"),
    ],
)
def test_a_sign_that_no_letter_decides_is_told(value: Expr, outcome: str, mark: str) -> None:
    found = where(quantity(value), ">", 0, R)
    assert found.step.outcome == outcome
    assert found.value.operator == mark


@pytest.mark.parametrize(
    "value",
    [
        pytest.param((R - a) * (R - b), id="two bounds"),
        pytest.param((R - a) ** 2, id="a square that may vanish"),
        pytest.param(u * R - a, id="a factor of unknown sign"),
        pytest.param(a - b, id="the letter does not occur"),
        pytest.param(sin(R) - a, id="no polynomial"),
        pytest.param(R**3 - a**3, id="a cube"),
        pytest.param(M / (R - a), id="the letter below the line"),
    ],
)
def test_what_one_letter_does_not_decide_is_refused(value: Expr) -> None:
    with pytest.raises(Rejected) as refusal:
        where(quantity(value), ">", 0, R)
    (complaint,) = refusal.value.complaints
    assert complaint.code == "no-condition"
    assert complaint.message.startswith("`v` cannot be solved for R: ")


def test_every_line_of_a_condition_is_proved() -> None:
    found = where(quantity(M * g * (R**2 - a * b) / a), ">", 0, R)
    lines = [e.grade for e in found.step.evidence if e.compared is Compared.LINES]
    assert lines and set(lines) == {Grade.PROVED}
    checks = {e.claim: e.grade for e in found.step.evidence if e.compared is Compared.CHECK}
    assert checks == {"beside": Grade.PROVED, "points": Grade.SAMPLED}


@settings(max_examples=40, deadline=None, derandomize=True)
@given(st.integers(1, 9), st.integers(1, 9), st.booleans(), st.integers(1, 40))
def test_the_condition_holds_exactly_where_the_quantity_is_positive(n: int, d: int, falls: bool, place: int) -> None:
    value = (n * R - d * a) * (-1 if falls else 1)
    found = condition(value)
    numbers = {R: Rational(place, 4), a: 1}
    difference = found.residual.subs(numbers) * (1 if found.operator == ">" else -1)
    assert (difference > 0) == (value.subs(numbers) > 0)


# --- with numbers ---

CM = Rational(1, 100)


def compared(radius: int, thickness: int, mark: str = ">") -> Quantity | None:
    amounts = {R: Amount(Integer(radius), "cm", CM), a: Amount(Integer(thickness), "cm", CM)}
    return comparison_of(where(quantity(R - a / 2), mark, 0, R), amounts)


@pytest.mark.parametrize(
    ("radius", "thickness", "outcome", "mark"),
    [(20, 5, "fulfilled", ">"), (10, 30, "not_fulfilled", "<"), (10, 20, "not_fulfilled", "=")],
)
def test_with_numbers_a_condition_is_fulfilled_or_not(radius: int, thickness: int, outcome: str, mark: str) -> None:
    found = compared(radius, thickness)
    assert found is not None
    assert (found.step.outcome, found.value.operator) == (outcome, mark)


def test_on_the_border_a_condition_that_allows_zero_is_fulfilled() -> None:
    found = compared(10, 20, ">=")
    assert found is not None
    assert found.step.outcome == "fulfilled"


def test_a_condition_with_letters_left_or_without_any_is_not_compared() -> None:
    amounts = {R: Amount(Integer(20), "cm", CM)}
    assert comparison_of(where(quantity(R - a / 2), ">", 0, R), amounts) is None
    assert comparison_of(where(quantity(Rational(1, 2)), ">", 0, R), amounts) is None
    assert comparison_of(where(quantity(R - R), ">", 0, R), amounts) is None
    assert comparison_of(quantity(R), amounts) is None


def test_the_limit_of_a_bound_tells_the_bound_and_that_of_an_equation_none() -> None:
    bounded = limiting_case(where(quantity(R - a * b), ">=", 0, R, key="wide"), a)
    assert dict(bounded.step.roles)["bound"] == a * b
    equation = limiting_case(where(quantity(R - a * b), "=", 0, R, key="exact"), a)
    assert "bound" not in dict(equation.step.roles)
