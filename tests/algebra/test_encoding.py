"""An expression goes to nested lists and comes back the same."""

from __future__ import annotations

import json
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import (
    E,
    Expr,
    Function,
    I,
    Identity,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatAdd,
    Mul,
    Rational,
    Symbol,
    Tuple,
    acos,
    cos,
    oo,
    pi,
    preorder_traversal,
    sin,
    sqrt,
    symbols,
)

from derive.algebra import expressions as ex
from derive.algebra.amplitudes import Amplitudes, Determinant
from derive.algebra.encoding import as_data, decoded, encoded, from_data
from derive.algebra.expansion import Approach, Expansion, FirstOrder
from derive.algebra.node import NODES, Node
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.period_series import SwingTime, SwingTimeOfNumbers
from derive.algebra.rounding import Rounded
from tests.mechanics.block import known_block

x, y = symbols("x y", real=True)
a, b = symbols("a b", positive=True)
u, omega, I_c = ex.column(x, y, 1), ex.vector("omega"), ex.tensor("I")
r = ex.vector("r")

EXPRESSIONS = [
    Integer(-3),
    Rational(13, 12),
    pi / 2 + E,
    I * a,
    oo,
    sqrt(42) / 28 * a,
    ex.PoissonBracket(a, b, a, b),
    Symbol("omega_x", real=True),
    Symbol("n", integer=True, positive=True),
    Mul(2, a + b, evaluate=False),
    Mul(-1, a - b, evaluate=False),
    Rational(2, 3) * (a + b) * x,
    acos(7 * sqrt(2779) / 397),
    sin(x + y) ** 2 / cos(x),
    Integral(x**2 * y, (x, 0, a), (y, -b, b)),
    ImmutableDenseMatrix(3, 3, [a, 0, 0, 0, b, 0, 0, 0, sqrt(2)]),
    u,
    omega,
    I_c,
    ex.Dot(omega, ex.applied(I_c, omega)),
    ex.Norm(ex.Cross(omega, u)),
    ex.CarriedRate(ex.vector("L"), omega),
    ex.Group(6 * a**3),
    ex.Factors(a, 3 * a, ex.Bracket(y**3 / 3, y, Integer(0), 2 * a)),
    ex.Terms(8 * a, 18 * a),
    ex.Ratio(a, ex.Factors(a, a)),
    ex.Root(ex.Terms(a**2, b**2)),
    ex.Amount(Integer(2), "cm", Rational(1, 100)),
    ex.MatrixAmount(ex.column(1, 2, 3), "kg m^2", Integer(1)),
    ex.scaled(a / b, ex.Cross(omega, omega)),
    MatAdd(ex.scaled(ex.Dot(r, r), Identity(3)), ex.scaled(Integer(-1), ex.Outer(r, r))),
    ex.MassIntegral(ex.Outer(r, r), r, a, u, Integer(1), Tuple(x, 0, a), Tuple(y, 0, b)),
    Rounded(Rational(2164, 100), Integer(4)),
    ex.Factors(Rounded(Rational("0.2315"), Integer(4)), a**2),
    ex.BodyRate(ex.vector("L"), x),
    ex.Component(omega, "y"),
    ex.Relation(ex.TimeRate(ex.Partial(x**2 * y, x), x, y), "=", ex.At(ex.Slope(x**3, x, Integer(2)), x, a)),
    ex.Truncated(1 - x**2 / 2, x, Integer(0), Integer(3)),
    Amplitudes(a, b),
    Determinant(ImmutableDenseMatrix([[a, x], [y, b]])),
    Expansion(a * b / (a + b), a, oo, Integer(1)),
    Approach(a, oo),
    FirstOrder(a * x + x**2 * y, x, y),
    SwingTime(b * (cos(x) - cos(a)), x, a, Integer(2)),
    OrderedRoot((1, -a, b, -a * b), 2, Symbol("lambda_2")),
    SwingTimeOfNumbers(
        SwingTime(b * (cos(x) - cos(a)), x, a, Integer(2)),
        Tuple(a, b),
        Tuple(ex.Amount(Integer(1), "rad", Integer(1)), ex.Amount(Integer(9), "s^-2", Integer(1))),
    ),
]


class Unsaid(Node, abstract=True):
    """A node that says nothing of itself."""


def there_and_back(expr: Any) -> Any:
    return decoded(json.loads(json.dumps(encoded(expr))))


@pytest.mark.parametrize("expr", EXPRESSIONS, ids=str)
def test_an_expression_comes_back_unchanged(expr: Any) -> None:
    back = there_and_back(expr)
    assert back == expr
    assert type(back) is type(expr)


@pytest.mark.parametrize("name", NODES)
def test_every_node_says_its_dimension_and_what_it_is_to_sympy_and_is_encoded(name: str) -> None:
    kind = NODES[name]
    for what in ("dimension", "lowered"):
        assert getattr(kind, what) is not getattr(Node, what), f"{name} says nothing of its {what}"
    examples = [e for expr in EXPRESSIONS for e in preorder_traversal(expr) if type(e) is kind]
    assert examples, f"no expression of this test holds a {name}"
    for example in examples:
        assert there_and_back(example) == example
        assert example.lowered(lambda part, bound=(): "1")


def test_a_node_that_says_nothing_of_itself_is_found_out() -> None:
    assert Unsaid.__name__ not in NODES
    for ask in (lambda node: node.dimension(None), lambda node: node.lowered(str), lambda node: node.doit()):
        with pytest.raises(AttributeError, match="Unsaid must define"):
            ask(Unsaid())


def test_two_nodes_of_one_name_are_refused() -> None:
    with pytest.raises(TypeError, match="a node Dot already exists"):
        type("Dot", (Node,), {})


def test_symbols_come_back_with_what_is_assumed_of_them() -> None:
    for symbol in (x, a, Symbol("k", integer=True, nonnegative=True), Symbol("plain")):
        assert there_and_back(symbol).assumptions0 == symbol.assumptions0


def test_every_line_of_the_block_comes_back_unchanged() -> None:
    steps = [quantity.step for quantity in known_block().values()]
    assert sum(len(step.chain) for step in steps) > 60
    for step in steps:
        assert [there_and_back(form.expr) for form in step.chain] == [form.expr for form in step.chain]


@pytest.mark.parametrize("expr", [Function("f")(x), Function("f")(x).diff(x), object()])
def test_what_has_no_encoding_is_refused_by_name(expr: Any) -> None:
    with pytest.raises(TypeError, match="has no encoding"):
        encoded(expr)


@pytest.mark.parametrize("data", [["eval", "1"], ["__import__", "os"], ["Lambda", ["Integer", 1]], ["object"]])
def test_only_listed_classes_are_built(data: list[Any]) -> None:
    with pytest.raises(ValueError, match="has no encoding"):
        decoded(data)


leaves = st.one_of(
    st.integers(-20, 20).map(Integer),
    st.fractions(max_denominator=12).map(lambda f: Rational(f.numerator, f.denominator)),
    st.sampled_from([x, y, a, b, pi, sqrt(2)]),
)
trees = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: p[0] + p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] * p[1]),
        st.tuples(inner, inner).map(lambda p: Mul(*p, evaluate=False)),
        st.tuples(inner, inner).map(lambda p: ex.Factors(*p)),
        st.tuples(inner, inner).map(lambda p: ex.Terms(*p)),
        st.tuples(inner, inner).map(lambda p: ex.Ratio(*p)),
        st.tuples(inner, st.integers(-2, 3)).map(lambda p: p[0] ** p[1] if p[0] != 0 else p[0]),
        inner.map(sin),
        inner.map(ex.Root),
        inner.map(ex.Group),
    ),
    max_leaves=8,
)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(trees)
def test_any_expression_comes_back_unchanged(expr: Any) -> None:
    assert there_and_back(expr) == expr


@pytest.mark.parametrize(
    "data",
    [
        None,
        [],
        "Integer",
        {},
        ["Lambda", []],
        ["__import__", "os"],
        ["Integer", 2**30000],
        ["Integer", "1"],
        ["Rational", 1, 0],
        ["Symbol", "x", {"real": "yes"}],
        ["Symbol", 3, {}],
        ["Matrix", 10**6, 10**6, []],
        ["MatrixSymbol", "A", 10**9, 1],
        [["Integer"], 1],
        ["Add", 3],
        ["sin"],
        ["sin", ["Integer", 1], ["Integer", 2]],
        ["Pow", ["Integer", 1]],
        ["Integral", ["None"]],
        ["MatMul", ["Str", "a"], ["None"]],
        ["Amount"],
    ],
    ids=lambda data: type(data).__name__,
)
def test_data_that_encoded_never_writes_are_refused(data: Any) -> None:
    with pytest.raises(ValueError, match=r"this is no|has no encoding"):
        decoded(data)


def test_data_nested_without_end_are_refused() -> None:
    deep: list[Any] = ["Integer", 1]
    for _ in range(400):
        deep = ["sin", deep]
    with pytest.raises(ValueError, match="too large"):
        decoded(deep)
    with pytest.raises(ValueError, match="too large"):
        decoded(["Tuple", *([["Integer", 1]] * 200_001)])


class Size(StrEnum):
    LARGE = "large"


@dataclass(frozen=True)
class Weighed:
    mass: Expr
    size: Size
    notes: tuple[str, ...] = ()


def test_a_record_goes_to_data_and_back_with_its_enums_and_expressions() -> None:
    known = {"Weighed": Weighed, "Size": Size}
    record = Weighed(Symbol("m", positive=True) ** 2, Size.LARGE, ("once", "twice"))
    found = from_data(json.loads(json.dumps(as_data([record, None], known))), known)
    assert found == (record, None)
    assert found[0].size is Size.LARGE


def test_only_records_that_are_named_go_to_data_and_back() -> None:
    with pytest.raises(TypeError, match="Weighed has no encoding"):
        as_data(Weighed(Integer(1), Size.LARGE), {})
    with pytest.raises(KeyError):
        from_data({"is": "Popen", "args": "true"}, {"Weighed": Weighed})
