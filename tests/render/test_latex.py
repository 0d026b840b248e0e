"""Tests of layouts as LaTeX, and of escaped text."""

from __future__ import annotations

import re

import pytest
from sympy import Expr, ImmutableMatrix, Symbol, sin, sqrt, symbols

from derive.errors import Rejected
from derive.mechanics.theorems import MULTIPLIERS
from derive.render.notation.latex import TEX_FUNCTIONS, TEX_OPERATORS, escaped, latex, unit_latex, unprintable
from derive.render.notation.layout import (
    Applied,
    Digits,
    Fenced,
    Fraction,
    Layout,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
)
from derive.render.notation.notation import Notation

a, b, R = symbols("a b R", positive=True)


@pytest.mark.parametrize(
    ("layout", "tex"),
    [
        (Name("omega", "x"), r"\omega_{x}"),
        (Name("omega", "omega"), r"\omega_{\omega}"),
        (Name("I", "rod_xx"), r"I_{\mathrm{rod},xx}"),
        (Name("I", "a_x"), r"I_{ax}"),
        (Name("mass"), r"\mathit{mass}"),
        (Name("theta", dots=2), r"\ddot{\theta}"),
        (Raised(Name("L'"), Digits("2")), r"{L'}^{2}"),
        (RootSign(Name("a")), r"\sqrt{a}"),
        (Fraction(Digits("1"), Digits("2")), r"\frac{1}{2}"),
        (Row((Name("a"), Operator("at_most"), Name("b"))), r"a\le b"),
    ],
)
def test_a_layout_has_its_tex(layout: Layout, tex: str) -> None:
    assert latex(layout) == tex


def test_a_fraction_in_a_line_of_text_is_small() -> None:
    half_of_product = Row((Fraction(Digits("1"), Digits("2")), Name("a"), Name("b")))
    assert latex(half_of_product, inline=True) == r"\tfrac{1}{2}\,ab"
    assert latex(half_of_product) == r"\frac{1}{2}\,ab"


@pytest.mark.parametrize("name", sorted(TEX_FUNCTIONS))
def test_a_function_is_a_command(name: str) -> None:
    assert latex(Applied(name, Fenced(Name("x")))).startswith(f"\\{name}")


@pytest.mark.parametrize("kind", TEX_OPERATORS)
def test_a_mark_does_not_run_into_the_letter_behind_it(kind: str) -> None:
    commands = re.findall(r"\\[A-Za-z]+", latex(Row((Name("a"), Operator(kind), Name("b")))))
    assert not [command for command in commands if command.endswith("b")]


@pytest.mark.parametrize(
    ("unit", "tex"),
    [
        ("kg m^2/s", r"\mathrm{kg\,m^{2}/s}"),
        ("m^(3/2)/s^2", r"\mathrm{m^{3/2}/s^{2}}"),
        ("1/s", r"\mathrm{1/s}"),
        ("%", r"\mathrm{\%}"),
        ("degree", r"\mathrm{{}^\circ}"),
    ],
)
def test_a_unit_stands_upright(unit: str, tex: str) -> None:
    assert unit_latex(unit) == tex


@pytest.mark.parametrize("character", list('\\{}$&#^_%~<>"'))
def test_no_character_of_a_text_is_a_command(character: str) -> None:
    tex = escaped(f"a{character}b")
    assert tex != f"a{character}b"
    assert tex.startswith("a")
    assert tex.endswith("b")


def test_text_of_letters_is_left_as_it_is_and_greek_is_set_as_mathematics() -> None:
    assert escaped("A block, 2 x 3 (see 1/2)") == "A block, 2 x 3 (see 1/2)"
    assert r"\omega" in escaped("ω")


def test_a_letter_may_have_accents_above_and_below() -> None:
    assert escaped("Nguyễn") == r"Nguy{\~{\^{e}}}n"
    assert escaped("Việt") == r"Vi{\d{\^{e}}}t"
    assert escaped("Ionuț") == r"Ionu{\textcommabelow{t}}"
    assert unprintable("Dương") == 1  # the fonts have no horn


def test_what_the_fonts_do_not_have_is_told_by_its_place() -> None:
    assert unprintable("a block ω") is None
    assert unprintable("ab\u4e2dc") == 2
    assert unprintable("Ж") == 0
    with pytest.raises(Rejected, match="has a character that cannot be printed"):
        escaped("\u4e2d")


def test_a_prime_stands_close_to_its_letter_and_can_be_squared() -> None:
    moment = Symbol("J'_xx")
    assert latex(Notation().layout(moment)) == "J'_{xx}"
    assert latex(Notation().layout(moment**2)) == "{J'_{xx}}^{2}"


@pytest.mark.parametrize(
    ("value", "tex"),
    [
        (a / 2, "a/2"),
        (R - a / 2, "R-a/2"),
        (-R * a / b, "-Ra/b"),
        (a**2 / b**2, "a^{2}/b^{2}"),
        (R * a / 2, r"\tfrac{1}{2}\,Ra"),
        (a / 2 * sin(R), r"\tfrac{a}{2}\,\sin R"),
        (R / (a + b), "R/(a+b)"),
        ((a - b) * R / (a + b), r"(a-b)\,R/(a+b)"),
        (sqrt((a + b) * R / (a * b)), r"\sqrt{(a+b)\,R/(ab)}"),
        ((a + b) / R, "(a+b)/R"),
        (R / (a + b + sin(a * b)), r"\tfrac{R}{a+b+\sin(ab)}"),
        (R / (a * b), "R/(ab)"),
        (R / (a * sin(b)), r"R/(a\sin b)"),
        (sin(R) / a, r"(\sin R)/a"),
        (R / sin(a), r"R/\sin a"),
        (R / sin(a * b), r"\tfrac{R}{\sin(ab)}"),
        (sqrt(R / a), r"\sqrt{R/a}"),
    ],
)
def test_in_running_text_a_fraction_has_a_stroke_where_it_cannot_be_misread(value: Expr, tex: str) -> None:
    assert latex(Notation().layout(value), inline=True) == tex


def test_in_running_text_a_vector_lies_down() -> None:
    assert latex(Notation().result(ImmutableMatrix([a, 2 * a, 3 * a])), inline=True) == r"a\,(1,\ 2,\ 3)"
    assert latex(Notation().layout(ImmutableMatrix([a / 2, 0, b])), inline=True) == r"(a/2,\ 0,\ b)"


def test_lagranges_equation_has_no_stacked_fractions_in_a_sentence() -> None:
    layout = Notation({}).result(MULTIPLIERS.formula)
    inline = r"d(\partial L/\partial \dot{q})/dt-\partial L/\partial q=\lambda_{k}\partial f_{k}/\partial q"
    assert latex(layout, inline=True) == inline
    assert latex(layout).count(r"\frac") == 4
