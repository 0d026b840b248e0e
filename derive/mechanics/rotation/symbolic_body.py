"""Symbolic bodies: symbols for the mass, the distance of the centre of mass, and the principal moments about a point.

A result for a symbolic body is true for every body whose centre of mass is on a principal axis through the point. If
two moments of the symbolic body have the same symbol, the result is true only for bodies in which these two moments are
equal. `put_in(result, *body.values)` substitutes the values of the given body.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, Integer

from derive.algebra.expressions import AXES, Factors, Ratio, Terms, explicit, scalar
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.regions import Point
from derive.mechanics.rotation.euler_equations import RigidBody
from derive.mechanics.rotation.inertia import moment_of_inertia
from derive.mechanics.rotation.tensors import seen_particles
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import ROUTE, Rule, Shown
from derive.steps.step import Level, Quantity, is_zero
from derive.steps.subject import Subject

__all__ = ["symbolic_body"]


@dataclass(frozen=True)
class LetteredBody(RigidBody):
    """A rigid body whose mass, centre of mass and moments are symbols with known values.

    values   the steps that derive the values of the symbols
    shape    the body with these values, and the name of the point that is the pivot
    """

    values: tuple[Quantity, ...] = ()
    shape: tuple[Any, str] | None = None


def symbolic_body(body: Body, about: str = "pivot", symbol: str = "I") -> LetteredBody:
    """Return a body with symbols for its mass, the distance of its centre of mass from a point on the z axis, and the
    principal moments about this point. Separate steps derive the values of the symbols.

    body     a body whose axes at the point are principal axes, with its centre of mass on the z axis
    about    the point, which is the "pivot" of the result
    symbol   the symbol of the moments: I_x and I_z if I_x = I_y, otherwise I_x, I_y and I_z

    Only a composite body gets a symbol for its mass; any other body keeps its own mass. Each moment is also compared
    with the sum over equimomental particles, in addition to the second route of its step.
    Errors: the body has no such point; the axes through the point are not principal axes; the centre of mass is not on
    the z axis.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.
    """
    point = body.point(about)
    seen = seen_particles(body, point)
    beside = [sum((m * r[k] for m, r in seen), Integer(0)) for k in (0, 1)]
    products = [sum((m * r[i] * r[j] for m, r in seen), Integer(0)) for i, j in ((0, 1), (0, 2), (1, 2))]
    if not all(map(is_zero, (*beside, *products))):
        message = (
            f"`symbolic_body`: the axes of {body.name} through its {about} are not principal axes,"
            " or the centre of mass is not on the z axis"
        )
        raise Rejected(Complaint("wrong-axis", message))
    squares = [sum((m * r[k] ** 2 for m, r in seen), Integer(0)) for k in (0, 1)]
    is_symmetric = is_zero(squares[0] - squares[1])
    mass = getattr(body, "whole_mass", None)
    distance = _centre_distance(body, point, mass)
    called = {"x": "transverse_moment", "z": "axial_moment"} if is_symmetric else {k: f"moment_about_{k}" for k in AXES}
    found = [moment_of_inertia(body, axis, about, f"{symbol}_{axis}", key) for axis, key in called.items()]
    moments = [_letter(moment) for moment in found]
    principal = (moments[0], moments[0] if is_symmetric else moments[1], moments[-1])
    values = {quantity.symbol: explicit(quantity.value) for quantity in found}
    for k, letter in enumerate(principal):
        if not is_zero(letter.xreplace(values) - sum((m * (r.dot(r) - r[k] ** 2) for m, r in seen), Integer(0))):
            message = f"`symbolic_body`: {letter} is not the moment of {body.name} about its {AXES[k]} axis"
            raise Unverified(Complaint("unverified", message))
    return LetteredBody(
        _letter(mass) if mass is not None else body.mass,
        principal,
        (Integer(0), Integer(0), _letter(distance)),
        "fixed_point",
        values=tuple(each for each in (mass, distance, *found) if each is not None and each.value != 0),
        shape=(body, about),
    )


def _letter(quantity: Quantity) -> Expr:
    found: Expr = quantity.symbol if quantity.value != 0 else Integer(0)
    return found


CENTRE_DISTANCE = Rule(
    "rotation.centre_distance",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    evidence={"balance": ROUTE},
    shown=Shown(brief=Manner.TOLD),
)


def _centre_distance(body: Body, point: Point, mass: Quantity | None) -> Quantity:
    """Distance of the centre of mass from a point, along the z axis, l = (m_1 z_1 + m_2 z_2 + ...)/M.

    body    a composite body, or a body with a known centre of mass
    point   the point from which l is measured
    mass    the step that derives the mass of the whole body; None if there is no such step

    Second route: the sum of m (z - l) is zero, with z measured from the point. The sum is over particles that have the
    mass, the centre of mass and the second moments of the body.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    parts = [(part.mass, point.seen(part.centre)[2]) for part in getattr(body, "parts", ())]
    held = [Factors(m, z) for m, z in parts if z != 0]
    whole = Terms(*held) if len(held) > 1 else Add(*held)
    there = point.seen(body.middle.position)[2]
    taken = {letter.name for m, r in body.particles() for letter in (m * r[2]).free_symbols}
    letter = next((name for name in ("l", "d", "s") if name not in taken), "l_C")
    return establish(
        CENTRE_DISTANCE,
        scalar(letter, positive=True) if there.is_positive else scalar(letter),
        (lambda M: Ratio(whole, M)) if mass is not None else lambda _: there,
        {"mass": mass if mass is not None else body.mass},
        routes={"balance": lambda l: (sum((m * (r[2] - l) for m, r in seen_particles(body, point)), Integer(0)), 0)},
        kind="length",
        key="centre_distance",
        phrase_data=PhraseData(words={"about": point.name}),
        lines=Lines(put_in=Level.FULL if mass is not None else None),
        scope=Scope(about=Subject(body=body, point=point)),
    )
