"""The surfaces of bodies: bodies of revolution, ellipsoids, tori, bodies with flat faces, thin bodies, and holes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import hypot
from typing import Any, ClassVar

from derive.figures.marks import BESIDE, InWords, Mark, Position, Surface
from derive.figures.pieces import EdgeNames, InNumbers, Paper, Patch, Piece, Stroke, Tag
from derive.figures.space import NOUGHT, Spot, Vector, dot, hull, plus, rim, unit

UPWARDS = (0.0, 0.0, 1.0)
SIGHT = 120  # number of tested points on the line from a point of a torus to the viewer
EVERY = 8  # only every eighth point of a circle is used for the size of the drawing


@dataclass(frozen=True)
class Revolved(Surface):
    """A convex body of revolution.

    profile   pairs of a height along the axis and the radius there: two for a straight side, many for a curved side
    through   the point of height zero on the axis
    along     the unit vector along the axis
    """

    profile: tuple[tuple[Any, Any], ...]
    through: Position
    along: Position

    def _rings(self, numbers: InNumbers) -> tuple[list[Vector], list[float]]:
        centres = [numbers.vector(self.through + height * self.along) for height, _ in self.profile]
        return centres, [numbers.of(radius) for _, radius in self.profile]

    def places(self, numbers: InNumbers) -> list[Vector]:
        along, rings = numbers.vector(self.along), list(zip(*self._rings(numbers), strict=True))
        far = [rim(*ring, along) for ring in (rings if len(rings) == 2 else rings[::EVERY])]
        return [place for around in far for place in around[:-1:EVERY]]

    def pieces(self, paper: Paper) -> list[Piece]:
        return paper.revolved(*self._rings(paper.numbers))

    def nearest_rim(self, paper: Paper) -> tuple[Spot, ...]:
        """Return the circle at the end that is nearer to the viewer."""
        along, rings = paper.numbers.vector(self.along), list(zip(*self._rings(paper.numbers), strict=True))
        centre, radius = max((rings[0], rings[-1]), key=lambda ring: dot(ring[0], paper.stance.eye))
        return paper.spots(*rim(centre, radius, along))


@dataclass(frozen=True)
class SliceMark(Revolved):
    """A thin slice of a round body perpendicular to its axis, with its radius as its label.

    height      the symbol of the height of the slice
    thickness   the label for the thickness of the slice
    """

    height: Any = field(default=None, metadata=BESIDE)
    thickness: Any = field(default=None, metadata=BESIDE)
    layer: ClassVar[int] = 1

    def pieces(self, paper: Paper) -> list[Piece]:
        centres, radii = self._rings(paper.numbers)
        found = [replace(p, fill="body") if isinstance(p, Patch) else p for p in paper.revolved(centres, radii)]
        spots = [spot for piece in found for spot in piece.spots]
        left, right = (choice(spots, key=lambda spot: spot[0]) for choice in (min, max))
        middle = paper.spot(centres[-1])
        return [
            *found,
            Stroke((middle, (right[0], middle[1])), "hidden"),
            Tag(self.label, (right[0], middle[1]), (1.0, 0.0), 4.0),
            Tag(self.thickness, (left[0], left[1]), (-1.0, 0.0), 4.0),
        ]

    def in_words(self) -> InWords:
        return "slice", {"height": self.height, "radius": self.label}


@dataclass(frozen=True)
class EllipsoidMark(Surface):
    """An ellipsoid with semi-axes along x, y and z: its outline, and the visible parts of its principal sections."""

    centre: Position
    semi_axes: tuple[Any, Any, Any]

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [self._at(numbers, u) for k in range(3) for u in rim(NOUGHT, 1.0, _unit_along(k))[:-1:EVERY]]

    def pieces(self, paper: Paper) -> list[Piece]:
        sizes = [paper.numbers.of(size) for size in self.semi_axes]
        # The normal at the point (a_1 u_1, a_2 u_2, a_3 u_3), with |u| = 1, has the components u_i/a_i.
        x, y, z = (e / size for e, size in zip(paper.stance.eye, sizes, strict=True))
        facing = (x, y, z)
        outline = paper.spots(*(self._at(paper.numbers, u) for u in rim(NOUGHT, 1.0, facing)))
        pieces: list[Piece] = [Patch(outline, "solid")]
        for k in range(3):
            around = rim(NOUGHT, 1.0, _unit_along(k))
            runs = parts_where(around, [dot(u, facing) >= 0 for u in around])
            pieces += [Stroke(paper.spots(*(self._at(paper.numbers, u) for u in run)), "thin") for run in runs]
        return [*pieces, Stroke(outline, "edge")]

    def _at(self, numbers: InNumbers, u: Vector) -> Vector:
        x, y, z = (share * numbers.of(size) for share, size in zip(u, self.semi_axes, strict=True))
        return plus(numbers.vector(self.centre), (x, y, z))


@dataclass(frozen=True)
class TorusMark(Surface):
    """A torus about the z axis.

    radius    the distance from the centre of the torus to the centre of its cross-section
    section   the radius of the cross-section
    """

    centre: Position
    radius: Any
    section: Any

    def places(self, numbers: InNumbers) -> list[Vector]:
        centre, big, small = self._sizes(numbers)
        rings = [(big + small, 0.0), (big, small), (big, -small)]
        found = (rim(plus(centre, UPWARDS, height), radius, UPWARDS) for radius, height in rings)
        return [place for ring in found for place in ring[:-1:EVERY]]

    def pieces(self, paper: Paper) -> list[Piece]:
        outer, inner = (self._contour(paper, side) for side in (1.0, -1.0))
        seen = [[self._is_seen(paper, place) for place in side] for side in (outer, inner)]
        pieces: list[Piece] = [Patch(hull(paper.spots(*outer)), "solid")]
        if hole := self._hole(paper, [place for place, flag in zip(inner, seen[1], strict=True) if flag]):
            pieces.append(Patch(hull(hole)))
        runs = (run for side, flags in zip((outer, inner), seen, strict=True) for run in parts_where(side, flags))
        return [*pieces, *(Stroke(paper.spots(*run), "edge") for run in runs)]

    def _sizes(self, numbers: InNumbers) -> tuple[Vector, float, float]:
        return numbers.vector(self.centre), numbers.of(self.radius), numbers.of(self.section)

    def _contour(self, paper: Paper, side: float) -> list[Vector]:
        """Return the outer or inner curve on which the normal of the surface is perpendicular to the line of sight."""
        centre, big, small = self._sizes(paper.numbers)
        eye = paper.stance.eye
        found = []
        for out in rim(NOUGHT, 1.0, UPWARDS):
            normal = unit((eye[2] * out[0], eye[2] * out[1], -dot(out, eye)))
            found.append(plus(plus(centre, out, big), normal, side * small))
        return found

    def _hole(self, paper: Paper, edge: Sequence[Vector]) -> list[Spot]:
        """Return the points of the inner edge that bound the visible opening; an empty list if there is no opening."""
        centre, eye = paper.numbers.vector(self.centre), paper.stance.eye
        behind = [paper.spot(place) for place in edge if dot(plus(place, centre, -1.0), eye) < 0]
        ends = [x for x, _ in behind]
        return [spot for spot in paper.spots(*edge) if min(ends) <= spot[0] <= max(ends)] if len(behind) > 2 else []

    def _is_seen(self, paper: Paper, place: Vector) -> bool:
        """Return whether no part of the torus is between a point and the viewer."""
        centre, big, small = self._sizes(paper.numbers)
        for k in range(1, SIGHT):
            x, y, z = plus(plus(place, paper.stance.eye, 4.0 * big * k / SIGHT), centre, -1.0)
            if hypot(hypot(x, y) - big, z) < 0.97 * small:
                return False
        return True


def _unit_along(k: int) -> Vector:
    return float(k == 0), float(k == 1), float(k == 2)


def parts_where(places: Sequence[Vector], flags: Sequence[bool]) -> list[list[Vector]]:
    """Return the parts of a curve on which the flags are true; a single point is not a part."""
    found: list[list[Vector]] = []
    for i, (place, flag) in enumerate(zip(places, flags, strict=True)):
        if flag:
            if i == 0 or not flags[i - 1]:
                found.append([])
            found[-1].append(place)
    return [run for run in found if len(run) > 1]


@dataclass(frozen=True)
class Polyhedron(Surface):
    """A convex body with flat faces, or a plane figure in space.

    faces     the indices of the corners of each face, in order; empty if the corners form a single face
    lengths   labels for lengths, each written at one of the edges with this length
    """

    corners: tuple[Position, ...]
    faces: tuple[tuple[int, ...], ...] = ()
    lengths: EdgeNames = field(default=(), metadata=BESIDE)

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(corner) for corner in self.corners]

    def vertices(self, numbers: InNumbers) -> list[Vector]:
        return self.places(numbers) if self.faces else []

    def pieces(self, paper: Paper) -> list[Piece]:
        places = self.places(paper.numbers)
        if self.faces:
            return paper.polyhedron(places, self.faces, self.lengths)
        return _bounded(paper.spots(*places, places[0]))

    def in_words(self) -> InWords | None:
        return super().in_words() or (None if self.faces else ("polygon", {"corners": len(self.corners)}))


@dataclass(frozen=True)
class ThinRod(Surface):
    """A rod without visible thickness, or a part of such a rod."""

    start: Position
    end: Position

    def places(self, numbers: InNumbers) -> list[Vector]:
        return [numbers.vector(self.start), numbers.vector(self.end)]

    def pieces(self, paper: Paper) -> list[Piece]:
        return [Stroke(paper.spots(*self.places(paper.numbers)), "rod")]


@dataclass(frozen=True)
class Circle(Surface):
    """A circle perpendicular to `normal`; `filled` is true if the circle bounds a body."""

    centre: Position
    normal: Position
    radius: Any
    filled: bool = False

    def _rim(self, numbers: InNumbers) -> list[Vector]:
        return rim(numbers.vector(self.centre), numbers.of(self.radius), numbers.vector(self.normal))

    def places(self, numbers: InNumbers) -> list[Vector]:
        return self._rim(numbers)[:-1:EVERY]

    def pieces(self, paper: Paper) -> list[Piece]:
        return _bounded(paper.spots(*self._rim(paper.numbers)), self.filled)

    def in_words(self) -> InWords:
        return super().in_words() or ("circle", {"radius": self.radius})


@dataclass(frozen=True)
class TableMark(Circle):
    """A round horizontal table; the bodies are above it, so the table hides none of them."""

    layer: ClassVar[int] = -2  # below the curves on the table

    def in_words(self) -> InWords:
        return "table", {}


@dataclass(frozen=True)
class Cavity(Mark):
    """A cavity inside a body, drawn as a blank area with a dashed outline, so that it does not look like a part."""

    of: Surface
    layer: ClassVar[int] = 2

    def pieces(self, paper: Paper) -> list[Piece]:
        patches = [piece for piece in self.of.pieces(paper) if isinstance(piece, Patch)]
        blank = [Patch(patch.spots) for patch in patches]
        return [*blank, *(Stroke((*patch.spots, patch.spots[0]), "hidden") for patch in patches)]

    def in_words(self) -> InWords | None:
        return ("cavity", {"name": self.of.name, "measures": self.of.measures}) if self.of.name else None


@dataclass(frozen=True)
class Bore(Cavity):
    """A bore through a body: its rim on the side of the viewer, and its other lines dashed."""

    def pieces(self, paper: Paper) -> list[Piece]:
        assert isinstance(self.of, Revolved)
        near = self.of.nearest_rim(paper)
        strokes = (piece for piece in self.of.pieces(paper) if isinstance(piece, Stroke))
        return [*(replace(stroke, pen="hidden") for stroke in strokes), Patch(near, "body"), Stroke(near, "edge")]


@dataclass(frozen=True)
class Hole(Cavity):
    """A hole in a flat body, drawn as a blank area with an edge over the body."""

    def pieces(self, paper: Paper) -> list[Piece]:
        rims = [piece.spots for piece in self.of.pieces(paper) if isinstance(piece, Patch)]
        return [piece for rim in rims for piece in (Patch(rim), Stroke((*rim, rim[0]), "edge"))]


def _bounded(spots: tuple[Spot, ...], filled: bool = True) -> list[Piece]:
    return [*([Patch(spots, "solid")] if filled else []), Stroke(spots, "edge")]
