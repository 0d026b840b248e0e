"""Whether a symmetric matrix is positive definite or semidefinite, by the signs of its minors (Sylvester)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations

from sympy import Expr, ImmutableDenseMatrix, MatrixBase

from derive.algebra.amplitudes import determinant_of
from derive.algebra.tidy import tidied

Sign = Callable[[Expr], int | None]  # the sign 1, 0 or -1; None if it is unknown


def is_positive_definite(matrix: MatrixBase, sign: Sign) -> bool:
    """Whether all leading principal minors are known to be positive."""
    return all(sign(minor) == 1 for minor in leading_minors(matrix))


def leading_minors(matrix: MatrixBase) -> Iterator[Expr]:
    """The determinants of the first n rows and columns, for n = 1, 2, and so on."""
    yield from (_minor(matrix, tuple(range(n))) for n in range(1, matrix.shape[0] + 1))


def sign_of_form(matrix: MatrixBase, sign: Sign) -> int | None:
    """The least sign of the quadratic form away from the origin; None if this sign is unknown.

    The sign is 1 for a positive definite form, and -1 if the form is negative in some direction. It is 0 for a form
    that is never negative but vanishes in some direction.

    To establish the sign 0, all principal minors are needed, not only the leading ones.
    """
    if is_positive_definite(matrix, sign):
        return 1
    signs = []
    for minor in principal_minors(matrix):
        signs.append(sign(minor))
        if signs[-1] == -1:
            return -1
    return None if None in signs else 0


def principal_minors(matrix: MatrixBase) -> Iterator[Expr]:
    """The principal minors with one row and column, then those with two rows and columns, and so on."""
    size = matrix.shape[0]
    for n in range(1, size + 1):
        yield from (_minor(matrix, rows) for rows in combinations(range(size), n))


def _minor(matrix: MatrixBase, rows: tuple[int, ...]) -> Expr:
    if len(rows) == 1:
        return matrix[rows[0], rows[0]]
    return tidied(determinant_of(ImmutableDenseMatrix(matrix.extract(list(rows), list(rows)))))
