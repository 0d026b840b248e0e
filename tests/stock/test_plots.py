"""Curves of answers of a described system: `plot` under `drawings:`."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Symbol, cos, pi, simplify, sin, sqrt

from derive.building.cache import Cache
from derive.building.derivations import steps_key
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.figures.marks import Outline, Plot
from derive.steps.record import Run
from tests.courses import ROOT, solved_once
from tests.stock.described import CART_WITH_DRAG, complaints, course_with, edited, loaded, messages

HOOP = """\
title: A bead on a rotating hoop
solve: system
symbols: {R: length, m: mass, g: acceleration, omega: angular speed}
given:
  coordinates: {theta: angle}
  axes: {hoop: [{z: omega*t}]}
  particles:
    bead: {mass: m, at: {in: hoop, by: [R*sin(theta), 0, -R*cos(theta)]}}
  gravity: g
statement: A bead of mass <<m>> on a hoop of radius <<R>> that rotates at the rate <<omega>>.
parts:
  - {ask: Find the Lagrangian., answer: lagrangian}
  - ask: Which equilibria are stable? Plot the effective potential for two rotations, <<cases>>.
    answer: [equilibria, stability]
  - {ask: Find the energy function., answer: energy_function}
drawings:
  energy:
    plot: effective_potential
    against: theta
    range: [-200 deg, 200 deg]
    at: b
    caption: The effective potential energy for a slow and for a fast rotation.
    cases:
      - {R: 1 m, m: 1 kg, g: 9.8 m/s^2, omega: 2 rad/s}
      - {omega: 4 rad/s}
"""

PENDULUM = """\
title: A pendulum
solve: system
symbols: {m: mass, g: acceleration, l: length}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
values: {m: 1 kg, g: 9.8 m/s^2, l: 1 m}
statement: A bob of mass <<m>> hangs on a light rod of length <<l>>, at the angle <<theta>> from the vertical.
parts: [{ask: Find the potential energy., answer: potential_energy}]
"""


def test_the_curve_of_an_answer_is_drawn(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, HOOP), run)
    (curve,) = (each for each in run.drawings if isinstance(each, Plot))
    letters = {symbol.name: symbol for symbol in curve.expr.free_symbols}
    m, g, R, omega, theta = (letters[name] for name in ("m", "g", "R", "omega", "theta"))
    assert (curve.expr + m * g * R * cos(theta) + m * R**2 * omega**2 * sin(theta) ** 2 / 2).expand() == 0
    assert (curve.variable, curve.lower, curve.upper) == (Symbol("theta", real=True), -10 * pi / 9, 10 * pi / 9)
    assert (curve.of, curve.kind) == ("angle", "energy")


def test_a_plot_that_is_added_after_a_build_is_drawn(tmp_path: Path) -> None:
    """The stored derivation of the same problem without the plot is not used."""
    cache = Cache(tmp_path / "cache")
    first = rendered(course_with(tmp_path, PENDULUM), "trial/one", None, cache, only={"json"})
    assert '"energy"' not in first.texts["json"]
    drawn = f"{PENDULUM}drawings: {{energy: {{plot: potential_energy, against: theta, range: [0 deg, 90 deg]}}}}\n"
    second = rendered(course_with(tmp_path, drawn), "trial/one", None, cache, only={"json"})
    assert '"key": "energy"' in second.texts["json"]


ROTATING_ROD = """\
title: A bob on a rotating rod
solve: system
symbols: {m: mass, g: acceleration, l: length, omega: angular speed}
given:
  coordinates: {theta: angle}
  axes: {B: [{z: omega*t}]}
  particles: {bob: {mass: m, at: {in: B, by: [l*sin(theta), 0, -l*cos(theta)]}}}
  gravity: g
  results:
    circle: {put_in: motion_theta, values: {theta: pi/3, theta_ddot: 0}}
    field: {roots: circle, for: g, symbol: g_0}
values: {m: 1 kg, l: 1 m}
statement: A bob of mass <<m>> on a light rod of length <<l>> that rotates at the rate <<omega>>.
parts: [{ask: 'For which $g$ is the bob at rest on the rod?', answer: field}]
drawings: {curve: {plot: field, against: omega, range: [1 rad/s, 3 rad/s]}}
"""


def test_the_axis_of_a_root_with_its_own_symbol_has_a_unit(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, ROTATING_ROD), run)
    (curve,) = (each for each in run.drawings if isinstance(each, Plot))
    assert (str(curve.label), curve.kind, curve.unit_up) == ("g_0", "number", "m/s^2")


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ([("    against: theta\n", "")], "needs `against`"),
        ([("    range: [-200 deg, 200 deg]\n", "")], "needs `against` with a letter, and `range`"),
        ([("    against: theta\n", "    against: phi\n")], "does not depend on `phi`"),
        (
            [
                ("plot: effective_potential", "plot: hamiltonian"),
                ("against: theta", "against: p_theta"),
                ("[-200 deg, 200 deg]", "[1 J s, 2 J s]"),
                ("answer: energy_function", "answer: hamiltonian"),
            ],
            "`p_theta` is not a coordinate, a rate, `t` or a symbol under `symbols`",
        ),
        ([("    plot: effective_potential\n", "")], "`against` has no effect without `plot` or `curves`"),
        ([("    plot: effective_potential\n", "    plot: stability\n")], "denotes several results"),
        ([("    plot: effective_potential\n", "    plot: effective\n")], "`effective`"),
        ([("    at: b\n", "    at: b\n    per: [1, m]\n")], "`m` is in kg, but it divides values in J"),
        ([("    at: b\n", "    at: b\n    per: [m*g*R]\n")], "`per` of this plot must have 2 quantities, but has 1"),
        ([("    at: b\n", "    at: b\n    energies: [m*g]\n")], "`m*g` is in N, not in J"),
        ([("    at: b\n", "    at: b\n    without: [x]\n")], "`without` has no effect on `energy`, which is a plot"),
        ([("drawings:\n", "drawings:\n  system: {per: [1, 1]}\n")], "`per` has no effect on `system`"),
        ([("drawings:\n", "drawings:\n  system: {without: [q]}\n")], "no mark has the label `q`"),
    ],
)
def test_a_mistake_is_reported(tmp_path: Path, edits: list[tuple[str, str]], said: str) -> None:
    assert any(said in each for each in messages(tmp_path, edited(HOOP, *edits)))


DAMPED = f"""{CART_WITH_DRAG}    on_the_border: {{put_in: motion_x, values: {{b: 2*sqrt(k*m)}}}}
    border: {{solution: on_the_border, for: x, start: x_0}}
define: {{beta: b/(2*m), omega_0: sqrt(k/m)}}
statement: A cart.
wording: {{WORDS}}
drawings:
parts:
  - {{ask: Find the motion., answer: ANSWERS}}
"""


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ("[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 5 kg/s}]", "the plot `curve`"),
        ("[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 5 kg/s}]", "case ii of the plot `curve`"),
        ("[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 1.5 kg/s}]", ""),
    ],
)
def test_numbers_outside_the_case_of_a_result_are_not_drawn(tmp_path: Path, numbers: str, said: str) -> None:
    """An underdamped motion needs b^2 < 4 k m."""
    curve = f"drawings:\n  curve: {{plot: weak, against: t, range: [0 s, 9 s], at: a, cases: {numbers}}}\n"
    text = edited(DAMPED, ("drawings:\n", curve), ("ANSWERS", "weak"), ("WORDS", "weak: The motion is <<chain>>"))
    try:
        rendered(course_with(tmp_path, text), "trial/one", only=("text",))
        found = ""
    except DeriveError as error:
        (found,) = [each.message for each in error.complaints]
    expected = f"the numbers of {said} do not satisfy beta < omega_0, which the plotted result requires"
    assert found == (expected if said else "")


SLOW = "      - {R: 1 m, m: 1 kg, g: 9.8 m/s^2, omega: 2 rad/s}\n"
FAST = "      - {omega: 4 rad/s}\n"


@pytest.mark.parametrize(
    ("edits", "line", "said", "helped"),
    [
        (
            [("    cases:\n" + SLOW + FAST, "    values: {R: 1 m}\n"), (", <<cases>>", "")],
            23,
            "`values` has no effect on the plot `energy`",
            "",
        ),
        (
            [("    cases:\n" + SLOW + FAST, ""), (", <<cases>>", "")],
            17,
            "needs a number for `R`, `g`, `m`, `omega`",
            "under the `values` of the problem, or under the `cases` of the drawing",
        ),
        ([(FAST, "      - {omega: 4 rad/s, theta: 10 deg}\n")], 25, "`theta` varies along the horizontal axis", ""),
        ([(FAST, "      - {omega: 2 rad/s}\n")], 25, "case ii of the plot `energy` is the same as case i", ""),
        ([(FAST, "      - {omega: 2.0 rad/s}\n")], 25, "case ii of the plot `energy` is the same as case i", ""),
        (
            [("    at: b\n", "    at: c\n")],
            13,
            "no plot in part b has `cases`",
            "the plot `energy` is in part c: mention `<<cases>>` there, or move the plot with `at: b`",
        ),
        ([("symbols: {R: length,", "symbols: {R: length, M: mass,"), (SLOW, SLOW.replace("{R", "{M: 1 kg, R"))], 24,
         "`M` does not occur in the drawing `energy`, so its value is not used", ""),
    ],
)  # fmt: skip
def test_what_has_no_effect_on_a_curve_is_reported(
    tmp_path: Path, edits: list[tuple[str, str]], line: int, said: str, helped: str
) -> None:
    try:
        found = rendered(course_with(tmp_path, edited(HOOP, *edits)), "trial/one", only=("text",)).warnings
    except DeriveError as error:
        found = error.complaints
    told = [(each.place.line if each.place else 0, each.message, each.help or "") for each in found]
    assert any(at == line and said in message and helped in more for at, message, more in told), told


THROW = """\
title: A stone
solve: system
symbols: {m: mass, g: acceleration, v_0: speed, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, z: length}
  places: {stone: [x, z]}
  particles: {stone: {mass: m, at: stone}}
  gravity: g
  results:
    path_x: {solution: motion_x, for: x, start: 0, start_rate: v_0*cos(alpha)}
    path_z: {solution: motion_z, for: z, start: 0, start_rate: v_0*sin(alpha)}
    top: {maximum: path_z, for: t}
statement: A stone of mass <<m>> is thrown with the speed <<v_0>> at the angle <<alpha>>.
parts:
  - ask: Find the coordinates of the stone, and the highest point.
    answer: [path_x, path_z, top]
drawings:
  path:
    plot: [path_x, path_z]
    against: t
    range: [0 s, 2*top_t]
    caption: The path.
    cases:
      - {v_0: 10 m/s, g: 9.8 m/s^2, alpha: 30 deg}
"""


def path_of(tmp_path: Path, *edits: tuple[str, str]) -> Plot:
    run = Run()
    run_solve(loaded(tmp_path, edited(THROW, *edits)), run)
    return next(each for each in run.drawings if isinstance(each, Plot))


def test_the_path_of_two_answers_is_drawn_to_an_end_that_is_an_answer(tmp_path: Path) -> None:
    path = path_of(tmp_path)
    assert path.across is not None
    letters = {symbol.name: symbol for symbol in path.letters}
    t, g, v_0, alpha = (letters[name] for name in ("t", "g", "v_0", "alpha"))
    assert simplify(path.across.expr - v_0 * t * cos(alpha)) == 0
    assert simplify(path.expr - v_0 * t * sin(alpha) + g * t**2 / 2) == 0
    assert (path.variable, path.of, path.lower) == (t, "time", 0)
    assert simplify(path.upper - 2 * v_0 * sin(alpha) / g) == 0
    assert (str(path.across.label), path.across.unit, str(path.label), path.unit_up) == ("x", "m", "z", "m")
    assert path.keys == ("path_x", "path_z", "top_t")


def test_a_formula_of_a_path_has_letters_and_answers_and_the_unit_of_its_dimension(tmp_path: Path) -> None:
    path = path_of(tmp_path, ("[path_x, path_z]", "[m*path_x, alpha]"))
    assert path.across is not None
    assert (path.across.unit, str(path.across.label)) == ("kg m", "m*x")
    assert (path.unit_up, path.kind, path.keys) == ("rad", "angle", ("path_x", "top_t"))


def test_a_path_is_described_by_its_ends(tmp_path: Path) -> None:
    def told(*edits: tuple[str, str]) -> str:
        return " ".join(
            rendered(course_with(tmp_path, edited(THROW, *edits)), "trial/one", only=("html",)).html.split()
        )

    assert "A plot of z against x as t increases from 0 s to 1.02 s." in told()
    assert "It starts at (0 m, 0 m) and ends at (8.837 m, 0 m)." in told()
    turns = [
        ("[path_x, path_z]", "[cos(alpha), sin(alpha)]"),
        ("against: t", "against: alpha"),
        (", alpha: 30 deg", ""),
    ]
    assert "It starts at (1, 0) and returns to this point." in told(
        *turns,
        ("[0 s, 2*top_t]", "[0 deg, 360 deg]"),
        ("      - {v_0: 10 m/s, g: 9.8 m/s^2}\n", ""),
        ("    cases:\n", ""),
    )


@pytest.mark.parametrize(
    ("edits", "said", "helped"),
    [
        ([("[path_x, path_z]", "[path_x]")], "`plot` must be an answer, or a list of two answers or formulas", ""),
        ([("[path_x, path_z]", "[path_x, path_z, top]")], "`plot` must be an answer, or a list of two", "such as"),
        ([("[path_x, path_z]", "[path_x, [path_z]]")], "`plot` must be an answer, or a list of two", "such as"),
        ([("[path_x, path_z]", "[path_x, '']")], "but it is empty", ""),
        ([("[path_x, path_z]", "[path_x, path_y]")], "`path_y` is not the name of an answer", "did you mean `path_"),
        ([("[path_x, path_z]", "[path_x, path_z + v_0]")], "`path_z` is a length, but `v_0` is a speed", ""),
        ([("[path_x, path_z]", "[path_x, 'path_z +']")], "something is missing at the end", ""),
        ([("[path_x, path_z]", "[path_x, equations_of_motion]")], "`equations_of_motion` denotes several results", ""),
        ([("[path_x, path_z]", "[x, z]")], "neither `x` nor `z` depends on `t`, so there is no path", ""),
        ([("against: t", "against: s")], "neither `path_x` nor `path_z` depends on `s`", ""),
        ([("    against: t\n", "")], "the plot `path` needs `against`", ""),
        ([("2*top_t", "2*top_s")], "`top_s` is not the name of an answer", "did you mean `top"),
        ([("2*top_t", "path_x")], "`range` must be a time, but `path_x` is a length", ""),
        ([("2*top_t", "2 m")], "`range` must be a time, but `2 m` is a length", ""),
        ([("[0 s, 2*top_t]", "[0 s]")], "`range` must be the two ends", ""),
    ],
)
def test_a_mistake_in_a_path_is_reported(tmp_path: Path, edits: list[tuple[str, str]], said: str, helped: str) -> None:
    found = complaints(tmp_path, edited(THROW, *edits))
    assert any(said in each.message and helped in (each.help or "") for each in found), found
    assert all(each.place for each in found)


@pytest.mark.parametrize(
    ("edits", "line", "said"),
    [
        ([(", alpha: 30 deg", "")], 18, "the plot `path` needs a number for `alpha`"),
        ([("2*top_t", "-top_t")], 21, "the range of `path` must go from a smaller number to a larger number"),
        (
            [("against: t", "against: alpha"), ("0 s, 2*top_t", "0 deg, 45 deg")],
            24,
            "`alpha` varies along the path `path`, so a number for it has no effect",
        ),
        ([("[path_x, path_z]", "[path_x, sqrt(-path_z/v_0)]")], 18, "is not real and finite over its whole range"),
        ([("alpha: 30 deg", "alpha: 30 deg, m: 1 kg")], 24, "`m` does not occur in the drawing `path`"),
        (
            [("    cases:\n", "    values: {g: 9.8 m/s^2}\n    cases:\n")],
            23,
            "`values` has no effect on the plot `path`",
        ),
        ([("    against: t\n", "    against: t\n    at: statement\n")], 21, "would show `path_x` before it is derived"),
    ],
)
def test_a_path_without_numbers_is_reported(tmp_path: Path, edits: list[tuple[str, str]], line: int, said: str) -> None:
    try:
        found = rendered(course_with(tmp_path, edited(THROW, *edits)), "trial/one", only=("text",)).warnings
    except DeriveError as error:
        found = error.complaints
    told = [(each.place.line if each.place else 0, each.message) for each in found]
    assert any(at == line and said in message for at, message in told), told


SWING = """\
title: A pendulum
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle}
  places: {bob: [l*sin(theta), -l*cos(theta)]}
  particles: {bob: {mass: m, at: bob}}
  gravity: g
statement: A bob of mass <<m>> hangs on a light rod of length <<l>>. Its angle is <<theta>>.
parts:
  - ask: Find the Hamiltonian.
    answer: [hamiltonian, momenta]
drawings:
  portrait:
    plot: hamiltonian
    levels: [-5 J, m*g*l, 15 J]
    over: {theta: [-180 deg, 180 deg], p_theta: [-9 kg*m^2/s, 9 kg*m^2/s]}
    caption: The phase portrait.
    cases:
      - {m: 1 kg, l: 1 m, g: 9.8 m/s^2}
"""


def test_a_phase_portrait_has_a_coordinate_its_momentum_and_values(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, SWING), run)
    portrait = next(each for each in run.drawings if isinstance(each, Plot))
    levels = portrait.levels
    assert levels is not None
    letters = {symbol.name: symbol for symbol in portrait.letters}
    m, g, l_, theta, p = (letters[name] for name in ("m", "g", "l", "theta", "p_theta"))
    assert simplify(portrait.expr - p**2 / (2 * m * l_**2) + m * g * l_ * cos(theta)) == 0
    assert (portrait.variable, portrait.lower, portrait.upper, portrait.of) == (theta, -pi, pi, "angle")
    assert (levels.up, levels.low, levels.high, portrait.label, portrait.unit_up) == (p, -9, 9, p, "kg m^2/s")
    assert levels.values == ((-5, False), (m * g * l_, True), (15, False))
    assert portrait.keys == ("hamiltonian",)


def test_a_phase_portrait_is_described(tmp_path: Path) -> None:
    page = " ".join(rendered(course_with(tmp_path, SWING), "trial/one", only=("html",)).html.split())
    assert "A phase portrait, with θ from −180° to 180° on the horizontal axis." in page
    assert (
        "from −9 kg m^2/s to 9 kg m^2/s on the vertical axis, and the curves have the values −5 J, 9.8 J and 15 J"
        in page
    )
    assert "the thick curve has the value m g l" in page


OVER = "    over: {theta: [-180 deg, 180 deg], p_theta: [-9 kg*m^2/s, 9 kg*m^2/s]}\n"


@pytest.mark.parametrize(
    ("edits", "line", "said", "helped"),
    [
        ([(OVER, "")], 14, "the phase portrait `portrait` needs `plot` with one answer, `levels`", "such as `plot: h"),
        ([("    levels: [-5 J, m*g*l, 15 J]\n", "")], 14, "the phase portrait `portrait` needs", ""),
        ([("    plot: hamiltonian\n", "")], 14, "the phase portrait `portrait` needs `plot` with one answer", ""),
        ([("theta: [-180 deg, 180 deg], ", "")], 14, "the phase portrait `portrait` needs", ""),
        ([(OVER, OVER + "    against: theta\n")], 18, "`against` has no effect on the phase portrait", "leave it out"),
        ([(OVER, OVER + "    range: [0 deg, 1 deg]\n")], 18, "`range` has no effect on the phase portrait", ""),
        ([(OVER, OVER + "    up: [0 J, 1 J]\n")], 18, "`up` has no effect on `portrait`", "leave it out, or give"),
        ([("levels: [-5 J, m*g*l, 15 J]", "levels: []")], 16, "`levels` must be a list of values", ""),
        ([("-5 J", "-5 m")], 16, "`-5 m` is a length", ""),
        ([("-5 J", "-5 m*g*h")], 16, "", ""),
        ([("-5 J", "top")], 16, "`top` is not the name of an answer", ""),
        ([("plot: hamiltonian", "plot: hamiltonia")], 15, "hamiltonia", "did you mean `hamiltonian`?"),
        ([("plot: hamiltonian", "plot: p_theta")], 15, "`p_theta` is not an energy, so it has no phase portrait", ""),
        ([("plot: hamiltonian", "plot: lagrangian")], 17, "`lagrangian` does not depend on `p_theta`", ""),
        ([("p_theta: [", "p_thet: [")], 17, "`hamiltonian` does not depend on `p_thet`", "did you mean `p_theta`?"),
        ([("{theta: [-180 deg, 180 deg]", "{m: [1 kg, 2 kg]")], 17, "are not a coordinate and its momentum",
         "such as `theta` and `p_theta`"),
        ([("[-180 deg, 180 deg]", "[-180 deg]")], 17, "`theta` must be the two ends of a range", ""),
        ([("-180 deg, 180 deg", "180 deg, -180 deg")], 17, "must go from a smaller number to a larger number", ""),
        ([("-9 kg*m^2/s, 9", "9 kg*m^2/s, -9")], 17, "must go from a smaller number to a larger number", ""),
        ([("-9 kg*m^2/s", "-9 kg*m/s")], 17, "`range` must be an angular momentum", ""),
        ([(", g: 9.8 m/s^2", "")], 14, "the plot `portrait` needs a number for `g`", ""),
        ([("15 J", "200 J")], 14, "the phase portrait has no curve with the value 200",
         "the values in these ranges are from -9.8 to 50.3"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_phase_portrait_is_reported(
    tmp_path: Path, edits: list[tuple[str, str]], line: int, said: str, helped: str
) -> None:
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, edited(SWING, *edits)), "trial/one", only=("text",))
    told = [(each.place.line if each.place else 0, each.message, each.help or "") for each in refused.value.complaints]
    assert any(at == line and said in message and helped in more for at, message, more in told), told


def test_the_stored_steps_depend_on_what_is_plotted(tmp_path: Path) -> None:
    edits = [("[path_x, path_z]", "[path_z, path_x]"), ("2*top_t", "top_t"), ("against: t", "against: alpha")]
    keys = {steps_key(loaded(tmp_path, edited(THROW, edit))) for edit in edits} | {steps_key(loaded(tmp_path, THROW))}
    assert len(keys) == 4
    portraits = [("15 J", "16 J"), ("-180 deg", "-90 deg")]
    assert len({steps_key(loaded(tmp_path, edited(SWING, edit))) for edit in portraits}) == 2
    assert steps_key(loaded(tmp_path, THROW.replace("The path.", "A path."))) in keys, "but not on its caption"


def test_the_ends_of_a_range_may_have_units_of_several_parts(tmp_path: Path) -> None:
    """No name in `m/s^2` is taken to be the name of an answer."""
    text = PENDULUM.replace("values: {m: 1 kg, g: 9.8 m/s^2, l: 1 m}", "values: {m: 1 kg, l: 1 m}")
    text = text.replace("energy., answer: potential_energy", "frequency of small oscillations., answer: frequency")
    text += "drawings: {swing: {plot: frequency, against: g, range: [1 m/s^2, 20 m/s^2]}}\n"
    assert '"key": "swing"' in rendered(course_with(tmp_path, text), "trial/one", only={"json"}).texts["json"]


def plot_in(tmp_path: Path, text: str) -> Plot:
    run = Run()
    run_solve(loaded(tmp_path, text), run)
    return next(each for each in run.drawings if isinstance(each, Plot))


def test_a_result_without_a_kind_has_the_unit_of_its_dimension(tmp_path: Path) -> None:
    text = edited(
        THROW,
        ("    top: {", "    product: {value: path_x*t, symbol: u}\n    top: {"),
        ("[path_x, path_z, top]", "[path_x, path_z, product, top]"),
        ("plot: [path_x, path_z]", "plot: product"),
    )
    assert plot_in(tmp_path, text).unit_up == "m s"


BOTH = [("plot: [path_x, path_z]", "curves: [path_x, path_z]")]


def test_the_curves_of_several_answers_share_a_plot(tmp_path: Path) -> None:
    both = plot_in(tmp_path, edited(THROW, *BOTH))
    (further,) = both.others
    assert (str(both.label), str(further.label), further.key) == ("x", "z", "path_z")
    assert (both.unit_up, both.of, both.keys) == ("m", "time", ("path_x", "path_z", "top_t"))
    page = " ".join(rendered(course_with(tmp_path, edited(THROW, *BOTH)), "trial/one", only=("html",)).html.split())
    assert "A plot of x and z against t from 0 s to 1.02 s." in page
    assert "x has no extremum within the range." in page
    assert "z has a maximum of 1.276 m at t = 0.5102 s." in page


@pytest.mark.parametrize(
    ("edits", "line", "said"),
    [
        ([("curves: [", "plot: path_x\n    curves: [")], 20, "the plot `path` cannot have both `plot` and `curves`"),
        ([("[path_x, path_z]\n    ag", "[path_x, path_x]\n    ag")], 19, "`path_x` has two curves"),
        ([("[path_x, path_z]\n    ag", "[path_x, top]\n    ag")], 19, "`top` denotes several results"),
        ([("[path_x, path_z]\n    ag", "[path_x, path_y]\n    ag")], 19, "`path_y` is not the name of an answer"),
        ([("[path_x, path_z]\n    ag", "[path_x, lagrangian]\n    ag")], 20, "`lagrangian` does not depend on `t`"),
        ([("[path_x, path_z]\n    ag", "[]\n    ag")], 19, "`curves` must be a list of answers"),
        ([("    against: t\n", "")], 18, "the plot `path` needs `against`"),
        ([("    cases:\n", "    panels: beside\n    cases:\n")], 23, "`panels` must be together or apart"),
        ([("    cases:\n", "    labels: [x, y]\n    cases:\n")], 23, "`labels` has no effect on `path`"),
    ],
)
def test_a_mistake_in_curves_of_several_answers_is_reported(
    tmp_path: Path, edits: list[tuple[str, str]], line: int, said: str
) -> None:
    found = complaints(tmp_path, edited(edited(THROW, *BOTH), *edits))
    told = [(each.place.line if each.place else 0, each.message) for each in found]
    assert any(at == line and said in message for at, message in told), told


def test_curves_without_a_common_unit_share_no_axis(tmp_path: Path) -> None:
    product = ("    top: {", "    double: {value: path_x*t, symbol: w}\n    top: {")
    text = edited(THROW, product, ("plot: [path_x, path_z]", "curves: [path_x, double]"))
    (found,) = complaints(tmp_path, text)
    assert found.message == "`double` is in m s and `path_x` in m, so they need different axes"


@pytest.mark.long
@pytest.mark.parametrize(
    ("cases", "said"),
    [
        ("[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 2 kg/s}, {b: 5 kg/s}]", ""),
        ("[{x_0: 1 m, m: 1 kg, k: 3 N/m, b: 1 kg/s}, {b: 3.46 kg/s}, {b: 5 kg/s}]", ""),
        (
            "[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 3 kg/s}, {b: 5 kg/s}]",
            "the numbers of case ii of the plot `curve` do not satisfy b = 2*sqrt(k)*sqrt(m), which the plotted "
            "result requires",
        ),
        (
            "[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 2 kg/s}, {b: 1 kg/s}]",
            "the numbers of case iii of the plot `curve` do not satisfy beta > omega_0, which the plotted result "
            "requires",
        ),
        (
            "[{x_0: 1 m, m: 1 kg, k: 1 N/m, b: 1 kg/s}, {b: 2 kg/s}]",
            "the plot `curve` has 3 curves but 2 cases",
        ),
    ],
)
def test_each_curve_has_numbers_of_its_own_case(tmp_path: Path, cases: str, said: str) -> None:
    """The critically damped motion needs b = 2 sqrt(k m), although its formula does not contain b."""
    curve = f"  curve: {{curves: [weak, border, strong], against: t, range: [0 s, 9 s], at: a, cases: {cases}}}\n"
    words = ", ".join(f"{name}: The motion is <<chain>>" for name in ("weak", "border", "strong"))
    answers = ("ANSWERS", "[weak, border, strong]"), ("WORDS", words)
    text = edited(DAMPED, ("drawings:\n", "drawings:\n" + curve), *answers)
    try:
        rendered(course_with(tmp_path, text), "trial/one", only=("text",))
        found = ""
    except DeriveError as error:
        (found,) = [each.message for each in error.complaints]
    assert found == said


def test_the_axes_of_a_path_may_have_names_in_place_of_formulas(tmp_path: Path) -> None:
    long = ("[path_x, path_z]", "[path_x + 2*path_z, 3*path_z]\n    labels: [u, w_1]")
    path = path_of(tmp_path, long)
    assert path.across is not None
    assert (str(path.across.label), str(path.label), path.unit_up) == ("u", "w_1", "m")
    for labels, said in [("[u]", "`labels` must be the names of two axes"), ("[u, 2*w]", "`2*w` is not a letter")]:
        found = complaints(tmp_path, edited(THROW, (long[0], long[1].replace("[u, w_1]", labels))))
        assert any(said in each.message for each in found), found


def test_panels_has_no_effect_on_a_single_curve_or_a_portrait(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(THROW, ("    cases:\n", "    panels: apart\n    cases:\n")))
    assert found.message == "`panels` has no effect on `path`, which does not have several curves"
    two = "      - {m: 1 kg, l: 1 m, g: 9.8 m/s^2}\n"
    several = edited(SWING, (two, two + "      - {l: 2 m}\n"), ("    cases:\n", "    panels: together\n    cases:\n"))
    assert any("`panels` has no effect on the phase portrait" in each for each in messages(tmp_path, several))


NEAR_A_SPHERE = edited(
    THROW,
    ("symbols: {", "symbols: {R: length, "),
    ("z: length}\n", "z: length, u: angle, w: length}\n"),
    ("at: stone}}\n", "at: stone}, above: {mass: m, at: [R*sin(u), R*cos(u)]}, below: {mass: m, at: [w, -R]}}\n"),
    (
        "  gravity: g\n",
        "  gravity: g\n  surfaces: {sphere: {centre: [0, 0], radius: R}, floor: {through: [0, -R], along: [1, 0]}}\n"
        "  contacts: [{of: above, on: sphere}, {of: below, on: floor}]\n",
    ),
    ("    caption: The path.", "    surfaces: [sphere, floor]\n    caption: The path."),
    ("{v_0: 10 m/s", "{R: 1 m, v_0: 10 m/s"),
)


def surfaces_of(tmp_path: Path, *edits: tuple[str, str]) -> tuple[Outline, ...]:
    run = Run()
    run_solve(loaded(tmp_path, edited(NEAR_A_SPHERE, *edits)), run)
    return next(each.outlines for each in run.drawings if isinstance(each, Plot) and each.key == "path")


def test_a_path_shows_surfaces(tmp_path: Path) -> None:
    sphere, floor = surfaces_of(tmp_path)
    (x, y), (R,) = sphere.plane, {symbol for symbol in sphere.expr.free_symbols if symbol.name == "R"}
    assert simplify(sphere.expr - (sqrt(x**2 + y**2) - R)) == 0
    assert sphere.corners == (-R, -R, R, R)
    assert (simplify(floor.expr - y - R), floor.corners) == (0, ())
    page = " ".join(rendered(course_with(tmp_path, NEAR_A_SPHERE), "trial/one", only=("html",)).html.split())
    assert "The plot also shows the surfaces sphere and floor." in page


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ([("surfaces: [sphere, floor]", "surfaces: [sphere, flor]")], "no surface is called `flor`"),
        ([("surfaces: [sphere, floor]", "surfaces: []")], "`surfaces` must be a list of surfaces"),
        ([("plot: [path_x, path_z]", "plot: [path_x, path_z/R]")], "a path of these quantities cannot show `sphere`"),
        ([("plot: [path_x, path_z]", "plot: path_z")], "`surfaces` has no effect on `path`, which is not a path"),
        (
            [("surfaces: [sphere, floor]", "up: [0 m, 1 m]")],
            "`up` has no effect on `path`, which is not a plot of curves",
        ),
    ],
)
def test_a_mistake_in_the_surfaces_of_a_path_is_reported(
    tmp_path: Path, edits: list[tuple[str, str]], said: str
) -> None:
    found = messages(tmp_path, edited(NEAR_A_SPHERE, *edits))
    assert any(said in each for each in found), found


def test_the_help_for_a_path_does_not_name_keys_of_other_plots(tmp_path: Path) -> None:
    text = edited(NEAR_A_SPHERE, ("surfaces: [sphere, floor]", "up: [0 m, 1 m]"))
    (found,) = [each for each in complaints(tmp_path, text) if "`up` has no effect" in each.message]
    assert found.help == "leave it out"


def test_a_path_shows_the_circle_of_a_string() -> None:
    """A bob whose string goes slack flies inside this circle, from one of its points to another."""
    plot = next(
        each
        for each in solved_once(ROOT, "library/slack_pendulum")[1].drawings
        if isinstance(each, Plot) and each.across
    )
    (circle,) = plot.outlines
    assert circle.name == "circle_of_bob"
    x, y = circle.plane
    l = Symbol("l", positive=True)
    for place in ((l, 0), (0, -l), (3 * l / 5, 4 * l / 5)):
        assert simplify(circle.expr.subs({x: place[0], y: place[1]})) == 0
