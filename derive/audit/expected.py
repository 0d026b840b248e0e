"""The comparison of a document with the results of a derivation, so that a wrong method is found, too.

The results are given as LaTeX and read like the rows of the document, so that a letter means the same in both. Each
problem is compared with the section that states the greatest number of steps of its derivation, and with other sections
that state steps of it; see `LEAST_SCORE`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

import sympy
from sympy import Abs as AbsoluteValue
from sympy import Expr, MatrixBase, Symbol

from derive.audit.claims import Claim, Outcome, Verdict
from derive.audit.deciding import Decision, is_multiple, same
from derive.audit.knowledge import Known
from derive.audit.time_limit import FAULTS, LimitReached, time_limited
from derive.documents.choices import readings
from derive.documents.facts import Facts
from derive.documents.layout import read_document
from derive.documents.meaning import Meaning, Meaningless, Value
from derive.documents.parser import Unreadable, parsed
from derive.documents.source import Format, source_of
from derive.documents.syntax import Abs, Der, EvalBar, Fun, Letter, Node

SECONDS = 5.0  # seconds of processor time for comparing one result, or for counting the steps in one section
# The section that states the greatest number of steps of a derivation is compared with the answers, and so are its
# neighbours if they state any step. Other sections are compared if they state at least this number of steps.
LEAST_SCORE = 3
NAMED = (Letter, Abs, Der, EvalBar, Fun)


@dataclass(frozen=True)
class Expected:
    """A result of a derivation; `asked` is true if the result is an answer to a part of the problem."""

    problem: str
    key: str
    latex: str
    asked: bool = True


class Status(StrEnum):
    FOUND = "found"
    DIFFERS = "differs"
    MISSING = "not found"
    UNREAD = "not compared"


@dataclass
class Compared:
    """A result, whether the document contains it, and the number of the claim that contains or contradicts it."""

    expected: Expected
    status: Status
    claim: int | None = None


@dataclass(frozen=True)
class Result:
    """A result in the letters of the document: the value of `name`, or an equation or condition without a name.

    node     the right side
    symbol   the name as a letter, if it has one value; otherwise None
    left     the left side of a result without a name
    """

    expected: Expected
    name: Node
    node: Node
    relation: str
    symbol: Symbol | None
    left: Value
    right: Value

    @property
    def is_named(self) -> bool:
        return self.relation in ("=", "~") and isinstance(self.name, NAMED)

    @property
    def symbols(self) -> set[Symbol]:
        is_equation = not self.is_named and not isinstance(self.left, MatrixBase)
        return set(self.left.free_symbols | self.right.free_symbols if is_equation else self.right.free_symbols)

    @property
    def entries(self) -> list[Expr]:
        """The entries with letters in a list or matrix, without repetitions."""
        if not isinstance(self.right, MatrixBase):
            return []
        return [each for each in dict.fromkeys(self.right) if each.free_symbols]


class Comparison:
    """The comparison of a document with the results of derivations, in the sections that state steps of them.

    claims       all claims of the document
    scopes       the scope of each claim
    known        the definitions, equations and numbers that the rows of each scope give
    meaning_of   the meaning of letters in a scope
    """

    def __init__(
        self,
        claims: Sequence[Claim],
        scopes: Sequence[int],
        known: dict[int, Known],
        facts: Facts,
        meaning_of: Callable[[int], Meaning],
        expected: Iterable[Expected],
    ):
        self.by_problem: list[tuple[list[Expected], list[Section]]] = []
        problems: dict[str, list[Expected]] = {}
        for each in expected:
            problems.setdefault(each.problem, []).append(each)
        for results in problems.values():
            sections = []
            for scope in known:
                here = [claim for claim, number in zip(claims, scopes, strict=True) if number == scope]
                read = [_read(each, facts, meaning_of(scope)) for each in results]
                sections.append(Section(here, known[scope], read, facts))
            self.by_problem.append((results, _near(sections)))

    @property
    def sections(self) -> list[Section]:
        """The sections that state steps of a derivation, for each derivation."""
        return [section for _, near in self.by_problem for section in near]

    def answers(self) -> list[Compared]:
        """Return, for each answer, whether the document contains it. The verdict on a claim that contradicts an answer
        is changed to "differs"."""
        return [_of(each, near) for results, near in self.by_problem for each in results if each.asked]


def _near(sections: Sequence[Section]) -> list[Section]:
    """Return the section that states the greatest number of steps of a derivation, and other sections that state steps
    of it."""
    scores = [section.score() for section in sections]
    best = scores.index(max(scores)) if scores else 0
    return [
        section
        for at, (score, section) in enumerate(zip(scores, sections, strict=True))
        if at == best or score >= LEAST_SCORE or (abs(at - best) == 1 and score > 0)
    ]


def _of(expected: Expected, sections: list[Section]) -> Compared:
    """Return whether the sections state an answer, and the claim that states or contradicts it. Report the rows that
    contradict it."""
    found = Compared(expected, Status.UNREAD)
    try:
        with time_limited(SECONDS):
            for section in sections:
                section.find(found)
            for section in sections:
                section.contradict(found)
    except (LimitReached, RecursionError):
        found.status = Status.UNREAD if found.status is Status.MISSING else found.status
    return found


def _read(expected: Expected, facts: Facts, meaning: Meaning) -> Result | None:
    document = read_document(source_of(f"$${expected.latex}$$", Format.TEX))
    statements = [statement for row in document.rows for statement in row.statements]
    if len(statements) != 1 or len(statements[0].sides) != 2:
        return None
    relation = statements[0].relations[0]
    try:
        left, right = (readings(parsed(side.tokens), facts)[0][0] for side in statements[0].sides)
        value = meaning.of(right)
        is_named = relation in ("=", "~") and isinstance(left, NAMED)
        name = sympy.Integer(0) if is_named else meaning.of(left)
    except (Unreadable, Meaningless, *FAULTS):
        return None
    symbol = None
    with suppress(Meaningless, *FAULTS):
        symbol = meaning.of(left) if is_named else None
    return Result(expected, left, right, relation, symbol if isinstance(symbol, Symbol) else None, name, value)


def _is_equal(result: Result, claim: Claim) -> bool:
    if claim.values is None:
        return False
    return _states(result, claim, *claim.values, result.left, result.right)


def _states(result: Result, claim: Claim, left: Value, right: Value, name: Value, value: Value) -> bool:
    try:
        if result.is_named:
            trivial = isinstance(value, Expr) and value.is_Integer
            if trivial and not _has_name(claim, result.name):
                return False
            return any(_comparable(each, value) and same(each, value) for each in (left, right)) or (
                claim.relation == "=" and is_solved_by(left, right, result.symbol, value)
            )
        if any(isinstance(each, MatrixBase) for each in (left, right, name, value)):
            return False
        if claim.relation == "=" and result.relation == "=":
            return is_multiple(sympy.expand(left - right), sympy.expand(name - value))
        return _same_condition(claim.relation, left - right, result.relation, name - value)
    except FAULTS:
        return False


def is_solved_by(left: Value, right: Value, symbol: Symbol | None, value: Value) -> bool:
    """Whether an equation is linear in a letter, and its solution is this value."""
    if symbol is None or any(isinstance(each, MatrixBase) for each in (left, right, value)):
        return False
    difference = left - right
    slope = sympy.diff(difference, symbol)
    if slope == 0 or slope.has(symbol) or left == symbol or right == symbol:
        return False
    return same(value * slope, symbol * slope - difference)


def _both_scalar(one: Value, other: Value) -> bool:
    return not isinstance(one, MatrixBase) and not isinstance(other, MatrixBase)


def _comparable(one: Value, other: Value) -> bool:
    if isinstance(one, MatrixBase) and isinstance(other, MatrixBase):
        return bool(one.shape == other.shape)
    return _both_scalar(one, other)


def _same_condition(relation: str, difference: Expr, wanted: str, other: Expr) -> bool:
    if relation[:1] not in "<>" or wanted[:1] not in "<>":
        return False
    signs = [1 if each[:1] == ">" else -1 for each in (relation, wanted)]
    ratio = sympy.simplify(difference * signs[0] / (other * signs[1]))
    return bool(ratio.is_positive)


def _has_name(claim: Claim, name: Node) -> bool:
    head = claim
    while head.before is not None:
        head = head.before
    one, other = head.left, name
    if isinstance(one, Abs) and isinstance(other, Abs):
        one, other = one.inner, other.inner
    if not isinstance(one, Letter) or not isinstance(other, Letter):
        return False
    return (one.base, one.sub, one.dots, one.primes) == (other.base, other.sub, other.dots, other.primes)


class Section:
    """The claims of one scope, with which the results of one problem are compared."""

    def __init__(self, claims: list[Claim], known: Known, results: list[Result | None], facts: Facts):
        self.claims, self.known, self.facts = claims, known, facts
        self.results = {result.expected.key: result for result in results if result is not None}
        asked = [result.symbols for result in self.results.values() if result.expected.asked]
        self.allowed = set[Symbol]().union(*asked)
        goes_on = {id(claim.before) for claim in claims if claim.before is not None}
        self.last = [claim for claim in claims if id(claim) not in goes_on]

    def score(self) -> int:
        """Return how many steps of the derivation the section states."""
        count = 0
        with suppress(LimitReached, RecursionError), time_limited(SECONDS):
            for result in self.results.values():
                count += any(_is_equal(result, claim) for claim in self.claims)
        return count

    def find(self, found: Compared) -> None:
        """Find the claim that states an answer."""
        result = self.results.get(found.expected.key)
        if result is None or found.status is Status.FOUND:
            return
        stated = next((claim for claim in self.claims if _is_equal(result, claim)), None)
        stated = stated or next((claim for claim in self.claims if self.states(result, claim)), None)
        stated = stated or self.entries_of(result)
        found.status = Status.MISSING if stated is None else Status.FOUND
        found.claim = stated.number if stated is not None else None

    def contradict(self, found: Compared) -> None:
        """Report the last claim that gives the letter of an answer a different value. If the document states the
        answer, report only a later display with the same letters, because other values may belong to other cases."""
        result = self.results.get(found.expected.key)
        if result is None or not result.is_named:
            return
        values = [claim for claim in self.last if _has_name(claim, result.name) and self.contradicts(result, claim)]
        stated = found.claim if found.status is Status.FOUND else None
        if stated is not None:
            values = [claim for claim in values if claim.number > stated and self.repeats(result, claim)]
        for claim in values[-1:]:
            self.blame(result, claim)
            found.status, found.claim = Status.DIFFERS, claim.number

    def repeats(self, result: Result, claim: Claim) -> bool:
        """Whether a display gives the letter of an answer a value with the same letters, which is no other answer."""
        assert claim.values is not None
        same_letters = claim.values[1].free_symbols == result.right.free_symbols
        others = [each for each in self.results.values() if each.is_named and each.symbol == result.symbol]
        if not claim.row.block.display or not same_letters or self.has_condition(claim):
            return False
        return not any(_is_equal(each, claim) for each in others)

    def has_condition(self, claim: Claim) -> bool:
        """Whether the text between a display and the display before it names a special case: `For alpha = pi/4, ...`"""
        for each in reversed([each for each in self.claims if each.number < claim.number]):
            if each.row.block.display and each.row.block is not claim.row.block:
                return False
            if each.number in self.known.conditions and each.values is not None and isinstance(each.values[0], Symbol):
                return True
        return False

    def entries_of(self, result: Result) -> Claim | None:
        """Return the claim that states the last entry of a list or matrix, if each entry is stated by itself; otherwise
        None."""
        found = None
        for entry in result.entries:
            found = next((claim for claim in self.claims if claim.values is not None and any(
                isinstance(each, Expr) and same(each, entry) for each in claim.values
            )), None)  # fmt: skip
            if found is None:
                return None
        return found

    def states(self, result: Result, claim: Claim) -> bool:
        if claim.values is None:
            return False
        if any(_states(result, claim, *values) for values in self.expanded(result, claim)):
            return True
        return result.is_named and self.is_rounded(result, claim)

    def expanded(self, result: Result, claim: Claim) -> Iterator[tuple[Value, Value, Value, Value]]:
        assert claim.values is not None
        for values, _ in self.known.expanded(*claim.values, result.left, result.right):
            left, right, name, value = values
            yield left, right, name, value

    def is_rounded(self, result: Result, claim: Claim) -> bool:
        assert claim.values is not None
        if not claim.decimals or not _comparable(claim.values[1], result.right):
            return False
        meaning = Meaning(self.facts, decimals=list(claim.decimals))
        decision = Decision(claim, result.right, claim.values[1], meaning, self.known, frozenset())
        return decision.rounded() is not None

    def contradicts(self, result: Result, claim: Claim) -> bool:
        """Whether the value that a claim gives contradicts the derived value."""
        if claim.values is None or claim.relation not in ("=", "~"):
            return False
        if result.relation != claim.relation and not claim.decimals:
            return False  # an approximation and an exact value do not contradict each other
        if claim.number in self.known.conditions:
            return False  # a value at one place or instant, or in a special case
        value = claim.values[1]
        if not _comparable(value, result.right) or self.is_rounded(result, claim):
            return False
        pairs = [(value, result.right), *((right, wanted) for _, right, _, wanted in self.expanded(result, claim))]
        if any(_comparable(one, other) and same(one, other) for one, other in pairs):
            return False
        written, wanted = pairs[-1]
        if bool(written.free_symbols) != bool(wanted.free_symbols):
            return False
        named = {each.symbol for each in self.results.values()}
        if (wanted.free_symbols & named) - self.known.seen:
            return False  # the document has other letters for these quantities
        return any(one.free_symbols <= self.allowed for one, _ in pairs)

    def blame(self, result: Result, claim: Claim) -> None:
        problem, latex = result.expected.problem, result.expected.latex
        because = f"the derivation of {problem} gives ${latex}$"
        before = claim.verdict
        if before is not None and before.outcome is Outcome.DIFFERS:
            before.because += f"; {because}" if because not in before.because else ""
            return
        inherits = before.inherits if before is not None else None
        claim.verdict = Verdict(Outcome.DIFFERS, because, inherits=inherits, choices=before.choices if before else ())
        value = claim.values[1] if claim.values is not None else None
        if isinstance(value, Expr) and isinstance(result.right, Expr) and result.right != 0:
            ratio = sympy.simplify(value / result.right)
            if ratio == -1:
                claim.verdict.why_plausible = "the sign is reversed"
            elif ratio.is_number and ratio.is_Rational:
                claim.verdict.why_plausible = f"the row is {AbsoluteValue(ratio)} times the derived result"


__all__ = ["Compared", "Comparison", "Expected", "Result", "Section", "Status", "is_solved_by"]
