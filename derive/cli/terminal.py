"""The output of the command line: errors in colour, one live line while work is under way, aligned tables."""

from __future__ import annotations

import math
import os
import re
import shutil
import sys
import textwrap
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

from derive.errors import Complaint

_HEAD = re.compile(r"\b(error|warning)\[[a-z-]+\]:")
MOST = 50  # the greatest number of errors that are shown
WIDTH = 98
EVERY = 60  # seconds between two lines about the work under way, if standard error is not a terminal
_INDENT = 22  # indentation of the lines that explain an error of the source
_PAINT = {"error": "1;31", "warning": "1;33", "done": "32"}


def complain(complaints: Iterable[Complaint]) -> None:
    """Print each error once, in order, on standard error; print at most `MOST` errors, and then the number of the
    rest."""
    coloured = in_colour()
    found = list(dict.fromkeys(complaints))
    for text in dict.fromkeys(complaint.shown() for complaint in found[:MOST]):
        painted = _HEAD.sub(lambda m: f"\x1b[{_PAINT[m[1]]}m{m[0]}\x1b[0m", text, count=1)
        print(painted if coloured else text, file=sys.stderr)
    if found[MOST:]:
        print(f"and {len(found) - MOST} more", file=sys.stderr)


def in_colour() -> bool:
    """Return whether to colour standard error: on a terminal that supports colours, unless the user forbids them."""
    return sys.stderr.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


class _Pace:
    """The time at which the next line about the work under way may be printed into a file or a pipe."""

    due = math.inf


@contextmanager
def paced() -> Iterator[None]:
    """Allow a line about the work under way every `EVERY` seconds, also into a file or a pipe."""
    _Pace.due = time.monotonic() + EVERY
    try:
        yield
    finally:
        _Pace.due = math.inf


def tell(text: str) -> None:
    """Replace the line about the work under way; an empty text clears the line. If standard error is not a terminal,
    print a new line, but only if a line is due."""
    if not sys.stderr.isatty():
        if text and time.monotonic() >= _Pace.due:
            _Pace.due = time.monotonic() + EVERY
            print(text, file=sys.stderr, flush=True)
    else:
        width = shutil.get_terminal_size().columns - 1
        if len(text) > width and ", " in text[: width - 3]:
            text = text[: width - 3].rpartition(", ")[0] + ", ..."
        print(f"\r\x1b[K{text[:width]}", end="", file=sys.stderr, flush=True)


def note(how: str, of: str, seconds: float) -> None:
    """Print a permanent line about a finished piece of work; if its time is not zero, the line shows the time."""
    tell("")
    colour = _PAINT["error"] if how == "failed" else _PAINT["done"]
    painted = f"\x1b[{colour}m{how}\x1b[0m" if in_colour() else how
    print(f"{painted} {of}" + (f" ({seconds:.1f} s)" if seconds else ""), file=sys.stderr, flush=True)


def faults_of_source(problem_id: str, faults: Sequence[Sequence[str]]) -> str:
    """Return the errata and the remarks about the source of a problem."""
    sorts = [sort for sort, *_ in faults]
    words = {"erratum": ("erratum", "errata"), "remark": ("remark", "remarks")}
    counts = [f"{n} {words[sort][n > 1]}" for sort in words if (n := sorts.count(sort))]
    lines = [f"{problem_id}: {' and '.join(counts)}"]
    for sort, line, printed, right, why in faults:
        where = f"line {line}" if line else "printed"
        lines += _wrapped(printed, f"  {where:9}  {sort:7}  ")
        told = {"right": right, "why": why}
        lines += [row for word, text in told.items() if text for row in _wrapped(text, f"{word:>{_INDENT - 2}}: ")]
    return "\n".join(lines)


def _wrapped(text: str, before: str) -> list[str]:
    """Wrap a text, and replace control codes by blanks."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    return textwrap.wrap(plain, WIDTH, initial_indent=before, subsequent_indent=" " * _INDENT) or [before.rstrip()]


def table(rows: Sequence[Sequence[str]]) -> str:
    """Return aligned columns; the first row is the heading. Columns of digits and points are aligned to the right,
    other columns to the left."""
    columns = list(zip(*rows, strict=True))
    numeric = [all(re.fullmatch(r"[\d.]*", cell) for cell in column[1:]) for column in columns]
    widths = [max(map(len, column)) for column in columns]
    lines = []
    for row in rows:
        cells = zip(row, widths, numeric, strict=True)
        lines.append("  ".join(c.rjust(w) if n else c.ljust(w) for c, w, n in cells).rstrip())
    return "\n".join(lines)
