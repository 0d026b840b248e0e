"""The parts of a system, as `given:` describes them: particles, springs, central forces, given forces, damping, charges
and constraints."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

from sympy import Dummy, Expr, Integer

from derive.algebra.expressions import scalar
from derive.course.expression import Declared
from derive.course.schema import (
    SCALAR,
    TEXT,
    YES_OR_NO,
    Reader,
    Record,
    as_written,
    key,
    list_of,
    mapping_of,
    record_of,
)
from derive.course.stock import InLetters, each
from derive.course.yaml_tree import Sequence, Tree, Word
from derive.errors import Faults, did_you_mean, rejected
from derive.mechanics import Particle, central, charge, constraint, couple, damping, force, spring
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.material import GROUND, MASSLESS
from derive.stock.keys.deferred import Deferred
from derive.stock.keys.places import COMPONENTS, PLACE, Places, WrittenPlace, is_letter

T = TypeVar("T")

ONE_OR_MORE_COMPONENTS = as_written(
    {"anyOf": [SCALAR.schema, COMPONENTS.schema]}, "an expression, or a list of components"
)


@dataclass(frozen=True)
class ParticleKeys(Record):
    """The keys of one entry of `particles:`."""

    mass: Tree = key("its mass", SCALAR, required=True)
    at: WrittenPlace = key("where it is", PLACE, required=True)

    def part(self, name: Word, places: Places, letters: InLetters) -> Deferred[Any]:
        of = (letters.value(self.mass, "mass", "mass"), places.at(self.at, "at"))
        return Deferred(Particle, of, place=self.places[""])


@dataclass(frozen=True)
class SpringKeys(Record):
    """The keys of one entry of `springs:`."""

    constant: Tree = key("its spring constant", SCALAR, required=True)
    start: WrittenPlace = key("where it begins", PLACE, called="from", required=True)
    end: WrittenPlace = key("where it ends", PLACE, called="to", required=True)
    length: Tree | None = key("its natural length; by default zero", SCALAR)
    massless: bool = key("`true` if it may end at a massless joint", YES_OR_NO)

    def part(self, places: Places, letters: InLetters) -> Deferred[Any]:
        length = letters.value(self.length, "length", "length", or_zero=True) if self.length else Integer(0)
        constant = letters.value(self.constant, "constant", "spring constant")
        of = (constant, *places.ends(self.start, self.end), length)
        return Deferred(spring, of, {"massless": self.massless}, place=self.places[""])


@dataclass(frozen=True)
class CentralKeys(Record):
    """The keys of one entry of `central:`, a potential energy that depends on the distance between two places."""

    energy: Tree = key("the energy, such as `-G*M*m/d`", SCALAR, required=True)
    distance: Word = key("the symbol for the distance in `energy`", TEXT, required=True)
    start: WrittenPlace = key("one of the two places", PLACE, called="from", required=True)
    end: WrittenPlace = key("the other place", PLACE, called="to", required=True)
    massless: bool = key("`true` if one of the places may be a massless joint", YES_OR_NO)

    def part(self, places: Places, letters: InLetters) -> Deferred[Any]:
        name = letters.unused(self.distance, "use another symbol for the distance")
        own = Dummy(name, positive=True)
        energy = letters.also({name: Declared(name, own, "length")}).of_kind(self.energy, "energy", "energy")
        if not energy.has(own):
            message = f"this energy does not depend on the distance `{name}`, so no force acts"
            rejected("unused-key", message, self.places["distance"])
        letter = scalar(name, positive=True)
        of = (energy.xreplace({own: letter}), letter, *places.ends(self.start, self.end))
        return Deferred(central, of, {"massless": self.massless}, place=self.places[""])


@dataclass(frozen=True)
class ForceKeys(Record):
    """The keys of one entry of `forces:`, a force at a place, or a torque."""

    components: tuple[Tree, ...] = key("its components in space", COMPONENTS)
    at: WrittenPlace | None = key(
        "the place where it acts; `ball.contact` is the particle of the body `ball` that touches a surface", PLACE
    )
    of: Word | None = key(
        "the body or particle on which the force acts, if `at` does not move with it, as at the contact of a "
        "sliding ball; `massless` for a massless part",
        TEXT,
    )
    by: Word | None = key(
        "the body or particle that exerts the force, and on which the opposite force acts, such as the plank under a "
        "sliding block; `ground` if no described body exerts the force",
        TEXT,
    )
    torque: Tree | None = key("in place of `components` and `at`, a torque", SCALAR)
    on: Tree | None = key("the angle that a positive torque tends to increase", SCALAR)

    def part(self, places: Places, letters: InLetters, bodies: Collection[str]) -> Deferred[Any]:
        if self.components and self.at and not (self.torque or self.on):
            components = components_of(self.components, "force", letters)
            named = {
                "of": named_bodies("of", [self.of], bodies, MASSLESS),
                "by": named_bodies("by", [self.by], bodies, GROUND),
            }
            return Deferred(force, (components, places.acted_on(self.at)), bodies=named, place=self.places[""])
        if (beside := self.of or self.by) and (self.torque or self.on) and not (self.components or self.at):
            message = "`of` and `by` belong to a force at a place, but this is a torque"
            rejected("unused-key", message, beside.place, "leave them out")
        if self.torque and self.on and not (self.components or self.at):
            angle = letters.of_kind(self.on, "on", "angle")
            return Deferred(couple, (letters.of_kind(self.torque, "torque", "torque"), angle), place=self.places[""])
        rejected("missing-key", "a force needs `components` and `at`, or `torque` and `on`", self.places[""])


@dataclass(frozen=True)
class DampingKeys(Record):
    """The keys of one entry of `damping:`."""

    constant: Tree = key(
        "the damping constant: the drag per speed or, with `on` for an angle, the torque per angular speed",
        SCALAR,
        required=True,
    )
    at: WrittenPlace | None = key(
        "the place whose velocity the drag opposes; at `ball.contact`, the velocity of the particle of the body `ball` "
        "that touches a surface",
        PLACE,
    )
    of: Word | None = key("the body or particle on which the drag acts, if `at` does not move with it", TEXT)
    on: Tree | None = key("in place of `at`, the coordinate whose rate the drag opposes", SCALAR)

    def part(self, places: Places, letters: InLetters, bodies: Collection[str]) -> Deferred[Any]:
        if self.at is not None and self.on is None:
            of = (letters.value(self.constant, "constant", "damping constant"), places.acted_on(self.at))
            named = {"of": named_bodies("of", [self.of], bodies, MASSLESS)}
            return Deferred(damping, of, bodies=named, place=self.places[""])
        if self.at is not None or self.on is None:
            rejected("missing-key", "damping needs either `at` or `on`", self.places[""])
        if self.of is not None:
            message = "`of` belongs to drag at a place, but this drag opposes the rate of a coordinate"
            rejected("unused-key", message, self.of.place, "leave it out")
        of = (letters.read(self.constant, "constant")[0], letters.read(self.on, "on")[0])
        return Deferred(damping, of, place=self.places[""])


@dataclass(frozen=True)
class ChargeKeys(Record):
    """The keys of one entry of `charges:`."""

    charge: Tree = key("its charge", SCALAR, required=True)
    at: WrittenPlace = key("where it is", PLACE, required=True)
    electric: tuple[Tree, ...] = key("components of the uniform electric field", COMPONENTS)
    magnetic: Tree | None = key(
        "components of the uniform magnetic field; in a plane, the perpendicular component", ONE_OR_MORE_COMPONENTS
    )

    def part(self, places: Places, letters: InLetters) -> Deferred[Any]:
        fields: dict[str, Any] = {}
        if self.electric:
            fields["E"] = tuple(letters.of_kind(node, "electric", "electric field") for node in self.electric)
        if self.magnetic is not None:
            several = isinstance(self.magnetic, Sequence)
            nodes = self.magnetic.items if isinstance(self.magnetic, Sequence) else (self.magnetic,)
            found = tuple(letters.constant(node, "magnetic", "magnetic field") for node in nodes)
            fields["B"] = found if several else found[0]
        of = (letters.constant(self.charge, "charge", "charge"), places.at(self.at, "at"))
        if not fields:
            message = "a charge without a field has no effect"
            rejected("missing-key", message, self.places[""], "give it `electric` or `magnetic`")
        return Deferred(charge, of, fields, place=self.places[""])


@dataclass(frozen=True)
class ConstraintKeys(Record):
    """The keys of one entry of `constraints:`, a condition that a constraint force enforces."""

    condition: Tree = key(
        "a formula in the coordinates, or a formula that is linear in their rates", SCALAR, required=True
    )
    equals: Tree | None = key("the value of the formula; by default zero", SCALAR)
    force: Word | None = key("the symbol of the constraint force, a multiplier; by default `lambda`", TEXT)

    def part(self, places: Places, letters: InLetters) -> Deferred[Any]:
        condition, dimension = letters.read(self.condition, "condition")
        equals: Expr = Integer(0)
        if self.equals is not None:
            equals, other = letters.read(self.equals, "equals")
            if other != dimension and not equals.is_zero:
                message = "`condition` and `equals` have different dimensions"
                rejected("dimension", message, self.values_at["equals"])
        force = force_letter(self.force, letters)
        return Deferred(constraint, (condition, equals), {"force": force}, forces=(force,), place=self.places[""])


def components_of(nodes: Collection[Tree], kind: str, letters: InLetters) -> tuple[Expr, ...]:
    """Return the components of a vector of this kind."""
    return tuple(each([partial(letters.of_kind, node, "a component", kind) for node in nodes]))


def direction_of(nodes: Collection[Tree], letters: InLetters) -> Location:
    """Return a direction, whose components must have the same dimension."""
    read = each([partial(letters.read, node, "a component") for node in nodes])
    dimensions = [(node, dimension) for node, (value, dimension) in zip(nodes, read, strict=True) if value != 0]
    for node, dimension in dimensions:
        if dimension != dimensions[0][1]:
            rejected("dimension", "the components of a direction have different dimensions", node.place)
    return Location(tuple(value for value, _ in read))


def force_letter(name: Word | None, letters: InLetters) -> str:
    """Return the symbol of a constraint force; the force is an unknown, so its symbol is not declared."""
    if name is None:
        return "lambda"
    if not is_letter(name):
        rejected("symbol", f"`{name}` is not a valid symbol for a force", name.place, "write `force: F`")
    return letters.unused(name, "leave it out of `symbols`, or give the force another symbol")


def named_bodies(
    key_name: str, names: Collection[Word | None], bodies: Collection[str], otherwise: str
) -> tuple[str, ...]:
    """Return the bodies or particles that a key names; the word `otherwise`, such as `ground`, is also allowed."""
    there = [name for name in names if name is not None]
    for name in there:
        if name not in bodies and name != otherwise:
            also = f", or write `{key_name}: {otherwise}`" if otherwise else ""
            help_line = did_you_mean(name, [*bodies, otherwise]) or f"name a body or a particle{also}"
            rejected("no-such-body", f"`{name}` is not a body or particle of this system", name.place, help_line)
    return tuple(map(str, there))


def one_or_list_of(one: Reader[T], wanted: str) -> Reader[tuple[T, ...]]:
    """Return a reader of a list; a single item is also allowed."""
    many = list_of(one, wanted)

    def read(node: Tree, name: str, faults: Faults) -> tuple[T, ...] | None:
        if isinstance(node, Sequence):
            return many.read(node, name, faults)
        found = one.read(node, name, faults)
        return () if found is None else (found,)

    return Reader({"anyOf": [one.schema, many.schema]}, read, tuple)


def list_of_parts(record: type[Record], what: str) -> Reader[tuple[Any, ...]]:
    """Return a reader of a list of mappings; a single mapping is also allowed."""
    return one_or_list_of(record_of(record, what, "a mapping"), f"a list of mappings, {what} each")


PARTICLES = mapping_of(record_of(ParticleKeys, "a particle", "a mapping with `mass` and `at`", "the particle `{}`"))
SPRINGS, CENTRAL = list_of_parts(SpringKeys, "a spring"), list_of_parts(CentralKeys, "a central force")
FORCES, DAMPING = list_of_parts(ForceKeys, "a force"), list_of_parts(DampingKeys, "damping")
CHARGES, CONSTRAINTS = list_of_parts(ChargeKeys, "a charge"), list_of_parts(ConstraintKeys, "a constraint")
