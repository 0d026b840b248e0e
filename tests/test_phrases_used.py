"""Each phrase of pages is used by some page: a phrase that no page uses is deleted.

`variants/variants.yaml` has problems for phrases that no other page uses, one problem in each YAML document.
`phrases_used.yaml` lists, for each page, the phrases for which it is the evidence, and for each phrase without a page
the reason. After an intended change, `python -P -m tests.test_phrases_used` writes this file again: then read the
difference.
"""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import pytest
import yaml

from derive.building import pages
from derive.errors import DeriveError
from derive.page.phrasebook import Phrase, read_phrases
from derive.page.wording import Phrases
from derive.steps.step import Step
from tests.courses import ROOT, course_in, rendered_once
from tests.mutation.runs import RUNS
from tests.test_transcripts import PAGES

LIST = Path(__file__).with_suffix("").with_name("phrases_used.yaml")
OF_PAGES = ("rules", "routes", "reasons", "terms", "drawings")  # all others belong to the frame of every page
VARIANTS = Path(__file__).with_name("variants")
SETS = {"mutation": ROOT / "tests" / "mutation" / "problems", "library": ROOT / "problems" / "library"}
SORTS = ("transcript", "variant", "body", *SETS)  # the long library comes last, for phrases of no other page
SIZE, SEED = 24, 2026
NOWHERE, NOT_YET = "nowhere", "no page is written yet; this list may only shrink"


@cache
def variants() -> dict[str, str]:
    """Return name -> text of the problem, from the YAML documents of one file."""
    _, *found = re.split(r"^--- # (\w+)\n", (VARIANTS / "variants.yaml").read_text(encoding="utf-8"), flags=re.M)
    return dict(zip(found[::2], found[1::2], strict=True))


# --- what a page uses ---


class _Noted(dict[str, Any]):
    def __init__(self, table: Mapping[str, Any], used: set[str]):
        super().__init__({k: _Noted(v, used) if isinstance(v, Mapping) else v for k, v in table.items()})
        self.used = used

    def __getitem__(self, name: str) -> Any:
        return self._noted(super().__getitem__(name))

    def get(self, name: str, default: Any = None) -> Any:
        return self._noted(super().get(name, default))

    def _noted(self, found: Any) -> Any:
        if isinstance(found, Phrase):
            self.used.add(".".join(found.keys))
        return found


class _NotedPhrases(Phrases):
    used: set[str]

    def _noted(self, found: str) -> str:
        if isinstance(found, Phrase):
            self.used.add(".".join(found.keys))
        return found

    def phrase(self, step: Step, before: Step | None = None) -> str:
        return self._noted(super().phrase(step, before))

    def reason(self, step: Step, because: str, before: str) -> str:
        return self._noted(super().reason(step, because, before))

    def route(self, step: Step, claim: str) -> str:
        return self._noted(super().route(step, claim))


def noted_phrases() -> _NotedPhrases:
    used: set[str] = set()
    read = read_phrases([ROOT / "templates" / "phrases" / "en"])
    plain = {"rules", "routes", "reasons"}  # the methods above note the phrases that they choose from these
    noted = _NotedPhrases(**{name: table if name in plain else _Noted(table, used) for name, table in read.items()})
    object.__setattr__(noted, "used", used)
    return noted


def used_by(page: str, folder: Path) -> set[str]:
    """Return the phrases of a page, such as `transcript/block-cube`; without a given level, also those at `full`."""
    sort, _, name = page.partition("/")
    root, problem_id, detail = folder, f"{sort}/{name}", None
    if sort == "transcript":
        edits, detail = PAGES[name]
        problem = name.partition("-")[0]
        course_in(folder, edits, problem=problem)
        problem_id = f"hw9/{problem}"
    elif sort == "body":
        course_in(folder, dict(RUNS[name].edits), dict(RUNS[name].script), problem=sort)
        problem_id = f"hw9/{sort}"
    else:
        (root / "problems").mkdir(parents=True)
        (root / "templates").symlink_to(ROOT / "templates")
        if sort in SETS:
            (root / "problems" / sort).symlink_to(SETS[sort])
        else:
            (root / "problems" / sort).mkdir()
            (root / "problems" / sort / "set.yaml").write_text(f"course: M\ntitle: V\nproblems: [{name}]\n")
            (root / "problems" / sort / f"{name}.yaml").write_text(variants()[name], encoding="utf-8")
            for script in VARIANTS.glob("*.py"):
                (root / "problems" / sort / script.name).symlink_to(script)
    noted = noted_phrases()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pages, "phrases", lambda *_: noted)
        for level in (detail,) if detail else (None, "full"):
            rendered_once(root, problem_id, level, only={"text"})
    return {key for key in noted.used if key.partition(".")[0] in OF_PAGES}


def _leaves(table: Any) -> Iterator[Phrase]:
    if isinstance(table, Phrase):
        yield table
    elif isinstance(table, Mapping):
        for name in table:
            yield from _leaves(table[name])


def phrases_of_pages() -> list[str]:
    read = read_phrases([ROOT / "templates" / "phrases" / "en"])
    return [".".join(phrase.keys) for sort in OF_PAGES for phrase in _leaves(read[sort])]


@cache
def credited() -> dict[str, Any]:
    """Return page -> its phrases; and `nowhere` -> reason -> the phrases without a page."""
    known: dict[str, Any] = yaml.safe_load(LIST.read_text(encoding="utf-8"))
    return known


def _sample() -> list[str]:
    """Return a random sample of the pages; writing the list again makes all of them."""
    pages = sorted(page for page in credited() if page != NOWHERE)
    return sorted(Random(SEED).sample(pages, min(SIZE, len(pages))))


# --- the claims ---


def test_each_phrase_has_a_page_or_a_reason_to_have_none() -> None:
    known = credited()
    answered = [phrase for page, told in known.items() if page != NOWHERE for phrase in told]
    excused = [phrase for told in known[NOWHERE].values() for phrase in told]
    there = phrases_of_pages()
    assert sorted({*there} - {*answered, *excused}) == [], "no page uses it: write one, or delete the phrase"
    assert sorted({*answered, *excused} - {*there}) == [], "is not a phrase any more"
    assert sorted({*answered} & {*excused}) == [], "has a page, so it needs no reason"


@pytest.mark.parametrize("page", _sample())
def test_a_page_uses_the_phrases_that_it_answers_for(page: str, tmp_path: Path) -> None:
    assert sorted({*credited()[page]} - used_by(page, tmp_path / "course")) == []


def test_each_word_of_the_frame_stands_in_a_template_or_in_the_code() -> None:
    read = read_phrases([ROOT / "templates" / "phrases" / "en"])
    sources = [*(ROOT / "derive").rglob("*.py"), *(ROOT / "templates" / "latex").iterdir()]
    text = "\n".join(file.read_text(encoding="utf-8") for file in sources if file.is_file())
    asked = set(re.findall(r"[a-z_]+", text))
    names = {*read["labels"], *read["labels"]["explain"], *read["labels"]["report_page"]}
    assert sorted(names - asked) == []


# --- writing the list ---


def _pages() -> list[str]:
    return [
        *(f"transcript/{name}" for name in PAGES),
        *(f"variant/{name}" for name in variants()),
        *(f"body/{name}" for name in RUNS if name.partition("-")[0] == "body"),
        *(
            f"{sort}/{file.stem}"
            for sort, at in SETS.items()
            for file in sorted(at.rglob("*.yaml"))
            if file.stem != "set"
        ),
    ]


def _written(known: Mapping[str, Any]) -> str:
    """Return the text of the list. Pages that other tests also make come first; then those that add the most
    phrases."""
    with tempfile.TemporaryDirectory() as temporary:
        os.environ.setdefault("XDG_STATE_HOME", temporary)
        used: dict[str, set[str]] = {}
        for page in _pages():
            try:
                used[page] = used_by(page, Path(temporary) / page.replace("/", "-"))
            except DeriveError as refusal:
                print(f"{page} is refused: {refusal}")
    left, lines = {*phrases_of_pages()}, []
    for sort in SORTS:
        pages = {page for page in used if page.startswith(f"{sort}/")}
        while best := max(sorted(pages), key=lambda page: len(used[page] & left), default=None):
            found = sorted(used[best] & left)
            if not found:
                break
            lines += [f"{best}:", *(f"  - {phrase}" for phrase in found)]
            left -= used[best]
            pages.remove(best)
    excused = {phrase: why for why, told in known.get(NOWHERE, {}).items() for phrase in told}
    lines.append(f"{NOWHERE}:")
    for why in sorted({excused.get(phrase, NOT_YET) for phrase in left}):
        lines += [f"  {why}:", *(f"    - {p}" for p in sorted(left) if excused.get(p, NOT_YET) == why)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    LIST.write_text(_written(credited() if LIST.exists() else {}), encoding="utf-8")
