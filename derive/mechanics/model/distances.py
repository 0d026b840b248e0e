"""Steps that give a symbol to a distance between two places of a system if the formula of the distance is long."""

from __future__ import annotations

from typing import TypeAlias

from sympy import Add, Expr, Pow, Rational, sqrt

from derive.algebra.expressions import Terms, explicit, scalar
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model import claims
from derive.mechanics.model.system import Central, System
from derive.steps.establish import Lines, Scope, establish
from derive.steps.record import given_letters
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.step import Quantity, compared_with
from derive.steps.subject import Subject

__all__: list[str] = []

Lengths: TypeAlias = list[Quantity]

LONG = 4  # a distance has its own symbol if it contains the square root of a sum of at least this many terms
LETTERS = ("s", "u", "w")


def long_distances(system: System) -> Lengths:
    """Return a step for each distance with a long formula in a potential energy, such as the length of a spring."""
    long = [each for each in system.between if _is_long(each.length)]
    letter = next((each for each in LETTERS if not _is_taken(each, system)), LETTERS[0])
    names = [f"{letter}_{i}" for i in range(1, len(long) + 1)] if len(long) > 1 else [letter]
    return [_distance(system, each, name) for each, name in zip(long, names, strict=False)]


def _is_long(length: Expr) -> bool:
    return any(
        root.exp == Rational(1, 2) and len(Add.make_args(root.base.expand())) >= LONG for root in length.atoms(Pow)
    )


def _is_taken(letter: str, system: System) -> bool:
    return any(name.partition("_")[0] == letter for name in (*given_letters(), *(q.name for q in system.coordinates)))


DISTANCE = Rule(
    "model.distance",
    source="Taylor, *Classical Mechanics*, section 1.2",
    outcomes={"spring": claims.distance_spring, "springs": claims.distance_springs, "other": claims.distance_other},
    evidence={"law_of_cosines": CHECK},
    shown=Shown(abbreviates=True),
)


def _distance(system: System, each: Central, name: str) -> Quantity:
    """Distance between two places, s = sqrt((x_2 - x_1)^2 + (y_2 - y_1)^2 + ...), in m.

    Check: the law of cosines, s^2 = r_1^2 + r_2^2 - 2 r_1 . r_2.
    Outcomes: spring (the length of the only spring), springs (the length of one of several springs), other (not the
    length of a spring).
    Source: Taylor, *Classical Mechanics*, section 1.2.
    """
    way = [c for c in (each.end - each.start).components if c != 0]
    return establish(
        DISTANCE,
        scalar(name),
        lambda: sqrt(Terms(*(Pow(c, 2) for c in way))) if len(way) > 1 else each.length,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"law_of_cosines": compared_with(lambda: sqrt(_by_cosines(each.start, each.end)))},
        outcome=_outcome(system, each),
        key=f"distance_{name.partition('_')[2]}" if "_" in name else "distance",
        kind="length",
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )


def _outcome(system: System, each: Central) -> str:
    several = sum(other.is_spring for other in system.between) > 1
    return "other" if not each.is_spring else "springs" if several else "spring"


def _by_cosines(one: Location, other: Location) -> Expr:
    squares = Add(*(c**2 for place in (one, other) for c in place.components))
    return explicit(squares - 2 * Add(*(a * b for a, b in zip(one.components, other.components, strict=True))))
