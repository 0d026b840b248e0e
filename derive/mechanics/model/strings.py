"""Strings and massless rods: inextensible, with the same tension everywhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from sympy import Add, Expr

from derive.algebra.expressions import as_expr, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.constraint import Constraint, PointForce
from derive.mechanics.model.surfaces import direction_between, distance_between
from derive.steps.record import require_constant
from derive.steps.step import is_zero

__all__ = ["massless_rod", "string"]


@dataclass(frozen=True)
class Course:
    """The places through which a string runs, in order, each with the body or particle at that place, if any."""

    through: tuple[tuple[Location, Any], ...]

    @property
    def length(self) -> Expr:
        places = [place for place, _ in self.through]
        return tidied(Add(*(distance_between(a, b) for a, b in pairwise(places))))

    @property
    def pulls(self) -> tuple[PointForce, ...]:
        """The force on each place, per unit of the tension: unit vectors towards the neighbouring places."""
        places = [place for place, _ in self.through]
        found = []
        for i, (place, of) in enumerate(self.through):
            beside = [places[k] for k in (i - 1, i + 1) if 0 <= k < len(places)]
            ways = [direction_between(place, other).components for other in beside]
            found.append(PointForce(tuple(tidied(Add(*parts)) for parts in zip(*ways, strict=True)), place, of))
        return tuple(found)


def string(start: Any, end: Any, length: Any, over: Sequence[Any] = (), tension: str = "T") -> Constraint:
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
    course = Course(tuple(map(_end, (start, *over, end))))
    return _of_length("string", course, length, tension)


def massless_rod(start: Any, end: Any, length: Any, force: str = "T") -> Constraint:
    """A massless rigid rod between two hinges, which pulls or pushes only along its direction.

    start, end   particles, points of bodies, or places in space
    length       the length, m
    force        the symbol of the force in the rod, N; positive in tension
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 3.2.
    """
    return _of_length("massless_rod", Course((_end(start), _end(end))), length, force)


def _of_length(verb: str, course: Course, length: Any, letter: str) -> Constraint:
    """Return the constraint l - (length of the course) = 0; its multiplier is the tension."""
    whole = as_expr(length)
    require_constant(verb, "length", whole)
    found = course.length
    if is_zero(found - whole):
        message = f"the coordinates keep the length {whole}, so the force `{letter}` does not appear"
        help_line = "give the end a coordinate along the string, so that the tension keeps it there"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    return Constraint(whole, found, scalar(letter), forces=course.pulls)


def _end(given: Any) -> tuple[Location, Any]:
    if isinstance(given, PointOfBody):
        return Location(given.components), given.body
    if isinstance(given, PlacedBody):
        return given.centre, given
    if isinstance(given, Location):
        return given, None
    if hasattr(given, "mass") and isinstance(getattr(given, "at", None), Location):
        return given.at, given
    message = "a string or a rod ends at a particle, at a point of a body, or at a place"
    raise Rejected(Complaint("wrong-argument", message, help='give a point of a body as `body.place_of("end")`'))
