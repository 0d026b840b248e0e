"""How much algebra a reader wants, and how a step appears; without SymPy, which a reader of these may not need."""

from __future__ import annotations

from enum import StrEnum


class Manner(StrEnum):
    """How a step appears on a page."""

    OWN = "own"  # with its sentence and its lines
    TOLD = "told"  # in a clause behind the first lines that have its letter: "where rho = M/V"
    TAKEN_IN = "taken_in"  # by the step that uses it, which has its value in place of its letter
    LEFT_OUT = "left_out"
    POINTED_OUT = "pointed_out"  # with its sentence, which points to lines that have its result


class Level(StrEnum):
    """How much algebra a reader wants; a form is shown at its own level and at every higher one."""

    BRIEF = "brief"
    STANDARD = "standard"
    FULL = "full"

    def shows(self, other: Level) -> bool:
        order = list(Level)
        return order.index(other) <= order.index(self)
