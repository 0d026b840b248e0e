"""The kinds of givens: found by annotation, told with their article, and none without a dimension."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr

from derive.algebra import kinds
from derive.algebra.dimensions import KINDS as DIMENSIONED
from derive.algebra.direction import Direction
from derive.algebra.kinds import DIRECTION, KINDS, POSITIVE, SIGNED, kind_of_annotation, plural


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_is_an_annotation_of_its_own_name(name: str) -> None:
    annotation = Direction if name == "Direction" else getattr(kinds, name)
    assert kind_of_annotation(annotation) is KINDS[name]
    assert kind_of_annotation(name) is kind_of_annotation(f" derive.given.{name} ") is KINDS[name]


@pytest.mark.parametrize("annotation", [Expr, int, None, "Masses", "", "mass"])
def test_anything_else_names_no_kind(annotation: Any) -> None:
    assert kind_of_annotation(annotation) is None


@pytest.mark.parametrize("kind", [kind for kind in KINDS.values() if kind is not DIRECTION], ids=lambda kind: kind.name)
def test_a_kind_has_a_dimension_and_letters_enough_for_what_it_holds(kind: kinds.Kind) -> None:
    assert kind.each in DIMENSIONED
    assert len(set(kind.letters)) >= kind.count
    assert len(set(kind.letters)) == len(kind.letters)


def test_what_may_be_signed_is_positive_otherwise() -> None:
    assert SIGNED < POSITIVE <= set(DIMENSIONED)


def test_a_message_says_how_many_of_what_are_wanted() -> None:
    assert KINDS["Mass"].wanted == "a mass"
    assert KINDS["MomentsOfInertia"].wanted == "3 moments of inertia"
    assert (plural("angular speed"), plural("moment of inertia")) == ("angular speeds", "moments of inertia")


def test_a_polar_angle_alone_is_within_bounds() -> None:
    bounded = [kind for kind in KINDS.values() if kind.bounds]
    assert [kind.name for kind in bounded] == ["PolarAngle"]
    assert bounded[0].bounds and bounded[0].bounds[0] == 0
