"""Input of the witness for a system: its parts as described, before any constraint is used."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import explicit, scalar
from derive.mechanics.bodies.placed import PlacedBody, central_second_moments
from derive.mechanics.kinematics.places import Axes
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.forces import Charge, Damper, GivenForce, StoredEnergy
from derive.steps.record import assumed
from derive.steps.step import Quantity, Witness
from derive.witness import description as plain

XYZ = (0, 1, 2)
SOLVED = "answers.solved_for"
CONSERVED = "hamilton.conserved"  # the rule of conserved momenta


@dataclass(frozen=True)
class Described(Witness):
    """The system of a quantity, as the witness sees it."""

    missing = "does not belong to a described system"
    description: plain.Description

    def testimony(self, quantity: Quantity, judged: Any, outcome: str) -> Verdict | None:
        from derive.witness import judges

        judge = judges.JUDGES.get(quantity.step.rule)
        if judge is None:
            return None
        momenta = {letter_of_momentum(q): q for q, _ in self.description.coordinates}
        for each in quantity.ancestors():
            if each.step.rule == CONSERVED and isinstance(each.symbol, Symbol):
                momenta[each.symbol] = dict(each.step.roles)["coordinate"]
        return judges.testimony(judge, self.description, quantity, judged, outcome, momenta, assumed())


@dataclass(frozen=True)
class Struck(Witness):
    """The impact that a quantity follows from, as the witness sees it."""

    missing = "does not follow from an impact"
    impact: plain.Impact

    def testimony(self, quantity: Quantity, judged: Any, outcome: str) -> Verdict | None:
        if quantity.step.rule != SOLVED:
            return None
        from derive.witness import impact

        return impact.testimony(self.impact, quantity)


def letter_of_momentum(q: Symbol) -> Symbol:
    return scalar(f"p_{q.name}")


def body_of(placed: PlacedBody) -> plain.Body:
    """A body by its known point, the displacement of its centre of mass from there, and its second moments."""
    axes = placed.in_plane if placed.is_plane else XYZ
    arm = explicit(ImmutableDenseMatrix(placed.body.middle.position - placed.point.position))
    turns = placed.turned.turns if isinstance(placed.turned, Axes) else ((2, placed.turned),)
    spread = central_second_moments(placed.body)
    return plain.Body(
        mass=placed.body.mass,
        place=placed.at.components,
        arm=tuple(arm[i] for i in axes),
        spread=tuple(tuple(spread[i, j] for j in XYZ) for i in XYZ),
        turns=tuple(turns),
        axes=tuple(axes),
    )


def condition_of(kept: Constraint) -> plain.Condition:
    return plain.Condition(kept.residual, kept.in_rates, kept.force)


def described(
    parts: Sequence[Any],
    particles: tuple[plain.Particle, ...],
    pairs: tuple[plain.Pair, ...],
    known: Mapping[Symbol, Expr],
    gravity: Expr | None,
    coordinates: Mapping[Symbol, str],
    lagrangian: Expr | None = None,
) -> plain.Description:
    """Particles, bodies and the forces on them; or a given Lagrangian with the forces along its coordinates.

    known   coordinates that a condition expresses by others; the condition is kept as a constraint here
    """
    bodies = [part for part in parts if isinstance(part, PlacedBody)]
    charges = [part for part in parts if isinstance(part, Charge)]
    kept = [plain.Condition(q - function) for q, function in known.items()]
    return plain.Description(
        coordinates=tuple(coordinates.items()),
        particles=particles,
        bodies=tuple(body_of(part) for part in parts if isinstance(part, PlacedBody)),
        gravity=gravity,
        pairs=pairs,
        energies=tuple(part.energy for part in parts if isinstance(part, StoredEnergy)),
        forces=tuple(_force(each, bodies) for part in parts if isinstance(part, GivenForce) for each in _pair(part)),
        drags=tuple(
            plain.Drag(part.constant, _place(part), _number(part.of, bodies))
            for part in parts
            if isinstance(part, Damper)
        ),
        charges=tuple(plain.Charge(c.charge, c.at.components, c.electric, _field(c)) for c in charges),
        conditions=(*kept, *(condition_of(part) for part in parts if isinstance(part, Constraint))),
        lagrangian=lagrangian,
    )


def _pair(force: GivenForce) -> list[GivenForce]:
    """The force and its reaction, if there is one."""
    return [force] if force.opposite is None else [force, force.opposite]


def _force(force: GivenForce, bodies: Sequence[PlacedBody]) -> plain.Force:
    return plain.Force(force.components, _place(force), _number(force.of, bodies))


def _place(acting: GivenForce | Damper) -> plain.Vector:
    """The place of action: on a body that place of it; on a particle the place of the particle."""
    return acting.at if acting.point.held else acting.point.place


def _number(of: Any, bodies: Sequence[PlacedBody]) -> int | None:
    """The index of the body that contains the particle."""
    return next((i for i, body in enumerate(bodies) if body is of or body == of), None)


def places_that_move_alone(of: plain.Description, places: Sequence[plain.Vector]) -> list[int]:
    """The indices of the places that move with no body or particle and not with the ground."""
    moving = {q for q, _ in of.coordinates}
    asked = [i for i, place in enumerate(places) if any(explicit(c).free_symbols & moving for c in place)]
    if not asked or of.lagrangian is not None:
        return []
    from derive.witness.material import moving_alone

    return [asked[i] for i in moving_alone(of, [places[i] for i in asked])]


def conditions_that_nothing_keeps(of: plain.Description) -> list[plain.Condition]:
    """The constraints whose gradient vanishes wherever they hold."""
    if not any(each.multiplier is not None for each in of.conditions):
        return []
    from derive.witness.constraints import without_gradient

    return [of.conditions[i] for i in without_gradient(of)]


def _field(charge: Charge) -> tuple[Expr, ...]:
    zero = Integer(0)
    return charge.magnetic or ((zero,) if len(charge.at.components) == 2 else (zero, zero, zero))
