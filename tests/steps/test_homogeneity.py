"""Every line has one dimension, and the term that has another is named."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr, Integer, Integral, Matrix, Rational, Symbol, acos, cos, pi, sin, sqrt, symbols

from derive.algebra import expressions as ex
from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import Inhomogeneous, dimension_of_kind
from derive.steps.establish import Lines, establish
from derive.steps.homogeneity import dimension_of, dimension_table, variables_of_integrals
from derive.steps.step import Form, Quantity, Step
from tests.mechanics import slab
from tests.mechanics.block import M, a, known_block, omega
from tests.rules import made_up

x, t = symbols("x t", real=True)
v, L = ex.vector("v"), ex.vector("L")
LENGTH, MASS, RATE, TIME, ENERGY = (
    dimension_of_kind(kind) for kind in ("length", "mass", "angular speed", "time", "energy")
)
TABLE: dict[Any, Dimension | None] = {a: LENGTH, M: MASS, omega: RATE, t: TIME, v: LENGTH / TIME, L: LENGTH * MASS}


@pytest.mark.parametrize(
    ("expr", "dimension"),
    [
        (M * a**2 * omega**2 / 2, ENERGY),
        (sqrt(a**2 + 9 * a**2), LENGTH),
        (sqrt(a**3 / (a * t**2)), LENGTH / TIME),
        (cos(omega * t) * a, LENGTH),
        (acos(a / sqrt(2 * a**2)), NUMBER),
        (pi / 2, NUMBER),
        (abs(-2 * a), LENGTH),
        (Matrix([a, 2 * a, 0]), LENGTH),
        (Integral(x**2, (x, 0, a)), LENGTH**3),
        (ex.Bracket(x**3 / 3, x, Integer(0), a), LENGTH**3),
        (ex.Dot(v, L), LENGTH**2 * MASS / TIME),
        (ex.Cross(v, L), LENGTH**2 * MASS / TIME),
        (ex.CarriedRate(L, ex.scaled(omega, ex.column(0, 0, 1))), LENGTH * MASS * RATE),
        (ex.Norm(v), LENGTH / TIME),
        (ex.Ratio(ex.Factors(M, a), ex.Group(a**2)), MASS / LENGTH),
        (ex.Root(ex.Terms(a**2, a**2)), LENGTH),
        (ex.scaled(M, v), MASS * LENGTH / TIME),
    ],
    ids=str,
)
def test_the_dimension_of_a_formula_is_that_of_physics(expr: Any, dimension: Dimension) -> None:
    assert dimension_of(expr, TABLE) == dimension


@pytest.mark.parametrize(
    ("expr", "message"),
    [
        (a + M, "`a` is a length, but `M` is a mass"),
        (a + a**2, "`a**2` is an area, but `a` is a length"),
        (ex.Terms(a, t), "`t` is a time, but `a` is a length"),
        (Matrix([a, a, M]), "`M` is a mass, but `a` is a length"),
        (sin(omega), "`omega` is an angular speed, but `sin(...)` is a number"),
        (ex.Bracket(x**2, x, a, t), "`t` is a time, but `a` is a length"),
    ],
    ids=str,
)
def test_a_term_of_another_dimension_is_named(expr: Any, message: str) -> None:
    with pytest.raises(Inhomogeneous) as fault:
        dimension_of(expr, TABLE)
    assert str(fault.value) == message


def test_zero_fits_every_dimension() -> None:
    assert dimension_of(Integer(0), TABLE) is None
    assert dimension_of(Matrix([0, a, 0]), TABLE) == LENGTH
    assert dimension_of(ex.Terms(a, Integer(0)), TABLE) == LENGTH


def test_a_number_does_not_fit_a_length() -> None:
    with pytest.raises(Inhomogeneous):
        dimension_of(ex.Terms(a, Integer(1)), TABLE)


def test_a_name_that_nobody_declared_is_an_error() -> None:
    with pytest.raises(KeyError):
        dimension_of(Symbol("unheard_of") * a, TABLE)


DECLARED = {a: LENGTH, M: MASS, omega: RATE}


def steps_of(*quantities: Quantity) -> list[Step]:
    return [quantity.step for quantity in quantities]


@pytest.mark.parametrize("variant", [{}, {"sides": (a, a, a)}, {"axis": (Integer(1), Integer(1), Integer(0))}])
def test_every_line_of_the_block_is_homogeneous(variant: dict[str, Any]) -> None:
    table, complaints = dimension_table(DECLARED, steps_of(*known_block(**variant).values()))
    assert complaints == []
    assert table[ex.scalar("T")] == ENERGY
    assert table[ex.vector("tau")] == ENERGY
    assert table[ex.scalar("theta")] == NUMBER


def test_wrong_dimensions_of_what_is_given_are_found_at_the_step() -> None:
    _, complaints = dimension_table({**DECLARED, omega: TIME}, steps_of(*known_block().values()))
    assert "`spin`: its dimension is T, but an angular speed must have T^-1" in [c.message for c in complaints]


SLAB = {slab.R: LENGTH, slab.a: LENGTH, slab.M: MASS, slab.I: MASS * LENGTH**2, slab.g: LENGTH / TIME**2}


@pytest.mark.parametrize("variant", [{}, {"radius": slab.a / 4}, {"radius": slab.a / 2}])
def test_every_line_about_a_motion_is_homogeneous(variant: dict[str, Any]) -> None:
    found = slab.known_slab(**variant)
    table, complaints = dimension_table(SLAB, steps_of(*found.values()))
    assert complaints == []
    dimensions = {key: table[q.symbol] for key, q in found.items() if q.symbol in table}
    force = MASS * LENGTH / TIME**2
    assert (dimensions["x"], dimensions["x_rate"]) == (LENGTH, LENGTH / TIME)
    assert (dimensions["lagrangian"], dimensions["potential_energy"]) == (ENERGY, ENERGY)
    assert (dimensions["lambda_x"], dimensions["normal_force"], dimensions["tangent_force"]) == (force, force, force)
    assert dimensions["frequency"] == TIME**-1
    assert dimensions["momentum_theta"] == ENERGY * TIME


def test_a_wrong_dimension_in_a_motion_is_found_where_it_first_shows() -> None:
    """A moment of inertia that is declared a mass cannot be added to M a^2."""
    _, complaints = dimension_table({**SLAB, slab.I: MASS}, steps_of(*slab.known_slab().values()))
    assert complaints[0].message.startswith("`kinetic_energy`: ")


def made(result: Expr, kind: str | None = None, *lines: Expr) -> Quantity:
    after = [Form(line, "line") for line in lines]
    return establish(
        made_up("test.made"),
        ex.scalar("q"),
        lambda: result,
        {},
        key="made",
        kind=kind,
        lines=Lines(after=after),
    )


def test_a_result_that_is_not_of_its_kind_is_found() -> None:
    _, complaints = dimension_table(DECLARED, steps_of(made(M * a, "energy")))
    assert [c.message for c in complaints] == ["`made`: its dimension is M L, but an energy must have M L^2 T^-2"]


def test_the_complaint_names_the_step_and_the_term() -> None:
    _, complaints = dimension_table(DECLARED, steps_of(made(M * a + M * a**2)))
    (complaint,) = complaints
    assert complaint.code == "dimension"
    assert complaint.message.startswith("`made`: ")
    assert "`M*a**2` is" in complaint.message or "`M*a` is" in complaint.message


def test_every_step_that_is_not_homogeneous_is_reported() -> None:
    _, complaints = dimension_table(DECLARED, steps_of(made(M + a), made(a, "mass"), made(a)))
    assert len(complaints) == 2


powers = st.tuples(*[st.fractions(min_value=-3, max_value=3, max_denominator=3)] * 3)


def of_powers(exponents: tuple[Any, ...]) -> Expr:
    m, k, n = (Rational(exponent.numerator, exponent.denominator) for exponent in exponents)
    return M**m * a**k * omega**n


@settings(max_examples=40, deadline=None, derandomize=True)
@given(powers, powers)
def test_dimensions_multiply_as_their_quantities_do(first: tuple[Any, ...], second: tuple[Any, ...]) -> None:
    p, q = of_powers(first), of_powers(second)
    dimensions = [Dimension(m, k, -n) for m, k, n in (first, second)]
    assert dimension_of(ex.Factors(p, q), TABLE) == dimensions[0] * dimensions[1]
    assert dimension_of(ex.Ratio(p, q), TABLE) == dimensions[0] / dimensions[1]
    assert dimension_of(ex.Root(p * q), TABLE) == (dimensions[0] * dimensions[1]) ** Fraction(1, 2)


def test_a_variable_of_integration_has_the_dimension_of_its_limits() -> None:
    r, phi = ex.scalar("r"), ex.scalar("phi")
    over_both = Integral(M * r / a**2, (r, 0, a), (phi, 0, 2 * pi))
    (step,) = steps_of(made(ex.explicit(over_both), None, over_both))
    assert variables_of_integrals(step, DECLARED) == {r: LENGTH, phi: NUMBER}


def test_a_variable_of_two_integrals_with_different_dimensions_has_no_dimension() -> None:
    u = ex.scalar("u")
    sum_of_both = ex.explicit(Integral(u, (u, 0, a))) / a**2 + ex.explicit(Integral(u, (u, 0, 1)))
    lines = Integral(u, (u, 0, a)) / a**2 + Integral(u, (u, 0, 1))
    (step,) = steps_of(made(sum_of_both, None, lines))
    assert variables_of_integrals(step, DECLARED) == {u: None}
