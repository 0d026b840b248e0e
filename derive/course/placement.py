"""The key `drawings:` of a problem: where each drawing appears, its caption and width, and what it plots."""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from derive.algebra.expressions import scalar
from derive.course.expression import Declared
from derive.course.given import Measured, read_end, read_numbers, read_value
from derive.course.problem_file import MARKS_OF_BODY, DrawingKeys, MarkKeys
from derive.course.prose import Prose
from derive.course.schema import wrong_type
from derive.course.yaml_tree import Formula, Scalar, Sequence, Tree, Word
from derive.errors import Faults, Place, did_you_mean, rejected

STATEMENT, HIDDEN = "statement", "hidden"
POLHODES, AFTER = "polhodes", "after"
ON_REQUEST = (POLHODES, AFTER)  # the names of drawings that the engine makes only if the problem names them
EQUILIBRIA = "equilibria"  # the answer whose plot is a bifurcation diagram
_KEY = re.compile(r"[a-z][a-z0-9_]+", re.ASCII)
WIDEST, NARROWEST = 15.0, 1.0  # centimetres


ROMAN = ("i", "ii", "iii", "iv", "v", "vi", "vii", "viii", "ix", "x")


def case_label(index: int) -> str:
    """Return the label of a case by its index: i for 0, ii for 1, ..., x for 9, then 11, 12, ..."""
    return ROMAN[index] if index < len(ROMAN) else str(index + 1)


@dataclass(frozen=True)
class Range:
    """The two ends of the range of a plot; their kind is known only after the script has run."""

    ends: tuple[Formula, ...]

    @property
    def place(self) -> Place:
        return self.ends[0].place

    def of_kind(self, kind: str) -> list[Expr]:
        return [read_end(end.scalar, kind) for end in self.ends]


@dataclass(frozen=True)
class Placement:
    """The settings of one drawing; derive chooses the settings that are left out.

    view      the azimuth and the elevation of the direction from which a drawing in space is seen, in degrees
    like      the name of the drawing whose contents this drawing repeats
    marks     the marks that the problem adds to the drawing
    without   the labels of marks that the drawing leaves out
    plot      the plotted answer, or the two answers or formulas of a path
    curves    several answers that are plotted together
    labels    the names of the axes of a path, in place of its formulas
    surfaces  the names of the surfaces that are drawn with a path
    then      the value that curves keep after the range
    up        the ends of the vertical axis of curves
    energies  the energies that are drawn as lines in the plot of a potential energy
    per       the quantities by which the axes of a plot are divided
    panels    whether curves are together in one panel or apart
    levels    the values of the answer on the curves of a phase portrait
    over      the ranges of the two axes of a phase portrait, or of the vertical axis of a bifurcation diagram
    letters   the letters that formulas of a plot may contain, by name
    """

    key: str
    place: Place = field(repr=False)
    at: str | None = None
    at_place: Place | None = field(default=None, repr=False)
    caption: Prose | None = None
    width: float | None = None
    view: tuple[float, float] | None = None
    view_place: Place | None = field(default=None, repr=False)
    width_place: Place | None = field(default=None, repr=False)
    values: tuple[tuple[Symbol, Expr], ...] = ()
    names: Table[str, Place] = field(default_factory=dict, repr=False)
    range: Range | None = field(default=None, repr=False)
    then: Formula | None = None
    up: Range | None = field(default=None, repr=False)
    energies: tuple[Formula, ...] = ()
    per: tuple[Formula, ...] = ()
    cases: tuple[tuple[Measured, ...], ...] = ()
    like: Word | None = None
    marks: tuple[MarkKeys, ...] = ()
    without: tuple[Word, ...] = ()
    plot: tuple[Formula, ...] = ()
    curves: tuple[Word, ...] = ()
    labels: tuple[Word, ...] = ()
    surfaces: tuple[Word, ...] = ()
    panels: str | None = None
    against: Formula | None = None
    levels: tuple[Formula, ...] = ()
    over: Table[Word, Range] = field(default_factory=dict, repr=False)
    letters: Table[str, Declared] = field(default_factory=dict, repr=False)

    @property
    def is_of_engine(self) -> bool:
        """Whether the drawing is a plot that the engine draws."""
        return bool(self.plot or self.curves)

    @property
    def shows(self) -> tuple[str, ...]:
        """Return the names of the marks that belong to a body, such as its centre of mass."""
        return tuple(str(mark.mark) for mark in self.marks if mark.mark in MARKS_OF_BODY)

    @property
    def adds(self) -> tuple[MarkKeys, ...]:
        """Return the marks that do not belong to a body, such as points and lines. The problem states their places."""
        return tuple(mark for mark in self.marks if mark.mark not in MARKS_OF_BODY)

    @property
    def is_sketch(self) -> bool:
        """Whether the marks make a plane drawing of their own: each place has two components."""
        places = [place for mark in self.marks for place in (mark.at, mark.start, mark.end) if place is not None]
        in_plane = (isinstance(place, Sequence) and len(place.items) == 2 for place in places)
        return not self.like and bool(places) and all(in_plane)

    @property
    def is_diagram(self) -> bool:
        return self.plot == (EQUILIBRIA,)

    @property
    def is_portrait(self) -> bool:
        """Whether the drawing has all that a phase portrait needs."""
        return len(self.plot) == 1 and bool(self.levels) and len(self.over) == 2


def placements(
    drawings: Table[Word, DrawingKeys], symbols: Table[str, Declared], parts: int, faults: Faults
) -> tuple[Placement, ...]:
    """Read every entry of `drawings:`. Names of steps in an entry are checked only after the script has run."""
    return tuple(
        Placement(
            key=name,
            place=name.place,
            at=_at(written.at, parts, faults),
            at_place=written.at.place if written.at else None,
            caption=written.caption,
            width=width_of(written.width, faults),
            view=written.view,
            view_place=written.places.get("view"),
            width_place=written.places.get("width"),
            values=_values(written.values, symbols, faults),
            names={letter: letter.place for letter in written.values},
            range=Range(written.ends) if written.ends else None,
            then=written.then,
            up=Range(written.up) if written.up else None,
            energies=written.energies,
            per=written.per,
            cases=tuple(read_numbers(case, symbols, faults) for case in written.cases),
            like=written.like,
            marks=written.marks,
            without=written.without,
            plot=written.plot or (),
            curves=written.curves,
            labels=written.labels,
            surfaces=written.surfaces,
            panels=written.panels,
            against=written.against,
            levels=written.levels,
            over={name: Range(ends) for name, ends in written.over.items()},
            letters=symbols,
        )
        for name, written in drawings.items()
    )


def _at(node: Tree | None, parts: int, faults: Faults) -> str | None:
    letters = [chr(ord("a") + i) for i in range(parts)]
    known = [STATEMENT, *letters, HIDDEN]
    if node is None or (isinstance(node, Scalar) and node.text in known):
        return node.text if node else None
    help_line = did_you_mean(node.text, (STATEMENT, HIDDEN)) if isinstance(node, Scalar) else None
    if isinstance(node, Scalar) and help_line is None and _KEY.fullmatch(node.text):
        return node.text  # whether this step exists is known only after the script has run
    last = f"part a to {letters[-1]}" if parts > 1 else "part a"
    wrong_type(faults, "`at`", f"statement, {last}, the key of a step, or hidden", node, help_line)
    return None


def width_of(node: Tree | None, faults: Faults) -> float | None:
    """Return the width in centimetres that the key `width` states; None without this key, or after an error in it."""
    if node is None:
        return None
    with faults:
        width = 100 * float(read_value("width", node, "length", {}))
        if NARROWEST <= width <= WIDEST:
            return width
        rejected("wrong-size", f"`width` must be from {NARROWEST:g} to {WIDEST:g} cm", node.place)
    return None


def _values(
    written: Table[Word, Tree], symbols: Table[str, Declared], faults: Faults
) -> tuple[tuple[Symbol, Expr], ...]:
    """Read the values of letters in a drawing: numbers, or expressions in other letters such as `h: 2*R`."""
    found: list[tuple[Symbol, Expr]] = []
    for name, value in written.items():
        # A letter that is not declared must be a coordinate of the script. It counts as an angle.
        declared = symbols.get(name) or Declared(str(name), scalar(str(name)), "angle")
        with faults:
            expr = read_value(name, value, declared.kind, symbols)
            if declared.symbol in expr.free_symbols:
                rejected("circular", f"`{name}` cannot be drawn in terms of itself", value.place)
            found.append((declared.symbol, expr))
    return tuple(found)
