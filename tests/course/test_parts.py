"""The parts of a problem: their points, their answers, and in what form a number is given."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from derive.course.parts import points_in_all, points_text
from derive.course.problem import load_problem
from derive.errors import Faults, Rejected
from tests.course.problem_file import at, edited, faults, loaded


def test_a_form_is_for_all_answers_of_a_part_or_for_one(tmp_path: Path) -> None:
    _, angle, torque = loaded(tmp_path).parts
    assert (angle.form_of("angle_between").units, angle.form_of("angle_between").figures) == (("degree",), 4)
    assert (torque.form_of("torque").units, torque.form_of("magnitude").units) == ((), ("N m",))


@pytest.mark.parametrize(
    ("total", "parts", "points"),
    [("points: 10\n", "points: 3", 10), ("", "points: 2.5", Fraction(5, 2)), ("", "points: 0", 0)],
)
def test_points_are_stated_or_summed(total: str, parts: str, points: Fraction, tmp_path: Path) -> None:
    assert loaded(tmp_path, ("points: 10\n", total), ("points: 3", parts)).points == points


@pytest.mark.parametrize("points", ["points: 11", "points: 3.3", "points: -1", "points: 1e1", "points: [1]", "points:"])
def test_points_that_do_not_add_up_or_are_none_are_refused(points: str, tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, edited(("points: 3", points)))
    assert fault in ("3 points", "19 wrong-type", "19 missing-value")


def test_points_of_all_parts_must_reach_the_total(tmp_path: Path) -> None:
    every = edited(("answer: angle", "points: 3\n    answer: angle"), ("answer: [", "points: 3\n    answer: ["))
    assert faults(tmp_path, every) == ["3 points"]
    exact = every.replace("points: 10", "points: 9")
    assert load_problem(at(tmp_path, exact), "hw9/block").points == 9


def test_an_answer_of_another_name_has_no_form_of_its_own(tmp_path: Path) -> None:
    _, angle, torque = loaded(tmp_path).parts
    assert angle.form_of("anything").units == ("degree",), "one form is for all answers"
    assert (torque.form_of("anything").units, torque.form_of("anything").figures) == ((), None)


def test_a_form_for_what_the_part_does_not_ask_is_told_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        loaded(tmp_path, ("{magnitude: {unit: N m}}", "{magnitud: {unit: N m}, torque: {unit: [N m, furlong]}}"))
    mistyped, unheard_of = caught.value.complaints
    assert (mistyped.code, mistyped.help) == ("unknown-key", "did you mean `magnitude`?")
    assert (unheard_of.code, unheard_of.place and unheard_of.place.width) == ("unknown-unit", len("furlong"))


@pytest.mark.parametrize(("points", "text"), [(Fraction(3), "3"), (Fraction(5, 2), "2.5"), (Fraction(0), "0")])
def test_points_are_told_as_they_are_written(points: Fraction, text: str) -> None:
    assert points_text(points) == text


def test_points_of_some_parts_may_be_less_than_the_total_and_not_more() -> None:
    faults = Faults()
    some: list[Any] = [SimpleNamespace(points=points, extra=False) for points in (Fraction(4), None)]
    assert points_in_all(Fraction(10), None, some, faults) == 10
    assert points_in_all(None, None, some, faults) == 4
    assert points_in_all(None, None, some[1:], faults) is None
    faults.stop()
    points_in_all(Fraction(3), None, some, faults)
    with pytest.raises(Rejected, match="the points of the parts already add up to 4"):
        faults.stop()


def test_what_is_asked_beyond_the_homework_carries_no_points(tmp_path: Path) -> None:
    more = edited(
        ("    form: {unit: degree, figures: 4}", "    extra: true"), ("answer: [", "points: 7\n    answer: [")
    )
    problem = load_problem(at(tmp_path, more), "hw9/block")
    assert [part.extra for part in problem.parts] == [False, True, False]
    assert problem.points == 10, "the points of the other parts are all there are"
    assert faults(tmp_path, more.replace("points: 7", "points: 6")) == ["3 points"]


@pytest.mark.parametrize(
    ("instead", "told"), [("extra: true\n    points: 2", "23 points"), ("extra: often", "22 wrong-type")]
)
def test_an_extra_part_with_points_is_refused_at_the_points(instead: str, told: str, tmp_path: Path) -> None:
    assert faults(tmp_path, edited(("form: {unit: degree, figures: 4}", instead))) == [told]


@pytest.mark.parametrize(
    ("instead", "told"), [("detail: full", "25 detail"), ("extra: true\n    detail: most", "26 wrong-type")]
)
def test_only_what_is_asked_beyond_the_homework_waits_for_a_page_of_more_detail(
    instead: str, told: str, tmp_path: Path
) -> None:
    waiting = edited(("form: {magnitude: {unit: N m}}", "extra: true\n    detail: full"))
    assert [part.detail for part in load_problem(at(tmp_path, waiting), "hw9/block").parts] == [
        "brief",
        "brief",
        "full",
    ]
    assert faults(tmp_path, edited(("form: {magnitude: {unit: N m}}", instead))) == [told]


def test_a_part_that_every_page_shows_does_not_stand_behind_one_that_waits(tmp_path: Path) -> None:
    waiting = edited(("form: {unit: degree, figures: 4}", "extra: true\n    detail: full"))
    assert faults(tmp_path, waiting) == ["23 detail"]
