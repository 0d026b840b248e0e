"""What a sentence names, and what a step returns beside its value: a wrong one is refused, whoever made it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from sympy import Integer, Symbol, cos, exp, pi, symbols

from derive.algebra.expressions import TIME, Relation, Slope, rate, scalar
from derive.building.solution import rendered
from derive.errors import Unverified
from derive.mechanics import (
    Composite,
    Disc,
    Impact,
    Particle,
    Rod,
    System,
    coordinate,
    impulse,
    kinetic_energy_of,
    let,
    limiting_case,
    moment_of_inertia,
    momentum_jump,
    point,
)
from derive.mechanics.arguments import checked
from derive.mechanics.lagrange.facts import KeptMomentum
from derive.mechanics.model.forces import Charge, GivenForce
from derive.mechanics.vibrations.facts import SquareOf
from derive.steps.record import recorded
from derive.steps.rule import Judged, wrongly_handed_on
from derive.steps.step import Quantity
from tests.courses import ROOT
from tests.rules import stated_rightly, wrongly_named
from tests.stock.described import course_with, edited

M, m, R, l, h, k, K, s = symbols("M m R l h k K s", positive=True)
x, w = scalar("x"), scalar("w")


@pytest.fixture(autouse=True)
def a_run_of_its_own() -> Iterator[None]:
    with recorded():
        yield


def roles(quantity: Quantity) -> dict[str, Any]:
    return dict(quantity.step.roles)


# --- bodies ---


@pytest.mark.parametrize(("angle", "letter"), [(pi / 2, "I_y_disc"), (pi / 4, "I_axial_disc"), (0, "I_z_disc")])
def test_the_moment_about_the_own_axis_of_a_disc_has_the_letter_of_the_axis_of_the_whole(
    angle: Any, letter: str
) -> None:
    disc = Disc(R, M).named("disc").turned("x", angle).at(0, 0, -l)
    whole = moment_of_inertia(Composite(Rod(l, m).at(0, 0, -l / 2), disc), "x", "origin", symbol="I_x")
    across = next(q for q in whole.parents if str(q.symbol) == "I_x_disc")
    assert [(str(q.symbol), q.value) for q in across.parents] == [(letter, M * R**2 / 2)]


def test_the_axis_of_a_part_is_named_in_its_own_coordinates_and_in_those_of_the_whole(tmp_path: Path) -> None:
    text = (ROOT / "problems" / "library" / "bodies" / "clock_pendulum.yaml").read_text(encoding="utf-8")
    integrated = edited(text, ("{shape: rod, length", "{derive: true, shape: rod, length"))
    root = course_with(tmp_path, integrated)
    page = " ".join(rendered(root, "trial/one", only={"text"}).texts["text"].split())
    said = "In coordinates of the rod itself, with the origin at the centre, its moment of inertia about an axis "
    said += "parallel to y through the origin (an axis parallel to z in the coordinates of the whole body) is"
    assert said in page
    assert "about an axis parallel to z through the origin" not in page


# --- impacts ---


def test_an_impulse_that_is_read_with_the_wrong_sign_is_refused() -> None:
    """m x_dot = K; a second reader has the components as they were given."""
    q = coordinate("x", "length")
    system = System(Particle(m, point(q + 0, 0)))
    right = impulse((K, 0), point(q + 0, 0))
    T = kinetic_energy_of(system)
    assert momentum_jump(Impact(system, right), T, q).value == Relation(m * q.rate, "=", K)
    with pytest.raises(Unverified, match="second route `particles` disagrees"):
        momentum_jump(Impact(system, replace(right, components=(-K, Integer(0)))), T, q)


def test_rates_before_an_impact_that_are_read_with_the_wrong_sign_are_refused() -> None:
    q = coordinate("x", "length")
    system = System(Particle(m, point(q + 0, 0)))
    impact = Impact(system, impulse((K, 0), point(q + 0, 0)), before={q: w})
    impact.before = {rate_of: -value for rate_of, value in impact.before.items()}
    with pytest.raises(Unverified, match="second route `particles` disagrees"):
        momentum_jump(impact, kinetic_energy_of(system), q)


@pytest.mark.parametrize("wrong", ["-components", "no magnetic field"])
def test_a_noun_that_does_not_keep_what_it_is_given_is_refused(wrong: str) -> None:
    """Law and route read the noun alike, so neither would see it."""
    q = coordinate("x", "length")
    if wrong == "-components":
        noun = checked(
            named_as(lambda components, at: GivenForce((-components[0], components[1]), at.components), "force")
        )
        given: tuple[Any, ...] = ((K, 0), point(q + 0, 0))
    else:
        noun = checked(named_as(lambda amount, at, B: Charge(amount, at, (Integer(0),) * 2, (Integer(0),)), "charge"))
        given = (k, point(q + 0, 0), h)
    with pytest.raises(Unverified, match="its result lacks this value"):
        noun(*given)


def named_as(function: Any, name: str) -> Any:
    function.__name__ = name
    return function


def test_the_axes_of_a_part_are_not_reflected() -> None:
    part = Disc(R, M).turned("x", pi / 2)
    with pytest.raises(Unverified, match="the axes of a part are not rotated axes"):
        replace(part, turn=-part.turn)


# --- limits ---


def test_a_quotient_comes_close_to_the_number_that_is_named() -> None:
    found = limiting_case(let("f", lambda: M * (R**2 / 4 + h**2 / 3)), h / R, to=1, order=1)
    assert found.step.outcome == "near"
    assert (roles(found)["letter"], roles(found)["place"]) == (h / R, 1)


# --- what a sentence names ---


@pytest.mark.parametrize(
    ("rule", "facts", "named"),
    [
        ("vibrations.damped_characteristic", Judged(0, {"exponent": s}), ("trial", exp(s * TIME), exp(-s * TIME))),
        ("vibrations.damped_characteristic", Judged(0, {"exponent": s}), ("trial", exp(s * TIME), cos(s * TIME))),
        ("answers.solved_for", Judged(k, symbol=x), ("unknown", x, w)),
        ("answers.extremum_place", Judged(h, {"quantity": (x - h) ** 2 + w}, symbol=Symbol("x_min")), ("letter", x, w)),
        (
            "motion.energy_kept",
            Judged(Relation(x, "=", k * h**2), {"energy": k * x**2 + m * rate(x) ** 2, "initial": Integer(0)}),
            ("place", Relation(x, "=", h), Relation(x, "=", 2 * h)),
        ),
        (
            "answers.equation_in_limit",
            Judged(0, {"letter": k, "to": h, "small": k - h, "kept": k, "order": 1}),
            ("small", k - h, k + h),
        ),
    ],
)
def test_another_letter_or_place_than_that_of_the_result_is_refused(
    rule: str, facts: Judged, named: tuple[str, Any, Any]
) -> None:
    role, right, wrong = named
    assert wrongly_named(rule, facts, {role: right}) is None
    assert wrongly_named(rule, facts, {role: wrong}) == role


# --- what a step returns beside its value ---


def test_the_rate_that_a_kept_momentum_returns_gives_the_value_that_it_keeps() -> None:
    """C (psi_dot + phi_dot cos theta) = C s, so psi_dot = s - phi_dot cos theta."""
    psi, theta, phi = (coordinate(name) for name in ("psi", "theta", "phi"))
    momentum = let("momentum", lambda: k * (psi.rate + phi.rate * cos(theta.symbol)), symbol="p")
    facts = Judged(0, {"momentum": momentum.value, "value": k * s, "coordinate": psi.symbol}, {"momentum": momentum})
    right = KeptMomentum(momentum.symbol, k * s, psi.symbol, s - phi.rate * cos(theta.symbol))
    wrong = replace(right, turning=s + phi.rate * cos(theta.symbol))
    assert wrongly_handed_on(facts, [right]) is None
    assert wrongly_handed_on(facts, [wrong]) is wrong


def test_the_letter_of_a_square_is_that_of_its_left_side() -> None:
    facts = Judged(k / m, symbol=scalar("omega_0") ** 2)
    assert wrongly_handed_on(facts, [SquareOf("omega_0")]) is None
    assert wrongly_handed_on(facts, [SquareOf("Omega")]) is not None


@pytest.mark.parametrize("energy", [k * x**2 / 2, k * (abs(x - l) - h) ** 2 / 2])
def test_a_slope_is_that_of_the_potential_that_its_symbol_shows(energy: Any) -> None:
    potential = let("energy", lambda: energy, symbol="U")
    own, other = Slope(potential.symbol, x, Integer(1)), Slope(w, x, Integer(1))
    right = energy.diff(x).doit()
    facts = Judged(right, quantities={"potential": potential}, symbol=own)
    assert stated_rightly("rest.slope", "slope", facts)
    assert not stated_rightly("rest.slope", "slope", replace(facts, result=2 * right))
    assert not stated_rightly("rest.slope", "slope", replace(facts, result=-right))
    assert not stated_rightly("rest.slope", "slope", replace(facts, symbol=other))
