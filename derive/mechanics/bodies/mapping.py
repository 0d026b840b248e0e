"""Position maps of bodies: formulas for the position, limits for their variables, and the cell of these variables.

The cell is |r_u| du for a curve, |r_u x r_v| du dv for a surface, and r_u . (r_v x r_w) du dv dw for a solid.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import lru_cache
from random import Random
from typing import Any, TypeAlias

from sympy import Abs, Dummy, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, factor, pi, sin, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Cross, Dot, as_expr, column, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.regions import Bounds, Point, Region, coordinates

TRIES = 40  # greatest number of random choices until every lower limit is below its upper limit
LOOKS = 6  # number of points at which the sign of a cell is evaluated


Map = tuple[ImmutableMatrix, Bounds]
Extent: TypeAlias = Any  # a value of a coordinate, or a pair of limits; each may be a function of the first coordinate
ALL_ROUND, HALF_ROUND = (Integer(0), 2 * pi), (Integer(0), pi)


def cylindrical(taken: Collection[Symbol], z: Extent, r: Extent, phi: Extent = ALL_ROUND) -> Map:
    """Cylindrical coordinates: height z, angle about the z axis and distance r from this axis. The value or the limits
    of r may be functions of z.

    taken   symbols that are not available for the variables
    """
    variables = coordinates(("z", "phi", "r"), taken)
    if r == 0:
        phi = Integer(0)
    (height, angle, across), limits = _varied(variables, (z, phi, r))
    return column(across * cos(angle), across * sin(angle), height), limits


def spherical(
    taken: Collection[Symbol], r: Extent, theta: Extent = HALF_ROUND, phi: Extent = ALL_ROUND, by: Any = (1, 1, 1)
) -> Map:
    """Spherical coordinates: distance from the origin, angle from the z axis, angle about the z axis.

    taken   symbols that are not available for the variables
    by      factors that scale the positions along x, y and z
    """
    (out, down, about), limits = _varied(coordinates(("r", "theta", "phi"), taken), (r, theta, phi))
    place = (sin(down) * cos(about), sin(down) * sin(about), cos(down))
    return column(*(size * out * x for size, x in zip(by, place, strict=True))), limits


def cartesian(taken: Collection[Symbol], *ends: Extent) -> Map:
    """Cartesian coordinates x, y and z, each between two limits or with a constant value.

    taken   symbols that are not available for the variables
    """
    place, limits = _varied(coordinates("xyz", taken), ends)
    return column(*place), limits


def _varied(variables: Sequence[Symbol], extents: Sequence[Any]) -> tuple[list[Expr], Bounds]:
    """The coordinates, each a variable or its given value, and the limits of the variables."""
    first = variables[0]
    place, limits = [], []
    for x, extent in zip(variables, extents, strict=True):
        if isinstance(extent, tuple):
            limits.append((x, *(as_expr(end(first) if callable(end) else end) for end in extent)))
        place.append(x if isinstance(extent, tuple) else as_expr(extent(first) if callable(extent) else extent))
    return place, tuple(limits)


def from_point(point: Point, position: ImmutableMatrix, limits: Bounds, weight: Expr) -> Region:
    """The region of a map, with positions relative to a point.

    weight   size of a cell, times the density up to a constant factor
    """
    seen = point.seen(position)
    names = {x for x, _, _ in limits}
    lengths = [x for x in position if x in names]
    for k, x in enumerate(position):
        rate = seen[k].diff(x) if x in lengths else 0
        others = [position[i] for i in range(3) if i != k] + [
            end for y, *ends in limits if y in lengths for end in ends
        ]
        own = next((ends for y, *ends in limits if y == x), [])
        if rate not in (1, -1) or any(e.has(x) for e in (*others, weight)) or any(e.has(*names) for e in own):
            continue
        start = seen[k] - rate * x
        there = {x: rate * (x - start)}
        ends = [(start + rate * end).expand() for end in own][::rate]
        limits = tuple((y, *(ends if y == x else [e.subs(there) for e in (low, up)])) for y, low, up in limits)
        seen = ImmutableDenseMatrix([x if i == k else seen[i] for i in range(3)])
    return Region(limits, seen, weight)


@lru_cache(maxsize=256)
def cell(position: ImmutableMatrix, limits: Bounds, positive: tuple[Expr, ...] = ()) -> Expr:
    """The factor that turns the product of the differentials of the variables into a length, an area or a volume.

    positive   sizes that must be positive for the random values of the symbols
    """
    tangents = tangents_of(position, [x for x, _, _ in limits])
    known = (*limits, *((Dummy("size"), Integer(0), size) for size in positive))
    if len(limits) == 3:
        size = tidied(Dot(tangents[0], Cross(tangents[1], tangents[2])))
        return _counted_positive(size, known)
    across = tangents[0] if len(limits) == 1 else explicit(Cross(tangents[0], tangents[1]))
    return _root_of(tidied(Dot(across, across)), known)


def tangents_of(position: ImmutableMatrix, names: Sequence[Symbol]) -> list[ImmutableMatrix]:
    """r_u, r_v, r_w: the derivatives of the position with respect to each variable."""
    return [ImmutableDenseMatrix([diff(x, u) for x in position]) for u in names]


def _root_of(square: Expr, limits: Bounds) -> Expr:
    """The square root, with x or -x in place of each absolute value |x|; an error if the sign of x is not the same at
    all random points."""
    root = tidied(sqrt(factor(square)))
    return root.replace(Abs, lambda inside: _counted_positive(inside, limits))


def _counted_positive(size: Expr, limits: Bounds) -> Expr:
    """The size of a cell with a positive sign; an error if the sign is not the same at all random points."""
    if size == 0:
        return size
    signs = {bool(size.xreplace(at).evalf() > 0) for at in inside(limits, size.free_symbols)}
    if len(signs) > 1 and not size.free_symbols & {x for x, _, _ in limits}:
        message = f"the symbols do not determine whether `{size}` is positive"
        raise Rejected(Complaint("unknown-sign", message, help="give sizes for which this sign is known"))
    if len(signs) > 1:
        message = f"the map covers some places twice: `{size}` changes its sign between the limits"
        raise Rejected(Complaint("folded", message, help="give limits between which the map covers each place once"))
    return size if signs == {True} else tidied(-size)


def inside(limits: Bounds, others: Any = (), looks: int = LOOKS) -> Iterator[dict[Symbol, Expr]]:
    """Random values of the symbols, and of the variables between their limits."""
    names = {x for x, _, _ in limits}
    letters = set(others) | {s for _, *ends in limits for end in ends for s in end.free_symbols}
    source = Random(len(letters))
    for _ in range(looks):
        at = letters_in_order(limits, sorted(letters - names, key=str), source)
        for x, lower, upper in limits:
            part = Rational(source.randint(10, 90), 100)
            low, high = lower.xreplace(at), upper.xreplace(at)
            at[x] = (low + part * (high - low)).evalf()
        yield at


def letters_in_order(limits: Bounds, letters: Sequence[Symbol], source: Random) -> dict[Symbol, Expr]:
    """Random values of the symbols, with each lower limit below its upper limit."""
    for _ in range(TRIES):
        at: dict[Symbol, Expr] = {letter: Rational(source.randint(40, 160), 97) for letter in letters}
        known = dict(at)
        for x, lower, upper in limits:
            low, high = (end.xreplace(known).evalf() for end in (lower, upper))
            if not (high.is_real and low.is_real and high > low):
                break
            known[x] = (low + high) / 2
        else:
            return at
    message = f"the limits of the variables are not in order, or enclose nothing: `{x}` from {lower} to {upper}"
    raise Rejected(Complaint("limits", message, help="give each variable as (lower, upper), the lower one first"))


def checked_limits(position: Any, limits: Mapping[Any, Any], taken: set[str]) -> tuple[ImmutableMatrix, Bounds]:
    """Return the position map with new real variables. It is an error if a limit contains a variable that is not an
    outer one, or if an interval is known to be empty.

    position   x, y and z as formulas in the variables
    limits     variable -> (lower, upper), outermost first
    """
    fresh = {u: scalar(u.name) for u in limits}
    found: list[tuple[Symbol, Expr, Expr]] = []
    for i, (u, ends) in enumerate(limits.items()):
        lower, upper = (as_expr(end) for end in ends)
        later = set(list(limits)[i:]) & (lower.free_symbols | upper.free_symbols)
        if later:
            name = min(str(v) for v in later)
            message = f"the limits of `{u}` contain `{name}`, which is not an outer variable"
            raise Rejected(Complaint("limits", message, help="name the outermost variable first"))
        if (upper - lower).is_nonpositive:
            message = f"`{u}` goes from {lower} to {upper}, which is an empty interval"
            raise Rejected(Complaint("limits", message, help="give the lower limit first"))
        found.append((fresh[u], lower.xreplace(fresh), upper.xreplace(fresh)))
    place = ImmutableDenseMatrix(3, 1, [as_expr(x).xreplace(fresh) for x in position])
    return place, tuple(found)
