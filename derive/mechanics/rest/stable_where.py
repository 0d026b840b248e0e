"""Find the values of a symbol for which an equilibrium is stable. A higher order of the energy decides whether the
value on the boundary is one of them.
"""

from __future__ import annotations

from itertools import islice
from typing import Any

from sympy import Dummy, ImmutableDenseMatrix, Integer, Rational

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation, explicit
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.rest import claims
from derive.mechanics.rest.facts import StableWhere
from derive.solving.relations import without_square
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import holds, sign_for_all
from derive.steps.step import Form, Level, Quantity

__all__ = ["stable_where"]

TRIALS = 3
TURNED = {">": "<", "<": ">"}


STABLE_WHERE = Rule(
    "rest.stable_where",
    source="Taylor, *Classical Mechanics*, section 4.6",
    outcomes={
        "with_border": claims.bordered("stable"),
        "without_border": claims.bordered("unstable"),
        "open": claims.bordered(None),
    },
    evidence={"beside": CHECK, "energies": CHECK},
)


def stable_where(of: Quantity, key: str = "condition_of_stability") -> Quantity:
    """Condition under which an equilibrium is stable: S > S_0, or S >= S_0 if S = S_0 is known to be stable; or the
    same with < and <=.

    of   a result of `stability` that depends on a condition on the symbols

    Check: numerically, the energy has a minimum at the equilibrium if and only if the condition holds. If a higher
    order decides on the boundary, the condition is also compared, above and below the boundary, with the sign of the
    second derivative.
    Outcomes: with_border, without_border, open (no order decides at the boundary).
    Errors: the stability does not depend on a condition, or depends on a condition for several coordinates.
    Source: Taylor, *Classical Mechanics*, section 4.6.
    """
    known = of.fact(StableWhere)
    if known is None:
        message = f"`stable_where`: `{of.key}` has no condition for stability in one coordinate"
        raise Rejected(Complaint("no-condition", message, help="`stability` states whether the equilibrium is stable"))
    left, right = known.condition.sides
    squared = Relation(left, known.condition.operator + ("=" if known.stable_there else ""), right)
    result = without_square(squared)
    border = known.border if known.border is not None and result.left == known.border.left else None

    def beside(found: Relation) -> tuple[Any, Any]:
        """Compare the relation, above and below its boundary, with the sign of the second derivative."""
        u = Dummy("u", positive=True)
        says, is_so = [Integer(1)], [Integer(1)]
        for side in (1, -1) if border is not None else ():
            there = found.right * (1 + u) ** side
            sign = sign_for_all(tidied(explicit(of.value).subs(found.left, there)))
            says.append(Integer(holds(side, found.operator)))
            is_so.append(Integer(int(sign == 1)) if sign is not None else Integer(7))
        return ImmutableDenseMatrix(says), ImmutableDenseMatrix(is_so)

    return establish(
        STABLE_WHERE,
        None,
        lambda _: squared,
        {"stability": of},
        lines=Lines(law=Level.FULL, put_in=None, arranged=lambda _: result, after=[Form(result, "root")], result=False),
        routes={"beside": beside, "energies": lambda found: _by_energies(found, known, border)},
        outcome="open" if known.stable_there is None else "with_border" if known.stable_there else "without_border",
        phrase_data=PhraseData(
            outcome_data={
                "coordinates": (known.coordinate,),
                "place": (known.place,),
                "potential_here": known.energy,
                **({"at_border": known.border} if known.border is not None else {}),
            }
        ),
        key=key,
    )


def _by_energies(found: Relation, known: StableWhere, border: Relation | None) -> Verdict:
    """Check numerically that the energy has a minimum at the equilibrium if and only if the relation holds."""
    letters = (letters_of(known.energy) | letters_of(found.residual)) - {known.coordinate}
    seen = 0
    for point in islice(points(letters, seed_of(known.energy)), 60):
        try:
            cases = [point]
            if border is not None:
                bound = value_at(found.right, point)
                cases = [{**point, found.left: bound * f} for f in (Rational(5, 4), Rational(4, 5))]
            for case in cases:
                is_true = holds(value_at(found.residual, case), found.operator)
                if is_true != bool(known.lifted(case) > 0):
                    where = tuple((str(s), str(x)) for s, x in case.items())
                    return Verdict(Grade.REFUTED, "the energy near the equilibrium contradicts the condition", where)
        except (Undefined, NoNumber, TypeError):
            continue
        seen += 1
        if seen == TRIALS:
            break
    return Verdict(Grade.SAMPLED, f"{seen} points") if seen else Verdict(Grade.REFUTED, "nothing could be tried")
