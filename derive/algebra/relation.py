"""An equation or an inequality, as a node: two sides and the operator between them."""

from __future__ import annotations

from typing import Any

from sympy import Add, Expr, Integer
from sympy.core.symbol import Str

from derive.algebra.dimensions import Dimension
from derive.algebra.kinds import common
from derive.algebra.node import DimensionOf, Node, TextOf, explicit

MARKS = {"=": "equals", "!=": "unequal", "<": "less", ">": "greater", "<=": "at_most", ">=": "at_least"}
# operator -> the operator after the two sides are exchanged
TURNED = {">": "<", ">=": "<=", "<": ">", "<=": ">=", "=": "=", "!=": "!="}
_IN_SYMPY = {"=": "Eq", "!=": "Ne", "<": "Lt", ">": "Gt", "<=": "Le", ">=": "Ge"}


class Relation(Node):
    """An equation or an inequality. Arguments: the left side, the operator as text, the right side."""

    def __new__(cls, left: Any, operator: str | Str, right: Any) -> Relation:
        operator = Str(operator) if isinstance(operator, str) else operator
        return super().__new__(cls, sympify_number(left), operator, sympify_number(right))  # type: ignore[no-any-return]

    @property
    def left(self) -> Any:
        return self.args[0]

    @property
    def operator(self) -> str:
        return str(self.args[1].name)

    @property
    def right(self) -> Any:
        return self.args[2]

    @property
    def sides(self) -> tuple[Any, Any]:
        return self.args[0], self.args[2]

    @property
    def word(self) -> str:
        """The name by which formulas of pages refer to the operator, such as `equals` or `less`."""
        return MARKS[self.operator]

    @property
    def residual(self) -> Expr:
        """The left side minus the right side: zero in an equation, positive for ">", negative for "<"."""
        return self.left - self.right

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return common(self.sides, of)

    def lowered(self, text: TextOf) -> str:
        left, right = (text(side) for side in self.sides)
        return f"{_IN_SYMPY[self.operator]}({left}, {right}, evaluate=False)"

    def doit(self, **hints: Any) -> Relation:
        return Relation(explicit(self.left), self.args[1], explicit(self.right))

    def __str__(self) -> str:
        return f"{self.left} {self.operator} {self.right}"


def sides_without_minus(total: Expr) -> tuple[Expr, Expr]:
    """The added and the subtracted terms of a sum: a + b and c for a + b - c."""
    away = [-term for term in Add.make_args(total) if term.could_extract_minus_sign()]
    return Add(*(term for term in Add.make_args(total) if not term.could_extract_minus_sign())), Add(*away)


def sympify_number(value: Any) -> Any:
    """A plain whole number as a SymPy integer; any other value unchanged."""
    return Integer(value) if isinstance(value, int) else value
