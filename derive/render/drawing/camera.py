"""From the expressions of a drawing to points on paper: numbers for the symbols, and the viewing direction.

A symbol with a number keeps this number. The other symbols of a kind get substitute values in the order of their
declaration. These values are 1, 3/2, 2, ... times the mean size of the given numbers of this kind. Without given
numbers, the values are 1, 3/2, 2, ... times 36 degrees for angles, and 1, 3/2, 2, ... for other kinds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations, cycle
from math import cos, hypot, isfinite, pi, radians, sin
from typing import Any

from sympy import Expr, Float, MatrixBase, Symbol
from sympy.core.function import AppliedUndef

from derive.algebra.expressions import TIME, explicit
from derive.errors import Complaint, Rejected
from derive.figures.extrema import values_along
from derive.figures.marks import PLANE, Drawing, Surface
from derive.figures.polhodes import order_of
from derive.figures.space import Stance, Vector, angle_of, cross, dot, plus, size_of, unit

ANGLE = pi / 5
APART = 0.25  # an arrowhead closer than this to a corner makes a view less suitable; relative to the size of the bodies
OPEN = 0.5  # least cosine, if possible, of the angle between the line of sight and the normal of a flat body
THIN = 0.1  # greatest thickness of a flat body, relative to its size
SHARES = (0.8, 0.6, 1.0, 0.7)  # values of coordinates without a number, except angles, in units of a typical length


def stand_ins(letters: Sequence[tuple[Symbol, str]], numbers: Mapping[Symbol, Any]) -> dict[Symbol, float]:
    """Return a number for each symbol: its value, or a substitute that depends on its kind."""
    found = {symbol: float(explicit(number)) for symbol, number in numbers.items()}
    known: dict[str, list[float]] = {}
    for symbol, kind in letters:
        if symbol in found:
            known.setdefault(kind, []).append(found[symbol])
    counts: dict[str, int] = {}
    for symbol, kind in letters:
        if symbol in found:
            continue
        rank = counts[kind] = counts.get(kind, -1) + 1
        size = 1.0 if kind != "angle" else ANGLE
        if kind in known:
            size = sum(map(abs, known[kind])) / len(known[kind]) or size
        found[symbol] = size * (1 + rank / 2)
    return found


def with_coordinates(drawing: Drawing, lengths: Mapping[Symbol, float], typical: float) -> dict[Symbol, float]:
    """Return the numbers of the symbols; a coordinate without a number gets a number from the drawing or from its
    kind."""
    found = dict(lengths)
    free = [(q, kind) for q, kind in drawing.coordinates if q not in found]
    for (q, kind), share in zip(free, cycle(SHARES), strict=False):
        found[q] = ANGLE if kind == "angle" else share * typical
    for letter, expr in drawing.values:
        if letter not in lengths:
            found[letter] = Numbers(found).of(expr)
    return found


class Numbers:
    """Computes values of expressions from the numbers of their symbols; a symbol without a number gets the value pi/5.

    A drawing needs the same values for each scale that it tries, so they are cached.
    """

    def __init__(self, values: Mapping[Symbol, float]):
        self._values = {symbol.name: value for symbol, value in values.items()}
        self._found: dict[Any, float] = {}
        self._runs: dict[Any, list[float]] = {}

    def of(self, expr: Any) -> float:
        if isinstance(expr, float):
            return expr
        if expr not in self._found:
            value = explicit(expr)
            number = self._put_in(value).evalf()
            if not number.is_real or not isfinite(float(number)):
                message = f"with the numbers of the drawing, {value} is not a real number"
                raise Rejected(Complaint("drawing", message))
            self._found[expr] = float(number)
        return self._found[expr]

    def vector(self, column: Any) -> Vector:
        """Return a position or direction as numbers; a column of two components lies in the plane of the drawing."""
        x, y, *rest = (self.of(entry) for entry in _entries(column))
        return x, y, rest[0] if rest else 0.0

    def along(self, column: Any, letter: Any, ends: tuple[Any, Any], steps: int) -> list[Vector]:
        """Return the positions on a curve as the symbol `letter` runs from the first of `ends` to the second."""
        curves = [self._along(entry, letter, *(self.of(end) for end in ends), steps) for entry in _entries(column)]
        return [(x, y, rest[0] if rest else 0.0) for x, y, *rest in zip(*curves, strict=True)]

    def _along(self, *curve: Any) -> list[float]:
        if curve not in self._runs:
            entry, letter, *ends = curve
            self._runs[curve] = [y for _, y in values_along(self._put_in(explicit(entry), letter), letter, *ends)]
        return self._runs[curve]

    def _put_in(self, value: Expr, free: Any = None) -> Expr:
        letters = {*value.free_symbols, *value.atoms(AppliedUndef)} - {free}
        put_in = {letter: Float(self._values.get(_name(letter), ANGLE)) for letter in letters}
        return value.xreplace(put_in)


def _entries(column: Any) -> Any:
    return column if isinstance(column, MatrixBase) else explicit(column)


def _name(letter: Expr) -> str:
    return letter.func.__name__ if isinstance(letter, AppliedUndef) else str(letter.name)


# --- viewing directions ----------------------------------------------------------------------------------------------


def stance_from(azimuth: float, elevation: float) -> Stance:
    """Return the view from an azimuth, measured from x towards y, and an elevation above the xy plane, in degrees."""
    az, el = radians(azimuth), radians(elevation)
    return Stance(
        right=(-sin(az), cos(az), 0.0),
        up=(-sin(el) * cos(az), -sin(el) * sin(az), cos(el)),
        eye=(cos(el) * cos(az), cos(el) * sin(az), sin(el)),
    )


FLAT = Stance((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
USUAL = stance_from(25, 18)
# The views for polhodes: the first if the intermediate moment is about x, the second for y, the third for z.
FROM_A_CORNER = stance_from(37, 30), stance_from(53, 30), stance_from(45, 42)


def best_stance(drawing: Drawing, numbers: Numbers, reach: float = 1.0) -> Stance:
    """Return the view of a drawing.

    A drawing in a plane has the view from the front. In space, the author may choose the view. Otherwise the view
    depends on the marks: for example, vectors should appear long and far apart, and not end at corners.

    `reach` is the size of the bodies.
    """
    if drawing.view == PLANE:
        return FLAT
    if drawing.seen_from is not None:
        return stance_from(*drawing.seen_from)
    if drawing.polhodes is not None and (order := order_of([numbers.of(each) for each in drawing.polhodes.ratios])):
        return FROM_A_CORNER[order[1]]
    if TIME in dict(drawing.values):  # a moving plane is already rotated so that its front is visible
        return USUAL
    shown = [[unit(numbers.vector(each)) for each in mark.directions] for mark in drawing.marks]
    vectors = [v for directions in shown if len(directions) == 1 for v in directions if size_of(v)]
    pairs = [
        (a, b) for a, b in (directions for directions in shown if len(directions) == 2) if size_of(a) and size_of(b)
    ]
    pairs += [pair for pair in combinations(vectors, 2) if pair not in pairs]
    if not vectors and not pairs:
        return _open_view(drawing, numbers, reach)
    tried = [stance_from(azimuth, elevation) for elevation in (18, 24, 30, 38) for azimuth in range(15, 76, 6)]
    ends = [tip for mark in drawing.marks if (tip := mark.tip(numbers, reach)) is not None]
    corners = [at for mark in drawing.marks if isinstance(mark, Surface) for at in mark.vertices(numbers)]
    return max(
        tried, key=lambda stance: _clearness(stance, vectors, pairs) * _apartness(stance, ends, corners, APART * reach)
    )


def _open_view(drawing: Drawing, numbers: Numbers, reach: float) -> Stance:
    places = [place for mark in drawing.marks if isinstance(mark, Surface) for place in mark.places(numbers)]
    normal = _normal_of(places, reach)
    if normal is None:
        return USUAL
    views = [USUAL, *(stance_from(azimuth, elevation) for elevation in (18, 38) for azimuth in (25, 40, 55))]
    return next((view for view in views if abs(dot(normal, view.eye)) > OPEN), views[-1])


def _normal_of(places: Sequence[Vector], reach: float) -> Vector | None:
    """Return the normal of the plane that contains all places; None if there is no such plane, if the places are on one
    line, or if there are no places."""
    if not places:
        return None
    ways = [plus(place, places[0], -1.0) for place in places]
    longest = max(ways, key=size_of)
    normal = max((cross(longest, way) for way in ways), key=size_of)
    if size_of(normal) < THIN * reach**2:
        return None
    return unit(normal) if all(abs(dot(unit(normal), way)) < THIN * reach for way in ways) else None


def _apartness(stance: Stance, ends: Sequence[Vector], corners: Sequence[Vector], enough: float) -> float:
    """Return the smallest distance in the view between tips and corners, in units of `enough`, at most 1."""
    spots = [stance.spot(corner) for corner in corners]
    nearest = (hypot(x - u, y - v) for x, y in map(stance.spot, ends) for u, v in spots)
    return min(1.0, min(nearest, default=enough) / enough)


def _clearness(stance: Stance, vectors: Sequence[Vector], pairs: Sequence[tuple[Vector, Vector]]) -> float:
    """Return a measure of how clearly the vectors appear. The measure grows with the shortest length of a vector in the
    view, and with the smallest sine of an angle between two vectors in the view."""
    longest = min((hypot(*stance.spot(v)) for v in vectors), default=1.0)
    widest = 1.0
    for a, b in pairs:
        if 0.02 < angle_of(a, b) < pi - 0.02:
            flat_a, flat_b = ((*stance.spot(v), 0.0) for v in (a, b))
            seen = angle_of(flat_a, flat_b) if size_of(flat_a) and size_of(flat_b) else 0.0
            widest = min(widest, sin(min(seen, pi / 2)), sin(min(pi - seen, pi / 2)) * 1.2)
    return round(min(longest, 0.8) * min(widest, 0.7), 6)
