"""Short remarks begin the next paragraph; a condition that is the answer is framed; a law is shown once."""

from __future__ import annotations

from sympy import symbols

from derive.algebra.expressions import Relation
from derive.page.chain_lines import ChainLine, without_inserted
from derive.page.paragraphs import without_short_paragraphs
from derive.page.template import templates_of
from derive.page.tree import Paragraph
from derive.page.wording import FramedMath, Math, Text, phrases, with_verdict
from tests.courses import ROOT

a, b = symbols("a b")


def said(*texts: str) -> list[Paragraph]:
    return [Paragraph((Text(text),)) for text in texts]


def test_a_short_remark_begins_the_next_paragraph() -> None:
    (joined,) = without_short_paragraphs(said("It is negative.", "The rate is"))
    assert "".join(node.text for node in joined.nodes) == "It is negative. The rate is"  # type: ignore[union-attr]


def test_long_paragraphs_and_rests_of_sentences_stay_apart() -> None:
    for first in ("A long sentence. " * 20, "and it is conserved.", "The energy is"):
        assert len(without_short_paragraphs(said(first, "The rate is"))) == 2


def test_a_condition_with_two_verdicts_is_framed() -> None:
    condition = Math(Relation(a, "<", b))
    nodes = (Text("It is stable if "), condition, Text(", and unstable if not."))
    _, framed, _ = with_verdict(nodes, phrases(templates_of(ROOT)))
    assert isinstance(framed, FramedMath) and framed.expr == condition.expr


def test_a_verdict_is_framed_with_its_negation() -> None:
    _, framed, _ = with_verdict((Text("so it is never stable."),), phrases(templates_of(ROOT)))
    assert isinstance(framed, Text) and framed.text == "never stable"


def test_a_law_in_letters_is_left_out_if_only_a_known_value_is_put_in() -> None:
    moment, angle, force = symbols("I phi F")
    lines = (ChainLine(moment * angle, "equals", force), ChainLine(2 * a * angle, "equals", force))
    assert without_inserted(lines, [moment]) == lines[1:]
    assert without_inserted(lines, []) == lines
