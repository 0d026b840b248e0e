"""Formulas as expressions: what is written is read, and what has several readings is chosen by the whole document."""

from __future__ import annotations

import pytest

from tests.documents.reading import audit, values

READ = {
    "the rate of a letter with a subscript": ("\\dot{x}_1^2 = \\dot{x_1}{}^2", "x_1.**2", "x_1.**2"),
    "a fraction of single digits": ("\\frac12 m v^2 = T", "m*v**2/2", "T"),
    "degrees": ("\\sin 30^\\circ = \\frac{1}{2}", "1/2", "1/2"),
    "a mixed argument of a sine": ("y = A\\sin 2\\theta \\cos\\theta", "y", "A*sin(2*theta)*cos(theta)"),
    "an angle before other letters": ("V = m g \\cos\\theta l", "V", "g*l*m*cos(theta)"),
    "a power of a function": ("\\sin^2 x = s", "sin(x)**2", "s"),
    "an inverse function": ("\\theta = \\tan^{-1} x", "theta", "atan(x)"),
    "a double integral": ("I = \\int_0^a dx \\int_0^b dy\\, y^2", "I", "a*b**3/3"),
    "an integral with its differential at the end": (
        "I = \\int_0^{2\\pi}\\int_0^R r^2\\, r\\, dr\\, d\\theta",
        "I",
        "pi*R**4/2",
    ),
    "an integral of a sum without brackets": ("I = \\int_0^a 1 + x \\, dx", "I", "a**2/2 + a"),
    "a differential in a numerator": ("I = \\int_1^a \\frac{dx}{x}", "I", "log(a)"),
    "a bracket with limits": ("I = \\left[\\frac{x^2}{2}\\right]_0^a", "I", "a**2/2"),
    "a triple and a scalar product": ("s = (1, 2, 3) \\cdot (a, b, d)", "s", "a + 2*b + 3*d"),
    "a determinant": ("\\begin{vmatrix} a & b \\\\ d & e \\end{vmatrix} = D", "a*e - b*d", "D"),
    "a sum over an index": ("s = \\sum_{i=1}^{3} m_i", "s", "m_1 + m_2 + m_3"),
    "a Unicode formula": ("T = ½ ω²".replace("½", "\\frac12"), "T", "omega**2/2"),
    "two signs": ("x = a \\pm b", "x", "a + b*±"),
    "a label in words": ("T_{\\text{max}} = T_{m a x}", "T_max", "T_max"),
    "an old fraction": ("{a \\over 2} = h", "a/2", "h"),
    "the package physics": ("\\dv{x}{t} = \\abs{y}", "x.", "Abs(y)"),
    "a fraction with a slash": ("k = 1/2 m", "k", "m/2"),
    "the root of a number before a slash": ("k = \\sqrt{42}/28 m", "k", "sqrt(42)*m/28"),
    "a derivative with a slash": ("\\partial f/\\partial x = k", "df/dx", "k"),
    "an operator with a subscript": ("\\partial_x (x^2 y) = k", "2*x*y", "k"),
    "a total derivative with a slash": ("d(x^2)/dx = k".replace("d(x^2)", "dx"), "1", "k"),
    "a square of the package physics": ("\\sin[2](a) = k", "sin(a)**2", "k"),
    "words of the package physics": ("\\qq{so} a = b", "a", "b"),
    "a derivative that many authors define": ("\\pdiff{f}{x} = k", "df/dx", "k"),
    "a matrix of the package physics": ("\\vec w = \\mqty(a \\\\ b)", "Matrix([[w_1], [w_2]])", "Matrix([[a], [b]])"),
    "a gradient": ("\\vec F = -\\nabla(x y)", "Matrix([[F_1], [F_2], [F_3]])", "Matrix([[-y], [-x], [0]])"),
    "a divergence": ("\\nabla \\cdot (x, y, z) = k", "3", "k"),
    "a Laplacian": ("\\nabla^2 (x^2 + y^2) = k", "4", "k"),
    "an average": ("\\langle q \\rangle = k", "<q>", "k"),
    "an average with a macro": ("\\braket{q} = k", "<q>", "k"),
    "the imaginary unit": ("\\I^2 = k", "-1", "k"),
    "a relation with a note": ("a \\stackrel{(1)}{=} b", "a", "b"),
    "a frame around an equation": ("\\underline{a = b}", "a", "b"),
    "per cent": ("p = 85\\%", "p", "17/20"),
    "a factorial before a sign": ("1/3! = k", "1/6", "k"),
    "an index above": ("x_\\nu x^\\nu = k", "x^nu*x_nu", "k"),
    "a range behind an equation": ("q_i = p_i/m \\quad (i = 1, 2, \\ldots, n)", "q_i", "p_i/m"),
    "arguments that are left out": ("Y(y_1, \\ldots, y_n) = k", "Y", "k"),
    "a unit of siunitx": ("v = \\SI{3}{\\kilo\\metre\\per\\second}", "v", "3000"),
    "a unit": ("v = 3\\,\\mathrm{km}", "v", "3000"),
}


@pytest.mark.parametrize(("latex", "left", "right"), list(READ.values()), ids=list(READ))
def test_a_formula_is_read(latex: str, left: str, right: str) -> None:
    ((found_left, found_right),) = values(f"$$ {latex} $$")
    assert found_left == left
    assert found_right.replace("**1.0", "") == right or sorted(found_right.split(" + ")) == sorted(right.split(" + "))


def test_a_function_of_time_is_not_a_product() -> None:
    text = "Let $x(t)$ be the position, with $x(0) = a$. Then $v(t) = \\dot x(t)$, $a(t) = \\frac{v(t) - v(t-h)}{h}$."
    found = dict(values(text))
    assert found["x(0)"] == "a" and found["a"] == "(v - v(-h + t))/h"


def test_a_letter_before_a_bracket_is_a_factor_if_it_is_never_a_function() -> None:
    assert values("$p = m(v + u)$, $m = 2$") == [("p", "m*(u + v)"), ("m", "2")]


def test_the_rate_of_a_product_follows_the_chain_rule() -> None:
    assert values("$\\frac{d}{dt}(m r^2\\dot\\phi) = 0$ and $\\dot r = 0$")[0][0] == "2*m*phi.*r*r. + m*phi..*r**2"


def test_a_vector_differs_from_its_magnitude() -> None:
    (claim,) = audit("$\\vec a - a = 0$").claims
    assert claim.verdict is not None and str(claim.verdict.outcome) not in ("holds", "differs")


def test_a_letter_with_its_own_list_is_a_vector_and_a_length() -> None:
    (claim,) = audit("The centre is at $a = \\{\\frac12 a, a, 2 a\\}$.").claims
    assert claim.values is not None and str(claim.values[0]) == "Matrix([[a_1], [a_2], [a_3]])"


@pytest.mark.parametrize(
    "text", ["(" * 5000 + "x" + ")" * 5000, "\\frac{" * 3000, "x^" * 4000, "\\left(" * 2000 + "y", "9" * 9999]
)
def test_hostile_formulas_are_unreadable_and_not_fatal(text: str) -> None:
    for claim in audit(f"$$ {text} = 1 $$").claims:
        assert claim.verdict is not None and str(claim.verdict.outcome) in ("unreadable", "undecided", "defines")


@pytest.mark.parametrize(
    "latex",
    [
        "\\sum_{i=1}^N \\frac12 m_i v_i^2 = \\frac12 \\sum_j m_j v_j^2",
        "\\sum_i m_i (\\alpha + q_i) = \\alpha \\sum_i m_i + \\sum_k m_k q_k",
        "\\frac{\\partial}{\\partial v_k} \\sum_i \\frac12 m_i v_i^2 = m_k v_k",
        "\\frac{d}{dt} \\sum_i \\frac12 m_i \\dot x_i^2 = \\sum_i m_i \\dot x_i \\ddot x_i",
        "\\sum_{i,j} a_i b_j = \\sum_i a_i \\sum_j b_j",
    ],
)
def test_a_sum_over_an_index_is_compared_term_by_term(latex: str) -> None:
    (claim,) = audit(f"$$ {latex} $$").claims
    assert claim.verdict is not None and str(claim.verdict.outcome) == "holds"


def test_different_sums_are_not_equal() -> None:
    (claim,) = audit("$$ \\sum_i m_i v_i^2 = \\sum_i m_i v_i $$").claims
    assert claim.verdict is not None and str(claim.verdict.outcome) != "holds"


def test_every_row_of_cases_is_read() -> None:
    (claim,) = audit("$$ F = \\begin{cases} k x & x > 0 \\\\ 0 & \\text{otherwise} \\end{cases} $$").claims
    assert claim.verdict is not None and str(claim.verdict.outcome) == "defines"


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("a = 15 \\text{ rad/s}^2", ("a", "15")),
        ("v = -30 b \\text{ in/s}", ("v", "-381*b/500")),
        ("a = g/l \\sin\\theta", ("a", "g*sin(theta)/l")),
        ("a = b^2 sin^2(c t) + cos \\theta", ("a", "b**2*sin(c*t)**2 + cos(theta)")),
        ("\\sum F_x = m a", ("sum F_x", "a*m")),
        ("b = a\\Bigl(c + \\sin\\theta\\Bigr)\\notag", ("b", "a*(c + sin(theta))")),
        ("\\sin(arccos(x)) = b", ("sqrt(1 - x**2)", "b")),
        ("x = 0{,}25 b \\qedhere", ("x", "b/4")),
        ("a = || \\mathbf v || b", ("a", "b*sqrt(v_1**2 + v_2**2 + v_3**2)")),
        ("f = \\left( {a + b} \\over c \\right)", ("f", "(a + b)/c")),
        ("\\frac{\\partial g_{\\mu\\nu}(x)}{\\partial x^\\rho} = 0", ("dg_munu/dx^rho", "0")),
        ("x = \\vectorbold{v} \\cdot \\vectorunit{x}", ("x", "v_1")),
        ("\\left\\{\\begin{align} F - N &= m a & (1) \\\\ N &= 0 \\end{align}\\right.", ("F - N", "a*m")),
    ],
)
def test_notations_of_worked_solutions_are_read(written: str, read: tuple[str, str]) -> None:
    assert values(f"$${written}$$")[0] == read


def test_a_document_that_prints_vectors_in_another_way_still_has_vectors() -> None:
    text = "\\renewcommand{\\vec}[1]{\\mbox{\\boldmath$#1$}} Let $\\vec F = m \\vec a$."
    assert values(text)[0][1] == "Matrix([[a_1*m], [a_2*m], [a_3*m]])"
