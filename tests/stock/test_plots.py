"""Curves of answers of a described system: `plot` under `drawings:`."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Symbol, cos, pi, sin

from derive.course.problem import run_solve
from derive.figures.marks import Plot
from derive.steps.record import Run
from tests.courses import ROOT
from tests.stock.described import edited, loaded, messages

HOOP = (ROOT / "problems" / "library" / "constraints" / "turning_hoop.yaml").read_text(encoding="utf-8")


def test_the_curve_of_an_answer_is_drawn(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, HOOP), run)
    (curve,) = (each for each in run.drawings if isinstance(each, Plot))
    letters = {symbol.name: symbol for symbol in curve.expr.free_symbols}
    m, g, R, omega, theta = (letters[name] for name in ("m", "g", "R", "omega", "theta"))
    assert (curve.expr + m * g * R * cos(theta) + m * R**2 * omega**2 * sin(theta) ** 2 / 2).expand() == 0
    assert (curve.variable, curve.lower, curve.upper) == (Symbol("theta", real=True), -2 * pi / 3, 2 * pi / 3)
    assert (curve.of, curve.kind) == ("angle", "energy")


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
