"""Answers by name, for parts and for results.

A name may be

- the name of an answer that the description offers, in the singular or in the plural;
- such a name with a number, for one of the steps of the answer;
- the name of a result;
- the key of a step on which an answer or a result depends.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from difflib import SequenceMatcher
from functools import partial
from typing import Any

from derive.course.stock import each, told_at
from derive.course.yaml_tree import Word
from derive.errors import DeriveError, OutOfTime, Place, Rejected, did_you_mean, nearest, rejected
from derive.mechanics import Coordinate
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.record import Run, current_run, recorded
from derive.steps.step import Quantity
from derive.stock.keys.results import Result

DIGITS = "0123456789"
IRREGULAR = {"equilibrium": "equilibria", "momentum": "momenta", "axis": "axes"}
_NUMBERED = re.compile(r"(\w+)_([1-9]\d?)")
_ALIKE = 0.85  # a name with more than this similarity to an offered name is a misspelling of that name


class ByName:
    """The answers of one description, including results computed from answers.

    asks          every name that the description offers, with the function that derives its steps
    what          the kind of description: "a rotation"
    results       the entries of `results:`, which are computed from answers
    coordinates   the coordinates that results may use
    again         a function that makes another object of this class for the same description, without derived steps
    elsewhere     a function that derives an answer of a body about another point or axis
    surfaces      the surfaces of a system, by name
    """

    def __init__(
        self,
        asks: Mapping[str, Callable[[], Any]],
        what: str = "",
        results: Sequence[Result] = (),
        coordinates: Mapping[str, Coordinate] | None = None,
        again: Callable[[], ByName] | None = None,
        elsewhere: Callable[[Result], Quantity] | None = None,
        surfaces: Mapping[str, Any] | None = None,
    ):
        self.asks, self.what, self.again = dict(asks), what, again
        self.results = {str(result.name): result for result in results}
        self._known: dict[str, tuple[Quantity, ...]] = {}
        self._in_progress: list[str] = []
        self._sought: frozenset[str] = frozenset()
        each([partial(self._check_free, result.name) for result in results])
        given = (self.named, coordinates or {}, elsewhere, surfaces)
        self.asks |= {name: partial(one.made, *given) for name, one in self.results.items()}

    def answers(self, asked: Sequence[Word]) -> dict[str, object]:
        offered_first = sorted(asked, key=lambda name: self.offered(name) is None)
        try:
            found = dict(each([partial(self._answer, name) for name in offered_first]))
        except Rejected as refused:  # several answers may have the same error, which is reported once
            first = {(c.code, c.message): c for c in reversed(refused.complaints)}
            raise Rejected([c for c in refused.complaints if c is first[c.code, c.message]]) from None
        each([partial(self._check_own_key, result) for result in self.results.values()])
        return found

    def _answer(self, name: Word) -> tuple[str, object]:
        return str(name), self.named(name)

    def named(self, name: Word) -> tuple[Quantity, ...]:
        """Return the steps that a name denotes."""
        own = self.offered(name)
        if own is not None:
            return self._derived(own, name.place)
        found = self._by_number(name) or _called(name, self._there())
        if found:
            return found
        leading = self._leading_to(name)
        if leading is not None:
            return _called(name, with_ancestors(self._derived(leading, name.place)))
        for own in (own for own in self.asks if name.startswith(f"{own}_")):
            self._derived(own, name.place)  # raises the error if `own` cannot be derived
        help_line = did_you_mean(name, (*self.asks, *self._there())) or f"you may ask for {', '.join(self.asks)}"
        message = (
            f"{self.what} has no answer called `{name}`" if self.what else f"`{name}` is not the name of an answer"
        )
        rejected("no-such-answer", message, name.place, help_line)

    def offered(self, name: str) -> str | None:
        """Return the offered form of a name, singular or plural (`frequency` for `frequencies`), or None."""
        return next((form for form in (name, *_in_other_number(name)) if form in self.asks), None)

    def every(self) -> dict[str, tuple[Quantity, ...] | DeriveError]:
        """Return, for each offered name, its steps, or the error if they cannot be derived."""
        found: dict[str, tuple[Quantity, ...] | DeriveError] = {}
        for name in self.asks:
            try:
                found[name] = self._derived_alone(name)
            except DeriveError as error:
                found[name] = error
        return found

    def _derived_alone(self, name: str) -> tuple[Quantity, ...]:
        """Derive the answer that a name denotes; after an error, try again with an empty record."""
        try:
            return self._derived(name, None)
        except DeriveError:
            if self.again is None:
                raise
            with recorded(self._copied_run()):
                return self.again()._derived(name, None)

    def _copied_run(self) -> Run:
        """Return a record without steps for the same problem."""
        run = current_run.get() or Run()
        memory = run.memory and run.memory.of_another_run()
        return Run(
            assumed=[*run.assumed], in_words=[*run.in_words], numbers=run.numbers, letters=run.letters, memory=memory
        )

    def _derived(self, name: str, place: Place | None) -> tuple[Quantity, ...]:
        if name in self._in_progress:
            rejected("circle", f"`{name}` is computed from itself", place)
        if name not in self._known:
            self._in_progress.append(name)
            try:
                with told_at(place):
                    self._known[name] = tuple(returned_quantities(self.asks[name]()))
            except OutOfTime as late:
                late.answers.append(name)
                raise
            finally:
                self._in_progress.pop()
        return self._known[name]

    def _by_number(self, name: Word) -> tuple[Quantity, ...]:
        """Return the step that a name such as `frequency_2` denotes."""
        numbered = _NUMBERED.fullmatch(name)
        own = self.offered(numbered[1]) if numbered else None
        if numbered is None or own is None:
            return ()
        one = self._one_of(own, name, self._derived(own, name.place))
        return (one,) if one is not None else ()

    def one(self, several: str, name: str, place: Place | None = None) -> Quantity:
        """Return the step called `name` among the steps of the answer `several`; reject any other name."""
        steps = self._derived(several, place)
        found = self._one_of(several, name, steps)
        if found is None:
            keys = [q.key for q in steps]
            help_line = did_you_mean(name, keys) or f"these are {', '.join(f'`{key}`' for key in keys)}"
            rejected("no-such-answer", f"`{name}` is not one of `{several}`", place, help_line)
        return found

    def _one_of(self, own: str, name: str, found: Sequence[Quantity]) -> Quantity | None:
        """Return the step of the answer `own` that `name` denotes; None if the answer has no such step."""
        by_key = _called(name, {q.key: q for q in found})
        if len(by_key) == 1:
            return by_key[0]
        numbered = _NUMBERED.fullmatch(name)
        is_own = numbered is not None and self.offered(numbered[1]) == own
        return found[n - 1] if numbered and is_own and (n := int(numbered[2])) <= len(found) else None

    def _there(self) -> dict[str, Quantity]:
        """Return all steps derived so far, by key."""
        run = current_run.get()
        known = with_ancestors(q for quantities in self._known.values() for q in quantities)
        return {**{q.key: q for q in (run.established if run is not None else ())}, **known}

    def _leading_to(self, name: Word) -> str | None:
        """Return an offered name whose answer depends on a step with the key `name`, or None.

        The search uses a separate record, so that it has no effect on the answers.
        """
        if self.again is None or name in self._sought:
            return None
        with recorded(self._copied_run()):
            there = self.again()
            there._sought = self._sought | {str(name)}
            for likely in (True, False):
                for own in there._in_order(name, likely):
                    with suppress(DeriveError):
                        if _called(name, with_ancestors(there._derived(own, name.place))):
                            return own
                if likely and _is_slip(name, self.asks):
                    return None
        return None

    def _in_order(self, name: str, likely: bool) -> Iterator[str]:
        for own in self.asks:
            begins = name.startswith(f"{own}_") or own in ("lagrangian", "equations_of_motion")
            if begins == likely:
                yield own

    def _check_free(self, name: Word) -> None:
        own = self.offered(name)
        if own is not None:
            as_one = "" if own == name else f", as `{own}`"
            message = f"`{name}` is already the name of an answer{as_one}, so a result cannot have this name"
            rejected("name-clash", message, name.place, "give the result another name")

    def _check_own_key(self, result: Result) -> None:
        run = current_run.get()
        if run is None or result.name not in self._known:
            return
        own = [q.step for q in self._known[result.name]]
        if any(q.key == result.name and q.step not in own for q in run.established):
            message = f"`{result.name}` is already the key of a step, so a result cannot have this name"
            rejected("name-clash", message, result.name.place, "give the result another name")


def _called(name: str, steps: Mapping[str, Quantity]) -> tuple[Quantity, ...]:
    """Return the step with this key, or the steps whose keys are this name with a number, such as `rest_2`.

    The name may be in the singular or the plural, and `rest_1` may denote a single step `rest`.
    """
    if name in steps:
        return (steps[name],)
    for form in (name, *_in_other_number(name)):
        found = tuple(q for key, q in steps.items() if key.rstrip(DIGITS) == f"{form}_")
        if found or form in steps:
            return found or (steps[form],)
    alone = name.removesuffix("_1")
    return (steps[alone],) if alone != name and alone in steps and f"{alone}_2" not in steps else ()


def _in_other_number(name: str) -> Iterator[str]:
    """Yield the name with its last or its first word changed between singular and plural."""
    words = name.split("_")
    for i in dict.fromkeys((len(words) - 1, 0)):
        for other in _others(words[i]):
            yield "_".join([*words[:i], other, *words[i + 1 :]])


def _others(word: str) -> Iterator[str]:
    both = {**IRREGULAR, **{many: one for one, many in IRREGULAR.items()}}
    if word in both:
        yield both[word]
    elif word.endswith("ies"):
        yield f"{word[:-3]}y"
    elif word.endswith("s"):
        yield word[:-1]
    else:
        yield f"{word[:-1]}ies" if word.endswith("y") else f"{word}s"


def _is_slip(name: str, names: Mapping[str, object]) -> bool:
    close = nearest(name, names)
    return close is not None and SequenceMatcher(None, name, close).ratio() > _ALIKE
