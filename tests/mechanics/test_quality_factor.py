"""The quality factor of a damped oscillator, in a script and under `results:`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from sympy import Rational, sqrt, symbols

from derive.algebra.equality import equal
from derive.building.solution import rendered
from derive.errors import Rejected, Unverified
from derive.mechanics import Coordinate, coordinate, quality_factor
from derive.mechanics.vibrations import driven
from tests.mechanics.test_answers import equation
from tests.stock.described import course_with, edited, messages, solved
from tests.test_phrases_used import variants

m, k, b, w = symbols("m k b w", positive=True)


def along() -> Coordinate:
    return coordinate("x", "length")


def oscillator(x: Coordinate, damping: Any, drive: Any = 0) -> Any:
    return equation(m * x.acceleration + damping * x.rate + k * x.symbol, drive, "motion")


@pytest.mark.parametrize(
    ("damping", "value", "outcome"),
    [
        (b, sqrt(k * m) / b, "depends"),
        (sqrt(k * m) / 10, 10, "oscillates"),
        (2 * sqrt(k * m), Rational(1, 2), "critical"),
        (5 * sqrt(k * m), Rational(1, 5), "creeps"),
    ],
)
def test_the_quality_factor_is_that_of_the_textbooks(damping: Any, value: Any, outcome: str) -> None:
    """Taylor, equation 5.81: Q = omega_0/(2 beta) with omega_0^2 = k/m and 2 beta = b/m."""
    x = along()
    found = quality_factor(oscillator(x, damping), x)
    assert equal(found.value, value)
    assert found.step.outcome == outcome


def test_a_driving_force_and_the_signs_of_the_equation_change_nothing() -> None:
    x = along()
    turned = equation(-m * x.acceleration - b * x.rate - k * x.symbol, m * w, "motion")
    assert equal(quality_factor(turned, x).value, sqrt(k * m) / b)


@pytest.mark.parametrize("law", [lambda *parts: 2 * parts[0] / parts[1], lambda *parts: parts[1] / parts[0]])
def test_a_wrong_law_is_refused(law: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driven, "Ratio", law)
    x = along()
    with pytest.raises(Unverified, match="`resonance` disagrees"):
        quality_factor(oscillator(x, b), x)


@pytest.mark.parametrize(
    ("left", "said"),
    [
        (lambda x: m * x.acceleration + k * x.symbol, "the damping in"),
        (lambda x: m * x.acceleration + b * x.rate - k * x.symbol, "the restoring force in"),
        (lambda x: m * x.acceleration + b * x.rate**2 + k * x.symbol, "constant coefficients"),
    ],
)
def test_what_has_no_quality_factor_is_refused(left: Any, said: str) -> None:
    x = along()
    with pytest.raises(Rejected, match=said):
        quality_factor(equation(left(x), 0, "motion"), x)


def test_a_file_asks_for_it_by_its_name(tmp_path: Path) -> None:
    found = solved(tmp_path, variants()["quality"])
    assert equal(found["of_the_cart"].value, sqrt(k * m) / b)
    assert equal(found["light"].value, 5)
    wrong = variants()["quality"].replace("for: x}", "for: x, start: 0}", 1)
    assert any("`start` has no effect on `quality_factor`" in each for each in messages(tmp_path / "wrong", wrong))


def test_an_assumption_decides_whether_the_oscillator_oscillates(tmp_path: Path) -> None:
    assuming = edited(variants()["quality"], ("\n  results:", "\n  assume: [b**2 < 4*k*m]\n  results:"))
    assert solved(tmp_path, assuming)["of_the_cart"].step.outcome == "oscillates"


def test_the_condition_of_oscillation_is_no_part_of_the_formula(tmp_path: Path) -> None:
    text = " ".join(
        rendered(course_with(tmp_path, variants()["quality"]), "trial/one", only={"text"}).texts["text"].split()
    )
    before, after = text.split(", * Q = √(k m)/b", 1)
    assert before.endswith("constant force of the same size")
    assert "oscillates if this quality factor is greater than one half." in after
