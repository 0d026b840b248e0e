"""Angular velocities given by their components along the body axes: constant, or known at one instant only."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr
from sympy.core.symbol import Str

from derive.algebra.expressions import column, vector
from derive.errors import Complaint, Rejected
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.vectors import Momentary, Through
from derive.steps.establish import PhraseData, Scope, establish
from derive.steps.record import require_constant
from derive.steps.rule import Rule
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["constant_angular_velocity", "momentary_angular_velocity"]


def constant_angular_velocity(
    components: Sequence[Expr], through: str = "centre", symbol: str = "omega", key: str = "angular_velocity"
) -> Quantity:
    """A constant angular velocity by its components along the body axes, in 1/s: a definition.

    components   the three components of the angular velocity, 1/s
    through      the point of the body that stays at rest

    Errors: there are not three components; all components vanish; a component changes in time.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8.
    """
    return _given("constant_angular_velocity", components, through, symbol, key)


def momentary_angular_velocity(
    components: Sequence[Expr], through: str = "centre", symbol: str = "omega", key: str = "angular_velocity"
) -> Quantity:
    """The angular velocity at one instant by its components along the body axes, in 1/s: a definition.

    components   the three components of the angular velocity, 1/s
    through      the point of the body that is at rest at this instant

    Errors: there are not three components; all components vanish; a component is not a constant.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8.
    """
    return _given("momentary_angular_velocity", components, through, symbol, key)


CONSTANT_ANGULAR_VELOCITY = Rule(
    "rotation.constant_angular_velocity",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8",
    outcomes={"generic": claims.given_as("constant"), "momentary": claims.given_as("momentary")},
)


def _given(verb: str, components: Sequence[Expr], through: str, symbol: str, key: str) -> Quantity:
    if len(components) != 3:
        message = f"an angular velocity needs three components, not {len(components)}"
        raise Rejected(Complaint("wrong-argument", message))
    omega = column(*components)
    if is_zero(omega):
        raise Rejected(Complaint("zero-vector", "a body whose angular velocity vanishes does not rotate"))
    for component in omega:
        require_constant(verb, "component", component)
    is_momentary = verb == "momentary_angular_velocity"
    return establish(
        CONSTANT_ANGULAR_VELOCITY,
        vector(symbol),
        lambda: omega,
        {},
        key=key,
        kind="angular speed",
        outcome="momentary" if is_momentary else "generic",
        facts=[Through(through), *([Momentary(through)] if is_momentary else [])],
        phrase_data=PhraseData(outcome_data={"verb": Str(verb), "given": tuple(components)}),
        scope=Scope(about=Subject(rotation=omega)),
    )
