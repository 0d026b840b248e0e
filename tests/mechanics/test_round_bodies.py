"""Round and thin bodies, and those made of them, against what the textbooks tabulate and by scaling."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from sympy import Integral, Matrix, Rational, cos, diag, integrate, pi, simplify, sin, sqrt, symbols, zeros

from derive.algebra.equality import Grade
from derive.errors import Rejected
from derive.mechanics import (
    Ball,
    Composite,
    Cone,
    Cuboid,
    Cylinder,
    Disc,
    Hoop,
    Plate,
    Rod,
    agreement,
    centre_of_mass,
    inertia_tensor,
    minus,
    moment_of_inertia,
    moved_from_centre,
    moved_to,
    symbolic_body,
)
from derive.mechanics.bodies.body import Body
from derive.steps.step import Quantity, is_zero
from tests.mechanics.round_bodies import M, R, a, cone_derivation, h, m, top_derivation
from tests.mechanics.verbs import verbs_as_imported

b = symbols("b", positive=True)
CONE = Cone(R, h, M)
ACROSS = M * (3 * R**2 + h**2) / 12
TABLES: list[tuple[Body, str, Any]] = [
    (Rod(a, M), "centre", diag(1, 1, 0) * M * a**2 / 12),
    (Rod(a, M), "end", diag(1, 1, 0) * M * a**2 / 3),
    (Disc(R, M), "centre", diag(1, 1, 2) * M * R**2 / 4),
    (Disc(R, M), "rim", diag(1, 5, 6) * M * R**2 / 4),
    (Disc(sqrt(a**2 + b**2), M), "centre", diag(1, 1, 2) * M * (a**2 + b**2) / 4),
    (Hoop(R, M), "centre", diag(1, 1, 2) * M * R**2 / 2),
    (Hoop(R, M), "rim", diag(1, 3, 4) * M * R**2 / 2),
    (Plate((a, b), M), "centre", diag(b**2, a**2, a**2 + b**2) * M / 12),
    (Cylinder(R, h, M), "centre", diag(ACROSS, ACROSS, M * R**2 / 2)),
    (Ball(R, M), "centre", diag(2, 2, 2) * M * R**2 / 5),
    (CONE, "centre", diag(R**2 + h**2 / 4, R**2 + h**2 / 4, 2 * R**2) * M * Rational(3, 20)),
    (CONE, "apex", diag(R**2 / 4 + h**2, R**2 / 4 + h**2, R**2 / 2) * M * Rational(3, 5)),
    (CONE, "base", diag(3 * R**2 + 2 * h**2, 3 * R**2 + 2 * h**2, 6 * R**2) * M / 20),
]
BODIES = list(dict.fromkeys(body for body, _, _ in TABLES))


def named(value: Any) -> str:
    return value.name.removeprefix("a ") if isinstance(value, Body) else str(value)[:20]


@cache
def cone() -> dict[str, Quantity]:
    return cone_derivation(verbs_as_imported())


@cache
def top() -> dict[str, Quantity]:
    return top_derivation(verbs_as_imported())


def grades(found: dict[str, Quantity]) -> set[Grade]:
    return {e.grade for quantity in found.values() for e in quantity.step.evidence}


# --- tensors ---


@pytest.mark.parametrize(("body", "about", "tabulated"), TABLES, ids=named)
def test_a_body_has_the_tensor_of_the_tables(body: Body, about: str, tabulated: Any) -> None:
    assert (inertia_tensor(body, about).value - tabulated).expand() == zeros(3)


@pytest.mark.parametrize("body", BODIES, ids=named)
def test_particles_have_the_mass_centre_and_second_moments_of_the_body(body: Body) -> None:
    region = body.region(body.point(body.reference)).with_section_put_in()
    x = region.position

    def by_integral(f: Any) -> Any:
        value = f * region.element
        for limit in reversed(region.limits):
            value = integrate(simplify(value), limit)
        return value * body.mass / body.size

    assert sum(mass for mass, _ in body.particles()) == body.mass
    for i in range(3):
        assert simplify(by_integral(x[i]) - sum(mass * r[i] for mass, r in body.particles())) == 0
        for j in range(i, 3):
            assert simplify(by_integral(x[i] * x[j]) - sum(mass * r[i] * r[j] for mass, r in body.particles())) == 0


@pytest.mark.parametrize("body", BODIES, ids=named)
def test_every_line_of_a_tensor_is_proved(body: Body) -> None:
    tensor = inertia_tensor(body)
    found = {quantity.key: quantity for quantity in [tensor, *tensor.parents]}
    assert grades(found) <= {Grade.PROVED, Grade.DEFINITION}


def test_the_two_ways_to_the_tensor_of_a_cone_agree_and_are_proved() -> None:
    assert cone()["agreement"].value == cone()["inertia_tensor"].value == cone()["tensor_from_base"].value
    assert cone()["agreement"].step.outcome == "turned"
    assert grades(cone()) == {Grade.PROVED, Grade.DEFINITION}


def test_the_centre_of_mass_of_a_cone_is_a_quarter_of_its_height_above_the_base() -> None:
    assert cone()["centre_of_mass"].value == Matrix([0, 0, 3 * h / 4])
    assert cone()["centre_from_base"].value == Matrix([0, 0, h / 4])
    assert cone()["volume"].value == pi * R**2 * h / 3


def test_cartesian_and_cylindrical_coordinates_give_one_tensor() -> None:
    for body, about in ((CONE, "apex"), (Cylinder(R, h, M), "base"), (Ball(R, M), "centre")):
        found = [inertia_tensor(body, about, system).value for system in ("cartesian", "cylindrical")]
        assert found[0] == found[1]


def test_a_cone_twice_the_size_at_the_same_density_has_thirty_two_times_the_tensor() -> None:
    I = cone()["inertia_tensor"].value
    assert (I.subs({R: 2 * R, h: 2 * h, M: 8 * M}, simultaneous=True) - 32 * I).expand() == zeros(3)


def test_a_flat_cone_is_a_disc_with_mass_towards_its_middle() -> None:
    """Pressed flat, its mass per area falls linearly from the middle to the rim: I_zz = 3/10 M R^2."""
    I = cone()["inertia_tensor"].value.subs(h, 0)
    assert I[0, 0] + I[1, 1] - I[2, 2] == 0
    r = symbols("r", positive=True)
    weight = integrate(r**3 * (R - r), (r, 0, R)) / integrate(r * (R - r), (r, 0, R))
    assert I[2, 2] == M * weight


def test_moving_from_the_end_of_a_rod_gives_a_twelfth() -> None:
    rod = Rod(a, M)
    assert moved_to(inertia_tensor(rod, "end"), rod.centre).value == diag(1, 1, 0) * M * a**2 / 12


@pytest.mark.parametrize("body", [Cuboid((a, 2 * a, 3 * a), M), Cylinder(R, h, M), CONE, Plate((a, b), M)], ids=named)
def test_moving_away_from_the_centre_undoes_moving_to_it(body: Body) -> None:
    there = inertia_tensor(body, body.reference)
    out = moved_from_centre(inertia_tensor(body, key="centre_tensor"), body.centre)
    assert (out.value - there.value).expand() == zeros(3)


def test_only_a_tensor_about_the_centre_is_moved_from_it() -> None:
    with pytest.raises(Rejected, match="`inertia_tensor` is not about the centre of mass"):
        moved_from_centre(inertia_tensor(CONE, "apex"), CONE.centre)


def test_a_letter_of_a_size_is_no_coordinate_as_well() -> None:
    r, z = symbols("r z", positive=True)
    region = Cone(r, z, M).region(Cone(r, z, M).point("apex"))
    assert [name.name for name in region.names] == ["zeta", "phi", "s"]


# --- refusals ---


def test_coordinates_that_a_body_does_not_have_are_refused() -> None:
    with pytest.raises(Rejected, match='a cuboid has no limits in "cylindrical" coordinates'):
        inertia_tensor(Cuboid((a, a, a), M), coordinates="cylindrical")


def test_a_point_that_a_body_does_not_have_is_refused() -> None:
    with pytest.raises(Rejected, match='a cone has no point "rim"'):
        inertia_tensor(CONE, about="rim")


def test_a_centre_counted_from_another_point_is_refused() -> None:
    with pytest.raises(
        Rejected, match="`inertia_tensor` is about the base, but `centre_of_mass` is measured from the apex"
    ):
        moved_to(inertia_tensor(CONE, about="base"), CONE.centre)


def test_tensors_of_different_bodies_or_points_are_not_compared() -> None:
    for other in (inertia_tensor(Ball(R, M)), inertia_tensor(CONE, "apex")):
        with pytest.raises(Rejected, match="not tensors of the same body about the same point"):
            agreement(inertia_tensor(CONE), other)


def test_a_radius_of_unknown_sign_is_refused_in_cartesian_coordinates() -> None:
    with pytest.raises(Rejected, match="the radius `R - h` may be negative"):
        inertia_tensor(Cone(R - h, h, M), "apex", "cartesian")


# --- bodies of parts ---


def test_the_top_of_disc_and_rod_has_the_moments_that_one_adds_up() -> None:
    assert top()["total_mass"].value == Rational(3, 2) * m
    assert top()["centre_distance"].value == a / 2
    assert top()["axial_moment"].value == m * a**2 / 2
    assert top()["transverse_moment"].value == Rational(2, 3) * m * a**2
    assert grades(top()) == {Grade.PROVED}


def test_a_part_is_a_step_of_its_own() -> None:
    assert top()["disc_moment_x"].value == m * a**2 / 4
    assert top()["rod_moment_x"].value == m * a**2 / 24
    assert top()["rod_moment_z"].step.outcome == "none"
    assert top()["disc_moment_x"].step.outcome == "flat"


def test_two_halves_of_a_cylinder_are_the_cylinder() -> None:
    halves = Composite(
        Cylinder(R, h / 2, M / 2).named("lower").at(0, 0, h / 4),
        Cylinder(R, h / 2, M / 2).named("upper").at(0, 0, 3 * h / 4),
        points={"pivot": (0, 0, 0)},
    )
    whole = inertia_tensor(Cylinder(R, h, M), about="base").value
    mass, distance, across, along = symbolic_body(halves).values
    assert (along.value - whole[2, 2]).expand() == 0
    assert (across.value - whole[0, 0]).expand() == 0
    assert mass.symbol.name == "M_0"  # M is given
    assert distance.value == h / 2


def test_a_hole_is_taken_off_and_a_turned_part_counted_about_its_own_axis() -> None:
    ring = Composite(Disc(2 * R, 4 * M), minus(Disc(R, M).named("hole")))
    assert (moment_of_inertia(ring, "z", "origin").value - M * (16 - 1) * R**2 / 2).expand() == 0
    wheel = Composite(Disc(R, M).turned("x", pi / 2), Rod(h, M).at(0, 0, h))
    found = moment_of_inertia(wheel, "y", "origin", key="about_y")
    assert (found.value - M * R**2 / 2 - M * h**2 / 12 - M * h**2).expand() == 0
    assert found.step.rule == "rotation.moment_of_parts"


def test_centre_of_mass_of_a_hoop_is_its_middle() -> None:
    assert centre_of_mass(Hoop(R, M)).value == zeros(3, 1)


def test_the_centre_of_a_ball_is_where_it_is_counted_from() -> None:
    assert is_zero(centre_of_mass(Ball(R, M)).value)
    assert centre_of_mass(Ball(R, M)).step.outcome == "round"


def test_in_cylindrical_coordinates_a_ball_has_no_chords() -> None:
    reasons = {
        coordinates: {
            form.because for q in inertia_tensor(Ball(R, M), coordinates=coordinates).parents for form in q.step.chain
        }
        for coordinates in ("cartesian", "cylindrical")
    }
    assert "chords" in reasons["cartesian"]
    assert "chords" not in reasons["cylindrical"]
    assert all("discs" in found for found in reasons.values())


def test_the_slices_of_a_body_with_a_name_have_its_index() -> None:
    found = inertia_tensor(Ball(R, M).named("upper ball"), key="own")
    assert (found.value - Rational(2, 5) * M * R**2 * Matrix.eye(3)).expand().is_zero_matrix
    assert {str(q.symbol) for q in found.ancestors() if q.step.rule == "bodies.section_radius"} == {"r_upper"}


@pytest.mark.parametrize("about", ["apex", "base", "centre"])
def test_a_cone_has_its_slices_by_polar_coordinates_from_each_of_its_points(about: str) -> None:
    region = CONE.region(CONE.point(about))
    z, theta, s = region.names
    radius, edge = region.section or (None, None)
    assert region.position[:2] == [s * cos(theta), s * sin(theta)]
    assert region.limits[2] == (s, 0, radius)
    assert str(radius) == ("r" if about == "apex" else "r'")
    mass = Integral(M / CONE.size * region.element, *reversed(region.with_section_put_in().limits)).doit()
    assert (mass - M).expand() == 0
    assert edge is not None and edge.has(z)


def test_only_the_cross_section_of_a_ball_is_found_by_pythagoras() -> None:
    ball, cone = (inertia_tensor(body, coordinates="cartesian") for body in (Ball(R, M), CONE))
    found = {q.step.outcome for q in [*ball.ancestors(), *cone.ancestors()] if q.step.rule == "bodies.section_radius"}
    assert found == {"ball", "straight"}
