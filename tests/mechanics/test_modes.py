"""Linear equations of motion and normal modes of several coordinates, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, cos, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, Root, explicit
from derive.algebra.ordered_roots import OrderedRoot
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Particle,
    System,
    Y,
    Z,
    beats,
    coordinate,
    equations_of_motion,
    equilibria,
    lagrangian,
    linearised,
    normal_modes,
    period,
    point,
    potential,
    potential_energy_of,
    space,
    spring,
    weight,
)
from derive.mechanics.vibrations import claims, modes
from derive.mechanics.vibrations import uncoupled as uncoupled_module
from derive.mechanics.vibrations.facts import Linear
from derive.solving import linear_systems
from derive.solving.linear_systems import Conservative
from derive.steps.defined import define
from derive.steps.record import Run, recorded
from derive.steps.rule import Judged
from derive.steps.step import Quantity

m, M, g, l, k, c, R, w = symbols("m M g l k c R omega", positive=True)
m1, m2, l1, l2 = symbols("m_1 m_2 l_1 l_2", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[None]:
    with recorded():
        yield


def motion(*parts: Any) -> tuple[Quantity, ...]:
    return equations_of_motion(lagrangian(System(*parts)))


def double(*sizes: Expr) -> tuple[tuple[Quantity, ...], Any, Any]:
    first, second, upper, lower = sizes or (m, m, l, l)
    theta, phi = coordinate("theta"), coordinate("phi")
    top = point(upper * sin(theta), -upper * cos(theta))
    bottom = top + point(lower * sin(phi), -lower * cos(phi))
    return motion(Particle(first, top), Particle(second, bottom), weight(g)), theta, phi


def chain(masses: list[Expr], constants: list[Expr], walls: bool = True) -> tuple[Quantity, ...]:
    at = [point(n * l + coordinate(f"x_{n}", "length"), 0) for n in range(1, len(masses) + 1)]
    ends = [point(0, 0), *at, point((len(masses) + 1) * l, 0)] if walls else at
    springs = (spring(each, a, b, l) for each, (a, b) in zip(constants, pairwise(ends), strict=True))
    return motion(*(Particle(each, p) for each, p in zip(masses, at, strict=True)), *springs)


def test_the_common_factor_of_a_potential_energy_stands_in_front() -> None:
    at = [point(l + coordinate("x_1", "length"), 0), point(2 * l + coordinate("x_2", "length"), 0)]
    ends = pairwise([point(0, 0), *at, point(3 * l, 0)])
    system = System(*(Particle(m, p) for p in at), *(spring(k, a, b, l) for a, b in ends))
    assert k in potential_energy_of(system).step.chain[-1].expr.args


def squares(found: tuple[Quantity, ...]) -> list[Expr]:
    return [q.value**2 for q in found if q.key.startswith("frequency")]


def shapes(found: tuple[Quantity, ...]) -> list[list[Expr]]:
    return [list(q.value) for q in found if q.key.startswith("mode")]


def same(found: list[Expr], *expected: Expr) -> bool:
    return len(found) == len(expected) and all(equal(a, b) for a, b in zip(found, expected, strict=True))


def outcomes(found: tuple[Quantity, ...]) -> list[str]:
    return [q.step.outcome for q in found]


def test_the_double_pendulum_of_equal_lengths_and_masses() -> None:
    """Taylor, section 11.4: omega^2 = (2 -+ sqrt 2) g/l, shapes (1, +-sqrt 2)."""
    equations, theta, phi = double()
    found = normal_modes(linearised(equations, at={theta: 0, phi: 0}))
    assert same(squares(found), (2 - sqrt(2)) * g / l, (2 + sqrt(2)) * g / l)
    assert shapes(found) == [[1, sqrt(2)], [1, -sqrt(2)]]
    assert outcomes(found) == ["oscillating", "oscillating", "in_phase", "opposite"]
    assert [str(q.symbol) for q in found] == ["omega_1", "omega_2", "a_1", "a_2"]
    assert all(e.grade == "proved" for q in found for e in q.step.evidence if e.compared != "witness")


def test_the_double_pendulum_in_letters_has_the_sum_and_product_of_its_squares() -> None:
    """From det(K - lambda M) = 0 by hand: (m1 + m2) g (l1 + l2)/(m1 l1 l2) and (m1 + m2) g^2/(m1 l1 l2)."""
    equations, theta, phi = double(m1, m2, l1, l2)
    lower, upper = squares(normal_modes(linearised(equations, at={theta: 0, phi: 0})))
    assert equal(lower + upper, (m1 + m2) * g * (l1 + l2) / (m1 * l1 * l2))
    assert equal((lower * upper).expand(), (m1 + m2) * g**2 / (m1 * l1 * l2))


def test_equations_to_first_order_about_the_lowest_place() -> None:
    equations, theta, phi = double(m1, m2, l1, l2)
    first, second = (q.value for q in linearised(equations, at={theta: 0, phi: 0}))
    upper = (m1 + m2) * l1**2 * theta.acceleration + m2 * l1 * l2 * phi.acceleration + (m1 + m2) * g * l1 * theta.symbol
    assert equal(first, Relation(upper, "=", 0))
    lower = l2 * phi.acceleration + l1 * theta.acceleration + g * phi.symbol
    assert equal(second, Relation(lower, "=", 0))


def test_the_double_pendulum_with_its_lower_end_up_falls_over() -> None:
    """K = m g l diag(2, -1), M = m l^2 ((2, -1), (-1, 1)): lambda^2 = 2 (g/l)^2, one root of each sign."""
    equations, theta, phi = double()
    found = normal_modes(linearised(equations, at={theta: 0, phi: pi}))
    assert outcomes(found)[:3] == ["growing", "oscillating", "departing"]
    assert same(squares(found), sqrt(2) * g / l, sqrt(2) * g / l)
    assert str(found[0].symbol) == "kappa_1"


def test_two_masses_between_three_springs() -> None:
    """Taylor, section 11.2."""
    found = normal_modes(linearised(chain([m, m], [k, k, k])))
    assert same(squares(found), k / m, 3 * k / m)
    assert shapes(found) == [[1, 1], [1, -1]]


def test_three_masses_between_four_springs() -> None:
    found = normal_modes(linearised(chain([m] * 3, [k] * 4)))
    assert same(squares(found), (2 - sqrt(2)) * k / m, 2 * k / m, (2 + sqrt(2)) * k / m)
    assert shapes(found) == [[1, sqrt(2), 1], [1, 0, -1], [1, -sqrt(2), 1]]


def test_a_linear_molecule_moves_freely_as_a_whole() -> None:
    """Goldstein, section 6.4: 0, k/m, (k/m)(1 + 2m/M); shapes (1, 1, 1), (1, 0, -1), (1, -2m/M, 1)."""
    found = normal_modes(linearised(chain([m, M, m], [k, k], walls=False)))
    assert same(squares(found), 0 * k, k / m, k / m * (1 + 2 * m / M))
    assert shapes(found) == [[1, 1, 1], [1, 0, -1], [1, -2 * m / M, 1]]
    assert outcomes(found) == ["free", "oscillating", "oscillating", "uniform", "generic", "generic"]


@pytest.mark.parametrize("size", [6, 8])
def test_the_frequencies_of_a_uniform_chain(size: int) -> None:
    """Fetter, Walecka, section 24: lambda = 4 (k/m) sin^2(n pi/2(N + 1))."""
    stiffness = ImmutableDenseMatrix(size, size, lambda i, j: k * (2 if i == j else -int(abs(i - j) == 1)))
    found = Conservative(m * ImmutableDenseMatrix.eye(size), ImmutableDenseMatrix.zeros(size), stiffness).roots
    for n, root in enumerate(found, 1):
        exact = 4 * k / m * sin(n * pi / (2 * (size + 1))) ** 2
        assert equal(root.value, exact)
        residual = (stiffness - exact * m * ImmutableDenseMatrix.eye(size)) * root.columns[0]
        assert all(abs(entry.subs({k: 1, m: 1}).evalf(20)) < Rational(1, 10**15) for entry in residual)


@pytest.mark.parametrize(("size", "reason"), [(13, "more than 12"), (6, "with this many symbols")])
def test_too_large_a_system_is_rejected_with_the_reason(size: int, reason: str) -> None:
    masses = symbols(f"m_:{size}", positive=True) if size == 6 else [m] * size
    stiffness = ImmutableDenseMatrix(size, size, lambda i, j: k * (2 if i == j else -int(abs(i - j) == 1)))
    mass = ImmutableDenseMatrix.diag(*masses) + c * ImmutableDenseMatrix.eye(size)
    with pytest.raises(Rejected, match=reason):
        _ = Conservative(mass, ImmutableDenseMatrix.zeros(size), stiffness).factors


def test_a_given_angle_in_the_stiffness_is_no_angle_of_a_chain() -> None:
    """A sine in lambda once meant a uniform chain, so this shape was wrong and its second route refused it."""
    alpha = symbols("alpha", real=True)
    a, b = coordinate("x", "length"), coordinate("y", "length")
    energy = k * ((1 + sin(alpha) ** 2) * a.symbol**2 - 2 * cos(alpha) * a.symbol * b.symbol + b.symbol**2) / 2
    linear = linearised(motion(Particle(m, point(a, 0)), Particle(M, point(b, 0)), potential(energy)))
    found = normal_modes(linear)
    (first, second), both = (q.value**2 for q in found[:2]), (2 - cos(alpha) ** 2) / m + 1 / M
    assert equal(first + second, k * both)
    assert equal(first * second, 2 * k**2 * sin(alpha) ** 2 / (m * M))


def test_three_equal_masses_joined_in_a_triangle_have_a_repeated_frequency() -> None:
    """K = k ((2, -1, -1), ...): 0, 3k/m, 3k/m, with shapes orthogonal to each other."""
    stiffness = ImmutableDenseMatrix([[2 * k, -k, -k], [-k, 2 * k, -k], [-k, -k, 2 * k]])
    free, pair = Conservative(m * ImmutableDenseMatrix.eye(3), ImmutableDenseMatrix.zeros(3), stiffness).roots
    assert (free.value, pair.value, pair.times) == (0, 3 * k / m, 2)
    assert (pair.columns[0].T * pair.columns[1])[0] == 0


def test_two_masses_that_are_not_joined_have_one_frequency_twice() -> None:
    at = [point(n * l + coordinate(f"x_{n}", "length"), 0) for n in (1, 3)]
    springs = (spring(k, point(2 * n * l, 0), each, l) for n, each in enumerate(at))
    found = normal_modes(linearised(motion(*(Particle(m, each) for each in at), *springs)))
    assert [(str(q.symbol), q.step.outcome, q.step.rule) for q in found] == [
        ("omega_0", "oscillating", "vibrations.uncoupled_frequency")
    ]
    assert same(squares(found), k / m)


def uncoupled(*constants: Expr, mass: Expr = m) -> tuple[Quantity, ...]:
    """A particle in the energy c_x x^2/2 + c_y y^2/2 + ..., to first order."""
    q = [coordinate(name, "length") for name in "xyz"[: len(constants)]]
    energy = sum(c * each.symbol**2 / 2 for c, each in zip(constants, q, strict=True))
    return linearised(motion(Particle(mass, point(*q)), potential(energy)))


def told(found: Sequence[Quantity]) -> list[tuple[str, str, str]]:
    return [(str(q.symbol), q.step.outcome, dict(q.step.words)["coupling"]) for q in found]


def test_coordinates_that_are_not_coupled_have_frequencies_of_their_own_and_no_determinant() -> None:
    found = normal_modes(uncoupled(k, 2 * k, 3 * k))
    assert told(found) == [
        ("omega_x", "oscillating", "none"),
        ("omega_y", "oscillating", "told"),
        ("omega_z", "oscillating", "told"),
    ]
    assert [q.key for q in found] == ["frequency_1", "frequency_2", "frequency_3"]
    assert same(squares(found), k / m, 2 * k / m, 3 * k / m)
    assert all("Determinant" not in str(q.step.chain) for each in found for q in each.ancestors())


def test_the_frequencies_of_uncoupled_coordinates_are_in_ascending_order() -> None:
    assert told(normal_modes(uncoupled(2 * k, -k, k - k))) == [
        ("kappa_y", "growing", "none"),
        ("omega_z", "free", "told"),
        ("omega_x", "oscillating", "told"),
    ]


def test_the_sign_of_a_constant_may_be_open() -> None:
    c_0 = symbols("c_0", real=True)
    (frequency,) = normal_modes(uncoupled(c_0, c_0))
    assert told([frequency]) == [("omega_0", "conditional", "all")]
    assert dict(frequency.step.roles)["condition"] == Relation(c_0, ">", 0)


def test_only_coupled_coordinates_have_a_determinant() -> None:
    x, y, z = (coordinate(name, "length") for name in "xyz")
    energy = k * x.symbol**2 / 2 + c * (y.symbol - z.symbol) ** 2 / 2 + k * (y.symbol**2 + z.symbol**2) / 2
    found = normal_modes(linearised(motion(Particle(m, point(x, y, z)), potential(energy))))
    assert [(q.key, str(q.symbol)) for q in found] == [
        ("frequency_3", "omega_x"),
        ("frequency_1", "omega_1"),
        ("frequency_2", "omega_2"),
        ("mode_1", "a_1"),
        ("mode_2", "a_2"),
    ]
    assert told(found[:1]) == [("omega_x", "oscillating", "others")]
    assert same(squares(found), k / m, k / m, (k + 2 * c) / m)
    assert shapes(found) == [[1, 1], [1, -1]]
    (characteristic,) = found[1].parents
    assert dict(characteristic.step.roles).keys() >= {"equation_1", "equation_2"}


def test_each_group_of_coupled_coordinates_has_its_own_determinant() -> None:
    q = [coordinate(f"x_{n}", "length") for n in range(4)]
    a, b, d, e = (each.symbol for each in q)
    energy = (k * (a - b) ** 2 + k * (a**2 + b**2) + c * (d - e) ** 2 + k * (d**2 + e**2)) / 2
    found = normal_modes(linearised(motion(*(Particle(m, point(each, 0)) for each in q), potential(energy))))
    assert [each.key for each in found if each.key.startswith("frequency")] == [f"frequency_{n}" for n in range(1, 5)]
    assert {p.key for each in found for p in each.parents if "characteristic" in p.key} == {
        "characteristic_equation_1",
        "characteristic_equation_2",
    }


def test_a_frequency_with_the_value_of_a_defined_quantity_has_its_symbol() -> None:
    with recorded(Run(letters=("m", "k", "w_0"))):
        define([(symbols("w_0", positive=True), sqrt(k / m))])
        found = normal_modes(uncoupled(k, 2 * k))
        assert [str(q.symbol) for q in found] == ["w_0", "omega_y"]
    with recorded(Run(letters=("m", "k", "omega_0"))):
        define([(symbols("omega_0", positive=True), sqrt(k / m))])
        x = coordinate("x", "length")
        (frequency,) = normal_modes(linearised(motion(Particle(m, point(x, 0)), potential(k * x.symbol**2 / 2))))
        assert (str(frequency.symbol), frequency.key) == ("omega_0", "frequency")


def test_a_given_letter_is_not_the_symbol_of_a_frequency() -> None:
    with recorded(Run(letters=("m", "k", "omega_x"))):
        assert [str(q.symbol) for q in normal_modes(uncoupled(k, 2 * k))] == ["omega_1", "omega_y"]


@pytest.mark.parametrize("wrong", [lambda root: 2 * root, lambda root: -root])
def test_a_wrong_frequency_of_an_uncoupled_coordinate_is_refused(wrong: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(uncoupled_module, "root_of", lambda square: wrong(linear_systems.root_of(square)))
    with pytest.raises(Unverified):
        normal_modes(uncoupled(k, 2 * k))


@pytest.mark.parametrize("word", ["none", "all"])
def test_coupled_equations_are_not_called_uncoupled(word: str) -> None:
    one = linearised(chain([m, m], [k, c, k]))[0]
    known = one.needed(Linear)
    matrices = {"stiffness": known.stiffness, "turning": known.turning, "mass": known.mass}
    facts = Judged(sqrt(k / m), {**matrices, "own": (0,)}, {"equation": one}, words={"coupling": word})
    assert not claims.uncoupled_as_told(facts, "oscillating")
    assert not claims.moves_by_itself(1)(facts)


def test_a_pendulum_on_a_cart_has_a_mode_that_is_no_oscillation() -> None:
    """Morin, section 6.5: omega^2 = (M + m) g/(M l), and the whole moves along."""
    x, theta = coordinate("x", "length"), coordinate("theta")
    bob = point(x + l * sin(theta), -l * cos(theta))
    found = normal_modes(linearised(motion(Particle(M, point(x, 0)), Particle(m, bob), weight(g)), at={theta: 0}))
    assert same(squares(found), 0 * g, (M + m) * g / (M * l))
    assert shapes(found)[0] == [1, 0]
    assert same(shapes(found)[1], 1 + 0 * m, -(M + m) / (m * l))


def test_weakly_coupled_oscillators_beat_with_the_difference() -> None:
    """Taylor, section 11.3."""
    slow, fast, *_ = normal_modes(linearised(chain([m, m], [k, c, k])))
    found, exchanged = beats(slow, fast), beats(fast, slow, key="exchanged")
    assert equal(found.value, sqrt((k + 2 * c) / m) - sqrt(k / m))
    assert exchanged.value == found.value
    assert equal(period(slow).value, 2 * pi * sqrt(m / k))


def test_a_pendulum_and_its_period() -> None:
    theta = coordinate("theta")
    equations = motion(Particle(m, point(l * sin(theta), -l * cos(theta))), weight(g))
    (omega,) = normal_modes(linearised(equations))
    assert (str(omega.symbol), omega.key) == ("omega_0", "frequency")
    assert equal(period(omega).value, 2 * pi * sqrt(l / g))
    (growth,) = normal_modes(linearised(equations, at={theta: pi}, key="above"), symbol="nu", key="above")
    assert (growth.step.outcome, str(growth.symbol)) == ("unstable", "kappa")
    with pytest.raises(Rejected, match="is not the frequency of an oscillation"):
        period(growth)


def test_a_bead_on_a_turning_hoop_swings_about_its_tilted_place() -> None:
    """Taylor, example 7.7: Omega'^2 = omega^2 - (g/(omega R))^2."""
    theta, W = coordinate("theta"), symbols("Omega", positive=True)
    L = lagrangian(System(Particle(m, space.turned(Z, W * t).place(R * sin(theta), 0, -R * cos(theta))), weight(g)))
    tilted = equilibria(L)[2]
    (omega,) = normal_modes(linearised(equations_of_motion(L), at=tilted))
    assert equal(omega.value**2, W**2 - (g / (W * R)) ** 2)
    assert omega.step.outcome == "stable"


def cart() -> tuple[tuple[Quantity, ...], Any, Any]:
    x, theta = coordinate("x", "length"), coordinate("theta")
    bob = point(x + l * sin(theta), -l * cos(theta))
    return motion(Particle(M, point(x, 0)), Particle(m, bob), weight(g)), x, theta


def turning() -> tuple[Quantity, ...]:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = space.turned(Z, w * t).place(x, y, 0)
    return motion(Particle(m, at), spring(k, 0 * Y.__class__((0, 0, 0)), at))


def refused(case: str) -> Any:
    if case == "no rest":
        equations, theta, phi = double()
        return linearised(equations, at={theta: 0, phi: pi / 2})
    if case == "missing":
        equations, theta, _ = double()
        return linearised(equations, at={theta: 0})
    if case == "stranger":
        equations, theta, phi = double()
        return linearised(equations, at={theta: 0, phi: 0, coordinate("psi"): 0})
    if case == "one of two":
        equations, *_ = double()
        return normal_modes(linearised(equations)[:1])
    if case == "taken":
        return normal_modes(linearised(chain([w, w], [k, k, k])), symbol="omega")
    if case == "cubic":
        return normal_modes(linearised(chain([m, m, m], [k, k, k, c])))
    if case == "nonlinear":
        return normal_modes(double()[0])
    if case == "beats of one":
        slow, *_ = normal_modes(linearised(chain([m, m], [k, c, k])))
        return beats(slow, slow)
    theta = coordinate("theta")
    height = R * cos(w * t)
    return linearised(motion(Particle(m, point(l * sin(theta), height - l * cos(theta))), weight(g)), at={theta: 0})


@pytest.mark.parametrize(
    ("case", "said"),
    [
        ("no rest", "does not hold at rest at theta = 0, phi = pi/2: one side minus the other is g\\*l\\*m, not 0"),
        ("missing", "the value of phi at equilibrium is unknown"),
        ("stranger", "have no coordinate psi"),
        ("one of two", "needs all the equations"),
        ("taken", "omega denotes a given quantity"),
        ("cubic", "the squares of 3 frequencies are the roots of a polynomial that does not factor"),
        ("nonlinear", "is not an equation of motion to first order"),
        ("beats of one", "have no beats"),
        ("driven", "depend on the time, but they must be constant"),
    ],
)
def test_wrong_questions_about_modes_are_refused(case: str, said: str) -> None:
    with pytest.raises(Rejected, match=said):
        refused(case)


def test_where_omega_is_given_a_frequency_is_called_by_the_capital_letter() -> None:
    (found, *_) = normal_modes(linearised(chain([w, w], [k, k, k])))
    assert str(found.symbol) == "Omega_1"


WRONG: dict[str, tuple[Any, str, Callable[..., Any]]] = {
    "a root too large": (modes, "root_of", lambda square: 2 * sqrt(square)),
    "a root of the other sign": (modes, "root_of", lambda square: -sqrt(square)),
    "another shape": (
        linear_systems,
        "_presentable",
        lambda column: ImmutableDenseMatrix([column[0], *(2 * e for e in column[1:])]),
    ),
    "another determinant": (Conservative, "written", lambda self, letter: letter**4 - k * letter**2 / m),
}


@pytest.mark.parametrize("slip", WRONG)
def test_a_wrong_law_of_modes_is_refused(slip: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, name, wrong = WRONG[slip]
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unverified):
        normal_modes(linearised(chain([m, m], [k, k, k])))


def test_a_wrong_linear_equation_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.mechanics.vibrations import linearised as module

    right = module._coefficients
    monkeypatch.setattr(module, "_coefficients", lambda *given: (1 + (given[-1] == 0)) * right(*given))
    equations, theta, phi = double()
    with pytest.raises(Unverified, match="does not follow"):
        linearised(equations, at={theta: 0, phi: 0})


def test_what_is_displaced_is_counted_from_rest() -> None:
    equations, theta, phi = double()
    first, second = linearised(equations, at={theta: pi, phi: pi})
    assert {str(s) for s in explicit(first.value).free_symbols} >= {"eta_1", "eta_1_ddot", "eta_2_ddot"}
    counted = explicit(dict(second.step.roles)["counted_1"])
    assert counted == Relation(theta.symbol, "=", pi + symbols("eta_1", real=True))


@pytest.mark.parametrize("name", ["w", "u", "s", "epsilon", "a_0", "u_0"])
def test_letters_of_a_problem_are_not_those_of_a_check(name: str) -> None:
    """Landau and Lifshitz, section 23, problem 1, whatever the frequency of the two oscillators is called."""
    own, c = symbols(f"{name} c", positive=True)
    x, y = coordinate("x", "length"), coordinate("y", "length")
    stiff = potential(m * own**2 * (x.symbol**2 + y.symbol**2) / 2 - m * c * x.symbol * y.symbol)
    found = normal_modes(linearised(motion(Particle(m, point(x, y)), stiff)))
    assert {explicit(each.value**2) for each in found[:2]} == {own**2 - c, own**2 + c}


def chain_in_numbers(masses: Sequence[int], springs: Sequence[int]) -> tuple[Quantity, ...]:
    count = len(masses)
    inertia, stiffness = symbols(f"m_1:{count + 1}", positive=True), symbols(f"k_0:{count + 1}", positive=True)
    numbers = dict(zip((*inertia, *stiffness), map(Integer, (*masses, *springs)), strict=True))
    with recorded(Run(numbers=numbers)):
        moving = [coordinate(f"x_{i + 1}", "length") for i in range(count)]
        joints = [
            point(0, 0),
            *(point((i + 1) * l + q.symbol, 0) for i, q in enumerate(moving)),
            point((count + 1) * l, 0),
        ]
        joined = [spring(k, u, v, natural=l) for k, u, v in zip(stiffness, joints, joints[1:], strict=False)]
        equations = motion(*map(Particle, inertia, joints[1:]), *joined)
        found = normal_modes(linearised(equations, at=dict.fromkeys(moving, 0)))
    return tuple(q for q in found if q.key.startswith("frequency"))


@pytest.mark.parametrize(
    ("masses", "springs"),
    [((1, 1, 1), (2, 3, 4, 5)), pytest.param((3, 1, 2, 1), (1, 7, 2, 5, 1), marks=pytest.mark.long)],
)
def test_frequencies_without_a_formula_are_those_of_an_eigenvalue_routine(
    masses: tuple[int, ...], springs: tuple[int, ...]
) -> None:
    found = chain_in_numbers(masses, springs)
    stiffness = np.diag([u + v for u, v in pairwise(springs)]) - np.diag(springs[1:-1], 1) - np.diag(springs[1:-1], -1)
    root = np.diag([each**-0.5 for each in masses])
    wanted = np.sqrt(np.linalg.eigvalsh(root @ stiffness @ root))
    named = [*symbols(f"m_1:{len(masses) + 1}", positive=True), *symbols(f"k_0:{len(springs)}", positive=True)]
    numbers = dict(zip(named, map(Integer, (*masses, *springs)), strict=True))
    values = [float(explicit(explicit(q.value).xreplace(numbers)).evalf()) for q in found]
    assert np.allclose(values, wanted)
    assert {q.step.outcome for q in found} == {"ordered"}


def test_the_sentence_introduces_the_smallest_root_whichever_frequency_is_asked_for() -> None:
    for found in chain_in_numbers((1, 1, 1), (2, 3, 4, 5)):
        assert str(dict(found.step.roles)["root"]) == "lambda_1"


def test_of_a_factor_the_roots_are_numbered_among_themselves_and_come_last() -> None:
    stiff = symbols("k_1:4", positive=True)
    numbers = dict(zip((m, *stiff), map(Integer, (1, 3, 4, 5)), strict=True))
    with recorded(Run(numbers=numbers)):
        moving = [coordinate(f"x_{i}", "length") for i in (1, 2, 3, 4)]
        joints = [point(i * l + q.symbol, 0) for i, q in enumerate(moving)]
        joined = [spring(each, u, v, natural=l) for each, u, v in zip(stiff, joints, joints[1:], strict=False)]
        equations = motion(*(Particle(m, at) for at in joints), *joined)
        found = [q for q in normal_modes(linearised(equations, at=dict.fromkeys(moving, 0))) if "frequency" in q.key]
    assert [q.step.outcome for q in found] == ["free", *["ordered_part"] * 3]
    wanted = np.linalg.eigvalsh([[3, -3, 0, 0], [-3, 7, -4, 0], [0, -4, 9, -5], [0, 0, -5, 5]])[1:]
    values = [float(explicit(explicit(q.value).xreplace(numbers)).evalf()) for q in found[1:]]
    assert np.allclose(values, np.sqrt(wanted))


def test_roots_of_another_polynomial_or_in_another_order_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def of_another(coefficients: Sequence[Expr], number: int, name: Any) -> Any:
        return OrderedRoot([*coefficients[:-1], 2 * coefficients[-1]], number, name)

    with monkeypatch.context() as patched:
        patched.setattr(linear_systems, "OrderedRoot", of_another)
        with pytest.raises(Unverified, match="put_back"):
            chain_in_numbers((1, 1, 1), (2, 3, 4, 5))

    def misnamed(coefficients: Sequence[Expr], number: int, name: Any) -> Any:
        return OrderedRoot(coefficients, len(coefficients) - number, name)

    monkeypatch.setattr(linear_systems, "OrderedRoot", misnamed)
    with pytest.raises(Unverified, match="the sentence for this result could not be confirmed"):
        chain_in_numbers((1, 1, 1), (2, 3, 4, 5))


def test_without_numbers_for_all_letters_there_is_no_frequency() -> None:
    three = [coordinate(f"x_{i}", "length") for i in (1, 2, 3)]
    names = symbols("k_0:4", positive=True)
    joints = [point(0, 0), *(point(i * l + q.symbol, 0) for i, q in enumerate(three, 1)), point(4 * l, 0)]
    joined = [spring(each, u, v, natural=l) for each, u, v in zip(names, joints, joints[1:], strict=False)]
    equations = motion(*(Particle(m, at) for at in joints[1:4]), *joined)
    with pytest.raises(Rejected, match="a polynomial that does not factor") as refused:
        normal_modes(linearised(equations, at=dict.fromkeys(three, 0)))
    assert "give numbers to all masses and springs" in str(refused.value)


def test_the_root_of_a_square_contains_no_square() -> None:
    Omega, g, l = symbols("Omega g l", positive=True)
    assert linear_systems.root_of(3 * Omega**2) == sqrt(3) * Omega
    assert linear_systems.root_of(3 * g / l) == Root(3 * g / l)
    assert linear_systems.root_of((g + l * Omega**2 * sin(l) ** 2) / l) == Root(g / l + Omega**2 * sin(l) ** 2)
