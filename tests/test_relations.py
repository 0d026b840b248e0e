"""When two equations, or two inequalities, say the same."""

from __future__ import annotations

import pytest
from sympy import Symbol, cos, sin, sqrt

from derive.evidence import Grade, equal
from derive.expressions import Relation

a, b, k = (Symbol(name, positive=True) for name in "abk")
x, y, theta = (Symbol(name, real=True) for name in ("x", "y", "theta"))


def says(left: object, mark: str, right: object) -> Relation:
    return Relation(left, mark, right)


SAME = [
    (says(x, "=", y), says(y, "=", x)),
    (says(k * x - k * y, "=", 0), says(x, "=", y)),
    (says(x, ">", y), says(y, "<", x)),
    (says(-k * x, ">", -k * y), says(x, "<", y)),
    (says(a / (b + k), ">=", 0), says(a, ">=", 0)),
    (says(x * (sin(theta) ** 2 + cos(theta) ** 2), "=", y), says(x, "=", y)),
    (says(sin(2 * theta), "=", x), says(2 * sin(theta) * cos(theta) - x, "=", 0)),
    (says(a**2, ">", b**2), says(a, ">", b)),
    (says(k * a**2 - 3 * k * b, ">=", 0), says(a, ">=", sqrt(3) * sqrt(b))),
    (says(a, ">=", sqrt(b / k)), says(0, ">=", b / k - a**2)),
]


@pytest.mark.parametrize(("left", "right"), SAME, ids=[f"{a}  {b}" for a, b in SAME])
def test_relations_that_follow_from_each_other_are_equal(left: Relation, right: Relation) -> None:
    assert equal(left, right).grade is Grade.PROVED
    assert equal(right, left).grade is Grade.PROVED


DIFFERENT = [
    (says(x, "=", y), says(x, "=", 2 * y)),
    (says(x, ">", y), says(x, "<", y)),
    (says(x, ">", y), says(x, ">=", y)),
    (says(x, ">", y), says(x, "=", y)),
    (says(x * theta, "=", y * theta), says(x, "=", y)),
    (says(x * theta, ">", y * theta), says(x, ">", y)),
    (says(x**2, ">", y**2), says(x, ">", y)),
    (says(a**2, ">", b), says(a, ">", b)),
    (says(-k * a**2 + k * b, ">=", 0), says(a, ">=", sqrt(b))),
    (says(x, "=", 0), x),
]


@pytest.mark.parametrize(("left", "right"), DIFFERENT, ids=[f"{a}  {b}" for a, b in DIFFERENT])
def test_relations_that_do_not_are_different(left: Relation, right: object) -> None:
    assert equal(left, right).grade is Grade.REFUTED
    assert equal(right, left).grade is Grade.REFUTED


def test_a_factor_may_be_divided_out_once_it_is_known_not_to_vanish() -> None:
    assert equal(says(x * theta, "=", y * theta), says(x, "=", y), [theta])
