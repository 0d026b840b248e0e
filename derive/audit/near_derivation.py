"""The rows that agree with a derivation, and the rows that would agree with it after one small change.

The value of a letter is compared with the results for this letter; an equation is compared with the equations of the
derivation. A row that agrees with the derivation is right, also if it contradicts other rows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.accusing import Accuser
from derive.audit.blame import ENERGIES
from derive.audit.changes import SECONDS_OF_SEARCH
from derive.audit.claims import Claim, Definition, Outcome, Verdict
from derive.audit.deciding import is_multiple, same
from derive.audit.expected import Result, Section, is_solved_by
from derive.audit.knowledge import ASSUMED, Known
from derive.audit.memory import GIVEN_UP, Memory, WithMemory
from derive.audit.nearest_change import Nearness, letters_in
from derive.audit.slips import WHY
from derive.audit.time_limit import time_limited
from derive.documents.syntax import Node

FEWEST_OPERATIONS = 3  # a shorter result is one change away from too many other values


@dataclass(frozen=True)
class Chain:
    """The first and the last side of a chain up to one claim."""

    claim: Claim
    left: Node
    right: Node
    values: tuple[Expr, Expr]

    @property
    def difference(self) -> Expr:
        return self.values[0] - self.values[1]


class NearDerivation(WithMemory):
    """The search for rows that a derivation confirms or contradicts."""

    def __init__(self, memory: Memory, accuser: Accuser):
        super().__init__(memory)
        self.accuser = accuser
        self.confirmed: set[int] = set()  # the numbers of claims that agree with a derivation
        self.accused: set[int] = set()  # the numbers of claims that would agree with it after one change

    def examine(self, section: Section) -> None:
        """Report the rows of a section that would agree with a derivation after one change, and acquit the rows that
        agree with it."""
        for claim in section.claims:
            if claim.values is None or claim.verdict is None or claim.relation not in ("=", ":="):
                continue
            with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
                self.memory.return_to(claim)
                self.examine_claim(claim, claim.verdict, section)

    def examine_claim(self, claim: Claim, verdict: Verdict, section: Section) -> None:
        row = self.row_of(claim)
        if row is None or verdict.outcome not in (Outcome.DEFINES, Outcome.UNDECIDED, Outcome.DIFFERS):
            return
        similar = list(self.similar_results(row, section))
        if any(self.agrees(row, result, equation, known) for result, equation, known in similar):
            self.confirmed.add(claim.number)
            if verdict.outcome is Outcome.DIFFERS and not claim.is_step:
                claim.verdict = Verdict(Outcome.HOLDS, "the derivation gives the same")
        elif not self.accuser.is_left_alone(claim) and not self.is_special(claim):
            self.compare(row, section, similar)

    def is_special(self, claim: Claim) -> bool:
        """Whether a display gives a value at the place or instant that its sentence names."""
        return bool(claim.row.block.display) and claim.number in self.known.conditions

    def agrees(self, row: Chain, result: Result, equation: Expr, known: Known) -> bool:
        """Whether a row states a result, perhaps after the definitions of the document are substituted."""
        if result.symbol is not None and is_solved_by(*row.values, result.symbol, result.right):
            return True
        if is_multiple(sympy.expand(row.difference), sympy.expand(equation)):
            return True
        if row.values[0] != result.symbol:
            return False
        return any(same(one, other) for (one, other), _ in known.expanded(row.values[1], result.right))

    def row_of(self, claim: Claim) -> Chain | None:
        first = claim
        while first.before is not None:
            first = first.before
        if first.values is None or first.left is None or claim.right is None or claim.values is None:
            return None
        values = first.values[0], claim.values[1]
        if any(isinstance(each, MatrixBase) for each in values):
            return None
        return Chain(claim, self.memory.reading(first.left), self.memory.reading(claim.right), values)

    def compare(self, row: Chain, section: Section, similar: Sequence[tuple[Result, Expr, Known]]) -> None:
        """Report a row that would agree with a result after one change, or with one more term."""
        complete = bool(row.claim.row.block.display) and not self.memory.may_be_special(row.claim)
        is_repeated = self.is_repeated(row.claim)
        for result, equation, known in similar:
            if is_repeated and not result.expected.asked:
                continue  # the letter may have another meaning than in the derivation
            known.state(equation, ASSUMED)
            letters = {(e.identity, e.dots): e for e in letters_in(row.left, row.right, result.name, result.node)}
            near = Nearness(
                self.meaning, known, list(letters.values()), self.memory.shown, written=True,
                terms=[] if complete else None,
            )  # fmt: skip
            edit = near.of_claim(row.left, row.right, None, is_step=False)
            if edit is not None and not self.accuser.may_be_right(row.claim, edit):
                self.accuse(row.claim, result).suggest(edit)
                return
        for result, equation in self.comparable_results(row, section) if complete else ():
            known = Known(self.meaning)
            known.state(equation, ASSUMED)
            lost = Nearness(self.meaning, known, [], self.memory.shown, written=True, terms=[]).lost_term(
                row.difference
            )
            if lost is not None:
                verdict = self.accuse(row.claim, result)
                verdict.suggestion, verdict.why_plausible = f"with the term {lost}", WHY["lost term"]
                return

    def is_repeated(self, claim: Claim) -> bool:
        """Whether the next side of the same chain agrees with the right side of a claim."""
        later = self.claims[claim.number + 1 : claim.number + 2]
        return any(each.before is claim and each.verdict and each.verdict.outcome is Outcome.HOLDS for each in later)

    def accuse(self, claim: Claim, result: Result) -> Verdict:
        because = f"the derivation of {result.expected.problem} gives ${result.expected.latex}$"
        claim.verdict = Verdict(Outcome.DIFFERS, because, choices=claim.verdict.choices if claim.verdict else ())
        self.accused.add(claim.number)
        return claim.verdict

    def similar_results(self, row: Chain, section: Section) -> Iterator[tuple[Result, Expr, Known]]:
        """Yield the results with similar letters as a row, each with its equation and with the definitions of the
        document that the comparison needs."""
        for result, equation in self.comparable_results(row, section):
            if have_similar_letters(row.difference, equation):
                yield result, equation, Known(self.meaning)
            elif result.symbol == row.values[0]:
                known = self.definitions_for(row, section)
                expanded = list(known.expanded(row.values[1], result.right))
                if expanded and have_similar_letters(*expanded[-1][0]):
                    yield result, equation, known

    def comparable_results(self, row: Chain, section: Section) -> Iterator[tuple[Result, Expr]]:
        """Yield the results about the same letter as a row, or the equations if the row is an equation; each with its
        equation, left side minus right side."""
        names_value = self.is_value(row.values[0])
        for result in section.results.values() if self.knows_letters(row, section) else ():
            if result.relation != "=" or isinstance(result.right, MatrixBase):
                continue
            left = self.meaning.of(result.name)
            if isinstance(left, MatrixBase) or sympy.count_ops(left - result.right) < FEWEST_OPERATIONS:
                continue
            if left != row.values[0] and (self.is_value(left) or (names_value and not self.has_rates(result))):
                continue
            if isinstance(left, Symbol) and left not in row.difference.free_symbols:
                continue
            if not self.is_other_place(row.difference, left - result.right):
                yield result, left - result.right

    def has_rates(self, result: Result) -> bool:
        """Whether a result is an equation with rates, which a row may solve for a force."""
        return not result.is_named and any(map(self.known.is_rate, result.symbols))

    def is_value(self, left: Expr) -> bool:
        """Whether a side is a letter without dots."""
        return isinstance(left, Symbol) and left not in self.meaning.derivatives and not self.known.is_rate(left)

    def knows_letters(self, row: Chain, section: Section) -> bool:
        """Whether the derivation contains the letters of a row, except for letters that only this row contains."""
        known = set[Symbol]().union(*(each.symbols | {each.symbol} for each in section.results.values()))
        letters = [self.meaning.symbols.get(each) for each in row.difference.free_symbols - known]
        return all(each is not None and self.accuser.changes.written[each.identity] == 1 for each in letters)

    def is_other_place(self, one: Expr, other: Expr) -> bool:
        """Whether two equations differ in one letter, such as v_0 and v_1: they are about different instants."""
        letters = self.meaning.symbols
        first = [letters[each].base for each in one.free_symbols - other.free_symbols if each in letters]
        second = [letters[each].base for each in other.free_symbols - one.free_symbols if each in letters]
        return len(first) == 1 and first == second

    def definitions_for(self, row: Chain, section: Section) -> Known:
        """Return the definitions before a row, except those of the letter on the left side of the row, and with the
        values of the derivation for energies and momenta."""
        named = Counter(result.symbol for result in section.results.values())
        earlier = set(range(row.claim.number)) - self.known.conditions
        definitions = {
            symbol: general
            for symbol, found in self.known.definitions.items()
            if (general := [each for each in found if each.claim in earlier])
        }
        for result in section.results.values():
            letter = self.meaning.symbols.get(result.symbol)
            if letter is None or letter.dots or letter.base not in (*ENERGIES, "p") or named[result.symbol] > 1:
                continue
            if result.symbol is not None and result.relation == "=" and isinstance(result.right, Expr):
                definitions[result.symbol] = [Definition(result.symbol, result.right, ASSUMED)]
        definitions.pop(row.values[0], None)
        return replace(self.known, definitions=definitions, equations=[], slips={}, kept={})


def have_similar_letters(one: Expr, other: Expr) -> bool:
    """Whether each of two expressions contains at most one letter that the other one does not contain."""
    return len(one.free_symbols - other.free_symbols) <= 1 and len(other.free_symbols - one.free_symbols) <= 1
