"""Kinds and their units, and the dimension that sums, products and powers have."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from derive.algebra.dimensions import (
    KINDS,
    NUMBER,
    Dimension,
    Inhomogeneous,
    angles_of_kind,
    common,
    dimension_of_kind,
    exponents,
    kind_of_dimension,
    kind_with_article,
    named,
    power,
    product,
    quotient,
    unit_of_dimension,
    unit_of_kind,
)

MASS, LENGTH, TIME = (dimension_of_kind(kind) for kind in ("mass", "length", "time"))
SI = {"kg": MASS, "m": LENGTH, "s": TIME, "N": MASS * LENGTH / TIME**2, "J": MASS * LENGTH**2 / TIME**2}
SI |= {"W": SI["J"] / TIME, "Hz": TIME**-1, "rad": NUMBER, "1": NUMBER}


def of_unit(text: str) -> Dimension:
    """`kg m^2/s` read by hand."""
    found, above = NUMBER, True
    for piece in text.replace("/", " / ").split():
        if piece == "/":
            above = False
            continue
        unit, _, n = piece.partition("^")
        found *= SI[unit] ** ((int(n) if n else 1) * (1 if above else -1))
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_the_unit_of_a_kind_has_its_dimension(kind: str) -> None:
    assert of_unit(unit_of_kind(kind)) == dimension_of_kind(kind)
    assert kind_with_article(kind).endswith(f" {kind}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_unit_may_have_angles_where_only_they_tell_the_kind(kind: str) -> None:
    assert (0 in angles_of_kind(kind)) == (kind != "angle")
    assert "rad" not in unit_of_kind(kind) or 1 in angles_of_kind(kind)
    assert angles_of_kind(None) == (0,)


@pytest.mark.parametrize(
    ("dimension", "unit"),
    [
        (NUMBER, ""),
        (LENGTH, "m"),
        (TIME**-1, "1/s"),
        (MASS * LENGTH**2 / TIME**2, "N m"),
        (MASS / TIME**2, "N/m"),
        (LENGTH**4 / TIME**4, "m^4/s^4"),
        (LENGTH ** Fraction(3, 2) / TIME**2, "m^(3/2)/s^2"),
    ],
)
def test_what_has_no_kind_is_in_a_product_of_units(dimension: Dimension, unit: str) -> None:
    assert unit_of_dimension(dimension) == unit


def test_of_two_kinds_of_one_dimension_the_first_names_it() -> None:
    assert kind_of_dimension(dimension_of_kind("torque")) == "energy"
    assert named(LENGTH) == "a length"
    assert named(LENGTH**5) == "a quantity of dimension L^5"
    assert (exponents(MASS * LENGTH / TIME**2), exponents(NUMBER)) == ("M L T^-2", "1")


def test_terms_have_one_dimension_and_the_first_of_another_is_named() -> None:
    table: dict[str, Any] = {"a": LENGTH, "b": LENGTH, "0": None, "m": MASS}
    assert common("ab0", table.get) == LENGTH
    assert common("00", table.get) is None
    with pytest.raises(Inhomogeneous, match="`m` is a mass, but `a` is a length"):
        common("0abm", table.get)


def test_what_is_unknown_makes_a_product_unknown_but_nothing_at_all_is_a_number() -> None:
    assert product([MASS, None]) is None
    assert product([]) == NUMBER
    assert product([MASS, LENGTH]) == MASS * LENGTH
    assert quotient(None, MASS) is quotient(MASS, None) is power(None, Fraction(2)) is None
    assert quotient(LENGTH, TIME) == dimension_of_kind("speed")
    assert power(LENGTH, Fraction(1, 2)) ** 2 == LENGTH  # type: ignore[operator]
    assert (LENGTH / LENGTH).is_number and not LENGTH.is_number
