"""Any mechanical system: coordinates, places, bodies and what acts on them; its parts ask for what follows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

from sympy import Expr, Integer

from derive.course.expression import Declared
from derive.course.schema import SCALAR, Record, key, list_of, mapping_of, record_of
from derive.course.stock import Described, InLetters, Stock, each, told_at
from derive.course.yaml_tree import Tree, Word
from derive.errors import Faults, Place, did_you_mean, rejected
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    conserved_momentum,
    coordinate,
    equation_of_motion,
    generalized_momentum,
    kinetic_energy_of,
    lagrangian,
    potential_energy_of,
    spring,
    weight,
)
from derive.mechanics.systems.places import Location
from derive.mechanics.systems.system import PartOfSystem
from derive.steps.step import Quantity
from derive.stock.keys.places import (
    COORDINATES,
    PLACE,
    PLACES,
    POSITIVE,
    TURNS,
    Places,
    WrittenPlace,
    coordinate_letters,
)


@dataclass(frozen=True)
class ParticleKeys(Record):
    """The keys of one of `particles:`."""

    mass: Tree | None = key("its mass", SCALAR, required=True)
    at: WrittenPlace | None = key("where it is", PLACE, required=True)


@dataclass(frozen=True)
class SpringKeys(Record):
    """The keys of one of `springs:`."""

    constant: Tree | None = key("its spring constant", SCALAR, required=True)
    start: WrittenPlace | None = key("where it begins", PLACE, called="from", required=True)
    end: WrittenPlace | None = key("where it ends", PLACE, called="to", required=True)
    length: Tree | None = key("its natural length; without it zero", SCALAR)


@dataclass(frozen=True)
class SystemKeys(Record):
    """What describes a system."""

    coordinates: Mapping[Word, str] = key("what varies: `theta: angle`, `x: length`", COORDINATES, required=True)
    axes: Mapping[Word, tuple[Mapping[Word, Tree], ...]] = key(
        "axes that turn, by the turns that lead to them from those of space: `hoop: [{z: omega*t}]`", TURNS
    )
    points: Mapping[Word, WrittenPlace] = key(
        "places by name: `A: [l*sin(theta), -l*cos(theta)]`, `B: {from: A, by: [x, y]}`; the last component is upwards",
        PLACES,
        called="places",
    )
    particles: Mapping[Word, ParticleKeys] = key(
        "particles by name", mapping_of(record_of(ParticleKeys, "a particle", "a mapping with `mass` and `at`"))
    )
    gravity: Tree | None = key("the acceleration of free fall, downwards; without it nothing has weight", SCALAR)
    springs: Sequence[SpringKeys] = key(
        "springs without mass", list_of(record_of(SpringKeys, "a spring", "a mapping"), "a list of springs")
    )


@dataclass(frozen=True)
class Body:
    """A particle of the description, and where it stands in the file."""

    name: str
    mass: Expr
    at: Location
    place: Place = field(repr=False, compare=False)


@dataclass(frozen=True)
class Elastic:
    """A spring of the description."""

    constant: Expr
    ends: tuple[Location, Location]
    length: Expr
    place: Place = field(repr=False, compare=False)


@dataclass(frozen=True)
class DescribedSystem(Described):
    """A system in its letters."""

    coordinates: tuple[tuple[str, str, bool], ...] = ()
    particles: tuple[Body, ...] = ()
    springs: tuple[Elastic, ...] = ()
    gravity: Expr | None = None
    place: Place | None = field(default=None, repr=False, compare=False)


def read(written: SystemKeys, symbols: Mapping[str, Declared], faults: Faults) -> DescribedSystem:
    """What the keys say in the declared letters and in the coordinates."""
    letters = coordinate_letters(written.coordinates, symbols, faults)
    known = InLetters({**symbols, **letters})
    places = Places(written.points, written.axes, known)
    particles: list[Body] = []
    springs: list[Elastic] = []
    gravity = None
    with faults:
        places.all_named()
    with faults:
        particles = each([partial(_particle, str(n), p, places, known) for n, p in written.particles.items()])
    with faults:
        springs = each([partial(_spring, each_spring, places, known) for each_spring in written.springs])
    if written.gravity is not None:
        with faults:
            gravity = known.value(written.gravity, "gravity", "acceleration")
    sorts = [(n, letters[n].kind, sort == POSITIVE) for n, sort in written.coordinates.items() if n in letters]
    return DescribedSystem(
        letters=letters,
        chosen=known.chosen,
        measured=tuple(known.numbers.measured),
        coordinates=tuple(sorts),
        particles=tuple(particles),
        springs=tuple(springs),
        gravity=gravity,
        place=written.places[""],
    )


def _particle(name: str, written: ParticleKeys, places: Places, letters: InLetters) -> Body:
    assert written.mass is not None
    assert written.at is not None
    return Body(name, letters.value(written.mass, "mass", "mass"), places.at(written.at, name), written.places[""])


def _spring(written: SpringKeys, places: Places, letters: InLetters) -> Elastic:
    assert written.start is not None
    assert written.end is not None
    assert written.constant is not None
    ends = places.at(written.start, "the start of a spring"), places.at(written.end, "the end of a spring")
    length = letters.value(written.length, "length", "length") if written.length else Integer(0)
    return Elastic(letters.value(written.constant, "constant", "spring constant"), ends, length, written.places[""])


class Answers:
    """What parts may ask of a system, each derived when it is first asked for."""

    def __init__(self, described: DescribedSystem):
        self.described = described
        self.coordinates = {
            name: coordinate(name, kind, positive=positive) for name, kind, positive in described.coordinates
        }

    @cached_property
    def system(self) -> System:
        parts: list[PartOfSystem] = []
        for body in self.described.particles:
            with told_at(body.place):
                parts.append(Particle(body.mass, body.at))
        for each_spring in self.described.springs:
            with told_at(each_spring.place):
                parts.append(spring(each_spring.constant, *each_spring.ends, each_spring.length))
        if self.described.gravity is not None:
            parts.append(weight(self.described.gravity))
        with told_at(self.described.place):
            return System(*parts)

    @cached_property
    def kinetic_energy(self) -> Quantity:
        return kinetic_energy_of(self.system)

    @cached_property
    def potential_energy(self) -> Quantity:
        return potential_energy_of(self.system)

    @cached_property
    def lagrangian(self) -> Quantity:
        return lagrangian(self.kinetic_energy, self.potential_energy)

    def motion(self, q: Coordinate) -> Quantity:
        return equation_of_motion(self.lagrangian, q, key=f"motion_{q.symbol.name}")

    def asks(self) -> dict[str, Callable[[], object]]:
        """Every name that a part may ask by."""
        of_coordinates: dict[str, Callable[[], object]] = {}
        for name, q in self.coordinates.items():
            of_coordinates[f"motion_{name}"] = partial(self.motion, q)
            of_coordinates[f"momentum_{name}"] = partial(self._of_lagrangian, generalized_momentum, q)
            of_coordinates[f"conserved_{name}"] = partial(self._of_lagrangian, conserved_momentum, q)
        return {
            "kinetic_energy": lambda: self.kinetic_energy,
            "potential_energy": lambda: self.potential_energy,
            "lagrangian": lambda: self.lagrangian,
            "equations_of_motion": lambda: tuple(self.motion(q) for q in self.coordinates.values()),
            **of_coordinates,
        }

    def _of_lagrangian(self, verb: Callable[..., Quantity], q: Coordinate) -> Quantity:
        return verb(self.lagrangian, q)


def solve(described: DescribedSystem, asked: Sequence[Word]) -> dict[str, object]:
    """The answers by the names that parts ask for."""
    asks = Answers(described).asks()
    answers: dict[str, object] = {}
    for name in asked:
        if name not in asks:
            help_line = did_you_mean(name, asks) or f"one may ask for {', '.join(asks)}"
            rejected("no-such-answer", f"a system has no answer called `{name}`", name.place, help_line)
        with told_at(name.place):
            answers[str(name)] = asks[name]()
    return answers


STOCK = Stock(SystemKeys, read, solve)
