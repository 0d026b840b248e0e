"""Sentences that refer to the figures of a part: "Figure 2 shows the forces."

A figure that no text of the author mentions is mentioned directly before it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

from derive.figures import marks as m
from derive.page.tree import Block, Illustration, Paragraph
from derive.page.wording import FigureRef, Inline, Math, Phrases, Text, filled, joined


def figures_mentioned(
    blocks: Sequence[Block], drawings: Mapping[str, m.Recorded], mentioned: Collection[str], words: Phrases
) -> tuple[Block, ...]:
    """Return the blocks of a part with a sentence before each figure that no text of the author mentions; figures of
    one sort that follow each other share a sentence.

    drawings    the drawings of the problem, by key
    mentioned   the keys of the drawings that a text of the author mentions
    """
    found: list[Block] = []
    for is_drawing, group in groupby(blocks, lambda block: isinstance(block, Illustration)):
        together = list(group)
        if not is_drawing:
            found += together
            continue
        shown = [each for each in together if isinstance(each, Illustration)]
        new = [each for each in shown if each.number is not None and each.key not in mentioned]
        for (sort, _), figures in groupby(new, lambda each: _sort(drawings[each.key])):
            _add(found, _sentence(sort, list(figures), drawings, words))
        found += shown
    return tuple(found)


def _add(blocks: list[Block], sentence: tuple[Inline, ...]) -> None:
    """Add a sentence to the last paragraph, if this paragraph ends a sentence, or as a new paragraph."""
    last = blocks[-1] if blocks else None
    end = last.nodes[-1] if isinstance(last, Paragraph) else None
    if isinstance(last, Paragraph) and type(end) is Text and end.text.rstrip().endswith("."):
        blocks[-1] = replace(last, nodes=(*last.nodes, Text(" "), *sentence))
    else:
        blocks.append(Paragraph(sentence))


def _sort(drawing: m.Recorded) -> tuple[str, str]:
    """Return the name of the phrase for a drawing, and the key of the drawing if it needs a sentence of its own, else
    "". Drawings with the same result can share a sentence."""
    if isinstance(drawing, m.Drawing):
        if drawing.forces_on is not None:
            return "shows_forces", ""
        return ("shows_modes", "") if drawing.mode is not None else ("shows", "")
    if drawing.diagram is not None:
        return "shows_diagram", drawing.key
    if drawing.across is not None:
        return ("shows_path" if drawing.kind == "length" and drawing.across.unit == "m" else "shows"), ""
    return ("shows", "") if drawing.levels is not None else ("shows_function", drawing.key)


def _sentence(
    sort: str, figures: Sequence[Illustration], drawings: Mapping[str, m.Recorded], words: Phrases
) -> tuple[Inline, ...]:
    last, label = words.labels["and"], words.labels["figure"]
    numbers = [(each.number, each.key) for each in figures if each.number is not None]
    named = [(FigureRef(f"{label}\u00a0{number}", key, number),) for number, key in numbers]
    own: dict[str, Any] = {"figures": joined(named, last), "count": len(named)}
    plot = drawings[figures[0].key]
    if isinstance(plot, m.Plot):
        own["quantity"] = joined([(Math(each),) for each in plot.labels], last)
        own["variable"] = (Math(plot.named_across),)
    return filled(words.drawings[sort], own)
