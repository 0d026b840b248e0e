"""Tests of the page as a tree: numbered equations, shown steps, their words, and drawings."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from derive.algebra.equality import Grade
from derive.building.derivations import Solved
from derive.course.problem import Problem, load_problem
from derive.errors import Complaint
from derive.page.chain_lines import Equations
from derive.page.document import document_of
from derive.page.numbering import Number
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Illustration, Paragraph
from derive.page.wording import Math, Text, phrases
from derive.steps.step import Level
from tests.courses import ROOT, course_in, solved_once

WORDS = phrases(templates_of(ROOT))
Block = tuple[Problem, Solved]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Block:
    return solved_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block")


def page(block: Block, level: Level = Level.STANDARD, **changed: object) -> Document:
    document, faults = written(block, level, **changed)
    assert faults == []
    return document


def written(block: Block, level: Level = Level.STANDARD, **changed: object) -> tuple[Document, list[Complaint]]:
    problem, solved = block
    problem = replace(problem, **changed)  # type: ignore[arg-type]
    return document_of(problem, solved.derivation, solved.values, WORDS, level, drawings=solved.drawings)


def in_other_words(block: Block, folder: Path, added: str) -> Block:
    return load_problem(course_in(folder, {"parts:\n": f"{added}\nparts:\n"}), "hw9/block"), block[1]


def groups(document: Document) -> list[Equations]:
    displays = [each for part in document.parts for each in part.blocks if isinstance(each, Display)]
    return [group for display in displays for group in display.groups]


def lines(document: Document) -> dict[str, int]:
    return {group.key: len(group.lines) for group in groups(document)}


def test_equations_are_numbered_in_the_order_of_the_page(block: Block) -> None:
    document = page(block)
    assert [group.number for group in groups(document)] == [Number(n + 1) for n in range(len(document.numbers))]
    assert {group.key: group.number for group in groups(document)} == document.numbers


def test_a_hidden_step_takes_no_number(block: Block) -> None:
    shown = page(block, Level.FULL).numbers
    hidden = page(block, Level.FULL, show={"density": "hidden"}).numbers
    assert shown["density"] == Number(1)
    assert hidden == {key: Number(number.whole - 1) for key, number in shown.items() if key != "density"}


def framed(document: Document) -> dict[str, int]:
    return {group.key: group.framed for group in groups(document) if group.framed}


def test_what_a_part_asks_for_is_framed_where_it_is_reached_with_its_decimals(block: Block) -> None:
    asked = [key for part in block[0].parts for key in part.answers]
    found = framed(page(block))
    assert list(found) == asked
    assert {key for key, count in found.items() if count == 2} == {"cosine", "angle_between"}


def test_what_a_part_asks_for_stands_on_the_page_though_it_be_hidden(block: Block) -> None:
    shown, hidden = page(block), page(block, show={"torque": "hidden"})
    assert hidden.numbers == shown.numbers and framed(hidden) == framed(shown)
    assert lines(hidden)["torque"] == 1


def test_more_detail_has_more_lines_and_the_same_results(block: Block) -> None:
    pages = [page(block, level) for level in (Level.BRIEF, Level.STANDARD, Level.FULL)]
    for one, other in pairwise(pages):
        assert sum(lines(other).values()) > sum(lines(one).values())
        assert one.numbers.keys() <= other.numbers.keys()
        assert {group.key: group.lines[-1].right for group in groups(one) if group.framed} == {
            group.key: group.lines[-1].right for group in groups(other) if group.framed
        }


def test_a_step_may_be_shown_by_its_result_alone_or_in_full(block: Block) -> None:
    usual, full = lines(page(block)), lines(page(block, Level.FULL))
    changed = page(block, show={"torque": "result", "corner_tensor_xx": "full"})
    found = lines(changed)
    (torque,) = [group for group in groups(changed) if group.key == "torque"]
    assert [line.right for line in torque.lines] == [block[1].derivation.step("torque").chain[-1].expr]
    assert found["torque"] == 1 < usual["torque"]
    assert found["corner_tensor_xx"] == full["corner_tensor_xx"] > usual["corner_tensor_xx"]
    assert found["corner_tensor_yy"] == usual["corner_tensor_yy"]


def test_words_of_the_problem_stand_before_the_lines_unless_they_say_where(block: Block, tmp_path: Path) -> None:
    before = page(in_other_words(block, tmp_path / "one", "wording: {torque: Hold it.}"))
    around = page(in_other_words(block, tmp_path / "two", "wording: {torque: Hold <<chain>> with care.}"))
    for document, words, end in ((before, ["Hold it."], "."), (around, ["Hold ", " with care."], ",")):
        told = [
            node.text.rstrip() for part in document.parts for each in part.blocks if isinstance(each, Paragraph)
            for node in each.nodes if isinstance(node, Text)
        ]  # fmt: skip
        assert [text for text in told if text.strip() in [word.strip() for word in words]] != []
        (display,) = [
            each for part in document.parts for each in part.blocks
            if isinstance(each, Display) and each.groups[-1].key == "torque"
        ]  # fmt: skip
        assert display.end == end


def test_a_name_that_nothing_has_is_told_with_the_nearest_and_the_rest_is_written(block: Block, tmp_path: Path) -> None:
    document, faults = written(in_other_words(block, tmp_path, "note: By <<torqe>> and <<eq spim>>."))
    assert [(fault.code, fault.help) for fault in faults] == [
        ("undefined-name", "did you mean `torque`?"),
        ("undefined-name", "did you mean `spin`?"),
    ]
    assert document.numbers == page(block).numbers


def test_the_strategy_stands_before_the_parts_and_may_mention_what_comes(block: Block, tmp_path: Path) -> None:
    document = page(in_other_words(block, tmp_path, "strategy: Without <<torque>> the axle would wobble."))
    before, torque, after = document.strategy
    assert (before, after) == (Text("Without "), Text(" the axle would wobble."))
    assert isinstance(torque, Math)
    assert page(block).strategy == ()


def test_a_drawing_stands_behind_the_step_that_completes_it(block: Block, tmp_path: Path) -> None:
    problem, solved = block
    first, second, third, fourth = solved.derivation.parts
    one_part_less = replace(solved.derivation, parts=(first, second, (*third, *fourth), ()))
    blocks = page((problem, replace(solved, derivation=one_part_less))).parts[2].blocks
    (at,) = [i for i, each in enumerate(blocks) if isinstance(each, Illustration)]
    shown = [
        {group.key for each in some if isinstance(each, Display) for group in each.groups}
        for some in (blocks[:at], blocks[at:])
    ]
    assert "angle_between" in shown[0] and "torque" in shown[1]
    assert isinstance(page(block).parts[2].blocks[-1], Illustration), "at the end if it rests on the last step"
    root = course_in(tmp_path, {"  vectors:\n": "  vectors:\n    at: d\n"})
    last = page((load_problem(root, "hw9/block"), solved)).parts[3].blocks[-1]
    assert isinstance(last, Illustration), "at the end if it rests on none of this part"


def test_a_display_is_as_sure_as_its_least_sure_step_and_ends_with_its_sentence() -> None:
    proved = Display((Equations("a", (), 1),), frozenset({Grade.PROVED}))
    sampled = Display((Equations("b", (), 2),), frozenset({Grade.SAMPLED}), ("by halves",), end=",")
    both = proved.with_more(sampled)
    assert (both.grade, sampled.with_more(proved).grade, proved.grade) == (Grade.SAMPLED, Grade.SAMPLED, Grade.PROVED)
    assert both.routes == ("by halves",)
    assert (both.stops, sampled.stops) == ((",", "."), (",",))


@pytest.mark.parametrize(("words", "is_joined"), [("and", True), ("and of the size", False)])
def test_lines_after_a_mere_and_join_the_lines_before_them(
    block: Block, tmp_path: Path, words: str, is_joined: bool
) -> None:
    added = f"wording: {{torque: Hold <<chain>>, magnitude: {words} <<chain>>}}"
    document = page(in_other_words(block, tmp_path, added))
    displays = [each for part in document.parts for each in part.blocks if isinstance(each, Display)]
    keys = [[group.key for group in display.groups] for display in displays]
    assert (keys[-1][-2:] == ["torque", "magnitude"]) is is_joined
