"""Formulas in numbers, and their derivatives by complex steps."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import Abs, Function, Symbol, atan2, exp, pi, sin, sqrt, symbols

from derive.algebra.expressions import TIME, Prescribed
from derive.witness.tape import NotComputable, Tape

x, y, a = symbols("x y a", real=True)


def value(formula: object, **at: float) -> complex:
    point = np.array([[complex(at["x"])], [complex(at["y"])]])
    return complex(Tape([formula], [x, y]).bound({a: 2.0})(point)[0, 0])


def test_a_formula_has_its_value() -> None:
    formula = a * x**3 - sqrt(y) / x + sin(x * y) * pi + exp(-a) + Abs(-y)
    expected = formula.subs({x: 1.5, y: 0.25, a: 2}).evalf()
    assert value(formula, x=1.5, y=0.25).real == pytest.approx(float(expected), rel=1e-14)


@pytest.mark.parametrize("formula", [x**2 * y, sqrt(x + y**2), Abs(x - 3) * y, atan2(y, x), x**0.5 / y, 1 / (x - 7)])
def test_a_complex_step_gives_the_derivative_to_all_figures(formula: object) -> None:
    point = np.array([[1.25 + 1e-30j], [0.5 + 0j]])
    found = np.imag(Tape([formula], [x, y]).bound({})(point)[0, 0]) / 1e-30
    assert found == pytest.approx(float(formula.diff(x).subs({x: 1.25, y: 0.5}).evalf()), rel=1e-13)


def test_a_prescribed_function_is_tested_by_a_function_with_these_derivatives() -> None:
    X = Prescribed("X", "length", above=True)
    point = np.array([[0.7 + 1e-30j]])
    rates = [X, X.rate(), X.rate(2), X.rate(3)]
    found = Tape(rates, [TIME]).bound({})(point)[:, 0]
    assert found[0].real > 0
    assert np.imag(found[:3]) / 1e-30 == pytest.approx(np.real(found[1:]), rel=1e-12)
    with pytest.raises(NotComputable, match="X"):
        Tape([X], [x])


def test_equal_parts_are_computed_once() -> None:
    tape = Tape([sin(x * y) + 1, sin(x * y) * 2, a * a], [x, y])
    assert len(tape.bound({a: 2.0})._varying) == 4


def test_a_letter_without_a_number_and_an_unknown_function_are_not_computable() -> None:
    with pytest.raises(NotComputable, match="a"):
        Tape([a * x], [x]).bound({})
    with pytest.raises(NotComputable):
        Tape([Function("f")(x)], [x])


def test_the_constants_of_a_tape_are_its_letters_but_for_the_inputs() -> None:
    assert Tape([a * x + Symbol("b")], [x]).letters == {a, Symbol("b")}
