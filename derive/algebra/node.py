"""The base classes of the unevaluated forms of `derive.algebra.expressions`, and their evaluation.

A node defines its value (`doit`), its dimension (`dimension`), and its equivalent in SymPy without these classes
(`lowered`). `NODES` lists all classes of nodes, so that nodes can be encoded as lists and decoded.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, TypeAlias

from sympy import (
    Add,
    Basic,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatrixBase,
    MatrixExpr,
    MatrixSymbol,
    Mul,
    Pow,
    cos,
    nan,
    sin,
)

from derive.algebra.dimensions import Dimension, product
from derive.algebra.integrals import definite, has_root

Value: TypeAlias = Any  # an Expr, an ImmutableMatrix or a MatrixExpr: SymPy has no common type for them

# A function that returns the dimension of a part of a node; its second argument has the dimensions of the variables
# that the node binds.
DimensionOf: TypeAlias = Callable[..., Dimension | None]
# A function that returns the plain SymPy text of a part, valid as a factor; its second argument has the variables that
# the node binds.
TextOf: TypeAlias = Callable[..., str]

NODES: dict[str, Any] = {}  # every kind of node by its name


class Node(Basic):
    """Base class of all unevaluated forms."""

    def __init_subclass__(cls, abstract: bool = False, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if abstract:
            return
        if cls.__name__ in NODES:
            raise TypeError(f"a node {cls.__name__} already exists")
        NODES[cls.__name__] = cls

    def __new__(cls, *args: Any) -> Any:
        return super().__new__(cls, *(Integer(arg) if isinstance(arg, int) else arg for arg in args))

    def doit(self, **hints: Any) -> Value:
        if not hints.get("deep", True):
            return self._evaluated(*self.args)
        return self._evaluated(*(explicit(arg) if isinstance(arg, Basic | MatrixBase) else arg for arg in self.args))

    def _evaluated(self, *args: Any) -> Value:
        raise AttributeError(f"{type(self).__name__} must define `_evaluated`")

    def dimension(self, of: DimensionOf) -> Dimension | None:
        """The dimension of the node; may raise `Inhomogeneous`."""
        raise AttributeError(f"{type(self).__name__} must define `dimension`")

    @property
    def variables(self) -> tuple[Any, ...]:
        """The variables that the node binds; they are not free symbols."""
        return ()

    def lowered(self, text: TextOf) -> str:
        """The node in plain SymPy, as text that is valid as a factor."""
        raise AttributeError(f"{type(self).__name__} must define `lowered`")


def dimension_of_first(node: Node, of: DimensionOf) -> Dimension | None:
    return of(node.args[0])


def product_of_dimensions(node: Node, of: DimensionOf) -> Dimension | None:
    return product(of(arg) for arg in node.args)


class ScalarNode(Node, Expr, abstract=True):
    """A node whose value is a real number."""

    is_commutative = True
    is_real = True


class MatrixNode(Node, MatrixExpr, abstract=True):
    """A node whose value is a matrix, such as a vector or a tensor."""

    def _entry(self, i: Any, j: Any, **_: Any) -> Expr:
        return explicit(self)[i, j]


class VectorNode(MatrixNode, abstract=True):
    """A node whose value is a column of three entries."""

    shape = (Integer(3), Integer(1))


def as_expr(value: Any) -> Any:
    """Convert to an expression: a plain integer to a SymPy integer, a coordinate to its symbol."""
    return Integer(0) + value


def explicit(expr: Value) -> Value:
    """Evaluate every node, and write matrix expressions without named matrices as explicit matrices."""
    if isinstance(expr, MatrixBase):
        return ImmutableDenseMatrix(expr.applyfunc(explicit))
    if isinstance(expr, Basic):
        return _carried_out(expr)
    if not isinstance(expr, int):  # SymPy would cut 1.5 to 1
        raise TypeError(f"{expr!r} is not an exact number")
    return Integer(expr)


@lru_cache(maxsize=16384)
def _carried_out(expr: Basic) -> Value:
    if type(expr) in (Add, Mul, Pow, sin, cos):
        return expr.func(*map(_carried_out, expr.args))
    if expr.is_Atom:
        return expr
    value = _definite(expr) if isinstance(expr, Integral) else expr.doit()
    if isinstance(value, MatrixExpr) and not value.has(MatrixSymbol):
        value = value.as_explicit()
    return ImmutableDenseMatrix(value) if isinstance(value, MatrixBase) else value


def _definite(integral: Integral) -> Expr:
    """Evaluate a definite integral by the rules of `derive.algebra.integrals` or, if these do not apply, by SymPy.

    If the rules do not apply to an integral with a root, the result is `nan`, which is equal to no value. For such an
    integral, SymPy may return a wrong value or may not terminate.
    """
    integrand = explicit(integral.function)
    value = definite(integrand, integral.limits)
    if value is not None:
        return value
    ends = [end for _, *limits in integral.limits for end in limits]
    return nan if any(has_root(part) for part in [integrand, *ends]) else integral.doit()
