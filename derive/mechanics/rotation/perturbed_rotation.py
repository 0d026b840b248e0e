"""Perturbed rotations: small deviations from a steady rotation about a principal axis, and the free symmetric body.

Euler's equations are linearised in the two components of the angular velocity perpendicular to the axis. Second routes
use the accelerations of the particles of a rotating body, or conserved quantities.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Pow, Rational, diff, linsolve, prime, sqrt

from derive.algebra.expressions import AXES, Factors, Ratio, Relation, Root, Terms, explicit, rate, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.facts import Disturbed, RateOfMomentum
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Fact, Quantity, is_zero
from derive.steps.trial_numbers import trial_points

__all__ = ["body_cone_rate", "linearised_rotation", "perturbation_rate", "perturbation_rate_squared"]

ZERO = Integer(0)


def linearised_rotation(
    equations: Sequence[Quantity], axis: str, speed: Expr, key: str = "linearised"
) -> tuple[Quantity, Quantity]:
    """Euler's equations to first order about a steady rotation: about z, I_x omega_x_dot = (I_y - I_z) omega omega_y.

    equations   Euler's equations in the order x, y, z, without torque
    axis        "x", "y" or "z": the principal axis of the steady rotation
    speed       the constant rate omega of the steady rotation, 1/s

    Second route: the sum of m r x a over the particles of the body is computed for two opposite perturbations. Half of
    the difference contains the terms of first order.
    Errors: a steady rotation about the axis does not satisfy the equations, for example because a torque acts; there is
    no such axis; the rate is not constant; one of the three equations is missing.
    Source: Landau, Lifshitz, *Mechanics*, section 37; Taylor, *Classical Mechanics*, section 10.8.
    """
    if axis not in AXES:
        message = f'the axis of a steady rotation must be "x", "y" or "z", not "{axis}"'
        raise Rejected(Complaint("no-such-axis", message))
    require_constant("linearised_rotation", "rate", speed)
    of = _rate_of(equations)
    disturbed = Disturbed(AXES.index(axis), speed, of)
    steady = {**disturbed.steadily, **{rate(w): ZERO for w in of.moving}}
    for equation in equations:
        if not is_zero(_left(equation).xreplace(steady)):
            message = f"a steady rotation about {axis} does not satisfy `{equation.key}`"
            help_line = "use a principal axis, and equations without a torque"
            raise Rejected(Complaint("not-steady", message, help=help_line))
    first, second = (_linear_equation(equations, disturbed, k, key) for k in disturbed.across)
    return first, second


def _rate_of(equations: Sequence[Quantity]) -> RateOfMomentum:
    found = [parent.fact(RateOfMomentum) for equation in equations for parent in equation.parents]
    rates = [fact for fact in found if fact is not None]
    if len(equations) != 3 or not rates:
        raise Rejected(Complaint("wrong-argument", "this step needs all three Euler equations"))
    return rates[0]


def _left(equation: Quantity) -> Expr:
    residual: Expr = explicit(equation.value).residual
    return residual


PERTURBED_ROTATION = Rule(
    "rotation.perturbed_rotation",
    source="Landau, Lifshitz, *Mechanics*, section 37; Taylor, *Classical Mechanics*, section 10.8",
    evidence={"opposite": ROUTE},
    named={
        "letter": claims.about_that_axis,
        "along": claims.steady_component,
        "speed": claims.to_first_order,
        "small": claims.another_component,
    },
)


def _linear_equation(equations: Sequence[Quantity], disturbed: Disturbed, k: int, key: str) -> Quantity:
    """Derive one of the two linear equations from the derivatives of Euler's equation at the steady rotation.

    Source: the same as for `linearised_rotation`.
    """
    steady, moving = disturbed.steadily, disturbed.moving
    left = _left(equations[k])
    small = [rate(w) for w in moving] + [w for i, w in enumerate(moving) if i != disturbed.axis]
    still = {**steady, **{rate(w): ZERO for w in moving}}
    factors = [(tidied(diff(left, letter).xreplace(still)), letter) for letter in small]
    whole = Add(*(factor * letter for factor, letter in factors if factor != 0), evaluate=False)

    def by_opposite_disturbances() -> Relation:
        """Return half the difference for opposite perturbations: products of two small quantities cancel."""
        exact = explicit(disturbed.by_particles())[k]
        ahead, back = (
            exact.subs(
                {w: w * sign + value for w, value in steady.items()} | {rate(w): sign * rate(w) for w in moving},
                simultaneous=True,
            )
            for sign in (1, -1)
        )
        beside = moving[disturbed.axis]  # for the change of the component along the axis, which is of second order
        return Relation(((ahead - back) / 2).expand().subs(beside, 0), "=", 0)

    return establish(
        PERTURBED_ROTATION,
        None,
        lambda *_: Relation(whole, "=", 0),
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"opposite": lambda value: (value, by_opposite_disturbances())},
        phrase_data=PhraseData(
            words={"axis": AXES[disturbed.axis]},
            points_to={"motion": equations[k], "slow": equations[disturbed.axis]},
            named={
                "speed": disturbed.speed,
                "along": moving[disturbed.axis],
                "letter": scalar(AXES[disturbed.axis]),
                **{f"small_{n}": moving[i] for n, i in enumerate(disturbed.across, 1)},
            },
        ),
        parents=list(equations),
        key=f"{key}_{AXES[k]}",
        facts=[disturbed],
        scope=Scope(coordinates=dict.fromkeys(moving, "angular speed")),
    )


@dataclass(frozen=True)
class WobbleOf(Fact):
    """The linear equations of a perturbed rotation, and the symbol of the rate of the perturbation."""

    missing = "is not the squared rate of a perturbation"
    equations: tuple[Quantity, Quantity]
    letter: str


PERTURBATION_RATE_SQUARED = Rule(
    "rotation.perturbation_rate_squared",
    source="Landau, Lifshitz, *Mechanics*, section 37; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6",
    outcomes={
        word: claims.order_is(word)
        for word in ("greatest", "least", "unstable", "marginal", "symmetric", "conditional")
    },
    evidence={"conserved": ROUTE, "particles": ROUTE},
    named={"small_1": claims.small_one("first"), "small_2": claims.small_one("second")},
)


def perturbation_rate_squared(
    linear: Sequence[Quantity], symbol: str = "Omega", key: str = "perturbation_rate_squared"
) -> Quantity:
    """Squared angular frequency of a perturbed rotation; about z: Omega^2 = (I_z - I_x)(I_z - I_y) omega^2/(I_x I_y).

    linear   the two linear equations from `linearised_rotation`

    Second route: Omega^2 is proportional to the product of the two curvatures of the conserved quantity L^2/2 - I_z T
    at the steady rotation. Also, the matrix of the linearised motion is computed from the accelerations of particles;
    the square of this matrix has the trace -2 Omega^2.
    Outcomes: greatest, least (Omega^2 is positive, and the moment about the axis is the greatest of the three, or the
    least), unstable (negative), marginal (zero, because another moment is equal to the moment about the axis),
    symmetric (the two other moments are equal), conditional (the sign depends on the order of the moments).
    Source: Landau, Lifshitz, *Mechanics*, section 37; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6.
    """
    disturbed = linear[0].needed(Disturbed)
    i, j = disturbed.across
    names = {
        index: tuple(tidied(diff(_left(equation), letter)) for letter in (rate(disturbed.moving[index]), other))
        for index, equation, other in (
            (i, linear[0], disturbed.moving[j]),
            (j, linear[1], disturbed.moving[i]),
        )
    }
    (first, first_other), (second, second_other) = names[i], names[j]
    in_letters = first.is_Symbol and second.is_Symbol

    def law(*_: Any) -> Expr:
        if in_letters:
            return -first_other * second_other / (first * second)
        return Ratio(Factors(Integer(-1), first_other, second_other), Factors(first, second))

    return establish(
        PERTURBATION_RATE_SQUARED,
        Pow(scalar(symbol), 2),
        law,
        {},
        lines=Lines(
            put_in=None,
            arranged=lambda value: _by_differences(value, disturbed),
            means={scalar(symbol): sqrt(-first_other * second_other / (first * second))},
        ),
        routes={
            "conserved": lambda found: (found, _by_curvatures(disturbed)),
            "particles": lambda found: (-2 * found, _trace_of_squared_motion(disturbed)),
        },
        outcome=lambda value: _stability(value, disturbed),
        phrase_data=PhraseData(
            words={"axis": AXES[disturbed.axis]},
            points_to={"first": linear[0], "second": linear[1]},
            named={f"small_{n}": disturbed.moving[k] for n, k in enumerate(disturbed.across, 1)},
            outcome_data={"moments": disturbed.moments, "axis_index": Integer(disturbed.axis)},
        ),
        key=key,
        kind="squared angular speed",
        parents=list(linear),
        facts=[disturbed, WobbleOf((linear[0], linear[1]), symbol)],
        scope=Scope(coordinates=dict.fromkeys(disturbed.moving, "angular speed")),
    )


def _by_differences(value: Expr, disturbed: Disturbed) -> Expr:
    """Write the moment about the axis of rotation first in each difference, (I_z - I_x)(I_z - I_y), if the moments are
    symbols."""
    found = tidied(value)
    about = disturbed.moments[disturbed.axis]
    across = [disturbed.moments[k] for k in disturbed.across]
    if found == 0 or not all(moment.is_Symbol for moment in (about, *across)):
        return found
    a, b = across
    if a == b:
        return Factors(Pow(Ratio(about - a, a), 2), disturbed.speed**2)
    return Ratio(Factors(Terms(about, -a), Terms(about, -b), disturbed.speed**2), Factors(a, b))


def _by_curvatures(disturbed: Disturbed) -> Expr:
    """Return Omega^2 from the conserved quantities T and L^2.

    Euler's equations are omega_dot = -(grad T x grad(L^2/2))/(I_x I_y I_z), with gradients with respect to the
    components of omega. Near the z axis, Omega^2 is the product of the two curvatures of L^2/2 - I_z T, times
    omega^2/(I_x I_y)^2.
    """
    moments, moving = disturbed.moments, disturbed.moving
    energy = sum((I * w**2 for I, w in zip(moments, moving, strict=True)), ZERO) / 2
    momentum = sum((I**2 * w**2 for I, w in zip(moments, moving, strict=True)), ZERO) / 2
    kept = momentum - moments[disturbed.axis] * energy
    i, j = disturbed.across
    curvatures = diff(kept, moving[i], 2) * diff(kept, moving[j], 2)
    return curvatures * disturbed.speed**2 / (moments[i] * moments[j]) ** 2


def _trace_of_squared_motion(disturbed: Disturbed) -> Expr:
    """Return the trace of the squared Jacobian of the angular accelerations, from particles, at the steady rotation.

    The eigenvalues of the Jacobian with respect to the components of omega are 0, i Omega and -i Omega.
    """
    torque = explicit(disturbed.by_particles())
    rates = [rate(w) for w in disturbed.moving]
    (solution,) = linsolve(list(torque), rates)
    flow = ImmutableDenseMatrix([[diff(a, w) for w in disturbed.moving] for a in solution])
    there = flow.xreplace(disturbed.steadily)
    return explicit(there * there).trace()


def _stability(value: Expr, disturbed: Disturbed) -> str:
    value = tidied(explicit(value))
    i, j = disturbed.across
    if is_zero(value):
        return "marginal"
    if is_zero(disturbed.moments[i] - disturbed.moments[j]):
        return "symmetric"
    if value.is_negative:
        return "unstable"
    if not value.is_positive:
        return "conditional"
    about = disturbed.moments[disturbed.axis]
    return "greatest" if tidied(about - disturbed.moments[i]).is_positive else "least"


PERTURBATION_RATE = Rule(
    "rotation.perturbation_rate",
    source="Landau, Lifshitz, *Mechanics*, section 37",
    outcomes={
        "stable": claims.root_is(False, "greatest", "least"),
        "symmetric": claims.root_is(False, "symmetric"),
        "conditional": claims.root_is(False, "conditional"),
        "unstable": claims.root_is(True, "unstable"),
    },
    evidence={"determinant": CHECK, "not_negative": CHECK},
)


def perturbation_rate(squared: Quantity, symbol: str | None = None, key: str = "perturbation_rate") -> Quantity:
    """Angular frequency of a perturbed rotation, Omega = sqrt(Omega^2); if Omega^2 is negative, the growth rate
    kappa = sqrt(-Omega^2).

    squared   the result of `perturbation_rate_squared`, 1/s^2

    Check: for components proportional to e^(i Omega t), or e^(kappa t), the determinant of the two linear equations is
    zero; and the rate is not negative.
    Outcomes: unstable (the result is kappa); stable, symmetric, conditional (the result is Omega).
    Errors: Omega^2 vanishes, so a perturbation grows at most linearly in time and has no frequency and no growth rate.
    Source: Landau, Lifshitz, *Mechanics*, section 37.
    """
    of, disturbed = squared.needed(WobbleOf), squared.needed(Disturbed)
    outcome = {"greatest": "stable", "least": "stable"}.get(squared.step.outcome, squared.step.outcome)
    if outcome == "marginal":
        message = (
            f"`{squared.key}` vanishes: a perturbation grows at most linearly in time, "
            "so it has no frequency and no growth rate"
        )
        raise Rejected(Complaint("no-rate", message))
    grows = outcome == "unstable"
    value = explicit(squared.value)

    def determinant(found: Expr) -> tuple[Expr, Expr]:
        i, j = disturbed.across
        square = found**2 if grows else -(found**2)
        lefts = [_left(equation) for equation in of.equations]
        u, v = disturbed.moving[i], disturbed.moving[j]
        (a, b), (c, d) = (
            (diff(lefts[0], rate(u)), diff(lefts[0], v)),
            (diff(lefts[1], rate(v)), diff(lefts[1], u)),
        )
        return a * c * square, b * d

    def not_negative(found: Expr) -> tuple[Expr, Expr]:
        """Compare the rate with its absolute value for one set of numbers for which Omega^2, or kappa^2, is positive.

        The determinant does not determine the sign of the rate. One set of numbers is enough, because the sign changes
        only where the rate vanishes.
        """
        letters = sorted(value.free_symbols, key=str)
        turned = (letters[turn:] + letters[:turn] for turn in range(len(letters) + 1))
        tried = ({letter: Rational(prime(n + 5), 7) for n, letter in enumerate(ordered)} for ordered in turned)
        square = -value if grows else value
        for there in chain(tried, trial_points(letters, Relation(square, ">", ZERO))):
            if square.subs(there).is_positive:
                here = found.subs(there)
                return here, Abs(here)
        return found, Abs(found)

    return establish(
        PERTURBATION_RATE,
        scalar(symbol or ("kappa" if grows else of.letter)),
        lambda square: Root(-square if grows else square),
        {"squared": squared},
        lines=Lines(put_in=None, arranged=lambda _: _root_of(-value if grows else value)),
        routes={"determinant": determinant, "not_negative": not_negative},
        outcome=outcome,
        phrase_data=PhraseData(words={"axis": AXES[disturbed.axis]}),
        key=key,
        kind="angular speed",
    )


def _root_of(square: Expr) -> Expr:
    return tidied(sqrt(tidied(square)))


BODY_CONE_RATE = Rule(
    "rotation.body_cone_rate",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6; Taylor, *Classical Mechanics*, section 10.8",
    outcomes={"oblate": claims.excess_is(1), "prolate": claims.excess_is(-1), "generic": claims.excess_is(None)},
    evidence={"angle": ROUTE},
    statements=[claims.rates_of_its_equations],
    named=dict.fromkeys(("along", "around", "beside"), claims.of_its_equation),
)


def body_cone_rate(equations: Sequence[Quantity], symbol: str = "Omega_b", key: str = "body_cone_rate") -> Quantity:
    """Rate at which omega rotates in a free symmetric body about its axis z, Omega_b = (I_z - I_x) omega_z/I_x.

    equations   Euler's equations in the order x, y, z, without torque, for a body with I_x = I_y

    Second route: the rate of the azimuth of omega, (omega_x omega_y_dot - omega_y omega_x_dot)/(omega_x^2 + omega_y^2),
    with the angular accelerations from the accelerations of particles.
    Outcomes: oblate (in the direction of omega_z, because I_z > I_x), prolate (in the opposite direction), generic (the
    direction depends on the moments).
    Errors: the moments about x and y differ; all three moments are equal; a torque acts.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6; Taylor, *Classical Mechanics*, section 10.8.
    """
    of = _rate_of(equations)
    x, y, z = of.moving
    lefts = [_left(equation) for equation in equations]
    if any(not is_zero(left.xreplace(dict.fromkeys((*of.moving, *map(rate, of.moving)), ZERO))) for left in lefts):
        raise Rejected(Complaint("not-free", "`body_cone_rate` needs a body without torque"))
    if not is_zero(diff(lefts[2], x, y)):  # I_y - I_x
        raise Rejected(Complaint("no-symmetry", "`body_cone_rate` needs a body whose moments about x and y are equal"))
    # I_x and I_z - I_x, as in I_x omega_y_dot - (I_z - I_x) omega_z omega_x = 0, or both divided by a positive factor
    across, coupling = tidied(diff(lefts[1], rate(y))), tidied(-diff(lefts[1], x, z))
    if is_zero(coupling):
        raise Rejected(Complaint("no-cone", "the three moments are equal, so the angular velocity is constant"))

    def rate_of_angle() -> Expr:
        torque = explicit(of.by_particles())
        (solution,) = linsolve(list(torque), [rate(w) for w in of.moving])
        return (x * solution[1] - y * solution[0]) / (x**2 + y**2)

    return establish(
        BODY_CONE_RATE,
        scalar(symbol),
        lambda: coupling * z / across if across.is_Symbol else Factors(Ratio(coupling, across), z),
        {},
        lines=Lines(put_in=None),
        routes={"angle": lambda found: (found, rate_of_angle())},
        outcome=_sense(coupling),
        phrase_data=PhraseData(
            points_to={"first": equations[0], "second": equations[1], "third": equations[2]},
            named={"along": z, "around": x, "beside": y},
            outcome_data={"excess": coupling},
        ),
        key=key,
        kind="angular speed",
        parents=list(equations),
        scope=Scope(coordinates=dict.fromkeys(of.moving, "angular speed")),
    )


def _sense(excess: Expr) -> str:
    excess = tidied(excess)
    return "oblate" if excess.is_positive else "prolate" if excess.is_negative else "generic"
