"""Test whether a drawing shows the whole system.

A drawing that lacks a body, spring, wall or string would show different physics, so no such drawing is made.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import combinations

from sympy import diff

from derive.figures.annotations import PointMark
from derive.figures.marks import Mark
from derive.figures.parts import ConnectionMark, ParticleMark
from derive.figures.placed_bodies import ThickBar, pivot_of, placed_outline, with_its_shape
from derive.figures.recognition import Link, carrier_of, is_fixed, is_rod, kept_length, moving_in, same, track_of
from derive.figures.rollers import roller_of
from derive.figures.surroundings import AngleBetween, FieldMark, GravityMark
from derive.figures.touching import Touching
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.system import System

ALONE = (ParticleMark, PointMark, ThickBar, AngleBetween, ConnectionMark, FieldMark, GravityMark)


def is_whole(
    system: System,
    marks: Sequence[Mark],
    links: Collection[Link],
    pairs: Iterable[tuple[int, int]],
    touching: Touching,
) -> bool:
    """Return whether the drawing shows every part of the system.

    links      the links to particles that are drawn
    pairs      the particles that are joined by a string or a rod
    touching   the supports of bodies and particles that are drawn
    """
    return (
        _bodies_are_seen(system)
        and _conditions_are_seen(system, links, pairs, touching)
        and _energies_are_seen(system)
        and all(
            len(moving_in(system, *link.start.components) & {*system.coordinates}) < 2
            for link in links
            if _is_loose(system, link)
        )
        and _is_joined(system, links, pairs, touching)
        and _shows_something(system, marks, links)
    )


def _is_loose(system: System, link: Link) -> bool:
    """Return whether no mass is at the start of the link."""
    return not any(same(link.start, at) for _, at in system.masses)


def _bodies_are_seen(system: System) -> bool:
    """Return whether each body has an outline, or rolls as a wheel, or has an axis from its fixed point in space."""
    return all(
        placed_outline(with_its_shape(placed))
        or (len(placed.at.components) == 3 and not same(placed.at, placed.centre))
        or roller_of(system, placed) is not None
        for placed in system.bodies
    )


def _conditions_are_seen(
    system: System, links: Collection[Link], pairs: Iterable[tuple[int, int]], touching: Touching
) -> bool:
    """Return whether a wall, a length, a string or a rolling surface shows each constraint and rolling condition."""
    lengths = {link.length for link in links if kept_length(system, link.length) is not None}
    tied = {system.particles[i].at: None for pair in pairs for i in pair}
    tracks = {t.by for at in tied if (t := track_of(system, at)) is not None}
    for each in system.constraints:
        moving = set(each.coordinates)
        if each not in touching.shown and not (moving <= lengths or len(moving) > 1 and moving <= tracks):
            return False
    in_space = any(len(placed.at.components) == 3 for placed in system.bodies)
    told = touching.told and (not in_space or len(system.conditions) == 1)
    return not system.conditions or told or not in_space and bool(touching.rolls_at_rest)


def _energies_are_seen(system: System) -> bool:
    """Return whether the system is a single particle, or all energies that are given as formulas are linear.

    A drawing of several particles or of bodies cannot show an additional energy, such as a coupling.
    """
    charged = len([each for each in system.charges if any(each.electric)])
    own = system.stored[: len(system.stored) - charged]
    many = len(system.particles) + len(system.bodies) > 1 or system.bodies
    bent = any(
        diff(each.energy, p, q) != 0 for each in own for p in system.coordinates for q in moving_in(system, each.energy)
    )
    return not (many and bent)


def _is_joined(system: System, links: Collection[Link], pairs: Iterable[tuple[int, int]], touching: Touching) -> bool:
    """Return whether parts that move with the same coordinate are joined in the drawing."""
    places = [particle.at for particle in system.particles] + [placed.centre for placed in system.bodies]
    group = list(range(len(places)))

    def join(i: int, j: int) -> None:
        old, new = group[i], group[j]
        group[:] = [new if g == old else g for g in group]

    for i, j in _neighbours(system, links, places):
        join(i, j)
    for i, j in pairs:
        join(i, j)
    for i, j in combinations(range(len(places)), 2):
        if is_rod(system, places[i], places[j]):
            join(i, j)
    for q in system.coordinates:
        holding = [i for i, place in enumerate(places) if q in moving_in(system, *place.components)]
        if len({group[i] for i in holding}) > 1:
            return False
    return True


def _neighbours(system: System, links: Collection[Link], places: Sequence[Location]) -> Iterator[tuple[int, int]]:
    """Yield the indices of two positions that are joined by a link, a force, or a line on which a particle slides."""
    ends = [(link.start, link.end) for link in links] + [(each.start, each.end) for each in system.between]
    for a, b in ends:
        found = [i for i, place in enumerate(places) if same(place, a) or same(place, b)]
        yield from combinations(found, 2)
    fixed = [link for link in links if is_fixed(system, link.start)]
    for one, other in combinations(fixed, 2):
        if same(one.start, other.start):
            yield tuple(next(i for i, p in enumerate(places) if same(p, link.end)) for link in (one, other))  # type: ignore[misc]
    for i, particle in enumerate(system.particles):
        track = track_of(system, particle.at)
        carrier = carrier_of(system, i, track) if track is not None else None
        if carrier is not None:
            yield i, carrier


def _shows_something(system: System, marks: Sequence[Mark], links: Collection[Link]) -> bool:
    """Return whether the drawing shows a pivot, a free body in space, links or forces between particles without bodies,
    or any mark other than particles, bodies and angles."""
    outlines = [mark for placed in system.bodies for mark in placed_outline(with_its_shape(placed))]
    if any(not isinstance(mark, ALONE) and mark not in outlines for mark in marks):
        return True
    if any(len(placed.at.components) == 2 and pivot_of(system, placed) is not None for placed in system.bodies):
        return True
    acted_on = system.weights or system.constraints or system.conditions or system.given_forces
    lies_in_space = any(len(placed.at.components) == 3 for placed in system.bodies)
    return bool((links or system.between) and not system.bodies or lies_in_space and not acted_on and outlines)
