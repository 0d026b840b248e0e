"""Free flight of a particle or a body that leaves a surface, or whose string goes slack: its motion and its end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Matrix, Symbol, diff, factorial, sqrt

from derive.algebra.amplitudes import inverse_of
from derive.algebra.expressions import (
    TIME,
    Relation,
    Root,
    Terms,
    as_expr,
    bound,
    depends_on_time,
    explicit,
    rate,
    scalar,
)
from derive.algebra.lowest_terms import factored
from derive.algebra.order import Contradiction, in_order, known_order
from derive.algebra.ranges import sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.arguments import checked
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.in_results import Letter, PlaceIn, SurfaceNamed, in_results
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.mechanics.kinematics.places import Location
from derive.mechanics.lagrange.facts import ForceOf
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.model.contact_points import has_radius, radius_of
from derive.mechanics.model.dalembert import MassPoint, Matter
from derive.mechanics.model.description import description_behind
from derive.mechanics.model.surfaces import Plane, Surface, dot
from derive.mechanics.motion import claims, leaving
from derive.mechanics.motion.facts import ByEnergy, InFlight, Orbit
from derive.mechanics.motion.turning_points import squared_by_energy
from derive.solving.attainable import lies_within
from derive.solving.presentation import presented, without_positive
from derive.solving.relations import isolated, solved_for_letter
from derive.solving.unknowns import letter_of, mark_for, meaning, with_unknown
from derive.steps.chain import bindings_of
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import changes, coordinates_in, free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.signs import sign_known, taken_positive
from derive.steps.step import Quantity, is_zero
from derive.steps.trial_numbers import signs_of

__all__ = ["free_flight", "landing", "passes_through"]

ZERO = Integer(0)
Vector = tuple[Expr, Expr]
SOURCE = "Morin, *Introduction to Classical Mechanics*, sections 3.4 and 5.3"


# --- the end of the motion on the surface or the string ---------------------------------------------------------------


@dataclass(frozen=True)
class Flyer:
    """The particle or the rigid body that flies.

    part       the particle or the placed body
    point      the mass of the particle or body, at the place of its centre of mass
    frictions  the constraints that friction enforces at the contact until the contact is lost
    """

    part: Any
    point: MassPoint
    frictions: tuple[Constraint, ...] = ()

    @property
    def noun(self) -> str:
        return "body" if isinstance(self.part, PlacedBody) else "particle"

    @property
    def radius(self) -> Expr | None:
        """The radius of a round body whose centre of mass is its centre, 0 for a particle; None for other bodies."""
        if not isinstance(self.part, PlacedBody):
            return ZERO
        is_round = has_radius(self.part) and is_zero(
            ImmutableDenseMatrix((self.part.hub - self.part.centre).components)
        )
        return radius_of(self.part) if is_round else None

    @property
    def turning(self) -> tuple[Symbol, ...]:
        """The coordinates on which the orientation of a body depends."""
        angle = self.part.turned if isinstance(self.part, PlacedBody) else ZERO
        return tuple(coordinates_in(as_expr(angle)))

    @property
    def coordinates(self) -> tuple[Symbol, ...]:
        """The coordinates on which the place of the centre of mass depends."""
        return tuple(coordinates_in(ImmutableDenseMatrix(self.point.place)))


@dataclass(frozen=True)
class Departure:
    """The state in which a particle or a body leaves a surface, or its string goes slack.

    lost    the result of `leaves`: the relation for the place where contact is lost
    speed   the squared rate of the coordinate before the departure, by conservation of energy
    letter  the symbol for the value of the coordinate at the departure; None if the value itself is used
    """

    lost: Quantity
    speed: Quantity
    letter: Symbol | None

    @cached_property
    def flyer(self) -> Flyer:
        return _the_one_that_flies(self)

    @property
    def force(self) -> Quantity:
        """The constraint force, which vanishes at the departure."""
        return self.lost.parent("force")

    @property
    def conditions(self) -> tuple[Relation, ...]:
        """The conditions under which the motion reaches the departure, as the step `lost` states them."""
        known = bindings_of(self.lost.parents)
        return tuple(bound(value, known) for role, value in self.lost.step.roles if role in ("reached", "existing"))

    @property
    def original(self) -> Quantity:
        """The constraint force as a function of the place and of the rate, before the rate was eliminated."""
        return next(each for each in self.force.ancestors() if each.fact(ForceOf) is not None)

    @property
    def lagrangian(self) -> Quantity:
        found: Quantity = self.original.needed(ForceOf).problem.lagrangian
        return found

    @property
    def gravity(self) -> Expr:
        """The acceleration of free fall in the description; 0 if the system has no weight."""
        known = description_behind(self.lagrangian)
        return ZERO if known is None or known.description.gravity is None else known.description.gravity

    @property
    def kept(self) -> Any:
        return self.original.needed(ForceOf).constraint

    @property
    def equations(self) -> tuple[Quantity, ...]:
        return tuple(self.original.needed(ForceOf).problem.equations)

    @cached_property
    def matter(self) -> Matter:
        return self.lagrangian.needed(Matter)

    @property
    def q(self) -> Symbol:
        return self.speed.needed(ByEnergy).coordinate

    @cached_property
    def value(self) -> Expr:
        """The value of the coordinate at the departure, in the symbols of the problem."""
        (found,) = meaning(*self.lost.value.sides).values()
        return explicit(found)

    @property
    def at(self) -> Expr:
        return self.value if self.letter is None else self.letter

    @cached_property
    def held(self) -> dict[Symbol, Expr]:
        """The other coordinate of the place, with the constant value that it has before the departure."""
        others = [each for each in self.flyer.coordinates if each != self.q]
        found = solved_for_letter(explicit(self.kept.residual), others[0]) if len(others) == 1 else None
        if found is None or found.has(self.q):
            message = (
                f"`flight` needs a motion in which the constraint fixes all coordinates of the place except {self.q}"
            )
            help_line = "use polar coordinates: the distance from the centre, and the angle"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
        return {others[0]: found}

    @cached_property
    def curve(self) -> Vector:
        """The place of the particle before the departure, as a function of the coordinate."""
        x, y = (explicit(c).xreplace(self.held) for c in self.flyer.point.place)
        return x, y

    @cached_property
    def held_rates(self) -> dict[Symbol, Expr]:
        """The rates that the constraint and rolling determine: zero for a constant coordinate; for a coordinate of the
        rotation, the rate expressed by the rate of `q`."""
        still: dict[Symbol, Expr] = {rate(s): ZERO for s in self.held}
        for each in self.flyer.frictions:
            left = explicit(each.residual).xreplace({**self.held, **still})
            for s in self.flyer.turning:
                slope = diff(left, rate(s))
                if rate(s) not in still and not is_zero(slope):
                    still[rate(s)] = tidied(-left.xreplace({rate(s): ZERO}) / slope)
        return still

    @cached_property
    def scale(self) -> Expr:
        """The ratio of the speed to the magnitude of the rate of the coordinate."""
        return tidied(sqrt(tidied(Add(*(diff(c, self.q) ** 2 for c in self.curve)))))

    @cached_property
    def place(self) -> Vector:
        x, y = (tidied(c.xreplace({self.q: self.at})) for c in self.curve)
        return x, y

    @cached_property
    def direction(self) -> Vector:
        """The unit vector along the curve, in the direction of the motion."""
        sign = self.sense
        x, y = (tidied((sign * diff(c, self.q) / self.scale).xreplace({self.q: self.at})) for c in self.curve)
        return x, y

    @cached_property
    def sense(self) -> int:
        """Return 1 if the coordinate increases on the way to the departure, -1 if it decreases."""
        known = self.speed.needed(ByEnergy)
        own = sign_known(known.start_rate)
        found = signs_of(self.value - known.start) - {None}
        if own == -1 or len(found) != 1 or found == {0}:
            message = (
                f"`flight`: the initial rate of {self.q} is negative, or it is not known whether {self.q} increases "
                "on the way to the place of departure"
            )
            help_line = f"define {self.q} so that it increases during the motion"
            raise Rejected(Complaint("sign", message, help=help_line))
        return 1 if found == {1} else -1

    @cached_property
    def square(self) -> Expr:
        """The squared speed for which the constraint force vanishes at the place of the departure."""
        mark = mark_for(rate(self.q) ** 2)
        whole = explicit(self.original.value).xreplace({**self.held_rates, **self.held})
        force = with_unknown(whole, rate(self.q) ** 2, mark)
        found = isolated(tidied(force), mark)
        if found is None or found.power != 1 or found.value.has(mark, rate(self.q)):
            message = f"`flight`: {rate(self.q)}**2 does not follow from `{self.original.key}` = 0"
            raise Rejected(Complaint("wrong-argument", message))
        return tidied((found.value * self.scale**2).xreplace({self.q: self.at}))

    @cached_property
    def square_by_energy(self) -> Expr:
        """The squared speed at the departure by conservation of energy, in the symbols of the problem."""
        return (squared_by_energy(self.speed) * self.scale**2).xreplace({self.q: self.value})

    @cached_property
    def acceleration(self) -> Vector:
        """The acceleration of the centre of mass under its weight alone."""
        x, y = (tidied(c / self.flyer.point.mass) for c in self.other_forces)
        return x, y

    @property
    def other_forces(self) -> Vector:
        """The weight, which is the only force on the flying body."""
        return ZERO, -self.flyer.point.mass * self.gravity

    @cached_property
    def orbit(self) -> Orbit | None:
        """The circle on which the particle moved; None if it did not move on a circle.

        For the place P(q) of the particle, with an angle q, the centre of a circle is P + P''. The centre and the
        radius must not depend on q.
        """
        centre = [tidied(c + diff(c, self.q, 2) * self._bend) for c in self.curve]
        radius = tidied(sqrt(tidied(Add(*((c - m) ** 2 for c, m in zip(self.curve, centre, strict=True))))))
        if any(c.has(self.q) for c in [*centre, radius]):
            return None
        pull = next(each for each in self.kept.forces if each.of == self.flyer.part)
        outwards = zip(self.curve, centre, pull.direction, strict=True)
        push = tidied(Add(*((c - m) * explicit(n).xreplace(self.held) for c, m, n in outwards)))
        return Orbit((centre[0], centre[1]), radius, sign_known(push) == -1)

    @property
    def _bend(self) -> Expr:
        """The factor of P'' in P + P'': 1 if |P'| is constant, otherwise 0, so that no circle is found."""
        return Integer(1) if not self.scale.has(self.q) else ZERO

    def flight(self, path: Vector) -> InFlight:
        """Return the fact about a flight along this path that later steps need."""
        known = self.speed.needed(ByEnergy)
        return InFlight(
            path=path,
            matter=self.matter,
            point=self.flyer.point,
            noun=self.flyer.noun,
            radius=self.flyer.radius,
            ended=(self.kept.force, *(each.force for each in self.flyer.frictions)),
            lost=self.lost.value,
            force=self.force,
            squared=squared_by_energy(self.speed),
            start=known.start,
            kept=self.kept,
            coordinate=(self.q, self.value),
            letter=self.letter,
            orbit=self.orbit,
            conditions=self.conditions,
        )


def _departure(lost: Quantity, letter: Any) -> Departure:
    if lost.step.rule != leaving.LEAVES_CONTACT.name:
        message = f"`flight` needs the place where contact is lost, but `{lost.key}` is not such a place"
        raise Rejected(Complaint("wrong-argument", message, help="name a result of `leaves`"))
    if lost.step.outcome not in ("lost", "lost_later"):
        message = f"`{lost.key}` states that contact is never lost, so no flight follows"
        raise Rejected(Complaint("no-flight", message, help="ask for the flight only if the contact is lost"))
    speed = ByEnergy.behind(lost.parent("force"), letter_of(lost.value.left))
    if speed is None or not any(each.fact(ForceOf) for each in lost.ancestors()):
        message = f"`flight`: the speed is unknown, since `{lost.key}` was found without conservation of energy"
        raise Rejected(Complaint("wrong-argument", message, help="substitute a result of `speed` into the force"))
    found = Departure(lost, speed, None if letter is None else _checked_letter(letter, letter_of(lost.value.left)))
    assert found.flyer.point
    return found


def _checked_letter(letter: Any, q: Symbol) -> Symbol:
    if not isinstance(letter, Symbol) or changes(letter, [q]) is not None:
        message = f"`at` in `flight` must be a symbol for the value of {q} at the departure, not {letter}"
        raise Rejected(Complaint("wrong-argument", message, help=f"declare a symbol for this value, such as `{q}_1`"))
    return letter


def _the_one_that_flies(departure: Departure) -> Flyer:
    """Return the particle or body that flies; reject a system in which there is none, or several."""
    parts = [each.of for each in departure.kept.forces if each.of is not None]
    found, reasons = [], []
    for part in dict.fromkeys(parts):
        flyer = _flyer(departure, part)
        why = "the motion is in space" if flyer is None else _why_it_is_not_free(departure, flyer)
        reasons += [why] if why else []
        found += [flyer] if flyer is not None and not why else []
    if len(found) == 1:
        return found[0]
    unknown = next(iter(reasons), "the constraint is given as a formula")
    why = "several particles or bodies are free afterwards" if found else unknown
    message = f"`flight` finds the motion of a particle or a body under its weight, but {why}"
    raise Rejected(Complaint("no-flight", message))


def _flyer(departure: Departure, part: Any) -> Flyer | None:
    """Return a particle, or a body in a plane, as a possible flyer. Return None for a motion in space, or if no mass
    point of the system has the mass and the place of the part."""
    is_body = isinstance(part, PlacedBody)
    place = part.centre if is_body else part.at
    if len(place.components) != 2:
        return None
    here = next(each.at for each in departure.kept.forces if each.of == part)
    frictions = [
        each
        for each in _constraints(departure)
        if each.enforcer == "friction" and any(force.of == part and force.at == here for force in each.forces)
    ]
    mass = part.body.mass if is_body else part.mass
    point = next(
        (each for each in departure.matter.points if _is_same(each.place, place.components) and each.mass == mass), None
    )
    return None if point is None else Flyer(part, point, tuple(frictions))


def _is_same(one: Sequence[Expr], other: Sequence[Expr]) -> bool:
    return len(one) == len(other) and is_zero(
        ImmutableDenseMatrix([explicit(a) - explicit(b) for a, b in zip(one, other, strict=True)])
    )


def _why_it_is_not_free(departure: Departure, flyer: Flyer) -> str:
    matter, own, noun = departure.matter, set(flyer.coordinates), flyer.noun
    lost = (departure.kept, *flyer.frictions)
    acting = [each for each in _constraints(departure) if any(force.of == flyer.part for force in each.forces)]
    if any(depends_on_time(c) for c in flyer.point.place) or depends_on_time(departure.kept.residual):
        return f"the {noun} has another constraint, or a support that moves"
    if any(each not in lost for each in acting):
        return f"the {noun} has another constraint, or a support that moves"
    if any(not each.forces for each in _constraints(departure)):
        return "a constraint is given as a formula"
    others = [each for each in matter.points if each != flyer.point]
    if any(explicit(c).free_symbols & own for each in others for c in each.place):
        return f"the coordinates of the place of the {noun} also rotate the {noun}, or move another body"
    if departure.gravity == 0:
        return f"the {noun} has no weight"
    weight = (ZERO, -flyer.point.mass * departure.gravity)
    ended = {each.force for each in lost}
    for q in (*flyer.coordinates, *flyer.turning):
        loads = [*matter.loads, *(each for each in matter.others if getattr(each, "multiplier", None) not in ended)]
        work = Add(*(each.work_along(q) for each in loads))
        wanted = Add(*(f * diff(explicit(c), q) for f, c in zip(weight, flyer.point.place, strict=True)))
        if matter.fields or not is_zero(tidied(explicit(work) - wanted)):
            return f"a force other than its weight acts on the {noun}"
    return ""


def _constraints(departure: Departure) -> Sequence[Any]:
    known = departure.lagrangian.fact(Constrained)
    return known.constraints if known is not None else ()


# --- the flight -------------------------------------------------------------------------------------------------------


DEPARTURE = Rule("motion.departure", source=SOURCE, outcomes={"generic": claims.is_the_place_of_departure})


def free_flight(lost: Quantity, at: Any = None, key: str = "flight") -> tuple[Quantity, ...]:
    """Free flight of a particle or body that leaves a surface, or whose string goes slack: r(t) = r_1 + v_1 t + F
    t^2/(2 m). Here r is the place of the centre of mass, and F is the weight.

    lost   the place where contact is lost, from `leaves_contact`
    at     a symbol for the value of the coordinate at the departure, such as theta_1; by default the value itself

    The result has two steps, `flight_x` and `flight_y`: the components of the place, in m, as functions of the time t
    since the departure. A separate step yields the speed v_1 at the departure; the velocity is along the curve on which
    the particle moved. For a body that rolled, a third step, `flight_spin`, has the constant angular velocity, in
    rad/s.
    It is assumed that contact is lost, and that a rolling body rolls until it departs. No force other than its weight
    may act on the particle or body that flies.
    Second route: Lagrange's equations for the coordinates of the place, without the forces of the lost contact. Checks:
    Newton's second law, and the place and velocity at the departure, by conservation of energy. Witness: the motion of
    the described system is followed until the force vanishes, and then without the constraint.
    Outcomes: uniform (no force along this axis), falls (a constant force along this axis).
    Errors: contact is not lost; the flight is in space; another force acts during the flight; the force that vanishes
    was derived without conservation of energy; `at` is not a suitable symbol.
    Source: Morin, *Introduction to Classical Mechanics*, sections 3.4 and 5.3.
    """
    departure = _departure(lost, at)
    for condition in departure.conditions or (None,):
        if departure.letter is not None and lies_within(departure.letter, departure.value, condition) is False:
            message = f"`flight`: the flight begins at {departure.q} = {departure.value}, outside the range of {at}"
            raise Rejected(Complaint("range", message, help=f"give `{at}` the range of {departure.q} at the departure"))
    with where(departure.conditions):
        parents = [lost]
        if departure.letter is not None:
            parents.append(_place_of(departure, f"{key}_start"))
        taken_positive(departure.square)
        speed = _speed_of(departure, parents, f"{key}_speed")
        path = tuple(_component(departure, speed, i, f"{key}_{name}") for i, name in enumerate("xy"))
        turns = [rate(s) for s in departure.flyer.turning if rate(s) in departure.held_rates]
        return (*path, *(_spin(departure, speed, turn, f"{key}_spin") for turn in turns))


@contextmanager
def where(conditions: Sequence[Relation]) -> Iterator[None]:
    """Assume the conditions under which contact is lost, within the `with` block; the step `lost` states them."""
    order = known_order()
    for each in conditions:
        difference = tidied(each.residual if each.operator == ">" else -each.residual)
        try:
            order = order.with_relation(difference, True, sign_within)
        except Contradiction:
            message = f"`flight`: contact is lost only for {each}, which contradicts the assumptions"
            raise Rejected(Complaint("contradiction", message)) from None
    with in_order(order):
        yield


def _place_of(departure: Departure, key: str) -> Quantity:
    unknown, place = departure.lost.value.sides
    named = unknown.xreplace({departure.q: departure.letter})
    return establish(
        DEPARTURE,
        None,
        lambda *_: Relation(named, "=", place),
        {"lost": departure.lost, "letter": departure.letter, "coordinate": departure.q},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        key=key,
    )


DEPARTURE_SPEED = Rule("motion.departure_speed", source=SOURCE, evidence={"energy": ROUTE})


def _speed_of(departure: Departure, parents: Sequence[Quantity], key: str) -> Quantity:
    """Speed at which a particle leaves a surface, or its string goes slack.

    Second route: conservation of energy.
    Source: the same as for `free_flight`.
    """
    known = {} if departure.letter is None else {departure.letter: departure.value}

    def energy(found: Expr) -> tuple[Expr, Expr]:
        return found.xreplace(known) ** 2, departure.square_by_energy

    return establish(
        DEPARTURE_SPEED,
        scalar(free_letter("v_1"), positive=True),
        lambda *_: sqrt(departure.square),
        {"force": departure.original},
        lines=Lines(put_in=None, arranged=lambda v: presented(v, in_sums=False)),
        routes={"energy": energy},
        key=key,
        kind="speed",
        parents=parents,
    )


FREE_FLIGHT = Rule(
    "motion.free_flight",
    source=SOURCE,
    outcomes={"uniform": claims.speeds_up(False), "falls": claims.speeds_up(True)},
    evidence={"lagrange": ROUTE, "newton": CHECK, "start": CHECK},
)


def _component(departure: Departure, speed: Quantity, i: int, key: str) -> Quantity:
    """One component of the place of a particle in free flight.

    Outcomes: uniform, falls.
    Source: the same as for `free_flight`.
    """
    v = explicit(speed.value)
    place, along, pulled = departure.place[i], departure.direction[i], departure.acceleration[i]
    path = tuple(
        r + u * v * TIME + a * TIME**2 / 2
        for r, u, a in zip(departure.place, departure.direction, departure.acceleration, strict=True)
    )
    known = {} if departure.letter is None else {departure.letter: departure.value}

    def with_found(found: Expr) -> list[Expr]:
        return [found if k == i else c for k, c in enumerate(path)]

    def start(found: Expr) -> tuple[Any, Any]:
        """Check the place at t = 0, and by conservation of energy also the velocity at t = 0."""
        before = departure.curve[i]
        there = {departure.q: departure.value}
        ends = found.xreplace({TIME: ZERO}), diff(found, TIME).xreplace({TIME: ZERO}) ** 2
        wanted = before.xreplace(there), (diff(before, departure.q) ** 2).xreplace(there) * energy
        return ImmutableDenseMatrix([c.xreplace(known) for c in ends]), ImmutableDenseMatrix(wanted)

    energy = squared_by_energy(departure.speed).xreplace({departure.q: departure.value})
    flight = departure.flight((path[0], path[1]))
    return establish(
        FREE_FLIGHT,
        scalar(free_letter("xy"[i])),
        lambda V: Terms(*_terms(place, along * V, pulled)),
        {"speed": speed},
        lines=Lines(result=False, arranged=explicit),
        routes={
            "lagrange": lambda found: (ImmutableDenseMatrix(_residuals(departure, with_found(found))), _noughts(2)),
            "newton": lambda found: (
                departure.flyer.point.mass * diff(found, TIME, 2),
                departure.other_forces[i],
            ),
            "start": start,
        },
        outcome="uniform" if pulled == 0 else "falls",
        phrase_data=PhraseData(
            words={"enforcer": departure.kept.enforcer, "flyer": departure.flyer.noun},
            outcome_data={"component": Integer(i), "other_force": departure.other_forces[i], "flight": flight},
        ),
        key=key,
        kind="length",
        facts=[flight],
    )


SPIN_IN_FLIGHT = Rule(
    "motion.spin_in_flight",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.7",
    outcomes={"steady": claims.spins_as_it_rolled},
    evidence={"rolling": ROUTE, "torque": CHECK},
)


def _spin(departure: Departure, speed: Quantity, turn: Symbol, key: str) -> Quantity:
    """Angular velocity of a body in free flight. The weight has no torque about the centre of mass, so the angular
    velocity at the departure remains.

    Second route: the point of the body at the contact has no velocity while the body rolls. Check: the equation of
    motion of the angle contains no torque if the forces of the lost contact are zero.
    Outcomes: steady.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.7.
    """
    known = {} if departure.letter is None else {departure.letter: departure.value}
    sense = departure.sense
    factor = tidied((departure.held_rates[turn] / rate(departure.q) * sense / departure.scale).xreplace(
        {departure.q: departure.at}
    ))  # fmt: skip
    (friction,) = departure.flyer.frictions

    def rolling(found: Expr) -> tuple[Expr, Expr]:
        there = {departure.q: departure.value}
        fast = sense * sqrt(squared_by_energy(departure.speed).xreplace(there))
        still = {rate(s): ZERO for s in departure.held}
        rates = {turn: found.xreplace(known), rate(departure.q): fast}
        return explicit(friction.residual).xreplace({**departure.held, **still}).xreplace({**rates, **there}), ZERO

    def torque(found: Expr) -> tuple[Expr, Expr]:
        ended = dict.fromkeys((departure.kept.force, friction.force), ZERO)
        (q,) = (s for s in departure.flyer.turning if rate(s) == turn)
        (own,) = (each for each in departure.equations if each.needed(OfCoordinate).coordinate.symbol == q)
        return explicit(own.value).residual.xreplace(ended).xreplace({rate(q, 2): diff(found, TIME)}), ZERO

    return establish(
        SPIN_IN_FLIGHT,
        turn,
        lambda V: factor * V,
        {"speed": speed},
        lines=Lines(arranged=lambda v: presented(v, in_sums=False)),
        routes={"rolling": rolling, "torque": torque},
        outcome="steady",
        phrase_data=PhraseData(
            outcome_data={
                "friction": friction.residual,
                "coordinate": departure.q,
                "place": departure.at,
                "turn": turn,
                "held": tuple(departure.held.items()),
                "speed_at": departure.scale,
                "sense": Integer(sense),
            }
        ),
        key=key,
        kind="angular speed",
    )


def _terms(place: Expr, velocity: Expr, acceleration: Expr) -> Iterator[Expr]:
    yield from (each for each in (place, velocity * TIME, acceleration * TIME**2 / 2) if each != 0)


def _noughts(count: int) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix([ZERO] * count)


def _residuals(departure: Departure, path: Sequence[Expr]) -> list[Expr]:
    """Return the residuals of Lagrange's equations without the forces of the lost contact, for a motion along a path.

    The rates and accelerations of the coordinates follow from the velocity and the acceleration along the path.
    """
    q = departure.flyer.coordinates
    place = Matrix([explicit(c) for c in departure.flyer.point.place])
    slopes = place.jacobian(list(q))
    velocity, acceleration = (Matrix([diff(c, TIME, n) for c in path]) for n in (1, 2))
    inverse = inverse_of(slopes)
    rates = inverse * velocity
    turning = sum((slopes.diff(s) * r for s, r in zip(q, rates, strict=True)), Matrix.zeros(2, 2))
    second = inverse * (acceleration - turning * rates)
    motion = dict(zip([*(rate(s) for s in q), *(rate(s, 2) for s in q)], [*rates, *second], strict=True))
    none = dict.fromkeys((departure.kept.force, *(each.force for each in departure.flyer.frictions)), ZERO)
    own = [each for each in departure.equations if each.needed(OfCoordinate).coordinate.symbol in q]
    return [tidied(explicit(each.value).residual.xreplace(none).xreplace(motion)) for each in own]


# --- where it ends ----------------------------------------------------------------------------------------------------


def landing(flight: Sequence[Quantity], on: Surface | None = None, key: str = "landing") -> tuple[Quantity, ...]:
    """Time, place and speed at which a free flight ends: on a plane, or on the circle that the particle left.

    For a round body, the place and the speed are those of its centre.

    flight   the two components of the flight, from `free_flight`
    on       a fixed plane; by default the circle of the motion before the flight

    The distance from the plane is a polynomial of degree 2 or less in the time. The flight ends at the first time after
    the departure at which this distance vanishes. For the circle, the squared distance from the centre minus the
    squared radius is t^3 (a t + b). The factor t^3 is due to the departure, where the particle is on the circle, moves
    along the circle, and needs no constraint force. If a t + b has no zero at a positive time, the particle does not
    meet the circle again.
    Second route: the place satisfies the equation of the path, which does not contain the time; the speed also follows
    from the derivatives of the components. Check: at the end the particle is on the plane or the circle, and before the
    end it is on the free side. Witness: the free flight of the described system is followed to the landing.
    Outcomes: on_plane, taut (the string becomes taut again), back (on the surface that the particle left), clear (the
    particle does not meet the circle again), misses (the particle does not reach the plane).
    Errors: the plane moves; a body that is not round flies; the particle may depart below the plane, or meet the circle
    before the plane; a sign is unknown; `on` is omitted, but the particle was not on a circle.
    Source: Morin, *Introduction to Classical Mechanics*, sections 3.4 and 5.3.
    """
    first, second = _both(flight)
    with where(first.needed(InFlight).conditions):
        return _ends(first, second, on, key)


def _ends(first: Quantity, second: Quantity, on: Surface | None, key: str) -> tuple[Quantity, ...]:
    known = first.needed(InFlight)
    if on is None:
        back = _time_back(known)
        if back is None:
            return (_clear(first, second, key),)
        return _landed(first, second, back, None, key, [])
    target = _fixed_plane(on)
    back = _time_back(known) if known.orbit is not None else None
    stays = known.orbit is not None and back is None
    parents = [_clear(first, second, f"{key}_clear")] if stays else []
    time = _time_to(known, target)
    if time is None:
        return (_misses(first, second, target, key),)
    if back is not None and sign_known(back - time) != 1:
        message = (
            f"`lands`: the particle meets its circle again at the time {back}, "
            "and is not known to reach the plane earlier"
        )
        help_line = "leave `on` out, or state with `assume:` which comes first, the circle or the plane"
        raise Rejected(Complaint("not-decided", message, help=help_line))
    return _landed(first, second, time, target, key, parents)


def _both(flight: Sequence[Quantity]) -> tuple[Quantity, Quantity]:
    found = [each for each in flight if each.fact(InFlight) is not None]
    if len(found) != 2 or any(each not in found and each.step.rule != SPIN_IN_FLIGHT.name for each in flight):
        names = ", ".join(f"`{each.key}`" for each in flight)
        message = f"`lands` and `passes` need both components of a flight, not {names}"
        raise Rejected(Complaint("wrong-argument", message, help="name a result of `flight`"))
    return found[0], found[1]


def _fixed_plane(on: Surface) -> Plane:
    if not isinstance(on, Plane) or len(on.through.components) != 2:
        message = "`lands` needs a plane as `on`; for the circle that the particle left, leave `on` out"
        raise Rejected(Complaint("wrong-argument", message))
    moving = changes(ImmutableDenseMatrix([*on.through.components, *on.unit_normal.components]))
    if on.of is not None or on.moves is not None or moving is not None:
        raise Rejected(Complaint("changes", "`lands` needs a plane at rest", help="give the plane a fixed place"))
    return on


def _time_back(known: InFlight) -> Expr | None:
    orbit = _orbit_of(known)
    parts = [*reversed(_beyond(known.path, orbit).expand().as_poly(TIME).all_coeffs())]
    if len(parts) != 5 or not all(is_zero(c) for c in parts[:3]):
        message = "the flight must begin on the circle, along the circle, and without a force from the circle"
        raise Unverified(Complaint("unverified", message))
    outwards, last = (tidied(c) for c in parts[3:])
    sign = sign_known(outwards)
    if orbit.inside and sign == -1:
        return presented(-outwards / last)
    if not orbit.inside and sign in (0, 1):
        return None
    message = "`lands`: it is not known on which side of the circle the particle flies"
    help_line = "set `at` of the flight to a symbol declared with a range, such as `theta_1: 'angle in (pi/2, pi)'`"
    raise Rejected(Complaint("not-decided", message, help=help_line))


def _orbit_of(known: InFlight) -> Orbit:
    if known.orbit is None:
        message = "`lands`: the particle was not on a circle, so it is not known whether the particle comes back"
        raise Rejected(Complaint("not-decided", message))
    return known.orbit


def _beyond(place: Sequence[Expr], orbit: Orbit) -> Expr:
    return Add(*((c - m) ** 2 for c, m in zip(place, orbit.centre, strict=True))) - orbit.radius**2


def _distance(place: Sequence[Expr], target: Plane) -> Expr:
    return dot(Location(tuple(place)) - target.through, target.unit_normal)


def _gap(place: Sequence[Expr], known: InFlight, target: Plane) -> Expr:
    """The distance of a particle or a round body from a plane, if the centre is at this place."""
    if known.radius is None:
        message = "`lands`: the body is not round about its centre of mass, so its contact with the plane is unknown"
        raise Rejected(Complaint("not-decided", message, help="ask for the flight of its centre of mass only"))
    return _distance(place, target) - known.radius


def _at(time: Expr, known: InFlight, order: int = 0) -> list[Expr]:
    return [diff(c, TIME, order).xreplace({TIME: time}) for c in known.path]


def _above(known: InFlight, target: Plane) -> list[Expr]:
    """The coefficients of t^0, t and t^2 in the distance from the plane."""
    parts = _gap(known.path, known, target).expand().as_poly(TIME)
    return [tidied(parts.coeff_monomial(TIME**n)) for n in range(3)]


def _time_to(known: InFlight, target: Plane) -> Expr | None:
    """Return the first time after the departure at which the particle is on the plane; None if it misses the plane."""
    h, v, a = _above(known, target)
    side, towards, bend = sign_known(h), sign_known(v), sign_known(a)
    if side not in (0, 1):
        how = "departs" if side == -1 else "may depart"
        message = f"`lands`: the particle {how} below the plane: its distance from the plane is {h}"
        help_line = "the free side is on the left of `along`; state with `assume:` which side the particle is on"
        raise Rejected(Complaint("not-decided", message, help=help_line))
    if side == 0 and (towards in (0, -1) or bend in (0, 1)):
        message = "`lands`: the particle departs on the plane, and does not rise above it or does not come back"
        raise Rejected(Complaint("contradiction", message, help="give a plane that the particle does not depart from"))
    inside = tidied(v**2 - 4 * a * h)
    if bend == -1:
        return presented(tidied((-v - sqrt(inside)) / (2 * a)))
    if towards in (0, 1) or bend == 1 and sign_known(inside) == -1:
        return None
    if towards == -1 and bend == 0:
        return presented(tidied(-h / v))
    if towards == -1 and bend == 1 and sign_known(inside) == 1:
        return presented(tidied((-v - sqrt(inside)) / (2 * a)))
    message = "`lands`: it is not known whether the particle reaches the plane"
    help_line = "state with `assume:` the condition for reaching the plane, or give numbers"
    raise Rejected(Complaint("not-decided", message, help=help_line))


STAYS_CLEAR = Rule(
    "motion.stays_clear",
    source=SOURCE,
    outcomes={"clear": claims.stays_clear, "misses": claims.misses},
    evidence={"distance": CHECK},
)


def _clear(first: Quantity, second: Quantity, key: str) -> Quantity:
    """The step for a particle that never meets its circle again: its distance from the centre exceeds the radius.

    Outcomes: clear.
    Source: the same as for `landing`.
    """
    known = first.needed(InFlight)
    orbit = _orbit_of(known)
    (cx, cy), radius = orbit.centre, orbit.radius

    def distance(found: Relation) -> tuple[Any, Any]:
        """Check the squared distance by its Taylor series at the departure."""
        whole = _beyond(known.path, orbit)
        series = [diff(whole, TIME, n).xreplace({TIME: ZERO}) * TIME**n / factorial(n) for n in range(5)]
        return found.residual, Add(*series)

    return establish(
        STAYS_CLEAR,
        None,
        lambda x, y: Relation((x - cx) ** 2 + (y - cy) ** 2, ">", radius**2),
        {"x": first, "y": second},
        lines=Lines(put_in=None, arranged=lambda found: Relation(_in_time(explicit(found.residual)), ">", 0)),
        routes={"distance": distance},
        outcome="clear",
        phrase_data=PhraseData(words={"flyer": known.noun}, outcome_data={"flight": known, "target": None}),
        key=key,
    )


def _in_time(value: Expr) -> Expr:
    """Write a polynomial in the time as t^n times a polynomial with a constant term."""
    terms = [(n, tidied(c)) for n, c in enumerate(reversed(value.expand().as_poly(TIME).all_coeffs()))]
    kept = [(n, presented(c, in_sums=False)) for n, c in terms if not is_zero(c)]
    least = min(n for n, _ in kept)
    return TIME**least * Add(*(c * TIME ** (n - least) for n, c in kept))


def _misses(first: Quantity, second: Quantity, target: Plane, key: str) -> Quantity:
    """The step for a particle that misses the plane: its least distance from the plane is positive.

    Outcomes: misses.
    Source: the same as for `landing`.
    """
    known = first.needed(InFlight)
    h, v, a = _above(known, target)
    least = presented(h - v**2 / (4 * a)) if sign_known(v) == -1 else presented(h)

    def distance(found: Relation) -> tuple[Any, Any]:
        """Check the distance from the plane at the time at which the distance is least."""
        turned = -v / (2 * a) if sign_known(v) == -1 else ZERO
        return found.residual, _gap(_at(turned, known), known, target)

    return establish(
        STAYS_CLEAR,
        None,
        lambda *_: Relation(least, ">", 0),
        {"x": first, "y": second},
        lines=Lines(put_in=None),
        routes={"distance": distance},
        outcome="misses",
        phrase_data=PhraseData(words={"flyer": known.noun}, outcome_data={"flight": known, "target": target}),
        key=key,
    )


LANDING_TIME = Rule(
    "motion.landing_time",
    source=SOURCE,
    outcomes={word: claims.lands(word) for word in ("on_plane", "taut", "back")},
    evidence={"put_back": CHECK},
)


def _landed(
    first: Quantity,
    second: Quantity,
    time: Expr,
    target: Plane | None,
    key: str,
    parents: Sequence[Quantity],
) -> tuple[Quantity, ...]:
    """The time at which the flight ends, and the place and the speed at this time.

    Outcomes: on_plane, taut, back.
    Source: the same as for `landing`.
    """
    known = first.needed(InFlight)

    def put_back(found: Expr) -> tuple[Any, Any]:
        there = _at(found, known)
        return (_beyond(there, _orbit_of(known)) if target is None else _gap(there, known, target)), ZERO

    back = "taut" if known.kept.enforcer == "string" else "back"
    when = establish(
        LANDING_TIME,
        scalar(free_letter("t_2"), positive=True),
        lambda *_: time,
        {"x": first, "y": second},
        lines=Lines(put_in=None, arranged=lambda v: v),
        routes={"put_back": put_back},
        outcome="on_plane" if target is not None else back,
        phrase_data=PhraseData(
            formulas=_where(known, target, first.symbol, second.symbol),
            words={"enforcer": known.kept.enforcer, "flyer": known.noun},
            outcome_data={"flight": known, "target": target},
        ),
        key=f"{key}_time",
        kind="time",
        parents=parents,
    )
    level = target is not None and tidied(target.unit_normal.components[0]) == 0
    components = (first,) if level else (first, second)
    places = [_component_there(when, each, i, f"{key}_{'xy'[i]}") for i, each in enumerate(components)]
    return when, *places, _speed_there(when, first, known, f"{key}_speed")


def _where(known: InFlight, target: Plane | None, x: Symbol, y: Symbol) -> dict[str, tuple[Relation, Relation]]:
    """The equation of the plane or the circle for x and y at the landing, as the sentence states it."""
    if target is None:
        orbit = _orbit_of(known)
        (cx, cy), radius = orbit.centre, orbit.radius
        told = Relation((x - cx) ** 2 + (y - cy) ** 2, "=", radius**2)
        return {"condition": (told, Relation(told.left.expand(), "=", told.right))}
    normal = target.unit_normal
    (px, py), (nx, ny) = (target.through + (known.radius or ZERO) * normal).components, normal.components
    for letter, n, p in ((y, nx, py), (x, ny, px)):
        if n == 0:
            return {"condition": (Relation(letter, "=", p), Relation(letter, "=", tidied(p)))}
    left = nx * (x - px) + ny * (y - py)
    return {"condition": (Relation(without_positive(tidied(left)), "=", ZERO), Relation(left, "=", ZERO))}


LANDING_PLACE = Rule("motion.landing_place", source=SOURCE, evidence={"orbit": ROUTE})


def _component_there(when: Quantity, path: Quantity, i: int, key: str) -> Quantity:
    """A component of the place where the flight ends.

    Second route: the equation of the orbit from the start 1 to the end 2. For an acceleration a along y, it is
    v_x^2 (y_2 - y_1) = v_x v_y (x_2 - x_1) + a (x_2 - x_1)^2/2 with the initial velocity (v_x, v_y).
    Source: the same as for `landing`.
    """
    known = path.needed(InFlight)
    there, begin = _at(explicit(when.value), known), _at(ZERO, known)
    v, a = _at(ZERO, known, 1), _at(ZERO, known, 2)

    def orbit(found: Expr) -> tuple[Any, Any]:
        ends = [found if k == i else c for k, c in enumerate(there)]
        dx, dy = (end - start for end, start in zip(ends, begin, strict=True))
        # the displacement perpendicular to the initial velocity, times the initial speed
        across = v[0] * dy - v[1] * dx
        return 2 * across * (v[0] * a[1] - v[1] * a[0]), (a[1] * dx - a[0] * dy) ** 2

    return establish(
        LANDING_PLACE,
        scalar(free_letter(f"{path.symbol}_2")),
        lambda t: explicit(path.value).xreplace({TIME: t}),
        {"time": when},
        lines=Lines(put_in=None, arranged=presented),
        routes={"orbit": orbit},
        key=key,
        kind="length",
        parents=[path],
    )


LANDING_SPEED = Rule("motion.landing_speed", source=SOURCE, evidence={"velocity": ROUTE})


def _speed_there(when: Quantity, path: Quantity, known: InFlight, key: str) -> Quantity:
    """Speed at which the flight ends, by conservation of energy: v_2^2 = v_1^2 + 2 a . (r_2 - r_1).

    Second route: the derivatives of the components of the place with respect to time.
    Source: the same as for `landing`.
    """
    speed = next(each for each in path.ancestors() if each.step.rule == DEPARTURE_SPEED.name)
    there, begin = _at(explicit(when.value), known), _at(ZERO, known)
    work = Add(*(a * (r - s) for a, r, s in zip(_at(ZERO, known, 2), there, begin, strict=True)))
    gained = presented(2 * work)

    def velocity(found: Expr) -> tuple[Any, Any]:
        return found**2, Add(*(c**2 for c in _at(explicit(when.value), known, 1)))

    return establish(
        LANDING_SPEED,
        scalar(free_letter("v_2"), nonnegative=True),
        lambda V: Root(Terms(V**2, gained)),
        {"speed": speed},
        lines=Lines(arranged=lambda v: presented(tidied(v), in_sums=False)),
        routes={"velocity": velocity},
        key=key,
        kind="speed",
        parents=[when],
    )


PASSES_THROUGH = Rule(
    "motion.passes_through",
    source=SOURCE,
    outcomes={"generic": claims.passes},
    evidence={"at_its_time": CHECK},
)


def passes_through(flight: Sequence[Quantity], through: Sequence[Any], key: str = "passes") -> Quantity:
    """Condition for a free flight to pass through a place.

    flight    the two components of the flight, from `free_flight`
    through   the place: its horizontal component and its height, m

    Positive factors of the condition are omitted. The place must be ahead of the particle.
    Check: the condition is equivalent to y(t) = Y at the time t with x(t) = X, where (X, Y) is the place.
    Errors: the particle always passes through the place, or never does; the horizontal velocity is zero or not
    constant; it is not known whether the place is ahead of the particle or, for a flight inside a circle, inside this
    circle.
    Source: Morin, *Introduction to Classical Mechanics*, sections 3.4 and 5.3.
    """
    first, second = _both(flight)
    with where(first.needed(InFlight).conditions):
        return _passes_through(first, second, through, key)


def _passes_through(first: Quantity, second: Quantity, through: Sequence[Any], key: str) -> Quantity:
    """The condition for a free flight to pass through a place.

    Source: the same as for `passes_through`.
    """
    known = first.needed(InFlight)
    X, Y = (tidied(explicit(c)) for c in through)
    _check_before_circle(known, (X, Y))
    v = tidied(diff(known.path[0], TIME).xreplace({TIME: ZERO}))
    if diff(known.path[0], TIME, 2) != 0 or v == 0:
        message = "`passes` needs a flight whose horizontal velocity is constant and not zero"
        raise Rejected(Complaint("wrong-argument", message))
    time = tidied((X - known.path[0].xreplace({TIME: ZERO})) / v)
    if sign_known(time) != 1:
        message = (
            "`passes`: the place is not known to be ahead of the particle, "
            f"since the time {time} is not known to be positive"
        )
        help_line = (
            "give a place ahead of the particle, or set `at` of the flight to a symbol declared with a range, "
            "such as `theta_1: 'angle in (pi/2, pi)'`"
        )
        raise Rejected(Complaint("not-decided", message, help=help_line))
    above = tidied(known.path[1].xreplace({TIME: time}) - Y)
    core = presented(without_positive(factored(above.as_numer_denom()[0]), in_equation=True), in_sums=False)
    sign = sign_known(above)
    if sign is not None:
        how = "passes through this place in any case" if sign == 0 else "never passes through this place"
        message = f"`passes`: the particle {how}, so there is no condition"
        raise Rejected(Complaint("no-condition", message, help="ask for the place and time of landing instead"))

    def at_its_time(found: Relation) -> tuple[Any, Any]:
        """Compare the condition with the height at this time, up to a factor that does not vanish."""
        there = known.path[1].xreplace({TIME: time}) - Y
        return found.residual * above, there * core

    return establish(
        PASSES_THROUGH,
        None,
        lambda *_: Relation(core, "=", 0),
        {"x": first, "y": second},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"at_its_time": at_its_time},
        phrase_data=PhraseData(
            formulas={
                "across": (Relation(first.symbol, "=", X), Relation(first.symbol, "=", through[0])),
                "upwards": (Relation(second.symbol, "=", Y), Relation(second.symbol, "=", through[1])),
            },
            outcome_data={"flight": known, "place": (X, Y)},
        ),
        key=key,
    )


def _check_before_circle(known: InFlight, place: Vector) -> None:
    """If the particle flies inside its circle, require the place to be inside too, because the flight ends on the
    circle."""
    if known.orbit is None or not known.orbit.inside:
        return
    if sign_known(tidied(_beyond(place, known.orbit))) != -1:
        message = "`passes`: the place is not known to be inside the circle, on which the flight ends"
        raise Rejected(Complaint("not-decided", message, help="give a place that is inside the circle"))


# --- for `results:` ---------------------------------------------------------------------------------------------------


@in_results(
    "flight",
    "the free motion after a contact is lost or a string goes slack, `flight_x` and `flight_y`",
    lost="flight: a result of `leaves`",
    at="at: a symbol for the value of the coordinate where the flight begins",
)
def _flight(lost: Quantity, key: str, at: Letter = None) -> tuple[Quantity, ...]:
    return checked(free_flight)(lost, at, key=key)


@in_results(
    "lands",
    "where and when a free flight ends, and with which speed",
    flight="lands: a result of `flight`",
    on="on: a plane under `surfaces`; by default the circle that the particle left",
)
def _lands(flight: Sequence[Quantity], key: str, on: SurfaceNamed = None) -> tuple[Quantity, ...]:
    return checked(landing)(flight, on, key=key)


@in_results(
    "passes",
    "the condition for a free flight to pass through a place",
    flight="passes: a result of `flight`",
    through="through: the components of the place, `[0, 0]`",
)
def _passes(flight: Sequence[Quantity], through: PlaceIn, key: str) -> Quantity:
    return checked(passes_through)(flight, through, key=key)
