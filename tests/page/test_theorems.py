"""Theorems stand once on a page, before the first step that uses them, and not on a brief one."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from derive.mechanics.theorems import THEOREMS
from derive.page.theorems import Theorems
from derive.page.wording import Math, ToldIn, ToldOnce, phrases
from derive.steps.step import Level
from tests.courses import ROOT

WORDS = phrases(ROOT / "templates")


def a_step(rule: str, outcome: str = "generic") -> Any:
    return SimpleNamespace(rule=rule, outcome=outcome)


@pytest.mark.parametrize("level", [Level.STANDARD, Level.FULL])
def test_a_theorem_is_told_once(level: Level) -> None:
    theorems = Theorems(WORDS, level)
    ((told,),) = theorems.before(a_step("rotation.torque"))
    assert isinstance(told, ToldOnce) and any(isinstance(node, Math) for node in told.nodes)
    assert any(isinstance(node, ToldIn) for node in told.again)
    assert theorems.before(a_step("free_rotation.rate_in_space")) == [], "it has been told"
    assert len(theorems.before(a_step("inertia.entry_moved", "moment"))) == 1
    assert theorems.before(a_step("forced.equation_of_motion", "applied")) == []
    assert len(theorems.before(a_step("forced.equation_of_motion", "both"))) == 1


def test_a_brief_page_has_only_their_names() -> None:
    assert Theorems(WORDS, Level.BRIEF).before(a_step("rotation.torque")) == []


def test_each_theorem_has_its_sentence_and_each_sentence_its_theorem() -> None:
    assert {theorem.name for theorem in THEOREMS} == set(WORDS.theorems) == set(WORDS.theorems_again)
    for theorem in THEOREMS:
        assert "<<formula>>" in WORDS.theorems[theorem.name]
        assert set(theorem.used_by) <= set(WORDS.rules)
