"""Drawings of described contacts, strings and joints, and diagrams of the forces on one body."""

from __future__ import annotations

from math import cos, sin
from pathlib import Path
from typing import Any

import pytest
import sympy
from sympy import symbols as symbols_of

from derive.building.drawings import numbers_of
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.figures.annotations import AppliedForce, Arrow, LengthMark, Line, PointMark
from derive.figures.marks import Drawing, Mark
from derive.figures.parts import (
    BarMark,
    BlockMark,
    DashpotMark,
    HeavyRopeMark,
    ParticleMark,
    RopeMark,
    WedgeMark,
    WheelMark,
)  # fmt: skip
from derive.figures.pieces import Stroke
from derive.figures.space import numeric
from derive.figures.surfaces import Circle, Revolved, TableMark
from derive.figures.surroundings import (
    AngleBetween,
    CurvedGround,
    DistanceMark,
    FixedEnd,
    FloorMark,
    GroundMark,
    MovingEnd,
    WayMark,
)
from derive.render.drawing.camera import FLAT, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from derive.steps.record import Run
from tests.courses import library_drawings
from tests.mechanics.test_connections import ON_ITS_SIDE, ROPE
from tests.stock.described import course_with, edited, loaded
from tests.stock.test_fixed_coordinates import STEP

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


def test_a_wedge_whose_top_is_described_at_the_floor_is_drawn_above_the_floor(tmp_path: Path) -> None:
    text = edited(
        BALL,
        ("phi: angle}", "X: length}"),
        ("bodies: {ball: {shape: ball, radius: a, mass: M, centre: [x, y], turned: -phi}}",
         "particles: {wedge: {mass: a*M/a, at: [X, 0]}, "
         "ball: {mass: M, at: [X + x*cos(alpha) + y*sin(alpha), -x*sin(alpha) + y*cos(alpha)]}}"),
        ("{incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}",
         "{incline: {through: wedge, along: [cos(alpha), -sin(alpha)], of: wedge}, "
         "floor: {through: [0, 0], along: [1, 0]}}"),
        ("{of: ball, on: incline, normal: N, friction: {rolling: F}}",
         "[{of: ball, on: incline, normal: N}, {of: wedge, on: floor}]"),
        ("[N, F]", "N"),
    )  # fmt: skip
    drawn = drawings(tmp_path, text)["system"]
    (wedge,) = of_class(drawn, WedgeMark)
    assert len({tuple(corner) for corner in wedge.corners}) == 3


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


FORMULA = """\
title: A bob
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {x: length, y: length}
  particles: {bob: {mass: m, at: [x, y]}}
  gravity: g
  constraints: {condition: x**2 + y**2, equals: l**2, force: Lambda}
statement: A bob <<m>> <<l>> <<g>>.
parts:
  - {ask: Find the multiplier., answer: multipliers}
"""


def test_a_constraint_as_a_formula_is_named_in_the_caption(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, FORMULA)["system"]
    assert len(of_class(drawn, ParticleMark)) == 1
    assert [str(each) for each in drawn.left_out] == ["x**2 + y**2 = l**2"]
    page = rendered(course_with(tmp_path / "page", FORMULA), "trial/one", only={"text"}).texts["text"]
    assert "Figure 1. The figure does not show the constraint x² + y² = l²." in page


def test_a_described_contact_is_not_named_in_the_caption(tmp_path: Path) -> None:
    assert drawings(tmp_path, BALL)["system"].left_out == ()


def test_blocks_with_a_constraint_as_a_formula_are_drawn_where_it_holds(tmp_path: Path) -> None:
    text = edited(
        FORMULA,
        ("{x: length, y: length}", "{x: positive length, y: positive length}"),
        ("bob: {mass: m, at: [x, y]}", "left: {mass: m, at: [-l, -x]}, right: {mass: m, at: [l, -y]}"),
        ("x**2 + y**2, equals: l**2", "x + y, equals: l"),
    )
    values = dict(drawings(tmp_path, text)["system"].values)
    x, y, l = (numeric(letter.subs(values), values) for letter in symbols_of("x y l", positive=True))
    assert x > 0 and y > 0 and x + y == pytest.approx(l)


ON_TABLE = """\
  surfaces: {table: {through: [0, 0], along: [1, 0]}}
  contacts: {of: rope, on: table}
  strings"""


def test_a_rope_is_drawn_in_place_of_the_particle_with_its_mass(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, edited(ROPE, ("  strings", ON_TABLE)))["system"]
    (rope,) = of_class(drawn, HeavyRopeMark)
    assert str(rope.label) == "M" and len(rope.along) == 3
    assert not of_class(drawn, ParticleMark) and not of_class(drawn, BlockMark)
    (length,) = of_class(drawn, LengthMark)
    assert str(length.label) == "x" and [list(length.start), list(length.end)] == [[0, 0], [0, -length.label]]


def test_a_cone_lies_on_a_table_that_is_larger_than_the_circle_of_its_contacts(tmp_path: Path) -> None:
    (table,) = of_class(drawings(tmp_path, ON_ITS_SIDE)["system"], TableMark)
    alpha, h = 0.5, 1.3
    values = {letter: {"alpha": alpha, "h": h}[letter.name] for letter in table.radius.free_symbols}
    assert numeric(table.radius.subs(values)) == pytest.approx(1.2 * h / cos(alpha))


YOYO = """\
title: A yo-yo
solve: system
method: newton
symbols: {M: mass, R: length, g: acceleration}
given:
  coordinates: {y: positive length, phi: angle}
  bodies:
    disc: {shape: disc, radius: R, mass: M, turned: -phi, centre: [R, -y], across: z}
  strings: {from: [0, 0], wound_on: disc, tension: S}
  gravity: g
statement: A disc.
parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
  - ask: Find the tension.
    answer: S
"""
PUSHED = """\
title: A particle that is pushed off a sphere
solve: system
symbols: {m: mass, R: length, g: acceleration, v_0: positive speed}
given:
  coordinates: {r: positive length, theta: angle}
  particles: {particle: {mass: m, at: [r*sin(theta), r*cos(theta)]}}
  gravity: g
  assume: v_0**2 < g*R
  surfaces: {sphere: {centre: [0, 0], radius: R}}
  contacts: {of: particle, on: sphere, normal: N}
  results:
    on_it: {put_in: energy_function, values: {r: R, r_dot: 0}}
    slide: {put_in: motion_theta, values: {r: R, r_dot: 0}}
    speed: {speed: on_it, for: theta, start: 0, start_rate: v_0/R, results: slide}
    force: {put_in: N, results: [speed]}
statement: A particle on a sphere.
parts:
  - ask: Find the normal force.
    answer: force
"""


def test_a_free_body_diagram_is_to_scale_if_the_forces_are_derived(tmp_path: Path) -> None:
    weight, tension = of_class(drawings(tmp_path, YOYO)["forces_disc"], Arrow)
    assert str(tension.label) == "S" and tension.size / weight.size == pytest.approx(1 / 3, abs=0.02)
    unknown = edited(YOYO, ("  - ask: Find the tension.\n    answer: S\n", ""))
    weight, tension = of_class(drawings(tmp_path, unknown)["forces_disc"], Arrow)
    assert tension.size == weight.size


def test_a_normal_force_whose_sign_depends_on_the_speed_is_drawn_as_a_push(tmp_path: Path) -> None:
    """On the sphere N < m g cos(theta)."""
    drawn = drawings(tmp_path, PUSHED)["forces_particle"]
    weight, normal = of_class(drawn, Arrow)
    assert 0 < normal.size / weight.size < cos(numeric(dict(drawn.values)[symbols_of("theta", real=True)]))
    assert [str(mark.label) for mark in of_class(drawn, AngleBetween)] == ["theta"]


def test_a_normal_force_under_the_weight_ends_at_the_contact(tmp_path: Path) -> None:
    level = edited(BALL, ("along: [cos(alpha), -sin(alpha)]", "along: [1, 0]"), ("mass: M,", "mass: M*tan(alpha),"))
    weight, normal = of_class(drawings(tmp_path, level)["forces_ball"], Arrow)
    assert [numeric(c) for c in normal.value] == [0, 1]
    assert str(weight.start[0]) == str(normal.start[0]) and weight.aside == 0 == normal.aside
    assert normal.pushes and not weight.pushes


def test_the_normal_force_of_a_plane_is_drawn_although_no_equation_contains_it(tmp_path: Path) -> None:
    text = edited(
        BALL,
        ("{x: length, y: length, phi: angle}", "{s: length, phi: angle}"),
        ("centre: [x, y]", "centre: [s*cos(alpha) + a*sin(alpha), -s*sin(alpha) + a*cos(alpha)]"),
        ("normal: N, ", ""),
        ("[N, F]", "F"),
    )
    weight, friction, normal = of_class(drawings(tmp_path, text)["forces_ball"], Arrow)
    assert str(normal.label) == "N" and normal.keys == () and friction.keys == ("F",)
    assert normal.size / weight.size == pytest.approx(cos(0.63), abs=0.02)
    assert friction.size / weight.size == pytest.approx(max(2 / 7 * sin(0.63), 0.25), abs=0.02)
    taken = edited(
        text,
        ("radius: a,", "radius: N,"),
        ("a*sin(alpha)", "N*sin(alpha)"),
        ("a*cos(alpha)", "N*cos(alpha)"),
        ("a: length", "N: length"),
    )
    assert str(of_class(drawings(tmp_path, taken)["forces_ball"], Arrow)[-1].label) == "F_n"


def test_in_space_the_forces_are_drawn_before_the_equations_of_motion() -> None:
    drawn = library_drawings("rolling_coin")["forces_coin"]
    weight, *forces = of_class(drawn, Arrow)
    assert [str(each.label) for each in forces] == ["N", "F_x", "F_y"]
    assert {each.size for each in (weight, *forces)} == {1}
    assert "motion_theta" in drawn.leads_to and drawn.keys == ()


def test_a_coin_on_a_table_has_axes_euler_angles_and_its_radius() -> None:
    drawn = library_drawings("rolling_coin")["system"]
    labels = {str(mark.label) for mark in drawn.marks if mark.label is not None}
    assert labels == {"x", "y", "z", "phi", "theta", "psi", "a", "g", "R", "Omega"}
    (table,) = of_class(drawn, TableMark)
    touch = next(mark for mark in of_class(drawn, Line) if str(mark.label) == "a").end
    letters = {letter.name: letter for c in touch for letter in c.free_symbols}
    a, phi, theta = letters["a"], letters["phi"], letters["theta"]
    circle = {
        letters["x"]: 2 * a * sympy.sin(phi),
        letters["y"]: -2 * a * sympy.cos(phi),
        letters["z"]: a * sympy.sin(theta),
    }
    values = dict(drawn.values)
    away, radius = (numeric(e.subs(circle), values) for e in (sum(c**2 for c in touch), table.radius**2))
    assert away < radius


CARTS = """\
title: Two carts with a spring and a dashpot
solve: system
symbols: {m: mass, M: mass, k: spring constant, c: damping constant, d: length}
given:
  coordinates: {x: length, y: length}
  particles: {left: {mass: m, at: [x, 0]}, right: {mass: M, at: [d + y, 0]}}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: [{of: left, on: floor}, {of: right, on: floor}]
  springs: {constant: k, from: left, to: right, length: d}
  dashpots: {constant: c, from: left, to: right}
statement: Two carts.
parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
"""


@pytest.mark.parametrize("ends", ["from: left, to: right", "from: right, to: left"])
def test_a_dashpot_beside_a_spring_is_above_it_and_below_the_dimension_lines(ends: str, tmp_path: Path) -> None:
    text = edited(CARTS, ("{constant: c, from: left, to: right}", f"{{constant: c, {ends}}}"))
    drawn = drawings(tmp_path, text)["system"]
    numbers = Numbers(dict.fromkeys(symbols_of("x y d", real=True), 1.0))
    paper = OnPaper(numbers, FLAT, 60.0)
    (dashpot,), lengths = of_class(drawn, DashpotMark), of_class(drawn, DistanceMark)
    spots = [spot for piece in dashpot.pieces(paper) if isinstance(piece, Stroke) for spot in piece.spots]
    assert min(y for _, y in spots) == 0 and len(lengths) == 2
    assert all(mark.off > max(y for _, y in spots) for mark in lengths)


def test_a_horizontal_displacement_on_a_slope_is_above_the_body(tmp_path: Path) -> None:
    across = next(mark for mark in of_class(drawings(tmp_path, BALL)["system"], LengthMark) if str(mark.label) == "x")
    assert list(across.aside) == [0, 1]


def test_a_step_is_drawn_on_the_floor_in_front_of_a_wheel(tmp_path: Path) -> None:
    """The wheel is to the left of its edge. The numbers of the drawing satisfy h < R."""
    problem, run = loaded(tmp_path, STEP), Run()
    run_solve(problem, run)
    (drawn,) = (each for each in run.drawings if isinstance(each, Drawing) and each.key == "system")
    numbers = Numbers(numbers_of(problem, None, drawn))
    grounds = [tuple(numbers.vector(end)[:2] for end in (mark.start, mark.end)) for mark in of_class(drawn, GroundMark)]
    R, h = (numbers.of(symbols_of(name, positive=True)) for name in ["R", "h"])
    assert h < R and ((0, h), (pytest.approx(0.8 * R), h)) in grounds and ((0, h), (0, 0)) in grounds
    assert any(start[1] == end[1] == 0 for start, end in grounds)


def library(name: str) -> str:
    (path,) = (Path(__file__).parents[2] / "problems/library").glob(f"*/{name}.yaml")
    return path.read_text(encoding="utf-8")


def test_the_forces_on_a_body_at_rest_are_to_scale() -> None:
    weight, normal, friction = of_class(library_drawings("block_on_incline")["forces_block"], Arrow)
    assert normal.size / weight.size == pytest.approx(cos(0.63), abs=0.02)
    assert friction.size / weight.size == pytest.approx(sin(0.63), abs=0.02)


def test_a_top_of_unknown_shape_is_a_cone_with_the_same_centre_of_mass(tmp_path: Path) -> None:
    drawn = library_drawings("heavy_top")["system"]
    (cone,) = of_class(drawn, Revolved)
    (apex, tip), (height, _) = cone.profile
    assert apex == tip == 0 and str(3 * height / 4) == "l"
    unequal = edited(
        library("heavy_top"), ("[A, A, C]", "[A, 2*A, C]"), ("  conserved: {phi: p_phi, psi: p_psi}\n", "")
    )
    assert not of_class(drawings(tmp_path, unequal.split("parts:")[0] + LAGRANGIAN)["system"], Revolved)


LAGRANGIAN = """\
parts:
  - ask: Find the Lagrangian.
    answer: lagrangian
"""


def test_a_rod_on_a_rotating_shaft_hangs_from_the_shaft() -> None:
    drawn = library_drawings("rod_on_shaft")["system"]
    shaft = next(mark for mark in of_class(drawn, BarMark) if type(mark) is BarMark)
    (hinge,) = of_class(drawn, FixedEnd)
    assert hinge.joint and list(hinge.at) == list(shaft.start)
    assert [str(c) for c in shaft.end - shaft.start] == ["0", "0", "3*l/8"]


def test_a_rod_that_stands_on_a_hinge_has_the_hatches_of_the_ground_below_the_hinge() -> None:
    (hinge,) = of_class(library_drawings("hinge_force")["system"], FixedEnd)
    assert [str(c) for c in hinge.held] == ["x", "y"]


def test_the_angle_of_a_pulley_is_positive_and_shows_its_positive_sense() -> None:
    drawn = library_drawings("atwood_disc")["system"]
    (angle,) = of_class(drawn, AngleBetween)
    (value,) = (value for letter, value in drawn.values if letter == angle.label)
    assert numeric(value) > 0
    for number, pointed in ((2.0, (True, False)), (-1.0, (False, True))):
        arc = angle.pieces(OnPaper(Numbers({angle.label: number}), FLAT, 60.0))[1]
        assert isinstance(arc, Stroke) and (arc.head, arc.tail) == pointed


def test_a_particle_that_does_not_rotate_has_no_link_to_one_that_does() -> None:
    """The distance between the puck and the hanging mass does not depend on the angle of the puck."""
    marks = library_drawings("table_with_hole")["system"].marks
    labels = [str(label) for mark in marks if (label := getattr(mark, "label", None)) is not None]
    assert labels.count("phi") == 1 and not [label for label in labels if label.startswith("sqrt")]


SLIPS = """title: A disc that slips
solve: system
symbols: {M: mass, a: length, g: acceleration, mu: positive number, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, y: length, phi: angle}
  places: {C: [x*cos(alpha) + y*sin(alpha), -x*sin(alpha) + y*cos(alpha)]}
  bodies: {disc: {shape: disc, radius: a, mass: M, centre: C, turned: -phi, across: z}}
  surfaces: {incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: disc, on: incline, normal: N, friction: {sliding: mu, direction: [cos(alpha), -sin(alpha)]}}
  gravity: g
statement: A disc.
parts:
  - {ask: Find the equations., answer: equations_of_motion}
"""


def test_the_distance_from_an_incline_is_measured_from_the_incline(tmp_path: Path) -> None:
    marks = {str(mark.label): mark for mark in of_class(drawings(tmp_path, SLIPS)["system"], LengthMark)}
    values = {"x": 2.0, "y": 1.0, "a": 1.0, "alpha": 0.5}

    def height(place: Any) -> float:
        u, v = (float(c.xreplace({s: values[s.name] for s in c.free_symbols})) for c in place)
        return u * sin(0.5) + v * cos(0.5)

    assert height(marks["y"].start) == pytest.approx(0.0) and height(marks["y"].end) == pytest.approx(1.0)


DRIVEN = """\
title: A spring with a driven end
solve: system
symbols: {m: mass, k: spring constant, l: length}
given:
  coordinates: {x: length}
  functions: {X: length}
  places: {A: [l + x, 0]}
  particles: {block: {mass: m, at: A}}
  springs: {from: [X, 0], to: block, constant: k, length: l}
statement: A block on a spring.
parts:
  - ask: Find the equation of motion.
    answer: motion_x
"""
ROD = """\
title: A rod on a moving pivot
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle}
  functions: {Y: length}
  bodies: {rod: {shape: rod, length: l, mass: m, from: [0, Y], along: [sin(theta), -cos(theta)]}}
  gravity: g
statement: A rod.
parts:
  - ask: Find the equation of motion.
    answer: motion_theta
"""


def test_the_driven_ends_of_springs_and_rods_are_drawn_with_their_displacements(tmp_path: Path) -> None:
    for name, text, letter, joint in (("spring", DRIVEN, "X", False), ("rod", ROD, "Y", True)):
        found = drawings(tmp_path / name, text)["system"]
        (end,) = of_class(found, MovingEnd)
        assert end.joint is joint and not of_class(found, FixedEnd)
        assert letter in [str(mark.label) for mark in of_class(found, DistanceMark)]


BESET = """\
title: A pendulum with given forces
solve: system
symbols: {m: mass, F: force, b: damping constant, tau: torque, l: length}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  massless_rods: {from: [0, 0], to: bob}
  forces: [{components: [F, 0], at: bob}, {components: [F*sin(theta), F], at: bob}, {torque: tau, on: theta}]
  damping: {constant: b, at: bob}
statement: A bob on a rod.
parts:
  - {ask: Find the equation of motion., answer: motion_theta}
"""


def test_a_given_force_that_the_figure_does_not_show_is_named_in_the_caption(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, BESET)["system"]
    assert len(of_class(drawn, AppliedForce)) == 1
    assert [sort for sort, _ in drawn.undrawn] == ["force", "torque", "drag"]
    page = rendered(course_with(tmp_path / "page", BESET), "trial/one", only={"text"}).texts["text"]
    caption = (
        "Figure 1. The figure does not show the force (F sin θ, F), the torque τ and the drag with the constant b."
    )
    assert caption in " ".join(page.split())


def test_a_drag_along_a_line_is_an_arrow_against_the_motion_beside_a_driving_force(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("driven_oscillator"))["system"]
    force, drag = of_class(drawn, AppliedForce)
    assert (str(drag.label), list(drag.value), drag.pushes) == ("b*x_dot", [-1, 0], True)
    assert not force.pushes and force.aside == drag.aside > 0  # on opposite sides, because the directions are opposite
    assert drawn.undrawn == ()


def test_the_natural_length_of_a_spring_is_drawn_with_its_extension_or_opposite_to_its_length() -> None:
    cart = library_drawings("damped_oscillator")["system"]
    natural, extension = of_class(cart, DistanceMark)
    assert [str(each.label) for each in (natural, extension)] == ["a", "x"] and natural.end == extension.start
    ball = library_drawings("hanging_mass")["system"]
    natural, whole = of_class(ball, LengthMark)
    assert [str(each.label) for each in (natural, whole)] == ["l", "y"] and natural.aside == -whole.aside


def test_a_spring_on_a_table_is_held_by_a_nail(tmp_path: Path) -> None:
    drawn = drawings(tmp_path, library("turning_plane"))["system"]
    assert not of_class(drawn, FixedEnd) and any(list(mark.at) == [0, 0, 0] for mark in of_class(drawn, PointMark))


@pytest.mark.long
def test_friction_and_dashpots_are_not_named_as_forces_that_are_left_out() -> None:
    for name in ("block_on_plank", "carts_with_dashpot", "driven_arm"):
        assert library_drawings(name)["system"].undrawn == ()


def test_a_view_of_a_plane_drawing_has_no_effect(tmp_path: Path) -> None:
    viewed = edited(BESET, ("statement:", "drawings: {system: {view: top}}\nstatement:"))
    found = rendered(course_with(tmp_path, viewed), "trial/one", only={"text"}).warnings
    assert [each.message for each in found] == ["`view` has no effect on `system`, which is not a drawing in space"]


def test_a_width_of_the_force_diagram_of_a_particle_has_no_effect(tmp_path: Path) -> None:
    wide = edited(PENDULUM, ("statement:", "drawings: {forces_bob: {width: 8 cm}}\nstatement:"))
    found = rendered(course_with(tmp_path, wide), "trial/one", only={"text"}).warnings
    assert "`width` has no effect on `forces_bob`, because a particle has no size" in [each.message for each in found]


@pytest.mark.parametrize(("place", "arrows"), [("[A*t**2/2, 0]", ["A"]), ("[0, b*cos(omega*t)]", ["None", "None"])])
def test_a_plank_with_a_prescribed_motion_is_not_ground(tmp_path: Path, place: str, arrows: list[str]) -> None:
    text = f"""\
title: A block on a moving plank
solve: system
symbols: {{m: mass, A: acceleration, g: acceleration, b: length, omega: angular speed}}
given:
  coordinates: {{x: length, y: length}}
  particles: {{block: {{mass: m, at: [x, y]}}}}
  gravity: g
  surfaces: {{plank: {{through: {place}, along: [1, 0]}}}}
  contacts: {{of: block, on: plank, normal: N}}
statement: A block.
parts:
  - ask: Find the normal force.
    answer: N
"""
    drawn = drawings(tmp_path, text)["system"]
    assert not any(isinstance(mark, GroundMark | FloorMark) for mark in drawn.marks)
    assert [str(mark.label) for mark in of_class(drawn, Arrow)] == arrows
