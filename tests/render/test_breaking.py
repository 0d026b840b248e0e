"""Sums that are too long for a line: broken before a sign, all of them there, no bracket left open."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Symbol, cos, sin, sqrt, symbols

from derive.algebra.expressions import Relation
from derive.page.document import Answer, ChainLine, Equations
from derive.render.notation.breaking import broken
from derive.render.notation.latex import latex
from derive.render.notation.layout import Operator, Row, first_of, row, width
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.lines import answer_lines, printed_lines

LETTERS = symbols("a b c d e f g h k l m n p q r s", positive=True)
theta = Symbol("theta", real=True)
NOTATION = Notation({})
LONG = sum(letter**2 * sin(theta) for letter in LETTERS)


def without_marks(text: str) -> str:
    return text.replace(" ", "")


@given(st.integers(1, len(LETTERS)), st.floats(12, 60))
def test_a_sum_is_broken_before_its_signs_and_nothing_is_lost(terms: int, room: float) -> None:
    layout = NOTATION.layout(sum(letter * cos(theta) for letter in LETTERS[:terms]))
    lines = broken(layout, room, room)
    assert row(*lines) == layout
    assert all(width(line) <= room for line in lines)
    assert all(first_of(line) == Operator("plus") for line in lines[1:])


def test_a_formula_that_fits_stays_in_one_piece() -> None:
    layout = NOTATION.layout(LONG)
    assert broken(layout, width(layout), 10) == [layout]


def test_a_bracket_that_is_too_long_is_opened_and_closed_on_different_lines() -> None:
    layout = NOTATION.layout(Symbol("M") * LONG.subs(theta, 1).factor() * theta)
    first, *between, last = broken(layout, 30, 30)
    assert isinstance(first, Row) and Operator("open") in first.items
    assert isinstance(last, Row) and Operator("close") in last.items
    assert all(
        isinstance(line, Row) and not {Operator("open"), Operator("close")} & set(line.items) for line in between
    )
    assert without_marks("".join(map(plain, [first, *between, last]))) == without_marks(plain(layout))


def test_a_fraction_with_a_long_numerator_has_its_denominator_put_in_front() -> None:
    layout = NOTATION.layout(sum(LETTERS[:12]) / (LETTERS[12] + LETTERS[13]))
    first, *_ = broken(layout, 25, 25)
    assert latex(first).startswith(r"\frac{1}{p+q}")
    assert r"\Bigl(" in latex(first)


@pytest.mark.parametrize("expr", [sqrt(sum(LETTERS)), sin(sum(LETTERS)), LETTERS[0] ** 2])
def test_roots_and_arguments_are_not_broken(expr: object) -> None:
    layout = NOTATION.layout(expr)
    assert broken(layout, 5, 5) == [layout]


def test_the_reason_and_the_number_stand_at_the_last_line() -> None:
    from derive.page.wording import Text

    equations = Equations("T", (ChainLine(Symbol("T"), "equals", LONG, (Text("why"),)),), 7)
    lines = printed_lines(equations, NOTATION, 40)
    assert len(lines) > 2
    assert [line.number for line in lines] == [None] * (len(lines) - 1) + [7]
    assert [bool(line.reason) for line in lines] == [False] * (len(lines) - 1) + [True]
    assert [line.sides[0][0] for line in lines] == ["equals"] + ["on"] * (len(lines) - 1)


def test_a_long_left_side_ends_with_its_relation() -> None:
    relation = Relation(LONG, "=", 0)
    equations = Equations("motion", (ChainLine(relation.left, relation.word, relation.right),), 1)
    lines = printed_lines(equations, NOTATION, 40)
    assert [len(line.sides) for line in lines] == [1] * (len(lines) - 1) + [2]
    assert lines[-1].sides[-1] == ("equals", NOTATION.layout(relation.right))


def test_a_boxed_answer_takes_as_many_lines_as_it_needs() -> None:
    answer = Answer("T", Symbol("T"), LONG)
    assert len(answer_lines(answer, NOTATION, 40)) > 2
    assert len(answer_lines(answer, NOTATION, 1000)) == 1
