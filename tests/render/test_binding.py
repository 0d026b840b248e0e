"""Tests of how strongly a layout binds, and of its brackets and its sign."""

from __future__ import annotations

from itertools import pairwise

import pytest

from derive.render.notation.binding import Binding, binding, sign_apart, signed, within
from derive.render.notation.layout import (
    Applied,
    Digits,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Name,
    Operator,
    Raised,
    Row,
    Upright,
)

A, B, TWO, D = Name("a"), Name("b"), Digits("2"), Upright("d")
MINUS, PLUS = Operator("minus"), Operator("plus")


def row(*items: Layout) -> Row:
    return Row(items)


RATE = Fraction(D, row(D, Name("t")))
LAYOUTS = [
    (A, Binding.ATOM),
    (Fenced(row(A, PLUS, B)), Binding.ATOM),
    (Fraction(row(A, PLUS, B), B), Binding.FACTOR),
    (Raised(A, TWO), Binding.FACTOR),
    (Applied("sin", A), Binding.FACTOR),
    (row(A, B), Binding.PRODUCT),
    (row(IntegralSign(), A, D, A), Binding.PRODUCT),
    (row(A, Operator("dot"), TWO), Binding.DOTTED),
    (row(TWO, Upright("cm")), Binding.MEASURED),
    (row(IntegralSign(), A), Binding.OPEN),
    (row(RATE, A), Binding.OPEN),
    (row(A, RATE), Binding.PRODUCT),
    (row(A, Operator("cross"), B), Binding.OPEN),
    (row(MINUS, A), Binding.SIGNED),
    (row(MINUS, A, PLUS, B), Binding.SUM),
    (row(A, Operator("plus_minus"), B), Binding.SUM),
    (row(A, Operator("equals"), B), Binding.RELATION),
]


@pytest.mark.parametrize(("layout", "held"), LAYOUTS, ids=str)
def test_a_layout_is_held_by_what_is_loosest_in_it(layout: Layout, held: Binding) -> None:
    assert binding(layout) is held
    assert binding(Fenced(layout)) is Binding.ATOM


@pytest.mark.parametrize(("layout", "held"), LAYOUTS, ids=str)
def test_brackets_stand_only_where_a_place_takes_no_more(layout: Layout, held: Binding) -> None:
    assert within(layout, held) == layout
    if held > Binding.ATOM:
        assert within(layout, Binding(held - 1)) == Fenced(layout)


def test_a_sign_is_taken_from_a_product_and_left_in_a_sum() -> None:
    assert sign_apart(row(MINUS, A, B)) == (MINUS, row(A, B))
    for layout in (row(MINUS, A, PLUS, B), row(A, B), A, row(PLUS, A, Operator("equals"), B)):
        assert sign_apart(layout) == (None, layout)


def test_a_sign_before_a_sum_needs_brackets_and_before_a_product_none() -> None:
    assert signed(MINUS, row(A, B)) == row(MINUS, A, B)
    assert signed(MINUS, row(A, PLUS, B)) == row(MINUS, Fenced(row(A, PLUS, B)))
    assert signed(MINUS, row(MINUS, A)) == row(MINUS, Fenced(row(MINUS, A)))


def test_what_is_no_layout_has_no_binding() -> None:
    with pytest.raises(TypeError, match="no binding for str"):
        binding("a")  # type: ignore[arg-type]
    assert all(one < other for one, other in pairwise(Binding))
