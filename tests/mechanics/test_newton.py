"""Newton's and Euler's laws for single bodies, conservation of energy, and the laws of momentum in an impact."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from sympy import Integer, Symbol, cos, diff, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit, rate, scalar
from derive.algebra.ranges import Range, within
from derive.errors import DeriveError, Rejected
from derive.mechanics.impacts import momentum_laws
from derive.mechanics.newton import energy as by_energy
from derive.mechanics.newton import second_law, single_bodies, torque_law
from derive.mechanics.newton.claims import constraint_forces_do_no_work, direction, same_equation
from derive.mechanics.newton.directions import Direction
from derive.mechanics.newton.single_bodies import Alone, Force
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from tests.mechanics.test_connections import value_at
from tests.newton_euler.random_systems import Trial, key_of, on_a_curve, on_a_surface, problem, with_strings
from tests.stock.described import edited, messages, solved

TRIALS = [*on_a_surface(), *on_a_curve(), *with_strings()]
m, g, l, R = symbols("m g l R", positive=True)
m_1, m_2, M = symbols("m_1 m_2 M", positive=True)


def by(method: str, text: str) -> str:
    return edited(text, ("solve: system\n", f"solve: system\nmethod: {method}\n"))


@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_newtons_laws_give_the_accelerations_and_forces(trial: Trial, tmp_path: Path) -> None:
    """The numbers come from the independent equations of `tests.newton_euler`."""
    steps = solved(tmp_path, by("newton", problem(trial)))
    assert any(step.step.rule in ("newton.second_law", "newton.torque_law") for step in steps.values())
    assert not any(step.step.rule == "lagrange.lagrangian" for step in steps.values())
    numbers, wanted = trial.state(Random(trial.name))
    found = {name: value_at(explicit(steps[key_of(name)].value), numbers) for name in trial.unknowns}
    assert found == pytest.approx({name: wanted[name] for name in trial.unknowns}, rel=1e-6, abs=1e-6)


def test_the_sense_of_a_rotation_follows_from_the_ranges_of_its_letters() -> None:
    c = Symbol("c", real=True)
    with pytest.raises(Rejected, match="unknown whether the rotation by 1/c"):
        single_bodies.sense_of(1 / c)
    with within({c: Range(Integer(-2), Integer(-1))}):
        assert single_bodies.sense_of(1 / c) == -1


def test_a_predicate_of_newtons_laws_tests_an_angle_in_its_range() -> None:
    """The cosine is positive for an acute angle only."""
    angle = Symbol("alpha", real=True)
    for least, greatest, sign in ((0, pi / 2, 1), (pi / 2, pi, -1)):
        with within({angle: Range(Integer(0) + least, Integer(0) + greatest)}):
            words, inputs = {"way": "upwards"}, {"coordinate": R, "place": (Integer(0), R * cos(angle)), "moving": [R]}
            assert direction(Judged(Integer(0), inputs, words=words), "") == (sign == 1)


# --- equations of textbooks ------------------------------------------------------------------------------------------

ATWOOD = """\
title: Atwood
solve: system
method: newton
symbols: {m_1: mass, m_2: mass, M: mass, R: length, g: acceleration, l: length}
given:
  coordinates: {x: positive length, y: positive length}
  particles: {left: {mass: m_1, at: [0, -x]}, right: {mass: m_2, at: [l/4, -y]}}
  gravity: g
  strings: {from: left, over: [[0, 0], [l/4, 0]], to: right, length: l, tension: S}
statement: Two masses.
parts:
  - ask: Find the equations.
    answer: [equations_of_motion, accelerations, S]
"""
ON_INCLINE = """\
title: A block
solve: system
method: newton
symbols: {m: mass, g: acceleration, alpha: 'angle in (0, pi/2)', mu: positive number}
given:
  coordinates: {s: length, n: length}
  particles: {block: {mass: m, at: [s*cos(alpha) + n*sin(alpha), n*cos(alpha) - s*sin(alpha)]}}
  gravity: g
  surfaces: {slope: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: block, on: slope, normal: N, friction: {sliding: mu, direction: [cos(alpha), -sin(alpha)]}}
statement: A block.
parts:
  - ask: Find the equations.
    answer: equations_of_motion
"""
POLAR = """\
title: A pendulum
solve: system
method: newton
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {r: positive length, theta: angle}
  particles: {bob: {mass: m, at: [r*sin(theta), -r*cos(theta)]}}
  gravity: g
  strings: {from: [0, 0], to: bob, length: l, tension: T}
statement: A bob.
parts:
  - ask: Find the equations.
    answer: equations_of_motion
"""
LADDER = """\
title: A ladder
solve: system
method: newton
symbols: {M: mass, l: length, g: acceleration, mu_s: positive number}
given:
  coordinates: {x: length, y: length, theta: 'angle in (0, pi/2)'}
  bodies: {ladder: {shape: rod, length: l, mass: M, along: [-cos(theta), sin(theta)], centre: [x, y]}}
  gravity: g
  surfaces: {wall: {through: [0, 0], along: [0, -1]}, floor: {through: [0, 0], along: [1, 0]}}
  contacts:
    - {of: ladder.far_end, on: wall, normal: K}
    - {of: ladder.end, on: floor, normal: N, friction: {static: mu_s, force: F}}
statement: A ladder.
parts:
  - ask: Find the forces at rest.
    answer: equilibria
"""
ROLLS = """\
title: A disc
solve: system
method: angular_momentum
symbols: {M: mass, R: length, g: acceleration, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {s: length, phi: angle}
  bodies:
    disc:
      {shape: disc, radius: R, mass: M, turned: -phi, across: z,
       centre: [s*cos(alpha) + R*sin(alpha), R*cos(alpha) - s*sin(alpha)]}
  surfaces: {slope: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: disc, on: slope, friction: {rolling: F, direction: left}}
  gravity: g
statement: A disc.
parts:
  - ask: Find the motion.
    answer: [motion_phi, accelerations, F]
"""
WITHOUT_LETTER = edited(
    ROLLS,
    ("{s: length, phi: angle}", "{s: length}"),
    ("turned: -phi", "turned: -s/R"),
    ("friction: {rolling: F, direction: left}", "friction: rolling"),
    ("[motion_phi, accelerations, F]", "motion_s"),
)
SWINGS = """\
title: A pendulum
solve: system
method: energy
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
statement: A bob.
parts:
  - ask: Find the motion.
    answer: motion_theta
"""
BULLET = """\
title: A bullet
solve: system
method: angular_momentum
symbols: {m: mass, M: mass, l: length, b: length, v: speed}
given:
  coordinates: {x: length, theta: angle}
  places: {bullet: [x, -b], hole: [b*sin(theta), -b*cos(theta)]}
  particles: {bullet: {mass: m, at: bullet}}
  bodies: {rod: {shape: rod, length: l, mass: M, held: end, on: [0, 0], turned: theta + pi}}
  impact: {at: {x: 0, theta: 0}, before: {x_dot: v}, collisions: {from: bullet, to: hole}}
statement: A bullet.
parts:
  - ask: Find the angular velocity.
    answer: [theta_dot_after, K_x]
"""
CUE = """\
title: A ball
solve: system
method: angular_momentum
symbols: {M: mass, R: length, h: positive length, J: positive momentum}
given:
  coordinates: {x: length, phi: angle}
  bodies: {ball: {shape: ball, radius: R, mass: M, centre: [x, R], turned: -phi}}
  impact:
    impulses: {components: [J, 0], at: [x + (h - R)*sin(phi), R + (h - R)*cos(phi)]}
    at: {phi: 0}
statement: A ball.
parts:
  - ask: Find the rates.
    answer: rates_after
"""


def residual(step: Quantity) -> Any:
    return explicit(step.value).residual


def test_each_mass_of_an_atwood_machine_has_its_own_law(tmp_path: Path) -> None:
    """Taylor, example 7.3 and section 7.10: m_1 x_ddot = m_1 g - S."""
    steps, S = solved(tmp_path, ATWOOD), scalar("S")
    assert equal(residual(steps["motion_x"]), m_1 * scalar("x_ddot") - m_1 * g + S)
    assert equal(residual(steps["motion_y"]), m_2 * scalar("y_ddot") - m_2 * g + S)
    assert dict(steps["motion_x"].step.words) == {"way": "downwards"}
    assert equal(explicit(steps["acceleration_x"].value), (m_1 - m_2) * g / (m_1 + m_2))


def test_a_block_has_components_along_the_slope_and_perpendicular_to_it(tmp_path: Path) -> None:
    """Taylor, example 1.1."""
    steps = solved(tmp_path, ON_INCLINE)
    alpha, mu, N = next(iter(residual(steps["motion_n"]).atoms(cos))).args[0], Symbol("mu", positive=True), scalar("N")
    assert equal(residual(steps["motion_s"]), m * scalar("s_ddot") - m * g * sin(alpha) + mu * N)
    assert equal(residual(steps["motion_n"]), m * scalar("n_ddot") + m * g * cos(alpha) - N)
    assert dict(steps["motion_s"].step.words) == {"way": "down_the_slope"}
    assert dict(steps["motion_n"].step.words) == {"way": "away_from_the_slope"}


def test_the_tension_is_in_the_radial_component(tmp_path: Path) -> None:
    """m (r_ddot - r theta_dot^2) = m g cos(theta) - T, and the tangential component has no T."""
    steps = solved(tmp_path, POLAR)
    r, theta = Symbol("r", positive=True), scalar("theta")
    radial = m * (rate(r, 2) - r * rate(theta) ** 2) - m * g * cos(theta) + scalar("T")
    assert equal(residual(steps["motion_r"]), radial)
    assert not residual(steps["motion_theta"]).has(scalar("T"))
    ways = [dict(steps[f"motion_{q}"].step.words)["way"] for q in ("r", "theta")]
    assert ways == ["outwards", "along_the_tangent"]


def test_a_particle_in_space_has_three_components(tmp_path: Path) -> None:
    """The conical pendulum: m (rho_ddot - rho phi_dot^2) = -T rho/l where the string has the length l."""
    text = edited(
        POLAR,
        ("{r: positive length, theta: angle}", "{rho: positive length, phi: angle, z: positive length}"),
        ("[r*sin(theta), -r*cos(theta)]", "[rho*cos(phi), rho*sin(phi), -z]"),
        ("from: [0, 0]", "from: [0, 0, 0]"),
    )
    steps = solved(tmp_path, text)
    rho, z, T = Symbol("rho", positive=True), Symbol("z", positive=True), scalar("T")
    phi, whole = scalar("phi"), sqrt(rho**2 + z**2)
    assert equal(residual(steps["motion_rho"]), m * (rate(rho, 2) - rho * rate(phi) ** 2) + T * rho / whole)
    assert equal(residual(steps["motion_z"]), m * rate(z, 2) - m * g + T * z / whole)
    assert dict(steps["motion_z"].step.words) == {"way": "downwards"}


def test_at_rest_the_torques_are_taken_about_the_foot_of_the_ladder(tmp_path: Path) -> None:
    """Morin, section 2.2: about the foot, neither N nor F has a torque."""
    steps = solved(tmp_path, LADDER)
    theta = next(iter(residual(steps["balance_theta"]).atoms(cos))).args[0]
    assert equal(explicit(steps["rest_K"].value), M * g * cos(theta) / (2 * sin(theta)))
    assert not residual(steps["balance_theta"]).has(scalar("N"), scalar("F"))
    told = [value.name for role, value in steps["balance_theta"].step.roles if role.startswith("acting")]
    assert told == ["N", "F"]


def test_friction_has_no_torque_about_the_point_of_contact(tmp_path: Path) -> None:
    """Kleppner and Kolenkow, section 7.7: (3/2) M R^2 phi_ddot = M g R sin(alpha)."""
    steps = solved(tmp_path, ROLLS)
    assert not residual(steps["motion_phi"]).has(scalar("F"))
    alpha = next(iter(residual(steps["motion_phi"]).atoms(sin))).args[0]
    assert equal(explicit(steps["acceleration_s"].value), 2 * g * sin(alpha) / 3)
    assert equal(explicit(steps["F"].value), M * g * sin(alpha) / 3)
    alone = residual(solved(tmp_path, WITHOUT_LETTER)["motion_s"])
    assert equal(alone, Integer(3) / 2 * M * R * scalar("s_ddot") - M * g * R * sin(alpha))


def test_the_derivative_of_the_energy_is_the_equation_of_motion(tmp_path: Path) -> None:
    steps, theta = solved(tmp_path, SWINGS), scalar("theta")
    assert equal(residual(steps["motion_theta"]), m * l**2 * rate(theta, 2) + m * g * l * sin(theta))
    assert steps["energy_function"].step.outcome == "free"


def test_the_angular_momentum_about_the_pivot_gives_the_rate_after_a_bullet_hits(tmp_path: Path) -> None:
    """Kleppner and Kolenkow, section 6.8: theta_dot = m v b/(M l^2/3 + m b^2)."""
    steps = solved(tmp_path, BULLET)
    b, v = Symbol("b", positive=True), Symbol("v", positive=True)
    turned = m * v * b / (M * l**2 / 3 + m * b**2)
    assert equal(explicit(steps["theta_dot_after"].value), turned)
    assert not residual(steps["jump_theta"]).has(scalar("K_x"))
    assert equal(explicit(steps["K_x"].value), m * (v - b * turned))
    assert steps["jump_theta"].step.outcome == "kept"


def test_a_cue_gives_momentum_and_angular_momentum_about_the_centre(tmp_path: Path) -> None:
    """(2/5) M R^2 phi_dot = J (h - R)."""
    steps = solved(tmp_path, CUE)
    h, J = Symbol("h", positive=True), Symbol("J", positive=True)
    assert equal(residual(steps["jump_x"]), M * scalar("x_dot") - J)
    assert equal(residual(steps["jump_phi"]), 2 * M * R**2 * scalar("phi_dot") / 5 - J * (h - R))
    assert steps["jump_phi"].step.outcome == "about_centre"


@pytest.mark.parametrize("text", [ATWOOD, ON_INCLINE, POLAR], ids=["atwood", "incline", "polar"])
def test_both_methods_are_shown_to_agree(text: str, tmp_path: Path) -> None:
    steps = solved(tmp_path, edited(text, ("method: newton", "method: both")))
    agreements = [step for step in steps.values() if step.step.rule == "newton.agreement_of_laws"]
    assert len(agreements) == 2
    assert all(
        step.step.rule == "lagrange.forced_equation" for key, step in steps.items() if key.startswith("lagrange_")
    )


BLOCK = """\
title: A block on an incline
solve: system
method: both
symbols: {m: mass, g: acceleration, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {s: length}
  particles: {block: {mass: m, at: [s*cos(alpha), -s*sin(alpha)]}}
  gravity: g
statement: A block of mass <<m>> slides down an incline at the angle <<alpha>>. It has moved through <<s>>.
parts:
  - ask: Find the equation of motion.
    answer: equations_of_motion
"""


def test_laws_that_differ_by_a_constant_factor_agree(tmp_path: Path) -> None:
    """m s_ddot = m g sin(alpha) by Newton's law, and s_ddot - g sin(alpha) = 0 by Lagrange's equation."""
    assert solved(tmp_path, BLOCK)["agreement_s"].step.outcome == "again"


# --- wrong laws are refused ------------------------------------------------------------------------------------------


def refused(folder: Path, text: str) -> str:
    with pytest.raises(DeriveError) as error:
        solved(folder, text)
    return str(error.value)


def with_forces(monkeypatch: pytest.MonkeyPatch, changed: Any) -> None:
    right = Alone.forces.func  # type: ignore[attr-defined]
    monkeypatch.setattr(Alone, "forces", property(lambda body: changed(right(body))))


CASES = {"atwood": ATWOOD, "incline": ON_INCLINE, "polar": POLAR, "ladder": LADDER, "rolls": ROLLS}


@pytest.mark.parametrize("name", CASES)
def test_a_law_without_the_weight_is_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with_forces(monkeypatch, lambda forces: tuple(each for each in forces if each.letter is not None))
    assert "`lagrange` disagrees" in refused(tmp_path, CASES[name])


@pytest.mark.parametrize("name", ["atwood", "incline", "polar", "ladder"])
def test_a_law_without_a_constraint_force_is_refused(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_forces(monkeypatch, lambda forces: tuple(each for each in forces if each.letter is None))
    assert "`lagrange` disagrees" in refused(tmp_path, CASES[name])


@pytest.mark.parametrize("name", ["atwood", "incline", "polar", "ladder"])
def test_a_law_with_the_opposite_force_is_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def opposite(each: Force) -> Force:
        return each if each.letter is None else replace(each, components=tuple(-c for c in each.components))

    with_forces(monkeypatch, lambda forces: tuple(map(opposite, forces)))
    assert "`lagrange` disagrees" in refused(tmp_path, CASES[name])


@pytest.mark.parametrize("name", ["ladder", "rolls"])
def test_a_torque_with_the_wrong_sign_is_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Force.torque
    monkeypatch.setattr(
        Force, "torque", lambda force, about: -right(force, about) if force.letter is None else right(force, about)
    )
    assert "`lagrange` disagrees" in refused(tmp_path, CASES[name])


def test_a_moment_of_inertia_about_another_point_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torque_law, "_moment_of_the_centre", lambda body, point: Integer(0))
    assert "`lagrange` disagrees" in refused(tmp_path, ROLLS)


def test_an_acceleration_without_its_centripetal_term_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        Alone, "acceleration", lambda body, way: diff(single_bodies.dot(body.centre, way), body.moving[0])
    )
    assert "disagrees" in refused(tmp_path, POLAR)


@pytest.mark.parametrize("word", ["upwards", "to_the_right", "outwards", "down_the_slope", "away_from_the_slope"])
def test_a_wrong_word_for_the_direction_is_refused(word: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    centre = (Integer(0), Integer(0))
    monkeypatch.setattr(second_law, "direction_of", lambda body, way: Direction(word, centre))
    assert "could not be confirmed" in refused(tmp_path, ATWOOD)


def test_the_wrong_mass_in_a_sentence_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = second_law.data_of
    monkeypatch.setattr(second_law, "data_of", lambda body: {**right(body), "weight": right(body)["masses"][-1]})
    assert "unverified" in refused(tmp_path, ATWOOD)


def test_a_sentence_about_the_wrong_point_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = torque_law._point
    monkeypatch.setattr(torque_law, "_point", lambda *given: replace(right(*given), word="centre_of_mass"))
    assert "could not be confirmed" in refused(tmp_path, ROLLS)


def test_an_energy_with_a_wrong_potential_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(by_energy, "Terms", lambda t, u: t - u)
    assert "disagrees" in refused(tmp_path, SWINGS)


def test_an_angular_momentum_without_the_bullet_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = momentum_laws._angular_momentum
    monkeypatch.setattr(
        momentum_laws, "_angular_momentum", lambda body, about, sense: right(body, about, sense) if body.is_body else []
    )
    assert "disagrees" in refused(tmp_path, BULLET)


def test_an_impulse_with_the_opposite_torque_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Force.torque
    monkeypatch.setattr(Force, "torque", lambda force, about: -right(force, about))
    assert "disagrees" in refused(tmp_path, CUE)


def test_an_agreement_with_another_law_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.mechanics.newton import agreement_of_laws

    monkeypatch.setattr(agreement_of_laws, "Relation", lambda left, mark, right: Relation(left + m, mark, right))
    assert "disagrees" in refused(tmp_path, edited(ATWOOD, ("method: newton", "method: both")))


@pytest.mark.parametrize("wrong", [3 * g, g * scalar("x"), g + scalar("x_dot")])
def test_another_equation_is_not_the_law(tmp_path: Path, wrong: Any) -> None:
    agreement = solved(tmp_path, BLOCK)["agreement_s"]
    quantities = {q.key: q for q in agreement.parents}
    law = next(q for q in quantities.values() if q.step.rule == "newton.second_law")
    other = Relation(agreement.value.left.xreplace({g: wrong}), "=", agreement.value.right)
    assert same_equation(Judged(agreement.value, {}, {"newton": law}))
    assert not same_equation(Judged(other, {}, {"newton": law}))


# --- wrong questions -------------------------------------------------------------------------------------------------

DOUBLE = """\
title: A double pendulum
solve: system
method: newton
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {alpha: angle, beta: angle}
  places: {A: [l*sin(alpha), -l*cos(alpha)]}
  particles:
    upper: {mass: m, at: A}
    lower: {mass: m, at: {from: A, by: [l*sin(beta), -l*cos(beta)]}}
  gravity: g
statement: Two bobs.
parts:
  - ask: Find the motion.
    answer: equations_of_motion
"""
WRONG = {
    "a rod without a letter for its force": (DOUBLE, "do not let one body move with alpha while all others"),
    "energy with two coordinates": (
        edited(DOUBLE, ("method: newton", "method: energy")),
        "conservation of energy is one equation",
    ),
    "rolling without a letter": (
        edited(WITHOUT_LETTER, ("method: angular_momentum", "method: newton")),
        "a force without a symbol has a torque",
    ),
    "a Lagrangian by Newton": (
        edited(POLAR, ("answer: equations_of_motion", "answer: lagrangian")),
        "which `method: newton` does not use",
    ),
    "no equation of motion": (
        edited(POLAR, ("answer: equations_of_motion", "answer: kinetic_energy")),
        "so it has no effect",
    ),
    "both methods for accelerations": (
        edited(POLAR, ("method: newton", "method: both"), ("answer: equations_of_motion", "answer: accelerations")),
        "shows Lagrange's equations only among the `equations_of_motion`",
    ),
    "a method that does not exist": (edited(POLAR, ("method: newton", "method: hamilton")), "`method` must be"),
    "energy that friction takes": (
        edited(
            ON_INCLINE, ("method: newton", "method: energy"), ("answer: equations_of_motion", "answer: energy_function")
        ),
        "the energy is not conserved",
    ),
    "two methods for one equation": (
        edited(
            POLAR,
            (
                "answer: equations_of_motion\n",
                "answer: motion_r\n  - ask: Find T.\n    answer: T\n    method: lagrange\n",
            ),
        ),
        "by different methods",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_method_that_does_not_lead_to_the_answer_is_refused(name: str, tmp_path: Path) -> None:
    text, message = WRONG[name]
    assert message in " ".join(messages(tmp_path, text))


def test_a_part_may_have_its_own_method(tmp_path: Path) -> None:
    text = edited(
        POLAR,
        ("method: newton\n", ""),
        ("answer: equations_of_motion\n", "answer: equations_of_motion\n    method: newton\n"),
    )
    assert solved(tmp_path, text)["motion_r"].step.rule == "newton.second_law"


def test_the_force_of_a_moving_constraint_may_do_work() -> None:
    """x = v t has the condition x_dot - v on the velocities, which does not contain the time."""
    x_dot, v = symbols("x_dot v", real=True)
    inputs = {"letters": ("N",), "rates": (x_dot,)}
    fixed, moving = (Judged(x_dot, {**inputs, "velocities": (each,)}, {}) for each in (2 * x_dot, x_dot - v))
    assert constraint_forces_do_no_work(fixed)
    assert not constraint_forces_do_no_work(moving)
