"""A step that makes a statement about a motion, with all data that the witness needs to test this statement."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from sympy import Expr, Symbol, diff

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import TIME, Prescribed, Relation, explicit, rate
from derive.algebra.ranges import known_ranges
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from derive.witness.dynamics import Blueprint, Response, Singular
from derive.witness.geometry import State
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Given, Trial

PUT_IN = "answers.put_in"
REDUCED = frozenset(["hamilton.routhian", "hamilton.effective_potential"])
APPROXIMATE = frozenset(
    ["answers.equation_in_limit", "answers.limiting_case", "answers.known_case", "answers.case_in_letters"]
)
CLOSE = 1e-6  # two values agree if they differ by less than this fraction of the size of their terms
TRIALS = 2
STATES = 3


@dataclass(frozen=True)
class Claim:
    """A step and the system to which it belongs.

    momenta     the symbols of conserved or conjugate momenta, each with its coordinate
    assumed     the assumptions of the page about its symbols
    functions   the prescribed functions and their rates, each with the formula that was substituted for it
    """

    quantity: Quantity
    judged: Judged
    outcome: str
    blueprint: Blueprint
    momenta: Mapping[Symbol, Symbol] = field(default_factory=dict)
    assumed: Sequence[Relation] = ()
    functions: Mapping[Symbol, Expr] = field(default_factory=dict)

    @property
    def is_approximate(self) -> bool:
        """Whether the step or one of its ancestors belongs to a limiting or special case. Such a step is not tested."""
        return any(each.step.rule in APPROXIMATE for each in self.quantity.ancestors())

    @property
    def rule(self) -> str:
        return self.quantity.step.rule

    @property
    def symbol(self) -> Any:
        return self.quantity.symbol

    @property
    def value(self) -> Any:
        return explicit(self.quantity.value).xreplace(self.functions)

    @property
    def residuals(self) -> list[Expr]:
        """Differences that vanish if the step is right: left minus right side, or a symbol minus its value."""
        if isinstance(self.value, Relation):
            return [self.value.residual] if self.value.operator == "=" else []
        if isinstance(self.symbol, Symbol) and self.symbol not in self.moving and self.symbol not in self.momenta:
            return []  # the symbol is only a name of the value
        return [explicit(self.symbol) - self.value] if isinstance(self.symbol, Expr) else []

    @cached_property
    def moving(self) -> set[Symbol]:
        """The coordinates, their rates up to the third order, the multipliers and the time."""
        q = self.blueprint.coordinates
        return {*q, *(rate(s, n) for s in q for n in (1, 2, 3)), *self.blueprint.multipliers, TIME}

    @cached_property
    def givens(self) -> list[Given]:
        """The values substituted in this step and its ancestors: the step holds only for these values."""
        found: dict[Given, None] = {}
        for ancestor in self.quantity.ancestors():
            if ancestor.step.rule == PUT_IN:
                found.update(dict.fromkeys(substituted(ancestor)))
        return list(found)

    @property
    def functions_given(self) -> dict[Symbol, Expr]:
        """The formulas that were substituted for prescribed functions, and the derivatives of these formulas for the
        rates. Raises `NotComputable` if two formulas were substituted for one function."""
        found: dict[Symbol, Expr] = {}
        for each in self.givens:
            function, value = each.target, explicit(each.value)
            if isinstance(function, Prescribed):
                if found.setdefault(function, value) != value:
                    raise NotComputable(function.name)
                found.update((function.rate(n), diff(value, TIME, n)) for n in (1, 2, 3))
        return found

    @cached_property
    def constants(self) -> dict[Symbol, Expr]:
        """The eliminated cyclic coordinates, each with its constant momentum."""
        found: dict[Symbol, Expr] = {}
        reduced = [each for each in self.quantity.ancestors() if each.step.rule in REDUCED]
        for each in (ancestor for step in reduced for ancestor in step.ancestors()):
            if each.step.rule == "hamilton.conserved" and isinstance(each.symbol, Symbol):
                found.setdefault(dict(each.step.roles)["coordinate"], each.symbol)
        if found:
            for each in self.quantity.ancestors():
                roles = dict(each.step.roles)
                if each.step.rule == "lagrange.value_kept" and roles.get("momentum") in self.momenta:
                    found[self.momenta[roles["momentum"]]] = explicit(roles["value"])
        return found

    def is_of_a_state(self, given: Given) -> bool:
        if isinstance(given.target, Prescribed):
            return False
        return bool(explicit(given.target).free_symbols & self.moving) or given.target in self.momenta

    @property
    def letters_given(self) -> list[Given]:
        return [
            each
            for each in self.givens
            if not self.is_of_a_state(each)
            and isinstance(each.target, Symbol)
            and not isinstance(each.target, Prescribed)
        ]

    @property
    def states_given(self) -> list[Given]:
        return [each for each in self.givens if self.is_of_a_state(each)]

    def trials(self, count: int = TRIALS, also: Sequence[Relation] = ()) -> Iterator[Trial]:
        for number in range(count):
            try:
                yield self._trial(number, (*self.assumed, *also))
            except NotComputable:
                return

    def _trial(self, number: int, assumed: tuple[Relation, ...]) -> Trial:
        """The system with one set of numbers; steps with the same given values and assumptions share it."""
        letters, momenta = tuple(self.letters_given), tuple(self.momenta.items())
        known, key = self.blueprint.known, (number, assumed, letters, momenta, tuple(known_ranges().items()))
        if key not in known:
            known[key] = Trial(self.blueprint, number, assumed, letters=letters, momenta=self.momenta)
        found: Trial = known[key]
        return found

    def moments(self, trial: Trial, given: Sequence[Given] | None = None) -> Iterator[tuple[State, Response]]:
        """States of the motion, each with its accelerations and multipliers. States that do not determine the
        accelerations are left out."""
        given = tuple(self.states_given if given is None else given)
        for which in range(STATES):
            try:
                yield trial.moment(given, which)
            except Contradiction:
                return
            except (Singular, np.linalg.LinAlgError):
                continue

    def refuted(self, detail: str, trial: Trial, state: State | None = None) -> Verdict:
        """A refutation with the numbers for which the motion contradicts the claim."""
        shown = sorted(trial.used, key=str)
        point = [(letter.name, f"{trial.numbers[letter]:.4g}") for letter in shown]
        if state is not None:
            q, v = self.blueprint.coordinates, self.blueprint.rates
            point += [(s.name, f"{x:.4g}") for s, x in zip([*q, *v], [*state.q, *state.v], strict=True)]
        return Verdict(Grade.REFUTED, detail, tuple(point))


def substituted(step: Quantity) -> list[Given]:
    """The replacements made by one substitution."""
    found = [
        Given(relation.left, explicit(relation.right))
        for role, relation in step.step.roles
        if role.startswith("value_") and isinstance(relation, Relation)
    ]
    original = dict(step.step.roles).get("original")
    for parent in step.parents:
        if parent.symbol is not None and parent.symbol == original or parent.step.key == str(original):
            continue
        value = explicit(parent.value)
        if isinstance(value, Relation) and value.operator == "=" and parent.symbol is None:
            found.append(Given(value.left, value.right))
        elif isinstance(parent.symbol, Expr) and isinstance(value, Expr):
            found.append(Given(parent.symbol, value))
    return found


def seen(count: int, what: str) -> Verdict | None:
    """The verdict if nothing contradicted the claim; None if nothing was tested."""
    return Verdict(Grade.SAMPLED, f"{count} {what}") if count else None
