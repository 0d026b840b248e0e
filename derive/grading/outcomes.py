"""The verdicts on an answer, and the share of the points that each verdict earns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction


class Outcome(StrEnum):
    EQUAL = "equal"
    CONVENTION = "equal under a convention"
    SIGN = "sign"
    FACTOR = "off by a factor"
    MISSING = "missing term"
    EXTRA = "extra term"
    SPECIAL = "equal only for special values"
    ANOTHER = "another quantity of this problem"
    DIMENSION = "wrong dimension"
    DIFFERENT = "different"
    UNREADABLE = "unreadable"


RIGHT = (Outcome.EQUAL, Outcome.CONVENTION)
SLIPS = (Outcome.SIGN, Outcome.FACTOR, Outcome.MISSING, Outcome.EXTRA)
_ORDER = tuple(Outcome)


@dataclass(frozen=True)
class Verdict:
    """A verdict with its reason, the reading of the typed text, and the right answer with which the text was compared.

    target   the key of the right answer, or empty
    marked   the typed text with a caret under the place that cannot be read
    """

    outcome: Outcome
    because: str
    reading: str = ""
    target: str = ""
    marked: str = ""

    @property
    def is_right(self) -> bool:
        return self.outcome in RIGHT

    @property
    def rank(self) -> int:
        """The position in the order from right to unreadable; a smaller number is better."""
        return _ORDER.index(self.outcome)

    def adding(self, remark: str) -> Verdict:
        return replace(self, because=f"{self.because}; {remark}" if self.because else remark) if remark else self


def best_of(verdicts: Sequence[Verdict]) -> Verdict:
    """Return the verdict on a right reading, else on a reading with one slip, else on a reading that is right for
    special values, else on the likeliest reading."""
    for accepted in (RIGHT, SLIPS, (Outcome.SPECIAL,)):
        if found := [each for each in verdicts if each.outcome in accepted]:
            return min(found, key=lambda each: each.rank)
    return verdicts[0]


def share_of(outcome: Outcome, own: Fraction, whole: Fraction) -> Fraction:
    """Return the points for an answer.

    own     the points of the answer itself in the rubric
    whole   the points of the answer and of the steps before it

    A right answer earns all points. An answer with one slip (a sign, a factor, a term) earns the points of the steps
    before it, or half of the points if the rubric has no such steps. An answer that is right only for special values
    earns a quarter of the points. Every other answer earns nothing.
    """
    if outcome in RIGHT:
        return whole
    if outcome in SLIPS:
        return whole - own if own < whole else whole / 2
    return whole / 4 if outcome is Outcome.SPECIAL else Fraction(0)
