"""A free symmetric body at one instant: its symmetry axis, the cones of its angular velocity, and its precession.

The angular velocity is w = L/I - Omega_b e. Here I is the moment of inertia about every axis perpendicular to the
symmetry axis, and e is the unit vector along the symmetry axis. In the body, w rotates about e on the body cone, at the
rate Omega_b. In space, w rotates about the constant angular momentum L on the space cone, and e also rotates about L,
at the rate |L|/I.
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Mul, Symbol, atan, cos, sin, tan

from derive.algebra.expressions import (
    AXES,
    Component,
    Cross,
    Dot,
    Norm,
    Ratio,
    column,
    component_names,
    explicit,
    scalar,
    vector,
)
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.facts import AboutPoint, OfBody
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.vectors import Through, length_by_turning
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Level, Quantity, compared_with, is_zero, require_kind

__all__ = [
    "axis_of_symmetry",
    "precession_rate",
    "tangent_between",
    "vector_component",
]


AXIS_OF_SYMMETRY = Rule(
    "rotation.axis_of_symmetry",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6",
    evidence={"second_moments": ROUTE},
)


def axis_of_symmetry(inertia: Quantity, symbol: str = "e", key: str = "axis_of_symmetry") -> Quantity:
    """Unit vector along the symmetry axis of a body with exactly two equal principal moments: the axis of the third
    moment.

    inertia   tensor (3, 3), kg m^2, along principal axes

    Second route: the second moments of the body, the integral of r r dm, are equal for all directions perpendicular to
    the axis.
    Errors: the axes are not principal axes; the three moments all differ, or are all equal.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6.
    """
    require_kind("axis_of_symmetry", "inertia", inertia, "moment of inertia")
    which = axis_number(inertia)
    body, point = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point

    def spread(found: Any) -> tuple[Any, Any]:
        """Compare the integral of r r dm with a e e + b (1 - e e), where e is the axis and 1 the unit tensor."""
        moments = ImmutableDenseMatrix(3, 3, lambda i, j: explicit(body.over_mass(lambda r: r[i] * r[j], point)))
        along = (found.T * moments * found)[0, 0]
        across = (moments.trace() - along) / 2
        dyad = found * found.T
        return moments, along * dyad + across * (ImmutableDenseMatrix.eye(3) - dyad)

    return establish(
        AXIS_OF_SYMMETRY,
        vector(symbol),
        lambda: column(*(int(k == which) for k in range(3))),
        {},
        routes={"second_moments": spread},
        key=key,
        kind="number",
        parents=[inertia],
        phrase_data=PhraseData(points_to={"inertia": inertia}),
    )


def axis_number(inertia: Quantity) -> int:
    """Return the index of the symmetry axis."""
    moments = inertia.value
    if not moments.is_diagonal():
        message = f"`{inertia.key}` is not diagonal, so its axes are not principal axes"
        raise Rejected(Complaint("no-symmetry", message))
    found = [k for k in range(3) if is_zero(moments[(k + 1) % 3, (k + 1) % 3] - moments[(k + 2) % 3, (k + 2) % 3])]
    if len(found) != 1:
        how = "all three are equal" if found else "all three differ"
        message = f"one axis of symmetry needs exactly two equal principal moments, but {how}"
        raise Rejected(Complaint("no-symmetry", message))
    return found[0]


TANGENT_BETWEEN = Rule(
    "rotation.tangent_between",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={"generic": lasts, "parallel": vanishes},
    evidence={"parts": ROUTE},
)


def tangent_between(a: Quantity, b: Quantity, angle: str = "theta", key: str = "tangent") -> Quantity:
    """Tangent of the angle between two vectors, |a x b|/(a.b).

    a, b    vectors (3) along the same axes, not zero and not perpendicular to each other
    angle   the symbol of the angle

    Second route: the length of the component of b perpendicular to a, divided by the component of b along a. The
    lengths are found by rotating the vectors onto an axis.
    Outcomes: generic, parallel (the tangent vanishes).
    Errors: a or b vanishes; a and b are perpendicular, or belong to different bodies.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    for v in (a, b):
        if is_zero(v.value):
            raise Rejected(Complaint("zero-vector", f"`{v.key}` vanishes, so it has no direction"))
    along = tidied(Dot(a.value, b.value))
    if is_zero(along):
        message = f"`{a.key}` and `{b.key}` are perpendicular, so the angle has no tangent"
        raise Rejected(Complaint("no-tangent", message))
    u, w = explicit(a.value), explicit(b.value)

    def by_parts() -> Expr:
        part = u * ((u.T * w)[0, 0] / (u.T * u)[0, 0])
        rest = (w - part).applyfunc(tidied)
        return length_by_turning(ImmutableDenseMatrix(rest)) * length_by_turning(u) / (u.T * w)[0, 0]

    letter = scalar(angle)
    value = tidied(Ratio(Norm(Cross(u, w)), along))
    return establish(
        TANGENT_BETWEEN,
        tan(letter),
        lambda u, v: Ratio(Norm(Cross(u, v)), Dot(u, v)),
        {"a": a, "b": b},
        lines=Lines(put_in=None, means={letter: atan(value)}, arranged=lambda found: _with_tangents(tidied(found))),
        routes={"parts": compared_with(by_parts)},
        outcome=lambda found: "parallel" if is_zero(found) else "generic",
        key=key,
        kind="number",
        scope=Scope(differ={"point", "rotation"}),
    )


def _with_tangents(value: Expr) -> Expr:
    """Write a quotient of sine and cosine as a tangent: (A/C) tan(alpha) for A sin(alpha)/(C cos(alpha))."""
    factors = Mul.make_args(value)
    for s in (f for f in factors if isinstance(f, sin)):
        below = 1 / cos(s.args[0])
        if below in factors:
            return Mul(*(f for f in factors if f not in (s, below)), tan(s.args[0]))
    return value


PRECESSION_RATE = Rule(
    "rotation.precession_rate",
    source="Landau, Lifshitz, *Mechanics*, section 33",
    evidence={"axis": ROUTE, "particles": ROUTE},
    named={"across": claims.moment_across},
)


def precession_rate(
    inertia: Quantity, momentum: Quantity, symbol: str = "Omega_p", key: str = "precession_rate"
) -> Quantity:
    """Rate at which the axis of a free symmetric body rotates about its angular momentum in space, Omega_p = L/I.

    inertia    tensor (3, 3), kg m^2, along principal axes, with two moments equal to I
    momentum   angular momentum L, vector (3), kg m^2/s, same axes

    Second route: the rate of the unit vector e along the axis, w x e, is Omega_p (L/|L|) x e. Also, with u = w -
    Omega_p L/|L|, the integral of r x (u x r) dm over the body is along the axis.
    Errors: the body has no symmetry axis; L changes in the body, or is along this axis, whose direction is then
    constant; `inertia` is not an inertia tensor, or `momentum` is not an angular momentum.
    Source: Landau, Lifshitz, *Mechanics*, section 33.
    """
    require_kind("precession_rate", "inertia", inertia, "moment of inertia")
    require_kind("precession_rate", "momentum", momentum, "angular momentum")
    at_one_instant = Spelled(
        "for an angular velocity at one instant, use `momentary_angular_velocity`",
        "for an angular velocity at one instant, use `start`",
    )
    require_constant("precession_rate", "angular momentum in the body", momentum, at_one_instant)
    which = axis_number(inertia)
    axis, L = column(*(int(k == which) for k in range(3))), momentum.value
    beside = tidied(Norm(Cross(axis, L)))
    if is_zero(beside):
        message = f"`{momentum.key}` is along the axis of symmetry, whose direction is then constant"
        raise Rejected(Complaint("no-cone", message))
    across = inertia.value[(which + 1) % 3, (which + 1) % 3]
    omega = next(q for q in momentum.parents if q.fact(Through) is not None)
    body, point = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point

    def carries_the_axis(found: Expr) -> tuple[Any, Any]:
        round_it = explicit(Cross(L, axis)) * found
        return round_it, explicit(Cross(omega.value, axis)) * length_by_turning(L)

    def leaves_a_spin(found: Expr) -> tuple[Any, Any]:
        """Check, by an integral over the mass, that the rotation omega - Omega_p L/|L| has an angular momentum along
        the axis only."""
        rest = explicit(omega.value) * length_by_turning(L) - L * found
        moved = explicit(body.over_mass(lambda r: Cross(r, Cross(rest, r)), point))
        return explicit(Cross(axis, moved)), column(0, 0, 0)

    return establish(
        PRECESSION_RATE,
        scalar(symbol),
        lambda momentum: Ratio(Norm(momentum), across),
        {"momentum": momentum},
        lines=Lines(put_in=None),
        routes={"axis": carries_the_axis, "particles": leaves_a_spin},
        key=key,
        kind="angular speed",
        parents=[inertia],
        phrase_data=PhraseData(named={"across": across}),
    )


VECTOR_COMPONENT = Rule(
    "rotation.vector_component",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"turned": CHECK},
    statements=[claims.component_of_its_letter],
)


def vector_component(of: Quantity, axis: str, symbol: str | None = None, key: str | None = None) -> Quantity:
    """One component of a vector, v_x = v . e_x.

    of     vector (3), any unit
    axis   "x", "y" or "z"

    Check: a cyclic permutation of the axes, which is a rotation, makes this component the first one.
    Outcomes: generic, zero.
    Errors: `of` is not a vector; there is no such axis.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    if getattr(of.value, "shape", None) != (3, 1) or axis not in AXES:
        raise Rejected(Complaint("wrong-argument", f"`{of.key}` has no component along `{axis}`"))
    i = AXES.index(axis)
    turned = ImmutableDenseMatrix([[0, 1, 0], [0, 0, 1], [1, 0, 0]]) ** i
    letter: Symbol = component_names(symbol or of.symbol.name)[i]
    only_renames = letter == component_names(of.symbol.name)[i]  # omega_z is already the symbol of the component
    return establish(
        VECTOR_COMPONENT,
        letter,
        lambda v: Component(v, axis),
        {"vector": of},
        lines=Lines(put_in=None, law=Level.FULL if only_renames else Level.BRIEF),
        routes={"turned": compared_with(lambda: (turned * explicit(of.value))[0, 0])},
        outcome=lambda value: "zero" if is_zero(value) else "generic",
        key=key or f"{of.key}_{axis}",
        kind=of.step.kind,
    )
