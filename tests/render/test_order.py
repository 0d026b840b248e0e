"""Terms and factors have the order of a textbook, and the order does not change a value."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Symbol, cos, exp, pi, sin, sqrt, symbols, tan

from derive.algebra.expressions import PLUS_MINUS, TIME, rate
from derive.algebra.kinds import dimension_of_kind
from derive.render.notation.notation import Notation
from derive.render.notation.order import motion_first, ordered_factors, plain_first
from derive.render.notation.text import plain

m, M, k, b = symbols("m M k b", positive=True)
l, R, a, g = symbols("l R a g", positive=True)
theta, phi, beta = symbols("theta phi beta", real=True)
omega, omega_0 = symbols("omega omega_0", positive=True)
KINDS = {
    **dict.fromkeys((m, M), "mass"),
    k: "spring constant",
    b: "damping constant",
    **dict.fromkeys((l, R, a), "length"),
    g: "acceleration",
    **dict.fromkeys((theta, phi, beta), "angle"),
    **dict.fromkeys((rate(theta), rate(phi), rate(beta), omega, omega_0), "angular speed"),
    rate(l): "speed",
    Symbol("mu"): "number",
    Symbol("e"): "number",
    Symbol("N"): "force",
}
NOTATION = Notation({letter: dimension_of_kind(kind) for letter, kind in KINDS.items()})

READS = [
    (Symbol("N") * Symbol("mu") * a, "μ a N"),
    (m * g * Symbol("mu"), "μ m g"),
    (m * g * beta, "m g β"),  # a coordinate with the name of a coefficient
    (-rate(l) * Symbol("e"), "-e l̇"),
    (m - M * Symbol("e"), "m - e M"),
    (Symbol("e") + 1, "1 + e"),
    (1 - Symbol("e") ** 2, "1 - e²"),
    (Symbol("e") ** 2 - 1, "e² - 1"),
    (PLUS_MINUS * sqrt(k / m) - b / m, "-b/m ± √(k/m)"),
    (cos(theta) + 1, "1 + cos θ"),
    (sqrt(2) + 2, "2 + √2"),
    (2 - sqrt(2), "2 - √2"),
    (3 * cos(theta) - 2, "3cos θ - 2"),
    (tan(theta) ** 2 + 4, "4 + tan² θ"),
    (m * g / k + l, "l + m g/k"),
    (R**2 - 2 * R * a * cos(phi) + a**2, "R² + a² - 2R a cos φ"),
    (a + R * cos(theta), "a + R cos θ"),
    (m * l**2 * (rate(theta) ** 2 / 2 + rate(phi) ** 2), "m l² (1/2 (θ̇)² + (φ̇)²)"),
    (m * g * cos(theta) + m * R * rate(theta) ** 2, "m R (θ̇)² + m g cos θ"),
    (g * (M + m) / l, "(M + m) g/l"),
    (m * rate(l) * l * rate(theta), "m l l̇ θ̇"),
    (2 * rate(l) * sqrt(k * m), "2√(k m) l̇"),
    (k * sqrt(l / g) / m, "k/m √(l/g)"),
    (m * g * cos(sqrt(k / m) * TIME) / k, "m g/k cos(√(k/m) t)"),
    (l * exp(-b * TIME / m) * (cos(TIME) + 1), "l e^(-bt/m) (1 + cos t)"),
    (l * exp(-b * TIME / m) * (a + R), "(R + a) l e^(-bt/m)"),  # l is a coordinate
    (R * sin(omega * TIME) / omega_0, "R/ω_0 sin(ω t)"),
    (R * (1 - cos(omega * TIME)) / omega, "R/ω (1 - cos(ω t))"),
    (m * cos(phi) * sin(theta) * cos(theta), "m sin θ cos θ cos φ"),
    (-a + b + m, "b + m - a"),
    (l * (k - m * omega**2), "(k - m ω²) l"),
    (m * omega**2 * (l**2 + a**2), "m ω² (a² + l²)"),
    (m * R**2 * omega**2 * (1 - cos(theta)), "m R² ω² (1 - cos θ)"),
    (k - b * omega + m * omega**2, "m ω² - b ω + k"),
    (2 * omega * omega_0, "2ω_0 ω"),
    (sin(theta) ** 2 * rate(phi) ** 2 + rate(theta) ** 2, "(θ̇)² + (φ̇)² sin² θ"),
    (-m * a * sqrt(1 - rate(l) ** 2) - k * l**2, "-m a √(1 - (l̇)²) - k l²"),
    (m * rate(phi, 2) - k * theta + (M + k) * phi, "m φ̈ + (M + k) φ - k θ"),
    (m * (1 + Symbol("e")) * a, "(1 + e) m a"),
    (m + M * Symbol("e") ** 2, "m + e² M"),
    (pi * a**2 * 4 / 3, "4/3 π a²"),
    (4 * a / (3 * pi), "4a/(3π)"),
    (2 * pi / 3 * sqrt(6) * sqrt(l / g), "2π √(2l/(3g))"),
]


@pytest.mark.parametrize(("expr", "reads"), READS, ids=[reads for _, reads in READS])
def test_a_formula_has_the_order_of_a_textbook(expr: Any, reads: str) -> None:
    assert plain(NOTATION.layout(expr)) == reads


def test_terms_of_a_motion_follow_the_order_of_its_coordinates() -> None:
    places = {"theta": 0, "phi": 1, "theta_dot": 2}
    T = [rate(phi) ** 2, rate(theta) * rate(phi), rate(theta) ** 2]
    assert motion_first(T, places) == T[::-1]
    equation = [m * g, k * theta, rate(phi) ** 2, b * rate(theta), rate(phi, 2), rate(theta, 2)]
    assert motion_first(equation, places) == [
        rate(theta, 2),
        rate(phi, 2),
        b * rate(theta),
        rate(phi) ** 2,
        k * theta,
        m * g,
    ]
    assert motion_first([m, k], {}) == [m, k]


def test_fractions_stand_behind_letters_and_functions_last() -> None:
    assert plain_first([sin(theta), 1 / l, l, sqrt(a)]) == [l, sqrt(a), 1 / l, sin(theta)]


def test_rates_stand_behind_all_that_is_constant() -> None:
    factors = [rate(theta), cos(theta), sqrt(k), l, M + m, m, Symbol("unknown")]
    ordered = ordered_factors(factors, NOTATION.known_dimensions.get)
    assert ordered == [m, M + m, l, Symbol("unknown"), sqrt(k), rate(theta), cos(theta)]


def test_components_of_an_angular_velocity_stand_in_cyclic_order() -> None:
    x, y, z, r_x, r_z, I_xz = symbols("omega_x omega_y omega_z r_x r_z I_xz", real=True)
    kinds = {**dict.fromkeys((x, y, z), "angular speed"), **dict.fromkeys((r_x, r_z), "length")}
    turning = Notation({letter: dimension_of_kind(kind) for letter, kind in kinds.items()})
    read = [plain(turning.layout(product)) for product in (x * y, y * z, z * x, x * y * z, r_x * r_z, I_xz * x * z)]
    assert read == ["ω_x ω_y", "ω_y ω_z", "ω_z ω_x", "ω_x ω_y ω_z", "r_x r_z", "I_xz ω_x ω_z"]


def test_velocities_stand_before_angular_velocities() -> None:
    kinds = {"phi": "angle", "phi_dot": "angular speed", "x": "length", "x_dot": "velocity"}
    moving = Notation({Symbol(name, real=True): dimension_of_kind(kind) for name, kind in kinds.items()})
    assert plain(moving.layout(Symbol("phi_dot", real=True) * Symbol("x_dot", real=True))) == "x\u0307 \u03c6\u0307"
