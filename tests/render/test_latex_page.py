"""Tests of pages as LaTeX: escaped text, references to equations, and sheets without answers."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from sympy import Integer, symbols

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import column
from derive.course.names import EvidenceShown
from derive.page.chain_lines import ChainLine, Equations
from derive.page.template import Templates, templates_of
from derive.page.tree import Document, Paragraph
from derive.page.wording import DimensionMark, DisplayedMath, FigureRef, NewParagraph, Text, ToldIn, ToldOnce, UnitMark
from derive.render.printing.latex_page import (
    Fragments,
    LatexPage,
    Passage,
    dotted,
    passages_of,
    problem_latex,
    whole_latex,
)
from tests.courses import ROOT
from tests.render.pages import NOTATION, VECTORS, WHOLE, WORDS, M, T, a, display, page

TEMPLATES = templates_of(ROOT)


def fragments(document: Document) -> Fragments:
    return problem_latex(document, WORDS, NOTATION, TEMPLATES)


def chain(tex: str) -> list[str]:
    return re.split(r"\\chain(?:goeson)?\{\n", tex)[1].partition("\n}\n")[0].splitlines()


def solution(document: Document) -> str:
    return str(fragments(document).solution)


def test_text_is_escaped_wherever_it_stands() -> None:
    evil = (Text(r"50% & \input{x}"),)
    document = page(title=evil, statement=evil, note=evil, closing=evil)
    assert r"\input" not in "".join((fragments(document).title, solution(document), fragments(document).sheet))
    assert solution(document).count(r"50{\%} {\&}") == 3
    assert r"Both {\&} true." in solution(WHOLE)


def test_every_number_is_an_anchor_and_every_reference_leads_to_one() -> None:
    tex = solution(WHOLE)
    anchors = re.findall(r"\\anchor\{([^}]*)\}", tex)
    assert anchors == ["hw9.one.1", "hw9.one.2"]
    assert set(re.findall(r"\\hyperlink\{([^}]*)\}", tex)) <= set(anchors)
    assert r"\hyperlink{hw9.one.1}{\eqnumber{1}}" in tex
    assert r"\problemlink{hw9.two}{Problem 2}" in tex
    assert dotted("hw9/one") == "hw9.one"


def test_the_sheet_has_the_questions_and_nothing_that_is_derived() -> None:
    sheet = str(fragments(WHOLE).sheet)
    assert "Find $T$ as in part (a)" in sheet, "an equation is referred to by the part that asks for it"
    assert not re.search(r"hyperlink|chain|frame|halves|gap|every step", sheet)


def test_the_strategy_stands_between_the_statement_and_the_first_part() -> None:
    tex = solution(WHOLE)
    assert tex.index(r"\end{statement}") < tex.index(r"\strategy{Strategy.}{Mind every step.}") < tex.index(r"\ask{a}")
    assert r"\strategy" not in solution(page())


def test_limiting_cases_stand_behind_the_parts_without_a_letter_of_their_own() -> None:
    tex = solution(WHOLE)
    heading = tex.index(r"\closinghead{Limiting cases}")
    assert tex.index(r"\ask{a}") < heading < tex.index("A light one flies.") < tex.index(r"\closing{")
    assert r"\closinghead" not in solution(page()) and "flies" not in str(fragments(WHOLE).sheet)


def test_a_part_beyond_the_homework_is_marked_on_the_page_and_on_the_sheet() -> None:
    extra = replace(page(), parts=(replace(page().parts[0], points=None, extra=True),))
    assert r"}{extra, no points}" in solution(extra) and r"}{extra, no points}" in str(fragments(extra).sheet)
    assert "extra" not in solution(page())


def test_a_page_does_not_end_within_a_step() -> None:
    first, between, second, within, third = chain(solution(page(display("mass", "energy"))))
    assert (between, within) == (r"\nextstep", r"\samestep")
    assert r"\eqnumber{1}" in first and r"\anchor" not in second and r"\anchor{hw9.one.2}\eqnumber{2}" in third


def test_a_page_does_not_part_a_few_equations_of_one_row_each() -> None:
    def between(count: int) -> set[str]:
        groups = tuple(Equations("mass", (ChainLine(T, "equals", a**i),), i) for i in range(1, count + 1))
        return set(chain(solution(page(replace(display("mass"), groups=groups))))[1::2])

    assert between(3) == {r"\samestep"} and between(9) == {r"\nextstep"}


def test_a_theorem_says_which_it_is_and_what_stands_for_it_later_in_the_document() -> None:
    told = ToldOnce("inertia", (Text("Bodies persist."),), (Text("See "), ToldIn("Problem")))
    assert r"\theorem{inertia}{Bodies persist.\par}{See \toldproblem{Problem}\ }" in solution(page(Paragraph((told,))))


def test_a_page_may_end_in_the_middle_of_a_long_step_but_not_before_its_last_row() -> None:
    lines = tuple(ChainLine(T if i == 0 else None, "equals", a**i, (Text("why"),)) for i in range(8))
    rows = chain(solution(page(replace(display("mass"), groups=(Equations("mass", lines, 1),)))))
    assert [row for row in rows if "row" not in row] == [r"\samestep", *[r"\inlongstep"] * 5, r"\samestep"]


def test_a_left_side_that_takes_two_rows_is_not_aligned_at_a_relation() -> None:
    long = sum((a**i * T for i in range(1, 40)), T)
    line = ChainLine(long, "equals", Integer(0))
    rows = chain(solution(page(replace(display("mass"), groups=(Equations("mass", (line,), 1),)))))
    assert rows[0].startswith(r"\brokenrow")
    assert [row for row in rows if row.startswith(r"\brokenrow")] == rows[:1]
    short = ChainLine(T, "equals", Integer(0))
    rows = chain(solution(page(replace(display("mass"), groups=(Equations("mass", (short,), 1),)))))
    assert rows[0].startswith(r"\row")


def test_a_page_rarely_ends_within_the_words_before_a_display() -> None:
    tex = solution(page(Paragraph((Text("So "),)), display("mass"), Paragraph((Text("Then it stops."),))))
    assert r"\todisplay{So }" in tex and r"\todisplay{Then" not in tex


def test_the_margin_names_a_route_only_if_there_is_room_for_it() -> None:
    short, long = (
        solution(page(display("mass", routes=(route,)), evidence=EvidenceShown.MARGIN))
        for route in ("by halves", "round and round " * 9)
    )
    assert "second route: by halves" in short
    assert r"\checkeddisplay{proved}" in long and "round and round" not in long


@pytest.mark.parametrize("evidence", [EvidenceShown.NONE, EvidenceShown.END])
def test_the_margin_is_empty_unless_it_is_asked_for(evidence: EvidenceShown) -> None:
    shown = solution(page(Paragraph((Text("So "),)), display("mass", routes=("by halves",)), evidence=evidence))
    assert r"\checked" not in shown and "by halves" not in shown


@pytest.mark.parametrize(
    ("node", "tex"),
    [
        (UnitMark("N m"), r"$\mathrm{N\,m}$"),
        (DimensionMark(Dimension(1, 2, -2)), r"$\mathsf{M L^{2} T^{-2}}$"),
        (DimensionMark(Dimension(0, 0, 0)), "$1$"),
    ],
)
def test_units_and_dimensions_stand_upright(node: DimensionMark | UnitMark, tex: str) -> None:
    assert tex in solution(page(note=(node,)))


def test_two_vectors_of_an_answer_share_a_row_a_frame_and_a_number() -> None:
    line = ChainLine(T, "equals", column(a, 0, 0), ())
    both = Equations("mass", (line,), 1, framed=1).beside(Equations("time", (line,), 1, framed=1))
    (row,) = chain(solution(page(replace(display("mass"), groups=(both,)))))
    assert (row.count(r"\framedrow"), row.count(r"\eqnumber"), row.count("pmatrix")) == (1, 1, 4)


def test_a_drawing_takes_the_sentences_before_it_and_after_it() -> None:
    words = [Paragraph((Text(word),)) for word in "abcd"]
    shown, goes_on = display("mass"), display("mass", end=",")
    found = passages_of((words[0], goes_on, words[1], VECTORS, VECTORS, words[2], words[3], shown, VECTORS, shown))
    assert [(p.before, len(p.drawings), p.after) for p in found] == [
        (((words[0], goes_on, words[1]),), 2, ((words[2],),)),
        (((words[3], shown),), 1, ((shown,),)),
    ]
    assert passages_of((shown,)) == [Passage(((shown,),))]


def framed(*lines: ChainLine) -> list[str]:
    return chain(solution(page(replace(display("mass"), groups=(Equations("mass", lines, 1, framed=1),)))))


def test_a_result_is_framed_as_a_complete_equation() -> None:
    assert framed(ChainLine(T, "equals", M * a)) == [r"\framedrow{T}{T = Ma}{}{}{\anchor{hw9.one.1}\eqnumber{1}}"]
    law, answer = framed(ChainLine(T, "equals", M + a), ChainLine(None, "equals", M * a))[::2]
    assert law == r"\row{T}{= M+a}{}{}{}"
    assert answer == r"\framedrow{T}{T = Ma}{}{}{\anchor{hw9.one.1}\eqnumber{1}}"


def listed(*steps: Equations) -> str:
    return "\n".join(chain(solution(page(replace(display("mass"), groups=steps)))))


def test_answers_one_after_the_other_are_in_one_frame_and_have_a_number_each() -> None:
    T_is_a, M_is_a = (ChainLine(left, "equals", a) for left in (T, M))
    first, second = Equations("one", (T_is_a,), 1, framed=1), Equations("two", (M_is_a,), 2, framed=1)
    tex = listed(first, second)
    assert tex.startswith("\\framedlist{")
    assert [tex.count(each) for each in ("framedrow", r"\listrow", r"\nextlistrow", r"\eqnumber")] == [0, 2, 1, 2]
    assert r"\listrow{T}{= a}{}{" in tex and r"\listrow{M}{= a}{}{" in tex and tex.endswith("}{}")
    assert listed(first, replace(second, framed=0)).count("list") == 0
    law = (ChainLine(M, "equals", a + T), replace(M_is_a, left=None))
    assert listed(first, replace(second, lines=law)).startswith("\\row{M}{= T+a}{}{}{}\n\\samestep\n\\framedlist{")


def test_words_may_be_in_the_first_row_of_an_answer_that_begins_with_its_law() -> None:
    law, result = ChainLine(T, "equals", M + a), ChainLine(None, "equals", M * a)
    shown = replace(display("mass"), groups=(Equations("mass", (law, result), 1, framed=1),))
    said = [Paragraph((Text("The tension is"),)), shown]
    assert r"\wordstodisplay{The tension is}" in solution(page(*said))
    assert r"\todisplay{The tension is}" in solution(page(said[0], display("mass", framed=1)))
    assert r"\todisplay{The tension is}" in solution(page(*said, evidence=EvidenceShown.MARGIN))
    assert r"\todisplay{so " in solution(page(Paragraph((Text("so "), DisplayedMath(a))), shown))


def test_a_long_result_is_in_one_frame_of_several_lines() -> None:
    terms = sum(symbols("b_:40", positive=True))
    (alone,) = framed(ChainLine(T, "equals", terms))
    first, _, goes_on = framed(ChainLine(T, "equals", M * a, (Text("why"),)), ChainLine(None, "equals", terms))
    assert alone.startswith(r"\framedrow{T}{\begin{aligned}T &= b_{0}") and "b_{39}" in alone
    assert alone == goes_on and "framed" not in first and alone.count(r"\\") >= 1


def test_a_whole_document_has_the_facts_that_its_template_asks_for(tmp_path: Path) -> None:
    (tmp_path / "latex").mkdir()
    (tmp_path / "latex" / "own.tex.j2").write_text("<< name >> of << page.title() >>", encoding="utf-8")

    class Titled:
        def title(self) -> str:
            return "50%"

    assert whole_latex(Templates((tmp_path,)), "own.tex.j2", {"name": "A_B", "page": Titled()}) == r"A{\_}B of 50{\%}"


def test_a_theorem_ends_its_paragraph_where_it_is_told_and_begins_one_where_it_is_told_again() -> None:
    told = ToldOnce("levers", (Text("Levers balance."),), (Text("For levers see above."),))
    tex = solution(page(Paragraph((told, Text("So this one does.")))))
    assert r"\theorem{levers}{Levers balance.\par}{For levers see above.\ }So this one does." in tex


def test_a_formula_on_a_line_of_its_own_ends_with_its_punctuation() -> None:
    said = (Text("so "), DisplayedMath(a), Text(" and "), DisplayedMath(M), Text(". Then"))
    assert LatexPage(WHOLE, WORDS, NOTATION).inline(said) == r"so \[a\quad\text{and}\quad M.\] Then"


@pytest.mark.parametrize(
    ("words", "end"),
    [
        ("The rods turn in opposite senses, and the ratio of the rates is ", "the ratio of the{~}rates{~}is "),
        ("The ratio of the rates is ", "The ratio of the rates is "),
    ],
)
def test_the_last_line_of_a_paragraph_is_not_a_single_short_word(words: str, end: str) -> None:
    assert solution(page(note=(Text(words), NewParagraph(), Text("Yes. ")))).count(end) == 1


def test_the_name_of_a_figure_is_not_divided() -> None:
    note = (Text("See "), FigureRef("Figure 2", "axes", 2))
    assert r"See \mbox{Figure~\figureno{2}}" in solution(page(note=note))
