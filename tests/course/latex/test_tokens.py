"""A formula as a flat run of tokens, each with the place where it stands."""

from __future__ import annotations

import pytest

from derive.course.arithmetic import Arithmetic
from derive.course.latex.tokens import DEEPEST_FORMULA, LONGEST_FORMULA, MAX_TOKENS, Token, tokens_of
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Rejected


def reader(text: str) -> Arithmetic:
    return Arithmetic(Scalar(text, "", 0, len(text), Source("f.yaml", text)))


def tokens(text: str) -> tuple[Token, ...]:
    return tokens_of(reader(text))


@pytest.mark.parametrize(
    ("text", "kinds"),
    [
        ("2.5a", [("number", "2.5"), ("letter", "a")]),
        ("{ab}^2", [("letter", "a"), ("letter", "b"), ("script", "^"), ("number", "2")]),
        (r"\left( a \right]", [("open", "("), ("letter", "a"), ("close", "]")]),
        (r"\lvert a|", [("open", "lvert"), ("letter", "a"), ("bar", "|")]),
        (r"a\,\quad\Big b", [("letter", "a"), ("letter", "b")]),
        (r"a & b \\ c", [("letter", "a"), ("cell", "&"), ("letter", "b"), ("row", "\\"), ("letter", "c")]),
        (r"\begin{aligned} a \end{aligned}", [("letter", "a")]),
        (r"\{\omega\}", [("open", "{"), ("command", "omega"), ("close", "}")]),
    ],
)
def test_what_stands_in_a_formula_is_told_apart(text: str, kinds: list[tuple[str, str]]) -> None:
    assert [(token.kind, token.text) for token in tokens(text)] == kinds


def test_every_token_stands_where_it_is_written() -> None:
    text = r"12 \omega + \frac{a}{b} \begin{pmatrix} a \end{pmatrix}"
    written = [text[token.start : token.end] for token in tokens(text)]
    assert [piece.strip() for piece in written[:3]] == ["12", r"\omega", "+"]
    assert written[-1] == r"\begin{pmatrix} a \end{pmatrix}"
    fraction = tokens(text)[3]
    assert [a and text[a.start : a.end] for a in fraction.arguments] == ["{a}", "{b}"]
    assert [inner.text for inner in tokens(text)[-1].inside] == ["a"]


def test_an_argument_that_may_be_left_out_is_none() -> None:
    (plain,), (cubic,) = tokens(r"\sqrt{a}"), tokens(r"\sqrt[3]{a}")
    assert plain.arguments[0] is None
    assert cubic.arguments[0] is not None
    assert [token.text for token in cubic.arguments[0].tokens] == ["3"]


def test_words_are_one_token_as_they_stand() -> None:
    (word,) = tokens(r"\text{ upper rod }")
    assert word.arguments[0] is not None
    assert [(t.kind, t.text) for t in word.arguments[0].tokens] == [("word", "upper rod")]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("  ", "a formula is missing"),
        ("a" * (LONGEST_FORMULA + 1), f"{LONGEST_FORMULA} are allowed"),
        ("+a" * (MAX_TOKENS // 2 + 1), f"more than {MAX_TOKENS} letters and signs"),
        ("{" * (DEEPEST_FORMULA + 1) + "}" * (DEEPEST_FORMULA + 1), f"more than {DEEPEST_FORMULA} levels deep"),
        (r"a \left", "a bracket is missing after `\\left`"),
        (r"\left a", "`a` is not allowed after `\\left`"),
        (r"\frac{a}", "needs two values in braces"),
        (r"\sum a", "a sum over an index cannot be read"),
        (r"\begin{pmatrxi} a \end{pmatrxi}", "`pmatrxi` is not known"),
        ("a²", "`²` is not part of a formula"),
    ],
)
def test_what_is_no_formula_is_refused(text: str, message: str) -> None:
    with pytest.raises(Rejected) as caught:
        tokens(text)
    assert message in caught.value.complaints[0].message
