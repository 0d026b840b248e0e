"""The key `define:` of a problem: quantities with a formula, such as `omega_0: sqrt(k/m)`, that results may use."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from derive.algebra.dimensions import Dimension
from derive.algebra.natural import is_positive
from derive.algebra.ranges import within
from derive.course.declarations import check_name
from derive.course.expression import Declared, check_constant, read_expression
from derive.course.yaml_tree import Formula, Word
from derive.errors import Faults, rejected


@dataclass(frozen=True)
class Defined(Declared):
    """A defined quantity. Its formula contains declared letters and quantities that are defined earlier."""

    formula: Expr = field(kw_only=True)
    of_dimension: Dimension = field(kw_only=True)

    @property
    def dimension(self) -> Dimension:
        return self.of_dimension


def read_defined(
    written: Mapping[Word, Formula], letters: Mapping[str, Declared], moving: Collection[str], faults: Faults
) -> tuple[Defined, ...]:
    """Return the defined quantities in the order of the file.

    letters  the declared letters
    moving   the names that the description introduces, such as coordinates; a formula must not contain them
    """
    found: dict[str, Defined] = {}
    ranges = {letter.symbol: letter.lies for letter in letters.values() if letter.lies}
    for word, formula in written.items():
        with faults, within(ranges):
            found[str(word)] = _defined(word, formula, {**letters, **found}, moving, faults)
    return tuple(found.values())


def _defined(
    word: Word, formula: Formula, known: Mapping[str, Declared], moving: Collection[str], faults: Faults
) -> Defined:
    check_name(word, faults)
    name = str(word)
    if name in known or name in moving:
        message = f"`{name}` already has a meaning in this problem, so it cannot be defined"
        rejected("letter-clash", message, word.place, "choose another letter")
    check_constant(formula.scalar, moving, "define", "use letters with constant values, such as `omega_0: sqrt(k/m)`")
    constant = {each: letter for each, letter in known.items() if each not in moving}
    value, dimension = read_expression(formula.scalar, constant)
    if not value.free_symbols:
        message = f"`{name}` would be the number {value}, but the value of its formula must contain letters"
        rejected("wrong-argument", message, formula.place, "such as `omega_0: sqrt(k/m)`")
    symbol = Symbol(name, real=True, positive=True) if is_positive(value) else Symbol(name, real=True)
    return Defined(name, symbol, "number", formula=value, of_dimension=dimension)
