"""The Poisson bracket as a node: its value, its dimension, and what SymPy has for it."""

from __future__ import annotations

from sympy import Derivative, Symbol, symbols

from derive.algebra.dimensions import NUMBER
from derive.algebra.encoding import decoded, encoded
from derive.algebra.expressions import PoissonBracket, explicit
from derive.algebra.kinds import dimension_of_kind
from derive.render.notation.latex import latex
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain

x, y, p_x, p_y = symbols("x y p_x p_y", real=True)
SIZES = {
    **dict.fromkeys((x, y), dimension_of_kind("length")),
    **dict.fromkeys((p_x, p_y), dimension_of_kind("momentum")),
}


def bracket(f: object, g: object) -> PoissonBracket:
    return PoissonBracket(f, g, x, p_x, y, p_y)


def test_a_coordinate_and_its_momentum_have_the_bracket_one() -> None:
    assert explicit(bracket(x, p_x)) == 1
    assert explicit(bracket(p_x, x)) == -1
    assert explicit(bracket(x, p_y)) == 0


def test_a_bracket_sums_over_all_pairs() -> None:
    assert explicit(bracket(x * p_y - y * p_x, x**2 + y**2)) == 0
    assert explicit(bracket(x * p_y - y * p_x, x)) == y


def test_its_dimension_is_that_of_both_less_an_action() -> None:
    assert bracket(x, p_x).dimension(lambda part: SIZES[part]) == NUMBER
    assert bracket(x, y).dimension(lambda part: SIZES[part]) == dimension_of_kind("time") / dimension_of_kind("mass")


def test_it_is_written_in_braces_and_goes_to_lists_and_back() -> None:
    layout = Notation().layout(bracket(x, p_x))
    assert plain(layout) == "{x, p_x}"
    assert latex(layout) == r"\{x,\ p_{x}\}"
    assert decoded(encoded(bracket(x, p_x))) == bracket(x, p_x)


def test_sympy_alone_has_derivatives_for_it() -> None:
    lowered = bracket(Symbol("f"), Symbol("g")).lowered(lambda part: f"({part})")
    assert lowered.count(Derivative.__name__) == 8
