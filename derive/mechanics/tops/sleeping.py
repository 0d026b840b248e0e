"""The sleeping top: whether an upright top that spins stays upright, by the potential energy that its tilt sees.

The upright state itself decides: the equation of steady precession was divided by sin theta and says nothing of it.
"""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Dummy, Expr, I, Integer, Matrix, Rational, Symbol, cos, diff, exp, nan, sin

from derive.algebra.expressions import Ratio, Relation, Terms, column, explicit, scalar
from derive.algebra.expressions import rate as rate_name
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.equations.inequalities import boundary_case, sign_by_factors, truth
from derive.mechanics.equations.stability import HIGHEST, LowestOrder
from derive.mechanics.systems.coordinates import Coordinate, T
from derive.mechanics.systems.cyclic import OfMomentum
from derive.mechanics.tops.top import ConstantSpin, EulerAngles, HeavyTop, Top
from derive.steps.establish import Lines, Telling, establish
from derive.steps.step import Quantity, Route

__all__ = ["sleeping_spin", "tilt_potential", "upright_rate"]

HALF = Rational(1, 2)


def upright_rate(conserved: Quantity, tilt: Quantity, key: str = "upright_rate") -> Quantity:
    """Rate of precession of a top that can stand upright, phi_dot = I_z S (1 - cos theta)/(I_x sin^2 theta).

    conserved   d/dt of the momentum that belongs to phi, which vanishes; upright this momentum is I_z S
    tilt        the equation of motion of the tilt at constant spin
    Second route: put into the momentum dL/dphi_dot, it gives I_z S at every tilt; the vertical component of the
    angular momentum, turned into space, is the same at every tilt.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    angles, top, spin = _facts(tilt)
    phi, theta, psi = angles.coordinates
    along, across = top.along.symbol, top.across.symbol
    carried = along * spin
    of_phi = explicit(conserved.needed(OfMomentum).momentum.value)
    upright = of_phi.subs(theta.symbol, 0).xreplace({psi.rate: spin - phi.rate})

    def by_momentum(found: Expr) -> tuple[Expr, Expr]:
        momentum = explicit(conserved.needed(OfMomentum).momentum.value)
        return momentum.xreplace({psi.rate: spin - phi.rate * cos(theta.symbol)}).xreplace({phi.rate: found}), carried

    def by_vertical_component(found: Expr) -> tuple[Expr, Expr]:
        momentum = top.momentum(column(theta.rate, found * sin(theta.symbol), spin))
        in_space = (angles.following * Matrix(momentum))[2]
        return in_space, in_space.subs(theta.symbol, 0)

    return establish(
        "sleeping.upright_rate",
        phi.rate,
        lambda *_: Ratio(Terms(carried, -carried * cos(theta.symbol)), across * sin(theta.symbol) ** 2),
        {},
        telling=Telling(
            formulas={
                "sine": (sin(theta.symbol), (angles.following.T * Matrix([0, 0, 1]))[1]),
                "carried": (carried, upright),
            },
            judged_by={"cyclic": dict(conserved.step.roles)["coordinate"]},
            points_to={"conserved": conserved},
        ),
        lines=Lines(put_in=None, arranged=lambda _: carried / (across * (1 + cos(theta.symbol)))),
        routes={"momentum": by_momentum, "vertical_component": by_vertical_component},
        key=key,
        kind="angular speed",
        parents=[conserved, tilt],
        facts=tilt.facts,
    )


def _facts(quantity: Quantity) -> tuple[EulerAngles, Top, Expr]:
    return quantity.needed(EulerAngles), quantity.needed(HeavyTop).top, quantity.needed(ConstantSpin).rate


def tilt_potential(
    rate: Quantity, kinetic: Quantity, potential: Quantity, symbol: str = "V", key: str = "effective_potential"
) -> Quantity:
    """Potential energy that the tilt sees, V = (1/2) I_x phi_dot^2 sin^2 theta + U: E = (1/2) I_x theta_dot^2 + V
    + (1/2) I_z S^2 is the energy then.

    rate        phi_dot of a top that can stand upright, as `upright_rate` yields it
    kinetic     T of the top, J
    potential   U of its weight, J
    Second route: -dV/dtheta is what the equation of motion of the tilt has for I_x theta_ddot; T + U with these rates
    is the energy.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    angles, top, spin = _facts(rate)
    phi, theta, psi = angles.coordinates
    q = theta.symbol
    rates = {psi.rate: spin - rate.value * cos(q), phi.rate: rate.value}
    moving, constant = HALF * top.across.symbol * theta.rate**2, HALF * top.along.symbol * spin**2
    motion = next(parent for parent in rate.parents if parent.fact(HeavyTop))

    def by_motion(found: Expr) -> tuple[Expr, Expr]:
        accelerated = motion.value.left.xreplace({theta.acceleration: Integer(0)})
        return diff(found, q), accelerated.xreplace(rates)

    def by_energy(found: Expr) -> tuple[Expr, Expr]:
        whole = explicit(kinetic.value + potential.value).xreplace(rates)
        return found + moving + constant, whole

    return establish(
        "sleeping.effective_potential",
        scalar(symbol),
        lambda turning, weight, *_: Terms(HALF * top.across.symbol * turning**2 * sin(q) ** 2, weight),
        {"rate": rate, "potential": potential},
        telling=Telling(
            formulas={
                "moving": (moving, _tilting(kinetic.value, theta)),
                "constant": (constant, _of_spin(kinetic.value, rates, q)),
            }
        ),
        lines=Lines(put_in=None, arranged=lambda _: _of_carried(top, spin, q) + potential.value),
        routes={"motion": by_motion, "energy": by_energy},
        key=key,
        kind="energy",
        parents=[kinetic],
        facts=rate.facts,
    )


def _tilting(energy: Expr, theta: Coordinate) -> Expr:
    """What of the kinetic energy goes with the square of the rate of the tilt."""
    return explicit(energy).expand().coeff(theta.rate, 2) * theta.rate**2


def _of_spin(energy: Expr, rates: Mapping[Symbol, Expr], q: Symbol) -> Expr:
    """The kinetic energy of the upright top, which has no other than that of its spin."""
    return explicit(energy).xreplace(dict(rates)).xreplace({rate_name(q): Integer(0)}).subs(q, 0)


def _of_carried(top: Top, spin: Expr, q: Symbol) -> Expr:
    """The part of the potential that the spin makes."""
    return (top.along.symbol * spin) ** 2 * (1 - cos(q)) / (2 * top.across.symbol * (1 + cos(q)))


def sleeping_spin(condition: Quantity, border: Quantity, potential: Quantity, key: str = "sleeping_spin") -> Quantity:
    """Condition for a top to sleep, S >= S_0, or S > S_0 if it does not sleep at the border itself.

    condition   S > S_0, where the curvature of the potential at the top is positive
    border      the shape of the potential at S = S_0, as `leading_order` yields it
    potential   the effective potential, which knows the top
    Second route: small tilts u and v in space along x and y; the torque of the weight is the rate of the angular
    momentum; a tilt that goes round as e^(i p t) does so at two real rates p above the border, which coincide at it and
    are not real below.
    Outcomes: with_border, without_border.
    Errors: the condition has no border.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    case = boundary_case(condition)
    if case is None:
        raise Rejected(Complaint("no-border", f"`{condition.key}` has no border, so there is no least spin"))
    least, tilt = case.right, potential.needed(EulerAngles).theta.symbol
    sleeps = border.needed(LowestOrder).is_minimum
    least_there = _has_minimum(explicit(border.value), tilt)

    def beside(side: int) -> Route:
        """Whether the condition is true beside its bound, and whether small circles about the vertical last there."""

        def compared(found: Relation) -> tuple[Expr, Expr]:
            there = found.right * (1 + Dummy("u", positive=True)) ** side
            apart = sign_by_factors(tidied(_difference_of_rates(potential, found.left, there)))
            lasts = {1: Integer(1), -1: Integer(0), 0: Integer(int(least_there))}
            return truth(found.mark, there - found.right), nan if apart is None else lasts[apart]

        return compared

    return establish(
        "sleeping.sleeping_spin",
        None,
        lambda: Relation(condition.value.left, ">=" if sleeps else ">", least),
        {},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"at_border": beside(0), "above": beside(1), "below": beside(-1)},
        outcome="with_border" if sleeps else "without_border",
        key=key,
        parents=[condition, border],
    )


def _has_minimum(value: Expr, q: Symbol) -> bool:
    """Whether the first derivative that does not vanish at q = 0 is of even order and positive."""
    for n in range(1, HIGHEST + 1):
        there = tidied(diff(value, q, n).subs(q, 0))
        if there != 0:
            return n % 2 == 0 and bool(there.is_positive)
    return False


def _difference_of_rates(potential: Quantity, letter: Symbol, value: Expr) -> Expr:
    """The square of the difference of the two rates p at which small tilts go round, times I_x^2.

    The axis is (u, v, 1) to first order; its angular momentum I_x (axis x d axis/dt) + I_z S axis, the torque of the
    weight l axis x (0, 0, -M g). Of u + i v = e^(i p t), the first two components leave a quadratic in p.
    """
    _, top, spin = _facts(potential)
    gravity = potential.needed(HeavyTop).gravity
    p, small = Symbol("p", real=True), Symbol("epsilon", real=True)
    axis = Matrix([small * cos(p * T), small * sin(p * T), 1])
    momentum = top.across.symbol * axis.cross(diff(axis, T)) + top.along.symbol * spin * axis
    torque = top.distance.symbol * axis.cross(Matrix([0, 0, -top.mass.symbol * gravity]))
    first = diff(diff(momentum, T) - torque, small).subs(small, 0)
    round_trip = ((first[0] + I * first[1]) * exp(-I * p * T)).rewrite(exp).expand().subs(T, 0)
    quadratic = (round_trip / I).expand().as_poly(p)
    a, b, c = quadratic.all_coeffs()
    values = {q.symbol: q.value for q in top.values}
    return tidied((b**2 - 4 * a * c).xreplace(values).subs(letter, value))
