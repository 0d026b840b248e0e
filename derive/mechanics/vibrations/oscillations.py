"""The frequency of small oscillations of one coordinate about an equilibrium, from the linear equation of motion."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Abs, Add, Expr, I, Integer, Mul, Pow, Rational, Symbol, cos, diff, exp, prime, sqrt

from derive.algebra.collect import spread, spread_or_by_terms
from derive.algebra.expressions import Factors, Ratio, Relation, Root, Terms, explicit, rate, scalar, stand_in
from derive.algebra.length import length
from derive.algebra.ranges import fulfilling, rational_in_range, strict_sign_within, without_abs
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import OfCoordinate, T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear, SquareOf
from derive.solving.linear_systems import root_of
from derive.solving.relations import positive
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.level import Manner
from derive.steps.record import defined_quantities, require_constant
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.signs import sign_for_all, sign_where
from derive.steps.step import Form, Level, Quantity

__all__ = ["frequency", "frequency_and_growth", "frequency_squared"]

SHORT = 4  # largest number of terms of a condition that a sentence states


FREQUENCY_SQUARED = Rule(
    "vibrations.frequency_squared",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1",
    outcomes=claims.SIGNS,
    evidence={"put_back": CHECK},
    named={
        "oscillator": claims.oscillator,
        "inertia": claims.divided_by,
        "acceleration": claims.its_acceleration,
    },
    shown=Shown(brief=Manner.TAKEN_IN, standard=Manner.TAKEN_IN),
)


def frequency_squared(linear: Quantity, symbol: str = "omega_0", key: str = "frequency_squared") -> Quantity:
    """Square of the frequency of small oscillations, omega_0^2 = k/m, in 1/s^2.

    linear   the equation m q_ddot + k q = 0, as `linearised` yields it

    Check: q = cos(omega_0 t) is substituted back into the equation.
    Outcomes: stable (positive), unstable (negative), neutral (zero), conditional (the sign depends on the symbols).
    Errors: the equation is not of this form; a coefficient is not constant.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    q = linear.needed(OfCoordinate).coordinate.symbol
    left = linear.value.left
    stiffness, mass = spread(diff(left, q)), spread(diff(left, rate(q, 2)))
    damping = diff(left, rate(q))
    if mass == 0 or damping != 0 or (left - stiffness * q - mass * rate(q, 2)).expand() != 0:
        message = f"`frequency_squared` needs an equation m q_ddot + k q = 0, but `{linear.key}` is not one"
        raise Rejected(Complaint("wrong-argument", message))
    for role, coefficient in (("stiffness", stiffness), ("inertia", mass)):
        require_constant("frequency_squared", role, coefficient)
    whole = linear.fact(Linear)
    exists = whole.exists if whole is not None else None
    entries = (whole.stiffness[0], whole.mass[0]) if whole is not None else (stiffness, mass)
    trial = stand_in("w", positive=True)

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        swing = cos(trial * T)
        left_side = left.subs({rate(q, 2): diff(swing, T, 2), q: swing})
        return left_side.expand().subs(trial**2, found), Integer(0)

    omega = _symbol(symbol)
    return establish(
        FREQUENCY_SQUARED,
        Pow(omega, 2),
        lambda _: _quotient(stiffness, mass),
        {"q": q},
        lines=Lines(
            put_in=None,
            arranged=_squared_form if not mass.has(Add) or not stiffness.has(Add) else explicit,
            means={omega: sqrt(Ratio(stiffness, mass).doit())},
        ),
        routes={"put_back": put_back},
        outcome=lambda value: _sort_of(value, entries, exists),
        key=key,
        kind="squared angular speed",
        parents=[linear],
        phrase_data=PhraseData(
            named={
                **({} if mass == 1 else {"inertia": mass, "acceleration": rate(q, 2)}),
                "oscillator": Relation(Terms(rate(q, 2), Factors(omega**2, q)), "=", 0),
            },
            points_to={"linear": linear},
            outcome_data={"exists": exists} if exists is not None else {},
        ),
        facts=[SquareOf(symbol, exists, (q, whole.exact[0]) if whole is not None and whole.exact else None)],
    )


def _symbol(name: str) -> Symbol:
    """Return the symbol of the quantity that the problem defines with this key, or else the symbol with this name."""
    return next((each.symbol for each in defined_quantities() if each.key == name), scalar(name))


def _quotient(stiffness: Expr, mass: Expr) -> Expr:
    above, below = stiffness.as_numer_denom()
    if below.free_symbols:
        return Ratio(above, below * mass)
    return stiffness if mass == 1 else Ratio(stiffness, mass)


def _squared_form(value: Expr) -> Expr:
    """Write g/l - omega^2 in place of (g - l omega^2)/l if the first form is shorter."""
    forms = [tidied(value), spread_or_by_terms(tidied(value))]
    return min(forms, key=length)


def _sort_of(value: Expr, entries: tuple[Expr, Expr], exists: Relation | None) -> str:
    """Return the outcome from the sign of omega_0^2 = k/m for values of the symbols for which the equilibrium
    exists."""
    value = tidied(value)
    if value == 0:
        return "neutral"
    sign = strict_sign_within(value) or sign_where(value, exists)
    if sign is None:
        sign = 1 if all(sign_for_all(tidied(each)) == 1 for each in entries) else None
    return {1: "stable", -1: "unstable"}.get(sign or 0, "conditional")


def _turned(value: Expr) -> Expr:
    """Return minus the value; a factor like R - a/2 changes sign: M g (a/2 - R) for M g (R - a/2)."""
    factors = list(Mul.make_args(value))
    sums = [
        i for i, f in enumerate(factors) if isinstance(f, Add) and any(t.could_extract_minus_sign() for t in f.args)
    ]
    if not sums:
        return -value
    factors[sums[0]] = Add(*(-term for term in factors[sums[0]].args))
    return Mul(*factors)


def told_where_positive(square: Expr) -> dict[str, tuple[Relation, Relation]]:
    """Return the condition under which the square of a frequency is positive, if the square is short and contains no
    root; otherwise an empty dictionary."""
    has_roots = any(not power.exp.is_Integer for power in square.atoms(Pow))
    if has_roots or len(Add.make_args(square.expand())) > SHORT:
        return {}
    return {"condition": (positive(square), Relation(square, ">", Integer(0)))}


def frequency(
    squared: Quantity,
    symbol: str | None = None,
    key: str = "frequency",
    condition: bool = False,
    stands_for: Sequence[str] = (),
) -> Quantity:
    """Angular frequency of small oscillations, omega_0 = sqrt(omega_0^2); if the square is negative, the growth rate.

    squared     the square of the frequency, as `frequency_squared` yields it, 1/s^2
    condition   whether the sentence states the condition for an oscillation
    stands_for  further keys of this step, such as the key of a growth rate. The growth rate has a step of its own only
                if the sign of the square is unknown

    Check: cos(omega_0 t), or e^(kappa t), satisfies q_ddot + omega_0^2 q = 0, and the result is the positive root.
    Outcomes: stable, conditional, neutral (zero), unstable (the growth rate kappa).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    return _rate(squared, squared.step.outcome, symbol, key, condition, stands_for)


def frequency_and_growth(
    squared: Quantity, keys: Sequence[str] = ("frequency", "growth_rate"), condition: bool = False
) -> tuple[Quantity, Quantity]:
    """Frequency of small oscillations, omega_0, if the square is positive; growth rate, kappa, if it is negative.

    squared     the square of the frequency, as `frequency_squared` yields it, 1/s^2
    keys        the keys of the frequency and of the growth rate; if the sign is known, both keys name one step
    condition   as for `frequency`

    Check: as for `frequency`.
    Outcomes: the same as for `frequency`; the growth rate next to a conditional frequency has the outcome growing.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    first, second = keys
    if squared.step.outcome != "conditional":
        return (frequency(squared, key=first, stands_for=[second]),) * 2
    return frequency(squared, key=first, condition=condition), _rate(squared, "growing", None, second)


FREQUENCY = Rule(
    "vibrations.frequency",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1",
    outcomes={
        "stable": claims.rate_of_square(1, 1),
        "unstable": claims.rate_of_square(-1, -1),
        "neutral": claims.rate_of_square(0, 1),
        "conditional": claims.rate_of_square(None, 1),
        "growing": claims.rate_of_square(None, -1),
    },
    evidence={"motion": CHECK, "positive": CHECK},
    named={"exact": claims.oscillates_exactly},
)


def _rate(
    squared: Quantity,
    outcome: str,
    symbol: str | None,
    key: str,
    condition: bool = False,
    stands_for: Sequence[str] = (),
) -> Quantity:
    """Frequency of the oscillation, or growth rate kappa.

    Check: the motion is substituted back into its equation; the result is not negative.
    Outcomes: stable, conditional, neutral, unstable, growing (the growth rate if the sign of the square is unknown).
    Source: the same as for `frequency`.
    """
    known = squared.needed(SquareOf)
    grows = outcome in ("unstable", "growing")
    name = symbol or ("kappa" if grows else known.letter)
    size = _turned(squared.value) if grows else squared.value
    plain = explicit(Root(size))
    shown = without_abs(plain) if without_abs(plain) != plain else Root(size) if size.has(Add) else root_of(size)
    trial = stand_in("w", positive=True)

    def satisfies(found: Expr) -> tuple[Expr, Expr]:
        motion = exp(trial * T) if grows else cos(trial * T)
        left = diff(motion, T, 2) / motion + squared.value
        return left.expand().subs(trial**2, found**2), Integer(0)

    def positive_root(found: Expr) -> tuple[Expr, Expr]:
        """Check the sign of the result for one set of numbers.

        The equation of motion holds for either sign of the result, and the sign can change only where the result is
        zero.
        """
        letters = sorted(squared.value.free_symbols, key=str)
        drawn = {letter: rational_in_range(letter, Rational(prime(n + 5), 7)) for n, letter in enumerate(letters)}
        there = fulfilling(drawn)
        imaginary = explicit(size).subs(there).is_negative
        value = found.subs(there) / (I if imaginary else 1)
        return value, Abs(value)

    return establish(
        FREQUENCY,
        _symbol(name),
        lambda square: Root(-square if grows else square),
        {"squared": squared},
        lines=Lines(
            law=Level.FULL if grows else Level.BRIEF,
            put_in=None,
            after=[Form(shown, "result")],
            result=False,
            arranged=lambda value: without_abs(explicit(value)),
        ),
        routes={"motion": satisfies, "positive": positive_root},
        outcome=outcome,
        phrase_data=PhraseData(
            formulas=told_where_positive(squared.value) if condition and outcome == "conditional" else {},
            named={"exact": known.exact[0]} if known.exact and not grows else {},
            outcome_data={
                **({"exists": known.exists} if known.exists is not None else {}),
                **({"left": known.exact[1]} if known.exact and not grows else {}),
            },
            stands_for=stands_for,
        ),
        key=key,
        kind="angular speed",
        parents=[each for each in defined_quantities() if each.key == name],
    )
