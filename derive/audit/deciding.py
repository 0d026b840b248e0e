"""The verdict on one claim: whether its right side follows from its left side and from earlier rows.

A claim holds, for example, if its sides are equal after definitions are substituted, or if it follows from earlier
equations. A claim differs, for example, if numbers show that its sides are not equal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, product
from random import Random

import sympy
from sympy import Abs, Expr, Integer, Integral, MatrixBase, Rational, Symbol

from derive.algebra.equality import Grade, equal
from derive.audit.claims import Claim, Definition, Outcome, Verdict
from derive.audit.fingerprint import differ, fingerprint, is_zero
from derive.audit.knowledge import Known
from derive.audit.systems import (
    System,
    changing_letters,
    equations_of,
    expanded,
    frequency_equations,
    is_linear,
    lagrange_equations,
    linearised,
    motion_of,
    root_equation,
    values_at_instant,
    values_at_place,
    values_with,
    vanishes,
    with_small_factors,
    zeros_in_time,
)
from derive.documents.layout import Cue
from derive.documents.meaning import Meaning, Meaningless, Value

PLUS_MINUS = Symbol("±", real=True)
POINTS = 4
CLOSE = Rational(1, 10**9)
MOST_COMBINED = 6  # at most this many of the most recent equations are combined
LARGEST_GOAL = 400  # equations with more operations are not compared after substitution
MOST_SIGNS = 3  # at most this many absolute values are replaced by both signs
STRICT = ("<", ">", "<<", ">>", "!=")
CONVERTED = 0.01  # two bounds with a greater relative difference do not count as one bound in different units
SMALL = (Rational(1, 100), Rational(1, 1000))


def same(left: Value, right: Value) -> bool:
    """Whether two values are equal. If they contain ±, they must be equal for both signs, or become equal for both
    signs after ± is reversed in one of them."""
    if isinstance(left, MatrixBase) != isinstance(right, MatrixBase):
        return False
    if isinstance(left, MatrixBase) and left.shape != right.shape:
        return False
    if PLUS_MINUS in left.free_symbols | right.free_symbols:
        return all(_equal(left.subs(PLUS_MINUS, s), right.subs(PLUS_MINUS, s)) for s in (1, -1)) or all(
            _equal(left.subs(PLUS_MINUS, s), right.subs(PLUS_MINUS, -s)) for s in (1, -1)
        )
    return _equal(left, right)


def _equal(left: Value, right: Value) -> bool:
    if left == right:
        return True
    if any(differ(one, other) for one, other in zip(entries_of(left), entries_of(right), strict=True)):
        return False
    return equal(left, right).grade in (Grade.PROVED, Grade.SAMPLED)


@dataclass
class Decision:
    """The decision on one claim with one reading of its sides. Each test returns None if it does not apply."""

    claim: Claim
    left: Value
    right: Value
    meaning: Meaning
    known: Known
    cues: frozenset[Cue]
    thorough: bool = True  # whether earlier equations are also combined, which takes a long time

    def verdict(self) -> Verdict:
        for test in (
            self.shapes,
            self.definition,
            self.identity,
            self.with_definitions,
            self.rounded,
            self.truncated,
            self.approximate,
            self.condition,
            self.square,
            self.consequence,
            self.together,
            self.vanishing,
            self.implied,
        ):
            if (found := test()) is not None:
                return found
        found = self.otherwise()
        earlier = self.known.latest(self.left) if isinstance(self.left, Symbol) and not self.claim.is_step else None
        found.contradicts = earlier.claim if earlier is not None and earlier.claim >= 0 else None
        return found

    # Sides

    def shapes(self) -> Verdict | None:
        left, right = self.left, self.right
        if isinstance(left, MatrixBase) and right == 0:
            self.right = sympy.zeros(*left.shape).as_immutable()
            return None
        if isinstance(right, MatrixBase) and left == 0:
            self.left = sympy.zeros(*right.shape).as_immutable()
            return None
        if isinstance(left, MatrixBase) == isinstance(right, MatrixBase):
            if isinstance(left, MatrixBase) and left.shape != right.shape:
                raise Meaningless("the two sides are matrices of different shapes", self.claim.right_span)
            return None
        matrix, number = (left, right) if isinstance(left, MatrixBase) else (right, left)
        if isinstance(number, Symbol):
            return Verdict(Outcome.DEFINES, "a list or matrix gets a name")
        sure = self.meaning.plain in ("", "unmarked") and (self.claim.is_step or self.is_written_out(number))
        if matrix.shape[1] == 1 and sure:
            total = sympy.Add(*matrix)
            suggestion = "the sum of the entries" if same(number, total) else ""
            return Verdict(
                Outcome.DIFFERS, "one side is a number and the other side is a list of numbers", suggestion=suggestion,
                why_plausible="a scalar product is the sum of the products of the components" if suggestion else "",
            )  # fmt: skip
        raise Meaningless("one side is a number and the other side is a vector or matrix", self.claim.right_span)

    def is_written_out(self, number: Expr) -> bool:
        return len(number.free_symbols) > 1

    def definition(self) -> Verdict | None:
        """Judge a claim that gives a value to a letter for the first time."""
        if self.claim.relation not in ("=", ":=", "~"):
            return None
        if isinstance(self.left, MatrixBase) and isinstance(self.right, MatrixBase) and not self.claim.is_step:
            entries = [each for each in self.left if isinstance(each, Symbol)]
            known = [each for each in entries if self.known.latest(each) is not None]
            if len(set(entries)) == len(self.left) and not known:
                return Verdict(Outcome.DEFINES, "values for the components of a vector or matrix")
        for letter, value in ((self.left, self.right), (self.right, self.left)):
            if letter is self.right and self.claim.is_step:
                continue
            is_letter = isinstance(letter, Symbol) and letter not in self.meaning.sums
            if is_letter and letter not in value.free_symbols and not self.known.is_defined(letter):
                if self.known.computed(letter) is not None or isinstance(value, MatrixBase):
                    continue
                if letter in self.known.named and self.claim.row.block.display and not value.is_number:
                    continue
                if not value.free_symbols and not value.is_number:
                    continue
                if self.follows_already(letter, value) is not None:
                    continue
                if letter is self.left and (found := self.solution(self.known.recent())) is not None:
                    return found
                for test in (self.of_known_form, self.of_root, self.of_instant):
                    if (found := test(letter, value)) is not None:
                        return found
                about = "an approximate value" if self.claim.relation == "~" else "a value"
                return self.of_used_letter(letter) or Verdict(Outcome.DEFINES, f"{about} for {_word(letter)}")
        return None

    def square(self) -> Verdict | None:
        """Judge a claim that gives a value to the square of a letter: `v^2 = ...`."""
        if self.claim.is_step or self.claim.relation not in ("=", ":="):
            return None
        if not (isinstance(self.left, sympy.Pow) and isinstance(self.left.base, Symbol) and self.left.exp == 2):
            return None
        letter = self.left.base
        if letter in self.right.free_symbols or self.known.latest(letter) is not None:
            return None
        if any(letter in equation.free_symbols for equation, _ in self.known.equations):
            return None
        if letter.is_positive and not isinstance(self.right, MatrixBase) and self.right.free_symbols:
            self.known.define(letter, sympy.sqrt(self.right), self.claim.number)
        return Verdict(Outcome.DEFINES, f"a value for {_word(letter)} squared")

    def of_known_form(self, letter: Symbol, value: Expr) -> Verdict | None:
        """Report a kinetic energy with a negative coefficient of a squared rate, or a Lagrangian that is not T - U."""
        named = self.meaning.symbols.get(letter)
        if named is not None and named.base in ("T", "K") and not named.dots and self.is_negative(value):
            return Verdict(Outcome.DIFFERS, "a kinetic energy does not fall when a speed grows")
        if named is None or named.base != "L" or named.marks or named.dots:
            return None
        energies = {each: self.meaning.symbols.get(each) for each in value.free_symbols}
        if not energies or any(
            each is None or each.base not in ("T", "U", "V", "K") or each.dots for each in energies.values()
        ):
            return None
        kinetic = sympy.Add(*(s for s, each in energies.items() if each is not None and each.base in "TK"))
        if same(value, kinetic - sympy.Add(*(energies.keys() - kinetic.free_symbols))):
            return None
        example = counterexample(value, 2 * kinetic - sympy.Add(*energies))
        because = "a Lagrangian is the kinetic energy minus the potential energy"
        return Verdict(
            Outcome.DIFFERS, because, counterexample=example, suggestion="T - U", why_plausible="a sign was reversed",
        )  # fmt: skip

    def is_negative(self, value: Expr) -> bool:
        rates = [each for each in value.free_symbols if self.known.is_rate(each)]
        doubled = value.subs({each: 2 * each for each in rates}, simultaneous=True)
        if not rates or sympy.expand(doubled - 4 * value) != 0:
            return False
        squares = [fingerprint(sympy.diff(value, each, 2)) for each in rates]
        return any(number.real < 0 for numbers in squares if numbers is not None for number in numbers)

    def of_root(self, letter: Symbol, value: Expr) -> Verdict | None:
        """Judge a claim that gives a root of an earlier equation: `w_1 = ...` holds if this value of w satisfies the
        equation."""
        if not self.claim.row.block.display or not self.thorough:
            return None
        put_in, used = expanded(self.known, value, sure=True)
        if any(map(self.known.is_rate, put_in.free_symbols)):
            put_in, used = value, ()
        found = root_equation(letter, self.meaning, self.known)
        if found is None and Cue.ZERO in self.cues and (at := zeros_in_time(letter, self.meaning, self.known)):
            time, vanishing, number = at
            if vanishes(vanishing, time, put_in, self.meaning, self.known):
                return Verdict(Outcome.HOLDS, "an earlier value vanishes at this time", (*used, number))
        if found is None:
            for equation, number in frequency_equations(letter, self.meaning, self.known):
                if vanishes(equation, letter, put_in, self.meaning, self.known):
                    return Verdict(Outcome.HOLDS, "it follows from an earlier equation of motion", (*used, number))
            return None
        plain, equation, number = found
        put_in, used = expanded(self.known, value, plain, sure=True)
        if any(map(self.known.is_rate, put_in.free_symbols)):
            put_in, used = value, ()
        holds = vanishes(equation, plain, put_in, self.meaning, self.known)
        if holds is None:
            return None
        if holds and (other := self.other_name(letter, value)) is not None:
            return Verdict(Outcome.UNDECIDED, f"{_word(other)} has the same value")
        if holds:
            return Verdict(Outcome.HOLDS, "it is a root of an earlier equation", (*used, number))
        return Verdict(Outcome.UNDECIDED, f"{_word(letter)} does not satisfy the earlier equation for {_word(plain)}")

    def of_instant(self, letter: Symbol, value: Expr) -> Verdict | None:
        """Judge the value of a letter at an instant: `v_1` is the value of v or x' at t_1."""
        for earlier, instant in values_at_instant(letter, self.meaning, self.known):
            if same(expanded(self.known, earlier.value)[0], expanded(self.known, value)[0]):
                because = f"the value of {_word(earlier.symbol)} at {_word(instant.symbol)}"
                return Verdict(Outcome.HOLDS, because, (earlier.claim, instant.claim))
        return None

    def other_name(self, letter: Symbol, value: Expr) -> Symbol | None:
        """Return a letter with a different index and the same value, or None."""
        named = self.meaning.symbols[letter]
        for symbol, definitions in self.known.definitions.items():
            other = self.meaning.symbols.get(symbol)
            if other is not None and symbol != letter and (other.base, other.dots) == (named.base, named.dots):
                if same(definitions[-1].value, value):
                    return symbol
        return None

    def of_used_letter(self, letter: Symbol) -> Verdict | None:
        """Judge a claim that gives a value to a letter of earlier equations."""
        if not any(letter in equation.free_symbols for equation, _ in self.known.equations):
            return None
        if (found := self.together()) is not None:
            return found
        if self.claim.row.block.display and self.value_of_letter() is not None:
            return Verdict(Outcome.UNDECIDED, f"earlier rows give a different value of {_word(letter)}")
        return None

    def value_of_letter(self) -> list[complex] | None:
        for rates_only in (False, True):
            system = self.system(sure=True, rates_only=rates_only)
            values = system.value_of_letter() if system is not None else None
            if values is not None:
                return values
        return None

    def system(self, sure: bool, rates_only: bool = False, linear: bool = False) -> System | None:
        if not self.thorough or self.claim.relation not in ("=", ":=") or isinstance(self.difference, MatrixBase):
            return None
        letter = next((each for each in (self.left, self.right) if isinstance(each, Symbol)), None)
        named = self.meaning.symbols.get(letter)
        # The equations of motion follow from a Lagrangian, and not the Lagrangian from them.
        from_motion = named is None or named.base not in ("L", "U")
        equations = equations_of(self.known, self.meaning, letter, sure, written=not from_motion)
        if linear:
            equations = with_small_factors(linearised(equations, self.meaning), self.meaning)
        wanted, _ = expanded(self.known, self.difference, letter, sure)
        if not equations or wanted.has(Integral) or not wanted.free_symbols or sympy.count_ops(wanted) > 600:
            return None
        return System(wanted, equations, self.meaning, self.known, letter, rates_only)

    def together(self) -> Verdict | None:
        kinds = [(True, False), (False, False)] + [(True, True)] * self.may_be_linearised()
        for sure, linear in kinds:
            system = self.system(sure, linear=linear)
            used = system.follows() if system is not None else None
            if used is not None:
                names = list(dict.fromkeys(each.name for each in used))
                given = tuple(dict.fromkeys(number for each in used for number in each.claims))
                because = f"it follows from {' and '.join(names)}"
                if linear:
                    return Verdict(Outcome.APPROXIMATES, f"{because}, to first order in the letters that change", given)
                return Verdict(Outcome.HOLDS, because, given)
        return None

    def may_be_linearised(self) -> bool:
        """Whether the text speaks of an approximation, or the claim is a linear equation of motion."""
        if isinstance(self.difference, MatrixBase) or Cue.APPROXIMATE in self.cues:
            return Cue.APPROXIMATE in self.cues
        return is_linear(self.difference, self.meaning)

    def follows_already(self, letter: Symbol, value: Expr) -> int | None:
        """Return the number of the claim from whose equation the value of a letter follows, or None."""
        for equation, number in reversed(self.known.recent()):
            if letter in equation.free_symbols and _solves(equation, letter, value):
                return int(number)
        return None

    def identity(self) -> Verdict | None:
        if self.claim.relation in STRICT:
            return None
        if not same(self.left, self.right):
            return self.with_signs(self.left, self.right)
        if self.left == self.right and self.left != 0:
            return Verdict(Outcome.HOLDS, "the two sides are the same")
        return Verdict(Outcome.HOLDS, "the two sides are equal")

    def with_signs(self, left: Value, right: Value) -> Verdict | None:
        """Compare two sides after replacing each absolute value |a| by a or -a: sqrt((L - x)^2) = L - x if L > x."""
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
            return None
        found = sorted((left.atoms(Abs) | right.atoms(Abs)), key=str)[:MOST_SIGNS]
        if not found or self.claim.relation != "=":
            return None
        for signs in product((1, -1), repeat=len(found)):
            put_in = {each: sign * each.args[0] for each, sign in zip(found, signs, strict=True)}
            if _equal(left.xreplace(put_in), right.xreplace(put_in)):
                where = " and ".join(f"{s * a.args[0]} > 0" for a, s in zip(found, signs, strict=True))
                return Verdict(Outcome.HOLDS, f"the two sides are equal if {where}")
        return None

    @cached_property
    def expansions(self) -> list[tuple[tuple[Value, ...], tuple[int, ...]]]:
        return list(self.known.expanded(self.left, self.right))

    def with_definitions(self) -> Verdict | None:
        if self.claim.relation in STRICT:
            return None
        if self.known.conditions and not any(isinstance(each, MatrixBase) for each in (self.left, self.right)):
            difference, used = expanded(self.known, self.left - self.right, sure=True)
            if used and not difference.has(Integral) and same(difference, Integer(0)):
                return Verdict(Outcome.HOLDS, "the two sides are equal after substituting earlier results", used)
        for (left, right), used in self.expansions:
            if same(left, right):
                return Verdict(Outcome.HOLDS, "the two sides are equal after substituting earlier results", used)
        return None

    # Numbers and approximations

    def rounded(self) -> Verdict | None:
        """Compare decimals at the precision with which they are printed."""
        if not self.meaning.decimals:
            return None
        pairs: list[tuple[tuple[Value, ...], tuple[int, ...]]] = [((self.left, self.right), ()), *self.expansions]
        pairs += [
            (values, (*used, *more))
            for both, used in pairs
            for values, more in [self.known.with_numbers(*both)]
            if more
        ]
        for (left, right), used in pairs:
            errors = [
                _relative_error(one, other)
                for one, other in zip(entries_of(left), entries_of(right), strict=False)
                if one != 0 or other != 0
            ]
            if not errors or any(each is None for each in errors):
                continue
            error = max(each for each in errors if each is not None)
            if error <= self.tolerance:
                return Verdict(Outcome.APPROXIMATES, "equal to the printed digits", used)
            if error <= 2 * self.tolerance:
                return Verdict(
                    Outcome.APPROXIMATES, "equal except for the last printed digit, as after rounding twice", used
                )
        return None

    @cached_property
    def tolerance(self) -> float:
        """The sum of the greatest relative errors that the rounding of the printed decimals can cause."""
        return sum(float(Rational(1, 2) / 10**digits / abs(value)) for value, digits in self.meaning.decimals if value)

    def truncated(self) -> Verdict | None:
        """Compare the order of the error with the order of the terms that are left out: O(x^4)."""
        if self.meaning.left_out is None or isinstance(self.left, MatrixBase) or isinstance(self.right, MatrixBase):
            return None
        letter, wanted = self.meaning.left_out
        for (left, right), used in [((self.left, self.right), ()), *self.expansions]:
            found = order_of_error(left, right, self.meaning, [(letter,)])
            if found is not None and found[1] >= wanted:
                return Verdict(Outcome.APPROXIMATES, f"the error is of order {found[1]} in {_word(letter)}", used)
        return None

    def approximate(self) -> Verdict | None:
        if self.meaning.left_out is not None and self.claim.relation == "=":
            return None
        if self.claim.relation not in ("~", "prop") and Cue.APPROXIMATE not in self.cues:
            return None
        for (left, right), used in [((self.left, self.right), ()), *self.expansions]:
            if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
                continue
            among = small_letters(left.free_symbols | right.free_symbols, self.meaning)
            if self.claim.relation == "=":
                among = [each for each in among if len(each) > 1 or self.may_be_small(each[0])]
            for order in (order_of_error(left, right, self.meaning, [each]) for each in among):
                if order is None:
                    continue
                letters, power = order
                words = " and ".join(_word(each) for each in letters)
                if power > degree(right, letters):
                    return Verdict(Outcome.APPROXIMATES, f"the error is of order {power} in {words}", used)
                is_series = right.free_symbols <= left.free_symbols  # cot(x) = a/b may be small for another reason
                small = {self.known.small[each] for each in self.known.sentence if each in self.known.small}
                is_small = letters == changing_letters(left.free_symbols, self.meaning) or set(letters) <= small
                if is_series and is_small:
                    because = f"the terms of order {power} in {words} are not those of the left side"
                    return Verdict(Outcome.DIFFERS, because, used)
        if self.claim.relation in ("~", "prop"):
            return Verdict(Outcome.UNDECIDED, "this approximation or proportionality cannot be checked")
        return None

    def may_be_small(self, symbol: Symbol) -> bool:
        """Whether a letter may have both signs, as a coordinate may, or is written in the text before the formula."""
        return not symbol.is_positive or self.is_mentioned(symbol)

    def is_mentioned(self, symbol: Symbol) -> bool:
        """Whether the text just before this formula contains a letter."""
        letter = self.meaning.symbols.get(symbol)
        names = {letter.base, symbol.name} if letter is not None else {symbol.name}
        near = self.claim.row.block.near
        return any(re.search(rf"(?<![A-Za-z]){re.escape(each)}(?![A-Za-z])", near) for each in names)

    # Conditions and equations

    def condition(self) -> Verdict | None:
        """Judge an inequality."""
        if self.claim.relation not in ("<", ">", "<=", ">=", "<<", ">>", "!="):
            return None
        difference = self.left - self.right if not isinstance(self.left, MatrixBase) else None
        if difference is not None and difference.is_number:
            holds = {"<": difference < 0, ">": difference > 0, "<=": difference <= 0, ">=": difference >= 0}.get(
                self.claim.relation
            )
            if holds is not None:
                return Verdict(Outcome.HOLDS if bool(holds) else Outcome.DIFFERS, "a comparison of two numbers")
        return self.bound_in_other_units() or Verdict(Outcome.DEFINES, "a condition")

    def bound_in_other_units(self) -> Verdict | None:
        """Compare a bound with the same bound that an earlier row gives in other units."""
        if self.claim.is_step or not isinstance(self.left, Symbol) or not self.right.is_number:
            return None
        for left, relation, bound, number in reversed(self.known.bounds[-3:]):
            if left != self.left or relation != self.claim.relation:
                continue
            error = _relative_error(bound, self.right)
            if error is None or error > CONVERTED:
                return None
            if error <= self.tolerance or not self.meaning.decimals:
                return Verdict(Outcome.APPROXIMATES, "nearly the same bound", (number,))
            if error > 2 * self.tolerance and self.meaning.units:
                because = f"the earlier bound is {_number(sympy.N(self.right * bound / self.right, 8))} in SI units"
                written = max((value for value, _ in self.meaning.decimals), key=Abs)
                meant = sympy.N(written * bound / self.right, 7)
                return Verdict(
                    Outcome.DIFFERS, because, (number,), suggestion=f"{float(meant):g} instead of {float(written):g}",
                    why_plausible="a number was converted or rounded wrongly",
                )  # fmt: skip
        return None

    @property
    def difference(self) -> Value:
        return self.left - self.right

    def consequence(self) -> Verdict | None:
        """Judge an equation that may follow from earlier equations."""
        if self.claim.relation not in ("=", ":=") or isinstance(self.difference, MatrixBase):
            return None
        if sympy.count_ops(self.difference) > 2 * LARGEST_GOAL:
            return None
        recent = self.known.recent()
        wanted = sympy.expand(self.difference)
        for letter, value in ((self.left, self.right), (self.right, self.left)):
            if isinstance(letter, Symbol) and letter not in value.free_symbols:
                number = self.follows_already(letter, value)
                if number is not None:
                    return Verdict(Outcome.HOLDS, f"an earlier equation solved for {_word(letter)}", (number,))
        for equation, number in reversed(recent):
            if is_multiple(wanted, equation):
                return Verdict(Outcome.HOLDS, "an earlier equation times a factor", (number,))
        if (found := self.solution(recent) or self.lagrange(wanted)) is not None:
            return found
        if self.cues & {Cue.ZERO, Cue.LEAVES}:
            for equation, number in list(reversed(recent))[:MOST_COMBINED]:
                # A mass would be a factor of several terms.
                terms = [each.free_symbols for each in sympy.Add.make_args(sympy.expand(equation))]
                names = [each for each in equation.free_symbols if sum(each in letters for letters in terms) == 1]
                if Cue.ZERO not in self.cues:  # a body leaves a surface where a force vanishes, and not a rate
                    names = [each for each in names if not self.known.is_rate(each)]
                for name in [each for each in names if each in self.meaning.derivatives or not self.wants(each)]:
                    at_zero = equation.subs(name, 0)
                    if is_multiple(wanted, at_zero):
                        return Verdict(Outcome.HOLDS, f"{_word(name)} set to zero", (number,))
                    if Cue.APPROXIMATE in self.cues and _approximate_multiple(wanted, at_zero, self.meaning):
                        return Verdict(
                            Outcome.APPROXIMATES, f"{_word(name)} set to zero, to the leading order", (number,)
                        )
        if (numbers := _combination(wanted, recent[-MOST_COMBINED:])) is not None:
            return Verdict(Outcome.HOLDS, "a sum or difference of earlier equations", numbers)
        for (left, right), used in self.expansions:
            if sympy.count_ops(left - right) > LARGEST_GOAL:
                break
            expanded = sympy.expand(left - right)
            for equation, number in reversed(recent):
                if expanded.free_symbols == equation.free_symbols and is_multiple(expanded, equation):
                    return Verdict(Outcome.HOLDS, "an earlier equation after substituting definitions", (*used, number))
        for equation, number in reversed(recent[-4:]):
            if Cue.APPROXIMATE in self.cues and equation.free_symbols >= wanted.free_symbols:
                ratio = _approximate_multiple(wanted, equation, self.meaning)
                if ratio is not None:
                    return Verdict(Outcome.APPROXIMATES, "an earlier equation to the leading order", (number,))
        return None

    def solution(self, recent: list[tuple[Expr, int]]) -> Verdict | None:
        """Judge a motion x(t): it holds if it satisfies an earlier equation of motion."""
        if self.claim.is_step:
            return None
        motion = motion_of(self.left, self.right, self.meaning)
        for equation, number in reversed(recent):
            if not equation.free_symbols & set(list(motion)[1:]):
                continue
            at_motion = equation.xreplace(motion)
            for value, used in [(at_motion, ()), *((each[0], used) for each, used in self.known.expanded(at_motion))]:
                if value == 0 or _equal(value, Integer(0)):
                    return Verdict(Outcome.HOLDS, "it satisfies an earlier equation of motion", (number, *used))
        return None

    def lagrange(self, wanted: Expr) -> Verdict | None:
        """Judge an equation of motion: it holds if it follows from the Lagrangian."""
        if not any((letter := self.meaning.symbols.get(each)) is not None and letter.dots
                   for each in wanted.free_symbols):  # fmt: skip
            return None
        equations = lagrange_equations(self.known, last=2)
        at = self.expansions[-1:] if equations else []
        goals = [wanted, *(left - right for (left, right), _ in at)]
        goals = [sympy.expand(each) for each in goals if sympy.count_ops(each) < LARGEST_GOAL]
        for coordinate, equation, number in equations:
            for goal in goals:
                if goal.free_symbols & equation.free_symbols and is_multiple(goal, equation):
                    return Verdict(Outcome.HOLDS, f"Lagrange's equation for {_word(coordinate)}", (number,))
            if Cue.APPROXIMATE in self.cues and wanted.free_symbols <= equation.free_symbols:
                if _approximate_multiple(wanted, equation, self.meaning):
                    because = f"Lagrange's equation for {_word(coordinate)}, to the leading order"
                    return Verdict(Outcome.APPROXIMATES, because, (number,))
        return None

    def wants(self, symbol: Symbol) -> bool:
        return symbol in self.difference.free_symbols

    def vanishing(self) -> Verdict | None:
        """Judge the place where an earlier value vanishes: `The block leaves the sphere where cos(theta) = 2/3`."""
        if not self.cues & {Cue.ZERO, Cue.LEAVES} or self.claim.is_step or self.claim.relation != "=":
            return None
        if isinstance(self.left, MatrixBase) or isinstance(self.right, MatrixBase):
            return None
        for each in values_with(self.left, self.meaning, self.known, Cue.ZERO in self.cues):
            if is_zero(each.value.xreplace({self.left: self.right})):
                return Verdict(Outcome.HOLDS, f"{_word(each.symbol)} vanishes there", (each.claim,))
        return None

    def implied(self) -> Verdict | None:
        """Judge a step that introduces one letter with the help of a relation that the document does not state."""
        if not self.claim.is_step or isinstance(self.difference, MatrixBase) or self.claim.relation != "=":
            return None
        left, right = self.expansions[-1][0] if self.expansions else (self.left, self.right)
        new = sorted(right.free_symbols - left.free_symbols, key=str)
        gone = left.free_symbols - right.free_symbols
        if len(new) != 1 or not gone or new[0] in self.meaning.derivatives:
            return None
        try:
            found = sympy.solve(left - right, new[0])
        except (NotImplementedError, TypeError, ValueError):
            return None
        if len(found) != 1 or not found[0].free_symbols <= gone | left.free_symbols or sympy.count_ops(found[0]) > 12:
            return None
        if any(each.exp.is_Rational and not each.exp.is_Integer for each in found[0].atoms(sympy.Pow)):
            return None
        value = sympy.factor(found[0])
        self.known.define(new[0], value, self.claim.number, implied=True)
        return Verdict(Outcome.UNDECIDED, f"this holds if {_word(new[0])} = {value}, which no earlier row states")

    def otherwise(self) -> Verdict:
        left, right = self.expansions[-1][0] if self.expansions else (self.left, self.right)
        above = self.formula_above
        computed = above is not None or self.is_computed()
        display = self.claim.row.block.display
        if not self.claim.is_step and (not computed or (not display and self.cues & {Cue.GIVEN, Cue.PUT_IN})):
            return self.stated()
        if self.claim.relation != "=":
            return Verdict(Outcome.UNDECIDED, "this relation is not checked")
        if (instant := self.instant_in(left, right)) is not None:
            return Verdict(Outcome.HOLDS, f"the value at {_word(instant)}", at_place=True)
        if self.holds_in_motion_only(left, right):
            return Verdict(Outcome.UNDECIDED, "this may hold only because of the equations of motion")
        if (left.free_symbols ^ right.free_symbols) & set(self.meaning.sums):
            return Verdict(Outcome.UNDECIDED, "sums over an index are compared only as they are written")
        if entries := self.unknown_entries(left, right):
            return Verdict(Outcome.UNDECIDED, f"nothing is known about the entry {_word(entries[0])}")
        if opaque := self.opaque(left) | self.opaque(right):
            return Verdict(Outcome.UNDECIDED, f"nothing is known about {', '.join(sorted(map(_word, opaque)))}")
        new = (right.free_symbols - left.free_symbols) & (self.right.free_symbols - self.left.free_symbols)
        new |= {each for each in right.free_symbols - left.free_symbols if each not in self.left.free_symbols}
        if above is not None and (lost := self.lost_letter(left, right)) is not None:
            because = f"the formula before it gives a different value of {_word(above.symbol)}"
            return Verdict(Outcome.DIFFERS, because, why_plausible=f"the term {_word(lost)} was lost in that formula")
        if new - self.left.free_symbols:
            return Verdict(Outcome.UNDECIDED, f"only the right side contains {', '.join(sorted(map(_word, new)))}")
        if left.has(Integral) or right.has(Integral):
            return Verdict(Outcome.UNDECIDED, "an integral that derive cannot evaluate")
        if Cue.APPROXIMATE in self.cues and self.claim.row.block.display:
            return Verdict(Outcome.UNDECIDED, "the document speaks of an approximation here")
        if not computed and self.special_case(left, right):
            return Verdict(Outcome.UNDECIDED, "the right side may be a special case of the left side")
        if several := self.with_several_values():
            return Verdict(Outcome.UNDECIDED, f"{_word(several)} has several values in the rows before")
        if self.meaning.left_out is not None and not self.shows_the_terms(left, right):
            return Verdict(Outcome.UNDECIDED, "the order of the terms that are left out is not compared")
        if self.expansions and (self.known.conditions - self.known.here) & set(self.expansions[-1][1]):
            left, right = (expanded(self.known, each, sure=True)[0] for each in (self.left, self.right))
            if not self.claim.is_step or (left.free_symbols ^ right.free_symbols):
                return Verdict(Outcome.UNDECIDED, "it contains a letter that has its value in one case only")
        if above is not None and any(map(self.is_place, left.free_symbols - right.free_symbols)):
            return Verdict(Outcome.UNDECIDED, "this may be the value at one place or instant")
        example = counterexample(left, right)
        if not example:
            return Verdict(Outcome.UNDECIDED, "no numbers show whether the two sides are equal")
        if above is not None:
            because = f"the formula before it gives a different value of {_word(above.symbol)}"
            return Verdict(Outcome.DIFFERS, because, counterexample=example)
        return Verdict(Outcome.DIFFERS, "the two sides are not equal", counterexample=example)

    def instant_in(self, left: Expr, right: Expr) -> Symbol | None:
        """Return the instant t_1 that the right side contains if the right side is the value of the left side at this
        instant; otherwise None."""
        if self.claim.is_step:
            return None
        for symbol in self.right.free_symbols - self.left.free_symbols:
            named = self.meaning.symbols.get(symbol)
            if named is not None and named.base == "t" and named.sub:
                time = self.meaning.symbol(replace(named, sub=""))
                if same(left.subs(time, expanded(self.known, symbol)[0]), right):
                    return symbol
        return None

    def is_computed(self) -> bool:
        """Whether the left side is a rate or derivative whose value follows from a definition that always holds."""
        if not isinstance(self.left, Symbol) or not self.known.is_kinematic(self.left):
            return False
        found = self.known.computed(self.left)
        return found is not None and found.claim not in self.known.conditions

    def lost_letter(self, left: Expr, right: Expr) -> Symbol | None:
        """Return the letter whose value, with either sign, is the difference of two sides, or None."""
        for letter in self.known.definitions:
            value, _ = expanded(self.known, letter, sure=True)
            if letter != self.left and value.free_symbols <= right.free_symbols - {letter}:
                if not value.is_Symbol and any(same(right - left, sign * value) for sign in (1, -1)):
                    return letter
        return None

    def is_place(self, symbol: Symbol) -> bool:
        return bool(changing_letters({symbol}, self.meaning))

    @cached_property
    def formula_above(self) -> Definition | None:
        """The formula for the left side in the row above, or before the display in the same sentence, if this row
        evaluates the formula; otherwise None.

        A row evaluates a formula if some letters of the formula are missing in the row, and one of the missing letters
        has a value.
        """
        if self.claim.is_step or not isinstance(self.left, Symbol) or not self.known.is_defined(self.left):
            return None
        found = self.known.definitions[self.left][-1]
        if found.claim not in self.known.sentence and (found.row is None or found.row is not self.claim.row_above):
            return None
        evaluated = found.value.free_symbols - self.right.free_symbols
        return found if any(self.known.latest(each) is not None for each in evaluated) else None

    def shows_the_terms(self, left: Expr, right: Expr) -> bool:
        """Whether the error is of a lower order than the terms that are left out."""
        assert self.meaning.left_out is not None
        letter, wanted = self.meaning.left_out
        found = order_of_error(left, right, self.meaning, [(letter,)])
        return found is not None and found[1] < wanted

    def unknown_entries(self, left: Value, right: Value) -> list[Symbol]:
        """Return letters that name entries of matrices or tensors, such as I_12."""
        matrices = isinstance(left, MatrixBase) and isinstance(right, MatrixBase) and left.shape[1] > 1
        tensors = {base for base, *_ in self.meaning.facts.tensors}
        letters = self.meaning.symbols
        return [
            each
            for each in sorted(left.free_symbols | right.free_symbols, key=str)
            if (letter := letters.get(each)) is not None
            and letter.sub[-2:].isdigit()
            and len(letter.sub) >= 2
            and (matrices or letter.base in tensors)
        ]

    def with_several_values(self) -> Symbol | None:
        """Return a letter that has several values in one part; None if there is no such letter. Only letters that one
        side lacks, and letters in their definitions, are searched."""
        one_side = self.left.free_symbols ^ self.right.free_symbols
        for symbol in sorted(one_side, key=str):
            definition = self.known.latest(symbol)
            inner = definition.value.free_symbols if definition is not None else set()
            if symbol in self.meaning.evaluations:
                inner = inner | self.meaning.evaluations[symbol][2].free_symbols
            for each in (symbol, *sorted(inner - self.left.free_symbols & self.right.free_symbols, key=str)):
                found = self.known.definitions.get(each, [])
                values = {one.chain: one.value for one in found if one.part == found[-1].part}
                first, *others = [expanded(self.known, value)[0] for value in values.values()] or [each]
                if any(not same(first, other) for other in others):
                    return each
        return None

    def stated(self) -> Verdict:
        """Return the verdict on an equation that begins a chain and does not follow from earlier rows."""
        symbols = self.left.free_symbols | self.right.free_symbols
        if isinstance(self.left, Symbol) and self.left in self.meaning.evaluations:
            return Verdict(Outcome.DEFINES, "a condition at one instant or place")
        if isinstance(self.left, Symbol) and self.known.is_defined(self.left):
            before = self.known.definitions[self.left][-1]
            if Cue.REPEATED in self.cues:
                because = f"this value of {_word(self.left)} differs from its earlier value"
                return Verdict(Outcome.UNDECIDED, because, (before.claim,), repeated=before)
            for place, number, there in values_at_place(before.value, self.right, self.meaning):
                if same(there, self.right):
                    because = f"the earlier value at {_word(place)} = {number}"
                    return Verdict(Outcome.HOLDS, because, (before.claim,), at_place=True)
            if before.part not in (-1, self.claim.row.block.part):
                return Verdict(Outcome.DEFINES, f"a different value for {_word(self.left)} in another part")
            if self.cues & {Cue.DEFINED, Cue.GIVEN}:
                return Verdict(Outcome.DEFINES, f"a value for {_word(self.left)} in another case")
            return Verdict(Outcome.UNDECIDED, f"this value of {_word(self.left)} differs from its earlier value")
        if new := self.known.new_letters(symbols):
            if (number := self.has_negative_square(new)) is not None:
                because = f"with an earlier equation of motion, the square of {_word(new[0])} is negative"
                return Verdict(Outcome.DIFFERS, because, (number,), why_plausible="a sign was reversed")
            return Verdict(Outcome.DEFINES, f"an equation with the new letter {_word(new[0])}")
        if self.is_lagrange_form(symbols):
            return Verdict(Outcome.DEFINES, "Lagrange's equation")
        if self.cues & {Cue.LAW, Cue.GIVEN, Cue.DEFINED, Cue.CONSTANT} and Cue.APPROXIMATE not in self.cues:
            return Verdict(Outcome.DEFINES, "stated as a law or a condition")
        return Verdict(Outcome.UNDECIDED, "an equation that does not follow from the rows before it")

    def has_negative_square(self, new: list[Symbol]) -> int | None:
        """Return the number of an earlier equation of motion that makes the square of the only new letter negative;
        None if there is no such equation. In `x'' + w^2 x = 0`, the only new letter is w."""
        if len(new) != 1 or isinstance(self.difference, MatrixBase) or not new[0].is_positive:
            return None
        here = sympy.expand(self.difference)
        accelerations = [s for s in here.free_symbols if (a := self.meaning.symbols.get(s)) is not None and a.dots == 2]
        if len(accelerations) != 1 or not here.coeff(new[0], 2) or here.has(Integral):
            return None
        if sympy.expand(here - here.coeff(new[0], 2) * new[0] ** 2).has(new[0]):
            return None
        for equation, number in reversed(self.known.recent()):
            slope = sympy.diff(equation, accelerations[0])
            if slope == 0 or slope.free_symbols & set(accelerations):
                continue
            value = accelerations[0] - equation / slope
            squared = sympy.cancel((-here.coeff(new[0], 0) / here.coeff(new[0], 2)).subs(accelerations[0], value))
            if not any(map(self.known.is_rate, squared.free_symbols)):
                return number if squared.is_negative else None
        return None

    def is_lagrange_form(self, symbols: set[Symbol]) -> bool:
        """Whether an equation looks like Lagrange's equation: its derivatives are of one letter only, with respect to a
        coordinate and to a rate."""
        derivatives = [self.meaning.derivatives[each] for each in symbols if each in self.meaning.derivatives]
        letters = {letter.identity for letter, _, _ in derivatives}
        dots = {
            found.dots
            for _, by, _ in derivatives
            for each, _ in by[:1]
            if (found := self.meaning.symbols.get(each)) is not None
        }
        return len(letters) == 1 and {0, 1} <= dots

    def holds_in_motion_only(self, left: Value, right: Value) -> bool:
        """Whether a second time derivative, or a rate of a letter that usually names a momentum, is on one side
        only."""
        letters = self.meaning.symbols
        for each in left.free_symbols ^ right.free_symbols:
            letter = letters.get(each)
            if letter is not None and (letter.dots >= 2 or (letter.dots and letter.base in ("p", "L", "l", "J", "S"))):
                return True
        return False

    def special_case(self, left: Value, right: Value) -> bool:
        if any((letter := self.meaning.symbols.get(each)) is not None and letter.dots
               for each in left.free_symbols - right.free_symbols):  # fmt: skip
            return True  # the right side may be the value at rest
        lost = (left.free_symbols - right.free_symbols) & (self.left.free_symbols - self.right.free_symbols)
        if not lost or not self.cues & {Cue.GIVEN, Cue.PUT_IN, Cue.USING, Cue.SINCE}:
            return False
        return bool(self.cues & {Cue.GIVEN, Cue.PUT_IN}) or any(map(self.is_mentioned, lost))

    def opaque(self, value: Value) -> set[Symbol]:
        found = {each for each in value.free_symbols if each in self.meaning.derivatives or "(" in each.name}
        return found | {
            each for each in value.free_symbols if each.name.startswith("d") and each.name not in _names(self.meaning)
        }


def _names(meaning: Meaning) -> set[str]:
    return {each.name for each in meaning.symbols}


def entries_of(value: Value) -> list[Expr]:
    return list(value) if isinstance(value, MatrixBase) else [value]


def _word(symbol: Symbol) -> str:
    return f"`{symbol.name}`"


def _solves(equation: Expr, letter: Symbol, value: Expr) -> bool:
    for sign in (1, -1) if PLUS_MINUS in value.free_symbols else (1,):
        put_in = equation.subs(letter, value.subs(PLUS_MINUS, sign))
        if put_in != 0 and not _equal(put_in, Integer(0)):
            return False
    return True


def _combination(wanted: Expr, equations: list[tuple[Expr, int]]) -> tuple[int, ...] | None:
    """Return the claims of two or three equations that add up, with some choice of signs, to a multiple of the wanted
    equation; otherwise None."""
    goal = fingerprint(wanted)
    for count in (2, 3):
        for chosen in combinations(equations, count):
            prints = [fingerprint(each) for each, _ in chosen]
            for signs in product((1, -1), repeat=count - 1):
                weights = (1, *signs)
                if goal is not None and all(each is not None for each in prints):
                    sums = [sum(w * p[i] for w, p in zip(weights, prints, strict=True) if p) for i in range(len(goal))]
                    ratios = [a / b for a, b in zip(goal, sums, strict=True) if abs(b) > 1e-12]
                    if len(ratios) < len(goal) or any(abs(r - ratios[0]) > 1e-7 * abs(ratios[0]) for r in ratios):
                        continue
                total = sympy.expand(sum(w * each for w, (each, _) in zip(weights, chosen, strict=True)))
                if total != 0 and is_multiple(wanted, total):
                    return tuple(number for _, number in chosen)
    return None


def is_multiple(wanted: Expr, equation: Expr) -> bool:
    if wanted == 0 or equation == 0:
        return False
    return any(_equal(wanted, ratio * equation) for ratio in _ratios(wanted, equation))


def _ratios(wanted: Expr, equation: Expr) -> Iterator[Expr]:
    first = _terms(wanted)[0]
    terms = _terms(equation)
    for term in terms:
        ratio = first / term
        if len(terms) == 1 and sympy.denom(ratio).free_symbols:
            continue  # a product that vanishes says nothing about one of its factors
        factors = sympy.Mul.make_args(ratio)
        if all(not factor.as_base_exp()[0].is_Add for factor in factors):
            yield ratio


def _terms(value: Expr) -> tuple[Expr, ...]:
    return tuple(sympy.Add.make_args(value if value.is_Add else sympy.expand(value)))


def _points(symbols: set[Symbol], seed: int) -> Iterator[dict[Symbol, Rational]]:
    source = Random(seed)
    for _ in range(POINTS):
        yield {each: Rational(source.randint(7, 40), source.randint(7, 29)) for each in sorted(symbols, key=str)}


def _relative_error(left: Expr, right: Expr) -> float | None:
    worst = 0.0
    symbols = left.free_symbols | right.free_symbols
    for point in _points(symbols, 3):
        errors = []
        for sign in (1, -1) if PLUS_MINUS in symbols else (1,):
            put_in = {**point, PLUS_MINUS: Integer(sign)}
            one, other = (sympy.N(each.xreplace(put_in), 30) for each in (left, right))
            if not (one.is_number and other.is_number and one.is_finite and other.is_finite):
                return None
            size = max(Abs(one), Abs(other))
            errors.append(float(Abs(one - other) / size) if size else 0.0)
        worst = max(worst, *errors)
        if not symbols:
            break
    return worst


def small_letters(symbols: set[Symbol], meaning: Meaning) -> list[tuple[Symbol, ...]]:
    """Return the sets of letters that can be small: first all `changing_letters`, then each letter alone."""
    changing = changing_letters(symbols, meaning)
    single = [(each,) for each in sorted(symbols, key=str)]
    return ([changing] if changing else []) + single


def order_of_error(
    left: Expr, right: Expr, meaning: Meaning, among: list[tuple[Symbol, ...]] | None = None
) -> tuple[tuple[Symbol, ...], int] | None:
    """Return small letters in which two sides agree to the leading order, and the order of their difference;
    otherwise None."""
    symbols = left.free_symbols | right.free_symbols
    for letters in small_letters(symbols, meaning) if among is None else among:
        slopes = []
        for point in _points(symbols, 5):
            sizes = []
            for scale in SMALL:
                put_in = {each: value * (scale if each in letters else 1) for each, value in point.items()}
                put_in[PLUS_MINUS] = Integer(1)
                one, other = (sympy.N(each.xreplace(put_in), 40) for each in (left, right))
                if not (one.is_number and other.is_number and one.is_finite and other.is_finite) or other == 0:
                    break
                sizes.append((Abs(one - other), Abs(other)))
            if len(sizes) < 2 or sizes[1][0] == 0:
                break
            of_error = float(sympy.log(sizes[0][0] / sizes[1][0], 10))
            of_value = float(sympy.log(sizes[0][1] / sizes[1][1], 10))
            slopes.append((of_error, of_value))
        if len(slopes) == POINTS and all(error - value > 0.8 for error, value in slopes):
            return letters, round(min(error for error, _ in slopes))
    return None


def degree(value: Expr, letters: tuple[Symbol, ...]) -> int:
    poly = value.as_poly(*letters)
    return int(poly.total_degree()) if poly is not None else 0


def _approximate_multiple(wanted: Expr, equation: Expr, meaning: Meaning) -> bool | None:
    """Return True if one equation agrees to the leading order with a multiple of an earlier equation, and None if this
    is not known."""
    symbols = wanted.free_symbols | equation.free_symbols
    for letters in filter(None, [changing_letters(symbols, meaning)]):
        scale = Symbol("epsilon_", positive=True)
        leading = []
        for each in (wanted, equation):
            try:
                scaled = each.subs({letter: scale * letter for letter in letters}, simultaneous=True)
                leading.append(sympy.series(scaled, scale, 0, 3).removeO().as_leading_term(scale) / scale)
            except (ValueError, NotImplementedError, TypeError, AttributeError):
                return None
        if leading[1] != 0 and is_multiple(sympy.expand(leading[0]), sympy.expand(leading[1])):
            return True
    return None


def counterexample(left: Value, right: Value) -> str:
    """Return an example with numbers, as text, in which two sides differ; an empty text if none is found."""
    symbols = sorted(left.free_symbols | right.free_symbols, key=str)
    for point in _simple_points(symbols):
        for one, other in zip(entries_of(left), entries_of(right), strict=False):
            numbers = [sympy.N(each.subs(point), 12) for each in (one, other)]
            if not all(each.is_number and each.is_finite and each.is_real for each in numbers):
                continue
            if abs(numbers[0] - numbers[1]) > CLOSE * max(map(abs, numbers)):
                at = ", ".join(f"{symbol.name} = {value}" for symbol, value in point.items())
                sides = f"{_number(numbers[0])} against {_number(numbers[1])}"
                return f"{sides}" + (f" for {at}" if at and len(at) < 160 else "")
    return ""


def _simple_points(symbols: list[Symbol]) -> Iterator[dict[Symbol, Expr]]:
    """Yield points with simple numbers for the letters: integers, integers with small rates, integers in reverse order,
    and fractions."""
    for start in (1, 2, 3):
        yield {each: Integer(start + i) for i, each in enumerate(symbols)}
    for size in (10, 100):
        yield {each: Rational(1 + i, size if each.name.endswith(".") else 1) for i, each in enumerate(symbols)}
    yield {each: Integer(len(symbols) - i) for i, each in enumerate(symbols)}
    for turned in (False, True):
        yield {each: Rational(1, 2 + i) for i, each in enumerate(reversed(symbols) if turned else symbols)}


def _number(value: Expr) -> str:
    return f"{float(value):.6g}"


__all__ = ["Decision", "Sequence", "counterexample", "entries_of", "is_multiple", "order_of_error", "same"]
