"""Square roots that a step has named, such as a distance r: later steps show the symbol in place of the root."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from sympy import Add, Pow

from derive.algebra.expressions import explicit
from derive.steps.step import Step, is_zero


def shortened(steps: Sequence[Step]) -> Callable[[Step, Any], Any]:
    """Return a function with the arguments step and expression; it replaces named square roots by their symbols."""
    letters: list[tuple[Any, Any]] = []
    known: dict[str, list[tuple[Any, Any]]] = {}
    for step in steps:
        known[step.key] = list(letters)
        if step.display.abbreviates:
            letters.append((explicit(step.result).as_base_exp()[0], step.symbol))
    return lambda step, value: _written(value, known.get(step.key, []))


def _written(value: Any, letters: Sequence[tuple[Any, Any]]) -> Any:
    if not letters or not hasattr(value, "atoms"):
        return value
    found = {}
    for root in value.atoms(Pow):
        if root.exp.is_Rational and root.exp.q == 2 and isinstance(explicit(root.base), Add):
            named = next((letter for inside, letter in letters if is_zero(root.base - inside)), None)
            found.update({root: Pow(named, 2 * root.exp)} if named is not None else {})
    return value.xreplace(found) if found else value
