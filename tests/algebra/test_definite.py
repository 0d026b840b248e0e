"""A quadratic form is positive, semidefinite or negative somewhere by all its principal minors."""

from __future__ import annotations

import pytest
from sympy import Matrix, diag, symbols

from derive.algebra.definite import is_positive_definite, leading_minors, principal_minors, sign_of_form
from derive.steps.signs import sign_for_all

k = symbols("k", positive=True)
c = symbols("c", real=True)


@pytest.mark.parametrize(
    ("matrix", "sign"),
    [
        (diag(k, 2 * k), 1),
        (diag(k, 0), 0),
        (diag(0, -k), -1),
        (diag(k, c), None),
        (Matrix([[k, k], [k, k]]), 0),
        (Matrix([[k, 2 * k], [2 * k, k]]), -1),
        # all leading minors vanish, and along (0, 1, 1, 1) it is 3 k - 6 (3/5) k
        (k * Matrix([[0, 0, 0, 0], [0, 5, -3, -3], [0, -3, 5, -3], [0, -3, -3, 5]]), -1),
    ],
)
def test_the_least_sign_of_a_form_is_found_by_all_minors(matrix: Matrix, sign: int | None) -> None:
    assert sign_of_form(matrix, sign_for_all) == sign
    assert is_positive_definite(matrix, sign_for_all) is (sign == 1)


def test_leading_minors_are_those_of_the_first_rows_and_columns() -> None:
    matrix = Matrix([[2, 1], [1, 3]])
    assert list(leading_minors(matrix)) == [2, 5]
    assert list(principal_minors(matrix)) == [2, 3, 5]
