"""Tests of expressions as text that SymPy alone can read."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from sympy import Float, Integer, Matrix, MatrixExpr, MatrixSymbol, Rational, Symbol, symbols
from sympy import sympify as sympy_reads  # an independent reader of the texts: the engine never uses `sympify`

from derive.algebra import expressions as ex
from derive.algebra.expressions import component_names
from derive.algebra.rounding import Rounded
from derive.render.printing.plain_sympy import Setting, identifier, sympy_text
from derive.steps.step import Quantity
from tests.mechanics.block import M, a, b, c, known_block, omega

theta, L = Symbol("theta", real=True), Symbol("L", real=True)


VARIANTS: list[dict[str, Any]] = [
    {},
    {"sides": (a, a, a)},
    {"axis": "z"},
    {"axis": (Integer(1), Integer(1), Integer(0))},
]


POINT = {name: Rational(n, 7) for n, name in enumerate(("a", "b", "c", "M", "omega", "x", "y", "z", "theta"), 5)}
POINT |= {f"{name}_{axis}": Rational(n, 11) for name in ("omega", "n") for n, axis in enumerate("xyz", 3)}


def meanings(quantity: Quantity) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for parent in quantity.parents:
        value = sympy_reads(sympy_text(parent.value))
        found[sympy_reads(sympy_text(parent.symbol))] = value
        if isinstance(parent.symbol, MatrixSymbol) and parent.symbol.shape == (3, 1):
            names = (Symbol(name.name) for name in component_names(parent.symbol.name))
            found.update(zip(names, value, strict=True))
    return {name: value for name, value in found.items() if name != value}


def number(text: str, names: dict[Any, Any]) -> list[Any]:
    value = sympy_reads(text)
    matrices = {name: meaning for name, meaning in names.items() if isinstance(name, MatrixSymbol)}
    value = value.subs(matrices).subs({name: m for name, m in names.items() if name not in matrices}).doit()
    value = value.as_explicit() if isinstance(value, MatrixExpr) else value
    entries = list(value) if hasattr(value, "shape") else [value]
    return [entry.subs({Symbol(name): n for name, n in POINT.items()}).doit().evalf(30) for entry in entries]


def agree(left: list[Any], right: list[Any]) -> bool:
    assert all(isinstance(value, Float | Integer) for value in left + right), f"{left} or {right} is no number"
    return len(left) == len(right) and all(abs(p - q) < 1e-20 * (1 + abs(p)) for p, q in zip(left, right, strict=True))


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_every_line_of_a_chain_equals_the_first_when_read_with_sympy_alone(variant: dict[str, Any]) -> None:
    for quantity in known_block(**variant).values():
        names = meanings(quantity)
        # The general law of a rotation contains `omega_x` without a value, so here the symbol denotes itself.
        lines = [number(sympy_text(form.expr), names) for form in quantity.step.chain]
        for line, form in zip(lines[1:], quantity.step.chain[1:], strict=True):
            assert agree(lines[0], line), f"{quantity.key}: {form.because}"


def test_a_line_that_was_changed_would_be_noticed() -> None:
    quantity = known_block()["kinetic_energy"]
    text = sympy_text(quantity.value)
    assert not agree(number(text, {}), number(text.replace("13", "14"), {}))


@pytest.mark.parametrize(
    ("expr", "text"),
    [
        (Rational(13, 12) * M * a**2, "13*M*a**2/12"),
        (Symbol("theta_dot", real=True), "theta_dot"),
        (Symbol("theta_ddot"), "theta_ddot"),
        (Symbol("I", positive=True) * a, "Symbol('I')*a"),
        (Symbol("beta"), "Symbol('beta')"),
        (Symbol("lambda") + 1, "Symbol('lambda') + 1"),
        (ex.column(a, 0, b), "Matrix([[a], [0], [b]])"),
        (ex.Amount(Rational(3, 2), "cm", Rational(1, 100)), "((3/2)*(1/100))"),
    ],
    ids=str,
)
def test_a_line_is_plain_sympy_with_the_names_of_its_letters(expr: Any, text: str) -> None:
    assert sympy_text(expr) == text


@pytest.mark.parametrize(
    "name", ["I", "E", "S", "N", "O", "Q", "C", "beta", "gamma", "zeta", "lambda", "pi", "re", "Id", "in"]
)
def test_a_letter_that_sympy_or_python_claims_comes_back_as_a_letter(name: str) -> None:
    letter = Symbol(name, positive=True)
    back = sympy_reads(sympy_text(letter**2 * a + sympy.sin(letter)))
    assert back == Symbol(name) ** 2 * Symbol("a") + sympy.sin(Symbol(name))


@pytest.mark.parametrize(
    ("node", "value"),
    [
        (ex.Dot(ex.column(1, 2, 3), ex.column(a, a, a)), 6 * a),
        (ex.Norm(ex.column(3 * a, 0, 4 * a)), 5 * a),
        (ex.Cross(ex.column(1, 0, 0), ex.column(0, a, 0)), Matrix([0, 0, a])),
        (ex.Root(ex.Terms(a**2, 3 * a**2)), 2 * a),
        (ex.Bracket(Symbol("y") ** 3 / 3, Symbol("y"), Integer(0), a), a**3 / 3),
        (ex.Group(a + b) * c, (a + b) * c),
        (ex.Ratio(a + b, a - b), (a + b) / (a - b)),
        (ex.Factors(a + b, a - b), a**2 - b**2),
        (ex.scaled(a, ex.Cross(ex.column(1, 0, 0), ex.column(0, 1, 0))), Matrix([0, 0, a])),
        (ex.Outer(ex.column(1, 2, 0), ex.column(a, 0, b)), Matrix([[a, 0, b], [2 * a, 0, 2 * b], [0, 0, 0]])),
        (ex.Ratio(a, ex.Ratio(b, c)), a * c / b),
        (-ex.Factors(a, b), -a * b),
        (ex.Factors(a, b) ** 2, a**2 * b**2),
        (ex.Ratio(a, b) ** 2, a**2 / b**2),
        (c / ex.Factors(a, b), c / (a * b)),
        (c / ex.Ratio(a, b), b * c / a),
        (c / ex.Group(a + b), c / (a + b)),
        (ex.Terms(a, b) ** 2, (a + b) ** 2),
        (ex.Dot(ex.column(a, b, 0), ex.column(1, 1, 1)) ** 2, (a + b) ** 2),
    ],
    ids=str,
)
def test_a_node_becomes_what_sympy_itself_has(node: Any, value: Any) -> None:
    back = sympy_reads(sympy_text(node)).doit()
    back = back.as_explicit() if isinstance(back, MatrixExpr) else back
    positive = dict(zip(symbols("a b c y"), (a, b, c, Symbol("y")), strict=True))
    assert sympy.simplify(back.subs(positive) - value) == value * 0


@pytest.mark.parametrize(
    ("expr", "text"),
    [
        (theta, "theta(t)"),
        (ex.rate(theta), "Derivative(theta(t), t)"),
        (ex.rate(theta, 2), "Derivative(theta(t), (t, 2))"),
        (Symbol("t", real=True) * theta, "t*theta(t)"),
        (Symbol("S") * ex.rate(Symbol("S")), "Function('S')(t)*Derivative(Function('S')(t), t)"),
        (Symbol("theta_0") * a, "a*theta_0"),
        (ex.Partial(L, ex.rate(theta)), "Derivative(L, Derivative(theta(t), t))"),
        (ex.TimeRate(theta**2, theta), "Derivative((theta(t)**2), t)"),
        (ex.At(ex.Slope(L, theta, Integer(2)), theta, Integer(0)), "Subs(Derivative(L, (theta(t), 2)), theta(t), 0)"),
        (ex.BodyRate(ex.column(theta, 0, a), theta), "Matrix([[theta(t)], [0], [a]]).diff(t)"),
        (ex.Component(ex.column(theta, 0, a), "z"), "Matrix([[theta(t)], [0], [a]])[2, 0]"),
        (ex.Bracket(theta**2, theta, Integer(0), a), "(Subs((theta**2), theta, a) - Subs((theta**2), theta, 0))"),
        (sympy.Integral(theta, (theta, 0, a)), "Integral(theta, (theta, 0, a))"),
        (ex.Relation(theta, "<=", a), "Le(theta(t), a, evaluate=False)"),
        (Rounded(Rational(216, 10), Integer(4)), "Rational('21.60')"),
    ],
    ids=str,
)
def test_what_moves_is_a_function_of_time(expr: Any, text: str) -> None:
    assert sympy_text(expr, Setting(moving={"theta", "S"})) == text
    assert sympy_reads(text) is not None


def test_the_rate_of_a_vector_in_space_is_its_rate_in_the_axes_and_that_of_their_turning() -> None:
    node = ex.CarriedRate(ex.column(theta, 0, 0), ex.column(0, 0, b), theta)
    back = sympy_reads(sympy_text(node, Setting(moving={"theta"})))
    moving = sympy.Function("theta")(Symbol("t"))
    assert back == Matrix([moving.diff("t"), moving * Symbol("b"), 0])


@pytest.mark.parametrize(
    ("name", "taken", "word"),
    [
        ("omega", (), "omega"),
        ("omega", ("omega",), "omega_"),
        ("I", (), "I_"),
        ("lambda", ("lambda_",), "lambda__"),
        ("J'_xx", (), "J_prime_xx"),
        ("id", (), "id_"),
    ],
)
def test_a_name_is_the_nearest_identifier_that_is_free(name: str, taken: tuple[str, ...], word: str) -> None:
    assert identifier(name, taken) == word
    assert sympy_reads(f"2*{word}", {word: Symbol("x")}) == 2 * Symbol("x")


def test_a_vector_by_name_is_a_matrix_symbol() -> None:
    text = sympy_text(ex.applied(ex.tensor("I"), ex.vector("omega")))
    assert sympy_reads(text) == MatrixSymbol("I", 3, 3) * MatrixSymbol("omega", 3, 1)
    assert omega not in known_block()["kinetic_energy"].value.free_symbols
