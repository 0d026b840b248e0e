"""An erratum of the source document, as a page shows it: what the document prints, why it is wrong, what is right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Integral, Rational, Symbol

from derive.algebra.encoding import decoded, encoded
from derive.algebra.expressions import PLUS_MINUS, Amount, Factors, Group, Relation
from derive.algebra.rounding import Rounded
from derive.course.reference.statements import Entry, Stated, Statement


@dataclass(frozen=True)
class Erratum:
    """An erratum of a document. If it is only quoted, `answer` is empty, and `printed` and `right` are None.

    answer    the key of the step whose value is wrong in the document
    printed   the wrong value; decimals keep their stated figures
    right     the right value
    quote     what the document prints, in its own letters: prose with formulas between dollar signs; may be empty
    instead   what the document should print, in the same form; may be empty
    """

    answer: str
    part: str | None
    why: str
    printed: Any
    right: Any
    line: int | None = None
    quote: str = ""
    instead: str = ""

    def encoded(self) -> dict[str, Any]:
        """Return the erratum as data, to be stored with the steps between builds."""
        words: dict[str, Any] = {"answer": self.answer, "part": self.part, "why": self.why}
        words |= {"line": self.line, "quote": self.quote, "instead": self.instead}
        return {**words, "printed": encoded(self.printed), "right": encoded(self.right)}

    @classmethod
    def decoded(cls, kept: dict[str, Any]) -> Erratum:
        words = (kept["answer"], kept["part"], kept["why"])
        values = (decoded(kept["printed"]), decoded(kept["right"]))
        return cls(*words, *values, kept["line"], kept["quote"], kept["instead"])


def erratum_of(entry: Entry, letters: Mapping[str, Symbol]) -> Erratum:
    assert entry.right is not None and entry.states is not None
    printed, right = (_shown(statement, entry, letters) for statement in (entry.states, entry.right))
    return Erratum(entry.answer, entry.part, entry.why, printed, right, entry.line, entry.quote, entry.instead)


def quoted_erratum(entry: Entry) -> Erratum:
    """Return an erratum that is only quoted and corrected, and was not compared."""
    return Erratum("", entry.part, entry.why, None, None, entry.line, entry.quote, entry.instead)


def _shown(statement: Statement, entry: Entry, letters: Mapping[str, Symbol]) -> Any:
    if len(statement.sides) == 2:  # a side that is a number has the unit of the entry
        bare = replace(entry, unit=None)
        numbers = [not side.letters for side in statement.sides]
        sides = [
            _value(side, entry if number else bare, letters)
            for side, number in zip(statement.sides, numbers, strict=True)
        ]
        return Relation(sides[0], statement.marks[1], sides[1])
    return _value(statement.sides[0], entry, letters)


def _value(stated: Stated, entry: Entry, letters: Mapping[str, Symbol]) -> Any:
    branches = [
        [_in_unit(_with_figures(_renamed(expr, letters), i, entry), entry) for i, (expr, _) in enumerate(entries)]
        for entries in stated.branches
    ]
    if stated.shape:
        return ImmutableDenseMatrix(*stated.shape, branches[0])
    if len(branches) == 1:
        return branches[0][0]
    plus, minus = branches[0][0], branches[1][0]
    return (plus + minus) / 2 + PLUS_MINUS * (plus - minus) / 2


def _renamed(expr: Expr, letters: Mapping[str, Symbol]) -> Expr:
    """Rewrite an expression in the problem's own letters."""
    opened = expr.replace(lambda e: isinstance(e, Group) and isinstance(e.args[0], Integral), lambda e: e.args[0])
    return opened.xreplace({x: letters.get(x.name) or Symbol(x.name, real=True) for x in opened.atoms(Symbol)})


def _with_figures(expr: Expr, i: int, entry: Entry) -> Expr:
    """Return an expression whose decimals have the significant figures that the entry states: 21.64, not 541/25."""
    if not entry.figures:
        return expr
    figures = Integer(entry.figures[i % len(entry.figures)])
    number, letters = expr.as_independent(*expr.free_symbols, as_Add=False)
    if number.is_Rational and number.q != 1 and letters != 1:
        return Factors(Rounded(number, figures), letters)
    return expr.xreplace({n: Rounded(n, figures) for n in expr.atoms(Rational) if n.q != 1})


def _in_unit(expr: Expr, entry: Entry) -> Expr:
    return expr if entry.unit is None else Amount(expr, entry.unit.text, entry.unit.factor)
