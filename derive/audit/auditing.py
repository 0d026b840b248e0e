"""The audit of a whole document: each claim in its order, with what the claims before it gave."""

from __future__ import annotations

import re
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice, product

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.claims import Claim, Outcome, Verdict
from derive.audit.deciding import Decision
from derive.audit.known import Known
from derive.documents.choices import Choice, readings
from derive.documents.facts import Facts, facts_of, shape_of
from derive.documents.layout import Cue, Document, Row, Statement
from derive.documents.meaning import Meaning, Meaningless, Value
from derive.documents.parser import Unreadable, parsed
from derive.documents.syntax import Letter, Node

SECONDS = 4.0  # of processor time for one claim
MOST_READINGS = 8
PLAIN = ("", "unmarked", "all", "tensors")
FAULTS = (ValueError, TypeError, ZeroDivisionError, AttributeError, NotImplementedError, sympy.SympifyError)
GOOD = (Outcome.HOLDS, Outcome.APPROXIMATES, Outcome.DEFINES)
_NEW_SCOPE = re.compile(r"\b(problem|exercise|question|aufgabe|example)\b", re.IGNORECASE)


class _OutOfTime(BaseException):
    pass


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    def stop(*_: object) -> None:
        raise _OutOfTime

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


@dataclass
class Audit:
    document: Document
    facts: Facts
    claims: list[Claim]
    unread: list[tuple[Row, str]] = field(default_factory=list)


def claims_of(document: Document) -> tuple[list[Claim], Facts, list[tuple[Row, str]]]:
    """Return the claims of a document, the facts about its letters, and the rows that are not read."""
    nodes: dict[int, list[tuple[Node | None, str]]] = {}
    sides, equations, unread = [], [], []
    for row in document.rows:
        faults = [row.fault[0]] if row.fault else []
        for statement in row.statements:
            read: list[tuple[Node | None, str]] = []
            for side in statement.sides:
                try:
                    read.append((parsed(side.tokens), ""))
                except Unreadable as error:
                    read.append((None, error.message))
                    faults.append(error.message)
                except RecursionError:
                    read.append((None, "this formula is nested too deep"))
                    faults.append("this formula is nested too deep")
            nodes[id(statement)] = read
            sides += [node for node, _ in read if node is not None]
            equations += [
                (a[0], b[0]) for a, b in zip(read, read[1:], strict=False) if a[0] is not None and b[0] is not None
            ]
        if faults:
            unread.append((row, faults[0]))
    facts = facts_of(sides, equations)
    claims: list[Claim] = []
    last_of: dict[int, Claim] = {}
    for row in document.rows:
        for statement in row.statements:
            before = last_of.get(id(statement.follows)) if statement.follows is not None else None
            read = nodes[id(statement)]
            for index, relation in enumerate(statement.relations):
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


def audited(
    document: Document,
    assume: list[tuple[str, str]] = [],  # noqa: B006
    progress: Callable[[int, int], None] | None = None,
) -> Audit:
    """Return the verdict on each claim of a document."""
    claims, facts, unread = claims_of(document)
    auditor = _Auditor(document, facts)
    for done, claim in enumerate(claims):
        import os, time as _t; _b=_t.time()
        auditor.decide(claim)
        if os.environ.get("SLOW") and _t.time()-_b>1.5: print("slow",claim.row.line,round(_t.time()-_b,1),claim.row.latex[:80],claim.verdict,flush=True)
        if progress is not None:
            progress(done + 1, len(claims))
    return Audit(document, facts, claims, unread)


class _Auditor:
    def __init__(self, document: Document, facts: Facts):
        self.document, self.facts = document, facts
        self.scope: int | None = None
        self.meaning = Meaning(facts)
        self.known = Known(self.meaning)

    def decide(self, claim: Claim) -> None:
        scope = self.scope_of(claim.row)
        if scope != self.scope:
            self.scope = scope
            self.known = Known(self.meaning)
        if claim.left is None or claim.right is None:
            claim.verdict = Verdict(Outcome.UNREADABLE, claim.fault or "this is not read")
            return
        if claim.relation in ("to", "in"):
            claim.verdict = Verdict(Outcome.UNDECIDED, "this relation is not checked")
            return
        try:
            with _limited(SECONDS):
                claim.verdict = self.best(claim)
        except _OutOfTime:
            claim.verdict = Verdict(Outcome.UNDECIDED, f"this takes more than {SECONDS:g} seconds")
        except RecursionError:
            claim.verdict = Verdict(Outcome.UNDECIDED, "this formula is nested too deep")
        self.remember(claim)

    def scope_of(self, row: Row) -> int:
        for index in range(row.block.heading, -1, -1):
            heading = self.document.headings[index]
            if heading.level <= 1 or _NEW_SCOPE.search(heading.text):
                return index
        return -1

    def best(self, claim: Claim) -> Verdict:
        """Return the verdict for the reading that makes the claim hold, or for the likeliest reading."""
        first: Verdict | None = None
        reason = ""
        seen: list[tuple[Value, Value]] = []
        assert claim.left is not None and claim.right is not None
        cues = claim.row.block.cues
        pairs = product(readings(claim.left, self.facts), readings(claim.right, self.facts))
        for (left_node, left_choices), (right_node, right_choices) in islice(pairs, MOST_READINGS):
            for plain in PLAIN:
                meaning = Meaning(
                    self.facts, derivatives=self.meaning.derivatives, symbols=self.meaning.symbols, plain=plain
                )
                try:
                    left, right = self.sides(left_node, right_node, meaning)
                    if (left, right) in seen:
                        continue
                    seen.append((left, right))
                    verdict = Decision(claim, left, right, meaning, self.known, cues).verdict()
                except Meaningless as error:
                    reason = reason or error.reason
                    continue
                except FAULTS as error:
                    reason = reason or f"SymPy cannot handle it: {error}"
                    continue
                verdict.choices = (*left_choices, *right_choices)
                if verdict.outcome in GOOD:
                    claim.values = (left, right)
                    return verdict
                if first is None or (first.outcome is Outcome.DIFFERS and verdict.outcome is Outcome.UNDECIDED):
                    first, claim.values = verdict, (left, right)
        return first or Verdict(Outcome.UNDECIDED, reason or "this has no value")

    def sides(self, left: Node, right: Node, meaning: Meaning) -> tuple[Value, Value]:
        """Return the values of two sides; a letter that is set equal to a list is a vector, but a number in the list."""
        for letter, other, first in ((left, right, True), (right, left, False)):
            shape = shape_of(other)
            if isinstance(letter, Letter) and shape is not None and any(
                isinstance(each, Letter) and each.identity == letter.identity for each in other.walk()
            ):  # fmt: skip
                value = Meaning(self.facts, derivatives=meaning.derivatives, symbols=meaning.symbols, plain="all").of(other)
                named = meaning.components(letter, *shape)
                return (named, value) if first else (value, named)
        return meaning.of(left), meaning.of(right)

    def remember(self, claim: Claim) -> None:
        """Remember a definition or an equation for the rows that follow."""
        if claim.values is None or claim.verdict is None or claim.relation not in ("=", ":="):
            return
        left, right = claim.values
        number = claim.number
        first = claim
        while first.before is not None:
            first = first.before
        head = first.values[0] if first.values is not None else left
        if isinstance(head, MatrixBase) and isinstance(right, MatrixBase) and head.shape == right.shape:
            for symbol, value in zip(head, right, strict=True):
                if isinstance(symbol, Symbol) and not isinstance(value, MatrixBase):
                    self.known.define(symbol, value, number)
            return
        if isinstance(head, Symbol) and isinstance(right, Expr) and claim.verdict.outcome is not Outcome.DIFFERS:
            self.known.define(head, right, number)
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
            return
        if claim.verdict.outcome is Outcome.HOLDS and not claim.verdict.given and not isinstance(left, Symbol):
            return  # an identity gives nothing new
        self.known.state(sympy.expand(left - right) if sympy.count_ops(left - right) < 600 else left - right, number)


Reading = tuple[Node, tuple[Choice, ...]]
__all__ = ["Audit", "Cue", "Statement", "Value", "audited", "claims_of"]
