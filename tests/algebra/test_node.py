"""A node is one class: what it says of itself is all that algebra and steps need to know of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from sympy import Expr, Integer, Symbol, Tuple, symbols

from derive.algebra import expressions as ex
from derive.algebra.dimensions import Dimension, power
from derive.algebra.encoding import decoded, encoded
from derive.algebra.equality import equal
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.node import NODES, DimensionOf, ScalarNode, TextOf
from derive.render.printing.plain_sympy import sympy_text
from derive.steps.homogeneity import dimension_of

a, b, x = symbols("a b x", positive=True)


@pytest.fixture
def square() -> Iterator[Any]:
    class Squared(ScalarNode):
        def _evaluated(self, inside: Expr) -> Expr:
            return inside**2

        def dimension(self, of: DimensionOf) -> Dimension | None:
            return power(of(self.args[0]), 2)

        def lowered(self, text: TextOf) -> str:
            return f"{text(self.args[0])}**2"

    yield Squared
    del NODES["Squared"]


def test_a_node_of_ones_own_is_carried_out_compared_measured_and_kept(square: Any) -> None:
    whole = ex.Terms(square(a + b), -square(a), -square(b))
    assert equal(whole, 2 * a * b)
    assert not equal(whole, a * b)
    length = dimension_of_kind("length")
    assert dimension_of(whole, {a: length, b: length}) == dimension_of_kind("area")
    assert decoded(encoded(whole)) == whole
    assert sympy_text(square(a + b)) == "(a + b)**2"


def test_what_a_node_binds_is_no_name_of_its_own() -> None:
    r = ex.vector("r")
    whole = ex.MassIntegral(ex.Outer(r, r), r, a, ex.column(x, 0, 0), Integer(1), Tuple(x, 0, b))
    assert whole.variables == (r, x)
    assert ex.Bracket(x**2, x, Integer(0), a).variables == (x,)
    assert ex.Factors(x, a).variables == ()


def test_a_matrix_of_a_node_has_the_entries_of_its_value() -> None:
    u, v = ex.column(a, 0, x), ex.column(0, b, 1)
    for node in (ex.Cross(u, v), ex.Outer(u, v), ex.MatrixAmount(u, "m", Integer(1))):
        rows, columns = (int(n) for n in node.shape)
        assert [node[i, j] for i in range(rows) for j in range(columns)] == list(ex.explicit(node))
    assert Symbol("x", positive=True) in ex.Cross(u, v).free_symbols
