"""The second route of Newton's equations: Lagrange's equations for a displacement in which only one body moves.

Each of Lagrange's equations is multiplied by the change of its coordinate in this displacement. The sum is the equation
of motion of this body. Lagrange's equations come from the energies, the generalized forces and the derivatives of the
constraints, not from sums of forces on one body.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from sympy import Add, Expr, Integer, Symbol

from derive.algebra.expressions import Relation, explicit
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.lagrange.applied_forces import ForcedMotion
from derive.mechanics.lagrange.lagrangian import equation_of_motion, lagrangian
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.model.system import System
from derive.steps.record import unrecorded
from derive.steps.step import Fact, Quantity


@dataclass(frozen=True)
class MovedAlone(Fact):
    """The changes of the coordinates in the displacement that belongs to a law. The sum of Lagrange's equations, each
    times the change of its coordinate, is this law. For a law of one body, only this body moves in the displacement.
    """

    missing = "is not a law of one body"
    changes: tuple[tuple[Symbol, Expr], ...]


@lru_cache(maxsize=16)  # each equation of motion needs the Lagrangian of its system
def lagrangian_behind(system: System) -> Quantity:
    """The Lagrangian of a system, for second routes; it is not shown."""
    with unrecorded():
        return lagrangian(system)


def facts_of_motion(system: System, q: Coordinate, changes: Mapping[Symbol, Expr]) -> list[Fact]:
    """The facts that later steps need about an equation of motion. These are its coordinate, the displacement that
    belongs to the equation, and the Lagrangian, mass points, forces, constraints and description of its system."""
    of = lagrangian_behind(system)
    kept = of.fact(Constrained)
    found: list[Fact] = [OfCoordinate(q), ForcedMotion(of), of.needed(Matter), system.described]
    found.append(MovedAlone(tuple(changes.items())))
    return [*found, *([kept] if kept is not None else [])]


def virtual_work(of: Quantity, changes: Mapping[Symbol, Expr]) -> Relation:
    """The sum of Lagrange's equations, each times the change of its coordinate."""
    with unrecorded():
        equations = {q: equation_of_motion(of, Coordinate(q, of.coordinates[q]), derivatives=False) for q in changes}
    terms = [change * explicit(equations[q].value).residual for q, change in changes.items()]
    return Relation(Add(*terms), "=", Integer(0))
