"""Errors that `results:` once made: approximations that became equalities, roots of a cosine, ranges, signs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from unicodedata import normalize

import pytest
from sympy import Integer, cos, pi, sin, sqrt, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import Relation
from derive.algebra.ranges import Range, within
from derive.errors import DeriveError, Rejected, Unverified
from derive.mechanics import beats, let, limiting_case, maximum, minimum, put_in, roots, solved_for, where
from derive.steps.establish import Scope, establish
from derive.steps.record import Run, recorded
from derive.steps.rule import RULES
from derive.steps.step import Quantity
from tests.courses import rendered_once
from tests.stock.described import complaints, course_with, edited, messages, solved

M, m, g, l, k, A, S = symbols("M m g l k A S", positive=True)

PENDULUM_ON_CART = """\
title: A pendulum on a heavy cart
solve: system
symbols: {M: mass, m: mass, l: length, g: acceleration}
given:
  coordinates: {x: length, theta: angle}
  places: {cart: [x, 0]}
  particles:
    cart: {mass: M, at: cart}
    bob: {mass: m, at: {from: cart, by: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
  at: {x: 0, theta: 0}
  results:
    heavy: {limit: frequency_2, for: M, to: infinity}
    swing: {value: 2*pi/heavy, symbol: tau}
statement: A cart of mass <<M>>, a pendulum with bob <<m>> on a rod <<l>>, and <<g>>.
parts:
  - ask: Find the frequencies.
    answer: normal_modes
  - ask: What is the frequency for a heavy cart, and the period?
    answer: [heavy, swing]
values: {M: 2 kg, m: 1 kg, l: 1 m, g: 9.81 m/s^2}
"""

SWING = """\
title: A pendulum
solve: system
symbols: {m: mass, g: acceleration, l: length, A: "angle in (0, pi/2)"}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
  results:
    v2: {speed: energy_function, for: theta, start: A}
    tau: {period: v2, order: 2}
    often: {value: 1/tau, symbol: nu}
statement: A bob on a rod <<l>>, <<g>>, starting at <<A>>.
parts:
  - ask: Find it.
    answer: tau
values: {A: 85 deg, l: 1 m, g: 9.81 m/s^2}
figures: 5
"""


def printed(folder: Path, text: str, form: str = "text") -> str:
    found = rendered_once(course_with(folder, text), "trial/one", only={form})
    return found.texts.get(form) or getattr(found, form)


def given(value: Any, key: str = "f", **more: Any) -> Quantity:
    return let(key, lambda: value, **more)


# --- an approximation never turns into an equality ---


def test_a_limit_has_a_letter_of_its_own_and_what_follows_is_approximate(tmp_path: Path) -> None:
    page = printed(tmp_path, PENDULUM_ON_CART)
    assert "ω_2 → ω_2,∞ = √(g/l)" in page
    assert "τ ≈ 2π/ω_2,∞ = 2π √(l/g)" in page
    assert "τ =" not in page
    numbers = [line.split() for line in page.splitlines() if "rad/s" in line]
    assert [line[1:5] for line in numbers] == [["ω_2", "≈", "3.836", "rad/s"], ["ω_2,∞", "≈", "3.132", "rad/s"]]


@pytest.mark.parametrize(
    ("form", "said"),
    [("latex", r"\row{\tau}{\approx\frac{2\pi}{\omega_{2,\infty}}=2\pi"), ("html", r"\omega_{2,\infty}")],
)
def test_every_format_prints_an_approximation_as_one(form: str, said: str, tmp_path: Path) -> None:
    assert said in printed(tmp_path, PENDULUM_ON_CART, form).replace(" ", "")


def test_the_json_says_what_is_approximate(tmp_path: Path) -> None:
    data = json.loads(printed(tmp_path, PENDULUM_ON_CART, "json"))
    steps = {step["key"]: step for step in data["steps"]}
    assert steps["heavy"]["approximates"] == r"\omega_{2}" and not steps["heavy"]["about"]
    assert steps["swing"]["about"] and "about" not in steps["frequency_2"]
    assert data["answers"]["swing"]["text"].startswith("τ ≈ ")


def test_everything_computed_from_an_approximation_is_approximate() -> None:
    with recorded(Run()):
        first = limiting_case(given(sqrt((M + m) * g / (m * l)), "w", symbol="w", kind="angular speed"), M, 0)
        other = given(sqrt(k / m), "v", symbol="v", kind="angular speed")
        made = [
            let("u", lambda w: 2 * pi / w, first),
            put_in(given(l * symbols("w", real=True), "n", symbol="n"), first),
            where(put_in(given(S**2 - symbols("w", real=True) ** 2, "d", symbol="d"), first), ">", 0, S),
            beats(first, other),
        ]
    assert [quantity.step.about for quantity in made] == [True] * 4
    assert {quantity.step.grade for quantity in made} == {Grade.APPROXIMATION}
    assert equal(made[1].value, l * sqrt(g / l))


def test_the_letter_that_the_author_gives_is_that_of_the_limit() -> None:
    with recorded(Run()):
        whole = given(sqrt((M + m) * g / (m * l)), "w", symbol="w")
        assert str(limiting_case(whole, M, symbol="w_0").symbol) == "w_0"
        with pytest.raises(Rejected, match="w is the letter of the result itself"):
            limiting_case(whole, M, symbol="w")


def test_a_letter_has_one_value_in_a_run() -> None:
    with recorded(Run()):
        whole = given(sqrt((M + m) * g / (m * l)), "w", symbol="w")
        given(g / l, "other", symbol="w_lim")
        limit = limiting_case(whole, M)
        assert str(limit.symbol) == "w_M_lim"
        with pytest.raises(Rejected, match="both called w_M_lim"):
            given(g, "third", symbol="w_M_lim")


def test_a_result_that_breaks_off_is_refused_under_the_letter_of_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("derive.mechanics.answers.limits.letter_of_limit", lambda whole, *_: whole)
    with pytest.raises(Unverified, match="an exact result with a letter other than"):
        limiting_case(given(sqrt((M + m) * g / (m * l)), "w", symbol="w"), M)


def test_a_restated_limit_says_the_same_of_its_letter() -> None:
    with recorded(Run()):
        limit = limiting_case(given(sqrt((M + m) * g / (m * l)), "w", symbol="w"), M)
        again = establish(
            RULES["answers.let"],
            limit.symbol,
            lambda w: w,
            {"w": limit},
            key="again",
            scope=Scope(case_of=limit),
        )
    assert again.step.approximates == limit.step.approximates and not again.step.about and not again.exact


def test_the_number_of_a_period_is_that_of_the_integral(tmp_path: Path) -> None:
    """4 sqrt(l/g) K(sin(85 deg/2)) = 2.32275 s by tables of the elliptic integral; the series would give 2.2820 s."""
    page = printed(tmp_path, SWING)
    assert "≈ 2.3228 s" in page and "2.2820" not in page
    assert "2π √(l/g) (1 + 1/16 A²)" in page


def test_what_is_derived_from_a_series_has_only_figures_for_which_it_is_good(tmp_path: Path) -> None:
    with pytest.raises(DeriveError, match="not accurate to 5 figures"):
        printed(tmp_path, edited(SWING, ("answer: tau", "answer: often")))
    small = printed(tmp_path, edited(SWING, ("answer: tau", "answer: often"), ("85 deg", "4 deg")))
    assert "ν ≈ 1/τ_lim" in small and "≈ 0.49834 s^-1" in small


def test_an_amplitude_at_which_nothing_swings_is_refused(tmp_path: Path) -> None:
    over = edited(SWING, ("A: 85 deg", "A: 200 deg"), ("angle in (0, pi/2)", "angle in (0, 2*pi)"))
    with pytest.raises(DeriveError, match="does not oscillate between"):
        printed(tmp_path, over)


# --- roots of an equation in cos(theta) are values of cos(theta) ---

TWO_COSINES = """\
title: Two roots for a cosine
solve: system
symbols: {m: mass, l: length, E_1: 'positive energy', E_2: 'positive energy'}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  potential: E_1*cos(theta)**2 - E_2*cos(theta)
  results:
    turn: {roots: potential_energy, for: cos(theta)}
    force: {put_in: potential_energy, results: turn_2}
statement: A bob on a rod.
parts:
  - ask: Where does the potential energy vanish?
    answer: turn
"""


def test_the_roots_of_an_equation_in_a_cosine_are_cosines(tmp_path: Path) -> None:
    page = printed(tmp_path, TWO_COSINES)
    assert "cos θ = 0" in page and "cos θ = E_2/E_1" in page
    assert "and, if E_1 ≥ E_2," in page
    assert "θ_1" not in page and "θ_2" not in page


def test_the_value_of_a_cosine_is_put_in_for_the_cosine(tmp_path: Path) -> None:
    found = solved(tmp_path, edited(TWO_COSINES, ("answer: turn\n", "answer: [turn, force]\n")))["force"]
    assert found.value == 0


def test_the_letter_of_a_root_of_a_cosine_is_that_of_the_angle() -> None:
    q, a = symbols("theta a", real=True)
    found = roots(given(cos(q) ** 2 - a * cos(q)), cos(q), symbols=["alpha", "beta"])
    assert [str(quantity.symbol) for quantity in found] == ["cos(alpha)", "cos(beta)"]


def test_a_factor_that_was_divided_away_from_an_equation_is_a_further_solution() -> None:
    q = symbols("theta", real=True)
    (found,) = roots(given(Relation(sin(q) * (3 * cos(q) - 2), "=", Integer(0))), cos(q))
    assert dict(found.step.roles)["elsewhere"] == Relation(sin(q), "=", 0)


def test_the_square_of_a_root_is_not_called_the_root() -> None:
    w = symbols("w", real=True)
    found = roots(given((w**2 - k) * (w**2 - m)), w**2)
    assert {quantity.symbol for quantity in found} == {w**2}


def test_a_root_without_linear_term_has_its_sign_where_it_is_real() -> None:
    """g = l w^2 cos(theta_0): for w > 0 there is one root, where cos(theta_0) > 0, although theta_0 may exceed pi/2."""
    w, angle = symbols("w", positive=True), symbols("theta_0", real=True)
    with within({angle: Range(Integer(0), pi)}):
        (found,) = roots(given(l * w**2 * cos(angle) - g), w)
    assert found.step.outcome == "only" and equal(found.value, sqrt(g / (l * cos(angle))))
    assert dict(found.step.roles)["condition"] == Relation(cos(angle), ">", 0)
    assert "excluded" not in dict(found.step.roles)


def test_what_an_equation_has_below_already_must_not_vanish_either() -> None:
    q, a = symbols("theta a", real=True)
    (found,) = solved_for(given(Relation(m * a - g / sin(q), "=", Integer(0))), a)
    assert dict(found.step.roles)["excluded"] == Relation(sin(q), "!=", 0)


def test_a_root_with_a_number_replaces_its_unknown() -> None:
    """f14: the second time at which y = v t - g t^2/2 vanishes, substituted in x = u t."""
    (u, v), t = symbols("u v", positive=True), symbols("t", real=True)
    landing = roots(given(v * t - g * t**2 / 2, "up", symbol="y"), t)
    assert str(landing[1].symbol) == "t_2"
    assert equal(put_in(given(u * t, "along", symbol="x"), landing[1]).value, 2 * u * v / g)


# --- where a result is greatest or least ---

THROW = """\
title: The range of a projectile
solve: system
symbols: {m: mass, g: acceleration, v_0: speed, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length}
  particles: {ball: {mass: m, at: [x, y]}}
  gravity: g
  results:
    along: {solution: motion_x, for: x, start: 0, start_rate: v_0*cos(alpha)}
    up: {solution: motion_y, for: y, start: 0, start_rate: v_0*sin(alpha)}
    landing: {roots: up, for: t}
    range: {put_in: along, results: [landing_2]}
    best: {maximum: range, for: alpha}
statement: A ball.
parts:
  - ask: How far does it get, and which angle is best?
    answer: [landing, range, best_alpha, best]
"""

DRIVEN = """\
title: Resonance
solve: system
symbols: {m: mass, k: spring constant, b: damping constant, F: force, omega: angular speed}
given:
  coordinates: {x: length}
  particles: {cart: {mass: m, at: [x, 0]}}
  potential: k*x**2/2
  damping: {constant: b, at: [x, 0]}
  forces: {components: [F*cos(omega*t), 0], at: [x, 0]}
  results:
    steady: {amplitude: motion_x, for: x}
    resonance: {maximum: steady, for: omega}
values: {m: 1 kg, k: 1e6 N/m, b: 1e-3 kg/s, F: 1 N}
statement: A cart.
parts:
  - {ask: Where is the amplitude greatest., answer: [resonance_omega, resonance]}
"""


def test_a_letter_with_a_range_is_chosen_from_it(tmp_path: Path) -> None:
    steps = solved(tmp_path, THROW)
    assert steps["best_alpha"].value == pi / 4
    assert str(steps["best"].value) == "v_0**2/g"


def test_the_least_energy_in_an_oscillator_potential() -> None:
    """f10: U = l^2/(2 m r^2) + k r^2/2 is least at r = (l^2/(m k))^(1/4), where it is l sqrt(k/m)."""
    r = symbols("r", positive=True)
    place, least = minimum(given(l**2 / (2 * m * r**2) + k * r**2 / 2, symbol="U"), r)
    assert equal(place.value**4, l**2 / (m * k))
    assert equal(least.value, l * sqrt(k / m))


def test_the_best_angle_up_a_slope_depends_on_the_slope() -> None:
    alpha, beta = symbols("alpha beta", real=True)
    slope = Range(Integer(0), pi / 2)
    with within({alpha: slope, beta: slope}), recorded(Run()) as run:
        run.assumed.append(Relation(cos(beta), "!=", Integer(0)))
        reach = given(2 * sin(alpha) * cos(alpha + beta) / cos(beta) ** 2, symbol="X")
        place, _ = maximum(reach, alpha, within=(0, pi / 2))
    assert equal(place.value, pi / 4 - beta / 2)


def test_a_place_that_may_lie_outside_of_the_interval_has_a_condition() -> None:
    n = symbols("n", real=True)
    place, top = maximum(given(M * n - m * n**2), n, within=(0, 1))
    assert dict(place.step.roles)["inside_1"] == Relation(2 * m, ">", M)
    assert equal(top.value, M**2 / (4 * m))


def test_an_assumed_relation_bounds_the_interval() -> None:
    """x (a - x)^2 has zero slope at a/3 and at a, but x < a."""
    x, a = symbols("x a", positive=True)
    with recorded(Run()) as run:
        run.assumed.append(Relation(x, "<", a))
        place, _ = maximum(given(x * (a - x) ** 2), x)
    assert place.value == a / 3


def test_a_place_outside_of_the_interval_is_none() -> None:
    n = symbols("n", real=True)
    with pytest.raises(Rejected, match="is not stationary for any allowed n"):
        maximum(given(4 * n - n**2), n, within=(0, 1))


def test_a_condition_that_leaves_the_interval_out_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    n = symbols("n", real=True)
    monkeypatch.setattr("derive.mechanics.answers.extrema._inside", lambda *_: [])
    with pytest.raises(Unverified):
        maximum(given(M * n - m * n**2), n, within=(0, 1))


def test_a_resonance_has_its_condition_though_numbers_fulfil_it(tmp_path: Path) -> None:
    page = printed(tmp_path, DRIVEN)
    assert "Such a maximum exists if b² < 2k m" in page and "≈ 1000 s^-1" in page


def test_there_is_no_resonance_with_too_much_damping(tmp_path: Path) -> None:
    """b^2 = 4e6 kg^2/s^2 exceeds 2 k m = 2e6 kg^2/s^2."""
    found = messages(tmp_path, edited(DRIVEN, ("b: 1e-3 kg/s", "b: 2000 kg/s")))
    assert found == ["12: `maximum`: `steady` is not stationary for any allowed omega"]


def test_the_greatest_speed_is_the_root_of_its_square(tmp_path: Path) -> None:
    """f11: v^2 = k (A^2 - x^2)/m at x = 0, so v = A sqrt(k/m)."""
    text = edited(
        DRIVEN,
        ("    steady: {amplitude: motion_x, for: x}\n", "    fast: {speed: energy_function, for: x, start: -F/k}\n"),
        (
            "    resonance: {maximum: steady, for: omega}\n",
            "    at: {put_in: fast, values: {x: 0}}\n    top: {value: sqrt(at), symbol: v_max}\n",
        ),
        ("  damping: {constant: b, at: [x, 0]}\n", ""),
        ("  forces: {components: [F*cos(omega*t), 0], at: [x, 0]}\n", ""),
        ("answer: [resonance_omega, resonance]", "answer: top"),
    )
    steps = solved(tmp_path, text)
    assert equal(steps["top"].value ** 2, steps["at"].value)


def test_all_that_is_not_zero_at_the_start_is_named(tmp_path: Path) -> None:
    text = """\
title: Two coupled carts
solve: system
symbols: {m: mass, k: spring constant, A: length, B: length, v: speed, u: speed}
given:
  coordinates: {x_1: length, x_2: length}
  particles: {one: {mass: m, at: [x_1, 0]}, two: {mass: m, at: [x_2, 0]}}
  potential: k*(x_1**2 + x_2**2 + (x_1 - x_2)**2)/2
  results:
    both: {solution: normal_modes, values: {x_1: A, x_2: B, x_1_dot: v, x_2_dot: u}}
statement: Two carts.
parts:
  - ask: Find the motion.
    answer: both
"""
    page = normalize("NFC", " ".join(printed(tmp_path, text).split()))
    assert "x_1 = A, x_2 = B, ẋ_1 = v, ẋ_2 = u at t = 0, determine" in page
    assert "all else zero" not in page
    fewer = normalize("NFC", " ".join(printed(tmp_path, edited(text, (", x_2_dot: u}", "}"))).split()))
    assert "ẋ_1 = v at t = 0 and all else zero, determine" in fewer


# --- assumptions about letters ---

SATELLITE = """\
title: A dumbbell satellite
solve: system
symbols: {M: mass, m: mass, G: gravitational constant, l: length, r_0: length, Omega: angular speed}
given:
  coordinates: {theta: angle}
  axes: {orbit: [{z: Omega*t}]}
  places:
    C: {in: orbit, by: [r_0, 0, 0]}
    A: {from: C, by: [l*cos(theta), l*sin(theta), 0], in: orbit}
    B: {from: C, by: [-l*cos(theta), -l*sin(theta), 0], in: orbit}
  particles: {first: {mass: m, at: A}, second: {mass: m, at: B}}
  central:
    - {energy: -G*M*m/d, distance: d, from: [0, 0, 0], to: A}
    - {energy: -G*M*m/d, distance: d, from: [0, 0, 0], to: B}
  assume: [l < r_0]
  at: {theta: 0}
statement: A satellite.
parts:
  - ask: Is it stable?
    answer: stability
"""


def test_a_satellite_is_stable_along_the_radius(tmp_path: Path) -> None:
    page = printed(tmp_path, SATELLITE)
    assert "Assume that l < r_0." in page
    assert "the equilibrium is stable" in page


def test_what_is_not_known_is_named_with_the_way_to_state_it(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(SATELLITE, ("  assume: [l < r_0]\n", "")))
    assert found.message == (
        "`stability`: the sentence for this result could not be confirmed: it is not known whether l < r_0"
    )
    assert found.help == "state it under `given:`, as `assume: [l < r_0]`"


def test_a_force_that_changes_its_sign_at_a_pole_is_not_zero_there(tmp_path: Path) -> None:
    """U = A d^2/(d - x)^2 + A d^2/(d + x)^2: the force vanishes only at x = 0, and U'' = 12 A/d^2 there."""
    text = """\
title: Between two walls
solve: system
symbols: {m: mass, d: length, A: positive energy}
given:
  coordinates: {x: length}
  particles: {p: {mass: m, at: [x, 0]}}
  potential: A*d**2/(d - x)**2 + A*d**2/(d + x)**2
statement: A bead.
parts:
  - ask: Where is it in equilibrium?
    answer: [equilibria, stability]
"""
    steps = solved(tmp_path, text)
    d, energy = symbols("d A", positive=True)
    assert equal(steps["stability"].value, 12 * energy / d**2)


def test_a_frequency_is_compared_with_a_letter_that_stands_alone() -> None:
    """sqrt(g/l) > S is S < sqrt(g/l), although the quotient of the two differences contains roots."""
    found = where(given(sqrt(g / l), "w", symbol="w"), ">", S, S)
    assert found.value.operator == "<" and found.value.left == S and equal(found.value.right, sqrt(g / l))
