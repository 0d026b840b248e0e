"""The symbols of a problem by their letters, and the symbol that a typed letter means.

A symbol is found by its letter, its subscript and its number of dots; `_` and `,` in a subscript are ignored. A letter
that the problem does not have may be another way to type a letter of the problem: `w` for omega.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from sympy import MatrixSymbol, Symbol

from derive.algebra.expressions import RATES, TIME, rate

if TYPE_CHECKING:
    from derive.documents.syntax import Letter

INSTEAD = {"w": "omega", "W": "Omega", "ell": "l", "vartheta": "theta", "th": "theta", "hbar": "h"}
_NAME = re.compile(r"(?P<base>[A-Za-z]+|[^\W\d_])'?(?:_(?P<sub>\w+))?$")


def parts_of(name: str) -> tuple[str, str, int]:
    """Return the letter, the subscript and the number of dots of a name such as `x_1_ddot`."""
    order = next((n for n in range(len(RATES) - 1, 0, -1) if name.endswith(RATES[n])), 0)
    base, _, sub = name.removesuffix(RATES[order]).partition("_")
    return base, bare(sub), order


def bare(subscript: str) -> str:
    return re.sub(r"[_,{}\s]", "", subscript)


@dataclass
class Names:
    """The symbols of a problem by letter, subscript and number of dots."""

    symbols: dict[tuple[str, str, int], Symbol] = field(default_factory=dict)
    wholes: dict[tuple[str, str], MatrixSymbol] = field(default_factory=dict)  # vectors and tensors

    @classmethod
    def of(cls, symbols: Iterable[object]) -> Names:
        names = cls()
        names.symbols["t", "", 0] = TIME
        for symbol in symbols:
            if isinstance(symbol, Symbol) and _NAME.match(symbol.name):
                names.symbols.setdefault(parts_of(symbol.name), symbol)
            elif isinstance(symbol, MatrixSymbol):
                base, sub, _ = parts_of(symbol.name)
                names.wholes.setdefault((base, sub), symbol)
        return names

    def has_base(self, base: str) -> bool:
        return any(each == base for each, *_ in self.symbols) or any(each == base for each, _ in self.wholes)

    def has(self, base: str, sub: str) -> bool:
        return any((base, sub, order) in self.symbols for order in range(4)) or (base, sub) in self.wholes

    @property
    def long_bases(self) -> set[str]:
        return {base for base, *_ in self.symbols if len(base) > 1}

    def meant(self, letter: Letter) -> tuple[Symbol | None, str]:
        """Return the symbol that a letter means, or None. Also return the name of this symbol if the problem writes it
        with another letter; otherwise ""."""
        sub, dots = bare(letter.sub), letter.dots + letter.primes
        if (found := self._at(letter.base, sub, dots)) is not None:
            return found, ""
        other = INSTEAD.get(letter.base)
        if other is not None and not self.has(letter.base, sub) and (found := self._at(other, sub, dots)) is not None:
            return found, found.name
        return None, ""

    def _at(self, base: str, sub: str, dots: int) -> Symbol | None:
        if (base, sub, dots) in self.symbols:
            return self.symbols[base, sub, dots]
        for order in range(min(dots, 2), -1, -1):
            known = self.symbols.get((base, sub, order))
            if known is not None and dots - order + order < len(RATES) and dots <= 3:
                return rate(known, dots - order) if dots > order else known
        return None
