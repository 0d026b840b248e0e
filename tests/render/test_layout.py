"""Tests of the layout of formulas, which is the same in all formats."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Add, Symbol, symbols

from derive.algebra import expressions as ex
from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import PLUS_MINUS, rate
from derive.render.notation.latex import latex
from derive.render.notation.layout import (
    Name,
    Raised,
    Upright,
    ends_in_differential,
    is_differential,
    layout_of_name,
    row,
)
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

a, b, m = symbols("a b m", positive=True)
q = Symbol("q", real=True)
NOTATION = Notation()


@pytest.mark.parametrize(
    ("name", "letter", "primes", "below"),
    [
        ("omega_x", "omega", "", ("", ("x",))),
        ("J'_xx", "J", "'", ("", ("xx",))),
        ("T_1_rod", "T", "", (",", ("1", "rod"))),
        ("S_upper_rod", "S", "", (",", ("upper", "rod"))),
    ],
)
def test_a_name_has_its_letter_its_primes_and_what_stands_below(
    name: str, letter: str, primes: str, below: tuple[str, tuple[str, ...]]
) -> None:
    found = layout_of_name(name)
    assert (found.letter, found.primes, found.below) == (letter, primes, below)


def test_a_differential_is_told_from_a_letter_d() -> None:
    d = Upright("d")
    assert all(is_differential(sign) for sign in (d, Upright("partial"), Raised(d, Name("n"))))
    assert not is_differential(Name("d"))
    assert ends_in_differential(row(Name("f"), d, Name("x")))
    assert not ends_in_differential(row(d, Name("x"), Name("f")))


@pytest.mark.parametrize(
    ("expr", "shown"),
    [
        (PLUS_MINUS, "±1"),
        (PLUS_MINUS * a, "±a"),
        (ex.Factors(PLUS_MINUS, b, a), "±b a"),
        (ex.Factors(-1, b, a), "-b a"),
        (-a * b, "-a b"),
        (ex.scaled(-a, ex.vector("L")), "-a L⃗"),
        (ex.scaled(PLUS_MINUS * a, ex.vector("L")), "±a L⃗"),
    ],
)
def test_a_sign_stands_before_the_whole_product_in_every_format(expr: Any, shown: str) -> None:
    layout = NOTATION.layout(expr)
    assert plain(layout) == shown
    assert latex(layout).startswith(r"\pm" if shown[0] == "±" else "-")


def test_the_order_of_terms_is_not_that_in_which_they_were_gathered() -> None:
    value = a * b * q + b * rate(q) ** 2 + m * rate(q, 2) + a * rate(q, 2)
    gathered = by_accelerations(value, [q])
    turned = Add(*reversed(gathered.args), evaluate=False)
    assert gathered.args != turned.args
    assert plain(NOTATION.layout(gathered)) == plain(NOTATION.layout(turned)) == "(a + m) q̈ + b (q̇)² + a b q"
