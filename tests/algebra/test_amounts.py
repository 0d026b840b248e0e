"""Numbers with their units: shown as written, carried out in SI units."""

from __future__ import annotations

import pytest
from sympy import ImmutableMatrix, Integer, Rational, Symbol, pi
from sympy.core.symbol import Str

from derive.algebra.amounts import Amount, MatrixAmount
from derive.algebra.expressions import explicit

CM = Rational(1, 100)


@pytest.mark.parametrize(
    ("amount", "value"),
    [
        (Amount(Integer(2), "cm", CM), Rational(1, 50)),
        (Amount(Integer(900), "rpm", pi / 30), 30 * pi),
        (Amount(Integer(0), "cm", CM), 0),
        (Amount(Integer(-3), "m", Integer(1)), -3),
    ],
)
def test_an_amount_is_carried_out_in_the_si_unit(amount: Amount, value: object) -> None:
    assert explicit(amount) == value
    assert explicit(2 * amount + 1) == 2 * value + 1  # type: ignore[operator]


def test_amounts_are_different_things_though_of_one_value() -> None:
    assert Amount(Integer(2), "cm", CM) != Amount(Integer(20), "mm", Rational(1, 1000))
    assert Amount(Integer(2), "cm", CM) == Amount(Integer(2), Str("cm"), CM)
    assert Amount(Integer(2), "cm", CM).is_real


def test_each_entry_of_a_vector_is_in_the_unit() -> None:
    vector = MatrixAmount(ImmutableMatrix([1, 0, 3]), "cm", CM)
    assert vector.shape == (3, 1)
    assert explicit(vector) == ImmutableMatrix([CM, 0, 3 * CM])
    assert vector[2, 0] == 3 * CM


def test_to_sympy_an_amount_is_its_number_times_its_factor() -> None:
    assert Amount(Integer(2), "cm", CM).lowered(str) == "(2*1/100)"
    assert MatrixAmount(ImmutableMatrix([1, 2]), "cm", Symbol("f")).lowered(lambda _: "x") == "(x*x)"


def test_a_unit_says_no_dimension() -> None:
    assert Amount(Integer(2), "cm", CM).dimension(lambda _: 1 / 0) is None
    assert MatrixAmount(ImmutableMatrix([1]), "cm", CM).dimension(lambda _: 1 / 0) is None
