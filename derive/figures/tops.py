"""Bodies with Euler angles: rotation arrows, angles, dimensions, and the axes that follow the line of nodes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Rational, Symbol, pi, sqrt

from derive.algebra.expressions import as_expr, scalar
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis, LengthMark, Line, PointMark, Turn
from derive.figures.bodies import widest_of
from derive.figures.links import moving_in
from derive.figures.marks import Mark, Position
from derive.figures.positions import column_of
from derive.figures.space import numeric
from derive.figures.surroundings import AngleBetween, UprightAngle
from derive.mechanics.bodies.boundary import Round
from derive.mechanics.bodies.placed import after
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import System
from derive.steps.step import is_zero

TO_THE_RIGHT = 2 * pi / 3  # precession angle at which an axis leans to the right in the usual view
# The precession angle at which the line of nodes points to the viewer and to the left. Then the axis of the body leans
# to the left and away from the viewer.
NODES_IN_FRONT = -pi / 18
# Length of a drawn axis, and distance of a rotation arrow from the start of the axis, relative to the length of the
# axis of the body.
LONGER, BESIDE = Rational(27, 20), Rational(6, 5)
ROUND = Rational(1, 8)  # radius of a rotation arrow, relative to the size of the bodies
ACROSS = Rational(3, 5)  # length of the transverse axes, relative to the axis of the body
# Extra distance of the first dimension line from the body, and distance between two dimension lines, in points.
CLEAR, APART = 30.0, 20.0
CENTRE = "C"


def turns_about_axes(system: System, placed: Any, end: Location) -> Iterable[Mark]:
    """Yield rotation arrows for the precession about the vertical and for the spin about the axis of a body.

    If there is a spin, also yield the axis of the body and, if the line of nodes is a principal axis, the transverse
    axes. Yield nothing unless at least two rotations vary and the first rotation is about the vertical.

    end   the end of the axis of the body
    """
    axes: Any = placed.turned
    turns = [(i, angle) for i, angle in axes.turns if moving_in(system, 0 * angle + angle)]
    if len(turns) < 2 or axes.turns[0][0] != 2:
        return
    start, far = column_of(placed.at), column_of(end)
    way = far - start
    size = sqrt(tidied(Add(*(c**2 for c in way))))
    up: Any = ImmutableDenseMatrix([0, 0, size])
    if axes.turns[0] in turns and axes.turns[0][1].is_Symbol:
        yield Axis(start, start + LONGER * up, label=scalar("Z"), discs=tuple(_discs(placed)))
        yield Turn(start + BESIDE * up, up, ROUND, label=axes.turns[0][1])
    i, own = axes.turns[-1]
    if (i, own) not in turns or i != 2 or not own.is_Symbol:
        return
    yield Turn(start + BESIDE * way, way, ROUND, label=own)
    if not follows_nodes(placed):
        yield Line(far, start + LONGER * way, "construction")
        return
    yield Axis(far, start + LONGER * way, label=scalar("z"))
    nodes, across, _ = following_axes(placed)
    for name, along in (("x", nodes), ("y", across)):
        yield Axis(start, start + ACROSS * size * along, label=scalar(name))


def euler_angles(system: System, placed: Any, size: Expr) -> Iterable[Mark]:
    """Yield the Euler angles of a body at its centre: rotation arrows about the vertical and about the axis of the
    body, and the angle between these two axes. Yield nothing unless the rotations are Euler angles.

    size   the length of the axis of the body
    """
    turns: Any = getattr(placed.turned, "turns", ())
    if [i == 2 for i, _ in turns] != [True, False, True] or not all(moving_in(system, angle) for _, angle in turns):
        return
    start, (_, _, along) = column_of(placed.centre), following_axes(placed)
    up: Any = ImmutableDenseMatrix([0, 0, 1])
    for way, angle in ((up, turns[0][1]), (along, turns[-1][1])):
        yield Line(start, start + LONGER * size * way, "construction")
        yield Turn(start + BESIDE * size * way, way, ROUND, label=angle)
    yield UprightAngle(start, size * up, size * along, label=turns[1][1])


def follows_nodes(placed: Any) -> bool:
    """Return whether the body is symmetric about its z axis and has the Euler angles z, x, z, so that the line of nodes
    is a principal axis."""
    turns = getattr(placed.turned, "turns", ())
    moments = getattr(placed.body, "moments", None)
    if [i for i, _ in turns] != [2, 0, 2]:
        return False
    if moments is not None:
        return is_zero(moments[0] - moments[1])
    parts = getattr(placed.body, "parts", None)
    return all(_is_on_axis(part) for part in parts) if parts else _is_round(placed.body)


def following_axes(placed: Any) -> list[ImmutableDenseMatrix]:
    """Return the unit vectors of the axes that follow all rotations of a body except the last rotation."""
    frame = after(placed.turned.turns[:-1])
    return [ImmutableDenseMatrix(frame[:, k]) for k in range(3)]


def seen_upright(mark: Mark) -> Mark:
    """Return an `UprightAngle`, a mark that does not affect the choice of the view, in place of an `AngleBetween`.
    Return any other mark unchanged."""
    return UprightAngle(**{f.name: getattr(mark, f.name) for f in fields(mark)}) if type(mark) is AngleBetween else mark


def stance_values(system: System) -> dict[Symbol, Expr]:
    """Return the precession angles at which inclined bodies are drawn.

    The line of nodes points to the viewer, or the axis of the body leans to the right.
    """
    found: dict[Symbol, Expr] = {}
    for placed in system.bodies:
        turns: Any = getattr(placed.turned, "turns", ())
        if len(turns) > 1 and turns[0][0] == 2 and turns[0][1].is_Symbol and turns[1][0] < 2:
            if follows_nodes(placed) and not system.conditions:
                found[turns[0][1]] = NODES_IN_FRONT
            else:
                found[turns[0][1]] = TO_THE_RIGHT + (pi / 2 if turns[1][0] == 0 else 0)
    return found


# --- dimensions ------------------------------------------------------------------------------------------------------


def sizes_of_top(placed: Any) -> Iterable[Mark]:
    """Yield the dimensions of a symmetric body with Euler angles, and its centre of mass.

    The dimensions are the distances from the fixed point to the ends of the round parts of the body, and the radii of
    the parts.
    """
    if not follows_nodes(placed):
        return
    _, across, along = following_axes(placed)
    held, start = placed.point.position[2], column_of(placed.at)
    told: list[Expr] = []
    for body, low in (parts := _parts(placed)):
        yield from _radius(body, start + low * along, along, across)
        for length in _lengths(body, low):
            if length != 0 and not any(is_zero(length - known) for known in told):
                told.append(length)
    told.sort(key=numeric)
    for k, length in enumerate(told):
        yield LengthMark(start, start + length * along, -across, beyond=CLEAR + APART * k, label=length)
    centre = placed.body.middle.position[2] - held
    if parts and centre != 0:
        yield PointMark(start + centre * along, label=scalar(CENTRE))


def _discs(placed: Any) -> Iterable[tuple[Position, Expr, Position]]:
    if not follows_nodes(placed):
        return
    _, _, along = following_axes(placed)
    for body, low in _parts(placed):
        if len(lengths := _lengths(body, low)) == 1:
            yield column_of(placed.at) + lengths[0] * along, widest_of(body.boundary)[1], along


def _is_round(body: Any) -> bool:
    return isinstance(getattr(body, "boundary", None), Round)


def _parts(placed: Any) -> list[tuple[Any, Expr]]:
    """Return the parts of a body that are round about its axis, each with the height of its origin above the fixed
    point."""
    held = placed.point.position[2]
    if _is_round(placed.body):
        return [(placed.body, -held)]
    parts = getattr(placed.body, "parts", ())
    return [(part.body, part.seen(_on_axis(0))[2] - held) for part in parts if _is_on_axis(part) and part.sign > 0]


def _is_on_axis(part: Any) -> bool:
    """Return whether a part is round about the axis of the whole body, and its z axis has the same direction as this
    axis."""
    if not _is_round(part.body):
        return False
    low, high = part.seen(_on_axis(0)), part.seen(_on_axis(1))
    return all(is_zero(entry) for entry in (low[0], low[1], high[0], high[1], high[2] - low[2] - 1))


def _on_axis(z: int) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix([0, 0, z])


def _radius(body: Any, foot: Position, along: Position, aside: Position) -> Sequence[Mark]:
    if body.boundary.is_line:
        return ()
    height, radius = widest_of(body.boundary)
    if not any(is_zero(radius - measure) for measure in body.measures.values()):
        return ()
    middle = foot + height * along
    return (Line(middle, middle + radius * aside, "hidden", label=radius),)


def _lengths(body: Any, low: Expr) -> list[Expr]:
    """Return the distances along the axis from the fixed point to the ends of a part."""
    lower, upper = body.boundary.ends
    return [tidied(as_expr(low) + end) for end in dict.fromkeys((lower, upper))]
