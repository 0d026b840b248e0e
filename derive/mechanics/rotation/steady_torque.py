"""The torque that keeps a rotation steady, omega x L. Vector components are along the body axes."""

from __future__ import annotations

from typing import Any

from sympy import Integer, MatAdd

from derive.algebra.expressions import (
    AXES,
    BodyRate,
    CarriedRate,
    Cross,
    Factors,
    Terms,
    column,
    component_names,
    scaled,
    vector,
)
from derive.algebra.tidy import factored_matrix, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.facts import AboutPoint
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.vectors import Momentary, RateOfTurning, whether_zero
from derive.mechanics.theorems import ROTATING_AXES
from derive.steps.claims import vanishes
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import require_constant
from derive.steps.rule import ROUTE, Quote, Rule
from derive.steps.step import Form, Level, Quantity, compared_with, require_kind

__all__ = ["torque"]


TORQUE = Rule(
    "rotation.torque",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 4.9 and 5.5",
    outcomes={"zero": vanishes, "generic": claims.torque_generic, "in_general": claims.torque_in_general},
    evidence={"carried_round": ROUTE},
    statements=[claims.of_their_kinds_by_euler],
    quotes=[Quote(ROTATING_AXES)],
)


def torque(omega: Quantity, momentum: Quantity, symbol: str = "tau", key: str = "torque") -> Quantity:
    """Torque for a steady rotation, in which L rotates with the body: tau = dL/dt = omega x L.

    omega      vector (3), 1/s, along the body axes, constant
    momentum   angular momentum L, vector (3), kg m^2/s, along the same axes, about a fixed point or the centre of mass,
               constant in the body

    Second route: rotate L about omega by a rotation matrix and differentiate.
    Outcomes: zero (omega is along a principal axis), generic (the torque is never zero), in_general (the torque may be
    zero for some values of the symbols).
    Errors: omega or L changes in the body; omega is known at one instant only; L is the angular momentum of a different
    rotation; `momentum` is not an angular momentum, or `omega` is not an angular velocity.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 4.9 and 5.5.
    """
    require_kind("torque", "omega", omega, "angular speed")
    require_kind("torque", "momentum", momentum, "angular momentum")
    help_line = "for a rotation that changes, use `rate_in_space`"
    require_constant("torque", "angular velocity", omega, help_line)
    require_constant("torque", "angular momentum in the body", momentum, help_line)
    if omega.fact(Momentary) is not None:
        message = f"`torque` needs a steady rotation, but `{omega.key}` is known at one instant only"
        raise Rejected(Complaint("wrong-argument", message))
    about = momentum.needed(AboutPoint).point.name
    (f, u), (g, v) = (factored_matrix(q.value) for q in (omega, momentum))
    carried = CarriedRate(momentum.value, omega.value)
    inertia = momentum.needed(RateOfTurning).inertia
    by_euler = _by_euler(omega, inertia)
    level = Level.FULL if by_euler else Level.STANDARD
    return establish(
        TORQUE,
        vector(symbol),
        Cross,
        {"omega": omega, "momentum": momentum},
        lines=Lines(
            before=[
                Form(CarriedRate(momentum.symbol, omega.symbol), "law"),
                Form(MatAdd(BodyRate(momentum.symbol), Cross(omega.symbol, momentum.symbol)), "moving_axes"),
            ],
            between=[*by_euler, Form(scaled(tidied(f * g), Cross(u, v)), "collected", level)],
            put_in=None if by_euler else Level.FULL,
        ),
        routes={"carried_round": compared_with(lambda: carried)},
        outcome=whether_zero,
        key=key,
        kind="torque",
        parents=[*_moments(inertia), inertia],
        phrase_data=PhraseData(
            words={"about": about, "point": about, **({"euler": about} if by_euler else {})},
            points_to={"tensor": inertia},
            outcome_data={"inertia": inertia.value},
        ),
    )


def _by_euler(omega: Quantity, inertia: Quantity) -> list[Form]:
    """Return a list with the line ((I_z - I_y) omega_y omega_z, ...), Euler's equations without omega_dot.

    The list is empty if the axes are not principal axes.
    """
    if not inertia.value.is_diagonal():
        return []
    named = {parent.key[-2:]: parent for parent in _moments(inertia)}
    letters = {parent.value: parent.symbol for parent in named.values()}
    values = [inertia.value[k, k] for k in range(3)]
    I: list[Any] = [
        named[axis * 2].symbol if axis * 2 in named else letters.get(m) for axis, m in zip(AXES, values, strict=True)
    ]
    I = values if None in I else I
    w = component_names(omega.symbol.name)
    parts = [
        Factors(Terms(I[k - 1], -I[k - 2]), w[k - 2], w[k - 1]) if I[k - 1] != I[k - 2] else Integer(0)
        for k in range(3)
    ]
    return [Form(column(*parts), "euler")]


def _moments(inertia: Quantity) -> list[Quantity]:
    keys = {f"{inertia.key}_{axis * 2}" for axis in AXES}
    return [parent for parent in inertia.parents if parent.key in keys]
