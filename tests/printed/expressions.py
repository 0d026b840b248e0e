"""Expressions and nodes drawn at random, of every kind that a step may hold, signs and sums in every place."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    MatAdd,
    MatMul,
    Rational,
    Symbol,
    acos,
    atan,
    cos,
    exp,
    log,
    pi,
    sin,
    sqrt,
    tan,
)

from derive.algebra import expressions as ex
from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.rounding import rounded_form
from derive.render.notation.notation import Notation
from tests.printed.meaning import meaning

KINDS = {
    **dict.fromkeys(["a", "b", "R"], "length"), **dict.fromkeys(["M", "I"], "mass"),
    **dict.fromkeys(["omega", "omega_x", "theta_dot"], "angular speed"), **dict.fromkeys(["I_z"], "moment of inertia"),
    **dict.fromkeys(["theta", "phi"], "angle"), "g": "acceleration", "n": "number", "theta_ddot": "number",
}  # fmt: skip
POSITIVE = {"a", "b", "R", "M", "I", "omega", "I_z", "g"}
LETTERS = {name: ex.scalar(name, **({"positive": True} if name in POSITIVE else {})) for name in KINDS}
NOTATION = Notation({LETTERS[name]: dimension_of_kind(kind) for name, kind in KINDS.items()})
VECTORS = [ex.vector(name) for name in ("omega", "L", "r_C", "e_1")]
TENSORS = [ex.tensor(name) for name in ("I", "J'")]
UNITS = [("cm", Rational(1, 100)), ("kg m^2", Integer(1)), ("rad/s", Integer(1)), ("deg", pi / 180), ("rpm", pi / 30)]


class Draw:
    def __init__(self, seed: object):
        self.source = random.Random(f"{seed}")

    def one(self, *choices: Callable[[], Any]) -> Any:
        return self.source.choice(choices)()

    # -- scalars -----------------------------------------------------------------------------------------------

    def letter(self) -> Expr:
        return LETTERS[self.source.choice(list(LETTERS))]

    def number(self) -> Expr:
        whole = Integer(self.source.choice([-7, -3, -2, -1, 1, 2, 3, 12]))
        return self.source.choice([whole, whole / self.source.choice([2, 3, 7]), whole * sqrt(3), sqrt(14) / 7, pi])

    def rounded(self) -> Any:
        value = Rational(self.source.randint(-99_999, 99_999) or 1, 10 ** self.source.choice([1, 4, 9]))
        return rounded_form(value, 4)

    def amount(self) -> Any:
        unit, factor = self.source.choice(UNITS)
        return ex.Amount(self.one(self.number, self.rounded, lambda: Rational(3, 2)), unit, factor)

    def angle(self) -> Expr:
        theta, phi, n = (LETTERS[name] for name in ("theta", "phi", "n"))
        return self.source.choice([theta, -theta, 2 * theta, theta - phi, phi, theta / 2 + pi, n * phi, -n * theta / 2])

    def function(self) -> Expr:
        return self.source.choice([sin, cos, tan])(self.angle())

    def scalar(self, depth: int) -> Any:
        if depth <= 0:
            return self.one(self.letter, self.letter, self.letter, self.number, self.function)
        inner = lambda: self.scalar(depth - 1)  # noqa: E731
        return self.one(
            lambda: inner() + inner(),
            lambda: inner() - inner(),
            lambda: inner() * inner(),
            lambda: inner() * inner(),
            lambda: -inner(),
            lambda: inner() / self.nonzero(depth - 1),
            lambda: self.nonzero(depth - 1) ** self.source.choice([2, 3, -1, -2]),
            lambda: LETTERS["a"] ** self.source.choice([Rational(3, 2), Rational(-1, 2), LETTERS["n"]]),
            lambda: sqrt(inner() ** 2 + 1),
            lambda: abs(inner()),
            lambda: self.source.choice([acos, atan, exp, log])(self.letter()) * inner(),
            lambda: ex.Factors(inner(), inner()),
            lambda: ex.Factors(inner(), inner(), inner()),
            lambda: ex.Factors(Integer(-1), inner(), inner()),
            lambda: ex.Terms(inner(), inner()),
            lambda: ex.Terms(inner(), -inner(), inner()),
            lambda: ex.Ratio(inner(), self.nonzero(depth - 1)),
            lambda: ex.Group(inner()),
            lambda: ex.Root(ex.Terms(inner() ** 2, Integer(1))),
            lambda: ex.Dot(self.vector(depth - 1), self.vector(depth - 1)),
            lambda: ex.Norm(self.vector(depth - 1)),
            lambda: ex.Component(self.vector(depth - 1), self.source.choice("xyz")),
            lambda: ex.Factors(self.amount(), self.amount()),
            lambda: ex.Factors(self.rounded(), self.letter()),
        )

    def nonzero(self, depth: int) -> Expr:
        value = self.scalar(depth)
        return value if meaning(value) != 0 else self.letter()

    def node(self, depth: int) -> Any:
        theta = LETTERS["theta"]
        inner = lambda: self.scalar(depth - 1)  # noqa: E731
        named = lambda: Symbol("U", real=True)  # noqa: E731
        x = ex.scalar("x")
        return self.one(
            lambda: ex.Partial(self.one(named, inner), theta),
            lambda: ex.TimeRate(self.one(named, inner, lambda: ex.Norm(VECTORS[1]) ** 2), theta),
            lambda: ex.Slope(self.one(named, inner), theta, self.source.choice([1, 2])),
            lambda: ex.At(self.one(named, inner, lambda: ex.Slope(named(), theta, 2)), theta, self.angle()),
            lambda: ex.Bracket(self.letter() * x**2 / 2, x, Integer(0), inner()),
            lambda: ex.Component(ex.CarriedRate(VECTORS[1], VECTORS[0]), "x"),
            lambda: ex.Terms(-LETTERS["a"], PLUS_MINUS * sqrt(1 + LETTERS["b"] ** 2)),
            lambda: PLUS_MINUS * self.letter() / 2,
        )

    def scalar_with_node(self, depth: int) -> Any:
        """A node within a sum, a product, a fraction: where it must not take in what is not its own."""
        node, other = self.node(depth), self.scalar(depth - 1)
        return self.one(
            lambda: node,
            lambda: ex.Factors(other, node),
            lambda: ex.Factors(node, other),
            lambda: ex.Terms(node, other),
            lambda: ex.Terms(other, -node),
            lambda: ex.Ratio(node, LETTERS["a"]),
        )

    # -- vectors, tensors, relations ---------------------------------------------------------------------------

    def vector(self, depth: int) -> Any:
        if depth <= 0:
            return self.one(lambda: self.source.choice(VECTORS), self.column)
        inner = lambda: self.vector(depth - 1)  # noqa: E731
        return self.one(
            self.column,
            lambda: self.source.choice(VECTORS),
            lambda: ex.scaled(self.scalar(depth - 1), inner()),
            lambda: ex.scaled(-self.letter(), inner()),
            lambda: ex.applied(self.tensor(depth - 1), inner()),
            lambda: MatAdd(inner(), inner()),
            lambda: MatAdd(inner(), ex.scaled(Integer(-1), inner())),
            lambda: ex.Cross(inner(), inner()),
            lambda: ex.CarriedRate(self.source.choice(VECTORS), VECTORS[0]),
            lambda: ex.BodyRate(self.source.choice(VECTORS)),
        )

    def column(self) -> Any:
        common = self.one(lambda: Integer(1), self.number, self.letter, lambda: -self.letter())
        return ex.column(*(ex.explicit(common * self.one(self.letter, self.number)) for _ in range(3)))

    def tensor(self, depth: int) -> Any:
        if depth <= 0:
            return self.source.choice(TENSORS)
        return self.one(
            lambda: self.source.choice(TENSORS),
            lambda: ImmutableDenseMatrix(3, 3, [ex.explicit(self.one(self.letter, self.number)) for _ in range(9)]),
            lambda: ex.scaled(self.scalar(depth - 1), self.source.choice(TENSORS)),
            lambda: ex.Outer(self.source.choice(VECTORS), self.source.choice(VECTORS)),
            lambda: MatAdd(self.tensor(depth - 1), MatMul(Integer(-1), self.tensor(depth - 1))),
        )

    def relation(self, depth: int) -> Any:
        mark = self.source.choice(["=", "!=", "<", ">", "<=", ">="])
        return ex.Relation(self.scalar(depth), mark, self.one(lambda: Integer(0), lambda: self.scalar(depth)))

    def line(self, depth: int) -> Any:
        return self.one(
            lambda: self.scalar(depth),
            lambda: self.scalar(depth),
            lambda: self.scalar_with_node(depth - 1),
            lambda: self.vector(depth),
            lambda: self.tensor(depth - 1),
            lambda: self.relation(depth - 1),
        )
