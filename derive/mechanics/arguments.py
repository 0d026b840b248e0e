"""Check the arguments of a verb against its signature; a verb is a function that scripts call.

The annotations of a verb declare what each argument must be: a step (`Quantity`), a coordinate, an expression, a body.
An argument of a different type is an error, for example a matrix in place of a step, or a floating-point number. The
message names the verb and the argument, in the terms of the script.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from collections.abc import Sequence as SequenceType
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from sympy import Basic, Expr, Integer, MatrixBase, Symbol

from derive.algebra.expressions import as_expr, explicit
from derive.errors import Complaint, OutOfTime, Rejected, Spelled, Unverified
from derive.steps.record import current_run
from derive.steps.step import Quantity

F = TypeVar("F", bound=Callable[..., Any])
_CALLED = {
    "Quantity": "a step",
    "Coordinate": "a coordinate",
    "Expr": "an expression",
    "Symbol": "a letter",
    "str": "text",
}


# functions whose result, such as a force or a place, contains all arguments of the function unchanged
KEEPING = {
    "angular_impulse",
    "charge",
    "collision",
    "couple",
    "damping",
    "force",
    "impulse",
    "point",
    "potential",
    "weight",
}


def checked(verb: F) -> F:
    """Return the verb with a check of its arguments before each call. If the run has a memory of earlier calls, a
    result can be read from this memory instead of being computed. The functions in `KEEPING` are always called."""
    signature = inspect.signature(verb)
    keeps = verb.__name__ in KEEPING

    @functools.wraps(verb)
    def wrapper(*given: Any, **named: Any) -> Any:
        wanted = _hints(verb)
        try:
            arguments = signature.bind(*given, **named).arguments
        except TypeError as fault:
            raise Rejected(Complaint("wrong-argument", f"`{verb.__name__}`: {fault}")) from None
        for name, value in arguments.items():
            parameter = signature.parameters[name]
            values = value if parameter.kind is parameter.VAR_POSITIONAL else (value,)
            if parameter.kind is parameter.VAR_KEYWORD or parameter.default is value:
                continue
            for each in values:
                _check(verb.__name__, name, each, wanted.get(name, Any))
        run = current_run.get()
        try:
            if run is None or run.memory is None or keeps:
                made = verb(*given, **named)
                if keeps:
                    _check_kept(verb.__name__, arguments, made)
                return made
            return run.memory.result(verb, arguments, run, lambda: verb(*given, **named))
        except OutOfTime as late:
            late.doing.append(_told_of_call(verb.__name__, arguments))
            raise

    return wrapper  # type: ignore[return-value]


def _told_of_call(verb: str, arguments: Mapping[str, Any]) -> str:
    """Return a description of a call: the verb, and up to four names of steps, symbols and coordinates among its
    arguments."""
    about = [f"`{name}`" for name in _names(tuple(arguments.values()))]
    return f"`{verb}`" + (f" of {', '.join(about[:4])}" if about else "")


def _names(given: Any) -> Iterator[str]:
    """Yield the keys of steps, and the names of symbols and coordinates, in the arguments."""
    if isinstance(given, tuple | list):
        for each in given:
            yield from _names(each)
    elif isinstance(given, Quantity):
        yield given.key
    elif isinstance(given, Symbol) or isinstance(getattr(given, "symbol", None), Symbol):
        yield str(getattr(given, "symbol", given))


def _check_kept(verb: str, arguments: Mapping[str, Any], made: Any) -> None:
    """Check that the result of a verb, such as a force, contains the arguments unchanged.

    A law and its second route both use this result, so their comparison would not detect a sign that the verb changed.
    """
    kept = set(_values(made))
    for value in _values(tuple(arguments.values())):
        if value not in kept:
            raise Unverified(Complaint("unverified", f"`{verb}` was given {value}, but its result lacks this value"))


def _values(given: Any) -> Iterator[Any]:
    """Yield all expressions in the arguments, including numbers; skip names and omitted arguments."""
    if isinstance(given, tuple | list):
        for each in given:
            yield from _values(each)
    elif isinstance(given, MatrixBase):
        yield from map(explicit, given)
    elif isinstance(given, Quantity):
        yield from _values(given.value)
    elif isinstance(getattr(given, "symbol", None), Symbol):
        yield given.symbol
    elif is_dataclass(given):
        yield from _values(tuple(getattr(given, each.name) for each in fields(given)))
    elif isinstance(given, Expr) or isinstance(given, int) and not isinstance(given, bool):
        yield explicit(as_expr(given))


@functools.cache
def _hints(verb: Callable[..., Any]) -> Mapping[str, Any]:
    return get_type_hints(verb)


def _check(verb: str, name: str, value: Any, wanted: Any) -> None:
    if _fits(value, wanted):
        return
    message = f"`{verb}` needs {_told(wanted)} as its `{name}`, but it is {_shown(value)}"
    raise Rejected(Complaint("wrong-argument", message, help=_help(value, wanted)))


def _fits(value: Any, wanted: Any) -> bool:
    origin, args = get_origin(wanted), get_args(wanted)
    if wanted is Any or wanted is object:
        return True
    if origin in (Union, types.UnionType):
        return any(_fits(value, each) for each in args)
    if origin is tuple:
        inner = args[:1] * len(value) if isinstance(value, tuple | list) and args[1:] == (...,) else args
        return isinstance(value, tuple | list) and len(value) == len(inner) and all(map(_fits, value, inner))
    if origin is SequenceType:
        return isinstance(value, Sequence) and not isinstance(value, str) and all(_fits(v, args[0]) for v in value)
    if origin is not None:
        return True
    if wanted is Expr:
        return isinstance(value, Expr) or isinstance(value, int) and not isinstance(value, bool)
    return isinstance(value, wanted) if isinstance(wanted, type) else True


def _told(wanted: Any) -> str:
    origin, args = get_origin(wanted), get_args(wanted)
    if origin in (Union, types.UnionType):
        return " or ".join(dict.fromkeys(_told(each) for each in args if each is not type(None)))
    if origin is tuple or origin is SequenceType:
        of = _told(args[0]).removeprefix("an ").removeprefix("a ")
        count = "some" if origin is SequenceType or args[1:] == (...,) else str(len(args))
        return f"{count} {of}s"
    name = getattr(wanted, "__name__", str(wanted))
    return _CALLED.get(name, f"a `{name}`")


def _shown(value: Any) -> str:
    if isinstance(value, Quantity):
        return f"the step `{value.key}`"
    if isinstance(value, tuple | list):
        return f"{len(value)} of {' and '.join(dict.fromkeys(_shown(v) for v in value[:3])) or 'nothing'}"
    if isinstance(value, Basic) and len(str(value)) <= 60:
        return f"{type(value).__name__} {value}"
    return "nothing" if value is None else f"{type(value).__name__}"


def _help(value: Any, wanted: Any) -> str | None:
    if isinstance(value, float):
        return "write numbers as fractions, `Rational(1, 2)`, or give them in the problem's file"
    if wanted is Quantity and isinstance(value, Expr | Integer):
        return Spelled('`let("name", lambda: ..., kind="...")` makes a step from an expression', None)
    return None
