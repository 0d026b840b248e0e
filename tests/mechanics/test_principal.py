"""Principal moments and axes: diagonal tensors and others, and where the moments are equal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from sympy import Integer, Matrix, eye, simplify, sqrt, symbols, zeros

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Cone,
    Cuboid,
    Cylinder,
    Disc,
    Plate,
    inertia_tensor,
    isotropic_where,
    principal_axes,
    principal_moments,
)
from derive.mechanics.bodies.body import Body
from derive.mechanics.rotation import principal
from derive.mechanics.rotation.principal import PrincipalOf
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from tests.mechanics.round_bodies import M, R, a, h

b, c = symbols("b c", positive=True)


def moments_of(body: Body, about: str = "centre") -> Any:
    return principal_moments(inertia_tensor(body, about))


@pytest.mark.parametrize(
    ("body", "about", "outcome"),
    [
        (Cone(R, h, M), "centre", "two_equal"),
        (Cone(R, 2 * R, M), "centre", "isotropic"),
        (Cuboid((a, b, c), M), "centre", "distinct"),
        (Plate((a, 2 * a), M), "corner", "roots"),
        (Cuboid((a, a, a), M), "corner", "two_equal_roots"),
    ],
)
def test_axes_are_put_back_and_make_a_right_handed_frame(body: Body, about: str, outcome: str) -> None:
    moments = moments_of(body, about)
    assert moments.step.outcome == outcome
    tensor, frame = (
        moments.needed(PrincipalOf).tensor.value,
        Matrix.hstack(*(Matrix(e.value) for e in principal_axes(moments))),
    )
    assert (frame.T * frame - eye(3)).applyfunc(simplify) == zeros(3)
    assert simplify(frame.det()) == 1
    assert equal(tensor * frame, frame * Matrix.diag(*moments.value))  # SymPy sees no relation of nested roots


def test_a_cube_about_its_corner_has_a_sixth_about_the_diagonal_and_eleven_twelfths_across() -> None:
    moments = moments_of(Cuboid((a, a, a), M), "corner")
    assert list(moments.value / (M * a**2)) == [Integer(1) / 6, Integer(11) / 12, Integer(11) / 12]
    first = principal_axes(moments)[0].value
    assert [abs(component) for component in first] == [1 / sqrt(3)] * 3


def test_roots_come_in_increasing_order() -> None:
    moments = moments_of(Plate((a, 2 * a), M), "corner").value.subs({a: 1, M: 1})
    assert sorted(moments, key=float) == list(moments)


@pytest.mark.parametrize(
    ("body", "polynomial"),
    [
        (
            Plate((a, b), M),
            lambda x: (M * (a**2 + b**2) / 3 - x) * ((M * b**2 / 3 - x) * (M * a**2 / 3 - x) - (M * a * b / 4) ** 2),
        ),
        (Cuboid((a, a, a), M), lambda x: (M * a**2 / 6 - x) * (11 * M * a**2 / 12 - x) ** 2),
        (
            Cuboid((a, a, 2 * a), M),
            lambda x: (23 * M * a**2 / 12 - x) * (x**2 - 25 * M * a**2 * x / 12 + 4 * M**2 * a**4 / 9),
        ),
    ],
)
def test_the_characteristic_equation_is_stated_with_its_factors(body: Body, polynomial: Callable[[Any], Any]) -> None:
    (told,) = [formula for role, formula in moments_of(body, "corner").step.roles if role == "equation"]
    (determinant, product), zero = told.left.sides, told.right
    (unknown,) = explicit(product).free_symbols - {M, a, b}
    assert zero == 0 and simplify(explicit(product) - polynomial(unknown)) == 0
    assert in_one_line(Notation().layout(determinant)) == "det(J⃡ - λ 1⃡)"


def test_a_wrong_characteristic_equation_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    right = principal._characteristic_equation

    def wrong(inertia: Any, roots: Any) -> Relation:
        return right(inertia, [2 * root for root in roots])

    monkeypatch.setattr(principal, "_characteristic_equation", wrong)
    with pytest.raises(Unverified, match="`equation`"):
        moments_of(Cuboid((a, a, a), M), "corner")


def test_a_principal_axis_along_a_coordinate_axis_is_written_without_roots() -> None:
    axes = principal_axes(moments_of(Plate((a, b), M), "corner"))
    assert list(axes[2].value) == [0, 0, 1]


def test_a_cubic_without_a_rational_factor_is_refused() -> None:
    with pytest.raises(Rejected, match="roots of a cubic without a rational factor"):
        moments_of(Cuboid((a, 2 * a, 3 * a), M), "corner")


@pytest.mark.parametrize(
    ("body", "letter", "case"),
    [
        (Cone(R, h, M), h, Relation(h, "=", 2 * R)),
        (Cone(R, h, M), R, Relation(R, "=", h / 2)),
        (Cylinder(R, h, M), h, Relation(h, "=", sqrt(3) * R)),
        (Cuboid((a, a, h), M), h, Relation(h, "=", a)),
    ],
)
def test_a_body_is_isotropic_where_its_moments_are_equal(body: Body, letter: Any, case: Relation) -> None:
    found = isotropic_where(moments_of(body), letter)
    assert found.value == case
    assert found.step.outcome == "special"


def test_moments_that_are_equal_as_they_are_say_so() -> None:
    assert isotropic_where(moments_of(Cone(R, 2 * R, M)), 2 * R).step.outcome == "always"


def test_a_flat_body_never_has_equal_moments() -> None:
    case = isotropic_where(moments_of(Disc(R, M)), R)
    assert case.step.outcome == "never"
    assert explicit(case.value).operator == "<"


def test_three_different_moments_are_refused() -> None:
    with pytest.raises(Rejected, match="all differ"):
        isotropic_where(moments_of(Cuboid((a, b, c), M)), c)


def test_a_letter_that_decides_nothing_is_refused() -> None:
    with pytest.raises(Rejected, match="no single positive root for M was found"):
        isotropic_where(moments_of(Cone(R, h, M)), M)
