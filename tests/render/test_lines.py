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
from derive.render.printing.lines import answers_together, printed_lines

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


def test_the_frame_holds_a_result_and_with_a_law_in_letters_the_whole_equation() -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]
    chain = (
        ChainLine(T, "equals", a * b),
        ChainLine(None, "equals", c),
        ChainLine(None, "approx", 2 * a, numeric=True),
    )
    for framed, in_frame in ((0, 0), (1, 1), (2, 3), (3, 3)):
        (line,) = printed_lines(Equations("T", chain, 7, framed), NOTATION)
        assert line.left == NOTATION.layout(T) and (len(line.sides), line.framed) == (3, in_frame)


@pytest.mark.parametrize("result", [Integer(0), LETTERS[2], 2 * LETTERS[1], ImmutableDenseMatrix([0, 0, 0])])
def test_only_a_law_in_letters_shares_the_frame_of_its_result(result: Any) -> None:
    """T = a = 0 is framed as a whole. After a long line only the result is framed, but T = 0 is framed with its left
    side."""
    T = Symbol("T")
    chain = (ChainLine(T, "equals", LETTERS[0]), ChainLine(None, "equals", result, (Text("why"),)))
    (line,) = printed_lines(Equations("T", (replace(chain[1], left=T),), 7, 1), NOTATION)
    assert line.frames_all and len(line.sides) == 1
    (line,) = printed_lines(Equations("T", chain, 7, 1), NOTATION)
    assert len(line.sides) == 2 and line.frames_all
    for limit in (40, 999):
        long = replace(chain[0], right=LONG)
        lines = printed_lines(Equations("T", (long, chain[1]), 7, 1), NOTATION, limit)
        assert [line.framed for line in lines] == [0] * (len(lines) - 1) + [1]
        is_zero = result in (Integer(0), ImmutableDenseMatrix([0, 0, 0]))
        assert lines[-1].frames_all is is_zero and lines[-1].sides[-1] == ("equals", NOTATION.layout(result))
        assert lines[-1].reason and not any(line.reason for line in lines[:-1])


def test_a_framed_line_that_is_broken_is_framed_as_a_whole() -> None:
    lines = printed_lines(Equations("T", (ChainLine(Symbol("T"), "equals", LONG),), 7, 1), NOTATION, 40)
    assert len(lines) > 2 and all(line.frames_all for line in lines)
    relation = ChainLine(LONG, "equals", Symbol("T"))
    assert all(line.frames_all for line in printed_lines(Equations("T", (relation,), 7, 1), NOTATION, 40))


def test_what_looks_alike_keeps_its_frame() -> None:
    a, b = LETTERS[:2]
    alike = (ChainLine(Symbol("T"), "equals", a * b), ChainLine(None, "equals", b * a))
    (line,) = printed_lines(Equations("T", alike, 1, 1), NOTATION)
    assert line.frames_all


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
        assert line.frames_all
        chain = (formula, ChainLine(None, "approx", 2 * c, numeric=True))
        before, line = printed_lines(Equations("S", chain, 7, 1), NOTATION, 999)
        assert (line.framed, line.frames_all, line.sides[0][0]) == (1, True, sign) and not before.framed
        (plain,) = printed_lines(Equations("S", chain, 7), NOTATION, 999)
        assert plain.framed == 0


def test_answers_of_one_row_that_follow_each_other_share_a_frame() -> None:
    T, (a, b, c) = Symbol("T"), LETTERS[:3]
    answer = printed_lines(Equations("one", (ChainLine(T, "equals", a),), 1, 1), NOTATION)
    plain = printed_lines(Equations("two", (ChainLine(T, "equals", b),), 2), NOTATION)
    long = printed_lines(
        Equations("three", (ChainLine(T, "equals", LONG), ChainLine(None, "equals", c)), 3, 1), NOTATION
    )
    assert answers_together([answer, answer, plain, answer, long, answer, answer]) == [[0, 1], [2], [3], [4], [5, 6]]
