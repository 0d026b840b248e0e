"""The agreement of Newton's laws with Lagrange's equations for the same motion."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Add, Integer

from derive.algebra.expressions import Relation, explicit
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.newton import claims
from derive.mechanics.newton.by_lagrange import MovedAlone
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Quantity

__all__ = ["agreement_of_laws"]


AGREEMENT_OF_LAWS = Rule(
    "newton.agreement_of_laws",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4",
    outcomes={"again": claims.same_as_one, "combined": claims.same_as_several},
    evidence={"virtual_work": ROUTE},
)


def agreement_of_laws(newton: Quantity, lagrange: Sequence[Quantity], key: str | None = None) -> Quantity:
    """Newton's law of one body, derived again as a sum of Lagrange's equations. Each of these equations is multiplied
    by the change of its coordinate in a displacement in which only this body moves.

    newton    the law from `second_law` or `torque_law`
    lagrange  Lagrange's equations, one for each coordinate

    Second route: the sum of Lagrange's equations, which come from T and U, equals the law, which comes from forces. If
    the sum has only one term, the result is this Lagrange equation; otherwise the result is the law.
    Outcomes: again (one of Lagrange's equations and the law are the same equation, up to a factor), combined (a sum of
    several of Lagrange's equations is the law).
    Errors: the equation of a coordinate is missing.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.4.
    """
    q: Coordinate = newton.needed(OfCoordinate).coordinate
    changes = dict(newton.needed(MovedAlone).changes)
    by_coordinate = {each.needed(OfCoordinate).coordinate.symbol: each for each in lagrange}
    missing = [s for s in changes if s not in by_coordinate]
    if missing:
        message = f"`agreement_of_laws` needs Lagrange's equation for {missing[0].name}"
        raise Rejected(Complaint("wrong-argument", message))
    used = {f"lagrange_{i}": by_coordinate[s] for i, s in enumerate(changes, 1)}

    shown = (used["lagrange_1"] if len(used) == 1 else newton).step.chain[-1].expr

    def by_virtual_work(_: Relation) -> tuple[Relation, Relation]:
        residuals = (explicit(by_coordinate[s].value).residual * change for s, change in changes.items())
        return newton.value, Relation(Add(*residuals), "=", Integer(0))

    return establish(
        AGREEMENT_OF_LAWS,
        None,
        lambda *_: shown,
        {"newton": newton, **used},
        lines=Lines(put_in=None, arranged=explicit, result=False),
        routes={"virtual_work": by_virtual_work},
        outcome="again" if len(used) == 1 else "combined",
        key=key or f"agreement_{q.symbol.name}",
        phrase_data=PhraseData(outcome_data={"count": len(changes)}),
        facts=[OfCoordinate(q)],
        scope=Scope(differ=("body", "mass", "point", "axis")),
    )
