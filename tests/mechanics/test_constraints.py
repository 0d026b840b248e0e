"""Multipliers are the forces that keep the constraints: a pendulum's string, a wire, and what carries the slab."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr, Integer, cos, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation
from derive.errors import Unverified
from derive.mechanics import (
    Coordinate,
    coordinate,
    equation_with_multipliers,
    force_of_constraint,
    free_lagrangian,
    multipliers_eliminated,
    tie,
)
from derive.steps.step import Quantity
from tests.mechanics.motion import THETA, ZERO, X, b, g, l, m, motion, position
from tests.mechanics.slab import I as moment
from tests.mechanics.slab import M, R, a, known_slab

q, q_dot, q_ddot = THETA.symbol, THETA.rate, THETA.acceleration
U, V = coordinate("u", "length"), coordinate("v", "length")
gravity = symbols("g", positive=True)


def kept(u: Expr, v: Expr, angle: Coordinate = THETA, inertia: Any = ZERO) -> tuple[list[Quantity], Quantity]:
    """The forces that keep a body of mass m at (u, v), and its equation of motion with them put in."""
    ties = (tie(U, position("u", u, angle)), tie(V, position("v", v, angle)))
    free = free_lagrangian(m, g, inertia, (U, V), angle)
    equations = [equation_with_multipliers(free, c, ties) for c in (U, V, angle)]
    forces = [force_of_constraint(e, t) for e, t in zip(equations, ties, strict=False)]
    found = motion(u, v, angle, inertia=inertia, turning=angle if inertia != 0 else None)
    return forces, multipliers_eliminated(equations[2], forces, found)


def test_a_string_pulls_with_the_weight_along_it_and_the_centripetal_force() -> None:
    forces, again = kept(l * sin(q), -l * cos(q))
    along = (-sin(q), cos(q))
    pull = sum(f.value * e for f, e in zip(forces, along, strict=True))
    assert equal(pull, m * g * cos(q) + m * l * q_dot**2)
    assert equal(again.value, Relation(l * q_ddot + g * sin(q), "=", 0))


def test_at_rest_a_constraint_carries_the_weight() -> None:
    forces, _ = kept(l * sin(q), -l * cos(q))
    at_rest = {q_ddot: 0, q_dot: 0, q: 0}
    assert [f.value.subs(at_rest) for f in forces] == [0, m * g]


def test_a_rod_turns_with_the_moment_that_its_pivot_has_about_its_centre() -> None:
    _, again = kept(l * sin(q) / 2, -l * cos(q) / 2, inertia=m * l**2 / 12)
    assert equal(again.value, Relation(2 * l * q_ddot + 3 * g * sin(q), "=", 0))


def test_on_a_level_wire_the_force_across_is_the_weight_and_none_is_along() -> None:
    """The constraint v = 0 is kept by m g; u = x is no constraint on the motion and needs no force."""
    forces, again = kept(X.symbol, Integer(0) * X.symbol, X)
    assert forces[1].value == m * g
    assert equal(forces[0].value, m * X.acceleration)
    assert equal(again.value, Relation(X.acceleration, "=", 0))


def test_the_lagrangian_of_a_free_body_has_its_three_coordinates() -> None:
    free = free_lagrangian(m, g, moment, (U, V), THETA)
    expected = moment * q_dot**2 / 2 + m * (U.rate**2 + V.rate**2) / 2 - m * g * V.symbol
    assert equal(free.value, expected)
    assert free.coordinates == {U.symbol: "length", V.symbol: "length", q: "angle"}


def test_a_coordinate_that_is_kept_has_its_own_multiplier_and_the_other_has_all() -> None:
    found = known_slab()
    assert [found[f"motion_{name}"].step.outcome for name in ("x", "y", "theta")] == ["free", "free", "turning"]
    assert {s.name for s in found["motion_theta"].value.right.free_symbols} >= {"lambda_x", "lambda_y"}


def test_a_force_may_have_a_letter_of_its_own() -> None:
    named = tie(U, position("u", l * sin(q), THETA), multiplier="S")
    assert named.multiplier.name == "S"


def test_forces_that_are_not_those_of_the_motion_are_refused() -> None:
    """Those of the slab, with the equation of motion of another radius."""
    found = known_slab()
    forces = [found["force_x"], found["force_y"]]
    with pytest.raises(Unverified, match="`multipliers_eliminated`: its second route `solved_first` disagrees"):
        multipliers_eliminated(found["motion_theta"], forces, known_slab(radius=2 * a)["equation_of_motion"])


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
    by_components = found["force_x"].value ** 2 + found["force_y"].value ** 2
    assert equal(found["normal_force"].value ** 2 + found["tangent_force"].value ** 2, by_components)


def test_friction_and_normal_force_turn_the_slab_about_its_centre() -> None:
    """Levers R theta for the normal force, which raises the angle's opposite, and a/2 for friction."""
    found = known_slab()
    moments = -found["normal_force"].value * R * q - found["tangent_force"].value * a / 2
    assert equal(Relation(moment * q_ddot, "=", moments), found["equation_of_motion"].value)


def test_the_forces_do_the_work_that_the_energy_of_the_centre_gains() -> None:
    found = known_slab()
    power = found["force_x"].value * found["x_rate"].value + found["force_y"].value * found["y_rate"].value
    energy = M * (found["x_rate"].value ** 2 + found["y_rate"].value ** 2) / 2 + found["potential_energy"].value
    assert equal(power, energy.diff(q) * q_dot + energy.diff(q_dot) * q_ddot)


@pytest.mark.parametrize("variant", [{"thickness": Integer(0)}, {"inertia": Integer(0)}, {"radius": a / 2}])
def test_the_forces_are_found_in_boundary_cases_too(variant: dict[str, Any]) -> None:
    found = known_slab(**variant)
    assert equal(found["multipliers_eliminated"].value, found["equation_of_motion"].value)
    assert b not in found["normal_force"].value.free_symbols
