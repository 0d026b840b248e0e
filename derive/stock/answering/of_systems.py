"""Answers of a system by name, each derived when it is first needed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial
from itertools import chain
from typing import Any, Protocol

from sympy import Expr, Integer, Symbol

from derive.algebra.expressions import Relation, explicit, scalar
from derive.course.stock import told_at
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Place, Rejected, did_you_mean, rejected
from derive.mechanics import (
    Blow,
    Coordinate,
    System,
    accelerations,
    angular_velocity,
    conjugate_momentum,
    conserved,
    coordinate,
    effective_potential,
    energy_function,
    energy_function_rate,
    equation_of_motion,
    equilibria,
    given_lagrangian,
    hamilton_equations,
    hamiltonian,
    kinetic_energy_of,
    lagrangian,
    linear_stability,
    linearised,
    multipliers,
    normal_modes,
    period,
    potential_energy_of,
    put_in,
    routhian,
    stability,
    weight,
)
from derive.mechanics.model.acted_on import check_ground
from derive.steps.derivation import returned_quantities
from derive.steps.record import assume, current_run
from derive.steps.step import Quantity, is_zero
from derive.stock.answering.by_name import ByName
from derive.stock.answering.held_rest import rest_with_forces
from derive.stock.answering.of_blows import BlowAnswers
from derive.stock.keys.blows import DescribedBlow
from derive.stock.keys.deferred import Deferred, told_at_part
from derive.stock.keys.results import Result
from derive.witness.facts import Rest


class OfSystem(Protocol):
    """A description of a system, in symbols."""

    @property
    def coordinates(self) -> tuple[tuple[str, str, bool], ...]: ...
    @property
    def particles(self) -> Mapping[str, Deferred[Any]]: ...
    @property
    def bodies(self) -> Mapping[str, Deferred[Any]]: ...
    @property
    def rolling(self) -> tuple[Deferred[tuple[Any, ...]], ...]: ...
    @property
    def acting(self) -> tuple[Deferred[Any], ...]: ...
    @property
    def gravity(self) -> Expr | None: ...
    @property
    def conserved(self) -> tuple[tuple[str, Symbol], ...]: ...
    @property
    def kept(self) -> tuple[tuple[str, Expr], ...]: ...
    @property
    def at(self) -> tuple[tuple[str, Expr], ...]: ...
    @property
    def at_rest(self) -> Word | None: ...
    @property
    def results(self) -> tuple[Result, ...]: ...
    @property
    def blow(self) -> DescribedBlow | None: ...
    @property
    def brought(self) -> Mapping[str, Place]: ...
    @property
    def place(self) -> Place | None: ...
    @property
    def given(self) -> tuple[Expr, str | None] | None: ...


def constant(name: str, positive: bool = False) -> Symbol:
    """Return the symbol of a constant momentum, which is assumed to be nonzero."""
    return scalar(name, positive=True) if positive else Symbol(name, real=True, nonzero=True)


class Answers:
    """The quantities of a system, and results computed from them."""

    def __init__(self, described: OfSystem):
        self.described = described
        self.coordinates = {
            name: coordinate(name, kind, positive=positive) for name, kind, positive in described.coordinates
        }
        self._moving: dict[str, Quantity] = {}
        self._blow: BlowAnswers | None = None

    @cached_property
    def system(self) -> System:
        described = self.described
        if described.given is not None:
            message = "this needs bodies and forces, but the Lagrangian is given in place of them"
            raise Rejected(Complaint("given-lagrangian", message))
        acting = [part.made(self.parts_by_name) for part in described.acting]
        weights = [weight(described.gravity)] if described.gravity is not None else []
        with told_at_part(described.acting, acting, described.place):
            system = System(*self.bodies.values(), *self.particles.values(), *acting, *weights, *self.rolling)
        for rolling in described.rolling:
            with told_at(rolling.place):
                check_ground(system, rolling.named["ground"])
        return system

    @cached_property
    def particles(self) -> dict[str, Any]:
        """Return the particles by name."""
        return {name: particle.made({}) for name, particle in self.described.particles.items()}

    @cached_property
    def bodies(self) -> dict[str, Any]:
        """Return the bodies with a position, by name."""
        return {name: body.made({}) for name, body in self.described.bodies.items()}

    @property
    def parts_by_name(self) -> dict[str, Any]:
        """Return the particles and bodies on which forces may act by name."""
        return {**self.particles, **self.bodies}

    @cached_property
    def rolling(self) -> tuple[Any, ...]:
        """Return the conditions of rolling without slipping."""
        return tuple(chain(*(one.made(self.bodies) for one in self.described.rolling)))

    @cached_property
    def kinetic_energy(self) -> Quantity:
        return kinetic_energy_of(self.system)

    @cached_property
    def potential_energy(self) -> Quantity:
        return potential_energy_of(self.system)

    @cached_property
    def lagrangian(self) -> Quantity:
        if self.described.given is None:
            return lagrangian(self.system)
        function, kind = self.described.given
        with told_at(self.described.place):
            return given_lagrangian(function, *(part.made({}) for part in self.described.acting), kind=kind)

    @cached_property
    def cyclic(self) -> dict[str, Quantity]:
        """Return the constant momenta, by the names of their coordinates."""
        L = explicit(self.lagrangian.value)
        letters = dict(self.described.conserved)
        found = {}
        for name, q in self.coordinates.items():
            if L.has(q.rate) and not L.has(q.symbol) or name in letters:
                own = None if name in self.kept else letters.get(name) or constant(f"p_{name}")
                try:
                    found[name] = conserved(self.lagrangian, q, value=own)
                except Rejected as refused:
                    if name in letters or any(each.code != "not-cyclic" for each in refused.complaints):
                        raise  # otherwise a force acts along it, so its momentum is not constant
        return found

    @cached_property
    def kept(self) -> dict[str, Quantity]:
        """Return the constant momenta whose values are given."""
        return {
            name: conserved(self.lagrangian, self.coordinates[name], value=value, key=f"constant_{name}")
            for name, value in self.described.kept
        }

    @property
    def reduced(self) -> Quantity:
        """Return the Lagrangian, or the Routhian if momenta are constant, coordinates remain and no cyclic one is
        given.
        """
        is_left = self.cyclic and len(self.cyclic) < len(self.coordinates)
        return self.routhian if is_left and not self._has_place_of_cyclic else self.lagrangian

    @property
    def _has_place_of_cyclic(self) -> bool:
        return any(name in self.cyclic for name, _ in self.described.at)

    @cached_property
    def routhian(self) -> Quantity:
        return routhian(self.lagrangian, *self.cyclic.values())

    @cached_property
    def effective_potential(self) -> Quantity:
        if not self.kept:
            return effective_potential(self.lagrangian, *self.cyclic.values())
        by_letters = effective_potential(self.lagrangian, *self.cyclic.values(), key="potential_by_momenta")
        return put_in(by_letters, *self.kept.values(), key="effective_potential")

    @cached_property
    def energy_function(self) -> Quantity:
        return energy_function(self.lagrangian)

    @cached_property
    def hamiltonian(self) -> Quantity:
        return hamiltonian(self.lagrangian)

    @cached_property
    def independent(self) -> dict[str, Coordinate]:
        """Return the coordinates that remain after rolling expresses some by the others."""
        moving = self.lagrangian.coordinates
        return {name: q for name, q in self.coordinates.items() if q.symbol in moving}

    @property
    def motions(self) -> dict[str, Quantity]:
        return {name: self.motion(name) for name in self.independent}

    def motion(self, name: str) -> Quantity:
        if name not in self._moving:
            self._moving[name] = equation_of_motion(self.lagrangian, self.coordinates[name], key=f"motion_{name}")
        return self._moving[name]

    @cached_property
    def potential_at_rest(self) -> Quantity:
        """Return the effective potential if something rotates or a momentum is constant, else the potential energy."""
        if self.described.given is not None:
            return self.effective_potential if 0 < len(self.cyclic) < len(self.coordinates) else self.lagrangian
        still: Mapping[Any, Any] = dict.fromkeys([q.rate for q in self.coordinates.values()], Integer(0))
        is_driven = explicit(self.kinetic_energy.value).xreplace(still) != 0
        is_pushed = is_driven or bool(self.system.given_forces)
        if self.system.constraints:  # a constraint force may act along a cyclic coordinate
            return self.lagrangian if is_pushed else self.potential_energy
        for momentum in self.cyclic.values():
            assume(Relation(momentum.symbol, ">" if momentum.symbol.is_positive else "!=", Integer(0)))
        if self.cyclic and len(self.cyclic) < len(self.coordinates) or is_driven and len(self.coordinates) == 1:
            return self.effective_potential
        return self.lagrangian if is_pushed else self.potential_energy

    @cached_property
    def equilibria(self) -> tuple[Quantity, ...]:
        return equilibria(self.potential_at_rest)

    @property
    def rest(self) -> tuple[Quantity, ...]:
        """Return equilibria; where forces keep constraints, the positions and forces that the equations determine."""
        if self.described.given is not None or not self.system.constraints:
            return self.equilibria
        letters = {each.force for each in self.system.constraints}
        if any(c.free_symbols & letters for force in self.system.given_forces for c in force.components):
            message = "sliding friction does not act at rest: static friction can have any value up to its greatest"
            help_line = (
                "ask for the equilibria without friction; with static friction there is a range of them around each"
            )
            raise Rejected(Complaint("friction-at-rest", message, help=help_line))
        return rest_with_forces(self.motions, self.independent, [each.force for each in self.system.constraints])

    @cached_property
    def stability(self) -> tuple[Quantity, ...]:
        if self.state is not None:
            return self._stability_at(self.state)
        return tuple(found for at in self.equilibria for found in self._stability_at(at))

    def _stability_at(self, at: Quantity | Mapping[Any, Expr]) -> tuple[Quantity, ...]:
        """Decide stability by the potential energy, or by small motions if gyroscopic forces may stabilise it."""
        try:
            return (stability(self.potential_at_rest, at),)
        except Rejected as refused:
            if any(each.code != "not-decided" for each in refused.complaints):
                raise
        if not isinstance(at, Quantity):
            return tuple(returned_quantities(linear_stability(self._linearised_at(at))))
        rest = at.needed(Rest)
        is_plain = self.state is None and rest.exists is None and all(is_zero(value) for value in rest.values.values())
        small = self.linearised if is_plain else self._linearised_at(at, at.key.replace("rest", "linearised"))
        return tuple(returned_quantities(linear_stability(small, key=at.key.replace("rest", "stability"))))

    @property
    def state(self) -> dict[Any, Expr] | Quantity | None:
        """Return the state about which the motion is small, if one is given."""
        if self.described.at_rest is not None:
            return self._state_called(self.described.at_rest)
        found = {self.coordinates[name]: value for name, value in self.described.at}
        return found or None

    def _state_called(self, name: Word) -> Quantity:
        """Return the equilibrium of a name such as `rest_2` or `equilibrium_2`."""
        states = self.by_name.named(Word.at("equilibria", name.place))
        found = self.by_name.one_of("equilibria", name, states)
        if found is None:
            help_line = f"the equilibria are {', '.join(f'`{q.key}`' for q in states)}"
            rejected("no-such-answer", f"`{name}` is not an equilibrium", name.place, help_line)
        return found

    @cached_property
    def linearised(self) -> tuple[Quantity, ...]:
        return self._linearised_at(self.state)

    def _linearised_at(self, at: Quantity | Mapping[Any, Expr] | None, key: str = "linearised") -> tuple[Quantity, ...]:
        motions = tuple(self.motions.values())
        if self.reduced is not self.lagrangian:
            left = [q for name, q in self.coordinates.items() if name not in self.cyclic]
            motions = tuple(equation_of_motion(self.routhian, q, key=f"reduced_{q.symbol.name}") for q in left)
            at = at or self.equilibria[0]
        elif at is None and self._is_pushed and len(self.equilibria) == 1:
            at = self.equilibria[0]
        found = linearised(motions, at=at, key=key)
        return found if isinstance(found, tuple) else (found,)

    @property
    def _is_pushed(self) -> bool:
        return self.described.given is not None or bool(self.system.given_forces)

    @cached_property
    def normal_modes(self) -> tuple[Quantity, ...]:
        return normal_modes(self.linearised)

    @property
    def frequencies(self) -> tuple[Quantity, ...]:
        return tuple(q for q in self.normal_modes if q.key.partition("_")[0] == "frequency")

    @cached_property
    def period(self) -> Quantity:
        if len(self.normal_modes) != 1:
            raise Rejected(Complaint("wrong-argument", "`period` is about one frequency, but there are several"))
        if self.normal_modes[0].value == 0:
            message = "nothing drives the system back to this state, so it does not oscillate about it"
            raise Rejected(Complaint("no-oscillation", message, help="is each body held where it should be?"))
        return period(self.normal_modes[0])

    def asks(self) -> dict[str, Callable[[], Any]]:
        """Return every name that a part may ask for."""
        found: dict[str, Callable[[], Any]] = {
            "kinetic_energy": lambda: self.kinetic_energy,
            "potential_energy": lambda: self.potential_energy,
            "lagrangian": lambda: self.lagrangian,
            "equations_of_motion": lambda: tuple(self.motions.values()),
            "momenta": lambda: tuple(conjugate_momentum(self.lagrangian, q) for q in self.coordinates.values()),
            "conserved": lambda: self._some(tuple(self.cyclic.values()), "no coordinate of this system is cyclic"),
            "energy_function": lambda: self.energy_function,
            "energy_function_rate": lambda: energy_function_rate(self.energy_function),
            "hamiltonian": lambda: self.hamiltonian,
            "hamilton_equations": lambda: hamilton_equations(self.hamiltonian),
            "routhian": lambda: self.routhian,
            "effective_potential": lambda: self.effective_potential,
            "equilibria": lambda: self.rest,
            "stability": lambda: self.stability,
            "linearised": lambda: self.linearised,
            "normal_modes": lambda: self.normal_modes,
            "frequency": lambda: self.frequencies,
            "period": lambda: self.period,
            "no_slip": lambda: self._some(
                tuple(each for each in self.rolling if isinstance(each, Quantity)),
                "forces keep the conditions of rolling here, so `no_slip` eliminates nothing"
                if self.rolling
                else "nothing rolls in this system",
            ),
            "angular_velocity": lambda: self._some(
                tuple(angular_velocity(body.turned) for body in self.bodies.values() if not body.is_plane),
                "no body of this system rotates in space: in a plane its angular velocity is the rate of an angle",
            ),
            "accelerations": lambda: accelerations(*self.motions.values()),
            "multipliers": lambda: multipliers(*self.motions.values()),
        }
        for name, q in self.coordinates.items():
            found[f"motion_{name}"] = partial(self.motion, name)
            found[f"momentum_{name}"] = partial(self._one_momentum, q)
            found[f"conserved_{name}"] = partial(self._one_conserved, name)
            if name in dict(self.described.kept):
                found[f"constant_{name}"] = partial(self._one_kept, name)
            found[f"acceleration_{name}"] = partial(self._one_of, "accelerations", f"acceleration_{name}")
        for constraint in self.system.constraints if self.described.given is None else ():
            found[constraint.force.name] = partial(self._one_of, "multipliers", constraint.force.name)
        if self.described.blow is not None:
            found |= self.blow_of(self.described.blow).asks()
        return found

    @cached_property
    def by_name(self) -> ByName:
        """Return these answers, and results computed from them."""
        again = partial(_again, self.described)
        return ByName(self.asks(), "", self.described.results, self.coordinates, again)

    def blow_of(self, described: DescribedBlow) -> BlowAnswers:
        if self._blow is None:
            self._blow = BlowAnswers(
                described,
                self.coordinates,
                lambda: self.system,
                lambda: self.kinetic_energy,
                lambda: self.parts_by_name,
            )
        return self._blow

    @property
    def blow(self) -> Blow | None:
        """Return the blow on this system, if one is described."""
        return self.blow_of(self.described.blow).blow if self.described.blow is not None else None

    def check_letters(self) -> None:
        """Check that a symbol of the description and steps with the same symbol are of one kind."""
        for name, place in self.described.brought.items():
            kinds = {q.step.kind: q.key for q in self.established if getattr(q.symbol, "name", "") == name}
            if len(kinds) > 1:
                keys = " and ".join(f"`{key}`" for key in kinds.values())
                message = f"`{name}` denotes two quantities, {keys}"
                rejected("letter-clash", message, place, "use another symbol on this line")

    def _some(self, found: tuple[Quantity, ...], otherwise: str) -> tuple[Quantity, ...]:
        if not found:
            raise Rejected(Complaint("wrong-argument", otherwise))
        return found

    def _one_momentum(self, q: Coordinate) -> Quantity:
        return conjugate_momentum(self.lagrangian, q)

    def _one_of(self, several: str, key: str) -> Quantity:
        assert self.described.place is not None
        found = {q.key: q for q in self.by_name.named(Word.at(several, self.described.place))}
        if key not in found:
            raise Rejected(Complaint("wrong-argument", f"`{several}` has no `{key}`", help=did_you_mean(key, found)))
        return found[key]

    def _one_kept(self, name: str) -> Quantity:
        return self.kept[name]

    def _one_conserved(self, name: str) -> Quantity:
        if name not in self.cyclic:
            conserved(self.lagrangian, self.coordinates[name])  # raises the error if its momentum is not constant
        return self.cyclic[name]

    @property
    def established(self) -> Sequence[Quantity]:
        return run.established if (run := current_run.get()) else []


def _again(described: OfSystem) -> ByName:
    return Answers(described).by_name
