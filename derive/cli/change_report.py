"""The text of the changes that `derive diff` prints."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from itertools import groupby
from typing import Any

from derive.building.changes import ADDED, CHANGED, EQUAL, REMOVED, Change
from derive.building.diff import Diff
from derive.building.set_diff import SetDiff
from derive.cli.terminal import WIDTH
from derive.render.notation.text import columns

# for each sort of change: its heading, and its name in the singular and the plural
_SORTS = {
    "given": ("given", "given value", "given values"),
    "problem": ("problems", "problem", "problems"),
    "points": ("points", "number of points", "numbers of points"),
    "part": ("parts", "part", "parts"),
    "asked": ("asked for", "question's answers", "questions' answers"),
    "answer": ("answers", "answer", "answers"),
    "step": ("steps", "step", "steps"),
    "order": ("order", "other order", "other orders"),
    "sentence": ("sentences", "sentence", "sentences"),
    "drawing": ("drawings", "drawing", "drawings"),
    "number": ("numbers of equations", "number of an equation", "numbers of equations"),
    "reference": ("reference", "comparison with the source", "comparisons with the source"),
    "warning": ("warnings", "warning", "warnings"),
}
_FACETS = {
    "name": "name",
    "result": "result",
    "lines": "lines before the result",
    "rule": "made by",
    "outcome": "outcome",
    "inputs": "depends on",
    "evidence": "evidence",
}
_SIGNS = {ADDED: "+", REMOVED: "-", CHANGED: "~"}
_COLOURS = {ADDED: "32", REMOVED: "31"}
_AROUND = 6  # words of a sentence that are shown on each side of a change
_MOST_LINES = 3  # a list of lines is cut to this number if it is longer by at least two


def told(problem_id: str, diff: Diff, coloured: bool) -> str:
    """Return the number of changes of each sort, then all changes under the headings of their sorts."""
    found = diff.changes
    if not found:
        return f"{problem_id}: nothing has changed since {diff.since}"
    shown = _Shown(coloured)
    sorts = [(sort, list(group)) for sort, group in groupby(found, key=lambda change: change.of)]
    counts = [f"{len(group)} {_SORTS[sort][1 if len(group) == 1 else 2]}" for sort, group in sorts]
    head = textwrap.fill(f"{problem_id}: changed since {diff.since}: {', '.join(counts)}", WIDTH)
    return "\n".join([head, *(line for sort, group in sorts for line in ["", _SORTS[sort][0], *shown.sort(group)])])


def told_of_set(set_id: str, diff: SetDiff, coloured: bool) -> str:
    """Return the changes of the set itself, and the changes of each problem that has changed."""
    each = {set_id: diff.own, **diff.problems}
    changed = [told(name, one, coloured) for name, one in each.items() if one.changes]
    return "\n\n".join(changed) or told(set_id, diff.own, coloured)


def as_json(problem_id: str, diff: Diff) -> str:
    return _json(_data("problem", problem_id, diff))


def set_as_json(set_id: str, diff: SetDiff) -> str:
    problems = [_data("problem", name, one) for name, one in diff.problems.items()]
    return _json({**_data("set", set_id, diff.own), "changed": diff.changed, "problems": problems})


def _data(sort: str, name: str, diff: Diff) -> dict[str, Any]:
    listed = [{**asdict(change), "how": change.how} for change in diff.changes]
    return {sort: name, "since": diff.since, "changed": bool(listed), "changes": listed}


def _json(data: Any) -> str:
    return json.dumps(data, indent=2, ensure_ascii=False)


class _Shown:
    def __init__(self, coloured: bool):
        self.coloured = coloured

    def sort(self, changes: Sequence[Change]) -> Iterable[str]:
        of = changes[0].of
        ways: dict[str, Callable[[Sequence[Change]], Iterable[str]]] = {
            "part": self._parts,
            "step": self._steps,
            "sentence": self._sentences,
            "number": self._numbers,
            "order": self._order,
        }
        return ways.get(of, self._values)(changes)

    def _painted(self, text: str, how: str) -> str:
        return f"\x1b[{_COLOURS[how]}m{text}\x1b[0m" if self.coloured and how in _COLOURS else text

    def _head(self, change: Change, text: str = "") -> str:
        return self._painted(f"  {_SIGNS[change.how]} {change.where}", change.how) + text

    def _pair(self, head: str, before: str, after: str, indent: str) -> list[str]:
        """Show the old and the new text: in one line if there is room, else on separate lines."""
        line = f"{head}: {before} -> {after}"
        if before and after and columns(line) <= WIDTH and "\n" not in line:
            return [f"{head}: {self._painted(before, REMOVED)} -> {self._painted(after, ADDED)}"]
        pairs = ((REMOVED, before), (ADDED, after))
        marked = [(how, f"{indent}{_SIGNS[how]} {text}") for how, texts in pairs for text in texts.splitlines()]
        return [head, *(self._painted(text, how) for how, text in marked)]

    def _values(self, changes: Sequence[Change]) -> Iterable[str]:
        for change in changes:
            if change.how == CHANGED:
                yield from self._pair(self._head(change), change.before, change.after, "      ")
            else:
                yield self._head(change, f": {change.before or change.after}")

    def _parts(self, changes: Sequence[Change]) -> Iterable[str]:
        for change in changes:
            moved = change.how == CHANGED
            yield (
                f"  {change.before} is now {change.after}"
                if moved
                else self._head(change, f": {change.before or change.after}")
            )

    def _steps(self, changes: Sequence[Change]) -> Iterable[str]:
        for change in changes:
            facets = {facet: (before, after) for facet, before, after in change.facets}
            result = facets.pop("result", None)
            if change.how != CHANGED:
                yield self._head(change, f": {change.before or change.after}")
            elif result:
                yield from self._pair(self._head(change), *result, "      ")
            else:
                yield self._head(change)
            if result and "lines" in facets:  # the lines before a changed result are not shown
                del facets["lines"]
            for facet, (before, after) in facets.items():
                cut = _few if facet == "lines" else str
                yield from self._pair(f"      {_FACETS[facet]}", cut(before), cut(after), "        ")

    def _sentences(self, changes: Sequence[Change]) -> Iterable[str]:
        for where, group in groupby(changes, key=lambda change: change.where):
            yield f"  {where}"
            for change in group:
                yield from self._filled([w for run, *ends in _ended(change.words) for w in _marked(*run, *ends)])

    def _filled(self, words: Sequence[tuple[str, str]]) -> Iterable[str]:
        indent, line, room = " " * 6, list[str](), WIDTH - 6
        for how, word in words:
            if columns(word) > room and line:
                yield indent + " ".join(line)
                line, room = [], WIDTH - 6
            line.append(self._painted(word, how))
            room -= columns(word) + 1
        yield indent + " ".join(line)

    def _numbers(self, changes: Sequence[Change]) -> Iterable[str]:
        listed = ", ".join(f"{change.where} {change.before} -> {change.after}" for change in changes)
        return textwrap.wrap(listed, WIDTH, initial_indent="  ", subsequent_indent="  ", break_long_words=False)

    def _order(self, changes: Sequence[Change]) -> Iterable[str]:
        yield f"  the remaining {changes[0].where} are in a different order"


def _ended(runs: Sequence[tuple[str, str]]) -> Iterable[tuple[tuple[str, str], bool, bool]]:
    """Return each run of words, whether the sentence begins with this run, and whether the sentence ends with it."""
    return ((run, i == 0, i == len(runs) - 1) for i, run in enumerate(runs))


def _marked(how: str, words: str, first: bool, last: bool) -> list[tuple[str, str]]:
    """Return the words of a run. Marks as in `git diff --word-diff` enclose a run that was removed or added."""
    marked = {EQUAL: _abridged(words, first, last), REMOVED: f"[-{words}-]", ADDED: f"{{+{words}+}}"}[how]
    return [(how, word) for word in marked.split(" ")]


def _abridged(words: str, first: bool, last: bool) -> str:
    """Return the unchanged words; if there are many, return only the words next to a change."""
    listed = words.split(" ")
    before, after = ([] if first else listed[:_AROUND]), ([] if last else listed[-_AROUND:])
    return words if len(listed) <= len(before) + len(after) + 1 else " ".join([*before, "…", *after])


def _few(lines: str) -> str:
    """Return the lines; if there are many, return only the first lines and the number of the other lines."""
    listed = lines.splitlines()
    more = len(listed) - _MOST_LINES
    return lines if more <= 1 else "\n".join([*listed[:_MOST_LINES], f"and {more} more"])
