"""Whether a force can keep a condition."""

from __future__ import annotations

from sympy import Expr, symbols

from derive.witness.constraints import without_gradient
from derive.witness.description import Condition, Description, Particle
from tests.witness.systems import ON_A_STRING, m, x, y

N = symbols("N")


def _with(residual: Expr) -> Description:
    return Description(
        ((x, "length"), (y, "length")), (Particle(m, (x, y)),), conditions=(Condition(residual, multiplier=N),)
    )


def test_a_square_has_no_gradient_where_it_vanishes() -> None:
    assert without_gradient(_with((x - y) ** 2)) == [0]


def test_a_condition_without_a_square_can_be_kept() -> None:
    assert without_gradient(_with(x - y)) == []
    assert without_gradient(ON_A_STRING) == []
