"""Finds entries of a problem's file that have no effect: letters, coordinates, results and keys that nothing uses."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from collections.abc import Mapping as Table

from derive.algebra.expressions import TIME
from derive.course.given import Given, Measured
from derive.course.placement import HIDDEN
from derive.course.problem_file import DrawingKeys, ProblemKeys, SortOfLetter
from derive.course.prose import Prose
from derive.course.stock import Described
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, Word
from derive.errors import Complaint

GRAVITY, ACCELERATION = "gravity", "acceleration"
# Keys under `given`. A coordinate that only these keys mention counts as unused.
OF_STATES = ("at", "results", "conserved", "coordinates", "functions")
NOUNS = {"coordinates": "coordinate", "functions": "function"}  # key under `given` -> what an entry is called
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*", re.ASCII)
_RATES = ("", "_dot", "_ddot")


def unused_in(
    written: ProblemKeys,
    asked: Collection[Word],
    givens: Collection[Given],
    measured: Collection[Measured],
    described: Described | None,
) -> tuple[Complaint, ...]:
    """Return warnings about entries that have no effect."""
    behind = {each.symbol.name for each in measured} - {*written.values}  # the letters that replace numbers
    exact = {given.kind.each for given in givens if given.written is not None}  # the kinds of exact numbers
    found = [*_letters(written, behind, exact)]
    found += [*_drawings(written), *_points(written)]
    if described is not None:
        needed = needed_for(asked, described.made)
        found += [
            *_coordinates(written.given),
            *_axes(written.given),
            *_results(described.made, needed),
            *_keys(described, needed),
        ]
    return tuple(found)


def needed_for(asked: Collection[str], made: Table[Word, Collection[Word]]) -> set[str]:
    """Return the names that are asked for, and the names of the results and answers from which they are computed."""
    found, waiting = set[str](), [str(name) for name in asked]
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        found.add(name)
        for result, uses in made.items():
            if name == result or name.startswith(f"{result}_"):
                waiting += [str(result), *map(str, uses)]
    return found


def _letters(written: ProblemKeys, behind: Collection[str], exact: Collection[str]) -> Iterator[Complaint]:
    """Warn of declared letters that nothing uses. There is no warning for a letter whose kind is in `exact`, because an
    exact number such as 45 deg may be in its place."""
    compared = {name for limit in written.limits for node in _of_limit(limit) for name in _NAME.findall(node)}
    drawn = {name for each in written.drawings.values() for name in _drawn(each)}
    used = {*_names(written.given), *_names(written.reference), *compared, *drawn, *behind, TIME.name}
    used |= {name for prose in _texts(written) for formula in prose.formulas for name in formula.names}
    for name, sort in written.symbols.items():
        if name in used or sort in exact:
            continue
        message = f"`{name}` is declared, but nothing under `given` uses it"
        instead = f"write `gravity: {name}` under `given`, or " if _lacks_gravity(written.given, sort) else ""
        yield Complaint("unused-letter", message, name.place, help=f"{instead}leave it out", severity="warning")


def _drawn(drawing: DrawingKeys) -> Iterator[str]:
    yield from drawing.values
    for mark in drawing.marks:
        for node in (mark.at, mark.start, mark.end, mark.along):
            yield from _names(node)
        yield from _NAME.findall(mark.label or "")
    ends = [end for both in drawing.over.values() for end in both]
    alone = (drawing.against or "", drawing.then or "")
    for formula in (
        *(drawing.plot or ()),
        *alone,
        *drawing.per,
        *drawing.energies,
        *drawing.levels,
        *(drawing.ends or ()),
        *ends,
    ):
        yield from _NAME.findall(formula)


def _texts(written: ProblemKeys) -> Iterator[Prose]:
    yield from (part.ask for part in written.parts)
    yield from (prose for prose in (written.statement, written.strategy, written.note) if prose)
    yield from (limit.why for limit in written.limits if limit.why)
    yield from (prose for outcomes in written.wording.values() for prose in outcomes.values())


def _lacks_gravity(given: Mapping | None, sort: SortOfLetter) -> bool:
    """Return whether a letter may be the acceleration of free fall of a system that is described without gravity."""
    is_system = given is not None and given.get("coordinates") is not None and given.get("lagrangian") is None
    return is_system and sort == ACCELERATION and given is not None and given.get(GRAVITY) is None


def _drawings(written: ProblemKeys) -> Iterator[Complaint]:
    for name, each in written.drawings.items():
        hidden = isinstance(each.at, Scalar) and each.at.text == HIDDEN
        for key in (key for key in ("caption", "width") if hidden and key in each.values_at):
            message = f"`{key}` has no effect on `{name}`, which is hidden"
            yield Complaint("unused-key", message, each.places[key], help="leave it out", severity="warning")


def _points(written: ProblemKeys) -> Iterator[Complaint]:
    for part in written.parts:
        if part.points == 0:
            message, help_line = "this part carries no points", "leave `points` out"
            yield Complaint("points", message, part.places["points"], help=help_line, severity="warning")


def _of_limit(limit: object) -> Iterator[str]:
    for value in vars(limit).values():
        if isinstance(value, str):
            yield value
    where = getattr(limit, "where", {})
    yield from (str(text) for pair in where.items() for text in pair)


def _coordinates(given: Mapping | None) -> Iterator[Complaint]:
    """Warn of coordinates and prescribed functions on which no place, body, force or energy depends."""
    if given is None:
        return
    used = {name for key, value in given.pairs if key.text not in OF_STATES for name in _names(value)}
    for key, noun in NOUNS.items():
        moving = given.get(key)
        for q, _ in moving.pairs if isinstance(moving, Mapping) else ():
            if not used & {f"{q.text}{rate}" for rate in _RATES}:
                message = f"no place, body, force or energy depends on the {noun} `{q.text}`"
                yield Complaint("unused-letter", message, q.place, help="leave it out", severity="warning")


def _axes(given: Mapping | None) -> Iterator[Complaint]:
    axes = given.get("axes") if given is not None else None
    if given is None or not isinstance(axes, Mapping):
        return
    used = {name for key, value in given.pairs if key.text != "axes" for name in _names(value)}
    for name, _ in axes.pairs:
        if name.text not in used:
            message = f"no other key under `given` uses the axes `{name.text}`"
            yield Complaint("unused-key", message, name.place, help="leave them out", severity="warning")


def _results(made: Table[Word, Collection[Word]], needed: Collection[str]) -> Iterator[Complaint]:
    for name in made:
        if name not in needed:
            message = f"no part asks for the result `{name}`, directly or through another result"
            help_line = "let a part ask for it, or leave it out"
            yield Complaint("unused-result", message, name.place, help=help_line, severity="warning")


def _keys(described: Described, needed: Collection[str]) -> Iterator[Complaint]:
    for key, indifferent in described.without:
        if {*needed} - {*described.made} <= {*indifferent}:
            message = f"nothing that is asked for depends on `{key}`"
            yield Complaint("unused-key", message, key.place, help="leave it out", severity="warning")


def _names(node: Tree | None) -> Iterator[str]:
    if isinstance(node, Scalar):
        yield from _NAME.findall(node.text)
    elif isinstance(node, Sequence):
        for item in node.items:
            yield from _names(item)
    elif isinstance(node, Mapping):
        for _, value in node.pairs:
            yield from _names(value)
