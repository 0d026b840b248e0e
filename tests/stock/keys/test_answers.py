"""Answers by name."""

from __future__ import annotations

import pytest

from derive.course.yaml_tree import Word
from derive.errors import Place, Rejected
from derive.stock.answering.by_name import ByName
from derive.stock.keys.answers import answered


def word(name: str, line: int) -> Word:
    return Word.at(name, Place("p.yaml", line))


def test_each_answer_is_under_its_name() -> None:
    assert answered([word("mass", 1)], ByName({"mass": lambda: 3, "speed": lambda: 1 / 0}, "a body")) == {"mass": 3}


def test_all_names_that_are_no_answers_are_told() -> None:
    with pytest.raises(Rejected) as refused:
        answered([word("mas", 1), word("w", 2)], ByName({"mass": lambda: 3}, "a body"))
    assert [(c.message, c.help, c.place and c.place.line) for c in refused.value.complaints] == [
        ("a body has no answer called `mas`", "did you mean `mass`?", 1),
        ("a body has no answer called `w`", "one may ask for mass", 2),
    ]
