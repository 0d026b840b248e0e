"""What scripts import of their givens: every kind there is, and nothing else."""

from __future__ import annotations

from derive import given
from derive.algebra.kinds import KINDS, kind_of_annotation
from derive.course.requirement import require


def test_every_kind_of_given_can_be_imported_by_its_name() -> None:
    named = {name: kind_of_annotation(getattr(given, name)) for name in given.__all__ if name != "require"}
    assert named == {name: KINDS[name] for name in named}
    assert set(KINDS) - set(named) <= {"Direction"}
    assert given.require is require
