"""What must be true for each word that chooses a sentence about steady motions."""

from __future__ import annotations

from derive.algebra.expressions import rate
from derive.mechanics.outcomes.signs import sign_where_it_exists
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _nothing_else_moves(facts: Judged) -> bool:
    """Of an equation of motion is left what holds no acceleration, and not the rate of its own coordinate."""
    q = facts.inputs["coordinate"]
    moving = {s for s in facts.result.free_symbols if s.name.endswith("_ddot")} | {rate(q)}
    return not is_zero(facts.result.residual) and not moving & facts.result.free_symbols


_TABLE: dict[str, dict[str, Predicate]] = {
    "motion.steady_motion": {
        "generic": lambda facts: not is_zero(facts.result.residual),
        "always": lambda facts: is_zero(facts.result.residual),
        "of_equation": _nothing_else_moves,
    },
    "vibrations.frequency_squared_about": {
        "stable": sign_where_it_exists(1),
        "unstable": sign_where_it_exists(-1),
        "neutral": lambda facts: is_zero(facts.result),
        "conditional": lambda facts: not is_zero(facts.result),
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
