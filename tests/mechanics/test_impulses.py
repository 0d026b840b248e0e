"""Impacts: Kleppner and Kolenkow, sections 3.5 and 4.14; Goldstein, chapter 2; Landau, sections 17 and 35."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from sympy import Integer, Rational, Symbol, cos, pi, sin, symbols

import derive.mechanics.impacts.impulses as impulses
from derive.algebra.equality import equal
from derive.algebra.expressions import Relation
from derive.algebra.ranges import Range, within
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Ball,
    Coordinate,
    Impact,
    Particle,
    Rod,
    System,
    angular_impulse,
    collision,
    constraint,
    coordinate,
    energy_after,
    impulse,
    kinetic_energy_of,
    meeting_condition,
    momentum_jump,
    point,
    rates_after,
    roots,
    t,
    weight,
    work_of_impulses,
)
from derive.steps.record import recorded
from derive.steps.step import Quantity

M, m, l, b, v, u, J, R, g, e = symbols("M m l b v u J R g e", positive=True)


@pytest.fixture(autouse=True)
def a_run_of_its_own() -> Iterator[None]:
    with recorded():
        yield


def solved(impact: Impact, *coordinates: Coordinate) -> tuple[dict[str, Any], Quantity]:
    T = kinetic_energy_of(impact.system)
    jumps = [momentum_jump(impact, T, q) for q in coordinates]
    found = rates_after(impact, jumps, [meeting_condition(impact, i) for i in range(len(impact.meetings))])
    return {q.key: q.value for q in found}, work_of_impulses(impact, energy_after(impact, T, found), found)


def hanging_rod() -> tuple[System, Coordinate, Coordinate]:
    x, theta = coordinate("x", "length"), coordinate("theta")
    rod = Rod(l, M).held(theta - pi / 2, at="end")
    return System(Particle(m, point(x + 0, -b)), rod, weight(g)), x, theta


def test_a_bullet_gets_stuck_in_a_hanging_rod() -> None:
    """Kleppner, example 6.15 and problem 6.37 by hand: m v b = (M l^2/3 + m b^2) theta_dot."""
    system, x, theta = hanging_rod()
    hit = point(b * sin(theta.symbol), -b * cos(theta.symbol))
    impact = Impact(system, collision(point(x + 0, -b), hit), at={x: 0, theta: 0}, before={x: v})
    found, work = solved(impact, x, theta)
    moment = M * l**2 / 3 + m * b**2
    assert equal(found["theta_dot_after"], m * v * b / moment)
    assert equal(found["K_x"], m * v - m * b * found["theta_dot_after"])
    assert equal(work.value, (m * v * b) ** 2 / moment / 2 - m * v**2 / 2)
    assert work.step.outcome == "lost"


@pytest.mark.parametrize("part", [1, Rational(1, 2), e])
def test_two_particles_on_a_line(part: Any) -> None:
    """Kleppner, section 4.14: the relative velocity turned round, (1 - e^2) mu v^2/2 of the energy lost."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    system = System(Particle(m, point(x + 0, 0)), Particle(M, point(y + 0, 0)))
    impact = Impact(system, collision(point(x + 0, 0), point(y + 0, 0), (1, 0), part), before={x: v, y: -u})
    found, work = solved(impact, x, y)
    first, second = found["x_dot_after"], found["y_dot_after"]
    assert equal(m * first + M * second, m * v - M * u)
    assert equal(second - first, part * (v + u))
    assert equal(work.value, (part**2 - 1) * m * M / (m + M) * (u + v) ** 2 / 2)
    assert work.step.outcome == {1: "zero", Rational(1, 2): "lost"}.get(part, "generic")


def test_equal_balls_part_at_right_angles() -> None:
    """Landau, section 17: of equal masses the one that was at rest goes along the normal, the other across it."""
    names = ("x_1", "y_1", "x_2", "y_2")
    q = [coordinate(name, "length") for name in names]
    alpha = Symbol("alpha", real=True)
    ends = point(q[0] + 0, q[1] + 0), point(q[2] + 0, q[3] + 0)
    system = System(*(Particle(m, end) for end in ends))
    hit = collision(*ends, (cos(alpha), sin(alpha)), 1)
    found, work = solved(Impact(system, hit, at=dict.fromkeys(q, 0), before={q[0]: v}), *q)
    rates = [found[f"{name}_dot_after"] for name in names]
    assert equal(rates[0] * rates[2] + rates[1] * rates[3], 0)
    assert equal(rates[2], v * cos(alpha) ** 2)
    assert work.value == 0


def test_a_rod_falls_on_the_edge_of_a_table() -> None:
    """By hand: M y_dot = K - M v, M l theta_dot = -6 K cos(beta), y_dot - (l/2) theta_dot cos(beta) = v."""
    x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
    beta = Symbol("beta", real=True)
    centre = point(x + 0, y + 0)
    system = System(Rod(l, M).placed(theta, centre=centre))
    end = centre + point(-l / 2 * cos(theta.symbol), -l / 2 * sin(theta.symbol))
    impact = Impact(system, collision(None, end, (0, 1), 1), at={theta: beta}, before={y: -v})
    found, work = solved(impact, x, y, theta)
    assert equal(found["theta_dot_after"], -12 * v * cos(beta) / (l * (1 + 3 * cos(beta) ** 2)))
    assert equal(found["K"], 2 * M * v / (1 + 3 * cos(beta) ** 2))
    assert work.value == 0


def test_the_sweet_spot_of_a_cue_ball() -> None:
    """Landau; Sommerfeld, *Mechanics*, problem IV.1: struck at 7 R/5 above the table the ball rolls at once."""
    x, phi, h = coordinate("x", "length"), coordinate("phi"), Symbol("h", positive=True)
    system = System(Ball(R, M).placed(-phi, centre=point(x + 0, R)))
    struck = point(x + (h - R) * sin(phi.symbol), R + (h - R) * cos(phi.symbol))
    found, work = solved(Impact(system, impulse((J, 0), struck), at={phi: 0}), x, phi)
    assert equal(found["x_dot_after"].subs(h, 7 * R / 5), R * found["phi_dot_after"].subs(h, 7 * R / 5))
    assert equal(found["phi_dot_after"], Rational(5, 2) * J * (h - R) / (M * R**2))
    assert work.step.outcome == "gained"


def test_the_centre_of_percussion_of_a_rod() -> None:
    """Kleppner, problem 6.41: struck at 2 l/3 from its pivot, a rod gives that no impulse; J_X = J (3 b/(2 l) - 1)."""
    x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
    s, c = sin(theta.symbol), cos(theta.symbol)
    centre = point(x + 0, y + 0)
    held = constraint(x - l / 2 * s, force="X"), constraint(y + l / 2 * c, force="Y")
    system = System(Rod(l, M).placed(theta - pi / 2, centre=centre), *held)
    struck = centre + point((b - l / 2) * s, -(b - l / 2) * c)
    impact = Impact(system, impulse((J, 0), struck), at={x: 0, y: -l / 2, theta: 0})
    T = kinetic_energy_of(system)
    conditions = [meeting_condition(impact, i) for i in range(2)]
    found = rates_after(impact, [momentum_jump(impact, T, q) for q in (x, y, theta)], conditions)
    force = next(q for q in found if q.key == "J_X")
    assert equal(force.value, J * (3 * b / (2 * l) - 1))
    assert [each.step.outcome for each in conditions] == ["kept", "kept"]
    (sweet,) = roots(force, b, symbols=("b_0",), key="sweet")
    assert equal(sweet.value, 2 * l / 3)


def test_an_angular_impulse_turns_and_moves_nothing() -> None:
    x, theta = coordinate("x", "length"), coordinate("theta")
    system = System(Rod(l, M).placed(theta, centre=point(x + 0, 0)))
    impact = Impact(system, angular_impulse(J, theta))
    T = kinetic_energy_of(system)
    still, turned = momentum_jump(impact, T, x), momentum_jump(impact, T, theta)
    assert (still.step.outcome, turned.step.outcome) == ("free", "struck")
    assert equal(turned.value, Relation(M * l**2 / 12 * theta.rate, "=", J))


def test_rates_that_are_there_before_are_taken_off() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = point(x + 0, y + 0)
    found, _ = solved(Impact(System(Particle(m, at)), impulse((0, J), at), before={x: v}), x, y)
    assert (found["x_dot_after"], found["y_dot_after"]) == (v, J / m)


def test_questions_about_impacts_that_do_not_fit() -> None:
    system, x, theta = hanging_rod()
    bullet, hit = point(x + 0, -b), point(b * sin(theta.symbol), -b * cos(theta.symbol))
    wrong: list[tuple[Any, str]] = [
        (lambda: Impact(system), "needs an impulse or a collision"),
        (lambda: Impact(system, collision(bullet, hit), before={x: v}), "do not meet"),
        (lambda: Impact(system, collision(bullet, bullet), at={x: 0}), "already have the same velocity"),
        (lambda: Impact(system, collision(bullet, hit, (1, 0), 1), at={x: 0, theta: 0}), "do not approach"),
        (lambda: Impact(system, collision(bullet, hit, (-1, 0), 1), at={x: 0, theta: 0}, before={x: v}), "move apart"),
        (lambda: Impact(system, collision(bullet, hit, (1, 0), 1), at={x: 0, theta: 0}, before={x: -v}), "move apart"),
        (
            lambda: Impact(system, collision(bullet, hit, (0, 1), 1), at={x: 0, theta: 0}, before={x: v}),
            "no relative motion along its normal",
        ),
        (lambda: Impact(system, impulse((J, 0), hit), at={coordinate("z"): 0}), "nothing in this `Impact` moves"),
        (lambda: collision(bullet, hit, (), 1), "needs a normal"),
        (lambda: collision(bullet, hit, (1, 0), 2), "between 0 and 1"),
        (lambda: collision(bullet, hit, (0, 0)), "not all zero"),
        (lambda: angular_impulse(J, v), "does not move"),
        (lambda: impulse((J,), hit), "as many components as the place has"),
        (lambda: Impact(system, impulse((J, 0), hit), before={theta: g * t}), "changes|constant"),
    ]
    for question, told in wrong:
        with pytest.raises(Rejected, match=told):
            question()


def test_rates_before_must_keep_the_constraints() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    system = System(Particle(m, point(x + 0, y + 0)), constraint(y - x))
    with pytest.raises(Rejected, match="do not satisfy a constraint"):
        Impact(system, impulse((J, 0), point(x + 0, y + 0)), before={x: v})


def test_too_few_conditions_determine_nothing() -> None:
    system, x, theta = hanging_rod()
    hit = point(b * sin(theta.symbol), -b * cos(theta.symbol))
    impact = Impact(system, collision(point(x + 0, -b), hit), at={x: 0, theta: 0}, before={x: v})
    T = kinetic_energy_of(system)
    with pytest.raises(Rejected, match="need 3 equations, not 2"):
        rates_after(impact, [momentum_jump(impact, T, q) for q in (x, theta)], [])


def test_an_impulse_may_have_a_part_that_moves_nothing() -> None:
    x, phi = coordinate("x", "length"), coordinate("phi")
    system = System(Ball(R, M).placed(-phi, centre=point(x + 0, R)))
    top = point(x + R * sin(phi.symbol), R + R * cos(phi.symbol))
    impact = Impact(system, impulse((0, -J), top), at={phi: 0})
    jumps = [momentum_jump(impact, kinetic_energy_of(system), q) for q in (x, phi)]
    assert [jump.step.outcome for jump in jumps] == ["free", "free"]


def test_an_impulse_on_the_wrong_one_of_two_is_refused() -> None:
    system, x, theta = hanging_rod()
    hit = point(b * sin(theta.symbol), -b * cos(theta.symbol))
    impact = Impact(system, collision(point(x + 0, -b), hit, (1, 0), 1), at={x: 0, theta: 0}, before={x: v})
    (meeting,) = impact.meetings
    impact.meetings = [replace(meeting, gap=-meeting.gap)]
    with pytest.raises(Unverified, match="jump_theta"):
        momentum_jump(impact, kinetic_energy_of(system), theta)


def test_wrong_laws_of_an_impact_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    system, x, theta = hanging_rod()
    hit = point(b * sin(theta.symbol), -b * cos(theta.symbol))
    impact = Impact(system, collision(point(x + 0, -b), hit), at={x: 0, theta: 0}, before={x: v})
    T = kinetic_energy_of(system)
    with monkeypatch.context() as wrong:
        wrong.setattr(impact, "shares", lambda q: [2 * share for share in Impact.shares(impact, q)])
        with pytest.raises(Unverified, match="jump_theta"):
            momentum_jump(impact, T, theta)
    with monkeypatch.context() as wrong:
        wrong.setattr(impulses, "Terms", lambda *terms: terms[0])
        with pytest.raises(Unverified, match="jump_x"):
            momentum_jump(impact, T, x)
    free = collision(point(x + 0, -b), hit, (1, 0), 1)
    elastic = Impact(system, free, at={x: 0, theta: 0}, before={x: v})
    with monkeypatch.context() as wrong:
        wrong.setattr(elastic, "earlier", lambda value: -Impact.earlier(elastic, value))
        with pytest.raises(Unverified, match="meeting_1"):
            meeting_condition(elastic, 0)
    found = rates_after(impact, [momentum_jump(impact, T, q) for q in (x, theta)], [meeting_condition(impact, 0)])
    monkeypatch.setattr(impulses, "Terms", lambda T, before: T + before / 2)
    with pytest.raises(Unverified, match="work_of_impulses"):
        work_of_impulses(impact, energy_after(impact, T, found), found)


def rebounding() -> tuple[Impact, Coordinate, Coordinate]:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    system = System(Particle(m, point(x + 0, 0)), Particle(M, point(y + 0, 0)))
    return Impact(system, collision(point(x + 0, 0), point(y + 0, 0), (1, 0), e), before={x: v}), x, y


@pytest.mark.parametrize(
    ("part", "word"),
    [
        (Range(Integer(0), Integer(1)), "lost"),
        (Range(Integer(0), Integer(1), (True, True)), "generic"),
        (Range(Integer(1), Integer(2)), "gained"),
    ],
)
def test_the_range_of_the_restitution_tells_whether_energy_is_lost(part: Range, word: str) -> None:
    with within({e: part}):
        _, work = solved(*rebounding())
    assert equal(work.value, (e**2 - 1) * m * M / (m + M) * v**2 / 2)
    assert work.step.outcome == word


@pytest.mark.parametrize("word", ["gained", "generic", "zero"])
def test_another_word_for_the_energy_that_is_lost_is_refused(word: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(impulses, "_gain", lambda value: word)
    with within({e: Range(Integer(0), Integer(1))}), pytest.raises(Unverified):
        solved(*rebounding())
