"""Every line of a problem read back from each format, and compared with what was derived.

A line is read as a person reads it who knows its names: from LaTeX inline and on display, and from the text page.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from sympy import MatrixBase

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import PLUS_MINUS, explicit
from derive.errors import DeriveError
from derive.render.notation.binding import Binding, binding
from derive.render.notation.breaking import broken
from derive.render.notation.latex import latex
from derive.render.notation.layout import Layout, Row, row
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain, text_box
from tests.printed.from_latex import read_printed
from tests.printed.from_text import in_one_line, read_text
from tests.printed.meaning import letters_of, meaning
from tests.printed.names import Misprint, bound_in, names_in, positions_in, printed_apart, units_in

NARROW = 24.0  # characters: what is longer is broken


@dataclass
class Count:
    read: Counter[str] = field(default_factory=Counter)
    misprints: dict[str, str] = field(default_factory=dict)


def read_back(expr: Any, layout: Any, notation: Notation) -> Iterator[tuple[str, str, list[list[Any]], list[str]]]:
    names = names_in(expr, notation)
    bound, positions = bound_in(expr), [letters_of(r.name, r.shape) for r in positions_in(expr)]
    printed_apart(names, latex)
    seen: dict[str, Any] = {}
    for format in ("display", "inline"):
        text = latex(layout, inline=format == "inline")
        if text not in seen:
            try:
                seen[text] = read_printed(text, names, notation.known_dimensions, bound, positions)
            except (DeriveError, AssertionError, AttributeError, ValueError) as error:
                raise Misprint(f"{format}: {text}\n    {error}") from error
        yield (format, text, *seen[text])
    shown = text_box(layout)
    try:
        found = read_text(shown, printed_apart(names, plain), units_in(expr), bound, positions)
    except (AssertionError, AttributeError, ValueError, TypeError) as error:
        raise Misprint(f"text: {in_one_line(shown)}\n    {error!r}") from error
    yield ("text", in_one_line(shown), *found)


def meant(expr: Any) -> tuple[list[list[Any]], list[str]]:
    value = meaning(expr)
    sides, marks = ([value[0], value[2]], [value[1]]) if isinstance(value, tuple) else ([value], [])
    has_sign = any(_has_sign(side) for side in sides)
    return [[side.subs(PLUS_MINUS, sign) for side in sides] for sign in ((1, -1) if has_sign else (1,))], marks


def _has_sign(value: Any) -> bool:
    return PLUS_MINUS in value.free_symbols


def check_line(expr: Any, notation: Notation, count: Count, where: str = "") -> None:
    """Read one form back from all formats: as a line, as a result, and broken as on a narrow page."""
    layouts = dict.fromkeys([notation.layout(expr), notation.result(expr)])
    wanted, wanted_marks = meant(expr)
    for layout in [*layouts, *(row(*pieces) for pieces in map(_broken, layouts) if len(pieces) > 1)]:
        before: Any = None
        try:
            for format, text, found, marks in read_back(expr, layout, notation):
                count.read[format] += 1
                if marks != wanted_marks:
                    raise Misprint(f"{format}: {text}\n    {marks} for {wanted_marks}")
                if found != before:
                    _compare(found, wanted, f"{format}: {text}")
                before = found
        except Misprint as misprint:
            count.misprints.setdefault(str(misprint), where)


def _broken(layout: Layout) -> list[Layout]:
    return broken(layout, NARROW, NARROW) if not _is_relation(layout) else [layout]


def _is_relation(layout: Layout) -> bool:
    return isinstance(layout, Row) and binding(layout) is Binding.RELATION


def _compare(found: list[list[Any]], wanted: list[list[Any]], where: str) -> None:
    if len(found) != len(wanted):
        raise Misprint(f"{where}\n    has {len(found)} branches for {len(wanted)}")
    for mine, theirs in zip(found, wanted, strict=True):
        for a, b in zip(mine, theirs, strict=True):
            if a == 0 and isinstance(b, MatrixBase) and b.is_zero_matrix:
                continue  # on the text page a vector that vanishes is 0 as a number is
            verdict = equal(a, b)
            if verdict.grade is Grade.REFUTED:
                raise Misprint(f"{where}\n    is read as {explicit(a)}\n    but is          {explicit(b)}")
