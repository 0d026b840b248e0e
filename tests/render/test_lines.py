"""The lines of a step: which forms share one, what stands at its end, and what is broken."""

from __future__ import annotations

from sympy import Symbol, sin, symbols

from derive.algebra.expressions import Relation
from derive.page.document import Answer, ChainLine, Equations
from derive.page.wording import Text
from derive.render.notation.notation import Notation
from derive.render.printing.lines import answer_lines, printed_lines

LETTERS = symbols("a b c d e f g h k l m n p q r s", positive=True)
theta = Symbol("theta", real=True)
NOTATION = Notation({})
LONG = sum(letter**2 * sin(theta) for letter in LETTERS)


def test_the_reason_and_the_number_stand_at_the_last_line() -> None:
    equations = Equations("T", (ChainLine(Symbol("T"), "equals", LONG, (Text("why"),)),), 7)
    lines = printed_lines(equations, NOTATION, 40)
    assert len(lines) > 2
    assert [line.number for line in lines] == [None] * (len(lines) - 1) + [7]
    assert [bool(line.reason) for line in lines] == [False] * (len(lines) - 1) + [True]
    assert [line.sides[0][0] for line in lines] == ["equals"] + ["on"] * (len(lines) - 1)


def test_a_long_left_side_ends_with_its_relation() -> None:
    relation = Relation(LONG, "=", 0)
    equations = Equations("motion", (ChainLine(relation.left, relation.word, relation.right),), 1)
    lines = printed_lines(equations, NOTATION, 40)
    assert [len(line.sides) for line in lines] == [1] * (len(lines) - 1) + [2]
    assert lines[-1].sides[-1] == ("equals", NOTATION.layout(relation.right))


def test_a_boxed_answer_takes_as_many_lines_as_it_needs() -> None:
    answer = Answer("T", Symbol("T"), LONG)
    assert len(answer_lines(answer, NOTATION, 40)) > 2
    assert len(answer_lines(answer, NOTATION, 1000)) == 1


def test_short_forms_share_a_line_until_one_has_a_reason() -> None:
    a, b, c = LETTERS[:3]
    chain = (
        ChainLine(Symbol("T"), "equals", a + b),
        ChainLine(None, "equals", b + c, (Text("why"),)),
        ChainLine(None, "equals", a + c, (Text("and why"),)),
        ChainLine(None, "equals", a),
    )
    lines = printed_lines(Equations("T", chain, 7), NOTATION)
    assert [len(line.sides) for line in lines] == [2, 2]
    assert ["".join(node.text for node in line.reason) for line in lines] == ["why", "and why"]  # type: ignore[union-attr]
    assert [line.left is None for line in lines] == [False, True]


def test_what_looks_alike_is_printed_once() -> None:
    a, b = LETTERS[:2]
    alike = (ChainLine(Symbol("T"), "equals", a * b), ChainLine(None, "equals", b * a))
    (line,) = printed_lines(Equations("T", alike, 1), NOTATION)
    assert len(line.sides) == 1
    rounded = (alike[0], ChainLine(None, "approx", a * b))
    assert [relation for relation, _ in printed_lines(Equations("T", rounded, 1), NOTATION)[0].sides] == [
        "equals", "approx"
    ]  # fmt: skip


def test_equations_of_one_left_side_go_on_along_the_line() -> None:
    x, y, z = symbols("x y z")
    lines = (ChainLine(x, "equals", y), ChainLine(x, "equals", z))
    (only,) = printed_lines(Equations("key", lines, 1), Notation())
    assert only.left == Notation().layout(x) and len(only.sides) == 2
    others = (ChainLine(x, "equals", y), ChainLine(z, "equals", y))
    assert len(printed_lines(Equations("key", others, 1), Notation())) == 2
