"""The moment of inertia of a composite body about an axis: a sum over its parts by the parallel-axis theorem."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sympy import Add, Expr, Integer, Pow, Rational
from sympy.matrices import ImmutableMatrix, MatrixBase

from derive.algebra.expressions import AXES, Factors, Terms, scalar
from derive.mechanics.bodies.equimomental import counted_from
from derive.mechanics.bodies.parts import PlacedPart
from derive.mechanics.bodies.regions import Point
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.inertia import moment_of_inertia, moment_seen, quoted
from derive.mechanics.theorems import PERPENDICULAR_AXES
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import ROUTE, Quote, Rule, Shown
from derive.steps.step import Level, Quantity, compared_with, is_zero
from derive.steps.subject import Subject

__all__ = ["moment_of_parts"]

OF_PARTS = ("body", "point", "mass", "axis")


MOMENT_OF_PARTS = Rule(
    "rotation.moment_of_parts",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3 (parallel axes)",
    outcomes={
        "moved": claims.beside_the_axis,
        "on_axis": claims.moment_of_parts_on_axis,
        "alone": claims.moment_of_parts_alone,
    },
    evidence={"particles": ROUTE, "integration": ROUTE},
)


def moment_of_parts(body: Any, axis: str, point: Point, symbol: str, key: str) -> Quantity | None:
    """Moment of inertia of a composite body about an axis through a point, I = sum of (I_part + m d^2) over its parts.

    body    a composite body; the moments of cavities are subtracted
    axis    the body axis that is parallel to the axis of the moment: "x", "y" or "z"
    point   a point on the axis

    For each part except particles, a step derives the moment I_part about the parallel axis through the centre of mass
    of the part. The distance between the two axes is d. Return None if some part has no body axis parallel to `axis`.
    For a composite part, the result is also None unless this parallel axis has the name `axis`.
    Second route: the sum of m d^2 over the equimomental particles of all parts. Another second route is the integral
    of the squared distance from the axis over the mass of the whole body.
    Outcomes: moved (the centre of some part is off the axis), alone (all centres are on the axis, and exactly one part
    has a nonzero moment), on_axis (all centres are on the axis, and no part or several parts have a nonzero moment).
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3 (parallel axes).
    """
    k = AXES.index(axis)
    solid = {f"part_{i}": part for i, part in enumerate(body.parts) if not _is_particle(part)}
    turns = {role: ImmutableMatrix(part.turn.T * point.axes) for role, part in solid.items()}
    own_axes = {role: _parallel_to(turn).get(axis, "") for role, turn in turns.items()}
    if any(own != axis and (not own or hasattr(solid[role].body, "parts")) for role, own in own_axes.items()):
        return None
    letter = symbol.partition("_")[0]
    own = {role: _own_moment(part.body, own_axes[role], letter, turns[role]) for role, part in solid.items()}
    held = {role: moment for role, moment in own.items() if moment.value != 0}
    away = [_squares_beside(point.seen(part.centre), k) for part in body.parts]

    def law(*found: Any) -> Any:
        moments = dict(zip(held, found, strict=True))
        terms: list[Expr] = []
        for i, part in enumerate(body.parts):
            terms += [part.sign * moment for role, moment in moments.items() if role == f"part_{i}"]
            terms += [part.sign * Factors(part.body.mass, away[i])] if away[i] != 0 else []
        return Terms(*terms) if len(terms) > 1 else Add(*terms)

    return establish(
        MOMENT_OF_PARTS,
        scalar(symbol, positive=True) if _from_particles(body, point, k).expand().is_positive else scalar(symbol),
        law,
        held,
        routes={
            "particles": compared_with(lambda: _from_particles(body, point, k)),
            "integration": compared_with(lambda: body.over_mass(lambda r: _squared_distance(r, k), point)),
        },
        outcome="moved" if any(square != 0 for square in away) else "alone" if len(held) == 1 else "on_axis",
        kind="moment of inertia",
        key=key,
        lines=Lines(put_in=Level.FULL),
        parents=[*own.values(), *body.shares],
        phrase_data=PhraseData(words={"about": point.name, "axis": axis}),
        scope=Scope(about=Subject(body=body, mass=body.mass, point=point, axis=axis), differ=OF_PARTS),
    )


def _own_moment(body: Any, axis: str, letter: str, turn: MatrixBase) -> Quantity:
    """Moment of inertia of a part about an axis through its centre of mass.

    About a diameter of a flat round part, this moment is half of the moment about the symmetry axis, because
    I_x + I_y = I_z and I_x = I_y.

    body     the part, as a body of its own
    axis     a body axis of the part
    letter   the symbol of the moment without its index; the index is the parallel axis of the whole body, or "axial" if
             the whole body has no parallel axis
    turn     the matrix whose columns are the axes of the whole body, in components along the axes of the part

    Second route: the sum of m d^2 over the equimomental particles of the part; the integral of d^2 dm over the part.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3.
    """
    called = {own: whole for whole, own in _parallel_to(turn).items()}.get(axis, "axial")
    symbol, key = f"{letter}_{called}", f"moment_{called}"
    if body.filling == "length" and axis == "z" and _all_on_axis(body):
        return _by_shape(body, axis, symbol, key, "none", lambda: Integer(0), {}, turn)
    if not (body.is_round and body.filling == "area" and axis != "z" and _is_flat(body)):
        if axis == called and not quoted(body, "centre", axis):
            return moment_of_inertia(body, axis, symbol=symbol, key=key)
        return moment_seen(body, axis, "centre", symbol, key, {"seen": "part", **_of_whole(called)}, turn)
    axial = _own_moment(body, "z", letter, turn)
    return _by_shape(body, axis, symbol, key, "flat", lambda I: Factors(Rational(1, 2), I), {"axial": axial}, turn)


OWN_MOMENT = Rule(
    "rotation.own_moment",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3",
    outcomes={"none": claims.on_its_axis, "flat": claims.is_flat},
    evidence={"particles": ROUTE, "integration": ROUTE},
    statements=[claims.names_the_axis_of_the_whole],
    shown=Shown(outcomes={"flat": (Manner.TOLD, Manner.OWN), "none": (Manner.TOLD, Manner.TOLD)}),
    quotes=[Quote(PERPENDICULAR_AXES, frozenset({"flat"}))],
)


def _by_shape(
    body: Any,
    axis: str,
    symbol: str,
    key: str,
    outcome: str,
    law: Callable[..., Expr],
    inputs: Mapping[str, Quantity],
    turn: MatrixBase,
) -> Quantity:
    """Moment of inertia about an axis through the centre of mass of a part, without an integral.

    Outcomes: `none` (all of the mass is on the axis, so the moment is zero), `flat` (half of the moment about the
    symmetry axis).
    Source: the same as for `_own_moment`.
    """
    k, centre = AXES.index(axis), body.middle
    return establish(
        OWN_MOMENT,
        scalar(symbol),
        law,
        inputs,
        routes={
            "particles": compared_with(lambda: _from_particles(body, centre, k)),
            "integration": compared_with(lambda: body.over_mass(lambda r: _squared_distance(r, k), centre)),
        },
        outcome=outcome,
        lines=Lines(put_in=Level.FULL),
        kind="moment of inertia",
        key=key,
        phrase_data=PhraseData(
            words={"axis": axis, **_of_whole(key.removeprefix("moment_"))}, outcome_data={"turn": turn}
        ),
        scope=Scope(about=Subject(body=body, mass=body.mass, point=centre, axis=axis), differ={"axis"}),
    )


def _all_on_axis(body: Any) -> bool:
    return all(is_zero(place[0]) and is_zero(place[1]) for _, place in body.particles())


def _is_particle(part: PlacedPart) -> bool:
    return not getattr(part.body, "filling", "") and not hasattr(part.body, "parts")


def _is_flat(body: Any) -> bool:
    return all(is_zero(place[2]) for _, place in body.particles())


def _parallel_to(turn: MatrixBase) -> dict[str, str]:
    """Return a mapping from axes of the whole body to the parallel axes of the part, if there are any."""
    pairs = ((j, k) for j in range(3) for k in range(3) if is_zero(turn[j, k] ** 2 - 1))
    return {AXES[k]: AXES[j] for j, k in pairs}


def _of_whole(called: str) -> dict[str, str]:
    """Return the word `whole` for the sentence: the axis of the whole body, if `called` is the name of an axis."""
    return {"whole": called} if called in AXES else {}


def _squares_beside(way: ImmutableMatrix, k: int) -> Expr:
    """Return the squared distance of a point from axis k, as a sum of squares of the other components. A component
    without a positive term has the opposite sign in its square: (R + l)^2 in place of (-R - l)^2."""
    sizes = [-x if _is_all_negative(x) else x for i, x in enumerate(way) if i != k and x != 0]
    squares = [Pow(x, 2, evaluate=not x.is_Mul) for x in sizes]
    return squares[0] if len(squares) == 1 else Terms(*squares) if squares else Integer(0)


def _is_all_negative(x: Expr) -> bool:
    return all(term.as_coeff_Mul()[0].is_negative for term in Add.make_args(x))


def _squared_distance(r: ImmutableMatrix, k: int) -> Expr:
    return sum((x**2 for i, x in enumerate(r) if i != k), Integer(0))


def _from_particles(body: Any, point: Point, k: int) -> Expr:
    return sum(
        (mass * _squared_distance(counted_from(point, place), k) for mass, place in body.particles()), Integer(0)
    )
