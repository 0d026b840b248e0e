"""The data of a bifurcation diagram, `plot: equilibria` under `drawings:`, from the steps of the solution."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Expr, Mul, Symbol, factor
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Relation, explicit, stand_in
from derive.algebra.ranges import range_of
from derive.algebra.tidy import tidied
from derive.course.yaml_tree import Word
from derive.errors import rejected
from derive.figures.marks import Branch
from derive.mechanics.rest.facts import RestOf, Shape, StableWhere
from derive.steps.step import Quantity, is_zero
from derive.witness.facts import Rest


@dataclass(frozen=True)
class Equilibria:
    """The equilibria of one coordinate, and the steps that decide their stability."""

    rests: tuple[Quantity, ...]
    judged: tuple[Quantity, ...]

    @property
    def coordinate(self) -> Symbol:
        return self.rests[0].needed(RestOf).coordinates[0]

    @property
    def within(self) -> tuple[Expr | None, Expr | None]:
        """Return the ends of the range of the coordinate; None for an end that is not finite."""
        known = range_of(self.coordinate)
        least, greatest = (known.least, known.greatest) if known is not None else (None, None)
        return (
            least if least is not None and least.is_finite else None,
            greatest if greatest is not None and greatest.is_finite else None,
        )

    @property
    def energy(self) -> Expr:
        return explicit(self.rests[0].needed(RestOf).potential.value)

    @property
    def branches(self) -> tuple[Branch, ...]:
        pairs = zip(self.rests, self.judged, strict=True)
        return tuple(_branch(rest, self.coordinate, judged) for rest, judged in pairs)

    def keys(self, shown: Collection[str]) -> tuple[str, ...]:
        """Return the keys that parts ask for, among the equilibria and the steps about their stability. If parts ask
        for none of these, return the keys of all equilibria."""
        every = [q.key for q in (*self.rests, *self.judged)]
        return tuple(key for key in every if key in shown) or tuple(q.key for q in self.rests)


def equilibria_of(answer: Word, rests: Sequence[Quantity], judged: Sequence[Quantity]) -> Equilibria:
    """Return the equilibria with the step that decides the stability of each of them.

    judged   the results of `stability`
    """
    if len(rests[0].needed(RestOf).coordinates) != 1:
        message = "the equilibria have several coordinates, so no diagram of one coordinate shows them"
        rejected("wrong-argument", message, answer.place, "plot one result against a letter")
    found = []
    for rest in rests:
        (place,) = rest.needed(Rest).values.values()
        own = [q for q in judged if (shape := q.fact(Shape)) is not None and is_zero(shape.place - place)]
        if not own:
            message = f"`stability` does not decide whether `{rest.key}` is stable, so there is no diagram"
            help_line = "leave out `at` under `given`; then `stability` is about all equilibria"
            rejected("wrong-argument", message, answer.place, help_line)
        if own[0].fact(StableWhere) is None and not own[0].step.outcome.startswith(("stable", "unstable")):
            message = f"the stability of `{rest.key}` is not known, so there is no diagram"
            rejected("wrong-argument", message, answer.place, "plot the potential energy instead")
        found.append(own[0])
    return Equilibria(tuple(rests), tuple(found))


def _branch(rest: Quantity, q: Symbol, judged: Quantity) -> Branch:
    state, where = rest.needed(Rest), judged.fact(StableWhere)
    stable = where.condition if where is not None else judged.step.outcome.startswith("stable")
    exists = explicit(state.exists) if state.exists is not None else None
    return Branch(rest.symbol, explicit(state.values[q]), exists, explicit(stable) if where else stable, rest.key)


# --- the parameter ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Parameter:
    """The quantity on the horizontal axis: a letter, or a symbol for a ratio that replaces a letter.

    name      the name of the axis
    symbol    the letter, or the symbol of the ratio
    kind      the kind of the quantity
    letter    the replaced letter, and its value in terms of the ratio; None if the axis shows a letter
    keys      the keys of the answers and of the defined quantities in the ratio
    """

    name: Any
    symbol: Symbol
    kind: str
    letter: tuple[Symbol, Expr] | None = None
    keys: tuple[str, ...] = ()

    def put_in(self, value: Expr) -> Expr:
        return tidied(value.xreplace(dict([self.letter]))) if self.letter is not None else value

    def branch(self, branch: Branch) -> Branch:
        exists, stable = (
            self._condition(each) if isinstance(each, Relation) else each for each in (branch.exists, branch.stable)
        )
        return Branch(branch.label, self.put_in(branch.place), exists, stable, branch.key)

    def _condition(self, condition: Relation) -> Relation:
        value = self.put_in(explicit(condition.residual))
        try:
            factors = Mul.make_args(factor(value))
        except PolynomialError:
            factors = (value,)
        kept = [each for each in factors if each.has(self.symbol) or not each.is_positive]
        return Relation(Mul(*kept), condition.operator, 0)


def ratio(name: Any, expr: Expr, letters: Sequence[Symbol], against: Word, keys: tuple[str, ...]) -> Parameter:
    """Return the parameter for a ratio such as omega/omega_c, which replaces a letter to which it is proportional."""
    for letter in letters:
        rest = tidied(expr / letter)
        if not rest.has(letter):
            symbol = stand_in("x", positive=True) if expr.is_positive else stand_in("x")
            return Parameter(name, symbol, "number", (letter, symbol / rest), keys)
    message = f"`{against}` is not proportional to any of its letters, so it cannot be the parameter of a diagram"
    rejected("wrong-argument", message, against.place, "write a letter or a ratio, such as `omega` or `omega/omega_c`")
