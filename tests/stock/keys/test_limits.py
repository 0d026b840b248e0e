"""`limits:` of a problem: what it may say, the steps that it becomes, and what is refused with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import sqrt, symbols

from derive.algebra.equality import equal
from derive.building.derivations import steps_key
from derive.building.solution import derived, rendered
from derive.errors import Rejected
from tests.stock.described import course_with, edited, loaded

l, m, M, g = symbols("l m M g", positive=True)

CART = """\
title: A pendulum on a cart
solve: system
symbols: {l: length, m: mass, M: mass, g: acceleration}
given:
  coordinates: {x: length, theta: angle}
  places: {cart: [x, 0], bob: [x + l*sin(theta), -l*cos(theta)]}
  particles: {cart: {mass: M, at: cart}, bob: {mass: m, at: bob}}
  gravity: g
statement: A bob on a cart.
parts:
  - ask: Find the modes.
    answer: normal_modes
limits:
  - {of: frequency, letter: M, to: infinity, is: sqrt(g/l), why: as for a pendulum of length <<l>>}
  - {of: frequency, letter: m/M, to: infinity}
  - {of: frequency, where: {m: M}, is: sqrt(2*g/l)}
"""


def page(folder: Path, text: str = CART) -> str:
    return " ".join(rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"].split())


def test_each_limit_is_a_step_that_the_page_tells_at_its_end(tmp_path: Path) -> None:
    derivation, *_ = derived(loaded(tmp_path, CART))
    assert derivation.closing == (("frequency_limit",), ("frequency_limit_2",), ("frequency_case",))
    shown = {key for keys in derivation.parts for key in keys}
    assert not shown & {key for keys in derivation.closing for key in keys}
    values = [derivation.step(key).result for keys in derivation.closing for key in keys]
    roots = (sqrt(g / l), sqrt(g * m / (M * l)), sqrt(2 * g / l))
    assert all(equal(*pair) for pair in zip(values, roots, strict=True))
    text = page(tmp_path)
    assert "Special and limiting cases" in text
    assert "as for a pendulum of length l." in text and "For m = M, ω_0 becomes" in text


def test_where_a_limit_stands_in_the_file_changes_no_step_and_what_it_says_does(tmp_path: Path) -> None:
    moved, other = (
        edited(CART, ("A bob on a cart.", "A bob hangs on a cart.")),
        edited(CART, ("letter: m/M", "letter: m")),
    )
    keys = [steps_key(loaded(tmp_path / name, text)) for name, text in {"a": CART, "b": moved, "c": other}.items()]
    assert keys[0] == keys[1] != keys[2]


def test_a_limit_of_another_shape_is_told_once(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as refusal:
        loaded(tmp_path, edited(CART, ("letter: m/M", "letter: [m, M]")))
    assert [c.message for c in refusal.value.complaints] == ["`letter` must be an expression, but it is a list"]


def test_a_problem_without_limits_has_no_such_section(tmp_path: Path) -> None:
    assert "Limiting case" not in page(tmp_path, CART[: CART.index("limits:")])


def test_what_only_a_limit_rests_on_is_told_before_it(tmp_path: Path) -> None:
    energy = edited(
        CART[: CART.index("limits:")] + "limits: [{of: potential_energy, letter: m, is: 0}]\n",
        ("answer: normal_modes", "answer: kinetic_energy"),
    )
    derivation, *_ = derived(loaded(tmp_path, energy))
    assert "potential_energy" in derivation.keys and "potential_energy" not in derivation.parts[0]
    text = page(tmp_path, energy)
    assert text.index("Limiting case") < text.index("U = ")


@pytest.mark.parametrize(
    ("old", "new", "at", "said"),
    [
        ("is: sqrt(g/l), ", "is: sqrt(g/(2*l)), ", (14, 50), r"`frequency` is sqrt\(g\)/sqrt\(l\) in this case, not"),
        ("is: sqrt(g/l), ", "is: g/l, ", (14, 50), "in this case"),
        ("is: sqrt(2*g/l)", "is: sqrt(g/l)", (16, 40), "in this case"),
        ("of: frequency, letter: M,", "of: frequence_2, letter: M,", None, "frequence_2"),
        ("is: sqrt(g/l), ", "known: kinetic_energy, ", (14, 53), "`frequency_limit` is"),
        ("is: sqrt(g/l), ", "known: frequency, ", (14, 53), "would prove nothing"),
        ("letter: M,", "letter: Q,", (14, 29), "Q"),
        ("where: {m: M}", "where: {q: M}", (16, 29), "`q` is not a symbol of this problem"),
    ],
)
def test_what_is_not_so_is_refused_where_it_stands(
    old: str, new: str, at: tuple[int, int] | None, said: str, tmp_path: Path
) -> None:
    with pytest.raises(Rejected, match=said) as caught:
        derived(loaded(tmp_path, edited(CART, (old, new))))
    place = caught.value.complaints[0].place
    assert place is not None
    if at is not None:
        assert (place.line, place.column) == at


@pytest.mark.parametrize(
    "wrong",
    [
        "{of: frequency}",
        "{letter: M, to: infinity}",
        "{of: frequency, letter: M, where: {m: M}}",
        "{step: frequency, letter: M}",
        "{of: frequency, where: {m: M}, to: 0}",
        "frequency",
    ],
)
def test_a_limit_says_of_what_and_in_one_way(wrong: str, tmp_path: Path) -> None:
    with pytest.raises(Rejected):
        loaded(tmp_path, edited(CART, ("{of: frequency, letter: m/M, to: infinity}", wrong)))


def test_a_known_result_is_compared_by_a_step_of_its_own(tmp_path: Path) -> None:
    two = edited(
        CART,
        ("  gravity: g\n", "  gravity: g\n  results:\n    alone: {value: sqrt(g/l), symbol: Omega}\n"),
        ("is: sqrt(g/l), ", "known: alone, "),
    )
    derivation, *_ = derived(loaded(tmp_path, two))
    assert derivation.closing[0] == ("frequency_limit", "frequency_limit_known")
    step = derivation.step("frequency_limit_known")
    assert (step.rule, step.inputs) == ("answers.known_case", ("frequency_limit", "alone"))
    text = page(tmp_path, two)
    assert "in agreement with (" in text
