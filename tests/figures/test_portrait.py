"""Phase portraits: curves of a constant function, in the direction of the motion."""

from __future__ import annotations

import pytest
from sympy import cos, log, symbols

from derive.errors import Rejected
from derive.figures.portrait import portrait_of

q, p = symbols("q p", real=True)
PLANE, BOX = (q, p), (-2.0, 2.0, -2.0, 2.0)


def test_an_oscillator_goes_round_clockwise_on_a_circle() -> None:
    (line,) = portrait_of((p**2 + q**2) / 2, PLANE, BOX, ((0.5, False),)).lines
    assert all(x**2 + y**2 == pytest.approx(1, abs=1e-3) for x, y in line.points)
    turned = sum(x * d - y * c for (x, y), (c, d) in zip(line.points, line.points[1:], strict=False))
    assert turned == pytest.approx(-2 * 3.14159, rel=1e-2)
    assert line.points[line.heads[0]] == (pytest.approx(0, abs=0.05), pytest.approx(1, abs=0.01))


def test_a_separatrix_is_thick_and_other_motions_go_on_both_sides_of_it() -> None:
    box = (-3.14159, 3.14159, -3.0, 3.0)
    portrait = portrait_of(p**2 / 2 - cos(q), PLANE, box, ((1.0, True), (2.0, False), (0.0, False)))
    rotating = [line for line in portrait.lines if abs(line.points[0][1] ** 2 / 2 - 1) < 0.01]
    assert [(line.points[0][0] < line.points[-1][0]) == (line.points[0][1] > 0) for line in rotating] == [True, True]
    assert {line.is_thick for line in portrait.lines if line not in rotating} == {True, False}
    assert (portrait.low, portrait.high) == (-3, 3)


def test_a_portrait_has_its_centres() -> None:
    portrait = portrait_of(p**2 / 2 - cos(q - 1), PLANE, BOX, ((0.0, False),))
    assert portrait.centres == ((pytest.approx(1.0), 0.0),)


def test_the_energy_at_which_a_body_escapes_is_thick_and_an_open_curve_has_two_arrowheads() -> None:
    x = symbols("x", positive=True)
    expr = p**2 / 2 + 1 / (2 * x**2) - 1 / x
    portrait = portrait_of(expr, (x, p), (0.3, 7.0, -1.2, 1.2), ((-0.3, False), (0.0, False), (0.2, False)))
    assert [is_thick for _, is_thick in portrait.values] == [False, True, False]
    assert [len(line.heads) for line in portrait.lines] == [1, 2, 2]
    (circle,) = portrait.centres
    assert circle == (pytest.approx(1.0), 0.0)


def test_a_value_without_a_curve_is_rejected() -> None:
    with pytest.raises(Rejected) as refused:
        portrait_of(p**2 + q**2, PLANE, BOX, ((9.0, False),))
    assert refused.value.complaints[0].help == "the values in these ranges are from 0 to 8"


def test_a_function_must_be_real_and_finite() -> None:
    for expr in (p**2 + log(q), p**2 + 1 / q):
        with pytest.raises(Rejected, match="not real and finite"):
            portrait_of(expr, PLANE, BOX, ((1.0, False),))


def test_arrowheads_are_away_from_the_ends_of_the_axis() -> None:
    box = (-6.28318, 6.28318, -3.0, 3.0)
    lines = portrait_of(p**2 / 2 - cos(q), PLANE, box, ((2.0, False), (-0.9, False))).lines
    rotating = [line for line in lines if len({x > 0 for x, _ in line.points}) == 2 and abs(line.points[0][1]) > 2]
    assert [abs(line.points[line.heads[0]][0]) < 0.1 for line in rotating] == [True, True]
    half = [line for line in lines if min(abs(x) for x, _ in line.points) > 5]
    assert [abs(line.points[line.heads[0]][1]) < 0.1 for line in half] == [True, True], "where the motion turns round"
