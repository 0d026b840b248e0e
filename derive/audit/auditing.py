"""The audit of a whole document, claim by claim."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise, product
from time import process_time

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.assumptions import Assumed
from derive.audit.claims import Claim, Definition, Outcome, Verdict
from derive.audit.deciding import Decision, degree, entries_of, order_of_error, same
from derive.audit.dimensions import odd_claims
from derive.audit.expected import Compared, Expected, compared
from derive.audit.knowledge import ASSUMED, Known
from derive.audit.named_quantities import named_quantities
from derive.audit.nearest_change import TOO_EASY, Nearness, holds_at, letters_in, terms_in
from derive.audit.numeric import NoNumber
from derive.audit.slips import WHY, Edit, edits_of_side, nearest_edit
from derive.audit.systems import (
    changing_letters,
    energies,
    equations_of_motion,
    expanded,
    frequency_equations,
    is_linear,
    motion_of,
    moving_letters,
    rates,
    root_equation,
    values_at_instant,
    values_at_place,
    zeros_in_time,
)
from derive.audit.time_limit import FAULTS, LimitReached, time_limited
from derive.documents.choices import Choice, readings
from derive.documents.facts import Facts, Identity, facts_of, shape_of
from derive.documents.layout import PROBLEM_WORDS, Cue, Document, Row, Statement
from derive.documents.meaning import Meaning, Meaningless, Value
from derive.documents.parser import Unreadable, parsed
from derive.documents.source import Span
from derive.documents.syntax import (
    Add,
    Cases,
    Diff,
    EvalBar,
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
    Sum,
    Text,
)

SECONDS = 3.0  # the limit of processor time for one claim, in seconds
LEAST_SECONDS = 0.4  # the limit never falls below this number of seconds
USUAL_SECONDS = 0.3  # the usual processor time for one claim, in seconds
MOST_LATE = 40.0  # the limit falls linearly with the seconds used beyond the usual time, and would be zero at MOST_LATE
SECONDS_OF_SEARCH = 2.0  # seconds of processor time for the search for a change that makes a claim right
MOST_INDICES = 12
MOST_LOST = 6  # at most this many missing letters are tried as corrections of a row
MOST_ROWS = 10  # at most this many of the last equations and displayed claims are searched for lost letters and terms
FEWEST_OPERATIONS = 3  # only earlier values with at least this number of operations are compared with a later value
MOST_FIXED = 5  # at most this many earlier rows are searched for a slip other than a lost term
SPECIAL = frozenset({Cue.GIVEN, Cue.PUT_IN, Cue.ZERO, Cue.APPROXIMATE})  # cues that explain why a row has fewer terms
MOST_READINGS = 8
DISTINCT = ("sign", "exponent", "function")  # changes that do not lead from one special case to another
ENERGIES = ("L", "T", "K", "U", "V", "H")
PLAIN = ("", "unmarked", "all", "tensors")
GIVEN_UP = (LimitReached, RecursionError, Meaningless, NoNumber, *FAULTS)  # a test of a claim ends without a result
GOOD = (Outcome.HOLDS, Outcome.APPROXIMATES, Outcome.DEFINES)
_BRACKETS = re.compile(
    r"\bPoisson|\bcommutator|\bcommut(?:e|es)\b|\binner product|\bHilbert|\bHermitian|\badjoint", re.IGNORECASE
)
_CONSTANT = re.compile(r"[ck]onst|c(?:st|te)\b", re.IGNORECASE)
_NEW_SCOPE = re.compile(PROBLEM_WORDS, re.IGNORECASE)
_EXPLAINS = re.compile(r"[\s,;}~]*(?:where|with|in which|here)\b", re.IGNORECASE)
_REFERENCE = re.compile(r"\\(?:eq)?ref\{([^{}]+)\}")
_ENDS_SENTENCE = re.compile(r"[.!?](?:\s|$)|\n[ \t]*\n")


@dataclass
class Audit:
    document: Document
    facts: Facts
    claims: list[Claim]
    unread: list[tuple[Row, str]] = field(default_factory=list)
    compared: list[Compared] = field(default_factory=list)  # the results of a derivation, compared with the document


def claims_of(document: Document) -> tuple[list[Claim], Facts, list[tuple[Row, str]]]:
    """Return the claims of a document, the facts about its letters, and the rows that cannot be read."""
    nodes: dict[int, list[tuple[Node | None, str]]] = {}
    sides, equations, unread = [], [], []
    for row in document.rows:
        faults = [row.fault[0]] if row.fault else []
        scope = scope_of(document, row)
        for statement in row.statements:
            read: list[tuple[Node | None, str]] = []
            for side in statement.sides:
                try:
                    read.append((parsed(side.tokens), ""))
                except Unreadable as error:
                    read.append((None, error.message))
                    faults.append(error.message)
                except RecursionError:
                    read.append((None, "this formula is nested too deeply"))
                    faults.append("this formula is nested too deeply")
            nodes[id(statement)] = read
            sides += [node for node, _ in read if node is not None]
            first = nodes.get(id(_head(statement)), read)[0][0]
            for (one, _), (other, _) in pairwise(read):
                equations += [(one, other, scope)] if one is not None and other is not None else []
                equations += [(first, other, scope)] if first is not None and other is not None else []
        if faults:
            unread.append((row, faults[0]))
    facts = facts_of(sides, equations)
    facts.has_brackets = bool(_BRACKETS.search(document.source.text))
    facts.has_lagrange = "Lagrang" in document.source.text
    claims: list[Claim] = []
    last_of: dict[int, Claim] = {}
    for row in document.rows:
        for statement in row.statements:
            before = last_of.get(id(statement.follows)) if statement.follows is not None else None
            read = nodes[id(statement)]
            for index, relation in enumerate(statement.relations):
                if any(isinstance(node, Text) and node.text == "?" for node, _ in read[index : index + 2]):
                    continue  # the document leaves a blank here
                (left, left_fault), (right, right_fault) = read[index], read[index + 1]
                claim = Claim(
                    len(claims), row, statement, index, relation, left, right,
                    statement.sides[index].span, statement.sides[index + 1].span, left_fault or right_fault,
                    before if before is not None else None, tags=(row.tag,) if row.tag else (),
                )  # fmt: skip
                claims.append(claim)
                before = claim
            if before is not None:
                last_of[id(statement)] = before
    return claims, facts, unread


def scope_of(document: Document, row: Row) -> int:
    """Return the number of the heading that begins the problem or section of a row; -1 before the first one."""
    for index in range(row.block.heading, -1, -1):
        heading = document.headings[index]
        if heading.level <= 1 or _NEW_SCOPE.search(heading.text):
            return index
    return -1


def explanations(document: Document, claims: Sequence[Claim]) -> dict[int, list[Claim]]:
    """Return the claims after each display that explain its letters in the same sentence: `..., where rho = M/V`."""
    by_block: dict[int, list[Claim]] = {}
    for claim in claims:
        by_block.setdefault(id(claim.row.block), []).append(claim)
    found: dict[int, list[Claim]] = {}
    for display, first in pairwise(document.blocks):
        if not display.display or first.display or not _EXPLAINS.match(first.before):
            continue
        for block in document.blocks[document.blocks.index(first) :]:
            if block.display or (block is not first and _ENDS_SENTENCE.search(block.before)):
                break
            found.setdefault(id(display), []).extend(by_block.get(id(block), []))
    return found


def _head(statement: Statement) -> Statement:
    while statement.follows is not None:
        statement = statement.follows
    return statement


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
    auditor = _Auditor(document, facts, assumed)
    auditor.explanations = explanations(document, claims)
    for claim in claims:
        both = (claim.left if claim.before is None else None, claim.right)
        auditor.written.update({letter.identity for letter in letters_in(*both)})
    for done, claim in enumerate(claims):
        if progress is not None:
            progress(claim.row.line, len(claims) - done)
        auditor.decide(claim)
    auditor.blame_common_rows()
    auditor.blame_earlier_rows()
    auditor.blame_formulas()
    auditor.blame_odd_dimensions()
    scopes = [scope_of(document, claim.row) for claim in claims]
    found = compared(claims, scopes, auditor.scopes, facts, auditor.meaning_of, expected) if expected else []
    return Audit(document, facts, claims, unread, found)


@dataclass(frozen=True)
class Fix:
    """A change of an earlier row after which `claim` would follow."""

    claim: Claim
    earlier: Claim
    edit: Edit


class _Auditor:
    def __init__(self, document: Document, facts: Facts, assumed: Sequence[Assumed] = ()):
        self.document, self.facts, self.assumed = document, facts, assumed
        self.scope: int | None = None
        self.meaning = Meaning(facts)
        self.known = Known(self.meaning)
        self.scopes: dict[int, Known] = {}
        self.late = 0.0  # seconds used beyond the usual time
        self.fixes: list[Fix] = []
        self.claims: list[Claim] = []
        self.explanations: dict[int, list[Claim]] = {}  # by the id of the block of a display
        self.written: Counter[Identity] = Counter()  # how many claims contain a letter
        self.lagrangians: dict[int, tuple[Expr, int]] = {}  # L = T - U, by the number of the claim that it precedes
        self.general: dict[int, bool] = {}  # whether a claim in a sentence always holds
        self.explained: set[int] = set()  # the numbers of claims that explain letters of the display before them

    def begin(self, scope: int) -> None:
        """Begin a problem or section, and forget the definitions and equations of earlier problems and sections."""
        self.scope = scope
        self.meaning.scope = scope
        self.known = self.scopes[scope] = self.assumptions()

    def assumptions(self) -> Known:
        known = Known(self.meaning)
        for each in self.assumed:
            try:
                left, right = (self.meaning.of(readings(side, self.facts)[0][0]) for side in (each.left, each.right))
            except (Meaningless, *FAULTS):
                continue
            if isinstance(left, Symbol) and not isinstance(right, MatrixBase):
                known.assume(left, right)
            elif not isinstance(left, MatrixBase) and not isinstance(right, MatrixBase):
                known.state(sympy.expand(left - right), ASSUMED)
        return known

    def meaning_of(self, scope: int, plain: str = "") -> Meaning:
        """Return the meaning of letters in one scope; all scopes share the letters and derivatives of the document."""
        return Meaning(
            self.facts,
            derivatives=self.meaning.derivatives,
            symbols=self.meaning.symbols,
            parents=self.meaning.parents,
            defined=self.value_of,
            evaluations=self.meaning.evaluations,
            sums=self.meaning.sums,
            scope=scope,
            plain=plain,
        )

    def decide(self, claim: Claim) -> None:
        self.claims.append(claim)
        scope = scope_of(self.document, claim.row)
        if scope != self.scope:
            self.begin(scope)
        self.explain(claim)
        self.known.sentence = self.claims_of_sentence(claim)
        self.known.here = self.conditions_here(claim)
        written = letters_in(claim.left, claim.right)
        self.known.moving = frozenset(each.identity for each in written if each.dots)
        self.state_lagrangian(claim)
        if claim.right is None or (claim.left is None and claim.before is None):
            claim.verdict = Verdict(Outcome.UNREADABLE, claim.fault or "this is not read")
            return
        if claim.relation in ("to", "in"):
            what = "a limit" if claim.relation == "to" else "a range"
            claim.verdict = Verdict(Outcome.UNDECIDED, f"{what} is not checked") if claim.is_step else Verdict(
                Outcome.DEFINES, f"{what} is stated"
            )  # fmt: skip
            return
        if _CONSTANT.match(word_of(claim.right)):
            claim.verdict = self.of_constant(claim)
            return
        seconds, begun = max(LEAST_SECONDS, SECONDS - self.late * SECONDS / MOST_LATE), process_time()
        too_long = False
        try:
            with time_limited(seconds):
                claim.verdict = self.best(claim)
        except LimitReached:
            claim.verdict, too_long = Verdict(Outcome.UNDECIDED, f"this takes more than {seconds:.1g} seconds"), True
        except RecursionError:
            claim.verdict = Verdict(Outcome.UNDECIDED, "this formula is nested too deeply")
        except FAULTS as error:
            claim.verdict = Verdict(Outcome.UNDECIDED, f"SymPy cannot handle it: {error}")
        search = min(seconds, SECONDS_OF_SEARCH)
        undecided = claim.verdict.outcome is Outcome.UNDECIDED and not too_long
        display = claim.row.block.display
        if undecided and not display:
            with suppress(*GIVEN_UP), time_limited(search):
                display = self.is_general(claim)
        if claim.verdict.outcome is Outcome.DEFINES or (undecided and (display or claim.relation == "~")):
            with suppress(*GIVEN_UP), time_limited(search):
                self.accuse_if_near(claim, claim.verdict)
        failed = claim.verdict.outcome is Outcome.DIFFERS and claim.verdict.inherits is None
        contradicts = claim.verdict.outcome is Outcome.DEFINES and claim.verdict.contradicts is not None
        if failed or ((undecided or contradicts) and display and not self.may_be_special(claim)):
            with suppress(*GIVEN_UP), time_limited(search):
                self.fixes += self.fixes_before(claim)
        with suppress(*GIVEN_UP), time_limited(seconds):
            self.remark(claim, claim.verdict)
            self.remember(claim)
        self.late += max(0.0, process_time() - begun - USUAL_SECONDS)

    def claims_of_sentence(self, claim: Claim) -> frozenset[int]:
        """Return the claims that precede a display in its sentence and have a good verdict: they hold, at least
        approximately, or define something."""
        found: list[int] = []
        block = claim.row.block
        for each in reversed(self.claims[:-1]) if block.display else ():
            if each.row.block is block:
                continue
            if each.row.block.display or _ENDS_SENTENCE.search(self.shown(Span(each.row.span.end, block.span.start))):
                break
            if each.verdict is not None and each.verdict.outcome in GOOD:
                found.append(each.number)
        return frozenset(found)

    def conditions_here(self, claim: Claim) -> frozenset[int]:
        """Return the conditions before a display, in the same sentence, that are used in one of its rows: "with
        `r = l`, this becomes".

        A condition such as `x = 0` is not used in a row that contains `x`, because such a row is about other instants.
        An equation with a rate and several terms, such as `x' + R w = 0`, is used in any row.
        Conditions of equilibrium are used in each row of the same part that contains no rates.
        """
        written = {each.identity for each in letters_in(claim.left, claim.right)}
        conditions = [self.claims[each] for each in self.known.sentence & self.known.conditions - self.known.at_rest]
        here = {each.number for each in conditions if self.is_law(each) or written.isdisjoint(
            letter.identity for letter in letters_in(each.left)
        )}  # fmt: skip
        if any(each.dots for each in letters_in(claim.left, claim.right)):
            return frozenset(here)
        part = claim.row.block.part
        return frozenset(here | {each for each in self.known.at_rest if self.claims[each].row.block.part == part})

    def is_law(self, claim: Claim) -> bool:
        """Whether an equation has several terms, and the rate of a letter in at least one of them."""
        if claim.values is None or claim.left is None or any(isinstance(each, MatrixBase) for each in claim.values):
            return False
        value = sympy.expand(claim.values[0] - claim.values[1])
        rates = any(map(self.known.is_rate, value.free_symbols))
        return rates and len(sympy.Add.make_args(value)) > 1 and not isinstance(claim.left, Letter)

    def state_lagrangian(self, claim: Claim) -> None:
        """State L = T - U before the first display that gives a value to the Lagrangian L without T and U."""
        left = claim.left
        if not claim.row.block.display or claim.before is not None or not isinstance(left, Letter) or left.base != "L":
            return
        symbol, found = self.meaning.symbol(replace(left, dots=0)), energies(self.known)
        letters = {each.base for each in letters_in(claim.right)}
        if left.sub or left.dots or left.marks or letters & set("TKUV") or found is None:
            return
        if symbol not in self.known.definitions:
            kinetic, potential = found
            self.lagrangians[claim.number] = (symbol - kinetic.symbol + potential.symbol, potential.claim)
            self.known.state(symbol - kinetic.value + potential.value, max(kinetic.claim, potential.claim))

    def explain(self, claim: Claim) -> None:
        """Remember the values that the words after this display give to letters: `..., where rho = M/V`."""
        if claim.number in self.explained:
            self.known.forget(claim.number)
        for each in self.explanations.pop(id(claim.row.block), []):
            if each.is_step or each.relation not in ("=", ":=") or each.left is None or each.right is None:
                continue
            with suppress(*GIVEN_UP), time_limited(LEAST_SECONDS):
                letter, value = self.sides(each.left, readings(each.right, self.facts)[0][0], self.meaning)
                plain = isinstance(value, MatrixBase) or value.as_coeff_Mul()[1].is_Symbol or not value.free_symbols
                if isinstance(letter, Symbol) and not plain and self.known.latest(letter) is None:
                    self.explained.add(each.number)
                    self.known.define(letter, value, each.number, row=each.row, chain=each.number)

    def of_constant(self, claim: Claim) -> Verdict:
        """Return the verdict on `v = const`; the row is wrong if only the length of a vector is constant."""
        said = Verdict(Outcome.DEFINES, "a quantity is constant")
        side = self.last_good_side(claim)
        if side is None:
            return said
        with suppress(*GIVEN_UP), time_limited(LEAST_SECONDS):
            value = self.expanded(self.meaning.of(readings(side, self.facts)[0][0]))
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
        left_side = self.last_good_side(claim)
        if left_side is None:
            return Verdict(Outcome.UNDECIDED, "the side before this one has no value")
        cues = claim.row.block.cues
        pairs = product(readings(left_side, self.facts), readings(claim.right, self.facts))
        for (left_node, left_choices), (right_node, right_choices) in islice(pairs, MOST_READINGS):
            for plain in PLAIN:
                meaning = self.meaning_of(self.meaning.scope, plain)
                try:
                    left, right = self.sides(left_node, right_node, meaning)
                    if (left, right) in seen:
                        continue
                    seen.append((left, right))
                    verdict = self.of_values(claim, left, right, meaning, cues, thorough=len(seen) == 1)
                except Meaningless as error:
                    reason = reason or error.reason
                    continue
                except FAULTS as error:
                    reason = reason or f"SymPy cannot handle it: {error}"
                    continue
                verdict.choices = (*left_choices, *right_choices)
                if verdict.outcome in GOOD:
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
            self.suggest(claim, left_side, first)
            if not first.suggestion and first.counterexample and self.loses_letters(claim):
                return Verdict(
                    Outcome.UNDECIDED, "some letters are on the left side only; they may have been given values"
                )
        return first

    def compare_repeated(self, claim: Claim, left_side: Node, verdict: Verdict) -> None:
        assert claim.right is not None and verdict.repeated is not None
        right_node = readings(claim.right, self.facts)[0][0]
        until = process_time() + SECONDS_OF_SEARCH
        if self.find_edit(claim, verdict.repeated.value, right_node, left_side, verdict, until):
            verdict.outcome = Outcome.DIFFERS
            verdict.because = "the row repeats an earlier result with a change"

    def accuse_if_near(self, claim: Claim, verdict: Verdict) -> None:
        """Report a row that does not follow, but would follow after one small change."""
        if claim.values is not None and claim.relation == "~":
            self.accuse(claim, verdict, self.change_of_approximation(claim))
        if claim.values is None or claim.relation not in ("=", ":="):
            return
        if self.holds_at_place(claim):
            verdict.outcome, verdict.given = Outcome.HOLDS, tuple(sorted(self.known.sentence))
            verdict.because = "the two sides are equal at the place that the sentence names"
            return
        if Cue.INCORRECT in claim.row.block.cues or (Cue.APPROXIMATE in claim.row.block.cues and claim.is_step):
            return
        if claim.values[0] in self.meaning.evaluations:
            return  # the value at one place says nothing about another place
        if any(isinstance(each, MatrixBase) for each in claim.values):
            return
        sides = [side for side in (claim.left, claim.right) if side is not None]
        if has_implied_sum(*sides):
            return
        if any(isinstance(each, Int) for side in sides for each in side.walk()):
            return  # a letter of an integrand may depend on the variable of integration
        in_sentence = not claim.is_step and not claim.row.block.display and not self.is_general(claim)
        if verdict.outcome is Outcome.DEFINES and self.may_have_other_value(claim):
            edit = self.change_of_value(claim)
            if edit is not None and edit.kind in DISTINCT and self.restates(claim):
                self.accuse(claim, verdict, edit)
                return
            self.doubt(verdict, edit)  # the letter may have a different value in another part or case
            if verdict.outcome is Outcome.DEFINES and claim.row.block.display:
                value = self.known.definitions[claim.values[0]][-1].value
                there = [each for _, _, each in values_at_place(value, claim.values[1], self.meaning)]
                edits = [self.change_to(claim, each) for each in there]
                self.accuse(claim, verdict, next((e for e in edits if e is not None and e.kind in DISTINCT), None))
            return
        strange = self.strange_letters(claim) if in_sentence else set()
        if in_sentence and not strange and claim.values[1].is_Atom:
            return
        edit = self.near_edit(claim, self.known)
        if edit is not None and edit.was not in strange and self.may_be_right(claim, edit):
            self.doubt(verdict, edit)
            return
        if edit is not None and edit.kind in TOO_EASY and self.may_add_something(claim):
            return
        rare = self.letters_of_one_claim() if edit is not None and edit.kind == "letter" else set()
        if edit is not None and edit.meant in rare and edit.was not in rare:
            self.fixes += self.fixes_before(claim)  # probably the other claim with this letter is wrong
            return
        if edit is None and not claim.is_step and claim.row.block.display and not self.may_be_special(claim):
            near = Nearness(self.meaning, self.known, [], self.shown, terms=[])
            if (lost := near.lost_term(claim.values[0] - claim.values[1])) is not None:
                verdict.outcome, verdict.why_plausible = Outcome.DIFFERS, WHY["lost term"]
                verdict.because = "it does not follow from earlier rows, but would with one more term"
                verdict.suggestion = f"with the term {lost}"
                return
        if edit is None and isinstance(claim.values[0], Symbol) and not claim.is_step:
            edit = self.change_at_instant(claim)
        self.accuse(claim, verdict, edit)

    def holds_at_place(self, claim: Claim) -> bool:
        """Whether two sides are equal for the values that the sentence of a display gives: `At x = a, E = ...`."""
        assert claim.values is not None
        named = [self.claims[each].values for each in self.known.sentence]
        put_in = {each[0]: each[1] for each in named if each is not None and isinstance(each[0], Symbol)}
        left, right = (self.expanded(each) for each in claim.values)
        return left.free_symbols & put_in.keys() != set() and same(left.xreplace(put_in), right)

    def letters_of_one_claim(self) -> set[str]:
        """Return the letters that only one claim of the document contains, as they are written."""
        return {self.shown(each.span) for each in self.meaning.symbols.values() if self.written[each.identity] == 1}

    def may_add_something(self, claim: Claim) -> bool:
        """Whether a row has a new letter or begins a part, so that it may have more terms than earlier rows."""
        assert claim.values is not None
        symbols = claim.values[0].free_symbols | claim.values[1].free_symbols
        before = [each for each in self.claims[: claim.number] if each.row.block.part == claim.row.block.part]
        return bool(self.known.new_letters(symbols)) or not any(each.row.block.display for each in before)

    def change_of_approximation(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which it would have the leading terms of the left side where the
        letters that change are small, as in `cos x ~ 1 - x^2`; None if no change is found."""
        assert claim.values is not None and claim.right is not None
        left, right = claim.values
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
            return None
        small = changing_letters(left.free_symbols, self.meaning)
        if not small or left.free_symbols != right.free_symbols:
            return None
        node = readings(claim.right, self.facts)[0][0]
        for edit in edits_of_side(node, letters_in(node), self.shown):
            with suppress(*FAULTS, Meaningless):
                value = self.meaning.of(edit.node)
                found = order_of_error(left, value, self.meaning, [small])
                if found is not None and found[1] > degree(value, small) > 0:
                    return edit
        return None

    def accuse(self, claim: Claim, verdict: Verdict, edit: Edit | None) -> None:
        """Report a row that would follow after the given change, if there is one."""
        if edit is None:
            return
        verdict.outcome = Outcome.DIFFERS
        because = "the side before it" if claim.is_step else "earlier rows"
        verdict.because = f"it does not follow from {because}, but would with one change"
        verdict.suggestion = suggestion_of(edit)
        verdict.why_plausible, verdict.span = WHY[edit.kind], edit.span

    def is_general(self, claim: Claim) -> bool:
        if claim.number not in self.general:
            self.general[claim.number] = self.holds_generally(claim)
        return self.general[claim.number]

    def holds_generally(self, claim: Claim) -> bool:
        """Whether a sentence states an equation that always holds: it restates a known value; or it has several terms,
        it is not the value of a letter without rates, and nothing near it may name a special case."""
        if not claim.row.block.display and self.restates(claim):
            return True
        if claim.values is None or claim.is_step or claim.row.block.display or claim.row.block.cues & SPECIAL:
            return False
        if any(isinstance(each, MatrixBase) for each in claim.values):
            return False
        left, right = claim.values
        is_value = left.as_base_exp()[0].is_Symbol or right.is_number
        has_rates = any(map(self.known.is_rate, left.free_symbols | right.free_symbols))
        count = sum(len(sympy.Add.make_args(sympy.expand(each))) for each in (left, right) if each != 0)
        if count < 2 or (is_value and not has_rates):
            return False
        return not self.may_be_special(claim) or not self.may_hold_specially(claim)

    def may_be_right(self, claim: Claim, edit: Edit) -> bool:
        """Whether a claim may be right without a change, because a sentence states it for a special case."""
        if claim.is_step or claim.row.block.display or claim.values is None:
            return False
        if self.restates(claim) or motion_of(*claim.values, self.meaning):
            return edit.kind not in DISTINCT
        return not self.is_general(claim)

    def restates(self, claim: Claim) -> bool:
        """Whether a claim gives a letter with an index, or a power of it, a value with the same letters as its earlier
        value, so that it is probably not the value at another place. A letter without an index, as in N = m v^2/r + m g
        at the bottom and N = m v^2/r - m g at the top, often has two values.
        """
        if claim.values is None or claim.is_step or any(isinstance(each, MatrixBase) for each in claim.values):
            return False
        letter, value = claim.values[0].as_base_exp()[0], claim.values[1]
        earlier = self.known.surely(letter) if isinstance(letter, Symbol) else None
        named = self.meaning.symbols.get(letter)
        if earlier is None or named is None or named.dots or named.sub in ("", "0") or len(value.free_symbols) < 2:
            return False
        one, other = (expanded(self.known, each, letter, sure=True)[0] for each in (earlier.value, value))
        return set(one.free_symbols) == set(other.free_symbols)

    def may_hold_specially(self, claim: Claim) -> bool:
        """Whether a claim may hold in the special cases that sentences of its part name; only numbers refute it."""
        left_side = self.last_good_side(claim)
        if Cue.APPROXIMATE in claim.row.block.cues or left_side is None or claim.right is None:
            return True
        part = claim.row.block.part
        here = {each for each in self.known.conditions if self.claims[each].row.block.part == part}
        with suppress(Meaningless, NoNumber, *FAULTS):
            known = replace(self.known, conditions=self.known.conditions - here, kept={})
            points = Nearness(self.meaning, known, [], self.shown).points()
            return len(points) < 2 or all(holds_at(each, left_side, claim.right) for each in points)
        return True

    def doubt(self, verdict: Verdict, edit: Edit | None) -> None:
        """Leave a row undecided if one change would make it follow: it contains a slip or is a special case."""
        if edit is not None:
            verdict.outcome = Outcome.UNDECIDED
            verdict.because = f"it would follow from earlier rows with {suggestion_of(edit)}, but may be a special case"

    def may_have_other_value(self, claim: Claim) -> bool:
        """Whether a letter has an earlier value, and the sentence does not refer to the row of this value."""
        assert claim.values is not None
        found = self.known.definitions.get(claim.values[0], [])
        row = found[-1].row if found else None
        return bool(found) and (row is None or row.label not in _REFERENCE.findall(claim.row.block.sentence))

    def change_of_value(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which a letter would have its earlier value."""
        assert claim.values is not None and claim.right is not None
        value = self.known.definitions[claim.values[0]][-1].value
        return self.change_to(claim, value)

    def change_to(self, claim: Claim, value: Expr) -> Edit | None:
        """Return one change of the right side after which it would have the given value."""
        assert claim.right is not None
        if sympy.count_ops(value) < FEWEST_OPERATIONS:
            return None  # each short value is one change away from other values
        right_node = readings(claim.right, self.facts)[0][0]
        return Nearness(self.meaning, self.known, letters_in(right_node), self.shown).of_value(right_node, value)

    def change_at_instant(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which a letter such as v_1 would have the value at t_1 of a letter
        to whose row the sentence refers."""
        assert claim.values is not None
        for earlier, _ in values_at_instant(claim.values[0], self.meaning, self.known):
            label = earlier.row.label if earlier.row is not None else ""
            named = [self.meaning.symbols.get(each) for each in (earlier.symbol, claim.values[0])]
            same_letter = len({each.base for each in named if each is not None}) == 1
            if same_letter or (label and label in _REFERENCE.findall(claim.row.block.sentence)):
                edit = self.change_to(claim, expanded(self.known, earlier.value)[0])
                if edit is not None:
                    return edit
        return None

    def with_other_indices(self, letters: list[Letter]) -> list[Letter]:
        """Return the given letters and further letters of the document that differ from them only in the index."""
        bases = {(each.base, each.dots) for each in letters if each.sub}
        known = {(each.identity, each.dots) for each in letters}
        more = [each for each in self.meaning.symbols.values() if (each.base, each.dots) in bases]
        return letters + [each for each in more if (each.identity, each.dots) not in known][:MOST_INDICES]

    def strange_letters(self, claim: Claim) -> set[str]:
        """Return the letters that only this claim of the document contains, as they are written."""
        letters = letters_in(claim.left if claim.before is None else None, claim.right)
        return {self.shown(each.span) for each in letters if self.written[each.identity] == 1}

    def letters_for_strange(self, claim: Claim, written: list[Letter]) -> list[Letter]:
        """Return letters of the document that resemble a letter of a claim which no other claim contains."""
        strange = [each for each in written if self.written[each.identity] == 1]
        known = {(each.identity, each.dots) for each in written}
        return [
            each
            for each in self.meaning.symbols.values()
            if (each.identity, each.dots) not in known
            and any(each.base.lower() == odd.base.lower() or each.sub == odd.sub for odd in strange)
        ][:MOST_INDICES]

    def lost_letters(self, claim: Claim, written: list[Letter]) -> list[Letter]:
        """Return letters that a row lacks, although the earlier rows from which it should follow contain them."""
        assert claim.values is not None
        left = claim.values[0]
        behind = set(left.free_symbols | self.expanded(left).free_symbols) if claim.is_step else set()
        if isinstance(left, Symbol) and not claim.is_step:
            equations = [each for each, _ in self.known.equations[-MOST_ROWS:] if left in each.free_symbols]
            behind = set().union(*(expanded(self.known, each, left, sure=True)[0].free_symbols for each in equations))
        known = {(each.identity, each.dots) for each in written}
        found = [replace(each, dots=dots) for each in letters_in(claim.left, claim.right) for dots in range(each.dots)]
        found += [self.meaning.symbols[each] for each in sorted(behind, key=str) if each in self.meaning.symbols]
        return [each for each in found if (each.identity, each.dots) not in known][:MOST_LOST]

    def fixes_before(self, claim: Claim) -> list[Fix]:
        if claim.values is None:
            return []
        found: list[Fix] = []
        wanted = self.letters_behind(claim)
        undecided = claim.verdict is not None and claim.verdict.outcome is not Outcome.DIFFERS
        tried = 0
        for earlier in reversed(self.claims[: claim.number]):
            if scope_of(self.document, earlier.row) != self.scope or tried == MOST_FIXED:
                break
            if not self.may_be_changed(earlier) or earlier.statement is claim.statement:
                continue
            if not self.letters_behind(earlier) & wanted:
                continue
            if not claim.row.block.display and not earlier.row.block.display:
                continue  # two formulas in sentences may be about different cases
            if undecided and not self.belongs_to(claim, earlier) and not self.is_motion(earlier):
                continue  # a later part may be about another case
            tried += 1
            edit = self.near_edit(earlier, self.known_without(earlier, claim))
            found += [Fix(claim, earlier, edit)] if edit is not None else []
        return found or self.lost_before(claim)

    def lost_before(self, claim: Claim) -> list[Fix]:
        """Return the change that adds a lost term to the earlier value of a letter on the left side of a step. The term
        is on the right side of the step. The list is empty if there is no such change."""
        assert claim.values is not None
        if not claim.is_step or claim.right is None:
            return []
        terms = terms_in([claim.right], self.shown)
        for earlier in reversed(self.claims[: claim.number]):
            if not self.may_be_changed(earlier) or earlier.statement is claim.statement or earlier.values is None:
                continue
            letter = earlier.values[0].as_base_exp()[0]
            if scope_of(self.document, earlier.row) == self.scope and letter in claim.values[0].free_symbols:
                edit = self.near_edit(earlier, self.known_without(earlier, claim), terms)
                if edit is not None:
                    return [Fix(claim, earlier, edit)]
        return []

    def is_motion(self, claim: Claim) -> bool:
        """Whether a display states an equation of motion, which holds in later parts, too."""
        letters = letters_in(claim.left, claim.right)
        return claim.row.block.display and any(each.dots == 2 for each in letters)

    def may_be_changed(self, claim: Claim) -> bool:
        if claim.verdict is None or claim.verdict.outcome not in (Outcome.DEFINES, Outcome.UNDECIDED) or claim.is_step:
            return False
        if claim.relation not in ("=", ":=") or claim.left is None or claim.right is None or claim.values is None:
            return False
        return not any(isinstance(each, MatrixBase) for each in claim.values)

    def letters_behind(self, claim: Claim) -> set[Symbol]:
        assert claim.values is not None
        found: set[Symbol] = set()
        for value in entries_of(claim.values[0]) + entries_of(claim.values[1]):
            found |= value.free_symbols | expanded(self.known, value, sure=True)[0].free_symbols
        return found

    def known_without(self, earlier: Claim, claim: Claim, before: bool = False) -> Known:
        """Return the definitions and equations that the rows up to `claim` give without the row `earlier`.

        before   whether `claim` itself gives nothing
        """
        kept, self.known = self.known, self.assumptions()
        try:
            for each in self.claims[: claim.number + 1]:
                if each is not earlier and scope_of(self.document, each.row) == self.scope:
                    if each.number in self.lagrangians:
                        self.known.state(*self.lagrangians[each.number])
                    if each is not claim or not before:
                        self.remember(each, believed=each is claim)
            return self.known
        finally:
            self.known = kept

    def near_edit(self, claim: Claim, known: Known, lost: list[Node] | None = None) -> Edit | None:
        """Return one change of a side after which a claim would follow from other rows; None if no change is found.

        lost   terms that the claim may have lost
        """
        left_side = self.last_good_side(claim)
        if claim.right is None or left_side is None or claim.values is None:
            return None
        right_node, left_node = readings(claim.right, self.facts)[0][0], readings(left_side, self.facts)[0][0]
        places = [each for each in (left_node, right_node) if isinstance(each, Letter) and not each.dots]
        if len(places) == 2:  # "at theta = theta_1" names a place
            return None
        letter = claim.values[0] if isinstance(claim.values[0], Symbol) and not claim.is_step else None
        letters = self.with_other_indices(letters_in(left_node, right_node))
        letters += self.lost_letters(claim, letters) if known is self.known else []
        letters += self.letters_for_strange(claim, letters)
        letters += [each for each in lost or () if isinstance(each, Letter) and each not in letters]
        terms = self.terms_before(claim) if known is self.known and not self.may_be_special(claim) else lost
        near = Nearness(
            self.meaning, known, [each for each in letters if letter is None or self.meaning.symbol(each) != letter],
            self.shown, known is not self.known, terms=terms,
        )  # fmt: skip
        if letter is not None and (at_root := root_equation(letter, self.meaning, known)) is not None:
            unknown, equation, _ = at_root
            letters = self.with_letters_of(equation, near.letters)
            near.letters = [each for each in letters if self.meaning.symbol(each) != unknown]
            return near.of_root(right_node, unknown, equation)
        if letter is not None and Cue.ZERO in claim.row.block.cues and known is self.known:
            if (at_zero := zeros_in_time(letter, self.meaning, known)) is not None:
                edit = near.of_root(right_node, at_zero[0], at_zero[1])
                if edit is not None and edit.kind in DISTINCT:
                    return edit
        if letter is not None and (edit := self.near_motion(claim, near, right_node, letter)):
            return edit
        near.linear = Cue.APPROXIMATE in claim.row.block.cues or self.is_linear(claim)
        edit = near.of_claim(left_node, right_node, letter, claim.is_step)
        if edit is None and known is self.known and claim.row.block.display and not claim.is_step:
            near.known = replace(known, here=known.here | self.constraints_of_part(claim), kept={})
            if near.known.here - known.here:
                edit = near.of_claim(left_node, right_node, letter, claim.is_step)
            edit = edit or near.of_first_integral(left_node, right_node)
        return None if edit is not None and claim.is_step and self.repeats_a_side(claim, edit.node) else edit

    def constraints_of_part(self, claim: Claim) -> frozenset[int]:
        """Return the conditions in sentences of the same part that give a constant value to a coordinate: `r = l`, or
        `r = 0` if the claim does not contain r."""
        found, written = [], {each.identity for each in letters_in(claim.left, claim.right)}
        for each in self.claims[: claim.number]:
            if each.number not in self.known.conditions or each.row.block.part != claim.row.block.part:
                continue
            if each.values is None or not isinstance(each.values[0], Symbol) or isinstance(each.values[1], MatrixBase):
                continue
            letter, value = each.values
            constant = value.is_Symbol or (value.is_number and self.meaning.symbols[letter].identity not in written)
            if constant and moving_letters({letter}, self.meaning) and not moving_letters({value}, self.meaning):
                found.append(each.number)
        return frozenset(found)

    def near_motion(self, claim: Claim, near: Nearness, right_node: Node, letter: Symbol) -> Edit | None:
        """Return one change after which a frequency, a period or a motion would follow from an equation of motion, or
        None."""
        assert claim.values is not None
        for equation, number in reversed(frequency_equations(letter, self.meaning, near.known)):
            edit = near.of_root(right_node, letter, equation)
            if edit is not None and edit.meant != "1":  # a factor such as 2 in 2k may be right: two springs
                if self.may_change(edit, claim, self.claims[number]):
                    return edit
        for equation, number in reversed(equations_of_motion(*claim.values, self.meaning, near.known)):
            if self.belongs_to(claim, self.claims[number]) or self.is_motion(self.claims[number]):
                near.letters = self.with_letters_of(equation, near.letters)
                edit = near.of_motion(right_node, letter, equation)
                return edit if edit is not None and self.may_change(edit, claim, self.claims[number]) else None
        return None

    def may_change(self, edit: Edit, claim: Claim, motion: Claim) -> bool:
        """Whether a change that an equation of motion suggests is probably right; in another part, a number may be
        different."""
        return self.belongs_to(claim, motion) or edit.kind in (*DISTINCT, "factor")

    def with_letters_of(self, equation: Expr, letters: Sequence[Letter]) -> list[Letter]:
        """Return the given letters and the letters of an equation, without those that have dots."""
        found = [self.meaning.symbols.get(each) for each in sorted(equation.free_symbols, key=str)]
        return [*letters, *(each for each in found if each is not None and not each.dots and each not in letters)]

    def belongs_to(self, claim: Claim, earlier: Claim) -> bool:
        """Whether an earlier row is in the same part as a claim, or the sentence of the claim refers to its label."""
        block = claim.row.block
        return earlier.row.block.part == block.part or earlier.row.label in _REFERENCE.findall(block.sentence)

    def blame_common_rows(self) -> None:
        """If several rows differ, and all of them would follow after the same change of an earlier value, blame the row
        of this value."""
        differing = [
            each
            for each in self.claims
            if each.values
            and each.verdict
            and each.row.block.display
            and each.verdict.outcome is Outcome.DIFFERS
            and each.verdict.inherits is None
        ]
        for suspect in [each for each in self.claims if each.row.block.display and self.may_be_changed(each)]:
            scope = scope_of(self.document, suspect.row)
            later = [each for each in differing if each.number > suspect.number]
            later = [each for each in later if scope_of(self.document, each.row) == scope]
            if len(later) < 2 or not all(self.may_use(each, suspect) for each in later):
                continue
            with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
                edit = self.common_edit(suspect, later)
                if edit is not None:
                    self.blame(suspect, [Fix(each, suspect, edit) for each in later])
                    self.fixes = [fix for fix in self.fixes if fix.claim not in later]
                    return

    def may_use(self, claim: Claim, earlier: Claim) -> bool:
        """Whether a claim may depend on an earlier value: it contains the letter, or the value is an energy."""
        assert earlier.values is not None
        letter = earlier.values[0].as_base_exp()[0]
        named = self.meaning.symbols.get(letter)
        return letter in self.letters_behind(claim) or (named is not None and named.base in ENERGIES)

    def common_edit(self, suspect: Claim, later: Sequence[Claim]) -> Edit | None:
        """Return the cheapest change of the right side of a row after which all these later rows follow, or None."""
        assert suspect.values is not None and suspect.right is not None
        self.scope = self.meaning.scope = scope_of(self.document, suspect.row)
        letter, node = suspect.values[0], readings(suspect.right, self.facts)[0][0]
        states = [self.known_without(suspect, each, before=True) for each in later]
        near = Nearness(self.meaning, states[0], letters_in(suspect.right), self.shown, written=True, terms=[])
        for edit in near.edits(node):
            value = self.meaning.of(edit.node)
            new = Definition(letter, value, suspect.number)
            changed = [
                replace(
                    known,
                    definitions={**known.definitions, letter: [new, *known.definitions.get(letter, ())]},
                    equations=[*known.equations, (letter - value, suspect.number)],
                    kept={},
                )
                for known in states
            ]
            if all(
                self.follows(claim, known, surely=claim is later[0])
                for claim, known in zip(later, changed, strict=True)
            ):
                return edit
        return None

    def follows(self, claim: Claim, known: Known, surely: bool) -> bool:
        """Whether a claim follows from the given knowledge; unless `surely` is true, also if no change of the claim
        would follow."""
        if claim.values is None:
            return False
        kept, self.known = self.known, known
        try:
            verdict = Decision(claim, *claim.values, self.meaning, known, claim.row.block.cues).verdict()
            defines = verdict.outcome is Outcome.DEFINES
            if defines:
                return not surely and self.near_edit(claim, known) is None
            return verdict.outcome in GOOD
        finally:
            self.known = kept

    def blame(self, earlier: Claim, fixes: Sequence[Fix]) -> None:
        """Report an earlier row as wrong, because later rows would follow after one change of this row."""
        lines = ", ".join(str(fix.claim.row.line) for fix in fixes)
        where = f"line{'s' * (len(fixes) > 1)} {lines}"
        edit = fixes[0].edit
        earlier.verdict = Verdict(
            Outcome.DIFFERS, f"{where} would follow after one change here", suggestion=suggestion_of(edit),
            why_plausible=WHY[edit.kind], span=edit.span,
        )  # fmt: skip
        for claim in [each for fix in fixes for each in (fix.claim, *self.followers(fix.claim))]:
            because = "it follows from a row that is probably wrong"
            claim.verdict = Verdict(Outcome.HOLDS, because, inherits=earlier.number)

    def blame_earlier_rows(self) -> None:
        explained: dict[int, Claim] = {}  # the blamed row, by the number of a claim that follows after its change
        for fixes in self.fixes_by_row():
            earlier, meant = fixes[0].earlier, suggestion_of(fixes[0].edit)
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
            if formula.verdict is None or formula.verdict.outcome is Outcome.DIFFERS:
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
        because = f"line {claim.row.line} contradicts this row, and later rows follow only from line {claim.row.line}"
        letters = self.letters_behind(formula)
        behind = [each for each in self.claims[: claim.number] if each.values and each.values[0] in letters]
        suspects = [formula, *(each for each in reversed(behind) if each is not formula and self.may_be_changed(each))]
        self.scope = self.meaning.scope = scope_of(self.document, claim.row)
        edits: list[tuple[Claim, Edit]] = []
        for suspect in suspects:
            with suppress(*GIVEN_UP), time_limited(SECONDS_OF_SEARCH):
                lost: list[Node] | None = [*letters_in(suspect.right, claim.right)] if suspect is not formula else None
                edit = self.near_edit(suspect, self.known_without(suspect, claim), lost)
                edits += [(suspect, edit)] if edit is not None else []
        verdict = replace(claim.verdict, because=because, suggestion="", span=None)
        blamed = formula
        if edits:
            blamed, edit = edits[0]
            verdict.suggestion, verdict.why_plausible, verdict.span = suggestion_of(edit), WHY[edit.kind], edit.span
        verdict.or_lines = (claim.row.line, *(each.row.line for each, _ in edits[1:]))
        blamed.verdict = verdict

    def blame_odd_dimensions(self) -> None:
        """Report the row, if any, whose terms contradict the dimensions that all other rows of its problem or section
        give."""
        named = named_quantities(self.document, lambda row: scope_of(self.document, row))
        by_scope: dict[int, list[Claim]] = {}
        for claim in self.claims:
            by_scope.setdefault(scope_of(self.document, claim.row), []).append(claim)
        for scope, claims in by_scope.items():
            odd = odd_claims(claims, self.meaning, named.get(scope, {}))
            if odd:
                others = tuple(dict.fromkeys(each.row.line for each in odd[1:]))
                because = "the dimensions of its terms contradict the other rows"
                odd[0].verdict = Verdict(Outcome.DIFFERS, because, or_lines=others)

    def shown(self, span: Span) -> str:
        return self.document.source.text[span.start : span.end].strip()

    def may_be_special(self, claim: Claim) -> bool:
        if Cue.APPROXIMATE in claim.row.block.cues:
            return True
        for each in reversed(self.claims[: claim.number]):
            if each.row.block.part != claim.row.block.part:
                break
            if each.row.block.display or each.values is None or each.row is claim.row:
                continue
            right = each.values[1]
            if each.relation not in ("=", ":=") or right.is_number:
                return True
            if isinstance(right, Symbol) and not self.known.is_rate(right):
                return True
        return False

    def terms_before(self, claim: Claim) -> list[Node]:
        """Return the terms and the letters of the last claims in displays, up to this claim."""
        rows = [each for each in self.claims[: claim.number + 1] if each.row.block.display]
        sides = [side for each in reversed(rows[-MOST_ROWS:]) for side in (each.left, each.right) if side is not None]
        return terms_in(sides, self.shown)

    def repeats_a_side(self, claim: Claim, node: Node) -> bool:
        """Whether a changed side repeats an earlier side of its chain: `a = b = a` says nothing."""
        value, before = self.meaning.of(node), claim.before
        while before is not None:
            if before.values is not None and value in before.values:
                return True
            before = before.before
        return False

    def loses_letters(self, claim: Claim) -> bool:
        assert claim.values is not None
        left, right = (self.expanded(each) for each in claim.values)
        return bool(left.free_symbols - right.free_symbols)

    def suggest(self, claim: Claim, left_side: Node, verdict: Verdict) -> None:
        """Suggest the nearest change of the right side after which the claim holds, or else a lost term."""
        assert claim.right is not None and claim.values is not None
        right_node = readings(claim.right, self.facts)[0][0]
        until = process_time() + SECONDS_OF_SEARCH
        if not self.find_edit(claim, claim.values[0], right_node, left_side, verdict, until):
            self.find_lost_term(claim, verdict)

    def find_lost_term(self, claim: Claim, verdict: Verdict) -> None:
        """Suggest a term of the left side that is missing on the right side."""
        at_place = any(isinstance(each, EvalBar) for each in claim.left.walk()) if claim.left is not None else False
        if claim.values is None or (claim.row.block.cues & SPECIAL and not at_place):
            return
        left, right = (self.expanded(each) for each in claim.values)
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase) or right == 0:
            return
        lost = sympy.expand(left - right)
        terms = sympy.Add.make_args(sympy.expand(left))
        if lost in terms and len(terms) > 1 and lost.free_symbols & right.free_symbols:
            verdict.suggestion, verdict.why_plausible = f"with the term {lost}", "a term was lost"

    def find_edit(
        self,
        claim: Claim,
        left: Value,
        right_node: Node,
        left_side: Node,
        verdict: Verdict,
        until: float = float("inf"),
    ) -> bool:
        text = self.document.source.text
        letters = {
            (each.identity, each.dots): each
            for side in (left_side, right_node)
            for each in side.walk()
            if isinstance(each, Letter)
        }
        expanded_left = self.expanded(left)
        for symbol in left.free_symbols | expanded_left.free_symbols:
            if (letter := self.meaning.symbols.get(symbol)) is not None:
                letters.setdefault((letter.identity, letter.dots), letter)

        def is_right(node: Node) -> bool:
            if process_time() > until:
                return False
            for plain in PLAIN[:2]:
                meaning = self.meaning_of(self.meaning.scope, plain)
                try:
                    value = meaning.of(node)
                    if isinstance(value, MatrixBase) != isinstance(left, MatrixBase):
                        continue
                    if same(left, value) or same(expanded_left, self.expanded(value)):
                        return True
                except (Meaningless, *FAULTS):
                    continue
            return False

        edit = nearest_edit(
            right_node, list(letters.values()), is_right, lambda span: text[span.start : span.end].strip()
        )
        if edit is None:
            return False
        verdict.suggestion = suggestion_of(edit)
        verdict.why_plausible, verdict.span = WHY[edit.kind], edit.span
        return True

    def expanded(self, value: Value) -> Value:
        found = list(self.known.expanded(value))
        return found[-1][0][0] if found else value

    def of_missing_differential(self, claim: Claim, left_side: Node) -> Verdict | None:
        """Return a verdict if the right side lacks a differential; otherwise None.

        The result is also None if no single change makes the claim right and `lacks_differential` is false.
        """
        assert claim.right is not None
        if not any(isinstance(each, Int) for each in claim.right.walk()):
            return None
        right_node = readings(claim.right, self.facts)[0][0]
        try:
            self.meaning.of(right_node)
        except Meaningless as error:
            if "no differential" not in error.reason:
                return None
            verdict = Verdict(Outcome.DIFFERS, error.reason, span=error.span)
            with suppress(Meaningless):
                left = self.meaning.of(readings(left_side, self.facts)[0][0])
                claim.values = None
                if self.find_edit(claim, left, right_node, left_side, verdict):
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
            if again.outcome is Outcome.HOLDS and slips & set(again.given):
                again.inherits = min(slips & set(again.given))
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

    def value_of(self, symbol: Symbol) -> Value | None:
        found = self.known.definitions.get(symbol)
        return found[-1].value if found else None

    def last_good_side(self, claim: Claim) -> Node | None:
        """Return the left side, or the nearest earlier side of the chain that has a value; None if there is none."""
        asked = claim
        while claim.before is not None and (
            claim.left is None or claim.before.right is None or claim.before.values is None
        ):
            if claim.before.left is None and claim.before.before is None:
                return None
            earlier = claim.before
            asked.from_head = earlier.before is None
            claim = earlier
        return claim.left

    def sides(self, left: Node, right: Node, meaning: Meaning) -> tuple[Value, Value]:
        for letter, other, first in ((left, right, True), (right, left, False)):
            shape = shape_of(other)
            if isinstance(letter, Letter) and shape is not None and any(
                isinstance(each, Letter) and each.identity == letter.identity for each in other.walk()
            ):  # fmt: skip
                value = Meaning(
                    self.facts,
                    derivatives=meaning.derivatives,
                    symbols=meaning.symbols,
                    plain="all",
                    scope=meaning.scope,
                ).of(other)
                named = meaning.components(letter, *shape)
                return (named, value) if first else (value, named)
        return meaning.of(left), meaning.of(right)

    def is_special_case(self, claim: Claim) -> bool:
        """Whether a sentence gives a letter a value in one case only: `if R = a/2`."""
        assert claim.values is not None
        left, right = claim.values
        block = claim.row.block
        simple = isinstance(left, Symbol) and left in self.known.seen and isinstance(right, sympy.Expr)
        return bool(simple and not block.display and Cue.GIVEN in block.cues and right.as_coeff_Mul()[1].is_Symbol)

    def is_condition(self, claim: Claim, verdict: Verdict, believed: bool = False) -> bool:
        """Whether a claim may hold in one case or at one instant only, as a formula in a sentence may."""
        if believed and self.is_general(claim):
            return False
        if verdict.outcome in (Outcome.HOLDS, Outcome.APPROXIMATES):
            general = self.known.at_rest if claim.row.block.display else set()  # a root is a value, not a condition
            return bool((self.known.conditions - general) & set(verdict.given))
        if claim.row.block.display or claim.number in self.explained:
            return False
        if verdict.outcome is not Outcome.DEFINES or claim.values is None:
            return True
        letter, value = claim.values
        if value == 0 and letter.is_Symbol and letter.name in ("U", "V") and letter not in self.known.seen:
            return False  # the choice of the zero of a potential energy
        if not isinstance(letter, Symbol) or isinstance(value, MatrixBase) or value.is_number:
            return True
        if value.is_Symbol and claim.index + 1 < len(claim.statement.relations):
            return True  # `theta = phi = 0`
        if moving_letters(set(self.known.new_letters(value.free_symbols)), self.meaning):
            return False  # `r = r_0 + eta` introduces another coordinate
        if self.known.is_rate(letter) and moving_letters(value.free_symbols, self.meaning):
            return False  # an equation of motion
        return any(letter in equation.free_symbols for equation, _ in self.known.equations)

    def is_constant(self, claim: Claim) -> bool:
        """Whether a sentence gives a constant value to a coordinate: `x = a`."""
        if claim.values is None or claim.row.block.display or isinstance(claim.values[1], MatrixBase):
            return False
        letter, value = claim.values
        if not isinstance(letter, Symbol) or not moving_letters({letter}, self.meaning) or self.known.is_rate(letter):
            return False
        named = [self.meaning.symbols.get(each) for each in value.free_symbols]
        depends_on_time = any(each is None or each.base == "t" for each in named)
        return not depends_on_time and not moving_letters(value.free_symbols, self.meaning)

    def is_linear(self, claim: Claim) -> bool:
        assert claim.values is not None
        left, right = claim.values
        return isinstance(left, Expr) and isinstance(right, Expr) and is_linear(left - right, self.meaning)

    def is_equilibrium(self, claim: Claim) -> bool:
        """Whether an equation contains one coordinate and no rates, although earlier rows contain rates of this
        coordinate: it holds at an equilibrium only."""
        if claim.values is None or claim.relation != "=" or isinstance(claim.values[0], Symbol | MatrixBase):
            if claim.values is None or claim.values[0] not in self.meaning.derivatives:
                return False
        if isinstance(claim.values[1], MatrixBase):
            return False
        value, _ = expanded(self.known, claim.values[0] - claim.values[1], sure=True)
        changing = moving_letters(value.free_symbols, self.meaning)
        if len(changing) != 1 or self.meaning.symbols[changing[0]].dots:
            return False
        rates = {replace(self.meaning.symbols[changing[0]], dots=dots) for dots in (1, 2)}
        return any(self.meaning.symbol(each) in self.known.seen for each in rates)

    def is_constant_length(self, claim: Claim) -> bool:
        """Whether a letter is a sum of multiples of coordinates, and the text calls it constant: `l = x + 2 y`."""
        assert claim.values is not None
        letter, value = claim.values
        if Cue.CONSTANT not in claim.row.block.cues or not isinstance(letter, Symbol) or isinstance(value, MatrixBase):
            return False
        moving = moving_letters(value.free_symbols, self.meaning)
        if not moving or moving_letters({letter}, self.meaning) or any(self.known.is_rate(each) for each in moving):
            return False
        return all(sympy.diff(value, each).is_number for each in moving)

    def remember(self, claim: Claim, believed: bool = False) -> None:
        """Remember the definitions, the equation or the bound that a claim gives for later rows."""
        if claim.values is None or claim.verdict is None:
            return
        if self.is_special_case(claim):
            return
        if self.is_condition(claim, claim.verdict, believed):
            self.known.conditions.add(claim.number)
        elif self.is_equilibrium(claim):
            self.known.conditions.add(claim.number)
            self.known.at_rest.add(claim.number)
        if self.is_constant(claim):
            self.known.instants[claim.number] = self.meaning.symbols[claim.values[0]].identity
            if len(claim.values[1].free_symbols) > 1:
                self.known.places.add(claim.number)
        self.known.seen |= claim.values[0].free_symbols | claim.values[1].free_symbols
        if claim.relation not in ("=", ":="):
            start = claim
            while start.before is not None:
                start = start.before
            head, bound = start.values[0] if start.values is not None else None, claim.values[1]
            if isinstance(head, Symbol) and bound.is_number:
                self.known.bounds.append((head, claim.relation, bound, claim.number))
            return
        left, right = claim.values
        if claim.row.block.display and claim.verdict.outcome is Outcome.DEFINES and isinstance(left, Symbol):
            self.known.named.add(left)
        number = claim.number
        for rate in rates(claim.values[1], self.meaning, self.known) if self.is_constant_length(claim) else ():
            self.known.state(rate, number)
        first = claim
        while first.before is not None:
            first = first.before
        head = first.values[0] if first.values is not None else left
        wrong = claim.verdict.outcome is Outcome.DIFFERS and not believed
        pairs = [(head, right)] if not isinstance(head, MatrixBase) and not isinstance(right, MatrixBase) else []
        if isinstance(head, MatrixBase) and isinstance(right, MatrixBase) and head.shape == right.shape:
            pairs = list(zip(head, right, strict=True))
        for symbol, value in pairs:
            if isinstance(symbol, Symbol) and wrong:
                self.known.slips[symbol] = Definition(symbol, value, number)
            elif isinstance(symbol, Symbol) and claim.verdict.inherits is None:
                self.known.define(symbol, value, number, row=claim.row, chain=first.number)
                self.known.slips.pop(symbol, None)
        if believed and isinstance(left, MatrixBase) and isinstance(right, MatrixBase) and left.shape == right.shape:
            self.known.state(left - right, number)
        if wrong or any(isinstance(each, MatrixBase) for each in (head, left, right)):
            return
        if claim.verdict.outcome is Outcome.HOLDS and not claim.verdict.given and not isinstance(left, Symbol):
            return  # an identity gives nothing new
        if not claim.row.block.display and isinstance(left, Symbol) and right.is_number and right != 0:
            return  # a number in a sentence, such as `m = 2` for a drawing, is not used as an equation
        self.known.state(sympy.expand(left - right) if sympy.count_ops(left - right) < 600 else left - right, number)


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


def suggestion_of(edit: Edit) -> str:
    return f"{edit.meant} instead of {edit.was}" if edit.meant else f"without {edit.was}"


Reading = tuple[Node, tuple[Choice, ...]]
__all__ = ["Audit", "Cue", "Statement", "Value", "audited", "claims_of"]
