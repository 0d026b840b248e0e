r"""`read_latex` reads a formula in LaTeX as a chain of values.

13 M a^2/12                  one side
\frac{26}{6} a^2 (6a^3\rho) = \frac{13}{3} M a^2      two sides, and the sign `=` between them
\frac{b \pm \sqrt{c}}{2}     one side with two branches, read as + and as - throughout
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TypeAlias

from sympy import Expr

from derive.algebra.dimensions import Dimension
from derive.course.arithmetic import Declared, Term
from derive.course.latex.cursor import Cursor
from derive.course.latex.grammar import Formula
from derive.course.latex.grids import TermOrGrid
from derive.course.latex.letters import Letters
from derive.course.latex.tokens import Token, tokens_of
from derive.course.yaml_tree import Scalar
from derive.errors import Place, Rejected

MAX_SIDES = 40

Entries: TypeAlias = tuple[tuple[Expr, Dimension], ...]


@dataclass(frozen=True)
class Side:
    """One side of a chain: its entries row by row, separately for each branch; shape () is a scalar, (3, 1) a
    vector."""

    branches: tuple[Entries, ...]
    shape: tuple[int, ...]
    text: str
    place: Place = field(repr=False)


@dataclass(frozen=True)
class ReadMath:
    """The sides of a chain, and the relation sign before each side. The first sign is "" unless the formula begins with
    a relation sign."""

    sides: tuple[Side, ...]
    marks: tuple[str, ...]


def read_latex(
    scalar: Scalar, letters: Mapping[str, Declared], *, homogeneous: bool = True, in_prose: bool = False
) -> ReadMath:
    """Read the formula in the declared letters, or raise `Rejected` with the errors and their places.

    `homogeneous=False` is for a formula with numbers in place of letters, and for a formula that is known to be wrong.
    `in_prose=True` is for a formula of an author's text, which may have units, `\\infty`, and the relations `\\ll`,
    `\\gg` and `\\to`.
    """
    return _read(scalar, tuple(letters.items()), homogeneous, in_prose)


@lru_cache(maxsize=1024)  # a process may read the same formula several times
def _read(scalar: Scalar, declared: tuple[tuple[str, Declared], ...], homogeneous: bool, in_prose: bool) -> ReadMath:
    letters = dict(declared)
    plus = Formula(scalar, Letters(letters), homogeneous, in_prose)
    tokens = tokens_of(plus)
    sides, marks = _chain(plus, tokens)
    if not any(len(values) == 1 and branches == 2 for values, branches, *_ in sides):
        others = sides
    else:
        minus = Formula(scalar, Letters(letters), homogeneous, in_prose)
        minus.branch = 1
        others, _ = _chain(minus, tokens)
    return ReadMath(tuple(_side(plus, a, b) for a, b in zip(sides, others, strict=True)), tuple(marks))


ReadSide: TypeAlias = tuple[list[TermOrGrid], int, Token, Token]


def _chain(formula: Formula, tokens: tuple[Token, ...]) -> tuple[list[ReadSide], list[str]]:
    """Read every side; all undeclared letters are reported together, before other errors."""
    cursor = Cursor(_in_one_line(tokens), len(formula.text.rstrip()))
    try:
        found = formula.chain(cursor)
    except Rejected as error:
        raise Rejected([*formula.undeclared, *error.complaints]) from None
    if formula.undeclared:
        raise Rejected(dict.fromkeys(formula.undeclared))
    if len(found[0]) > MAX_SIDES:
        formula.refuse("too-large", f"a chain has at most {MAX_SIDES} sides", 0)
    return found


def _in_one_line(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    """Join the rows of an aligned chain: a row that begins with a relation or a sign continues the row before."""
    aligned = [token for token in tokens if token.kind != "cell"]
    kept: list[Token] = []
    for i, token in enumerate(aligned):
        following = aligned[i + 1] if i + 1 < len(aligned) else None
        goes_on = following is None or following.kind == "mark" or not kept or following.text in _CONTINUING
        if token.kind != "row" or not goes_on:
            kept.append(token)
    return tuple(kept)


_CONTINUING = {"le", "leq", "ge", "geq", "ne", "neq", "approx", "cdot", "times", "pm", "mp", "leqslant", "geqslant"}


def _side(formula: Formula, plus: ReadSide, minus: ReadSide) -> Side:
    values, branches, first, last = plus
    if branches == 2 and len(values) == 1:
        values = [values[0], minus[0][0]]
    shapes = {_shape(value) for value in values}
    start, end = first.start, last.end
    if len(shapes) > 1:
        formula.refuse("shape", "the two branches have different shapes", start, end)
    text = " ".join(formula.text[start:end].split())
    place = formula.scalar.place_within(start, end - start)
    return Side(tuple(_entries(value) for value in values), shapes.pop(), text, place)


def _shape(value: TermOrGrid) -> tuple[int, ...]:
    return () if isinstance(value, Term) else value.shape


def _entries(value: TermOrGrid) -> Entries:
    terms = [value] if isinstance(value, Term) else [term for row in value.rows for term in row]
    return tuple((term.expr, term.dimension) for term in terms)
