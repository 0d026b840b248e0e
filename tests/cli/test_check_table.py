"""What the table of `derive check` counts: steps by their grade, and apart from them the claims that were checked."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from derive.cli.check_table import HEADING, LEGEND, check_table
from derive.errors import Complaint, Rejected

COUNTS = {
    **{"steps_proved": 20, "steps_sampled": 1, "steps_approximation": 2, "steps_definition": 3},
    **{"lines": 30, "routes": 8, "checks": 5, "claims_sampled": 4},
}


def outcome(error: Any = None, agreed: bool = True) -> Any:
    value = SimpleNamespace(counts=COUNTS, steps=26, compared=7, agreed=agreed)
    return SimpleNamespace(seconds=1.26, error=error, value=value)


def rows(*outcomes: tuple[str, Any]) -> list[list[str]]:
    table, _, legend = check_table(outcomes).partition("\n\n")
    assert legend == LEGEND
    return [line.split() for line in table.splitlines()]


def test_steps_and_claims_are_counted_apart() -> None:
    heading, row = rows(("hw9/top", outcome()))
    assert heading == list(HEADING)
    assert row == ["hw9/top", "26", "20", "1", "2", "3", "43", "4", "7", "1.3", "ok"]


def test_a_problem_that_failed_or_differs_says_so() -> None:
    refused = Rejected(Complaint("wrong-kind", "no mass"))
    _, failed, differs = rows(("hw9/a", outcome(refused)), ("hw9/b", outcome(agreed=False)))
    assert failed == ["hw9/a", "1.3", "failed:", "wrong-kind"]
    assert differs[-4:] == ["differs", "from", "its", "reference"]


def test_what_the_columns_count_is_said_below() -> None:
    assert {line.split()[0] for line in LEGEND.splitlines()} <= set(HEADING)
