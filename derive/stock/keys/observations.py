"""`observations:` of a problem or a part: the observations that a page prints after its answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from derive.course.problem import Problem, deriving
from derive.course.yaml_tree import Word
from derive.errors import Faults, did_you_mean
from derive.mechanics.observations.chosen import NAMES, best, of_kinds
from derive.mechanics.observations.view import View
from derive.steps.derivation import with_ancestors
from derive.steps.record import Run
from derive.steps.step import Quantity

NONE = "none"


def observations_of(
    problem: Problem, known: Mapping[str, Quantity], asked: Sequence[Sequence[str]], run: Run
) -> list[list[Quantity]]:
    """Return the observations of each part.

    By default these are the most valuable ones. An author may choose kinds for the problem or for a part, or `none`.
    """
    faults = Faults()
    chosen = [_names(part.observations, faults) for part in problem.parts]
    everywhere = _names(problem.observations, faults)
    faults.stop()
    views = _views(problem, known, asked)
    general = [quantity for quantity, case_of in zip(run.established, run.cases, strict=True) if case_of is None]
    with faults, deriving(problem, replace(run, established=general, cases=[None] * len(general), memory=None)):
        if everywhere == [] or everywhere is None and not any(chosen):
            found = best(views) if everywhere is None else [[] for _ in views]
            return [[] if names == [] else own for names, own in zip(chosen, found, strict=True)]
        named = [everywhere if names is None else names for names in chosen]
        of_parts = [of_kinds(view, names or ()) for view, names in zip(views, named, strict=True)]
        _check_found(everywhere or (), of_parts, faults)
        for names, own in zip(chosen, of_parts, strict=True):
            _check_found(names or (), [own], faults)
    faults.stop()
    return [[quantity for kind in own.values() for quantity in kind] for own in of_parts]


def _names(words: Sequence[Word] | None, faults: Faults) -> list[Word] | None:
    """Return the chosen kinds: None for the default, an empty list for `none`."""
    if words is None:
        return None
    if list(words) == [NONE]:
        return []
    for word in words:
        if word not in NAMES:
            help_line = did_you_mean(word, NAMES) or f"the observations are {', '.join(NAMES)}, or {NONE} alone"
            faults.error("unknown-observation", f"`{word}` is not an observation", word.place, help=help_line)
    return list(words)


def _check_found(names: Sequence[Word], parts: Sequence[Mapping[str, Sequence[Quantity]]], faults: Faults) -> None:
    for name in names:
        if not any(own.get(name) for own in parts):
            message = f"no answer here has the observation `{name}`"
            faults.error("no-such-observation", message, name.place, help="leave it out")


def _views(problem: Problem, known: Mapping[str, Quantity], asked: Sequence[Sequence[str]]) -> list[View]:
    letters = {declared.symbol: declared.kind for declared in problem.symbols.values()}
    page = tuple(with_ancestors(known[key] for keys in asked for key in keys).values())
    views = []
    shown: dict[str, Quantity] = {}
    for keys in asked:
        answers = tuple(known[key] for key in keys)
        shown |= with_ancestors(answers)
        views.append(View(answers, tuple(shown.values()), page, letters))
    return views
