"""Values under construction: dimensions must fit, nothing is divided by zero, and nothing grows too large."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Integer, Rational, Symbol, cos, exp, sqrt

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import (
    MAX_DIGITS,
    MAX_EXPONENT,
    MAX_SIZE,
    MAX_TEN_POWER,
    MAX_TERMS,
    Arithmetic,
    Declared,
    Term,
    fraction,
    rational,
)
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Complaint, Rejected

TEXT = "length + mass"
LENGTH, MASS = dimension_of_kind("length"), dimension_of_kind("mass")
a, b, M = (Symbol(name, positive=True) for name in "abM")


@pytest.fixture
def reader() -> Arithmetic:
    return Arithmetic(Scalar(TEXT, "", 0, len(TEXT), Source("f.yaml", TEXT)))


def term(expr: object, dimension: Dimension = LENGTH, **more: int) -> Term:
    return Term(Integer(expr) if isinstance(expr, int) else expr, dimension, 0, 6, **more)


def refusal(of: object, *arguments: object) -> Complaint:
    assert callable(of)
    with pytest.raises(Rejected) as caught:
        of(*arguments)
    (complaint,) = caught.value.complaints
    return complaint


def test_terms_of_one_dimension_are_added_and_others_refused_at_the_second(reader: Arithmetic) -> None:
    total = reader.added(term(a), term(b), "-")
    assert (total.expr, total.dimension, total.terms) == (a - b, LENGTH, 2)
    mass = Term(M, MASS, 9, 13, kind="mass")
    complaint = refusal(reader.added, term(a), mass, "+")
    assert complaint.message == "`length` is a length, but `mass` is a mass: they cannot be added"
    assert complaint.place and (complaint.place.column, complaint.place.width) == (10, 4)
    assert refusal(reader.added, term(a), mass, "-").message.endswith("they cannot be subtracted")


def test_a_product_and_a_power_have_the_dimension_of_their_making(reader: Arithmetic) -> None:
    assert reader.multiplied(term(a), term(M, MASS)).dimension == LENGTH * MASS
    root = reader.raised(term(a), term(Rational(1, 2), NUMBER))
    assert (root.expr, root.dimension) == (sqrt(a), LENGTH ** Fraction(1, 2))
    assert reader.reciprocal(term(a)).dimension == NUMBER / LENGTH
    assert reader.negated(term(a), 3).start == 3


@pytest.mark.parametrize(
    ("exponent", "code"),
    [
        (term(a), "dimension"),
        (term(a, NUMBER), "dimension"),
        (term(MAX_EXPONENT + 1, NUMBER), "too-large"),
        (term(Rational(1, MAX_EXPONENT + 1), NUMBER), "too-large"),
    ],
)
def test_an_exponent_is_a_small_number(reader: Arithmetic, exponent: Term, code: str) -> None:
    assert refusal(reader.raised, term(a), exponent).code == code


def test_nothing_is_divided_by_what_vanishes_however_it_is_written(reader: Arithmetic) -> None:
    nothing = term((a + b) ** 2 - a**2 - 2 * a * b - b**2, terms=7)
    assert refusal(reader.reciprocal, nothing).code == "division-by-zero"
    assert refusal(reader.raised, nothing, term(-1, NUMBER)).code == "division-by-zero"
    assert reader.raised(nothing, term(2, NUMBER)).expr.expand() == 0


def test_a_root_of_what_is_negative_is_no_real_number(reader: Arithmetic) -> None:
    assert refusal(reader.raised, term(-4, NUMBER), term(Rational(1, 2), NUMBER)).code == "not-real"
    assert refusal(reader.applied, "sqrt", sqrt, term(-4, NUMBER), 0, 6).code == "not-real"


def test_a_function_takes_a_number_and_a_root_takes_anything(reader: Arithmetic) -> None:
    assert reader.applied("sqrt", sqrt, term(a**2, LENGTH**2), 0, 6).dimension == LENGTH
    assert refusal(reader.applied, "cos", cos, term(a), 0, 6).message.startswith("`cos` takes an angle or a number")
    assert refusal(reader.applied, "exp", exp, term(a), 0, 6).message.startswith("`exp` takes a number")
    assert refusal(reader.applied, "exp", exp, term(101, NUMBER), 0, 6).code == "too-large"
    assert reader.applied("exp", exp, term(100, NUMBER), 0, 6).expr == exp(100)


def test_what_would_grow_too_large_is_refused_before_it_is_worked_out(reader: Arithmetic) -> None:
    big = term(a + b, terms=11)
    assert refusal(reader.raised, big, term(6, NUMBER)).code == "too-large", "1771561 terms"
    assert refusal(reader.multiplied, term(a, size=MAX_SIZE), term(b, size=1)).code == "too-large"
    assert reader.multiplied(term(a, terms=MAX_TERMS), term(b)).terms == MAX_TERMS


@pytest.mark.parametrize(
    ("text", "value"),
    [("1.5", Rational(3, 2)), ("1e-3", Rational(1, 1000)), (".5", Rational(1, 2)), ("2.50E2", 250), ("007", 7)],
)
def test_a_decimal_number_is_read_exactly(reader: Arithmetic, text: str, value: Rational) -> None:
    assert rational(text) == value
    assert reader.number(text, 0, len(text)).expr == value


@pytest.mark.parametrize(
    "text", ["1" * (MAX_DIGITS + 1), f"1e{MAX_TEN_POWER + 1}", f"1e-{MAX_TEN_POWER + 1}", "1e99999"]
)
def test_a_number_is_of_a_bearable_length(reader: Arithmetic, text: str) -> None:
    assert refusal(reader.number, text, 0, 6).code == "too-large"


def test_a_declared_letter_has_the_dimension_of_its_kind() -> None:
    assert Declared("a", a, "moment of inertia").dimension == MASS * LENGTH**2
    assert fraction(Rational(-3, 4)) == Fraction(-3, 4)
