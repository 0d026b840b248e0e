"""Curves of answers of a described system: `plot` under `drawings:`."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Symbol, cos, pi, sin

from derive.building.cache import Cache
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.figures.marks import Plot
from derive.steps.record import Run
from tests.courses import ROOT
from tests.stock.described import course_with, edited, loaded, messages

HOOP = (ROOT / "problems" / "library" / "constraints" / "turning_hoop.yaml").read_text(encoding="utf-8")

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
    assert (curve.variable, curve.lower, curve.upper) == (Symbol("theta", real=True), -2 * pi / 3, 2 * pi / 3)
    assert (curve.of, curve.kind) == ("angle", "energy")


def test_a_plot_that_is_added_after_a_build_is_drawn(tmp_path: Path) -> None:
    """The stored derivation of the same problem without the plot is not used."""
    cache = Cache(tmp_path / "cache")
    first = rendered(course_with(tmp_path, PENDULUM), "trial/one", None, cache, only={"json"})
    assert '"energy"' not in first.texts["json"]
    drawn = f"{PENDULUM}drawings: {{energy: {{plot: potential_energy, against: theta, range: [0 deg, 90 deg]}}}}\n"
    second = rendered(course_with(tmp_path, drawn), "trial/one", None, cache, only={"json"})
    assert '"key": "energy"' in second.texts["json"]


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ([("    against: theta\n", "")], "needs `against`"),
        ([("    range: [-120 deg, 120 deg]\n", "")], "needs `against`, a letter, and `range`"),
        ([("    against: theta\n", "    against: phi\n")], "does not depend on `phi`"),
        ([("    plot: effective_potential\n", "")], "`against` has no effect without `plot`"),
        ([("    plot: effective_potential\n", "    plot: equilibria\n")], "is several results"),
        ([("    plot: effective_potential\n", "    plot: effective\n")], "`effective`"),
    ],
)
def test_a_mistake_is_reported(tmp_path: Path, edits: list[tuple[str, str]], said: str) -> None:
    assert any(said in each for each in messages(tmp_path, edited(HOOP, *edits)))


DAMPED = (ROOT / "problems" / "library" / "oscillations" / "damped_oscillator.yaml").read_text(encoding="utf-8")


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
    curve = f"drawings:\n  curve: {{plot: weak, against: t, range: [0 s, 9 s], at: b, cases: {numbers}}}\n"
    try:
        rendered(course_with(tmp_path, edited(DAMPED, ("note: >\n", f"{curve}note: >\n"))), "trial/one", only=("text",))
        found = ""
    except DeriveError as error:
        (found,) = [each.message for each in error.complaints]
    expected = f"the numbers of {said} do not satisfy beta < omega_0, on which its result depends"
    assert found == (expected if said else "")


SLOW = "      - {R: 1 m, m: 1 kg, g: 9.8 m/s^2, omega: 2 rad/s}\n"
FAST = "      - {omega: 4 rad/s}\n"


@pytest.mark.parametrize(
    ("edits", "line", "said", "helped"),
    [
        (
            [("    cases:\n" + SLOW + FAST, "    values: {R: 1 m}\n"), (", <<cases>>", "")],
            51,
            "`values` has no effect on the plot `energy`",
            "",
        ),
        (
            [("    cases:\n" + SLOW + FAST, ""), (", <<cases>>", "")],
            45,
            "needs a number for `R`, `g`, `m`, `omega`",
            "under the `values` of the problem, or under the `cases` of the drawing",
        ),
        ([(FAST, "      - {omega: 4 rad/s, theta: 10 deg}\n")], 53, "`theta` varies along the horizontal axis", ""),
        ([(FAST, "      - {omega: 2 rad/s}\n")], 53, "case ii of the plot `energy` is the same as case i", ""),
        ([(FAST, "      - {omega: 2.0 rad/s}\n")], 53, "case ii of the plot `energy` is the same as case i", ""),
        (
            [("    at: c\n", "    at: d\n")],
            35,
            "no plot in part c has `cases`",
            "the plot `energy` is in part d: mention `<<cases>>` there, or move the plot with `at: c`",
        ),
        ([("symbols: {R: length,", "symbols: {R: length, M: mass,"), (SLOW, SLOW.replace("{R", "{M: 1 kg, R"))], 52,
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
