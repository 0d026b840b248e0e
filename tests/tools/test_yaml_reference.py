"""The reference of keys is made from the schemas and misses none of their keys."""

from __future__ import annotations

import json
import re
import runpy
from collections.abc import Iterator
from typing import Any

import pytest

from tests.courses import ROOT

MADE = runpy.run_path(str(ROOT / "tools" / "yaml_reference.py"))
TEXT = (ROOT / "docs" / "yaml.md").read_text(encoding="utf-8")


def keys_in(schema: Any) -> Iterator[str]:
    if isinstance(schema, dict):
        yield from (name for name in schema.get("properties", {}) if isinstance(schema["properties"], dict))
    for each in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        yield from keys_in(each)


def test_it_is_up_to_date() -> None:
    assert MADE["document"]() == TEXT, "run `python -P -m tools.yaml_reference`"


@pytest.mark.parametrize("file", ["problem", "set", "course", "reference"])
def test_it_has_every_key(file: str) -> None:
    keys = set(keys_in(json.loads((ROOT / "templates" / f"{file}.schema.json").read_text(encoding="utf-8"))))
    assert len(keys) > 5
    assert {key for key in keys if not re.search(rf"^\| (\*\*)?`{key}`(\*\*)? \|", TEXT, re.MULTILINE)} == set()


def test_each_of_its_tables_has_a_title_of_its_own() -> None:
    titles = re.findall(r"^#+ (.*)$", TEXT, re.MULTILINE)
    assert len(titles) == len(set(titles)) > 20
