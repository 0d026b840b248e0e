"""Single particles and bodies of a system: displacements in which only one of them moves, and the forces on it.

Suppose that the coordinates allow one body to move along a direction while all other bodies stay at rest. Then Newton's
second law for this body along this direction contains only forces that the description names. If all values
of the coordinates satisfy a constraint, the force of this constraint does no work in such a displacement. So this force
has no component along the direction. An example is the tension of a string whose length does not depend on the
coordinates.

Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 3 and 7.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Symbol, diff, sqrt

from derive.algebra.expressions import Terms, TimeRate, explicit
from derive.algebra.samples import generic_rank
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody, central_second_moments
from derive.mechanics.model.dalembert import Load, Reaction
from derive.mechanics.model.system import System
from derive.steps.signs import sign_known
from derive.steps.step import is_zero

Vector = tuple[Expr, ...]
ZERO = Integer(0)


@dataclass(frozen=True)
class Force:
    """A force on one body.

    components   the components in newtons, along the axes of the plane, or of space for a particle in space
    at           the place of the material point on which the force acts; None for a couple
    couple       the torque of a couple, N m, positive counterclockwise
    letter       the symbol of the constraint force that `components` or `couple` contains; None for a known force
    """

    components: Vector
    at: Vector | None
    couple: Expr = ZERO
    letter: Symbol | None = None

    def along(self, way: Vector) -> Expr:
        """The component along a unit vector."""
        return dot(self.components, way)

    def torque(self, about: Vector) -> Expr:
        """The torque about a place, N m, positive counterclockwise."""
        if self.at is None:
            return self.couple
        x, y = arm(self.at, about)
        fx, fy = self.components
        return x * fy - y * fx


@dataclass(frozen=True)
class Alone:
    """A particle or a body of a system.

    part     the particle or the placed body
    system   the system to which this particle or body belongs
    """

    part: Any
    system: System

    @property
    def mass(self) -> Expr:
        return explicit(self.part.body.mass if self.is_body else self.part.mass)

    @property
    def is_body(self) -> bool:
        return isinstance(self.part, PlacedBody)

    @property
    def centre(self) -> Vector:
        """The place of the particle, or of the centre of mass."""
        place: Vector = (self.part.centre if self.is_body else self.part.at).components
        return place

    @property
    def angle(self) -> Expr:
        """The angle of the body, positive counterclockwise."""
        return explicit(self.part.turned) if self.is_body else ZERO

    @property
    def moving(self) -> list[Symbol]:
        return list(self.system.coordinates)

    @property
    def axis(self) -> Vector | None:
        """The place of the fixed point about which the body rotates; None if the body is not held at a fixed point."""
        held: Vector | None = self.part.at.components if self.is_body and self.part.is_held else None
        return held

    def shift(self, q: Symbol) -> Vector:
        """The displacement of the centre for a small change of a coordinate, per unit of the change."""
        return tuple(tidied(diff(c, q)) for c in self.centre)

    def turn(self, q: Symbol) -> Expr:
        """The rotation for a small change of a coordinate, per unit of the change."""
        return tidied(diff(self.angle, q))

    def moves_with(self, q: Symbol) -> bool:
        return any(c != 0 for c in (*self.shift(q), self.turn(q)))

    def carried(self, place: Vector, q: Symbol) -> Vector:
        """The displacement of the point of the body at a place, per unit of the change of the coordinate."""
        if not self.is_body:
            return self.shift(q)
        (dx, dy), turn = self.shift(q), self.turn(q)
        x, y = arm(place, self.centre)
        return dx - turn * y, dy + turn * x

    @cached_property
    def acceleration_of_centre(self) -> Vector:
        return tuple(second_rate(c, self.moving) for c in self.centre)

    def acceleration(self, way: Vector) -> Expr:
        """The component of the acceleration of the centre along a unit vector."""
        return tidied(dot(self.acceleration_of_centre, way).expand())

    @property
    def angular_acceleration(self) -> Expr:
        return second_rate(self.angle, self.moving)

    @property
    def spread(self) -> Expr:
        """The sum of m r^2 over the particles of the body, with r measured from the centre of mass in the plane."""
        if not self.is_body:
            return ZERO
        moments, axes = central_second_moments(self.part.body), self.part.in_plane
        return Add(*(moments[i, i] for i in axes))

    @cached_property
    def forces(self) -> tuple[Force, ...]:
        """The forces and couples on this body, including its weight. If all values of the coordinates satisfy a
        constraint, its force is left out."""
        return tuple(force for force, on in _forces(self.system) if on is self.part)


def dot(a: Vector, b: Vector) -> Expr:
    return Add(*(x * y for x, y in zip(a, b, strict=True)))


def second_rate(value: Expr, moving: Sequence[Symbol]) -> Expr:
    return explicit(TimeRate(explicit(TimeRate(value, *moving)), *moving))


def bodies_alone(system: System) -> list[Alone]:
    """The particles and bodies of a system; bodies move in a plane; particles may also move in space."""
    if any(not body.is_plane for body in system.bodies):
        message = "the laws of one body are written for motions in a plane, but a body moves in space"
        raise Rejected(Complaint("method", message, help="use `method: lagrange`"))
    return [Alone(part, system) for part in (*system.particles, *system.bodies)]


def body_of(system: System, q: Symbol) -> Alone:
    """The body whose equation of motion belongs to a coordinate.

    A body that moves with fewer coordinates gets its coordinate first. For example, a wedge gets its own position. A
    block on the wedge also moves with this position, so the block gets its position along the wedge.
    """
    taken: dict[Symbol, Alone] = {}
    bodies = bodies_alone(system)
    for each in sorted(bodies, key=lambda one: sum(one.moves_with(s) for s in system.coordinates)):
        for s in system.coordinates:
            if s not in taken and each.moves_with(s) and _moves_alone(each, s):
                taken[s] = each
    if q not in taken:
        why = "because the coordinates keep a connection whose force has no symbol"
        message = f"the coordinates do not let one body move with {q.name} while all others stay at rest, {why}"
        help_line = (
            "give each body coordinates of its own, and each string, rod, joint or contact a symbol for its force; "
            "or use `method: lagrange`"
        )
        raise Rejected(Complaint("method", message, help=help_line))
    return taken[q]


def _moves_alone(body: Alone, q: Symbol) -> bool:
    return is_free(body, body.shift(q), body.turn(q))


def is_free(body: Alone, shift: Vector, turn: Expr) -> bool:
    """Whether the coordinates allow this displacement of the centre and this rotation while all other bodies rest."""
    return allows(body.system, {body.part: (*shift, turn)})


def changes_alone(body: Alone, shift: Vector, turn: Expr) -> dict[Symbol, Expr]:
    """The changes of the coordinates for this displacement of one body while all other bodies rest."""
    return changes_for(body.system, {body.part: (*shift, turn)})


def allows(system: System, wanted: Mapping[Any, Vector], there: Callable[[Any], Any] = explicit) -> bool:
    """Whether the coordinates allow a displacement of the whole system.

    wanted   a particle or body -> the displacement of its centre, and its rotation; all others rest
    there    a function that substitutes the values of the coordinates where the displacement begins
    """
    matrix, column = _displacements(system, wanted, there)
    return generic_rank(matrix) == generic_rank(matrix.row_join(column))


def changes_for(
    system: System, wanted: Mapping[Any, Vector], there: Callable[[Any], Any] = explicit
) -> dict[Symbol, Expr]:
    """The changes of the coordinates for a displacement that they allow; the arguments are as for `allows`."""
    matrix, column = _displacements(system, wanted, there)
    rows = _independent(matrix)
    columns = _independent(matrix.extract(rows, range(matrix.cols)).T)
    solved = matrix.extract(rows, columns).LUsolve(column.extract(rows, [0]))
    moving = list(system.coordinates)
    return {moving[k]: tidied(value) for k, value in zip(columns, solved, strict=True) if not is_zero(value)}


def _independent(matrix: ImmutableDenseMatrix) -> list[int]:
    """The indices of rows that are independent and span the row space."""
    rows: list[int] = []
    for i in range(matrix.rows):
        if generic_rank(matrix.extract([*rows, i], range(matrix.cols))) > len(rows):
            rows.append(i)
    return rows


def _displacements(
    system: System, wanted: Mapping[Any, Vector], there: Callable[[Any], Any]
) -> tuple[ImmutableDenseMatrix, ImmutableDenseMatrix]:
    """The derivatives of all places and angles with respect to the coordinates, and the changes of these places and
    angles in the displacement."""
    rows, column = [], []
    for each in bodies_alone(system):
        own = next((change for part, change in wanted.items() if part is each.part), (ZERO,) * (len(each.centre) + 1))
        for value, change in zip((*each.centre, each.angle), own, strict=True):
            rows.append([there(diff(value, s)) for s in system.coordinates])
            column.append(there(change))
    return ImmutableDenseMatrix(rows), ImmutableDenseMatrix(column)


@lru_cache(maxsize=16)
def _forces(system: System) -> tuple[tuple[Force, Any], ...]:
    matter = system.matter
    loads = [*matter.loads, *matter.others, *(field.load(matter.coordinates) for field in matter.fields)]
    return tuple(found for load in loads for found in _on_its_body(load, system))


def _on_its_body(load: Load | Reaction, system: System) -> list[tuple[Force, Any]]:
    """The force with the particle or body on which it acts, as the only item of a list. The list is empty for a force
    on a fixed place, such as the ground, and for a couple that does no work."""
    works = {q: load.work_along(q) for q in system.coordinates}
    if isinstance(load, Reaction) or len(load.place) == 1:
        return [_couple(load, works, system)] if any(not is_zero(work) for work in works.values()) else []
    slopes = {q: load.slopes(q) for q in system.coordinates}
    if all(is_zero(c) for slope in slopes.values() for c in slope):
        return []
    place = tuple(c.xreplace(dict(load.held)) for c in load.place)
    on = [each for each in bodies_alone(system) if moves_like(each, place, slopes)]
    if len(on) != 1:
        raise _on_no_body(f"the force at ({', '.join(map(str, place))})")
    return [(Force(load.force, place, letter=load.multiplier), on[0].part)]


def _couple(load: Load | Reaction, works: Mapping[Symbol, Expr], system: System) -> tuple[Force, Any]:
    """A couple on the body whose rotation determines the work of the load. If there is no such body, it is unknown on
    which body the load acts, and the load is rejected."""
    for each in bodies_alone(system):
        torque = next((tidied(work / turn) for q, work in works.items() if (turn := each.turn(q)) != 0), ZERO)
        if all(is_zero(work - torque * each.turn(q)) for q, work in works.items()):
            return Force((ZERO, ZERO), None, torque, load.multiplier), each.part
    raise _on_no_body("the force" if load.multiplier is None else f"the force `{load.multiplier}`")


def _on_no_body(what: str) -> Rejected:
    message = f"it is unknown on which body {what} acts"
    help_line = "describe a contact, a string, a rod or a force at a place; or use `method: lagrange`"
    return Rejected(Complaint("method", message, help=help_line))


def moves_like(
    body: Alone, place: Vector, slopes: Mapping[Symbol, Vector], there: Callable[[Any], Any] = explicit
) -> bool:
    """Whether a place moves in the same way as the material point of the body at this place.

    slopes   coordinate -> the displacement of the place, per unit of the change of the coordinate
    there    a function that substitutes the values of the coordinates at one instant
    """
    return all(
        is_zero(there(a - b)) for q, slope in slopes.items() for a, b in zip(slope, body.carried(place, q), strict=True)
    )


def arm(place: Vector, about: Vector) -> Vector:
    return tuple(a - b for a, b in zip(place, about, strict=True))


def rotated(body: Alone, about: Vector) -> Vector:
    """The displacement of the centre in a rotation about a place by a unit angle, counterclockwise."""
    x, y = arm(body.centre, about)
    return tidied(-y), tidied(x)


def is_same(one: Vector, other: Vector) -> bool:
    return all(is_zero(a - b) for a, b in zip(one, other, strict=True))


def sense_of(turn: Expr) -> Expr:
    """1 if a rotation is counterclockwise, -1 if it is clockwise; reject a rotation whose direction is unknown."""
    sign = sign_known(turn)
    if not sign:
        message = f"it is unknown whether the rotation by {turn} per unit of the coordinate is counterclockwise"
        raise Rejected(Complaint("method", message, help="give ranges or numbers for the symbols that decide this"))
    return Integer(sign)


def sum_of(terms: Sequence[Expr]) -> Expr:
    """The sum of the components of forces, or of torques: positive terms first. Equal terms are combined, as in 2 T."""
    numbers: dict[Expr, Expr] = {}
    for number, rest in (tidied(each).as_coeff_Mul() for each in terms):
        numbers[rest] = numbers.get(rest, ZERO) + number
    found = [number * rest for rest, number in numbers.items() if number != 0]
    ordered = sorted(found, key=lambda term: term.could_extract_minus_sign())
    return Terms(*ordered) if len(ordered) > 1 else ordered[0] if ordered else ZERO


def unit_along(shift: Vector) -> Vector:
    """The unit vector along a displacement. For a displacement r d(theta), the unit vector points towards larger theta
    if r is positive."""
    length = tidied(sqrt(tidied(Add(*(c**2 for c in shift)).expand())))
    length = length.replace(Abs, lambda size: size)
    return tuple(tidied(c / length) for c in shift)
