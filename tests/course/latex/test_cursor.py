"""The place that has been reached among tokens, and the group that belongs to a script."""

from __future__ import annotations

from derive.course.latex.cursor import Cursor
from derive.course.latex.tokens import Token
from tests.course.latex.test_tokens import tokens


def run(text: str) -> Cursor:
    return Cursor(tokens(text), len(text))


def test_a_run_knows_what_stands_next_and_what_stood_before() -> None:
    here = run(r"a\omega")
    assert (here.written, here.following and here.following.text) == ("a", "omega")
    here.at = 1
    assert (here.written, here.following, here.before.text) == (r"\omega", None, "a")
    here.at = 2
    assert (here.written, here.token) == ("", None)


def script_of(text: str) -> tuple[list[str], str, str]:
    """The tokens of the first script, how it is written, and what stands behind it."""
    here = run(text)
    while here.token and here.token.kind != "script":
        here.at += 1
    mark = here.token
    assert mark
    here.at += 1
    found = here.argument_after(mark, text)
    assert found
    return [token.text for token in found.tokens], text[found.start : found.end], here.written


def test_a_script_has_one_token_or_what_stands_in_braces() -> None:
    assert script_of("a^23")[:2] == (["23"], "23")
    assert script_of("a^{2b}c") == (["2", "b"], "{2b}", "c")
    assert script_of(r"a_{ \{b\} }c") == (["{", "b", "}"], r"{ \{b\} }", "c")
    assert script_of(r"a_{b^{c}}d") == (["b", "^", "c"], "{b^{c}}", "d")
    assert script_of("a^{}b") == ([], "{}", "b")


def test_nothing_after_a_script_is_no_argument() -> None:
    here = run("a^")
    here.at = 2
    assert here.argument_after(here.before, "a^") is None


def test_a_token_can_be_replaced_by_several_where_the_run_stands() -> None:
    here = run("abc")
    here.at = 1
    here.replace((Token("number", "1", 1, 2), Token("number", "2", 1, 2)))
    assert [token.text for token in here.tokens] == ["a", "1", "2", "c"]
    assert here.written == "1"


def test_only_the_innermost_bracket_says_whether_a_bar_closes() -> None:
    here = run("a")
    assert not here.inside_bars
    here.bars += [True]
    assert here.inside_bars
    here.bars += [False]
    assert not here.inside_bars
