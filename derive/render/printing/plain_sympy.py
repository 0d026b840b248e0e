"""An expression of the engine as text that SymPy reads with nothing of ours.

A letter has its own name; one that SymPy or Python would take for something of its own (`I`, `S`, `beta`, `lambda`) is
written `Symbol('I')`. A coordinate that moves is a function of the time, `theta(t)`, and its rates are derivatives of
it. What an earlier step gave a name is written as an identifier, for which the reader puts its value in.
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
    """In what surroundings an expression is written.

    names    what is written as an identifier: expression -> identifier
    moving   the names of the coordinates that are functions of the time
    sign     which of two roots is meant where they differ by it
    known    what was written in it before: a value stands in several lines, and a line is asked for again
    """

    names: Mapping[Any, str] = field(default_factory=dict)
    moving: Collection[str] = frozenset()
    sign: int | None = None
    known: dict[Any, Written] = field(default_factory=dict, compare=False, repr=False)


def sympy_text(expr: Any, setting: Setting | None = None) -> str:
    """Plain SymPy text of an expression of the engine."""
    return written(expr, setting or Setting()).text


@dataclass(frozen=True)
class Written:
    """The text of an expression, which of the names stand in it, and its other words: letters and functions of time."""

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
    """Whether a word means something to SymPy's reader already, or cannot be one."""
    known = hasattr(sympy, name) or hasattr(builtins, name)
    return known or keyword.iskeyword(name) or not name.isidentifier()


def identifier(name: str, taken: Collection[str] = ()) -> str:
    """The nearest identifier that is free: `I` -> `I_`, `J'_xx` -> `J_prime_xx`."""
    word = re.sub(r"\W", "_", name.replace("'", "_prime"))
    while is_taken(word) or word in taken:
        word += "_"
    return word


def coordinate_of(symbol: Symbol) -> tuple[str, int]:
    """The name of a coordinate and the order of its rate: theta_ddot -> theta, 2."""
    order = next(n for n in (3, 2, 1, 0) if symbol.name.endswith(RATES[n]))
    return symbol.name.removesuffix(RATES[order]), order


class _PlainSymPy(StrPrinter):
    """SymPy's own text, with names that cannot be mistaken and nodes lowered to what SymPy knows."""

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
        """The text of a part, in brackets where it could not stand as a factor otherwise."""
        with self._within(variables):
            if self._is_name(expr):
                return self._print(expr)
            return str(self.parenthesize(expr, PRECEDENCE["Func"], strict=True))

    def _is_name(self, expr: Any) -> bool:
        return isinstance(expr, Basic) and expr in self.setting.names and expr not in self._variables

    @contextmanager
    def _within(self, variables: tuple[Any, ...]) -> Iterator[None]:
        """Where these are variables of an integral or of an antiderivative, which stand for themselves."""
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
