"""Tests of displays as LaTeX for other documents."""

from __future__ import annotations

from sympy import Add, ImmutableMatrix, Symbol

from derive.page.chain_lines import ChainLine, Equations
from derive.page.numbering import Number
from derive.page.tree import Display
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import display_latex

a, b, c = (Symbol(name, positive=True) for name in "abc")


def display(*lines: ChainLine, framed: int = 0) -> Display:
    return Display((Equations("step", lines, Number(4), framed),))


def test_one_row_is_a_formula_without_alignment() -> None:
    assert display_latex(display(ChainLine(a, "equals", b)), Notation()) == "a = b."


def test_a_matrix_before_the_relation_of_one_row_stays_a_matrix() -> None:
    shown = display_latex(display(ChainLine(ImmutableMatrix([[a, b], [b, a]]), "equals", c)), Notation())
    assert shown == r"{\begin{pmatrix} a & b \\ b & a \end{pmatrix}} = c."


def test_several_rows_are_aligned_at_their_relations() -> None:
    long = sum((Symbol(f"x_{i}", positive=True) for i in range(30)), a)
    shown = display_latex(display(ChainLine(a, "equals", long), ChainLine(None, "equals", b)), Notation())
    assert shown.startswith("\\begin{aligned}") and shown.count("&=") == 2 and shown.endswith("\\end{aligned}")


def test_an_answer_is_boxed_and_its_number_is_told_if_it_is_wanted() -> None:
    answer = display(ChainLine(a, "equals", b), ChainLine(None, "equals", c), framed=1)
    assert display_latex(answer, Notation(), numbered=True) == (
        "\\begin{aligned}\na &= b \\\\\n&\\boxed{a = c}\\qquad(4)\n\\end{aligned}"
    )


def test_an_answer_that_is_all_of_its_row_is_boxed_with_its_left_side() -> None:
    assert display_latex(display(ChainLine(a, "equals", b), framed=1), Notation()) == r"\boxed{a = b}"


def test_one_box_is_around_all_lines_of_an_answer() -> None:
    terms = [Symbol(f"{'abcdefgh'[i]}_{'mnopqrst'[i] * 12}") for i in range(8)]
    answer = display(ChainLine(a, "equals", Add(*terms)), framed=1)
    shown = display_latex(answer, Notation())
    assert shown.count(r"\boxed") == 1
    assert shown.startswith(r"\boxed{\begin{aligned}" + "\na &= ")
    assert r" \\" + "\n&" in shown
    chain = display(ChainLine(a, "equals", b), ChainLine(None, "equals", Add(*terms)), framed=1)
    assert "a &= b" in (found := display_latex(chain, Notation()))
    assert r"&\boxed{\begin{aligned}" + "\na &= " in found
