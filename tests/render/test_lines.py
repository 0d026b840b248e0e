"""Tests of the printed lines of a step: shared lines, ends of lines, and broken lines."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Integer, Symbol, sin, symbols

from derive.algebra.expressions import Relation
from derive.page.chain_lines import ChainLine, Equations
from derive.page.wording import Text
from derive.render.notation.notation import Notation
from derive.render.printing.lines import Printed, answers_together, before_answers, printed_lines

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


@pytest.mark.parametrize("result", [Integer(0), LETTERS[2], 2 * LETTERS[1], ImmutableDenseMatrix([0, 0, 0])])
@pytest.mark.parametrize("law", [LETTERS[0], LONG])
def test_an_answer_is_an_equation_of_its_own_after_its_derivation(law: Any, result: Any) -> None:
    T = Symbol("T")
    chain = (ChainLine(T, "equals", law), ChainLine(None, "equals", result, (Text("why"),)))
    (line,) = printed_lines(Equations("T", (replace(chain[1], left=T),), 7, 1), NOTATION)
    assert line.framed and len(line.sides) == 1
    for limit in (40, 999):
        *before, last = printed_lines(Equations("T", chain, 7, 1), NOTATION, limit)
        assert before and not any(line.framed or line.reason for line in before)
        assert last.framed and last.reason
        assert (last.left, last.sides) == (NOTATION.layout(T), (("equals", NOTATION.layout(result)),))


def test_an_answer_takes_the_reason_of_the_same_expression_before_it() -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]
    chain = (
        ChainLine(T, "equals", a * b),
        ChainLine(None, "equals", b + c, (Text("why"),)),
        ChainLine(None, "equals", b + c),
    )
    lines = printed_lines(Equations("T", chain, 7, 1), NOTATION)
    assert [bool(line.reason) for line in lines] == [False, True]


@pytest.mark.parametrize("again", [None, Symbol("T")])
def test_the_frame_of_an_approximate_chain_has_no_equals_sign(again: Any) -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]
    chain = (ChainLine(T, "equals", a * b), ChainLine(None, "approx", c), ChainLine(again, "equals", 2 * c + a))
    *_, answer = printed_lines(Equations("T", chain, 7, 1), NOTATION)
    assert answer.framed and [relation for relation, _ in answer.sides] == ["approx"]


def test_the_frame_of_an_exact_answer_holds_its_decimals() -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]
    numeric = ChainLine(None, "approx", 2 * a, numeric=True)
    chain = (ChainLine(T, "equals", a * b), ChainLine(None, "equals", c), numeric)
    for framed, sides in ((0, [3]), (1, [2, 1]), (2, [1, 2]), (3, [3])):
        lines = printed_lines(Equations("T", chain, 7, framed), NOTATION)
        assert [len(line.sides) for line in lines] == sides
        assert [line.framed for line in lines] == [False] * (len(lines) - 1) + [framed > 0]


def test_a_framed_line_that_is_broken_is_framed_as_a_whole() -> None:
    lines = printed_lines(Equations("T", (ChainLine(Symbol("T"), "equals", LONG),), 7, 1), NOTATION, 40)
    assert len(lines) > 2 and all(line.framed for line in lines)
    relation = ChainLine(LONG, "equals", Symbol("T"))
    assert all(line.framed for line in printed_lines(Equations("T", (relation,), 7, 1), NOTATION, 40))


def test_what_looks_alike_keeps_its_frame() -> None:
    a, b = LETTERS[:2]
    alike = (ChainLine(Symbol("T"), "equals", a * b), ChainLine(None, "equals", b * a))
    (line,) = printed_lines(Equations("T", alike, 1, 1), NOTATION)
    assert line.framed


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


def test_of_an_inequality_the_frame_holds_its_left_side_and_its_sign() -> None:
    S, c = Symbol("S"), LETTERS[2]
    for relation, sign in (("greater", "greater"), ("at_most", "at_most")):
        formula = ChainLine(S, relation, LONG)
        (line,) = printed_lines(Equations("S", (formula,), 7, 1), NOTATION, 999)
        assert line.framed
        chain = (formula, ChainLine(None, "approx", 2 * c, numeric=True))
        before, line = printed_lines(Equations("S", chain, 7, 1), NOTATION, 999)
        assert (line.framed, line.framed, line.sides[0][0]) == (1, True, sign) and not before.framed
        (plain,) = printed_lines(Equations("S", chain, 7), NOTATION, 999)
        assert plain.framed == 0


def test_answers_that_follow_each_other_share_a_frame_after_their_laws() -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]

    def step(*rights: Any, framed: int = 1) -> tuple[Printed, ...]:
        first, *others = rights
        lines = (ChainLine(T, "equals", first), *(ChainLine(None, "equals", each) for each in others))
        return printed_lines(Equations("T", lines, 1, framed), NOTATION)

    answer, plain, law, long = step(a), step(b, framed=0), step(a * b, c), step(LONG, LONG - a, LONG - b, c)
    assert answers_together([answer, answer, plain, answer, long, law, law]) == [[0, 1], [2], [3], [4], [5, 6]]
    assert before_answers([answer, answer]) == []
    (line,) = before_answers([law, law])
    assert [relation for relation, _ in line.sides] == ["equals", "next", "equals"], "the laws share a line"
    assert len(before_answers([law, law], limit=10)) == 2
    room = 4 * law[0].width + 15
    rows = before_answers([law] * 6, limit=room)
    assert [len([*filter("next".__eq__, (sign for sign, _ in row.sides))]) for row in rows] == [1, 1, 1], "in pairs"
    assert len(before_answers([law] * 5, limit=room)) == 2
