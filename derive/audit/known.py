"""What earlier rows of a document gave: definitions of letters, equations, and numbers for letters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.documents.meaning import Meaning, Value
from derive.documents.syntax import Letter

ROUNDS = 8  # of substitution
LARGEST = 4000  # operations of an expression that is still expanded
LAST_EQUATIONS = 24


@dataclass
class Definition:
    symbol: Symbol
    value: Expr
    claim: int
    implied: bool = False  # not written, but needed by a step


@dataclass
class Known:
    """The knowledge of one scope: a problem or a chapter of the document."""

    meaning: Meaning
    definitions: dict[Symbol, list[Definition]] = field(default_factory=dict)
    equations: list[tuple[Expr, int]] = field(default_factory=list)

    def define(self, symbol: Symbol, value: Expr, claim: int, implied: bool = False) -> None:
        if symbol in value.free_symbols:
            return
        self.definitions.setdefault(symbol, []).append(Definition(symbol, value, claim, implied))

    def state(self, difference: Value, claim: int) -> None:
        """Remember an equation: the difference of its sides vanishes."""
        entries = list(difference) if isinstance(difference, MatrixBase) else [difference]
        for each in entries:
            if each != 0 and each.free_symbols:
                self.equations.append((each, claim))

    def is_defined(self, symbol: Symbol) -> bool:
        return symbol in self.definitions

    def latest(self, symbol: Symbol) -> Definition | None:
        found = self.definitions.get(symbol)
        return found[-1] if found else self.computed(symbol)

    def computed(self, symbol: Symbol) -> Definition | None:
        """Return the value of a rate or of a derivative whose letter is defined."""
        letter = self.meaning.symbols.get(symbol)
        if letter is not None and letter.dots:
            undotted = replace(letter, dots=letter.dots - 1)
            inner = self.latest(self.meaning.symbol(undotted))
            if inner is None:
                return None
            time = self.meaning.symbol(Letter(letter.span, "t"))
            return Definition(symbol, self.meaning.differentiated(inner.value, time, False), inner.claim)
        if symbol in self.meaning.derivatives:
            letter, by, partial = self.meaning.derivatives[symbol]
            inner = self.latest(self.meaning.symbol(letter))
            if inner is None:
                return None
            value = self.through(inner.value, {each for each, _ in by})
            for each, order in by:
                for _ in range(order):
                    value = sympy.diff(value, each) if partial else self.meaning.differentiated(value, each, partial)
            return Definition(symbol, value, inner.claim)
        return None

    def through(self, value: Expr, wanted: set[Symbol]) -> Expr:
        """Put in the definitions of letters that depend on the variables of a derivative."""
        for _ in range(ROUNDS):
            found = {}
            for symbol in value.free_symbols - wanted:
                definition = self.definitions.get(symbol, [None])[-1] or (
                    self.computed(symbol) if (letter := self.meaning.symbols.get(symbol)) and letter.dots else None
                )
                if definition is not None and symbol not in definition.value.free_symbols:
                    found[symbol] = definition.value
            if not found:
                break
            value = value.xreplace(found)
        return value

    def expanded(self, *values: Value) -> Iterator[tuple[tuple[Value, ...], tuple[int, ...]]]:
        """Yield the values with more and more definitions put in, and the numbers of the claims that gave these."""
        used: list[int] = []
        for _ in range(ROUNDS):
            free = set().union(*(each.free_symbols for each in values))
            found = {}
            for symbol in sorted(free, key=str):
                definition = self.latest(symbol)
                if definition is not None:
                    found[symbol] = definition.value
                    used.append(definition.claim)
            if not found:
                return
            values = tuple(each.xreplace(found) for each in values)
            if any(_size(each) > LARGEST for each in values):
                return
            yield values, tuple(dict.fromkeys(used))

    def recent(self) -> list[tuple[Expr, int]]:
        return self.equations[-LAST_EQUATIONS:]


def _size(value: Value) -> int:
    return sum(map(sympy.count_ops, value)) if isinstance(value, MatrixBase) else int(sympy.count_ops(value))
