"""Checks for impossible bodies: a hole outside the body, parts that overlap, a position map that covers places twice, a
density that changes its sign, a negative mass or size.

The checks of position maps and of parts are numerical: Newton's method finds values of the variables for which a
position map gives a sampled point. The numbers for the symbols are random, except the numbers that the problem gives.
These checks reject a body only if it is impossible for every set of numbers for which it can be evaluated.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any, TypeAlias

from sympy import Expr, Symbol, lambdify
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import explicit
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.charts import CLOSE, Chart, Place, draws
from derive.mechanics.bodies.regions import Bounds
from derive.steps.signs import sign_known

POINTS = 40  # number of points of a part that are sampled
TWINS = 6  # number of sampled points for which other values of the variables with the same position are sought
SHARP = 1e-6  # length added to the bounds of a part, because a part may be flat or straight
APART = 1e-3  # values of a variable are distinct if they differ by more than this fraction of its range


def require_positive(body: str, role: str, value: Any) -> None:
    """Reject a mass or a size that is known to be zero or negative."""
    if sign_known(explicit(value)) in (0, -1):
        message = f"{body} needs a positive {role}, but {value} is not positive"
        raise Rejected(Complaint("no-such-body", message))


@dataclass(frozen=True)
class Piece:
    """A part of a body: its name, its sign (1, or -1 for a cavity), what its mass fills, and its position map."""

    called: str
    sign: int
    filling: str
    position: ImmutableMatrix
    limits: Bounds

    @property
    def letters(self) -> set[Symbol]:
        names = {x for x, _, _ in self.limits}
        found: set[Symbol] = {s for _, *ends in self.limits for end in ends for s in end.free_symbols}
        found.update(self.position.free_symbols)
        return found - names


def _pieces(parts: Sequence[Any], sign: int = 1) -> Iterator[Piece]:
    """The parts except particles; a composite part is replaced by its own parts."""
    for part in parts:
        for piece in _pieces(part.body.parts, sign * part.sign) if hasattr(part.body, "parts") else _own(part, sign):
            if hasattr(part.body, "parts"):
                piece = replace(piece, position=part.seen(piece.position))
            yield piece


def _own(part: Any, sign: int) -> Iterator[Piece]:
    position, limits = part.body.map()
    if limits:
        yield Piece(str(part.body.called), sign * part.sign, part.body.filling, part.seen(position), limits)


@dataclass(frozen=True)
class Fault:
    """Why no body can consist of the given parts.

    why     "shared" (parts overlap), "hole" (a hole is outside the body, or holes overlap) or "empty" (nothing is left)
    names   the names of the parts that overlap at one place, or of the holes there; none for "empty"
    """

    why: str
    names: tuple[str, ...]

    def complaint(self, filling: str) -> Complaint:
        named = " and ".join(f"`{name}`" for name in dict.fromkeys(self.names[:2]))
        if len(self.names) > 1 and self.names[0] == self.names[1]:
            named = f"two parts called {named}"
        if self.why == "shared":
            message = f"{named} share {SHARED[filling]}"
            return Complaint("no-such-body", message, help="cut one out of the other, or place them side by side")
        if self.why == "empty":
            return Complaint("no-such-body", "nothing is left of the body: the holes are as large as its parts")
        if len(self.names) > 1:
            message = f"{named} are cut out of the body, but they overlap"
            return Complaint("no-such-body", message, help="cut out each part of the body once")
        message = f"{named} is cut out of the body, but is not inside the rest of the body"
        return Complaint("no-such-body", message, help="a hole must be inside the rest of the body")


SHARED = {"volume": "a volume", "area": "an area", "length": "a length"}  # what two parts have in common


def check_parts(parts: Sequence[Any]) -> None:
    """Reject parts that no body can have: a hole that is not inside the body, holes that leave nothing of the body, and
    a particle as a hole. Two holes, or two parts, must not share a volume, an area or a length either."""
    for part in parts:
        if part.sign < 0 and not hasattr(part.body, "parts") and not part.body.map()[1]:
            message = "a particle cannot be cut out of a body"
            raise Rejected(Complaint("no-such-body", message, help="cut out a part that has a size"))
    pieces = list(_pieces(parts))
    for filling in dict.fromkeys(piece.filling for piece in pieces):
        alike = [piece for piece in pieces if piece.filling == filling]
        found = _always(alike) if len(alike) > 1 or alike[0].sign < 0 else None
        if found is not None:
            raise Rejected(found.complaint(filling))


def _faults(pieces: Sequence[Piece], charts: Sequence[Chart]) -> dict[Fault, None]:
    """Return the faults of the parts for one set of numbers, each as a key; empty if the parts can form a body. A
    fault at a single sampled point is ignored."""
    found: dict[Fault, int] = {}
    left = False
    boxes = [_box(chart) for chart in charts]
    for i, (one, chart) in enumerate(zip(pieces, charts, strict=True)):
        source = Random(1 if one.sign < 0 else 2)
        for at in chart.points(POINTS, source):
            there = _there(chart.place(*at), i, charts, boxes)
            if there is None:
                continue
            total = sum(pieces[k].sign for k in there)
            left = left or total > 0
            if total not in (0, 1):
                fault = Fault(
                    "shared" if total > 0 else "hole",
                    tuple(pieces[k].called for k in there if pieces[k].sign == (1 if total > 0 else -1)),
                )
                found[fault] = found.get(fault, 0) + 1
    seen = dict.fromkeys(fault for fault, count in found.items() if count > 1)
    return seen if seen or left else {Fault("empty", ()): None}


Box: TypeAlias = list[tuple[float, float]]


def _box(chart: Chart) -> Box:
    """Return the bounds of each component of the places of a part. The range of sampled places is extended on each side
    by its own width, because the samples do not reach the surface."""
    places = [chart.place(*at) for at in chart.points(POINTS, Random(4))]
    bounds = [(min(values), max(values)) for values in zip(*places, strict=True)]
    return [(low - (high - low) - SHARP, high + (high - low) + SHARP) for low, high in bounds]


def _there(place: Sequence[float], own: int, charts: Sequence[Chart], boxes: Sequence[Box]) -> list[int] | None:
    """Return the indices of the parts that contain a place of one part; None if the place is on the surface of another
    part."""
    found = []
    for k, chart in enumerate(charts):
        is_near = k != own and all(low <= c <= high for c, (low, high) in zip(place, boxes[k], strict=True))
        values = list(chart.sought(place)) if is_near else []
        if values and not any(_is_between(chart, at) for at in values):
            return None
        if k == own or values:
            found.append(k)
    return found


def check_map(name: str, position: ImmutableMatrix, limits: Bounds, density: Expr, negative_is_refused: bool) -> None:
    """Reject a map that covers places twice, and a density that changes its sign in the body.

    negative_is_refused   whether to reject also a density that is negative everywhere
    """
    names = {x for x, _, _ in limits}
    letters = (position.free_symbols | density.free_symbols) - names
    letters |= {s for _, *ends in limits for end in ends for s in end.free_symbols} - names
    drawn = list(draws(letters, [limits]))
    charts = [Chart.of(position, limits, at) for at in drawn]
    if charts and all(_covered_twice(chart) for chart in charts):
        message = f"the map of this `{name}` covers places twice: different values of its variables give the same place"
        raise Rejected(Complaint("folded", message, help="give limits between which the map covers each place once"))
    signs = [_signs(density, chart, at) for chart, at in zip(charts, drawn, strict=True)]
    if signs and all(found == {1, -1} for found in signs):
        message = f"the density {density} of this `{name}` is negative in a part of the body"
        raise Rejected(Complaint("no-such-body", message, help="a density must be positive throughout the body"))
    if signs and negative_is_refused and all(found == {-1} for found in signs):
        raise Rejected(Complaint("no-such-body", f"the density {density} of this `{name}` is negative"))


def _always(pieces: Sequence[Piece]) -> Fault | None:
    """Return a fault that occurs for every random choice of numbers for the symbols, or None.

    Choices for which the places of the body cannot be evaluated do not count. A fault in only some
    choices is due to the numbers, for example if two of many rods overlap in one choice, and two other rods in another.
    """
    found: list[Fault] | None = None
    letters = {s for piece in pieces for s in piece.letters}
    for at in draws(letters, [piece.limits for piece in pieces]):
        charts = [Chart.of(piece.position, piece.limits, at) for piece in pieces]
        try:
            faults = _faults(pieces, charts)
        except (TypeError, ValueError, OverflowError, ZeroDivisionError):  # no such body exists for these numbers
            continue
        found = [fault for fault in (faults if found is None else found) if fault in faults]
        if not found:
            return None
    return found[0] if found else None


def _is_between(chart: Chart, at: Place) -> bool:
    pairs = [(x, *ends(*at[:i])) for i, (x, ends) in enumerate(zip(at, chart.ends, strict=True))]
    return all(low + APART * (high - low) < x < high - APART * (high - low) for x, low, high in pairs)


def _covered_twice(chart: Chart) -> bool:
    """Whether, for at least one sampled place, other values of the variables give the same place."""
    try:
        return any(_has_twin(chart, at) for at in chart.points(TWINS, Random(3), margin=0.1))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return False


def _has_twin(chart: Chart, at: Place) -> bool:
    widths = [high - low for low, high in (ends(*at[:i]) for i, ends in enumerate(chart.ends))]
    for other in chart.sought(chart.place(*at)):
        if _is_between(chart, other) and any(abs(x - y) > APART * w for x, y, w in zip(at, other, widths, strict=True)):
            return True
    return False


def _signs(density: Expr, chart: Chart, at: Mapping[Symbol, Expr]) -> set[int]:
    value = lambdify(chart.names, explicit(density).xreplace(dict(at)), "math")
    try:
        found = [value(*point) for point in chart.points(POINTS, Random(4))]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return set()
    return {1 if each > 0 else -1 for each in found if abs(each) > CLOSE * max(map(abs, found))}
