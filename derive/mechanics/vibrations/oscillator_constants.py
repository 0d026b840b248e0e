"""The usual constants of an oscillator a q_ddot + b q_dot + c q = f(t), with which the formula of the motion is short.

The step that derives the motion proposes these constants. A constant gets its own step only if a result contains it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from sympy import Expr, Symbol, sqrt

from derive.algebra.tidy import tidied
from derive.mechanics.vibrations import claims
from derive.steps.establish import Lines, establish
from derive.steps.level import Manner
from derive.steps.natural import Proposal
from derive.steps.record import defined_as, free_letter, given_letters, result_called, results_of
from derive.steps.rule import Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Quantity, same_value

FREQUENCIES = ("vibrations.frequency", "vibrations.uncoupled_frequency")  # rules for one coordinate

OSCILLATOR_CONSTANT = Rule(
    "vibrations.oscillator_constant",
    source="Taylor, *Classical Mechanics*, section 5.4",
    outcomes={
        "decay_rate": claims.is_decay_rate,
        "without_damping": claims.is_frequency_without_damping,
        "with_damping": claims.is_frequency_with_damping,
    },
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
    names_value=True,
)


def oscillator_constants(equation: Quantity, q: Symbol, a: Expr, b: Expr, c: Expr) -> Iterator[Proposal]:
    """Propose omega_0 = sqrt(c/a) and, with damping, beta = b/(2 a) and omega_1 = sqrt(omega_0^2 - beta^2), in 1/s.

    Nothing is proposed unless a and c are known to be positive, and b is known to be positive or zero.

    equation   the equation of motion whose coefficients are a, b and c
    q          the coordinate of the equation of motion
    """
    if sign_known(a) != 1 or sign_known(c) != 1 or sign_known(b) not in (0, 1):
        return
    of = {"equation": equation, "q": q}
    frequency = _proposed("omega_0", "without_damping", sqrt(c / a), of)
    if frequency is None:
        return
    if b != 0 and (rate := _proposed("beta", "decay_rate", b / (2 * a), of)) is not None:
        yield rate
        slower = _proposed("omega_1", "with_damping", sqrt(c / a - b**2 / (4 * a**2)), of, (frequency, rate))
        if slower is not None:
            yield slower
    yield frequency


def _proposed(
    name: str,
    outcome: str,
    value: Expr,
    of: Mapping[str, Any],
    others: tuple[Proposal, ...] = (),
) -> Proposal | None:
    """Propose a constant, or an earlier quantity that takes its place.

    The earlier quantity is a defined quantity or a frequency with the same value, or a result with the same symbol and
    the same value. Return None if the symbol already has another meaning, or if the value is a single symbol or number.
    """
    value = tidied(value)
    name = free_letter(name)
    earlier = (each for each in results_of(*FREQUENCIES) if same_value(each.value, value))
    known = defined_as(value) or next(earlier, result_called(name))
    if known is not None:
        return Proposal(known.symbol, known.value, lambda: known) if same_value(known.value, value) else None
    if name in given_letters() or value.is_Atom:
        return None
    symbol = Symbol(name, real=True, positive=True)
    return Proposal(symbol, value, partial(_constant, symbol, value, outcome, of, others))


def _constant(
    symbol: Symbol, value: Expr, outcome: str, of: Mapping[str, Any], others: tuple[Proposal, ...]
) -> Quantity:
    """Definition of a constant of the oscillator, from the coefficients of its equation, or from omega_0 and beta.

    Outcomes: decay_rate, without_damping, with_damping.
    Source: Taylor, *Classical Mechanics*, section 5.4.
    """
    made = {each.symbol.name: each.make() for each in others}
    return establish(
        OSCILLATOR_CONSTANT,
        symbol,
        lambda equation, q, *both: sqrt(both[0] ** 2 - both[1] ** 2) if both else value,
        {**of, **made},
        key=symbol.name,
        lines=Lines(put_in=None, result=False),
        outcome=outcome,
    )
