"""Tests of a problem in the report: the rows of steps, and quotations of the source."""

from __future__ import annotations

from dataclasses import replace

from derive.algebra.equality import Grade
from derive.algebra.expressions import column
from derive.course.reference.errata import Erratum
from derive.course.reference.quotes import Remark
from derive.page.checks import Checks, Row
from derive.render.printing.report_page import ReportPage
from tests.render.pages import NOTATION, WHOLE, WORDS, M, a

ROWS = (
    Row(("energy",), (), "test.kinetic_energy", Grade.PROVED, 3, ("by halves",), ()),
    Row(("law", "mass"), ("energy",), "numeric.value", Grade.DEFINITION, 0, (), ("its sign",)),
)
SLIP = Erratum("energy", "2", "a slip in $M a$", M * a, M * a**2)


def page(errata: tuple[Erratum, ...] = (), remarks: tuple[Remark, ...] = ()) -> ReportPage:
    checks = Checks({}, {}, {}, {}, ROWS, 0, 0, errata, remarks)
    return ReportPage(replace(WHOLE, checks=checks), WORDS, NOTATION)


def test_a_step_is_told_by_its_symbol_and_the_number_of_its_equation() -> None:
    one, several = (page().steps(row) for row in ROWS)
    assert "T" in one and one.endswith(rf"~\eqnumber{{{WHOLE.numbers['energy']}}}")
    assert several.count(", ") == 1


def test_a_step_without_either_is_told_by_the_equations_that_it_comes_from() -> None:
    from_an_equation = Row(("law",), ("mass", "energy"), "answers.put_in", Grade.PROVED, 1, (), ())
    assert page().steps(from_an_equation) == r"from \eqnumber{1}, \eqnumber{2}"
    from_a_letter = ReportPage(replace(WHOLE, numbers={}), WORDS, NOTATION)
    assert from_a_letter.steps(from_an_equation).startswith("from ")
    assert "T" in from_a_letter.steps(from_an_equation)
    assert page().steps(replace(from_an_equation, made_from=("law",))) == ""


def test_what_a_step_is_goes_by_its_rule_unless_the_phrases_know_better() -> None:
    assert [page().what(row) for row in ROWS] == ["kinetic energy", "number"]


def test_what_was_not_proved_stands_out() -> None:
    assert [page().grade(row) for row in ROWS] == ["proved", r"\textbf{by definition}"]


def test_an_erratum_is_quoted_where_it_was_transcribed_as_printed() -> None:
    quoted = replace(SLIP, quote=r"$\frac{13}{22}$", instead=r"$\frac{13}{12}$")
    assert page().printed(quoted) == r"\fitto{\linewidth}{\frac {13}{22}}"
    assert page().right(quoted) == r"\fitto{\linewidth}{\frac {13}{12}}"


def test_else_it_is_told_in_our_letters() -> None:
    assert (page().printed(SLIP), page().right(SLIP)) == ("$T = Ma$", "$T = Ma^{2}$")
    law = Erratum("law", None, "a sign", M - a, M + a)
    assert page().printed(law) == "$M-a = 0$", "an equation is stated by what vanishes in it"
    vector = Erratum("mass", None, "swapped", column(a, 0, 0), column(0, a, 0))
    assert page().printed(vector).replace(r"\left", "").startswith("$M = (a")


def test_words_of_a_quotation_are_escaped_and_its_formulas_are_not() -> None:
    assert page().quoted("100% of $M a$") == r"100{\%} of $M a$"
