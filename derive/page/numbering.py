"""The numbers of equations: one after the other, and on a page of more detail those that a page of less has already.

What the page of less detail leaves out stands behind the number before it with a letter, (7a) behind (7): so every
paper that is made of one derivation refers to an equation by one number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from string import ascii_lowercase


@dataclass(frozen=True, order=True)
class Number:
    """7, or 7a: the first of those behind it."""

    whole: int
    behind: int = 0

    def __str__(self) -> str:
        return f"{self.whole}{_letters(self.behind)}"


class Numbering(dict[str, Number]):
    """The numbers of equations by the keys of their steps; `like` are those of a page of less detail."""

    def __init__(self, like: Mapping[str, Number] | None = None):
        super().__init__()
        self._like = like
        self._last = Number(0)

    def add(self, key: str) -> None:
        """The next number."""
        self._last = self[key] = self._next(key)

    def share(self, key: str, number: Number) -> None:
        """It has the number of another equation, and its own is free for the next."""
        own, self[key] = self.get(key), number
        if own == self._last:
            self._last = max(self.values())

    def _next(self, key: str) -> Number:
        if self._like is None:
            return Number(self._last.whole + 1)
        known = self._like.get(key)
        return known if known and known > self._last else Number(self._last.whole, self._last.behind + 1)


def _letters(count: int) -> str:
    """a to z, then aa."""
    more, last = divmod(count - 1, len(ascii_lowercase))
    return (_letters(more) if more else "") + ascii_lowercase[last] if count else ""
