"""Consecutive numbers of equations; a more detailed page can use the numbers of a less detailed page.

An equation that the less detailed page omits has the previous number and a letter: (7a) after (7). So an equation on
both pages has the same number on both, if the order of the equations is the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from string import ascii_lowercase


@dataclass(frozen=True, order=True)
class Number:
    """An equation number: 7, or 7a for the first equation after (7) that the less detailed page omits."""

    whole: int
    behind: int = 0

    def __str__(self) -> str:
        return f"{self.whole}{_letters(self.behind)}"


class Numbering(dict[str, Number]):
    """The numbers of equations by the keys of their steps; `like` are the numbers of a less detailed page."""

    def __init__(self, like: Mapping[str, Number] | None = None):
        super().__init__()
        self._like = like

    def add(self, key: str) -> None:
        """Assign a number greater than all numbers in use. The numbers of the page `like` are used if possible."""
        last = max(self.values(), default=Number(0))
        self[key] = self._next(key, last)

    def _next(self, key: str, last: Number) -> Number:
        if self._like is None:
            return Number(last.whole + 1)
        known = self._like.get(key)
        return known if known and known > last else Number(last.whole, last.behind + 1)


def _letters(count: int) -> str:
    """Return the letters for a count: none for 0, then a to z, then aa and so on."""
    more, last = divmod(count - 1, len(ascii_lowercase))
    return (_letters(more) if more else "") + ascii_lowercase[last] if count else ""
