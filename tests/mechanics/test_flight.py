"""Free flight after a contact is lost or a string goes slack, and where it ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from math import acos, cos, pi, sin, sqrt
from pathlib import Path
from typing import Any

import pytest
from sympy import Expr, Integer, Rational, Symbol

from derive.algebra.expressions import TIME, Relation, explicit
from derive.building.calls import Calls
from derive.errors import DeriveError
from derive.mechanics.motion import flight
from derive.steps.step import Quantity
from derive.witness import runs
from derive.witness.claim import Claim
from derive.witness.dynamics import Blueprint
from tests.courses import ROOT
from tests.stock import described
from tests.stock.described import edited

SPHERE = (ROOT / "tests" / "mechanics" / "flight_from_a_sphere.yaml").read_text(encoding="utf-8")
WITH_PATH = (ROOT / "problems" / "library" / "contacts" / "slack_pendulum.yaml").read_text(encoding="utf-8")
PENDULUM = WITH_PATH[: WITH_PATH.index("  flight_path:")] + WITH_PATH[WITH_PATH.index("note: >") :]
FLOOR = "floor: {through: [0, -R], along: [1, 0]}"


def numbers(value: Expr, **given: float) -> float:
    return float(explicit(value).evalf(subs={s: given.get(s.name, 1.0) for s in explicit(value).free_symbols}))


def pushed(push: str = "v_0/R", **floor: str) -> str:
    return edited(
        SPHERE,
        ("g: acceleration}", "g: acceleration, v_0: positive speed}"),
        ("  gravity: g", "  gravity: g\n  assume: v_0**2 < g*R"),
        ("start: 0, results", f"start: 0, start_rate: {push}, results"),
        *floor.items(),
    )


# --- answers from books ---


@pytest.fixture(autouse=True, scope="module")
def few_simulated_motions() -> Iterator[None]:
    """Simulate fewer motions than usual, because each takes long."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runs, "FLIGHTS", 1)
        patch.setattr(runs, "MANY", 2)
        yield


CALLS = Calls()  # of all tests of this module except those of wrong laws: their problems differ in few lines
solved, complaints = partial(described.solved, calls=CALLS), partial(described.complaints, calls=CALLS)


def test_a_particle_from_rest_hits_the_floor_beyond_the_sphere(tmp_path: Path) -> None:
    """It leaves at cos(theta) = 2/3 with v^2 = 2 g R/3, and falls 5 R/3: x = 5 (sqrt 5 + 4 sqrt 2) R/27."""
    steps = solved(tmp_path, SPHERE)
    assert numbers(steps["landing_x"].value) == pytest.approx(5 * (sqrt(5) + 4 * sqrt(2)) / 27)
    assert numbers(steps["landing_speed"].value) == pytest.approx(2)
    assert steps["landing_clear"].step.outcome == "clear"
    evidence = {each.claim: each.compared.value for each in steps["flight_x"].step.evidence}
    assert evidence["lagrange"] == "route" and evidence["motion"] == "witness"


@pytest.mark.long
def test_a_particle_strikes_a_wall_that_touches_the_sphere(tmp_path: Path) -> None:
    """An examination problem: with the speed sqrt(2 g R/5) at the top it leaves with sqrt(4 g R/5), and strikes the
    vertical tangent 11 R/32 above the point of contact."""
    wall = edited(
        SPHERE,
        ("start: 0, results", "start: 0, start_rate: sqrt(2*g/(5*R)), results"),
        (FLOOR, "floor: {through: [R, 0], along: [0, 1]}"),
        ("landing_x", "landing_y"),
    )
    steps = solved(tmp_path, wall)
    assert numbers(steps["flight_speed"].value) == pytest.approx(sqrt(4 / 5))
    assert steps["landing_y"].value == Rational(11, 32) * Symbol("R", positive=True)


@pytest.mark.long
def test_a_bob_hits_the_pivot(tmp_path: Path) -> None:
    """The string goes slack at cos(theta) = -1/sqrt(3), for v_0^2 = (2 + sqrt(3)) g l."""
    steps = solved(tmp_path, PENDULUM)
    assert numbers(steps["v_0"].value) == pytest.approx(sqrt(2 + sqrt(3)))
    assert numbers(steps["theta_1_root"].value) == pytest.approx(-1 / sqrt(3))


def test_the_string_is_taut_again_at_three_times_the_angle(tmp_path: Path) -> None:
    """The circle of curvature meets the parabola again at -3 theta_1; from 120 degrees at the lowest point.

    The place where the string goes slack is written with a quantity of the author, v_c.
    """
    steps = solved(tmp_path, edited(PENDULUM, ("observations: none", "define: {v_c: sqrt(g*l)}")))
    assert Symbol("v_c", positive=True) in steps["slack"].step.chain[-1].expr.free_symbols
    for angle in (1.7, 2 * pi / 3, 2.8):
        there = numbers(steps["taut_x"].value, theta_1=angle), numbers(steps["taut_y"].value, theta_1=angle)
        assert there == pytest.approx((-sin(3 * angle), -cos(3 * angle)), abs=1e-12)


@pytest.mark.long
def test_without_a_symbol_the_bob_returns_to_its_lowest_point_for_seven_halves(tmp_path: Path) -> None:
    """A particle inside a smooth sphere passes through its lowest point again if v_0^2 = 7 g l/2."""
    text = edited(
        PENDULUM,
        (", theta_1: 'angle in (pi/2, pi)'", ""),
        ("{flight: slack, at: theta_1}", "{flight: slack}"),
        (r"let <<theta_1>> be the angle at which this happens, $\pi/2 < \theta_1 < \pi$, and ", ""),
        ("    angle: {roots: pivot, for: cos(theta_1)}\n", ""),
        ("    start: {put_in: flight_start, results: angle}\n", ""),
        ("    needed: {roots: start, for: v_0, symbol: v_p}\n", ""),
        ("answer: needed", "answer: taut_speed"),
        ("    pivot: {passes: flight, through: [0, 0]}\n", ""),
    )
    steps = solved(tmp_path, text)
    assert not any("theta_1" in str(each.value) for each in steps.values())
    there = [numbers(steps[key].value, v_0=sqrt(3.5)) for key in ("taut_x", "taut_y", "taut_speed")]
    assert there == pytest.approx([0, -1, sqrt(3.5)], abs=1e-12)


@pytest.mark.long
def test_a_pushed_particle_lands_where_its_numbers_say(tmp_path: Path) -> None:
    """Compared with the flight by hand, for v_0^2 = g R/2."""
    steps = solved(tmp_path, pushed())
    speed = sqrt(1 / 2)
    angle = acos(2 / 3 + speed**2 / 3)
    v = sqrt(cos(angle))
    down = v * sin(angle)
    time = -down + sqrt(down**2 + 2 * (cos(angle) + 1))
    assert numbers(steps["landing_time"].value, v_0=speed) == pytest.approx(time)
    assert numbers(steps["landing_x"].value, v_0=speed) == pytest.approx(sin(angle) + v * cos(angle) * time)


@pytest.mark.long
def test_a_flight_may_end_on_a_slope_or_never_reach_a_ceiling(tmp_path: Path) -> None:
    asked = ("[flight, landing_x, landing_speed]", "landing")
    slope = solved(tmp_path, edited(SPHERE, (FLOOR, "floor: {through: [3*R, 0], along: [1, 1]}"), asked))
    x, y = (numbers(slope[f"landing_{name}"].value) for name in "xy")
    assert y == pytest.approx(x - 3)
    missed = solved(tmp_path, edited(SPHERE, (FLOOR, "floor: {through: [0, R], along: [-1, 0]}"), asked))["landing"]
    assert missed.step.outcome == "misses" and str(missed.value) == "R/3 > 0"


def test_the_flight_from_a_sphere_never_meets_the_sphere(tmp_path: Path) -> None:
    text = edited(
        SPHERE,
        ("    floor: {through: [0, -R], along: [1, 0]}\n", ""),
        (", on: floor}", "}"),
        ("[flight, landing_x, landing_speed]", "landing"),
    )
    found = solved(tmp_path, text)["landing"]
    assert found.step.outcome == "clear" and found.value.operator == ">"


# --- bodies, and other parts of the system ---

BALL = edited(
    SPHERE,
    ("coordinates: {r: positive length, theta: angle}", "coordinates: {r: positive length, theta: angle, phi: angle}"),
    ("g: acceleration}", "g: acceleration, a: length}"),
    ("  particles:\n    particle: {mass: m, at: [r*sin(theta), r*cos(theta)]}",
     "  assume: a < R\n  bodies:\n    ball:\n"
     "      {shape: ball, radius: a, mass: m, turned: -phi, centre: [r*sin(theta), r*cos(theta)]}"),
    ("{of: particle, on: sphere, normal: N}", "{of: ball, on: sphere, normal: N, friction: {rolling: F}}"),
    ("{put_in: energy_function, values: {r: R, r_dot: 0}}",
     "{put_in: energy_function, values: {r: R + a, r_dot: 0, phi_dot: (R + a)*theta_dot/a}}"),
    ("    slide: {put_in: motion_theta, values: {r: R, r_dot: 0}}\n", ""),
    ("results: slide", "results: acceleration_theta"),
    ("    rate: {square_root: speed}\n    v: {value: R*rate, symbol: v}\n", ""),
    ("method: newton\n", ""),
    ("answer: v\n", "answer: speed\n"),
    (", rate: hidden, squared_speed: hidden}", "}"),
)  # fmt: skip
EDGE = edited(
    BALL,
    ("sphere: {centre: [0, 0], radius: R}\n    ", ""),
    ("floor: {through: [0, -R]", "floor: {through: [0, -R]"),
    ("{of: ball, on: sphere", "{of: [0, 0], on: ball"),
    ("{r: R + a, r_dot: 0, phi_dot: (R + a)*theta_dot/a}", "{r: a, r_dot: 0, phi_dot: theta_dot}"),
)
CART = "  - {of: cart, on: floor}"
BESIDE_A_CART = edited(
    SPHERE,
    ("coordinates: {r: positive length, theta: angle}", "coordinates: {r: positive length, theta: angle, x: length}"),
    ("g: acceleration}", "g: acceleration, M: mass, k: spring constant}"),
    ("at: [r*sin(theta), r*cos(theta)]}",
     "at: [r*sin(theta), r*cos(theta)]}\n    cart: {mass: M, at: [x, -R]}\n"
     "  springs: {constant: k, from: [0, -R], to: cart}"),
    ("energy_function, values: {r: R, r_dot: 0}}", "energy_function, values: {r: R, r_dot: 0, x: 0, x_dot: 0}}"),
    ("contacts: {of: particle, on: sphere, normal: N}",
     "contacts:\n    - {of: particle, on: sphere, normal: N}\n    - {of: cart, on: floor}"),
)  # fmt: skip


def test_a_ball_that_rolls_off_a_sphere_lands_on_its_rim(tmp_path: Path) -> None:
    """It leaves at cos(theta) = 10/17 with v^2 = 10 g (R + a)/17 and the angular velocity v/a; its centre ends at the
    height a above the floor."""
    steps = solved(tmp_path, BALL)
    size, a = 1.25, 0.25
    angle = acos(10 / 17)
    v = sqrt(10 / 17 * size)
    down, height = v * sin(angle), 10 / 17 * size - (a - 1)
    time = -down + sqrt(down**2 + 2 * height)
    assert numbers(steps["flight_spin"].value, a=a) == pytest.approx(v / a)
    assert numbers(steps["landing_time"].value, a=a) == pytest.approx(time)
    assert numbers(steps["landing_x"].value, a=a) == pytest.approx(size * sin(angle) + v * cos(angle) * time)
    assert numbers(steps["landing_speed"].value, a=a) == pytest.approx(sqrt(v**2 + 2 * height))
    assert {each.claim for each in steps["flight_spin"].step.evidence} >= {"rolling", "torque"}


@pytest.mark.long
def test_a_ball_that_rolls_over_an_edge_keeps_the_energy_of_its_rotation(tmp_path: Path) -> None:
    """From rest: m g (h + ...) = m v^2/2 + (1/5) m v_1^2 on the floor, with v_1^2 = 10 g a/17."""
    steps = solved(tmp_path, EDGE)
    a = 0.25
    fallen = 2 * (1 - a + a) - 2 / 5 * 10 / 17 * a
    assert numbers(steps["landing_speed"].value, a=a) == pytest.approx(sqrt(fallen))


def test_another_body_of_the_system_does_not_change_the_flight(tmp_path: Path) -> None:
    steps = solved(tmp_path, BESIDE_A_CART)
    assert numbers(steps["landing_x"].value) == pytest.approx(5 * (sqrt(5) + 4 * sqrt(2)) / 27)


def test_a_body_with_a_coefficient_of_static_friction_slips_before_it_leaves(tmp_path: Path) -> None:
    text = edited(
        BALL, ("{rolling: F}", "{static: mu_s, force: F}"), ("a: length}", "a: length, mu_s: positive number}")
    )
    (found,) = complaints(tmp_path, text)
    assert found.code == "contradiction" and "slips before the force vanishes" in found.message


def test_a_spring_that_acts_during_the_flight_is_refused(tmp_path: Path) -> None:
    found = complaints(tmp_path, edited(BESIDE_A_CART, ("from: [0, -R], to: cart", "from: [0, 0], to: particle")))
    assert any("a force other than its weight acts on the particle" in each.message for each in found)


# --- wrong laws ---


def departing(**properties: Any) -> Any:
    def patch(monkeypatch: pytest.MonkeyPatch) -> None:
        for name, made in properties.items():
            original = getattr(flight.Departure, name)
            of = original.func if hasattr(original, "func") else original.fget
            monkeypatch.setattr(flight.Departure, name, property(lambda self, of=of, made=made: made(of(self), self)))

    return patch


def ending(wrong: Any) -> Any:
    def patch(monkeypatch: pytest.MonkeyPatch) -> None:
        for name in ("_time_to", "_time_back"):
            right = getattr(flight, name)
            monkeypatch.setattr(flight, name, lambda *given, right=right: wrong(right(*given), given))

    return patch


def outwards(along: tuple[Expr, Expr], departure: Any) -> tuple[Expr, Expr]:
    return -along[1], along[0]


def still_on_the_circle(pulled: tuple[Expr, Expr], departure: Any) -> tuple[Expr, Expr]:
    x, y = departure.place
    return -departure.square * x / (x**2 + y**2), -departure.square * y / (x**2 + y**2)


def other_root(time: Expr, given: tuple[Any, ...]) -> Expr:
    """The root of the quadratic before the departure; for a circle, the opposite time."""
    if time is None or len(given) == 1:
        return None if time is None else -time
    h, _, a = flight._above(*given)
    return h / (a * time)


LAWS = {
    "a velocity away from the sphere": departing(direction=outwards),
    "a velocity backwards": departing(direction=lambda along, _: (-along[0], -along[1])),
    "the speed at the start of the motion": departing(square=lambda square, _: square / 2),
    "no gravity": departing(acceleration=lambda *_: (Integer(0), Integer(0))),
    "gravity upwards": departing(acceleration=lambda pulled, _: (pulled[0], -pulled[1])),
    "the constraint still acts": departing(acceleration=still_on_the_circle),
    "the flight begins elsewhere": departing(place=lambda place, _: (place[0], place[1] / 2)),
    "a landing before the departure": ending(other_root),
    "the departure taken as the landing": ending(lambda time, _: None if time is None else Integer(0)),
    "a landing at twice the time": ending(lambda time, _: None if time is None else 2 * time),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("text", [SPHERE, PENDULUM], ids=["sphere", "pendulum"])
def test_a_wrong_law_is_refused(law: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    LAWS[law](monkeypatch)
    with pytest.raises(DeriveError) as refused:
        described.solved(tmp_path, text)
    assert {each.code for each in refused.value.complaints} & {"unverified", "contradicts-motion"}


def spinning(factor: Any) -> Any:
    def patch(monkeypatch: pytest.MonkeyPatch) -> None:
        right = flight.Departure.held_rates.func
        wrong = property(lambda self: {q: factor * each for q, each in right(self).items()})
        monkeypatch.setattr(flight.Departure, "held_rates", wrong)

    return patch


def landing_on_its_centre(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flight, "_gap", lambda place, known, target: flight._distance(place, target))


@pytest.mark.parametrize(
    "law", [spinning(2), spinning(-1), landing_on_its_centre], ids=["twice", "backwards", "centre"]
)
def test_a_wrong_law_of_a_body_is_refused(law: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    law(monkeypatch)
    with pytest.raises(DeriveError) as refused:
        described.solved(tmp_path, BALL)
    assert {each.code for each in refused.value.complaints} & {"unverified", "contradicts-motion"}


@pytest.mark.long
def test_a_particle_that_stays_near_the_sphere_is_not_said_to_be_clear(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A string goes slack inside its circle: the particle comes back."""
    monkeypatch.setattr(flight, "_time_back", lambda known: None)
    with pytest.raises(DeriveError):
        described.solved(tmp_path, PENDULUM)


def test_the_witness_follows_the_flight(tmp_path: Path) -> None:
    steps = solved(tmp_path, PENDULUM)
    for key, judge in (("flight_x", runs.flight), ("flight_y", runs.flight), ("taut_time", runs.landing)):
        claim = claimed(steps[key], steps)
        assert judge(claim)
        wrong = claim.quantity.value * Rational(101, 100)
        assert judge(replace(claim, quantity=replace(claim.quantity, value=wrong))) is not None
        assert not judge(replace(claim, quantity=replace(claim.quantity, value=wrong)))


def claimed(quantity: Quantity, steps: dict[str, Quantity]) -> Claim:
    from derive.mechanics.model.description import Described
    from derive.steps.rule import Judged

    known = steps["flight_x"].needed(flight.InFlight)
    described = next(fact for each in quantity.ancestors() if (fact := each.fact(Described)) is not None)
    inputs = {"flight": known, "target": None, "component": Integer(quantity.key.endswith("y"))}
    judged = Judged(quantity.value, inputs, {})
    return Claim(quantity, judged, quantity.step.outcome, Blueprint(described.description))


# --- wrong questions ---


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("through: [0, 0]}", "through: [0]}", "needs the two components of a place"),
        ("'angle in (pi/2, pi)'", "'angle in (0, pi/2)'", "outside the range of theta_1"),
        ("at: theta_1}", "at: theta}", "must be a symbol for the value of theta"),
        ("{flight: slack, at", "{flight: speed, at", "`speed` is not such a place"),
        ("{lands: flight}", "{lands: slack}", "need both components of a flight"),
        ("{lands: flight}", "{lands: flight, at: l}", "`at` has no effect on `lands`"),
        ("through: [0, 0]}", "through: [2*l, 0]}", "the place is not known to be inside the circle"),
        ("through: [0, 0]}", "through: [l/2, 0]}", "the place is not known to be ahead of the particle"),
        ("start_rate: v_0/l", "start_rate: -v_0/l", "whether theta increases"),
        ("{lands: flight}", "{lands: flight, on: floor}", "`floor` is not a surface of this system"),
        ("start_rate: v_0/l", "start_rate: sqrt(g/l)", "states that contact is never lost"),
    ],
)
def test_a_wrong_question_is_refused(old: str, new: str, said: str, tmp_path: Path) -> None:
    found = complaints(tmp_path, edited(PENDULUM, (old, new)))
    assert any(said in each.message for each in found)
    assert all(each.place is not None for each in found)


def test_a_flight_without_symbols_has_no_condition_to_pass_a_place(tmp_path: Path) -> None:
    for place, said in (("5*R*(sqrt(5) + 4*sqrt(2))/27, -R", "in any case"), ("2*R, R", "never passes")):
        text = edited(
            SPHERE,
            ("    landing: {lands: flight, on: floor}", f"    landing: {{passes: flight, through: [{place}]}}"),
            ("    floor: {through: [0, -R], along: [1, 0]}\n", ""),
            ("[flight, landing_x, landing_speed]", "landing"),
        )
        (found,) = complaints(tmp_path, text)
        assert found.code == "no-condition" and said in found.message


@pytest.mark.long
def test_a_plane_that_moves_or_is_on_the_wrong_side_is_refused(tmp_path: Path) -> None:
    (moving,) = complaints(tmp_path, edited(SPHERE, (FLOOR, "floor: {through: [0, -R - g*t**2], along: [1, 0]}")))
    assert "needs a plane at rest" in moving.message
    (above,) = complaints(tmp_path, edited(SPHERE, (FLOOR, "floor: {through: [0, R], along: [1, 0]}")))
    assert "departs below the plane" in above.message


def test_a_surface_that_nothing_uses_is_an_error(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(SPHERE, (", on: floor}", "}")))
    assert "no contact uses the surface `floor`" in found.message


def test_a_force_other_than_the_weight_is_refused(tmp_path: Path) -> None:
    text = edited(
        SPHERE,
        ("g: acceleration}", "g: acceleration, q: positive charge, K: positive electric field}"),
        ("  gravity: g", "  gravity: g\n  charges: {charge: q, at: particle, electric: [0, -K]}"),
    )
    assert any("a force other than its weight acts" in each.message for each in complaints(tmp_path, text))


def test_the_relation_of_the_departure_is_the_one_of_the_loss(tmp_path: Path) -> None:
    start = solved(tmp_path, PENDULUM)["flight_start"]
    assert isinstance(start.value, Relation) and TIME not in start.value.free_symbols
    assert str(start.value) == "cos(theta_1) = 2/3 - v_0**2/(3*g*l)"


def test_a_flight_that_begins_downwards_has_no_greatest_height_later(tmp_path: Path) -> None:
    text = edited(
        SPHERE,
        ("flight: {flight: lost}", "flight: {flight: lost}\n    top: {maximum: flight_y, for: t}"),
        ("[flight, landing_x, landing_speed]", "[flight, landing_x, landing_speed, top]"),
    )
    assert any("is before the motion begins" in each.message for each in complaints(tmp_path, text))


def test_a_plane_that_the_particle_departs_from_and_does_not_meet_again_is_refused(tmp_path: Path) -> None:
    (leaves,) = complaints(tmp_path, edited(SPHERE, (FLOOR, "floor: {through: [0, 2*R/3], along: [-1, 0]}")))
    assert "departs on the plane, and does not rise above it" in leaves.message
