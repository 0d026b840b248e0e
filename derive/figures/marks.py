"""What a drawing shows, as data: marks whose places and directions are SymPy expressions in the problem's letters.

A mark knows what it is, not how it looks: which lines are hidden, how long an arrow is and where a label stands is
decided when it is drawn (`derive.render.drawing.picture`). Places are columns (x, y, z) in one frame, the same for
all marks of a drawing. `keys` are those of the steps that a mark rests on, so that no drawing gives an answer away too
early.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

from sympy import Symbol

from derive.errors import Complaint, Rejected
from derive.steps.record import current_run

Place: TypeAlias = Any  # a column of three expressions
SPACE, PLANE = "space", "plane"

_KEY = re.compile(r"[a-z][a-z0-9_]{0,31}")


@dataclass(frozen=True, kw_only=True)
class Mark:
    """What all marks have: a name or an expression beside it, and the steps that it rests on."""

    label: Any = None
    keys: tuple[str, ...] = ()


@dataclass(frozen=True)
class Box(Mark):
    """A block with its edges along the axes; `edges` are the lengths written beside three of them."""

    corner: Place
    sides: tuple[Any, ...]
    edges: tuple[Any, ...] = ()


@dataclass(frozen=True)
class ConeMark(Mark):
    """A circular cone."""

    apex: Place
    base: Place
    radius: Any


@dataclass(frozen=True)
class CylinderMark(Mark):
    """A circular cylinder between the centres of its two ends; a thin disc has a thickness for the eye only."""

    start: Place
    end: Place
    radius: Any
    thin: bool = False


@dataclass(frozen=True)
class BallMark(Mark):
    """A ball."""

    centre: Place
    radius: Any


@dataclass(frozen=True)
class RodMark(Mark):
    """A rod, too thin to show its thickness, or a piece of one; `length` is the whole one's, zero for a later piece."""

    start: Place
    end: Place
    length: Any


@dataclass(frozen=True)
class Circle(Mark):
    """A circle about a direction; `filled` if it bounds a body."""

    centre: Place
    normal: Place
    radius: Any
    filled: bool = False


@dataclass(frozen=True)
class Polygon(Mark):
    """A plane outline through its corners."""

    corners: tuple[Place, ...]


@dataclass(frozen=True)
class Line(Mark):
    """A line; its pen is `edge`, `construction`, `hidden` or `axis`."""

    start: Place
    end: Place
    pen: str = "construction"


@dataclass(frozen=True)
class Axis(Mark):
    """A coordinate axis: a thin arrow from where it begins to where it ends, or past the end in a direction."""

    start: Place
    end: Place
    past: Place = None


@dataclass(frozen=True)
class AxisOfRotation(Mark):
    """The whole line through a point along a direction, a little longer than the body on both sides.

    With a rate an arrow goes round its far end, right-handed if the rate is positive; the label is the rate's.
    """

    through: Place
    along: Place
    rate: Any = None


@dataclass(frozen=True)
class Arrow(Mark):
    """A vector in its true direction. Vectors of different kinds have no common scale: `size` is for the eye only, the
    length in terms of the size of the body. A vector that is zero is not drawn.
    """

    start: Place
    value: Place
    size: Any
    asked: bool = True


@dataclass(frozen=True)
class AngleMark(Mark):
    """The arc between two directions at a vertex; without a radius, as large as the eye needs."""

    vertex: Place
    a: Place
    b: Place
    radius: Any = None


@dataclass(frozen=True)
class Turn(Mark):
    """An arrow round a direction, right-handed; `size` in terms of the size of the body."""

    centre: Place
    along: Place
    size: Any


@dataclass(frozen=True)
class Length(Mark):
    """A dimension line between two points, moved aside in a direction, or to the left on paper where there is none, by
    the length `clear` and a little more.
    """

    start: Place
    end: Place
    aside: Place | None
    clear: Any = 0


@dataclass(frozen=True)
class Dot(Mark):
    """A point."""

    at: Place


@dataclass(frozen=True)
class Support(Mark):
    """The fixed ground under a pivot."""

    at: Place


Marks: TypeAlias = Mark | Iterable["Marks"]


@dataclass(frozen=True)
class Drawing:
    """A scene: its name on the page, its marks, and whether they are seen in space or in their plane (x, y)."""

    key: str
    marks: tuple[Mark, ...]
    view: str = SPACE

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


def letters_in(thing: Any) -> set[Symbol]:
    """Every letter in the places and directions of marks, however deep; the names beside them are not among them."""
    if isinstance(thing, tuple | list):
        return {letter for each in thing for letter in letters_in(each)}
    if isinstance(thing, Mark):
        return letters_in([getattr(thing, f.name) for f in fields(thing) if f.name not in {"label", "edges"}])
    return {s for s in getattr(thing, "free_symbols", ()) if isinstance(s, Symbol)}


Recorded: TypeAlias = Drawing | Plot


def noted(drawing: Recorded) -> Recorded:
    """The drawing, after it was put on the record; a name stands for one drawing."""
    if not _KEY.fullmatch(drawing.key):
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
