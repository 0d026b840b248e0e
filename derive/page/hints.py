"""A ladder of hints, made of a solution: what to compute next, then its law, then the law with values put in.

What a part asks for is on no rung, and neither is what follows from it: a hint ends where the answer would begin.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import Any

from sympy import Basic, MatrixBase, Symbol

from derive.algebra.expressions import BLANK, explicit
from derive.page.chain_lines import ChainLine, Equations
from derive.page.folding import sentences
from derive.page.tree import Block, Display, Document, Folded, Paragraph, PartPage
from derive.page.wording import Inline, Math, Phrases
from derive.steps.step import Step


def with_hints(document: Document, answered: Iterable[Step], words: Phrases) -> Document:
    """The page with its hints in place of what is derived; `answered` are the steps that answer its parts."""
    answers = [_of(step.result) for step in answered]
    parts = tuple(_with_rungs(part, answers, words) for part in document.parts_shown)
    return replace(document, parts=parts, limits=None, note=(), closing=())


def _with_rungs(part: PartPage, answers: Sequence[Any], words: Phrases) -> PartPage:
    titles = words.labels["hints"]
    told = [sentence for sentence in sentences(part.blocks) if any(isinstance(block, Display) for block in sentence)]
    rungs = (
        ("first", [block for sentence in told for block in _what(sentence, answers)]),
        ("law", [block for sentence in told for block in _cut(sentence, answers, 1, 1)]),
        ("put_in", [block for sentence in told for block in _cut(sentence, answers, 2, None)]),
    )
    found = tuple(Folded(tuple(blocks), titles[name]) for name, blocks in rungs if blocks)
    return replace(part, blocks=found)


def _what(sentence: Sequence[Block], answers: Sequence[Any]) -> list[Block]:
    """The words that lead to a display, and what they lead to, as yet unknown."""
    before: list[Block] = []
    for block in sentence:
        if isinstance(block, Display):
            sought = tuple(wanted for group in block.groups if (wanted := _sought(group)))
            return [*before, *([replace(block, groups=sought, end="")] if sought else [])]
        if isinstance(block, Paragraph) and not _tells(block.nodes, answers):
            before.append(block)
    return before


def _sought(group: Equations) -> Equations | None:
    """T = ..., where the equation is one for a letter."""
    first = group.lines[0]
    if not isinstance(first.left, Symbol | MatrixBase | Basic) or first.relation != "equals":
        return None
    return replace(group, lines=(ChainLine(first.left, "equals", BLANK),), framed=0)


def _cut(sentence: Sequence[Block], answers: Sequence[Any], start: int, length: int | None) -> list[Block]:
    """Of the chains of a sentence the law, or what follows it, without their last lines and without any answer."""
    found: list[Block] = []
    for block in sentence:
        if isinstance(block, Display):
            groups = tuple(cut for group in block.groups if (cut := _part_of(group, answers, start, length)))
            found += [replace(block, groups=groups, end=".")] if groups else []
    return found


def _part_of(group: Equations, answers: Sequence[Any], start: int, length: int | None) -> Equations | None:
    lines = list(group.lines[:-1])
    told = next((i for i, line in enumerate(lines) if _of(line.right) in answers), len(lines))
    lines = lines[start - 1 : told] if length is None else lines[start - 1 : min(told, start - 1 + length)]
    if not lines:
        return None
    if lines[0].left is None:
        lines[0] = replace(lines[0], left=group.lines[0].left)
    return replace(group, lines=tuple(lines), framed=0)


def _tells(nodes: Sequence[Inline], answers: Collection[Any]) -> bool:
    """Whether the words themselves have an answer in them."""
    formulas = [node.expr for node in nodes if isinstance(node, Math) and not isinstance(node.expr, Symbol)]
    return any(_of(formula) in answers for formula in formulas)


def _of(value: Any) -> Any:
    """A value as it is compared: as one formula, however it is written."""
    return explicit(value) if isinstance(value, Basic | MatrixBase) else value
