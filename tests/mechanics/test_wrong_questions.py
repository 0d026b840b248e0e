"""A right law asked about the wrong thing is refused, and the message names what does not fit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from sympy import Integer, Matrix, Rational, cos, sin, symbols

from derive.algebra.expressions import TIME, Relation
from derive.errors import DeriveError
from derive.mechanics import (
    Cuboid,
    Cylinder,
    Direction,
    Particle,
    Plate,
    RigidBody,
    Rod,
    System,
    angle_between,
    angular_momentum,
    any_angular_velocity,
    at,
    changing_angular_velocity,
    components,
    coordinate,
    equation_of_motion,
    euler_equations,
    frequency_squared,
    inertia_tensor,
    kinetic_energy,
    lagrangian,
    leading_order,
    let,
    linearised,
    magnitude,
    moment_of_inertia,
    moved_to,
    no_slip,
    point,
    principal_moments,
    rate_in_space,
    rate_of,
    solved_for,
    spin,
    torque,
    weight,
    with_values,
)
from derive.steps.derivation import with_ancestors
from derive.steps.record import recorded
from tests.mechanics.block import known_block
from tests.mechanics.motion import motion, potential
from tests.mechanics.slab import known_slab

a, b, l, m, M, R, h, g, k, omega, Omega = symbols("a b l m M R h g k omega Omega", positive=True)
BLOCK, OTHER = Cuboid((a, 2 * a, 3 * a), M), Cuboid((b, b, 2 * b), m)
DIAGONAL = Direction("diagonal")
THETA = coordinate("theta")
NOTHING = Integer(0)


def of_block() -> Any:
    return known_block()["inertia_tensor"]


def slab(radius: Any = R, mass: Any = M, inertia: Any = k) -> Any:
    with recorded():
        theta, way = coordinate("theta"), coordinate("s", "length")
        body = RigidBody(mass, inertia)
        rolled = body.placed(-theta, point(-way, radius + a / 2).turned(-theta))
        centre = components(rolled, no_slip(rolled, at=point(0, radius).turned(-theta), fixes=way))
        return lagrangian(System(body.placed(-theta, point(*centre)), weight(g)))


def grown() -> Any:
    length = l + a * TIME
    return motion(length * sin(THETA.symbol), -length * cos(THETA.symbol), THETA)


QUESTIONS: dict[str, tuple[Callable[[], Any], str]] = {
    "an axis of another body": (
        lambda: kinetic_energy(of_block(), spin(omega, along=OTHER.direction(DIAGONAL))),
        "must belong to one body",
    ),
    "the momentum of another rotation": (
        lambda: torque(spin(Omega, along=BLOCK.direction(DIAGONAL)), known_block()["angular_momentum"]),
        "must belong to one rotation",
    ),
    "the momentum of another axis": (
        lambda: torque(spin(omega, along=BLOCK.direction(Direction("x"))), known_block()["angular_momentum"]),
        "must belong to one rotation",
    ),
    "a rotation about another point put into a general energy": (
        lambda: at(
            kinetic_energy(of_block(), any_angular_velocity()),
            spin(omega, along=BLOCK.direction(DIAGONAL), through="corner"),
        ),
        "is about the centre",
    ),
    "an axis through a point that the body has not": (
        lambda: spin(omega, along=BLOCK.direction(DIAGONAL), through="apex"),
        'no point "apex"',
    ),
    "the torque of a rate that changes": (
        lambda: torque((w := spin(omega**2 * TIME, along=BLOCK.direction(DIAGONAL))), angular_momentum(of_block(), w)),
        "depends on the time t",
    ),
    "the torque of any angular velocity that changes": (
        lambda: torque(w := changing_angular_velocity(), angular_momentum(RigidBody(moments=(a, b, l)).tensor, w)),
        "depends on omega_x",
    ),
    "the energy of a block that grows": (
        lambda: kinetic_energy(
            inertia_tensor(grown_block := Cuboid((a + b * TIME, a, a), M)),
            spin(omega, along=grown_block.direction(Direction("z"))),
        ),
        "constant inertia tensor",
    ),
    "the momentum of a block that gains mass": (
        lambda: angular_momentum(
            inertia_tensor(heavier := Cuboid((a, a, b), M + m * TIME)),
            spin(omega, along=heavier.direction(Direction("z"))),
        ),
        "constant inertia tensor",
    ),
    "moments of a rigid body that change": (lambda: RigidBody(moments=(a * TIME, b, l)), "depends on the time t"),
    "a moment about the end": (
        lambda: slab(inertia=moment_of_inertia(Rod(l, M), axis="x", about="end")),
        "is about the end",
    ),
    "a moment about a corner": (
        lambda: slab(inertia=moment_of_inertia(Plate((a, b), M), about="corner")),
        "is about the corner",
    ),
    "a moment about an axis in the plane": (
        lambda: slab(inertia=moment_of_inertia(Plate((a, b), M), axis="x")),
        "about an axis in the plane",
    ),
    "a rod about its own line": (
        lambda: slab(inertia=moment_of_inertia(Rod(l, M), axis="z")),
        "about the axis along a rod",
    ),
    "the moment of another mass": (
        lambda: slab(mass=m, inertia=moment_of_inertia(Cylinder(R, h, M))),
        "the moment of the mass M, not of m",
    ),
    "a mass that changes": (lambda: slab(mass=M + m * TIME), "depends on the time t"),
    "rolling on a cylinder that grows": (lambda: slab(R + l * TIME), "the body cannot roll there"),
    "a component of more names than it has": (
        lambda: components(point(l, b), names=("x", "y", "z")),
        "needs 2 names, not 3",
    ),
    "a way in space that is turned in a plane": (lambda: point(l, b, a).turned(k), "rotates a displacement in a plane"),
    "a border that is none": (
        lambda: leading_order(known_slab()["potential_energy"], where=Relation(R, "=", 2 * a)),
        "not a boundary",
    ),
    "a shape of a potential that changes": (
        lambda: leading_order(potential(0 * l, TIME * l * cos(THETA.symbol), THETA)),
        "depends on the time t",
    ),
    "a frequency of what is not an oscillator": (
        lambda: frequency_squared(known_slab()["equation_of_motion"]),
        "m q_ddot + k q = 0",
    ),
    "the small oscillations of an equation of Euler's": (
        lambda: linearised(
            euler_equations(
                rate_in_space(
                    angular_momentum(RigidBody(moments=(a, b, l)).tensor, w := changing_angular_velocity()), w
                )
            )[0]
        ),
        "is not an equation of one coordinate",
    ),
    "the oscillations of a pendulum whose length changes": (
        lambda: frequency_squared(
            linearised(motion(l * TIME * sin(THETA.symbol), -l * TIME * cos(THETA.symbol), THETA))
        ),
        "depend on the time, but they must be constant",
    ),
    "values put into an inequality": (
        lambda: with_values(known_slab()["stability"], let("a", lambda: 2 * b, kind="length")),
        "is an equation or an inequality",
    ),
    "a plain matrix for a step": (lambda: magnitude(Matrix([1, 2, 3])), "needs a step as its `of`"),
    "a step for an expression": (
        lambda: spin(known_block()["spin"], along=BLOCK.direction(DIAGONAL)),
        "needs an expression as its `rate`",
    ),
    "a number for a list of keys": (
        lambda: solved_for(known_slab()["stability"], a, keys=7),
        "needs some texts as its `keys`",
    ),
    "an argument too many": (
        lambda: principal_moments(of_block(), "I", "key", "more"),
        "too many positional arguments",
    ),
    "a number with a point": (lambda: let("third", lambda: 0.3), "needs a number, an expression or an equation"),
    "a kind that is none": (lambda: let("third", lambda: a, kind="lenght"), "there is no kind `lenght`"),
    "a tensor moved to where it is": (lambda: moved_to(of_block(), BLOCK.centre), "already about the centre of mass"),
}


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_question_that_does_not_fit_names_what_does_not(question: str) -> None:
    ask, cause = QUESTIONS[question]
    with pytest.raises(DeriveError) as refusal:
        ask()
    assert cause in str(refusal.value)


def test_one_letter_is_one_quantity_of_a_run() -> None:
    with recorded():
        inertia_tensor(BLOCK, about="corner", symbol="I", key="corner_tensor")
        with pytest.raises(DeriveError, match="both called"):
            inertia_tensor(OTHER, about="corner", symbol="I", key="other_tensor")


def test_a_moved_tensor_may_not_keep_its_letter() -> None:
    corner = inertia_tensor(BLOCK, about="corner", symbol="I", key="corner_tensor")
    with pytest.raises(DeriveError, match="both called I_xx"):
        moved_to(corner, BLOCK.centre)


def test_two_bodies_of_one_shape_are_two_by_their_names() -> None:
    upper, lower = Rod(l, M).named("upper rod"), Rod(l, M).named("lower rod")
    with recorded():
        tensors = inertia_tensor(upper), inertia_tensor(lower)
        assert [q.key for q in tensors] == ["upper_rod_inertia_tensor", "lower_rod_inertia_tensor"]
        assert [q.symbol.name for q in tensors] == ["I_upper", "I_lower"]
        turning = spin(omega, along=upper.direction(Direction("x")))
        with pytest.raises(DeriveError, match="the upper rod and the second has the lower rod"):
            kinetic_energy(tensors[1], turning)


@pytest.mark.parametrize("name", ["Upper", "upper-rod", "", "one two three"])
def test_a_name_of_a_body_is_one_or_two_plain_words(name: str) -> None:
    with pytest.raises(DeriveError, match="is not a valid name for a body"):
        Rod(l, M).named(name)


def test_what_a_let_is_about_and_moves_with_is_kept() -> None:
    with recorded():
        half = let(
            "half", lambda I: I / 2, moment_of_inertia(Rod(l, M), axis="x"), symbol="J", kind="moment of inertia"
        )
        assert half.subject.point.name == "centre"
        assert half.step.kind == "moment of inertia"
        moving = let("height", lambda: l * cos(coordinate("phi").symbol) * Rational(1, 2), symbol="y", kind="length")
        assert [q.name for q in moving.coordinates] == ["phi"]
        assert rate_of(moving).step.kind == "speed"


def test_two_axes_and_two_angles_stand_on_one_page() -> None:
    with recorded():
        first, second = (BLOCK.direction(Direction(name), f"d_{name}", f"axis_{name}") for name in ("x", "diagonal"))
        one = spin(omega, along=first, symbol="omega_1", key="first_spin")
        other = spin(omega, along=second, symbol="omega_2", key="second_spin")
        angles = [
            angle_between(w, angular_momentum(of_block(), w, f"L_{n}", f"momentum_{n}"), f"theta_{n}", f"angle_{n}")
            for n, w in ((1, one), (2, other))
        ]
        assert [q.key for q in angles] == ["angle_1", "angle_2"]
        assert angles[0].value != angles[1].value


def test_two_lagrangians_of_one_coordinate_stand_on_one_page() -> None:
    with recorded():
        theta = coordinate("theta")
        equations = []
        for name, length in (("short", l), ("long", 2 * l)):
            at = point(length * sin(theta), -length * cos(theta))
            L = lagrangian(System(Particle(M, at), weight(g)), symbol=f"L_{name}", key=f"{name}_lagrangian")
            equations.append(equation_of_motion(L, theta, f"{name}_motion"))
        keys = list(with_ancestors(equations))
        assert len(keys) == len(set(keys))
        assert {"short_lagrangian_force_theta", "long_lagrangian_force_theta"} <= set(keys)
