"""Answers as students type them get the verdict that a fair grader gives; see answers.txt."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from derive.building.solution import answer_key
from derive.grading.grading import Graded, grade
from derive.grading.key import Key
from tests.courses import ROOT

ANSWERS = Path(__file__).with_name("answers.txt")


@cache
def key(problem: str) -> Key:
    return answer_key(ROOT, problem)


def graded(problem: str, part: str, answer: str) -> Graded:
    found = key(problem).part(part)
    assert found is not None
    return grade(answer, found, key(problem))


def pairs() -> dict[tuple[str, str], list[tuple[str, str]]]:
    found: dict[tuple[str, str], list[tuple[str, str]]] = {}
    answers: list[tuple[str, str]] = []
    for line in ANSWERS.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            problem, _, part = line.strip("[]").partition(" ")
            answers = found.setdefault((problem, part), [])
        elif " :: " in line and not line.startswith("#"):
            verdict, _, answer = line.partition(" :: ")
            answers.append((verdict, answer))
    return found


PAIRS = pairs()


def test_there_are_many_answers_to_many_problems() -> None:
    assert sum(map(len, PAIRS.values())) >= 150
    assert len({problem for problem, _ in PAIRS}) >= 15


@pytest.mark.parametrize(("problem", "part"), PAIRS)
def test_a_fair_grader_gives_these_verdicts(problem: str, part: str) -> None:
    wrong = [
        (answer, f"{found.verdict.outcome} instead of {verdict}", found.verdict.because)
        for verdict, answer in PAIRS[problem, part]
        if (found := graded(problem, part, answer)).verdict.outcome.value != verdict
    ]
    assert wrong == []
