"""Many draws of variants: the values, the degenerate draws, and the comparison with a derivation from the beginning."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from derive.building import variant_check
from derive.building.variant_check import checked
from derive.course.variants import chosen_for
from derive.errors import Rejected
from tests.course.test_variants import bead


def test_the_values_are_those_of_the_formula(tmp_path: Path) -> None:
    """sqrt(g/b), worked out here from the text of each choice."""
    variations = bead(tmp_path, "{b: 10..30 cm in steps of 1}").variations
    found = checked(tmp_path, "week1/bead", 50, "x")
    lengths = [chosen_for("week1", "bead", variations, str(n), "x")["b"] + 10 for n in range(1, 51)]
    expected = [math.sqrt(9.81 / (b / 100)) for b in lengths]
    assert found.answers["frequency"].values == pytest.approx(expected)
    assert (found.answers["frequency"].unit, found.possible, found.structures) == ("rad/s", 21, 1)
    assert found.compared == 3
    assert not found.complaints
    assert found.same == sum(lengths.count(b) * (lengths.count(b) - 1) // 2 for b in set(lengths))
    assert found.equal == {"frequency": 0}


def test_each_structure_is_derived_for_itself(tmp_path: Path) -> None:
    bead(tmp_path, "{particles.bead.at: [[x, x**2/(2*b)], [x, x**2/b]]}")
    found = checked(tmp_path, "week1/bead", 12, "")
    assert found.structures == 2
    frequency = math.sqrt(9.81 / 0.2)
    assert {round(value, 6) for value in found.answers["frequency"].values} == {
        round(frequency, 6),
        round(math.sqrt(2) * frequency, 6),
    }


def test_structures_with_different_outcomes_are_told_apart(tmp_path: Path) -> None:
    """On the arch y = -x^2/(2 b) the bead does not oscillate."""
    bead(tmp_path, "{particles.bead.at: [[x, x**2/(2*b)], [x, -x**2/(2*b)]]}")
    found = checked(tmp_path, "week1/bead", 12, "")
    assert len(found.outcomes["frequency"]) == 2
    assert sum(found.outcomes["frequency"].values()) == 12


def test_draws_without_a_real_value_are_degenerate(tmp_path: Path) -> None:
    """The bead is at x = b in the answer sqrt(b^2 - c^2), which is not real for b < c."""
    bead(tmp_path, "{b: [20 cm, 30 cm]}")
    file = tmp_path / "problems" / "week1" / "bead.yaml"
    text = file.read_text().replace("b: length}", "b: length, c: length}").replace("{b: 20 cm,", "{b: 20 cm, c: 25 cm,")
    text = text.replace("  gravity: g\n", "  gravity: g\n  results: {width: {value: sqrt(b**2 - c**2)}}\n")
    file.write_text(
        text.replace("with <<b>>", "with <<b>> and <<c>>").replace(
            "answer: frequency\n    form: {unit: rad/s}", "answer: width"
        )
    )
    found = checked(tmp_path, "week1/bead", 12, "")
    assert found.degenerate.keys() == {"`width` is not real"}
    assert set(found.degenerate["`width` is not real"]) == {"b = 20 cm"}
    assert len(found.degenerate["`width` is not real"]) + len(found.answers["width"].values) == 12


def test_a_choice_with_a_wrong_unit_is_reported(tmp_path: Path) -> None:
    with pytest.raises(Rejected, match=r"`b` must be a length, but `3 s` is a time"):
        bead(tmp_path, "{b: [20 cm, 3 s]}")


def test_a_wrong_quick_value_is_detected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bead(tmp_path, "{b: 10..30 cm in steps of 1}")
    whole = variant_check._Structure.values
    wrong = lambda *given: {key: 1.01 * value for key, value in whole(*given).items()}  # noqa: E731
    monkeypatch.setattr(variant_check._Structure, "values", wrong)
    assert "but the page prints" in checked(tmp_path, "week1/bead", 3, "").complaints[0].message
