"""Steps that give positions: the components of a place, and the integrals of conditions on rates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Expr, ImmutableDenseMatrix

from derive.algebra.expressions import explicit, rate, scalar
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model import claims
from derive.mechanics.model.system import KnownCoordinate
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import coordinates_in
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Level, Quantity

__all__ = ["components", "integrated"]

NAMES = {2: ("x", "y"), 3: ("x", "y", "z")}


INTEGRATED = Rule(
    "model.integrated",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3",
    evidence={"differentiated": CHECK, "start": CHECK},
)


def integrated(condition: Quantity, key: str | None = None) -> Quantity:
    """Integral of a linear relation between rates with constant coefficients: s = R theta from s_dot = R theta_dot.

    condition   a step of `no_slip` that expresses one rate by other rates, linearly and with constant coefficients. If
                the condition already expresses the coordinate itself, the result is the condition

    The constant of integration is zero: all coordinates are assumed to be zero in one position of the system.
    Check: the time derivative of the result is the value of the rate in the condition. If all coordinates are zero, the
    result is zero.
    Errors: the condition cannot be integrated.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3.
    """
    known = condition.needed(KnownCoordinate)
    q, function = known.coordinate, known.function
    if condition.symbol == q:
        return condition
    moving = coordinates_in(ImmutableDenseMatrix([q, function]))
    at_zero = dict.fromkeys(moving, 0)

    def differentiated(found: Expr) -> tuple[Expr, Expr]:
        return by_functions_of_time(found, list(moving)), condition.value.residual.subs(rate(q), 0) * -1

    return establish(
        INTEGRATED,
        q,
        lambda *_: function,
        {},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"differentiated": differentiated, "start": lambda found: (found.subs(at_zero), 0 * q)},
        key=key or q.name,
        kind=moving.get(q),
        phrase_data=PhraseData(points_to={"condition": condition}),
        parents=[condition],
        facts=[known],
    )


def components(of: PlacedBody | Location, *conditions: Quantity, names: Sequence[str] = ()) -> tuple[Quantity, ...]:
    """Components of a place, or of the centre of mass of a body, with conditions of rolling substituted.

    of           a body that is placed or held, or a place, m
    conditions   steps of `no_slip`: each expresses a coordinate by other coordinates
    names        the names of the components, which are also the keys of their steps; by default x and y, or x, y and z.
                 The last axis points upwards

    If you make a `point` from these components, speeds and energies contain the symbols of the components.
    Check: the time derivative of the result equals the velocity of the place, in which the rates are replaced by their
    values from the conditions.
    Another check: where all coordinates are zero, the result is equal to the component before the substitution.
    Outcomes: centre (of a body), place.
    Errors: a condition cannot be integrated; the numbers of names and components differ.
    Source: Taylor, *Classical Mechanics*, section 7.3.
    """
    place = of.centre if isinstance(of, PlacedBody) else of
    called = tuple(names) or NAMES[len(place.components)]
    if len(called) != len(place.components):
        message = f"`components` needs {len(place.components)} names, not {len(called)}"
        raise Rejected(Complaint("wrong-argument", message))
    known = {f"known_{i}": integrated(condition) for i, condition in enumerate(conditions)}
    body = of if isinstance(of, PlacedBody) else None
    return tuple(_component(body, c, i, known, called[i]) for i, c in enumerate(place.components))


COMPONENT = Rule(
    "model.component",
    source="Taylor, *Classical Mechanics*, section 7.3",
    outcomes={"centre": claims.of_a_centre, "place": claims.component_place},
    evidence={"velocity": CHECK, "start": CHECK},
)


def _component(
    body: PlacedBody | None, component: Expr, i: int, conditions: Mapping[str, Quantity], name: str
) -> Quantity:
    """Component of a place or of a centre of mass.

    Outcomes: centre, place.
    Source: the same as for `components`.
    """
    used = {role: q for role, q in conditions.items() if component.has(q.symbol)}
    letters = [q.symbol for q in used.values()]
    values = {q.symbol: q.value for q in used.values()}
    moving = list(coordinates_in(component))

    def same_velocity(found: Expr) -> tuple[Expr, Expr]:
        velocity = by_functions_of_time(component, moving)
        rates = {rate(s): by_functions_of_time(value, moving) for s, value in values.items()}
        return by_functions_of_time(found, moving), velocity.subs(rates).subs(values)

    def at_zero(found: Expr) -> tuple[Expr, Expr]:
        zero = dict.fromkeys(moving, 0)
        return found.subs(zero), component.subs(zero)

    centre = {"centre": body.moved(values).centre.components[i]} if body is not None else {}
    return establish(
        COMPONENT,
        scalar(name),
        lambda *known: component.xreplace(dict(zip(letters, known, strict=True))),
        used,
        lines=Lines(put_in=Level.STANDARD, arranged=explicit),
        routes={"velocity": same_velocity, "start": at_zero},
        outcome="place" if body is None else "centre",
        phrase_data=PhraseData(outcome_data=centre),
        key=name,
        kind="length",
        scope=Scope(coordinates=coordinates_in(component.subs(values))),
    )
