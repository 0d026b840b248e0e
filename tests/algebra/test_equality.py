"""What is proved is so, what differs is refuted, and a sample is never called a proof."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import (
    Abs,
    Expr,
    Function,
    Heaviside,
    I,
    Integer,
    Integral,
    Matrix,
    MatrixSymbol,
    Max,
    Piecewise,
    Rational,
    Symbol,
    acos,
    asin,
    cancel,
    cbrt,
    conjugate,
    cos,
    cosh,
    diff,
    exp,
    expand,
    eye,
    factor,
    log,
    nan,
    oo,
    pi,
    re,
    sign,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    together,
    zoo,
)

from derive.algebra.equality import Grade, Verdict, equal
from derive.algebra.expressions import PLUS_MINUS, Cross, Dot, Relation, column, rate
from derive.algebra.normal_form import vanishes
from derive.algebra.ranges import Range, within

x, y, t = symbols("x y t", real=True)
a, b, c = symbols("a b c", positive=True)
n, z = Symbol("n", integer=True), Symbol("z")
q, A = Function("q")(t), Function("A")(t)

IDENTITIES = [
    # polynomials and fractions
    ((x + y) ** 3, x**3 + 3 * x**2 * y + 3 * x * y**2 + y**3),
    ((x**2 - 1) / (x - 1), x + 1),
    (1 / (a * (a + b)) + 1 / (b * (a + b)), 1 / (a * b)),
    # multiple and half angles
    (sin(x) ** 2 + cos(x) ** 2, Integer(1)),
    (sin(3 * x), 3 * sin(x) - 4 * sin(x) ** 3),
    (cos(4 * x), 8 * cos(x) ** 4 - 8 * cos(x) ** 2 + 1),
    (sin(x / 2) ** 2, (1 - cos(x)) / 2),
    (sin(x / 2) * cos(x / 2), sin(x) / 2),
    (cos(x / 3) ** 3, (3 * cos(x / 3) + cos(x)) / 4),
    (sin(x + y) * sin(x - y), sin(x) ** 2 - sin(y) ** 2),
    (sin(x + pi / 3), sin(x) / 2 + sqrt(3) * cos(x) / 2),
    (tan(x) * cos(x), sin(x)),
    (1 + tan(x) ** 2, 1 / cos(x) ** 2),
    (sin(x) ** 2 / (1 - cos(x)), 1 + cos(x)),
    # roots
    (sqrt(6) * x, sqrt(2) * sqrt(3) * x),
    (sqrt(2) / (sqrt(2) + sqrt(3)), sqrt(6) - 2),
    (1 / (sqrt(3) - sqrt(2)), sqrt(3) + sqrt(2)),
    (sqrt(a**2 + 2 * a * b + b**2), a + b),
    (sqrt(a**2 * b + a**3), a * sqrt(a + b)),
    (sqrt(a * b) / sqrt(a), sqrt(b)),
    (sqrt(a / (a + b)), sqrt(a * (a + b)) / (a + b)),
    (cbrt(a) * cbrt(a**2), a),
    ((sqrt(a + b) + sqrt(a)) * (sqrt(a + b) - sqrt(a)), b),
    (sqrt(1 + sqrt(a)) ** 2 - 1, sqrt(a)),
    (sqrt(1 + sqrt(2)) * sqrt(1 + sqrt(2)), 1 + sqrt(2)),
    (sqrt(x**2 + 1) ** 3, (x**2 + 1) * sqrt(x**2 + 1)),
    (sqrt(5 + 2 * sqrt(6)), sqrt(2) + sqrt(3)),
    (x / sqrt(3 - 2 * sqrt(2)), x * (sqrt(2) + 1)),
    (sinh(x) ** 2 + 1, cosh(x) ** 2),
    (exp(x + y), exp(x) * exp(y)),
    (log(a * b), log(a) + log(b)),
    (exp(I * x), cos(x) + I * sin(x)),
    # inverse and unknown functions
    (acos((x**2 - 1) / (3 * (x - 1))), acos((x + 1) / 3)),
    (acos(sqrt(6) / 3), acos(sqrt(2) / sqrt(3))),
    (diff(q**2, t), 2 * q * diff(q, t)),
    ((diff(A, t) + A) ** 2, diff(A, t) ** 2 + 2 * A * diff(A, t) + A**2),
    (diff(A, t, 2) * A + diff(A, t) ** 2, diff(A * diff(A, t), t)),
]

# true, but beyond the exact methods
BEYOND = [
    (2 * acos(sqrt((1 + x) / 2)), acos(x)),
    (acos(a), pi / 2 - asin(a)),
    (sqrt(1 - sin(x) ** 2), Abs(cos(x))),
]

FALSE = [
    (sqrt(x**2), x),
    (sqrt(1 - sin(x) ** 2), cos(x)),
    (sqrt(x**2 - 1), sqrt(x - 1) * sqrt(x + 1)),
    (sin(2 * x), 2 * sin(x)),
    (cos(x / 2) ** 2, (1 - cos(x)) / 2),
    (sin(x) ** 2, 1 + cos(x) ** 2),
    (sqrt(a + b), sqrt(a) + sqrt(b)),
    (sqrt(2) + sqrt(3), sqrt(5)),
    (acos(cos(x)), x),
    (acos(x), acos(x) + Rational(1, 10**9)),
    (asin(a), acos(a)),
    (q, diff(q, t)),
    (2 * diff(A, t), diff(A, t)),
    (diff(q, t, 2), diff(q, t)),
    (q, Function("p")(t)),
    (x * (1 + Rational(1, 10**25)), x),
    (1 + Rational(1, 10**25), Integer(1)),
    (a * sqrt(2) * (1 + Rational(1, 10**30)), a * sqrt(2)),
    (Rational(22, 7), pi),
    (sin(x) - x + x**3 / 6, Integer(0)),
    (Integer(0), x / 10**20),
]


@pytest.mark.parametrize(("left", "right"), IDENTITIES)
def test_an_identity_of_mechanics_is_proved(left: Expr, right: Expr) -> None:
    assert equal(left, right).grade is Grade.PROVED
    assert equal(right, left).grade is Grade.PROVED


@pytest.mark.parametrize(("left", "right"), [*IDENTITIES, *BEYOND])
def test_a_zero_in_disguise_is_no_different_from_zero(left: Expr, right: Expr) -> None:
    assert equal(left - right, Integer(0))
    assert equal(Integer(0), right - left)


@pytest.mark.parametrize(("left", "right"), BEYOND)
def test_what_no_exact_method_decides_is_sampled_and_says_so(left: Expr, right: Expr) -> None:
    verdict = equal(left, right)
    assert verdict.grade is Grade.SAMPLED
    assert "to 50 digits" in verdict.detail


@pytest.mark.parametrize(("left", "right"), FALSE)
def test_what_is_not_equal_is_refuted(left: Expr, right: Expr) -> None:
    for verdict in (equal(left, right), equal(right, left)):
        assert verdict.grade is Grade.REFUTED
        assert not verdict


@pytest.mark.parametrize(("left", "right"), FALSE)
def test_what_is_not_equal_is_never_said_to_vanish(left: Expr, right: Expr) -> None:
    assert not vanishes(left - right)


def test_a_refutation_names_a_point_at_which_the_two_sides_differ() -> None:
    verdict = equal(sin(2 * x) * a, 2 * sin(x) * a)
    point = {symbol: Rational(dict(verdict.point)[str(symbol)]) for symbol in (a, x)}
    left, right = ((expr * a).subs(point).evalf(6) for expr in (sin(2 * x), 2 * sin(x)))
    assert verdict.detail == f"{left} against {right}"
    assert left != right


def test_points_are_the_same_in_every_run() -> None:
    assert equal(sqrt(x**2), x) == equal(sqrt(x**2), x)


def test_a_positive_letter_is_sampled_where_it_is_positive() -> None:
    assert equal(sqrt(a**2 * (1 + x**2)), a * sqrt(1 + x**2)).grade is Grade.PROVED


def test_an_integer_letter_is_sampled_at_integers() -> None:
    assert equal(cos(2 * pi * n), Integer(1))
    assert equal(sin(pi * n) ** 2 + cos(pi * n) ** 2, Integer(1))


def test_points_at_which_a_side_is_undefined_are_passed_over() -> None:
    """sqrt(x - 1)/sqrt(x - 1) and tan(x)/tan(x) have gaps, not differences."""
    assert equal((x**2 - 4) / (x - 2), x + 2).grade is Grade.PROVED


@pytest.mark.parametrize("undefined", [zoo, nan, zoo * x])
def test_what_is_undefined_equals_nothing(undefined: Expr) -> None:
    assert equal(undefined, Integer(1)).grade is Grade.REFUTED
    assert equal(undefined, undefined).grade is Grade.REFUTED


def test_a_side_that_is_undefined_wherever_it_is_tried_is_refused() -> None:
    hole = 1 / (sin(x) ** 2 + cos(x) ** 2 - 1)
    assert not equal(hole, log(x))


def test_matrices_are_compared_entry_by_entry() -> None:
    rotation = Matrix([[cos(x), -sin(x)], [sin(x), cos(x)]])
    assert equal(rotation * rotation.T, eye(2)).grade is Grade.PROVED
    assert equal(rotation * rotation, rotation).grade is Grade.REFUTED


def test_a_matrix_is_as_sure_as_its_least_sure_entry() -> None:
    sure, unsure = IDENTITIES[3], BEYOND[1]
    for pairs in ([sure, unsure], [unsure, sure], [unsure, (x, x)]):
        left, right = (Matrix([pair[side] for pair in pairs]) for side in (0, 1))
        assert equal(left, right).grade is Grade.SAMPLED
    assert equal(Matrix([sure[0], x]), Matrix([sure[1], x])).grade is Grade.PROVED


def test_matrices_of_other_shapes_differ() -> None:
    assert equal(eye(2), eye(3)).grade is Grade.REFUTED
    assert equal(Matrix([1, 2, 3]), Matrix([[1, 2, 3]])).grade is Grade.REFUTED
    assert equal(Matrix([x]), x).grade is Grade.REFUTED


def test_nodes_are_carried_out_before_they_are_compared() -> None:
    u, v = column(x, y, 1), column(y, -x, 2)
    assert equal(Dot(u, v), Integer(2)).grade is Grade.PROVED
    assert equal(Dot(u, Cross(u, v)), Integer(0)).grade is Grade.PROVED


def test_a_refuted_verdict_is_false_and_all_others_are_true() -> None:
    assert [bool(Verdict(grade)) for grade in Grade] == [grade is not Grade.REFUTED for grade in Grade]


@pytest.mark.parametrize("n_links", [2, 3])
def test_product_to_sum_of_many_angles_is_proved(n_links: int) -> None:
    angles = symbols(f"q_0:{n_links}", real=True)
    product, summed = Integer(1), Integer(0)
    for angle in angles:
        product *= cos(angle)
    signs: list[tuple[int, ...]] = [(1,)]
    for _ in angles[1:]:
        signs = [(*s, k) for s in signs for k in (1, -1)]
    for s in signs:
        summed += cos(sum(k * angle for k, angle in zip(s, angles, strict=True)))
    assert equal(product, summed / 2 ** (n_links - 1)).grade is Grade.PROVED
    assert not equal(product, summed / 2 ** (n_links - 1) + Rational(1, 10**6) * sin(angles[0]))


# --- relations ---


def relation(left: Any, mark: str, right: Any = 0) -> Relation:
    return Relation(left, mark, right)


EQUIVALENT = [
    (relation(2 * x + 2 * y, "="), relation(x, "=", -y)),
    (relation(x, "=", y), relation(y, "=", x)),
    (relation(a * x, "="), relation(x, "=")),
    (relation(a * x, "!="), relation(x, "!=")),
    (relation(a * sin(x) ** 2 + a * cos(x) ** 2, "=", b), relation(a, "=", b)),
    # an inequality keeps its mark under a positive factor and is turned by a negative one
    (relation(a * x, ">", a * b), relation(x, ">", b)),
    (relation(-x, ">", y), relation(x, "<", -y)),
    (relation(x, ">=", y), relation(y, "<=", x)),
    (relation(a / (b + c), ">", 1), relation(a, ">", b + c)),
    (relation(1 / a, ">", 1 / b), relation(a, "<", b)),
    (relation((x**2 + 1) * y, ">"), relation(y, ">")),
    # squares, where neither side is negative
    (relation(a**2, ">", b**2), relation(a, ">", b)),
    (relation(a, "<=", sqrt(b)), relation(a**2, "<=", b)),
    (relation(a**2, "=", b * c), relation(a, "=", sqrt(b * c))),
    # without letters
    (relation(Integer(1), ">"), relation(Integer(2), ">")),
]

NOT_EQUIVALENT = [
    (relation(x, "=", a), relation(x, "=", b)),
    (relation(x * y, "="), relation(x, "=")),
    (relation(x**2, "="), relation(x, "=")),
    (relation(x**2, "=", y**2), relation(x, "=", y)),
    (relation(sin(x) * y, "="), relation(y, "=")),
    (relation(x, "=", x), relation(x, "=", y)),
    (relation(-x, ">"), relation(x, ">")),
    (relation(y * x, ">"), relation(x, ">")),
    (relation(x**2 * y, ">"), relation(y, ">")),
    (relation(x**2, ">", y**2), relation(x, ">", y)),
    (relation(-a, ">", -b), relation(a, ">", b)),
    (relation(1 / a, ">", 1 / b), relation(a, ">", b)),
    # other marks
    (relation(x, ">"), relation(x, ">=")),
    (relation(x, "="), relation(x, ">=")),
    (relation(x, "="), relation(x, "!=")),
    (relation(x, ">", x), relation(x, ">=", x)),
    (relation(x, "=", x), relation(x, "!=", x)),
    (relation(Integer(1), ">"), relation(Integer(-1), ">")),
]


@pytest.mark.parametrize(("left", "right"), EQUIVALENT)
def test_relations_that_say_the_same_are_proved_equal(left: Relation, right: Relation) -> None:
    assert equal(left, right).grade is Grade.PROVED
    assert equal(right, left).grade is Grade.PROVED


@pytest.mark.parametrize(("left", "right"), NOT_EQUIVALENT)
def test_relations_that_say_different_things_are_refuted(left: Relation, right: Relation) -> None:
    assert equal(left, right).grade is Grade.REFUTED
    assert equal(right, left).grade is Grade.REFUTED


@pytest.mark.parametrize(("left", "right"), [(relation(x, "="), x), (x, relation(x, "=")), (relation(x, ">"), eye(2))])
def test_a_relation_is_no_value(left: Any, right: Any) -> None:
    assert equal(left, right).detail == "a relation against a value"
    assert not equal(left, right)


def test_a_factor_that_may_vanish_is_divided_out_where_it_is_known_not_to() -> None:
    left, right = relation(x * y, "="), relation(y, "=")
    assert not equal(left, right)
    for known in (x, -x):
        assert equal(left, right, [known]).grade is Grade.PROVED
    assert not equal(left, right, [y])
    assert equal(relation(y / x**2, "="), right, [x])
    assert equal(relation((x - y) * a, "="), relation(a, "="), [y - x])


def test_in_an_inequality_the_factor_that_is_known_is_positive() -> None:
    left = relation(x * y, ">")
    assert equal(left, relation(y, ">"), [x])
    assert not equal(left, relation(y, "<"), [x])
    assert equal(left, relation(y, "<"), [-x])
    assert not equal(left, relation(y, ">"), [-x])
    assert equal(relation(x**2 * y, ">"), relation(y, ">"), [-x])


def test_what_is_known_of_one_factor_says_nothing_of_another() -> None:
    assert not equal(relation(x * y * (x + 1), "="), relation(y, "="), [x])
    assert equal(relation(x * y * (x + 1), "="), relation(y, "="), [x, x + 1])


# --- either sign ---


def test_plus_or_minus_is_one_of_two_numbers_of_square_one() -> None:
    assert equal(PLUS_MINUS**2, Integer(1)).grade is Grade.PROVED
    assert equal(1 / PLUS_MINUS, PLUS_MINUS).grade is Grade.PROVED
    assert equal((a + PLUS_MINUS * b) * (a - PLUS_MINUS * b), a**2 - b**2).grade is Grade.PROVED
    assert equal((x + PLUS_MINUS * sqrt(a)) ** 2, x**2 + 2 * PLUS_MINUS * x * sqrt(a) + a).grade is Grade.PROVED


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (PLUS_MINUS, Integer(1)),
        (PLUS_MINUS, Integer(-1)),
        (PLUS_MINUS * x, -PLUS_MINUS * x),
        ((a + PLUS_MINUS * b) ** 2, (a + b) ** 2),
    ],
)
def test_plus_or_minus_is_neither_of_the_two(left: Expr, right: Expr) -> None:
    assert equal(left, right).grade is Grade.REFUTED


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(-4, 4), st.sampled_from(["=", ">", "<=", "!="]))
def test_a_relation_times_a_number_says_the_same_unless_the_number_is_zero(k: int, m: int, n: int, mark: str) -> None:
    assume(m != 0)
    turned = {"=": "=", "!=": "!=", ">": "<", "<=": ">="}[mark]
    first = relation(m * x + n * a, mark, y)
    other = relation(k * (m * x + n * a), mark if k > 0 else turned, k * y)
    assert bool(equal(first, other)) == (k != 0)


# --- properties ---

coefficients = st.integers(-5, 5)
bounded = settings(max_examples=30, deadline=None, derandomize=True)


@st.composite
def rational_functions(draw: Any) -> Expr:
    """A quotient of polynomials in x, y, a, and sin x, cos x, sqrt(a + b)."""
    letters = [x, y, a, sin(x), cos(x), sqrt(a + b)]
    terms = st.tuples(coefficients, st.sampled_from(letters), st.sampled_from(letters))
    above = sum((k * u * v for k, u, v in draw(st.lists(terms, min_size=1, max_size=4))), Integer(draw(coefficients)))
    below = sum((k * u for k, u, _ in draw(st.lists(terms, max_size=2))), Integer(draw(st.integers(1, 9))))
    assume(above != 0 and not vanishes(above) and below != 0 and not vanishes(below))
    return above / below


@bounded
@given(rational_functions(), st.sampled_from([expand, factor, together, cancel]))
def test_every_form_of_a_rational_function_is_proved_equal(f: Expr, form: Any) -> None:
    assert equal(form(f), f).grade is Grade.PROVED


@bounded
@given(rational_functions(), st.sampled_from([expand, factor, together]), st.sampled_from([1, -1, Rational(1, 10**6)]))
def test_a_changed_coefficient_is_refuted(f: Expr, form: Any, change: Any) -> None:
    assert equal(form(f * (1 + change)), f).grade is Grade.REFUTED
    assert equal(form(f) + change * x * a, f).grade is Grade.REFUTED


@bounded
@given(rational_functions(), rational_functions())
def test_what_is_proved_agrees_in_floating_point(f: Expr, g: Expr) -> None:
    point = {x: 0.8125, y: -1.375, a: 0.4375, b: 1.28125}
    values = [expr.subs(point).evalf(30) for expr in (f, g)]
    assume(all(value.is_finite for value in values))
    if abs(values[0] - values[1]) > 1e-9 * (1 + abs(values[0])):
        assert not vanishes(f - g)
        assert not equal(f, g)


@bounded
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(1, 4))
def test_sums_of_multiple_angles_are_expanded(k: int, m: int, d: int) -> None:
    left = sin(Rational(k, d) * x + m * y)
    right = sin(Rational(k, d) * x) * cos(m * y) + cos(Rational(k, d) * x) * sin(m * y)
    assert equal(left, right).grade is Grade.PROVED


@bounded
@given(st.integers(2, 60), st.integers(2, 60))
def test_roots_of_numbers_multiply(m: int, k: int) -> None:
    assert equal(x * sqrt(m) * sqrt(k), x * sqrt(m * k)).grade is Grade.PROVED
    assert equal(x * sqrt(Rational(m, k)), x * sqrt(m * k) / k).grade is Grade.PROVED


def test_equations_that_say_different_things_are_told_apart_by_a_point() -> None:
    free, pushed = Relation(3 * rate(x, 2), "=", 0), Relation(3 * rate(x, 2), "=", y)
    verdict = equal(free, pushed)
    assert verdict.grade is Grade.REFUTED
    assert verdict.point
    assert "where one equation is true, the sides of the other differ by" in verdict.detail


def test_for_such_a_point_no_equation_is_differentiated_by_a_letter_that_is_in_a_square(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """For a long equation, the derivatives by all letters take longer than everything else."""
    by, diff = [], Expr.diff
    monkeypatch.setattr(Expr, "diff", lambda self, *given: (by.append(given), diff(self, *given))[1])
    assert equal(Relation(y, "=", 0), Relation(y, "=", rate(x) ** 2)).point
    assert (y,) in by and (rate(x),) not in by


# --- what is divided by, how points are drawn, and whatever comes ---

NOTHING = sin(x) ** 2 + cos(x) ** 2 - 1
HOLES = [
    (x * NOTHING / (cos(2 * x) - cos(x) ** 2 + sin(x) ** 2), Integer(5)),
    (NOTHING / (sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3)), x),
    (a / acos(1 - NOTHING), b / acos(sin(x) ** 2 + cos(x) ** 2)),
    ((x - y) * NOTHING / (x * (x + 1) - x**2 - x), NOTHING),
    (NOTHING / sqrt(sin(2 * x) - 2 * sin(x) * cos(x)), Integer(0)),
    (1 / Abs(cos(x) ** 2 - 1 + sin(x) ** 2), 1 / Abs(tan(x) * cos(x) - sin(x))),
]


@pytest.mark.parametrize(("left", "right"), HOLES)
def test_a_quotient_that_is_nothing_by_nothing_everywhere_equals_nothing(left: Expr, right: Expr) -> None:
    assert not vanishes(left - right)
    assert equal(left, right).grade is Grade.REFUTED
    assert equal(right, left).grade is Grade.REFUTED


@pytest.mark.parametrize(
    ("left", "right", "grade"),
    [
        (exp(2 * x) - exp(x) * (exp(x) - 1), exp(x), Grade.PROVED),
        ((1 + x) ** 40 - x * (1 + x) ** 39, (1 + x) ** 39, Grade.PROVED),
        (exp(x) * (exp(-x) + 1) - 1, exp(x), Grade.PROVED),
        (exp(x) * (exp(-x) + 1) - 1, 2 * exp(x), Grade.REFUTED),
        (sinh(x) - exp(x) / 2, -exp(-x) / 2, Grade.PROVED),
        (sinh(x) - exp(x) / 2, exp(-x) / 2, Grade.REFUTED),
        (acos(1 - a**2 * NOTHING), Integer(0), Grade.SAMPLED),
    ],
)
def test_what_cancels_at_a_large_or_small_point_is_no_difference(left: Expr, right: Expr, grade: Grade) -> None:
    assert equal(left, right).grade is grade


def piece(value: Any, condition: Any) -> Expr:
    return Piecewise((value, condition), (0, True))


ODD: list[tuple[Any, Any, Grade]] = [
    (piece(x, x > 0), piece(x, x >= 0), Grade.SAMPLED),
    (piece(x, x > 0), piece(x, x > 1), Grade.REFUTED),
    (piece(x, x > 0) - piece(y, y > 0), piece(x, x > 0) - piece(y, y >= 0), Grade.SAMPLED),
    (piece(x, x > 0), piece(y, y > 0), Grade.REFUTED),
    (Max(x, 0), (x + Abs(x)) / 2, Grade.SAMPLED),
    (Heaviside(x), (1 + sign(x)) / 2, Grade.SAMPLED),
    (sign(x), Integer(1), Grade.REFUTED),
    (oo, oo, Grade.REFUTED),
    (oo, x, Grade.REFUTED),
    (log(Integer(0)), x, Grade.REFUTED),
    (x**100000, x**100000 + 1, Grade.REFUTED),
    ((x + 1) ** 100000, (x + 1) ** 100000 + x, Grade.REFUTED),
    ((a + b + x + y) ** 300, (a + b + x - y) ** 300, Grade.REFUTED),
    (x ** Integer(10**12), x, Grade.REFUTED),
    (2 ** (10**9 * x), x, Grade.REFUTED),
    (cos(10**6 * x) + cos(x), 2 * cos((10**6 + 1) * x / 2) * cos((10**6 - 1) * x / 2), Grade.SAMPLED),
    (sin(x) ** 1000, (1 - cos(x) ** 2) ** 500, Grade.SAMPLED),
    (exp(exp(exp(50 * x))), x, Grade.REFUTED),
    (exp(I * x) * exp(-I * x + I * y), exp(I * y), Grade.PROVED),
    (Abs(z) ** 2, z**2, Grade.REFUTED),
    (re(z), z, Grade.REFUTED),
    (z * conjugate(z), Abs(z) ** 2, Grade.SAMPLED),
    (Integer(10) ** 5000 * x, Integer(10) ** 5000 * x + zoo, Grade.REFUTED),
    (sqrt(Integer(10**60 + 7) * Integer(10**57 + 3)), Integer(10) ** 58, Grade.REFUTED),
    (Matrix(0, 0, []), Matrix(0, 0, []), Grade.PROVED),
    (Matrix(0, 3, []), Matrix(3, 0, []), Grade.REFUTED),
    (Matrix([x, nan]), Matrix([x, nan]), Grade.REFUTED),
    (MatrixSymbol("v", 3, 1), MatrixSymbol("w", 3, 1), Grade.REFUTED),
    (relation(x, "="), Matrix([x]), Grade.REFUTED),
    (relation(piece(x, x > 0), "="), relation(piece(y, y > 0), "="), Grade.REFUTED),
    (x > 0, x >= 0, Grade.REFUTED),
    (True, x, Grade.REFUTED),
    (None, x, Grade.REFUTED),
    (1.5, Rational(3, 2), Grade.REFUTED),
    (Integral(1 / sqrt(1 - x**4), (x, 0, y)), y, Grade.REFUTED),
]


@pytest.mark.parametrize(("left", "right", "grade"), ODD)
def test_whatever_comes_is_decided(left: Any, right: Any, grade: Grade) -> None:
    assert equal(left, right).grade is grade
    assert equal(right, left).grade is grade


@settings(max_examples=25, deadline=None, derandomize=True)
@given(st.randoms(use_true_random=False))
def test_no_pair_of_expressions_makes_it_fail(source: Any) -> None:
    unary = [sin, cos, tan, exp, log, sqrt, acos, Abs, sign, Heaviside, cbrt, Function("f")]
    unary += [lambda e: e**-2, lambda e: e**7, lambda e: piece(e, x > 0)]
    binary = [lambda u, v: u + v, lambda u, v: u * v, lambda u, v: u / v, Max]
    leaves = [x, y, a, z, q, diff(q, t), Integer(0), Integer(-1), pi, I, sqrt(2), nan, zoo, oo, PLUS_MINUS]

    def grown(depth: int) -> Expr:
        try:
            if depth == 0:
                return source.choice(leaves)
            if source.random() < 0.5:
                return source.choice(unary)(grown(depth - 1))
            return source.choice(binary)(grown(depth - 1), grown(depth - 1))
        except (ValueError, TypeError):  # SymPy's own, such as Max of what is not real
            return x

    left, right = grown(source.randint(1, 3)), grown(source.randint(1, 3))
    for one, other in ((left, right), (left, left + NOTHING), (relation(left, ">", x), relation(right, ">", x))):
        assert isinstance(equal(one, other), Verdict)


def test_where_neither_side_is_real_is_no_counterexample() -> None:
    g, k, l, m = symbols("g k l m", positive=True)
    assert equal(sqrt(g / l - k / m), sqrt(g * m - k * l) / sqrt(l * m))
    assert not equal(sqrt(g / l - k / m), sqrt(g * m + k * l) / sqrt(l * m))


def test_what_is_imaginary_everywhere_is_compared_there() -> None:
    g, l = symbols("g l", positive=True)
    assert equal(sqrt(-g / l), I * sqrt(g) / sqrt(l))
    assert not equal(sqrt(-g / l), -I * sqrt(g / l))


def test_a_size_is_sampled_on_both_sides_of_its_zero() -> None:
    y, k = symbols("y k", real=True)
    power = symbols("a", positive=True)
    assert equal(y**power / Abs(k + 3), y**power / (k + 3)).grade is Grade.REFUTED


def test_what_has_values_at_hardly_any_point_is_not_sampled() -> None:
    w = symbols("w", negative=True)
    k, p = symbols("k p", real=True)
    assert equal(w**k * Abs(p), w**k * p).grade is Grade.REFUTED


def test_squared_sides_that_are_positive_in_a_range() -> None:
    """b^2 < 4 sin(x) and b < 2 sqrt(sin(x)) are equivalent for 0 < x < pi, but not for every x."""
    squares, roots = Relation(b**2, "<", 4 * sin(x)), Relation(b, "<", 2 * sqrt(sin(x)))
    assert not equal(squares, roots)
    with within({x: Range(Integer(0), pi)}):
        assert equal(squares, roots)
