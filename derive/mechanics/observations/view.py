"""The part of a page that an observation is about, and the function that makes the step of an observation.

An observation is a step without lines of its own. The predicate in its rule decides whether the observation is true.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from sympy import Expr, Symbol

from derive.algebra.expressions import Relation, explicit, is_matrix
from derive.mechanics.lagrange.facts import Energies
from derive.steps.establish import Lines, Scope, establish
from derive.steps.rule import Rule
from derive.steps.step import Law, Quantity
from derive.steps.subject import EVERYTHING

Observed = Iterator[Quantity]  # the steps that state the observations of one kind


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

    def in_order(self, symbols: Collection[Any]) -> list[Symbol]:
        """Return the given symbols that are in `symbols`, in the order of the problem."""
        return [letter for letter in self.letters if letter in symbols]

    def values(self, *kinds: str) -> Iterator[Quantity]:
        """Yield the exact answers of these kinds (by default, of every kind) that have a symbol, and whose value is one
        expression."""
        for each in self.answers:
            is_number = isinstance(each.value, Expr) and not is_matrix(each.value) and each.symbol is not None
            if is_number and each.exact and (not kinds or each.step.kind in kinds):
                yield each

    @property
    def gravity(self) -> list[Symbol]:
        """Return the given accelerations of free fall: they are in a potential energy and not in a kinetic energy. A
        given acceleration of a support is left out: it is in a kinetic energy, or only in a constraint.

        If no step has a potential energy, because the Lagrangian is given, return all given accelerations.
        """
        known = [energies for q in self.shown if (energies := q.fact(Energies)) is not None]
        kinetic, potential = (
            {s for each in energies for s in explicit(each.value).free_symbols}
            for energies in ([each.kinetic for each in known], [each.potential for each in known])
        )
        return [g for g in self.of_kind("acceleration") if g not in kinetic and (not known or g in potential)]


def observation(rule: Rule, law: Law, inputs: Mapping[str, Any], **more: Any) -> Quantity:
    """Return the step of an observation: it has no symbol, and its inputs may belong to different bodies or systems.

    more   further arguments of `establish`, such as the key, the routes, the outcome and the phrase data
    """
    lines = Lines(put_in=None, result=False, arranged=explicit)
    return establish(rule, None, law, inputs, lines=lines, scope=Scope(differ=EVERYTHING), **more)


def simple(value: Expr, most: int = 8) -> bool:
    """Whether a value is short enough for a sentence."""
    return int(explicit(value).count_ops()) <= most


def numbered(role: str, values: Iterable[Any]) -> dict[str, Any]:
    """Return role_1, role_2, ... with these values."""
    return {f"{role}_{i}": value for i, value in enumerate(values, 1)}


def symbols_behind(steps: Iterable[Quantity]) -> set[Any]:
    """Return the symbols in the values of these steps, and in the values that these steps substitute."""
    found: set[Any] = set()
    for q in steps:
        substituted = [told for role, told in q.step.roles if role.startswith("value_") and isinstance(told, Relation)]
        found |= {s for value in (q.value, *substituted) for s in explicit(value).free_symbols}
    return found
