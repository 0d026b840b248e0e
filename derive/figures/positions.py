"""Positions, directions and names that a script gives to a drawing, with the keys of the steps that they use.

A position is a `Location` of `derive.mechanics`, a column, a point of a body or a derived quantity. A position with two
components is in the plane of the drawing, with x to the right and y upwards.
"""

from __future__ import annotations

from typing import Any

from sympy import ImmutableDenseMatrix, MatrixBase

from derive.algebra.equality import Grade
from derive.algebra.expressions import scalar
from derive.errors import Complaint, Rejected, did_you_mean
from derive.mechanics.bodies.regions import Point
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.kinematics.places import Location
from derive.steps.step import Quantity

SIDES = {"down": (0, -1), "up": (0, 1), "right": (1, 0), "left": (-1, 0)}


def vector_of(thing: Any) -> tuple[Any, tuple[str, ...]]:
    """Return the components of a vector or a position and, if it is a derived quantity, the key of its step. Any other
    value is rejected."""
    value, keys = value_and_keys(thing)
    if not isinstance(value, MatrixBase) or value.shape not in {(2, 1), (3, 1)}:
        sort = f"the value is of type {type(thing).__name__}"
        got = f"`{thing.key}` is not one" if isinstance(thing, Quantity) else sort
        raise Rejected(Complaint("wrong-argument", f"a drawing needs a vector or a place here, but {got}"))
    return value, keys


def vectors_of(*things: Any) -> tuple[list[Any], tuple[str, ...]]:
    """Return the components of vectors or positions, all in a plane or all in space, and the keys of their steps."""
    found = [vector_of(thing) for thing in things]
    if len({value.rows for value, _ in found}) > 1:
        message = "some places of a drawing have two components, and some have three"
        raise Rejected(Complaint("wrong-argument", message, help="give all places in a plane, or all in space"))
    return [value for value, _ in found], tuple(key for _, keys in found for key in keys)


def value_and_keys(thing: Any) -> tuple[Any, tuple[str, ...]]:
    """Return the value of a quantity and, if the quantity is derived, its key. For a `Point` or a `Location`, return
    its position without a key; for anything else, return `thing` without a key."""
    if isinstance(thing, Quantity):
        return thing.value, (thing.key,) if _is_derived(thing) else ()
    if isinstance(thing, Point):
        return thing.position, ()
    if isinstance(thing, Location):
        return column_of(thing), ()
    return thing, ()


def _is_derived(quantity: Quantity) -> bool:
    """Return whether a step other than a definition contributed to the quantity."""
    own = any(evidence.grade is not Grade.DEFINITION for evidence in quantity.step.evidence)
    return own or any(_is_derived(parent) for parent in quantity.parents)


def name_of(thing: Any, label: Any) -> Any:
    """Return the label of a mark: the given label, or by default the symbol of the quantity `thing`."""
    if isinstance(label, Quantity):
        return label.symbol
    if isinstance(label, str):
        return scalar(label)
    if label is not None:
        return label.symbol if isinstance(label, Coordinate) else label
    return thing.symbol if isinstance(thing, Quantity) else None


def column_of(place: Location) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix(place.components)


def towards(side: str, rows: int) -> Any:
    """Return the unit vector to one side of the drawing; `right` is x, and `up` is y in a plane and z in space."""
    if side not in SIDES:
        known = ", ".join(f'"{each}"' for each in SIDES)
        help_line = did_you_mean(side, SIDES) or f"use {known}"
        raise Rejected(Complaint("wrong-argument", f'a drawing has no side "{side}"', help=help_line))
    across, up = SIDES[side]
    return ImmutableDenseMatrix([across, up] if rows == 2 else [across, 0, up])
