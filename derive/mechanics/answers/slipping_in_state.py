"""The friction and the normal force of a contact in one state: the same results and values are substituted in both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Expr, Symbol

from derive.algebra.expressions import Relation, explicit, rate
from derive.errors import Complaint, Rejected
from derive.mechanics.answers.substitution import NONE, check_values_used, put_in
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Letter, Values, in_results
from derive.mechanics.lagrange.facts import ForceOf, KeptMomentum
from derive.mechanics.motion.slipping import slips
from derive.mechanics.motion.static_friction import static_friction
from derive.solving.unknowns import with_unknown
from derive.steps.record import established
from derive.steps.step import Quantity

__all__: list[str] = []


@in_results(
    "slips",
    "the condition |F| <= mu_s N for static friction to suffice; if the forces contain a result of `speed`, the first "
    "place of the motion where static friction does not suffice",
    friction="slips: the static friction of a contact",
    letter="for: a letter, or a function of a letter such as `tan(alpha)`",
    results="results: answers substituted in the friction and in the normal force",
    values="values: `{theta_dot: 0}`, substituted in both forces",
)
def _in_results(
    friction: Quantity, letter: Letter, key: str, results: Sequence[Quantity] = (), values: Values = NONE
) -> tuple[Quantity, ...]:
    limit = static_friction(friction).limit
    assert limit is not None
    normal = _beside(friction, limit.normal)
    _check_used(friction, normal, results, values)
    held, pushed = (_in_state(force, results, values, key) for force in (friction, normal))
    return checked(slips)(held, pushed, letter, key=key)


def _state(force: Quantity) -> Any:
    """Return the linear equations from which the force was solved. If the force was not solved from linear equations,
    return the rule and the inputs of its step."""
    fact = force.fact(ForceOf)
    return fact.problem if fact is not None else (force.step.rule, force.step.inputs)


def _beside(friction: Quantity, letter: Symbol) -> Quantity:
    state = _state(friction)
    for each in established():
        if each.symbol == letter and _state(each) == state:
            return each
    message = f"`slips`: `{friction.key}` is the friction in one state, but the normal force in this state is unknown"
    help_line = f"give `slips: {friction.symbol}` with the `results` and `values` of the state"
    raise Rejected(Complaint("wrong-argument", message, help=help_line))


def _in_state(force: Quantity, results: Sequence[Quantity], values: Mapping[str, Expr], key: str) -> Quantity:
    """Return the force with the results and values substituted. If an earlier step made the same substitution, return
    this step; if the substitution changes nothing, return the force."""
    kept, state = _with_effect(force, results, values)
    for each in established():
        if each.step.rule == "answers.put_in" and each.symbol == force.symbol and force in each.parents:
            there = {said.left.name: said.right for role, said in each.step.roles if role.startswith("value_")}
            if [one for one in each.parents if one is not force] == kept and there == state:
                return each
    return checked(put_in)(force, *kept, key=f"{key}_{force.symbol}", **state) if kept or state else force


def _with_effect(
    force: Quantity, results: Sequence[Quantity], values: Mapping[str, Expr]
) -> tuple[list[Quantity], dict[str, Expr]]:
    value, kept = explicit(force.value), []
    for each in results:
        if (changed := with_unknown(value, *_replaced_by(each))) != value:
            value = changed
            kept.append(each)
    letters = {letter.name for letter in value.free_symbols}
    return kept, {name: at for name, at in values.items() if name in letters}


def _replaced_by(result: Quantity) -> tuple[Expr, Expr]:
    momentum = result.fact(KeptMomentum)
    if momentum is not None:
        return rate(momentum.coordinate), momentum.turning
    left, right = result.value.sides if isinstance(result.value, Relation) else (result.symbol, result.value)
    return explicit(left), explicit(right)


def _check_used(friction: Quantity, normal: Quantity, results: Sequence[Quantity], values: Mapping[str, Expr]) -> None:
    """Reject results that change neither force, and values that can have no effect."""
    used = [one for force in (friction, normal) for one in _with_effect(force, results, values)[0]]
    for each in results:
        if each not in used:
            message = f"`slips`: the result `{each.key}` would change neither the friction nor the normal force"
            raise Rejected(Complaint("unused-value", message, help="leave it out", argument="results"))
    letters = {s.name for each in (friction, normal, *results) for s in explicit(each.value).free_symbols}
    check_values_used(friction.key, values, letters)
