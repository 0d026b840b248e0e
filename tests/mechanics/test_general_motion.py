"""The steps that lead to the motion of one coordinate: characteristic equation, roots and general motion."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from sympy import Expr, I, Integer, cos, cosh, exp, sin, sinh, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import PLUS_MINUS, Relation, explicit, scalar
from derive.algebra.expressions import TIME as t
from derive.errors import Unverified
from derive.mechanics import Coordinate, coordinate, let, solution
from derive.mechanics.vibrations import claims, general_motion
from derive.steps.record import Run, recorded
from derive.steps.rule import Judged
from derive.steps.step import Quantity
from tests.courses import rendered_once
from tests.stock.described import course_with

m, k, b, g, w, x0, v0, F, W = symbols("m k b g omega x_0 v_0 F Omega", positive=True)
A, B, s = symbols("A B s", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def along() -> Coordinate:
    return coordinate("x", "length")


def equation(left: Expr, right: Expr | int = 0) -> Quantity:
    return let("motion", lambda: Relation(left, "=", right))


def moving(left: Any, right: Expr | int = 0, case: str | None = None) -> Quantity:
    x = along()
    return solution(equation(left(x), right), x, x0, v0, case)


def behind(found: Quantity) -> dict[str, Quantity]:
    return {each.step.rule.rpartition(".")[2]: each for each in found.ancestors()}


def damped(x: Coordinate, drag: Expr = b) -> Expr:
    return m * x.acceleration + drag * x.rate + k * x.symbol


def is_general(found: Quantity, right: Expr) -> bool:
    value = explicit(behind(found)["general_motion"].value)
    return value.left == along().symbol and bool(equal(value.right, right))


def test_a_damped_oscillator_has_the_roots_minus_beta_plus_or_minus_i_omega() -> None:
    """Taylor, section 5.4."""
    beta = b / (2 * m)
    slower = sqrt(k / m - beta**2)
    found = moving(damped, case="underdamped")
    steps = behind(found)
    assert equal(steps["characteristic_polynomial"].value, Relation(s**2 + b / m * s + k / m, "=", 0))
    assert equal(explicit(steps["exponents"].value), -beta + PLUS_MINUS * I * slower)
    assert is_general(found, exp(-beta * t) * (A * cos(slower * t) + B * sin(slower * t)))
    told = dict(found.step.roles)
    assert equal(told["first"], Relation(A, "=", x0))
    assert told["second"].left == B
    assert all(each.grade == "proved" for key in ("exponents", "general_motion") for each in steps[key].step.evidence)


@pytest.mark.long
def test_an_overdamped_oscillator_has_two_real_roots() -> None:
    beta = b / (2 * m)
    apart = sqrt(beta**2 - k / m)
    found = moving(damped, case="overdamped")
    assert behind(found)["exponents"].step.outcome == "overdamped"
    assert equal(explicit(behind(found)["exponents"].value), -beta + PLUS_MINUS * apart)
    assert is_general(found, exp(-beta * t) * (A * exp(apart * t) + B * exp(-apart * t)))


def test_a_double_root_gives_a_constant_plus_a_constant_times_the_time() -> None:
    found = moving(lambda x: damped(x, 2 * sqrt(k * m)))
    decay = exp(-sqrt(k / m) * t)
    assert equal(explicit(behind(found)["exponents"].value), -sqrt(k / m))
    assert is_general(found, (A + B * t) * decay)
    assert dict(behind(found)["general_motion"].step.coordinates)[B] == "speed"


def test_without_damping_the_general_motion_needs_no_roots() -> None:
    found = moving(lambda x: m * x.acceleration + k * x.symbol)
    steps = behind(found)
    right = explicit(steps["harmonic_motion"].value).right
    assert equal(right, A * cos(sqrt(k / m) * t) + B * sin(sqrt(k / m) * t))
    assert not {"characteristic_polynomial", "exponents", "general_motion"} & steps.keys()


def test_a_growing_motion_has_one_positive_root() -> None:
    found = moving(lambda x: x.acceleration - w**2 * x.symbol)
    assert equal(explicit(behind(found)["exponents"].value), PLUS_MINUS * w)
    assert is_general(found, A * cosh(w * t) + B * sinh(w * t))


def test_a_growing_motion_of_first_order_needs_no_roots() -> None:
    x = along()
    found = solution(equation(m * x.rate - b * x.symbol), x, x0)
    assert not {"exponents", "general_motion"} & behind(found).keys()
    assert equal(explicit(found.value), x0 * exp(b * t / m))


def test_a_driven_motion_is_the_sum_of_a_particular_and_the_free_motion() -> None:
    found = moving(lambda x: m * x.acceleration + k * x.symbol, F * cos(W * t))
    step = behind(found)["harmonic_motion"]
    free = A * cos(sqrt(k / m) * t) + B * sin(sqrt(k / m) * t)
    assert equal(explicit(step.value).right, free + F * cos(W * t) / (k - m * W**2))
    assert {"driving", "excluded"} <= dict(step.step.roles).keys()
    lifted = moving(lambda x: m * x.acceleration + k * x.symbol, m * g)
    assert "constant" in dict(behind(lifted)["harmonic_motion"].step.roles)


@pytest.mark.parametrize(
    "left", [lambda x: m * x.acceleration, lambda x: m * x.acceleration + b * x.rate], ids=["uniform", "slows"]
)
def test_an_equation_without_the_coordinate_is_integrated_and_has_no_general_motion(left: Any) -> None:
    assert not {"harmonic_motion", "general_motion"} & behind(moving(left)).keys()


@pytest.mark.parametrize(
    ("letters", "constants"),
    [(("A", "k", "m"), ["C", "D"]), (("B", "D"), ["C_1", "C_2"]), (("k",), ["A", "B"])],
)
def test_the_constants_have_letters_that_the_problem_does_not_use(letters: Any, constants: list[str]) -> None:
    with recorded(Run(letters=letters)):
        found = moving(lambda x: m * x.acceleration + k * x.symbol)
        told = dict(found.step.roles)
        assert [told[role].left.name for role in ("first", "second")] == constants


@pytest.mark.long
def test_two_cases_of_one_equation_have_one_characteristic_equation() -> None:
    x = along()
    motion = equation(damped(x))
    cases = [solution(motion, x, x0, v0, case, key=case) for case in ("underdamped", "overdamped")]
    one, other = (behind(each) for each in cases)
    assert one["characteristic_polynomial"].step == other["characteristic_polynomial"].step
    assert one["exponents"].key != other["exponents"].key


# --- wrong laws ---


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("_half_difference", lambda linear, sort: 2 * sqrt(-linear.discriminant) / linear.a),
        ("_free_with", lambda constants, linear, sort: constants[0] * cos(sqrt(k / m) * t)),
        ("_free_with", lambda constants, linear, sort: (constants[0] + constants[1]) * exp(-b * t / (2 * m))),
        ("exp", lambda phase: exp(2 * phase)),
    ],
)
def test_a_wrong_step_to_the_motion_is_refused(name: str, wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(general_motion, name, wrong)
    with pytest.raises(Unverified):
        moving(damped, case="underdamped")


def test_wrong_constants_are_refused() -> None:
    found = moving(lambda x: m * x.acceleration + k * x.symbol)
    general = behind(found)["harmonic_motion"]
    values = {"first": Relation(A, "=", x0), "second": Relation(B, "=", v0 / sqrt(k / m))}
    facts = Judged(found.value, {**values, "constants": (A, B)}, {"general": general})
    assert claims.constants_as_told(facts, "oscillates")
    swapped = {"first": Relation(B, "=", x0), "second": Relation(A, "=", v0 / sqrt(k / m))}
    assert not claims.constants_as_told(Judged(found.value, {**swapped, "constants": (A, B)}, {"general": general}), "")


def test_a_motion_with_one_constant_is_not_general() -> None:
    u = scalar("u")
    data = {"linear": (m, Integer(0), k), "driven": Integer(0), "constants": (A, B), "q": u}
    one = Relation(u, "=", (A + B) * cos(sqrt(k / m) * t))
    both = Relation(u, "=", A * cos(sqrt(k / m) * t) + B * sin(sqrt(k / m) * t))
    assert not claims.is_general_motion(Judged(one, data))
    assert claims.is_general_motion(Judged(both, data))


# --- on the page ---


CART = """
title: A cart
solve: system
symbols: {m: mass, k: spring constant, b: damping constant, x_0: length, v_0: speed}
given:
  coordinates: {x: length}
  places: {cart: [x, 0]}
  particles: {cart: {mass: m, at: cart}}
  potential: k*x**2/2
  results:
    first: {solution: motion_x, for: x, start: x_0}
    second: {solution: motion_x, for: x, start: 0, start_rate: v_0}
statement: A cart of mass <<m>> on a spring <<k>>, with <<x_0>> and <<v_0>>.
parts:
  - {ask: 'Find x.', answer: first}
  - {ask: 'Find x again.', answer: second}
"""
DAMPED = (
    CART.replace("  potential", "  damping: {constant: b, at: cart}\n  potential")
    .replace("start: x_0}", "start: x_0, case: underdamped}")
    .replace("start_rate: v_0}", "start_rate: v_0, case: underdamped}")
)


def page(folder: Path, text: str, detail: str | None = None) -> str:
    text = text if "damping:" in text else text.replace(", b: damping constant", "")
    return " ".join(rendered_once(course_with(folder, text), "trial/one", detail, only={"text"}).texts["text"].split())


def test_the_page_shows_the_trial_the_roots_the_general_motion_and_the_constants(tmp_path: Path) -> None:
    shown = page(tmp_path, DAMPED)
    trial = re.search(
        r"Substituting x = e\^st into (\S+) gives the characteristic equation s² \+ 2β s \+ ω_0² = 0", shown
    )
    assert trial is not None
    assert re.search(r"so the roots of \(\d+\) are complex, s = -β ± i ω_1", shown)
    assert "The general solution is x = e^(-βt) (A cos(ω_1 t) + B sin(ω_1 t))" in shown
    assert "require A = x_0 and B = x_0 β/ω_1, so" in shown
    assert shown.count("The general solution is") == 1


def test_the_general_motion_of_a_second_harmonic_oscillator_is_not_shown_again(tmp_path: Path) -> None:
    shown = page(tmp_path, CART)
    assert "Its general solution is x = A cos(ω_0 t) + B sin(ω_0 t)" in shown
    assert shown.count("general solution") == 1


@pytest.mark.parametrize("text", [CART, DAMPED])
def test_a_brief_page_shows_only_the_motion(text: str, tmp_path: Path) -> None:
    shown = page(tmp_path, text, "brief")
    assert "general solution" not in shown and "gives the characteristic equation" not in shown


def test_the_words_of_an_author_replace_the_steps_that_lead_to_the_motion(tmp_path: Path) -> None:
    worded = DAMPED + "wording: {first: 'The cart swings, <<chain>>', second: 'Now it swings, <<chain>>'}\n"
    assert "general solution" not in page(tmp_path / "both", worded)
    one = DAMPED + "wording: {first: 'The cart swings, <<chain>>'}\n"
    assert page(tmp_path / "one", one).count("The general solution is") == 1


def test_a_coordinate_may_have_the_usual_letter_of_the_exponent(tmp_path: Path) -> None:
    text = (
        DAMPED.replace("[x, 0]", "[s, 0]")
        .replace("x: length", "s: length")
        .replace("motion_x, for: x", "motion_s, for: s")
    )
    shown = page(tmp_path, text.replace("x**2", "s**2"))
    assert "s = e^λt" in shown and "λ = -β ± i ω_1" in shown
