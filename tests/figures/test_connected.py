"""Drawings of described contacts, strings and joints, and diagrams of the forces on one body."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from derive.course.problem import run_solve
from derive.figures.annotations import Arrow
from derive.figures.marks import Drawing, Mark
from derive.figures.parts import BarMark, BlockMark, ParticleMark, RopeMark, WedgeMark, WheelMark
from derive.figures.space import numeric
from derive.figures.surfaces import Circle
from derive.figures.surroundings import AngleBetween, CurvedGround, FixedEnd, GroundMark, WayMark
from derive.steps.record import Run
from tests.stock.described import edited, loaded

BALL = """\
title: A ball that rolls down an incline
solve: system
symbols: {M: mass, a: length, g: acceleration, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length, phi: angle}
  bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}
  gravity: g
  surfaces: {incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: ball, on: incline, normal: N, friction: {rolling: F}}
statement: A ball rolls down an incline.
parts:
  - ask: Find the forces.
    answer: [N, F]
"""
PENDULUM = """\
title: A pendulum on a string
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {r: positive length, theta: angle}
  particles: {bob: {mass: m, at: [r*sin(theta), -r*cos(theta)]}}
  gravity: g
  strings: {from: [0, 0], to: bob, length: l, tension: T}
statement: A bob.
parts:
  - ask: Find the tension.
    answer: T
"""


def drawings(folder: Path, text: str) -> dict[str, Drawing]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return {each.key: each for each in run.drawings if isinstance(each, Drawing)}


def of_class(drawing: Drawing, sort: type[Mark]) -> list[Any]:
    return [mark for mark in drawing.marks if isinstance(mark, sort)]


def test_a_body_is_drawn_where_it_touches_its_surface(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, BALL)["system"]
    (ground,), (wheel,) = of_class(drawn, GroundMark), of_class(drawn, WheelMark)
    values = dict(drawn.values)
    (x, y), (u, v) = ([numeric(c.subs(values)) for c in place] for place in (ground.start, ground.end))
    a, b = (numeric(c.subs(values)) for c in wheel.centre)
    distance = abs((u - x) * (b - y) - (v - y) * (a - x)) / ((u - x) ** 2 + (v - y) ** 2) ** 0.5
    assert distance == pytest.approx(numeric(wheel.radius))
    assert b > y + (v - y) * (a - x) / (u - x)
    assert {mark.label.name for mark in of_class(drawn, AngleBetween)} == {"alpha", "phi"}


def test_a_force_diagram_shows_friction_uphill_and_the_weight(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, BALL)["forces_ball"]
    weight, normal, friction = of_class(drawn, Arrow)
    values = dict(drawn.values)
    assert [numeric(c.subs(values)) for c in weight.value] == [0, -1]
    assert all(numeric(c.subs(values)) > 0 for c in normal.value)
    uphill = [numeric(c.subs(values)) for c in friction.value]
    assert uphill[0] < 0 < uphill[1]
    assert str(friction.label) == "-F" and friction.keys == ("F",)


def test_a_force_diagram_appears_only_where_its_forces_are_derived(tmp_path: Path) -> None:
    assert "forces_ball" not in drawings(tmp_path, edited(BALL, ("[N, F]", "equations_of_motion")))


def test_a_string_is_a_string_whatever_the_letter_of_its_tension(tmp_path: Path) -> None:
    for letter in ("T", "N"):
        text = edited(PENDULUM, ("tension: T", f"tension: {letter}"), ("answer: T", f"answer: {letter}"))
        drawn = drawings(tmp_path, text)
        assert len(of_class(drawn["system"], RopeMark)) == 1
        assert len(of_class(drawn["system"], FixedEnd)) == 1
        (tension, weight) = reversed(of_class(drawn["forces_bob"], Arrow))
        assert str(tension.label) == letter and str(weight.label) == "g*m"


def test_a_rod_is_a_rod(tmp_path: Path) -> None:
    text = edited(PENDULUM, ("strings:", "massless_rods:"), ("tension: T", "force: T"))
    assert len(of_class(drawings(tmp_path, text)["system"], BarMark)) == 1


def test_what_carries_a_slope_is_a_wedge_and_what_slides_on_it_a_block(tmp_path: Path) -> None:
    text = edited(
        BALL,
        ("phi: angle}", "X: length}"),
        ("bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}",
         "particles: {wedge: {mass: a*M/a, at: [X, 0]}, ball: {mass: M, at: [x, y]}}"),
        ("through: [0, 0], along: [cos(alpha), -sin(alpha)]",
         "through: wedge, along: [cos(alpha), -sin(alpha)], of: wedge"),
        ("{rolling: F}", "none"),
        ("[N, F]", "N"),
    )  # fmt: skip
    drawn = drawings(tmp_path, text)
    assert len(of_class(drawn["system"], WedgeMark)) == len(of_class(drawn["system"], BlockMark)) == 1
    assert "forces_ball" in drawn
    assert "forces_wedge" not in drawn  # the table pushes the wedge by an unknown force


def test_a_bowl_is_a_circle(tmp_path: Path) -> None:
    text = edited(
        BALL, ("{through: [0, 0], along: [cos(alpha), -sin(alpha)]}", "{centre: [0, 0], radius: 6*a, side: inside}")
    )
    drawn = drawings(tmp_path, text)["system"]
    (circle,), (wheel,) = of_class(drawn, Circle), of_class(drawn, WheelMark)
    values = dict(drawn.values)
    far = sum(numeric(c.subs(values)) ** 2 for c in wheel.centre) ** 0.5
    assert far == pytest.approx(numeric((circle.radius - wheel.radius).subs(values)))
    assert not of_class(drawn, ParticleMark)


DRUM = """\
title: A disc in a drum
solve: system
symbols: {m: mass, M: mass, a: length, R: length, g: acceleration}
given:
  coordinates: {x: length, y: length, phi: angle, psi: angle}
  bodies:
    drum: {shape: hoop, radius: R, mass: M, centre: [0, 0], turned: psi, across: z}
    disc: {shape: disc, radius: a, mass: m, centre: [x, y], turned: phi, across: z}
  gravity: g
  surfaces: {inside: {centre: [0, 0], radius: R, side: inside, of: drum}}
  contacts: {of: disc, on: inside, normal: N, friction: {rolling: F}}
statement: A disc in a drum.
parts:
  - ask: Find the forces.
    answer: [N, F]
"""


def test_a_force_whose_direction_is_not_decided_has_no_diagram(tmp_path: Path) -> None:
    """Whether the disc is below the axis depends on the sign of R - a."""
    assert "forces_disc" not in drawings(tmp_path, DRUM)
    assert "forces_disc" in drawings(tmp_path, edited(DRUM, ("  gravity: g", "  assume: a < R\n  gravity: g")))


CURVE = """\
title: A particle on a curve
solve: system
symbols: {m: mass, b: length, g: acceleration}
given:
  coordinates: {x: length, y: length}
  particles: {particle: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {hill: {y: -x**2/(2*b)}}
  contacts: {of: particle, on: hill, normal: N}
statement: A particle.
parts:
  - ask: Find the force.
    answer: N
"""


@pytest.mark.parametrize(("side", "solid"), [("", -1), (", side: below", 1)])
def test_a_curve_is_hatched_on_its_solid_side(side: str, solid: int, tmp_path: Path) -> None:
    drawing = drawings(tmp_path, edited(CURVE, ("(2*b)}", f"(2*b){side}}}")))["system"]
    (mark,) = of_class(drawing, CurvedGround)
    assert list(mark.solid) == [0, solid]


def test_a_wire_has_no_hatches(tmp_path: Path) -> None:
    drawing = drawings(tmp_path, edited(CURVE, ("(2*b)}", "(2*b), side: both}")))["system"]
    assert not of_class(drawing, CurvedGround)
    assert [mark.pen for mark in of_class(drawing, WayMark)] == ["wire"]


def test_a_particle_whose_place_on_a_curve_is_unknown_is_not_drawn(tmp_path: Path) -> None:
    polar = ("{x: length, y: length}", "{r: positive length, theta: angle}"), ("[x, y]", "[r*cos(theta), r*sin(theta)]")
    assert not drawings(tmp_path, edited(CURVE, *polar))
