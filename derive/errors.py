"""The classes of all errors, and the text in which an error is shown.

    DeriveError                 the base class; most other exceptions are internal errors
    ├── Rejected                errors in a file of the author; as many as possible are reported at once
    ├── Unverified              a check does not confirm a step, a part of a system or a figure
    ├── BuildFailed             TeX, the disk, a time limit or the system stopped the work
    └── Misused                 the command line, or a call in a notebook, is wrong (exit code 2)

A `Complaint` is one error as data; only `shown()` turns it into text. `OutOfTime` is not a `DeriveError`, so that code
which handles rejected input does not catch it and continue.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NoReturn


@dataclass(frozen=True)
class Place:
    """A place in a file: the line and column (both from 1), the text of the line, and how many columns to underline.

    If the line is long, `text` is only a part of it: column n of the line is column n - `cut` of `text`.
    """

    path: str
    line: int
    column: int = 1
    text: str = ""
    width: int = 1
    cut: int = 0


class Spelled(str):
    """A help line for an error in a script; `in_file` is the help line for the same error in a YAML file, or None."""

    in_file: str | None

    def __new__(cls, script: str, in_file: str | None) -> Spelled:
        made = super().__new__(cls, script)
        made.in_file = in_file
        return made

    def __reduce__(self) -> tuple[type, tuple[str, str | None]]:
        return type(self), (str(self), self.in_file)


@dataclass(frozen=True)
class Complaint:
    """One error or warning: a stable code, a message that can be read alone, a place, notes, and at most one help line.

    argument   the wrong argument of a verb; in a YAML file, the error is shown at the key for this argument
    """

    code: str
    message: str
    place: Place | None = None
    notes: tuple[str, ...] = ()
    help: str | None = None
    severity: str = "error"
    argument: str = ""

    def shown(self) -> str:
        """Return the error in the style of the Rust compiler: place and message, the line, a caret, notes, help."""
        head = f"{self.severity}[{self.code}]: {self.message}"
        if self.place is None:
            return "\n".join([head, *self._footer("")])
        p = self.place
        lines = [f"{p.path}:{p.line}:{p.column}: {head}"]
        gutter = " " * len(str(p.line))
        if p.text.strip():
            # A tab is printed one column wide, so that the caret is under the marked text.
            lines.append(f"  {p.line} | " + p.text.rstrip("\r\n").replace("\t", " "))
            lines.append(f"  {gutter} | " + " " * max(0, p.column - p.cut - 1) + "^" * max(1, p.width))
        return "\n".join([*lines, *self._footer(gutter)])

    def _footer(self, gutter: str) -> list[str]:
        notes = [f"  {gutter} = {note}" for note in self.notes]
        return notes + ([f"  {gutter} = help: {self.help}"] if self.help else [])


class DeriveError(Exception):
    """An error that stops the work, and whose cause the user can remove."""

    exit_code = 1

    def __init__(self, complaints: Complaint | Iterable[Complaint]):
        self.complaints = (complaints,) if isinstance(complaints, Complaint) else tuple(complaints)
        super().__init__(self.complaints)

    def __str__(self) -> str:
        return "\n".join(complaint.shown() for complaint in self.complaints)

    def __reduce__(self) -> tuple[type, tuple[tuple[Complaint, ...]]]:
        return type(self), (self.complaints,)


class Rejected(DeriveError):
    """A file of the author has errors."""


class Unverified(DeriveError):
    """A check does not confirm a step, a part of a system or a figure: for example, neighbouring lines or the second
    route disagree."""


class BuildFailed(DeriveError):
    """TeX, the disk, a time limit or the operating system stopped the work; earlier outputs are unchanged."""


class Misused(DeriveError):
    """The command line, or a call in a notebook, asks for something that does not exist or has no meaning."""

    exit_code = 2


class OutOfTime(BaseException):
    """Raised when the time limit is reached during work; its fields describe this work.

    waited    whether the work was only waiting, without using the processor
    doing     descriptions of the work under way, innermost first
    answers   the names of the answers that the work was deriving, innermost first
    finished  the keys of the steps that earlier calls of verbs established
    kept      whether the finished steps are stored for the next attempt
    """

    def __init__(self, waited: bool = False):
        super().__init__()
        self.waited = waited
        self.doing: list[str] = []
        self.answers: list[str] = []
        self.finished: tuple[str, ...] = ()
        self.kept = False


@contextmanager
def during(what: Callable[[], str]) -> Iterator[None]:
    """Describe work that may take long; the description is made only if the time limit is reached during the work."""
    try:
        yield
    except OutOfTime as late:
        late.doing.append(what())
        raise


# --- help lines and collected errors ----------------------------------------------------------------------------------


def nearest(name: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate that was probably meant, or None.

    At most one letter in three may be wrong; in a name of two letters, one letter may be wrong.
    """
    import difflib  # imported here, because only errors need this module

    written, known = name.casefold(), {c.casefold(): c for c in reversed((*candidates,))}
    close = difflib.get_close_matches(written, known, 3, 0.6)
    return next((known[c] for c in close if _slips(written, c) <= _most_slips(min(len(written), len(c)))), None)


def _most_slips(letters: int) -> int:
    return max(letters // 3, int(letters > 1))  # `kgs` may mean `kg`, a name of two letters


def _slips(written: str, meant: str) -> int:
    """Count the letters that are wrong, missing or too many; the same letters in another order count as one wrong
    letter."""
    import difflib

    if sorted(written) == sorted(meant):
        return int(written != meant)
    changes = difflib.SequenceMatcher(None, written, meant).get_opcodes()
    return sum(max(i2 - i1, j2 - j1) for change, i1, i2, j1, j2 in changes if change != "equal")


def with_article(id: str) -> str:
    """Return an id as words for a message: `a thick shell` for `thick_shell`, `a half-disc` for `half_disc`."""
    words = id.replace("half_", "half-").replace("_", " ")
    return f"{'an' if words[0] in 'aeiou' else 'a'} {words}"


def did_you_mean(name: str, candidates: Iterable[str]) -> str | None:
    """Return a help line with the nearest candidate, or None if no candidate is close."""
    close = nearest(name, tuple(candidates))
    return f"did you mean `{close}`?" if close else None


class Faults:
    """Collects errors, so that one run of the command reports everything that is wrong with a file."""

    def __init__(self, complaints: Iterable[Complaint] = ()) -> None:
        self._complaints = dict.fromkeys(complaints)

    def __bool__(self) -> bool:
        return bool(self._complaints)

    def add(self, complaint: Complaint) -> None:
        self._complaints.setdefault(complaint)

    def error(
        self, code: str, message: str, place: Place | None, *, notes: tuple[str, ...] = (), help: str | None = None
    ) -> None:
        self.add(Complaint(code, message, place, notes, help))

    @property
    def complaints(self) -> tuple[Complaint, ...]:
        return tuple(self._complaints)

    def take(self, others: Faults) -> None:
        for complaint in others._complaints:
            self.add(complaint)

    def __enter__(self) -> Faults:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: object) -> bool:
        """Collect the errors of a `Rejected` inside `with faults:`, and continue after the block."""
        if isinstance(error, Rejected):
            for complaint in error.complaints:
                self.add(complaint)
            return True
        return False

    def stop(self) -> None:
        """Raise all collected errors, in the order of the file; do nothing if there are none."""
        if self._complaints:
            raise Rejected(sorted(self._complaints, key=_reading_order))


def _reading_order(complaint: Complaint) -> tuple[str, int, int]:
    p = complaint.place
    return (p.path, p.line, p.column) if p else ("", 0, 0)


def rejected(code: str, message: str, place: Place | None, help: str | None = None, *notes: str) -> NoReturn:
    """Raise an error that stops the parsing of a value; a surrounding `with faults:` collects the error."""
    raise Rejected(Complaint(code, message, place, notes, help))
