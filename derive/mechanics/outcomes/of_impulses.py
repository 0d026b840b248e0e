"""What must be true for each word that chooses a sentence about a blow."""

from __future__ import annotations

from sympy import Integer

from derive.algebra.expressions import explicit
from derive.mechanics.outcomes.signs import always_sign, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _is_struck(wanted: bool) -> Predicate:
    """Whether some impulse has power where that coordinate changes."""
    return lambda facts: wanted != is_zero(explicit(facts.inputs["slope"]))


def _restitution(wanted: int | None) -> Predicate:
    """Elastic with all of the speed, together with none of it, else with a part."""

    def is_so(facts: Judged) -> bool:
        part = facts.inputs["restitution"]
        if wanted is not None:
            return is_zero(part - Integer(wanted))
        return not is_zero(part) and not is_zero(part - 1)

    return is_so


outcomes_of("impacts.momentum_jump", {"struck": _is_struck(True), "free": _is_struck(False)})
outcomes_of(
    "impacts.meeting_condition",
    {
        "together": _restitution(0),
        "kept": _restitution(0),
        "elastic": _restitution(1),
        "rebound": _restitution(None),
    },
)
outcomes_of(
    "impacts.work_of_impulses",
    {"zero": vanishes, "lost": always_sign(-1), "gained": always_sign(1), "generic": always_sign(None)},
)
