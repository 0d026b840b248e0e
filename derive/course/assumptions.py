"""The key `assume:` of a description: relations between letters, such as `a < b < c`, read and checked together."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from sympy import Expr, Symbol, oo

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import Relation
from derive.algebra.kinds import named
from derive.algebra.order import Contradiction, Order, in_order
from derive.algebra.ranges import POSITIVE, Range, sign_within, within
from derive.course.expression import Declared, check_constant, read_expression
from derive.course.yaml_tree import Scalar, Tree
from derive.errors import Faults, Place, rejected

ANY = Range(-oo, oo)
EXAMPLE = "write a relation such as `l < r_0` or `a < b < c`"
RESTRICTED = "to restrict a coordinate, write its range where you declare it, such as `theta: angle in (0, pi/2)`"
_MARK = re.compile(r"<=|>=|[<>=≤≥!]+")


@dataclass(frozen=True)
class Assumed:
    """One relation, and the place where it is written."""

    relation: Relation
    written: str
    place: Place


def read_assumed(node: Tree, constant: Mapping[str, Declared], moving: Iterable[str]) -> list[Assumed]:
    """Return the relations of one entry; a chain gives several.

    constant   the letters that a relation may contain
    moving     the names of coordinates, functions of the time and their rates, which a relation may not contain
    """
    if not isinstance(node, Scalar) or node.empty:
        rejected("wrong-type", "`assume` needs a list of relations between letters", node.place, EXAMPLE)
    marks = list(_MARK.finditer(node.text))
    if not marks:
        rejected("relation", f"`{node.text.strip()}` is not a relation", node.place, EXAMPLE)
    for mark in marks:
        if mark[0] not in {"<", "<=", ">", ">="}:
            place = node.place_within(mark.start(), mark.end() - mark.start())
            equal = "; to set letters equal, use `put_in`" if mark[0] in {"=", "=="} else ""
            help_line = f"use `<`, `<=`, `>` or `>=`{equal}"
            rejected("relation", f"`{mark[0]}` is not allowed under `assume`", place, help_line)
    if len({mark[0][0] for mark in marks}) > 1:
        rejected("relation", f"`{node.text.strip()}` mixes `<` and `>`", node.place, "write two relations")
    ends = [0, *(at for mark in marks for at in mark.span()), len(node.text)]
    pieces = [node.piece(first, last - first) for first, last in zip(ends[::2], ends[1::2], strict=True)]
    sides = [_side(piece, constant, {*moving}) for piece in pieces]
    found = []
    for (left, one), mark, (right, other) in zip(sides, marks, sides[1:], strict=False):
        if one != other and not left.is_zero and not right.is_zero:
            rejected("wrong-kind", f"{named(one)} is compared with {named(other)}", node.place)
        found.append(Assumed(Relation(left, mark[0], right), " ".join(node.text.split()), node.place))
    return found


def _side(piece: Scalar, constant: Mapping[str, Declared], moving: set[str]) -> tuple[Expr, Dimension]:
    if not piece.text.strip():
        rejected("relation", "one side of this relation is missing", piece.place, EXAMPLE)
    check_constant(piece, moving, "assume", RESTRICTED)
    return read_expression(piece, constant)


def narrowed(ranges: Mapping[Symbol, Range], assumed: Sequence[Assumed]) -> dict[Symbol, Range]:
    """Return the ranges of letters, narrowed by the relations that bound a letter by a number."""
    found = dict(ranges)
    for each in assumed:
        bound = _bound(each.relation)
        if bound is not None:
            letter, number, above, closed = bound
            found[letter] = _cut(found.get(letter, POSITIVE if letter.is_positive else ANY), number, above, closed)
    return found


def _bound(relation: Relation) -> tuple[Symbol, Expr, bool, bool] | None:
    """Return a letter, its numerical bound, whether the bound is an upper bound, and whether the letter may equal it.
    Return None if the relation does not compare a letter with a number."""
    (left, right), less = relation.sides, relation.operator[0] == "<"
    closed = relation.operator.endswith("=")
    if isinstance(left, Symbol) and right.is_number:
        return left, right, less, closed
    return (right, left, not less, closed) if isinstance(right, Symbol) and left.is_number else None


def _cut(known: Range, number: Expr, above: bool, closed: bool) -> Range:
    low, high = known.closed
    if above and (number < known.greatest or number == known.greatest and not closed):
        return Range(known.least, number, (low, closed))
    if not above and (number > known.least or number == known.least and not closed):
        return Range(number, known.greatest, (closed, high))
    return known


def order_of(
    assumed: Sequence[Assumed], ranges: Mapping[Symbol, Range], wrong: Callable[[Assumed], None] = lambda each: None
) -> Order:
    """Combine the relations into one order. `wrong` is called with each relation that contradicts the ranges or the
    earlier relations; this relation is left out."""
    order = Order()
    with within(ranges):
        for each in assumed:
            relation = each.relation
            difference = relation.residual if relation.operator[0] == ">" else -relation.residual
            try:
                with in_order(order):
                    order = order.with_relation(difference, not relation.operator.endswith("="), sign_within)
            except Contradiction:
                wrong(each)
    return order


def check_assumed(
    assumed: Sequence[Assumed], ranges: Mapping[Symbol, Range], numbers: Mapping[Symbol, Expr], faults: Faults
) -> None:
    """Report relations that contradict the ranges of their letters, the other relations or the given numbers."""

    def contradicts(each: Assumed) -> None:
        message = f"`{each.written}` contradicts what is known about these letters"
        help_line = "check the other relations, the ranges under `symbols`, and which kinds are positive"
        faults.error("contradiction", message, each.place, help=help_line)

    known = narrowed(ranges, [])
    for each in assumed:
        known = narrowed(known, [each])
        letter = next(iter(_bound(each.relation) or ()), None)
        if letter is not None and not (known[letter].greatest - known[letter].least).is_extended_positive:
            contradicts(each)
            return
    order_of([each for each in assumed if _bound(each.relation) is None], known, contradicts)
    for each in assumed:
        relation = each.relation
        apart = relation.residual.xreplace(dict(numbers))
        if apart.is_number and not _is_so(relation.operator, apart):
            message = f"`{each.written}` is not true for the given numbers"
            faults.error("contradiction", message, each.place, help="change the numbers or the relation")


def _is_so(mark: str, apart: Expr) -> bool:
    ahead = apart if mark[0] == ">" else -apart
    return bool(ahead.is_positive or mark.endswith("=") and ahead.is_zero)
