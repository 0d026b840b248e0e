"""What carries a result on to what is asked: the values of the textbooks, boundary cases, wrong questions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Abs, Eq, Expr, Integer, Rational, cos, exp, log, oo, pi, sin, sqrt, symbols, tan

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation
from derive.algebra.ranges import Range
from derive.algebra.ranges import within as declared
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    coordinate,
    equations_of_motion,
    kinetic_energy_of,
    lagrangian,
    leaves_contact,
    let,
    limiting_case,
    maximum,
    minimum,
    period_by_energy,
    point,
    potential,
    potential_energy_of,
    put_in,
    roots,
    solution,
    solved_for,
    speed_from_energy,
    spring,
    steady_amplitude,
    unknown,
    weight,
    where,
)
from derive.mechanics.answers import roots as roots_module
from derive.solving.zeros import Zero
from derive.steps.record import Run, assume, recorded
from derive.steps.step import Quantity

m, M, g, l, k, R, h, b, F = symbols("m M g l k R h b F", positive=True)
m1, m2, w, w0, ga, x0, v0, u, mu = symbols("m_1 m_2 omega omega_0 gamma x_0 v_0 u mu", positive=True)
G, ell = symbols("G ell", positive=True)
alpha, theta0, c = symbols("alpha theta_0 c", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def given(value: Expr, key: str = "f", **more: Any) -> Quantity:
    return let(key, lambda: value, **more)


def equation(left: Any, right: Any = 0, key: str = "equation") -> Quantity:
    return let(key, lambda: Relation(left, "=", right))


def values(*quantities: Quantity) -> list[Any]:
    return [quantity.value for quantity in quantities]


def along(name: str = "x") -> Coordinate:
    return coordinate(name, "length")


def energy_of(system: System) -> Quantity:
    kinetic, potential = kinetic_energy_of(system), potential_energy_of(system)
    return let("energy", lambda T, U: T + U, kinetic, potential, symbol="E", kind="energy")


# --- equations solved ---


def atwood() -> tuple[Quantity, ...]:
    x, tension = along(), unknown("S", "force")
    first = equation(m1 * x.acceleration, m1 * g - tension, "first")
    second = equation(m2 * x.acceleration, tension - m2 * g, "second")
    return solved_for((first, second), x.acceleration, tension)


def test_the_acceleration_and_the_tension_of_atwoods_machine() -> None:
    """Kleppner, Kolenkow, example 3.8: the acceleration and the tension."""
    a, tension = atwood()
    assert values(a, tension) == [g * (m1 - m2) / (m1 + m2), 2 * g * m1 * m2 / (m1 + m2)]
    assert [q.step.kind for q in (a, tension)] == ["acceleration", "force"]
    assert [q.step.outcome for q in (a, tension)] == ["several", "following"]


def test_the_accelerations_of_a_block_and_its_wedge() -> None:
    """Taylor, example 7.5."""
    x, s = along("x"), along("s")
    places = point(x, 0), point(x + s * cos(alpha), -s * sin(alpha))
    L = lagrangian(System(Particle(M, places[0]), Particle(m, places[1]), weight(g)))
    wedge, block = solved_for(equations_of_motion(L), x.acceleration, s.acceleration)
    assert equal(block.value, g * sin(alpha) / (1 - m * cos(alpha) ** 2 / (M + m)))
    assert "excluded" not in dict(wedge.step.roles)  # M + m sin^2 is never zero
    assert equal(limiting_case(block, M, oo, key="heavy").value, g * sin(alpha))
    assert equal(limiting_case(wedge, M, 0, key="light").value, -g * cos(alpha) / sin(alpha))


def test_the_root_of_a_square_is_drawn_in_a_limit() -> None:
    width = given(sqrt((l + R) ** 2 - 4 * l * R + M * l * R / m))
    assert limiting_case(width, M, 0).value == Abs(l - R)


def test_what_is_divided_by_is_told_where_it_may_vanish() -> None:
    x = along()
    (found,) = solved_for(equation((k - m * w**2) * x.symbol, F), x)
    assert found.value == F / (k - m * w**2)
    assert dict(found.step.roles)["excluded"] == Relation(k - m * w**2, "!=", 0)


def test_a_square_of_a_rate_and_a_cosine_are_unknowns() -> None:
    q = coordinate("theta")
    (square,) = solved_for(equation(m * R * q.rate**2 / 2, m * g * (1 - cos(q.symbol))), q.rate**2)
    assert equal(square.value, 2 * g * (1 - cos(q.symbol)) / R)
    (cosine,) = solved_for(equation(w**2 * R * cos(q.symbol), g, "rest"), cos(q.symbol))
    assert cosine.value == g / (R * w**2)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda x, y: solved_for(equation(x.symbol + y.symbol, h), x, y), "1 equation for 2 unknowns"),
        (lambda x, y: solved_for(equation(x.symbol**2 + x.symbol, h), x), "not linear in x"),
        (lambda x, y: solved_for((equation(x.symbol + y.symbol, h, "a"),) * 2, x, y), "do not determine x, y"),
        (lambda x, y: solved_for(given(h), x), "needs an equation"),
        (lambda x, y: solved_for(equation(x.symbol + x.rate**3, h), x.rate**2), "contains x_dot outside"),
        (lambda x, y: solved_for(equation(x.symbol, h), x.symbol * y.symbol), "must be a symbol"),
        (lambda x, y: solved_for(equation(x.symbol, h), x, keys=["a", "b"]), "as many keys"),
        (lambda x, y: unknown("S", "farce"), "no kind `farce`"),
        (lambda x, y: let("e", lambda: Eq(h, h)), "always equal"),
        (lambda x, y: let("e", lambda: Eq(h, -h)), "never equal"),
        (lambda x, y: let("e", lambda: Eq(x.symbol, h), kind="length"), "has neither a symbol nor a kind"),
    ],
)
def test_what_cannot_be_solved_is_refused(wrong: Callable[..., Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong(along("x"), along("y"))


# --- roots ---


def test_the_turning_points_of_a_kepler_orbit() -> None:
    """Goldstein, section 3.7: r = (G M m/2E)(1 +- sqrt(1 - 2 E l^2/(G^2 M^2 m^3))) for the energy -E."""
    r, E = coordinate("r", "length", positive=True), symbols("E", positive=True)
    turning = equation(ell**2 / (2 * m * r.symbol**2) - G * M * m / r.symbol, -E)
    near, far = roots(turning, r, symbols=["r_min", "r_max"])
    half = G * M * m / (2 * E)
    for found, sign in ((near, -1), (far, 1)):
        assert equal(found.value, half + sign * half * sqrt(1 - 2 * E * ell**2 / (G**2 * M**2 * m**3)))
    assert dict(near.step.roles)["condition"].operator == ">="
    assert near.step.kind == "length"


def test_a_positive_letter_keeps_its_positive_roots() -> None:
    r = coordinate("r", "length", positive=True)
    (found,) = roots(equation(r.symbol**2 + 2 * R * r.symbol - h**2), r)
    assert equal(found.value, sqrt(R**2 + h**2) - R)
    assert found.step.outcome == "only"


def test_of_two_opposite_roots_a_positive_letter_has_one_under_a_condition() -> None:
    """m r^2 = c k: the root that is positive, for c > 0, and no other."""
    r = coordinate("r", "length", positive=True)
    (found,) = roots(equation(m * r.symbol**2 - c * k), r)
    assert (found.step.outcome, found.value) == ("only", sqrt(c * k / m))
    condition = dict(found.step.roles)["condition"]
    assert condition.operator == ">" and equal(condition.residual, c)


@pytest.mark.parametrize("mark", ["<", "<="])
def test_another_condition_of_a_positive_root_is_refused(mark: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(roots_module, "_condition", lambda root, unknown: Relation(c, mark, 0))
    r = coordinate("r", "length", positive=True)
    with pytest.raises(Unverified):
        roots(equation(m * r.symbol**2 - c * k), r)


def test_a_cubic_equation_is_solved_where_it_factors() -> None:
    x = along()
    found = roots(equation(x.symbol**3 - 3 * R * x.symbol**2 + 2 * R**2 * x.symbol), x)
    assert sorted(values(*found), key=str) == [0, 2 * R, R]
    with pytest.raises(Rejected, match="has an unsolved factor of degree"):
        roots(equation(x.symbol**3 + R * x.symbol**2 + h**3, key="other"), x)


@pytest.mark.parametrize(
    ("left", "outcome", "expected"),
    [
        (lambda x: x**2 - 2 * R * x + R**2, "double", R),
        (lambda x: k * x - m * g, "single", g * m / k),
        (lambda x: x**2 + R**2, "none", None),
    ],
)
def test_double_single_and_missing_roots_are_called_so(
    left: Callable[[Expr], Expr], outcome: str, expected: Expr | None
) -> None:
    x = along()
    (found,) = roots(equation(left(x.symbol)), x)
    assert found.step.outcome == outcome
    assert expected is None or equal(found.value, expected)
    assert expected is not None or found.value.operator == "<"


def test_where_no_root_is_positive_it_is_said() -> None:
    r = coordinate("r", "length", positive=True)
    (absent,) = roots(equation((r.symbol + R) * (r.symbol + h)), r)
    assert absent.step.outcome == "none_positive"
    assert str(absent.value.operator) == "<"


def test_the_cosine_of_a_conical_pendulum_is_that_of_an_angle_where_it_turns_fast_enough() -> None:
    """Taylor, problem 7.38 and Morin, problem 6.1: cos(theta) = g/(l Omega^2), for l Omega^2 > g only."""
    theta, l, rate = coordinate("theta"), *symbols("l Omega", positive=True)
    angle = theta.symbol
    (found,) = roots(equation((g - l * rate**2 * cos(angle)) * sin(angle)), cos(angle))
    assert equal(found.value, g / (l * rate**2))
    assert equal(dict(found.step.roles)["existing"], Relation(l * rate**2, ">", g))
    (level,) = roots(equation(g - l * rate**2 * cos(angle), key="not_divided"), cos(angle), keys=["level"])
    assert dict(level.step.roles)["existing"].operator == ">="


@pytest.mark.parametrize(("bound", "mark"), [(2, ">"), (-2, "<")])
def test_no_angle_has_a_cosine_beyond_one(bound: int, mark: str) -> None:
    theta = coordinate("theta")
    (absent,) = roots(equation(cos(theta.symbol) - bound), cos(theta.symbol))
    assert absent.step.outcome == "none_reached"
    assert absent.value.operator == mark


# --- results put in ---


def test_a_particle_leaves_a_sphere_at_two_thirds() -> None:
    """Morin, problem 5.3: cos(theta) = 2/3."""
    q = coordinate("theta")
    system = System(Particle(m, point(R * sin(q), R * cos(q))), weight(g))
    rate = speed_from_energy(energy_of(system), q, 0)
    assert equal(rate.value, 2 * g * (1 - cos(q.symbol)) / R)
    N = given(m * g * cos(q.symbol) - m * R * q.rate**2, "normal", symbol="N", kind="force")
    pushing = put_in(N, rate)
    assert pushing.value == m * g * (3 * cos(q.symbol) - 2)
    assert leaves_contact(pushing, cos(q.symbol), 1).value == Relation(cos(q.symbol), "=", Rational(2, 3))
    assert put_in(pushing, theta=pi / 3).value == -m * g / 2
    with pytest.raises(Rejected, match="not known to be positive"):
        leaves_contact(pushing, cos(q.symbol), 0, key="beyond")


def test_a_loop_needs_a_start_at_five_halves_of_its_radius() -> None:
    """Kleppner, Kolenkow, problem 5.1; the speed at the top from the start at the height h."""
    N = given(m * (2 * g * (h - 2 * R)) / R - m * g, "at_top", symbol="N")
    assert where(N, ">=", 0, h).value == Relation(h, ">=", Rational(5, 2) * R)


def test_a_function_of_other_coordinates_takes_its_rates_along() -> None:
    x, q = along(), coordinate("theta")
    (rolling,) = solved_for(equation(x.symbol, R * q.symbol, "rolling"), x)
    energy = given(m * x.rate**2 / 2 + m * x.acceleration * x.symbol, "energy")
    found = put_in(energy, rolling)
    assert equal(found.value, m * R**2 * q.rate**2 / 2 + m * R**2 * q.acceleration * q.symbol)


def test_an_equation_that_then_holds_by_itself_is_told() -> None:
    x = along()
    (found,) = solved_for(equation(k * x.symbol, m * g), x)
    assert put_in(equation(2 * k * x.symbol, 2 * m * g, "twice"), found).step.outcome == "identity"


def test_an_equation_of_motion_at_rest() -> None:
    v = coordinate("v", "speed")
    falling = equation(m * v.rate, m * g - b * v.symbol)
    (terminal,) = solved_for(put_in(falling, {v.rate: 0}), v)
    assert terminal.value == m * g / b


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda x, f: put_in(f, y=0), "does not contain y"),
        (lambda x, f: put_in(f, x=0.5), "must be an exact expression"),
        (lambda x, f: put_in(f, given(h, "other", symbol="zeta")), "substituting `other` would not change `f`"),
        (lambda x, f: put_in(f, equation(x.symbol + x.rate, h)), "is not solved for a letter"),
        (lambda x, f: put_in(f, let("c", lambda: Relation(x.symbol, "<", h))), "is not an equation for a letter"),
        (lambda x, f: put_in(equation(x.symbol, h), {x: 2 * h}), "cannot hold"),
    ],
)
def test_what_cannot_be_put_in_is_refused(wrong: Callable[..., Any], said: str) -> None:
    x = along()
    with pytest.raises(Rejected, match=said):
        wrong(x, given(x.symbol**2 + R * x.symbol))


# --- conditions ---


@pytest.mark.parametrize(
    ("value", "mark", "letter", "expected"),
    [
        (2 * h - 5 * R, "<", h, Relation(h, "<", Rational(5, 2) * R)),
        (R - h, ">", h, Relation(h, "<", R)),
        (c + R, ">", c, Relation(c, ">", -R)),
        (-k * (c + R), ">=", c, Relation(c, "<=", -R)),
        (w**2 * R - g, ">", w, Relation(w, ">", sqrt(g / R))),
        (m1 - m2, "=", m1, Relation(m1, "=", m2)),
        (c**2 - R**2, "<", c, Relation(c**2, "<", R**2)),
    ],
)
def test_conditions_are_solved_also_with_negative_bounds(
    value: Expr, mark: str, letter: Expr, expected: Relation
) -> None:
    found = where(given(value), mark, 0, letter)
    assert found.value.operator == expected.operator
    assert found.value.left == expected.left
    assert equal(found.value.right, expected.right)


def test_two_quantities_are_compared() -> None:
    left, right = given(m1 * g * R, "left"), given(m2 * g * h, "right")
    assert where(left, ">", right, R).value == Relation(R, ">", h * m2 / m1)


@pytest.mark.parametrize(("mark", "outcome"), [(">", "always"), ("<=", "never"), ("!=", "always")])
def test_what_holds_whatever_the_letters_are_is_called_so(mark: str, outcome: str) -> None:
    assert where(given(R + h), mark, 0, R).step.outcome == outcome


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: where(given(R**3 + R - h), ">", 0, R),
        lambda: where(given(c * R - h), ">", 0, R),
        lambda: where(given(R - h), "==", 0, R),
        lambda: where(equation(c, h), ">", 0, c),
        lambda: leaves_contact(given(c**2 - R**2), c, 2 * R),
    ],
)
def test_conditions_that_one_letter_does_not_solve_are_refused(wrong: Callable[[], Any]) -> None:
    with pytest.raises(Rejected):
        wrong()


# --- limiting cases, extrema ---


def test_limiting_cases_have_their_order() -> None:
    a, tension = atwood()
    heavy = limiting_case(tension, m1, oo, 1)
    assert equal(heavy.value, 2 * m2 * g * (1 - m2 / m1))
    assert (heavy.step.outcome, heavy.step.grade) == ("large", Grade.APPROXIMATION)
    assert limiting_case(a, m1, oo).value == g
    nearly = limiting_case(a, m1, m2, key="nearly")
    assert equal(nearly.value, g * (m1 - m2) / (2 * m2))
    assert nearly.step.outcome == "vanishes"


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: limiting_case(given(R), h), "does not contain h"),
        (lambda: limiting_case(given(log(h)), h), "no expansion"),
        (lambda: limiting_case(given(1 / h), oo, 1), "must be a symbol"),
        (lambda: limiting_case(given(h**2), h, 0, 1), "no term up to the order 1"),
    ],
)
def test_what_has_no_limiting_case_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


def test_a_throw_reaches_farthest_at_half_a_right_angle() -> None:
    """Kleppner, Kolenkow, example 1.11, and problem 1.22 up a slope."""
    reach = given(2 * v0**2 * sin(theta0) * cos(theta0) / g, symbol="X")
    assert values(*maximum(reach, theta0, within=(0, pi / 2))) == [pi / 4, v0**2 / g]


def test_a_throw_up_a_slope_reaches_farthest_halfway_to_the_vertical() -> None:
    """Morin, problem 3.16: v^2/(g (1 + sin(alpha))) along a slope alpha."""
    up = 2 * v0**2 * cos(theta0) * sin(theta0 - alpha) / (g * cos(alpha) ** 2)
    place, reach = maximum(given(up, symbol="X"), theta0, within=(alpha, pi / 2))
    assert equal(place.value, alpha / 2 + pi / 4)
    assert equal(reach.value, v0**2 / (g * (1 + sin(alpha))))


def test_a_physical_pendulum_swings_fastest_from_one_distance() -> None:
    """Fowles, Cassiday, section 8.4: a rod of length l from l/sqrt(12) off its middle."""
    place, _ = minimum(given((l**2 / 12 + x0**2) / (g * x0)), x0)
    assert equal(place.value, l / sqrt(12))


def test_an_extremum_beyond_half_a_turn_is_found() -> None:
    """M sin + m cos is least half a turn beyond the angle at which it is greatest."""
    total = given(M * sin(theta0) + m * cos(theta0))
    (highest, _), (lowest, least) = (verb(total, theta0, within=(0, 2 * pi)) for verb in (maximum, minimum))
    assert equal(tan(highest.value), M / m)
    assert equal(lowest.value, highest.value + pi)
    assert equal(least.value, -sqrt(m**2 + M**2))


def test_an_extremum_outside_a_range_that_is_bounded_on_one_side_is_refused() -> None:
    hill = given(4 * c - (c - 1) ** 2, "hill")  # greatest at c = 3
    with declared({c: Range(Integer(2), oo)}):
        assert maximum(hill, c)[0].value == 3
    for outside in (Range(Integer(4), oo), Range(-oo, Integer(2))):
        with declared({c: outside}), pytest.raises(Rejected, match="not stationary for any allowed c"):
            maximum(hill, c)


def test_an_extremum_that_an_assumed_relation_excludes_is_refused() -> None:
    with recorded():
        assume(Relation(c, ">", 4))
        with pytest.raises(Rejected, match="not stationary for any allowed c"):
            maximum(given(4 * c - (c - 1) ** 2, "hill"), c)


def test_what_has_no_extremum_or_the_other_one_is_refused() -> None:
    for wrong in (lambda: maximum(given(x0), x0), lambda: maximum(given(x0 + R**2 / x0, "g_1"), x0)):
        with pytest.raises(Rejected, match="no allowed place"):
            wrong()
    with pytest.raises(Unverified, match="not the extreme value"):
        maximum(given(c**3 / 3 - R**2 * c, "cubic"), c, within=(-3 * R, 3 * R))


# --- energy ---


def pendulum() -> tuple[Coordinate, Quantity]:
    q = coordinate("theta")
    system = System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g))
    return q, energy_of(system)


def test_the_period_of_a_pendulum_to_second_order() -> None:
    """Landau, Lifshitz, section 11, problem 1."""
    q, energy = pendulum()
    rate = speed_from_energy(energy, q, theta0)
    assert equal(rate.value, 2 * g * (cos(q.symbol) - cos(theta0)) / l)
    period = period_by_energy(rate)
    assert equal(period.value, 2 * pi * sqrt(l / g) * (1 + theta0**2 / 16))
    assert (period.step.outcome, period.step.kind) == ("expanded", "time")


def test_a_harmonic_period_does_not_depend_on_the_amplitude() -> None:
    x = along()
    rate = speed_from_energy(energy_of(System(Particle(m, point(x, 0)), spring(k, point(0, 0), point(x, 0)))), x, x0)
    period = period_by_energy(rate)
    assert equal(period.value, 2 * pi * sqrt(m / k))
    assert period.step.outcome == "exact"


def test_the_period_on_a_cycloid_does_not_depend_on_the_amplitude() -> None:
    """Huygens: 4 pi sqrt(h/g) for every amplitude, although the coordinate itself does not oscillate harmonically."""
    q = coordinate("theta")
    bead = Particle(m, point(h * (q + sin(q)), -h * cos(q)))
    period = period_by_energy(speed_from_energy(energy_of(System(bead, weight(g))), q, theta0))
    assert equal(period.value, 4 * pi * sqrt(h / g))
    assert period.step.outcome == "exact"


def test_the_period_in_a_well_whose_depth_may_have_either_sign() -> None:
    """Landau, Lifshitz, section 11, problem 2b: tau = pi c sqrt(2 m/A) cos(x_0/c) for U = A tan^2(x/c)."""
    x, A = along(), symbols("A", real=True)
    well = System(Particle(m, point(x, 0)), potential(A * tan(x.symbol / h) ** 2))
    period = period_by_energy(speed_from_energy(energy_of(well), x, x0))
    assert equal(period.value**2, 2 * pi**2 * h**2 * m / A * (1 - x0**2 / (2 * h**2)) ** 2)


def test_a_stone_thrown_upwards_slows_down() -> None:
    x = along()
    rate = speed_from_energy(energy_of(System(Particle(m, point(0, x)), weight(g))), x, 0, v0)
    assert equal(rate.value, v0**2 - 2 * g * x.symbol)


def test_energies_that_are_not_kept_are_refused() -> None:
    x = along()
    oscillator = given(m * x.rate**2 / 2 + k * x.symbol**2 / 2, "energy", kind="energy")
    damped = equation(m * x.acceleration + b * x.rate + k * x.symbol, key="damped")
    with pytest.raises(Rejected, match="not conserved"):
        speed_from_energy(oscillator, x, x0, motion=damped)
    with pytest.raises(Rejected, match="the forces on"):
        speed_from_energy(oscillator, x, x0)
    free = equation(m * x.acceleration + k * x.symbol, key="free")
    thrown = speed_from_energy(oscillator, x, x0, v0, motion=free)
    with pytest.raises(Rejected, match="at a symbol"):
        period_by_energy(thrown)
    with pytest.raises(Rejected, match="not the square of a rate"):
        period_by_energy(oscillator)


def test_a_swing_that_is_not_the_same_to_both_sides_has_no_such_period() -> None:
    x = along()
    rate = speed_from_energy(energy_of(System(Particle(m, point(0, x)), weight(g))), x, x0)
    with pytest.raises(Rejected, match="is not the same at"):
        period_by_energy(rate)


# --- linear motion ---


def damped_oscillator(x: Coordinate, own: Expr = w0, drive: Expr | int = 0) -> Quantity:
    return equation(x.acceleration + 2 * ga * x.rate + own**2 * x.symbol, drive, "motion")


def test_the_three_cases_of_a_damped_oscillator() -> None:
    """Taylor, section 5.4."""
    x = along()
    motion, late, rise = damped_oscillator(x), sqrt(w0**2 - ga**2), sqrt(ga**2 - w0**2)
    weak = solution(motion, x, x0, 0, case="underdamped", key="weak")
    assert equal(weak.value, x0 * exp(-ga * t) * (cos(late * t) + ga / late * sin(late * t)))
    assert dict(weak.step.roles)["condition"] == Relation(ga, "<", w0)
    critical = solution(damped_oscillator(x, ga), x, x0, v0, key="critical")
    assert equal(critical.value, exp(-ga * t) * (x0 + (v0 + ga * x0) * t))
    strong = solution(motion, x, x0, 0, case="overdamped", key="strong")
    both = (1 + ga / rise) * exp((rise - ga) * t) + (1 - ga / rise) * exp(-(rise + ga) * t)
    assert equal(strong.value, x0 / 2 * both)
    assert [q.step.outcome for q in (weak, critical, strong)] == ["underdamped", "critically_damped", "overdamped"]


@pytest.mark.parametrize(
    ("left", "right", "start", "rate", "expected", "outcome"),
    [
        (lambda x: m * x.acceleration + k * x.symbol, 0, x0, 0, x0 * cos(sqrt(k / m) * t), "oscillates"),
        (
            lambda x: m * x.acceleration + k * x.symbol,
            m * g,
            0,
            0,
            m * g / k * (1 - cos(sqrt(k / m) * t)),
            "oscillates",
        ),
        (lambda x: x.acceleration, -g, h, v0, h + v0 * t - g * t**2 / 2, "uniform"),
        (lambda x: x.acceleration - w**2 * x.symbol, 0, x0, 0, x0 * (exp(w * t) + exp(-w * t)) / 2, "runs_away"),
        (
            lambda x: x.acceleration + w0**2 * x.symbol,
            F / m * cos(w0 * t),
            0,
            0,
            F * t * sin(w0 * t) / (2 * m * w0),
            "oscillates",
        ),
        (
            lambda x: x.acceleration + w0**2 * x.symbol,
            F / m * cos(w * t),
            0,
            0,
            F / m * (cos(w * t) - cos(w0 * t)) / (w0**2 - w**2),
            "oscillates",
        ),
        (
            lambda x: m * x.acceleration + b * x.rate,
            m * g,
            0,
            0,
            m * g / b * (t - m / b * (1 - exp(-b * t / m))),
            "slows",
        ),
        (lambda x: m * x.rate + b * x.symbol, m * g, 0, None, m * g / b * (1 - exp(-b * t / m)), "relaxes"),
        (lambda x: (M - mu * t) * x.rate, mu * u, 0, None, u * log(M / (M - mu * t)), "accumulates"),
    ],
)
def test_linear_motions_from_their_start(
    left: Callable[[Coordinate], Expr], right: Expr, start: Expr, rate: Expr | None, expected: Expr, outcome: str
) -> None:
    """Taylor, sections 2.2, 3.2 and 5.2 to 5.6."""
    x = along()
    found = solution(equation(left(x), right), x, Integer(0) + start, rate)
    assert equal(found.value.rewrite(exp) if outcome == "runs_away" else found.value, expected)
    assert found.step.outcome == outcome


def test_a_driven_oscillator_resonates_below_its_own_frequency() -> None:
    """Taylor, section 5.6; Marion, Thornton, equation 3.63."""
    x = along()
    amplitude, lag = steady_amplitude(damped_oscillator(x, drive=F / m * cos(w * t)), x)
    assert equal(amplitude.value, F / m / sqrt((w0**2 - w**2) ** 2 + 4 * ga**2 * w**2))
    assert (lag.symbol.func, lag.value) == (tan, 2 * ga * w / (w0**2 - w**2))
    place, top = maximum(amplitude, w)
    assert equal(place.value, sqrt(w0**2 - 2 * ga**2))
    assert equal(top.value, F / (2 * m * ga * sqrt(w0**2 - ga**2)))


@pytest.mark.parametrize(
    ("drive", "force"),
    [
        (F / m * sin(w * t), F / m),
        (F / m * cos(w * t) - g, F / m),  # with a weight
        (h * (w0**2 * sin(w * t) + 2 * ga * w * cos(w * t)), h * sqrt(w0**4 + 4 * ga**2 * w**2)),  # a moved support
    ],
)
def test_a_force_of_one_frequency_may_have_any_phase_and_a_constant_part(drive: Expr, force: Expr) -> None:
    x = along()
    amplitude, lag = steady_amplitude(damped_oscillator(x, drive=drive), x)
    assert equal(amplitude.value, force / sqrt((w0**2 - w**2) ** 2 + 4 * ga**2 * w**2))
    assert equal(lag.value, 2 * ga * w / (w0**2 - w**2))


def test_a_motion_from_infinity_needs_a_finite_start() -> None:
    x = along()
    energy = energy_of(System(Particle(m, point(x, 0)), spring(k, point(0, 0), point(x, 0))))
    with pytest.raises(Rejected, match="needs a finite start"):
        speed_from_energy(energy, x, oo)


def test_an_equation_for_a_sine_and_a_cosine_gives_the_tangent() -> None:
    """Taylor, section 9.1: a pendulum in a car with the acceleration c hangs at tan(theta) = -c/g."""
    q = coordinate("theta")
    (found,) = roots(equation(c * cos(q.symbol) + g * sin(q.symbol)), tan(q.symbol))
    assert equal(found.value, -c / g) and found.step.outcome == "single"
    with pytest.raises(Rejected, match="outside tan"):
        roots(equation(c * cos(q.symbol) + g * sin(q.symbol) - k), tan(q.symbol))


def test_a_force_of_two_frequencies_has_no_single_amplitude() -> None:
    x = along()
    with pytest.raises(Rejected, match="is not driven by a single force"):
        steady_amplitude(damped_oscillator(x, drive=F * cos(w * t) + F * cos(2 * w * t)), x)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda x: solution(damped_oscillator(x), x, x0), "sign of .* is unknown"),
        (lambda x: solution(damped_oscillator(x), x, x0, case="weak"), "no case `weak`"),
        (lambda x: solution(damped_oscillator(x), x, x0, case="critically_damped"), "only if"),
        (lambda x: solution(damped_oscillator(x, ga), x, x0, case="overdamped"), "is critically damped"),
        (lambda x: solution(equation(x.acceleration + x.symbol**2, h), x, x0), "not a linear differential equation"),
        (lambda x: solution(equation(x.rate + t * x.symbol, h), x, x0), "not a linear differential equation"),
        (lambda x: solution(equation(x.rate + x.symbol, h), x, x0, v0), "of first order"),
        (lambda x: solution(equation(x.acceleration + x.symbol, log(t)), x, x0), "the driving force"),
        (lambda x: solution(equation(x.acceleration + c * x.symbol), x, x0), "sign of c is unknown"),
        (lambda x: solution(equation(x.rate + c * x.symbol), x, x0), "sign of c is unknown"),
        (lambda x: solution(equation(x.acceleration + c * x.rate), x, x0), "sign of c is unknown"),
        (
            lambda x: solution(equation(x.acceleration + c * x.rate + h * x.symbol), x, x0, case="underdamped"),
            "sign of c is unknown",
        ),
        (
            lambda x: solution(equation(x.acceleration + h * x.rate + c * x.symbol), x, x0, case="overdamped"),
            "sign of c is unknown",
        ),
        (lambda x: solution(equation(x.acceleration - x.rate + x.symbol), x, x0), "the damping is negative"),
        (lambda x: steady_amplitude(equation(x.acceleration + x.symbol, h), x), "is not driven by a single force"),
    ],
)
def test_motions_that_no_such_equation_gives_are_refused(wrong: Callable[[Coordinate], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong(along())


# --- wrong laws ---


def driven() -> tuple[Quantity, Quantity]:
    return steady_amplitude(damped_oscillator(along(), drive=F / m * cos(w * t)), along())


@pytest.mark.parametrize(
    ("module", "name", "wrong", "asked"),
    [
        ("answers.linear_equations", "_written", lambda matrix: 2 - matrix.det(), lambda: atwood()),
        ("answers.linear_equations", "presented", lambda value: 2 * value, lambda: atwood()),
        (
            "answers.substitution",
            "with_unknown",
            lambda e, u, at: e.xreplace({u: -at}),
            lambda: put_in(given(c + R), c=h),
        ),
        ("answers.limits", "tidied_terms", lambda series, x, to: Integer(7), lambda: limiting_case(given(sin(h)), h)),
        (
            "answers.extrema",
            "_places",
            lambda slope, x, within: [Zero(pi / 3)],
            lambda: maximum(given(sin(theta0)), theta0, within=(0, pi)),
        ),
        (
            "vibrations.linear_motion",
            "_constants",
            lambda *_: [x0, x0],
            lambda: solution(equation(along().acceleration + along().symbol), along(), x0),
        ),
        (
            "vibrations.linear_motion",
            "_particular",
            lambda *_: Integer(1),
            lambda: solution(equation(along().acceleration + along().symbol, h), along(), x0),
        ),
        (
            "vibrations.driven",
            "_amplitude",
            lambda F, s, b: F / s,
            lambda: steady_amplitude(damped_oscillator(along(), drive=cos(w * t)), along()),
        ),
    ],
)
def test_a_wrong_law_is_refused(
    monkeypatch: pytest.MonkeyPatch, module: str, name: str, wrong: Any, asked: Callable[[], Any]
) -> None:
    monkeypatch.setattr(f"derive.mechanics.{module}.{name}", wrong)
    with pytest.raises(Unverified):
        asked()


def test_a_wrong_root_and_a_wrong_bound_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.mechanics.answers import conditions
    from derive.mechanics.answers.roots import RootOf

    x = along()
    right = conditions.solved_for_unknown
    monkeypatch.setattr(
        conditions,
        "solved_for_unknown",
        lambda *a: Relation(right(*a).left, right(*a).operator, -right(*a).right),
    )
    with pytest.raises(Unverified):
        where(given(c - h), ">", 0, c)
    monkeypatch.setattr(RootOf, "value", property(lambda self: R / 3))
    with pytest.raises(Unverified):
        roots(equation(k * x.symbol, m * g), x)


@pytest.mark.parametrize(("at", "outcome"), [({"x": 0}, "zero"), ({"x": 1}, "values")])
def test_what_vanishes_for_the_values_put_in_says_so(at: dict[str, int], outcome: str) -> None:
    squared = let("f", lambda: symbols("x", real=True) ** 2)
    assert put_in(squared, **at).step.outcome == outcome
