"""Quantities derived from an inertia tensor: components along rotated axes, the moment about any axis, single entries,
the radius of gyration, and the angle of the principal axes in a plane. The module also contains the
perpendicular-axis theorem.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, MatMul, Pow, atan2, sqrt, tan
from sympy.matrices import ImmutableMatrix
from sympy.simplify.fu import TR8

from derive.algebra.expressions import (
    Dot,
    Factors,
    Norm,
    Ratio,
    Root,
    Terms,
    applied,
    as_expr,
    column,
    explicit,
    scalar,
    tensor,
    vector,
)
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.equimomental import squared_distance, summed, tensor_at
from derive.mechanics.bodies.facts import AboutPoint, OfBody
from derive.mechanics.bodies.parts import turn_about
from derive.mechanics.bodies.regions import Point
from derive.mechanics.rotation import claims
from derive.steps.claims import lasts, nowhere_negative, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Level, Quantity, entry_name, is_zero, require_kind, value_behind
from derive.steps.subject import Subject

__all__ = [
    "moment_about",
    "perpendicular_axes",
    "principal_angle",
    "radius_of_gyration",
    "tensor_entry",
    "turned_tensor",
]

MOMENT = "moment of inertia"


def seen_particles(body: Any, point: Point) -> list[tuple[Expr, ImmutableMatrix]]:
    """Return the equimomental particles of a body: the mass of each, and its position relative to a point, in
    components along the axes of this point."""
    return [(mass, ImmutableDenseMatrix(point.axes.T * (place - point.position))) for mass, place in body.particles()]


def central_tensor(body: Any) -> ImmutableMatrix:
    """Return the value of the tensor about the centre of mass along the body axes, from equimomental particles."""
    return ImmutableDenseMatrix(summed(seen_particles(body, body.middle), tensor_at).applyfunc(tidied))


def shape_of(found: Any) -> str:
    """Return the outcome: whether a tensor is diagonal, and how many moments of a diagonal tensor are equal."""
    if not found.is_diagonal():
        return "generic"
    return {1: "isotropic", 2: "two_equal"}.get(len({found[i, i] for i in range(3)}), "diagonal")


TURNED_TENSOR = Rule(
    "rotation.turned_tensor",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 4.3 and 5.2",
    outcomes=claims.TENSORS,
    evidence={"particles": ROUTE, "quadrature": CHECK, "trace": CHECK},
    statements=[claims.turned_as_told],
    named={"angle": claims.turned_by},
)


def turned_tensor(
    inertia: Quantity, axis: str, angle: Expr, symbol: str | None = None, key: str = "turned_tensor"
) -> Quantity:
    """A tensor along rotated axes, I' = R^T I R, where the columns of R are the new axes.

    inertia   tensor I (3, 3), kg m^2
    axis      "x", "y" or "z": the axis of the rotation
    angle     the angle of this right-handed rotation

    Second route: the sum of m (r.r 1 - r r) over equimomental particles, with components along the rotated axes. For a
    body defined by a position map, a numerical sum over its cells is a check instead. Check: the traces of I and I' are
    equal.
    Outcomes: isotropic, two_equal, diagonal, generic.
    Errors: there is no such axis; `inertia` is not the tensor of a body.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 4.3 and 5.2.
    """
    require_kind("turned_tensor", "inertia", inertia, MOMENT)
    body, point = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point
    turn = turn_about(axis, angle)
    there = replace(point, axes=ImmutableDenseMatrix(point.axes * turn))
    name = symbol or f"{inertia.symbol.name.partition('_')[0]}'"
    return establish(
        TURNED_TENSOR,
        tensor(name),
        lambda I: MatMul(turn.T, I, turn, evaluate=False),
        {"inertia": inertia},
        key=key,
        kind=MOMENT,
        routes={
            **body.another_way(tensor_at, there),
            "trace": lambda found: (found.trace(), inertia.value.trace()),
        },
        outcome=shape_of,
        lines=Lines(put_in=Level.STANDARD, arranged=_shorter_sums),
        facts=[OfBody(body), AboutPoint(there)],
        phrase_data=PhraseData(
            words={"about": point.name, "along": axis},
            named={"angle": angle},
            outcome_data={"turn": turn},
        ),
        scope=Scope(about=Subject(body=body, point=there, axes=there.axes), differ={"point", "axes"}),
    )


MOMENT_ABOUT = Rule(
    "rotation.moment_about",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    evidence={"particles": ROUTE, "quadrature": CHECK},
)


def moment_about(
    inertia: Quantity, direction: Sequence[Any] | Quantity, symbol: str = "I_n", key: str = "moment_about"
) -> Quantity:
    """Moment of inertia about an axis in any direction through the point of the tensor, I_n = n.I n, n = d/|d|.

    inertia     tensor I (3, 3), kg m^2
    direction   d, three components or a vector along the axis
    symbol      the symbol of the moment; the index of this symbol, here n, becomes the symbol of the unit vector

    Second route: the sum of m |n x r|^2 over equimomental particles. For a body defined by a position map, a numerical
    sum over its cells is a check instead.
    Errors: d vanishes; `inertia` is not the tensor of a body.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    require_kind("moment_about", "inertia", inertia, MOMENT)
    body, point = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point
    along = direction.value if isinstance(direction, Quantity) else column(*(as_expr(x) for x in direction))
    if is_zero(along):
        raise Rejected(Complaint("zero-vector", "the vector along the axis vanishes, so the axis has no direction"))
    unit = ImmutableDenseMatrix((along / tidied(Norm(along))).applyfunc(tidied))

    n = _unit_vector(direction, body, symbol.partition("_")[2] or "n", key)
    return establish(
        MOMENT_ABOUT,
        scalar(symbol),
        lambda I, n: Dot(n, applied(I, n)),
        {"inertia": inertia, "direction": n},
        key=key,
        kind=MOMENT,
        routes=body.another_way(lambda r: squared_distance(r, unit), point),
        lines=Lines(put_in=Level.STANDARD),
        phrase_data=PhraseData(words={"about": point.name}),
        scope=Scope(about=Subject(body=body, point=point)),
    )


UNIT_VECTOR = Rule(
    "rotation.unit_vector",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    evidence={"unit": CHECK, "along": CHECK},
)


def _unit_vector(direction: Any, body: Any, letter: str, key: str) -> Quantity:
    """Derive the unit vector along an axis, n = d/|d|."""
    along = value_behind(direction) if isinstance(direction, Quantity) else column(*direction)
    given = {"along": direction} if isinstance(direction, Quantity) else {"along": along}
    return establish(
        UNIT_VECTOR,
        vector(letter),
        lambda d: MatMul(Pow(Norm(d), -1), d, evaluate=False),
        given,
        key=f"{key}_direction",
        routes={"unit": lambda n: (Dot(n, n), Integer(1)), "along": lambda n: (Dot(n, along), Norm(along))},
        lines=Lines(put_in=None),
        scope=Scope(about=Subject(body=body)),
    )


TENSOR_ENTRY = Rule(
    "rotation.tensor_entry",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes={"moment": claims.tensor_entry_moment, "product": claims.tensor_entry_product},
    evidence={"particles": ROUTE, "quadrature": CHECK},
)


def tensor_entry(inertia: Quantity, entry: str, symbol: str | None = None, key: str | None = None) -> Quantity:
    """One entry of a tensor: a moment such as I_zz, or a product of inertia such as I_xy = -(integral of x y dm).

    inertia   tensor (3, 3), kg m^2
    entry     the indices of the entry, "xx", "xy", ...

    Second route: the sum of m (r.r delta_ij - x_i x_j) over equimomental particles. For a body defined by a position
    map, a numerical sum over its cells is a check instead.
    Outcomes: moment, product.
    Errors: there is no such entry; `inertia` is not the tensor of a body.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    require_kind("tensor_entry", "inertia", inertia, MOMENT)
    if len(entry) != 2 or set(entry) - set("xyz"):
        message = f'a tensor has no entry "{entry}"'
        raise Rejected(Complaint("no-such-entry", message, help='entries are "xx", "xy" and so on'))
    body, point = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point
    i, j = ("xyz".index(letter) for letter in sorted(entry))
    name = symbol or entry_name(inertia.symbol.name, i, j).name
    return establish(
        TENSOR_ENTRY,
        scalar(name),
        lambda: inertia.value[i, j],
        {},
        key=key or f"{inertia.key}_entry_{entry}",
        kind=MOMENT,
        parents=[inertia],
        routes=body.another_way(lambda r: tensor_at(r)[i, j], point),
        outcome="moment" if i == j else "product",
        phrase_data=PhraseData(words={"about": point.name, "entry": entry}, points_to={"inertia": inertia}),
        scope=Scope(about=Subject(body=body, point=point, axis="xyz"[i] if i == j else None)),
    )


PRINCIPAL_ANGLE = Rule(
    "rotation.principal_angle",
    source="Fowles, Cassiday, *Analytical Mechanics*, section 9.2",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"particles": ROUTE},
)


def principal_angle(inertia: Quantity, symbol: str = "theta", key: str = "principal_angle") -> Quantity:
    """Angle of the principal axes in the x-y plane, measured from x, tan 2 theta = 2 I_xy/(I_xx - I_yy).

    inertia   tensor (3, 3), kg m^2, with I_xz = I_yz = 0

    Second route: along axes rotated by this angle, the product of inertia of the equimomental particles is zero.
    Outcomes: generic, zero (x and y are principal axes).
    Errors: I_xz or I_yz does not vanish; I_xx and I_yy are equal, so the angle is 45 degrees, or arbitrary if I_xy = 0.
    Source: Fowles, Cassiday, *Analytical Mechanics*, section 9.2.
    """
    require_kind("principal_angle", "inertia", inertia, MOMENT)
    body, point, I = inertia.needed(OfBody).body, inertia.needed(AboutPoint).point, inertia.value
    if not (is_zero(I[0, 2]) and is_zero(I[1, 2])):
        message = (
            f"the z axis is not a principal axis of `{inertia.key}`, so no two principal axes are in the x-y plane"
        )
        raise Rejected(Complaint("not-in-a-plane", message, help="`principal_axes` derives the axes in space"))
    if is_zero(I[0, 0] - I[1, 1]):
        what = (
            "every axis in the x-y plane is principal"
            if is_zero(I[0, 1])
            else "the principal axes are at 45 degrees to x and y"
        )
        message = f"the moments of `{inertia.key}` about x and y are equal, so {what}"
        raise Rejected(Complaint("equal-moments", message, help="`principal_axes` gives the axes"))
    entries = {f"{'xyz'[i]}{'xyz'[j]}": _entry_of(inertia, i, j) for i, j in ((0, 1), (0, 0), (1, 1))}
    angle = scalar(symbol)

    def no_product(found: Expr) -> tuple[Expr, Expr]:
        """Return the sum of m x'y'/cos 2 theta, which must vanish, and zero.

        Here x'y' = x y cos 2 theta - (x^2 - y^2)/2 sin 2 theta.
        """
        left = (m * (r[0] * r[1] - (r[0] ** 2 - r[1] ** 2) / 2 * found) for m, r in seen_particles(body, point))
        return sum(left, Integer(0)), Integer(0)

    return establish(
        PRINCIPAL_ANGLE,
        tan(2 * angle),
        lambda xy, xx, yy: Ratio(Factors(2, xy), Terms(xx, -yy)),
        entries,
        key=key,
        kind="number",
        parents=[inertia],
        routes={"particles": no_product},
        outcome=lambda found: "zero" if found == 0 else "generic",
        lines=Lines(means={angle: atan2(2 * I[0, 1], I[0, 0] - I[1, 1]) / 2}),
        phrase_data=PhraseData(words={"about": point.name}, points_to={"inertia": inertia}),
        scope=Scope(about=Subject(body=body, point=point)),
    )


def _entry_of(inertia: Quantity, i: int, j: int) -> Quantity | Expr:
    name = entry_name(inertia.symbol.name, i, j)
    value: Expr = inertia.value[i, j]
    return next((parent for parent in inertia.parents if parent.symbol == name), value)


def _shorter_sums(matrix: Any) -> ImmutableMatrix:
    """Write each entry in the shorter of two forms: with products of sines and cosines, or with multiple angles."""
    return ImmutableDenseMatrix(matrix.applyfunc(_shorter))


def _shorter(entry: Expr) -> Expr:
    plain = explicit(entry).expand()
    return min((tidied(form) for form in (plain, TR8(plain).expand())), key=lambda f: (length(f), str(f)))


PERPENDICULAR_AXES = Rule(
    "rotation.perpendicular_axes",
    source=(
        "Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3; Morin, *Introduction to "
        "Classical Mechanics*, section 8.2"
    ),
    evidence={"particles": ROUTE, "quadrature": CHECK},
)


def perpendicular_axes(
    first: Quantity, second: Quantity, symbol: str | None = None, key: str = "perpendicular_axes"
) -> Quantity:
    """Moment of inertia of a flat body about the axis normal to its plane, I_z = I_x + I_y.

    first, second   moments of inertia about two perpendicular axes through one point in the plane of the body, kg m^2

    Second route: the sum of m d^2 over equimomental particles, with the distance d from the axis normal to the plane.
    For a body defined by a position map, a numerical sum over its cells is a check instead.
    Errors: the body is not flat, or one of the two axes is not in its plane.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3; Morin, *Introduction to
    Classical Mechanics*, section 8.2.
    """
    body, point = first.subject.body, first.subject.point
    axes = {first.subject.axis, second.subject.axis}
    across = getattr(body, "flat_across", None)
    if across is None or axes != set("xyz") - {across}:
        message = "the perpendicular-axis theorem needs a flat body and two axes in its plane"
        in_plane = [f'`moment_of_inertia(body, "{axis}")`' for axis in "xyz" if axis != across]
        help_line = f"use {' and '.join(in_plane)}" if across else None
        raise Rejected(Complaint("not-flat", message, help=help_line))
    k = "xyz".index(across)

    return establish(
        PERPENDICULAR_AXES,
        scalar(symbol or f"I_{across}"),
        lambda a, b: Terms(a, b),
        {"first": first, "second": second},
        key=key,
        kind=MOMENT,
        routes=body.another_way(lambda r: tensor_at(r)[k, k], point),
        lines=Lines(put_in=Level.STANDARD),
        phrase_data=PhraseData(words={"about": point.name, "across": across}),
        scope=Scope(about=Subject(body=body, point=point, axis=across)),
    )


RADIUS_OF_GYRATION = Rule(
    "rotation.radius_of_gyration",
    source="Fowles, Cassiday, *Analytical Mechanics*, section 8.3",
    evidence={"particles": ROUTE, "quadrature": CHECK},
    statements=[nowhere_negative],
)


def radius_of_gyration(moment: Quantity, symbol: str = "k", key: str = "radius_of_gyration") -> Quantity:
    """Radius of gyration, k = sqrt(I/M): the distance from the axis at which a particle of mass M has the moment I.

    moment   moment of inertia I of a body about one of its axes, kg m^2

    Second route: M k^2 is the sum of m d^2 over equimomental particles, with the distance d from the axis. For a body
    defined by a position map, a numerical sum over its cells is a check instead.
    Errors: `moment` is not the moment of inertia of a body about one of its axes.
    Source: Fowles, Cassiday, *Analytical Mechanics*, section 8.3.
    """
    require_kind("radius_of_gyration", "moment", moment, MOMENT)
    body, point, axis = moment.subject.body, moment.subject.point, moment.subject.axis
    if body is None or not isinstance(axis, str) or axis not in ("x", "y", "z"):
        message = f"`{moment.key}` is not the moment of a body about one of its axes"
        raise Rejected(Complaint("wrong-argument", message, help='use `moment_of_inertia(body, "z")`'))
    i = "xyz".index(axis)

    return establish(
        RADIUS_OF_GYRATION,
        scalar(symbol, nonnegative=True),
        lambda I, mass: Root(Ratio(I, mass)),
        {"moment": moment, "mass": body.mass_as_found},
        key=key,
        kind="length",
        routes=body.another_way(lambda r: tensor_at(r)[i, i], point, of=lambda k: body.mass * k**2),
        lines=Lines(put_in=None, arranged=lambda value: tidied(sqrt(tidied(value**2)))),
        scope=Scope(about=Subject(body=body, point=point, axis=axis)),
    )
