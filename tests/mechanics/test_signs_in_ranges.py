"""Conditions, zeros and contacts where letters lie in ranges; what must not vanish is told, or nothing is concluded."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from sympy import Abs, Expr, Integer, Rational, acos, cos, oo, pi, sin, sqrt, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation
from derive.algebra.ranges import POSITIVE, Range, within
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    coordinate,
    equation_of_motion,
    equilibria,
    lagrangian,
    leaves_contact,
    let,
    put_in,
    roots,
    solution,
    space,
    steady_amplitude,
    weight,
    where,
)
from derive.mechanics.answers import conditions
from derive.mechanics.motion import leaving
from derive.mechanics.vibrations import oscillations
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity
from tests.stock.described import edited, messages, solved

m, M, g, l, R, r, k, w, I = symbols("m M g l R r k omega I", positive=True)
P, c = symbols("P c", real=True)
alpha, theta_0 = symbols("alpha theta_0", positive=True)
theta = coordinate("theta")

ACUTE = Range(Integer(0), pi / 2)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run, within({alpha: ACUTE, theta_0: ACUTE, theta.symbol: ACUTE}):
        yield run


NUMBERS = count(1)
CONDITIONS = ("excluded", "existing", "exists", "elsewhere", "in_step")


def given(value: Expr) -> Quantity:
    return let(f"f_{next(NUMBERS)}", lambda: value)


def told(found: Quantity) -> dict[str, str]:
    return {role: str(formula) for role, formula in found.step.roles if role in CONDITIONS}


# --- where -----------------------------------------------------------------------------------------------------------


def test_the_block_on_the_slope_goes_down_if_it_is_heavy_enough() -> None:
    """Taylor, problem 4.30, with an angle: M sin(alpha) > m, solved for either mass."""
    acceleration = given(g * (M * sin(alpha) - m) / (M + m))
    assert where(acceleration, ">", 0, M).value == Relation(M, ">", m / sin(alpha))
    assert where(acceleration, ">", 0, m).value == Relation(m, "<", M * sin(alpha))


def test_the_wedge_must_be_pushed_with_the_weight_times_the_tangent() -> None:
    """Kleppner and Kolenkow, problem 2.20: F = (M + m) g tan(alpha) keeps the block where it is."""
    F = symbols("F", real=True)
    along = given((-F * cos(alpha) + (M + m) * g * sin(alpha)) / (M + m * sin(alpha) ** 2))
    assert equal(where(along, "=", 0, F).value.right, (M + m) * g * tan(alpha))
    assert where(along, "<", 0, F).value.operator == ">"


def test_the_spool_stays_at_rest_at_the_angle_of_its_radii_if_it_is_pulled() -> None:
    """French, *Newtonian Mechanics*, problem 14-25: cos(beta) = r/R, whatever the force is, but for none."""
    acceleration = given(P * R * (R * cos(alpha) - r) / (I + M * R**2))
    found = where(acceleration, "=", 0, cos(alpha))
    assert found.value == Relation(cos(alpha), "=", r / R)
    assert told(found) == {"excluded": "P != 0", "existing": "R > r"}


def test_an_inequality_is_not_divided_by_what_has_no_known_sign() -> None:
    with pytest.raises(Rejected, match="it would be divided by P, whose sign is unknown"):
        where(given(P * (M - m)), ">", 0, M)
    with within({P: POSITIVE}):
        assert where(given(P * (M - m)), ">", 0, M).value == Relation(M, ">", m)
    with within({P: Range(-oo, Integer(0))}):
        assert where(given(P * (M - m)), ">", 0, M).value == Relation(M, "<", m)


def test_no_angle_has_a_cosine_above_one() -> None:
    assert where(given(cos(alpha) - Rational(3, 2)), "=", 0, cos(alpha)).step.outcome == "never"
    phi = symbols("phi", real=True)
    assert where(given(cos(phi) - Rational(3, 2)), "=", 0, cos(phi)).step.outcome == "never"


def test_what_is_positive_in_the_range_is_positive_always() -> None:
    found = where(given(c**2 * sin(alpha) + cos(alpha) * m), ">", 0, c)
    assert found.step.outcome == "always"
    assert where(given(m * sin(alpha) - M), ">", 0, M).value == Relation(M, "<", m * sin(alpha))


@pytest.mark.parametrize("mark", ["=", "<"])
def test_a_bound_of_the_wrong_function_is_refused(monkeypatch: pytest.MonkeyPatch, mark: str) -> None:
    right = conditions.solved_for_unknown
    wrong = m / cos(alpha)
    monkeypatch.setattr(
        conditions, "solved_for_unknown", lambda *a: Relation(right(*a).left, right(*a).operator, wrong)
    )
    with pytest.raises(Unverified):
        where(given(g * (M * sin(alpha) - m)), mark, 0, M)


def test_equations_that_differ_by_what_may_vanish_are_not_the_same() -> None:
    beta = symbols("beta", real=True)
    assert equal(Relation(sin(alpha) * (c - 1), "=", 0), Relation(c, "=", 1))
    assert not equal(Relation(sin(beta) * (c - 1), "=", 0), Relation(c, "=", 1))
    assert not equal(Relation(cos(2 * alpha) * (c - 1), "=", 0), Relation(c, "=", 1))


# --- zeros -----------------------------------------------------------------------------------------------------------


def falling_stick() -> tuple[Quantity, Quantity]:
    """N = M g (3 cos - 1)^2/4 and F = 3 M g sin (3 cos - 2)/4 at the foot of a stick that falls over."""
    q = theta.symbol
    return given(M * g * (3 * cos(q) - 1) ** 2 / 4), given(3 * M * g * sin(q) * (3 * cos(q) - 2) / 4)


def test_the_forces_at_the_foot_of_a_falling_stick_vanish_where_they_are_known_to() -> None:
    """Morin, *Introduction to Classical Mechanics*, problem 8.28 and chapter 8: cos = 1/3, and 2/3."""
    normal, friction = falling_stick()
    (weightless,) = roots(normal, cos(theta.symbol), key="weightless")
    (turns,) = roots(friction, cos(theta.symbol), key="turns")
    assert (weightless.value, weightless.step.outcome) == (Rational(1, 3), "double")
    assert (turns.value, told(turns)) == (Rational(2, 3), {})


def test_a_factor_that_vanishes_elsewhere_is_told() -> None:
    phi = symbols("phi", real=True)
    (found,) = roots(given(3 * M * g * sin(phi) * (3 * cos(phi) - 2) / 4), cos(phi))
    assert told(found) == {"elsewhere": "sin(phi) = 0"}
    (found,) = roots(given((3 * sin(phi) * cos(phi) - 2 * sin(phi)).expand()), cos(phi))
    assert (found.value, told(found)) == (Rational(2, 3), {"elsewhere": "sin(phi) = 0"})


def test_a_zero_beyond_the_range_is_none() -> None:
    (found,) = roots(given((3 * cos(theta.symbol) - 2) * (2 * cos(theta.symbol) + 1)), cos(theta.symbol))
    assert found.value == Rational(2, 3)
    (none,) = roots(given(2 * cos(theta.symbol) + 1), cos(theta.symbol))
    assert none.step.outcome == "none_positive"


def test_a_common_factor_that_may_vanish_is_told() -> None:
    (found,) = roots(given(P * (R * c - r)), c)
    assert (found.value, told(found)) == (r / R, {"excluded": "P != 0"})


def test_what_is_said_to_vanish_elsewhere_must_do_so(monkeypatch: pytest.MonkeyPatch) -> None:
    phi = symbols("phi", real=True)
    monkeypatch.setattr("derive.mechanics.answers.roots.factors_elsewhere", lambda *_: [tan(phi / 2)])
    with pytest.raises(Unverified):
        roots(given(sin(phi) * (3 * cos(phi) - 2)), cos(phi))


# --- contact that is lost --------------------------------------------------------------------------------------------


def test_the_dumbbell_leaves_the_wall_at_two_thirds_of_the_height() -> None:
    """Morin, problem 5.20 and 8.28: cos = 2/3 cos(theta_0); from upright N is zero at first."""
    q = theta.symbol
    push = given(m * g * (3 * cos(q) - 2 * cos(theta_0)) * sin(q))
    found = leaves_contact(push, cos(q), cos(theta_0))
    assert (found.value, found.step.outcome) == (Relation(cos(q), "=", cos(theta_0) * Rational(2, 3)), "lost")
    upright = leaves_contact(given(m * g * (3 * cos(q) - 2) * sin(q)), cos(q), Integer(1), key="upright")
    assert (upright.value.right, upright.step.outcome) == (Rational(2, 3), "lost_later")


def test_contact_is_told_only_where_the_force_is_known_to_push() -> None:
    q, phi = theta.symbol, symbols("phi", real=True)
    with pytest.raises(Rejected, match="factors of unknown sign that contain phi in a form other than"):
        leaves_contact(given(m * g * (3 * cos(phi) - 2) * sin(phi)), cos(phi), Integer(1))
    with pytest.raises(Rejected, match="not known to be positive"):
        leaves_contact(given(-m * g * (3 * cos(q) - 2) * sin(q)), cos(q), Integer(1))
    assert leaves_contact(given(m * g * (5 - 3 * cos(q)) * sin(q)), cos(q), Integer(1)).step.outcome == "never"
    assert leaves_contact(given(m * g * (5 - 3 * cos(phi))), cos(phi), Integer(1)).step.outcome == "never"


def test_a_contact_that_would_be_lost_elsewhere_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    q = theta.symbol
    right = leaving._held
    monkeypatch.setattr(leaving, "_held", lambda *a: (right(*a)[0], 2 * cos(q) - 1))
    with pytest.raises(Unverified):
        leaves_contact(given(m * g * (3 * cos(q) - 2) * sin(q)), cos(q), Integer(1))


# --- rest, resonance -------------------------------------------------------------------------------------------------


def test_a_bead_on_a_turning_hoop_rests_in_its_range_under_a_condition() -> None:
    """Taylor, example 7.6: between the lowest and the highest place at cos = g/(R omega^2), if omega^2 > g/R."""
    q = coordinate("q")
    place = space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q))
    L = lagrangian(System(Particle(m, place), weight(g)))
    with within({q.symbol: Range(Integer(0), pi)}):
        (rest,) = equilibria(L)
    assert equal(rest.value, acos(g / (R * w**2)))
    assert told(rest) == {"exists": "omega**2 > g/R"}


def driven(F: Expr) -> tuple[Quantity, Any]:
    from derive.mechanics import force, point, spring

    x = coordinate("x", "length")
    place = point(x.symbol, 0)
    L = lagrangian(System(Particle(m, place), spring(k, point(0, 0), place), force((F * cos(w * t), 0), at=place)))
    return equation_of_motion(L, x), x


def test_off_resonance_is_said_where_the_letters_allow_resonance() -> None:
    """Landau, Lifshitz, *Mechanics*, section 22: the forced oscillation F/(m (omega_0^2 - omega^2)) cos(omega t)."""
    motion, x = driven(symbols("F", positive=True))
    found = solution(motion, x, symbols("a", positive=True))
    assert told(found)["excluded"] == "omega != omega_0"
    size, lag = steady_amplitude(motion, x)
    assert told(size)["excluded"] == "omega**2 != k/m"
    assert told(lag) == {"in_step": "omega**2 < k/m"}
    assert lag.value == 0


def test_above_its_own_frequency_it_swings_against_the_force() -> None:
    motion, x = driven(symbols("F", positive=True))
    _, lag = steady_amplitude(put_in(motion, k=m * w**2 / 4), x)
    assert (lag.value, lag.step.outcome) == (pi, "opposite")


# --- as it is written ------------------------------------------------------------------------------------------------

DUMBBELL = """\
title: A dumbbell
solve: system
symbols:
  {m: mass, l: length, g: acceleration, theta_0: 'angle in (0, pi/2)', P: positive force, A: "energy in (0, infinity)"}
given:
  coordinates: {x: length, y: length, q: 'angle in (0, pi/2)'}
  places: {low: [x + l*sin(q), y], up: [x, y + l*cos(q)]}
  particles: {low: {mass: m, at: low}, up: {mass: m, at: up}}
  gravity: g
  constraints: [{condition: x, force: N}, {condition: y, force: F}]
  results:
    leaning: {put_in: energy_function, values: {x_dot: 0, y_dot: 0, y: 0}}
    speed: {speed: leaning, for: q, start: theta_0, results: acceleration_q}
    push: {put_in: N, results: [speed]}
    off: {leaves: push, for: cos(q), start: cos(theta_0)}
    nowhere: {roots: push, for: cos(q)}
statement: A dumbbell.
parts:
  - ask: Where does it leave the wall?
    answer: [off, nowhere]
"""


def test_a_coordinate_has_a_range_in_yaml(tmp_path: Path) -> None:
    """Morin, problem 5.20: the dumbbell leaves the wall where cos(theta) = 2/3 cos(theta_0)."""
    found = solved(tmp_path, DUMBBELL)
    assert equal(found["off"].value.right, cos(symbols("theta_0", positive=True)) * Rational(2, 3))
    assert equal(found["nowhere"].value, found["off"].value.right)


def test_without_its_range_the_message_says_what_to_write(tmp_path: Path) -> None:
    (message,) = messages(tmp_path, edited(DUMBBELL, ("q: 'angle in (0, pi/2)'}", "q: angle}")))
    assert "factors of unknown sign that contain q in a form other than cos(q)" in message


def test_open_ends_and_positive_kinds_are_read(tmp_path: Path) -> None:
    from derive.course.problem import run_solve
    from tests.stock.described import loaded

    problem = loaded(tmp_path, DUMBBELL)
    assert problem.symbols["P"].symbol.is_positive
    assert problem.symbols["A"].symbol.is_positive
    run = Run()
    run_solve(problem, run)
    assert [str(each) for each in run.assumed if each.right == 0 and each.left.name in "PA"] == ["P > 0", "A > 0"]
    assert "q < pi/2" in [str(each) for each in run.assumed]


def test_an_end_at_infinity_is_not_closed(tmp_path: Path) -> None:
    text = edited(DUMBBELL, ("energy in (0, infinity)", "energy in (0, infinity]"))
    assert [said.partition(": ")[2] for said in messages(tmp_path, text)] == ["`A` cannot be infinite"]


def test_a_state_is_within_the_range(tmp_path: Path) -> None:
    text = edited(DUMBBELL, ("  results:\n", "  at: {q: 0}\n  results:\n"))
    (message,) = messages(tmp_path, text)
    assert message.endswith("`q` must be between 0 and pi/2, so it cannot be 0 in a state")


def test_a_length_that_varies_may_be_negative(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(DUMBBELL, ("{x: length,", "{x: 'length in (-1 m, 1 m)',")))
    assert "off" in found


def test_sizes_in_ranges() -> None:
    assert equal(sqrt(sin(alpha) ** 2 * (1 - cos(alpha)) ** 2), sin(alpha) * (1 - cos(alpha)))
    assert not equal(Abs(sin(alpha) - cos(alpha)), sin(alpha) - cos(alpha))


TROUGH = """\
title: A rod in a trough
solve: system
symbols: {M: mass, R: length, beta: 'angle in (0, pi/2)', g: acceleration}
given:
  coordinates: {q: angle}
  places: {middle: [R*cos(beta)*sin(q), -R*cos(beta)*cos(q)]}
  bodies: {rod: {moments: M*R**2*sin(beta)**2/3, mass: M, turned: q, centre: middle}}
  at: {q: 0}
  gravity: g
statement: A rod.
parts:
  - ask: With what frequency does it swing?
    answer: [stability, normal_modes]
"""


def test_a_rod_in_a_trough_swings_whatever_its_length_is(tmp_path: Path) -> None:
    """Lamb, *Dynamics*, section 52: omega^2 = 3 g cos(beta)/(R (1 + 2 cos(beta)^2))."""
    found = solved(tmp_path, TROUGH)
    beta = symbols("beta", positive=True)
    assert equal(found["frequency"].value ** 2, 3 * g * cos(beta) / (R * (1 + 2 * cos(beta) ** 2)))
    assert found["frequency"].step.outcome == "stable"
    assert found["stability"].step.outcome == "stable"


def test_upside_down_it_falls(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(TROUGH, ("beta: 'angle in (0, pi/2)'", "beta: 'angle in (pi/2, pi)'")))
    assert found["frequency"].step.outcome == "unstable"


def test_a_wrong_sign_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(oscillations, "_sort_of", lambda *_: "unstable")
    (message,) = messages(tmp_path, edited(TROUGH, ("[stability, normal_modes]", "normal_modes")))
    assert "disagrees" in message or "could not be confirmed" in message


MORSE = """\
title: Two atoms
solve: system
symbols: {m: mass, A: positive energy, R: length, S: length}
given:
  coordinates: {r: positive length}
  particles: {atom: {mass: m, at: [r, 0]}}
  potential: A*((exp((R - r)/S) - 1)**2 - 1)
  at: {r: R}
statement: Two atoms.
parts:
  - ask: How do they swing?
    answer: [stability, normal_modes]
"""


def test_two_atoms_are_bound_if_the_energy_is_positive(tmp_path: Path) -> None:
    """Morse; Taylor, problem 5.2: U'' = 2 A/S^2, omega^2 = 2 A/(m S^2)."""
    found = solved(tmp_path, MORSE)
    A, S = symbols("A S", positive=True)
    assert equal(found["frequency"].value ** 2, 2 * A / (m * S**2))
    assert found["stability"].step.outcome == "stable"


@pytest.mark.parametrize(("bound", "right"), [(m, True), (-m, False)])
def test_the_other_root_is_no_bound_of_a_positive_letter(bound: Expr, right: bool) -> None:
    """M >= -m says nothing of a positive M, though M^2 = m^2 there too."""
    assert bool(equal(*conditions._beside(Relation(M, ">=", bound), M**2 - m**2, ">="))) is right
