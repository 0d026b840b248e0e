"""One letter, one thing: steps leave the letters of a problem alone, and what remains twofold is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, sqrt, symbols

from derive.algebra.equality import equal
from derive.steps.record import Run, free_letter, recorded
from tests.stock.described import PENDULUM, complaints, edited, messages, solved

g, m, M, a, A, C, Omega, lamda = symbols("g m M a A C Omega lambda", positive=True)

CUT_STRING = """\
title: A rod of which one string is cut
solve: system
symbols: {M: mass, l: length, g: acceleration}
given:
  coordinates: {x: length, y: length, theta: angle}
  bodies:
    rod: {shape: rod, length: l, mass: M, turned: -theta, centre: [x, y], across: y}
  gravity: g
  constraints:
    - {condition: y + l/2*sin(theta), force: T}
  results:
    first: {put_in: T, values: {theta: 0, theta_dot: 0, x: 0}}
statement: A rod.
parts:
  - ask: Find the tension.
    answer: [kinetic_energy, first]
"""

GYROCOMPASS = """\
title: The gyrocompass
solve: system
symbols: {A: moment of inertia, C: moment of inertia, Omega: angular speed, lambda: 'angle in (0, pi/2)'}
given:
  coordinates: {alpha: angle, psi: angle}
  axes: {wheel: [{z: Omega*t}, {y: pi/2 - lambda}, {z: alpha}, {y: -pi/2}, {z: psi}]}
  bodies:
    wheel: {moments: [A, A, C], held: centre_of_mass, mass: 1 kg, turned: wheel}
  conserved: {psi: L}
  at: {alpha: 0}
statement: A wheel.
parts:
  - ask: Find the frequency.
    answer: frequency
"""

HOOP_WITH_BEAD = """\
title: A hoop that rolls with a bead inside
solve: system
symbols: {M: mass, m: mass, R: length, g: acceleration}
given:
  coordinates: {x: length, theta: angle}
  places:
    O: [x, R]
    B: [x + R*sin(theta), R - R*cos(theta)]
  bodies:
    hoop: {shape: hoop, radius: R, mass: M, turned: -x/R, centre: O, across: z}
  particles:
    bead: {mass: m, at: B}
  gravity: g
  at: {theta: 0}
statement: A hoop.
parts:
  - ask: Find the frequency.
    answer: frequency
"""


def test_a_tension_is_called_t_and_the_kinetic_energy_otherwise(tmp_path: Path) -> None:
    """Morin, *Introduction to Classical Mechanics*, section 8.5: N - M g = M y_ddot, and the end is held: M g/4."""
    found = solved(tmp_path, CUT_STRING)
    assert str(found["kinetic_energy"].symbol) == "K"
    assert equal(found["first"].value, M * g / 4)


def test_a_momentum_is_called_l_and_the_lagrangian_otherwise(tmp_path: Path) -> None:
    """Morin, *Introduction to Classical Mechanics*, chapter 9, the gyrocompass, to first order in Omega: L Omega/A."""
    found = solved(tmp_path, GYROCOMPASS)
    L = found["conserved_psi"].symbol
    assert str(L) == "L"
    assert str(found["lagrangian"].symbol) == "calL"
    expected = (L - A * Omega * cos(lamda)) * Omega * cos(lamda) / A
    assert equal(found["frequency"].value ** 2, expected)


def test_a_routhian_that_nobody_asked_for_leaves_the_radius_its_letter(tmp_path: Path) -> None:
    """Morin, *Introduction to Classical Mechanics*, chapter 6: omega^2 = g (2 M + m)/(2 M R)."""
    found = solved(tmp_path, HOOP_WITH_BEAD)
    R = symbols("R", positive=True)
    assert str(found["routhian"].symbol) == "calR"
    assert equal(found["frequency"].value ** 2, g * (2 * M + m) / (2 * M * R))


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (
            ("conserved: {psi: L}", "conserved: {psi: C*lambda}"),
            "9: `the momentum of psi` must be an angular momentum, but `C*lambda` is a moment of inertia",
        ),
        (("conserved: {psi: L}", "conserved: {psi: positive p_1}"), ""),
        (("conserved: {psi: L}", "conserved: {psi: C}"), "9: `C` already denotes something else"),
    ],
)
def test_a_constant_momentum_has_a_letter(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    text = edited(GYROCOMPASS, edit)
    assert messages(tmp_path, text) == [said] if said else solved(tmp_path, text)


def test_one_letter_for_two_momenta_is_refused(tmp_path: Path) -> None:
    text = edited(CUT_STRING, ("  constraints:\n", "  conserved: {x: p, y: p}\n  constraints:\n"))
    assert "9: `p` already denotes something else" in messages(tmp_path, text)


def test_a_force_that_is_called_as_a_moment_of_inertia_is_refused_at_its_line(tmp_path: Path) -> None:
    text = CUT_STRING.replace("force: T", "force: I").replace("put_in: T", "put_in: I")
    (found,) = complaints(tmp_path, text)
    assert (found.code, found.place.line) == ("letter-clash", 10)
    assert "denotes different quantities" in found.message


def test_letters_that_are_free_stay() -> None:
    with recorded(Run(letters={"T", "U_eff", "v_1"})):
        assert [free_letter("T"), free_letter("T_2"), free_letter("U"), free_letter("U_eff")] == [
            "K",
            "T_2",
            "U",
            "V_eff",
        ]
        assert free_letter("v", "1", "2") == "u"
    with recorded(Run(letters={"Q"})):
        assert free_letter("Q") == "Q"  # of which there is no other
    assert free_letter("T") == "T"


def test_the_frequency_has_a_name_of_its_own(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(PENDULUM, ("equations_of_motion", "[frequency, squared_speed]")))
    assert equal(found["frequency"].value ** 2, g / symbols("l", positive=True))
    assert "squared_speed" in found


def test_an_answer_that_there_is_not_is_told_with_those_that_there_are(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(PENDULUM, ("equations_of_motion", "wavelength")))
    assert found.message == "`wavelength` is not the name of an answer"
    assert found.help.startswith("you may ask for kinetic_energy, potential_energy, lagrangian")


def test_a_constant_momentum_may_be_in_the_state(tmp_path: Path) -> None:
    """Taylor, *Classical Mechanics*, section 8.4: at r^3 = l^2/(m k) of the attraction k/r^2, omega^2 = k/(m r^3)."""
    text = """\
title: An orbit
solve: system
symbols: {m: mass, k: spring constant}
given:
  coordinates: {r: positive length, phi: angle}
  places: {P: [r*cos(phi), r*sin(phi)], O: [0, 0]}
  particles: {planet: {mass: m, at: P}}
  springs: {constant: k, from: O, to: P}
  conserved: {phi: positive l}
  at: {r: 'sqrt(l)/(k*m)**(1/4)'}
statement: An orbit.
parts:
  - ask: Find the frequency.
    answer: frequency
"""
    k = symbols("k", positive=True)
    assert equal(solved(tmp_path, text)["frequency"].value ** 2, 4 * k / m)


def test_a_number_with_its_unit_may_stand_within_an_expression(tmp_path: Path) -> None:
    text = edited(PENDULUM, ("l*sin(theta), -l*cos(theta)", "3 cm*sin(theta), -3 cm*cos(theta)"), ("l: length, ", ""))
    l = symbols("l", positive=True)
    assert equal(solved(tmp_path, text.replace("equations_of_motion", "frequency"))["frequency"].value ** 2, g / l)


def test_values_of_what_an_answer_does_not_contain_need_a_declared_letter(tmp_path: Path) -> None:
    text = edited(CUT_STRING, ("theta_dot: 0, x: 0", "thta_dot: 0"))
    assert messages(tmp_path, text) == ["12: `thta_dot` is not declared"]


SLEEPING_TOP = """\
title: A sleeping top
solve: system
symbols: {M: mass, l: length, g: acceleration, A: moment of inertia, C: moment of inertia, s: angular speed}
given:
  coordinates: {phi: angle, theta: angle, psi: angle}
  axes: {body: [{z: phi}, {x: theta}, {z: psi}]}
  bodies:
    top: {moments: [A, A, C], mass: M, middle: [0, 0, l], held: pivot, turned: body}
  gravity: g
  conserved: {phi: C*s, psi: C*s}
  at: {theta: 0}
  results:
    enough: {where: stability, is: '>', for: s}
statement: A top.
parts:
  - ask: How fast must it spin?
    answer: [effective_potential, stability, enough]
"""


def test_a_constant_momentum_may_be_told_by_what_it_is(tmp_path: Path) -> None:
    """Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7: a top sleeps where (C s)^2 > 4 A M g l."""
    found = solved(tmp_path, SLEEPING_TOP)
    s, l = symbols("s l", positive=True)
    assert equal(found["stability"].value, C**2 * s**2 / (4 * A) - M * g * l)
    assert equal(found["enough"].value.right, 2 * sqrt(A * M * g * l) / C)


def test_a_value_of_a_constant_momentum_is_used_by_an_answer(tmp_path: Path) -> None:
    start, end = SLEEPING_TOP.index("  results:"), SLEEPING_TOP.index("statement:")
    text = edited(SLEEPING_TOP[:start] + SLEEPING_TOP[end:], ("  at: {theta: 0}\n", ""))
    unused = edited(text, ("[effective_potential, stability, enough]", "conserved"))
    assert "no answer depends on the value of the momentum of phi" in str(complaints(tmp_path, unused))
    used = edited(text, ("[effective_potential, stability, enough]", "constant_psi"))
    assert "constant_psi" in solved(tmp_path, used)


def test_a_wrong_value_of_a_constant_momentum_gives_another_condition(tmp_path: Path) -> None:
    """With p_phi = 0 nothing holds it upright: there the effective potential has no bound."""
    text = edited(SLEEPING_TOP, ("{phi: C*s, psi: C*s}", "{phi: 0, psi: C*s}"))
    assert [c.code for c in complaints(tmp_path, text)] == ["no-equilibrium"]
