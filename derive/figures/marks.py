"""What a drawing shows, as data: marks whose places and directions are SymPy expressions in the problem's letters.

A mark says all that is asked of it: of which pieces it is made once the letters have numbers, how large it is, how it
is told in words. Which lines are hidden and where a label stands is decided on paper (`derive.render.drawing`).
Positions are columns (x, y, z), or (x, y) in a plane, in one frame, the same for all marks of a drawing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, TypeAlias

from sympy import MatrixBase, Symbol

from derive.errors import Complaint, Rejected
from derive.figures.pieces import InNumbers, Paper, Piece
from derive.figures.space import Vector
from derive.steps.record import current_run

Position: TypeAlias = Any  # a column of three expressions
InWords: TypeAlias = tuple[str, dict[str, Any]]  # by which phrase a mark is told, and what it may name
LAST = 99  # the layer of what stands beside everything else
SPACE, PLANE = "space", "plane"

BESIDE = {"beside": True}  # of a field: it is written beside a mark, and does not decide how that is drawn
MARK_CLASSES: dict[str, type[Mark]] = {}  # every kind of mark by its name

_DRAWING_NAME = re.compile(r"[a-z][a-z0-9_]{0,31}")


@dataclass(frozen=True, kw_only=True)
class Mark:
    """What all marks have: a name or an expression beside it, and the steps that it rests on, so that no drawing gives
    an answer away too early.
    """

    label: Any = field(default=None, metadata=BESIDE)
    keys: tuple[str, ...] = ()
    together: ClassVar[str | None] = None  # the phrase by which all such marks are told at once, by their labels
    layer: ClassVar[int] = 9  # what has a lower one is drawn before it

    def __init_subclass__(cls) -> None:
        known = MARK_CLASSES.setdefault(cls.__name__, cls)
        if (known.__module__, known.__qualname__) != (cls.__module__, cls.__qualname__):
            raise TypeError(f"there already is a mark {cls.__name__}")
        MARK_CLASSES[cls.__name__] = cls

    def pieces(self, paper: Paper) -> list[Piece]:
        """What it is on paper; nothing where there is nothing to see."""
        raise AttributeError(f"{type(self).__name__} must say of which pieces it is")

    @property
    def ends(self) -> tuple[Position, ...]:
        """What says how large a drawing is that shows no body."""
        return ()

    @property
    def directions(self) -> tuple[Position, ...]:
        """One that must not point at the eye, or two between which an angle must be seen."""
        return ()

    def tip(self, numbers: InNumbers, reach: float) -> Vector | None:
        """Where its head is in space, which must not seem to be a corner of a body of such a size."""
        return None

    def in_words(self) -> InWords | None:
        """How it is told to those who do not see it; nothing for a line that only helps the eye."""
        return None

    def _if_named(self, phrase: str, **names: Any) -> InWords | None:
        return (phrase, {"label": self.label, **names}) if self.label not in (None, 0) else None


@dataclass(frozen=True, kw_only=True)
class Surface(Mark):
    """What hides the things behind it and says how large a drawing is.

    name       what it is of, "a circular cone"; nothing for a surface that is told with another
    measures   what is told of its size: "base radius" and R
    """

    name: str = ""
    measures: tuple[tuple[str, Any], ...] = field(default=(), metadata=BESIDE)
    layer: ClassVar[int] = 0

    def vertices(self, numbers: InNumbers) -> list[Vector]:
        """The places at which edges meet."""
        return []

    def places(self, numbers: InNumbers) -> list[Vector]:
        """The outermost places that it reaches."""
        raise AttributeError(f"{type(self).__name__} must say how far it reaches")

    def in_words(self) -> InWords | None:
        return ("body", {"name": self.name, "measures": self.measures}) if self.name else None


Marks: TypeAlias = Mark | Iterable["Marks"]


@dataclass(frozen=True)
class Drawing:
    """A scene: its name on the page, its marks, and whether they are seen in space or in their plane (x, y).

    coordinates   those that it shows, with their kinds
    values        what letters are drawn with, in terms of others, unless the problem gives them numbers
    """

    key: str
    marks: tuple[Mark, ...]
    view: str = SPACE
    coordinates: tuple[tuple[Any, str], ...] = ()
    values: tuple[tuple[Any, Any], ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        """The steps that it rests on."""
        return tuple(dict.fromkeys(key for mark in self.marks for key in mark.keys))

    @property
    def letters(self) -> set[Symbol]:
        return letters_in(self.marks)


@dataclass(frozen=True)
class Plot:
    """A curve: a quantity as a function of one letter, from one value of it to another.

    expr, variable   the quantity's value and the letter against which it is drawn
    lower, upper     the range, unless the problem gives another
    kind, of         the kinds of the quantity and of the letter, for their units
    """

    key: str
    label: Any
    expr: Any
    variable: Any
    lower: Any
    upper: Any
    kind: str
    of: str
    keys: tuple[str, ...] = ()

    @property
    def letters(self) -> set[Symbol]:
        return letters_in((self.expr, self.lower, self.upper))


def components_in(thing: Any) -> set[int]:
    """How many components the places and directions of marks have, however deep they are."""
    if isinstance(thing, tuple | list):
        return {count for each in thing for count in components_in(each)}
    if isinstance(thing, Mark):
        return components_in([getattr(thing, f.name) for f in fields(thing) if not f.metadata.get("beside")])
    return {thing.rows} if isinstance(thing, MatrixBase) else set()


def letters_in(thing: Any) -> set[Symbol]:
    """Every letter in the positions and directions of marks, however deep; the names beside them are not among them."""
    if isinstance(thing, tuple | list):
        return {letter for each in thing for letter in letters_in(each)}
    if isinstance(thing, Mark):
        return letters_in([getattr(thing, f.name) for f in fields(thing) if not f.metadata.get("beside")])
    return {s for s in getattr(thing, "free_symbols", ()) if isinstance(s, Symbol)}


Recorded: TypeAlias = Drawing | Plot


def noted(drawing: Recorded) -> Recorded:
    """The drawing, after it was put on the record; a name stands for one drawing."""
    if not _DRAWING_NAME.fullmatch(drawing.key):
        help_line = "use small letters, digits and _"
        raise Rejected(Complaint("drawing-name", f"`{drawing.key}` cannot name a drawing", help=help_line))
    run = current_run.get()
    if run is not None:
        if any(other.key == drawing.key for other in run.drawings):
            message = f"two drawings are both called `{drawing.key}`"
            raise Rejected(Complaint("key-clash", message, help="give one of them another name"))
        run.drawings.append(drawing)
    return drawing


def flat(marks: Marks) -> Iterator[Mark]:
    """The marks one by one, whatever lists they came in."""
    if isinstance(marks, Mark):
        yield marks
    else:
        for each in marks:
            yield from flat(each)
