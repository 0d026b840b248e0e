"""Columns of amplitudes and determinants: their values, dimensions and texts."""

from __future__ import annotations

import pytest
from sympy import ImmutableDenseMatrix, Matrix, cos, sin, sqrt, symbols

from derive.algebra.amplitudes import Amplitudes, Determinant, determinant_of, expanded_by_rows
from derive.algebra.encoding import decoded, encoded
from derive.algebra.expressions import explicit
from derive.algebra.kinds import dimension_of_kind
from derive.render.printing.plain_sympy import sympy_text
from derive.steps.homogeneity import dimension_of

m, l, k, x = symbols("m l k x", positive=True)
KNOWN = {m: dimension_of_kind("mass"), l: dimension_of_kind("length"), k: dimension_of_kind("spring constant")}
MIXED = ImmutableDenseMatrix([[m, m * l], [m * l, m * l**2]])


def test_a_determinant_is_that_of_its_matrix() -> None:
    assert explicit(Determinant(MIXED)) == 0
    matrix = ImmutableDenseMatrix([[k, -k, 0], [-k, 2 * k, -k], [x, -k, k]])
    assert (determinant_of(matrix) - matrix.det()).expand() == 0


@pytest.mark.parametrize(
    "matrix",
    [
        Matrix([[x]]),
        Matrix([[1, 2], [2, 4]]),
        Matrix([[0, k, 0], [k, 0, m], [0, m, x]]),
        Matrix(4, 4, lambda i, j: (x + i) ** j + k * int(i == j)),
        Matrix(5, 5, lambda i, j: k * (i - j) ** 2 if abs(i - j) < 2 else m * int(i + j == 4)),
        Matrix([[k / m, cos(x)], [sin(x), l]]),
        Matrix([[0, k], [0, m]]),
    ],
    ids=str,
)
def test_a_determinant_expanded_by_rows_is_the_determinant(matrix: Matrix) -> None:
    assert (expanded_by_rows(matrix) - matrix.det(method="laplace")).expand() == 0


def test_a_determinant_has_the_dimension_of_a_product_of_its_rows() -> None:
    assert dimension_of(Determinant(MIXED), KNOWN) == dimension_of(m**2 * l**2, KNOWN)
    assert dimension_of(Determinant(ImmutableDenseMatrix([[0, k], [m, 0]])), KNOWN) == dimension_of(m * k, KNOWN)


def test_amplitudes_may_be_of_different_kinds() -> None:
    column = Amplitudes(l, 1 / m)
    assert dimension_of(column, KNOWN) is None
    assert explicit(column) == ImmutableDenseMatrix([l, 1 / m])
    assert column.shape == (2, 1)


def test_amplitudes_with_an_unknown_letter_are_noticed() -> None:
    with pytest.raises(KeyError):
        dimension_of(Amplitudes(l, x), KNOWN)


@pytest.mark.parametrize("node", [Amplitudes(l, m), Determinant(MIXED)])
def test_they_go_to_lists_and_back_and_to_plain_text(node: Amplitudes | Determinant) -> None:
    assert decoded(encoded(node)) == node
    assert Matrix and "Matrix" in sympy_text(node)


def test_roots_and_functions_are_letters_of_a_determinant() -> None:
    matrix = ImmutableDenseMatrix([[sqrt(3) * k, k * sin(x)], [k * sin(x), sqrt(3) * m]])
    assert determinant_of(matrix) == 3 * k * m - k**2 * sin(x) ** 2
    assert determinant_of(ImmutableDenseMatrix([[sqrt(3), 1], [3, sqrt(3)]])) == 0
