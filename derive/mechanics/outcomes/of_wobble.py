"""What must be true for each word that chooses a sentence about a disturbed rotation: the order of the moments."""

from __future__ import annotations

from sympy import Expr

from derive.algebra.tidy import tidied
from derive.mechanics.outcomes.signs import vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _sign(value: Expr) -> int | None:
    value = tidied(value)
    if is_zero(value):
        return 0
    return 1 if value.is_positive else -1 if value.is_negative else None


def _order_is(wanted: str) -> Predicate:
    """By the moment about the axis: the greatest of all, the least, between the others, or as great as one of them."""

    def is_so(facts: Judged) -> bool:
        moments, axis = list(facts.inputs["moments"]), int(facts.inputs["axis_index"])
        about = moments.pop(axis)
        signs = [_sign(about - other) for other in moments]
        if 0 in signs:
            return wanted == "marginal"
        if _sign(moments[0] - moments[1]) == 0:
            return wanted == "symmetric"
        if None in signs:
            return wanted == "conditional"
        if signs[0] != signs[1]:
            return wanted == "unstable"
        return wanted == ("greatest" if signs[0] == 1 else "least")

    return is_so


def _excess_is(sign: int | None) -> Predicate:
    return lambda facts: _sign(facts.inputs["excess"]) == sign and not vanishes(facts)


def _root_is(grows: bool, *squares: str) -> Predicate:
    """Whether the square of the rate is negative, and which word it had; the root of one that is not known to be is
    written all the same."""

    def is_so(facts: Judged) -> bool:
        word = facts.quantities["squared"].step.outcome
        return (_sign(facts.inputs["squared"]) == -1) == grows and word in squares

    return is_so


outcomes_of(
    "rotation.perturbation_rate_squared",
    {word: _order_is(word) for word in ("greatest", "least", "unstable", "marginal", "symmetric", "conditional")},
)
outcomes_of(
    "rotation.perturbation_rate",
    {
        "stable": _root_is(False, "greatest", "least"),
        "symmetric": _root_is(False, "symmetric"),
        "conditional": _root_is(False, "conditional"),
        "unstable": _root_is(True, "unstable"),
    },
)
outcomes_of(
    "rotation.body_cone_rate", {"oblate": _excess_is(1), "prolate": _excess_is(-1), "generic": _excess_is(None)}
)
