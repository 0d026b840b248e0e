"""The energy function of a Lagrangian, whether it is the energy, and whether it is conserved: two different questions.

h = sum of q_dot dL/dq_dot - L is constant if L does not contain the time itself. It is T + U if the places of the mass
points depend on the coordinates alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Symbol, factor

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import TIME, Factors, Partial, Relation, Terms, TimeRate, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.mechanics.systems.coordinates import by_functions_of_time
from derive.mechanics.systems.dalembert import Matter
from derive.mechanics.systems.lagrangian import Energies, FromLagrangian, coordinates_of
from derive.mechanics.systems.phase_space import beside_potential, kinetic_first, part_of_degree
from derive.steps.establish import Lines, Telling, establish
from derive.steps.record import free_letter
from derive.steps.step import Form, Quantity, is_zero

__all__ = ["energy_function", "energy_function_rate"]


def outcome_of_energy(value: Expr, of: Quantity) -> str:
    """Whether an energy function in coordinates and rates is T + U, and whether it is conserved."""
    conserved = TIME not in explicit(of.value).free_symbols
    if is_zero(value - of.needed(Energies).whole):
        return "energy" if conserved else "changing_energy"
    return "conserved" if conserved else "changing"


def told_of_excess(value: Expr, of: Quantity, rates: Sequence[Symbol]) -> dict[str, tuple[Any, Any]]:
    """What T + U has more than the energy function, and the same by the parts of T."""
    excess = by_rates(tidied(of.needed(Energies).whole - value), [q.symbol for q in coordinates_of(of)])
    if is_zero(excess):
        return {}
    kinetic = of.needed(Energies).kinetic.value
    by_parts = part_of_degree(kinetic, rates, 1) + 2 * part_of_degree(kinetic, rates, 0)
    forms = [excess, by_parts, *(factor(each) for each in (excess, by_parts) if not each.has(*rates))]
    return {"excess": (min(forms, key=lambda form: int(form.count_ops())), by_parts if excess != by_parts else excess)}


def energy_function(of: Quantity, symbol: str | None = None, key: str = "energy_function") -> Quantity:
    """Energy function of a Lagrangian, h = sum of q_dot dL/dq_dot - L.

    of   the Lagrangian, J
    Second route: T_2 - T_0 + U, with the parts of T that are of degree 2 and 0 in the rates.
    Outcomes: energy (conserved, and T + U), conserved (but not T + U), changing_energy (T + U, but L contains the
    time), changing (neither).
    Errors: L is not the difference of two energies.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7.
    """
    moving = coordinates_of(of)
    rates = [q.rate for q in moving]
    energies = of.needed(Energies)

    def law(L: Expr) -> Expr:
        return Terms(*(Factors(Partial(L, v), v) for v in rates), -L)

    def by_degree(found: Expr) -> tuple[Expr, Expr]:
        kinetic = energies.kinetic.value
        parts = part_of_degree(kinetic, rates, 2) - part_of_degree(kinetic, rates, 0)
        return found, parts + energies.potential.value

    carried = Add(*(explicit(Partial(of.value, v)) * v for v in rates))
    plain = beside_potential(explicit(carried - of.value), of, [], [q.symbol for q in moving])
    return establish(
        "energy.energy_function",
        scalar(symbol or free_letter("h")),
        law,
        {"lagrangian": of},
        lines=Lines(put_in=None, result=False, arranged=lambda _: plain, after=kinetic_first(plain, rates)),
        routes={"by_degree": by_degree},
        outcome=lambda value: outcome_of_energy(value, of),
        telling=Telling(formulas=told_of_excess(plain, of, rates)),
        key=key,
        kind="energy",
        facts=[FromLagrangian(of)],
    )


def energy_function_rate(of: Quantity, key: str | None = None) -> Quantity:
    """Rate of the energy function along every motion, dh/dt = -dL/dt, the time being what occurs in L by itself.

    of   the energy function, J
    Second route: h as a function of time, less the sum of q_dot (m a - F) . dr/dq, which vanishes by d'Alembert's
    principle.
    Outcomes: conserved (L does not contain the time), changes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7.
    """
    L = of.needed(FromLagrangian).lagrangian
    matter = L.needed(Matter)
    moving = [q.symbol for q in coordinates_of(L)]
    rate_of_it = explicit(-Partial(L.value, TIME))

    def along_the_motion(found: Relation) -> tuple[Any, Any]:
        work = [rate(q) * (matter.inertia_along(q) - matter.force_along(q)) for q in moving]
        by_time = by_functions_of_time(of.value, moving)
        return ImmutableDenseMatrix([found.left, found.right]), ImmutableDenseMatrix([by_time, by_time - Add(*work)])

    return establish(
        "energy.energy_function_rate",
        None,
        lambda h, L: Relation(TimeRate(h, *moving), "=", -Partial(L, TIME)),
        {"energy": of, "lagrangian": L},
        lines=Lines(
            put_in=None,
            result=False,
            arranged=lambda found: found,
            after=[Form(Relation(TimeRate(of.symbol, *moving), "=", by_terms(rate_of_it)), "result")],
        ),
        routes={"along_the_motion": along_the_motion},
        outcome="conserved" if rate_of_it == 0 else "changes",
        key=key or f"{of.key}_rate",
        parents=[of, L],
        facts=[FromLagrangian(L)],
    )
