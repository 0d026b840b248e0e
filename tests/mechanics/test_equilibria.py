"""States of rest and their stability, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol, acos, cos, pi, sin, sqrt, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Z,
    central,
    coordinate,
    equilibria,
    kinetic_energy_of,
    lagrangian,
    let,
    point,
    potential,
    potential_at_rest,
    potential_energy_of,
    space,
    spring,
    stability,
    weight,
)
from derive.mechanics.rest import equilibria as equilibria_module
from derive.mechanics.rest import stability as minima
from derive.solving.divisors import different_from_zero
from derive.solving.relations import positive
from derive.solving.zeros import Unsolved, Zero, zeros_of
from derive.steps.record import recorded
from derive.steps.signs import sign_where
from derive.steps.step import Quantity
from derive.witness.facts import Rest

m, M, g, l, k, a, R, w, G, S = symbols("m M g l k a R omega G S", positive=True)
theta, x = symbols("theta x", real=True)
r = Symbol("r", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def hoop() -> Quantity:
    q = coordinate("theta")
    place = space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q))
    return lagrangian(System(Particle(m, place), weight(g)))


def pendulum() -> tuple[Quantity, Any]:
    q = coordinate("theta")
    return potential_energy_of(System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g))), q


def sideways(height: Expr) -> tuple[Quantity, Any]:
    q = coordinate("x", "length")
    bead = point(q, 0)
    return lagrangian(System(Particle(m, bead), spring(k, point(0, height), bead, l))), q


def values(found: tuple[Quantity, ...]) -> list[Any]:
    return [q.value for q in found]


def roles(found: Quantity) -> dict[str, Any]:
    return dict(found.step.roles)


def test_a_bead_on_a_turning_hoop_has_four_places_of_rest() -> None:
    """Taylor, example 7.6: 0 and pi, and cos theta = g/(omega^2 R) where omega^2 > g/R."""
    found = equilibria(hoop())
    tilted = acos(g / (R * w**2))
    assert values(found) == [0, pi, tilted, -tilted]
    assert [q.step.outcome for q in found] == ["always", "always", "where", "where"]
    assert [str(q.symbol) for q in found] == ["theta_1", "theta_2", "theta_3", "theta_4"]
    assert all(equal(q.needed(Rest).exists, Relation(w**2, ">", g / R)) for q in found[2:])


def test_the_lowest_place_on_the_hoop_is_stable_if_it_turns_slowly_and_on_the_border() -> None:
    """Taylor, section 7.6; on the border omega^2 = g/R, V = m g R theta^4/8 + const, so V'''' = 3 m g R."""
    L = hoop()
    low, top, tilted, other = (stability(L, at) for at in equilibria(L))
    assert low.step.outcome == "depends_stable_on_border"
    assert equal(roles(low)["condition"], Relation(w**2, "<", g / R))
    assert equal(roles(low)["higher"], 3 * m * g * R)
    assert (top.step.outcome, tilted.step.outcome, other.step.outcome) == ("unstable", "stable", "stable")
    assert equal(tilted.value, m * (R**2 * w**4 - g**2) / w**2)


def test_a_pendulum_hangs_stably_and_stands_unstably() -> None:
    U, _ = pendulum()
    down, up = equilibria(U)
    assert values((down, up)) == [0, pi]
    assert [stability(U, at).step.outcome for at in (down, up)] == ["stable", "unstable"]


def test_stability_at_a_place_that_the_script_gives() -> None:
    U, q = pendulum()
    found = stability(U, {q: 0})
    assert (found.value, found.step.outcome, found.key) == (m * g * l, "stable", "stability")


def test_an_inverted_pendulum_held_by_a_spring_stands_if_the_spring_is_stiff() -> None:
    """U = m g l cos theta + (1/2) k a^2 sin^2 theta: at 0 the curvature is k a^2 - m g l."""
    q = coordinate("theta")
    top, joint = point(l * sin(q), l * cos(q)), point(a * sin(q), 0)
    U = potential_energy_of(System(Particle(m, top), weight(g), spring(k, point(0, 0), joint, massless=True)))
    up, down, *tilted = equilibria(U)
    assert values((up, down)) == [0, pi]
    found = stability(U, up, letter=k)
    assert equal(found.value, k * a**2 - m * g * l)
    assert equal(roles(found)["condition"], Relation(k, ">", m * g * l / a**2))
    assert found.step.outcome == "depends_unstable_on_border"
    assert [stability(U, each).step.outcome for each in (down, *tilted)] == ["stable", "unstable", "unstable"]


def test_a_particle_circles_a_centre_where_its_effective_potential_is_least() -> None:
    """Goldstein, section 3.3: r = L^2/(G M m^2), with V = L^2/(2 m r^2) - G M m/r."""
    q = coordinate("r", "length", positive=True)
    V = let("V", lambda: S**2 / (2 * m * q.symbol**2) - G * M * m / q.symbol, kind="energy")
    (circle,) = equilibria(V, q)
    assert equal(circle.value, S**2 / (G * M * m**2))
    assert (circle.step.outcome, str(circle.symbol)) == ("only", "r_0")
    found = stability(V, circle)
    assert found.step.outcome == "stable"
    assert equal(found.step.chain[-1].expr, S**2 / (m * circle.symbol**4)), (
        "the place of a derivative is a natural quantity"
    )


def test_a_bead_on_a_wire_with_a_stretched_spring_has_rest_beside_the_middle() -> None:
    """Strogatz, section 3.5: x = 0, and x = +-sqrt(l^2 - a^2) where the spring is longer than the distance."""
    L, _ = sideways(a)
    found = equilibria(L)
    assert values(found) == [0, sqrt(l**2 - a**2), -sqrt(l**2 - a**2)]
    assert [stability(L, at).step.outcome for at in found] == ["depends_stable_on_border", "stable", "stable"]


def test_a_spring_just_as_long_as_the_distance_holds_by_a_higher_order() -> None:
    """U = (1/2) k (sqrt(l^2 + x^2) - l)^2 = k x^4/(8 l^2) + ..., so U'''' = 3 k/l^2."""
    L, q = sideways(l)
    found = stability(L, {q: 0})
    assert found.step.outcome == "stable_by_higher_order"
    assert equal(roles(found)["higher"], 3 * k / l**2)


def test_two_masses_hang_on_springs_in_one_place() -> None:
    x_, y_ = coordinate("x", "length"), coordinate("y", "length")
    upper, lower = point(0, -l - x_), point(0, -2 * l - y_)
    springs = spring(k, point(0, 0), upper, l), spring(k, upper, lower, l)
    U = potential_energy_of(System(Particle(m, upper), Particle(m, lower), weight(g), *springs))
    (rest,) = equilibria(U)
    assert list(rest.value) == [2 * m * g / k, 3 * m * g / k]
    minors = stability(U, rest)
    assert (list(minors.value), minors.step.outcome) == ([2 * k, k**2], "stable")


def test_a_double_pendulum_has_four_states_of_rest_of_which_one_is_stable() -> None:
    p, q = coordinate("theta"), coordinate("phi")
    upper = point(l * sin(p), -l * cos(p))
    lower = upper + point(l * sin(q), -l * cos(q))
    L = lagrangian(System(Particle(m, upper), Particle(m, lower), weight(g)))
    found = equilibria(L)
    assert [list(each.value) for each in found] == [[0, 0], [0, pi], [pi, 0], [pi, pi]]
    assert [stability(L, at).step.outcome for at in found] == ["stable", "unstable", "unstable", "unstable"]


def test_a_cart_may_be_anywhere_when_its_pendulum_hangs() -> None:
    x_, q = coordinate("x", "length"), coordinate("theta")
    bob = point(x_ + l * sin(q), -l * cos(q))
    L = lagrangian(System(Particle(M, point(x_, 0)), Particle(m, bob), weight(g)))
    found = equilibria(L)
    assert values(found) == [0, pi]
    assert all(set(each.needed(Rest).values) == {q.symbol} for each in found)


def test_a_system_at_rest_sees_its_potential_energy_less_what_the_given_motion_has() -> None:
    """V = -m g R cos theta - (1/2) m R^2 omega^2 sin^2 theta (Landau, Lifshitz, section 39)."""
    found = potential_at_rest(hoop())
    q = next(iter(found.coordinates))
    assert equal(found.value, -m * g * R * cos(q) - m * R**2 * w**2 * sin(q) ** 2 / 2)


def test_an_energy_without_rates_is_its_own_potential_energy_at_rest() -> None:
    U, _ = pendulum()
    assert potential_at_rest(U) is U


@pytest.mark.parametrize(
    ("force", "q", "expected"),
    [
        (m * g - k * x, x, [m * g / k]),
        (k * x**3 - a * x, x, [0, sqrt(a / k), -sqrt(a / k)]),
        (k * x**2 + a, x, []),
        (-(S**2) / (m * r**3) + G * M * m / r**2, r, [S**2 / (G * M * m**2)]),
        (m * g * cos(theta) - k * sin(theta), theta, "atan"),
        (2 * cos(theta) - 1, theta, [pi / 3, -pi / 3]),
        (2 * cos(theta) - 3, theta, []),
        (cos(2 * theta) - cos(theta), theta, [0, 2 * pi / 3, -2 * pi / 3]),
        (sin(theta / 2) * (1 + cos(theta / 2)), theta, [0]),
        (tan(theta), theta, [0, pi]),
    ],
)
def test_all_zeros_of_a_force_are_found(force: Expr, q: Symbol, expected: Any) -> None:
    found = [zero.value for zero in zeros_of(force, q)]
    if expected == "atan":
        assert len(found) == 2 and all(equal(force.subs(q, value), 0) for value in found)
    else:
        assert len(found) == len(expected) and all(
            equal(p, Integer(0) + e) for p, e in zip(found, expected, strict=True)
        )


@pytest.mark.parametrize("force", [k * x - m * g * sin(x), cos(theta) + sin(theta) - 1 / a, x**7 + a * x + k])
def test_a_force_whose_zeros_have_no_closed_form_is_left_unsolved(force: Expr) -> None:
    with pytest.raises(Unsolved):
        zeros_of(force, theta if force.has(theta) else x)


def wrong(case: str) -> Any:
    q, p = coordinate("x", "length"), coordinate("theta")
    free = System(Particle(m, point(0, q)), weight(g))
    match case:
        case "never":
            return equilibria(potential_energy_of(free))
        case "no closed form":
            bead = System(
                Particle(m, point(a * p, a * cos(p))), weight(g), spring(k, point(0, 0), point(0, a * p), massless=True)
            )
            return equilibria(potential_energy_of(bead))
        case "no energy":
            return equilibria(let("v", lambda: a * p.symbol))
        case "stranger":
            return equilibria(pendulum()[0], q)
        case "time":
            height = R * cos(w * t)
            return equilibria(lagrangian(System(Particle(m, point(l * sin(p), height - l * cos(p))), weight(g))))
        case "not level":
            U, angle = pendulum()
            return stability(U, {angle: pi / 2})
        case "of another":
            return stability(potential_energy_of(free, symbol="W", key="other"), equilibria(pendulum()[0])[0])
        case _:
            bob = point(q + l * sin(p), -l * cos(p))
            held = System(Particle(m, bob), weight(g), spring(k, point(0, 0), point(q, 0)))
            return stability(potential_energy_of(held), {q: 0})


@pytest.mark.parametrize(
    ("case", "said"),
    [
        ("never", "has no equilibrium"),
        ("no closed form", "not found in closed form"),
        ("no energy", "needs an energy"),
        ("stranger", "does not depend on x"),
        ("time", "contains the time explicitly"),
        ("not level", "is not stationary at theta = pi/2: its derivative with respect to theta is g\\*l\\*m"),
        ("of another", "is not an equilibrium of"),
        ("missing", "the value of theta at equilibrium is unknown"),
    ],
)
def test_wrong_questions_about_rest_are_refused(case: str, said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong(case)


def test_zeros_that_are_lost_or_made_up_are_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    U, _ = pendulum()
    monkeypatch.setattr(equilibria_module, "zeros_of", lambda force, q: [Zero(Integer(0))])
    with pytest.raises(Unverified, match="counted"):
        equilibria(U)
    monkeypatch.setattr(equilibria_module, "zeros_of", lambda force, q: [Zero(Integer(0)), Zero(pi / 2)])
    with pytest.raises(Unverified, match="no_force"):
        equilibria(U)


def test_a_curvature_of_the_wrong_sign_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    U, q = pendulum()
    right = minima.Place.second
    monkeypatch.setattr(minima.Place, "second", lambda self, *those: -right(self, *those))
    with pytest.raises(Unverified):
        stability(U, {q: 0})


def test_a_condition_of_the_wrong_sense_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    L = hoop()
    low = equilibria(L)[0]
    right = minima.positive
    monkeypatch.setattr(minima, "positive", lambda value, *more: right(-value, *more))
    with pytest.raises(Unverified):
        stability(L, low)


def test_energies_in_play_are_those_of_the_verbs() -> None:
    q = coordinate("r", "length", positive=True)
    d = Symbol("d", positive=True)
    system = System(Particle(m, point(q, 0)), central(k * (d - l) ** 2 / 2, d, point(0, 0), point(q, 0)))
    (rest,) = equilibria(potential_energy_of(system))
    assert rest.value == l
    with pytest.raises(Rejected):
        equilibria(kinetic_energy_of(system))


def test_a_quotient_has_the_sign_of_its_denominator_too() -> None:
    """A carriage on a turning beam, held by a spring: Goldstein, problem 2.21. It has a place where k > m omega^2."""
    found = positive(k * a / (k - m * w**2))
    assert found == Relation(w**2, "<", k / m)
    assert positive((a - R) / (k - m * w**2), letter=None).operator == ">"
    assert sign_where((a - R) / (k - m * w**2), None) is None
    assert different_from_zero((a - R) / (k - m * w**2)) == Relation(a, "!=", R)


phi = Symbol("phi", real=True)


def upright() -> Quantity:
    one, other = coordinate("theta"), coordinate("phi")
    places = point(l * sin(one), l * cos(one)), point(a + l * sin(other), l * cos(other))
    bobs = (Particle(mass, place) for mass, place in zip((m, M), places, strict=True))
    return potential_energy_of(System(*bobs, weight(g), spring(k, *places, a)))


def test_a_spring_between_two_upright_pendulums_does_not_hold_them() -> None:
    found = stability(upright(), {theta: 0, phi: 0})
    assert found.step.outcome == "unstable_along"
    assert equal(roles(found)["falling"], -(m + M) * g * l)


def test_a_direction_in_which_nothing_is_stretched_is_found_for_other_lengths() -> None:
    """By hand: l theta = R phi, and U'' = -m g l R^2 - M g R l^2 along it."""
    one, other = coordinate("theta"), coordinate("phi")
    heights = m * g * l * cos(one) + M * g * R * cos(other)
    energy = heights + k * (l * sin(one) - R * sin(other)) ** 2 / 2
    bobs = Particle(m, point(l * sin(one), 0)), Particle(M, point(R * sin(other), 0))
    told = roles(stability(potential_energy_of(System(*bobs, potential(energy))), {theta: 0, phi: 0}))
    first, second = explicit(told["direction"])
    assert equal(first * l, second * R)
    assert equal(told["falling"], -m * g * l * first**2 - M * g * R * second**2)


@pytest.mark.parametrize("way", [(1, -1), (1, 2), (-1, -2)])
def test_a_direction_in_which_the_energy_does_not_always_fall_is_refused(way: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(minima, "_way_down", lambda matrix: ImmutableDenseMatrix(way))
    with pytest.raises(Unverified):
        stability(upright(), {theta: 0, phi: 0})


def test_another_fall_than_that_of_the_direction_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    right = minima._falling

    def wrong(*those: Any) -> dict[str, tuple[Any, Any]]:
        told = right(*those)
        return {**told, "falling": tuple(3 * each for each in told["falling"])}

    monkeypatch.setattr(minima, "_falling", wrong)
    with pytest.raises(Unverified):
        stability(upright(), {theta: 0, phi: 0})


def on_turning_rod() -> Quantity:
    q = coordinate("r", "length", positive=True)
    rod = space.turned(Z, w * t)
    at = rod.place(q + 0, 0, 0)
    return lagrangian(System(Particle(m, at), spring(k, rod.place(0, 0, 0), at, a)))


def test_a_distance_at_rest_exists_where_it_is_positive() -> None:
    """k (r - a) = m omega^2 r: r = k a/(k - m omega^2) for omega^2 < k/m."""
    (rest,) = equilibria(on_turning_rod())
    assert equal(rest.value, k * a / (k - m * w**2))
    assert rest.step.outcome == "where"
    condition = roles(rest)["exists"]
    assert condition.operator == "<" and equal(condition.residual, w**2 - k / m)
    assert stability(on_turning_rod(), rest).step.outcome == "stable"


@pytest.mark.parametrize("slip", [-1, 2, None])
def test_a_distance_that_is_no_rest_or_has_no_condition_is_refused(slip: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    value, exists = k * a / (k - m * w**2), Relation(w**2, "<", k / m)
    wrong = Zero(value) if slip is None else Zero(slip * value, exists)
    monkeypatch.setattr(equilibria_module, "zeros_of", lambda force, q: [wrong])
    with pytest.raises(Unverified):
        equilibria(on_turning_rod())
