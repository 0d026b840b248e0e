"""The block of sides a, 2a, 3a as the book's tests know it, and everything that can be derived of it."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any

from sympy import Integer, Rational, Symbol, pi, symbols

from derive.algebra.expressions import Amount
from derive.mechanics import Direction
from derive.steps.step import Quantity
from tests.mechanics.verbs import verbs_as_imported

a, b, c, M, omega = symbols("a b c M omega", positive=True)

AMOUNTS: dict[Symbol, Any] = {
    a: Amount(Integer(2), "cm", Rational(1, 100)),
    M: Amount(Integer(3), "kg", Integer(1)),
    omega: Amount(Integer(900), "rpm", pi / 30),
}


def block_derivation(
    verbs: SimpleNamespace,
    sides: tuple[Any, Any, Any] = (a, 2 * a, 3 * a),
    axis: str | tuple[Any, ...] = "diagonal",
    rate: Any = omega,
) -> dict[str, Quantity]:
    block = verbs.Cuboid(sides, M)
    direction = Direction(axis) if isinstance(axis, str) else Direction(None, axis)
    corner = verbs.inertia_tensor(block, about="corner", key="corner_tensor")
    centre = verbs.moved_to(corner, block.centre)
    energy = verbs.kinetic_energy(centre, verbs.any_angular_velocity())
    spin = verbs.spin(rate, along=block.direction(direction))
    momentum = verbs.angular_momentum(centre, spin)
    angle = verbs.angle_between(spin, momentum)
    torque = verbs.torque(spin, momentum)
    answers = [verbs.at(energy, spin, key="energy_about_axis"), angle, torque, verbs.magnitude(torque)]
    return with_what_they_rest_on(answers)


def with_what_they_rest_on(quantities: list[Quantity]) -> dict[str, Quantity]:
    found: dict[str, Quantity] = {}
    for quantity in quantities:
        found |= with_what_they_rest_on(list(quantity.parents)) | {quantity.key: quantity}
    return found


@cache
def known_block(
    sides: tuple[Any, Any, Any] = (a, 2 * a, 3 * a), axis: str | tuple[Any, ...] = "diagonal", rate: Any = omega
) -> dict[str, Quantity]:
    return block_derivation(verbs_as_imported(), sides, axis, rate)


def values(**variant: Any) -> dict[str, Any]:
    return {key: quantity.value for key, quantity in known_block(**variant).items()}


def outcomes(**variant: Any) -> dict[str, str]:
    return {key: quantity.step.outcome for key, quantity in known_block(**variant).items()}
