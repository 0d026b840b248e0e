"""Tests of sketches of whole systems."""

from __future__ import annotations

import json
from math import hypot
from pathlib import Path
from typing import Any

import pytest
from sympy import cos, pi, sin, symbols

from derive.algebra.expressions import TIME, scalar
from derive.figures import particle, sketch
from derive.figures.annotations import AppliedForce, Axis, AxisOfRotation, LengthMark, PointMark
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import PLANE, SPACE
from derive.figures.parts import BarMark, ConnectionMark, ParticleMark, RopeMark, SpringMark
from derive.figures.pieces import Bullet, Stroke
from derive.figures.surroundings import FieldMark, GravityMark, WayMark
from derive.mechanics import (
    Particle,
    System,
    Z,
    central,
    charge,
    coordinate,
    force,
    massless_rod,
    point,
    space,
    spring,
    string,
    weight,
    wire,
)
from derive.page.depiction import alternative
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.drawing.canvas import sheet_of
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.record import recorded
from tests.courses import ROOT, library_drawings
from tests.figures.machines import SKETCHES, SYSTEMS, G, a, at, g, k, labels, m, m1, m2, of, omega, seen
from tests.figures.scenery import strokes
from tests.figures.test_connected import drawings


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_particle_is_drawn_with_its_mass(name: str) -> None:
    shown = {
        str(mark.label) for mark in SKETCHES[name].marks if type(mark).__name__ not in {"SpringMark", "GravityMark"}
    }
    assert {str(particle.mass) for particle in SYSTEMS[name].particles} <= shown


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_sketch_is_in_its_room_told_in_words_and_kept(name: str) -> None:
    found = SKETCHES[name]
    assert found.view == (SPACE if name in {"hoop", "spherical", "bowl"} else PLANE)
    lines = [spot for piece in seen(found) if isinstance(piece, Stroke) for spot in piece.spots]
    assert max(x for x, _ in lines) - min(x for x, _ in lines) < 5.01 * 72 / 2.54
    assert list(drawings_from_data(json.loads(json.dumps(drawings_to_data([found]))))) == [found]
    told = inline_text(alternative(None, found, None, phrases(templates_of(ROOT))), Notation())  # type: ignore[arg-type]
    assert told.endswith(".")


@pytest.mark.parametrize("name", ["double", "coupled", "planet"])
def test_a_sketch_can_be_written_as_a_sheet(name: str) -> None:
    assert sheet_of(seen(SKETCHES[name]), Notation(), "").width > 50


def test_gravity_is_drawn_where_there_is_weight() -> None:
    assert labels(SKETCHES["pendulum"], GravityMark) == ["g"]
    assert of(SKETCHES["planet"], GravityMark) == []


def test_a_planet_moves_on_an_ellipse_about_what_attracts_it() -> None:
    found = SKETCHES["planet"]
    pieces = seen(found)
    orbit = max(strokes(pieces, "trace"), key=lambda stroke: len(stroke.spots))
    sun = min((piece for piece in pieces if isinstance(piece, Bullet)), key=lambda bullet: bullet.size).spot
    xs = [x for x, _ in orbit.spots]
    other = (min(xs) + max(xs) - sun[0], sun[1])
    sums = [sum(hypot(x - f[0], y - f[1]) for f in (sun, other)) for x, y in orbit.spots]
    assert max(sums) - min(sums) < 1e-6 * max(sums)
    assert next(at(mark.at) for mark in of(found, PointMark)) == [0, 0]
    assert labels(found, ConnectionMark) == ["r"]


def test_a_free_particle_has_axes_named_after_its_coordinates() -> None:
    assert labels(SKETCHES["free"], Axis) == ["x", "y"]


def test_a_bead_with_one_coordinate_is_on_the_curve_of_its_place() -> None:
    assert [mark.pen for mark in of(SKETCHES["parabola"], WayMark)] == ["wire"]
    assert [mark.pen for mark in of(SKETCHES["bowl"], WayMark)] == ["trace", "trace"]
    assert [mark.pen for mark in of(SKETCHES["bent"], WayMark)] == ["wire"]


def test_further_marks_and_numbers_can_be_added() -> None:
    with recorded():
        x = next(iter(SYSTEMS["coupled"].coordinates))
        found = sketch("more", SYSTEMS["coupled"], particle(point(a, a), "P"), values={x: 0})
    assert "P" in labels(found, ParticleMark)
    assert dict(found.values)[x] == 0
    assert len(of(found, SpringMark)) == 3


def test_a_string_through_a_hole_leads_to_what_hangs_below() -> None:
    """Goldstein, Poole, Safko, Classical Mechanics, section 1.6, exercise 21."""
    m, M, l = symbols("m M l", positive=True)
    with recorded():
        r, phi = coordinate("r", "length", positive=True), coordinate("phi")
        puck, hangs = Particle(m, point(r * cos(phi), r * sin(phi), 0)), Particle(M, point(0, 0, r - l))
        line = string(puck, hangs, over=[point(0, 0, 0)])
        found = sketch("table", System(puck, hangs, *line, weight(scalar("g", positive=True))))
    (rope,) = of(found, RopeMark)
    assert [list(place) for place in rope.along][1:] == [[0, 0, 0], [0, 0, r.symbol - l]]
    assert len(of(found, ParticleMark)) == 2


def test_a_particle_at_a_constant_distance_is_on_a_rod_or_a_wire_only_if_the_description_says_so() -> None:
    m, l, omega = symbols("m l omega", positive=True)
    with recorded():
        theta = coordinate("theta")
        axes = space.turned(Z, omega * TIME)
        bob = Particle(m, axes.place(l * sin(theta), 0, -l * cos(theta)))
        bare = sketch("bare", System(bob))
        rod = sketch("rod", System(bob, *massless_rod(point(0, 0, 0), bob)))
        hoop = sketch("hoop", System(bob, wire(bob)))
    assert not of(bare, BarMark) and [mark.pen for mark in of(bare, WayMark)] == ["trace"]
    assert len(of(rod, BarMark)) == 1 and not of(rod, WayMark)
    assert not of(hoop, BarMark) and [mark.pen for mark in of(hoop, WayMark)] == ["wire"]


def test_uniform_fields_are_drawn_beside_a_charge() -> None:
    m, q, E, B = symbols("m q E B", positive=True)
    with recorded():
        at = point(coordinate("x", "length"), coordinate("y", "length"), coordinate("z", "length"))
        found = sketch("ion", System(Particle(m, at), charge(q, at, (0, E, 0), (0, 0, B))))
    assert labels(found, FieldMark) == ["E", "B"]


F, tilt = symbols("F alpha", positive=True)


@pytest.mark.parametrize(
    ("components", "label", "drawn"),
    [
        ((F, 0), F, (1, 0)),
        ((-F, 0), F, (-1, 0)),
        ((-F * cos(omega * TIME), 0), F * cos(omega * TIME), (-1, 0)),
        ((0, F * sin(omega * TIME)), F * sin(omega * TIME), (0, 1)),
        ((F * cos(tilt), F * sin(tilt)), F, (F * cos(tilt), F * sin(tilt))),
    ],
)
def test_a_given_force_is_drawn_in_its_direction_at_the_start(
    components: tuple[Any, ...], label: Any, drawn: tuple[Any, ...]
) -> None:
    with recorded():
        place = point(coordinate("x", "length"), coordinate("y", "length"))
        found = sketch("cart", System(Particle(m, place), force(components, place)))
    (arrow,) = of(found, AppliedForce)
    assert (arrow.label, tuple(arrow.value)) == (label, drawn)


def test_a_force_whose_magnitude_depends_on_a_coordinate_is_not_drawn() -> None:
    """At x > a, the arrow of F (a - x)/a would point to the left with a negative label."""
    with recorded():
        x, y = coordinate("x", "length"), coordinate("y", "length")
        found = sketch("cart", System(Particle(m, point(x, y)), force((F * (a - x) / a, 0), point(x, y))))
    assert of(found, AppliedForce) == []


def test_a_force_whose_magnitude_has_a_root_is_not_drawn() -> None:
    with recorded():
        place = point(coordinate("x", "length"), coordinate("y", "length"))
        found = sketch("cart", System(Particle(m, place), force((F, 2 * F / 3 + m * g), place), weight(g)))
    assert of(found, AppliedForce) == []


def on_a_turning_table() -> Any:
    x, y = coordinate("x", "length"), coordinate("y", "length")
    table = space.turned(Z, omega * TIME)
    at = table.place(x, y, 0)
    return System(Particle(m, at), spring(k, point(0, 0, 0), at))


def test_a_place_by_an_angle_on_a_turning_table_leaves_its_axis() -> None:
    with recorded():
        angle = coordinate("phi")
        table = space.turned(Z, omega * TIME)
        system = System(Particle(m, table.place(a * cos(angle), a * sin(angle), 0)), weight(G))
        found = sketch("system", system)
        assert found is not None
        assert [mark.rate for mark in of(found, AxisOfRotation)] == [omega]


def test_a_table_turns_about_the_vertical_at_its_rate() -> None:
    with recorded():
        found = sketch("system", on_a_turning_table())
        assert found is not None
        assert [mark.rate for mark in of(found, AxisOfRotation)] == [omega]
        assert dict(found.values)[TIME] == 17 * pi / (36 * omega)


def two_stars(*, centre: bool = True) -> Any:
    X, Y, x, y = (coordinate(name, "length") for name in ("X", "Y", "x", "y"))
    one, other = (m2 / (m1 + m2), -m1 / (m1 + m2)) if centre else (1, 0)
    stars = [Particle(mass, point(X + c * x, Y + c * y)) for mass, c in ((m1, one), (m2, other))]
    d = scalar("d", positive=True)
    return System(*stars, central(-G * m1 * m2 / d, d, stars[0].at, stars[1].at))


def test_two_bodies_have_their_centre_of_mass_and_the_way_from_one_to_the_other() -> None:
    """Taylor, Classical Mechanics, section 8.2."""
    with recorded():
        found = sketch("system", two_stars())
        assert found is not None
        assert labels(found, Axis) == ["X", "Y"]
        assert {"X", "Y", "x", "y"} <= set(labels(found, ConnectionMark))


def test_a_dashed_line_is_left_out_with_its_label() -> None:
    drawn = library_drawings("two_bodies")
    assert len(of(drawn["system"], ConnectionMark)) == len(of(drawn["orbits"], ConnectionMark)) + 4


def test_coordinates_of_one_body_are_not_those_of_the_centre_of_mass() -> None:
    with recorded():
        found = sketch("system", two_stars(centre=False))
        assert found is not None
        assert not of(found, PointMark) and "x" not in labels(found, ConnectionMark)


@pytest.mark.parametrize(("first", "labelled"), [("X - m*b*cos(phi)/(m + M)", []), ("X", ["X"])])
def test_a_dimension_line_of_a_coordinate_ends_at_a_place_with_this_coordinate(
    tmp_path: Path, first: str, labelled: list[str]
) -> None:
    """In the first case, X is the position of the centre of mass, where nothing is drawn."""
    text = f"""\
title: A dumbbell
solve: system
symbols: {{m: mass, M: mass, b: length}}
given:
  coordinates: {{X: length, phi: angle}}
  particles:
    one: {{mass: M, at: [{first}, 0]}}
    two: {{mass: m, at: [{first} + b*cos(phi), b*sin(phi)]}}
  massless_rods: {{from: one, to: two}}
statement: A dumbbell.
parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
"""
    assert labels(drawings(tmp_path, text)["system"], LengthMark) == labelled
