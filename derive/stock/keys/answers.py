"""The answers that parts ask for by name, of those that a description has."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from derive.course.stock import each, told_at
from derive.course.yaml_tree import Word
from derive.errors import did_you_mean, rejected


def answered(asked: Sequence[Word], asks: Mapping[str, Callable[[], object]], what: str) -> dict[str, object]:
    """Each answer that a part asks for; what is refused is refused where it is asked for, and all of it."""
    return dict(each([partial(_answer, name, asks, what) for name in asked]))


def _answer(name: Word, asks: Mapping[str, Callable[[], object]], what: str) -> tuple[str, object]:
    if name not in asks:
        help_line = did_you_mean(name, asks) or f"one may ask for {', '.join(asks)}"
        rejected("no-such-answer", f"{what} has no answer called `{name}`", name.place, help_line)
    with told_at(name.place):
        return str(name), asks[name]()
