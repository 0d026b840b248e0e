"""The tables of commands: each has one meaning, and one that is refused is not read as well."""

from __future__ import annotations

from itertools import combinations

import pytest

from derive.course.latex import vocabulary
from derive.course.latex.vocabulary import ARGUMENTS, CLOSING, KNOWN, OPENING, REFUSED, RELATIONS, SIZES, SPACES

FONTS = ("ARROW_COMMANDS", "BOLD_COMMANDS", "FONTS", "WORDS")
KINDS = ("GREEK_COMMANDS", "LATEX_FUNCTIONS", "FRACTIONS", "DOTS", *FONTS, "SPACES", "SIZES")


@pytest.mark.parametrize(("one", "other"), list(combinations(KINDS, 2)))
def test_a_command_is_of_one_kind(one: str, other: str) -> None:
    assert set(getattr(vocabulary, one)) & set(getattr(vocabulary, other)) == set()


def test_what_is_refused_is_not_known_and_not_passed_over() -> None:
    assert set(REFUSED) & (KNOWN | SPACES | SIZES) == set()


def test_whatever_takes_arguments_or_relates_is_known() -> None:
    assert set(ARGUMENTS) <= KNOWN
    assert {mark[1:] for mark in RELATIONS if mark.startswith("\\")} <= KNOWN
    assert {spec.strip("[{") for spec in ARGUMENTS.values()} == {""}


def test_a_bracket_is_closed_by_one_that_can_close() -> None:
    assert set(OPENING.values()) <= set(CLOSING.values())
    assert set(RELATIONS.values()) == {"=", "<", ">", "<=", ">=", "!=", "~"}
