"""The earlier row that is probably wrong, if later rows do not follow."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise

from sympy import Expr, MatrixBase, Symbol

from derive.audit.changes import SECONDS_OF_SEARCH, Changes
from derive.audit.claims import GOOD, Claim, Definition, Outcome, Verdict
from derive.audit.copied_rows import unchanged_index
from derive.audit.deciding import Decision, entries_of, same
from derive.audit.dimensions import odd_claims
from derive.audit.knowledge import Known
from derive.audit.memory import GIVEN_UP, Memory, WithMemory
from derive.audit.named_quantities import named_quantities
from derive.audit.nearest_change import Nearness, letters_in, terms_in
from derive.audit.numeric import Numbers
from derive.audit.reading import scope_of
from derive.audit.slips import WHY, Edit, edits_of_side
from derive.audit.time_limit import time_limited
from derive.documents.source import Span
from derive.documents.syntax import Fun, Letter, Node, Num, Sum

MOST_FIXED = 5  # at most this many earlier rows are searched for a slip other than a lost term
ENERGIES = ("L", "T", "K", "U", "V", "H")


@dataclass(frozen=True)
class Fix:
    """A change of an earlier row after which `claim` would follow."""

    claim: Claim
    earlier: Claim
    edit: Edit


class Blame(WithMemory):
    """The search for the earlier row that makes later rows wrong."""

    def __init__(self, memory: Memory, changes: Changes):
        super().__init__(memory)
        self.changes = changes
        self.fixes: list[Fix] = []
        self.confirmed: set[int] = set()
        self.accused: set[int] = set()

    def blame_all(self, confirmed: set[int], accused: set[int]) -> None:
        """Blame the earlier rows that make later rows wrong.

        confirmed   the numbers of claims that agree with a derivation, so that they are not blamed
        accused     the numbers of claims that contradict a derivation, so that no other row is blamed instead
        """
        self.confirmed, self.accused = confirmed, accused
        self.fixes = [
            fix for fix in self.fixes if fix.earlier.number not in confirmed and fix.claim.number not in accused
        ]
        self.blame_common_rows()
        self.blame_earlier_rows()
        self.blame_formulas()
        self.blame_odd_dimensions()
        self.blame_copied_rows()
        self.blame_equal_roots()

    def fixes_before(self, claim: Claim) -> list[Fix]:
        """Return changes of earlier rows, each of which would make a claim follow."""
        sides = [side for side in (claim.left, claim.right) if side is not None]
        if claim.values is None or any(isinstance(node, Sum) for side in sides for node in side.walk()):
            return []  # the letters with an index in a sum are not the letters of other rows
        found: list[Fix] = []
        wanted = self.letters_behind(claim)
        undecided = claim.verdict is not None and claim.verdict.outcome is not Outcome.DIFFERS
        tried = 0
        for earlier in reversed(self.claims[: claim.number]):
            if self.memory.scope_of(earlier) != self.memory.scope or tried == MOST_FIXED:
                break
            if not self.may_be_changed(earlier) or earlier.statement is claim.statement:
                continue
            if not self.letters_behind(earlier) & wanted:
                continue
            if not claim.row.block.display and not earlier.row.block.display:
                continue  # two formulas in sentences may be about different cases
            if undecided and not self.changes.belongs_to(claim, earlier) and not self.changes.is_motion(earlier):
                continue  # a later part may be about another case
            tried += 1
            letters: list[Node] = [*letters_in(claim.left, claim.right)] if not undecided else []
            edit = self.changes.near_edit(earlier, self.memory.known_without(earlier, claim), letters)
            found += [Fix(claim, earlier, edit)] if edit is not None else []
        return found or self.lost_before(claim)

    def lost_before(self, claim: Claim) -> list[Fix]:
        """Return the change that adds a lost term to the earlier value of a letter on the left side of a step. The term
        is on the right side of the step. The list is empty if there is no such change."""
        assert claim.values is not None
        if not claim.is_step or claim.right is None:
            return []
        terms = terms_in([claim.right], self.memory.shown)
        for earlier in reversed(self.claims[: claim.number]):
            if not self.may_be_changed(earlier) or earlier.statement is claim.statement or earlier.values is None:
                continue
            letter = earlier.values[0].as_base_exp()[0]
            if self.memory.scope_of(earlier) == self.memory.scope and letter in claim.values[0].free_symbols:
                edit = self.changes.near_edit(earlier, self.memory.known_without(earlier, claim), terms)
                if edit is not None:
                    return [Fix(claim, earlier, edit)]
        return []

    def may_be_changed(self, claim: Claim) -> bool:
        if claim.verdict is None or claim.verdict.outcome not in (Outcome.DEFINES, Outcome.UNDECIDED) or claim.is_step:
            return False
        if claim.number in self.confirmed:
            return False
        if claim.relation not in ("=", ":=") or claim.left is None or claim.right is None or claim.values is None:
            return False
        if any(isinstance(each, Fun) and each.name == "order" for each in claim.right.walk()):
            return False  # O(x^2) has no value
        return not any(isinstance(each, MatrixBase) for each in claim.values) and not self.defines_energy(claim)

    def defines_energy(self, claim: Claim) -> bool:
        """Whether a claim is L = T - U or H = p x' - L, which define the Lagrangian and the Hamiltonian."""
        assert claim.values is not None
        left, right = claim.values
        if not left.is_Symbol or not right.is_Add:
            return False
        named = {self.meaning.symbols[each].base: each for each in right.free_symbols if each in self.meaning.symbols}
        letter = self.meaning.symbols.get(left)
        base = letter.base if letter is not None else ""
        if base == "L":
            return set(named) in ({"T", "U"}, {"T", "V"}) and len(right.free_symbols) == 2
        return base in ("H", "h") and {"p", "L"} <= set(named) and right.coeff(named["L"]) == -1

    def letters_behind(self, claim: Claim) -> set[Symbol]:
        """Return the letters of a claim, and the letters from which their values are computed."""
        assert claim.values is not None
        found: set[Symbol] = set()
        waiting: set[Symbol] = set().union(*(value.free_symbols for side in claim.values for value in entries_of(side)))
        while waiting:
            found |= waiting
            values = [self.known.surely(each) for each in waiting]
            waiting = set().union(*(each.value.free_symbols for each in values if each is not None)) - found
        return found

    def blame_common_rows(self) -> None:
        """If several rows of a problem differ, and all of them would follow after the same change of an earlier value,
        blame the row of this value."""
        by_scope: dict[int, list[Claim]] = {}
        for each in self.claims:
            if each.values and each.verdict and each.row.block.display:
                if each.verdict.outcome is Outcome.DIFFERS and each.verdict.inherits is None:
                    by_scope.setdefault(self.memory.scope_of(each), []).append(each)
        for differing in by_scope.values():
            self.memory.return_to(differing[0])
            suspects = [each for each in self.claims[: differing[-1].number] if self.is_common(each, differing)]
            for suspect in suspects[-MOST_FIXED:]:
                if self.blame_common_row(suspect, [each for each in differing if each.number > suspect.number]):
                    break

    def is_common(self, suspect: Claim, differing: Sequence[Claim]) -> bool:
        """Whether an earlier value may be used in at least two of these rows, and in all of them that are after it."""
        if not suspect.row.block.display or self.memory.scope_of(suspect) != self.memory.scope:
            return False
        later = [each for each in differing if each.number > suspect.number]
        return len(later) > 1 and self.may_be_changed(suspect) and all(self.may_use(each, suspect) for each in later)

    def blame_common_row(self, suspect: Claim, later: Sequence[Claim]) -> bool:
        with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
            edit = self.common_edit(suspect, later)
            if edit is not None:
                self.blame(suspect, [Fix(each, suspect, edit) for each in later])
                self.fixes = [fix for fix in self.fixes if fix.claim not in later]
                return True
        return False

    def may_use(self, claim: Claim, earlier: Claim) -> bool:
        """Whether a claim may depend on an earlier value: it contains the letter, or it has rates and the value is an
        energy."""
        assert earlier.values is not None and claim.values is not None
        letter = earlier.values[0].as_base_exp()[0]
        named = self.meaning.symbols.get(letter)
        behind = self.letters_behind(claim)
        moves = any(map(self.known.is_rate, behind))
        return letter in behind or (moves and named is not None and named.base in ENERGIES)

    def common_edit(self, suspect: Claim, later: Sequence[Claim]) -> Edit | None:
        """Return the cheapest change of the right side of a row after which all these later rows follow, or None."""
        assert suspect.values is not None and suspect.right is not None
        letter, node = suspect.values[0], self.memory.reading(suspect.right)
        states = [self.memory.known_without(suspect, each, before=True) for each in later]

        def follow(value: Expr) -> Iterator[bool]:
            new = Definition(letter, value, suspect.number)
            for claim, known in zip(later, states, strict=True):
                definitions = {**known.definitions, letter: [new, *known.definitions.get(letter, ())]}
                equations = [*known.equations, (letter - value, suspect.number)]
                changed = replace(known, definitions=definitions, equations=equations, kept={})
                yield self.follows(claim, changed, surely=claim is later[0])

        if next(follow(suspect.values[1])):
            return None  # the first of these rows does not depend on this value
        letters = letters_in(suspect.right, *(each.right for each in later))
        near = Nearness(self.meaning, states[0], letters, self.memory.shown, written=True)
        return next((each for each in near.edits(node) if all(follow(self.meaning.of(each.node)))), None)

    def follows(self, claim: Claim, known: Known, surely: bool) -> bool:
        """Whether a claim follows from the given knowledge; unless `surely` is true, also if no change of the claim
        would follow."""
        if claim.values is None:
            return False
        kept, self.memory.known = self.known, known
        try:
            verdict = Decision(claim, *claim.values, self.meaning, known, claim.row.block.cues).verdict()
            defines = verdict.outcome is Outcome.DEFINES
            if defines:
                return not surely and self.changes.near_edit(claim, known) is None
            return verdict.outcome in GOOD
        finally:
            self.memory.known = kept

    def blame(self, earlier: Claim, fixes: Sequence[Fix]) -> None:
        """Report an earlier row as wrong, because later rows would follow after one change of this row."""
        lines = ", ".join(str(fix.claim.row.line) for fix in fixes)
        where = f"line{'s' * (len(fixes) > 1)} {lines}"
        edit = fixes[0].edit
        earlier.verdict = Verdict(
            Outcome.DIFFERS, f"{where} would follow after one change here", suggestion=edit.suggestion,
            why_plausible=WHY[edit.kind], span=edit.span,
        )  # fmt: skip
        for claim in [each for fix in fixes for each in (fix.claim, *self.followers(fix.claim))]:
            because = "it follows from a row that is probably wrong"
            claim.verdict = Verdict(Outcome.HOLDS, because, inherits=earlier.number)

    def blame_earlier_rows(self) -> None:
        explained: dict[int, Claim] = {}  # the blamed row, by the number of a claim that follows after its change
        for fixes in self.fixes_by_row():
            earlier, meant = fixes[0].earlier, fixes[0].edit.suggestion
            if all(fix.claim.number in explained for fix in fixes):
                for blamed in {explained[fix.claim.number].number for fix in fixes}:
                    verdict = self.claims[blamed].verdict
                    assert verdict is not None
                    verdict.or_lines += (earlier.row.line,)
                continue
            alone = all(fix.claim.verdict is None or not fix.claim.verdict.suggestion for fix in fixes)
            if len(fixes) > 1 or alone or any(self.followers(fix.claim) for fix in fixes):
                claims = [each for fix in fixes for each in (fix.claim, *self.followers(fix.claim))]
                explained.update((each.number, earlier) for each in claims)
                self.blame(earlier, fixes)
                continue
            for fix in fixes:
                if fix.claim.verdict is not None and fix.claim.verdict.outcome is Outcome.DIFFERS:
                    fix.claim.verdict.or_lines += (earlier.row.line,)
                    fix.claim.verdict.because += f"; or the slip is in line {earlier.row.line}: {meant}"

    def fixes_by_row(self) -> list[list[Fix]]:
        """Return the fixes with the most frequent change of each earlier row. Rows after whose change the most later
        rows follow come first."""
        found = []
        for earlier in {fix.earlier.number: fix.earlier for fix in self.fixes}.values():
            of_row = [fix for fix in self.fixes if fix.earlier is earlier]
            edits = Counter((fix.edit.was, fix.edit.meant) for fix in of_row)
            chosen, _count = edits.most_common(1)[0]
            found.append([fix for fix in of_row if (fix.edit.was, fix.edit.meant) == chosen])
        return sorted(found, key=lambda fixes: (-len(fixes), fixes[0].edit.cost, fixes[0].earlier.number))

    def followers(self, claim: Claim) -> list[Claim]:
        """Return the later claims that follow only from a wrong claim: they show that this claim may be right."""
        return [each for each in self.claims if each.verdict is not None and each.verdict.inherits == claim.number]

    def blame_formulas(self) -> None:
        """If two rows give different values of a letter, blame the first if later rows follow only from the second."""
        for claim in self.claims:
            verdict = claim.verdict
            if verdict is None or verdict.outcome is not Outcome.DIFFERS or verdict.contradicts is None:
                continue
            formula, line = self.claims[verdict.contradicts], self.claims[verdict.contradicts].row.line
            if formula.verdict is None or formula.verdict.outcome is Outcome.DIFFERS or claim.number in self.accused:
                continue
            later = self.followers(claim)
            between = self.claims[formula.number + 1 : claim.number]
            used = any(each.verdict and formula.number in each.verdict.given for each in between)
            of_same = formula.values is not None and claim.values is not None and formula.values[0] == claim.values[0]
            if used or not of_same or formula.verdict.outcome is Outcome.HOLDS:
                later = []
            if later:
                self.blame_formula(formula, claim)
                claim.verdict = Verdict(Outcome.HOLDS, "later rows follow from this value")
                for each in later:
                    each.verdict = Verdict(Outcome.HOLDS, "it follows from an earlier row", (claim.number,))
            elif line not in (claim.row.line, *verdict.or_lines):
                verdict.or_lines += (line,)
                verdict.because += f"; or the slip is in line {line}"

    def blame_formula(self, formula: Claim, claim: Claim) -> None:
        """Blame a formula that contradicts the value in `claim`, or else the earlier value of one of its letters, if
        one change of this value, but no change of the formula, gives the value in `claim`."""
        assert claim.verdict is not None
        self.memory.return_to(claim)
        because = f"line {claim.row.line} contradicts this row, and later rows follow only from line {claim.row.line}"
        letters = self.letters_behind(formula)
        behind = [each for each in self.claims[: claim.number] if each.values and each.values[0] in letters]
        suspects = [each for each in reversed(behind) if each is not formula and self.may_be_changed(each)]
        suspects = [formula, *suspects] if not self.defines_energy(formula) else suspects
        edits: list[tuple[Claim, Edit]] = []
        for suspect in suspects:
            with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
                lost: list[Node] | None = [*letters_in(suspect.right, claim.right)] if suspect is not formula else None
                edit = self.changes.near_edit(suspect, self.memory.known_without(suspect, claim), lost)
                edits += [(suspect, edit)] if edit is not None else []
        verdict = replace(claim.verdict, because=because, suggestion="", span=None)
        blamed = formula
        if edits:
            blamed, edit = edits[0]
            verdict.suggest(edit)
        verdict.or_lines = (claim.row.line, *(each.row.line for each, _ in edits[1:]))
        blamed.verdict = verdict

    def blame_copied_rows(self) -> None:
        """Blame a law that was copied from the display before it, or after it, with one index unchanged."""
        stated = [each for each in self.claims if each.row.block.display and self.may_be_changed(each)]
        for before, after in pairwise(stated):
            if self.memory.scope_of(before) != self.memory.scope_of(after):
                continue
            for copy, original in ((after, before), (before, after)):
                edit = unchanged_index(copy, original)
                if edit is not None and copy.verdict is not None and copy.verdict.outcome is Outcome.DEFINES:
                    because = f"all other indices differ from those in line {original.row.line}"
                    copy.verdict = Verdict(Outcome.DIFFERS, because)
                    copy.verdict.suggest(edit)

    def blame_equal_roots(self) -> None:
        """If two rows of a display give w_1 and w_2 the same root of an equation, blame the row in which another sign
        gives another root: the greater root is w_2, by convention."""
        found = [
            each
            for each in self.claims
            if each.values and each.row.block.display and not each.is_step and each.values[0].is_Symbol
            and each.verdict is not None and each.verdict.outcome is Outcome.HOLDS
        ]  # fmt: skip
        for first, second in pairwise(found):
            if first.row.block is not second.row.block or not self.have_one_value(first, second):
                continue
            with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
                self.memory.return_to(second)
                for claim, is_greater in ((first, False), (second, True)):
                    edit = self.other_root(claim, is_greater)
                    if edit is not None and claim.verdict is not None:
                        other = second if claim is first else first
                        because = f"it has the same value as the letter in line {other.row.line}"
                        claim.verdict = Verdict(Outcome.DIFFERS, because, or_lines=(other.row.line,))
                        claim.verdict.suggest(edit)

    def have_one_value(self, first: Claim, second: Claim) -> bool:
        """Whether two letters with the indices 1 and 2, or 2 and 3, and so on, have the same value."""
        assert first.values is not None and second.values is not None
        names = [self.meaning.symbols.get(each.values[0]) for each in (first, second) if each.values]
        one, other = (each or Letter(Span(0, 0), "") for each in names)
        follows = one.sub.isdigit() and other.sub.isdigit() and int(one.sub) + 1 == int(other.sub)
        return follows and one.base == other.base and same(first.values[1], second.values[1])

    def other_root(self, claim: Claim, is_greater: bool) -> Edit | None:
        """Return the sign with which a row gives another root of an earlier equation that is greater, or smaller."""
        assert claim.values is not None and claim.right is not None
        known = self.memory.known_without(claim, claim, before=True)
        node = self.memory.reading(claim.right)
        for edit in edits_of_side(node, [], self.memory.shown):
            if edit.kind != "sign":
                continue
            value = self.meaning.of(edit.node)
            numbers = Numbers(self.meaning, lambda symbol: symbol, 0)
            new, old = numbers.of(value).real, numbers.of(claim.values[1]).real
            if new > 0 and (new > old if is_greater else new < old):
                is_root = Decision(claim, claim.values[0], value, self.meaning, known, frozenset()).verdict()
                if is_root.outcome is Outcome.HOLDS:
                    return edit
        return None

    def blame_odd_dimensions(self) -> None:
        """Report the row, if any, whose terms contradict the dimensions that all other rows of its problem or section
        give."""
        named = named_quantities(self.memory.document, lambda row: scope_of(self.memory.document, row))
        by_scope: dict[int, list[Claim]] = {}
        zero = {id(each.statement) for each in self.claims if isinstance(each.right, Num) and each.right.text == "0"}
        for claim in self.claims:
            both_vanish = (
                id(claim.statement) in zero and isinstance(claim.left, Letter) and isinstance(claim.right, Letter)
            )
            if not both_vanish:  # x' = x'' = 0 says nothing about dimensions
                by_scope.setdefault(self.memory.scope_of(claim), []).append(claim)
        for scope, claims in by_scope.items():
            odd = odd_claims(claims, self.meaning, named.get(scope, {}))
            if odd:
                others = tuple(dict.fromkeys(each.row.line for each in odd[1:]))
                because = "the dimensions of its terms contradict the other rows"
                odd[0].verdict = Verdict(Outcome.DIFFERS, because, or_lines=others)
