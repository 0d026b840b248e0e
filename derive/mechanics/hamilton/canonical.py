"""The Hamiltonian and Hamilton's equations, for a motion in coordinates and momenta."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Symbol, diff

from derive.algebra.collect import by_terms, spread
from derive.algebra.expressions import Factors, Partial, Relation, Terms, bound, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.hamilton import claims
from derive.mechanics.hamilton.facts import PhaseSpace
from derive.mechanics.hamilton.phase_space import rates_by_momenta
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, by_functions_of_time
from derive.mechanics.lagrange.applied_forces import ActedOn, applied_force
from derive.mechanics.lagrange.claims import ENERGIES
from derive.mechanics.lagrange.energy_forms import beside_potential, kinetic_first, part_of_degree
from derive.mechanics.lagrange.energy_function import outcome_of_energy, told_of_excess
from derive.mechanics.lagrange.facts import energies_of
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.lagrange.momenta import kind_of_momentum, letter_of_momentum, momenta
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.model.dalembert import Matter
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Level, Quantity, is_zero, lettered

__all__ = ["hamilton_equations", "hamiltonian", "in_momenta"]


HAMILTONIAN = Rule(
    "hamilton.hamiltonian",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1",
    outcomes=ENERGIES,
    evidence={"by_degree": ROUTE, "canonical": ROUTE, "there_and_back": CHECK, "given_canonical": CHECK},
)


def hamiltonian(of: Quantity, symbol: str | None = None, key: str = "hamiltonian") -> Quantity:
    """Hamiltonian, H(q, p, t) = sum of p q_dot - L, with the rates q_dot in terms of the momenta.

    of   the Lagrangian, J

    Separate steps derive the momenta, and the rates in terms of the momenta.
    Second route: H is T_2 - T_0 + U, where T_2 and T_0 are the parts of T of degree 2 and 0 in the rates. With the
    momenta as functions of the rates, dH/dp is q_dot, and -dH/dq is the sum of F . dr/dq + m v . d(dr/dq)/dt. Here F
    are the magnetic forces and the forces with a potential energy. For charges e in magnetic fields, -dH/dq also
    contains the time derivative of the sum of e A . dr/dq.
    Check: for a given L, the sum of p dH/dp, minus H, is L again, and -dH/dq is the first-order change of L if q
    changes.
    Outcomes: energy (H is conserved and is T + U); conserved (H is conserved but is not T + U); changing_energy
    (H is T + U, but L contains the time); changing (H is not T + U, and L contains the time); work_energy (H is T + U,
    but a force outside L does work); work (H is not T + U, and a force outside L does work); given_conserved,
    given_changing, given_work (the same for a given L, whose T and U are unknown).
    Errors: the same as for `rates_by_momenta`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    moving = coordinates_of(of)
    energies, matter = energies_of(of), of.needed(Matter)
    letters = {letter_of_momentum(q): kind_of_momentum(q.kind, of.step.kind) or "" for q in moving}
    given = momenta(of)
    space = PhaseSpace(tuple(moving), given, of)
    rates = rates_by_momenta(of, given, varying=True, key=f"{key}_rate")
    put_in = {v.symbol: v.value for v in rates}
    in_rates = space.in_rates

    def law(L: Expr, *both: Expr) -> Expr:
        return Terms(*(Factors(p, v) for p, v in zip(both[: len(moving)], both[len(moving) :], strict=True)), -L)

    def by_degree(found: Expr) -> tuple[Expr, Expr]:
        assert energies is not None
        kinetic, names = energies.kinetic.value, [q.rate for q in moving]
        parts = part_of_degree(kinetic, names, 2) - part_of_degree(kinetic, names, 0)
        return found, bound(parts, put_in) + energies.potential.value

    def there_and_back(found: Expr) -> tuple[Expr, Expr]:
        back = [p * diff(found, p) for _, p in space.pairs]
        return bound(Add(*back) - found, in_rates), explicit(of.value)

    def canonical(found: Expr) -> tuple[Any, Any]:
        onwards = [bound(diff(found, p), in_rates) for _, p in space.pairs]
        pushed = [bound(-diff(found, q), in_rates) for q, _ in space.pairs]
        stored = [matter.stored_force_along(q) + matter.deflection_along(q) for q, _ in space.pairs]
        forces = [push + matter.turning_along(q) for push, (q, _) in zip(stored, space.pairs, strict=True)]
        return ImmutableDenseMatrix([*onwards, *pushed]), ImmutableDenseMatrix([*(q.rate for q in moving), *forces])

    h = explicit(sum((p.value * v for p, v in zip(given, put_in, strict=True)), -explicit(of.value)))
    written = beside_potential(bound(h, put_in), of, list(letters))
    return establish(
        HAMILTONIAN,
        scalar(symbol or free_letter("H")),
        law,
        {
            "lagrangian": replace(of, value=bound(explicit(of.value), put_in), parents=(of,)),
            **{f"momentum_{p.key}": lettered(p) for p in given},
            **{v.key: v for v in rates},
        },
        lines=Lines(
            put_in=Level.FULL,
            result=False,
            arranged=lambda _: written,
            after=kinetic_first(written, list(letters)),
        ),
        routes={
            **({"by_degree": by_degree} if energies is not None else {"there_and_back": there_and_back}),
            **matter.named({"canonical": canonical}),
        },
        outcome=outcome_of_energy(h, of),
        phrase_data=PhraseData(formulas=told_of_excess(h, of, [q.rate for q in moving]), points_to={"whole": of}),
        key=key,
        kind=of.step.kind,
        facts=[space],
        scope=Scope(coordinates=letters),
    )


def hamilton_equations(of: Quantity) -> tuple[Quantity, ...]:
    """Hamilton's equations, q_dot = dH/dp_q and p_q_dot = -dH/dq + Q + sum of lambda df/dq for each coordinate.
    Q is the generalized force of the forces without a potential energy; lambda are the multipliers of the constraints
    f = 0.

    of   the Hamiltonian, J

    Keys: canonical_x for the coordinate x, and canonical_p_x for its momentum p_x.
    Second route: with the momenta as functions of the rates, the second equation is d'Alembert's principle, sum of
    (m a - F) . dr/dq = 0.
    Check: with the momenta as functions of the rates, the first equation is q_dot = q_dot.
    Outcomes: rate (the first equation); force (the second equation); cyclic (the second equation, if H does not contain
    q); applied (the second equation, with Q or constraint forces).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1 and problem 8.4.
    """
    found: list[Quantity] = []
    for q in of.needed(PhaseSpace).coordinates:
        found += [_equation_of_rate(of, q), _equation_of_momentum(of, q)]
    return tuple(found)


def _with_mark(found: Relation, values: Sequence[Expr]) -> ImmutableDenseMatrix:
    """Return a column with the values, then 1 if `found` is an equation and 0 otherwise."""
    return ImmutableDenseMatrix([*values, int(found.operator == "=")])


HAMILTON_EQUATION = Rule(
    "hamilton.hamilton_equation",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1",
    outcomes={
        "rate": claims.hamilton_equation_rate,
        "force": claims.hamilton_equation_force,
        "cyclic": claims.hamilton_equation_cyclic,
        "applied": claims.hamilton_equation_applied,
    },
    evidence={"momenta": CHECK, "virtual_work": ROUTE, "given_virtual_work": ROUTE},
)


def _equation_of_rate(of: Quantity, q: Coordinate) -> Quantity:
    space, p = of.needed(PhaseSpace), letter_of_momentum(q)
    solved = next(parent for parent in of.parents if parent.symbol == q.rate)

    def by_momenta(found: Relation) -> tuple[Any, Any]:
        sides = [found.left, bound(explicit(found.right), space.in_rates)]
        return _with_mark(found, sides), ImmutableDenseMatrix([q.rate, q.rate, 1])

    return establish(
        HAMILTON_EQUATION,
        None,
        lambda H: Relation(q.rate, "=", Partial(H, p)),
        {"hamiltonian": of},
        lines=Lines(put_in=None, arranged=lambda found: Relation(found.left, found.operator, solved.value)),
        routes={"momenta": by_momenta},
        outcome="rate",
        phrase_data=PhraseData(outcome_data={"coordinate": q.symbol, "momentum": p}),
        key=f"canonical_{q.symbol.name}",
        facts=[space, OfCoordinate(q)],
    )


def _equation_of_momentum(of: Quantity, q: Coordinate) -> Quantity:
    space, p = of.needed(PhaseSpace), letter_of_momentum(q)
    matter = space.lagrangian.needed(Matter)

    def by_virtual_work(found: Relation) -> tuple[Any, Any]:
        in_rates = space.in_rates
        changing = by_functions_of_time(in_rates[p], [each.symbol for each in space.coordinates])
        lost = changing - bound(explicit(found.right), in_rates)
        work = matter.inertia_along(q.symbol) - matter.force_along(q.symbol)
        return _with_mark(found, [found.left, lost]), ImmutableDenseMatrix([rate(p), work, 1])

    cyclic = not explicit(of.value).has(q.symbol)
    acted, kept = space.lagrangian.fact(ActedOn), space.lagrangian.fact(Constrained)
    applied = applied_force(space.lagrangian, q) if acted is not None else None
    pushes = []
    if applied is not None and not is_zero(applied.value):
        rates = {v.symbol: v.value for v in of.parents if v.symbol in {each.rate for each in space.coordinates}}
        pushes = [replace(applied, value=bound(explicit(applied.value), rates), parents=(applied,))]
    held = [spread(c.along(q.symbol)) * c.force for c in (kept.constraints if kept else ())]
    held = [term for term in held if term != 0]

    def law(H: Expr, *forces: Expr) -> Relation:
        terms = [-Partial(H, q.symbol), *forces, *held]
        return Relation(rate(p), "=", Terms(*terms) if len(terms) > 1 else terms[0])

    return establish(
        HAMILTON_EQUATION,
        None,
        law,
        {"hamiltonian": of, **{push.key: push for push in pushes}},
        lines=Lines(put_in=None, arranged=lambda found: _by_terms(found, [p for _, p in space.pairs])),
        routes=matter.named({"virtual_work": by_virtual_work}),
        outcome="applied" if pushes or held else "cyclic" if cyclic else "force",
        phrase_data=PhraseData(outcome_data={"coordinate": q.symbol, "momentum": p}),
        key=f"canonical_{p.name}",
        facts=[space, OfCoordinate(q)],
        scope=Scope(coordinates={c.force: c.kind_of_force or "" for c in (kept.constraints if kept else ())}),
    )


def _by_terms(found: Relation, letters: Sequence[Symbol]) -> Relation:
    """Simplify the right side: each term with momenta separately, and all other terms together."""
    right = explicit(found.right)
    terms = Add.make_args(right)
    moving, rest = ([term for term in terms if term.has(*letters) == held] for held in (True, False))
    return Relation(found.left, found.operator, Add(by_terms(Add(*moving)), tidied(Add(*rest))))


IN_MOMENTA = Rule(
    "hamilton.in_momenta",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1",
    evidence={"momenta": CHECK},
)


def in_momenta(quantity: Quantity, of: Quantity, key: str | None = None) -> Quantity:
    """A quantity whose rates are replaced by expressions in the momenta: x p_y - y p_x for m (x y_dot - y x_dot).

    quantity   a scalar in coordinates and rates
    of         the Hamiltonian of the same system, J

    Check: with the momenta as functions of the rates, the result is the original quantity.
    Errors: the quantity contains no rate of a coordinate of this Hamiltonian, or belongs to another system.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    space = of.needed(PhaseSpace)
    rates = {parent.symbol: parent for parent in of.parents if parent.symbol in {q.rate for q in space.coordinates}}
    present: Sequence[Quantity] = [v for symbol, v in rates.items() if explicit(quantity.value).has(symbol)]
    if not present:
        message = f"`in_momenta`: `{quantity.key}` contains no rate of the coordinates of `{of.key}`"
        raise Rejected(Complaint("nothing-to-put-in", message))
    values = {v.symbol: v.value for v in present}

    def back(found: Expr) -> tuple[Expr, Expr]:
        return bound(explicit(found), space.in_rates), explicit(quantity.value)

    return establish(
        IN_MOMENTA,
        quantity.symbol,
        lambda _, *those: bound(explicit(quantity.value), dict(zip(values, those, strict=True))),
        {"quantity": quantity, **{v.key: v for v in present}},
        lines=Lines(put_in=None, law=Level.FULL, arranged=lambda value: by_terms(explicit(value).expand())),
        routes={"momenta": back},
        key=key or f"{quantity.key}_in_momenta",
        kind=quantity.step.kind,
        facts=[space],
        scope=Scope(case_of=quantity),
    )
