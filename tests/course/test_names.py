"""Names of sets and problems: words of commands, of files and of make at once."""

from __future__ import annotations

import pytest

from derive.cli.command_options import EVIDENCE
from derive.course.names import DOCUMENTS, NAME, EvidenceShown


@pytest.mark.parametrize("name", ["hw9", "9", "My-set_2", "a" * 64])
def test_letters_digits_and_two_signs_are_a_name(name: str) -> None:
    assert NAME.fullmatch(name)


@pytest.mark.parametrize("name", ["", "-o", "_x", "a" * 65, "my set", "a.b", "a/b", "..", "é", "a\n", "a$"])
def test_what_a_command_could_take_for_something_else_is_no_name(name: str) -> None:
    assert not NAME.fullmatch(name)


def test_the_documents_of_a_set_have_names_that_a_problem_could_have() -> None:
    assert all(NAME.fullmatch(name) for name in DOCUMENTS), "so they must be refused to problems"


def test_the_command_line_offers_all_ways_of_showing_evidence() -> None:
    assert tuple(EvidenceShown) == EVIDENCE
