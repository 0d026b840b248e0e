"""The condition under which a surface pushes and a string pulls; the page assumes this condition if no step derives
it."""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Expr

from derive.algebra.expressions import Relation, depends_on_time, explicit
from derive.mechanics.lagrange.constraint_forces import ONE_SIDED
from derive.mechanics.lagrange.facts import ForceOf
from derive.mechanics.model.constraint import Constraint
from derive.solving.relations import positive
from derive.steps.record import assume, coordinates_in, established
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

EXAMINED = ("answers.where", "motion.leaves_contact")  # the rules of steps that find where a force is positive


def state_one_sided(constraints: Iterable[Constraint]) -> None:
    """Assume that each constant force of a surface or a string is positive, unless its sign is known or a step of the
    page examines this sign."""
    steps = established()
    for each in (each for each in constraints if each.enforcer in ONE_SIDED):
        found = [step for step in steps if step.symbol == each.force]
        examined = (step.ancestors() for step in steps if step.step.rule in EXAMINED)
        if any(step.symbol == each.force for ancestors in examined for step in ancestors):
            continue
        for value in (explicit(step.value) for step in found if is_of_constraint(step)):
            if not coordinates_in(value) and not depends_on_time(value) and sign_known(value) is None:
                condition = positive(value)
                assume(condition if condition.right != 0 else Relation(each.force, ">", condition.right))


def is_of_constraint(step: Quantity) -> bool:
    """Whether a step derives a constraint force, for a motion or at rest."""
    return isinstance(step.value, Expr) and (step.fact(ForceOf) is not None or step.key == f"rest_{step.symbol}")
