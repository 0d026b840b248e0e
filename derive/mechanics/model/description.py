"""A description of the parts of a system for the witness, which is an independent numerical check."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Expr, Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import explicit, scalar
from derive.mechanics.model.part import Part
from derive.steps.record import assumed
from derive.steps.step import Quantity, Witness
from derive.witness import description as plain

SOLVED = "answers.solved_for"
CONSERVED = "hamilton.conserved"  # the rule of conserved momenta


@dataclass(frozen=True)
class Described(Witness):
    """The description of the system to which a quantity belongs; the witness checks the quantity against this
    description."""

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
    """The description of the impact from which a quantity follows; the witness checks the quantity against this
    description."""

    missing = "does not follow from an impact"
    impact: plain.Impact

    def testimony(self, quantity: Quantity, judged: Any, outcome: str) -> Verdict | None:
        if quantity.step.rule != SOLVED:
            return None
        from derive.witness import impact

        return impact.testimony(self.impact, quantity)


def description_behind(quantity: Quantity) -> Described | None:
    """The description of the system to which a quantity belongs; None if there is no description."""
    return next((known for each in quantity.ancestors() if (known := each.fact(Described)) is not None), None)


def letter_of_momentum(q: Symbol) -> Symbol:
    return scalar(f"p_{q.name}")


def described(
    parts: Sequence[Part],
    bodies: Sequence[Any],
    expressed: Sequence[tuple[Symbol, Expr]],
    coordinates: Mapping[Symbol, str],
    lagrangian: Expr | None = None,
) -> plain.Description:
    """Return the description that the witness uses: the parts or a given Lagrangian, the forces, and the conditions.

    bodies      those parts of the system that are bodies
    expressed   for each condition that expresses a coordinate by others: the coordinate and its formula
    """
    first = dict(reversed([(q, i) for i, (q, _) in enumerate(expressed)]))  # coordinate -> index of its first condition
    conditions = [
        plain.Condition(q - function, expresses=q if first[q] == i else None)
        for i, (q, function) in enumerate(expressed)
    ]
    found: dict[str, list[Any]] = {"conditions": conditions}
    for part in parts:
        for name, added in part.described(bodies).items():
            found.setdefault(name, []).extend(added)
    gravity = next(iter(found.pop("gravity", [])), None)
    return plain.Description(
        tuple(coordinates.items()),
        gravity=gravity,
        lagrangian=lagrangian,
        **{name: tuple(added) for name, added in found.items()},
    )


def places_that_move_alone(of: plain.Description, places: Sequence[plain.Vector]) -> list[int]:
    """The indices of the places that move with coordinates, but do not move with any part of the system."""
    moving = {q for q, _ in of.coordinates}
    asked = [i for i, place in enumerate(places) if any(explicit(c).free_symbols & moving for c in place)]
    if not asked or of.lagrangian is not None:
        return []
    from derive.witness.material import moving_alone

    return [asked[i] for i in moving_alone(of, [places[i] for i in asked])]


def conditions_that_nothing_keeps(of: plain.Description) -> list[plain.Condition]:
    """The constraints whose gradients vanish in all states that the witness tests."""
    if not any(each.multiplier is not None for each in of.conditions):
        return []
    from derive.witness.constraints import without_gradient

    return [of.conditions[i] for i in without_gradient(of)]
