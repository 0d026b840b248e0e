"""A problem opened in a notebook: its answers and drawings, and the error for a key that it does not have."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building import solution
from derive.errors import Misused
from derive.notebook import Opened, open_problem
from tests.courses import course_in


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Opened:
    return open_problem("hw9/block", course_in(tmp_path_factory.mktemp("course")))


def test_it_lists_its_answers(block: Opened) -> None:
    assert {"inertia_tensor", "kinetic_energy", "torque"} <= {*block.answers}
    assert repr(block).startswith("hw9/block: inertia_tensor, ")


def test_an_answer_is_an_expression_and_is_shown_as_a_formula(block: Opened) -> None:
    energy = block.answer("kinetic_energy")
    letters = {str(letter): letter for letter in energy.value.free_symbols}
    M, a, *rates = (letters[name] for name in ("M", "a", "omega_x", "omega_y", "omega_z"))
    wanted = M * a**2 * sum(n * rate**2 for n, rate in zip((13, 10, 5), rates, strict=True)) / 24
    assert (energy.value - wanted).expand() == 0
    assert energy._repr_latex_().startswith(r"$\displaystyle T=\frac{1}{24}\,Ma^{2}")
    assert repr(energy).startswith("T = 1/24 M a² (13")
    assert energy.grade == "proved"


def test_an_answer_has_its_number(block: Opened) -> None:
    assert block.answer("angle_between").number == "21.64 degree"
    assert repr(block.answer("angle_between")).endswith("≈ 21.64°")


def test_a_drawing_is_shown_as_svg(block: Opened) -> None:
    assert block.drawing("vectors")._repr_svg_().startswith("<svg")


def test_it_is_derived_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[object] = []
    run = solution.run_solve
    monkeypatch.setattr(solution, "run_solve", lambda *of: (runs.append(of), run(*of))[1])
    block = open_problem("hw9/block", course_in(tmp_path))
    assert block.drawing("vectors") and block.drawing("axes") and block.answers
    assert len(runs) == 1


def test_what_it_does_not_have_is_told(block: Opened, tmp_path: Path) -> None:
    with pytest.raises(Misused, match="no step is called `torqe`") as step:
        block.answer("torqe")
    assert "torque" in step.value.complaints[0].help
    with pytest.raises(Misused, match="no drawing is called `vector`") as drawing:
        block.drawing("vector")
    assert "vectors" in drawing.value.complaints[0].help
    with pytest.raises(Misused, match="no folder `problems` was found"):
        open_problem("hw9/block", tmp_path)
