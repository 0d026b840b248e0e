"""What a document states against what is derived: every outcome, the pinned given, bad files in golden words."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from sympy import Symbol

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import PLUS_MINUS, Relation
from derive.cli.options import main
from derive.course.problem import Problem, load_problem, run_solve
from derive.course.reference.comparison import Comparison, comparisons
from derive.errors import Rejected, Unverified
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.step import Quantity
from tests.courses import ROOT, course_in, rendered_once

GOLDEN = Path(__file__).parents[2] / "complaints" / "reference"
BAD = sorted(file.stem for file in GOLDEN.glob("*.yaml"))

LETTERS = """\
  symbols: {a: length, M: mass, omega: angular speed, rho: density, I_xx: moment of inertia, I_yy: moment of inertia,
            I_zz: moment of inertia, omega_x: angular speed, omega_y: angular speed, omega_z: angular speed}
"""
GIVEN = "  given: {sides: [a, 2*a, 3*a], mass: M, axis: diagonal, rate: omega}\n"
HEAD = f"- problem: block\n{LETTERS}{GIVEN}  entries:\n"

PRINTED = HEAD.replace("symbols: {a: length", "symbols: {x: length, y: length, z: length, a: length").replace(
    "  entries:",
    "  letters: {I_1: I_xx, I_2: I_yy, I_3: I_zz, omega_1: omega_x, omega_2: omega_y, omega_3: omega_z}\n  entries:",
)

Compared = Callable[..., tuple[Comparison, ...]]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> tuple[Problem, dict[str, Quantity]]:
    problem = load_problem(course_in(tmp_path_factory.mktemp("block")), "hw9/block")
    return problem, with_ancestors(returned_quantities(run_solve(problem)))


@pytest.fixture
def compared(block: tuple[Problem, dict[str, Quantity]], tmp_path: Path) -> Compared:
    """Comparisons of entries, one a line, or of a whole reference, with steps that were derived only once."""
    problem, known = block
    course_in(tmp_path)

    def compare(*entries: str, whole: str | None = None) -> tuple[Comparison, ...]:
        text = HEAD + "".join(f"    - {{{entry}}}\n" for entry in entries) if whole is None else whole
        (tmp_path / "problems" / "hw9" / "reference.yaml").write_text(text, encoding="utf-8")
        return comparisons(replace(problem, root=tmp_path), known)

    return compare


def one(found: tuple[Comparison, ...]) -> Comparison:
    assert len(found) == 1
    return found[0]


# -- agreement --------------------------------------------------------------------------------------------------------


def test_an_equal_form_agrees_and_says_how_we_know(compared: Compared) -> None:
    entry = one(compared("part: 2, answer: kinetic_energy_about_axis, states: 1/24*M*a**2*omega**2*(13 + 40 + 45)/14"))
    assert entry.facts() == {
        "problem": "hw9/block",
        "part": "2",
        "answer": "kinetic_energy_about_axis",
        "states": "1/24*M*a**2*omega**2*(13 + 40 + 45)/14",
        "outcome": "agrees",
        "grade": "proved",
        "detail": "identical",
    }
    assert entry.complaint is None


@pytest.mark.parametrize(
    ("entry", "outcome"),
    [
        ("answer: centre_of_mass, states: [a/2, a, 3*a/2]", "agrees"),
        ("answer: inertia_tensor, states: [[13/12*M*a**2, 0, 0], [0, 10/12*M*a**2, 0], [0, 0, 5/12*M*a**2]]", "agrees"),
        ("answer: cosine, states: (14/24)/sqrt(397/1008)", "agrees"),
        ("answer: inertia_tensor_xy, states: 0", "agrees"),
        ("answer: cosine, states: 0.92951, to: 5", "agrees to 5 figures"),
        ("answer: cosine, states: 0.9, to: 1", "agrees to 1 figure"),
        ("answer: angle_between, states: 21.64, in: degree, to: 4", "agrees to 4 figures"),
        ("answer: magnitude, states: 0.2315*M*a**2*omega**2, to: 4", "agrees to 4 figures"),
        ("answer: kinetic_energy, states: M*a**2*(0.542*omega_x**2 + 0.417*omega_y**2 + 0.208*omega_z**2), to: 3",
         "agrees to 3 figures"),
    ],
)  # fmt: skip
def test_a_right_value_agrees(compared: Compared, entry: str, outcome: str) -> None:
    assert one(compared(entry)).outcome == outcome


@pytest.mark.parametrize(
    ("entry", "detail"),
    [
        ("answer: cosine, states: 0.92950, to: 5", "0.92950 against 0.9295052"),
        ("answer: cosine, states: 0.92951", "0.929510 against 0.929505"),
        ("answer: angle_between, states: 21.64, to: 4", "21.64 against 0.377727"),
        ("answer: magnitude, states: 0.2315*M*a*omega**2, to: 4", "a force against a torque"),
        ("answer: corner_tensor_xx, states: 4.3333*M*a**2*omega_x/omega_y, to: 5", "omega_x/"),
        ("answer: magnitude, states: 0, to: 4", "0 against"),
        ("answer: cosine, states: 0.92951, in: kg, to: 5", "a mass against a number"),
        ("answer: torque, states: M*a**2*omega**2", "a scalar against a vector"),
        ("answer: torque, states: [-5/28*M*a**2*omega**2, 1/7*M*a**2*omega**2, 0]", "z: 0 against -"),
        ("answer: inertia_tensor, states: [[13/12*M*a**2, 0, 0], [0, 5/12*M*a**2, 0], [0, 0, 5/12*M*a**2]]", "yy: "),
    ],
)
def test_a_wrong_value_differs_and_the_entry_is_named(compared: Compared, entry: str, detail: str) -> None:
    found = one(compared(entry))
    assert (found.outcome, found.grade) == ("differs", "refuted")
    assert detail in found.detail
    assert found.complaint is not None


def test_a_list_of_figures_has_one_for_each_component(compared: Compared) -> None:
    torque = "answer: torque, states: [-0.1786*M*a**2*omega**2, 0.1429*M*a**2*omega**2, -0.0357*M*a**2*omega**2]"
    found = compared(f"{torque}, to: 4", f"{torque}, to: [4, 4, 3]")
    assert [entry.outcome for entry in found] == ["differs", "agrees to 3 figures"]
    assert found[0].detail.startswith("z: ")


def test_letters_stand_for_what_earlier_steps_found(compared: Compared) -> None:
    euler = "omega_y*omega_z*(I_zz - I_yy), omega_z*omega_x*(I_xx - I_zz), omega_x*omega_y*(I_yy - I_xx)"
    found = compared("answer: corner_tensor_xx, states: 26*a**5*rho", f"answer: torque, states: [{euler}]")
    assert [entry.outcome for entry in found] == ["agrees", "agrees"]
    assert [entry.detail for entry in found] == [
        "identical, for rho as derived",
        "identical, for I_xx, I_yy, I_zz, omega_x, omega_y, omega_z as derived",
    ]


def test_a_letter_of_a_general_vector_keeps_its_generality(compared: Compared) -> None:
    along_diagonal = "answer: kinetic_energy, states: 98/24*M*a**2*omega_x**2"
    assert one(compared(along_diagonal)).outcome == "differs"
    assert one(compared(along_diagonal.replace("kinetic_energy", "kinetic_energy_about_axis"))).outcome == "agrees"


def test_a_component_is_not_taken_to_be_positive(compared: Compared) -> None:
    """omega_x may be negative, so the root of its square is not omega_x."""
    form = "answer: kinetic_energy, states: M*a**2*(13*sqrt(omega_x**2)*{} + 10*omega_y**2 + 5*omega_z**2)/24"
    found = compared(form.format("omega_x"), form.format("sqrt(omega_x**2)"))
    assert [entry.outcome for entry in found] == ["differs", "agrees"]


# -- formulas in LaTeX ------------------------------------------------------------------------------------------------


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


@pytest.mark.parametrize(
    ("entry", "outcome"),
    [
        (r"answer: corner_tensor_xx, latex: '\rho\int_0^a dx\int_0^{2a} dy\int_0^{3a} dz (y^2+z^2)'", "agrees"),
        (r"answer: centre_of_mass, latex: '\{\frac12 a, a, \frac32 a\}'", "agrees"),
        (r"answer: torque, latex: '\{\omega_1,\omega_2,\omega_3\}\times\{I_1\omega_1,I_2\omega_2,I_3\omega_3\}'",
         "agrees"),
        (r"answer: angular_momentum, latex: '\{I_1\omega_1,I_2\omega_2,I_3\omega_3\}'", "agrees"),
        (r"answer: cosine, latex: 0.92951, to: 5", "agrees to 5 figures"),
        (r"answer: angle_between, latex: '\arccos 0.92951', in: rad, to: 3", "agrees to 3 figures"),
        (r"answer: angle_between, latex: '21.64^\circ', to: 4", "agrees to 4 figures"),
        (r"answer: cosine, latex: '\frac{14}{24} \ge 0'", "differs"),
        (r"answer: cosine, latex: '1 \pm 2'", "differs"),
        (r"answer: torque, latex: '\{1, 2, 3\}'", "differs"),
        (r"answer: torque, latex: '\begin{pmatrix} 1 & 0 \\ 0 & 1 \end{pmatrix}'", "differs"),
    ],
)  # fmt: skip
def test_a_formula_as_printed_is_compared(compared: Compared, entry: str, outcome: str) -> None:
    found = compared(whole=f"{PRINTED}    - {{{entry}}}\n")
    assert found[0].outcome == outcome


def test_letters_of_the_document_may_be_called_otherwise(compared: Compared) -> None:
    """m is our M; what is called M in the document is something else, and not known."""
    swapped = PRINTED.replace("letters: {", "letters: {m: M, ")
    entry = r"    - {answer: inertia_tensor_zz, latex: '\frac{5}{12} m a^2'}"
    assert one(compared(whole=f"{swapped}{entry}\n")).outcome == "agrees"


def test_numbers_put_in_for_letters_are_put_in_on_both_sides(compared: Compared) -> None:
    values = PRINTED.replace("  entries:\n", "  values: {a: 10 cm, omega: 900 rpm}\n  entries:\n")
    line = r"answer: kinetic_energy_about_axis, latex: '\frac{7}{24} M (0.1)^2 (94.248)^2'"
    found = compared(whole=f"{values}    - {{{line}, with: [a, omega], to: 4}}\n    - {{{line}, to: 4}}\n")
    assert [entry.outcome for entry in found] == ["agrees to 4 figures", "differs"]


def test_an_erratum_in_latex_has_what_is_right_in_latex(compared: Compared) -> None:
    slip = r"answer: inertia_tensor_zz, latex: '\frac{5}{13} M a^2'"
    entry = slip + r", erratum: {why: 13 for 12, right: '\frac{5}{12} M a^2'}"
    assert one(compared(entry)).outcome == "erratum"


def test_a_slip_may_be_wrong_in_its_dimension(compared: Compared) -> None:
    slip = r"answer: inertia_tensor_zz, latex: '\frac{5}{12} M a^2 + M'"
    entry = slip + r", erratum: {why: a slip, right: '\frac{5}{12} M a^2'}"
    assert one(compared(entry)).outcome == "erratum"


# -- relations and branches -------------------------------------------------------------------------------------------

omega_dot, M_ours, a_ours = Symbol("omega_dot", real=True), Symbol("M", positive=True), Symbol("a", positive=True)
EQUATION = Relation(M_ours * omega_dot - M_ours * Symbol("omega", positive=True) ** 2, "=", 0)


@pytest.fixture
def compared_with(
    block: tuple[Problem, dict[str, Quantity]], compared: Compared, monkeypatch: pytest.MonkeyPatch
) -> Compared:
    """Comparisons with the step `cosine` having another value, a relation or one of two branches."""
    _, known = block

    def compare(value: object, *entries: str) -> tuple[Comparison, ...]:
        step = replace(known["cosine"].step, kind=None)
        monkeypatch.setitem(known, "cosine", replace(known["cosine"], value=value, step=step, parents=()))
        return compared(whole=PRINTED + "".join(f"    - {{answer: cosine, {entry}}}\n" for entry in entries))

    return compare


@pytest.mark.parametrize(
    ("entry", "outcome"),
    [
        (r"latex: 'M\dot\omega - M \omega^2 = 0'", "agrees"),
        (r"latex: 'M \omega^2 = M\dot\omega'", "agrees"),
        (r"latex: '\dot\omega = \omega^2'", "agrees"),
        (r"latex: '\omega\dot\omega - \omega^3 = 0', times: '\frac{\omega}{M}'", "agrees"),
        (r"latex: '\dot\omega = 2\omega^2'", "differs"),
        (r"latex: '\dot\omega < \omega^2'", "differs"),
        (r"latex: '\dot\omega'", "differs"),
        (r"latex: '\dot\omega = \omega^2 = 0'", "differs"),
    ],
)
def test_an_equation_is_compared_as_an_equation(compared_with: Compared, entry: str, outcome: str) -> None:
    assert one(compared_with(EQUATION, entry)).outcome == outcome


@pytest.mark.parametrize(
    ("entry", "detail"),
    [
        (r"latex: '\dot\omega - \omega^2 = 0', times: '0'", "`times` is zero"),
        (r"latex: '0 = 0', times: '0'", "`times` is zero"),
        (r"latex: '\dot\omega = \dot\omega', times: 'a - a'", "`times` is zero"),
        (r"latex: '0 = 0', times: '(a + x)^2 - a^2 - 2 a x - x^2'", "`times` is zero"),
        (r"latex: '0 = 0'", "0 against "),
        # omega_y is an angular speed, but that the derivation does not know
        (r"latex: '\omega_2 \dot\omega - \omega_2 \omega^2 = 0'", "their sides differ by omega_y/M, which may be zero"),
        (r"latex: '(a - x) (\dot\omega - \omega^2) = 0'", "which may be zero"),
    ],
)
def test_a_factor_that_may_vanish_is_no_agreement(compared_with: Compared, entry: str, detail: str) -> None:
    found = one(compared_with(EQUATION, entry))
    assert (found.outcome, detail in found.detail) == ("differs", True)


def test_a_value_is_not_multiplied_by_a_factor(compared: Compared) -> None:
    found = one(compared(r"answer: inertia_tensor_zz, latex: '\frac{5}{12} M a^2', times: '1'"))
    assert (found.outcome, found.detail) == ("differs", "only an equation is multiplied by a factor")


def test_numbers_that_leave_nothing_of_an_equation_leave_nothing_to_compare(
    block: tuple[Problem, dict[str, Quantity]], compared: Compared, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, known = block
    step = replace(known["cosine"].step, kind=None)
    value = Relation((a_ours - Symbol("x", positive=True)) * omega_dot, "=", 0)
    monkeypatch.setitem(known, "cosine", replace(known["cosine"], value=value, step=step, parents=()))
    head = PRINTED.replace("  entries:\n", "  values: {a: 10 cm, x: 10 cm}\n  entries:\n")
    entry = r"    - {answer: cosine, latex: '(a - x) \dot\omega = 2 (a - x) \omega', with: [a, x]}"
    found = one(compared(whole=f"{head}{entry}\n"))
    assert (found.outcome, found.detail) == (
        "differs",
        "with these numbers both sides are the same, whatever is stated",
    )


def test_two_letters_of_the_document_are_not_one_of_ours(compared: Compared) -> None:
    """Else I_1 - I_2 would be zero."""
    with pytest.raises(Rejected) as refused:
        compared(whole=PRINTED.replace("I_2: I_yy", "I_2: I_xx") + "    - {answer: cosine, latex: '1'}\n")
    (complaint,) = refused.value.complaints
    assert complaint.code == "letter-clash"
    assert complaint.message == "`I_1` and `I_2` both stand for `I_xx`, so that one could be taken for the other"


@pytest.mark.parametrize(
    ("entry", "outcome"),
    [
        (r"latex: 'x - \frac{1}{2} x \pm a'", "agrees"),
        (r"latex: '\frac{x}{2} \mp a'", "agrees"),
        (r"latex: '\frac{x}{2} + a \text{ or } \frac{x}{2} - a'", "agrees"),
        (r"latex: '\frac{x}{2} - a'", "agrees"),
        (r"latex: '\frac{x}{2} \pm 2 a'", "differs"),
        (r"latex: '\frac{x}{2} + a \text{ or } \frac{x}{2} + a'", "differs"),
    ],
)
def test_both_branches_of_a_value_are_compared(compared_with: Compared, entry: str, outcome: str) -> None:
    value = Symbol("x", real=True) / 2 + PLUS_MINUS * a_ours
    found = compared_with(value, entry)
    assert one(found).outcome == outcome


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

    def counted(problem: Problem) -> object:
        runs.append(str(problem.givens[0].value))
        return run_solve(problem)

    monkeypatch.setattr("derive.course.reference.comparison.run_solve", counted)
    cube = HEAD.replace("[a, 2*a, 3*a]", "[a, a, a]")
    answer = "    - {answer: kinetic_energy_about_axis, states: M*a**2*omega**2/12}\n"
    same = "    - {answer: kinetic_energy_about_axis, states: 7/24*M*a**2*omega**2}\n"
    found = compared(whole=cube + answer + HEAD + same + cube + answer)
    assert [entry.outcome for entry in found] == ["agrees"] * 3
    assert runs == ["(a, a, a)"]


def test_numbers_are_put_in_where_the_document_has_no_letter(compared: Compared) -> None:
    numbers = HEAD.replace("[a, 2*a, 3*a]", "[2 cm, 4 cm, 6 cm]").replace("mass: M", "mass: 1.5 kg")
    numbers = numbers.replace("rate: omega", "rate: 900 rpm")
    assert [
        entry.outcome
        for entry in compared(
            whole=numbers
            + "    - {answer: kinetic_energy_about_axis, states: 1.554, in: J, to: 4}\n"
            + "    - {answer: kinetic_energy_about_axis, states: 1554, in: N mm, to: 4}\n"
            + "    - {answer: kinetic_energy_about_axis, states: 1.555, in: J, to: 4}\n"
            + "    - {answer: inertia_tensor_zz, states: 5/12*M*a**2}\n"
        )
    ] == ["agrees to 4 figures", "agrees to 4 figures", "differs", "agrees"]


def test_a_pinned_given_that_cannot_be_derived_says_where_it_is_pinned(
    compared: Compared, monkeypatch: pytest.MonkeyPatch
) -> None:
    refused = HEAD.replace("[a, 2*a, 3*a]", "[a, a, a]") + "    - {answer: torque, states: 0}\n"
    monkeypatch.setattr("derive.steps.chain.equal", lambda *_: Verdict(Grade.REFUTED, "0 against 1"))
    with pytest.raises(Unverified) as caught:
        compared(whole=refused)
    assert "= this is for what is given at problems/hw9/reference.yaml:4" in str(caught.value)


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
    assert rendered_once(root, "hw9/block").agreed


# -- bad files --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", BAD)
def test_a_bad_reference_is_told_in_the_words_on_record(compared: Compared, name: str) -> None:
    with pytest.raises(Rejected) as caught:
        compared(whole=(GOLDEN / f"{name}.yaml").read_text(encoding="utf-8"))
    assert f"{caught.value}\n" == (GOLDEN / f"{name}.txt").read_text(encoding="utf-8")


def test_every_text_on_record_has_its_bad_reference() -> None:
    assert sorted(file.stem for file in GOLDEN.glob("*.txt")) == BAD


def test_faults_about_another_problem_are_told_when_that_is_derived(compared: Compared, tmp_path: Path) -> None:
    (tmp_path / "problems" / "hw9" / "cone.yaml").touch()
    assert compared(whole="- {problem: cone, given: {}, entries: nonsense}\n") == ()


# -- the command line -------------------------------------------------------------------------------------------------


def test_check_fails_on_a_difference_and_counts_the_references(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    root = course_in(tmp_path)
    entries = "    - {answer: cosine, states: 0.92951, to: 5}\n    - {answer: cosine, states: 0.95}\n"
    (root / "problems" / "hw9" / "reference.yaml").write_text(HEAD + entries)
    assert main(["--root", str(root), "check"]) == 1
    out, err = capfd.readouterr()
    facts = out.splitlines()[-1].split()
    assert facts[6] == "2"
    assert facts[8:] == ["differs", "from", "its", "reference"]
    assert "reference.yaml:7:32: warning[differs]" in err


def test_a_problem_without_references_agrees(tmp_path: Path) -> None:
    solution = rendered_once(course_in(tmp_path), "hw9/block")
    assert solution.agreed
    assert json.loads(solution.texts["json"])["reference"] == []
    assert "problems/hw9/reference.yaml" in solution.inputs


@pytest.mark.parametrize(
    ("problem", "count", "errata"),
    [("euler", 20, 3), ("block", 93, 1), ("top", 30, 2), ("cone", 38, 1), ("slab", 34, 11)],
)
def test_the_homework_agrees_but_for_its_errata(problem: str, count: int, errata: int, tmp_path: Path) -> None:
    """The document's own file, with the problems as the tests know them."""
    root = course_in(tmp_path, problem=problem)
    document = (ROOT / "problems" / "hw9" / "reference.yaml").read_text(encoding="utf-8")
    (root / "problems" / "hw9" / "reference.yaml").write_text(document, encoding="utf-8")
    for other in re.findall(r"^- problem: (\w+)", document, re.MULTILINE):
        (root / "problems" / "hw9" / f"{other}.yaml").touch()
    found = json.loads(rendered_once(root, f"hw9/{problem}").texts["json"])["reference"]
    outcomes = [entry["outcome"] for entry in found]
    assert (len(found), outcomes.count("erratum")) == (count, errata)
    assert {outcome.split(" to ")[0] for outcome in outcomes} == {"agrees", "erratum"}
    assert {entry["grade"] for entry in found} <= {"proved", "approximation"}
