"""Names, and the nodes in which a law is written down before it is carried out."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import (
    Expr,
    Identity,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatAdd,
    MatMul,
    Matrix,
    Rational,
    Symbol,
    Tuple,
    exp,
    integrate,
    sin,
    sqrt,
    symbols,
    zeros,
)

from derive.algebra import expressions as ex
from derive.algebra.expressions import bound, column, explicit, scalar, tensor, vector

x, y, z = symbols("x y z", real=True)
a, b = symbols("a b", positive=True)
u, v = column(1, 2, 3), column(x, y, z)
r = vector("r")
whole = st.tuples(*[st.integers(-6, 6)] * 3)
bounded = settings(max_examples=30, deadline=None, derandomize=True)


@pytest.mark.parametrize(
    ("node", "value"),
    [
        (ex.Dot(u, v), x + 2 * y + 3 * z),
        (ex.Norm(column(2, -3, 6)), Integer(7)),
        (ex.Cross(u, v), column(2 * z - 3 * y, 3 * x - z, y - 2 * x)),
        (ex.Outer(u, v), ImmutableDenseMatrix([[x, y, z], [2 * x, 2 * y, 2 * z], [3 * x, 3 * y, 3 * z]])),
        (ex.Group(a + b), a + b),
        (ex.Factors(a, 3 * a, b), 3 * a**2 * b),
        (ex.Terms(8 * a, 18 * a), 26 * a),
        (ex.Ratio(6 * a, 4 * b), 3 * a / (2 * b)),
        (ex.Root(Integer(12)), 2 * sqrt(3)),
        (ex.Bracket(x**3 / 3, x, a, 2 * a), Rational(7, 3) * a**3),
        (ex.Amount(Integer(2), "cm", Rational(1, 100)), Rational(1, 50)),
        (ex.MatrixAmount(u, "g", Rational(1, 1000)), column(1, 2, 3) / 1000),
        (Integral(x**2 * y, (x, 0, y), (y, 0, 1)), Rational(1, 15)),
        (MatMul(Integer(2), u, evaluate=False), column(2, 4, 6)),
        (MatAdd(ex.Outer(u, u), Identity(3)), ImmutableDenseMatrix([[2, 2, 3], [2, 5, 6], [3, 6, 10]])),
    ],
)
def test_a_node_is_carried_out_as_its_name_says(node: Any, value: Any) -> None:
    assert explicit(node) == value


def test_nodes_within_nodes_are_carried_out_too() -> None:
    kinetic = ex.Factors(Rational(1, 2), ex.Dot(ex.Cross(u, v), ex.Cross(u, v)))
    assert explicit(kinetic).expand() == (Rational(1, 2) * Matrix(u).cross(v).dot(Matrix(u).cross(v))).expand()


def test_a_node_is_shown_as_written_until_it_is_carried_out() -> None:
    assert ex.Factors(a, a) != a**2
    assert ex.Terms(a, a) != 2 * a
    assert ex.Root(Integer(4)).args == (4,)
    assert ex.Ratio(a, a) != 1


def test_a_bracket_within_a_bracket_is_one() -> None:
    assert ex.Group(ex.Group(a + b)) == ex.Group(a + b)


def test_a_name_stays_a_name_when_a_formula_is_carried_out() -> None:
    formula = ex.applied(tensor("I"), vector("omega"))
    assert explicit(formula) == formula


def test_a_bound_formula_has_the_value_of_its_names() -> None:
    formula = ex.Dot(vector("omega"), ex.applied(tensor("I"), vector("omega")))
    value = explicit(bound(formula, {vector("omega"): u, tensor("I"): ImmutableDenseMatrix.diag(1, 10, 100)}))
    assert value == 1 + 40 + 900


def test_a_scalar_is_real_and_more_only_when_it_is_said() -> None:
    assert scalar("x") == Symbol("x", real=True)
    assert scalar("a", positive=True) == Symbol("a", real=True, positive=True)
    assert scalar("x").is_positive is None


def test_components_are_named_for_their_axes() -> None:
    assert [str(name) for name in ex.component_names("omega")] == ["omega_x", "omega_y", "omega_z"]


@bounded
@given(whole, whole)
def test_a_vector_product_is_perpendicular_to_both_factors(p: tuple[int, ...], q: tuple[int, ...]) -> None:
    product = ex.Cross(column(*p), column(*q))
    assert explicit(ex.Dot(product, column(*p))) == 0
    assert explicit(ex.Dot(product, column(*q))) == 0
    assert explicit(ex.Cross(column(*q), column(*p))) == -explicit(product)


@bounded
@given(whole, whole)
def test_a_vector_carried_round_changes_at_omega_cross_it(p: tuple[int, ...], w: tuple[int, ...]) -> None:
    carried = explicit(ex.CarriedRate(column(*p), column(*w)))
    assert (carried - explicit(ex.Cross(column(*w), column(*p)))).applyfunc(lambda e: e.expand()) == zeros(3, 1)


@bounded
@given(st.integers(0, 4), st.integers(0, 4), st.integers(-3, 3), st.integers(-3, 3))
def test_a_polynomial_is_integrated_as_sympy_integrates_it(k: int, m: int, lower: int, upper: int) -> None:
    f = (x**k + a * y**m) * (1 + x * y)
    limits = ((x, lower, y), (y, upper, a))
    assert (explicit(Integral(f, *limits)) - integrate(f, *limits)).expand() == 0


def test_what_is_no_polynomial_is_integrated_all_the_same() -> None:
    for f in (sin(x), exp(-x), 1 / (1 + x)):
        assert (explicit(Integral(f, (x, 0, a))) - integrate(f, (x, 0, a))).equals(0)


@pytest.mark.parametrize(
    ("integrand", "value"),
    [(r, column(1, 1, 1) * 4), (ex.Outer(r, r), ImmutableDenseMatrix([[16, 12, 12], [12, 16, 12], [12, 12, 16]]) / 3)],
)
def test_a_mass_integral_weighs_each_place_by_its_mass(integrand: Any, value: Expr) -> None:
    """A cube of side 2 and density 1/2 from its corner: mass 4, centre (1, 1, 1)."""
    limits = [Tuple(s, 0, 2) for s in (x, y, z)]
    assert explicit(ex.MassIntegral(integrand, r, Rational(1, 2), column(x, y, z), Integer(1), *limits)) == value


def test_entries_of_an_unevaluated_vector_are_those_of_its_value() -> None:
    assert ex.Cross(u, v)[0, 0] == 2 * z - 3 * y
    assert ex.MatrixAmount(u, "g", Rational(1, 1000))[2, 0] == Rational(3, 1000)
    assert ex.Outer(u, u)[1, 2] == 6


def test_matrices_become_explicit_unless_a_name_is_left() -> None:
    u, v = vector("u"), vector("v")
    assert explicit(2 * u + v) == 2 * u + v
    assert explicit(column(1, 0, 0) + column(0, 2, 0)) == column(1, 2, 0)


@pytest.mark.parametrize("number", [1.5, "1", None, 2j])
def test_only_an_exact_number_is_taken(number: object) -> None:
    assert explicit(3) == 3
    with pytest.raises(TypeError, match="is not an exact number"):
        explicit(number)


def test_only_the_outer_node_is_carried_out_where_that_is_asked_for() -> None:
    x = scalar("x")
    terms = ex.Terms(ex.Dot(column(x, 0, 0), column(2, 0, 0)), 1)
    assert terms.doit() == 2 * x + 1
    assert terms.doit(deep=False).has(ex.Dot)
