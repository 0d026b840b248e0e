"""A value that is infinite or undefined is found, with the part of the expression that makes it so."""

from __future__ import annotations

from sympy import I, cos, nan, oo, pi, sqrt, symbols, tan, zoo

from derive.algebra.singular import has_no_value, is_not_real, undefined_part

m, k, w, alpha = symbols("m k omega alpha", positive=True)


def test_a_vanishing_denominator_is_named() -> None:
    value = cos(w) / (k - m * w**2)
    assert undefined_part(value, lambda part: part.xreplace({w: sqrt(k / m)})) == k - m * w**2
    assert undefined_part(value, lambda part: part.xreplace({w: sqrt(2 * k / m)})) is None


def test_an_infinite_function_is_named() -> None:
    assert undefined_part(m / tan(alpha), lambda part: part.xreplace({alpha: pi / 2})) == tan(alpha)


def test_infinite_and_complex_values_are_recognised() -> None:
    assert all(has_no_value(m + each) for each in (nan, oo, -oo, zoo))
    assert not has_no_value(m / k)
    assert is_not_real(m * I)
    assert not is_not_real(m)
