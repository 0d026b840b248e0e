"""Equations that are right and were once refused, or took minutes: the algebra behind them decides what it must."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, Float, cos, sin, solve, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.errors import DeriveError
from derive.mechanics.model import system
from tests.stock.described import solved

m, M, k, g, mu = symbols("m M k g mu", positive=True)
x, y = symbols("x y", real=True)


def problem(symbols: str, given: str, answer: str) -> str:
    lines = "\n".join(f"  {line}" for line in given.strip().splitlines())
    return (
        f"title: T\nsolve: system\nsymbols: {{{symbols}}}\ngiven:\n{lines}\nstatement: S.\n"
        f"parts:\n  - {{ask: Find it., answer: [{answer}]}}\n"
    )


def at(value: Expr, **numbers: float) -> float:
    return float(value.xreplace({s: Float(numbers[s.name]) for s in value.free_symbols}).evalf())


def test_axes_that_turn_at_a_rate_with_a_root_leave_a_plain_kinetic_energy(tmp_path: Path) -> None:
    """The sines and cosines of sqrt(k/M) t go out: Coriolis and centrifugal terms are left."""
    given = """\
coordinates: {x: length, y: length}
axes: {frame: [{z: sqrt(k/M)*t}]}
particles: {ball: {mass: m, at: {in: frame, by: [x, y, 0]}}}
"""
    steps = solved(tmp_path, problem("m: mass, M: mass, k: spring constant", given, "equations_of_motion"))
    w, (x_dot, y_dot, x_ddot) = sqrt(k / M), symbols("x_dot y_dot x_ddot", real=True)
    kinetic = steps["kinetic_energy"].value
    assert not kinetic.has(sin) and equal(kinetic, m * ((x_dot - w * y) ** 2 + (y_dot + w * x) ** 2) / 2)
    assert equal(explicit(steps["motion_x"].value), Relation(m * (x_ddot - 2 * w * y_dot - w**2 * x), "=", 0))


def test_a_routhian_keeps_what_a_magnetic_field_adds(tmp_path: Path) -> None:
    """p = m r^2 phi_dot + q B r^2/2, so R = m r_dot^2/2 - (p - q B r^2/2)^2/(2 m r^2)."""
    given = """\
coordinates: {r: positive length, phi: angle}
particles: {ion: {mass: m, at: [r*cos(phi), r*sin(phi), 0]}}
charges: {charge: q, at: ion, magnetic: [0, 0, B]}
"""
    steps = solved(tmp_path, problem("m: mass, q: charge, B: magnetic field", given, "routhian"))
    found = at(steps["routhian"].value, m=2, q=3, B=5, r=0.5, r_dot=0.7, p_phi=1.1)
    assert found == pytest.approx(0.7**2 - (1.1 - 3 * 5 * 0.5**2 / 2) ** 2 / (2 * 2 * 0.5**2))


def test_friction_may_act_along_the_coordinate_that_a_constraint_ties(tmp_path: Path) -> None:
    """Up a straight wire at 45 degrees: (-g sin 45 - mu g cos 45) cos 45."""
    given = """\
coordinates: {x: length, y: length}
particles: {bead: {mass: m, at: [x, y]}}
gravity: g
constraints: {condition: y - x, force: N}
forces: {components: [-mu*N, -mu*N], at: [x, y]}
"""
    steps = solved(tmp_path, problem("m: mass, g: acceleration, mu: positive number", given, "accelerations, N"))
    for coordinate in "xy":
        assert equal(steps[f"acceleration_{coordinate}"].value, -g * (1 + mu) / 2)
    assert equal(next(each.value for each in steps.values() if str(each.symbol) == "N"), m * g / 2)


def test_geodesics_of_a_cone_are_derived(tmp_path: Path) -> None:
    """By the arc length, with r the distance from the axis: r'' = r phi'^2 sin(alpha)^2, and r^2 phi' is constant."""
    given = """\
coordinates: {r: positive length, phi: angle}
lagrangian: sqrt(r_dot**2/sin(alpha)**2 + r**2*phi_dot**2)
"""
    steps = solved(tmp_path, problem("alpha: 'angle in (0, pi/2)'", given, "equations_of_motion, conserved"))
    motion = explicit(steps["motion_r"].value).residual
    here = {"alpha": 0.4, "r": 1.3, "r_dot": 0.6, "phi_dot": 0.9}
    along = {"r_ddot": 1.3 * 0.9**2 * sin(0.4) ** 2, "phi_ddot": -2 * 0.6 * 0.9 / 1.3}
    assert at(motion, **here, **along) == pytest.approx(0, abs=1e-12)
    assert at(motion, **here, r_ddot=0, phi_ddot=0) != pytest.approx(0, abs=1e-3)
    speed = sqrt((0.6 / sin(0.4)) ** 2 + (1.3 * 0.9) ** 2)
    assert at(steps["conserved_phi"].value, **here) == pytest.approx(float(1.3**2 * 0.9 / speed))


@pytest.mark.long
def test_a_disc_that_rolls_on_waves_has_equations_of_motion(tmp_path: Path) -> None:
    given = """\
coordinates: {x: length, phi: angle}
bodies:
  disc:
    shape: disc
    radius: R
    mass: m
    turned: phi
    centre: [x + R*A/b*sin(x/b)/sqrt(1 + A**2/b**2*sin(x/b)**2), A*cos(x/b) + R/sqrt(1 + A**2/b**2*sin(x/b)**2)]
surfaces: {road: {y: A*cos(x/b)}}
contacts: {of: disc, on: road, friction: {rolling: F}}
gravity: g
"""
    letters = "m: mass, R: length, A: length, b: length, g: acceleration"
    steps = solved(tmp_path, problem(letters, given, "equations_of_motion"))
    left = {name: explicit(steps[f"motion_{name}"].value).residual for name in ("x", "phi")}
    still = {"m": 2, "R": 0.3, "A": 0, "b": 1.7, "g": 9, "x": 0.4, "x_dot": 0.7, "phi": 1.0, "phi_dot": 0.2}

    def slope(name: str, letter: str) -> float:
        rest = {"x_ddot": 0, "phi_ddot": 0, "F": 0}
        return at(left[name], **still, **{**rest, letter: 1}) - at(left[name], **still, **rest)

    assert slope("x", "x_ddot") == pytest.approx(2) and slope("phi", "phi_ddot") == pytest.approx(2 * 0.3**2 / 2)
    assert abs(slope("phi", "F") / slope("x", "F")) == pytest.approx(0.3)


@pytest.mark.long
@pytest.mark.parametrize("taken_out", ["", ", for: g", ", for: s", ", for: C"])
def test_a_heavy_top_nods_about_its_steady_precession(tmp_path: Path, taken_out: str) -> None:
    """Omega^2 + (M g l)^2/(A Omega)^2 - 2 M g l cos(alpha)/A, where M g l + A Omega^2 cos(alpha) = C w Omega."""
    given = f"""\
coordinates: {{phi: angle, theta: angle, psi: angle}}
axes: {{body: [{{z: phi}}, {{x: theta}}, {{z: psi}}]}}
bodies: {{top: {{moments: [A, A, C], mass: M, middle: [0, 0, l], held: pivot, turned: body}}}}
gravity: g
conserved: {{psi: C*w}}
results:
  circle: {{steady: lagrangian, values: {{theta: alpha}}, symbol: [Omega, s]}}
  nutation: {{frequency: effective_potential, results: circle{taken_out}}}
"""
    letters = (
        "M: mass, l: length, g: acceleration, A: moment of inertia, C: moment of inertia, "
        "alpha: 'angle in (0, pi/2)', w: angular speed"
    )
    nutation = solved(tmp_path, problem(letters, given, "circle, nutation"))["nutation_squared"].value
    weight, A, C, Omega, tilt = 0.8 * 0.5 * 9.0, 0.7, 0.4, 1.5, 0.6
    w = (weight + A * Omega**2 * float(cos(tilt))) / (C * Omega)
    there = {"M": 0.8, "l": 0.5, "g": 9.0, "A": A, "C": C, "Omega": Omega, "alpha": tilt, "w": w}
    expected = Omega**2 + (weight / (A * Omega)) ** 2 - 2 * weight * float(cos(tilt)) / A
    assert at(nutation, **there, s=w - Omega * float(cos(tilt))) == pytest.approx(expected)


def test_a_string_whose_pieces_have_known_and_unknown_signs_has_its_length(tmp_path: Path) -> None:
    """A swinging Atwood machine: the piece of length d to the left counts with plus."""
    given = """\
coordinates: {r: positive length, theta: angle}
particles: {bob: {mass: m, at: [r*sin(theta), -r*cos(theta)]}, weight: {mass: M, at: [-d, r - l]}}
strings: {from: bob, over: [[0, 0], [-d, 0]], to: weight, length: l + d}
gravity: g
"""
    letters = "m: mass, M: mass, l: length, d: length, g: acceleration"
    steps = solved(tmp_path, problem(letters, given, "acceleration_r"))
    found = at(steps["acceleration_r"].value, m=2, M=3, g=9, r=0.5, theta=0.4, theta_dot=0.7)
    assert found == pytest.approx((2 * 0.5 * 0.7**2 + 2 * 9 * float(cos(0.4)) - 3 * 9) / 5)


def test_two_bodies_and_a_cyclic_coordinate_have_a_routhian(tmp_path: Path) -> None:
    """A disc rolls in a hoop that turns about its fixed axis. With the angles theta of the centre, phi of the hoop and
    s = (R - r) theta, Newton's laws are m s'' = -m g theta + F, M R phi'' = -F and m (R phi'' - s'')/2 = F."""
    given = """\
coordinates: {theta: angle, phi: angle}
bodies:
  drum: {shape: hoop, radius: R, mass: M, centre: [0, 0], turned: phi}
  disc:
    {shape: disc, radius: r, mass: m, centre: [(R-r)*sin(theta), -(R-r)*cos(theta)], turned: (R*phi - (R-r)*theta)/r}
gravity: g
surfaces: {inner: {centre: [0, 0], radius: R, side: inside, of: drum}}
contacts: {of: disc, on: inner, friction: rolling}
assume: r < R
"""
    letters = "m: mass, M: mass, r: length, R: length, g: acceleration"
    steps = solved(tmp_path, problem(letters, given, "frequency"))
    s, phi, force, theta = symbols("s phi force theta")
    laws = [m * s + m * g * theta - force, M * phi + force, m * (phi - s) / 2 - force]  # phi stands for R phi''
    R, r = symbols("R r", positive=True)
    squared = -solve(laws, [s, phi, force])[s] / (theta * (R - r))
    assert equal(steps["frequency"].value ** 2, squared)


def test_a_gyrocompass_points_north(tmp_path: Path) -> None:
    """The torque that turns the spin S with the Earth pulls the axis north, A alpha'' = -S Omega cos(lambda) alpha, and
    the rotation of the body itself reduces S by A Omega cos(lambda)."""
    given = """\
coordinates: {alpha: angle, psi: angle}
axes: {rotor: [{z: Omega*t}, {y: pi/2 - lambda}, {z: alpha}, {y: -pi/2}, {z: psi}]}
bodies: {rotor: {moments: [A, A, C], mass: M, held: centre_of_mass, turned: rotor}}
conserved: {psi: positive S}
"""
    letters = "A: moment of inertia, C: moment of inertia, M: mass, Omega: angular speed, lambda: 'angle in (0, pi/2)'"
    steps = solved(tmp_path, problem(letters, given, "frequency"))
    values = {"A": 2.0, "S": 50.0, "Omega": 0.3, "lambda": 0.8}
    pull = 0.3 * float(cos(0.8))
    assert at(steps["frequency"].value, **values) ** 2 == pytest.approx((50 - 2 * pull) * pull / 2)


def test_a_given_lagrangian_that_is_stationary_at_zero_has_its_modes_there(tmp_path: Path) -> None:
    """Three equal masses on a ring: every state a = b = c is an equilibrium, and two modes have the same frequency."""
    given = """\
coordinates: {a: angle, b: angle, c: angle}
lagrangian: m*R**2*(a_dot**2 + b_dot**2 + c_dot**2)/2 - k*R**2*((a-b)**2 + (b-c)**2 + (c-a)**2)/2
"""
    steps = solved(tmp_path, problem("m: mass, k: spring constant, R: length", given, "frequency"))
    assert steps["frequency_1"].value == 0
    assert equal(steps["frequency_2"].value, sqrt(3 * k / m))


def test_an_equation_is_divided_by_a_difference_that_is_positive(tmp_path: Path) -> None:
    """With a < R, the factor R - a of the equation of motion is not zero."""
    text = """\
title: A bead in a groove
solve: system
symbols: {m: mass, R: length, a: length, g: acceleration}
given:
  coordinates: {theta: angle}
  particles: {bead: {mass: m, at: [(R - a)*sin(theta), -(R - a)*cos(theta)]}}
  gravity: g
  assume: a < R
statement: A bead.
parts:
  - {ask: Find the motion., answer: motion_theta}
"""
    R, a, g = symbols("R a g", positive=True)
    theta, theta_ddot = symbols("theta theta_ddot", real=True)
    assert equal(explicit(solved(tmp_path, text)["motion_theta"].value).residual, (R - a) * theta_ddot + g * sin(theta))


HOOP = """\
coordinates: {{x: length, phi: angle, theta: angle{more}}}
assume: [a < R]
places: {{O: [x, R], P: {{from: O, by: [(R - a)*sin(theta), -(R - a)*cos(theta)]}}}}
bodies:
  hoop: {{shape: hoop, radius: R, mass: M, centre: O, turned: -phi}}
  {bodies}
surfaces:
  floor: {{through: [0, 0], along: [1, 0]}}
  {surfaces}
contacts:
  - {{of: hoop, on: floor, friction: rolling}}
  {contacts}
gravity: g
"""


@pytest.mark.parametrize("inside", ["a disc", "a pendulum"])
def test_a_hoop_that_rolls_has_one_momentum_along_the_floor(tmp_path: Path, inside: str) -> None:
    """The coordinate x is cyclic, and its momentum includes the rotation of the hoop and of a disc that rolls in it."""
    disc = {
        "more": ", psi: angle",
        "bodies": "disc: {shape: disc, radius: a, mass: m, centre: P, turned: psi}",
        "surfaces": "inner: {centre: O, radius: R, side: inside, of: hoop}",
        "contacts": "- {of: disc, on: inner, friction: rolling}",
    }
    given = HOOP.format_map(disc if inside == "a disc" else dict.fromkeys(disc, ""))
    given += "" if inside == "a disc" else "particles: {bob: {mass: m, at: P}}\n"
    letters = "m: mass, M: mass, R: length, a: length, g: acceleration"
    frequency = explicit(solved(tmp_path, problem(letters, given, "frequency"))["frequency"].value)
    (R, a, g), disc_inside = symbols("R a g", positive=True), inside == "a disc"
    squared = g * (4 * M + 3 * m) / (6 * M * (R - a)) if disc_inside else g * (2 * M + m) / (2 * M * (R - a))
    assert equal(frequency**2, squared)


BOARD = """\
coordinates: {{s: length, phi: angle, psi: angle{more}}}
bodies:
  first: {{shape: cylinder, radius: R, height: R, mass: m, centre: [{first}, R], turned: -phi, across: z}}
  second: {{shape: cylinder, radius: R, height: R, mass: m, centre: [d + s/2, R], turned: -psi, across: z}}
particles: {{board: {{mass: M, at: [s, 2*R]}}}}
surfaces:
  floor: {{through: [0, 0], along: [1, 0]}}
  underside: {{through: [0, 2*R], along: [-1, 0], of: board}}
contacts:
  - {{of: first, on: floor, friction: rolling}}
  - {{of: second, on: floor, friction: rolling}}
  - {{of: first, on: underside, friction: rolling}}
  - {{of: second, on: underside, friction: rolling}}
forces: [{{components: [F, 0], at: board}}]
gravity: g
"""
LETTERS_OF_BOARD = "m: mass, M: mass, R: length, d: length, g: acceleration, F: force"


def test_a_board_on_two_rollers_has_four_conditions_of_rolling(tmp_path: Path) -> None:
    """Two of them follow from the others. The rollers move at half the rate: M + 2 (m/4 + m/8) = M + 3 m/4."""
    given = BOARD.format(more="", first="s/2")
    found = explicit(solved(tmp_path, problem(LETTERS_OF_BOARD, given, "acceleration_s"))["acceleration_s"].value)
    assert equal(found, symbols("F", real=True) / (M + 3 * m / 4))


def test_conditions_of_rolling_must_not_relate_the_coordinates_that_are_left(tmp_path: Path) -> None:
    given = BOARD.format(more=", x: length", first="x")
    with pytest.raises(DeriveError, match="also determine x, which is s/2 plus a constant"):
        solved(tmp_path, problem(LETTERS_OF_BOARD, given, "acceleration_s"))


def test_a_lost_condition_of_rolling_contradicts_the_described_motion(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The witness has all conditions as they were given, so an engine that keeps one for each angle is refused."""
    monkeypatch.setattr(system, "_known_by_all", lambda conditions: dict(map(system._known_by, conditions)))
    given = BOARD.format(more=", x: length", first="x")
    with pytest.raises(DeriveError, match="contradicts the motion"):
        solved(tmp_path, problem(LETTERS_OF_BOARD, given, "acceleration_s"))
