"""Answers of a blow: jumps of momenta, rates just after it, impulses, and the change of the energy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property, partial
from typing import Any

from derive.mechanics import (
    Blow,
    Coordinate,
    System,
    energy_after,
    meeting_condition,
    momentum_jump,
    rates_after,
    work_of_impulses,
)
from derive.steps.step import Quantity
from derive.stock.keys.blows import DescribedBlow
from derive.stock.keys.deferred import told_at_part


class BlowAnswers:
    """The quantities of a blow, each derived when it is first needed.

    system, kinetic   return the system and its kinetic energy
    bodies            returns its bodies and particles by name
    """

    def __init__(
        self,
        described: DescribedBlow,
        coordinates: Mapping[str, Coordinate],
        system: Callable[[], System],
        kinetic: Callable[[], Quantity],
        bodies: Callable[[], Mapping[str, Any]],
    ):
        self.described, self.coordinates = described, coordinates
        self._system, self._kinetic, self._bodies = system, kinetic, bodies
        self._jumps: dict[str, Quantity] = {}

    @cached_property
    def blow(self) -> Blow:
        acts = [act.made(self._bodies()) for act in self.described.acts]
        at = {self.coordinates[name]: value for name, value in self.described.at}
        before = {self.coordinates[name]: value for name, value in self.described.before}
        with told_at_part(self.described.acts, acts, self.described.place):
            return Blow(self._system(), *acts, at=at, before=before)

    @property
    def moving(self) -> list[str]:
        return [name for name, q in self.coordinates.items() if q.symbol in self.blow.moving]

    def jump(self, name: str) -> Quantity:
        if name not in self._jumps:
            self._jumps[name] = momentum_jump(self.blow, self._kinetic(), self.coordinates[name])
        return self._jumps[name]

    def jumps(self) -> tuple[Quantity, ...]:
        return tuple(self.jump(name) for name in self.moving)

    @cached_property
    def meetings(self) -> tuple[Quantity, ...]:
        return tuple(meeting_condition(self.blow, i) for i in range(len(self.blow.meetings)))

    @cached_property
    def found(self) -> tuple[Quantity, ...]:
        """Return all rates just after the blow, and the impulses."""
        return rates_after(self.blow, self.jumps(), self.meetings)

    def rates(self) -> tuple[Quantity, ...]:
        return self.found[: len(self.moving)]

    def rate(self, name: str) -> Quantity:
        return dict(zip(self.moving, self.found, strict=False))[name]

    def impulse(self, letter: str) -> Quantity:
        return next(q for q in self.found if q.key == letter)

    @cached_property
    def energy(self) -> Quantity:
        return energy_after(self.blow, self._kinetic(), self.found)

    def asks(self) -> dict[str, Callable[[], Any]]:
        """Return every name that a part may ask for."""
        found: dict[str, Callable[[], Any]] = {
            "jumps": self.jumps,
            "meetings": lambda: self.meetings,
            "rates_after": self.rates,
            "kinetic_energy_after": lambda: self.energy,
            "work_of_impulses": lambda: work_of_impulses(self.blow, self.energy, self.found),
        }
        for name in self.moving:
            found[f"jump_{name}"] = partial(self.jump, name)
            found[f"{name}_dot_after"] = partial(self.rate, name)
        for meeting in self.blow.meetings:
            found[meeting.letter.name] = partial(self.impulse, meeting.letter.name)
        return found
