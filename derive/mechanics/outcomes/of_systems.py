"""What must be true for each word that chooses a sentence about turning bodies, forces and constraints."""

from __future__ import annotations

from sympy import eye

from derive.mechanics.outcomes.signs import vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _along_space(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - eye(3))


def _along_body(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - facts.inputs["in_space"])


_TABLE: dict[str, dict[str, Predicate]] = {
    "rigid.angular_velocity": {
        "space": _along_space,
        "body": lambda facts: _along_body(facts) and not _along_space(facts),
        "following": lambda facts: not _along_body(facts) and not _along_space(facts),
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
