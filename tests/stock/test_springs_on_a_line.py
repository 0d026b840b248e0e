"""Springs and charges along a line: the distance is |x - d|, with both of its sides unless the page states one."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Abs, Expr, Rational, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from derive.steps.step import Quantity
from tests.stock.described import course_with, edited, messages, solved

m, k, l, d, g, A = symbols("m k l d g A", positive=True)
x, x_ddot, y = symbols("x x_ddot y", real=True)

WALL = """\
title: A cart and a wall
solve: system
symbols: {m: mass, k: spring constant, l: length, d: length, g: acceleration, A: length}
given:
  coordinates: {x: length}
  particles: {cart: {mass: m, at: [x, 0]}}
  springs: {constant: k, from: [d, 0], to: [x, 0], length: l}
statement: A cart.
parts:
  - {ask: Find what is asked., answer: [equations_of_motion, equilibria, stability]}
"""
BOTH = """springs:
    - {constant: k, from: [0, 0], to: [x, 0], length: l}
    - {constant: K, from: [d, 0], to: [x, 0], length: l}
  assume: d > 2*l
  at: {x: (k*l + K*(d - l))/(k + K)}"""
HANGING = (("at: [x, 0]}", "at: [0, -x]}"), ("from: [d, 0], to: [x, 0]", "from: [0, 0], to: [0, -x]"))


def rests(steps: dict[str, Quantity]) -> list[Expr]:
    return [quantity.value for key, quantity in steps.items() if key.split("_")[0] == "rest"]


def test_a_cart_is_at_rest_on_both_sides_of_a_wall_that_nothing_favours(tmp_path: Path) -> None:
    steps = solved(tmp_path, WALL)
    assert set(rests(steps)) == {d - l, d + l}
    assert equal(explicit(steps["motion_x"].value), Relation(m * x_ddot + k * (x - d) * (1 - l / Abs(x - d)), "=", 0))
    assert [steps[f"stability_{n}"].value for n in (1, 2)] == [k, k]


def test_a_cart_between_two_walls_is_never_outside_both(tmp_path: Path) -> None:
    """x < 0 and x > d contradict each other, whatever the constants of the springs."""
    between = edited(
        WALL,
        ("l: length, d", "K: spring constant, l: length, d"),
        (
            "springs: {constant: k, from: [d, 0], to: [x, 0], length: l}",
            BOTH.partition("\n  assume")[0] + "\n  assume: d > 2*l",
        ),
    )
    steps = solved(tmp_path, between)
    k, K = symbols("k K", positive=True)
    middle = (k * l + K * (d - l)) / (k + K)
    assert any(equal(value, middle) for value in rests(steps))
    assert len(rests(steps)) == 3


def test_a_weight_can_stand_on_a_spring_that_is_strong_enough(tmp_path: Path) -> None:
    """k(|x| - l) x/|x| = m g: x = l + m g/k below the hook, x = -l + m g/k above it, where that is negative."""
    hanging = edited(WALL, *HANGING, ("length: l}", "length: l}\n  gravity: g"))
    steps = solved(tmp_path, hanging)
    assert {value.expand() for value in rests(steps)} == {l + m * g / k, m * g / k - l}
    text = rendered(course_with(tmp_path, hanging), "trial/one", only={"text"}).texts["text"]
    assert "If k l > m g there is also" in text and "for k l > m g" in text


def test_two_carts_on_one_track_have_every_order_at_rest(tmp_path: Path) -> None:
    two = edited(
        WALL,
        ("{x: length}", "{x: length, y: length}"),
        ("{mass: m, at: [x, 0]}}", "{mass: m, at: [x, 0]}, other: {mass: m, at: [y, 0]}}"),
        ("length: l}\nst", "length: l}\n    - {constant: k, from: [x, 0], to: [y, 0], length: l}\nst"),
        ("springs: {", "springs:\n    - {"),
    )
    assert {tuple(value) for value in rests(solved(tmp_path, two))} == {
        (d - l, d - 2 * l),
        (d - l, d),
        (d + l, d),
        (d + l, d + 2 * l),
    }


def test_displacements_from_the_natural_length_keep_one_side_and_the_page_says_so(tmp_path: Path) -> None:
    natural = edited(WALL, ("length: l}", "length: d}"))
    steps = solved(tmp_path, natural)
    assert equal(explicit(steps["motion_x"].value), Relation(m * x_ddot + k * x, "=", 0))
    text = " ".join(rendered(course_with(tmp_path, natural), "trial/one", only={"text"}).texts["text"].split())
    assert "As long as no spring is compressed to zero length, the only equilibrium is" in text


def test_springs_that_balance_keep_one_side_though_they_are_stretched(tmp_path: Path) -> None:
    balanced = edited(
        WALL,
        ("at: [x, 0]}", "at: [d + x, 0]}"),
        (
            "{constant: k, from: [d, 0], to: [x, 0], length: l}",
            "[{constant: k, from: [0, 0], to: [d + x, 0], length: l}, "
            "{constant: k, from: [d + x, 0], to: [2*d, 0], length: l}]",
        ),
    )
    steps = solved(tmp_path, balanced)
    assert equal(explicit(steps["motion_x"].value), Relation(m * x_ddot + 2 * k * x, "=", 0))


def test_a_spring_whose_side_depends_on_letters_has_an_equation_of_motion(tmp_path: Path) -> None:
    steps = solved(tmp_path, edited(WALL, ("from: [d, 0]", "from: [A - d, 0]"), (", equilibria, stability", "")))
    way = x - A + d
    assert equal(explicit(steps["motion_x"].value), Relation(m * x_ddot + k * way * (1 - l / Abs(way)), "=", 0))


def test_a_spring_from_a_corner_of_a_tilted_rod_has_its_length(tmp_path: Path) -> None:
    """Half-angles: (l/2 - (l/2) cos q)^2 + (y + (l/2) sin q)^2 = l^2/2 + y^2 - (l^2/2) cos q + l y sin q."""
    rod = """\
title: A rod on a spring
solve: system
symbols: {M: mass, l: length, g: acceleration, k: spring constant}
given:
  coordinates: {y: length, theta: angle}
  places: {P: [-l/2, 0]}
  bodies: {rod: {shape: rod, length: l, mass: M, turned: theta, centre: [0, -y]}}
  springs: {constant: k, from: P, to: [-l/2*cos(theta), -y - l/2*sin(theta)]}
  gravity: g
statement: A rod.
parts:
  - {ask: Find it., answer: motion_y}
"""
    M = symbols("M", positive=True)
    theta, y_ddot = symbols("theta y_ddot", real=True)
    expected = M * y_ddot + k * y + Rational(1, 2) * k * l * sin(theta) - M * g
    assert equal(explicit(solved(tmp_path, rod)["motion_y"].value), Relation(expected, "=", 0))


@pytest.mark.parametrize("side", ["[d, 0]", "[-d, 0]"])
def test_the_energy_of_a_spring_does_not_depend_on_which_end_is_named_first(tmp_path: Path, side: str) -> None:
    one = edited(WALL, ("from: [d, 0]", f"from: {side}"), (", equilibria, stability", ""))
    other = edited(
        one, (f"from: {side}, to: [x, 0]", f"from: [x, 0], to: {side}"), ("title: A cart and a wall", "title: T")
    )
    energies = [solved(tmp_path, text)["potential_energy"].value for text in (one, other)]
    assert equal(*energies)


def test_a_cart_between_two_walls_may_be_at_rest_beyond_them_if_the_springs_are_long(tmp_path: Path) -> None:
    """Beyond the wall at d: k(x - l) + k(x - d - l) = 0, which is there for 2 l > d."""
    second = (", length: l}", ", length: l}, {constant: k, from: [0, 0], to: [x, 0], length: l}]")
    walls = edited(WALL, ("springs: {", "springs: [{"), second)
    steps = solved(tmp_path, walls)
    assert {value.expand() for value in rests(steps)} == {d / 2, d / 2 - l, d / 2 + l}
    assert "If 2l > d there is also" in rendered(course_with(tmp_path, walls), "trial/one", only={"text"}).texts["text"]


def test_a_support_that_is_shaken_keeps_the_side_that_it_has_at_rest(tmp_path: Path) -> None:
    shaken = edited(
        WALL,
        ("at: [x, 0]", "at: [l + x, 0]"),
        ("from: [d, 0], to: [x, 0]", "from: [A*cos(omega*t), 0], to: [l + x, 0]"),
        ("A: length}", "A: length, omega: angular speed}"),
        (", equilibria, stability", ""),
    )
    value = explicit(solved(tmp_path, shaken)["motion_x"].value).residual
    there = {"m": 2, "k": 3, "x": 0.5, "x_ddot": 0.7, "A": 1.1, "omega": 1, "t": 0, "l": 4}
    assert value.xreplace({s: Rational(str(there[s.name])) for s in value.free_symbols}).evalf() == pytest.approx(
        2 * 0.7 + 3 * (0.5 - 1.1)
    )


def test_an_equilibrium_that_needs_two_conditions_is_refused_with_both(tmp_path: Path) -> None:
    second = (", length: l}", ", length: l}, {constant: k, from: [0, 0], to: [x, 0], length: A}]")
    said = messages(tmp_path, edited(WALL, ("springs: {", "springs: [{"), second))
    assert any("has an equilibrium" in each and " only if " in each for each in said), said


def test_hamiltons_equations_have_the_force_of_a_spring_along_a_line(tmp_path: Path) -> None:
    steps = solved(tmp_path, edited(WALL, ("equations_of_motion, equilibria, stability", "hamilton_equations")))
    p_dot = steps["canonical_p_x"].value.right
    assert equal(p_dot, k * (d - x) * (Abs(d - x) - l) / Abs(d - x))


def test_a_force_beside_the_spring_leaves_both_equilibria_and_their_stability(tmp_path: Path) -> None:
    """k(x - d)(1 - l/|x - d|) = F: to the right x - d = l + F/k, to the left x - d = F/k - l, if F < k l."""
    pushed = edited(
        WALL,
        ("g: acceleration, A: length", "F: positive force, A: length"),
        ("length: l}\nst", "length: l}\n  forces: {components: [F, 0], at: cart}\nst"),
        ("[equations_of_motion, equilibria, stability]", "[equilibria, stability]"),
    )
    F = symbols("F", positive=True)
    steps = solved(tmp_path, pushed)
    assert {value.expand() for value in rests(steps)} == {d + l + F / k, d - l + F / k}
    assert [steps[f"stability_{n}"].value for n in (1, 2)] == [k, k]


def test_between_two_walls_the_place_that_an_assumption_settles_is_stable(tmp_path: Path) -> None:
    between = edited(
        WALL,
        ("A: length", "K: spring constant"),
        ("springs: {constant: k, from: [d, 0], to: [x, 0], length: l}", BOTH),
        ("[equations_of_motion, equilibria, stability]", "stability"),
    )
    K = symbols("K", positive=True)
    assert equal(solved(tmp_path, between)["stability"].value, K + k)
