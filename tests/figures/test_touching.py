"""What bodies and particles lean on, hang on and roll on, as their conditions say."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Matrix, cos, pi, sin, symbols

from derive.algebra.expressions import TIME, scalar
from derive.figures.parts import RopeMark
from derive.figures.surfaces import Circle
from derive.figures.surroundings import FixedEnd, FloorMark, GroundMark
from derive.figures.touching import Touching
from derive.mechanics import (
    Ball,
    Disc,
    HalfDisc,
    Hoop,
    Particle,
    Rod,
    System,
    constraint,
    coordinate,
    no_slip,
    point,
    rolling_constraint,
    weight,
)  # fmt: skip
from derive.steps.record import recorded

M, m, R, a, b, l, g = symbols("M m R a b l g", positive=True)
W = weight(g)


def marks(found: Touching, kind: type[Any]) -> list[Any]:
    return [mark for mark in found.marks if type(mark) is kind]


def ladder(*letters: str) -> Touching:
    with recorded():
        x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
        rod = Rod(l, M).placed(theta, point(x, y))
        middle = x - l / 2 * sin(theta), y - l / 2 * cos(theta)
        kept = [constraint(each, force=force) for each, force in zip(middle, letters, strict=True)]
        return Touching(System(rod, W, *kept))


def test_a_ladder_leans_against_a_wall_and_stands_on_a_floor() -> None:
    """Its upper end is at x = 0, its lower one at y = 0: Morin, Introduction to Classical Mechanics, chapter 8."""
    found = ladder("N", "F")
    (wall,), (floor,) = marks(found, GroundMark), marks(found, FloorMark)
    x, y, theta = (scalar(name) for name in ("x", "y", "theta"))
    top = {x: l / 2 * sin(theta), y: l / 2 * cos(theta)}
    assert [entry.subs(top) for entry in wall.start] == [0, 0]
    assert wall.end[0] == 0 and wall.solid[0] == -1
    assert all(place[1] == 0 for place in floor.above)
    assert floor.above[0][0].subs(top).expand() == l * sin(theta)
    assert found.values == top
    assert len(found.shown) == 2


def test_what_a_string_holds_stands_on_no_floor() -> None:
    found = ladder("T", "S")
    assert not found.marks and not found.shown


def test_an_end_that_is_kept_both_ways_is_held() -> None:
    with recorded():
        x, y, theta = coordinate("x", "length"), coordinate("y", "length"), coordinate("theta")
        rod = Rod(l, M).placed(-theta, point(x, y))
        kept = [constraint(x - l / 2 * sin(theta), force="F"), constraint(y - l / 2 * cos(theta), force="N")]
        found = Touching(System(rod, W, *kept))
    (pivot,) = marks(found, FixedEnd)
    assert list(pivot.at) == [0, 0] and pivot.joint
    assert not marks(found, FloorMark)


@pytest.mark.parametrize(("body", "far", "radius", "filled"), [
    (Ball(a, M), R + a, R, True), (Hoop(a, M), R - a, R, False),
])  # fmt: skip
def test_what_keeps_a_distance_rolls_on_a_circle(body: Any, far: Any, radius: Any, filled: bool) -> None:
    """Outside of it where the centre is R + a away, inside where it is R - a: Goldstein, section 2.4."""
    with recorded():
        r, theta, psi = coordinate("r", "length", positive=True), coordinate("theta"), coordinate("psi")
        placed = body.placed(-psi, point(r * sin(theta), r * cos(theta)), across="z")
        kept = [constraint(r, far, force="N"), constraint(a * psi - far * theta, force="F")]
        found = Touching(System(placed, W, *kept))
    (circle,) = marks(found, Circle)
    assert (circle.radius, circle.filled, list(circle.centre)) == (radius, filled, [0, 0])
    assert found.shown == set(kept)
    assert found.values == {r.symbol: far}


def test_rolling_inside_or_outside_is_told_by_what_is_at_rest() -> None:
    """Turned by -b phi/a in a cylinder of radius a + b, by b phi/a on one of b - a: Landau, Lifshitz, section 32."""
    for sense, size in ((-1, a + b), (1, b - a)):
        with recorded():
            phi = coordinate("phi")
            disc = Disc(a, M).placed(sense * b / a * phi, point(b * sin(phi), -b * cos(phi)), across="z")
            (circle,) = marks(Touching(System(disc, W)), Circle)
        assert (circle.radius - size).expand() == 0
        assert circle.filled == (sense > 0)


def test_strings_lead_from_a_pulley_to_what_hangs_beside_it() -> None:
    """Taylor, Classical Mechanics, problem 7.15 with a disc."""
    with recorded():
        x, y, phi = coordinate("x", "length"), coordinate("y", "length"), coordinate("phi")
        pulley = Disc(R, M).placed(phi, point(0, 0), across="z")
        hung = Particle(m, point(-R, -x)), Particle(m, point(R, -y))
        kept = constraint(R * phi - x, force="S_1"), constraint(-R * phi - y, force="S_2")
        found = Touching(System(pulley, *hung, W, *kept))
    assert [[list(place) for place in rope.along][1] for rope in marks(found, RopeMark)] == [[-R, 0], [R, 0]]
    assert found.shown == set(kept)


def test_a_string_unwinds_on_the_side_on_which_the_rim_is_at_rest() -> None:
    """The yo-yo of Taylor, Classical Mechanics, problem 7.14: turning to the right it hangs on its left."""
    for sense, side in ((-1, -1), (1, 1)):
        with recorded():
            y, phi = coordinate("y", "length"), coordinate("phi")
            disc = Disc(R, M).placed(sense * phi, point(0, -y), across="z")
            kept = rolling_constraint(disc, point(side * R, -y), "S")
            found = Touching(System(disc, W, *kept))
        (rope,) = marks(found, RopeMark)
        assert [list(place) for place in rope.along] == [[side * R, -y.symbol], [side * R, 0]]
        assert found.shown == set(kept)


def test_half_a_disc_rocks_on_the_ground_under_its_circle() -> None:
    with recorded():
        theta = coordinate("theta")
        half = HalfDisc(R, M).held(pi - theta, (0, 0, 0), on=point(R * theta, R), across="z")
        found = Touching(System(half, W))
        slipping = Touching(System(HalfDisc(R, M).held(pi + theta, (0, 0, 0), on=point(R * theta, R), across="z"), W))
    (floor,) = marks(found, FloorMark)
    assert Matrix(floor.above[0]) == Matrix([R * theta.symbol, 0])
    assert not slipping.marks and not slipping.rolls_at_rest


def test_what_rolls_on_a_moving_plank_is_not_on_ground_at_rest() -> None:
    with recorded():
        x, phi = coordinate("x", "length"), coordinate("phi")
        coin = Disc(R, M).placed(-phi, point(x, R), across="z")
        plank = point(a * TIME**2, 0)
        moving = Touching(System(coin, W, *rolling_constraint(coin, point(x, 0), "F", plank)))
        still = Touching(System(coin, W, *rolling_constraint(coin, point(x, 0), "F")))
        known = Touching(System(coin, W, no_slip(coin, point(x, 0))))
    assert not moving.shown and not moving.rolls_at_rest
    assert still.shown and still.rolls_at_rest and known.rolls_at_rest
