"""The first terms of expressions where a letter is small, large, or near a value."""

from __future__ import annotations

import pytest
from sympy import Expr, Integer, Rational, atan, cos, cosh, exp, log, oo, sin, sinh, sqrt, symbols, tanh

from derive.algebra.equality import equal
from derive.algebra.expansion import (
    Approach,
    BeginsBeyond,
    Expansion,
    FirstOrder,
    NoExpansion,
    expanded,
    in_ascending_powers,
    tidied_terms,
)
from derive.algebra.expressions import explicit

x, a, b = symbols("x a b", positive=True)


def terms(f: Expr, to: Expr, power: int | None) -> Expr:
    return tidied_terms(expanded(f, x, to, None if power is None else Rational(power)), x, to)


@pytest.mark.parametrize(
    ("f", "to", "power", "expected"),
    [
        (sin(x), Integer(0), 3, x - x**3 / 6),
        (1 - cos(x), Integer(0), None, x**2 / 2),
        (1 / (a + x), Integer(0), 2, 1 / a - x / a**2 + x**2 / a**3),
        (cos(x) / sin(x), Integer(0), 1, 1 / x - x / 3),
        (sqrt(x**2 + a**2), oo, 1, x + a**2 / (2 * x)),
        (sqrt(x), Integer(0), None, sqrt(x)),
        (exp(x) / (x - a), a, None, exp(a) / (x - a)),
        ((a * x + b) / (b * x + a), oo, None, a / b),
        (1 / x, -oo, None, 1 / x),
        (Integer(0) * x, Integer(0), None, Integer(0)),
    ],
)
def test_the_terms_are_those_of_the_tables(f: Expr, to: Expr, power: int | None, expected: Expr) -> None:
    """Abramowitz, Stegun, 3.6, 4.2 and 4.3."""
    assert equal(terms(f, to, power), expected)
    assert equal(in_ascending_powers(expanded(f, x, to, None if power is None else Rational(power)), x, to), expected)


@pytest.mark.parametrize("f", [log(x), exp(1 / x), exp(-1 / x), x**a])
def test_what_has_no_powers_has_no_expansion(f: Expr) -> None:
    with pytest.raises(NoExpansion):
        expanded(f, x, Integer(0), Rational(2))


def test_an_order_below_the_leading_term_is_none() -> None:
    with pytest.raises(NoExpansion):
        expanded(x**3, x, Integer(0), Rational(2))


def test_a_series_that_needs_too_many_derivatives_is_not_cut_off() -> None:
    with pytest.raises(NoExpansion):
        expanded(x**9 * cos(x), x, Integer(0), Rational(13))


def test_the_node_stands_for_its_terms_and_has_the_dimension_of_the_whole() -> None:
    node = Expansion(sin(x), x, Integer(0), Integer(3))
    assert equal(explicit(node), x - x**3 / 6)
    assert node.dimension(lambda part: part) == sin(x)


@pytest.mark.parametrize(
    ("value", "left"),
    [
        (b * (1 - exp(-a * x)), b),
        (b * (exp(a * x) - 1) * exp(-a * x), b),
        (b * tanh(a * x), b),
        (sinh(a * x) / cosh(a * x), 1),
        ((exp(2 * a * x) + exp(a * x)) / (b * exp(2 * a * x)), 1 / b),
    ],
)
def test_exponentials_that_die_away_leave_what_stays(value: Expr, left: Expr) -> None:
    assert expanded(value, x, oo) == {0: left}


@pytest.mark.parametrize("value", [exp(a * x), cosh(x), exp(-a * x) + exp(b * x), exp(-(b - a) * x)])
def test_what_grows_faster_than_any_power_or_may_has_none(value: Expr) -> None:
    with pytest.raises(NoExpansion):
        expanded(value, x, oo)


@pytest.mark.parametrize("value", [sin(x), atan(x), x * sin(x), 2 + sin(x) / x])
def test_what_oscillates_or_has_no_power_has_none(value: Expr) -> None:
    with pytest.raises(NoExpansion):
        expanded(value, x, oo)


def test_an_expansion_that_begins_beyond_its_order_is_zero_to_it() -> None:
    assert Expansion(x**2 + x**3, x, Integer(0), Integer(1)).doit() == 0
    with pytest.raises(BeginsBeyond):
        expanded(x**2, x, Integer(0), Rational(1))


def test_to_first_order_products_of_what_is_small_vanish() -> None:
    assert explicit(FirstOrder((a + x**2) * sin(b) + 3 * x * b - x * cos(b), x, b)) == a * b - x


def test_where_a_letter_goes_is_itself_when_it_is_carried_out() -> None:
    assert explicit(Approach(a / b, Integer(0))) == Approach(a / b, Integer(0))
