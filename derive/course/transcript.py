"""A formula that an author wrote in prose: its LaTeX, and the values of its sides if the LaTeX was parsed."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sympy import Basic, Tuple
from sympy.core.symbol import Str


class Transcript(Basic):
    """A formula that is printed in the order in which its author wrote it.

    values   the values of the sides of the formula; empty if the formula is printed without being parsed
    """

    def __new__(cls, tex: str, values: Iterable[Any] = ()) -> Transcript:
        made: Transcript = Basic.__new__(cls, Str(tex), Tuple(*values))
        return made

    @property
    def tex(self) -> str:
        """The LaTeX, which has only known commands (`derive.course.latex.quoting`)."""
        return str(self.args[0].name)

    @property
    def values(self) -> tuple[Any, ...]:
        return tuple(self.args[1])
