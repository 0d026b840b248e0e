"""Conserved momenta, Routhians and effective potentials, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, cos, sin, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import Relation, explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    Z,
    central,
    conserved,
    coordinate,
    effective_potential,
    equation_of_motion,
    equations_of_motion,
    lagrangian,
    point,
    routhian,
    space,
    spring,
    weight,
)
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity
from tests.mechanics.spinning_top import motion_of
from tests.mechanics.verbs import verbs_as_imported

m, M, g, l, k, R, w, K = symbols("m M g l k R omega K", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def planet() -> tuple[Quantity, Coordinate, Coordinate]:
    r, phi = coordinate("r", "length", positive=True), coordinate("phi")
    at, d = point(r * cos(phi), r * sin(phi)), symbols("d", positive=True)
    return lagrangian(System(Particle(m, at), central(-K * m / d, d, point(0, 0), at))), r, phi


def spherical_pendulum() -> tuple[Quantity, Coordinate, Coordinate]:
    q, phi = coordinate("theta"), coordinate("phi")
    at = point(l * sin(q) * cos(phi), l * sin(q) * sin(phi), -l * cos(q))
    return lagrangian(System(Particle(m, at), weight(g))), q, phi


def pendulum_on_cart() -> tuple[Quantity, Coordinate, Coordinate]:
    x, q = coordinate("x", "length"), coordinate("theta")
    at = point(x + l * sin(q), -l * cos(q))
    return lagrangian(System(Particle(M, point(x, 0)), Particle(m, at), weight(g))), x, q


def letters(text: str) -> Any:
    return symbols(text, real=True)


def same(found: Quantity, expected: Expr) -> bool:
    return bool(equal(explicit(found.value), expected)) and found.step.grade is Grade.PROVED


# --- conserved momenta ---


def test_a_planet_conserves_its_angular_momentum() -> None:
    L, r, phi = planet()
    found = conserved(L, phi, value="l")
    assert same(found, m * r.symbol**2 * phi.rate)
    assert (found.symbol, found.step.kind, found.step.outcome) == (letters("l"), "angular momentum", "angular")


def test_a_cart_and_what_hangs_from_it_conserve_their_momentum() -> None:
    L, x, q = pendulum_on_cart()
    found = conserved(L, x)
    assert same(found, (M + m) * x.rate + m * l * q.rate * cos(q.symbol))
    assert (found.symbol, found.step.kind, found.step.outcome) == (letters("p_x"), "momentum", "linear")


# --- effective potentials ---


def test_the_effective_potential_of_a_planet() -> None:
    """Taylor, section 8.4; Goldstein, section 3.3."""
    L, r, phi = planet()
    J = letters("l")
    found = effective_potential(L, conserved(L, phi, value="l"))
    assert same(found, J**2 / (2 * m * r.symbol**2) - K * m / r.symbol)
    assert (found.step.outcome, found.step.kind) == ("reduced", "energy")


def test_the_effective_potential_of_a_spherical_pendulum() -> None:
    """Landau, Lifshitz, section 14, problem 1; the cyclic coordinate is found without being named."""
    L, q, _ = spherical_pendulum()
    p = letters("p_phi")
    assert same(effective_potential(L), p**2 / (2 * m * l**2 * sin(q.symbol) ** 2) - m * g * l * cos(q.symbol))


def test_the_effective_potential_of_a_bead_on_a_turning_hoop() -> None:
    """Goldstein, section 2.7; Taylor, section 7.6: the kinetic energy at rest is taken off."""
    q = coordinate("theta")
    L = lagrangian(System(Particle(m, space.turned(Z, w * t).place(R * sin(q), 0, -R * cos(q))), weight(g)))
    found = effective_potential(L)
    assert same(found, -m * R**2 * w**2 * sin(q.symbol) ** 2 / 2 - m * g * R * cos(q.symbol))
    assert found.step.outcome == "driven"


def test_a_particle_in_a_turning_plane_sees_a_centrifugal_potential() -> None:
    """The rates occur to the first power too, which at rest makes no force."""
    x, y = coordinate("x", "length"), coordinate("y", "length")
    at = space.turned(Z, w * t).place(x, y, 0)
    found = effective_potential(lagrangian(System(Particle(m, at), spring(k, 0 * Z, at))))
    assert same(found, (k - m * w**2) * (x.symbol**2 + y.symbol**2) / 2)


def test_a_pendulum_sees_no_more_than_its_weight() -> None:
    q = coordinate("theta")
    found = effective_potential(lagrangian(System(Particle(m, point(l * sin(q), -l * cos(q))), weight(g))))
    assert (explicit(found.value), found.step.outcome) == (-m * g * l * cos(q.symbol), "unchanged")


def test_a_momentum_that_is_coupled_to_the_rest_adds_what_it_has_at_rest() -> None:
    L, x, q = pendulum_on_cart()
    P = letters("P")
    found = effective_potential(L, conserved(L, x, value="P"))
    assert same(found, P**2 / (2 * (M + m)) - m * g * l * cos(q.symbol))


# --- Routhians ---


def test_the_routhian_of_a_planet_is_a_lagrangian_of_the_distance() -> None:
    """Goldstein, section 8.3, with the other sign."""
    L, r, phi = planet()
    J = letters("l")
    reduced = routhian(L, conserved(L, phi, value="l"))
    assert same(reduced, m * r.rate**2 / 2 - J**2 / (2 * m * r.symbol**2) + K * m / r.symbol)
    motion = equation_of_motion(reduced, r)
    assert motion.step.grade is Grade.PROVED
    assert equal(motion.value, Relation(m * r.acceleration, "=", J**2 / (m * r.symbol**3) - K * m / r.symbol**2))


def test_the_equations_of_a_routhian_are_those_of_the_other_coordinates_alone() -> None:
    L, x, q = pendulum_on_cart()
    (motion,) = equations_of_motion(routhian(L, conserved(L, x, value="P")))
    mass = m * l**2 * (M + m * sin(q.symbol) ** 2) / (M + m)
    bent = m**2 * l**2 * sin(q.symbol) * cos(q.symbol) * q.rate**2 / (M + m)
    assert equal(motion.value, Relation(mass * q.acceleration + bent + m * g * l * sin(q.symbol), "=", 0))


def test_a_heavy_top_has_two_cyclic_angles() -> None:
    """Goldstein, section 5.7: V' = (a - b cos theta)^2/(2 I_x sin^2 theta) + M g l cos theta, but for a constant."""
    top: SimpleNamespace = motion_of(verbs_as_imported())
    phi, theta, psi = top.phi, top.theta, top.psi
    mass, arm, I_x, I_z = (each.symbol for each in top.top.values)
    constants = conserved(top.L, phi), conserved(top.L, psi)
    p, s = letters("p_phi p_psi")
    q = theta.symbol
    seen = (p - s * cos(q)) ** 2 / (2 * I_x * sin(q) ** 2) + s**2 / (2 * I_z)
    gravity = symbols("g", positive=True)
    expected = I_x * theta.rate**2 / 2 - seen - mass * gravity * arm * cos(q)
    assert same(routhian(top.L, *constants), expected)


# --- what is refused ---


def driven() -> Quantity:
    q = coordinate("theta")
    return lagrangian(System(Particle(m, point(l * sin(q), R * cos(w * t) - l * cos(q))), weight(g)))


def elsewhere() -> Quantity:
    with recorded():
        return conserved(planet()[0], coordinate("phi"))


def of_planet(verb: Callable[..., Any]) -> Callable[[], Any]:
    return lambda: verb(*planet())


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (of_planet(lambda L, r, phi: conserved(L, r)), "contains r"),
        (of_planet(lambda L, r, phi: conserved(L, coordinate("z", "length"))), "does not depend on the coordinate"),
        (of_planet(lambda L, r, phi: routhian(L)), "needs a conserved momentum"),
        (of_planet(lambda L, r, phi: routhian(L, L)), "not a momentum that `conserved` returned"),
        (of_planet(lambda L, r, phi: routhian(L, conserved(L, phi), conserved(L, phi))), "given twice"),
        (lambda: effective_potential(driven()), "contains the time"),
        (
            lambda: effective_potential(lagrangian(System(Particle(m, point(coordinate("x", "length"), 0))))),
            "no coordinate remains",
        ),
        (lambda: routhian(pendulum_on_cart()[0], elsewhere()), "not a momentum of"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


@pytest.mark.parametrize(
    ("name", "wrong", "verb"),
    [
        ("Factors", lambda *f: 2 * f[0] * f[1], effective_potential),
        ("Factors", lambda *f: -f[0] * f[1], routhian),
        ("Partial", lambda f, x: -explicit(f).diff(x), conserved),
        ("At", lambda f, x, place: f, effective_potential),
    ],
)
def test_a_wrong_law_is_refused(
    name: str, wrong: Callable[..., Any], verb: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    L, _, phi = planet()
    given = phi if verb is conserved else conserved(L, phi)
    monkeypatch.setattr(f"derive.mechanics.hamilton.effective.{name}", wrong)
    with pytest.raises(Unverified):
        verb(L, given)
