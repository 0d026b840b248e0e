"""The part of a page that an observation is about, and what the steps of all observations have in common.

An observation is a step without lines of its own. Its rule has the predicate, and its sentence names the answer and what
was found about the answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from sympy import Expr, Symbol

from derive.algebra.expressions import explicit
from derive.mechanics.lagrange.facts import Energies
from derive.steps.establish import Lines, Scope
from derive.steps.step import Quantity
from derive.steps.subject import EVERYTHING

ONE_LINE = Lines(put_in=None, result=False, arranged=explicit)
OF_ANY_SUBJECT = Scope(differ=EVERYTHING)


@dataclass(frozen=True)
class View:
    """The part of a page that an observation is about.

    answers   the answers of the part
    shown     all steps of the page up to the end of this part
    page      all steps of the page
    letters   the given symbols of the problem, with their kinds
    """

    answers: tuple[Quantity, ...]
    shown: tuple[Quantity, ...]
    page: tuple[Quantity, ...]
    letters: Mapping[Symbol, str]

    def of_kind(self, kind: str) -> list[Symbol]:
        """Return the given symbols of a kind."""
        return [letter for letter, own in self.letters.items() if own == kind]

    def values(self, *kinds: str) -> Iterator[Quantity]:
        """Yield the exact answers of these kinds (by default, of every kind) whose value is one expression."""
        for each in self.answers:
            is_number = isinstance(each.value, Expr) and each.symbol is not None
            if is_number and each.exact and (not kinds or each.step.kind in kinds):
                yield each

    @property
    def gravity(self) -> list[Symbol]:
        """Return the given accelerations that do not describe a motion: they are not in a kinetic energy."""
        kinetic = [q.needed(Energies).kinetic for q in self.shown if q.fact(Energies) is not None]
        return [g for g in self.of_kind("acceleration") if all(g not in explicit(q.value).free_symbols for q in kinetic)]


def simple(value: Expr, most: int = 8) -> bool:
    """Whether a value is short enough for a sentence."""
    return explicit(value).count_ops() <= most
