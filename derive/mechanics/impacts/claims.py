"""Predicates of the outcomes of impacts, and of the things that their sentences name."""

from __future__ import annotations

from typing import Any

from sympy import Integer, diff

from derive.algebra.expressions import explicit, rate
from derive.steps.claims import parallel, value_of_role
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero


def is_struck(wanted: bool) -> Predicate:
    """Whether some impulse has power when the coordinate changes."""
    return lambda facts: wanted != is_zero(explicit(facts.inputs["slope"]))


def restitution(wanted: int | None) -> Predicate:
    """Judge by the coefficient of restitution: 1 is elastic, 0 is together, and any other is a part of the speed."""

    def is_so(facts: Judged) -> bool:
        part = facts.inputs["restitution"]
        if wanted is not None:
            return is_zero(part - Integer(wanted))
        return not is_zero(part) and not is_zero(part - 1)

    return is_so


def momentum_of(facts: Judged, q: Any) -> bool:
    """Whether each rate has the second derivative of T by q_dot and this rate as its factor in the jump."""
    T, there = value_of_role(facts, "kinetic"), dict(facts.inputs["at"])
    moving = facts.quantities["kinetic"].coordinates
    inertia = {s: diff(T, rate(q), rate(s)).subs(there, simultaneous=True) for s in moving}
    return q in moving and parallel({s: diff(explicit(facts.result).left, rate(s)) for s in moving}, inertia)


def impulse_of_its_condition(facts: Judged, letter: Any) -> bool:
    """Whether each rate has the same factor in the power of the impulse and in the condition, up to a common factor."""
    power, left = diff(value_of_role(facts, "power"), letter), explicit(facts.result).left
    rates = power.free_symbols | left.free_symbols
    return parallel({v: diff(power, v) for v in rates}, {v: diff(left, v) for v in rates})
