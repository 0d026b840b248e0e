"""Any body by its position map, against named shapes and against values worked by hand."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, Integral, Matrix, Rational, cos, diag, exp, pi, sin, sqrt, symbols, zeros

import derive.mechanics.bodies.mapped_bodies as general
from derive.algebra.equality import Grade, equal
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Ball,
    Cone,
    Sheet,
    Solid,
    Wire,
    centre_of_mass,
    inertia_tensor,
    moment_of_inertia,
    moved_to,
    variables,
)
from derive.mechanics.bodies.mapping import cell
from derive.mechanics.bodies.quadrature import agrees

R, h, M, a, b, c, l, rho_0 = symbols("R h M a b c l rho_0", positive=True)
r, theta, phi, x, y, z = variables("r", "theta", "phi", "x", "y", "z")
SPHERE = (r * sin(theta) * cos(phi), r * sin(theta) * sin(phi), r * cos(theta))
ROUND = {r: (0, R), theta: (0, pi), phi: (0, 2 * pi)}


def test_a_ball_by_its_map_is_the_ball() -> None:
    ball = Solid(SPHERE, ROUND, mass=M)
    tensor = inertia_tensor(ball, "origin")
    assert tensor.value == inertia_tensor(Ball(R, M)).value
    assert ball.extent.value == Rational(4, 3) * pi * R**3
    assert tensor.step.outcome == "isotropic"
    assert tensor.step.grade is Grade.SAMPLED  # its second route is a sum in numbers


@pytest.mark.long
def test_a_cone_by_cartesian_or_cylindrical_limits_is_the_cone() -> None:
    """Goldstein, section 5.3: 3/20 M (R^2 + 4 h^2) and 3/10 M R^2 about the apex."""
    cone = Solid((r * cos(phi), r * sin(phi), z), {z: (0, h), r: (0, R * z / h), phi: (0, 2 * pi)}, mass=M)
    assert inertia_tensor(cone, "origin").value == inertia_tensor(Cone(R, h, M), "apex").value
    assert centre_of_mass(cone).value == Matrix([0, 0, 3 * h / 4])


def test_a_density_gives_the_mass_and_moments_in_its_own_letter() -> None:
    """rho = rho_0 r/R: M = pi rho_0 R^3 and I = 4/9 M R^2, by the integral of r^5 over that of r^3."""
    ball = Solid(SPHERE, ROUND, density=rho_0 * r / R)
    assert ball.density.value == ball.mass == pi * rho_0 * R**3
    moment = moment_of_inertia(ball, "z", "origin")
    assert (moment.value - Rational(4, 9) * ball.mass * R**2).expand() == 0
    assert moment.step.chain[-1].because == "by_mass"


def test_a_mass_makes_a_density_known_but_for_a_factor() -> None:
    """A rod whose mass per length grows from zero: I = M l^2/2 about the light end, Morin section 8.3."""
    rod = Wire((0, 0, z), {z: (0, l)}, mass=M, density=z)
    assert rod.density.value == 2 * M * z / l**2
    assert inertia_tensor(rod, "origin").value == diag(1, 1, 0) * M * l**2 / 2
    assert centre_of_mass(rod).value == Matrix([0, 0, 2 * l / 3])


def test_cells_of_curves_and_surfaces_come_from_the_map() -> None:
    helix = Wire((R * cos(phi), R * sin(phi), h * phi / (2 * pi)), {phi: (0, 2 * pi)}, mass=M)
    assert (helix.extent.value**2 - 4 * pi**2 * R**2 - h**2).expand() == 0
    assert cell(*Sheet([R * s / r for s in SPHERE], {theta: (0, pi), phi: (0, pi)}, mass=M).map()) == R**2 * sin(theta)
    side = Sheet((R * z / h * cos(phi), R * z / h * sin(phi), z), {z: (0, h), phi: (0, 2 * pi)}, mass=M)
    assert side.extent.value == pi * R * sqrt(R**2 + h**2)


def test_limits_may_depend_on_what_is_further_out() -> None:
    """A plate under a parabola: its centre is at 2/5 of the height."""
    plate = Sheet((x, y), {x: (-a, a), y: (0, h * (1 - x**2 / a**2))}, mass=M)
    assert centre_of_mass(plate).value == Matrix([0, 2 * h / 5, 0])
    half = Sheet((x, y), {x: (-R, R), y: (0, sqrt(R**2 - x**2))}, mass=M)
    assert centre_of_mass(half).value == Matrix([0, 4 * R / (3 * pi), 0])


def test_a_general_tensor_is_moved_and_named_like_any_other() -> None:
    plate = Sheet((x, y), {x: (0, a), y: (0, b)}, mass=M).named("lower plate")
    there = inertia_tensor(plate, "origin")
    assert there.key == "lower_plate_inertia_tensor"
    assert moved_to(there, plate.centre).value == diag(b**2, a**2, a**2 + b**2) * M / 12


def test_an_exponential_density_is_integrated_by_parts() -> None:
    rod = Wire((0, 0, z), {z: (0, l)}, density=rho_0 * exp(-z / l))
    assert (rod.mass - rho_0 * l * (1 - exp(-1))).simplify() == 0


def test_the_sign_of_an_integral_precedes_it() -> None:
    moment = moment_of_inertia(Wire((x, 0, 0), {x: (0, l)}, density=rho_0 * x / l), "z")
    integrals = [each for form in moment.step.chain for each in form.expr.atoms(Integral)]
    assert len(integrals) > 3
    assert not any(each.function.as_coeff_Mul()[0].is_negative for each in integrals)


def test_particles_of_a_general_body_have_its_moments() -> None:
    plate = Sheet((x, y), {x: (0, a), y: (0, b * x / a)}, mass=M)
    assert sum((m for m, _ in plate.particles()), Integer(0)).simplify() == M
    products = sum((m * p[0] * p[1] for m, p in plate.particles()), Integer(0))
    assert (products - M * a * b / 4).simplify() == 0


# --- refusals ---


def test_a_sum_over_cells_refuses_another_value() -> None:
    position, limits = Solid(SPHERE, ROUND, mass=M).map()
    assert agrees(Rational(4, 3) * pi * R**3, [Integer(1)], position, limits).grade is Grade.SAMPLED
    assert agrees(pi * R**3, [Integer(1)], position, limits).grade is Grade.REFUTED


def test_a_wrong_cell_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The cell of a disc taken for that of a square: neither the cell nor the area agrees."""
    disc = Sheet((r * cos(phi), r * sin(phi)), {r: (0, R), phi: (0, 2 * pi)}, mass=M)
    disc._mapped = Integer(1)
    with pytest.raises(Unverified, match="quadrature"):
        inertia_tensor(disc, "origin")
    other = Sheet((r * cos(phi), r * sin(phi)), {r: (0, R), phi: (0, 2 * pi)}, mass=M)
    monkeypatch.setattr(general, "cell", lambda *_: R)
    with pytest.raises(Unverified, match="sentence"):
        general.cell_of(other)


def test_a_volume_of_the_wrong_sense_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    backwards = Solid((r * cos(phi), r * sin(phi), z), {z: (0, h), phi: (0, 2 * pi), r: (0, R)}, mass=M)
    assert equal(general.cell_of(backwards).value, -r)
    wrong = general.Dot
    monkeypatch.setattr(general, "Dot", lambda one, other: -wrong(one, other))
    with pytest.raises(Unverified, match="edges"):
        general.cell_of(Solid(SPHERE, ROUND, mass=M))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sheet((x, y), {x: (a, 0), y: (0, b)}, mass=M), "which is an empty interval"),
        (lambda: Sheet((x, y), {x: (0, a), y: (b, b)}, mass=M), "which is an empty interval"),
        (lambda: Sheet((x, y), {x: (0, y), y: (0, b)}, mass=M), "is not an outer variable"),
        (
            lambda: Sheet((x, x), {x: (0, a), y: (0, b)}, mass=M),
            "does not vary independently with each",
        ),
        (lambda: Solid((x, y), {x: (0, a), y: (0, b)}, mass=M), "needs three variables"),
        (lambda: Sheet((x, y), {x: (0, a), y: (0, b)}), "needs a mass or a density"),
        (lambda: Sheet((r * cos(phi), r * sin(phi)), {r: (-R, R), phi: (0, pi)}, mass=M), "covers some places twice"),
        (lambda: Wire((x, exp(x / a) * a), {x: (0, a)}, mass=M).extent, "not finite or has no known antiderivative"),
        (lambda: Sheet((x, y), {x: (1 - a, a - 1), y: (a - 1, 1 - a)}, mass=M), "not in order"),
        (lambda: Sheet((x, y), {x: (0, b), y: (a, a - x)}, mass=M), "enclose nothing: `y` from a to a - x"),
    ],
)
def test_a_map_that_makes_no_body_is_refused(make: Any, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        make()


def test_the_centre_of_a_symmetric_map_is_its_origin() -> None:
    assert centre_of_mass(Sheet((x, y), {x: (-a, a), y: (-b, b)}, mass=M)).value == zeros(3, 1)
