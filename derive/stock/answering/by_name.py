"""Answers by their names, each derived when it is first asked for, for parts and for what is made of answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from derive.course.stock import told_at
from derive.course.yaml_tree import Word
from derive.errors import did_you_mean, rejected
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.step import Quantity


class ByName:
    """The answers of one description; what is made of answers is itself one.

    asks   every name that a part may ask by
    what   what the description is of: "a rotation"
    """

    def __init__(self, asks: Mapping[str, Callable[[], Any]], what: str):
        self.asks, self.what = asks, what
        self._known: dict[str, Any] = {}
        self._on_the_way: list[str] = []

    def made(self, name: Word) -> Any:
        """What that name yields, whatever it is."""
        if name not in self.asks:
            help_line = did_you_mean(name, self.asks) or f"one may ask for {', '.join(self.asks)}"
            rejected("no-such-answer", f"{self.what} has no answer called `{name}`", name.place, help_line)
        if name in self._on_the_way:
            rejected("circle", f"`{name}` is made of itself", name.place)
        if name not in self._known:
            self._on_the_way.append(str(name))
            try:
                with told_at(name.place):
                    self._known[str(name)] = self.asks[name]()
            finally:
                self._on_the_way.pop()
        return self._known[name]

    def named(self, name: Word) -> tuple[Quantity, ...]:
        """The steps of a name, or the one step of that key among those that answers have led to."""
        if name not in self.asks:
            there = with_ancestors([q for known in self._known.values() for q in returned_quantities(known)])
            if name in there:
                return (there[name],)
        return tuple(returned_quantities(self.made(name)))
