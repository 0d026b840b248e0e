"""A drawing as pieces on paper: bodies from back to front, then lines, arrows, arcs and dimension lines over them."""

from __future__ import annotations

from dataclasses import replace

from derive.figures.marks import LAST, SPACE, Drawing, Mark, Surface
from derive.figures.modes import DisplacementArrow
from derive.figures.pieces import Bullet, Patch, Piece, Stroke, Tag
from derive.figures.space import NOUGHT, Spot, dot, mean, plus, size_of
from derive.figures.surroundings import ARROW
from derive.render.drawing.camera import Numbers, best_stance
from derive.render.drawing.hidden_lines import OnPaper

POINTS_PER_CM = 72 / 2.54
TRIES = 12  # greatest number of iterations to find the scale
LABEL = 8.0  # in points: approximate width of a letter
REDUCED = 0.7  # the drawing of a normal mode has small parts: it is drawn larger, and then reduced by this factor
SMALLEST = 15.0  # in points: the least distance from the middle of the bodies to their farthest point


def picture(drawing: Drawing, numbers: Numbers, width: float, height: float) -> list[Piece]:
    """Return the pieces of a drawing, with all lengths in points.

    The pieces without their labels fit into `width` x `height` centimetres. Exceptions are some force diagrams, some
    arrows of normal modes, and drawings whose bodies would be too small.
    """
    if drawing.mode is not None:
        return [_reduced(piece) for piece in _fitted(drawing, numbers, width / REDUCED, height / REDUCED)]
    return _fitted(drawing, numbers, width, height)


def _reduced(piece: Piece) -> Piece:
    if isinstance(piece, Stroke | Patch):
        return replace(piece, spots=tuple((REDUCED * x, REDUCED * y) for x, y in piece.spots))
    x, y = piece.spot
    spot = REDUCED * x, REDUCED * y
    return (
        replace(piece, spot=spot, size=REDUCED * piece.size) if isinstance(piece, Bullet) else replace(piece, spot=spot)
    )


def _fitted(drawing: Drawing, numbers: Numbers, width: float, height: float) -> list[Piece]:
    paper = _paper(drawing, numbers)
    if drawing.forces_on is not None and paper.is_of_a_point:
        return _pieces(drawing, paper)  # all lengths of the force diagram of a particle are in points
    if drawing.body_size is not None:
        return _pieces(drawing, replace(paper, scale=drawing.body_size / paper.reach))
    room = width * POINTS_PER_CM, height * POINTS_PER_CM
    # Arrows that start at the masses of a mode do not change the scale, so that all modes have almost the same scale.
    kept = (mark for mark in drawing.marks if not isinstance(mark, DisplacementArrow) or mark.side is not None)
    measured = replace(drawing, marks=tuple(kept))
    for _ in range(TRIES):  # the size is not quite proportional to the scale, because some parts have a fixed size
        spots = [spot for piece in _pieces(measured, paper) for spot in piece.spots]
        wide, high = (max(s[k] for s in spots) - min(s[k] for s in spots) for k in (0, 1))
        ratio = min(room[0] / max(wide, 1e-9), room[1] / max(high, 1e-9))
        paper = replace(paper, scale=max(paper.scale * ratio, SMALLEST / paper.reach))
        if abs(ratio - 1) < 1e-3:
            break
    return _pieces(drawing, paper)


def _paper(drawing: Drawing, numbers: Numbers) -> OnPaper:
    fixed = [place for mark in drawing.marks if isinstance(mark, Surface) for place in mark.places(numbers)]
    fixed = fixed or [numbers.vector(end) for mark in drawing.marks for end in mark.ends] or [NOUGHT]
    low, high = ([choice(place[k] for place in fixed) for k in range(3)] for choice in (min, max))
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2)
    reach = max(size_of(plus(place, middle, -1.0)) for place in fixed) or 1.0
    return OnPaper(numbers, best_stance(drawing, numbers, reach), 60 / reach, reach, middle, tuple(fixed))


def _labels_at_the_top(pieces: list[Piece], top: float) -> list[Spot]:
    """Return the right ends of the labels at the top, which the arrow of gravity must not cover."""
    tags = [p for p in pieces if isinstance(p, Tag) and p.label is not None and p.towards[0] > 0 and p.way is None]
    return [(tag.spot[0] + tag.gap + LABEL, tag.spot[1]) for tag in tags if tag.spot[1] > top - ARROW]


def _pieces(drawing: Drawing, paper: OnPaper) -> list[Piece]:
    def before(mark: Mark) -> tuple[int, float]:
        if not isinstance(mark, Surface) or drawing.view != SPACE:
            return mark.layer, 0.0
        return mark.layer, dot(mean(mark.places(paper.numbers)), paper.stance.eye)

    ordered = sorted(drawing.marks, key=before)
    pieces = [piece for mark in ordered if mark.layer < LAST for piece in mark.pieces(paper)]
    if drawn := tuple(spot for piece in pieces for spot in piece.spots):
        paper = replace(paper, drawn=(*drawn, *_labels_at_the_top(pieces, max(y for _, y in drawn))))
    pieces += [piece for mark in ordered if mark.layer >= LAST for piece in mark.pieces(paper)]
    return [piece for piece in pieces if not (isinstance(piece, Tag) and piece.label is None)]
