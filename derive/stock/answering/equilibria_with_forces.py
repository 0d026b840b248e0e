"""Equilibria with constraint forces: the equations of motion at rest, solved for positions and forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Integer, Symbol

from derive.algebra.expressions import explicit
from derive.errors import Complaint, Rejected
from derive.mechanics import Coordinate, put_in, solved_for
from derive.mechanics.lagrange.constraint_forces import positions_kept
from derive.mechanics.lagrange.fixed_coordinates import KeptPositions
from derive.steps.step import Quantity


def rest_with_forces(
    motions: Sequence[Quantity], coordinates: Mapping[str, Coordinate], forces: Sequence[Symbol]
) -> tuple[Quantity, ...]:
    """Return the positions and forces that solve the static equations, if there are as many unknowns as equations.

    motions       the equations of motion, one for each coordinate
    coordinates   the coordinates by name, in the order of `motions`
    forces        the symbols of the constraint forces

    If there are as many forces as equations, as with static friction, only the forces are unknown, and they may depend
    on the positions. Coordinates that the constraints together keep constant have their constant values.
    Errors: the static equations do not determine the unknowns.
    """
    kept = positions_kept(motions[0])
    concerned = [motion for motion in motions if not explicit(motion.value).free_symbols.isdisjoint(kept.values)]
    still = [
        _still(name, motion, coordinates, kept, motion in concerned[:1])
        for name, motion in zip(coordinates, motions, strict=True)
    ]
    present = {s for each in still for s in explicit(each.value).free_symbols}
    unknown = [s for s in forces if s in present]
    if len(unknown) > len(still):
        names = ", ".join(s.name for s in unknown)
        message = f"the number of static equations is {len(still)}, too few for the {len(unknown)} forces {names}"
        help_line = "describe fewer constraint forces: for example, a contact without friction, or fewer joints"
        raise Rejected(Complaint("constrained", message, help=help_line))
    if len(unknown) != len(still):
        unknown = [q.symbol for q in coordinates.values() if q.symbol in present] + unknown
    if len(unknown) != len(still):
        names = f": {', '.join(s.name for s in unknown)}" if unknown else ""
        message = f"the number of static equations is {len(still)}, but the number of unknowns is {len(unknown)}{names}"
        help_line = "describe the positions by fewer coordinates, so that no constraint force is needed"
        raise Rejected(Complaint("constrained", message, help=help_line))
    return solved_for(tuple(still), *unknown, keys=[f"rest_{s.name}" for s in unknown])


def _still(
    name: str, motion: Quantity, coordinates: Mapping[str, Coordinate], kept: KeptPositions, gives_reason: bool
) -> Quantity:
    held = {s.name for s in explicit(motion.value).free_symbols}
    moving = [s for q in coordinates.values() for s in (q.rate, q.acceleration) if s.name in held]
    values = {s.name: Integer(0) for s in moving} | {q.name: at for q, at in kept.values.items() if q.name in held}
    fixed_by = kept if gives_reason else None
    return put_in(motion, key=f"still_{name}", fixed_by=fixed_by, **values) if values else motion
