r"""`read_latex` reads a formula in LaTeX as a chain of values.

13 M a^2/12                  one side
\frac{26}{6} a^2 (6a^3\rho) = \frac{13}{3} M a^2      two sides, and the sign `=` between them
\frac{b \pm \sqrt{c}}{2}     one side with two branches: every `\pm` is + in the first, - in the second
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TypeAlias

from sympy import Expr

from derive.algebra.dimensions import Dimension
from derive.course.arithmetic import Declared, Term
from derive.course.latex.grids import TermOrGrid
from derive.course.latex.strict import checked_tokens
from derive.course.latex.values import Letters, Values, is_dotted, is_fraction_of_numbers
from derive.course.latex.vocabulary import ALIGNMENTS, RELATIONS, RELATIONS_IN_PROSE, WORDS
from derive.course.yaml_tree import Scalar
from derive.documents.layout import depths
from derive.documents.macros import argument_at
from derive.documents.parser import Unreadable, parsed
from derive.documents.syntax import Apply, Der, Letter, Mul, Node, Num, Open
from derive.documents.tokens import Kind, Token
from derive.errors import Place, Rejected

MAX_SIDES = 40

Entries: TypeAlias = tuple[tuple[Expr, Dimension], ...]


@dataclass(frozen=True)
class Side:
    """One side of a chain. Each branch lists the entries row by row. The shape is () for a scalar, and (3, 1) for a
    vector."""

    branches: tuple[Entries, ...]
    shape: tuple[int, ...]
    text: str
    place: Place = field(repr=False)


@dataclass(frozen=True)
class ReadMath:
    """The sides of a chain, and the relation sign before each side."""

    sides: tuple[Side, ...]
    marks: tuple[str, ...]


def read_latex(
    scalar: Scalar, letters: Mapping[str, Declared], *, homogeneous: bool = True, in_prose: bool = False
) -> ReadMath:
    """Read the formula in the declared letters, or raise `Rejected` with the errors and their places.

    homogeneous   whether dimensions are compared; false, for example, for a formula with numbers in place of letters
    in_prose      whether the formula may have units, `\\infty`, and the relations `\\ll`, `\\gg` and `\\to`
    """
    return _read(scalar, tuple(letters.items()), homogeneous, in_prose)


@lru_cache(maxsize=1024)  # a process may read the same formula several times
def _read(scalar: Scalar, declared: tuple[tuple[str, Declared], ...], homogeneous: bool, in_prose: bool) -> ReadMath:
    letters = Letters(dict(declared))
    plus, minus = (Values(scalar, letters, homogeneous, in_prose, branch) for branch in (0, 1))
    sides, marks = chain_of(plus)
    found: list[Side | None] = []
    try:
        for alternatives in sides:
            nodes = [node_of(plus, tokens) for tokens in alternatives]
            if not found and marks[1:2] in (["="], ["~"]) and is_title(nodes[0]):
                found.append(None)
                continue
            plus.branches = 1
            values = [plus.of(node) for node in nodes]
            if plus.branches == 2 and len(values) == 1:
                values.append(minus.of(nodes[0]))
            elif plus.branches + len(values) > 3 or len(values) > 2:
                plus.at(nodes[0], "latex", "a value can have at most two alternatives, from one `or` or from `\\pm`")
            found.append(_side(plus, values, alternatives))
    except Rejected as error:
        raise Rejected([*dict.fromkeys(plus.undeclared), *error.complaints]) from None
    if plus.undeclared:
        raise Rejected(dict.fromkeys(plus.undeclared))
    kept = [(side, mark) for side, mark in zip(found, marks, strict=True) if side is not None]
    return ReadMath(tuple(side for side, _ in kept), tuple(mark for _, mark in kept))


def node_of(reader: Values, tokens: list[Token]) -> Node:
    try:
        return parsed(tokens)
    except Unreadable as error:
        reader.refuse("latex", error.message, error.span.start, error.span.end)


def is_title(node: Node) -> bool:
    r"""Return whether a first side is only a name for the value of the next side: `U(\theta) =`, `U'' =`, `\frac{1}{2}
    \frac{d}{dt} L^2 =`."""
    if isinstance(node, Mul):
        *numbers, (_, node) = node.factors
        if not all(isinstance(each, Num) or is_fraction_of_numbers(each) for _, each in numbers):
            return False
    if isinstance(node, Der):
        return not is_dotted(node)
    if isinstance(node, Letter):
        return node.primes > 0
    call = node.alternatives[0] if isinstance(node, Open) and node.kind == "apply" else node
    if not isinstance(call, Apply):
        return False
    arguments = [getattr(each, "left", each) for each in call.arguments]
    return all(isinstance(each, Letter) for each in arguments)


def chain_of(reader: Values) -> tuple[list[list[list[Token]]], list[str]]:
    """Return the tokens of every side, with its alternatives `a or b`, and the relation before each side."""
    known = RELATIONS_IN_PROSE if reader.in_prose else RELATIONS
    tokens = _in_one_line(reader, checked_tokens(reader))
    sides: list[list[list[Token]]] = [[[]]]
    marks = [""]
    skip = 0
    for at, (token, depth) in enumerate(depths(tokens)):
        if at < skip:
            continue
        mark = known.get(f"\\{token.text}" if token.kind is Kind.COMMAND else token.text) if depth == 0 else None
        if mark is not None and token.kind in (Kind.MARK, Kind.COMMAND):
            if not sides[-1][-1]:
                if len(sides) > 1 or len(sides[0]) > 1 or marks[0]:
                    reader.refuse("latex", f"something is missing before `{token.text}`", token.span.start)
                marks[0] = mark
                continue
            marks.append(mark)
            sides.append([[]])
        elif depth == 0 and token.is_command(*WORDS) and _word(tokens, at) == "or":
            skip = argument_at(tokens, at + 1)[1]
            sides[-1].append([])
        else:
            sides[-1][-1].append(token)
    if len(sides) > MAX_SIDES:
        reader.refuse("too-large", f"a chain has at most {MAX_SIDES} sides", 0)
    if any(not alternative for side in sides for alternative in side):
        where = "at the end" if not sides[-1][-1] else "before or after `or`"
        reader.refuse("latex", f"something is missing {where}", len(reader.text.rstrip()) - 1)
    return sides, marks


def _word(tokens: list[Token], at: int) -> str:
    return "".join(each.text for each in argument_at(tokens, at + 1)[0])


def _in_one_line(reader: Values, tokens: list[Token]) -> list[Token]:
    """Join the rows of an aligned chain. A row that begins with a relation or a sign continues the row before."""
    aligned: list[Token] = []
    inside = at = 0
    while at < len(tokens):
        token = tokens[at]
        if token.is_command("begin", "end"):
            after = argument_at(tokens, at + 1)[1]
            if _word(tokens, at) in ALIGNMENTS:
                at = (
                    argument_at(tokens, after)[1]
                    if _word(tokens, at) == "alignedat" and token.text == "begin"
                    else after
                )
                continue
            inside += 1 if token.text == "begin" else -1
        if inside or token.kind is not Kind.CELL:
            aligned.append(token)
        at += 1
    kept: list[Token] = []
    for i, token in enumerate(aligned):
        inside += token.is_command("begin") - token.is_command("end")
        following = aligned[i + 1] if i + 1 < len(aligned) else None
        if inside or not token.is_command("\\", "cr"):
            kept.append(token)
        elif kept and following is not None and following.kind is not Kind.MARK and following.text not in _CONTINUING:
            reader.refuse("latex", "only one formula can be read at a time", token.span.start, token.span.end)
    return kept


_CONTINUING = {"le", "leq", "ge", "geq", "ne", "neq", "approx", "cdot", "times", "pm", "mp", "leqslant", "geqslant"}


def _side(reader: Values, values: list[TermOrGrid], alternatives: list[list[Token]]) -> Side:
    start, end = alternatives[0][0].span.start, alternatives[-1][-1].span.end
    shapes = {_shape(value) for value in values}
    if len(shapes) > 1:
        reader.refuse("shape", "the two branches have different shapes", start, end)
    text = " ".join(reader.text[start:end].split())
    place = reader.scalar.place_within(start, end - start)
    return Side(tuple(_entries(value) for value in values), shapes.pop(), text, place)


def _shape(value: TermOrGrid) -> tuple[int, ...]:
    return () if isinstance(value, Term) else value.shape


def _entries(value: TermOrGrid) -> Entries:
    terms = [value] if isinstance(value, Term) else [term for row in value.rows for term in row]
    return tuple((term.expr, term.dimension) for term in terms)
