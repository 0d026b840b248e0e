"""Write docs/yaml.md, the list of all keys of the files that authors write, from the schemas for text editors."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from derive.algebra.kinds import KINDS
from derive.course.editors import SCHEMAS
from derive.units import UNIT_NAMES

DOCUMENT = Path(__file__).parent.parent / "docs" / "yaml.md"
FILES = {"problem": "A problem", "set": "A set", "course": "A course", "reference": "A reference"}

_BEGINNING = """\
# Every key

`tools/yaml_reference.py` writes this page from the schemas for editors; do not edit the page. The keys are
described in [problems.md](problems.md), [yaml-alone.md](yaml-alone.md) and [references.md](references.md). A key in
bold is required.

An *expression* is a formula of declared symbols, or a number with its unit: `2*a`, `sqrt(g/l)`, `2 cm`, `900 rpm`.
"""

MANY = 8  # a table refers to an earlier table with at least this many keys, and does not repeat these keys
Schema = dict[str, Any]


class Sections:
    """The tables of keys, one for each mapping in the files; mappings with the same keys share a table."""

    def __init__(self) -> None:
        self.tables: list[str] = []
        self._titled: dict[str, Schema] = {}
        self._waiting: list[tuple[str, Schema]] = []

    def add(self, title: str, schema: Schema) -> None:
        if schema["type"] == "object":
            self._table(f"## {title}", schema)
        else:
            kinds = " and ".join(self._holds(each, each["required"][0]) for each in schema["items"]["anyOf"])
            self.tables.append(f"## {title}\n\nA list of mappings of two kinds, {kinds}.\n")
        for name, given in _given(schema):
            self._table(f"### `given` of `solve: {name}`", given)
        while self._waiting:
            name, found = self._waiting.pop(0)
            self._table(f"### {name}", found)

    def _table(self, heading: str, schema: Schema) -> None:
        self._at = heading.rpartition(" ")[2].strip("`")  # for the titles of later tables
        needed, keys = schema.get("required", []), schema["properties"]
        like, shared = self._shared_with_another(keys)
        lines = [heading, "", *([f"The keys of {like}, and", ""] if like else [])]
        lines += ["| key | value | meaning |", "|---|---|---|"]
        for name, under in keys.items():
            if name in shared:
                continue
            told = f"**`{name}`**" if name in needed else f"`{name}`"
            lines.append(f"| {told} | {self._holds(under, name)} | {_in_a_cell(under.get('description', ''))} |")
        self.tables.append("\n".join([*lines, ""]))

    def _shared_with_another(self, keys: Schema) -> tuple[str, Schema]:
        """Return a link to an earlier table, and the keys of that table; return "" and {} if there is no such table.

        That table has at least `MANY` keys, and `keys` contains all of them and at least one other key.
        """
        for title, other in self._titled.items():
            if MANY <= len(other) < len(keys) and all(keys.get(name) == under for name, under in other.items()):
                return f"[{title}](#{_anchor(title)})", other
        return "", {}

    def _holds(self, schema: Schema, name: str) -> str:
        """Describe in words the values that a schema allows."""
        if "anyOf" in schema:
            return _either(list(dict.fromkeys(self._holds(each, name) for each in schema["anyOf"])))
        if "enum" in schema:
            if set(schema["enum"]) >= set(KINDS):
                return "[kind](#kinds)"
            return _either([f"`{word}`" for word in schema["enum"] if not word.startswith("positive ")])
        sort = schema.get("type")
        if "properties" in schema:
            return self._link(schema, name)
        if sort == "array":
            exactly = schema.get("maxItems") if schema.get("minItems") == schema.get("maxItems") else None
            count = f"{exactly} times " if exactly else ""
            if "items" not in schema:
                return "list"
            each = self._holds(schema["items"], name)
            return f"list: {count}({each})" if " or " in each and count else f"list: {count}{each}"
        if sort == "object" or isinstance(sort, list) and "object" in sort:
            each = schema.get("additionalProperties")
            return f"names, each with {self._holds(each, name)}" if each else "the inputs that `solve` asks for"
        return _plain(schema)

    def _link(self, schema: Schema, name: str) -> str:
        keys = schema["properties"]
        title = next((title for title, other in self._titled.items() if other == keys), None)
        if title is None:
            title = f"`{name}` of `{self._at}`" if f"`{name}`" in self._titled else f"`{name}`"
            self._titled[title] = keys
            self._waiting.append((title, schema))
        return f"[keys](#{_anchor(title)})"


def _anchor(title: str) -> str:
    return re.sub(r"[^\w-]", "", title.replace(" ", "-"))


def _given(schema: Schema) -> Iterator[tuple[str, Schema]]:
    """Yield the name of each script that derive contains, with the schema of its `given:`."""
    for case in schema.get("allOf", []):
        name = case["if"]["properties"]["solve"].get("const")
        if name:
            yield name, case["then"]["properties"]["given"]


def _plain(schema: Schema) -> str:
    sort = schema.get("type")
    match sort if isinstance(sort, str) else tuple(sort or ()):
        case "boolean":
            return "`true` or `false`"
        case "integer":
            return f"whole number from {schema['minimum']} to {schema['maximum']}"
        case "number":
            return "number of points, halves allowed"
        case ("string", "number"):
            return "expression"
        case "string" if "examples" in schema:
            return "[unit](#units)"
        case "string" if "^[A-Za-z]" in schema.get("pattern", ""):
            return "name"
        case "string" if " in " in schema.get("pattern", ""):
            return "a kind with a range, `angle in (0, pi/2)`"
        case ("string", "boolean"):
            return "key of a step"
        case ():
            return "the name of a file"
    return "text"


def _either(words: list[str]) -> str:
    *several, last = words
    return f"{', '.join(several)} or {last}" if several else last


def _in_a_cell(text: str) -> str:
    return re.sub(r"(?<!`)<<", r"\\<<", text.replace("|", r"\|"))


def _kinds() -> str:
    lines = ["## Kinds", "", "| kind | unit | sign |", "|---|---|---|"]
    for name, kind in KINDS.items():
        lines.append(f"| `{name}` | {kind.unit or '1'} | {'positive' if kind.positive else 'either'} |")
    return "\n".join([*lines, ""])


def _units() -> str:
    return "\n".join(
        [
            "## Units",
            "",
            ", ".join(f"`{unit}`" for unit in UNIT_NAMES) + ", with products, quotients and powers of them.",
            "",
        ]
    )


def document() -> str:
    """Return the whole page."""
    sections = Sections()
    for file, title in FILES.items():
        sections.add(title, json.loads(SCHEMAS[f"{file}.schema.json"]()))
    return "\n".join([_BEGINNING, *sections.tables, _kinds(), _units()])


def main() -> None:
    DOCUMENT.write_text(document(), encoding="utf-8")


if __name__ == "__main__":
    main()
