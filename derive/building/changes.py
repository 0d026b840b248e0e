"""The differences, as data, between two solutions of a problem, both read as JSON (docs/json.md)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Any

ADDED, REMOVED, CHANGED = "added", "removed", "changed"
EQUAL = "equal"
_ALIKE = 0.4  # two sentences with at least this share of equal words count as one edited sentence
_NO_PART: Mapping[str, Any] = {"answers": [], "ask": "", "says": [], "points": None, "extra": False}

Run = tuple[str, str]
Blocks = Sequence[Mapping[str, Any]]


@dataclass(frozen=True)
class Change:
    """One difference between two states of a problem or of a set.

    of       the kind of difference: problem (of a set), given, points, asked, part, answer, step, order, sentence,
             drawing, number, reference, warning
    where    the place of the difference: a key, the label of a part, a place on the page
    before   the old text; empty if there was none
    after    the new text; empty if the text was removed
    words    for a sentence: its words in runs that are equal, removed or added
    facets   for a step: each property that differs, with its old and its new text
    """

    of: str
    where: str
    before: str = ""
    after: str = ""
    words: tuple[Run, ...] = ()
    facets: tuple[tuple[str, str, str], ...] = ()

    @property
    def how(self) -> str:
        if self.before and self.after or self.facets:
            return CHANGED
        return ADDED if self.after else REMOVED


def changes(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[Change]:
    """Return the differences: first the differences in the input and the questions, then in results and sentences,
    then in drawings, equation numbers, references and warnings."""
    parts = list(_paired(before["parts"], after["parts"]))
    return [
        *_table("given", _given(before), _given(after)),
        *_points(before, after, parts),
        *_asked(parts),
        *_table("answer", _answers(before), _answers(after)),
        *_steps(before, after),
        *_sentences(before, after, parts),
        *_table("drawing", _drawings(before), _drawings(after)),
        *_table("number", _numbers(before), _numbers(after), only_changed=True),
        *_table("reference", _reference(before), _reference(after)),
        *_warnings(before, after),
    ]


def _table(of: str, before: Mapping[str, str], after: Mapping[str, str], only_changed: bool = False) -> list[Change]:
    names = [*after, *(name for name in before if name not in after)]
    found = [Change(of, name, before.get(name, ""), after.get(name, "")) for name in names]
    return [each for each in found if each.before != each.after and (not only_changed or each.how == CHANGED)]


# --- the texts that are compared, for each sort of difference ---


def _given(page: Mapping[str, Any]) -> dict[str, str]:
    return {name: _given_text(value) for name, value in page["given"].items()}


def _given_text(value: Any) -> str:
    if isinstance(value, dict):
        numbers = ", ".join(f"{letter} = {number}" for letter, number in value["measured"].items())
        return f"{_given_text(value['value'])} with {numbers}"
    return f"[{', '.join(map(str, value))}]" if isinstance(value, list) else str(value)


def _answers(page: Mapping[str, Any]) -> dict[str, str]:
    """Return the formula of each answer, followed by the numbers of the answer."""
    return {
        key: " = ".join([answer["text"], *(n["text"] for n in [answer["number"], *answer.get("also", [])] if n)])
        for key, answer in page["answers"].items()
    }


def _drawings(page: Mapping[str, Any]) -> dict[str, str]:
    return {drawing["key"]: f"in {_place(drawing['at'])}" for drawing in page["drawings"]}


def _place(at: str) -> str:
    return f"part {at}" if len(at) == 1 else f"the {at}"


def _numbers(page: Mapping[str, Any]) -> dict[str, str]:
    return {block["equation"]: f"({block['number']})" for block in _blocks(page) if "equation" in block}


def _blocks(page: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    for part in page["parts"]:
        yield from part["says"]
    yield from page["limits_say"]


def _reference(page: Mapping[str, Any]) -> dict[str, str]:
    return {f"{t['document']} line {t['line']}: {t['states']}": str(t["outcome"]) for t in page["reference"]}


def _warnings(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[Change]:
    old, new = ({(w["code"], w["message"]): None for w in page["warnings"]} for page in (before, after))
    yield from (Change("warning", code, "", message) for code, message in new if (code, message) not in old)
    yield from (Change("warning", code, message, "") for code, message in old if (code, message) not in new)


# --- parts ---


def _paired(before: Sequence[Any], after: Sequence[Any]) -> Iterator[tuple[Any, Any]]:
    """Pair each part with the most similar earlier part; `_NO_PART` is the partner of a new or removed part."""
    alike = sorted(
        ((-_likeness(old, new), abs(i - j), i, j) for i, old in enumerate(before) for j, new in enumerate(after)),
    )
    was: dict[int, int] = {}
    for unlike, _, i, j in alike:
        if unlike and i not in was.values() and j not in was:
            was[j] = i
    yield from ((before[was[j]] if j in was else _NO_PART, new) for j, new in enumerate(after))
    yield from ((old, _NO_PART) for i, old in enumerate(before) if i not in was.values())


def _likeness(old: Mapping[str, Any], new: Mapping[str, Any]) -> int:
    weights = {"answers": 4, "ask": 4, "label": 1}
    shared = not {*old["answers"]}.isdisjoint(new["answers"])
    return sum(weight for key, weight in weights.items() if old[key] == new[key]) + 2 * shared


def _name(old: Mapping[str, Any], new: Mapping[str, Any]) -> str:
    return f"part {new.get('label') or old['label']}"


def _points(before: Mapping[str, Any], after: Mapping[str, Any], parts: Iterable[tuple[Any, Any]]) -> list[Change]:
    whole = [Change("points", "the problem", _worth(before), _worth(after))]
    of_parts = [Change("points", _name(old, new), _worth(old), _worth(new)) for old, new in parts]
    return [each for each in [*whole, *of_parts] if each.before != each.after]


def _worth(page: Mapping[str, Any]) -> str:
    if page.get("extra"):
        return "extra"
    return "" if page["points"] is None else str(page["points"])


def _asked(parts: Iterable[tuple[Any, Any]]) -> Iterator[Change]:
    for old, new in parts:
        name = _name(old, new)
        if old is _NO_PART or new is _NO_PART:
            yield Change("part", name, _question(old), _question(new))
            continue
        if old["label"] != new["label"]:
            yield Change("part", name, f"part {old['label']}", name)
        if old["answers"] != new["answers"]:
            yield Change("asked", name, ", ".join(old["answers"]), ", ".join(new["answers"]))


def _question(part: Mapping[str, Any]) -> str:
    return str(part["ask"]) or ", ".join(part["answers"])


# --- steps ---


def _steps(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[Change]:
    old, new = ({step["key"]: step for step in page["steps"]} for page in (before, after))
    for key, step in new.items():
        if key not in old:
            yield Change("step", key, "", _result(step))
        elif facets := tuple(_facets(old[key], step)):
            yield Change("step", key, _result(old[key]), _result(step), facets=facets)
    yield from (Change("step", key, _result(step), "") for key, step in old.items() if key not in new)
    was, now = (" ".join(key for key in each if key in old and key in new) for each in (old, new))
    if was != now:
        yield Change("order", "steps", was, now)


def _result(step: Mapping[str, Any]) -> str:
    return str(step["chain"][-1]["text"])


def _facets(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Yield the properties in which two versions of a step differ, each with its old and its new text."""
    if _left_side(old) != _left_side(new):
        yield "name", _left_side(old), _left_side(new)
    if _result(old) != _result(new):
        yield "result", _result(old), _result(new)
    lines = [[line["text"] for line in step["chain"][:-1]] for step in (old, new)]
    gone, come = ([line for line in a if line not in b] for a, b in (lines, lines[::-1]))
    if gone or come:
        yield "lines", "\n".join(gone), "\n".join(come)
    for facet, key in (("rule", "rule"), ("outcome", "outcome")):
        if old[key] != new[key]:
            yield facet, str(old[key]), str(new[key])
    if old["inputs"] != new["inputs"]:
        yield "inputs", ", ".join(old["inputs"]), ", ".join(new["inputs"])
    if _grades(old) != _grades(new):
        yield "evidence", _grades(old), _grades(new)


def _left_side(step: Mapping[str, Any]) -> str:
    return str(step["symbol"]["sympy"]) if step["symbol"] else ""


def _grades(step: Mapping[str, Any]) -> str:
    return ", ".join(Counter(each["grade"] for each in step["evidence"]))


# --- sentences ---


def _sentences(before: Mapping[str, Any], after: Mapping[str, Any], parts: Iterable[tuple[Any, Any]]) -> list[Change]:
    places: list[tuple[str, Blocks, Blocks]] = [
        *((name, _plain(before[name]), _plain(after[name])) for name in ("title", "statement", "strategy")),
        *(place for old, new in parts for place in _of_part(old, new)),
        ("limiting cases", before["limits_say"], after["limits_say"]),
        ("note", _plain(before["note"]), _plain(after["note"])),
        *_captions(before, after),
    ]
    return [change for where, old, new in places for change in _edited(where, _texts(old), _texts(new))]


def _of_part(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[tuple[str, Blocks, Blocks]]:
    """Yield the earlier and the present texts of a part: its question and its solution. A new or removed part yields
    only its solution."""
    if old is not _NO_PART and new is not _NO_PART:
        yield f"{_name(old, new)}, question", _plain(old["ask"]), _plain(new["ask"])
    yield f"{_name(old, new)}, solution", old["says"], new["says"]


def _captions(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[tuple[str, Blocks, Blocks]]:
    old, new = ({drawing["key"]: drawing for drawing in page["drawings"]} for page in (before, after))
    for key in (key for key in new if key in old):
        for what in ("caption", "alt"):
            yield f"drawing {key}, {what}", _plain(old[key][what]), _plain(new[key][what])


def _plain(text: str) -> Blocks:
    return [{"text": text, "refers_to": []}]


@dataclass(frozen=True)
class _Sentence:
    """The words of a sentence. For a comparison, the keys of equations replace the equation numbers."""

    words: tuple[str, ...]
    keys: tuple[str, ...]


def _texts(blocks: Blocks) -> list[_Sentence]:
    return [_sentence_of(block) for block in blocks if block.get("text")]


def _sentence_of(block: Mapping[str, Any]) -> _Sentence:
    references = iter(block["refers_to"])

    def key_for(number: re.Match[str]) -> str:
        return f"({next(references, number[0])})"

    keyed = re.sub(r"\(\d+[a-z]*\)", key_for, block["text"]) if block["refers_to"] else block["text"]
    return _Sentence(tuple(block["text"].split()), tuple(keyed.split()))


def _edited(where: str, old: Sequence[_Sentence], new: Sequence[_Sentence]) -> Iterator[Change]:
    matcher = SequenceMatcher(None, [each.keys for each in old], [each.keys for each in new], autojunk=False)
    for how, a, b, c, d in matcher.get_opcodes():
        if how == EQUAL:
            continue
        was, left = list(old[a:b]), []
        for sentence in new[c:d]:
            known = next((i for i, each in enumerate(was) if _share(each, sentence) >= _ALIKE), None)
            if known is None:
                left.append(sentence)
                continue
            yield from (_sentence(where, each, None) for each in was[:known])
            yield from (_sentence(where, None, each) for each in left)
            yield _sentence(where, was[known], sentence)
            was, left = was[known + 1 :], []
        yield from (_sentence(where, each, None) for each in was)
        yield from (_sentence(where, None, each) for each in left)


def _share(old: _Sentence, new: _Sentence) -> float:
    return SequenceMatcher(None, old.keys, new.keys, autojunk=False).ratio()


def _sentence(where: str, old: _Sentence | None, new: _Sentence | None) -> Change:
    none = _Sentence((), ())
    return Change(
        "sentence",
        where,
        " ".join((old or none).words),
        " ".join((new or none).words),
        tuple(_runs(old or none, new or none)),
    )


def _runs(old: _Sentence, new: _Sentence) -> Iterator[Run]:
    for how, a, b, c, d in SequenceMatcher(None, old.keys, new.keys, autojunk=False).get_opcodes():
        if how == EQUAL:
            yield EQUAL, " ".join(new.words[c:d])
            continue
        if b > a:
            yield REMOVED, " ".join(old.words[a:b])
        if d > c:
            yield ADDED, " ".join(new.words[c:d])
