"""A part of a system says for itself what moves with it, what it weighs, which forces it exerts, and on what.

A system loops over its parts and knows no sort of part.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Self

from sympy import Expr, Symbol

from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.dalembert import Load, MagneticForce, MassPoint, Reaction

Vector = tuple[Expr, ...]


class Part:
    """A part with nothing of all this; each sort of part states what it has."""

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        """The same part with expressions substituted for some coordinates."""
        return self

    @property
    def places(self) -> Sequence[Location]:
        """The places that move with it, in m."""
        return ()

    @property
    def depends_on(self) -> Vector:
        """The expressions whose coordinates are those of the system."""
        return tuple(c for place in self.places for c in place.components)

    @property
    def masses(self) -> Sequence[tuple[Expr, Location]]:
        """Its masses, in kg, at their centres of mass."""
        return ()

    @property
    def mass_points(self) -> Sequence[MassPoint]:
        """The mass points that move as it does."""
        return [MassPoint(mass, at.components) for mass, at in self.masses]

    @property
    def acts_by(self) -> Vector:
        """The expressions of its forces or conditions, which must not contain any other coordinates."""
        return ()

    @property
    def loose_ends(self) -> Sequence[tuple[str, Vector]]:
        """The places at which it acts without stating on what, each with the name of the part."""
        return ()

    def stored_loads(self, moving: Sequence[Symbol]) -> Sequence[Load]:
        """Its forces with a potential energy."""
        return ()

    def other_loads(self, moving: Sequence[Symbol]) -> Sequence[Load | Reaction]:
        """Its forces without a potential energy, and constraint forces."""
        return ()

    @property
    def fields(self) -> Sequence[MagneticForce]:
        """Its forces in magnetic fields."""
        return ()

    def described(self, bodies: Sequence[Any]) -> Mapping[str, Sequence[Any]]:
        """What it adds to the fields of a `derive.witness.description.Description`.

        bodies   the bodies of the system, whose indices forces refer to
        """
        return {}


def moved(thing: Any, known: Mapping[Symbol, Expr]) -> Any:
    """A particle or a body with expressions substituted for some coordinates; anything else is unchanged."""
    return thing.moved(known) if hasattr(thing, "moved") else thing


def number_of(thing: Any, bodies: Sequence[Any]) -> int | None:
    """The index of a body; None for anything else."""
    return next((i for i, body in enumerate(bodies) if body is thing or body == thing), None)
