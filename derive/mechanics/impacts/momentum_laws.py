"""The laws of momentum and of angular momentum in an impact, for the bodies that the impulses strike.

An impulse at a fixed axis has no torque about the axis, and the impulses between two bodies are equal and opposite. So
the angular momentum of all bodies about the axis changes only by the torques of the other impulses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, Integer, Symbol

from derive.algebra.collect import by_rates
from derive.algebra.expressions import Factors, Relation, Terms, TimeRate, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.impacts import claims
from derive.mechanics.impacts.impact import Impact
from derive.mechanics.impacts.impulses import momentum_jump
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.lagrange.energies import kinetic_energy_of
from derive.mechanics.model.rigid import inertia_of, is_about_the_point
from derive.mechanics.newton.single_bodies import (
    ZERO,
    Alone,
    Force,
    Vector,
    allows,
    arm,
    bodies_alone,
    body_of,
    changes_for,
    dot,
    is_same,
    moves_like,
    rotated,
    sense_of,
    sum_of,
    unit_along,
)
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import unrecorded
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Quantity, is_zero, value_behind
from derive.steps.subject import EVERYTHING, Subject

__all__ = ["angular_momentum_law", "momentum_law"]


@dataclass(frozen=True)
class Struck:
    """An impulse, given or unknown, and the particle or body on which it acts."""

    impulse: Force
    on: Any


def impulses_on_bodies(impact: Impact) -> list[Struck]:
    """The given impulses at places and the impulses of collisions, if they act on a body or a particle. The impulse of
    a collision acts on both bodies, in opposite directions."""
    found = [Force(each.components, each.at) for each in impact.impulses if len(each.at) > 1]
    for each in impact.meetings:
        if each.ends is not None:
            start, end, along = each.ends
            found += [Force(tuple(sign * each.letter * c for c in along), at) for sign, at in ((-1, start), (1, end))]
    return [Struck(impulse, on) for impulse in found if (on := _body_at(impact, impulse.at or ())) is not None]


def _body_at(impact: Impact, place: Vector) -> Any:
    """The particle or body with a point that moves like the place at the instant of the impact; None for a place at
    rest."""
    slopes = {q: tuple(c.diff(q) for c in place) for q in impact.moving}
    if all(is_zero(impact.there(c)) for slope in slopes.values() for c in slope):
        return None
    on = [each.part for each in bodies_alone(impact.system) if moves_like(each, place, slopes, impact.there)]
    if len(on) != 1:
        message = f"an impulse acts at ({', '.join(map(str, place))}), but it is unknown on which body"
        raise Rejected(Complaint("method", message, help="use `method: lagrange`"))
    return on[0]


@dataclass(frozen=True)
class Balance:
    """A law of momentum or of angular momentum in an impact: `after` = `before` + `gained`.

    after    the terms of the momentum just after the impact, each an expression, or a pair of a moment of inertia and
             an angular velocity
    before   the momentum just before the impact
    gained   the impulses, or their torques
    changes  coordinate -> its change in a virtual displacement. Lagrange's equations, each multiplied by the change of
             its coordinate, add up to this law
    """

    after: Sequence[tuple[Any, Expr] | Expr]
    before: Expr
    gained: Sequence[Expr]
    changes: Mapping[Symbol, Expr]

    @property
    def inertias(self) -> dict[str, Any]:
        pairs = [term for term in self.after if isinstance(term, tuple)]
        return {f"inertia_{i}": inertia for i, (inertia, _) in enumerate(pairs)}

    def law(self, moving: Sequence[Symbol], inertias: Sequence[Any]) -> Relation:
        waiting = iter(inertias)
        left = [
            Factors(next(waiting), term[1]) if isinstance(term, tuple) else by_rates(tidied(term), moving)
            for term in self.after
        ]
        return Relation(Terms(*left) if len(left) > 1 else left[0], "=", sum_of([self.before, *self.gained]))


MOMENTUM_LAW = Rule(
    "impacts.momentum_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    outcomes={"struck": claims.has_impulse(True), "kept": claims.has_impulse(False)},
    evidence={"lagrange": ROUTE},
    statements=[claims.momentum_of_the_body],
    named={"coordinate": claims.coordinate_of_the_body, "mass": claims.mass_of_the_body},
)


def momentum_law(impact: Impact, q: Coordinate, key: str | None = None) -> Quantity:
    """Momentum of one body in an impact along the direction of a coordinate, m v = m v_before + sum of J.

    impact   the system, its state and the impulses
    q        a coordinate that moves the centre of mass of one body

    Second route: the integral of Lagrange's equations over the time of the impact, for a displacement of this body
    only.
    Outcomes: struck (impulses along the direction change the momentum), kept (no impulse changes it).
    Errors: the coordinates do not let one body move with q while all others stay at rest; it is unknown on which body
    an impulse acts.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    body = body_of(impact.system, q.symbol)
    way = tuple(tidied(impact.there(c)) for c in unit_along(body.shift(q.symbol)))
    momentum = body.mass * dot(_velocity(body), way)
    gained = [each.impulse.along(way) for each in impulses_on_bodies(impact) if each.on is body.part]
    changes = changes_for(impact.system, {body.part: (*way, ZERO)}, impact.there)
    balance = Balance([impact.there(momentum)], impact.earlier(momentum), gained, changes)
    return establish(
        MOMENTUM_LAW,
        None,
        lambda: balance.law(impact.moving, []),
        {},
        lines=Lines(put_in=None, arranged=explicit, result=False),
        routes={"lagrange": lambda found: _by_lagrange(found, impact, balance)},
        outcome="kept" if is_zero(Add(*gained)) else "struck",
        phrase_data=PhraseData(
            named={"coordinate": q.symbol, "mass": body.mass},
            outcome_data={**_data(impact, gained), "place": body.centre, "weight": body.mass, "way": way},
        ),
        key=key or f"jump_{q.symbol.name}",
        facts=[OfCoordinate(q), impact.described],
        scope=_scope(impact),
    )


ANGULAR_MOMENTUM_LAW = Rule(
    "impacts.angular_momentum_law",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7",
    outcomes={
        "kept": claims.about_a_fixed_axis(struck=False),
        "struck": claims.about_a_fixed_axis(struck=True),
        "about_centre": claims.about_the_centre,
    },
    evidence={"lagrange": ROUTE},
    statements=[claims.angular_momentum_of_the_bodies],
    named={"coordinate": claims.coordinate_of_the_body},
)


def angular_momentum_law(impact: Impact, q: Coordinate, key: str | None = None) -> Quantity:
    """Angular momentum in an impact, L = L_before + sum of the torques of the impulses. The law is for all bodies,
    about the fixed axis of the body that rotates with the coordinate q. If this body has no fixed axis, or if the
    coordinates do not allow all bodies to rotate about the axis, the law is for this body only. It is then about the
    fixed axis or the centre of mass of this body.

    impact   the system, its state and the impulses
    q        a coordinate that rotates one body

    Second route: the integral of Lagrange's equations over the time of the impact, for the rotation of these bodies.
    Outcomes: kept (about a fixed axis, and the impulses have no torque about it), struck (about a fixed axis, and the
    impulses have a torque about it), about_centre.
    Errors: the coordinates do not allow the rotation; it is unknown on which body an impulse acts.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7.
    """
    body = body_of(impact.system, q.symbol)
    bodies, about, changes = _rotation(impact, body)
    sense = sense_of(body.turn(q.symbol))
    terms = [term for each in bodies for term in _angular_momentum(each, about, sense)]
    here = tuple(impact.there(c) for c in about)
    struck = [each for each in impulses_on_bodies(impact) if any(each.on is one.part for one in bodies)]
    torques = [sense * impact.there(each.impulse.torque(here)) for each in struck]
    gained = [] if is_zero(Add(*torques)) else torques  # the impulses between two bodies cancel
    balance = Balance(
        [(term[0], tidied(impact.there(term[1]))) if isinstance(term, tuple) else impact.there(term) for term in terms],
        Add(*(impact.earlier(_value(term)) for term in terms)),
        gained,
        {s: sense * change for s, change in changes.items()},
    )
    on_axis = "struck" if gained else "kept"
    return establish(
        ANGULAR_MOMENTUM_LAW,
        None,
        lambda *inertias: balance.law(impact.moving, inertias),
        balance.inertias,
        lines=Lines(arranged=explicit, result=False),
        routes={"lagrange": lambda found: _by_lagrange(found, impact, balance)},
        outcome=on_axis if body.axis is not None and is_same(body.axis, about) else "about_centre",
        phrase_data=PhraseData(
            named={"coordinate": q.symbol},
            outcome_data={
                **_data(impact, gained),
                "about": about,
                "angle": body.angle,
                "bodies": tuple((each.mass, each.centre, each.spread, each.angle) for each in bodies),
                "count": len(bodies_alone(impact.system)),
            },
        ),
        key=key or f"jump_{q.symbol.name}",
        facts=[OfCoordinate(q), impact.described],
        scope=_scope(impact),
    )


def _rotation(impact: Impact, body: Alone) -> tuple[list[Alone], Vector, dict[Symbol, Expr]]:
    """Return the bodies in the law, the point of the law, and the change of each coordinate per angle of rotation. In
    this rotation, the bodies rotate counterclockwise about the point."""
    choices: list[tuple[list[Alone], Vector]] = [([body], body.centre)]
    if body.axis is not None:
        choices = [(bodies_alone(impact.system), body.axis), ([body], body.axis), *choices]
    for bodies, about in choices:
        turned = {each.part: (*rotated(each, about), Integer(int(each.is_body))) for each in bodies}
        if allows(impact.system, turned, impact.there):
            return bodies, about, changes_for(impact.system, turned, impact.there)
    message = (
        "the coordinates do not let one body rotate while all others stay at rest, "
        "because a connection has no symbol for its impulse"
    )
    raise Rejected(Complaint("method", message, help="use `method: lagrange`"))


def _angular_momentum(body: Alone, about: Vector, sense: Expr) -> list[tuple[Any, Expr] | Expr]:
    """The angular momentum about a point: M r x v for a particle; I omega for a body, and also M r x v unless I is
    about this point."""
    (x, y), (u, v) = arm(body.centre, about), _velocity(body)
    carried = sense * body.mass * (x * v - y * u)
    if not body.is_body:
        return [carried]
    turning = (inertia_of(body.part), sense * explicit(TimeRate(body.angle, *body.moving)))
    is_whole = is_same(body.centre, about) or body.axis is not None and is_about_the_point(body.part)
    return [turning] if is_whole else [turning, carried]


def _value(term: tuple[Any, Expr] | Expr) -> Expr:
    return explicit(value_behind(term[0])) * term[1] if isinstance(term, tuple) else term


def _velocity(body: Alone) -> Vector:
    return tuple(explicit(TimeRate(c, *body.moving)) for c in body.centre)


def _by_lagrange(found: Relation, impact: Impact, balance: Balance) -> tuple[Expr, Expr]:
    """Return left minus right side of the law, and left minus right side of a sum of Lagrange's equations. For this
    sum, each equation is integrated over the impact and multiplied by the change of its coordinate."""
    with unrecorded():
        kinetic, kinds = kinetic_energy_of(impact.system), impact.system.coordinates
        of = {s: momentum_jump(impact, kinetic, Coordinate(s, kinds[s])) for s in balance.changes}
    jumps = [change * explicit(of[s].value).residual for s, change in balance.changes.items()]
    return explicit(found).residual, Add(*jumps)


def _data(impact: Impact, gained: Sequence[Expr]) -> dict[str, Any]:
    return {"moving": tuple(impact.moving), "at": tuple(impact.at.items()), "impulses": tuple(gained)}


def _scope(impact: Impact) -> Scope:
    letters = dict.fromkeys((each.letter for each in impact.meetings), "momentum")
    coordinates = {**impact.system.coordinates, **letters}
    return Scope(coordinates=coordinates, about=Subject(body=impact.system), differ=EVERYTHING)
