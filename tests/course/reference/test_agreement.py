"""Whether what a document states is what was derived: values, figures, units, letters, relations and branches."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Symbol

from derive.algebra.expressions import PLUS_MINUS, Relation
from derive.course.problem import Problem
from derive.course.reference.comparison import Comparison
from derive.steps.step import Quantity
from tests.course.reference.stated import HEAD, PRINTED, Compared, one


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
    swapped = PRINTED.replace("letters: {", "letters: {m: M, ")
    entry = r"    - {answer: inertia_tensor_zz, latex: '\frac{5}{12} m a^2'}"
    assert one(compared(whole=f"{swapped}{entry}\n")).outcome == "agrees"


def test_numbers_put_in_for_letters_are_put_in_on_both_sides(compared: Compared) -> None:
    values = PRINTED.replace("  entries:\n", "  values: {a: 10 cm, omega: 900 rpm}\n  entries:\n")
    line = r"answer: kinetic_energy_about_axis, latex: '\frac{7}{24} M (0.1)^2 (94.248)^2'"
    found = compared(whole=f"{values}    - {{{line}, with: [a, omega], to: 4}}\n    - {{{line}, to: 4}}\n")
    assert [entry.outcome for entry in found] == ["agrees to 4 figures", "differs"]


omega_dot, M_ours, a_ours = Symbol("omega_dot", real=True), Symbol("M", positive=True), Symbol("a", positive=True)


EQUATION = Relation(M_ours * omega_dot - M_ours * Symbol("omega", positive=True) ** 2, "=", 0)


@pytest.fixture
def compared_with(
    block: tuple[Problem, dict[str, Quantity]], compared: Compared, monkeypatch: pytest.MonkeyPatch
) -> Compared:
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
        (
            r"latex: '\omega_2 \dot\omega - \omega_2 \omega^2 = 0'",
            "their sides differ by the factor omega_y/M, which may be zero",
        ),
        (r"latex: '(a - x) (\dot\omega - \omega^2) = 0'", "which may be zero"),
    ],
)
def test_a_factor_that_may_vanish_is_no_agreement(compared_with: Compared, entry: str, detail: str) -> None:
    found = one(compared_with(EQUATION, entry))
    assert (found.outcome, detail in found.detail) == ("differs", True)


def test_a_value_is_not_multiplied_by_a_factor(compared: Compared) -> None:
    found = one(compared(r"answer: inertia_tensor_zz, latex: '\frac{5}{12} M a^2', times: '1'"))
    assert (found.outcome, found.detail) == ("differs", "a factor needs two equations, or two relations with `!=`")


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
        "with these numbers both sides of the derived relation are equal, so nothing can be compared",
    )


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
