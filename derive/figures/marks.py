"""The marks of a drawing, as data: positions and directions are SymPy expressions in the symbols of the problem.

Given numbers for the symbols, a mark returns its pieces (lines, areas, points and labels), and a surface returns its
outermost points. A mark also returns its description in words. `derive.render.drawing` decides which lines are hidden
and where labels are. Positions are columns (x, y, z), or (x, y) in a plane, along the same axes for all marks of a
drawing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, replace
from typing import Any, ClassVar, TypeAlias

from sympy import MatrixBase, Symbol

from derive.algebra.kinds import unit_of_kind
from derive.errors import Complaint, Rejected
from derive.figures.pieces import InNumbers, Paper, Piece
from derive.figures.space import Vector
from derive.steps.record import current_run

Position: TypeAlias = Any  # a column of three expressions, or of two in a plane
InWords: TypeAlias = tuple[str, dict[str, Any]]  # the name of a phrase, and the values of its placeholders
LAST = 99  # the layer of marks that are drawn last, because they are placed beyond all other marks
SPACE, PLANE = "space", "plane"
SENSES = ("clockwise", "counterclockwise")

BESIDE = {"beside": True}  # metadata of a field that is only a label: symbols in labels need no numbers
MARK_CLASSES: dict[str, type[Mark]] = {}  # name -> class, for all classes of marks

_DRAWING_NAME = re.compile(r"[a-z][a-z0-9_]{0,31}")


@dataclass(frozen=True, kw_only=True)
class Mark:
    """Base class of all marks.

    label   a name or an expression
    keys    the keys of the steps that the mark uses, so that no drawing shows an answer before its step
    """

    label: Any = field(default=None, metadata=BESIDE)
    keys: tuple[str, ...] = ()
    together: ClassVar[str | None] = None  # the name of a phrase that describes all marks of this class together
    layer: ClassVar[int] = 9  # marks with a lower layer are drawn first

    def __init_subclass__(cls) -> None:
        known = MARK_CLASSES.setdefault(cls.__name__, cls)
        if (known.__module__, known.__qualname__) != (cls.__module__, cls.__qualname__):
            raise TypeError(f"a mark {cls.__name__} already exists")
        MARK_CLASSES[cls.__name__] = cls

    def pieces(self, paper: Paper) -> list[Piece]:
        """Return the pieces that are drawn; empty if nothing is visible."""
        raise AttributeError(f"{type(self).__name__} must define `pieces`")

    @property
    def ends(self) -> tuple[Position, ...]:
        """Return the points that determine the size of a drawing without bodies."""
        return ()

    @property
    def directions(self) -> tuple[Position, ...]:
        """Return one direction that should not point at the viewer, or two directions whose angle should be visible."""
        return ()

    def tip(self, numbers: InNumbers, reach: float) -> Vector | None:
        """Return the position of the arrowhead, which should not be at a corner of a body; None without an arrowhead.

        `reach` is the size of the bodies.
        """
        return None

    def in_words(self) -> InWords | None:
        """Return the description for readers who cannot see the drawing; None for an auxiliary line."""
        return None

    def _if_named(self, phrase: str, **names: Any) -> InWords | None:
        return (phrase, {"label": self.label, **names}) if self.label not in (None, 0) else None


@dataclass(frozen=True, kw_only=True)
class Surface(Mark):
    """A mark that determines the size of a drawing; the surfaces of bodies also hide the surfaces behind them.

    name       the id of the body in the phrases, such as "cone"; empty if the description of another surface
               also describes this one
    measures   pairs of an id and a length, such as "base_radius" and R, for the description
    """

    name: str = ""
    measures: tuple[tuple[str, Any], ...] = field(default=(), metadata=BESIDE)
    layer: ClassVar[int] = 0

    def vertices(self, numbers: InNumbers) -> list[Vector]:
        """Return the points at which edges meet."""
        return []

    def places(self, numbers: InNumbers) -> list[Vector]:
        """Return the outermost points of the surface."""
        raise AttributeError(f"{type(self).__name__} must define `places`")

    def in_words(self) -> InWords | None:
        return ("body", {"name": self.name, "measures": self.measures}) if self.name else None


Marks: TypeAlias = Mark | Iterable["Marks"]


@dataclass(frozen=True)
class ShownMode:
    """A normal mode that a drawing shows.

    frequency   the symbol of the frequency or of the growth rate of the mode
    sort        "oscillating", "growing" or "free"
    degenerate  whether other modes have the same frequency
    lengths     the meaning of the lengths of the arrows: "to_scale" if they are to scale; "without_small" if they are,
                but a displacement is too small for an arrow; "of_letters" if the ratio of the displacements depends on
                letters without numbers; "alone" for a single mass
    letters     the letters on which the ratio depends
    moves       the motion of each mass, in order: the mass, the directions of its displacement, and the sense of its
                rotation. The directions are words such as ("right", "up"), or () without a displacement. The sense is
                an element of SENSES, or "" without a rotation
    order       the order of the masses: "across" from left to right, "down" from top to bottom; empty for a single mass
    siblings    the keys of the steps of all modes that are found together; the drawings of these modes are placed after
                the last of these steps
    like        the key of the sketch of the system; the numbers that a problem gives for the sketch are also used here
    """

    frequency: Any
    sort: str
    degenerate: bool
    lengths: str
    letters: tuple[Any, ...]
    moves: tuple[tuple[Any, tuple[str, ...], str], ...]
    order: str
    siblings: tuple[str, ...]
    like: str = ""

    @property
    def turns(self) -> bool:
        """Whether a body rotates while its centre of mass is at rest."""
        return any(sense and not ways for _, ways, sense in self.moves)

    @property
    def is_straight(self) -> bool:
        """Whether a mass is displaced."""
        return any(ways for _, ways, _ in self.moves)


@dataclass(frozen=True)
class ShownPolhodes:
    """The curves on which the tip of the angular momentum of a free body stays.

    momentum   the symbol of the angular momentum
    ratios     the three moments of inertia, divided by the first one
    """

    momentum: Any
    ratios: tuple[Any, ...]


@dataclass(frozen=True)
class Drawing:
    """A drawing.

    key           the name of the drawing on the page
    view          whether the marks are shown in space or in the plane (x, y)
    coordinates   the coordinates in the marks, with their kinds
    values        values of symbols in terms of other symbols, used if the problem gives no numbers
    left_out      conditions of the system that the drawing does not show
    undrawn       the given forces that the drawing does not show, each with its kind: "force", "torque" or "drag"
    leads_to      the keys of steps that the drawing precedes, as a free-body diagram precedes Newton's laws
    forces_on     the mass of the body whose free-body diagram this is; None for a massless pulley and in any other
                  drawing
    mode          the normal mode that the drawing shows; None in any other drawing
    seen_from     the azimuth and the elevation of the view in space, in degrees; None if the camera chooses the view
    body_size     the size of the body in a force diagram, in points, which determines the scale; None if the usual
                  width of a drawing determines the scale
    polhodes      the curves of a free rotation that the drawing shows; None in any other drawing
    """

    key: str
    marks: tuple[Mark, ...]
    view: str = SPACE
    coordinates: tuple[tuple[Any, str], ...] = ()
    values: tuple[tuple[Any, Any], ...] = ()
    left_out: tuple[Any, ...] = ()
    leads_to: tuple[str, ...] = ()
    forces_on: Any = None
    mode: ShownMode | None = None
    body_size: float | None = None
    seen_from: tuple[float, float] | None = None
    polhodes: ShownPolhodes | None = None
    undrawn: tuple[tuple[str, Any], ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        """Return the keys of the steps that the drawing uses."""
        return tuple(dict.fromkeys(key for mark in self.marks for key in mark.keys))

    @property
    def letters(self) -> set[Symbol]:
        return letters_in(self.marks)


@dataclass(frozen=True)
class Across:
    """The quantity on the horizontal axis of a path: its name on the axis, its value and its SI unit."""

    label: Any
    expr: Any
    unit: str


@dataclass(frozen=True)
class Levels:
    """The curves of a phase portrait, on which a function of a coordinate and its momentum is constant.

    up          the momentum, on the vertical axis
    low, high   the range of the vertical axis
    values      the value of the function on each curve, and whether this curve is thick
    unit        the SI unit of the values
    """

    up: Any
    low: Any
    high: Any
    values: tuple[tuple[Any, bool], ...]
    unit: str = ""


@dataclass(frozen=True)
class Further:
    """A further curve of a plot: the name of its quantity, its value, and the key of its step."""

    label: Any
    expr: Any
    key: str


@dataclass(frozen=True)
class Outline:
    """A surface in the plane of a path: the points at which `expr` vanishes.

    plane     the symbols of the two coordinates in `expr`
    corners   the coordinates of two opposite corners of a bounded surface: left, below, right, above
    """

    name: str
    expr: Any
    plane: tuple[Any, Any]
    corners: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Branch:
    """One equilibrium of a bifurcation diagram.

    label    the symbol of the equilibrium
    place    the equilibrium value of the coordinate
    exists   the condition under which the equilibrium exists; None if it exists always
    stable   whether the equilibrium is stable, or the condition under which it is stable
    key      the key of the step that found the equilibrium
    """

    label: Any
    place: Any
    exists: Any
    stable: Any
    key: str

    @property
    def conditions(self) -> tuple[Any, ...]:
        """Return the conditions for existence and for stability."""
        return tuple(each for each in (self.exists, self.stable) if each is not None and not isinstance(each, bool))

    @property
    def drawn(self) -> tuple[Any, ...]:
        """Return the equilibrium value and the conditions."""
        return (self.place, *self.conditions)


@dataclass(frozen=True)
class Diagram:
    """The equilibria of one coordinate against a parameter, and the potential energy, which is stationary at these
    equilibria.

    against      the name of the horizontal axis: the parameter, or a ratio of symbols
    ends         the ends of the vertical axis, if the problem states them
    within       the ends of the declared range of the coordinate; None for an end that is not finite
    """

    branches: tuple[Branch, ...]
    energy: Any
    coordinate: Any
    against: Any
    ends: tuple[Any, ...] = ()
    within: tuple[Any, Any] = (None, None)

    @property
    def drawn(self) -> tuple[Any, ...]:
        """Return the values and the conditions that determine the branches."""
        return tuple(value for each in self.branches for value in each.drawn)


@dataclass(frozen=True)
class Plot:
    """A curve: a quantity as a function of one symbol, over a range of this symbol; or the path of two quantities.

    expr, variable   the value of the quantity, and the symbol that varies: on the horizontal axis, or along a path
    lower, upper     the range, used if the problem gives no other range
    kind, of         the kind of the quantity, and the kind of the symbol, for their units
    unit             the SI unit of a quantity without a kind
    across           the quantity on the horizontal axis of a path, along which `variable` increases
    levels           the curves of a phase portrait of `expr`; `label` and `unit` belong to its vertical axis
    others           curves of other quantities of the same kind in the same panel
    outlines         surfaces in the plane of a path
    diagram          the equilibria of a bifurcation diagram, in which `label` is their coordinate
    places           the values of the variable for which the solution has a symbol, such as r_0, with these symbols
    then             the value that the curves keep after their range
    per              divisors of the values, each with its name: on the horizontal axis, on the vertical axis, and for
                     the energies of a phase portrait
    energies         total energies, drawn as horizontal lines in the plot of a potential energy
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
    unit: str = ""
    across: Across | None = None
    levels: Levels | None = None
    others: tuple[Further, ...] = ()
    outlines: tuple[Outline, ...] = ()
    diagram: Diagram | None = None
    places: tuple[tuple[Any, Any], ...] = ()
    then: Any = None
    per: tuple[tuple[Any, Any], ...] = ()
    energies: tuple[Any, ...] = ()

    @property
    def each(self) -> tuple[Plot, ...]:
        """Return a plot for each quantity."""
        if not self.others:
            return (self,)
        own = tuple(key for key in self.keys if key not in {other.key for other in self.others})
        first = replace(self, keys=own, others=())
        return first, *(replace(first, label=each.label, expr=each.expr, keys=(each.key,)) for each in self.others)

    @property
    def labels(self) -> tuple[Any, ...]:
        """Return the names of the quantities on the vertical axis, each once."""
        return tuple(dict.fromkeys((self.label, *(other.label for other in self.others))))

    @property
    def shown(self) -> tuple[Any, ...]:
        """Return the values that the plot shows, except the values of the quantities in `others`."""
        if self.diagram is not None:
            return self.diagram.drawn
        return (self.expr,) if self.across is None else (self.across.expr, self.expr)

    @property
    def letters(self) -> set[Symbol]:
        return self.letters_of_curves | letters_in(self.ends)

    @property
    def letters_of_curves(self) -> set[Symbol]:
        """Return the symbols in all values that determine the curves and outlines, except the ends of the range and the
        two coordinates of the plane of an outline."""
        others = [other.expr for other in self.others]
        outlines = [value for each in self.outlines for value in (each.expr, *each.corners)]
        in_plane = {letter for each in self.outlines for letter in each.plane}
        kept = () if self.then is None else (self.then,)
        divisors = [*(value for _, value in self.per), *self.energies]
        return letters_in((*self.shown, *others, *kept, *self.values, *outlines, *divisors)) - in_plane

    @property
    def ends(self) -> tuple[Any, ...]:
        """Return the ends of the range; for a phase portrait or a diagram, also the ends of the vertical axis."""
        up = (self.levels.low, self.levels.high) if self.levels else self.diagram.ends if self.diagram else ()
        return (self.lower, self.upper, *up)

    @property
    def named_across(self) -> Any:
        """Return the name of the horizontal axis of curves, of a phase portrait or of a diagram."""
        return self.diagram.against if self.diagram else self.variable

    @property
    def values(self) -> tuple[Any, ...]:
        """Return the values on the curves of a phase portrait."""
        return tuple(value for value, _ in self.levels.values) if self.levels else ()

    @property
    def varies(self) -> set[Symbol]:
        """Return the symbols that vary in the plot, and therefore have no number."""
        return {self.variable, *((self.levels.up,) if self.levels else ())}

    @property
    def unit_up(self) -> str:
        """Return the unit of the vertical axis."""
        return self.unit or unit_of_kind(self.kind)


def components_in(thing: Any) -> set[int]:
    """Return the numbers of components, 2 or 3, of all positions and directions in marks, at any depth."""
    if isinstance(thing, tuple | list):
        return {count for each in thing for count in components_in(each)}
    if isinstance(thing, Mark):
        return components_in([getattr(thing, f.name) for f in fields(thing) if not f.metadata.get("beside")])
    return {thing.rows} if isinstance(thing, MatrixBase) else set()


def letters_in(thing: Any) -> set[Symbol]:
    """Return all symbols in the positions and directions of marks, at any depth, but not the symbols in labels."""
    if isinstance(thing, tuple | list):
        return {letter for each in thing for letter in letters_in(each)}
    if isinstance(thing, Mark):
        return letters_in([getattr(thing, f.name) for f in fields(thing) if not f.metadata.get("beside")])
    return {s for s in getattr(thing, "free_symbols", ()) if isinstance(s, Symbol)}


Recorded: TypeAlias = Drawing | Plot


def noted(drawing: Recorded) -> Recorded:
    """Record the drawing and return it. An invalid name is rejected, and so is the name of an earlier drawing."""
    if not _DRAWING_NAME.fullmatch(drawing.key):
        help_line = "use at most 32 lower-case letters, digits and _, beginning with a letter"
        raise Rejected(Complaint("drawing-name", f"`{drawing.key}` cannot name a drawing", help=help_line))
    run = current_run.get()
    if run is not None:
        if any(other.key == drawing.key for other in run.drawings):
            message = f"two drawings are both called `{drawing.key}`"
            raise Rejected(Complaint("key-clash", message, help="give one of them another name"))
        run.drawings.append(drawing)
    return drawing


def flat(marks: Marks) -> Iterator[Mark]:
    """Yield all marks of nested lists."""
    if isinstance(marks, Mark):
        yield marks
    else:
        for each in marks:
            yield from flat(each)
