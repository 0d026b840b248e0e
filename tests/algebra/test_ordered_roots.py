"""Roots without a formula: in order, exact in numbers, and of the dimension of the unknown."""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np
import pytest
from sympy import CRootOf, Poly, Rational, Symbol, expand, prod, sqrt, symbols
from sympy.abc import x

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit, scalar
from derive.algebra.ordered_roots import OrderedRoot, root_in_order
from derive.algebra.samples import value_at
from derive.steps.step import Grade
from derive.witness.tape import Tape

a, b, c = symbols("a b c", positive=True)
NAME = scalar("lambda_1")
COEFFICIENTS = (1, -(a + b + c), a * b + b * c + c * a, -a * b * c)  # of (x - a) (x - b) (x - c)


def root(number: int) -> Any:
    return OrderedRoot(COEFFICIENTS, number, NAME)


def test_with_numbers_it_is_an_exact_number_in_its_place() -> None:
    numbers = {a: Rational(7), b: Rational(1, 2), c: Rational(3)}
    found = [explicit(root(n).xreplace(numbers)) for n in (1, 2, 3)]
    assert all(abs(value - wanted) < 1e-20 for value, wanted in zip(found, (Rational(1, 2), 3, 7), strict=True))
    irrational = explicit(OrderedRoot((1, -9, 20, -7), 2, NAME))
    assert irrational == CRootOf(Poly([1, -9, 20, -7], x), 1, radicals=False)
    assert irrational.is_real


def test_its_letters_are_those_of_the_coefficients() -> None:
    assert root(1).free_symbols == {a, b, c}
    assert root(1).variables == (NAME,)
    assert explicit(root(2)) == root(2), "with letters it stays what it is"


@pytest.mark.parametrize("places", [[1, 2, 3], ["0.001", 5, 70000], [2, "2.0001", "2.0002"], [1, 2, 3, 4, 5, 6, 7, 8]])
def test_the_digits_are_those_of_the_root_of_that_place(places: list[Any]) -> None:
    wanted = [Rational(each) for each in places]
    whole = Poly(expand(prod(x - each for each in wanted)), x)
    with mpmath.mp.workdps(60):
        for number, each in enumerate(sorted(wanted), 1):
            found = root_in_order([mpmath.mpf(k.p) / k.q for k in whole.all_coeffs()], number)
            assert abs(found - mpmath.mpf(each.p) / each.q) < mpmath.mpf(10) ** -40


def test_equations_that_hold_of_the_root_are_sampled_and_others_refuted() -> None:
    first = root(1)
    polynomial = sum(k * first ** (3 - n) for n, k in enumerate(COEFFICIENTS))
    assert equal(polynomial, 0).grade is Grade.SAMPLED
    assert equal(root(1) + root(2) + root(3), a + b + c).grade is Grade.SAMPLED
    assert not equal(root(1) + root(2), a + b + c)
    assert not equal(root(1), root(2))
    assert not equal(first, a), "the least of three letters is none of them"


def test_it_has_a_value_at_a_point_and_many_at_once() -> None:
    point = {a: Rational(7), b: Rational(2), c: Rational(3)}
    assert abs(value_at(sqrt(root(3)), point) - sqrt(7)) < 1e-20
    numbers = {a: 7.0, b: 2.0}
    found = Tape([sqrt(root(2))], [c]).bound(numbers)(np.array([[3.0, 1.0, 9.0]]))
    assert np.allclose(np.ravel(found), np.sqrt([3, 2, 7]))


def test_its_dimension_is_that_of_the_unknown() -> None:
    from derive.algebra.kinds import dimension_of_kind
    from derive.steps.homogeneity import dimension_of

    frequency = dimension_of_kind("angular speed")
    of = {Symbol("w"): frequency}
    w = Symbol("w")
    assert dimension_of(OrderedRoot((1, -w, w**2, -(w**3)), 1, NAME), of) == frequency
