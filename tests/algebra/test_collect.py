"""How lines about a motion are written: another form of the same value, the highest rates first."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Abs, Add, Expr, Mul, Rational, Symbol, cos, expand, pi, sin, symbols

from derive.algebra.collect import (
    by_accelerations,
    by_products,
    by_rates,
    by_terms,
    spread,
    spread_or_by_terms,
    with_constants_together,
    with_differences_of_coordinates,
    with_weights_in_front,
)
from derive.algebra.equality import equal
from derive.algebra.expressions import rate

M, a, I = symbols("M a I", positive=True)
q, w_x, w_y, w_z = symbols("q w_x w_y w_z", real=True)
p, p_dot, p_ddot = q, rate(q), rate(q, 2)


def test_accelerations_stand_first_each_with_one_factor() -> None:
    value = M * a * sin(q) + M * a**2 * p_ddot + I * p_ddot + M * p_dot**2
    written = by_accelerations(value, [q])
    assert equal(written, value)
    assert written.coeff(p_ddot) == I + M * a**2
    assert len(Add.make_args(written)) == 3


def test_the_coefficient_of_one_term_stands_before_all_terms() -> None:
    value = -M * a**2 * p_ddot * cos(q) / 2 - M * a**2 * p_dot**2 * sin(q)
    written = by_accelerations(value, [q])
    assert written.args[-1] == p_ddot * cos(q) + 2 * p_dot**2 * sin(q)
    assert equal(written, value)
    assert by_accelerations(M * a**2 * p_ddot + I * a * sin(q), [q]).is_Add


def test_half_of_a_mass_stands_before_its_squared_rate() -> None:
    value = I * p_dot**2 / 2 + M * a**2 * p_dot**2 / 8
    written = by_rates(value, [q], halves=True)
    assert set(written.args) == {Rational(1, 2), I + M * a**2 / 4, p_dot**2}
    assert equal(written, value)


@pytest.mark.parametrize(("halves", "before"), [(False, ()), (True, (Rational(1, 2), M))])
def test_one_term_of_a_coefficient_has_no_denominator(halves: bool, before: tuple[Expr, ...]) -> None:
    value = Mul(*before) * (a**2 * p_dot**2 + I**2 * p_dot**2 / (4 * pi**2))  # a helix of radius a and pitch I
    written = by_rates(value, [q], halves=halves)
    assert set(written.args) == {*before, a**2 + I**2 / (4 * pi**2), p_dot**2}


@pytest.mark.parametrize("value", [p_dot - p_dot, M * a - a * M])
def test_nothing_stays_nothing_however_it_is_written(value: Expr) -> None:
    assert by_rates(value, [q]) == 0
    assert by_products(value, [q]) == 0


@pytest.mark.parametrize("value", [1 / p_dot, sin(p_dot) + p_dot, M * p_dot ** Rational(1, 2), M / (1 + p_dot)])
def test_what_is_no_polynomial_in_the_rates_is_only_tidied(value: Expr) -> None:
    for written in (by_rates(value, [q]), by_products(value, [q])):
        assert equal(written, value)


def test_a_difference_before_a_product_is_subtracted() -> None:
    I_x, I_y, I_z = symbols("I_x I_y I_z", positive=True)
    value = I_x * rate(w_x) - I_y * w_y * w_z + I_z * w_y * w_z
    written = by_products(value, [w_x, w_y, w_z])
    assert -w_y * w_z * (I_y - I_z) in Add.make_args(written)
    assert equal(written, value)


@pytest.mark.parametrize(
    ("value", "written"),
    [
        ((4 * I + M * a**2) / 4, I + M * a**2 / 4),
        ((I + M * a**2) / 4, (I + M * a**2) / 4),
        (3 * I * (4 * I + M) / 4, 3 * I * (I + M / 4)),
        (M * a / 3, M * a / 3),
    ],
)
def test_a_number_below_a_sum_is_put_in_where_that_makes_a_term_simpler(value: Expr, written: Expr) -> None:
    assert spread(value) == written


def test_a_sum_keeps_its_terms_and_a_power_below_is_written_as_one() -> None:
    assert by_terms(M + a / 2) == M + a / 2
    assert str(by_terms(M / (a**2 + 2 * a * I + I**2))) == "M/(I + a)**2"


@pytest.mark.parametrize(
    ("value", "others"),
    [(M / a + I / a, ()), (expand((M + a) * (I + a)), ()), (M / sin(q) + I * cos(q) / sin(q), (M / sin(q),))],
)
def test_the_shortest_form_or_the_one_that_was_offered_has_the_same_value(value: Expr, others: Any) -> None:
    written = spread_or_by_terms(value, *others)
    if others:
        assert written == others[0], "with angles below, what the verb offers is taken"
    else:
        assert equal(written, value)
        assert written.count_ops() <= value.count_ops()


def test_a_kinetic_energy_has_its_mass_in_front() -> None:
    """Taylor, Classical Mechanics, 8.2: (1/2) m (r_dot^2 + r^2 phi_dot^2)."""
    m, r, phi = symbols("m r phi", positive=True)
    v, w = rate(r), rate(phi)
    found = with_weights_in_front(m * v**2 / 2 + m * r**2 * w**2 / 2, [r, phi], {m})
    assert found.args == Mul(Rational(1, 2), m, v**2 + r**2 * w**2, evaluate=False).args


def test_terms_of_one_constant_stand_together_and_others_stay() -> None:
    m, n, x, y, z = symbols("m n x y z", positive=True)
    value = m * rate(x) ** 2 / 2 + m * rate(y) ** 2 / 2 + n * rate(z) ** 2 / 2
    found = with_weights_in_front(value, [x, y, z], {m, n})
    assert len(found.args) == 2 and (found - value).expand() == 0
    assert with_weights_in_front(n * rate(z) ** 2 / 2, [z], {n}) == n * rate(z) ** 2 / 2


def test_terms_without_a_constant_are_added_up() -> None:
    m, x, y = symbols("m x y", positive=True)
    value = m * rate(x) * rate(y) + rate(x) ** 2 / 2 + rate(y) ** 2 / 2
    assert (with_weights_in_front(value, [x, y], {m}) - value).expand() == 0


def test_the_pull_of_a_spring_along_a_line_has_its_direction_as_a_factor() -> None:
    k, l, d = symbols("k l d", positive=True)
    x = symbols("x", real=True)
    value = (k * (Abs(x - d) - l) * (x - d) / Abs(x - d)).expand()
    assert set(by_rates(value, [x]).args) == {k * (x - d), k * l * (d - x) / Abs(x - d)}


def test_masses_before_one_function_of_an_angle_are_added_up() -> None:
    m, n, g, l, q = symbols("m n g l q", positive=True)
    value = -2 * m * g * l * cos(q) - 2 * n * g * l * cos(q)
    found = with_constants_together(value, [q])
    assert found == -2 * g * l * (m + n) * cos(q)


def test_terms_with_a_coordinate_below_stand_apart() -> None:
    l, m, k, r = symbols("l m k r", positive=True)
    assert by_rates(l**2 / (m * r**3) - k / r**2, [r]) == l**2 / (m * r**3) - k / r**2


def test_a_coordinate_stands_with_the_constant_from_which_it_is_counted() -> None:
    """The force of a spring of natural length l, Taylor, section 5.1."""
    y, y_dot, y_ddot = (Symbol(name, real=True) for name in ("y", "y_dot", "y_ddot"))
    k, l, m, g = symbols("k l m g", positive=True)
    found = by_accelerations(m * y_ddot + k * y - m * g - k * l, [y])
    assert k * Add(y, -l) in found.args
    assert str(by_rates(m * g + k * l - k * y, [y])) == "g*m - k*(-l + y)"
    assert by_rates(m * y_dot**2 / 2 - k * y, [y]) == m * y_dot**2 / 2 - k * y


def test_a_spring_between_two_bodies_depends_on_the_difference_of_their_coordinates() -> None:
    x, y, x_ddot = (Symbol(name, real=True) for name in ("x", "y", "x_ddot"))
    m, k, s, g, l = symbols("m k s g l", positive=True)
    assert Mul(s, x - y, evaluate=False) in by_accelerations(m * x_ddot + k * x + s * (x - y), [x, y]).args
    pendulums = (m * g + k * l) * x - k * l * y
    assert set(with_differences_of_coordinates(pendulums, [x, y]).args) == {m * g * x, k * l * (x - y)}
    assert with_differences_of_coordinates(k * (2 * x - y), [x, y]) == k * (2 * x - y)


def test_a_number_below_a_sum_stays_where_no_term_is_left_without_one() -> None:
    g, l, w, I, M = symbols("g l omega I M", positive=True)
    assert str(spread((3 * g - 2 * l * w**2) / 6)) == str((3 * g - 2 * l * w**2) / 6)
    assert str(spread((4 * I + M * l**2) / 4)) == str(I + M * l**2 / 4)
