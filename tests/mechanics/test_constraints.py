"""Multipliers are the forces that keep the constraints: a pendulum's string, a wire, and what carries the slab."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Add, Dummy, Expr, Integer, Matrix, cos, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    RigidBody,
    System,
    constraint,
    constraint_force,
    coordinate,
    equations_of_motion,
    lagrangian,
    multipliers,
    point,
    put_in,
    weight,
)
from derive.mechanics.lagrange.constraint_forces import _check_short
from derive.steps.record import coordinate_named, recorded
from derive.steps.step import Quantity
from tests.mechanics.motion import THETA, X, b, g, l, m, motion
from tests.mechanics.slab import I as moment
from tests.mechanics.slab import M, R, a, known_slab

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
U, V = coordinate("u", "length"), coordinate("v", "length")
gravity = symbols("g", positive=True)


def kept(
    u: Expr, v: Expr, angle: Coordinate = THETA, inertia: Any = None, keeping: bool = True
) -> tuple[tuple[Quantity, ...], Quantity]:
    for each in (angle, U, V):
        coordinate_named(each.symbol, each.kind)
    ties = [constraint(U, u, force="lambda_u"), constraint(V, v, force="lambda_v")]
    at = point(U, V)
    body = Particle(m, at) if inertia is None else RigidBody(m, inertia).placed(angle.symbol, at)
    equations = equations_of_motion(lagrangian(System(body, weight(g), *ties)), derivatives=False)
    named = {each.key: each for each in equations}
    forces = multipliers(*equations, keeping=[angle] if keeping else [])
    return forces, named[f"motion_{angle.symbol.name}"] if f"motion_{angle.symbol.name}" in named else equations[0]


def test_at_rest_a_constraint_carries_the_weight_and_a_rod_turns_by_its_moments() -> None:
    with recorded():
        forces, turning = kept(l * sin(q) / 2, -l * cos(q) / 2, inertia=m * l**2 / 12)
        at_rest = {q_ddot: 0, q_dot: 0, q: 0}
        assert [f.value.subs(at_rest) for f in forces] == [0, m * g]
        found = motion(l * sin(q) / 2, -l * cos(q) / 2, THETA, inertia=m * l**2 / 12, turning=THETA)
        again = put_in(turning, *forces, again=found)
        assert equal(again.value, Relation(2 * l * q_ddot + 3 * g * sin(q), "=", 0))
        assert again.step.outcome == "again"
        other = motion(l * sin(q), -l * cos(q), THETA)
        with pytest.raises(Unverified, match="its check `found_before` disagrees"):
            put_in(turning, *forces, again=other, key="wrong")


@pytest.mark.parametrize("keeping", [True, False])
def test_a_string_pulls_with_the_weight_along_it_and_the_centripetal_force(keeping: bool) -> None:
    with recorded():
        forces, _ = kept(l * sin(q), -l * cos(q), inertia=moment, keeping=keeping)
        pull = constraint_force(forces, {U: -sin(q), V: cos(q)}, "S", "tension")
        assert equal(pull.value, m * g * cos(q) + m * l * q_dot**2)
        assert (pull.step.kind, pull.symbol.name) == ("force", "S")


def test_a_component_of_a_force_of_constraint_is_refused_where_it_is_none() -> None:
    with recorded():
        forces, _ = kept(l * sin(q), -l * cos(q), inertia=moment)
        with pytest.raises(Rejected, match="this system has no coordinate x"):
            constraint_force(forces, {X: 1})
        with pytest.raises(Rejected, match="lambda_v is not given, but does work in this displacement"):
            constraint_force(forces[:1], {V: 1})
        with pytest.raises(Rejected, match="forces of one system"):
            constraint_force([], {V: 1})
        with pytest.raises(Rejected, match="is not the force of a constraint"):
            constraint_force([motion(l * sin(q), -l * cos(q), THETA)], {V: 1})


def test_equations_without_their_derivatives_are_the_same() -> None:
    with recorded():
        coordinate_named(q, "angle")
        L = lagrangian(System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g)))
        short, long = (equations_of_motion(L, derivatives=each)[0] for each in (False, True))
        assert short.value == long.value
        assert [each.key for each in short.parents] == ["lagrangian"]
        assert len(long.parents) == 4


# --- what carries the slab ---


def test_balanced_at_rest_the_slab_is_carried_by_its_weight_and_needs_no_friction() -> None:
    found, at_rest = known_slab(), {q_ddot: 0, q_dot: 0, q: 0}
    assert found["normal_force"].value.subs(at_rest) == M * gravity
    assert found["tangent_force"].value.subs(at_rest) == 0


def test_held_still_on_the_slope_it_is_carried_as_on_an_inclined_plane() -> None:
    found, held = known_slab(), {q_ddot: 0, q_dot: 0}
    assert equal(found["normal_force"].value.subs(held), M * gravity * cos(q))
    assert equal(found["tangent_force"].value.subs(held), -M * gravity * sin(q))


def test_normal_force_and_friction_are_the_multipliers_in_turned_axes() -> None:
    found = known_slab()
    by_components = found["lambda_x"].value ** 2 + found["lambda_y"].value ** 2
    assert equal(found["normal_force"].value ** 2 + found["tangent_force"].value ** 2, by_components)


def test_friction_and_normal_force_turn_the_slab_about_its_centre() -> None:
    found = known_slab()
    moments = -found["normal_force"].value * R * q - found["tangent_force"].value * a / 2
    assert equal(Relation(moment * q_ddot, "=", moments), found["equation_of_motion"].value)


def test_the_forces_do_the_work_that_the_energy_of_the_centre_gains() -> None:
    found = known_slab()
    power = found["lambda_x"].value * found["x_rate"].value + found["lambda_y"].value * found["y_rate"].value
    energy = M * (found["x_rate"].value ** 2 + found["y_rate"].value ** 2) / 2 + found["potential_energy"].value
    assert equal(power, energy.diff(q) * q_dot + energy.diff(q_dot) * q_ddot)


@pytest.mark.parametrize("variant", [{"thickness": Integer(0)}, {"radius": a / 2}])
def test_the_forces_are_found_in_boundary_cases_too(variant: dict[str, Any]) -> None:
    found = known_slab(**variant)
    assert equal(found["multipliers_eliminated"].value, found["equation_of_motion"].value)
    assert b not in found["normal_force"].value.free_symbols


def test_long_solutions_with_different_roots_are_refused() -> None:
    """SymPy needs minutes to simplify them; solutions with one root are not refused."""
    x, y, z = symbols("x y z")
    names: dict[Expr, Dummy] = {sqrt(1 + x**2): Dummy("u"), sqrt(1 + y**2): Dummy("v")}
    long = Matrix([Add(*(x**i * y**k * z for i in range(9) for k in range(9)))])
    with pytest.raises(Rejected, match="too many terms"):
        _check_short(long, names)
    _check_short(long, dict([*names.items()][:1]))
