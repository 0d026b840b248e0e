"""Which second ways to a result go another way through the physics, and which only put the result to a test.

A *route* would see a wrong law: it starts from other physics (particles for an integral, d'Alembert's principle for
Lagrange's equation, a vector that is carried round for a cross product). A *check* starts from the result or from the
same formula, and would see a slip: a root put back, a number evaluated anew, a sign beside a bound, an identity of
algebra. Claims are told by their names, and where one name means different things the rule decides. A claim of which
nothing is said counts as a check, which claims less; a rule of the house has each decided.
"""

from __future__ import annotations

from derive.algebra.equality import Compared

ROUTES = frozenset(
    [
        "all_coordinates",  # d'Alembert's principle to first order, in every coordinate
        "along_the_motion",
        "along_the_shift",
        "angle",
        "any_axes",
        "axis",
        "balance",
        "by_degree",
        "canonical",
        "carried",
        "carried_along",
        "carried_round",
        "chords",
        "conserved",
        "deflection",
        "energies",
        "energy",
        "energy_identity",
        "fixed_direction",
        "forces",
        "given_along_the_shift",
        "given_carried_along",
        "given_forces",
        "given_places",
        "given_second_order",
        "given_virtual_work",
        "given_work",
        "impulses",
        "integration",
        "known",  # by a derivation of its own
        "linearised",
        "mass_points",
        "matter",
        "moments",
        "newton",
        "opposite",
        "pappus",
        "particles",
        "parts",
        "places",
        "power",
        "rayleigh",
        "rotation_matrix",
        "second_moments",
        "second_order",
        "small_force",
        "speeds",
        "trial",
        "virtual_work",
        "work",
    ]
)
CHECKS = frozenset(
    [
        "any_direction",
        "arithmetic",  # power series added, multiplied and divided
        "at_once",
        "at_rest",
        "axis_by_axis",
        "balanced",
        "beside",
        "border",
        "constraint",
        "counted",
        "definition",
        "derivatives",
        "determinant",
        "differentiated",
        "divided",
        "edge",
        "edges",
        "elimination",
        "expanded",
        "floats",
        "followed",
        "found_before",
        "functions_of_time",
        "given_along_the_motion",  # the first order of the Lagrangian: the same derivative
        "given_canonical",
        "given_carried",
        "given_matter",
        "in_numbers",
        "invariants",
        "law",
        "law_of_cosines",  # identities of the same two vectors
        "length",
        "lowest",
        "mass_given_back",
        "momenta",
        "motion",
        "no_force",
        "no_more",
        "not_negative",
        "numbers",
        "on_the_way",
        "once_round",
        "one_by_one",
        "orthogonal",
        "other_form",
        "other_way",  # what was compared
        "otherwise",
        "parallel",
        "perpendicular",
        "points",
        "positive",
        "product",
        "put_back",
        "quadrature",  # summed over cells in numbers
        "quarter_turn_on",
        "resultant",
        "right_handed",
        "rules",
        "sign",
        "sine",
        "size",
        "slope",
        "start",
        "stretched",
        "sum",
        "sum_of_squares",
        "there_and_back",
        "tangent",
        "trace",
        "triangle",
        "turned",
        "unit",
        "velocity",
        "vieta",
        "along",
    ]
)
# Where a rule means something else by a name than the others do.
OTHERWISE = {
    ("hamilton.poisson_bracket", "given_along_the_motion"): Compared.ROUTE,  # the varied action
    ("motion.rate_under", "functions_of_time"): Compared.ROUTE,  # by Euler's equations, not by their sum
    ("lagrange.value_kept", "given_along_the_motion"): Compared.ROUTE,
    ("lagrange.energy_function_rate", "given_along_the_motion"): Compared.ROUTE,
    ("motion.energy_kept", "motion"): Compared.ROUTE,
    ("motion.speed_from_energy", "motion"): Compared.ROUTE,
    ("vibrations.gyroscopic_characteristic", "quadrature"): Compared.ROUTE,  # cosines and sines, not complex amplitudes
    ("vibrations.gyroscopic_stability", "quadrature"): Compared.ROUTE,
    ("lagrange.lagrangian", "energy"): Compared.CHECK,  # the energy function of the same T and U
    ("lagrange.generalized_force", "given_virtual_work"): Compared.CHECK,  # the first order of the Lagrangian
    ("rest.stability_on_constraints", "along_curves"): Compared.ROUTE,  # without multipliers
    ("rest.stable_where", "energies"): Compared.CHECK,  # in numbers
    ("model.no_slip", "at_rest"): Compared.ROUTE,
}


def is_decided(rule: str, claim: str) -> bool:
    """Whether it is said of this claim what it is."""
    return (rule, claim) in OTHERWISE or claim in ROUTES | CHECKS


def sort_of(rule: str, claim: str) -> Compared:
    """What a claim of a rule is evidence of: another route through the physics, or a check."""
    return OTHERWISE.get((rule, claim), Compared.ROUTE if claim in ROUTES else Compared.CHECK)
