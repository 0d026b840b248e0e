"""Bodies that move, as `given:` describes them: their position, their orientation, their contact in rolling."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import partial
from typing import Any

from sympy import Expr

from derive.course.schema import SCALAR, TEXT, Record, as_written, key, list_of, mapping_of, one_of, record_of
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import Faults, rejected
from derive.mechanics import RigidBody, no_slip, rolling_constraint
from derive.mechanics.kinematics.places import Axes, Location
from derive.stock.keys.bodies import CENTRE_OF_MASS, Bodies, BodyKeys, DescribedBody
from derive.stock.keys.deferred import Deferred
from derive.stock.keys.parts import force_letter, list_of_parts
from derive.stock.keys.places import PLACE, Places, WrittenPlace, check_known

POINT = as_written(
    {"anyOf": [TEXT.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3}]},
    "a point of the body, by name or by components",
)


@dataclass(frozen=True)
class MovingBodyKeys(BodyKeys):
    """The keys of one entry of `bodies:`."""

    moments: Tree | None = key(
        "in place of a shape, its three principal moments of inertia, or in a plane the moment about the "
        "perpendicular axis; about the centre of mass, or with `middle` about the point that is held",
        as_written(
            {"anyOf": [SCALAR.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3, "maxItems": 3}]},
            "one moment or three",
        ),
    )
    middle: tuple[Tree, ...] = key(
        "with `moments`, the position of its centre of mass along its own axes", list_of(SCALAR, "components", length=3)
    )
    turned: Tree | None = key(
        "in a plane, its angle of rotation from right towards up; in space, the axes that rotate with the body", SCALAR
    )
    centre: WrittenPlace | None = key("the position of its centre of mass", PLACE)
    held: Tree | None = key("in place of `centre`, the point of the body that is held, by name or components", POINT)
    on: WrittenPlace | None = key("the place at which this point is held; by default the origin", PLACE)
    across: str | None = key(
        "in a plane, the axis of the body that is perpendicular to the plane", one_of(("x", "y", "z"))
    )

    def part(self, name: Word, alone: bool, places: Places, letters: InLetters) -> Deferred[Any]:
        called = "" if alone else str(name).replace("_", " ")
        if self.centre is None and self.held is None:
            rejected(
                "missing-key", "a body needs either `centre` or `held`, which specifies its position", self.places[""]
            )
        if self.centre is not None and self.held is not None:
            message = "a body has either `centre` or `held`, not both: each specifies its position"
            rejected("twice", message, self.places["held"], "leave one of them out")
        self._check_used()
        if self.turned is None:
            rejected("missing-key", "a body needs `turned`, which specifies its orientation", self.places[""])
        body: DescribedBody | RigidBody = (
            self._by_moments(called, letters) if self.moments else Bodies(letters).body(self, called)
        )
        turned = self._turned(self.turned, places, letters)
        named: dict[str, Any] = {"across": self.across}
        if self.centre is not None:
            return Deferred(placed, (body, turned, places.at(self.centre, "centre")), named, place=self.places[""])
        point = self._point(letters, body)
        named["on"] = places.at(self.on, "on") if self.on else None
        return Deferred(held, (body, turned, point), named, place=self.places[""])

    def _check_used(self) -> None:
        """Reject a key that has no effect together with the other keys."""
        own = {"moments", "middle", "mass", "turned", "centre", "held", "on", "across"}
        beside = {
            "moments": [name for name in self.values_at if name not in own],
            "centre": [name for name in ("on",) if name in self.values_at],
        }
        faults = Faults()
        for first, others in beside.items():
            for other in others if first in self.values_at else ():
                message = f"`{other}` has no effect on a body with `{first}`"
                faults.error("unused-key", message, self.places[other], help="leave one of them out")
        if "middle" in self.values_at and "moments" not in self.values_at:
            message = "`middle` has no effect on a body without `moments`"
            faults.error(
                "unused-key", message, self.places["middle"], help="the shape determines where the centre of mass is"
            )
        faults.stop()

    def _turned(self, turned: Tree, places: Places, letters: InLetters) -> Axes | Expr:
        if isinstance(turned, Scalar) and turned.text.strip() in {str(name) for name in places.turns}:
            return places.axes(turned.word)
        return letters.of_kind(turned, "turned", "angle")

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


@dataclass(frozen=True)
class RollingKeys(Record):
    """The keys of one entry of `rolling:`, a body that rolls without slipping."""

    body: Word = key("the body, by its name", TEXT, required=True)
    at: WrittenPlace = key("the place where it touches the surface", PLACE, required=True)
    ground: WrittenPlace | None = key(
        "a place of the surface, if the surface moves; or the axes in which it is at rest, as for a turntable", PLACE
    )
    force: Word | None = key("the symbol of the force that prevents slipping, if you need that force", TEXT)

    def part(self, places: Places, letters: InLetters, names: Collection[str]) -> Deferred[tuple[Any, ...]]:
        check_known(self.body, names, "body")
        named: dict[str, Any] = {"ground": _ground(self.ground, places) if self.ground else None}
        if self.force:
            named["force"] = force_letter(self.force, letters)
        bodies = {"body": (str(self.body),)}
        return Deferred(rolls, (), {"at": places.at(self.at, "at"), **named}, bodies, self.places[""])


def _ground(written: WrittenPlace, places: Places) -> Location | Axes:
    """Return a place of the surface, or the rotating axes in which the surface is at rest, as for a turntable."""
    way = written.way
    if written.name is not None and str(written.name) in {str(name) for name in places.turns}:
        return places.axes(written.name)
    if way is not None and way.axes is not None and way.start is None:
        places.at(written, "ground")
        return places.axes(way.axes)
    return places.at(written, "ground")


BODIES = mapping_of(record_of(MovingBodyKeys, "a body", "a mapping with `shape` or `moments`", "the body `{}`"))
ROLLING = list_of_parts(RollingKeys, "rolling")


def placed(body: DescribedBody | RigidBody, turned: Axes | Expr, centre: Location, across: str | None) -> Any:
    """Return the body with its centre of mass at a place."""
    return _made(body).placed(turned, centre, across=across)


def held(body: DescribedBody | RigidBody, turned: Axes | Expr, point: Any, on: Location | None, across: Any) -> Any:
    """Return the body with one of its points held at a place."""
    return _made(body).held(turned, point, on=on, across=across)


def _made(body: DescribedBody | RigidBody) -> Any:
    return body.body() if isinstance(body, DescribedBody) else body


def rolls(body: Any, at: Location, ground: Any, force: str = "") -> tuple[Any, ...]:
    """Return the conditions of rolling: with `force`, as constraints that this force enforces; otherwise, solved for
    coordinates or rates."""
    if force:
        return rolling_constraint(body, at, force, ground)
    found = no_slip(body, at, ground)
    return found if isinstance(found, tuple) else (found,)
