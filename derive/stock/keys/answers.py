"""The answers that parts ask for by name, of those that a description has."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from derive.course.stock import each
from derive.course.yaml_tree import Word
from derive.stock.answering.by_name import ByName


def answered(asked: Sequence[Word], answers: ByName) -> dict[str, object]:
    """Each answer that a part asks for; what is refused is refused where it is asked for, and all of it."""
    return dict(each([partial(_answer, name, answers) for name in asked]))


def _answer(name: Word, answers: ByName) -> tuple[str, object]:
    return str(name), answers.made(name)
