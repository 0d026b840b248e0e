"""Force diagrams: one body alone, with all forces on it, each in its true direction in the drawn state."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sympy import Add, Expr, Float, ImmutableDenseMatrix, Integer, Mul, Rational, Symbol

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import explicit, rate
from derive.algebra.tidy import tidied
from derive.figures.annotations import Arrow, PointMark
from derive.figures.connections import Connections, connections_of
from derive.figures.marks import Drawing, Mark
from derive.figures.parts import BarMark, ParticleMark, WheelMark
from derive.figures.placed_bodies import placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.scenes import drawing
from derive.figures.space import numeric
from derive.figures.turning import downwards
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce
from derive.mechanics.model.system import System
from derive.steps.record import coordinates_in, current_run
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero

__all__ = ["force_diagram", "free_body_diagram"]

LONG = Rational(3, 4)  # the drawn length of a force, relative to the size of the body
ON_PARTICLE = Rational(3, 5)
OFF = Rational(1, 30)  # the distance of a force along a rod from the rod, relative to the length of the rod


def force_diagram(key: str, system: System, of: Any, found: Mapping[Symbol, Quantity]) -> Drawing | None:
    """Return a drawing of one body or particle with the forces on it: its weight, and the forces of contacts, strings,
    rods and joints.

    key     the name of the drawing
    of      the body or particle, as a part of the system
    found   symbol of a constraint force -> the step that derives the force; the sign of its value in the drawn state,
    at rest, determines the direction of the arrow. The lengths are to scale, unless a force depends on the speed
    The result is None for a system in space. It is also None if no such force acts on the body, if a force is not among
    `found`, if other forces act that the diagram would not show, or if the direction of a force is unknown.
    """
    if len(system.places[0].components) != 2:
        return None
    acting = [force for each in connections_of(system, Connection) for force in each.on(of)]
    if not acting or any(letter not in found for force in acting for letter in _multipliers(system, force)):
        return None
    if _has_others(system) or not _moves_by(system, of, acting, found):
        return None
    scene = Connections(system)
    if not scene.is_possible:
        return None
    forces = _forces(system, acting, found, {q: scene.values[q] for q in system.coordinates if q in scene.values})
    if forces is None:
        return None
    drawn = [*_weight(system, of), *forces]
    letters = {letter for force in acting for letter in _multipliers(system, force)}
    if any(explicit(found[letter].value).has(*map(rate, system.coordinates)) for letter in letters):
        sizes = [1.0] * len(drawn)  # the speed in the drawn state is unknown, and so are the sizes of the forces
    else:
        sizes = _numbers([each.value for each in drawn], scene.values)
    long = LONG if isinstance(of, PlacedBody) else ON_PARTICLE
    arrows = [each.arrow(long * _share(size, max(sizes))) for each, size in zip(drawn, sizes, strict=True)]
    return drawing(key, [*_outline(of), *arrows], values=scene.values)


def free_body_diagram(key: str, system: System, of: Any, leads_to: Sequence[str]) -> Drawing | None:
    """Return a drawing of one body or particle with the forces on it before they are known: each letter is drawn in the
    direction in which it is positive, and the lengths of the arrows have no meaning.

    key       the name of the drawing
    of        the body or particle, as a part of the system
    leads_to  the keys of the laws of this body, before which the drawing is placed
    The result is None in the cases in which `force_diagram` returns None, except for the sizes of the forces.
    """
    acting = [force for each in connections_of(system, Connection) for force in each.on(of)]
    if not acting or _has_others(system) or not _moves_by(system, of, acting, {}):
        return None
    scene = Connections(system)
    if not scene.is_possible:
        return None
    letters = {each.force for each in system.constraints}
    drawn = list(_weight(system, of))
    for force, times in Counter(acting).items():  # a string pulls a pulley twice
        size, direction = force.size, Location(force.direction)
        if size == 1:  # for friction of size 1 the direction contains the true size
            size, direction = _size_and_direction(direction, list(letters))
        way = ImmutableDenseMatrix(list(direction.components))
        at = _beside(force) if isinstance(force.of, PlacedBody) else force.of.at
        pushes = isinstance(force.of, PlacedBody) and size in _of_surfaces(system)
        drawn.append(_Drawn(at, way, size, times * size, (), pushes))
    long = LONG if isinstance(of, PlacedBody) else ON_PARTICLE
    return drawing(key, [*_outline(of), *(each.arrow(long) for each in drawn)], values=scene.values, leads_to=leads_to)


def _of_surfaces(system: System) -> set[Symbol]:
    return {each.force for each in system.constraints if each.enforcer == "surface"}


@dataclass(frozen=True)
class _Drawn:
    """A force in a diagram. `value` is its value in the drawn state, in newtons; if `pushes` is true, the tip of its
    arrow is at the body."""

    at: Location
    way: Any
    value: Expr
    label: Expr
    keys: tuple[str, ...] = ()
    pushes: bool = False

    def arrow(self, size: Rational) -> Arrow:
        return Arrow(column_of(self.at), self.way, size, False, self.pushes, label=self.label, keys=self.keys)


def _numbers(values: Sequence[Expr], at: Mapping[Symbol, Any]) -> list[float]:
    """Return the magnitudes of the forces; a symbol has the same number in all forces."""
    there = [value.subs(at).subs(at) for value in values]
    letters = sorted(set().union(*(value.free_symbols for value in there)), key=str)
    run = current_run.get()
    given = run.numbers if run is not None else {}
    numbers = {letter: given.get(letter, Float(0.6 + 0.07 * i)) for i, letter in enumerate(letters)}
    return [abs(float(value.xreplace(numbers).evalf())) for value in there]


def _share(size: float, greatest: float) -> Rational:
    """Return the length of an arrow relative to the longest arrow: at least 1/5, so that small forces stay visible."""
    return Rational(max(round(60 * size / greatest), 12), 60)


def _has_others(system: System) -> bool:
    """Whether forces other than weights and the forces of connections act in the system."""
    frictions = [force for each in connections_of(system, Connection) for force in each.forces if force.size == 1]
    given = len(system.given_forces) > len(frictions)
    couples = any(not each.forces for each in system.constraints)  # constraints by a motor, a rigid joint or a formula
    unnamed = bool(system.conditions)  # rolling conditions, whose friction has no symbol
    return bool(couples or unnamed or given or system.between or system.dampers or system.charges or system.stored)


def _moves_by(system: System, of: Any, acting: Sequence[PointForce], found: Mapping[Symbol, Quantity]) -> bool:
    """Whether the forces account for the motion of the centre of mass. The centre must move independently in the
    directions in which coordinates move it, and the forces must balance in all other directions. Otherwise an unknown
    reaction also acts, such as the reaction of the ice on a plank."""
    centre, mass = (of.centre, of.body.mass) if isinstance(of, PlacedBody) else (of.at, of.mass)
    moving = list(system.coordinates)
    free = [k for k, c in enumerate(centre.components) if coordinates_in(c)]
    rows = ImmutableDenseMatrix([[derivative(centre.components[k], q) for q in moving] for k in free])
    if free and rows.rank(simplify=True) < len(free):
        return False
    values = {letter: explicit(step.value) for letter, step in found.items()}
    for k in set(range(len(centre.components))) - set(free):
        down = explicit(mass) * system.gravity if k == len(centre.components) - 1 else Integer(0)
        if not is_zero(Add(*(f.size * f.direction[k] for f in acting)).xreplace(values) - down):
            return False
    return True


def _multipliers(system: System, force: PointForce) -> list[Symbol]:
    """The symbols of constraint forces in a force."""
    letters = force.size.free_symbols | {s for c in force.direction for s in c.free_symbols}
    return [each.force for each in system.constraints if each.force in letters]


def _outline(of: Any) -> Iterator[Mark]:
    if isinstance(of, PlacedBody):
        for mark in placed_outline(with_its_shape(of)):
            plain = replace(mark, label=None)
            yield replace(plain, pointer=None) if isinstance(plain, WheelMark) else plain
        yield PointMark(column_of(of.centre))
    else:
        yield ParticleMark(column_of(of.at), label=of.mass)


def _weight(system: System, of: Any) -> Iterator[_Drawn]:
    if system.weights:
        centre, mass = (of.centre, of.body.mass) if isinstance(of, PlacedBody) else (of.at, of.mass)
        weight = explicit(mass) * system.gravity
        yield _Drawn(centre, downwards(2), weight, weight)


def _forces(
    system: System, acting: Sequence[PointForce], found: Mapping[Symbol, Quantity], values: Mapping[Symbol, Any]
) -> list[_Drawn] | None:
    """Return the forces, each reversed if it is negative in the drawn state; a zero force is not drawn.

    The result is None if the direction of a force is unknown, for example if it depends on the sign of a difference of
    masses.
    """
    drawn = []
    still = {rate(q): Integer(0) for q in system.coordinates}
    surfaces = _of_surfaces(system)
    for force, times in Counter(acting).items():  # a string pulls a pulley twice
        letters = _multipliers(system, force)
        size, direction = force.size, Location(force.direction)
        if size == 1:  # for friction of size 1 the direction contains the true size
            size, direction = _size_and_direction(direction, letters)
        value = times * size.xreplace({letter: explicit(found[letter].value) for letter in letters}).subs(still)
        if is_zero(value):
            continue
        sign = sign_known(tidied(value.subs(values).subs(values)))
        if sign not in (1, -1):
            return None
        keys = tuple(found[letter].key for letter in letters)
        way = ImmutableDenseMatrix([sign * c for c in direction.components])
        is_body = isinstance(force.of, PlacedBody)
        pushes = is_body and sign == 1 and size in surfaces
        at = _beside(force) if is_body else force.of.at
        drawn.append(_Drawn(at, way, value, sign * times * size, keys, pushes))
    return drawn


def _beside(force: PointForce) -> Location:
    """Return the place at which a force on a body is drawn: a little below a rod, if the force is along the rod."""
    for bar in (mark for mark in placed_outline(with_its_shape(force.of)) if isinstance(mark, BarMark)):
        x, y = (tidied(c) for c in bar.end - bar.start)
        u, v = force.direction
        if is_zero(tidied(x * v - y * u)):
            off = Location((y, -x)) if numeric(x) > 0 else Location((-y, x))
            place: Location = force.at + OFF * off
            return place
    return force.at


def _size_and_direction(force: Location, letters: list[Symbol]) -> tuple[Expr, Location]:
    """Split a force such as (-mu N, 0) into mu N and the direction (-1, 0)."""
    for c in force.components:
        factors = [f for f in Mul.make_args(c) if f.free_symbols & set(letters)]
        if factors:
            size = Mul(*(f for f in Mul.make_args(c) if f.is_Symbol))
            return size, Location(tuple(each / size for each in force.components))
    return Integer(1), force
