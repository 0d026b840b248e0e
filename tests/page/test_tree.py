"""Tests of joined displays, and of parts that a level leaves out."""

from __future__ import annotations

from dataclasses import replace

from derive.algebra.equality import Grade
from derive.page.chain_lines import ChainLine, Equations
from derive.page.numbering import Number
from derive.page.tree import Display


def display(key: str, grade: Grade) -> Display:
    return Display((Equations(key, (ChainLine(key, "equals", 1),), Number(1)),), frozenset({grade}), (f"by {key}",))


def test_a_display_is_as_sure_as_the_least_sure_of_its_steps() -> None:
    both = display("a", Grade.PROVED).with_more(display("b", Grade.SAMPLED))
    assert both.grade is Grade.SAMPLED
    assert [group.key for group in both.groups] == ["a", "b"]


def test_the_margin_names_the_routes_of_the_first_step() -> None:
    assert display("a", Grade.PROVED).with_more(display("b", Grade.PROVED)).routes == ("by a",)


def test_a_step_stands_beside_another_in_one_row_with_one_number() -> None:
    (group,) = display("a", Grade.PROVED).with_more(display("b", Grade.PROVED), beside=True).groups
    assert [line.beside for line in group.lines] == [False, True]


def test_commas_stand_between_steps_and_the_end_is_that_of_the_sentence() -> None:
    assert display("a", Grade.PROVED).with_more(display("b", Grade.PROVED)).stops == (",", ".")


def test_a_framed_answer_has_the_punctuation_of_its_sentence() -> None:
    plain, framed = display("a", Grade.PROVED), display("b", Grade.PROVED)
    framed = replace(framed, groups=(replace(framed.groups[0], framed=1),))
    assert plain.with_more(framed).stops == framed.with_more(plain).stops == (",", ".")
