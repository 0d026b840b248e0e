"""Small motions with forces linear in the rates: frames that turn, charges in fields, tops, and drag."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, I, ImmutableDenseMatrix, cos, exp, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.algebra.ranges import POSITIVE, within
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    charge,
    coordinate,
    damping,
    equations_of_motion,
    lagrangian,
    linear_stability,
    linearised,
    normal_modes,
    point,
    potential,
    potential_energy_of,
    space,
    stability,
    weight,
)
from derive.mechanics.vibrations import gyroscopic
from derive.solving import linear_systems
from derive.solving.linear_systems import Gyroscopic
from derive.steps.record import recorded
from derive.steps.step import Quantity

m, g, l, k, c, b, W, q, B, mu = symbols("m g l k c b Omega q B mu", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def plane() -> tuple[Any, Any]:
    return coordinate("x", "length"), coordinate("y", "length")


def small(*parts: Any) -> tuple[Quantity, ...]:
    return linearised(equations_of_motion(lagrangian(System(*parts))))


def on_table(energy: Callable[[Any, Any], Expr]) -> tuple[Quantity, ...]:
    x, y = plane()
    table = space.turned(Z, W * t)
    return small(Particle(m, table.place(x, y, 0)), potential(energy(x.symbol, y.symbol)))


def foucault() -> tuple[Quantity, ...]:
    return on_table(lambda x, y: m * (g / l + W**2) * (x**2 + y**2) / 2)


def in_field(stiffness: Expr) -> tuple[Quantity, ...]:
    x, y = plane()
    at = point(x, y)
    return small(Particle(m, at), potential(stiffness * (x.symbol**2 + y.symbol**2) / 2), charge(q, at, B=B))


def triangle_point() -> tuple[Quantity, ...]:
    """Small motions about a point that makes an equilateral triangle with two masses, of which mu is the share of one:
    the potential energy that is left of their attraction, to second order."""
    slant = sqrt(27) / 2 * (1 - 2 * mu)
    return on_table(lambda x, y: m * W**2 * (x**2 / 4 - 5 * y**2 / 4 - slant * x * y) / 2)


def values(found: tuple[Quantity, ...], kind: str) -> list[Any]:
    return [explicit(each.value) for each in found if each.key.startswith(kind)]


def outcomes(found: tuple[Quantity, ...], kind: str) -> list[str]:
    return [each.step.outcome for each in found if each.key.startswith(kind)]


def test_the_plane_of_foucaults_pendulum_turns_against_the_earth() -> None:
    """Landau, Lifshitz, *Mechanics*, section 39, problem 3; Taylor, *Classical Mechanics*, section 9.9."""
    found = normal_modes(foucault())
    root = sqrt(W**2 + g / l)
    slow, fast = values(found, "frequency")
    assert equal(slow, root - W) and equal(fast, root + W)
    assert outcomes(found, "frequency") == ["oscillating", "oscillating"]
    along, against = values(found, "mode")
    assert equal(along, ImmutableDenseMatrix([cos(slow * t), sin(slow * t)]))
    assert equal(against, ImmutableDenseMatrix([cos(fast * t), -sin(fast * t)]))
    assert outcomes(found, "mode") == ["circle_forwards", "circle_backwards"]


def test_a_magnetic_field_splits_the_frequency_of_a_bound_charge() -> None:
    """The effect that Zeeman found; Larmor's frequency q B/2m: Goldstein, section 5.9."""
    slow, fast = values(normal_modes(in_field(k)), "frequency")
    larmor = q * B / (2 * m)
    assert equal(slow, sqrt(k / m + larmor**2) - larmor)
    assert equal(fast, sqrt(k / m + larmor**2) + larmor)


def test_a_free_charge_circles_with_the_cyclotron_frequency() -> None:
    """Taylor, section 2.5: clockwise about the field for a positive charge."""
    x, y = plane()
    at = point(x, y)
    found = normal_modes(small(Particle(m, at), charge(q, at, B=B)))
    assert values(found, "frequency") == [0, q * B / m]
    assert outcomes(found, "frequency") == ["free", "oscillating"]
    assert outcomes(found, "mode") == ["circle_backwards"]


def test_a_field_holds_a_charge_on_a_hill_if_it_is_strong_enough() -> None:
    """Two frequencies meet where q^2 B^2 = 4 k m: as for the sleeping top, Goldstein, section 5.7."""
    linear = in_field(-k)
    found = linear_stability(linear)
    assert isinstance(found, Quantity) and found.step.outcome == "depends"
    assert found.value.operator == ">" and equal(found.value.left - found.value.right, q**2 * B**2 - 4 * k * m)
    assert outcomes(normal_modes(linear), "frequency") == ["conditional", "conditional"]


def test_a_potential_energy_that_knows_no_field_does_not_say_unstable() -> None:
    x, y = plane()
    at = point(x, y)
    hill = System(Particle(m, at), potential(-k * (x.symbol**2 + y.symbol**2) / 2), charge(q, at, B=B))
    with pytest.raises(Rejected, match="may stabilise"):
        stability(potential_energy_of(hill), {x: 0, y: 0})
    ridge = System(Particle(m, at), potential(-k * x.symbol**2 / 2), charge(q, at, B=B))
    with recorded(), pytest.raises(Rejected, match="may stabilise"):
        stability(potential_energy_of(ridge), {x: 0})


@pytest.mark.long
def test_a_table_turns_a_puck_off_between_its_two_frequencies() -> None:
    """(k - m W^2)(c - m W^2) > 0; the squares are real at all rates: (k - c)^2 + 8 (k + c) m W^2 > 0."""
    found = linear_stability(on_table(lambda x, y: (k * x**2 + c * y**2) / 2))
    assert isinstance(found, Quantity) and found.step.outcome == "depends"
    assert found.value.operator == ">" and equal(found.value.residual, (k - m * W**2) * (c - m * W**2))


def test_a_letter_of_which_only_the_sign_is_known_may_stand_in_a_field() -> None:
    with within({B: POSITIVE}):
        assert outcomes(normal_modes(in_field(k)), "frequency") == ["oscillating", "oscillating"]


def test_the_triangle_points_are_stable_for_unequal_masses() -> None:
    """Routh's condition 27 mu (1 - mu) < 1: Goldstein, section 3.12."""
    found = linear_stability(triangle_point())
    assert isinstance(found, tuple) and [each.step.outcome for each in found] == ["first", "last"]
    routh, share = (explicit(each.value) for each in found)
    assert routh.operator == ">" and equal(routh.left - routh.right, 1 - 27 * mu * (1 - mu))
    assert share.operator == ">" and equal(share.left - share.right, 1 - mu)


def test_an_isotropic_oscillator_seen_from_a_table_that_turns_is_always_stable() -> None:
    linear = on_table(lambda x, y: k * (x**2 + y**2) / 2)
    found = linear_stability(linear)
    assert isinstance(found, Quantity) and found.step.outcome == "stable"
    slow, fast = values(normal_modes(linear), "frequency")
    assert equal(fast, sqrt(k / m) + W) and equal(slow**2, (sqrt(k / m) - W) ** 2)


def test_a_saddle_that_turns_holds_a_particle() -> None:
    """k/m < Omega^2 for the saddle k (x^2 - y^2)/2 on a table that turns, as in Paul's trap seen from the table."""
    found = linear_stability(on_table(lambda x, y: k * (x**2 - y**2) / 2))
    assert isinstance(found, Quantity)
    residual = explicit(found.value.left - found.value.right) * (1 if found.value.operator == ">" else -1)
    assert bool(residual.subs({m: 1, k: 1, W: 2}) > 0)
    assert bool(residual.subs({m: 1, k: 4, W: 1}) < 0)


def carts(first: Expr, second: Expr) -> tuple[Quantity, ...]:
    x, y = plane()
    energy = k * x.symbol**2 / 2 + k * y.symbol**2 / 2 + c * (x.symbol - y.symbol) ** 2 / 2
    at = point(x, 0), point(y, 0)
    return small(Particle(m, at[0]), Particle(m, at[1]), potential(energy), damping(first, x), damping(second, y))


def test_equal_carts_with_equal_drag_move_in_two_damped_modes() -> None:
    """Landau, Lifshitz, *Mechanics*, section 25: each normal mode has its own damping where the modes separate."""
    found = normal_modes(carts(b, b))
    assert values(found, "decay") == [b / (2 * m)] * 2
    slow, fast = values(found, "frequency")
    assert equal(slow, sqrt(k / m - b**2 / (4 * m**2))) and equal(fast, sqrt((k + 2 * c) / m - b**2 / (4 * m**2)))
    assert outcomes(found, "frequency") == ["conditional", "conditional"]
    assert [tuple(each) for each in values(found, "mode")] == [(1, 1), (1, -1)]
    assert outcomes(found, "mode") == ["in_phase", "opposite"]


def test_carts_with_unequal_drag_do_not_separate() -> None:
    with pytest.raises(Rejected, match="with this drag 4 exponents are the roots"):
        normal_modes(carts(b, 2 * b))


def test_a_damped_pendulum_and_a_ball_in_a_medium() -> None:
    """Taylor, section 5.4 and section 2.1."""
    theta = coordinate("theta")
    at = point(l * sin(theta), -l * cos(theta))
    found = normal_modes(small(Particle(m, at), weight(g), damping(b, at)))
    assert [each.key for each in found] == ["decay", "frequency"]
    assert equal(found[0].value, b / (2 * m)) and equal(found[1].value, sqrt(g / l - b**2 / (4 * m**2)))
    with recorded():
        x = coordinate("x", "length")
        free, dying = normal_modes(small(Particle(m, point(x, 0)), damping(b, x)))
    assert free.key == "exponent_0" and equal(dying.value, b / m) and dying.step.outcome == "decay"


def test_two_equal_roots_are_critical_damping_and_have_no_frequency() -> None:
    x = coordinate("x", "length")
    spring = potential(k * x.symbol**2 / 2)
    (rate,) = normal_modes(small(Particle(m, point(x, 0)), spring, damping(2 * sqrt(k * m), x)))
    assert rate.step.outcome == "critical" and equal(rate.value, sqrt(k / m))


def test_drag_beside_turning_is_said_to_be_too_much_for_a_verdict() -> None:
    x, y = plane()
    at = point(x, y)
    hill = potential(-k * (x.symbol**2 + y.symbol**2) / 2)
    with pytest.raises(Rejected, match="there is also drag"):
        linear_stability(small(Particle(m, at), hill, charge(q, at, B=B), damping(b, at)))


WRONG: dict[str, tuple[Any, str, Any]] = {
    "a root too large": (linear_systems, "_with_root", lambda plain, before, root, by_terms: 2 * plain + root),
    "another sense": (gyroscopic, "_of_time", lambda entry, w, turn: _other_sense(entry, w, turn)),
    "a determinant without turning": (
        Gyroscopic,
        "at",
        lambda self, s: ImmutableDenseMatrix(self.stiffness + s**2 * self.mass),
    ),
}

_right = gyroscopic._of_time


def _other_sense(entry: Expr, w: Expr, turn: int) -> Expr:
    return _right(entry, w, -turn)


@pytest.mark.parametrize("slip", WRONG)
def test_a_wrong_law_is_refused(slip: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, name, wrong = WRONG[slip]
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unverified):
        normal_modes(foucault())


def test_a_wrong_condition_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gyroscopic, "positive", lambda need, *letter: Relation(q**2 * B**2, ">", 3 * k * m))
    with pytest.raises(Unverified):
        linear_stability(in_field(-k))


def test_springs_keep_their_modes() -> None:
    x, y = plane()
    linear = small(
        Particle(m, point(x, 0)),
        Particle(m, point(y, 0)),
        potential(k * x.symbol**2 / 2 + k * (x.symbol - y.symbol) ** 2 / 2 + k * y.symbol**2 / 2),
    )
    assert values(normal_modes(linear), "frequency") == [sqrt(k / m), sqrt(3 * k / m)]


def falling_along_the_field() -> tuple[Quantity, ...]:
    x, y = plane()
    z = coordinate("z", "length")
    hill = potential(k * (x.symbol**2 + y.symbol**2) / 2 - c * z.symbol**2 / 2)
    at = point(x, y, z)
    return small(Particle(m, at), hill, charge(q, at, B=(0, 0, B)))


def on_saddle() -> tuple[Quantity, ...]:
    x, y = plane()
    at = point(x, y)
    return small(Particle(m, at), potential(k * (x.symbol**2 - y.symbol**2) / 2), charge(q, at, B=B))


def growing(found: tuple[Quantity, ...]) -> tuple[Expr, Any]:
    rate = next(each for each in found if each.step.outcome == "growing")
    mode = next(each for each in found if each.step.outcome == "departing")
    return explicit(rate.value), explicit(mode.value)


def test_a_charge_runs_away_along_a_field_and_circles_across_it() -> None:
    found = normal_modes(falling_along_the_field())
    away = next(each for each in found if each.step.outcome == "growing")
    assert (str(away.symbol), away.step.rule) == ("kappa_z", "vibrations.uncoupled_frequency")
    assert equal(away.value, sqrt(c / m))
    assert sorted(outcomes(found, "mode")) == ["circle_backwards", "circle_forwards"]
    assert all(len(each.value) == 2 for each in found if each.key.startswith("mode"))


def test_on_a_saddle_a_field_turns_what_grows() -> None:
    """By hand, m y_ddot + q B x_dot - k y = 0 with e^(kappa t): y/x = q B kappa/(k - m kappa^2)."""
    rate, mode = growing(normal_modes(on_saddle()))
    assert equal(m**2 * rate**4 + q**2 * B**2 * rate**2, k**2)
    assert equal(mode[1] / mode[0], q * B * rate / (k - m * rate**2))


@pytest.mark.parametrize("motion", [cos, sin, lambda phase: exp(-phase), lambda phase: exp(2 * phase)])
def test_another_motion_than_one_that_grows_at_its_rate_is_refused(motion: Any, monkeypatch: Any) -> None:
    right = gyroscopic.exp
    monkeypatch.setattr(gyroscopic, "exp", lambda phase: right(phase) if phase.has(I) else motion(phase))
    with pytest.raises(Unverified):
        normal_modes(on_saddle())


def test_a_condition_has_no_number_that_stands_on_both_sides() -> None:
    told = [dict(each.step.roles) for each in normal_modes(in_field(-k)) if each.step.outcome == "conditional"]
    assert told and all(equal(each["condition_1"].residual, q**2 * B**2 - 4 * k * m) for each in told)
