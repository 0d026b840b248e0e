"""Reasons and frames that a page leaves out."""

from __future__ import annotations

from sympy import Symbol

from derive.page.chain_lines import ChainLine, Equations
from derive.page.numbering import Number
from derive.page.reasons import framed_once, without_known_reasons
from derive.page.tree import Display, Paragraph
from derive.page.wording import Ref, Text

NUMBERS = {name: Number(at) for at, name in enumerate("abcdef", start=1)}
REASON = (Text("from "), Ref("a"), Text(" and "), Ref("b"))


def display(key: str, framed: int = 0, reason: tuple[Text | Ref, ...] = REASON) -> Display:
    line = ChainLine(Symbol("T"), "equals", Symbol("x"), reason)
    return Display((Equations(key, (line,), NUMBERS[key], framed),))


def reasons(*blocks: Paragraph | Display) -> list[tuple[Text | Ref, ...]]:
    found = without_known_reasons(blocks, NUMBERS)
    return [each.groups[0].lines[0].reason for each in found if isinstance(each, Display)]


def test_a_reason_that_names_equations_in_view_is_left_out() -> None:
    assert reasons(display("c")) == [()]
    assert reasons(display("f")) == [REASON]
    assert reasons(Paragraph((Text("With "), Ref("a"), Text(" and "), Ref("b"))), display("f")) == [()]
    because = (Text("as in the limit "), Ref("b"))
    assert reasons(display("c", reason=because)) == [because]


def test_the_lines_of_a_display_show_the_same_reason_once() -> None:
    line = ChainLine(Symbol("T"), "equals", Symbol("x"), REASON)
    groups = (Equations("e", (line, line), NUMBERS["e"]), Equations("f", (line,), NUMBERS["f"]))
    (found,) = without_known_reasons((Display(groups),), NUMBERS)
    assert isinstance(found, Display)
    assert [[each.reason for each in group.lines] for group in found.groups] == [[(), REASON], [()]]


def test_a_part_frames_a_result_once() -> None:
    first, second = framed_once((display("b", 1), display("c", 1)))
    assert isinstance(first, Display) and first.groups[0].framed
    assert isinstance(second, Display) and not second.groups[0].framed
