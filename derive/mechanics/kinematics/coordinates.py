"""Generalized coordinates: what varies in a motion, its rates, and how anything that depends on it changes in time.

A coordinate q is a plain name, and so are its rates q_dot and q_ddot: `TimeRate` differentiates by the chain rule. The
second route makes q a function of t, by its Taylor series about the moment t.
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

from derive.algebra.collect import by_rates
from derive.algebra.expressions import RATES, TIME, TimeRate, explicit, rate, scalar
from derive.algebra.kinds import KINDS, dimension_of_kind, kind_of_dimension
from derive.algebra.taylor import NoSeries, taylor
from derive.errors import Complaint, Rejected
from derive.mechanics.in_results import in_results
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, establish
from derive.steps.record import coordinate_named
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Fact, Level, Quantity, compared_with

__all__ = ["Coordinate", "coordinate", "euler_angles", "rate_of", "unknown"]

T = TIME  # coordinates are functions of it where a second route makes them so


@dataclass(frozen=True)
class Coordinate:
    """A generalized coordinate, which stands in formulas as its letter does: `l*sin(theta)`.

    symbol   its name
    kind     `angle`, `length`, or another kind of quantity that varies
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.3.
    """

    symbol: Symbol
    kind: str
    held_as: ClassVar[str] = "COORDINATE"  # by a key of `results:`

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
    """The coordinate that an equation of motion, or a momentum, belongs to."""

    missing = "is not an equation of one coordinate"
    coordinate: Coordinate


@dataclass(frozen=True)
class AtOneMoment(Fact):
    """That these coordinates, or their rates, have the values of one moment: how it changes is no longer told."""

    missing = "holds at all times"
    fixed: tuple[Symbol, ...]


def require_all_times(verb: str, quantity: Quantity) -> None:
    """Refuse what is known at one moment only, where a law asks how it changes."""
    known = quantity.fact(AtOneMoment)
    if known is not None:
        message = f"`{verb}`: `{quantity.key}` is known only where {known.fixed[0].name} was put in"
        raise Rejected(Complaint("one-moment", message, help=f"`{verb}` first, then `put_in`"))


def coordinate(name: str, kind: str = "angle", positive: bool = False) -> Coordinate:
    """A coordinate by name, real, free to vary; `positive` where it is a distance, which cannot be negative."""
    found = Coordinate(scalar(name, positive=True) if positive else scalar(name), kind)
    coordinate_named(found.symbol, kind)
    return found


def euler_angles() -> tuple[Coordinate, Coordinate, Coordinate]:
    """Precession phi, tilt theta and spin psi. Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.4."""
    return coordinate("phi"), coordinate("theta"), coordinate("psi")


def letters_of(coordinates: Iterable[Coordinate]) -> dict[Symbol, str]:
    """Each coordinate's name with its kind, as steps keep them."""
    return {q.symbol: q.kind for q in coordinates}


def kind_of_rate(kind: str) -> str:
    """A length changes at a speed, an angle at an angular speed, an angular momentum by a torque."""
    if kind in {"angle", "number", "angular momentum"}:
        return "torque" if kind == "angular momentum" else "angular speed"
    faster = kind_of_dimension(dimension_of_kind(kind) / dimension_of_kind("time"))
    if faster is None:
        raise Rejected(Complaint("no-such-kind", f"the rate of a quantity of the kind `{kind}` has no name"))
    return faster


def changing(expr: Any, coordinates: Iterable[Symbol]) -> Any:
    """The expression with every coordinate, and its rates, as functions of the time and their derivatives."""
    replaced: dict[Any, Any] = {}
    for q in coordinates:
        f = Function(q.name)(T)
        replaced.update({q: f, rate(q): Derivative(f, T), rate(q, 2): Derivative(f, (T, 2))})
    return explicit(expr).xreplace(replaced)


def unchanging(expr: Any, coordinates: Iterable[Symbol]) -> Any:
    """The way back: functions of the time, and their derivatives, as plain names."""
    replaced: dict[Any, Any] = {}
    for q in coordinates:
        f = Function(q.name)(T)
        replaced.update({Derivative(f, (T, 3)): rate(q, 3), Derivative(f, (T, 2)): rate(q, 2)})
        replaced.update({Derivative(f, T): rate(q), f: q})
    for derivative_or_function, name in replaced.items():  # the highest derivatives first
        expr = expr.xreplace({derivative_or_function: name})
    return expr


def by_functions_of_time(expr: Any, coordinates: Iterable[Symbol], order: int = 1) -> Any:
    """The n-th time derivative with every coordinate a function of t: the second route to what `TimeRate` yields.

    By the Taylor series of the coordinates about the moment t, or, where a function has none here, by SymPy.
    """
    coordinates, expr = list(coordinates), explicit(expr)
    if isinstance(expr, MatrixBase):
        return expr.applyfunc(lambda entry: by_functions_of_time(entry, coordinates, order))
    try:
        return taylor(expr, _series_of(tuple(coordinates)), order)[order] * factorial(order)
    except NoSeries:
        return unchanging(diff(changing(expr, coordinates), T, order), coordinates)


@lru_cache(maxsize=64)  # all routes of one system have the same coordinates
def _series_of(coordinates: tuple[Symbol, ...]) -> dict[Symbol, tuple[Expr, ...]]:
    """q + q_dot s + q_ddot s^2/2 + ... about the moment t, as far as the rates have names, and those of the rates."""
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


@in_results("rate", "how fast a motion that `solution` found, or another answer, changes", quantity="rate: an answer")
def rate_of(quantity: Quantity, key: str | None = None) -> Quantity:
    """Rate of change along the motion, dx/dt, by the chain rule: the sum of dx/dq q_dot.

    quantity   a scalar that depends on coordinates; its unit per second is that of the result
    Check: the coordinates as functions of t, each by its Taylor series.
    Outcomes: generic, zero.
    Errors: the quantity has no plain letter as its name; it is known at one moment only.
    Source: Taylor, *Classical Mechanics*, section 7.1.
    """
    require_all_times("rate_of", quantity)
    if not isinstance(quantity.symbol, Symbol) or isinstance(quantity.value, MatrixBase):
        raise Rejected(Complaint("wrong-argument", f"`{quantity.key}` has no letter that could take a dot"))
    moving = [q for q in quantity.coordinates if q != quantity.symbol]  # a motion is known as a function of the time

    def by_time() -> Expr:
        return by_functions_of_time(quantity.value, moving)

    return establish(
        RATE_OF,
        rate(quantity.symbol),
        lambda x: TimeRate(x, *moving),
        {"quantity": quantity},
        lines=Lines(put_in=Level.FULL, law=Level.FULL, arranged=lambda value: by_rates(value, moving)),
        routes={"functions_of_time": compared_with(by_time)},
        outcome=lambda value: "zero" if value == 0 else "generic",
        key=key or f"{quantity.key}_rate",
        kind=kind_of_rate(quantity.step.kind) if quantity.step.kind else None,
    )


def only_coordinate(quantity: Quantity) -> Symbol:
    """The one coordinate that a quantity depends on."""
    found = [q for q in quantity.coordinates if quantity.value.has(q, rate(q), rate(q, 2))]
    if len(found) != 1:
        names = ", ".join(q.name for q in found) or "none"
        raise Rejected(Complaint("wrong-argument", f"`{quantity.key}` must depend on one coordinate, but has {names}"))
    return found[0]


def required(coordinates: Mapping[Symbol, str], q: Coordinate, verb: str, quantity: Quantity) -> None:
    """Refuse a coordinate that the quantity does not have."""
    if q.symbol not in coordinates:
        known = ", ".join(s.name for s in coordinates) or "none"
        message = f"`{verb}`: `{quantity.key}` does not depend on the coordinate {q.symbol.name}"
        raise Rejected(Complaint("wrong-argument", message, help=f"it has {known}"))


def unknown(name: str, kind: str, positive: bool = False) -> Symbol:
    """A letter of the script that is to be found: a tension, a force of constraint, a height; it may change in time.

    name       of the letter, which the problem does not give
    kind       what kind of quantity it is: "force"
    positive   whether it stands for a positive number, so that only positive roots count
    """
    if kind not in KINDS:
        message = f"`unknown`: there is no kind `{kind}`"
        raise Rejected(Complaint("unknown-kind", message, help=f"the kinds are {', '.join(KINDS)}"))
    letter = scalar(name, positive=True) if positive else scalar(name)
    coordinate_named(letter, kind)
    return letter
