"""Rotations that are described in YAML alone: what parts ask of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Abs, ImmutableDenseMatrix, Rational, cos, sin, sqrt, symbols, tan

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from tests.stock.bodies import BLOCK, BLOCK_IS
from tests.stock.described import course_with, edited, messages, solved

a, M, A, B, C, omega = symbols("a M A B C omega", positive=True)
x, y, z = symbols("omega_x omega_y omega_z", real=True)
TURNS = (BLOCK_IS, "moments: [A, B, C]"), ("  along: diagonal\n", "")


def asked(answer: str) -> tuple[str, str]:
    return "answer: torque", f"answer: {answer}"


def test_a_block_about_its_diagonal(tmp_path: Path) -> None:
    """By hand: I = M a^2/12 diag(13, 10, 5), omega = omega/sqrt 14 (1, 2, 3)."""
    found = solved(tmp_path, edited(BLOCK, asked("[angular_momentum, kinetic_energy, torque, torque_size]")))
    front = M * a**2 * omega / (12 * sqrt(14))
    assert equal(found["angular_momentum"].value, front * ImmutableDenseMatrix([13, 20, 15]))
    assert equal(found["kinetic_energy"].value, Rational(7, 24) * M * a**2 * omega**2)
    assert equal(found["torque"].value, M * a**2 * omega**2 / 28 * ImmutableDenseMatrix([-5, 4, -1]))
    assert equal(found["torque_size"].value, sqrt(42) / 28 * M * a**2 * omega**2)


def test_moments_and_components_that_are_given(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [A, B, C]"), ("rate: omega\n  along: diagonal", "rates: [omega, omega, 0]")
    found = solved(tmp_path, edited(BLOCK, *edits))
    assert equal(found["torque"].value, ImmutableDenseMatrix([0, 0, (B - A) * omega**2]))


def test_prose_may_say_what_is_given_by_its_key(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [A, A, C]"), ("rate: omega", "rate: 2*omega"), ("along: diagonal", "along: x")
    statement = ("statement: A block.", "statement: A body with the moments <<moments>> turns at <<rate>>.")
    course = course_with(tmp_path, edited(BLOCK, *edits, statement, asked("kinetic_energy")))
    page = rendered(course, "trial/one", only={"text"}).texts["text"]
    assert "A body with the moments A, A and C turns at 2ω." in page


def test_moments_given_as_numbers_have_the_letters_of_three_moments(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [2 kg m^2, 3 kg m^2, 4 kg m^2]"), ("along: diagonal", "along: x")
    letters = "A: moment of inertia, B: moment of inertia, C: moment of inertia, ", ""
    found = solved(tmp_path, edited(BLOCK, *edits, letters, asked("inertia_tensor")))
    assert found["inertia_tensor"].value == ImmutableDenseMatrix.diag(A, B, C)


def test_moments_and_an_axis(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [A, B, C]"), ("along: diagonal", "along: [1, 0, 1]")
    found = solved(tmp_path, edited(BLOCK, *edits, asked("kinetic_energy")))
    assert equal(found["kinetic_energy"].value, (A + C) * omega**2 / 4)


def test_euler_equations_and_what_they_keep(tmp_path: Path) -> None:
    names = "[euler_equations, energy_rate, squared_momentum_rate, momentum_rate_in_body, momentum_rate_in_space]"
    found = solved(tmp_path, edited(BLOCK, *TURNS, asked(names)))
    x_dot = symbols("omega_x_dot", real=True)
    assert equal(found["euler_x"].value, Relation(A * x_dot - (B - C) * y * z, "=", 0))
    assert found["kinetic_energy_rate"].value == 0
    assert found["squared_momentum_rate"].value == 0


def test_euler_equations_with_a_torque(tmp_path: Path) -> None:
    text = edited(BLOCK, *TURNS, ("  rate: omega\n", "  torque: [0, 0, A*omega**2]\n"), asked("euler_equations"))
    assert equal(explicit(solved(tmp_path, text)["euler_z"].value).right, A * omega**2)


def test_the_three_axes_of_a_block(tmp_path: Path) -> None:
    """Of edges a, 2a, 3a the moments are as 13, 10 and 5: 8 3/50, -3 5/65, 8 5/130."""
    edits = ("  along: diagonal\n", ""), asked("[stability_x, wobble_y, wobble_period_z]")
    found = solved(tmp_path, edited(BLOCK, *edits))
    assert equal(found["stability_x"].value, Rational(12, 25) * omega**2)
    assert equal(found["wobble_y"].value, sqrt(Rational(3, 13)) * omega)
    assert equal(found["wobble_z"].value, sqrt(Rational(4, 13)) * omega)
    assert "wobble_period_z" in found


def test_the_wobble_of_the_earth(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [A, A, C]"), ("  along: diagonal\n", ""), asked("body_cone_rate")
    assert equal(solved(tmp_path, edited(BLOCK, *edits))["body_cone_rate"].value, (C - A) / A * z)


COIN = """\
title: A coin
solve: rotation
symbols: {A: moment of inertia, C: moment of inertia, omega: angular speed, alpha: 'angle in (0, pi/2)'}
given:
  moments: [A, A, C]
  start: [omega*sin(alpha), 0, omega*cos(alpha)]
  results:
    ratio: {value: precession_rate/spin_z}
    now: {put_in: body_cone_rate, values: {omega_z: omega*cos(alpha)}}
statement: A coin.
parts:
  - ask: Find what is asked.
    answer: [body_cone, tilt_tangent, space_cone_tangent, ratio, now]
"""


def test_the_cones_of_a_free_symmetric_body(tmp_path: Path) -> None:
    """Goldstein, section 5.6: omega at alpha from e, L at tan = (A/C) tan(alpha), Omega_b = (C - A) omega_z/A."""
    found = solved(tmp_path, COIN)
    alpha = found["body_cone"].value
    assert alpha.name == "alpha"
    assert equal(found["tilt_tangent"].value, A / C * tan(alpha))
    apart = Abs((A - C) * sin(alpha) * cos(alpha)) / (A * sin(alpha) ** 2 + C * cos(alpha) ** 2)
    assert equal(found["space_cone_tangent"].value, apart)
    assert equal(found["ratio"].value, sqrt(A**2 * sin(alpha) ** 2 + C**2 * cos(alpha) ** 2) / (A * cos(alpha)))
    assert equal(found["now"].value, (C - A) / A * omega * cos(alpha))


def test_free_precession_is_that_of_a_free_body(tmp_path: Path) -> None:
    edits = (BLOCK_IS, "moments: [A, A, C]"), asked("precession_rate")
    assert messages(tmp_path, edited(BLOCK, *edits, ("  along: diagonal", "  along: [1, 0, 1]"))) == [
        "5: free precession needs the angular velocity at one instant, with no torque on the body"
    ]
    text = edited(COIN, ("  results:\n", "  torque: [0, 0, A*omega**2]\n  results:\n"))
    assert messages(tmp_path, text) == ["6: `torque` and `start` cannot be combined"]


def test_components_of_vectors(tmp_path: Path) -> None:
    """By hand, as above: L_y = (20/12) M a^2 omega/sqrt 14, tau_y = M a^2 omega^2/7."""
    found = solved(tmp_path, edited(BLOCK, asked("[angular_momentum_y, torque_y]")))
    assert equal(found["angular_momentum_y"].value, Rational(5, 3) * M * a**2 * omega / sqrt(14))
    assert equal(found["torque_y"].value, M * a**2 * omega**2 / 7)


def test_the_body_is_drawn_with_its_axis(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, edited(BLOCK, asked("angle_between"))), "trial/one", only={"text"}).texts[
        "text"
    ]
    assert " ".join(text.split()).count("an axis of rotation along (1, 2, 3)") == 2


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("along: diagonal", "along: diagnal"), "7: `along` must be a direction, but `diagnal` is not one"),
        (
            ("along: diagonal", "along: [1, a, 0]"),
            "7: the components of `along` have different dimensions: one is a length, another a number",
        ),
        (("along: diagonal", "along: [1, 0]"), "7: `along` must be a direction or three components"),
        (("along: diagonal", "rates: [omega, 0, 0]"), "7: `rate` and `rates` cannot be combined"),
        (("rate: omega", "rate: a"), "6: `rate` must be an angular speed, but `a` is a length"),
        (("  rate: omega\n", ""), "6: a rotation about an axis needs its `rate`"),
        ((BLOCK_IS, f"{BLOCK_IS}\n  moments: [A, B, C]"), "5: `moments` and `body` cannot be combined"),
        ((BLOCK_IS, "moments: [A, B]"), "5: `moments` must be three moments of inertia, `[A, B, C]`, but it is a list"),
        (
            (BLOCK_IS, "moments: [A, A, 3*A]"),
            "5: no body has such moments: the one about z is greater than the sum of the other two",
        ),
        ((BLOCK_IS, "moments: [A, B, C]"), "5: a body specified by its moments has no diagonal"),
        ((f"  {BLOCK_IS}\n", ""), "5: `given` needs `body` or `moments`"),
        (("along: diagonal", "about: edge"), "7: a cuboid has no point `edge`"),
        (("answer: torque", "answer: euler_equations"), "11: Euler's equations describe an unknown rotation"),
        (("answer: torque", "answer: tork"), "11: a rotation has no answer called `tork`"),
        (("  along: diagonal\n", ""), "5: the rotation of this body is not specified"),
    ],
)
def test_a_fault_is_told_at_its_place(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(BLOCK, edit))
    assert any(message.startswith(said) for message in found), found


def test_euler_equations_are_along_principal_axes(tmp_path: Path) -> None:
    edits = ("along: diagonal", "about: corner"), asked("euler_equations")
    (found,) = messages(tmp_path, edited(BLOCK, *edits))
    assert found.startswith("11: Euler's equations need principal axes")
