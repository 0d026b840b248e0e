"""The equation for rates from a conserved momentum with a known value: I_z (psi_dot + phi_dot cos theta) = I_z S."""

from __future__ import annotations

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, diff

from derive.algebra.expressions import Relation, bound, explicit, rate
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import OfCoordinate, by_functions_of_time
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.facts import KeptMomentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import require_constant
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Form, Level, Quantity

__all__ = ["value_kept"]


VALUE_KEPT = Rule(
    "lagrange.value_kept",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6",
    evidence={"along_the_motion": ROUTE, "given_along_the_motion": ROUTE},
    statements=[claims.of_its_coordinate],
)


def value_kept(momentum: Quantity, value: Expr, matter: Matter, key: str) -> Quantity:
    """A conserved momentum set equal to its value, p_q = c: a differential equation of first order.

    momentum   the result of `conserved`
    value      the initial value c of the momentum, a premise
    matter     the mass points and forces of the system

    Second route: p_q is the sum of m v . dr/dq over the mass points, and of e A . dr/dq over charges e in magnetic
    fields. The time derivative of p_q as a function of t is the sum of (m a - F) . dr/dq, which vanishes by
    d'Alembert's principle.
    Errors: the value is not constant; the momentum is not linear in the rate of its coordinate.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.6.
    """
    require_constant("conserved", "value", value)
    q = momentum.needed(OfCoordinate).coordinate
    moving, p = list(momentum.coordinates), explicit(momentum.value).expand()
    inertia = tidied(diff(p, q.rate))
    if inertia == 0 or inertia.has(q.rate):
        raise Rejected(Complaint("wrong-argument", f"`conserved`: `{momentum.key}` is not linear in {q.rate.name}"))
    common = common_factor([*Add.make_args(p), explicit(value)])
    common = common if common.is_positive else Integer(1)
    rates = {rate(s) for s in moving}
    terms = Add.make_args((p / common).expand())
    with_rates = Add(*(term for term in terms if term.free_symbols & rates))
    found = Relation(with_rates, "=", tidied((value - p) / common + with_rates))
    turning = tidied((value - bound(p, {q.rate: Integer(0)})) / inertia)

    def along_the_motion(here: Relation) -> tuple[ImmutableDenseMatrix, ImmutableDenseMatrix]:
        left, right = (common * side for side in here.sides)
        at_work = matter.inertia_along(q.symbol) - matter.force_along(q.symbol)
        marked = {"=": Integer(0)}.get(here.operator, Integer(1))
        changing = by_functions_of_time(left - right, moving)
        ours = [left - right, changing, marked]
        return ImmutableDenseMatrix(ours), ImmutableDenseMatrix([matter.momentum_along(q.symbol) - value, at_work, 0])

    return establish(
        VALUE_KEPT,
        None,
        lambda p, v: Relation(p, "=", v),
        {"momentum": momentum, "value": value},
        lines=Lines(
            put_in=None,
            result=False,
            arranged=lambda _: found,
            law=Level.FULL,
            after=[Form(found, "divided", nonzero=(common,))],
        ),
        routes=matter.named({"along_the_motion": along_the_motion}),
        phrase_data=PhraseData(outcome_data={"coordinate": q.symbol}),
        key=key,
        facts=[OfCoordinate(q), KeptMomentum(momentum.symbol, explicit(value), q.symbol, turning)],
    )
