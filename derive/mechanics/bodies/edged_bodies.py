"""Bodies with edges: plates and solids with flat faces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from itertools import product
from operator import mul
from typing import Any, ClassVar, Self

from sympy import Expr, ImmutableDenseMatrix, Integer, Pow, Rational, sqrt
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, column
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Unverified
from derive.mechanics.bodies.body import ORIGIN, ZERO, Body
from derive.mechanics.bodies.boundary import Faces
from derive.mechanics.bodies.equimomental import HALF, Particles, drawn_out
from derive.mechanics.bodies.mapping import Map, cartesian
from derive.mechanics.bodies.regions import Point, coordinates

__all__ = ["Cuboid", "Plate", "Tetrahedron", "Triangle", "Wedge"]


class EdgedBody(Body):
    """A solid with flat faces, or a flat body with straight edges."""

    corners_called: ClassVar[tuple[str, ...]] = ("corner",)  # names of the first corners, in order

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        """The positions of the corners along the body axes."""
        raise AttributeError(f"{type(self).__name__} must define its corners")

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        """The indices of the corners of each face, in order round the face; empty for a body with a single face."""
        return ()

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        """The lengths that a drawing shows, each with the edges of this length, as pairs of indices of corners."""
        return ()

    @property
    def boundary(self) -> Faces:
        return Faces(self.corners, self.faces, self.edges)

    def points(self) -> Mapping[str, Point]:
        return {name: Point(name, place) for name, place in zip(self.corners_called, self.corners, strict=False)}


@dataclass(frozen=True)
class Plate(EdgedBody):
    """A thin uniform rectangular plate in the plane of x and y, with a corner at the origin and edges along the axes.

    sides    two lengths, along x and y
    mass     the mass of the body
    """

    sides: tuple[Expr, Expr]
    mass: Expr
    id, filling, reference = "plate", "area", "corner"

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"edges": self.sides}

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        a, b = self.sides
        return ORIGIN, column(a, 0, 0), column(a, b, 0), column(0, b, 0)

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        return (self.sides[0], ((0, 1), (2, 3))), (self.sides[1], ((0, 3), (1, 2)))

    @property
    def extent(self) -> Expr:
        return self.sides[0] ** 2 if self.sides[0] == self.sides[1] else Factors(*self.sides)

    def map(self) -> Map:
        return cartesian(self.letters, *((0, side) for side in self.sides), ZERO)

    def particles(self) -> Particles:
        """A sixth of the mass at each edge midpoint and a third at the centre."""
        a, b = self.sides
        middles = ((a / 2, 0), (a / 2, b), (0, b / 2), (a, b / 2))
        return [(self.mass / 3, column(a / 2, b / 2, 0)), *((self.mass / 6, column(x, y, 0)) for x, y in middles)]


@dataclass(frozen=True)
class Cuboid(EdgedBody):
    """A uniform block with a corner at the origin and edges along the axes.

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.

    sides   three lengths, along x, y and z
    mass    the mass of the body
    """

    sides: tuple[Expr, Expr, Expr]
    mass: Expr
    id, reference = "cuboid", "corner"

    @property
    def extent(self) -> Expr:
        """The volume as written on the page: a power for a cube, otherwise a product such as a * 2a * 3a."""
        if len(set(self.sides)) == 1:
            return Pow(self.sides[0], len(self.sides))
        return Factors(*self.sides)

    @property
    def size(self) -> Expr:
        return reduce(mul, self.sides, Integer(1))

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"edges": self.sides}

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        """The corners, in the order of their indices. The bits 4, 2 and 1 of the index of a corner show whether x, y
        and z are not zero there."""
        at = (zip(ends, self.sides, strict=True) for ends in product((0, 1), repeat=3))
        return tuple(column(*(end * side for end, side in corner)) for corner in at)

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        across = ((4, 2, 1), (2, 1, 4), (1, 4, 2))
        return tuple((at, at | a, at | a | b, at | b) for bit, a, b in across for at in (0, bit))

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        return tuple(
            (side, tuple((i, i | bit) for i in range(8) if not i & bit))
            for side, bit in zip(self.sides, (4, 2, 1), strict=True)
        )

    @property
    def middle(self) -> Point:
        return Point("centre", column(*(side / 2 for side in self.sides)))

    def map(self) -> Map:
        return cartesian(self.letters, *((0, side) for side in self.sides))

    def particles(self) -> Particles:
        """Six equal particles at the centres of the faces.

        Along each axis, the two particles at +-side/2 from the centre give 2 (M/6)(side/2)^2 = M side^2/12.
        """
        found = []
        for axis, end in product(range(3), (0, 1)):
            place = [side * (HALF if k != axis else end) for k, side in enumerate(self.sides)]
            found.append((self.mass / 6, column(*place)))
        return found

    def axes_by_name(self) -> Mapping[str, ImmutableMatrix]:
        return {"diagonal": column(*self.sides), **super().axes_by_name()}


class Cornered(EdgedBody):
    """A body defined by the positions of its corners."""

    corners_called: ClassVar[tuple[str, ...]] = ("first corner", "second corner", "third corner", "fourth corner")
    reference = "first corner"

    @property
    def measures(self) -> Mapping[str, Any]:
        return {}


@dataclass(frozen=True)
class Triangle(Cornered):
    """A thin uniform triangular plate in the plane of x and y.

    corners_at   the positions (x, y) of the three corners; each component is a length
    mass         the mass of the body

    `Triangle.on_base(b, h, mass)` has its base along x from the origin. Its top is at the height h, above the middle of
    the base or, if `foot` is given, above x = foot. `Triangle.equilateral(a, mass)` has three sides of length a.
    Points: first corner, second corner, third corner; centre.
    """

    corners_at: tuple[tuple[Expr, Expr], tuple[Expr, Expr], tuple[Expr, Expr]]
    mass: Expr
    id, filling = "triangle", "area"

    def __post_init__(self) -> None:
        super().__post_init__()
        if tidied(self._signed_area) == 0:
            raise Rejected(Complaint("sizes", "the three corners of this triangle are on one line"))

    @classmethod
    def on_base(cls, base: Expr, height: Expr, mass: Expr, foot: Expr | None = None) -> Self:
        """Return a triangle whose top is above the middle of its base or, if `foot` is given, above x = foot."""
        made = cls(((ZERO, ZERO), (base, ZERO), (base / 2 if foot is None else foot + ZERO, height)), mass)
        if tidied(made._signed_area - base * height / 2) != 0:
            raise Unverified(Complaint("unverified", f"{made.name} on a base does not have the area b h/2"))
        left, right = (top.dot(top) for top in (made.corners[2] - corner for corner in made.corners[:2]))
        if foot is None and tidied(left - right) != 0:
            raise Unverified(Complaint("unverified", f"the top of {made.name} is not over the middle of its base"))
        return made

    @classmethod
    def equilateral(cls, side: Expr, mass: Expr) -> Self:
        made = cls.on_base(side, side * sqrt(3) / 2, mass)
        a, b, c = made.corners
        if any(tidied(edge.dot(edge) - side**2) != 0 for edge in (b - a, c - b, a - c)):
            raise Unverified(Complaint("unverified", f"the sides of {made.name} are not all equal"))
        return made

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        return tuple(column(x, y, 0) for x, y in self.corners_at)

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        """The sides whose length is a rational multiple of a symbol. If sides have different multiples of one symbol,
        only the sides with the first of these multiples are listed."""
        found: dict[Expr, tuple[Expr, list[tuple[int, int]]]] = {}
        for i, k in ((0, 1), (0, 2), (1, 2)):
            x, y, _ = self.corners[k] - self.corners[i]
            length = sqrt(tidied(x**2 + y**2))
            letter = length.as_coeff_Mul()[1]
            if letter.is_Symbol:
                known, sides = found.setdefault(letter, (length, []))
                if known == length:
                    sides.append((i, k))
        return tuple((length, tuple(sides)) for length, sides in found.values())

    @property
    def _signed_area(self) -> Expr:
        """The area with a sign, by the shoelace formula: half the sum of cross products of neighbouring corners."""
        (x1, y1), (x2, y2), (x3, y3) = self.corners_at
        return (x1 * (y2 - y3) + x2 * (y3 - y1) + x3 * (y1 - y2)) / 2

    @property
    def _stands_on_x(self) -> bool:
        (x1, y1), (x2, y2), (_, y3) = self.corners_at
        return bool(x1 == y1 == y2 == 0 and x2.is_positive and y3.is_positive)

    @property
    def extent(self) -> Expr:
        if self._stands_on_x:
            return Factors(HALF, self.corners_at[1][0], self.corners_at[2][1])
        area = tidied(self._signed_area)
        return -area if area.could_extract_minus_sign() or area.is_negative else area

    def map(self) -> Map:
        """Variables x and y if the base is on the x axis from the origin, and the base and the height are known to be
        positive. Otherwise the variables are fractions u and v of two sides."""
        if self._stands_on_x:
            (_, (x2, _), (x3, y3)), (x, y) = self.corners_at, coordinates("xy", self.letters)
            return column(x, y, 0), ((y, ZERO, y3), (x, x3 * y / y3, x2 + (x3 - x2) * y / y3))
        u, v = coordinates("uv", self.letters)
        a, b, c = self.corners
        return ImmutableDenseMatrix(a + u * (b - a) + v * (c - a)), ((u, ZERO, Integer(1)), (v, ZERO, 1 - u))

    def particles(self) -> Particles:
        """A third of the mass at the midpoint of each side."""
        a, b, c = self.corners
        return [(self.mass / 3, ImmutableDenseMatrix((p + q) / 2)) for p, q in ((a, b), (b, c), (c, a))]


@dataclass(frozen=True)
class Tetrahedron(Cornered):
    """A uniform solid with four corners.

    corners_at   the positions (x, y, z) of the four corners; each component is a length
    mass         the mass of the body

    Points: first corner, ..., fourth corner; centre.
    """

    corners_at: tuple[tuple[Any, Any, Any], ...]
    mass: Expr
    id = "tetrahedron"
    faces = (0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.corners_at) != 4 or self._sixfold == 0:
            message = "a tetrahedron needs four corners that are not in one plane"
            raise Rejected(Complaint("sizes", message))

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        return tuple(column(*corner) for corner in self.corners_at)

    @property
    def _edges_from_first(self) -> list[ImmutableMatrix]:
        first, *others = self.corners
        return [ImmutableDenseMatrix(c - first) for c in others]

    @property
    def _sixfold(self) -> Expr:
        """Six times the volume, with a sign: the determinant of the three edges from the first corner."""
        return tidied(ImmutableDenseMatrix.hstack(*self._edges_from_first).det())

    @property
    def extent(self) -> Expr:
        sixfold = self._sixfold
        return (-sixfold if sixfold.could_extract_minus_sign() or sixfold.is_negative else sixfold) / 6

    def map(self) -> Map:
        """Variables x, y and z if the first corner is at the origin and the edges from it are along x, y and z in this
        order. Otherwise the variables are fractions u, v, s of these three edges."""
        first, edges = self.corners[0], self._edges_from_first
        if first == ORIGIN and all(e == column(*(e[i] * int(i == k) for i in range(3))) for k, e in enumerate(edges)):
            (a, b, c), (x, y, z) = (e[k] for k, e in enumerate(edges)), coordinates("xyz", self.letters)
            limits = ((x, ZERO, a), (y, ZERO, b * (1 - x / a)), (z, ZERO, c * (1 - x / a - y / b)))
            return column(x, y, z), limits
        u, v, s = coordinates("uvs", self.letters)
        place = first + u * edges[0] + v * edges[1] + s * edges[2]
        limits = ((u, ZERO, Integer(1)), (v, ZERO, 1 - u), (s, ZERO, 1 - u - v))
        return ImmutableDenseMatrix(place), limits

    def particles(self) -> Particles:
        """A twentieth of the mass at each corner, four fifths at the mean of the corners."""
        mean = ImmutableDenseMatrix(sum(self.corners, ORIGIN) / 4)
        return [(Rational(4, 5) * self.mass, mean), *((self.mass / 20, corner) for corner in self.corners)]


@dataclass(frozen=True)
class Wedge(Cornered):
    """A uniform right prism with a triangular base: the triangle in the plane of x and y, extended along z.

    face     the triangular base, a `Triangle`
    length   the length along z, from z = 0
    mass     the mass of the body

    Points: first corner, second corner, third corner (of the face at z = 0); centre.
    """

    face: Triangle
    length: Expr
    mass: Expr
    id = "wedge"
    corners_called = Triangle.corners_called[:3]
    faces = (0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        ends = (ZERO, self.length)
        return tuple(ImmutableDenseMatrix(corner + column(0, 0, z)) for z in ends for corner in self.face.corners)

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"length": self.length}

    @property
    def extent(self) -> Expr:
        area = self.face.extent
        return Factors(*(area.args if isinstance(area, Factors) else (area,)), self.length)

    def map(self) -> Map:
        place, limits = self.face.map()
        (z,) = coordinates(("z",), self.letters)
        return ImmutableDenseMatrix(place + column(0, 0, z)), ((z, ZERO, self.length), *limits)

    def particles(self) -> Particles:
        """Copies of the particles of a triangle at three values of z, weighted by Simpson's rule."""
        return drawn_out(Triangle(self.face.corners_at, self.mass).particles(), (ZERO, self.length))
