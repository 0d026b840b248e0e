"""Rules for tests: by name, or made up."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import derive.mechanics
from derive.steps.rule import CHECK, RULES, Judged, Rule, Theorem

SOURCE = Path(derive.mechanics.__file__).parents[1]


def made_up(name: str, *claims: str, **more: Any) -> Rule:
    """Return a rule for a test with these claims as checks; without claims it is a definition."""
    return Rule(name, evidence=dict.fromkeys(claims, CHECK), **more)


def holds(rule: str, outcome: str, facts: Judged) -> bool:
    """Whether the rule has this outcome and the outcome is true."""
    predicate = RULES[rule].outcomes.get(outcome)
    return predicate is not None and bool(predicate(facts))


def stated_rightly(rule: str, outcome: str, facts: Judged) -> bool:
    """Whether the statements of the sentence in addition to the chain are true."""
    return bool(
        made_up("test.any", statements=RULES[rule].statements, outcomes={outcome: bool_of}).verdict(outcome, facts)
    )


def bool_of(facts: Judged) -> bool:
    return True


def wrongly_named(rule: str, facts: Judged, named: Mapping[str, Any]) -> str | None:
    return RULES[rule].wrongly_named(facts, named)


def theorems() -> list[Theorem]:
    return list({quote.theorem.name: quote.theorem for *_, rule in records() for quote in rule.quotes}.values())


def records() -> Iterator[tuple[str, str, Rule]]:
    """Yield the module, the constant and the record of every rule in the code."""
    for folder in ("mechanics", "steps"):
        for path in sorted((SOURCE / folder).rglob("*.py")):
            name = ".".join(path.relative_to(SOURCE).with_suffix("").parts)
            module = import_module(f"derive.{name}")
            yield from ((name, const, each) for const, each in vars(module).items() if isinstance(each, Rule))
