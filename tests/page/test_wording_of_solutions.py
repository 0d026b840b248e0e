"""Tests of the texts of solutions, such as the display of Lagrange's equation and the frames of answers."""

from __future__ import annotations

import re
from pathlib import Path
from unicodedata import normalize

import pytest
from sympy import Symbol

from derive.algebra.equality import Grade
from derive.algebra.expressions import Relation, rate, scalar
from derive.building.solution import rendered
from derive.errors import DeriveError
from derive.mechanics.lagrange import applied_forces, claims
from derive.mechanics.motion import energy_integral
from derive.page.chain_lines import conditions_of
from derive.page.template import templates_of
from derive.page.wording import Text, phrases
from derive.render.rendered import Rendered
from derive.steps.level import Display
from tests.courses import ROOT, rendered_once, solved_once
from tests.stock.described import course_with, edited, solved

WORDS = phrases(templates_of(ROOT))
LIBRARY = ROOT / "problems" / "library"
REJECTED = (  # these phrases were on pages, and were wrong, misleading or useless
    "For Lagrange's equation",
    "general form see",
    "The derivatives in Lagrange's equation",
    "The squares of the speeds",
    "integrals of the squared",
    "unless all three moments",
    "Combining these results",
    "No such force",
    "No generalized force",
)


def library(name: str) -> str:
    return (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")


def page(folder: Path, text: str) -> str:
    return in_one_line(rendered(course_with(folder, text), "trial/one", only={"text"}))


def library_page(name: str) -> str:
    return in_one_line(rendered_once(ROOT, f"library/{name.partition('/')[2]}", only={"text"}))


def in_one_line(rendered: Rendered) -> str:
    whole = rendered.texts["text"]
    return normalize("NFC", " ".join(whole.replace("  * ", " ").split()))


def test_no_sentence_is_one_of_those_that_readers_rejected() -> None:
    every = [*WORDS.theorems_again.values(), *(each for of in WORDS.rules.values() for each in of.values())]
    assert not [(each, phrase) for each in REJECTED for phrase in every if each in " ".join(phrase.split())]


def test_lagranges_equation_is_one_display_after_the_speed_and_its_position(tmp_path: Path) -> None:
    text = page(tmp_path, library("pendulums/spring_pendulum").replace("  motion_r: result\n", ""))
    r_dot = normalize("NFC", "ṙ")
    assert f"The square of the speed is v² = ({r_dot})²" in text
    equation = text[text.index("Lagrange's equation for r is") : text.index("and that for θ is")]
    law, derivatives = f"d/dt ∂L/∂{r_dot} - ∂L/∂r = 0", f"d/dt (m {r_dot}) - (m r"
    assert f"{law} {derivatives}" in equation
    assert equation.count("(5)") == 1 and "(6)" not in equation, "one display with one number"


def test_a_wrong_derivative_in_the_display_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = applied_forces.difference
    monkeypatch.setattr(applied_forces, "difference", lambda first, second: right(first, 2 * second))
    with pytest.raises(DeriveError, match="motion_r"):
        solved(tmp_path, library("pendulums/spring_pendulum"))


def test_the_speed_of_a_particle_is_not_that_of_a_centre(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claims, "_has_speed", lambda facts, places: False)
    with pytest.raises(DeriveError, match="could not be confirmed"):
        solved(tmp_path, library("pendulums/simple_pendulum"))


@pytest.mark.parametrize(
    ("name", "outcome", "told"),
    [
        pytest.param(
            "rolling/ladder",
            "grows",
            "the angular acceleration is positive, so the angle increases and its rate is the positive root, θ̇ = √(3g",
            marks=pytest.mark.long,
        ),
        ("pendulums/simple_pendulum", "falls", "so its rate is the negative root, θ̇ = -√(2g"),
    ],
)
def test_a_rate_is_the_root_of_its_square_with_the_sign_of_the_motion(name: str, outcome: str, told: str) -> None:
    assert normalize("NFC", told) in library_page(name)
    steps = solved_once(ROOT, f"library/{name.partition('/')[2]}")[1].derivation.steps
    assert [each.outcome for each in steps if each.rule == "motion.rate_by_energy"] == [outcome]


@pytest.mark.parametrize("name", ["rolling/ladder", "pendulums/simple_pendulum"])
def test_the_other_root_is_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(energy_integral, "sign_known", lambda value: -1 if name == "rolling/ladder" else 1)
    with pytest.raises(DeriveError, match="could not be confirmed"):
        solved(tmp_path, library(name))


def test_a_result_computed_from_derived_results_is_not_called_a_definition() -> None:
    class Derived:
        grade, inputs = Grade.DEFINITION, ("rate",)

    class Defined:
        grade, inputs = Grade.DEFINITION, ()

    assert WORDS.beside_answer(Derived(), None) == ()  # type: ignore[arg-type]
    assert WORDS.beside_answer(Defined(), None) == (Text("by definition"),)  # type: ignore[arg-type]


def test_the_conditions_of_an_answer_are_in_its_frame_as_one_line() -> None:
    v, g = Symbol("v"), Symbol("g")

    class Lost:
        display = Display(conditions=("reached", "existing"))
        roles = (("reached", Relation(v, ">", 2 * g)), ("existing", Relation(v, "<", 5 * g)))

    (line,) = conditions_of(Lost())  # type: ignore[arg-type]
    assert (line.left, line.relation, line.right) == (Relation(2 * g, "<", v), "less", 5 * g)
    Lost.roles = Lost.roles[:1]
    (line,) = conditions_of(Lost())  # type: ignore[arg-type]
    assert (line.left, line.relation, line.right) == (v, "greater", 2 * g)


def test_a_speed_is_answered_where_the_speed_is_asked_for(tmp_path: Path) -> None:
    text = library_page("constraints/loop")
    assert "v = √(v_0² - 2g R (1 - cos θ))" in text
    same = edited(library("contacts/pushed_off_sphere"), ("{square_root: speed}", "{square_root: force}"))
    with pytest.raises(DeriveError, match="is not the square of a rate"):
        solved(tmp_path, same)


def test_a_root_has_the_letter_of_its_rate() -> None:
    class Of:
        symbol = rate(scalar("theta"))

    assert energy_integral.claims.coordinate_of_rate(Of(), scalar("theta"))  # type: ignore[arg-type]
    assert not energy_integral.claims.coordinate_of_rate(Of(), scalar("phi"))  # type: ignore[arg-type]


def test_only_an_exactly_linear_equation_has_a_frequency_for_every_amplitude() -> None:
    hanging = library_page("oscillations/hanging_mass")
    assert "without approximation" in hanging.lower() and "does not depend on the amplitude" in hanging
    assert "To first order" not in hanging and "small oscillations" not in hanging
    pendulum = library_page("pendulums/simple_pendulum")
    assert "small oscillations" in pendulum and "on the amplitude, ω" not in pendulum


def test_a_definition_within_a_sentence_ends_with_a_comma(tmp_path: Path) -> None:
    text = page(tmp_path, re.sub(r"(?ms)^(wording|show):.*?(?=^\w)", "", library("bodies/triangular_plate")))
    assert "is the mass per unit area, and" in text, text


def test_a_constraint_on_one_coordinate_keeps_it_constant() -> None:
    text = " ".join(library_page("contacts/ball_on_belt").split())
    assert "With y = a and ÿ = 0, equation (2) gives" in text
    assert "Differentiating a - y" not in text


def test_a_constant_second_derivative_is_shown_once() -> None:
    assert library_page("oscillations/hanging_mass").count("d²U/dy²") == 1


@pytest.mark.parametrize(
    ("condition", "mark"),
    [(r"$\dot x > a\dot\phi$", False), (r"$2a\dot\phi < 2\dot x$", False), (r"$\dot x < a\dot\phi$", True), ("", True)],
)
def test_a_condition_of_the_statement_is_not_assumed_again(condition: str, mark: bool, tmp_path: Path) -> None:
    source = library("contacts/sliding_to_rolling").replace(r"$\dot x > a\dot\phi$", condition)
    text = " ".join(page(tmp_path, source).split())
    assert (normalize("NFC", "ẋ - a φ̇ > 0") in text) is mark
