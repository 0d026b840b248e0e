"""Coordinates, rotating axes and places, as `given:` describes them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import partial

from sympy import Expr

from derive.algebra.expressions import TIME, rate, scalar
from derive.algebra.kinds import KINDS
from derive.algebra.ranges import POSITIVE, Range
from derive.course.declarations import read_range
from derive.course.expression import RESERVED, Declared
from derive.course.problem_file import SortOfLetter, schema_of_sorts, sort_of_letter
from derive.course.schema import (
    SCALAR,
    TEXT,
    Reader,
    Record,
    key,
    list_of,
    mapping_of,
    object_schema,
    read_record,
    wrong_type,
)
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Mapping as MappingNode
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import Complaint, Faults, Place, Rejected, did_you_mean, rejected
from derive.mechanics import X, Y, Z, point, space
from derive.mechanics.bodies.placed import PointOfBody
from derive.mechanics.kinematics.coordinates import function_of_time, kind_of_rate
from derive.mechanics.kinematics.places import Axes, Location
from derive.stock.keys.deferred import Deferred, Material
from derive.stock.keys.formulas import OfKnownDimension

ANGLE, LENGTH, CHARGE = "angle", "length", "charge"
CONTACT = "contact"  # the point of a body that touches a surface: `ball.contact`


def _sort(node: Tree, name: str, faults: Faults) -> SortOfLetter:
    return sort_of_letter(node, name, faults, (ANGLE, LENGTH, CHARGE))


COORDINATES = mapping_of(Reader(schema_of_sorts((ANGLE, LENGTH, CHARGE)), _sort))
FUNCTIONS = mapping_of(Reader(schema_of_sorts(KINDS), sort_of_letter))
COMPONENTS = list_of(SCALAR, "a list of components, `[x, y]` in a vertical plane or `[x, y, z]`")
TURNS = mapping_of(list_of(mapping_of(SCALAR), "a list of rotations, such as `[{z: phi}, {x: theta}]`"))
AXIS_OF = {"x": X, "y": Y, "z": Z}


@dataclass(frozen=True)
class WayKeys(Record):
    """The keys of a place that is specified by a displacement from another place."""

    start: Word | None = key("the place where the displacement starts; by default the origin", TEXT, called="from")
    by: tuple[Tree, ...] = key("the components of the displacement", COMPONENTS, required=True)
    axes: Word | None = key("the rotating axes of these components, by their name under `axes`", TEXT, called="in")


@dataclass(frozen=True)
class WrittenPlace:
    """A place as it is written in the file: its components, the displacement to it, or its name."""

    name: Word | None
    way: WayKeys | None
    place: Place = field(repr=False, compare=False)


_PLACE_IS = "a list of components, `{from: A, by: [x, y]}`, or the name of a place"


def _place(node: Tree, name: str, faults: Faults) -> WrittenPlace | None:
    if isinstance(node, MappingNode):
        return WrittenPlace(None, read_record(WayKeys, node, "a place", faults), node.place)
    if isinstance(node, Sequence):
        by = COMPONENTS.read(node, name, faults)
        return WrittenPlace(None, WayKeys({}, {}, by=by or ()), node.place)
    if isinstance(node, Scalar) and not node.empty:
        return WrittenPlace(node.word, None, node.place)
    wrong_type(faults, f"`{name}`", _PLACE_IS, node)
    return None


_PLACE_SCHEMA = {
    "anyOf": [
        TEXT.schema,
        {"type": "array", "items": SCALAR.schema, "minItems": 2, "maxItems": 3},
        object_schema(WayKeys),
    ]
}
PLACE: Reader[WrittenPlace] = Reader(_PLACE_SCHEMA, _place)
PLACES = mapping_of(PLACE)


def is_letter(name: str) -> bool:
    """Return whether a description may introduce this name as a symbol."""
    is_name = name.isascii() and name.replace("_", "").isalnum() and name[0].isalpha()
    return is_name and name not in RESERVED and name != TIME.name


def check_known(name: Word, known: Collection[str], what: str) -> None:
    """Reject a name that is not among the known names of this kind, such as the coordinates of a system."""
    if name not in known:
        code = "no-such-body" if what == "body" else "no-such-coordinate"
        rejected(code, f"`{name}` is not a {what} of this system", name.place, did_you_mean(name, known))


def coordinate_letters(
    written: Mapping[Word, SortOfLetter], symbols: Mapping[str, Declared], faults: Faults
) -> dict[str, Declared]:
    """Return each coordinate, its rate and its acceleration: theta, theta_dot, theta_ddot."""
    found: dict[str, Declared] = {}
    for name, sort in written.items():
        if _may_be_named(name, symbols, "coordinate", faults):
            kind = str(sort)
            lies = _range(str(name), sort, faults)
            positive = lies is not None and lies.is_above_zero and kind == LENGTH
            q = scalar(str(name), positive=True) if positive else scalar(str(name))
            faster = kind_of_rate(kind)
            found[str(name)] = Declared(str(name), q, kind, None if positive and lies == POSITIVE else lies)
            found[f"{name}_dot"] = Declared(f"{name}_dot", rate(q), faster)
            found[f"{name}_ddot"] = Declared(f"{name}_ddot", rate(q, 2), kind_of_rate(faster))
    return found


def function_letters(
    written: Mapping[Word, SortOfLetter],
    symbols: Mapping[str, Declared],
    coordinates: Mapping[str, Declared],
    faults: Faults,
) -> dict[str, Declared]:
    """Return each prescribed function of the time and its first two rates: X, X_dot, X_ddot."""
    found: dict[str, Declared] = {}
    for name, sort in written.items():
        if name in coordinates:
            message = f"`{name}` is a coordinate, so it cannot be a prescribed function of the time too"
            faults.error("letter-clash", message, name.place, help="remove it from `coordinates` or from `functions`")
        elif _may_be_named(name, symbols, "function of the time", faults):
            lies = _range(str(name), sort, faults)
            function = function_of_time(str(name), str(sort), positive=lies is not None and lies.is_above_zero)
            found[str(name)] = Declared(str(name), function, str(sort), None if lies == POSITIVE else lies)
            for order in (1, 2):
                its_rate = function.rate(order)
                found[its_rate.name] = OfKnownDimension(its_rate.name, its_rate, "", has=its_rate.dimension)
    return found


def _may_be_named(name: Word, symbols: Mapping[str, Declared], what: str, faults: Faults) -> bool:
    """Return whether a name may become a symbol; report a name that may not."""
    if name in symbols:
        message = f"`{name}` is declared under `symbols`, but is also a {what}"
        faults.error("letter-clash", message, name.place, help="remove it from `symbols`")
    elif not is_letter(name):
        faults.error("symbol", f"`{name}` is not a valid symbol for a {what}", name.place)
    return name not in symbols and is_letter(name)


def _range(name: str, sort: SortOfLetter, faults: Faults) -> Range | None:
    with faults:
        if sort.ends:
            return read_range(name, sort.ends, sort, signed=not sort.positive)
    return POSITIVE if sort.positive else None


def point_called(name: str) -> str:
    """Return the name of a point within its body: `centre` for `centre_of_mass`."""
    return "centre" if name == "centre_of_mass" else name


def check_not_contact(name: Word) -> None:
    """Reject the point of contact of a body, at which only a force or a drag may act."""
    if name.endswith(f".{CONTACT}"):
        message = f"nothing can be fastened at `{name}`, because other particles of the body touch the surface later"
        help_line = "only `at` of a force or of drag may name this point; a string that unwinds is `wound_on` the body"
        rejected("no-such-point", message, name.place, help_line)


class Places:
    """The named places and axes of a description, each computed when it is needed."""

    def __init__(
        self,
        written: Mapping[Word, WrittenPlace],
        turns: Mapping[Word, tuple[Mapping[Word, Tree], ...]],
        letters: InLetters,
        carried: Mapping[Word, WrittenPlace | None] | None = None,
        bodies: Collection[str] = (),
    ):
        """The name of a particle also denotes the place of the particle, and the name of a body denotes its centre of
        mass. `rod.end` denotes a point of the body `rod`."""
        self.carried = {str(name): at for name, at in (carried or {}).items() if at is not None and at.name != name}
        self.written = {str(name): place for name, place in written.items()}
        self.turns = turns
        self.letters = letters
        self.bodies = {str(name) for name in bodies}
        self.contacts: dict[str, list[Deferred[PointOfBody]]] = {}  # for each body, its points of contact
        self.on_the_way: list[str] = []
        self.first: tuple[int, str] | None = None  # number of components of the first place, and its name

    @property
    def axes_of_motion(self) -> str:
        """The axes along which a force has components."""
        return "xyz"[: self.first[0]] if self.first else "xyz"

    def all_named(self) -> dict[str, Location | Material]:
        return dict(each([partial(self._with_name, Word.at(n, w.place)) for n, w in self.written.items()]))

    def _with_name(self, name: Word) -> tuple[str, Location | Material]:
        return str(name), self.named(name)

    def named(self, name: Word) -> Location | Material:
        written = self.written.get(name) or self.carried.get(name)
        body, _, point = name.partition(".")
        if written is None and body in self.bodies:
            check_not_contact(name)
            return Material(body, point_called(point or "centre"))
        if written is None and point and body in self.carried:
            message = f"`{body}` is a particle, so it has no point `{point}`"
            rejected("no-such-point", message, name.place, f"write `{body}`")
        if written is None:
            known = [*self.written, *self.carried, *self.bodies]
            help_line = did_you_mean(name, known) or "give it under `places`, or write its components"
            rejected("no-such-place", f"`{name}` is not a named place", name.place, help_line)
        if name in self.on_the_way:
            rejected("circle", f"the position of `{name}` depends on `{name}` itself", written.place)
        self.on_the_way.append(name)
        try:
            return self.at(written, name)
        finally:
            self.on_the_way.pop()

    def at(self, written: WrittenPlace, name: str) -> Location | Material:
        """Return a place that is written in the file; errors call it `name`."""
        if written.name is not None:
            return self.named(written.name)
        assert written.way is not None
        way = written.way
        components = each([partial(self._component, node, name) for node in way.by])
        with told_at(written.place):
            found = self.axes(way.axes).place(*components) if way.axes else point(*components)
            self._check_size(found, name)
            return self.named(way.start) + found if way.start else found

    def acted_on(self, written: WrittenPlace) -> Location | Material | Deferred[PointOfBody]:
        """Return the place of a force or a drag. `ball.contact` is the particle of the body `ball` that touches a
        surface."""
        body, _, point = (written.name or "").partition(".")
        if body not in self.bodies or point != CONTACT:
            return self.at(written, "at")
        found = self.contacts.get(body, [])
        if len(found) != 1:
            count = "several contacts" if found else "no contact"
            message = f"{count} of this system name `{body}` under `of`, so `{written.name}` is not one point"
            message = message if found else message.replace(" name ", " names ")
            help_line = "give the components of the place under `at`, and the body under `of`"
            rejected("no-such-point", message, written.place, help_line)
        return found[0]

    def ends(self, start: WrittenPlace, end: WrittenPlace) -> list[Location | Material]:
        """Return the two places between which something acts."""
        return each([partial(self.at, start, "from"), partial(self.at, end, "to")])

    def axes(self, name: Word) -> Axes:
        turns = next((turns for known, turns in self.turns.items() if known == name), None)
        if turns is None:
            help_line = did_you_mean(name, self.turns) or "give them under `axes`"
            rejected("no-such-axes", f"`{name}` is not the name of axes", name.place, help_line)
        axes = space
        for about, node in (pair for turn in turns for pair in turn.items()):
            if about not in AXIS_OF:
                rejected("no-such-axis", f"axes can rotate about x, y or z, not about `{about}`", about.place)
            angle = self.letters.of_kind(node, f"an angle of {name}", "angle")
            with told_at(about.place):
                axes = axes.turned(AXIS_OF[about], angle)
        return axes

    def _component(self, node: Tree, name: str) -> Expr:
        return self.letters.of_kind(node, f"a component of {name}", "length")

    def _check_size(self, found: Location, name: str) -> None:
        size = len(found.components)
        first, by = self.first = self.first or (size, name)
        if size != first:
            message = f"`{name}` has {size} components, but `{by}` has {first}"
            raise Rejected(Complaint("wrong-length", message, help="give all places in a plane, or all in space"))
