"""A drawing as pieces on paper: solids from back to front, then lines, arrows, arcs and dimension lines over them."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, sin
from typing import Any

from derive.figures import marks as m
from derive.render.drawing.camera import Numbers, Spot, Vector, across, angle_of, best_stance, dot, plus, size_of, unit
from derive.render.drawing.hidden_lines import (
    Bullet,
    Paper,
    Piece,
    Stroke,
    Tag,
    direction,
    fixed_places,
    outline_of,
)

POINTS_PER_CM = 72 / 2.54
PAST = 0.3  # how far axes go past a body, in terms of its size
ASIDE = 12.0  # points between a body and its dimension line
SOLIDS = (m.Box, m.ConeMark, m.CylinderMark, m.BallMark, m.RodMark, m.Circle, m.Polygon)


def picture(drawing: m.Drawing, numbers: Numbers, width: float, height: float) -> list[Piece]:
    """The pieces in points; lines without labels fit into width x height, in centimetres."""
    paper = _paper(drawing, numbers)
    room = width * POINTS_PER_CM, height * POINTS_PER_CM
    for _ in range(3):  # dimension lines stand aside by points, so the size of the whole is not in proportion
        spots = [spot for piece in _pieces(drawing, paper) for spot in _extent(piece)]
        wide, high = (max(s[k] for s in spots) - min(s[k] for s in spots) for k in (0, 1))
        paper = replace(paper, scale=paper.scale * min(room[0] / max(wide, 1e-9), room[1] / max(high, 1e-9)))
    return _pieces(drawing, paper)


def _paper(drawing: m.Drawing, numbers: Numbers) -> Paper:
    fixed = [place for mark in drawing.marks for place in fixed_places(mark, numbers)]
    fixed = fixed or [numbers.vector(place) for mark in drawing.marks for place in _ends(mark)] or [(0.0, 0.0, 0.0)]
    low, high = ([choice(place[k] for place in fixed) for k in range(3)] for choice in (min, max))
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2)
    reach = max(size_of(plus(place, middle, -1.0)) for place in fixed) or 1.0
    return Paper(numbers, best_stance(drawing, numbers), 60 / reach, reach, middle, tuple(fixed))


def _ends(mark: m.Mark) -> list[Any]:
    match mark:
        case m.Line() | m.Axis() | m.Length():
            return [mark.start, mark.end]
        case m.Dot() | m.Support():
            return [mark.at]
    return []


def _extent(piece: Piece) -> tuple[Spot, ...]:
    match piece:
        case Bullet() | Tag():
            return (piece.spot,)
    return piece.spots


def _pieces(drawing: m.Drawing, paper: Paper) -> list[Piece]:
    solids = [mark for mark in drawing.marks if isinstance(mark, SOLIDS)]
    if drawing.view == m.SPACE:
        solids.sort(key=lambda mark: _depth(mark, paper))
    pieces = [piece for mark in solids for piece in outline_of(mark, paper)]
    for mark in drawing.marks:
        if not isinstance(mark, SOLIDS):
            pieces += _line_pieces(mark, paper)
    return [piece for piece in pieces if not (isinstance(piece, Tag) and piece.label is None)]


def _depth(mark: m.Mark, paper: Paper) -> float:
    """How near to the eye the middle of a solid is."""
    places = fixed_places(mark, paper.numbers)
    return sum(dot(place, paper.stance.eye) for place in places) / len(places)


def _line_pieces(mark: m.Mark, paper: Paper) -> list[Piece]:
    numbers = paper.numbers
    match mark:
        case m.Line():
            return _line(mark, paper)
        case m.Axis():
            return _axis(mark, paper)
        case m.AxisOfRotation():
            return _axis_of_rotation(mark, paper)
        case m.Arrow():
            return _arrow(mark, paper)
        case m.AngleMark():
            return _angle(mark, paper)
        case m.Turn():
            return _turn(mark, paper)
        case m.Length():
            return _length(mark, paper)
        case m.Dot():
            spot = paper.spot(numbers.vector(mark.at))
            return [Bullet(spot), Tag(mark.label, spot, (0.7, 0.7), 4.0)]
        case m.Support():
            return _support(paper.spot(numbers.vector(mark.at)), mark.label)
    raise TypeError(f"no drawing of a {type(mark).__name__}")


def _line(mark: m.Line, paper: Paper) -> list[Piece]:
    a, b = paper.spots(paper.numbers.vector(mark.start), paper.numbers.vector(mark.end))
    middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    along = direction(a, b)
    return [Stroke((a, b), mark.pen), Tag(mark.label, middle, (along[1], -along[0]))]


def _axis(mark: m.Axis, paper: Paper) -> list[Piece]:
    start, end = paper.numbers.vector(mark.start), paper.numbers.vector(mark.end)
    if mark.past is not None:
        end = plus(end, unit(paper.numbers.vector(mark.past)), PAST * paper.reach)
    ends = paper.spots(start, end)
    return [Stroke(ends, "axis", head=True), Tag(mark.label, ends[1], direction(*ends))]


def _axis_of_rotation(mark: m.AxisOfRotation, paper: Paper) -> list[Piece]:
    """Past the body on both sides."""
    through, along = paper.numbers.vector(mark.through), unit(paper.numbers.vector(mark.along))
    if not size_of(along):
        return []
    places = [dot(plus(place, through, -1.0), along) for place in (*paper.fixed, through)]
    far = max(places) + (PAST if mark.rate is None else 1.9 * PAST) * paper.reach
    spots = paper.spots(plus(through, along, min(places) - PAST * paper.reach), plus(through, along, far))
    line = Stroke(spots, "construction")
    if mark.rate is None:
        return [line, Tag(mark.label, spots[1], direction(*spots))]
    sense = 1.0 if paper.numbers.of(mark.rate) > 0 else -1.0
    round_end = plus(through, along, far - 0.6 * PAST * paper.reach)
    return [line, *_circling(round_end, plus((0.0, 0.0, 0.0), along, sense), 0.16 * paper.reach, mark.label, paper)]


def _arrow(mark: m.Arrow, paper: Paper) -> list[Piece]:
    start, along = paper.numbers.vector(mark.start), unit(paper.numbers.vector(mark.value))
    if not size_of(along):
        return []
    spots = paper.spots(start, plus(start, along, paper.numbers.of(mark.size) * paper.reach))
    return [Stroke(spots, "asked" if mark.asked else "given", head=True), Tag(mark.label, spots[1], direction(*spots))]


def _angle(mark: m.AngleMark, paper: Paper) -> list[Piece]:
    """The arc of the great circle from one direction to the other; none where they are parallel."""
    vertex = paper.numbers.vector(mark.vertex)
    a, b = unit(paper.numbers.vector(mark.a)), unit(paper.numbers.vector(mark.b))
    if not size_of(a) or not size_of(b):
        return []
    size = angle_of(a, b)
    if not 0.02 < size < pi - 0.02:
        return []
    radius = paper.numbers.of(mark.radius) if mark.radius is not None else paper.reach * _comfortable(size)
    beside = unit(plus(b, a, -dot(a, b)))
    turned = [size * i / 48 for i in range(49)]
    places = [plus(plus(vertex, a, radius * cos(t)), beside, radius * sin(t)) for t in turned]
    spots = paper.spots(*places)
    return [Stroke(spots, "angle"), Tag(mark.label, spots[24], direction(paper.spot(vertex), spots[24]), 2.5)]


def _comfortable(angle: float) -> float:
    """A small angle has a large arc, so that there is something to see."""
    return max(0.3, min(0.8, 0.3 / angle))


def _turn(mark: m.Turn, paper: Paper) -> list[Piece]:
    """Most of a circle, open towards the side away from the eye, with a head at its right-handed end."""
    centre, along = paper.numbers.vector(mark.centre), unit(paper.numbers.vector(mark.along))
    if not size_of(along):
        return []
    return _circling(centre, along, paper.numbers.of(mark.size) * paper.reach, mark.label, paper)


def _circling(centre: Vector, along: Vector, radius: float, label: Any, paper: Paper) -> list[Piece]:
    u, v = across(along)
    eye = paper.stance.eye
    front = max(range(360), key=lambda degree: dot(_round(u, v, degree), eye))
    places = [plus(centre, _round(u, v, front + degree), radius) for degree in range(-125, 126, 5)]
    spots = paper.spots(*places)
    outer = max(spots, key=lambda spot: (round(spot[0], 6), spot[1]))
    return [Stroke(spots, "turn", head=True), Tag(label, outer, (1.0, 0.0))]


def _round(u: Vector, v: Vector, degree: float) -> Vector:
    t = degree * pi / 180
    return plus((u[0] * cos(t), u[1] * cos(t), u[2] * cos(t)), v, sin(t))


def _length(mark: m.Length, paper: Paper) -> list[Piece]:
    """Set off by the same distance on paper whatever the scale; nothing for a length that is zero."""
    start, end = paper.numbers.vector(mark.start), paper.numbers.vector(mark.end)
    if size_of(plus(end, start, -1.0)) < 1e-9 * paper.reach:
        return []
    a, b = paper.spots(start, end)
    x, y = (-1.0, 0.0) if mark.aside is None else paper.stance.spot(paper.numbers.vector(mark.aside))
    size = hypot(x, y) or 1.0
    away = (x / size, y / size)
    clear = paper.numbers.of(mark.clear) * paper.scale

    def set_off(spot: Spot, share: float) -> Spot:
        far = clear + share * ASIDE
        return spot[0] + away[0] * far, spot[1] + away[1] * far

    ends = (set_off(a, 1), set_off(b, 1))
    extensions = [Stroke((set_off(spot, 0.2), set_off(spot, 1.25)), "thin") for spot in (a, b)]
    middle = ((ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2)
    line = Stroke(ends, "measure", head=True, tail=True)
    return [*extensions, line, Tag(mark.label, middle, away)]


def _support(spot: Spot, label: Any) -> list[Piece]:
    """A pointed stand on hatched ground, as large as it must be to be seen."""
    x, y = spot
    foot = y - 16
    stand = Stroke(((x - 5, foot), (x, y), (x + 5, foot)), "edge")
    ground = Stroke(((x - 13, foot), (x + 13, foot)), "edge")
    hatches = [Stroke(((x + k, foot), (x + k - 4, foot - 4)), "thin") for k in range(-9, 14, 4)]
    return [stand, ground, *hatches, Tag(label, spot, (-0.9, 0.4), 4.0)]
