"""Write the table of the verbs of `results:` in the documentation, from the decorators of their functions."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import derive.stock.keys.results  # noqa: F401  the import declares a verb about bodies
from derive.mechanics.in_results import RESULT_VERBS, ResultKey, ResultVerb

DOCUMENT = Path(__file__).parent.parent / "docs" / "yaml-alone.md"
START, END = "<!-- the verbs, by tools/result_verbs.py -->\n", "<!-- the end of the verbs -->\n"


def table() -> str:
    """Return a table with a line for each verb: the keys that it needs, its optional keys, and what it yields."""
    lines = ["| verb | needs | may have | yields |\n", "|---|---|---|---|\n"]
    return "".join([*lines, *(_line(RESULT_VERBS[name]) for name in sorted(RESULT_VERBS))])


def _line(verb: ResultVerb) -> str:
    several = [" or ".join(f"`{key}`" for key in verb.one_of)] if verb.one_of else []
    keys = verb.keys.values()
    needs = ", ".join([*_keys(key for key in keys if key.needed), *several])
    optional, yields = ", ".join(_keys(key for key in keys if not key.needed)), verb.yields.replace("|", r"\|")
    return f"| `{verb.name}` | {needs} | {optional} | {yields} |\n"


def _keys(keys: Iterable[ResultKey]) -> list[str]:
    return [f"`{key.name}` ({key.hint})" if key.hint else f"`{key.name}`" for key in keys]


def updated(text: str) -> str:
    """Return the document with the current table."""
    before, _, rest = text.partition(START)
    return before + START + table() + END + rest.partition(END)[2]


def main() -> None:
    DOCUMENT.write_text(updated(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
