"""Names, and the unevaluated forms of the formulas of mechanics.

A *name* denotes a quantity in a formula: a SymPy `Symbol` for a scalar, a `MatrixSymbol` of shape (3, 1) for a vector
and (3, 3) for a tensor. A *node* is an operation that is shown before it is evaluated: `Dot(omega, L)`. `explicit()`
evaluates everything. Nodes contain no notation; the notation is in `derive.render`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    MatMul,
    Matrix,
    MatrixBase,
    MatrixExpr,
    MatrixSymbol,
    Pow,
    Rational,
    Symbol,
    cos,
    diff,
    sin,
    sqrt,
)
from sympy.core.symbol import Str
from sympy.matrices import ImmutableMatrix

from derive.algebra.amounts import IN_DEGREES as IN_DEGREES
from derive.algebra.amounts import Amount as Amount
from derive.algebra.amounts import MatrixAmount as MatrixAmount
from derive.algebra.derivatives import derivative
from derive.algebra.dimensions import Dimension, power, product, quotient
from derive.algebra.kinds import common, dimension_of_kind
from derive.algebra.mass_integral import MassIntegral as MassIntegral
from derive.algebra.node import (
    DimensionOf,
    MatrixNode,
    ScalarNode,
    TextOf,
    Value,
    VectorNode,
    dimension_of_first,
    product_of_dimensions,
)
from derive.algebra.node import as_expr as as_expr
from derive.algebra.node import explicit as explicit
from derive.algebra.poisson import PoissonBracket as PoissonBracket
from derive.algebra.prescribed import RATES as RATES
from derive.algebra.prescribed import TIME as TIME
from derive.algebra.prescribed import Prescribed as Prescribed
from derive.algebra.prescribed import depends_on_time as depends_on_time
from derive.algebra.prescribed import prescribed_in as prescribed_in
from derive.algebra.relation import Relation as Relation
from derive.algebra.relation import sympify_number as sympify_number

AXES = ("x", "y", "z")
DURATION = dimension_of_kind("time")


def scalar(name: str, **assumptions: bool) -> Symbol:
    """A real symbol with this name and these further assumptions."""
    return Symbol(name, **{"real": True, **assumptions})


def stand_in(name: str, **assumptions: bool) -> Symbol:
    """An auxiliary symbol, with a prime in its name, so that it differs from all symbols of a problem."""
    return scalar(f"{name}\u2032", **assumptions)


PLUS_MINUS = scalar("\u00b1", nonzero=True)  # a sign, + or -: its square is 1, so b + PLUS_MINUS*c is b +- c


@lru_cache(maxsize=1024)
def rate(coordinate: Symbol, order: int = 1) -> Symbol:
    """The name of a coordinate's rate of change: theta -> theta_dot, theta_dot -> theta_ddot."""
    if isinstance(coordinate, Prescribed):
        return coordinate.rate(order)
    name = coordinate.name
    now = next(n for n in (3, 2, 1, 0) if name.endswith(RATES[n]))
    return scalar(name.removesuffix(RATES[now]) + RATES[now + order])


def vector(name: str) -> MatrixSymbol:
    return MatrixSymbol(name, 3, 1)


def tensor(name: str) -> MatrixSymbol:
    return MatrixSymbol(name, 3, 3)


def component_names(name: str) -> tuple[Symbol, Symbol, Symbol]:
    """The symbols for a vector's components: `omega` -> omega_x, omega_y, omega_z."""
    x, y, z = (scalar(f"{name}_{axis}") for axis in AXES)
    return x, y, z


@lru_cache(maxsize=4096, typed=True)
def column(*components: Any) -> ImmutableMatrix:
    return ImmutableDenseMatrix(3, 1, list(components))


def is_matrix(value: Any) -> bool:
    return isinstance(value, MatrixBase | MatrixExpr)


class Dot(ScalarNode):
    """a . b"""

    def _evaluated(self, a: Matrix, b: Matrix) -> Expr:
        return sum((x * y for x, y in zip(a, b, strict=True)), Integer(0))

    dimension = product_of_dimensions

    def lowered(self, text: TextOf) -> str:
        a, b = (text(arg) for arg in self.args)
        return f"({a}.T*{b})[0, 0]"


class Norm(ScalarNode):
    """|a|"""

    is_nonnegative = True

    def _evaluated(self, a: Matrix) -> Expr:
        return sqrt(sum((x**2 for x in a), Integer(0)))

    dimension = dimension_of_first

    def lowered(self, text: TextOf) -> str:
        a = text(self.args[0])
        return f"sqrt(({a}.T*{a})[0, 0])"


class Cross(VectorNode):
    """a x b"""

    def _evaluated(self, a: Matrix, b: Matrix) -> ImmutableMatrix:
        return column(
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        )

    dimension = product_of_dimensions

    def lowered(self, text: TextOf) -> str:
        a, b = (_entries(arg, text) for arg in self.args)
        return f"{a}.cross({b})"


class CarriedRate(VectorNode):
    """The rate dA/dt, as seen in space, of a vector A whose components are along axes of the body. The body rotates
    with the angular velocity omega. Arguments: A, omega, and the coordinates that move; without coordinates, A changes
    in the body only if it contains the time.

    The value is the rate of the components plus the rate of the rotated vector. The rate of the rotated vector is not
    computed as omega x A: R(t) A is differentiated, where R(t) is the rotation by |omega| t about omega.
    """

    def _evaluated(self, a: Matrix, omega: Matrix, *moving: Symbol) -> ImmutableMatrix:
        in_body = Matrix([explicit(TimeRate(component, *moving)) for component in a])
        rate = sqrt(sum((w**2 for w in omega), Integer(0)))
        if rate == 0:
            return ImmutableDenseMatrix(in_body)
        t = Dummy("t", real=True)  # time from now; A and omega are the values at t = 0
        to_z = _rotation_onto_z(omega / rate)
        turn = Matrix([[cos(rate * t), -sin(rate * t), 0], [sin(rate * t), cos(rate * t), 0], [0, 0, 1]])
        # Only `turn` depends on t, so only `turn` is differentiated.
        return ImmutableDenseMatrix(in_body + to_z.T * diff(turn, t).subs(t, 0) * to_z * Matrix(a))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return product(of(arg) for arg in self.args[:2])

    def lowered(self, text: TextOf) -> str:
        a, omega = (_entries(arg, text) for arg in self.args[:2])
        return f"({a}.diff(t) + {omega}.cross({a}))"


def _rotation_onto_z(n: Matrix) -> Matrix:
    """The rotation about z, then y, that brings the unit vector n onto the z axis."""
    level = sqrt(n[0] ** 2 + n[1] ** 2)
    cos_phi, sin_phi = (n[0] / level, n[1] / level) if level != 0 else (Integer(1), Integer(0))
    about_z = Matrix([[cos_phi, sin_phi, 0], [-sin_phi, cos_phi, 0], [0, 0, 1]])
    about_y = Matrix([[n[2], 0, -level], [0, 1, 0], [level, 0, n[2]]])
    return about_y * about_z


class BodyRate(VectorNode):
    """dA/dt as seen in the body. Arguments: A, and the coordinates that move; without coordinates, A changes only if it
    contains the time."""

    def _evaluated(self, a: Matrix, *moving: Symbol) -> ImmutableMatrix:
        return column(*(explicit(TimeRate(component, *moving)) for component in a))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return quotient(of(self.args[0]), DURATION)

    def lowered(self, text: TextOf) -> str:
        return f"{_entries(self.args[0], text)}.diff(t)"


class Component(ScalarNode):
    """The component of a vector along an axis. Arguments: the vector, the axis as text."""

    def __new__(cls, v: Any, axis: str | Str) -> Component:
        return super().__new__(cls, v, Str(axis) if isinstance(axis, str) else axis)  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0])[AXES.index(self.args[1].name)]

    dimension = dimension_of_first

    def lowered(self, text: TextOf) -> str:
        return f"{_entries(self.args[0], text)}[{AXES.index(self.args[1].name)}, 0]"


class Group(ScalarNode):
    """A value in brackets, such as the `(6 a^3 rho)` that the next line replaces by M."""

    def __new__(cls, inner: Expr) -> Expr:
        return inner if isinstance(inner, Group) else super().__new__(cls, inner)

    def _evaluated(self, inner: Expr) -> Expr:
        return inner

    dimension = dimension_of_first

    def lowered(self, text: TextOf) -> str:
        return text(self.args[0])


class Factors(ScalarNode):
    """A product whose factors are shown as written, in the given order: `a * 3a * [y^3/3]`."""

    def _evaluated(self, *factors: Expr) -> Expr:
        result: Expr = Integer(1)
        for factor in factors:
            result = result * factor
        return result

    dimension = product_of_dimensions

    def lowered(self, text: TextOf) -> str:
        return f"({'*'.join(text(arg) for arg in self.args)})"


class Terms(ScalarNode):
    """A sum whose terms are shown as written, in the given order, not collected: `8a^5 + 18a^5`."""

    def _evaluated(self, *terms: Expr) -> Expr:
        result: Expr = Integer(0)
        for term in terms:
            result = result + term
        return result

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return common(self.args, of)

    def lowered(self, text: TextOf) -> str:
        return f"({' + '.join(text(arg) for arg in self.args)})"


class Ratio(ScalarNode):
    """A fraction as written, without cancelling."""

    def _evaluated(self, numerator: Expr, denominator: Expr) -> Expr:
        return numerator / denominator

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return quotient(*(of(arg) for arg in self.args))

    def lowered(self, text: TextOf) -> str:
        above, below = (text(arg) for arg in self.args)
        return f"({above}/{below})"


class Root(ScalarNode):
    """A root as written, without extracting factors; by default a square root. Arguments: the radicand, the index."""

    @property
    def index(self) -> int:
        return int(self.args[1]) if len(self.args) > 1 else 2

    def _evaluated(self, inside: Expr, *index: Expr) -> Expr:
        return Pow(inside, Rational(1, self.index))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return power(of(self.args[0]), Fraction(1, self.index))

    def lowered(self, text: TextOf) -> str:
        inside = text(self.args[0])
        return f"sqrt({inside})" if self.index == 2 else f"({inside})**(1/{self.index})"


class Bracket(ScalarNode):
    """[F(x)] between two limits: an antiderivative before its limits are inserted. Arguments: F, x, lower, upper."""

    def doit(self, **hints: Any) -> Expr:
        antiderivative, x, lower, upper = self.args
        f = explicit(antiderivative)
        return f.xreplace({x: upper}) - f.xreplace({x: lower})

    @property
    def variables(self) -> tuple[Any, ...]:
        return (self.args[1],)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        antiderivative, x, *limits = self.args
        return of(antiderivative, {x: common(limits, of)})

    def lowered(self, text: TextOf) -> str:
        f, x = (text(arg, (self.args[1],)) for arg in self.args[:2])
        lower, upper = (f"Subs({f}, {x}, {text(limit)})" for limit in self.args[2:])
        return f"({upper} - {lower})"


class Partial(ScalarNode):
    """The partial derivative of f with respect to a coordinate or a rate, with all other variables held fixed.
    Arguments: f, the variable."""

    def doit(self, **hints: Any) -> Expr:
        f, variable = self.args
        return derivative(explicit(f), variable)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return quotient(*(of(arg) for arg in self.args))

    def lowered(self, text: TextOf) -> str:
        f, variable = (text(arg) for arg in self.args)
        return f"Derivative({f}, {variable})"


class TimeRate(ScalarNode):
    """df/dt along a motion. Arguments: f, then the coordinates that move.

    The value follows from the chain rule, with the partial derivative with respect to the time. This derivative
    includes the rates of prescribed functions.
    """

    def doit(self, **hints: Any) -> Expr:
        f, *coordinates = self.args
        value = explicit(f)
        moving = [rate(q, n) if n else q for q in coordinates for n in range(3)]
        present = value.free_symbols
        along = [derivative(value, s) * rate(s) for s in moving if s in present]
        return Add(*along, derivative(value, TIME))

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return quotient(of(self.args[0]), DURATION)

    def lowered(self, text: TextOf) -> str:
        return f"Derivative({text(self.args[0])}, t)"


class Slope(ScalarNode):
    """The n-th derivative of a function of one variable. Arguments: f, the variable, n."""

    def doit(self, **hints: Any) -> Expr:
        f, x, order = self.args
        return derivative(explicit(f), x, order)

    def dimension(self, of: DimensionOf) -> Dimension | None:
        f, x, order = self.args
        return quotient(of(f), power(of(x), Fraction(int(order))))

    def lowered(self, text: TextOf) -> str:
        f, x, order = self.args
        return f"Derivative({text(f)}, ({text(x)}, {order}))"


class At(ScalarNode):
    """The value of a function at one point. Arguments: f, the variable, its value."""

    def doit(self, **hints: Any) -> Expr:
        f, x, place = self.args
        return explicit(f).subs(x, place)

    dimension = dimension_of_first

    def lowered(self, text: TextOf) -> str:
        f, x, place = (text(arg) for arg in self.args)
        return f"Subs({f}, {x}, {place})"


class Truncated(ScalarNode):
    """A truncated series. Arguments: the polynomial, its variable, the expansion point, the highest order included."""

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0])

    dimension = dimension_of_first

    def lowered(self, text: TextOf) -> str:
        return text(self.args[0])


class Outer(MatrixNode):
    """The dyad a b: entries a_i b_j."""

    shape = (Integer(3), Integer(3))

    def _evaluated(self, a: Matrix, b: Matrix) -> Value:
        return ImmutableDenseMatrix(Matrix(a) * Matrix(b).T)

    dimension = product_of_dimensions

    def lowered(self, text: TextOf) -> str:
        a, b = (text(arg) for arg in self.args)
        return f"({a}*{b}.T)"


def _entries(vector: Value, text: TextOf) -> str:
    """The text of a vector; a vector without explicit entries is put in `Matrix(...)`, so that the text can be
    indexed."""
    return text(vector) if isinstance(vector, MatrixBase) else f"Matrix({text(vector)})"


def applied(operator: Value, v: Value) -> MatMul:
    """A tensor acting on a vector, not yet multiplied out."""
    return MatMul(operator, v, evaluate=False)


def scaled(factor: Expr, v: Value) -> MatMul:
    """A scalar times a vector or tensor, not yet multiplied out."""
    return MatMul(factor, v, evaluate=False)


def bound(expr: Value, values: Mapping[Any, Any]) -> Value:
    """The expression with these names replaced by their values."""
    return expr.xreplace(dict(values)) if values else expr


def with_known(value: Expr, known: Mapping[Symbol, Expr], moving: Sequence[Symbol]) -> Expr:
    """Substitute known coordinates and rates, those with constant values first: with z = 0, the root of r**2 + z**2
    becomes r before a formula replaces r."""
    return value.xreplace(constant_ones(known, moving)).xreplace(dict(known))


def constant_ones(known: Mapping[Symbol, Expr], moving: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Return the symbols in `known` whose values contain no coordinate and no rate, each with its value."""
    varying = {*moving, *map(rate, moving)}
    return {letter: each for letter, each in known.items() if varying.isdisjoint(each.free_symbols)}
