"""Polhodes: curves on a sphere on which the kinetic energy of a free body is constant."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, Symbol

from derive.building.cache import Cache
from derive.building.drawings import numbers_of
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Drawing
from derive.figures.pieces import Stroke
from derive.figures.polhodes import example_values, loops, motion_at, order_of, polhode_marks, separatrix
from derive.figures.space import dot, size_of
from derive.render.drawing.camera import FROM_A_CORNER, Numbers
from derive.render.drawing.hidden_lines import OnPaper
from derive.steps.record import Run
from tests.stock.described import course_with, edited, loaded

MOMENTS = (13.0, 10.0, 5.0)
ORDER = (2, 1, 0)


def energy(place: tuple[float, float, float], moments: tuple[float, ...] = MOMENTS) -> float:
    return sum(part**2 / moment for part, moment in zip(place, moments, strict=True))


@pytest.mark.parametrize("moments", [MOMENTS, (2.0, 3.0, 4.0), (3.0, 2.0, 4.0), (5.0, 1.0, 5.5)])
def test_all_points_of_a_curve_are_on_the_sphere_and_on_one_ellipsoid(moments: tuple[float, float, float]) -> None:
    order = order_of(moments)
    assert order is not None
    least, middle, greatest = order
    for axis in (least, greatest):
        for curve in loops(moments, axis, middle):
            assert all(size_of(place) == pytest.approx(1) for place in curve)
            assert [energy(place, moments) for place in curve] == pytest.approx(
                [energy(curve[0], moments)] * len(curve)
            )
            assert min(place[axis] for place in curve) > 0, "the curve surrounds one end of the axis"
    for curve in separatrix(moments, order):
        assert all(size_of(place) == pytest.approx(1) for place in curve)
        assert [energy(place, moments) for place in curve] == pytest.approx([1 / moments[middle]] * len(curve))
        assert (curve[0][middle], curve[-1][middle]) == pytest.approx((1, -1))


def test_the_tip_moves_along_the_curves() -> None:
    for curve in (*loops(MOMENTS, 0, 1), *loops(MOMENTS, 2, 1)):
        for i in range(1, len(curve) - 1):
            along = tuple(after - before for before, after in zip(curve[i - 1], curve[i + 1], strict=True))
            motion = motion_at(MOMENTS, curve[i])
            cosine = dot(along, motion) / size_of(along) / size_of(motion)  # type: ignore[arg-type]
            assert abs(cosine) == pytest.approx(1, abs=1e-3)


def test_near_the_axis_of_the_greatest_moment_the_tip_moves_counterclockwise() -> None:
    """This is so as seen from outside, with y to the right and z up. Around the axis of the least moment the sense is
    opposite."""
    assert motion_at(MOMENTS, (1.0, 0.0, 0.1))[1] < 0 < motion_at(MOMENTS, (1.0, 0.1, 0.0))[2]
    assert motion_at((2.0, 3.0, 4.0), (1.0, 0.0, 0.1))[1] > 0


def test_two_equal_moments_have_no_separatrix() -> None:
    assert order_of((1.0, 1.0, 2.0)) is None
    assert order_of((2.0, 1.0, 2.0)) is None
    assert order_of((2.0, 1.0, 3.0)) == (1, 0, 2)


def test_letters_on_which_the_ratios_depend_have_numbers() -> None:
    a, M, A, B = (Symbol(name, positive=True) for name in ("a", "M", "A", "B"))
    assert example_values([13 * M * a**2, 10 * M * a**2, 5 * M * a**2]) == {}
    assert example_values([B, A, 2 * A]) == {B: 2, A: 3}


def test_only_the_front_has_curves_except_the_separatrix() -> None:
    (sphere, *axes) = polhode_marks([Rational(13), Rational(10), Rational(5)], ["a_step"])
    assert (len(axes), sphere.keys) == (3, ("a_step",))
    pieces = sphere.pieces(OnPaper(Numbers({}), FROM_A_CORNER[1]))
    pens = [piece.pen for piece in pieces if isinstance(piece, Stroke)]
    assert {"level", "separatrix", "hidden", "edge"} == set(pens)
    assert any(piece.head for piece in pieces if isinstance(piece, Stroke) and piece.pen == "level")


FREE = """\
title: A body that rotates freely
solve: rotation
symbols: {I_x: moment of inertia, I_y: moment of inertia, I_z: moment of inertia}
given:
  moments: [I_x, I_y, I_z]
statement: A body with the principal moments <<moments>> rotates freely.
parts:
  - {ask: Show that two quantities are conserved., answer: [energy_rate, squared_momentum_rate]}
drawings:
  polhodes: {width: 5 cm}
"""


def page_of(tmp_path: Path, text: str) -> str:
    return " ".join(rendered(course_with(tmp_path, text), "trial/one", only=("html",)).html.split())


def test_polhodes_are_drawn_if_the_problem_names_them(tmp_path: Path) -> None:
    run = Run()
    run_solve(loaded(tmp_path, FREE), run)
    drawing = next(each for each in run.drawings if each.key == "polhodes")
    assert isinstance(drawing, Drawing)
    assert drawing.keys == ("kinetic_energy_rate", "squared_momentum_rate")
    assert drawings_from_data(drawings_to_data([drawing])) == (drawing,)
    without = Run()
    run_solve(loaded(tmp_path, FREE.replace("drawings:\n  polhodes: {width: 5 cm}\n", "")), without)
    assert "polhodes" not in [each.key for each in without.drawings]


def test_a_drawing_that_is_named_after_a_build_is_made(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    plain = FREE.replace("drawings:\n  polhodes: {width: 5 cm}\n", "")
    assert (
        "polhodes" not in rendered(course_with(tmp_path, plain), "trial/one", None, cache, only={"json"}).texts["json"]
    )
    second = rendered(course_with(tmp_path, FREE), "trial/one", None, cache, only={"json"})
    assert '"key": "polhodes"' in second.texts["json"]


def test_the_caption_names_the_axes(tmp_path: Path) -> None:
    text = " ".join(rendered(course_with(tmp_path, FREE), "trial/one", only=("text",)).texts["text"].split())
    assert "loops around the axes of the greatest (z) and of the least moment (x)" in text
    assert (
        "the thick separatrix through the intermediate axis (y), dashed where it is hidden. "
        "The moments about x, y and z are" in text
    )


def test_the_caption_has_the_ratio_and_says_that_it_is_an_example(tmp_path: Path) -> None:
    page = page_of(tmp_path, FREE)
    assert "are in the ratio 2 : 3 : 4, as an example." in page
    assert "Around the z axis, with the greatest moment of inertia, and around the x axis, with the least" in page
    page = page_of(tmp_path, edited(FREE, ("{width: 5 cm}", "{values: {I_y: 5*I_x, I_z: 4.5*I_x}}")))
    assert "are in the ratio 2 : 10 : 9, as an example." in page
    assert "Around the y axis, with the greatest moment" in page
    numbers = "[2 kg m^2, 3 kg m^2, 4.5 kg m^2]"
    assert "are in the ratio 4 : 6 : 9." in page_of(tmp_path, edited(FREE, ("[I_x, I_y, I_z]", numbers)))


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ([("  moments: [I_x, I_y, I_z]\n", "  moments: [I_x, I_y, I_z]\n  torque: [0, 0, 2 N m]\n")], "rotates freely"),
        ([("symbols: {", "symbols: {M: moment of inertia, "), ("{width: 5 cm}", "{values: {I_y: 2*M}}")],
         "the drawing `polhodes` needs a number for `M`"),
        ([("{width: 5 cm}", "{at: statement}")], "would show `kinetic_energy_rate` before it is derived"),
    ],
)  # fmt: skip
def test_a_mistake_is_reported(tmp_path: Path, edits: list[tuple[str, str]], said: str) -> None:
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, edited(FREE, *edits)), "trial/one", only=("text",))
    assert any(said in each.message for each in refused.value.complaints), refused.value


def test_the_values_of_the_drawing_are_used(tmp_path: Path) -> None:
    text = edited(FREE, ("{width: 5 cm}", "{values: {I_y: 5*I_x, I_z: 4.5*I_x}}"))
    assert not rendered(course_with(tmp_path, text), "trial/one", only=("text",)).warnings
    run = Run()
    problem = loaded(tmp_path, text)
    run_solve(problem, run)
    drawing = next(each for each in run.drawings if each.key == "polhodes")
    found = {letter.name: number for letter, number in numbers_of(problem, problem.drawings[0], drawing).items()}
    assert found["I_y"] / found["I_x"] == 5, "the curves have the ratio of the caption"
    assert found["I_z"] / found["I_x"] == 4.5


def test_a_symmetric_body_has_no_polhodes_and_a_warning(tmp_path: Path) -> None:
    text = edited(FREE, ("[I_x, I_y, I_z]", "[I_x, I_x, I_z]"))
    found = rendered(course_with(tmp_path, text), "trial/one", only=("text",))
    assert "separatrix" not in found.texts["text"]
    assert any(
        "two moments of inertia are equal, so `polhodes` is not drawn" in each.message for each in found.warnings
    )
