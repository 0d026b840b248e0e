"""Nodes for equations in several unknowns: a column of amplitudes, and a determinant.

The amplitudes of one mode may include both lengths and angles, so neither node requires entries of one dimension.
"""

from __future__ import annotations

from typing import Any

from sympy import Dummy, Expr, Function, ImmutableDenseMatrix, Integer, Pow
from sympy.matrices import MatrixBase
from sympy.matrices.exceptions import NonInvertibleMatrixError
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import sring

from derive.algebra.dimensions import Dimension, product
from derive.algebra.node import DimensionOf, MatrixNode, ScalarNode, TextOf, explicit
from derive.algebra.tidy import tidied
from derive.errors import during


class Amplitudes(MatrixNode):
    """A column with one entry for each coordinate. Only the ratios of the entries are meaningful."""

    @property
    def shape(self) -> tuple[Any, Any]:
        return Integer(len(self.args)), Integer(1)

    @property
    def column(self) -> MatrixBase:
        return ImmutableDenseMatrix(len(self.args), 1, list(self.args))

    def _evaluated(self, *entries: Expr) -> MatrixBase:
        return ImmutableDenseMatrix(len(entries), 1, list(entries))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        for entry in self.args:
            of(entry)
        return None

    def lowered(self, text: TextOf) -> str:
        return f"Matrix([{', '.join(text(entry) for entry in self.args)}])"


class Determinant(ScalarNode):
    """The determinant of a square matrix of explicit entries."""

    def doit(self, **hints: Any) -> Expr:
        return determinant_of(explicit(self.args[0]))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        """The dimension of one term of the determinant: a product of nonzero entries, one from each row and column.

        The products are assumed to have the same dimension. Return None if all of them are zero, or if the dimension of
        an entry of the chosen product is unknown.
        """
        matrix = self.args[0]
        for entry in matrix:
            of(entry)
        columns = _places(matrix, 0, ())
        return product(of(matrix[i, j]) for i, j in enumerate(columns)) if columns else None

    def lowered(self, text: TextOf) -> str:
        return f"{text(self.args[0])}.det()"


def determinant_of(matrix: MatrixBase) -> Expr:
    """Compute the determinant from the characteristic polynomial, without division by a pivot.

    Symbols replace functions and non-integer powers during the computation; otherwise SymPy would cancel factors after
    each step.
    """
    parts = matrix.atoms(Function, Pow)
    named = {part: Dummy() for part in sorted(parts, key=str) if not (part.is_Pow and part.exp.is_Integer)}
    domain = DomainMatrix.from_Matrix(matrix.xreplace(named))
    with during(lambda: f"the determinant of {matrix.shape[0]} rows with {len(matrix.free_symbols)} symbols"):
        value = domain.domain.to_sympy(domain.charpoly()[-1] * (-1) ** matrix.shape[0])
    return value.xreplace({letter: part for part, letter in named.items()})


def inverse_of(matrix: MatrixBase) -> MatrixBase:
    """Compute the inverse as the adjugate divided by the determinant, without simplifying its entries.

    Raises `NonInvertibleMatrixError` if the determinant is zero.
    """
    determinant = tidied(determinant_of(ImmutableDenseMatrix(matrix)))
    if determinant == 0:
        raise NonInvertibleMatrixError("the determinant is zero")
    return matrix.adjugate() / determinant


def expanded_by_rows(matrix: MatrixBase) -> Expr:
    """The determinant by expansion along the rows.

    Source: Axler, *Linear Algebra Done Right*, section 9C; no code is shared with `determinant_of`.
    """
    ring, entries = sring(list(matrix))
    size = matrix.shape[0]
    known: dict[tuple[int, ...], Any] = {(): ring.one}
    for row in reversed(range(size)):  # `known` maps each set of columns to their minor in the rows below
        own = entries[size * row : size * (row + 1)]
        minors: dict[tuple[int, ...], Any] = {}
        for columns, minor in known.items():
            for j in range(size):
                if own[j] and j not in columns:
                    before = sum(other < j for other in columns)
                    place = tuple(sorted((*columns, j)))
                    minors[place] = minors.get(place, ring.zero) + (-1) ** before * own[j] * minor
        known = {place: minor for place, minor in minors.items() if minor}
    whole: Expr = known.get(tuple(range(size)), ring.zero).as_expr()
    return whole


def _places(matrix: MatrixBase, row: int, taken: tuple[int, ...]) -> tuple[int, ...]:
    """Choose a different column for each row, so that no chosen entry vanishes; return an empty result if this is
    impossible."""
    if row == matrix.shape[0]:
        return taken
    free = (j for j in range(matrix.shape[1]) if j not in taken and matrix[row, j] != 0)
    return next((found for j in free if (found := _places(matrix, row + 1, (*taken, j)))), ())
