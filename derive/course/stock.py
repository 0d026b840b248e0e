"""Scripts of the engine: a key such as `solve: system` names a script, and `given:` describes the input of the script.

Each script of the engine is a module of `derive/stock` with an object `STOCK`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, Protocol, TypeVar

from sympy import Expr

from derive import FOLDER
from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import RATES, TIME, depends_on_time
from derive.algebra.kinds import about_kind, dimension_of_kind, kind_with_article, named, unit_of_kind
from derive.course.assumptions import Assumed
from derive.course.expression import Declared, read_expression
from derive.course.given import Given, Measured, NumbersAsLetters
from derive.course.placement import Placement
from derive.course.schema import Record, wrong_type
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import DeriveError, Faults, Place, Spelled, rejected
from derive.steps.record import called_if_changing
from derive.steps.signs import DECIDES

T = TypeVar("T")
NOWHERE: Mapping[str, Place] = MappingProxyType({})


@dataclass(frozen=True)
class Methods:
    """The methods with which the equations of motion are derived, as a problem and its parts state them.

    whole     the method of the problem; None for the default
    of_names  the name of an answer -> the method of the part that asks for it
    """

    whole: Word | None = None
    of_names: Mapping[str, Word] = field(default_factory=dict)

    def of(self, name: str) -> Word | None:
        return self.of_names.get(name, self.whole)

    @property
    def stated(self) -> tuple[Word, ...]:
        """The method of the problem, if it states one, and the methods of its parts."""
        return tuple(filter(None, (self.whole, *self.of_names.values())))


@dataclass(frozen=True)
class Described:
    """The description of a system, body or rotation in a problem.

    letters   the symbols that the description introduces, such as coordinates
    chosen    the symbols that replace numbers
    measured  the numbers of these symbols
    told      given values other than symbols, which prose can mention by their keys
    several   the names of the bodies if there are several
    results   quantities computed from answers
    without   keys, each with the names of the answers that do not depend on it
    assumed   relations between symbols that are assumed to hold
    methods   the methods with which the equations of motion are derived
    """

    letters: Mapping[str, Declared] = field(default_factory=dict)
    chosen: Mapping[str, Declared] = field(default_factory=dict)
    measured: tuple[Measured, ...] = ()
    told: tuple[Given, ...] = ()
    several: tuple[str, ...] = ()
    results: tuple[Any, ...] = ()
    without: tuple[tuple[Word, Collection[str]], ...] = field(default=(), repr=False, compare=False)
    assumed: tuple[Assumed, ...] = ()
    methods: Methods = Methods()
    has_methods: ClassVar[bool] = False  # whether the description leads to equations of motion

    @property
    def made(self) -> dict[Word, tuple[Word, ...]]:
        """Return, for the name of each result, the names of the answers that the result uses."""
        return {result.name: result.uses for result in self.results}


class Answering(Protocol):
    """The answers of a description."""

    def solve(self, asked: Sequence[Word], drawings: Sequence[Placement]) -> Mapping[str, object]:
        """Return the answers by the names that parts ask for, and draw the requested plots."""

    def mark(self, drawings: Sequence[Placement]) -> None:
        """Add the marks of the problem to the drawings."""

    def every(self) -> dict[str, Any]:
        """Return, for each name that a part can ask for, the steps or the error of the derivation."""


@dataclass(frozen=True)
class Stock:
    """A script of the engine.

    keys      the keys allowed under `given:`
    read      the function that returns the description in the declared symbols and collects errors
    answers   the class that derives the answers of a description
    shows     the marks, such as the centre of mass, that the drawing of a body can have
    """

    keys: type[Record]
    read: Callable[[Any, Mapping[str, Declared], Faults], Described]
    answers: Callable[[Any], Answering]
    shows: tuple[str, ...] = ()


@dataclass(frozen=True)
class StockScript:
    """A script of the engine that a problem names, and where the problem names it."""

    stock: Stock
    returns: Place


def stock_names(folder: Path = Path(FOLDER, "stock")) -> tuple[str, ...]:
    """Return the names of the engine's scripts, which `solve:` allows in place of the path of a script."""
    return tuple(sorted(file.stem for file in folder.glob("[a-z]*.py")))


def stock_script(name: str) -> Stock:
    found: Stock = import_module(f"derive.stock.{name}").STOCK
    return found


@contextmanager
def told_at(place: Place | None, places: Mapping[str, Place] = NOWHERE) -> Iterator[None]:
    """Add to the errors of a verb the place of the wrong argument in the file, or else `place`. Rewrite the help lines
    for a YAML file."""
    try:
        yield
    except DeriveError as error:
        told = (replace(c, help=in_keys(c.help)) for c in error.complaints)
        raise type(error)(c if c.place else replace(c, place=places.get(c.argument, place)) for c in told) from error


def in_keys(help_line: str | None) -> str | None:
    """Return the help line of a verb, if any, in its form for a YAML file; verbs write help lines for scripts."""
    if help_line and help_line.startswith(DECIDES):
        return f"state it under `given:`, as `assume: [{help_line.removeprefix(DECIDES).strip()}]`"
    return help_line.in_file if isinstance(help_line, Spelled) else help_line


class InLetters:
    """Reads the values of a description as expressions in its symbols; the symbol `t` is always the time."""

    def __init__(self, letters: Mapping[str, Declared]):
        self.letters = {TIME.name: Declared(TIME.name, TIME, "time"), **letters}
        self.numbers = NumbersAsLetters(self.letters)

    def also(self, letters: Mapping[str, Declared]) -> InLetters:
        """Return a reader that also has these symbols; both readers replace equal numbers by the same symbol."""
        found = InLetters({**self.letters, **letters})
        found.numbers = self.numbers
        return found

    @property
    def chosen(self) -> dict[str, Declared]:
        """Return the symbols that replace numbers."""
        known = self.numbers.letters.symbols
        return {name: known[name] for name in known if name not in self.letters}

    def unused(self, name: Word, help_line: str) -> str:
        """Return the name of a new symbol; reject a name that is already a symbol."""
        if name in self.letters:
            message = f"`{name}` already denotes something else"
            rejected("letter-clash", message, name.place, help_line)
        return str(name)

    def value(
        self, node: Tree, name: str, kind: str, of: int = 1, or_zero: bool = False, in_time: bool = False
    ) -> Expr:
        """Read a constant expression of the given kind; with `in_time`, it may be a function of the time. If the kind
        requires a positive value, reject a negative value and, without `or_zero`, zero."""
        found = self.constant(node, name, kind, of, in_time)
        if (
            found.is_nonpositive
            and not (or_zero and found.is_zero)
            and about_kind(kind).positive
            and not about_kind(kind).signed
        ):
            text = _text(node)
            message = (
                f"`{name}` must not be negative, but `{text}` is"
                if or_zero
                else f"`{name}` must be positive, but `{text}` is not"
            )
            rejected("not-positive", message, node.place)
        return found

    def constant(self, node: Tree, name: str, kind: str, of: int = 1, in_time: bool = False) -> Expr:
        """Read an expression of the given kind. It may depend on the time only with `in_time`, and never on a
        coordinate."""
        found = self.of_kind(node, name, kind, of)
        coordinates = (letter for letter in self.letters if f"{letter}_dot" in self.letters)
        moving = {TIME.name, *(f"{q}{order}" for q in coordinates for order in ("", *RATES[1:]))}
        changing = sorted((letter for letter in found.free_symbols if letter.name in moving), key=str)
        if in_time:
            changing = [letter for letter in changing if not depends_on_time(letter)]
        if changing:
            is_coordinate = not depends_on_time(changing[0])
            what = f"the coordinate {changing[0]}" if is_coordinate else called_if_changing(changing[0])
            must = "be constant or a function of the time" if in_time else "be constant"
            message = f"`{name}` must {must}, but `{_text(node)}` depends on {what}"
            rejected("changes", message, node.place)
        return found

    def of_kind(self, node: Tree, name: str, kind: str, of: int = 1) -> Expr:
        """Read a number, or an expression with the dimension of the given kind. Zero may have any dimension.

        of   the number of values that belong together
        """
        wanted, is_a = dimension_of_kind(kind), kind_with_article(kind)
        if isinstance(node, Scalar) and (letter := self.numbers.letter(node, name, kind, of)) is not None:
            return letter
        expr, dimension = self.read(node, name, is_a)
        if dimension != wanted and not expr.is_zero:
            bare = expr.is_Rational and dimension == NUMBER
            help_line = f"write it with its unit, `{_text(node)} {unit_of_kind(kind)}`" if bare else None
            message = f"`{name}` must be {is_a}, but `{_text(node)}` is {named(dimension)}"
            rejected("wrong-kind", message, node.place, help_line)
        return expr

    def read(self, node: Tree, name: str, is_a: str = "an expression") -> tuple[Expr, Dimension]:
        """Read an expression of any dimension; return it with its dimension."""
        if isinstance(node, Scalar) and not node.empty:
            return read_expression(node, self.letters, lambda number, kind: self.numbers.letter(number, name, kind))
        faults = Faults()
        wrong_type(faults, f"`{name}`", is_a, node)
        faults.stop()
        raise AssertionError  # `stop` has raised the error


def each(readings: Iterable[Callable[[], T]]) -> list[T]:
    """Call all readings and return their results; if some fail, raise all their errors together."""
    faults, found = Faults(), []
    for reading in readings:
        with faults:
            found.append(reading())
    faults.stop()
    return found


def attempted(faults: Faults, reading: Callable[..., T], *of: Any) -> T | None:
    """Return the result of a reading, or None after an error, which is added to `faults`."""
    with faults:
        return reading(*of)
    return None


def _text(node: Tree) -> str:
    return " ".join(node.text.split()) if isinstance(node, Scalar) else ""
