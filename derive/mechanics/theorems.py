"""Theorems in general form. A page states a theorem at most once, before the first step that uses this theorem.
A theorem is a formula in symbols. A theorem is not a step, because it is not about a body or system of the problem.
Each step that uses a theorem is checked, and the rule of such a step names the theorem under `quotes`.
`tests/mechanics/test_theorems.py` substitutes bodies and motions into the formulas.
"""

from __future__ import annotations

from typing import Any

from sympy import MatAdd, Symbol

from derive.algebra.expressions import (
    BodyRate,
    CarriedRate,
    Cross,
    Factors,
    Partial,
    Relation,
    Terms,
    TimeRate,
    rate,
    scalar,
    vector,
)
from derive.steps.rule import Theorem

M, r, q = Symbol("M", positive=True), Symbol("r", positive=True), scalar("q")
G, OMEGA = vector("G"), vector("omega")
L, MULTIPLIER, CONSTRAINT = scalar("L"), scalar("lambda_k"), scalar("f_k")
ONE_MULTIPLIER, ONE_CONSTRAINT = scalar("lambda"), scalar("f")  # for a system with one constraint
INERTIA_AND_FORCE = Terms(TimeRate(Partial(L, rate(q))), -Partial(L, q))  # the left side of Lagrange's equation

PARALLEL_AXES = Theorem(
    "parallel_axes",
    Relation(
        scalar("J_ij"),
        "=",
        Terms(scalar("I_ij"), Factors(M, Terms(Factors(r**2, scalar("delta_ij")), -scalar("r_i") * scalar("r_j")))),
    ),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    (("total", scalar("J_ij")), ("centre", scalar("I_ij")), ("way", vector("r"))),
)
PERPENDICULAR_AXES = Theorem(
    "perpendicular_axes",
    Relation(scalar("I_z"), "=", Terms(scalar("I_x"), scalar("I_y"))),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    (("x", scalar("x")), ("y", scalar("y"))),
)
ROTATING_AXES = Theorem(
    "rotating_axes",
    Relation(CarriedRate(G, OMEGA), "=", MatAdd(BodyRate(G), Cross(OMEGA, G))),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
    (("any", G), ("turning", OMEGA)),
)


def _of_multipliers(name: str, multiplier: Symbol, constraint: Symbol, along: Any, further: bool = False) -> Theorem:
    """Return the theorem about Lagrange's equation with constraints. The right side is one term of a sum over all
    constraints.

    along     the coordinate or the rate with respect to which the constraint is differentiated
    further   whether the phrase also names the force of a constraint between rates
    """
    letters = (("coordinate", q), ("multiplier", multiplier), ("constraint", constraint))
    return Theorem(
        name,
        Relation(INERTIA_AND_FORCE, "=", multiplier * Partial(constraint, along)),
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
        (*letters, ("of_rate", multiplier * Partial(constraint, rate(q)))) if further else letters,
    )


MULTIPLIER_OF_ONE = _of_multipliers("multiplier_of_one", ONE_MULTIPLIER, ONE_CONSTRAINT, q)
MULTIPLIER_OF_ONE_RATE = _of_multipliers("multiplier_of_one_rate", ONE_MULTIPLIER, ONE_CONSTRAINT, rate(q))
MULTIPLIERS = _of_multipliers("multipliers", MULTIPLIER, CONSTRAINT, q)
# constraints between coordinates, and constraints between rates
MULTIPLIERS_OF_BOTH = _of_multipliers("multipliers_of_both", MULTIPLIER, CONSTRAINT, q, further=True)
# constraints between rates only, such as rolling
MULTIPLIERS_OF_RATES = _of_multipliers("multipliers_of_rates", MULTIPLIER, CONSTRAINT, rate(q))
