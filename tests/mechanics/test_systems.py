"""Systems of particles: their energies and equations of motion, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    X,
    Y,
    Z,
    central,
    coordinate,
    equation_of_motion,
    equations_of_motion,
    lagrangian,
    point,
    potential_energy_of,
    space,
    spring,
    weight,
)
from derive.steps.record import Run, recorded

m, M, g, l, k, R, w, G = symbols("m M g l k R omega G", positive=True)
m1, m2, l1, l2 = symbols("m_1 m_2 l_1 l_2", positive=True)
alpha = symbols("alpha", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def angles(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name) for name in names)


def lengths(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name, "length") for name in names)


def left_sides(*parts: Any) -> list[Expr]:
    return [explicit(motion.value).residual for motion in equations_of_motion(lagrangian(System(*parts)))]


def same(found: list[Expr], *expected: Expr) -> bool:
    assert len(found) == len(expected)
    return all(
        equal(Relation(one, "=", 0), Relation(other, "=", 0)) for one, other in zip(found, expected, strict=True)
    )


def test_the_double_pendulum() -> None:
    """Taylor, section 11.4: the exact equations."""
    a, b = angles("theta", "phi")
    upper = point(l1 * sin(a), -l1 * cos(a))
    lower = upper + point(l2 * sin(b), -l2 * cos(b))
    found = left_sides(Particle(m1, upper), Particle(m2, lower), weight(g))
    x, y = a.symbol, b.symbol
    assert same(
        found,
        (m1 + m2) * l1 * a.acceleration
        + m2 * l2 * (b.acceleration * cos(x - y) + b.rate**2 * sin(x - y))
        + (m1 + m2) * g * sin(x),
        l2 * b.acceleration + l1 * a.acceleration * cos(x - y) - l1 * a.rate**2 * sin(x - y) + g * sin(y),
    )


def test_a_bead_on_a_hoop_that_turns_about_its_diameter() -> None:
    """Taylor, example 7.6: theta_ddot = (omega^2 cos theta - g/R) sin theta."""
    (q,) = angles("theta")
    bead = Particle(m, space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q)))
    assert same(left_sides(bead, weight(g)), q.acceleration - (w**2 * cos(q) - g / R) * sin(q))


def test_a_particle_in_the_field_of_a_centre() -> None:
    """Goldstein, section 3.2."""
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    place, d = point(r * cos(phi), r * sin(phi)), symbols("d", positive=True)
    found = left_sides(Particle(m, place), central(-G * M * m / d, d, point(0, 0), place))
    radial = m * r.acceleration - m * r.symbol * phi.rate**2 + G * M * m / r.symbol**2
    assert same(found, radial, r.symbol * phi.acceleration + 2 * r.rate * phi.rate)


def test_a_spring_pendulum() -> None:
    r, q = coordinate("r", "length", positive=True), coordinate("theta")
    bob = point(r * sin(q), -r * cos(q))
    found = left_sides(Particle(m, bob), weight(g), spring(k, point(0, 0), bob, l))
    radial = m * r.acceleration - m * r.symbol * q.rate**2 - m * g * cos(q) + k * (r.symbol - l)
    assert same(found, radial, r.symbol * q.acceleration + 2 * r.rate * q.rate + g * sin(q))


def test_two_masses_between_three_springs(run: Run) -> None:
    """Taylor, section 11.2; the lengths of the springs are taken to stay positive."""
    x, y = lengths("x", "y")
    first, second = point(l + x, 0), point(2 * l + y, 0)
    walls = point(0, 0), point(3 * l, 0)
    springs = spring(k, walls[0], first, l), spring(k, first, second, l), spring(k, second, walls[1], l)
    found = left_sides(Particle(m, first), Particle(m, second), *springs)
    assert same(found, m * x.acceleration + k * (2 * x - y), m * y.acceleration + k * (2 * y - x))
    assert [str(condition) for condition in run.assumed] == ["l + x > 0", "l - x + y > 0", "l - y > 0"]


def test_a_block_that_slides_on_a_wedge_that_slides() -> None:
    """Taylor, example 7.5: the block accelerates along the wedge at g sin a/(1 - m cos^2 a/(M + m))."""
    x, s = lengths("x", "s")
    found = left_sides(Particle(M, point(x, 0)), Particle(m, point(x + s * cos(alpha), -s * sin(alpha))), weight(g))
    along = (M + m) * x.acceleration + m * s.acceleration * cos(alpha)
    assert same(found, along, s.acceleration + x.acceleration * cos(alpha) - g * sin(alpha))


def test_the_masses_of_atwoods_machine_hang_on_one_string() -> None:
    (x,) = lengths("x")
    found = left_sides(Particle(m1, -x * Z), Particle(m2, (x - l) * Z), weight(g))
    assert same(found, (m1 + m2) * x.acceleration - (m1 - m2) * g)


def test_a_pendulum_whose_support_is_moved_by_a_formula_of_the_time() -> None:
    """Landau, Lifshitz, section 5, problem 3c: the support goes up and down."""
    (q,) = angles("theta")
    height = R * cos(w * t)
    found = left_sides(Particle(m, point(l * sin(q), height - l * cos(q))), weight(g))
    assert same(found, l * q.acceleration + (g - R * w**2 * cos(w * t)) * sin(q))


def test_a_system_without_forces_has_no_potential_energy() -> None:
    (x,) = lengths("x")
    potential = potential_energy_of(System(Particle(m, point(x, 0))))
    assert (potential.value, potential.step.outcome) == (0, "zero")


def test_a_weight_acts_along_the_last_axis() -> None:
    x, z = lengths("x", "z")
    found = potential_energy_of(System(Particle(m, point(0, x, z)), weight(g)))
    assert explicit(found.value) == m * g * z.symbol


def test_axes_turn_about_axes_that_have_turned() -> None:
    """Euler's angles: the axis of a body is at (sin theta sin phi, -sin theta cos phi, cos theta) (Goldstein, 4.4)."""
    phi, theta = angles("phi", "theta")
    axis = space.turned(Z, phi).turned(X, theta).place(0, 0, 1)
    assert axis.components == (sin(theta) * sin(phi), -sin(theta) * cos(phi), cos(theta))
    assert space.turned(Y, alpha).place(0, 0, 1).components == (sin(alpha), 0, cos(alpha))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: point(1), "two components or three"),
        (lambda: point("x", 0), "needs expressions"),
        (lambda: point(1, 2) + point(1, 2, 3), "one place has two components"),
        (lambda: space.turned(point(1, 1, 0), alpha), "X, Y or Z"),
        (lambda: space.place(1, 2), "needs three components"),
        (lambda: Particle(m * t, point(0, 0)), "needs a constant mass"),
        (lambda: spring(k * t, point(0, 0), point(1, 0)), "needs a constant spring constant"),
        (lambda: weight(g * t), "needs a constant gravity"),
        (lambda: central(k * l * t, l, point(0, 0), point(1, 0)), "depends on the time"),
        (lambda: Particle(m, (1, 2)), "a place that `point` or `place` gives"),
        (lambda: Particle("m", point(0, 0)), "an expression for its mass"),
        (lambda: System(), "needs a particle"),
        (lambda: System(Particle(m, point(l, alpha))), "no place or rotation in this `System` depends on a coordinate"),
        (lambda: System(Particle(m, point(0, t)), Particle(m, point(0, 0, t))), "two components, and some have three"),
        (lambda: System(Particle(m, point(l, 0)), spring(k, 0 * Z, l * Z)), "two components, and some have three"),
        (lambda: System(Particle(m, point(0, 0)), weight(g), weight(g)), "can have only one weight"),
        (lambda: System(Particle(m, point(0, 0)), Z), "not a Location"),
    ],
)
def test_what_makes_no_system_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


def test_a_particle_that_moves_as_no_coordinate_says_has_no_equation_of_motion() -> None:
    x, y = lengths("x", "y")
    with pytest.raises(Rejected, match="does not depend on the coordinate"):
        equation_of_motion(lagrangian(System(Particle(m, point(x, 0)), weight(g))), y)
