"""Functions with which a script describes a drawing of bodies and quantities.

    drawing("vectors", outline(block), arrow(omega, block.middle), arrow(L, block.middle), arc(omega, L, theta))

The default label of a quantity is its symbol, and the mark records the key of its step if the quantity is derived. An
expression has no default label.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import cycle
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, MatrixBase, Rational, Symbol, pi

from derive.algebra.expressions import AXES, At, as_expr, explicit, scalar
from derive.errors import Complaint, Rejected
from derive.figures.annotations import AngleMark, Arrow, Axis, AxisOfRotation, Cone, PointMark, Turn
from derive.figures.bodies import ORIGIN, axes_at, outline
from derive.figures.marks import (
    PLANE,
    SPACE,
    Drawing,
    Mark,
    Marks,
    Plot,
    ShownMode,
    components_in,
    flat,
    letters_in,
    noted,
)  # fmt: skip
from derive.figures.positions import name_of, value_and_keys, vector_of
from derive.steps.record import current_run
from derive.steps.step import Quantity

__all__ = ["arc", "arrow", "axes", "axis_of_rotation", "drawing", "plot", "point_mark", "turn", "vectors_in"]

DEGREES = (34, 52, 22, 44, 16, 38)  # values of angles in the drawing, in degrees
LONG, SMALL = Rational(5, 4), Rational(1, 4)  # length of a vector and radius of a rotation arrow, relative to the body


def drawing(
    key: str,
    *marks: Marks,
    view: str | None = None,
    values: Mapping[Any, Any] | None = None,
    left_out: Sequence[Any] = (),
    leads_to: Sequence[str] = (),
    forces_on: Any = None,
    mode: ShownMode | None = None,
    body_size: float | None = None,
    undrawn: Sequence[tuple[str, Any]] = (),
) -> Drawing:
    """Return a drawing of these marks; the drawing is recorded for the problem.

    key      the name of the drawing, for `drawings:` in the problem
    marks    marks or lists of marks; solids hide the solids behind them, and arrows, lines and labels are drawn over
             all solids
    view     "space" (seen from the front and a little from above, z upwards) or "plane" (x to the right, y upwards);
             by default "plane" if a position has two components
    values   numbers or proportions for symbols, used if the problem gives no numbers: `{x: l/4}`
    left_out   conditions that the drawing does not show; a caption states them
    leads_to   the keys of steps before which the drawing is placed; by default it is placed after the steps whose
               results it shows
    forces_on  the mass of the body whose forces the drawing shows; the caption names this mass
    mode       the normal mode that the drawing shows; the caption names its frequency
    body_size  the size of the body in a force diagram, in points, which determines the scale; by default the usual
               width of a drawing determines the scale
    undrawn    the given forces that the drawing does not show, each with its kind; a caption states them
    """
    if view not in (SPACE, PLANE, None):
        help_line = f'use "{SPACE}" or "{PLANE}"'
        raise Rejected(Complaint("wrong-argument", f'there is no view "{view}"', help=help_line))
    shown = tuple(flat(marks))
    seen = view or (PLANE if 2 in components_in(shown) else SPACE)
    run = current_run.get()
    named = run.coordinates if run is not None else {}
    moving = {q: kind for q, kind in named.items() if q in letters_in(shown)}
    chosen = {**drawn_at(moving), **{name_of(None, letter): as_expr(v) for letter, v in (values or {}).items()}}
    placed = tuple(left_out), tuple(leads_to), forces_on, mode, body_size
    forces = tuple(undrawn)
    found = Drawing(key, shown, seen, tuple(moving.items()), tuple(chosen.items()), *placed, undrawn=forces)
    noted(found)
    return found


def drawn_at(moving: Mapping[Symbol, str]) -> dict[Symbol, Expr]:
    """Return a value for each coordinate that is an angle; the values of the first six angles are distinct."""
    angles = [q for q, kind in moving.items() if kind == "angle"]
    return {q: size * pi / 180 for q, size in zip(angles, cycle(DEGREES), strict=False)}


def plot(
    key: str,
    quantity: Quantity,
    against: Symbol,
    between: tuple[Expr, Expr],
    of: str = "angle",
    shown: Expr | None = None,
    also: Sequence[str] = (),
    unit: str = "",
    above: Any = None,
    per: Any = None,
) -> Plot:
    """Return the curve of a quantity as a function of a symbol. The curve is recorded for the problem; the problem
    gives the numbers for the other symbols.

    key        the name of the curve, for `drawings:` in the problem
    quantity   a scalar, such as an energy
    against    the symbol on the horizontal axis
    between    the two ends of the range, in radians or SI units
    of         the kind of the symbol
    shown      an expression that is drawn instead of the value of the quantity
    also       the keys of further steps that the plot shows, such as the step that derives an end of the range
    unit       the SI unit of a quantity without a kind
    above      the value of the symbol at which `shown` is zero; the label is then the difference between the quantity
               and its value there
    per        a quantity by which the values on the vertical axis are divided: its name, such as `M*g*l`, and its value
               in the letters of the problem
    """
    expr = explicit(quantity.value if shown is None else shown)
    if isinstance(expr, MatrixBase) or against not in expr.free_symbols:
        message = f"a curve needs a scalar that depends on {against}, but `{quantity.key}` is not one"
        raise Rejected(Complaint("wrong-argument", message))
    lower, upper = (as_expr(end) for end in between)
    kind = quantity.step.kind or "number"
    label = quantity.symbol if above is None else quantity.symbol - At(quantity.symbol, against, as_expr(above))
    found = Plot(key, label, expr, against, lower, upper, kind, of, (quantity.key, *also), unit)
    if per is not None:
        found = replace(found, per=((Integer(1), Integer(1)), per))
    noted(found)
    return found


# --- marks -----------------------------------------------------------------------------------------------------------


def arrow(
    vector: Any,
    at: Any = ORIGIN,
    size: Any = LONG,
    label: Any = None,
    asked: bool = True,
    is_reversed: bool = False,
) -> Mark:
    """A vector in its true direction; its length is arbitrary, because vectors of different kinds have no common scale.

    vector   a vector with 2 or 3 components along the axes of the drawing; not drawn if it vanishes
    at       the point at which the arrow starts
    size     the length of the arrow relative to the size of the body
    label    the name of the vector, by default the symbol of the quantity
    asked    whether the problem asks for the vector; then the arrow is emphasised
    is_reversed   whether the arrow is opposite to `vector`, with a minus sign before its label: for a force with a
                  negative component
    """
    (value, own), (start, others), (_, named) = vector_of(vector), vector_of(at), value_and_keys(label)
    name = name_of(vector, label)
    if is_reversed:
        value, name = -value, -name if name is not None else None
    return Arrow(start, value, size, asked, label=name, keys=own + others + named)


def arc(a: Any, b: Any, label: Any = None, at: Any = ORIGIN, radius: Any = None) -> Mark:
    """The arc from one direction to another; it is not drawn if the directions are parallel or opposite.

    a, b     vectors with 3 components in the two directions
    label    the name of the angle, or a quantity
    at       the point where the two directions start
    radius   a length; by default a readable size
    """
    (u, first), (v, second), (vertex, third) = (vector_of(thing) for thing in (a, b, at))
    _, own = value_and_keys(label)
    return AngleMark(vertex, u, v, radius, label=name_of(None, label), keys=first + second + third + own)


def axis_of_rotation(along: Any, through: Any = ORIGIN, rate: Any = None) -> Mark:
    """The axis of a rotation, extended beyond the body; with a rate, also a rotation arrow.

    along     a vector with 3 components in the direction of the axis
    through   a point on the axis
    rate      rate of rotation, 1/s, positive if the rotation is right-handed about `along`
    """
    (direction, first), (place, second) = vector_of(along), vector_of(through)
    label = -rate if rate is not None and rate.could_extract_minus_sign() else rate
    return AxisOfRotation(place, direction, rate, label=label, keys=first + second)


def turn(along: Any, at: Any, label: Any = None, size: Any = SMALL) -> Mark:
    """A right-handed rotation arrow about a direction, for an angle or its rate.

    along   a vector with 3 components in the direction of the axis
    at      the centre of the arrow
    size    the radius of the arrow relative to the size of the body
    """
    (direction, first), (place, second) = vector_of(along), vector_of(at)
    return Turn(place, direction, size, label=label, keys=first + second)


def point_mark(at: Any, label: Any = None) -> Mark:
    """A point; for a quantity, the default label is its symbol.

    at   a position: a column of lengths, a point of a body, or a quantity
    """
    place, keys = vector_of(at)
    return PointMark(place, label=name_of(at, label), keys=keys)


def axes(at: Any = ORIGIN, reach: Any = 1, names: Sequence[str] = AXES) -> list[Mark]:
    """The coordinate axes from their origin `at`; two axes if `at` has two components.

    reach   the length of the axes, or one length for each axis
    """
    place, keys = vector_of(at)
    names = names[: place.rows]
    lengths = tuple(reach) if isinstance(reach, tuple | list) else (reach,) * len(names)
    ends = [ImmutableDenseMatrix([far if i == k else 0 for k in range(place.rows)]) for i, far in enumerate(lengths)]
    return [Axis(place, place + end, label=scalar(name), keys=keys) for name, end in zip(names, ends, strict=True)]


def vectors_in(
    body: Any, *vectors: Quantity, angle: Any = None, at: Any = None, about: str | None = None, circling: bool = False
) -> list[Mark]:
    """The outline of a body, with vectors in their true directions, and the axis of rotation along the first vector.

    body      the body
    vectors   vectors with 3 components along the axes of the body; each arrow is a little shorter than the one before
    angle     the angle between the first two vectors, a quantity or a name; by default no arc is drawn
    at        the point at which the vectors start; by default the centre of mass of the body
    about     the name of a point of the body; if it is given, the vectors and the axes of the body start at this point
    circling  whether the drawing shows the circle that the tip of the second vector describes about the first
    """
    if about is not None:
        start: Any = ORIGIN
        shown = [*outline(body, about, named=False), *axes_at(body, about)]
    else:
        start = body.middle if at is None else at
        shown = outline(body, named=False)
    marks = [*shown, axis_of_rotation(vectors[0], start)]
    sizes = [LONG * Rational(4, 5) ** i for i in range(len(vectors))]
    marks += [arrow(vector, start, size) for vector, size in zip(vectors, sizes, strict=True)]
    if circling:
        (axis, _), (carried, _), (place, _) = vector_of(vectors[0]), vector_of(vectors[1]), vector_of(start)
        marks.append(Cone(place, carried, sizes[1], axis=axis))
    return marks if angle is None else [*marks, arc(vectors[0], vectors[1], angle, start)]
