"""Trial numbers: allowed by all that is known of the letters, of many sizes, and never none."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import pytest
from sympy import Expr, Poly, exp, log, sqrt, symbols

from derive.algebra import ranges
from derive.algebra.expressions import Relation
from derive.algebra.order import Order, in_order
from derive.algebra.ranges import Range, sign_within, within
from derive.algebra.samples import NoNumber
from derive.steps import signs as steps_signs
from derive.steps.record import Run, assume, recorded
from derive.steps.trial_numbers import (
    TRIED,
    as_rational,
    assumptions_about,
    decides,
    everywhere,
    holds_at,
    real_at,
    roots_of,
    sign_at,
    sign_found,
    signs_of,
    trial_points,
)

m, k, l, n = symbols("m k l n", positive=True)
x, y = symbols("x y", real=True)
u = symbols("u")
ZERO, ONE = 0 * m, m / m
NEVER = Relation(m, "<", ZERO)


def test_points_fulfil_the_conditions_and_the_ranges() -> None:
    with within({x: Range(ONE, 3 * ONE)}):
        found = trial_points({m, k, x}, Relation(m, ">", k), Relation(x**2, "<", 4))
    assert len(found) == TRIED
    assert all(point[m] > point[k] and 1 < point[x] < 2 for point in found)
    assert all(number.is_Rational for point in found for number in point.values())


def test_without_letters_there_is_one_point() -> None:
    assert trial_points(set()) == [{}]
    assert trial_points(set(), Relation(ONE, ">", ZERO)) == [{}]
    assert trial_points(set(), Relation(ONE, "<", ZERO)) == []


@pytest.mark.parametrize("size", [2, 4, 7])
def test_each_letter_is_large_where_another_is_small(size: int) -> None:
    letters = symbols(f"a:{size}", positive=True)
    points = trial_points(letters)
    for one, other in permutations(letters, 2):
        assert max(point[one] / point[other] for point in points) > 50


@pytest.mark.parametrize("factor", [ONE / 50, ONE / 3, 3 * ONE, 50 * ONE])
@pytest.mark.parametrize("power", [1, 2, -1])
def test_both_sides_of_a_condition_are_tried(factor: Expr, power: int) -> None:
    points = trial_points({m, k, l})
    assert decides(Relation(m * l**power, ">", factor * k), points)
    assert not decides(Relation(m * l, ">", -k), points)


def test_a_statement_that_is_tested_nowhere_is_not_accepted() -> None:
    assert trial_points({m}, NEVER) == []
    assert not everywhere(trial_points({m}, NEVER), lambda _: True)
    assert not everywhere(trial_points({m}), lambda _: None)
    assert not everywhere(trial_points({m}), lambda point: sign_at(1 / (m - m * ONE / (ONE + ZERO)), point) is not None)
    assert signs_of(m, NEVER) == set()


def test_a_statement_that_is_false_at_one_point_is_not_accepted() -> None:
    points = trial_points({m})
    assert everywhere(points, lambda point: point[m] > 0)
    assert not everywhere(points, lambda point: point is not points[-1])


def test_an_undefined_or_complex_value_has_no_sign() -> None:
    assert signs_of(sqrt(-m)) == {None}
    assert signs_of(sqrt(x)) == {1, None}
    assert signs_of(x - x * (y + 1) + x * y) == {0}
    assert abs((real_at(sqrt(x) * sqrt(x + 1), {x: -2 * ONE}) or ONE) + sqrt(ONE + 1)) < 10**-20


@pytest.mark.parametrize(("operator", "meets"), [("=", (0,)), ("!=", (1, -1)), (">", (1,)), ("<=", (0, -1))])
def test_a_condition_holds_by_its_mark(operator: str, meets: tuple[int, ...]) -> None:
    assert {s for s in (1, 0, -1) if holds_at(Relation(x, operator, ZERO), {x: s * ONE})} == set(meets)


def test_an_inequality_of_complex_numbers_selects_no_point() -> None:
    assert trial_points({m}, Relation(sqrt(-m), "<", ONE)) == []
    assert len(trial_points(set(), Relation(log(x), "<", ONE))) == TRIED


def test_assumptions_of_the_page_select_points_by_their_letters() -> None:
    with recorded(Run(numbers={k: 3 * ONE})):
        assume(Relation(m, ">", k))
        assume(Relation(l, ">", m))
        assert assumptions_about({m}) == [Relation(m, ">", 3)]
        assert all(point[m] > 3 for point in trial_points({m}, *assumptions_about({m})))


def test_roots_of_a_polynomial_are_each_named_once() -> None:
    assert sorted(root.real for root in roots_of(Poly((u - 1) ** 2 * (u - 3), u))) == pytest.approx([1, 3])
    assert abs(as_rational(sqrt(ONE + 1)) ** 2 - 2) < 10**-30


def test_roots_that_are_not_found_are_no_roots() -> None:
    with pytest.raises(NoNumber):
        roots_of(Poly(u**2 - 10**91, u))


def test_an_assumed_order_is_kept() -> None:
    with in_order(Order().with_relation(k - m, True, sign_within)):
        assert signs_of(k - m) == {1}


def test_trial_numbers_do_not_use_the_signs_by_which_verbs_decide(monkeypatch: pytest.MonkeyPatch) -> None:
    def asked(*_: Any) -> Any:
        raise AssertionError

    for module, name in ((steps_signs, "sign_known"), (ranges, "sign_within"), (ranges, "strict_sign_within")):
        monkeypatch.setattr(module, name, asked)
    with within({x: Range(ONE, 3 * ONE)}):
        assert signs_of(k * x - x * 2, Relation(m, ">", k)) == {1, -1}


def test_a_value_too_small_to_compute_at_some_points_has_its_sign() -> None:
    assert sign_found(exp(-k / m)) == 1
    assert sign_found(-k * exp(-k / m)) == -1
    assert sign_found(exp(-k / m) - exp(-1)) is None
