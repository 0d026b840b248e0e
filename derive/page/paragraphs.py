"""Short paragraphs: a remark of one or two lines is joined with the paragraph directly after it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from derive.page.clauses import continues_sentence
from derive.page.tree import Block, Paragraph
from derive.page.wording import Inline, Text, ToldOnce

SHORT = 200  # a remark with at most this number of characters is joined with the next paragraph
FORMULA = 10  # a formula or a reference counts as this number of characters


def without_short_paragraphs(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Return all blocks, with short paragraphs joined to the paragraph directly after them. A theorem stays apart."""
    found: list[Block] = []
    for block in blocks:
        last = found[-1] if found else None
        if isinstance(block, Paragraph) and isinstance(last, Paragraph) and _may_be_joined(last, block):
            found[-1] = replace(last, nodes=(*last.nodes, Text(" "), *block.nodes))
        else:
            found.append(block)
    return tuple(found)


def _may_be_joined(first: Paragraph, second: Paragraph) -> bool:
    theorems = any(isinstance(node, ToldOnce) for node in (*first.nodes, *second.nodes))
    length = sum(len(node.text) if isinstance(node, Text) else FORMULA for node in first.nodes)
    return not theorems and length <= SHORT and _ends_a_sentence(first.nodes) and not continues_sentence(first.nodes)


def _ends_a_sentence(nodes: Sequence[Inline]) -> bool:
    last = nodes[-1]
    return isinstance(last, Text) and last.text.rstrip().endswith((".", "?"))
