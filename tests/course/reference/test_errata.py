"""Errata as a page prints them: in the problem's letters, with units, figures, relations and both branches."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integral, Symbol, pi

from derive.algebra.expressions import PLUS_MINUS, Amount, Group, Relation
from derive.algebra.rounding import Rounded
from derive.course.latex import read_latex
from derive.course.reference.errata import Erratum, erratum_of
from derive.course.reference.statements import Entry, Stated, Statement
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Place
from derive.units import read_unit
from tests.course.latex.formula import LETTERS

R, a, S = (Symbol(name, positive=True) for name in ("R", "a", "S"))
HERE = Place("reference.yaml", 1)


def stated(text: str) -> Statement:
    read = read_latex(Scalar(text, "", 0, len(text), Source("reference.yaml", text)), LETTERS, homogeneous=False)
    sides = tuple(Stated(side.branches, side.shape, side.text, side.place) for side in read.sides)
    return Statement(sides, read.marks, text, HERE)


def erratum(printed: str, right: str, figures: tuple[int, ...] = (), unit: str = "") -> Erratum:
    read = read_unit(unit) if unit else None
    entry = Entry("answer", "1", stated(printed), stated(right), "a slip", figures, read, HERE)
    return erratum_of(entry, {"R": R, "a": a, "S": S})


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        (r"2 a", 2 * a),
        (r"R > \frac{a}{2}", Relation(R, ">", a / 2)),
        (r"R \pm 2a", R + PLUS_MINUS * 2 * a),
    ],
)
def test_a_value_a_relation_and_two_branches_are_printed(text: str, shown: Any) -> None:
    found = erratum(text, "a")
    assert (found.printed, found.right) == (shown, a)


def test_only_the_number_of_a_bound_has_its_unit_and_figures() -> None:
    found = erratum(r"S \ge 267.31", r"S \ge 267.38", (5,), "rpm").printed
    assert found.left == S
    assert isinstance(found.right, Amount) and isinstance(found.right.args[0], Rounded)


def test_an_integral_is_printed_with_its_own_letter_and_without_a_bracket() -> None:
    found = erratum(r"\pi\int_0^R z^2 dz", "a").printed
    z = Symbol("z", real=True)
    assert found == pi * Integral(z**2, (z, 0, R))
    assert not found.has(Group)


@pytest.mark.parametrize("text", [r"\int_0^R z^2 dz", r"R \pm a", r"R \le a", r"\{R, a, 0\}", r"\left[z^2\right]_0^R"])
def test_an_erratum_is_kept_between_builds(text: str) -> None:
    found = erratum(text, "a")
    assert Erratum.decoded(found.encoded()) == found
