"""Answers of a description: quantities with the names that parts ask for. Each quantity is derived once.

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

from sympy import ImmutableDenseMatrix, MatrixBase

from derive.course.placement import Placement
from derive.course.stock import Described, InLetters, each
from derive.course.yaml_tree import Sequence as SequenceNode
from derive.course.yaml_tree import Tree, Word
from derive.errors import DeriveError, rejected
from derive.mechanics import Coordinate
from derive.steps.derivation import returned_quantities
from derive.steps.step import Quantity
from derive.stock.answering.by_name import ByName
from derive.stock.answering.marks import Marked
from derive.stock.answering.plots import Plotted

T = TypeVar("T")
D = TypeVar("D")
W = TypeVar("W", bound=Described)


class answer(cached_property[T]):
    """Decorate a method that derives an answer; the name of the method is the name of the answer."""


class ForEach(Generic[T]):
    """Answers with one name for each coordinate, axis or symbol.

    pattern   the names, with `{}` in place of the coordinate, axis or symbol
    each      a function that returns the coordinates, axes or symbols
    method    a function that derives the answer for one coordinate, axis or symbol
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
    """Decorate a method that derives one answer for each coordinate, axis or symbol."""
    return partial(ForEach, pattern, each)


class Answers(Generic[D]):
    """The answers about one system, body, rotation or impact.

    `found` has, by name, the answers of methods with `answer_for_each` that have already been derived.
    """

    def __init__(self, described: D):
        self.described = described
        self.found: dict[str, Any] = {}

    def asks(self) -> dict[str, Callable[[], Any]]:
        """Return the functions that derive the answers, by the names that a part may ask for."""
        asks: dict[str, Callable[[], Any]] = {}
        for name, own in vars(type(self)).items():
            if isinstance(own, answer):
                asks[name] = partial(getattr, self, name)
            elif isinstance(own, ForEach):
                asks |= own.asks(self)
        return asks


class StockAnswers(Answers[W]):
    """The answers of a whole description, and results computed from them.

    what          the kind of description, for errors: "a rotation"
    coordinates   the coordinates of a system, by name
    """

    what: ClassVar[str] = ""
    coordinates: Mapping[str, Coordinate]

    def __init__(self, described: W):
        super().__init__(described)
        self.coordinates = {}

    @cached_property
    def by_name(self) -> ByName:
        again = lambda: type(self)(self.described).by_name  # noqa: E731
        given = self.described.results, self.coordinates, again, self.elsewhere, self.surfaces
        return ByName(self.asks(), self.what, *given)

    @property
    def surfaces(self) -> Mapping[str, Any]:
        return {}

    @property
    def drawn_surfaces(self) -> Mapping[str, Any]:
        """Return the surfaces that the plot of a path may show, by name."""
        return self.surfaces

    @property
    def elsewhere(self) -> Callable[..., Quantity] | None:
        """Return the function that derives an answer about another point or axis of a body, or None."""
        return None

    def solve(self, asked: Sequence[Word], drawings: Sequence[Placement] = ()) -> dict[str, object]:
        """Return the answers by the requested names, and draw the requested plots."""
        found = self.by_name.answers(asked)
        shown = {quantity.key for quantity in returned_quantities(found)} if found else set[str]()
        for drawing in drawings:
            plotted = Plotted(drawing, self.by_name.named, self.coordinates, lambda: self.drawn_surfaces, shown)
            if drawing.is_portrait:
                plotted.draw_levels()
                plotted.measure()
            elif drawing.is_of_engine and drawing.against and drawing.range:
                plotted.draw(drawing.against, drawing.range)
                plotted.measure()
        return found

    def mark(self, drawings: Sequence[Placement]) -> None:
        """Add the marks of the problem to the drawings, and make the drawings that repeat another drawing."""
        latest: dict[str, str] = {}  # key of a drawing -> key of its latest copy
        for drawing in drawings:
            if drawing.adds or drawing.like or drawing.without:
                like = drawing.like or ""
                Marked(drawing, self.place_of_mark, latest.get(like, like)).add()
                latest[like] = drawing.key

    def place_of_mark(self, node: Tree, name: str, letters: InLetters) -> MatrixBase:
        """Return the place of a mark from the components that the file states."""
        if not isinstance(node, SequenceNode):
            rejected("wrong-type", f"`{name}` must be a list of components, such as `[a, 0, 0]`", node.place)
        return ImmutableDenseMatrix(each([partial(letters.of_kind, item, name, "length") for item in node.items]))

    def every(self) -> dict[str, tuple[Quantity, ...] | DeriveError]:
        """Return, for each name, its steps, or the error if they cannot be derived."""
        return self.by_name.every()
