"""What is made of answers by the `results:` of a description."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit, scalar
from tests.stock.described import PENDULUM, edited, messages, solved

m_1, m_2, g, x_0 = symbols("m_1 m_2 g x_0", positive=True)

ATWOOD = """\
title: Atwood's machine
solve: system
symbols: {m_1: mass, m_2: mass, g: acceleration, l: length, x_0: length}
given:
  coordinates: {x: length, y: length}
  particles:
    left: {mass: m_1, at: [0, -x]}
    right: {mass: m_2, at: [l, -y]}
  gravity: g
  constraints: {condition: x + y, equals: l, force: S}
  results:
    made: MADE
statement: Two masses.
parts:
  - ask: Find it.
    answer: [accelerations, made]
"""


@pytest.mark.parametrize(
    ("made", "value"),
    [
        ("{limit: acceleration_x, for: m_2, to: 0}", g),
        ("{put_in: acceleration_x, values: {m_2: m_1/3}}", g / 2),
        ("{limit: acceleration_x, for: m_2, to: infinity}", -g),
    ],
)
def test_what_is_made_of_an_answer(made: str, value: object, tmp_path: Path) -> None:
    found = explicit(solved(tmp_path, edited(ATWOOD, ("MADE", made)))["made"].value)
    found = getattr(found, "args", [found])[0] if found.func.__name__ in {"Truncated", "Expansion"} else found
    assert equal(found, value)


def test_equations_are_solved_for_what_is_wanted(tmp_path: Path) -> None:
    """Of the three equations one may want the force alone."""
    made = "{where: acceleration_x, is: '>', for: m_1}"
    steps = solved(tmp_path, edited(ATWOOD, ("MADE", made)))
    assert str(explicit(steps["made"].value)) == "m_1 > m_2"


def test_a_letter_may_be_given_to_what_is_found(tmp_path: Path) -> None:
    steps = solved(tmp_path, edited(ATWOOD, ("MADE", "{put_in: acceleration_x, values: {m_2: m_1/3}, symbol: a}")))
    assert str(steps["made"].symbol) == "a"


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("{where: acceleration_x, is: '>', for: m_1, symbol: a}", "`symbol` has no effect on `where`"),
        (
            "{put_in: acceleration_x, values: {m_2: m_1}, symbol: [a, b]}",
            "`put_in` finds one quantity, so its `symbol` must be one name",
        ),
        ("{for: m_2}", "`made` needs exactly one of `amplitude`, `answer`"),
        ("{limit: acceleration_x, put_in: acceleration_y}", "`made` needs exactly one of `amplitude`"),
        ("{limit: acceleration_z, for: m_2, to: 0}", "`acceleration_z` is not the name of an answer"),
        ("{limit: made, for: m_2, to: 0}", "`made` is computed from itself"),
        ("{limit: acceleration_x, to: 0}", "`limit` needs `for`"),
        ("{limit: acceleration_x, for: [m_1, m_2], to: 0}", "`limit` needs one symbol as its `for`"),
        ("{put_in: acceleration_x, values: {m_1: m_2, l: x_0}}", "12: `acceleration_x` does not contain `l`"),
        ("{limit: accelerations, for: m_2, to: 0}", "`limit` needs one answer, not 2"),
        ("{speed: lagrangian, for: m_1, start: 0}", "`speed` needs a coordinate as its `for`"),
        (
            "{limit: acceleration_x, for: m_2, order: many}",
            "`order` must be a whole number from 0 to 99, but it is `many`",
        ),
        ("{limt: acceleration_x}", "a result has no key `limt`"),
    ],
)
def test_what_cannot_be_made_is_told(made: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(ATWOOD, ("MADE", made)))
    assert any(said in message for message in found), found


WHEEL = edited(
    PENDULUM,
    ("{A: [l*sin(theta), -l*cos(theta)]}", "{A: [l*sin(theta), a*cos(omega*t) - l*cos(theta)]}"),
    ("k: spring constant", "a: length"),
    ("  gravity: g\n", "  gravity: g\n  results: {slow: {limit: motion_theta, for: omega, to: 0}}\n"),
    ("answer: equations_of_motion", "answer: slow"),
)


def test_an_equation_has_a_limit_too(tmp_path: Path) -> None:
    """Taylor, problem 7.31 and the like: a support that is moved slowly leaves the pendulum as it is."""
    l, g = symbols("l g", positive=True)
    found = solved(tmp_path, WHEEL)["slow"]
    left = explicit(found.value).residual
    assert equal(left, l * scalar("theta_ddot") + g * sin(scalar("theta"))) and not left.has(cos)


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("to: 0}", "to: 0, symbol: f}"), "is not solved for a letter with =, >= or <="),
        (("for: omega", "for: theta"), "theta changes in the motion"),
    ],
)
def test_what_an_equation_has_no_limit_of(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    assert any(said in message for message in messages(tmp_path, edited(WHEEL, edit)))
