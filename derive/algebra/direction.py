"""A direction as the author gives it: by name, or by components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sympy import Expr


@dataclass(frozen=True)
class Direction:
    """Either a name that the body defines (`diagonal`, `x`) or three components along the body's axes."""

    name: str | None = None
    components: tuple[Expr, Expr, Expr] | None = None
