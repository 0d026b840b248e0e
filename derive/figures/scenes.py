"""Functions with which a script describes a drawing, in terms of its bodies and quantities.

    drawing("vectors", outline(block), arrow(omega, block.middle), arrow(L, block.middle), arc(omega, L, theta))

A quantity supplies its name and its key; a plain expression is used unchanged.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, MatrixBase, Rational, Symbol, pi

from derive.algebra.expressions import AXES, as_expr, explicit, scalar
from derive.errors import Complaint, Rejected
from derive.figures.annotations import AngleMark, Arrow, Axis, AxisOfRotation, PointMark, Turn
from derive.figures.bodies import ORIGIN, axes_at, outline
from derive.figures.marks import (
    PLANE,
    SPACE,
    Drawing,
    Mark,
    Marks,
    Plot,
    components_in,
    flat,
    letters_in,
    noted,
)  # fmt: skip
from derive.figures.positions import name_of, value_and_keys, vector_of
from derive.steps.record import current_run
from derive.steps.step import Quantity

__all__ = ["arc", "arrow", "axes", "axis_of_rotation", "drawing", "plot", "point_mark", "turn", "vectors_in"]

DEGREES = (34, 52, 22, 44, 16, 38)  # values in the drawing for coordinates that are angles
LONG, SMALL = Rational(5, 4), Rational(1, 4)  # relative to the size of the body


def drawing(key: str, *marks: Marks, view: str | None = None, values: Mapping[Any, Any] | None = None) -> Drawing:
    """A drawing of these marks, recorded for the problem.

    key      its name, for `drawings:` in the problem
    marks    marks or lists of them; solids hide marks behind them, all other marks are drawn over them
    view     "space" (seen from the front, a little from above, z upwards) or "plane" (x to the right, y upwards);
             by default "plane" if a place has two components
    values   numbers or proportions for symbols in the drawing, unless the problem gives numbers: `{x: l/4}`
    """
    if view not in (SPACE, PLANE, None):
        help_line = f'use "{SPACE}" or "{PLANE}"'
        raise Rejected(Complaint("wrong-argument", f'there is no view "{view}"', help=help_line))
    shown = tuple(flat(marks))
    seen = view or (PLANE if 2 in components_in(shown) else SPACE)
    run = current_run.get()
    named = run.coordinates if run is not None else {}
    moving = {q: kind for q, kind in named.items() if q in letters_in(shown)}
    chosen = {**_drawn_at(moving), **{name_of(None, letter): as_expr(v) for letter, v in (values or {}).items()}}
    found = Drawing(key, shown, seen, tuple(moving.items()), tuple(chosen.items()))
    noted(found)
    return found


def _drawn_at(moving: Mapping[Symbol, str]) -> dict[Symbol, Expr]:
    """A value for each coordinate that is an angle; neighbouring values differ."""
    angles = [q for q, kind in moving.items() if kind == "angle"]
    return {q: size * pi / 180 for q, size in zip(angles, cycle(DEGREES), strict=False)}


def plot(
    key: str,
    quantity: Quantity,
    against: Symbol,
    between: tuple[Expr, Expr],
    of: str = "angle",
    shown: Expr | None = None,
) -> Plot:
    """The curve of a quantity against a symbol, recorded for the problem; its numbers come from the problem.

    quantity   a scalar with a kind, such as an energy
    against    the symbol on the horizontal axis; `of` is its kind
    between    the two ends of the range, in radians or SI units
    shown      an expression drawn instead of the quantity, for example with its coordinate as a plain symbol
    """
    expr = explicit(quantity.value if shown is None else shown)
    if isinstance(expr, MatrixBase) or against not in expr.free_symbols:
        message = f"`{quantity.key}` does not depend on {against}, so there is no curve"
        raise Rejected(Complaint("wrong-argument", message))
    lower, upper = (as_expr(end) for end in between)
    kind = quantity.step.kind or "number"
    found = Plot(key, quantity.symbol, expr, against, lower, upper, kind, of, (quantity.key,))
    noted(found)
    return found


# --- marks -----------------------------------------------------------------------------------------------------------


def arrow(vector: Any, at: Any = ORIGIN, size: Any = LONG, label: Any = None, asked: bool = True) -> Mark:
    """A vector in its true direction; its length is arbitrary, because vectors of two kinds have no common scale.

    vector   vector (3), in the axes of the drawing; not drawn if it vanishes
    at       the place where it begins
    size     its length relative to the size of the body
    label    its name, if it is not the quantity's own
    asked    whether the problem asks for the vector, so that it is emphasised
    """
    (value, own), (start, others), (_, named) = vector_of(vector), vector_of(at), value_and_keys(label)
    return Arrow(start, value, size, asked, label=name_of(vector, label), keys=own + others + named)


def arc(a: Any, b: Any, label: Any = None, at: Any = ORIGIN, radius: Any = None) -> Mark:
    """The arc from one direction to another; not drawn if they are parallel.

    a, b     vectors (3)
    label    its name, or the quantity of the angle
    at       the vertex
    radius   length; by default a readable size
    """
    (u, first), (v, second), (vertex, third) = (vector_of(thing) for thing in (a, b, at))
    _, own = value_and_keys(label)
    return AngleMark(vertex, u, v, radius, label=name_of(None, label), keys=first + second + third + own)


def axis_of_rotation(along: Any, through: Any = ORIGIN, rate: Any = None) -> Mark:
    """The axis of a rotation, beyond the body on both sides; with a rate, also the sense of rotation.

    along     vector (3)
    through   a place on the axis
    rate      angular speed, 1/s: positive is right-handed about `along`
    """
    (direction, first), (place, second) = vector_of(along), vector_of(through)
    label = -rate if rate is not None and rate.could_extract_minus_sign() else rate
    return AxisOfRotation(place, direction, rate, label=label, keys=first + second)


def turn(along: Any, at: Any, label: Any = None, size: Any = SMALL) -> Mark:
    """A right-handed arrow round a direction, for a growing angle or its rate.

    along   vector (3)
    at      the centre of the arrow's circle
    size    its radius relative to the size of the body
    """
    (direction, first), (place, second) = vector_of(along), vector_of(at)
    return Turn(place, direction, size, label=label, keys=first + second)


def point_mark(at: Any, label: Any = None) -> Mark:
    """A point; a derived place supplies its name.

    at   a place: a column of lengths, a body's point, or a quantity
    """
    place, keys = vector_of(at)
    return PointMark(place, label=name_of(at, label), keys=keys)


def axes(at: Any = ORIGIN, reach: Any = 1, names: Sequence[str] = AXES) -> list[Mark]:
    """The coordinate axes from their origin; two axes if it is in a plane.

    reach   their length, or a length for each
    """
    place, keys = vector_of(at)
    names = names[: place.rows]
    lengths = tuple(reach) if isinstance(reach, tuple | list) else (reach,) * len(names)
    ends = [ImmutableDenseMatrix([far if i == k else 0 for k in range(place.rows)]) for i, far in enumerate(lengths)]
    return [Axis(place, place + end, label=scalar(name), keys=keys) for name, end in zip(names, ends, strict=True)]


def vectors_in(
    body: Any, *vectors: Quantity, angle: Any = None, at: Any = None, about: str | None = None
) -> list[Mark]:
    """A body with vectors in their true directions, the first along its axis of rotation.

    body      a body, for its outline
    vectors   quantities: vectors (3) in the body's axes; each arrow is a little shorter than the one before
    angle     the angle between the first two, a quantity or a name; by default no arc is drawn
    at        the place where they begin; by default the centre of mass of the body
    about     the name of a point where they begin instead, with the axes of the body there
    """
    if about is not None:
        start: Any = ORIGIN
        shown = [*outline(body, about, named=False), *axes_at(body, about)]
    else:
        start = body.middle if at is None else at
        shown = outline(body, named=False)
    marks = [*shown, axis_of_rotation(vectors[0], start)]
    marks += [arrow(vector, start, LONG * Rational(4, 5) ** i) for i, vector in enumerate(vectors)]
    return marks if angle is None else [*marks, arc(vectors[0], vectors[1], angle, start)]
