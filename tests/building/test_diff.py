"""A problem beside its last build and beside a revision of git."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import derive.building.solution
from derive.building.diff import Diff, since_build, since_revision
from derive.errors import DeriveError, Misused, Rejected
from tests.building.repository import committed
from tests.courses import ROOT, course_in, kept, rendered_once

EDIT = {"Find the inertia tensor": "Compute the inertia tensor"}


@pytest.fixture(autouse=True)
def derived_once(monkeypatch: pytest.MonkeyPatch) -> None:
    real = derive.building.solution.rendered
    monkeypatch.setattr(
        derive.building.solution,
        "rendered",
        lambda root, name, detail, _, only: real(root, name, detail, kept(), only=only),
    )


def built(root: Path, **others: Any) -> Path:
    text = rendered_once(root, "hw9/block", only={"json"}).texts["json"]
    outputs = root / "build" / "hw9"
    outputs.mkdir(parents=True)
    (outputs / "block.json").write_text(json.dumps({**json.loads(text), **others}), encoding="utf-8")
    return root


def edited(root: Path, old: str, new: str) -> Path:
    file = root / "problems" / "hw9" / "block.yaml"
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")
    return root


def where(compared: Diff) -> list[tuple[str, str]]:
    return [(change.of, change.where) for change in compared.changes]


def refusal(root: Path, *how: Any) -> DeriveError:
    with pytest.raises(DeriveError) as caught:
        since_build(root, "hw9/block", None, 60) if not how else since_revision(root, "hw9/block", how[0], None, 60)
    return caught.value


def test_since_the_last_build(tmp_path: Path) -> None:
    root = built(course_in(tmp_path))
    assert since_build(root, "hw9/block", None, 60).changes == ()
    edited(root, *next(iter(EDIT.items())))
    found = since_build(root, "hw9/block", None, 60)
    assert (found.since, where(found)) == ("the last build", [("sentence", "part a, question")])


def test_the_detail_is_that_of_the_build(tmp_path: Path) -> None:
    root = built(course_in(tmp_path))
    assert since_build(root, "hw9/block", "standard", 60).changes == ()
    with pytest.raises(Misused) as caught:
        since_build(root, "hw9/block", "full", 60)
    assert caught.value.complaints[0].code == "other-detail"


def test_what_was_never_built_is_said_with_the_mend(tmp_path: Path) -> None:
    (complaint,) = refusal(course_in(tmp_path)).complaints
    assert complaint.code == "not-built"
    assert "`derive build hw9/block`" in (complaint.help or "")


@pytest.mark.parametrize("left", ["{", "[]", '{"problem": "hw9/block", "steps": []}', "\ud800"])
def test_what_is_no_page_of_this_derive_is_said(tmp_path: Path, left: str) -> None:
    root = built(course_in(tmp_path))
    (root / "build" / "hw9" / "block.json").write_bytes(left.encode("utf-8", "surrogatepass"))
    assert refusal(root).complaints[0].code == "not-built"


def test_since_a_revision_without_any_build(tmp_path: Path) -> None:
    root = committed(course_in(tmp_path))
    assert since_revision(root, "hw9/block", "HEAD", None, 60).changes == ()
    edited(root, *next(iter(EDIT.items())))
    found = since_revision(root, "hw9/block", "HEAD", None, 60)
    assert (found.since, where(found)) == ("`HEAD`", [("sentence", "part a, question")])
    assert not (root / "build").exists()


def test_a_problem_that_was_not_there_is_said(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "block.yaml"
    text = file.read_text(encoding="utf-8")
    file.unlink()
    committed(root)
    file.write_text(text, encoding="utf-8")
    assert refusal(root, "HEAD").complaints[0].message == "no problem was called `hw9/block` at `HEAD`"


def test_a_fault_of_then_is_told_as_one(tmp_path: Path) -> None:
    root = edited(course_in(tmp_path), "points: 10", "points: ten")
    committed(root)
    edited(root, "points: ten", "points: 10")
    error = refusal(root, "HEAD")
    assert isinstance(error, Rejected)
    assert error.complaints[0].notes[-1] == "the error is about the files at `HEAD`, read by the installed derive"
    edited(root, "points: 10", "points: ten")
    assert refusal(root, "HEAD").complaints[0].notes == ()


def test_templates_of_then_that_lack_words_give_way_to_those_of_today(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "templates" / "phrases" / "en").mkdir(parents=True)
    (root / "templates" / "phrases" / "en" / "page.yaml").write_text("rules: {}\n")
    (root / "templates" / "new").mkdir()  # so these are all templates of a checkout, not only some of a course
    (root / "templates" / "new" / "system.yaml").write_text("title: A system\n")
    committed(root)
    (root / "templates").rename(root / "old")
    (root / "templates").symlink_to(ROOT / "templates")
    found = since_revision(root, "hw9/block", "HEAD", None, 60)
    assert (found.changes, [warning.code for warning in found.warnings]) == ((), ["other-templates"])
