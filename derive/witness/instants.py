"""Tests of statements that hold at each instant of a motion: equations of motion, multipliers, conserved quantities.

A test returns None if nothing could be tested.
"""

from __future__ import annotations

import numpy as np
from sympy import Expr

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Relation, explicit
from derive.steps.step import Quantity
from derive.witness.claim import CLOSE, PUT_IN, Claim, seen
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction

OF_MOTION = frozenset(
    [
        "lagrange.equation_of_motion",
        "lagrange.forced_equation",
        "lagrange.acceleration",
        "lagrange.constraint_force",
        "lagrange.constraint_rate",
        "lagrange.multiplier",
        "newton.second_law",
        "newton.torque_law",
        "hamilton.rate_by_momenta",
    ]
)
PASSED_ON = frozenset([PUT_IN, "answers.solved_for"])  # rules whose results hold at each instant if their inputs do
CONSERVED = frozenset(["energy", "conserved", "given_conserved"])


def holds_along(step: Quantity) -> bool:
    """Whether a step states something about each instant of a motion, by its rule and the rules of its parents."""
    if step.step.rule in OF_MOTION:
        return True
    if step.step.rule not in PASSED_ON:
        return False
    roles = [role for role, _ in step.step.roles]
    count = 1 if "original" in roles else sum(role.startswith("equation_") for role in roles)
    return bool(step.parents) and all(holds_along(parent) for parent in step.parents[:count])


def equation(claim: Claim) -> Verdict | None:
    """Test whether the two sides of an equation are equal at each instant."""
    residuals = claim.residuals
    if not residuals or not holds_along(claim.quantity):
        return None
    scales = [_terms(residual) for residual in residuals]
    count = 0
    for trial in claim.trials():
        formulas = trial.formulas([*residuals, *(term for terms in scales for term in terms)])
        for state, response in claim.moments(trial):
            found = formulas.at(state, response)
            left, sizes = found[: len(residuals)], np.abs(found[len(residuals) :])
            if not np.all(np.isfinite(found)):
                continue
            if np.max(np.abs(left)) > CLOSE * (1e-3 + float(np.sum(sizes))):
                return claim.refuted("the equation does not hold in the described motion", trial, state)
            count += 1
    return seen(count, "states")


def substitution(claim: Claim) -> Verdict | None:
    """Test whether substituted rates agree with the constraints, and whether the equation holds with the substituted
    values."""
    contradiction = _fits_together(claim)
    return equation(claim) if contradiction is None else contradiction


def _fits_together(claim: Claim) -> Verdict | None:
    """Refute given values of rates that contradict the constraints; None if there is no such contradiction."""
    letters = {*claim.blueprint.coordinates, *claim.blueprint.rates}
    plain = [each for each in claim.states_given if each.target in letters]
    if not plain or not claim.blueprint.of.conditions:
        return None
    for trial in claim.trials(1):
        try:
            trial.state(plain)
        except Contradiction as contradiction:
            if contradiction.of_rates:
                kept = ", ".join(f"{each.residual} = 0" for each in claim.blueprint.of.conditions)
                return claim.refuted(f"the rates that are substituted contradict the constraints {kept}", trial)
        except NotComputable:
            return None
    return None


def kinetic_energy(claim: Claim) -> Verdict | None:
    """Test whether the value is half the sum of m v . v over all particles of the system."""
    count = 0
    for trial in claim.trials():
        formulas = trial.formulas([claim.value])
        for state, _ in claim.moments(trial):
            (found,), expected = formulas.at(state), trial.dynamics.kinetic_energy(state)
            if abs(found - expected) > CLOSE * (1 + abs(expected)):
                return claim.refuted("the value is not the kinetic energy of the described masses", trial, state)
            count += 1
    return seen(count, "states")


def conserved(claim: Claim) -> Verdict | None:
    """Test whether a value that is stated to be constant does not change along the motion."""
    if claim.rule == "lagrange.energy_function" and claim.outcome not in CONSERVED:
        return None
    if not isinstance(claim.value, Expr) or isinstance(claim.value, Relation):
        return None
    return _unchanging(claim, claim.value)


def kept(claim: Claim) -> Verdict | None:
    """Test whether the left side of an equation of energy conservation stays constant along the motion."""
    return _unchanging(claim, explicit(claim.value).left) if isinstance(claim.value, Relation) else None


def _unchanging(claim: Claim, value: Expr) -> Verdict | None:
    count = 0
    for trial in claim.trials():
        formulas = trial.formulas([value])
        for state, response in claim.moments(trial):
            (changing,) = formulas.rate_at(state, response)
            scale = float(np.max(np.abs(state.v), initial=0.0) + np.max(np.abs(response.a), initial=0.0))
            if np.isfinite(changing) and abs(changing) > CLOSE * 10 * (1 + scale) ** 2:
                return claim.refuted("the value changes along the described motion", trial, state)
            count += 1
    return seen(count, "states")


def _terms(residual: Expr) -> list[Expr]:
    """The terms of a residual, which give the scale of the comparison."""
    terms = list(residual.args) if residual.is_Add else [residual]
    return [part for term in terms for part in ((term.args) if term.is_Add else [term])]
