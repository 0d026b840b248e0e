"""The tidy form of a result changes no value, and is what a person would write."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import Expr, I, Integer, Matrix, Rational, Symbol, acos, cos, pi, sin, sqrt, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.expressions import Dot, column
from derive.algebra.ranges import Range, within
from derive.algebra.tidy import common_factor, factored_matrix, size_and_rest, tidied

x, y = symbols("x y", real=True)
a, b, M, omega = symbols("a b M omega", positive=True)

TIDY = [
    (7 / sqrt(14), sqrt(14) / 2),
    (1 / (sqrt(2) + sqrt(3)), sqrt(3) - sqrt(2)),
    (sqrt(397 * M**2 * a**4 / 14), M * a**2 * sqrt(5558) / 14),
    (sqrt(a**2 * b**3), a * b * sqrt(b)),
    (sqrt(a**2 + 2 * a * b + b**2), a + b),
    (sqrt(4 * a**2 + 4 * b**2), 2 * sqrt(a**2 + b**2)),
    (1 / sqrt(a**2 + b**2), 1 / sqrt(a**2 + b**2)),
    ((x**2 - 1) / (x - 1), x + 1),
    (Rational(13, 24) * x + Rational(10, 24) * y, (13 * x + 10 * y) / 24),
    (M * a**2 / 3 - M * a**2 / 4, M * a**2 / 12),
    (sqrt(x**2 * a), sqrt(a) * abs(x)),
    (sqrt(-x * a**2), a * sqrt(-x)),
    (sqrt(5) - sqrt(20) + sqrt(5), Integer(0)),
    (acos(7 / sqrt(14) / 2), acos(sqrt(14) / 4)),
    (acos((x**2 - 1) / (x - 1) / 9), acos((x + 1) / 9)),
    (Dot(column(1, 2, 3), column(a, a, a)), 6 * a),
    (Integer(3), Integer(3)),
    (pi / 2, pi / 2),
    (x, x),
    ((sin(sqrt(a) * x) ** 2 + cos(sqrt(a) * x) ** 2) * sqrt(a) * y, sqrt(a) * y),
]


@pytest.mark.parametrize(("value", "tidy"), TIDY, ids=lambda value: str(value))
def test_a_result_is_tidied_as_a_person_would(value: Expr, tidy: Expr) -> None:
    assert tidied(value) == tidy


@pytest.mark.parametrize("value", [tidy for _, tidy in TIDY], ids=str)
def test_what_is_tidy_stays_as_it_is(value: Expr) -> None:
    assert tidied(value) == value


def test_a_matrix_is_tidied_entry_by_entry() -> None:
    assert tidied(Matrix([7 / sqrt(14), (x**2 - 1) / (x - 1)])) == Matrix([sqrt(14) / 2, x + 1])


def test_a_zero_among_roots_is_found() -> None:
    assert tidied(sqrt(a**2 + 2 * a * b + b**2) * sqrt(2) - sqrt(2) * a - sqrt(2) * b) == 0


@pytest.mark.parametrize(
    ("entries", "common", "rest"),
    [
        ([13 * M * a**2 / 12, 5 * M * a**2 / 6, 5 * M * a**2 / 12], M * a**2 / 12, [13, 10, 5]),
        (
            [a * omega / sqrt(14), 2 * a * omega / sqrt(14), 3 * a * omega / sqrt(14)],
            sqrt(14) * a * omega / 14,
            [1, 2, 3],
        ),
        ([-a, -2 * a, Integer(0)], -a, [1, 2, 0]),
        ([-a, 2 * a, Integer(0)], a, [-1, 2, 0]),
        ([a * (x + y), b * (x + y)], x + y, [a, b]),
        ([a, b, x], Integer(1), [a, b, x]),
        ([Integer(0), Integer(0)], Integer(1), [0, 0]),
        ([a / 6, a / 4], a / 12, [2, 3]),
    ],
)
def test_the_common_factor_is_drawn_out(entries: list[Expr], common: Expr, rest: list[Any]) -> None:
    assert common_factor(entries) == common
    assert factored_matrix(Matrix(entries)) == (common, Matrix(rest))


def test_the_size_of_a_common_factor_is_never_negative() -> None:
    assert size_and_rest(Matrix([-a, -2 * a])) == (a, Matrix([1, 2]))
    assert size_and_rest(Matrix([-3, -6])) == (3, Matrix([1, 2]))
    assert size_and_rest(Matrix([x * a, x * b])) == (abs(x), Matrix([a, b]))


numbers = st.one_of(
    st.integers(-9, 9).map(Integer),
    st.fractions(min_value=-9, max_value=9, max_denominator=9).map(lambda f: Rational(f.numerator, f.denominator)),
    st.integers(2, 30).map(sqrt),
)
atoms = st.one_of(numbers, st.sampled_from([x, y, a, b, sin(x), cos(y)]))
expressions = st.recursive(
    atoms,
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: p[0] + p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] * p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] / p[1] if p[1] != 0 else p[0]),
        inner.map(lambda e: sqrt(e**2 + a**2)),
        inner.map(lambda e: sqrt(a * e) if e.is_nonnegative else e**2),
    ),
    max_leaves=6,
)
bounded = settings(max_examples=40, deadline=None, derandomize=True)


@bounded
@given(expressions)
def test_tidying_changes_no_value(expr: Expr) -> None:
    assume(expr.is_finite is not False and not expr.has(I))
    assert equal(tidied(expr), expr)


@bounded
@given(expressions)
def test_tidying_twice_changes_no_value_either(expr: Expr) -> None:
    assume(expr.is_finite is not False and not expr.has(I))
    assert equal(tidied(tidied(expr)), expr)


@bounded
@given(st.lists(expressions, min_size=2, max_size=3))
def test_a_common_factor_times_the_rest_is_the_vector(entries: list[Expr]) -> None:
    assume(all(entry.is_finite is not False for entry in entries))
    common, rest = factored_matrix(Matrix(entries))
    assert equal(common * rest, Matrix(entries))
    size, others = size_and_rest(Matrix(entries))
    assert equal(size**2 * others.dot(others), Matrix(entries).dot(Matrix(entries)))


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("other", [1, -1])
def test_two_products_of_sines_and_cosines_are_those_of_one_sum(sign: int, other: int) -> None:
    a, b = symbols("a b", real=True)
    for value in (cos(a) * cos(b), sin(a) * sin(b)), (sin(a) * cos(b), cos(a) * sin(b)):
        found = tidied(sign * value[0] + other * value[1])
        assert equal(found, sign * value[0] + other * value[1])
        assert len(found.atoms(sin, cos)) == 1


FORMS = [
    # sin 22.5 degrees, as the axis of a plate of sides a and 2a about its corner has it (Fowles and Cassiday, 9.1)
    ((8 * sqrt(2) - 11) * sqrt(146 + 103 * sqrt(2)) / 14, sqrt(2 - sqrt(2)) / 2),
    (sqrt(146 + 103 * sqrt(2)) * sqrt(146 - 103 * sqrt(2)) / (7 * sqrt(2)), Integer(1)),
    (sqrt((a + b) ** 2 - 4 * a * b), abs(a - b)),
    (M * (cos(x) ** 2 - 1) / 2, -M * sin(x) ** 2 / 2),
    (
        a**2 - a**2 * cos(x) ** 2 + b * cos(x) ** 2 + M * sin(x) * cos(x),
        a**2 * sin(x) ** 2 + b * cos(x) ** 2 + M * sin(x) * cos(x),
    ),
    (M / (x**2 - a - b), -M / (a + b - x**2)),
    # a number in front that is only the ratio of the coefficients of a common term
    (2 * x * (2 * a + M * b) / (4 * a + b**2), x * (a + M * b / 2) / (a + b**2 / 4)),
    (x * (a - b / 2) / (a + b / 4), 2 * x * (2 * a - b) / (4 * a + b)),  # plain letters keep whole numbers
    (2 * (M + a) * b / (M + 2 * a), 2 * b * (M + a) / (M + 2 * a)),
]


@pytest.mark.parametrize(("value", "form"), FORMS, ids=lambda value: str(value))
def test_a_result_has_the_form_of_a_textbook(value: Expr, form: Expr) -> None:
    assert tidied(value) == form
    assert equal(tidied(value), value)


def test_what_has_one_sign_in_its_range_leaves_the_root_and_cancels() -> None:
    with within({x: Range(Integer(0), pi / 2)}):
        assert tidied(sqrt(a * sin(x) ** 2 * cos(x)) / sin(x) ** 2) == sqrt(a) * sqrt(cos(x)) / sin(x)
    with within({x: Range(-pi / 2, Integer(0))}):
        assert tidied(sqrt(a * sin(x) ** 2 * cos(x)) / sin(x) ** 2) == -sqrt(a) * sqrt(cos(x)) / sin(x)


def test_one_and_the_square_of_a_tangent_is_the_square_of_a_secant() -> None:
    """A mass on a cone: Taylor, problem 13.17; sqrt(3) sin(alpha) is what its oscillations have to its rate."""
    g, z, m = symbols("g z m", positive=True)
    angle, other = symbols("alpha beta", real=True)
    assert tidied(m * (1 + tan(angle) ** 2) / 2) == m / (2 * cos(angle) ** 2)
    assert tidied(3 * g / (z + z * tan(angle) ** 2)) == 3 * g * cos(angle) ** 2 / z
    assert tidied(1 + tan(angle) ** 2 + tan(other)) == 1 + tan(angle) ** 2 + tan(other)
    assert tidied(2 + tan(angle) ** 2).has(tan)
    assert tidied((1 + tan(angle)) ** 2 - 2 * tan(angle)).subs(angle, 0) == 1


@pytest.mark.parametrize(
    ("value", "tidy"),
    [
        (-b * cos(x) / (a * (cos(x) - 1) * (cos(x) + 1)), b * cos(x) / (a * sin(x) ** 2)),
        (y * sin(x) - y / sin(x), -y * cos(x) ** 2 / sin(x)),
        (b * sin(x) * cos(b * x / a) + b * sin(b * x / a) * cos(x), b * sin(x * (a + b) / a)),
    ],
    ids=str,
)
def test_one_minus_a_square_is_the_other_square_and_an_angle_one_fraction(value: Expr, tidy: Expr) -> None:
    assert tidied(value) == tidied(tidy) == tidy


def test_pairs_of_terms_become_a_cosine_of_a_difference_beside_others() -> None:
    u, v = symbols("u v", real=True)
    together = M * cos(u) * cos(v) + M * sin(u) * sin(v) + a * cos(u) * y + b * sin(v) * x
    assert tidied(together).has(cos(u - v)) and equal(tidied(together), together)
    alone = M * cos(u) * cos(v) + a * sin(u) * sin(v) + b * x
    assert not tidied(alone).has(cos(u - v), cos(u + v)) and equal(tidied(alone), alone)


def test_a_difference_from_one_is_kept_together_within_a_longer_sum():
    g, l, v, a = symbols("g l v", positive=True) + (Symbol("a", real=True),)
    found = tidied((v**2 + 2 * g * l * cos(a) - 2 * g * l) / l**2)
    assert str(found) == "(-2*g*l*(1 - cos(a)) + v**2)/l**2"
    assert tidied(found * l**2) == v**2 - 2 * g * l * (1 - cos(a))
    assert tidied(v**2 + 3 * g * l * cos(a) - 2 * g * l) == v**2 + 3 * g * l * cos(a) - 2 * g * l


def test_the_sine_of_a_double_angle_is_written_out_if_that_gives_a_common_factor():
    g, a, w, angle = (*symbols("g a w", positive=True), Symbol("angle", real=True))
    found = tidied((8 * g * cos(angle) - a * w**2 * sin(2 * angle)) / (12 * w**2 * sin(angle)))
    assert str(found) == "(-a*w**2*sin(angle) + 4*g)*cos(angle)/(6*w**2*sin(angle))"
    assert tidied(sin(2 * angle)) == sin(2 * angle)
    assert tidied(2 * sin(x) ** 4 + sin(2 * x) ** 2 + 2 * cos(x) ** 4 - 2) == 0
