"""The checks of a problem, counted and listed step by step, for the closing note and for the report of the set.

The grade of a step is the lower of two grades. The first is the lowest grade of its lines and of statements that were
only tested at trial numbers. The second is the highest grade of its other evidence, such as second routes and checks.
Routes and checks are counted separately, and so are the motions that the witness (`derive.witness`) simulates
numerically.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.equality import LEAST_SURE_FIRST, Compared, Grade
from derive.course.names import EvidenceShown
from derive.course.reference.comparison import Told
from derive.course.reference.errata import Erratum
from derive.course.reference.quotes import Remark
from derive.page.wording import Inline, Phrases, filled
from derive.steps.step import Step


@dataclass(frozen=True)
class Row:
    """Consecutive steps of one rule with the same grade and the same methods of checking, with their inputs and the
    number of their lines.

    routes   the names of the second routes, and the word for a motion if the witness simulated it numerically
    checks   the names of the checks
    """

    steps: tuple[str, ...]
    made_from: tuple[str, ...]
    rule: str
    grade: Grade
    lines: int
    routes: tuple[str, ...]
    checks: tuple[str, ...]

    def is_like(self, other: Row) -> bool:
        return replace(self, **_NOT_ALIKE) == replace(other, **_NOT_ALIKE)

    def with_more(self, other: Row) -> Row:
        made_from = tuple(dict.fromkeys((*self.made_from, *other.made_from)))
        return replace(self, steps=(*self.steps, *other.steps), made_from=made_from, lines=self.lines + other.lines)


_NOT_ALIKE: Mapping[str, Any] = {
    "steps": (),
    "made_from": (),
    "lines": 0,
}  # steps that share a row may differ in these fields


@dataclass(frozen=True)
class Checks:
    """The numbers of steps, lines, second routes, checks and simulated motions, the table of the steps, and the results
    of the comparison with the source."""

    steps: Mapping[Grade, int]
    lines: Mapping[Grade, int]
    routes: Mapping[Grade, int]
    checks: Mapping[Grade, int]
    rows: tuple[Row, ...]
    agree: int
    agree_to_figures: int
    errata: tuple[Erratum, ...]
    remarks: tuple[Remark, ...] = ()
    source: str = ""
    witnesses: int = 0

    @property
    def compared(self) -> int:
        """Return how many statements of the source document were compared."""
        return self.agree + self.agree_to_figures + self.refuted

    @property
    def refuted(self) -> int:
        """Return how many of the compared statements are wrong; an erratum that is only quoted is not counted."""
        return sum(bool(erratum.answer) for erratum in self.errata)

    def counts(self) -> dict[str, int]:
        """Return the counts for the tables of the report and of `derive check`, each under its name."""
        return {
            **{f"steps_{grade.value}": self.steps.get(grade, 0) for grade in LEAST_SURE_FIRST[1:]},
            "lines": sum(self.lines.values()),
            "routes": sum(self.routes.values()),
            "routes_proved": self.routes.get(Grade.PROVED, 0),
            "checks": sum(self.checks.values()),
            "witnesses": self.witnesses,
            "claims_sampled": sum(counts.get(Grade.SAMPLED, 0) for counts in (self.lines, self.routes, self.checks)),
            "agree": self.agree,
            "agree_to_figures": self.agree_to_figures,
            "errata": len(self.errata),
            "remarks": len(self.remarks),
        }

    def closing(self, words: Phrases, evidence: EvidenceShown) -> tuple[Inline, ...]:
        """Return the closing note, which counts the evidence, if `evidence` requests it."""
        if evidence is EvidenceShown.NONE:
            return ()
        names: dict[str, Any] = {
            "lines": sum(self.lines.values()),
            "lines_by_grade": _by_grade(self.lines, words.grades),
            "routes": sum(self.routes.values()),
            "routes_by_grade": _by_grade(self.routes, words.grades),
            "checks": sum(self.checks.values()),
            "witnesses": self.witnesses,
            "steps_by_grade": _by_grade(self.steps, _columns_of_steps(words)),
            "compared": self.compared,
            "agree": self.agree + self.agree_to_figures,
            "errata": self.refuted,
        }
        return filled(words.labels["closing"], names)


def checks_of(steps: Iterable[Step], words: Phrases, compared: Sequence[Told]) -> Checks:
    """Count the evidence of these steps and the outcomes of the comparison with the source document."""
    steps = list(steps)
    evidence = [(step, e) for step in steps for e in step.evidence]
    lines = [e for _, e in evidence if e.compared is Compared.LINES]
    routes = [e for _, e in evidence if e.compared is Compared.ROUTE]
    checks = [e for _, e in evidence if e.compared is Compared.CHECK]
    outcomes = [told.outcome for told in compared]
    return Checks(
        steps=Counter(step.grade for step in steps),
        lines=Counter(e.grade for e in lines),
        routes=Counter(e.grade for e in routes),
        checks=Counter(e.grade for e in checks),
        witnesses=sum(e.compared is Compared.WITNESS for _, e in evidence),
        rows=_rows(steps, words),
        agree=outcomes.count("agrees"),
        agree_to_figures=sum(outcome.startswith("agrees to") for outcome in outcomes),
        errata=tuple(told.erratum for told in compared if told.erratum),
        remarks=tuple(told.remark for told in compared if told.remark),
        source=next((str(name) for told in compared if (name := told.facts.get("document"))), ""),
    )


def second_ways_of(step: Step, sort: Compared, words: Phrases) -> tuple[str, ...]:
    """Return the words for the checks of a step or for its second routes, as `sort` requires. The words for the routes
    also mention a motion that the witness simulated."""
    found = tuple(said for e in step.evidence if e.compared is sort and (said := words.route(step, e.claim)))
    followed = sort is Compared.ROUTE and any(e.compared is Compared.WITNESS for e in step.evidence)
    return (*found, words.labels["motion"]) if followed else found


def _rows(steps: Sequence[Step], words: Phrases) -> tuple[Row, ...]:
    rows: list[Row] = []
    for step in steps:
        lines = sum(e.compared is Compared.LINES for e in step.evidence)
        routes, checks = (second_ways_of(step, sort, words) for sort in (Compared.ROUTE, Compared.CHECK))
        row = Row((step.key,), step.inputs, step.rule, step.grade, lines, routes, checks)
        if rows and rows[-1].is_like(row):
            rows[-1] = rows[-1].with_more(row)
        else:
            rows.append(row)
    return tuple(rows)


def _by_grade(counts: Mapping[Grade, int], words: Mapping[str, str]) -> str:
    return ", ".join(f"{counts[grade]} {words[grade]}" for grade in Grade if counts.get(grade) and grade in words)


def _columns_of_steps(words: Phrases) -> dict[str, str]:
    """Return, for each grade, the word after the number of its steps, as in "12 proved"."""
    return {**words.grades, Grade.DEFINITION: words.labels["named"]}
