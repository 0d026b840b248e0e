"""Parses the LaTeX formulas of a document to SymPy expressions with dimensions; errors have exact places.

    tokens      the tokens of the text and their places, from pylatexenc
    vocabulary  the LaTeX commands that the reader accepts
    letters     the declared name for a letter with subscript and dots
    grids       sums and products of scalars, vectors and matrices
    integrals   integral signs, differentials, antiderivatives between limits
    arguments   letters, units, functions, and how far the arguments of functions reach
    brackets    the contents of brackets, triples, matrices, the limits of integrals
    titles      left sides that are only a name of the answer
    grammar     chains, sums, products, factors

Text without a meaning, or with two possible meanings, is rejected at its place.
"""

from derive.course.latex.reading import ReadMath, Side, read_latex

__all__ = ["ReadMath", "Side", "read_latex"]
