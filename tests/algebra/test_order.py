"""Relations between letters: what they say of signs, and numbers that fulfil them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice

import pytest
from sympy import Abs, Expr, Symbol, pi, symbols

from derive.algebra.order import Contradiction, Order, in_order, known_order
from derive.algebra.ranges import Range, fulfilling, sign_within, within, without_abs
from derive.algebra.samples import points

a, b, c, d, l, r_0, g, R, v_0 = symbols("a b c d l r_0 g R v_0", positive=True)
q = symbols("q", real=True)


def order(*greater: tuple[Expr, Expr]) -> Order:
    found = Order()
    for more, less in greater:
        with in_order(found):
            found = found.with_relation(more - less, True, sign_within)
    return found


@contextmanager
def taken(*greater: tuple[Expr, Expr]) -> Iterator[None]:
    with in_order(order(*greater)):
        yield


def test_a_relation_decides_the_sign_of_a_difference_and_of_polynomials() -> None:
    with taken((r_0, l)):
        assert sign_within(l - r_0) == -1
        assert sign_within(r_0**3 - 3 * l * r_0**2 + 3 * l**2 * r_0 - l**3) == 1
        assert sign_within((l + r_0) ** 3 * (r_0 - l) - (l - r_0) ** 4) == 1
        assert sign_within(1 / (r_0 - l) ** 2 - 1 / (r_0 + l) ** 2) == 1
        assert sign_within(r_0 - 2 * l) is None
    assert sign_within(l - r_0) is None


def test_relations_follow_one_another() -> None:
    with taken((b, a), (c, b)):
        assert sign_within(c - a) == 1
        assert sign_within(a * b - c**2) == -1
        assert sign_within(a + c - 2 * b) is None
    with taken((b, a), (c, a), (c, b)):
        assert sign_within(c - b) == 1


def test_a_relation_may_hold_products_and_powers() -> None:
    with taken((g * R, v_0**2)):
        assert sign_within(v_0**2 - g * R) == -1
        assert sign_within(3 * g * R - v_0**2) == 1
        assert sign_within(2 * v_0**2 - g * R) is None


def test_an_absolute_value_is_settled_by_a_relation() -> None:
    with taken((r_0, l)):
        assert without_abs(Abs(l - r_0)) == r_0 - l
        assert without_abs(Abs(l - d)) == Abs(l - d)


def test_a_relation_that_is_not_strict_leaves_zero_open() -> None:
    found = Order().with_relation(b - a, False, sign_within)
    with in_order(found):
        assert sign_within(b - a) is None
        assert sign_within(b - a + c) == 1


@pytest.mark.parametrize(
    "greater",
    [
        ((b, a), (a, b)),
        ((b, a), (c, b), (a, c)),
        ((g * R, v_0**2), (v_0**2, 2 * g * R)),
        ((-a, b),),
        ((a, a),),
    ],
)
def test_relations_that_contradict_one_another_are_found(greater: tuple[tuple[Expr, Expr], ...]) -> None:
    with pytest.raises(Contradiction):
        order(*greater)


def test_numbers_for_letters_fulfil_the_relations() -> None:
    with taken((r_0, l), (g * R, v_0**2), (c, b), (b, a)):
        for point in islice(points({l, r_0, g, R, v_0, a, b, c}, 7), 30):
            assert point[r_0] > point[l] and point[g] * point[R] > point[v_0] ** 2
            assert point[a] < point[b] < point[c]


def test_numbers_stay_in_the_range_of_their_letter() -> None:
    alpha, beta = symbols("alpha beta", real=True)
    with within({alpha: Range(pi * 0, pi / 2), beta: Range(pi * 0, pi / 2)}), taken((beta, alpha)):
        for point in islice(points({alpha, beta}, 7), 30):
            assert point[alpha] < point[beta] and point[beta] < pi / 2


def test_nothing_is_changed_where_nothing_is_taken_to_hold() -> None:
    assert not known_order()
    assert fulfilling({l: pi}) == {l: pi}
    assert not known_order().touches(Symbol("x"))


def test_a_letter_of_either_sign_may_be_replaced() -> None:
    with taken((q, a)):
        assert sign_within(q) == 1
        assert sign_within(q - a) == 1
