"""Reads the LaTeX formulas of a document: from text to SymPy, with dimensions and exact places.

    tokens      the tokens of the text and their places, from pylatexenc
    vocabulary  the commands that are known
    letters     the declared name for a letter with subscript and dots
    grids       sums and products of scalars, vectors and matrices
    integrals   signs and differentials, brackets between limits
    arguments   letters, units, functions, and how far the arguments of functions reach
    brackets    brackets, triples, matrices, limits
    titles      left sides that are only a name of the answer
    grammar     chains, sums, products, factors

Text without a meaning, or with two possible meanings, is rejected at its place.
"""

from derive.course.latex.reading import ReadMath, Side, read_latex

__all__ = ["ReadMath", "Side", "read_latex"]
