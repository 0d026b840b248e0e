"""The second route of Newton's equations: Lagrange's equations for the displacement of one body alone.

In a displacement of one body alone, the sum of Lagrange's equations times the changes of their coordinates is the
equation of this body. Lagrange's equations come from the energies and from the derivatives of the constraints, and not
from forces on bodies.
"""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Add, Expr, Integer, Symbol

from derive.algebra.expressions import Relation, explicit
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.lagrange.applied_forces import ForcedMotion
from derive.mechanics.lagrange.lagrangian import equation_of_motion, lagrangian
from derive.mechanics.model.system import System
from derive.steps.step import Quantity


def lagrangian_behind(system: System) -> Quantity:
    """The Lagrangian of a system, for second routes; it is not shown."""
    return lagrangian(system)


def virtual_work(of: Quantity, changes: Mapping[Symbol, Expr]) -> Relation:
    """The sum of Lagrange's equations, each times the change of its coordinate."""
    total: Expr = Integer(0)
    for q, change in changes.items():
        own = equation_of_motion(of, Coordinate(q, of.coordinates[q]), f"lagrange_{q.name}", derivatives=False)
        total = Add(total, change * explicit(own.value).residual)
    return Relation(total, "=", Integer(0))


def same_motion(of: Quantity) -> ForcedMotion:
    """The fact with which `accelerations` and `multipliers` find the masses, forces and constraints of an equation."""
    return ForcedMotion(of)
