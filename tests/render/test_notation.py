"""Tests of the layout of formulas: their values do not change, and formulas look as in a textbook."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    Mul,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    exp,
    eye,
    log,
    oo,
    pi,
    sin,
    sqrt,
    symbols,
    tan,
    zoo,
)

from derive.algebra import expressions as ex
from derive.algebra.equality import equal
from derive.algebra.expansion import Approach
from derive.algebra.expressions import explicit
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.rounding import rounded_form
from derive.errors import Rejected
from derive.render.notation import layout as on_paper
from derive.render.notation.latex import escaped, latex
from derive.render.notation.layout import GREEK_LETTERS, Name, layout_of_name
from derive.render.notation.notation import Notation
from derive.render.notation.products import present
from derive.render.notation.text import plain
from tests.mechanics.block import M, a, b, c, known_block, omega

x, y, theta, theta_dot = symbols("x y theta theta_dot", real=True)
rho, g, v, k = symbols("rho g v k", positive=True)
KINDS = {
    a: "length",
    b: "length",
    c: "length",
    M: "mass",
    omega: "angular speed",
    theta_dot: "angular speed",
    rho: "density",
    g: "acceleration",
    v: "speed",
    theta: "angle",
}
NOTATION = Notation({symbol: dimension_of_kind(kind) for symbol, kind in KINDS.items()})
w, L, I = ex.vector("omega"), ex.vector("L"), ex.tensor("I")


def tex(expr: Any) -> str:
    return latex(NOTATION.result(expr))


def text(expr: Any) -> str:
    return plain(NOTATION.result(expr))


# --- one by one ---

PINNED = [
    # numbers before symbols, masses before lengths before rates
    (Rational(13, 12) * M * a**2, r"\frac{13}{12}\,Ma^{2}", "13/12 M a²"),
    (-M * a**2 / 4, r"-\frac{1}{4}\,Ma^{2}", "-1/4 M a²"),
    (omega**2 * a**2 * M * Rational(7, 24), r"\frac{7}{24}\,Ma^{2}\omega^{2}", "7/24 M a² ω²"),
    (3 * a, "3a", "3a"),
    (M * g * a, "Mga", "M g a"),
    (2 * pi * a, r"2\pi a", "2π a"),
    (M * (b**2 + c**2) / 12, r"\frac{1}{12}\,M\,(b^{2}+c^{2})", "1/12 M (b² + c²)"),
    # roots: 1/sqrt(14) before vectors, sqrt(42)/28 unchanged
    (omega / sqrt(14), r"\frac{\omega}{\sqrt{14}}", "ω/√14"),
    (M * a**2 * omega / (12 * sqrt(14)), r"\frac{Ma^{2}\omega}{12\sqrt{14}}", "M a² ω/(12√14)"),
    (sqrt(42) / 28 * M * a**2 * omega**2, r"\frac{\sqrt{42}}{28}\,Ma^{2}\omega^{2}", "√42/28 M a² ω²"),
    (sqrt(a**2 + b**2), r"\sqrt{a^{2}+b^{2}}", "√(a² + b²)"),
    (a / 4 + sqrt(a**2 + b**2) / 4, r"\frac{a+\sqrt{a^{2}+b^{2}}}{4}", "(a + √(a² + b²))/4"),
    (-a / 2 - sqrt(a**2 + b**2), r"-\frac{a}{2}-\sqrt{a^{2}+b^{2}}", "-a/2 - √(a² + b²)"),
    (10 * sqrt(3) / 9 - sqrt(30) / 9, r"\frac{10\sqrt{3}-\sqrt{30}}{9}", "(10√3 - √30)/9"),
    (2 * sqrt(7) / 3 - Rational(1, 3), r"\frac{2\sqrt{7}-1}{3}", "(2√7 - 1)/3"),
    (a / 4 + b / 4, r"\frac{a}{4}+\frac{b}{4}", "a/4 + b/4"),
    (a ** Rational(3, 2), r"a^{3/2}", "a^(3/2)"),
    (
        2 * sqrt(6) * pi * (a**2 + b**2) ** Rational(1, 4) / (3 * sqrt(g)),
        r"2\pi\sqrt{\frac{2\sqrt{a^{2}+b^{2}}}{3g}}",
        "2π √(2√(a² + b²)/(3g))",
    ),
    # signs
    (c**2 - a**2, "c^{2}-a^{2}", "c² - a²"),
    (-a - b, "-a-b", "-a - b"),
    (Rational(-1, 2), r"-\frac{1}{2}", "-1/2"),
    ((x - 1) / (x + 1), r"\frac{x-1}{x+1}", "(x - 1)/(x + 1)"),
    (1 / (a + b), r"\frac{1}{a+b}", "1/(a + b)"),
    (1 / (a * b), r"\frac{1}{ab}", "1/(a b)"),
    # functions
    (cos(theta), r"\cos \theta", "cos θ"),
    (cos(2 * theta), r"\cos(2\theta)", "cos(2θ)"),
    (sin(theta) ** 2, r"\sin^{2}\theta", "sin² θ"),
    (acos(x), r"\arccos x", "arccos x"),
    (log(x), r"\ln x", "ln x"),
    (abs(x), r"\lvert x\rvert ", "|x|"),
    # names
    (Symbol("omega_x"), r"\omega_{x}", "ω_x"),
    (Symbol("J_xy"), "J_{xy}", "J_xy"),
    (Symbol("T_max"), r"T_{\mathrm{max}}", "T_max"),
    (Symbol("alpha_beta"), r"\alpha_{\beta}", "α_β"),
    (theta_dot, r"\dot{\theta}", "θ̇"),
    (Symbol("theta_ddot"), r"\ddot{\theta}", "θ̈"),
    (Symbol("l_0_dot"), r"\dot{l}_{0}", "l̇_0"),
    (w, r"\bm{\omega}", "ω⃗"),
    (I, r"\mathbf{I}", "I⃡"),
    # vectors
    (ex.Dot(w, ex.applied(I, w)), r"\bm{\omega}\cdot \mathbf{I}\bm{\omega}", "ω⃗·I⃡ ω⃗"),
    (ex.Cross(w, L), r"\bm{\omega}\times \bm{L}", "ω⃗ × L⃗"),
    (ex.Norm(L), r"\lvert \bm{L}\rvert ", "|L⃗|"),
    (ex.CarriedRate(L, w), r"\frac{d\bm{L}}{dt}", "dL⃗/dt"),
    (ex.column(0, 0, 0), r"\bm{0}", "0"),
    # as written
    (ex.At(ex.At(M, a, Integer(0)), v, Integer(0)), r"\left.M\right|_{a=v=0}", "M|(a = v = 0)"),
    (ex.At(ex.At(M, a, Integer(0)), v, Integer(1)), r"\left.M\right|_{a=0,\ v=1}", "M|(a = 0, v = 1)"),
    (ex.Factors(a, 3 * a), r"a\cdot 3a", "a·3a"),
    (ex.Terms(8 * a, 18 * a), "8a+18a", "8a + 18a"),
    (ex.Ratio(M, ex.Factors(a, 2 * a, 3 * a)), r"\frac{M}{a\cdot 2a\cdot 3a}", "M/(a·2a·3a)"),
    (ex.Factors(Rational(13, 3), ex.Group(6 * a**3), a**2), r"\frac{13}{3}\,(6a^{3})\,a^{2}", "13/3 (6a³) a²"),
    (Integral(x**2, (x, 0, a)), r"\int_{0}^{a} x^{2}\,dx", "∫(0..a) x² dx"),
    (Integral(x**2, (x, 0, y), (y, 0, a)), r"\int_{0}^{a} \int_{0}^{y} x^{2}\,dx\,dy", "∫(0..a) ∫(0..y) x² dx dy"),
    # numbers
    (rounded_form(acos(7 * sqrt(2779) / 397) * 180 / pi, 4), "21.64", "21.64"),
    (rounded_form(Rational(65, 100000), 3), r"6.50\times 10^{-4}", "6.50×10⁻⁴"),
    (ex.Amount(Rational(3, 2), "1/s^2", Integer(1)), r"1.5\,\mathrm{s^{-2}}", "1.5 s^-2"),
    (ex.Amount(Integer(5), "1/s", Integer(1)), r"5\,\mathrm{s^{-1}}", "5 s^-1"),
    (ex.Amount(Rational(3, 2), "kg m^2", Integer(1)), r"1.5\,\mathrm{kg\,m^{2}}", "1.5 kg m^2"),
]


@pytest.mark.parametrize(("expr", "as_tex", "as_text"), PINNED, ids=[row[2] for row in PINNED])
def test_a_formula_reads_as_in_a_textbook(expr: Any, as_tex: str, as_text: str) -> None:
    assert tex(expr) == as_tex
    assert text(expr) == as_text


def test_a_tensor_has_its_common_factor_in_front() -> None:
    assert re.sub(r"[{}]", "", tex(M * a**2 / 12 * ImmutableDenseMatrix.diag(13, 10, 5))).startswith(r"\frac112\,Ma^2")
    assert "13" in text(M * a**2 / 12 * ImmutableDenseMatrix.diag(13, 10, 5)).split("\n")[0]


def test_a_vector_along_the_diagonal_has_its_length_in_front() -> None:
    assert text(omega / sqrt(14) * ImmutableDenseMatrix([1, 2, 3])) == "ω/√14 (1, 2, 3)"


def test_a_vector_of_names_is_left_alone() -> None:
    assert text(ex.column(*ex.component_names("omega"))) == "(ω_x, ω_y, ω_z)"


def test_without_dimensions_letters_stand_in_their_own_order() -> None:
    assert plain(Notation().layout(b * a * c)) == "a b c"


@pytest.mark.parametrize(
    ("name", "layout"),
    [
        ("a", Name("a")),
        ("a_1", Name("a", "1")),
        ("theta_dot", Name("theta", "", 1)),
        ("theta_ddot", Name("theta", "", 2)),
        ("x_1_dot", Name("x", "1", 1)),
        ("dot", Name("dot")),
        ("v_AB", Name("v", "AB")),
        ("x_dotted", Name("x", "dotted")),
        ("r_C_z", Name("z", "C")),
        ("r'_C_x_dot", Name("x'", "C", 1)),
        ("r_x", Name("r", "x")),
        ("r_xy_z", Name("z", "xy")),
    ],
)
def test_a_name_is_a_letter_a_subscript_and_dots(name: str, layout: Name) -> None:
    assert layout_of_name(name) == layout


def test_every_greek_letter_is_printed_in_its_own_way() -> None:
    printed = [(latex(layout_of_name(name)), plain(layout_of_name(name))) for name in GREEK_LETTERS]
    assert len({as_tex for as_tex, _ in printed}) == len({as_text for _, as_text in printed}) == len(GREEK_LETTERS)
    assert all(as_tex == f"\\{name}" for (as_tex, _), name in zip(printed, GREEK_LETTERS, strict=True))
    assert all(len(as_text) == 1 and not as_text.isascii() for _, as_text in printed)


def test_letters_that_tex_or_unicode_lack_are_not_in_the_table() -> None:
    assert "omicron" not in GREEK_LETTERS
    assert len(set(GREEK_LETTERS.values())) == len(GREEK_LETTERS)


def test_a_function_of_two_arguments_is_not_printed_with_one() -> None:
    try:
        shown = tex(atan2(x, y))
    except TypeError:
        return
    assert "x" in shown and "y" in shown


@pytest.mark.parametrize(("to", "tex"), [(oo, r"\infty"), (-oo, r"-\infty"), (pi, r"\pi"), (Integer(0), "0")])
def test_where_a_letter_goes_to_may_be_infinite(to: Expr, tex: str) -> None:
    assert latex(NOTATION.layout(Approach(a, to)), inline=True).replace(" ", "") == rf"a\to{tex}"


def test_what_has_no_notation_is_refused_by_name() -> None:
    with pytest.raises(TypeError, match="no notation for"):
        NOTATION.layout(zoo)
    with pytest.raises(TypeError, match="no notation for"):
        NOTATION.layout(oo)


@pytest.mark.parametrize("character", list("\\{}$&#^_%~<>|\"'`") + ["é", "ω", "—"])
def test_every_special_character_of_a_text_is_made_harmless(character: str) -> None:
    shown = escaped(f"a{character}b")
    bare = re.sub(r"\\([a-zA-Z]+|.)(\{\})?", "", shown)
    assert not set(bare) & set("$&#^_%~\\")
    assert bare.count("{") == bare.count("}")


def test_a_character_that_tex_lacks_is_refused_by_name() -> None:
    with pytest.raises(Rejected, match="`a✓b` has a character that cannot be printed"):
        escaped("a✓b")


def test_a_command_in_a_text_is_not_a_command() -> None:
    for evil in (r"\input{x}", r"\write18{ls}", "$x$", "100% & more"):
        assert not re.search(r"\\(input|write)", escaped(evil))
        assert not re.search(r"(?<!\\)[$%&]", escaped(evil))


# --- properties ---


def value_on_paper(layout: Any, values: dict[Any, float]) -> float:
    match layout:
        case on_paper.Digits(digits):
            return float(digits)
        case on_paper.Name("pi"):
            return 3.141592653589793
        case on_paper.Name():
            return values[layout]
        case on_paper.Fraction(above, below):
            return value_on_paper(above, values) / value_on_paper(below, values)
        case on_paper.Raised(base, power):
            assert isinstance(base, on_paper.Name | on_paper.Digits | on_paper.Fenced), (
                f"{base} is raised without brackets"
            )
            return float(value_on_paper(base, values) ** value_on_paper(power, values))
        case on_paper.RootSign(inside):
            return float(value_on_paper(inside, values) ** 0.5)
        case on_paper.Fenced(inside, kind):
            value = value_on_paper(inside, values)
            return abs(value) if kind == "|" else value
        case on_paper.Applied(name, argument, power):
            assert isinstance(argument, on_paper.Name | on_paper.Digits | on_paper.Fenced), (
                f"{argument} has no brackets"
            )
            value = float(PRINTED[name](value_on_paper(argument, values)))
            return value if power is None else float(value ** value_on_paper(power, values))
        case on_paper.Row(items):
            return sum_on_paper(items, values)
    raise AssertionError(f"{layout} is not arithmetic")


def sum_on_paper(items: tuple[Any, ...], values: dict[Any, float]) -> float:
    total, product = 0.0, None
    sign = 1.0
    for item in (*items, on_paper.PLUS):
        if item in (on_paper.PLUS, on_paper.MINUS):
            total += sign * product if product is not None else 0.0
            sign, product = (1.0 if item == on_paper.PLUS else -1.0), None
        elif item not in (on_paper.DOT, on_paper.TIMES, on_paper.THIN_SPACE):
            product = (1.0 if product is None else product) * value_on_paper(item, values)
    return total


PRINTED = {"sin": sin, "cos": cos, "tan": tan, "exp": exp, "arctan": atan, "arcsin": asin, "arccos": acos, "ln": log}
LETTERS = [a, b, M, omega, x, theta, theta_dot, Symbol("l_1", positive=True)]
VALUES = dict(zip(LETTERS, (1.25, 0.8, 2.3, 1.7, -0.6, 0.4, -1.1, 0.9), strict=True))
ON_PAPER = {NOTATION.layout(letter): value for letter, value in VALUES.items()}

numbers = st.one_of(
    st.integers(-12, 12).map(Integer),
    st.fractions(min_value=-9, max_value=9, max_denominator=12).map(lambda f: Rational(f.numerator, f.denominator)),
    st.sampled_from([pi, sqrt(2), sqrt(14) / 7, sqrt(42) / 28, 1 / sqrt(6)]),
)
expressions = st.recursive(
    st.one_of(numbers, st.sampled_from(LETTERS)),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: p[0] + p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] - p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] * p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] / p[1] if p[1] != 0 else p[0]),
        st.tuples(inner, st.integers(-2, 3)).map(lambda p: p[0] ** p[1] if p[0] != 0 else p[0]),
        inner.map(lambda e: sqrt(e**2 + 1)),
        inner.map(sin),
        inner.map(cos),
        inner.map(atan),
        st.tuples(inner, inner).map(lambda p: ex.Factors(*p)),
        st.tuples(inner, inner, inner).map(lambda p: ex.Terms(*p)),
        st.tuples(inner, inner).map(lambda p: ex.Ratio(p[0], p[1]) if p[1] != 0 else p[0]),
        inner.map(ex.Group),
        inner.map(lambda e: ex.Root(ex.Terms(e**2, Integer(1)))),
        inner.map(abs),
    ),
    max_leaves=8,
)
vectors = st.lists(expressions, min_size=3, max_size=3).map(lambda entries: ex.column(*map(explicit, entries)))
bounded = settings(max_examples=30, deadline=None, derandomize=True)


def is_ordinary(expr: Any) -> bool:
    return not explicit(expr).has(zoo, oo, -oo) and explicit(expr) == explicit(expr)


@bounded
@given(expressions)
def test_what_stands_on_paper_has_the_value_of_the_expression(expr: Expr) -> None:
    assume(is_ordinary(expr) and str(explicit(expr)) != "nan")
    exact = complex(explicit(expr).subs(VALUES).evalf(30))
    assume(abs(exact.imag) < 1e-12 and abs(exact) < 1e8)
    assert value_on_paper(NOTATION.layout(expr), ON_PAPER) == pytest.approx(exact.real, rel=1e-7, abs=1e-7)


@bounded
@given(vectors)
def test_presenting_a_vector_changes_no_value(vector: Any) -> None:
    assume(all(is_ordinary(entry) and str(entry) != "nan" for entry in vector))
    assert equal(explicit(present(vector)), vector)


def test_presenting_a_tensor_changes_no_value() -> None:
    for key in ("inertia_tensor", "corner_tensor"):
        tensor = known_block()[key].value
        assert equal(explicit(present(tensor)), tensor)
    assert present(eye(3)) == eye(3)


def balanced(shown: str) -> bool:
    depth = 0
    for token in re.findall(r"\\[{}]|[{}]", shown):
        depth += {"{": 1, "}": -1}.get(token, 0)
        if depth < 0:
            return False
    return depth == 0 and shown.count(r"\left") - shown.count(r"\leftarrow") == shown.count(r"\right")


@bounded
@given(st.one_of(expressions, vectors))
def test_latex_has_balanced_braces_and_fences(expr: Any) -> None:
    assume(all(is_ordinary(e) and str(explicit(e)) != "nan" for e in (expr if ex.is_matrix(expr) else [expr])))
    for inline in (False, True):
        shown = latex(NOTATION.result(expr), inline=inline)
        assert balanced(shown)
        assert not re.search(r"[$#%]|\^\^|__|\{\}[\^_]", shown)


@bounded
@given(st.one_of(expressions, vectors))
def test_text_has_no_tex_and_printing_is_deterministic(expr: Any) -> None:
    assume(all(is_ordinary(e) and str(explicit(e)) != "nan" for e in (expr if ex.is_matrix(expr) else [expr])))
    assert not set(text(expr)) & set("\\{}$&")
    assert (text(expr), tex(expr)) == (text(expr), tex(expr))
    assert text(expr) == plain(Notation(dict(NOTATION.known_dimensions)).result(expr))


def test_every_line_of_the_block_is_printed_in_both_formats() -> None:
    for quantity in known_block().values():
        for form in quantity.step.chain:
            assert balanced(tex(form.expr))
            assert not set(text(form.expr)) & set("\\{}$&")


@bounded
@given(expressions)
def test_every_letter_of_a_formula_is_printed(expr: Expr) -> None:
    assume(is_ordinary(expr) and str(explicit(expr)) != "nan")
    shown = tex(expr)
    assert all(latex(NOTATION.layout(letter)) in shown for letter in expr.free_symbols)


def test_a_product_of_numbers_alone_is_a_fraction() -> None:
    assert plain(NOTATION.layout(Mul(Rational(1, 2), Rational(1, 3), evaluate=False))) == "1/6"
