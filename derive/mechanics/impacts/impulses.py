"""Impacts: the forces are so large, and act for so short a time, that positions stay fixed and only velocities jump.
Lagrange's equations, integrated over the short time, give the jump of each momentum, p - p_before = sum of J . dr/dq.
Finite forces do not contribute. The rates in the results are the rates just after the impact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Add, Expr, Integer, Mul, Symbol, diff, linsolve

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import Factors, Partial, Relation, Terms, explicit, rate, scalar
from derive.algebra.ranges import sign_within, strict_sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.answers.linear_equations import solved_for
from derive.mechanics.answers.substitution import put_in
from derive.mechanics.impacts import claims
from derive.mechanics.impacts.impact import Impact
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.model.dalembert import Matter
from derive.solving.presentation import presented
from derive.steps.claims import always_sign, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Quantity, is_zero
from derive.steps.subject import EVERYTHING, Subject

__all__ = ["energy_after", "meeting_condition", "momentum_jump", "rates_after", "work_of_impulses"]

ZERO = Integer(0)


MOMENTUM_JUMP = Rule(
    "impacts.momentum_jump",
    source=(
        "Goldstein, Poole, Safko, *Classical Mechanics*, derivations and exercises of chapter 2; Landau, "
        "Lifshitz, *Mechanics*, section 7"
    ),
    outcomes={"struck": claims.is_struck(True), "free": claims.is_struck(False)},
    evidence={"particles": ROUTE},
    named={"coordinate": claims.momentum_of},
)


def momentum_jump(impact: Impact, kinetic: Quantity, q: Coordinate, key: str | None = None) -> Quantity:
    """Jump of a momentum in an impact, p - p_before = sum of J . dr/dq with p = dT/dq_dot.

    impact    the system, its state and the impulses
    kinetic   the kinetic energy T of the system, J, from `kinetic_energy_of`
    q         a coordinate of the system

    Second route: p - p_before is the sum of m (v - v_before) . dr/dq over mass points. The right side is the derivative
    of the power J . v with respect to q_dot.
    Outcomes: struck (an impulse acts along q), free (no impulse acts along q).
    Errors: q is not a coordinate of the impact.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, derivations and exercises of chapter 2; Landau, Lifshitz,
    *Mechanics*, section 7.
    """
    symbol = q.symbol
    if symbol not in impact.moving:
        raise Rejected(Complaint("wrong-argument", f"nothing in this `Impact` moves with {symbol.name}"))
    matter = kinetic.needed(Matter)
    momentum = explicit(Partial(kinetic.value, q.rate))
    before = tidied(impact.earlier(momentum))
    shares = impact.shares(symbol)

    def law(T: Any) -> Relation:
        after = impact.shown_there(Partial(T, q.rate), momentum)
        right = Terms(*shares) if len(shares) > 1 else shares[0] if shares else ZERO
        return Relation(Terms(after, -before) if before != 0 else after, "=", right)

    def by_particles(found: Relation) -> tuple[Expr, Expr]:
        along = matter.momentum_along(symbol)
        changed = impact.read_again(along) - impact.read_again(along, rates=True)
        return explicit(found.left) - explicit(found.right), changed - diff(impact.power(), q.rate)

    return establish(
        MOMENTUM_JUMP,
        None,
        law,
        {"kinetic": kinetic},
        lines=Lines(put_in=None, arranged=lambda found: _jump(found, impact)),
        routes={"particles": by_particles},
        outcome="struck" if shares else "free",
        phrase_data=PhraseData(
            named={"coordinate": symbol},
            outcome_data={"slope": diff(impact.power(), q.rate), "at": tuple(impact.at.items())},
        ),
        key=key or f"jump_{symbol.name}",
        facts=[OfCoordinate(q), impact.described],
        scope=Scope(coordinates={m.letter: "momentum" for m in impact.meetings}, about=Subject(body=impact.system)),
    )


def _jump(found: Relation, impact: Impact) -> Relation:
    left, right = explicit(found.left).expand(), explicit(found.right)
    alone = Add(*(term for term in Add.make_args(left) if not term.has(*map(rate, impact.moving))))
    moved = by_rates(left - alone, impact.moving)
    return Relation(moved + by_terms(tidied(alone)) if alone != 0 else moved, "=", by_terms(tidied(right)))


MEETING_CONDITION = Rule(
    "impacts.meeting_condition",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 4 and 6",
    outcomes={
        "together": claims.restitution(0),
        "kept": claims.restitution(0),
        "elastic": claims.restitution(1),
        "rebound": claims.restitution(None),
    },
    evidence={"functions_of_time": CHECK},
    named={"impulse": claims.impulse_of_its_condition},
)


def meeting_condition(impact: Impact, number: int, key: str | None = None) -> Quantity:
    """Condition on the rates just after an impact, v = -e v_before. Here v is a component of the relative velocity of
    two places, or the rate of a constraint.

    impact   the system, its state and the collisions; e is the coefficient of restitution of the collision
    number   the index of the condition, from 0; the conditions of constraints come last

    Check: the same condition. Here v is computed from the places as functions of t, in which each coordinate is
    replaced by its Taylor series.
    Outcomes: together (e = 0), elastic (e = 1), rebound (any other e), kept (a constraint).
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapters 4 and 6.
    """
    meeting = impact.meetings[number]
    speed = meeting.speed(impact.moving)
    before = tidied(impact.earlier(speed))
    part = meeting.restitution

    def law() -> Relation:
        right = ZERO if part == 0 or before == 0 else Factors(-part, before) if part != 1 else -before
        return Relation(impact.shown_there(speed, explicit(speed)), "=", right)

    def by_time(found: Relation) -> tuple[Expr, Expr]:
        speed = meeting.speed_by_time(impact.moving)
        returned = meeting.given * impact.read_again(speed, rates=True)
        return explicit(found.left) - explicit(found.right), impact.read_again(speed) + returned

    return establish(
        MEETING_CONDITION,
        None,
        law,
        {},
        lines=Lines(
            put_in=None,
            arranged=lambda found: Relation(
                by_rates(explicit(found.left), impact.moving), "=", tidied(explicit(found.right))
            ),
        ),
        routes={"functions_of_time": by_time},
        outcome=meeting.what,
        phrase_data=PhraseData(
            named={"impulse": meeting.letter}, outcome_data={"restitution": part, "power": impact.power()}
        ),
        key=key or f"meeting_{number + 1}",
        scope=Scope(coordinates=impact.system.coordinates, about=Subject(body=impact.system)),
    )


def rates_after(impact: Impact, jumps: Sequence[Quantity], conditions: Sequence[Quantity]) -> tuple[Quantity, ...]:
    """Rates just after an impact, and the unknown impulses, from the jumps of the momenta.

    impact       the system, its state and the impulses
    jumps        the results of `momentum_jump`, one for each coordinate
    conditions   the results of `meeting_condition`, one for each unknown impulse

    Keys: x_dot_after for the coordinate x, and the symbol of each impulse.
    Check: as `solved_for`.
    Errors: a jump or a condition is missing.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, derivations and exercises of chapter 2.
    """
    count = len(impact.moving) + len(impact.meetings)
    if len(jumps) + len(conditions) != count:
        message = f"the unknowns of this impact need {count} equations, not {len(jumps) + len(conditions)}"
        raise Rejected(Complaint("wrong-argument", message, help="give a jump for each coordinate, and all conditions"))
    of = [jump.needed(OfCoordinate).coordinate for jump in jumps]
    letters = [each.letter for each in impact.meetings]
    keys = [*(f"{q.symbol.name}_dot_after" for q in of), *(letter.name for letter in letters)]
    return solved_for([*jumps, *conditions], *(q.rate for q in of), *letters, keys=keys)


def energy_after(
    impact: Impact, kinetic: Quantity, after: Sequence[Quantity], key: str = "kinetic_energy_after"
) -> Quantity:
    """Kinetic energy just after an impact: the coordinates and the rates just after the impact are substituted.

    impact    the system, its state and the impulses
    kinetic   the kinetic energy T of the system, J
    after     the rates just after the impact, from `rates_after`

    Check: as `put_in`.
    Source: none needed: substitution.
    """
    held = explicit(kinetic.value).free_symbols
    rates = [q for q in after if q.symbol in held]
    places = {q: value for q, value in impact.at.items() if q in held and q != value}
    return put_in(kinetic, *rates, *([places] if places else []), key=key, symbol=f"{kinetic.symbol}_after")


WORK_OF_IMPULSES = Rule(
    "impacts.work_of_impulses",
    source="Routh, *Dynamics of a System of Rigid Bodies*, elementary part, section 346",
    outcomes={"zero": vanishes, "lost": always_sign(-1), "gained": always_sign(1), "generic": always_sign(None)},
    evidence={"impulses": ROUTE},
)


def work_of_impulses(
    impact: Impact, energy: Quantity, after: Sequence[Quantity], symbol: str = "W", key: str = "work_of_impulses"
) -> Quantity:
    """Work of the impulses in an impact, the change of the kinetic energy, W = T - T_before.

    impact   the system, its state and the impulses
    energy   the kinetic energy T just after the impact, J, from `energy_after`
    after    the rates just after the impact and the unknown impulses, from `rates_after`

    Second route: the work of each impulse is J . (v + v_before)/2, where v is the velocity of its point of application.
    Outcomes: zero (T does not change), lost (T decreases), gained (T increases), generic (the sign is unknown).
    Source: Routh, *Dynamics of a System of Rigid Bodies*, elementary part, section 346.
    """
    found = {q.symbol: explicit(q.value) for q in after}
    rates = {rate(q): found[rate(q)] for q in impact.moving}
    found |= _impulses(impact, rates, [each.letter for each in impact.meetings if each.letter not in found])
    before = tidied(impact.earlier(impact.system.matter.kinetic_energy()))

    def by_impulses(work: Expr) -> tuple[Expr, Expr]:
        power = impact.power()
        mean = (power.xreplace(rates) + impact.read_again(power, rates=True)) / 2
        return work, mean.xreplace({each.letter: found[each.letter] for each in impact.meetings})

    return establish(
        WORK_OF_IMPULSES,
        scalar(symbol),
        lambda T: Terms(T, -before) if before != 0 else T,
        {"energy": energy},
        lines=Lines(arranged=lambda value: _with_its_sign(presented(explicit(value)))),
        routes={"impulses": by_impulses},
        outcome=_gain,
        key=key,
        kind="energy",
        parents=list(after),
        scope=Scope(differ=EVERYTHING),
    )


def _impulses(impact: Impact, rates: Mapping[Symbol, Expr], wanted: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Return the wanted impulses: they follow from the momenta of the mass points just before and just after the
    impact."""
    if not wanted:
        return {}
    matter, power = impact.system.matter, impact.power()
    left = []
    for q in impact.moving:
        along = matter.momentum_along(q)
        changed = impact.read_again(along).xreplace(dict(rates)) - impact.read_again(along, rates=True)
        left.append(changed - diff(power, rate(q)))
    (solution,) = linsolve(left, *wanted)
    return dict(zip(wanted, solution, strict=True))


def _with_its_sign(value: Expr) -> Expr:
    """Write the minus sign of a negative factor in front of the product, so that the loss is visible:
    -(1 - e^2) m v^2/2, not (e^2 - 1) m v^2/2."""
    factors = Mul.make_args(value)
    turned = [f for f in factors if f.is_Add and sign_within(f) == -1]
    if len(turned) != 1 or len(factors) < 3:
        return value
    return Mul(-1, *(f for f in factors if f is not turned[0]), Add(*(-term for term in turned[0].args)))


def _gain(value: Expr) -> str:
    value = tidied(value)
    if is_zero(value):
        return "zero"
    return {-1: "lost", 1: "gained", None: "generic"}[strict_sign_within(value)]
