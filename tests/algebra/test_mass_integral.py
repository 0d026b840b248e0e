"""The integral over a body, by values that are known, and the dimension of its variables."""

from __future__ import annotations

import pytest
from sympy import Identity, ImmutableMatrix, Integer, MatrixSymbol, Tuple, symbols

from derive.algebra.dimensions import NUMBER
from derive.algebra.expressions import column, explicit
from derive.algebra.kinds import Inhomogeneous, dimension_of_kind
from derive.algebra.mass_integral import MassIntegral, dimensions_of_variables

a, b, rho, x, y = symbols("a b rho x y", positive=True)
r = MatrixSymbol("r", 3, 1)
LENGTH, MASS = dimension_of_kind("length"), dimension_of_kind("mass")
SIZES = {a: LENGTH, b: LENGTH, rho: MASS / LENGTH, Integer(0): None, Integer(1): NUMBER, Integer(2): NUMBER}


def rod(integrand: object, density: object = rho) -> MassIntegral:
    return MassIntegral(integrand, r, density, column(x, 0, 0), Integer(1), Tuple(x, 0, a))


def test_the_first_moment_of_a_rod_is_its_mass_times_its_middle() -> None:
    assert explicit(rod(r)) == ImmutableMatrix([rho * a**2 / 2, 0, 0])
    assert rod(r)[0, 0] == rho * a**2 / 2


def test_the_second_moment_of_a_rod_is_a_third() -> None:
    assert explicit(rod(r * r.T))[0, 0] == rho * a**3 / 3


def test_a_density_may_grow_along_the_body() -> None:
    assert explicit(rod(r, rho * x / a))[0, 0] == rho * a**2 / 3


def test_an_inner_limit_may_hold_an_outer_variable() -> None:
    triangle = MassIntegral(r, r, rho, column(x, y, 0), Integer(1), Tuple(y, 0, x), Tuple(x, 0, a))
    assert explicit(triangle) == ImmutableMatrix([rho * a**3 / 3, rho * a**3 / 6, 0])


def test_the_element_of_volume_weighs_each_place() -> None:
    disc = MassIntegral(r, r, rho, column(x, 0, 0), x, Tuple(x, 0, a))
    assert explicit(disc)[0, 0] == rho * a**3 / 3


def dimension(expr: object, inner: dict[object, object] | None = None) -> object:
    table = {**SIZES, **(inner or {})}
    return table.get(expr, NUMBER if isinstance(expr, Identity) else None)


def test_its_dimension_is_that_of_all_that_it_multiplies() -> None:
    assert rod(r).dimension(dimension) == MASS / LENGTH * LENGTH * LENGTH


def test_a_variable_has_the_dimension_of_its_limits() -> None:
    found = dimensions_of_variables([(y, Integer(0), x), (x, Integer(0), a)], dimension)
    assert found == {x: LENGTH, y: LENGTH}
    with pytest.raises(Inhomogeneous):
        dimensions_of_variables([(x, rho, a)], dimension)
