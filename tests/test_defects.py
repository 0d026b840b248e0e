"""Pages that were once wrong but graded as proved: each is now right, or refused with its cause."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from sympy import Symbol, cos, sin, symbols

from derive.algebra.equality import Compared, equal
from derive.algebra.expressions import TIME, Relation
from derive.building.solution import rendered
from derive.course.problem import load_problem
from derive.errors import DeriveError
from derive.steps.record import recorded
from derive.steps.step import Quantity
from tests.courses import PINNED, ROOT

DEFECTS = ROOT / "tests" / "defects"


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("defects")
    problems = folder / "problems" / "defects"
    problems.mkdir(parents=True)
    (folder / "templates").symlink_to(ROOT / "templates")
    names = sorted(file.stem for file in DEFECTS.glob("*.yaml"))
    for file in [*DEFECTS.glob("*.yaml"), *DEFECTS.glob("*.py"), PINNED / "block.py"]:
        (problems / file.name).write_text(file.read_text(encoding="utf-8"), encoding="utf-8")
    (problems / "set.yaml").write_text(f"course: Mechanics\ntitle: Defects\nproblems: [{', '.join(names)}]\n")
    return folder


@cache
def page(folder: Path, name: str) -> str:
    return rendered(folder, f"defects/{name}", only={"text"}).texts["text"]


@cache
def steps(folder: Path, name: str) -> dict[str, Quantity]:
    problem = load_problem(folder, f"defects/{name}")
    with recorded() as run:
        problem.script.solve(**{given.name: given.value for given in problem.givens})
    return {quantity.key: quantity for quantity in run.established}


@pytest.mark.parametrize(
    ("name", "code", "line"),
    [
        ("pendulum-end-moment", "wrong-point", "`moment_of_inertia` is about the end"),
        ("rate-with-time", "changes", "`spin` depends on the time t"),
        ("top-centre-moments", "wrong-point", "`across` is about the centre of mass"),
        ("torque-of-changing-omega", "changes", "depends on omega_x"),
    ],
)
def test_a_question_that_does_not_fit_is_refused_at_its_line(course: Path, name: str, code: str, line: str) -> None:
    with pytest.raises(DeriveError) as refusal:
        rendered(course, f"defects/{name}")
    (complaint,) = refusal.value.complaints
    assert complaint.code == code
    assert line in complaint.message
    assert complaint.place is not None
    assert complaint.place.path in {f"problems/defects/{name}.py", "problems/defects/block.py"}


def test_a_pendulum_that_grows_has_the_term_of_its_growth(course: Path) -> None:
    m, l, v, g = symbols("m l v g", positive=True)
    theta, rate, acceleration = (Symbol(f"theta{dots}", real=True) for dots in ("", "_dot", "_ddot"))
    grown = l + v * TIME
    by_hand = m * grown**2 * acceleration + 2 * m * v * grown * rate + m * g * grown * sin(theta)
    assert equal(steps(course, "growing-pendulum")["equation_of_motion"].value, Relation(by_hand, "=", 0))
    assert "2v (l + v t) θ̇" in page(course, "growing-pendulum")


def test_a_hoop_has_half_its_axial_moment_across(course: Path) -> None:
    tensor = steps(course, "hoop")["inertia_tensor"].value
    assert tensor[0, 0] * 2 == tensor[1, 1] * 2 == tensor[2, 2]
    assert "M R²" in page(course, "hoop")


def test_a_negative_rate_stands_in_brackets(course: Path) -> None:
    text = page(course, "minus-omega")
    assert "(-ω/√14 (1, 2, 3))" in text
    assert "⎥ -ω" not in text
    assert "·-" not in text


def test_a_period_by_let_has_its_unit_and_is_called_a_definition(course: Path) -> None:
    text = page(course, "period-without-unit")
    assert "Write\n\n    τ = 2π/ω_0 = " in text
    assert "≈ 1.532 s " in text
    assert {e.compared for e in steps(course, "period-without-unit")["period"].step.evidence} == {
        Compared.NOTHING,
        Compared.LINES,
    }


def test_what_is_named_in_a_coordinate_moves_with_it(course: Path) -> None:
    found = steps(course, "rate-of-let")
    theta, rate = symbols("theta theta_dot", real=True)
    assert found["cosine"].value == cos(theta)
    assert found["cosine_rate"].value == -rate * sin(theta)
    assert "does not change" not in page(course, "rate-of-let")
