"""What must be true for each word that chooses a sentence about vectors that turn, and about free rotation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr, Integer, diff

from derive.algebra.expressions import Cross, Dot, explicit
from derive.algebra.tidy import tidied
from derive.mechanics.outcomes.signs import lasts, never_vanishes, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import is_zero


def _across(facts: Judged) -> Any:
    return explicit(Cross(facts.inputs["omega"], facts.result))


def _turns(wanted: str) -> Predicate:
    """The component along the axis is negative where the body is said to turn left-handed, and there only."""

    def is_so(facts: Judged) -> bool:
        along = tidied(explicit(Dot(facts.result, facts.inputs["axis"])))
        return (wanted == "left") == bool(along.is_negative)

    return is_so


def _cosine_is(wanted: int | None, of: Callable[[Any], Any] = lambda cosine: cosine) -> Predicate:
    """Parallel, opposite, perpendicular by the cosine 1, -1, 0; None for a cosine that is none of them."""

    def is_so(facts: Judged) -> bool:
        cosine = of(facts.result)
        if wanted is not None:
            return is_zero(cosine - wanted)
        return not any(is_zero(cosine - special) for special in (1, -1, 0))

    return is_so


def _cos(angle: Expr) -> Expr:
    from sympy import cos

    return cos(angle)


def _rate_is(in_space: bool | None, in_body: bool | None) -> Predicate:
    """Whether the rate vanishes in space, and in the body where that rate was put in; None: it was not."""

    def is_so(facts: Judged) -> bool:
        seen = facts.inputs.get("in_body")
        if seen is None:
            return in_space is None
        return in_space == is_zero(facts.result) and (in_body is None or in_body == is_zero(seen))

    return is_so


def _euler(torque: bool, coupled: str) -> Predicate:
    """Whether a torque acts, and whether products of components are left.

    coupled   "here": in this one; "elsewhere": not here but in another; "nowhere"
    """

    def is_so(facts: Judged) -> bool:
        acting = facts.inputs["torque"]
        driven = not is_zero(acting)
        rates = facts.inputs["rate"]
        components = facts.inputs["moving"]
        mixed = [
            not all(is_zero(diff(entry, u, v)) for u in components for v in components if u != v) for entry in rates
        ]
        here = mixed["xyz".index(facts.words["axis"])]
        where = "here" if here else "elsewhere" if any(mixed) else "nowhere"
        return driven == torque and (not coupled or where == coupled)

    return is_so


def _sum_left(wanted: str) -> Predicate:
    """What becomes of the terms that have no highest rate: there were none, they cancelled, or some are left."""

    def is_so(facts: Judged) -> bool:
        highest = dict.fromkeys(facts.inputs["highest"], Integer(0))
        before = [tidied(side.xreplace(highest)) for side in facts.inputs["products"]]
        left = facts.result.left.xreplace(highest)
        if wanted == "remain":
            return not is_zero(left)
        return is_zero(left) and (wanted == "plain") == all(is_zero(each) for each in before)

    return is_so


def _times_its_factor(facts: Judged) -> bool:
    """Whether it is the equation times the factor that the sentence names."""
    multiplied = explicit(facts.inputs["factor"]) * explicit(facts.inputs["written"].left)
    return is_zero(explicit(facts.result.left) - multiplied)


def _given_as(sort: str) -> Predicate:
    """By the verb that the script calls, and by the components that it gives."""

    def is_so(facts: Judged) -> bool:
        given = all(is_zero(one - other) for one, other in zip(facts.result, facts.inputs["given"], strict=True))
        return lasts(facts) and given and facts.inputs["verb"].name.startswith(sort)

    return is_so


_TABLE: dict[str, dict[str, Predicate]] = {
    "rotation.spin": {"right_handed": _turns("right"), "left_handed": _turns("left")},
    "rotation.angular_momentum": {
        "parallel": lambda facts: is_zero(_across(facts)),
        "generic": lambda facts: never_vanishes(_across(facts)),
        "in_general": lambda facts: not is_zero(_across(facts)) and not never_vanishes(_across(facts)),
    },
    "rotation.cosine_between": {
        "parallel": _cosine_is(1),
        "opposite": _cosine_is(-1),
        "perpendicular": _cosine_is(0),
        "generic": _cosine_is(None),
    },
    "rotation.angle_between": {
        "parallel": _cosine_is(1, _cos),
        "opposite": _cosine_is(-1, _cos),
        "perpendicular": _cosine_is(0, _cos),
        "generic": _cosine_is(None, _cos),
    },
    "rotation.torque": {
        "zero": vanishes,
        "generic": lambda facts: never_vanishes(facts.result),
        "in_general": lambda facts: lasts(facts) and not never_vanishes(facts.result),
    },
    "rotation.rate_in_space": {
        "generic": _rate_is(None, None),
        "zero": _rate_is(True, False),
        "zero_in_both": _rate_is(True, True),
        "driven": _rate_is(False, None),
    },
    "rotation.euler_equation": {
        "coupled": _euler(False, "here"),
        "driven": _euler(True, ""),
        "isotropic": _euler(False, "nowhere"),
        "uncoupled": _euler(False, "elsewhere"),
    },
    "rotation.rate_in_body": {
        "zero": vanishes,
        "in_general": lambda facts: not is_zero(facts.result) and is_zero(facts.inputs["torque"]),
        "driven": lambda facts: not is_zero(facts.inputs["torque"]),
    },
    "motion.product": {
        "alone": lambda facts: facts.inputs["of_many"] == 1 and _times_its_factor(facts),
        "one_of_several": lambda facts: facts.inputs["of_many"] > 1 and _times_its_factor(facts),
    },
    "motion.sum": {word: _sum_left(word) for word in ("plain", "cancel", "remain")},
    "motion.rate_under": {"conserved": vanishes, "changes": lasts},
    "rotation.constant_angular_velocity": {"generic": _given_as("constant"), "momentary": _given_as("momentary")},
    "rotation.tangent_between": {"generic": lasts, "parallel": vanishes},
    "rotation.vector_component": {"generic": lasts, "zero": vanishes},
    "answers.squared_magnitude": {"generic": lasts, "zero": vanishes},
    "answers.magnitude": {"generic": lasts, "zero": vanishes},
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
