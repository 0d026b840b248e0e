"""Nodes for a number with its unit, `2 cm`, and for a vector or tensor whose entries share one unit."""

from __future__ import annotations

from typing import Any

from sympy import Expr
from sympy.core.symbol import Str

from derive.algebra.dimensions import Dimension
from derive.algebra.node import DimensionOf, MatrixNode, ScalarNode, TextOf, Value, explicit

IN_DEGREES = frozenset({"deg", "degree", "degrees", "\u00b0"})  # the names of the unit "degree"


class Amount(ScalarNode):
    """A number with its unit, `2 cm`. Arguments: the number, the unit as text, the value of this unit in SI units."""

    def __new__(cls, number: Expr, unit: str | Str, factor: Expr) -> Amount:
        return super().__new__(cls, number, Str(unit) if isinstance(unit, str) else unit, factor)  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Expr:
        return explicit(self.args[0]) * self.args[2]

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return None

    def lowered(self, text: TextOf) -> str:
        return f"({text(self.args[0])}*{text(self.args[2])})"


class MatrixAmount(MatrixNode):
    """A vector or tensor in one unit. Arguments: the numbers, the unit as text, the value of this unit in SI units."""

    def __new__(cls, numbers: Any, unit: str | Str, factor: Expr) -> MatrixAmount:
        return super().__new__(cls, numbers, Str(unit) if isinstance(unit, str) else unit, factor)  # type: ignore[no-any-return]

    @property
    def shape(self) -> tuple[Any, Any]:
        return self.args[0].shape  # type: ignore[no-any-return]

    def doit(self, **hints: Any) -> Value:
        return explicit(self.args[0]) * self.args[2]

    def dimension(self, of: DimensionOf) -> Dimension | None:
        return None

    def lowered(self, text: TextOf) -> str:
        return f"({text(self.args[2])}*{text(self.args[0])})"
