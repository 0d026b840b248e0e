"""The condition under which static friction suffices; the page assumes this condition if no step derives it."""

from __future__ import annotations

from collections.abc import Callable

from sympy import Abs, Symbol

from derive.algebra.expressions import Factors, Relation, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics import slips
from derive.mechanics.model.constraint import Constraint, StaticLimit
from derive.steps.record import assume, changes, established, named_coordinates
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

SLIPS, DERIVED = "motion.slips", {"lagrange.multiplier", "lagrange.acceleration"}


def state_static_friction(contact: Constraint, answer: Callable[[str, str], Quantity]) -> None:
    """Assume |F| <= mu_s N for a contact with static friction, if no step of the page derives this condition.

    contact   the constraint of a contact with static friction
    answer    a function of the name of an answer and of the key of one of its steps; it returns this step

    Nothing is assumed if the derived forces are known to satisfy the condition. The condition is solved for mu_s if
    possible.
    Errors: the condition is known to be false.
    """
    steps, limit = established(), contact.limit
    if limit is None or any(each.step.rule == SLIPS and contact.force in _names(each) for each in steps):
        return
    if any(each.step.rule in DERIVED for each in steps):
        _assume_solved(answer("multipliers", contact.force.name), answer("multipliers", limit.normal.name), limit)
    else:
        _assume_letters(contact.force, limit)


def _names(step: Quantity) -> tuple[object, ...]:
    return tuple(dict(step.step.roles).values())


def _assume_letters(force: Symbol, limit: StaticLimit) -> None:
    assume(Relation(Abs(force), "<=", Factors(limit.coefficient, limit.normal)))


def _assume_solved(friction: Quantity, normal: Quantity, limit: StaticLimit) -> None:
    F, most = explicit(friction.value), limit.coefficient * explicit(normal.value)
    side = sign_known(F)
    excess = sign_known(side * F - most) if side is not None else None
    if side is not None and excess == 1:
        message = f"the body slips: static friction is at most {most}, but the motion needs {tidied(side * F)}"
        help_line = "describe sliding friction, `{sliding: mu, direction: [1, 0]}`"
        raise Rejected(Complaint("contradiction", message, help=help_line))
    if side == 0 or excess is not None:
        return
    conditions = _conditions(friction, normal, limit)
    if len(conditions) == 1:
        assume(conditions[0])
    else:
        _assume_letters(friction.symbol, limit)


def _conditions(friction: Quantity, normal: Quantity, limit: StaticLimit) -> list[Relation]:
    """Return the conditions for mu_s, one for each possible direction of the friction; none if they cannot be solved
    for mu_s."""
    if changes(explicit(friction.value) - explicit(normal.value), named_coordinates()) or limit.coefficient.is_number:
        return []
    return [each.value for each in slips(friction, normal, limit.coefficient, key=f"{friction.key}_suffices")]
