"""Surfaces, contacts, pulleys, wires, strings, massless rods, joints, motors and dashpots, as `given:` describes
them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.expressions import TIME, stand_in
from derive.course.expression import Declared
from derive.course.schema import (
    SCALAR,
    TEXT,
    YES_OR_NO,
    Reader,
    Record,
    key,
    list_of,
    mapping_of,
    one_of,
    read_record,
    record_of,
)
from derive.course.stock import InLetters
from derive.course.yaml_tree import Mapping as MappingNode
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import Faults, Place, did_you_mean, rejected
from derive.mechanics import (
    circle,
    contact,
    curve,
    dashpot,
    massless_rod,
    motor,
    pin,
    plane,
    pulley,
    string,
    weld,
    wire,
    wound_string,
)
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.contacts import point_of_contact
from derive.stock.keys.deferred import Deferred, Material
from derive.stock.keys.parts import (
    components_of,
    direction_of,
    force_letter,
    list_of_parts,
    named_bodies,
    one_or_list_of,
)
from derive.stock.keys.places import COMPONENTS, PLACE, Places, WrittenPlace, check_not_contact, point_called

X = "x"  # the symbol for the horizontal distance in the formula of a curve
SURFACE_SHAPES = (
    "give `through` with `along` or `normal` for a plane, `centre` and `radius` for a circle or sphere, "
    "or `y` for a curve"
)
RIGHT_OR_LEFT = one_of(("right", "left"))


@dataclass(frozen=True)
class Connected:
    """The objects to which connections may refer. `rolling` is the number of contacts whose rolling friction has no
    symbol."""

    bodies: Collection[str]
    surfaces: Mapping[str, Deferred[Any]]
    pulleys: Mapping[str, Deferred[Any]]
    places: Places
    letters: InLetters
    rolling: int


@dataclass(frozen=True)
class SurfaceKeys(Record):
    """The keys of one entry of `surfaces:`."""

    through: WrittenPlace | None = key(
        "for a plane, a place on it; for a curve, the place where x = y = 0. The default place for a curve is "
        "the particle, or the centre of the body, that `of` names; without `of`, the origin",
        PLACE,
    )
    along: tuple[Tree, ...] = key(
        "for a plane surface, if the motion is in a plane: a direction along the surface. The free side is to the left "
        "of this direction, so above `[1, 0]`",
        COMPONENTS,
    )
    normal: tuple[Tree, ...] = key(
        "for a plane surface, in place of `along`: the direction towards its free side", COMPONENTS
    )
    centre: WrittenPlace | None = key("for a circle or a sphere, its centre", PLACE)
    radius: Tree | None = key("for a circle or a sphere, its radius", SCALAR)
    y: Tree | None = key(
        "for a curve y = f(x), if the motion is in a plane: the formula f(x), such as `x**2/(2*b)`", SCALAR
    )
    side: str | None = key(
        "the side on which the bodies are: `outside` or `inside` of a circle or a sphere, `above` or `below` a curve; "
        "`both` for a rail or a wire, which the bodies cannot leave",
        one_of(("outside", "inside", "above", "below", "both")),
    )
    of: Word | None = key("the body or particle that carries the surface", TEXT)
    axes: Word | None = key("the axes in which the surface is at rest, as for a turntable", TEXT, called="in")
    velocity: tuple[Tree, ...] = key("the velocity of the surface, as for a belt", COMPONENTS)

    def part(self, name: Word, places: Places, letters: InLetters, bodies: Collection[str]) -> Deferred[Any]:
        named: dict[str, Any] = {"moves": self._motion(places, letters), "is_two_sided": self.side == "both"}
        carried = {"of": named_bodies("of", [self.of], bodies, "")}
        if self.of and named["moves"] is not None:
            rejected(
                "twice",
                f"`of` and `{'in' if self.axes is not None else 'velocity'}` both specify the motion of the surface",
                self.of.place,
                "leave one of them out",
            )
        if self.y is not None:
            return Deferred(curve, self._curve(self.y, places, letters), named, carried, self.places[""])
        if self.centre is not None and self.radius is not None and not (self.through or self.along or self.normal):
            self._check_side(("outside", "inside"))
            named["inside"] = self.side == "inside"
            of = (places.at(self.centre, "centre"), letters.value(self.radius, "radius", "length"))
            return Deferred(circle, of, named, carried, self.places[""])
        if self.through is not None and bool(self.along) != bool(self.normal) and not (self.centre or self.radius):
            self._check_side(())
            for role in ("along", "normal"):
                if nodes := getattr(self, role):
                    named[role] = direction_of(nodes, letters)
            return Deferred(plane, (places.at(self.through, "through"),), named, carried, self.places[""])
        rejected(
            "missing-key", f"the keys of the surface `{name}` do not specify its shape", self.places[""], SURFACE_SHAPES
        )

    def _check_side(self, allowed: Collection[str]) -> None:
        if self.side and self.side not in (*allowed, "both"):
            if allowed:
                message = f"this surface has no side `{self.side}`"
                rejected("unused-key", message, self.places["side"], f"write {' or '.join([*allowed, 'both'])}")
            message = f"a plane has no side `{self.side}`; its free side follows from `along` or `normal`"
            rejected("unused-key", message, self.places["side"], "leave it out")

    def _curve(self, written: Tree, places: Places, letters: InLetters) -> tuple[Any, ...]:
        for name in ("along", "normal", "centre", "radius"):
            if name in self.places:
                message = f"`{name}` does not belong to a curve `y`"
                rejected("unused-key", message, self.places[name], f"leave `{name}` or `y` out")
        if X in letters.letters and f"{X}_dot" not in letters.letters:
            message = f"in the formula of a curve, `{X}` is the horizontal distance, but `{X}` is under `symbols` too"
            rejected("letter-clash", message, self.places["y"], "give the symbol another name")
        self._check_side(("above", "below"))
        x = stand_in(X)
        formula = letters.also({X: Declared(X, x, "length")}).of_kind(written, "y", "length")
        through = places.at(self.through, "through") if self.through else None
        return x, formula, through, self.side == "below"

    def _motion(self, places: Places, letters: InLetters) -> Any:
        if self.axes is not None and self.velocity:
            message = "`in` and `velocity` both specify the motion of the surface"
            rejected("twice", message, self.places["velocity"], "leave one of them out")
        if self.axes is not None:
            return places.axes(self.axes)
        if self.velocity:
            return Location(tuple(c * TIME for c in components_of(self.velocity, "speed", letters)))
        return None


def _direction(node: Tree, name: str, faults: Faults) -> tuple[Tree, ...] | str | None:
    return RIGHT_OR_LEFT.read(node, name, faults) if isinstance(node, Scalar) else COMPONENTS.read(node, name, faults)


DIRECTION: Reader[Any] = Reader({"anyOf": [COMPONENTS.schema, RIGHT_OR_LEFT.schema]}, _direction)


@dataclass(frozen=True)
class FrictionKeys(Record):
    """The keys of `friction:` of a contact."""

    rolling: Word | None = key(
        "the symbol F of the friction that prevents slipping; in space it has two components, such as F_x and F_y", TEXT
    )
    sliding: Tree | None = key("the coefficient of sliding friction", SCALAR)
    direction: Any = key(
        "`[1, 0]`, `right` or `left`: with `sliding`, the direction in which the body slips; without `sliding`, the "
        "direction in which the friction on the body is positive. For sliding in space, leave `direction` out: the "
        "friction is opposite to the velocity of slip",
        DIRECTION,
    )
    static: Tree | None = key("the coefficient of static friction, if the body does not slip", SCALAR)
    force: Word | None = key("with `static`: the symbol of the friction", TEXT)

    @property
    def symbol(self) -> Word | None:
        """Return the symbol of the friction that prevents slipping; None if the author gives no symbol."""
        return self.rolling or self.force


def _friction(node: Tree, name: str, faults: Faults) -> FrictionKeys | str | None:
    if isinstance(node, MappingNode):
        return read_record(FrictionKeys, node, "friction", faults)
    return one_of(("none", "rolling")).read(node, name, faults)


FRICTION: Reader[Any] = Reader(
    {"anyOf": [one_of(("none", "rolling")).schema, record_of(FrictionKeys, "friction", "a mapping").schema]},
    _friction,
)


def _named_contact(name: str, **given: Any) -> tuple[Any, ...]:
    def with_name(part: Any) -> Any:
        limit = getattr(part, "limit", None)
        return replace(part, limit=replace(limit, slider=name)) if limit is not None else part

    return tuple(map(with_name, contact(**given)))


@dataclass(frozen=True)
class ContactKeys(Record):
    """The keys of one entry of `contacts:`, a body that touches a surface."""

    of: WrittenPlace = key(
        "the particle, round body or point of a body, such as `ladder.end`, that touches the surface; or the place of "
        "a fixed corner that touches a surface of a body",
        PLACE,
        required=True,
    )
    on: Word = key("the surface, or another round body", TEXT, required=True)
    normal: Word | None = key(
        "the symbol of the normal force; needed if the coordinates alone do not keep the body on the surface", TEXT
    )
    friction: Any = key(
        "`none`, `rolling`, `{rolling: F}` with the symbol of the friction, `{sliding: mu, direction: [1, 0]}`, or "
        "`{static: mu_s, force: F}`",
        FRICTION,
    )

    def symbols(self, axes: str) -> list[Word]:
        friction = self.friction.symbol if isinstance(self.friction, FrictionKeys) else None
        return [word for word in (self.normal, friction) if word is not None]

    def part(self, known: Connected) -> Deferred[Any]:
        named: dict[str, Any] = {"of": self._body(known), "on": self._surface(known)}
        if self.normal:
            named["normal"] = force_letter(self.normal, known.letters)
        own = self.friction
        if own == "rolling":
            named["rolling"] = True
            if known.rolling > 1:
                named["key"] = f"no_slip_{self._name()}_{self.on}".replace(" ", "_")
        elif isinstance(own, FrictionKeys):
            named |= self._friction(own, known)
        forces = tuple(map(str, [*self.symbols(known.places.axes_of_motion), *self._components(known)]))
        return Deferred(_named_contact, (self._name(),), named, forces=forces, place=self.places[""])

    def touched_by(self, known: Connected) -> tuple[str, Deferred[Any]] | None:
        """Return the name of the body that touches the surface, and its point of contact; None for a particle and for
        a fixed corner."""
        body = self._body(known)
        if not isinstance(body, Material) or body.body not in known.places.bodies:
            return None
        return body.body, Deferred(point_of_contact, (body, self._surface(known)), place=self.places[""])

    def _name(self) -> str:
        """Return the name of the body or place that touches the surface, `ladder` for `ladder.end`; empty for a place
        without a name."""
        return (self.of.name or "").partition(".")[0].replace("_", " ")

    def _components(self, known: Connected) -> list[Word]:
        """Return, in space, the symbols of the components of static or rolling friction; in a plane, the list is
        empty."""
        symbol = self.friction.symbol if isinstance(self.friction, FrictionKeys) else None
        if symbol is None or "z" not in known.places.axes_of_motion:
            return []
        components = [Word.at(f"{symbol}_{axis}", symbol.place) for axis in "xyz"]
        return [word for word in components if force_letter(word, known.letters)]

    def _friction(self, own: FrictionKeys, known: Connected) -> dict[str, Any]:
        given = [each for each in ("rolling", "sliding", "static") if each in own.values_at]
        if len(given) != 1:
            message = "`friction` needs exactly one of `rolling`, `sliding` and `static`"
            help_line = "with `{static: mu_s, force: F}` a round body rolls" if "static" in given else None
            rejected("missing-key", message, own.places[""], help_line)
        (sort,) = given
        if own.force is not None and sort != "static":
            message = "`force` is the symbol of the static friction, so it needs `static`"
            rejected("unused-key", message, own.places["force"], "leave it out")
        found: dict[str, Any] = {}
        if own.direction:
            written = own.direction
            found["direction"] = written if isinstance(written, str) else direction_of(written, known.letters)
        if own.rolling is not None:
            return {**found, "rolling": force_letter(own.rolling, known.letters)}
        if own.static is not None:
            if own.force is None:
                help_line = "give the symbol of the friction, `{static: mu_s, force: F}`"
                rejected("missing-key", "static friction needs the symbol of its force", own.places[""], help_line)
            coefficient = known.letters.of_kind(own.static, "static", "number")
            return {**found, "static": coefficient, "force": force_letter(own.force, known.letters)}
        assert own.sliding is not None
        return {**found, "sliding": known.letters.of_kind(own.sliding, "sliding", "number")}

    def _body(self, known: Connected) -> Any:
        name = self.of.name
        if name is not None and (name.partition(".")[0] in known.bodies or name not in known.places.written):
            return material(name, known)
        return _end(self.of, known, "of")

    def _surface(self, known: Connected) -> Any:
        if self.on in known.surfaces:
            return known.surfaces[str(self.on)]
        if self.on in known.bodies:
            return Material(str(self.on))
        names = [*known.surfaces, *known.bodies]
        help_line = did_you_mean(self.on, names) or "describe it under `surfaces`"
        rejected("no-such-surface", f"`{self.on}` is not a surface or a body of this system", self.on.place, help_line)


@dataclass(frozen=True)
class PulleyKeys(Record):
    """The keys of one entry of `pulleys:`, a massless frictionless pulley with a radius."""

    at: WrittenPlace = key("its centre", PLACE, required=True)
    radius: Tree = key("its radius", SCALAR, required=True)

    def part(self, name: Word, places: Places, letters: InLetters) -> Deferred[Any]:
        of = (places.at(self.at, "at"), letters.value(self.radius, "radius", "length"))
        return Deferred(pulley, of, place=self.places[""])


@dataclass(frozen=True)
class StringKeys(Record):
    """The keys of one entry of `strings:`, a massless inextensible string."""

    start: WrittenPlace | None = key("one end: a particle, a point of a body, or a place", PLACE, called="from")
    end: WrittenPlace | None = key("the other end", PLACE, called="to")
    wound_on: tuple[Word, ...] = key(
        "the round body on which the string is wound, or over which it runs without slipping; it replaces `to` and "
        "`length`. For a string that is wound on two round bodies: these bodies, `[upper, lower]`; they replace "
        "`from`, `to` and `length`",
        one_or_list_of(TEXT, "a body, or a list of two bodies"),
    )
    over: tuple[WrittenPlace, ...] = key(
        "the pulleys, places, particles or points of bodies over which the string runs, in order from `from` to `to`",
        list_of(PLACE, "a list of places"),
    )
    length: Tree | None = key(
        "the total length of the straight pieces of the string; a function of the time if the string is pulled in",
        SCALAR,
    )
    tension: Word | None = key(
        "the symbol of the tension; needed if the coordinates alone do not keep the length of the string constant",
        TEXT,
    )
    drawn_tension: Word | None = key(
        "the symbol of the tension in force diagrams, if the coordinates keep the length of the string constant, so "
        "that no equation contains the tension. With `mass_of`, this is the tension at the bends. The forces on the "
        "particles at the ends, on the movable pulleys and, with `mass_of`, on the pieces of the rope are then drawn",
        TEXT,
    )
    mass_of: Word | None = key(
        "for a uniform rope with mass: the particle that has this mass. Let this particle move horizontally with the "
        "speed of the rope: its weight then has no effect, and `gravity` acts on the pieces of the rope",
        TEXT,
    )

    def symbols(self, axes: str) -> list[Word]:
        return [self.tension] if self.tension is not None else []

    def part(self, known: Connected) -> Deferred[Any]:
        if self.wound_on:
            return self._wound(known)
        if self.start is None or self.end is None:
            rejected("missing-key", "a string needs `from` and `to`, or `wound_on`", self.places[""])
        over = tuple(_over(each, known) for each in self.over)
        ends = (_end(self.start, known, "from"), _end(self.end, known, "to"))
        more: dict[str, Any] = {"mass_of": material(self.mass_of, known)} if self.mass_of else {}
        if self.drawn_tension is not None:
            more["drawn_tension"] = force_letter(self.drawn_tension, known.letters)
        return _line(string, ends, self.length, "tension", self.tension, known, self.places[""], over=over, **more)

    def _wound(self, known: Connected) -> Deferred[Any]:
        for name in ("to", "length", "mass_of", "drawn_tension"):
            if name in self.values_at:
                message = f"`{name}` has no effect on a string with `wound_on`"
                rejected("unused-key", message, self.places[name], f"leave `{name}` or `wound_on` out")
        if self.tension is None:
            message = "a string with `wound_on` needs `tension`, the symbol of its tension"
            help_line = "if the coordinates already keep the string on the body, leave the string out"
            rejected("missing-key", message, self.places[""], help_line)
        if len(self.wound_on) + (self.start is not None) != 2:
            message = "a string with `wound_on` goes from one place to one round body, or between two round bodies"
            help_line = "write `from` and one body, or no `from` and two bodies"
            rejected("missing-key", message, self.places["wound_on"], help_line)
        tension = force_letter(self.tension, known.letters)
        start = _end(self.start, known, "from") if self.start is not None else None
        rims = tuple(material(each, known) for each in self.wound_on)
        over = tuple(_over(each, known) for each in self.over)
        of = (start, rims if start is None else rims[0])
        return Deferred(wound_string, of, {"tension": tension, "over": over}, forces=(tension,), place=self.places[""])


@dataclass(frozen=True)
class MasslessRodKeys(Record):
    """The keys of one entry of `massless_rods:`, a rigid rod that pulls or pushes along its direction."""

    start: WrittenPlace = key("one end: a particle, a point of a body, or a place", PLACE, called="from", required=True)
    end: WrittenPlace = key("the other end", PLACE, called="to", required=True)
    length: Tree | None = key("its length", SCALAR)
    force: Word | None = key(
        "the symbol of the force in the rod, positive in tension; needed if the coordinates alone do not keep the "
        "length constant",
        TEXT,
    )

    def symbols(self, axes: str) -> list[Word]:
        return [self.force] if self.force is not None else []

    def part(self, known: Connected) -> Deferred[Any]:
        ends = (_end(self.start, known, "from"), _end(self.end, known, "to"))
        return _line(massless_rod, ends, self.length, "force", self.force, known, self.places[""])


@dataclass(frozen=True)
class JointKeys(Record):
    """The keys of one entry of `joints:`, a hinge, a ball joint or a rigid joint."""

    of: WrittenPlace = key("a point of a body, or a particle", PLACE, required=True)
    to: WrittenPlace = key("a point of another body, a particle, or a place in space", PLACE, required=True)
    force: Word = key(
        "the symbol R of the force on the body that `of` names; its components are R_x and R_y, in space also R_z",
        TEXT,
        required=True,
    )
    torque: Word | None = key(
        "for a rigid joint in a plane: the symbol of the couple on the body that `of` names", TEXT
    )

    def symbols(self, axes: str) -> list[Word]:
        """Return the symbols of the components of the force along these axes, and the symbol of the couple."""
        components = [Word.at(f"{self.force}_{axis}", self.force.place) for axis in axes]
        return [*components, *([self.torque] if self.torque else [])]

    def part(self, known: Connected) -> Deferred[Any]:
        ends = (_end(self.of, known, "of"), _end(self.to, known, "to"))
        named, symbols = {"force": str(self.force)}, self.symbols(known.places.axes_of_motion)
        for word in symbols:
            force_letter(word, known.letters)
        if self.torque:
            named["torque"] = str(self.torque)
        forces = tuple(map(str, symbols))
        return Deferred(weld if self.torque else pin, ends, named, forces=forces, place=self.places[""])


@dataclass(frozen=True)
class MotorKeys(Record):
    """The keys of one entry of `motors:`, a prescribed rotation."""

    on: Tree = key("the angle that the motor prescribes", SCALAR, required=True)
    turns: Tree = key("the value of the angle at each time, such as `Omega*t`", SCALAR, required=True)
    torque: Word = key("the symbol of the torque of the motor", TEXT, required=True)

    def symbols(self, axes: str) -> list[Word]:
        return [self.torque]

    def part(self, known: Connected) -> Deferred[Any]:
        turns = known.letters.value(self.turns, "turns", "angle", in_time=True)
        of = (known.letters.of_kind(self.on, "on", "angle"), turns)
        torque = force_letter(self.torque, known.letters)
        return Deferred(motor, of, {"torque": torque}, forces=(torque,), place=self.places[""])


@dataclass(frozen=True)
class DashpotKeys(Record):
    """The keys of one entry of `dashpots:`, a damper between two points."""

    constant: Tree = key("its damping constant, the force per relative speed", SCALAR, required=True)
    start: WrittenPlace = key("one end", PLACE, called="from", required=True)
    end: WrittenPlace = key("the other end", PLACE, called="to", required=True)
    massless: bool = key("`true` if it may end at a massless joint, such as its joint with a spring", YES_OR_NO)

    def symbols(self, axes: str) -> list[Word]:
        return []

    def part(self, known: Connected) -> Deferred[Any]:
        constant = known.letters.value(self.constant, "constant", "damping constant")
        of = (constant, _end(self.start, known, "from"), _end(self.end, known, "to"))
        return Deferred(dashpot, of, {"massless": self.massless}, place=self.places[""])


def wire_on(name: Word, known: Connected) -> Deferred[Any]:
    """Return the wire on which the particle of this name is threaded."""
    return Deferred(wire, (material(name, known),), place=name.place)


def material(name: Word, known: Connected) -> Material:
    """Return the body, particle or point of a body that a name denotes."""
    body, _, point = name.partition(".")
    if body not in known.bodies:
        help_line = did_you_mean(body, known.bodies)
        rejected("no-such-body", f"`{body}` is not a body or particle of this system", name.place, help_line)
    if body in known.places.bodies:
        check_not_contact(name)
    return Material(body, point_called(point) if point else None)


def _line(
    make: Any,
    ends: tuple[Any, Any],
    length: Tree | None,
    name: str,
    force: Word | None,
    known: Connected,
    place: Place,
    **named: Any,
) -> Deferred[Any]:
    """Return a string or a massless rod; `name` is the argument of `make` for the symbol of its force."""
    if length is not None:
        named["length"] = known.letters.value(length, "length", "length", in_time=True)
    if force is not None:
        named[name] = force_letter(force, known.letters)
    return Deferred(make, ends, named, forces=(str(force),) if force is not None else (), place=place)


def _over(written: WrittenPlace, known: Connected) -> Any:
    """Return a pulley, or the body, particle or place that serves as a pulley without a radius."""
    if written.name is not None and written.name in known.pulleys:
        return known.pulleys[str(written.name)]
    places = [*known.pulleys, *known.places.written, *known.bodies]
    if written.name is not None and written.name.partition(".")[0] not in places:
        help_line = did_you_mean(written.name, places) or "describe it under `pulleys`, or write its components"
        rejected("no-such-place", f"`{written.name}` is not a pulley or a place", written.place, help_line)
    return _end(written, known, "over")


def _end(written: WrittenPlace, known: Connected, name: str) -> Any:
    """Return what is at one end of a connection: a body, a particle, a point of a body, or a place in space."""
    way = written.way
    if way is not None and way.start is not None and str(way.start) in known.places.carried and way.axes is None:
        by = known.places.at(WrittenPlace(None, replace(way, start=None), written.place), name)
        if isinstance(by, Location):
            return Material(str(way.start), None, by)  # a place that moves with a particle
    if written.name is not None and written.name.partition(".")[0] in known.bodies:
        if "." in written.name or written.name not in known.places.written:
            return material(written.name, known)
    return known.places.at(written, name)


SURFACES = mapping_of(record_of(SurfaceKeys, "a surface", "a mapping with `through` or `centre`", "the surface `{}`"))
CONTACTS = list_of_parts(ContactKeys, "a contact")
JOINTS, MOTORS = list_of_parts(JointKeys, "a joint"), list_of_parts(MotorKeys, "a motor")
DASHPOTS = list_of_parts(DashpotKeys, "a dashpot")
PULLEYS = mapping_of(record_of(PulleyKeys, "a pulley", "a mapping with `at` and `radius`", "the pulley `{}`"))
WIRES = list_of(TEXT, "a list of particles, `[bead]`")
STRINGS, MASSLESS_RODS = list_of_parts(StringKeys, "a string"), list_of_parts(MasslessRodKeys, "a massless rod")
