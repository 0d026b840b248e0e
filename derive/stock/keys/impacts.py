"""Events at one instant: impulses and collisions, as `given:` describes them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from typing import Any

from sympy import Expr, Integer

from derive.algebra.expressions import scalar
from derive.course.expression import Declared
from derive.course.schema import SCALAR, TEXT, Record, as_written, key, mapping_of, one_or_more, record_of
from derive.course.stock import InLetters, each
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.course.yaml_tree import Sequence as Listed
from derive.errors import Place, rejected
from derive.mechanics import angular_impulse, collision, impulse
from derive.mechanics.impacts.impact import Collision, Impulse
from derive.mechanics.kinematics.coordinates import kind_of_rate
from derive.mechanics.model.material import MASSLESS
from derive.stock.keys.deferred import Deferred
from derive.stock.keys.parts import components_of, list_of_parts, named_bodies
from derive.stock.keys.places import COMPONENTS, PLACE, Places, WrittenPlace, check_known, is_letter

RATE = "_dot"


@dataclass(frozen=True)
class ImpulseKeys(Record):
    """The keys of one entry of `impulses:`, an impulse at a place, or an angular impulse that changes the rate of an
    angle."""

    components: tuple[Tree, ...] = key("its components in space", COMPONENTS)
    at: WrittenPlace | None = key("the place where it acts", PLACE)
    of: Word | None = key("the body or particle on which the impulse acts, if `at` does not move with it", TEXT)
    angular: Tree | None = key("in place of `components` and `at`, an angular impulse", SCALAR)
    on: Tree | None = key("the angle whose rate the angular impulse changes", SCALAR)

    def act(self, places: Places, letters: InLetters, bodies: Collection[str]) -> Deferred[Impulse]:
        if self.components and self.at and not (self.angular or self.on):
            of = (components_of(self.components, "momentum", letters), places.at(self.at, "at"))
            named = {"of": named_bodies("of", [self.of], bodies, MASSLESS)}
            return Deferred(impulse, of, bodies=named, place=self.places[""])
        if self.angular and self.on and not (self.components or self.at):
            amount = letters.of_kind(self.angular, "angular", "angular momentum")
            return Deferred(angular_impulse, (amount, letters.of_kind(self.on, "on", "angle")), place=self.places[""])
        rejected("missing-key", "an impulse needs `components` and `at`, or `angular` and `on`", self.places[""])


@dataclass(frozen=True)
class CollisionKeys(Record):
    """The keys of one entry of `collisions:`."""

    start: WrittenPlace | None = key("one of the places that meet", PLACE, called="from")
    end: WrittenPlace | None = key("the other place", PLACE, called="to")
    at: WrittenPlace | None = key("in place of `from` and `to`, the place that hits an object at rest", PLACE)
    of: Tree | None = key(
        "the bodies or particles that meet, needed if a place does not move with the body that meets there: "
        "`of: [ball, rod]` for `from` and `to`, or one name for `at`",
        as_written(one_or_more(TEXT.schema), "a body, or a list of two"),
    )
    along: tuple[Tree, ...] = key(
        "components of a vector along the common normal, the line of the impulse; without `along`, the two bodies stay "
        "together",
        COMPONENTS,
    )
    restitution: Tree | None = key(
        "with `along`, the speed of separation over the speed of approach: 1 if the collision is elastic", SCALAR
    )
    letter: Word | None = key(
        "the symbol of the impulse, by default `K`; without `along`, its components are `K_x`, `K_y` and, in space, "
        "`K_z`",
        TEXT,
        called="impulse",
    )

    def act(self, places: Places, letters: InLetters, bodies: Collection[str]) -> Deferred[Collision]:
        if (self.at is None) == (self.start is None and self.end is None) or (self.start is None) != (self.end is None):
            rejected("missing-key", "a collision needs `from` and `to`, or `at`", self.places[""])
        if self.along and self.restitution is None:
            help_line = "write `restitution: 1` if the collision is elastic, 0 if the bodies do not separate"
            rejected("missing-key", "a collision along a normal needs its `restitution`", self.places[""], help_line)
        if self.restitution is not None and not self.along:
            message = "`restitution` has no effect without `along`: after such a collision the two bodies stay together"
            rejected(
                "unused-key", message, self.places["restitution"], "give `along`, the components of the common normal"
            )
        ends = [(self.start, "from"), (self.end, "to"), (self.at, "at")]
        read: list[Callable[[], Any]] = [partial(places.at, place, name) for place, name in ends if place]
        read += [partial(letters.of_kind, node, "a component", "number") for node in self.along]
        if self.restitution:
            read.append(partial(letters.of_kind, self.restitution, "restitution", "number"))
        found = each(read)
        part = found.pop() if self.restitution else Integer(0)
        start = found.pop(0) if self.start else None
        end, *along = found
        of = (start, end, tuple(along), part, self.name)
        return Deferred(collision, of, bodies={"of": self._bodies(bodies)}, place=self.places[""])

    def _bodies(self, bodies: Collection[str]) -> tuple[str, ...]:
        written = self.of.items if isinstance(self.of, Listed) else [self.of] if self.of is not None else []
        names = [name.word for name in written if isinstance(name, Scalar)]
        count = 2 if self.start is not None else 1
        if names and len(names) != count:
            wanted = "two names, for `from` and for `to`" if count == 2 else "one name"
            rejected("wrong-length", f"`of` needs {wanted}, not {len(names)}", self.places["of"])
        return named_bodies("of", names, bodies, MASSLESS)

    @property
    def name(self) -> str:
        return str(self.letter or "K")

    def brings(self, letters: InLetters, axes: str) -> list[str]:
        """Return the symbols of the impulse of this collision."""
        if self.letter is not None and not is_letter(self.letter):
            rejected(
                "symbol",
                f"`{self.letter}` is not a valid symbol for an impulse",
                self.letter.place,
                "write `impulse: K`",
            )
        place = self.letter.place if self.letter is not None else self.places[""]
        names = [self.name] if self.along else [f"{self.name}_{axis}" for axis in axes]
        help_line = "leave it out of `symbols`, or give the impulse another symbol, `impulse: K`"
        return [letters.unused(Word.at(name, place), help_line) for name in names]


@dataclass(frozen=True)
class ImpactKeys(Record):
    """The keys of `impact:`, for events at one instant."""

    at: Mapping[Word, Tree] = key("the values of coordinates at that instant: `{theta: 0}`", mapping_of(SCALAR))
    before: Mapping[Word, Tree] = key(
        "rates just before the impact; rates that are not given are zero: `{x_dot: v}`", mapping_of(SCALAR)
    )
    impulses: Sequence[ImpulseKeys] = key("given impulses", list_of_parts(ImpulseKeys, "an impulse"))
    collisions: Sequence[CollisionKeys] = key("places that collide", list_of_parts(CollisionKeys, "a collision"))

    def read(
        self,
        coordinates: Mapping[str, Declared],
        forces: Mapping[str, Declared],
        bodies: Collection[str],
        places: Places,
        letters: InLetters,
    ) -> DescribedImpact:
        """Read the impact; its values become expressions in symbols."""
        both: list[ImpulseKeys | CollisionKeys] = [*self.impulses, *self.collisions]
        if not both:
            rejected("missing-key", "`impact` needs `impulses` or `collisions`", self.places[""])
        values = [(q, node, ending) for ending, of in (("", self.at), (RATE, self.before)) for q, node in of.items()]
        found: list[Any] = each(
            [
                *(partial(one.act, places, letters, bodies) for one in both),
                *(partial(_value, q, node, ending, coordinates, letters) for q, node, ending in values),
            ]
        )
        acts, at, before = (
            tuple(found[slice(*ends)]) for ends in pairwise((0, len(both), len(both) + len(self.at), len(found)))
        )
        brought: list[str] = []
        for one in self.collisions:
            brought += one.brings(letters, places.axes_of_motion)
        brought += [letters.unused(Word.at(f"J_{force}", self.places[""]), "use another symbol") for force in forces]
        return DescribedImpact(
            acts=acts,
            at=at,
            before=before,
            letters={name: Declared(name, scalar(name), "momentum") for name in brought},
            place=self.places[""],
        )


def _value(
    name: Word, node: Tree, ending: str, coordinates: Mapping[str, Declared], letters: InLetters
) -> tuple[str, Expr]:
    """Return the name of a coordinate with its value or, if `ending` is `_dot`, with its rate."""
    q = str(name).removesuffix(ending)
    known = [f"{each}{ending}" for each in coordinates if f"{each}_ddot" in coordinates]
    check_known(name, known, "rate" if ending else "coordinate")
    kind = coordinates[q].kind
    return q, letters.of_kind(node, str(name), kind_of_rate(kind) if ending else kind)


@dataclass(frozen=True)
class DescribedImpact:
    """A described impact; `letters` are the symbols of the impulses of collisions and of constraint forces."""

    acts: tuple[Deferred[Impulse | Collision], ...]
    at: tuple[tuple[str, Expr], ...]
    before: tuple[tuple[str, Expr], ...]
    letters: Mapping[str, Declared] = field(default_factory=dict)
    place: Place | None = field(default=None, repr=False, compare=False)


IMPACT = record_of(ImpactKeys, "an impact", "a mapping with `impulses` or `collisions`")
