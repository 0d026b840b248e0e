"""What must be true of a result for its outcome to be right, and of what its sentence names."""

from __future__ import annotations

from typing import Any

from sympy import Integer, diff

from derive.algebra.expressions import explicit, rate
from derive.steps.claims import parallel, value_of_role
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero


def is_struck(wanted: bool) -> Predicate:
    """Whether some impulse has power where that coordinate changes."""
    return lambda facts: wanted != is_zero(explicit(facts.inputs["slope"]))


def restitution(wanted: int | None) -> Predicate:
    """Elastic with all of the speed, together with none of it, else with a part."""

    def is_so(facts: Judged) -> bool:
        part = facts.inputs["restitution"]
        if wanted is not None:
            return is_zero(part - Integer(wanted))
        return not is_zero(part) and not is_zero(part - 1)

    return is_so


def momentum_of(facts: Judged, q: Any) -> bool:
    """The rates stand in the jump with the second derivatives of T by q_dot and each rate, in that moment."""
    T, there = value_of_role(facts, "kinetic"), dict(facts.inputs["at"])
    moving = facts.quantities["kinetic"].coordinates
    inertia = {s: diff(T, rate(q), rate(s)).subs(there, simultaneous=True) for s in moving}
    return q in moving and parallel({s: diff(explicit(facts.result).left, rate(s)) for s in moving}, inertia)


def impulse_of_its_condition(facts: Judged, letter: Any) -> bool:
    """The power of the impulse has each rate with the factor that it has in the condition."""
    power, left = diff(value_of_role(facts, "power"), letter), explicit(facts.result).left
    rates = power.free_symbols | left.free_symbols
    return parallel({v: diff(power, v) for v in rates}, {v: diff(left, v) for v in rates})
