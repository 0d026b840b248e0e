"""The walk back: from the answers of each part to the steps they rest on; and a derivation as JSON, there and back.

A part shows, depth first, the steps behind its answers that no earlier part has shown.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from derive.algebra.encoding import decoded, encoded
from derive.algebra.equality import Compared, Evidence, Grade
from derive.algebra.expressions import Relation
from derive.errors import Complaint, Place, Rejected
from derive.steps.record import Run
from derive.steps.step import Form, Level, Quantity, Step

MAX_NESTED, MAX_ANSWERS = 20, 10_000


@dataclass(frozen=True)
class Derivation:
    """Every step that the answers rest on, in the order of the page, how each part divides them, what is assumed."""

    steps: tuple[Step, ...]
    parts: tuple[tuple[str, ...], ...]
    unshown: tuple[str, ...] = ()
    assumed: tuple[Relation, ...] = ()

    def step(self, key: str) -> Step:
        return next(step for step in self.steps if step.key == key)

    def answering(self, asked: Iterable[str]) -> tuple[Step, ...]:
        """The steps that answer what a part asks for, each once: those of these keys, or which stand for them."""
        instead = standing_in(self.steps)
        return tuple(self.step(key) for key in dict.fromkeys(instead.get(key, key) for key in asked))

    @property
    def warnings(self) -> tuple[Complaint, ...]:
        """A word on each step that the script established for nothing."""
        said = "`{}` is established but no answer rests on it"
        return tuple(Complaint("not-shown", said.format(key), severity="warning") for key in self.unshown)

    @property
    def keys(self) -> tuple[str, ...]:
        return tuple(step.key for step in self.steps)

    def grades(self) -> dict[str, int]:
        """How many claims were decided in each way."""
        counts = {grade.value: 0 for grade in Grade if grade is not Grade.REFUTED}
        for step in self.steps:
            for evidence in step.evidence:
                counts[evidence.grade.value] += 1
        return counts


def returned_quantities(value: Any, place: Place | None = None) -> list[Quantity]:
    """What a script returned, flattened; anything but quantities in tuples, lists and mappings is refused.

    `place` is where the script returns it.
    """
    found: list[Quantity] = []
    waiting = [(value, 0)]
    while waiting:
        each, depth = waiting.pop()
        if _is_whole(each):
            found.append(each)
            continue
        if isinstance(each, dict):
            each = list(each.values())
        if not isinstance(each, tuple | list) or not each or depth == MAX_NESTED or len(found) > MAX_ANSWERS:
            message = f"`solve()` must return its answers, each made by a verb, but it returned {_named(each)}"
            help_line = "end it with, for example, `return I, T, theta`"
            raise Rejected(Complaint("script", message, place, help=help_line))
        waiting += [(item, depth + 1) for item in reversed(each)]
    return found


def _is_whole(value: Any) -> bool:
    """Whether it is a quantity that `establish` made, and not an empty one."""
    return isinstance(value, Quantity) and isinstance(getattr(value, "step", None), Step)


def _named(value: Any) -> str:
    """What a script returned in place of a quantity, in words."""
    if value is None or value == ():
        return "nothing"
    if isinstance(value, tuple | list) and value:
        return "lists within lists without end"
    kind = type(value).__name__
    return f"{'an' if kind[:1] in 'aeiou' else 'a'} `{kind}`"


def with_ancestors(quantities: Iterable[Quantity], place: Place | None = None) -> dict[str, Quantity]:
    """Every quantity that these rest on and they themselves, parents first, by key; two of one key are refused."""
    found: dict[str, Quantity] = {}

    def visit(quantity: Quantity) -> None:
        known = found.get(quantity.key)
        if known is quantity:
            return
        if known is not None and known.step != quantity.step:
            message = f"two different steps are both called `{quantity.key}`"
            raise Rejected(Complaint("key-clash", message, place, help='name one of them with `key="..."`'))
        for parent in quantity.parents:
            visit(parent)
        found.setdefault(quantity.key, quantity)

    for quantity in quantities:
        visit(quantity)
    return found


def standing_in(steps: Iterable[Step]) -> dict[str, str]:
    """For each key that has no step of its own, and for which a step stands, the key of that step."""
    found = {step.key: step for step in steps}
    return {key: step.key for step in found.values() for key in step.stands_for if key not in found}


def derivation_of(answers: Iterable[Iterable[str]], known: dict[str, Quantity], run: Run | None = None) -> Derivation:
    """Divide the steps among the parts; `answers` holds the keys that each part asks for."""
    shown: dict[str, Step] = {}
    parts = []
    for keys in answers:
        new = [key for key in with_ancestors(known[key] for key in keys) if key not in shown]
        shown.update({key: known[key].step for key in new})
        parts.append(tuple(new))
    run = run or Run()
    unshown = tuple(dict.fromkeys(q.key for q in run.established if q.key not in shown))
    return Derivation(tuple(shown.values()), tuple(parts), unshown, tuple(run.assumed))


# --- JSON ------------------------------------------------------------------------------------------------------------


def to_json(derivation: Derivation) -> str:
    return json.dumps(
        {
            "steps": [_step_to_data(step) for step in derivation.steps],
            "parts": derivation.parts,
            "unshown": derivation.unshown,
            "assumed": [encoded(condition) for condition in derivation.assumed],
        }
    )


def from_json(text: str) -> Derivation:
    data = json.loads(text)
    return Derivation(
        steps=tuple(_step_from_data(step) for step in data["steps"]),
        parts=tuple(tuple(part) for part in data["parts"]),
        unshown=tuple(data["unshown"]),
        assumed=tuple(decoded(condition) for condition in data["assumed"]),
    )


def _step_to_data(step: Step) -> dict[str, Any]:
    return {
        "key": step.key,
        "rule": step.rule,
        "symbol": encoded(step.symbol),
        "chain": [_form_to_data(form) for form in step.chain],
        "inputs": step.inputs,
        "roles": [[role, encoded(symbol)] for role, symbol in step.roles],
        "outcome": step.outcome,
        "evidence": [[e.claim, e.compared, e.grade, e.detail] for e in step.evidence],
        "kind": step.kind,
        "words": step.words,
        "coordinates": [[encoded(q), kind] for q, kind in step.coordinates],
        "stands_for": step.stands_for,
        "names": [[encoded(name), encoded(value)] for name, value in step.names],
        "motion": [[encoded(rate), encoded(value)] for rate, value in step.motion],
        "law_at": step.law_at,
    }


def _form_to_data(form: Form) -> list[Any]:
    return [encoded(form.expr), form.because, form.level, [encoded(factor) for factor in form.nonzero]]


def _step_from_data(data: dict[str, Any]) -> Step:
    return Step(
        key=data["key"],
        rule=data["rule"],
        symbol=decoded(data["symbol"]),
        chain=tuple(
            Form(decoded(expr), because, Level(level), tuple(decoded(factor) for factor in nonzero))
            for expr, because, level, nonzero in data["chain"]
        ),
        inputs=tuple(data["inputs"]),
        roles=tuple((role, decoded(symbol)) for role, symbol in data["roles"]),
        outcome=data["outcome"],
        evidence=tuple(
            Evidence(claim, Compared(of), Grade(grade), detail) for claim, of, grade, detail in data["evidence"]
        ),
        kind=data["kind"],
        words=tuple((name, key) for name, key in data["words"]),
        coordinates=tuple((decoded(q), kind) for q, kind in data["coordinates"]),
        stands_for=tuple(data["stands_for"]),
        names=tuple((decoded(name), decoded(value)) for name, value in data["names"]),
        motion=tuple((decoded(rate), decoded(value)) for rate, value in data["motion"]),
        law_at=data["law_at"],
    )
