"""The numbers of equations: in order, and the same on pages of other detail."""

from __future__ import annotations

from itertools import pairwise

import pytest

from derive.page.numbering import Number, Numbering


def numbered(keys: str, like: Numbering | None = None) -> Numbering:
    numbers = Numbering(like)
    for key in keys:
        numbers.add(key)
    return numbers


def shown(numbers: Numbering) -> dict[str, str]:
    return {key: str(number) for key, number in numbers.items()}


def test_equations_are_numbered_one_after_the_other() -> None:
    assert shown(numbered("abc")) == {"a": "1", "b": "2", "c": "3"}


def test_what_another_page_has_keeps_its_number_and_what_stands_between_has_letters() -> None:
    assert shown(numbered("xaybbz", numbered("ab"))) | {"b": "2"} == {
        "x": "0a", "a": "1", "y": "1a", "b": "2", "z": "2b",
    }  # fmt: skip


def test_no_number_goes_back_where_the_order_is_another() -> None:
    numbers = numbered("ba", numbered("ab"))
    assert shown(numbers) == {"b": "2", "a": "2a"}
    assert numbers["a"] > numbers["b"]


@pytest.mark.parametrize(("behind", "shown"), [(0, "7"), (1, "7a"), (26, "7z"), (27, "7aa"), (28, "7ab"), (53, "7ba")])
def test_letters_go_on_after_z(behind: int, shown: str) -> None:
    assert str(Number(7, behind)) == shown


def test_numbers_are_in_the_order_of_the_page() -> None:
    numbers = [Number(0, 1), Number(1), Number(1, 1), Number(1, 2), Number(2)]
    assert all(a < b for a, b in pairwise(numbers))


def test_what_shares_a_number_leaves_its_own_to_the_next() -> None:
    numbers = numbered("ab")
    numbers.share("b", numbers["a"])
    numbers.add("c")
    assert shown(numbers) == {"a": "1", "b": "1", "c": "2"}
    numbers.share("a", numbers["c"])
    numbers.add("d")
    assert shown(numbers)["d"] == "3", "what had been numbered before has not moved"
