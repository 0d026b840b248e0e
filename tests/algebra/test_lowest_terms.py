"""Fractions multiplied out and in lowest terms: as SymPy's `cancel` has them."""

from __future__ import annotations

import pytest
from hypothesis import given
from sympy import Expr, Integer, Mul, Rational, cancel, cos, exp, factor_terms, pi, sin, symbols, together
from sympy.polys.polyerrors import HeuristicGCDFailed
from sympy.polys.rings import PolyElement

from derive.algebra import lowest_terms
from derive.algebra.equality import equal
from derive.algebra.lowest_terms import Outside, factored, in_lowest_terms, is_squarefree, shared_factor, squares_turned
from tests.algebra.test_tidy import bounded, expressions

a, b, c = symbols("a b c", positive=True)
x, y, p, n = symbols("x y p n", real=True)


def in_front(value: Expr) -> Expr:
    numerator, denominator = together(value).as_numer_denom()
    return factor_terms(numerator) / factor_terms(denominator)


@pytest.mark.parametrize(
    "value",
    [
        (x**2 - 1) / (x - 1),
        (a**2 - b**2) / (a + b) ** 2,
        (a + b) ** 2 - a**2,
        a / (a + b) + b / (a + b),
        1 / (a + b) + 1 / (a + 2 * b),
        (sin(p) ** 2 - cos(p) ** 2) / (sin(p) - cos(p)),
        (exp(x) ** 2 + exp(x) * y) / (exp(x) + y) / 6,
        (pi * a + pi * b) / (a**2 + 2 * a * b + b**2),
        -x * (a - b) / 4,
        (2 * a * x + 2 * a * y) / (4 * b * x + 4 * b * y),
        (x + y) * (x - y) - x**2 + y**2,
        Rational(3, 4) * a / b,
        cos(p / (a + b)) * (a + b) / (a**2 + a * b),
    ],
    ids=str,
)
def test_lowest_terms_are_those_of_sympy(value: Expr) -> None:
    assert in_lowest_terms(value) == in_front(cancel(value))


@bounded
@given(expressions)
def test_no_value_changes(value: Expr) -> None:
    try:
        found = in_lowest_terms(value)
    except Outside:
        return
    assert equal(found, value)


@pytest.mark.parametrize("value", [a / (2 - cos(p)), a / (cos(p) - 2), -a / (cos(p) - 2), -a / (2 - cos(p))], ids=str)
def test_a_sum_below_the_line_takes_the_sign(value: Expr) -> None:
    found = in_lowest_terms(value)
    assert equal(found, value)
    assert found in (a / (2 - cos(p)), a / (cos(p) - 2))


def test_a_sum_above_the_line_takes_the_sign_before_one_below_it() -> None:
    one, other = ((x - a) / (y - b), (a - x) / (b - y))
    assert in_lowest_terms(one) == in_lowest_terms(other)
    assert in_lowest_terms(a * (9 * pi**2 - 64) / (9 * pi**2 - 32)) == a * (9 * pi**2 - 64) / (9 * pi**2 - 32)
    assert in_lowest_terms(-a * (x - y)) == a * (y - x)


def test_what_is_too_large_is_left_to_others(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(Outside):
        in_lowest_terms((a + b + c) ** 100)

    def failing(_one: PolyElement, _other: PolyElement) -> None:
        raise HeuristicGCDFailed

    monkeypatch.setattr(PolyElement, "cofactors", failing)
    with pytest.raises(Outside):
        in_lowest_terms((x**2 - Integer(1)) / (x**2 + 3 * x + 2))


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (a * sin(p) ** 2 + a * cos(p) ** 2, [a]),
        (x * cos(p) ** 2 - x + y * sin(p), [-x * sin(p) ** 2 + y * sin(p)]),
        (x / (1 - cos(p) ** 2), [x / sin(p) ** 2]),
        (sin(p) ** 3 * cos(p), [sin(p) * cos(p) * (1 - cos(p) ** 2)]),
        (sin(p) / x + cos(p), []),
    ],
    ids=str,
)
def test_squares_are_written_by_one_another(value: Expr, expected: list[Expr]) -> None:
    found = squares_turned(value)
    assert all(equal(each, value) for each in found)
    assert {in_front(each) for each in expected} <= set(found)
    assert bool(found) == bool(expected)


@bounded
@given(expressions)
def test_turned_squares_change_no_value(value: Expr) -> None:
    try:
        assert all(equal(each, value) for each in squares_turned(value))
    except Outside:
        return


def test_pairs_do_not_depend_on_what_was_asked_before() -> None:
    one = cos(p) ** 2 * sin(x) ** 2 - cos(p) ** 2 - sin(x) ** 2 + 1
    found = squares_turned(one)
    in_lowest_terms(sum(symbols("k_0:400")))  # begins the table anew
    in_lowest_terms(sin(x) + cos(p))
    assert squares_turned(one) == found


@pytest.mark.parametrize(
    ("value", "is_one"),
    [
        (a**2 + b**2, True),
        (a**2 - b**2, True),
        (a**2 + 2 * a * b + b**2, False),
        (a**2 * b - a**2, False),
        (x**2 * sin(p) + sin(p), True),
        (a * (x + 1) ** 2 * (x - 2), False),
    ],
    ids=str,
)
def test_what_is_divided_by_no_square(value: Expr, is_one: bool) -> None:
    assert is_squarefree(value) is is_one


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (x**2 + 2 * x * y + y**2, (x + y) ** 2),
        (a**3 - b**3, (a - b) * (a**2 + a * b + b**2)),
        (-a * x + b * x, x * (b - a)),
        ((a**2 - b**2) / (a + b), a - b),
        (a / 2 + b / 2, Mul(Rational(1, 2), a + b, evaluate=False)),
        (a**n / a**2 * (x + y), a ** (n - 2) * (x + y)),
        (sin(p) ** 2 - cos(p) ** 2, (sin(p) - cos(p)) * (sin(p) + cos(p))),
        (1 / (a**2 - 2 * a * b + b**2), (a - b) ** -2),
        ((a + b + c) ** 100, (a + b + c) ** 100),
    ],
    ids=str,
)
def test_sums_are_factored(value: Expr, expected: Expr) -> None:
    assert factored(value) == expected


@bounded
@given(expressions)
def test_factoring_changes_no_value(value: Expr) -> None:
    assert equal(factored(value), value)


def test_what_divides_all_is_found_with_either_sign() -> None:
    shared = shared_factor([(a**2 - b**2) * x / 2, (b - a) * y / 3, Integer(5) * (a - b) / c])
    assert shared.number == Rational(1, 6)
    assert shared.powers in ({a - b: 1, c: -1}, {b - a: 1, c: -1})
    assert shared_factor([2 * (a + b) * x - 2 * a * x - 2 * b * x]) == (1, {})


SIGNED = [
    (sin(p) ** 2 - cos(p) ** 2) / (x - y),
    (a - b) / (b**2 - a**2) / (x - y) * c,
    -(x**2) + 2 * x * y - y**2,
    (b**3 - a**3) * (x - y),
]


@pytest.mark.parametrize("value", SIGNED, ids=str)
def test_signs_do_not_depend_on_what_was_asked_before(value: Expr, monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for letters in ((a, b, c, x, y, sin(p), cos(p)), (cos(p), sin(p), y, x, c, b, a)):
        monkeypatch.setattr(lowest_terms._Kept, "ring", lowest_terms._Fractions())
        for letter in letters:
            in_lowest_terms(letter)
        found.append((in_lowest_terms(value), factored(value), squares_turned(value)))
    assert found[0] == found[1]


def test_a_common_factor_of_many_letters_is_found_without_the_gcd_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(PolyElement, "cofactors", never)
    masses, lengths = symbols("m_0:12", positive=True), symbols("z_0:12", positive=True)
    M = sum(masses[1:], masses[0])
    moment = sum((m * z for m, z in zip(masses, lengths, strict=True)), Integer(0))
    assert in_lowest_terms((M * moment).expand() / M**2) == moment / M
    assert in_lowest_terms(moment.expand() / M) == moment / M


def test_images_modulo_a_prime_do_not_hide_a_factor() -> None:
    assert in_lowest_terms((x**2 - y**2) / (x**2 + 2 * x * y + y**2)) == (x - y) / (x + y)
    assert in_lowest_terms((2 * x + 4 * y) / (6 * x**2 + 12 * x * y)) == 1 / (3 * x)


@pytest.mark.parametrize("before", [(x, y, a), (a, y, x), (y, a, x)])
def test_letters_are_factored_in_the_order_of_their_degrees_whatever_was_read_before(before: tuple[Expr, ...]) -> None:
    """SymPy may need minutes in a bad order. The order in which letters are first read depends on other problems."""
    ring = lowest_terms._Fractions()
    for letter in before:
        ring.letter(letter)
    terms = ring.form(x**4 + a * x**2 * y**3 + a**2 + y).terms
    assert [ring.name(place) for place in ring._by_degree(terms)] == [a, y, x]
