"""Names, and the unevaluated forms in which mechanics is written down.

A *name* is what a formula calls something: a SymPy `Symbol` for a scalar, a `MatrixSymbol` of shape (3, 1) for a
vector and (3, 3) for a tensor. A *node* is an operation that is shown before it is carried out: `Dot(omega, L)`.
`explicit()` carries everything out. Nodes know no notation; `derive.render` does.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, TypeAlias

from sympy import (
    Add,
    Basic,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatMul,
    Matrix,
    MatrixBase,
    MatrixExpr,
    MatrixSymbol,
    Symbol,
    Tuple,
    diff,
    nan,
    sqrt,
)
from sympy.core.symbol import Str
from sympy.matrices import ImmutableMatrix

from derive.integrals import definite, has_root

Value: TypeAlias = Any  # an Expr, an ImmutableMatrix or a MatrixExpr: SymPy has no common type for them

AXES = ("x", "y", "z")


def scalar(name: str, **assumptions: bool) -> Symbol:
    """A real scalar by name; more is assumed of it only when said."""
    return Symbol(name, **{"real": True, **assumptions})


PLUS_MINUS = scalar("\u00b1", nonzero=True)  # a sign that is either: its square is 1, so b + PLUS_MINUS*c is b +- c

RATES = ("", "_dot", "_ddot", "_dddot")


def rate(coordinate: Symbol, order: int = 1) -> Symbol:
    """The name of a coordinate's rate of change: theta -> theta_dot, theta_dot -> theta_ddot."""
    name = coordinate.name
    now = next(n for n in (3, 2, 1, 0) if name.endswith(RATES[n]))
    return scalar(name.removesuffix(RATES[now]) + RATES[now + order])


def vector(name: str) -> MatrixSymbol:
    return MatrixSymbol(name, 3, 1)


def tensor(name: str) -> MatrixSymbol:
    return MatrixSymbol(name, 3, 3)


def component_names(name: str) -> tuple[Symbol, Symbol, Symbol]:
    """The scalars that stand for a vector's components: `omega` -> omega_x, omega_y, omega_z."""
    x, y, z = (scalar(f"{name}_{axis}") for axis in AXES)
    return x, y, z


def column(*components: Any) -> ImmutableMatrix:
    return ImmutableDenseMatrix(3, 1, list(components))


def is_matrix(value: Any) -> bool:
    return isinstance(value, MatrixBase | MatrixExpr)


class Node(Basic):
    """What every unevaluated form shares: `doit()` evaluates the operands, then `_evaluated` the form itself."""

    def doit(self, **hints: Any) -> Value:
        if not hints.get("deep", True):
            return self._evaluated(*self.args)
        return self._evaluated(*(explicit(arg) if isinstance(arg, Basic | MatrixBase) else arg for arg in self.args))

    def _evaluated(self, *args: Any) -> Value:
        raise AttributeError(f"{type(self).__name__} must say how it is evaluated")


class ScalarNode(Node, Expr):
    """A node whose value is a real number."""

    is_commutative = True
    is_real = True


class VectorNode(Node, MatrixExpr):
    """A node whose value is a column of three."""

    shape = (Integer(3), Integer(1))

    def _entry(self, i: Any, j: Any, **_: Any) -> Expr:
        return explicit(self)[i, j]


class Dot(ScalarNode):
    """a . b"""

    def _evaluated(self, a: Matrix, b: Matrix) -> Expr:
        return sum((x * y for x, y in zip(a, b, strict=True)), Integer(0))


class Norm(ScalarNode):
    """|a|"""

    is_nonnegative = True

    def _evaluated(self, a: Matrix) -> Expr:
        return sqrt(sum((x**2 for x in a), Integer(0)))


class Cross(VectorNode):
    """a x b"""

    def _evaluated(self, a: Matrix, b: Matrix) -> ImmutableMatrix:
        return column(
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        )


class CarriedRate(VectorNode):
    """dA/dt in space of a vector A that turns with angular velocity omega. Arguments: A, omega, and the coordinates
    that move; without any, A is constant in the body.

    Evaluated by carrying A round and differentiating, not by omega x A: A(t) = R(t) A, where the columns of R(t) are
    the body's axes after the time t. The rotation is Euler's: rotate about z and y until omega lies along z, turn by
    |omega| t, rotate back.
    """

    def _evaluated(self, a: Matrix, omega: Matrix, *moving: Symbol) -> ImmutableMatrix:
        in_body = Matrix([explicit(TimeRate(component, *moving)) for component in a])
        rate = sqrt(sum((w**2 for w in omega), Integer(0)))
        if rate == 0:
            return ImmutableDenseMatrix(in_body)
        t = Symbol("t", real=True)
        to_z = _rotation_onto_z(omega / rate)
        turn = Matrix([[_c(rate * t), -_s(rate * t), 0], [_s(rate * t), _c(rate * t), 0], [0, 0, 1]])
        # The turn alone depends on time, so it alone is differentiated.
        return ImmutableDenseMatrix(in_body + to_z.T * diff(turn, t).subs(t, 0) * to_z * Matrix(a))


def _c(x: Expr) -> Expr:
    from sympy import cos

    return cos(x)


def _s(x: Expr) -> Expr:
    from sympy import sin

    return sin(x)


def _rotation_onto_z(n: Matrix) -> Matrix:
    """The rotation about z, then y, that brings the unit vector n onto the z axis."""
    level = sqrt(n[0] ** 2 + n[1] ** 2)
    cos_phi, sin_phi = (n[0] / level, n[1] / level) if level != 0 else (Integer(1), Integer(0))
    about_z = Matrix([[cos_phi, sin_phi, 0], [-sin_phi, cos_phi, 0], [0, 0, 1]])
    about_y = Matrix([[n[2], 0, -level], [0, 1, 0], [level, 0, n[2]]])
    return about_y * about_z


class BodyRate(VectorNode):
    """dA/dt as seen in the body. Arguments: A, and the coordinates that move; without any, A is constant there."""

    def _evaluated(self, a: Matrix, *moving: Symbol) -> ImmutableMatrix:
        return column(*(explicit(TimeRate(component, *moving)) for component in a))


class Component(ScalarNode):
    """The component of a vector along an axis. Arguments: the vector, the axis as text."""

    def __new__(cls, v: Any, axis: str | Str) -> Component:
        return super().__new__(cls, v, Str(axis) if isinstance(axis, str) else axis)  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0])[AXES.index(self.args[1].name)]


class Group(ScalarNode):
    """A value kept together in its bracket: the `(6 a^3 rho)` that is about to become M."""

    def __new__(cls, inner: Expr) -> Expr:
        return inner if isinstance(inner, Group) else super().__new__(cls, inner)

    def _evaluated(self, inner: Expr) -> Expr:
        return inner


class Factors(ScalarNode):
    """Factors as written, in that order: `a * 3a * [y^3/3]`."""

    def _evaluated(self, *factors: Expr) -> Expr:
        result: Expr = Integer(1)
        for factor in factors:
            result = result * factor
        return result


class Terms(ScalarNode):
    """Terms as written, in that order, none collected: `8a^5 + 18a^5`."""

    def _evaluated(self, *terms: Expr) -> Expr:
        result: Expr = Integer(0)
        for term in terms:
            result = result + term
        return result


class Ratio(ScalarNode):
    """A fraction as written, nothing cancelled."""

    def _evaluated(self, numerator: Expr, denominator: Expr) -> Expr:
        return numerator / denominator


class Root(ScalarNode):
    """A square root as written, nothing drawn out of it."""

    def _evaluated(self, inside: Expr) -> Expr:
        return sqrt(inside)


class Bracket(ScalarNode):
    """[F(x)] between two limits: an antiderivative, before the limits are put in. Arguments F, x, lower, upper."""

    def doit(self, **hints: Any) -> Expr:
        antiderivative, x, lower, upper = self.args
        f = explicit(antiderivative)
        return f.subs(x, upper) - f.subs(x, lower)


class Amount(ScalarNode):
    """A number with its unit, `2 cm`. Arguments: the number, the unit as text, the factor to the SI unit."""

    def __new__(cls, number: Expr, unit: str | Str, factor: Expr) -> Amount:
        return super().__new__(cls, number, Str(unit) if isinstance(unit, str) else unit, factor)  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0]) * self.args[2]


class MatrixAmount(Node, MatrixExpr):
    """A vector or tensor of numbers with one unit. Arguments: the numbers, the unit as text, the factor to the SI."""

    def __new__(cls, numbers: Any, unit: str | Str, factor: Expr) -> MatrixAmount:
        return super().__new__(cls, numbers, Str(unit) if isinstance(unit, str) else unit, factor)  # type: ignore[no-any-return]

    @property
    def shape(self) -> tuple[Any, Any]:
        return self.args[0].shape  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Value:
        return explicit(self.args[0]) * self.args[2]

    def _entry(self, i: Any, j: Any, **_: Any) -> Expr:
        return explicit(self)[i, j]


class Partial(ScalarNode):
    """The partial derivative of f by a coordinate or by a rate, all others held fixed. Arguments: f, the variable."""

    def doit(self, **hints: Any) -> Expr:
        f, variable = self.args
        return diff(explicit(f), variable)


class TimeRate(ScalarNode):
    """df/dt along a motion. Arguments: f, then the coordinates that move.

    Evaluated by the chain rule: each coordinate, and each of its rates, contributes its partial derivative times the
    next rate.
    """

    def doit(self, **hints: Any) -> Expr:
        f, *coordinates = self.args
        value = explicit(f)
        moving = [rate(q, n) if n else q for q in coordinates for n in range(3)]
        return Add(*(diff(value, s) * rate(s) for s in moving if s in value.free_symbols))


class Slope(ScalarNode):
    """The n-th derivative of a function of one variable. Arguments: f, the variable, n."""

    def doit(self, **hints: Any) -> Expr:
        f, x, order = self.args
        return diff(explicit(f), x, order)


class At(ScalarNode):
    """The value of a function at one place. Arguments: f, the variable, its value."""

    def doit(self, **hints: Any) -> Expr:
        f, x, place = self.args
        return explicit(f).subs(x, place)


class Truncated(ScalarNode):
    """A series that breaks off: the polynomial, its variable, the place it is about, the order up to which it holds."""

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0])


MARKS = {"=": "equals", "!=": "unequal", "<": "less", ">": "greater", "<=": "at_most", ">=": "at_least"}


class Relation(Node):
    """An equation or an inequality. Arguments: the left side, the mark as text, the right side."""

    def __new__(cls, left: Any, mark: str | Str, right: Any) -> Relation:
        mark = Str(mark) if isinstance(mark, str) else mark
        return super().__new__(cls, sympify_number(left), mark, sympify_number(right))  # type: ignore[no-any-return]

    @property
    def left(self) -> Any:
        return self.args[0]

    @property
    def mark(self) -> str:
        return str(self.args[1].name)

    @property
    def right(self) -> Any:
        return self.args[2]

    @property
    def sides(self) -> tuple[Any, Any]:
        return self.args[0], self.args[2]

    @property
    def word(self) -> str:
        """The mark as a page's tree names it."""
        return MARKS[self.mark]

    @property
    def residual(self) -> Expr:
        """Left minus right: what vanishes, or has the sign that the mark says."""
        return self.left - self.right

    def doit(self, **hints: Any) -> Relation:
        return Relation(explicit(self.left), self.args[1], explicit(self.right))

    def __str__(self) -> str:
        return f"{self.left} {self.mark} {self.right}"


def sympify_number(value: Any) -> Any:
    """A plain whole number as a SymPy one; anything else as it is."""
    return Integer(value) if isinstance(value, int) else value


class MassIntegral(Node, MatrixExpr):
    """The integral of f(r) dm over a body, f a vector or a tensor.

    Arguments: f in terms of the vector name r; r; the density; the position and the volume element's factor in the
    coordinates of the region; the limits, innermost first.
    """

    @property
    def shape(self) -> tuple[Any, Any]:
        return self.args[0].shape  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Value:
        integrand, r, density, position, jacobian, *limits = self.args
        at = explicit(integrand.xreplace({r: position}))
        outside, inside = density.as_independent(*(x for x, *_ in limits), as_Add=False)
        return at.applyfunc(lambda f: outside * explicit(Integral(inside * f * jacobian, *limits)))

    def _entry(self, i: Any, j: Any, **_: Any) -> Expr:
        return explicit(self)[i, j]


class Outer(Node, MatrixExpr):
    """The dyad a b: entries a_i b_j."""

    shape = (Integer(3), Integer(3))

    def _evaluated(self, a: Matrix, b: Matrix) -> Value:
        return ImmutableDenseMatrix(Matrix(a) * Matrix(b).T)

    def _entry(self, i: Any, j: Any, **_: Any) -> Expr:
        return explicit(self)[i, j]


def applied(operator: Value, v: Value) -> MatMul:
    """A tensor acting on a vector, not yet multiplied out."""
    return MatMul(operator, v, evaluate=False)


def scaled(factor: Expr, v: Value) -> MatMul:
    """A scalar times a vector or tensor, not yet multiplied out."""
    return MatMul(factor, v, evaluate=False)


def explicit(expr: Value) -> Value:
    """The expression with every node carried out, and matrices as explicit matrices."""
    if isinstance(expr, MatrixBase):
        return ImmutableDenseMatrix(expr.applyfunc(explicit))
    return _carried_out(expr) if isinstance(expr, Basic) else Integer(expr)


@lru_cache(maxsize=4096)  # each line of a chain is compared with the one before and the one after
def _carried_out(expr: Basic) -> Value:
    value = _definite(expr) if isinstance(expr, Integral) else expr.doit()
    if isinstance(value, MatrixExpr) and not value.has(MatrixSymbol):
        value = value.as_explicit()
    return ImmutableDenseMatrix(value) if isinstance(value, MatrixBase) else value


def _definite(integral: Integral) -> Expr:
    """A definite integral: by the kinds that solids need, for which SymPy's integrator is slow, else by SymPy.

    An integral over a root of its variable that is of no such kind is left undefined, which equals nothing: there
    SymPy may be wrong, or not come back.
    """
    integrand = explicit(integral.function)
    value = definite(integrand, integral.limits)
    if value is not None:
        return value
    ends = [end for _, *limits in integral.limits for end in limits]
    return nan if any(has_root(part) for part in [integrand, *ends]) else integral.doit()


def bound(expr: Value, values: Mapping[Any, Any]) -> Value:
    """The expression with names replaced by what they stand for."""
    return expr.xreplace(dict(values)) if values else expr


def tuple_of_limits(limits: Sequence[tuple[Symbol, Expr, Expr]]) -> list[Tuple]:
    return [Tuple(*limit) for limit in limits]
