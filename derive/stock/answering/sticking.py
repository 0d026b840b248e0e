"""The condition under which static friction suffices; the page assumes this condition if no step derives it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sympy import Abs, Add, Expr, sqrt

from derive.algebra.expressions import Factors, Relation, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics import slips
from derive.mechanics.model.constraint import Constraint, StaticLimit
from derive.steps.record import assume, changes, established, named_coordinates
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

SLIPS, DERIVED = "motion.slips", {"lagrange.multiplier", "lagrange.acceleration"}


def state_static_friction(contact: Sequence[Constraint], answer: Callable[[str, str], Quantity]) -> None:
    """Assume |F| <= mu_s N for a contact with static friction, if no step of the page derives this condition.

    contact   the constraints that the friction of the contact enforces: one in a plane, one or two in space
    answer    a function of the name of an answer and of the key of one of its steps; it returns this step

    The condition is solved for mu_s if possible. Errors: the condition is known to be false.
    """
    steps, limit, forces = established(), contact[0].limit, [each.force for each in contact]
    if limit is None or any(each.step.rule == SLIPS and forces[0] in _names(each) for each in steps):
        return
    if any(each.step.rule in DERIVED for each in steps):
        found = [answer("multipliers", force.name) for force in forces]
        _assume_solved(found, answer("multipliers", limit.normal.name), limit)
    else:
        _assume_letters(forces, limit)


def _names(step: Quantity) -> tuple[object, ...]:
    return tuple(dict(step.step.roles).values())


def _assume_letters(forces: Sequence[Expr], limit: StaticLimit) -> None:
    size = Abs(forces[0]) if len(forces) == 1 else sqrt(Add(*(force**2 for force in forces)))
    normal = Abs(limit.normal) if limit.of_rail else limit.normal
    assume(Relation(size, "<=", Factors(limit.coefficient, normal)))


def _assume_solved(frictions: Sequence[Quantity], normal: Quantity, limit: StaticLimit) -> None:
    symbols = [friction.symbol for friction in frictions]
    if limit.in_space or limit.of_rail and sign_known(explicit(normal.value)) != 1:
        _assume_if_unknown(frictions, normal, limit)
        return
    friction = frictions[0]
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
        _assume_letters(symbols, limit)


def _assume_if_unknown(frictions: Sequence[Quantity], normal: Quantity, limit: StaticLimit) -> None:
    """Assume that the magnitude of the friction is at most mu_s |N|, unless this is known to be true. Reject the motion
    if this is known to be false."""
    square = tidied(Add(*(explicit(friction.value) ** 2 for friction in frictions)))
    most = limit.coefficient**2 * explicit(normal.value) ** 2
    excess = sign_known(tidied(square - most))
    if excess == 1:
        message = f"the body slips: the square of the static friction is at most {most}, but the motion needs {square}"
        raise Rejected(Complaint("contradiction", message))
    if excess is None:
        _assume_letters([friction.symbol for friction in frictions], limit)


def _conditions(friction: Quantity, normal: Quantity, limit: StaticLimit) -> list[Relation]:
    """Return the conditions for mu_s; none if the forces change during the motion, or if mu_s is a number."""
    if changes(explicit(friction.value) - explicit(normal.value), named_coordinates()) or limit.coefficient.is_number:
        return []
    return [each.value for each in slips(friction, normal, limit.coefficient, key=f"{friction.key}_suffices")]
