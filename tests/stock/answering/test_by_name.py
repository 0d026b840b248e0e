"""What is made of answers, of bodies and of rotations."""

from __future__ import annotations

from pathlib import Path

from sympy import Rational, sqrt, symbols

from derive.algebra.equality import equal
from tests.stock.bodies import BLOCK, CONE
from tests.stock.described import edited, messages, solved

M, g = symbols("M g", positive=True)


def test_results_of_a_rotation(tmp_path: Path) -> None:
    """By hand: of edges a, 2a, 3a the moments are as 13, 10, 5, the rates as sqrt(3 8/50) to sqrt(3 8/(13 10))."""
    made = ("  along: diagonal\n", "  results: {ratio: {value: wobble_x/wobble_z}}\n")
    found = solved(tmp_path, edited(BLOCK, made, ("answer: torque", "answer: ratio")))
    assert equal(found["ratio"].value, sqrt(Rational(12, 25) / Rational(4, 13)))


def test_results_of_a_body(tmp_path: Path) -> None:
    """By hand: (3/10) M R^2 about the axis."""
    made = ("  about: apex\n", "  about: apex\n  results: {part: {value: moment_of_inertia_z/(M*R**2)}}\n")
    found = solved(tmp_path, edited(CONE, made, ("answer: inertia_tensor", "answer: part")))
    assert equal(found["part"].value, Rational(3, 10))


def test_what_is_made_of_itself_or_of_nothing_is_refused(tmp_path: Path) -> None:
    made = (
        "  about: apex\n",
        "  about: apex\n  results: {one: {value: 2*two}, two: {value: one/2}, three: {value: 2*four}}\n",
    )
    text = edited(CONE, made, ("answer: inertia_tensor", "answer: [one, three]"))
    assert messages(tmp_path, text) == ["7: `one` is made of itself", "7: a body has no answer called `four`"]
