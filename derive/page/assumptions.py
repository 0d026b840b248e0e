"""Assumptions about symbols as textbooks write them, such as 0 < alpha < pi/2; sin(alpha) != 0 is omitted if the bounds
of alpha imply it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from sympy import Expr, Integer, Symbol, cancel, cos, expand, pi, sin

from derive.algebra.expressions import Amount, Relation
from derive.algebra.kinds import unit_of_kind

MIRRORED = {">": "<", ">=": "<="}
ANGLE = unit_of_kind("angle")  # bounds of angles, such as pi/2, are written without a unit


def between_bounds(assumed: Iterable[Relation]) -> list[Relation]:
    """Join the two numerical bounds of a symbol: alpha > 0 and alpha < pi/2 become 0 < alpha < pi/2."""
    conditions = list(assumed)
    below, above = _bounds(conditions)
    found: list[Any] = []
    for condition in conditions:
        letter = condition.left
        if above.get(letter) == condition:
            continue
        if below.get(letter) == condition and letter in above:
            lower = Relation(condition.right, MIRRORED[condition.operator], letter)
            found.append(Relation(lower, above[letter].operator, above[letter].right))
        else:
            found.append(condition)
    return found


def not_implied(assumed: Iterable[Relation]) -> list[Relation]:
    """Return the assumptions that numerical bounds do not imply; 0 < alpha < pi/2 implies sin(alpha) != 0."""
    conditions = list(assumed)
    below, above = _bounds(conditions)
    return [condition for condition in conditions if not _follows(condition, below, above)]


def _bounds(conditions: Iterable[Relation]) -> tuple[dict[Expr, Relation], dict[Expr, Relation]]:
    """Return the numerical lower bounds of symbols, and the upper bounds of symbols that have a lower bound."""
    numbers = [each for each in conditions if isinstance(each.left, Symbol) and each.right.is_number]
    below = {each.left: each for each in numbers if each.operator in MIRRORED}
    return below, {each.left: each for each in numbers if each.operator in MIRRORED.values() and each.left in below}


def says_the_same(condition: Relation, other: Relation) -> bool:
    """Return whether two inequalities state the same, as a < b and 2 b > 2 a do."""
    strict = [each.operator for each in (condition, other) if each.operator in ("<", ">")]
    if len(strict) == 1 or not {condition.operator, other.operator} <= {*MIRRORED, *MIRRORED.values()}:
        return False
    one, two = (
        expand((each.left - each.right) * (1 if each.operator in MIRRORED else -1)) for each in (condition, other)
    )
    factor = cancel(one / two) if two != 0 else Integer(0)
    return bool(factor.is_number and factor.is_positive)


def with_units(condition: Any, units: Mapping[Symbol, str]) -> Any:
    """Return a condition with units for its rational bounds: -1 m/s < v < 1 m/s. Zero and bounds of angles have no
    unit."""
    left, right = condition.left, condition.right
    letter = left.right if isinstance(left, Relation) else left
    unit = units.get(letter, "") if isinstance(letter, Symbol) else ""
    if not unit or unit == ANGLE:
        return condition
    if isinstance(left, Relation):
        left = Relation(_amount(left.left, unit), left.operator, left.right)
    return Relation(left, condition.operator, _amount(right, unit))


def _amount(number: Any, unit: str) -> Any:
    return Amount(number, unit, Integer(1)) if number.is_Rational and number != 0 else number


def _follows(condition: Relation, below: dict[Expr, Relation], above: dict[Expr, Relation]) -> bool:
    """Return whether strict bounds of a symbol imply that its sine or cosine is not zero, as 0 < alpha < pi/2 implies
    sin(alpha) != 0."""
    function = condition.left
    if condition.operator != "!=" or condition.right != Integer(0) or not isinstance(function, sin | cos):
        return False
    (angle,) = function.args
    if angle not in above:
        return False
    lower, upper = (0, pi) if isinstance(function, sin) else (-pi / 2, pi / 2)
    open_ends = below[angle].operator == ">" and above[angle].operator == "<"
    return bool(open_ends and below[angle].right >= lower and above[angle].right <= upper)
