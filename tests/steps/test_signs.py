"""Signs that the letters, their ranges, relations between them, or else the numbers behind them decide."""

from __future__ import annotations

import pytest
from sympy import Expr, Rational, cos, pi, sin, sqrt, symbols

from derive.algebra.expressions import Relation
from derive.steps.known_numbers import with_numbers
from derive.steps.record import Run, recorded
from derive.steps.signs import holds, sign_beside_root, sign_for_all, sign_known, sign_where, truth_known

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


@pytest.mark.parametrize(
    ("expr", "sign"),
    [
        (a**2 - 2 * a * b + b**2 + a, 1),
        (a**2 - 2 * a * b + b**2, None),
        (a**2 - 3 * a * b + b**2 + a, None),
        ((a - b) * (a + b) - a**2 + 2 * b**2, 1),
        (1 / x**2, 1),
        (x**2, None),
        (-sqrt(a + b) / x**2, -1),
        (sqrt(a**2 - a * b + b**2 + 1), 1),
    ],
    ids=str,
)
def test_squares_means_and_roots_decide_for_all_letters(expr: Expr, sign: int | None) -> None:
    assert sign_for_all(expr) == sign
    assert sign_known(expr) == sign


def test_numbers_do_not_decide_for_all_letters() -> None:
    with recorded(Run(numbers={a: 2, b: 1})):
        assert (sign_known(a - b), sign_for_all(a - b)) == (1, None)


@pytest.mark.parametrize(
    ("condition", "value", "sign"),
    [
        (Relation(a, ">", b), a - b, 1),
        (Relation(a, ">", b), a**2 - b**2, 1),
        (Relation(a, "<", b), a - b, -1),
        (Relation(a**2, ">", b), b - a**2, -1),
        (Relation(a, ">", 2 * b), a - b, 1),
        (Relation(a, ">", b), a - 2 * b, None),
        (None, a - b, None),
        (Relation(a, ">", -b), a - b, None),
    ],
    ids=str,
)
def test_a_condition_decides_where_it_holds(condition: Relation | None, value: Expr, sign: int | None) -> None:
    assert sign_where(value, condition) == sign


@pytest.mark.parametrize(
    ("mark", "below", "at", "above"),
    [
        (">", False, False, True),
        (">=", False, True, True),
        ("<", True, False, False),
        ("<=", True, True, False),
        ("=", False, True, False),
        ("!=", True, False, True),
    ],
)
def test_a_number_fulfils_a_relation_to_zero(mark: str, below: bool, at: bool, above: bool) -> None:
    assert [holds(n, mark) for n in (Rational(-1, 2), 0, sqrt(2))] == [below, at, above]


def test_the_truth_of_a_relation_is_known_from_the_numbers() -> None:
    assert truth_known(Relation(a, ">", b)) is None
    assert truth_known(None) is True
    with recorded(Run(numbers={a: 2, b: 1})):
        assert truth_known(Relation(a, ">", b)) is True
        assert truth_known(Relation(a, "<=", b)) is False


def test_a_root_does_not_hide_a_sign() -> None:
    assert sign_beside_root(a - sqrt(a**2 + b)) == -1
    assert sign_beside_root((a - b + sqrt((a - b) ** 2 + a * b)) / a) == 1
    assert sign_beside_root(a + b - sqrt(a**2 + b**2)) == 1
    assert sign_beside_root(a / (a - sqrt(a) * sqrt(a + b))) == -1
    assert sign_beside_root(a - sqrt(b)) is None
