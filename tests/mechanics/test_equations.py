"""Plain algebra as steps: a particular value, the length of a vector, a name for an expression."""

from __future__ import annotations

import pytest
from sympy import Integer, Matrix, Rational, Symbol, sqrt, symbols

from derive.algebra.expressions import vector
from derive.errors import Rejected
from derive.mechanics import Cuboid, Direction, any_angular_velocity, at, kinetic_energy, let, magnitude, maximum, spin
from derive.steps.establish import establish
from derive.steps.rule import RULES
from derive.steps.step import Quantity
from tests.mechanics.block import M, a, b, c, known_block, omega, outcomes, values


def defined(name: str, *components: object) -> Quantity:
    column = Matrix(components).as_immutable()
    return establish(RULES["answers.let"], vector(name), lambda: column, {}, key=name)


@pytest.mark.parametrize(
    ("components", "length"),
    [
        ((3, 4, 0), 5),
        ((-3, 0, -4), 5),
        ((1, 2, 2), 3),
        ((0, 0, -7), 7),
        ((0, 0, 0), 0),
        ((a, a, a), sqrt(3) * a),
        ((3 * a, 0, -4 * a), 5 * a),
        ((a, b, c), sqrt(a**2 + b**2 + c**2)),
        ((Rational(1, 2), Rational(1, 2), sqrt(2) / 2), 1),
    ],
)
def test_magnitude_is_the_length_of_a_vector(components: tuple[object, ...], length: object) -> None:
    assert magnitude(defined("v", *components)).value == length


def test_the_greatest_length_of_a_vector_is_named_by_the_letter_of_the_vector() -> None:
    alpha = Symbol("alpha", real=True)
    _, greatest = maximum(magnitude(defined("v", a / (1 + alpha**2), 0, 0)), alpha)
    assert str(greatest.symbol) == "v_max" and greatest.value == a


def test_magnitude_says_when_a_vector_vanishes() -> None:
    assert outcomes(sides=(a, a, a))["magnitude"] == "zero"
    assert outcomes()["magnitude"] == "generic"


def test_putting_a_direction_in_gives_what_the_law_gives_at_once() -> None:
    found = known_block()
    assert (
        at(found["kinetic_energy"], found["spin"]).value == kinetic_energy(found["inertia_tensor"], found["spin"]).value
    )


def test_putting_in_is_named_for_what_was_put_in_unless_it_is_given_a_name() -> None:
    found = known_block()
    assert at(found["kinetic_energy"], found["spin"]).key == "kinetic_energy_at_spin"
    assert at(found["kinetic_energy"], found["spin"], key="energy").key == "energy"


def test_nothing_is_put_into_what_has_no_open_components() -> None:
    found = known_block()
    with pytest.raises(Rejected) as refusal:
        at(found["magnitude"], found["spin"])
    assert refusal.value.complaints[0].message == "`magnitude` does not depend on the components of `spin`"


def test_a_name_stands_for_its_expression_and_rests_on_its_quantities() -> None:
    found = known_block()
    half = let("half", lambda T, size: T / size, found["energy_about_axis"], found["magnitude"])
    assert half.value == Rational(7, 24) / (sqrt(42) / 28)
    assert half.step.inputs == ("energy_about_axis", "magnitude")
    assert half.step.outcome == "generic"


def test_a_general_angular_velocity_has_open_components() -> None:
    general = any_angular_velocity()
    assert general.value == Matrix(symbols("omega_x omega_y omega_z", real=True))


def test_the_energy_of_a_cube_can_be_taken_at_any_direction() -> None:
    cube = known_block(sides=(a, a, a))
    block = Cuboid((a, a, a), M)
    particular = spin(omega, along=block.direction(Direction(None, (Integer(1), Integer(2), Integer(-2)))))
    assert at(cube["kinetic_energy"], particular).value == values(sides=(a, a, a))["energy_about_axis"]
