"""The words for the direction along which Newton's second law is resolved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sympy import Expr, ImmutableDenseMatrix, Integer

from derive.algebra.expressions import depends_on_time
from derive.algebra.tidy import tidied
from derive.mechanics.model.contacts import Contact
from derive.mechanics.model.strings import Line
from derive.mechanics.model.surfaces import Circle
from derive.mechanics.newton.single_bodies import Alone, Vector, dot
from derive.steps.record import coordinates_in
from derive.steps.signs import sign_known
from derive.steps.step import is_zero

INCREASING = "increasing"
AXES = {
    (1, 0): "to_the_right",
    (-1, 0): "to_the_left",
    (0, 1): "upwards",
    (0, -1): "downwards",
    (0, 0, 1): "upwards",
    (0, 0, -1): "downwards",
}


@dataclass(frozen=True)
class Direction:
    """The word for a direction, and the fixed place to which a radial or tangential direction refers."""

    word: str
    centre: Vector = ()


def direction_of(body: Alone, way: Vector) -> Direction:
    """Return the direction of a unit vector in words: along an axis, along a slope or away from it, away from a centre,
    or along a tangent. The word for any other vector is "increasing": the coordinate increases in this direction."""
    if way in AXES:
        return Direction(AXES[way])
    if is_fixed(way):
        return Direction(_on_slope(body, way))
    for centre in _centres(body):
        arm = tuple(a - b for a, b in zip(body.centre, centre, strict=True))
        along = tidied(dot(arm, way))
        if is_zero(along) and len(way) == 2:
            return Direction("along_the_tangent", centre)
        if is_zero(tidied(dot(arm, arm) - along**2)) and sign_known(along) == 1:
            return Direction("outwards", centre)
    return Direction(INCREASING)


def _on_slope(body: Alone, way: Vector) -> str:
    for normal in normals(body):
        if is_zero(tidied(dot(normal, way) - 1)):
            return "away_from_the_slope"
        if is_zero(tidied(dot(normal, way))) and (sign := sign_known(way[-1])):
            return "up_the_slope" if sign == 1 else "down_the_slope"
    return INCREASING


def normals(body: Alone) -> list[Vector]:
    """The unit normals of the surfaces that touch the body, or that the body carries."""
    touching = [part for part in body.system.parts if isinstance(part, Contact)]
    return [each.normal.components for each in touching if body.part in (each.of, each.surface.of)]


def _centres(body: Alone) -> Iterator[Vector]:
    """Fixed places about which the body may circle: ends of strings and rods, holes, pulleys, centres of circles, and
    the origin."""
    for part in body.system.parts:
        places: list[Vector] = []
        if isinstance(part, Line):
            places = [place.components for place in part.places]
        elif isinstance(part, Contact) and isinstance(part.surface, Circle):
            places = [part.surface.centre.components]
        yield from (place for place in places if is_fixed(place))
    yield tuple(Integer(0) for _ in body.centre)


def is_fixed(place: tuple[Expr, ...]) -> bool:
    return not coordinates_in(ImmutableDenseMatrix(place)) and not any(depends_on_time(c) for c in place)
