"""What `derive` prints it can read: formulas drawn at random, and every line of a worked problem."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import E, Expr, I, MatrixBase, MatrixExpr, MatrixSymbol, Pow, Rational, Symbol, cos, pi, sin, sqrt

from derive.algebra.equality import Grade, equal
from derive.algebra.expansion import Expansion
from derive.algebra.expressions import (
    PLUS_MINUS,
    Amount,
    Bracket,
    Factors,
    MatrixAmount,
    Ratio,
    Relation,
    Terms,
    explicit,
    is_matrix,
)
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.ranges import within
from derive.algebra.rounding import Rounded
from derive.course.arithmetic import Declared
from derive.course.latex import read_latex
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Rejected
from derive.render.notation.latex import latex
from derive.render.notation.layout import layout_of_name
from derive.render.notation.notation import Notation
from tests.course.latex.formula import KINDS, LETTERS
from tests.mechanics.block import known_block
from tests.printed.test_levels import PROBLEMS, steps_of

NOTATION = Notation({known.symbol: dimension_of_kind(known.kind) for known in LETTERS.values()})
NUMBERS = {name: Declared(name, known.symbol, "number") for name, known in LETTERS.items()}


def read_back(printed: str, letters: dict[str, Declared]) -> Any:
    scalar = Scalar(printed, "", 0, len(printed), Source("f.yaml", printed))
    (side,) = read_latex(scalar, letters, homogeneous=False).sides
    ((*entries,),) = side.branches
    values = [expr for expr, _ in entries]
    return values[0] if not side.shape else values


letters = st.sampled_from([NUMBERS[name].symbol for name in ("a", "b", "M", "theta", "omega_x", "I_zz")])
numbers = st.integers(1, 40).map(Rational) | st.fractions(1, 9, max_denominator=12).map(Rational)
leaves = letters | numbers
angles = st.sampled_from([NUMBERS["theta"].symbol, 2 * NUMBERS["theta"].symbol, NUMBERS["phi"].symbol / 2 + pi])


def larger(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    pairs = st.tuples(inner, inner)
    return st.one_of(
        pairs.map(lambda p: p[0] + p[1]),
        pairs.map(lambda p: p[0] - p[1]),
        pairs.map(lambda p: p[0] * p[1]),
        pairs.map(lambda p: p[0] / p[1] if p[1] != 0 else p[0]),
        st.tuples(inner, st.sampled_from([2, 3, -1])).map(lambda p: p[0] ** p[1] if p[0] != 0 else p[0]),
        inner.map(lambda e: sqrt(e**2 + 2)),
        st.tuples(inner, angles).map(lambda p: p[0] * sin(p[1])),
        st.tuples(inner, angles).map(lambda p: p[0] + cos(p[1]) ** 2),
        pairs.map(lambda p: Factors(*p)),
        pairs.map(lambda p: Terms(*p)),
        pairs.map(lambda p: Ratio(*p) if explicit(p[1]) != 0 else p[0]),
    )


@given(st.recursive(leaves, larger, max_leaves=8))
@settings(max_examples=150, deadline=None)
def test_a_printed_formula_reads_back_as_itself(expr: Expr) -> None:
    assume(all(abs(power.exp) <= 12 for power in explicit(expr).atoms(Pow) | expr.atoms(Pow)))
    printed = latex(NOTATION.layout(expr))
    assume(not re.search(r"\d{31}", printed))  # more digits than a number may have
    assert equal(read_back(printed, NUMBERS), expr), printed


def plain(value: Any) -> bool:
    """Whether a line is made of letters only: names of vectors and tensors, and units, are not read."""
    if isinstance(value, MatrixBase):
        return all(plain(entry) for entry in value)
    return not (is_matrix(value) or value.has(MatrixSymbol, MatrixExpr, Amount, MatrixAmount, Relation))


def as_printed(letter: Any) -> str:
    name = layout_of_name(str(letter))
    return f"{name.base}_{name.subscript}" if name.subscript and not name.dots else str(letter)


LINES = [
    pytest.param(form.expr, id=f"{key}-{n}")
    for key, quantity in known_block().items()
    for n, form in enumerate(quantity.step.chain)
    if plain(form.expr)
]


@pytest.mark.parametrize("line", LINES)
def test_a_line_of_the_worked_block_reads_back_as_itself(line: Any) -> None:
    bound = {str(x) for integral in line.atoms(Bracket) for x in [integral.args[1]]} | {"x", "y", "z"}
    letters = {name: Symbol(name, real=True) for name in bound | set(KINDS)}
    letters |= {as_printed(letter): letter for letter in line.free_symbols}
    declared = {name: Declared(name, letter, "number") for name, letter in letters.items()}
    found = read_back(latex(NOTATION.result(line)), declared)
    wanted = list(explicit(line)) if isinstance(line, MatrixBase) else [explicit(line)]
    for mine, theirs in zip(found if isinstance(found, list) else [found], wanted, strict=True):
        assert equal(mine, theirs)


def test_the_block_has_lines_of_every_kind() -> None:
    assert len(LINES) > 60


def is_of_letters(value: Any) -> bool:
    """Whether a line is exact, of letters only, without integrals and without roots of what may be negative."""
    if not plain(value) or value.has(Expansion, Rounded, I, PLUS_MINUS):
        return False
    roots = [power.base for power in explicit(value).atoms(Pow) if not power.exp.is_integer and power.base != E]
    return all(base.is_nonnegative for base in roots)


@pytest.mark.parametrize("problem_id", PROBLEMS)
def test_every_line_of_a_problem_is_read_back_or_refused_and_never_misread(problem_id: str) -> None:
    problem, solved = steps_of(problem_id)
    lines = [form.expr for step in solved.derivation.steps for form in step.chain if is_of_letters(form.expr)]
    misread = []
    for line in dict.fromkeys(lines):
        letters = {str(bracket.args[1]): bracket.args[1] for bracket in line.atoms(Bracket)}
        letters |= {as_printed(letter): letter for letter in line.free_symbols}
        declared = {name: Declared(name, letter, "number") for name, letter in letters.items()}
        printed = latex(Notation({}).result(line))
        if r"\int" in printed:
            continue
        try:
            found = read_back(printed, declared)
        except Rejected:  # derivatives, rates of letters that the line does not have, primes
            continue
        wanted = list(explicit(line)) if isinstance(line, MatrixBase) else [explicit(line)]
        found = found if isinstance(found, list) else [found]
        pairs = [(explicit(mine), theirs) for mine, theirs in zip(found, wanted, strict=True)]
        with within(problem.ranges):
            refuted = [mine != theirs and equal(mine, theirs).grade is Grade.REFUTED for mine, theirs in pairs]
        misread += [printed] * any(refuted)
    assert misread == []
