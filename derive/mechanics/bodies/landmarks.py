"""Check the positions of the named points of a body by means of the limits of its region.

A corner or the end of a rod is at a limit of every coordinate. A point of the rim is on the outermost circle. The base
is the middle of an end face. The apex is an end where the cross-section shrinks to a point. The centre is the centre of
mass by integration.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr

from derive.algebra.expressions import column
from derive.mechanics.bodies.regions import Point, Region
from derive.steps.step import is_zero


def is_where_named(body: Any, point: Point) -> bool:
    """Whether the axes of a point are orthonormal and right-handed, and the point passes the test for points of this
    name, if such a test exists."""
    upright = is_zero(point.axes.T * point.axes - point.axes**0) and is_zero(point.axes.det() - 1)
    if point.name == "centre":
        return upright and _is_centre(body, point.position)
    test = None if point.name in body.names_given else _TESTS.get(point.name)
    if not upright or test is None:
        return upright
    return test(body, body.region(Point("origin", column(0, 0, 0))).with_section_put_in(), point.position)


def _is_corner(body: Any, region: Region, at: Any) -> bool:
    """Whether each coordinate is at one of its limits; a coordinate without limits must be zero."""
    limits = {x: ends for x, *ends in region.limits}
    return all(
        any(is_zero(place - end) for end in limits.get(x, [x])) for place, x in zip(at, region.position, strict=True)
    )


def _is_centre(body: Any, at: Any) -> bool:
    return is_zero(body.over_mass(lambda r: r, Point("origin", column(0, 0, 0))) - body.mass * at)


def _on_axis_at_end(region: Region, at: Any) -> bool:
    _, lower, upper = region.limits[0]
    return is_zero(at[0]) and is_zero(at[1]) and any(is_zero(at[2] - end) for end in (lower, upper))


def _radius(region: Region, z: Expr) -> Expr:
    height, edge = region.limits[0][0], region.limits[-1][2]
    return edge.subs(height, z)


def _is_apex(body: Any, region: Region, at: Any) -> bool:
    return _on_axis_at_end(region, at) and is_zero(_radius(region, at[2]))


def _is_base(body: Any, region: Region, at: Any) -> bool:
    return _on_axis_at_end(region, at) and not is_zero(_radius(region, at[2]))


def _is_on_rim(body: Any, region: Region, at: Any) -> bool:
    """Whether the point is on the outermost circle of a flat body.

    For a hoop, whose only variable is the angle, the radius is the line element per angle.
    """
    outermost = region.limits[-1][2] if len(region.limits) > 1 else region.element
    return is_zero(at[0] ** 2 + at[1] ** 2 - outermost**2) and is_zero(at[2] - region.position[2])


_TESTS: dict[str, Callable[[Any, Region, Any], bool]] = {
    "corner": _is_corner,
    "end": _is_corner,
    "far_end": _is_corner,
    "apex": _is_apex,
    "base": _is_base,
    "rim": _is_on_rim,
}
