"""Check the objects on which the forces and constraints of a system act.

The place of a force must be fixed, or move with a part of the system. The gradient of a constraint must not vanish,
because the constraint force acts along this gradient. Friction between two bodies must act on both of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from sympy import Add, Expr, Symbol

from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.description import Described, conditions_that_nothing_keeps, places_that_move_alone
from derive.mechanics.model.forces import GivenForce
from derive.steps.step import is_zero

WHERE_IT_ACTS: Mapping[str, str] = {
    "force": "name the body on which the force acts, `of: ball`, or write `of: massless` for a part without mass",
    "drag": "name the body on which the drag acts, `of: ball`, or write `of: massless` for a part without mass",
    "spring": (
        "attach the spring to a particle or a point of a body, or write `massless: true` for a joint without mass"
    ),
    "central force": (
        "attach the force to a particle or a point of a body, or write `massless: true` for a joint without mass"
    ),
}


class WrongPart(Rejected):
    """The error for one part of a system, such as a force that acts on no particle."""

    part: Any = None

    @classmethod
    def of(cls, part: Any, complaint: Complaint) -> WrongPart:
        found = cls(complaint)
        found.part = part
        return found


class WithParts(Protocol):
    """The interface of a system that these checks use.

    `acting` lists the forces for which the script does not state the body on which they act. An item consists of a part
    of the system, the name of its force, such as "drag", and the place where this force acts.
    """

    @property
    def described(self) -> Described: ...
    @property
    def acting(self) -> Sequence[tuple[Any, str, tuple[Expr, ...]]]: ...
    @property
    def masses(self) -> Sequence[tuple[Expr, Location]]: ...
    @property
    def given_forces(self) -> tuple[GivenForce, ...]: ...
    @property
    def constraints(self) -> tuple[Constraint, ...]: ...


def check_what_is_acted_on(system: WithParts) -> None:
    """Reject forces that act on nothing, constraints without a gradient, and friction whose second body is unknown."""
    _check_particles(system)
    _check_gradients(system)
    _check_partners(system)


def _check_particles(system: WithParts) -> None:
    """Require the place of a force to move with a body, a particle or a massless rod, or to be fixed to the ground.

    This is required only if the script does not state the body on which the force acts.
    """
    acting = system.acting
    for i in places_that_move_alone(system.described.description, [place for _, _, place in acting]):
        part, what, place = acting[i]
        where = ", ".join(map(str, place))
        message = (
            f"the {what} at ({where}) acts on no particle: no body or particle of the system moves with this place"
        )
        raise WrongPart.of(part, Complaint("which-body", message, help=WHERE_IT_ACTS[what]))


def _check_gradients(system: WithParts) -> None:
    """Reject a constraint whose gradient is zero wherever the constraint holds, because the constraint force is along
    the gradient."""
    for lost in conditions_that_nothing_keeps(system.described.description):
        part = next((each for each in system.constraints if each.force == lost.multiplier), None)
        message = f"the gradient of {lost.residual} vanishes wherever the constraint holds, so no force can enforce it"
        help_line = "use the constraint without a square: `x - y` in place of `(x - y)**2`"
        raise WrongPart.of(part, Complaint("constrained", message, help=help_line))


def _check_partners(system: WithParts) -> None:
    """Require that the second body is stated for a force that contains the symbol of a constraint force, such as mu N.

    The second body exerts this force, and the opposite force acts on it. A system with fewer than two masses has no
    second body. If all these forces add up to zero, the system already contains the opposite forces.
    """
    letters: set[Symbol] = {each.force for each in system.constraints}
    touching = [f for f in system.given_forces if any(c.free_symbols & letters for c in f.components)]
    open_ = [f for f in touching if f.by is None]
    if len(system.masses) < 2 or not open_:
        return
    size = len(open_[0].components)
    resultant = [Add(*(f.components[i] for f in touching if len(f.components) == size)) for i in range(size)]
    if all(is_zero(c) for c in resultant):
        return
    (letter, *_) = sorted({s.name for c in open_[0].components for s in c.free_symbols & letters})
    message = f"a force that contains {letter} acts between two bodies, but the body that exerts it is not stated"
    help_line = "name the body on which the opposite force acts, `by: plank`, or write `by: ground`"
    raise WrongPart.of(open_[0], Complaint("which-body", message, help=help_line))
