"""What a quantity says of a state."""

from __future__ import annotations

from sympy import Integer

from derive.witness.facts import Around, Rest
from tests.witness.systems import theta


def test_a_state_of_rest_is_not_an_equation_about_a_place() -> None:
    values = {theta: Integer(0)}
    assert Rest(values) != Around(values)
    assert Rest(values).values == Around(values).values
