"""Definitions of a problem that no result uses."""

from __future__ import annotations

from derive.course.problem import Problem
from derive.errors import Complaint
from derive.steps.derivation import Derivation


def unused_definitions(problem: Problem, derivation: Derivation) -> list[Complaint]:
    """Return a warning for each quantity under `define:` that no result on the page contains."""
    return [
        Complaint(
            "unused-definition",
            f"no result is shorter with `{each.name}`, so the page does not define it",
            problem.place_of("define", each.name),
            help="leave it out, or define a quantity with other letters",
            severity="warning",
        )
        for each in problem.defined
        if each.name not in derivation.keys
    ]
