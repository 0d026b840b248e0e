"""The report of `derive variants` as text, as JSON and as a page with histograms."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from statistics import median_low
from typing import TYPE_CHECKING, Any

from derive.cli.terminal import table

if TYPE_CHECKING:
    from derive.building.variant_check import OfProblem

BARS = " ▁▂▃▄▅▆▇█"
WIDTH = 24  # number of bars of a distribution


def as_text(found: OfProblem) -> str:
    lines = [f"{found.id}: {found.possible} different variants"]
    lines += [f"  {name}: {', '.join(shown)}" for name, shown in _choices(found)]
    if not found.draws:
        return "\n".join(lines)
    lines += [f"  {each}" for each in _of_draws(found)]
    rows = [("answer", "least", "median", "greatest", "unit", "same value", "distribution")]
    for key, answer in found.answers.items():
        least, median, greatest = (f"{value:.4g}" for value in _summary(answer.values))
        rows.append((key, least, median, greatest, answer.unit, str(found.equal[key]), bars(answer.values)))
    if found.answers:
        lines.append(table(rows))
        lines.append("same value: pairs of different variants whose values are equal to nine figures")
    return "\n".join([*lines, *(f"  {each}" for each in _to_look_at(found))])


def as_json(report: Sequence[OfProblem]) -> str:
    return json.dumps([_data(found) for found in report], indent=2, ensure_ascii=False)


def as_html(root: Path, asked: str, report: Sequence[OfProblem]) -> str:
    from derive.page.template import templates_of
    from derive.render.printing.templates import filled_html

    problems = [
        {
            "id": found.id,
            "possible": found.possible,
            "choices": _choices(found),
            "notes": [*_of_draws(found), *_to_look_at(found)],
            "answers": [
                {
                    "key": key,
                    "unit": answer.unit,
                    "same": found.equal[key],
                    "summary": [f"{value:.4g}" for value in _summary(answer.values)],
                    "counts": counts(answer.values),
                }
                for key, answer in found.answers.items()
            ],
        }
        for found in report
    ]
    return filled_html(templates_of(root), "variants.html.j2", {"asked": asked, "problems": problems}).strip()


def _data(found: OfProblem) -> dict[str, Any]:
    return {
        "problem": found.id,
        "possible": found.possible,
        "draws": found.draws,
        "derivations": found.structures,
        "derived_in_full": found.compared,
        "same_variant": found.same,
        "answers": {
            key: {
                "unit": answer.unit,
                **dict(zip(("least", "median", "greatest"), _summary(answer.values), strict=True)),
                "same_value": found.equal[key],
                "counts": counts(answer.values),
            }
            for key, answer in found.answers.items()
        },
        "outcomes": {key: dict(counted) for key, counted in found.outcomes.items()},
        "degenerate": found.degenerate,
    }


def _choices(found: OfProblem) -> list[tuple[str, list[str]]]:
    """Return the choices of each varied value; of eight or more choices, only the first three and the last."""
    told = [(str(each.name), [each.told(number) for number in range(len(each.choices))]) for each in found.variations]
    return [(name, shown if len(shown) < 8 else [*shown[:3], "...", shown[-1]]) for name, shown in told]


def _of_draws(found: OfProblem) -> list[str]:
    derivations = f"{found.structures} different derivation{'' if found.structures == 1 else 's'}"
    return [
        f"{found.draws} draws, {derivations}; {found.compared} of the draws derived in full",
        f"pairs of students with the same variant: {found.same}",
    ]


def _to_look_at(found: OfProblem) -> list[str]:
    lines = []
    for key, outcomes in found.outcomes.items():
        if len(outcomes) > 1:
            counted = ", ".join(f"{outcome} in {number} draws" for outcome, number in outcomes.items())
            lines.append(f"`{key}` has different outcomes: {counted}")
    for why, draws in found.degenerate.items():
        lines.append(f"degenerate draws: {len(draws)}; {why}, for example for {draws[0]}")
    return lines


def _summary(values: Sequence[float]) -> tuple[float, float, float]:
    return min(values), median_low(values), max(values)


def counts(values: Sequence[float]) -> list[int]:
    """Return the number of values in each of `WIDTH` intervals of equal length between the least and the greatest."""
    least, greatest = min(values), max(values)
    found = [0] * WIDTH
    for value in values:
        share = (value - least) / (greatest - least) if greatest > least else 0.5
        found[min(WIDTH - 1, int(share * WIDTH))] += 1
    return found


def bars(values: Sequence[float]) -> str:
    """Return the distribution of values as a row of bars; a single bar if all values are equal."""
    if min(values) == max(values):
        return BARS[-1]
    found = counts(values)
    return "".join(BARS[-(-count * (len(BARS) - 1) // max(found))] for count in found)
