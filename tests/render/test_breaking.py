"""Sums that are too long for a line are broken before a sign, without loss of terms."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Symbol, cos, sin, sqrt, symbols

from derive.render.notation.breaking import broken
from derive.render.notation.latex import latex
from derive.render.notation.layout import Operator, Row, first_of, row, width
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

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
