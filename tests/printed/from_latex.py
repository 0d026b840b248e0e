r"""A printed formula read back: our reader of LaTeX, and what pages print that no document is read in.

These are the names of vectors (`\bm`) and tensors (`\mathbf`), dyads, units, derivatives of what is named
(`\frac{dL}{dt}`, `\frac{d}{dt}(...)`), components and rates in the body, values at a place, integrals over a mass.
Sums, products, fractions, powers, functions and brackets are the reader's own, and so is what it refuses as ambiguous.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, MatrixBase

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import explicit
from derive.course.arithmetic import Term
from derive.course.latex.cursor import Cursor
from derive.course.latex.grammar import Formula
from derive.course.latex.grids import Grid, TermOrGrid, each
from derive.course.latex.integrals import bracket_of
from derive.course.latex.letters import Letter, Letters, letter_at, subscript_of
from derive.course.latex.reading import MAX_SIDES, _in_one_line
from derive.course.latex.titles import is_derivative
from derive.course.latex.tokens import Argument, Token, tokens_of
from derive.course.latex.vocabulary import RELATIONS
from derive.course.yaml_tree import Scalar, Source
from derive.render.notation.layout import Name
from tests.printed.meaning import differentiated, in_unit, over_the_mass, taken_at

STYLES = {"bm": "vector", "mathbf": "tensor"}
OVER_MASS = "over the mass"


class PrintedFormula(Formula):
    def __init__(
        self,
        scalar: Scalar,
        names: Mapping[Name, Any],
        dimensions: Mapping[Any, Dimension | None],
        bound: set[Any],
        positions: list[ImmutableDenseMatrix],
    ):
        super().__init__(scalar, Letters({}), homogeneous=False)
        self.names = {(n.base, _bare(n.subscript), n.dots, n.style): value for n, value in names.items()}
        self.known_dimensions = dimensions
        self.bound_letters = bound
        self.positions = positions
        self.d_is_a_letter = False

    def bound(self, start: int, end: int, size: int, terms: int) -> None:
        """A page may be as long as it likes."""

    # -- names and units ---------------------------------------------------------------------------------------

    def letter_or_axis(self, run: Cursor) -> TermOrGrid | None:
        if run.token and (figure := self.figure(run.token)) is not None:
            run.at += 1
            return figure
        letter = self.read_letter(run)
        if (
            letter is not None
            and letter.name == "e"
            and run.written == "^"
            and ("e", "", 0, "scalar") not in self.names
        ):
            self.euler = replace(self.euler, start=letter.start, end=letter.end)
            return self.euler
        return None if letter is None else self.value_of(letter)

    def letter(self, run: Cursor) -> Term | None:
        value = self.letter_or_axis(run)
        return None if value is None else self.scalar_in(value, "a letter")

    def read_letter(self, run: Cursor) -> Letter | None:
        token = run.token
        letter = letter_at(token)
        if token is None or letter is None or token.text in ("mathrm", "operatorname"):
            return None
        run.at += 1
        while run.written == "'":
            letter = replace(letter, base=letter.base + "'")
            run.at += 1
        if run.written == "_" and not letter.subscript:
            below = self.script(run)
            letter = replace(letter, subscript=subscript_of(below.tokens) or "?", end=below.end)
        return replace(letter, hat=token.text == "mathbf", vector=token.text == "bm")

    def value_of(self, letter: Letter) -> Any:
        style = "tensor" if letter.hat else "vector" if letter.vector else "scalar"
        key = letter.base, _bare(letter.subscript), letter.dots, style
        if key not in self.names:
            what = self.text[letter.start : letter.end]
            self.refuse("undeclared-symbol", f"`{what}` is no {style} of this line", letter.start, letter.end)
        value = self.names[key]
        if isinstance(value, MatrixBase):
            return self.grid(value, letter)
        dimension = self.known_dimensions.get(value) or NUMBER
        self.dimensions[value] = dimension
        return Term(value, dimension, letter.start, letter.end)

    def grid(self, matrix: Any, place: Any) -> Grid:
        rows = [
            tuple(Term(entry, NUMBER, place.start, place.end) for entry in matrix.row(i)) for i in range(matrix.rows)
        ]
        return Grid(tuple(rows), place.start, place.end)

    def begins_factor(self, run: Cursor) -> bool:
        token = run.token
        if token and token.kind == "command" and (token.text in ("mathrm", OVER_MASS) or self.figure(token)):
            return True
        return super().begins_factor(run)

    def is_plain(self, token: Token | None) -> bool:
        """The argument of a function is a scalar."""
        return not (token and token.text in STYLES) and super().is_plain(token)

    def unit(self, token: Token) -> Term:
        argument = token.arguments[0]
        assert argument is not None
        text = self.text[argument.start : argument.end].removeprefix("{").removesuffix("}")
        text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text).replace(r"{}^\circ", "deg").replace(r"\,", " ")
        return Term(in_unit(text), NUMBER, token.start, token.end)

    def figure(self, token: Token) -> Grid | None:
        r"""`\bm{0}` and `\mathbf{0}`, and the unit tensor: figures in bold."""
        if token.text not in STYLES or not token.arguments or not token.arguments[0]:
            return None
        figures = [t.text for t in token.arguments[0].tokens]
        if token.text == "bm" and figures == ["0"]:
            return self.grid(ImmutableDenseMatrix.zeros(3, 1), token)
        if token.text == "mathbf" and figures in (["0"], ["1"]):
            return self.grid(int(figures[0]) * ImmutableDenseMatrix.eye(3), token)
        return None

    def atom(self, run: Cursor, depth: int) -> TermOrGrid:
        token = run.token
        assert token is not None
        if token.kind == "command" and token.text == "mathrm":
            run.at += 1
            return self.unit(token)
        if token.text == OVER_MASS:
            run.at += 1
            inner = self.inside(token.arguments[0], depth)
            matrix = over_the_mass(_matrix(inner), self.positions[0])
            return self.grid(matrix, token)
        if is_derivative(token):
            run.at += 1
            return self.derivative(run, token, depth)
        return super().atom(run, depth)

    # -- derivatives -------------------------------------------------------------------------------------------

    def derivative(self, run: Cursor, token: Token, depth: int) -> TermOrGrid:
        above, below = token.arguments
        assert above and below
        of = Cursor(above.tokens[1:], above.end)
        order = self.order(of, depth)
        by = Cursor(below.tokens[1:], below.end)
        letter = self.read_letter(by)
        assert letter is not None
        name = "t" if letter.name == "t" else str(self.scalar_in(self.value_of(letter), "a letter").expr)
        if order != self.order(by, depth):
            self.refuse("latex", "the orders of this derivative differ", token.start, token.end)
        what = self.closed_sum(of, depth + 1) if of.token else self.factor(run, depth)
        for _ in range(order):
            what = self.derived(what, name)
        return what

    def order(self, run: Cursor, depth: int) -> int:
        return int(self.scalar_in(self.inside(self.script(run), depth), "an order").expr) if run.written == "^" else 1

    def derived(self, value: TermOrGrid, by: str) -> TermOrGrid:
        return each(value, lambda term: replace(term, expr=differentiated(explicit(term.expr), by), dimension=NUMBER))

    # -- scripts behind brackets -------------------------------------------------------------------------------

    def with_limits(self, run: Cursor, inner: TermOrGrid, first: int, depth: int) -> TermOrGrid:
        opening = run.tokens[first - 1]
        if opening.text == ".":
            script = Cursor.over(self.script(run))
            letter = self.letter(script)
            assert letter is not None and script.written == "="
            script.at += 1
            place = self.scalar_in(self.closed_sum(script, depth + 1), "a place")
            return each(inner, lambda t: replace(t, expr=taken_at(explicit(t.expr), letter.expr, explicit(place.expr))))
        if opening.text == "(" and run.written == "_":
            word = subscript_of(self.script(run).tokens)
            if word == "body":
                return each(inner, lambda t: replace(t, expr=_seen_in_the_body(t.expr)))
            assert isinstance(inner, Grid) and word in ("x", "y", "z")
            return inner.column["xyz".index(word)]
        assert run.token is not None
        lower, upper, _ = self.limits(run, depth, run.token)
        term = self.scalar_in(inner, "what stands before limits")
        found = [s for s in self.bound_letters if term.expr.has(s)]
        variable = Term(found[0], NUMBER, term.start, term.end) if len(found) == 1 else None
        return bracket_of(self, inner, lower, upper, variable, run.before.end)

    def raised(self, base: Term, exponent: Term) -> Term:
        """To any power: a page is not a file that must be refused before it grows."""
        return replace(base, expr=base.expr**exponent.expr, dimension=NUMBER, end=exponent.end, kind=None)

    # -- products ----------------------------------------------------------------------------------------------

    def product_of(self, left: TermOrGrid, right: TermOrGrid, sign: str) -> TermOrGrid:
        if sign == "" and isinstance(left, Grid) and isinstance(right, Grid) and left.is_vector and right.is_vector:
            rows = [tuple(self.scaled(a, b) for b in right.column) for a in left.column]
            return Grid(tuple(rows), left.start, right.end)  # a dyad
        return super().product_of(left, right, sign)


def _bare(subscript: str) -> str:
    return re.sub(r"[_,]", "", subscript)


def _seen_in_the_body(expr: Expr) -> Expr:
    """A rate as an observer in the body sees it: its letters are others than those of the rate in space."""
    names = {s: type(s)(s.name.replace("/d(t)", "/d(t in the body)"), real=True) for s in expr.free_symbols}
    return expr.xreplace(names)


def _matrix(value: TermOrGrid) -> Any:
    assert isinstance(value, Grid)
    return ImmutableDenseMatrix([[explicit(term.expr) for term in line] for line in value.rows])


def _over_masses(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    r"""`\int ... dm`, which has no limits, as one token."""
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        token = tokens[at]
        following = tokens[at + 1] if at + 1 < len(tokens) else None
        if token.text == "int" and token.kind == "command" and not (following and following.kind == "script"):
            end = next(i for i in range(at, len(tokens)) if [t.text for t in tokens[i : i + 2]] == ["d", "m"])
            inside = Argument(tokens[at + 1 : end], tokens[at + 1].start, tokens[end].start)
            kept.append(Token("command", OVER_MASS, token.start, tokens[end + 1].end, (inside,)))
            at = end + 2
        else:
            kept.append(
                replace(
                    token, arguments=tuple(a and replace(a, tokens=_over_masses(a.tokens)) for a in token.arguments)
                )
            )
            at += 1
    return tuple(kept)


NAMED = (
    r"(?:\\lvert .*?\\rvert (?:\^\{\d\})?|\\(?:bm|d*dot|math\w+)\{\\?\w+\}|\\[a-z]+|[A-Za-z])"
    r"'*(?:_\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\})?"
)
DERIVATIVE = re.compile(
    rf"(?<![\\\w])(?P<above>(?:d|\\partial )(?:\^\{{\d\}})?{NAMED})/(?P<below>(?:d|\\partial ){NAMED}(?:\^\{{\d\}})?)"
)
RATE_OF_ALL = re.compile(r"(?<![\\\w])d\((?P<of>[^()]*)\)/dt")


def read_printed(
    text: str,
    names: Mapping[Name, Any],
    dimensions: Mapping[Any, Dimension | None],
    bound: set[Any] = frozenset(),  # type: ignore[assignment]
    positions: list[Any] | None = None,
) -> tuple[list[list[Any]], list[str]]:
    """The sides of a printed chain, in each branch of its signs, and the marks between them."""
    text = RATE_OF_ALL.sub(r"\\frac{d}{dt}(\g<of>)", text)
    text = DERIVATIVE.sub(r"\\tfrac{\g<above>}{\g<below>}", text)
    branches: list[list[Any]] = []
    marks: list[str] = []
    for branch in (0, 1):
        scalar = Scalar(text, "", 0, len(text), Source("page.tex", text))
        formula = PrintedFormula(scalar, names, dimensions, bound, positions or [])
        formula.branch = branch
        run = Cursor(_over_masses(_in_one_line(tokens_of(formula))), len(text.rstrip()))
        sides, marks = [formula.sum(run, 0)], []
        while run.token and run.written in RELATIONS and len(sides) < MAX_SIDES:
            marks.append(RELATIONS[run.written])
            run.at += 1
            sides.append(formula.sum(run, 0))
        if run.token:
            formula.unexpected(run)
        branches.append([_matrix(side) if isinstance(side, Grid) else explicit(side.expr) for side in sides])
        if "\\pm" not in text:
            break
    return branches, marks
