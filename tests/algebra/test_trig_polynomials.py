"""The form that only equal expressions share: decided as the relations decide, whatever was asked before."""

from __future__ import annotations

import pytest
from sympy import Expr, I, Rational, S, cbrt, cos, diff, exp, pi, sin, sqrt, symbols, tan

from derive.algebra.normal_form import _vanishes_by_relations, is_identity, vanishes
from derive.algebra.sparse_polynomials import HIGHEST
from derive.algebra.trig_polynomials import Outside, TrigRing, are_equal, is_zero, monomial_ratio
from tests.algebra.test_corpus import PROVED, slips_of_the_corpus

a, b, m = symbols("a b m", positive=True)
x, y, z, t = symbols("x y z t", real=True)
SMALL = Rational(1, 10**9)

EQUAL = [
    (sin(x + y + z), sin(x + y) * cos(z) + cos(x + y) * sin(z)),
    (cos(x / 2) ** 2, (1 + cos(x)) / 2),
    (cos(x / 3) * cos(x / 2), (cos(5 * x / 6) + cos(x / 6)) / 2),
    (sin(x) / cos(x), tan(x)),
    (tan(x + y), (tan(x) + tan(y)) / (1 - tan(x) * tan(y))),
    (1 / sin(x) ** 2 - 1 / tan(x) ** 2, S.One),
    (1 / (a + b) / (a - b), 1 / (a**2 - b**2)),
    (1 / (1 + 1 / (a + b)), (a + b) / (a + b + 1)),
    ((a - b) ** -3 * (a**2 - 2 * a * b + b**2), 1 / (a - b)),
    (1 / (2 * a + 2 * b), Rational(1, 2) / (a + b)),
    (1 / (-a - b), -1 / (a + b)),
    (1 / (I * a), -I / a),
    (1 / (a + I * b), (a - I * b) / (a**2 + b**2)),
    (m * (1 / (sin(x) * y)) ** 2 * sin(x), m / y**2 / sin(x)),
    (sin(a * t + b * t), sin((a + b) * t)),
    (x / y + y / x, (x**2 + y**2) / (x * y)),
    (cos(12 * x), 2 * cos(6 * x) ** 2 - 1),
    ((a + pi) ** 2, a**2 + 2 * pi * a + pi**2),
    (cos(pi / 9) + cos(5 * pi / 9), -cos(7 * pi / 9)),
    (x * cos(pi / 7) - x * cos(2 * pi / 7), x / 2 - x * cos(3 * pi / 7)),
    (sin(pi / 18) * sin(5 * pi / 18) * sin(7 * pi / 18), Rational(1, 8)),
    (cos(x + pi / 9), cos(x) * cos(pi / 9) - sin(x) * sin(pi / 9)),
    ((cos(pi / 7) + I * sin(pi / 7)) ** 7, -S.One),
    (8 * cos(pi / 9) ** 3 / a, (6 * cos(pi / 9) + 1) / a),
    (cos(a * t * cos(x)) ** 2, 1 - sin(t * a * cos(x)) ** 2),
    (sin((a + b * cos(x)) * t), sin(a * t) * cos(b * t * cos(x)) + cos(a * t) * sin(b * t * cos(x))),
]
INSIDE = [pair for pair in PROVED if all(isinstance(side, Expr) for side in pair)]


def decided(left: Expr, right: Expr) -> bool | None:
    try:
        return are_equal(left, right)
    except Outside:
        return None


@pytest.mark.parametrize(("left", "right"), EQUAL, ids=str)
def test_equal_expressions_have_one_form(left: Expr, right: Expr) -> None:
    assert are_equal(left, right)
    assert are_equal(right, left)
    assert is_zero(left - right)


@pytest.mark.parametrize(("left", "right"), EQUAL, ids=str)
def test_a_small_difference_is_a_difference(left: Expr, right: Expr) -> None:
    for other in (right + SMALL, right * (1 + SMALL * a), right + SMALL * sin(x), -right):
        assert not are_equal(left, other)
        assert not vanishes(left - other)


def test_most_of_the_corpus_is_decided_here_and_as_by_the_relations() -> None:
    verdicts = [decided(*pair) for pair in INSIDE]
    assert False not in verdicts
    assert verdicts.count(True) > 35
    for (left, right), verdict in zip(INSIDE, verdicts, strict=True):
        assert verdict is None or _vanishes_by_relations(left - right)


def test_no_slip_of_the_corpus_is_taken_for_equal() -> None:
    verdicts = [decided(left, slipped) for _, left, slipped in slips_of_the_corpus()]
    assert True not in verdicts
    assert verdicts.count(False) > 80


def test_the_order_of_the_questions_does_not_matter() -> None:
    questions = [
        (sin(x) * cos(x), sin(2 * x) / 2),
        (cos(x / 2) ** 2, (1 + cos(x)) / 2),
        (cos(x), 1 - 2 * sin(x / 2) ** 2),
    ]
    for order in (questions, questions[::-1]):
        assert all(are_equal(*pair) for pair in order)
        assert not any(are_equal(left, right + cos(x / 4)) for left, right in order)


def test_what_was_asked_before_does_not_count() -> None:
    for n in (2, 3, 5, 7, 11):
        assert are_equal(sin(x / n) * cos(x / n), sin(2 * x / n) / 2)
        assert are_equal(cos(HIGHEST * x), 2 * cos(HIGHEST * x / 2) ** 2 - 1)
    for _ in range(2):
        assert decided(cos(x / 2) * cos(x / 64) * sin(x / 63), S.Zero) is None


@pytest.mark.parametrize(
    "value",
    [
        sqrt(x),
        abs(x),
        sin(x + 1),
        cos(x + pi / 67),
        1 / (a + cos(pi / 9)),
        1 / (cos(pi / 9) + cos(5 * pi / 9) + cos(7 * pi / 9)),
        sin(sqrt(x)),
        sin(x / (a + b)),
        sin(sin(2 * x)),
        sin(t * sin(x + y)),
        sin(exp(x)),
        cos((HIGHEST + 1) * x),
        1 / (sin(x) ** 2 + cos(x) ** 2 - 1),
        (x - y) / (x * y - y * x),
        (a + b + x + y + z) ** 40,
        sin((a + b + x + y) ** 20),
        x + Rational(1, 2) * 1.5,
    ],
    ids=str,
)
def test_what_is_not_for_this_module_is_left_to_others(value: Expr) -> None:
    for _ in range(2):  # the second time it is known
        with pytest.raises(Outside):
            is_zero(value)
    assert not is_identity(value, value + 1)


R = sqrt(x**2 + y**2)
S_1 = sqrt(a**2 + 2 * b**2 - 2 * b**2 * cos(x) - 2 * a * b * sin(x))
S_2 = sqrt((a - b * sin(x)) ** 2 + (b - b * cos(x)) ** 2)
ROOTS = [
    (R**2, x**2 + y**2),
    (1 / R, R / (x**2 + y**2)),
    (x / R**3, x * R / (x**2 + y**2) ** 2),
    ((1 + R) * (1 - R), 1 - x**2 - y**2),
    (S_1, S_2),
    (a * (S_1 - a) * sin(x) / S_1, a * sin(x) - a**2 * sin(x) / S_2),
    (R * S_1 / (R * S_2), S.One),
    (sqrt(1 + 1 / x**2) ** 3, sqrt(1 + 1 / x**2) * (x**2 + 1) / x**2),
    (sqrt(2) * sqrt(x + 1) * (sqrt(2) - 1), 2 * sqrt(x + 1) - sqrt(2) * sqrt(x + 1)),
    (R**-5 * (x**2 + y**2), R**-3),
]


@pytest.mark.parametrize(("left", "right"), ROOTS, ids=str)
def test_a_square_root_is_known_by_its_square(left: Expr, right: Expr) -> None:
    assert are_equal(left, right)
    for other in (right + SMALL, right * (1 + SMALL * a), right + SMALL * R, -right, right / S_1):
        assert not decided(left, other)
        assert not vanishes(left - other)


@pytest.mark.parametrize(
    "value",
    [
        sqrt((x + y) ** 2) - x - y,
        sqrt(x**2 + 2 * x * y + y**2) + x + y,
        sqrt(sqrt(x + 1) + 1) - x,
        1 / sqrt(sin(x) ** 2 + cos(x) ** 2 - 1),
        1 / (R - sqrt(x**2 + y**2 + sin(x) ** 2 + cos(x) ** 2 - 1)) - 2 / (R - x),
    ],
    ids=str,
)
def test_of_roots_that_depend_on_one_another_and_of_what_may_be_nothing_this_module_says_nothing(value: Expr) -> None:
    assert decided(value, S.One) is None


def test_a_root_of_one_is_of_no_lower_order() -> None:
    turn = cos(pi / 9) + I * sin(pi / 9)
    assert not any(are_equal(turn**n, S.One) for n in range(1, 18))
    assert are_equal(turn**18, S.One)
    assert not are_equal(turn**9, S.One)
    assert not are_equal(cos(pi / 9), cos(2 * pi / 9))
    assert not are_equal(I * sin(pi / 7), sin(pi / 7))


def test_sums_of_parts_of_pi_that_vanish_are_not_divided_by() -> None:
    nothing = cos(pi / 9) + cos(5 * pi / 9) + cos(7 * pi / 9)
    assert not vanishes(x / nothing - y / nothing)
    assert not is_identity(x / nothing, y / nothing)


def test_a_quotient_of_nothing_by_nothing_is_not_zero() -> None:
    nothing = sin(x) ** 2 + cos(x) ** 2 - 1
    assert not vanishes(nothing / nothing**2)
    assert not is_identity((a - a * cos(x) ** 2 - a * sin(x) ** 2) / nothing, S.Zero)


def test_a_derivative_of_many_angles_is_decided_though_it_is_long() -> None:
    angles = symbols("theta_1:9", real=True)
    total = sum(m * cos(p - q) for i, p in enumerate(angles) for q in angles[:i])
    for q in angles:
        apart = sum(m * (cos(p) * sin(q) - sin(p) * cos(q)) for p in angles if p != q)
        assert are_equal(diff(total, q), -apart)
        assert not are_equal(diff(total, q), apart)


def test_a_divisor_keeps_its_letter_in_one_ring() -> None:
    ring = TrigRing({})
    ring.form(1 / (a + b))
    count = len(ring.letters)
    ring.form(3 / (2 * a + 2 * b) ** 2)
    assert len(ring.letters) == count


@pytest.mark.parametrize(
    ("left", "right", "ratio"),
    [
        (2 * a * x + 2 * a * sin(x) ** 2, x + 1 - cos(x) ** 2, 2 * a),
        (x / (a * m) - sqrt(x + y) / m**2, 3 * m * x / a - 3 * sqrt(x + y), 1 / (3 * m**2)),
        (sin(2 * x) - x, 2 * x - 4 * sin(x) * cos(x), -Rational(1, 2)),
        (x - y, x + y, None),
        (x**2 + x, a * x**2 + b * x, None),
        (sin(x) * x, x, None),
        (I * x + I, x + 1, None),
        (x - x * (sin(y) ** 2 + cos(y) ** 2), x, None),
        (cbrt(x + y), 2 * cbrt(x + y), None),
    ],
    ids=str,
)
def test_the_ratio_of_two_sums_is_seen_where_it_is_a_product_of_letters(
    left: Expr, right: Expr, ratio: Expr | None
) -> None:
    assert monomial_ratio(left, right) == ratio
    assert monomial_ratio(right, left) == (None if ratio is None else 1 / ratio)
