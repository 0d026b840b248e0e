"""Reads LaTeX formulas as SymPy expressions with dimensions. Each error has its exact place in the text.

    tokens      the tokens of the text and their places, from pylatexenc
    cursor      a sequence of tokens with the current position
    vocabulary  the LaTeX commands that are read; every other command is rejected
    letters     the declared symbol for a letter with its subscript and dots
    grids       sums and products of scalars, vectors and matrices
    integrals   integral signs with limits, differentials, antiderivatives between limits
    arguments   letters, units and functions, and where the argument of a function ends
    brackets    the contents of brackets and bars, triples, matrices, limits
    titles      left sides that only name the answer
    grammar     chains, sums, products, factors
    reading     `read_latex`, the entry point
    quoting     quotations of a document, which are printed but not evaluated

A text that has no meaning, or two possible meanings, is rejected at its place.
"""

from derive.course.latex.reading import ReadMath, Side, read_latex

__all__ = ["ReadMath", "Side", "read_latex"]
