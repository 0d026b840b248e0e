"""Diagrams of one body alone, with all forces on it.

A force diagram shows each force in its true direction in the drawn state. A free-body diagram shows each force in the
direction in which its symbol is positive.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import hypot
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Mul, Rational, Symbol, cos, sin, sqrt

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import as_expr, explicit, rate, scalar
from derive.algebra.ranges import fulfilling, rational_in_range
from derive.algebra.tidy import tidied
from derive.figures.annotations import FORCE, ForceArrow, LargePoint, PointMark, PositiveDirection, PositiveRotation
from derive.figures.connections import Connections, connections_of, distance_of
from derive.figures.links import Link, angle_of_link, is_fixed, same
from derive.figures.marks import Drawing, Mark
from derive.figures.parts import WHEEL, BarMark, HeavyRopeMark, ParticleMark, WheelMark
from derive.figures.placed_bodies import own_angle, placed_outline, with_its_shape
from derive.figures.positions import column_of
from derive.figures.scenes import drawing
from derive.figures.space import Vector, cross, dot, numeric, plus, size_of, unit
from derive.figures.surfaces import Revolved, ThinRod
from derive.figures.surroundings import AngleBetween, SurfacePiece
from derive.figures.tops import stance_values
from derive.figures.turning import downwards
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce
from derive.mechanics.model.contacts import Contact
from derive.mechanics.model.strings import Line, Pulley
from derive.mechanics.model.surfaces import Plane
from derive.mechanics.model.surfaces import dot as product_of
from derive.mechanics.model.system import Particle, System
from derive.steps.known_numbers import with_numbers
from derive.steps.record import coordinates_in, given_letters
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, is_zero
from derive.steps.trial_numbers import assumptions_about, trial_points

__all__ = ["BodyAlone", "draw_alone", "forces_as_named", "forces_in_state", "forces_on_pulley", "forces_on_rope"]

LONG = Rational(4, 5)  # approximate length of the arrow of the greatest force on a rod, relative to the size of the rod
# The drawn size of a body that is not a rod, in a plane and in space, in points.
BODY, BODY_IN_SPACE = 32.0, 20.0
LEAST = Rational(1, 4)  # least length of an arrow, relative to the longest arrow
# In a plane, all arrows are enlarged until the shortest arrow has the length VISIBLE, in units of FORCE points, but at
# most by the factor LONGER. An arrow of the length LEAST then has the length VISIBLE.
VISIBLE, LONGER = Rational(3, 8), Rational(3, 2)
ON_A_LINE = Rational(3, 5)  # least factor for all arrows if each drawing shows a particle with forces on one line
OFF = Rational(1, 30)  # distance between a rod and the arrow of a force along it, relative to the length of the rod
APART = 5.0  # the distance between the arrows of two forces on the same line, in points
ALONG = 3.6  # distance between a surface and the arrow of a force along it, on the side of the body, in points
# For a round body whose weight and normal force are on one line, STANDING is its drawn size in points. SHORT and
# SHORTEST are the greatest and the least length of its arrows, in units of FORCE points. With these lengths the weight
# ends above the contact, and the friction is visible.
STANDING, SHORT, SHORTEST = 47.0, Rational(12, 25), Rational(7, 20)
ROPE = 110.0  # the drawn length of a whole rope, in points; each piece of the rope is drawn alone
FOOT = 30.0  # half the length of the piece of a surface under a body, in points
SLIGHT = 1e-6  # a number below this counts as zero
NEAR = 0.3  # opposite arrows count as overlapping if their tips are closer than this fraction of an arrow's length
ANGLE = Rational(63, 100)  # the value of an angle that has no given value, in radians
NORMALS = ("N", "F_n", "n")  # possible symbols of a normal force that does not appear in the equations


@dataclass(frozen=True)
class BodyAlone:
    """A body, a particle, a pulley or a piece of a rope, with the forces that its diagram shows.

    key       the name of the drawing
    leads_to  the keys of the laws of this body; the drawing is placed before these laws
    """

    key: str
    of: Any
    forces: tuple[_Drawn, ...]
    leads_to: tuple[str, ...] = ()


def forces_in_state(key: str, system: System, of: Any, found: Mapping[Symbol, Quantity]) -> BodyAlone | None:
    """Return one body or particle with the forces on it in the drawn state: its weight, and the forces of contacts,
    strings, rods and joints.

    key     the name of the drawing
    of      the body or particle, as a part of the system
    found   symbol of a constraint force -> the step that derives the force

    The lengths of the arrows are to scale for the system at rest, but small forces are drawn larger. If the value of a
    force is negative, its arrow is reversed. The result is None for a system in space, for an incomplete diagram, and
    if a force or its sign is unknown.
    """
    acting = _acting(system, of)
    letters = {letter for force in acting for letter in _multipliers(system, force)}
    if not letters <= found.keys() or len(system.places[0].components) != 2:
        return None
    scene = Connections(system)
    if not acting or not _shows_all(system, of, acting, found) or not scene.is_possible:
        return None
    drawn = _forces(system, of, acting, found)
    signs = [1 if each.pushes else sign_known(_there(each.value, scene)) for each in drawn]
    if not {*signs} <= {1, -1, 0}:
        return None
    kept = [each.reversed() if sign == -1 else each for each, sign in zip(drawn, signs, strict=True) if sign != 0]
    return BodyAlone(key, of, (*_weight(system, of), *kept))


def forces_as_named(
    key: str, system: System, of: Any, leads_to: Sequence[str], found: Mapping[Symbol, Quantity]
) -> BodyAlone | None:
    """Return one body or particle with the forces on it, each in the direction in which its symbol is positive.

    leads_to  the keys of the laws of this body; the drawing is placed before these laws
    found     as for `forces_in_state`

    The lengths of the arrows have no meaning in space, or if `found` lacks a force.

    Return None if the diagram would be incomplete.
    """
    scene, acting = Connections(system), _acting(system, of)
    if not acting or not _shows_all(system, of, acting, {}) or not scene.is_possible:
        return None
    drawn = _forces(system, of, acting, found)
    shown = [replace(each, keys=(), value=each.value if scene.in_a_plane else None) for each in drawn]
    return BodyAlone(key, of, (*_weight(system, of), *shown), tuple(leads_to))


def forces_on_pulley(
    key: str, system: System, of: Pulley, leads_to: Sequence[str], found: Mapping[Symbol, Quantity]
) -> BodyAlone | None:
    """Return a massless pulley that hangs on a string, with the pulls of all its strings; None if there is no such
    diagram."""
    lines = [each for each in connections_of(system, Line) if any(same(of.at, at) for at in each.places)]
    if len(of.at.components) != 2 or is_fixed(system, of.at) or not lines or any(each.drawn is None for each in lines):
        return None
    pulls = _drawn_pulls(system, of)
    return BodyAlone(key, of, tuple(_pull(pull, found) for pull in pulls), tuple(leads_to))


def _drawn_pulls(system: System, of: Any) -> list[PointForce]:
    """Return the pulls of strings whose tension has a symbol only in force diagrams."""
    scene, found = Connections(system), []
    for line in connections_of(system, Line):
        for at, other in line.drawn_on(of):
            way = tuple(tidied(c) for c in (other - at).components)
            size = sqrt(tidied(Add(*(c**2 for c in way))))
            alone = [c for c in way if c != 0]
            if len(alone) == 1:  # along an axis
                size = alone[0] if scene.number(alone[0]) > 0 else -alone[0]
            found.append(PointForce(line.drawn, tuple(tidied(c / size) for c in way), at, of))
    return found


def forces_on_rope(
    key: str, system: System, line: Line, leads_to: Sequence[str], found: Mapping[Symbol, Quantity]
) -> list[BodyAlone]:
    """Return the straight pieces of a rope with mass, each with its weight, the normal force of a surface, and the
    tension at the bends of the rope. The names of the drawings are `key` with the number of the piece."""
    if line.drawn is None or line.rope is None or len(line.places[0].components) != 2:
        return []
    pieces = list(pairwise(line.places))
    whole = tidied(Add(*line.lengths))
    alone = []
    for i, ((start, end), length) in enumerate(zip(pieces, line.lengths, strict=True)):
        of = _RopePiece(start, end, tidied(line.rope.mass * length / whole), whole)
        along = Location(tuple(tidied(c / length) for c in (end - start).components))
        touching = [each for each in connections_of(system, Contact) if each.of == line.rope and each.is_kept]
        normals = [each.normal for each in touching if is_zero(tidied(product_of(each.normal, along)))]
        forces = [*_weight(system, of)]
        forces += [_normal_of(of, normal, system, forces) for normal in normals]
        for at, way, is_bend in ((start, -along, i > 0), (end, along, i < len(pieces) - 1)):
            forces += [_pull(PointForce(line.drawn, way.components, at, None), found)] if is_bend else []
        alone.append(BodyAlone(f"{key}_{i + 1}", of, tuple(forces), tuple(leads_to)))
    return alone


@dataclass(frozen=True)
class _RopePiece:
    """A straight piece of a rope with mass; `whole` is the length of the rope."""

    start: Location
    end: Location
    mass: Expr
    whole: Expr

    @property
    def at(self) -> Location:
        """The middle of the piece."""
        middle: Location = self.start + Rational(1, 2) * (self.end - self.start)
        return middle


def _normal_of(of: _RopePiece, normal: Location, system: System, others: Sequence[_Drawn]) -> _Drawn:
    way = ImmutableDenseMatrix(list(normal.components))
    plain = _Drawn(of.at, way, None, _letter_of_normal(system), pushes=True)
    return replace(plain, value=_balance(plain, others))


def _pull(pull: PointForce, found: Mapping[Symbol, Quantity]) -> _Drawn:
    steps = [found[letter] for letter in pull.size.free_symbols if letter in found]
    value = explicit(steps[0].value) if steps else None
    keys = tuple(step.key for step in steps)
    return _Drawn(pull.at, ImmutableDenseMatrix(list(pull.direction)), value, pull.size, keys)


def draw_alone(system: System, bodies: Sequence[BodyAlone]) -> list[Drawing]:
    """Return the diagrams of bodies of a system. If one set of trial numbers fits all diagrams with known forces, these
    diagrams have the same scale of forces, except that small forces are drawn larger."""
    scene = Connections(system)
    shares = [[_share(size) for size in own] for own in _sizes([each.forces for each in bodies], scene)]
    least = min((share for own in shares for share in own), default=1)
    at_least = ON_A_LINE if all(_is_on_a_line(each) for each in bodies) else Integer(1)
    longer = min(max(VISIBLE / least, at_least), LONGER) if scene.in_a_plane else Integer(1)
    least = Integer(0)
    if any(_stands(scene, each) for each in bodies):
        longer, least = SHORT, SHORTEST
    return [
        _diagram(system, each, [max(longer * share, least) for share in own], scene)
        for each, own in zip(bodies, shares, strict=True)
    ]


def _positive(system: System, alone: BodyAlone, scene: Connections) -> Iterator[Mark]:
    """Yield the positive direction of a coordinate, or the positive sense of an angle."""
    of = alone.of
    if _is_on_a_line(alone):
        moving = [q for q in system.coordinates if any(derivative(c, q) != 0 for c in of.at.components)]
        way = ImmutableDenseMatrix([derivative(c, q) for q in moving[:1] for c in of.at.components])
        if len(moving) == 1 and not coordinates_in(way) and is_zero(way.dot(way) - 1):
            yield PositiveDirection(column_of(of.at), way, label=moving[0])
    turned = of.turned if isinstance(of, PlacedBody) and of.is_plane else None
    angle = next((each for each in (turned, -turned) if each.is_Symbol), None) if isinstance(turned, Expr) else None
    for mark in _outline(of) if angle is not None else ():
        if isinstance(mark, WheelMark):
            is_occupied = any(_is_upper_left(each, of, scene) for each in alone.forces)
            yield PositiveRotation(mark.centre, mark.radius, bool(angle == turned), is_occupied, label=angle)


def _is_upper_left(drawn: _Drawn, of: Any, scene: Connections) -> bool:
    """Whether a force points upwards from the left side of a body, at the height of its centre or above."""
    x, y, _ = _vector(scene, *(drawn.at - of.centre).components)
    _, up, _ = _vector(scene, *drawn.way)
    return x < -SLIGHT and y > -SLIGHT and up > SLIGHT


def _is_on_a_line(alone: BodyAlone) -> bool:
    if not isinstance(alone.of, Particle) or any(len(each.way) != 2 for each in alone.forces):
        return False
    ways = [each.way for each in alone.forces]
    return all(tidied(ways[0][0] * way[1] - ways[0][1] * way[0]) == 0 for way in ways)


def _diagram(system: System, alone: BodyAlone, shares: Sequence[Rational], scene: Connections) -> Drawing:
    """Return the drawing of a body, which shows its forces and the angles of their directions.

    shares   the lengths of the arrows, in units of FORCE points
    """
    of, drawn, reach = alone.of, alone.forces, _reach(alone.of, alone.forces, scene)
    outline = list(_outline(of, is_pulley=_over_pulley(system, of) is not None))
    is_rod = any(isinstance(mark, BarMark | ThinRod) for mark in outline)
    stands = _stands(scene, alone)
    plain = BODY if scene.in_a_plane else BODY_IN_SPACE
    size = (STANDING if stands else plain) if isinstance(of, PlacedBody | Pulley) and not is_rod else None
    if isinstance(of, _RopePiece):
        size = ROPE * scene.number(distance_of(of.start, of.end)) / scene.number(of.whole)
    longest = LONG if size is None else Rational(FORCE / size)
    lengths = [float(longest * share * reach) for share in shares]
    apart = _set_apart([each.line(length, scene) for each, length in zip(drawn, lengths, strict=True)])
    touched = _touched(scene, of) if size is not None or not isinstance(of, PlacedBody) else []
    if stands:  # the normal force ends at the contact, and the weight ends above it
        drawn = tuple(replace(each, ends_there=_is_below(each, of, scene)) for each in drawn)
        apart = [0.0 if each.ends_there else off for each, off in zip(drawn, apart, strict=True)]
    if size is not None:
        apart = [off or _off_surface(each, touched, scene) for each, off in zip(drawn, apart, strict=True)]
    apart = [each.aside or off for each, off in zip(drawn, apart, strict=True)]
    arrows = [each.arrow(share, off) for each, share, off in zip(drawn, shares, apart, strict=True)]
    if stands:  # the weight is the first force
        arrows[0] = replace(arrows[0], inside=True)
    angles = _angles(system, of, list(zip(drawn, lengths, strict=True)))
    values = {**scene.values, **stance_values(system)}
    marks = [*outline, *_surfaces(touched, of), *arrows, *angles, *_positive(system, alone, scene)]
    mass = None if isinstance(of, Pulley) else explicit(_mass(of))
    return drawing(alone.key, marks, values=values, leads_to=alone.leads_to, forces_on=mass, body_size=size)


def _stands(scene: Connections, alone: BodyAlone) -> bool:
    """Whether the weight and a normal force of a round body are on one line through its centre. The normal force is
    then drawn as a push with its tip at the contact, because its torque depends on its point of application."""
    of = alone.of
    if not scene.system.weights or not isinstance(of, PlacedBody):
        return False
    is_round = any(_is_round(mark, scene) for mark in _outline(of))
    on_the_line = [each for each in alone.forces if not any(tidied(c) for c in each.way[:-1])]
    below = [each for each in on_the_line if _is_below(each, of, scene)]
    others = [each for each in on_the_line if each not in below and _offset(each, of, scene)[0] < SLIGHT]
    return is_round and len(below) == 1 and len(others) == 1  # the other force is the weight


def _is_round(mark: Mark, scene: Connections) -> bool:
    """Whether a mark is a disc in the plane of the drawing, or a ball."""
    if not isinstance(mark, Revolved):
        return isinstance(mark, WheelMark)
    rings = [(scene.number(height), scene.number(radius)) for height, radius in mark.profile]
    middle, far = (rings[0][0] + rings[-1][0]) / 2, (rings[-1][0] - rings[0][0]) / 2
    return all(abs(hypot(height - middle, radius) - far) < SLIGHT * far for height, radius in rings)


def _is_below(drawn: _Drawn, of: PlacedBody, scene: Connections) -> bool:
    aside, above = _offset(drawn, of, scene)
    *level, up = (scene.number(as_expr(c)) for c in drawn.way)
    return drawn.pushes and aside < SLIGHT and above < 0 and hypot(*level) < SLIGHT and up > 0


def _offset(drawn: _Drawn, of: PlacedBody, scene: Connections) -> tuple[float, float]:
    """Return the horizontal distance of the point of application from the centre of mass, and the height of the point
    above the centre.
    """
    *level, up = (scene.number(c) for c in (drawn.at - of.centre).components)
    return hypot(*level), up


def _acting(system: System, of: Any) -> list[PointForce]:
    """Return the forces of connections on a body. If there are such forces, add the normal force of a fixed plane on
    which the coordinates alone keep the body. No equation contains this normal force. It is not added if the
    coordinates also keep the body on another surface."""
    named = [force for each in connections_of(system, Connection) for force in each.on(of)]
    named += _drawn_pulls(system, of)
    return [*named, *_unnamed_normals(system, of)] if named else []


def _unnamed_normals(system: System, of: Any) -> list[PointForce]:
    touching = [each for each in connections_of(system, Contact) if each.of == of and each.is_kept]
    flat = [each for each in touching if isinstance(each.surface, Plane) and is_fixed(system, each.surface.through)]
    letter = _letter_of_normal(system)
    return [PointForce(letter, each.normal.components, each.at, of) for each in flat] if len(touching) == 1 else []


def _letter_of_normal(system: System) -> Symbol:
    used = {*given_letters(), *(each.force.name for each in system.constraints)}
    return scalar(next((name for name in NORMALS if name not in used), NORMALS[0]))


@dataclass(frozen=True)
class _Drawn:
    """A force in a diagram.

    value       the value along `way` in the system at rest; None if it is unknown
    pushes      whether it is the force of a surface, which cannot pull
    ends_there  whether the tip of the arrow is at `at`
    aside       the shift of the arrow to its left, in points
    """

    at: Location
    way: Any
    value: Expr | None
    label: Expr
    keys: tuple[str, ...] = ()
    pushes: bool = False
    ends_there: bool = False
    aside: float = 0.0

    def reversed(self) -> _Drawn:
        assert self.value is not None
        return replace(self, way=-self.way, value=-self.value, label=-self.label)

    def arrow(self, size: Expr, aside: float) -> ForceArrow:
        place = column_of(self.at)
        return ForceArrow(place, self.way, size, False, self.ends_there, aside=aside, label=self.label, keys=self.keys)

    def line(self, length: float, scene: Connections) -> tuple[Vector, Vector]:
        start, along = (_vector(scene, *column) for column in (self.at.components, self.way))
        return start, plus(start, unit(along), length)


def _vector(scene: Connections, *components: Expr) -> Vector:
    x, y, *rest = (scene.number(as_expr(c)) for c in components)
    return x, y, rest[0] if rest else 0.0


def _there(value: Expr | None, scene: Connections) -> Expr:
    values = {q: scene.values[q] for q in scene.system.coordinates if q in scene.values}
    return tidied(as_expr(value).subs(values).subs(values))


def _sizes(diagrams: Sequence[Sequence[_Drawn]], scene: Connections) -> list[list[float]]:
    """Return the magnitudes of the forces of each diagram, relative to the greatest force of all diagrams.

    If no trial numbers fit all diagrams together, the greatest force of each diagram is 1.
    """
    known = [drawn for drawn in diagrams if all(each.value is not None for each in drawn)]
    together = iter(_magnitudes([each for drawn in known for each in drawn], scene) or ())
    sizes = [[next(together, 0.0) for _ in drawn] if drawn in known else [] for drawn in diagrams]
    greatest = max((size for own in sizes for size in own), default=0.0)
    if greatest > 0:
        return [[size / greatest for size in own] or [1.0] * len(d) for own, d in zip(sizes, diagrams, strict=True)]
    alone = [(_magnitudes(drawn, scene) if drawn in known else None) or [1.0] * len(drawn) for drawn in diagrams]
    return [[size / (max(own) or 1.0) for size in own] for own in alone]


def _magnitudes(drawn: Sequence[_Drawn], scene: Connections) -> list[float] | None:
    """Return the magnitudes of the forces for trial numbers that satisfy the assumptions, and for which no surface
    pulls; None if there are no such numbers."""
    values = [explicit(with_numbers(as_expr(each.value).subs(scene.values).subs(scene.values))) for each in drawn]
    letters = sorted(set().union(*(value.free_symbols for value in values)), key=str)
    angles = {s for value in values for f in value.atoms(sin, cos) for s in f.free_symbols}
    usual = {s: ANGLE if s in angles else rational_in_range(s, Rational(4, 4 + i)) for i, s in enumerate(letters)}
    for point in (fulfilling(usual), *trial_points(letters, *assumptions_about(letters))):
        sizes = [value.xreplace(dict(point)).evalf() for value in values]
        if all(size.is_real for size in sizes) and all(
            size > 0 for each, size in zip(drawn, sizes, strict=True) if each.pushes
        ):
            return [abs(float(size)) for size in sizes]
    return None


def _share(size: float) -> Rational:
    """Return the length of an arrow relative to the longest arrow. It is at least `LEAST`, so that the arrows of small
    forces are visible."""
    return max(Rational(round(60 * size), 60), LEAST)


def _reach(of: Any, drawn: Sequence[_Drawn], scene: Connections) -> float:
    """Return the size of a body, which is approximately `Paper.reach` of its drawing; 1 for a particle."""
    middle = of.centre if isinstance(of, PlacedBody) else of.at
    has_size = isinstance(of, PlacedBody | Pulley | _RopePiece)
    arms = [distance_of(each.at, middle) for each in drawn] if has_size else []
    return max(map(scene.number, arms), default=0.0) or 1.0


def _set_apart(lines: Sequence[tuple[Vector, Vector]]) -> list[float]:
    """Return the shift of each arrow to its left, in points; 0 for an arrow that covers no earlier arrow."""
    found = []
    for i, (start, end) in enumerate(lines):
        along = unit(plus(end, start, -1.0))
        left = (-along[1], along[0], 0.0)
        others = sum(dot(left, unit(plus(b, a, -1.0))) for a, b in lines)
        is_covering = any(_overlap(start, end, *other) for other in lines[:i])
        found.append((-APART if others > SLIGHT else APART) if is_covering else 0.0)
    return found


def _overlap(start: Vector, end: Vector, other_start: Vector, other_end: Vector) -> bool:
    way = plus(end, start, -1.0)
    long, along = size_of(way), unit(way)
    ways = [plus(place, start, -1.0) for place in (other_start, other_end)]
    if any(size_of(cross(along, each)) > SLIGHT * long for each in ways):
        return False
    tail, head = (dot(along, each) for each in ways)
    covered = min(max(tail, head), long) - max(min(tail, head), 0.0)
    return covered > SLIGHT * long or head < tail and 0 <= head - long < NEAR * long


def _angles(system: System, of: Any, drawn: Sequence[tuple[_Drawn, float]]) -> Iterator[Mark]:
    """Yield the angle of a rod, and the angles by which forces are inclined; nothing for a system in space.

    drawn   pairs of a force and the length of its arrow
    """
    if len(system.places[0].components) != 2:
        return
    told: set[Any] = set()
    if isinstance(of, PlacedBody):
        bars: list[Mark] = [mark for mark in placed_outline(with_its_shape(of)) if isinstance(mark, BarMark)]
        for mark in own_angle(system, of, bars):
            told.add(mark.label)
            yield mark
    for each, length in sorted(drawn, key=lambda pair: not pair[0].pushes):
        turned = angle_of_link(system, Link(each.at, each.at + Location(tuple(each.way)), Integer(1), True))
        if turned is not None and turned[0].is_Symbol and turned[0] not in told:
            told.add(turned[0])
            far = Rational(round(1000 * length), 1000)
            zero, way = far * column_of(turned[1]), far * each.way
            yield AngleBetween(column_of(each.at), zero, way, True, label=turned[0])


def _shows_all(system: System, of: Any, acting: Sequence[PointForce], found: Mapping[Symbol, Quantity]) -> bool:
    return not _has_others(system) and _moves_by(system, of, acting, found)


def _has_others(system: System) -> bool:
    """Whether forces or couples act that a force diagram cannot show: given forces, springs, drags, charges, other
    stored energies, constraints by a motor, a rigid joint or a formula, and friction without a symbol."""
    frictions = [force for each in connections_of(system, Connection) for force in each.forces if force.size == 1]
    given = len(system.given_forces) > len(frictions)
    couples = any(not each.forces for each in system.constraints)  # constraints by a motor, a rigid joint or a formula
    unnamed = bool(system.conditions)  # rolling conditions, whose friction has no symbol
    return bool(couples or unnamed or given or system.between or system.dampers or system.charges or system.stored)


def _moves_by(system: System, of: Any, acting: Sequence[PointForce], found: Mapping[Symbol, Quantity]) -> bool:
    """Whether the drawn forces account for the motion of the centre of mass. If not, an unknown reaction also acts,
    such as the force of the ice on a plank."""
    centre, mass = (of.centre, of.body.mass) if isinstance(of, PlacedBody) else (of.at, of.mass)
    free = [k for k, c in enumerate(centre.components) if coordinates_in(c)]
    normals = [force.direction for force in acting if not _multipliers(system, force)]
    others = {each.force for each in system.constraints}  # the coordinates alone do not fulfil these constraints
    kept = [each.direction for each in acting if not others & {*_multipliers(system, each)}]
    if not _moves_alone(system, of, free, kept):
        return False
    if _is_on_axle(system, of, acting):
        return True
    values = {letter: explicit(step.value) for letter, step in found.items()}
    for k in set(range(len(centre.components))) - set(free):
        if any(n[k] != 0 for n in normals):
            continue
        down = explicit(mass) * system.gravity if k == len(centre.components) - 1 else Integer(0)
        if not is_zero(Add(*(f.size * f.direction[k] for f in acting)).xreplace(values) - down):
            return False
    return True


def _moves_alone(system: System, of: Any, free: Sequence[int], drawn: Sequence[Any]) -> bool:
    """Whether the coordinates allow the body to move alone, without rotation, in each direction that is perpendicular
    to the drawn forces. If not, an unknown reaction can act in that direction, such as the force of a wedge.

    free    the indices of the components of the position of the body that depend on coordinates
    drawn   the directions of the drawn forces whose constraints the coordinates fulfil
    """
    parts: list[Any] = [*system.particles, *system.bodies]
    own, places = 0, list[Expr]()
    for each in parts:
        own = len(places) if each == of else own
        places += [*(each.centre if isinstance(each, PlacedBody) else each.at).components]
        places += [as_expr(each.turned)] if isinstance(each, PlacedBody) and each.is_plane else []
    moves = ImmutableDenseMatrix([[derivative(c, q) for c in places] for q in system.coordinates])
    forces = ImmutableDenseMatrix(len(drawn), len(free), [way[k] for way in drawn for k in free])
    aside = [dict(zip((own + k for k in free), way, strict=True)) for way in forces.nullspace(simplify=tidied)]
    alone = ImmutableDenseMatrix(len(aside), len(places), lambda i, k: aside[i].get(k, 0))
    return bool(moves.col_join(alone).rank(simplify=tidied) == moves.rank(simplify=tidied))


def _multipliers(system: System, force: PointForce) -> list[Symbol]:
    letters = force.size.free_symbols | {s for c in force.direction for s in c.free_symbols}
    drawn = [each.drawn for each in connections_of(system, Line) if each.drawn is not None]
    return [letter for letter in (*(each.force for each in system.constraints), *drawn) if letter in letters]


def _outline(of: Any, is_pulley: bool = False) -> Iterator[Mark]:
    if isinstance(of, PlacedBody):
        shown = placed_outline(with_its_shape(of))
        for mark in shown:
            plain = replace(mark, label=None)
            yield replace(plain, pointer=None) if isinstance(plain, WheelMark) else plain
        sort = LargePoint if any(isinstance(mark, BarMark) for mark in shown) else PointMark
        yield sort(column_of(of.centre))
    elif isinstance(of, Pulley):
        yield WheelMark(column_of(of.at), of.radius)
    elif isinstance(of, _RopePiece):
        yield HeavyRopeMark((column_of(of.start), column_of(of.end)), (Integer(0), Integer(0)))
    elif is_pulley:
        yield WheelMark(column_of(of.at), label=of.mass)
    else:
        yield ParticleMark(column_of(of.at), label=of.mass)


def _over_pulley(system: System, of: Any) -> tuple[PointForce, PointForce] | None:
    """Return the pulls of the two pieces of a string that runs over a particle, which is then a small pulley; None
    if there is no such string."""
    if isinstance(of, PlacedBody | Pulley | _RopePiece) or len(of.at.components) != 2:
        return None
    lines = [each for each in connections_of(system, Line) if any(same(of.at, at) for at in each.places[1:-1])]
    pulls = [force for line in lines for force in line.on(of)]
    return (pulls[0], pulls[1]) if len(pulls) == 2 else None


def _asides(pulls: tuple[PointForce, PointForce]) -> tuple[float, float]:
    """Return the distances, in points, by which the arrows of the two pulls at a small pulley are shifted to the left
    of their directions. Each arrow then starts at the rim."""
    (x, y), (u, v) = (force.direction for force in pulls)
    side = -1.0 if numeric(x * v - y * u) > SLIGHT else 1.0
    return side * WHEEL, -side * WHEEL


def _touched(scene: Connections, of: Any) -> list[Contact]:
    return [each for each in scene.contacts if each.of == of] if scene.in_a_plane else []


def _surfaces(touched: Sequence[Contact], of: Any) -> Iterator[Mark]:
    """Yield a piece of each surface that a body touches, so that the direction of the normal force is visible."""
    for touch in touched:
        plain = touch.surface.is_two_sided or isinstance(touch.surface.moves, Location)  # a rail or a belt
        normal = column_of(touch.normal)
        if isinstance(of, PlacedBody):
            yield SurfacePiece(column_of(touch.at), normal, plain, 0.0, FOOT)
        else:
            is_ground = touch.surface.of is None  # the top of a plank is not ground, because the plank moves
            yield SurfacePiece(column_of(of.at), normal, touch.surface.is_two_sided, is_fixed=is_ground)


def _off_surface(drawn: _Drawn, touched: Sequence[Contact], scene: Connections) -> float:
    """Return the shift of an arrow to its left, in points, so that it does not cover the line of a surface."""
    x, y, _ = _vector(scene, *drawn.way)
    for touch in touched:
        normal, gap = (_vector(scene, *place.components) for place in (touch.normal, drawn.at - touch.at))
        if size_of(gap) < SLIGHT and abs(dot((x, y, 0.0), normal)) < SLIGHT:
            return ALONG if dot((-y, x, 0.0), normal) > 0 else -ALONG
    return 0.0


def _weight(system: System, of: Any) -> Iterator[_Drawn]:
    if system.weights:
        centre = of.centre if isinstance(of, PlacedBody) else of.at
        weight = explicit(_mass(of)) * system.gravity
        yield _Drawn(centre, downwards(len(centre.components)), weight, weight)


def _mass(of: Any) -> Any:
    return of.body.mass if isinstance(of, PlacedBody) else of.mass


def _forces(system: System, of: Any, acting: Sequence[PointForce], found: Mapping[Symbol, Quantity]) -> list[_Drawn]:
    still = {rate(q): Integer(0) for q in system.coordinates}
    values = {s: explicit(step.value).subs(still) for s, step in found.items() if isinstance(step.value, Expr)}
    surfaces = {each.force for each in system.constraints if each.enforcer == "surface"}
    named: list[_Drawn] = []
    unnamed: list[_Drawn] = []
    over = _over_pulley(system, of)
    counted = Counter(acting) if over is None else Counter(force for force in acting if force not in over)
    for force, aside in zip(over, _asides(over), strict=True) if over is not None else ():
        value = force.size.xreplace(values) if values.keys() >= {*_multipliers(system, force)} else None
        keys = tuple(found[letter].key for letter in _multipliers(system, force) if letter in found)
        way = ImmutableDenseMatrix(list(force.direction))
        named.append(_Drawn(of.at, way, value, force.size, keys, aside=aside))
    for force, times in counted.items():
        letters = _multipliers(system, force)
        size, direction = force.size, Location(force.direction)
        if size == 1:  # the direction of a friction force also contains its size
            size, direction = _size_and_direction(direction, letters)
        value = times * size.xreplace(values) if values.keys() >= {*letters} else None
        at = _beside(force) if isinstance(of, PlacedBody) else of.at
        keys = tuple(found[letter].key for letter in letters if letter in found)
        way = ImmutableDenseMatrix(list(direction.components))
        drawn = _Drawn(at, way, value, times * size, keys, size in surfaces or not letters)
        (named if letters else unnamed).append(drawn)
    others = [*_weight(system, of), *named]
    balancing = _axle_force(of, others) if _is_on_axle(system, of, acting) else []
    return [*named, *(replace(each, value=_balance(each, others)) for each in unnamed), *balancing]


def _is_on_axle(system: System, of: Any, acting: Sequence[PointForce]) -> bool:
    """Whether a body is on a fixed axle, as a pulley is, and the force of the axle is vertical."""
    if not isinstance(of, PlacedBody) or not of.is_plane or not is_fixed(system, of.centre):
        return False
    if any(force.direction[0] != 0 for force in acting):
        return False
    return all(isinstance(each, Line) for each in connections_of(system, Connection) if each.on(of))


def _axle_force(of: PlacedBody, others: Sequence[_Drawn]) -> list[_Drawn]:
    """Return the force of an axle. It balances the other forces, which are all vertical. No equation contains a symbol
    for the force of the axle, so its label is the sum of the other forces."""
    up = -downwards(2)
    label = tidied(Add(*(-as_expr(each.label) * each.way[1] for each in others)))
    known = all(each.value is not None for each in others)
    value = tidied(Add(*(-as_expr(each.value) * each.way[1] for each in others))) if known else None
    return [_Drawn(of.centre, up, value, label)] if label != 0 else []


def _balance(normal: _Drawn, others: Sequence[_Drawn]) -> Expr | None:
    """Return the normal force of a plane along which a body moves, from the balance of forces; None if another force is
    unknown."""
    if any(each.value is None for each in others):
        return None
    return tidied(-Add(*(as_expr(each.value) * (each.way.T * normal.way)[0] for each in others)))


def _beside(force: PointForce) -> Location:
    """Return the place at which a force on a body is drawn. A force along a rod is drawn a little below the rod, or
    beside a vertical rod."""
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
