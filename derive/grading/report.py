"""The verdicts as text and as JSON."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from derive.grading.grading import Graded
from derive.grading.outcomes import Verdict

NOT_GRADED = "not graded"


def points(value: Fraction) -> str:
    """Return points with at most two decimals: `3`, `2.5`, `0.33`."""
    return f"{float(value):.2f}".rstrip("0").rstrip(".")


def one_as_text(problem: str, graded: Graded) -> str:
    """Return how one answer was read, the verdict on it with its reason, and the credit, as text."""
    verdict = graded.verdict
    lines = [f"read as {verdict.reading}"] if verdict.reading else []
    lines.append(f"{problem} ({graded.part}): {verdict.outcome}")
    if verdict.because:
        lines.append(f"  {verdict.because}")
    lines += [f"  {line}" for line in verdict.marked.splitlines()]
    lines.append(f"  credit: {points(graded.points)} of {points(graded.most)}")
    return "\n".join(lines)


def explained(verdict: Verdict) -> str:
    """Return the reason for a verdict in one line, with the text at the place that cannot be read."""
    if not verdict.marked:
        return verdict.because
    text, caret = verdict.marked.split("\n")
    return f"{verdict.because}, at `{text[len(caret) - len(caret.lstrip()) :][:24]}`"


def as_data(graded: Graded) -> dict[str, Any]:
    """Return a verdict as JSON data; `answers` has the verdict on each answer that the part asks for."""
    verdict = graded.verdict
    return {
        "part": graded.part,
        "answer": graded.answer,
        "reading": verdict.reading,
        "verdict": verdict.outcome.value,
        "explanation": verdict.because,
        "marked": verdict.marked,
        "credit": float(points(graded.points)),
        "of": float(points(graded.most)),
        "answers": [
            {"answer": each.target, "verdict": each.outcome.value, "explanation": each.because} for each in graded.each
        ],
    }


def counted(verdicts: Iterable[str]) -> str:
    """Return how many answers got each verdict, the most frequent first: `3 equal, 1 sign`."""
    return ", ".join(f"{n} {name}" for name, n in Counter(verdicts).most_common())
