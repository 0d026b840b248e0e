"""Small systems of one or two coordinates, as the book's tests know them: pendulums, beads on wires."""

from __future__ import annotations

from typing import Any

from sympy import Integer, symbols

from derive.algebra.expressions import scalar
from derive.mechanics import (
    Coordinate,
    Particle,
    RigidBody,
    System,
    coordinate,
    equation_of_motion,
    frequency,
    frequency_squared,
    lagrangian,
    linearised,
    point,
    potential_energy_of,
    weight,
)
from derive.steps.establish import Scope, establish
from derive.steps.record import coordinate_named, recorded
from derive.steps.rule import RULES
from derive.steps.step import Quantity

m, l, g, b = symbols("m l g b", positive=True)
ZERO = Integer(0)
THETA, X = coordinate("theta"), coordinate("x", "length")


def position(name: str, value: Any, *coordinates: Coordinate, kind: str = "length") -> Quantity:
    letters = {symbol: known for q in coordinates for symbol, known in q.letters.items()}
    value = Integer(value) if isinstance(value, int) else value
    return establish(
        RULES["answers.let"],
        scalar(name),
        lambda: value,
        {},
        key=name,
        kind=kind,
        scope=Scope(coordinates=letters),
    )


def of_system(
    x: Any, y: Any, *coordinates: Coordinate, inertia: Any = ZERO, turning: Coordinate | None = None
) -> Quantity:
    with recorded():
        for q in (*coordinates, *([turning] if turning else [])):
            coordinate_named(q.symbol, q.kind)
        at = point(Integer(0) + x, Integer(0) + y)
        moving = Particle(m, at) if turning is None else RigidBody(m, inertia).placed(turning.symbol, at)
        return lagrangian(System(moving, weight(g)))


def potential(x: Any, y: Any, *coordinates: Coordinate) -> Quantity:
    with recorded():
        for q in coordinates:
            coordinate_named(q.symbol, q.kind)
        return potential_energy_of(System(Particle(m, point(Integer(0) + x, Integer(0) + y)), weight(g)))


def motion(x: Any, y: Any, q: Coordinate, **named: Any) -> Quantity:
    return equation_of_motion(of_system(x, y, q, **named), q)


def small_oscillations(x: Any, y: Any, q: Coordinate, at: Any = None, **named: Any) -> Quantity:
    return frequency(frequency_squared(linearised(motion(x, y, q, **named), at)))
