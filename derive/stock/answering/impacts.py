"""Answers of an impact: jumps of momenta, rates just after the impact, impulses, and the change of the energy."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, Protocol

from derive.algebra.expressions import explicit
from derive.course.parts import ANGULAR_MOMENTUM, NEWTON
from derive.mechanics import (
    Coordinate,
    Impact,
    System,
    angular_momentum_law,
    energy_after,
    meeting_condition,
    momentum_jump,
    momentum_law,
    put_in,
    rates_after,
    solved_for,
    work_of_impulses,
)
from derive.mechanics.newton.single_bodies import body_of
from derive.steps.step import Quantity
from derive.stock.answering.answers import Answers, answer, answer_for_each
from derive.stock.keys.deferred import told_at_part
from derive.stock.keys.impacts import DescribedImpact


class OfSystem(Protocol):
    """The answers of the system on which the impulses act."""

    coordinates: Mapping[str, Coordinate]

    @property
    def method(self) -> str: ...
    @property
    def system(self) -> System: ...
    @property
    def kinetic_energy(self) -> Quantity: ...
    @property
    def parts_by_name(self) -> Mapping[str, Any]: ...


class ImpactAnswers(Answers[DescribedImpact]):
    """The quantities of an impact on a system."""

    def __init__(self, described: DescribedImpact, of: OfSystem):
        super().__init__(described)
        self.of = of

    @cached_property
    def impact(self) -> Impact:
        acts = [act.made(self.of.parts_by_name) for act in self.described.acts]
        at = {self.of.coordinates[name]: value for name, value in self.described.at}
        before = {self.of.coordinates[name]: value for name, value in self.described.before}
        with told_at_part(self.described.acts, acts, self.described.place):
            return Impact(self.of.system, *acts, at=at, before=before)

    @property
    def moving(self) -> list[str]:
        return [name for name, q in self.of.coordinates.items() if q.symbol in self.impact.moving]

    @property
    def by_momentum(self) -> bool:
        """Return whether the laws of momentum and of angular momentum replace Lagrange's equations integrated over the
        impact."""
        return self.of.method in (NEWTON, ANGULAR_MOMENTUM)

    @answer
    def jumps(self) -> tuple[Quantity, ...]:
        return tuple(self.jump(name) for name in self.moving)

    @answer
    def meetings(self) -> tuple[Quantity, ...]:
        return tuple(meeting_condition(self.impact, i) for i in range(len(self.impact.meetings)))

    @answer
    def rates_after(self) -> tuple[Quantity, ...]:
        return tuple(self.rate_after(name) for name in self.moving)

    @answer
    def kinetic_energy_after(self) -> Quantity:
        return energy_after(self.impact, self.of.kinetic_energy, self.after)

    @answer
    def work_of_impulses(self) -> Quantity:
        return work_of_impulses(self.impact, self.kinetic_energy_after, self.after)

    @cached_property
    def after(self) -> tuple[Quantity, ...]:
        """Return the rates just after the impact and, if they are needed, the unknown impulses."""
        letters = {meeting.letter for meeting in self.impact.meetings}
        without = [law for law in self.jumps if not explicit(law.value).free_symbols & letters]
        if not self.by_momentum or len(without) + len(self.meetings) != len(self.moving):
            return rates_after(self.impact, self.jumps, self.meetings)
        rates = [self.of.coordinates[name].rate for name in self.moving]
        keys = [f"{name}_dot_after" for name in self.moving]
        return solved_for([*without, *self.meetings], *rates, keys=keys)

    @answer_for_each("jump_{}", lambda self: self.moving)
    def jump(self, name: str) -> Quantity:
        q = self.of.coordinates[name]
        if not self.by_momentum:
            return momentum_jump(self.impact, self.of.kinetic_energy, q)
        rotates = body_of(self.of.system, q.symbol).turn(q.symbol) != 0
        return angular_momentum_law(self.impact, q) if rotates else momentum_law(self.impact, q)

    @answer_for_each("{}_dot_after", lambda self: self.moving)
    def rate_after(self, name: str) -> Quantity:
        return dict(zip(self.moving, self.after, strict=False))[name]

    @answer_for_each("{}", lambda self: [meeting.letter.name for meeting in self.impact.meetings])
    def impulse(self, letter: str) -> Quantity:
        solved = next((q for q in self.after if q.key == letter), None)
        if solved is not None:
            return solved
        symbol = next(each.letter for each in self.impact.meetings if each.letter.name == letter)
        law = next(each for each in self.jumps if explicit(each.value).has(symbol))
        known = [q for q in self.after if explicit(law.value).has(q.symbol)]
        (found,) = solved_for(put_in(law, *known, key=f"{law.key}_after"), symbol, keys=[letter])
        return found
