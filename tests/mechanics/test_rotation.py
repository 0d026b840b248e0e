"""A block that turns: its energy, its angular momentum, and the torque its bearings must supply."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Integer, Matrix, Rational, acos, cos, pi, simplify, sin, sqrt, symbols, zeros

from derive.errors import Rejected
from derive.mechanics import (
    Cuboid,
    Direction,
    angle_between,
    angular_momentum,
    any_angular_velocity,
    cosine_between,
    inertia_tensor,
    kinetic_energy,
    spin,
    torque,
)
from derive.steps.step import Level, Quantity
from tests.mechanics.block import M, a, b, c, known_block, omega, outcomes, values

GENERAL = {"sides": (a, b, c)}
CUBE = {"sides": (a, a, a)}
ONE, NIL = Integer(1), Integer(0)
w_x, w_y, w_z = symbols("omega_x omega_y omega_z", real=True)
BLOCK = Cuboid((a, 2 * a, 3 * a), M)
lengths = st.tuples(*[st.fractions(min_value=Rational(1, 50), max_value=50, max_denominator=50)] * 3)
ANY_AXIS = [
    {},
    GENERAL,
    {"axis": "x"},
    {"axis": (ONE, ONE, NIL)},
    {"axis": (ONE, -ONE, 2 * ONE)},
    {**GENERAL, "axis": (ONE, ONE, ONE)},
]


def along(x: int, y: int, z: int, rate: Any = omega, **named: str) -> Quantity:
    direction = BLOCK.direction(Direction(None, (Integer(x), Integer(y), Integer(z))))
    return spin(rate, direction, **{"symbol": "u", **named})


LEVEL = along(1, 1, 0, symbol="v")


# --- angular velocity ---


def test_spin_along_the_diagonal_is_one_two_three_over_root_fourteen() -> None:
    assert values()["spin"] == omega * sqrt(14) / 14 * Matrix([1, 2, 3])


@pytest.mark.parametrize("variant", ANY_AXIS)
def test_spin_has_the_length_of_its_rate(variant: dict[str, Any]) -> None:
    w = values(**variant)["spin"]
    assert simplify(w.dot(w) - omega**2) == 0


def test_a_negative_rate_turns_the_other_way() -> None:
    assert values(rate=-omega)["spin"] == -values()["spin"]


# --- kinetic energy ---


def test_energy_of_any_rotation_is_the_sum_over_the_principal_axes() -> None:
    T = values()["kinetic_energy"]
    assert (T - M * a**2 / 24 * (13 * w_x**2 + 10 * w_y**2 + 5 * w_z**2)).expand() == 0


def test_energy_about_the_diagonal_is_seven_twenty_fourths() -> None:
    assert values()["energy_about_axis"] == Rational(7, 24) * M * a**2 * omega**2


def test_energy_has_its_sum_in_sight_where_it_is_one_of_numbers() -> None:
    def reasons(sides: tuple[Any, ...], **how: Any) -> list[str]:
        body = Cuboid(sides, M)
        axis = Direction(how.pop("axis", "diagonal"))
        turning = how.pop("turning", None) or spin(omega, along=body.direction(axis))
        step = kinetic_energy(inertia_tensor(body, **how), turning).step
        return [form.because for form in step.chain if form.level is not Level.FULL]

    assert "products" in reasons((a, 2 * a, 3 * a))
    assert "products" not in reasons((a, a, a)), "equal moments leave nothing to be added up"
    assert "products" not in reasons((a, 2 * a, 3 * a), axis="z"), "one term is no sum"
    assert "products" not in reasons((a, b, c)), "the letters would only stand there twice"
    assert "products" not in reasons((a, 2 * a, 3 * a), turning=any_angular_velocity())


def test_energy_of_a_cube_is_a_twelfth_about_every_axis() -> None:
    for axis in ("diagonal", "z", (ONE, ONE, NIL)):
        assert values(**CUBE, axis=axis)["energy_about_axis"] == M * a**2 * omega**2 / 12


def test_energy_does_not_know_the_sense_of_the_rotation() -> None:
    assert values(rate=-omega)["energy_about_axis"] == values()["energy_about_axis"]


@settings(max_examples=30, deadline=None, derandomize=True)
@given(lengths, st.tuples(*[st.integers(-9, 9)] * 3))
def test_energy_is_positive_unless_nothing_turns(sides: tuple[Any, ...], rates: tuple[int, ...]) -> None:
    numbers = dict(zip((a, b, c), map(Rational, sides), strict=True))
    numbers |= {M: Integer(1), **dict(zip((w_x, w_y, w_z), map(Integer, rates), strict=True))}
    T = values(**GENERAL)["kinetic_energy"].xreplace(numbers)
    assert T > 0 if any(rates) else T == 0


# --- angular momentum ---


def test_angular_momentum_about_the_diagonal_is_13_20_15_twelfths() -> None:
    assert values()["angular_momentum"] == M * a**2 * omega * sqrt(14) / 168 * Matrix([13, 20, 15])


@pytest.mark.parametrize("variant", ANY_AXIS)
def test_twice_the_energy_is_omega_dot_angular_momentum(variant: dict[str, Any]) -> None:
    found = values(**variant)
    assert simplify(found["spin"].dot(found["angular_momentum"]) - 2 * found["energy_about_axis"]) == 0


def test_the_rate_of_the_energy_with_omega_is_the_angular_momentum() -> None:
    """L = dT/domega, component by component."""
    general = any_angular_velocity()
    L = angular_momentum(known_block()["inertia_tensor"], general).value
    T = values()["kinetic_energy"]
    assert [(T.diff(w) - component).expand() for w, component in zip((w_x, w_y, w_z), L, strict=True)] == [0, 0, 0]


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_about_a_principal_axis_angular_momentum_is_parallel_to_omega(axis: str) -> None:
    assert outcomes(axis=axis)["angular_momentum"] == "parallel"
    found = values(axis=axis)
    assert found["spin"].cross(found["angular_momentum"]) == zeros(3, 1)


def test_about_the_diagonal_angular_momentum_is_not_parallel_to_omega() -> None:
    assert outcomes()["angular_momentum"] == "generic"


def test_in_a_square_block_every_axis_across_is_principal() -> None:
    variant = {"sides": (a, a, 3 * a), "axis": (ONE, -2 * ONE, NIL)}
    assert outcomes(**variant)["angular_momentum"] == "parallel"
    assert outcomes(**variant)["torque"] == "zero"


# --- the angle between ---


def test_angle_about_the_diagonal_has_the_known_cosine() -> None:
    assert values()["cosine"] == 7 * sqrt(2779) / 397
    assert round(float(values()["angle_between"]) * 180 / float(pi), 2) == 21.64


@settings(max_examples=30, deadline=None, derandomize=True)
@given(lengths)
def test_angle_is_always_less_than_a_right_angle(sides: tuple[Any, ...]) -> None:
    """omega . L = 2T > 0."""
    numbers = dict(zip((a, b, c), map(Rational, sides), strict=True))
    assert 0 < values(**GENERAL)["cosine"].subs(numbers) <= 1


def test_angle_does_not_know_the_size_of_the_block() -> None:
    assert not {a, M, omega} & values()["angle_between"].free_symbols
    assert simplify(values(**GENERAL)["cosine"].subs({b: 2 * a, c: 3 * a}) - values()["cosine"]) == 0


@pytest.mark.parametrize(
    ("other", "angle", "outcome"),
    [
        (along(1, 1, 0), Integer(0), "parallel"),
        (along(-1, -1, 0), pi, "opposite"),
        (along(1, -1, 0), pi / 2, "perpendicular"),
        (along(0, 0, 1), pi / 2, "perpendicular"),
        (along(1, 0, 0), pi / 4, "generic"),
        (along(-1, 0, 0), 3 * pi / 4, "generic"),
        (along(0, 1, 1), pi / 3, "generic"),
        (along(1, 1, 0, -omega), pi, "opposite"),
        (along(1, 2, 3), acos(3 * sqrt(7) / 14), "generic"),
    ],
)
def test_angle_between_known_directions_is_known(other: Quantity, angle: Any, outcome: str) -> None:
    found = angle_between(LEVEL, other)
    assert found.value == angle
    assert found.step.outcome == outcome


def test_cosine_says_when_two_vectors_are_parallel_opposite_or_perpendicular() -> None:
    others = [along(1, 1, 0), along(-1, -1, 0), along(0, 0, 1), along(1, 0, 0)]
    assert [cosine_between(LEVEL, other).step.outcome for other in others] == [
        "parallel",
        "opposite",
        "perpendicular",
        "generic",
    ]


def test_two_vectors_of_one_name_and_two_values_are_refused() -> None:
    with pytest.raises(Rejected, match="both are called u"):
        cosine_between(along(1, 0, 0), along(0, 1, 0))


def test_a_vector_that_vanishes_has_no_angle() -> None:
    block = known_block(**CUBE)
    with pytest.raises(Rejected, match="vanishes"):
        angle_between(block["spin"], block["torque"])


def test_vectors_of_two_bodies_make_no_angle() -> None:
    with pytest.raises(Rejected, match="must belong to one body"):
        angle_between(known_block()["spin"], known_block(**CUBE)["angular_momentum"])


# --- torque ---


def test_torque_about_the_diagonal_is_minus_five_four_minus_one() -> None:
    assert values()["torque"] == M * a**2 * omega**2 / 28 * Matrix([-5, 4, -1])
    assert values()["magnitude"] == sqrt(42) / 28 * M * a**2 * omega**2


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_torque_vanishes_about_a_principal_axis(axis: str) -> None:
    assert values(**GENERAL, axis=axis)["torque"] == zeros(3, 1)
    assert outcomes(**GENERAL, axis=axis)["torque"] == "zero"


def test_torque_on_a_cube_vanishes_about_every_axis() -> None:
    assert values(**CUBE, axis=(ONE, -3 * ONE, 2 * ONE))["torque"] == zeros(3, 1)


@pytest.mark.parametrize("variant", ANY_AXIS)
def test_torque_is_perpendicular_to_omega_and_to_angular_momentum(variant: dict[str, Any]) -> None:
    found = values(**variant)
    assert simplify(found["torque"].dot(found["spin"])) == 0
    assert simplify(found["torque"].dot(found["angular_momentum"])) == 0


def test_torque_obeys_the_equations_of_euler() -> None:
    """For constant omega, tau_x = (I_z - I_y) omega_y omega_z, and so on round."""
    found = values(**GENERAL)
    (I_x, I_y, I_z), w = found["inertia_tensor"].diagonal(), found["spin"]
    euler = Matrix([(I_z - I_y) * w[1] * w[2], (I_x - I_z) * w[2] * w[0], (I_y - I_x) * w[0] * w[1]])
    assert (found["torque"] - euler).applyfunc(simplify) == zeros(3, 1)


def test_where_the_letters_decide_the_outcome_says_so() -> None:
    assert outcomes(**GENERAL)["torque"] == "in_general"
    assert outcomes(**GENERAL)["angular_momentum"] == "in_general"
    assert outcomes()["torque"] == "generic"


def test_torque_does_not_know_the_sense_of_the_rotation() -> None:
    assert values(rate=-omega)["torque"] == values()["torque"]


def test_size_of_the_torque_is_omega_times_L_times_the_sine() -> None:
    found = values()
    L = found["angular_momentum"]
    size = omega * sqrt(L.dot(L)) * sin(found["angle_between"])
    assert simplify(size - found["magnitude"]) == 0
    assert cos(found["angle_between"]) == found["cosine"]


def test_arguments_in_the_wrong_order_are_refused() -> None:
    found = known_block()
    w, L, I = found["spin"], found["angular_momentum"], found["inertia_tensor"]
    for wrong in (lambda: torque(L, w), lambda: kinetic_energy(w, I), lambda: angular_momentum(w, I)):
        with pytest.raises(Rejected, match=r"needs an? "):
            wrong()


def test_a_tensor_about_another_point_than_the_axis_goes_through_is_refused() -> None:
    for verb in (kinetic_energy, angular_momentum):
        with pytest.raises(Rejected, match="`corner_tensor` is about the corner"):
            verb(known_block()["corner_tensor"], known_block()["spin"])


def test_about_its_corner_a_block_has_the_momentum_of_its_centre_besides() -> None:
    """J omega is larger than I omega by M r^2 omega, r the distance of the centre from the axis through the corner."""
    about_corner, about_centre = (
        angular_momentum(inertia_tensor(BLOCK, about=point), along(0, 0, 1, through=point)).value[2]
        for point in ("corner", "centre")
    )
    assert (about_corner - about_centre - M * omega * (a**2 + 4 * a**2) / 4).expand() == 0
