"""The tree of a page, independent of formats: title, statement, parts, sentences, displays, drawings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from derive.algebra.dimensions import Dimension
from derive.algebra.equality import LEAST_SURE_FIRST, Grade
from derive.course.names import EvidenceShown
from derive.errors import Complaint
from derive.page.chain_lines import Equations
from derive.page.checks import Checks
from derive.page.numbering import Number
from derive.page.wording import Inline


@dataclass(frozen=True)
class Display:
    """Equations in one display, and the data of the note in the margin next to them."""

    groups: tuple[Equations, ...]
    grades: frozenset[Grade] = frozenset()
    routes: tuple[str, ...] = ()
    end: str = "."
    checks: tuple[str, ...] = ()

    @property
    def grade(self) -> Grade:
        """Return the lowest grade of the steps in the display."""
        return min(self.grades, key=LEAST_SURE_FIRST.index)

    def with_more(self, other: Display, beside: bool = False) -> Display:
        """Join two displays, in one row if `beside` is true. The routes of `other` are kept only if this display has no
        routes; the same is true of the checks."""
        groups = (
            (*self.groups[:-1], self.groups[-1].beside(other.groups[0])) if beside else (*self.groups, *other.groups)
        )
        routes, checks = (self.routes or other.routes), (self.checks or other.checks)
        return Display(groups, self.grades | other.grades, routes, checks=checks)

    @property
    def stops(self) -> tuple[str, ...]:
        """Return the punctuation after each step: commas between steps, and `end` after the last step."""
        return (",",) * (len(self.groups) - 1) + (self.end,)


@dataclass(frozen=True)
class Paragraph:
    nodes: tuple[Inline, ...]


@dataclass(frozen=True)
class Illustration:
    """A drawing on the page.

    stem       the name of its files, without a suffix
    alt        the alternative text
    number     the figure number, if the drawing has a caption
    at         the label of its part, or `statement`
    rests_on   the keys of the steps after which the drawing is placed
    leads_to   the keys of the steps before which the drawing is placed
    """

    key: str
    stem: str
    alt: tuple[Inline, ...]
    number: int | None
    caption: tuple[Inline, ...]
    at: str
    rests_on: tuple[str, ...] = ()
    leads_to: tuple[str, ...] = ()


@dataclass(frozen=True)
class Folded:
    """Additional lines of a more detailed page, folded until the reader opens them."""

    blocks: tuple[Block, ...]
    title: str = ""  # the heading; empty if the lines continue the equations before them


Block = Paragraph | Display | Illustration | Folded


@dataclass(frozen=True)
class PartPage:
    label: str
    ask: tuple[Inline, ...]
    points: Fraction | None
    blocks: tuple[Block, ...]
    extra: bool = False
    shown: bool = True  # false if only a more detailed page shows the part


@dataclass(frozen=True)
class Document:
    """The page of one problem."""

    id: str
    title: tuple[Inline, ...]
    points: Fraction | None
    statement: tuple[Inline, ...]
    illustrations: tuple[Illustration, ...]
    parts: tuple[PartPage, ...]
    note: tuple[Inline, ...]
    checks: Checks
    closing: tuple[Inline, ...]
    numbers: Mapping[str, Number]
    symbols: Mapping[str, Any]
    shown_in: Mapping[str, str]  # step -> label of the part that shows it
    dimensions: Mapping[Any, Dimension | None] = field(repr=False)
    warnings: tuple[Complaint, ...] = ()
    strategy: tuple[Inline, ...] = ()
    limits: PartPage | None = None
    evidence: EvidenceShown = EvidenceShown.NONE

    def points_of(self, part: PartPage) -> Fraction | None:
        """Return the points in the heading of a part; None if the heading of the problem already shows them."""
        return None if part.points == self.points and not part.extra else part.points

    @property
    def parts_shown(self) -> tuple[PartPage, ...]:
        return tuple(part for part in self.parts if part.shown)
