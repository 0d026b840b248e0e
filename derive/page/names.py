"""The names that prose may mention on a page."""

from __future__ import annotations

from typing import Any

from derive.algebra.expressions import Prescribed
from derive.course.problem import Problem
from derive.page.wording import AXIS_NAMES, Math, Phrases, given_words, name_of
from derive.steps.derivation import Derivation


def page_names(problem: Problem, derivation: Derivation, words: Phrases) -> dict[str, Any]:
    """Return each name with its text. If an entry of `given:` and a step have the same name, the name denotes the
    entry. A step has precedence over a value that prose mentions by its path."""
    described = problem.described.letters if problem.described else {}
    names: dict[str, Any] = {**AXIS_NAMES, **{name: (Math(known.symbol),) for name, known in described.items()}}
    coordinates = (q for step in derivation.steps for q, _ in step.coordinates)
    names.update({q.name: (Math(q),) for q in (*coordinates, *_functions(derivation))})
    names.update({step.key: name_of(step) for step in derivation.steps})
    for given in problem.in_prose:
        names.setdefault(given.name, given_words(given, problem.measured, words))
    for given in problem.givens:
        names[given.name] = given_words(given, problem.measured, words)
    return names


def _functions(derivation: Derivation) -> list[Prescribed]:
    """Return the prescribed functions of time in the steps."""
    letters = {s for step in derivation.steps for form in step.chain for s in form.expr.free_symbols}
    return sorted({s.function for s in letters if isinstance(s, Prescribed)}, key=str)
