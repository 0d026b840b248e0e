"""Definitions that no result uses, and laws that a strategy names but the page does not use."""

from __future__ import annotations

from derive.course.problem import Problem
from derive.errors import Complaint
from derive.page.wording import Phrases
from derive.steps.derivation import Derivation


def unused_definitions(problem: Problem, derivation: Derivation) -> list[Complaint]:
    """Return a warning for each quantity under `define:` that no result on the page contains."""
    return [
        Complaint(
            "unused-definition",
            f"no result is shorter with `{each.name}`, so the page does not define it",
            problem.place_of("define", each.name),
            help="remove it, or define another combination of symbols, one that occurs in a result",
            severity="warning",
        )
        for each in problem.defined
        if each.name not in derivation.keys
    ]


def laws_without_steps(problem: Problem, derivation: Derivation, words: Phrases) -> list[Complaint]:
    """Return a warning for each law that the strategy names, if no step on the page applies this law."""
    if problem.strategy is None:
        return []
    text, used = " ".join(problem.strategy.text.split()), {step.rule for step in derivation.steps}
    return [
        Complaint(
            "strategy",
            f"the strategy names {name}, but no step on this page uses it",
            problem.place_of("strategy"),
            help="name the law with which the page derives the answers",
            severity="warning",
        )
        for name, rules in words.laws.items()
        if name in text and not any(rule.startswith(start) for rule in used for start in rules.split())
    ]
