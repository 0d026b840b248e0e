"""Predicates of Hamiltonian mechanics: each judges whether an outcome, or a statement in its sentence, is correct."""

from __future__ import annotations

from sympy import Add, Integer, Symbol, diff

from derive.algebra.equality import equal
from derive.algebra.expressions import bound, explicit, rate
from derive.mechanics.hamilton.facts import Constant, PhaseSpace
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.lagrange.facts import Energies, energies_of
from derive.mechanics.model.dalembert import Matter
from derive.steps.claims import both, value_of_role, vanishes
from derive.steps.rule import Judged, Predicate, handed_on_by
from derive.steps.step import Quantity, is_zero


def does_not_occur(facts: Judged, fact: Constant) -> bool:
    return not value_of_role(facts, "lagrangian").has(fact.coordinate.symbol)


def is_equation_of(facts: Judged, letter: Symbol) -> bool:
    return facts.result.operator == "=" and bool(facts.result.left == rate(letter))


def pushed(facts: Judged, beside: bool) -> bool:
    """Whether the result is an equation for the rate of the momentum. If `beside` is true, the right side of this
    equation must contain terms in addition to -dH/dq; otherwise the right side must be -dH/dq."""
    H, q = explicit(facts.inputs["hamiltonian"]), facts.inputs["coordinate"]
    more = not is_zero(explicit(facts.result.right) + diff(H, q))
    return is_equation_of(facts, facts.inputs["momentum"]) and more == beside


def conserved(kind: str | None) -> Predicate:
    """Judge whether the coordinate has this kind, and whether the rate of its momentum vanishes by d'Alembert's
    principle. None means that the coordinate is neither an angle nor a length, or that L is not an energy."""

    def is_so(facts: Judged) -> bool:
        L, q = facts.quantities["lagrangian"], facts.inputs["coordinate"]
        matter = L.needed(Matter)
        by_time = by_functions_of_time(facts.result, matter.coordinates)
        is_momentum = L.step.kind == "energy" and L.coordinates[q] in {"angle", "length"}
        of_kind = is_momentum and L.coordinates[q] == kind if kind else not is_momentum
        return of_kind and bool(equal(by_time, matter.inertia_along(q) - matter.force_along(q)))

    return is_so


def seen_by_the_rest(constants: bool, driven: bool | None) -> Predicate:
    """Judge whether the result uses constant momenta if and only if `constants` is true. If `driven` is true, T must
    also differ from zero where all rates vanish, and the result must differ from U. If `driven` is false, T must vanish
    there, and the result must be U."""

    def is_so(facts: Judged) -> bool:
        kept = [role for role in facts.quantities if role.startswith("constant_")]
        L = facts.quantities["lagrangian"]
        if energies_of(L) is None:
            return bool(kept) and constants
        matter, potential = L.needed(Matter), explicit(L.needed(Energies).potential.value)
        at_rest = bound(matter.kinetic_energy(), {rate(q): Integer(0) for q in matter.coordinates})
        same = is_zero(facts.result - potential)
        return bool(kept) == constants and (driven is None or (not is_zero(at_rest), not same) == (driven, driven))

    return is_so


def constants(facts: Judged) -> int:
    return sum(role.startswith("constant_") for role in facts.quantities)


def keeps_along_the_motion(facts: Judged) -> bool:
    """Whether the second function is the Hamiltonian of a Lagrangian, and the first function is constant along the
    motions of this Hamiltonian."""
    other: Quantity = facts.quantities["g"]
    space = other.needed(PhaseSpace)
    L = space.lagrangian
    matter = L.needed(Matter)
    f = explicit(facts.inputs["f"])
    in_rates = {p: matter.momentum_along(q) for q, p in space.pairs}
    sums = [bound(diff(f, p), in_rates) * (matter.inertia_along(q) - matter.force_along(q)) for q, p in space.pairs]
    kept = equal(by_functions_of_time(bound(f, in_rates), matter.coordinates), Add(*sums))
    return other.step.rule == "hamilton.hamiltonian" and bool(kept)


def bracket_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the symbol of the bracket contains f and g in this order, and pairs each coordinate with its momentum."""
    named = [facts.quantities[role].symbol if role in facts.quantities else facts.inputs[role] for role in ("f", "g")]
    own = all(p.name == f"p_{q.name}" for q, p in facts.symbol.pairs)
    return own and list(facts.symbol.args[:2]) == named


poisson_bracket_conserved: Predicate = both(vanishes, keeps_along_the_motion)


def rate_by_momenta_alone(facts: Judged) -> bool:
    return bool(len(facts.quantities) == 1)


def rate_by_momenta_together(facts: Judged) -> bool:
    return bool(len(facts.quantities) > 1)


def hamilton_equation_rate(facts: Judged) -> bool:
    return bool(is_equation_of(facts, facts.inputs["coordinate"]))


def hamilton_equation_force(facts: Judged) -> bool:
    return bool(pushed(facts, beside=False) and not is_zero(facts.result.right))


def hamilton_equation_cyclic(facts: Judged) -> bool:
    return bool(pushed(facts, beside=False) and is_zero(facts.result.right))


def hamilton_equation_applied(facts: Judged) -> bool:
    return bool(pushed(facts, beside=True))


def routhian_one(facts: Judged) -> bool:
    return bool(constants(facts) == 1)


def routhian_several(facts: Judged) -> bool:
    return bool(constants(facts) > 1)


def effective_potential_given(facts: Judged) -> bool:
    return bool(energies_of(facts.quantities["lagrangian"]) is None and constants(facts) == 0)


handed_on_by(Constant, does_not_occur)
