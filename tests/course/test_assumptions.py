"""`assume:`: relations between letters as a file has them, and what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.stock.described import edited, messages, solved

TWO_LENGTHS = """\
title: Two lengths
solve: system
symbols: {m: mass, a: length, b: length, c: length, g: acceleration, v_0: speed, R: length, mu: 'number in (0, 1)'}
given:
  coordinates: {x: length}
  particles: {p: {mass: m, at: [x, 0]}}
  potential: m*g*(b - a)*x**2/(2*R**2)
  assume: [a < b]
statement: A particle.
parts:
  - ask: Is it stable?
    answer: stability
"""


def test_a_relation_decides_whether_an_equilibrium_is_stable(tmp_path: Path) -> None:
    assert solved(tmp_path, TWO_LENGTHS)["stability"].step.outcome == "stable"
    assert solved(tmp_path, edited(TWO_LENGTHS, ("[a < b]", "b < a")))["stability"].step.outcome == "unstable"
    assert solved(tmp_path, edited(TWO_LENGTHS, ("[a < b]", "[a < c < b]")))["stability"].step.outcome == "stable"
    assert solved(tmp_path, edited(TWO_LENGTHS, ("  assume: [a < b]\n", "")))["stability"].step.outcome == "depends"


@pytest.mark.parametrize(
    ("relations", "said"),
    [
        ("[a < b, b < a]", "8: `b < a` contradicts what is known about these letters"),
        ("[a < b < c, c < a]", "8: `c < a` contradicts what is known about these letters"),
        ("[v_0**2 < g*R, 2*g*R < v_0**2]", "8: `2*g*R < v_0**2` contradicts what is known about these letters"),
        ("b < 0", "8: `b < 0` contradicts what is known about these letters"),
        ("mu > 2", "8: `mu > 2` contradicts what is known about these letters"),
        ("a < v_0", "8: a length is compared with a speed"),
        ("a = b", "8: `=` is not allowed under `assume`"),
        ("a < b > c", "8: `a < b > c` mixes `<` and `>`"),
        ("x < a", "8: `assume` is about constant letters, but `x` varies"),
        ("x_dot < v_0", "8: `assume` is about constant letters, but `x_dot` varies"),
        ("a <", "8: one side of this relation is missing"),
        ("a", "8: `a` is not a relation"),
        ("h < a", "8: `h` is not declared"),
    ],
)
def test_a_relation_that_says_nothing_or_too_much_is_refused(relations: str, said: str, tmp_path: Path) -> None:
    assert messages(tmp_path, edited(TWO_LENGTHS, ("[a < b]", relations))) == [said]


def test_a_relation_must_be_true_of_the_numbers(tmp_path: Path) -> None:
    text = edited(TWO_LENGTHS, ("statement: A", "values: {a: 2 m, b: 1 m}\nstatement: A"))
    assert messages(tmp_path, text) == ["8: `a < b` is not true for the given numbers"]


def test_a_letter_is_bounded_by_a_number(tmp_path: Path) -> None:
    text = edited(TWO_LENGTHS, ("m*g*(b - a)*x**2/(2*R**2)", "m*g*(1 - 2*mu)*x**2/(2*R)"), ("[a < b]", "[mu < 1/2]"))
    assert solved(tmp_path, text)["stability"].step.outcome == "stable"
    assert solved(tmp_path, edited(text, ("[mu < 1/2]", "[mu < 2/3]")))["stability"].step.outcome == "depends"
