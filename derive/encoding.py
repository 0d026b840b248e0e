"""An expression as nested lists, and back, unchanged: `["Mul", ["Rational", 13, 12], ["Symbol", "M", ...]]`.

Reading back builds objects of the listed classes only; nothing is evaluated from text.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy import Basic, ImmutableDenseMatrix, Integer, MatrixBase, MatrixSymbol, Rational, Symbol
from sympy.core.symbol import Str

from derive import expressions, rounding

# fmt: off
_SYMPY = (
    "Add", "Mul", "Pow", "Integral", "Derivative", "Tuple", "Abs", "sin", "cos", "tan", "asin", "acos", "atan", "atan2",
    "exp", "log", "sinh", "cosh", "tanh", "Identity", "MatMul", "MatAdd", "Equality", "Unequality",
    "StrictGreaterThan", "StrictLessThan", "GreaterThan", "LessThan",
)
_NODES = (
    "Dot", "Norm", "Cross", "CarriedRate", "BodyRate", "Group", "Factors", "Terms", "Ratio", "Root", "Bracket",
    "Amount", "MatrixAmount", "MassIntegral", "Outer", "Partial", "TimeRate", "Slope", "At",
    "Truncated",
    "Relation", "Component",
)
# fmt: on
_CLASSES: dict[str, Any] = {
    **{getattr(sympy, name).__name__: getattr(sympy, name) for name in _SYMPY},
    **{name: getattr(expressions, name) for name in _NODES},
    "Rounded": rounding.Rounded,
}
_CONSTANTS: dict[str, Any] = {"Pi": sympy.pi, "Exp1": sympy.E, "ImaginaryUnit": sympy.I, "Infinity": sympy.oo}


def encoded(expr: Any) -> list[Any]:
    """A tree of lists, strings and integers."""
    if expr is None:
        return ["None"]
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
        return ["Matrix", *expr.shape, [encoded(entry) for entry in expr]]
    name = type(expr).__name__
    if name in _CONSTANTS:
        return [name]
    if name not in _CLASSES or not isinstance(expr, Basic):
        raise TypeError(f"{name} has no encoding")
    return [name, *(encoded(arg) for arg in expr.args)]


def _assumptions(symbol: Symbol) -> dict[str, bool]:
    """The fewest assumptions that make an equal symbol: SymPy does not tell apart how they were first written."""
    usual: tuple[dict[str, bool], ...] = ({}, {"real": True}, {"positive": True}, {"nonnegative": True})
    for assumptions in usual:
        if Symbol(symbol.name, **assumptions) == symbol:
            return assumptions
    return dict(sorted(symbol.assumptions0.items()))


def decoded(data: list[Any]) -> Any:
    """The expression that `encoded` wrote."""
    name, *args = data
    if name == "None":
        return None
    if name == "Symbol":
        return Symbol(args[0], **args[1])
    if name == "Integer":
        return Integer(args[0])
    if name == "Rational":
        return Rational(args[0], args[1])
    if name == "Str":
        return Str(args[0])
    if name == "MatrixSymbol":
        return MatrixSymbol(*args)
    if name == "Matrix":
        rows, columns, entries = args
        return ImmutableDenseMatrix(rows, columns, [decoded(entry) for entry in entries])
    if name in _CONSTANTS:
        return _CONSTANTS[name]
    as_written = {"evaluate": False} if name in {"Add", "Mul", "Pow"} else {}  # else 2(a + b) is multiplied out
    return _CLASSES[name](*(decoded(arg) for arg in args), **as_written)
