"""Where a problem puts its drawings: places, widths and numbers, and what cannot be meant by them."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Expr, Integer, Rational, Symbol, pi

from derive.course.placement import Placement, case_label
from derive.errors import Complaint, Rejected
from tests.course.problem_file import loaded

a = Symbol("a", positive=True)


def placed(folder: Path, written: str, *edits: tuple[str, str]) -> Placement:
    (found,) = loaded(folder, *edits, ("figures: 3\n", f"figures: 3\ndrawings: {{vectors: {{{written}}}}}\n")).drawings
    assert found.key == "vectors"
    return found


def refused(folder: Path, written: str) -> tuple[Complaint, ...]:
    with pytest.raises(Rejected) as caught:
        placed(folder, written)
    return caught.value.complaints


def test_what_a_problem_does_not_say_is_left_to_derive(tmp_path: Path) -> None:
    found = placed(tmp_path, "width: 5 cm")
    assert (found.at, found.caption, found.values, found.range, found.cases) == (None, None, (), None, ())


@pytest.mark.parametrize("at", ["statement", "hidden", "a", "c", "angle_between"])
def test_a_place_is_the_statement_a_part_a_step_or_nowhere(at: str, tmp_path: Path) -> None:
    assert placed(tmp_path, f"at: {at}").at == at


@pytest.mark.parametrize(("at", "help_line"), [("d", None), ("A", None), ("statment", "did you mean `statement`?")])
def test_what_is_no_place_is_told_with_those_that_are(at: str, help_line: str | None, tmp_path: Path) -> None:
    (fault,) = refused(tmp_path, f"at: {at}")
    assert fault.message.startswith("`at` must be statement, part a to c, the key of a step, or hidden")
    assert fault.help == help_line


def test_a_list_is_no_place(tmp_path: Path) -> None:
    (fault,) = refused(tmp_path, "at: [a, b]")
    assert fault.message == "`at` must be statement, the letter of a part, a step, or hidden, but it is a list"


@pytest.mark.parametrize(("width", "cm"), [("1 cm", 1.0), ("15 cm", 15.0), ("0.02 m", 2.0), ("40 mm", 4.0)])
def test_a_width_is_in_centimetres(width: str, cm: float, tmp_path: Path) -> None:
    assert placed(tmp_path, f"width: {width}").width == pytest.approx(cm)


@pytest.mark.parametrize(
    ("width", "code"),
    [("0.9 cm", "wrong-size"), ("15.1 cm", "wrong-size"), ("-3 cm", "not-positive"), ("4 s", "wrong-kind")],
)
def test_a_drawing_fits_the_page_and_can_be_seen(width: str, code: str, tmp_path: Path) -> None:
    assert [fault.code for fault in refused(tmp_path, f"width: {width}")] == [code]


@pytest.mark.parametrize(
    ("written", "letter", "value"), [("a: 2 cm", "a", Rational(1, 50)), ("theta: 40 deg", "theta", 2 * pi / 9)]
)
def test_a_letter_is_drawn_with_a_number_of_its_kind(written: str, letter: str, value: Expr, tmp_path: Path) -> None:
    """A letter that is not declared is a coordinate of the script, and so an angle."""
    ((symbol, found),) = placed(tmp_path, f"values: {{{written}}}").values
    assert (symbol.name, found) == (letter, value)
    assert len(refused(tmp_path / "odd", f"values: {{{letter}: 3 kg}}")) == 1


def test_a_letter_may_be_drawn_in_terms_of_others_but_not_of_itself(tmp_path: Path) -> None:
    found = placed(tmp_path, "values: {b: 3*a/2}", ("a: length", "a: length, b: length"))
    assert [(letter.name, value) for letter, value in found.values] == [("b", 3 * a / 2)]
    (fault,) = refused(tmp_path, "values: {a: 2*a}")
    assert (fault.code, fault.message) == ("circular", "`a` cannot be drawn in terms of itself")


def test_the_ends_of_a_range_are_read_once_their_kind_is_known(tmp_path: Path) -> None:
    found = placed(tmp_path, "range: [-90 deg, 30 deg]").range
    assert found is not None
    assert found.of_kind("angle") == [-pi / 2, pi / 6]
    with pytest.raises(Rejected, match="must be a length"):
        found.of_kind("length")


def test_each_case_of_a_plot_has_its_own_numbers(tmp_path: Path) -> None:
    found = placed(tmp_path, "cases: [{a: 20 cm, M: 1 kg}, {a: 10 cm}]")
    assert [{m.symbol.name: m.si for m in case} for case in found.cases] == [
        {"a": Rational(1, 5), "M": Integer(1)},
        {"a": Rational(1, 10)},
    ]


def test_cases_are_not_called_as_parts_are() -> None:
    assert [case_label(i) for i in (0, 1, 3, 9)] == ["i", "ii", "iv", "x"]
    assert case_label(10) == "11"


@pytest.mark.parametrize(
    ("view", "angles"),
    [
        ("front", (0.0, 0.0)),
        ("top", (-90.0, 90.0)),
        ("{azimuth: 30, elevation: 20}", (30.0, 20.0)),
        ("{azimuth: -45.5 deg, elevation: 0}", (-45.5, 0.0)),
    ],
)
def test_a_view_has_a_name_or_two_angles_in_degrees(view: str, angles: tuple[float, float], tmp_path: Path) -> None:
    assert placed(tmp_path, f"view: {view}").view == angles


@pytest.mark.parametrize(
    ("view", "message", "help_line"),
    [
        ("frnt", "`view` must be front, side, top or a mapping such as", "did you mean `front`?"),
        ("[30, 20]", "`view` must be front, side, top or a mapping such as", None),
        ("{azimuth: 30, elevation: 95}", "`elevation` must be an angle from -90 to 90 degrees", None),
        ("{azimuth: a, elevation: 20}", "`azimuth` must be an angle from -360 to 360 degrees", None),
        ("{azimuth: 30}", "a view needs `elevation`", None),
        ("{azimut: 30, elevation: 20}", "a view has no key `azimut`", "did you mean `azimuth`?"),
    ],
)
def test_what_is_no_view_is_refused(view: str, message: str, help_line: str | None, tmp_path: Path) -> None:
    (fault,) = refused(tmp_path, f"view: {view}")
    assert fault.message.startswith(message) and fault.help == help_line
