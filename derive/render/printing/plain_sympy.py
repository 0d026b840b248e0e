"""An expression of the engine as plain SymPy text.

A symbol keeps its name; a name with another meaning in SymPy or Python (`I`, `S`, `beta`, `lambda`) is written
`Symbol('I')`. A coordinate that moves is a function of time, `theta(t)`, and its rates are derivatives of this
function. A result that an earlier step named is written as an identifier, for which the reading program substitutes the
value.
"""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import sympy
from sympy import Basic, Integral, MatrixBase, MatrixSymbol, Symbol
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from derive.algebra.expressions import PLUS_MINUS, RATES
from derive.algebra.node import Node


@dataclass(frozen=True)
class Setting:
    """The context in which an expression is written.

    names    expressions written as identifiers: expression -> identifier
    moving   the names of the coordinates that are functions of time
    sign     the value of the sign ± in the expression, 1 or -1; None if the text has the symbol ±
    known    a cache of texts: several lines contain the same value, and a line is requested more than once
    """

    names: Mapping[Any, str] = field(default_factory=dict)
    moving: Collection[str] = frozenset()
    sign: int | None = None
    known: dict[Any, Written] = field(default_factory=dict, compare=False, repr=False)


def sympy_text(expr: Any, setting: Setting | None = None) -> str:
    """Return plain SymPy text of an expression of the engine."""
    return written(expr, setting or Setting()).text


@dataclass(frozen=True)
class Written:
    """The text of an expression, the names in it, and all other words in it: symbols and functions of time."""

    text: str
    used: Mapping[Any, str]
    words: Collection[str]


def written(expr: Any, setting: Setting) -> Written:
    found = setting.known.get(expr)
    if found is None:
        printer = _PlainSymPy(setting)
        found = setting.known[expr] = Written(str(printer.doprint(expr)), printer.used, printer.words)
    return found


@cache
def is_taken(name: str) -> bool:
    """Return whether a word already has a meaning for SymPy's parser, or is not a valid name."""
    known = hasattr(sympy, name) or hasattr(builtins, name)
    return known or keyword.iskeyword(name) or not name.isidentifier()


def identifier(name: str, taken: Collection[str] = ()) -> str:
    """Return the nearest free identifier: `I` -> `I_`, `J'_xx` -> `J_prime_xx`."""
    word = re.sub(r"\W", "_", name.replace("'", "_prime"))
    while is_taken(word) or word in taken:
        word += "_"
    return word


def coordinate_of(symbol: Symbol) -> tuple[str, int]:
    """Return the name of the coordinate and the order of the derivative: theta_ddot -> theta, 2."""
    order = next(n for n in (3, 2, 1, 0) if symbol.name.endswith(RATES[n]))
    return symbol.name.removesuffix(RATES[order]), order


class _PlainSymPy(StrPrinter):
    """SymPy's printer, changed to write unambiguous names and to convert the engine's nodes to SymPy's nodes."""

    def __init__(self, setting: Setting):
        super().__init__({"order": None})
        self.setting = setting
        self.used: dict[Any, str] = {}
        self.words: set[str] = set()
        self._variables: tuple[Any, ...] = ()

    def _print(self, expr: Any, **options: Any) -> str:
        if self._is_name(expr):
            return self.used.setdefault(expr, self.setting.names[expr])
        if isinstance(expr, Node):
            return expr.lowered(self._factor)
        return str(super()._print(expr, **options))

    def _factor(self, expr: Any, variables: tuple[Any, ...] = ()) -> str:
        """Return the text of a part of an expression, in brackets if necessary."""
        with self._within(variables):
            if self._is_name(expr):
                return self._print(expr)
            return str(self.parenthesize(expr, PRECEDENCE["Func"], strict=True))

    def _is_name(self, expr: Any) -> bool:
        return isinstance(expr, Basic) and expr in self.setting.names and expr not in self._variables

    @contextmanager
    def _within(self, variables: tuple[Any, ...]) -> Iterator[None]:
        """Treat these variables of an integral or antiderivative as bound, so that they are not functions of time."""
        outside, self._variables = self._variables, (*self._variables, *variables)
        try:
            yield
        finally:
            self._variables = outside

    def _print_Symbol(self, expr: Symbol) -> str:
        if expr == PLUS_MINUS and self.setting.sign is not None:
            return "1" if self.setting.sign > 0 else "(-1)"
        name, order = coordinate_of(expr)
        if name not in self.setting.moving or expr in self._variables:
            return f"Symbol({expr.name!r})" if is_taken(expr.name) else self._word(expr.name)
        self.words.add("t")
        moving = f"Function({name!r})(t)" if is_taken(name) else f"{self._word(name)}(t)"
        times = "t" if order == 1 else f"(t, {order})"
        return f"Derivative({moving}, {times})" if order else moving

    def _word(self, word: str) -> str:
        self.words.add(word)
        return word

    def _print_MatrixSymbol(self, expr: MatrixSymbol) -> str:
        return f"MatrixSymbol({expr.name!r}, {expr.shape[0]}, {expr.shape[1]})"

    def _print_MatrixBase(self, expr: MatrixBase) -> str:
        rows = ", ".join("[" + ", ".join(self._print(entry) for entry in row) + "]" for row in expr.tolist())
        return f"Matrix([{rows}])"

    _print_ImmutableDenseMatrix = _print_DenseMatrix = _print_MatrixBase

    def _print_MatAdd(self, expr: Any) -> str:
        return "(" + " + ".join(self._factor(arg) for arg in expr.args) + ")"

    def _print_MatMul(self, expr: Any) -> str:
        return "(" + "*".join(self._factor(arg) for arg in expr.args) + ")"

    def _print_Identity(self, expr: Any) -> str:
        return f"Identity({expr.shape[0]})"

    def _print_Integral(self, expr: Integral) -> str:
        variables = tuple(limit[0] for limit in expr.limits)
        with self._within(variables):
            limits = ", ".join("(" + ", ".join(self._print(part) for part in limit) + ")" for limit in expr.limits)
            return f"Integral({self._print(expr.function)}, {limits})"
