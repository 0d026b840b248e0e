"""`plot` and `curves` under `drawings:`: curves of answers, paths of two answers or formulas, phase portraits,
bifurcation diagrams."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from sympy import Expr, Integer, Symbol

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import TIME, explicit, scalar, stand_in
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension, unit_of_dimension, unit_of_kind
from derive.course.expression import Declared, names_in
from derive.course.given import read_end
from derive.course.placement import Placement, Range
from derive.course.stock import told_at
from derive.course.yaml_tree import Formula as LetterOrRatio
from derive.course.yaml_tree import Scalar, Word
from derive.errors import did_you_mean, rejected
from derive.figures import plot
from derive.figures.marks import Across, Diagram, Further, Levels, Outline, Plot, letters_in, noted
from derive.mechanics import Coordinate
from derive.mechanics.kinematics.places import Location
from derive.mechanics.lagrange.momenta import letter_of_momentum
from derive.steps.record import current_run
from derive.steps.step import Quantity
from derive.stock.answering.diagrams import Equilibria, Parameter, equilibria_of, ratio
from derive.stock.keys.formulas import Formula, dimension_of_answer, right_side
from derive.units import read_unit

ZERO = Integer(0)
_LETTER = re.compile(r"[A-Za-z]+(_[A-Za-z0-9]+)?", re.ASCII)


@dataclass(frozen=True)
class Shown:
    """An answer or a formula that a plot needs, such as a quantity of a path or the ratio of a diagram."""

    label: Any
    expr: Expr
    kind: str
    unit: str
    keys: tuple[str, ...]


@dataclass(frozen=True)
class Plotted:
    """A plot that a problem requests.

    named         a function that returns the steps that a name denotes
    coordinates   the coordinates of the system, by name
    surfaces      a function that returns the surfaces, by name
    shown         the keys of the steps that parts ask for
    """

    drawing: Placement
    named: Callable[[Word], tuple[Quantity, ...]]
    coordinates: Mapping[str, Coordinate]
    surfaces: Callable[[], Mapping[str, Any]] = dict
    shown: Collection[str] = ()

    def draw(self, against: LetterOrRatio, ends: Range) -> None:
        """Draw the plot against a coordinate, the time or a declared symbol; a diagram may also be against a ratio."""
        if self.drawing.is_diagram:
            self._diagram(self.drawing.plot[0], against, ends)
        elif self.drawing.curves:
            self._curves(self.drawing.curves, against, ends)
        elif len(self.drawing.plot) == 1:
            self._curve(self.drawing.plot[0], against, ends)
        else:
            self._path([self._shown(each.scalar) for each in self.drawing.plot], against, ends)

    def _curve(self, answer: Word, against: Word, ends: Range) -> None:
        quantity = self._one(answer)
        variable, kind = self._variable(against, *self._letters_of_curve(answer, quantity, against))
        (lower, upper), keys = self._range(ends, kind)
        with told_at(answer.place):
            unit = self._unit(quantity)
            plot(self.drawing.key, quantity, variable, (lower, upper), of=kind, also=keys, unit=unit)
        self._keep(unit)

    def measure(self) -> None:
        """Add to the recorded plot the energies of its horizontal lines, and the quantities by which the values on its
        axes are divided."""
        run, written = current_run.get(), self.drawing.per
        if run is None or not (written or self.drawing.energies):
            return
        found = run.drawings.pop()
        assert isinstance(found, Plot)
        if self.drawing.energies:
            found = self._with_energies(found)
        if not written:
            run.drawings.append(found)
            return
        if found.diagram is not None:
            message = "`per` has no effect on a bifurcation diagram"
            rejected("wrong-argument", message, written[0].place, "write a ratio in `against`")
        units = [found.across.unit if found.across else unit_of_kind(found.of), found.unit_up]
        units += [found.levels.unit] if found.levels else []
        if len(written) != len(units):
            message = f"`per` of this plot must have {len(units)} quantities, but has {len(written)}"
            rejected(
                "wrong-argument",
                message,
                written[0].place,
                "`1` leaves an axis in its unit; only a phase portrait has a third quantity, for its levels",
            )
        per, keys = [], list(found.keys)
        for divisor, unit in zip(written, units, strict=True):
            shown = self._shown(divisor.scalar)
            if shown.expr != 1 and _dimension(shown.unit) != _dimension(unit):
                message = f"`{divisor}` is in {shown.unit or 'no unit'}, but it divides values in {unit or 'no unit'}"
                rejected("wrong-argument", message, divisor.place)
            per.append((shown.label, shown.expr))
            keys += shown.keys
        run.drawings.append(replace(found, per=tuple(per), keys=tuple(dict.fromkeys(keys))))

    def _with_energies(self, found: Plot) -> Plot:
        written = self.drawing.energies
        shown = [self._shown(each.scalar) for each in written]
        energy = dimension_of_kind("energy")
        if found.across or found.levels or found.diagram or found.others or _dimension(found.unit_up) != energy:
            message = f"`energies` has no effect on `{found.key}`, which is not the single curve of an energy"
            rejected("wrong-argument", message, written[0].place, "leave it out")
        for each, node in zip(shown, written, strict=True):
            if each.expr != 0 and _dimension(each.unit) != energy:
                rejected("wrong-argument", f"`{node}` is in {each.unit or 'no unit'}, not in J", node.place)
        keys = tuple(dict.fromkeys((*found.keys, *(key for each in shown for key in each.keys))))
        return replace(found, energies=tuple(each.expr for each in shown), keys=keys)

    def _curves(self, answers: Sequence[Word], against: Word, ends: Range) -> None:
        quantities = [self._one(answer) for answer in answers]
        for i, (answer, quantity) in enumerate(zip(answers, quantities, strict=True)):
            if answer in answers[:i]:
                rejected("twice", f"`{answer}` has two curves", answer.place, "leave one of them out")
            variable, kind = self._variable(against, *self._letters_of_curve(answer, quantity, against))
            self._check_unit(answer, quantity, answers[0], quantities[0])
        (lower, upper), keys = self._range(ends, kind)
        first, *more = quantities
        others = tuple(Further(each.symbol, explicit(each.value), each.key) for each in more)
        with told_at(answers[0].place):
            noted(
                Plot(self.drawing.key, first.symbol, explicit(first.value), variable, lower, upper,
                     first.step.kind or "number", kind, tuple(q.key for q in quantities) + keys,
                     self._unit(first), others=others)
            )  # fmt: skip
        self._keep(self._unit(first))

    def _keep(self, unit: str) -> None:
        """Add to the recorded plot the value `then`, which the curves keep after their range."""
        run, then = current_run.get(), self.drawing.then
        if run is None or then is None:
            return
        shown = self._shown(then.scalar)
        if shown.unit != unit:
            message = f"`{then}` is in {shown.unit or 'no unit'}, but the curves are in {unit or 'no unit'}"
            rejected("wrong-argument", message, then.place)
        found = run.drawings.pop()
        assert isinstance(found, Plot)
        run.drawings.append(replace(found, then=shown.expr, keys=tuple(dict.fromkeys((*found.keys, *shown.keys)))))

    def _unit(self, quantity: Quantity) -> str:
        """Return the SI unit of an answer, from its kind or its dimension."""
        if quantity.step.kind:
            return unit_of_kind(quantity.step.kind)
        return unit_of_dimension(dimension_of_answer(quantity, self._letters))

    def _letters_of_curve(self, answer: Word, quantity: Quantity, against: Word) -> tuple[set[Any], str]:
        """Return the letters of an answer, and the message of the error if `against` is not one of them."""
        expr = explicit(quantity.value)
        message = f"`{answer}` does not depend on `{against}`, so there is no curve"
        return expr.free_symbols if isinstance(expr, Expr) else set(), message

    def _check_unit(self, answer: Word, quantity: Quantity, other: Word, first: Quantity) -> None:
        one, two = (self._unit(each) for each in (quantity, first))
        if one != two:
            message = (
                f"`{answer}` is in {one or 'no unit'} and `{other}` in {two or 'no unit'}, so they need different axes"
            )
            rejected("wrong-argument", message, answer.place, "draw two plots")

    def _path(self, shown: list[Shown], against: Word, ends: Range) -> None:
        across, up = self._named(shown)
        written = " nor ".join(f"`{each}`" for each in self.drawing.plot)
        message = f"neither {written} depends on `{against}`, so there is no path"
        variable, kind = self._variable(against, across.expr.free_symbols | up.expr.free_symbols, message)
        (lower, upper), keys = self._range(ends, kind)
        horizontal = Across(across.label, across.expr, across.unit)
        keys = tuple(dict.fromkeys((*across.keys, *up.keys, *keys)))
        outlines = tuple(self._outline(name, (across, up)) for name in self.drawing.surfaces)
        with told_at(self.drawing.plot[0].place):
            noted(
                Plot(self.drawing.key, up.label, up.expr, variable, lower, upper, up.kind, kind, keys, up.unit,
                     horizontal, outlines=outlines)
            )  # fmt: skip

    def _named(self, shown: list[Shown]) -> list[Shown]:
        for label in self.drawing.labels:
            if not _LETTER.fullmatch(label):
                message = f"`{label}` is not a letter, so it cannot name an axis"
                rejected("wrong-argument", message, label.place, "write a letter, such as `x`, `r_1` or `theta`")
        names = self.drawing.labels or [None] * len(shown)
        return [replace(each, label=scalar(name)) if name else each for name, each in zip(names, shown, strict=True)]

    def _outline(self, name: Word, shown: tuple[Shown, Shown]) -> Outline:
        """Return the outline of a surface, which must be at rest and in the plane of the path."""
        known = self.surfaces()
        if name not in known:
            rejected("undefined-name", f"no surface is called `{name}`", name.place, did_you_mean(name, known))
        surface, plane = known[name], (stand_in("x"), stand_in("y"))
        moving = {TIME, *(each.symbol for each in self.coordinates.values())}
        if len(surface.place.components) != 2 or any(each.unit != unit_of_kind("length") for each in shown):
            message = f"a path of these quantities cannot show `{name}`"
            help_line = "only a path of two lengths, for a motion in a plane, shows surfaces"
            rejected("wrong-argument", message, name.place, help_line)
        expr = explicit(surface.distance(Location(plane)))
        if expr.free_symbols & moving:
            rejected("wrong-argument", f"`{name}` moves, so a path cannot show it", name.place, "leave it out")
        corners = tuple(explicit(c) for corner in surface.corners for c in corner.components)
        return Outline(str(name), expr, plane, corners)

    def _diagram(self, answer: Word, against: LetterOrRatio, ends: Range) -> None:
        with told_at(answer.place):
            found = equilibria_of(answer, self.named(answer), self.named(Word.at("stability", answer.place)))
            q = found.coordinate
            moving = self.coordinates[q.name]
            parameter = self._parameter(against, found)
            branches = tuple(map(parameter.branch, found.branches))
        (lower, upper), keys = self._range(ends, parameter.kind)
        axis: list[Expr] = []
        keys_up: tuple[str, ...] = ()
        for name, both in self.drawing.over.items():
            if name != q.name:
                message = f"`{name}` is not on the vertical axis of the diagram"
                rejected("wrong-argument", message, name.place, f"this axis shows `{q.name}`")
            axis, keys_up = self._range(both, moving.kind)
        energy = parameter.put_in(found.energy)
        diagram = Diagram(branches, energy, q, parameter.name, tuple(axis), found.within)
        used = (*found.keys(self.shown), *parameter.keys, *keys, *keys_up)
        with told_at(answer.place):
            noted(
                Plot(self.drawing.key, q, ZERO, parameter.symbol, lower, upper, moving.kind, parameter.kind,
                     tuple(dict.fromkeys(used)), diagram=diagram)
            )  # fmt: skip

    def _parameter(self, against: LetterOrRatio, found: Equilibria) -> Parameter:
        known = {symbol.name: symbol for branch in found.branches for symbol in letters_in(branch.drawn)}
        declared = self.drawing.letters.get(str(against))
        if declared is not None:
            parameter = Parameter(declared.symbol, declared.symbol, declared.kind)
        else:
            shown = self._shown(against.scalar)
            if shown.unit:
                message = f"`{against}` is in {shown.unit}, so it is not dimensionless"
                help_line = "the parameter of a diagram is a letter or a dimensionless ratio, such as `omega/omega_c`"
                rejected("wrong-argument", message, against.place, help_line)
            names = [self._letters[name].symbol for name in names_in(against.scalar) if name in self._letters]
            letters = [letter for letter in names if letter in shown.expr.free_symbols]
            parameter = ratio(shown.label, shown.expr, letters, against, shown.keys)
        replaced = parameter.letter[0] if parameter.letter else parameter.symbol
        if replaced not in known.values():
            message = f"neither the equilibria nor their stability depends on `{replaced.name}`, so there is no diagram"
            rejected("wrong-argument", message, against.place, did_you_mean(against, known))
        return parameter

    def draw_levels(self) -> None:
        """Draw a phase portrait: curves in the plane of a coordinate and its momentum."""
        answer, over = self.drawing.plot[0], self.drawing.over
        function = self._one(answer)
        if function.step.kind != "energy":
            message = f"`{answer}` is not an energy, so it has no phase portrait"
            rejected("wrong-argument", message, answer.place, "plot a Hamiltonian: `plot: hamiltonian`")
        q, p = self._plane(answer, {symbol.name: symbol for symbol in explicit(function.value).free_symbols})
        moving = self.coordinates[q.name]
        dimension = dimension_of_kind("energy") * dimension_of_kind("time") / dimension_of_kind(moving.kind)
        (lower, upper), keys = self._range(over[Word(q.name)], moving.kind)
        (low, high), keys_up = self._range(over[Word(p.name)], kind_of_dimension(dimension) or "number")
        found = [self._end(value.scalar, "energy") for value in self.drawing.levels]
        values = tuple((value, bool(value.free_symbols)) for value, _ in found)
        levels = Levels(p, low, high, values, unit_of_kind("energy"))
        used = (function.key, *keys, *keys_up, *(key for _, own in found for key in own))
        unit, shown = unit_of_dimension(dimension), explicit(function.value)
        portrait = Plot(self.drawing.key, p, shown, q, lower, upper, "number", moving.kind, unit=unit, levels=levels)
        with told_at(answer.place):
            noted(replace(portrait, keys=tuple(dict.fromkeys(used))))

    def _plane(self, answer: Word, letters: Mapping[str, Symbol]) -> tuple[Symbol, Symbol]:
        """Return the coordinate and the momentum of a phase portrait."""
        names = list(self.drawing.over)
        momenta = {name: letter_of_momentum(q).name for name, q in self.coordinates.items()}
        for name in names:
            if name not in letters:
                message = f"`{answer}` does not depend on `{name}`, so it has no phase portrait over `{name}`"
                rejected("wrong-argument", message, name.place, did_you_mean(name, letters))
        for one, other in (names, names[::-1]):
            if momenta.get(str(one)) == other:
                return letters[one], letters[other]
        help_line = f"such as {' and '.join(f'`{name}`' for name in next(iter(momenta.items())))}" if momenta else None
        message = f"`{names[0]}` and `{names[1]}` are not a coordinate and its momentum"
        rejected("wrong-argument", message, names[0].place, help_line)

    def _one(self, answer: Word) -> Quantity:
        quantities = self.named(answer)
        if len(quantities) != 1:
            message = f"`{answer}` denotes several results, but a plot needs one result here"
            rejected("wrong-argument", message, answer.place)
        return quantities[0]

    def _variable(self, against: Word, letters: set[Any], message: str) -> tuple[Symbol, str]:
        """Return the symbol that varies, and its kind."""
        known = {symbol.name: symbol for symbol in letters}
        moving, declared = self.coordinates.get(str(against)), self.drawing.letters.get(str(against))
        kind = moving.kind if moving else "time" if against == TIME.name else declared.kind if declared else None
        if kind is None and str(against) in known:
            message = f"`{against}` is not a coordinate, a rate, `t` or a symbol under `symbols`"
            rejected("wrong-argument", f"{message}, so it cannot vary in a plot", against.place)
        if kind is None or str(against) not in known:
            rejected("wrong-argument", message, against.place, did_you_mean(against, known))
        return known[str(against)], kind

    # --- formulas ----------------------------------------------------------------------------------------------------

    @cached_property
    def _letters(self) -> dict[str, Declared]:
        return {**self.drawing.letters, TIME.name: Declared(TIME.name, TIME, "time")}

    def _shown(self, node: Scalar) -> Shown:
        """Return an answer or a formula of answers, in the symbols of the problem."""
        formula = Formula(node, self._letters)
        expression, dimension, found = formula.with_dimension(self._one)
        label = expression.xreplace({mark: quantity.symbol for mark, quantity in found.items()})
        expr = expression.xreplace({mark: explicit(right_side(quantity.value)) for mark, quantity in found.items()})
        kind = self._kind(expression, found)
        unit = unit_of_kind(kind) if kind else unit_of_dimension(dimension)
        return Shown(label, explicit(expr), kind or "number", unit, tuple(q.key for q in found.values()))

    def _kind(self, expression: Expr, found: Mapping[Any, Quantity]) -> str | None:
        if expression in found:
            return found[expression].step.kind
        return next((letter.kind for letter in self._letters.values() if letter.symbol == expression), None)

    def _range(self, ends: Range, kind: str) -> tuple[list[Expr], tuple[str, ...]]:
        """Return the two ends, and the keys of the answers in them."""
        found, keys = [], []
        for node in ends.ends:
            end, own = self._end(node.scalar, kind)
            found.append(end)
            keys += own
        return found, tuple(keys)

    def _end(self, node: Scalar, kind: str) -> tuple[Expr, list[str]]:
        formula = Formula(node, self._letters)
        marks, found = formula.marks(self._one)
        end = read_end(node, kind, {**self._letters, **marks})
        end = end.xreplace({mark: explicit(right_side(quantity.value)) for mark, quantity in found.items()})
        return explicit(end), [quantity.key for quantity in found.values()]


def _dimension(unit: str) -> Dimension:
    return read_unit(unit).dimension if unit else NUMBER
