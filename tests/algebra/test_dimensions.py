"""Dimensions: their products, quotients and powers, and how they are told."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.dimensions import NUMBER, dimension, exponents, power, product, quotient, raised

MASS, LENGTH, TIME = dimension(1, 0, 0), dimension(0, 1, 0), dimension(0, 0, 1)


def test_what_is_unknown_makes_a_product_unknown_but_nothing_at_all_is_a_number() -> None:
    assert product([MASS, None]) is None
    assert product([]) == NUMBER
    assert product([MASS, LENGTH]) == MASS * LENGTH
    assert quotient(None, MASS) is quotient(MASS, None) is power(None, Fraction(2)) is None
    assert quotient(LENGTH, TIME) == dimension(0, 1, -1)
    assert power(LENGTH, Fraction(1, 2)) ** 2 == LENGTH  # type: ignore[operator]
    assert (LENGTH / LENGTH).is_number and not LENGTH.is_number


def test_a_dimension_is_told_by_its_exponents() -> None:
    assert (exponents(MASS * LENGTH / TIME**2), exponents(NUMBER)) == ("M L T^-2", "1")
    assert [raised("m", Fraction(n, 2)) for n in (2, 3, 4)] == ["m", "m^(3/2)", "m^2"]
