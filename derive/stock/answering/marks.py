"""`marks` and `like` under `drawings:`. A problem adds marks, such as points and arrows, to a drawing of the engine, or
repeats another drawing."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, MatrixBase, Rational, cos, pi, sin, sqrt

from derive.algebra.dimensions import Dimension
from derive.algebra.equality import equal
from derive.algebra.expressions import AXES, explicit, scalar
from derive.course.expression import read_expression
from derive.course.placement import Placement
from derive.course.problem_file import MarkKeys
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Formula as Written
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.course.yaml_tree import Sequence as SequenceNode
from derive.errors import did_you_mean, rejected
from derive.figures.annotations import AngleMark, Arrow, Cone, HollowPoint, Line, Turn
from derive.figures.marks import PLANE, Drawing, Mark, Surface, noted
from derive.figures.parts import ConnectionMark
from derive.figures.positions import SIDES, value_and_keys
from derive.figures.surroundings import AngleBetween, DistanceMark, WayMark
from derive.steps.record import current_run
from derive.steps.step import Quantity
from derive.stock.keys.formulas import Formula

_LETTER = re.compile(r"[A-Za-z]+(_[A-Za-z0-9]+)?", re.ASCII)
PENS = {"line": "edge", "dashed": "trace"}
NEEDED = {
    "point": ("at",),
    "line": ("start", "end"),
    "dashed": ("start", "end"),
    "length": ("start", "end"),
    "arrow": ("at", "along"),
    "angle": ("at", "start", "end"),
    "turn": ("at",),
    "circle": ("at", "end"),
    "cone": ("end", "along"),
    "curve": ("at", "against", "between"),
}
ALSO = {
    "length": ("side",),
    "arrow": ("size",),
    "angle": ("size",),
    "turn": ("along", "size"),
    "circle": ("along",),
}
CALLED = {"start": "from", "end": "to", "between": "range"}
LONG, ROUND = {True: Rational(2, 5), False: Rational(5, 4)}, Rational(1, 5)
ANGLE = scalar("u")
COUNTERCLOCKWISE = ImmutableDenseMatrix([0, 0, 1])


@dataclass(frozen=True)
class Marked:
    """The marks of one drawing.

    drawing   the entry of `drawings:`
    place_of  a function that returns the place that is written in a node
    after     the key of the drawing after which a further drawing is placed
    """

    drawing: Placement
    place_of: Callable[[Tree, str, InLetters], MatrixBase]
    after: str = ""

    def add(self) -> None:
        """Add the marks to the recorded drawing, or record a further drawing that repeats another drawing."""
        run = current_run.get()
        drawings = run.drawings if run is not None else []
        shown = {each.key: each for each in drawings if isinstance(each, Drawing)}
        name = self.drawing.like or Word.at(self.drawing.key, self.drawing.place)
        if name not in shown:
            known = did_you_mean(name, shown) or f"the drawings are {', '.join(f'`{known}`' for known in shown)}"
            rejected("unknown-drawing", f"the engine draws nothing called `{name}`", name.place, known)
        found = replace(shown[name], marks=tuple(self._kept(shown[name].marks)))
        added = each([partial(self._mark, keys, found) for keys in self.drawing.adds])
        measured = {mark.label for mark in added if isinstance(mark, DistanceMark)} - {None}
        own_marks = (replace(mark, label=None) if mark.label in measured else mark for mark in found.marks)
        marks = (*own_marks, *added)  # a length with its own dimension line is not named twice
        named = {letter for mark in added for letter in getattr(mark.label, "free_symbols", ())}
        undrawn = tuple((sort, value) for sort, value in found.undrawn if value not in named)
        own = replace(found, marks=marks, undrawn=undrawn)
        if self.drawing.like:
            with told_at(self.drawing.place):
                noted(replace(own, key=self.drawing.key, forces_on=None, mode=None, leads_to=()))
            drawings.insert(drawings.index(shown[self.after]) + 1, drawings.pop())  # figures are numbered in this order
        else:
            drawings[drawings.index(shown[name])] = own

    def _kept(self, marks: Sequence[Mark]) -> Iterator[Mark]:
        """Yield the marks of a drawing, except marks whose labels the problem leaves out. A mark of the class `Surface`
        with such a label stays, but loses the label, unless the mark is a dashed line (`ConnectionMark`)."""
        labels = {str(mark.label) for mark in marks if mark.label is not None}
        for word in self.drawing.without:
            if word not in labels:
                rejected("wrong-argument", f"no mark has the label `{word}`", word.place, did_you_mean(word, labels))
        for mark in marks:
            if mark.label is None or str(mark.label) not in self.drawing.without:
                yield mark
            elif isinstance(mark, Surface) and not isinstance(mark, ConnectionMark):
                yield replace(mark, label=None)

    @cached_property
    def _letters(self) -> InLetters:
        return InLetters(self.drawing.letters)

    def _mark(self, keys: MarkKeys, drawing: Drawing) -> Mark:
        kind = str(keys.mark)
        is_plane = drawing.view == PLANE
        for name in NEEDED[kind]:
            if not keys.has(name) and not (name == "at" and not is_plane):
                message = f"the mark `{kind}` needs `{CALLED.get(name, name)}`"
                rejected("missing-key", message, keys.places[""])
        for name in ("at", "start", "end", "along", "side", "size", "against", "between"):
            if keys.has(name) and name not in (*NEEDED[kind], *ALSO.get(kind, ())):
                written = CALLED.get(name, name)
                rejected("unused-key", f"`{written}` has no effect on the mark `{kind}`", keys.places[written])
        with told_at(keys.places[""]):
            mark = self._cone(keys, drawing) if kind == "cone" else self._made(kind, keys, is_plane)
            return replace(mark, keys=tuple(dict.fromkeys(mark.keys)))

    def _made(self, kind: str, keys: MarkKeys, is_plane: bool) -> Mark:
        label, used = self._label(keys.label)
        rows = 2 if is_plane else 3
        if kind == "point":
            return HollowPoint(self._place(keys.at, "at", rows), label=label, keys=used)
        if kind in PENS:
            return Line(*self._ends(keys, rows), PENS[kind], label=label, keys=used)
        if kind == "length":
            start, end = self._ends(keys, rows)
            self._check_length(end - start, label, keys)
            return DistanceMark(start, end, on_paper=SIDES[keys.side] if keys.side else None, label=label, keys=used)
        at = self._place(keys.at, "at", rows)
        if kind == "curve":
            return self._curve(at, keys, label, used)
        size = self._size(keys.size)
        if kind == "angle":
            (a, first, is_place), (b, second, both) = (
                self._way(node, name, rows, at) for node, name in ((keys.start, "from"), (keys.end, "to"))
            )
            own = {"label": label, "keys": (*used, *first, *second)}
            if is_place and both and size is None:
                return AngleBetween(at, a, b, **own)
            return AngleMark(at, a, b, None, size, **own)
        if kind in ("turn", "circle"):
            around, own_keys = self._axis(keys.along)
            if kind == "circle":
                return WayMark(_circle(at, self._place(keys.end, "to", rows), around), ANGLE, -pi, pi, label=label)
            return Turn(at, around, size or ROUND, label=label, keys=(*used, *own_keys))
        along, own_keys, _ = self._way(keys.along, "along", rows)
        return Arrow(at, along, size or LONG[is_plane], bool(own_keys), label=label, keys=(*used, *own_keys))

    def _cone(self, keys: MarkKeys, drawing: Drawing) -> Mark:
        """Return the cone that an arrow of the drawing describes when it rotates about the axis `along`."""
        node = keys.end
        assert node is not None  # `_mark` rejects a cone without this key
        value, used, _ = self._way(node, "to", 3)
        arrows = (mark for mark in drawing.marks if isinstance(mark, Arrow))
        arrow = next((each for each in arrows if explicit(each.value) == value), None)
        if arrow is None:
            rejected("wrong-argument", "the drawing has no arrow of this vector", node.place)
        axis, own, _ = self._way(keys.along, "along", 3)
        return Cone(arrow.start, arrow.value, arrow.size, axis=axis, keys=(*used, *own))

    def _check_length(self, arm: MatrixBase, label: Any, keys: MarkKeys) -> None:
        known = {declared.symbol for declared in self._letters.letters.values()}
        if not isinstance(label, Expr) or not label.free_symbols or not label.free_symbols <= known:
            return
        if not equal(arm.dot(arm), label**2):
            message = f"the distance from `from` to `to` is not {keys.label}"
            rejected("wrong-argument", message, keys.places[""], "change an end of the line, or its label")

    def _curve(self, at: MatrixBase, keys: MarkKeys, label: Any, used: tuple[str, ...]) -> Mark:
        assert keys.against is not None and keys.between  # `_mark` rejects a curve without these keys
        letter, _ = read_expression(keys.against.scalar, self._letters.letters)
        if not letter.is_Symbol or not at.has(letter):
            message = f"`against` must be a letter on which `at` depends, but it is `{keys.against}`"
            rejected(
                "wrong-argument",
                message,
                keys.against.place,
                "write a letter in `against`, and a place with this letter in `at`",
            )
        lower, upper = (read_expression(end.scalar, self._letters.letters)[0] for end in keys.between)
        return WayMark(at, letter, lower, upper, "edge", label=label, keys=used)

    def _axis(self, node: Tree | None) -> tuple[MatrixBase, tuple[str, ...]]:
        return (COUNTERCLOCKWISE, ()) if node is None else self._way(node, "along", 3)[:2]

    def _ends(self, keys: MarkKeys, rows: int) -> tuple[MatrixBase, MatrixBase]:
        return self._place(keys.start, "from", rows), self._place(keys.end, "to", rows)

    def _place(self, node: Tree | None, name: str, rows: int) -> MatrixBase:
        """Return a place of the drawing, by default the origin."""
        if node is None:
            return ImmutableDenseMatrix([0] * rows)
        place = self.place_of(node, name, self._letters)
        if place.rows != rows:
            message = f"`{name}` has {place.rows} components, but the drawing needs {rows}"
            rejected("wrong-length", message, node.place)
        return place

    def _way(
        self, node: Tree | None, name: str, rows: int, start: MatrixBase | None = None
    ) -> tuple[MatrixBase, tuple[str, ...], bool]:
        """Return a direction, the keys of its steps, and whether it leads from `start` to a place."""
        if isinstance(node, SequenceNode):
            return self._components(node, name, rows), (), False
        if not isinstance(node, Scalar):
            return self._place(node, name, rows) - start, (), start is not None
        axis = node.text.removeprefix("-")
        if axis in AXES[:rows]:
            sign = -1 if node.text.startswith("-") else 1
            return ImmutableDenseMatrix([sign * int(axis == own) for own in AXES[:rows]]), (), False
        if start is None or node.text in self._steps:
            value, keys = value_and_keys(self._step(node.word))
            if not isinstance(explicit(value), MatrixBase) or explicit(value).shape != (rows, 1):
                rejected("wrong-argument", f"`{node.text}` is not a vector of {rows} components", node.place)
            return explicit(value), keys, False
        return self._place(node, name, rows) - start, (), True

    @property
    def _steps(self) -> dict[str, Quantity]:
        run = current_run.get()
        return {quantity.key: quantity for quantity in run.established} if run is not None else {}

    def _step(self, name: Word) -> Quantity:
        if name not in self._steps:
            message = f"no step of the solution is called `{name}`"
            rejected("no-such-answer", message, name.place, did_you_mean(name, self._steps))
        return self._steps[name]

    def _components(self, node: SequenceNode, name: str, rows: int) -> MatrixBase:
        found: list[tuple[Expr, Dimension]] = each([partial(self._component, item, name) for item in node.items])
        if len(found) != rows:
            rejected("wrong-length", f"`{name}` needs {rows} components", node.place)
        if len({dimension for value, dimension in found if not value.is_zero}) != 1:
            rejected("dimension", f"the components of `{name}` have different dimensions, or all are zero", node.place)
        return ImmutableDenseMatrix([value for value, _ in found])

    def _component(self, node: Tree, name: str) -> tuple[Expr, Dimension]:
        if not isinstance(node, Scalar) or node.empty:
            rejected("wrong-type", f"a component of `{name}` must be an expression", node.place)
        return read_expression(node, self._letters.letters)

    def _size(self, written: Written | None) -> Expr | None:
        """Return the size of an arrow, an angle or a rotation relative to the drawing, a positive number; None if the
        author states no size."""
        if written is None:
            return None
        size, _ = read_expression(written.scalar, None)
        if not size.is_number or not size.is_positive:
            rejected("not-positive", f"`size` must be a positive number, but `{written}` is not", written.place)
        return size

    def _label(self, written: Written | None) -> tuple[Any, tuple[str, ...]]:
        """Return the label and the keys of the answers whose letters it contains."""
        if written is None:
            return None, ()
        if str(written) in self._steps:
            step = self._steps[str(written)]
            return step.symbol, value_and_keys(step)[1]
        letters = self._letters.letters
        if _LETTER.fullmatch(written) and written not in letters:
            return scalar(str(written)), ()
        expression, found = Formula(written.scalar, letters).with_answers(self._step)
        label = expression.xreplace({mark: one.symbol for mark, one in found.items()})
        return label, tuple(key for one in found.values() for key in value_and_keys(one)[1])


def _circle(centre: MatrixBase, through: MatrixBase, around: MatrixBase) -> MatrixBase:
    """Return the point of the circle about `centre` at the angle ANGLE from the point `through`; in space, `around` is
    the axis of the circle."""
    arm = through - centre
    x, y = (arm[0], arm[1])
    across = ImmutableDenseMatrix([-y, x]) if arm.rows == 2 else around.cross(arm) / sqrt(around.dot(around))
    return centre + arm * cos(ANGLE) + across * sin(ANGLE)
