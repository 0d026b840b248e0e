"""Rigid bodies in systems: their energies and equations of motion as the textbooks have them, and what is refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, Integer, Matrix, Rational, cos, pi, sin, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Ball,
    Cone,
    Coordinate,
    Cuboid,
    Cylinder,
    Disc,
    Particle,
    Plate,
    RigidBody,
    Rod,
    System,
    X,
    Y,
    Z,
    angular_velocity,
    coordinate,
    equations_of_motion,
    euler_angles,
    kinetic_energy_of,
    lagrangian,
    no_slip,
    point,
    space,
    spring,
    t,
    weight,
)
from derive.mechanics.lagrange import energies
from derive.mechanics.model import no_slip as rolling_module
from derive.mechanics.model import rigid
from derive.steps.record import Run, recorded

m, M, g, l, R, a, h, k, w = symbols("m M g l R a h k omega", positive=True)
A, C, I_0 = symbols("A C I_0", positive=True)
alpha = symbols("alpha", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def lefts(*parts: Any) -> list[Expr]:
    return [explicit(motion.value).residual for motion in equations_of_motion(lagrangian(System(*parts)))]


def same(found: list[Expr], *expected: Expr) -> bool:
    assert len(found) == len(expected)
    return all(
        equal(Relation(one, "=", 0), Relation(other, "=", 0)) for one, other in zip(found, expected, strict=True)
    )


def energy(*parts: Any) -> Expr:
    with recorded() as page:
        page.coordinates.update(dict.fromkeys(symbols("phi theta psi x", real=True), "angle"))
        return explicit(kinetic_energy_of(System(*parts)).value)


def top(moments: Any = (A, A, C), **about: Any) -> tuple[tuple[Coordinate, ...], Any]:
    phi, theta, psi = euler_angles()
    axes = space.turned(Z, phi).turned(X, theta).turned(Z, psi)
    return (phi, theta, psi), RigidBody(M, moments, centre=(0, 0, l), **about).held(axes, at="pivot")


def test_a_rod_swings_about_its_end() -> None:
    """Kleppner, Kolenkow, section 7.6: I = m l^2/3, and the weight acts in the middle. At theta = 0 it stands up."""
    q = coordinate("theta")
    assert same(lefts(Rod(l, m).held(q, at="end"), weight(g)), 2 * l * q.acceleration - 3 * g * sin(q))


def test_a_physical_pendulum_has_its_moment_about_the_pivot() -> None:
    """Taylor, problem 4.26 and Goldstein, section 5: I theta_ddot = -m g l sin theta."""
    q = coordinate("theta")
    body = RigidBody(m, I_0, centre=(0, -l)).held(q, at="pivot")
    assert same(lefts(body, weight(g)), I_0 * q.acceleration + m * g * l * sin(q))


def test_the_same_pendulum_with_its_moment_about_the_centre_of_mass() -> None:
    q = coordinate("theta")
    body = RigidBody(m, I_0, centre=(0, -l), about="centre_of_mass").held(q, at="pivot")
    assert same(lefts(body, weight(g)), (I_0 + m * l**2) * q.acceleration + m * g * l * sin(q))


def test_a_plate_swings_about_a_point_given_by_its_components() -> None:
    """A square of side a held at the middle of an edge: I = m a^2 (1/6 + 1/4)."""
    q = coordinate("theta")
    plate = Plate((a, a), m).held(q, at=(a / 2, a, 0))
    assert same(lefts(plate, weight(g)), Rational(5, 12) * a * q.acceleration + g * sin(q) / 2)


def test_a_ladder_slides_down_a_wall() -> None:
    """Landau, Lifshitz, section 38, and Taylor, problem 7: theta_ddot = 3 g sin theta/(2 l), theta from the wall."""
    q = coordinate("theta")
    ladder = Rod(l, m).placed(-q, centre=point(l * sin(q) / 2, l * cos(q) / 2))
    assert same(lefts(ladder, weight(g)), 2 * l * q.acceleration - 3 * g * sin(q))


def test_the_lagrangian_of_the_heavy_top() -> None:
    """Goldstein, Poole, Safko, equation 5.52, in its very form."""
    (phi, theta, psi), body = top()
    L = lagrangian(System(body, weight(g)))
    expected = (
        A * (theta.rate**2 + phi.rate**2 * sin(theta) ** 2) / 2
        + C * (psi.rate + phi.rate * cos(theta)) ** 2 / 2
        - M * g * l * cos(theta)
    )
    assert equal(L.value, expected)
    assert explicit(L.value).has(sin(theta) ** 2) and not explicit(L.value).has(cos(theta) ** 2)


def test_a_top_with_its_moments_about_the_centre_of_mass_has_the_others_by_parallel_axes() -> None:
    _, body = top(about="centre_of_mass")
    _, other = top((A + M * l**2, A + M * l**2, C))
    assert equal(energy(body), energy(other))


def test_a_cone_rolls_on_a_plane() -> None:
    """Landau, Lifshitz, *Mechanics*, section 32, problem 7: T = 3 M h^2 phi_dot^2 (1 + 5 cos^2 alpha)/40."""
    phi, psi = coordinate("phi"), coordinate("psi")
    line = space.turned(Z, phi)
    cone = Cone(h * tan(alpha), h, M).held(line.turned(Y, pi / 2 - alpha).turned(Z, psi), at="apex")
    rolling = no_slip(cone, at=line.place(1, 0, 0))
    assert equal(rolling.value, Relation(psi.rate, "=", -phi.rate / sin(alpha)))
    T = kinetic_energy_of(System(cone, rolling))
    assert T.value == Rational(3, 40) * M * h**2 * (1 + 5 * cos(alpha) ** 2) * phi.rate**2
    assert list(T.coordinates) == [phi.symbol]


def test_a_cylinder_rolls_within_a_cylinder() -> None:
    """Landau, Lifshitz, section 32, problem 4: T = 3 m (R - a)^2 phi_dot^2/4."""
    q, turning = coordinate("theta"), coordinate("phi")
    out = R - a
    body = Cylinder(a, h, m).placed(turning, centre=point(out * sin(q), -out * cos(q)), across="z")
    rolling = no_slip(body, at=point(R * sin(q), -R * cos(q)))
    assert equal(rolling.value, Relation(turning.rate, "=", -out * q.rate / a))
    L = lagrangian(System(body, rolling, weight(g)))
    assert equal(L.value, Rational(3, 4) * m * out**2 * q.rate**2 + m * g * out * cos(q))
    (motion,) = equations_of_motion(L)
    assert same([explicit(motion.value).residual], m * out * (3 * out * q.acceleration + 2 * g * sin(q)))


def test_a_disc_that_rolls_at_a_spring() -> None:
    x, turning = coordinate("x", "length"), coordinate("theta")
    disc = Disc(R, M).placed(-turning, centre=point(x, R))
    rolling = no_slip(disc, at=point(x, 0))
    found = lefts(disc, rolling, spring(k, point(0, R), point(x, R)))
    assert same(found, 3 * M * x.acceleration + 2 * k * x.symbol)


def test_a_disc_rolls_on_a_plank_that_slides() -> None:
    x, s, turning = coordinate("x", "length"), coordinate("s", "length"), coordinate("theta")
    disc = Disc(R, M).placed(-turning, centre=point(x, R))
    rolling = no_slip(disc, at=point(x, 0), ground=point(s, 0))
    assert equal(rolling.value, Relation(turning.rate, "=", (x.rate - s.rate) / R))


def test_a_rate_that_cannot_be_isolated_as_asked_is_refused() -> None:
    """The factor of x_dot varies, so the rate of the rotation is isolated, although the script asks for x_dot."""
    x, turning = coordinate("x", "length"), coordinate("theta")
    way = x.symbol**2 / R
    disc = Disc(R, M).placed(-turning, centre=point(way, R))
    assert no_slip(disc, at=point(way, 0), fixes=turning).value.left == turning.rate
    with pytest.raises(Rejected, match="cannot isolate the rate of x: the conditions isolate theta_dot"):
        no_slip(disc, at=point(way, 0), fixes=x)


def test_a_ball_rolls_on_a_plane_with_two_conditions() -> None:
    """Goldstein, section 1.3: they cannot be integrated."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    phi, theta, psi = euler_angles()
    ball = Ball(R, m).placed(space.turned(Z, phi).turned(X, theta).turned(Z, psi), centre=point(x, y, R))
    first, second = no_slip(ball, at=point(x, y, 0))
    turning = theta.rate * sin(phi) - psi.rate * sin(theta) * cos(phi)
    assert equal(first.value, Relation(x.rate, "=", R * turning))
    assert equal(second.value, Relation(y.rate, "=", -R * (theta.rate * cos(phi) + psi.rate * sin(theta) * sin(phi))))
    with pytest.raises(Rejected, match="does not express one coordinate by others"):
        System(ball, first)


def test_a_slab_rocks_on_a_cylinder() -> None:
    q = coordinate("theta")
    centre = point((R + a / 2) * sin(q) - R * q * cos(q), (R + a / 2) * cos(q) + R * q * sin(q))
    slab = RigidBody(M, I_0).placed(-q, centre=centre)
    (found,) = lefts(slab, weight(g))
    x = q.symbol
    inertia = I_0 + M * (R**2 * x**2 + a**2 / 4)
    expected = inertia * q.acceleration + M * R**2 * x * q.rate**2 + M * g * (R * x * cos(q) - a * sin(q) / 2)
    assert same([found], expected)


def test_atwoods_machine_with_a_pulley_that_has_mass() -> None:
    """Kleppner, Kolenkow, example 7.12: (m_1 + m_2 + M/2) a = (m_1 - m_2) g."""
    x = coordinate("x", "length")
    m1, m2 = symbols("m_1 m_2", positive=True)
    pulley = Disc(R, M).placed(-x / R, centre=point(0, 0))
    found = lefts(Particle(m1, point(R, -x)), Particle(m2, point(-R, x - l)), pulley, weight(g))
    assert same(found, (m1 + m2 + M / 2) * x.acceleration - (m1 - m2) * g)


def test_a_body_that_moves_freely_in_space_has_both_energies() -> None:
    x, phi = coordinate("x", "length"), coordinate("phi")
    block = Cuboid((a, a, h), m).placed(space.turned(Z, phi), centre=point(x, 0, 0))
    assert equal(energy(block), m * x.rate**2 / 2 + m * a**2 * phi.rate**2 / 12)


def test_products_of_inertia_take_part() -> None:
    phi = coordinate("phi")
    block = Cuboid((a, a, a), m)
    assert equal(energy(block.held(space.turned(Z, phi), at="corner")), m * a**2 * phi.rate**2 / 3)
    tilted = block.held(space.turned(Z, phi).turned(X, pi / 4), at="corner")
    moment = m * a**2 * (Rational(2, 3) - Rational(1, 4))  # n.J n with n = (0, 1, 1)/sqrt 2
    assert equal(energy(tilted), moment * phi.rate**2 / 2)


def test_a_body_turned_by_the_time_is_driven() -> None:
    q = coordinate("theta")
    rod = Rod(l, m).held(space.turned(Z, w * t).turned(X, q), at="end")
    found = energy(rod)
    assert equal(found, m * l**2 * (q.rate**2 + w**2 * sin(q) ** 2) / 6)


def test_two_rods_of_one_page_have_names_of_their_own() -> None:
    q, p = coordinate("theta"), coordinate("phi")
    upper, lower = Rod(l, m).named("upper rod"), Rod(a, M).named("lower rod")
    joint = point(l * sin(q), -l * cos(q))
    parts = upper.held(q + pi, at="end"), lower.held(p + pi, at="end", on=joint)
    L = lagrangian(System(*parts, weight(g)))
    moments = m * l**2 / 3 + M * l**2, M * a**2 / 3
    expected = moments[0] * q.rate**2 / 2 + moments[1] * p.rate**2 / 2
    expected += M * l * a * q.rate * p.rate * cos(q - p.symbol) / 2
    expected += (m * l / 2 + M * l) * g * cos(q) + M * g * a * cos(p) / 2
    assert equal(L.value, expected)


def test_two_systems_of_one_page_have_names_of_their_own() -> None:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    first = lagrangian(System(Particle(m, point(0, x)), weight(g), name="first"))
    second = lagrangian(System(Particle(M, point(0, y)), weight(g), name="second"))
    assert [str(L.symbol) for L in (first, second)] == ["L_first", "L_second"]
    assert [e.key for L in (first, second) for e in equations_of_motion(L)] == ["first_motion_x", "second_motion_y"]


def test_angular_velocity_of_eulers_angles_along_body_and_space() -> None:
    """Goldstein, Poole, Safko, section 4.9, equation 4.87, and its exercise on space axes."""
    phi, theta, psi = euler_angles()
    axes = space.turned(Z, phi).turned(X, theta).turned(Z, psi)
    body = Matrix(
        [
            phi.rate * sin(theta) * sin(psi) + theta.rate * cos(psi),
            phi.rate * sin(theta) * cos(psi) - theta.rate * sin(psi),
            phi.rate * cos(theta) + psi.rate,
        ]
    )
    fixed = Matrix(
        [
            theta.rate * cos(phi) + psi.rate * sin(theta) * sin(phi),
            theta.rate * sin(phi) - psi.rate * sin(theta) * cos(phi),
            psi.rate * cos(theta) + phi.rate,
        ]
    )
    found = angular_velocity(axes)
    assert equal(found.value, body.as_immutable()) and found.step.outcome == "body"
    again = angular_velocity(axes, along=space, symbol="Omega", key="again")
    assert equal(again.value, fixed.as_immutable()) and again.step.outcome == "space"


def held_rod(**more: Any) -> Any:
    return Rod(l, m).held(coordinate("theta"), at="end", **more)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: System(Rod(l, m)), "not a Rod"),
        (lambda: Rod(l, m).placed(coordinate("theta"), (1, 2)), "must come from `point` or `place`"),
        (
            lambda: Rod(l, m).placed(coordinate("theta"), point(0, 0, 0)),
            "if `turned` is an angle, two",
        ),
        (lambda: Rod(l, m).held("up", at="end"), "must be a set of axes or an angle"),
        (lambda: Rod(l, m).held(coordinate("theta"), at="corner"), "has no point"),
        (lambda: Rod(l, m).held(coordinate("theta"), at=(1, 2)), "three components along its axes"),
        (lambda: held_rod(across="w"), "a body has no axis"),
        (lambda: Cuboid((a, l, h), m).placed(coordinate("theta"), point(0, 0)), "turns in the plane is ambiguous"),
        (lambda: Cylinder(a, h, m).placed(coordinate("theta"), point(0, 0)), "turns in the plane is ambiguous"),
        (lambda: RigidBody(m, I_0).held(space.turned(Z, coordinate("phi")), at="centre"), "only move in a plane"),
        (lambda: RigidBody(m, (A, A, C)).held(coordinate("phi"), at="edge", across="z"), "has no point"),
        (lambda: RigidBody(m, (A, C)), "needs three moments"),
        (lambda: RigidBody(m, (A, A, C), about="corner"), "must be about"),
        (lambda: System(RigidBody(moments=(A, A, C)).placed(coordinate("p"), point(0, 0), across="z")), "the mass of"),
        (lambda: System(held_rod(), name="No. 1"), "not a valid name for a system"),
        (lambda: angular_velocity(space), "rotating axes"),
        (
            lambda: angular_velocity(space.turned(Z, coordinate("a")), space.turned(X, alpha)),
            "an intermediate stage of these axes",
        ),
        (lambda: no_slip(Rod(l, m), at=point(0, 0)), "needs a `PlacedBody`"),
        (lambda: no_slip(held_rod(), at=point(0, 0)), "never slips"),
        (lambda: no_slip(held_rod(), at=point(0, 0, 0)), "as many components as the place of the body"),
    ],
)
def test_what_cannot_be_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


def test_moments_about_the_pivot_do_not_serve_a_body_that_moves_freely() -> None:
    q = coordinate("theta")
    body = RigidBody(M, (A, A, C), centre=(0, 0, l))
    with pytest.raises(Rejected, match="are about its pivot, but the body moves freely"):
        kinetic_energy_of(System(body.placed(q, centre=point(q, 0), across="z")))
    with pytest.raises(Rejected, match="are about its pivot, but the body is held at its centre"):
        kinetic_energy_of(System(body.held(space.turned(X, q), at="centre")))


@pytest.mark.parametrize(
    ("module", "name", "wrong"),
    [
        (rigid, "_seen_from", lambda of: lambda axes, i, count: -of(axes, i, count) if i == 1 else of(axes, i, count)),
        (energies, "inertia_of", lambda of: lambda placed: of(placed) * 2),
        (energies, "turning_rate_of", lambda of: lambda placed: of(placed) * 2),
    ],
)
def test_a_wrong_law_of_a_turning_body_is_refused(module: Any, name: str, wrong: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(module, name, wrong(getattr(module, name)))
    q = coordinate("theta")
    axes = space.turned(Z, coordinate("phi")).turned(X, q)
    plane, turning = (
        RigidBody(m, I_0, centre=(0, -l)).held(q, at="pivot"),
        RigidBody(m, (A, A, C)).held(axes, at="pivot"),
    )
    system = System(turning if module is rigid else plane)
    with pytest.raises(Unverified):
        kinetic_energy_of(system)


def test_a_wrong_condition_of_rolling_is_refused(monkeypatch: Any) -> None:
    right = rolling_module.contact_velocity
    monkeypatch.setattr(rolling_module, "contact_velocity", lambda body, at, ground: right(body, at - at - at, ground))
    x, turning = coordinate("x", "length"), coordinate("theta")
    with pytest.raises(Unverified):
        no_slip(Disc(R, M).placed(-turning, centre=point(x, R)), at=point(x, Integer(0)))
