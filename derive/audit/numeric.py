"""Numbers for expressions and nodes at a few fixed points.

A point gives a number to each letter. A letter that earlier rows define has the value of its definition there.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from sympy import Expr, MatrixBase, Symbol

from derive.audit.fingerprint import CLOSE, FUNCTIONS, at, number_of
from derive.documents.meaning import FUNCTIONS as NAMED
from derive.documents.meaning import INVERSE, Meaning, Meaningless
from derive.documents.syntax import Add, Frac, Fun, Group, Letter, Mul, Node, Num, Pow, Root

Point = Mapping[Symbol, complex]


class NoNumber(Exception):
    """An expression has no number at a point."""


def close(one: complex, other: complex) -> bool:
    return abs(one - other) <= CLOSE * max(abs(one), abs(other), 1e-9)


@dataclass
class Numbers:
    """The numbers of letters and of nodes at one point; `defined` gives the expanded definition of a letter."""

    meaning: Meaning
    defined: Callable[[Symbol], Expr]
    point: int
    fixed: dict[Symbol, complex] = field(default_factory=dict)
    of_letters: dict[Symbol, complex] = field(default_factory=dict)
    of_nodes: dict[int, tuple[Node, complex]] = field(default_factory=dict)  # the kept node prevents reuse of its id

    def of_symbol(self, symbol: Symbol) -> complex:
        if symbol in self.fixed:
            return self.fixed[symbol]
        if symbol not in self.of_letters:
            value = self.defined(symbol)
            if value is symbol or value == symbol:
                self.of_letters[symbol] = complex(number_of(symbol.name, self.point))
            else:
                self.of_letters[symbol] = at(value, self.basic)
        return self.of_letters[symbol]

    def basic(self, symbol: Symbol) -> complex:
        return self.fixed[symbol] if symbol in self.fixed else complex(number_of(symbol.name, self.point))

    def of(self, value: Expr) -> complex:
        return at(value, self.of_symbol)

    def of_node(self, node: Node) -> complex:
        kept = self.of_nodes.get(id(node))
        if kept is not None:
            return kept[1]
        value = self._of_node(node)
        self.of_nodes[id(node)] = (node, value)
        return value

    def _of_node(self, node: Node) -> complex:
        if isinstance(node, Group):
            return self.of_node(node.inner)
        if isinstance(node, Add):
            return sum(
                ((1 if sign == "+" else -1) * self.of_node(term) for sign, term in node.terms if sign in "+-"), 0j
            )
        if isinstance(node, Mul) and not any(self.is_matrix(each) for _, each in node.factors):
            result = 1 + 0j
            for _, each in node.factors:
                result *= self.of_node(each)
            return result
        if isinstance(node, Frac):
            return self.of_node(node.top) / self.of_node(node.bottom)
        if isinstance(node, Pow) and not self.is_matrix(node.base) and not _is_euler(node.base):
            return complex(self.of_node(node.base) ** self.of_node(node.exponent))
        if isinstance(node, Root) and node.index is None:
            return cmath.sqrt(self.of_node(node.inner))
        if isinstance(node, Fun) and node.base is None and node.name in NAMED:
            value = complex(FUNCTIONS[NAMED[node.name]](self.of_node(node.argument)))  # type: ignore[index]
            if node.power is None:
                return value
            power = self.of_node(node.power)
            if power == -1 and node.name in INVERSE:
                raise NoNumber
            return value**power
        if isinstance(node, Num):
            return complex(float(node.text))
        value = self.meaning.of(node)
        if isinstance(value, MatrixBase):
            raise NoNumber
        return self.of(value)

    def is_matrix(self, node: Node) -> bool:
        if isinstance(node, Letter):
            return isinstance(self.meaning.of(node), MatrixBase)
        return not isinstance(node, Add | Mul | Frac | Pow | Root | Fun | Num | Group) or any(
            self.is_matrix(each) for each in node.kids
        )


def _is_euler(node: Node) -> bool:
    return isinstance(node, Letter) and node.base == "e"


def spanned(rows: Sequence[Sequence[complex]], wanted: Sequence[complex]) -> bool:
    """Whether a row of numbers is a combination of other rows."""
    width = len(wanted)
    matrix = [list(each) for each in rows]
    rest = list(wanted)
    used = 0
    for column in range(width):
        pivot = max(range(used, len(matrix)), key=lambda i: abs(matrix[i][column]), default=None)
        if pivot is None or abs(matrix[pivot][column]) < 1e-9:
            continue
        matrix[used], matrix[pivot] = matrix[pivot], matrix[used]
        top = matrix[used]
        for i in range(used + 1, len(matrix)):
            factor = matrix[i][column] / top[column]
            if factor:
                matrix[i] = [a - factor * b for a, b in zip(matrix[i], top, strict=True)]
        factor = rest[column] / top[column]
        rest = [a - factor * b for a, b in zip(rest, top, strict=True)]
        used += 1
    size = max(map(abs, wanted), default=0.0) or 1.0
    return all(abs(each) < 1e-7 * size for each in rest)


def determined(rows: Sequence[Sequence[complex]], column: int, constant: int) -> complex | None:
    """Return the value of one unknown of linear equations, or None if they do not determine it.

    Each row has the coefficients of one equation: `column` is the index of the unknown, and `constant` is the index of
    the constant term.
    """
    order = [i for i in range(len(rows[0])) if i not in (column, constant)] + [column, constant]
    matrix = [[row[i] for i in order] for row in rows]
    used = 0
    for position in range(len(order) - 1):
        pivot = max(range(used, len(matrix)), key=lambda i: abs(matrix[i][position]), default=None)
        if pivot is None or abs(matrix[pivot][position]) < 1e-9:
            continue
        matrix[used], matrix[pivot] = matrix[pivot], matrix[used]
        top = matrix[used]
        if position == len(order) - 2:
            return -top[-1] / top[-2]
        for i in range(used + 1, len(matrix)):
            factor = matrix[i][position] / top[position]
            if factor:
                matrix[i] = [a - factor * b for a, b in zip(matrix[i], top, strict=True)]
        used += 1
    return None


__all__ = ["Meaningless", "NoNumber", "Numbers", "at", "close", "determined", "spanned"]
