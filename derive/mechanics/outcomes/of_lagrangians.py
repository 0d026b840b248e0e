"""What must be true for each word that chooses a sentence about momenta, energy functions, and what is conserved."""

from __future__ import annotations

from sympy import Add, Dummy, Expr, Integer, Symbol, diff

from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, bound, explicit, rate
from derive.mechanics.hamilton.phase_space import PhaseSpace
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.lagrange.lagrangian import Energies, energies_of
from derive.mechanics.model.constraint import Kept
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.outcomes.signs import lasts, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of, told_by
from derive.steps.step import Quantity, is_zero


def _in_rates(facts: Judged) -> Expr:
    """The result with the momenta of the mass points in the place of their letters."""
    L: Quantity = facts.quantities["lagrangian"]
    matter = L.needed(Matter)
    letters = {q.name: q for q in matter.coordinates}
    present = {s: s.name.removeprefix("p_") for s in facts.result.free_symbols if s.name.startswith("p_")}
    momenta = {p: matter.momentum_along(letters[name]) for p, name in present.items() if name in letters}
    return bound(explicit(facts.result), momenta)


def _is_conserved(facts: Judged) -> bool:
    """Its rate along the motion, the accelerations taken out by d'Alembert's principle, vanishes.

    What keeps a constraint does no work in the velocities that the constraint allows.
    """
    L = facts.quantities["lagrangian"]
    matter, kept = L.needed(Matter), L.fact(Kept)
    along = [rate(q) * (matter.inertia_along(q) - matter.force_along(q)) for q in matter.coordinates]
    along += [c.force * c.velocity(list(matter.coordinates)) for c in (kept.constraints if kept else ())]
    return bool(equal(by_functions_of_time(_in_rates(facts), matter.coordinates), Add(*along)))


def _is_energy(facts: Judged) -> bool:
    """Kinetic energy of the mass points, and the potential energy."""
    L = facts.quantities["lagrangian"]
    whole = L.needed(Matter).kinetic_energy() + explicit(L.needed(Energies).potential.value)
    return bool(equal(_in_rates(facts), whole))


def _is_worked_on(facts: Judged) -> bool:
    """Its rate along the motion is not -dL/dt alone."""
    L = facts.quantities["lagrangian"]
    matter, kept = L.needed(Matter), L.fact(Kept)
    power = Add(*(rate(q) * matter.other_force_along(q) for q in matter.coordinates))
    power -= Add(*(c.force * c.velocity(list(matter.coordinates)) for c in (kept.constraints if kept else ())))
    return not is_zero(power)


def _energy(conserved: bool, whole: bool, worked: bool = False) -> Predicate:
    return lambda facts: (_is_conserved(facts), _is_energy(facts), _is_worked_on(facts)) == (conserved, whole, worked)


def _given(conserved: bool, worked: bool) -> Predicate:
    """Of a Lagrangian that is no difference of two energies."""

    def is_so(facts: Judged) -> bool:
        L = facts.quantities["lagrangian"]
        is_given = energies_of(L) is None
        return is_given and (_is_conserved(facts), _is_worked_on(facts)) == (conserved, worked)

    return is_so


_ENERGIES = {
    "given_conserved": _given(True, False),
    "given_changing": _given(False, False),
    "given_work": _given(False, True),
    "energy": _energy(True, True),
    "conserved": _energy(True, False),
    "changing_energy": _energy(False, True),
    "changing": _energy(False, False),
    "work_energy": _energy(False, True, True),
    "work": _energy(False, False, True),
}


def _rate_by(*, in_time: bool | None, worked: bool, lost: bool | None = None) -> Predicate:
    """An equation; whether -dL/dt is in its right side, and other work, and whether no rates make it positive."""

    def is_so(facts: Judged) -> bool:
        if facts.result.mark != "=" or is_zero(facts.result.right) != (in_time is None):
            return False
        found, by_time = explicit(facts.result.right), -diff(explicit(facts.inputs["lagrangian"]), TIME)
        if in_time is None:
            return True
        told = (not is_zero(by_time), not is_zero(found - by_time))
        return told == (in_time, worked) and (lost is None or _never_gains(found, facts.inputs["moving"]) == lost)

    return is_so


def _never_gains(power: Expr, moving: tuple[Symbol, ...]) -> bool:
    """Against the rates as a quadratic form, whose matrix has no positive leading entry and no odd part."""
    rates = [rate(q) for q in moving]
    forwards = power.xreplace({v: -v for v in rates})
    return is_zero(forwards - power) and all(bool(diff(power, v, 2).is_nonpositive) for v in rates)


def _is_equation_of(facts: Judged, letter: Symbol) -> bool:
    return facts.result.mark == "=" and bool(facts.result.left == rate(letter))


def _pushed(facts: Judged, beside: bool) -> bool:
    """An equation of the momentum, with more on its right side than -dH/dq or not."""
    H, q = explicit(facts.inputs["hamiltonian"]), facts.inputs["coordinate"]
    more = not is_zero(explicit(facts.result.right) + diff(H, q))
    return _is_equation_of(facts, facts.inputs["momentum"]) and more == beside


def _conserved(kind: str | None) -> Predicate:
    """The coordinate is of the kind, and its momentum changes by no more than d'Alembert's principle lets vanish."""

    def is_so(facts: Judged) -> bool:
        L, q = facts.quantities["lagrangian"], facts.inputs["coordinate"]
        matter = L.needed(Matter)
        by_time = by_functions_of_time(facts.result, matter.coordinates)
        is_momentum = L.step.kind == "energy" and L.coordinates[q] in {"angle", "length"}
        of_kind = is_momentum and L.coordinates[q] == kind if kind else not is_momentum
        return of_kind and bool(equal(by_time, matter.inertia_along(q) - matter.force_along(q)))

    return is_so


def _seen_by_the_rest(constants: bool, driven: bool | None) -> Predicate:
    """Of two sorts: momenta are kept, or a motion is prescribed, so that at rest there is a kinetic energy."""

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


def _constants(facts: Judged) -> int:
    return sum(role.startswith("constant_") for role in facts.quantities)


def _carries_momenta_alone(facts: Judged) -> bool:
    """Where all rates vanish and no place moves by itself, nothing is left but what the shift adds to L."""
    return is_zero(facts.inputs["gain"])


def _keeps_along_the_motion(facts: Judged) -> bool:
    """The second function is the Hamiltonian of a Lagrangian, along whose motions the first one does not change."""
    other: Quantity = facts.quantities["g"]
    space = other.needed(PhaseSpace)
    L = space.lagrangian
    matter = L.needed(Matter)
    f = explicit(facts.inputs["f"])
    in_rates = {p: matter.momentum_along(q) for q, p in space.pairs}
    sums = [bound(diff(f, p), in_rates) * (matter.inertia_along(q) - matter.force_along(q)) for q, p in space.pairs]
    kept = equal(by_functions_of_time(bound(f, in_rates), matter.coordinates), Add(*sums))
    return other.step.rule == "hamilton.hamiltonian" and bool(kept)


def _bracket_as_told(facts: Judged, outcome: str) -> bool:
    """The roles stand in the bracket in their order, and each momentum beside its own coordinate."""
    named = [facts.quantities[role].symbol if role in facts.quantities else facts.inputs[role] for role in ("f", "g")]
    own = all(p.name == f"p_{q.name}" for q, p in facts.symbol.pairs)
    return own and list(facts.symbol.args[:2]) == named


def _shifted_as_told(facts: Judged, outcome: str) -> bool:
    """L at the shifted coordinates, by functions of time, less what it gains, does not depend on the shift."""
    L, small = facts.quantities["lagrangian"], Dummy("epsilon")
    moving = L.needed(Matter).coordinates
    shifted: dict[Symbol, Expr] = {}
    for role, q in facts.inputs.items():
        if not role.startswith("q_"):
            continue
        x = facts.inputs.get(role.replace("q", "xi"), Integer(1))
        shifted.update({q: q + small * x, rate(q): rate(q) + small * by_functions_of_time(x, moving)})
    change = diff(bound(explicit(L.value), shifted), small).subs(small, 0)
    return bool(equal(change, explicit(facts.result.right)))


_TABLE: dict[str, dict[str, Predicate]] = {
    "hamilton.poisson_bracket": {
        "generic": lasts,
        "zero": vanishes,
        "conserved": lambda facts: vanishes(facts) and _keeps_along_the_motion(facts),
    },
    "lagrange.conjugate_momentum": {"generic": lasts, "zero": vanishes},
    "hamilton.rate_by_momenta": {
        "alone": lambda facts: len(facts.quantities) == 1,
        "together": lambda facts: len(facts.quantities) > 1,
    },
    "hamilton.hamiltonian": _ENERGIES,
    "hamilton.hamilton_equation": {
        "rate": lambda facts: _is_equation_of(facts, facts.inputs["coordinate"]),
        "force": lambda facts: _pushed(facts, beside=False) and not is_zero(facts.result.right),
        "cyclic": lambda facts: _pushed(facts, beside=False) and is_zero(facts.result.right),
        "applied": lambda facts: _pushed(facts, beside=True),
    },
    "hamilton.conserved": {
        "angular": _conserved("angle"),
        "linear": _conserved("length"),
        "other": _conserved(None),
    },
    "hamilton.routhian": {
        "one": lambda facts: _constants(facts) == 1,
        "several": lambda facts: _constants(facts) > 1,
    },
    "hamilton.effective_potential": {
        "reduced": _seen_by_the_rest(True, None),
        "driven": _seen_by_the_rest(False, True),
        "unchanged": _seen_by_the_rest(False, False),
        "given": lambda facts: energies_of(facts.quantities["lagrangian"]) is None and _constants(facts) == 0,
    },
    "lagrange.change_under_shift": {
        "none": lambda facts: facts.result.mark == "=" and is_zero(facts.result.right),
        "gain": lambda facts: facts.result.mark == "=" and not is_zero(facts.result.right),
    },
    "lagrange.noether": {
        "symmetry": lambda facts: _carries_momenta_alone(facts),
        "with_gain": lambda facts: not _carries_momenta_alone(facts),
    },
    "lagrange.energy_function": _ENERGIES,
    "lagrange.energy_function_rate": {
        "conserved": _rate_by(in_time=None, worked=False),
        "changes": _rate_by(in_time=True, worked=False),
        "work": _rate_by(in_time=False, worked=True),
        "lost": _rate_by(in_time=False, worked=True, lost=True),
        "work_and_time": _rate_by(in_time=True, worked=True),
    },
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)

told_by("hamilton.poisson_bracket", _bracket_as_told)
told_by("lagrange.change_under_shift", _shifted_as_told)
