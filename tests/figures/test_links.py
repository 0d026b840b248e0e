"""Tests of the lines and angles of polar coordinates, which are found from the formulas of positions."""

from __future__ import annotations

import pytest
from sympy import cos, sin

from derive.figures.links import angle_of_link, is_fixed, is_spring, link_to, moving_in, same
from derive.mechanics import Particle, System, central, coordinate, point, spring
from derive.steps.record import recorded
from tests.figures.machines import ORIGIN, SYSTEMS, R, a, hung, k, l, l1, l2, letter, m, omega


@pytest.mark.parametrize(
    ("name", "index", "start", "length"),
    [
        ("pendulum", 0, ORIGIN, l),
        ("double", 0, ORIGIN, l1),
        ("hoop", 0, point(0, 0, 0), R),
        ("spherical", 0, point(0, 0, 0), l),
    ],
)
def test_a_constant_distance_is_a_rod(name: str, index: int, start: object, length: object) -> None:
    link = link_to(SYSTEMS[name], index)
    assert link is not None
    assert (link.start, link.length, link.is_constant) == (start, length, True)


def test_the_lower_rod_of_a_double_pendulum_hangs_on_the_upper_particle() -> None:
    link = link_to(SYSTEMS["double"], 1)
    assert link is not None
    assert same(link.start, SYSTEMS["double"].particles[0].at)
    assert link.length == l2


def test_a_pendulum_on_a_cart_hangs_on_the_cart() -> None:
    link = link_to(SYSTEMS["cart"], 1)
    assert link is not None
    assert same(link.start, SYSTEMS["cart"].particles[0].at)


def test_polar_coordinates_have_a_length_that_changes() -> None:
    link = link_to(SYSTEMS["planet"], 0)
    assert link is not None
    assert (str(link.length), link.is_constant, link.start) == ("r", False, ORIGIN)


@pytest.mark.parametrize("name", ["coupled", "parabola", "free", "incline", "bent"])
def test_what_moves_otherwise_is_held_by_no_rod(name: str) -> None:
    assert link_to(SYSTEMS[name], 0) is None


@pytest.mark.parametrize(
    ("way", "zero"),
    [
        (lambda q: point(sin(q), -cos(q)), (0, -1)),
        (lambda q: point(sin(q), cos(q)), (0, 1)),
        (lambda q: point(cos(q), sin(q)), (1, 0)),
        (lambda q: point(cos(q), -sin(q)), (1, 0)),
        (lambda q: point(-sin(q), -cos(q)), (0, -1)),
    ],
)
def test_an_angle_is_counted_from_where_it_is_zero(way: object, zero: tuple[int, int]) -> None:
    with recorded():
        theta = coordinate("theta")
        system = System(Particle(m, l * way(theta)))  # type: ignore[operator]
    link = link_to(system, 0)
    assert link is not None
    turned = angle_of_link(system, link)
    assert turned is not None
    assert (turned[0], turned[1].components) == (theta.symbol, zero)


def test_a_relative_angle_is_the_whole_angle_with_the_vertical() -> None:
    with recorded():
        theta, phi = coordinate("theta"), coordinate("phi")
        top = hung(l, theta)
        system = System(Particle(m, top), Particle(m, top + hung(l, theta + phi.symbol)))
    link = link_to(system, 1)
    assert link is not None
    turned = angle_of_link(system, link)
    assert turned is not None
    assert turned[0] == theta + phi.symbol


def test_a_way_of_two_angles_that_do_not_add_has_none() -> None:
    link = link_to(SYSTEMS["spherical"], 0)
    assert link is not None
    turned = angle_of_link(SYSTEMS["spherical"], link)
    assert turned is not None
    assert str(turned[0]) == "theta"


def test_a_spring_has_an_energy_of_the_second_degree() -> None:
    d = letter("d")
    assert is_spring(spring(k, ORIGIN, point(l, 0), a))
    assert is_spring(central(k * d**2 / 2, d, ORIGIN, point(l, 0)))
    for energy in (-k / d, k * d, -k * d**2):
        assert not is_spring(central(energy, d, ORIGIN, point(l, 0)))


def test_what_contains_the_time_moves() -> None:
    system = SYSTEMS["driven"]
    assert {letter.name for letter in moving_in(system, *system.particles[0].at.components)} == {"t", "theta"}
    assert is_fixed(system, point(a, omega))
