"""A row that was copied from a similar row, with one index unchanged.

In `m_1 x'' = m_1 g - S_1` and `m_1 y'' = m_2 g - S_2` each letter of the first row corresponds to a letter of the
second row, but `m_1` corresponds to both `m_1` and `m_2`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import fields
from itertools import chain
from typing import Any

from derive.audit.claims import Claim
from derive.audit.slips import Edit
from derive.documents.facts import Identity
from derive.documents.source import Span
from derive.documents.syntax import Letter, Node

FEWEST_LETTERS = 4  # in each row


def unchanged_index(copy: Claim, original: Claim) -> Edit | None:
    """Return the letter of a row that has kept the index of a similar row, and the letter that is meant.

    None unless the rows differ only in letters, exactly one letter of the original corresponds to two letters, and
    another letter changes its index in the same way.
    """
    images: dict[Identity, list[Letter]] = defaultdict(list)
    for pair in chain(_pairs(original.left, copy.left), _pairs(original.right, copy.right)):
        if pair is None:
            return None
        images[pair[0].identity].append(pair[1])
    several = [each for each, found in images.items() if len({letter.identity for letter in found}) > 1]
    if len(images) < FEWEST_LETTERS or len(several) != 1:
        return None
    found = images.pop(several[0])
    kept = [each for each in found if each.identity == several[0]]
    meant = [each for each in found if each.identity != several[0]]
    if len(kept) != 1 or len({each.identity for each in meant}) != 1 or meant[0].identity in images:
        return None
    index = meant[0].sub
    if meant[0].base != kept[0].base or not index or not any(
        each.sub == index != identity[1] for identity, found in images.items() for each in found
    ):  # fmt: skip
        return None
    return Edit(meant[0], kept[0].span, kept[0].named(), meant[0].named(), "index", 1.0)


def _pairs(one: Any, other: Any) -> Iterator[tuple[Letter, Letter] | None]:
    """Yield the letters at the same places of two sides; None where the sides differ in something else."""
    if type(one) is not type(other):
        yield None
    elif isinstance(one, Letter):
        yield (one, other) if one.dots == other.dots else None
    elif isinstance(one, Node):
        for each in fields(one):
            yield from _pairs(getattr(one, each.name), getattr(other, each.name))
    elif isinstance(one, tuple):
        yield from () if len(one) == len(other) else (None,)
        for first, second in zip(one, other, strict=False):
            yield from _pairs(first, second)
    elif not isinstance(one, Span) and one != other:
        yield None
