"""Sums and products of the scalars, columns and matrices of a formula; each entry has its own dimension."""

from __future__ import annotations

from abc import ABC
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce
from typing import TypeAlias

from sympy import Abs, Expr, Integer

from derive.algebra.dimensions import NUMBER, Dimension
from derive.course.arithmetic import Arithmetic, Term
from derive.course.yaml_tree import Scalar


@dataclass(frozen=True)
class Grid:
    """A column or a matrix under construction, row by row."""

    rows: tuple[tuple[Term, ...], ...]
    start: int
    end: int

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.rows), len(self.rows[0])

    @property
    def column(self) -> tuple[Term, ...]:
        return tuple(row[0] for row in self.rows)

    @property
    def is_vector(self) -> bool:
        return self.shape == (3, 1)


TermOrGrid: TypeAlias = Term | Grid


def each(value: TermOrGrid, change: Callable[[Term], Term]) -> TermOrGrid:
    """Apply the same change to a scalar, or to every entry of a column or matrix."""
    if isinstance(value, Term):
        return change(value)
    return replace(value, rows=tuple(tuple(change(term) for term in row) for row in value.rows))


def spanning(value: TermOrGrid, start: int, end: int) -> TermOrGrid:
    """Return the value with the place of the brackets or the command around it."""
    return replace(value, start=start, end=end)


class Grids(Arithmetic, ABC):
    """The operations of `Arithmetic`, extended to columns and matrices.

    Zero fits every dimension, because documents write `0` for a vanishing entry of any dimension. The dimensions of the
    terms of a sum are compared only if `homogeneous` is true.
    """

    max_terms = 20_000

    def __init__(self, scalar: Scalar, homogeneous: bool):
        super().__init__(scalar)
        self.homogeneous = homogeneous
        self.d_is_a_letter = False
        self.vectors: list[int] = []  # the positions of letters that are printed as vectors
        self.dimensions: dict[Expr, Dimension] = {}  # dimensions of the letters read so far

    def fits(self, left: Term, right: Term) -> bool:
        return super().fits(left, right) or not self.homogeneous or left.expr == 0 or right.expr == 0

    def added(self, left: Term, right: Term, sign: str) -> Term:
        total = super().added(left, right, sign)
        return replace(total, dimension=right.dimension) if left.expr == 0 else total

    def applied(self, name: str, function: Callable[[Expr], Expr], inner: Term, start: int, end: int) -> Term:
        if not self.homogeneous and name != "sqrt":
            inner = replace(inner, dimension=NUMBER)
        return super().applied(name, function, inner, start, end)

    def sum_of(self, left: TermOrGrid, right: TermOrGrid, sign: str) -> TermOrGrid:
        if isinstance(left, Term) and isinstance(right, Term):
            return self.added(left, right, sign)
        if isinstance(left, Term) or isinstance(right, Term) or left.shape != right.shape:
            verb = "added" if sign == "+" else "subtracted"
            message = f"{_shape(left)} and {_shape(right)} cannot be {verb}"
            self.refuse("shape", message, right.start, right.end)
        rows = tuple(
            tuple(self.added(a, b, sign) for a, b in zip(above, below, strict=True))
            for above, below in zip(left.rows, right.rows, strict=True)
        )
        return Grid(rows, left.start, right.end)

    def minus(self, value: TermOrGrid, start: int) -> TermOrGrid:
        return spanning(each(value, lambda term: self.negated(term, term.start)), start, value.end)

    def product_of(self, left: TermOrGrid, right: TermOrGrid, sign: str) -> TermOrGrid:
        """Multiply two values, with or without a dot or a cross between them."""
        if sign and all(isinstance(each, Grid) and each.is_vector or self.has_vector(each) for each in (left, right)):
            if isinstance(left, Term) or isinstance(right, Term):
                components = "write their components, `\\{a_1, a_2, a_3\\}`"
                message = "the product of two vectors can be read only from their components"
                self.refuse("shape", message, left.start, right.end, components)
        if isinstance(left, Term) and isinstance(right, Term):
            return self.multiplied(left, right)
        if isinstance(left, Term):
            return spanning(each(right, lambda term: self.scaled(left, term)), left.start, right.end)
        if isinstance(right, Term):
            return spanning(each(left, lambda term: self.scaled(right, term)), left.start, right.end)
        if sign == "\\cdot" and left.is_vector and right.is_vector:
            return self.dot(left, right)
        if sign == "\\times" and left.is_vector and right.is_vector:
            return self.cross(left, right)
        if sign != "\\times" and left.shape[1] == right.shape[0]:
            return self.matrix_product(left, right)
        help_line = "write `\\cdot` or `\\times` between vectors" if left.is_vector and right.is_vector else None
        message = f"{_shape(left)} and {_shape(right)} cannot be multiplied in this way"
        self.refuse("shape", message, right.start, right.end, help_line)

    def has_vector(self, term: TermOrGrid) -> bool:
        return any(term.start <= at < term.end for at in self.vectors)

    def scaled(self, factor: Term, term: Term) -> Term:
        return replace(self.multiplied(factor, term), start=term.start, end=term.end)

    def dot(self, left: Grid, right: Grid) -> Term:
        products = [self.scaled(a, b) for a, b in zip(left.column, right.column, strict=True)]
        total = reduce(lambda a, b: self.added(a, b, "+"), products)
        return replace(total, start=left.start, end=right.end)

    def cross(self, left: Grid, right: Grid) -> Grid:
        a, b = left.column, right.column
        entries = [
            self.added(self.scaled(a[i], b[j]), self.scaled(a[j], b[i]), "-") for i, j in ((1, 2), (2, 0), (0, 1))
        ]
        return Grid(tuple((entry,) for entry in entries), left.start, right.end)

    def matrix_product(self, left: Grid, right: Grid) -> TermOrGrid:
        rows = [
            [
                reduce(
                    lambda a, b: self.added(a, b, "+"),
                    (self.scaled(a, row[k]) for a, row in zip(above, right.rows, strict=True)),
                )
                for k in range(right.shape[1])
            ]
            for above in left.rows
        ]
        if left.shape[0] == right.shape[1] == 1:
            return replace(rows[0][0], start=left.start, end=right.end)
        return Grid(tuple(tuple(row) for row in rows), left.start, right.end)

    def quotient_of(self, above: TermOrGrid, below: TermOrGrid) -> TermOrGrid:
        if isinstance(below, Grid):
            self.refuse("shape", f"a value cannot be divided by {_shape(below)}", below.start, below.end)
        reciprocal = self.reciprocal(below)
        if isinstance(above, Term):
            return self.multiplied(above, reciprocal)
        return spanning(each(above, lambda term: self.scaled(reciprocal, term)), above.start, below.end)

    def power_of(self, base: TermOrGrid, exponent: Term) -> TermOrGrid:
        if isinstance(base, Term):
            return self.raised(base, exponent)
        if base.is_vector and exponent.expr == 2:
            return replace(self.dot(base, base), end=exponent.end)
        message = f"only the square of a vector can be read, not this power of {_shape(base)}"
        self.refuse("shape", message, exponent.start, exponent.end)

    def size_of(self, inner: TermOrGrid, start: int, end: int) -> Term:
        """Return the value of an expression between bars: the absolute value of a scalar, or the length of a vector."""
        self.vectors = [at for at in self.vectors if not start <= at < end]
        if isinstance(inner, Term):
            return replace(inner, expr=Abs(inner.expr), start=start, end=end, kind=None)
        if inner.shape[1] != 1:
            self.refuse("shape", "a determinant cannot be read", start, end)
        squares = self.matrix_product(Grid((inner.column,), start, end), inner)
        assert isinstance(squares, Term)
        return replace(self.raised(squares, Term(Integer(1) / 2, NUMBER, start, end)), start=start, end=end)

    def scalar_in(self, value: TermOrGrid, what: str) -> Term:
        if isinstance(value, Grid):
            self.refuse("shape", f"{what} must be a scalar, but this is {_shape(value)}", value.start, value.end)
        return value


def _shape(value: TermOrGrid) -> str:
    if isinstance(value, Term):
        return "a scalar"
    rows, columns = value.shape
    return f"a column of {rows}" if columns == 1 else f"a matrix of {rows} by {columns}"
