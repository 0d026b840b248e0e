"""Write docs/rules.md, and the list of rules with checks only in docs/soundness.md, from the records of the rules."""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterable
from inspect import getdoc, isfunction, signature, unwrap
from itertools import groupby
from pathlib import Path

import derive.mechanics
import derive.mechanics.observations.selection
import derive.steps.defined
import derive.steps.numeric
from derive.mechanics.in_results import RESULT_VERBS
from derive.steps.rule import CHECK, ROUTE, Rule

DOCS = Path(__file__).parent.parent / "docs"
DOCUMENT, SOUNDNESS = DOCS / "rules.md", DOCS / "soundness.md"
START, END = "<!-- rules with checks only, by tools/rules.py -->\n", "<!-- the end of these rules -->\n"
HEAD = """# The rules

Each step of a solution is made by one of these rules, or by a rule that a script defines. A rule is a record in the
code, next to the verb that uses it. The *outcome* of a step determines its sentence; an outcome may have a predicate
that must be true of the result. A *route* derives the result again by another path through the physics. A *check* tests
the result. A rule with neither routes nor checks is a definition. `python -P -m tools.rules` writes this page from the
records.
"""


def rules() -> list[Rule]:
    """Return the rules of the loaded modules, in the order of their names."""
    modules = [module for name, module in sys.modules.items() if name.startswith("derive.")]
    found = {each for module in modules for each in vars(module).values() if isinstance(each, Rule)}
    return sorted(found, key=lambda rule: rule.name)


def verbs() -> str:
    """Return a table of the verbs of scripts: for each, the verb of `results:` that calls it, and its result."""
    public = {name: each for name, each in vars(derive.mechanics).items() if isfunction(each) and name[0] != "_"}
    asked: dict[str, str] = {}
    for name, verb in RESULT_VERBS.items():
        function = unwrap(verb.function)
        asked |= dict.fromkeys(({function.__name__, *function.__code__.co_names} & public.keys()), name)
    lines = ["\n## Verbs\n\n| verb | under `results:` | yields |\n|---|---|---|\n"]
    for name, each in sorted(public.items()):
        if "Quantity" in str(signature(each).return_annotation):
            yields = summary(getdoc(each) or "").replace("|", r"\|")
            lines.append(f"| `{name}` | {f'`{asked[name]}`' if name in asked else ''} | {yields} |\n")
    return "".join(lines)


def summary(text: str) -> str:
    """Return the beginning of a docstring, up to a blank line or to the first line on arguments, outcomes, evidence or
    sources."""
    below = r"\n\n|\n(?:Outcomes|Errors|Source|Check|Second route)s?:|\n\w+  +\w"
    return " ".join(re.split(below, text)[0].split())


def document() -> str:
    """Return the page: the table of verbs, and for each folder of rules a section with a row for each rule."""
    parts = [HEAD, verbs()]
    for folder, own in groupby(rules(), key=lambda rule: rule.name.partition(".")[0]):
        parts.append(
            f"\n## {folder.capitalize()}\n\n| rule | outcomes | routes | checks | source |\n|---|---|---|---|---|\n"
        )
        parts += [_row(rule) for rule in own]
    return "".join(parts)


def _row(rule: Rule) -> str:
    ways = {sort: [claim for claim, each in rule.evidence.items() if each is sort] for sort in (ROUTE, CHECK)}
    cells = [rule.key, _listed(rule.outcomes), *(_listed(ways[sort]) for sort in (ROUTE, CHECK)), rule.source]
    return "| " + " | ".join([f"`{cells[0]}`", *cells[1:]]) + " |\n"


def _listed(words: Iterable[str]) -> str:
    return ", ".join(word.replace("_", " ") for word in words)


def with_checks_only() -> str:
    names = [rule.name for rule in rules() if rule.evidence and ROUTE not in rule.evidence.values()]
    return textwrap.fill(", ".join(f"`{name}`" for name in names), 120, break_on_hyphens=False) + ".\n"


def soundness(text: str) -> str:
    """Return the page on soundness with the current list."""
    before, _, rest = text.partition(START)
    return before + START + with_checks_only() + END + rest.partition(END)[2]


def main() -> None:
    DOCUMENT.write_text(document(), encoding="utf-8")
    SOUNDNESS.write_text(soundness(SOUNDNESS.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
