"""Write the table of the verbs of `results:` in the documentation, from the table by which derive checks them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from derive.stock.keys.result_verbs import VERBS, Verb

DOCUMENT = Path(__file__).parent.parent / "docs" / "yaml-alone.md"
START, END = "<!-- the verbs, by tools/result_verbs.py -->\n", "<!-- the end of the verbs -->\n"


def table() -> str:
    """A line for each verb: the keys that it needs, those that it may have, and what it yields."""
    lines = ["| verb | needs | may have | yields |\n", "|---|---|---|---|\n"]
    return "".join([*lines, *(_line(name, verb) for name, verb in VERBS.items())])


def _line(name: str, verb: Verb) -> str:
    several = [" or ".join(f"`{key}`" for key in verb.one_of)] if verb.one_of else []
    needs = ", ".join([*_keys(verb.needs), *several])
    return f"| `{name}` | {needs} | {', '.join(_keys(verb.uses))} | {verb.yields} |\n"


def _keys(keys: Mapping[str, str]) -> list[str]:
    return [f"`{key}` ({holds})" if holds else f"`{key}`" for key, holds in keys.items()]


def updated(text: str) -> str:
    """The document with the table as it is now."""
    before, _, rest = text.partition(START)
    return before + START + table() + END + rest.partition(END)[2]


def main() -> None:
    DOCUMENT.write_text(updated(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
