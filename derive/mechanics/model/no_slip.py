"""Rolling without slipping: the particle of the body at the contact has the velocity of the surface at the contact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Matrix, Mul, Symbol, factor
from sympy.matrices import ImmutableMatrix

from derive.algebra.collect import by_rates
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Relation, TimeRate, as_expr, column, explicit, rate, stand_in
from derive.algebra.ranges import strict_sign_within
from derive.algebra.samples import generic_rank
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import PlacedBody, after
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.material import MaterialPoint, at_rest_in, material_point, particle_of
from derive.mechanics.model.system import KnownCoordinate
from derive.steps.establish import Lines, Scope, establish
from derive.steps.record import assume, changes, coordinates_in
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Fact, Form, Level, Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["no_slip"]

ZERO = Integer(0)
Ground: TypeAlias = Location | Axes | PlacedBody


def no_slip(
    body: PlacedBody,
    at: Location,
    ground: Ground | None = None,
    key: str = "no_slip",
    fixes: Coordinate | None = None,
) -> Quantity | tuple[Quantity, ...]:
    """Condition of rolling without slipping, v + omega x (r_contact - r) = v_surface, solved for a rate.

    body     a body that is placed or held; r is the place of its given point, and v the velocity of this point
    at       the place where the body touches the surface, m
    ground   the motion of the surface: a place on a surface that moves without rotation; the axes in which the surface
             is at rest, such as the axes of a turntable; or the body that carries the surface. By default the surface
             is at rest in space
    fixes    the coordinate whose rate is isolated. By default, a rate with a constant coefficient is isolated if there
             is one. Among several such rates, the rate of the last rotation comes first

    Each independent condition isolates a different rate. A condition can be integrated if all its terms are constants
    times rates. It may then be a part of a `System`, where it expresses one coordinate by other coordinates.
    Second route: differentiate the place of the particle at the contact, whose position in the body is constant.
    Check: if the particle at the contact has the velocity of the surface, each condition is satisfied.
    Errors: the body does not reach this place, or cannot roll there; the contact never slips; no
    condition isolates the rate of `fixes`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3; Landau, Lifshitz, *Mechanics*, section 32.
    """
    found: dict[Symbol, Quantity] = {}
    for condition in _independent(body, at, ground, fixes):
        name = key if not found else f"{key}_{len(found) + 1}"
        found[condition.q] = _solved(body, at, ground, condition, name, fixes)
    if fixes is not None and fixes.symbol not in found:
        isolated = ", ".join(rate(q).name for q in found)
        message = f"`no_slip` cannot isolate the rate of {fixes.symbol.name}: the conditions isolate {isolated}"
        help_line = "leave out `fixes`, or name a coordinate whose rate has a constant coefficient"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    return next(iter(found.values())) if len(found) == 1 else tuple(found.values())


@dataclass(frozen=True)
class Rolling(Fact):
    """The rolling body, the place of contact, and the ground; the ground is None if it is at rest."""

    missing = "is not a condition of rolling"
    body: PlacedBody
    at: Location
    ground: Ground | None


class _Condition:
    """A condition left = 0 on rates, and the coordinate whose rate this condition determines."""

    def __init__(self, left: Expr, q: Symbol, known: dict[Symbol, Expr]):
        self.left, self.q, self.known = left, q, known

    @property
    def factor(self) -> Expr:
        return derivative(self.left, rate(self.q))

    @property
    def rate(self) -> Expr:
        return tidied(-(self.left - self.factor * rate(self.q)) / self.factor)


def _independent(
    body: PlacedBody, at: Location, ground: Ground | None, fixes: Coordinate | None = None
) -> Iterator[_Condition]:
    """Yield the conditions of rolling, each with the rate that it determines. A condition that follows from earlier
    ones is skipped."""
    _check(body, at, ground)
    known: dict[Symbol, Expr] = {}
    first = [fixes.symbol] if fixes is not None else []
    order = list(dict.fromkeys([*first, *_order(body, at)]))
    for left in _conditions(contact_velocity(body, at, ground)):
        rest = tidied(left.subs(known))
        present = [q for q in order if not is_zero(derivative(rest, rate(q)))]
        steady = [q for q in present if changes(derivative(rest, rate(q)), order) is None]
        q = next(iter([*steady, *present]), None)
        if q is None:
            if not is_zero(rest):
                raise Rejected(Complaint("wrong-argument", f"the body cannot roll there: rolling requires {rest} = 0"))
            continue
        condition = _Condition(rest, q, dict(known))
        known[rate(q)] = condition.rate
        yield condition
    if not known:
        message = "the contact never slips, so rolling adds no condition"
        raise Rejected(Complaint("wrong-argument", message))


def _check(body: Any, at: Location, ground: Ground | None) -> None:
    if not isinstance(body, PlacedBody):
        message = "`no_slip` needs a body that is placed or held"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled("place it with `.placed` or `.held`", "give its `centre`, or `held` and `on`"),
            )
        )
    for place in (at, ground):
        if (
            place is not None
            and not isinstance(place, Axes | PlacedBody)
            and (not isinstance(place, Location) or len(place.components) != len(body.at.components))
        ):
            message = "`no_slip` needs places with as many components as the place of the body"
            raise Rejected(Complaint("wrong-argument", message))
    _check_reaches(body, at)


def _check_reaches(body: PlacedBody, at: Location) -> None:
    """For a body in a plane, reject a place of contact if its distance from the centre is constant and greater than
    the radius."""
    radius = getattr(body.body, "radius", None)
    if not isinstance(radius, Expr) or not body.is_plane:
        return
    way = (at - body.centre).components
    beyond = tidied(Add(*(c**2 for c in way)) - radius**2)
    if not coordinates_in(ImmutableDenseMatrix([beyond])) and strict_sign_within(beyond) == 1:
        where = ", ".join(map(str, at.components))
        message = f"{body.body.name} of radius {radius} does not reach ({where}), so it has no contact there"
        raise Rejected(Complaint("no-contact", message, help="give the place of contact as `at`"))


def _order(body: PlacedBody, at: Location) -> list[Symbol]:
    """The coordinates in the order in which rates are isolated: last rotation, earlier rotations, all others."""
    if isinstance(body.turned, Axes):
        turning = [q for _, angle in reversed(body.turned.turns) for q in coordinates_in(angle)]
    else:
        turning = list(coordinates_in(as_expr(body.turned)))
    everything = coordinates_in(ImmutableDenseMatrix([*body.depends_on, *at.components]))
    return list(dict.fromkeys([*turning, *everything]))


def contact_velocity(body: PlacedBody, at: Location, ground: Ground | None) -> ImmutableMatrix:
    """Velocity of the particle at the contact relative to the surface: v + omega x (r_contact - r) - v_surface."""
    v = velocity_at(body, at) - velocity_at(ground, at)
    return ImmutableDenseMatrix([tidied(c) for c in v.components])


def velocity_at(of: Any, at: Location) -> Location:
    """Velocity of the material at a place, m/s.

    of   a body, axes, a place or a particle that moves with the material; None if the material is at rest

    For a body the result is v + omega x (r_place - r); for rotating axes it is R_dot R^T r, which is omega x r.
    """
    if of is None:
        return Location((ZERO,) * len(at.components))
    if isinstance(of, Axes):
        turn, moving = of.in_space, list(coordinates_in(of.in_space))
        turning = turn.applyfunc(lambda entry: explicit(TimeRate(entry, *moving))) * turn.T
        return Location(tuple(turning * ImmutableDenseMatrix(at.components)))
    if not isinstance(of, PlacedBody):
        place = of if isinstance(of, Location) else of.at
        return Location(tuple(explicit(TimeRate(c, *coordinates_in(c))) for c in place.components))
    moving = list(coordinates_in(ImmutableDenseMatrix([*of.depends_on, *at.components])))
    arm = ImmutableDenseMatrix((at - of.at).components)
    v = ImmutableDenseMatrix([explicit(TimeRate(c, *moving)) for c in of.at.components])
    if isinstance(of.turned, Axes):
        turns = of.turned.turns
        omega = column(0, 0, 0)
        for i, (axis, angle) in enumerate(turns):
            about = after(turns[:i]) * column(*(int(k == axis) for k in range(3)))
            omega = omega + explicit(TimeRate(angle, *moving)) * about
        return Location(tuple(v + omega.cross(arm)))
    speed = explicit(TimeRate(of.turned, *moving))
    return Location(tuple(v + ImmutableDenseMatrix([-speed * arm[1], speed * arm[0]])))


def _conditions(velocity: ImmutableMatrix) -> list[Expr]:
    """Return the components of the velocity that are not identically zero.

    If all of them are multiples of one expression in the rates, return only this expression.
    """
    parts = [_rates_alone(component) for component in velocity if component != 0]
    if parts and all(is_zero(part - parts[0]) or is_zero(part + parts[0]) for part in parts):
        return parts[:1]
    return [component for component in velocity if component != 0]


def _rates_alone(component: Expr) -> Expr:
    """Return the product of the factors of a component that contain a rate; if no factor does, the component itself."""
    fast = {s for q in coordinates_in(component) for s in (rate(q),)}
    kept = [f for f in Mul.make_args(factor(component)) if f.free_symbols & fast]
    return Mul(*kept) if kept else component


NO_SLIP = Rule(
    "model.no_slip",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3; Landau, Lifshitz, *Mechanics*, section 32",
    evidence={"at_rest": ROUTE, "no_more": CHECK},
)


def _solved(
    body: PlacedBody, at: Location, ground: Ground | None, condition: _Condition, key: str, fixes: Coordinate | None
) -> Quantity:
    """Condition of rolling, solved for one rate."""
    q, found = condition.q, condition.rate
    involved = coordinates_in(ImmutableDenseMatrix([*body.depends_on, *at.components, condition.left]))
    moving = list(involved)  # the condition also contains the coordinates of a moving surface
    marks = [stand_in(f"delta_{i}") for i in range(len(at.components))]

    def at_rest(relation: Relation) -> tuple[Expr, Expr]:
        """Check that the particle at the contact is at rest on the surface if all conditions are satisfied."""
        velocity = velocity_of_particle(body, at, ground)
        known = {**_all_rates(body, at, ground, fixes), relation.left: relation.right}
        return Add(*(m * v.subs(known) for m, v in zip(marks, velocity, strict=True))), ZERO

    def no_more(relation: Relation) -> tuple[Expr, Expr]:
        """Check that the condition holds if the particle is at rest on the surface: as a further row, the condition
        does not raise the rank.
        """
        lines = velocity_of_particle(body, at, ground)
        return Integer(_rank([*lines, relation.residual], moving)), Integer(_rank(lines, moving))

    coefficients = [derivative(found, rate(other)) for other in moving]
    plain = found - Add(*(c * rate(other) for c, other in zip(coefficients, moving, strict=True)))
    constant = all(changes(c, moving) is None for c in coefficients) and is_zero(plain)
    facts: list[Fact] = [Rolling(body, at, ground)]
    if constant:
        function = Add(*(c * other for c, other in zip(coefficients, moving, strict=True)))
        facts.append(KnownCoordinate(q, function))  # the constant of integration is zero by choice of the origins
    factors = tuple(f.as_base_exp()[0] for f in Mul.make_args(condition.factor) if not f.is_nonzero)
    for each in factors:
        assume(Relation(each, "!=", ZERO))
    solved = Relation(rate(q), "=", found)
    return establish(
        NO_SLIP,
        None,
        lambda: Relation(by_rates(condition.left, moving), "=", ZERO),
        {},
        lines=Lines(
            law=Level.FULL,
            put_in=None,
            result=False,
            after=[Form(solved, "result", Level.BRIEF, factors)],
            arranged=lambda _: solved,
        ),
        routes={"at_rest": at_rest, "no_more": no_more},
        key=key,
        facts=facts,
        scope=Scope(coordinates=involved, about=Subject(body=body.body)),
    )


def _rank(lines: list[Expr], moving: list[Symbol]) -> int:
    """The rank of conditions that are linear in the rates, at a generic point."""
    rates = [rate(q) for q in moving]
    still = dict.fromkeys(rates, ZERO)
    rows = Matrix([[*(slope(line, v) for v in rates), line.xreplace(still)] for line in lines])
    return generic_rank(rows)


def _all_rates(body: PlacedBody, at: Location, ground: Ground | None, fixes: Coordinate | None) -> dict[Symbol, Expr]:
    found: dict[Symbol, Expr] = {}
    for condition in _independent(body, at, ground, fixes):
        found = {fixed: value.subs(rate(condition.q), condition.rate) for fixed, value in found.items()}
        found[rate(condition.q)] = condition.rate
    return found


def _particle_of_ground(ground: Ground, at: Location) -> MaterialPoint:
    if isinstance(ground, Axes):
        return at_rest_in(ground, at)
    return particle_of(ground, at) if isinstance(ground, PlacedBody) else MaterialPoint(ground.components)


def velocity_of_particle(body: Any, at: Location, ground: Ground | None, foot: Location | None = None) -> list[Expr]:
    """Velocity of the particle at the contact relative to the surface, by differentiation with respect to t.

    body   a placed body or a particle; None for a fixed place
    foot   the place of the particle of the surface; by default `at`

    During differentiation, the position of the particle in the body is constant.
    """
    point = material_point("no_slip", body, at)
    fast = [by_functions_of_time(c, list(coordinates_in(c))).subs(point.values) for c in point.place]
    if ground is None:
        return fast
    surface = _particle_of_ground(ground, foot or at)
    slow = [by_functions_of_time(c, list(coordinates_in(c))).subs(surface.values) for c in surface.place]
    return [a - b for a, b in zip(fast, slow, strict=True)]
