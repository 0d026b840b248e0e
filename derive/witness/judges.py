"""Which test belongs to the steps of which rule."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

from sympy import Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Relation
from derive.steps.outcomes import Judged
from derive.steps.step import Quantity
from derive.witness import along, runs, small
from derive.witness.claim import Claim
from derive.witness.description import Description
from derive.witness.dynamics import Blueprint
from derive.witness.tape import NotComputable

Judge = Callable[[Claim], Verdict | None]

JUDGES: Mapping[str, Judge] = {
    **dict.fromkeys(along.OF_MOTION, along.equation),
    "systems.kinetic_energy": along.kinetic_energy,
    "solving.solved_for": along.equation,
    "substitution.put_in": along.substitution,
    "energy.energy_function": along.conserved,
    "effective.conserved": along.conserved,
    "symmetry.noether": along.conserved,
    "energy_integral.energy_kept": along.kept,
    "energy_integral.speed_from_energy": runs.speed,
    "conditions.leaves_contact": runs.leaves,
    "linear_motion.solution": runs.solution,
    "equilibria.rest": small.rest,
    "minima.stability": small.stability,
    "minima.stability_on_constraints": small.stability,
    "minima.stability_of_several": small.stability,
    "modes.frequency": small.frequency,
    "oscillations.frequency": small.frequency,
    "gyroscopic.frequency": small.frequency,
    "damped.rate": small.damped,
    "damped.frequency": small.damped,
    "superposition.motion": small.motion,
    "energy_integral.period_by_energy": runs.period,
    "numbers.value": runs.period,
}


@lru_cache(maxsize=8)  # every step of a problem asks for its system
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
    """The verdict on a step; nothing where a formula cannot be computed, so that nothing was witnessed."""
    try:
        claim = Claim(quantity, judged, outcome, blueprint(description), momenta, tuple(assumed))
        return None if claim.is_approximate else judge(claim)
    except NotComputable:
        return None
