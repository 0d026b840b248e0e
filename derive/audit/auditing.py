"""The audit of a whole document, claim by claim."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import islice, product
from time import process_time

import sympy
from sympy import MatrixBase, Symbol

from derive.audit.accusing import Accuser, has_implied_sum
from derive.audit.assumptions import Assumed
from derive.audit.blame import Blame
from derive.audit.changes import PLAIN, SECONDS_OF_SEARCH, Changes
from derive.audit.claims import GOOD, Claim, Outcome, Verdict
from derive.audit.deciding import Decision, same
from derive.audit.expected import Compared, Comparison, Expected
from derive.audit.memory import GIVEN_UP, LEAST_SECONDS, Memory, WithMemory
from derive.audit.near_derivation import NearDerivation
from derive.audit.nearest_change import letters_in
from derive.audit.reading import claims_of, explanations, scope_of
from derive.audit.slips import WHY
from derive.audit.time_limit import FAULTS, LimitReached, time_limited
from derive.documents.choices import readings
from derive.documents.facts import Facts, Identity
from derive.documents.layout import Cue, Document, Row, Statement
from derive.documents.meaning import Meaning, Meaningless, Value
from derive.documents.source import Span
from derive.documents.syntax import (
    Add,
    Cases,
    Diff,
    Frac,
    Group,
    Int,
    Letter,
    Mat,
    Mul,
    Node,
    Num,
    Open,
    Sign,
    Text,
)

SECONDS = 3.0  # the limit of processor time for one claim, in seconds
USUAL_SECONDS = 0.3  # the usual processor time for one claim, in seconds
MOST_LATE = 40.0  # the limit falls linearly with the seconds used beyond the usual time, and would be zero at MOST_LATE
MOST_READINGS = 8
_CONSTANT = re.compile(r"[ck]onst|c(?:st|te)\b", re.IGNORECASE)


@dataclass
class Audit:
    document: Document
    facts: Facts
    claims: list[Claim]
    unread: list[tuple[Row, str]] = field(default_factory=list)
    compared: list[Compared] = field(default_factory=list)  # the results of a derivation, compared with the document
    confirmed: set[int] = field(default_factory=set)  # the numbers of claims that a derivation confirms

    @property
    def unconfirmed(self) -> list[Claim]:
        """The statements that no other row uses, continues or confirms, and that agree with no derivation."""
        verdicts = {each.number: each.verdict for each in self.claims if each.verdict is not None}
        used = {number for verdict in verdicts.values() for number in verdict.given}
        used |= {each.before.number for each in self.claims if each.before is not None}  # the chain goes on
        stated = {number for number, verdict in verdicts.items() if verdict.outcome is Outcome.DEFINES}
        return [self.claims[number] for number in sorted(stated - used - self.confirmed)]


def audited(
    document: Document,
    assumed: Sequence[Assumed] = (),
    declared: Mapping[Identity, str] | None = None,
    expected: Sequence[Expected] = (),
    progress: Callable[[int, int], None] | None = None,
) -> Audit:
    """Return the audit of a document, with a verdict on each of its claims.

    assumed    equations that hold everywhere, although the document does not state them
    declared   the kinds of letters that the reader of the document declares
    expected   results of a derivation, with which the document is compared
    """
    claims, facts, unread = claims_of(document)
    facts.declare(declared or {})
    memory = Memory(document, facts, assumed)
    memory.explanations = explanations(document, claims)
    written: Counter[Identity] = Counter()
    for claim in claims:
        both = (claim.left if claim.before is None else None, claim.right)
        written.update({letter.identity for letter in letters_in(*both)})
    changes = Changes(memory, written)
    blame = Blame(memory, changes)
    auditor = _Auditor(memory, changes, blame)
    for done, claim in enumerate(claims):
        if progress is not None:
            progress(claim.row.line, len(claims) - done)
        auditor.decide(claim)
    scopes = [scope_of(document, claim.row) for claim in claims]
    comparison = Comparison(claims, scopes, memory.scopes, facts, memory.meaning_of, expected)
    derivation = NearDerivation(memory, auditor.accuser)
    for section in comparison.sections:
        derivation.examine(section)
    blame.blame_all(derivation.confirmed, derivation.accused)
    return Audit(document, facts, claims, unread, comparison.answers(), derivation.confirmed)


class _Auditor(WithMemory):
    def __init__(self, memory: Memory, changes: Changes, blame: Blame):
        super().__init__(memory)
        self.changes, self.blame = changes, blame
        self.accuser = Accuser(memory, changes, blame)
        self.late = 0.0  # seconds used beyond the usual time

    def decide(self, claim: Claim) -> None:
        """Give a claim its verdict, and remember what the claim states for later claims."""
        self.memory.enter(claim)
        claim.verdict = self.without_comparison(claim)
        if claim.verdict is not None:
            return
        seconds, begun = max(LEAST_SECONDS, SECONDS - self.late * SECONDS / MOST_LATE), process_time()
        claim.verdict = self.timed(claim, seconds)
        self.search(claim, claim.verdict, min(seconds, SECONDS_OF_SEARCH))
        with suppress(*GIVEN_UP), time_limited(seconds):
            self.remark(claim, claim.verdict)
            self.memory.remember(claim)
        self.late += max(0.0, process_time() - begun - USUAL_SECONDS)

    def without_comparison(self, claim: Claim) -> Verdict | None:
        """Return the verdict on a claim whose sides are not compared; None for other claims."""
        if claim.right is None or (claim.left is None and claim.before is None):
            return Verdict(Outcome.UNREADABLE, claim.fault or "this is not read")
        if claim.relation in ("to", "in"):
            what = "a limit" if claim.relation == "to" else "a range"
            if claim.is_step:
                return Verdict(Outcome.UNDECIDED, f"{what} is not checked")
            return Verdict(Outcome.DEFINES, f"{what} is stated")
        return self.of_constant(claim) if _CONSTANT.match(word_of(claim.right)) else None

    def timed(self, claim: Claim, seconds: float) -> Verdict:
        """Return the verdict on a claim, or the reason why it takes too long."""
        try:
            with time_limited(seconds):
                return self.best(claim)
        except LimitReached:
            return Verdict(Outcome.UNDECIDED, f"this takes more than {seconds:.1g} seconds", too_long=True)
        except RecursionError:
            return Verdict(Outcome.UNDECIDED, "this formula is nested too deeply")
        except FAULTS as error:
            return Verdict(Outcome.UNDECIDED, f"SymPy cannot handle it: {error}")

    def search(self, claim: Claim, verdict: Verdict, seconds: float) -> None:
        """Search for the change of this claim, and for the changes of earlier rows, after which it would follow."""
        undecided = verdict.outcome is Outcome.UNDECIDED and not verdict.too_long
        general = claim.row.block.display
        if undecided and not general:
            with suppress(*GIVEN_UP), time_limited(seconds):
                general = self.memory.is_general(claim)
        if verdict.outcome is Outcome.DEFINES or (undecided and (general or claim.relation == "~")):
            with suppress(*GIVEN_UP), time_limited(seconds):
                self.accuser.accuse_if_near(claim, verdict)
        failed = verdict.outcome is Outcome.DIFFERS and verdict.inherits is None
        contradicts = verdict.outcome is Outcome.DEFINES and verdict.contradicts is not None
        if failed or ((undecided or contradicts) and general and not self.memory.may_be_special(claim)):
            with suppress(*GIVEN_UP), time_limited(seconds):
                self.blame.fixes += self.blame.fixes_before(claim)

    def of_constant(self, claim: Claim) -> Verdict:
        """Return the verdict on `v = const`; the row is wrong if only the length of a vector is constant."""
        said = Verdict(Outcome.DEFINES, "a quantity is constant")
        side = self.memory.last_good_side(claim)
        if side is None:
            return said
        with suppress(*GIVEN_UP), time_limited(LEAST_SECONDS):
            value = self.memory.expanded(self.meaning.of(self.memory.reading(side)))
            if isinstance(value, MatrixBase):
                time = next((each for each in value.free_symbols if each.name == "t"), Symbol("t", real=True))
                rates = self.meaning.differentiated(value, time, False)
                if not same(rates, 0 * rates) and same(rates.dot(value), sympy.Integer(0)):
                    return Verdict(Outcome.DIFFERS, "only the length of this vector is constant; its direction changes")
        return said

    def unstated(self, claim: Claim) -> str:
        """Return why a step may use something that no row states, or an empty text."""
        if not claim.is_step or claim.values is None:
            return ""
        left, right = claim.values
        old, new = left.free_symbols - right.free_symbols, right.free_symbols - left.free_symbols
        if claim.relation == "~" and new:
            return "some letters are on the right side only"
        first = claim
        while first.before is not None:
            first = first.before
        if first.values is not None and first.values[0] in self.meaning.evaluations and new:
            return "the chain begins with a value at one position or instant"
        letters = [self.meaning.symbols.get(each) for each in (*old, *new)]
        bases = {each.base.lower() for each in letters if each is not None}
        if (
            len(old) == len(new) == 1
            and len(bases) == 2
            and same(left.xreplace(dict(zip(old, new, strict=True))), right)
        ):
            return "one letter is replaced by another, and no row states that they are equal"
        return ""

    def remark(self, claim: Claim, verdict: Verdict) -> None:
        """Report a probable slip, such as an entry that breaks the symmetry of a matrix."""
        if (
            isinstance(claim.left, Letter)
            and isinstance(claim.right, Letter)
            and claim.left.identity == claim.right.identity
        ):
            if not claim.is_step and claim.left.dots == claim.right.dots:
                verdict.outcome = Outcome.DIFFERS if claim.left.sub else verdict.outcome
                verdict.because = "both sides are the same letter, so this says nothing"
                if len(claim.right.sub) == 2 and claim.right.sub[0] != claim.right.sub[1]:
                    turned = claim.right.base + "_" + claim.right.sub[::-1]
                    verdict.suggestion, verdict.why_plausible = f"{turned} on one side", WHY["index"]
        for side in (claim.left if claim.before is None else None, claim.right):
            pair = same_letters(side) if verdict.outcome is not Outcome.DIFFERS else None
            if pair is not None:
                verdict.outcome, verdict.span = Outcome.DIFFERS, pair.span
                verdict.because = "one letter appears twice where two letters belong"
                verdict.why_plausible = WHY["letter"]
        for matrix in claim.right.walk() if claim.right is not None and not verdict.suggestion else ():
            if isinstance(matrix, Mat) and (odd := self.odd_entry(matrix)) is not None:
                row, column, span = odd
                place, turned = f"row {row} and column {column}", f"row {column} and column {row}"
                verdict.suggestion = f"the same entry in {place} as in {turned}"
                verdict.why_plausible, verdict.span = "the matrix is symmetric except for this pair", span

    def odd_entry(self, matrix: Mat) -> tuple[int, int, Span] | None:
        if len(matrix.rows) != 3 or any(len(row) != 3 for row in matrix.rows) or matrix.determinant:
            return None
        try:
            entries = [[self.meaning.entry(each) for each in row] for row in matrix.rows]
        except (Meaningless, *FAULTS):
            return None
        pairs = [(i, j) for i in range(3) for j in range(i)]
        odd = [(i, j) for i, j in pairs if not same(entries[i][j], entries[j][i])]
        plain = [(i, j) for i, j in pairs if (i, j) not in odd and entries[i][j] != 0]
        if len(odd) != 1 or len(plain) < 2:
            return None
        ((i, j),) = odd
        return i + 1, j + 1, matrix.rows[i][j].span

    def best(self, claim: Claim) -> Verdict:
        first: Verdict | None = None
        reason = ""
        seen: list[tuple[Value, Value]] = []
        assert claim.right is not None
        left_side = self.memory.last_good_side(claim)
        if left_side is None:
            return Verdict(Outcome.UNDECIDED, "the side before this one has no value")
        cues = claim.row.block.cues
        pairs = product(readings(left_side, self.memory.facts), readings(claim.right, self.memory.facts))
        for number, ((left_node, left_choices), (right_node, right_choices)) in enumerate(islice(pairs, MOST_READINGS)):
            is_likely = number == 0  # a statement that only an unlikely reading allows is not believed
            for plain in PLAIN:
                meaning = self.memory.meaning_of(self.meaning.scope, plain)
                try:
                    left, right = self.memory.sides(left_node, right_node, meaning)
                    if (left, right) in seen:
                        continue
                    seen.append((left, right))
                    if claim.values is None:  # so that later rows can use them even if the time limit is reached
                        claim.values, claim.decimals = (left, right), tuple(meaning.decimals)
                    verdict = self.of_values(claim, left, right, meaning, cues, thorough=len(seen) == 1)
                except Meaningless as error:
                    claim.values = None if first is None else claim.values
                    reason = reason or error.reason
                    continue
                except FAULTS as error:
                    claim.values = None if first is None else claim.values
                    reason = reason or f"SymPy cannot handle it: {error}"
                    continue
                verdict.choices = (*left_choices, *right_choices)
                if verdict.outcome in GOOD and (is_likely or first is None or verdict.outcome is not Outcome.DEFINES):
                    claim.values, claim.decimals = (left, right), tuple(meaning.decimals)
                    return verdict
                if first is None or (first.outcome is Outcome.DIFFERS and verdict.outcome is Outcome.UNDECIDED):
                    first, claim.values, claim.decimals = verdict, (left, right), tuple(meaning.decimals)
        if first is None and isinstance(claim.right, Cases) and not claim.is_step:
            return Verdict(Outcome.DEFINES, "a value for each case")
        if first is None:
            return self.of_missing_differential(claim, left_side) or Verdict(
                Outcome.UNDECIDED, reason or "this has no value"
            )
        if first.repeated is not None:
            self.compare_repeated(claim, left_side, first)
        if first.outcome is Outcome.DIFFERS and (reason := self.unstated(claim)):
            return Verdict(Outcome.UNDECIDED, reason)
        if first.outcome is Outcome.DIFFERS and has_implied_sum(left_side, claim.right):
            return Verdict(Outcome.UNDECIDED, "sums over a repeated index are compared only as they are written")
        if first.outcome is Outcome.DIFFERS and not first.suggestion:
            self.changes.suggest(claim, left_side, first)
            if not first.suggestion and first.counterexample and self.loses_letters(claim):
                return Verdict(
                    Outcome.UNDECIDED, "some letters are on the left side only; they may have been given values"
                )
        return first

    def compare_repeated(self, claim: Claim, left_side: Node, verdict: Verdict) -> None:
        assert claim.right is not None and verdict.repeated is not None
        right_node = self.memory.reading(claim.right)
        until = process_time() + SECONDS_OF_SEARCH
        if self.changes.find_edit(claim, verdict.repeated.value, right_node, left_side, verdict, until):
            verdict.outcome = Outcome.DIFFERS
            verdict.because = "the row repeats an earlier result with a change"

    def loses_letters(self, claim: Claim) -> bool:
        assert claim.values is not None
        left, right = (self.memory.expanded(each) for each in claim.values)
        return bool(left.free_symbols - right.free_symbols)

    def of_missing_differential(self, claim: Claim, left_side: Node) -> Verdict | None:
        """Return a verdict if the right side lacks a differential; otherwise None.

        The result is also None if no single change makes the claim right and `lacks_differential` is false.
        """
        assert claim.right is not None
        if not any(isinstance(each, Int) for each in claim.right.walk()):
            return None
        right_node = self.memory.reading(claim.right)
        try:
            self.meaning.of(right_node)
        except Meaningless as error:
            if "no differential" not in error.reason:
                return None
            verdict = Verdict(Outcome.DIFFERS, error.reason, span=error.span)
            with suppress(Meaningless):
                left = self.meaning.of(self.memory.reading(left_side))
                claim.values = None
                if self.changes.find_edit(claim, left, right_node, left_side, verdict):
                    return verdict
            return verdict if lacks_differential(right_node) else None
        return None

    def of_values(
        self, claim: Claim, left: Value, right: Value, meaning: Meaning, cues: frozenset[Cue], thorough: bool = True
    ) -> Verdict:
        verdict = Decision(claim, left, right, meaning, self.known, cues, thorough).verdict()
        if verdict.outcome in (Outcome.HOLDS, Outcome.APPROXIMATES):
            return verdict
        if claim.before is not None and claim.before.verdict is not None and claim.before.values is not None:
            wrong = claim.before
            if wrong.verdict is not None and wrong.verdict.outcome is Outcome.DIFFERS:
                return self.after_slip(claim, wrong, left, right, meaning, cues, verdict)
        believed = self.known.with_slips()
        if believed is not None:
            again = Decision(claim, left, right, meaning, believed, cues, thorough).verdict()
            slips = {each.claim for each in self.known.slips.values()}
            good = again.outcome is Outcome.HOLDS or (again.outcome is Outcome.APPROXIMATES and claim.relation == "=")
            if good:  # only the values of wrong rows make it hold
                again.inherits = min(slips & set(again.given), default=max(slips))
                again.because = "it follows from a wrong row"
                return again
        return verdict

    def after_slip(
        self,
        claim: Claim,
        wrong: Claim,
        left: Value,
        right: Value,
        meaning: Meaning,
        cues: frozenset[Cue],
        verdict: Verdict,
    ) -> Verdict:
        assert wrong.values is not None
        again = Decision(claim, wrong.values[0], right, meaning, self.known, cues).verdict()
        if again.outcome in GOOD:
            again.because += ", compared with the side before the slip"
            return again
        return verdict


def lacks_differential(side: Node) -> bool:
    """Whether a multiple integral with limits at each integral sign has at least one differential, but fewer
    differentials than integral signs. Integrals with an element such as dA or dV do not count.
    """
    for each in side.walk():
        if isinstance(each, Int):
            signs = [item for item in each.items if isinstance(item, Sign)]
            of = [item.of for item in each.items if isinstance(item, Diff)]
            single = all(isinstance(one, Letter) and one.base not in ("A", "S", "V", "Omega", "tau", "a") for one in of)
            if 0 < len(of) < len(signs) and single and all(sign.lower is not None for sign in signs):
                return True
    return False


def same_letters(side: Node | None) -> Node | None:
    """Return a sum with the same term twice, or a fraction such as l/l or w/(2 w); None if there is neither."""
    if isinstance(side, Frac):
        bottom = side.bottom.inner if isinstance(side.bottom, Group) else side.bottom
        below = [factor for _, factor in bottom.factors] if isinstance(bottom, Mul) else [bottom]
        last = below[-1]
        if isinstance(side.top, Letter) and isinstance(last, Letter) and all(isinstance(e, Num) for e in below[:-1]):
            if (last.identity, last.dots) == (side.top.identity, side.top.dots):
                return side
    for each in side.walk() if side is not None else ():
        if isinstance(each, Add):
            letters = [(term.identity, term.dots) for _, term in each.terms if isinstance(term, Letter)]
            if len(set(letters)) < len(letters):
                return each
    return None


def word_of(node: Node) -> str:
    """Return the word that a side consists of, or an empty text."""
    if isinstance(node, Open) and node.kind == "word":
        node = node.alternatives[0]
    if isinstance(node, Letter):
        return node.base
    return node.text.replace(" ", "") if isinstance(node, Text) else ""


__all__ = ["Audit", "Cue", "Statement", "Value", "audited", "claims_of"]
