"""A direction is a name or three components, and compared by what it is."""

from __future__ import annotations

from sympy import Integer, Symbol

from derive.algebra.direction import Direction


def test_a_direction_is_known_by_its_name_or_by_its_components() -> None:
    one, zero = Integer(1), Integer(0)
    assert Direction("x") == Direction(name="x") != Direction("y")
    assert Direction(components=(one, zero, zero)) != Direction("x"), "which axis is along x is for the body to say"
    assert Direction(components=(Symbol("a"), zero, zero)) == Direction(components=(Symbol("a"), zero, zero))


def test_a_direction_can_be_a_key_and_cannot_change() -> None:
    assert {Direction("x"): 1}[Direction("x")] == 1
