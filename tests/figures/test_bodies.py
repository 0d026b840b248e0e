"""Tests of bodies that the package does not have: each is defined by one class, and is integrated, named and drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import acos, cos, degrees, hypot, isclose, radians, sqrt
from operator import sub
from typing import Any, ClassVar

import pytest
import sympy
from sympy import Expr, Integer, Rational, Symbol, diag, pi, symbols
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, column
from derive.errors import Rejected
from derive.figures import centre_mark, drawing, outline, sketch
from derive.figures.annotations import Axis, LengthMark, Line
from derive.figures.bodies import is_in_plane, seen_outline
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Surface
from derive.figures.pieces import Patch
from derive.figures.surfaces import Bore, Cavity, Circle, EllipsoidMark, Hole, Polyhedron, Revolved, SliceMark, ThinRod
from derive.mechanics import (
    Annulus,
    Ball,
    Composite,
    Cone,
    Cuboid,
    Cylinder,
    Disc,
    Ellipsoid,
    HalfDisc,
    Hoop,
    Plate,
    PointMass,
    Rod,
    Sheet,
    Solid,
    System,
    ThickShell,
    Torus,
    Triangle,
    Tube,
    Wire,
    X,
    Z,
    coordinate,
    inertia_tensor,
    minus,
    space,
)
from derive.mechanics.bodies.edged_bodies import EdgedBody
from derive.mechanics.bodies.equimomental import Particles
from derive.mechanics.bodies.regions import Point, Region
from derive.mechanics.bodies.solids import RoundSolid
from derive.page.depiction import alternative
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.drawing.camera import USUAL
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.record import Run, recorded
from tests.courses import ROOT
from tests.figures.scenery import CONE, M, R, a, h, pieces_of, plane, strokes, theta


@dataclass(frozen=True)
class Spheroid(RoundSolid):
    """A ball of radius R that is stretched along z to the half length h."""

    radius: Expr
    half: Expr
    mass: Expr
    id: ClassVar[str] = "spheroid"

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return -self.half, self.half

    def radius_at(self, z: Expr) -> Expr:
        return self.radius * sympy.sqrt(self.half**2 - z**2) / self.half

    def edge_condition(self, z: Expr, r: Expr) -> tuple[Expr, Expr]:
        """The section is an ellipse with the semi-axes R and h."""
        return r**2 / self.radius**2 + z**2 / self.half**2, Integer(1)

    @property
    def measures(self) -> Mapping[str, Any]:
        return {"radius": self.radius, "length": 2 * self.half}

    @property
    def extent(self) -> Expr:
        return Factors(Rational(4, 3), pi, self.radius**2, self.half)

    def points(self) -> Mapping[str, Point]:
        return {"centre": Point("centre", column(0, 0, 0))}

    def particles(self) -> Particles:
        ends = [(self.radius, 0, 0), (0, self.radius, 0), (0, 0, self.half)]
        pairs = [column(*(sign * x for x in end)) for end in ends for sign in (1, -1)]
        return [(Rational(2, 5) * self.mass, column(0, 0, 0)), *((self.mass / 10, place) for place in pairs)]


@dataclass(frozen=True)
class Pyramid(EdgedBody):
    """A pyramid of height h on a square of side a; the middle of the square is the origin."""

    side: Expr
    height: Expr
    mass: Expr
    id: ClassVar[str] = "square_pyramid"
    reference: ClassVar[str] = "base"

    @property
    def corners(self) -> tuple[ImmutableMatrix, ...]:
        square = (-1, -1), (1, -1), (1, 1), (-1, 1)
        return (*(column(x * self.side / 2, y * self.side / 2, 0) for x, y in square), column(0, 0, self.height))

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        return (0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)

    @property
    def edges(self) -> tuple[tuple[Expr, tuple[tuple[int, int], ...]], ...]:
        return ((self.side, ((0, 1), (1, 2), (2, 3), (0, 3))),)

    @property
    def extent(self) -> Expr:
        return Factors(Rational(1, 3), self.side**2, self.height)

    def points(self) -> Mapping[str, Point]:
        return {"base": Point("base", column(0, 0, 0))}

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        x, y, z = sympy.symbols("x y z", real=True)
        p, q, s = point.position
        half = self.side * (self.height - z - s) / (2 * self.height)
        limits = ((z, -s, self.height - s), (y, -half - q, half - q), (x, -half - p, half - p))
        return Region(limits, column(x, y, z))

    def particles(self) -> Particles:
        found = [(self.mass / 20, column(0, 0, self.height))]
        for share, at, size in ((Rational(4, 5), Rational(1, 4), Rational(3, 4)), (Rational(3, 20), 0, 1)):
            far, z = size * self.side / 2, at * self.height
            middles = ((far, 0), (-far, 0), (0, far), (0, -far))
            found.append((share * self.mass / 3, column(0, 0, z)))
            found += [(share * self.mass / 6, column(x, y, z)) for x, y in middles]
        return found


SPHEROID, PYRAMID = Spheroid(R, h, M), Pyramid(a, h, M)


def in_words(body: object, **options: Any) -> str:
    found = drawing("one", outline(body, **options))
    return inline_text(alternative(None, found, None, phrases(templates_of(ROOT))), Notation())


@pytest.mark.parametrize(
    ("body", "moments"),
    [
        (SPHEROID, (M * (R**2 + h**2) / 5, M * (R**2 + h**2) / 5, 2 * M * R**2 / 5)),
        (PYRAMID, (M * (a**2 / 20 + h**2 / 10), M * (a**2 / 20 + h**2 / 10), M * a**2 / 10)),
    ],
)
def test_a_body_of_ones_own_has_the_moments_of_the_books(body: Any, moments: tuple[Expr, ...]) -> None:
    tensor = inertia_tensor(body, body.reference)
    assert (tensor.value - diag(*moments)).expand() == sympy.zeros(3)


def test_a_body_of_ones_own_is_told_by_its_own_name_and_measures() -> None:
    assert in_words(SPHEROID, named=False) == "A drawing in space of a spheroid of radius R and length 2h."
    assert in_words(PYRAMID, named=False) == "A drawing in space of a square pyramid of side a and height h."
    assert in_words(Plate((R, h), M)).startswith("A drawing in space of a plate with edges R and h")
    assert in_words(Ball(R, M)) == "A drawing in space of a ball of radius R and the axes x, y and z."


def test_the_outline_of_a_curved_body_is_what_its_shadow_is() -> None:
    """The outline is an ellipse of half width R and half height sqrt((h cos e)^2 + (R sin e)^2), where e is the
    elevation."""
    (edge,) = strokes(pieces_of(drawing("one", outline(SPHEROID, named=False)), R=1.0, h=2.0), "edge")
    wide, high = (max(s[k] for s in edge.spots) - min(s[k] for s in edge.spots) for k in (0, 1))
    e = acos(USUAL.up[2])
    assert degrees(e) == pytest.approx(18)
    assert high / wide == pytest.approx(sqrt(4 * cos(e) ** 2 + 1 - cos(e) ** 2), rel=2e-3)
    assert edge.spots[0] == edge.spots[-1]


def test_the_edges_of_a_pyramid_are_hidden_behind_it() -> None:
    pieces = pieces_of(drawing("one", outline(PYRAMID, named=False)), a=1.0, h=1.0)
    hidden, seen = strokes(pieces, "hidden"), strokes(pieces, "edge")
    assert (len(hidden), len(seen)) == (3, 5)
    behind = set.intersection(*({(round(x, 6), round(y, 6)) for x, y in stroke.spots} for stroke in hidden))
    assert len(behind) == 1
    assert isclose(radians(18), acos(USUAL.up[2]))


def test_the_measures_of_a_body_of_ones_own_are_written_beside_it() -> None:
    marks = outline(SPHEROID)
    (radius,) = [mark for mark in marks if isinstance(mark, Line) and mark.label is not None]
    assert (radius.label, list(radius.start), list(radius.end)) == (R, [0, R, 0], [0, 0, 0])
    assert [mark.label for mark in marks if isinstance(mark, LengthMark)] == [2 * h]
    (solid,) = [mark for mark in outline(PYRAMID) if isinstance(mark, Polyhedron)]
    assert [length for length, _ in solid.lengths] == [a]


def test_a_body_of_ones_own_is_drawn_anywhere_and_kept() -> None:
    spinning = Composite(Rod(2 * h, M).at(0, 0, h), SPHEROID.at(0, 0, h), points={"pivot": (0, 0, 0)})
    with recorded(Run()):
        phi = coordinate("phi")
        top = sketch("top", System(spinning.held(space.turned(Z, phi).turned(X, theta), at="pivot")))
    solids = [drawing("solid", outline(PYRAMID)), top]
    assert list(drawings_from_data(drawings_to_data(solids))) == solids
    assert [mark.name for mark in top.marks if isinstance(mark, Surface)] == ["rod", "", "spheroid"]
    assert strokes(pieces_of(top), "edge")


# --- bodies of the package -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "kind"),
    [(Rod(h, M), ThinRod), (Hoop(R, M), Circle), (Disc(R, M), Revolved), (Ball(R, M), Revolved), (PYRAMID, Polyhedron)],
)
def test_what_a_body_looks_like_follows_from_its_profile(body: Any, kind: type) -> None:
    (found,) = outline(body, named=False)
    assert type(found) is kind


def test_only_a_curved_side_needs_more_circles_than_its_ends() -> None:
    counts = [len(outline(body, named=False)[0].profile) for body in (Cone(R, h, M), Cylinder(R, h, M))]  # type: ignore[attr-defined]
    assert counts == [2, 2]
    assert len(outline(Ball(R, M), named=False)[0].profile) > 20  # type: ignore[attr-defined]


def test_the_radius_of_a_ball_is_drawn_from_its_centre() -> None:
    (radius,) = [mark for mark in outline(Ball(R, M)) if isinstance(mark, Line)]
    assert list(radius.end) == [0, 0, 0]


def test_what_is_no_body_has_no_outline() -> None:
    with pytest.raises(Rejected, match="outline of a PointMass"):
        outline(PointMass(M))
    with pytest.raises(Rejected, match="outline of a str"):
        outline("rod")


def test_an_outline_has_the_sides_of_the_body() -> None:
    sides = (a, 2 * a, h)
    box = next(mark for mark in outline(Cuboid(sides, M)) if isinstance(mark, Polyhedron))
    assert tuple(box.corners[-1] - box.corners[0]) == sides
    assert [length for length, _ in box.lengths] == list(sides)


@pytest.mark.parametrize(("about", "tip", "base"), [("apex", 0, h), ("base", h, 0), ("centre", -3 * h / 4, h / 4)])
def test_a_cone_is_seen_from_its_points(about: str, tip: object, base: object) -> None:
    (mark,) = [mark for mark in outline(CONE, about) if isinstance(mark, Revolved)]
    assert [(list(mark.through + z * mark.along), radius) for z, radius in mark.profile] == [
        ([0, 0, tip], 0),
        ([0, 0, base], R),
    ]
    assert [each.label for each in outline(CONE, about) if isinstance(each, LengthMark)] == [h]


@pytest.mark.parametrize(
    ("body", "kind"),
    [(Cylinder(R, h, M), Revolved), (Ball(R, M), Revolved), (Hoop(R, M), Circle), (Plate((R, h), M), Polyhedron)],
)
def test_every_body_has_an_outline(body: object, kind: type) -> None:
    assert sum(isinstance(mark, kind) for mark in outline(body)) == 1
    assert len(outline(body, named=False)) == 1


def test_a_triangle_tells_each_length_of_its_sides_once_and_both_equal_sides() -> None:
    isosceles = Triangle(((0, 0), (a, 0), (0, a)), M)
    assert [mark.label for mark in outline(isosceles) if isinstance(mark, LengthMark)] == [a, a]
    other = Triangle(((0, 0), (3 * a, 0), (0, 4 * R)), M)
    assert [mark.label for mark in outline(other) if isinstance(mark, LengthMark)] == [3 * a, 4 * R]


# --- bodies of several parts, and others -----------------------------------------------------------------------------

l, b = sympy.symbols("l b", positive=True)
DUMBBELL = Composite(
    Rod(2 * l, M).at(0, 0, 0),
    Ball(R, M).named("upper ball").at(0, 0, l + R),
    Ball(R, M).named("lower ball").at(0, 0, -l - R),
)
CLOCK = Composite(
    Rod(l, M).turned("x", pi / 2).at(0, 0, 0, of="end"), Disc(R, M).at(0, -l, 0), points={"pivot": (0, 0, 0)}
)
HOLED = Composite(Ball(R, M), minus(Ball(R / 2, M / 8).named("hole").at(0, 0, R / 2)))


def test_each_part_is_drawn_where_it_is_and_equal_sizes_are_told_once() -> None:
    marks = outline(DUMBBELL)
    rod, *balls = (mark for mark in marks if isinstance(mark, Surface))
    assert isinstance(rod, ThinRod) and (rod.start, rod.end) == (column(0, 0, -l), column(0, 0, l))
    assert [ball.through for ball in balls if isinstance(ball, Revolved)] == [column(0, 0, l + R), column(0, 0, -l - R)]
    assert [mark.label for mark in marks if isinstance(mark, Line | LengthMark)] == [2 * l, R]


def test_a_part_that_is_turned_is_seen_from_the_point_that_is_named() -> None:
    disc, rod = (mark for mark in outline(CLOCK, "pivot", named=False) if isinstance(mark, Surface))
    assert isinstance(rod, ThinRod) and {rod.start, rod.end} == {column(0, 0, 0), column(0, -l, 0)}
    assert isinstance(disc, Revolved) and (disc.through, disc.along) == (column(0, -l, 0), column(0, 0, 1))


def test_a_body_in_the_plane_of_x_and_y_has_no_third_axis() -> None:
    assert is_in_plane(CLOCK) and not is_in_plane(DUMBBELL) and not is_in_plane(Disc(R, M))
    for body, names in ((CLOCK, "xy"), (DUMBBELL, "xyz")):
        assert "".join(str(mark.label) for mark in outline(body) if isinstance(mark, Axis)) == names


def test_what_is_cut_out_is_dashed_and_told_and_kept() -> None:
    found = drawing("one", outline(HOLED))
    (cavity,) = (mark for mark in found.marks if isinstance(mark, Cavity))
    assert isinstance(cavity.of, Revolved) and cavity.of.through == column(0, 0, R / 2)
    assert drawings_from_data(drawings_to_data([found])) == (found,)
    assert (
        in_words(HOLED, named=False)
        == "A drawing in space of a ball of radius R and a ball of radius R/2 cut out of it."
    )


def test_a_hollow_ball_is_told_as_one() -> None:
    shell = ThickShell(a, b, M)
    assert in_words(shell, named=False) == "A drawing in space of a hollow ball of inner radius a and outer radius b."
    assert [mark.label for mark in outline(shell) if isinstance(mark, Line)] == [b, a]
    whole, removed = shell.whole_and_removed()
    assert sympy.simplify(whole.mass - removed.mass - M) == 0
    assert (whole.mass / removed.mass).expand() == b**3 / a**3


@pytest.mark.parametrize(
    ("body", "room", "told"),
    [
        (Annulus(R / 2, R, M), Hole, "an annulus of inner radius R/2 and outer radius R"),
        (Tube(R / 2, R, h, M), Bore, "a hollow cylinder of inner radius R/2, outer radius R and height h"),
    ],
)
def test_what_has_room_in_it_has_the_edges_of_both(body: Any, room: type[Cavity], told: str) -> None:
    rim, inner, *_ = found = outline(body)
    assert type(inner) is room
    assert in_words(body, named=False) == f"A drawing in space of {told}."
    assert {mark.label for mark in found if isinstance(mark, Line)} == {R / 2, R}
    edges = strokes(pieces_of(drawing("one", [rim, inner])), "edge")
    closed = [edge.spots for edge in edges if hypot(*map(sub, edge.spots[0], edge.spots[-1])) < 1e-6]
    wide, narrow = (max(x for x, _ in spots) - min(x for x, _ in spots) for spots in closed)
    assert wide == pytest.approx(2 * narrow)


def test_a_round_hole_in_a_flat_body_is_seen_through() -> None:
    plate = Composite(Disc(R, M), minus(Disc(R / 3, M / 9).named("hole").at(0, R / 2, 0)))
    hole = next(mark for mark in outline(plate) if isinstance(mark, Hole))
    assert isinstance(hole.of, Circle) and hole.of.centre == column(0, R / 2, 0) and hole.of.radius == R / 3
    assert [piece.fill for piece in pieces_of(plane(hole)) if isinstance(piece, Patch)] == ["blank"]


def test_where_a_flat_body_meets_itself_is_no_edge() -> None:
    r, u = symbols("r u", positive=True)
    around = (r * sympy.cos(u), r * sympy.sin(u), 0)
    (rim,) = outline(Sheet(around, {r: (0, R), u: (0, 2 * pi)}, mass=M), named=False)
    assert isinstance(rim, Polyhedron) and len(rim.corners) > 20
    assert all(sympy.simplify(x**2 + y**2 - R**2) == 0 for x, y, _ in rim.corners)
    assert seen_outline(Sheet(around, {r: (R / 2, R), u: (0, 2 * pi)}, mass=M)) == []


def test_a_flat_body_is_drawn_by_its_edge_and_a_straight_wire_by_its_ends() -> None:
    half, *_ = outline(HalfDisc(R, M), named=False)
    assert isinstance(half, Polyhedron)
    arc = [corner for corner in half.corners if corner[1] != 0]
    assert len(arc) > 20 and all(sympy.simplify(x**2 + y**2 - R**2) == 0 and z == 0 for x, y, z in arc)
    assert {tuple(corner) for corner in half.corners} > {(R, 0, 0), (0, 0, 0), (-R, 0, 0)}
    s = Symbol("s", real=True)
    wire, length, *_ = outline(Wire((2 * s, 0, 0), {s: (0, l)}, mass=M))
    assert isinstance(wire, ThinRod) and (wire.start, wire.end) == (column(0, 0, 0), column(2 * l, 0, 0))
    assert isinstance(length, LengthMark) and length.label == 2 * l


@pytest.mark.parametrize(
    "body",
    [
        Composite(Cuboid((a, a, a), M), minus(Cylinder(R, a, M / 9).at(a / 2, a / 2, a / 2))),
        Composite(Ball(R, M), Torus(b, a, M).at(0, 0, 3 * R)),
        Wire((R * sympy.cos(theta), R * sympy.sin(theta), 0), {theta: (0, 1)}, mass=M),
    ],
    ids=["a hole with a rim", "a part that is not known", "a bent wire"],
)
def test_what_would_be_drawn_wrong_has_no_outline(body: Any) -> None:
    assert seen_outline(body) == []
    with pytest.raises(Rejected, match="the outline of a"):
        outline(body)


@pytest.mark.parametrize(("about", "radius"), [("apex", "R*z/h"), ("base", "R*(h - z)/h")])
def test_a_slice_of_a_cone_has_the_radius_that_the_cone_has_there(about: str, radius: str) -> None:
    marks = outline(CONE, about, sliced=True)
    (cut,) = [mark for mark in marks if isinstance(mark, SliceMark)]
    assert str(cut.label) == radius
    (low, near), (high, far) = cut.profile
    assert near == far
    numbers = {"z": float(low.subs(h, 1)), "R": 1.0, "h": 1.0}
    there = cut.label.subs({letter: numbers[letter.name] for letter in cut.label.free_symbols})
    assert float(near.subs(R, 1)) == pytest.approx(float(there), abs=0.06)
    assert 0 < (high - low) / h < Rational(1, 10)
    heights = {str(mark.label): mark.end[2] for mark in marks if isinstance(mark, LengthMark)}
    assert heights == {"h": h, "z": low}
    told = inline_text(alternative(None, drawing("cut", marks), None, phrases(templates_of(ROOT))), Notation())  # type: ignore[arg-type]
    assert "a slice of radius" in told


def test_only_a_round_solid_is_sliced() -> None:
    assert outline(Disc(R, M), sliced=True) == outline(Disc(R, M))
    assert outline(Cuboid((a, a, a), M), sliced=True) == outline(Cuboid((a, a, a), M))


def test_a_centre_of_mass_to_be_found_is_seen_and_not_told() -> None:
    mark = centre_mark(CONE)
    assert list(mark.at) == [0, 0, 3 * h / 4]
    told = mark.in_words()
    assert told is not None
    assert told[1]["place"] is None
    assert list(centre_mark(CONE, "base", "S").at) == [0, 0, h / 4]


@pytest.mark.parametrize("about", ["corner", "centre"])
def test_axes_of_a_block_begin_at_its_point(about: str) -> None:
    marks = outline(Cuboid((a, 2 * a, 3 * a), M), about)
    ends = {str(mark.label): list(mark.start) for mark in marks if isinstance(mark, Axis)}
    share = 1 if about == "corner" else Rational(1, 2)
    assert ends == {"x": [share * a, 0, 0], "y": [0, share * 2 * a, 0], "z": [0, 0, share * 3 * a]}
    inside = [mark for mark in marks if isinstance(mark, Line)]
    assert len(inside) == (0 if about == "corner" else 3)


def test_an_ellipsoid_has_its_half_axes_beside_them() -> None:
    marks = outline(Ellipsoid((a, 2 * a, 3 * a), M))
    assert [str(mark.label) for mark in marks if isinstance(mark, Line)] == ["a", "2*a", "3*a"]
    assert [str(mark.label) for mark in marks if isinstance(mark, Axis)] == ["x", "y", "z"]
    told = inline_text(alternative(None, drawing("egg", marks), None, phrases(templates_of(ROOT))), Notation())  # type: ignore[arg-type]
    assert "an ellipsoid" in told


def test_the_axis_along_a_rod_begins_at_its_end() -> None:
    s = Symbol("s", real=True)
    marks = outline(Wire((s, 0, 0), {s: (0, a)}, mass=M))
    starts = {str(mark.label): list(mark.start) for mark in marks if isinstance(mark, Axis)}
    assert starts == {"x": [a, 0, 0], "y": [0, 0, 0], "z": [0, 0, 0]}


def test_a_ball_that_is_stretched_by_its_map_is_an_ellipsoid() -> None:
    r, u, v = symbols("r u v", real=True)
    limits = {r: (0, 1), u: (0, pi), v: (0, 2 * pi)}
    sphere = (r * sympy.sin(u) * sympy.cos(v), r * sympy.sin(u) * sympy.sin(v), r * sympy.cos(u))
    egg = Solid((a * sphere[0], 2 * a * sphere[1], h * sphere[2]), limits, mass=M)
    (mark,) = outline(egg, named=False)
    assert isinstance(mark, EllipsoidMark) and mark.semi_axes == (a, 2 * a, h)
    assert seen_outline(Solid((a * sphere[0], a * sphere[1] * r, a * sphere[2]), limits, mass=M)) == []
    assert [str(mark.label) for mark in outline(Torus(R, R / 4, M)) if isinstance(mark, Line)] == ["R", "R/4"]
