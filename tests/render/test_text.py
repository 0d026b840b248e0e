"""Tests of layouts as text: lines, brackets and boxes."""

from __future__ import annotations

import pytest

from derive.render.notation.layout import (
    Applied,
    Array,
    Digits,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
    Upright,
)
from derive.render.notation.text import TextBox, columns, plain, to_the_right

A, B, TWO = Name("a"), Name("b"), Digits("2")


def row(*items: Layout) -> Row:
    return Row(items)


@pytest.mark.parametrize(
    ("layout", "text"),
    [
        (row(TWO, A), "2a"),
        (row(A, B), "a b"),
        (row(A, Operator("plus"), B), "a + b"),
        (row(Operator("minus"), A), "-a"),
        (row(A, Operator("equals"), Operator("minus"), B), "a = -b"),
        (Raised(A, TWO), "a²"),
        (Fraction(TWO, A), "2/a"),
        (Fraction(A, row(TWO, B)), "a/(2b)"),
        (Fraction(row(A, Operator("plus"), B), TWO), "(a + b)/2"),
        (Fraction(Applied("sin", A), TWO), "(sin a)/2"),
        (Fenced(A, "|"), "|a|"),
        (row(Digits("30"), Upright("degree")), "30°"),
        (row(Digits("30"), Upright("cm")), "30 cm"),
        (Name("omega", "x"), "ω_x"),
        (Name("I", "rod_xx"), "I_rod,xx"),
        (Name("theta", dots=2), "θ\u0308"),
        (Name("L", style="vector"), "L\u20d7"),
        (Name("L'"), "L'"),
    ],
)
def test_a_line_reads_as_it_would_be_typed(layout: Layout, text: str) -> None:
    assert plain(layout) == text


def test_a_root_and_an_integral_keep_what_is_theirs() -> None:
    assert plain(RootSign(row(A, Operator("plus"), B))) != plain(row(RootSign(A), Operator("plus"), B))
    assert plain(row(IntegralSign(), A, Upright("d"), B)).endswith("db")


def test_a_matrix_has_a_line_for_each_row_and_continues_in_the_middle() -> None:
    lines = plain(row(A, Operator("equals"), Array(((A, TWO), (Digits("0"), B), (B, A))))).splitlines()
    assert len(lines) == 3
    assert lines[1].startswith("a = ")
    assert lines[0].startswith("    ")
    assert len({columns(line) for line in lines}) == 1


def test_a_letter_with_a_dot_is_one_column_wide() -> None:
    assert columns("θ\u0308 = 1") == 5
    assert to_the_right("θ\u0308", 3) == "  θ\u0308"
    assert to_the_right("long", 2) == "long"


def test_boxes_stand_beside_each_other_by_their_middles() -> None:
    tall, low = TextBox(("1", "2", "3"), 1), TextBox(("a", "b"), 0)
    beside = tall.beside(low)
    assert beside == TextBox(("1 ", "2a", "3b"), 1)
    assert low.beside(tall) == TextBox((" 1", "a2", "b3"), 1)
    assert beside.width == 2
