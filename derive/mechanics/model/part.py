"""The interface of a part of a system: places, masses, forces, and the places at which the forces act.

A system obtains most of its quantities from its parts through this interface.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Self

from sympy import Expr, Symbol

from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.dalembert import Load, MagneticForce, MassPoint, Reaction

Vector = tuple[Expr, ...]


class Part:
    """A part of a system, without places, masses or forces; subclasses override the properties for these."""

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        """Return the same part with expressions substituted for some coordinates."""
        return self

    @property
    def places(self) -> Sequence[Location]:
        """The places that belong to the part, in m."""
        return ()

    @property
    def depends_on(self) -> Vector:
        """Expressions whose coordinates become coordinates of the system."""
        return tuple(c for place in self.places for c in place.components)

    @property
    def masses(self) -> Sequence[tuple[Expr, Location]]:
        """The masses of the part, in kg, each with the place of its centre of mass."""
        return ()

    @property
    def mass_points(self) -> Sequence[MassPoint]:
        """Mass points that are equivalent to the part."""
        return [MassPoint(mass, at.components) for mass, at in self.masses]

    @property
    def acts_by(self) -> Vector:
        """Expressions on which the action of the part depends, such as the place of a force, a potential energy or a
        constraint."""
        return ()

    @property
    def loose_ends(self) -> Sequence[tuple[str, Vector]]:
        """The forces for which the script does not state the object on which they act. Each item consists of the name
        of a force, such as "spring", and its place."""
        return ()

    def weighed(self, gravity: Expr) -> Sequence[Any]:
        """Return parts that correct the weight if the mass of this part is counted at another place; otherwise nothing.

        For example, the mass of a rope is counted at a particle.
        """
        return ()

    def stored_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        """The forces with a potential energy."""
        return ()

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load | Reaction]:
        """The forces without a potential energy, such as drag and constraint forces, but not magnetic forces."""
        return ()

    @property
    def fields(self) -> Sequence[MagneticForce]:
        """The forces in magnetic fields."""
        return ()

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        """Return a mapping from fields of a `derive.witness.description.Description` to entries for this part.

        bodies   the bodies of the system; forces refer to a body by its index in this list
        """
        return {}


def moved(thing: Any, known: Mapping[Symbol, Expr]) -> Any:
    """Return an object, such as a body, with expressions substituted for some coordinates; an object without a method
    `moved` is unchanged."""
    return thing.moved(known) if hasattr(thing, "moved") else thing


def number_of(thing: Any, bodies: Sequence[Any]) -> int | None:
    """The index of an object in the list of bodies; None if the list does not contain the object."""
    return next((i for i, body in enumerate(bodies) if body is thing or body == thing), None)
