"""Whether a row that does not follow would follow after one small change: then the row is probably a slip.

The row is compared with what earlier rows determine: the value of its letter, or an equation for its highest rate. A
change is tried with numbers; a row is accused only if one change makes it right at all points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from sympy import Expr, Symbol

from derive.audit.known import Known
from derive.audit.limited import FAULTS
from derive.audit.numeric import NoNumber, Numbers, at, close
from derive.audit.slips import Edit, edits_of_side
from derive.audit.systems import POINTS, Equation, expanded
from derive.documents.meaning import Meaning, Meaningless
from derive.documents.syntax import Letter, Node

SMALL, SMALLEST = 1e-8, 1e-6  # a residual relative to the value elsewhere; a value that counts as zero
MOST_CHANGES = 4000
MOST_TRIED = 6  # number of equations that are tried
TOO_EASY = ("term", "extra factor")  # changes not tried: dropping a factor would turn x_0 cos(w t) into x_0
RENAMED = ("letter", "index", "dots")
Shown = Callable[..., str]


@dataclass
class Nearness:
    """Searches for one change of a side."""

    meaning: Meaning
    known: Known
    letters: Sequence[Letter]
    shown: Shown

    def points(self, without: Symbol | None = None) -> list[Numbers]:
        kept: dict[Symbol, Expr] = {}

        def defined(symbol: Symbol) -> Expr:
            if symbol not in kept:
                kept[symbol] = symbol if symbol == without else expanded(self.known, symbol, without, sure=True)[0]
            return kept[symbol]

        return [Numbers(self.meaning, defined, point) for point in range(POINTS)]

    def edits(self, side: Node) -> list[Edit]:
        found = [each for each in edits_of_side(side, self.letters, self.shown) if each.kind not in TOO_EASY]
        return sorted(islice(found, MOST_CHANGES), key=lambda each: each.cost)

    def of_value(self, side: Node, targets: Sequence[complex], without: Symbol | None = None) -> Edit | None:
        """Return the cheapest change with which a side has the numbers of the targets."""
        points = self.points(without)[: len(targets)]
        if any(abs(each.imag) > SMALL or abs(each) < SMALLEST for each in targets):
            return None  # a side that contains letters is not meant to be zero
        for edit in self.edits(side):
            try:
                if all(close(p.of_node(edit.node), target) for p, target in zip(points, targets, strict=True)):
                    return edit
            except (*FAULTS, NoNumber, Meaningless):
                continue
        return None

    def of_root(self, side: Node, letter: Symbol, equation: Expr) -> Edit | None:
        """Return the cheapest change with which a side is a root of an equation for a letter."""
        for edit in self.edits(side):
            try:
                for point in self.points_of_roots:
                    value = point.of_node(edit.node)
                    found, elsewhere = (
                        at(equation, _at_root(point, letter, each)) for each in (value, 1.37 * value + 0.11)
                    )
                    if abs(found) > SMALL * abs(elsewhere):
                        break
                else:
                    return edit
            except (*FAULTS, NoNumber, Meaningless):
                continue
        return None

    @cached_property
    def points_of_roots(self) -> list[Numbers]:
        return self.points()

    def of_equation(
        self, left: Node, right: Node, equations: Sequence[Equation], wanted: Expr
    ) -> tuple[Edit, Equation] | None:
        """Return a change that turns an equation into an earlier equation, and the earlier equation."""
        tried = 0
        for equation in equations:
            pivot = self.pivot(wanted, equation.value)
            if pivot is None:
                continue
            tried += 1
            if tried > MOST_TRIED:
                break
            try:
                roots = [root(equation.value, p, pivot) for p in self.points(pivot)]
            except (*FAULTS, NoNumber):
                continue
            if any(each is None or abs(each) < SMALLEST or abs(each.imag) > SMALL for each in roots):
                continue  # roots of negative numbers do not show a slip
            edit = self.with_roots(left, right, pivot, [each for each in roots if each is not None])
            if edit is not None and (wanted.free_symbols <= equation.value.free_symbols or edit.kind in RENAMED):
                return edit, equation
        return None

    def pivot(self, wanted: Expr, equation: Expr) -> Symbol | None:
        """Return the highest rate that both equations contain linearly."""
        both = wanted.free_symbols & equation.free_symbols
        if not both or len(wanted.free_symbols ^ equation.free_symbols) > 2:
            return None

        def height(symbol: Symbol) -> tuple[int, str]:
            letter = self.meaning.symbols.get(symbol)
            return (letter.dots if letter is not None else 0), str(symbol)

        point = self.points()[0]
        for symbol in sorted(both, key=height, reverse=True)[:2]:
            if _is_linear(equation, symbol, point) and _is_linear(wanted, symbol, point):
                return symbol
        return None

    def with_roots(self, left: Node, right: Node, pivot: Symbol, roots: Sequence[complex]) -> Edit | None:
        at_root = self.points(pivot)
        for p, value in zip(at_root, roots, strict=True):
            p.fixed[pivot] = value
        elsewhere = self.points(pivot)[0]
        elsewhere.fixed[pivot] = roots[0] * 1.37 + 0.11
        for edit, first in self.edits_of_both(left, right):
            one, other = (edit.node, right) if first else (left, edit.node)
            try:
                size = abs(elsewhere.of_node(one) - elsewhere.of_node(other))
                if size > SMALLEST and all(abs(p.of_node(one) - p.of_node(other)) < SMALL * size for p in at_root):
                    return edit
            except (*FAULTS, NoNumber, Meaningless):
                continue
        return None

    def edits_of_both(self, left: Node, right: Node) -> Iterator[tuple[Edit, bool]]:
        both = [(each, True) for each in self.edits(left)] + [(each, False) for each in self.edits(right)]
        yield from sorted(both, key=lambda pair: pair[0].cost)


def _at_root(point: Numbers, letter: Symbol, value: complex) -> Callable[[Symbol], complex]:
    return lambda symbol: value if symbol == letter else point.basic(symbol)


def _is_linear(value: Expr, pivot: Symbol, point: Numbers) -> bool:
    try:
        zero, one, two = (
            at(value, lambda symbol, s=s: s if symbol == pivot else point.basic(symbol))  # type: ignore[misc]
            for s in (0j, 1 + 0j, 2 + 0j)
        )
    except FAULTS:
        return False
    return close(zero + two, 2 * one) and not close(zero, one)


def root(equation: Expr, point: Numbers, pivot: Symbol) -> complex | None:
    """Return the value of a letter that an equation contains linearly."""
    low, high = (
        at(equation, lambda symbol, s=s: s if symbol == pivot else point.basic(symbol))  # type: ignore[misc]
        for s in (0j, 1 + 0j)
    )
    return None if high == low else -low / (high - low)


def letters_in(*sides: Node | None) -> list[Letter]:
    found: dict[object, Letter] = {}
    for side in sides:
        for each in side.walk() if side is not None else ():
            if isinstance(each, Letter):
                found.setdefault((each.identity, each.dots), each)
    return list(found.values())


__all__ = ["Nearness", "letters_in", "root"]
