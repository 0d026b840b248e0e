"""Arrows for given velocities and for the impulses of an impact, and the launch angle of a thrown particle."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

from sympy import Add, Basic, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sqrt
from sympy.matrices import MatrixBase

from derive.algebra.expressions import explicit
from derive.algebra.tidy import tidied
from derive.figures.annotations import Arrow, Axis, LengthMark, PointMark
from derive.figures.annotations import Line as LineMark
from derive.figures.ghosts import Ghost, HollowParticle
from derive.figures.links import is_fixed, moving_in, same
from derive.figures.marks import Mark
from derive.figures.parts import BarMark, ConnectionMark, WheelMark
from derive.figures.placed_bodies import placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.space import numeric
from derive.figures.surroundings import AngleBetween, DistanceMark
from derive.mechanics.bodies.placed import PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.contacts import Contact
from derive.mechanics.model.strings import Line, circles_of
from derive.mechanics.model.surfaces import Circle, Plane
from derive.mechanics.model.system import System
from derive.steps.step import is_zero

ZERO, ONE = Integer(0), Integer(1)
AXIS = Rational(3, 5)  # length of the axes of a flight, relative to the radius of the circle on which it begins
# Lengths of arrows, relative to the size of the drawing: of a velocity, and of the velocity of a thrown particle.
LONG, THROWN = Rational(2, 5), Rational(4, 5)
TURNED = (2 * pi / 15, pi / 4)  # angles of the dashed rods in the drawing of an impact
SHIFTED = Rational(1, 4)  # displacement of the dashed bodies, relative to the length of a rod
TURNED_ROUND = 2 * pi / 9  # angle of a dashed round body
ROLLED = 3  # displacement of the dashed bodies, relative to the radius of a round body
ON_IT = Rational(3, 4)  # distance of a point of impact from the fixed point, relative to the length of the body

FOR_LABEL = 6.0  # further room between a rod and a dimension line, for the label of the rod, in points

Values = Mapping[Symbol, Expr]


@dataclass(frozen=True)
class Moment:
    """The state at one instant, such as the start of a motion, or the state before an impact.

    at        the values of coordinates
    rates     the rates of coordinates
    pushes    pairs: the components of a given impulse, and the point of application of this impulse
    meeting   the points of impact on bodies
    flight    the Cartesian coordinates of a flight that follows; their axes start at the origin
    """

    at: Values = field(default_factory=dict)
    rates: Values = field(default_factory=dict)
    pushes: Sequence[tuple[Location, Location]] = ()
    meeting: Sequence[Location] = ()
    flight: Sequence[Symbol] = ()


def launch_marks(system: System, moment: Moment) -> Iterable[Mark]:
    """Yield the initial velocities of particles and guided bodies in a plane, launch angles that are symbols, and the
    axes of a flight."""
    for particle in system.particles:
        components = particle.at.components
        if len(components) != 2 or not all(c in moment.at and c in moment.rates for c in components):
            yield from _guided(system, moment, particle)
            continue
        start = Location(tuple(moment.at[c] for c in components))
        velocity = Location(tuple(moment.rates[c] for c in components))
        if not any(velocity.components) or not is_fixed(system, start):
            continue
        yield _arrow(start, velocity, THROWN)
        along, size = velocity.components[0], _size(velocity)
        angle = next((f.args[0] for f in along.atoms(cos) if is_zero(along - size * f)), None)
        if angle is not None and angle.is_Symbol:
            way = column_of(start) * 0 + ImmutableDenseMatrix([velocity.components[0] / size, ZERO])
            has_axis = not any(start.components)  # an axis already starts at the origin
            yield AngleBetween(column_of(start), way, column_of(velocity) / size, not has_axis, label=angle)
    for placed in system.bodies:
        yield from _guided(system, moment, placed)
    yield from _axes_of_flight(system, moment)


def _axes_of_flight(system: System, moment: Moment) -> Iterable[Mark]:
    """Yield the axes of a flight that begins on a circle about the origin, or on a string or a rod from the origin."""
    circles = [circle for particle in system.particles for circle in circles_of(system, particle.at)]
    circles += [e.surface for e in system.parts if isinstance(e, Contact) and isinstance(e.surface, Circle)]
    origin = Location((ZERO, ZERO))
    circle = next((each for each in circles if each.centre.components == origin.components), None)
    if circle is None:
        return
    for k, letter in enumerate(moment.flight):
        far = AXIS * circle.radius
        end = Location(tuple(far if i == k else ZERO for i in range(2)))
        yield Axis(column_of(origin), column_of(end), label=letter)


def _guided(system: System, moment: Moment, of: Any) -> Iterable[Mark]:
    """Yield the initial velocity of a particle or a round body that a string, a rod or a surface guides. A dashed or
    hollow outline shows the initial position, because the rest of the drawing shows a later state."""
    at = getattr(of, "centre", None) or of.at
    guiding = [each for each in system.parts if isinstance(each, Line | Contact) and each.on(of)]
    if len(at.components) != 2 or not guiding or _slides_straight(of, guiding):
        return
    state = {**_held(system), **moment.at}
    start = at.with_values(state)
    velocity = Location(tuple(tidied(Add(*_shares(c, moment)).subs(state)) for c in at.components))
    if not any(velocity.components) or not is_fixed(system, start + velocity) or not _size(velocity).is_Symbol:
        return
    if hasattr(of, "centre"):
        outline = placed_outline(with_its_shape(of.moved(state)))
        (q, value), *_ = moment.at.items()
        yield from (
            Ghost(of=replace(mark, label=None), letter=q, value=value)
            for mark in outline
            if isinstance(mark, WheelMark)
        )
    else:
        yield HollowParticle(column_of(start))
    yield _arrow(start, velocity, LONG)


def _slides_straight(of: Any, guiding: Sequence[Any]) -> bool:
    return not hasattr(of, "centre") and any(isinstance(getattr(e, "surface", None), Plane) for e in guiding)


def _held(system: System) -> dict[Symbol, Expr]:
    """Return the values of the coordinates that constraints keep constant."""
    found = {}
    for each in system.constraints:
        if not each.in_rates and len(each.coordinates) == 1:
            (q,) = each.coordinates
            share = tidied(diff(explicit(each.residual), q))
            if share != 0 and not moving_in(system, share):
                found[q] = tidied(q - explicit(each.residual) / share)
    return found


def impact_marks(system: System, moment: Moment) -> Iterable[Mark]:
    """Yield the velocities just before an impact, the given impulses with the heights at which they act, and the points
    of impact with their distances from fixed points."""
    places = [particle.at for particle in system.particles] + [placed.centre for placed in system.bodies]
    for place in places:
        velocity = Location(tuple(tidied(Add(*_shares(c, moment))) for c in place.components))
        if any(velocity.components) and is_fixed(system, velocity):
            yield _arrow(place, velocity, LONG)
    yield from _common_line(system)
    for push, at in moment.pushes:
        if any(push.components) and is_fixed(system, push):
            yield Arrow(column_of(at), column_of(push), 2 * LONG, False, True, label=_size(push))
            yield from _height(system, moment, at)
            yield from _from_the_joint(system, places, at, True)
    for at in moment.meeting:
        yield from _from_the_joint(system, places, at)


def _common_line(system: System) -> Iterable[Mark]:
    """Yield the axis of two particles that move along one line, if their coordinates have a name in common: x for x_1
    and x_2."""
    names = {q.name.partition("_")[0] for q in system.coordinates}
    places = [particle.at for particle in system.particles]
    if system.bodies or len(places) != 2 or len(names) != 1:
        return
    one, other = places
    if all(is_fixed(system, Location(place.components[1:])) for place in places):
        way = column_of(other - one)
        yield Axis(column_of(one) - way / 8, column_of(other) + way / 3, label=Symbol(*names))


def _shares(component: Expr, moment: Moment) -> list[Expr]:
    return [diff(component, q) * rate for q, rate in moment.rates.items()]


def _arrow(at: Location, velocity: Location, long: Expr) -> Mark:
    return Arrow(column_of(at), column_of(velocity), long, False, label=_size(velocity))


def _size(vector: Location) -> Expr:
    components = [c for c in vector.components if c != 0]
    if len(components) == 1:
        (only,) = components
        return -only if only.could_extract_minus_sign() else only
    return sqrt(tidied(Add(*(c**2 for c in components))))


def _height(system: System, moment: Moment, at: Location) -> Iterable[Mark]:
    """Yield the height of the point of impact above the origin, if the height has a symbol."""
    if len(at.components) != 2 or len(system.bodies) != 1:
        return
    there = Location(tuple(tidied(c.xreplace(dict(moment.at))) for c in at.components))
    y = there.components[1]
    if y.is_Symbol and not moving_in(system, y):
        middle = system.bodies[0].centre.components[0].xreplace(dict(moment.at))
        low, there = Location((middle, ZERO)), Location((middle, y))
        clear = getattr(system.bodies[0].body, "radius", ZERO)
        yield LengthMark(column_of(low), column_of(there), ImmutableDenseMatrix([ONE, ZERO]), clear, label=y)


def _from_the_joint(system: System, places: Sequence[Location], at: Location, hinged: bool = False) -> Iterable[Mark]:
    """Yield the point of impact and its distance from the fixed point of a body; with `hinged`, also from a hinge."""
    if any(same(at, place) for place in places):
        return
    for placed, far in _met(system, at, hinged):
        way = at - placed.at
        yield PointMark(column_of(at))
        if len(way.components) == 2 and far != getattr(placed.body, "length", None):
            side = 1 if hinged else -1  # dashed rods of `later_marks` are on the other side
            aside = side * ImmutableDenseMatrix([-way.components[1], way.components[0]])
            yield LengthMark(column_of(placed.at), column_of(at), aside, beyond=0.0 if hinged else FOR_LABEL, label=far)


def _met(system: System, at: Location, hinged: bool = False) -> Iterable[tuple[Any, Symbol]]:
    """Yield each body with a fixed point, and the symbol of the distance from this point to the point of impact. With
    `hinged`, the fixed point may instead be a hinge on another body.
    """
    for placed in system.bodies:
        far = sqrt(tidied(Add(*(c**2 for c in (at - placed.at).components))))
        is_joint = is_fixed(system, placed.at) or hinged and isinstance(placed.at, PointOfBody)
        if is_joint and far.is_Symbol and not moving_in(system, far):
            yield placed, far


def later_marks(system: System, moment: Moment, marks: Iterable[Mark]) -> Iterable[Mark]:
    """Yield the rods and round bodies of a plane system, dashed, in a later state, with the marks of the coordinates
    that have changed. Coordinates that are zero and at rest before the impact are positive in this state.

    marks   the marks of the system, which contain the coordinates as symbols
    """
    outlines = {mark for placed in system.bodies for mark in placed_outline(with_its_shape(placed))}
    zero = [q for q in system.coordinates if moment.at.get(q) == 0 and moment.rates.get(q, ZERO) == 0]
    solids = [mark for mark in outlines if isinstance(mark, BarMark | WheelMark)]
    acts = moment.meeting or any(any(push.components) for push, _ in moment.pushes)
    if not acts or not solids or len(system.places[0].components) != 2:
        return
    angles = [q for q in zero if system.coordinates[q] == "angle"]
    radius = next((mark.radius for mark in solids if isinstance(mark, WheelMark)), None)
    length = next((placed.body.length for placed in system.bodies if getattr(placed.body, "length", None)), ONE)
    shift = SHIFTED * length if radius is None else ROLLED * radius
    later: dict[Symbol, Expr] = {q: shift for q in zero if q not in angles}
    turns = TURNED if radius is None else (TURNED_ROUND,)
    later |= {q: turns[min(n, len(turns) - 1)] for n, q in enumerate(angles)}
    for mark in marks:
        if mark in solids and (there := _at(mark, later)) != mark:
            if isinstance(there, BarMark):
                yield ConnectionMark(there.start, there.end)
            elif isinstance(there, WheelMark):
                yield Ghost(of=replace(there, label=None, pointer=None))
        elif mark.label in later and isinstance(mark, AngleBetween | DistanceMark | LengthMark):
            there = _at(mark, later)
            yield there
            if isinstance(there, AngleBetween) and radius is not None:  # a radius at the later angle
                turned = there.b / sqrt(tidied(Add(*(c**2 for c in there.b))))
                yield LineMark(there.vertex, there.vertex + radius * turned, "edge")


def _at(mark: Mark, values: Values) -> Mark:
    """Return the mark with values substituted in its positions and directions."""
    own = {f.name: getattr(mark, f.name) for f in fields(mark) if f.name != "label"}
    return replace(mark, **{k: v.xreplace(values) for k, v in own.items() if isinstance(v, MatrixBase | Basic)})


def is_of_the_moment(mark: Mark, moment: Moment) -> bool:
    """Return whether the drawing of an impact omits a mark, such as an angle that is zero at the impact."""
    if isinstance(mark, DistanceMark | LengthMark):
        return mark.label in moment.rates or moment.at.get(mark.label) == 0
    return isinstance(mark, AngleBetween) and moment.at.get(mark.label) == 0


def moment_drawn(system: System, moment: Moment) -> dict[Symbol, Expr]:
    """Return the values of coordinates and lengths for the drawing of an impact. If a coordinate is a length that
    changes, its value is from a time before the impact."""
    found = {q: moment.at.get(q, ZERO) for q in system.coordinates if q in moment.at}
    for placed, letter in (each for at in moment.meeting for each in _met(system, at)):
        length = getattr(placed.body, "length", None)
        if length is not None and length != letter:
            found[letter] = ON_IT * length
    fixed = [s for place in system.places for c in place.components for s in c.free_symbols - {*system.coordinates}]
    far = min(fixed, key=str, default=ONE)
    for q, rate in moment.rates.items():
        if system.coordinates.get(q) == "length" and rate != 0:
            found[q] = moment.at.get(q, ZERO) - (far if numeric(rate) > 0 else -far)
    return found
