"""Signs that are settled where a letter lies between two numbers, and those that are not."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from sympy import Abs, Expr, Integer, Symbol, cos, pi, sin, sqrt, tan

from derive.algebra.equality import equal
from derive.algebra.ranges import Range, settled, sign_within, within
from derive.algebra.tidy import tidied

alpha = Symbol("alpha", positive=True)
beta = Symbol("beta", real=True)
a = Symbol("a", positive=True)


@pytest.fixture(autouse=True)
def acute() -> Iterator[None]:
    with within({alpha: Range(Integer(0), pi / 2), beta: Range(-pi / 2, pi / 2)}):
        yield


@pytest.mark.parametrize(
    ("expr", "sign"),
    [
        (sin(alpha), 1),
        (cos(alpha), 1),
        (tan(alpha), 1),
        (sin(2 * alpha), 1),
        (cos(2 * alpha), None),
        (sin(alpha - pi), -1),
        (sin(alpha + pi / 2), 1),
        (sin(3 * alpha), None),
        (cos(beta), 1),
        (sin(beta), None),
        (alpha - pi / 2, -1),
        (a * sin(alpha) ** 3 / cos(alpha), 1),
        (-a * cos(beta), -1),
        (alpha - beta, None),
        (alpha - a, None),
    ],
)
def test_a_sign_is_told_where_it_is_one_in_the_whole_range(expr: Expr, sign: int | None) -> None:
    assert sign_within(expr) == sign


def test_an_absolute_value_goes_where_its_sign_is_settled() -> None:
    assert settled(Abs(sin(alpha)) + Abs(sin(beta))) == sin(alpha) + Abs(sin(beta))
    assert tidied(sqrt(a**2 * sin(alpha) ** 2)) == a * sin(alpha)
    assert tidied(sqrt(1 - cos(alpha) ** 2)) == sin(alpha)


def test_what_is_equal_in_the_range_is_equal() -> None:
    assert equal(sqrt(sin(alpha) ** 2), sin(alpha))
    assert not equal(sqrt(sin(beta) ** 2), sin(beta))
    assert not equal(sqrt(cos(2 * alpha) ** 2), cos(2 * alpha))


def test_nothing_is_known_outside() -> None:
    with within({alpha: Range(-pi, pi)}):
        assert not equal(Abs(sin(alpha)), sin(alpha))
