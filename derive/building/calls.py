"""Recorded calls of verbs, the functions that derive steps. All calls of a problem are stored as one value.

The value also contains some earlier calls, in case an edit is undone.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property

from derive.building.cache import NO_CACHE, Cache, digest, engine_digest
from derive.steps.memory import Memory

BETWEEN = "\n\n"  # separates calls: their texts contain no empty line
ROOM = 2 * 1024 * 1024  # the largest total length of earlier calls, in characters


@dataclass
class Calls:
    """The texts of calls by their keys: the calls stored by earlier builds, and the calls used by this build."""

    cache: Cache = NO_CACHE
    key: str = ""
    used: dict[str, str] = field(default_factory=dict)
    has_more: bool = False

    @cached_property
    def earlier(self) -> dict[str, str]:
        blocks = (self.cache.get(self.key) or b"").decode().split(BETWEEN)
        return {key: text for key, _, text in (block.partition("\n") for block in blocks if block)}

    def get(self, key: str) -> str | None:
        text = self.used.get(key) or self.earlier.get(key)
        if text is not None:
            self.used[key] = text
        return text

    def keep(self, key: str, text: str) -> None:
        self.used[key] = text
        self.has_more = True

    def save(self) -> None:
        if not self.has_more:
            return
        kept, room = dict(self.used), ROOM
        for key, text in self.earlier.items():
            room -= 0 if key in kept else len(text)
            if room < 0:
                break
            kept.setdefault(key, text)
        self.cache.keep(self.key, BETWEEN.join(f"{key}\n{text}" for key, text in kept.items()).encode())


@contextmanager
def calls_of(problem_id: str, cache: Cache) -> Iterator[Memory | None]:
    """Provide the recorded calls of a problem, and save them after the `with` block. Without a cache, provide None."""
    if cache.folder is None:
        yield None
        return
    calls = Calls(cache, digest("calls", problem_id, engine_digest("sympy", "mpmath")))
    try:
        yield Memory(calls)
    finally:
        calls.save()
