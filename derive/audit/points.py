"""Points at which earlier equations hold, with numbers for all letters.

A row that follows from the equations holds at each of these points. Newton's method finds the points; letters that
change with time are moved more than others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from sympy import Expr, Integer, Mul, Symbol, count_ops, expand, factor_terms

from derive.audit.fingerprint import at, number_of, size_at
from derive.audit.systems import Equation
from derive.audit.time_limit import FAULTS
from derive.documents.meaning import Meaning

STEPS = 12  # the greatest number of steps of Newton's method
TRIED = 8  # the greatest number of starting points of Newton's method
OTHER_STARTS = 2  # further starting points for an equation that has no solution near the first one
NEARER = 0.2  # the size of a step to another start, if too few points are found with steps of size 1
MOST_OPERATIONS = 6  # of an equation by which a letter may vanish
SLOPE = 1e-6  # the relative change of a letter with which a slope is computed
SMALL = 1e-10  # an equation with a smaller residual, relative to its terms, counts as satisfied
DAMPING = 1e-9  # the relative increase of the diagonal of the linear system
SMALLEST = 1e-3  # the smallest absolute value of a letter
LARGEST = 1e3  # the largest absolute value of a letter
OF_EITHER_SIGN = ("E", "H", "L", "U", "V")  # names of energies and Lagrangians
WEIGHTS = (0.05, 0.3, 1.0)  # the weights in changes: of constants, of coordinates, of rates and energies

Numbers = dict[Symbol, complex]


@dataclass
class Surface:
    """The points at which the equations hold. Equations that contradict earlier ones are left out."""

    equations: Sequence[Equation]
    meaning: Meaning
    kept: list[Equation] = field(default_factory=list)
    special: list[Equation] = field(default_factory=list)  # equations that hold only if a rate or coordinate vanishes
    zeros: set[Symbol] = field(default_factory=set)  # letters that vanish by an equation such as x' = 0
    points: list[Numbers] = field(default_factory=list)

    def find(self, count: int) -> Surface:
        self.zeros = self.letters_that_vanish()
        self.kept = [each for each in self.equations if self.vanishes(each)]
        here = self.begin(0)
        for each in self.equations:
            if each in self.kept:
                continue
            starts = [here, *map(self.begin, range(1, OTHER_STARTS + 1))]
            tried = (self.moved(start, [*self.kept, each]) for start in starts)
            found = next((there for there in tried if there is not None), None)
            if found is not None:
                here = found
                self.kept.append(each)
            elif any(self.moved(start, [*self.kept, each], vanishing=True) is not None for start in starts):
                self.special.append(each)
        self.points = [here]
        for step in (1.0, NEARER):
            for point in range(1, TRIED if len(self.points) < count else 0):
                found = self.moved(self.near(here, point, step), self.kept)
                self.points += [found] if found is not None else []
                if len(self.points) == count:
                    break
        return self

    def letters_that_vanish(self) -> set[Symbol]:
        """Return the letters that vanish by an equation such as m x'' = 0, or by y' = x' if x' vanishes."""
        found: dict[Symbol, Integer] = {}
        values = [each.value for each in self.equations if count_ops(each.value) <= MOST_OPERATIONS]
        grows = True
        while grows:
            factors = [Mul.make_args(value.xreplace(found)) for value in values]
            new = {each for each in map(self.only_factor_that_may_vanish, factors) if each is not None}
            found |= dict.fromkeys(new, Integer(0))
            grows = bool(new)
        return set(found)

    def only_factor_that_may_vanish(self, factors: Sequence[Expr]) -> Symbol | None:
        free = [each for each in factors if not each.is_number and not self.is_constant_letter(each)]
        return free[0] if len(free) == 1 and free[0].is_Symbol else None

    def is_constant_letter(self, factor: Expr) -> bool:
        letter = factor.as_base_exp()[0]
        return isinstance(letter, Symbol) and not self.has_either_sign(letter)

    def vanishes(self, equation: Equation) -> bool:
        """Whether an equation contains only letters that vanish, apart from factors of all terms."""
        short = count_ops(equation.value) <= MOST_OPERATIONS
        return short and bool(equation.value.xreplace(dict.fromkeys(self.zeros, Integer(0))) == 0)

    def begin(self, point: int) -> Numbers:
        letters = set().union(*(each.value.free_symbols for each in self.equations)) if self.equations else set()
        return {
            each: 0j if each in self.zeros else complex(number_of(each.name, point))
            for each in sorted(letters, key=str)
        }

    def near(self, here: Numbers, point: int, step: float) -> Numbers:
        """Return a start for another point: far from any solution, Newton's method often finds none."""
        ratios = {each: number_of(each.name, point) / number_of(each.name, 0) for each in here}
        return {each: value * (1 + step * (ratios[each] - 1)) for each, value in here.items()}

    def weight(self, symbol: Symbol) -> float:
        letter = self.meaning.symbols.get(symbol)
        if symbol in self.zeros:
            return 0.0
        if letter is None:
            return WEIGHTS[1]
        if letter.base in OF_EITHER_SIGN:
            return WEIGHTS[2]
        return WEIGHTS[2 if letter.dots else 1 if self.meaning.facts.changes(letter) else 0]

    def moved(self, start: Numbers, equations: Sequence[Equation], vanishing: bool = False) -> Numbers | None:
        """Return the point that Newton's method reaches, or None.

        vanishing   whether letters that may be negative may vanish there
        """
        here = dict(start)
        equations = [each for each in equations if not self.vanishes(each)]
        try:
            for _ in range(STEPS):
                residuals, slopes, sizes = [], [], []
                for each in equations:
                    value, slope = self.slopes(reduced(each.value), here)
                    size = size_at(reduced(each.value), here.__getitem__) or 1.0
                    residuals.append(value / size)
                    slopes.append({letter: s / size for letter, s in slope.items()})
                    sizes.append(abs(value) / size)
                if max(sizes, default=0.0) < SMALL:
                    return here if self.is_general(here, equations, vanishing) else None
                weights = {each: self.weight(each) ** 2 * max(abs(value), 0.1) ** 2 for each, value in here.items()}
                factors = _solved([[_times(one, other, weights) for other in slopes] for one in slopes], residuals)
                for factor, slope in zip(factors, slopes, strict=True):
                    for letter, s in slope.items():
                        here[letter] -= factor * s.conjugate() * weights[letter]
        except FAULTS:
            return None
        return None

    def slopes(self, equation: Expr, here: Numbers) -> tuple[complex, Numbers]:
        value = at(equation, here.__getitem__)
        found = {}
        for letter in equation.free_symbols:
            step = SLOPE * max(abs(here[letter]), 0.1)
            there = {**here, letter: here[letter] + step}
            found[letter] = (at(equation, there.__getitem__) - value) / step
        return value, found

    def is_general(self, here: Numbers, equations: Sequence[Equation], vanishing: bool) -> bool:
        letters = set().union(*(each.value.free_symbols for each in equations)) if equations else set()
        sizes = {each: abs(here[each]) for each in letters}
        if any(abs(here[each].imag) > SMALL * max(sizes[each], 1.0) for each in letters):
            return False  # roots of negative numbers have two branches
        return all(
            each in self.zeros
            or (vanishing and self.has_either_sign(each) and sizes[each] < SMALLEST)
            or (SMALLEST < sizes[each] < LARGEST and (here[each].real > 0 or self.has_either_sign(each)))
            for each in letters
        )

    def has_either_sign(self, symbol: Symbol) -> bool:
        letter = self.meaning.symbols.get(symbol)
        return not symbol.is_positive or (letter is not None and letter.base in OF_EITHER_SIGN)


@lru_cache(maxsize=2000)
def reduced(value: Expr) -> Expr:
    """Return an expression without the letters that are factors of all its terms."""
    terms = factor_terms(expand(value))
    return Mul(*(each for each in Mul.make_args(terms) if not each.as_base_exp()[0].is_Symbol))


def _times(one: Numbers, other: Numbers, weights: dict[Symbol, float]) -> complex:
    return sum((s * other[each].conjugate() * weights[each] for each, s in one.items() if each in other), 0j)


def _solved(matrix: list[list[complex]], right: list[complex]) -> list[complex]:
    count = len(right)
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for i, row in enumerate(rows):
        row[i] += DAMPING * abs(row[i])
    for column in range(count):
        pivot = max(range(column, count), key=lambda i: abs(rows[i][column]))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for i in range(count):
            if i != column and rows[i][column] and rows[column][column]:
                factor = rows[i][column] / rows[column][column]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[column], strict=True)]
    # An equation between letters that vanish has no slopes, so its row is zero.
    return [rows[i][-1] / rows[i][i] if rows[i][i] else 0j for i in range(count)]


__all__ = ["Numbers", "Surface"]
