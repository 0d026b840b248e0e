"""The slab that rocks on a cylinder as the book's tests know it, and everything that can be derived of it."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any

from sympy import symbols

from derive.steps.step import Quantity
from tests.mechanics.block import with_what_they_rest_on
from tests.mechanics.verbs import verbs_as_imported

R, a, M, I, g = symbols("R a M I g", positive=True)


def slab_derivation(
    verbs: SimpleNamespace, radius: Any = R, thickness: Any = a, mass: Any = M, inertia: Any = I, gravity: Any = g
) -> dict[str, Quantity]:
    """Every quantity of the slab, by key; where no letter decides the stability there is no bound."""
    theta = verbs.coordinate("theta")
    x, y = verbs.rolled_centre(radius, thickness / 2, theta)
    T = verbs.plane_kinetic_energy(mass, (verbs.rate_of(x), verbs.rate_of(y)), (x, y), inertia, theta)
    U = verbs.weight_energy(mass, gravity, (x, y))
    L = verbs.lagrangian(T, U)
    motion = verbs.equation_of_motion(L, theta)
    squared = verbs.frequency_squared(verbs.linearised(motion))
    stable = verbs.positive_where(squared, radius, key="stability")
    minimum = verbs.positive_where(verbs.curvature_at(verbs.slope(U, 2)), radius, key="minimum")
    balanced = verbs.leading_order(U, where=verbs.boundary_case(minimum))

    free_x, free_y = verbs.coordinate("x", "length"), verbs.coordinate("y", "length")
    ties = (verbs.tie(free_x, x), verbs.tie(free_y, y))
    free = verbs.free_lagrangian(mass, gravity, inertia, (free_x, free_y), theta)
    equations = [verbs.equation_with_multipliers(free, q, ties) for q in (free_x, free_y, theta)]
    forces = tuple(verbs.force_of_constraint(equation, t) for equation, t in zip(equations, ties, strict=False))
    again = verbs.multipliers_eliminated(equations[2], forces, motion)
    contact = verbs.contact_forces(forces, (x, y), theta, motion)
    answers = [motion, verbs.frequency(squared), stable, verbs.slope(U), minimum, balanced, again, *contact]
    return with_what_they_rest_on(answers)


@cache
def known_slab(**variant: Any) -> dict[str, Quantity]:
    """The slab by the laws as they are; derived once for all tests."""
    return slab_derivation(verbs_as_imported(), **variant)
