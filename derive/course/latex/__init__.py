"""Reads LaTeX formulas as SymPy expressions with dimensions. Each error has its exact place in the text.

    vocabulary  the known LaTeX commands, by purpose
    strict      the tokens of a formula, or the first error in it
    reading     `read_latex`, the entry point: finds the sides of a chain; skips a first side that only names a value
    values      the value of a side, computed from the tree that the parser of documents returns
    grids       sums and products of scalars, vectors and matrices
    integrals   integrals, and antiderivatives between limits
    quoting     quotations of a document, which are printed but not evaluated

A text that has no meaning, or two possible meanings, is rejected at its place.
"""

from derive.course.latex.reading import ReadMath, Side, read_latex

__all__ = ["ReadMath", "Side", "read_latex"]
