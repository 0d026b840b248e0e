"""Conservation of energy for one coordinate: the rate as a function of the coordinate, and the period of a swing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, diff, oo, pi, sqrt

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expansion import Approach, NoExpansion
from derive.algebra.expressions import (
    Factors,
    Ratio,
    Relation,
    Root,
    Terms,
    TimeRate,
    depends_on_time,
    explicit,
    rate,
    scalar,
)
from derive.algebra.period_series import SwingTime, half_swing, is_isochronous, quarter_swing
from derive.algebra.ranges import where_positive
from derive.algebra.samples import letters_of, points, seed_of
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Ask, Value, in_results
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.motion import claims
from derive.mechanics.motion.facts import ByEnergy, SignedRate
from derive.solving.presentation import presented
from derive.solving.unknowns import residual_of, with_unknown
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.numeric import WholeSwing
from derive.steps.record import free_letter, letter_of_limit
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.signs import sign_known
from derive.steps.step import Form, Level, Quantity, approximations_among, is_zero, value_behind

__all__ = ["period_by_energy", "rate_by_energy", "speed_from_energy"]

ZERO, TWO = Integer(0), Integer(2)
CONSERVED = Spelled(
    "give an energy that is conserved in this motion; if other coordinates also change, give `motion`",
    "give an energy that is conserved in this motion; if other coordinates also change, add the equation of motion to "
    "`results`: an acceleration, or a `put_in` with only one coordinate",
)
FIGURES = 30
NOISE = 1e-9  # smaller differences are accepted, because terms cancel near the turning points


SPEED_FROM_ENERGY = Rule(
    "motion.speed_from_energy",
    source="Taylor, *Classical Mechanics*, section 4.6 (one-dimensional systems)",
    evidence={"motion": ROUTE},
)


def speed_from_energy(
    energy: Quantity,
    q: Coordinate,
    start: Expr | Quantity,
    start_rate: Expr | Quantity = ZERO,
    motion: Quantity | None = None,
    key: str | None = None,
) -> Quantity:
    """Square of the rate of a coordinate by conservation of energy, q_dot^2 = 2 (E - V(q))/m(q).

    energy       a conserved energy, J, of the form E = m(q) q_dot^2/2 + V(q)
    q            the coordinate of the motion
    start        value of q at the start
    start_rate   value of q_dot at the start, by default 0, for a release from rest
    motion       the equation of motion, or q_ddot from it; needed if the energy does not determine the forces on q

    A separate step states that the energy has its initial value.
    Second route: half the derivative of q_dot^2 with respect to q is q_ddot from `motion`, or from d'Alembert's
    principle for the mass points. With this q_ddot the energy is constant. At the start the rate has the given value.
    Errors: the energy is not conserved, contains another coordinate or the time, or is not of the form m(q) q_dot^2/2 +
    V(q); neither the energy nor `motion` determines q_ddot.
    Source: Taylor, *Classical Mechanics*, section 4.6 (one-dimensional systems).
    """
    value = explicit(energy.value)
    first, initial = (explicit(value_behind(each)) for each in (start, start_rate))
    if first.has(oo) or initial.has(oo):
        message = "`speed_from_energy` needs a finite start"
        raise Rejected(
            Complaint("wrong-argument", message, help="start at a symbol such as `r_1`, and take the `limit`")
        )
    acceleration = _acceleration(energy, q, motion)
    _check_one_coordinate(energy, value, q)
    letter, speed = q.symbol, q.rate
    along = explicit(TimeRate(value, letter)).xreplace({q.acceleration: acceleration})
    if not is_zero(along):
        message = f"`speed_from_energy`: `{energy.key}` is not conserved"
        raise Rejected(Complaint("not-conserved", message, help=CONSERVED))
    mass = tidied(diff(value, speed, 2))
    rest = value.xreplace({speed: ZERO})
    if mass.has(speed) or mass == 0 or not is_zero(value - rest - mass * speed**2 / 2):
        message = f"`speed_from_energy`: `{energy.key}` is not of the form m(q) q_dot^2/2 + V(q)"
        raise Rejected(Complaint("wrong-argument", message))
    at_start = tidied(value.xreplace({letter: first, speed: initial}))

    about = approximations_among(start, start_rate)
    kept_key = f"{energy.key}_kept" if key is None else f"{key}_energy"
    conserved = _energy_kept(energy, q, first, initial, acceleration, kept_key, about)

    def by_motion(found: Expr) -> tuple[Any, Any]:
        """Check q_ddot = (1/2) d(q_dot^2)/dq, and the rate at the start."""
        expected = with_unknown(acceleration, speed**2, found)
        there = found.xreplace({letter: first})
        return ImmutableDenseMatrix([diff(found, letter) / 2, there]), ImmutableDenseMatrix([expected, initial**2])

    return establish(
        SPEED_FROM_ENERGY,
        speed**2,
        lambda *_: Ratio(Factors(TWO, Terms(at_start, -rest)), mass),
        {"kept": conserved},
        lines=Lines(
            law=Level.FULL,
            put_in=None,
            arranged=presented,
            means={speed: sqrt(2 * (at_start - rest) / mass)},
        ),
        routes={"motion": by_motion},
        phrase_data=PhraseData(outcome_data={"coordinate": letter, "start": first, "start_rate": initial}),
        key=key or f"{letter.name}_dot_squared",
        facts=[ByEnergy(letter, first, initial, acceleration)],
    )


ENERGY_KEPT = Rule(
    "motion.energy_kept",
    source="Taylor, *Classical Mechanics*, section 4.6",
    outcomes={"from_rest": claims.released(True), "moving": claims.released(False)},
    evidence={"motion": ROUTE},
    named={"place": claims.energy_there},
)


def _energy_kept(
    energy: Quantity,
    q: Coordinate,
    first: Expr,
    initial: Expr,
    acceleration: Expr,
    key: str,
    about: Sequence[Quantity],
) -> Quantity:
    """Conservation of energy: at all times the energy has its initial value."""
    value, letter, speed = explicit(energy.value), q.symbol, q.rate
    at_start = tidied(value.xreplace({letter: first, speed: initial}))

    def keeps(found: Relation) -> tuple[Any, Any]:
        """Check that the equation is satisfied at the start, and that E does not change along the motion."""
        there = found.residual.xreplace({letter: first, speed: initial})
        changing = explicit(TimeRate(found.residual, letter)).xreplace({q.acceleration: acceleration})
        is_equation = int(found.operator == "=")
        return ImmutableDenseMatrix([there, changing, found.left, is_equation]), ImmutableDenseMatrix([0, 0, value, 1])

    return establish(
        ENERGY_KEPT,
        None,
        lambda e: Relation(e, "=", at_start),
        {"energy": energy},
        lines=Lines(put_in=Level.BRIEF, law=Level.FULL, result=False, arranged=explicit),
        routes={"motion": keeps},
        outcome="from_rest" if initial == 0 else "moving",
        key=key,
        phrase_data=PhraseData(
            named={"place": Relation(letter, "=", first)},
            outcome_data={"initial": initial},
        ),
        parents=about,
    )


def _acceleration(energy: Quantity, q: Coordinate, motion: Quantity | None) -> Expr:
    """Return q_ddot from the equation of motion or, if none is given, from d'Alembert's principle."""
    matter = energy.fact(Matter)
    if motion is not None and motion.symbol == q.acceleration:
        return tidied(explicit(motion.value))
    if motion is not None:
        left = residual_of("speed_from_energy", motion)
    elif matter is not None and tuple(matter.coordinates) == (q.symbol,):
        left = matter.inertia_along(q.symbol) - matter.force_along(q.symbol)
    else:
        message = f"`speed_from_energy`: `{energy.key}` does not determine the forces on {q.symbol.name}"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled(
                    "give the equation of motion as `motion=...`",
                    f"add `results: motion_{q.symbol.name}`, the equation of motion of {q.symbol.name}",
                ),
            )
        )
    factor = tidied(diff(left, q.acceleration))
    if factor == 0 or factor.has(q.acceleration):
        message = f"`speed_from_energy`: the equation of motion does not determine {q.acceleration.name}"
        raise Rejected(Complaint("wrong-argument", message))
    return tidied(-left.xreplace({q.acceleration: ZERO}) / factor)


def _check_one_coordinate(energy: Quantity, value: Expr, q: Coordinate) -> None:
    others = [c for c in energy.coordinates if c != q.symbol and value.has(c, rate(c))]
    if others or depends_on_time(value) or not value.has(q.rate):
        what = others[0].name if others else "the time t" if depends_on_time(value) else f"no rate of {q.symbol.name}"
        message = (
            f"`speed_from_energy` needs an energy that contains only {q.symbol.name} and its rate, "
            f"but `{energy.key}` contains {what}"
        )
        help_line = None if depends_on_time(value) else "name an energy, such as `energy_function`"
        if others:
            other = others[0].name
            help_line = f"with `put_in`, substitute the value of {other}, or the value of its rate from its momentum"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))


RATE_BY_ENERGY = Rule(
    "motion.rate_by_energy",
    source="Taylor, *Classical Mechanics*, section 4.6 (one-dimensional systems)",
    outcomes={"grows": claims.moves_off(1), "falls": claims.moves_off(-1), "size": claims.moves_off(None)},
    evidence={"squared": CHECK},
    named={"q": claims.coordinate_of_rate},
)


@in_results(
    "square_root",
    "the rate of a coordinate from the squared rate, or the magnitude of the rate if the sign is unknown",
    squared="square_root: a squared rate, as `speed` finds it",
)
def rate_by_energy(squared: Quantity, key: str = "rate_by_energy") -> Quantity:
    """Rate of a coordinate, the root of the squared rate, with the sign that the rate has just after the start.

    squared   the squared rate q_dot^2, a result of `speed_from_energy`

    The result has the sign of the initial rate; at a start from rest, it has the sign of the acceleration.
    Check: the square of the result is q_dot^2.
    Outcomes: grows (the coordinate increases from the start), falls (the coordinate decreases from the start), size
    (the result is |q_dot|, because the sign is unknown).
    Errors: the argument is not the square of a rate from conservation of energy.
    Source: Taylor, *Classical Mechanics*, section 4.6 (one-dimensional systems).
    """
    known = squared.needed(ByEnergy)
    q, value = known.coordinate, explicit(squared.value)
    at_start = known.acceleration.subs({q: known.start, rate(q): ZERO}) if known.start_rate == 0 else known.start_rate
    sense = sign_known(tidied(at_start))
    outcome = {1: "grows", -1: "falls"}.get(sense or 0, "size")
    with where_positive(value):  # the motion does not reach places where the square would be negative
        return establish(
            RATE_BY_ENERGY,
            Abs(rate(q)) if outcome == "size" else rate(q),
            lambda square: -Root(square) if outcome == "falls" else Root(square),
            {"squared": squared},
            lines=Lines(
                law=Level.FULL,
                put_in=None,
                arranged=lambda found: presented(explicit(found)),
                means={rate(q): sqrt(value)},
            ),
            routes={"squared": lambda found: (found**2, value)},
            outcome=outcome,
            phrase_data=PhraseData(named={"q": q}, outcome_data={"known": known}),
            facts=[SignedRate(q, sense)] if sense else [],
            key=key,
        )


PERIOD_BY_ENERGY = Rule(
    "motion.period_by_energy",
    source="Landau, Lifshitz, *Mechanics*, section 11",
    outcomes={"exact": claims.isochronous(True), "expanded": claims.isochronous(False)},
    evidence={"linearised": ROUTE, "quadrature": CHECK},
    named={"amplitude": claims.turns_back_there},
)


@in_results(
    "period",
    "the period, from a squared rate",
    squared="period: a squared rate, as `speed` finds it",
    order="order: in the amplitude",
    symbol="symbol",
)
def period_by_energy(squared: Quantity, order: int = 2, symbol: str | None = None, key: str = "period") -> Quantity:
    """Period of an oscillation, 4 times the integral of dq/q_dot from 0 to the amplitude A, in powers of A.

    squared   q_dot^2 from `speed_from_energy`, for a release from rest at q = A; it must be even in q
    order     the highest power of A in the series

    If the period depends on the amplitude, the series has a symbol of its own, such as tau_lim, and numerical values of
    the period come from the integral.
    Second route: for small amplitudes, 2 pi/omega_0 from the linearised equation of motion. Check: the numerical value
    of the integral.
    Outcomes: exact (the period does not depend on the amplitude), expanded.
    Errors: the motion does not start from rest, or the value of q at the start is not a symbol; q_dot^2 is not an even
    function of q; the motion is not an oscillation about q = 0.
    Source: Landau, Lifshitz, *Mechanics*, section 11.
    """
    known = squared.needed(ByEnergy)
    q, amplitude, value = known.coordinate, known.start, explicit(squared.value)
    if not isinstance(amplitude, Symbol) or known.start_rate != 0:
        message = f"`period_by_energy`: the motion of `{squared.key}` must start from rest at a symbol, the amplitude"
        raise Rejected(Complaint("wrong-argument", message))
    if not is_zero(value.subs(q, -q) - value):
        message = f"`period_by_energy`: `{squared.key}` is not the same at {q.name} and -{q.name}"
        raise Rejected(Complaint("wrong-argument", message, help="measure the coordinate from the middle of the swing"))
    try:
        found = 4 * quarter_swing(value, q, amplitude, order)
        leading = quarter_swing(value, q, amplitude, 0)
    except NoExpansion:
        message = f"`period_by_energy`: the motion of `{squared.key}` is not an oscillation about {q.name} = 0"
        raise Rejected(Complaint("no-oscillation", message)) from None
    stiffness = tidied((pi / 2 / leading) ** 2)
    exact = is_isochronous(value, q, amplitude, stiffness)

    def linearised(result: Expr) -> tuple[Expr, Expr]:
        slope = tidied(diff(known.acceleration, q).subs({q: ZERO, rate(q): ZERO}))
        return result.subs(amplitude, 0) ** 2 * -slope, 4 * pi**2

    period, integral = scalar(symbol or free_letter("tau")), SwingTime(value, q, amplitude, Integer(order))
    return establish(
        PERIOD_BY_ENERGY,
        period if exact else letter_of_limit(period, amplitude, ZERO),
        lambda *_: Factors(Integer(4), integral),
        {"squared": squared, "approach": Approach(amplitude, ZERO)},
        lines=Lines(
            law=Level.BRIEF,
            put_in=None,
            after=[Form(found, "result") if exact else Form(_written(found, amplitude), "series")],
            result=False,
            arranged=lambda _: found,
        ),
        routes={
            "linearised": linearised,
            "quadrature": lambda result: _by_quadrature(value, q, amplitude, result, order),
        },
        outcome="exact" if exact else "expanded",
        key=key,
        kind="time",
        phrase_data=PhraseData(
            named={"amplitude": amplitude},
            outcome_data={"value": value, "coordinate": q, "acceleration": known.acceleration},
        ),
        scope=Scope() if exact else Scope(approximates=period),
        facts=[] if exact else [WholeSwing(Integer(4), integral)],
    )


def _written(value: Expr, amplitude: Symbol) -> Expr:
    """Write the series with its first term as a factor and in ascending powers: 2 pi sqrt(l/g) (1 + A^2/16)."""
    whole = value.subs(amplitude, 0)
    rest = tidied(value / whole).expand()
    terms = sorted(Add.make_args(rest), key=lambda term: int(term.as_coeff_exponent(amplitude)[1]))
    return Factors(whole, Terms(*terms)) if len(terms) > 1 else whole * rest


def _by_quadrature(value: Expr, q: Symbol, amplitude: Symbol, found: Expr, order: int) -> Verdict:
    """Compare the series with the numerical integral at two amplitudes.

    The relative difference must decrease faster than the last power of the amplitude, or be only numerical noise.
    """
    from mpmath import mp

    letters = (letters_of(value) | letters_of(found)) - {q, amplitude}
    drawn = islice(points(letters, seed_of(value)), 40)
    point = next((p for p in drawn if _swings(found, {**p, amplitude: Rational(1, 40)})), None)
    if point is None:
        return Verdict(Grade.REFUTED, "the period is not positive for any of the numbers tried")
    figures = FIGURES + 5 * order  # enough digits to compare the difference with a power of a small amplitude
    with mp.workdps(figures):
        rests = []
        for small in (Rational(1, 40), Rational(1, 80)):
            there = {**point, amplitude: small}
            half = half_swing(value.xreplace(there), q, small, figures - 15)
            if half is None:
                return Verdict(Grade.REFUTED, "the integral does not converge")
            told = Rational(str(found.xreplace(there).evalf(mp.dps)))
            rests.append(mp.mpf(str((abs(2 * half / told - 1) / small**order).evalf(mp.dps))))
    if not (rests[1] <= rests[0] * 0.6 or rests[1] <= NOISE):
        apart = f"{mp.nstr(rests[1], 5)} times the last power of the amplitude"
        return Verdict(Grade.REFUTED, f"the relative difference between the integral and the series is {apart}")
    return Verdict(Grade.APPROXIMATION, f"to order {order} in the amplitude, numerically")


def _swings(found: Expr, point: Mapping[Any, Any]) -> bool:
    """Whether the period is positive for these numbers; only then is the force restoring."""
    return bool(found.subs(point).evalf().is_positive)


@in_results(
    "speed",
    "the squared rate of a coordinate, from a conserved energy",
    energy="speed: a conserved energy",
    q="for: a coordinate",
    start="start",
    start_rate="start_rate: 0 by default",
    motion="results: the equation of motion, if the energy does not suffice",
)
def _in_results(
    energy: Quantity,
    q: Coordinate,
    start: Value,
    key: str,
    start_rate: Value = ZERO,
    motion: Quantity | None = None,
    ask: Ask | None = None,
) -> Quantity:
    """Call `speed_from_energy`, with the equation of motion if the energy does not determine the forces."""
    matter = energy.fact(Matter)
    says_all = matter is not None and tuple(matter.coordinates) == (q.symbol,)
    if motion is None and not says_all and ask is not None:
        motion = ask(f"motion_{q.symbol.name}")
    return checked(speed_from_energy)(energy, q, start, start_rate, motion, key)
