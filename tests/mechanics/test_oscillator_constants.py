"""The constants beta, omega_0 and omega_1 that the motion of an oscillator proposes."""

from __future__ import annotations

import pytest
from sympy import Expr, sqrt, symbols

from derive.algebra.expressions import Relation
from derive.errors import Unverified
from derive.mechanics import coordinate, let
from derive.mechanics.vibrations.oscillator_constants import oscillator_constants
from derive.steps.natural import NamesValue, Proposal

m, b, k = symbols("m b k", positive=True)


def proposals(*coefficients: Expr) -> list[Proposal]:
    """The proposals for m x_ddot + b x_dot + k x = 0, if these were its coefficients."""
    x = coordinate("x", "length")
    left = m * x.acceleration + b * x.rate + k * x.symbol
    equation = let("motion", lambda: Relation(left, "=", 0 * m))
    return list(oscillator_constants(equation, x.symbol, *coefficients))


@pytest.mark.parametrize("scale", [1, -2 / m])
def test_the_constants_follow_from_the_coefficients(scale: Expr) -> None:
    made = {str(each.symbol): each.make() for each in proposals(*(scale**2 * c for c in (m, b, k)))}
    assert {name: q.value for name, q in made.items()} == {
        "beta": b / (2 * m),
        "omega_0": sqrt(k / m),
        "omega_1": sqrt(4 * k * m - b**2) / (2 * m),
    }
    assert all(quantity.fact(NamesValue) for quantity in made.values())


@pytest.mark.parametrize(
    ("coefficients", "wrong"),
    [
        ((2 * m, b, k), {"beta", "omega_1", "omega_0"}),
        ((m, 2 * b, k), {"beta", "omega_1"}),
        ((m, b, 4 * k), {"omega_1", "omega_0"}),
    ],
)
def test_the_constants_of_another_equation_are_refused(coefficients: tuple[Expr, ...], wrong: set[str]) -> None:
    refused = set()
    for each in proposals(*coefficients):
        try:
            each.make()
        except Unverified:
            refused.add(str(each.symbol))
    assert refused == wrong
