"""Each language has the phrases of English: the same files and keys. A phrase prints the same names; it may do without
a name that English only tests, such as the number of equations."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from jinja2.meta import find_undeclared_variables

from derive.page.template import environment
from tests.courses import ROOT

PHRASES = ROOT / "templates" / "phrases"
LANGUAGES = sorted(folder.name for folder in PHRASES.iterdir() if folder.name != "en")
OF_THE_LANGUAGE = ("labels.language", "labels.own_name", "labels.verdicts", "labels.report_page.columns", "laws")
MAY_HAVE_MORE = ("terms.", "labels.rules.")  # names of bodies, and of rules whose key has another name in English
ENVIRONMENT = environment()


def phrases_of(folder: Path, file: str) -> dict[str, Any]:
    """Return the phrases of a file by their keys; the forms of a term are together under one key."""
    return dict(_flat(yaml.load((folder / file).read_text(), Loader=yaml.CSafeLoader), ()))


def _flat(value: Any, keys: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    name = ".".join(keys)
    if name in OF_THE_LANGUAGE or not isinstance(value, Mapping) or keys[:1] == ("terms",) and len(keys) == 2:
        yield name, value
    else:
        for key, each in value.items():
            yield from _flat(each, (*keys, key))


def names_in(phrase: Any) -> set[str]:
    return {name for text in texts_of(phrase) for name in find_undeclared_variables(ENVIRONMENT.parse(text))}


def names_printed(phrase: Any) -> set[str]:
    return {name for text in texts_of(phrase) for name in re.findall(r"<<(\w+)", text)}


def texts_of(phrase: Any) -> Iterable[str]:
    return phrase.values() if isinstance(phrase, Mapping) else phrase if isinstance(phrase, list) else [phrase]


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_language_is_complete(language: str) -> None:
    files = sorted(file.name for file in (PHRASES / "en").glob("*.yaml"))
    assert sorted(file.name for file in (PHRASES / language).glob("*.yaml")) == files
    unlike: list[str] = []
    for file in files:
        ours, theirs = (phrases_of(PHRASES / name, file) for name in ("en", language))
        added = {key for key in theirs if key not in ours and not key.startswith(MAY_HAVE_MORE)}
        unlike += [f"{file}: {key}" for key in sorted({*ours} - {*theirs} | added)]
        for key, phrase in ours.items():
            if key in theirs and key not in OF_THE_LANGUAGE:
                used = names_in(theirs[key])
                if not names_printed(phrase) <= used <= names_in(phrase):
                    unlike.append(f"{file}: {key} uses {sorted(used)}, not {sorted(names_in(phrase))}")
    assert not unlike, "\n".join(unlike)
    rules = phrases_of(PHRASES / language, "report.yaml")  # English derives other names from the keys of the rules
    tasks = phrases_of(PHRASES / language, "rubric.yaml")
    assert not {key.removeprefix("tasks.") for key in tasks} - {key.removeprefix("labels.rules.") for key in rules}
