"""Lagrange's equation with constraint forces and with forces that have no potential energy, such as drag."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from sympy import Add, Expr, Integer, Mul, Pow, Rational, Symbol, diff

from derive.algebra.collect import by_accelerations, by_rates, by_terms, spread
from derive.algebra.expressions import TIME, Factors, Group, Partial, Relation, Terms, TimeRate, explicit, rate, scalar
from derive.algebra.length import length
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, by_functions_of_time, required
from derive.mechanics.lagrange import claims
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.model.dalembert import Load, Matter
from derive.mechanics.model.forces import Damper, GivenForce
from derive.mechanics.theorems import (
    MULTIPLIER_OF_ONE,
    MULTIPLIER_OF_ONE_RATE,
    MULTIPLIERS,
    MULTIPLIERS_OF_BOTH,
    MULTIPLIERS_OF_RATES,
)
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Level
from derive.steps.rule import ROUTE, Quote, Rule, Shown
from derive.steps.step import Fact, Form, Quantity, compared_with, is_zero
from derive.steps.subject import Subject

__all__ = ["applied_force", "dissipation_function", "forced_equation"]

ZERO = Integer(0)


@dataclass(frozen=True)
class ActedOn(Fact):
    """The forces without a potential energy on a system: the given forces, the dampers and the dissipation function of
    the dampers."""

    missing = "has no given forces, couples or dampers"
    system: Any
    forces: tuple[GivenForce, ...]
    dampers: tuple[Damper, ...]
    dissipation: Quantity | None


@dataclass(frozen=True)
class ForcedMotion(Fact):
    """The Lagrangian of an equation of motion with constraints, or with forces that have no potential energy."""

    missing = "is not an equation of motion with forces other than those of a potential energy"
    lagrangian: Quantity


@runtime_checkable
class WithForces(Protocol):
    """A system with coordinates, constraints, given forces and dampers."""

    @property
    def coordinates(self) -> Mapping[Symbol, str]: ...
    @property
    def constraints(self) -> tuple[Constraint, ...]: ...
    @property
    def given_forces(self) -> tuple[GivenForce, ...]: ...
    @property
    def dampers(self) -> tuple[Damper, ...]: ...


def acting_on(system: WithForces) -> tuple[Fact, ...]:
    """Return facts about the constraints, given forces and dampers of a system, for its equations of motion."""
    found: list[Fact] = [Constrained(system.constraints)] if system.constraints else []
    if system.given_forces or system.dampers:
        dissipated = dissipation_function(system) if system.dampers else None
        found.append(ActedOn(system, system.given_forces, system.dampers, dissipated))
    return tuple(found)


def acting(*energies: Quantity) -> list[Fact]:
    """Return the facts about forces and constraints that the Lagrangian takes over from its energies."""
    return [fact for energy in energies for fact in energy.facts if isinstance(fact, ActedOn | Constrained)]


DISSIPATION_FUNCTION = Rule(
    "lagrange.dissipation_function",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.5",
    evidence={"power": ROUTE},
)


def dissipation_function(system: WithForces, symbol: str = "D", key: str = "dissipation_function") -> Quantity:
    """Rayleigh's dissipation function, D = sum of (1/2) c v^2 over the dampers of a system, in W.

    system   the system with the dampers; c is the force per velocity or, for a damped coordinate, the generalized force
             per rate

    Second route: the power of the drag forces, sum of F . v, is -2 D.
    Errors: the system has no dampers.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.5.
    """
    moving = list(system.coordinates)
    if not system.dampers:
        raise Rejected(Complaint("wrong-argument", "`dissipation_function` needs a system with `damping`"))

    def law() -> Expr:
        terms = [Factors(Rational(1, 2), d.constant, squares_of_velocity(d, moving)) for d in system.dampers]
        return Terms(*terms) if len(terms) > 1 else terms[0]

    def by_power(found: Expr) -> tuple[Expr, Expr]:
        loads = [d.load(moving) for d in system.dampers]
        return 2 * found, -Add(*(power_of(load, moving) for load in loads))

    return establish(
        DISSIPATION_FUNCTION,
        scalar(symbol),
        law,
        {},
        lines=Lines(put_in=None, arranged=lambda value: by_rates(value, moving, halves=True)),
        routes={"power": by_power},
        key=key,
        kind="power",
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )


def squares_of_velocity(damper: Damper, moving: Sequence[Symbol]) -> Expr:
    """Return v^2 of the damped point. Simple components are evaluated: x_dot^2, not (d/dt (a + x))^2."""
    velocity = _velocity_of(damper.at, moving)
    if not damper.point.held and not all(v in {ZERO, *map(rate, moving)} for v in velocity):
        return squares_of_rates(damper.at, moving)
    if damper.point.held:  # a component of the velocity of a particle of a body may vanish identically
        velocity = [ZERO if is_zero(v) else v for v in damper.velocity(moving)]
    squares = [Pow(v, 2) for v in velocity if v != 0]
    return Terms(*squares) if len(squares) > 1 else squares[0] if squares else ZERO


def _velocity_of(place: Sequence[Expr], moving: Sequence[Symbol]) -> list[Expr]:
    """Return the components of a velocity, each with the sign that avoids a leading minus."""
    found = [explicit(TimeRate(c, *moving)) for c in place]
    return [-v if v.could_extract_minus_sign() else v for v in found]


def squares_of_rates(place: Sequence[Expr], moving: Sequence[Symbol]) -> Expr:
    """Return (dx/dt)^2 + (dy/dt)^2 + ... over the components that change."""
    fast = [TIME, *moving]
    changing = [c for c in place if c.has(*fast)] or [*place][:1]
    squares = [Pow(TimeRate(c, *moving), 2) for c in changing]
    return Terms(*squares) if len(squares) > 1 else squares[0]


def power_of(load: Load, moving: Sequence[Symbol]) -> Expr:
    """Return the power F . v, where v is the velocity of the point of application."""
    velocity = [by_functions_of_time(c, list(moving)).xreplace(dict(load.held)) for c in load.place]
    return Add(*(f * v for f, v in zip(load.force, velocity, strict=True)))


APPLIED_FORCE = Rule(
    "lagrange.applied_force",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 1.5",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"power": ROUTE},
)


def applied_force(of: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Generalized force of the forces without a potential energy, Q = sum of F . dr/dq - dD/dq_dot.
    D is the dissipation function.

    of   the Lagrangian, J, of a system with given forces, couples or damping
    q    one of the coordinates of the system

    Second route: Q is the derivative of the power of these forces, sum of F . v, with respect to q_dot at constant F.
    Outcomes: generic, zero.
    Errors: all forces on the system have a potential energy; q is not a coordinate of L.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 1.5.
    """
    required(of.coordinates, q, "applied_force", of)
    acted = of.needed(ActedOn)
    moving = list(acted.system.coordinates)
    loads = [f.load(moving) for f in acted.forces]
    works = [term for load in loads for term in _works(load, q, moving)]

    kept = of.fact(Constrained)
    here = {s for f in acted.forces for c in f.components for s in c.free_symbols}
    held = {c.force: c.kind_of_force or "" for c in (kept.constraints if kept else ()) if c.force in here}

    def law(*dissipated: Expr) -> Expr:
        lost = [-Partial(d, q.rate) for d in dissipated]
        terms = [*works, *lost]
        return Terms(*terms) if len(terms) > 1 else terms[0] if terms else ZERO

    def by_power() -> Expr:
        every = [*(f.load(moving) for f in acted.forces), *(d.load(moving) for d in acted.dampers)]
        return Add(*(_slope(load, q, moving) for load in every))

    name = f"Q_{q.symbol.name}"
    return establish(
        APPLIED_FORCE,
        scalar(name),
        law,
        {"dissipation": acted.dissipation} if acted.dissipation is not None else {},
        lines=Lines(put_in=None, arranged=lambda value: _by_rates_or_terms(value, moving)),
        routes={"power": compared_with(by_power)},
        outcome=lambda value: "zero" if value == 0 else "generic",
        phrase_data=PhraseData(outcome_data={"coordinate": q.symbol}),
        key=key or f"applied_force_{q.symbol.name}",
        scope=Scope(coordinates={**of.coordinates, **held}, about=Subject(body=acted.system)),
    )


def _works(load: Load, q: Coordinate, moving: Sequence[Symbol]) -> list[Expr]:
    """Return the terms F_i dr_i/dq, without the components r_i that are constant."""
    pairs = list(zip(load.force, load.place, load.slopes(q.symbol), strict=True))
    if (
        load.held
        or any(f != 0 and slope != 0 for f, _, slope in pairs)
        and all(slope in (0, 1) for f, _, slope in pairs if f != 0)
    ):
        slopes = [(f, tidied(slope)) for f, _, slope in pairs if f != 0]
        return [f if slope == 1 else Factors(f, slope) for f, slope in slopes if slope != 0]
    return [Factors(f, Partial(c, q.symbol)) for f, c, _ in pairs if f != 0 and c.has(*moving)]


def _slope(load: Load, q: Coordinate, moving: Sequence[Symbol]) -> Expr:
    """Return the derivative of the power F . v with respect to q_dot, with F held constant."""
    velocity = [by_functions_of_time(c, list(moving)).xreplace(dict(load.held)) for c in load.place]
    return Add(*(f * diff(v, q.rate) for f, v in zip(load.force, velocity, strict=True)))


def _by_rates_or_terms(value: Expr, moving: Sequence[Symbol]) -> Expr:
    return by_rates(value, moving) if any(value.has(rate(q)) for q in moving) else by_terms(tidied(value))


FORCED_EQUATION = Rule(
    "lagrange.forced_equation",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.5 and 2.4",
    outcomes={
        "applied": claims.forced_equation_applied,
        "kept": claims.forced_equation_kept,
        "both": claims.forced_equation_both,
        "free": claims.forced_equation_free,
    },
    evidence={"virtual_work": ROUTE, "given_virtual_work": ROUTE, "energy_identity": ROUTE},
    statements=[claims.functions_of_its_constraints],
    named={"coordinate": claims.equation_of} | {f"multiplier_{i}": claims.multiplier_of(i) for i in range(1, 5)},
    shown=Shown(result_again=Level.STANDARD),
    quotes=[
        Quote(
            theorem,
            frozenset({"both", "kept"}),
            law_in=frozenset({"kept"}),
            between=frozenset({constrained}),
        )
        for theorem, constrained in (
            (MULTIPLIER_OF_ONE, "coordinates_once"),
            (MULTIPLIER_OF_ONE_RATE, "rates_once"),
            (MULTIPLIERS, "coordinates"),
            (MULTIPLIERS_OF_RATES, "rates"),
            (MULTIPLIERS_OF_BOTH, "both"),
        )
    ],
)


def forced_equation(of: Quantity, q: Coordinate, derivatives: Sequence[Quantity], key: str) -> Quantity:
    """Lagrange's equation, d/dt dL/dq_dot - dL/dq = Q + sum of lambda df/dq, with the constraints f = 0.

    of            the Lagrangian, J
    q             a coordinate of this Lagrangian
    derivatives   the steps for dL/dq, dL/dq_dot and the rate of dL/dq_dot, if there are such steps

    If forces without a potential energy act on the system, a step derives their generalized force Q.
    Second route: d'Alembert's principle, sum of (m a - F) . dr/dq = 0, from positions and forces. If the
    problem gives L itself, the energy identity is a further route.
    Outcomes: applied (forces without a potential energy act along q), kept (constraint forces act along q), both (both
    kinds act along q), free (neither kind acts along q).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.5 and 2.4.
    """
    matter, moving = of.needed(Matter), list(of.coordinates)
    acted, kept = of.fact(ActedOn), of.fact(Constrained)
    constraints = [c for c in (kept.constraints if kept else ()) if c.along(q.symbol) != 0]
    applied = applied_force(of, q) if acted is not None else None
    acts = applied is not None and applied.value != 0
    outside = [applied.value] if applied is not None and acts else []
    reaction = [spread(c.along(q.symbol)) * c.force for c in constraints]

    def right_side(*others: Expr) -> Expr:
        right = [*(others if acts else ()), *reaction]
        return Terms(*right) if len(right) > 1 else right[0] if right else ZERO

    def law(*given: Any) -> Relation:
        L, others = given[0], given[1:]
        return Relation(Terms(TimeRate(Partial(L, q.rate), *moving), -Partial(L, q.symbol)), "=", right_side(*others))

    def by_virtual_work() -> Relation:
        return Relation(matter.inertia_along(q.symbol) - matter.force_along(q.symbol), "=", 0)

    return establish(
        FORCED_EQUATION,
        None,
        law,
        {"lagrangian": of, **({"applied": applied} if applied is not None else {})},
        lines=Lines(
            put_in=None,
            between=with_derivatives(derivatives, right_side(*outside), moving),
            arranged=lambda found: _sides(found, moving, constraints),
        ),
        routes=matter.named({"virtual_work": compared_with(by_virtual_work)}) | matter.further_routes(q.symbol),
        outcome=("both" if constraints else "applied") if acts else "kept" if constraints else "free",
        phrase_data=PhraseData(
            words={"between": _between(kept.constraints if kept else ())},
            formulas=_functions_told(kept.constraints if kept else ()),
            named={"coordinate": q.symbol} | _multipliers_told(kept.constraints if kept else ()),
            outcome_data={"letters": tuple(c.force for c in constraints)},
        ),
        key=key,
        parents=[*derivatives, *([applied] if applied is not None else [])],
        facts=[
            OfCoordinate(q),
            ForcedMotion(of),
            matter,
        ],
        scope=Scope(coordinates={c.force: c.kind_of_force or "" for c in constraints}),
    )


def with_derivatives(derivatives: Sequence[Quantity], right: Expr, moving: Sequence[Symbol]) -> list[Form]:
    """Return the line with the derivatives of L, d/dt (m r^2 theta_dot) + m g r sin(theta) = right. There is no line if
    dL/dq is a single term, and dL/dq_dot is a single term without coordinates."""
    if not derivatives:
        return []
    force, momentum, _ = (explicit(each.value) for each in derivatives)
    constant = len(Add.make_args(momentum)) == 1 and not momentum.has(*moving)
    if constant and len(Add.make_args(force)) == 1:
        return []
    return [Form(Relation(difference(TimeRate(momentum, *moving), force), "=", right), "derivatives")]


def difference(first: Expr, second: Expr) -> Expr:
    """Return `first - second`. If `second` is a sum, its terms are in brackets."""
    terms = Add.make_args(second)
    if second == 0 or len(terms) == 1:
        return Terms(first, -second) if second != 0 else first
    all_negative = all(term.could_extract_minus_sign() for term in terms)
    return Terms(first, Group(-second) if all_negative else -Group(second))


def _between(constraints: Sequence[Constraint]) -> str:
    """Return the word for the quantities that the constraints relate: "coordinates", "rates" or "both". For one
    constraint, "_once" is added."""
    in_rates = {c.in_rates for c in constraints}
    found = "both" if len(in_rates) > 1 else "rates" if True in in_rates else "coordinates"
    return f"{found}_once" if len(constraints) == 1 else found


def _functions_told(constraints: Sequence[Constraint]) -> dict[str, tuple[Relation, Relation]]:
    """Return the functions that vanish where the constraints hold, such as f_x = x - R sin(theta).

    The index of f is the index of a multiplier such as lambda_x, otherwise the number of the constraint; a single f has
    no number. If the gradient of f does not have the length 1, the multiplier that belongs to the force N is also
    stated, for example lambda = N/sqrt(1 + x^2/b^2).
    """
    found = {}
    for i, each in enumerate(constraints, 1):
        _, _, index = each.force.name.partition("lambda_")
        called = f"f_{index}" if index else f"f_{i}" if len(constraints) > 1 else "f"
        terms = [each.left, *(-term for term in Add.make_args(each.right) if term != 0)]
        told = Relation(scalar(called), "=", Terms(*terms) if len(terms) > 1 else each.left)
        found[f"function_{i}"] = (told, Relation(scalar(called), "=", each.residual))
        if each.gradient != 1:
            multiplier = scalar(called.replace("f", "lambda"))
            by_work = Relation(multiplier, "=", _multiplier_by_work(each))
            found[f"multiplier_{i}"] = Relation(multiplier, "=", each.multiplier), by_work
    return found


def _multipliers_told(constraints: Sequence[Constraint]) -> dict[str, Symbol]:
    """Return the multiplier of each constraint whose force equals its multiplier. Only the first four constraints are
    considered, because a sentence names at most four. The keys are `multiplier_1`, `multiplier_2` and so on, by the
    position of the constraint."""
    return {f"multiplier_{i}": each.force for i, each in enumerate(constraints[:4], 1) if each.gradient == 1}


def _multiplier_by_work(of: Constraint) -> Expr:
    """Return the multiplier lambda from the virtual work lambda df/dq of the forces at material points."""
    q = next(q for q in of.coordinates if not is_zero(diff(of.residual, q)))
    loads = of.other_loads([q])
    return Add(*(load.work_along(q) for load in loads)) / diff(of.residual, q)


def _sides(found: Relation, moving: Sequence[Symbol], constraints: Sequence[Constraint]) -> Relation:
    whole = explicit(found.left) - explicit(found.right)
    whole = whole.expand()
    letters = [c.force for c in constraints]
    alone = [term for term in Add.make_args(whole) if _drives(term, moving, letters)]
    driven = -Add(*alone)
    held = _times_forces({letter: spread(diff(driven, letter)) for letter in letters})
    given = driven.xreplace(dict.fromkeys(letters, ZERO))
    left = by_accelerations(whole - Add(*alone), moving)
    return Relation(left, "=", Add(by_terms(tidied(given)), held))


def _times_forces(coefficients: Mapping[Symbol, Expr]) -> Expr:
    """Write a common factor of the constraint forces in front of them, if this is shorter: R (S_1 - S_2), not R S_1 - R
    S_2. A sum such as S_1/sqrt(A) - S_2/sqrt(B) stays unchanged.
    """
    acting = {letter: each for letter, each in coefficients.items() if each != 0}
    common = common_factor(list(acting.values())) if len(acting) > 1 else Integer(1)
    common = -common if common.could_extract_minus_sign() else common
    apart = {letter: tidied(each / common) if common.free_symbols else each for letter, each in acting.items()}
    inside = Add(*(each * letter for letter, each in apart.items()))
    if not common.free_symbols:
        return inside
    each_alone = Add(*(each * letter for letter, each in acting.items()))
    return min(Mul(common, inside, evaluate=False), each_alone, key=length)


def _drives(term: Expr, moving: Sequence[Symbol], letters: Sequence[Symbol]) -> bool:
    """Whether a term contains a constraint force, or contains no coordinate, rate or acceleration."""
    return any(term.has(letter) for letter in letters) or not term.has(
        *(s for q in moving for s in (q, rate(q), rate(q, 2)))
    )
