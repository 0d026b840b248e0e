"""Lagrange's equations: the Lagrangian, and the equation of motion for each coordinate.

Second routes start from positions and forces (`derive.mechanics.model.dalembert`). A momentum is the sum of m v . dr/dq
over mass points, plus the sum of e A . dr/dq over charges e in magnetic fields. An equation of motion follows from
d'Alembert's principle.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from sympy import Add, Expr, Integer, Mul, Rational, Symbol, igcd, ilcm

from derive.algebra.collect import by_accelerations, by_rates, with_constants_in_front
from derive.algebra.expressions import Partial, Relation, Terms, TimeRate, explicit, rate, scalar
from derive.algebra.length import length
from derive.algebra.ranges import sign_within
from derive.algebra.taylor import slope
from derive.algebra.tidy import common_factor
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, by_functions_of_time, required
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.applied_forces import ActedOn, acting, difference, forced_equation, with_derivatives
from derive.mechanics.lagrange.energies import kinetic_energy_of, magnetic_term_of, potential_energy_of
from derive.mechanics.lagrange.facts import Energies, FromLagrangian, Varied
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.model.system import System
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.level import Level, Manner
from derive.steps.record import changes, free_letter
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.step import Form, Quantity, compared_with, is_zero

__all__ = [
    "equation_of_motion",
    "equations_of_motion",
    "generalized_force",
    "generalized_momentum",
    "lagrangian",
    "momentum_rate",
]

ZERO = Integer(0)


LAGRANGIAN = Rule(
    "lagrange.lagrangian",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 2.7",
    outcomes={"generic": claims.lagrangian_generic, "in_field": claims.lagrangian_in_field},
    evidence={"energy": CHECK, "mass_points": ROUTE},
    statements=[claims.difference],
)


def lagrangian(system: System, symbol: str | None = None, key: str = "lagrangian") -> Quantity:
    """Lagrangian, L = T - U; for charges in magnetic fields, L = T - U + sum of q v . A.

    system   particles and bodies, with the forces on them

    The index of the symbol is also the index of the energies: T_2 and U_2 for "L_2".
    Second route: if a magnetic field acts, or if a position or U depends explicitly on the time, L + U - sum of q v . A
    is the kinetic energy of the mass points.
    Check: in any other case, the sum of q_dot dL/dq_dot, minus L, is the energy T + U.
    Outcomes: generic, in_field (a charge is in a magnetic field).
    Errors: the argument is not a system.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 2.7.
    """
    if not isinstance(system, System):
        raise Rejected(Complaint("wrong-argument", "`lagrangian` needs a `System`"))
    symbol = symbol or free_letter("L")
    base, _, index = symbol.partition("_")
    own = f"_{index}" if index else ""
    letters = [free_letter(f"{letter}{own}") for letter in "TU"]
    kinetic = kinetic_energy_of(system, letters[0], f"kinetic_energy{own}")
    potential = potential_energy_of(system, letters[1], f"potential_energy{own}")
    moving = {**kinetic.coordinates, **potential.coordinates}

    matter = (kinetic.fact(Matter) or Matter()) + (potential.fact(Matter) or Matter())
    magnetic = None
    if system.matter.fields:
        magnetic = magnetic_term_of(system, f"{base}_B{own}", f"magnetic_term{own}")
        matter += magnetic.needed(Matter)
    beside = {"magnetic": magnetic} if magnetic is not None else {}

    def energy(found: Expr) -> tuple[Expr, Expr]:
        carried = Add(*(rate(q) * slope(found, rate(q)) for q in moving))
        return carried - found, kinetic.value + potential.value

    def of_mass_points(found: Expr) -> tuple[Expr, Expr]:
        return found + potential.value - matter.energy_in_fields(), matter.kinetic_energy()

    driven = matter.is_driven or bool(beside) or changes(potential.value) is not None

    return establish(
        LAGRANGIAN,
        scalar(symbol),
        lambda t, u, *b: _side_by_side(*Add.make_args(t), *_subtracted(u, moving), *b),
        {"kinetic": kinetic, "potential": potential, **beside},
        lines=Lines(put_in=Level.BRIEF, result=False, arranged=explicit),
        routes={"mass_points": of_mass_points} if driven else {"energy": energy},
        key=key,
        kind="energy",
        outcome="in_field" if beside else "generic",
        facts=[matter, Energies(kinetic, potential, magnetic), *acting(kinetic, potential)],
    )


def _subtracted(energy: Expr, moving: Collection[Symbol]) -> list[Expr]:
    """Return the terms of -U for a potential energy U. In a term that is proportional to a coordinate, a difference
    takes the minus sign: -(M - m) g x becomes (m - M) g x."""
    terms = sorted(Add.make_args(energy), key=lambda term: not term.free_symbols & {*moving})
    return [_turned(term, moving) for term in terms]


def _turned(term: Expr, moving: Collection[Symbol]) -> Expr:
    factors = list(Mul.make_args(term))
    for i, factor in enumerate(factors if {*factors} & {*moving} else []):
        is_difference = factor.is_Add and any(part.could_extract_minus_sign() for part in factor.args)
        if is_difference and not factor.free_symbols & {*moving}:
            return Mul(*factors[:i], Add(*(-part for part in factor.args)), *factors[i + 1 :])
    return -term


def _side_by_side(*terms: Expr) -> Expr:
    """Return the sum with its terms unchanged and in order, without terms that are zero."""
    present = [term for term in terms if term != 0]
    return Terms(*present) if len(present) > 1 else Add(*present)


def coordinates_of(of: Quantity) -> list[Coordinate]:
    """Return the coordinates of the equations of motion of a Lagrangian."""
    matter = of.needed(Matter)
    return [Coordinate(q, kind) for q, kind in of.coordinates.items() if q in matter.coordinates]


EQUATION_OF_MOTION = Rule(
    "lagrange.equation_of_motion",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4",
    outcomes={"generic": claims.not_cyclic, "cyclic": claims.cyclic},
    evidence={"virtual_work": ROUTE, "given_virtual_work": ROUTE, "energy_identity": ROUTE},
    named={"coordinate": claims.equation_of},
    shown=Shown(result_again=Level.STANDARD),
)


def equation_of_motion(
    of: Quantity, q: Coordinate, key: str = "equation_of_motion", derivatives: bool = True
) -> Quantity:
    """Lagrange's equation, d/dt dL/dq_dot - dL/dq = 0; with constraints or forces outside L, see `forced_equation`.

    of            the Lagrangian, J
    q             a coordinate of this Lagrangian
    derivatives   whether steps derive the force dL/dq, the momentum dL/dq_dot and the rate of the momentum

    Second route: d'Alembert's principle, sum of (m a - F) . dr/dq = 0, from positions and forces. If the
    problem gives L itself, the energy identity is a further route.
    Outcomes: generic, cyclic (L does not contain q, so the momentum of q is constant).
    Errors: q is not a coordinate of L.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    required(of.coordinates, q, "equation_of_motion", of)
    matter = of.needed(Matter)
    moving = list(of.coordinates)
    found: list[Quantity] = []
    if derivatives:
        momentum = generalized_momentum(of, q)
        found = [generalized_force(of, q), momentum, momentum_rate(momentum, q)]
    if of.fact(ActedOn) or of.fact(Constrained):
        return forced_equation(of, q, found, key)

    def by_virtual_work() -> Relation:
        return Relation(matter.inertia_along(q.symbol) - matter.force_along(q.symbol), "=", 0)

    whole = explicit(of.value)
    gathered = by_accelerations(
        explicit(
            found[2].value - found[0].value
            if found
            else TimeRate(slope(whole, q.rate), *moving) - slope(whole, q.symbol)
        ),
        moving,
    )
    if found and of.fact(Varied) is not None:
        terms = explicit(found[2].value) - explicit(found[0].value)
        gathered = min((gathered, terms), key=length)
    alone = len(coordinates_of(of)) == 1  # in several equations, common factors remain to show symmetry
    left = _without_common_factor(gathered, moving) if alone else gathered

    return establish(
        EQUATION_OF_MOTION,
        None,
        lambda L: Relation(Terms(TimeRate(Partial(L, q.rate), *moving), -Partial(L, q.symbol)), "=", 0),
        {"lagrangian": of},
        lines=Lines(
            between=[
                *with_derivatives(found, Integer(0), moving),
                *(
                    Form(Relation(difference(changing.value, force.value), "=", 0), "put_in", Level.FULL)
                    for force, _, changing in ([found] if found else [])
                ),
                Form(Relation(gathered, "=", 0), "result"),
            ],
            put_in=None,
            arranged=lambda _: Relation(left, "=", 0),
        ),
        routes=matter.named({"virtual_work": compared_with(by_virtual_work)}) | matter.further_routes(q.symbol),
        outcome="cyclic" if is_zero(slope(explicit(of.value), q.symbol)) else "generic",
        phrase_data=PhraseData(named={"coordinate": q.symbol}),
        key=key,
        parents=found,
        facts=[FromLagrangian(of), OfCoordinate(q), matter],
    )


def _without_common_factor(left: Expr, moving: Sequence[Symbol]) -> Expr:
    """Divide by common positive factors: m l^2 theta_ddot + m g l sin(theta) becomes l theta_ddot + g sin(theta).

    Factors that contain a coordinate remain.
    """
    terms = Add.make_args(left)
    factors = Mul.make_args(common_factor(list(terms)))
    constant = [f for f in factors if sign_within(f) == 1 and not f.has(*moving) and not f.as_base_exp()[1].is_negative]
    common = Mul(*(f for f in constant if not f.is_number))
    divided = [part for term in terms for part in Add.make_args(_divided(term, common))]
    forms = [Add(*each, evaluate=False) for each in (_in_whole_numbers(divided), divided)]
    return min((*forms, left), key=length)


def _in_whole_numbers(terms: Sequence[Expr]) -> list[Expr]:
    """Make all numeric factors integers: 2 l theta_ddot + 3 g sin(theta), not l theta_ddot/3 + g sin(theta)/2.

    In a sum such as I + M a^2/4, only some terms have a denominator. If a factor is such a sum, and a coefficient is a
    fraction, return the terms unchanged.
    """
    apart: list[tuple[Expr, list[Expr]]] = []
    for term in terms:
        parts = [
            each.primitive() if each.is_Add and not _has_some_fractions(each) else each.as_coeff_Mul()
            for each in Mul.make_args(term)
        ]
        apart.append((Mul(*(number for number, _ in parts)), [rest for _, rest in parts if rest != 1]))
    below = ilcm(1, 1, *(number.q for number, _ in apart))
    shared = Rational(igcd(0, *(int(number * below) for number, _ in apart)), below)
    if below > 1 and any(map(_has_some_fractions, (f for _, factors in apart for f in factors))):
        return list(terms)
    return [_product(number / shared, *factors) for number, factors in apart]


def _has_some_fractions(factor: Expr) -> bool:
    """Whether some terms of a sum have a numeric denominator and other terms do not."""
    below = {term.as_coeff_Mul()[0].q > 1 for term in Add.make_args(factor)} if factor.is_Add else set()
    return len(below) == 2


def _product(*factors: Expr) -> Expr:
    written = any(each.is_Add for each in factors)
    return Mul(*(each for each in factors if each != 1 or not written), evaluate=not written)


def _divided(term: Expr, common: Expr) -> Expr:
    """Divide a term by the factors of `common` one after another, so that brackets remain."""
    for factor in Mul.make_args(common):
        term = term / factor
    return term


def equations_of_motion(of: Quantity, derivatives: bool = True) -> tuple[Quantity, ...]:
    """Lagrange's equations, one for each coordinate, d/dt dL/dq_dot - dL/dq = 0.

    of            the Lagrangian, J
    derivatives   whether steps derive dL/dq, dL/dq_dot and the rate of dL/dq_dot

    Keys: motion_x for the coordinate x.
    Second route: as `equation_of_motion`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    return tuple(equation_of_motion(of, q, f"motion_{q.symbol.name}", derivatives) for q in coordinates_of(of))


def _key_of(lagrangian: Quantity, name: str) -> str:
    """Return the key of a step: the name, or `<key of the Lagrangian>_<name>` if the Lagrangian does not have its
    default key."""
    own = getattr(lagrangian.subject.body, "called", "").replace(" ", "_")
    plain = f"{own}_lagrangian" if own else "lagrangian"
    return name if lagrangian.key == plain else f"{lagrangian.key}_{name}"


GENERALIZED_FORCE = Rule(
    "lagrange.generalized_force",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"virtual_work": ROUTE, "given_virtual_work": CHECK},
    statements=[claims.by_its_coordinate],
    named={"coordinate": claims.differentiated_by},
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def _by_velocities(value: Expr, of: Quantity) -> Expr:
    return with_constants_in_front(by_rates(value, list(of.coordinates)), list(of.coordinates))


def generalized_force(of: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Generalized force of the Lagrangian, dL/dq.

    of   the Lagrangian, J
    q    a coordinate of this Lagrangian

    Second route: the sum of F . dr/dq over the forces in L, and of m v . d(dr/dq)/dt over the mass points. For charges
    e in magnetic fields, the time derivative of the sum of e A . dr/dq is added.
    Check: for a given L, the first-order change of L if q changes.
    Outcomes: generic, zero (L does not contain q).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    matter = of.needed(Matter)
    return establish(
        GENERALIZED_FORCE,
        Partial(of.symbol, q.symbol),
        lambda L: Partial(L, q.symbol),
        {"lagrangian": of},
        lines=Lines(put_in=None, law=Level.FULL, arranged=lambda value: _by_velocities(value, of)),
        routes=matter.named(
            {
                "virtual_work": compared_with(
                    lambda: (
                        matter.force_along(q.symbol)
                        - matter.other_force_along(q.symbol)
                        + matter.turning_along(q.symbol)
                    )
                ),
            }
        ),
        outcome=lambda value: "zero" if value == 0 else "generic",
        phrase_data=PhraseData(named={"coordinate": q.symbol}),
        key=key or _key_of(of, f"force_{q.symbol.name}"),
    )


GENERALIZED_MOMENTUM = Rule(
    "lagrange.generalized_momentum",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6",
    evidence={"along_the_motion": ROUTE, "given_along_the_motion": CHECK},
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def generalized_momentum(of: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Generalized momentum, p = dL/dq_dot.

    of   the Lagrangian, J
    q    a coordinate of this Lagrangian

    Second route: the sum of m v . dr/dq over the mass points, and of e A . dr/dq over charges e in magnetic fields.
    Check: for a given L, the first-order change of L if q_dot changes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6.
    """
    matter = of.needed(Matter)
    return establish(
        GENERALIZED_MOMENTUM,
        Partial(of.symbol, q.rate),
        lambda L: Partial(L, q.rate),
        {"lagrangian": of},
        lines=Lines(put_in=None, law=Level.FULL, arranged=lambda value: _by_velocities(value, of)),
        routes=matter.named({"along_the_motion": compared_with(lambda: matter.momentum_along(q.symbol))}),
        key=key or _key_of(of, f"momentum_{q.symbol.name}"),
        facts=[FromLagrangian(of), OfCoordinate(q)],
    )


MOMENTUM_RATE = Rule(
    "lagrange.momentum_rate",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4",
    evidence={"functions_of_time": CHECK},
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def momentum_rate(momentum: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Rate of a generalized momentum, dp/dt, by the chain rule.

    momentum   the generalized momentum dL/dq_dot
    q          the coordinate of the momentum

    Check: replace each coordinate by its Taylor series in t, and differentiate with respect to t.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    moving = list(momentum.coordinates)
    return establish(
        MOMENTUM_RATE,
        TimeRate(momentum.symbol, *moving),
        lambda p: TimeRate(p, *moving),
        {"momentum": momentum},
        lines=Lines(put_in=None, law=Level.FULL, arranged=lambda value: by_accelerations(value, moving)),
        routes={"functions_of_time": compared_with(lambda: by_functions_of_time(momentum.value, moving))},
        key=key or f"{momentum.key}_rate",
    )
