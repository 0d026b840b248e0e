"""Nothing is drawn rather than other physics: what leaves out a body, a spring, a wall or a string is no drawing."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import cos, pi, sin, symbols

from derive.algebra.expressions import TIME
from derive.figures import sketch
from derive.figures.completeness import is_whole
from derive.figures.marks import Drawing
from derive.figures.parts import BarMark, ConnectionMark, ParticleMark, WheelMark
from derive.figures.surroundings import FixedEnd, WayMark
from derive.mechanics import (
    Disc,
    Hoop,
    Particle,
    RigidBody,
    Rod,
    System,
    constraint,
    coordinate,
    point,
    potential,
    rolling_constraint,
    weight,
)  # fmt: skip
from derive.steps.record import recorded

M, m, R, a, b, k, l, g, I = symbols("M m R a b k l g I", positive=True)
W = weight(g)


def hung(length: Any, angle: Any) -> Any:
    return point(length * sin(angle), -length * cos(angle))


def drawn(*parts: Any) -> Drawing | None:
    return sketch("system", System(*parts))


def kinds(found: Drawing | None) -> set[str]:
    assert found is not None
    return {type(mark).__name__ for mark in found.marks}


def of_letters() -> Any:
    """A body of which only a moment is known, and which does not roll."""
    phi, x = coordinate("phi"), coordinate("x", "length")
    return (RigidBody(M, I).placed(-phi, point(x, R)),)


def springs_by_their_energy() -> Any:
    alpha, y = coordinate("alpha"), coordinate("y", "length")
    rod = Rod(2 * b, m).placed(alpha, point(0, y))
    return rod, potential(k / 2 * (y - b * sin(alpha)) ** 2), W


def beads_that_pull_at_each_other() -> Any:
    alpha, beta = coordinate("alpha"), coordinate("beta")
    return Particle(m, hung(R, alpha)), Particle(m, hung(R, beta)), potential(k * (alpha - beta) ** 2)


def on_a_moving_plank() -> Any:
    x, phi = coordinate("x", "length"), coordinate("phi")
    coin = Disc(R, M).placed(-phi, point(x, R), across="z")
    return coin, W, *rolling_constraint(coin, point(x, 0), "F", point(a * TIME, 0))


def without_its_string() -> Any:
    """Taylor, Classical Mechanics, problem 7.27: a pulley hangs on the string of another."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    lower = point(l, x - l)
    return Particle(m, point(0, -x)), Particle(m, lower + point(0, -y)), Particle(M, lower + point(0, y)), W


def on_a_string_that_is_none() -> Any:
    x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
    return Rod(l, M).placed(-theta, point(x, y)), W, constraint(y + l / 2 * sin(theta), force="T")


def falling_freely() -> Any:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    return Disc(R, M).placed(0, point(x, y), across="z"), W


@pytest.mark.parametrize("parts", [
    of_letters, springs_by_their_energy, beads_that_pull_at_each_other, on_a_moving_plank, without_its_string,
    on_a_string_that_is_none, falling_freely,
])  # fmt: skip
def test_nothing_is_drawn_that_would_leave_something_out(parts: Any) -> None:
    with recorded() as run:
        assert drawn(*parts()) is None
        assert not run.drawings


def test_a_script_may_add_what_is_missing() -> None:
    with recorded():
        found = sketch("system", System(*of_letters()), ParticleMark(point(0, 0).components))
    assert found is not None


@pytest.mark.parametrize(("name", "radius", "expected"), [
    ("bob", R, BarMark), ("bead", R, WayMark), ("bead", l, WayMark), ("particle", l, BarMark),
])  # fmt: skip
def test_what_hangs_is_on_a_rod_and_a_bead_is_on_a_wire(name: str, radius: Any, expected: type[Any]) -> None:
    """The formulas of a pendulum and of a bead on a hoop are the same; what it is called tells them apart."""
    with recorded():
        theta = coordinate("theta")
        found = kinds(drawn(Particle(m, hung(radius, theta), name), W))
    assert expected.__name__ in found
    assert ("BarMark" in found) == (expected is BarMark) == ("FixedEnd" in found)


def test_of_a_particle_on_a_radius_only_the_radius_is_drawn() -> None:
    with recorded():
        theta = coordinate("theta")
        found = drawn(Particle(m, hung(R, theta)), W)
    assert {"ConnectionMark", "WayMark"} <= kinds(found)
    assert not {"BarMark", "FixedEnd"} & kinds(found)
    assert found is not None and [mark.pen for mark in found.marks if isinstance(mark, WayMark)] == ["trace"]


def test_a_bead_on_a_hoop_that_hangs_on_its_rim() -> None:
    """The hoop is a ring with a joint where it hangs, the bead is on it: Goldstein, exercises of chapter 6."""
    with recorded():
        phi, psi = coordinate("phi"), coordinate("psi")
        hoop = Hoop(R, M).placed(phi, hung(R, phi))
        found = drawn(hoop, Particle(m, hung(R, phi) + hung(R, psi), "bead"), W)
    assert found is not None
    (ring,) = (mark for mark in found.marks if isinstance(mark, WheelMark))
    (joint,) = (mark for mark in found.marks if isinstance(mark, FixedEnd))
    assert ring.is_ring and list(joint.at) == [0, 0] and joint.joint
    assert not any(isinstance(mark, BarMark) for mark in found.marks)


def test_a_support_that_slides_is_no_pivot() -> None:
    with recorded():
        x, theta = coordinate("x", "length"), coordinate("theta")
        found = drawn(Particle(m, point(x, x**2 / a) + hung(l, theta), "bob"), W)
    assert found is not None
    assert [mark.pen for mark in found.marks if isinstance(mark, WayMark)] == ["wire"]
    assert not any(isinstance(mark, FixedEnd) for mark in found.marks)


def test_a_dumbbell_is_one_rod() -> None:
    with recorded():
        x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
        ends = point(x + l * sin(theta), y), point(x, y + l * cos(theta))
        kept = constraint(x, force="N"), constraint(y, force="F")
        found = drawn(*(Particle(m, end) for end in ends), W, *kept)
    assert found is not None
    assert [mark.label for mark in found.marks if isinstance(mark, BarMark)] == [l]
    assert not any(isinstance(mark, ConnectionMark | WayMark) for mark in found.marks)


def test_a_rod_in_a_bowl_has_the_circle_on_which_its_ends_are() -> None:
    beta = symbols("beta", positive=True)
    with recorded():
        theta = coordinate("theta")
        rod = Rod(2 * R * sin(beta), M).placed(pi / 2 + theta, hung(R * cos(beta), theta))
        found = drawn(rod, W)
    assert "Circle" in kinds(found)


def test_the_parts_of_the_judgement_are_those_of_a_scene() -> None:
    from derive.figures.touching import Touching

    with recorded():
        x, y = coordinate("x", "length"), coordinate("y", "length")
        system = System(Particle(m, point(x, 0)), Particle(M, point(2 * x, y)))
        assert not is_whole(system, [], [], [], Touching(system))
