"""Small systems of one or two coordinates, as the book's tests know them: pendulums, beads on wires."""

from __future__ import annotations

from typing import Any

from sympy import Integer, symbols

from derive.algebra.expressions import scalar
from derive.mechanics import (
    Coordinate,
    coordinate,
    equation_of_motion,
    frequency,
    frequency_squared,
    lagrangian,
    linearised,
    plane_kinetic_energy,
    rate_of,
    weight_energy,
)
from derive.steps.establish import Scope, establish
from derive.steps.step import Quantity

m, l, g, b = symbols("m l g b", positive=True)
ZERO = Integer(0)
THETA, X = coordinate("theta"), coordinate("x", "length")


def position(name: str, value: Any, *coordinates: Coordinate, kind: str = "length") -> Quantity:
    """A place that is known from the start, as a function of coordinates."""
    letters = {symbol: known for q in coordinates for symbol, known in q.letters.items()}
    value = Integer(value) if isinstance(value, int) else value
    return establish(
        "equations.let",
        scalar(name),
        lambda: value,
        {},
        key=name,
        definition=True,
        kind=kind,
        scope=Scope(coordinates=letters),
    )


def energies(
    x: Any, y: Any, *coordinates: Coordinate, inertia: Any = ZERO, turning: Coordinate | None = None
) -> tuple[Quantity, Quantity]:
    """Kinetic and potential energy of a body of mass m whose centre is at (x, y)."""
    place = position("X", x, *coordinates), position("Y", y, *coordinates)
    moving = plane_kinetic_energy(m, [rate_of(part) for part in place], place, inertia, turning)
    return moving, weight_energy(m, g, place)


def motion(x: Any, y: Any, q: Coordinate, **named: Any) -> Quantity:
    """The equation of motion of q."""
    return equation_of_motion(lagrangian(*energies(x, y, q, **named)), q)


def small_oscillations(x: Any, y: Any, q: Coordinate, at: Any = None, **named: Any) -> Quantity:
    """The frequency about an equilibrium."""
    return frequency(frequency_squared(linearised(motion(x, y, q, **named), at)))
