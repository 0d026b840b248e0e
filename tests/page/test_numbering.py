"""The equations of a page have consecutive numbers, which are the same on pages of other levels of detail."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest

from derive.page.numbering import Number, Numbering
from tests.courses import course_in, rendered_once


def numbered(keys: str, like: Numbering | None = None) -> Numbering:
    numbers = Numbering(like)
    for key in keys:
        numbers.add(key)
    return numbers


def shown(numbers: Numbering) -> dict[str, str]:
    return {key: str(number) for key, number in numbers.items()}


def test_equations_are_numbered_one_after_the_other() -> None:
    assert shown(numbered("abc")) == {"a": "1", "b": "2", "c": "3"}


def test_a_number_that_is_given_up_for_another_is_free() -> None:
    numbers = numbered("ab")
    numbers["b"] = numbers["a"]
    numbers.add("c")
    assert shown(numbers) == {"a": "1", "b": "1", "c": "2"}


def test_what_another_page_has_keeps_its_number_and_what_stands_between_has_letters() -> None:
    assert shown(numbered("xaybbz", numbered("ab"))) | {"b": "2"} == {
        "x": "0a", "a": "1", "y": "1a", "b": "2", "z": "2b",
    }  # fmt: skip


def test_no_number_goes_back_where_the_order_is_another() -> None:
    numbers = numbered("ba", numbered("ab"))
    assert shown(numbers) == {"b": "2", "a": "2a"}
    assert numbers["a"] > numbers["b"]


# For each format, the number next to an equation, and a reference to an equation.
NUMBER = r"\((\d+[a-z]*)\)"
MARKDOWN = rf"\\qquad\\text{{{NUMBER}}}", rf"(?<=[a-z,] ){NUMBER}"
WRITTEN = {
    "text": (rf"  {NUMBER}$", rf"(?<=[a-z,] ){NUMBER}"),
    "markdown": MARKDOWN,
    "notebook": MARKDOWN,
    "fragment": (r"\\label\{(.*?)\}", r"\\(?:eq)?ref\{(.*?)\}"),
    "html": (r' id="([^"]*)"', r' href="#([^"]*)"'),
}


@pytest.mark.parametrize("name", ["block", "cone", "euler", "slab", "top"])
def test_each_format_has_every_number_that_it_refers_to_and_leaves_none_out(name: str, tmp_path: Path) -> None:
    found = rendered_once(course_in(tmp_path, problem=name), f"hw9/{name}", only={*WRITTEN})
    for form, (beside, referring) in WRITTEN.items():
        text = found.html if form == "html" else found.texts[form].replace(r"\\", "\\")  # JSON doubles each backslash
        shown = re.findall(beside, text, re.MULTILINE)
        referred = re.findall(referring, re.sub(beside, "", text, flags=re.MULTILINE), re.MULTILINE)
        assert referred and {*referred} <= {*shown}, form
        if NUMBER in beside:
            assert shown == [str(n + 1) for n in range(len(shown))], form


@pytest.mark.parametrize(("behind", "shown"), [(0, "7"), (1, "7a"), (26, "7z"), (27, "7aa"), (28, "7ab"), (53, "7ba")])
def test_letters_go_on_after_z(behind: int, shown: str) -> None:
    assert str(Number(7, behind)) == shown


def test_numbers_are_in_the_order_of_the_page() -> None:
    numbers = [Number(0, 1), Number(1), Number(1, 1), Number(1, 2), Number(2)]
    assert all(a < b for a, b in pairwise(numbers))
