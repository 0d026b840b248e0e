"""A layout as runs of mathtext, the part of TeX's mathematics that matplotlib can set.

Computer Modern in mathtext has no bold italic, so the letter of a vector is a separate run, drawn with an outline.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from derive.render.notation.latex import latex, with_strokes_in_roots
from derive.render.notation.layout import Layout, Name, Row

_BOLD = re.compile(r"\\bm\{((?:[^{}]|\{[^{}]*\})*)\}")
_FUNCTION = re.compile(r"([\w})])\s*(\\(?:sin|cos|tan|log|exp)\b)")  # mathtext sets no space before a function
_UNKNOWN = {r"\tfrac": r"\frac", r"\lvert ": "|", r"\rvert ": "|", r"\mathopen{}": "", r"\!": "", r"\ ": r"\,"}


@dataclass(frozen=True)
class Span:
    """A piece of mathtext between dollar signs, and whether it is drawn bold."""

    text: str
    bold: bool = False


def runs(layout: Layout, inline: bool = False) -> tuple[Span, ...]:
    """Return the runs of a label, from left to right; with `inline`, fractions are a/b."""
    items = layout.items if isinstance(layout, Row) else (layout,)
    found: list[Span] = []
    pending: list[Layout] = []
    for item in items:
        if isinstance(item, Name) and item.style == "vector":
            found += _plain(pending, inline)
            pending = []
            letter = replace(item, subscript="", style="scalar")
            found.append(Span(_mathtext(letter), bold=True))
            if item.subscript:
                below = latex(Name("X", item.subscript)).removeprefix("X")
                found.append(Span("${}" + below + "$"))
        else:
            pending.append(item)
    return tuple(found + _plain(pending, inline))


def _plain(items: list[Layout], inline: bool) -> list[Span]:
    return [Span(_mathtext(Row(tuple(items)), inline))] if items else []


def _mathtext(layout: Layout, inline: bool = False) -> str:
    text = _BOLD.sub(r"\1", latex(with_strokes_in_roots(layout) if inline else layout, inline=inline))
    text = _FUNCTION.sub(r"\1\\,\2", text)
    for unknown, known in _UNKNOWN.items():
        text = text.replace(unknown, known)
    return f"${text}$"
