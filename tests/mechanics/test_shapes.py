"""Shapes of the tables.

Taylor, *Classical Mechanics*, chapter 10; Morin, *Introduction to Classical Mechanics*, chapter 8; Fowles, Cassiday,
*Analytical Mechanics*, chapters 8 and 9; Goldstein, *Classical Mechanics*, chapter 5.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest
from sympy import Integer, Matrix, Rational, cos, diag, pi, sin, sqrt, symbols, zeros

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import Terms
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Annulus,
    Arc,
    ConicalShell,
    CylindricalShell,
    Ellipsoid,
    HalfCylinder,
    HalfDisc,
    Hemisphere,
    HemisphericalShell,
    SphericalShell,
    Tetrahedron,
    ThickShell,
    Torus,
    Triangle,
    Tube,
    Wedge,
    centre_of_mass,
    inertia_tensor,
    moment_of_inertia,
    moved_to,
)
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.equimomental import Particles, from_moments, summed, tensor_at

R, h, M, a, b, c, alpha = symbols("R h M a b c alpha", positive=True)
ZERO = Integer(0)
ACROSS = 3 * (a**2 + b**2) + h**2
OUT = (4 * R / (3 * pi)) ** 2

TENSORS: list[tuple[Body, str, Any]] = [
    (Annulus(a, b, M), "centre", M * (a**2 + b**2) / 4 * diag(1, 1, 2)),
    (Triangle.on_base(b, h, M), "centre", M * diag(h**2 / 18, b**2 / 24, h**2 / 18 + b**2 / 24)),
    (Triangle.equilateral(a, M), "centre", M * a**2 / 24 * diag(1, 1, 2)),
    (HalfDisc(R, M), "circle_centre", M * R**2 / 4 * diag(1, 1, 2)),
    (Arc(R, pi / 2, M), "circle_centre", M * R**2 / 2 * diag(1, 1, 2)),
    (
        Arc(R, alpha, M),
        "circle_centre",
        M * R**2 / 2 * diag(1 - sin(alpha) * cos(alpha) / alpha, 1 + sin(alpha) * cos(alpha) / alpha, 2),
    ),
    (Tube(a, b, h, M), "centre", M / 12 * diag(ACROSS, ACROSS, 6 * (a**2 + b**2))),
    (ThickShell(a, b, M), "centre", Rational(2, 5) * M * (b**5 - a**5) / (b**3 - a**3) * diag(1, 1, 1)),
    (SphericalShell(R, M), "centre", Rational(2, 3) * M * R**2 * diag(1, 1, 1)),
    (HemisphericalShell(R, M), "centre", M * R**2 / 12 * diag(5, 5, 8)),
    (CylindricalShell(R, h, M), "centre", M * diag(R**2 / 2 + h**2 / 12, R**2 / 2 + h**2 / 12, R**2)),
    (ConicalShell(R, h, M), "tip", M / 4 * diag(R**2 + 2 * h**2, R**2 + 2 * h**2, 2 * R**2)),
    (Hemisphere(R, M), "base", Rational(2, 5) * M * R**2 * diag(1, 1, 1)),
    (Hemisphere(R, M), "centre", M * R**2 * diag(Rational(83, 320), Rational(83, 320), Rational(2, 5))),
    (
        HalfCylinder(R, h, M),
        "centre",
        M * diag(R**2 / 4 + h**2 / 12 - OUT, R**2 / 4 + h**2 / 12, R**2 / 2 - OUT),
    ),
    (Ellipsoid((a, b, c), M), "centre", M / 5 * diag(b**2 + c**2, a**2 + c**2, a**2 + b**2)),
    (Torus(R, a, M), "centre", M / 8 * diag(4 * R**2 + 5 * a**2, 4 * R**2 + 5 * a**2, 8 * R**2 + 6 * a**2)),
    (Tetrahedron(((0, 0, 0), (a, a, 0), (0, a, a), (a, 0, a)), M), "centre", M * a**2 / 10 * diag(1, 1, 1)),
]
CENTRES: list[tuple[Body, tuple[Any, Any, Any]]] = [
    (Triangle.on_base(b, h, M, foot=a), ((a + b) / 3, h / 3, ZERO)),
    (HalfDisc(R, M), (ZERO, 4 * R / (3 * pi), ZERO)),
    (Arc(R, alpha, M), (R * sin(alpha) / alpha, ZERO, ZERO)),
    (Arc(R, pi / 2, M), (2 * R / pi, ZERO, ZERO)),
    (Hemisphere(R, M), (ZERO, ZERO, 3 * R / 8)),
    (HemisphericalShell(R, M), (ZERO, ZERO, R / 2)),
    (ConicalShell(R, h, M), (ZERO, ZERO, 2 * h / 3)),
    (Tetrahedron(((0, 0, 0), (a, 0, 0), (0, b, 0), (0, 0, c)), M), (a / 4, b / 4, c / 4)),
    (Wedge(Triangle.on_base(a, b, M, foot=ZERO), c, M), (a / 3, b / 3, c / 2)),
]


def named(value: Any) -> str:
    return value.name.partition(" ")[2] if isinstance(value, Body) else str(value)[:20]


@pytest.mark.parametrize(("body", "about", "tabulated"), TENSORS, ids=named)
def test_a_shape_has_the_tensor_of_the_tables_and_it_is_proved(body: Body, about: str, tabulated: Any) -> None:
    tensor = inertia_tensor(body, about)
    assert equal(tensor.value, tabulated).grade is Grade.PROVED
    assert {e.grade for e in tensor.step.evidence} <= {Grade.PROVED}


@pytest.mark.parametrize(("body", "place"), CENTRES, ids=named)
def test_a_shape_has_its_centre_of_mass_where_the_tables_say(body: Body, place: Any) -> None:
    assert (centre_of_mass(body).value - Matrix(place)).expand() == zeros(3, 1)


def test_a_moment_of_a_hollow_ball_is_written_as_in_a_lecture() -> None:
    I = inertia_tensor(ThickShell(a, b, M)).value
    assert str(I[0, 0]) == "2*M*(-a**5 + b**5)/(5*(-a**3 + b**3))"


def test_what_stands_in_no_table_agrees_with_what_does() -> None:
    assert inertia_tensor(Tube(a, b, h, M)).value.subs(a, 0) == M / 12 * diag(
        3 * b**2 + h**2, 3 * b**2 + h**2, 6 * b**2
    )
    assert inertia_tensor(ThickShell(a, b, M)).value.subs(a, 0) == Rational(2, 5) * M * b**2 * diag(1, 1, 1)
    halves = [Triangle(((ZERO, ZERO), (a, ZERO), end), M / 2) for end in ((a, a),)]
    half = inertia_tensor(halves[0], "first corner").value
    assert half[0, 0] + half[1, 1] == half[2, 2] == M / 3 * a**2


def test_a_tensor_is_moved_from_any_named_point() -> None:
    body = HalfDisc(R, M)
    moved = moved_to(inertia_tensor(body, "circle_centre"), body.centre)
    assert (moved.value[0, 0] - M * R**2 * (Rational(1, 4) - 16 / (9 * pi**2))).expand() == 0
    assert moved.step.outcome == "diagonal"


def test_particles_can_be_made_of_any_second_moments() -> None:
    second = Matrix([[2 * a**2, a * b, 0], [a * b, 3 * b**2, 0], [0, 0, 0]]) * M
    found = from_moments(M, Matrix([a, 0, 0]), second)
    assert sum((m for m, _ in found), ZERO).simplify() == M
    shifted = [(m, r - Matrix([a, 0, 0])) for m, r in found]
    trace = second.trace()
    assert (summed(shifted, tensor_at) - (trace * Matrix.eye(3) - second)).applyfunc(lambda x: x.simplify()) == zeros(3)


# --- refusals ---


@dataclass(frozen=True)
class WrongRing(Annulus):
    """An annulus whose particles are those of a disc without a hole."""

    def particles(self) -> Particles:
        return HalfDisc(self.outer, self.mass).particles()


def test_wrong_particles_are_refused() -> None:
    with pytest.raises(Unverified):
        inertia_tensor(WrongRing(a, b, M))


@dataclass(frozen=True)
class WrongShell(SphericalShell):
    """A shell that claims the area of a disc."""

    @property
    def extent(self) -> Any:
        return pi * self.radius**2


def test_a_wrong_size_is_refused() -> None:
    with pytest.raises(Unverified, match="mass_given_back"):
        inertia_tensor(WrongShell(R, M))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Annulus(2 * a, a, M), "an outer radius that is greater"),
        (lambda: ThickShell(a, a, M), "an outer radius that is greater"),
        (lambda: Torus(a, 2 * a, M), "not greater than the radius of the ring"),
        (lambda: Arc(R, 2 * pi, M), "between zero and pi"),
        (lambda: Triangle(((ZERO, ZERO), (a, a), (2 * a, 2 * a)), M), "on one line"),
        (lambda: Tetrahedron(((0, 0, 0), (a, 0, 0), (0, b, 0), (a, b, 0)), M), "not in one plane"),
        (lambda: inertia_tensor(Triangle(((ZERO, ZERO), (a, b), (c, 2 * b)), M)), "do not determine whether"),
        (lambda: inertia_tensor(HalfDisc(R, M), "rim"), 'has no point "rim"'),
    ],
)
def test_a_shape_that_cannot_be_is_refused(make: Any, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        make()


def test_an_equilateral_triangle_has_its_height() -> None:
    assert Triangle.equilateral(a, M).corners[2] == Matrix([a / 2, sqrt(3) * a / 2, 0])


def test_integrals_that_vanish_are_left_out_of_the_sum() -> None:
    """Of a torus those of cos u and of its cube do; what is left is added."""
    chain = moment_of_inertia(Torus(R, a, M), "x").step.chain
    (multiplied,) = [form.expr for form in chain if form.because == "multiplied"]
    assert 0 not in {term for sums in multiplied.atoms(Terms) for term in sums.args}


def test_a_symbol_names_one_side_of_a_triangle() -> None:
    triangle = Triangle(((ZERO, ZERO), (2 * a, ZERO), (ZERO, a)), M)
    assert triangle.edges == ((2 * a, ((0, 1),)),)
