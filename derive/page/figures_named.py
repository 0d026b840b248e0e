"""Adds mentions of the numbered figures of a part to the sentences near them: "It is unstable (Figure 2)."

A figure that no text of the author mentions is mentioned in parentheses at the end of a paragraph, or next to a formula
directly before or after the figure. A figure of forces is mentioned before the equations: "With the forces in Figure 2,
the upward component is".
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

from derive.figures import marks as m
from derive.page.tree import Block, Display, Illustration, Paragraph
from derive.page.wording import FigureRef, Inline, Phrases, Text, ToldOnce, filled, joined

STOPS = (".", ",", ":")


def figures_mentioned(
    blocks: Sequence[Block], drawings: Mapping[str, m.Recorded], mentioned: Collection[str], words: Phrases
) -> tuple[Block, ...]:
    """Return the blocks of a part, with mentions of the numbered figures if there are sentences for them.

    drawings    the drawings of the problem, by key
    mentioned   the keys of the drawings that a text of the author mentions
    """
    found: list[Block] = []
    waiting: list[Illustration] = []  # figures that the blocks after them will mention
    groups = [list(group) for _, group in groupby(blocks, lambda block: isinstance(block, Illustration))]
    for together, following in zip(groups, [*groups[1:], []], strict=True):
        if not isinstance(together[0], Illustration):
            can_begin = bool(waiting) and all(_shows_forces(drawings[each.key]) for each in waiting)
            found += (can_begin and _with_forces(together, waiting, words)) or _after_figures(together, waiting, words)
            waiting = []
            continue
        shown = [each for each in together if isinstance(each, Illustration)]
        new = [each for each in shown if each.number is not None and each.key not in mentioned]
        is_before_equations = all(_shows_forces(drawings[each.key]) for each in new) and _begins_a_sentence(following)
        if new and not is_before_equations and (at := _sentence_before(found)) is not None:
            found = _with_mention(found, at, new, words)
        else:
            waiting = new
        found += shown
    return tuple(found)


def _shows_forces(drawing: m.Recorded) -> bool:
    return isinstance(drawing, m.Drawing) and drawing.forces_on is not None


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
    """Return the position of the paragraph before the figures, or before the display that precedes the figures; None if
    there is no such paragraph."""
    for at in (len(blocks) - 1, len(blocks) - 2):
        if at >= 0 and isinstance(blocks[at], Paragraph):
            return at
        if at >= 0 and not isinstance(blocks[at], Display):
            return None
    return None


def _after_figures(blocks: list[Block], figures: Sequence[Illustration], words: Phrases) -> list[Block]:
    """Mention the figures in the first paragraph after them, if there is one."""
    at = next((i for i, block in enumerate(blocks) if isinstance(block, Paragraph)), None)
    return blocks if at is None or not figures else _with_mention(blocks, at, figures, words, equation=0)


def _with_forces(blocks: list[Block], figures: Sequence[Illustration], words: Phrases) -> list[Block]:
    """Mention the figures of forces at the beginning of the first sentence.

    Return an empty list unless the first block is a single sentence that begins with the definite article.
    """
    first, article = blocks[0], words.drawings["article"]
    nodes = first.nodes if isinstance(first, Paragraph) else ()
    opening = nodes[0] if nodes else None
    is_one_sentence = not any(". " in node.text for node in nodes if isinstance(node, Text))
    if not (is_one_sentence and type(opening) is Text and opening.text.startswith(f"{article} ")):
        return []
    said = filled(words.drawings["with_forces"], _named(figures, words))
    rest = Text(f" {opening.text[0].lower()}{opening.text[1:]}")
    return [Paragraph((*said, rest, *nodes[1:])), *blocks[1:]]


def _with_mention(
    blocks: list[Block], at: int, figures: Sequence[Illustration], words: Phrases, equation: int = -1
) -> list[Block]:
    """Put the figures in parentheses at the end of a paragraph. If the paragraph ends within a clause, put the figures
    next to an equation of the display after the paragraph, unless this equation already has a reason.

    equation    the position of this equation in the display: the last one, or the first one for figures above it
    """
    paragraph, following = blocks[at], blocks[at + 1] if at + 1 < len(blocks) else None
    if not isinstance(paragraph, Paragraph):
        return blocks
    *before, last = paragraph.nodes
    said, end = (last.text.rstrip(), "") if type(last) is Text else ("", "")
    if (
        not said.endswith(STOPS)
        and isinstance(following, Display)
        and (noted := _noted(following, equation, _named(figures, words)["figures"]))
    ):
        return [*blocks[: at + 1], noted, *blocks[at + 2 :]]
    space = last.text[len(said) :] if type(last) is Text else ""
    if type(last) is not Text:
        before.append(last)
    if said.endswith(STOPS):
        said, end = said[:-1], said[-1]
    mention: tuple[Inline, ...] = filled(words.drawings["mentioned"], _named(figures, words))
    said = f"{said} "
    if said.endswith(") "):  # the paragraph already ends with parentheses
        said, mention = said[:-2], (words.semicolon, *_named(figures, words)["figures"], Text(")"))
    mentioned = replace(paragraph, nodes=(*before, Text(said), *mention, Text(f"{end}{space}")))
    return [*blocks[:at], mentioned, *blocks[at + 1 :]]


def _noted(display: Display, at: int, note: tuple[Inline, ...]) -> Display | None:
    """Return the display with a note next to the last line of an equation; None if this line has a reason."""
    groups = list(display.groups)
    if not groups or groups[at].lines[-1].reason:
        return None
    *lines, line = groups[at].lines
    groups[at] = replace(groups[at], lines=(*lines, replace(line, reason=note)))
    return replace(display, groups=tuple(groups))
