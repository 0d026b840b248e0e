"""Small oscillations about an equilibrium: the linear equation of motion and its frequency."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Abs, Add, Expr, I, Integer, Pow, Rational, Symbol, cos, diff, exp, prime, sqrt

from derive.algebra.collect import spread
from derive.algebra.equality import equal
from derive.algebra.expressions import Ratio, Relation, Root, explicit, rate, scalar, stand_in
from derive.algebra.ranges import rational_in_range, settled, strict_sign_within
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.systems.coordinates import OfCoordinate, T
from derive.mechanics.systems.lagrangian import FromLagrangian
from derive.steps.establish import Lines, Telling, establish
from derive.steps.record import require_constant
from derive.steps.step import Fact, Quantity, compared_with

__all__ = ["frequency", "frequency_squared"]


@dataclass(frozen=True)
class SquareOf(Fact):
    """The letter of what this is the square of."""

    missing = "is not the square of a frequency"
    letter: str


def linearised(equation: Quantity, at: Expr | None = None, key: str = "linearised") -> Quantity:
    """Equation of motion to first order in the displacement q from equilibrium, m q_ddot + k q = 0.

    equation   of one coordinate, as `equation_of_motion` yields it
    at         the value of the coordinate in equilibrium, 0 unless given; q is then measured from there
    Second route: mass and stiffness as second derivatives of the Lagrangian, by the rate and by the coordinate.
    Outcomes: generic, displaced (the equilibrium is not at 0).
    Errors: the value is no equilibrium; another coordinate occurs in the equation.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    q, place = equation.needed(OfCoordinate).coordinate.symbol, at if at is not None else Integer(0)
    others = [c for c in equation.coordinates if c != q and equation.value.left.has(c, rate(c), rate(c, 2))]
    if others:
        message = f"`linearised` needs an equation of {q.name} alone, but `{equation.key}` also has {others[0].name}"
        raise Rejected(Complaint("wrong-argument", message))
    small = stand_in("epsilon")
    moved = equation.value.left.xreplace(
        {q: place + small * q, rate(q): small * rate(q), rate(q, 2): small * rate(q, 2)}
    )
    if not equal(moved.subs(small, 0), 0):
        message = f"`{equation.key}` is not in equilibrium at {q.name} = {place}"
        raise Rejected(Complaint("no-equilibrium", message))
    first = diff(moved, small).subs(small, 0)

    def of_second_order() -> Relation:
        energies = explicit(equation.needed(FromLagrangian).lagrangian.value)
        at_rest = {q: place, rate(q): Integer(0)}
        mass, stiffness = energies.diff(rate(q), 2).subs(at_rest), -energies.diff(q, 2).subs(at_rest)
        return Relation(mass * rate(q, 2) + stiffness * q, "=", 0)

    return establish(
        "oscillations.linearised",
        None,
        lambda _: Relation(_mass_and_stiffness(first, q), "=", 0),
        {"q": q},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"second_order": compared_with(of_second_order)},
        outcome="generic" if place == 0 else "displaced",
        telling=Telling(judged_by={"place": place}),
        key=key,
        parents=[equation],
        facts=[equation.needed(OfCoordinate)],
    )


def _mass_and_stiffness(left: Expr, q: Symbol) -> Expr:
    terms = [spread(diff(left, rate(q, 2))) * rate(q, 2), spread(diff(left, q)) * q]
    return Add(*(term for term in terms if term != 0), evaluate=False)


def frequency_squared(linear: Quantity, symbol: str = "omega_0", key: str = "frequency_squared") -> Quantity:
    """Square of the frequency of small oscillations, omega_0^2 = k/m, in 1/s^2.

    linear   the equation m q_ddot + k q = 0, as `linearised` yields it
    Second route: q = cos(omega_0 t) put back into the equation.
    Outcomes: stable (positive), unstable (negative), neutral (zero), conditional (its sign depends on the letters).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    q = linear.needed(OfCoordinate).coordinate.symbol
    left = linear.value.left
    stiffness, mass = spread(diff(left, q)), spread(diff(left, rate(q, 2)))
    damping = diff(left, rate(q))
    if mass == 0 or damping != 0 or (left - stiffness * q - mass * rate(q, 2)).expand() != 0:
        message = f"`frequency_squared` needs an equation m q_ddot + k q = 0, which `{linear.key}` is not"
        raise Rejected(Complaint("wrong-argument", message))
    for role, coefficient in (("stiffness", stiffness), ("inertia", mass)):
        require_constant("frequency_squared", role, coefficient)
    trial = stand_in("w", positive=True)

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        swing = cos(trial * T)
        left_side = left.subs({rate(q, 2): diff(swing, T, 2), q: swing})
        return left_side.expand().subs(trial**2, found), Integer(0)

    return establish(
        "oscillations.frequency_squared",
        Pow(scalar(symbol), 2),
        lambda _: Ratio(stiffness, mass),
        {"q": q},
        lines=Lines(
            put_in=None,
            arranged=explicit if stiffness.has(Add) else tidied,
            means={scalar(symbol): sqrt(Ratio(stiffness, mass).doit())},
        ),
        routes={"put_back": put_back},
        outcome=sign_of,
        key=key,
        kind="squared angular speed",
        parents=[linear],
        telling=Telling(points_to={"linear": linear}),
        facts=[SquareOf(symbol)],
    )


def sign_of(value: Expr) -> str:
    """What is known of the sign of omega_0^2, or of the curvature of a potential."""
    value = tidied(value)
    if value == 0:
        return "neutral"
    return {1: "stable", -1: "unstable", None: "conditional"}[strict_sign_within(value)]


def frequency(squared: Quantity, symbol: str | None = None, key: str = "frequency") -> Quantity:
    """Angular frequency of small oscillations, omega_0 = sqrt(omega_0^2); where that is negative, the rate of growth.

    squared   as `frequency_squared` yields it, 1/s^2
    Second route: cos(omega_0 t), or e^(kappa t), satisfies q_ddot + omega_0^2 q = 0, and it is the positive root.
    Outcomes: stable, conditional, neutral (zero), unstable (the rate kappa of growth).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1.
    """
    outcome = sign_of(squared.value)
    grows = outcome == "unstable"
    name = symbol or ("kappa" if grows else squared.needed(SquareOf).letter)
    trial = stand_in("w", positive=True)

    def satisfies(found: Expr) -> tuple[Expr, Expr]:
        motion = exp(trial * T) if grows else cos(trial * T)
        left = diff(motion, T, 2) / motion + squared.value
        return left.expand().subs(trial**2, found**2), Integer(0)

    def positive_root(found: Expr) -> tuple[Expr, Expr]:
        """Neither motion knows the sign of its rate. It cannot change unless the root vanishes: one place tells."""
        letters = sorted(squared.value.free_symbols, key=str)
        there = {letter: rational_in_range(letter, Rational(prime(n + 5), 7)) for n, letter in enumerate(letters)}
        imaginary = not grows and squared.value.subs(there).is_negative
        value = found.subs(there) / (I if imaginary else 1)
        return value, Abs(value)

    return establish(
        "oscillations.frequency",
        scalar(name),
        lambda square: Root(-square if grows else square),
        {"squared": squared},
        lines=Lines(put_in=None, arranged=lambda value: settled(explicit(value))),
        routes={"motion": satisfies, "positive": positive_root},
        outcome=outcome,
        key=key,
        kind="angular speed",
    )
