"""Theorems in general form. A page states a theorem at most once, before the first step that uses this theorem.
A theorem is a formula in symbols. A theorem is not a step, because it is not about a body or system of the problem.
Each step that uses a theorem is checked, and the rule of such a step names the theorem under `quotes`.
`tests/mechanics/test_theorems.py` substitutes bodies and motions into the formulas.
"""

from __future__ import annotations

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
    Relation(scalar("I_zz"), "=", Terms(scalar("I_xx"), scalar("I_yy"))),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    (("x", scalar("x")), ("y", scalar("y"))),
)
ROTATING_AXES = Theorem(
    "rotating_axes",
    Relation(CarriedRate(G, OMEGA), "=", MatAdd(BodyRate(G), Cross(OMEGA, G))),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
    (("any", G), ("turning", OMEGA)),
)
MULTIPLIERS = Theorem(
    "multipliers",
    Relation(INERTIA_AND_FORCE, "=", MULTIPLIER * Partial(CONSTRAINT, q)),  # the right side is summed over k
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    (("coordinate", q), ("multiplier", MULTIPLIER), ("constraint", CONSTRAINT)),
)
MULTIPLIERS_OF_BOTH = Theorem(  # for systems with constraints between coordinates and constraints between rates
    "multipliers_of_both",
    Relation(INERTIA_AND_FORCE, "=", MULTIPLIER * Partial(CONSTRAINT, q)),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    (
        ("coordinate", q),
        ("multiplier", MULTIPLIER),
        ("constraint", CONSTRAINT),
        ("of_rate", MULTIPLIER * Partial(CONSTRAINT, rate(q))),
    ),
)
MULTIPLIERS_OF_RATES = Theorem(  # for systems with constraints between rates only, such as rolling
    "multipliers_of_rates",
    Relation(INERTIA_AND_FORCE, "=", MULTIPLIER * Partial(CONSTRAINT, rate(q))),
    "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    (("coordinate", q), ("multiplier", MULTIPLIER), ("constraint", CONSTRAINT)),
)
