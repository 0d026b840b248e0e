"""Facts about motions that results pass to later steps, in addition to their values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Expr, Symbol

from derive.algebra.expressions import Relation
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.dalembert import MassPoint, Matter
from derive.steps.step import Fact, Quantity


@dataclass(frozen=True)
class Steady(Fact):
    """A steady motion: constant values of coordinates, constant rates of cyclic coordinates, and its conditions, which
    are expressions that vanish in this motion."""

    missing = "is not a condition of a steady motion that `steady_motion` returned"
    lagrangian: Quantity
    values: Mapping[Symbol, Expr]
    rates: Mapping[Symbol, Expr]
    conditions: tuple[Expr, ...]


@dataclass(frozen=True)
class ByEnergy(Fact):
    """The start of a motion of one coordinate, and the acceleration from the equation of motion."""

    missing = "is not the square of a rate from conservation of energy"
    coordinate: Symbol
    start: Expr
    start_rate: Expr
    acceleration: Expr

    @staticmethod
    def behind(force: Quantity, q: Symbol) -> Quantity | None:
        """The step q_dot^2 = f(q), by conservation of energy, from which a force was derived; None if no such step
        exists."""
        of_energy = ((each, each.fact(ByEnergy)) for each in force.ancestors())
        return next((each for each, known in of_energy if known is not None and known.coordinate == q), None)


@dataclass(frozen=True)
class SignedRate(Fact):
    """The direction of a motion from its start: `sense` is 1 if the coordinate increases, and -1 if it decreases."""

    missing = "is not the rate of a coordinate from conservation of energy"
    coordinate: Symbol
    sense: int


@dataclass(frozen=True)
class Arrival:
    """How a motion of one coordinate comes to a place for the first time.

    begun      the start of the motion
    squared    the squared rate of the coordinate by conservation of energy, f(q)
    unknown    the coordinate, or a function of the coordinate such as cos(q)
    place      the value of `unknown` at the place; it may be infinite
    reached    the condition under which the motion reaches the place; None if the motion always reaches it
    is_found   whether the place was derived from this motion
    sense      the sign of the rate at the start, if the result contains the rate with this sign; 0 if the result has no
               such rate, or if the motion starts from rest
    turned     whether the motion turns back before it comes to the place
    lasts      what must last until the motion comes to the place: "contact" for the contact with a surface, "taut" for
               the tension of a string, "" if there is no such constraint
    """

    begun: ByEnergy
    squared: Expr
    unknown: Expr
    place: Expr
    reached: Relation | None
    is_found: bool
    sense: int = 0
    turned: bool = False
    lasts: str = ""


@dataclass(frozen=True)
class Orbit:
    """The circle on which a particle moved before its flight, and whether the particle flies inside this circle."""

    centre: tuple[Expr, Expr]
    radius: Expr
    inside: bool


@dataclass(frozen=True)
class InFlight(Fact):
    """The free motion of a particle or a body after it left a surface, or after its string went slack.

    path           the components, in m, of the place of the particle, or of the centre of mass of the body, as
                   functions of the time since the departure
    matter         the mass points of the system and the forces on them, including the force of the lost constraint
    point          the mass that flies, at its place as a function of the coordinates
    noun           "particle" or "body"
    radius         the radius of a body that is round about its centre of mass, 0 for a particle; None for other bodies
    ended          the symbols of the constraint force and of the friction of the lost contact
    lost           the relation `unknown = place` at which the constraint is lost
    force          the constraint force, which vanishes where the constraint is lost
    squared        the squared rate of the coordinate before the departure, by conservation of energy
    start          the value of the coordinate at the start of the motion before the flight
    kept           the constraint on the motion before the flight
    coordinate     the coordinate of the motion before the flight, and its value at the departure
    letter         the symbol that the author gave to the value at the departure; None without a symbol
    orbit          the circle on which the particle moved; None if it did not move on a circle
    conditions     the conditions on the symbols under which the constraint is lost
    """

    missing = "is not a component of a free flight that `flight` returned"
    path: tuple[Expr, Expr]
    matter: Matter
    point: MassPoint
    noun: str
    radius: Expr | None
    ended: tuple[Symbol, ...]
    lost: Relation
    force: Quantity
    squared: Expr
    start: Expr
    kept: Constraint
    coordinate: tuple[Symbol, Expr]
    letter: Symbol | None
    orbit: Orbit | None
    conditions: tuple[Relation, ...] = ()

    def in_given_letters(self, value: Expr) -> Expr:
        """Replace the symbol `letter` by the value of the coordinate at the departure."""
        return value if self.letter is None else value.xreplace({self.letter: self.coordinate[1]})
