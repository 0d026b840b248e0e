"""What earlier rows of a document gave: definitions of letters, equations, and numbers for letters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import sympy
from sympy import Expr, Integral, MatrixBase, Symbol

from derive.audit.claims import Definition
from derive.documents.facts import Identity
from derive.documents.layout import Row
from derive.documents.meaning import Meaning, Value
from derive.documents.syntax import Letter

ROUNDS = 8  # rounds of substitution
LARGEST = 4000  # the greatest number of operations in an expression after substitution
LAST_EQUATIONS = 24
MOMENTA = ("p", "l", "L", "J", "ell")
INDICES_OF_COORDINATES = ("i", "j", "k", "n", "a", "μ")
ASSUMED = -1  # replaces the number of a claim if an equation is assumed


@dataclass
class Known:
    """The knowledge of one scope: a problem or a section of the document."""

    meaning: Meaning
    definitions: dict[Symbol, list[Definition]] = field(default_factory=dict)
    numbers: dict[Symbol, list[Definition]] = field(default_factory=dict)  # values without letters
    equations: list[tuple[Expr, int]] = field(default_factory=list)
    bounds: list[tuple[Symbol, str, Expr, int]] = field(default_factory=list)  # letter, relation, number, claim
    small: dict[int, Symbol] = field(default_factory=dict)  # claims `a << b`, with the small letter
    special: dict[Symbol, list[Definition]] = field(default_factory=dict)  # values in one case, `if R = a/2`
    slips: dict[Symbol, Definition] = field(default_factory=dict)  # the values that wrong rows give
    seen: set[Symbol] = field(default_factory=set)  # the letters of earlier claims
    conditions: set[int] = field(default_factory=set)  # claims that may hold in one case or at one instant only
    at_rest: set[int] = field(default_factory=set)  # conditions that hold at an equilibrium only
    sentence: frozenset[int] = frozenset()  # claims in the sentence before the current display
    here: frozenset[int] = frozenset()  # conditions that are used in the current row
    instants: dict[int, Identity] = field(default_factory=dict)  # claims `x = a` in sentences, with the coordinate x
    places: set[int] = field(default_factory=set)  # claims `s = h/sin(alpha)` with several letters
    moving: frozenset[Identity] = frozenset()  # coordinates whose rates are in the current row
    forced: set[str] = field(default_factory=set)  # coordinates, without index, whose Lagrange's equations have forces
    named: set[Symbol] = field(default_factory=set)  # letters to which a display gave a value
    kept: dict[object, Any] = field(default_factory=dict)  # results that were computed from this knowledge

    def define(
        self, symbol: Symbol, value: Expr, claim: int, implied: bool = False, row: Row | None = None, chain: int = -1
    ) -> None:
        if symbol in value.free_symbols or value.has(Integral):
            return
        if any(
            symbol in each.value.free_symbols
            for other in value.free_symbols
            for each in self.definitions.get(other, [])
        ):
            return  # the inverse of an earlier definition: x' = p/m after p = m x'
        for each in self.leading_to(symbol, value):
            del self.definitions[each]  # after l = m r^2 w and r_0 = l^2/b, the row r = r_0 + x makes l a constant
        if (own := self.computed(symbol)) is not None and symbol in self.meaning.derivatives:
            variables = {each for each, _ in self.meaning.derivatives[symbol][1]}
            if variables & own.value.free_symbols and not variables & value.free_symbols:
                return  # the value of a derivative at one place
        letter = self.meaning.symbols.get(symbol)
        component = letter is not None and letter.sub[-1:] in ("1", "2", "3")
        where = self.definitions if value.free_symbols or component else self.numbers
        new = Definition(symbol, value, claim, implied, row, chain)
        if (earlier := where.get(symbol)) and earlier[-1].part != new.part and earlier[-1].value != value:
            self.forget_derivatives(symbol)
        where.setdefault(symbol, []).append(new)

    def leading_to(self, symbol: Symbol, value: Expr) -> set[Symbol]:
        """Return the letters from which a value is computed and whose own definitions contain the symbol."""
        behind: set[Symbol] = set()
        waiting = set(value.free_symbols)
        while waiting:
            behind |= waiting
            found = [self.definitions[each][-1].value.free_symbols for each in waiting if each in self.definitions]
            waiting = set().union(*found) - behind
        return {s for s in behind if s in self.definitions and symbol in self.definitions[s][-1].value.free_symbols}

    def forget(self, claim: int) -> None:
        """Forget the value that a claim gives to a letter."""
        for symbol, found in list(self.definitions.items()):
            self.definitions[symbol] = [each for each in found if each.claim != claim]
            if not self.definitions[symbol]:
                del self.definitions[symbol]

    def forget_derivatives(self, symbol: Symbol) -> None:
        """Forget the values of the derivatives of a letter, and the equations that contain these derivatives, because a
        later part gives the letter a different value."""
        letter = self.meaning.symbols.get(symbol)
        changed = {
            each
            for each, (of, _, _) in self.meaning.derivatives.items()
            if letter is not None and of.identity == letter.identity
        }
        for each in changed:
            self.definitions.pop(each, None)
        self.equations = [
            (equation, claim) for equation, claim in self.equations if not equation.free_symbols & changed
        ]

    def assume(self, symbol: Symbol, value: Expr) -> None:
        """Remember the assumed value of a letter."""
        where = self.definitions if value.free_symbols else self.numbers
        if symbol not in value.free_symbols:
            where.setdefault(symbol, []).append(Definition(symbol, value, ASSUMED))

    def state(self, difference: Value, claim: int) -> None:
        """Remember an equation: the difference of its sides vanishes."""
        entries = list(difference) if isinstance(difference, MatrixBase) else [difference]
        for each in entries:
            if each != 0 and each.free_symbols:
                self.equations.append((each, claim))

    def with_slips(self) -> Known | None:
        """Return the same knowledge with the values that wrong rows give; None if no wrong row gives a value."""
        if not self.slips:
            return None
        believed = {symbol: [definition] for symbol, definition in self.slips.items()}
        return replace(self, definitions={**self.definitions, **believed}, slips={}, kept={})

    def new_letters(self, symbols: set[Symbol]) -> list[Symbol]:
        """Return the letters that no earlier claim contains; a rate or a derivative is new if its letter is new."""
        letters = self.meaning.symbols
        bases = {(found.identity if (found := letters.get(each)) else each) for each in self.seen}
        new = []
        for each in sorted(symbols, key=str):
            letter = letters.get(each)
            if each in self.meaning.derivatives:
                letter = self.meaning.derivatives[each][0]
            if each not in self.seen and (letter is None or letter.identity not in bases) and letter is not None:
                new.append(each)
        return new

    def is_defined(self, symbol: Symbol) -> bool:
        return symbol in self.definitions

    def latest(self, symbol: Symbol) -> Definition | None:
        found = self.definitions.get(symbol)
        if found and self.is_elsewhere(found[-1].claim):
            return None
        return found[-1] if found else self.computed(symbol)

    def is_at_instant(self, claim: int) -> bool:
        """Whether a claim such as `x = a` holds only at an instant, because the current row contains x'."""
        return self.instants.get(claim) in self.moving

    def has_no_rate(self, claim: int) -> bool:
        """Whether the rate of a coordinate cannot be computed from a claim such as `x = a`, because it may hold only at
        an instant. `r = l` may also be a constraint."""
        return self.is_at_instant(claim) or claim in self.places

    def is_elsewhere(self, claim: int) -> bool:
        """Whether a claim holds only at an instant that the sentence of the current row does not name."""
        return self.is_at_instant(claim) and claim not in self.sentence

    def surely(self, symbol: Symbol) -> Definition | None:
        """Return a definition of a letter that is valid in the current row, or None."""
        special = next((each for each in self.special.get(symbol, ()) if each.claim in self.here), None)
        if special is not None:
            return special
        found = self.latest(symbol)
        if found is None or found.claim in self.conditions:
            at = [*self.numbers.get(symbol, ()), *self.definitions.get(symbol, ())]
            here = next((each for each in reversed(at) if each.claim in self.here), None)
            return here or self.general_value(symbol)
        return found

    def general_value(self, symbol: Symbol) -> Definition | None:
        """Return the last value of a letter that does not hold in one case or at one instant only, or None."""
        found = reversed(self.definitions.get(symbol, ()))
        return next((each for each in found if each.claim not in self.conditions - self.here), None)

    def computed(self, symbol: Symbol) -> Definition | None:
        """Return the value of a rate, of a derivative or of a function at a place, computed from the definition of its
        letter; None if it cannot be computed."""
        if symbol in self.meaning.evaluations:
            function, variable, at = self.meaning.evaluations[symbol]
            inner = self.latest(function)
            if inner is None or variable not in inner.value.free_symbols:
                return None
            return Definition(symbol, inner.value.subs(variable, at), inner.claim)
        letter = self.meaning.symbols.get(symbol)
        if letter is not None and letter.dots:
            undotted = replace(letter, dots=letter.dots - 1)
            inner = self.latest(self.meaning.symbol(undotted))
            if inner is None or self.has_no_rate(inner.claim):
                return None
            time = self.meaning.symbol(Letter(letter.span, "t"))
            return Definition(symbol, self.meaning.differentiated(inner.value, time, False), inner.claim)
        if symbol in self.meaning.parents:
            parent, variable = self.meaning.parents[symbol]
            inner = self.latest(parent)
            if inner is None:
                return None
            return Definition(symbol, self.meaning.differentiated(inner.value, variable, False), inner.claim)
        if symbol in self.meaning.derivatives:
            letter, by, partial = self.meaning.derivatives[symbol]
            if len(by) == 1 and by[0][1] > 1:  # an earlier row may give the derivative of the next lower order
                lower = self.meaning.derivative_symbol(letter, ((by[0][0], by[0][1] - 1),), partial)
                if lower in self.definitions:
                    below = self.definitions[lower][-1]
                    return Definition(symbol, self.meaning.differentiated(below.value, by[0][0], partial), below.claim)
            inner = self.latest(self.meaning.symbol(letter))
            if inner is None:
                return None
            if any(self.is_general(each, inner.value) for each, _ in by):
                return None
            value = self.through(inner.value, {each for each, _ in by})
            for each, order in by:
                primed = self.meaning.written_with_prime(value, each)
                value = value.subs(primed, each) if primed is not None else value
                for _ in range(order):
                    value = self.meaning.differentiated(value, each, partial)
                value = value.subs(each, primed) if primed is not None else value
            return Definition(symbol, value, inner.claim)
        return None

    def is_general(self, symbol: Symbol, value: Expr) -> bool:
        """Whether a letter such as q_i means any coordinate, and a value contains no letter with the same base."""
        letters = self.meaning.symbols
        letter = letters.get(symbol)
        if letter is None or letter.base not in ("q", "p") and letter.sub not in INDICES_OF_COORDINATES:
            return False
        return all(letters[each].base != letter.base for each in value.free_symbols if each in letters)

    def forced_coordinates(self, value: Expr) -> set[str]:
        """Return the names, without index, of the coordinates of Lagrange's equations with a force, such as
        d/dt (dL/dx') - dL/dx = F; `q` stands for all coordinates."""
        found = [self.meaning.derivatives[each] for each in value.free_symbols if each in self.meaning.derivatives]
        variables = [[self.meaning.symbols.get(each) for each, _ in by] for of, by, _ in found if of.base == "L"]
        momenta = {by[0].base for by in variables if len(by) == 2 and by[0] is not None and by[0].dots}
        places = {by[0].base for by in variables if len(by) == 1 and by[0] is not None and not by[0].dots}
        has_force = any(not each.free_symbols & self.meaning.derivatives.keys() for each in sympy.Add.make_args(value))
        return momenta & places if has_force else set()

    def is_rate(self, symbol: Symbol) -> bool:
        letter = self.meaning.symbols.get(symbol)
        return letter is not None and letter.dots > 0

    def is_kinematic(self, symbol: Symbol) -> bool:
        """Whether the value of a rate or derivative can be computed. For a rate, the definition must not contain
        rates."""
        if self.computed(symbol) is None:
            return False
        letter = self.meaning.symbols.get(symbol)
        if letter is None or not letter.dots:
            return True
        inner = self.latest(self.meaning.symbol(replace(letter, dots=0)))
        rates = inner.value.free_symbols if inner is not None else set()
        return not any((found := self.meaning.symbols.get(each)) is not None and found.dots for each in rates)

    def is_momentum(self, symbol: Symbol) -> bool:
        """Whether a letter is a momentum, such as p = m x' in H(x, p); it is held fixed in derivatives with respect to
        coordinates."""
        letter, definition = self.meaning.symbols.get(symbol), self.definitions.get(symbol, [None])[-1]
        if letter is None or letter.base not in MOMENTA:
            return False
        if letter.base == "p" or definition is None:
            return letter.base == "p"
        rates = set(filter(self.is_rate, definition.value.free_symbols))
        doubled = definition.value.subs({each: 2 * each for each in rates}, simultaneous=True)
        return bool(rates) and bool(sympy.expand(doubled - 2 * definition.value) == 0)

    def through(self, value: Expr, wanted: set[Symbol]) -> Expr:
        """Substitute the definitions of all letters except `wanted`, the variables of a derivative.

        In a derivative with respect to a coordinate, the definitions of momenta are not substituted.
        """
        by_rate = any((each := self.meaning.symbols.get(symbol)) is not None and each.dots for symbol in wanted)
        for _ in range(ROUNDS):
            found = {}
            for symbol in value.free_symbols - wanted:
                if wanted and not by_rate and self.is_momentum(symbol):
                    continue
                definition = self.definitions.get(symbol, [None])[-1] or (
                    self.computed(symbol) if (letter := self.meaning.symbols.get(symbol)) and letter.dots else None
                )
                if definition is not None and symbol not in definition.value.free_symbols:
                    found[symbol] = definition.value
            if not found:
                break
            value = value.xreplace(found)
        return value

    def expanded(self, *values: Value) -> Iterator[tuple[tuple[Value, ...], tuple[int, ...]]]:
        """Yield the values after each round of substituting definitions, and the numbers of the claims used."""
        used: list[int] = []
        for _ in range(ROUNDS):
            free = set().union(*(each.free_symbols for each in values))
            found = {}
            for symbol in sorted(free, key=str):
                definition = self.latest(symbol)
                if definition is not None:
                    found[symbol] = definition.value
                    used.append(definition.claim)
            if not found:
                return
            try:
                values = tuple(each.xreplace(found) for each in values)
            except ValueError:  # a letter is the variable of an integral
                return
            if any(_size(each) > LARGEST for each in values):
                return
            yield values, tuple(dict.fromkeys(used))

    def with_numbers(self, *values: Value) -> tuple[tuple[Value, ...], tuple[int, ...]]:
        """Return the values after substituting the numbers that claims give to letters, and the claims used."""
        free = set().union(*(each.free_symbols for each in values))
        found = {s: each[-1] for s, each in self.numbers.items() if s in free and not self.is_elsewhere(each[-1].claim)}
        put_in = {symbol: each.value for symbol, each in found.items()}
        return tuple(each.xreplace(put_in) for each in values), tuple(each.claim for each in found.values())

    def recent(self) -> list[tuple[Expr, int]]:
        """Return the last equations, and forms of them in which zeros and derivatives are substituted."""
        last = self.equations[-LAST_EQUATIONS:]
        last_values = {symbol: each[-1] for symbol, each in self.numbers.items()}
        zeros = {s: each for s, each in last_values.items() if each.value == 0 and not self.is_elsewhere(each.claim)}
        put_in = []
        for equation, number in last[-6:] if zeros else ():
            used = [zeros[each].claim for each in sorted(equation.free_symbols & set(zeros), key=str)]
            if used:
                special = next((each for each in used if each in self.conditions), number)
                put_in.append((equation.subs(dict.fromkeys(zeros, 0)), special))
        last = last + [(each, number) for each, number in put_in if each != 0 and each.free_symbols]
        return last + [pair for each in last[-6:] for pair in self.with_derivatives(*each)]

    def with_derivatives(self, equation: Expr, number: int) -> Iterator[tuple[Expr, int]]:
        """Yield an equation after substituting the values of its derivatives."""
        found = {
            symbol: definition.value
            for symbol in equation.free_symbols
            if symbol in self.meaning.derivatives and (definition := self.latest(symbol)) is not None
        }
        if found:
            yield sympy.expand(equation.xreplace(found)), number


def _size(value: Value) -> int:
    return sum(map(sympy.count_ops, value)) if isinstance(value, MatrixBase) else int(sympy.count_ops(value))
