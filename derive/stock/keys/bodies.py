"""Bodies as `given:` describes them: by a named shape and its sizes, by a formula for the positions of their points, or
by parts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cache, partial
from typing import Any, get_args, get_type_hints

from sympy import Expr, Integer

import derive.mechanics
from derive.algebra.expressions import TIME, scalar
from derive.course.expression import RESERVED, Declared, read_expression
from derive.course.schema import SCALAR, TEXT, YES_OR_NO, Reader, Record, key, list_of, mapping_of, record_of
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import Faults, Place, Rejected, did_you_mean, rejected
from derive.mechanics import Composite, PointMass, Sheet, Solid, Triangle, Wedge, Wire, minus
from derive.mechanics.bodies.body import DENSITIES, Body
from derive.mechanics.bodies.parts import PlacedPart
from derive.mechanics.rotation.inertia import QUOTED_SHAPES

SEVERAL = "a list of lengths"
CENTRE_OF_MASS = "centre of mass"
PLACE = list_of(SCALAR, "its components, `[x, y]` or `[x, y, z]`")
CORNERS = list_of(PLACE, "a list of places, such as `[[0, 0], [a, 0], [0, b]]`")
ENDS = list_of(SCALAR, "its lower and its upper limit, `[0, R]`", length=2)

# field of a class -> its key in YAML, where the names differ
CALLED_IN_YAML = {"corners_at": "corners", "face": "corners"}
# a triangle may also be specified by its base and height, or by one side
TRIANGLES: tuple[tuple[str, ...], ...] = (("corners",), ("base", "height", "foot"), ("side",))
OPTIONAL = frozenset({"foot"})
ANGLES = frozenset({"half_angle"})
MAPS = {1: Wire, 2: Sheet, 3: Solid}  # number of variables in `position` -> class of the body
OTHER_NAMES = {
    "block": "cuboid",
    "box": "cuboid",
    "cube": "cuboid",
    "circle": "hoop",
    "ring": "hoop",
    "rectangle": "plate",
    "point": "particle",
    "sphere": "ball",
    "hollow_ball": "thick_shell",
    "hollow_cylinder": "tube",
    "prism": "wedge",
    "wire": "arc",
}


@cache
def shapes() -> dict[str, type[Body]]:
    """Return the classes of bodies, by the names of their shapes in YAML, such as `thick_shell`."""
    offered = (getattr(derive.mechanics, name) for name in dir(derive.mechanics))
    bodies = (each for each in offered if isinstance(each, type) and issubclass(each, Body) and is_dataclass(each))
    return {body.id: body for body in bodies}


def _shape_name(written: str) -> str:
    return written.strip().replace("-", "_").replace(" ", "_")


def ways_to_tell(shape: type[Body]) -> tuple[tuple[str, ...], ...]:
    """Return each set of sizes that specifies a shape, by the names of the sizes in YAML."""
    own = tuple(CALLED_IN_YAML.get(f.name, f.name) for f in fields(shape) if f.name != "mass")  # type: ignore[arg-type]
    if "corners" not in own or shape.filling == "volume" and shape is not Wedge:
        return (own,)
    rest = tuple(name for name in own if name != "corners")
    return tuple((*way, *rest) for way in TRIANGLES)


@dataclass(frozen=True)
class ShapeKeys(Record):
    """The keys that specify a body by a shape with its sizes, or by the positions of its points."""

    shape: Word | None = key(
        "its shape: `disc`, `cone`, `thick_shell`, ...", Reader({"enum": sorted(shapes())}, TEXT.read)
    )
    mass: Tree | None = key("its mass", SCALAR)
    radius: Tree | None = key("its radius; for a torus, from its centre to the middle of the cross-section", SCALAR)
    inner: Tree | None = key("its inner radius", SCALAR)
    outer: Tree | None = key("its outer radius", SCALAR)
    section: Tree | None = key("the radius of the cross-section of a torus", SCALAR)
    height: Tree | None = key("its height", SCALAR)
    length: Tree | None = key("its length", SCALAR)
    half_angle: Tree | None = key("half the angle that an arc spans", SCALAR)
    sides: tuple[Tree, ...] = key("its edges along x, y and, for a cuboid, z", list_of(SCALAR, SEVERAL))
    semi_axes: tuple[Tree, ...] = key("the semi-axes of an ellipsoid along x, y and z", list_of(SCALAR, SEVERAL))
    corners: tuple[tuple[Tree, ...], ...] = key(
        "the positions of the corners of a triangle, a tetrahedron or the triangular face of a wedge", CORNERS
    )
    base: Tree | None = key("the base of a triangle, along x", SCALAR)
    foot: Tree | None = key(
        "the x coordinate of the apex of a triangle, measured from the left end of its base; by default half the base",
        SCALAR,
    )
    side: Tree | None = key("the side of an equilateral triangle", SCALAR)
    position: tuple[Tree, ...] = key(
        "the positions of the points of any body: formulas in the symbols of `limits`", PLACE
    )
    limits: Mapping[Word, tuple[Tree, ...]] = key(
        "the symbols of `position`, each between two limits, the outermost first: `{r: [0, R], phi: [0, 2*pi]}`",
        mapping_of(ENDS),
    )
    density: Tree | None = key("its density; with `mass`, a formula to which the density is proportional", SCALAR)


@dataclass(frozen=True)
class QuotedKeys(ShapeKeys):
    """The keys of a body whose moment of inertia may be quoted."""

    is_integrated: bool = key(
        "whether the page integrates a standard moment of inertia (such as the moment of a disc) and does not quote it",
        YES_OR_NO,
        called="derive",
    )

    def check_integrated(self, faults: Faults) -> None:
        """Reject `derive` for a body whose moment of inertia is never quoted."""
        if self.is_integrated and (self.shape is None or _shape_name(self.shape) not in QUOTED_SHAPES):
            message = "`derive` has no effect: a moment of inertia of this body is never quoted"
            faults.error("unused-key", message, self.places["derive"], help="leave it out")


@dataclass(frozen=True)
class PartKeys(QuotedKeys):
    """The keys of a part of a body."""

    at: tuple[Tree, ...] = key("the position of its centre of mass or, with `of`, of the point that `of` names", PLACE)
    of: Word | None = key("the point of the part whose position is `at`: `end`, `corner`, `base`", TEXT)
    turned: Mapping[Word, Tree] = key("the angles by which it is rotated: `{x: pi/2}`", mapping_of(SCALAR))
    cut_out: bool = key("whether it is cut out of the rest", YES_OR_NO)


@dataclass(frozen=True)
class BodyKeys(ShapeKeys):
    """The keys of a body."""

    parts: Mapping[Word, PartKeys] = key(
        "its parts, by name", mapping_of(record_of(PartKeys, "a part", "a mapping with `shape`"))
    )
    points: Mapping[Word, tuple[Tree, ...]] = key(
        "named points of the body, with their positions: `{pivot: [0, 0, a]}`", mapping_of(PLACE)
    )


BODY = record_of(BodyKeys, "a body", "a mapping with `shape`, `position` or `parts`")
SIZES = tuple(
    f.name for f in fields(ShapeKeys) if f.metadata and f.name not in ("shape", "mass", "position", "limits", "density")
)


@dataclass(frozen=True)
class DescribedBody:
    """A body of a description.

    parts    one body, or several bodies in their positions
    mass     the mass of a body with parts, if it is given for the whole body
    points   name of a point of the body -> its position
    is_integrated   whether a standard moment of inertia is integrated instead of being quoted
    """

    called: str
    parts: tuple[Body | PlacedPart, ...]
    is_made_of_parts: bool
    mass: Expr | None = None
    points: Mapping[str, tuple[Expr, ...]] = field(default_factory=dict)
    is_integrated: bool = False
    place: Place | None = field(default=None, repr=False, compare=False)

    def body(self) -> Body:
        """Return the body; errors are reported where the body is described."""
        with told_at(self.place):
            for part in self.parts:  # checked again, because the values of the symbols are known now
                body: Body = part.body if isinstance(part, PlacedPart) else part
                if is_dataclass(type(body)):
                    body.check_sizes()
            if self.is_made_of_parts or self.points:
                whole: Body = Composite(*self.parts, mass=self.mass, points=self.points)
            else:
                (whole,) = self.parts  # type: ignore[assignment]
            whole = whole.integrated() if self.is_integrated else whole
            return whole.named(self.called) if self.called else whole

    @property
    def other_centre(self) -> str:
        """Return a point, other than the centre of mass, that `centre` could mean; empty if there is none."""
        only: Any = self.parts[0]
        own: str = "" if self.is_made_of_parts else only.other_centre
        return Composite.other_centre if self.is_made_of_parts or own and self.points else own

    @property
    def point_names(self) -> tuple[str, ...]:
        if self.is_made_of_parts or self.points:
            return ("centre", "origin", *self.points)
        (only,) = self.parts
        assert isinstance(only, Body)
        return tuple(dict.fromkeys(("centre", *only.points())))

    def point(self, name: Word) -> str:
        """Return the point that a name denotes; underscores count as spaces."""
        known_names = {known.replace("_", " "): known for known in self.point_names}
        found = (known_names | {CENTRE_OF_MASS: "centre"}).get(name.replace("_", " "))
        if found == "centre" and name == found and self.other_centre:
            message = f"`centre` of {self.told} could be `centre_of_mass` or `{self.other_centre}`"
            rejected("unclear-point", message, name.place, "write the point that you mean")
        if found is None:
            names = ["centre_of_mass", *(known for known in self.point_names if known != "centre")]
            help_line = did_you_mean(name, names) or f"its points are {', '.join(names)}"
            rejected("no-such-point", f"{self.told} has no point `{name}`", name.place, help_line)
        return found

    @property
    def told(self) -> str:
        if self.called:
            return f"the {self.called}"
        only = self.parts[0]
        return "this body" if self.is_made_of_parts or not isinstance(only, Body) else only.name


class Bodies:
    """Reads bodies whose expressions use the symbols of a description."""

    def __init__(self, letters: InLetters):
        self.letters = letters

    def body(self, written: BodyKeys, called: str = "") -> DescribedBody:
        place = written.places[""]
        _one_of_three(written, {"shape", "position", "parts"}, "a body")
        if not written.parts:
            points = self._points(written)
            return DescribedBody(called, (self._alone(written, None),), False, None, points, place=place)
        for size in (name for name in (*SIZES, "density", "limits") if name in written.values_at):
            message = f"a body made of parts has no `{size}` of its own"
            rejected("unknown-key", message, written.places[size], "give it for one of its parts")
        mass = self.letters.value(written.mass, "mass", "mass") if written.mass else None
        named = [Word.at(name, name.place) for name in written.parts]
        parts = each([partial(self._part, name, written.parts[name], mass, len(named) > 1) for name in named])
        return DescribedBody(called, tuple(parts), True, mass, self._points(written), place=place)

    def _points(self, written: BodyKeys) -> dict[str, tuple[Expr, ...]]:
        names = list(written.points)
        for name in names:
            if name in ("centre", "origin"):
                rejected("duplicate-key", f"a body with `points` already has a point `{name}`", name.place)
        found = each([partial(self.place, written.points[name], f"the point {name}") for name in names])
        return {str(name): place for name, place in zip(names, found, strict=True)}

    def place(self, components: Sequence[Tree], name: str) -> tuple[Expr, ...]:
        return tuple(
            each([partial(self.letters.constant, node, f"a component of {name}", "length") for node in components])
        )

    def _part(self, name: Word, written: PartKeys, whole_mass: Expr | None, has_others: bool) -> Body | PlacedPart:
        _one_of_three(written, {"shape", "position"}, "a part")
        faults = Faults()
        written.check_integrated(faults)
        faults.stop()
        if whole_mass is not None and written.mass is not None:
            message = f"the mass of the whole body is divided among its parts, so `mass` of `{name}` is not allowed"
            rejected("unknown-key", message, written.places["mass"], "leave `mass` out, here or for the whole body")
        body = self._alone(written, whole_mass)
        with told_at(name.place):
            part: Any = body if isinstance(body, PointMass) else body.named(str(name))
            part = part.integrated() if written.is_integrated else part
        if written.at:
            of = _point_of(body, written.of) if written.of else "centre"
            place = self.place(written.at, str(name))
            with told_at(written.places["at"]):
                part = part.at(*place, of=of)
        elif written.of:
            rejected(
                "missing-key", f"`{name}` has `of`, so it needs `at`, the position of that point", written.of.place
            )
        for axis, node in written.turned.items():
            angle = self.letters.constant(node, f"the angle of {name}", "angle")
            with told_at(axis.place):
                part = part.turned(str(axis), angle)
        with told_at(name.place):
            return minus(part) if written.cut_out else part

    def _alone(self, written: ShapeKeys, whole_mass: Expr | None) -> Body:
        return self._shape(written, whole_mass) if written.shape else self._map(written)

    # -- shapes ---------------------------------------------------------------------------------------------------

    def _shape(self, written: ShapeKeys, whole_mass: Expr | None) -> Body:
        assert written.shape is not None
        name = _shape_name(written.shape)
        shape = shapes().get(name)
        if shape is None:
            meant = OTHER_NAMES.get(name)
            help_line = f"write `{meant}`" if meant else did_you_mean(name, shapes())
            message = f"`{written.shape}` is not a known shape"
            rejected(
                "no-such-shape", message, written.shape.place, help_line or f"the shapes are {', '.join(shapes())}"
            )
        faults = Faults()
        way = _way_that_is_told(shape, written, whole_mass is not None, faults)
        readings: list[Callable[[], Any]] = [partial(self._size, shape, size, written) for size in way]
        if whole_mass is None and written.mass is not None:
            readings.append(partial(self.letters.value, written.mass, "mass", "mass"))
        found: list[Any] = []
        with faults:
            found = each(readings)
        faults.stop()
        mass = found.pop() if whole_mass is None else whole_mass
        sizes = dict(zip(way, found, strict=True))
        with told_at(written.shape.place):
            return _made(shape, sizes, mass)

    def _size(self, shape: type[Body], name: str, written: ShapeKeys) -> Any:
        node = getattr(written, name)
        kind = "angle" if name in ANGLES else "length"
        if name == "corners":
            count, at = (3, 2) if shape in (Triangle, Wedge) else (4, 3)
            if len(node) != count or any(len(corner) != at for corner in node):
                message = f"{shape.name} needs {count} corners with {at} components each"
                rejected("wrong-length", message, written.places[name])
            return tuple(each([partial(self.place, corner, "a corner") for corner in node]))
        if isinstance(node, tuple):
            wanted = len(get_args(get_type_hints(shape)[name]))
            if len(node) != wanted:
                message = f"{shape.name} needs {wanted} lengths as `{name}`, not {len(node)}"
                rejected("wrong-length", message, written.places[name])
            return tuple(each([partial(self.letters.value, item, f"each of {name}", kind) for item in node]))
        read = self.letters.constant if name == "foot" else self.letters.value
        return read(node, name, kind)

    # -- position maps --------------------------------------------------------------------------------------------

    def _map(self, written: ShapeKeys) -> Body:
        for size in (name for name in SIZES if name in written.values_at):
            message = f"a body specified by `position` has no `{size}`"
            rejected("unknown-key", message, written.places[size], "`limits` determine its size")
        if len(written.limits) not in MAPS:
            message = f"`position` needs one, two or three symbols with limits, not {len(written.limits)}"
            place = written.places.get("limits", written.places["position"])
            rejected("wrong-length", message, place, "write `limits: {r: [0, R], phi: [0, 2*pi]}`")
        if written.mass is None and written.density is None:
            rejected("missing-key", "a body specified by `position` needs `mass` or `density`", written.places[""])
        known, limits = self._limits(written.limits)
        shape = MAPS[len(limits)]
        _, kind = DENSITIES[shape.filling]
        mass = self.letters.value(written.mass, "mass", "mass") if written.mass else None
        position = Bodies(known).place(written.position, "`position`")
        density = None
        if written.density is not None:
            density = known.any(written.density) if mass is not None else known.value(written.density, "density", kind)
        with told_at(written.places["position"]):
            return shape(position, limits, mass=mass, density=density)

    def _limits(self, written: Mapping[Word, tuple[Tree, ...]]) -> tuple[WithVariables, dict[Any, tuple[Expr, Expr]]]:
        """Read the limits of each variable; the limits may contain earlier variables."""
        known = WithVariables(self.letters, {})
        limits: dict[Any, tuple[Expr, Expr]] = {}
        for name, ends in written.items():
            if name in self.letters.letters and name != TIME.name:
                message = f"`{name}` is declared under `symbols`, but is also a variable of this body"
                rejected("letter-clash", message, name.place, "remove it from `symbols`")
            if name in RESERVED or name == TIME.name or not name.replace("_", "").isalnum() or not name[0].isalpha():
                rejected("symbol", f"`{name}` is not a valid symbol for a variable of `position`", name.place)
            kind, (lower, upper) = known.ends(name, ends)
            if (upper - lower).is_nonpositive:
                message = f"the limits of `{name}` are {lower} and {upper}, but the first must be less than the second"
                rejected("limits", message, name.place, "write two different limits, the lower one first")
            letter = scalar(str(name))
            limits[letter] = (lower, upper)
            known = WithVariables(self.letters, {**known.variables, str(name): Declared(str(name), letter, kind)})
        return known, limits


class WithVariables(InLetters):
    """The symbols of a description, and the variables in the `position` of a body."""

    def __init__(self, others: InLetters, variables: Mapping[str, Declared]):
        self.variables = variables
        self.letters = {**others.letters, **variables}
        self.numbers = others.numbers

    def ends(self, name: Word, written: Sequence[Tree]) -> tuple[str, tuple[Expr, Expr]]:
        """Return the kind of a variable, a length or an angle, and its limits."""
        refused: Rejected | None = None
        for kind in ("length", "angle"):
            try:
                lower, upper = each([partial(self.constant, end, f"a limit of {name}", kind) for end in written])
            except Rejected as error:
                if any(complaint.code != "wrong-kind" for complaint in error.complaints):
                    raise
                refused = refused or error
            else:
                return kind, (lower, upper)
        raise Rejected(refused.complaints if refused else ())

    def any(self, node: Tree) -> Expr:
        """Return the expression to which a density is proportional; this expression may have any dimension."""
        if not isinstance(node, Scalar):
            return self.value(node, "density", "density")
        found, _ = read_expression(node, self.letters)
        return found


def _one_of_three(written: ShapeKeys, ways: set[str], what: str) -> None:
    told = [name for name in ("shape", "position", "parts") if name in ways and getattr(written, name)]
    if not told:
        ways_told = " or ".join(f"`{name}`" for name in ("shape", "position", "parts") if name in ways)
        rejected("missing-key", f"{what} needs {ways_told}", written.places[""])
    if len(told) > 1:
        message = f"{what} needs either `{told[0]}` or `{told[1]}`, not both"
        rejected("unknown-key", message, written.places[told[1]])


def _point_of(body: Body, name: Word) -> str:
    return DescribedBody("", (body,), False).point(name)


def _way_that_is_told(shape: type[Body], written: ShapeKeys, has_mass: bool, faults: Faults) -> tuple[str, ...]:
    """Return the sizes that specify a shape; report missing and wrong keys."""
    ways = ways_to_tell(shape)
    given = [size for size in SIZES if size in written.values_at and size in ShapeKeys.__dataclass_fields__]
    way = max(ways, key=lambda w: (sum(s in given for s in w), -len(w)))
    if len(ways) > 1 and not set(given) & set().union(*ways):
        way = ways[0]
    sizes = ", ".join(f"`{size}`" for size in way)
    for size in given:
        if size not in way:
            help_line = f"its sizes are {sizes}" if way else "it has no sizes"
            faults.error("unknown-key", f"{shape.name} has no `{size}`", written.places[size], help=help_line)
    for size in way:
        if size not in given and size not in OPTIONAL:
            message = f"{shape.name} needs `{size}`"
            faults.error("missing-key", message, written.places["shape"], help=f"its sizes are {sizes}")
    if written.density is not None or "limits" in written.values_at:
        odd = "density" if written.density is not None else "limits"
        message = f"{shape.name} is a uniform body of fixed shape, so the key `{odd}` is not allowed"
        faults.error("unknown-key", message, written.places[odd], help="describe any other body by `position`")
    if written.mass is None and not has_mass:
        faults.error("missing-key", f"{shape.name} needs `mass`", written.places["shape"])
    return tuple(size for size in way if size in given)


def _made(shape: type[Body], sizes: dict[str, Any], mass: Expr) -> Body:
    made: Any = shape
    if shape in (Triangle, Wedge):
        face_mass = mass
        if "corners" in sizes:
            face = Triangle(sizes["corners"], face_mass)
        elif "side" in sizes:
            face = Triangle.equilateral(sizes["side"], face_mass)
        else:
            face = Triangle.on_base(sizes["base"], sizes["height"], face_mass, sizes.get("foot"))
        return face if shape is Triangle else Wedge(face, sizes["length"], mass)
    named = {f.name: sizes[CALLED_IN_YAML.get(f.name, f.name)] for f in fields(made) if f.name != "mass"}
    found: Body = made(**named, mass=mass + Integer(0))
    return found
