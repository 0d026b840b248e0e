"""The inertia tensor of a block, against what the textbooks tabulate."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr, Matrix, Rational, diag, eye, symbols, zeros

from derive.errors import Rejected
from derive.mechanics import (
    Cuboid,
    Rod,
    centre_of_mass,
    inertia_tensor,
    moment_of_inertia,
    moved_from_centre,
    moved_to,
)
from derive.mechanics.rotation.claims import is_standard_moment
from derive.steps.rule import Judged
from derive.steps.subject import Subject
from tests.mechanics.block import M, a, b, c, known_block, outcomes, values

GENERAL = {"sides": (a, b, c), "axis": "z"}
CUBE = {"sides": (a, a, a)}
sizes = st.fractions(min_value=Rational(1, 50), max_value=50, max_denominator=50)


def test_block_about_its_centre_has_the_moments_of_the_tables() -> None:
    tabulated = M / 12 * diag(b**2 + c**2, a**2 + c**2, a**2 + b**2)
    assert (values(**GENERAL)["inertia_tensor"] - tabulated).expand() == zeros(3)


def test_mirror_planes_leave_three_integrals_about_the_centre_and_none_about_a_corner() -> None:
    block = Cuboid((a, b, c), M)
    central, corner = inertia_tensor(block), inertia_tensor(block, about="corner", key="corner_tensor")
    found = {q.key: q.step.outcome for q in central.parents if q.step.rule == "rotation.entry"}
    assert found == {f"inertia_tensor_{axis * 2}": "mirrored" for axis in "xyz"}
    assert (central.value - M / 12 * diag(b**2 + c**2, a**2 + c**2, a**2 + b**2)).expand() == zeros(3)
    assert len([q for q in corner.parents if q.step.rule == "rotation.entry"]) == 6


def test_a_tensor_of_three_integrals_is_moved_to_a_corner_with_all_its_products() -> None:
    block = Cuboid((a, b, c), M)
    moved = moved_from_centre(inertia_tensor(block), centre_of_mass(block, "corner"))
    assert (moved.value - inertia_tensor(block, "corner", key="corner_tensor").value).expand() == zeros(3)


def test_block_of_sides_one_two_three_has_moments_13_10_5() -> None:
    assert values()["inertia_tensor"] == M * a**2 / 12 * diag(13, 10, 5)


def test_block_about_its_corner_has_the_moments_and_products_of_the_tables() -> None:
    tabulated = M * Matrix(
        [
            [(b**2 + c**2) / 3, -a * b / 4, -a * c / 4],
            [-a * b / 4, (a**2 + c**2) / 3, -b * c / 4],
            [-a * c / 4, -b * c / 4, (a**2 + b**2) / 3],
        ]
    )
    assert (values(**GENERAL)["corner_tensor"] - tabulated).expand() == zeros(3)


def test_cube_has_the_moment_of_a_sixth_about_every_axis_through_its_centre() -> None:
    I = values(**CUBE)["inertia_tensor"]
    assert M * a**2 / 6 * eye(3) == I
    n = Matrix(symbols("n_x n_y n_z", real=True))
    assert ((n.T * I * n)[0] - M * a**2 / 6 * n.dot(n)).expand() == 0


def test_cube_about_its_corner_has_two_thirds_and_a_quarter() -> None:
    J = values(**CUBE)["corner_tensor"]
    assert J[0, 0] == Rational(2, 3) * M * a**2
    assert J[0, 1] == -M * a**2 / 4


def test_cube_about_its_corner_has_a_sixth_about_the_diagonal() -> None:
    n = Matrix([1, 1, 1])
    assert (n.T * values(**CUBE)["corner_tensor"] * n)[0] / 3 == M * a**2 / 6


def test_thin_rod_has_a_twelfth_about_its_centre_and_a_third_about_its_end() -> None:
    rod = {b: 0, c: 0}
    assert values(**GENERAL)["inertia_tensor"].subs(rod) == M * a**2 / 12 * diag(0, 1, 1)
    assert values(**GENERAL)["corner_tensor"].subs(rod) == M * a**2 / 3 * diag(0, 1, 1)


@pytest.mark.parametrize("key", ["inertia_tensor", "corner_tensor"])
def test_thin_plate_obeys_the_perpendicular_axis_theorem(key: str) -> None:
    plate = values(**GENERAL)[key].subs(c, 0)
    assert (plate[0, 0] + plate[1, 1] - plate[2, 2]).expand() == 0


def test_corner_and_centre_differ_by_the_mass_put_at_the_centre() -> None:
    found = values(**GENERAL)
    r = found["centre_of_mass"]
    difference = found["corner_tensor"] - found["inertia_tensor"]
    assert (difference - M * (r.dot(r) * eye(3) - r * r.T)).expand() == zeros(3)


def test_moving_and_integrating_at_once_agree() -> None:
    at_once = inertia_tensor(Cuboid((a, b, c), M), about="centre")
    assert (at_once.value - values(**GENERAL)["inertia_tensor"]).expand() == zeros(3)


def test_exchanging_two_sides_exchanges_two_moments() -> None:
    I, exchanged = (inertia_tensor(Cuboid(sides, M)).value for sides in ((a, b, c), (b, a, c)))
    assert exchanged == I.permute([1, 0, 2], orientation="rows").permute([1, 0, 2], orientation="cols")


def test_twice_the_block_has_thirty_two_times_the_tensor() -> None:
    """Twice the size at the same density: eight times the mass, four times the squared lengths."""
    J = values()["corner_tensor"]
    assert J.subs({a: 2 * a, M: 8 * M}, simultaneous=True) == 32 * J


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.tuples(sizes, sizes, sizes))
def test_each_moment_is_less_than_the_sum_of_the_others(sides: tuple[Any, Any, Any]) -> None:
    numbers = dict(zip((a, b, c), map(Rational, sides), strict=True))
    for key in ("inertia_tensor", "corner_tensor"):
        moments = values(**GENERAL)[key].subs({**numbers, M: 1}).diagonal()
        assert all(0 < moment < sum(moments) - moment for moment in moments)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.tuples(sizes, sizes, sizes))
def test_the_tensor_about_the_corner_is_positive_definite(sides: tuple[Any, Any, Any]) -> None:
    numbers = dict(zip((a, b, c), map(Rational, sides), strict=True))
    J = values(**GENERAL)["corner_tensor"].subs({**numbers, M: 1})
    assert all(J[:k, :k].det() > 0 for k in (1, 2, 3))


def test_the_tensor_is_symmetric() -> None:
    J = values(**GENERAL)["corner_tensor"]
    assert J == J.T


def test_outcomes_say_which_axes_are_principal() -> None:
    assert outcomes()["corner_tensor"] == "generic"
    assert outcomes()["inertia_tensor"] == "diagonal"
    assert outcomes(**CUBE)["inertia_tensor"] == "isotropic"
    assert outcomes(sides=(a, 2 * a, a))["inertia_tensor"] == "two_equal"


def test_all_six_entries_are_steps_of_their_own() -> None:
    parents = {parent.key for parent in known_block()["corner_tensor"].parents}
    assert {f"corner_tensor_{pair}" for pair in ("xx", "yy", "zz", "xy", "xz", "yz")} <= parents


def test_an_entry_is_worked_with_split_integrals_brackets_and_the_mass_collected() -> None:
    reasons = [form.because for form in known_block()["corner_tensor_xx"].step.chain]
    assert reasons == ["law", "separate", "antiderivative", "limits", "multiplied", "added", "mass_collected", "result"]


def test_a_tensor_that_is_already_about_the_centre_is_not_moved() -> None:
    block = Cuboid((a, b, c), M)
    with pytest.raises(Rejected, match="`inertia_tensor` is already about the centre of mass"):
        moved_to(inertia_tensor(block), block.centre)


def test_an_unknown_point_is_refused() -> None:
    with pytest.raises(Rejected, match='a cuboid has no point "top"'):
        inertia_tensor(Cuboid((a, b, c), M), about="top")


def test_a_moment_about_an_axis_that_does_not_exist_is_rejected() -> None:
    with pytest.raises(Rejected, match='must be "x", "y" or "z", not "w"') as refused:
        moment_of_inertia(Cuboid((a, b, c), M), "w")
    assert [each.code for each in refused.value.complaints] == ["no-such-axis"]


@pytest.mark.parametrize(
    ("words", "point", "axis", "moment", "quoted"),
    [
        ("rod_about_its_centre", "centre", "x", M * a**2 / 12, True),
        ("rod_about_its_end", "end", "y", M * a**2 / 3, True),
        ("rod_about_its_centre", "end", "x", M * a**2 / 12, False),
        ("rod_about_its_centre", "centre", "z", M * a**2 / 12, False),
    ],
)
def test_a_moment_of_a_table_is_quoted_only_for_its_point_and_its_axis(
    words: str, point: str, axis: str, moment: Expr, quoted: bool
) -> None:
    rod = Rod(mass=M, length=a)
    subject = Subject(body=rod, mass=M, point=rod.point(point), axis=axis)
    assert is_standard_moment(Judged(moment, subject=subject, words={"standard": words})) is quoted
