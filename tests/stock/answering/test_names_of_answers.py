"""Names of answers do not depend on the order in which they are asked for, nor on singular and plural."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

import pytest
from sympy import symbols

from derive.algebra.equality import equal
from derive.course.problem import run_solve
from derive.steps import establish
from derive.steps.derivation import returned_quantities
from derive.steps.step import Quantity
from tests.stock.bodies import BLOCK, CONE
from tests.stock.described import PENDULUM, complaints, edited, loaded, messages, solved

m_1, m_2, r = symbols("m_1 m_2 r", positive=True)

TABLE = """\
title: Two masses joined through a hole in a table
solve: system
symbols: {m_1: mass, m_2: mass, b: length, g: acceleration}
given:
  coordinates: {r: positive length, phi: angle}
  particles: {puck: {mass: m_1, at: [r*cos(phi), r*sin(phi), 0]}, weight: {mass: m_2, at: [0, 0, r - b]}}
  gravity: g
  conserved: {phi: positive p_phi}
  results:
    radial_equation: {put_in: motion_r, results: rate_phi_by_p_phi}
statement: A puck.
parts:
"""
COUPLED = """\
title: Two blocks
solve: system
symbols: {m: mass, k: spring constant, l: length}
given:
  coordinates: {x_1: length, x_2: length}
  particles: {one: {mass: m, at: [x_1, 0]}, other: {mass: m, at: [x_2 + l, 0]}}
  springs:
    - {constant: k, from: [0, 0], to: [x_1, 0]}
    - {constant: k, from: [x_1, 0], to: [x_2 + l, 0], length: l}
statement: Two blocks.
parts:
  - ask: Find it.
    answer: ASKED
"""
HOOP = edited(
    PENDULUM,
    ("  places: {A: [l*sin(theta), -l*cos(theta)]}\n", "  axes: {hoop: [{z: omega*t}]}\n"),
    ("at: A", "at: {in: hoop, by: [l*sin(theta), 0, -l*cos(theta)]}"),
)


def found(folder: Path, text: str) -> dict[str, list[Quantity]]:
    answers = run_solve(loaded(folder, text))
    assert isinstance(answers, dict)
    return {name: returned_quantities(value) for name, value in answers.items()}


def keys(folder: Path, text: str, name: str) -> list[str]:
    return [quantity.key for quantity in found(folder, text)[name]]


@pytest.mark.parametrize("order", [*permutations(["radial_equation", "effective_potential", "conserved"])])
def test_a_step_on_the_way_has_its_name_whatever_was_asked_for_before(order: tuple[str, ...], tmp_path: Path) -> None:
    """By hand: m_1 r^2 phi_dot = p_phi."""
    text = TABLE + "".join(f"  - {{ask: Find it., answer: {name}}}\n" for name in order)
    assert len(found(tmp_path, text)["radial_equation"]) == 1


def test_the_search_for_a_step_derives_nothing_that_its_answer_derives_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, add = [], establish.record.add
    monkeypatch.setattr(establish.record, "add", lambda q, case: (made.append(q.key), add(q, case))[1])
    steps = solved(tmp_path, TABLE + "  - {ask: Find it., answer: rate_phi_by_p_phi}\n")
    assert made.count("rate_phi_by_p_phi") == made.count("lagrangian") == 1
    assert {"rate_phi_by_p_phi", "lagrangian"} <= steps.keys()


def test_a_part_may_ask_for_a_step_that_nothing_else_leads_to(tmp_path: Path) -> None:
    text = TABLE.replace("  results:\n    radial_equation: {put_in: motion_r, results: rate_phi_by_p_phi}\n", "")
    (rate,) = found(tmp_path, f"{text}  - {{ask: Find it., answer: rate_phi_by_p_phi}}\n")["rate_phi_by_p_phi"]
    assert equal(rate.value, symbols("p_phi", positive=True) / (m_1 * r**2))


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("frequency", ["frequency_1", "frequency_2"]),
        ("frequencies", ["frequency_1", "frequency_2"]),
        ("frequency_2", ["frequency_2"]),
        ("frequencies_2", ["frequency_2"]),
        ("momentum", ["p_x_1", "p_x_2"]),
        ("momenta", ["p_x_1", "p_x_2"]),
        ("momentum_2", ["p_x_2"]),
        ("equation_of_motion", ["motion_x_1", "motion_x_2"]),
        ("equation_of_motion_2", ["motion_x_2"]),
        ("acceleration", ["acceleration_x_1", "acceleration_x_2"]),
        ("acceleration_1", ["acceleration_x_1"]),
        ("equilibrium_1", ["rest"]),
        ("rest_1", ["rest"]),
        ("lagrangian_1", ["lagrangian"]),
    ],
)
def test_singular_plural_and_number_are_the_same_for_every_name(name: str, expected: list[str], tmp_path: Path) -> None:
    assert keys(tmp_path, COUPLED.replace("ASKED", name), name) == expected


@pytest.mark.parametrize(
    ("name", "of", "at"),
    [("equilibrium_2", "equilibria", 1), ("stability_2", "stability", 1), ("rest_2", "equilibria", 1)],
)
def test_one_of_several_states_has_a_number(name: str, of: str, at: int, tmp_path: Path) -> None:
    text = edited(HOOP, ("answer: equations_of_motion", f"answer: [{name}, {of}]"))
    steps = found(tmp_path, text)
    assert steps[name] == [steps[of][at]]


@pytest.mark.parametrize(
    ("text", "own", "name"),
    [
        (BLOCK, "answer: torque", "spins"),
        (BLOCK, "answer: torque", "angular_momentum_1"),
        (CONE, "answer: inertia_tensor", "principal_moment"),
        (CONE, "answer: inertia_tensor", "moments_of_inertia_z"),
    ],
)
def test_bodies_and_rotations_keep_to_the_same_rule(text: str, own: str, name: str, tmp_path: Path) -> None:
    assert len(found(tmp_path, edited(text, (own, f"answer: {name}")))[name]) == 1


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("frequency", "`frequency` is already the name of an answer"),
        ("frequencies", "`frequencies` is already the name of an answer, as `frequency`"),
        ("theta_dot", "`theta_dot` is already a symbol of this problem"),
        ("p_theta", "`p_theta` is already a symbol of this problem"),
        ("l", "`l` is already a symbol of this problem"),
        ("squared_speed", "`squared_speed` is already the key of a step"),
    ],
)
def test_a_result_with_the_name_of_something_else_is_refused_at_its_name(name: str, said: str, tmp_path: Path) -> None:
    text = edited(
        PENDULUM,
        ("  gravity: g\n", f"  gravity: g\n  results:\n    {name}: {{put_in: lagrangian, values: {{m: 2*m}}}}\n"),
        ("answer: equations_of_motion", f"answer: {name}"),
    )
    (complaint,) = complaints(tmp_path, text)
    assert said in complaint.message
    assert (complaint.place.line, complaint.place.column) == (10, 5)


def test_a_number_beyond_the_last_is_no_name(tmp_path: Path) -> None:
    assert messages(tmp_path, COUPLED.replace("ASKED", "frequency_3")) == [
        "13: `frequency_3` is not the name of an answer"
    ]


def test_what_several_answers_rest_on_is_refused_once(tmp_path: Path) -> None:
    text = edited(HOOP, ("  gravity: g\n", "  gravity: g\n  at: rest_7\n"))
    text = edited(text, ("answer: equations_of_motion", "answer: [linearised, frequency, stability]"))
    assert messages(tmp_path, text) == ["9: `rest_7` is not one of `equilibria`"]


@pytest.mark.parametrize("state", ["rest_3", "equilibrium_3", "equilibria_3"])
def test_a_state_is_named_as_answers_are(state: str, tmp_path: Path) -> None:
    text = edited(HOOP, ("  gravity: g\n", f"  gravity: g\n  at: {state}\n"))
    text = edited(text, ("answer: equations_of_motion", "answer: [stability, equilibrium_3]"))
    steps = found(tmp_path, text)
    assert steps["equilibrium_3"][0] in steps["stability"][0].parents
