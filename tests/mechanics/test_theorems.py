"""Theorems in their general form: bodies and motions put into the formulas, which must then be true."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
from sympy import Expr, Integer, Matrix, S, Symbol, cos, diff, eye, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Partial, TimeRate, explicit, rate, scalar
from derive.mechanics import Cuboid, centre_of_mass, inertia_tensor, moved_to
from derive.steps.rule import Theorem
from tests.rules import records, theorems

BY_NAME = {theorem.name: theorem for theorem in theorems()}
a, b, c, M, t = symbols("a b c M t", positive=True)


def put_in(theorem: Theorem, values: dict[str, Expr]) -> Expr:
    residual = explicit(theorem.formula.residual)
    return residual.xreplace({s: values[s.name] for s in residual.free_symbols if s.name in values})


def test_parallel_axes_hold_for_a_block_about_its_corner_entry_by_entry() -> None:
    block = Cuboid((a, b, c), M)
    J = inertia_tensor(block, about="corner", key="J")
    centre = centre_of_mass(block)
    I, r = moved_to(J, centre).value, centre.value
    for i, j in product(range(3), repeat=2):
        values = {"J_ij": J.value[i, j], "I_ij": I[i, j], "M": M, "delta_ij": eye(3)[i, j]}
        values |= {"r": sqrt((r.T * r)[0]), "r_i": r[i], "r_j": r[j]}
        left = put_in(BY_NAME["parallel_axes"], values)
        assert equal(left, Integer(0))


def test_perpendicular_axes_hold_for_what_is_flat_and_for_nothing_else() -> None:
    def difference(thickness: Expr) -> Expr:
        J = inertia_tensor(Cuboid((a, b, thickness), M), about="corner", key="J").value
        return put_in(BY_NAME["perpendicular_axes"], {f"I_{k}": J[i, i] for i, k in enumerate("xyz")})

    assert equal(difference(c), -2 * M * c**2 / 3), "z^2 counts in both moments on the right"
    assert equal(difference(c).subs(c, 0), Integer(0))


def test_the_rate_in_space_is_that_in_turning_axes_and_what_turning_adds() -> None:
    w = Symbol("omega", positive=True)
    turned = Matrix([[cos(w * t), -sin(w * t), 0], [sin(w * t), cos(w * t), 0], [0, 0, 1]])
    inside = Matrix([t, t**2, 1])
    in_space = turned.T * diff(turned * inside, t)
    formula = BY_NAME["rotating_axes"].formula
    assert [type(part).__name__ for part in formula.right.args] == ["BodyRate", "Cross"]
    omega, vector = formula.right.args[1].args
    assert (omega.name, vector.name) == ("omega", "G"), "the order of the product is its sign"
    assert equal(in_space, diff(inside, t) + Matrix([0, 0, w]).cross(inside))


def in_coordinate(formula: Any, lagrangian: Expr, function: Expr = S.Zero) -> Expr:
    q = scalar("q")
    put = {scalar("L"): lagrangian, scalar("f_k"): function, scalar("f"): function}

    def evaluated(node: Any) -> Any:
        if isinstance(node, Partial):
            return diff(put[node.args[0]], node.args[1])
        if isinstance(node, TimeRate):
            return explicit(TimeRate(evaluated(node.args[0]), q))
        return node.func(*map(evaluated, node.args)) if node.args else node

    return explicit(evaluated(formula.left)) - explicit(evaluated(formula.right))


@pytest.mark.parametrize("name", ["multipliers", "multipliers_of_rates", "multiplier_of_one", "multiplier_of_one_rate"])
def test_a_positive_multiplier_pushes_towards_a_larger_constraint(name: str) -> None:
    """A bead held at the height q = 0 by f = q, or by f = q': the force that holds it is + m g."""
    (m, g), q = symbols("m g", positive=True), scalar("q")
    function = rate(q) if "rate" in name else q
    found = in_coordinate(BY_NAME[name].formula, m * rate(q) ** 2 / 2 - m * g * q, function)
    multiplier = scalar("lambda" if "one" in name else "lambda_k")
    assert equal(found.subs(rate(q, 2), 0), m * g - multiplier)


@pytest.mark.parametrize("theorem", theorems(), ids=lambda theorem: theorem.name)
def test_each_theorem_says_where_it_is_from_and_who_uses_it(theorem: Theorem) -> None:
    assert "section" in theorem.source
    quotes = [(rule, quote) for *_, rule in records() for quote in rule.quotes if quote.theorem is theorem]
    assert quotes
    for rule, quote in quotes:
        assert quote.outcomes | quote.law_in <= set(rule.outcomes), rule.name
