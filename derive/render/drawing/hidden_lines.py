"""The paper of a drawing: it projects positions to points, and finds the hidden lines of surfaces.

The surfaces in this module are convex, so an edge is hidden if both faces that meet at it face away from the eye.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from derive.figures.pieces import Edge, EdgeNames, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import (
    NOUGHT,
    Spot,
    Vector,
    cross,
    direction,
    dot,
    hull,
    mean,
    midway,
    plus,
    rim,
    size_of,
    unit,
)

FLAT = 0.25  # least height in units of the radius: a flatter body has no dashed lines


class OnPaper(Paper):
    """Paper that determines which lines are hidden."""

    # --- flat faces ---

    def polyhedron(self, corners: Sequence[Vector], faces: Sequence[Sequence[int]], lengths: EdgeNames) -> list[Piece]:
        """Draw all edges, dashed where hidden, with the names of lengths next to edges of the outline."""
        middle = mean(list(corners))
        named = [(name, [(min(edge), max(edge)) for edge in edges]) for name, edges in lengths]
        facing: dict[Edge, list[bool]] = {edge: [] for _, edges in named for edge in edges}
        for face in faces:
            a, b, c = (corners[i] for i in face[:3])
            normal = unit(cross(plus(b, a, -1.0), plus(c, a, -1.0)))
            outward = 1.0 if dot(normal, plus(a, middle, -1.0)) > 0 else -1.0
            for i, j in pairwise([*face, face[0]]):
                facing.setdefault((min(i, j), max(i, j)), []).append(outward * dot(normal, self.stance.eye) > 1e-9)
        lines = {(i, j): self.spots(corners[i], corners[j]) for i, j in facing}
        hidden = [edge for edge, flags in facing.items() if not any(flags)]
        outer = {edge for edge, flags in facing.items() if any(flags) and not all(flags)}
        return [
            Patch(hull(self.spots(*corners)), "solid"),
            *(Stroke(lines[edge], "hidden") for edge in hidden),
            *(Stroke(line, "edge") for edge, line in lines.items() if edge not in hidden),
            *(self._beside(name, [lines[e] for e in edges if e in outer]) for name, edges in named if outer & {*edges}),
        ]

    def _beside(self, name: object, lines: Sequence[tuple[Spot, ...]]) -> Tag:
        spot = min((midway(*line) for line in lines), key=lambda at: (round(at[1], 6), at[0]))
        return Tag(name, spot, direction(self.spot(self.middle), spot))

    # --- bodies of revolution ---

    def revolved(self, centres: Sequence[Vector], radii: Sequence[float]) -> list[Piece]:
        """Draw the rims of both ends, dashed where hidden, and the side of the body.

        A straight side is drawn as the lines of its outline, any other side as the outline of all its circles.
        """
        wide, narrow = (0, -1) if radii[0] >= radii[-1] else (-1, 0)
        normal = plus(centres[narrow], centres[wide], -1.0)
        rings = [rim(centre, radius, normal) for centre, radius in zip(centres, radii, strict=True)]
        outwards, eye = rim(NOUGHT, 1.0, normal), self.stance.eye
        axis = unit(plus(centres[-1], centres[0], -1.0))

        def side(k: int) -> list[float]:
            """Return, for each point around ring k, how much the side between this ring and the next faces the eye."""
            height, widening = size_of(plus(centres[k + 1], centres[k], -1.0)), radii[k + 1] - radii[k]
            return [height * dot(outward, eye) - widening * dot(axis, eye) for outward in outwards]

        is_flat = size_of(normal) < FLAT * max(radii)
        pieces: list[Piece] = [Patch(hull(self.spots(*(place for ring in rings for place in ring))), "solid")]
        for end, sense, facing in ((0, -1.0, side(0)), (-1, 1.0, side(len(rings) - 2))):
            if radii[end]:
                seen = [sense * dot(axis, eye) > 0 or at >= 0 for at in facing]
                pieces += [stroke for stroke in self._rim(rings[end], seen) if stroke.pen == "edge" or not is_flat]
        if len(rings) > 2:
            return [*pieces, Stroke((*pieces[0].spots, pieces[0].spots[0]), "edge")]
        sides = ([_between(ring, *turn) for ring in rings] for turn in _turns(side(0)))
        return [*pieces, *(Stroke(self.spots(*side), "edge") for side in sides)]

    def _rim(self, rim: Sequence[Vector], seen: Sequence[bool]) -> list[Stroke]:
        """Return a closed curve as strokes, dashed where it is hidden; hidden strokes come first."""
        strokes: list[Stroke] = []
        begin = 0
        for i in range(1, len(rim)):
            if seen[i] != seen[begin] or i == len(rim) - 1:
                strokes.append(Stroke(self.spots(*rim[begin : i + 1]), "edge" if seen[begin] else "hidden"))
                begin = i
        return sorted(strokes, key=lambda stroke: stroke.pen != "hidden")


def _turns(facing: Sequence[float]) -> list[tuple[int, float]]:
    """Return the places on the rim where a side begins or ceases to face the eye. Each place is the index of a rim
    point, and a fraction of the distance from this point to the next."""
    pairs = enumerate(pairwise(facing))
    return [(i, at / (at - after)) for i, (at, after) in pairs if (at >= 0) != (after >= 0)]


def _between(ring: Sequence[Vector], i: int, share: float) -> Vector:
    return plus(ring[i], plus(ring[i + 1], ring[i], -1.0), share)
