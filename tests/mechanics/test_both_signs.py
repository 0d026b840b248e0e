"""A letter of either sign is tried with both: what is true of positive numbers alone is refused."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr, ImmutableDenseMatrix, Integer, sqrt, symbols

from derive.algebra.ranges import POSITIVE, Range, within
from derive.mechanics.answers.quadratics import Quadratic
from derive.steps.record import Run, recorded
from derive.steps.rule import Judged
from derive.steps.trial_numbers import sign_at, trial_points
from tests.rules import holds

m, k = symbols("m k", positive=True)
alpha, beta = symbols("alpha beta", real=True)


def frequency(word: str, stiffness: Expr, found: Expr) -> bool:
    one: dict[str, Any] = {"stiffness": ImmutableDenseMatrix([[stiffness]]), "mass": ImmutableDenseMatrix([[m]])}
    return holds("vibrations.mode_frequency", word, Judged(found, one))


def root(word: str, b: Expr, c: Expr, turn: int) -> bool:
    """(-b +- sqrt(b^2 - 4 c))/2"""
    return holds(
        "answers.one_of_two", word, Judged((-b + turn * sqrt(b**2 - 4 * c)) / 2, {"quadratic": Quadratic(m / m, b, c)})
    )


@pytest.mark.parametrize(("word", "either"), [("oscillating", False), ("growing", False), ("conditional", True)])
def test_a_stiffness_of_either_sign_neither_swings_nor_grows(word: str, either: bool) -> None:
    assert frequency(word, alpha, sqrt(alpha / m)) is either
    assert frequency("oscillating", k, sqrt(k / m))


def test_a_frequency_is_not_negative_for_any_sign_of_a_letter() -> None:
    assert frequency("oscillating", m * k**2, k)
    assert not frequency("conditional", m * alpha**2, alpha)
    with within({alpha: POSITIVE}):
        assert frequency("oscillating", m * alpha**2, alpha)


def test_which_root_is_smaller_is_told_by_the_numbers_of_a_problem() -> None:
    with recorded(Run(numbers={alpha: Integer(3)})):
        assert root("smaller", -m * alpha, 2 * m**2 * alpha / 3, -1)
        assert not root("larger", -m * alpha, 2 * m**2 * alpha / 3, -1)
    with recorded(Run(numbers={alpha: Integer(-3)})):
        assert not root("smaller", -m * alpha, 2 * m**2 * alpha / 3, -1)


def test_which_root_is_smaller_depends_on_the_sign_of_a_letter() -> None:
    assert root("smaller_where_real", -2 * m, k, -1)
    assert not root("smaller_where_real", -2 * alpha, k, -1)
    assert not root("larger_where_real", -2 * alpha, k, -1)


def test_all_ways_of_two_letters_are_tried() -> None:
    def ways(*letters: Expr) -> set[tuple[int, ...]]:
        return {tuple(sign_at(letter, point) or 0 for letter in letters) for point in trial_points({*letters, m, k})}

    assert ways(m) == {(1,)}
    assert ways(alpha, beta) == {(1, 1), (1, -1), (-1, 1), (-1, -1)}
    assert len(ways(alpha, beta, *symbols("x y", real=True))) == 16
    with within({alpha: Range(Integer(1), Integer(3))}):
        assert ways(alpha) == {(1,)}
