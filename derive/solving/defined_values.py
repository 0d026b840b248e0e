"""Reject values of a result that are infinite, undefined or complex."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr, MatrixBase, Pow

from derive.algebra.expressions import Relation, explicit
from derive.algebra.singular import has_no_value, is_not_real, undefined_part
from derive.errors import Complaint, Rejected


def check_defined(verb: str, called: str, where: str, value: Any, put: Callable[[Any], Any]) -> None:
    """Reject a result that has no real value after symbols are replaced.

    verb     the verb that replaces the symbols
    called   the name of the result
    where    the substitution as text: `alpha = pi/2`
    value    the result before the substitution
    put      a function that replaces the symbols in an expression
    """
    sides = value.sides if isinstance(value, Relation) else value if isinstance(value, MatrixBase) else (value,)
    for side in sides:
        part = undefined_part(side, put)
        after = put(explicit(side))
        if part is not None:
            vanishes = not has_no_value(put(part))
            what = f"the denominator {part} of `{called}` vanishes" if vanishes else f"{part} in `{called}` is infinite"
            _refuse(f"`{verb}`: for {where}, {what}")
        if has_no_value(after):
            _refuse(f"`{verb}`: for {where}, `{called}` has no finite value")
        if is_not_real(after) and not is_not_real(side):
            below = next((p.base for p in explicit(side).atoms(Pow) if _is_negative_root(p, put)), None)
            why = f", because {below} is negative under a root" if below is not None else ""
            message = f"`{verb}`: for {where}, `{called}` is not a real number{why}"
            raise Rejected(Complaint("not-real", message, help="give values for which the result is real"))


def _refuse(message: str) -> None:
    help_line = "use `limit` for the limit of a result, or give another value"
    raise Rejected(Complaint("no-value", message, help=help_line))


def _is_negative_root(power: Pow, put: Callable[[Expr], Any]) -> bool:
    return bool(power.exp.is_Rational and power.exp.q == 2 and put(power.base).is_negative)
