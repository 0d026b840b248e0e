"""What is given becomes a value, a letter with a number, or a complaint."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr, Integer, Rational, Symbol, pi

from derive.algebra.direction import Direction
from derive.algebra.expressions import TIME, explicit
from derive.algebra.kinds import ANNOTATIONS, Angle, Lengths, asked_by_annotation
from derive.course.expression import Declared
from derive.course.given import (
    Given,
    Measured,
    read_givens,
    read_measured,
    symbol_of_kind,
)
from derive.course.yaml_tree import Mapping, Source, yaml_tree
from derive.errors import Faults, Rejected

BLOCK = {"a": "length", "M": "mass", "omega": "angular speed"}
ASKED = {"sides": "Lengths", "mass": "Mass", "axis": "Direction", "rate": "AngularSpeed"}


def declared(kinds: dict[str, str]) -> dict[str, Declared]:
    return {name: Declared(name, symbol_of_kind(name, kind), kind) for name, kind in kinds.items()}


def read(text: str, asked: dict[str, str], symbols: dict[str, str]) -> tuple[dict[str, Given], dict[str, Declared]]:
    node = yaml_tree(Source("p.yaml", text))
    assert isinstance(node, Mapping)
    faults = Faults()
    nodes = {key.text: value for key, value in node.pairs}
    kinds = {name: ANNOTATIONS[asked[name]] for name in nodes}
    givens, found = read_givens(nodes, kinds, declared(symbols), faults, notes=dict.fromkeys(nodes, "asked here"))
    faults.stop()
    return {given.name: given for given in givens}, found


def given(text: str, kind: str, symbols: dict[str, str] | None = None) -> Given:
    return read(f"x: {text}\n", {"x": kind}, BLOCK if symbols is None else symbols)[0]["x"]


def value(text: str, kind: str, symbols: dict[str, str] | None = None) -> Any:
    return given(text, kind, symbols).value


def codes(text: str, kind: str, symbols: dict[str, str] | None = None) -> list[str]:
    with pytest.raises(Rejected) as caught:
        given(text, kind, symbols)
    return [complaint.code for complaint in caught.value.complaints]


a, M, omega = (symbol_of_kind(name, kind) for name, kind in BLOCK.items())
b, c = symbol_of_kind("b", "length"), symbol_of_kind("c", "length")


def test_an_expression_in_declared_letters_goes_to_solve_as_it_is() -> None:
    assert value("[a, 2*a, 3*a/2]", "Lengths") == (a, 2 * a, Rational(3, 2) * a)
    assert given("2*M", "Mass").measured == ()


def test_a_number_with_a_unit_becomes_the_letter_declared_for_its_kind() -> None:
    found = given("1.5 kg", "Mass")
    assert (found.value, found.measured) == (M, (Measured(M, Rational(3, 2), "kg", Rational(3, 2)),))


def test_numbers_take_declared_letters_first_and_then_usual_ones() -> None:
    found = given("[2 cm, 3 cm, 5 cm]", "Lengths")
    assert found.value == (a, b, c)
    assert [measured.si for measured in found.measured] == [Rational(1, 50), Rational(3, 100), Rational(1, 20)]


def test_whole_multiples_of_the_smallest_share_its_letter() -> None:
    found = given("[4 cm, 2 cm, 60 mm]", "Lengths")
    assert found.value == (2 * a, a, 3 * a)
    assert [measured.si for measured in found.measured] == [Rational(1, 50)]


def test_equal_numbers_share_a_letter_so_that_a_cube_stays_a_cube() -> None:
    found = given("[2 cm, 20 mm, 0.02 m]", "Lengths")
    assert found.value == (a, a, a)
    assert len(found.measured) == 1


def test_equal_numbers_of_different_givens_keep_different_letters() -> None:
    found, _ = read("x: 2 cm\ny: 2 cm\n", {"x": "Length", "y": "Length"}, {})
    assert found["x"].value != found["y"].value


def test_a_letter_that_another_given_uses_is_not_taken() -> None:
    found, symbols = read("x: 2 cm\ny: 3*a\n", {"x": "Length", "y": "Length"}, BLOCK)
    assert str(found["x"].value) == "l"
    assert symbols["l"].kind == "length"


def test_a_letter_declared_for_another_kind_is_not_taken() -> None:
    assert value("[2 m, 3 m, 5 m]", "Lengths", {"a": "angle", "b": "mass"}) == tuple(
        symbol_of_kind(name, "length") for name in ("c", "a_1", "a_2")
    )


def test_letters_never_run_out() -> None:
    text = "".join(f"x{n}: {n + 1} kg\n" for n in range(9))
    found, _ = read(text, {f"x{n}": "Mass" for n in range(9)}, {"M_1": "length"})
    letters = [str(given.value) for given in found.values()]
    assert len(set(letters)) == 9
    assert "M_1" not in letters


def test_numbers_are_exact() -> None:
    assert given("900 rpm", "AngularSpeed").measured[0].si == 30 * pi
    assert given("40 deg", "Angle").measured[0].si == 2 * pi / 9
    assert given("1/3 m", "Length").measured[0].si == Rational(1, 3)
    assert given("1e-3 m", "Length").measured[0].number == Rational(1, 1000)


def test_a_minus_sign_on_a_rate_stays_outside_its_letter() -> None:
    found = given("-900 rpm", "AngularSpeed")
    assert (found.value, found.measured[0].number, found.measured[0].si) == (-omega, 900, 30 * pi)


def test_zero_needs_no_letter() -> None:
    found = given("0 deg", "Angle")
    assert (found.value, found.measured) == (0, ())


@pytest.mark.parametrize(
    ("text", "value"), [("45 deg", pi / 4), ("30 deg", pi / 6), ("120 deg", 2 * pi / 3), ("-90 deg", -pi / 2)]
)
def test_an_angle_whose_sine_is_a_single_root_is_used_exactly(text: str, value: Expr) -> None:
    found = given(text, "Angle")
    assert (found.value, found.measured) == (value, ())
    assert found.written is not None and explicit(found.written) == value


def test_letters_for_sizes_are_positive_and_the_others_real() -> None:
    assert given("2 kg", "Mass", {}).value.is_positive
    angle = given("-40 deg", "Angle").value
    assert angle.is_real
    assert angle.is_positive is None


def test_numbers_without_a_unit_are_for_numbers_only() -> None:
    assert value("3", "Number") == Integer(3)
    assert value("pi/4", "Angle") == pi / 4
    assert value("0", "Angle") == 0
    assert codes("45", "Angle") == ["missing-unit"]
    assert codes("1.5", "Mass") == ["missing-unit"]
    assert codes("45 deg", "Number") == ["wrong-kind"]


def test_a_space_does_not_make_a_declared_letter_a_unit() -> None:
    with pytest.raises(Rejected, match=r"write `2\*M`"):
        value("2 M", "Mass")
    with pytest.raises(Rejected, match=r"write `2\*m` if you mean the symbol"):
        value("2 m", "Mass", {"m": "mass"})


@pytest.mark.parametrize(
    ("text", "kind", "code"),
    [
        ("a", "Mass", "wrong-kind"),
        ("2 cm", "Mass", "wrong-kind"),
        ("[M]", "Mass", "wrong-kind"),
        ("", "Mass", "missing-value"),
        ("2 kgs", "Mass", "unknown-unit"),
        ("2 kg + M", "Mass", "unknown-unit"),
        ("0 kg", "Mass", "not-positive"),
        ("-2 kg", "Mass", "not-positive"),
        ("M - 2*M", "Mass", "not-positive"),
        ("0 rpm", "AngularSpeed", "not-positive"),
        ("0*omega", "AngularSpeed", "not-positive"),
        ("15 Hz", "AngularSpeed", "ambiguous-unit"),
        ("1/0 kg", "Mass", "too-large"),
        ("1e999 kg", "Mass", "too-large"),
        ("1e999999999 kg", "Mass", "too-large"),
        ("1" * 31 + " kg", "Mass", "too-large"),
        ("[a, a]", "Lengths", "wrong-length"),
        ("[a, a, a, a]", "Lengths", "wrong-length"),
        ("[]", "Lengths", "wrong-length"),
        ("a", "Lengths", "wrong-kind"),
        ("{a: a}", "Lengths", "wrong-kind"),
        ("[0, 0, 0]", "Direction", "zero-axis"),
        ("[a - a, 0, 0]", "Direction", "zero-axis"),
        ("[1, 1]", "Direction", "wrong-length"),
        ("[1, a, 0]", "Direction", "dimension"),
        ("diagnal", "Direction", "wrong-kind"),
        ("{}", "Direction", "wrong-kind"),
    ],
)
def test_what_cannot_be_meant_is_refused(text: str, kind: str, code: str) -> None:
    assert codes(text, kind) == [code]


@pytest.mark.parametrize(("text", "product"), [("2 Z", "2*Z"), ("2Z*M", "2*Z*M")])
def test_an_unknown_letter_after_a_number_is_not_only_an_unknown_unit(text: str, product: str) -> None:
    with pytest.raises(Rejected) as refused:
        given(text, "Mass")
    (complaint,) = refused.value.complaints
    assert complaint.message == "`Z` is neither a unit nor a declared symbol"
    assert complaint.help == f"write a unit; or declare the symbol and write `{product}`"


def test_a_difference_that_may_be_positive_is_accepted() -> None:
    assert value("[a - b, a, b]", "Lengths", {"a": "length", "b": "length"}) == (a - b, a, b)


def test_a_rate_may_be_turned_round() -> None:
    assert value("-omega", "AngularSpeed") == -omega


def test_the_faults_of_a_list_and_of_its_neighbours_are_told_together() -> None:
    with pytest.raises(Rejected) as caught:
        read("sides: [q, M, 2]\nmass: a\naxis: [0, 0, 0]\nrate: 3 rmp\n", ASKED, BLOCK)
    assert [complaint.code for complaint in caught.value.complaints] == [
        "undeclared-symbol",
        "wrong-kind",
        "missing-unit",
        "wrong-kind",
        "zero-axis",
        "unknown-unit",
    ]
    assert caught.value.complaints[1].notes == ("asked here",)


def test_a_direction_is_a_name_or_components_of_one_dimension() -> None:
    assert given("diagonal", "Direction").word == "diagonal"
    assert value("[1, 1, 0]", "Direction") == Direction(None, (Integer(1), Integer(1), Integer(0)))
    assert value("[a, 0, -2*a]", "Direction") == Direction(None, (a, Integer(0), -2 * a))


def measured(text: str) -> Measured:
    node = yaml_tree(Source("p.yaml", text))
    assert isinstance(node, Mapping)
    return read_measured(
        node.pairs[0][0].word, node.pairs[0][1], declared({**BLOCK, "n": "number", "theta": "angle", "tau": "torque"})
    )


def test_a_number_is_attached_to_a_declared_letter() -> None:
    assert measured("a: 2 cm") == Measured(a, Integer(2), "cm", Rational(1, 50))
    assert measured("n: 3") == Measured(Symbol("n", real=True), Integer(3), "", Integer(3))
    assert measured("tau: -3/2 N m").si == Rational(-3, 2)
    assert measured("theta: 0 deg").factor == pi / 180


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("q: 2 cm", "undeclared-symbol"),
        ("a: 2 s", "wrong-kind"),
        ("a: a", "wrong-kind"),
        ("a: 2", "missing-unit"),
        ("a: -2 cm", "not-positive"),
        ("omega: -2 rad/s", "not-positive"),
        ("a:", "missing-value"),
        ("a: [2 cm]", "wrong-kind"),
    ],
)
def test_a_number_that_does_not_fit_its_letter_is_refused(text: str, code: str) -> None:
    with pytest.raises(Rejected) as caught:
        measured(text)
    assert [complaint.code for complaint in caught.value.complaints] == [code]


def test_a_kind_is_known_by_its_annotation_or_by_its_name() -> None:
    assert asked_by_annotation(Lengths) == ANNOTATIONS["Lengths"]
    assert asked_by_annotation("given.Angle") == asked_by_annotation(Angle)
    assert asked_by_annotation(Direction) == ANNOTATIONS["Direction"]
    assert asked_by_annotation(str) is None
    assert asked_by_annotation("Masss") is None


def test_the_letter_t_is_the_time_itself_and_any_other_letter_of_its_kind_a_duration() -> None:
    v, duration = symbol_of_kind("v", "speed"), symbol_of_kind("t_1", "time")
    kinds = {"v": "speed", "t": "time", "t_1": "time"}
    assert value("v*t", "Length", kinds) == v * TIME
    assert value("v*t_1", "Length", kinds) == v * duration
    assert duration.is_positive
    assert TIME.is_positive is None


def test_a_number_does_not_take_the_letter_of_the_time() -> None:
    assert str(value("2 s", "Time", {"t": "time"})) == "t_0"


@pytest.mark.parametrize(
    ("text", "kind", "code"),
    [
        ("405 deg", "PolarAngle", "out-of-range"),
        ("-30 deg", "PolarAngle", "out-of-range"),
        ("181 deg", "PolarAngle", "out-of-range"),
        ("4 rad", "PolarAngle", "out-of-range"),
        ("2*pi", "PolarAngle", "out-of-range"),
        ("3 cm/rev", "Length", "wrong-unit"),
        ("2 N m/rad", "Length", "wrong-kind"),
        ("15 rev/s", "Frequency", "wrong-unit"),
        ("a - 2*a", "Length", "not-positive"),
        ("-M**2/M", "Mass", "not-positive"),
        ("1e-3 a", "Length", "expression"),
    ],
)
def test_what_is_out_of_range_of_another_unit_or_negative_is_refused(text: str, kind: str, code: str) -> None:
    assert codes(text, kind) == [code]


@pytest.mark.parametrize("text", ["0 deg", "180 deg", "45 deg", "pi", "1/4 rev"])
def test_a_polar_angle_may_be_at_either_end(text: str) -> None:
    assert value(text, "PolarAngle").is_real


def test_an_angle_may_be_many_turns() -> None:
    assert value("10 rev", "Angle").is_real


@pytest.mark.parametrize(("text", "times"), [("1e-3*a", Rational(1, 1000)), ("1.5E2*a", 150), ("2e3 * a", 2000)])
def test_a_power_of_ten_before_a_letter_is_no_unit(text: str, times: Any) -> None:
    assert value(text, "Length") == times * a


def test_a_frequency_is_in_hertz() -> None:
    assert [measured.unit for measured in given("15 Hz", "Frequency").measured] == ["Hz"]
