"""The problems that `make bench` times are complete: each loads without a warning, and those of any size derive."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from bench.problems import (
    FOLDER,
    GROWING,
    ORDINALS,
    REFUSED,
    body_of_parts,
    chain_of_rods,
    growth,
    is_refused,
    timed_problems,
)
from derive.building.solution import rendered
from derive.course.problem import load_problem

WRITTEN = sorted(file.stem for file in FOLDER.glob("*.yaml") if file.stem != "set")


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("timed")
    timed_problems(root)
    (root / "problems" / "timed" / "chain.yaml").write_text(chain_of_rods(2))
    (root / "problems" / "timed" / "body.yaml").write_text(body_of_parts(4))
    return root


def test_every_problem_that_is_written_or_described_is_timed(tmp_path: Path) -> None:
    described = [f"{name}_{n}" for name, (_, sizes, _) in GROWING.items() for n in sizes]
    assert timed_problems(tmp_path) == sorted([*WRITTEN, *described])
    assert {*WRITTEN} > REFUSED
    assert max(n for _, sizes, _ in GROWING.values() for n in sizes) <= len({*ORDINALS})


def test_the_set_names_every_problem_that_is_written() -> None:
    assert sorted(re.findall(r"^  - (\w+)$", (FOLDER / "set.yaml").read_text(), re.MULTILINE)) == WRITTEN


@pytest.mark.parametrize("name", [*WRITTEN, *(f"{name}_{max(sizes)}" for name, (_, sizes, _) in GROWING.items())])
def test_a_timed_problem_loads_without_a_warning(course: Path, name: str) -> None:
    assert load_problem(course, f"timed/{name}").warnings == ()


@pytest.mark.parametrize("name", ["chain", pytest.param("body", marks=pytest.mark.long)])
def test_a_problem_of_any_size_is_derived_without_a_warning(course: Path, name: str) -> None:
    page = rendered(course, f"timed/{name}", only=("text",))
    assert page.warnings == ()
    assert page.steps > 0


def test_a_refusal_is_told_from_a_derivation_and_from_other_errors(course: Path) -> None:
    (name,) = REFUSED
    assert is_refused(course, name)
    assert not is_refused(course, "chain")


def test_a_time_that_grows_with_the_cube_has_the_exponent_three() -> None:
    assert growth((4, 8), [0.5, 4.0]) == pytest.approx(3)
