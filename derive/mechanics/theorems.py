"""Theorems in their general form, which a page tells once, before the first step that uses one.

Each is a formula of names: no step, since it is about no body or system of the problem; what a step makes of it is
checked there. `tests/mechanics/test_theorems.py` puts bodies and motions into the formulas.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from sympy import Expr, MatAdd, Symbol

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

__all__ = ["THEOREMS", "Theorem"]

M, r, q = Symbol("M", positive=True), Symbol("r", positive=True), scalar("q")
G, OMEGA = vector("G"), vector("omega")
L, MULTIPLIER, CONSTRAINT = scalar("L"), scalar("lambda_k"), scalar("f_k")
INERTIA_AND_FORCE = Terms(TimeRate(Partial(L, rate(q))), -Partial(L, q))  # the left side of Lagrange's equation


@dataclass(frozen=True)
class Theorem:
    """A theorem that a phrase tells by its name.

    formula      what it says
    letters      what else the phrase names
    used_by      rules of the steps that use it, each with the outcomes in which it does; none for all of them
    source       book and section
    between      what the word `between` of those steps must be, where it matters
    prepared_by  rule of the steps on which those rest, before which it is told; unless given it is told before them
    law_of       rules of the steps of which it is the law, so that they need not write it once more
    """

    name: str
    formula: Relation | Expr
    used_by: Mapping[str, frozenset[str]]
    source: str
    letters: Mapping[str, Any] = field(default_factory=dict)
    between: frozenset[str] = frozenset()
    prepared_by: str | None = None
    law_of: frozenset[tuple[str, str]] = frozenset()

    def is_used_by(self, rule: str, outcome: str, between: str = "") -> bool:
        fits = rule in self.used_by and (not self.used_by[rule] or outcome in self.used_by[rule])
        return fits and (not self.between or between in self.between)


ALWAYS: frozenset[str] = frozenset()
PLAIN, WITH_FORCES = "lagrange.equation_of_motion", "lagrange.forced_equation"

THEOREMS = (
    Theorem(
        "parallel_axes",
        Relation(
            scalar("J_ij"),
            "=",
            Terms(
                scalar("I_ij"),
                Factors(M, Terms(Factors(r**2, scalar("delta_ij")), -scalar("r_i") * scalar("r_j"))),
            ),
        ),
        {
            # Of one axis the sentence of the step says it.
            "rotation.entry_moved": frozenset({"moment", "product", "outward"}),
            "rotation.tensor_of_part": frozenset({"moved", "turned_moved"}),
        },
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
        {"total": scalar("J_ij"), "centre": scalar("I_ij"), "way": vector("r")},
    ),
    Theorem(
        "perpendicular_axes",
        Relation(scalar("I_zz"), "=", Terms(scalar("I_xx"), scalar("I_yy"))),
        {"rotation.own_moment": frozenset({"flat"})},
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
        {"x": scalar("x"), "y": scalar("y")},
    ),
    Theorem(
        "rotating_axes",
        Relation(CarriedRate(G, OMEGA), "=", MatAdd(BodyRate(G), Cross(OMEGA, G))),
        {"rotation.rate_in_space": ALWAYS, "rotation.torque": ALWAYS},
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
        {"any": G, "turning": OMEGA},
    ),
    Theorem(
        "lagrange",
        Relation(INERTIA_AND_FORCE, "=", 0),
        {PLAIN: ALWAYS},
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4",
        {"coordinate": q},
        prepared_by="lagrange.generalized_force",
        law_of=frozenset({(PLAIN, "generic"), (PLAIN, "cyclic")}),
    ),
    Theorem(
        "multipliers",
        Relation(INERTIA_AND_FORCE, "=", MULTIPLIER * Partial(CONSTRAINT, q)),  # summed over k
        {WITH_FORCES: frozenset({"kept", "both"})},
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
        {"coordinate": q, "multiplier": MULTIPLIER, "constraint": CONSTRAINT},
        between=frozenset({"coordinates", "both"}),
        law_of=frozenset({(WITH_FORCES, "kept")}),
    ),
    Theorem(
        "multipliers_of_rates",
        Relation(INERTIA_AND_FORCE, "=", MULTIPLIER * Partial(CONSTRAINT, rate(q))),  # as of rolling
        {WITH_FORCES: frozenset({"kept", "both"})},
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
        {"coordinate": q, "multiplier": MULTIPLIER, "constraint": CONSTRAINT},
        between=frozenset({"rates", "both"}),
        law_of=frozenset({(WITH_FORCES, "kept")}),
    ),
)
