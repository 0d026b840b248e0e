"""Strings and massless rods: inextensible, with the same tension everywhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Self

from sympy import Add, Expr, Symbol

from derive.algebra.expressions import as_expr, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.surfaces import direction_between, distance_between
from derive.steps.record import require_constant
from derive.steps.step import is_zero

__all__ = ["massless_rod", "string"]


@dataclass(frozen=True)
class Line(Connection):
    """A string or a massless rod.

    through   its ends and the pulleys between them, in order
    is_rod    whether it is a rod, which can also push
    """

    through: tuple[Location, ...]
    is_rod: bool

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), through=tuple(place.with_values(known) for place in self.through))


def _length(places: Sequence[Location]) -> Expr:
    return tidied(Add(*(distance_between(a, b) for a, b in pairwise(places))))


def _pulls(through: Sequence[tuple[Location, Any]], tension: Symbol) -> tuple[PointForce, ...]:
    """The forces on the ends and on the pulleys: the tension, towards each neighbouring place."""
    places = [place for place, _ in through]
    found = []
    for i, (place, of) in enumerate(through):
        beside = [places[k] for k in (i - 1, i + 1) if 0 <= k < len(places)]
        found += [PointForce(tension, direction_between(place, other).components, place, of) for other in beside]
    return tuple(found)


def string(start: Any, end: Any, length: Any, over: Sequence[Any] = (), tension: str = "T") -> tuple[Line, Constraint]:
    """A massless inextensible string between two ends, over massless frictionless pulleys or through smooth holes.

    start, end   particles, points of bodies, or places in space
    length       the length between the ends, m
    over         the pulleys or holes between the ends: places, particles, or points of bodies; the radius of a pulley
                 is negligible
    tension      the symbol of the tension, N; positive if the string pulls
    The tension is the same everywhere in the string. It pulls the ends along the string, and each pulley along both
    parts of the string.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 3.2.
    """
    return _of_length("string", (start, *over, end), length, tension)


def massless_rod(start: Any, end: Any, length: Any, force: str = "T") -> tuple[Line, Constraint]:
    """A massless rigid rod between two hinges, which pulls or pushes only along its direction.

    start, end   particles, points of bodies, or places in space
    length       the length, m
    force        the symbol of the force in the rod, N; positive in tension
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 3.2.
    """
    return _of_length("massless_rod", (start, end), length, force)


def _of_length(verb: str, ends: Sequence[Any], length: Any, letter: str) -> tuple[Line, Constraint]:
    """Return the line, and the constraint l - (length of the line) = 0; its multiplier is the tension."""
    whole = as_expr(length)
    require_constant(verb, "length", whole)
    if not all(map(is_end, ends)):
        message = f"`{verb}` ends at a particle, at a body or a point of it, or at a place"
        raise Rejected(Complaint("wrong-argument", message, help='give a point of a body as `body.place_of("end")`'))
    through = [end_of(each) for each in ends]
    places = tuple(place for place, _ in through)
    found = _length(places)
    if is_zero(found - whole):
        message = f"the coordinates keep the length {whole}, so the force `{letter}` does not appear"
        help_line = "give the end a coordinate along the string, so that the tension keeps it there"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    force = scalar(letter)
    pulls = _pulls(through, force)
    return Line(pulls, places, verb == "massless_rod"), Constraint(whole, found, force, forces=pulls)
