"""Drawings for the tests, such as that of the block, and functions that return their drawn pieces."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import atan2, degrees
from typing import Any

from sympy import Symbol, symbols

from derive.algebra.expressions import column
from derive.figures import arc, arrow, axis_of_rotation, drawing, outline, point_mark, sketch
from derive.figures.marks import Drawing, Mark
from derive.figures.pieces import Piece, Stroke
from derive.mechanics import (
    Composite,
    Cone,
    Cuboid,
    Disc,
    Plate,
    RigidBody,
    Rod,
    System,
    X,
    Z,
    coordinate,
    no_slip,
    point,
    space,
    symbolic_body,
    weight,
)
from derive.render.drawing.camera import Numbers
from derive.render.drawing.picture import picture
from derive.steps.record import Run, recorded
from tests.mechanics.block import M, a, known_block, omega

R, h, g = symbols("R h g", positive=True)
theta = Symbol("theta", real=True)
NUMBERS = {a: 1.0, R: 1.0, h: 1.5, theta: 0.6, Symbol("phi", real=True): 3.6, Symbol("psi", real=True): 0.0}


def vectors_of_block(sides: Any = (a, 2 * a, 3 * a), axis: Any = "diagonal", **variant: Any) -> Drawing:
    known = known_block(sides=sides, axis=axis, **variant)
    block = Cuboid(sides, M)
    omega, L, size = known["spin"], known["angular_momentum"], known["angle_between"]
    middle = block.middle
    return drawing(
        "vectors", outline(block, named=False), axis_of_rotation(known["axis_vector"], middle),
        arrow(omega, middle), arrow(L, middle, size=1), arc(omega, L, size, at=middle),
    )  # fmt: skip


CONE = Cone(R, h, M)


def leaning(tilt: Any = theta, **names: Any) -> Drawing:
    """A disc of radius a/2 in the middle of a rod of length 2a, which rotates about its lower end."""
    whole = Composite(Disc(a / 2, M).at(0, 0, a), Rod(2 * a, M).at(0, 0, a), points={"pivot": (0, 0, 0)})
    with recorded(Run()):
        return _leaning(whole, tilt, **names)


def _leaning(whole: Any, tilt: Any, **names: Any) -> Drawing:
    phi, psi = coordinate("phi"), coordinate("psi")
    axes = space.turned(Z, phi).turned(X, tilt).turned(Z, psi)
    return sketch("top", System(symbolic_body(whole).held(axes, at="pivot"), weight(g)), **names)


def slab(inertia: Any = None) -> Drawing:
    """A slab that rolls on a cylinder: a plate, or a body with a given moment of inertia that is drawn as a plate."""
    with recorded():
        angle, way = coordinate("theta"), coordinate("s", "length")
        plate = Plate((3 * R + a, a), M)
        body = plate if inertia is None else RigidBody(M, inertia, look=plate)
        rolled = body.placed(-angle, point(-way, R + a / 2).turned(-angle))
        rolling = no_slip(rolled, at=point(0, R).turned(-angle), fixes=way)
        return sketch("slab", System(rolled, rolling, weight(a)))


SLAB = slab()
SCENES: dict[str, Callable[[], Drawing]] = {  # made when a test needs them, because some are derived
    "vectors0": vectors_of_block,
    "vectors1": lambda: vectors_of_block(axis=(1, 1, 0)),
    "axes": lambda: drawing(
        "axes", outline(Cuboid((a, 2 * a, 3 * a), M)), axis_of_rotation(column(1, 2, 3), rate=omega)
    ),
    "cone": lambda: drawing("cone", outline(CONE)),
    "cone_above": lambda: drawing("cone_above", outline(CONE, "base"), point_mark(column(0, 0, h / 4), Symbol("C"))),
    "top": lambda: leaning(weights=True),
    "slab": lambda: SLAB,
}


def plane(*marks: Mark) -> Drawing:
    return drawing("scene", *marks, view="plane")


def pieces_of(found: Drawing, width: float = 5.0, height: float = 5.0, **numbers: float) -> list[Piece]:
    by_name = {symbol: numbers.get(symbol.name, value) for symbol, value in NUMBERS.items()}
    return picture(found, Numbers(by_name), width, height)


def strokes(pieces: list[Piece], pen: str) -> list[Stroke]:
    return [piece for piece in pieces if isinstance(piece, Stroke) and piece.pen == pen]


def heading(stroke: Stroke) -> float:
    """Return the direction of a straight stroke on paper, in degrees, counterclockwise from the right."""
    (x, y), (u, v) = stroke.spots[0], stroke.spots[-1]
    return degrees(atan2(v - y, u - x))


def area(stroke: Stroke) -> float:
    """Return the area that a stroke encloses; it is positive if the stroke is counterclockwise."""
    middle = [sum(s[k] for s in stroke.spots) / len(stroke.spots) for k in (0, 1)]
    spots = [(x - middle[0], y - middle[1]) for x, y in stroke.spots]
    return sum(x * v - y * u for (x, y), (u, v) in pairwise(spots)) / 2
