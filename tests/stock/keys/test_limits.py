"""`limit:` of a value and of an equation."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit, scalar
from tests.stock.described import PENDULUM, edited, messages, solved

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
        (("to: 0}", "to: 0, symbol: f}"), "is an equation, which has no letter of its own"),
        (("for: omega", "for: theta"), "theta changes in the motion"),
    ],
)
def test_what_an_equation_has_no_limit_of(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    assert any(said in message for message in messages(tmp_path, edited(WHEEL, edit)))
