"""A formula of answers: an expression in declared symbols and in the names of answers, `pi*rate/frequency`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from sympy import Dummy, Expr

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import Relation, explicit
from derive.course.expression import Declared, letters_in, read_expression
from derive.course.measures import is_number_with_unit
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import rejected
from derive.steps.derivation import with_ancestors
from derive.steps.homogeneity import dimension_of, dimension_table
from derive.steps.step import Quantity


@dataclass(frozen=True)
class OfKnownDimension(Declared):
    """A symbol whose dimension is known from a value, such as the placeholder of an answer."""

    has: Dimension | None = None

    @property
    def dimension(self) -> Dimension:
        assert self.has is not None
        return self.has


@dataclass(frozen=True)
class FoundLetter(Declared):
    """The symbol of an unknown that is also an answer, such as a constraint force; in a formula this symbol denotes the
    answer."""


@dataclass(frozen=True)
class Formula:
    """An expression whose names are symbols or answers. If a name is a symbol and also an answer, the name denotes the
    symbol, unless the symbol is a `FoundLetter`."""

    node: Scalar
    letters: Mapping[str, Declared]

    @property
    def answers(self) -> tuple[Word, ...]:
        """Return the names in the formula that are taken to be names of answers."""
        if is_number_with_unit(self.node):
            return ()
        given = {name for name, letter in self.letters.items() if not isinstance(letter, FoundLetter)}
        found = {str(name): name for name in letters_in(self.node) if name not in given}
        return tuple(found.values())

    def with_answers(self, answers: Callable[[Word], Quantity]) -> tuple[Expr, dict[Any, Quantity]]:
        """Return the expression with a placeholder for each answer, and the mapping placeholder -> answer."""
        expression, _, found = self.with_dimension(answers)
        return expression, found

    def with_dimension(self, answers: Callable[[Word], Quantity]) -> tuple[Expr, Dimension, dict[Any, Quantity]]:
        """Return the same as `with_answers`, and the dimension of the expression."""
        marks, found = self.marks(answers)
        expression, dimension = read_expression(self.node, {**self.letters, **marks})
        return expression, dimension, found

    def marks(self, answers: Callable[[Word], Quantity]) -> tuple[dict[str, Declared], dict[Any, Quantity]]:
        """Return the placeholder of each answer by name, and the mapping placeholder -> answer."""
        found = {name: answers(name) for name in self.answers}
        marks: dict[str, Declared] = {str(name): self._mark(name, quantity) for name, quantity in found.items()}
        return marks, {marks[name].symbol: quantity for name, quantity in found.items()}

    def _mark(self, name: Word, quantity: Quantity) -> OfKnownDimension:
        """Return a placeholder symbol for an answer, with its dimension."""
        value = explicit(right_side(quantity.value))
        if not isinstance(value, Expr):
            rejected("wrong-argument", f"`{name}` is not a number", name.place)
        mark = Dummy(str(name), real=True, positive=True if value.is_positive else None)
        return OfKnownDimension(str(name), mark, "", has=dimension_of_answer(quantity, self.letters))


def dimension_of_answer(quantity: Quantity, letters: Mapping[str, Declared]) -> Dimension:
    """Return the dimension of an answer or, if the answer is a relation, of its right side. An answer of unknown
    dimension counts as a number.

    letters     the symbols of the problem, by name
    """
    declared = {letter.symbol: letter.dimension for letter in letters.values()}
    table, _ = dimension_table(declared, [q.step for q in with_ancestors([quantity]).values()])
    has = dimension_of(explicit(right_side(quantity.value)), table)
    return has if has is not None else Dimension()


def right_side(value: Any) -> Any:
    """Return the right side of a relation; any other value is unchanged."""
    return value.right if isinstance(value, Relation) else value


def formula(node: Tree, letters: Mapping[str, Declared]) -> Formula:
    """Return the formula that is written at this place in the file."""
    if not isinstance(node, Scalar) or node.empty:
        rejected("wrong-type", "a formula must be an expression such as `pi*rate/frequency`", node.place)
    return Formula(node, letters)
