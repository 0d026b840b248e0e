"""Small oscillations whose frequencies are known, and what does not oscillate."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, Rational, cos, pi, sin, sqrt

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from derive.errors import Rejected
from derive.mechanics import (
    coordinate,
    equation_of_motion,
    frequency,
    frequency_and_growth,
    frequency_squared,
    linearised,
)
from derive.steps.step import Quantity
from tests.mechanics.motion import THETA, X, b, g, l, m, motion, of_system, small_oscillations
from tests.mechanics.slab import I, M, R, a, known_slab

q, x = THETA.symbol, X.symbol
phi = coordinate("phi")
PENDULUM = (l * sin(q), -l * cos(q), THETA)


@pytest.mark.parametrize(
    ("system", "more", "squared"),
    [
        pytest.param(PENDULUM, {}, g / l, id="a pendulum"),
        pytest.param(
            (l / 2 * sin(q), -l / 2 * cos(q), THETA),
            {"inertia": m * l**2 / 12, "turning": THETA},
            3 * g / (2 * l),
            id="a rod hung from its end",
        ),
        pytest.param(
            (b * sin(q), -b * cos(q), THETA),
            {"inertia": m * b**2, "turning": THETA},
            g / (2 * b),
            id="a hoop hung from its rim",
        ),
        pytest.param((x, x**2 / (2 * b), X), {}, g / b, id="a bead on a parabola"),
        pytest.param((b * sin(x / b), -b * cos(x / b), X), {}, g / b, id="a bead on a hoop, by its arc"),
    ],
)
def test_the_frequency_is_the_known_one(system: Any, more: dict[str, Any], squared: Any) -> None:
    found = small_oscillations(*system, **more)
    assert equal(found.value, sqrt(squared))
    assert found.step.outcome == "stable"
    assert found.step.kind == "angular speed"


def test_on_a_cycloid_a_bead_swings_as_on_a_pendulum_of_four_radii() -> None:
    p = phi.symbol
    found = small_oscillations(b * (p - sin(p)), b * (1 + cos(p)), phi, at=pi)
    assert equal(found.value, sqrt(g / b) / 2)


def test_about_another_equilibrium_the_linear_equation_says_so() -> None:
    assert linearised(motion(*PENDULUM)).step.outcome == "generic"
    assert linearised(motion(*PENDULUM), at=pi).step.outcome == "displaced"


def test_a_pendulum_upside_down_grows_at_the_rate_at_which_it_would_swing() -> None:
    found = small_oscillations(*PENDULUM, at=pi)
    assert found.step.outcome == "unstable"
    assert found.symbol.name == "kappa"
    assert equal(found.value, sqrt(g / l))


def test_on_a_level_wire_nothing_oscillates() -> None:
    found = small_oscillations(x, 0, X)
    assert (found.value, found.step.outcome) == (0, "neutral")


def test_a_wire_that_is_flatter_than_a_parabola_leaves_the_first_order_empty() -> None:
    assert small_oscillations(x, x**4 / b**3, X).step.outcome == "neutral"


@pytest.mark.parametrize("place", [pi / 2, Rational(1)])
def test_what_is_no_equilibrium_is_refused(place: Any) -> None:
    with pytest.raises(Rejected) as refusal:
        linearised(motion(*PENDULUM), at=place)
    (complaint,) = refusal.value.complaints
    assert complaint.code == "no-equilibrium"
    assert complaint.message.startswith(f"`equation_of_motion` does not hold at rest at theta = {place}: ")


def test_an_equation_with_another_coordinate_is_refused() -> None:
    r = coordinate("r", "length")
    L = of_system(r.symbol * sin(q), -r.symbol * cos(q), r, THETA)
    with pytest.raises(Rejected, match="`equation_of_motion` also contains r, for which no equation is given"):
        linearised(equation_of_motion(L, THETA))


# --- the slab ---


def slab(key: str, **variant: Any) -> Quantity:
    return known_slab(**variant)[key]


def test_a_rectangular_slab_of_length_b_swings_at_the_known_rate() -> None:
    """omega_0^2 = 3 g (R - h)/(l^2 + 4 h^2) for a plank of length 2l and thickness 2h."""
    plank = slab("frequency", thickness=2 * a, inertia=M * (b**2 + a**2) / 3)
    assert equal(plank.value, sqrt(3 * g * (R - a) / (b**2 + 4 * a**2)))
    assert plank.step.outcome == "conditional"


def test_a_thin_slab_swings_about_its_middle_whatever_the_radius() -> None:
    thin = slab("frequency", thickness=Integer(0))
    assert thin.step.outcome == "stable"
    assert equal(thin.value, sqrt(M * g * R / I))


@pytest.mark.parametrize(("radius", "outcome"), [(2 * a, "stable"), (a / 4, "unstable"), (a / 2, "neutral")])
def test_what_the_slab_does_depends_on_its_radius(radius: Any, outcome: str) -> None:
    assert slab("frequency_squared", radius=radius).step.outcome == outcome
    assert slab("frequency", radius=radius).step.outcome == outcome
    same = {"neutral": "unstable_by_higher_order"}.get(outcome, outcome)
    assert slab("curvature", radius=radius).step.outcome == same


def test_the_frequency_is_positive_also_where_its_sign_could_not_be_told_from_the_motion() -> None:
    numbers = {R: 2, a: 1, M: 3, I: 5, g: 10}
    assert slab("frequency").value.subs(numbers) > 0
    squared = slab("frequency_squared").value.subs(numbers)
    assert slab("frequency").value.subs(numbers) ** 2 == squared


def test_a_frequency_has_the_letter_that_its_square_has() -> None:
    linear = linearised(motion(*PENDULUM))
    assert frequency(frequency_squared(linear, symbol="Omega")).symbol.name == "Omega"


def test_where_the_sign_is_open_a_rate_of_growth_stands_beside_the_frequency() -> None:
    swings, grows = frequency_and_growth(known_slab()["frequency_squared"])
    assert [each.step.outcome for each in (swings, grows)] == ["conditional", "growing"]
    assert equal(grows.value**2, M * g * (a / 2 - R) / (I + M * a**2 / 4))
    assert grows.symbol.name == "kappa"


@pytest.mark.parametrize(("radius", "letter"), [(2 * a, "omega_0"), (a / 4, "kappa")])
def test_where_the_sign_is_known_one_step_stands_for_both(radius: Any, letter: str) -> None:
    swings, grows = frequency_and_growth(known_slab(radius=radius)["frequency_squared"])
    assert swings is grows and swings.step.stands_for == ("growth_rate",)
    assert swings.symbol.name == letter


def test_small_angles_are_put_in_before_the_higher_orders_are_dropped() -> None:
    linear = known_slab()["linearised"]
    before, after = linear.step.chain
    assert before.because == "small_angles" and before.level == "full"
    shown = before.expr.left.args[0]
    assert not shown.has(sin, cos) and shown.has(THETA.rate)
    assert explicit(before.expr).residual.expand() == after.expr.residual.expand()
    told = dict(linear.step.roles)
    assert (told["sine"], told["cosine"]) == (sin(q), cos(q))
    dropped = {told["dropped_1"], told["dropped_2"]}
    assert dropped == {M * R**2 * q * THETA.rate**2, M * R**2 * q**2 * THETA.acceleration}


def test_what_has_no_small_angle_is_written_at_once() -> None:
    assert [form.because for form in linearised(motion(x, x**2 / (2 * b), X)).step.chain] == ["law"]
