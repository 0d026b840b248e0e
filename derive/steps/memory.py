"""Reuse the results of earlier calls of verbs, with everything that these calls added to the record.

A call is recalled if the following are the same as in a stored call:

- the verb and its arguments;
- the coordinates, assumptions, ranges and positive expressions that are known before the call;
- the answers to the questions that the call asks the record.

Arguments are identified by digests of their content. A call with an argument that cannot be described as data, such as
a function of a script, is not stored.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any, Protocol

from derive.algebra.ranges import known_ranges, take_as_positive, taken_as_positive
from derive.errors import OutOfTime
from derive.steps.objects import NoDescription, Objects
from derive.steps.record import QUESTIONS, Call, Run, add, assume, finished_steps


class Store(Protocol):
    """The store that keeps the texts of calls."""

    def get(self, key: str) -> str | None: ...

    def keep(self, key: str, text: str) -> None: ...


@dataclass(frozen=True)
class _Asked:
    """The data with which a call is looked up.

    key      a digest of the call
    objects  the names of the objects that the call contains
    found    those cached properties of these objects that contain steps
    """

    key: str
    objects: list[str]
    found: list[Any]


@dataclass(frozen=True)
class _State:
    established: int
    assumed: int
    in_words: int
    positive: int

    @classmethod
    def of(cls, run: Run) -> _State:
        return cls(len(run.established), len(run.assumed), len(run.in_words), len(taken_as_positive()))


@dataclass
class Memory:
    """The calls of verbs in one run: the store of earlier calls, and the objects in the arguments and results."""

    store: Store
    objects: Objects = field(default_factory=Objects)
    made: set[str] = field(default_factory=set)

    def of_another_run(self) -> Memory:
        """Return a new memory with the same store of calls and no objects yet."""
        return Memory(self.store)

    def result(self, verb: Callable[..., Any], given: Mapping[str, Any], run: Run, make: Callable[[], Any]) -> Any:
        """Return the result of a call: read from the store if possible, otherwise computed now."""
        if run.call is not None:
            return make()
        run.call = Call(len(run.established))
        try:
            return self._result(verb, given, run, make)
        except OutOfTime as late:
            late.finished = finished_steps(run)  # without the steps of this call, which are not stored
            raise
        finally:
            run.call = None

    def _result(self, verb: Callable[..., Any], given: Mapping[str, Any], run: Run, make: Callable[[], Any]) -> Any:
        asked = self._asked(verb, given, run)
        if asked is None or asked.key in self.made:  # a second call with equal arguments makes its own objects
            return make()
        self.made.add(asked.key)
        left = self._recalled(asked.key)
        if left is not None:
            return self._put_on_record(left, run)
        before = _State.of(run)
        result = make()
        if len(run.established) > before.established:  # repeating a call without steps is faster than reading it
            with suppress(NoDescription, RecursionError):
                self.store.keep(asked.key, self._left(result, asked, before, run))
        return result

    def _asked(self, verb: Callable[..., Any], given: Mapping[str, Any], run: Run) -> _Asked | None:
        known = (run.coordinates, run.assumed, run.in_words, tuple(known_ranges().items()), taken_as_positive())
        try:
            told, objects = self.objects.described((verb, dict(given), *known))
            found = [self._data(each) for each in self.objects.found_once(self.objects.below(objects))]
            text = json.dumps([told, found])
        except (NoDescription, RecursionError):
            return None
        return _Asked(sha256(text.encode()).hexdigest(), objects, found)

    def _left(self, result: Any, asked: _Asked, before: _State, run: Run) -> str:
        """Return a text with the questions of a call, its result, and its additions to the record."""
        assert run.call is not None
        steps = tuple(zip(run.established, run.cases, strict=True))[before.established :]
        conditions = tuple((each, each in run.in_words[before.in_words :]) for each in run.assumed[before.assumed :])
        left = (tuple(run.call.asked), steps, conditions, taken_as_positive()[before.positive :], result)
        data, objects = self.objects.described(left)
        known = self.objects.below(asked.objects)
        now = self.objects.found_once({**known, **self.objects.below(objects)})
        found = tuple(each for each in now if self._data(each) not in asked.found)
        data_found, objects_found = self.objects.described(found)
        made = [each for each in self.objects.below([*objects, *objects_found]) if each not in known]
        lines = [f"{name}\t{text}" for name, text in self.objects.texts(made)]
        return "\n".join([*lines, json.dumps([data, data_found])])

    def _recalled(self, key: str) -> tuple[Any, ...] | None:
        """Read the result of a call, and its additions to the record, from the store; None if this is not possible."""
        kept = self.store.get(key)
        if kept is None:
            return None
        try:
            *lines, last = kept.split("\n")
            for line in lines:
                self.objects.enter(*line.split("\t"))
            (questions, *left), found = map(self.objects.read, json.loads(last))
            same = all(self._data(QUESTIONS[name](*about)) == self._data(answer) for name, about, answer in questions)
        except (NoDescription, LookupError, TypeError, ValueError, RecursionError):  # damaged, or of another version
            return None
        return (*left, found) if same else None

    def _data(self, value: Any) -> Any:
        return self.objects.described(value)[0]

    def _put_on_record(self, left: tuple[Any, ...], run: Run) -> Any:
        steps, conditions, positive, result, found = left
        for quantity, case_of in steps:
            add(quantity, case_of)
        for condition, in_words in conditions:
            assume(condition, in_words)
        for each in positive:
            take_as_positive(each)
        for name, key, value in found:
            self.objects.put_found(name, key, value)
        return result
