"""Scripts of the engine: `solve: system` names one, and `given:` then describes what a script would have stated.

Each is a module of `derive/stock` with one `STOCK`: the keys allowed under `given:`, their meaning once the letters
are known, and the answers derived from them. They are loaded by name, as a problem's own script is.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any, Protocol, TypeVar

from sympy import Expr

from derive import FOLDER
from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import RATES, TIME
from derive.algebra.kinds import about_kind, dimension_of_kind, kind_with_article, named, unit_of_kind
from derive.course.assumed import Assumed
from derive.course.expression import Declared, read_expression
from derive.course.given import Given, Measured, NumbersAsLetters
from derive.course.schema import Record, wrong_type
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import DeriveError, Faults, Place, Spelled, rejected
from derive.steps.signs import DECIDES

T = TypeVar("T")
NOWHERE: Mapping[str, Place] = MappingProxyType({})


@dataclass(frozen=True)
class Described:
    """The description that a problem gives.

    letters   those that it introduces itself, coordinates and their rates
    chosen    those that stand for its numbers, which are `measured`
    told      values other than letters that prose may mention by their keys
    several   names of bodies, each of which precedes the names of the answers of that body
    results   quantities computed from answers; each has its name, and the names of the answers that it uses
    without   keys on which some answers do not depend, with the names of these answers
    assumed   relations between letters that are assumed to hold
    """

    letters: Mapping[str, Declared] = field(default_factory=dict)
    chosen: Mapping[str, Declared] = field(default_factory=dict)
    measured: tuple[Measured, ...] = ()
    told: tuple[Given, ...] = ()
    several: tuple[str, ...] = ()
    results: tuple[Any, ...] = ()
    without: tuple[tuple[Word, Collection[str]], ...] = field(default=(), repr=False, compare=False)
    assumed: tuple[Assumed, ...] = ()

    @property
    def made(self) -> dict[Word, tuple[Word, ...]]:
        """Return the names of the answers that each result uses, by the name of the result."""
        return {result.name: result.uses for result in self.results}


class Answering(Protocol):
    """The answers of a description."""

    def solve(self, asked: Sequence[Word]) -> Mapping[str, object]:
        """Return the answers by the names that parts ask for; one name may mean several steps."""

    def every(self) -> dict[str, Any]:
        """Return every name that parts may ask for, each with its steps or with why it cannot be derived."""


@dataclass(frozen=True)
class Stock:
    """A script of the engine.

    keys      the keys allowed under `given:`
    read      their meaning in the declared letters, after an error for each value that has no meaning
    answers   the answers of a description
    """

    keys: type[Record]
    read: Callable[[Any, Mapping[str, Declared], Faults], Described]
    answers: Callable[[Any], Answering]


@dataclass(frozen=True)
class StockScript:
    """A script of the engine that a problem names, and the place of its name."""

    stock: Stock
    returns: Place


def stock_names(folder: Path = Path(FOLDER, "stock")) -> tuple[str, ...]:
    """Return the names that `solve:` allows in place of a script."""
    return tuple(sorted(file.stem for file in folder.glob("[a-z]*.py")))


def stock_script(name: str) -> Stock:
    found: Stock = import_module(f"derive.stock.{name}").STOCK
    return found


@contextmanager
def told_at(place: Place | None, places: Mapping[str, Place] = NOWHERE) -> Iterator[None]:
    """Show the error of a verb, which does not know the file, where it was asked for or at the wrong argument's key."""
    try:
        yield
    except DeriveError as error:
        told = (replace(c, help=in_keys(c.help)) for c in error.complaints)
        raise type(error)(c if c.place else replace(c, place=places.get(c.argument, place)) for c in told) from error


def in_keys(help_line: str | None) -> str | None:
    """Return the help line of a verb for a script in the form for a file."""
    if help_line and help_line.startswith(DECIDES):
        return f"state it under `given:`, as `assume: [{help_line.removeprefix(DECIDES).strip()}]`"
    return help_line.in_file if isinstance(help_line, Spelled) else help_line


class InLetters:
    """A description, read in its letters, of which `t` is always the time.

    Each reading returns a value or raises what is wrong.
    """

    def __init__(self, letters: Mapping[str, Declared]):
        self.letters = {TIME.name: Declared(TIME.name, TIME, "time"), **letters}
        self.numbers = NumbersAsLetters(self.letters)

    def also(self, letters: Mapping[str, Declared]) -> InLetters:
        """Return a reader that has these letters too; equal numbers still share one letter."""
        found = InLetters({**self.letters, **letters})
        found.numbers = self.numbers
        return found

    @property
    def chosen(self) -> dict[str, Declared]:
        """The letters that stand for numbers."""
        known = self.numbers.letters.symbols
        return {name: known[name] for name in known if name not in self.letters}

    def unused(self, name: Word, help_line: str) -> str:
        """Return the name of a letter that the description introduces; nothing else may have that name."""
        if name in self.letters:
            message = f"`{name}` stands for something else already"
            rejected("letter-clash", message, name.place, help_line)
        return str(name)

    def value(self, node: Tree, name: str, kind: str, of: int = 1, or_zero: bool = False) -> Expr:
        """Read a constant expression of a kind; if letters of that kind are positive, it must not be known to be
        negative, nor to be zero unless `or_zero`."""
        found = self.constant(node, name, kind, of)
        if (
            found.is_nonpositive
            and not (or_zero and found.is_zero)
            and about_kind(kind).positive
            and not about_kind(kind).signed
        ):
            rejected("not-positive", f"`{name}` must be positive, but `{_text(node)}` is not", node.place)
        return found

    def constant(self, node: Tree, name: str, kind: str, of: int = 1) -> Expr:
        """Read an expression of a kind that neither changes in time nor depends on a coordinate."""
        found = self.of_kind(node, name, kind, of)
        coordinates = (letter for letter in self.letters if f"{letter}_dot" in self.letters)
        moving = {TIME.name, *(f"{q}{order}" for q in coordinates for order in ("", *RATES[1:]))}
        changing = sorted(letter.name for letter in found.free_symbols if letter.name in moving)
        if changing:
            what = "the time t" if changing[0] == TIME.name else f"the coordinate {changing[0]}"
            message = f"`{name}` must be constant, but `{_text(node)}` depends on {what}"
            rejected("changes", message, node.place)
        return found

    def of_kind(self, node: Tree, name: str, kind: str, of: int = 1) -> Expr:
        """Read an expression of the dimension of a kind, with either sign, or a number; zero has any dimension.

        of   how many of them there are; the letters of numbers depend on this
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
        """Read an expression of any dimension."""
        if isinstance(node, Scalar) and not node.empty:
            return read_expression(node, self.letters, lambda number, kind: self.numbers.letter(number, name, kind))
        faults = Faults()
        wrong_type(faults, f"`{name}`", is_a, node)
        faults.stop()
        raise AssertionError  # the error has been raised


def each(readings: Iterable[Callable[[], T]]) -> list[T]:
    """Return what all readings yield, or raise the errors of all."""
    faults, found = Faults(), []
    for reading in readings:
        with faults:
            found.append(reading())
    faults.stop()
    return found


def attempted(faults: Faults, reading: Callable[..., T], *of: Any) -> T | None:
    """Return what a reading yields; None after an error, which `faults` collects."""
    with faults:
        return reading(*of)
    return None


def _text(node: Tree) -> str:
    return " ".join(node.text.split()) if isinstance(node, Scalar) else ""
