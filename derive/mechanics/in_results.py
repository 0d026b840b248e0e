"""How `results:` in a file calls a verb: the name of the verb, its keys, and the kind of value of each key.

    @in_results("limit", "the limiting case", of="limit", letter="for: a letter", to="to: a value or `infinity`")
    def limiting_case(of: Quantity, letter: Letter, to: Value = 0, ...) -> Quantity: ...

The decorator gives each argument its key, and each key its description in the manual. The signature gives the rest:
the annotation of an argument is the kind of value of its key. An argument without a default is a required key, unless
`one_of` contains this key. The decorator and the signature are used to parse the keys, and to write the schema for
editors, the manual and the error messages.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum, auto
from functools import cached_property
from inspect import Parameter, signature
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

from sympy import Expr

from derive.mechanics.arguments import checked
from derive.steps.step import Quantity

F = TypeVar("F", bound=Callable[..., Any])


class Holds(Enum):
    """The kinds of values that a key of a verb can have."""

    ANSWER = auto()  # the name of one answer
    ANSWERS = auto()  # the names of one or more answers
    NAME = auto()  # the name of an answer that the verb itself derives
    LETTER = auto()  # a symbol, a rate, or an expression such as `cos(theta)`
    LETTERS = auto()
    COORDINATE = auto()
    VALUE = auto()  # an expression or infinity
    VALUES = auto()  # a mapping from names of letters, coordinates and rates to values
    ENDS = auto()  # a lower and an upper value
    ORDER = auto()  # a whole number
    WORD = auto()
    SYMBOL = auto()  # the letter of the result
    SYMBOLS = auto()  # one letter for each of several results
    FORMULA = auto()  # an expression in symbols and answers; placeholders represent the answers
    FUNCTIONS = auto()  # two answers or expressions
    POINT = auto()  # the name of a point of a body
    AXIS = auto()  # a direction
    PLACE = auto()  # the two components of a place in a plane
    SURFACE = auto()  # the name of a surface


Letter = Annotated[Any, Holds.LETTER]
Letters = Annotated[Sequence[Any], Holds.LETTERS]
Value = Annotated[Any, Holds.VALUE]
Values = Annotated[Mapping[str, Expr], Holds.VALUES]
Ends = Annotated[Any, Holds.ENDS]
Functions = Annotated[Sequence[Any], Holds.FUNCTIONS]
Formula = Annotated[tuple[Expr, Mapping[Any, Quantity]], Holds.FORMULA]
Name = Annotated[str, Holds.NAME]
Point = Annotated[str | None, Holds.POINT]
Axis = Annotated[Any, Holds.AXIS]
PlaceIn = Annotated[Sequence[Any], Holds.PLACE]
SurfaceNamed = Annotated[Any, Holds.SURFACE]
Symbols = Annotated[Sequence[str], Holds.SYMBOLS]
Ask = Callable[[str], Quantity]  # the argument `ask` of a verb is not a key, but a function: name -> answer


@dataclass(frozen=True)
class ResultKey:
    """A key of a verb: its name, its kind of value, its description in the manual, and whether it is required."""

    name: str
    holds: Holds
    hint: str
    needed: bool


@dataclass(frozen=True)
class ResultVerb:
    """A verb of `results:`.

    name       the key that names the verb; its value is an argument of the function
    yields     a description of the result, for the manual
    function   a function of the values of the keys; its argument `key` is the name of the result
    called     argument -> its key, followed by a colon and a description for the manual
    one_of     keys of which the verb needs at least one
    excludes   pairs of keys that must not both be given, because the second key would then have no effect
    """

    name: str
    yields: str
    function: Callable[..., Any] = field(repr=False)  # not in `repr`, because its address varies
    called: Mapping[str, str]
    one_of: tuple[str, ...] = ()
    excludes: tuple[tuple[str, str], ...] = ()

    @cached_property
    def arguments(self) -> dict[str, ResultKey]:
        """Return a mapping from arguments to keys, for the arguments that have a key."""
        hints = get_type_hints(self.function, include_extras=True)
        parameters = signature(self.function).parameters
        found = {}
        for argument, written in self.called.items():
            name, _, hint = written.partition(": ")
            needed = parameters[argument].default is Parameter.empty and name not in self.one_of
            found[argument] = ResultKey(name, _holds(argument, hints[argument]), hint, needed)
        return found

    @property
    def keys(self) -> dict[str, ResultKey]:
        """Return all keys except the key that names the verb, with required keys first."""
        others = [key for key in self.arguments.values() if key.name != self.name]
        return {key.name: key for needed in (True, False) for key in others if key.needed is needed}

    @property
    def needs(self) -> tuple[str, ...]:
        return tuple(name for name, key in self.keys.items() if key.needed)

    @property
    def own(self) -> ResultKey:
        """Return the key that names the verb."""
        return next(key for key in self.arguments.values() if key.name == self.name)

    def takes(self, argument: str) -> bool:
        """Whether the function has an argument of this name; an argument such as `ask` is not a key."""
        return argument in signature(self.function).parameters


RESULT_VERBS: dict[str, ResultVerb] = {}  # name -> verb, in the order in which the modules are loaded


def in_results(
    name: str,
    yields: str,
    *,
    one_of: tuple[str, ...] = (),
    excludes: tuple[tuple[str, str], ...] = (),
    **called: str,
) -> Callable[[F], F]:
    """Register how `results:` calls a function; `called` maps an argument to its key and description, "for: a letter".

    If the signature of a verb fits the keys, the verb itself is decorated. Otherwise another function is decorated: its
    name begins with an underscore, and it adapts the keys and calls `checked(verb)`. In both cases `checked` checks the
    arguments and looks for the result of an earlier, equal call.
    """

    def declared(function: F) -> F:
        called_as = function if function.__name__.startswith("_") else checked(function)
        RESULT_VERBS[name] = ResultVerb(name, yields, called_as, called, one_of, excludes)
        return function

    return declared


def _holds(argument: str, hint: Any) -> Holds:
    """Return the kind of value of a key, from the name and the annotation of its argument."""
    if get_origin(hint) is Annotated:
        return next(each for each in get_args(hint)[1:] if isinstance(each, Holds))
    if argument in ("symbol", "symbols"):
        return Holds.SYMBOL if argument == "symbol" else Holds.SYMBOLS
    if get_origin(hint) in (Union, UnionType):
        return _holds(argument, next(each for each in get_args(hint) if each is not type(None)))
    if get_args(hint) and get_args(hint)[0] is Quantity:
        return Holds.ANSWERS
    known = {Quantity: Holds.ANSWER, int: Holds.ORDER, str: Holds.WORD}
    return known[hint] if hint in known else Holds[hint.held_as]
