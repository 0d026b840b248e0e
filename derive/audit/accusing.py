"""The rows that do not follow, but would follow after one small change."""

from __future__ import annotations

import re
from collections import Counter

from sympy import MatrixBase, Symbol

from derive.audit.blame import Blame
from derive.audit.changes import DISTINCT, REFERENCE, Changes
from derive.audit.claims import Claim, Outcome, Verdict
from derive.audit.deciding import same
from derive.audit.memory import Memory, WithMemory
from derive.audit.nearest_change import TOO_EASY, Nearness
from derive.audit.slips import WHY, Edit
from derive.audit.systems import (
    motion_of,
    values_at_place,
)
from derive.documents.layout import Cue
from derive.documents.syntax import (
    Int,
    Letter,
    Mul,
    Node,
    Sum,
)


class Accuser(WithMemory):
    """Decides whether a claim that does not follow is reported as wrong."""

    def __init__(self, memory: Memory, changes: Changes, blame: Blame):
        super().__init__(memory)
        self.changes, self.blame = changes, blame

    def accuse_if_near(self, claim: Claim, verdict: Verdict) -> None:
        """Report a row that does not follow, but would follow after one small change."""
        if claim.values is not None and claim.relation == "~":
            self.accuse(claim, verdict, self.changes.change_of_approximation(claim))
        elif claim.values is not None and claim.relation in ("=", ":="):
            if self.holds_at_place(claim):
                verdict.outcome, verdict.given = Outcome.HOLDS, tuple(sorted(self.known.sentence))
                verdict.because = "the two sides are equal at the place that the sentence names"
            elif not self.is_left_alone(claim):
                found = self.changes.change_of_motions(claim)
                if found is not None and found[0].verdict is not None:
                    self.accuse(found[0], found[0].verdict, found[1])
                elif verdict.outcome is Outcome.DEFINES and self.may_have_other_value(claim):
                    self.accuse_value(claim, verdict)
                else:
                    self.accuse_equation(claim, verdict)

    def is_left_alone(self, claim: Claim) -> bool:
        """Whether no change of a claim is sought, because the document gives too little information about it."""
        assert claim.values is not None
        cues = claim.row.block.cues
        if cues & {Cue.INCORRECT, Cue.OTHER} or (Cue.APPROXIMATE in cues and claim.is_step):
            return True
        if claim.values[0] in self.meaning.evaluations:
            return True  # the value at one place says nothing about another place
        sides = [side for side in (claim.left, claim.right) if side is not None]
        if any(isinstance(each, MatrixBase) for each in claim.values) or has_implied_sum(*sides):
            return True
        # A letter of an integrand may depend on the variable of integration.
        return any(isinstance(each, Int) for side in sides for each in side.walk())

    def accuse_value(self, claim: Claim, verdict: Verdict) -> None:
        """Report a value that would be an earlier value of the letter after one change."""
        assert claim.values is not None
        edit = self.changes.change_of_value(claim)
        if edit is not None and edit.kind in DISTINCT and self.memory.restates(claim):
            self.accuse(claim, verdict, edit)
            return
        self.doubt(verdict, edit)  # the letter may have a different value in another part or case
        if verdict.outcome is Outcome.DEFINES and claim.row.block.display:
            value = self.known.definitions[claim.values[0]][-1].value
            there = [each for _, _, each in values_at_place(value, claim.values[1], self.meaning)]
            edits = [self.changes.change_to(claim, each) for each in there]
            self.accuse(claim, verdict, next((e for e in edits if e is not None and e.kind in DISTINCT), None))

    def accuse_equation(self, claim: Claim, verdict: Verdict) -> None:
        """Report an equation that would follow from earlier rows after one change or with one more term."""
        assert claim.values is not None
        in_sentence = not claim.is_step and not claim.row.block.display and not self.memory.is_general(claim)
        strange = self.changes.strange_letters(claim) if in_sentence else set()
        if in_sentence and not strange and claim.values[1].is_Atom:
            return
        edit = self.changes.near_edit(claim, self.known)
        if edit is None:
            self.accuse_lost_term(claim, verdict)
            return
        if edit.was not in strange and self.may_be_right(claim, edit):
            self.doubt(verdict, edit)
        elif edit.kind == "letter" and self.is_rare(edit):
            self.blame.fixes += self.blame.fixes_before(claim)  # probably the other claim with this letter is wrong
        elif edit.kind not in TOO_EASY or not self.may_add_something(claim):
            self.accuse(claim, verdict, edit)

    def is_rare(self, edit: Edit) -> bool:
        """Whether only one claim of the document contains the letter that is probably meant."""
        rare = self.changes.letters_of_one_claim()
        return edit.meant in rare and edit.was not in rare

    def accuse_lost_term(self, claim: Claim, verdict: Verdict) -> None:
        """Report an equation that would follow with one more term, or else a value at an instant that would follow."""
        assert claim.values is not None
        if claim.is_step:
            return
        if claim.row.block.display and not self.memory.may_be_special(claim):
            linear = Cue.APPROXIMATE in claim.row.block.cues or self.changes.is_linear(claim)
            near = Nearness(self.meaning, self.known, [], self.memory.shown, linear=linear, terms=[])
            if (lost := near.lost_term(claim.values[0] - claim.values[1])) is not None:
                verdict.outcome, verdict.why_plausible = Outcome.DIFFERS, WHY["lost term"]
                verdict.because = "it does not follow from earlier rows, but would with one more term"
                verdict.suggestion = f"with the term {lost}"
                return
        if isinstance(claim.values[0], Symbol):
            self.accuse(claim, verdict, self.changes.change_at_instant(claim))

    def holds_at_place(self, claim: Claim) -> bool:
        """Whether two sides are equal for the values that the sentence of a display gives: `At x = a, E = ...`."""
        assert claim.values is not None
        stated = [self.claims[each] for each in self.known.sentence]
        named = [each.values for each in stated if each.relation in ("=", ":=")]
        put_in = {each[0]: each[1] for each in named if each is not None and isinstance(each[0], Symbol)}
        left, right = (self.memory.expanded(each) for each in claim.values)
        return left.free_symbols & put_in.keys() != set() and same(left.xreplace(put_in), right)

    def may_add_something(self, claim: Claim) -> bool:
        """Whether a row has a new letter or begins a part, so that it may have more terms than earlier rows."""
        assert claim.values is not None
        symbols = claim.values[0].free_symbols | claim.values[1].free_symbols
        before = [each for each in self.claims[: claim.number] if each.row.block.part == claim.row.block.part]
        return bool(self.known.new_letters(symbols)) or not any(each.row.block.display for each in before)

    def accuse(self, claim: Claim, verdict: Verdict, edit: Edit | None) -> None:
        """Report a row that would follow after the given change, if there is one."""
        if edit is None:
            return
        verdict.outcome = Outcome.DIFFERS
        because = "the side before it" if claim.is_step else "earlier rows"
        verdict.because = f"it does not follow from {because}, but would with one change"
        verdict.suggest(edit)

    def may_be_right(self, claim: Claim, edit: Edit) -> bool:
        """Whether a claim may be right without a change, because a sentence states it for a special case."""
        if claim.is_step or claim.row.block.display or claim.values is None:
            return False
        if self.memory.restates(claim) or motion_of(*claim.values, self.meaning):
            return edit.kind not in DISTINCT
        return not self.memory.is_general(claim)

    def doubt(self, verdict: Verdict, edit: Edit | None) -> None:
        """Leave a row undecided if one change would make it follow: it contains a slip or is a special case."""
        if edit is not None:
            verdict.outcome = Outcome.UNDECIDED
            verdict.because = f"it would follow from earlier rows with {edit.suggestion}, but may be a special case"

    def may_have_other_value(self, claim: Claim) -> bool:
        """Whether a letter has an earlier value, and the sentence does not refer to the row of this value."""
        assert claim.values is not None
        found = self.known.definitions.get(claim.values[0], [])
        row = found[-1].row if found else None
        return bool(found) and (row is None or row.label not in REFERENCE.findall(claim.row.block.sentence))


def has_implied_sum(*sides: Node) -> bool:
    """Whether two factors of a product have the same index, as in a_i b_i: a sum over this index may be implied."""
    for side in sides:
        summed = {each.index.base for each in side.walk() if isinstance(each, Sum) and isinstance(each.index, Letter)}
        for node in side.walk():
            if isinstance(node, Mul):
                found: Counter[str] = Counter()
                for _, factor in node.factors:
                    letters = [each for each in factor.walk() if isinstance(each, Letter)]
                    found.update({index for each in letters for index in indices_of(each)} - summed)
                if any(count > 1 for count in found.values()):
                    return True
    return False


def indices_of(letter: Letter) -> list[str]:
    written = re.findall(r"mu|nu|rho|sigma|alpha|beta|lambda|[a-z]", f"{letter.sub},{letter.label}")
    return [each for each in written if len(each) > 1 or each in "ijkl"] if len(letter.sub) < 12 else []
