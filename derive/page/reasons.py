"""Reasons and frames that a page leaves out because the reader does not need them.

A reason that only names equations, "from (2) and (3)", is left out if all these equations are in view. An equation is
in view if it is one of the two equations before the line, or if the paragraph before the display names it. The lines of
a step show a common reason once, at the last of these lines. The next step of the display does not repeat this reason.
A result that a part has framed is not framed again in this part.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from derive.page.chain_lines import ChainLine, Equations
from derive.page.numbering import Number
from derive.page.tree import Block, Display, Paragraph
from derive.page.wording import Inline, Ref, Text

JUST_BEFORE = 2  # the number of equations before a line that the reader still has in view


def without_known_reasons(blocks: Sequence[Block], numbers: Mapping[str, Number]) -> tuple[Block, ...]:
    """Return the blocks without the reasons that only name equations in view."""
    found: list[Block] = []
    for i, block in enumerate(blocks):
        before = blocks[i - 1] if i else None
        named = (
            {numbers[node.key] for node in before.nodes if isinstance(node, Ref) and node.key in numbers}
            if (isinstance(before, Paragraph))
            else set()
        )
        if isinstance(block, Display):
            groups = tuple(_without_known_reasons(group, named, numbers) for group in block.groups)
            block = replace(block, groups=_without_repeated_reasons(groups))
        found.append(block)
    return tuple(found)


def framed_once(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Return the blocks of a part without the frames of results that the part has framed before."""
    seen: set[Any] = set()
    found: list[Block] = []
    for block in blocks:
        if isinstance(block, Display):
            groups: list[Equations] = []
            for group in block.groups:
                result = _result(group)
                groups.append(replace(group, framed=0) if group.framed and result in seen else group)
                seen |= {result} if group.framed else set()
            block = replace(block, groups=tuple(groups))
        found.append(block)
    return tuple(found)


def _result(group: Equations) -> tuple[Any, ...]:
    """Return the left side, the relation and the right side of each framed line."""
    begun: Any = None
    sides: list[Any] = []
    for line in group.lines:
        begun = line.left if line.left is not None else begun
        sides.append((str(begun), line.relation, str(line.right)))
    return tuple(sides[len(sides) - group.framed :])


def _without_repeated_reasons(groups: Sequence[Equations]) -> tuple[Equations, ...]:
    found: list[Equations] = []
    said: tuple[Inline, ...] = ()
    for group in groups:
        lines = list(group.lines)
        for i, line in enumerate(lines):
            if line.reason == said or any(line.reason == later.reason for later in lines[i + 1 :]):
                lines[i] = replace(line, reason=())
        said = group.lines[-1].reason
        found.append(replace(group, lines=tuple(lines)))
    return tuple(found)


def _without_known_reasons(group: Equations, named: set[Number], numbers: Mapping[str, Number]) -> Equations:
    in_view = named | {number for number in numbers.values() if 0 < group.number.whole - number.whole <= JUST_BEFORE}
    return replace(group, lines=tuple(_without_known_reason(line, in_view, numbers) for line in group.lines))


def _without_known_reason(line: ChainLine, in_view: set[Number], numbers: Mapping[str, Number]) -> ChainLine:
    refs = [node for node in line.reason if isinstance(node, Ref)]
    known = refs and all(ref.key in numbers and numbers[ref.key] in in_view for ref in refs)
    return replace(line, reason=()) if known and all(map(_only_names, line.reason)) else line


def _only_names(node: Inline) -> bool:
    """Return whether a part of a reason is the number of an equation, or a single word such as `from` or `and`."""
    return isinstance(node, Ref) or (isinstance(node, Text) and len(node.text.split()) <= 1)
