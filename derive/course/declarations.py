"""The letters that a file declares, each with its kind and with the range that the file states for it."""

from __future__ import annotations

import re
from collections.abc import Mapping as Table

from sympy import Expr, oo

from derive.algebra.expressions import TIME
from derive.algebra.kinds import about_kind, dimension_of_kind, kind_with_article, unit_of_kind
from derive.algebra.ranges import POSITIVE, Range
from derive.course.expression import RESERVED, Declared, letters_in, read_expression
from derive.course.given import symbol_of_kind
from derive.course.measures import Wanted, number_with_unit
from derive.course.problem_file import SortOfLetter
from derive.course.yaml_tree import Scalar, Word, abridged
from derive.errors import Faults, rejected

_SYMBOL = re.compile(r"[A-Za-z][A-Za-z0-9]{0,15}(_[A-Za-z0-9]{1,8}){0,2}")
INFINITE = {"infinity": oo, "-infinity": -oo}
_RANGE = re.compile(r"\s*([\[(])([^,]+),([^,]+)([\])])\s*")


def read_range(name: str, node: Scalar, kind: str, signed: bool = False) -> Range:
    """Read the range in which a letter lies: `(0, pi/2)`, `[0, 90 deg]`, `(0, infinity)`.

    If `signed` is true, as for a coordinate, the letter may be negative even if its kind is usually positive.
    """
    found = _RANGE.fullmatch(node.text)
    if not found:
        message = f"`{abridged(node.text)}` is not a range for `{name}`"
        rejected("range", message, node.place, "write `in (0, pi/2)`, or `in [0, pi/2]` to include its ends")
    least, greatest = (_end(name, node.piece(found.start(i), found.end(i) - found.start(i)), kind) for i in (2, 3))
    if least == -oo and found[1] == "[" or greatest == oo and found[4] == "]":
        rejected("range", f"`{name}` cannot be infinite", node.place, "exclude that end, as in `(0, infinity)`")
    if not (greatest - least).is_extended_positive:
        message = f"the range of `{name}` is from {least} to {greatest}, but its first end must be less than its second"
        rejected("range", message, node.place)
    if about_kind(kind).positive and not about_kind(kind).signed and not signed and least.is_negative:
        message = f"`{name}` is {kind_with_article(kind)}, which is positive, but its range begins below zero"
        rejected("range", message, node.place)
    return Range(least, greatest, (found[1] == "[", found[4] == "]"), " ".join(node.text.split()))


def _end(name: str, node: Scalar, kind: str) -> Expr:
    wanted, text = Wanted(name, kind), node.text.strip()
    if text in INFINITE:
        return INFINITE[text]
    number = number_with_unit(node, wanted, {})
    if number is not None:
        return number.si
    if letters_in(node):
        rejected("range", f"the ends of a range must be numbers, but `{text}` has letters", node.place)
    expr, dimension = read_expression(node, None)
    bare = expr.is_Rational and unit_of_kind(kind) != ""
    if not expr.is_zero and (bare or dimension != dimension_of_kind(kind)):
        wanted.refuse("missing-unit", f"`{node.text.strip()}` needs a unit: {wanted.must_be_it}", node.place)
    return expr


def declared_letters(kinds: Table[Word, SortOfLetter], faults: Faults) -> dict[str, Declared]:
    symbols = {}
    for word, kind in kinds.items():
        name = str(word)
        check_name(word, faults)
        if name == TIME.name and kind != "time":
            message = f"`t` is the time, but it is declared as {kind_with_article(kind)}"
            faults.error("time", message, word.place, help="use another letter")
        lies = range_of_sort(name, kind, faults)
        symbols[name] = Declared(name, symbol_of_kind(name, kind, lies), str(kind), lies)
    return symbols


def check_name(word: Word, faults: Faults) -> None:
    """Check that a word can be the name of a letter."""
    if not _SYMBOL.fullmatch(word) or word in RESERVED:
        why = "has a meaning of its own" if word in RESERVED else "is not a letter or a name such as `omega_0`"
        faults.error("symbol", f"`{word}` {why}, so it cannot be declared", word.place)


def range_of_sort(name: str, sort: SortOfLetter, faults: Faults) -> Range | None:
    """Return the range that a declaration states. Without a range, return POSITIVE if the declaration says `positive`
    and the kind does not already imply this; otherwise, and after an error, return None.
    """
    if sort.ends:
        with faults:
            return read_range(name, sort.ends, sort)
        return None
    return POSITIVE if sort.positive and not about_kind(sort).positive else None
