"""The assumptions about symbols are stated once, in one line for each symbol."""

from __future__ import annotations

from sympy import Symbol, cos, pi, sin

from derive.algebra.expressions import Relation
from derive.page.assumptions import between_bounds, not_implied, with_units
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

alpha, beta = Symbol("alpha", real=True), Symbol("beta", real=True)
ABOVE, BELOW = Relation(alpha, ">", 0), Relation(alpha, "<", pi / 2)


def told(*conditions: Relation) -> list[str]:
    return [plain(Notation().layout(each)) for each in between_bounds(not_implied(conditions))]


def test_two_bounds_of_a_letter_are_one_line() -> None:
    assert told(ABOVE, Relation(beta, "<", 1), BELOW) == ["0 < α < π/2", "β < 1"]
    assert told(Relation(alpha, ">=", 0), BELOW) == ["0 ≤ α < π/2"]
    assert told(BELOW) == ["α < π/2"]


def test_what_follows_from_the_bounds_is_not_told() -> None:
    assert told(ABOVE, BELOW, Relation(sin(alpha), "!=", 0)) == ["0 < α < π/2"]
    assert told(ABOVE, BELOW, Relation(cos(alpha), "!=", 0)) == ["0 < α < π/2"]
    closed = Relation(alpha, ">=", 0)
    assert told(closed, BELOW, Relation(sin(alpha), "!=", 0)) == ["0 ≤ α < π/2", "sin α ≠ 0"]
    assert told(Relation(sin(beta), "!=", 0)) == ["sin β ≠ 0"]


def test_a_bound_has_the_unit_of_its_letter() -> None:
    v = Symbol("v", real=True)
    both = between_bounds([Relation(v, ">", -1), Relation(v, "<", 2), ABOVE])
    shown = [plain(Notation().layout(with_units(each, {v: "m/s", alpha: "rad"}))) for each in both]
    assert shown == ["-1 m/s < v < 2 m/s", "α > 0"]
