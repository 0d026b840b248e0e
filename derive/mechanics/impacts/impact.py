"""An impact: the impulses on a system at one instant, the coordinates at this instant, and the rates before the
impact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, diff, sqrt

from derive.algebra.expressions import At, Factors, Partial, Relation, TimeRate, as_expr, explicit, rate
from derive.algebra.ranges import strict_sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import body_at
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time, unknown
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.acted_on import WrongPart
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.description import Struck, places_that_move_alone
from derive.mechanics.model.material import material_point
from derive.mechanics.model.system import System
from derive.steps.record import assume, coordinates_in, require_constant
from derive.steps.step import is_zero
from derive.witness import description as plain

__all__ = ["Impact", "angular_impulse", "collision", "impulse"]

ZERO, ONE = Integer(0), Integer(1)
Vector = tuple[Expr, ...]


@dataclass(frozen=True)
class Impulse:
    """A given impulse at a place, N s; or an angular impulse along an angle, N m s.

    components   the components of the impulse; an `Impact` substitutes the coordinates at its instant
    at           the components of the place, or the angle as the only component
    of           the body or particle on which the impulse acts, or "massless"; None if it is neither stated nor known
                 from the place
    given        the components as the author gave them, for a second route
    """

    components: Vector
    at: Vector
    of: Any = None
    given: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Collision:
    """A collision of two places; if `start` is None, the place `end` meets an object at rest.

    along         the unit vector of the common normal, along which the impulse acts; empty if there is no normal and
                  the places stay together
    restitution   the ratio of the speed of separation to the speed of approach
    letter        the symbol of the impulse; without a normal, the symbol of each component of the impulse also has the
                  axis as an index
    of            two entries, for the start and for the end: the body or particle there; None if it is neither stated
                  nor known from the place
    given         the normal and the restitution as the author gave them, for a second route
    """

    start: Location | None
    end: Location
    along: Vector
    restitution: Expr
    letter: str
    of: tuple[Any, Any] = (None, None)
    given: tuple[tuple[Any, ...], Any] = ((), 0)


def impulse(components: Any, at: Location, of: Any = None) -> Impulse:
    """A given impulse at a place, N s: the integral of a force over the short time of an impact.

    of   the body or particle on which the impulse acts, or "massless"; needed if the place moves, but no body or
         particle moves with it
    """
    if not isinstance(at, Location) or len(components) != len(at.components):
        message = "`impulse` needs a place, and as many components as the place has"
        raise Rejected(Complaint("wrong-argument", message))
    return Impulse(tuple(as_expr(c) for c in components), at.components, body_at(at, of), tuple(components))


def angular_impulse(amount: Any, on: Any) -> Impulse:
    """A given angular impulse along an angle, N m s: the integral of a torque over the short time of an impact."""
    if not coordinates_in(as_expr(on)):
        raise Rejected(Complaint("wrong-argument", f"`angular_impulse` needs a moving angle, but {on} does not move"))
    return Impulse((as_expr(amount),), (as_expr(on),), given=(amount,))


def collision(
    start: Location | None,
    end: Location,
    along: Sequence[Any] = (),
    restitution: Any = ZERO,
    letter: str = "K",
    of: Any = None,
) -> Collision:
    """A collision of two places, or of one place with an object at rest.

    Either the collision is smooth, and the impulse is along a normal, or the places stay together.

    start, end    the places; `start` is None if `end` meets an object at rest
    along         a vector along the common normal, from `start` to `end`, of any length; without a normal, both places
                  have the same velocity after the collision
    restitution   coefficient of restitution: 1 for an elastic collision, 0 if the places do not separate
    letter        symbol of the impulse, N s, which acts on the end; the opposite impulse acts on the start
    of            the body or particle at the end, or a pair for start and end; needed for a moving place if no body or
                  particle moves with it
    """
    size = len(end.components)
    if start is not None and len(start.components) != size:
        raise Rejected(Complaint("wrong-argument", "one place of a collision has two components, and the other three"))
    normal = tuple(as_expr(c) for c in along)
    if normal and (len(normal) != size or all(c == 0 for c in normal)):
        message = f"`collision` needs {size} components as its normal, not all zero"
        raise Rejected(Complaint("wrong-argument", message))
    part = as_expr(restitution)
    if not normal and part != 0:
        message = "a collision after which the places separate needs a normal"
        raise Rejected(Complaint("wrong-argument", message, help="give `along`"))
    if (part < 0) == True or (part > 1) == True:  # noqa: E712  the relation may be undecided
        raise Rejected(
            Complaint("wrong-argument", f"a coefficient of restitution must be between 0 and 1, but {part} is not")
        )
    size_of_normal = tidied(sqrt(Add(*(c**2 for c in normal)))) if normal else ONE
    unit = tuple(tidied(c / size_of_normal) for c in normal)
    ends = (of[0], of[1]) if isinstance(of, tuple | list) and len(of) == 2 else (None, of)
    bodies = (body_at(start, ends[0]), body_at(end, ends[1]))
    return Collision(start, end, unit, part, letter, bodies, (tuple(along), restitution))


@dataclass(frozen=True)
class Meeting:
    """One condition on the rates just after an impact, and the impulse that enforces this condition.

    gap          the quantity whose rate the condition determines, such as the distance along the normal; for a
                 constraint on rates, the rate itself
    restitution  the ratio of the rate just after the impact to the rate just before, times -1
    what         "together", "elastic" or "rebound" for a collision; "kept" for a constraint of the system
    ends         the two places of a collision, and the unit vector along which the impulse acts on the second place
    given        the restitution as the author gave it
    """

    gap: Expr
    restitution: Expr
    letter: Symbol
    what: str
    in_rates: bool = False
    ends: tuple[Vector, Vector, Vector] | None = None
    given: Any = 0

    def speed(self, moving: Sequence[Symbol]) -> Any:
        return self.gap if self.in_rates else TimeRate(self.gap, *moving)

    def along(self, q: Symbol) -> Any:
        return diff(self.gap, rate(q)) if self.in_rates else Partial(self.gap, q)

    def slope(self, q: Symbol) -> Expr:
        return diff(self.gap, rate(q) if self.in_rates else q)

    def speed_by_time(self, moving: Sequence[Symbol]) -> Expr:
        """Return the rate of the gap by the second route; for a collision, from the velocities of the two places."""
        if self.in_rates:
            return self.gap
        if self.ends is None:
            return by_functions_of_time(self.gap, moving)
        start, end, along = self.ends
        velocities = [[by_functions_of_time(c, moving) for c in place] for place in (start, end)]
        return Add(*(n * (v - u) for u, v, n in zip(*velocities, along, strict=True)))


class Impact:
    """An impact on a system at one instant.

    system   the particles and bodies; during the impact, an impulse enforces each constraint for which the
             system has a force
    acts     given impulses, and collisions
    at       coordinate -> its value at this instant; coordinates without a value remain symbols
    before   coordinate -> its rate just before the impact, by default zero
    """

    def __init__(
        self,
        system: System,
        *acts: Impulse | Collision,
        at: Mapping[Any, Any] | None = None,
        before: Mapping[Any, Any] | None = None,
    ):
        self.system = system
        self.moving = list(system.coordinates)
        self.at = {self._coordinate(q): as_expr(value) for q, value in (at or {}).items()}
        given = {self._coordinate(q): as_expr(value) for q, value in (before or {}).items()}
        for value in (*self.at.values(), *given.values()):
            require_constant("Impact", "state", value)
        self.before = {rate(q): given.get(q, ZERO) for q in self.moving}
        self._given = (dict(at or {}), dict(before or {}))
        if not acts:
            raise Rejected(Complaint("wrong-argument", "an `Impact` needs an impulse or a collision"))
        known = system.known
        self.acts = acts
        self._check_material_points(acts)
        self.impulses = [
            Impulse(
                tuple(self.there(c) for c in act.components),
                tuple(c.subs(known) for c in self._particle(act.of, act.at)),
                act.of,
                act.given,
            )
            for act in acts
            if isinstance(act, Impulse)
        ]
        self.meetings = [m for act in acts if isinstance(act, Collision) for m in self._meetings(act)]
        self.meetings += [self._kept(c) for c in system.constraints]
        letters = [m.letter for m in self.meetings]
        if len(set(letters)) < len(letters):
            message = "two impulses of this impact have the same symbol"
            raise Rejected(
                Complaint("letter-clash", message, help="give each impulse a different symbol, such as `impulse: K_2`")
            )

    def _check_material_points(self, acts: Sequence[Impulse | Collision]) -> None:
        """A place without a stated body, of an impulse or a collision, must be at rest or move with a body or a
        particle."""
        asked: list[tuple[Any, Vector]] = []
        for act in acts:
            if isinstance(act, Impulse):
                asked += [(act, act.at)] if act.of is None and len(act.at) > 1 else []
            else:
                ends = zip((act.start, act.end), act.of, strict=True)
                asked += [(act, at.components) for at, of in ends if at is not None and of is None]
        for i in places_that_move_alone(self.system.described.description, [place for _, place in asked]):
            act, place = asked[i]
            where = ", ".join(map(str, place))
            message = f"an impulse at ({where}) acts on no particle or body: none moves with this place"
            help_line = "name the body on which the impulse acts, `of: rod`; for a collision both, `of: [ball, rod]`"
            raise WrongPart.of(act, Complaint("which-body", message, help=help_line))

    def _particle(self, of: Any, at: Vector) -> Vector:
        """Return the place of the material point on which the impulse acts, as a function of the coordinates."""
        if of is None or len(at) < 2:
            return at
        point = material_point("impulse", of, Location(at))
        arms = {name: tidied(self.there(value)) for name, value in point.held}
        if moving := coordinates_in(ImmutableDenseMatrix([ZERO, *arms.values()])):
            name = next(iter(moving)).name
            message = f"the point of the body on which the impulse acts depends on {name}"
            raise Rejected(Complaint("changes", message, help=f"give the value of `{name}` at the impact under `at`"))
        return tuple(c.xreplace(arms) for c in point.place)

    @property
    def described(self) -> Struck:
        """Return a description of the impact for the witness, the independent numerical check."""
        acts = self.acts
        given = [plain.Force(a.components, a.at, self._number(a.of)) for a in acts if isinstance(a, Impulse)]
        meetings = [self._described_meeting(act) for act in acts if isinstance(act, Collision)]
        system = self.system.described.description
        impact = plain.Impact(system, tuple(given), tuple(meetings), tuple(self.at.items()), tuple(self.before.items()))
        return Struck(impact)

    def _number(self, of: Any) -> int | None:
        return next((i for i, body in enumerate(self.system.described_bodies) if body == of), None)

    def _described_meeting(self, act: Collision) -> plain.Meeting:
        start, end = (
            None if at is None else plain.Force((ZERO,) * len(at.components), at.components, self._number(of))
            for at, of in zip((act.start, act.end), act.of, strict=True)
        )
        assert end is not None
        axes = "xyz"[: len(end.place)]
        names = [act.letter] if act.along else [f"{act.letter}_{axis}" for axis in axes]
        letters = tuple(unknown(name, "momentum") for name in names)
        return plain.Meeting(start, end, act.along, act.restitution, letters)

    def _coordinate(self, q: Any) -> Symbol:
        symbol = q.symbol if isinstance(q, Coordinate) else q
        if symbol not in self.moving:
            message = f"nothing in this `Impact` moves with {symbol}"
            raise Rejected(Complaint("wrong-argument", message))
        return symbol

    def there(self, value: Any) -> Expr:
        """Return an expression at the instant of the impact, with the given values of coordinates substituted."""
        return explicit(value).subs(self.at, simultaneous=True)

    def shown_there(self, value: Any, holds: Any) -> Any:
        """Return the value in the notation of the page, with "at q = q_0" for each coordinate q that has a given value
        at the impact and occurs in the expression `holds`."""
        for q, place in self.at.items():
            if explicit(holds).has(q) and q != place:
                value = At(value, q, place)
        return value

    def earlier(self, value: Any) -> Expr:
        """Return an expression with the coordinates and the rates just before the impact substituted."""
        return self.there(value).xreplace(self.before)

    def read_again(self, value: Any, rates: bool = False) -> Expr:
        """Return an expression at the instant of the impact, with the state substituted as the author gave it.

        rates   whether to substitute also the rates just before the impact, not only the coordinates
        """
        places, speeds = ({getattr(q, "symbol", q): at for q, at in given.items()} for given in self._given)
        found = explicit(value).subs(list(places.items()), simultaneous=True)
        if rates:
            found = found.subs([(rate(q), speeds.get(q, 0)) for q in self.system.coordinates], simultaneous=True)
        return as_expr(found)

    def _meetings(self, act: Collision) -> list[Meeting]:
        size = len(act.end.components)
        start, end = (
            tuple(c.subs(self.system.known) for c in self._particle(of, at.components)) if at else (ZERO,) * size
            for at, of in zip((act.start, act.end), act.of, strict=True)
        )
        way = [b - a for a, b in zip(start, end, strict=True)]
        along = tuple(self.there(c) for c in act.along)
        if along and (coordinates := coordinates_in(ImmutableDenseMatrix(along))):
            name = next(iter(coordinates)).name
            raise Rejected(
                Complaint(
                    "changes",
                    f"the normal of this collision depends on {name}",
                    help=f"give the value of `{name}` at the impact under `at`",
                )
            )
        if act.start is not None:
            self._check_meet([self.there(c) for c in way], along)
        if not along:
            names = [f"{act.letter}_{axis}" for axis in ("xy" if size == 2 else "xyz")]
            units = [tuple(Integer(i == k) for i in range(size)) for k in range(size)]
            given = zip(way, names, units, strict=True)
            every = [self._meeting(gap, ZERO, name, "together", (start, end, unit)) for gap, name, unit in given]
            found = [each for each in every if each is not None]
            if not found:
                raise Rejected(
                    Complaint("nothing-happens", "the two places of this collision already have the same velocity")
                )
            return found
        gap = Add(*(c * w for c, w in zip(along, way, strict=True)))
        what = "together" if act.restitution == 0 else "elastic" if act.restitution == 1 else "rebound"
        as_given = tuple(self.read_again(c) for c in act.given[0])
        size = sqrt(sum(c**2 for c in as_given))  # the law uses a unit normal
        as_given = tuple(c / size for c in as_given)
        one = self._meeting(gap, act.restitution, act.letter, what, (start, end, as_given), act.given[1])
        if one is None:
            raise Rejected(
                Complaint(
                    "nothing-happens", "the two places of this collision have no relative motion along its normal"
                )
            )
        if not self.impulses:
            self._check_approach(-self.earlier(TimeRate(gap, *self.moving)))
        return [one]

    def _check_approach(self, speed: Expr) -> None:
        """Require that the two places approach each other along the normal, because surfaces can push but not pull. If
        it is unknown whether the places approach each other, the page assumes that they do."""
        sign = 0 if is_zero(speed) else strict_sign_within(speed)
        if sign == 0:
            message = "the two places do not approach each other before this collision"
            help_line = "in `before`, give rates with which they approach each other"
            raise Rejected(Complaint("nothing-happens", message, help=help_line))
        if sign == -1:
            message = "the two places move apart before this collision, along its normal"
            help_line = "reverse the rates in `before`, or the normal, which points from the first place to the second"
            raise Rejected(Complaint("nothing-happens", message, help=help_line))
        if sign is None:
            assume(Relation(tidied(speed), ">", Integer(0)))

    def _meeting(
        self,
        gap: Expr,
        restitution: Expr,
        letter: str,
        what: str,
        ends: tuple[Vector, Vector, Vector],
        given: Any = 0,
    ) -> Meeting | None:
        """Return the condition for one gap; None if the gap cannot change at this instant."""
        if is_zero(self.there(TimeRate(gap, *self.moving))):
            return None
        return Meeting(gap, restitution, unknown(letter, "momentum"), what, ends=ends, given=given)

    def _check_meet(self, way: Sequence[Expr], along: Vector) -> None:
        """Require that the two places coincide, or are apart only along the normal, like the centres of two balls."""
        across = [way[i] * along[j] - way[j] * along[i] for i in range(len(way)) for j in range(i)] if along else way
        if not all(is_zero(c) for c in across):
            message = "the two places of this collision do not meet"
            raise Rejected(Complaint("wrong-argument", message, help="give the coordinates at the impact under `at`"))

    def _kept(self, c: Constraint) -> Meeting:
        if not is_zero(self.earlier(c.velocity(self.moving))):
            message = "the rates before this impact do not satisfy a constraint of the system"
            raise Rejected(Complaint("wrong-argument", message))
        kind = "angular momentum" if c.kind_of_force == "torque" else "momentum"
        letter = unknown(f"J_{c.force.name}", kind)
        return Meeting(c.by_length, ZERO, letter, "kept", c.in_rates)

    def shares(self, q: Symbol) -> list[Expr]:
        """Return the terms of the sum of J . dr/dq over all impulses, given and unknown."""
        pairs = [(j, c) for one in self.impulses for j, c in zip(one.components, one.at, strict=True) if j != 0]
        acting = [(j, c) for j, c in pairs if not is_zero(self.there(diff(c, q)))]
        found = [Factors(j, self.shown_there(Partial(c, q), diff(c, q))) for j, c in acting]
        for each in self.meetings:
            if not is_zero(self.there(each.slope(q))):
                slope = each.along(q)
                found.append(Factors(each.letter, self.shown_there(slope, explicit(slope))))
        return found

    def power(self) -> Expr:
        """Return the sum of J . v by a second route, from places as functions of time and the state that the author
        gave."""
        found = ZERO
        for one in self.impulses:
            for j, c in zip(one.given, one.at, strict=True):
                found += self.read_again(j * by_functions_of_time(c, self.moving))
        for each in self.meetings:
            found += each.letter * self.read_again(each.speed_by_time(self.moving))
        return found
