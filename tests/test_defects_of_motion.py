"""Problems whose pages were once wrong or refused: each now has its right value, or a helpful error."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from unicodedata import normalize

import pytest
from sympy import Symbol, cos, diff, sqrt
from sympy import sympify as sympy_reads  # for the values by hand below; the engine itself never calls it

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from derive.course.problem import load_problem
from derive.steps.step import Quantity
from tests.courses import ROOT
from tests.stock.described import complaints, course_with, edited, solved

FOLDER = ROOT / "tests" / "defects" / "turn3"
MARKS = (" = ", " < ", " > ")
FALLING = "m*(g*y - x_dot**2 - y_dot**2)"
SPINNING = "(p_phi - p_psi*cos(theta))"

# problem -> its answers, by hand
VALUES: dict[str, dict[str, str]] = {
    "acc_where": {
        "acceleration_q": "(F + m*R*sin(q)*q_dot**2)/(m*R*cos(q))",
        "hamiltonian": "p_q**2/(2*m*R**2*cos(q)**2)",
    },
    "beats4": {
        "frequency_1": "sqrt(k/m)",
        "frequency_2": "sqrt((k + 2*k_12)/m)",
        "beat": "sqrt((k + 2*k_12)/m) - sqrt(k/m)",
        "weak": "k_12/sqrt(k*m)",
    },
    "con_scaled": {"acceleration_x": "-3*g/10", "acceleration_y": "-g/10", "N": "3*m*g/10"},
    "con_stab": {"stability": "k"},
    "f04_turntable_ground": {"acceleration_x": "-2*Omega*y_dot/7", "acceleration_y": "2*Omega*x_dot/7"},
    "f05_impulse_scaled_by_normal": {"x_dot_after": "24*v/25", "y_dot_after": "7*v/25", "K": "8*m*v/5"},
    "f07_multiplier_called_force": {
        "Lambda": f"{FALLING}/(2*(x**2 + y**2))",
        "acceleration_x": f"x*{FALLING}/(m*(x**2 + y**2))",
        "acceleration_y": f"y*{FALLING}/(m*(x**2 + y**2)) - g",
    },
    "f08_friction_and_constraint_refused": {
        "acceleration_x": "-g*(1 + mu)/2",
        "acceleration_y": "-g*(1 + mu)/2",
    },
    "f09_root_rate_refused": {
        "motion_x": "m*(x_ddot - 2*sqrt(k/M)*y_dot - k/M*x) = 0",
        "motion_y": "m*(y_ddot + 2*sqrt(k/M)*x_dot - k/M*y) = 0",
    },
    "f10_minimum_refused": {
        "effective_potential": "l**2/(2*m*r**2) + k*r**2/2",
        "least_r": "(l**2/(m*k))**(1/4)",
        "least": "l*sqrt(k/m)",
    },
    "f11_put_in_speed_refused": {"run": "-A*cos(sqrt(k/m)*t)", "top": "A*sqrt(k/m)", "period": "2*pi*sqrt(m/k)"},
    "f12_cone_geodesic_refused": {
        "motion_r": "r*sin(alpha)*phi_dot*(r*phi_dot*r_ddot - r*r_dot*phi_ddot - 2*r_dot**2*phi_dot"
        " - r**2*sin(alpha)**2*phi_dot**3)/(r_dot**2 + r**2*sin(alpha)**2*phi_dot**2)**(3/2) = 0",
        "conserved_phi": "r**2*sin(alpha)*phi_dot/sqrt(r_dot**2 + r**2*sin(alpha)**2*phi_dot**2)",
    },
    "f13_best_angle_refused": {
        "landing_2": "2*v_0*sin(alpha)/(g*cos(beta))",
        "best_alpha": "pi/4 - beta/2",
        "best": "v_0**2/(g*(1 + sin(beta)))",
    },
    "f14_landing_time_refused": {
        "landing_2": "2*v_0*sin(alpha)/g",
        "range": "v_0**2*sin(2*alpha)/g",
        "best_alpha": "pi/4",
        "best": "v_0**2/g",
    },
    "f17_rod_points_up": {
        "acceleration_q": "-g*sin(alpha)",
        "Gamma": "m*g*l*(cos(beta) - sin(alpha)*sin(alpha - beta))/2",  # for a rod at the angle theta to the horizontal
    },
    "f18_zero_mode_no_restoring_force": {"frequency_1": "0", "frequency_2": "sqrt(2*k/m)"},
    "half_cylinder_drawn_whole": {
        "moment_of_inertia": "M*R**2*(1/2 - 16/(9*pi**2))",
        "frequency": "sqrt(8*g/((9*pi - 16)*R))",
    },
    "internal-error-big-numbers": {"wobble_period_z": "T_0*I_1/Abs(I_3 - I_1)"},
    "kept_value": {
        "constant_psi": "phi_dot*cos(theta) + psi_dot = s",
        "put": "A*theta_ddot - A*phi_dot**2*sin(theta)*cos(theta) + C*s*phi_dot*sin(theta) - M*g*l*sin(theta) = 0",
    },
    "kin": {
        "kinetic_energy": "m*b**2*(alpha_dot**2*sin(alpha)**2 + gamma_dot**2)/2"
        " + M*((a*gamma_dot)**2 + (a*cos(gamma)*gamma_dot + b*alpha_dot)**2)/2"
    },
    "letter-clash-parallel": {
        "inertia_tensor_xx": "M*(R**2/4 + h**2/2)",
        "central_tensor_xx": "M*(R**2/4 + h**2/18)",
        "inertia_tensor_zz": "M*R**2/2",
    },
    "letter_omega_damped_refused": {
        "energy_function": "m*R**2*(theta_dot**2 - omega**2*sin(theta)**2)/2 - m*g*R*cos(theta)",
        "decay": "c/(2*m)",
        "frequency": "sqrt(g/R - omega**2 - c**2/(4*m**2))",
    },
    "line-does-not-follow": {
        "kinetic_energy": "m*l**2*theta_dot**2/2 + m*l**2*(cos(phi)*phi_dot)**2/2"
        " + m*l**2*(sin(phi)*sin(theta)**7*phi_dot - 7*cos(phi)*sin(theta)**6*cos(theta)*theta_dot)**2/2"
    },
    "m_neg": {"frequency": "sqrt(k/(m - M))", "period": "2*pi*sqrt((m - M)/k)"},
    "max_letters": {"m1_n": "a/(2*b)", "m1": "a**2/(4*b)"},
    "name_depends_on_part_order": {
        "rest": "(p_phi**2/(m_1*m_2*g))**(1/3)",
        "radial_acceleration": "(p_phi**2/(m_1*r**3) - m_2*g)/(m_1 + m_2)",
        "radial_squared": "3*m_2*g/((m_1 + m_2)*r_0)",
    },
    "pend_tension": {"force": "m*v_0**2/l - 2*m*g + 3*m*g*cos(theta)", "lost": "cos(theta) = 2/3 - v_0**2/(3*g*l)"},
    "resonance-none": {
        "resonance_omega": "sqrt(k/m - b**2/(2*m**2))",
        "resonance": "F/(b*sqrt(k/m - b**2/(4*m**2)))",
    },
    "ring": {
        "lagrangian": "m*R**2*theta_dot**2/2 + m*g*R*cos(theta) - k*R**2*(sqrt(2 + 2*cos(theta)) - 1)**2/2",
        "curvature": "m*g*R - k*R**2/2",
        "soft_spring": "k < 2*m*g/R",
    },
    "roots_internal_error_conical_0_pi": {
        "Omega": "sqrt(g/(l*cos(theta_0)))",
        "nutation": "sqrt(g*(1 + 3*cos(theta_0)**2)/(l*cos(theta_0)))",
    },
    "routhian-magnetic": {"routhian": "m*r_dot**2/2 - (p_phi - q*B*r**2/2)**2/(2*m*r**2)"},
    "solve_after_put_in_internal_error": {
        "rate_phi_by_p_phi_p_psi": f"{SPINNING}/(I_1*sin(theta)**2)",
        "tiltdd": f"(M*g*l*sin(theta) - {SPINNING}*(p_psi - p_phi*cos(theta))/(I_1*sin(theta)**3))/I_1",
    },
    "spr_wall": {"potential_energy": "k*(Abs(x - d) - l)**2/2", "rest_1": "d - l", "rest_2": "d + l"},
    "spring-sign": {"motion_x": "m*x_ddot + k*(Abs(x - A + d) - d)*(x - A + d)/Abs(x - A + d) = 0"},
    "spring_unverified_min": {
        "motion_y": "M*y_ddot + k*(y + l*sin(theta)/2) - M*g = 0",
        "motion_theta": "M*l**2*theta_ddot/12 + k*(l**2*sin(theta)/4 + l*y*cos(theta)/2) = 0",
    },
    "values-earth": {"body_cone_rate": "(C - A)*omega_z/A", "wobble_period_z": "2*pi*A/(omega*Abs(C - A))"},
    "values-power_law": {
        "Omega": "sqrt(K/m)*r_0**(n/2 - 1)/a**(n/2)",
        "stable": "n > -2",
        "apsidal": "pi/sqrt(n + 2)",
    },
    "values-steady_precession": {
        "steady": "S*phi_dot - A*phi_dot**2*cos(alpha) - M*g*l = 0",
        "no_phi_dot": "S**2 - 4*A*M*g*l*cos(alpha) < 0",
    },
}

# problem -> the texts that its page contains, and the texts that it does not contain
SAID: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "acc_where": (("provided that cos q ≠ 0",), ()),
    "beats4": (("x_1 = A, x_2 = B, ẋ_1 = v, ẋ_2 = u at t = 0",), ("all else zero",)),
    "break_no_gravity": (("Terms of higher order, if there are any, decide",), ("that were neglected",)),
    "con_scaled": (("multiplier times the gradient", "the magnitude of this gradient is √10"), ("give the force of",)),
    "con_stab": (("U has a minimum on the constraints and the equilibrium is stable",), ("unstable",)),
    "f01_leaves_not_reached": (
        ("(θ̇)² = -g/(3L), which is negative: the motion turns back before",),
        ("until", "contact"),
    ),
    "f07_multiplier_called_force": (
        ("the magnitude of this gradient is 2l", "give the multiplier"),
        ("give the force of",),
    ),
    "f16_nutation_timeout": (("The momentum p_ψ keeps its initial value C w",), ()),
    "f17_rod_points_up": (
        ("No force outside L acts along q",),
        ("No such force",),
    ),
    "f18_zero_mode_no_restoring_force": (
        ("no restoring force of first order, and terms of higher order determine the motion",),
        (),
    ),
    "glMixed": (("some displacements grow exponentially and the equilibrium",), ("minimum", "is stable")),
    "internal-error-big-numbers": (("≈ 2.642×10⁷ s",), ()),
    "loop_turn": (("(θ̇)² = -g/(3R), which is negative: the motion turns back before",), ("until", "contact")),
    "lvl_4": (
        ("in the ratio (0, 1, 1, 1)", "is -3/5 k, which is always negative: U decreases", "unstable"),
        ("in no direction",),
    ),
    "m_neg": (("Assume that m > M.", "If m > M, the angular frequency"), ()),
    "max_letters": (("It lies in the interval if 2b > a",), ()),
    "origin-on-told-body": (("∫(0..L) x dx) = 2M x/L²", "2/L² ∫(0..L) x² dx", "2/3 L (1, 0, 0)"), ()),
    "pend_tension": (("a string only pulls", "This happens if v_0² > 2g l and v_0² < 5g l"), ("contact",)),
    "resonance-none": (("exists if b² < 2k m", "≈ 1000 s^-1", "≈ 1.000 m"), ()),
    "rootcos2": (("U vanishes when * cos θ = 0", "if E_1 ≥ E_2, * cos θ = E_2/E_1"), ("θ = 0,", "vanishes at")),
    "roots_internal_error_conical_0_pi": (("provided that cos θ_0 > 0",), ()),
    "spr_wall": (("The equilibria are",), ("The only equilibrium",)),
    "thetabig": (("≈ 2.3228 s",), ("2.2820", "2.282")),
    "values-power_law": (("≈ 0.4639 rad/s", "≈ 0.8678 rad/s", "≈ 1.679"), ()),
    "values-steady_precession": (("has no real root φ̇",), ()),
}

# problem -> the code of each error, its line, and a piece of its message
REFUSED: dict[str, list[tuple[str, int, str]]] = {
    "approx_becomes_exact_numbers": [("name-clash", 14, "`period` is already the name of an answer")],
    "con_put_dot": [("letter-clash", 11, "`m` is already a symbol of this problem")],
    "doubleCover": [("folded", 5, "covers places twice")],
    "f02_friction_reaction_missing": [("which-body", 11, "the body that exerts it is not stated")],
    "f03_friction_no_torque": [("which-body", 9, "the force at (x, 0) acts on no particle")],
    "f06_hole_outside": [("no-such-body", 6, "is not inside the rest of the body")],
    "fr_rest": [("friction-at-rest", 14, "sliding friction does not act at rest")],
    "gravity-changes": [("changes", 8, "`g*x/a` depends on the coordinate x")],
    "hit_geom": [("which-body", 11, "an impulse at (x, l/2 + y) acts on no particle")],
    "keys_ignored_by_roots": [
        ("unused-key", 10, "`within` has no effect on `roots`"),
        ("unused-key", 10, "`order` has no effect on `roots`"),
        ("unused-key", 10, "`bound` has no effect on `roots`"),
    ],
    "nan-put-in": [("no-value", 11, "for alpha = pi/2, tan(alpha) in `motion_r` is infinite")],
    "proj_fake2": [("contradicts-motion", 11, "the described motion from this start has a different speed")],
    "res_put": [("no-value", 11, "for Omega = sqrt(k)/sqrt(m), the denominator Omega**2*m - k of `s` vanishes")],
    "roll_wrong_contact": [("no-contact", 8, "always away from the surface, since its distance from the surface is R")],
    "satellite_stability_unverified": [("unverified", 32, "it is not known whether l < r_0")],
    "shadow": [("letter-clash", 9, "`p_x` is already a symbol of this problem")],
    "singular_q": [("singular-coordinates", 11, "the mass matrix has no inverse there")],
    "sph_lin": [("singular-coordinates", 12, "the mass matrix has no inverse there")],
    "sq_constraint": [("constrained", 8, "so no force can enforce it")],
}

# problem -> the edits by which its author fixes the error, and the answers then, by hand
CORRECTED: dict[str, tuple[list[tuple[str, str]], dict[str, str]]] = {
    "approx_becomes_exact_numbers": (
        [("    period: {value", "    swing: {value"), ("[heavy, period]", "[heavy, swing]")],
        {"frequency_2": "sqrt((M + m)*g/(M*l))", "heavy": "sqrt(g/l)", "swing": "2*pi*sqrt(l/g)"},
    ),
    "break_no_gravity": (
        [("\nstatement: >", "  gravity: g\n\nstatement: >")],
        {"motion_theta": "l*theta_ddot + g*sin(theta) = 0", "frequency": "sqrt(g/l)"},
    ),
    "f02_friction_reaction_missing": (
        [("components: [-mu*N, 0],", "components: [-mu*N, 0], by: plank,")],
        {"acceleration_x": "-mu*g", "acceleration_X": "mu*m*g/M"},
    ),
    "f03_friction_no_torque": (
        [("components: [-mu*N, 0],", "components: [-mu*N, 0], of: ball,")],
        {"acceleration_x": "-mu*g", "acceleration_phi": "5*mu*g/(2*a)"},
    ),
    "f17_rod_points_up": (
        [("turned: theta - pi/2", "turned: theta + pi")],
        {"acceleration_q": "-g*sin(alpha)", "Gamma": "m*g*l*cos(alpha)*sin(beta - alpha)/2"},
    ),
    "hit_geom": (
        [("restitution: 1,", "restitution: 1, of: [p, rod],")],
        {
            "x_dot_after": "2*m*v/(M + 4*m)",
            "y_dot_after": "0",
            "phi_dot_after": "-12*m*v/((M + 4*m)*l)",
            "u_dot_after": "(4*m - M)*v/(M + 4*m)",
        },
    ),
    "satellite_stability_unverified": (
        [("  at: {theta: 0}", "  assume: l < r_0\n  at: {theta: 0}")],
        {
            "stability": "G*M*m*l*r_0*(1/(r_0 - l)**3 - 1/(r_0 + l)**3)",
            "frequency": "sqrt(G*M*r_0/(2*l)*(1/(r_0 - l)**3 - 1/(r_0 + l)**3))",
            "short": "sqrt(3*G*M/r_0**3)",
        },
    ),
    "shadow": ([("    p_x: {put", "    heavier: {put"), ("answer: p_x", "answer: heavier")], {"heavier": "2*M*x_dot"}),
    "sq_constraint": (
        [("(x - y)**2", "x - y")],
        {"acceleration_x": "-g/2", "acceleration_y": "-g/2", "Q": "-m*g/2"},
    ),
}


def text_of(name: str) -> str:
    return (FOLDER / f"{name}.yaml").read_text(encoding="utf-8")


def course_of(folder: Path, name: str, *edits: tuple[str, str]) -> Path:
    """Return a course with this problem alone, and with the scripts next to it."""
    root = course_with(folder, edited(text_of(name), *edits))
    for script in FOLDER.glob("*.py"):
        (root / "problems" / "trial" / script.name).write_text(script.read_text(encoding="utf-8"), encoding="utf-8")
    return root


def answers(folder: Path, name: str, *edits: tuple[str, str]) -> dict[str, Quantity]:
    return solved(course_of(folder, name), edited(text_of(name), *edits))


def page(folder: Path, name: str) -> str:
    text = rendered(course_of(folder, name), "trial/one", only={"text"}).texts["text"]
    return normalize("NFC", " ".join(text.split()))


def by_hand(text: str, letters: Mapping[str, Symbol]) -> Any:
    for mark in MARKS:
        if mark in text:
            left, right = text.split(mark)
            return Relation(sympy_reads(left, dict(letters)), mark.strip(), sympy_reads(right, dict(letters)))
    return sympy_reads(text, dict(letters))


def letters_in(found: Mapping[str, Quantity]) -> dict[str, Symbol]:
    values = [explicit(quantity.value) for quantity in found.values()]
    parts = [
        part for value in values for part in ((value.left, value.right) if isinstance(value, Relation) else (value,))
    ]
    return {letter.name: letter for part in parts for letter in part.free_symbols}


def agree(found: Mapping[str, Quantity], expected: Mapping[str, str]) -> dict[str, Any]:
    """Return the answers that differ from their values by hand."""
    letters = letters_in(found)
    return {
        key: found[key].value for key, value in expected.items() if not equal(found[key].value, by_hand(value, letters))
    }


@pytest.mark.parametrize("name", VALUES)
def test_a_problem_has_its_right_value(name: str, tmp_path: Path) -> None:
    assert agree(answers(tmp_path, name), VALUES[name]) == {}


@pytest.mark.parametrize("name", SAID)
def test_a_page_says_what_is_true_of_the_problem(name: str, tmp_path: Path) -> None:
    said, not_said = SAID[name]
    text = page(tmp_path, name)
    assert [phrase for phrase in said if normalize("NFC", phrase) not in text] == []
    assert [phrase for phrase in not_said if normalize("NFC", phrase) in text] == []


@pytest.mark.parametrize("name", REFUSED)
def test_a_problem_without_an_answer_gets_a_complaint_at_its_line(name: str, tmp_path: Path) -> None:
    found = complaints(course_of(tmp_path, name), text_of(name))
    assert [(c.code, c.place.line) for c in found] == [(code, line) for code, line, _ in REFUSED[name]]
    assert [c.message for c, (_, _, said) in zip(found, REFUSED[name], strict=True) if said not in c.message] == []


@pytest.mark.parametrize("name", CORRECTED)
def test_a_problem_whose_author_answers_the_complaint_has_its_right_value(name: str, tmp_path: Path) -> None:
    edits, expected = CORRECTED[name]
    assert agree(answers(tmp_path, name, *edits), expected) == {}


def test_a_length_that_the_constraint_changes_does_not_stay(tmp_path: Path) -> None:
    """r = l - v t, so r' = -v, and the problem must not substitute r' = 0."""
    text = edited(
        text_of("con_put_dot"), ("    m: {put_in", "    motion: {put_in"), ("results: m}", "results: motion}")
    )
    (found,) = complaints(tmp_path, text)
    assert (found.code, found.place.line) == ("contradicts-motion", 10)
    assert "the rates that are substituted contradict the constraints" in found.message


def test_a_letter_of_gravity_that_nothing_uses_is_warned_of(tmp_path: Path) -> None:
    problem = load_problem(course_of(tmp_path, "break_no_gravity"), "trial/one")
    (warning,) = problem.warnings
    assert warning.code == "unused-letter" and "`g` is declared" in warning.message
    assert warning.help is not None and "`gravity: g`" in warning.help


@pytest.mark.long
def test_a_disc_on_a_wavy_road_has_its_equations_and_rolls(tmp_path: Path) -> None:
    """For each unit of x, the centre moves along the road by W - R h''/W^2, and the disc rotates by this length over
    R."""
    found = answers(tmp_path, "f15_wavy_road_timeout")
    letters = letters_in(found)
    m, R, A, b, g, x = (letters[name] for name in ("m", "R", "A", "b", "g", "x"))
    x_dot, x_ddot, phi_ddot = (letters[name] for name in ("x_dot", "x_ddot", "phi_ddot"))
    height = A * cos(x / b)
    long = sqrt(1 + diff(height, x) ** 2)
    moves = long - R * diff(height, x, 2) / long**2
    inertia = m * moves**2
    left = inertia * x_ddot + diff(inertia, x) * x_dot**2 / 2 + m * g * diff(height + R / long, x)
    along, around = (explicit(found[key].value) for key in ("motion_x", "motion_phi"))
    assert equal(along.left, left)
    assert equal(around.left, m * R**2 * phi_ddot / 2)
    assert equal(along.right * R, around.right * moves)
    assert equal(around.right, R * letters["F"])


@pytest.mark.long
def test_the_friction_of_a_disc_in_a_bowl_is_that_on_a_slope(tmp_path: Path) -> None:
    """The friction is a third of the component of the weight along the road, and points up the road, as on any
    slope."""
    long = "sqrt(1 + x**2/b**2)"
    text = edited(
        text_of("f15_wavy_road_timeout"),
        ("A: length, b", "b"),
        (
            "[x + R*A/b*sin(x/b)/sqrt(1 + A**2/b**2*sin(x/b)**2), A*cos(x/b) + R/sqrt(1 + A**2/b**2*sin(x/b)**2)]",
            f"[x - R*x/(b*{long}), x**2/(2*b) + R/{long}]",
        ),
        ("y: A*cos(x/b)", "y: x**2/(2*b)"),
        ("height <<A>> cos(<<x>>/<<b>>)", "shape of a bowl"),
        ("answer: equations_of_motion", "answer: multipliers"),
    )
    assert agree(solved(tmp_path, text), {"F": "m*g*x/(3*sqrt(b**2 + x**2))"}) == {}


@pytest.mark.long
def test_the_friction_of_a_ball_on_a_slope_is_along_the_slope(tmp_path: Path) -> None:
    """m s'' = m g sin(beta) - R and 2/5 m a s'' = R a give s'' = 5/7 g sin(beta) and R = 2/7 m g sin(beta)."""
    text = edited(
        text_of("f04_turntable_ground"),
        ("Omega: angular speed", "g: acceleration, beta: 'angle in (0, pi/2)'"),
        ("    table: [{z: Omega*t}]\n", ""),
        ("{x: length", "{s: length"),
        ("[x, y, a]", "[s*cos(beta) + a*sin(beta), y, a*cos(beta) - s*sin(beta)]"),
        ("normal: [0, 0, 1], in: table", "normal: [sin(beta), 0, cos(beta)]"),
        ("\nstatement:", "\n  gravity: g\nstatement:"),
        (" table that turns at the rate <<Omega>>", " slope"),
        ("[acceleration_x, acceleration_y]", "[acceleration_s, multipliers]"),
    )
    expected = {"acceleration_s": "5*g*sin(beta)/7", "F_x": "-2*m*g*sin(beta)/7", "F_y": "0"}
    assert agree(solved(tmp_path, text), expected) == {}


@pytest.mark.long
def test_small_nutation_about_steady_precession_has_the_known_frequency(tmp_path: Path) -> None:
    """nu^2 = Omega^2 + (Mgl)^2/(A Omega)^2 - 2Mgl cos(alpha)/A with Mgl = (C w - A Omega cos(alpha)) Omega."""
    found = answers(tmp_path, "f16_nutation_timeout")
    letters = letters_in(found)
    A, C, w, Omega, alpha = (letters[name] for name in ("A", "C", "w", "Omega", "alpha"))
    torque = (C * w - A * Omega * cos(alpha)) * Omega
    squared = Omega**2 + torque**2 / (A * Omega) ** 2 - 2 * torque * cos(alpha) / A
    assert equal(found["nutation_squared"].value, squared)
    assert equal(found["nutation"].value, sqrt(squared))


def test_a_rod_points_upwards_where_it_is_not_turned_and_the_manual_says_so(tmp_path: Path) -> None:
    found = answers(tmp_path, "f17_rod_points_up", ("turned: theta - pi/2", "turned: theta"))
    assert agree(found, {"potential_energy": "m*g*(q*sin(alpha) + l/2*cos(theta))"}) == {}
    manual = " ".join((ROOT / "docs" / "yaml-alone.md").read_text(encoding="utf-8").split())
    assert "A `rod` therefore points upwards from its `end` if `turned` is zero" in manual


def test_every_problem_of_the_folder_is_tried() -> None:
    tried = {*VALUES, *SAID, *REFUSED, *CORRECTED, "f15_wavy_road_timeout", "f16_nutation_timeout"}
    assert {path.stem for path in FOLDER.glob("*.yaml")} == tried
