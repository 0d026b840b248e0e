"""The symbols that a page uses and the symbols that it introduces: every symbol in use must be introduced."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Set
from dataclasses import fields, is_dataclass
from typing import Any

from sympy import Basic, Integer, MatrixBase, MatrixSymbol, Pow, Symbol, preorder_traversal

from derive.algebra.expressions import component_names
from derive.algebra.mass_integral import MassIntegral
from derive.page.wording import Ref
from derive.steps.step import Step


def letters_of(symbol: Any) -> set[Any]:
    """Return the symbols that a step with this symbol introduces.

    A vector introduces its components, a list introduces its symbols, and the square of a symbol introduces the symbol.
    """
    if isinstance(symbol, MatrixSymbol):
        return {symbol, *(component_names(symbol.name) if symbol.shape == (3, 1) else ())}
    if isinstance(symbol, MatrixBase):
        return {each for each in symbol if isinstance(each, Symbol)}
    if isinstance(symbol, Pow) and symbol.exp == Integer(2):
        return letters_of(symbol.base)
    return {symbol} if isinstance(symbol, Symbol) else set()


def letters_in(exprs: Iterable[Any]) -> set[Any]:
    """Return every symbol that occurs in the printed parts of the expressions."""
    return {part for expr in exprs for part in _seen(expr) if isinstance(part, Symbol | MatrixSymbol)}


def _seen(expr: Any) -> Iterator[Any]:
    """Yield the printed parts of an expression; an integral over the mass prints only its integrand."""
    parts = preorder_traversal(expr)
    for part in parts:
        yield part
        if isinstance(part, MassIntegral):
            parts.skip()
            yield from preorder_traversal(part.args[0])


def expressions_in(shown: Any) -> Iterator[Any]:
    """Return all expressions in the lines, sentences and drawings of a piece of a page."""
    return (each for each in _leaves(shown) if isinstance(each, Basic | MatrixBase))


def references_in(shown: Any) -> set[str]:
    """Return the keys of the steps to whose equation numbers a piece of a page refers."""
    return {each.key for each in _leaves(shown) if isinstance(each, Ref)}


def _leaves(shown: Any) -> Iterator[Any]:
    waiting = [shown]
    while waiting:
        each = waiting.pop()
        if isinstance(each, Ref | Basic | MatrixBase):
            yield each
        elif isinstance(each, tuple | list):
            waiting += each
        elif is_dataclass(each):
            waiting += [getattr(each, field.name) for field in fields(each)]


def wanting(shown: Any, told: Set[str], steps: Iterable[Step], known: Collection[Any]) -> set[str]:
    """Return the keys of the steps that a piece of a page still needs.

    If the piece uses a symbol that no explained step introduces, it needs the first step that introduces this symbol.

    shown   the piece of the page
    told    keys of the steps that the page explains
    steps   the steps that the page may explain
    known   symbols of inputs, and coordinates with their rates
    """
    sources: dict[Any, list[str]] = {}
    for step in steps:
        for letter in letters_of(step.symbol) - set(known):
            sources.setdefault(letter, []).append(step.key)
    used = letters_in(expressions_in(shown)) & sources.keys()
    return {sources[letter][0] for letter in used if not told & set(sources[letter])}
