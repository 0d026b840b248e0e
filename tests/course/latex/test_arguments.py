"""How far the argument of a function reaches, and which letters are meant."""

from __future__ import annotations

import pytest
from sympy import Matrix, cos, exp, sin

from tests.course.latex.formula import complaint, letter, marked, value

a, b, n, M, g = (letter(name) for name in ["a", "b", "n", "M", "g"])
theta, phi, omega, t = (letter(name) for name in ["theta", "phi", "omega", "t"])


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"\sin 2\theta", sin(2 * theta)),
        (r"\sin\omega t", sin(omega * t)),
        (r"\cos\theta M g", cos(theta) * M * g),
        (r"\cos\theta\sin\phi", cos(theta) * sin(phi)),
        (r"\sin^2(2\theta) a", sin(2 * theta) ** 2 * a),
        (r"\sin\frac{\theta}{2}", sin(theta / 2)),
        (r"e^{2n}", exp(2 * n)),
        (r"a\hat{\jmath}", Matrix([0, a, 0])),
    ],
)
def test_an_argument_is_the_shortest_run_that_is_an_angle_or_a_number(text: str, meant: object) -> None:
    assert value(text) == meant


@pytest.mark.parametrize(
    ("text", "code", "message"),
    [
        (r"\sin\theta\phi", "ambiguous", r"`\theta` could be only a part of the argument"),
        (r"\sin a", "ambiguous", "the argument of `\\sin` is not clear"),
        (r"\sin", "latex", "the argument of `\\sin` is missing"),
        (r"\sin^{-1} n", "ambiguous", "this could be the inverse function"),
        (r"\sin(\theta)^2", "ambiguous", "this power could belong to the function or to its argument"),
        (r"a(b)", "ambiguous", "`a(b)` could be a function"),
        (r"I_{a+b}", "latex", "the subscript of `I` is not a name"),
        (r"\hat{\theta}", "latex", r"`\hat{\theta}` is a unit vector that cannot be read"),
        (r"28\,\mathrm{rad}", "undeclared-symbol", "`rad` is not declared"),
        ("e a", "undeclared-symbol", "`e` is not declared"),
    ],
)
def test_what_is_not_clear_is_refused(text: str, code: str, message: str) -> None:
    assert marked(text)[0] == code
    assert message in complaint(text).message


@pytest.mark.parametrize(
    ("text", "help_line"),
    [
        (r"\sin^{-1} n", "write `\\arcsin` or `1/\\sin`"),
        (r"28\,\mathrm{rad}", "write the unit of a value under `in:`"),
        ("q", "declare it under `symbols:`"),
        (r"\omega_{00}", "did you mean `omega_0`?"),
    ],
)
def test_a_refusal_says_how_to_write_it(text: str, help_line: str) -> None:
    assert complaint(text).help == help_line
