"""A page that also contains the additional lines of a more detailed page, folded until the reader opens them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from derive.page.chain_lines import ChainLine, Equations
from derive.page.cross_references import each_number_once
from derive.page.numbering import Number
from derive.page.tree import Block, Display, Document, Folded, Paragraph, PartPage

Sentence = tuple[Block, ...]


def with_details(document: Document, full: Document) -> Document:
    """Return the page with the additional lines of `full`, a page of the same problem with the same equation
    numbers."""
    lines = {group.key: group.lines for part in document.parts for group in groups_in(part.blocks)}
    numbers = {**full.numbers, **document.numbers}
    merged = {part.label: _merged(part, document.numbers, lines) for part in full.parts}
    behind = {
        label: {key: tuple(_naming_once(block, numbers) for block in blocks) for key, blocks in each.items()}
        for label, each in merged.items()
    }
    parts = tuple(
        replace(part, blocks=_placed(part.blocks, behind[part.label])) if part.shown else part
        for part in document.parts
    )
    return replace(document, parts=parts, numbers=numbers)


def _merged(
    full: PartPage, numbers: Mapping[str, Number], lines: Mapping[str, Sequence[ChainLine]]
) -> dict[str, tuple[Block, ...]]:
    """Return the blocks to fold after each step, by the key of the step. Blocks before the first step have an empty
    key."""
    found: dict[str, list[Block]] = {}
    at = ""
    for sentence in sentences(full.blocks):
        displays = [block for block in sentence if isinstance(block, Display)]
        keys = [group.key for display in displays for group in display.groups]
        if displays and not set(keys) & set(numbers):
            found.setdefault(at, []).extend(sentence)
            continue
        for display in displays:
            at = next((group.key for group in reversed(display.groups) if group.key in lines), at)
            more = tuple(
                group
                for group in display.groups
                if group.key not in numbers or _has_more(group.lines, lines.get(group.key, ()))
            )
            if more:
                found.setdefault(at, []).append(replace(display, groups=more, end="."))
    return {key: tuple(blocks) for key, blocks in found.items()}


def _naming_once(block: Block, numbers: Mapping[str, Number]) -> Block:
    """Keep only one of several adjacent references to the same number."""
    if isinstance(block, Paragraph):
        return Paragraph(each_number_once(block.nodes, numbers))
    if not isinstance(block, Display):
        return block
    groups = (
        replace(group, lines=tuple(replace(l, reason=each_number_once(l.reason, numbers)) for l in group.lines))
        for group in block.groups
    )
    return replace(block, groups=tuple(groups))


def _has_more(full: Sequence[ChainLine], shown: Sequence[ChainLine]) -> bool:
    return bool(shown) and len(full) > len(shown)


def _placed(blocks: Sequence[Block], folded: Mapping[str, tuple[Block, ...]]) -> tuple[Block, ...]:
    """Return the blocks of a part; each sentence is followed by the blocks to fold after its steps."""
    found: list[Block] = [Folded(folded[""])] if "" in folded else []
    for sentence in sentences(blocks):
        found += sentence
        behind = [block for group in groups_in(sentence) for block in folded.get(group.key, ())]
        found += [Folded(tuple(behind))] if behind else []
    return tuple(found)


def groups_in(blocks: Sequence[Block]) -> list[Equations]:
    return [group for block in blocks if isinstance(block, Display) for group in block.groups]


def sentences(blocks: Sequence[Block]) -> list[Sentence]:
    """Group blocks into sentences: words before a display, the display, and words that continue the sentence."""
    found: list[Sentence] = []
    for block in blocks:
        last = found[-1][-1] if found else None
        to_its_display = isinstance(block, Display) and isinstance(last, Paragraph)
        goes_on = isinstance(block, Paragraph) and isinstance(last, Display) and last.end == ","
        if to_its_display or goes_on:
            found[-1] = (*found[-1], block)
        else:
            found.append((block,))
    return found
