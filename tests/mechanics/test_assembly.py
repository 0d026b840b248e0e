"""Bodies made of parts, and tensors along other axes, against values worked by hand."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, Matrix, Rational, cos, diag, eye, pi, sin, sqrt, symbols, zeros

import derive.mechanics.rotation.assembly as assembly
from derive.algebra.equality import Grade
from derive.algebra.expressions import Dot, scaled
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Ball,
    Composite,
    Cuboid,
    Cylinder,
    Direction,
    Disc,
    HalfDisc,
    Hoop,
    Plate,
    PointMasses,
    Rod,
    Sheet,
    SphericalShell,
    angular_momentum,
    any_angular_velocity,
    centre_of_mass,
    inertia_tensor,
    kinetic_energy,
    minus,
    moment_about,
    moment_of_inertia,
    moved_to,
    perpendicular_axes,
    principal_angle,
    principal_axes,
    principal_moments,
    radius_of_gyration,
    tensor_entry,
    turned_tensor,
    variables,
)
from derive.mechanics.bodies.parts import turn_about, turns_right_handed
from derive.mechanics.rotation.tensors import central_tensor
from derive.steps.step import Quantity

x, y = variables("x", "y")
R, r, M, m, l, a, b, c, d, alpha = symbols("R r M m l a b c d alpha", positive=True)


def grades(found: Quantity) -> set[Grade]:
    return {e.grade for quantity in found.ancestors() for e in quantity.step.evidence}


# --- parts ---


def test_a_pendulum_of_rod_and_ball_swings_about_its_pivot() -> None:
    """Kleppner, Kolenkow, section 7.4: m l^2/3 + (2/5) M R^2 + M (l + R)^2."""
    body = Composite(Rod(l, m).at(0, 0, -l / 2), Ball(R, M).at(0, 0, -l - R), points={"pivot": (0, 0, 0)})
    tensor = inertia_tensor(body, "pivot")
    swing = m * l**2 / 3 + Rational(2, 5) * M * R**2 + M * (l + R) ** 2
    assert (tensor.value - diag(swing, swing, Rational(2, 5) * M * R**2)).expand() == zeros(3)
    assert grades(tensor) == {Grade.PROVED, Grade.DEFINITION}
    assert tensor.step.outcome == "two_equal"


def test_a_ball_with_a_round_hole_balances_away_from_it() -> None:
    """Goldstein, chapter 5: a hole of half the radius, touching the edge, moves the centre by R/14."""
    body = Composite(Ball(R, M), minus(Ball(R / 2, M).named("hole").at(R / 2, 0, 0)), mass=M)
    assert centre_of_mass(body).value == Matrix([-R / 14, 0, 0])
    assert centre_of_mass(body).step.outcome == "cut_out"
    assert inertia_tensor(body, "origin").value == diag(Rational(31, 70), Rational(57, 140), Rational(57, 140)) * (
        M * R**2
    )


def test_an_angle_of_two_plates_has_products_of_inertia() -> None:
    """Plates of 2 and 1 squares of side a: from the corner the centre is at (5/6, 5/6) a."""
    body = Composite(
        Plate((a, 2 * a), M).named("long plate"), Plate((a, a), M).named("short plate").at(a, 0, of="corner"), mass=M
    )
    tensor = inertia_tensor(body)
    assert centre_of_mass(body).value == Matrix([5, 5, 0]) * a / 6
    assert tensor.value == M * a**2 / 36 * Matrix([[11, 4, 0], [4, 11, 0], [0, 0, 22]])
    moments = principal_moments(tensor)
    assert set(moments.value) == {7 * M * a**2 / 36, 15 * M * a**2 / 36, 22 * M * a**2 / 36}
    assert len(principal_axes(moments)) == 3


def test_a_rod_that_is_turned_about_its_end_has_its_tensor_turned() -> None:
    """About its end, at alpha from z in the plane of y and z: m l^2/3 (1 - e e)."""
    body = Composite(Rod(l, m).at(0, 0, 0, of="end").turned("x", alpha))
    e = Matrix([0, -sin(alpha), cos(alpha)])
    expected = m * l**2 / 3 * (eye(3) - e * e.T)
    found = inertia_tensor(body, "origin").value
    assert (found - expected).applyfunc(lambda x: x.simplify()) == zeros(3)


def test_particles_alone_are_a_body() -> None:
    """Taylor, example 10.2 in kind: the sum of m (r.r 1 - r r)."""
    body = PointMasses((m, (a, 0, 0)), (2 * m, (0, a, a)), (3 * m, (0, a, -a)))
    tensor = inertia_tensor(body, "origin")
    assert tensor.value == m * a**2 * Matrix([[10, 0, 0], [0, 6, 1], [0, 1, 6]])
    assert sorted(principal_moments(tensor).value, key=str) == [10 * a**2 * m, 5 * a**2 * m, 7 * a**2 * m]
    assert centre_of_mass(body).value == Matrix([1, 5, -1]) * a / 6


def test_what_is_taken_out_of_a_body_leaves_the_hollow_one() -> None:
    tube = Composite(Cylinder(b, l, M).at(0, 0, 0), minus(Cylinder(a, l, M).named("bore").at(0, 0, 0)), mass=M)
    assert (inertia_tensor(tube).value[2, 2] - M * (a**2 + b**2) / 2).simplify() == 0


def test_a_moment_added_up_is_that_of_the_tensor() -> None:
    body = Composite(Disc(a, m).at(0, 0, l), Rod(l, m).at(0, 0, l / 2))
    whole = inertia_tensor(body, "origin").value
    moments = [moment_of_inertia(body, axis, "origin", key=f"about_{axis}").value for axis in "xyz"]
    assert all((whole[k, k] - moment).expand() == 0 for k, moment in enumerate(moments))


def test_energy_and_angular_momentum_of_a_composite_are_those_of_its_parts() -> None:
    body = Composite(Rod(l, m).at(0, 0, 0), Hoop(R, M).at(0, 0, l / 2))
    I = inertia_tensor(body)
    omega = any_angular_velocity()
    assert grades(kinetic_energy(I, omega)) == grades(angular_momentum(I, omega)) == {Grade.PROVED, Grade.DEFINITION}


def test_a_composite_may_be_a_part_and_two_may_stand_on_one_page() -> None:
    dumbbell = Composite(
        Rod(l, m).at(0, 0, 0), Ball(R, M).named("upper ball").at(0, 0, l), Ball(R, M).named("lower ball").at(0, 0, -l)
    )
    first, second = dumbbell.named("first dumbbell"), dumbbell.named("second dumbbell")
    assert {inertia_tensor(first).key, centre_of_mass(second).key} == {
        "first_dumbbell_inertia_tensor",
        "second_dumbbell_centre_of_mass",
    }
    whole = Composite(first.at(0, 0, 0), SphericalShell(R, M).at(3 * l, 0, 0))
    assert (whole.mass - m - 3 * M).expand() == 0
    moment = inertia_tensor(whole, "origin").value[0, 0]
    assert (moment - inertia_tensor(dumbbell).value[0, 0] - Rational(2, 3) * M * R**2).expand() == 0


def test_a_moment_of_a_composite_is_that_of_its_tensor() -> None:
    body = Composite(Rod(l, m).at(0, 0, -l / 2), Disc(R, M).turned("x", pi / 2).at(0, 0, -l))
    swing = moment_of_inertia(body, "y", about="origin").value
    assert (swing - m * l**2 / 3 - M * R**2 / 2 - M * l**2).expand() == 0


def test_a_wrong_theorem_of_parallel_axes_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    body = Composite(Rod(l, m).at(0, 0, -l), Ball(R, M).at(0, 0, l))
    monkeypatch.setattr(assembly, "_steiner", lambda mass, way: scaled(mass * Dot(way, way), eye(3)))
    with pytest.raises(Unverified, match="particles"):
        inertia_tensor(body, "origin")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Composite(), "needs parts"),
        (lambda: Composite(Rod(l, m), Rod(l, m)), "both called `rod`"),
        (lambda: Composite(m), "needs bodies, not a"),
        (lambda: Composite(Rod(l, m).at(0)), "not iterable|two components or three"),
        (lambda: Composite(Rod(l, m).at(1, 2, 3, 4)), "two components or three"),
        (lambda: Composite(Rod(l, m).turned("w", alpha)), 'about "x", "y" or "z"'),
        (lambda: Composite(Rod(l, m).at(0, 0, 0, of="rim")), 'has no point "rim"'),
        (lambda: Composite(Rod(l, m), Disc(R, M), mass=M), "cannot be divided"),
        (lambda: Composite(Disc(R, M), minus(Disc(R, M).named("hole"))), "nothing is left of the body"),
        (lambda: inertia_tensor(Composite(Rod(l, m)), "pivot"), 'has no point "pivot"'),
    ],
)
def test_parts_that_make_no_body_are_refused(make: Any, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        make()


def test_the_tensor_of_a_composite_is_not_moved_entry_by_entry() -> None:
    body = Composite(Rod(l, m).at(0, 0, l), Ball(R, M).at(0, 0, -l))
    with pytest.raises(Rejected, match="no step derives the entry xx of"):
        moved_to(inertia_tensor(body, "origin"), body.centre)


# --- tensors ---


def test_a_tensor_along_turned_axes_is_that_of_the_turned_particles() -> None:
    """A square about its corner has principal axes along its diagonals: M a^2/12 diag(1, 7, 8)."""
    J = inertia_tensor(Plate((a, a), M), "corner")
    turned = turned_tensor(J, "z", pi / 4)
    assert turned.value == M * a**2 / 12 * diag(1, 7, 8)
    assert turned.step.outcome == "diagonal"
    assert turned_tensor(inertia_tensor(Ball(R, M)), "x", alpha).step.outcome == "isotropic"


def test_the_moment_about_a_diagonal() -> None:
    """Of a cube the same as about an edge, M a^2/6; of a plate M a^2 b^2/(6 (a^2 + b^2))."""
    cube = Cuboid((a, a, a), M)
    assert moment_about(inertia_tensor(cube), cube.direction(Direction("diagonal"))).value == M * a**2 / 6
    J = inertia_tensor(Plate((a, b), M), "corner")
    assert (moment_about(J, (a, b, 0)).value - M * a**2 * b**2 / (6 * (a**2 + b**2))).simplify() == 0
    assert tensor_entry(J, "yx").value == -M * a * b / 4
    assert tensor_entry(J, "zz").step.outcome == "moment"


def test_the_principal_angle_of_a_plate_about_its_corner() -> None:
    """Fowles, section 9.2: tan 2 theta = 2 I_xy/(I_xx - I_yy), here 3ab/(2 (a^2 - b^2))."""
    found = principal_angle(inertia_tensor(Plate((a, b), M), "corner"))
    assert (found.value - 3 * a * b / (2 * (a**2 - b**2))).simplify() == 0
    assert principal_angle(inertia_tensor(Plate((a, b), M))).step.outcome == "zero"


def test_flat_bodies_have_perpendicular_axes_and_radii_of_gyration() -> None:
    half = HalfDisc(R, M)
    pair = [moment_of_inertia(half, n, "circle_centre", symbol=f"I_{n}", key=f"about_{n}") for n in "xy"]
    assert perpendicular_axes(*pair).value == M * R**2 / 2
    assert radius_of_gyration(pair[0]).value == R / 2
    assert radius_of_gyration(moment_of_inertia(Ball(R, M))).value == R * sqrt(Rational(2, 5))


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: principal_angle(inertia_tensor(Plate((a, a), M), "corner")), "are at 45 degrees to x and y"),
        (lambda: principal_angle(inertia_tensor(Cuboid((a, b, c), M), "corner")), "not a principal axis"),
        (lambda: moment_about(inertia_tensor(Ball(R, M)), (0, 0, 0)), "so the axis has no direction"),
        (lambda: tensor_entry(inertia_tensor(Ball(R, M)), "xw"), 'no entry "xw"'),
        (lambda: turned_tensor(inertia_tensor(Ball(R, M)), "w", alpha), 'about "x", "y" or "z"'),
        (
            lambda: perpendicular_axes(
                *(moment_of_inertia(Ball(R, M), n, symbol=f"I_{n}", key=f"about_{n}") for n in "xy")
            ),
            "needs a flat body",
        ),
        (lambda: radius_of_gyration(tensor_entry(inertia_tensor(Plate((a, b), M), "corner"), "xy")), "one of its axes"),
    ],
)
def test_a_question_that_a_tensor_cannot_answer_is_refused(ask: Any, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        ask()


@pytest.mark.parametrize(
    "body",
    [
        Ball(R, M),
        HalfDisc(R, M),
        Composite(Rod(l, m).at(0, 0, 0), Ball(R, M).at(0, 0, l)),
        Sheet((x, y), {x: (0, a), y: (0, b * x / a)}, mass=M),
    ],
)
def test_every_body_has_a_central_tensor_as_a_value(body: Any) -> None:
    found = inertia_tensor(body, "centre", symbol="I")
    assert (central_tensor(body) - found.value).applyfunc(lambda e: e.simplify()) == zeros(3)


@pytest.mark.parametrize("axis", "xyz")
def test_a_turn_is_right_handed(axis: str) -> None:
    turn = turn_about(axis, pi / 2)
    k = "xyz".index(axis)
    assert turn[(k + 2) % 3, (k + 1) % 3] == 1
    assert not turns_right_handed(turn.T, axis, pi / 2)


def test_a_composite_without_a_turn_or_a_way_shows_only_its_parts() -> None:
    tensor = inertia_tensor(Composite(Ball(R, M).at(0, 0, 0), Rod(l, m).at(0, 0, 0)))
    assert not [q for q in tensor.ancestors() if q.step.rule == "rotation.tensor_of_part"]
    assert tensor.value[2, 2] == Rational(2, 5) * M * R**2
    assert Integer(0) == tensor.value[0, 1]


def test_many_rods_at_places_in_letters_are_possible() -> None:
    """Two of many places coincide by accident in each draw of the letters, but not the same two in every draw."""
    places = symbols("l_1:61", positive=True)
    length, mass = symbols("a m", positive=True)
    names = [f"rod{first}{second}" for first in "abcdef" for second in "klmnopqrst"]
    parts = [Rod(length, mass).named(name).at(x, 0, 0) for name, x in zip(names, places, strict=True)]
    assert len(Composite(*parts).parts) == 60
