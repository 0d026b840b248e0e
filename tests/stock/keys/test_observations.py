"""`observations:` of a problem and of a part."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.mechanics.observations.selection import NAMES
from tests.courses import ROOT

PROBLEM = """
title: A rod that swings
solve: system
symbols: {l: length, M: mass, g: acceleration}
given:
  coordinates: {theta: angle}
  bodies:
    rod: {shape: rod, length: l, mass: M, from: [0, 0], along: [sin(theta), -cos(theta)]}
  gravity: g
statement: A uniform rod of mass <<M>> and length <<l>> hangs from one end and swings in a plane.
"""
PARTS = """
parts:
  - {ask: Find the frequency of small oscillations., answer: frequency}
  - {ask: Find the period., answer: period}
"""
SAID = "A simple pendulum of length"


def page(folder: Path, text: str, detail: str = "standard") -> str:
    (folder / "problems" / "hw").mkdir(parents=True)
    (folder / "problems" / "hw" / "rod.yaml").write_text(PROBLEM + text, encoding="utf-8")
    (folder / "templates").symlink_to(ROOT / "templates")
    return " ".join(rendered(folder, "hw/rod", detail, only={"text"}).texts["text"].split())


def test_an_observation_follows_the_first_answer_that_it_is_about(tmp_path: Path) -> None:
    text = page(tmp_path, PARTS)
    assert text.count(SAID) == 1
    assert text.index(SAID) < text.index("(b) Find the period")


def test_a_brief_page_has_no_observation(tmp_path: Path) -> None:
    assert SAID not in page(tmp_path, PARTS, "brief")


@pytest.mark.parametrize("parts", ["observations: none\n" + PARTS, PARTS.replace("cy}", "cy, observations: none}")])
def test_none_turns_observations_off(parts: str, tmp_path: Path) -> None:
    assert SAID not in page(tmp_path, parts)


@pytest.mark.parametrize("elsewhere", ["", "observations: none\n"])
def test_a_part_may_choose_its_observations(elsewhere: str, tmp_path: Path) -> None:
    text = page(tmp_path, elsewhere + PARTS.replace("period}", "period, observations: [pendulum]}"))
    assert text.count(SAID) == 1
    assert text.index(SAID) > text.index("(b) Find the period")


def test_a_problem_may_choose_kinds_for_all_parts(tmp_path: Path) -> None:
    assert page(tmp_path, "observations: [pendulum]\n" + PARTS).count(SAID) == 2


def test_the_manual_lists_every_kind() -> None:
    manual = (ROOT / "docs" / "problems.md").read_text(encoding="utf-8")
    assert [name for name in NAMES if f"| `{name}` |" not in manual] == []
