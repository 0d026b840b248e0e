"""What is read: each formula beside what it means in the grammar of the problem files."""

from __future__ import annotations

import pytest
from sympy import E, Integral, Matrix, Rational, Symbol, acos, cos, exp, log, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Bracket
from derive.algebra.kinds import dimension_of_kind
from tests.course.latex.formula import dimension, letter, read, value

a, b, h, R, r, z, l, M, m, g, t, n = (
    letter(name) for name in ["a", "b", "h", "R", "r", "z", "l", "M", "m", "g", "t", "n"]
)
theta, phi, omega, rho, S = (letter(name) for name in ["theta", "phi", "omega", "rho", "S"])
I_z, I_y = letter("I_z"), letter("I_y")
omega_x, omega_y, omega_z = symbols("omega_x omega_y omega_z", real=True)
theta_dot, theta_ddot = symbols("theta_dot theta_ddot", real=True)

SCALARS = [
    # fractions, products, powers
    (r"\frac{13}{12} M a^2", Rational(13, 12) * M * a**2),
    (r"\frac12 a^2", a**2 / 2),
    (r"\tfrac 1 2 a + \dfrac{a}{3}", a * Rational(5, 6)),
    (r"13 M a^2", 13 * M * a**2),
    (r"2(a+b)", 2 * (a + b)),
    (r"\rho\frac{54 a^{5}}{3}+\rho 8 a^5", 26 * rho * a**5),
    (r"3 \cdot 4 a \times 2", 24 * a),
    (r"a/2 + b/n", a / 2 + b / n),
    (r"-\left(-a\right) - (-b)", a + b),
    (r"{\left(a+b\right)}^{2}", (a + b) ** 2),
    (r"a^{-1} b^{\frac12} b^{1/2}", b / a),
    (r"\left[a\right]\{b\}", a * b),
    (r"{ab}^2", a * b**2),
    (r"-\frac{9}{2(6)} a", -a * Rational(3, 4)),
    (r".5a + 0.25 a", a * Rational(3, 4)),
    # roots, absolute values
    (r"\sqrt{a^2+b^2}", sqrt(a**2 + b**2)),
    (r"\sqrt2 a", sqrt(2) * a),
    (r"\sqrt[3]{8n^3}", (8 * n**3) ** Rational(1, 3)),
    (r"|\vec{a}| \cdot |\boldsymbol{b}|", abs(a) * abs(b)),
    (r"|a||n| + \left|\frac{a}{2}\right| + \lvert a \rvert", abs(a) * abs(n) + abs(a) * Rational(3, 2)),
    # functions
    (r"M a\cos\theta", M * a * cos(theta)),
    (r"\sin 2\theta", sin(2 * theta)),
    (r"\sin^2\theta", sin(theta) ** 2),
    (r"\sin ^{2} \theta \cos\theta", sin(theta) ** 2 * cos(theta)),
    (r"\sin(\theta+\phi)", sin(theta + phi)),
    (r"\cos \theta \sin \theta", cos(theta) * sin(theta)),
    (r"\cos \theta M g l", cos(theta) * M * g * l),
    (r"\sin\omega t", sin(omega * t)),
    (r"2\sin\frac{\theta}{2}", 2 * sin(theta / 2)),
    (r"\arccos(n) + \ln 2", acos(n) + log(2)),
    (r"\exp(n) e^{2n} e^n", exp(4 * n)),
    (r"\sin\theta\,(a+b)", sin(theta) * (a + b)),
    (r"\cos \left(45\left(\frac{\pi}{180}\right)\right)", sqrt(2) / 2),
    (r"\cos 45^\circ a", sqrt(2) / 2 * a),
    (r"45^{\circ} + 30{}^\circ", pi * Rational(5, 12)),
    # rates
    (r"\dot\theta^2", theta_dot**2),
    (r"\ddot{\theta}", theta_ddot),
    (r"\dot{\omega}_x \dot{\omega_x}", Symbol("omega_x_dot", real=True) ** 2),
    # letters
    (r"I_{z} S \pi", I_z * S * pi),
    (r"I_{zz} J_{11} I_{\text{disc}}", letter("I_zz") * letter("J_11") * letter("I_disc")),
    (r"r_{C,x} + r_{Cx}", 2 * letter("r_C_x")),
    (r"\omega_{0}\omega_0", letter("omega_0") ** 2),
    (r"\left(I_{y}\right)_{\text {rod }}", letter("I_y_rod")),
    (r"\mathrm{M}\mathbf{a}\vec{b}\boldsymbol{h}", M * a * b * h),
    # what only moves things apart
    (r"a\,b\!\quad\;h\ l", a * b * h * l),
    (r"\bigl(a+b\bigr) \Big[ h \Big]", (a + b) * h),
    (r"\begin{aligned} a \\ + b \end{aligned}", a + b),
    # zero fits every dimension
    (r"M(a^2-0^2) - M(0) + 0", M * a**2),
    # integrals and brackets
    (r"\int_0^h z^4 dz", h**5 / 5),
    (r"\int_0^h dz\, z^4", h**5 / 5),
    (r"\int_{z=0}^{z=h} z \mathrm{d} z", h**2 / 2),
    (r"\int_0^h \frac{z\,dz}{2} + \int_0^a \frac{dx}{3} a", h**2 / 4 + a**2 / 3),
    (r"\int_0^h\int_0^a \frac{z\,dr_{C,x}}{a} dz", h**2 / 2),
    (r"\rho \int_{0}^{a} d x \int_{0}^{2 a} d y \int_{0}^{3 a} d z\left(y^{2}+z^{2}\right)", 26 * rho * a**5),
    (r"-\rho \int_{0}^{a} x d x \int_{0}^{2 a} y d y \int_{0}^{3 a} d z", -3 * rho * a**5),
    (r"\rho\int_{0}^{h}\int_{0}^{2\pi}\int_0^{Rz/h} r^2 r\,dr\,d\theta\,dz", pi * rho * R**4 * h / 10),
    (r"\int_0^h z^{2} dz \int_{0}^{2 \pi} d\theta\left(\int_{0}^{\frac{R}{h} z} r d r\right)", pi * R**2 * h**3 / 5),
    (r"\int_0^{2\pi} \sin^2\theta d\theta + \int_0^\pi \sin 2\phi d\phi", pi),
    (r"\int_0^h z + h dz", 3 * h**2 / 2),
    (r"\int_0^h z^2 \cos\frac{z}{h} dz", h**3 * (2 * cos(1) - sin(1))),
    (r"\int_0^h dz \int_0^{z} dx \int_0^{x} y dy", h**4 / 24),
    (r"\left[\frac{z^5}{5}\right]_0^h", h**5 / 5),
    (r"\left(\frac{x^{3}}{3}\right)_{0}^{a}(2 a)", 2 * a**4 / 3),
    (r"\rho\left[\frac{\theta}{2}-\frac{1}{4} \sin (2 \theta)\right]_{0}^{2 \pi}", pi * rho),
    (r"\left.\frac{z^2}{2}\right|_0^h", h**2 / 2),
    (r"\left[a z\right]_{z=0}^{h}", a * h),
    (r"\left[\frac{\rho z^5}{5}\right]^h_0", rho * h**5 / 5),
    # vectors that come to a scalar
    (r"\{1,2,3\}\cdot\{1,2,3\} a", 14 * a),
    (r"\{a,b,0\}^2", a**2 + b**2),
    (r"\left|\begin{pmatrix} 3a \\ 4a \\ 0\end{pmatrix}\right|", 5 * abs(a)),
]  # fmt: skip


@pytest.mark.parametrize(("text", "meant"), SCALARS, ids=[text for text, _ in SCALARS])
def test_a_scalar_is_what_it_would_be_on_paper(text: str, meant: object) -> None:
    assert equal(value(text), meant)


MATRICES = [
    (r"\{a, 2a, 3a\}", Matrix([a, 2 * a, 3 * a])),
    (r"\left(a,b,h\right)", Matrix([a, b, h])),
    (r"\begin{pmatrix} a \\ b \\ h \end{pmatrix}", Matrix([a, b, h])),
    (r"\frac{\omega}{\sqrt{14}}\{1,2,3\}", Matrix([1, 2, 3]) * omega / sqrt(14)),
    (r"M\begin{bmatrix} a & 0 \\ 0 & b \\ \end{bmatrix}", Matrix([[a, 0], [0, b]]) * M),
    (r"\left(\begin{array}{ccc}I_z&0&0\\0&I_z&0\\0&0&I_y\end{array}\right)\{\omega_x,\omega_y,\omega_z\}",
     Matrix([I_z * omega_x, I_z * omega_y, I_y * omega_z])),
    (r"\{a,0,0\}\times\{0,b,0\}", Matrix([0, 0, a * b])),
    (r"\{0,0,\omega\}\times\left(\begin{array}{ccc}I_z&0&0\\0&I_z&0\\0&0&I_y\end{array}\right)\{\omega,0,\omega\}",
     Matrix([0, I_z * omega**2, 0])),
    (r"a\hat{x} - b\boldsymbol{j} + \vec{k} h", Matrix([a, -b, h])),
    (r"\frac{\{a,b,h\}}{2}-\{0,0,0\}", Matrix([a, b, h]) / 2),
    (r"\int_0^h\{z,0,a\}dz", Matrix([h**2 / 2, 0, a * h])),
]  # fmt: skip


@pytest.mark.parametrize(("text", "meant"), MATRICES, ids=[text for text, _ in MATRICES])
def test_a_vector_or_matrix_is_what_it_would_be_on_paper(text: str, meant: object) -> None:
    assert equal(value(text), meant)


# -- chains, relations, branches --------------------------------------------------------------------------------------


def test_a_chain_has_every_side_and_the_mark_before_it() -> None:
    found = read(r"\frac{26}{6} a^2 &= \frac{13}{3} a^2 \\ &\approx 4.33 a^2")
    assert [side.text for side in found.sides] == [r"\frac{26}{6} a^2", r"\frac{13}{3} a^2", "4.33 a^2"]
    assert found.marks == ("", "=", "~")


def test_a_chain_may_begin_with_its_mark() -> None:
    assert read(r"=a \\ & = 2a").marks == ("=", "=")


@pytest.mark.parametrize(
    ("mark", "read_as"),
    [("<", "<"), (">", ">"), (r"\le ", "<="), (r"\leq", "<="), (r"\ge", ">="), (r"\geq ", ">="), (r"\ne", "!=")],
)
def test_a_relation_has_two_sides_and_its_mark(mark: str, read_as: str) -> None:
    found = read(f"R{mark} a/2")
    assert found.marks == ("", read_as)
    assert [side.branches[0][0][0] for side in found.sides] == [R, a / 2]


TITLES = [
    r"U(\theta)=",
    r"U^{\prime\prime}(\theta=0) =",
    r"U'' =",
    r"\frac{\partial L}{\partial\dot\theta} =",
    r"\frac{d}{dt}\frac{\partial L}{\partial\dot\theta} &=",
    r"\frac{dU}{d\theta} =",
    r"\frac{d}{dt} L =",
]


@pytest.mark.parametrize("title", TITLES)
def test_a_left_side_that_only_names_the_answer_is_passed_over(title: str) -> None:
    found = read(f"{title} M a^2 = M b^2")
    assert (len(found.sides), found.marks) == (2, ("=", "="))


@pytest.mark.parametrize("product", ["n(a+b)", "n(2)a", "(a)", "2(a)", "a(n n)"])
def test_a_left_side_that_could_be_a_product_is_a_side(product: str) -> None:
    assert len(read(f"{product} = b").sides) == 2


def test_the_place_of_a_side_is_where_it_stands() -> None:
    second = read(r"a = \frac{b}{2}").sides[1]
    assert (second.place.column, second.place.width) == (5, 11)


def test_plus_and_minus_are_two_branches_that_go_together() -> None:
    text = r"a \pm b \mp h"
    assert [value(text, 0), value(text, 1)] == [a + b - h, a - b + h]


def test_a_value_or_another_are_two_branches() -> None:
    text = r"939.47 \quad\text{or}\quad 15.13"
    assert [value(text, 0), value(text, 1)] == [Rational(93947, 100), Rational(1513, 100)]


def test_only_the_side_that_has_a_sign_of_both_kinds_has_branches() -> None:
    assert [len(side.branches) for side in read(r"a \pm b = b").sides] == [2, 1]


# -- nodes and dimensions ---------------------------------------------------------------------------------------------


def test_an_integral_and_a_bracket_are_kept_as_they_are_written() -> None:
    ((integral, _),) = read(r"\int_0^h z^4 dz").sides[0].branches[0]
    assert integral.args[0] == integral.args[0].func(*integral.args[0].args) and isinstance(integral.args[0], Integral)
    ((bracket, _),) = read(r"\left[z^2\right]_0^h").sides[0].branches[0]
    assert isinstance(bracket, Bracket)
    assert bracket.args[2:] == (0, h)


def test_an_integral_over_a_disc_is_read_and_taken_once_the_radius_is_known_to_be_positive() -> None:
    text = r"\int_{-R}^{R} dy \int_{-\sqrt{R^2-y^2}}^{\sqrt{R^2-y^2}} x^2 dx"
    ((integral, _),) = read(text).sides[0].branches[0]
    positive = Symbol("R", positive=True)
    assert equal(integral.xreplace({R: positive}), pi * positive**4 / 4)


def test_the_letter_of_a_bracket_or_an_integral_is_its_own() -> None:
    """What a step found for z must not be put in for the variable of an integral."""
    ((integral, _),) = read(r"\int_0^h z^4 dz").sides[0].branches[0]
    assert z not in integral.free_symbols


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (r"M a^2 \dot\theta", "angular momentum"),
        (r"\int_0^h \rho a^2 z^2 dz", "moment of inertia"),
        (r"\ddot{\theta}", "angular acceleration"),
        (r"\dot{x}", "speed"),
        (r"\sqrt{g l}", "speed"),
        (r"\left[\rho a x^2\right]_{x=0}^{a} h^2", "moment of inertia"),
        (r"0 - M a^2", "moment of inertia"),
        (r"45^\circ", "angle"),
    ],
)
def test_the_dimension_comes_with_the_value(text: str, kind: str) -> None:
    found = dimension(text)
    assert found == dimension_of_kind(kind) or (text.startswith(r"\left[") and found is not None)


def test_e_is_a_number_only_with_a_power() -> None:
    assert value("e^1") == E
