"""What must be true for each word that chooses a sentence about turning bodies, forces and constraints."""

from __future__ import annotations

from itertools import islice

from sympy import Expr, ImmutableDenseMatrix, Matrix, Rational, diff, eye

from derive.algebra.expressions import rate
from derive.algebra.samples import letters_of, points, seed_of
from derive.mechanics.outcomes.signs import lasts, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.record import coordinates_in
from derive.steps.step import is_zero


def _along_space(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - eye(3))


def _along_body(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - facts.inputs["in_space"])


def _has_applied(facts: Judged) -> bool:
    return "applied" in facts.inputs and not is_zero(facts.inputs["applied"])


def _has_kept(facts: Judged) -> bool:
    return any(facts.result.has(letter) for letter in facts.inputs["letters"])


def _has_rates(condition: Expr) -> bool:
    return any(condition.has(rate(q)) for q in coordinates_in(condition))


def _of_a_centre(facts: Judged) -> bool:
    return "centre" in facts.inputs and is_zero(facts.result - facts.inputs["centre"])


def _of_a_spring(facts: Judged, several: bool) -> bool:
    """Whether a spring of the system is as long, the only one or one of several."""
    springs = [each for each in facts.subject.body.between if each.is_spring]
    return (len(springs) > 1) == several and any(is_zero(each.length - facts.result) for each in springs)


def _is_stretched(facts: Judged) -> bool:
    """Whether a small displacement along the steepest way changes the condition by another amount than its length, with
    numbers for the letters: that way is what virtual work makes of the condition, (J J^T)^-1 J a."""
    place, condition = (facts.inputs.get(role) for role in ("place", "condition"))
    if not place or condition is None:
        return False
    moving = sorted(coordinates_in(ImmutableDenseMatrix([*place, condition])), key=str)
    J = Matrix([[diff(c, q) for q in moving] for c in place])
    a = Matrix([diff(condition, q) for q in moving])
    for point in islice(points(letters_of(condition) | set().union(*map(letters_of, place)), seed_of(condition)), 4):
        there = {letter: value.evalf(30) for letter, value in point.items()}
        jacobian, slopes = J.xreplace(there).evalf(30), a.xreplace(there).evalf(30)
        steepest = (jacobian * jacobian.T).inv() * jacobian * slopes
        if abs(steepest.norm() - 1) > Rational(1, 10**9):
            return True
    return False


_TABLE: dict[str, dict[str, Predicate]] = {
    "answers.combination": {
        "generic": lambda facts: bool(facts.inputs),
        "named": lambda facts: not facts.inputs,
    },
    "model.distance": {
        "spring": lambda facts: _of_a_spring(facts, several=False),
        "springs": lambda facts: _of_a_spring(facts, several=True),
        "other": lambda facts: not any(_of_a_spring(facts, several) for several in (False, True)),
    },
    "model.component": {"centre": _of_a_centre, "place": lambda facts: "centre" not in facts.inputs},
    "lagrange.constraint_force": {"generic": lasts, "zero": vanishes},
    "model.angular_velocity": {
        "space": _along_space,
        "body": lambda facts: _along_body(facts) and not _along_space(facts),
        "following": lambda facts: not _along_body(facts) and not _along_space(facts),
    },
    "lagrange.constraint_rate": {
        "in_rates": lambda facts: _has_rates(facts.inputs["condition"]),
        "in_coordinates": lambda facts: not _has_rates(facts.inputs["condition"]),
    },
    "lagrange.multiplier": {
        "generic": lambda facts: lasts(facts) and not _is_stretched(facts),
        "multiplier": lambda facts: lasts(facts) and _is_stretched(facts),
        "zero": vanishes,
    },
    "lagrange.acceleration": {"generic": lasts, "zero": vanishes},
    "lagrange.applied_force": {"generic": lasts, "zero": vanishes},
    "lagrange.forced_equation": {
        "applied": lambda facts: _has_applied(facts) and not _has_kept(facts),
        "kept": lambda facts: _has_kept(facts) and not _has_applied(facts),
        "both": lambda facts: _has_kept(facts) and _has_applied(facts),
        "free": lambda facts: not _has_kept(facts) and not _has_applied(facts),
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
