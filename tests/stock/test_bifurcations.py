"""Bifurcation diagrams of described systems: `plot: equilibria` under `drawings:`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from sympy import Integer, acos

from derive.building.cache import Cache
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Diagram, Plot
from derive.steps.record import Run
from tests.stock.described import course_with, edited, loaded

HOOP = """\
title: A bead on a rotating hoop
solve: system
symbols: {R: length, m: mass, g: acceleration, omega: angular speed}
define: {omega_c: sqrt(g/R)}
given:
  coordinates: {theta: angle}
  axes: {hoop: [{z: omega*t}]}
  particles:
    bead: {mass: m, at: {in: hoop, by: [R*sin(theta), 0, -R*cos(theta)]}}
  gravity: g
statement: A bead of mass <<m>> on a hoop of radius <<R>> that rotates at the rate <<omega>>.
parts:
  - {ask: Find the equation of motion., answer: motion_theta}
  - {ask: 'Find the equilibria.', answer: [rest_1, rest_2, rest_3]}
  - {ask: 'Are they stable?', answer: [stability_1, stability_2, stability_3]}
drawings:
  branches:
    plot: equilibria
    against: omega/omega_c
    range: [0, 3]
    caption: The equilibria.
"""

MOTOR = """\
title: A pendulum with a motor
solve: system
symbols: {m: mass, l: length, C: positive torque, g: acceleration}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  potential: -C*theta
  gravity: g
statement: A bob of mass <<m>> on a rod of length <<l>> at the angle <<theta>>. A motor exerts the torque <<C>>.
parts:
  - {ask: 'Where can it rest, and is it stable?', answer: [equilibria, stability]}
drawings: {branches: {plot: equilibria, against: C/(m*g*l), range: [0, 1.5]}}
"""

WIRE = """\
title: A bead with a spring
solve: system
symbols: {m: mass, l: length, d: length, k: spring constant}
given:
  coordinates: {x: length}
  places: {nail: [0, d], bead: [x, 0]}
  particles: {bead: {mass: m, at: bead}}
  springs: {constant: k, length: l, from: nail, to: bead}
statement: >
  A bead of mass <<m>> on a wire. A spring of constant <<k>> and length <<l>> joins it to a nail at the distance <<d>>.
parts:
  - {ask: 'Where can it rest, and is it stable?', answer: [equilibria, stability]}
drawings: {branches: {plot: equilibria, against: d, range: [0 cm, 20 cm], cases: [{l: 10 cm}]}}
"""


def page_of(tmp_path: Path, text: str) -> str:
    return " ".join(rendered(course_with(tmp_path, text), "trial/one", only=("html",)).html.split())


def diagram_in(tmp_path: Path, text: str) -> tuple[Plot, Diagram]:
    run = Run()
    run_solve(loaded(tmp_path, text), run)
    plot = next(each for each in run.drawings if isinstance(each, Plot))
    assert plot.diagram is not None
    return plot, plot.diagram


def test_the_branches_are_those_of_the_solution_in_terms_of_the_ratio(tmp_path: Path) -> None:
    plot, diagram = diagram_in(tmp_path, HOOP)
    x = plot.variable
    assert [branch.key for branch in diagram.branches] == ["rest_1", "rest_2", "rest_3", "rest_4"]
    first, second, third, _ = diagram.branches
    assert (first.place, first.exists, second.stable, third.stable) == (0, None, False, True)
    assert third.place == acos(x**-2)
    assert plot.letters == {x}, "no letter needs a number"
    assert str(diagram.against) == "omega/omega_c"
    assert set(plot.keys) == {f"{name}_{n}" for name in ("rest", "stability") for n in (1, 2, 3)} | {"omega_c"}
    assert drawings_from_data(drawings_to_data([plot])) == (plot,)


def test_a_pitchfork_is_told_in_words(tmp_path: Path) -> None:
    page = page_of(tmp_path, HOOP)
    assert "θ_1 = 0° is stable from 0 to 1 and unstable from 1 to 3, θ_2 = 180° is unstable from 0 to 3" in page
    assert "θ_3 is stable from 1 to 3 with values from 0° to 83.62°" in page
    assert "The equilibria change their number or their stability at ω/ω_c = 1." in page
    assert "Solid lines show stable equilibria, dashed lines unstable ones." in page


def test_two_equilibria_meet_and_end(tmp_path: Path) -> None:
    page = page_of(tmp_path, MOTOR)
    assert "θ_1 is stable from 0 to 1 with values from 0° to 90°" in page
    assert "θ_2 is unstable from 0 to 1 with values from 180° to 90°" in page


def test_a_letter_that_is_not_in_a_ratio_has_its_unit_and_the_others_have_numbers(tmp_path: Path) -> None:
    page = page_of(tmp_path, WIRE)
    assert "x_1 = 0 m is unstable from 0 m to 0.1 m and stable from 0.1 m to 0.2 m" in page
    assert "with d from 0 m to 0.2 m on the horizontal axis" in page


def test_the_vertical_axis_shows_the_range_that_the_problem_states(tmp_path: Path) -> None:
    page = page_of(tmp_path, edited(HOOP, ("    range:", "    over: {theta: [-5 deg, 60 deg]}\n    range:")))
    assert "θ_3 is stable from 1 to 1.414 with values from 0° to 60°" in page
    assert "θ_2 = " not in page.split("A diagram of")[1].split(">")[0]


WITHOUT_TOP = [
    ("{theta: angle}", "{theta: 'angle in (-pi, pi)'}"),
    ("[rest_1, rest_2, rest_3]", "equilibria"),
    ("[stability_1, stability_2, stability_3]", "stability"),
]


def test_equilibria_outside_the_range_of_the_coordinate_are_not_missed(tmp_path: Path) -> None:
    page = page_of(tmp_path, edited(WIRE, ("{x: length}", "{x: positive length}")))
    assert "x_0 is stable from 0 m to 0.1 m with values from 0.1 m to 0 m." in page
    page = page_of(tmp_path, edited(HOOP, *WITHOUT_TOP))
    assert "θ_1 = 0° is stable from 0 to 1" in page
    assert "180°" not in page


@pytest.mark.parametrize(
    ("edits", "line", "said", "helped"),
    [
        ([("omega/omega_c", "phi")], 19, "`phi`", ""),
        ([("omega/omega_c", "m")], 19, "neither the equilibria nor their stability depends on `m`", ""),
        ([("omega/omega_c", "(omega + omega_c)/omega")], 19, "is not proportional", "such as `omega` or "),
        ([("omega/omega_c", "omega/R")], 19, "`omega/R` is in ", "a letter or a dimensionless ratio"),
        ([("    against: omega/omega_c\n", "")], 17, "needs `against` with a letter, and `range`", ""),
        ([("[0, 3]", "[1.2, 3]")], 17, "changes its stability for values of the parameter from 1.2 to 3",
         "choose a different `range`"),
        ([("[0, 3]", "[3, 0]")], 20, "must go from a smaller number to a larger number", ""),
        ([("[0, 3]", "[0 m, 3 m]")], 20, "`range` must be", ""),
        ([("omega/omega_c", "omega"), ("[0, 3]", "[0 rad/s, 9 rad/s]")], 17, "needs a number for `R`, `g`", ""),
        ([("    range:", "    over: {phi: [0 deg, 9 deg]}\n    range:")], 20,
         "`phi` is not on the vertical axis of the diagram", "this axis shows `theta`"),
        ([("    range:", "    over: {theta: [100 deg, 120 deg]}\n    range:")], 17,
         "no equilibrium is within the axes of the diagram", ""),
        ([("  gravity: g\n", "  gravity: g\n  at: {theta: 0}\n"), ("answer: [stability_1, stability_2, stability_3]",
          "answer: stability")], 19, "`stability` does not decide whether `rest_2` is stable", "leave out `at`"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_diagram_is_reported(
    tmp_path: Path, edits: list[tuple[str, str]], line: int, said: str, helped: str
) -> None:
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, edited(HOOP, *edits)), "trial/one", only=("text",))
    told = [(each.place.line if each.place else 0, each.message, each.help or "") for each in refused.value.complaints]
    assert any(at == line and said in message and helped in more for at, message, more in told), told


def test_equilibria_of_several_coordinates_have_no_diagram(tmp_path: Path) -> None:
    text = edited(
        WIRE,
        ("{x: length}", "{x: length, y: length}"),
        ("bead: [x, 0]}", "bead: [x, 0], other: [y, d]}"),
        ("{bead: {mass: m, at: bead}}", "{bead: {mass: m, at: bead}, other: {mass: m, at: other}}"),
        ("  springs: {constant: k, length: l, from: nail, to: bead}",
         "  potential: k*x**2/2 - k*l*x + k*y**2/2"),
    )  # fmt: skip
    with pytest.raises(DeriveError, match="the equilibria have several coordinates"):
        run_solve(loaded(tmp_path, text), Run())


@pytest.mark.parametrize("seeded", ["stable", "place", "missing"])
def test_a_wrong_branch_is_refused(tmp_path: Path, seeded: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.stock.answering import diagrams

    right = diagrams.Parameter.branch

    def wrong(self: diagrams.Parameter, branch: diagrams.Branch) -> diagrams.Branch:
        found = right(self, branch)
        if branch.key != "rest_3":
            return found
        if seeded == "missing":
            return replace(found, place=Integer(0))
        return replace(found, stable=False) if seeded == "stable" else replace(found, place=found.place / 2)

    monkeypatch.setattr(diagrams.Parameter, "branch", wrong)
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, HOOP), "trial/one", only=("text",))
    said = {"stable": "the potential energy has a minimum there", "place": "is not stationary", "missing": "4 zeros"}
    assert any(said[seeded] in each.message for each in refused.value.complaints), refused.value


def test_the_stored_steps_depend_on_the_parameter(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    first, again = (rendered(course_with(tmp_path, MOTOR), "trial/one", None, cache, only={"text"}) for _ in range(2))
    assert first.texts["text"] == again.texts["text"]
    other = edited(MOTOR, ("C/(m*g*l)", "2*C/(m*g*l)"), ("[0, 1.5]", "[0, 3]"))
    assert "= 2.]" in " ".join(
        rendered(course_with(tmp_path, other), "trial/one", None, cache, only={"text"}).texts["text"].split()
    )
