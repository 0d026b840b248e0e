"""Objects that a description specifies, such as bodies and forces. Each object is made only when an answer needs it.

The verbs that make these objects check what moves and what is constant. Such checks need the record of the derivation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from derive.course.stock import told_at
from derive.errors import Complaint, Place, Rejected
from derive.mechanics.bodies.placed import PlacedBody, PointOfBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.acted_on import WrongPart

N = TypeVar("N")


@dataclass(frozen=True, repr=False)
class Deferred(Generic[N]):
    """An object that is made later.

    make    the class or the verb that makes the object
    of      the positional arguments of `make`
    named   the keyword arguments of `make`
    bodies  argument of `make` -> names of bodies or particles, or other words such as `ground`
    forces  the symbols of the constraint forces that the object introduces
    place   the place in the file where the object is described
    """

    make: Callable[..., N]
    of: tuple[Any, ...] = ()
    named: Mapping[str, Any] = field(default_factory=dict)
    bodies: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    place: Place | None = field(default=None, compare=False)
    forces: tuple[str, ...] = ()

    def made(self, known: Mapping[str, Any]) -> N:
        """Make the object; `known` has the bodies and particles of the system by name."""
        there = {argument: names for argument, names in self.bodies.items() if names}
        meant = {argument: [known.get(name, name) for name in names] for argument, names in there.items()}
        bodies = {argument: found[0] if len(found) == 1 else tuple(found) for argument, found in meant.items()}
        with told_at(self.place):
            of = [made(each, known) for each in self.of]
            return self.make(*of, **{name: made(each, known) for name, each in self.named.items()}, **bodies)

    def __repr__(self) -> str:
        """Return a text that is the same in each process, for the digest of a problem."""
        return f"{self.make.__qualname__}{(self.of, dict(self.named), dict(self.bodies))!r}"


@dataclass(frozen=True)
class Material:
    """A body or particle, or a point of a body, by its name.

    point   the point, by its name or by components along the body axes; None for the body or particle itself
    by      a displacement from this point or particle; None without a displacement
    """

    body: str
    point: Any = None
    by: Location | None = None

    def __add__(self, by: Location) -> Material:
        return Material(self.body, self.point, by if self.by is None else self.by + by)

    def made(self, known: Mapping[str, Any]) -> Any:
        if self.point is None and self.by is None:
            return known[self.body]
        if self.point is None:
            return PointOfBody((known[self.body].at + self.by).components, body=known[self.body])
        body = known[self.body]
        if not isinstance(body, PlacedBody):
            message = f"`{self.body}` is a particle, so it has no point `{self.point}`"
            raise Rejected(Complaint("no-such-point", message, help=f"write `{self.body}`"))
        found = body.place_of(self.point)
        if self.by is None:
            return found
        place = found + self.by
        return PointOfBody(place.components, body=body) if body.carries(self.by) else place


def made(given: Any, known: Mapping[str, Any]) -> Any:
    """Return an argument in which the made object replaces each deferred object."""
    if isinstance(given, tuple):
        return tuple(made(each, known) for each in given)
    return given.made(known) if isinstance(given, Deferred | Material) else given


@contextmanager
def told_at_part(described: Sequence[Deferred[Any]], made: Sequence[Any], otherwise: Place | None) -> Iterator[None]:
    """Report an error about a part at the place where the file describes it, and any other error at `otherwise`."""
    with told_at(otherwise):
        try:
            yield
        except WrongPart as error:
            pairs = zip(described, made, strict=True)
            with told_at(next((part.place for part, own in pairs if error.part in parts_of(own)), None)):
                raise


def parts_of(made: Any) -> tuple[Any, ...]:
    """Return the parts of a system that a described object yields."""
    return made if isinstance(made, tuple) else (made,)
