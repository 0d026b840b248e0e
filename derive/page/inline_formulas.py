"""Formulas that need no display: a short quoted formula to which nothing refers can be in its sentence."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import pairwise
from typing import Any

from sympy import Add, Function, MatrixBase

from derive.page.clauses import continues_sentence
from derive.page.introduced_symbols import expressions_in, letters_in, letters_of, references_in
from derive.page.selection import is_short
from derive.page.tree import Block, Display, Document, Paragraph
from derive.steps.derivation import Derivation
from derive.steps.step import Step


def in_words(document: Document, derivation: Derivation, worded: Collection[str]) -> dict[str, bool]:
    """Return the keys of the quoted steps that need no display. The value of a key is true if the sentence must name
    the symbol of the step. This is so if the page uses the symbol elsewhere, or if the author wrote the sentence.

    worded  the keys of the steps that the problem rewords
    """
    referred = references_in((document.statement, document.strategy, document.parts, document.limits, document.note))
    steps = {step.key: step for step in derivation.steps}
    found: dict[str, bool] = {}
    for part in document.parts_shown:
        for display in _in_short_sentences(part.blocks):
            step = steps.get(display.groups[0].key)  # the decimals of an answer belong to no step of the derivation
            if step is not None and step.key not in referred and _is_plain(step):
                shown: list[Any] = [document.strategy, document.note, document.limits]
                shown += [block for each in document.parts_shown for block in each.blocks if block is not display]
                is_used = letters_of(step.symbol) & letters_in(expressions_in(shown))
                found[step.key] = step.key in worded or bool(is_used)
    return found


def _in_short_sentences(blocks: tuple[Block, ...]) -> Iterator[Display]:
    """Yield the displays between words and the end of a sentence, if they have one line without frame or reason."""
    for before, block in pairwise(blocks):
        if not (isinstance(before, Paragraph) and isinstance(block, Display) and block.end == "."):
            continue
        if len(block.groups) == 1 and len(block.groups[0].lines) == 1 and not block.groups[0].framed:
            line = block.groups[0].lines[0]
            if line.left is not None and not line.reason and not continues_sentence(before.nodes):
                yield block


def _is_plain(step: Step) -> bool:
    value = step.result
    return step.display.quoted and is_short(step) and not isinstance(value, MatrixBase) and not value.has(Add, Function)
