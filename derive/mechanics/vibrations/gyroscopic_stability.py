"""Stability of an equilibrium by its small motions, with gyroscopic forces: tops, charges, rotating frames.
Gyroscopic forces may stabilise an equilibrium that is not a minimum of the potential energy: all roots omega of
det(K + i omega G - omega^2 M) must be real and different.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Add, Expr, Integer, Mul, Poly, Symbol, cancel, discriminant, factor

from derive.algebra.expressions import Relation, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear
from derive.mechanics.vibrations.gyroscopic import (
    TurningModes,
    in_quadrature,
    of_cosines_and_sines,
    outcome_data,
    require_turning,
)
from derive.solving.gyroscopic import GyroscopicPencil, Part
from derive.solving.relations import border_of, positive
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity, is_zero
from derive.witness.facts import Rest

__all__ = ["linear_stability"]

ZERO = Integer(0)
LARGEST = 200  # operations of a condition that is factored


def linear_stability(
    linear: Sequence[Quantity], letter: Expr | None = None, key: str = "stability"
) -> Quantity | tuple[Quantity, ...]:
    """Stability of an equilibrium with gyroscopic forces, linear in the rates: all omega^2 real, positive, different.

    linear   the equations, as `linearised` yields them together
    letter   the letter that a condition is solved for; by default one that occurs only as a square, if any
    Gyroscopic forces may stabilise an equilibrium that is not a minimum of the potential energy; drag, however small,
    makes it unstable again.
    Second route: on the boundary of the condition two roots of the determinant coincide, or one vanishes; the
    determinant is that of cosines and sines substituted in the equations.
    Outcomes: stable, unstable, depends; with several conditions first, further, and last for the last one.
    Errors: there is drag; the determinant does not factor.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 3.12 and 5.7.
    """
    together = linear[0].needed(Linear)
    require_turning("linear_stability", together)
    given = {s.name for each in (together.mass, together.turning, together.stiffness) for s in each.free_symbols}
    letter_of_frequency = scalar("omega" if "omega" not in given else "Omega")
    is_shared = key == "stability" and not is_zero(together.turning)  # then the modes share this equation
    modes = TurningModes(linear, together, letter_of_frequency, "" if is_shared else f"{key}_")
    pencil, characteristic = modes.pencil, modes.characteristic
    needs = _needed(pencil)
    if any(pencil.sign(need) == -1 for need, _ in needs):
        return _verdict(characteristic, together, "unstable", key)
    undecided = [(_open(need, pencil), part) for need, part in needs if pencil.sign(need) != 1]
    if not undecided:
        return _verdict(characteristic, together, "stable", key)
    conditions = [positive(need, *([letter] if isinstance(letter, Symbol) else [])) for need, _ in undecided]
    found = [
        _condition(characteristic, together, i, conditions, undecided, key if i == 0 else f"{key}_{i + 1}", linear)
        for i in range(len(conditions))
    ]
    return found[0] if len(found) == 1 else tuple(found)


def _needed(pencil: GyroscopicPencil) -> list[tuple[Expr, Part]]:
    """Return the expressions that must be positive, each with its factor of the determinant."""
    if pencil.is_minimum:
        return []
    free = [part for part in pencil.parts if part.is_free or len(part.coefficients) > 3 or part.times > 1]
    if free or any(_may_drift(part, pencil) for part in pencil.parts):
        message = "`linear_stability`: a root of the determinant is zero or repeated, so first order does not decide"
        if any(not part.is_free and len(part.coefficients) > 3 for part in free):
            message = "`linear_stability`: the determinant has a factor whose roots have no known closed form"
        raise Rejected(Complaint("not-decided", message))
    return [(need, part) for part in pencil.parts for need in part.needs]


def _open(need: Expr, pencil: GyroscopicPencil) -> Expr:
    """Return the factors of unknown sign where the state exists: K - m w^2 of (K - m w^2)(k - m w^2), if k > m w^2."""
    if need.count_ops() > LARGEST:
        return need
    factors = Mul.make_args(factor(need))
    return Mul(*(f / abs(f) if f.is_number else f for f in factors if pencil.sign(f) != 1))


def _may_drift(part: Part, pencil: GyroscopicPencil) -> bool:
    """Whether a root may be zero, so that the coordinates move uniformly, while some stiffness remains."""
    if not part.mirrored or len(part.coefficients) != 3 or pencil.sign(part.coefficients[2]) is not None:
        return any(pencil.sign(need) == 0 for need in part.needs)
    below = (cancel(entry / part.coefficients[2]).as_numer_denom()[1] for entry in pencil.stiffness)
    return any(pencil.sign(tidied(each)) is None for each in below)


GYROSCOPIC_STABILITY = Rule(
    "vibrations.gyroscopic_stability",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 3.12 and 5.7",
    outcomes={
        "stable": claims.always(True),
        "unstable": claims.always(False),
        "depends": claims.gyroscopic_stability_depends,
        "first": claims.gyroscopic_stability_first,
        "further": claims.gyroscopic_stability_further,
        "last": claims.gyroscopic_stability_last,
    },
    evidence={"quadrature": ROUTE, "border": CHECK},
)


def _verdict(characteristic: Quantity, together: Linear, outcome: str, key: str) -> Quantity:
    """Stability that is the same for all values of the letters.

    Outcomes: stable, unstable.
    Source: that of `linear_stability`.
    """
    letter = characteristic.step.coordinates[-1][0]
    return establish(
        GYROSCOPIC_STABILITY,
        None,
        lambda equation: equation,
        {"characteristic": characteristic.value},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"quadrature": lambda found: in_quadrature(found, characteristic.parents, together, letter)},
        outcome=outcome,
        phrase_data=PhraseData(points_to=_named(characteristic), outcome_data=outcome_data(together)),
        key=key,
        parents=[characteristic, *_rests(characteristic)],
    )


def _rests(characteristic: Quantity) -> list[Quantity]:
    """Return the equilibrium of the equations, if it is a result."""
    return [each for each in characteristic.parents[0].parents if each.fact(Rest) is not None]


def _named(characteristic: Quantity) -> dict[str, Quantity]:
    """Return the steps that the sentence of a verdict names."""
    return {"characteristic": characteristic, **dict(zip(("rest",), _rests(characteristic), strict=False))}


def _condition(
    characteristic: Quantity,
    together: Linear,
    i: int,
    conditions: Sequence[Relation],
    needs: Sequence[tuple[Expr, Part]],
    key: str,
    linear: Sequence[Quantity],
) -> Quantity:
    """Condition for stability, one of those required.
    Outcomes: depends, first, further, last.
    Source: that of `linear_stability`.
    """
    letter = characteristic.step.coordinates[-1][0]
    need, condition = needs[i][0], conditions[i]

    def at_border(found: Relation) -> tuple[Expr, Expr]:
        """Check that, where the two sides are equal, two roots of the determinant coincide, or one is zero."""
        whole = Poly(of_cosines_and_sines(linear, together, letter), letter)
        square = Symbol("z")
        by_square = Add(*(c * square ** (n // 2) for (n,), c in whole.terms()))
        border = border_of(explicit(found))
        meets = _without_squares(by_square, square)
        value = meets * Poly(by_square, square).eval(0)
        residual = value.subs(border.left, border.right) if border is not None else _remainder(value, explicit(found))
        return residual, ZERO

    return establish(
        GYROSCOPIC_STABILITY,
        None,
        lambda *_: Relation(need, ">", 0),
        {},
        lines=Lines(
            put_in=None, law=Level.FULL, result=False, after=[Form(condition, "solved")], arranged=lambda _: condition
        ),
        routes={"border": at_border},
        outcome=_place_among(i, len(conditions)),
        phrase_data=PhraseData(points_to=_named(characteristic), outcome_data=outcome_data(together, conditions)),
        key=key,
        parents=[characteristic, *_rests(characteristic)],
    )


def _place_among(i: int, number: int) -> str:
    """Return the outcome; the last condition's sentence states stability for all conditions together."""
    if i == number - 1:
        return "last" if i else "depends"
    return "further" if i else "first"


def _without_squares(value: Expr, square: Symbol) -> Expr:
    """Return the discriminant of the polynomial whose square this is: zero where two of its roots coincide."""
    found = Poly(value, square).sqf_part()
    return discriminant(found.as_expr(), square)


def _remainder(value: Expr, condition: Relation) -> Expr:
    """Return the remainder of the value where both sides of a condition are equal."""
    residual = condition.residual.as_numer_denom()[0].expand()
    letter = min(residual.free_symbols, key=str)
    return Poly(value.as_numer_denom()[0].expand(), letter).rem(Poly(residual, letter)).as_expr()
