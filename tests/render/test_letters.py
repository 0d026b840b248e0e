"""A printed symbol has one meaning."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Symbol

from derive.building.solution import derived
from derive.course.problem import load_problem, run_solve
from derive.errors import Complaint, Rejected
from derive.render.notation.letters import as_printed, letter_clashes, letters_in_use
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.step import Quantity
from tests.courses import course_in

Known = dict[str, Quantity]


def known_of(name: str, folder: Path) -> Known:
    problem = load_problem(course_in(folder, problem=name), f"hw9/{name}")
    return with_ancestors(returned_quantities(run_solve(problem)))


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known_of("block", tmp_path_factory.mktemp("block"))


@pytest.fixture(scope="module")
def cone(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known_of("cone", tmp_path_factory.mktemp("cone"))


@pytest.fixture(scope="module")
def slab(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known_of("slab", tmp_path_factory.mktemp("slab"))


def clashes(folder: Path, name: str, known: Known, edits: dict[str, str]) -> list[Complaint]:
    return letter_clashes(load_problem(course_in(folder, edits, problem=name), f"hw9/{name}"), known)


def called(letter: str) -> dict[str, str]:
    return {"M: mass": f"{letter}: mass", "mass: M": f"mass: {letter}"}


@pytest.mark.parametrize(
    ("letter", "why"),
    [
        ("theta", "the step `angle_between` also uses this symbol for its result"),
        ("omega_x", "it is a component of `omega`"),
        ("L_y", "it is a component of `L`"),
        ("I_yx", "it is an entry of `I`"),
        ("z_C", "but `r_C_z` looks the same in print: "),
        ("rho", "the step `density` also uses this symbol for its result"),
    ],
)
def test_a_letter_that_a_step_brings_in_is_not_free(letter: str, why: str, block: Known, tmp_path: Path) -> None:
    (complaint,) = clashes(tmp_path, "block", block, called(letter))
    assert (complaint.code, complaint.help) == ("letter-clash", "use another symbol")
    assert why in complaint.message
    assert complaint.place
    assert complaint.place.text[complaint.place.column - 1 :].startswith(f"{letter}: mass")


@pytest.mark.parametrize("letter", ["M", "I", "J", "m", "I_0", "L", "omega", "lambda_1"])
def test_a_letter_that_looks_otherwise_is_free(letter: str, block: Known, tmp_path: Path) -> None:
    edits = called(letter) if letter not in ("M", "omega") else {}
    assert clashes(tmp_path, "block", block, edits) == []


@pytest.mark.parametrize(
    ("letter", "why"),
    [
        ("phi", "integrates over it"),
        ("I_1", "`principal_moments` also uses this symbol for its result"),
        ("z_C", "`r_C_z`"),
    ],
)
def test_a_letter_of_integration_is_not_free_either(letter: str, why: str, cone: Known, tmp_path: Path) -> None:
    (complaint,) = clashes(tmp_path, "cone", cone, called(letter))
    assert why in complaint.message


def test_a_coordinate_and_its_rates_are_no_letters_of_the_problem(slab: Known, tmp_path: Path) -> None:
    for n, (letter, why) in enumerate(
        [("theta", "a coordinate has the same name"), ("theta_ddot", "a rate of the coordinate `theta`")]
    ):
        edits = {"I: moment of inertia": f"{letter}: moment of inertia", "inertia: I ": f"inertia: {letter} "}
        (complaint,) = clashes(tmp_path / str(n), "slab", slab, edits)
        assert why in complaint.message


def test_a_letter_that_is_only_declared_stands_for_nothing(slab: Known, tmp_path: Path) -> None:
    assert clashes(tmp_path, "slab", slab, {"g: acceleration}": "g: acceleration, theta: angle, N: force}"}) == []


def test_a_letter_that_has_only_a_number_is_in_use(slab: Known, tmp_path: Path) -> None:
    edits = {"g: acceleration}": "g: acceleration, N: force}\nvalues: {N: 2 N}"}
    (complaint,) = clashes(tmp_path, "slab", slab, edits)
    assert "the step `normal_force` also uses this symbol for its result" in complaint.message


def test_a_letter_chosen_for_a_number_is_told_at_the_number(slab: Known, tmp_path: Path) -> None:
    edits = {
        "R: length, ": "",
        "radius: R\n": "radius: 40 cm\n",
        "a: length": "l: length",
        "thickness: a": "thickness: l",
    }
    problem = load_problem(course_in(tmp_path, edits, problem="slab"), "hw9/slab")
    assert Symbol("l", real=True, positive=True) in letters_in_use(problem)
    assert letter_clashes(problem, slab) == []


def test_letters_of_the_problem_that_look_alike_are_told(block: Known, tmp_path: Path) -> None:
    edits = {"{a: length": "{b_1_2: length, b_12: length", "[a, 2*a, 3*a]": "[b_1_2, b_12, b_12]"}
    (complaint,) = clashes(tmp_path, "block", block, edits)
    assert complaint.message == "`b_1_2` and `b_12` look the same in print"


def test_what_is_compared_is_what_is_printed() -> None:
    assert as_printed(Symbol("z_C")) == as_printed(Symbol("r_C_z"))
    assert as_printed(Symbol("omega_x")) != as_printed(Symbol("omega_y"))


def test_a_coordinate_is_no_variable_of_integration(tmp_path: Path) -> None:
    named = "    phi, theta, psi = euler_angles()\n"
    late = {named: "", "    axes = space": f"{named}    axes = space"}
    problem = load_problem(course_in(tmp_path, problem="top", script=late), "hw9/top")
    with pytest.raises(Rejected, match="`phi` is a coordinate, but the step `disc_moment_z` integrates over"):
        derived(problem)
