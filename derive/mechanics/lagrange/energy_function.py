"""The energy function of a Lagrangian, h = sum of q_dot dL/dq_dot - L, and its rate of change.

h is constant if L does not depend on time explicitly, and if no force outside L does work. h is T + U if the positions
of the mass points depend only on the coordinates. Neither condition follows from the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, factor

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import (
    TIME,
    Factors,
    Partial,
    Relation,
    Terms,
    TimeRate,
    depends_on_time,
    explicit,
    rate,
    scalar,
)
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.applied_forces import ActedOn, applied_force
from derive.mechanics.lagrange.energy_forms import beside_potential, kinetic_first, part_of_degree
from derive.mechanics.lagrange.facts import Energies, FromLagrangian, Varied, energies_of
from derive.mechanics.lagrange.given_lagrangian import energy_of, rate_of_energy
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.model.dalembert import Matter
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Quantity, is_zero

__all__ = ["energy_function", "energy_function_rate"]


def outcome_of_energy(value: Expr, of: Quantity) -> str:
    """Return the outcome for an energy function in coordinates and rates: whether it is T + U, and whether it is
    conserved."""
    if energies_of(of) is None:
        return _of_given(of)
    whole = is_zero(value - of.needed(Energies).whole)
    if not is_zero(_power_beside(of)):
        return "work_energy" if whole else "work"
    if not depends_on_time(of.value):
        return "energy" if whole else "conserved"
    return "changing_energy" if whole else "changing"


def _of_given(of: Quantity) -> str:
    """Return the outcome for a given Lagrangian: whether h is conserved. T and U are unknown."""
    if not is_zero(_power_beside(of)):
        return "given_work"
    return "given_changing" if depends_on_time(of.value) else "given_conserved"


def _power_beside(of: Quantity) -> Expr:
    """Return the power of the forces without a potential energy, plus the power of the forces of moving constraints."""
    matter = of.needed(Matter)
    loads = [load for load in matter.others if load.multiplier is None]
    works = [rate(q) * load.work_along(q) for q in matter.coordinates for load in loads]
    return explicit(Add(*works, *_powers_of_conditions(of)))


def _constrained(of: Quantity) -> dict[str, str]:
    """Return the word "constrained" if constraint forces act and no constraint contains the time; otherwise no word."""
    kept = of.fact(Constrained)
    fixed = kept is not None and not any(depends_on_time(each.residual) for each in kept.constraints)
    return {"constrained": "constrained"} if fixed else {}


def _powers_of_conditions(of: Quantity) -> list[Expr]:
    """Return -lambda df/dt for each moving constraint, where df/dt is the rate of f at constant coordinates.

    The force of a fixed constraint does no work.
    """
    kept, moving = of.fact(Constrained), list(of.coordinates)
    still = {rate(q): Integer(0) for q in moving}
    moved = [(c.multiplier, c.velocity(moving).xreplace(still)) for c in (kept.constraints if kept else ())]
    return [-force * v for force, v in moved if v != 0]


def told_of_excess(value: Expr, of: Quantity, rates: Sequence[Symbol]) -> dict[str, tuple[Any, Any]]:
    """Return T + U - h in two forms; nothing if T + U = h, or if T and U are unknown.

    One form is the difference of energies; the other is T_1 + 2 T_0, where T_1 and T_0 are the parts of T of degree 1
    and 0 in the rates.
    """
    if energies_of(of) is None:
        return {}
    excess = by_rates(tidied(of.needed(Energies).whole - value), [q.symbol for q in coordinates_of(of)])
    if is_zero(excess):
        return {}
    kinetic = of.needed(Energies).kinetic.value
    by_parts = part_of_degree(kinetic, rates, 1) + 2 * part_of_degree(kinetic, rates, 0)
    pairs = [(excess, by_parts), (by_parts, excess)]
    pairs += [(factor(form), other) for form, other in pairs if not form.has(*rates)]
    return {"excess": min(pairs, key=lambda pair: length(pair[0]))}


ENERGY_FUNCTION = Rule(
    "lagrange.energy_function",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7",
    outcomes=claims.ENERGIES,
    evidence={"by_degree": ROUTE, "energy_identity": ROUTE, "stretched": CHECK},
)


def energy_function(of: Quantity, symbol: str | None = None, key: str = "energy_function") -> Quantity:
    """Energy function of a Lagrangian, h = sum of q_dot dL/dq_dot - L.

    of   the Lagrangian, J

    Second route: T_2 - T_0 + U, where T_2 and T_0 are the parts of T of degree 2 and 0 in the rates. For a given L, the
    second route is the rate of h by the energy identity. A check is then the derivative of L with respect to a common
    factor of all rates, minus L.
    Outcomes: energy (h is conserved and is T + U); conserved (h is conserved but is not T + U); changing_energy
    (h is T + U, but L contains the time); changing (h is not T + U, and L contains the time); work_energy (h is T + U,
    but a force outside L does work); work (h is not T + U, and a force outside L does work); given_conserved,
    given_changing, given_work (the same for a given L, whose T and U are unknown).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7.
    """
    moving = coordinates_of(of)
    rates = [q.rate for q in moving]
    energies, matter = energies_of(of), of.needed(Matter)

    def law(L: Expr) -> Expr:
        return Terms(*(Factors(Partial(L, v), v) for v in rates), -L)

    def by_degree(found: Expr) -> tuple[Expr, Expr]:
        assert energies is not None
        kinetic = energies.kinetic.value
        parts = part_of_degree(kinetic, rates, 2) - part_of_degree(kinetic, rates, 0)
        return found, parts + energies.potential.value

    def identity(found: Expr) -> tuple[Expr, Expr]:
        assert isinstance(matter, Varied)
        return by_functions_of_time(found, matter.coordinates), rate_of_energy(matter)

    def stretched(found: Expr) -> tuple[Expr, Expr]:
        assert isinstance(matter, Varied)
        return found, energy_of(matter)

    carried = Add(*(explicit(Partial(of.value, v)) * v for v in rates))
    plain = beside_potential(explicit(carried - of.value), of, [], [q.symbol for q in moving])
    return establish(
        ENERGY_FUNCTION,
        scalar(symbol or free_letter("h")),
        law,
        {"lagrangian": of},
        lines=Lines(put_in=None, result=False, arranged=lambda _: plain, after=kinetic_first(plain, rates)),
        routes={"by_degree": by_degree}
        if energies is not None
        else {"energy_identity": identity, "stretched": stretched},
        outcome=lambda value: outcome_of_energy(value, of),
        phrase_data=PhraseData(words=_constrained(of), formulas=told_of_excess(plain, of, rates)),
        key=key,
        kind=of.step.kind,
        facts=[FromLagrangian(of)],
    )


ENERGY_FUNCTION_RATE = Rule(
    "lagrange.energy_function_rate",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.4, 2.5 and 2.7",
    outcomes={
        "conserved": claims.rate_by(in_time=None, worked=False),
        "changes": claims.rate_by(in_time=True, worked=False),
        "work": claims.rate_by(in_time=False, worked=True),
        "lost": claims.rate_by(in_time=False, worked=True, lost=True),
        "work_and_time": claims.rate_by(in_time=True, worked=True),
    },
    evidence={"along_the_motion": ROUTE, "given_along_the_motion": ROUTE},
)


def energy_function_rate(of: Quantity, key: str | None = None) -> Quantity:
    """Rate of the energy function along every motion, dh/dt = sum of Q q_dot - dL/dt - sum of lambda df/dt. Here dL/dt
    and df/dt are partial derivatives with respect to time, and the constraints are f = 0.

    of   the energy function h, J

    Separate steps derive the generalized forces Q. For a constraint linear in the rates, the terms without rates
    replace df/dt.
    Second route: the time derivative of h as a function of t, minus the sum of q_dot (m a - F) . dr/dq, which vanishes
    by d'Alembert's principle.
    Outcomes: conserved (no force outside L does work, and L does not contain the time), changes (only because L
    contains the time), work (a force outside L does work), lost (a force outside L does work, and its power is never
    positive), work_and_time (a force outside L does work, and L contains the time).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.4, 2.5 and 2.7.
    """
    L = of.needed(FromLagrangian).lagrangian
    matter, kept = L.needed(Matter), L.fact(Constrained)
    every = coordinates_of(L)
    moving = [q.symbol for q in every]
    forces = [(q, applied_force(L, q)) for q in every] if L.fact(ActedOn) is not None else []
    applied = [(q, force) for q, force in forces if not is_zero(force.value)]
    held = _powers_of_conditions(L)
    in_time = explicit(-Partial(L.value, TIME))
    powers = [explicit(force.value) * q.rate for q, force in applied]
    rate_of_it = Add(by_terms(in_time), by_rates(Add(*powers), moving), *held)

    def law(h: Expr, L: Expr, *forces: Expr) -> Relation:
        works = [Factors(force, q.rate) for force, (q, _) in zip(forces, applied, strict=True)]
        terms = [*works, *held, *([-Partial(L, TIME)] if in_time != 0 or not (works or held) else [])]
        return Relation(TimeRate(h, *moving), "=", Terms(*terms) if len(terms) > 1 else terms[0])

    def along_the_motion(found: Relation) -> tuple[Any, Any]:
        work = [rate(q) * (matter.inertia_along(q) - matter.force_along(q)) for q in moving]
        work += [c.multiplier * c.velocity(moving) for c in (kept.constraints if kept else ())]  # zero along motions
        by_time = by_functions_of_time(of.value, moving)
        both = [found.left, found.right, int(found.operator == "=")]
        return ImmutableDenseMatrix(both), ImmutableDenseMatrix([by_time, by_time - Add(*work), 1])

    return establish(
        ENERGY_FUNCTION_RATE,
        None,
        law,
        {"energy": of, "lagrangian": L, **{force.key: force for _, force in applied}},
        lines=Lines(
            put_in=None,
            result=False,
            arranged=lambda found: found,
            after=[Form(Relation(TimeRate(of.symbol, *moving), "=", rate_of_it), "result")],
        ),
        routes=matter.named({"along_the_motion": along_the_motion}),
        outcome=_sort_of_rate(rate_of_it, in_time, moving),
        phrase_data=PhraseData(outcome_data={"moving": tuple(moving)}),
        key=key or f"{of.key}_rate",
        parents=[of, L],
        facts=[FromLagrangian(L)],
        scope=Scope(coordinates={c.force: c.kind_of_force or "" for c in (kept.constraints if kept and held else ())}),
    )


def _sort_of_rate(found: Expr, in_time: Expr, moving: Sequence[Symbol]) -> str:
    if is_zero(found):
        return "conserved"
    if is_zero(found - in_time):
        return "changes"
    if in_time != 0:
        return "work_and_time"
    return "lost" if all(_takes(term, moving) for term in Add.make_args(found.expand())) else "work"


def _takes(term: Expr, moving: Sequence[Symbol]) -> bool:
    """Whether a term contains rates and can only be zero or negative."""
    return bool(term.is_nonpositive) and term.has(*(rate(q) for q in moving))
