"""Every pair of the corpus is decided rightly, never less surely than before, and where SymPy decides it."""

from __future__ import annotations

from collections import Counter

import pytest
from sympy import Function, Piecewise, Symbol

from derive.algebra.equality import Grade, equal
from tests.algebra.pairs import Letters, Pair, families, kept, lines_of, pairs_in, written

FAMILIES = families()


def test_the_corpus_is_large_and_of_every_sort() -> None:
    assert len(kept()) > 900
    counts = Counter((pair.family, pair.equal) for pair in kept())
    assert all(counts[family, told] >= 12 for family in FAMILIES for told in (True, False))
    assert sum(pair.by_sympy != "-" for pair in kept()) > 300


@pytest.mark.parametrize("family", FAMILIES)
def test_every_pair_is_decided_rightly_and_as_surely_as_before(family: str) -> None:
    wrong: list[tuple[Pair, Grade]] = []
    for pair in kept():
        if pair.family != family:
            continue
        grade = equal(pair.left, pair.right).grade
        weaker = pair.grade == Grade.PROVED and grade is not Grade.PROVED
        if weaker or (grade is not Grade.REFUTED) is not pair.equal:
            wrong.append((pair, grade))
    assert not wrong


def test_what_sympy_decides_is_not_left_to_samples() -> None:
    left_open = [pair for pair in kept() if pair.equal and pair.by_sympy != "-" and pair.grade != Grade.PROVED]
    assert not left_open


def test_a_pair_is_read_as_it_was_written() -> None:
    assert pairs_in("\n".join(lines_of(kept()))) == kept()


def test_what_has_no_text_is_refused() -> None:
    x = Symbol("x")
    with pytest.raises(TypeError):
        written(Piecewise((x, x > 0), (0, True)), Letters())
    assert written(Function("f")(x) + 1, Letters()) == "(Add 1 ($f x))"
