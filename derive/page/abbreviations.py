"""What stands on a page once: a long formula that a step has given a letter to, an equation that is linear already."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from sympy import Add, Pow

from derive.algebra.expressions import explicit
from derive.steps.step import Step, is_zero

ABBREVIATING = "model.distance"  # the rule of a step whose letter stands for its formula from then on
LINEAR = "vibrations.linearised"


def shortened(steps: Sequence[Step]) -> Callable[[Step, Any], Any]:
    """How a step writes an expression: with the letters of those before it that name what it holds."""
    letters: list[tuple[Any, Any]] = []
    known: dict[str, list[tuple[Any, Any]]] = {}
    for step in steps:
        known[step.key] = list(letters)
        if step.rule == ABBREVIATING:
            letters.append((explicit(step.result).as_base_exp()[0], step.symbol))
    return lambda step, value: _written(value, known.get(step.key, []))


def says_again(step: Step) -> str | None:
    """The step whose equation this one has once more: of what is linear already nothing is left out."""
    roles = dict(step.roles)
    return str(roles["motion"].name) if step.rule == LINEAR and "as_it_is" in roles else None


def _written(value: Any, letters: Sequence[tuple[Any, Any]]) -> Any:
    """Each root of what one of the letters is the root of, however it is arranged, is the letter."""
    if not letters or not hasattr(value, "atoms"):
        return value
    found = {}
    for root in value.atoms(Pow):
        if root.exp.is_Rational and root.exp.q == 2 and isinstance(explicit(root.base), Add):
            named = next((letter for inside, letter in letters if is_zero(root.base - inside)), None)
            found.update({root: Pow(named, 2 * root.exp)} if named is not None else {})
    return value.xreplace(found) if found else value
