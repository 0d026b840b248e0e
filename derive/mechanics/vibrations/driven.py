"""The steady-state forced oscillation, after the decay of the free motion, and the quality factor of the oscillator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sympy import Abs, Add, Expr, Integer, Pow, Rational, Symbol, atan, cos, diff, expand, integrate, pi, sin, sqrt, tan

from derive.algebra.expressions import TIME, Factors, Ratio, Root, Terms, depends_on_time, scalar, stand_in
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


HALF, ZERO = Rational(1, 2), Integer(0)

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
    "the steady state of an oscillation that is driven at one frequency; a constant force may be added",
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

    equation   a q_ddot + b q_dot + c q = f(t), where f(t) is F cos(omega t), F sin(omega t) or a sum of both. The force
               f(t) may also contain a constant; the motion is then about the displacement under this constant force
    q          the coordinate of the equation of motion

    Check: the forced oscillation with this amplitude and this lag is substituted back into the equation.
    Outcomes: damped, undamped (the lag with this outcome is 0), opposite (only for the lag, which is pi above resonance
    without damping).
    Errors: the equation is not linear with constant coefficients, or is not driven by a force of a single frequency
    with positive F; an undamped oscillator is at resonance.
    Source: Taylor, *Classical Mechanics*, section 5.5.
    """
    linear = linear_equation(equation, q)
    drive = _drive(linear, equation)
    force, angle = drive.force, drive.angle
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
        motion = drive.static + amplitude * (drive.in_phase * stiff + drive.behind * loss) / over
        return put_back(equation, q, motion), Integer(0)

    def lagging(tangent: Expr) -> tuple[Any, Any]:
        """Check one component of the residual: the component a quarter of a period behind the force vanishes.

        For the force cos(omega t), the motion is cos(omega t) + tan(delta) sin(omega t). This motion is proportional to
        cos(omega t - delta).
        """
        motion = drive.in_phase + (tangent if damped == "damped" else tan(tangent)) * drive.behind
        return drive.component_behind(put_back(equation, q, expand(motion))), Integer(0)

    in_phase = None if excluded is None else positive(stiff)

    def in_step(lag: Expr) -> tuple[Any, Any]:
        """Check that cos(delta) has the sign of c - a omega^2; if this sign is unknown, c > a omega^2 is assumed."""
        size = stand_in("s", positive=True)
        there = with_numbers(stiff) if sign is not None else size
        return cos(lag) * there, Abs(there)

    without, with_one = (put_back(equation, q, Integer(n)).as_independent(TIME, as_Add=True)[0] for n in (0, 1))
    at_rest = without / (without - with_one) if drive.static != 0 else ZERO
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
                **drive.told(size, lag, at_rest),
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


@dataclass(frozen=True)
class _Drive:
    """A driving force with one angular frequency: c + F (p_1 cos(omega t) + p_2 sin(omega t)), with p_1^2 + p_2^2 = 1.

    force    F
    angle    omega t
    phase    p_1 and p_2
    static   the displacement under the constant force c
    """

    force: Expr
    angle: Expr
    phase: tuple[Expr, Expr]
    static: Expr

    @property
    def in_phase(self) -> Expr:
        return self.phase[0] * cos(self.angle) + self.phase[1] * sin(self.angle)

    @property
    def behind(self) -> Expr:
        """Return the oscillation `in_phase`, delayed by a quarter of a period."""
        return self.phase[0] * sin(self.angle) - self.phase[1] * cos(self.angle)

    def component_behind(self, value: Expr) -> Expr:
        return self.phase[0] * value.coeff(sin(self.angle)) - self.phase[1] * value.coeff(cos(self.angle))

    def told(self, size: Symbol, lag: Symbol, at_rest: Expr) -> dict[str, tuple[Expr, Expr]]:
        """Return formulas for the sentence, by name: `motion` is the forced oscillation, unless the force has both a
        cosine and a sine; `static` is the displacement under the constant force, if there is a constant force."""
        found = {} if self.static == 0 else {"static": (self.static, at_rest)}
        if ZERO in self.phase:
            swing = cos if self.phase[1] == 0 else sin
            motion, value = Factors(size, swing(Terms(self.angle, -lag))), size * swing(self.angle - lag)
            found["motion"] = (Terms(self.static, motion), self.static + value) if self.static else (motion, value)
        return found


def _drive(linear: LinearCoefficients, equation: Quantity) -> _Drive:
    check_no_function("steady_amplitude", linear.driven, equation)
    constant, changing = expand(linear.driven).as_independent(TIME, as_Add=True)
    angle, sizes = _one_frequency(changing)
    single = [size for size in sizes if size != 0]
    is_static = constant == 0 or linear.c != 0
    if not single or not is_static or len(single) == 1 and sign_known(single[0]) == -1:
        message = f"`steady_amplitude`: `{equation.key}` is not driven by a single force F cos(omega t), F > 0"
        help_line = "the force may be F cos(omega t), F sin(omega t) or their sum; a constant needs a restoring force"
        raise Rejected(Complaint("unknown-driving", message, help=help_line))
    static = tidied(constant / linear.c) if constant != 0 else ZERO
    if len(single) == 1:
        taken_positive(single[0])
        return _Drive(single[0], angle, (Integer(sizes[0] != 0), Integer(sizes[1] != 0)), static)
    force = tidied(sqrt(tidied(Add(*(size**2 for size in sizes)))))
    return _Drive(force, angle, (sizes[0] / force, sizes[1] / force), static)


def _one_frequency(force: Expr) -> tuple[Expr, tuple[Expr, Expr]]:
    """Return omega t, and the factors of its cosine and sine, for a force with one angular frequency omega. For any
    other force, both factors are zero."""
    angles = {f.args[0] for f in force.atoms(cos, sin) if depends_on_time(f)}
    if len(angles) != 1:
        return ZERO, (ZERO, ZERO)
    (angle,) = angles
    sizes = force.coeff(cos(angle)), force.coeff(sin(angle))
    rest = expand(force - sizes[0] * cos(angle) - sizes[1] * sin(angle))
    return (angle, sizes) if is_linear_in_time(angle) and rest == 0 else (ZERO, (ZERO, ZERO))


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
    Errors: the equation is not linear with constant coefficients; a, b or c is not known to be positive.
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
        """Compare Q with 2 pi times the energy of the oscillation cos(omega_0 t), divided by the work that b q_dot does
        in one period."""
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
