"""Marks that a problem adds to a drawing, and drawings that are like another one: `marks` and `like`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from derive.building.cache import Cache
from derive.building.derivations import steps_key
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.figures.annotations import AngleMark, Arrow, HollowPoint, Line, Turn
from derive.figures.marks import Drawing
from derive.figures.surroundings import AngleBetween, DistanceMark, WayMark
from derive.steps.record import Run
from tests.stock.described import course_with, edited, loaded

PENDULUM = """\
title: A pendulum with a motor
solve: system
symbols: {m: mass, l: length, C: torque, g: acceleration, theta_0: angle}
given:
  coordinates: {theta: angle}
  places: {pivot: [0, 0], B: [l*sin(theta), -l*cos(theta)]}
  particles: {bob: {mass: m, at: B}}
  massless_rods: {from: pivot, to: bob}
  forces: {torque: C, on: theta}
  gravity: g
statement: A bob of mass <<m>> on a rod of length <<l>> at the angle <<theta>>, with a torque <<C>>.
parts:
  - {ask: Find the equation of motion., answer: motion_theta}
drawings:
  system:
    caption: The pendulum.
    marks:
      - {mark: point, label: S, at: {from: pivot, by: [l*sin(theta)/2, -l*cos(theta)/2]}}
      - {mark: length, label: l/2, from: pivot, to: [0, -l/2], side: left}
      - {mark: dashed, from: pivot, to: [l*sin(theta_0), -l*cos(theta_0)]}
      - {mark: angle, label: theta_0, at: pivot, from: [0, -1], to: [sin(theta_0), -cos(theta_0)], size: 0.4}
      - {mark: angle, label: beta, at: bob, from: pivot, to: {by: [0, 0]}}
      - {mark: turn, label: C, at: pivot}
  moving:
    like: system
    at: a
    values: {theta: 50 deg}
    caption: The velocity.
    marks:
      - {mark: arrow, label: l*theta_dot, at: bob, along: [cos(theta), sin(theta)]}
      - {mark: circle, at: pivot, to: bob}
      - {mark: curve, label: K, at: [l*sin(theta), -l*cos(theta)], against: theta, range: [0, theta_0]}
"""

DISC = """\
title: A disc
solve: rotation
symbols: {M: mass, R: length, omega: angular speed, alpha: 'angle in (0, pi/2)'}
given:
  body: {shape: disc, radius: R, mass: M}
  start: [omega*sin(alpha), 0, omega*cos(alpha)]
statement: A disc of mass <<M>> and radius <<R>> with the angular velocity <<omega>> at the angle <<alpha>>.
parts:
  - {ask: Find the angular momentum., answer: angular_momentum}
drawings:
  vectors:
    like: body
    caption: The vectors.
    marks:
      - {mark: arrow, label: angular_momentum, along: angular_momentum, size: 1.4}
      - {mark: angle, label: alpha_L, from: z, to: angular_momentum}
"""


def drawn(folder: Path, text: str) -> dict[str, Any]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return {each.key: each for each in run.drawings if isinstance(each, Drawing)}


def added(drawing: Drawing, *sorts: Any) -> list[Any]:
    return [mark for mark in drawing.marks if isinstance(mark, sorts)]


def test_marks_are_added_to_the_drawing_of_a_system(tmp_path: Path) -> None:
    shown = drawn(tmp_path, PENDULUM)["system"]
    (point,) = added(shown, HollowPoint)
    assert [str(c) for c in point.at] == ["l*sin(theta)/2", "-l*cos(theta)/2"]
    assert str(point.label) == "S"
    (length,) = added(shown, DistanceMark)
    assert (str(length.label), length.on_paper) == ("l/2", (-1, 0))
    assert [each.pen for each in added(shown, Line)] == ["trace"]
    (turn,) = added(shown, Turn)
    assert str(turn.label) == "C"


def test_the_sides_of_an_angle_are_directions_or_lead_to_places(tmp_path: Path) -> None:
    shown = drawn(tmp_path, PENDULUM)["system"]
    (named,) = added(shown, AngleMark)
    assert tuple(named.a) == (0, -1)
    (between,) = [mark for mark in added(shown, AngleBetween) if str(mark.label) == "beta"]
    assert [str(c) for c in between.a] == ["-l*sin(theta)", "l*cos(theta)"]


def test_a_torque_that_a_mark_shows_is_not_in_the_caption(tmp_path: Path) -> None:
    assert not drawn(tmp_path, PENDULUM)["system"].undrawn
    without = edited(PENDULUM, ("      - {mark: turn, label: C, at: pivot}\n", ""))
    assert drawn(tmp_path, without)["system"].undrawn


def test_a_drawing_may_be_like_another_one(tmp_path: Path) -> None:
    found = drawn(tmp_path, PENDULUM)
    assert [*found] == ["system", "moving"]
    assert set(map(str, found["system"].marks)) <= set(map(str, found["moving"].marks))
    (arrow,) = [mark for mark in added(found["moving"], Arrow) if str(mark.label) == "l*theta_dot"]
    assert [str(c) for c in arrow.value] == ["cos(theta)", "sin(theta)"]
    assert added(found["moving"], WayMark)
    page = rendered(course_with(tmp_path, PENDULUM), "trial/one", cache=Cache(tmp_path / "cache"), draws=True)
    assert {name.rpartition(".")[0] for name, _ in page.files} >= {"one-system", "one-moving"}


def test_drawings_that_are_like_another_one_keep_the_order_of_the_file(tmp_path: Path) -> None:
    later = "  later: {like: system, at: a, values: {theta: 70 deg}, caption: The pendulum later.}\n"
    assert [*drawn(tmp_path, PENDULUM + later)] == ["system", "moving", "later"]


def test_an_arrow_may_show_an_answer(tmp_path: Path) -> None:
    shown = drawn(tmp_path, DISC)["vectors"]
    arrow = added(shown, Arrow)[-1]
    assert arrow.keys == ("angular_momentum",)
    (angle,) = [mark for mark in added(shown, AngleMark) if str(mark.label) == "alpha_L"]
    assert "angular_momentum" in angle.keys


def test_the_steps_are_made_again_if_a_mark_changes(tmp_path: Path) -> None:
    first = steps_key(loaded(tmp_path, PENDULUM))
    assert steps_key(loaded(tmp_path, edited(PENDULUM, ("label: l/2", "label: l")))) != first
    assert steps_key(loaded(tmp_path, "# a remark\n" + PENDULUM)) == first


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("like: system", "like: sistem", "draws nothing called `sistem`"),
        ("{mark: turn, label: C, at: pivot}", "{mark: turn, label: C}", "the mark `turn` needs `at`"),
        ("at: pivot, to: bob}", "at: pivot, to: bob, side: left}", "`side` has no effect on the mark `circle`"),
        ("{mark: turn, label: C, at: pivot}", "{mark: turn, label: C, at: hub}", "`hub` is not a named place"),
        ("along: [cos(theta), sin(theta)]}", "along: speed}", "no step of the solution is called `speed`"),
        ("along: [cos(theta), sin(theta)]}", "along: [cos(theta), l]}", "have different dimensions"),
        ("along: [cos(theta), sin(theta)]}", "along: [cos(theta)]}", "`along` needs 2 components"),
        ("size: 0.4}", "size: -1}", "`size` must be a positive number"),
        ("label: l/2, from", "label: l/3, from", "the distance from `from` to `to` is not l/3"),
    ],
)
def test_wrong_marks_are_rejected(tmp_path: Path, old: str, new: str, message: str) -> None:
    with pytest.raises(DeriveError, match=message):
        drawn(tmp_path, edited(PENDULUM, (old, new)))
