"""The slab that rocks on a cylinder as the book's tests know it, and everything that can be derived of it."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any

from sympy import cos, sin, symbols

from derive.steps.record import recorded
from derive.steps.step import Quantity
from tests.mechanics.block import with_what_they_rest_on
from tests.mechanics.verbs import verbs_as_imported

R, a, M, I, g = symbols("R a M I g", positive=True)


def slab_derivation(
    verbs: SimpleNamespace, radius: Any = R, thickness: Any = a, mass: Any = M, inertia: Any = I, gravity: Any = g
) -> dict[str, Quantity]:
    with recorded():
        return _derived(verbs, radius, thickness, mass, inertia, gravity)


def _derived(
    verbs: SimpleNamespace, radius: Any, thickness: Any, mass: Any, inertia: Any, gravity: Any
) -> dict[str, Quantity]:
    theta, s, x, y = verbs.coordinate("theta"), *(verbs.coordinate(name, "length") for name in "sxy")
    slab = verbs.RigidBody(mass, inertia)
    rolled = slab.placed(-theta, verbs.point(-s, radius + thickness / 2).turned(-theta))
    centre = verbs.components(rolled, verbs.no_slip(rolled, at=verbs.point(0, radius).turned(-theta), fixes=s))
    system = verbs.System(slab.placed(-theta, verbs.point(*centre)), verbs.weight(gravity))
    L, U = verbs.lagrangian(system), verbs.potential_energy_of(system)
    motion = verbs.equation_of_motion(L, theta)
    squared = verbs.frequency_squared(verbs.linearised(motion))
    stable = verbs.where(squared, ">", 0, radius, key="stability")
    curvature = verbs.stability(U, {theta: 0}, letter=radius, key="curvature")
    minimum = verbs.where(curvature, ">", 0, radius, key="minimum")

    kept = [verbs.constraint(q, at.value, force=f"lambda_{at.key}") for q, at in zip((x, y), centre, strict=True)]
    free = verbs.System(slab.placed(-theta, verbs.point(x, y)), verbs.weight(gravity), *kept)
    L_free = verbs.lagrangian(free, symbol="L_free", key="free_lagrangian")
    equations = verbs.equations_of_motion(L_free, derivatives=False)
    forces = verbs.multipliers(*equations, keeping=[theta])
    again = verbs.put_in(equations[0], *forces, again=motion, key="multipliers_eliminated")
    across, along = ({x: e[0], y: e[1]} for e in ((sin(theta), cos(theta)), (cos(theta), -sin(theta))))
    contact = [
        verbs.constraint_force(forces, across, "N", "normal_force"),
        verbs.constraint_force(forces, along, "F", "tangent_force"),
    ]
    answers = [motion, verbs.frequency(squared), stable, minimum, verbs.leading_order(curvature), again, *contact]
    return with_what_they_rest_on(answers)


@cache
def known_slab(**variant: Any) -> dict[str, Quantity]:
    return slab_derivation(verbs_as_imported(), **variant)
