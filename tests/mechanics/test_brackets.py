"""Poisson brackets, as the textbooks have them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import Any

import pytest
from sympy import Expr, cos, exp, sin, sqrt, symbols

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import TIME as t
from derive.algebra.expressions import explicit
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Coordinate,
    Particle,
    System,
    central,
    conjugate,
    coordinate,
    hamiltonian,
    lagrangian,
    let,
    point,
    poisson_bracket,
    spring,
)
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity

m, k, K = symbols("m k K", positive=True)


@pytest.fixture(autouse=True)
def run() -> Iterator[Run]:
    with recorded() as run:
        yield run


def lengths(*names: str) -> tuple[Coordinate, ...]:
    return tuple(coordinate(name, "length") for name in names)


def same(found: Quantity, expected: Expr | int) -> bool:
    return bool(equal(explicit(found.value), expected)) and found.step.grade is Grade.PROVED


def angular_momenta() -> tuple[list[Quantity], tuple[Coordinate, ...]]:
    places = lengths("x", "y", "z")
    x, y, z = places
    p_x, p_y, p_z = (conjugate(q) for q in places)
    return [
        let("L_x", lambda: y * p_z.symbol - z * p_y.symbol, kind="angular momentum"),
        let("L_y", lambda: z * p_x.symbol - x * p_z.symbol, kind="angular momentum"),
        let("L_z", lambda: x * p_y.symbol - y * p_x.symbol, kind="angular momentum"),
    ], places


def test_fundamental_brackets_are_one_or_nothing() -> None:
    x, y = lengths("x", "y")
    p_x, p_y = conjugate(x), conjugate(y)
    letters = (x, y, p_x, p_y)
    for one, other in combinations(letters, 2):
        expected = int((one, other) in {(x, p_x), (y, p_y)})
        assert same(poisson_bracket(one, other, x, y), expected)
        assert same(poisson_bracket(other, one, x, y), -expected)


def test_components_of_the_angular_momentum_give_one_another() -> None:
    """Goldstein, section 9.7: {L_x, L_y} = L_z, and round."""
    momenta, places = angular_momenta()
    for i in range(3):
        one, other, third = (momenta[(i + n) % 3] for n in range(3))
        found = poisson_bracket(one, other, *places, among=momenta)
        assert same(found, explicit(third.value))
        assert found.step.result == third.symbol
    found = poisson_bracket(momenta[1], momenta[0], *places, among=momenta)
    assert found.step.result == -momenta[2].symbol


def test_the_square_of_the_angular_momentum_commutes_with_each_component() -> None:
    momenta, places = angular_momenta()
    square = let("J_2", lambda x, y, z: x**2 + y**2 + z**2, *momenta)
    found = poisson_bracket(square, momenta[2], *places)
    assert (explicit(found.value), found.step.outcome) == (0, "zero")


def test_functions_of_any_sort_have_brackets() -> None:
    (x,) = lengths("x")
    p = conjugate(x).symbol
    assert same(poisson_bracket(sin(x.symbol / k), p**2, x), 2 * p * cos(x.symbol / k) / k)
    assert same(
        poisson_bracket(exp(x.symbol / k), sqrt(p**2 + m**2), x), exp(x.symbol / k) * p / (k * sqrt(p**2 + m**2))
    )


def oscillator() -> tuple[Quantity, Coordinate, Coordinate]:
    x, y = lengths("x", "y")
    at = point(x, y)
    return hamiltonian(lagrangian(System(Particle(m, at), spring(k, point(0, 0), at)))), x, y


def test_the_bracket_with_the_hamiltonian_is_the_rate() -> None:
    """Goldstein, section 9.6."""
    H, x, _ = oscillator()
    assert same(poisson_bracket(x, H), conjugate(x).symbol / m)
    found = poisson_bracket(conjugate(x), H)
    assert same(found, -k * x.symbol)
    assert {e.claim for e in found.step.evidence} >= {"rules", "along_the_motion"}


def test_an_oscillator_in_the_plane_conserves_more_than_its_energy() -> None:
    """The tensor p_x p_y/m + k x y (Goldstein, section 9.7)."""
    H, x, y = oscillator()
    p_x, p_y = conjugate(x).symbol, conjugate(y).symbol
    for value in (x * p_y - y * p_x, p_x * p_y / m + k * x.symbol * y.symbol):
        assert poisson_bracket(value, H, key=f"rate_{len(str(value))}").step.outcome == "conserved"


def test_what_contains_the_time_need_not_be_conserved_where_its_bracket_vanishes() -> None:
    H, x, y = oscillator()
    found = poisson_bracket(t * (x * conjugate(y).symbol - y * conjugate(x).symbol), H)
    assert (explicit(found.value), found.step.outcome) == (0, "zero")


def test_a_planet_conserves_the_vector_of_runge_and_lenz() -> None:
    """Goldstein, section 3.9, in the plane: A = p x L - m k r/|r|."""
    x, y = lengths("x", "y")
    at, d = point(x, y), symbols("d", positive=True)
    H = hamiltonian(lagrangian(System(Particle(m, at), central(-K / d, d, point(0, 0), at))))
    p_x, p_y = conjugate(x).symbol, conjugate(y).symbol
    turning, r = x * p_y - y * p_x, sqrt(x.symbol**2 + y.symbol**2)
    A = let("A_x", lambda: p_y * turning - m * K * x.symbol / r)
    assert poisson_bracket(A, H).step.outcome == "conserved"


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda x: poisson_bracket(x, conjugate(x)), "needs the coordinates"),
        (lambda x: poisson_bracket(x.rate, x, x), "contains x_dot"),
        (lambda x: poisson_bracket("x", x, x), "`poisson_bracket` needs two scalars, but `x` is not one"),
    ],
)
def test_what_has_no_bracket_is_refused(wrong: Callable[..., Any], said: str) -> None:
    (x,) = lengths("x")
    with pytest.raises(Rejected, match=said):
        wrong(x)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("Factors", lambda f, g: 2 * f * g),
        ("Terms", lambda *terms: -terms[0]),
        ("_derivatives", lambda f, g, pairs: [(1, p, q) for q, p in pairs]),
    ],
)
def test_a_wrong_law_is_refused(name: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    (x,) = lengths("x")
    p = conjugate(x)
    monkeypatch.setattr(f"derive.mechanics.hamilton.brackets.{name}", wrong)
    with pytest.raises(Unverified):
        poisson_bracket(x**2 * p.symbol, p.symbol, x)
