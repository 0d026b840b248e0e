"""A block: its density, its centre of mass, its directions, and the particles that stand for it."""

from __future__ import annotations

import pytest
from sympy import Integer, Matrix, Rational, integrate, symbols

from derive.errors import Rejected
from derive.mechanics import Cuboid, Direction
from tests.mechanics.block import M, a, b, c, values

x, y, z = symbols("x y z", real=True)
BLOCK = Cuboid((a, b, c), M)


def test_density_times_volume_is_the_mass() -> None:
    assert BLOCK.density.value * a * b * c == M


def test_density_of_a_cube_is_the_mass_over_the_cubed_side() -> None:
    assert Cuboid((a, a, a), M).density.value == M / a**3


def test_density_is_the_same_for_every_order_of_the_sides() -> None:
    assert Cuboid((c, a, b), M).density.value == BLOCK.density.value


def test_centre_of_mass_is_in_the_middle() -> None:
    assert BLOCK.centre.value == Matrix([a, b, c]) / 2
    assert values()["centre_of_mass"] == Matrix([a / 2, a, 3 * a / 2])


def test_particles_have_the_mass_of_the_block() -> None:
    assert sum(mass for mass, _ in BLOCK.particles()) == M


def test_particles_have_their_mean_in_the_middle() -> None:
    weighted = sum((mass * place for mass, place in BLOCK.particles()), Matrix([0, 0, 0]))
    assert (weighted / M).expand() == Matrix([a, b, c]) / 2


@pytest.mark.parametrize(("i", "j"), [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
def test_particles_have_the_second_moments_of_the_block(i: int, j: int) -> None:
    by_particles = sum(mass * place[i] * place[j] for mass, place in BLOCK.particles())
    by_integral = integrate((x, y, z)[i] * (x, y, z)[j], (x, 0, a), (y, 0, b), (z, 0, c)) * M / (a * b * c)
    assert (by_particles - by_integral).expand() == 0


@pytest.mark.parametrize(
    ("axis", "along"), [("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1)), ("diagonal", (a, b, c))]
)
def test_a_named_axis_is_an_edge_or_the_long_diagonal(axis: str, along: tuple[object, ...]) -> None:
    direction = BLOCK.direction(Direction(axis))
    assert direction.value == Matrix(along)
    assert direction.step.outcome == ("diagonal" if axis == "diagonal" else "edge")


def test_components_are_a_direction_as_they_are() -> None:
    direction = BLOCK.direction(Direction(None, (Integer(1), Integer(1), Rational(1, 2))))
    assert direction.value == Matrix([1, 1, Rational(1, 2)])
    assert direction.step.outcome == "components"


def test_an_unknown_axis_is_refused_with_those_that_there_are() -> None:
    with pytest.raises(Rejected) as refusal:
        BLOCK.direction(Direction("w"))
    (complaint,) = refusal.value.complaints
    assert complaint.message == "a cuboid has no axis `w`"
    assert complaint.help == "use diagonal, x, y or z"


def test_an_unknown_point_is_refused_with_those_that_there_are() -> None:
    with pytest.raises(Rejected) as refusal:
        BLOCK.point("edge")
    (complaint,) = refusal.value.complaints
    assert complaint.message == 'a cuboid has no point "edge"'
    assert complaint.help == 'it has "corner", "centre"'
