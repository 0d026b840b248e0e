"""What a document states against what is derived: every outcome, errata, the pinned given, the homework itself."""

from __future__ import annotations

import json
import re
import shutil
from collections import deque
from collections.abc import Mapping
from pathlib import Path

import pytest

from derive.algebra.equality import Grade, Verdict
from derive.cli.options import main
from derive.course.problem import Problem, load_problem, run_solve
from derive.course.reference import comparison
from derive.course.reference.comparison import comparisons
from derive.errors import Unverified
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.memory import Memory
from derive.steps.record import Run
from tests.course.reference.stated import HEAD, Compared, one
from tests.courses import ROOT, course_in, rendered_once

# -- agreement --------------------------------------------------------------------------------------------------------


def test_an_equal_form_agrees_and_says_how_we_know(compared: Compared) -> None:
    entry = one(compared("part: 2, answer: kinetic_energy_about_axis, states: 1/24*M*a**2*omega**2*(13 + 40 + 45)/14"))
    assert entry.facts() == {
        "problem": "hw9/block",
        "part": "2",
        "document": "",
        "line": None,
        "answer": "kinetic_energy_about_axis",
        "states": "1/24*M*a**2*omega**2*(13 + 40 + 45)/14",
        "outcome": "agrees",
        "grade": "proved",
        "detail": "identical",
        "remark": None,
    }
    assert entry.complaint is None


def test_every_side_of_a_chain_is_compared_and_counted(compared: Compared) -> None:
    chain = r"answer: corner_tensor_xx, latex: '26 a^5 \rho = \frac{26}{6} a^2 (6 a^3\rho) = \frac{13}{4} M a^2'"
    found = compared(chain)
    assert [entry.outcome for entry in found] == ["agrees", "agrees", "differs"]
    assert [entry.facts()["states"] for entry in found] == [
        r"26 a^5 \rho", r"\frac{26}{6} a^2 (6 a^3\rho)", r"\frac{13}{4} M a^2"
    ]  # fmt: skip
    complaint = found[2].complaint
    assert complaint is not None and complaint.place is not None
    assert complaint.place.text[complaint.place.column - 1 :].startswith(r"\frac{13}{4}")


def test_an_erratum_in_latex_has_what_is_right_in_latex(compared: Compared) -> None:
    slip = r"answer: inertia_tensor_zz, latex: '\frac{5}{13} M a^2'"
    entry = slip + r", erratum: {why: 13 for 12, right: '\frac{5}{12} M a^2'}"
    assert one(compared(entry)).outcome == "erratum"


def test_a_slip_may_be_wrong_in_its_dimension(compared: Compared) -> None:
    slip = r"answer: inertia_tensor_zz, latex: '\frac{5}{12} M a^2 + M'"
    entry = slip + r", erratum: {why: a slip, right: '\frac{5}{12} M a^2'}"
    assert one(compared(entry)).outcome == "erratum"


# -- errata and failures ----------------------------------------------------------------------------------------------

MOMENTUM = "answer: angular_momentum, states: [{}*M*a**2*omega_x, 10/12*M*a**2*omega_y, 5/12*M*a**2*omega_z]"
RIGHT = "[{}*M*a**2*omega_x, 5/6*M*a**2*omega_y, 5/12*M*a**2*omega_z]"


def test_an_erratum_keeps_the_point_that_proves_it(compared: Compared) -> None:
    erratum = f"erratum: {{why: 13/22 for 13/12, right: {RIGHT.format('13/12')}}}"
    found = one(compared(f"{MOMENTUM.format('13/22')}, {erratum}"))
    assert (found.outcome, found.grade, found.complaint) == ("erratum", "proved", None)
    assert found.detail.startswith("13/22 for 13/12: x: 0.682610 against 1.25145 at ")
    assert "M = " in found.detail


@pytest.mark.parametrize(
    ("stated", "right", "code"),
    [("13/12", "13/12", "no-erratum"), ("13/12", "13/22", "no-erratum"), ("13/22", "13/11", "differs")],
)
def test_an_erratum_that_is_none_fails(compared: Compared, stated: str, right: str, code: str) -> None:
    erratum = f"erratum: {{why: a slip, right: {RIGHT.format(right)}}}"
    found = one(compared(f"{MOMENTUM.format(stated)}, {erratum}"))
    assert found.outcome == "differs"
    assert found.complaint is not None
    assert found.complaint.code == code


def test_an_erratum_of_a_printed_decimal_is_proved_wrong_to_its_figures(compared: Compared) -> None:
    angle = "answer: angle_between, states: {}, in: degree, to: 4, erratum: {{why: digits swapped, right: 21.64}}"
    found = compared(angle.format("21.46"), angle.format("21.639"))
    assert [entry.outcome for entry in found] == ["erratum", "differs"]


def test_a_difference_is_told_at_its_line_with_both_values(compared: Compared) -> None:
    complaint = one(compared("answer: inertia_tensor_zz, states: 5/13*M*a**2")).complaint
    assert complaint is not None
    assert complaint.shown() == (
        "problems/hw9/reference.yaml:6:43: warning[differs]: "
        "`inertia_tensor_zz` differs from what the document states\n"
        "  6 |     - {answer: inertia_tensor_zz, states: 5/13*M*a**2}\n"
        "    |                                           ^^^^^^^^^^^\n"
        "    = derived: 5*M*a**2/12\n"
        "    = stated against derived: 2.80811 against 3.04212 at M = 73/35, a = 58/31"
    )


def test_an_unknown_step_is_a_failure_that_names_the_nearest(compared: Compared) -> None:
    found = one(compared("answer: inertia_tenser, states: 0"))
    assert (found.outcome, found.grade) == ("unknown step", None)
    assert found.complaint is not None
    assert found.complaint.help == "did you mean `inertia_tensor`?"


# -- what is pinned ---------------------------------------------------------------------------------------------------


def test_other_given_is_derived_again_and_once(compared: Compared, monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[str] = []

    def counted(problem: Problem, record: Run) -> object:
        runs.append(str(problem.givens[0].value))
        return run_solve(problem, record)

    monkeypatch.setattr("derive.course.reference.comparison.run_solve", counted)
    cube = HEAD.replace("[a, 2*a, 3*a]", "[a, a, a]")
    answer = "    - {answer: kinetic_energy_about_axis, states: M*a**2*omega**2/12}\n"
    same = "    - {answer: kinetic_energy_about_axis, states: 7/24*M*a**2*omega**2}\n"
    found = compared(whole=cube + answer + HEAD + same + cube + answer)
    assert [entry.outcome for entry in found] == ["agrees"] * 3
    assert runs == ["(a, a, a)"]


def test_a_pinned_given_that_cannot_be_derived_says_where_it_is_pinned(
    compared: Compared, monkeypatch: pytest.MonkeyPatch
) -> None:
    refused = HEAD.replace("[a, 2*a, 3*a]", "[a, a, a]") + "    - {answer: torque, states: 0}\n"
    monkeypatch.setattr("derive.steps.chain.equal", lambda *_: Verdict(Grade.REFUTED, "0 against 1"))
    with pytest.raises(Unverified) as caught:
        compared(whole=refused)
    assert "= this error is for the input at problems/hw9/reference.yaml:4" in str(caught.value)


EDITS: tuple[Mapping[str, str], ...] = (
    {"[a, 2*a, 3*a]": "[a, a, a]"},
    {"[a, 2*a, 3*a]": "[2 cm, 4 cm, 6 cm]", "mass: M": "mass: 1.5 kg", "rate: omega": "rate: 900 rpm"},
    {"axis: diagonal": "axis: z"},
    {"{a: length, M: mass": "{s: length, m: mass", "[a, 2*a, 3*a]": "[s, 2*s, 3*s]", "mass: M": "mass: m"},
)


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: ", ".join(edit.values()))
def test_the_document_still_agrees_after_an_edit_of_what_is_given(edit: Mapping[str, str], tmp_path: Path) -> None:
    root = course_in(tmp_path, edit)
    reference = "    - {answer: torque, states: [-5/28*M*a**2*omega**2, 1/7*M*a**2*omega**2, -1/28*M*a**2*omega**2]}\n"
    (root / "problems" / "hw9" / "reference.yaml").write_text(HEAD + reference)
    assert rendered_once(root, "hw9/block", only=()).agreed


# -- the command line -------------------------------------------------------------------------------------------------


def test_check_fails_on_a_difference_and_counts_the_references(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    root = course_in(tmp_path)
    entries = "    - {answer: cosine, states: 0.92951, to: 5}\n    - {answer: cosine, states: 0.95}\n"
    (root / "problems" / "hw9" / "reference.yaml").write_text(HEAD + entries)
    assert main(["--root", str(root), "check"]) == 1
    out, err = capfd.readouterr()
    facts = out.partition("\n\n")[0].splitlines()[-1].split()
    assert facts[8] == "2"
    assert facts[10:] == ["differs", "from", "its", "reference"]
    assert "reference.yaml:7:32: warning[differs]" in err


def test_a_problem_without_references_agrees(tmp_path: Path) -> None:
    solution = rendered_once(course_in(tmp_path), "hw9/block")
    assert solution.agreed
    assert json.loads(solution.texts["json"])["reference"] == []
    assert "problems/hw9/reference.yaml" in solution.inputs


@pytest.mark.parametrize(
    ("problem", "count", "errata", "remarks"),
    [("euler", 22, 5, 2), ("centred", 99, 7, 5), ("top", 27, 2, 14), ("cone", 43, 5, 8), ("slab", 40, 17, 10)],
)
def test_the_homework_agrees_but_for_its_errata(
    problem: str, count: int, errata: int, remarks: int, tmp_path: Path
) -> None:
    root = course_in(tmp_path, problem=problem)
    document = (ROOT / "problems" / "hw9" / "reference.yaml").read_text(encoding="utf-8")
    document = document.replace("- problem: block", "- problem: centred")
    (root / "problems" / "hw9" / "reference.yaml").write_text(document, encoding="utf-8")
    shutil.copy(ROOT / "problems" / "hw9" / "hw9.md", root / "problems" / "hw9")
    for other in re.findall(r"^- problem: (\w+)", document, re.MULTILINE):
        (root / "problems" / "hw9" / f"{other}.yaml").touch()
    found = json.loads(rendered_once(root, f"hw9/{problem}", only={"json"}).texts["json"])["reference"]
    outcomes = [entry["outcome"] for entry in found]
    assert (len(found) - remarks, outcomes.count("erratum"), outcomes.count("remark")) == (count, errata, remarks)
    assert {outcome.split(" to ")[0] for outcome in outcomes} == {"agrees", "erratum", "remark"}
    assert {entry["grade"] for entry in found} <= {"proved", "approximation", None}
    assert all(entry["line"] for entry in found)


@pytest.mark.parametrize(
    ("symbols", "moments", "here"),
    [
        ("", "I_x, I_y, I_z", True),
        (", omega_x: angular speed", "I_x, I_y, I_z", True),
        ("", "I_x, I_x, I_z", False),
    ],
)
def test_a_source_is_about_the_system_that_its_group_describes(
    symbols: str, moments: str, here: bool, tmp_path: Path
) -> None:
    root = course_in(tmp_path, problem="euler")
    letters = f"I_x: moment of inertia, I_y: moment of inertia, I_z: moment of inertia{symbols}"
    head = f"- problem: euler\n  symbols: {{{letters}}}\n  given: {{moments: [{moments}]}}\n  entries:\n"
    first, second, third = moments.split(", ")
    entry = f"    - {{answer: inertia_tensor, states: [[{first}, 0, 0], [0, {second}, 0], [0, 0, {third}]]}}\n"
    (root / "problems" / "hw9" / "reference.yaml").write_text(head + entry, encoding="utf-8")
    problem = load_problem(root, "hw9/euler")
    (found,) = comparisons(problem, with_ancestors(returned_quantities(run_solve(problem))))
    assert (found.outcome, found.here) == ("agrees", here)


class Nothing:
    def get(self, key: str) -> None:
        return None

    def keep(self, key: str, text: str) -> None:
        return None


def test_what_a_document_pins_is_derived_once_however_often_the_given_is_edited(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    again: list[str] = []
    derive_again = comparison._derived_again
    monkeypatch.setattr(comparison, "_derived_again", lambda of, m: (again.append(of.id), derive_again(of, m))[1])
    monkeypatch.setattr(comparison, "_pinned_before", deque(maxlen=4))

    def outcomes(name: str, given: str, mass: str = "mass") -> list[str]:
        edits, script = {"sides: [a, 2*a, 3*a]": f"sides: {given}"}, {"Cuboid(sides, mass)": f"Cuboid(sides, {mass})"}
        root = course_in(tmp_path / name, edits, script)
        stated = "    - {answer: inertia_tensor_zz, states: 5/12*M*a**2}\n"
        (root / "problems" / "hw9" / "reference.yaml").write_text(HEAD + stated, encoding="utf-8")
        problem = load_problem(root, "hw9/block")
        known = with_ancestors(returned_quantities(run_solve(problem)))
        return [found.outcome for found in comparisons(problem, known, Memory(Nothing()))]

    assert outcomes("one", "[a, 2*a, 5*a]") == outcomes("two", "[a, 2*a, 7*a]") == ["agrees"]
    assert len(again) == 1
    assert outcomes("three", "[a, 2*a, 7*a]", "2 * mass") == ["differs"]
    assert len(again) == 2
