"""Encode an expression as nested lists, `["Mul", ["Rational", 13, 12], ["Symbol", ...]]`, and decode the lists into the
same expression.

Decoding builds only nodes and objects of the classes that this module lists; nothing is evaluated from text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from enum import Enum
from functools import lru_cache
from typing import Any

import sympy
from sympy import Basic, Dummy, ImmutableDenseMatrix, Integer, MatrixBase, MatrixSymbol, Rational, Symbol
from sympy.core.symbol import Str

from derive.algebra.kinds import KINDS
from derive.algebra.node import NODES
from derive.algebra.prescribed import Prescribed

# fmt: off
_SYMPY = (
    "Add", "Mul", "Pow", "Integral", "Derivative", "Tuple", "Abs", "sin", "cos", "tan", "asin", "acos", "atan", "atan2",
    "exp", "log", "sinh", "cosh", "tanh", "Identity", "MatMul", "MatAdd", "Equality", "Unequality",
    "StrictGreaterThan", "StrictLessThan", "GreaterThan", "LessThan",
)
# fmt: on
_CLASSES: dict[str, Any] = {getattr(sympy, name).__name__: getattr(sympy, name) for name in _SYMPY}
_PLAIN = {"None", "Symbol", "Prescribed", "Integer", "Rational", "Str", "MatrixSymbol"}
MAX_NODES, MAX_DEPTH, MAX_BITS, MAX_SIZE = 200_000, 300, 20_000, 100
_CONSTANTS: dict[str, Any] = {"Pi": sympy.pi, "Exp1": sympy.E, "ImaginaryUnit": sympy.I, "Infinity": sympy.oo}


def encoded(expr: Any, name: Callable[[Dummy], str] | None = None) -> list[Any]:
    """Encode an expression as data for JSON; `name` returns the name of a dummy symbol. Raises `TypeError` for an
    object without an encoding."""
    if expr is None:
        return ["None"]
    if name and isinstance(expr, Dummy):
        return ["Dummy", name(expr)]
    if isinstance(expr, Prescribed):
        return ["Prescribed", expr.name, expr.sort, expr.above]
    if isinstance(expr, Symbol):
        return ["Symbol", expr.name, _assumptions(expr)]
    if isinstance(expr, Integer):
        return ["Integer", int(expr)]
    if isinstance(expr, Rational):
        return ["Rational", expr.p, expr.q]
    if isinstance(expr, Str):
        return ["Str", expr.name]
    if isinstance(expr, MatrixSymbol):
        return ["MatrixSymbol", expr.name, *(int(n) for n in expr.shape)]
    if isinstance(expr, MatrixBase):
        return ["Matrix", *expr.shape, [encoded(entry, name) for entry in expr]]
    kind = type(expr).__name__
    if kind in _CONSTANTS:
        return [kind]
    if _CLASSES.get(kind, NODES.get(kind)) is not type(expr):
        raise TypeError(f"{kind} has no encoding")
    return [kind, *(encoded(arg, name) for arg in expr.args)]


@lru_cache(maxsize=4096)
def _assumptions(symbol: Symbol) -> dict[str, bool]:
    """Return assumptions with which `Symbol` makes an equal symbol: one of the usual sets if possible, else all
    assumptions that SymPy derives."""
    usual: tuple[dict[str, bool], ...] = ({}, {"real": True}, {"positive": True}, {"nonnegative": True})
    for assumptions in usual:
        if Symbol(symbol.name, **assumptions) == symbol:
            return assumptions
    return dict(sorted(symbol.assumptions0.items()))


def decoded(data: Any, named: Callable[[str], Dummy] | None = None) -> Any:
    """Return the expression that `encoded` wrote; raises `ValueError` if the data is malformed or too large, or if it
    names an unknown class."""
    left = [MAX_NODES]

    def made(tree: Any, depth: int) -> Any:
        left[0] -= 1
        if depth > MAX_DEPTH or left[0] < 0 or not isinstance(tree, list) or not tree or not isinstance(tree[0], str):
            raise ValueError("this is not an expression, or it is too large")
        name, *args = tree
        if name in _PLAIN:
            return _plain(name, args)
        if name == "Matrix":
            rows, columns, entries = args
            if not (_is_small(rows) and _is_small(columns) and isinstance(entries, list)):
                raise ValueError("this is not a valid matrix")
            return ImmutableDenseMatrix(rows, columns, [made(entry, depth + 1) for entry in entries])
        if name in _CONSTANTS:
            return _CONSTANTS[name]
        if name == "Dummy" and named:
            return named(*args)
        kind = _CLASSES.get(name) or NODES.get(name)
        if kind is None:
            raise ValueError(f"{name} has no encoding")
        as_written = {"evaluate": False} if name in {"Add", "Mul", "Pow"} else {}  # SymPy would multiply out 2(a + b)
        return kind(*(made(arg, depth + 1) for arg in args), **as_written)

    try:
        return made(data, 0)
    except (AttributeError, IndexError, KeyError, TypeError) as error:  # a known class with wrong arguments
        raise ValueError("this is not an expression") from error


def _plain(name: str, args: list[Any]) -> Any:
    match name, args:
        case "None", []:
            return None
        case "Symbol", [str(letter), dict(assumed)] if all(v in (True, False) for v in assumed.values()):
            return Symbol(letter, **assumed)
        case "Prescribed", [str(letter), str(sort), bool(above)] if sort in KINDS:
            return Prescribed(letter, sort, above)
        case "Integer", [int(n)] if _is_bounded(n):
            return Integer(n)
        case "Rational", [int(p), int(q)] if _is_bounded(p) and _is_bounded(q) and q:
            return Rational(p, q)
        case "Str", [str(word)]:
            return Str(word)
        case "MatrixSymbol", [str(letter), rows, columns] if _is_small(rows) and _is_small(columns):
            return MatrixSymbol(letter, rows, columns)
    raise ValueError(f"this is not a valid {name}")


def _is_bounded(number: int) -> bool:
    return number.bit_length() <= MAX_BITS


def _is_small(size: Any) -> bool:
    return type(size) is int and 0 <= size <= MAX_SIZE


# --- records ---------------------------------------------------------------------------------------------------------


def as_data(value: Any, classes: Mapping[str, Any]) -> Any:
    """Encode records of these classes as lists, mappings and plain values. Raises `TypeError` for a value without an
    encoding."""
    if isinstance(value, Basic | MatrixBase):
        return {"expr": encoded(value)}
    if isinstance(value, tuple | list):
        return [as_data(each, classes) for each in value]
    name = type(value).__name__
    if classes.get(name) is type(value):
        if isinstance(value, Enum):
            return {"is": name, "value": value.value}
        return {"is": name, **{f.name: as_data(getattr(value, f.name), classes) for f in fields(value)}}
    if value is None or isinstance(value, str | bool | int | float):
        return value
    raise TypeError(f"{name} has no encoding")


def from_data(data: Any, classes: Mapping[str, Any]) -> Any:
    """Return the value that `as_data` encoded, with tuples in place of lists. Raises `KeyError` for a record of a class
    that is not in `classes`."""
    if isinstance(data, list):
        return tuple(from_data(each, classes) for each in data)
    if not isinstance(data, dict):
        return data
    if "is" not in data:
        return decoded(data["expr"])
    made_of = {name: from_data(value, classes) for name, value in data.items() if name != "is"}
    return classes[data["is"]](**made_of)
