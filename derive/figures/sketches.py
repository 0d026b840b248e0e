"""A drawing of a system from its formulas alone: `sketch("pendulum", System(...))`.

A particle at a constant distance from a place hangs on a rod, one that moves on a line is a block on a floor, on a
wedge or on a string, and one with a single coordinate is on the curve of its place. What is not recognised is drawn
as a particle where it is; nothing is drawn that the formulas do not say.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

from sympy import ImmutableDenseMatrix, Integer, Rational, Symbol, cos, diff, pi, sin

from derive.algebra.expressions import TIME, explicit, scalar
from derive.algebra.tidy import tidied
from derive.figures.annotations import Axis
from derive.figures.contacts import contact_marks
from derive.figures.marks import Drawing, Mark, Marks
from derive.figures.parts import ConnectionMark, ParticleMark, SpringMark
from derive.figures.placed_bodies import placed_marks
from derive.figures.positions import column_of
from derive.figures.recognition import (
    angle_of_link,
    is_fixed,
    is_spring,
    kept_length,
    link_to,
    moving_in,
    same,
)
from derive.figures.scenes import drawing
from derive.figures.sliding import Sliding
from derive.figures.surroundings import FixedEnd, GravityMark, WayMark
from derive.figures.turning import downwards, turning_marks
from derive.mechanics.systems.places import Location
from derive.mechanics.systems.system import Central, System

__all__ = ["sketch"]

ZERO = Integer(0)
FAR = Rational(8, 5)  # how much of a curve is drawn, in terms of its coordinate
ECCENTRICITY = Rational(1, 2)
BROADSIDE = Rational(23, 36) * pi  # across the usual way of looking


def sketch(key: str, system: System, *more: Marks, values: Mapping[Any, Any] | None = None) -> Drawing:
    """A drawing of a system, made of its places and forces, and put on the record of the problem.

    key      its name, for `drawings:` in the problem
    system   its particles, bodies, springs, central forces and weight
    more     further marks
    values   numbers or proportions with which letters are drawn
    """
    scene = _Scene(system)
    return drawing(key, scene.marks, *more, values={**scene.values, **(values or {})})


class _Scene:
    """What is recognised of a system, and the marks for it."""

    def __init__(self, system: System):
        self.system = system
        self.rows = len(system.places[0].components)
        indices = range(len(system.particles))
        self.links = {i: link for i in indices if (link := link_to(system, i)) is not None}
        self.sliding = Sliding(system, self.links) if self.rows == 2 else None
        held = {*self.links, *(self.sliding.tracks if self.sliding else ())}
        self.free = [i for i in indices if i not in held]

    @property
    def values(self) -> Mapping[Symbol, Any]:
        found = dict(self.sliding.values) if self.sliding else {}
        for link in self.links.values():
            if (radius := kept_length(self.system, link.length)) is not None:
                found[link.length] = radius
        return {**found, **self._carried_round()}

    def _carried_round(self) -> Mapping[Symbol, Any]:
        """What turns about the vertical at a given rate is drawn when its plane is that of the paper."""
        if self.rows != 3 or len(self.system.particles) != 1:
            return {}
        angles = {f.args[0] for c in self.system.particles[0].at.components for f in c.atoms(sin, cos)}
        rates = [diff(angle, TIME) for angle in angles if angle.has(TIME)]
        return {TIME: BROADSIDE / rates[0]} if len(rates) == 1 and not rates[0].has(TIME) else {}

    @cached_property
    def marks(self) -> list[Mark]:
        return list(dict.fromkeys(self._all()))

    def _all(self) -> Iterable[Mark]:
        for each in self.system.between:
            yield from self._between(each)
        yield from contact_marks(self.system)
        for placed in getattr(self.system, "bodies", ()):
            yield from placed_marks(self.system, placed)
        for i, link in self.links.items():
            yield from turning_marks(self.system, link, self.system.particles[i].mass)
            if not is_fixed(self.system, link.start) and self.rows == 3:
                yield from self._ways(link.end)
        if self.sliding:
            yield from self.sliding.marks()
        for i in self.free:
            yield from self._free(self.system.particles[i].at, self.system.particles[i].mass)
        if self.system.weights:
            yield GravityMark(downwards(self.rows), label=self.system.gravity)

    def _moves(self, place: Location) -> bool:
        """Whether something is drawn there that is no end of a spring or a force."""
        return not is_fixed(self.system, place) or any(same(place, particle.at) for particle in self.system.particles)

    # --- forces between two places ---

    def _between(self, each: Central) -> Iterable[Mark]:
        a, b = column_of(each.start), column_of(each.end)
        elastic = is_spring(each)
        if elastic:
            yield SpringMark(a, b, label=tidied(diff(explicit(each.energy), each.distance, 2)))
        for end, way in ((each.start, b - a), (each.end, a - b)):
            if self._moves(end):
                continue
            if elastic:
                turns = any(same(link.start, end) for link in self.links.values())
                yield FixedEnd(column_of(end), downwards(self.rows) if turns else way)
            else:
                yield ParticleMark(column_of(end))
                yield from self._orbit(each, end)
        linked = {(link.start.components, link.end.components) for link in self.links.values()}
        ends = (each.start.components, each.end.components)
        if not elastic and not linked & {ends, ends[::-1]}:
            yield ConnectionMark(a, b)

    def _orbit(self, each: Central, centre: Location) -> Iterable[Mark]:
        """An ellipse about the centre of a force that falls with the square of the distance."""
        other = each.end if same(each.start, centre) else each.start
        link = next((link for link in self.links.values() if same(link.end, other) and same(link.start, centre)), None)
        turned = angle_of_link(self.system, link) if link is not None and self.rows == 2 else None
        if link is None or turned is None or each.distance in tidied(each.pull * each.distance**2).free_symbols:
            return
        angle, _ = turned
        u = scalar("u")
        size = link.length * (1 + ECCENTRICITY * cos(angle)) / (1 + ECCENTRICITY * cos(u))
        e = explicit(ImmutableDenseMatrix(tuple(tidied(c / link.length) for c in link.way.components)))
        yield WayMark(column_of(centre) + size * e.xreplace({angle: u}), u, -pi, pi)

    # --- what is free ---

    def _free(self, at: Location, mass: Any) -> Iterable[Mark]:
        yield ParticleMark(column_of(at), label=mass)
        plain = [c for c in at.components if c in self.system.coordinates]
        if len(plain) == self.rows:
            yield from self._cartesian(at)
        else:
            yield from self._ways(at)

    def _cartesian(self, at: Location) -> Iterable[Mark]:
        for k, q in enumerate(at.components):
            ahead = Location(tuple(q if i == k else ZERO for i in range(self.rows)))
            origin, end = column_of(ahead) * 0, column_of(Rational(4, 3) * ahead)
            yield Axis(origin, end, label=q)
            if self.rows == 2:
                yield ConnectionMark(column_of(at), column_of(ahead))

    def _ways(self, at: Location) -> Iterable[Mark]:
        """The curves of its place, one coordinate after the other; a thing that is there if it is the only one."""
        moving = [q for q in self.system.coordinates if q in moving_in(self.system, *at.components)]
        for q in moving:
            ends = (-pi, pi) if self.system.coordinates[q] == "angle" else (-FAR * q, FAR * q)
            yield WayMark(column_of(at), q, *ends, "wire" if len(moving) == 1 else "trace")
        if len(moving) == 1 and moving[0] in at.components:
            beside = Location(tuple(ZERO if c == moving[0] else c for c in at.components))
            rest = Location(tuple(c.xreplace({moving[0]: ZERO}) for c in at.components))
            yield ConnectionMark(column_of(beside), column_of(at), label=moving[0])
            yield ConnectionMark(column_of(rest), column_of(beside))
