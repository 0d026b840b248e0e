"""`observations:` of a problem or a part: the observations that a page prints after its answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from derive.course.problem import Problem, deriving
from derive.course.yaml_tree import Word
from derive.errors import Faults, did_you_mean
from derive.mechanics.observations.selection import NAMES, best, of_kinds
from derive.mechanics.observations.view import View
from derive.steps.derivation import with_ancestors
from derive.steps.record import Run
from derive.steps.step import Quantity

NONE = "none"


def with_known_observations(problem: Problem, faults: Faults) -> Problem:
    """Return the problem without unknown names under `observations`; report each of these names as an error."""
    parts = tuple(replace(part, observations=_known(part.observations, faults)) for part in problem.parts)
    return replace(problem, observations=_known(problem.observations, faults), parts=parts)


def _known(words: Sequence[Word] | None, faults: Faults) -> tuple[Word, ...] | None:
    if words is None or list(words) == [NONE]:
        return words if words is None else tuple(words)
    for word in (word for word in words if word not in NAMES):
        help_line = did_you_mean(word, NAMES) or f"the observations are {', '.join(NAMES)}, or {NONE} alone"
        faults.error("unknown-observation", f"`{word}` is not an observation", word.place, help=help_line)
    return tuple(word for word in words if word in NAMES)


def observations_of(
    problem: Problem, known: Mapping[str, Quantity], asked: Sequence[Sequence[str]], run: Run, faults: Faults
) -> list[list[Quantity]]:
    """Return the observations of each part; report each chosen kind without an observation.

    For the problem or for a part, an author may choose kinds of observations, or `none`.
    """
    problem = with_known_observations(problem, faults)
    chosen, everywhere = [_names(part.observations) for part in problem.parts], _names(problem.observations)
    views = _views(problem, known, asked)
    general = [quantity for quantity, case_of in zip(run.established, run.cases, strict=True) if case_of is None]
    with deriving(problem, replace(run, established=general, cases=[None] * len(general), memory=None)):
        if not everywhere and not any(chosen):
            found = best(views) if everywhere is None else [[] for _ in views]
            return [[] if names == [] else own for names, own in zip(chosen, found, strict=True)]
        named = [everywhere if names is None else names for names in chosen]
        of_parts = [of_kinds(view, names or ()) for view, names in zip(views, named, strict=True)]
        _check_found(everywhere or (), of_parts, faults)
        for names, own in zip(chosen, of_parts, strict=True):
            _check_found(names or (), [own], faults)
    return [[quantity for kind in own.values() for quantity in kind] for own in of_parts]


def _names(words: Sequence[Word] | None) -> list[Word] | None:
    """Return the chosen kinds: None for the default, an empty list for `none`."""
    return None if words is None else [word for word in words if word != NONE]


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
