"""The rows and statements of a document, its macros, and the words around its formulas."""

from __future__ import annotations

import pytest

from derive.documents.layout import Cue, read_document
from derive.documents.source import Format, source_of
from derive.documents.tokens import MOST_TOKENS
from tests.documents.reading import document, values


def relations(text: str, kind: Format = Format.MARKDOWN) -> list[list[str]]:
    return [statement.relations for row in document(text, kind).rows for statement in row.statements]


def test_a_row_that_begins_with_a_relation_goes_on_from_the_row_before_it() -> None:
    first, second = document("$$\n\\begin{aligned} E &= a + b \\\\ &= c \\end{aligned}\n$$").rows
    (begun,), (goes_on,) = first.statements, second.statements
    assert goes_on.follows is begun and goes_on.sides[0] is begun.sides[-1]


def test_a_row_that_begins_with_a_sign_is_the_rest_of_a_side() -> None:
    rows = document("\\begin{align} E &= a \\\\ &\\quad + b \\\\ &= c \\end{align}", Format.TEX).rows
    assert len(rows) == 2 and [token.text for token in rows[0].statements[0].sides[-1].tokens] == ["a", "+", "b"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$a = b, c = d$", [["="], ["="]]),
        ("$x = 1, 2$", [["="]]),
        ("$f(x, y) = 0$", [["="]]),
        ("$a = b \\quad\\text{and}\\quad c = d$", [["="], ["="]]),
        ("$a = b \\Rightarrow a^2 = b^2$", [["="], ["="]]),
        ("$a \\leq b < c$", [["<=", "<"]]),
        ("```\n$a = b$\n```\n`$c = d$` and $e = f$", [["="]]),
        ("$$ a = b \\\\$$ and $c = d$", [["="], ["="]]),
        (
            "$$ \\begin{aligned} a =& \\\\ =& b \\\\ c &= d + \\quad \\\\ & \\quad e \\end{aligned} $$",
            [[], ["="], ["="]],
        ),
        ("The $3_{rd}$ row $(*)$ has $A \\not= 0$.", [["!="]]),
        ("It costs \\$5 and $p = 1$.", [["="]]),
    ],
)
def test_the_statements_of_a_text(text: str, expected: list[list[str]]) -> None:
    assert relations(text) == expected


def test_comments_and_definitions_are_no_formulas() -> None:
    text = "\\newcommand{\\half}{\\frac{1}{2}}\n\\begin{document}\n% $a = b$\n$T = \\half m v^2$\\end{document}"
    (row,) = document(text, Format.TEX).rows
    (statement,) = row.statements
    assert [token.text for token in statement.sides[1].tokens][:2] == ["frac", "{"]
    assert statement.sides[1].tokens[0].origin == ("half",)


@pytest.mark.parametrize(
    "definitions",
    [
        "\\def\\a{\\a\\a}",
        "\\def\\a{\\b\\b}\\def\\b{\\a\\a}",
        "".join(f"\\def\\{'x' * i}{{\\{'x' * (i + 1)}\\{'x' * (i + 1)}}}" for i in range(1, 60)),
        "".join(f"\\newcommand{{\\{'y' * i}}}[1]{{\\{'y' * (i + 1)}{{#1#1}}}}" for i in range(1, 60)),
    ],
)
def test_macros_that_grow_without_end_are_stopped(definitions: str) -> None:
    found = read_document(source_of(f"{definitions} $\\a = \\x + \\y{{1}}$", Format.TEX))
    tokens = [
        token for row in found.rows for statement in row.statements for side in statement.sides for token in side.tokens
    ]
    assert len(tokens) < 2 * MOST_TOKENS


def test_a_formula_knows_the_words_before_it() -> None:
    (block,) = document("For small angles we expand the sine. Then\n\n$$a = b$$").blocks
    assert Cue.APPROXIMATE in block.cues


def test_a_row_has_the_line_of_its_formula() -> None:
    assert [row.line for row in document("x\n\n$$\n\\begin{aligned}\na &= b \\\\\n&= c\n\\end{aligned}\n$$").rows] == [
        5,
        6,
    ]


@pytest.mark.parametrize(
    "system",
    [
        "\\begin{cases} N = m g \\\\ F = \\mu N \\end{cases}",
        "\\left\\{ \\begin{array}{l} N = m g \\\\ F = \\mu N \\end{array} \\right.",
    ],
)
def test_a_system_behind_a_brace_has_an_equation_in_each_row(system: str) -> None:
    assert values(f"$$ {system} $$") == [("N", "g*m"), ("F", "N*mu")]


def test_a_list_in_braces_is_not_a_system() -> None:
    ((_, right),) = values("$$ L = \\left\\{ \\begin{array}{l} a \\\\ b \\end{array} \\right\\} $$")
    assert right == "Matrix([[a], [b]])"


@pytest.mark.parametrize("second", [
    "- \\frac{1}{2} k x^2 &= E",
    "(1 + a) \\\\ - \\frac{1}{2} k x^2 &= E",
    "&\\qquad + \\frac{1}{2} k x^2 = E",
])  # fmt: skip
def test_a_left_side_may_begin_in_rows_without_a_relation(second: str) -> None:
    text = "$$\n\\begin{aligned}\n\\frac{1}{2} m \\dot x^2 \\\\\n" + second + "\n\\end{aligned}\n$$"
    (row,) = read_document(source_of(text, Format.TEX, "a.tex")).rows
    (statement,) = row.statements
    assert len(statement.sides) == 2 and statement.sides[0].tokens[0].text == "frac"
