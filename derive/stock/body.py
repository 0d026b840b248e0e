"""Bodies: their centre of mass, and their inertia about points, axes and directions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

from sympy import Expr

from derive.course.expression import Declared
from derive.course.schema import SCALAR, TEXT, Record, key, mapping_of, record_of
from derive.course.stock import Described, InLetters, Stock, each
from derive.course.yaml_tree import Tree, Word
from derive.errors import DeriveError, Faults, rejected
from derive.mechanics import (
    centre_of_mass,
    inertia_tensor,
    moment_about,
    moment_of_inertia,
    moved_from_centre,
    moved_to,
    perpendicular_axes,
    principal_angle,
    principal_axes,
    principal_moments,
    radius_of_gyration,
    tensor_entry,
    turned_tensor,
    vector_component,
)
from derive.mechanics.bodies.body import Body
from derive.steps.step import Quantity
from derive.stock.answering.by_name import ByName
from derive.stock.keys.bodies import BODY, Bodies, BodyKeys, DescribedBody
from derive.stock.keys.directions import DIRECTION, Axis, Directions
from derive.stock.keys.outlines import drawn
from derive.stock.keys.results import RESULTS, Result, read_result

AXES = "xyz"
SIZES = ("length", "area", "volume")
# answers that depend on each key, by the beginning of their names
DEPENDING = {
    "about": ("inertia_tensor", "parallel", "moment", "radius", "turned", "principal", "perpendicular"),
    "origin": ("centre_of_mass",),
    "direction": ("moment_about",),
    "turned": ("turned_tensor",),
}


@dataclass(frozen=True)
class Questions(Record):
    """The questions about a body, in addition to its description."""

    about: Word | None = key("the point of its tensor and of the axes of its moments: `apex`, `corner`, `pivot`", TEXT)
    origin: Word | None = key("the point from which its centre of mass is measured", TEXT)
    direction: Tree | None = key("the axis of `moment_about`: `diagonal`, `x` or components", DIRECTION)
    turned: Mapping[Word, Tree] = key(
        "the angles by which the axes of `turned_tensor` are rotated: `{z: alpha}`", mapping_of(SCALAR)
    )


@dataclass(frozen=True)
class OneOfManyKeys(Questions, BodyKeys):
    """The keys of one of several bodies."""


@dataclass(frozen=True)
class GivenBody(Questions):
    """The keys of a body, or of several, and the questions about them."""

    body: BodyKeys | None = key("the body", BODY)
    bodies: Mapping[Word, OneOfManyKeys] = key(
        "several bodies by name, in place of one", mapping_of(record_of(OneOfManyKeys, "a body", "a mapping"))
    )
    results: Mapping[Word, Record] = key("quantities computed from answers, by names that you choose", RESULTS)


@dataclass(frozen=True)
class Asked:
    """A body, and the points and axes of the questions about it."""

    described: DescribedBody
    about: str = "centre"
    origin: str | None = None
    direction: Axis | None = None
    turns: tuple[tuple[str, Expr], ...] = ()

    @property
    def prefix(self) -> str:
        """Return what precedes the names of its answers, if there are several bodies."""
        return f"{self.described.called.replace(' ', '_')}_" if self.described.called else ""


@dataclass(frozen=True)
class DescribedBodies(Described):
    """Bodies in symbols."""

    bodies: tuple[Asked, ...] = ()
    results: tuple[Result, ...] = ()


def read(written: GivenBody, symbols: Mapping[str, Declared], faults: Faults) -> DescribedBodies:
    """Return the description in the declared symbols."""
    known = InLetters(symbols)
    found: list[Asked] = []
    with faults:
        found = _bodies(written, known)
    made = tuple(r for name, keys in written.results.items() if (r := read_result(keys, name, known, faults)))
    return DescribedBodies(
        made={result.name: result.uses for result in made},
        without=_without(written),
        chosen=known.chosen,
        measured=tuple(known.numbers.measured),
        several=tuple(one.prefix.removesuffix("_") for one in found if one.prefix),
        bodies=tuple(found),
        results=made,
    )


def _without(written: GivenBody) -> tuple[tuple[Word, set[str]], ...]:
    """Return, for each key that specifies a point or an axis, the answers that do not depend on it."""
    own = {f"{name.replace(' ', '_')}_": keys for name, keys in written.bodies.items()}
    asks = [*Answers(Asked(DescribedBody("", (), True))).asks()]
    every = {f"{prefix}{name}" for prefix in own or [""] for name in asks}
    found = []
    asked: list[tuple[str, Questions]] = [("", written), *own.items()]
    for prefix, keys in asked:
        for name in (name for name in DEPENDING if name in keys.values_at):
            about = [each for each in asks if each.startswith(DEPENDING[name])]
            of = {f"{one}{each}" for one in ([prefix] if prefix else own or [""]) for each in about}
            found.append((Word.at(name, keys.places[name]), every - of))
    return tuple(found)


def _bodies(written: GivenBody, known: InLetters) -> list[Asked]:
    if (written.body is None) == (not written.bodies):
        message = "`given` needs a `body`, or `bodies`" if not written.bodies else "`given` has `body` and `bodies`"
        rejected("missing-key", message, written.places[""], "write `body: {shape: disc, radius: R, mass: M}`")
    if written.body is not None:
        return [_asked(Bodies(known).body(written.body), written, written, known)]
    return each([partial(_one_of_many, name, body, written, known) for name, body in written.bodies.items()])


def _one_of_many(name: Word, written: OneOfManyKeys, others: GivenBody, known: InLetters) -> Asked:
    return _asked(Bodies(known).body(written, Word.at(str(name), name.place)), written, others, known)


def _asked(body: DescribedBody, own: Questions, others: Questions, known: InLetters) -> Asked:
    """Return the questions about one body; missing ones are those for all bodies."""
    about, origin = own.about or others.about, own.origin or others.origin
    directions = Directions(known)
    direction = own.direction or others.direction
    turned = own.turned or others.turned
    readings: list[Callable[[], object]] = [
        lambda: body.point(about) if about else "centre",
        lambda: body.point(origin) if origin else None,
        lambda: directions.axis(direction, "direction") if direction else None,
        lambda: directions.turns(turned),
    ]
    at, start, along, turns = each(readings)
    return Asked(body, at, start, along, turns)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Elsewhere:
    """The other point or axis of an answer, and its name."""

    key: str
    about: Word | None
    origin: Word | None
    direction: Axis | None
    symbol: str | None


class Answers:
    """Answers of one body, each derived when it is first needed."""

    def __init__(self, asked: Asked):
        self.asked = asked
        self.about = asked.about

    @cached_property
    def body(self) -> Body:
        return self.asked.described.body()

    @cached_property
    def centre_of_mass(self) -> Quantity:
        return centre_of_mass(self.body, self.asked.origin)

    @cached_property
    def inertia_tensor(self) -> Quantity:
        return inertia_tensor(self.body, self.about)

    def size(self, name: str) -> Quantity:
        found = getattr(self.body, "extent", None)
        if self.body.filling != name or not isinstance(found, Quantity):
            message = f"the {name} of {self.asked.described.told} is not a step: it is known"
            rejected("no-such-answer", message, None, "ask for `density`, which shows it")
        return found

    def mass(self) -> Quantity:
        found = self.body.density
        if found.step.kind != "mass":
            rejected("no-such-answer", f"the mass of {self.asked.described.told} is given", None)
        return found

    def density(self) -> Quantity:
        found = self.body.density
        if found.step.kind == "mass":
            rejected("no-such-answer", f"the density of {self.asked.described.told} is given", None)
        return found

    def moment(self, axis: str) -> Quantity:
        return moment_of_inertia(self.body, axis, self.about, f"I_{axis}", f"moment_of_inertia_{axis}")

    def entry(self, pair: str) -> Quantity:
        """Return the step of an entry of the tensor, or a step that reads it off."""
        tensor = self.inertia_tensor
        found = next((parent for parent in tensor.parents if parent.key == f"{tensor.key}_{pair}"), None)
        return found or tensor_entry(tensor, pair, key=f"{tensor.key}_{pair}")

    def moment_about(self, **named: str) -> Quantity:
        direction = self.asked.direction
        if direction is None:
            rejected("no-direction", "`moment_about` needs `direction`", None, "write `direction: [1, 1, 0]`")
        along = self.body.direction(direction.named) if direction.is_name else direction.components
        return moment_about(self.inertia_tensor, along, **named)

    def turned_tensor(self) -> tuple[Quantity, ...]:
        if not self.asked.turns:
            rejected("no-turn", "`turned_tensor` needs `turned`", None, "write `turned: {z: alpha}`")
        found = [self.inertia_tensor]
        for n, (axis, angle) in enumerate(self.asked.turns):
            is_last = n == len(self.asked.turns) - 1
            name = "turned_tensor" if is_last else f"turned_tensor_{n + 1}"
            found.append(turned_tensor(found[-1], axis, angle, key=name))
        return tuple(found[1:])

    @cached_property
    def principal_moments(self) -> Quantity:
        return principal_moments(self.inertia_tensor)

    def perpendicular_axes(self) -> Quantity:
        across = self.body.flat_across
        if across is None:
            message = f"the perpendicular-axis theorem needs a flat body, but {self.asked.described.told} is not flat"
            rejected("not-flat", message, None)
        first, second = (self.moment(axis) for axis in AXES if axis != across)
        return perpendicular_axes(first, second)

    def parallel_axes(self) -> Quantity:
        """Move the tensor from the centre to its point; if that is the centre, from the origin of the body's axes."""
        if self.about == "centre":
            start = self.body.reference
            there = inertia_tensor(self.body, start, key=f"{start.replace(' ', '_')}_tensor")
            return moved_to(there, centre_of_mass(self.body, start), key="parallel_axes")
        central = inertia_tensor(self.body, "centre", key="central_tensor")
        return moved_from_centre(central, centre_of_mass(self.body, self.about), key="parallel_axes")

    def called(self, name: Word, own: str, another: str, asked: Elsewhere) -> Quantity:
        """Return the answer under the name of a result; `another` is the symbol of its tensor."""
        depends = {"about": asked.about, "origin": asked.origin, "direction": asked.direction}
        for given in (given for given, value in depends.items() if value is not None):
            if not own.startswith(DEPENDING[given]):
                rejected("unused-key", f"`{name}` does not depend on `{given}`", None, "leave it out")
        key, letter, axis = asked.key, {"symbol": str(asked.symbol)} if asked.symbol else {}, own[-1]
        if own == "inertia_tensor":
            return inertia_tensor(self.body, self.about, **{"symbol": another, **letter}, key=key)
        if own == "centre_of_mass":
            return centre_of_mass(self.body, self.asked.origin, key=key, **letter)
        if own.startswith("moment_of_inertia_"):
            return moment_of_inertia(self.body, axis, self.about, **{"symbol": f"J_{axis}", **letter}, key=key)
        if own.startswith("radius_of_gyration_"):
            moment = moment_of_inertia(self.body, axis, self.about, f"J_{axis}", f"{key}_moment")
            return radius_of_gyration(moment, key=key, **letter)
        if own == "moment_about":
            self.inertia_tensor = self._tensor_of(asked, another)
            return self.moment_about(key=key, **letter)
        known = "a tensor, a moment of inertia, a radius of gyration, or a centre of mass"
        rejected("wrong-argument", f"`answer` yields {known}, not `{name}`", name.place)

    def _tensor_of(self, asked: Elsewhere, another: str) -> Quantity:
        """Return the tensor about the point of a result under a separate key; else the tensor that parts ask for."""
        if not asked.about:
            return inertia_tensor(self.body, self.about)
        return inertia_tensor(self.body, self.about, symbol=another, key=f"{asked.key}_tensor")

    def asks(self) -> dict[str, Callable[[], object]]:
        """Return every name that a part may ask for."""
        pairs = [first + second for n, first in enumerate(AXES) for second in AXES[n:]]
        return {
            "centre_of_mass": lambda: self.centre_of_mass,
            **{f"centre_of_mass_{axis}": partial(self.centre_component, axis) for axis in AXES},
            "density": self.density,
            "mass": self.mass,
            **{size: partial(self.size, size) for size in SIZES},
            "inertia_tensor": lambda: self.inertia_tensor,
            **{f"inertia_tensor_{pair}": partial(self.entry, pair) for pair in pairs},
            "parallel_axes": self.parallel_axes,
            **{f"moment_of_inertia_{axis}": partial(self.moment, axis) for axis in AXES},
            **{f"radius_of_gyration_{axis}": partial(self.gyration, axis) for axis in AXES},
            "moment_about": self.moment_about,
            "turned_tensor": self.turned_tensor,
            "principal_moments": lambda: self.principal_moments,
            "principal_axes": lambda: principal_axes(self.principal_moments),
            "principal_angle": lambda: principal_angle(self.inertia_tensor),
            "perpendicular_axes": self.perpendicular_axes,
        }

    def centre_component(self, axis: str) -> Quantity:
        """Return the step of a component, or a step that reads it off."""
        key = f"centre_of_mass_{axis}"
        along = key if axis != "z" else "centre_of_mass_on_axis"
        centre = self.centre_of_mass
        found = next((q for q in centre.parents if q.key.endswith((key, along))), None)
        return found or vector_component(centre, axis, key=key)

    def gyration(self, axis: str) -> Quantity:
        return radius_of_gyration(self.moment(axis), f"k_{axis}", f"radius_of_gyration_{axis}")


def solve(described: DescribedBodies, asked: Sequence[Word]) -> dict[str, object]:
    """Return the answers by the names that parts ask for."""
    of = _answers(described)
    for one in of.values():
        drawn(one.body)
    return _by_name(described, of).answers(asked)


def _answers(described: DescribedBodies) -> dict[str, Answers]:
    """Return the answers of each body, by the prefix of their names."""
    return {one.prefix: Answers(one) for one in described.bodies}


def _by_name(described: DescribedBodies, of: Mapping[str, Answers]) -> ByName:
    asks = {f"{prefix}{name}": answer for prefix, one in of.items() for name, answer in one.asks().items()}
    return ByName(
        asks,
        "a body",
        described.results,
        again=lambda: _by_name(described, _answers(described)),
        elsewhere=partial(_elsewhere, of=of),
    )


def _elsewhere(
    wanted: Word,
    key: str,
    about: Word | None,
    origin: Word | None,
    direction: Axis | None,
    symbol: str | None,
    of: Mapping[str, Answers],
) -> Quantity:
    """Return an answer about another point or axis than the given one."""
    prefix = max((prefix for prefix in of if wanted.startswith(prefix)), key=len, default=None)
    if prefix is None:
        rejected("no-such-answer", f"`{wanted}` is not an answer of one of these bodies", wanted.place)
    asked = of[prefix].asked
    point = asked.described.point(about) if about else asked.about
    start = asked.described.point(origin) if origin else asked.origin
    there = Answers(replace(asked, about=point, origin=start, direction=direction or asked.direction))
    there.body = of[prefix].body
    another = "I" if point == "centre" else "J" if asked.about == "centre" else "K"
    elsewhere = Elsewhere(key, about, origin, direction, symbol)
    return there.called(wanted, wanted.removeprefix(prefix), another, elsewhere)


def every(described: DescribedBodies) -> dict[str, tuple[Quantity, ...] | DeriveError]:
    """Return every answer that parts may ask for, or why it cannot be derived."""
    return _by_name(described, _answers(described)).every()


STOCK = Stock(GivenBody, read, solve, every)
