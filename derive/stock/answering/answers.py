"""Answers of a description: quantities under the names by which parts ask for them, each derived once.

    class BallAnswers(Answers[Ball]):
        @answer
        def weight(self) -> Quantity: ...

        @answer_for_each("velocity_{}", lambda self: AXES)
        def velocity(self, axis: str) -> Quantity: ...

A part may ask for `weight`, `velocity_x`, ...; other answers use `self.weight` and `self.velocity("x")`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, partial
from typing import Any, ClassVar, Generic, TypeVar

from derive.course.stock import Described
from derive.course.yaml_tree import Word
from derive.errors import DeriveError
from derive.mechanics import Coordinate
from derive.steps.step import Quantity
from derive.stock.answering.by_name import ByName

T = TypeVar("T")
D = TypeVar("D")
W = TypeVar("W", bound=Described)


class answer(cached_property[T]):
    """An answer with the name of the property."""


class ForEach(Generic[T]):
    """Answers with one name for each coordinate, axis or symbol.

    pattern   their names, with `{}` for the coordinate, axis or symbol
    each      returns these of the answers of a description
    method    derives one of them
    """

    def __init__(self, pattern: str, each: Callable[[Any], Iterable[str]], method: Callable[[Any, str], T]):
        self.pattern, self.each, self.method = pattern, each, method

    def __get__(self, answers: Answers[Any], owner: type) -> Callable[[str], T]:
        return partial(self.of, answers)

    def of(self, answers: Answers[Any], one: str) -> T:
        found: dict[str, T] = answers.found
        name = self.pattern.format(one)
        if name not in found:
            found[name] = self.method(answers, one)
        return found[name]

    def asks(self, answers: Answers[Any]) -> dict[str, Callable[[], T]]:
        return {self.pattern.format(one): partial(self.of, answers, one) for one in self.each(answers)}


def answer_for_each(
    pattern: str, each: Callable[[Any], Iterable[str]]
) -> Callable[[Callable[[Any, str], T]], ForEach[T]]:
    """Make a method the answers of all names of that pattern."""
    return partial(ForEach, pattern, each)


class Answers(Generic[D]):
    """The answers of one thing: a system, a body, a rotation, an impact; `found` are those with one name for each."""

    def __init__(self, described: D):
        self.described = described
        self.found: dict[str, Any] = {}

    def asks(self) -> dict[str, Callable[[], Any]]:
        """Return every name that a part may ask for, in the order of the class."""
        asks: dict[str, Callable[[], Any]] = {}
        for name, own in vars(type(self)).items():
            if isinstance(own, answer):
                asks[name] = partial(getattr, self, name)
            elif isinstance(own, ForEach):
                asks |= own.asks(self)
        return asks


class StockAnswers(Answers[W]):
    """The answers of a whole description, and results computed from them.

    what          the kind of description, in an error: "a rotation"
    coordinates   those of a system, by name
    """

    what: ClassVar[str] = ""
    coordinates: Mapping[str, Coordinate]

    def __init__(self, described: W):
        super().__init__(described)
        self.coordinates = {}

    @cached_property
    def by_name(self) -> ByName:
        again = lambda: type(self)(self.described).by_name  # noqa: E731
        return ByName(self.asks(), self.what, self.described.results, self.coordinates, again, self.elsewhere)

    @property
    def elsewhere(self) -> Callable[..., Quantity] | None:
        """Return what derives an answer of a body about another point or axis, if there is a body."""
        return None

    def solve(self, asked: Sequence[Word]) -> dict[str, object]:
        """Return the answers by the names that parts ask for, and draw what is described."""
        return self.by_name.answers(asked)

    def every(self) -> dict[str, tuple[Quantity, ...] | DeriveError]:
        """Return every answer that parts may ask for, or why it cannot be derived."""
        return self.by_name.every()
