"""Surfaces that bodies touch: planes, circles or spheres, and curves y = f(x); fixed, moving, or carried by a body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self, TypeAlias

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Pow, Symbol, cos, diff, factor, sin, sqrt, tan
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import (
    TIME,
    Prescribed,
    Relation,
    TimeRate,
    as_expr,
    depends_on_time,
    explicit,
    prescribed_in,
)
from derive.algebra.ranges import range_of
from derive.algebra.relation import sides_without_minus
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.model.part import moved
from derive.steps.record import assume, coordinates_in
from derive.steps.signs import DECIDES, sign_for_all
from derive.steps.step import is_zero

__all__ = ["circle", "curve", "plane"]

ZERO, ONE = Integer(0), Integer(1)
Vector: TypeAlias = tuple[Expr, ...]
Ground: TypeAlias = Location | Axes | PlacedBody


@dataclass(frozen=True)
class Surface(ABC):
    """A surface; the bodies that touch it are on its free side.

    of      the body or particle that carries the surface; None if no part of the system carries it
    moves   if `of` is None, the motion of the material along the surface. A turntable has axes in which the material is
            at rest; a belt has a place that moves with the material. None without such a motion
    is_two_sided   whether the surface can push bodies to both sides, like a rail; the normal force may have either sign
    """

    of: Any
    moves: Location | Axes | None
    is_two_sided: bool = field(default=False, kw_only=True)

    @abstractmethod
    def distance(self, at: Location) -> Expr:
        """The distance of a place from the surface, or the height above a curve, m; positive on the free side."""

    def gradient(self, at: Location) -> Expr:
        """The length of the gradient of `distance` on the surface."""
        return ONE

    @abstractmethod
    def normal(self, at: Location) -> Location:
        """The unit vector that is normal to the surface at a place and points towards the free side."""

    @abstractmethod
    def height(self, at: Location, normal: Location) -> Expr:
        """The distance of a place from the surface along a known normal, m."""

    @abstractmethod
    def foot(self, at: Location, normal: Location) -> Location:
        """The point of the surface that touches a body at a place; for a plane or a curve, this place itself."""

    @property
    @abstractmethod
    def place(self) -> Location:
        """A place that moves with the surface, if the surface does not rotate."""

    @property
    def ground(self) -> Ground | None:
        """The body, place or axes with which the material of the surface moves; None if the material is at rest."""
        if self.of is not None:
            return self.of if isinstance(self.of, PlacedBody) else self.of.at
        if isinstance(self.moves, Axes):
            return self.moves
        if not any(depends_on_time(c) for c in self.place.components):
            return self.moves
        return self.place if self.moves is None else self.place + self.moves

    @property
    def corners(self) -> tuple[Location, ...]:
        """Two opposite corners of a box around a bounded surface; empty if the surface is unbounded."""
        return ()

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(self, of=moved(self.of, known))


@dataclass(frozen=True)
class Plane(Surface):
    """A plane through a place, with a unit normal; in a plane of motion, a straight line."""

    through: Location
    unit_normal: Location

    def distance(self, at: Location) -> Expr:
        return tidied(dot(self.unit_normal, at - self.through))

    def normal(self, at: Location) -> Location:
        return self.unit_normal

    def height(self, at: Location, normal: Location) -> Expr:
        return dot(normal, at - self.through)

    def foot(self, at: Location, normal: Location) -> Location:
        return at

    @property
    def place(self) -> Location:
        return self.through

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        through, normal = self.through.with_values(known), self.unit_normal.with_values(known)
        return replace(super().moved(known), through=through, unit_normal=normal)


@dataclass(frozen=True)
class Circle(Surface):
    """A circle in a plane of motion, or a sphere in space; the free side is outside or inside."""

    centre: Location
    radius: Expr
    inside: bool = False

    def distance(self, at: Location) -> Expr:
        beyond = distance_between(self.centre, at) - self.radius
        return -beyond if self.inside else beyond

    def normal(self, at: Location) -> Location:
        return direction_between(*((at, self.centre) if self.inside else (self.centre, at)))

    def height(self, at: Location, normal: Location) -> Expr:
        return dot(normal, at - self.centre) + (self.radius if self.inside else -self.radius)

    def foot(self, at: Location, normal: Location) -> Location:
        out = -self.radius if self.inside else self.radius
        return self.centre + Location(tuple(out * c for c in normal.components))

    @property
    def place(self) -> Location:
        return self.centre

    @property
    def corners(self) -> tuple[Location, ...]:
        size = Location((self.radius,) * len(self.centre.components))
        return self.centre - size, self.centre + size

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), centre=self.centre.with_values(known), radius=self.radius.subs(known))


@dataclass(frozen=True)
class Curve(Surface):
    """A curve y = f(x) in a plane of motion; x and y are measured from a place. The free side is above or below.

    through   the place where x = 0 and y = 0
    letter    the symbol of x
    formula   the formula f(x) of the height y
    """

    through: Location
    letter: Symbol
    formula: Expr
    below: bool = False

    def _at(self, value: Expr, at: Location) -> Expr:
        return tidied(value.xreplace({self.letter: (at - self.through).components[0]}))

    def distance(self, at: Location) -> Expr:
        above = (at - self.through).components[1] - self._at(self.formula, at)
        return -above if self.below else above

    def gradient(self, at: Location) -> Expr:
        return tidied(sqrt(tidied(1 + self._slope(at) ** 2)))

    def _slope(self, at: Location) -> Expr:
        return self._at(diff(self.formula, self.letter), at).replace(tan, lambda angle: sin(angle) / cos(angle))

    def normal(self, at: Location) -> Location:
        slope, length = self._slope(at), self.gradient(at)
        above = Location((tidied(-slope / length), tidied(1 / length)))
        return -above if self.below else above

    def height(self, at: Location, normal: Location) -> Expr:
        """The distance of a place from the tangent to the curve at the point with the same x."""
        return dot(normal, at - self.point((at - self.through).components[0]))

    def point(self, x: Expr) -> Location:
        """The place of the curve at the horizontal distance x from `through`."""
        return self.through + Location((x, self.formula.xreplace({self.letter: x})))

    def foot(self, at: Location, normal: Location) -> Location:
        return at

    @property
    def place(self) -> Location:
        return self.through

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), through=self.through.with_values(known))


def plane(
    through: Location,
    normal: Any = None,
    along: Any = None,
    of: Any = None,
    moves: Location | Axes | None = None,
    is_two_sided: bool = False,
) -> Plane:
    """A plane surface through a place.

    normal   a vector perpendicular to the plane, towards the free side; its length has no effect
    along    in a plane of motion, instead of `normal`: a vector along the surface. The free side is on the left of this
             vector; for a vector to the right, the free side is above
    of       the body or particle that carries the surface
    moves    the axes in which the surface is at rest, or a place that moves with the material at a constant velocity
             along the surface
    is_two_sided   whether the surface can push bodies to both sides, like a rail; the normal force may have either sign
    """
    if (normal is None) == (along is None):
        raise Rejected(Complaint("wrong-argument", "`plane` needs either `normal` or `along`"))
    across = vector("plane", normal, through) if along is None else _left_of(vector("plane", along, through))
    found = Plane(of, moves, through, unit("plane", across), is_two_sided=is_two_sided)
    _check_motion(found)
    return found


def _check_motion(surface: Plane) -> None:
    if surface.of is not None and surface.moves is not None:
        message = "the body that carries the surface already determines the motion of the surface"
        raise Rejected(Complaint("twice", message, help="leave out `of` or the motion"))
    if isinstance(surface.moves, Axes) and len(surface.through.components) == 2:
        message = "a surface can rotate with axes only in space, but this system moves in a plane"
        raise Rejected(Complaint("wrong-argument", message, help="let a body carry the surface, `of: body`"))
    if isinstance(surface.moves, Location):
        velocity = Location(tuple(diff(c, TIME) for c in surface.moves.components))
        if any(depends_on_time(c) or coordinates_in(column_of(velocity)) for c in velocity.components):
            message = "the velocity of a surface must be constant"
            help_line = "give a place on the surface as a function of time, `through: [A*t**2/2, 0]`"
            raise Rejected(Complaint("changes", message, help=help_line))
        if not is_zero(tidied(dot(velocity, surface.unit_normal))):
            message = "the velocity of a surface must be along the surface"
            help_line = "give a place on the surface as a function of time, `through: [0, v*t]`"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))


def circle(
    centre: Location,
    radius: Any,
    inside: bool = False,
    of: Any = None,
    moves: Any = None,
    is_two_sided: bool = False,
) -> Circle:
    """A circular surface in a plane of motion, or a spherical surface in space.

    inside   whether the free side is inside, as in a bowl; by default it is outside
    of       as for `plane`; by default the material moves with the centre
    moves    the axes in which the sphere is at rest, for a sphere that rotates
    is_two_sided   whether the surface can push bodies to both sides, like a hoop; the normal force may have either sign
    """
    if isinstance(moves, Location):
        message = "a circle has no `velocity`: its material moves with its centre, or with the body that carries it"
        raise Rejected(Complaint("wrong-argument", message, help="give `centre` as a function of time, or `of`"))
    if isinstance(moves, Axes) and len(centre.components) == 2:
        message = "a surface can rotate with axes only in space, but this system moves in a plane"
        raise Rejected(Complaint("wrong-argument", message, help="let a body carry the surface, `of: body`"))
    return Circle(of, moves, centre, as_expr(radius), inside, is_two_sided=is_two_sided)


def curve(
    x: Any,
    height: Any,
    through: Location | None = None,
    below: bool = False,
    of: Any = None,
    moves: Any = None,
    is_two_sided: bool = False,
) -> Curve:
    """A curve y = f(x) in a plane of motion, as a surface.

    x        the symbol for the horizontal distance from `through`, m
    height   f(x), the height above `through`, m
    through  the place from which x and y are measured; by default the centre of the body or particle that carries the
             curve, or the origin. The material of the curve moves with this place
    below    whether the free side is below the curve; by default it is above
    of       the body or particle that carries the curve; the curve moves with this object, without rotation
    is_two_sided   as for `plane`

    The normal force N on a particle acts along the unit normal (-f', 1)/sqrt(1 + f'^2), or along the opposite vector if
    the free side is below. The gradient of y - f(x) has the length sqrt(1 + f'^2), so the multiplier of the condition
    that keeps the particle on the curve is N/sqrt(1 + f'^2).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    origin = of.centre if isinstance(of, PlacedBody) else Location((ZERO, ZERO)) if of is None else of.at
    through = origin if through is None else through
    letter, formula = as_expr(x), explicit(as_expr(height))
    if not isinstance(letter, Symbol):
        raise Rejected(Complaint("wrong-argument", f"`curve` needs a symbol for x, not {letter}"))
    if len(through.components) != 2 or moves is not None:
        message = "a curve is allowed only for motion in a plane; it moves only with its place `through` or its body"
        help_line = "in a plane, give `through` as a function of time, or `of`; in space, use a plane or a sphere"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    moving = [s.name for s in {**coordinates_in(formula), TIME: ""} if s != letter and formula.has(s)]
    if moving:
        message = f"the formula of a curve contains {moving[0]}, but a curve has a constant shape"
        raise Rejected(Complaint("changes", message, help=f"the formula may contain {letter} and constants"))
    apart = coordinates_in(column_of(through - origin)) if of is not None else {}
    if apart:
        message = (
            "the curve does not move with the body that carries it: "
            f"their relative position changes with {next(iter(apart))}"
        )
        raise Rejected(Complaint("which-body", message, help="give a place that moves with the body, `through: track`"))
    if isinstance(of, PlacedBody) and not is_zero(_turning(of)):
        message = f"a curve must not rotate, but the body that carries it, {of.body.name}, rotates"
        raise Rejected(Complaint("wrong-argument", message, help="let a particle carry the curve"))
    return Curve(of, None, through, letter, formula, below, is_two_sided=is_two_sided)


def _turning(body: PlacedBody) -> Expr:
    """The angular velocity of a body in a plane."""
    angle = as_expr(body.turned)
    return explicit(TimeRate(angle, *coordinates_in(angle)))


def column_of(place: Location) -> ImmutableMatrix:
    return ImmutableDenseMatrix(place.components)


def dot(u: Location, v: Location) -> Expr:
    return Add(*(a * b for a, b in zip(u.components, v.components, strict=True)))


def vector(verb: str, given: Any, like: Location) -> Location:
    """Return a given vector as a `Location`; it must have as many components as the place `like`."""
    components = given.components if isinstance(given, Location) else tuple(given)
    if len(components) != len(like.components):
        message = f"`{verb}` needs a vector of {len(like.components)} components, as many as its place"
        raise Rejected(Complaint("wrong-argument", message))
    return Location(tuple(as_expr(c) for c in components))


def unit(verb: str, along: Location) -> Location:
    """Return the unit vector in a direction."""
    square = tidied(dot(along, along))
    if square == 0:
        raise Rejected(Complaint("wrong-argument", f"`{verb}` needs a direction, but all its components are zero"))
    return along if square == 1 else Location(tuple(tidied(c / sqrt(square)) for c in along.components))


def _left_of(along: Location) -> Location:
    if len(along.components) != 2:
        message = "`plane` accepts `along` only in a system that moves in a plane"
        raise Rejected(Complaint("wrong-argument", message, help="give its `normal`"))
    x, y = along.components
    return Location((-y, x))


def distance_between(start: Location, end: Location) -> Expr:
    """Return the distance between two places, m, without absolute values."""
    length = raw_distance(start, end)
    return length.replace(Abs, _positive) if length.has(Pow, Abs) else _positive(length)


def raw_distance(start: Location, end: Location) -> Expr:
    """Return the distance between two places, m.

    If the places differ in one component only, return this difference, which may be negative.
    """
    lengths = [tidied(c) for c in (end - start).components if c != 0]
    return lengths[0] if len(lengths) == 1 else sqrt(factor(tidied(Add(*(c**2 for c in lengths)))))


def direction_between(start: Location, end: Location) -> Location:
    """Return the unit vector from one place to another."""
    length = distance_between(start, end)
    return Location(tuple(tidied(c / length) for c in (end - start).components))


def _positive(length: Expr) -> Expr:
    """Return u or -u for a distance |u|: the expression that is positive for all values of its symbols.

    If the sign depends on the values, return the expression that is positive where all coordinates are zero, and assume
    that this expression stays positive. Reject an expression whose sign is unknown there.
    """
    moving = coordinates_in(ImmutableDenseMatrix([length]))
    at_zero = Add(*(term for term in Add.make_args(length.xreplace(dict.fromkeys(moving, Integer(0))).expand())
                    if not depends_on_time(term)))  # fmt: skip
    for sign in (1, -1):
        if sign_for_all(sign * length) == 1:
            return sign * length
        if (sign * at_zero).is_positive:
            assume(Relation(sign * length, ">", Integer(0)))
            return sign * length
    message = f"the distance |{length}| cannot be written without an absolute value: the sign of {length} is unknown"
    raise Rejected(Complaint("sign", message, help=help_to_sign(length, [*moving, *prescribed_in(length)])))


def help_to_sign(length: Expr, changing: Sequence[Symbol]) -> str:
    """Return the help for an unknown sign: a range, a declaration as positive, other sizes, or a relation to assume."""
    if not changing:
        more, less = sides_without_minus(length)
        return f"{DECIDES} {less} < {more}"
    name = changing[0]
    if range_of(name) is not None:
        return f"give `{name}` a narrower range, or choose sizes for which the sign of {length} never changes"
    what, noun = ("function", "function_of_time") if isinstance(name, Prescribed) else ("coordinate", "coordinate")
    if coordinates_in(ImmutableDenseMatrix([name])).get(name) == "angle":
        return Spelled("give the angle a range", f"give the angle a range, such as `{name}: angle in (0, pi)`")
    return Spelled(
        f'make the {what} positive: `{noun}("{name}", "length", positive=True)`',
        f"make the {what} positive: `{name}: positive length`",
    )
