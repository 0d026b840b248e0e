"""Bodies: their centre of mass, and their inertia about points, axes and directions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations_with_replacement
from typing import Any, NoReturn

from sympy import Expr

from derive.course.expression import Declared
from derive.course.placement import Placement
from derive.course.schema import SCALAR, TEXT, Record, key, mapping_of, record_of
from derive.course.stock import Described, InLetters, Stock, attempted, each, told_at
from derive.course.yaml_tree import Tree, Word
from derive.errors import Faults, rejected
from derive.mechanics import (
    Composite,
    PointMass,
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
from derive.stock.answering.answers import Answers, StockAnswers, answer, answer_for_each
from derive.stock.keys.bodies import BODY, Bodies, BodyKeys, DescribedBody
from derive.stock.keys.directions import DIRECTION, Axis, Directions
from derive.stock.keys.outlines import SHOWS, drawn, name_of_drawing, sketched
from derive.stock.keys.results import RESULTS, read_results

AXES = "xyz"
SIZES = ("length", "area", "volume")
# key -> the beginnings of the names of the answers that depend on it
DEPENDING = {
    "about": ("inertia_tensor", "parallel", "moment", "radius", "turned", "principal", "perpendicular"),
    "origin": ("centre_of_mass",),
    "direction": ("moment_about",),
    "turned": ("turned_tensor",),
}


@dataclass(frozen=True)
class Questions(Record):
    """Keys that specify the points and axes of the answers about a body."""

    about: Word | None = key(
        "the point about which the inertia tensor and the moments of inertia are taken: `apex`, `corner`, `pivot`", TEXT
    )
    origin: Word | None = key("the point from which the centre of mass is measured", TEXT)
    direction: Tree | None = key("the axis of `moment_about`: `diagonal`, `x` or components", DIRECTION)
    turned: Mapping[Word, Tree] = key(
        "the angles by which the axes of `turned_tensor` are rotated: `{z: alpha}`", mapping_of(SCALAR)
    )


@dataclass(frozen=True)
class OneOfManyKeys(Questions, BodyKeys):
    """The keys of one of several bodies."""


@dataclass(frozen=True)
class GivenBody(Questions):
    """The keys of one body or of several bodies, and of the points and axes of the answers."""

    body: BodyKeys | None = key("the body", BODY)
    bodies: Mapping[Word, OneOfManyKeys] = key(
        "several bodies by name, in place of `body`", mapping_of(record_of(OneOfManyKeys, "a body", "a mapping"))
    )
    results: Mapping[Word, Record] = key("quantities computed from answers, by names that you choose", RESULTS)


@dataclass(frozen=True)
class Asked:
    """A body, and the points and axes of the answers about it."""

    described: DescribedBody
    about: str = "centre"
    origin: str | None = None
    direction: Axis | None = None
    turns: tuple[tuple[str, Expr], ...] = ()

    @property
    def prefix(self) -> str:
        """Return the beginning of the names of the answers: the name of the body, if it has one."""
        return f"{self.described.called.replace(' ', '_')}_" if self.described.called else ""


@dataclass(frozen=True)
class DescribedBodies(Described):
    """Described bodies, whose values are expressions in the declared symbols."""

    bodies: tuple[Asked, ...] = ()


def read(written: GivenBody, symbols: Mapping[str, Declared], faults: Faults) -> DescribedBodies:
    """Return the description with its values as expressions in the declared symbols."""
    known = InLetters(symbols)
    found = attempted(faults, _bodies, written, known) or []
    results = read_results(written.results, known, faults)
    return DescribedBodies(
        without=_without(written),
        chosen=known.chosen,
        measured=tuple(known.numbers.measured),
        several=tuple(one.prefix.removesuffix("_") for one in found if one.prefix),
        bodies=tuple(found),
        results=results,
    )


def _without(written: GivenBody) -> tuple[tuple[Word, set[str]], ...]:
    """Return the keys of `DEPENDING` that the author wrote, each with the answers that do not depend on it."""
    own = {f"{name.replace(' ', '_')}_": keys for name, keys in written.bodies.items()}
    asks = [*BodyAnswers(Asked(DescribedBody("", (), True))).asks()]
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
        message = "`given` needs either `body` or `bodies`"
        rejected("missing-key", message, written.places[""], "write `body: {shape: disc, radius: R, mass: M}`")
    if written.body is not None:
        return [_asked(Bodies(known).body(written.body), written, written, known)]
    return each([partial(_one_of_many, name, body, written, known) for name, body in written.bodies.items()])


def _one_of_many(name: Word, written: OneOfManyKeys, others: GivenBody, known: InLetters) -> Asked:
    return _asked(Bodies(known).body(written, Word.at(str(name), name.place)), written, others, known)


def _asked(body: DescribedBody, own: Questions, others: Questions, known: InLetters) -> Asked:
    """Return one body with its points and axes. A key that this body does not have is taken from the keys for all
    bodies."""
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


class BodyAnswers(Answers[Asked]):
    """The quantities of one body."""

    @property
    def about(self) -> str:
        return self.described.about

    @cached_property
    def body(self) -> Body:
        return self.described.described.body()

    @property
    def told(self) -> str:
        return self.described.described.told

    @answer
    def centre_of_mass(self) -> Quantity:
        return centre_of_mass(self.body, self.described.origin)

    @answer_for_each("centre_of_mass_{}", lambda self: AXES)
    def centre_component(self, axis: str) -> Quantity:
        """Return the step that derived this component, or a new step that takes it from the vector."""
        key = f"centre_of_mass_{axis}"
        along = key if axis != "z" else "centre_of_mass_on_axis"
        centre = self.centre_of_mass
        found = next((q for q in centre.parents if q.key.endswith((key, along))), None)
        return found or vector_component(centre, axis, key=key)

    @answer
    def density(self) -> Quantity:
        return self._of_mass("density")

    @answer
    def mass(self) -> Quantity:
        return self._of_mass("mass")

    def _of_mass(self, name: str) -> Quantity:
        if isinstance(self.body, PointMass) or name == "density" and isinstance(self.body, Composite):
            self._has_no(name)
        found = self.body.density
        if (found.step.kind == "mass") != (name == "mass"):
            rejected("no-such-answer", f"the {name} of {self.told} is given, so no step derives it", None)
        return found

    @answer_for_each("{}", lambda self: SIZES)
    def size(self, name: str) -> Quantity:
        if isinstance(self.body, PointMass | Composite) or self.body.filling != name:
            self._has_no(name)
        found = self.body.extent
        if not isinstance(found, Quantity):
            message = f"the {name} of {self.told} is known, so no step derives it"
            rejected("no-such-answer", message, None, f"ask for `density`, whose step shows the {name}")
        return found

    def _has_no(self, name: str) -> NoReturn:
        filling = self.body.filling
        fills = f"it has {'an' if filling == 'area' else 'a'} {filling}"
        of_density = f"{fills}: ask for `density`, whose step shows the {filling}"
        parts = isinstance(self.body, Composite)
        help_line = "ask for `mass`, the sum of the masses of its parts" if parts else of_density
        help_line = "its mass is given" if isinstance(self.body, PointMass) else help_line
        rejected("no-such-answer", f"`{name}` is not an answer about {self.told}", None, help_line)

    @answer
    def inertia_tensor(self) -> Quantity:
        return inertia_tensor(self.body, self.about)

    @answer_for_each("inertia_tensor_{}", lambda self: map("".join, combinations_with_replacement(AXES, 2)))
    def entry(self, pair: str) -> Quantity:
        """Return the step that derived this entry, or a new step that takes it from the tensor."""
        tensor = self.inertia_tensor
        found = next((parent for parent in tensor.parents if parent.key == f"{tensor.key}_{pair}"), None)
        return found or tensor_entry(tensor, pair, key=f"{tensor.key}_{pair}")

    @answer
    def parallel_axes(self) -> Quantity:
        """Return the tensor about `about`, moved from the centre of mass (or to it) by the parallel-axis theorem."""
        if self.about == "centre":
            start = self.body.reference
            there = inertia_tensor(self.body, start, key=f"{start.replace(' ', '_')}_tensor")
            return moved_to(there, centre_of_mass(self.body, start), key="parallel_axes")
        central = inertia_tensor(self.body, "centre", key="central_tensor")
        return moved_from_centre(central, centre_of_mass(self.body, self.about), key="parallel_axes")

    @answer_for_each("moment_of_inertia_{}", lambda self: AXES)
    def moment(self, axis: str) -> Quantity:
        return moment_of_inertia(self.body, axis, self.about, f"I_{axis}", f"moment_of_inertia_{axis}")

    @answer_for_each("radius_of_gyration_{}", lambda self: AXES)
    def gyration(self, axis: str) -> Quantity:
        return radius_of_gyration(self.moment(axis), f"k_{axis}", f"radius_of_gyration_{axis}")

    @answer
    def moment_about(self) -> Quantity:
        return self.about_direction(self.inertia_tensor)

    @answer
    def turned_tensor(self) -> tuple[Quantity, ...]:
        if not self.described.turns:
            rejected("no-turn", "`turned_tensor` needs `turned`", None, "write `turned: {z: alpha}`")
        found = [self.inertia_tensor]
        for n, (axis, angle) in enumerate(self.described.turns):
            is_last = n == len(self.described.turns) - 1
            name = "turned_tensor" if is_last else f"turned_tensor_{n + 1}"
            found.append(turned_tensor(found[-1], axis, angle, key=name))
        return tuple(found[1:])

    @answer
    def principal_moments(self) -> Quantity:
        return principal_moments(self.inertia_tensor)

    @answer
    def principal_axes(self) -> Any:
        return principal_axes(self.principal_moments)

    @answer
    def principal_angle(self) -> Quantity:
        return principal_angle(self.inertia_tensor)

    @answer
    def perpendicular_axes(self) -> Quantity:
        across = self.body.flat_across
        if across is None:
            message = f"the perpendicular-axis theorem needs a flat body, but {self.told} is not flat"
            rejected("not-flat", message, None)
        first, second = (self.moment(axis) for axis in AXES if axis != across)
        return perpendicular_axes(first, second)

    # -- about another point or axis --------------------------------------------------------------------------------

    def about_direction(self, tensor: Quantity, **named: str) -> Quantity:
        direction = self.described.direction
        if direction is None:
            rejected("no-direction", "`moment_about` needs `direction`", None, "write `direction: [1, 1, 0]`")
        along = self.body.direction(direction.named) if direction.is_name else direction.components
        return moment_about(tensor, along, **named)

    def under_key(self, name: Word, own: str, key: str, letter: dict[str, str], tensor: Mapping[str, str]) -> Quantity:
        """Return an answer that an entry of `results:` asks for.

        name     the name of the answer, as it is written in the file
        own      the name of the answer without the name of the body
        key      the name of the entry, which becomes the key of the answer
        letter   the symbol of the result, if the author chose one
        tensor   the symbol and the key of the tensor, where needed
        """
        axis = own[-1]
        if own == "inertia_tensor":
            return inertia_tensor(self.body, self.about, **{"symbol": tensor["symbol"], **letter}, key=key)
        if own == "centre_of_mass":
            return centre_of_mass(self.body, self.described.origin, key=key, **letter)
        if own.startswith("moment_of_inertia_"):
            return moment_of_inertia(self.body, axis, self.about, **{"symbol": f"J_{axis}", **letter}, key=key)
        if own.startswith("radius_of_gyration_"):
            moment = moment_of_inertia(self.body, axis, self.about, f"J_{axis}", f"{key}_moment")
            return radius_of_gyration(moment, key=key, **letter)
        if own == "moment_about":
            return self.about_direction(inertia_tensor(self.body, self.about, **tensor), key=key, **letter)
        known = ("inertia_tensor", "centre_of_mass", "moment_about", "moment_of_inertia_z", "radius_of_gyration_z")
        help_line = f"write an answer such as {', '.join(f'`{each}`' for each in known)}"
        rejected("wrong-argument", f"`answer` cannot derive `{name}` for another point or axis", name.place, help_line)


class BodiesAnswers(StockAnswers[DescribedBodies]):
    """The quantities of one body or of several bodies."""

    what = "a body"

    def __init__(self, described: DescribedBodies):
        super().__init__(described)
        self.of = {one.prefix: BodyAnswers(one) for one in described.bodies}

    def asks(self) -> dict[str, Callable[[], Any]]:
        return {f"{prefix}{name}": asked for prefix, one in self.of.items() for name, asked in one.asks().items()}

    def solve(self, asked: Sequence[Word], drawings: Sequence[Placement] = ()) -> dict[str, object]:
        """Return the answers by the requested names, and draw each body."""
        for prefix, one in self.of.items():
            asks_centre = any(name.startswith(f"{prefix}centre_of_mass") for name in asked)
            at = "" if asks_centre else one.about
            is_named = one.about in one.described.described.points
            drawn_with = {drawing.key: drawing for drawing in drawings if drawing.shows}
            own = name_of_drawing(one.body)
            drawn(one, at, is_named, shown=drawn_with.pop(own).shows if own in drawn_with else ())
            for name, drawing in drawn_with.items() if len(self.of) == 1 else ():
                with told_at(drawing.place):
                    drawn(one, at, is_named, name, drawing.shows)
        bodies = {name_of_drawing(one.body) for one in self.of.values()}
        for drawing in drawings:
            if drawing.is_sketch and drawing.key not in bodies:
                sketched(drawing.key)
        return super().solve(asked, drawings)

    @property
    def elsewhere(self) -> Callable[..., Quantity]:
        return self._elsewhere

    def _elsewhere(
        self,
        wanted: Word,
        key: str,
        about: Word | None,
        origin: Word | None,
        direction: Axis | None,
        symbol: str | None,
    ) -> Quantity:
        """Return an answer about a point or axis other than the given one."""
        prefix = max((prefix for prefix in self.of if wanted.startswith(prefix)), key=len, default=None)
        if prefix is None:
            rejected("no-such-answer", f"`{wanted}` is not an answer about one of these bodies", wanted.place)
        own, asked = wanted.removeprefix(prefix), self.of[prefix].described
        given = {"about": about, "origin": origin, "direction": direction}
        for name in (name for name, value in given.items() if value is not None):
            if not own.startswith(DEPENDING[name]):
                rejected("unused-key", f"`{wanted}` does not depend on `{name}`", None, "leave it out")
        point = asked.described.point(about) if about else asked.about
        start = asked.described.point(origin) if origin else asked.origin
        there = BodyAnswers(replace(asked, about=point, origin=start, direction=direction or asked.direction))
        there.body = self.of[prefix].body
        another = "I" if point == "centre" else "J" if asked.about == "centre" else "K"
        tensor = {"symbol": another, "key": f"{key}_tensor"} if about or own == "inertia_tensor" else {}
        return there.under_key(wanted, own, key, {"symbol": str(symbol)} if symbol else {}, tensor)


STOCK = Stock(GivenBody, read, BodiesAnswers, SHOWS)
