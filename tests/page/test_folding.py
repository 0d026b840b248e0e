"""Tests of the additional lines of a more detailed page, which are folded."""

from __future__ import annotations

import pytest

from derive.page.document import document_of
from derive.page.folding import sentences, with_details
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Folded
from derive.page.wording import phrases
from derive.steps.level import Level
from tests.courses import PINNED, ROOT, solved_once


def pages(tmp_path_factory: pytest.TempPathFactory, name: str) -> tuple[Document, Document]:
    from tests.courses import course_in

    problem, solved = solved_once(course_in(tmp_path_factory.mktemp(name), problem=name), f"hw9/{name}")
    known = problem, solved.derivation, solved.values, phrases(templates_of(ROOT))
    standard, _ = document_of(*known, Level.STANDARD)
    full, _ = document_of(*known, Level.FULL, like=standard)
    return standard, full


@pytest.fixture(scope="module", params=["block", "cone", "slab"])
def both(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Document, Document]:
    return pages(tmp_path_factory, request.param)


def keys_of(blocks: object) -> list[str]:
    found: list[str] = []
    for block in blocks if isinstance(blocks, tuple) else ():
        found += [group.key for group in block.groups] if isinstance(block, Display) else []
        found += keys_of(block.blocks) if isinstance(block, Folded) else []
    return found


def test_every_step_of_the_full_page_is_there_once_folded_or_open(both: tuple[Document, Document]) -> None:
    standard, full = both
    whole = with_details(standard, full)
    for part, of_full in zip(whole.parts, full.parts, strict=True):
        if part.shown:
            assert set(keys_of(of_full.blocks)) <= set(keys_of(part.blocks)) | set(standard.numbers)


def test_what_is_open_is_the_page_as_it_was(both: tuple[Document, Document]) -> None:
    standard, full = both
    for part, before in zip(with_details(standard, full).parts, standard.parts, strict=True):
        assert tuple(block for block in part.blocks if not isinstance(block, Folded)) == before.blocks


def test_the_numbers_of_the_page_are_those_of_its_equations_at_every_level(both: tuple[Document, Document]) -> None:
    standard, full = both
    for key in keys_of(tuple(block for part in standard.parts for block in part.blocks)):
        assert full.numbers[key] == standard.numbers[key]


def test_what_is_folded_says_more_than_what_is_open(both: tuple[Document, Document]) -> None:
    standard, full = both
    displays = [block for part in standard.parts for block in part.blocks if isinstance(block, Display)]
    shown = {group.key: group.lines for display in displays for group in display.groups}
    folded = [b for part in with_details(standard, full).parts for b in part.blocks if isinstance(b, Folded)]
    assert folded
    for block in folded:
        for display in block.blocks:
            for group in display.groups if isinstance(display, Display) else ():
                assert len(group.lines) > len(shown.get(group.key, ()))


def test_no_sentence_is_parted_from_its_display(both: tuple[Document, Document]) -> None:
    whole = with_details(*both)
    for part in whole.parts:
        for sentence in sentences(part.blocks):
            assert not any(isinstance(block, Folded) for block in sentence[:-1])


def test_the_pinned_problems_are_those_of_the_repository() -> None:
    assert (PINNED / "cone.yaml").is_file()
