"""A number with its unit is read exactly, and must lie where its letter does."""

from __future__ import annotations

import pytest
from sympy import Integer, Rational, pi

from derive.algebra.ranges import Range
from derive.course.expression import Declared
from derive.course.given import symbol_of_kind
from derive.course.measures import Wanted, check_range, is_more_than_unit, number_with_unit
from derive.course.yaml_tree import Mapping, Scalar, Source, yaml_tree
from derive.errors import Rejected

ACUTE = Range(Integer(0), pi / 2, (False, True), written="(0, 90 deg]")


def scalar(text: str) -> Scalar:
    node = yaml_tree(Source("p.yaml", f"x: {text}\n"))
    assert isinstance(node, Mapping)
    found = node.pairs[0][1]
    assert isinstance(found, Scalar)
    return found


@pytest.mark.parametrize(
    ("text", "number", "unit", "si"),
    [
        ("30 cm", Integer(30), "cm", Rational(3, 10)),
        ("-1/3 m", Rational(-1, 3), "m", Rational(-1, 3)),
        ("2.5e-1 m", Rational(1, 4), "m", Rational(1, 4)),
    ],
)
def test_a_number_is_exact_in_its_unit_and_in_the_si(text: str, number: Rational, unit: str, si: Rational) -> None:
    found = number_with_unit(scalar(text), Wanted("x", "length"), {})
    assert found is not None
    assert (found.number, found.unit, found.si, found.scalar.text) == (number, unit, si, text)


def test_what_goes_on_behind_its_unit_is_an_expression() -> None:
    phi = Declared("phi", symbol_of_kind("phi", "angle"), "angle")
    assert is_more_than_unit("3 cm*sin(phi)", {"phi": phi})
    assert not is_more_than_unit("3 N m", {"phi": phi})


@pytest.mark.parametrize(("degrees", "held"), [(30, True), (90, True), (0, False), (91, False), (-30, False)])
def test_a_number_beyond_the_range_of_its_letter_is_refused_with_both(degrees: int, held: bool) -> None:
    alpha = Declared("alpha", symbol_of_kind("alpha", "angle", ACUTE), "angle", ACUTE)
    written = scalar(f"{degrees} deg")
    if held:
        check_range(alpha, degrees * pi / 180, written)
        return
    with pytest.raises(Rejected) as caught:
        check_range(alpha, degrees * pi / 180, written)
    (complaint,) = caught.value.complaints
    assert complaint.message == f"`alpha` is declared to lie in (0, 90 deg], but `{degrees} deg` does not"
    assert complaint.place == written.place


@pytest.mark.parametrize("text", ["1_000 kg", "1 000 kg", "1'000 kg", "1\u202f000 kg"])
def test_a_number_with_a_character_between_its_digits_is_refused(text: str) -> None:
    with pytest.raises(Rejected) as caught:
        number_with_unit(scalar(text), Wanted("m", "mass"), {})
    (complaint,) = caught.value.complaints
    assert (complaint.code, complaint.help) == ("digits", "write `1000 kg`")
