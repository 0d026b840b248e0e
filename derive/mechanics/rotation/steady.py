"""Steady rotation that is given by its components along the axes of the body."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Integer

from derive.algebra.expressions import column, vector
from derive.errors import Complaint, Rejected
from derive.mechanics.rotation.vectors import Through
from derive.steps.establish import Scope, establish
from derive.steps.record import require_constant
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["constant_angular_velocity"]


def constant_angular_velocity(
    components: Sequence[Expr], through: str = "centre", symbol: str = "omega", key: str = "angular_velocity"
) -> Quantity:
    """A constant angular velocity by its components along the axes of the body, in 1/s: a definition.

    components   three, 1/s
    through      the point of the body that stays at rest
    Errors: not three components; all of them vanish; one of them changes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8.
    """
    if len(components) != 3:
        raise Rejected(Complaint("wrong-argument", f"an angular velocity has three components, not {len(components)}"))
    omega = column(*(Integer(0) + component for component in components))
    if is_zero(omega):
        raise Rejected(Complaint("zero-vector", "a body whose angular velocity vanishes does not turn"))
    for component in omega:
        require_constant("constant_angular_velocity", "component", component)
    return establish(
        "steady.constant_angular_velocity",
        vector(symbol),
        lambda: omega,
        {},
        key=key,
        definition=True,
        kind="angular speed",
        facts=[Through(through)],
        scope=Scope(about=Subject(rotation=omega)),
    )
