"""Functions that return marks for the parts of a machine and for its surroundings.

    drawing("pendulum", pivot(origin), rod(origin, bob, l), angle_mark(origin, "down", bob, theta), particle(bob, m))

A point is a result of `point` or `place`, a column, or a derived vector. The points of a mark are all in a plane, or
all in space. Parts without a given size have a readable size. The order of the marks does not matter: particles are
drawn over rods, and rods over walls.
"""

from __future__ import annotations

from typing import Any

from sympy import Integer, Symbol, pi

from derive.algebra.expressions import as_expr, scalar
from derive.errors import Complaint, Rejected
from derive.figures.annotations import ASIDE
from derive.figures.marks import Mark
from derive.figures.parts import (
    BLOCK,
    CART,
    CASTER,
    BarMark,
    BlockMark,
    CartMark,
    ParticleMark,
    RopeMark,
    SpringMark,
    WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.positions import SIDES, name_of, towards, value_and_keys, vector_of, vectors_of
from derive.figures.surroundings import AngleBetween, DistanceMark, FixedEnd, GravityMark, GroundMark, WayMark
from derive.mechanics.kinematics.coordinates import Coordinate

__all__ = [
    "angle_mark",
    "block",
    "cart",
    "ceiling",
    "fixed_end",
    "floor",
    "gravity_mark",
    "length_mark",
    "particle",
    "pivot",
    "rod",
    "rope",
    "spring_mark",
    "wall",
    "way",
    "wedge",
    "wheel",
]

CLEAR = 7.0  # distance between a block and a dimension line, in points
UNDER = {BlockMark: BLOCK[1] / 2, CartMark: CART[1] / 2 + 2 * CASTER}  # distance from `at` to the floor, in points

# --- parts -----------------------------------------------------------------------------------------------------------


def particle(at: Any, label: Any = None) -> Mark:
    """A particle, a bob or a bead.

    at      the point where the particle is drawn
    label   the symbol of the mass, or another label
    """
    place, keys = vector_of(at)
    return ParticleMark(place, label=name_of(at, label), keys=keys)


def rod(start: Any, end: Any, label: Any = None) -> Mark:
    """A light rod, or another straight part, from one point to another; the label is its length."""
    (a, b), keys = vectors_of(start, end)
    return BarMark(a, b, label=name_of(None, label), keys=keys)


def spring_mark(start: Any, end: Any, label: Any = None) -> Mark:
    """A spring from one point to another; the label is the spring constant."""
    (a, b), keys = vectors_of(start, end)
    return SpringMark(a, b, label=name_of(None, label), keys=keys)


def rope(*along: Any, label: Any = None) -> Mark:
    """A taut string through points and around wheels: `rope(first, pulley, second)`.

    Each wheel is on the inner side of the bend of the string.
    """
    if len(along) < 2:
        raise Rejected(Complaint("wrong-argument", "a rope needs two places or more"))
    wheels = [each if isinstance(each, WheelMark) else None for each in along]
    things = [wheel.centre if wheel else each for wheel, each in zip(wheels, along, strict=True)]
    places, keys = vectors_of(*things)
    radii = tuple(wheel.radius if wheel else Integer(0) for wheel in wheels)
    return RopeMark(tuple(places), radii, label=name_of(None, label), keys=keys)


def wheel(centre: Any, radius: Any = None, label: Any = None, pointer: Any = None) -> WheelMark:
    """A disc seen along its axis: a pulley, or a rolling wheel.

    centre    the centre of the disc
    radius    a length; by default the radius of a small pulley
    pointer   a vector that rotates with the disc, drawn as a line from its centre to its rim
    """
    place, keys = vector_of(centre)
    ahead = vector_of(pointer)[0] if pointer is not None else None
    return WheelMark(place, radius, ahead, label=name_of(None, label), keys=keys)


def block(
    at: Any, label: Any = None, along: Any = "right", width: Any = None, height: Any = None, stands: bool = False
) -> Mark:
    """A block that slides along a direction.

    at              the centre of the block; if `stands` is true, the centre of its base
    label           the mass; a short symbol is written on the block
    along           the direction of the base: a vector, or "right", "up", ...
    width, height   lengths; by default a readable size
    """
    place, keys = vector_of(at)
    return BlockMark(place, _way(along, place.rows), width, height, stands, label=name_of(None, label), keys=keys)


def cart(at: Any, label: Any = None, along: Any = "right", width: Any = None, height: Any = None) -> Mark:
    """A cart on two wheels; `at` is the centre of its body."""
    place, keys = vector_of(at)
    return CartMark(place, _way(along, place.rows), width, height, label=name_of(None, label), keys=keys)


def wedge(*corners: Any, label: Any = None) -> Mark:
    """A wedge, or another solid seen from its side, given by its corners in order."""
    if len(corners) < 3:
        raise Rejected(Complaint("wrong-argument", "a wedge needs three corners or more"))
    places, keys = vectors_of(*corners)
    return WedgeMark(tuple(places), label=name_of(None, label), keys=keys)


# --- supports --------------------------------------------------------------------------------------------------------


def floor(start: Any, end: Any, under: Any = None) -> Mark:
    """Hatched ground from one point to another, with its solid side below.

    under   a block or a cart, whose `at` is on this line; the ground is then drawn at the base of this part
    """
    return _ground(start, end, "down", under)


def ceiling(start: Any, end: Any) -> Mark:
    """A hatched line from one point to another, with its solid side above."""
    return _ground(start, end, "up", None)


def wall(start: Any, end: Any, solid: str = "left") -> Mark:
    """A hatched line from one point to another; `solid` is the hatched side, "left" or "right"."""
    return _ground(start, end, solid, None)


def _ground(start: Any, end: Any, side: str, under: Any) -> Mark:
    (a, b), keys = vectors_of(start, end)
    solid = towards(side, a.rows)
    off = 0.0 if getattr(under, "stands", False) else UNDER.get(type(under), 0.0)
    if off and (height := getattr(under, "height", None)) is not None:  # a length in the drawing, not a size on paper
        across = solid - (b - a) * (b - a).dot(solid) / (b - a).dot(b - a)
        a, b = (end + across * as_expr(height) / (2 * across.norm()) for end in (a, b))
        off -= under.usual[1] / 2
    return GroundMark(a, b, solid, off, keys=keys)


def pivot(at: Any, label: Any = None, away: Any = "down") -> Mark:
    """A fixed joint; the part on the joint points downwards, or in the direction `away`."""
    place, keys = vector_of(at)
    return FixedEnd(place, _way(away, place.rows), True, label=name_of(None, label), keys=keys)


def fixed_end(at: Any, other: Any) -> Mark:
    """A piece of wall at one end of a spring or a string, perpendicular to the line to the other end."""
    (a, b), keys = vectors_of(at, other)
    return FixedEnd(a, b - a, keys=keys)


# --- angles and lengths ----------------------------------------------------------------------------------------------


def angle_mark(vertex: Any, start: Any, end: Any, label: Any = None) -> Mark:
    """The arc between two directions from a vertex.

    vertex   the point at which the directions start
    start    a point in the first direction; or "down", "up", "right" or "left", drawn as a dashed line
    end      a point in the second direction
    label    the name of the angle, or a quantity
    """
    dashed = isinstance(start, str)
    (at, b), keys = vectors_of(vertex, end)
    a = towards(start, at.rows) if dashed else vectors_of(vertex, start)[0][1] - at
    return AngleBetween(at, a, b - at, dashed, label=name_of(None, label), keys=keys)


def length_mark(start: Any, end: Any, label: Any, aside: Any = None, past: Any = None) -> Mark:
    """A dimension line from one point to another.

    aside   the side to which the line is shifted: a vector, or "up", "left", ...; by default away from the centre of
            the drawing
    past    a block or a cart at one end, which the line must not touch
    """
    (a, b), keys = vectors_of(start, end)
    side = None if aside is None else _way(aside, a.rows)
    off = CLEAR + max(past.usual) / 2 if isinstance(past, BlockMark) else ASIDE
    _, own = value_and_keys(label)
    return DistanceMark(a, b, side, off, label=name_of(None, label), keys=keys + own)


def way(
    place: Any, letter: Any, between: tuple[Any, Any] = (0, 2 * pi), label: Any = None, solid: bool = False
) -> Mark:
    """The curve of a point as one symbol varies from one value to another, with all other symbols fixed.

    place     the point, a formula in the symbol
    letter    the symbol, a coordinate or another symbol of the formula
    between   the two values between which the symbol varies
    solid     whether the curve is a solid object, such as a hoop or a wire, and not only a path
    """
    formula, keys = vector_of(place)
    symbol = letter.symbol if isinstance(letter, Coordinate) else letter
    if not isinstance(symbol, Symbol) or symbol not in formula.free_symbols:
        message = f"`letter` of `way` must be a symbol in `place`, but {symbol} is not"
        raise Rejected(Complaint("wrong-argument", message))
    lower, upper = (as_expr(end) for end in between)
    pen = "wire" if solid else "trace"
    return WayMark(formula, symbol, lower, upper, pen, label=name_of(None, label), keys=keys)


def gravity_mark(label: Any = None, in_space: bool = False) -> Mark:
    """The gravitational acceleration: a downward arrow to the upper right of all other parts."""
    return GravityMark(towards("down", 3 if in_space else 2), label=name_of(None, label or scalar("g")))


def _way(thing: Any, rows: int) -> Any:
    return towards(thing, rows) if isinstance(thing, str) and thing in SIDES else vector_of(thing)[0]
