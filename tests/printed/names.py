"""The names in a line, as a reader finds them explained before it: what is printed, and what it stands for.

Two names of one line that are printed alike cannot be told apart by anybody: that is a misprint.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sympy import MatrixBase, MatrixSymbol, Symbol, preorder_traversal
from sympy.core.function import AppliedUndef

from derive.algebra import expressions as ex
from derive.algebra.expressions import PLUS_MINUS
from derive.render.notation.layout import Layout, Name
from derive.render.notation.notation import Notation
from tests.printed.meaning import letters_of


class Misprint(Exception):
    """A line that is not read as what was derived."""


def names_in(expr: Any, notation: Notation) -> dict[Name, Any]:
    found: dict[Name, Any] = {}
    for part in _parts(expr):
        if isinstance(part, Symbol) and part != PLUS_MINUS:
            name, value = notation.layout(part), part
        elif isinstance(part, MatrixSymbol):
            name, value = notation.layout(part), letters_of(part.name, part.shape)
        elif isinstance(part, AppliedUndef):
            name, value = notation.layout(part), ex.scalar(part.func.__name__)
        else:
            continue
        if not isinstance(name, Name):
            raise Misprint(f"the letter {part} is printed as {name}")
        if found.setdefault(name, value) != value:
            raise Misprint(f"{name} stands for {found[name]} and for {value}")
    return found


def printed_apart(names: Mapping[Name, Any], shown: Callable[[Layout], str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in names.items():
        text = shown(name)
        if text in found and found[text] != value:
            raise Misprint(f"`{text}` stands for {found[text]} and for {value}")
        found[text] = value
    return found


def bound_in(expr: Any) -> set[Any]:
    return {part.args[1] for part in _parts(expr) if isinstance(part, ex.Bracket)}


def positions_in(expr: Any) -> list[Any]:
    return [part.args[1] for part in _parts(expr) if isinstance(part, ex.MassIntegral)]


def units_in(expr: Any) -> set[str]:
    return {str(part.args[1].name) for part in _parts(expr) if isinstance(part, ex.Amount | ex.MatrixAmount)} - {""}


def _parts(expr: Any) -> list[Any]:
    entries = list(expr) if isinstance(expr, MatrixBase) else [expr]
    return [part for entry in entries for part in preorder_traversal(entry)]
