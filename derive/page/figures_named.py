"""Mentions of the numbered figures of a part, in the sentences near them: "It is unstable (Figure 2)."

A figure that no text of the author mentions is mentioned in parentheses at the end of a paragraph. A plot or a normal
mode after a formula has a sentence of its own: "Figure 2 shows x as a function of t." A figure of forces is mentioned
before the equations: "With the forces in Figure 2, the upward component is".
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

from derive.figures import marks as m
from derive.page.tree import Block, Display, Illustration, Paragraph
from derive.page.wording import FigureRef, Inline, Math, Phrases, Text, ToldOnce, filled, joined

STOPS = (".", ",", ":")


def figures_mentioned(
    blocks: Sequence[Block], drawings: Mapping[str, m.Recorded], mentioned: Collection[str], words: Phrases
) -> tuple[Block, ...]:
    """Return the blocks of a part in which numbered figures are mentioned, if there is a sentence for the mention.

    drawings    the drawings of the problem, by key
    mentioned   the keys of the drawings that a text of the author mentions
    """
    found: list[Block] = []
    waiting: list[Illustration] = []  # figures that the blocks after them will mention
    told: tuple[Inline, ...] = ()  # a sentence about the figures before, which begins the next paragraph
    groups = [list(group) for _, group in groupby(blocks, lambda block: isinstance(block, Illustration))]
    for together, following in zip(groups, [*groups[1:], []], strict=True):
        if not isinstance(together[0], Illustration):
            forces = [each for each in waiting if _shows_forces(drawings[each.key])]
            others = [each for each in waiting if each not in forces]
            together = _after_figures(together, others, words) if others else together
            found += _with_forces(together, forces, words) if forces else _after(told, together)
            waiting, told = [], ()
            continue
        shown = [each for each in together if isinstance(each, Illustration)]
        new = [each for each in shown if each.number is not None and each.key not in mentioned]
        show_forces = all(_shows_forces(drawings[each.key]) for each in new)
        is_before_equations = show_forces and _begins_a_sentence(following)
        ends_with_formula = bool(found) and isinstance(found[-1], Display)
        can_tell = ends_with_formula and (not following or _begins_a_sentence(following))
        if new and can_tell and (said := _shown([drawings[each.key] for each in new], new, words)):
            told = said if following else ()
            found += [] if following else [Paragraph(said)]
        elif new and not is_before_equations and (at := _sentence_before(found)) is not None:
            found[at] = _with_mention(found[at], new, words)
        else:
            waiting = new
        found += shown
    return tuple(found)


def _shows_forces(drawing: m.Recorded) -> bool:
    return isinstance(drawing, m.Drawing) and drawing.forces_on is not None


def _after(said: tuple[Inline, ...], blocks: list[Block]) -> list[Block]:
    """Insert a sentence at the beginning of the first block if this block is a paragraph."""
    first = blocks[0]
    return (
        [Paragraph((*said, Text(" "), *first.nodes)), *blocks[1:]] if said and isinstance(first, Paragraph) else blocks
    )


def _shown(drawn: Sequence[m.Recorded], figures: Sequence[Illustration], words: Phrases) -> tuple[Inline, ...]:
    """Return a sentence about the content of a plot or of normal modes; empty for other figures."""
    first, named = drawn[0], _named(figures, words)
    if all(isinstance(each, m.Drawing) and each.mode is not None for each in drawn):
        return filled(words.drawings["shows_modes"], named)
    if len(drawn) > 1 or not isinstance(first, m.Plot):
        return ()
    if first.across is not None or first.levels is not None or first.diagram is not None:
        sort = "path" if first.across is not None else "portrait" if first.levels is not None else "diagram"
        return filled(words.drawings[f"shows_{sort}"], named)
    quantity = joined([(Math(label),) for label in first.labels], words.labels["and"])
    curves = {"quantity": quantity, "several": len(first.labels) > 1, "variable": (Math(first.variable),)}
    return filled(words.drawings["shows_curve"], {**named, **curves})


def _begins_a_sentence(blocks: Sequence[Block]) -> bool:
    """Whether the blocks begin with a new sentence, not with words such as "and for the block"."""
    first = blocks[0] if blocks else None
    opening: Any = first if isinstance(first, Paragraph) else None
    while isinstance(opening, Paragraph | ToldOnce):
        opening = next(iter(opening.nodes), None)
    return type(opening) is Text and opening.text[:1].isupper()


def _named(figures: Sequence[Illustration], words: Phrases) -> dict[str, Any]:
    """Return the names of the figures, such as Figures 1 and 2, and how many figures these are."""
    numbers = [(each.number, each.key) for each in figures if each.number is not None]
    if len(numbers) == 1:
        [(number, key)] = numbers
        label = words.labels["figure"]
        return {"figures": (FigureRef(f"{label}\u00a0{number}", key, number),), "count": 1}
    named = [(FigureRef(str(number), key, number, is_alone=True),) for number, key in numbers]
    listed = (Text(f"{words.labels['figures']}\u00a0"), *joined(named, words.labels["and"]))
    return {"figures": listed, "count": len(named)}


def _sentence_before(blocks: Sequence[Block]) -> int | None:
    """Return the position of the paragraph before the figures, or before the display that precedes the figures."""
    for at in (len(blocks) - 1, len(blocks) - 2):
        if at >= 0 and isinstance(blocks[at], Paragraph):
            return at
        if at >= 0 and not isinstance(blocks[at], Display):
            return None
    return None


def _after_figures(blocks: list[Block], figures: Sequence[Illustration], words: Phrases) -> list[Block]:
    """Mention the figures in the first paragraph after them, if there is one."""
    at = next((i for i, block in enumerate(blocks) if isinstance(block, Paragraph)), None)
    return blocks if at is None else [*blocks[:at], _with_mention(blocks[at], figures, words), *blocks[at + 1 :]]


def _with_forces(blocks: list[Block], figures: Sequence[Illustration], words: Phrases) -> list[Block]:
    """Mention the figures of forces at the beginning of the first sentence, or in a sentence before it."""
    first, named = blocks[0], _named(figures, words)
    article = words.drawings["article"]
    nodes = first.nodes if isinstance(first, Paragraph) else ()
    opening = nodes[0] if nodes else None
    is_one_sentence = not any(". " in node.text for node in nodes if isinstance(node, Text))
    if is_one_sentence and type(opening) is Text and opening.text.startswith(f"{article} "):
        said = filled(words.drawings["with_forces"], named)
        rest = Text(f" {opening.text[0].lower()}{opening.text[1:]}")
        return [Paragraph((*said, rest, *nodes[1:])), *blocks[1:]]
    shown = filled(words.drawings["shows_forces"], named)
    if nodes:
        return [Paragraph((*shown, Text(" "), *nodes)), *blocks[1:]]
    return [Paragraph(shown), *blocks]


def _with_mention(paragraph: Block, figures: Sequence[Illustration], words: Phrases) -> Block:
    """Put the figures in parentheses at the end of a paragraph."""
    if not isinstance(paragraph, Paragraph):
        return paragraph
    *before, last = paragraph.nodes
    said, end = (last.text.rstrip(), "") if type(last) is Text else ("", "")
    space = last.text[len(said) :] if type(last) is Text else ""
    if type(last) is not Text:
        before.append(last)
    if said.endswith(STOPS):
        said, end = said[:-1], said[-1]
    mention: tuple[Inline, ...] = filled(words.drawings["mentioned"], _named(figures, words))
    if said.endswith(")"):  # the paragraph already ends with parentheses
        mention = (*_named(figures, words)["figures"], Text(")"))
        return replace(paragraph, nodes=(*before, Text(said[:-1]), words.semicolon, *mention, Text(f"{end}{space}")))
    return replace(paragraph, nodes=(*before, Text(f"{said} "), *mention, Text(f"{end}{space}")))
