"""The data with which answers are graded: right answers with their dimensions, numbers and points."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from sympy import Expr, Integer, MatrixBase, MatrixSymbol, Symbol

from derive.algebra.amplitudes import Amplitudes
from derive.algebra.dimensions import Dimension
from derive.algebra.equality import Grade
from derive.algebra.expressions import (
    PLUS_MINUS,
    TIME,
    Amount,
    At,
    BodyRate,
    CarriedRate,
    MatrixAmount,
    Relation,
    Slope,
    TimeRate,
    explicit,
    rate,
)
from derive.algebra.kinds import dimension_of_kind
from derive.algebra.order import Order
from derive.algebra.ranges import Range
from derive.algebra.rounding import Rounded
from derive.audit.time_limit import FAULTS
from derive.course.problem import Problem
from derive.grading.names import Names, parts_of
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from derive.render.printing.text_blocks import named_result
from derive.steps.derivation import Derivation
from derive.steps.homogeneity import dimension_of, dimension_table
from derive.steps.step import Step

ONE: Expr = Integer(1)
# if the left side of a relation contains one of these, the relation states the value of its left side
_NAMED_RATES = (TimeRate, CarriedRate, BodyRate, Slope, At)


@dataclass(frozen=True)
class Number:
    """The exact number of an answer in SI units, and the unit and the figures that the problem asks for."""

    exact: Expr
    unit: str = ""
    factor: Expr = ONE
    figures: int = 4


@dataclass(frozen=True)
class Target:
    """One answer of a part.

    symbol   the name of the answer, if it has one: a symbol, or an expression such as tan(delta)
    value    a formula, a matrix or a relation
    of_set   whether the value is a set of values, in any order
    scaled   whether the value is known up to a factor only, such as the amplitudes of a mode
    own      the points of the answer in the rubric
    whole    the points of the answer and of the steps before it
    numbers  the numbers of the components, if the value is a vector whose letters have numbers
    """

    key: str
    label: str
    symbol: Any
    value: Any
    kind: str | None
    dimension: Dimension | None
    text: str
    number: Number | None = None
    of_set: bool = False
    scaled: bool = False
    exact: bool = True
    own: Fraction = Fraction(1)
    whole: Fraction = Fraction(1)
    numbers: tuple[Number, ...] = ()

    @property
    def is_relation(self) -> bool:
        return isinstance(self.value, Relation)


@dataclass(frozen=True)
class Part:
    label: str
    targets: tuple[Target, ...]
    extra: bool = False


@dataclass(frozen=True)
class Key:
    """The answers of a problem, part by part, and what is known about its symbols.

    steps         each step of the derivation with its value, to recognise an answer to another question
    definitions   the value of each symbol that a step introduces
    allowed       defined symbols that an answer may contain, such as beta = b/(2 m)
    points        whether the problem has points; without points each part counts 1
    momenta       for each momentum that is a variable of the Hamiltonian, its value in terms of the rates
    """

    problem: str
    parts: tuple[Part, ...]
    steps: tuple[Target, ...]
    names: Names
    wholes: Mapping[tuple[str, str], MatrixBase]
    definitions: Mapping[Symbol, Expr]
    allowed: frozenset[Symbol]
    dimensions: Mapping[Any, Dimension | None]
    coordinates: frozenset[Symbol]
    ranges: Mapping[Symbol, Range]
    order: Order
    kinds: Mapping[Symbol, str] = field(default_factory=dict)
    points: bool = False
    momenta: Mapping[Symbol, Expr] = field(default_factory=dict)
    notation: Notation = field(default_factory=Notation, compare=False, repr=False)

    def part(self, name: str) -> Part | None:
        """Return a part by its name, with all its answers or only one: `b(2)` is part b with only its second answer.
        Return None if there is no such part or answer."""
        plain, inner = _split(name)
        label = label_in([part.label for part in self.parts], plain)
        if label is None:
            return None
        part = next(part for part in self.parts if part.label == label)
        if not inner:
            return part
        index = int(inner) - 1 if inner.isdecimal() and len(inner) < 4 else None
        chosen = [t for i, t in enumerate(part.targets) if i == index or t.key == inner]
        return replace(part, targets=tuple(chosen)) if chosen else None

    @property
    def told(self) -> list[tuple[str, str]]:
        """Return the labels of the parts, and the names of the answers that each part asks for."""
        return [(part.label, ", ".join(target.key for target in part.targets)) for part in self.parts]

    @cached_property
    def targets(self) -> tuple[Target, ...]:
        return tuple(target for part in self.parts for target in part.targets)


def label_in(labels: Sequence[str], name: str) -> str | None:
    """Return the label for a name such as `b`, `(b)`, `B`, `2` or `part b`; None if there is no such part."""
    plain = _split(name)[0]
    if plain in labels:
        return plain
    return labels[int(plain) - 1] if plain.isdecimal() and len(plain) < 4 and 0 < int(plain) <= len(labels) else None


def _split(name: str) -> tuple[str, str]:
    """Split `2(1)` or `b.1` into the names of a part and of one of its answers."""
    plain = name.strip().lower().removeprefix("part").strip()
    found = re.fullmatch(r"\(?([a-z]|\d{1,3})[).:]?(?:\s*[(.]?\s*(\w+)\s*\)?)?", plain, re.ASCII)
    if found is None:
        return plain, ""
    return found[1], found[2] or ""


def key_of(
    problem: Problem,
    derivation: Derivation,
    values: Mapping[str, Step],
    credits: Mapping[str, Mapping[str, Fraction]] | None = None,
) -> Key:
    """Return the key of a derived problem.

    credits   the points that steps earn, by the label of the part and the key of the step
    """
    dimensions, _ = dimension_table(problem.dimensions, derivation.steps)
    notation = Notation(dimensions)
    made = _Making(problem, derivation, values, dimensions, notation)
    parts = []
    for index, part in enumerate(problem.parts):
        label = chr(ord("a") + index)
        steps = derivation.answering(part.answers)
        points = dict(credits.get(label, {})) if credits else None
        targets = [made.target(step, label) for step in steps]
        parts.append(Part(label, tuple(_with_points(targets, points)), part.extra))
    moving = {q for step in derivation.steps for q, _ in step.coordinates}
    return Key(
        problem.id, tuple(parts), tuple(made.target(step, made.label_of(step)) for step in derivation.steps),
        Names.of(made.symbols), made.wholes, made.definitions, frozenset(made.allowed), dimensions, frozenset(moving),
        problem.ranges, problem.order,
        {q: kind for step in derivation.steps for q, kind in step.coordinates}, bool(credits), made.momenta,
        notation,
    )  # fmt: skip


def _with_points(targets: list[Target], points: Mapping[str, Fraction] | None) -> Iterator[Target]:
    """Divide the points of a part among its answers in proportion to the points of the answers in the rubric. If there
    is no rubric, or if an answer has no points there, divide them equally."""
    if points is None:
        yield from (replace(each, own=Fraction(1, len(targets)), whole=Fraction(1, len(targets))) for each in targets)
        return
    total = sum(points.values(), Fraction(0))
    own = [points.get(each.key, Fraction(0)) + points.get(f"{each.key}_value", Fraction(0)) for each in targets]
    stated = sum(own, Fraction(0))
    for each, mine in zip(targets, own, strict=True):
        part = mine / stated if all(own) else Fraction(1, len(targets))
        yield replace(each, own=mine or total * part, whole=total * part)


class _Making:
    def __init__(
        self,
        problem: Problem,
        derivation: Derivation,
        values: Mapping[str, Step],
        dimensions: Mapping[Any, Dimension | None],
        notation: Notation,
    ):
        self.problem, self.derivation, self.values = problem, derivation, values
        self.dimensions, self.notation = dimensions, notation
        self.symbols: dict[Any, None] = {TIME: None}
        self.wholes: dict[tuple[str, str], MatrixBase] = {}
        self.definitions: dict[Symbol, Expr] = {}
        self.momenta: dict[Symbol, Expr] = {}
        self.allowed: set[Symbol] = {each.symbol for each in problem.defined}
        self._collect()

    def _collect(self) -> None:
        for declared in self.problem.letters:
            self.symbols[declared.symbol] = None
        for step in self.derivation.steps:
            for coordinate, _ in step.coordinates:
                for order in range(3):
                    self.symbols[rate(coordinate, order) if order else coordinate] = None
            value = _explicit(step.result)
            for name, of in self._named(step, value):
                self.symbols.setdefault(name)
                if isinstance(name, Symbol) and isinstance(of, Expr) and name not in of.free_symbols:
                    self.definitions.setdefault(name, of)
                    if all(each.grade is Grade.DEFINITION for each in step.evidence):
                        self.allowed.add(name)
            if isinstance(step.symbol, MatrixSymbol):
                self.symbols.setdefault(step.symbol)
                if isinstance(value, MatrixBase):
                    base, sub, _ = parts_of(step.symbol.name)
                    self.wholes.setdefault((base, sub), value)
            for symbol in sorted(getattr(value, "free_symbols", ()), key=str):
                self.symbols.setdefault(symbol)
        for asked in (step for part in self.problem.parts for step in self.derivation.answering(part.answers)):
            free: set[Any] = getattr(_explicit(asked.result), "free_symbols", set())
            self.allowed |= {each for each in free if each in self.definitions}
        self.symbols.pop(PLUS_MINUS, None)
        coordinates = {q for step in self.derivation.steps for q, _ in step.coordinates}
        rates = {rate(q) for q in coordinates}
        for moving in coordinates:
            for symbol in (moving, rate(moving), rate(moving, 2)):  # x(t) = ... does not define x or its rates
                value = self.definitions.pop(symbol, None)
                if value is not None and symbol == moving and value.free_symbols & rates:
                    self.momenta[symbol] = value

    def _named(self, step: Step, value: Any) -> Iterator[tuple[Any, Any]]:
        yield from ((name, _explicit(of)) for name, of in step.names if isinstance(name, Symbol))
        if isinstance(step.symbol, Symbol):
            yield step.symbol, value
        elif isinstance(step.symbol, MatrixBase) and isinstance(value, MatrixBase):
            yield from zip(step.symbol, value, strict=True)

    def label_of(self, step: Step) -> str:
        index = next((i for i, part in enumerate(self.derivation.parts) if step.key in part), None)
        return "" if index is None else chr(ord("a") + index)

    def target(self, step: Step, label: str) -> Target:
        value, symbol = _explicit(step.result), step.symbol
        is_mode = isinstance(step.result, Amplitudes) and not isinstance(symbol, MatrixBase)
        scaled = is_mode or (step.kind == "number" and isinstance(value, MatrixBase))
        if isinstance(step.result, Relation) and step.result.left.has(*_NAMED_RATES):
            symbol, value = step.result.left, _explicit(step.result.right)
        of_set = isinstance(symbol, MatrixBase) and isinstance(value, MatrixBase)
        of_set = of_set and len({parts_of(str(each))[0] for each in symbol}) == 1  # I_1, I_2, I_3, but not r_1, theta_1
        text = in_one_line(named_result(step, self.notation))
        number = self._number(step, value)
        return Target(
            step.key,
            label,
            symbol,
            value,
            step.kind,
            self._dimension(step, value),
            text,
            number,
            of_set,
            scaled,
            step.exact,
            numbers=() if of_set or scaled else self._numbers(step, value),
        )

    def _dimension(self, step: Step, value: Any) -> Dimension | None:
        if step.kind:
            return dimension_of_kind(step.kind)
        if isinstance(value, Relation):
            value = value.right
        try:
            return dimension_of(value, self.dimensions)
        except Exception:
            return None

    def _numbers(self, step: Step, value: Any) -> tuple[Number, ...]:
        if not step.kind or not isinstance(value, MatrixBase) or value.cols != 1:
            return ()
        found = [self._number(step, entry) for entry in value]
        return tuple(each for each in found if each is not None) if None not in found else ()

    def _number(self, step: Step, value: Any) -> Number | None:
        shown = self.values.get(step.key)
        expr = value.right if isinstance(value, Relation) else value
        if not isinstance(expr, Expr):
            return None
        exact = expr.xreplace({m.symbol: m.si for m in self.problem.measured})
        if exact.free_symbols or not exact.is_number or exact.is_real is False:
            return None
        for form in reversed(shown.chain if shown else ()):
            amount = form.expr.right if isinstance(form.expr, Relation) else form.expr
            if isinstance(amount, Amount) and isinstance(amount.args[0], Rounded):
                return Number(exact, str(amount.args[1].name), amount.args[2], int(amount.args[0].args[1]))
            if isinstance(amount, MatrixAmount):
                figures = [int(entry.args[1]) for entry in amount.args[0] if isinstance(entry, Rounded)]
                factor = amount.args[2] if len(amount.args) > 2 else Integer(1)
                return Number(exact, str(amount.args[1].name), factor, max(figures, default=self.problem.figures))
            if isinstance(amount, Rounded):
                return Number(exact, "", Integer(1), int(amount.args[1]))
        return Number(exact, figures=self.problem.figures)


def _explicit(value: Any) -> Any:
    try:
        return explicit(value)
    except FAULTS:
        return value
