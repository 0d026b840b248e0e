"""What must be true for each word that chooses a sentence about equations to an order in what is small.

It is judged by the degree of what is kept and by what is left out.
"""

from __future__ import annotations

from typing import Any

from sympy import oo

from derive.algebra.expressions import explicit
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _exact(facts: Judged) -> bool:
    return is_zero(facts.inputs["value"] - facts.inputs["kept"]) and _says_what_is_kept(facts)


def _says_what_is_kept(facts: Judged) -> bool:
    """The equation is what is kept, but for a factor: each vanishes with the other."""
    residual = explicit(facts.result).residual
    moving = [s for s in residual.free_symbols if s.name.endswith(("_dot", "_ddot"))]
    ratio = facts.inputs["kept"] / residual
    return all(is_zero(ratio.diff(s)) for s in moving)


def _leading(*places: Any) -> Predicate:
    """No order is asked for, and the letter goes to one of these, or to none of those that have a word."""

    def is_so(facts: Judged) -> bool:
        to = facts.inputs["to"]
        there = to in places if places else to not in (0, oo, -oo)
        return there and facts.inputs["order"] == -1 and not _exact(facts) and _says_what_is_kept(facts)

    return is_so


def _to_order(wanted: int | None) -> Predicate:
    def is_so(facts: Judged) -> bool:
        order = int(facts.inputs["order"])
        fits = order == wanted if wanted is not None else order not in (-1, 1)
        return fits and not _exact(facts) and _says_what_is_kept(facts)

    return is_so


outcomes_of(
    "answers.equation_in_limit",
    {
        "small": _leading(0),
        "large": _leading(oo, -oo),
        "near": _leading(),
        "first_order": _to_order(1),
        "to_order": _to_order(None),
        "exact": _exact,
    },
)
