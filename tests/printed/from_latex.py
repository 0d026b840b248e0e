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
from derive.course.latex.grids import Grid, TermOrGrid, each
from derive.course.latex.integrals import bracket_of
from derive.course.latex.reading import MAX_SIDES, chain_of, node_of
from derive.course.latex.values import Letters, Values
from derive.course.yaml_tree import Scalar, Source
from derive.documents.syntax import Condition, Der, Diff, EvalBar, Int, Letter, Node, Open, Sign, Text
from derive.render.notation.layout import Name
from tests.printed.meaning import differentiated, in_unit, over_the_mass, taken_at

STYLES = {"bm": "vector", "mathbf": "tensor"}
STYLED = re.compile(r"(?:\\d*dot\s*\{?\s*)*\\(bm|mathbf)\b")
UNIT = re.compile(r"(?<!_\{)(?<![A-Za-z0-9],)\\mathrm\{((?:[^{}]|\{[^{}]*\})*)\}")
UNIT_LETTER = "hbar"  # a letter that no page prints, for the units of the text


class PrintedValues(Values):
    def __init__(
        self,
        scalar: Scalar,
        names: Mapping[Name, Any],
        dimensions: Mapping[Any, Dimension | None],
        bound: set[Any],
        positions: list[ImmutableDenseMatrix],
        units: list[str],
        branch: int,
    ):
        super().__init__(scalar, Letters({}), homogeneous=False, branch=branch)
        self.names = {(n.base, _bare(n.subscript), n.dots, n.style): value for n, value in names.items()}
        self.known_dimensions = dimensions
        self.bound_letters = bound
        self.positions = positions
        self.units = units
        self.d_is_a_letter = False

    def bound(self, start: int, end: int, size: int, terms: int) -> None:
        """A page may be as long as it likes."""

    # -- names and units ---------------------------------------------------------------------------------------

    def of_letter(self, node: Letter) -> TermOrGrid:
        if node.base == UNIT_LETTER:
            return Term(in_unit(self.units[int(node.sub)]), NUMBER, node.span.start, node.span.end)
        styled = STYLED.match(self.written(node))
        style = STYLES[styled[1]] if styled else "scalar"
        if node.base in "01" and style != "scalar":
            matrix = ImmutableDenseMatrix.zeros(3, 1) if style == "vector" else ImmutableDenseMatrix.zeros(3, 3)
            return self.grid(ImmutableDenseMatrix.eye(3) if node.base == "1" else matrix, node)
        key = node.base + "'" * node.primes, _bare(node.sub), node.dots, style
        if node.base == "pi" and key not in self.names:
            return super().of_letter(node)
        if key not in self.names and style == "vector" and node.sub[-1:] in ("x", "y", "z"):
            vector = self.of_letter(replace(node, sub=node.sub[:-1].rstrip(",")))  # `(\bm{r}_{C})_{x}`
            assert isinstance(vector, Grid)
            return vector.column["xyz".index(node.sub[-1])]
        if key not in self.names:
            self.at(node, "undeclared-symbol", f"`{self.written(node)}` is no {style} of this line")
        value = self.names[key]
        if isinstance(value, MatrixBase):
            return self.grid(value, node)
        dimension = self.known_dimensions.get(value) or NUMBER
        self.dimensions[value] = dimension
        return Term(value, dimension, node.span.start, node.span.end)

    def is_euler(self, node: Letter) -> bool:
        return self.written(node) == "e" and ("e", "", 0, "scalar") not in self.names

    def grid(self, matrix: Any, node: Node) -> Grid:
        start, end = node.span.start, node.span.end
        rows = [tuple(Term(entry, NUMBER, start, end) for entry in matrix.row(i)) for i in range(matrix.rows)]
        return Grid(tuple(rows), start, end)

    def of_open(self, node: Open) -> TermOrGrid:
        """A letter before a bracket is a factor; a page writes no function by its argument."""
        return self.of(node.alternatives[1]) if node.kind == "apply" else super().of_open(node)

    # -- derivatives and integrals over a mass -----------------------------------------------------------------

    def of_der(self, node: Der) -> TermOrGrid:  # type: ignore[override]
        assert node.of is not None
        what = self.of(node.of)
        for letter, order in node.by:
            assert isinstance(letter, Letter)
            plain = letter.base == "t" and not letter.sub
            name = "t" if plain else str(self.scalar_in(self.of_letter(letter), "a letter").expr)
            for _ in range(order):
                what = self.derived(what, name)
        return what

    def derived(self, value: TermOrGrid, by: str) -> TermOrGrid:
        return each(value, lambda term: replace(term, expr=differentiated(explicit(term.expr), by), dimension=NUMBER))

    def integral(self, node: Int, outside: list[TermOrGrid]) -> TermOrGrid:
        first, *rest = node.items
        if not isinstance(first, Sign) or first.lower is not None:
            return super().integral(node, outside)
        end = next(i for i, item in enumerate(rest) if isinstance(item, Diff))
        inner, *factors = [self.of(item) for item in rest[:end]]
        for factor in factors:
            inner = self.product_of(inner, factor, "")
        whole: TermOrGrid = self.grid(over_the_mass(_matrix(inner), self.positions[0]), node)
        for item in rest[end + 1 :]:
            whole = self.product_of(whole, self.of(item), "")
        return whole

    # -- scripts behind brackets -------------------------------------------------------------------------------

    def of_evalbar(self, node: EvalBar) -> TermOrGrid:
        inner, lower, upper = self.of(node.inner), node.lower, node.upper
        if isinstance(lower, Condition) and upper is None:
            letter = self.scalar_of(lower.left, "a letter")
            place = self.scalar_of(lower.right, "a place")
            return each(inner, lambda t: replace(t, expr=taken_at(explicit(t.expr), letter.expr, explicit(place.expr))))
        if isinstance(lower, Text) and upper is None:
            if lower.text == "body":
                return each(inner, lambda t: replace(t, expr=_seen_in_the_body(t.expr)))
            assert isinstance(inner, Grid) and lower.text in ("x", "y", "z")
            return inner.column["xyz".index(lower.text)]
        start, end, _ = self.limits(lower, upper, node)
        term = self.scalar_in(inner, "what stands before limits")
        found = [s for s in self.bound_letters if term.expr.has(s)]
        variable = Term(found[0], NUMBER, term.start, term.end) if len(found) == 1 else None
        return bracket_of(self, inner, start, end, variable, node.span.end)

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


def _unit(text: str) -> str:
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    return text.replace(r"{}^\circ", "deg").replace(r"\,", " ")


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
    text = RATE_OF_ALL.sub(r"\\frac{d}{dt}(\g<of>)", text)
    text = DERIVATIVE.sub(r"\\tfrac{\g<above>}{\g<below>}", text)
    units: list[str] = []

    def as_letter(found: re.Match[str]) -> str:
        units.append(_unit(found[1]))
        return rf"\{UNIT_LETTER}_{{{len(units) - 1}}}"

    text = UNIT.sub(as_letter, text)
    branches: list[list[Any]] = []
    marks: list[str] = []
    for branch in (0, 1):
        scalar = Scalar(text, "", 0, len(text), Source("page.tex", text))
        reader = PrintedValues(scalar, names, dimensions, bound, positions or [], units, branch)
        sides, marks = chain_of(reader)
        values = [reader.of(node_of(reader, tokens)) for (tokens,) in sides]
        assert len(values) <= MAX_SIDES
        branches.append([_matrix(side) if isinstance(side, Grid) else explicit(side.expr) for side in values])
        if "\\pm" not in text:
            break
    return branches, marks[1:]
