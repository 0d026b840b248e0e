"""Prescribed functions of the time: a support that is moved, a string that is pulled in, and wrong laws about them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from sympy import Expr, Integer, Symbol, cos, diff, sin, symbols

from derive.algebra import derivatives, expressions, node
from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, Prescribed, Relation, depends_on_time, explicit, prescribed_in, rate
from derive.errors import DeriveError, Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    coordinate,
    energy_function,
    energy_function_rate,
    equation_of_motion,
    equations_of_motion,
    equilibria,
    force,
    function_of_time,
    lagrangian,
    linearised,
    motor,
    point,
    put_in,
    solution,
    spring,
    string,
    t,
    weight,
)
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.lagrange import energy_function as energy_module
from derive.steps.claims import same_equation
from derive.steps.record import recorded
from derive.steps.step import Quantity
from tests.stock.described import edited, messages, solved

m, g, l, a, w, k = symbols("m g l a omega k", positive=True)


@pytest.fixture(autouse=True)
def _run() -> Iterator[None]:
    with recorded():
        yield


def pendulum(across: bool = True) -> tuple[Quantity, Coordinate, Prescribed]:
    theta, X = coordinate("theta"), function_of_time("X", "length")
    support = point(X, 0) if across else point(0, X)
    L = lagrangian(System(Particle(m, support + point(l * sin(theta.symbol), -l * cos(theta.symbol))), weight(g)))
    return L, theta, X


def holds(motion: Quantity, residual: Expr) -> bool:
    return bool(same_equation(explicit(motion.value).residual, residual))


# --- what follows from the description ---


def test_the_acceleration_of_the_support_drives_a_pendulum() -> None:
    """Landau, Lifshitz, Mechanics, section 5, problem 3, with X = a cos(gamma t)."""
    L, theta, X = pendulum()
    q = theta.symbol
    motion = equation_of_motion(L, theta)
    assert holds(motion, l * theta.acceleration + X.rate(2) * cos(q) + g * sin(q))
    assert list(motion.coordinates) == [q]
    moved = put_in(motion, {X: a * cos(w * t)})
    assert holds(moved, l * theta.acceleration - a * w**2 * cos(w * t) * cos(q) + g * sin(q))


def test_a_support_that_moves_up_and_down_changes_the_weight() -> None:
    L, theta, Y = pendulum(across=False)
    assert holds(equation_of_motion(L, theta), l * theta.acceleration + (g + Y.rate(2)) * sin(theta.symbol))


def test_the_energy_function_changes_with_the_prescribed_motion() -> None:
    L, theta, X = pendulum()
    h = energy_function(L)
    assert h.step.outcome == "changing"
    found = energy_function_rate(h)
    assert found.step.outcome == "changes"
    expected = -m * X.rate(2) * (X.rate() + l * theta.rate * cos(theta.symbol))
    assert equal(explicit(found.value.right), expected)


def test_there_is_no_equilibrium_while_the_support_moves() -> None:
    with pytest.raises(Rejected, match="contains the time"):
        equilibria(pendulum()[0])


def test_the_acceleration_of_the_support_is_the_driving_term_at_small_angles() -> None:
    L, theta, X = pendulum()
    small = linearised(equation_of_motion(L, theta))
    assert isinstance(small, Quantity) and small.step.outcome == "driven"
    assert equal(explicit(small.value.right), -X.rate(2))
    with pytest.raises(Rejected, match="contains X_ddot"):
        solution(small, theta, Integer(0))


def test_a_coefficient_that_changes_with_the_support_is_refused() -> None:
    L, theta, _ = pendulum(across=False)
    with pytest.raises(Rejected, match="must be constant"):
        linearised(equation_of_motion(L, theta))


def test_the_tension_of_a_string_that_is_pulled_in(tmp_path: Path) -> None:
    found = solved(tmp_path, PULLED)
    L, phi = function_of_time("L", "length", positive=True), Symbol("phi", real=True)
    expected = Symbol("m", positive=True) * (L * rate(phi) ** 2 - L.rate(2))
    assert equal(explicit(found["S"].value), expected)
    assert found["energy_function_rate"].step.outcome == "work"


PULLED = """\
title: A puck
solve: system
symbols: {m: mass}
given:
  coordinates: {r: positive length, phi: angle}
  functions: {L: positive length}
  particles: {puck: {mass: m, at: [r*cos(phi), r*sin(phi)]}}
  strings: {from: puck, to: [0, 0], length: L, tension: S}
statement: A puck on a string is pulled in.
parts:
  - ask: Find the tension.
    answer: [S, energy_function_rate]
"""


def test_a_motor_turns_by_a_prescribed_angle() -> None:
    phi, Theta = coordinate("phi"), function_of_time("Theta", "angle")
    place = point(l * sin(phi.symbol), -l * cos(phi.symbol))
    (motion,) = equations_of_motion(lagrangian(System(Particle(m, place), weight(g), *motor(phi, Theta, "tau"))))
    tau = Symbol("tau", real=True)
    assert holds(motion, m * l**2 * phi.acceleration + m * g * l * sin(phi.symbol) - tau)


def test_a_block_on_a_shaken_plane_and_a_ball_on_a_shaken_table(tmp_path: Path) -> None:
    found = solved(tmp_path, SHAKEN)
    mass, Y, X = Symbol("m", positive=True), function_of_time("Y", "length"), function_of_time("X", "length")
    assert equal(explicit(found["N"].value), mass * (g + Y.rate(2)))
    assert equal(explicit(found["F"].value), mass * X.rate(2) * 2 / 7)


SHAKEN = """\
title: A ball on a shaken table
solve: system
symbols: {m: mass, g: acceleration, R: length}
given:
  coordinates: {x: length, y: length, phi: angle}
  functions: {X: length, Y: length}
  bodies: {ball: {shape: ball, radius: R, mass: m, centre: [x, y], turned: -phi}}
  gravity: g
  surfaces: {table: {through: [X, Y], along: [1, 0]}}
  contacts: {of: ball, on: table, normal: N, friction: {rolling: F}}
statement: A ball rolls.
parts:
  - ask: Find the forces.
    answer: [N, F]
"""


# --- values of a prescribed function ---


def test_a_value_replaces_the_rates_too_and_a_constant_stops_the_support() -> None:
    L, theta, X = pendulum()
    motion = equation_of_motion(L, theta)
    at_rest = put_in(motion, {X: Integer(0)}, key="at_rest")
    assert holds(at_rest, l * theta.acceleration + g * sin(theta.symbol))
    falling = put_in(energy_function(L), {X: g * t**2 / 2}, key="falling")
    assert not any(isinstance(s, Prescribed) for s in explicit(falling.value).free_symbols)


SYSTEMS = {
    "across": lambda q, f: (point(f + l * sin(q), -l * cos(q)), ()),
    "turned": lambda q, f: (point(l * sin(q + f / l), f * cos(q)), ()),
    "on a spring": lambda q, f: (point(q * l, 0), (spring(k, point(f, 0), point(q * l, 0), massless=True),)),
    "pushed": lambda q, f: (point(l * sin(q), -l * cos(q)), (force((k * f, 0), point(l * sin(q), -l * cos(q))),)),
}


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("formula", [a * cos(w * t), a * w**2 * t**2 / 2], ids=["swing", "power"])
def test_a_function_with_a_formula_is_the_system_with_this_formula(name: str, formula: Expr) -> None:
    theta, X = coordinate("theta"), function_of_time("X", "length")

    def motion(of: Expr) -> Quantity:
        place, acting = SYSTEMS[name](theta.symbol, of)
        return equation_of_motion(lagrangian(System(Particle(m, place), weight(g), *acting)), theta)

    with recorded():
        coordinate("theta")
        direct = motion(formula)
    assert same_equation(explicit(put_in(motion(X), {X: formula}).value).residual, explicit(direct.value).residual)


@pytest.mark.parametrize(
    ("target", "value", "message"),
    [
        ("X", lambda X, q: a * cos(q), "its value contains theta"),
        ("X", lambda X, q: X * a / l, "its value contains X"),
        ("X_ddot", lambda X, q: g, "X_ddot follows from X"),
    ],
)
def test_a_value_that_is_not_a_function_of_the_time_is_refused(
    target: str, value: Callable[..., Any], message: str
) -> None:
    L, theta, X = pendulum()
    motion = equation_of_motion(L, theta)
    with pytest.raises(Rejected, match=message):
        put_in(motion, **{target: value(X, theta.symbol)})


def test_mistakes_in_a_file_are_told_where_they_are(tmp_path: Path) -> None:
    told = messages(tmp_path, edited(PULLED, ("{L: positive length}", "{phi: angle}"), ("length: L,", "length: m,")))
    assert "6: `phi` is a coordinate, so it cannot be a prescribed function of the time too" in told
    told = messages(tmp_path, edited(PULLED, ("length: L,", "length: L + r,")))
    assert told == ["8: `length` must be constant or a function of the time, but `L + r` depends on the coordinate r"]
    told = messages(tmp_path, edited(PULLED, ("mass: m,", "mass: m*L/L_0,"), ("{m: mass}", "{m: mass, L_0: length}")))
    assert told == ["7: `mass` must be constant, but `m*L/L_0` depends on L, a function of the time"]


def test_a_string_whose_length_depends_on_a_coordinate_is_refused() -> None:
    x, y = coordinate("x"), coordinate("y")
    with pytest.raises(Rejected, match="constant or a function of the time"):
        string(point(0, 0), Particle(m, point(x, y)), l + x.symbol)


# --- wrong laws ---


def test_a_prescribed_function_has_no_equation_of_motion() -> None:
    L, _, X = pendulum()
    with pytest.raises(Rejected, match="does not depend on the coordinate X"):
        equation_of_motion(L, Coordinate(X, "length"))


@pytest.fixture
def fresh() -> Iterator[None]:
    stored = (derivatives._derivative_by_parts, derivatives._letters, node._carried_out)
    for each in stored:
        each.cache_clear()
    yield
    for each in stored:
        each.cache_clear()


def without(*orders: int) -> Callable[[Any], Any]:
    right = expressions.TimeRate.doit

    def wrong(self: Any, **hints: Any) -> Any:
        found = right(self, **hints)
        return found.xreplace({s: Integer(0) for s in prescribed_in(found) if s.order in orders})

    return wrong


def motion_of_pendulum() -> Quantity:
    L, theta, _ = pendulum()
    return equation_of_motion(L, theta)


@pytest.mark.parametrize("orders", [(2,), (1, 2)], ids=["without X_ddot", "as if X were constant"])
def test_a_rate_that_is_left_out_is_refused(
    orders: tuple[int, ...], monkeypatch: pytest.MonkeyPatch, fresh: None
) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(expressions.TimeRate, "doit", without(*orders))
        with pytest.raises(DeriveError, match=r"disagrees|contradicts the motion"):
            motion_of_pendulum()


def test_an_energy_that_is_called_conserved_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    L, _, _ = pendulum()
    for outcome in ("conserved", "energy"):
        monkeypatch.setattr(energy_module, "outcome_of_energy", lambda value, of, outcome=outcome: outcome)
        with pytest.raises(Unverified):
            energy_function(L, key=f"called_{outcome}")


def test_an_energy_rate_without_the_prescribed_motion_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    h = energy_function(pendulum()[0])
    partial = lambda f, s: Integer(0) if s == TIME else expressions.Partial(f, s)  # noqa: E731
    monkeypatch.setattr(energy_module, "Partial", partial)
    with pytest.raises(Unverified, match="disagrees"):
        energy_function_rate(h)


def test_a_substitution_that_keeps_the_rates_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.mechanics.answers import substitution

    L, theta, X = pendulum()
    motion = equation_of_motion(L, theta)
    monkeypatch.setattr(substitution, "derivative", lambda value, *by: diff(value, *by) * 2)
    with pytest.raises(Unverified):
        put_in(motion, {X: a * cos(w * t)})


def test_whether_a_formula_depends_on_time() -> None:
    X, x = function_of_time("X", "length"), coordinate("x").symbol
    assert all(map(depends_on_time, (X, X.rate(), TIME, X * x, Relation(x, "=", X))))
    assert not any(map(depends_on_time, (x, rate(x), l)))
