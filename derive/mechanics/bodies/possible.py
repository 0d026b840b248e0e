"""Checks for impossible bodies: a hole outside the body, parts that share a volume, a position map that covers places
twice, a density that changes its sign, a negative mass or size.

The checks are numerical: Newton's method on the position map of one part looks for points of another part. A body is
rejected only if it is impossible for every draw of its symbols, or for the numbers of the problem.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from random import Random
from typing import Any

from sympy import Expr, Symbol, lambdify
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import explicit
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.charts import CLOSE, Chart, Place, draws
from derive.mechanics.bodies.regions import Bounds
from derive.steps.signs import sign_known

POINTS, TWINS = 40, 6  # number of points sampled in a part, and of places tested for being covered twice
APART = 1e-3  # values of a variable are distinct if they differ by this fraction of its range


def require_positive(body: str, role: str, value: Any) -> None:
    """Reject a mass or a size that is known to be zero or negative."""
    if sign_known(explicit(value)) in (0, -1):
        message = f"{body} needs a positive {role}, but {value} is not positive"
        raise Rejected(Complaint("no-such-body", message))


@dataclass(frozen=True)
class Piece:
    """A part of a body: its name, its sign (1, or -1 for a cavity), its filling, and its position map."""

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


def check_parts(parts: Sequence[Any]) -> None:
    """Reject a hole that is not inside the body, and two parts that share a volume."""
    pieces = list(_pieces(parts))
    filled = [piece for piece in pieces if piece.sign > 0]
    for hole in (piece for piece in pieces if piece.sign < 0):
        around = [piece for piece in filled if piece.filling == hole.filling]
        if _always([hole, *around], lambda charts: _outside(charts[0], charts[1:])):
            message = f"`{hole.called}` is cut out of the body, but a part of it is outside the body"
            raise Rejected(Complaint("no-such-body", message, help="a hole must be inside the rest of the body"))
    solid = [piece for piece in filled if piece.filling == "volume"]
    for i, one in enumerate(solid):
        for other in solid[:i]:
            if _always([one, other], lambda charts: _inside(charts[0], charts[1])):
                message = f"`{other.called}` and `{one.called}` share a volume"
                help_line = "cut one out of the other, or place them side by side"
                raise Rejected(Complaint("no-such-body", message, help=help_line))


def check_map(name: str, position: ImmutableMatrix, limits: Bounds, density: Expr, negative_is_refused: bool) -> None:
    """Reject a map that covers places twice, and a density that changes its sign in the body.

    negative_is_refused   whether a density that is negative everywhere is rejected too
    """
    names = {x for x, _, _ in limits}
    letters = (position.free_symbols | density.free_symbols) - names
    letters |= {s for _, *ends in limits for end in ends for s in end.free_symbols} - names
    drawn = list(draws(letters, [limits]))
    charts = [Chart.of(position, limits, at) for at in drawn]
    if charts and all(_covered_twice(chart) for chart in charts):
        message = f"the map of this `{name}` covers places twice: different values of its variables give the same place"
        raise Rejected(Complaint("folded", message, help="give limits between which it covers each place once"))
    signs = [_signs(density, chart, at) for chart, at in zip(charts, drawn, strict=True)]
    if signs and all(found == {1, -1} for found in signs):
        message = f"the density {density} of this `{name}` is negative in a part of the body"
        raise Rejected(Complaint("no-such-body", message, help="a density must be positive throughout the body"))
    if signs and negative_is_refused and all(found == {-1} for found in signs):
        raise Rejected(Complaint("no-such-body", f"the density {density} of this `{name}` is negative"))


def _always(pieces: Sequence[Piece], shown: Callable[[list[Chart]], bool]) -> bool:
    """Whether a test can be evaluated for at least one draw of the symbols, and is true for every such draw."""
    found = False
    letters = {s for piece in pieces for s in piece.letters}
    for at in draws(letters, [piece.limits for piece in pieces]):
        charts = [Chart.of(piece.position, piece.limits, at) for piece in pieces]
        try:
            if not shown(charts):
                return False
        except (TypeError, ValueError, OverflowError, ZeroDivisionError):  # no such body exists for these numbers
            continue
        found = True
    return found


def _outside(hole: Chart, around: Sequence[Chart]) -> bool:
    """Whether at least two sampled points of the hole are in none of the parts."""
    points = [hole.place(*at) for at in hole.points(POINTS, Random(1))]
    outside = (point for point in points if all(next(chart.sought(point), None) is None for chart in around))
    return len(list(islice(outside, 2))) == 2


def _inside(one: Chart, other: Chart) -> bool:
    """Whether a sampled point of one part is inside the other part."""
    source = Random(2)
    for own, chart in ((one, other), (other, one)):
        if any(_strictly(chart, own.place(*at)) for at in own.points(POINTS, source)):
            return True
    return False


def _strictly(chart: Chart, point: Sequence[float]) -> bool:
    """Whether a point is in the interior of a body, not on its surface."""
    return any(_is_between(chart, at) for at in chart.sought(point))


def _is_between(chart: Chart, at: Place) -> bool:
    pairs = [(x, *ends(*at[:i])) for i, (x, ends) in enumerate(zip(at, chart.ends, strict=True))]
    return all(low + APART * (high - low) < x < high - APART * (high - low) for x, low, high in pairs)


def _covered_twice(chart: Chart) -> bool:
    """Whether distinct values of the variables give the same place, for at least one sampled place."""
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
    """The signs of a density at sampled points of the body."""
    value = lambdify(chart.names, explicit(density).xreplace(dict(at)), "math")
    try:
        found = [value(*point) for point in chart.points(POINTS, Random(4))]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return set()
    return {1 if each > 0 else -1 for each in found if abs(each) > CLOSE * max(map(abs, found))}
