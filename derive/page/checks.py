"""How a problem was checked, counted: what its closing note and the last page of its set tell.

A step counts by the least sure of its lines and by the surest of its second routes. A second route counts for every
result that it was taken to.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive.algebra.equality import LEAST_SURE_FIRST, Compared, Evidence, Grade
from derive.course.names import EvidenceShown
from derive.course.reference.comparison import Remark
from derive.course.reference.errata import Erratum
from derive.page.wording import Inline, Phrases, filled
from derive.steps.step import Step


@dataclass(frozen=True)
class Ways:
    """Second routes in words, and the steps, all of one rule, to whose results they were taken."""

    steps: tuple[str, ...]
    routes: tuple[str, ...]


@dataclass(frozen=True)
class Checks:
    """The counts, the second routes, and what is wrong in the source document."""

    steps: Mapping[Grade, int]
    lines: Mapping[Grade, int]
    routes: Mapping[Grade, int]
    ways: tuple[Ways, ...]
    agree: int
    agree_to_figures: int
    errata: tuple[Erratum, ...]

    @property
    def compared(self) -> int:
        """How many statements of the source document were compared."""
        return self.agree + self.agree_to_figures + len(self.errata)

    def counts(self) -> dict[str, int]:
        """The numbers of the last page's table, by the names of its columns."""
        return {
            **{f"steps_{grade.value}": self.steps.get(grade, 0) for grade in LEAST_SURE_FIRST[1:]},
            "lines": sum(self.lines.values()),
            "routes": sum(self.routes.values()),
            "routes_proved": self.routes.get(Grade.PROVED, 0),
            "agree": self.agree,
            "agree_to_figures": self.agree_to_figures,
            "errata": len(self.errata),
        }

    def closing(self, words: Phrases, evidence: EvidenceShown) -> tuple[Inline, ...]:
        """The note at the end of a problem: that it was checked, and if so much is wanted, how often."""
        if evidence is EvidenceShown.NONE:
            return filled(words.labels["closing_line"], {})
        names: dict[str, Any] = {
            "lines": sum(self.lines.values()),
            "lines_by_grade": _by_grade(self.lines, words.grades),
            "routes": sum(self.routes.values()),
            "routes_by_grade": _by_grade(self.routes, words.grades),
            "steps_by_grade": _by_grade(self.steps, _columns_of_steps(words)),
            "compared": self.compared,
            "agree": self.agree + self.agree_to_figures,
            "errata": len(self.errata),
        }
        return filled(words.labels["closing"], names)


def checks_of(steps: Iterable[Step], words: Phrases, compared: Sequence[Remark]) -> Checks:
    """What was done for these steps, and how the source document compares."""
    steps = list(steps)
    evidence = [(step, e) for step in steps for e in step.evidence]
    lines = [e for _, e in evidence if e.compared is Compared.LINES]
    routes = [(step, e) for step, e in evidence if e.compared is Compared.ROUTE]
    outcomes = [told.outcome for told in compared]
    return Checks(
        steps=Counter(step.grade for step in steps),
        lines=Counter(e.grade for e in lines),
        routes=Counter(e.grade for _, e in routes),
        ways=_ways(routes, words),
        agree=outcomes.count("agrees"),
        agree_to_figures=sum(outcome.startswith("agrees to") for outcome in outcomes),
        errata=tuple(told.erratum for told in compared if told.erratum),
    )


def _ways(routes: Sequence[tuple[Step, Evidence]], words: Phrases) -> tuple[Ways, ...]:
    told: dict[Step, list[str]] = {}
    for step, evidence in routes:
        told.setdefault(step, []).append(words.route(step, evidence.claim))
    alike: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for step, said in told.items():
        alike.setdefault((step.rule, tuple(said)), []).append(step.key)
    return tuple(Ways(tuple(keys), said) for (_, said), keys in alike.items())


def _by_grade(counts: Mapping[Grade, int], words: Mapping[str, str]) -> str:
    return ", ".join(f"{counts[grade]} {words[grade]}" for grade in Grade if counts.get(grade) and grade in words)


def _columns_of_steps(words: Phrases) -> dict[str, str]:
    """The words by which the table of the set's last page counts steps: a definition is only named there."""
    _, columns = next(iter(words.labels["checked_page"]["columns"].items()))
    return dict(zip(("proved", "sampled", "approximation", "definition"), columns, strict=True))
