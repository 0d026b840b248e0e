"""Kinds: the unit, the dimension and the article of each, and the annotations by which scripts ask for them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from sympy import Expr

from derive.algebra import kinds
from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.direction import Direction
from derive.algebra.kinds import (
    ANNOTATIONS,
    DIRECTION,
    KINDS,
    Asked,
    Inhomogeneous,
    about_kind,
    asked_by_annotation,
    common,
    dimension_of_kind,
    kind_of_dimension,
    kind_with_article,
    named,
    plural,
    unit_of_dimension,
    unit_of_kind,
)

MASS, LENGTH, TIME = (dimension_of_kind(kind) for kind in ("mass", "length", "time"))
SI = {"kg": MASS, "m": LENGTH, "s": TIME, "N": MASS * LENGTH / TIME**2, "J": MASS * LENGTH**2 / TIME**2}
SI |= {"A": dimension_of_kind("current"), "C": dimension_of_kind("current") * TIME}
SI |= {"V": SI["J"] / SI["C"], "T": SI["N"] / (SI["A"] * LENGTH)}
SI |= {"ohm": SI["V"] / SI["A"], "F": SI["C"] / SI["V"], "Wb": SI["V"] * TIME, "H": SI["V"] * TIME / SI["A"]}
SI |= {"W": SI["J"] / TIME, "Hz": TIME**-1, "rad": NUMBER, "1": NUMBER}


def of_unit(text: str) -> Dimension:
    """`kg m^2/s` read by hand."""
    found, above = NUMBER, True
    for piece in text.replace("/", " / ").split():
        if piece == "/":
            above = False
            continue
        unit, _, n = piece.partition("^")
        found *= SI[unit] ** ((int(n) if n else 1) * (1 if above else -1))
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_the_unit_of_a_kind_has_its_dimension(kind: str) -> None:
    assert of_unit(unit_of_kind(kind)) == dimension_of_kind(kind)
    assert kind_with_article(kind).endswith(f" {kind}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_unit_may_have_angles_where_only_they_tell_the_kind(kind: str) -> None:
    assert (0 in about_kind(kind).angles) == (kind != "angle")
    assert "rad" not in unit_of_kind(kind) or 1 in about_kind(kind).angles
    assert about_kind(None).angles == (0,)


@pytest.mark.parametrize(
    ("dimension", "unit"),
    [
        (NUMBER, ""),
        (LENGTH, "m"),
        (TIME**-1, "1/s"),
        (MASS * LENGTH**2 / TIME**2, "N m"),
        (MASS / TIME**2, "N/m"),
        (LENGTH**4 / TIME**4, "m^4/s^4"),
        (LENGTH ** Fraction(3, 2) / TIME**2, "m^(3/2)/s^2"),
    ],
)
def test_what_has_no_kind_is_in_a_product_of_units(dimension: Dimension, unit: str) -> None:
    assert unit_of_dimension(dimension) == unit


def test_of_two_kinds_of_one_dimension_the_first_names_it() -> None:
    assert kind_of_dimension(dimension_of_kind("torque")) == "energy"
    assert named(LENGTH) == "a length"
    assert named(LENGTH**5) == "a quantity of dimension L^5"


def test_terms_have_one_dimension_and_the_first_of_another_is_named() -> None:
    table: dict[str, Any] = {"a": LENGTH, "b": LENGTH, "0": None, "m": MASS}
    assert common("ab0", table.get) == LENGTH
    assert common("00", table.get) is None
    with pytest.raises(Inhomogeneous, match="`m` is a mass, but `a` is a length"):
        common("0abm", table.get)


@pytest.mark.parametrize("name", ANNOTATIONS)
def test_each_annotation_is_known_by_itself_and_by_its_name(name: str) -> None:
    annotation = Direction if name == "Direction" else getattr(kinds, name)
    assert asked_by_annotation(annotation) is ANNOTATIONS[name]
    assert asked_by_annotation(name) is asked_by_annotation(f" derive.given.{name} ") is ANNOTATIONS[name]


@pytest.mark.parametrize("annotation", [Expr, int, None, "Masses", "", "mass"])
def test_anything_else_asks_for_no_kind(annotation: Any) -> None:
    assert asked_by_annotation(annotation) is None


@pytest.mark.parametrize("asked", [asked for asked in ANNOTATIONS.values() if asked is not DIRECTION])
def test_what_is_asked_for_is_of_a_kind_and_has_letters_enough(asked: Asked) -> None:
    assert asked.each in KINDS
    assert len(set(asked.letters)) >= asked.count
    assert len(set(asked.letters)) == len(asked.letters)


def test_what_may_be_signed_is_positive_otherwise() -> None:
    assert {name for name, kind in KINDS.items() if kind.signed} == {"speed", "acceleration", "angular speed"}
    assert all(kind.positive for kind in KINDS.values() if kind.signed)
    assert not about_kind("direction").positive


def test_several_of_a_kind_have_a_plural() -> None:
    assert (plural("angular speed"), plural("moment of inertia")) == ("angular speeds", "moments of inertia")
    assert (plural("velocity"), plural("mass")) == ("velocities", "masses")


def test_a_polar_angle_alone_is_within_bounds() -> None:
    assert {name: asked.bounds for name, asked in ANNOTATIONS.items() if asked.bounds} == {"PolarAngle": (0, 180)}
