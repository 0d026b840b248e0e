"""Expansion of an equation in powers of a small quantity: a symbol is small, large, or near a value.
The coordinates, rates and accelerations are not small: the equation is not expanded in them.
"""

from __future__ import annotations

from typing import Any

from sympy import Function, Integer, Rational, oo
from sympy.core.symbol import Str

from derive.algebra.expansion import small_of, tidied_terms
from derive.algebra.expressions import TIME, Relation, depends_on_time, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.answers import claims
from derive.mechanics.answers.substitution import arranged
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.solving.leading import expansion_of, rest_vanishes
from derive.solving.unknowns import coordinates_of, letter_of, residual_of, unknown_of
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Quantity, approximations_among, is_zero

__all__ = ["equation_in_limit"]


EQUATION_IN_LIMIT = Rule(
    "answers.equation_in_limit",
    source="Taylor, *Classical Mechanics*, sections 9.8 and 9.9 (to the first order in the rate of the Earth)",
    outcomes={
        "small": claims.leading(0),
        "large": claims.leading(oo, -oo),
        "near": claims.leading(),
        "first_order": claims.to_order(1),
        "to_order": claims.to_order(None),
        "exact": claims.exact,
    },
    evidence={"numbers": CHECK},
    named={
        "small": claims.small_there,
        "place": claims.near_that,
        "power": claims.highest_power,
        "short": claims.for_short_times,
    },
)


def equation_in_limit(
    equation: Quantity, letter: Any, to: Any = 0, order: int | None = None, key: str | None = None
) -> Quantity:
    """Expansion of an equation f = 0 where a letter is small, large or near a value: f_0 + f_1 e + ... = 0. The small
    quantity e is x, 1/x, -1/x or x - a, where x is the letter and a is the value that it is near.

    equation   an equation, such as an equation of motion
    letter     a constant that is small, large or near a value
    to         0 if the letter is small, SymPy's `oo` or `-oo` if it is large, else the value that it is near
    order      the highest power of the small quantity that is kept; by default only the leading terms

    If a function of a small letter and the time is expanded, such as cos(Omega t), the result is valid only for short
    times. The sentence of the step says so.
    Check: numerically, the terms that are left out, divided by the highest power that is kept, go to zero with the
    small quantity.
    Outcomes: small, large, near (only the leading terms); first_order, to_order; exact (nothing is left out).
    Errors: the equation does not contain the letter; the letter changes with the time; the equation has no such
    expansion; the expansion begins beyond the requested order.
    Source: Taylor, *Classical Mechanics*, sections 9.8 and 9.9 (to the first order in the rate of the Earth).
    """
    left = residual_of("equation_in_limit", equation)
    x = letter_of(unknown_of("equation_in_limit", letter))
    if x not in left.free_symbols:
        message = f"`equation_in_limit`: `{equation.key}` does not contain {x.name}"
        raise Rejected(Complaint("nothing-to-put-in", message))
    if x == TIME or any(x.name in (q.name, f"{q.name}_dot", f"{q.name}_ddot") for q in coordinates_of(equation)):
        message = f"`equation_in_limit`: {x.name} changes in the motion, so it does not stay near one value"
        raise Rejected(Complaint("changes", message, help="`linearised` gives small motions about equilibrium"))
    place = explicit(to.value if isinstance(to, Quantity) else to)
    series = expansion_of(equation, left, x, place, order)
    kept = tidied_terms(series, x, place)
    found = arranged(Relation(kept, "=", Integer(0)), list(coordinates_of(equation)))
    power = Rational(order) if order is not None else max(series, default=Rational(0))
    share = _ratio(found, kept)
    small = small_of(x, place)
    told = {"small": small, "power": power}
    if place not in (oo, -oo):
        told["place"] = place
    if place == 0 and any(f.has(x) and depends_on_time(f) for f in left.atoms(Function)):
        told["short"] = 1 / x  # for small Omega, sin(Omega t) is small only at short times
    return establish(
        EQUATION_IN_LIMIT,
        None,
        lambda *_: found,
        {"equation": equation, "letter": x},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"numbers": lambda result: rest_vanishes(left, explicit(result).residual * share, x, place, power)},
        outcome=_sort_of(place, order, exact=is_zero(left - kept)),
        phrase_data=PhraseData(
            named=told,
            outcome_data={"value": left, "kept": kept, "to": place, "order": Integer(-1 if order is None else order)},
        ),
        key=key or f"{equation.key}_limit",
        facts=[fact] if (fact := equation.fact(OfCoordinate)) is not None else [],
        parents=approximations_among(to),
        scope=Scope() if is_zero(left - kept) else Scope(approximates=Str(equation.key)),
    )


def _ratio(found: Relation, kept: Any) -> Any:
    """Return the factor by which an equation was divided when it was arranged."""
    return tidied(kept / explicit(found).residual)


def _sort_of(place: Any, order: int | None, exact: bool) -> str:
    if exact:
        return "exact"
    if order is not None:
        return "first_order" if order == 1 else "to_order"
    return "small" if place == 0 else "large" if place in (oo, -oo) else "near"
