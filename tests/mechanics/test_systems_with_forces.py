"""Forces without a potential energy, and constraints that forces keep, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from sympy import Expr, cos, sin, sqrt, symbols
from sympy.polys.matrices import DomainMatrix

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Disc,
    Hoop,
    Particle,
    RigidBody,
    Rod,
    System,
    Z,
    accelerations,
    applied_force,
    central,
    charge,
    conserved,
    constraint,
    constraint_rate,
    contact,
    coordinate,
    couple,
    damping,
    dissipation_function,
    equations_of_motion,
    force,
    lagrangian,
    multipliers,
    plane,
    point,
    potential,
    space,
    spring,
    t,
    weight,
)
from derive.mechanics.lagrange import applied_forces as forced
from derive.mechanics.model import constraint as constraint_module
from derive.mechanics.model import forces
from derive.steps.record import Run, recorded

m, M, g, l, R, k, c, w, q, B, E, F_0, tau = symbols("m M g l R k c omega q B E F_0 tau", positive=True)
m1, m2, I_0 = symbols("m_1 m_2 I_0", positive=True)
alpha = symbols("alpha", real=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def lengths(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name, "length") for name in names)


def motions(*parts: Any) -> tuple[Any, ...]:
    return equations_of_motion(lagrangian(System(*parts)))


def holds(found: Any, left: Expr, right: Expr) -> bool:
    return bool(equal(found.value, Relation(left, "=", right)))


def test_a_damped_oscillator_that_is_driven() -> None:
    """Taylor, section 5.5: m x_ddot + b x_dot + k x = F cos(omega t)."""
    (x,) = lengths("x")
    at = point(x, 0)
    (found,) = motions(Particle(m, at), spring(k, point(0, 0), at), damping(c, at), force((F_0 * cos(w * t), 0), at))
    assert holds(found, m * x.acceleration + c * x.rate + k * x, F_0 * cos(w * t))
    assert found.value.right == F_0 * cos(w * t)


def test_the_dissipation_function_of_two_dampers() -> None:
    """Goldstein, Poole, Safko, section 1.5."""
    x, y = lengths("x", "y")
    system = System(Particle(m, point(x, 0)), Particle(m, point(y, 0)), damping(c, point(x, 0)), damping(k, x - y))
    assert equal(dissipation_function(system).value, c * x.rate**2 / 2 + k * (x.rate - y.rate) ** 2 / 2)


def test_a_pendulum_in_air_and_a_couple_on_its_rod() -> None:
    a = coordinate("theta")
    (found,) = motions(Rod(l, m).held(a, at="end"), couple(tau, a), damping(c, a), weight(g))
    left = m * l**2 * a.acceleration / 3 + c * a.rate - m * g * l * sin(a) / 2
    assert holds(found, left, tau)


def test_a_force_at_the_end_of_a_rod_turns_it() -> None:
    """Goldstein, section 1.4: Q = F . dr/dtheta."""
    a = coordinate("theta")
    L = lagrangian(System(Rod(l, m).held(a, at="end"), force((F_0, 0), point(-l * sin(a), l * cos(a)))))
    assert equal(applied_force(L, a).value, -F_0 * l * cos(a))


def test_a_charge_circles_in_a_magnetic_field() -> None:
    """Taylor, section 2.5: m v_dot = q v x B, with E across it."""
    x, y, z = lengths("x", "y", "z")
    at = point(x, y, z)
    found = motions(Particle(m, at), charge(q, at, E=(0, E, 0), B=(0, 0, B)))
    assert holds(found[0], m * x.acceleration - q * B * y.rate, 0)
    assert holds(found[1], m * y.acceleration + q * B * x.rate, q * E)
    assert holds(found[2], m * z.acceleration, 0)


def test_in_a_plane_the_field_points_to_the_reader() -> None:
    x, y = lengths("x", "y")
    found = motions(Particle(m, point(x, y)), charge(q, point(x, y), B=B))
    assert holds(found[0], m * x.acceleration - q * B * y.rate, 0)
    assert holds(found[1], m * y.acceleration + q * B * x.rate, 0)


def test_a_charge_in_polar_coordinates() -> None:
    """The moment of the force q r_dot B is the rate of q B r^2/2 (Landau, Lifshitz, *Fields*, section 21)."""
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at = point(r * cos(phi), r * sin(phi))
    found = motions(Particle(m, at), charge(q, at, B=B))
    assert holds(found[0], m * r.acceleration - m * r.symbol * phi.rate**2 - q * B * r.symbol * phi.rate, 0)
    turning = m * r.symbol**2 * phi.acceleration + 2 * m * r.symbol * r.rate * phi.rate + q * B * r.symbol * r.rate
    assert holds(found[1], turning, 0)


def test_a_potential_of_the_coordinates_and_the_time() -> None:
    (x,) = lengths("x")
    (found,) = motions(Particle(m, point(x, 0)), potential(k * x**4 / (4 * l**2) - F_0 * x * cos(w * t)))
    assert holds(found, m * x.acceleration + k * x.symbol**3 / l**2, F_0 * cos(w * t))


def test_atwoods_machine_by_a_multiplier() -> None:
    """Taylor, example 7.8, with x and y downwards: the tension is 2 m_1 m_2 g/(m_1 + m_2)."""
    x, y = lengths("x", "y")
    string = constraint(x + y, l, force="lambda")
    found = motions(Particle(m1, point(0, -x)), Particle(m2, point(0, -y)), weight(g), string)
    assert found[0].value == Relation(m1 * x.acceleration, "=", m1 * g + string.force)
    (tension,) = multipliers(*found)
    assert equal(tension.value, -2 * m1 * m2 * g / (m1 + m2)) and tension.step.kind == "force"
    assert equal(accelerations(*found)[0].value, (m1 - m2) * g / (m1 + m2))


def test_a_hoop_rolls_down_an_incline() -> None:
    """Goldstein, Poole, Safko, section 2.4: x_ddot = g sin phi/2 and lambda = M g sin phi/2."""
    (x,), a = lengths("x"), coordinate("theta")
    hoop = Hoop(R, M).placed(-a, centre=point(x * cos(alpha), -x * sin(alpha)))
    found = motions(hoop, weight(g), constraint(R * a - x, force="lambda"))
    (friction,) = multipliers(*found)
    down, turning = accelerations(*found)
    assert equal(friction.value, M * g * sin(alpha) / 2)
    assert equal(down.value, g * sin(alpha) / 2)
    assert equal(turning.value, g * sin(alpha) / (2 * R))


def test_a_disc_with_the_condition_of_rolling_kept_by_friction() -> None:
    (x,), a = lengths("x"), coordinate("theta")
    foot = point(x * cos(alpha), -x * sin(alpha))
    disc = Disc(R, M).placed(-a, centre=foot + point(R * sin(alpha), R * cos(alpha)))
    found = motions(disc, weight(g), *contact(disc, plane(point(0, 0), along=(cos(alpha), -sin(alpha))), rolling="F"))
    (friction,) = multipliers(*found)
    assert equal(friction.value**2, (M * g * sin(alpha) / 3) ** 2) and friction.step.kind == "force"
    assert equal(accelerations(*found)[0].value, 2 * g * sin(alpha) / 3)


def test_the_tension_of_a_pendulum() -> None:
    r, a = coordinate("r", "length", positive=True), coordinate("theta")
    bob = point(r * sin(a), -r * cos(a))
    found = motions(Particle(m, bob), weight(g), constraint(r, l, force="S"))
    (tension,) = multipliers(*found)
    assert equal(tension.value, -m * (l * a.rate**2 + g * cos(a)))
    assert equal(accelerations(*found)[1].value, -g * sin(a) / l)


def test_a_ladder_and_the_forces_of_wall_and_floor() -> None:
    """It leaves the wall where N_1 = m sin(theta) (3 g cos theta - 2 l theta_dot^2)/4 vanishes."""
    (x, y), a = lengths("x", "y"), coordinate("theta")
    wall, floor = constraint(x, l * sin(a) / 2, force="N_1"), constraint(y, l * cos(a) / 2, force="N_2")
    found = motions(Rod(l, m).placed(-a, centre=point(x, y)), weight(g), wall, floor)
    across, up = multipliers(*found)
    assert equal(across.value, m * sin(a) * (3 * g * cos(a) - 2 * l * a.rate**2) / 4)
    assert equal(up.value, m * (g + 3 * g * cos(a) ** 2 - 2 * l * a.rate**2 * cos(a)) / 4)
    assert equal(accelerations(*found)[2].value, 3 * g * sin(a) / (2 * l))


def test_a_particle_on_a_sphere_by_a_multiplier_in_cartesian_coordinates() -> None:
    """The spherical pendulum: 2 lambda l^2 = m (g z - v^2), the force along 2 r (Goldstein, section 2.4)."""
    x, y, z = lengths("x", "y", "z")
    sphere = constraint(x**2 + y**2 + z**2, l**2)
    found = motions(Particle(m, point(x, y, z)), weight(g), sphere)
    (lam,) = multipliers(*found)
    squared = x.symbol**2 + y.symbol**2 + z.symbol**2
    speed = x.rate**2 + y.rate**2 + z.rate**2
    assert equal(lam.value, m * (g * z.symbol - speed) / (2 * squared))


def test_a_blade_on_ice_keeps_a_condition_that_cannot_be_integrated() -> None:
    """Its velocity is along itself: the force across is m phi_dot v (Goldstein, section 2.4)."""
    (x, y), phi = lengths("x", "y"), coordinate("phi")
    blade = RigidBody(m, (I_0, I_0, I_0)).placed(space.turned(Z, phi), centre=point(x, y, 0))
    found = motions(blade, constraint(y.rate * cos(phi) - x.rate * sin(phi), force="S"))
    (across,) = multipliers(*found)
    assert equal(across.value, m * phi.rate * (x.rate * cos(phi) + y.rate * sin(phi)))
    assert accelerations(*found)[2].step.outcome == "zero"


def test_a_pendulum_on_a_cart_has_its_accelerations_solved_for() -> None:
    """Taylor, problem 7.31, without a spring."""
    (x,), a = lengths("x"), coordinate("theta")
    found = motions(Particle(M, point(x, 0)), Particle(m, point(x + l * sin(a), -l * cos(a))), weight(g))
    along, turning = accelerations(*found)
    below = M + m * sin(a) ** 2
    assert equal(along.value, m * sin(a) * (l * a.rate**2 + g * cos(a)) / below)
    assert equal(turning.value, -sin(a) * ((M + m) * g + m * l * a.rate**2 * cos(a)) / (l * below))


def test_the_second_derivative_of_a_constraint() -> None:
    x, y = lengths("x", "y")
    L = lagrangian(System(Particle(m, point(x, y)), constraint(x**2 + y**2, l**2)))
    found = x.symbol * x.acceleration + y.symbol * y.acceleration + x.rate**2 + y.rate**2
    assert holds(constraint_rate(L), 2 * found, 0)


def falling(*constraints: Any) -> Any:
    x, y = lengths("x", "y")
    return motions(Particle(m1, point(0, -x)), Particle(m2, point(0, -y)), weight(g), *constraints)


def test_constraints_that_repeat_or_contradict_one_another_are_refused() -> None:
    x, y = lengths("x", "y")
    found = falling(constraint(x + y, l, force="A"), constraint(2 * x + 2 * y, 2 * l, force="B"))
    with pytest.raises(Rejected, match="do not determine the constraint forces A, B"):
        accelerations(*found)
    with recorded():
        lengths("x", "y")
        found = falling(constraint(x + y, l, force="A"), constraint(x + y, 2 * l, force="B"))
        with pytest.raises(Rejected, match="A, B contradict each other"):
            multipliers(*found)


def test_the_matrix_of_the_equations_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """SymPy needs seconds to find the field of the entries of a long matrix."""
    read, from_matrix = [], DomainMatrix.from_Matrix
    monkeypatch.setattr(DomainMatrix, "from_Matrix", lambda matrix: (read.append(matrix), from_matrix(matrix))[1])
    accelerations(*falling(constraint(sum(each.symbol for each in lengths("x", "y")), l, force="A")))
    assert len(read) == 1


def test_a_coordinate_without_inertia_has_no_acceleration() -> None:
    x, y = lengths("x", "y")
    found = motions(Particle(m, point(x, 0)), spring(k, point(x, 0), point(y, 0), massless=True))
    with pytest.raises(Rejected, match="no mass moves with y"):
        accelerations(*found)


def test_a_momentum_is_not_conserved_where_a_force_acts_along_its_coordinate() -> None:
    x, y = lengths("x", "y")
    at = point(x, y)
    L = lagrangian(System(Particle(m, at), weight(g), damping(c, x)))
    with pytest.raises(Rejected, match="acts along x"):
        conserved(L, x)


def two() -> System:
    x, y = lengths("x", "y")
    return System(Particle(m, point(x, y)), constraint(x, y))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: force((1, 2, 3), point(0, 0)), "must have 2 components"),
        (lambda: force((1, 2), "here"), "needs a place|needs a `Location`"),
        (lambda: couple(tau, alpha), "contains none"),
        (lambda: damping(c * t, point(*lengths("x", "y"))), "needs a constant constant"),
        (lambda: damping(c, alpha), "must act on a place, or along a coordinate"),
        (lambda: potential(k * l), "needs an energy in coordinates"),
        (lambda: potential(k * coordinate("x", "length").rate), "depends on the rate of x"),
        (lambda: charge(q, point(0, 0), E=(coordinate("x", "length"), 0)), "needs a uniform electric field"),
        (lambda: charge(q, point(0, 0, 0), B=(0, 0, B * t)), "needs a constant magnetic field"),
        (lambda: constraint(l), "needs a formula in the coordinates"),
        (lambda: constraint(coordinate("x", "length").rate ** 2, l), "linear in their rates"),
        (lambda: constraint(coordinate("x", "length").acceleration), "linear in their rates"),
        (lambda: System(Particle(m, point(*lengths("x", "y"))), couple(tau, coordinate("phi"))), "depends on phi"),
        (
            lambda: System(Particle(m, at := point(coordinate("x", "length"), 0)), force((k * coordinate("y"), 0), at)),
            "depends on y",
        ),
        (
            lambda: System(
                Particle(m, at := point(coordinate("x", "length"), 0)),
                central(k * coordinate("y") * l, l, point(0, 0), at),
            ),
            "depends on y",
        ),
        (
            lambda: System(Particle(m, point(*(p := lengths("x", "y")))), constraint(p[0]), constraint(p[1])),
            "the same symbol",
        ),
        (lambda: accelerations(equations_of_motion(lagrangian(two()))[0]), "the equation of y is missing"),
        (lambda: multipliers(*falling()), "but this system has none"),
        (lambda: constraint_rate(lagrangian(two()), 3), "the index of a constraint"),
        (lambda: dissipation_function(System(Particle(m, point(*lengths("x", "y"))))), "a system with `damping`"),
    ],
)
def test_what_cannot_act_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


def swapped(of: Any) -> Any:
    return lambda self, moving: forces.Load(tuple(-f for f in of(self, moving).force), self.place)


def test_a_wrong_force_of_a_magnetic_field_is_refused(monkeypatch: Any) -> None:
    monkeypatch.setattr(forces.MagneticForce, "load", swapped(forces.MagneticForce.load))
    x, y = lengths("x", "y")
    with pytest.raises(Unverified):
        motions(Particle(m, point(x, y)), charge(q, point(x, y), B=B))


def test_a_wrong_dissipation_function_is_refused(monkeypatch: Any) -> None:
    right = forced.squares_of_velocity
    monkeypatch.setattr(forced, "squares_of_velocity", lambda damper, moving: 2 * right(damper, moving))
    x, y = lengths("x", "y")
    with pytest.raises(Unverified):
        motions(Particle(m, point(x, y)), damping(c, point(x, y)))


def test_a_wrong_force_of_constraint_is_refused(monkeypatch: Any) -> None:
    right = constraint_module.Constraint.acceleration
    monkeypatch.setattr(constraint_module.Constraint, "acceleration", lambda self, q: right(self, q) + sqrt(g))
    x, y = lengths("x", "y")
    with pytest.raises(Unverified):
        accelerations(*falling(constraint(x + y, l)))


def test_what_a_force_adds_to_an_equation_is_explicit() -> None:
    x, y = lengths("x", "y")
    found = motions(Particle(m, point(x, y)), force((F_0, 0), point(x, y)))
    assert [each.step.outcome for each in found] == ["applied", "free"]
    assert explicit(found[1].value.right) == 0
