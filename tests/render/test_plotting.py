"""Tests of plots: panels, round ticks, axes with units, and the names of extrema."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, Integer, Rational, Symbol, cos, pi, sin, symbols

from derive.course.given import Measured
from derive.course.placement import Placement
from derive.errors import Place, Rejected
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Across, Further, Levels, Outline, Plot
from derive.figures.pieces import Bullet, Stroke
from derive.page.depiction import _told_of_curves as told_of_curves
from derive.page.plots import Curves, curves_of
from derive.page.template import templates_of
from derive.page.wording import Text, phrases
from derive.render.drawing import canvas, plotting
from derive.render.drawing.canvas import LINE
from derive.render.drawing.curve_names import STUB, on_curve
from derive.render.drawing.lettering import letters_of
from derive.render.drawing.panels import Panel, panel_of
from derive.render.drawing.plotting import (
    AROUND,
    CM,
    PAD,
    PENS_OF_CURVES,
    TALL,
    Frame,
    Names,
    Writing,
    _names,
    _names_of_turns,
    line_of,
    plot_sheet,
)
from derive.render.drawing.sheets import Extent, Shape, Sheet, extent_of, sheet_of_shapes
from derive.render.notation.notation import Notation
from tests.courses import ROOT

theta = Symbol("theta", real=True)
V = Symbol("V")
a = symbols("a", positive=True)


def plot_of(expr: Expr, lower: Expr = -pi / 2, upper: Expr = pi / 2, of: str = "angle") -> Plot:
    return Plot("potential", V, expr, theta, lower, upper, "energy", of)


def curves(plot: Plot, *cases: int, panels: str | None = "apart") -> Curves:
    problem: Any = SimpleNamespace(amounts={}, measured=(), place_of=lambda _: None)
    numbers = tuple((Measured(a, Integer(n), "m", Integer(n)),) for n in cases)
    placement = Placement("potential", Place("one.yaml", 9), cases=numbers, panels=panels)
    return curves_of(problem, plot, placement)


def sheet(plot: Plot, *cases: int, width: float | None = None, alt: str = "", together: str | None = "apart") -> Sheet:
    return plot_sheet(plot, curves(plot, *cases, panels=together), Notation(), width, alt)


def panels(plot: Plot, *cases: int, together: str | None = "apart") -> list[Panel]:
    found = curves(plot, *cases, panels=together)
    height = TALL * CM - AROUND
    return [panel_of(plot, own, found, Notation(), height=height) for own in found.panels]


def test_every_curve_has_a_panel_of_the_same_width() -> None:
    one, two = sheet(plot_of(a * cos(theta)), 1), sheet(plot_of(a * cos(theta)), 1, 2)
    assert (two.width, two.height) == pytest.approx((2 * one.width, one.height))
    assert sheet(plot_of(a * cos(theta)), 1, width=3.75).height == pytest.approx(one.height / 2)


def test_ticks_are_a_few_round_numbers_within_the_range() -> None:
    (angle,), (length,) = panels(plot_of(cos(theta))), panels(plot_of(theta**2, Integer(0), Integer(1) / 25, "length"))
    assert [at for at, _ in angle.across] == [-90, -60, -30, 0, 30, 60, 90]
    assert [text for _, text in length.across] == ["$0.00$", "$0.01$", "$0.02$", "$0.03$", "$0.04$"]


@pytest.mark.parametrize(("size", "power"), [(10**33, 33), (Rational(1, 10**9), -9), (2000, None)])
def test_an_axis_with_very_large_or_small_numbers_has_a_power_of_ten_in_its_name(size: Any, power: int | None) -> None:
    (panel,) = panels(plot_of(size * cos(theta)))
    assert panel.up[0][0] == 0.0 and panel.up[-1][0] == pytest.approx(float(size))
    if power is None:
        assert panel.up[-1][1] == "$2000$" and panel.names[1] == r"$V\,/\,\mathrm{J}$"
    else:
        assert panel.up[-1][1] == "$1.0$" and panel.names[1] == rf"$V\,/\,(10^{{{power}}}\,\mathrm{{J}})$"


def test_axes_are_named_with_their_units() -> None:
    (panel,) = panels(plot_of(cos(theta)))
    assert panel.names == (r"$\theta\,/\,{}^{\circ}$", r"$V\,/\,\mathrm{J}$")


def test_each_extremum_is_named_clear_of_the_curve() -> None:
    (panel,) = panels(plot_of(cos(2 * theta - pi / 18), -3 * pi / 4, 3 * pi / 4))
    assert [(pytest.approx(at), is_lowest, names) for at, is_lowest, names in panel.turns] == [
        ((-85, -1), True, (r"${-}85{}^{\circ}$",)), ((5, 1), False, (r"$5{}^{\circ}$",)),
        ((95, -1), True, (r"$95{}^{\circ}$",)),
    ]  # fmt: skip
    assert panel.values[1] < -1.3 and panel.values[3] > 1.3, "there is room for the names"


def test_an_extremum_at_a_tick_needs_no_name_and_a_symbol_of_the_solution_is_its_name() -> None:
    (panel,) = panels(plot_of(cos(theta)))
    assert [names for _, _, names in panel.turns] == [()]
    (named,) = panels(replace(plot_of(a * cos(2 * theta - a / 9)), places=((Symbol("theta_0"), a / 18),)), 2)
    assert named.turns[1][2] == (r"$\theta_{0} = 6.37{}^{\circ}$", r"$\theta_{0}$")
    (at_tick,) = panels(replace(plot_of(a * cos(theta)), places=((Symbol("theta_0"), a - a),)), 2)
    assert at_tick.turns[0][2] == (r"$\theta_{0}$",)


def test_a_dotted_line_leads_from_an_extremum_to_the_axis() -> None:
    (panel,) = panels(plot_of(cos(theta)))
    frame = Frame((0.0, 0.0, 180.0, 90.0), panel.values)
    ((_, end),) = [each.spots for each in plotting._pieces(panel, frame, ()) if getattr(each, "pen", "") == "hidden"]
    assert end == (pytest.approx(90.0), 0.0)


def test_a_curve_close_to_zero_has_zero_on_its_axis_and_an_axis_has_at_least_three_ticks() -> None:
    (panel,) = panels(plot_of(theta**2 + Rational(1, 10), Integer(0), Integer(1), "length"))
    assert [text for _, text in panel.up] == ["$0.0$", "$0.5$", "$1.0$"]
    (far,) = panels(plot_of(Rational(86, 100) * theta + 2, Integer(0), Integer(1), "length"))
    assert len(far.up) >= 3 and far.up[0][0] > 0


def test_the_numbers_of_a_case_stand_over_its_panel() -> None:
    one, two = panels(plot_of(a * cos(theta)), 1, 2)
    assert (one.numbers, two.numbers) == ((r"$a = 1\,\mathrm{m}$",), (r"$a = 2\,\mathrm{m}$",))
    assert {*one.numbers, *one.names} <= set(one.texts())
    assert panels(plot_of(cos(theta)))[0].numbers == ()


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Shape]:
    found: list[Shape] = []

    def noted(shapes: list[Shape], extent: Extent, alt: str) -> Sheet:
        found[:] = shapes
        return sheet_of_shapes(shapes, extent, alt)

    monkeypatch.setattr(plotting, "sheet_of_shapes", noted)
    return found


def box(shape: Shape) -> Extent:
    return extent_of([spot for _, spots in shape.contour for spot in spots])


def test_all_of_a_plot_is_on_its_sheet_and_no_text_on_another(drawn: list[Shape]) -> None:
    found = sheet(plot_of(a * cos(theta)), 1, 2)
    boxes = [box(shape) for shape in drawn]
    assert min(min(each[:2]) for each in boxes) >= 0
    assert max(each[2] for each in boxes) <= found.width and max(each[3] for each in boxes) <= found.height
    texts = [box(shape) for shape in drawn if shape.fill == LINE]
    assert len(texts) > 20
    for one, other in combinations(texts, 2):
        assert one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]


@pytest.mark.parametrize(("kind", "is_turned"), [("number", False), ("energy", True)])
def test_only_a_long_name_of_the_vertical_axis_is_turned(kind: str, is_turned: bool, drawn: list[Shape]) -> None:
    plot = Plot("potential", V, cos(theta), theta, -pi / 2, pi / 2, kind, "angle")
    plot_sheet(plot, curves(plot), Notation(), None, "")
    (panel,) = [panel_of(plot, own, curves(plot), Notation(), None, 100.0) for own in curves(plot).panels]
    wide, high = Writing(letters_of({panel.names[1]})).size(panel.names[1], 1.0)
    (left, below, right, above), number = sorted(box(shape) for shape in drawn if shape.fill == LINE)[:2]
    assert number[0] - right > 3 * PAD - 1 or is_turned  # `n 2` could be read as a product
    expected = (high, wide) if is_turned else (wide, high)
    assert (right - left, above - below) == pytest.approx(expected, abs=0.01)


def test_a_curve_is_drawn_to_the_scale_of_its_axes(drawn: list[Shape]) -> None:
    sheet(plot_of(cos(theta)))
    frame, curve = (
        next(s for s in drawn if s.width == canvas.PENS[pen].width and not s.fill and not s.dashes)
        for pen in ("frame", "curve")
    )
    left, below, right, above = box(frame)
    start, low, end, high = panels(plot_of(cos(theta)))[0].values
    assert (box(curve)[0], box(curve)[2]) == pytest.approx((left, right)), "it goes from one end to the other"
    assert box(curve)[1] == pytest.approx(below + (0 - low) / (high - low) * (above - below), abs=1e-6)
    assert box(curve)[3] == pytest.approx(below + (1 - low) / (high - low) * (above - below))
    assert (start, end) == (-90, 90)


def test_numbers_that_are_too_long_for_a_panel_are_smaller(drawn: list[Shape]) -> None:
    sheet(plot_of(a * cos(theta)), 123456789012, width=3.0)
    numbers = box(drawn[-1])
    assert 0 < numbers[0] < numbers[2] < 3 * CM


def test_a_plot_is_the_same_bytes_each_time_and_says_what_it_shows() -> None:
    one, other = (sheet(plot_of(cos(theta)), alt="a < b") for _ in range(2))
    assert (one.pdf, one.svg) == (other.pdf, other.svg)
    assert b"<title>a &lt; b</title>" in one.svg


def test_a_curve_that_is_level_has_an_axis_all_the_same() -> None:
    (panel,) = panels(plot_of(theta - theta + 5 * cos(0) + 0 * theta))
    assert panel.values[1] < 5 < panel.values[3]


def test_panels_have_their_letters() -> None:
    found = curves(plot_of(a * cos(theta)), 1, 2)
    one, two = (
        panel_of(plot_of(a * cos(theta)), own, found, Notation(), letter)
        for letter, own in zip("ab", found.panels, strict=True)
    )
    assert one.numbers[0].startswith(r"$({\mathrm{a}})") and two.numbers[0].startswith(r"$({\mathrm{b}})")


def path_of(across: Expr, up: Expr, unit: str = "J", upper: Expr = 2 * pi) -> Plot:
    x, z = Symbol("x"), Symbol("z")
    return Plot("path", z, up, theta, Integer(0), upper, "energy", "angle", across=Across(x, across, unit))


def test_a_path_has_dots_at_its_ends_and_an_arrowhead_in_the_direction_of_the_motion() -> None:
    (panel,) = panels(path_of(theta, theta - theta**2 / 4, upper=Integer(4)))
    pieces = list(line_of(panel, Frame((0, 0, 1, 1), (0, 0, 1, 1))))
    curve, head = (piece for piece in pieces if isinstance(piece, Stroke))
    assert [piece.spot for piece in pieces if isinstance(piece, Bullet)] == [(0, 0), (4, 0)]
    assert (curve.spots, curve.head, head.head) == (panel.traces[0].points, False, True)
    (before, _), (tip, _) = head.spots
    assert 0 < before < tip < 4
    assert panel.turns == (), "extrema are not marked"
    assert panel.names == (r"$x\,/\,\mathrm{J}$", r"$z\,/\,\mathrm{J}$")


@pytest.mark.parametrize("size", [Integer(1), Integer(40), Integer(1) / 40])
def test_both_axes_of_a_path_have_the_same_scale_if_their_units_are_the_same(size: Expr, drawn: list[Shape]) -> None:
    circle = path_of(cos(theta), size * sin(theta))
    (panel,) = panels(circle)
    left, low, right, high = panel.values
    assert panel.shape == pytest.approx((high - low) / (right - left))
    assert 0.25 - 1e-9 <= panel.shape <= 1.4 + 1e-9, "no panel is flatter or steeper"
    assert left < -1 < 1 < right and low < -size < size < high, "all of it is in the panel"
    sheet(circle)
    frame = next(s for s in drawn if s.width == canvas.PENS["frame"].width and not s.fill)
    start, below, end, above = box(frame)
    assert (above - below) / (high - low) == pytest.approx((end - start) / (right - left))


def test_axes_with_different_units_have_scales_of_their_own() -> None:
    (panel,) = panels(path_of(cos(theta), 40 * sin(theta), unit="m"))
    assert panel.shape is None
    assert panel.values == pytest.approx((-1.16, -46.4, 1.16, 46.4), rel=1e-3)


def test_a_line_at_an_energy_has_dots_at_its_turning_points() -> None:
    plot = plot_of(a * theta**2, Integer(-1), Integer(1), "length")
    (bound,), (free,) = (panels(replace(plot, energies=(energy,)), 1) for energy in (a / 4, 2 * a))
    assert [place for place, _ in bound.points] == [pytest.approx((x, 0.25)) for x in (-0.5, 0.5)]
    assert free.heights and not free.points  # this line ends at the ends of the range


def test_panels_of_paths_have_their_own_heights() -> None:
    found = sheet(path_of(cos(theta), a * sin(theta)), 1, 2, alt="two", width=6.0)
    one = sheet(path_of(cos(theta), 2 * sin(theta)), width=6.0)
    assert found.width == pytest.approx(2 * one.width)


def test_a_path_is_stored_with_both_quantities() -> None:
    path = path_of(cos(theta), sin(theta))
    assert drawings_from_data(drawings_to_data([path])) == (path,)


def test_a_phase_portrait_has_a_thick_curve_and_arrowheads() -> None:
    momentum = Symbol("p", real=True)
    levels = Levels(momentum, Integer(-2), Integer(2), ((Integer(1) / 2, False), (Integer(1), True)), "J")
    portrait = Plot(
        "portrait", momentum, (momentum**2 + theta**2) / 2, theta, -pi / 2, pi / 2, "number", "angle", (), "kg m^2/s",
        levels=levels,
    )  # fmt: skip
    (panel,) = panels(portrait)
    assert panel.names == (r"$\theta\,/\,{}^{\circ}$", r"$p\,/\,(\mathrm{kg\,m^{2}/s})$")
    assert panel.values == (-90, -2, 90, 2)
    assert panel.levels == (r"$0.5\,\mathrm{J}$", r"$1\,\mathrm{J}$") and panel.turns == (((0, 0), True, ()),)
    strokes = [each for each in line_of(panel, Frame((0, 0, 1, 1), (0, 0, 1, 1))) if isinstance(each, Stroke)]
    assert [(stroke.pen, stroke.head) for stroke in strokes] == [
        ("level", False), ("level", True), ("separatrix", False), ("separatrix", True)
    ]  # fmt: skip
    assert drawings_from_data(drawings_to_data([portrait])) == (portrait,)
    assert sheet(portrait).height > sheet(plot_of(cos(theta))).height


def test_a_range_of_two_turns_has_a_few_ticks() -> None:
    (panel,) = panels(plot_of(cos(theta), -2 * pi, 2 * pi))
    assert [at for at, _ in panel.across] == [-360, -180, 0, 180, 360]


@pytest.mark.parametrize(("wide", "form"), [(400, 0), (180, 1), (15, None)])
def test_all_extrema_are_named_in_the_same_form_or_none(wide: int, form: int | None) -> None:
    """If there is little room, the names are only symbols; if there is less, there are none."""
    places = tuple((Symbol(f"theta_{i}"), pi / 36 + i * pi / 2) for i in (0, 1))
    plot = replace(plot_of(cos(2 * theta - pi / 18), -pi / 4, 3 * pi / 4), places=places)
    (panel,) = panels(plot)
    writing = Writing(letters_of(set(panel.texts())))
    found = _names_of_turns(panel, Frame((0.0, 0.0, float(wide), 90.0), panel.values), writing, ())
    sizes = [box[2] - box[0] for _, box in found]
    expected = [] if form is None else [writing.size(names[form], plotting.SMALLEST)[0] for _, _, names in panel.turns]
    assert sizes == pytest.approx(expected)


def test_the_name_of_an_extremum_is_clear_of_the_ticks_of_the_axis() -> None:
    (panel,) = panels(plot_of(cos(theta - pi / 180), -pi / 12, pi / 2))
    writing = Writing(letters_of(set(panel.texts())))
    ((_, box),) = _names_of_turns(panel, Frame((0.0, 0.0, 120.0, 90.0), panel.values), writing, ())
    assert box[0] > plotting.TICK + 3


def strokes(panel: Panel) -> list[Stroke]:
    frame = Frame((0.0, 0.0, 1.0, 1.0), panel.values)
    return [each for each in line_of(panel, frame) if isinstance(each, Stroke)]


def test_curves_in_one_panel_have_different_lines() -> None:
    (panel,) = panels(plot_of(a * cos(theta)), 4, 3, 2, 1, together="together")
    assert [stroke.pen for stroke in strokes(panel)] == list(PENS_OF_CURVES)
    assert len({canvas.PENS[pen].dashes for pen in PENS_OF_CURVES}) == 4, "different in black and white"
    assert [trace.name for trace in panel.traces] == [rf"$a = {n}\,\mathrm{{m}}$" for n in (4, 3, 2, 1)]
    assert panel.numbers == ()
    assert sheet(plot_of(a * cos(theta)), 1, 2, together="together").width == sheet(plot_of(a * cos(theta)), 1).width


def named(plot: Plot, *cases: int, size: tuple[float, float] = (180.0, 90.0)) -> tuple[Panel, Names]:
    (panel,) = panels(plot, *cases, together="together")
    writing = Writing(letters_of(set(panel.texts())))
    return panel, _names(panel, Frame((0.0, 0.0, *size), panel.values), writing)


def test_each_curve_has_its_name_next_to_it() -> None:
    _, names = named(plot_of(a * cos(theta)), 4, 1)
    assert len(names.curves) == 2 and not any(shape.width for shape in names.curves), "no lines of a legend"
    assert names.above == 0
    texts = [box(shape) for shape in names.curves]
    assert texts[0][1] > texts[1][1], "the name of the upper curve is above that of the lower curve"


def test_a_legend_has_the_order_of_the_curves() -> None:
    (panel,) = panels(plot_of(cos(theta) + a / 100), 1, 2, together="together")
    assert plotting._from_the_top(panel) == [1, 0]


def test_curves_of_one_panel_have_the_letters_of_the_caption() -> None:
    plot, problem = plot_of(a * cos(theta)), SimpleNamespace(amounts={}, measured=(), place_of=lambda _: None)
    cases = tuple((Measured(a, Integer(n), "m", Integer(n)),) for n in (2, 1))
    caption: Any = SimpleNamespace(text="The energy for (i) a large and (ii) a small length.")
    placement = Placement("potential", Place("one.yaml", 9), cases=cases, caption=caption)
    found = curves_of(problem, plot, placement)  # type: ignore[arg-type]
    (panel,) = [panel_of(plot, own, found, Notation()) for own in found.panels]
    assert [trace.name for trace in panel.traces] == [
        r"$({\mathrm{i}})\;\;a = 2\,\mathrm{m}$", r"$({\mathrm{ii}})\;\;a = 1\,\mathrm{m}$"
    ]  # fmt: skip


def test_the_value_of_a_phase_portrait_is_in_a_gap_of_its_curve() -> None:
    momentum = Symbol("p", real=True)
    levels = Levels(momentum, Integer(-2), Integer(2), ((Integer(1), False),), "J")
    plot = Plot("portrait", momentum, (momentum**2 + theta**2) / 2, theta, Integer(-2), Integer(2), "number", "time",
                (), "kg m/s", levels=levels)  # fmt: skip
    (panel,) = panels(plot)
    writing, frame = Writing(letters_of(set(panel.texts()))), Frame((0.0, 0.0, 180.0, 150.0), panel.values)
    names = _names(panel, frame, writing)
    ((_, (left, below, right, above)),) = names.gaps
    drawn = [spot for each in line_of(panel, frame, names.gaps) if isinstance(each, Stroke) for spot in each.spots]
    assert len(names.curves) == 1 and drawn
    assert not any(left < x < right and below < y < above for x, y in drawn)


def test_names_without_room_next_to_the_curves_are_in_a_legend() -> None:
    """The curves almost coincide, so a name next to one of them would also be next to the other."""
    near = plot_of(theta + a / 100)
    _, inside = named(near, 1, 2)
    assert len([shape for shape in inside.curves if shape.width]) == 2, "a line for each curve"
    assert inside.above == 0, "the legend is in a corner of the panel"
    _, outside = named(plot_of(sin(8 * theta) + a / 100), 1, 2)
    assert len([shape for shape in outside.curves if shape.width]) == 2
    assert outside.above > 90.0, "above the panel"


def test_the_axis_of_several_quantities_has_all_their_names(drawn: list[Shape]) -> None:
    U = Symbol("U")
    both = Plot("both", V, cos(theta), theta, -pi / 2, pi / 2, "energy", "angle", others=(Further(U, sin(theta), "U"),))
    (panel,) = panels(both, together=None)
    assert panel.names[1] == r"$(V,\,U)\,/\,\mathrm{J}$"
    assert [trace.name for trace in panel.traces] == ["$V$", "$U$"]
    assert drawings_from_data(drawings_to_data([both])) == (both,)


def test_two_paths_in_one_panel_have_one_scale_and_arrowheads_of_their_own() -> None:
    (panel,) = panels(path_of(a * cos(theta), a * sin(theta)), 1, 2, together=None)
    assert panel.shape == pytest.approx(1)
    left, low, right, high = panel.values
    assert left < -2 < 2 < right and low < -2 < 2 < high
    assert [(stroke.pen, stroke.head) for stroke in strokes(panel)] == [
        ("curve", False), ("curve", True), ("dashed_curve", False), ("dashed_curve", True)
    ]  # fmt: skip


def test_the_axes_of_a_path_have_powers_of_ten_and_one_power_if_they_have_one_scale() -> None:
    far = Integer(10) ** 11
    (panel,) = panels(path_of(far * cos(theta), far * sin(theta) / 2, unit="m"))
    assert panel.names == (r"$x\,/\,(10^{11}\,\mathrm{m})$", r"$z\,/\,(10^{10}\,\mathrm{J})$")
    (same,) = panels(path_of(far * cos(theta), far * sin(theta) / 20))
    assert same.names == (r"$x\,/\,(10^{11}\,\mathrm{J})$", r"$z\,/\,(10^{11}\,\mathrm{J})$")


def test_an_angle_on_an_axis_of_a_path_or_of_a_curve_is_in_degrees() -> None:
    turning = Plot("path", V, theta / 4, theta, Integer(0), pi, "angle", "angle", across=Across(a, cos(theta), "rad"))
    (panel,) = panels(turning)
    assert panel.names == (r"$a\,/\,{}^{\circ}$", r"$V\,/\,{}^{\circ}$")
    assert panel.traces[0].points[-1] == pytest.approx((-57.29578, 45.0))
    (curve,) = panels(Plot("angle", V, sin(theta) / 2, theta, Integer(0), Integer(3), "angle", "time"))
    assert curve.names[1] == r"$V\,/\,{}^{\circ}$"


def test_the_axes_of_a_phase_portrait_have_powers_of_ten() -> None:
    momentum, size = Symbol("p", real=True), Integer(10) ** 7
    levels = Levels(momentum, -size, size, ((Integer(1), False),), "J")
    portrait = Plot(
        "portrait", momentum, (momentum / size) ** 2 + theta**2, theta, Integer(-2), Integer(2), "number", "angle", (),
        "kg m^2/s", levels=levels,
    )  # fmt: skip
    (panel,) = panels(portrait)
    assert panel.names[1] == r"$p\,/\,(10^{7}\,\mathrm{kg\,m^{2}/s})$"
    assert [text for _, text in panel.up] == ["$-1.0$", "$-0.5$", "$0.0$", "$0.5$", "$1.0$"]


def test_a_steep_path_has_a_narrow_panel() -> None:
    steep, flat = sheet(path_of(cos(theta), 2 * sin(theta))), sheet(path_of(2 * cos(theta), sin(theta)))
    assert steep.width < flat.width == pytest.approx(plotting.PANEL * CM)
    assert steep.height < (plotting.TALLEST + 1.5) * CM


def test_many_numbers_are_in_several_rows_above_a_panel(drawn: list[Shape]) -> None:
    letters = symbols("c d e f g", positive=True)
    plot = plot_of(sum(letters) * cos(theta))
    problem: Any = SimpleNamespace(amounts={}, measured=(), place_of=lambda _: None)
    numbers = tuple(Measured(letter, Integer(1234567), "m", Integer(1)) for letter in letters)
    placement = Placement("potential", Place("one.yaml", 9), cases=(numbers,))
    plot_sheet(plot, curves_of(problem, plot, placement), Notation(), None, "")
    texts = [box(shape) for shape in drawn if shape.fill == canvas.QUIET][-5:]
    assert len({round(each[1]) for each in texts}) > 1
    assert all(0 < each[0] < each[2] < plotting.PANEL * CM for each in texts)
    assert all(one[2] <= two[0] or abs(one[1] - two[1]) > 5 for one, two in combinations(texts, 2))


def test_a_unit_that_is_a_product_or_a_quotient_is_in_parentheses() -> None:
    (panel,) = panels(Plot("v", V, theta, theta, Integer(0), Integer(3), "speed", "time"))
    assert panel.names == (r"$\theta\,/\,\mathrm{s}$", r"$V\,/\,(\mathrm{m/s})$")


def test_the_surfaces_of_a_path_are_in_its_panel() -> None:
    x, y = symbols("x y", real=True)
    circle = Outline("circle", x**2 + y**2 - a**2, (x, y), (-a, -a, a, a))
    line = Outline("line", y + a, (x, y))
    path = replace(path_of(theta, theta, upper=Integer(1)), outlines=(circle, line))
    (panel,) = panels(path, 2)
    left, low, right, high = panel.values
    assert left < -2 < 2 < right and low < -2 < 2 < high, "all of the circle"
    around, level = panel.outlines
    assert all(x**2 + y**2 == pytest.approx(4, abs=0.01) for x, y in around)
    assert all(y == pytest.approx(-2) for _, y in level)
    assert {level[0][0], level[-1][0]} == {left, right}
    assert [stroke.pen for stroke in strokes(panel)][:2] == ["edge", "edge"]
    assert drawings_from_data(drawings_to_data([path])) == (path,)


def force_of(expr: Expr, *others: Expr, upper: Expr = pi) -> Curves:
    further = tuple(Further(Symbol(f"F_{i}"), each, f"force_{i}") for i, each in enumerate(others))
    plot = Plot("force", V, expr, theta, Integer(0), upper, "force", "angle", unit="N", others=further)
    problem: Any = SimpleNamespace(amounts={}, measured=(), place_of=lambda _: None)
    return curves_of(problem, plot, Placement("force", Place("one.yaml", 9)))


def points_of(found: Curves) -> list[tuple[float, float]]:
    return [(round(x, 4), round(y, 4)) for x, y, _ in found.points(found.panels[0])]


def test_a_zero_is_marked_where_a_quantity_changes_its_sign() -> None:
    """The force in a rod that rotates about its lower end vanishes if 3 cos(theta) = 2, at 48.19 degrees."""
    found = force_of(2 - 3 * cos(theta))
    assert points_of(found) == [(0.8411, 0.0)]
    panel = panel_of(Plot("force", V, 2 - 3 * cos(theta), theta, Integer(0), pi, "force", "angle", unit="N"),
                     found.panels[0], found, Notation())  # fmt: skip
    assert panel.is_signed and [name for _, name in panel.points] == [r"$48.2{}^{\circ}$"]


def test_no_zero_is_marked_where_a_curve_ends_or_oscillates_or_is_an_energy() -> None:
    assert not points_of(force_of(2 - 3 * cos(theta), upper=Rational(1, 2)))
    assert not points_of(force_of(cos(20 * theta)))
    energy = curves(plot_of(sin(theta)), 1)
    assert not energy.points(energy.panels[0])


def test_the_point_at_which_two_curves_meet_is_marked_also_at_the_end_of_the_range() -> None:
    assert points_of(force_of(1 - theta, theta)) == [(0.5, 0.5)]
    assert points_of(force_of(1 - theta, theta, upper=Rational(1, 2))) == [(0.5, 0.5)]
    assert not points_of(force_of(2 + theta, theta))
    assert not points_of(force_of(theta, 2 * theta))  # two curves that both start at zero do not count as meeting there


def test_the_zeros_of_two_curves_that_do_not_meet_are_marked() -> None:
    assert points_of(force_of(1 - theta, 5 - theta)) == [(1.0, 0.0)]


def test_a_curve_with_many_extrema_has_enough_points_for_each_of_them() -> None:
    few, many = force_of(cos(theta)).curves[0], force_of(cos(100 * theta)).curves[0]
    assert len(few.spots) == 241 and len(many.spots) > 30 * len(many.extrema)
    assert max(y for _, y in many.spots) > 0.997


def test_a_degree_sign_above_a_panel_has_no_space_before_it() -> None:
    problem: Any = SimpleNamespace(amounts={}, measured=(), place_of=lambda _: None)
    numbers = ((Measured(a, Rational(120), "degree", Rational(2, 3) * pi),),)
    plot = plot_of(a * cos(theta))
    found = curves_of(problem, plot, Placement("potential", Place("one.yaml", 9), cases=numbers))
    panel = panel_of(plot, found.panels[0], found, Notation())
    assert panel.numbers == (r"$a = 120{}^{\circ}$",)


def test_a_curve_is_cut_at_the_ends_of_the_vertical_axis_that_the_problem_states() -> None:
    plot = plot_of(theta**2 - 1, Integer(-2), Integer(2), "length")
    found = replace(curves(plot, 1), ends_up=(-0.5, 1.0))
    panel = panel_of(plot, found.panels[0], found, Notation())
    assert (panel.values[1], panel.values[3]) == (-0.5, 1.0) and panel.turns == (), "the minimum is outside"
    drawn = [each.spots for each in line_of(panel, Frame(panel.values, panel.values)) if isinstance(each, Stroke)]
    assert len(drawn) == 2 and {round(y, 9) for part in drawn for _, y in (part[0], part[-1])} == {-0.5, 1.0}
    assert drawn[0][0][0] == pytest.approx(-(2**0.5), abs=1e-3)


def test_a_name_in_a_gap_leaves_no_short_end_of_an_open_curve() -> None:
    line = [(2.0 * i, 0.0) for i in range(101)]
    near_the_end = [(x, 30.0) for x in range(0, 160)]  # another curve, close to the first part of the line
    box = on_curve(line, (20.0, 8.0), (-50.0, -50.0, 250.0, 50.0), [], near_the_end)
    assert box is not None
    assert box[2] <= line[-1][0] - STUB and box[0] >= line[0][0] + STUB


def test_the_dots_of_unstable_equilibria_are_open_and_the_dots_of_other_maxima_are_filled() -> None:
    U = Symbol("U_eff")
    energy = replace(plot_of(cos(2 * theta), -pi, pi), label=U)
    assert curves(energy, 1).has_unstable and panels(energy)[0].has_open
    assert not curves(plot_of(cos(2 * theta), -pi, pi), 1).has_unstable, "V is not a potential energy"
    assert not curves(replace(energy, expr=theta**2), 1).has_unstable


@pytest.mark.parametrize(
    ("ends", "told"),
    [
        ((-pi / 4, 5 * pi / 4), "The filled dot at the minimum shows a stable equilibrium, open dots unstable ones."),
        (
            (-pi / 4, 3 * pi / 4),
            "The filled dot at the minimum shows a stable equilibrium, the open dot an unstable one.",
        ),
        ((-3 * pi / 4, 3 * pi / 4), "Filled dots at minima show stable equilibria, the open dot an unstable one."),
        ((-pi / 4, pi / 4), "An open dot shows an unstable equilibrium."),
    ],
)
def test_the_words_for_the_dots_depend_on_their_numbers(ends: tuple[Expr, Expr], told: str) -> None:
    energy = replace(plot_of(cos(2 * theta), *ends), label=Symbol("U_eff"))
    words = told_of_curves(curves(energy, 1), phrases(templates_of(ROOT)))
    assert "".join(each.text for each in words if isinstance(each, Text)).strip() == told


def test_a_curve_keeps_a_value_after_its_range() -> None:
    kept = replace(plot_of(1 + theta, Integer(0), Integer(1)), then=Integer(2))
    (curve,) = curves(kept, 1).curves
    assert curve.spots[-2:] == ((1.0, 2.0), (pytest.approx(4 / 3), 2.0))
    (panel,) = panels(kept)
    assert panel.values[2] == pytest.approx(4 / 3)
    with pytest.raises(Rejected, match="does not end at the value of `then`"):
        curves(replace(kept, then=Integer(3)), 1)


def test_both_axes_of_a_path_in_one_unit_have_one_step() -> None:
    across = Across(Symbol("x"), cos(theta), "m")
    path = Plot(
        "orbit", Symbol("y"), 3 * sin(theta) / 2, theta, Integer(0), 2 * pi, "length", "angle", unit="m", across=across
    )
    (panel,) = panels(path)
    steps = {round(ticks[1][0] - ticks[0][0], 6) for ticks in (panel.across, panel.up)}
    assert steps == {1.0}


def test_a_path_around_the_origin_has_thin_lines_through_it() -> None:
    (around,), (beyond,) = panels(path_of(cos(theta), sin(theta))), panels(path_of(theta, theta + 1, upper=Integer(4)))
    assert around.is_signed and around.is_signed_across
    assert not beyond.is_signed and not beyond.is_signed_across


def test_symbols_that_differ_in_their_subscripts_have_one_name_at_the_axis() -> None:
    first, *others = (Symbol(name) for name in ("x_1", "x_2", "x_3"))
    more = tuple(Further(each, cos(theta) + i, each.name) for i, each in enumerate(others, 1))
    several = Plot("motion", first, cos(theta), theta, -pi / 2, pi / 2, "energy", "angle", others=more)
    assert panels(several, together=None)[0].names[1] == r"$x\,/\,\mathrm{J}$"
