"""A Lagrangian that is given, as `given:` describes it, and the keys that cannot be used with it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from sympy import Expr

from derive.algebra.kinds import kind_of_dimension
from derive.course.stock import InLetters
from derive.course.yaml_tree import Tree
from derive.errors import Place, rejected

WITH_BODIES = (
    "axes",
    "places",
    "particles",
    "bodies",
    "rolling",
    "gravity",
    "springs",
    "central",
    "potential",
    "charges",
    "constraints",
    "impact",
)


class WithLagrangian(Protocol):
    """Keys among which a Lagrangian may be given, with their places."""

    @property
    def lagrangian(self) -> Tree | None: ...
    @property
    def places(self) -> Mapping[str, Place]: ...


def read_lagrangian(written: WithLagrangian, letters: InLetters) -> tuple[Expr, str | None] | None:
    """Return the formula, and the kind of quantity that it is, if that has a name."""
    if written.lagrangian is None:
        return None
    beside = next((name for name in WITH_BODIES if name in written.places), None)
    if beside is not None:
        message = f"`{beside}` cannot be combined with `lagrangian`, which replaces bodies and forces"
        rejected("given-lagrangian", message, written.places[beside], "include it in the formula")
    value, dimension = letters.read(written.lagrangian, "lagrangian", "a formula of coordinates and rates")
    return value, kind_of_dimension(dimension)
