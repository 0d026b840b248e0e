"""Mechanical systems: energies, equations of motion, equilibria, and impacts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain
from typing import Any

from sympy import Expr, Integer, MatrixBase, diff

from derive.algebra.expressions import Relation, depends_on_time, explicit, rate
from derive.algebra.tidy import tidied
from derive.course.parts import BOTH, ENERGY, LAGRANGE
from derive.course.placement import AFTER, Placement
from derive.course.stock import InLetters, Methods, Stock, told_at
from derive.course.yaml_tree import Tree, Word
from derive.errors import Complaint, Faults, Rejected, rejected
from derive.figures import (
    draw_after,
    draw_alone,
    draw_modes,
    forces_as_named,
    forces_in_state,
    forces_on_pulley,
    forces_on_rope,
    sketch,
)
from derive.figures.positions import column_of
from derive.mechanics import (
    Coordinate,
    System,
    accelerations,
    agreement_of_laws,
    angular_velocity,
    conjugate_momentum,
    conserved,
    coordinate,
    effective_potential,
    energy_equation,
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
    total_energy,
    weight,
)
from derive.mechanics.model.part import moved
from derive.mechanics.model.strings import Line, circles_of
from derive.mechanics.rest.facts import RestOf
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.record import assume, assumed, current_run, forget_words
from derive.steps.step import Quantity, is_zero
from derive.stock.answering.answers import StockAnswers, answer, answer_for_each
from derive.stock.answering.equilibria_with_forces import rest_with_forces
from derive.stock.answering.impacts import ImpactAnswers
from derive.stock.answering.methods import (
    ABOUT,
    by_newton,
    check_available,
    check_effect,
    check_one_law_for_each_key,
    laws_of,
)
from derive.stock.answering.moments import check_starts, started, struck
from derive.stock.answering.one_sided import is_of_constraint, state_one_sided
from derive.stock.answering.sticking import state_static_friction
from derive.stock.keys.deferred import made, parts_of, told_at_part
from derive.stock.keys.places import PLACE
from derive.stock.keys.systems import DescribedSystem, SystemKeys, constant, read
from derive.witness.facts import Rest

POTENTIAL_ENERGY = "lagrange.potential_energy"  # the rule of the steps that state assumptions about springs in words
SYSTEM = "system"  # the key of the drawing of a system


class SystemAnswers(StockAnswers[DescribedSystem]):
    """The quantities of a system."""

    def __init__(self, described: DescribedSystem, other: SystemAnswers | None = None):
        """Make the answers of a system; `other` has the answers of the same system by another method."""
        super().__init__(described)
        self.other = other
        self.coordinates = {
            name: coordinate(name, kind, positive=positive) for name, kind, positive in described.coordinates
        }

    @property
    def method(self) -> str:
        """Return the method for the equations of motion, by default `lagrange`."""
        return str(self.described.methods.whole or LAGRANGE)

    def solve(self, asked: Sequence[Word], drawings: Sequence[Placement] = ()) -> dict[str, object]:
        """Return the answers by the requested names, and draw the system."""
        if self.described.given is None:
            with told_at(self.described.place):
                start = started(self.described.results, self.system)
                impact = struck(self.of_impact.impact) if self.of_impact is not None else None
                sketch(SYSTEM, self.system, named=self._named, start=start, impact=impact)
            sliding = next((part.place for part in self.described.acting if "sliding" in part.named), None)
            if sliding is not None:
                with told_at(sliding):
                    check_starts(self.described.results, assumed())
        answers = self._by_methods(asked, drawings)
        steps = with_ancestors(returned_quantities(list(answers.values()))).values()
        if not any(each.step.rule == POTENTIAL_ENERGY for each in steps):
            forget_words()
        self._check_letters()
        self._check_kept()
        if self.described.given is None:
            self._draw_forces()
            self._draw_after(drawings)
            run = current_run.get()
            draw_modes(self.system, run.established if run is not None else (), self._named, SYSTEM)
            self._state_static_friction()
            state_one_sided(self.system.constraints)
        return answers

    def _by_methods(self, asked: Sequence[Word], drawings: Sequence[Placement]) -> dict[str, object]:
        """Return the answers by the requested names, each derived by the method of its part."""
        methods, whole = self.described.methods, self.described.methods.whole
        groups: dict[Word | None, list[Word]] = {whole: []}
        for name in asked:
            groups.setdefault(methods.of(name), []).append(name)
        found: dict[str, object] = {}
        for method, names in groups.items():
            check_available(method, names, self.described.made)
            if method == whole:
                answers = super().solve(names, drawings)
            else:
                answers = type(self)(replace(self.described, methods=Methods(method)), self).by_name.answers(names)
            check_effect(method, answers)
            found |= answers
        check_one_law_for_each_key(found, methods.stated)
        return {str(name): found[str(name)] for name in asked}

    def _draw_after(self, drawings: Sequence[Placement]) -> None:
        """Draw the system just after an impact, if the problem asks for this drawing."""
        for each in (each for each in drawings if each.key == AFTER and not each.is_of_engine):
            if self.of_impact is None:
                rejected("drawing", "the drawing `after` needs an impact", each.place, "describe it under `impact`")
            rates = [self.of_impact.rate_after(name) for name in self.of_impact.moving]
            draw_after(AFTER, self.system, struck(self.of_impact.impact), rates, self._named)

    @cached_property
    def _named(self) -> list[Any]:
        return list(made(self.described.named, self.parts_by_name))

    def place_of_mark(self, node: Tree, name: str, letters: InLetters) -> MatrixBase:
        """Return the position of a place that is written in the file, by its name or by components."""
        faults = Faults()
        written = PLACE.read(node, name, faults)
        faults.stop()
        places = self.described.places
        assert written is not None and places is not None
        with told_at(node.place):
            found = made(places.at(written, name), self.parts_by_name)
            return column_of(getattr(found, "centre", None) or getattr(found, "at", None) or found)

    def _state_static_friction(self) -> None:
        of = {each.force.name: each for each in self.system.constraints}
        for part in self.described.acting:
            if "static" in part.named:
                name = part.named["force"]
                contact = [of[each] for each in (name, *(f"{name}_{axis}" for axis in "xyz")) if each in of]
                with told_at(part.place):
                    state_static_friction(contact, self.by_name.one)

    def _draw_forces(self) -> None:
        run = current_run.get()
        steps = run.established if run is not None else ()
        at_rest, along = _forces_found(steps, self.system)
        found = []
        tensions = self._drawn_tensions(steps)
        leads_to = [step.key for step in tensions.values()]
        for name, part in self.parts_by_name.items():
            key, of = f"forces_{name}", moved(part, self.system.known)
            if any(line.drawn_on(of) for line in self._lines):
                alone = forces_as_named(key, self.system, of, leads_to, tensions)
            elif laws := laws_of(steps, self.system, of) or self._motions_with_forces(steps):
                alone = forces_as_named(key, self.system, of, laws, at_rest | along)
            else:
                alone = forces_in_state(key, self.system, of, at_rest | along)
                alone = alone or forces_in_state(key, self.system, of, at_rest)
            found += [alone] if alone is not None else []
            for line in (each for each in self._lines if each.rope is not None and each.rope == of):
                found += forces_on_rope(key, self.system, line, leads_to, tensions)
        for name, one in self.pulleys.items():
            wheel = moved(one, self.system.known)
            alone = forces_on_pulley(f"forces_{name}", self.system, wheel, leads_to, tensions)
            found += [alone] if alone is not None else []
        draw_alone(self.system, found)

    @property
    def _lines(self) -> list[Line]:
        return [part for part in self.system.parts if isinstance(part, Line)]

    def _drawn_tensions(self, steps: Sequence[Quantity]) -> dict[Any, Quantity]:
        """Return the steps that derive tensions which only force diagrams show, by the symbols of the tensions."""
        drawn = {line.drawn for line in self._lines if line.drawn is not None}
        return {step.symbol: step for step in steps if step.symbol in drawn and isinstance(step.value, Expr)}

    def _motions_with_forces(self, steps: Sequence[Quantity]) -> list[str]:
        """Return, in space, the keys of the equations of motion that contain constraint forces; in a plane, the list is
        empty."""
        forces = {each.force for each in self.system.constraints}
        is_plane = len(self.system.places[0].components) == 2
        laws = [each for each in steps if each.key.startswith("motion_") and not is_plane]
        return [each.key for each in laws if forces & explicit(each.value).free_symbols]

    def asks(self) -> dict[str, Any]:
        """Return the functions that derive the answers, including answers about an impact."""
        return super().asks() | (self.of_impact.asks() if self.of_impact is not None else {})

    @cached_property
    def of_impact(self) -> ImpactAnswers | None:
        return ImpactAnswers(self.described.impact, self) if self.described.impact is not None else None

    # -- its parts ------------------------------------------------------------------------------------------------

    @cached_property
    def system(self) -> System:
        if self.other is not None:
            return self.other.system
        described = self.described
        if described.given is not None:
            message = "this answer needs bodies and forces, but the Lagrangian is given in place of them"
            raise Rejected(Complaint("given-lagrangian", message))
        acting = self.acting
        weights = [weight(described.gravity)] if described.gravity is not None else []
        with told_at_part(described.acting, acting, described.place):
            parts = chain(*map(parts_of, acting))
            return System(*self.bodies.values(), *self.particles.values(), *parts, *weights)

    @cached_property
    def particles(self) -> dict[str, Any]:
        return {name: particle.made(self.bodies) for name, particle in self.described.particles.items()}

    @cached_property
    def bodies(self) -> dict[str, Any]:
        """Return the bodies in their positions, by name."""
        found: dict[str, Any] = {}
        for name, body in self.described.bodies.items():  # a body may be held at a point of an earlier body
            found[name] = body.made(found)
        return found

    @property
    def parts_by_name(self) -> dict[str, Any]:
        """Return, by name, the particles and bodies on which forces may act."""
        return {**self.particles, **self.bodies}

    @cached_property
    def surfaces(self) -> dict[str, Any]:
        return {name: surface.made(self.parts_by_name) for name, surface in self.described.surfaces.items()}

    @cached_property
    def pulleys(self) -> dict[str, Any]:
        return {name: pulley.made(self.parts_by_name) for name, pulley in self.described.pulleys.items()}

    @property
    def drawn_surfaces(self) -> dict[str, Any]:
        """Return the described surfaces, and the circles on which strings or rods keep particles, such as
        `circle_of_bob`."""
        found = dict(self.surfaces)
        for name, particle in self.particles.items():
            for circle in circles_of(self.system, particle.at):
                found[f"circle_of_{name}"] = circle
        return found

    @cached_property
    def acting(self) -> list[Any]:
        """Return the parts that act on the particles and bodies, in the order of `DescribedSystem.acting`."""
        return [part.made(self.parts_by_name) for part in self.described.acting]

    # -- energies and equations of motion --------------------------------------------------------------------------

    @answer
    def kinetic_energy(self) -> Quantity:
        return kinetic_energy_of(self.system)

    @answer
    def potential_energy(self) -> Quantity:
        return potential_energy_of(self.system)

    @answer
    def lagrangian(self) -> Quantity:
        if self.described.given is None:
            return lagrangian(self.system)
        function, kind = self.described.given
        with told_at(self.described.place):
            return given_lagrangian(function, *(part.made({}) for part in self.described.acting), kind=kind)

    @answer
    def equations_of_motion(self) -> tuple[Quantity, ...]:
        return self.motions if self.method != BOTH else (*self.motions, *self.by_lagrange, *self.agreements)

    @property
    def motions(self) -> tuple[Quantity, ...]:
        """Return one equation of motion for each independent coordinate, derived by `self.method`."""
        return tuple(self.motion(name) for name in self.independent)

    @cached_property
    def by_lagrange(self) -> tuple[Quantity, ...]:
        """Return Lagrange's equations, for a comparison with Newton's laws."""
        named = self.independent.items()
        return tuple(equation_of_motion(self.lagrangian, q, key=f"lagrange_{name}") for name, q in named)

    @cached_property
    def agreements(self) -> tuple[Quantity, ...]:
        """Return the steps that show that Lagrange's equations contain Newton's laws."""
        return tuple(agreement_of_laws(law, self.by_lagrange) for law in self.motions)

    @answer
    def momenta(self) -> tuple[Quantity, ...]:
        return tuple(self.momentum(name) for name in self.coordinates)

    @answer
    def conserved(self) -> tuple[Quantity, ...]:
        help_line = "`noether` under `results` finds what another symmetry conserves, such as a sum of momenta"
        return _some(self.cyclic.values(), "no cyclic coordinate of this system has a constant momentum", help_line)

    @answer
    def energy_function(self) -> Quantity:
        """Return the energy function h of the Lagrangian or, if the method is not `lagrange`, the energy T + U."""
        return energy_function(self.lagrangian) if self.method == LAGRANGE else total_energy(self.system)

    @answer
    def energy_function_rate(self) -> Quantity:
        return energy_function_rate(self.energy_function)

    @answer
    def hamiltonian(self) -> Quantity:
        return hamiltonian(self.lagrangian)

    @answer
    def hamilton_equations(self) -> tuple[Quantity, ...]:
        return hamilton_equations(self.hamiltonian)

    @answer
    def routhian(self) -> Quantity:
        return routhian(self.lagrangian, *self.cyclic.values())

    @answer
    def effective_potential(self) -> Quantity:
        if not self.kept:
            return effective_potential(self.lagrangian, *self.cyclic.values())
        by_letters = effective_potential(self.lagrangian, *self.cyclic.values(), key="potential_by_momenta")
        return put_in(by_letters, *self.kept.values(), key="effective_potential")

    # -- equilibria and small motions ------------------------------------------------------------------------------

    @answer
    def equilibria(self) -> tuple[Quantity, ...]:
        """Return the equilibria; with constraint forces, the positions and forces that solve the static equations."""
        if self.described.given is not None or not self.system.constraints:
            return self.stationary
        self._check_friction_at_rest()
        forces = [each.force for each in self.system.constraints]
        if self.method in ABOUT:
            balances = [
                by_newton(self.system, q, f"balance_{name}", at_rest=True) for name, q in self.coordinates.items()
            ]
            return rest_with_forces(balances, self.coordinates, forces)
        return rest_with_forces(self.motions, self.independent, forces)

    @answer
    def stability(self) -> tuple[Quantity, ...]:
        if self.state is not None:
            return self._stability_at(self.state)
        return tuple(found for at in self.stationary for found in self._stability_at(at))

    @answer
    def linearised(self) -> tuple[Quantity, ...]:
        return self._linearised_at(self.state)

    @answer
    def normal_modes(self) -> tuple[Quantity, ...]:
        return normal_modes(self.linearised)

    @answer
    def frequency(self) -> tuple[Quantity, ...]:
        found = tuple(q for q in self.normal_modes if q.key.partition("_")[0] == "frequency")
        if not found:
            help_line = "ask for `normal_modes`, which give the rates of decay"
            raise Rejected(Complaint("no-oscillation", "the damped motion does not oscillate", help=help_line))
        return found

    @answer
    def period(self) -> Quantity:
        if len(self.normal_modes) != 1:
            message = "`period` needs a motion with one frequency and without damping"
            raise Rejected(Complaint("wrong-argument", message, help="ask for `normal_modes`"))
        if self.normal_modes[0].value == 0:
            message = "nothing drives the system back to this state, so there is no oscillation about it"
            raise Rejected(
                Complaint(
                    "no-oscillation",
                    message,
                    help="check `gravity`, the springs and the point at which each body is held",
                )
            )
        return period(self.normal_modes[0])

    # -- rolling, rotation, forces of constraint --------------------------------------------------------------------

    @answer
    def no_slip(self) -> tuple[Quantity, ...]:
        kept = "here constraint forces prevent slipping, so `no_slip` eliminates no coordinate"
        solved = [each for each in chain(*map(parts_of, self.acting)) if isinstance(each, Quantity)]
        is_kept = any(each.enforcer == "friction" for each in self.system.constraints)
        return _some(solved, kept if is_kept else "nothing rolls in this system")

    @answer
    def angular_velocity(self) -> tuple[Quantity, ...]:
        in_space = [angular_velocity(body.turned) for body in self.bodies.values() if not body.is_plane]
        message = "no body of this system rotates in space: in a plane the angular velocity is the rate of an angle"
        return _some(in_space, message)

    @answer
    def accelerations(self) -> Any:
        return accelerations(*self.motions)

    @answer
    def multipliers(self) -> Any:
        return multipliers(*self.motions)

    # -- one answer for each coordinate or force --------------------------------------------------------------------

    @answer_for_each("motion_{}", lambda self: self.coordinates)
    def motion(self, name: str) -> Quantity:
        q, key = self.coordinates[name], f"motion_{name}"
        if self.method in ABOUT:
            return by_newton(self.system, q, key, ABOUT[self.method])
        if self.method == ENERGY:
            return energy_equation(self.energy_function, self.system, q, key)
        return equation_of_motion(self.lagrangian, q, key=key)

    @answer_for_each("momentum_{}", lambda self: self.coordinates)
    def momentum(self, name: str) -> Quantity:
        return conjugate_momentum(self.lagrangian, self.coordinates[name])

    @answer_for_each("conserved_{}", lambda self: self.coordinates)
    def one_conserved(self, name: str) -> Quantity:
        if name not in self.cyclic:
            conserved(self.lagrangian, self.coordinates[name])  # raises the error if this momentum is not constant
        return self.cyclic[name]

    @answer_for_each("constant_{}", lambda self: dict(self.described.kept))
    def one_kept(self, name: str) -> Quantity:
        return self.kept[name]

    @answer_for_each("acceleration_{}", lambda self: self.coordinates)
    def acceleration(self, name: str) -> Quantity:
        return self.by_name.one("accelerations", f"acceleration_{name}")

    @answer_for_each("{}", lambda self: self.forces_of_constraint)
    def force_of_constraint(self, letter: str) -> Quantity:
        return self.by_name.one("multipliers", letter)

    # -- what answers are derived from -------------------------------------------------------------------------------

    @property
    def forces_of_constraint(self) -> list[str]:
        return [c.force.name for c in self.system.constraints] if self.described.given is None else []

    @cached_property
    def cyclic(self) -> dict[str, Quantity]:
        """Return the constant momenta, by the names of their coordinates."""
        L = explicit(self.lagrangian.value)
        letters = dict(self.described.conserved)
        found = {}
        for name, q in self.independent.items():
            if L.has(q.rate) and not L.has(q.symbol) or name in letters:
                own = None if name in dict(self.described.kept) else letters.get(name) or constant(f"p_{name}")
                try:
                    found[name] = conserved(self.lagrangian, q, value=own)
                except Rejected as refused:
                    if name in letters or any(each.code != "not-cyclic" for each in refused.complaints):
                        raise  # otherwise a force acts along q, so the momentum of q is not constant
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
        """Return the Routhian if it can replace the Lagrangian; otherwise the Lagrangian."""
        is_left = self.cyclic and len(self.cyclic) < len(self.independent)
        return self.routhian if is_left and not self._has_place_of_cyclic else self.lagrangian

    @property
    def _has_place_of_cyclic(self) -> bool:
        return any(name in self.cyclic for name, _ in self.described.at)

    @cached_property
    def independent(self) -> dict[str, Coordinate]:
        """Return the coordinates that remain after conditions such as rolling have eliminated others."""
        if self.method != LAGRANGE:
            return {name: q for name, q in self.coordinates.items() if q.symbol in self.system.coordinates}
        moving = self.lagrangian.coordinates
        return {name: q for name, q in self.coordinates.items() if q.symbol in moving}

    @cached_property
    def potential_at_rest(self) -> Quantity:
        """Return the function that is stationary at equilibria: the potential energy, an effective potential energy or
        the Lagrangian."""
        if self.described.given is not None:
            return self.effective_potential if 0 < len(self.cyclic) < len(self.independent) else self.lagrangian
        self._check_friction_at_rest()
        still: Mapping[Any, Any] = dict.fromkeys([q.rate for q in self.coordinates.values()], Integer(0))
        is_driven = explicit(self.kinetic_energy.value).xreplace(still) != 0
        is_pushed = is_driven or bool(self.system.given_forces)
        if self.system.constraints:  # a constraint force may act along a cyclic coordinate
            return self.lagrangian if is_pushed else self.potential_energy
        self._assume_momenta()
        if self.cyclic and len(self.cyclic) < len(self.independent) or is_driven and len(self.independent) == 1:
            return self.effective_potential
        return self.lagrangian if is_pushed else self.potential_energy

    def _assume_momenta(self) -> None:
        """Assume that each constant momentum with a positive symbol is positive. Assume that any other constant
        momentum is not zero, if the equilibrium may depend on this momentum."""
        left = [q.symbol for name, q in self.independent.items() if name not in self.cyclic]
        for symbol in (momentum.symbol for momentum in self.cyclic.values()):
            if symbol.is_positive:
                assume(Relation(symbol, ">", Integer(0)))
        for symbol in (momentum.symbol for momentum in self.cyclic.values()):
            forces = [tidied(diff(explicit(self.effective_potential.value), q)) for q in left]
            if not symbol.is_positive and (not left or any(force.has(symbol) for force in forces)):
                assume(Relation(symbol, "!=", Integer(0)))

    @cached_property
    def stationary(self) -> tuple[Quantity, ...]:
        """Return the states at which `potential_at_rest` is stationary."""
        return equilibria(self.potential_at_rest)

    def _check_friction_at_rest(self) -> None:
        letters = {each.force for each in self.system.constraints}
        if any(c.free_symbols & letters for force in self.system.given_forces for c in force.components):
            message = "sliding friction does not act at rest: static friction can have any value up to a maximum"
            help_line = "describe the contact with static friction, `{static: mu_s, force: F}`"
            raise Rejected(Complaint("friction-at-rest", message, help=help_line))

    def _stability_at(self, at: Quantity | Mapping[Any, Expr]) -> tuple[Quantity, ...]:
        """Decide stability by the potential energy or, if the potential energy does not decide, by small motions.

        Gyroscopic forces may stabilise a state at which the potential energy has no minimum.
        """
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
        """Return the given state about which motions are linearised; None if none is given."""
        if self.described.at_rest is not None:
            return self.by_name.one("equilibria", self.described.at_rest, self.described.at_rest.place)
        found = {self.coordinates[name]: value for name, value in self.described.at}
        return found or None

    def _linearised_at(self, at: Quantity | Mapping[Any, Expr] | None, key: str = "linearised") -> tuple[Quantity, ...]:
        motions = self.motions
        if self.reduced is not self.lagrangian:
            self._check_momenta_have_symbols()
            left = [q for name, q in self.independent.items() if name not in self.cyclic]
            motions = tuple(equation_of_motion(self.routhian, q, key=f"reduced_{q.symbol.name}") for q in left)
            at = at or self.stationary[0]
        elif at is None and self._is_pushed and len(self.stationary) == 1:
            at = self.stationary[0]
        is_one_of = isinstance(at, Quantity) and at.fact(RestOf) is not None
        others = [each for each in self.stationary if each != at] if is_one_of else []
        found = linearised(motions, at=at, key=key, others=others)
        return found if isinstance(found, tuple) else (found,)

    def _check_momenta_have_symbols(self) -> None:
        """Reject given values of constant momenta, because small motions are derived for any value of a momentum."""
        for name in self.kept:
            message = f"small motions need a symbol for the momentum of {name}, but `conserved` gives a value"
            help_line = f"write `conserved: {{{name}: p}}`, and substitute the value in the result with `put_in`"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))

    @property
    def _is_pushed(self) -> bool:
        """Whether given forces, or terms of a given Lagrangian, may shift the equilibrium."""
        if depends_on_time(self.lagrangian.value):
            return False
        if self.described.given is not None:
            zero = {s: Integer(0) for q in self.coordinates.values() for s in (q.rate, q.symbol)}
            slopes = (diff(explicit(self.lagrangian.value), q.symbol) for q in self.coordinates.values())
            return not all(is_zero(slope.subs(zero)) for slope in slopes)
        pushes = [c for force in self.system.given_forces for c in force.components]
        return bool(pushes) and not any(map(depends_on_time, pushes))

    def _check_kept(self) -> None:
        """Reject given values of constant momenta if no answer depends on them."""
        run = current_run.get()
        used = {each.key for each in (run.established if run is not None else ())}
        names = [name for name, _ in self.described.kept]
        if names and not any(f"constant_{name}" in used for name in names):
            message = f"no answer depends on the value of the momentum of {names[0]}"
            place = next(key.place for key, _ in self.described.without if key == "conserved")
            help_line = f"ask for `effective_potential` or `constant_{names[0]}`, or leave the value out"
            rejected("unused-key", message, place, help_line)

    def _check_letters(self) -> None:
        """Check that each symbol that the description introduces denotes quantities of one kind."""
        run = current_run.get()
        established = run.established if run is not None else []
        for name, place in self.described.brought.items():
            kinds = {q.step.kind: q.key for q in established if getattr(q.symbol, "name", "") == name}
            if len(kinds) > 1:
                keys = " and ".join(f"`{key}`" for key in kinds.values())
                message = f"`{name}` denotes different quantities, {keys}"
                rejected("letter-clash", message, place, "use another symbol on this line")


def _some(found: Iterable[Quantity], otherwise: str, help_line: str | None = None) -> tuple[Quantity, ...]:
    """Return the quantities as a tuple; without quantities, report an error."""
    some = tuple(found)
    if not some:
        raise Rejected(Complaint("wrong-argument", otherwise, help=help_line))
    return some


STOCK = Stock(SystemKeys, read, SystemAnswers)


def _forces_found(steps: Sequence[Any], system: System) -> tuple[dict[Any, Quantity], dict[Any, Quantity]]:
    """Return two mappings, both with the symbols of constraint forces as keys. The first mapping contains the steps
    that derive forces, the second mapping later steps that express these forces in coordinates without rates."""
    found: dict[Any, Quantity] = {}
    along: dict[Any, Quantity] = {}
    rates, coordinates = {rate(q) for q in system.coordinates}, {*system.coordinates}
    forces = {each.force for each in system.constraints}
    for step in steps:
        if step.symbol in forces and is_of_constraint(step):
            found.setdefault(step.symbol, step)
        elif step.symbol in found and not isinstance(step.value, Relation):
            letters = explicit(step.value).free_symbols
            if letters & coordinates and not letters & rates:
                along[step.symbol] = step
    return found, along
