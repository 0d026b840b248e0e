"""Predicates of impacts: each decides whether an outcome, or a symbol in the sentence of an outcome, is correct."""

from __future__ import annotations

from typing import Any

from sympy import Integer, diff

from derive.algebra.expressions import explicit, rate
from derive.steps.claims import parallel, value_of_role
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero


def is_struck(wanted: bool) -> Predicate:
    """Return a predicate: the power of the impulses depends on the rate of the coordinate exactly if `wanted` is
    true."""
    return lambda facts: wanted != is_zero(explicit(facts.inputs["slope"]))


def restitution(wanted: int | None) -> Predicate:
    """Whether the coefficient of restitution e has the wanted value; None requires that e is neither 0 nor 1."""

    def is_so(facts: Judged) -> bool:
        part = facts.inputs["restitution"]
        if wanted is not None:
            return is_zero(part - Integer(wanted))
        return not is_zero(part) and not is_zero(part - 1)

    return is_so


def momentum_of(facts: Judged, q: Any) -> bool:
    """Whether the factor of each rate s_dot in the jump is d^2 T/(dq_dot ds_dot), up to a common factor."""
    T, there = value_of_role(facts, "kinetic"), dict(facts.inputs["at"])
    moving = facts.quantities["kinetic"].coordinates
    inertia = {s: diff(T, rate(q), rate(s)).subs(there, simultaneous=True) for s in moving}
    return q in moving and parallel({s: diff(explicit(facts.result).left, rate(s)) for s in moving}, inertia)


def impulse_of_its_condition(facts: Judged, letter: Any) -> bool:
    """Whether the rates have the same factors in the power of the impulse and in the condition, up to a common
    factor."""
    power, left = diff(value_of_role(facts, "power"), letter), explicit(facts.result).left
    rates = power.free_symbols | left.free_symbols
    return parallel({v: diff(power, v) for v in rates}, {v: diff(left, v) for v in rates})
