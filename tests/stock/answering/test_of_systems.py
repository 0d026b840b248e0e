"""What parts may ask of a system by name, and when a name does not apply."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from tests.stock.described import PENDULUM, course_with, edited, messages, solved

PLANET = """\
title: A planet
solve: system
symbols: {m: mass, k: coupling constant}
given:
  coordinates: {r: positive length, phi: angle}
  places: {sun: [0, 0], planet: [r*cos(phi), r*sin(phi)]}
  particles: {planet: {mass: m, at: planet}}
  central: {energy: -k/d, distance: d, from: sun, to: planet}
  conserved: {phi: l}
statement: A planet.
parts:
  - ask: Find it.
    answer: [conserved, effective_potential, equilibria]
"""


@pytest.mark.parametrize(
    ("asked", "keys"),
    [
        ("[kinetic_energy, potential_energy]", {"kinetic_energy", "potential_energy"}),
        ("momenta", {"p_theta"}),
        ("energy_function", {"energy_function"}),
        ("[hamiltonian, hamilton_equations]", {"hamiltonian", "canonical_theta", "canonical_p_theta"}),
        ("[linearised, normal_modes, period]", {"linearised_theta", "frequency", "period"}),
        ("[equilibria, stability]", {"rest_1", "rest_2"}),
    ],
)
def test_a_pendulum_answers_by_name(asked: str, keys: set[str], tmp_path: Path) -> None:
    assert keys <= solved(tmp_path, edited(PENDULUM, ("equations_of_motion", asked))).keys()


def test_a_planet_has_a_circular_orbit(tmp_path: Path) -> None:
    """Goldstein, section 3.3: r = l^2/(m k)."""
    steps = solved(tmp_path, PLANET)
    assert str(steps["rest"].value) == "l**2/(k*m)"


HOOP = """\
title: A bead on a turning hoop
solve: system
symbols: {R: length, m: mass, g: acceleration, omega: angular speed}
given:
  coordinates: {theta: angle}
  axes: {hoop: [{z: omega*t}]}
  particles: {bead: {mass: m, at: {in: hoop, by: [R*sin(theta), 0, -R*cos(theta)]}}}
  gravity: g
  at: rest_3
statement: A bead.
parts:
  - ask: Find it.
    answer: [equilibria, normal_modes]
"""
SPHERE = """\
title: A particle on a sphere
solve: system
symbols: {m: mass, R: length, g: acceleration}
given:
  coordinates: {r: positive length, theta: angle}
  particles: {one: {mass: m, at: [r*sin(theta), r*cos(theta)]}}
  gravity: g
  constraints: {condition: r - R, force: N}
statement: A particle.
parts:
  - ask: Find it.
    answer: [acceleration_theta, N, energy_function]
"""
WIRE = """\
title: A bead on a turning wire
solve: system
symbols: {m: mass, g: acceleration, omega: angular speed, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {r: positive length}
  axes: {wire: [{z: omega*t}]}
  particles: {bead: {mass: m, at: {in: wire, by: [r*sin(alpha), 0, r*cos(alpha)]}}}
  gravity: g
statement: A bead.
parts:
  - ask: Find it.
    answer: [equilibria, stability]
"""
CYLINDER = """\
title: A cylinder that rolls inside another
solve: system
symbols: {M: mass, b: length, a: length, g: acceleration}
given:
  coordinates: {phi: angle, psi: angle}
  places: {C: [b*sin(phi), -b*cos(phi)]}
  bodies: {cylinder: {shape: disc, radius: a, mass: M, turned: psi, centre: C, across: z}}
  surfaces: {hollow: {centre: [0, 0], radius: a + b, side: inside}}
  contacts: {of: cylinder, on: hollow, friction: rolling}
  gravity: g
statement: A cylinder.
parts:
  - ask: Find it.
    answer: [equations_of_motion, normal_modes]
"""


HILL = """\
title: A charge on a hill in a magnetic field
solve: system
symbols: {m: mass, q: charge, B: magnetic field, k: spring constant}
given:
  coordinates: {x: length, y: length}
  particles: {particle: {mass: m, at: [x, y]}}
  potential: -k*(x**2 + y**2)/2
  charges: {charge: q, at: [x, y], magnetic: B}
statement: A charge.
parts:
  - ask: Is it stable?
    answer: [equilibria, stability]
"""
TOP = """\
title: A sleeping top
solve: system
symbols: {M: mass, l: length, g: acceleration, A: moment of inertia, C: moment of inertia}
given:
  coordinates: {alpha: angle, beta: angle, psi: angle}
  axes: {body: [{x: alpha}, {y: beta}, {z: psi}]}
  bodies: {top: {moments: [A, A, C], mass: M, middle: [0, 0, l], held: pivot, turned: body}}
  gravity: g
  conserved: {psi: S}
  at: {alpha: 0, beta: 0}
statement: A top.
parts:
  - ask: How fast must it spin?
    answer: stability
"""


@pytest.mark.parametrize(
    ("described", "difference"),
    [(HILL, "B**2*q**2 - 4*k*m"), pytest.param(TOP, "-4*A*M*g*l + S**2", marks=pytest.mark.long)],
)
def test_what_turning_may_hold_is_judged_by_the_small_motions(described: str, difference: str, tmp_path: Path) -> None:
    """Goldstein, section 5.7 for the top."""
    found = solved(tmp_path, described)["stability"]
    assert found.step.outcome == "depends" and found.value.operator == ">"
    assert str((found.value.left - found.value.right).expand()) == difference


def test_equations_are_linearised_about_a_state_of_rest_by_its_name(tmp_path: Path) -> None:
    """Taylor, equation 7.80."""
    found = solved(tmp_path, HOOP)["frequency"].value
    R, g, omega = symbols("R g omega", positive=True)
    assert equal(found**2, omega**2 - (g / (omega * R)) ** 2)


def test_a_force_of_constraint_is_asked_for_by_its_letter_and_the_energy_is_conserved(tmp_path: Path) -> None:
    steps = solved(tmp_path, SPHERE)
    assert {"acceleration_theta", "N", "energy_function"} <= steps.keys()
    assert steps["energy_function"].step.outcome == "energy"


def test_a_letter_with_a_range_leaves_no_condition_of_rest(tmp_path: Path) -> None:
    steps = solved(tmp_path, WIRE)
    assert steps["rest"].step.outcome == "only"


def test_a_coordinate_that_rolling_gives_has_no_equation_of_its_own(tmp_path: Path) -> None:
    """Landau, Lifshitz, section 32, problem 6: omega^2 = 2 g/(3 (R - a))."""
    steps = solved(tmp_path, CYLINDER)
    assert str(steps["frequency"].value ** 2) == "2*g/(3*b)"
    assert "motion_psi" not in steps


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("multipliers", "`multipliers` needs constraints enforced by forces"),
        ("conserved", "no cyclic coordinate of this system has a constant momentum"),
        ("no_slip", "nothing rolls in this system"),
        ("lagrangan", "`lagrangan` is not the name of an answer"),
    ],
)
def test_an_ask_that_does_not_apply_is_told_where_it_is_asked(asked: str, said: str, tmp_path: Path) -> None:
    (found,) = messages(tmp_path, edited(PENDULUM, ("equations_of_motion", asked)))
    assert found.startswith("12: ") and said in found


TRIANGLE = """\
title: A satellite near a point that makes an equilateral triangle with two masses
solve: system
symbols: {m: mass, mu: positive number, Omega: angular speed}
given:
  coordinates: {x: length, y: length}
  axes: {frame: [{z: Omega*t}]}
  places: {satellite: {in: frame, by: [x, y, 0]}}
  particles: {satellite: {mass: m, at: satellite}}
  potential: m*Omega**2*(x**2/4 - 5*y**2/4 - 3*sqrt(3)/2*(1 - 2*mu)*x*y)/2
  at: {x: 0, y: 0}
statement: A satellite.
parts:
  - ask: Is it stable?
    answer: [linearised, stability]
"""


@pytest.mark.long
def test_where_several_conditions_are_needed_the_page_has_all_of_them(tmp_path: Path) -> None:
    """Routh's is one of two: Goldstein, section 3.12."""
    page = rendered(course_with(tmp_path, TRIANGLE), "trial/one", only={"text"}).texts["text"]
    told = ["several conditions, of which the first is", "27μ² - 27μ + 1 > 0", "The last is", "1 > μ"]
    verdict = "If all of them are satisfied, the equilibrium is stable to first order"
    places = [" ".join(page.split()).index(piece) for piece in [*told, verdict]]
    assert places == sorted(places)
    assert page.count("  * 27μ²") == page.count("  * 1 > μ") == 1


def test_one_may_ask_for_small_motions_and_for_the_stability_that_they_decide(tmp_path: Path) -> None:
    text = edited(TRIANGLE, ("  at: {x: 0, y: 0}\n", ""), ("3*sqrt(3)/2*(1 - 2*mu)*x*y", "0*mu*x*y"))
    assert {"linearised_x", "stability_1"} <= solved(tmp_path, text).keys() or "stability" in solved(tmp_path, text)


BEAM = """\
title: A carriage on a turning beam
solve: system
symbols: {m: mass, k: spring constant, K: spring constant, r_0: length, omega: angular speed}
given:
  coordinates: {r: positive length, y: length}
  axes: {beam: [{z: omega*t}]}
  places: {O: [0, 0, 0], carriage: {in: beam, by: [r, 0, 0]}, mass: {in: beam, by: [r, y, 0]}}
  particles: {mass: {mass: m, at: mass}}
  springs:
    - {constant: k, length: r_0, from: O, to: carriage, massless: true}
    - {constant: K, from: carriage, to: mass, massless: true}
statement: A carriage.
parts:
  - ask: Where is it at rest?
    answer: [equilibria, stability]
"""


@pytest.mark.long
def test_rest_on_a_turning_beam_needs_what_keeps_it_and_stability_what_holds_it_across(tmp_path: Path) -> None:
    """Goldstein, problem 2.21: at r = k r_0/(k - m omega^2), where omega^2 < k/m; stable where omega^2 < K/m too."""
    found = solved(tmp_path, BEAM)
    m, k, K, r, w = symbols("m k K r_0 omega", positive=True)
    assert found["rest"].step.outcome == "where"
    assert equal(found["rest"].value[0], k * r / (k - m * w**2))
    assert explicit(found["stability"].value) == Relation(w**2, "<", K / m)
