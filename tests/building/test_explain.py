"""A step of a problem explained, from its file to the terminal."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from derive.building import explain as module
from derive.building.explain import explain
from derive.building.solution import derived
from derive.course.problem import Problem
from derive.errors import Misused
from tests.courses import course_in


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return course_in(tmp_path_factory.mktemp("course"), problem="body")


@pytest.fixture(autouse=True)
def derived_once(monkeypatch: pytest.MonkeyPatch, known: dict[str, Any]) -> None:
    def derived_before(problem: Problem) -> Any:
        return known.setdefault("found", None) or known.update(found=derived(problem)) or known["found"]

    monkeypatch.setattr(module, "derived", derived_before)


@pytest.fixture(scope="module")
def known() -> dict[str, Any]:
    return {}


def test_every_step_has_a_line(course: Path) -> None:
    heading, *rows = explain(course, "hw9/body", None, False)
    assert heading == ("step", "part", "checked", "value")
    assert ("about_x", "a", "proved", "I_1 = 2/5 M R²") in rows
    assert ("first_tensor", "a", "proved", "I⃡") in rows
    assert all("\n" not in row[3] for row in rows)


def test_a_step_is_told_under_headings(course: Path) -> None:
    text = explain(course, "hw9/body", "about_x", False)
    assert isinstance(text, str)
    assert [line.split()[0] for line in text.splitlines()[2:] if line[:1].strip()] == [
        "why",
        "checked",
        "words",
        "shown",
        "law",
    ]
    assert max(map(len, text.splitlines())) <= 100
    assert "Part (a) asks for squared_gyration, which depends on it." in text


def test_the_json_has_the_facts(course: Path) -> None:
    one = explain(course, "hw9/body", "about_x", True)
    every = explain(course, "hw9/body", None, True)
    assert isinstance(one, str)
    assert isinstance(every, str)
    assert json.loads(one) in json.loads(every)


def test_an_unknown_step_is_met_with_the_nearest(course: Path) -> None:
    with pytest.raises(Misused, match="did you mean `about_x`"):
        explain(course, "hw9/body", "abuot_x", False)
