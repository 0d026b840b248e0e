"""The verdict on a formula: equal, equal under a convention that is stated, or what is wrong with it.

The tests are tried in this order, and the first that succeeds gives the verdict. Right: equal; equal with the
definitions of the problem; equal up to rounded decimals; equal under a convention. Wrong: the opposite sign; another
quantity of the problem; another dimension; letters that the problem does not have; wrong by a factor; wrong in one
term; another quantity of the problem, whose formula is approximate; right for special values only; wrong by a factor
that contains sums.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, permutations
from typing import Any

import sympy
from sympy import Add, Expr, Integer, MatrixBase, Rational, Symbol, diff

from derive.algebra.dimensions import NUMBER, Dimension, exponents
from derive.algebra.expressions import PLUS_MINUS, TIME, rate
from derive.algebra.kinds import Inhomogeneous, kind_with_article, named
from derive.algebra.ranges import Range, within
from derive.audit.fingerprint import differ
from derive.audit.time_limit import FAULTS
from derive.grading.key import Key, Target
from derive.grading.outcomes import Outcome, Verdict
from derive.grading.reading import Read
from derive.grading.structure import (
    are_equal,
    are_surely_equal,
    factor_between,
    slips_between,
    special_values,
    swaps,
)
from derive.render.notation.text import in_one_line
from derive.steps.homogeneity import dimension_of

DIFFERS = "it differs from the answer of the problem"
LONGEST = 160  # greatest number of characters of an expression in an explanation
ROUNDS = 6  # greatest number of rounds in which definitions are substituted
MOST_UNKNOWN = 2  # greatest number of unknown letters that may be other names for letters of the problem
FEWEST_FIGURES = 2
WITH_A_ZERO = ("potential", "lagrangian", "energy_function", "hamiltonian", "effective", "total_energy")


def shown(value: Any, key: Key) -> str:
    """Return an expression as one line of text for an explanation."""
    try:
        text = in_one_line(key.notation.layout(value))
        return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."
    except Exception:
        return str(value)[:LONGEST]


def verdict_on_value(read: Read, target: Target, key: Key) -> Verdict:
    """Compare one reading of a formula with an answer that is a value."""
    return _Comparison(read, target, key).verdict()


def aligned(value: Any, right: Any) -> Any:
    """Replace each symbol of a typed expression by the symbol of the right answer with the same name, if there is
    one."""
    own = {each.name: each for each in right.free_symbols}
    put_in = {each: own[each.name] for each in value.free_symbols if own.get(each.name, each) != each}
    return value.xreplace(put_in) if put_in else value


@dataclass
class _Comparison:
    """Compares one reading of a formula with an answer. A test returns None if it gives no verdict."""

    read: Read
    target: Target
    key: Key
    is_entry: bool = False  # whether the values are entries of a matrix

    def verdict(self) -> Verdict:
        value, right = aligned(self.read.value, self.target.value), self.target.value
        if isinstance(right, MatrixBase) or isinstance(value, MatrixBase):
            return self.of_matrix(value, right)
        if PLUS_MINUS in right.free_symbols | value.free_symbols:
            return self.of_two_signs(value, right)
        return self.of_scalar(value, right)

    # Scalars

    def of_scalar(self, value: Expr, right: Expr) -> Verdict:
        if self.names_only(value, right):
            return Verdict(Outcome.DIFFERENT, f"`{value}` only names a quantity, but does not give its value")
        for test in (
            self.identity,
            self.definitions,
            self.decimals,
            self.other_letters,
            self.turned,
            self.other_zero,
            self.opposite,
            self.other_quantity,
            self.dimensions,
            self.unknown_letters,
            self.factor,
            self.slip,
            self.approximate_quantity,
            self.special,
            self.longer_factor,
        ):
            if (found := test(value, right)) is not None:
                return found
        return Verdict(Outcome.DIFFERENT, DIFFERS)

    def names_only(self, value: Expr, right: Expr) -> bool:
        return isinstance(value, Symbol) and value != right and value in self.key.definitions

    def identity(self, value: Expr, right: Expr) -> Verdict | None:
        return Verdict(Outcome.EQUAL, "") if are_equal(value, right) else None

    def definitions(self, value: Expr, right: Expr) -> Verdict | None:
        """Accept a formula that is equal after the definitions of the problem and of its steps are substituted."""
        own = {self.target.symbol} if isinstance(self.target.symbol, Symbol) else set()
        if value.free_symbols & own and right.free_symbols.isdisjoint(own):
            return None
        known = {*self.key.definitions, *self.key.momenta}
        used = (value.free_symbols & known) - right.free_symbols
        if not used and not right.free_symbols & set(self.key.definitions):
            return None
        momenta = {each: of for each, of in self.key.momenta.items() if each in used}
        left, full = self.expanded(value.xreplace(momenta)), self.expanded(right)
        if (left, full) == (value, right) or not are_equal(left, full):
            return None
        if results := sorted(used - self.key.allowed, key=str):
            names = ", ".join(f"`{shown(each, self.key)}`" for each in results)
            return Verdict(Outcome.CONVENTION, f"with {names} as defined in the solution")
        return Verdict(Outcome.EQUAL, "with the definitions of the problem" if used else "")

    def expanded(self, value: Any) -> Any:
        for _ in range(ROUNDS):
            found = {
                each: of
                for each in value.free_symbols
                if (of := self.key.definitions.get(each)) is not None and isinstance(of, Expr) and each != of
            }
            if not found:
                break
            value = value.xreplace(found)
        return value

    def decimals(self, value: Expr, right: Expr) -> Verdict | None:
        inexact = self.read.decimals
        if not inexact or any(_figures(each, digits) < FEWEST_FIGURES for each, digits in inexact):
            return None
        full, answer = self.expanded(right), self.expanded(value)
        if answer.free_symbols != full.free_symbols:
            return None
        within = sum(Rational(1, 2) / Integer(10) ** digits / abs(each) for each, digits in inexact if each)
        if factor_is_near(answer, full, within):
            figures = min(_figures(each, digits) for each, digits in inexact)
            return Verdict(Outcome.EQUAL, f"its decimals are rounded to at least {figures} figures")
        return None

    def other_letters(self, value: Expr, right: Expr) -> Verdict | None:
        """Accept a formula that is equal after letters that the problem does not have are replaced by letters of the
        problem."""
        unknown = [each for each in self.read.unknown if each in value.free_symbols]
        bases = list(dict.fromkeys(_without_dots(each) for each in unknown))
        if not 0 < len(bases) <= MOST_UNKNOWN:
            return None
        full = self.expanded(right)
        goals = [right] if full == right else [right, full]
        for goal in goals:
            free = sorted({_without_dots(each) for each in goal.free_symbols - value.free_symbols}, key=str)[:8]
            if 2 * len(bases) > len({_without_dots(each) for each in goal.free_symbols}):
                continue  # at most half of the letters of the right answer may have other names
            for chosen in permutations(free, len(bases)):
                put_in = _with_rates(dict(zip(bases, chosen, strict=True)))
                if are_surely_equal(value.xreplace(put_in), goal):
                    told = " and ".join(
                        f"`{shown(a, self.key)}` is the problem's `{shown(b, self.key)}`"
                        for a, b in zip(bases, chosen, strict=True)
                    )
                    return Verdict(Outcome.CONVENTION, f"if {told}")
        return None

    def turned(self, value: Expr, right: Expr) -> Verdict | None:
        """Judge a formula that would be equal if one or two coordinates were positive in the opposite sense.

        The sense of an angle is a convention if it matters only relative to another coordinate. Otherwise the
        problem fixes the sense, and the answer has wrong signs.
        """
        moving = sorted(self.key.coordinates & {_without_dots(each) for each in right.free_symbols}, key=str)[:4]
        for count in range(1, min(len(moving), 2) + 1):
            for chosen in combinations(moving, count):
                turned = right.xreplace(_turning(chosen))
                if turned == right or not are_surely_equal(value, turned) or are_surely_equal(value, -right):
                    continue
                names = " and ".join(f"`{shown(each, self.key)}`" for each in chosen)
                if self.is_free(chosen):
                    return Verdict(Outcome.CONVENTION, f"with the opposite sense of {names}")
                return Verdict(Outcome.SIGN, f"it would be right with the opposite sense of {names}")
        return None

    def is_free(self, chosen: tuple[Symbol, ...]) -> bool:
        """Whether the sense of an angle matters only relative to another coordinate. The Lagrangian then changes if the
        angle changes its sign, but not if a coordinate that is not an angle also changes its sign."""
        if len(chosen) != 1 or self.key.kinds.get(chosen[0]) != "angle":
            return False
        lagrangian = next((each.value for each in self.key.steps if "lagrangian" in each.key), None)
        if not isinstance(lagrangian, Expr):
            return False
        present = self.key.coordinates & {_without_dots(each) for each in lagrangian.free_symbols}
        others = sorted((each for each in present if self.key.kinds.get(each) != "angle"), key=str)[:5]
        alone = lagrangian.xreplace(_turning(chosen))
        return not are_equal(alone, lagrangian) and any(
            are_surely_equal(lagrangian.xreplace(_turning((*chosen, other))), lagrangian) for other in others
        )

    def other_zero(self, value: Expr, right: Expr) -> Verdict | None:
        """Accept energies with another zero, and Lagrangians that differ by the total time derivative of a function."""
        if self.target.kind != "energy" or not any(word in self.target.key for word in WITH_A_ZERO):
            return None
        try:
            difference = sympy.expand(value - right)
            if self.dimension(difference) not in (None, self.target.dimension):
                return None
        except (*FAULTS, Inhomogeneous):
            return None
        moving = self.key.coordinates & {_without_dots(each) for each in right.free_symbols | value.free_symbols}
        rates = {each for q in moving for each in (q, rate(q), rate(q, 2))}
        is_lagrangian = "lagrangian" in self.target.key and bool(moving)
        if not difference.free_symbols & rates and self.changes_a_term(difference, value, right, rates):
            return None
        if not difference.free_symbols & (rates | {TIME}):
            told = f"with another zero of the energy: it differs by {shown(difference, self.key)}"
            return Verdict(Outcome.CONVENTION, told)
        if is_lagrangian and self.is_rate(difference, moving):
            told = "it leads to the same equations of motion: it differs by the time derivative of a function"
            return Verdict(Outcome.CONVENTION, told)
        return None

    @staticmethod
    def changes_a_term(difference: Expr, value: Expr, right: Expr, rates: set[Symbol]) -> bool:
        """Whether a term without coordinates has different numerical factors in the two energies, which is a slip."""
        mine, theirs = (
            [term for term in Add.make_args(sympy.expand(each)) if term != 0 and not term.free_symbols & rates]
            for each in (value, right)
        )
        ratios = [factor_between(difference, each) for each in theirs] if mine else []
        return any(each is not None and each.is_number and each != -1 for each in ratios)

    def is_rate(self, difference: Expr, moving: frozenset[Symbol]) -> bool:
        """Whether an expression is the total time derivative of a function: as a Lagrangian, the expression satisfies
        Lagrange's equations identically."""

        def along(value: Expr) -> Expr:
            return diff(value, TIME) + sum(diff(value, each) * rate(each) for q in moving for each in (q, rate(q)))

        return all(are_equal(along(diff(difference, rate(q))), diff(difference, q)) for q in moving)

    def opposite(self, value: Expr, right: Expr) -> Verdict | None:
        if right != 0 and are_surely_equal(value, -right):
            return Verdict(Outcome.SIGN, "it is the negative of the right answer")
        return None

    def other_quantity(self, value: Expr, right: Expr) -> Verdict | None:
        return self.quantity(value, right, exact=True)

    def approximate_quantity(self, value: Expr, right: Expr) -> Verdict | None:
        return self.quantity(value, right, exact=False)

    def quantity(self, value: Expr, right: Expr, exact: bool) -> Verdict | None:
        if not value.free_symbols or isinstance(value, Symbol) or self.is_entry:
            return None
        full = self.expanded(value)
        for other in (*self.key.targets, *self.key.steps):
            if other.key == self.target.key or other.exact is not exact or other.value == right:
                continue
            if not isinstance(other.value, Expr) or not other.value.free_symbols:
                continue
            if are_surely_equal(full, self.expanded(other.value)):
                where = f" of part ({other.label})" if other.label else ""
                is_asked = any(each.key == other.key for each in self.key.targets)
                what = "the answer" if is_asked else "a step"
                return Verdict(Outcome.ANOTHER, f"it is {what}{where}: {other.text[:160]}")
        return None

    def dimension(self, value: Expr) -> Dimension | None:
        try:
            return dimension_of(value, self.key.dimensions)
        except Inhomogeneous:
            raise
        except Exception:
            return None

    def dimensions(self, value: Expr, right: Expr) -> Verdict | None:
        try:
            found = self.dimension(value)
        except Inhomogeneous as error:
            told = f"`{shown(error.term, self.key)}` is {named(error.dimension)}"
            other = error.other if isinstance(error.other, str) else shown(error.other, self.key)
            return Verdict(Outcome.DIMENSION, f"{told}, but `{other}` is {named(error.expected)}")
        wanted = self.target.dimension or NUMBER
        if found is None or found == wanted or value == 0:
            return None
        asked = f"{kind_with_article(self.target.kind)} ({exponents(wanted)})" if self.target.kind else _named(wanted)
        because = f"it is {_named(found)}, but {asked} is asked for"
        ratio = factor_between(value, right)
        if ratio is not None:
            because += f"; it is {shown(ratio, self.key)} times the right answer"
        return Verdict(Outcome.DIMENSION, because)

    def unknown_letters(self, value: Expr, right: Expr) -> Verdict | None:
        if not (unknown := [each for each in self.read.unknown if each in value.free_symbols]):
            return None
        names = ", ".join(f"`{shown(each, self.key)}`" for each in unknown)
        return Verdict(Outcome.DIFFERENT, f"the problem has no {names}")

    def factor(self, value: Expr, right: Expr) -> Verdict | None:
        return self.ratio(value, right, with_sums=False)

    def longer_factor(self, value: Expr, right: Expr) -> Verdict | None:
        return self.ratio(value, right, with_sums=True)

    def ratio(self, value: Expr, right: Expr, with_sums: bool) -> Verdict | None:
        for left, goal in dict.fromkeys(((value, right), (self.expanded(value), self.expanded(right)))):
            ratio = factor_between(left, goal)
            if ratio is not None and ratio not in (0, 1) and (not ratio.has(Add) or (with_sums and not swaps(ratio))):
                if ratio == -1:
                    return Verdict(Outcome.SIGN, "it is the negative of the right answer")
                return Verdict(Outcome.FACTOR, f"it is {shown(ratio, self.key)} times the right answer")
        return None

    def slip(self, value: Expr, right: Expr) -> Verdict | None:
        for left, goal in dict.fromkeys(((value, right), (self.expanded(value), self.expanded(right)))):
            for outcome, because in slips_between(left, goal, lambda each: shown(each, self.key)):
                return Verdict(outcome, because)
        return None

    def special(self, value: Expr, right: Expr) -> Verdict | None:
        left, goal = self.expanded(value), self.expanded(right)
        kinds = {
            each: dimension
            for each in left.free_symbols | goal.free_symbols
            if (dimension := self.key.dimensions.get(each)) is not None and each != TIME
        }
        angles = {each for each, dimension in kinds.items() if dimension == NUMBER}
        roots = angles & self.key.coordinates if not differ(left**2, goal**2) else set()
        for angle in sorted(roots, key=str):  # `2 sin(theta/2)` for the root of 2 - 2 cos(theta)
            with within({angle: Range(Integer(0), sympy.pi / 2)}):
                if are_equal(left, goal):
                    told = f"for {shown(angle, self.key)} between 0 and 90 degrees"
                    return Verdict(Outcome.CONVENTION, told)
        text = special_values(left, goal, kinds, angles, lambda each: shown(each, self.key))
        return Verdict(Outcome.SPECIAL, f"it is right only for {text}") if text else None

    # Several values

    def of_two_signs(self, value: Expr, right: Expr) -> Verdict:
        given = [
            value.xreplace({PLUS_MINUS: Integer(s)}) for s in ((1, -1) if PLUS_MINUS in value.free_symbols else (1,))
        ]
        wanted = [
            right.xreplace({PLUS_MINUS: Integer(s)}) for s in ((1, -1) if PLUS_MINUS in right.free_symbols else (1,))
        ]
        if len(given) == len(wanted) == 2:
            orders = [self.worst(given, order) for order in (wanted, wanted[::-1])]
            return min(orders, key=lambda each: each.rank)
        if len(wanted) == 1:
            verdicts = [self.of_scalar(each, wanted[0]) for each in given]
            best = min(verdicts, key=lambda each: each.rank)
            if best.is_right:
                return Verdict(Outcome.EXTRA, "one of the two signs is right; the other one is superfluous")
            return best
        verdicts = [self.of_scalar(given[0], each) for each in wanted]
        best = min(verdicts, key=lambda each: each.rank)
        if best.is_right:
            return Verdict(Outcome.MISSING, "it is one of two values; the other is missing")
        return best

    def worst(self, given: list[Expr], wanted: list[Expr]) -> Verdict:
        return max((self.of_scalar(a, b) for a, b in zip(given, wanted, strict=True)), key=lambda each: each.rank)

    def of_matrix(self, value: Any, right: Any) -> Verdict:
        if not isinstance(right, MatrixBase):
            if 1 in value.shape and are_equal(sympy.sqrt(value.dot(value)), right):
                return Verdict(Outcome.DIFFERENT, "it is a vector; its magnitude is asked for")
            return Verdict(Outcome.DIFFERENT, f"it is {_size(value)}, but a single value is asked for")
        if not isinstance(value, MatrixBase):
            if value == 0 and all(each == 0 for each in right):
                return Verdict(Outcome.EQUAL, "")
            return self.one_for_all(value, right)
        if value.shape != right.shape and value.shape == right.shape[::-1]:
            value = value.T
        if value.shape != right.shape and value.shape[1] == 1 and right.shape[0] == right.shape[1] == value.shape[0]:
            value = sympy.diag(*value)
        if value.shape != right.shape:
            return Verdict(Outcome.DIFFERENT, f"it is {_size(value)}, but {_size(right)} is asked for")
        self.is_entry = True
        if self.target.scaled:
            return self.up_to_a_factor(value, right)
        entries = [self.of_scalar(a, b) for a, b in zip(value, right, strict=True)]
        if all(each.is_right for each in entries):
            return max(entries, key=lambda each: each.rank)
        if self.target.of_set and value.shape[0] <= 4:
            for order in permutations(range(len(right))):
                if all(are_surely_equal(a, right[i]) for a, i in zip(value, order, strict=True)):
                    return Verdict(Outcome.EQUAL, "in another order")
        return self.of_wrong_matrix(value, right, entries)

    def of_wrong_matrix(self, value: MatrixBase, right: MatrixBase, entries: list[Verdict]) -> Verdict:
        if all(are_surely_equal(a, -b) for a, b in zip(value, right, strict=True)):
            return Verdict(Outcome.SIGN, "each component is the negative of the right one")
        pairs = [(a, b) for a, b in zip(value, right, strict=True) if a != 0 or b != 0]
        ratios = [factor_between(a, b) for a, b in pairs]
        if ratios and ratios[0] is not None and not ratios[0].has(Add) and all(each == ratios[0] for each in ratios):
            try:
                found = self.dimension(ratios[0])
            except Inhomogeneous:
                found = None
            outcome = Outcome.FACTOR if found in (None, NUMBER) else Outcome.DIMENSION
            return Verdict(outcome, f"it is {shown(ratios[0], self.key)} times the right answer")
        return verdict_of_entries(entries, right.shape)

    def one_for_all(self, value: Expr, right: MatrixBase) -> Verdict:
        """Judge a single value that is typed in place of a matrix. The value may be right for a multiple of the unit
        matrix, and for a vector with only one nonzero component."""
        rows, columns = right.shape
        if rows == columns and are_surely_equal(value, right[0, 0]) and right == right[0, 0] * sympy.eye(rows):
            return Verdict(Outcome.CONVENTION, "as the moment about every axis")
        is_list = isinstance(self.target.symbol, MatrixBase)
        if right.shape[1] == 1 and sum(each != 0 for each in right) == 1 and not is_list:
            only = next(each for each in right if each != 0)
            found = self.of_scalar(value, only)
            return found if not found.is_right else Verdict(
                Outcome.CONVENTION, "as the only component that does not vanish"
            )  # fmt: skip
        if any(are_surely_equal(value, each) for each in right if each != 0):
            return Verdict(Outcome.MISSING, f"it is one of the components; {_size(right)} is asked for")
        return Verdict(Outcome.DIFFERENT, f"it is a single value, but {_size(right)} is asked for")

    def up_to_a_factor(self, value: MatrixBase, right: MatrixBase) -> Verdict:
        if all(each == 0 for each in value):
            return Verdict(Outcome.DIFFERENT, "all its entries are zero")
        full, goal = self.expanded(value), self.expanded(right)
        crossed = all(are_equal(full[i] * goal[j], full[j] * goal[i]) for i in range(len(goal)) for j in range(i))
        if crossed:
            return Verdict(Outcome.EQUAL, "up to a factor, which is arbitrary" if full != goal else "")
        for i in range(len(goal)):
            turned = sympy.Matrix([-e if j == i else e for j, e in enumerate(full)])
            if all(
                are_surely_equal(turned[i] * goal[j], turned[j] * goal[i]) for i in range(len(goal)) for j in range(i)
            ):
                return Verdict(Outcome.SIGN, "the entries have the wrong relative sign")
        return Verdict(Outcome.DIFFERENT, "its entries do not have the right ratio")


def factor_is_near(answer: Expr, right: Expr, within: Expr) -> bool:
    """Whether the relative difference of two expressions is at most `within` at every sample point."""
    from derive.audit.deciding import _relative_error

    try:
        error = _relative_error(answer, right)
    except FAULTS:
        return False
    return error is not None and error <= float(within)


def _figures(value: Expr, digits: int) -> int:
    return len(str(abs(int(value * 10**digits))).lstrip("0")) if value else 0


def _without_dots(symbol: Symbol) -> Symbol:
    from derive.algebra.expressions import RATES

    order = next((n for n in (3, 2, 1) if symbol.name.endswith(RATES[n])), 0)
    return Symbol(symbol.name.removesuffix(RATES[order]), **symbol.assumptions0) if order else symbol


def _turning(chosen: tuple[Symbol, ...]) -> dict[Symbol, Expr]:
    return {one: -other for one, other in _with_rates({q: q for q in chosen}).items()}


def _with_rates(pairs: dict[Symbol, Symbol]) -> dict[Symbol, Symbol]:
    found: dict[Symbol, Symbol] = dict(pairs)
    for one, other in pairs.items():
        found |= {rate(one, n): rate(other, n) for n in (1, 2)}
    return found


def _named(dimension: Dimension) -> str:
    name, powers = named(dimension), exponents(dimension)
    return "a number" if dimension == NUMBER else name if name.endswith(powers) else f"{name} ({powers})"


def verdict_of_entries(entries: Sequence[Verdict], shape: tuple[int, int]) -> Verdict:
    """Return the verdict on a matrix from the verdicts on its entries; an error names the first wrong entry."""
    wrong = [(i, each) for i, each in enumerate(entries) if not each.is_right]
    if not wrong:
        return max(entries, key=lambda each: each.rank)
    first, verdict = wrong[0]
    outcome = verdict.outcome if all(each.outcome is verdict.outcome for _, each in wrong) else Outcome.DIFFERENT
    others = f", and {len(wrong) - 1} more" if len(wrong) > 1 else ""
    return Verdict(outcome, f"{_entry(first, shape)}: {verdict.because}{others}")


def _size(value: MatrixBase) -> str:
    rows, columns = value.shape
    return f"a list of {rows}" if columns == 1 else f"a matrix of {rows} by {columns}"


def _entry(index: int, shape: tuple[int, int]) -> str:
    if shape == (3, 1):
        return f"component {'xyz'[index]}"
    row, column = divmod(index, shape[1])
    return f"entry {index + 1}" if shape[1] == 1 else f"entry {row + 1}, {column + 1}"


__all__ = ["shown", "verdict_of_entries", "verdict_on_value"]
