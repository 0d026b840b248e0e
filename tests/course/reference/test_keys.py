"""The keys of a reference: what an editor is told of them is what is read."""

from __future__ import annotations

from derive.course.reference.keys import DocumentKeys, EntryKeys, GroupKeys, OwnKeys
from derive.course.schema import keys_of


def test_an_entry_says_where_what_and_what_there_is_to_say_of_it() -> None:
    assert {"part", "line", "answer", "latex", "states", "quote", "remark", "erratum"} <= keys_of(EntryKeys).keys()


def test_a_group_and_the_reference_of_a_problem_share_their_entries() -> None:
    assert keys_of(GroupKeys)["entries"].reader.schema == keys_of(OwnKeys)["entries"].reader.schema


def test_the_document_is_named_once() -> None:
    assert keys_of(DocumentKeys).keys() == {"document"}
    assert "document" not in keys_of(GroupKeys)
