"""Signs that the letters, or else the numbers behind them, decide."""

from __future__ import annotations

import pytest
from sympy import Expr, Rational, cos, pi, sin, sqrt, symbols

from derive.steps.known_numbers import with_numbers
from derive.steps.record import Run, recorded
from derive.steps.signs import sign_known

a, b = symbols("a b", positive=True)
x = symbols("x", real=True)


@pytest.mark.parametrize(
    ("expr", "sign"),
    [
        (a * b, 1),
        (-a / b, -1),
        (a - a, 0),
        ((a - b) ** 2 - a**2 + 2 * a * b - b**2, 0),
        (x * (sin(x) ** 2 + cos(x) ** 2 - 1), 0),
        (a - b, None),
        (x, None),
        (x * b, None),
        (sqrt(2) - Rational(7, 5), 1),
        (sin(pi / 5) - 1, -1),
        (sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3), 0),
    ],
    ids=str,
)
def test_letters_alone_decide_what_they_can(expr: Expr, sign: int | None) -> None:
    assert sign_known(expr) == sign


@pytest.mark.parametrize(("number", "sign"), [(2, 1), (1, 0), (Rational(1, 2), -1), (1 + Rational(1, 10**25), 1)])
def test_numbers_decide_where_letters_do_not(number: Expr, sign: int) -> None:
    with recorded(Run(numbers={a: number, b: 1})):
        assert sign_known(a - b) == sign
        assert sign_known((a - b) * (a - b) * b) == abs(sign)


def test_a_letter_without_a_number_leaves_it_open() -> None:
    with recorded(Run(numbers={a: 2})):
        assert sign_known(a - b) is None
        assert with_numbers(a * b) == 2 * b
    assert with_numbers(a * b) == a * b


def test_a_number_that_is_not_real_has_no_sign() -> None:
    with recorded(Run(numbers={a: 2})):
        assert sign_known(sqrt(1 - a)) is None
