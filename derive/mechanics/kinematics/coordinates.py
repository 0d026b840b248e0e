"""Generalized coordinates, their rates, and the time derivatives of quantities that depend on them.

A coordinate q and its rates q_dot and q_ddot are plain symbols. `TimeRate` differentiates by the chain rule. Second
routes replace q by its Taylor series about the instant t.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

from sympy import (
    Derivative,
    Expr,
    Function,
    Integer,
    MatrixBase,
    Symbol,
    diff,
    factorial,
)

from derive.algebra.collect import by_rates, with_constants_in_front
from derive.algebra.expressions import RATES, TIME, Prescribed, TimeRate, explicit, rate, scalar
from derive.algebra.kinds import KINDS, dimension_of_kind, kind_of_dimension
from derive.algebra.taylor import NoSeries, taylor
from derive.errors import Complaint, Rejected
from derive.mechanics.in_results import in_results
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, establish
from derive.steps.record import coordinate_named
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Fact, Level, Quantity, compared_with

__all__ = ["Coordinate", "coordinate", "euler_angles", "function_of_time", "rate_of", "unknown"]

T = TIME  # in second routes, coordinates are functions of this symbol


@dataclass(frozen=True)
class Coordinate:
    """A generalized coordinate; in formulas it acts as its symbol: `l*sin(theta)`.

    symbol   the symbol of the coordinate
    kind     kind of quantity: `angle`, `length` and so on

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3.
    """

    symbol: Symbol
    kind: str
    held_as: ClassVar[str] = "COORDINATE"  # the name of the member of `Holds` for an argument of this type

    def _sympy_(self) -> Symbol:
        return self.symbol

    def __add__(self, other: Any) -> Any:
        return self.symbol + other

    def __sub__(self, other: Any) -> Any:
        return self.symbol - other

    def __rsub__(self, other: Any) -> Any:
        return other - self.symbol

    def __mul__(self, other: Any) -> Any:
        return self.symbol * other

    def __truediv__(self, other: Any) -> Any:
        return self.symbol / other

    def __rtruediv__(self, other: Any) -> Any:
        return other / self.symbol

    def __pow__(self, other: Any) -> Any:
        return self.symbol**other

    def __neg__(self) -> Any:
        return -self.symbol

    __radd__, __rmul__ = __add__, __mul__

    @property
    def rate(self) -> Symbol:
        return rate(self.symbol)

    @property
    def acceleration(self) -> Symbol:
        return rate(self.symbol, 2)

    @property
    def letters(self) -> dict[Symbol, str]:
        return {self.symbol: self.kind}


@dataclass(frozen=True)
class OfCoordinate(Fact):
    """The coordinate to which an equation, an acceleration or a momentum belongs."""

    missing = "is not an equation of one coordinate"
    coordinate: Coordinate


@dataclass(frozen=True)
class AtOneMoment(Fact):
    """The coordinates or rates whose values at one instant are substituted in a quantity. The rate of change of the
    quantity is then unknown."""

    missing = "holds at all times"
    fixed: tuple[Symbol, ...]


def require_all_times(verb: str, quantity: Quantity) -> None:
    """Reject a quantity that is known at one instant only, because its rate of change is unknown."""
    known = quantity.fact(AtOneMoment)
    if known is not None:
        message = f"`{verb}`: `{quantity.key}` is known only for one value of {known.fixed[0].name}"
        raise Rejected(Complaint("one-moment", message, help=f"use `{verb}` first, then `put_in`"))


def coordinate(name: str, kind: str = "angle", positive: bool = False) -> Coordinate:
    """Return a real coordinate with this name; `positive` is for a coordinate that is always positive, such as a
    distance."""
    found = Coordinate(scalar(name, positive=True) if positive else scalar(name), kind)
    coordinate_named(found.symbol, kind)
    return found


def function_of_time(name: str, kind: str = "length", positive: bool = False) -> Prescribed:
    """Return a prescribed function of the time, such as the position X(t) of a shaken support, m.

    name      the symbol of the function, such as X; the rates are then X_dot and X_ddot, in a script `X.rate()` and
              `X.rate(2)`
    kind      the kind of its values: `length`, `angle`, `force` and so on
    positive  whether its values are known to be positive, as for the length of a string

    A prescribed function is not an unknown: it has no equation of motion, and its derivative with respect to a
    coordinate vanishes.
    Source: Landau, Lifshitz, *Mechanics*, section 5.
    """
    if kind not in KINDS:
        message = f"`function_of_time`: there is no kind `{kind}`"
        raise Rejected(Complaint("unknown-kind", message, help=f"the kinds are {', '.join(KINDS)}"))
    return Prescribed(name, kind, positive)


def euler_angles() -> tuple[Coordinate, Coordinate, Coordinate]:
    """Return the Euler angles: precession phi, nutation theta and spin psi.

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.4.
    """
    return coordinate("phi"), coordinate("theta"), coordinate("psi")


def letters_of(coordinates: Iterable[Coordinate]) -> dict[Symbol, str]:
    """Return a mapping from symbol to kind for these coordinates, as steps store it."""
    return {q.symbol: q.kind for q in coordinates}


def kind_of_rate(kind: str) -> str:
    """Return the kind of a rate: speed for a length, angular speed for an angle or a number, torque for an
    angular momentum, and so on."""
    if kind in {"angle", "number", "angular momentum"}:
        return "torque" if kind == "angular momentum" else "angular speed"
    faster = kind_of_dimension(dimension_of_kind(kind) / dimension_of_kind("time"))
    if faster is None:
        message = f"no known kind of quantity is the rate of a quantity of the kind `{kind}`"
        raise Rejected(Complaint("no-such-kind", message))
    return faster


def changing(expr: Any, coordinates: Iterable[Symbol]) -> Any:
    """Replace each coordinate by a function of time, and its first two rates by derivatives of this function."""
    replaced: dict[Any, Any] = {}
    for q in coordinates:
        f = Function(q.name)(T)
        replaced.update({q: f, rate(q): Derivative(f, T), rate(q, 2): Derivative(f, (T, 2))})
    return explicit(expr).xreplace(replaced)


def unchanging(expr: Any, coordinates: Iterable[Symbol]) -> Any:
    """Replace functions of time and their derivatives by plain symbols: the inverse of `changing`."""
    replaced: dict[Any, Any] = {}
    for q in coordinates:
        f = Function(q.name)(T)
        replaced.update({Derivative(f, (T, 3)): rate(q, 3), Derivative(f, (T, 2)): rate(q, 2)})
        replaced.update({Derivative(f, T): rate(q), f: q})
    for derivative_or_function, name in replaced.items():  # the highest derivatives are replaced first
        expr = expr.xreplace({derivative_or_function: name})
    return expr


def by_functions_of_time(expr: Any, coordinates: Iterable[Symbol], order: int = 1) -> Any:
    """Differentiate `order` times with respect to t, with coordinates as functions of t: a second route to `TimeRate`.

    Each coordinate is replaced by its Taylor series about the instant t. If `expr` has no Taylor series, SymPy
    differentiates it.
    """
    coordinates, expr = list(coordinates), explicit(expr)
    if isinstance(expr, MatrixBase):
        return expr.applyfunc(lambda entry: by_functions_of_time(entry, coordinates, order))
    try:
        return taylor(expr, _series_of(tuple(coordinates)), order)[order] * factorial(order)
    except NoSeries:
        return unchanging(diff(changing(expr, coordinates), T, order), coordinates)


@lru_cache(maxsize=64)  # the second routes of one system all need the same series
def _series_of(coordinates: tuple[Symbol, ...]) -> dict[Symbol, tuple[Expr, ...]]:
    """Return the Taylor coefficients of t, of each coordinate and of each rate except the highest.

    The series of q is q + q_dot s + q_ddot s^2/2 + ..., up to the highest rate; the series of t is t + s.
    """
    series: dict[Symbol, tuple[Expr, ...]] = {T: (T, Integer(1), *(Integer(0) for _ in RATES[2:]))}
    for q in coordinates:
        rates = [q, *(rate(q, n) for n in range(1, len(RATES)))]
        for first in range(len(RATES) - 1):
            series[rates[first]] = tuple(each / factorial(n) for n, each in enumerate(rates[first:]))
    return series


RATE_OF = Rule(
    "kinematics.rate_of",
    source="Taylor, *Classical Mechanics*, section 7.1",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"functions_of_time": CHECK},
)


@in_results(
    "rate", "the rate of change of a motion that `solution` found, or of another answer", quantity="rate: an answer"
)
def rate_of(quantity: Quantity, key: str | None = None) -> Quantity:
    """Rate of change along the motion by the chain rule, dx/dt = sum of dx/dq q_dot.

    quantity   a scalar x that depends on coordinates; the unit of the result is the unit of x per second

    Check: replace each coordinate in x by its Taylor series in t, and differentiate with respect to t.
    Outcomes: generic, zero.
    Errors: the symbol of the quantity is not a plain symbol; the quantity is known at one instant only.
    Source: Taylor, *Classical Mechanics*, section 7.1.
    """
    require_all_times("rate_of", quantity)
    if not isinstance(quantity.symbol, Symbol) or isinstance(quantity.value, MatrixBase):
        message = (
            f"`rate_of` needs a scalar with a plain symbol, but `{quantity.key}` is a vector or has no plain symbol"
        )
        raise Rejected(Complaint("wrong-argument", message))
    moving = [q for q in quantity.coordinates if q != quantity.symbol]  # the value x(t) does not depend on x itself

    def by_time() -> Expr:
        return by_functions_of_time(quantity.value, moving)

    return establish(
        RATE_OF,
        rate(quantity.symbol),
        lambda x: TimeRate(x, *moving),
        {"quantity": quantity},
        lines=Lines(
            put_in=Level.FULL,
            law=Level.FULL,
            arranged=lambda value: with_constants_in_front(by_rates(value, moving), moving),
        ),
        routes={"functions_of_time": compared_with(by_time)},
        outcome=lambda value: "zero" if value == 0 else "generic",
        key=key or f"{quantity.key}_rate",
        kind=kind_of_rate(quantity.step.kind) if quantity.step.kind else None,
    )


def only_coordinate(quantity: Quantity) -> Symbol:
    """Return the only coordinate on which a quantity depends."""
    found = [q for q in quantity.coordinates if quantity.value.has(q, rate(q), rate(q, 2))]
    if len(found) != 1:
        names = ", ".join(q.name for q in found) or "none"
        message = f"`{quantity.key}` must depend on one coordinate, but depends on {names}"
        raise Rejected(Complaint("wrong-argument", message))
    return found[0]


def required(coordinates: Mapping[Symbol, str], q: Coordinate, verb: str, quantity: Quantity) -> None:
    """Reject a coordinate on which the quantity does not depend."""
    if q.symbol not in coordinates:
        known = ", ".join(s.name for s in coordinates) or "none"
        message = f"`{verb}`: `{quantity.key}` does not depend on the coordinate {q.symbol.name}"
        raise Rejected(Complaint("wrong-argument", message, help=f"it depends on {known}"))


def unknown(name: str, kind: str, positive: bool = False) -> Symbol:
    """Return an unknown of the script, such as a tension, a constraint force or a height; an unknown may vary in time.

    name       the symbol of the unknown
    kind       the kind of quantity, such as "force"
    positive   whether the unknown is positive; only positive roots are then valid
    """
    if kind not in KINDS:
        message = f"`unknown`: there is no kind `{kind}`"
        raise Rejected(Complaint("unknown-kind", message, help=f"the kinds are {', '.join(KINDS)}"))
    letter = scalar(name, positive=True) if positive else scalar(name)
    coordinate_named(letter, kind)
    return letter
