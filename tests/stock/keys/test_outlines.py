"""Which described bodies are drawn."""

from __future__ import annotations

from pathlib import Path

from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.figures.annotations import AngleMark, Arrow, Axis, Line
from derive.figures.marks import Drawing
from derive.figures.surfaces import EllipsoidMark
from derive.figures.surroundings import FixedEnd
from derive.steps.record import Run
from tests.figures.machines import of
from tests.stock.bodies import CONE, CONE_IS
from tests.stock.described import course_with, edited, loaded


def test_a_body_with_an_outline_is_drawn_and_another_is_not(tmp_path: Path) -> None:
    assert "[figure:" in rendered(course_with(tmp_path, CONE), "trial/one", only={"text"}).texts["text"]
    half = "{shape: half_cylinder, radius: R, height: h, mass: M}"
    text = edited(CONE, (CONE_IS, half), ("  about: apex\n", ""))
    assert "[figure:" not in rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]


def test_a_hole_is_drawn_smaller_than_what_it_is_in_where_no_number_says_how_large(tmp_path: Path) -> None:
    shell = "{shape: thick_shell, inner: h, outer: R, mass: M}"
    run = Run()
    run_solve(loaded(tmp_path, edited(CONE, (CONE_IS, shell), ("  about: apex\n", ""))), run)
    (drawn,) = run.drawings
    assert isinstance(drawn, Drawing)
    assert [(str(small), str(large)) for small, large in drawn.values] == [("h", "3*R/5")]


LEANING = """\
title: A rod on a shaft
solve: rotation
symbols: {l: length, M: mass, alpha: "angle in (0, pi/2)", omega: angular speed}
given:
  body: {shape: rod, length: l, mass: M}
  rate: omega
  along: [sin(alpha), 0, cos(alpha)]
statement: A rod is fixed to a shaft.
parts:
  - ask: What is its energy?
    answer: kinetic_energy
"""


def arcs(folder: Path, text: str) -> list[str]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return [str(mark.label) for drawn in run.drawings if isinstance(drawn, Drawing) for mark in of(drawn, AngleMark)]


def test_the_angle_of_an_axis_of_rotation_is_drawn_where_it_is_a_letter(tmp_path: Path) -> None:
    assert arcs(tmp_path, LEANING) == ["alpha"]
    for along in ("[1, 0, 1]", "[2*sin(alpha), 0, cos(alpha)]", "x"):
        assert arcs(tmp_path, edited(LEANING, ("[sin(alpha), 0, cos(alpha)]", along))) == []


THROWN = edited(
    LEANING,
    ("  body: {shape: rod, length: l, mass: M}\n", "  body: {shape: disc, radius: l, mass: M}\n"),
    ("  rate: omega\n  along: [sin(alpha), 0, cos(alpha)]\n", "  start: [omega*sin(alpha), 0, omega*cos(alpha)]\n"),
)


def test_a_body_that_turns_freely_has_its_angular_velocity_at_one_moment(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, THROWN), run)
    (drawn,) = run.drawings
    assert isinstance(drawn, Drawing)
    assert [str(mark.label) for mark in of(drawn, Arrow)] == ["omega"]
    assert [str(mark.label) for mark in of(drawn, AngleMark)] == ["alpha"]


def test_the_axes_of_a_body_begin_where_it_turns(tmp_path: Path) -> None:
    block = ("{shape: rod, length: l, mass: M}", "{shape: cuboid, sides: [l, l, 2*l], mass: M}")
    run = Run()
    run_solve(loaded(tmp_path, edited(LEANING, block, ("[sin(alpha), 0, cos(alpha)]", "z"))), run)
    (drawn,) = run.drawings
    assert isinstance(drawn, Drawing)
    ends = {str(mark.label): str(mark.start.T) for mark in of(drawn, Axis)}
    assert ends == {"x": "Matrix([[l/2, 0, 0]])", "y": "Matrix([[0, l/2, 0]])", "z": "Matrix([[0, 0, l]])"}


MOMENTS = """\
title: A free body
solve: rotation
symbols: {A: moment of inertia, C: moment of inertia}
given:
  moments: [A, A, C]
statement: A body turns.
parts:
  - ask: What are its equations of motion?
    answer: euler_equations
"""


def test_a_body_known_by_its_moments_is_drawn_and_its_momentum_where_it_turns_in_any_way(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, MOMENTS), run)
    (drawn,) = run.drawings
    assert isinstance(drawn, Drawing)
    assert (len(of(drawn, Arrow)), len(of(drawn, EllipsoidMark)), drawn.keys) == (2, 1, ())


CUBE = """\
title: A cube
solve: body
symbols: {a: length, M: mass}
given:
  body: {shape: cuboid, sides: [a, a, a], mass: M}
  direction: [1, 1, 1]
statement: A uniform cube has mass <<M>> and edges of length <<a>>.
parts: [{ask: Find its moment of inertia about a diagonal., answer: moment_about}]
"""


def drawing_of(folder: Path, name: str) -> Drawing:
    (path,) = (Path(__file__).parents[3] / "problems/library").glob(f"*/{name}.yaml")
    return drawn(folder, path.read_text(encoding="utf-8"))


def drawn(folder: Path, text: str) -> Drawing:
    run = Run()
    run_solve(loaded(folder, text), run)
    found = run.drawings[0]  # a problem may add further drawings
    assert isinstance(found, Drawing)
    return found


def test_the_axes_of_a_cube_begin_at_its_centre_unless_the_centre_is_asked_for(tmp_path: Path) -> None:
    assert len([mark for mark in of(drawn(tmp_path, CUBE), Line) if mark.pen == "hidden"]) == 3
    asks = drawn(tmp_path, edited(CUBE, ("answer: moment_about", "answer: [centre_of_mass, moment_about]")))
    assert not [mark for mark in of(asks, Line) if mark.pen == "hidden"]


def test_a_named_point_of_reference_is_drawn_as_a_joint(tmp_path: Path) -> None:
    (joint,) = of(drawing_of(tmp_path, "clock_pendulum"), FixedEnd)
    assert joint.joint and list(joint.at) == [0, 0, 0] and not any(joint.away)
