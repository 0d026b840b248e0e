"""The report of the draws of variants: bars, histograms and data."""

from __future__ import annotations

import json
from pathlib import Path

from derive.building.variant_check import OfAnswer, OfProblem
from derive.cli.variant_report import as_html, as_json, as_text, bars, counts

DRAWN = OfProblem("hw/bead", (), draws=4, structures=1)
DRAWN.answers["x<b"] = OfAnswer("x<b", "rad/s", [1.0, 1.0, 3.0, 5.0])
DRAWN.equal["x<b"] = 1
DRAWN.degenerate["`x` is not real"] = ["b = 2 m"]


def test_the_bars_show_the_distribution() -> None:
    assert bars([1, 1, 1]) == "█"
    row = bars([0] * 8 + [1])
    assert (len(row), row[0], row[-1], row[1:-1].strip()) == (24, "█", "▁", "")


def test_equal_values_are_in_one_interval() -> None:
    assert sorted(counts([2.0, 2.0]))[-2:] == [0, 2]


def test_each_form_has_the_values_and_the_degenerate_draws(tmp_path: Path) -> None:
    text, (data,), page = as_text(DRAWN), json.loads(as_json([DRAWN])), as_html(tmp_path, "hw", [DRAWN])
    assert (data["answers"]["x<b"]["median"], sum(data["answers"]["x<b"]["counts"])) == (1.0, 4)
    assert page.count("<rect") == 3
    assert "x&lt;b" in page
    assert "x<b" not in page
    for told in (text, page):
        assert "degenerate draws: 1; `x` is not real, for example for b = 2 m" in told
