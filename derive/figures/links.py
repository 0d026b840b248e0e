"""Finds links (lines from a fixed or known point to a moving point) and their angles in the formulas of positions.

A link is the line along which polar coordinates are measured; it need not be a physical part. Numerical samples
exclude most pairs of points that are not links; algebra decides about the remaining pairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from sympy import Abs, Add, Expr, Float, Integer, Rational, Symbol, cos, expand, factor, sin, sqrt

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import TIME, explicit
from derive.algebra.normal_form import vanishes
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import Central, System

ZERO, HALF = Integer(0), Rational(1, 2)
SAMPLES = (0.37, 0.83)


@dataclass(frozen=True)
class Link:
    """A vector between two points.

    The links of particles have a length that does not depend on an angle or on time. If the length depends on
    coordinates, `is_constant` is false.
    """

    start: Location
    end: Location
    length: Expr
    is_constant: bool

    @property
    def way(self) -> Location:
        return self.end - self.start


def _pairs(a: Location, b: Location) -> zip[tuple[Expr, Expr]]:
    return zip(a.components, b.components, strict=True)


def moving_in(system: System, *things: Expr) -> set[Symbol]:
    """Return the coordinates that these expressions contain, and the time if an expression contains the time."""
    known = {*system.coordinates, TIME}
    return {letter for thing in things for letter in thing.free_symbols if letter in known}


def is_fixed(system: System, place: Location) -> bool:
    return not moving_in(system, *place.components)


def is_spring(each: Central) -> bool:
    """Return whether the energy is of second degree in the distance, and is not known to have a maximum."""
    constant = tidied(derivative(explicit(each.energy), each.distance, 2))
    return each.distance not in constant.free_symbols and constant.is_nonpositive is not True


def same(a: Location, b: Location) -> bool:
    return all(expand(x - y) == 0 for x, y in _pairs(a, b))


# --- links -----------------------------------------------------------------------------------------------------------


def link_to(system: System, index: int, named: Sequence[Location] = ()) -> Link | None:
    """Return the link to a particle from the other end of its rod, or from the origin of its polar coordinates.

    index   the index of the particle
    named   points that count as known, in addition to earlier particles and the ends of central forces

    Known and fixed points are preferred as the start. Return None if there is no such link.
    """
    end = system.particles[index].at
    known = [p.at for p in system.particles[:index]] + [each for s in system.between for each in (s.start, s.end)]
    known += [place for place in named if not any(same(place, each.at) for each in system.particles)]
    moving = moving_in(system, *end.components)
    if all(system.coordinates.get(q) == "length" for q in moving):
        return None  # this particle does not rotate, although another particle may rotate about it
    found = [start for q in moving if (start := _without(end, q)) is not None]
    found += [place for place in known if moving_in(system, *place.components) & moving]
    starts = sorted(found, key=lambda start: _rank(system, start, known))
    for start in starts:
        link = _link(system, start, end)
        if link is not None and _rank(system, start, known)[0] < 3:
            return link
    return None


def _rank(system: System, start: Location, known: list[Location]) -> tuple[int, str]:
    """Return the rank of a possible start; known and fixed points come first."""
    order = 0 if any(same(start, each) for each in known) else 1 if is_fixed(system, start) else 2
    if order == 2 and any(system.coordinates.get(q) == "angle" for q in moving_in(system, *start.components)):
        order = 3
    return order, str(start.components)


def _without(place: Location, q: Symbol) -> Location | None:
    """Return the terms of a position that do not contain q, if the other terms contain sines or cosines; otherwise
    None."""
    parts = [expand(c).as_independent(q, as_Add=True) for c in place.components]
    if any(rest != 0 and not rest.has(sin, cos) for _, rest in parts):
        return None
    return Location(tuple(fixed for fixed, _ in parts))


def _link(system: System, start: Location, end: Location) -> Link | None:
    """Return the link between two points, if its direction but not its length depends on an angle or on time; otherwise
    None."""
    square = Add(*(c**2 for c in (end - start).components))
    turning = {q for q in moving_in(system, square) if system.coordinates.get(q) != "length"}
    if square == 0 or not turning or _varies(square, turning):
        return None
    square = tidied(square)
    if square.free_symbols & turning:
        return None
    length = sqrt(factor(square))
    length = length.xreplace({size: size.args[0] for size in length.atoms(Abs)})
    return Link(start, end, length, not moving_in(system, length))


def _varies(value: Expr, turning: set[Symbol]) -> bool:
    """Return whether the value differs in two numerical samples."""
    others = sorted(value.free_symbols - turning, key=str)
    fixed = {letter: Float(1.31 + 0.17 * i) for i, letter in enumerate(others)}
    # The samples also differ in the differences of the angles, because a distance may depend only on these differences.
    angles = [{q: Float(x * (1 + 0.29 * i)) for i, q in enumerate(sorted(turning, key=str))} for x in SAMPLES]
    one, other = (float(value.xreplace({**fixed, **at}).evalf()) for at in angles)
    return abs(one - other) > 1e-9 * (1 + abs(one))


def link_from_fixed(system: System, end: Location) -> Link | None:
    """Return the link to a moving point from a fixed point at a constant distance; None if there is no such link."""
    return next((link for link in links_about_fixed(system, end) if link.is_constant), None)


def links_about_fixed(system: System, end: Location) -> Iterator[Link]:
    """Yield the links to a moving point from the fixed points about which it rotates."""
    for start in (_without(end, q) for q in sorted(moving_in(system, *end.components), key=str)):
        link = _link(system, start, end) if start is not None and is_fixed(system, start) else None
        if link is not None:
            yield link


# --- angles ----------------------------------------------------------------------------------------------------------


def angle_of_link(system: System, link: Link) -> tuple[Expr, Location] | None:
    """Return the angle by which a link rotates, and the fixed direction of the link at zero angle; None if there is no
    such angle."""
    e = tuple(tidied(c / link.length) for c in link.way.components)
    for angle in _angles(e):
        zero = tuple(c.xreplace({sin(angle): ZERO, cos(angle): Integer(1)}) for c in e)
        if moving_in(system, *zero) or not any(zero):
            continue
        if vanishes(Add(*(a * b for a, b in zip(e, zero, strict=True))) - cos(angle)):
            return angle, Location(zero)
    return None


def _angles(direction: Iterable[Expr]) -> list[Expr]:
    """Return the arguments of sines and cosines; single symbols come first."""
    found = {function.args[0] for c in direction for function in c.atoms(sin, cos)}
    return sorted(found, key=lambda angle: (not angle.is_Symbol, str(angle)))
