"""Quantities: what they hand on, and what may not be done with them; levels, names and zeros."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest
from sympy import Integer, Matrix, Symbol

from derive.algebra.expressions import Dot, column
from derive.errors import Rejected
from derive.mechanics import let
from derive.steps.step import (
    Fact,
    Level,
    Quantity,
    compared_with,
    entry_name,
    is_zero,
    require_kind,
    same_value,
)
from tests.steps.test_establish import a, b, refusal_of, sum_of_squares, x


@pytest.mark.parametrize(
    "operation",
    [
        lambda s: s + 1,
        lambda s: 1 + s,
        lambda s: s - s,
        lambda s: 2 * s,
        lambda s: s * s,
        lambda s: s / 2,
        lambda s: 1 / s,
        lambda s: s**2,
        lambda s: -s,
        lambda s: Integer(2) * s,
        lambda s: a - s,
        lambda s: s @ s,
    ],
)
def test_arithmetic_that_would_lose_the_steps_is_refused(operation: Callable[[Quantity], Any]) -> None:
    s = sum_of_squares()
    complaint = refusal_of(lambda: operation(s))
    assert complaint.code == "plain-arithmetic"
    assert "`sum_of_squares`" in complaint.message


def test_levels_show_their_own_and_every_lower_one() -> None:
    shown = {level: [other for other in Level if level.shows(other)] for level in Level}
    assert shown[Level.BRIEF] == [Level.BRIEF]
    assert shown[Level.STANDARD] == [Level.BRIEF, Level.STANDARD]
    assert shown[Level.FULL] == list(Level)


def test_entries_of_a_tensor_are_named_for_their_axes() -> None:
    assert entry_name("J", 0, 1) == Symbol("J_xy", real=True)


def test_a_vector_of_zeros_is_zero_and_a_node_is_carried_out_first() -> None:
    assert is_zero(Matrix([0, 0, 0]))
    assert is_zero(Dot(column(1, 0, 0), column(0, 1, 0)))
    assert not is_zero(column(0, 0, x))


@dataclass(frozen=True)
class Weighed(Fact):
    missing = "was never weighed"
    scale: str


def test_a_quantity_hands_on_what_verbs_need_of_it_by_its_kind() -> None:
    s = sum_of_squares(facts=[Weighed("kitchen")])
    assert s.needed(Weighed) == s.fact(Weighed) == Weighed("kitchen")


def test_what_a_quantity_does_not_hand_on_is_a_fault_of_the_script() -> None:
    assert sum_of_squares().fact(Weighed) is None
    with pytest.raises(Rejected, match="`sum_of_squares` was never weighed"):
        sum_of_squares().needed(Weighed)


def test_a_quantity_rests_on_all_that_it_was_made_from_and_each_once() -> None:
    p = let("p", lambda: a + b)
    q = let("q", lambda s: 2 * s, p)
    r = let("r", lambda s, t: s * t, p, q)
    assert [ancestor.key for ancestor in r.ancestors()].count("p") == 1
    assert {ancestor.key for ancestor in r.ancestors()} == {"p", "q", "r"}
    assert (r.rests_on(p), r.rests_on(r), p.rests_on(r)) == (True, True, False)


def test_a_second_route_is_taken_once_however_often_it_is_compared() -> None:
    taken: list[int] = []
    route = compared_with(lambda: taken.append(1) or a)
    assert route(a) == route(a) == (a, a)
    assert len(taken) == 1


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (a * (a + b), a**2 + a * b, True),
        (a, b, False),
        ((a, b), (a, b + a - a), True),
        ((a, b), (a,), False),
        (column(a, 0, 0), column(a, 0, 0), True),
        (column(a, 0, 0), Matrix([a, 0]), False),
        (column(a, 0, 0), a, False),
        ("centre", "centre", False),
    ],
)
def test_values_are_the_same_if_their_difference_vanishes(one: Any, other: Any, same: bool) -> None:
    assert same_value(one, other) is same


def test_a_quantity_of_another_kind_is_refused_by_what_it_is() -> None:
    require_kind("torque", "omega", sum_of_squares(kind="angular speed"), "angular speed")
    with pytest.raises(Rejected, match="`torque` needs a mass as its `m`, but `sum_of_squares` is a length"):
        require_kind("torque", "m", sum_of_squares(kind="length"), "mass")
    with pytest.raises(Rejected, match="`torque` needs a mass as its `m`, but it is Symbol"):
        require_kind("torque", "m", a, "mass")
