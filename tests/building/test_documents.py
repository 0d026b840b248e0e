"""Which documents a set has: its own, and those that were asked for once and are still there."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.documents import named_documents, still_there, with_asked
from derive.building.manifest import Manifest
from derive.course.problem_set import ProblemSet
from derive.errors import Misused

OWN = (("solutions", "hw1"), ("problems", "problems"))


def heading(*documents: tuple[str, str]) -> ProblemSet:
    return ProblemSet("hw1", "", "", (), ("problems/hw1/set.yaml",), documents=documents or OWN)


def test_a_document_that_is_asked_for_has_its_own_name_unless_the_set_gives_it_one() -> None:
    assert with_asked(OWN, ["solutions", "key"]) == [["solutions", "hw1"], ["problems", "problems"], ["key", "key"]]


def test_what_was_asked_for_is_kept_while_its_pdf_is_there(tmp_path: Path) -> None:
    record = Manifest(tmp_path)
    assert named_documents(heading(), record, ["key"])[-1] == ["key", "key"]
    assert record.asked == ["key"]
    (tmp_path / "key.pdf").touch()
    assert still_there(record.documents, record, []) == record.documents
    assert named_documents(heading(), record, [])[-1] == ["key", "key"]
    (tmp_path / "key.pdf").unlink()
    assert still_there(record.documents, record, []) != record.documents
    assert named_documents(heading(), record, []) == record.documents == [*map(list, OWN)]
    assert record.asked == []


def test_without_a_record_a_pdf_that_is_there_counts_as_requested(tmp_path: Path) -> None:
    (tmp_path / "key.pdf").touch()
    record = Manifest(tmp_path)
    assert named_documents(heading(), record, [])[-1] == ["key", "key"] and record.asked == ["key"]
    own = (("solutions", "key"),)
    assert named_documents(heading(*own), Manifest(tmp_path), []) == [["solutions", "key"]]


def test_a_document_that_the_set_names_later_is_its_own_from_then_on(tmp_path: Path) -> None:
    record = Manifest(tmp_path, asked=["key"])
    assert named_documents(heading(("key", "key")), record, []) == [["key", "key"]]
    assert record.asked == []


def test_two_documents_of_one_name_are_refused(tmp_path: Path) -> None:
    with pytest.raises(Misused, match="two documents of `hw1` would be called `key`"):
        named_documents(heading(("solutions", "key")), Manifest(tmp_path), ["key"])
