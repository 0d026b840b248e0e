"""Bodies that move, as `given:` describes them: their position and their orientation."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from sympy import Expr, pi

from derive.algebra.tidy import tidied
from derive.course.schema import (
    SCALAR,
    TEXT,
    Record,
    as_written,
    key,
    list_of,
    mapping_of,
    one_of,
    record_of,
)
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import Faults, rejected
from derive.mechanics import RigidBody
from derive.mechanics.kinematics.places import Axes, Location, angle_of
from derive.mechanics.model.surfaces import dot, unit
from derive.steps.step import is_zero
from derive.stock.keys.bodies import CENTRE_OF_MASS, Bodies, BodyKeys, DescribedBody, QuotedKeys
from derive.stock.keys.deferred import Deferred
from derive.stock.keys.parts import direction_of
from derive.stock.keys.places import COMPONENTS, PLACE, Places, WrittenPlace

POINT = as_written(
    {"anyOf": [TEXT.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3}]},
    "a point of the body, by name or by components",
)


@dataclass(frozen=True)
class RimKeys(Record):
    """The keys of `rim:` of a body."""

    centre: WrittenPlace = key("its centre, a place that moves with the body", PLACE, required=True)
    radius: Tree = key("its radius", SCALAR, required=True)


@dataclass(frozen=True)
class MovingBodyKeys(BodyKeys, QuotedKeys):
    """The keys of one entry of `bodies:`."""

    moments: Tree | None = key(
        "in place of a shape: its three principal moments of inertia or, in a plane, its moment about the axis "
        "perpendicular to the plane. The moments are about the centre of mass or, with `middle`, about the point that "
        "is held",
        as_written(
            {"anyOf": [SCALAR.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3, "maxItems": 3}]},
            "one moment or three",
        ),
    )
    middle: tuple[Tree, ...] = key(
        "with `moments`: the position of the centre of mass, measured along the axes of the body from their origin, "
        "the fixed point",
        list_of(SCALAR, "components", length=3),
    )
    rim: RimKeys | None = key(
        "with `moments`, in a plane: the circular boundary with which the body touches surfaces",
        record_of(RimKeys, "rim", "a mapping with `centre` and `radius`"),
    )
    turned: Tree | None = key(
        "in a plane, its angle of rotation, positive counterclockwise; in space, the axes that rotate with the body",
        SCALAR,
        instead_of="axes",
    )
    centre: WrittenPlace | None = key("the position of its centre of mass", PLACE, instead_of="at")
    held: Tree | None = key("in place of `centre`, the point of the body that is held, by name or components", POINT)
    on: WrittenPlace | None = key("with `held`, the place at which that point is held; by default the origin", PLACE)
    start: WrittenPlace | None = key(
        "for a rod, the place of its point `end`; it replaces `held: end` and `on`", PLACE, called="from"
    )
    to: WrittenPlace | None = key("for a rod with `from`: the place of its other end, in place of `turned`", PLACE)
    along: tuple[Tree, ...] = key(
        "for a rod, the direction from its point `end` to its other end, in place of `turned`: "
        "`[sin(theta), -cos(theta)]`",
        COMPONENTS,
    )
    across: str | None = key(
        "in a plane, the axis of the body that is perpendicular to the plane", one_of(("x", "y", "z"))
    )

    def part(self, name: Word, alone: bool, places: Places, letters: InLetters) -> Deferred[Any]:
        called = "" if alone else str(name).replace("_", " ")
        self._check_one("position", "centre", "held", "from")
        self._check_one("orientation", "turned", "along", "to")
        self._check_used()
        body: DescribedBody | RigidBody = (
            self._by_moments(called, letters)
            if self.moments
            else replace(Bodies(letters).body(self, called), is_integrated=self.is_integrated)
        )
        turned = self._turned(places, letters)
        named: dict[str, Any] = {"across": self.across}
        if self.rim is not None:
            radius = letters.value(self.rim.radius, "radius", "length")
            named["rim"] = (places.at(self.rim.centre, "centre"), radius)
        if self.start is not None:
            named["on"] = places.at(self.start, "from")
            return Deferred(held, (body, turned, "end"), named, place=self.places[""])
        if self.centre is not None:
            return Deferred(placed, (body, turned, places.at(self.centre, "centre")), named, place=self.places[""])
        point = self._point(letters, body)
        named["on"] = places.at(self.on, "on") if self.on else None
        return Deferred(held, (body, turned, point), named, place=self.places[""])

    def _check_used(self) -> None:
        own = {"moments", "middle", "rim", "mass", "turned", "centre", "held", "on", "across", "from", "to", "along"}
        beside = {
            "moments": [name for name in self.values_at if name not in own],
            "centre": [name for name in ("on",) if name in self.values_at],
            "from": [name for name in ("on",) if name in self.values_at],
        }
        faults = Faults()
        for first, others in beside.items():
            for other in others if first in self.values_at else ():
                message = f"`{other}` has no effect on a body with `{first}`"
                faults.error("unused-key", message, self.places[other], help=f"leave `{first}` or `{other}` out")
        for name, what in (("middle", "where the centre of mass is"), ("rim", "its boundary")):
            if name in self.values_at and "moments" not in self.values_at:
                message = f"`{name}` has no effect on a body without `moments`"
                faults.error("unused-key", message, self.places[name], help=f"the shape determines {what}")
        self.check_integrated(faults)
        faults.stop()

    def _check_one(self, what: str, *names: str) -> None:
        """Require exactly one of these keys."""
        given = [name for name in names if name in self.values_at]
        listed = f"`{names[0]}`, `{names[1]}` or `{names[2]}`"
        if not given:
            rejected("missing-key", f"a body needs {listed}, which specifies its {what}", self.places[""])
        if len(given) > 1:
            message = f"a body can have only one of {listed}: each specifies its {what}"
            rejected("twice", message, self.places[given[1]], "keep only one of them")

    def _turned(self, places: Places, letters: InLetters) -> Axes | Expr:
        if self.turned is None:
            return self._turned_along(places, letters)
        turned = self.turned
        if isinstance(turned, Scalar) and turned.text.strip() in {str(name) for name in places.turns}:
            return places.axes(turned.word)
        return letters.of_kind(turned, "turned", "angle")

    def _turned_along(self, places: Places, letters: InLetters) -> Expr:
        """Compute the angle of rotation of a rod from its direction. At zero angle the rod points upwards."""
        name = "along" if self.along else "to"
        if self.shape != "rod":
            message = f"`{name}` gives the direction of a rod, but this body is not a rod"
            rejected("unused-key", message, self.places[name], "give `turned`")
        way = direction_of(self.along, letters) if self.along else self._way(places, letters)
        with told_at(self.places[name]):
            angle = angle_of(unit("a rod", way)) if len(way.components) == 2 else None
        if angle is None:
            message = "this direction does not determine an angle of rotation, so the orientation of the rod is unknown"
            help_line = "give the direction by sines and cosines of one angle: `along: [sin(theta), -cos(theta)]`"
            rejected("wrong-argument", message, self.places[name], help_line)
        return angle - pi / 2

    def _way(self, places: Places, letters: InLetters) -> Location:
        if self.start is None:
            rejected("missing-key", "a rod with `to` also needs `from`", self.places["to"])
        assert self.to is not None
        ends = places.ends(self.start, self.to)
        start, end = (each if isinstance(each, Location) else None for each in ends)
        if start is None or end is None:
            message = "the direction from or to a point of another body is unknown here"
            rejected("wrong-argument", message, self.places["to"], "give the direction as `along`")
        length = letters.constant(self.length, "length", "length") if self.length is not None else None
        if length is not None and not is_zero(tidied(dot(end - start, end - start)) - length**2):
            message = f"the places `from` and `to` are not at the distance {length}, the length of the rod"
            rejected("sizes", message, self.places["to"])
        return end - start

    def _by_moments(self, called: str, letters: InLetters) -> RigidBody:
        if self.mass is None:
            rejected("missing-key", "a body specified by its moments needs `mass`", self.places[""])
        nodes = self.moments.items if isinstance(self.moments, Sequence) else (self.moments,)
        kind = "moment of inertia"
        moments = tuple(each([partial(letters.value, node, "moments", kind) for node in nodes if node]))
        mass = letters.value(self.mass, "mass", "mass")
        middle = tuple(each([partial(letters.constant, node, "middle", "length") for node in self.middle]))
        with told_at(self.places[""]):
            known: dict[str, Any] = {"centre": middle} if middle else {}
            about = "fixed_point" if middle else "centre_of_mass"
            body = RigidBody(mass, moments if len(moments) == 3 else moments[0], about=about, **known)
            return body.named(called) if called else body

    def _point(self, letters: InLetters, body: DescribedBody | RigidBody) -> Any:
        if isinstance(self.held, Scalar):
            if isinstance(body, DescribedBody):
                return body.point(self.held.word)
            name = self.held.text.strip().replace("_", " ")
            return "centre" if name == CENTRE_OF_MASS else name.replace(" ", "_")
        assert isinstance(self.held, Sequence)
        return tuple(each([partial(letters.constant, node, "held", "length") for node in self.held.items]))


BODIES = mapping_of(record_of(MovingBodyKeys, "a body", "a mapping with `shape` or `moments`", "the body `{}`"))


def placed(
    body: DescribedBody | RigidBody,
    turned: Axes | Expr,
    centre: Location,
    across: str | None,
    rim: tuple[Location, Expr] | None = None,
) -> Any:
    """Return the body with its centre of mass at a place."""
    found = _made(body).placed(turned, centre, across=across)
    return found if rim is None else found.with_rim(*rim)


def held(
    body: DescribedBody | RigidBody,
    turned: Axes | Expr,
    point: Any,
    on: Location | None,
    across: Any,
    rim: tuple[Location, Expr] | None = None,
) -> Any:
    """Return the body with one of its points held at a place."""
    found = _made(body).held(turned, point, on=on, across=across)
    return found if rim is None else found.with_rim(*rim)


def _made(body: DescribedBody | RigidBody) -> Any:
    return body.body() if isinstance(body, DescribedBody) else body
