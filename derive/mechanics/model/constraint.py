"""Constraints enforced by forces: relations f(q, t) = c between coordinates, or relations linear in their rates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, diff

from derive.algebra.expressions import Relation, TimeRate, as_expr, explicit, rate, scalar
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.model.connection import PointForce
from derive.mechanics.model.dalembert import Load, Reaction
from derive.mechanics.model.part import Part
from derive.steps.record import coordinates_in
from derive.steps.signs import sign_known
from derive.steps.step import Fact, is_zero
from derive.witness import description as plain

__all__ = ["constraint"]

ZERO, ONE = Integer(0), Integer(1)


@dataclass(frozen=True)
class StaticLimit:
    """The largest static friction: |F| <= mu_s N, for a rail |F| <= mu_s |N|.

    coefficient   the coefficient of static friction, mu_s
    normal        the symbol of the normal force of the same contact
    slider        the name of the body that would slip, such as "block"; empty if the author gave no name
    of_rail       whether the normal force may have either sign
    in_space      whether the friction has two components; the limit is then the limit of its magnitude
    """

    coefficient: Expr
    normal: Symbol
    slider: str = ""
    of_rail: bool = False
    in_space: bool = False

    @property
    def words(self) -> dict[str, str]:
        return {"slider": self.slider or "body"}


@dataclass(frozen=True)
class Constraint(Part):
    """A constraint that a force enforces.

    For a constraint f = c on coordinates, the virtual work of the force is lambda df. For a constraint
    a_1 q_1_dot + a_2 q_2_dot + ... = c on rates, this work is lambda (a_1 dq_1 + a_2 dq_2 + ...).

    left      f, or a_1 q_1_dot + ...
    right     c, as written in the script
    force     the symbol of the multiplier; if `gradient` is not 1, the symbol of the force
    in_rates  whether the constraint is linear in the rates
    forces    the forces on material points, if they are known; second routes use these forces in place of the
              derivatives of f
    enforcer  what enforces the constraint: "surface", "rail", "string", "rod", "friction", "joint" or "motor"; empty if
              the enforcer is unknown
    limit     for static friction with a known coefficient: the largest value of the friction
    gradient  the length of the gradient of f for a curve, otherwise 1; the multiplier is `force` divided by `gradient`
    """

    left: Expr
    right: Expr
    force: Symbol
    in_rates: bool = False
    forces: tuple[PointForce, ...] = ()
    enforcer: str = ""
    limit: StaticLimit | None = None
    gradient: Expr = ONE

    def moved(self, known: Mapping[Symbol, Expr]) -> Constraint:
        if not self.forces:
            return self
        forces = tuple(each.moved(known) for each in self.forces)
        left, right, gradient = (each.subs(known) for each in (self.left, self.right, self.gradient))
        return replace(self, left=left, right=right, forces=forces, gradient=gradient)

    @property
    def acting(self) -> list[PointForce]:
        """The forces on bodies and particles; forces on the ground and on massless pulleys are left out."""
        return [each for each in self.forces if each.of is not None]

    def sense(self, side: int) -> str:
        """Return the direction of the force on the first body, if the symbol of the force has the sign `side`.

        The result is "up", "down", "right" or "left". If the sign of the vertical component is known and not zero,
        this sign decides; otherwise the sign of the horizontal component decides. The result is empty for a motion in
        space, or if the direction is unknown.
        """
        signs = [sign_known(side * c) for each in self.acting[:1] for c in each.direction]
        if len(signs) != 2 or not (signs[1] or signs[0]):
            return ""
        words = {1: "up", -1: "down"} if signs[1] else {1: "right", -1: "left"}
        return words[signs[1] or signs[0] or 0]

    def acts(self, side: int) -> str:
        """Return the result of `sense` for a vertical or horizontal force.

        For an oblique friction force of constant direction, such as friction on a slope, the result is "up_slope" or
        "down_slope", or empty if the sense is unknown. For any other oblique force, the result is empty.
        """
        sense = self.sense(side)
        if not sense or any(is_zero(c) for c in self.acting[0].direction):
            return sense
        if sense in ("right", "left"):
            return ""
        is_of_slope = self.enforcer == "friction" and not coordinates_in(ImmutableDenseMatrix(self.acting[0].direction))
        return f"{sense}_slope" if is_of_slope else ""

    @property
    def residual(self) -> Expr:
        return self.left - self.right

    @property
    def by_length(self) -> Expr:
        """The residual divided by `gradient`.

        For a constraint on coordinates, the virtual work of the force is `force` times the differential of this
        quotient. For a constraint on rates, the virtual work is the sum of `force` a_q dq, where a_q is the coefficient
        of the rate of q in this quotient.
        """
        return self.residual / self.gradient

    @property
    def multiplier(self) -> Expr:
        return self.force / self.gradient

    @property
    def relation(self) -> Relation:
        return Relation(self.left, "=", self.right)

    @property
    def coordinates(self) -> dict[Symbol, str]:
        return coordinates_in(self.residual)

    def along(self, q: Symbol) -> Expr:
        """The factor of `force` in the generalized force along q: df/dq, or a_q for a constraint on rates, divided by
        `gradient`."""
        return diff(self.residual, rate(q) if self.in_rates else q) / self.gradient

    def velocity(self, moving: list[Symbol]) -> Expr:
        """An expression in the rates that vanishes for every allowed velocity."""
        return self.residual if self.in_rates else explicit(TimeRate(self.residual, *moving))

    def acceleration(self, moving: list[Symbol]) -> Expr:
        return explicit(TimeRate(self.velocity(moving), *moving))

    @property
    def acts_by(self) -> tuple[Expr, ...]:
        return (self.residual,)

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load | Reaction]:
        if self.forces:
            return [each.load(self.force) for each in self.acting]
        return [Reaction(self.force, tuple((q, self.along(q)) for q in moving))]

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        return {"conditions": [plain.Condition(self.by_length, self.in_rates, self.force)]}

    @property
    def kind_of_force(self) -> str | None:
        """The kind of the multiplier, or None if the kind is unknown.

        For example, the kind is "force" if f is a length, and "torque" if f is an angle.
        """
        if self.forces:
            return "force"
        for term in Add.make_args(self.residual.expand()):
            for q, kind in self.coordinates.items():
                if (term / (rate(q) if self.in_rates else q)).is_number:
                    if kind == "angle":
                        return "torque"
                    return kind_of_dimension(dimension_of_kind("energy") / dimension_of_kind(kind))
        return None


@dataclass(frozen=True)
class Constrained(Fact):
    """The constraints of a motion that are enforced by forces."""

    missing = "has no constraints enforced by forces"
    constraints: tuple[Constraint, ...]


def constraint(condition: Any, equals: Any = ZERO, force: str = "lambda") -> Constraint:
    """A constraint f = c on coordinates or on their rates, enforced by a force.

    condition   f, a formula in coordinates and time, or a formula linear in the rates of coordinates
    equals      the value c of f, a constant or a function of the time
    force       the symbol of the multiplier: a force if f is a length, a torque if f is an angle
    """
    try:
        left, right = explicit(as_expr(condition)), explicit(as_expr(equals))
    except TypeError:
        raise Rejected(Complaint("wrong-argument", "`constraint` needs a formula in the coordinates")) from None
    moving = list(coordinates_in(left - right))
    if not moving:
        message = f"`constraint` needs a formula in the coordinates, but {left - right} contains no coordinate"
        raise Rejected(Complaint("wrong-argument", message))
    rates = [rate(q) for q in moving if (left - right).has(rate(q))]
    higher = [q for q in moving if (left - right).has(rate(q, 2), rate(q, 3))]
    residual = left - right
    if higher or any(not is_zero(diff(residual, a, b)) for a in rates for b in rates):
        message = "`constraint` needs a formula in the coordinates, or a formula linear in their rates"
        raise Rejected(Complaint("wrong-argument", message))
    made = Constraint(left, right, scalar(force), bool(rates))
    if not is_zero(
        made.residual - explicit(as_expr(condition) - equals)
    ):  # the sign of the force depends on the sign of the condition
        message = f"`constraint` made {made.residual} = 0, which is not the given condition"
        raise Unverified(Complaint("unverified", message))
    return made
