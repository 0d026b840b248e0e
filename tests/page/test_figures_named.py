"""The sentences that refer to the figures of a part."""

from __future__ import annotations

from sympy import Symbol

from derive.figures.marks import Drawing, Plot, Recorded
from derive.page.chain_lines import ChainLine, Equations
from derive.page.figures_named import figures_mentioned
from derive.page.numbering import Number
from derive.page.template import templates_of
from derive.page.tree import Block, Display, Illustration, Paragraph
from derive.page.wording import Text, phrases
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from tests.courses import ROOT

WORDS = phrases(templates_of(ROOT))
FORCES = {key: Drawing(key, (), forces_on=Symbol("m")) for key in ("left", "right")}
CURVE = Plot("curve", Symbol("U"), Symbol("x") ** 2, Symbol("x"), 0, 1, "energy", "length")
KNOWN: dict[str, Recorded] = {**FORCES, "curve": CURVE}


def figure(key: str, number: int | None) -> Illustration:
    return Illustration(key, key, (), number, (), "a")


def told(*blocks: Block, mentioned: tuple[str, ...] = ()) -> list[str]:
    found = figures_mentioned(blocks, KNOWN, mentioned, WORDS)
    return [inline_text(each.nodes, Notation()) if isinstance(each, Paragraph) else "*" for each in found]


def test_figures_of_forces_begin_the_sentence_after_them() -> None:
    said = told(figure("left", 2), figure("right", 3), Paragraph((Text("The upward component is"),)))
    assert said == ["*", "*", "With the forces in Figures 2 and 3, the upward component is"]
    (_, said) = told(figure("left", 2), Paragraph((Text("At rest they add up to zero."),)))
    assert said == "At rest they add up to zero (Figure 2)."


def test_a_figure_is_mentioned_at_the_end_of_the_sentence_before_it() -> None:
    (said, _) = told(Paragraph((Text("It falls."),)), figure("curve", 2))
    assert said == "It falls (Figure 2)."
    (said, _) = told(Paragraph((Text("It falls (at once)."),)), figure("curve", 2))
    assert said == "It falls (at once; Figure 2)."
    (_, said) = told(figure("curve", 2), Paragraph((Text("Hence "),)))
    assert said == "Hence (Figure 2)"


def test_a_figure_without_a_number_and_one_that_is_mentioned_have_no_sentence() -> None:
    assert told(figure("left", None)) == ["*"]
    assert told(figure("curve", 2), mentioned=("curve",)) == ["*"]


def test_a_plot_after_a_formula_is_mentioned_next_to_the_formula() -> None:
    x = Symbol("x")
    for reason, words, note in (((), "The energy is", "Figure 2"), ((Text("why"),), "The energy is (Figure 2)", "why")):
        formula = Display((Equations("energy", (ChainLine(x, "equals", x, reason),), Number(1)),))
        blocks = (Paragraph((Text("The energy is"),)), formula, figure("curve", 2), Paragraph((Text("It is least"),)))
        assert told(*blocks) == [words, "*", "*", "It is least"]
        (noted,) = [each for each in figures_mentioned(blocks, KNOWN, (), WORDS) if isinstance(each, Display)]
        assert inline_text(noted.groups[-1].lines[-1].reason, Notation()).replace("\u00a0", " ") == note


def test_figures_above_equations_are_mentioned_next_to_the_first_one() -> None:
    x = Symbol("x")
    equations = Display(tuple(Equations(key, (ChainLine(x, "equals", x),), Number(1)) for key in "abc"))
    blocks = (figure("left", 2), Paragraph((Text("It turns. Newton's laws are"),)), equations)
    (noted,) = [each for each in figures_mentioned(blocks, KNOWN, (), WORDS) if isinstance(each, Display)]
    assert [bool(group.lines[-1].reason) for group in noted.groups] == [True, False, False]
