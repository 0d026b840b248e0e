"""A set beside its last build and beside a revision of git: its points, its problems, and each of them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import derive.building.set_diff
from derive.building.changes import Change
from derive.building.diff import Diff
from derive.building.manifest import Manifest
from derive.building.set_diff import SetDiff, set_since_build, set_since_revision
from derive.errors import DeriveError, Misused
from tests.building.repository import committed

PROBLEM = """\
title: The problem {name}
solve: system
points: {points}
statement: It falls.
parts:
- {{ask: How fast does it fall., answer: acceleration, points: {points}}}
"""
OTHER = Diff("then", (Change("answer", "acceleration", "g", "2 g"),))


@pytest.fixture(autouse=True)
def derived(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("since_build", "since_revision"):

        def stand_in(root: Path, problem_id: str, *how: object, **more: object) -> Diff:
            return OTHER if problem_id == "hw1/two" else Diff("then", ())

        monkeypatch.setattr(derive.building.set_diff, name, stand_in)


def course(root: Path, **points: str) -> Path:
    folder = root / "problems" / "hw1"
    folder.mkdir(parents=True, exist_ok=True)
    listed = ", ".join(points)
    (folder / "set.yaml").write_text(f"course: C\ntitle: T\nproblems: [{listed}]\n", encoding="utf-8")
    for name, worth in points.items():
        (folder / f"{name}.yaml").write_text(PROBLEM.format(name=name, points=worth), encoding="utf-8")
    return root


def built(root: Path, **points: float | None) -> Path:
    outputs = root / "build" / "hw1"
    outputs.mkdir(parents=True)
    for name, worth in points.items():
        page = {"detail": "", "statement": "", "limits_say": [], "note": "", "warnings": [], "points": worth}
        (outputs / f"{name}.json").write_text(json.dumps(page), encoding="utf-8")
    Manifest(outputs, problems=[*points]).save()
    return root


def own(compared: SetDiff) -> list[tuple[str, str, str, str]]:
    return [(each.of, each.where, each.before, each.after) for each in compared.own.changes]


def test_the_sum_is_told_and_each_problem_that_was_built(tmp_path: Path) -> None:
    root = course(built(tmp_path, one=3, two=2.5), one="4", two="2.5")
    found = set_since_build(root, "hw1", None, 60)
    assert own(found) == [("points", "the set", "5.5", "6.5")]
    assert found.changed and found.problems == {"hw1/one": Diff("then", ()), "hw1/two": OTHER}


def test_problems_that_come_and_go_and_change_places(tmp_path: Path) -> None:
    root = course(built(tmp_path, one=3, two=2, gone=1), new="1", two="2", one="3")
    assert own(set_since_build(root, "hw1", None, 60)) == [
        ("problem", "hw1/new", "", "1"),
        ("problem", "hw1/gone", "1", ""),
        ("order", "problems", "hw1/one hw1/two", "hw1/two hw1/one"),
    ]


def test_where_a_problem_had_no_points_there_was_no_sum(tmp_path: Path) -> None:
    root = course(built(tmp_path, one=None), one="3")
    assert own(set_since_build(root, "hw1", None, 60)) == [("points", "the set", "no points", "3")]


def test_what_is_as_it_was_has_not_changed(tmp_path: Path) -> None:
    assert not set_since_build(course(built(tmp_path, one=3), one="3"), "hw1", None, 60).changed


def test_since_a_revision_no_build_is_needed(tmp_path: Path) -> None:
    root = course(committed(course(tmp_path, one="3", two="2")), one="5", two="2")
    found = set_since_revision(root, "hw1", "HEAD", None, 60)
    assert (found.own.since, own(found)) == ("`HEAD`", [("points", "the set", "5", "7")])
    assert found.problems["hw1/two"] == OTHER


def test_a_set_that_was_not_built_or_has_a_fault_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Misused) as caught:
        set_since_build(course(tmp_path, one="3"), "hw1", None, 60)
    assert caught.value.complaints[0].code == "not-built"
    with pytest.raises(Misused, match="did you mean `hw1`"):
        set_since_build(tmp_path, "hw2", None, 60)
    with pytest.raises(DeriveError, match="`points` must be a number from 0 to"):
        set_since_build(course(built(tmp_path, one=3), one="three"), "hw1", None, 60)
