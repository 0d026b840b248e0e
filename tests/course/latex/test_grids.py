"""Sums and products of scalars, columns and matrices: their shapes, dimensions and places."""

from __future__ import annotations

import pytest
from sympy import Integer, Symbol, sqrt

from derive.algebra.dimensions import NUMBER
from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import Term
from derive.course.latex.grids import Grid, Grids, TermOrGrid, each, spanning
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Rejected

LENGTH, MASS = dimension_of_kind("length"), dimension_of_kind("mass")
a, b, M = (Symbol(name, positive=True) for name in "abM")


def grids(homogeneous: bool = True) -> Grids:
    text = "left side and right side"
    return Grids(Scalar(text, "", 0, len(text), Source("f.yaml", text)), homogeneous)


def term(value: object, dimension: object = LENGTH) -> Term:
    return Term(Integer(value) if isinstance(value, int) else value, dimension, 0, 4)


def column(*values: object) -> Grid:
    return Grid(tuple((term(value),) for value in values), 5, 9)


def entries(value: TermOrGrid) -> list[object]:
    assert isinstance(value, Grid)
    return [each.expr for row in value.rows for each in row]


def test_a_column_is_added_entry_by_entry() -> None:
    total = grids().sum_of(column(a, b, 0), column(b, 0, a), "-")
    assert entries(total) == [a - b, b, -a]


@pytest.mark.parametrize(
    ("left", "right", "message"),
    [
        (term(a), column(a, b, 0), "a scalar and a column of 3 cannot be added"),
        (column(a, b), column(a, b, 0), "a column of 2 and a column of 3 cannot be added"),
    ],
)
def test_what_is_of_another_shape_is_not_added(left: TermOrGrid, right: TermOrGrid, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        grids().sum_of(left, right, "+")


def test_vectors_have_a_dot_and_a_cross_and_no_product_side_by_side() -> None:
    x, y = column(a, 0, 0), column(b, a, 0)
    dot, cross = grids().product_of(x, y, "\\cdot"), grids().product_of(x, y, "\\times")
    assert isinstance(dot, Term)
    assert (dot.expr, dot.dimension) == (a * b, LENGTH**2)
    assert entries(cross) == [0, 0, a**2]
    with pytest.raises(Rejected) as caught:
        grids().product_of(x, y, "")
    assert caught.value.complaints[0].help == r"write `\cdot` or `\times` between vectors"


def test_a_matrix_takes_a_column_of_its_own_width() -> None:
    matrix = Grid(((term(1, NUMBER), term(2, NUMBER)), (term(0, NUMBER), term(1, NUMBER))), 0, 4)
    assert entries(grids().product_of(matrix, column(a, b), "")) == [a + 2 * b, b]
    with pytest.raises(Rejected, match="a matrix of 2 by 2 and a column of 3 cannot be multiplied in this way"):
        grids().product_of(matrix, column(a, b, 0), "")


def test_a_row_times_a_column_is_a_scalar() -> None:
    row = Grid(((term(a), term(b)),), 0, 4)
    product = grids().product_of(row, column(a, b), "")
    assert isinstance(product, Term)
    assert product.expr == a**2 + b**2


def test_nothing_is_divided_by_a_vector_and_only_its_square_is_read() -> None:
    with pytest.raises(Rejected, match="a value cannot be divided by a column of 3"):
        grids().quotient_of(term(a), column(a, b, 0))
    with pytest.raises(Rejected, match="only the square of a vector can be read"):
        grids().power_of(column(a, b, 0), term(3, NUMBER))
    square = grids().power_of(column(a, b, 0), term(2, NUMBER))
    assert isinstance(square, Term)
    assert square.expr == a**2 + b**2


def test_bars_are_a_length_or_an_absolute_value_and_no_determinant() -> None:
    size = grids().size_of(column(a, b, 0), 0, 9)
    assert (size.expr, size.dimension, size.end) == (sqrt(a**2 + b**2), LENGTH, 9)
    assert grids().size_of(term(-a), 0, 4).expr == a
    with pytest.raises(Rejected, match="a determinant cannot be read"):
        grids().size_of(Grid(((term(a), term(b)), (term(b), term(a))), 0, 4), 0, 4)


def test_zero_fits_every_dimension_and_takes_that_of_the_other() -> None:
    assert grids().added(term(0, NUMBER), term(a), "+").dimension == LENGTH
    with pytest.raises(Rejected, match="cannot be added"):
        grids().added(term(M, MASS), term(a), "+")
    assert grids(homogeneous=False).added(term(M, MASS), term(a), "+").expr == M + a


def test_the_same_is_done_to_a_scalar_and_to_every_entry_and_places_stay() -> None:
    doubled = each(column(a, b), lambda t: grids().multiplied(term(2, NUMBER), t))
    assert entries(doubled) == [2 * a, 2 * b]
    moved = spanning(doubled, 1, 12)
    assert (moved.start, moved.end) == (1, 12)
    with pytest.raises(Rejected, match="a limit must be a scalar, but this is a column of 2"):
        grids().scalar_in(moved, "a limit")
