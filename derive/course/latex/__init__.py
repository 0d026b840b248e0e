"""Reading mathematics that a document has in LaTeX: text to SymPy, with dimensions and exact places.

    tokens      what stands in the text and where, by pylatexenc
    vocabulary  the commands that are known
    letters     a letter with its subscript and dots as a declared name
    grids       sums and products of scalars, vectors and matrices
    integrals   signs and differentials, brackets between limits
    arguments   functions and how far their arguments reach
    brackets    brackets, triples, matrices, limits
    titles      left sides that only name the answer
    grammar     chains, sums, products, factors

What cannot be read, or could be read in two ways, is refused at its place.
"""

from derive.course.latex.reading import ReadMath, Side, read_latex

__all__ = ["ReadMath", "Side", "read_latex"]
