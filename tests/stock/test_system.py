"""Systems that are described in YAML alone: their answers, and what is said of a description with faults."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, cos, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.steps.record import Run
from tests.stock.described import PENDULUM, complaints, course_with, edited, loaded, messages, solved

l, m, g, k, omega = symbols("l m g k omega", positive=True)
theta, theta_dot, theta_ddot = symbols("theta theta_dot theta_ddot", real=True)

HOOP = (
    ("  places: {A: [l*sin(theta), -l*cos(theta)]}", "  axes: {hoop: [{z: omega*t}]}"),
    ("at: A}", "at: {in: hoop, by: [l*sin(theta), 0, -l*cos(theta)]}}"),
)


def test_the_pendulum_of_the_textbooks(tmp_path: Path) -> None:
    motion = solved(tmp_path, PENDULUM)["motion_theta"]
    assert equal(explicit(motion.value), Relation(l * theta_ddot + g * sin(theta), "=", 0))


def test_a_bead_on_a_hoop_that_turns(tmp_path: Path) -> None:
    """Taylor, example 7.6."""
    motion = solved(tmp_path, edited(PENDULUM, *HOOP))["motion_theta"]
    expected = theta_ddot - (omega**2 * cos(theta) - g / l) * sin(theta)
    assert equal(explicit(motion.value), Relation(expected, "=", 0))


def test_a_spring_has_energy(tmp_path: Path) -> None:
    with_spring = ("  gravity: g\n", "  springs: [{constant: k, from: [0, -l], to: A}]\n")
    energy = solved(tmp_path, edited(PENDULUM, with_spring, ("equations_of_motion", "potential_energy")))
    found = energy["potential_energy"].value
    assert equal(found, Rational(1, 2) * k * ((l * sin(theta)) ** 2 + (l - l * cos(theta)) ** 2))


def test_a_part_asks_for_several_steps_by_one_name(tmp_path: Path) -> None:
    page = rendered(course_with(tmp_path, PENDULUM), "trial/one", only={"text"})
    assert "∂L/∂θ" in page.texts["text"]


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("  gravity: g", "  gravity: l"), "8: `gravity` must be an acceleration, but `l` is a length"),
        (("sin(theta)", "sin(thta)"), "6: `thta` is not declared"),
        (("mass: m", "mass: -m"), "7: `mass` must be positive, but `-m` is not"),
        (("at: A", "at: B"), "7: `B` is not a named place"),
        (
            ("{theta: angle}", "{theta: angle, l: length}"),
            "5: `l` is declared under `symbols`, but is also a coordinate",
        ),
        (("[l*sin(theta), -l*cos(theta)]", "[l]"), "6: `point` needs two components or three, not 1"),
        (("particles:", "particle:"), "7: `given` has no key `particle`"),
        (("answer: equations_of_motion", "answer: motion_phi"), "12: `motion_phi` is not the name of an answer"),
        (("[l*sin(theta), -l*cos(theta)]", "[l, 0]"), "5: no place or rotation in this `System` depends on"),
        (("answer: equations_of_motion", "answer: conserved_theta"), "12: `conserved`: `lagrangian` contains"),
    ],
)
def test_a_fault_is_told_at_its_place(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(PENDULUM, edit))
    assert any(message.startswith(said) for message in found), found


def test_all_faults_are_told_at_once(tmp_path: Path) -> None:
    text = edited(PENDULUM, ("sin(theta)", "sin(thta)"), ("  gravity: g", "  gravity: 9.8"), ("mass: m", "mass: l"))
    found = complaints(tmp_path, text)
    assert [c.place.line for c in found if c.place] == [6, 7, 8]
    assert found[2].help == "write it with its unit, `9.8 m/s^2`"


def test_a_letter_that_the_description_brings_in_is_not_declared(tmp_path: Path) -> None:
    text = edited(
        PENDULUM,
        ("  gravity: g\n", "  gravity: g\n  conserved: {theta: l}\n  constraints: {condition: theta, force: m}\n"),
    )
    found = [c for c in complaints(tmp_path, text) if c.code == "letter-clash"]
    assert [(c.message, c.place.line if c.place else 0) for c in found] == [
        ("`l` already denotes something else", 9),
        ("`m` already denotes something else", 10),
    ]


PLANET = (
    (
        "  coordinates: {theta: angle}",
        "  coordinates: {r: positive length, phi: angle}\n  conserved: {phi: positive J}",
    ),
    ("A: [l*sin(theta), -l*cos(theta)]", "O: [0, 0], A: [r*cos(phi), r*sin(phi)]"),
    ("  gravity: g\n", "  springs: {constant: k, from: O, to: A}\n"),
)


def test_a_constant_may_be_counted_as_positive(tmp_path: Path) -> None:
    """Taylor, section 8.4, for a spring: the circle has r^4 = J^2/(k m), the distance oscillates at 2 sqrt(k/m)."""
    found = solved(tmp_path, edited(PENDULUM, *PLANET, ("equations_of_motion", "[equilibria, normal_modes]")))
    J = symbols("J", positive=True)
    assert equal(explicit(found["rest"].value) ** 4, J**2 / (k * m))
    assert equal(explicit(found["frequency"].value), 2 * (k / m) ** Rational(1, 2))


def test_nothing_is_added_that_is_zero(tmp_path: Path) -> None:
    page = rendered(course_with(tmp_path, edited(PENDULUM, ("  gravity: g\n", ""))), "trial/one", only={"text"})
    assert "+ 0" not in page.texts["text"]


def test_one_equation_of_motion_is_derived_alone(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(PENDULUM, *PLANET, ("equations_of_motion", "motion_r")))
    assert "motion_phi" not in found


def test_a_letter_of_a_page_names_one_of_several_answers(tmp_path: Path) -> None:
    """Taylor, section 5.6: of the amplitude and its lag the amplitude, whose name it is, is greatest."""
    driven = (
        ("theta: angle", "x: length"),
        ("  places: {A: [l*sin(theta), -l*cos(theta)]}", "  places: {A: [x, 0]}"),
        ("  gravity: g\n", DRIVEN),
        ("k: spring constant", "k: spring constant, b: damping constant, F: force"),
        ("equations_of_motion", "resonance"),
    )
    found = solved(tmp_path, edited(PENDULUM, *driven))["resonance_omega"].value
    b = symbols("b", positive=True)
    assert equal(found, sqrt(k / m - b**2 / (2 * m**2)))


DRIVEN = """\
  springs: {constant: k, from: [0, 0], to: A}
  damping: {constant: b, at: A}
  forces: {components: [F*cos(omega*t), 0], at: A}
  results:
    steady: {amplitude: motion_x, for: x}
    resonance: {maximum: steady, for: omega}
"""


def test_two_swings_beat(tmp_path: Path) -> None:
    """Two pendulums with a spring: Fowles, Cassiday, section 11.3."""
    pair = (
        ("theta: angle", "theta: angle, phi: angle"),
        ("-l*cos(theta)]}", "-l*cos(theta)], B: [l + l*sin(phi), -l*cos(phi)]}"),
        ("at: A}", "at: A}, other: {mass: m, at: B}"),
        ("  gravity: g\n", BEATING),
        ("equations_of_motion", "[normal_modes, beating]"),
    )
    found = solved(tmp_path, edited(PENDULUM, *pair))["beating"].value
    assert equal(found, sqrt(g / l + 2 * k / m) - sqrt(g / l))


BEATING = """\
  gravity: g
  springs: {constant: k, length: l, from: A, to: B}
  at: {theta: 0, phi: 0}
  results: {beating: {beats: [frequency_1, frequency_2]}}
"""


def test_a_place_of_a_cyclic_coordinate_asks_for_all_equations(tmp_path: Path) -> None:
    cart = (
        ("theta: angle", "x: length, theta: angle"),
        ("[l*sin(theta),", "[x + l*sin(theta),"),
        ("at: A}", "at: A}, cart: {mass: m, at: [x, 0]}"),
        ("  gravity: g\n", "  gravity: g\n  at: {x: 0, theta: 0}\n"),
        ("equations_of_motion", "normal_modes"),
    )
    found = solved(tmp_path, edited(PENDULUM, *cart))
    assert found["frequency_1"].value == 0
    assert equal(found["frequency_2"].value, sqrt(2 * g / l))


def test_a_distance_is_positive_at_rest(tmp_path: Path) -> None:
    """A pendulum on a spring stands upright only where its weight does not press the spring together."""
    hung = (
        ("theta: angle", "r: positive length, theta: angle"),
        ("[l*sin(theta), -l*cos(theta)]", "[r*sin(theta), -r*cos(theta)]"),
        ("  gravity: g\n", "  gravity: g\n  springs: {constant: k, length: l, from: [0, 0], to: A}\n"),
        ("equations_of_motion", "equilibria"),
    )
    found = solved(tmp_path, edited(PENDULUM, *hung))
    assert equal(found["rest_1"].value[0], l + m * g / k)
    assert found["rest_2"].step.outcome == "where"


def test_nothing_is_drawn_of_a_body_that_has_no_shape(tmp_path: Path) -> None:
    """A body of which only the moment is known and which rolls on nothing, since it does not go on as fast as it turns;
    a page that hides its drawing need not know that there is none."""
    text = edited(PENDULUM, ("  places: {A: [l*sin(theta), -l*cos(theta)]}\n", ""), (
        "particles: {bob: {mass: m, at: A}}",
        "bodies: {cylinder: {moments: m*l**2, mass: m, turned: -theta, centre: [l*theta**2, l]}}",
    )) + "drawings: {system: {at: hidden}}\n"  # fmt: skip
    run = Run()
    run_solve(loaded(tmp_path, text), run)
    assert not run.drawings


def test_an_unknown_key_hides_no_error_of_another_value(tmp_path: Path) -> None:
    wrong = (("mass: m, at", "mass: l, zz: 3, at"), ("-l*cos(theta)]", "-l*cos(thta)]"))
    assert messages(tmp_path, edited(PENDULUM, *wrong)) == [
        "6: `thta` is not declared",
        "7: `mass` must be a mass, but `l` is a length",
        "7: a particle has no key `zz`",
    ]


def test_an_unknown_key_causes_no_further_error(tmp_path: Path) -> None:
    """A key that resembles a known key, or an unknown key of `given:` itself, may declare what other values need."""
    in_place_of_a_name = ("  places: {A", "  named: {A")
    assert [each.partition(": ")[2] for each in messages(tmp_path / "top", edited(PENDULUM, in_place_of_a_name))] == [
        "`given` has no key `named`"
    ]
    found = messages(tmp_path / "nested", edited(PENDULUM, ("mass: m, at", "weight: m, at")))
    assert sorted(each.partition(": ")[2] for each in found) == [
        "a particle has no key `weight`",
        "a particle needs `mass`: its mass",
    ]


CART = (
    ("  coordinates: {theta: angle}", "  coordinates: {x: length, theta: angle}"),
    ("  places: {A: [l*sin(theta), -l*cos(theta)]}", "  places: {A: [x + l*sin(theta), -l*cos(theta)]}"),
    ("{bob: {mass: m, at: A}}", "{bob: {mass: m, at: A}, cart: {mass: m, at: [x, 0]}}"),
    ("equations_of_motion", "equilibria"),
)


def test_a_momentum_without_effect_on_the_equilibria_is_not_assumed(tmp_path: Path) -> None:
    """The effective potential of a pendulum on a cart contains the momentum only in a constant term."""
    run = Run()
    run_solve(loaded(tmp_path, edited(PENDULUM, *CART)), run)
    assert not run.assumed
    assert len([q for q in run.established if q.key.startswith("rest")]) == 2


def test_a_momentum_on_which_the_equilibria_depend_is_assumed(tmp_path: Path) -> None:
    planet = [(old, new.replace("positive J", "J")) for old, new in PLANET]
    run = Run()
    run_solve(loaded(tmp_path, edited(PENDULUM, *planet, ("equations_of_motion", "equilibria"))), run)
    assert [str(each) for each in run.assumed] == ["J != 0"]


def test_all_equilibria_appear_with_a_frequency(tmp_path: Path) -> None:
    """A page with "the possible values are" must not leave out that the pendulum may also stand upright."""
    page = rendered(
        course_with(tmp_path, edited(PENDULUM, *CART[:-1], ("equations_of_motion", "frequency"))),
        "trial/one",
        only={"text"},
    )
    assert "θ_1 = 0,   θ_2 = π" in page.texts["text"]


ON_A_PEG = """\
title: A rod on a peg
solve: system
symbols: {M: mass, l: length, a: length, g: acceleration}
given:
  coordinates: {theta: 'angle in (0, pi/2)'}
  bodies: {rod: {shape: rod, length: l, mass: M, from: [0, -a/tan(theta)], along: [sin(theta), cos(theta)]}}
  gravity: g
  assume: [2*a < l]
statement: A rod <<M>> <<l>> rests on a smooth peg at the distance <<a>> from a smooth wall.
parts:
  - {ask: Find the equilibrium., answer: [equilibria, stability]}
"""


def test_a_rod_on_a_peg_rests_where_the_cube_of_the_sine_has_a_value(tmp_path: Path) -> None:
    """U = M g (l cos(theta)/2 - a cot(theta)) is greatest where sin(theta)^3 = 2 a/l."""
    found = solved(tmp_path, ON_A_PEG)
    a = symbols("a", positive=True)
    assert equal(sin(found["rest"].value) ** 3, 2 * a / l)
    assert dict(found["rest"].step.words)["seen"] == "any", "a range of an angle is not a side of a distance"
    assert found["stability"].step.outcome == "unstable"


def test_an_angle_without_an_upper_limit_has_no_list_of_equilibria(tmp_path: Path) -> None:
    text = """\
title: A pendulum
solve: system
symbols: {m: mass, g: acceleration, l: length}
given:
  coordinates: {theta: positive angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
statement: A pendulum.
parts:
  - {ask: Find the equilibria., answer: equilibria}
"""
    assert "has no limit on one side" in messages(tmp_path, text)[0]  # 2 pi is an equilibrium, too
    within = edited(text, ("positive angle", "'angle in (0, 2*pi)'"))
    assert solved(tmp_path, within)["rest"].value == pi


def test_critical_damping_has_a_rate_and_no_frequency(tmp_path: Path) -> None:
    text = """\
title: A cart with drag
solve: system
symbols: {m: mass, w: angular speed}
given:
  coordinates: {x: length}
  particles: {one: {mass: m, at: [x, 0]}}
  potential: m*w**2*x**2/2
  damping: {constant: 2*m*w, at: [x, 0]}
statement: A cart with drag.
parts:
  - {ask: Describe the motion., answer: frequency}
"""
    assert "the damped motion does not oscillate" in messages(tmp_path, text)[0]
    steps = solved(tmp_path, edited(text, ("frequency}", "normal_modes}")))
    assert steps["decay"].step.outcome == "critical" and "frequency" not in steps
