"""Strings and massless rods: inextensible, with the same tension everywhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Self

from sympy import Add, Expr, Integer, Symbol

from derive.algebra.expressions import as_expr, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end, require_bodies
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.contacts import radius_of
from derive.mechanics.model.no_slip import velocity_at
from derive.mechanics.model.surfaces import direction_between, distance_between, dot
from derive.steps.record import require_no_coordinate
from derive.steps.step import is_zero

__all__ = ["massless_rod", "string", "wound_string"]

ZERO = Integer(0)


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
    length       the length between the ends, m; it may be a function of the time, for a string that is pulled in
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
    require_no_coordinate(verb, "length", whole)
    if not all(map(is_end, ends)):
        message = f"`{verb}` ends at a particle, at a body or a point of it, or at a place"
        raise Rejected(Complaint("wrong-argument", message, help='give a point of a body as `body.place_of("end")`'))
    through = [end_of(each) for each in ends]
    require_bodies(verb, through)
    places = tuple(place for place, _ in through)
    found = _length(places)
    if is_zero(found - whole):
        message = f"the coordinates keep the length {whole}, so the force `{letter}` does not appear"
        help_line = "give the end a coordinate along the string, so that the tension keeps it there"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    force = scalar(letter)
    pulls = _pulls(through, force)
    is_rod = verb == "massless_rod"
    kept = Constraint(whole, found, force, forces=pulls, enforcer="rod" if is_rod else "string")
    return Line(pulls, places, is_rod), kept


def wound_string(end: Any, on: Any, tension: str = "T") -> tuple[Line, Constraint]:
    """A straight piece of string from an end to a round body, on which the string is wound or over which it runs
    without slipping.

    end      a particle, a point of a body, or a place in space
    on       a round body in a plane: a yo-yo, or a pulley with a moment of inertia. The string touches its rim at the
    height of its axis, or straight above or below the axis
    tension  the symbol of the tension of this piece, N; positive if the string pulls
    The particle of the rim at the string has the velocity of the string along the string.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 6.7.
    """
    if not isinstance(on, PlacedBody) or not on.is_plane or not is_end(end):
        message = "`wound_string` goes from a particle, a point of a body or a place to a round body in a plane"
        raise Rejected(Complaint("wrong-argument", message))
    place, body = end_of(end)
    require_bodies("wound_string", [(place, body)])
    rim = _rim(place, on)
    along = direction_between(rim, place)
    slip = velocity_at(body if body is not None else place, place) - velocity_at(on, rim)
    force = scalar(tension)
    pulls = (
        PointForce(force, (-along).components, place, body),
        PointForce(force, along.components, rim, on),
    )
    kept = Constraint(tidied(-dot(along, slip)), ZERO, force, in_rates=True, forces=pulls, enforcer="string")
    return Line(pulls, (place, rim), False), kept


def _rim(place: Location, on: PlacedBody) -> Location:
    """Return the point of the rim at which a string from a place is tangent: the string is parallel to an axis."""
    radius, way = radius_of(on), place - on.centre
    for k, c in enumerate(way.components):
        if is_zero(tidied(c**2 - radius**2)):
            return on.centre + Location(tuple(c if i == k else ZERO for i in (0, 1)))
    where = ", ".join(map(str, place.components))
    message = f"the string from ({where}) is not tangent to {on.body.name} beside its axis, or above or below it"
    help_line = f"put its end at the distance {radius} from the axis, `[{radius}, 0]` for a string that hangs down"
    raise Rejected(Complaint("no-contact", message, help=help_line))
