"""Numbers, odd values and impossible bodies that once gave wrong pages or internal errors: now right, or refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from sympy import symbols

from derive.algebra.equality import equal
from derive.building.solution import rendered
from derive.errors import DeriveError, Rejected
from derive.figures.extrema import MAXIMUM, MINIMUM, extrema
from derive.mechanics import Disc, Particle, RigidBody, point
from tests.courses import ROOT
from tests.drawn_numbers import with_values
from tests.stock.described import complaints, course_with, messages, solved

k, m, g, l, M, R = symbols("k m g l M R", positive=True)


def problem(symbols_: str, given: str, answer: str, more: str = "", solve: str = "system") -> str:
    """Return a problem with one part; each line of `given` is one key under `given:`."""
    keys = "\n".join(f"  {line}" for line in given.strip().splitlines())
    end = f"statement: A system.\nparts:\n  - {{ask: Find it., answer: {answer}}}\n{more}"
    return f"title: A trial\nsolve: {solve}\nsymbols: {{{symbols_}}}\ngiven:\n{keys}\n{end}"


def page(folder: Path, text: str) -> str:
    return " ".join(rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"].split())


# --- numbers of any size -------------------------------------------------------------------------------------------


def test_the_wobble_of_the_earth_takes_its_moments_of_inertia(tmp_path: Path) -> None:
    """T = 24 h * I_1/(I_3 - I_1) = 86400 s/0.00327 = 2.642e7 s."""
    values = "values: {I_1: 8.0e37 kg m^2, I_3: 8.02616e37 kg m^2, T_0: 24 h}\n"
    text = problem(
        "I_1: moment of inertia, I_3: moment of inertia, T_0: time",
        "moments: [I_1, I_1, I_3]\nrate: 2*pi/T_0",
        "wobble_period_z",
        values,
        solve="rotation",
    )
    found = page(tmp_path, text)
    assert "≈ 2.642×10⁷ s" in found and "8.02616×10³⁷ kg m^2" in found


def test_a_slow_top_has_no_steady_precession(tmp_path: Path) -> None:
    """S^2 = 6.25 is less than 4 A M g l cos(alpha) = 42."""
    values = {"M": "1 kg", "l": "2 m", "g": "0.7 m/s^2", "A": "9.8 kg m^2", "C": "1.5 kg m^2", "S": "2.5 kg m^2/s"}
    text = (ROOT / "problems/library/tops/steady_precession.yaml").read_text(encoding="utf-8")
    text = re.sub(
        r"    (slow|fast): \{limit.*\n", "", text[: text.index("note:")]
    )  # without the numbers of the note, and limiting cases of rates that are not real
    text = text.replace("answer: [steady, rates, slow, fast]", "answer: [steady, rates]")
    text = re.sub(r"^wording:\n(  .*\n)+", "", text, flags=re.MULTILINE)
    found = page(tmp_path, with_values(text, {**values, "alpha": "40 deg"}))
    assert "has no real root" in found and found.count("S² - 4A M g l cos α < 0") == 1


# --- values that are infinite, undefined or not real ---------------------------------------------------------------

DRIVEN = (
    "m: mass, k: spring constant, F: positive force, Omega: angular speed",
    "coordinates: {x: length}\nparticles: {p: {mass: m, at: [x, 0]}}\n"
    "springs: {constant: k, from: [0, 0], to: [x, 0]}\n"
    "forces: {components: [F*cos(Omega*t), 0], at: [x, 0]}\n",
)


def test_a_value_that_makes_a_denominator_vanish_is_refused_with_it(tmp_path: Path) -> None:
    results = (
        "results:\n  s: {solution: motion_x, for: x, start: 0, start_rate: 0}\n"
        "  r: {put_in: s, values: {Omega: sqrt(k/m)}}"
    )
    (told,) = messages(tmp_path, problem(DRIVEN[0], DRIVEN[1] + results, "r"))
    assert "the denominator Omega**2*m - k of `s` vanishes" in told


def test_coordinates_that_are_singular_at_rest_are_refused(tmp_path: Path) -> None:
    pendulum = (
        "coordinates: {theta: angle, phi: angle}\n"
        "particles: {bob: {mass: m, at: [l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta)]}}\n"
        "gravity: g\nat: {theta: 0, phi: 0}"
    )
    (told,) = messages(tmp_path, problem("m: mass, g: acceleration, l: length", pendulum, "linearised"))
    assert "the mass matrix has no inverse there" in told
    pushed = (
        "coordinates: {q: angle}\nparticles: {p: {mass: m, at: [R*sin(q), 0]}}\n"
        "forces: {components: [F, 0], at: [R*sin(q), 0]}"
    )
    for answer in ("equilibria", "stability"):
        (told,) = messages(tmp_path, problem("m: mass, F: positive force, R: length", pushed, answer))
        assert "the coordinates are singular at q = pi/2" in told


def test_a_denominator_of_an_acceleration_that_may_vanish_is_told(tmp_path: Path) -> None:
    pushed = (
        "coordinates: {q: angle}\nparticles: {p: {mass: m, at: [R*sin(q), 0]}}\n"
        "forces: {components: [F, 0], at: [R*sin(q), 0]}"
    )
    text = problem("m: mass, F: positive force, R: length", pushed, "[accelerations, hamiltonian]")
    assert page(tmp_path, text).lower().count("provided that cos q ≠ 0, ") == 2


def test_a_constraint_whose_gradient_vanishes_is_refused(tmp_path: Path) -> None:
    given = (
        "coordinates: {x: length, y: length}\nparticles: {p: {mass: m, at: [x, y]}}\ngravity: g\n"
        "constraints: {condition: (x - y)**2, force: Q}"
    )
    (told,) = complaints(tmp_path, problem("m: mass, g: acceleration", given, "accelerations"))
    assert "the gradient of (x - y)**2 vanishes" in told.message and told.place.line == 8


def test_an_infinite_slope_at_the_end_of_a_plot_is_no_error() -> None:
    from sympy import Symbol, cos, pi, sqrt

    t = Symbol("t", real=True)
    assert extrema(sqrt(1 + cos(t)), t, -float(pi), float(pi))[0].kind == MAXIMUM
    (cusp,) = extrema(sqrt(abs(t)), t, -1.0, 2.0)
    assert cusp.kind == MINIMUM and cusp.at == pytest.approx(0, abs=1e-6)


# --- letters and constants -----------------------------------------------------------------------------------------


def test_a_frequency_with_drag_has_another_letter_where_omega_is_given(tmp_path: Path) -> None:
    given = (
        "coordinates: {theta: angle}\naxes: {hoop: [{z: omega*t}]}\n"
        "places: {bead: {in: hoop, by: [R*sin(theta), 0, -R*cos(theta)]}}\n"
        "particles: {bead: {mass: m, at: bead}}\ndamping: {constant: c, at: bead}\ngravity: g\nat: {theta: 0}"
    )
    letters = "m: mass, R: length, omega: angular speed, g: acceleration, c: damping constant"
    assert str(solved(tmp_path, problem(letters, given, "normal_modes"))["frequency"].symbol) == "Omega"


def test_the_theorem_of_parallel_axes_and_the_tensor_are_two_steps(tmp_path: Path) -> None:
    given = "body: {shape: conical_shell, radius: R, height: h, mass: M}\nabout: tip"
    text = problem("M: mass, R: length, h: length", given, "[inertia_tensor, parallel_axes]", solve="body")
    found = solved(tmp_path, text)
    assert equal(found["inertia_tensor"].value, found["parallel_axes"].value)


@pytest.mark.parametrize(
    ("edit", "line"),
    [
        ("gravity: g*x/a", "8: `gravity` must be constant, but `g*x/a` depends on the coordinate x"),
        ("springs: {constant: k*x/a, from: [0, 0], to: [x, z]}", "8: `constant` must be constant"),
        ("bodies: {b: {shape: disc, radius: x, mass: m, turned: 0, centre: [x, z]}}", "8: `radius` must be constant"),
    ],
)
def test_what_must_be_constant_is_refused_at_its_key(tmp_path: Path, edit: str, line: str) -> None:
    given = (
        f"coordinates: {{x: length, z: length}}\nplaces: {{p: [x, z]}}\nparticles: {{p: {{mass: m, at: p}}}}\n{edit}"
    )
    letters = "m: mass, g: acceleration, a: length, k: spring constant"
    assert messages(tmp_path, problem(letters, given, "lagrangian"))[0].startswith(line)


# --- impossible bodies ---------------------------------------------------------------------------------------------


def holed(at: str, radius: str = "R/2") -> str:
    given = (
        "body:\n  parts:\n    disc: {shape: disc, radius: R, mass: 4*M, at: [0, 0]}\n"
        f"    hole: {{shape: disc, radius: {radius}, mass: M, at: {at}, cut_out: true}}"
    )
    return problem("R: length, M: mass, a: length, b: length", given, "centre_of_mass", solve="body")


def test_a_hole_outside_of_its_body_is_refused(tmp_path: Path) -> None:
    (told,) = complaints(tmp_path, holed("[R, 0]"))
    assert told.code == "no-such-body" and told.place is not None
    solved(tmp_path, holed("[R/2, 0]"))
    solved(tmp_path, holed("[b, 0]", "a"))  # the body may contain the hole


def test_a_map_that_covers_places_twice_is_refused(tmp_path: Path) -> None:
    def sheet(end: str) -> str:
        limits = f"{{r: [0, R], phi: [0, {end}]}}"
        given = f"body: {{position: [r*cos(phi), r*sin(phi)], limits: {limits}, density: rho}}"
        return problem("R: length, rho: surface density", given, "mass", solve="body")

    assert "covers places twice" in messages(tmp_path, sheet("4*pi"))[0]
    solved(tmp_path, sheet("2*pi"))


def test_masses_and_sizes_are_positive_in_scripts_too() -> None:
    with pytest.raises(Rejected, match="positive mass"):
        Disc(R, -M)
    with pytest.raises(Rejected, match="positive radius"):
        Disc(-R, M)
    with pytest.raises(Rejected, match="positive mass"):
        Particle(-M, point(R, R))
    with pytest.raises(Rejected, match="greater than the sum of the other two"):
        RigidBody(M, (M * R**2, M * R**2, 3 * M * R**2))


def test_a_mass_that_may_be_negative_is_taken_to_be_positive_on_the_page(tmp_path: Path) -> None:
    given = (
        "coordinates: {x: length}\nparticles: {p: {mass: m - M, at: [x, 0]}}\n"
        "springs: {constant: k, from: [0, 0], to: [x, 0]}"
    )
    text = problem("m: mass, M: mass, k: spring constant", given, "stability")
    assert "Assume that m > M." in page(tmp_path, text)
    with pytest.raises(DeriveError, match="needs a positive mass"):
        page(tmp_path, text + "values: {m: 1 kg, M: 2 kg, k: 3 N/m}\n")


# --- stability -----------------------------------------------------------------------------------------------------


def test_an_indefinite_kinetic_energy_makes_a_minimum_unstable(tmp_path: Path) -> None:
    """m y'' = k y grows."""
    given = "coordinates: {x: length, y: length}\nlagrangian: m*(x_dot**2 - y_dot**2)/2 - k*(x**2 + y**2)/2"
    found = solved(tmp_path, problem("m: mass, k: spring constant", given, "stability"))
    assert found["stability"].step.outcome == "unstable"


def test_all_principal_minors_decide_and_not_the_leading_ones(tmp_path: Path) -> None:
    """Along (0, 1, 1, 1) the second derivative is 3 k - 6 (3/5) k = -3 k/5."""
    given = (
        "coordinates: {w: length, x: length, y: length, z: length}\n"
        "particles: {p: {mass: m, at: [x, y, z]}, q: {mass: m, at: [w, 0, 0]}}\n"
        "potential: k*w**4/b**2 + k*(x**2 + y**2 + z**2)/2 - k*6/10*(x*y + y*z + z*x)\nat: {w: 0, x: 0, y: 0, z: 0}"
    )
    found = page(tmp_path, problem("m: mass, k: spring constant, b: length", given, "stability"))
    assert "in the ratio (0, 1, 1, 1), the second derivative of U in this direction is -3/5 k" in found


@pytest.mark.parametrize(("y", "outcome", "second"), [("-l", "stable", m * g / l), ("l", "unstable", -m * g / l)])
def test_stability_is_judged_on_the_constraints(tmp_path: Path, y: str, outcome: str, second: object) -> None:
    given = (
        "coordinates: {x: length, y: length}\nparticles: {p: {mass: m, at: [x, y]}}\ngravity: g\n"
        f"constraints: {{condition: x**2 + y**2, equals: l**2, force: Q}}\nat: {{x: 0, y: {y}}}"
    )
    found = solved(tmp_path, problem("m: mass, g: acceleration, l: length", given, "stability"))["stability"]
    assert found.step.outcome == outcome and equal(found.value, second)


def test_a_saddle_is_stable_where_a_force_keeps_one_away_from_its_slope(tmp_path: Path) -> None:
    given = (
        "coordinates: {x: length, y: length}\nparticles: {p: {mass: m, at: [x, y]}}\npotential: k*(x**2 - y**2)/2\n"
        "constraints: {condition: y, force: Q}\nat: {x: 0, y: 0}"
    )
    found = solved(tmp_path, problem("m: mass, k: spring constant", given, "stability"))["stability"]
    assert found.step.outcome == "stable" and equal(found.value, k)


def test_a_restoring_force_of_third_order_is_not_denied(tmp_path: Path) -> None:
    springs = "  - {constant: k, length: a, from: %s, to: puck}"
    given = (
        "coordinates: {x: length, y: length}\nplaces: {left: [-a, 0], right: [a, 0], puck: [x, y]}\n"
        "particles: {puck: {mass: m, at: puck}}\nsprings:\n"
        + springs % "left"
        + "\n"
        + springs % "right"
        + "\nat: {x: 0, y: 0}"
    )
    found = page(tmp_path, problem("m: mass, k: spring constant, a: length", given, "normal_modes"))
    assert "no restoring force of first order, and terms of higher order determine the motion" in found
    free = (
        "coordinates: {x: length, y: length}\nparticles: {p: {mass: m, at: [x, 0]}, q: {mass: m, at: [y, 0]}}\n"
        "potential: k*(x - y)**2/2"
    )
    assert "with no restoring force" in page(tmp_path, problem("m: mass, k: spring constant", free, "normal_modes"))


def test_the_centre_of_mass_of_a_body_told_by_a_map_is_derived_with_named_points_too(tmp_path: Path) -> None:
    """The integral of x * 2 x/L^2 from 0 to L is 2 L/3."""
    given = (
        "body:\n  position: [x, 0, 0]\n  limits: {x: [0, L]}\n  density: x\n  mass: M\n"
        "  points: {light end: [0, 0, 0]}\norigin: light end"
    )
    found = page(tmp_path, problem("M: mass, L: length", given, "centre_of_mass", solve="body"))
    assert "∫(0..L) x² dx" in found and "2/3 L (1, 0, 0)" in found
