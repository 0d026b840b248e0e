"""The JSON has the texts of a page in order, with the keys of the equations to which they refer."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from derive.page.numbering import Number
from derive.page.tree import Folded, Paragraph
from derive.page.wording import Ref, Text
from derive.render.notation.notation import Notation
from derive.render.printing.text_blocks import Said
from tests.courses import course_in, rendered_once


class Page:
    numbers = {"spin": Number(7), "torque": Number(12)}  # noqa: RUF012


SAID = Said(Page(), Notation({}))  # type: ignore[arg-type]


def test_a_sentence_has_the_numbers_of_its_page_and_their_keys() -> None:
    told = SAID.sentence((Text("By "), Ref("spin"), Text(" it is small, so is "), Ref("torque")))
    assert told == {"text": "By (7) it is small, so is (12)", "refers_to": ["spin", "torque"]}


def test_what_is_folded_stands_in_its_place() -> None:
    blocks = (Paragraph((Text("One."),)), Folded((Paragraph((Text("Two."),)),)), Paragraph((Text("Three."),)))
    assert [block["text"] for block in SAID.blocks(blocks)] == ["One.", "Two.", "Three."]


@pytest.fixture
def page(tmp_path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(rendered_once(course_in(tmp_path), "hw9/block", only={"json"}).texts["json"])
    return found


def test_the_json_has_all_that_the_text_says(page: dict[str, Any], tmp_path: Path) -> None:
    text = rendered_once(course_in(tmp_path / "again"), "hw9/block", only={"text"}).texts["text"]
    words = " ".join(text.split())
    says = [block["text"] for part in page["parts"] for block in part["says"] if "text" in block]
    asks = [part["ask"] for part in page["parts"]]
    for sentence in [page["title"], page["statement"], *asks, *says]:
        assert " ".join(sentence.split()) in words


def test_each_equation_has_the_key_of_its_step_and_its_number_on_the_page(page: dict[str, Any]) -> None:
    equations = [block for part in page["parts"] for block in part["says"] if "equation" in block]
    assert {block["equation"] for block in equations} <= {step["key"] for step in page["steps"]}
    numbers = [int(block["number"]) for block in equations]
    assert numbers == sorted(numbers)
    assert numbers[0] == 1


def test_an_answer_is_told_as_on_the_page(page: dict[str, Any]) -> None:
    assert page["answers"]["magnitude"]["text"] == "|τ⃗| = √42/28 M a² ω²"
