"""Units are exact."""

from __future__ import annotations

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Integer, Rational, pi

from derive.dimensions import KINDS, dimension_of_kind, unit_of_kind
from derive.errors import Rejected
from derive.units import UNIT_NAMES, read_unit


@pytest.mark.parametrize(
    ("text", "factor", "kind"),
    [
        ("cm", Rational(1, 100), "length"),
        ("ft", Rational(3048, 10000), "length"),
        ("lb", Rational(45359237, 10**8), "mass"),
        ("min", Integer(60), "time"),
        ("deg", pi / 180, "angle"),
        ("°", pi / 180, "angle"),
        ("rev", 2 * pi, "angle"),
        ("rpm", pi / 30, "angular speed"),
        ("deg/s", pi / 180, "angular speed"),
        ("rev/min", pi / 30, "angular speed"),
        ("Hz", Integer(1), "angular speed"),
        ("1/s", Integer(1), "angular speed"),
        ("m/s/s", Integer(1), "acceleration"),
        ("m/s^2", Integer(1), "acceleration"),
        ("m/s**2", Integer(1), "acceleration"),
        ("m s⁻²", Integer(1), "acceleration"),
        ("km/h", Rational(5, 18), "speed"),
        ("kg m^2", Integer(1), "moment of inertia"),
        ("kg*m^2", Integer(1), "moment of inertia"),
        ("g cm^2", Rational(1, 10**7), "moment of inertia"),
        ("kg·m²/s", Integer(1), "angular momentum"),
        ("N m", Integer(1), "torque"),
        ("kN/m", Integer(1000), "spring constant"),
        ("g/cm^3", Integer(1000), "density"),
        ("N m/rad", Integer(1), "energy"),
    ],
)
def test_a_unit_is_an_exact_multiple_of_the_si(text: str, factor: object, kind: str) -> None:
    unit = read_unit(text)
    assert unit.factor == factor
    assert unit.dimension == dimension_of_kind(kind)
    assert unit.text == text


def test_the_unit_of_every_kind_is_coherent() -> None:
    for kind in KINDS:
        if unit_of_kind(kind):
            unit = read_unit(unit_of_kind(kind))
            assert (unit.factor, unit.dimension) == (1, dimension_of_kind(kind)), kind


@pytest.mark.parametrize("text", ["", "cmm", "m/", "/s", "m *", "m^0", "m^99", "m^2^2", "2 m", "m + s", "m" * 41, "m⁻"])
def test_what_is_no_unit_is_refused(text: str) -> None:
    with pytest.raises(Rejected) as caught:
        read_unit(text)
    assert [complaint.code for complaint in caught.value.complaints] == ["unknown-unit"]


def test_an_unknown_unit_is_met_with_the_nearest_one() -> None:
    with pytest.raises(Rejected) as caught:
        read_unit("kg m/sec")
    assert "unknown unit `sec` in `kg m/sec`" in str(caught.value)
    with pytest.raises(Rejected, match="did you mean `rpm`"):
        read_unit("rmp")


@given(st.text(max_size=20) | st.lists(st.sampled_from([*UNIT_NAMES, *"*/^ 23-·²"]), max_size=8).map("".join))
def test_any_text_is_a_unit_or_rejected(text: str) -> None:
    with suppress(Rejected):
        assert read_unit(text).factor.is_positive
