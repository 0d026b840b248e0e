"""Steady precession of a symmetric top: constant tilt, constant rate about the vertical; how many rates there are."""

from __future__ import annotations

from sympy import Abs, Expr, Integer, Mul, cos, sin, sqrt

from derive.algebra.collect import by_rates
from derive.algebra.expressions import PLUS_MINUS, CarriedRate, Relation, Terms, column, explicit, rate, scalar, scaled
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.equations.inequalities import of_the_size, positive_where
from derive.mechanics.equations.quadratics import Quadratic, Roots, discriminant, roots_of
from derive.mechanics.tops.top import ConstantSpin, EulerAngles, HeavyTop
from derive.steps.establish import Lines, Telling, establish
from derive.steps.known_numbers import sign_known, with_numbers
from derive.steps.record import require_constant
from derive.steps.step import Form, Quantity, compared_with, only_equation

__all__ = ["no_steady_precession", "precession_condition", "precession_rates", "steady_precession", "steady_rates"]

ZERO = Integer(0)
RATES, CONDITION, SLOW, FAST = "precession_rates", "precession_condition", "slow_precession", "fast_precession"


def steady_precession(tilt: Quantity, key: str = "steady_precession") -> Quantity:
    """Equation of the rate of steady precession, I_x cos theta phi_dot^2 - I_z S phi_dot + M g l = 0.

    tilt   the equation of motion of the tilt at constant spin; theta and phi_dot are constant now, and the axis is
           not vertical, so that sin theta does not vanish
    Second route: the angular momentum carried round the vertical by a rotation at the rate phi_dot and differentiated
    is the torque of the weight.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    angles = tilt.needed(EulerAngles)
    phi, theta, _ = angles.coordinates
    heavy, spin = tilt.needed(HeavyTop), tilt.needed(ConstantSpin).rate
    top, gravity = heavy.top, heavy.gravity
    sine = sin(theta.symbol)
    at_rest = tilt.value.left.xreplace({theta.acceleration: ZERO, theta.rate: ZERO})
    kept = by_rates(-(at_rest / sine).expand(), [phi.symbol])
    in_powers = Terms(*(kept.coeff(phi.rate, n) * phi.rate**n for n in (2, 1, 0)))

    def by_carrying(found: Relation) -> tuple[Relation, Relation]:
        round_vertical = scaled(phi.rate, column(0, sine, cos(theta.symbol)))
        momentum = top.momentum(column(0, phi.rate * sine, spin))
        changing = explicit(CarriedRate(momentum, explicit(round_vertical)))[0]
        here = only_equation(found)
        carried = Relation(top.torque(gravity, theta.symbol) - changing, "=", 0)
        return Relation(here.residual * sine, "=", 0), carried

    return establish(
        "precession.steady_precession",
        None,
        lambda *_: Relation(at_rest, "=", 0),
        {"tilt": theta.symbol, "rate": phi.rate},
        telling=Telling(formulas={"sine": (sine, tidied(-at_rest / kept))}, points_to={"of_tilt": tilt}),
        lines=Lines(
            put_in=None,
            after=[Form(Relation(in_powers, "=", 0), "divided", nonzero=(sine,))],
            result=False,
            arranged=lambda _: Relation(kept, "=", 0),
        ),
        routes={"carried_round": by_carrying},
        key=key,
        parents=[tilt],
        facts=tilt.facts,
    )


def _fixed_tilt(tilt: Expr, angles: EulerAngles, key: str = "tilt") -> Quantity:
    """The tilt at which the top precesses, theta = theta_0: a definition."""
    return establish(
        "precession.fixed_tilt",
        angles.theta.symbol,
        lambda: tilt,
        {},
        telling=Telling(judged_by={"given": tilt, "tilt": angles.names[1]}),
        key=key,
        definition=True,
        kind="angle",
    )


def precession_rates(steady: Quantity, tilt: Expr, key: str = RATES) -> Quantity:
    """Rates of steady precession at a tilt, (I_z S +- sqrt(I_z^2 S^2 - 4 I_x cos theta M g l))/(2 I_x cos theta).

    steady   the equation of steady precession, as `steady_precession` yields it
    tilt     theta, not vertical; at 90 degrees the equation is linear, and there is one rate
    Second route: put back into the equation; their sum.
    Outcomes: those of `roots_of`.
    Errors: the axis is vertical.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    angles, top = steady.needed(EulerAngles), steady.needed(HeavyTop).top
    if sign_known(sin(tilt)) == 0:
        message = "`precession_rates`: the axis is vertical, so that it has no rate of precession"
        raise Rejected(Complaint("vertical", message, help="give a tilt between 0 and 180 degrees"))
    require_constant("precession_rates", "tilt", tilt)
    held = [] if tilt == angles.theta.symbol else [_fixed_tilt(tilt, angles)]
    instead = (CONDITION, SLOW, FAST)
    unknown = angles.phi.rate
    return roots_of(steady, unknown, *held, *top.values, key=key, kind="angular speed", one_stands_for=instead)


def precession_condition(rates: Quantity, spin: Expr, key: str = CONDITION) -> Quantity:
    """Condition for steady precession, I_z^2 S^2 >= 4 I_x cos theta M g l, solved for the spin.

    rates   as `precession_rates` yields them
    spin    S, the letter to solve for
    Second route: the sign of the discriminant where S is a little above the bound, and a little below.
    Outcomes: those of `positive_where`; where there is one rate anyway, the rates themselves.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    if rates.needed(Roots).quadratic.is_linear:
        return rates
    return positive_where(discriminant(rates), spin, or_zero=True, key=key)


def steady_rates(rates: Quantity, condition: Quantity) -> tuple[Quantity, Quantity]:
    """The slow and the fast rate of steady precession, each by itself, where there are two.

    rates       as `precession_rates` yields them
    condition   as `precession_condition` yields it
    Slow is the rate that is smaller in size.
    Second route: put back into the equation; 2 c/(-b +- sqrt(b^2 - 4 a c)), in
    which the smaller root is the one with the larger denominator.
    Outcomes: slow and fast, both with `_where_real` if that depends on letters; forward and backward; coinciding; and
    one step for both where there is no rate, or only one.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    quadratic = rates.needed(Roots).quadratic
    if quadratic.is_linear:
        return rates, rates
    real = sign_known(quadratic.discriminant)
    if real == -1:
        none = no_steady_precession(rates, condition)
        return none, none
    forward = -1 if sign_known(quadratic.b) == 1 else 1
    if real == 0:
        both = _steady_rate(rates, condition, -forward, "coinciding", SLOW, stands_for=(FAST,))
        return both, both
    slow, fast = _called(quadratic, real)
    return (
        _steady_rate(rates, condition, -forward, slow, SLOW),
        _steady_rate(rates, condition, forward, fast, FAST),
    )


def _called(quadratic: Quadratic, real: int | None) -> tuple[str, str]:
    """The words for the two rates: of opposite signs, or of one, where they are known to be real."""
    if real is None:
        return "slow_where_real", "fast_where_real"
    return ("forward", "backward") if sign_known(quadratic.a * quadratic.c) == -1 else ("slow", "fast")


def _steady_rate(
    rates: Quantity, condition: Quantity, sign: int, outcome: str, key: str, stands_for: tuple[str, ...] = ()
) -> Quantity:
    """One of the two rates, that with the sign.

    Outcomes: slow, fast, slow_where_real, fast_where_real, forward, backward, coinciding.
    Source: as `steady_rates`.
    """
    quadratic = rates.needed(Roots).quadratic
    name = key.partition("_")[0]

    def other_form() -> Expr:
        return 2 * quadratic.c / (-quadratic.b - sign * sqrt(quadratic.discriminant))

    return establish(
        "precession.steady_rate",
        rate(scalar(f"phi_{name}")),
        lambda _: _of_sign(rates.value, sign),
        {"rates": rates},
        lines=Lines(put_in=None, arranged=lambda _: _of_sign(rates.value, sign)),
        routes={
            "put_back": lambda found: (quadratic.at(found), ZERO),
            "other_form": compared_with(other_form),
        },
        outcome=outcome,
        telling=Telling(judged_by={"quadratic": quadratic}, points_to={"condition": condition}, stands_for=stands_for),
        key=key,
        kind="angular speed",
        parents=[rates, condition],
    )


def _of_sign(both: Expr, sign: int) -> Expr:
    """The formula with one of the two signs, still one product."""
    factors = [factor.xreplace({PLUS_MINUS: Integer(sign)}) for factor in Mul.make_args(both)]
    return Mul(*factors, evaluate=False) if len(factors) > 1 else factors[0]


def no_steady_precession(rates: Quantity, condition: Quantity, key: str = "no_steady_precession") -> Quantity:
    """That there is no steady precession at this tilt: the spin is below its least value, S < S_0.

    rates       as `precession_rates` yields them
    condition   S >= S_0, as `precession_condition` yields it
    Second route: the discriminant with the numbers that are given, which is negative; at the bound it vanishes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    quadratic = rates.needed(Roots).quadratic

    def by_numbers(found: Relation) -> tuple[Expr, Expr]:
        here = with_numbers(quadratic.discriminant)
        below = with_numbers(found.residual)
        return here + below, -Abs(here) + of_the_size(below, found.mark)

    def at_the_bound(found: Relation) -> tuple[Expr, Expr]:
        return explicit(quadratic.discriminant).xreplace({found.left: found.right}), Integer(0)

    return establish(
        "precession.no_steady_precession",
        None,
        lambda: Relation(condition.value.left, "<", condition.value.right),
        {},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"numbers": by_numbers, "bound": at_the_bound},
        key=key,
        parents=[rates, condition],
        telling=Telling(points_to={"condition": condition}, stands_for=(SLOW, FAST)),
    )
