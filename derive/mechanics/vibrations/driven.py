"""The steady-state forced oscillation, after the decay of the free motion, and the quality factor of the oscillator."""

from __future__ import annotations

from typing import Any

from sympy import Abs, Add, Expr, Integer, Pow, Rational, atan, cos, diff, expand, integrate, pi, sin, sqrt, tan

from derive.algebra.expressions import TIME, Factors, Ratio, Root, Terms, scalar, stand_in
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.in_results import in_results
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.general_motion import LinearCoefficients, put_back
from derive.mechanics.vibrations.linear_motion import check_no_function, is_linear_in_time, linear_equation
from derive.solving.divisors import check_no_resonance, different_from_zero
from derive.solving.presentation import presented
from derive.solving.relations import conditions_told, positive
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.signs import sign_known, taken_positive
from derive.steps.step import Level, Quantity

__all__ = ["quality_factor", "steady_amplitude"]


HALF = Rational(1, 2)

STEADY_AMPLITUDE = Rule(
    "vibrations.steady_amplitude",
    source="Taylor, *Classical Mechanics*, section 5.5",
    outcomes={"damped": claims.loses(True), "undamped": claims.loses(False)},
    evidence={"put_back": CHECK},
    statements=[claims.swings_of_its_equation],
)


LAG = Rule(
    "vibrations.lag",
    source="Taylor, *Classical Mechanics*, section 5.5",
    outcomes={"damped": claims.loses(True), "undamped": claims.in_step(1, None), "opposite": claims.in_step(-1)},
    evidence={"quarter_turn_on": CHECK, "put_back": CHECK},
    statements=[claims.lag_as_written],
    shown=Shown(verdicts=frozenset(("undamped", "opposite"))),
)


@in_results(
    "amplitude",
    "the steady state of a driven oscillation",
    equation="amplitude: a driven linear equation of motion",
    q="for: a coordinate",
    symbol="symbol",
)
def steady_amplitude(
    equation: Quantity, q: Coordinate, symbol: str = "A", key: str = "steady_amplitude"
) -> tuple[Quantity, Quantity]:
    """Amplitude of the forced oscillation A cos(omega t - delta), A = F/sqrt((c - a omega^2)^2 + (b omega)^2), and the
    tangent of the lag, tan(delta) = b omega/(c - a omega^2). Without damping, the second result is the lag itself;
    if the sign of c - a omega^2 is unknown, c > a omega^2 is assumed.

    equation   a q_ddot + b q_dot + c q = F cos(omega t)
    q          the coordinate of the equation of motion

    Check: the forced oscillation with this amplitude and this lag is substituted back into the equation.
    Outcomes: damped, undamped (the lag is 0), opposite (only for the lag, which is pi above resonance without
    damping).
    Errors: the equation is not linear with constant coefficients, or is not driven by a single force F cos(omega t)
    with positive F; an undamped oscillator is at resonance.
    Source: Taylor, *Classical Mechanics*, section 5.5.
    """
    linear = linear_equation(equation, q)
    force, angle = _one_swing(linear, equation)
    taken_positive(force)
    w = diff(angle, TIME)
    stiff, loss = linear.c - linear.a * w**2, linear.b * w
    damped = "damped" if linear.b != 0 else "undamped"
    if damped == "undamped":
        check_no_resonance(stiff)
    sign = None if damped == "damped" else sign_known(stiff)
    excluded = None if damped == "damped" else different_from_zero(stiff)
    size = scalar(symbol)
    lag = scalar("delta")

    def forced(amplitude: Expr) -> tuple[Any, Any]:
        """Substitute the motion, with cos(delta) = (c - a omega^2) A/F and sin(delta) = b omega A/F."""
        over = force / amplitude
        motion = amplitude * (cos(angle) * stiff + sin(angle) * loss) / over
        return put_back(equation, q, motion), Integer(0)

    def lagging(tangent: Expr) -> tuple[Any, Any]:
        """Check that the factor of sin(omega t) in the residual vanishes, for the motion cos(omega t) + tan(delta)
        sin(omega t), which is proportional to cos(omega t - delta)."""
        motion = cos(angle) + (tangent if damped == "damped" else tan(tangent)) * sin(angle)
        return put_back(equation, q, motion).coeff(sin(angle)), Integer(0)

    in_phase = None if excluded is None else positive(stiff)

    def in_step(lag: Expr) -> tuple[Any, Any]:
        """Check that cos(delta) has the sign of c - a omega^2; if this sign is unknown, c > a omega^2 is assumed."""
        size = stand_in("s", positive=True)
        there = with_numbers(stiff) if sign is not None else size
        return cos(lag) * there, Abs(there)

    amplitude = establish(
        STEADY_AMPLITUDE,
        size,
        lambda *_: Ratio(force, Root(Terms(Pow(stiff, 2), Pow(loss, 2)))),
        {"equation": equation, "q": q.symbol},
        lines=Lines(law=Level.FULL, put_in=None, arranged=lambda value: _amplitude(force, stiff, loss)),
        routes={"put_back": forced},
        outcome=damped,
        key=key,
        kind=q.kind,
        phrase_data=PhraseData(
            formulas={
                "motion": (Factors(size, cos(Terms(angle, -lag))), size * cos(angle - lag)),
                **conditions_told(excluded=excluded),
            },
            outcome_data={"loss": loss},
        ),
    )
    lags = establish(
        LAG,
        scalar("delta") if damped == "undamped" else tan(lag),
        lambda *_: Ratio(loss, stiff) if damped == "damped" else pi if sign == -1 else Integer(0),
        {"equation": equation},
        lines=Lines(
            law=Level.FULL,
            put_in=None,
            arranged=presented,
            means={lag: atan(loss / stiff)} if damped == "damped" else {},
        ),
        routes={"quarter_turn_on": lagging, **({"put_back": in_step} if damped == "undamped" else {})},
        outcome="opposite" if sign == -1 else damped,
        key=f"{key}_lag",
        kind="number" if damped == "damped" else "angle",
        phrase_data=PhraseData(
            formulas=conditions_told(in_step=in_phase),
            outcome_data={"loss": loss, "stiff": stiff},
        ),
    )
    return amplitude, lags


def _amplitude(force: Expr, stiff: Expr, loss: Expr) -> Expr:
    if loss == 0:
        return presented(force / sqrt(stiff**2))
    common = common_factor([force, stiff, loss])
    if common.is_positive:
        force, stiff, loss = (tidied(each / common) for each in (force, stiff, loss))
    return force / sqrt(Add(stiff**2, presented(loss**2)))


def _one_swing(linear: LinearCoefficients, equation: Quantity) -> tuple[Expr, Expr]:
    check_no_function("steady_amplitude", linear.driven, equation)
    outside, inside = linear.driven.as_independent(TIME, as_Add=False)
    if not isinstance(inside, cos) or not is_linear_in_time(inside.args[0]) or sign_known(outside) == -1:
        message = f"`steady_amplitude`: `{equation.key}` is not driven by a single force F cos(omega t), F > 0"
        raise Rejected(Complaint("unknown-driving", message))
    return outside, inside.args[0]


QUALITY_FACTOR = Rule(
    "vibrations.quality_factor",
    source="Taylor, *Classical Mechanics*, section 5.6; French, *Vibrations and Waves*, chapter 3",
    outcomes={
        "oscillates": claims.dies_away("oscillating"),
        "critical": claims.dies_away("critical"),
        "creeps": claims.dies_away("creeping"),
        "depends": claims.dies_away("unknown"),
    },
    evidence={"resonance": ROUTE, "energy": ROUTE},
)


@in_results(
    "quality_factor",
    "the quality factor of a damped oscillator",
    equation="quality_factor: a linear equation of motion with damping",
    q="for: a coordinate",
    symbol="symbol",
)
def quality_factor(equation: Quantity, q: Coordinate, symbol: str = "Q", key: str = "quality_factor") -> Quantity:
    """Quality factor of a damped oscillator, Q = omega_0/(2 beta) = sqrt(a c)/b.

    equation   a q_ddot + b q_dot + c q = f(t) with positive a, b and c
    q          the coordinate of the equation of motion

    Second route: with the driving force F cos(omega_0 t), where omega_0 = sqrt(c/a), the motion
    q = Q (F/c) sin(omega_0 t) satisfies the equation. Also, Q is 2 pi times the energy of this oscillation, divided by
    the energy that the damping dissipates in one period.
    Outcomes: oscillates (Q > 1/2: the free motion oscillates), critical (Q = 1/2), creeps (Q < 1/2), depends (the
    symbols leave open whether Q > 1/2).
    Errors: the equation is not linear with constant coefficients, or has no damping or no restoring force.
    Source: Taylor, *Classical Mechanics*, section 5.6; French, *Vibrations and Waves*, chapter 3.
    """
    linear = linear_equation(equation, q)
    for value, what in ((linear.a, "inertia"), (linear.b, "damping"), (linear.c, "restoring force")):
        if sign_known(value) != 1:
            message = f"`quality_factor`: the {what} in `{equation.key}` is not known to be positive"
            raise Rejected(Complaint("wrong-argument", message, help="give the equation of a damped oscillator"))
    force, w = stand_in("F", positive=True), sqrt(linear.c / linear.a)

    def resonance(found: Expr) -> tuple[Any, Any]:
        driven = put_back(equation, q, found * force / linear.c * sin(w * TIME)) - put_back(equation, q, Integer(0))
        return expand(driven - _sense(equation, linear, q) * force * cos(w * TIME)), Integer(0)

    def energy(found: Expr) -> tuple[Any, Any]:
        """Compare with the energy of the oscillation cos(omega_0 t) and the work of b q_dot in one period."""
        whole = linear.c / 2
        work = integrate(linear.b * diff(cos(w * TIME), TIME) ** 2, (TIME, 0, 2 * pi / w))
        return found, 2 * pi * whole / work

    def outcome(found: Expr) -> str:
        """Compare Q^2 with 1/4: an assumption such as b^2 < 4 k m determines the sign of Q^2 - 1/4."""
        return {1: "oscillates", 0: "critical", -1: "creeps", None: "depends"}[sign_known(found**2 - HALF**2)]

    return establish(
        QUALITY_FACTOR,
        scalar(symbol),
        lambda *_: Ratio(sqrt(linear.a * linear.c), linear.b),
        {"equation": equation, "q": q.symbol},
        lines=Lines(put_in=None, arranged=presented),
        routes={"resonance": resonance, "energy": energy},
        outcome=outcome,
        phrase_data=PhraseData(outcome_data={"mass": linear.a, "loss": linear.b, "stiff": linear.c}),
        key=key,
        kind="number",
    )


def _sense(equation: Quantity, linear: LinearCoefficients, q: Coordinate) -> int:
    """Return 1 if `equation` has the coefficients in `linear`, and -1 if its coefficients have the opposite signs."""
    unit = put_back(equation, q, Integer(1)) - put_back(equation, q, Integer(0))
    return 1 if tidied(unit - linear.c) == 0 else -1
