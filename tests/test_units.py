"""Units are exact."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Integer, Rational, pi

from derive.algebra.dimensions import Dimension
from derive.algebra.kinds import KINDS, dimension_of_kind, unit_of_dimension, unit_of_kind
from derive.errors import Rejected
from derive.units import UNIT_NAMES, misfit, read_unit


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


def refused(text: str, kind: str | None, dimension: Dimension | None = None) -> str | None:
    wrong = misfit(read_unit(text), kind, dimension or dimension_of_kind(kind or "number"))
    return wrong.code if wrong else None


@pytest.mark.parametrize(
    ("text", "kind", "code"),
    [
        ("rad/s", "angular speed", None),
        ("rpm", "angular speed", None),
        ("1/s", "angular speed", None),
        ("rpm^2", "squared angular speed", None),
        ("J", "energy", None),
        ("N m", "energy", None),
        ("N m", "torque", None),
        ("J s", "angular momentum", None),
        ("Hz", "frequency", None),
        ("Hz", "angular speed", "ambiguous-unit"),
        ("Hz/s", "angular acceleration", "ambiguous-unit"),
        ("deg", "number", "wrong-unit"),
        ("J", "torque", "wrong-unit"),
        ("kJ", "torque", "wrong-unit"),
        ("N m/rev", "energy", "wrong-unit"),
        ("cm/rev", "length", "wrong-unit"),
        ("kg deg", "mass", "wrong-unit"),
        ("m/m", "angle", "wrong-unit"),
        ("rev/s", "frequency", "wrong-unit"),
        ("rpm", "squared angular speed", "wrong-unit"),
    ],
)
def test_a_unit_measures_a_kind_only_with_as_many_angles(text: str, kind: str, code: str | None) -> None:
    assert refused(text, kind) == code


def test_the_unit_of_every_kind_measures_it() -> None:
    assert all(refused(unit_of_kind(kind), kind) is None for kind in KINDS if unit_of_kind(kind))


@pytest.mark.parametrize("text", ["rad/s", "rev/min", "Hz"])
def test_what_has_only_a_dimension_is_in_no_unit_that_needs_a_kind(text: str) -> None:
    assert refused(text, None, dimension_of_kind("frequency")) == "wrong-unit"
    assert refused("1/s", None, dimension_of_kind("frequency")) is None


@pytest.mark.parametrize(
    ("kind", "unit"),
    [("time", "s"), ("energy", "N m"), ("frequency", "1/s"), ("moment of inertia", "kg m^2"), ("number", "")],
)
def test_a_dimension_that_several_kinds_have_is_in_a_unit_that_is_right_of_each(kind: str, unit: str) -> None:
    assert unit_of_dimension(dimension_of_kind(kind)) == unit


def test_a_dimension_without_a_kind_has_a_unit_too() -> None:
    length, time, force = (dimension_of_kind(kind) for kind in ("length", "time", "force"))
    assert unit_of_dimension(length / time**3) == "m/s^3"
    assert unit_of_dimension(force / length**2) == "N/m^2"
    assert unit_of_dimension(force * length**3) == "N m^3"
    assert unit_of_dimension(length ** Fraction(1, 2) / time) == "m^(1/2)/s"
