"""The names in the lines of a step: the value of each name, and its text as plain SymPy.

A symbol is written as its name if this name is free. Otherwise the name is changed: the vector `omega` becomes
`omega_` if a scalar omega also occurs. The identifier of a formula such as dV/dtheta is the key of its step, or the
formula is written out: `Derivative(V, theta(t))`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from sympy import Integer, MatrixBase, MatrixSymbol, Symbol, cancel, preorder_traversal, together
from sympy.simplify.fu import TR5

from derive.algebra.equality import equal
from derive.algebra.expressions import (
    PLUS_MINUS,
    BodyRate,
    CarriedRate,
    Partial,
    Relation,
    TimeRate,
    bound,
    explicit,
    rate,
)
from derive.render.printing.plain_sympy import Setting, Written, identifier, written
from derive.steps.step import Step

PerRoot = str | list[str]  # a list contains one text for each of two roots


@dataclass(frozen=True)
class Page:
    """The steps of a page, which determine the identifiers of names and the coordinates that are functions of time."""

    steps: Sequence[Step]

    @cached_property
    def moving(self) -> frozenset[str]:
        """Return the coordinates that are functions of time."""
        coordinates = {q for step in self.steps for q, _ in step.coordinates}
        parts = {part for step in self.steps for expr in _exprs(step) for part in preorder_traversal(expr)}
        along = {
            q for part in parts if isinstance(part, TimeRate | CarriedRate | BodyRate | Partial) for q in part.args[1:]
        }
        return frozenset(q.name for q in coordinates if q in along or any(rate(q, n) in parts for n in (1, 2)))

    @cached_property
    def identifiers(self) -> dict[Any, str]:
        """Return the identifier of each name; a name has the same identifier in every chain."""
        found = self._first_identifiers
        order = {name: place for place, name in enumerate(found)}
        clashes: dict[Any, set[str]] = {name: set() for name in found}
        for step in self.steps:
            lines = self._drafts[step.key].lines
            words = {word for line in lines for word in line.words}
            for name in sorted({name for line in lines for name in line.used}, key=order.__getitem__):
                clashes[name] |= words
                words.add(found[name])  # the first of two equal names is unchanged
        return {name: identifier(called, clashes[name]) for name, called in found.items()}

    @cached_property
    def _first_identifiers(self) -> dict[Any, str]:
        found: dict[Any, str] = {}
        for step in self.steps:
            for name in [name for name, _ in step.names] + [step.symbol]:
                if name is not None:
                    letter = isinstance(name, Symbol | MatrixSymbol)
                    found.setdefault(name, identifier(name.name if letter else step.key))
        return found

    def names_of(self, step: Step) -> StepNames:
        draft = self._drafts[step.key]
        is_final = not self._renamed & {*draft.values, step.symbol} and not isinstance(step.symbol, MatrixBase)
        return draft if is_final else replace(draft, identifiers=self.identifiers)

    @cached_property
    def _renamed(self) -> set[Any]:
        return {name for name, called in self.identifiers.items() if called != self._first_identifiers[name]}

    @cached_property
    def _drafts(self) -> dict[str, StepNames]:
        called = self._first_identifiers
        return {step.key: StepNames(step, called, self.moving, *_put_in(step)) for step in self.steps}


def _exprs(step: Step) -> list[Any]:
    return [expr for expr in (step.symbol, *(form.expr for form in step.chain)) if expr is not None]


@dataclass(frozen=True)
class StepNames:
    """The lines of one step as plain SymPy, with the names in them.

    values        the names to substitute, with their values: symbols, and formulas written as identifiers
    has_formula   whether the left side is a formula of names, and its value equals the first line of the chain
    """

    step: Step
    identifiers: Mapping[Any, str]
    moving: frozenset[str]
    values: Mapping[Any, Any]
    has_formula: bool

    def text(self, expr: Any) -> PerRoot:
        """Return the text of a line or of a part of a line; two texts if the step has two roots."""
        return _of_each_root(written(expr, setting).text for setting in self._with_names)

    def text_of_value(self, expr: Any) -> PerRoot:
        """Return the text of an expression without identifiers for results of other steps."""
        return _of_each_root(written(expr, setting).text for setting in self._in_letters)

    def factor(self, i: int) -> Any:
        """Return the factor f for which the residual of line i - 1 is f times the residual of line i.

        Names are substituted first.
        """
        puts = dict(self.step.names)
        before, here = (explicit(bound(self.step.chain[n].expr, puts)) for n in (i - 1, i))
        if self.step.chain[i].because == "motion":
            before, here = (bound(each, dict(self.step.motion)) for each in (before, here))
        return factor_between(before.residual, here.residual)

    @property
    def symbol(self) -> PerRoot:
        """Return the left side of the chain. The components of a vector or tensor, or a formula of names, are written
        out; any other symbol is written as its identifier."""
        symbol = self.step.symbol
        if isinstance(symbol, MatrixBase):
            return _of_each_root([written(symbol, Setting(self.identifiers)).text])
        return self.text(symbol) if self.has_formula else self.identifiers[symbol]

    @property
    def names(self) -> dict[str, PerRoot]:
        """Return each name that occurs in a line, with its value."""
        used = {name: called for line in self.lines for name, called in line.used.items()}
        return {called: self.text_of_value(self.values[name]) for name, called in used.items()}

    @property
    def motion(self) -> dict[str, PerRoot]:
        """Return the value of each rate that follows from the equations of motion."""
        return {written(rate, self._plain).text: self.text_of_value(value) for rate, value in self.step.motion}

    @cached_property
    def lines(self) -> list[Written]:
        """Return the texts of all lines, and of the values of names and rates."""
        shown = [*(form.expr for form in self.step.chain), *([self.step.symbol] if self.has_formula else [])]
        lines = [written(expr, self._with_names[0]) for expr in shown]
        used = {name for line in lines for name in line.used}
        motion = [side for pair in self.step.motion for side in pair]
        return [*lines, *(written(expr, self._plain) for expr in [*(self.values[name] for name in used), *motion])]

    @cached_property
    def _with_names(self) -> list[Setting]:
        own = {self.step.symbol} if self.has_formula else set()
        return self._for_each_root({name: self.identifiers[name] for name in self.values if name not in own})

    @cached_property
    def _in_letters(self) -> list[Setting]:
        return self._for_each_root({})

    @cached_property
    def _plain(self) -> Setting:
        return Setting(moving=self.moving) if self._has_two_roots else self._in_letters[0]

    def _for_each_root(self, names: Mapping[Any, str]) -> list[Setting]:
        signs: tuple[int | None, ...] = (1, -1) if self._has_two_roots else (None,)
        return [Setting(names, self.moving, sign) for sign in signs]

    @cached_property
    def _has_two_roots(self) -> bool:
        exprs = [*_exprs(self.step), *(value for _, value in self.step.names)]
        return any(PLUS_MINUS in expr.free_symbols for expr in exprs)


def _put_in(step: Step) -> tuple[dict[Any, Any], bool]:
    """Return the names to substitute, and whether the left side is a formula of these names."""
    known = {name: value for name, value in step.names if isinstance(name, Symbol | MatrixSymbol)}
    formulas = [(name, value) for name, value in step.names if name not in known]
    for name, value in sorted(formulas, key=lambda pair: _size(pair[0])):
        if not says(name, value, known):
            known[name] = value
    if step.symbol is None or isinstance(step.symbol, Symbol | MatrixSymbol | MatrixBase):
        return known, False
    others = {name: value for name, value in known.items() if name != step.symbol}
    return known, says(step.symbol, bound(step.chain[0].expr, dict(step.names)), others)


def says(formula: Any, value: Any, known: Mapping[Any, Any]) -> bool:
    """Return whether a formula of known names equals `value` after the names are substituted."""
    whole = bound(formula, known)
    if isinstance(value, Relation) or whole == formula or whole.has(MatrixSymbol):
        return False
    return bool(equal(whole, value))


def factor_between(before: Any, here: Any) -> Any:
    """Return the factor f for which `before` is f times `here`, simplified if possible."""
    for sign in (Integer(1), Integer(-1)):
        if equal(before, sign * here):
            return sign
    if isinstance(before, MatrixBase):
        raise TypeError("vector equations may differ only by a sign")
    quotient = before / here
    simpler = cancel(together(TR5(before.expand(), max=8) / TR5(here.expand(), max=8)))
    return simpler if equal(before, simpler * here) else quotient


def _of_each_root(texts: Iterable[str]) -> PerRoot:
    several = list(texts)
    return several if len(several) > 1 else several[0]


def _size(expr: Any) -> int:
    return sum(1 for _ in preorder_traversal(expr))
