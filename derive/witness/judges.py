"""The rules whose steps the witness tests on a motion, each with its test; the module `impact` tests impacts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from sympy import Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Relation
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness import instants, runs, small_motions
from derive.witness.claim import Claim
from derive.witness.description import Description, with_functions
from derive.witness.dynamics import Blueprint
from derive.witness.tape import NotComputable

Judge = Callable[[Claim], Verdict | None]

JUDGES: Mapping[str, Judge] = {
    **dict.fromkeys(instants.OF_MOTION, instants.equation),
    "lagrange.kinetic_energy": instants.kinetic_energy,
    "answers.solved_for": instants.equation,
    "answers.put_in": instants.substitution,
    "lagrange.energy_function": instants.conserved,
    "hamilton.conserved": instants.conserved,
    "lagrange.noether": instants.conserved,
    "motion.energy_kept": instants.kept,
    "motion.speed_from_energy": runs.speed,
    "motion.leaves_contact": runs.leaves,
    "motion.slips": runs.slips,
    "motion.free_flight": runs.flight,
    "motion.landing_time": runs.landing,
    "vibrations.solution": runs.solution,
    "rest.equilibrium": small_motions.rest,
    "rest.stability": small_motions.stability,
    "rest.stability_on_constraints": small_motions.stability,
    "rest.stability_of_several": small_motions.stability,
    "vibrations.mode_frequency": small_motions.frequency,
    "vibrations.uncoupled_frequency": small_motions.frequency,
    "vibrations.frequency": small_motions.frequency,
    "vibrations.gyroscopic_frequency": small_motions.frequency,
    "vibrations.damped_rate": small_motions.damped,
    "vibrations.damped_frequency": small_motions.damped,
    "vibrations.superposition": small_motions.motion,
    "motion.period_by_energy": runs.period,
    "numeric.value": runs.period,
}


@lru_cache(maxsize=8)  # most steps of a problem need the same system
def blueprint(description: Description) -> Blueprint:
    return Blueprint(description)


def testimony(
    judge: Judge,
    description: Description,
    quantity: Quantity,
    judged: Judged,
    outcome: str,
    momenta: Mapping[Symbol, Symbol],
    assumed: Sequence[Relation],
) -> Verdict | None:
    """The verdict on a step; None if nothing was tested, for example because the step is approximate."""
    try:
        claim = Claim(quantity, judged, outcome, blueprint(description), momenta, tuple(assumed))
        if functions := claim.functions_given:
            own = blueprint(with_functions(description, functions))
            claim = replace(claim, blueprint=own, functions=functions)
        return None if claim.is_approximate else judge(claim)
    except NotComputable:
        return None
