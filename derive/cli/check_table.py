"""The table of `derive check`: for each problem the numbers of its steps, by grade, and of its checked claims."""

from __future__ import annotations

from typing import TYPE_CHECKING

from derive.cli.terminal import table

if TYPE_CHECKING:
    from collections.abc import Iterable

    from derive.building.workers import Outcome
    from derive.render.rendered import Rendered

HEADING = (
    "problem", "steps", "proved", "sampled", "approx.", "defined", "claims", "sampled", "compared", "seconds", "verdict"
)  # fmt: skip
LEGEND = """\
steps     a step has the lowest grade among its lines, its test at trial numbers, and its best second route or check
claims    all compared lines, second routes and checks; the next column counts the claims that are only sampled
compared  statements of the source that were compared, and remarks on the source"""
_OF_STEPS = ("steps_proved", "steps_sampled", "steps_approximation", "steps_definition")
_OF_CLAIMS = ("lines", "routes", "checks")


def check_table(outcomes: Iterable[tuple[str, Outcome]]) -> str:
    """Return the table of the checks, with a line for each problem and a legend of the columns."""
    return f"{table([HEADING, *(_row(problem, outcome) for problem, outcome in outcomes)])}\n\n{LEGEND}"


def _row(problem_id: str, outcome: Outcome) -> tuple[str, ...]:
    seconds = f"{outcome.seconds:.1f}"
    if outcome.error:
        codes = dict.fromkeys(c.code for c in getattr(outcome.error, "complaints", ())) or ["internal error"]
        return (problem_id, *("" for _ in HEADING[1:-2]), seconds, f"failed: {', '.join(codes)}")
    rendered: Rendered = outcome.value
    verdict = "ok" if rendered.agreed else "differs from its reference"
    return (problem_id, *map(str, _numbers(rendered)), seconds, verdict)


def _numbers(rendered: Rendered) -> tuple[int, ...]:
    counts = rendered.counts
    claims = sum(counts[name] for name in _OF_CLAIMS)
    return (
        rendered.steps,
        *(counts[name] for name in _OF_STEPS),
        claims,
        counts["claims_sampled"],
        rendered.compared,
    )
