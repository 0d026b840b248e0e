"""What a document claims, and the verdict on each claim."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from itertools import pairwise

from sympy import Expr, Symbol

from derive.audit.slips import Edit
from derive.documents.choices import Choice
from derive.documents.layout import Row, Statement
from derive.documents.meaning import Value
from derive.documents.source import Span
from derive.documents.syntax import Node


@dataclass
class Definition:
    """The value that a claim gives to a letter."""

    symbol: Symbol
    value: Expr
    claim: int
    implied: bool = False  # the document does not state this definition, but a step needs it
    row: Row | None = None  # the row in which the letter got this value
    chain: int = -1  # the number of the first claim of the chain

    @property
    def part(self) -> int:
        """The part of the document in which the letter got this value."""
        return self.row.block.part if self.row is not None else -1


class Outcome(StrEnum):
    HOLDS = "holds"
    APPROXIMATES = "approximates"
    DEFINES = "defines"
    DIFFERS = "differs"
    UNDECIDED = "undecided"
    UNREADABLE = "unreadable"


GOOD = (Outcome.HOLDS, Outcome.APPROXIMATES, Outcome.DEFINES)


@dataclass
class Verdict:
    """The verdict on a claim, its reason, the earlier claims used, and the probable correction of a wrong claim."""

    outcome: Outcome
    because: str
    given: tuple[int, ...] = ()  # numbers of the claims that were used
    counterexample: str = ""
    suggestion: str = ""
    why_plausible: str = ""
    inherits: int | None = None  # the number of the claim whose slip this claim repeats
    choices: tuple[Choice, ...] = ()
    span: Span | None = None
    repeated: Definition | None = None  # the earlier value that this row claims to repeat
    contradicts: int | None = None  # the number of an earlier claim that gives a different value
    too_long: bool = False  # whether the time limit was reached
    at_place: bool = False  # whether the claim gives a value at one place or instant only
    or_lines: tuple[int, ...] = ()  # lines of earlier rows that may contain the slip instead

    def suggest(self, edit: Edit) -> None:
        """Suggest a change after which the claim would follow."""
        self.suggestion, self.why_plausible, self.span = edit.suggestion, edit.why, edit.span


@dataclass
class Claim:
    """Two neighbouring sides of a statement and the relation between them."""

    number: int
    row: Row
    statement: Statement
    index: int  # the index of the pair of sides in the statement
    relation: str
    left: Node | None
    right: Node | None
    left_span: Span
    right_span: Span
    fault: str = ""
    before: Claim | None = None  # the claim whose right side is the left side of this claim
    verdict: Verdict | None = None
    values: tuple[Value, Value] | None = None
    decimals: tuple[tuple[Value, int], ...] = ()  # each decimal in its sides, with the number of digits after the point
    # whether the right side is compared with the first side of the chain, because the sides between have no value
    from_head: bool = False
    tags: tuple[str, ...] = field(default_factory=tuple)

    @property
    def row_above(self) -> Row | None:
        """The row above in the same display, or None."""
        rows = self.row.block.rows
        return next((above for above, row in pairwise(rows) if row is self.row), None)

    @property
    def is_step(self) -> bool:
        """Whether the right side is compared with an earlier side of the chain other than the first."""
        return self.before is not None and not self.from_head
