"""Tests of labels in matplotlib's mathtext, in which vectors are separate bold runs."""

from __future__ import annotations

import pytest

from derive.render.drawing.mathtext import Span, runs
from derive.render.notation.layout import Digits, Fenced, Fraction, Layout, Name, Operator, Raised, RootSign, Row

OMEGA = Name("omega", style="vector")


def test_a_vectors_letter_is_drawn_bold_and_its_subscript_is_not() -> None:
    assert runs(OMEGA) == (Span(r"$\omega$", bold=True),)
    bold, below = runs(Name("L", "x", style="vector"))
    assert bold == Span("$L$", bold=True)
    assert (below.bold, below.text) == (False, "${}_{x}$")


def test_what_stands_round_a_vector_keeps_its_order() -> None:
    found = runs(Row((Digits("2"), OMEGA, Operator("plus"), Name("a"), OMEGA)))
    assert [run.bold for run in found] == [False, True, False, True]
    assert [run.text for run in found] == ["$2$", r"$\omega$", "$+a$", r"$\omega$"]


@pytest.mark.parametrize(
    "layout",
    [
        Fraction(Digits("1"), Name("a")),
        Fenced(Name("a"), "|"),
        Row((Name("a"), Operator("space"), Name("b"))),
        Raised(Fenced(Row((Name("a"), Operator("minus"), Name("b")))), Digits("2")),
        RootSign(Fraction(Name("g"), Name("l"))),
        Row((Name("theta", dots=2), Operator("equals"), Operator("minus"), Name("omega", "0"))),
        Fenced(OMEGA),
    ],
    ids=str,
)
def test_matplotlib_can_set_every_run(layout: Layout) -> None:
    from matplotlib.mathtext import MathTextParser

    for run in runs(layout):
        _, _, width, *_ = MathTextParser("path").parse(run.text)  # raises an error for unknown commands
        assert width or not run.text.strip("$")


def test_nothing_has_no_runs() -> None:
    assert runs(Row(())) == ()
