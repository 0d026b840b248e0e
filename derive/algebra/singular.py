"""Find where an expression has no value: a denominator that vanishes, or a function that is infinite."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from sympy import Expr, MatrixBase, S, postorder_traversal
from sympy.core.function import Function

from derive.algebra.node import explicit
from derive.algebra.normal_form import vanishes

_INFINITE = (S.ComplexInfinity, S.Infinity, S.NegativeInfinity, S.NaN)


def has_no_value(value: Any) -> bool:
    """Whether a part of the value is infinite or undefined."""
    return bool(getattr(value, "has", None) and value.has(*_INFINITE))


def is_not_real(value: Any) -> bool:
    """Whether the value contains the imaginary unit."""
    return bool(getattr(value, "has", None) and value.has(S.ImaginaryUnit))


def undefined_part(before: Any, put: Callable[[Expr], Any]) -> Expr | None:
    """A part that makes an expression undefined after symbols are replaced: a denominator that becomes zero, or a
    function that becomes infinite. None if there is no such part.

    put   a function that replaces the symbols in a part
    """
    for part in _parts(before):
        if part.is_Pow and part.exp.is_negative:
            if (there := put(part.base)) != part.base and _vanishes(there):
                return part.base
        elif isinstance(part, Function) and has_no_value(put(part)):
            return part
    return None


def _parts(value: Any) -> Iterator[Expr]:
    for each in value if isinstance(value, MatrixBase) else [value]:
        yield from (part for part in postorder_traversal(explicit(each)) if isinstance(part, Expr))


def _vanishes(value: Any) -> bool:
    return not has_no_value(value) and bool(value == 0 or vanishes(explicit(value)))
