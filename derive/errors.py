"""What can go wrong, as one tree, and how a fault is shown.

    DeriveError                 nothing but these reaches the command line
    ├── Rejected                faults in a file that somebody wrote, all of them at once
    ├── Unverified              a step whose lines or whose second route disagree
    ├── BuildFailed             TeX, the disk, a time limit: the outside world
    └── Misused                 the command line itself was wrong (exit code 2)

A `Complaint` carries data; `shown()` is the only place where it becomes text.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Place:
    """Where in a file: 1-based line and column, the line itself, how many columns to underline."""

    path: str
    line: int
    column: int = 1
    text: str = ""
    width: int = 1


@dataclass(frozen=True)
class Complaint:
    """One fault: a stable code, a message that stands alone, where, why, and at most one help."""

    code: str
    message: str
    place: Place | None = None
    notes: tuple[str, ...] = ()
    help: str | None = None
    severity: str = "error"

    def shown(self) -> str:
        """The fault as rustc would print it: place and message, the line, a caret, notes, help."""
        head = f"{self.severity}[{self.code}]: {self.message}"
        if self.place is None:
            return "\n".join([head, *self._footer("")])
        p = self.place
        lines = [f"{p.path}:{p.line}:{p.column}: {head}"]
        gutter = " " * len(str(p.line))
        if p.text.strip():
            # A tab is one column wide here, so that the caret stands under what it marks.
            lines.append(f"  {p.line} | " + p.text.rstrip("\r\n").replace("\t", " "))
            lines.append(f"  {gutter} | " + " " * (p.column - 1) + "^" * max(1, p.width))
        return "\n".join([*lines, *self._footer(gutter)])

    def _footer(self, gutter: str) -> list[str]:
        notes = [f"  {gutter} = {note}" for note in self.notes]
        return notes + ([f"  {gutter} = help: {self.help}"] if self.help else [])


class DeriveError(Exception):
    """Anything that stops the work and that the user can do something about."""

    exit_code = 1

    def __init__(self, complaints: Complaint | Iterable[Complaint]):
        self.complaints = (complaints,) if isinstance(complaints, Complaint) else tuple(complaints)
        super().__init__("\n".join(c.shown() for c in self.complaints))

    def __reduce__(self) -> tuple[type, tuple[tuple[Complaint, ...]]]:
        return type(self), (self.complaints,)


class Rejected(DeriveError):
    """A file that somebody wrote has faults."""


class Unverified(DeriveError):
    """`establish()` refused a step: neighbouring lines, or the second route, disagree."""


class BuildFailed(DeriveError):
    """TeX, the disk or the clock said no; earlier outputs are as they were."""


class Misused(DeriveError):
    """The command line asks for something that does not exist or make sense."""

    exit_code = 2
