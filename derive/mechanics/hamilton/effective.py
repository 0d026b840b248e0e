"""Reduction by cyclic coordinates: conserved momenta, the Routhian, the effective potential energy.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.3; Landau, Lifshitz, *Mechanics*, section 41.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import At, Factors, Partial, Terms, bound, depends_on_time, explicit, rate, scalar
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.hamilton import claims
from derive.mechanics.hamilton.facts import Constant, ReducedMatter, SeenWith
from derive.mechanics.hamilton.phase_space import rates_by_momenta
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, by_functions_of_time, required
from derive.mechanics.lagrange.energy_forms import beside_potential, kinetic_first, part_of_degree
from derive.mechanics.lagrange.facts import Energies, FromLagrangian, energies_of
from derive.mechanics.lagrange.kept_momentum import value_kept
from derive.mechanics.lagrange.lagrangian import coordinates_of
from derive.mechanics.lagrange.momenta import kind_of_momentum, letter_of_momentum, written_momentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.establish import Lines, establish
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Level, Quantity, compared_with, lettered

__all__ = ["conserved", "effective_potential", "routhian"]

ZERO = Integer(0)


CONSERVED = Rule(
    "hamilton.conserved",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6",
    outcomes={
        "angular": claims.conserved("angle"),
        "linear": claims.conserved("length"),
        "other": claims.conserved(None),
    },
    evidence={
        "along_the_motion": ROUTE,
        "virtual_work": ROUTE,
        "given_along_the_motion": CHECK,
        "given_virtual_work": ROUTE,
    },
)


def conserved(of: Quantity, q: Coordinate, value: str | Expr | None = None, key: str | None = None) -> Quantity:
    """Momentum of a cyclic coordinate, p_q = dL/dq_dot, which is constant; later steps use the symbol of the momentum.

    of      the Lagrangian, J
    q       a coordinate that L does not contain
    value   the symbol of the constant, by default p_q; or the initial value of the momentum, such as I_z*S. An initial
            value makes the result an equation for the rates, p_q = I_z*S, which `put_in` substitutes in other equations

    Second route: the sum of m v . dr/dq over the mass points, and of e A . dr/dq over charges e in magnetic fields.
    The time derivative of this sum, as a function of t, is the sum of (m a - F) . dr/dq, which vanishes by d'Alembert's
    principle.
    Check: for a given L, the momentum is the first-order change of L if q_dot changes.
    Outcomes: angular (q is an angle), linear (q is a length), other (neither, or L is not an energy).
    Errors: L contains q, or does not contain q_dot; a force outside L acts along q; a given initial value is not
    constant, or is given for a momentum that is not linear in q_dot.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6.
    """
    required(of.coordinates, q, "conserved", of)
    L = explicit(of.value)
    if L.has(q.symbol):
        message = f"`conserved`: `{of.key}` contains {q.symbol.name}, so this coordinate has no constant momentum"
        raise Rejected(Complaint("not-cyclic", message))
    if not L.has(q.rate):
        message = (
            f"`conserved`: `{of.key}` does not contain the rate of {q.symbol.name}, so {q.symbol.name} has no momentum"
        )
        raise Rejected(Complaint("not-cyclic", message))
    known = value if isinstance(value, Expr) and not isinstance(value, Symbol) else None
    letter = scalar(value) if isinstance(value, str) else value if isinstance(value, Symbol) else letter_of_momentum(q)
    matter = of.needed(Matter)
    if _pushed(matter, q) != 0:
        message = f"`conserved`: a force that is not in `{of.key}` acts along {q.symbol.name}"
        raise Rejected(Complaint("not-cyclic", message))
    moving = list(of.coordinates)

    def by_virtual_work(found: Expr) -> tuple[Expr, Expr]:
        return by_functions_of_time(found, moving), matter.inertia_along(q.symbol) - matter.force_along(q.symbol)

    momentum = establish(
        CONSERVED,
        letter,
        lambda L, _: Partial(L, q.rate),
        {"lagrangian": of, "coordinate": q.symbol},
        lines=Lines(put_in=None, arranged=lambda value: written_momentum(value, of)),
        routes=matter.named(
            {
                "along_the_motion": compared_with(lambda: matter.momentum_along(q.symbol)),
                "virtual_work": by_virtual_work,
            }
        ),
        outcome={"angle": "angular", "length": "linear"}.get(q.kind, "other") if of.step.kind == "energy" else "other",
        key=f"conserved_{q.symbol.name}" if key is None or known is not None else key,
        kind=kind_of_momentum(q.kind, of.step.kind),
        facts=[FromLagrangian(of), OfCoordinate(q), Constant(q)],
    )
    return momentum if known is None else value_kept(momentum, known, matter, key or f"constant_{q.symbol.name}")


def _pushed(matter: Matter, q: Coordinate) -> Expr:
    return tidied(explicit(matter.other_force_along(q.symbol)))


def _put_aside(of: Quantity, constants: Sequence[Quantity], verb: str) -> list[Coordinate]:
    """Return the coordinates of the Lagrangian except the coordinates of the constant momenta. At least one coordinate
    must remain."""
    found = coordinates_of(of)
    for each in constants:
        q = each.needed(Constant).coordinate
        if each.needed(FromLagrangian).lagrangian.step != of.step:
            message = f"`{verb}`: `{each.key}` is not a momentum of `{of.key}`"
            raise Rejected(Complaint("different-subjects", message))
        if q not in found:
            raise Rejected(Complaint("wrong-argument", f"`{verb}`: {q.symbol.name} is given twice"))
        found.remove(q)
    for q in found:
        pushed = _pushed(of.needed(Matter), q)
        at_rest = pushed.xreplace({rate(s): ZERO for s in of.coordinates})
        if (pushed if verb == "routhian" else at_rest) != 0:
            message = f"`{verb}`: a force without a potential energy acts along {q.symbol.name}"
            raise Rejected(Complaint("wrong-argument", message, help="use the equation of motion with this force"))
    if not found:
        message = f"`{verb}`: every coordinate has a constant momentum, so no coordinate remains"
        raise Rejected(Complaint("wrong-argument", message))
    return found


ROUTHIAN = Rule(
    "hamilton.routhian",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 8.3, where R has the other sign",
    outcomes={"one": claims.routhian_one, "several": claims.routhian_several},
    evidence={"matter": ROUTE, "energies": ROUTE, "given_matter": CHECK},
)


def routhian(of: Quantity, *constants: Quantity, symbol: str | None = None, key: str = "routhian") -> Quantity:
    """Routhian, R = L - sum of p q_dot over the cyclic coordinates: a Lagrangian for the other coordinates.

    of          the Lagrangian, J
    constants   momenta of cyclic coordinates, results of `conserved`

    Separate steps derive the rates of the cyclic coordinates.
    Second route: -dR/dp is the rate of a cyclic coordinate. For each other coordinate, dR/dq_dot is the sum of
    m v . dr/dq, and dR/dq is the sum of F . dr/dq + m v . d(dr/dq)/dt over the mass points and forces. For charges e in
    magnetic fields, the sum of e A . dr/dq is added to dR/dq_dot, and its time derivative is added to dR/dq. With the
    rates substituted, R is T - U - sum of p q_dot, plus the sum of e v . A.
    Check: for a given L, first-order changes of L take the place of these sums.
    Outcomes: one (one momentum is constant), several.
    Errors: no momentum is given; a momentum belongs to another Lagrangian or is given twice; no coordinate remains; a
    force outside L acts along a remaining coordinate; also the errors of `rates_by_momenta`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.3, where R has the other sign.
    """
    if not constants:
        raise Rejected(
            Complaint(
                "wrong-argument",
                "`routhian` needs a conserved momentum",
                help=Spelled(
                    "`conserved(L, phi)` gives the momentum of phi",
                    "no cyclic coordinate of this system has a constant momentum",
                ),
            )
        )
    left = _put_aside(of, constants, "routhian")
    rates = rates_by_momenta(of, constants)
    put_in = {v.symbol: v.value for v in rates}
    matter = of.needed(Matter)
    reduced = ReducedMatter((), (), tuple(q.symbol for q in left), whole=matter, rates=tuple(put_in.items()))

    letters = [each.symbol for each in constants]
    carried = Add(*(p * v for p, v in zip(letters, put_in.values(), strict=True)))
    whole = bound(explicit(of.value), put_in) - carried

    def by_matter(found: Expr) -> tuple[Any, Any]:
        ours = [-slope(found, p) for p in letters] + [slope(found, s) for q in left for s in (q.rate, q.symbol)]
        theirs: list[Expr] = list(put_in.values())
        for q in left:
            pushed = reduced.force_along(q.symbol) + reduced.turning_along(q.symbol)
            theirs += [reduced.momentum_along(q.symbol), pushed]
        return ImmutableDenseMatrix(ours), ImmutableDenseMatrix(theirs)

    parts = energies_of(of)

    def energies(found: Expr) -> tuple[Expr, Expr]:
        assert parts is not None
        whole = explicit(parts.kinetic.value) + explicit(matter.energy_in_fields())
        return found, bound(whole, put_in) - parts.potential.value - carried

    def law(L: Expr, *both: Expr) -> Expr:
        n = len(constants)
        return Terms(L, *(-Factors(p, v) for p, v in zip(both[:n], both[n:], strict=True)))

    written = beside_potential(whole, of, letters, [q.symbol for q in left], sign=-1)
    return establish(
        ROUTHIAN,
        scalar(symbol or free_letter("R")),
        law,
        _inputs(of, constants, rates, put_in),
        lines=Lines(
            put_in=Level.FULL,
            result=False,
            arranged=lambda _: written,
            after=kinetic_first(written, [*(q.rate for q in left), *letters]),
        ),
        routes={**matter.named({"matter": by_matter}), **({"energies": energies} if parts is not None else {})},
        outcome="one" if len(constants) == 1 else "several",
        key=key,
        kind=of.step.kind,
        facts=[reduced],
    )


def _inputs(
    of: Quantity, constants: Sequence[Quantity], rates: Sequence[Quantity], put_in: Mapping[Symbol, Expr]
) -> dict[str, Any]:
    """Return the inputs of a law: the Lagrangian with the rates substituted, the constant momenta, and the rates."""
    return {
        "lagrangian": replace(of, value=bound(explicit(of.value), dict(put_in)), parents=(of,)),
        **{f"constant_{each.key}": lettered(each) for each in constants},
        **{v.key: v for v in rates},
    }


EFFECTIVE_POTENTIAL = Rule(
    "hamilton.effective_potential",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 3.3; Taylor, *Classical Mechanics*, section 8.4",
    outcomes={
        "reduced": claims.seen_by_the_rest(True, None),
        "driven": claims.seen_by_the_rest(False, True),
        "unchanged": claims.seen_by_the_rest(False, False),
        "given": claims.effective_potential_given,
    },
    evidence={"forces": ROUTE, "given_forces": ROUTE, "by_degree": ROUTE},
)


def effective_potential(
    of: Quantity, *constants: Quantity, symbol: str | None = None, key: str = "effective_potential"
) -> Quantity:
    """Effective potential energy of the coordinates without constant momenta, U_eff = sum of p q_dot - L. The sum is
    over the coordinates with constant momenta, and the rates of all other coordinates are zero.

    of          the Lagrangian, J, which does not contain the time
    constants   momenta of cyclic coordinates, results of `conserved`; by default the momenta of all cyclic coordinates

    Without cyclic coordinates U_eff is U - T_0, where T_0 is the part of T without rates. In a prescribed rotation, for
    example, T_0 is not zero.
    Second route: where the rates and accelerations of the remaining coordinates vanish, -dU_eff/dq is the sum of
    (F - m a) . dr/dq, with the rates of the cyclic coordinates substituted. Also, U_eff is T_2 - T_0 + U with these
    rates, where T_2 is the part of T of degree 2 in the rates.
    Outcomes: reduced (momenta are conserved), driven (a prescribed motion), unchanged (no conserved momentum
    and no prescribed motion, so U_eff is U), given (L is given, without cyclic coordinates).
    Errors: L contains the time; a momentum belongs to another Lagrangian or is given twice; no coordinate remains; a
    force outside L acts where the rates vanish; also the errors of `rates_by_momenta`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 3.3; Taylor, *Classical Mechanics*, section 8.4.
    """
    if depends_on_time(of.value):
        message = (
            f"`effective_potential`: `{of.key}` contains the time or a prescribed function of the time, "
            "so it has no effective potential energy"
        )
        help_line = (
            "if a support has a constant acceleration A along x, describe the positions relative to the support, and "
            "add `potential: m*A*x`, with the horizontal position x of the mass m"
        )
        raise Rejected(Complaint("changes", message, help=help_line))
    constants = constants or _cyclic(of)
    left = _put_aside(of, constants, "effective_potential")
    rates = rates_by_momenta(of, constants) if constants else ()
    put_in = {v.symbol: v.value for v in rates}
    matter, energies = of.needed(Matter), energies_of(of)
    reduced = ReducedMatter((), (), tuple(q.symbol for q in left), whole=matter, rates=tuple(put_in.items()))
    still = dict.fromkeys([s for q in left for s in (q.rate, q.acceleration)], ZERO)
    letters = [each.symbol for each in constants]
    carried = Add(*(p * v for p, v in zip(letters, put_in.values(), strict=True)))
    whole = bound(carried - bound(explicit(of.value), put_in), still)

    def law(L: Expr, *both: Expr) -> Expr:
        n = len(constants)
        whole: Any = Terms(*(Factors(p, v) for p, v in zip(both[:n], both[n:], strict=True)), -L) if n else L
        for q in left:
            whole = At(whole, q.rate, ZERO)
        return whole if n else -whole

    def forces(found: Expr) -> tuple[Any, Any]:
        ours = [-slope(found, q.symbol) for q in left]
        theirs = [reduced.force_along(q.symbol) - reduced.inertia_along(q.symbol) for q in left]
        return ImmutableDenseMatrix(ours), bound(ImmutableDenseMatrix(theirs), still)

    def by_degree(found: Expr) -> tuple[Expr, Expr]:
        assert energies is not None
        kinetic, names = energies.kinetic.value, [q.rate for q in coordinates_of(of)]
        parts = part_of_degree(kinetic, names, 2) - part_of_degree(kinetic, names, 0)
        return found, bound(bound(parts, put_in), still) + energies.potential.value

    written = beside_potential(whole, of, letters)
    return establish(
        EFFECTIVE_POTENTIAL,
        scalar(symbol or free_letter("U_eff")),
        law,
        _inputs(of, constants, rates, put_in),
        lines=Lines(put_in=None, result=False, arranged=lambda _: written, after=kinetic_first(written, letters)),
        routes={**matter.named({"forces": forces}), **({"by_degree": by_degree} if energies is not None else {})},
        outcome="reduced" if constants else _without_constants(of),
        key=key,
        kind=of.step.kind,
        facts=[FromLagrangian(of), SeenWith(of, tuple(constants), reduced)],
    )


def _cyclic(of: Quantity) -> tuple[Quantity, ...]:
    """Return the momenta of all cyclic coordinates: L does not contain the coordinate, but contains its rate."""
    L = explicit(of.value)
    return tuple(conserved(of, q) for q in coordinates_of(of) if not L.has(q.symbol) and L.has(q.rate))


def _without_constants(of: Quantity) -> str:
    if energies_of(of) is None:
        return "given"
    return "driven" if _is_driven(of) else "unchanged"


def _is_driven(of: Quantity) -> bool:
    kinetic = explicit(of.needed(Energies).kinetic.value)
    return bool(tidied(bound(kinetic, {q.rate: ZERO for q in coordinates_of(of)})) != 0)
