"""The names that scripts import from `derive.given`: every kind of given, and `require`."""

from __future__ import annotations

from derive import given
from derive.algebra.kinds import ANNOTATIONS, asked_by_annotation
from derive.course.requirement import require


def test_every_kind_of_given_can_be_imported_by_its_name() -> None:
    assert {name: asked_by_annotation(getattr(given, name)) for name in ANNOTATIONS} == ANNOTATIONS
    assert given.require is require
