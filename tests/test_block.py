"""Test the block problem and edits of its YAML by an instructor: givens -> answers, words, numbers.

The expected values are those of textbooks or computed by hand; none is copied from the output of the program.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import pytest
from sympy import Matrix, Rational, acos, cos, diag, simplify, sqrt, symbols
from sympy import sympify as sympy_reads  # the tests read the JSON as any other program would

from derive.errors import DeriveError, Rejected
from derive.render.rendered import Rendered
from tests.courses import course_in, rendered_once

a, b, c, M, omega = symbols("a b c M omega")
x, y, z = symbols("omega_x omega_y omega_z")


def solved(
    folder: Path,
    edits: dict[str, str] | None = None,
    detail: str | None = None,
    only: Collection[str] | None = ("json", "text"),
) -> Rendered:
    return rendered_once(course_in(folder, edits), "hw9/block", detail, only=only)


def answers(solution: Rendered) -> dict[str, Any]:
    return {key: sympy_reads(answer["sympy"]) for key, answer in json.loads(solution.texts["json"])["answers"].items()}


def numbers(solution: Rendered) -> dict[str, Any]:
    return {key: answer["number"] for key, answer in json.loads(solution.texts["json"])["answers"].items()}


def flat(solution: Rendered) -> str:
    """Return the page as one line, so that line breaks within sentences do not matter."""
    return " ".join(solution.texts["text"].split())


def outcomes(solution: Rendered) -> dict[str, str]:
    return {step["key"]: step["outcome"] for step in json.loads(solution.texts["json"])["steps"]}


def same(left: Any, right: Any) -> bool:
    difference = simplify(left - right)
    return bool(difference == 0 * difference)


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Rendered:
    return solved(tmp_path_factory.mktemp("block"), only=None)


def test_the_answers_are_those_of_the_books(block: Rendered) -> None:
    found = answers(block)
    assert same(found["inertia_tensor"], M * a**2 / 12 * diag(13, 10, 5))
    assert same(found["kinetic_energy"], M * a**2 / 24 * (13 * x**2 + 10 * y**2 + 5 * z**2))
    assert same(found["kinetic_energy_about_axis"], Rational(7, 24) * M * a**2 * omega**2)
    assert same(found["cosine"], 7 * sqrt(2779) / 397)
    assert same(cos(found["angle_between"]), 7 * sqrt(2779) / 397)
    assert same(found["torque"], M * a**2 * omega**2 / 28 * Matrix([-5, 4, -1]))
    assert same(found["magnitude"], sqrt(42) / 28 * M * a**2 * omega**2)


def test_the_angle_is_rounded_once_and_in_degrees(block: Rendered) -> None:
    assert numbers(block)["cosine"]["text"] == "0.92951"
    assert numbers(block)["angle_between"] == {"value": 21.64, "unit": "degree", "figures": 4, "text": "21.64 degree"}
    assert "≈ 21.64°" in block.texts["text"]
    assert r"\approx 21.64{}^\circ" in block.latex or r"21.64\mathrm{{}^\circ}" in block.latex


def test_symbolic_answers_have_no_number_and_roots_are_not_rounded(block: Rendered) -> None:
    assert numbers(block)["magnitude"] is None
    assert "√42/28 M a² ω²" in block.texts["text"] and "0.2315" not in block.texts["text"]


def test_all_six_integrals_are_written_out(block: Rendered) -> None:
    for entry in ("xx", "yy", "zz", "xy", "xz", "yz"):
        assert f"J_{entry} = " in block.texts["text"]
        assert f"I_{entry} = J_{entry}" in block.texts["text"]
    assert "[y³/3](0..2a)" in block.texts["text"]


def test_nothing_is_merely_sampled(block: Rendered) -> None:
    assert block.grades["sampled"] == 0
    assert block.grades["proved"] > 100


@pytest.mark.parametrize(
    ("detail", "shown", "hidden"),
    [
        ("brief", ["I_xx = J_xx", "13/12 M a²"], ["[y³/3]", "6ρ a³"]),
        ("standard", ["[y³/3](0..2a)", "ρ (8a⁵ + 18a⁵) = 13/3 M a²", "ρ = M/(6a³)"], ["6ρ a³", "26ρ a⁵"]),
        ("full", ["[y³/3](0..2a)", "(6ρ a³)", "26ρ a⁵"], []),
    ],
)
def test_detail_chooses_how_much_algebra_is_shown(
    tmp_path: Path, detail: str, shown: list[str], hidden: list[str]
) -> None:
    text = solved(tmp_path, detail=detail).texts["text"]
    assert all(piece in text for piece in shown)
    assert not any(piece in text for piece in hidden)


def test_a_cube_needs_no_torque_and_the_words_say_so(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"[a, 2*a, 3*a]": "[a, a, a]"})
    found = answers(solution)
    assert same(found["inertia_tensor"], M * a**2 / 6 * diag(1, 1, 1))
    assert same(found["kinetic_energy_about_axis"], M * a**2 * omega**2 / 12)
    assert found["angle_between"] == 0
    assert found["torque"] == Matrix([0, 0, 0])
    assert found["magnitude"] == 0
    assert outcomes(solution)["inertia_tensor"] == "isotropic"
    assert outcomes(solution)["torque"] == "zero"
    assert "No torque about the centre is needed" in flat(solution)
    assert "bearings supply all" not in flat(solution)
    assert "not along" not in flat(solution)


def test_three_different_sides_give_the_general_formulas(tmp_path: Path) -> None:
    edits = {"[a, 2*a, 3*a]": "[a, b, c]", "{a: length,": "{a: length, b: length, c: length,"}
    solution = solved(tmp_path, edits)
    found = answers(solution)
    assert same(found["inertia_tensor"], M / 12 * diag(b**2 + c**2, a**2 + c**2, a**2 + b**2))
    square = a**2 + b**2 + c**2
    energy = M * omega**2 * (a**2 * b**2 + b**2 * c**2 + c**2 * a**2) / (12 * square)
    assert same(found["kinetic_energy_about_axis"], energy)
    direction = Matrix([b * c * (b**2 - c**2), c * a * (c**2 - a**2), a * b * (a**2 - b**2)])
    assert same(found["torque"], M * omega**2 / (12 * square) * direction)
    assert solution.grades["sampled"] == 0


def test_numbers_with_units_go_in_at_the_end(tmp_path: Path) -> None:
    edits = {"[a, 2*a, 3*a]": "[2 cm, 4 cm, 6 cm]", "mass: M\n": "mass: 1.5 kg\n", "rate: omega": "rate: 900 rpm"}
    solution = solved(tmp_path, edits)
    assert same(answers(solution)["kinetic_energy_about_axis"], Rational(7, 24) * M * a**2 * omega**2)
    found = numbers(solution)
    # by hand: omega = 30 pi = 94.248 rad/s; (7/24) 1.5 (0.02)^2 94.248^2 = 1.5544
    assert found["kinetic_energy_about_axis"] == {"value": 1.554, "unit": "J", "figures": 4, "text": "1.554 J"}
    assert found["magnitude"] == {"value": 1.234, "unit": "N m", "figures": 4, "text": "1.234 N m"}
    assert found["torque"]["value"] == [-0.9517, 0.7614, -0.1903]
    assert found["inertia_tensor"]["value"][0] == pytest.approx(6.5e-4)
    assert "M = 1.5 kg" in solution.texts["text"]
    assert "a = 2 cm = 0.02 m" in flat(solution)
    assert "ω = 900 rpm = 30π rad/s ≈ 94.25 rad/s" in flat(solution)
    assert "(1.5 kg) (0.02 m)² (30π rad/s)² * T ≈ 1.554 J" in flat(solution)


def test_incommensurable_numbers_keep_their_own_letters(tmp_path: Path) -> None:
    edits = {"[a, 2*a, 3*a]": "[3 cm, 4 cm, 5 cm]", "mass: M\n": "mass: 2 kg\n", "rate: omega": "rate: 10 rad/s"}
    solution = solved(tmp_path, edits)
    assert same(answers(solution)["inertia_tensor"][0, 0], M * (b**2 + c**2) / 12)
    assert "a = 3 cm, b = 4 cm and c = 5 cm" in flat(solution)
    # (2/12) (0.04^2 + 0.05^2) = 6.8333e-4
    assert numbers(solution)["inertia_tensor"]["value"][0] == pytest.approx(6.833e-4)


def test_a_negative_rate_turns_the_other_way(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"rate: omega": "rate: -omega"})
    assert same(answers(solution)["torque"], M * a**2 * omega**2 / 28 * Matrix([-5, 4, -1]))


def test_about_an_edge_the_angular_momentum_is_along_the_axis(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"axis: diagonal": "axis: z"})
    found = answers(solution)
    assert same(found["kinetic_energy_about_axis"], Rational(5, 24) * M * a**2 * omega**2)
    assert found["torque"] == Matrix([0, 0, 0])
    assert outcomes(solution)["angle_between"] == "parallel"
    assert "about an axis parallel to z" in flat(solution)
    assert "long diagonal" not in flat(solution)


def test_about_given_components_the_direction_is_normalised(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"axis: diagonal": "axis: [1, 1, 0]"})
    found = answers(solution)
    assert same(found["kinetic_energy_about_axis"], Rational(23, 48) * M * a**2 * omega**2)
    assert same(found["torque"], M * a**2 * omega**2 / 8 * Matrix([0, 0, -1]))
    assert same(found["angle_between"], acos(23 / sqrt(538)))


@pytest.mark.parametrize(("length", "mass"), [("s", "m"), ("S", "I"), ("E", "N"), ("beta", "gamma")])
def test_other_letters_also_those_that_sympy_claims(tmp_path: Path, length: str, mass: str) -> None:
    edits = {
        "[a, 2*a, 3*a]": f"[{length}, 2*{length}, 3*{length}]",
        "{a: length, M: mass,": f"{{{length}: length, {mass}: mass,",
        "mass: M\n": f"mass: {mass}\n",
    }
    solution = solved(tmp_path, edits)
    energy = answers(solution)["kinetic_energy_about_axis"]
    assert same(energy, Rational(7, 24) * symbols(mass) * symbols(length) ** 2 * omega**2)


def test_a_part_that_is_removed_takes_its_steps_and_no_others_away(tmp_path: Path) -> None:
    first = """  - ask: Find the inertia tensor about the centre.
    answer: inertia_tensor
    points: 3
"""
    solution = solved(tmp_path, {first: "", "points: 10": "points: 7"})
    assert "(a) Find the kinetic energy" in solution.texts["text"]
    assert "I_xx = J_xx" in solution.texts["text"], "the energy still rests on the tensor"


def test_parts_in_another_order_show_each_step_where_it_is_first_needed(tmp_path: Path) -> None:
    last = """  - ask: What torque must the bearings supply, and how large is it?
    answer: [torque, magnitude]
    points: 3
"""
    solution = solved(tmp_path, {last: "", "parts:\n": f"parts:\n{last}"})
    text = solution.texts["text"]
    assert text.index("(a) What torque") < text.index("L⃗ = I⃡ ω⃗") < text.index("(b) Find the inertia tensor")
    assert text.count("I_xx = J_xx") == 1


def test_points_appear_as_given(tmp_path: Path) -> None:
    solution = solved(
        tmp_path,
        {"points: 10\n": "", "    points: 2\n  - ask: Find the angle": "    points: 2.5\n  - ask: Find the angle"},
    )
    assert "[2.5 points]" in solution.texts["text"]
    assert "[10.5 points]" in solution.texts["text"]


def test_a_reworded_sentence_is_used_and_its_names_are_filled(tmp_path: Path) -> None:
    wording = "wording:\n  torque: The shaft must turn <<angular_momentum>> round, so <<chain>>\nparts:\n"
    solution = solved(tmp_path, {"parts:\n": wording})
    assert "The shaft must turn L⃗ round, so" in solution.texts["text"]
    assert "Take torques about the centre" not in solution.texts["text"]
    assert "τ⃗ = dL⃗/dt" in solution.texts["text"]


def test_wording_can_speak_to_one_outcome_only(tmp_path: Path) -> None:
    wording = "wording:\n  torque:\n    zero: Nothing to do. <<chain>>\nparts:\n"
    solution = solved(tmp_path, {"parts:\n": wording})
    assert "Nothing to do" not in solution.texts["text"]
    assert "Take torques about the centre" in solution.texts["text"]


@pytest.mark.parametrize(
    ("mode", "present", "absent"),
    [
        ("result", "r⃗_C = a/2 (1, 2, 3)", "r⃗_C = 1/M ∫"),
        ("hidden", "I_xx = J_xx", "By symmetry the centre of mass"),
    ],
)
def test_show_chooses_how_a_step_appears(tmp_path: Path, mode: str, present: str, absent: str) -> None:
    solution = solved(tmp_path, {"parts:\n": f"show: {{centre_of_mass: {mode}}}\nparts:\n"})
    assert present in solution.texts["text"]
    assert absent not in solution.texts["text"]


def test_show_full_opens_one_step_only(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"parts:\n": "show: {corner_tensor_xx: full}\nparts:\n"})
    assert "26ρ a⁵" in solution.texts["text"]
    assert "20ρ a⁵" not in solution.texts["text"]


def test_text_is_text_for_tex(tmp_path: Path) -> None:
    hostile = r"50% of_ # & \input{/etc/passwd} \write18{ls} ~ ^ \$x\$ { block"
    solution = solved(tmp_path, {"A uniform block": hostile}, only=None)
    assert r"\input{/etc" not in solution.latex
    assert r"\write18" not in solution.latex
    assert hostile.replace(r"\$", "$") in " ".join(solution.texts["text"].split())


def test_a_step_without_an_answer_is_warned_of(tmp_path: Path) -> None:
    course = course_in(
        tmp_path, script={"    return I,": '    kinetic_energy(I, omega, "T_2", "extra")\n    return I,'}
    )
    solution = rendered_once(course, "hw9/block")
    (warning,) = solution.warnings
    assert (warning.code, warning.place and warning.place.path) == ("not-shown", "problems/hw9/block.yaml")
    assert "`extra`" in warning.message
    assert warning.place is not None
    assert warning.place.text.startswith("solve:")


@pytest.mark.parametrize(
    ("sides", "declared", "axis"),
    [("[a, b, c]", "b: length, c: length, ", "[1, 1, 0]"), ("[a, a, b]", "b: length, ", "diagonal")],
)
def test_where_a_sign_is_not_known_the_size_is_an_absolute_value(
    tmp_path: Path, sides: str, declared: str, axis: str
) -> None:
    edits = {"[a, 2*a, 3*a]": sides, "{a: length,": f"{{a: length, {declared}", "axis: diagonal": f"axis: {axis}"}
    solution = solved(tmp_path, edits)
    assert "Abs" in json.loads(solution.texts["json"])["answers"]["magnitude"]["sympy"]
    assert solution.grades["sampled"] == 0
    assert "In general it is not parallel" in flat(solution)


def test_two_equal_moments_make_every_axis_in_their_plane_principal(tmp_path: Path) -> None:
    solution = solved(tmp_path, {"[a, 2*a, 3*a]": "[a, a, 2*a]", "axis: diagonal": "axis: [1, 2, 0]"})
    assert outcomes(solution)["inertia_tensor"] == "two_equal"
    assert answers(solution)["torque"] == Matrix([0, 0, 0])


def with_sides_of(letter: str) -> dict[str, str]:
    return {"[a, 2*a, 3*a]": f"[{letter}, 2*{letter}, 3*{letter}]", "{a: length,": f"{{{letter}: length,"}


@pytest.mark.parametrize(
    ("letter", "key"), [("rho", "density"), pytest.param("T", "kinetic_energy", marks=pytest.mark.long)]
)
def test_a_result_has_another_letter_where_the_problem_has_its_own(tmp_path: Path, letter: str, key: str) -> None:
    page = json.loads(solved(tmp_path, with_sides_of(letter)).texts["json"])
    (symbol,) = (step["symbol"]["sympy"] for step in page["steps"] if step["key"] == key)
    assert symbol != letter


def test_a_letter_that_a_step_uses_for_its_result_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Rejected, match="letter-clash"):
        solved(tmp_path, with_sides_of("theta"))


@pytest.mark.parametrize(
    ("written", "instead", "code"),
    [
        ("torque(omega, L)", "torque(L, omega)", "wrong-argument"),
        ("angular_momentum(I, omega)", "angular_momentum(omega, I)", "wrong-argument"),
        ("angular_momentum(I, omega)", "angular_momentum(J, omega)", "wrong-point"),
        ("kinetic_energy(I, any", "kinetic_energy(J, any", "wrong-point"),
        ("spin(rate,", "spin(mass,", "dimension"),
        ("magnitude(tau)\n", "3\n", "script"),
        ("return I,", "return I * 2,", "plain-arithmetic"),
    ],
)
def test_a_slip_in_a_script_is_refused_and_not_printed_as_proved(
    tmp_path: Path, written: str, instead: str, code: str
) -> None:
    course = course_in(tmp_path, script={written: instead})
    with pytest.raises(DeriveError) as refused:
        rendered_once(course, "hw9/block")
    assert [complaint.code for complaint in refused.value.complaints] == [code]
    assert refused.value.complaints[0].place is not None


def test_about_a_corner_that_stays_at_rest_the_words_and_the_numbers_follow(tmp_path: Path) -> None:
    script = {
        "any_angular_velocity()": 'any_angular_velocity(through="corner")',
        "along=block.direction(axis))": 'along=block.direction(axis), through="corner")',
        "kinetic_energy(I, any": "kinetic_energy(J, any",
        "angular_momentum(I, omega)": "angular_momentum(J, omega)",
    }
    solution = rendered_once(course_in(tmp_path, {"axis: diagonal": "axis: z"}, script), "hw9/block")
    assert "Since the corner is at rest" in flat(solution)
    assert "the weight included" in flat(solution)
    # J_zz = 5/3 M a^2
    assert same(answers(solution)["kinetic_energy_about_axis"], Rational(5, 6) * M * a**2 * omega**2)


@pytest.mark.parametrize("title", ["A \U0001f9ca block", "\u041a\u0443\u0431"])
def test_what_the_page_cannot_print_is_named_where_it_stands(tmp_path: Path, title: str) -> None:
    with pytest.raises(Rejected, match=r"block.yaml:1:[0-9]+: error.character"):
        solved(tmp_path, {"title: A block": f"title: {title}"})


def test_a_note_stands_after_the_last_part_and_may_name_what_was_derived(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    with open(root / "problems" / "hw9" / "block.yaml", "a", encoding="utf-8") as file:
        file.write("note: Real bearings carry <<magnitude>> at every turn, by <<eq torque>>.\n")
    solution = rendered_once(root, "hw9/block")
    text = flat(solution)
    assert text.index("Real bearings carry |τ⃗| at every turn, by (") > text.index("√42/28 M a² ω²")
    assert "Real bearings carry" in solution.latex
    assert "Real bearings carry" not in solution.sheet
