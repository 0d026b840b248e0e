"""Tests of formulas and results that a page has already shown."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from sympy import Symbol, symbols

from derive.page.chain_lines import ChainLine
from derive.page.repeated_formulas import Stated, noted, results, told_by_number
from derive.page.wording import Chain, Ref, Text
from derive.steps.step import Level

T, U, a, b = (*symbols("T U"), *symbols("a b"))
GENERAL = (ChainLine(T, "equals", a + b),)


def stated() -> Stated:
    found = Stated()
    assert found.noted("general", GENERAL) is None
    return found


def test_a_chain_does_not_begin_with_what_its_symbol_is_known_to_be() -> None:
    chain = (GENERAL[0], ChainLine(None, "equals", 2 * a, (Text("with b"),)))
    assert stated().without_repeats(chain, ()) == (ChainLine(T, "equals", 2 * a, (Text("with b"),)),)
    assert stated().without_repeats(GENERAL, ()) == GENERAL, "something is left of every chain"
    other = (ChainLine(U, "equals", a + b), chain[1])
    assert stated().without_repeats(other, ()) == other


def test_a_chain_ends_with_a_letter_where_what_that_is_stands_above() -> None:
    chain = (ChainLine(T, "equals", U), ChainLine(None, "equals", a + b))
    assert stated().without_repeats(chain, {U}) == chain[:1]
    assert stated().without_repeats(chain, {T}) == chain


def test_relations_are_kept_line_by_line() -> None:
    chain = (ChainLine(T, "equals", a + b), ChainLine(a, "greater", b))
    assert stated().without_repeats(chain, {T}) == chain


def test_a_result_that_is_reached_again_is_known_by_the_step_that_had_it_first() -> None:
    found = stated()
    assert found.noted("again", (ChainLine(T, "equals", 2 * a), ChainLine(None, "equals", a + b))) == "general"
    assert found.noted("bound", (ChainLine(T, "at_least", a + b),)) is None
    assert found.noted("nothing", ()) is None


def test_decimals_are_of_the_result_unless_numbers_were_put_in() -> None:
    lines = (*GENERAL, ChainLine(None, "equals", a), ChainLine(None, "approx", b, numeric=True))
    found, measured = SimpleNamespace(outcome="generic"), SimpleNamespace(outcome="measured")
    step: Any
    for step, counts in ((found, (1, 1, 2)), (measured, (1, 1, 1))):
        assert tuple(results(step, lines[:count]) for count in (1, 2, 3)) == counts


def test_a_note_stands_where_there_is_no_reason() -> None:
    note, reason = (Text("as above"),), (Text("since"),)
    assert noted(GENERAL, note)[-1].reason == note
    given = (ChainLine(Symbol("x"), "equals", a, reason),)
    assert noted(given, note) == given and noted(GENERAL, ()) == GENERAL


def test_what_is_found_again_is_told_by_its_number_but_on_a_full_page() -> None:
    nodes = (Text("This gives "), Ref("motion"), Text(" again, "), Chain())
    again: Any = SimpleNamespace(outcome="again")
    assert told_by_number(again, nodes, Level.STANDARD) == (*nodes[:2], Text(" again."))
    assert told_by_number(again, nodes, Level.FULL) == ()
    other: Any = SimpleNamespace(outcome="results")
    assert told_by_number(other, nodes, Level.STANDARD) == ()
