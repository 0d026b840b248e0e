"""Tests of pages for a terminal: their order, their width, boxes and equation numbers."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from derive.course.names import EvidenceShown
from derive.page.tree import Document, Paragraph
from derive.page.wording import Math, Ref, Text, ToldOnce
from derive.render.notation.text import columns
from derive.render.printing.text_page import PAGE_COLUMNS, inline_text, page_text
from tests.render.pages import NOTATION, VECTORS, WHOLE, WORDS, a, display, page


def shown(document: Document) -> list[str]:
    return page_text(document, WORDS, NOTATION).splitlines()


def test_everything_on_a_page_stands_in_its_order() -> None:
    text = page_text(WHOLE, WORDS, NOTATION)
    at = 0
    for piece in (
        "A block & its T", "See Problem 2 first.", "[figure: Some axes 50% of a]", "\nStrategy. Mind every step.\n",
        "(a) Find T as in (2)", "\nSo\n",
        "(1)", "[from (1)]", "[tidied]", "(2)", "[figure: Two vectors]", "Figure 1. Both & true.",
        "\nLimiting cases\n", "A light one flies.", "Mind the gap.", "Nothing.",
    ):  # fmt: skip
        assert piece in text[at:], piece
        at = text.index(piece, at) + len(piece)


def test_numbers_and_points_stand_at_the_right_edge() -> None:
    ends = [line for line in shown(WHOLE) if line.endswith(("(1)", "(2)", "points]")) and not line.startswith("[")]
    assert len(ends) == 4
    assert {columns(line) for line in ends} == {PAGE_COLUMNS}


def test_nothing_of_running_text_is_wider_than_the_page() -> None:
    words = (Text("much ado about nothing " * 12), Math(a))
    lines = shown(page(Paragraph(words), title=words, note=words, statement=words))
    assert max(map(columns, lines)) <= PAGE_COLUMNS
    (worth, *_) = [line for line in lines if "points]" in line]
    assert worth.strip() == "[3 points]", "points after a title of several lines have a line of their own"


def test_a_reason_that_does_not_fit_beside_its_line_stands_below_it() -> None:
    group = replace(display("energy").groups[0], lines=display("energy").groups[0].lines[1:])
    long = replace(group.lines[0], reason=(Text("since nothing else is known of it, and " * 2 + "so on"),))
    lines = shown(page(replace(display("energy"), groups=(replace(group, lines=(long,)),))))
    (at,) = [i for i, line in enumerate(lines) if "since nothing" in line]
    assert lines[at].lstrip().startswith("[since") and lines[at - 1].endswith("(2)")


def test_a_star_stands_before_the_line_that_has_the_answer_in_it() -> None:
    plain, starred = shown(page(display("energy"))), shown(page(display("energy", framed=1)))
    (at,) = [i for i, line in enumerate(starred) if line.startswith("  * ")]
    assert starred[at].split()[1:5] == ["T", "=", "2M", "a²"] and not any("  * " in line for line in plain)


@pytest.mark.parametrize("points", [None, Fraction(1), Fraction(5, 2)])
def test_points_are_told_only_where_there_are_any(points: Fraction | None) -> None:
    title = shown(page(points=points))[0]
    assert title.endswith("]") is (points is not None)


def test_a_part_beyond_the_homework_is_marked_where_points_stand() -> None:
    extra = replace(page(), parts=(replace(page().parts[0], points=None, extra=True),))
    heading = next(line for line in shown(extra) if line.startswith("(a)"))
    assert heading.endswith("[extra, no points]") and columns(heading) == PAGE_COLUMNS


def test_a_part_that_waits_for_more_detail_is_not_on_the_page() -> None:
    parts = page().parts
    waiting = replace(page(), parts=(*parts, replace(parts[0], label="z", shown=False)))
    assert shown(waiting) == shown(page())


def test_a_drawing_without_a_number_has_no_caption() -> None:
    lines = shown(page(replace(VECTORS, number=None)))
    assert "[figure: Two vectors]" in lines
    assert not [line for line in lines if line.startswith("Figure")]


def test_text_in_a_line_is_squeezed_and_needs_the_numbers_it_refers_to() -> None:
    assert inline_text((Text("by \n "), Ref("law"), Text("  too")), NOTATION, {"law": 4}) == "by (4) too"
    with pytest.raises(KeyError):
        inline_text((Ref("law"),), NOTATION)


def test_the_margin_of_a_typeset_page_stands_below_a_display_of_text() -> None:
    pages = {each: "\n".join(shown(replace(WHOLE, evidence=each))) for each in EvidenceShown}
    assert "[proved; second route: by halves]" in pages[EvidenceShown.MARGIN]
    assert all("by halves" not in pages[evidence] for evidence in (EvidenceShown.NONE, EvidenceShown.END))


def test_a_theorem_has_a_paragraph_of_its_own() -> None:
    told = ToldOnce("levers", (Text("Levers balance."),), (Text("For levers see above."),))
    lines = shown(page(Paragraph((told, Text("So this one does.")))))
    at = lines.index("Levers balance.")
    assert lines[at + 1 : at + 3] == ["", "So this one does."]
    assert not any("see above" in line for line in lines), "a page of text is a document of one problem"
