"""How much algebra a reader wants; without SymPy, for those who only read what is asked for."""

from __future__ import annotations

from enum import StrEnum


class Level(StrEnum):
    """How much algebra a reader wants; a form is shown at its own level and at every higher one."""

    BRIEF = "brief"
    STANDARD = "standard"
    FULL = "full"

    def shows(self, other: Level) -> bool:
        order = list(Level)
        return order.index(other) <= order.index(self)
