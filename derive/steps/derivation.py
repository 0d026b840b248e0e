"""Find the steps on which the answers of each part depend; write a derivation as JSON and read it again.

A part shows the steps on which its answers depend, each step after the steps on which it depends. Steps that an earlier
part has shown are not repeated.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from derive.algebra.encoding import as_data, from_data
from derive.algebra.equality import Compared, Evidence, Grade
from derive.algebra.expressions import Relation
from derive.errors import Complaint, Place, Rejected
from derive.steps.level import Display, Manner
from derive.steps.record import Run
from derive.steps.rule import Theorem
from derive.steps.step import Form, Level, Quantity, Step

MAX_NESTED, MAX_ANSWERS = 20, 10_000
W = TypeVar("W", bound=str)


@dataclass(frozen=True)
class Derivation:
    """The steps of a page in their order, their division into parts, and the assumptions.

    `groups` are names that ask for several steps, with the keys of these steps.
    """

    steps: tuple[Step, ...]
    parts: tuple[tuple[str, ...], ...]
    unshown: tuple[str, ...] = ()
    assumed: tuple[Relation, ...] = ()
    groups: tuple[tuple[str, tuple[str, ...]], ...] = ()
    in_words: tuple[Relation, ...] = ()  # the assumptions that a step states in words
    closing: tuple[tuple[str, ...], ...] = ()  # the steps of each limiting case in which the answers are checked
    observed: tuple[tuple[str, ...], ...] = ()  # the observations that follow the answers of each part

    def step(self, key: str) -> Step:
        return next(step for step in self.steps if step.key == key)

    def answering(self, asked: Iterable[str]) -> tuple[Step, ...]:
        """Return the steps that these names ask for, or the steps that replace them."""
        return tuple(self.step(key) for key in answering(asked, self.steps, dict(self.groups)))

    def warnings(self, place: Place) -> tuple[Complaint, ...]:
        """Return a warning for each step in `unshown`, which the page does not need; `place` is the line that names the
        script."""
        said, help_line = "`{}` is established but no answer depends on it", "let a part ask for it, or leave it out"
        return tuple(Complaint("not-shown", said.format(k), place, (), help_line, "warning") for k in self.unshown)

    @property
    def keys(self) -> tuple[str, ...]:
        return tuple(step.key for step in self.steps)

    def grades(self) -> dict[str, int]:
        """Return how many claims were decided with each grade."""
        counts = {grade.value: 0 for grade in Grade if grade is not Grade.REFUTED}
        for step in self.steps:
            for evidence in step.evidence:
                counts[evidence.grade.value] += 1
        return counts


def returned_quantities(value: Any, place: Place | None = None) -> list[Quantity]:
    """Return the quantities that a script returned, as one list. Only quantities, and nested tuples, lists and
    dictionaries of quantities, are accepted.

    `place` is the line of the script that returns them.
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
            help_line = "end `solve()` with, for example, `return I, T, theta`"
            raise Rejected(Complaint("script", message, place, help=help_line))
        waiting += [(item, depth + 1) for item in reversed(each)]
    return found


def returned_groups(value: Any, place: Place | None = None) -> dict[str, tuple[str, ...]]:
    """Return the keys of the steps by name, if a script returned a dictionary; otherwise an empty dictionary."""
    if not isinstance(value, dict):
        return {}
    return {str(name): tuple(q.key for q in returned_quantities(each, place)) for name, each in value.items()}


def _is_whole(value: Any) -> bool:
    """Whether the value is a quantity with a step, as `establish` returns it."""
    return isinstance(value, Quantity) and isinstance(getattr(value, "step", None), Step)


def _named(value: Any) -> str:
    if value is None or value == ():
        return "nothing"
    if isinstance(value, tuple | list) and value:
        return "lists that are too long or nested too deeply"
    kind = type(value).__name__
    return f"{'an' if kind[:1] in 'aeiou' else 'a'} `{kind}`"


def with_ancestors(quantities: Iterable[Quantity], place: Place | None = None) -> dict[str, Quantity]:
    """Return, by their keys, these quantities and all quantities on which they depend, parents first. Reject two
    distinct steps with the same key."""
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
    """Map each key in `stands_for` of a step to the key of this step; leave out keys that have a step of their own."""
    found = {step.key: step for step in steps}
    return {key: step.key for step in found.values() for key in step.stands_for if key not in found}


def answering(asked: Iterable[W], steps: Iterable[Step], groups: Mapping[str, tuple[str, ...]]) -> dict[str, W]:
    """Return the keys of the steps that these names ask for, each with the name that asks for it.

    A name may ask for a group of steps. A group of two conditions may be named by the key of one of them. This key then
    asks for both conditions, because one condition alone is not sufficient.
    """
    steps = list(steps)
    own, instead = {step.key for step in steps}, standing_in(steps)

    def keys_of(name: str) -> tuple[str, ...]:
        group = groups.get(name, (name,))
        return (name,) if name in own and name not in group else group

    each = [(str(key), name) for name in asked for key in keys_of(name)]
    return {instead.get(key, key): name for key, name in each}


def derivation_of(
    answers: Iterable[Iterable[str]],
    known: dict[str, Quantity],
    run: Run | None = None,
    groups: Mapping[str, tuple[str, ...]] | None = None,
    closing: Iterable[Iterable[Quantity]] = (),
    observed: Iterable[Iterable[Quantity]] = (),
) -> Derivation:
    """Divide the steps among the parts; `answers` are the keys that each part asks for.

    closing    the quantities of each limiting case
    observed   the observations of each part
    """
    shown: dict[str, Step] = {}
    parts = []
    for keys in answers:
        new = [key for key in with_ancestors(known[key] for key in keys) if key not in shown]
        shown.update({key: known[key].step for key in new})
        parts.append(tuple(new))
    cases = [list(case) for case in closing]
    for key, quantity in with_ancestors(quantity for case in cases for quantity in case).items():
        shown.setdefault(key, quantity.step)
    seen = [list(part) for part in observed]
    shown.update((quantity.key, quantity.step) for part in seen for quantity in part)
    checked = tuple(tuple(quantity.key for quantity in case) for case in cases)
    run = run or Run()
    unshown = tuple(dict.fromkeys(q.key for q in run.established if q.key not in shown))
    named = tuple((groups or {}).items())
    steps, assumed, in_words = tuple(shown.values()), tuple(run.assumed), tuple(run.in_words)
    keys_seen = tuple(tuple(quantity.key for quantity in part) for part in seen)
    return Derivation(steps, tuple(parts), unshown, assumed, named, in_words, checked, keys_seen)


# --- JSON ------------------------------------------------------------------------------------------------------------


_RECORDS = (Derivation, Step, Form, Level, Manner, Display, Theorem, Evidence, Compared, Grade)
_CLASSES = {each.__name__: each for each in _RECORDS}


def to_json(derivation: Derivation) -> str:
    return json.dumps(as_data(derivation, _CLASSES))


def from_json(text: str) -> Derivation:
    """Return the derivation that `to_json` wrote; raise `ValueError`, `KeyError` or `TypeError` for any other text."""
    found = from_data(json.loads(text), _CLASSES)
    if not isinstance(found, Derivation):
        raise ValueError("this is not a derivation")
    return found
