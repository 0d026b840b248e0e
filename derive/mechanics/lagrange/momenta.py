"""Conjugate momenta, p_q = dL/dq_dot: their symbols, their kinds, and how they are written."""

from __future__ import annotations

from sympy import (
    Add,
    Expr,
    Symbol,
)

from derive.algebra.collect import by_rates, with_constants_in_front
from derive.algebra.expressions import Partial, explicit, scalar
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.length import shortest
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, coordinate, required
from derive.mechanics.lagrange.facts import FromLagrangian, energies_of
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.model.dalembert import Matter
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Quantity, compared_with

__all__ = ["conjugate", "conjugate_momentum", "momenta"]


def letter_of_momentum(q: Coordinate) -> Symbol:
    return scalar(f"p_{q.symbol.name}")


def kind_of_momentum(kind: str, lagrangian: str | None = "energy") -> str | None:
    """Return the kind of the momentum of a coordinate: momentum for a length, angular momentum for an angle.

    Return None if no kind has the dimension of the momentum, for example for a Lagrangian that is not an energy.
    """
    if lagrangian is None:
        return None
    return kind_of_dimension(
        dimension_of_kind(lagrangian) * dimension_of_kind("time") / dimension_of_kind(kind),
    )


def conjugate(of: Coordinate) -> Coordinate:
    """Return the symbol p_q of the momentum of a coordinate, for functions in phase space: `x*p_y - y*p_x`.

    of   the coordinate, such as an angle or a length

    Errors: the momentum of this coordinate has none of the known kinds.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    kind = kind_of_momentum(of.kind)
    if kind is None:
        message = f"no known kind of quantity is the momentum of a coordinate of the kind `{of.kind}`"
        raise Rejected(Complaint("no-such-kind", message))
    return coordinate(letter_of_momentum(of).name, kind)


CONJUGATE_MOMENTUM = Rule(
    "lagrange.conjugate_momentum",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.6 and 8.1",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"along_the_motion": ROUTE, "given_along_the_motion": CHECK},
)


def conjugate_momentum(of: Quantity, q: Coordinate, symbol: str | None = None, key: str | None = None) -> Quantity:
    """Conjugate momentum of a coordinate, p_q = dL/dq_dot.

    of   the Lagrangian, J
    q    a coordinate of this Lagrangian

    Second route: the sum of m v . dr/dq over the mass points, and of e A . dr/dq over charges e in magnetic fields.
    Check: for a given L, the first-order change of L if q_dot changes.
    Outcomes: generic, zero.
    Errors: q is not a coordinate of L.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.6 and 8.1.
    """
    required(of.coordinates, q, "conjugate_momentum", of)
    matter = of.needed(Matter)
    letter = scalar(symbol) if symbol else letter_of_momentum(q)
    return establish(
        CONJUGATE_MOMENTUM,
        letter,
        lambda L: Partial(L, q.rate),
        {"lagrangian": of},
        lines=Lines(put_in=None, arranged=lambda value: written_momentum(value, of)),
        routes=matter.named({"along_the_motion": compared_with(lambda: matter.momentum_along(q.symbol))}),
        outcome=lambda value: "zero" if value == 0 else "generic",
        key=key or letter.name,
        kind=kind_of_momentum(q.kind, of.step.kind),
        facts=[FromLagrangian(of), OfCoordinate(q)],
    )


def written_momentum(value: Expr, of: Quantity) -> Expr:
    """Collect a momentum by rates; for a given Lagrangian, simplify each term instead if the result is shorter."""
    forms = [with_constants_in_front(by_rates(value, list(of.coordinates)), list(of.coordinates))]
    if energies_of(of) is None:
        forms.append(Add(*(tidied(term) for term in Add.make_args(explicit(value)))))
    return shortest(forms)


def momenta(of: Quantity) -> tuple[Quantity, ...]:
    """Momenta of all coordinates, p_q = dL/dq_dot.

    of   the Lagrangian, J

    Keys: p_x for the coordinate x.
    Second route: as `conjugate_momentum`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    return tuple(conjugate_momentum(of, q) for q in coordinates_of(of))
