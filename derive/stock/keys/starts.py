"""The start of several coordinates together, as `results:` says it: their values and rates, all others zero."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Expr

from derive.errors import Complaint, Rejected
from derive.mechanics import Coordinate, motions_by_modes
from derive.steps.step import Quantity


def from_start(
    modes: Sequence[Quantity],
    values: Sequence[tuple[str, Expr]],
    coordinates: Mapping[str, Coordinate],
    key: str,
    case: str | None,
) -> tuple[Quantity, ...]:
    """The motion of each coordinate, by modes."""
    places = {coordinates[name]: value for name, value in values if name in coordinates}
    rates = {q: value for name, value in values for q in coordinates.values() if q.rate.name == name}
    known = {*(q.symbol.name for q in places), *(q.rate.name for q in rates)}
    strange = next((name for name, _ in values if name not in known), None)
    if strange is not None:
        message = f"the start is told by values of coordinates and rates, but `{strange}` is none"
        raise Rejected(Complaint("no-such-coordinate", message))
    if not values:
        message = "`solution` of several coordinates needs their `values` at the start"
        raise Rejected(Complaint("missing-key", message, help="what is left out is zero, `values: {x_1: A}`"))
    return motions_by_modes(modes, places, rates, case, key)
