"""Conservation of energy, and the equation of motion that follows from it for a system with one coordinate."""

from __future__ import annotations

from sympy import Add, Expr, Integer

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import Factors, Group, Relation, Terms, TimeRate, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time
from derive.mechanics.lagrange.energies import kinetic_energy_of, potential_energy_of
from derive.mechanics.lagrange.energy_forms import beside_potential
from derive.mechanics.model.system import System
from derive.mechanics.newton import claims
from derive.mechanics.newton.by_lagrange import facts_of_motion, lagrangian_behind, virtual_work
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.level import Level
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Quantity, compared_with, is_zero

__all__ = ["energy_equation", "total_energy"]

ZERO = Integer(0)


TOTAL_ENERGY = Rule(
    "newton.total_energy",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 5",
    outcomes={"free": claims.no_constraint_force, "constrained": claims.constraint_forces_do_no_work},
    evidence={"motion": ROUTE},
)


def total_energy(system: System, symbol: str | None = None, key: str = "energy_function") -> Quantity:
    """Energy of a system, E = T + U, which is constant.

    system   particles and bodies; the forces on them have a potential energy or do no work

    Second route: by Newton's second law for the mass points, the rate of change of E is the power of the forces without
    a potential energy. This power vanishes for all velocities that the constraints allow.
    Outcomes: free (no constraint force has a symbol), constrained (constraint forces with symbols act, but do no work).
    Errors: a force without a potential energy does work, or the positions or the potential energy depend on the time.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 5.
    """
    matter, moving = system.matter, list(system.coordinates)
    kinetic, potential = kinetic_energy_of(system), potential_energy_of(system)
    of = lagrangian_behind(system)
    lost = power_of_constraints(system)

    def along_the_motion(found: Expr) -> tuple[Expr, Expr]:
        works = [rate(q) * (matter.inertia_along(q) - matter.force_along(q)) for q in moving]
        return by_functions_of_time(found, moving), Add(*works, lost)

    if not is_zero(Add(*(a - b for a, b in [along_the_motion(kinetic.value + potential.value)]))):
        message = (
            "the energy is not conserved: a force without a potential energy does work, "
            "or the system depends on the time explicitly"
        )
        raise Rejected(Complaint("method", message, help="use `method: newton` or `method: lagrange`"))
    return establish(
        TOTAL_ENERGY,
        scalar(symbol or free_letter("E")),
        lambda t, u: Terms(t, u),
        {"kinetic": kinetic, "potential": potential},
        lines=Lines(put_in=None, arranged=lambda value: beside_potential(value, of, [], moving)),
        routes={"motion": along_the_motion},
        outcome="constrained" if system.constraints else "free",
        key=key,
        kind="energy",
        facts=[matter, system.described],
        phrase_data=PhraseData(
            outcome_data={
                "velocities": tuple(each.velocity(moving) for each in system.constraints),
                "rates": tuple(rate(q) for q in moving),
                "letters": tuple(each.force for each in system.constraints),
            }
        ),
    )


def power_of_constraints(system: System) -> Expr:
    """The power of the constraint forces, which vanishes for velocities that the constraints allow."""
    moving = list(system.coordinates)
    return Add(*(each.multiplier * each.velocity(moving) for each in system.constraints))


ENERGY_EQUATION = Rule(
    "newton.energy_equation",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 5 and 11",
    evidence={"lagrange": ROUTE, "rate": CHECK},
    statements=[claims.rate_of_the_energy],
)


def energy_equation(energy: Quantity, system: System, q: Coordinate, key: str | None = None) -> Quantity:
    """Equation of motion of a system with one coordinate, from the constant energy: dE/dt = q_dot (...) = 0.

    energy   the energy from `total_energy`
    system   the system to which this energy belongs
    q        the only coordinate of the system

    Second route: Lagrange's equation. Check: q_dot times the left side is the rate of change of E.
    Errors: the system has several coordinates, or a constraint force has a symbol.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 5 and 11.
    """
    moving = list(system.coordinates)
    if moving != [q.symbol] or system.constraints:
        count, forces = len(moving), len(system.constraints)
        many = f"{count} coordinate{'s' * (count != 1)}"
        many += f" and {forces} constraint force{'s' * (forces != 1)}" if forces else ""
        message = f"conservation of energy is one equation, but this system has {many}"
        help_line = "describe the positions by one coordinate, without constraint forces; or use a different method"
        raise Rejected(Complaint("method", message, help=help_line))
    changing = explicit(TimeRate(explicit(energy.value), *moving))
    left = by_accelerations(tidied((changing / q.rate).expand()), moving)
    of, changes = lagrangian_behind(system), {q.symbol: Integer(1)}
    return establish(
        ENERGY_EQUATION,
        None,
        lambda _: Relation(left, "=", ZERO),
        {"energy": energy},
        lines=Lines(put_in=None, arranged=explicit, law=Level.BRIEF, result=False),
        routes={
            "lagrange": compared_with(lambda: virtual_work(of, changes)),
            "rate": lambda found: (explicit(found).residual * q.rate, by_functions_of_time(energy.value, moving)),
        },
        phrase_data=PhraseData(
            formulas={"rate": (Factors(Group(left), q.rate), by_functions_of_time(energy.value, moving))},
            outcome_data={"coordinate": q.symbol},
        ),
        key=key or f"motion_{q.symbol.name}",
        facts=facts_of_motion(system, q, changes),
    )
