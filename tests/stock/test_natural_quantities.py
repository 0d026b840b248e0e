"""Results in natural quantities: `define:`, and the letters of an equilibrium."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from sympy import Expr, Symbol

from derive.algebra.natural import Shortened
from derive.building.solution import rendered
from derive.errors import DeriveError
from derive.steps import natural
from tests.courses import ROOT
from tests.stock.described import CART_WITH_DRAG, PENDULUM, complaints, course_with, edited, solved

DAMPED = f"""{CART_WITH_DRAG}statement: A cart.
parts:
  - {{ask: Find the motions., answer: [weak, strong]}}
"""
BEAD = (ROOT / "problems" / "library" / "constraints" / "hoop_oscillations.yaml").read_text(encoding="utf-8")
PLANET = (ROOT / "problems" / "library" / "central" / "kepler.yaml").read_text(encoding="utf-8")


SPRING = """\
title: A mass on a spring
solve: system
symbols: {m: mass, k: spring constant}
define: {DEFINE}
given:
  coordinates: {y: length}
  particles: {ball: {mass: m, at: [0, y]}}
  springs: {constant: k, from: [0, 0], to: ball}
  results:
    first: {value: 2*m}
statement: A ball of mass <<m>> on a spring of constant <<k>>.
parts:
  - {ask: Find it., answer: [ANSWER]}
"""
CONE = """\
title: A cone
solve: body
symbols: {R: length, h: length, M: mass}
define: {DEFINE}
given:
  body: {shape: cone, radius: R, height: h, mass: M}
statement: A cone of mass <<M>>, radius <<R>> and height <<h>>.
parts:
  - {ask: Find it., answer: [ANSWER]}
"""
INCLINE = """\
title: A block on an incline
solve: system
symbols: {m: mass, h: length, g: acceleration, beta: angle}
define: {DEFINE}
given:
  coordinates: {x: length}
  particles: {block: {mass: m, at: [x*cos(beta), -x*sin(beta)]}}
  potential: m*g*sin(beta)*(x**2/(2*h) - x)
  at: {x: h}
statement: A block of mass <<m>> on an incline with the angle <<beta>>. The length <<h>> and <<g>> are given.
parts:
  - {ask: Find it., answer: [ANSWER]}
"""


def asking(text: str, define: str, answer: str) -> str:
    return edited(text, ("DEFINE", define), ("ANSWER", answer))


def defined(formulas: str) -> str:
    return edited(DAMPED, ("\ngiven:", f"\ndefine: {formulas}\ngiven:"))


def last_line(folder: Path, text: str, key: str) -> str:
    return str(solved(folder, text)[key].step.result)


def test_a_radial_frequency_is_the_rate_of_the_orbit(tmp_path: Path) -> None:
    step = solved(tmp_path, PLANET)["frequency"]
    assert str(step.step.result) == "l/(m*r_0**2)"
    assert {str(s) for s in step.value.free_symbols} == {"G", "M", "m", "l"}  # later steps use the given letters


def test_with_none_the_letters_of_the_problem_remain(tmp_path: Path) -> None:
    text = edited(PLANET, ("\ngiven:", "\ndefine: none\ngiven:"))
    assert last_line(tmp_path, text, "frequency") == "G**2*M**2*m**3/l**3"


@pytest.mark.long
def test_a_motion_is_written_in_defined_quantities(tmp_path: Path) -> None:
    text = defined("{beta: b/(2*m), omega_0: sqrt(k/m), omega_1: sqrt(omega_0**2 - beta**2)}")
    found = solved(tmp_path, text)
    assert {str(s) for s in found["weak"].step.result.free_symbols} == {"x_0", "beta", "omega_1", "t"}
    assert {str(s) for s in found["strong"].step.result.free_symbols} == {"x_0", "beta", "omega_0", "t"}
    assert dict(found["weak"].step.roles)["condition"].left == Symbol("beta", real=True, positive=True)
    assert str(found["omega_1"].step.result) == "sqrt(-beta**2 + omega_0**2)"


def test_a_wrong_form_is_not_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = natural.shortened

    def doubled(value: Any, *others: Any, **options: Any) -> Shortened | None:
        found = right(value, *others, **options)
        return found if found is None or not isinstance(value, Expr) else Shortened(2 * found.value, found.used)

    assert last_line(tmp_path, PLANET, "frequency") == "l/(m*r_0**2)"
    monkeypatch.setattr(natural, "shortened", doubled)
    assert last_line(tmp_path, PLANET, "frequency") == "G**2*M**2*m**3/l**3"


@pytest.mark.parametrize(
    ("formulas", "code", "said"),
    [
        ("{k: b**2/m}", "letter-clash", "`k` already has a meaning"),
        ("{x: b/m}", "letter-clash", "`x` already has a meaning"),
        ("{beta: 1/2}", "wrong-argument", "would be the number 1/2"),
        ("{beta: c/(2*m)}", "undeclared-symbol", "`c`"),
        ("{beta: x/2}", "changes", "`define` is about constant letters, but `x` varies"),
        ("{beta: b + m}", "dimension", "cannot be added"),
        ("{sin: b/m}", "symbol", "`sin` has a meaning of its own"),
        ("none of it", "wrong-type", "`define` must be a mapping"),
        ("", "missing-value", ""),
    ],
)
def test_a_mistake_is_reported(tmp_path: Path, formulas: str, code: str, said: str) -> None:
    found = complaints(tmp_path, defined(formulas))
    assert any(each.code == code and said in each.message for each in found), found


def test_a_quantity_that_shortens_nothing_is_a_warning(tmp_path: Path) -> None:
    text = edited(PENDULUM, ("\ngiven:", "\ndefine: {eta: k/m}\ngiven:"))
    found = rendered(course_with(tmp_path, text), "trial/one", only={"text"})
    (warning,) = (each for each in found.warnings if each.code == "unused-definition")
    assert warning.place is not None and "`eta`" in warning.message and warning.place.text.startswith("define:")


@pytest.mark.parametrize(
    ("text", "define", "answer", "key", "symbol"),
    [
        (SPRING, "T: sqrt(m/k)", "lagrangian", "kinetic_energy", "K"),
        (SPRING, "tau: sqrt(m/k)", "period", "period", "tau_0"),
        (CONE, "rho: M/(R**2*h)", "centre_of_mass", "density", "rho_0"),
    ],
)
def test_a_step_does_not_use_a_defined_letter(
    text: str, define: str, answer: str, key: str, symbol: str, tmp_path: Path
) -> None:
    assert str(solved(tmp_path, asking(text, define, answer))[key].symbol) == symbol


@pytest.mark.parametrize(
    ("text", "define", "answer", "said"),
    [
        (SPRING, "p_y: m*sqrt(k/m)", "hamiltonian", "also the key of a step"),
        (SPRING, "first: k/m", "first", "also the key of a step"),
        (CONE, "I_1: M*R**2", "principal_moments", "`principal_moments` also uses this symbol"),
        (CONE, "I_xx: M*R**2", "inertia_tensor", "also uses this symbol"),
        (CONE, "z_C: 2*h", "centre_of_mass", "`r_C_z` looks the same in print"),
    ],
)
def test_a_defined_letter_with_a_second_meaning_is_an_error_at_its_definition(
    text: str, define: str, answer: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, asking(text, define, answer)), "trial/one", only={"text"})
    (found,) = refused.value.complaints
    assert (found.code, found.help) == ("letter-clash", "use another symbol") and said in found.message
    assert found.place is not None and found.place.text.startswith("define:")


def test_a_defined_quantity_is_not_proposed_again(tmp_path: Path) -> None:
    strong = "    strong: {solution: motion_x, for: x, start: x_0, case: overdamped}\n"
    found = solved(
        tmp_path, edited(defined("{Omega: sqrt(k/m)}"), (strong, ""), ("answer: [weak, strong]", "answer: weak"))
    )
    assert {str(s) for s in found["weak"].step.result.free_symbols} == {"x_0", "beta", "omega_1", "t"}
    assert str(found["omega_1"].step.result) == "sqrt(Omega**2 - beta**2)"
    assert "omega_0" not in found


def test_a_value_in_defined_quantities_is_substituted_in_a_later_line(tmp_path: Path) -> None:
    define = "\ndefine: {omega_c: sqrt(g/R), nu: sqrt(omega**2 - omega_c**2)}\ngiven:"
    shown = BEAD[BEAD.index("show: {") : BEAD.index("parts:")]
    wording = BEAD[BEAD.index("  frequency: >-") : BEAD.index("  effective_potential:")]
    text = edited(BEAD, ("\ngiven:", define), (shown, ""), (wording, ""))
    found = rendered(course_with(tmp_path, text), "trial/one", only={"text"})
    assert "Ω_0 = √(ω² - ω_c⁴/ω²)\n  * Ω_0 = ω sin θ_3" in found.texts["text"]


@pytest.mark.parametrize("kind", ["angle", "'angle in (0, pi/2)'"])
def test_a_sine_under_the_root_of_a_definition_is_cancelled(kind: str, tmp_path: Path) -> None:
    text = edited(asking(INCLINE, "nu: sqrt(g*sin(beta)/h)", "equilibria, period"), ("beta: angle", f"beta: {kind}"))
    found = solved(tmp_path, text)
    assert str(found["period"].step.result) == "2*pi/nu"
    conditions = [str(step.step.result) for step in found.values() if step.step.rule.startswith("rest.")]
    assert any("nu**2*" in each and "sin" not in each for each in conditions), conditions


def test_a_condition_and_its_border_are_short(tmp_path: Path) -> None:
    turning = (ROOT / "problems" / "library" / "constraints" / "turning_hoop.yaml").read_text(encoding="utf-8")
    branches = turning[turning.index("  branches:") : turning.index("note: >")]
    text = edited(turning, ("{omega_c: sqrt(g/R)}", "{eta: g/(omega**2*R)}"), (branches, ""))
    found = solved(tmp_path, text)
    roles = [dict(step.step.roles) for step in found.values()]
    borders = {str(each["border"]) for each in roles if "border" in each}
    conditions = {str(each["condition"]) for each in roles if "condition" in each}
    assert borders == {"eta = 1"} and "eta > 1" in conditions


def test_an_integral_takes_a_variable_that_the_problem_does_not_use(tmp_path: Path) -> None:
    rendered(course_with(tmp_path, asking(CONE, "phi: R/h", "centre_of_mass")), "trial/one", only={"text"})
