"""Answers by their names, each derived when it is first asked for, for parts and for what is made of answers.

A name is one of those that a description offers, in the singular or in the plural; one of its steps, by its number; the
name of a result; or the key of any step that one of these rests on, whichever was asked for before.
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
_ALIKE = 0.85  # from here on a name is taken for a slip of the pen, and is not looked for among all steps


class ByName:
    """The answers of one description; what is made of answers is itself one.

    asks          every name that it offers
    what          what the description is of: "a rotation"
    results       what is made of answers
    coordinates   those that results are about
    again         makes the same answers from the start, with nothing derived
    elsewhere     the answer of a result about another point or axis than the one given
    """

    def __init__(
        self,
        asks: Mapping[str, Callable[[], Any]],
        what: str = "",
        results: Sequence[Result] = (),
        coordinates: Mapping[str, Coordinate] | None = None,
        again: Callable[[], ByName] | None = None,
        elsewhere: Callable[[Result], Quantity] | None = None,
    ):
        self.asks, self.what, self.again = dict(asks), what, again
        self.results = {str(result.name): result for result in results}
        self._known: dict[str, tuple[Quantity, ...]] = {}
        self._in_progress: list[str] = []
        self._sought: frozenset[str] = frozenset()
        each([partial(self._check_free, result.name) for result in results])
        given = (self.named, coordinates or {}, elsewhere)
        self.asks |= {name: partial(one.made, *given) for name, one in self.results.items()}

    def answers(self, asked: Sequence[Word]) -> dict[str, object]:
        """Each answer that a part asks for; what is refused is refused where it is asked for, and all of it."""
        offered_first = sorted(asked, key=lambda name: self.offered(name) is None)
        try:
            found = dict(each([partial(self._answer, name) for name in offered_first]))
        except Rejected as refused:  # what several answers rest on is told once
            first = {(c.code, c.message): c for c in reversed(refused.complaints)}
            raise Rejected([c for c in refused.complaints if c is first[c.code, c.message]]) from None
        each([partial(self._check_own_key, result) for result in self.results.values()])
        return found

    def _answer(self, name: Word) -> tuple[str, object]:
        return str(name), self.named(name)

    def named(self, name: Word) -> tuple[Quantity, ...]:
        """The steps of a name."""
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
            self._derived(own, name.place)  # or why it cannot be derived
        help_line = did_you_mean(name, (*self.asks, *self._there())) or f"one may ask for {', '.join(self.asks)}"
        message = f"{self.what} has no answer called `{name}`" if self.what else f"there is no answer `{name}`"
        rejected("no-such-answer", message, name.place, help_line)

    def offered(self, name: str) -> str | None:
        """The name under which it is offered: its own, or that in the other number, `frequencies`."""
        return next((form for form in (name, *_in_other_number(name)) if form in self.asks), None)

    def every(self) -> dict[str, tuple[Quantity, ...] | DeriveError]:
        """All that there is under the names that are offered; of a result also why it cannot be derived."""
        found: dict[str, tuple[Quantity, ...] | DeriveError] = {}
        for name in self.asks:
            try:
                found[name] = self._derived_alone(name)
            except DeriveError as error:
                if name in self.results:
                    found[name] = error
        return found

    def _derived_alone(self, name: str) -> tuple[Quantity, ...]:
        """With nothing else on the record whose letter it might need, unless it goes with what is there."""
        try:
            return self._derived(name, None)
        except DeriveError:
            if self.again is None:
                raise
            with recorded(self._copied_run()):
                return self.again()._derived(name, None)

    def _copied_run(self) -> Run:
        """A record on which nothing is established, for the same problem."""
        run = current_run.get() or Run()
        return Run(assumed=[*run.assumed], in_words=[*run.in_words], numbers=run.numbers, letters=run.letters)

    def _derived(self, name: str, place: Place | None) -> tuple[Quantity, ...]:
        if name in self._in_progress:
            rejected("circle", f"`{name}` is made of itself", place)
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
        """Of `frequency_2` the step of that key, or the second of what `frequency` yields."""
        numbered = _NUMBERED.fullmatch(name)
        own = self.offered(numbered[1]) if numbered else None
        if numbered is None or own is None:
            return ()
        one = self.one_of(own, name, self._derived(own, name.place))
        return (one,) if one is not None else ()

    def one_of(self, own: str, name: str, found: Sequence[Quantity]) -> Quantity | None:
        """Of the steps that a name yields that of another name: by its key, or by its number after that name."""
        by_key = _called(name, {q.key: q for q in found})
        if len(by_key) == 1:
            return by_key[0]
        numbered = _NUMBERED.fullmatch(name)
        is_own = numbered is not None and self.offered(numbered[1]) == own
        return found[n - 1] if numbered and is_own and (n := int(numbered[2])) <= len(found) else None

    def _there(self) -> dict[str, Quantity]:
        """The steps by key that answers have led to."""
        run = current_run.get()
        known = with_ancestors(q for quantities in self._known.values() for q in quantities)
        return {**{q.key: q for q in (run.established if run is not None else ())}, **known}

    def _leading_to(self, name: Word) -> str | None:
        """The first of all names offered that rests on a step of that key: found apart from what the page rests on, so
        that neither the order of parts nor what was asked for before has a say in it."""
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
        """The names offered: those that begin as it does and what most steps come of, or all others."""
        for own in self.asks:
            begins = name.startswith(f"{own}_") or own in ("lagrangian", "equations_of_motion")
            if begins == likely:
                yield own

    def _check_free(self, name: Word) -> None:
        """A result has a name of its own."""
        own = self.offered(name)
        if own is not None:
            as_one = "" if own == name else f", as `{own}`"
            message = f"`{name}` is the name of an answer already{as_one}, so no result can be called so"
            rejected("name-clash", message, name.place, "give the result another name")

    def _check_own_key(self, result: Result) -> None:
        """No step but its own has the name of a result."""
        run = current_run.get()
        if run is None or result.name not in self._known:
            return
        own = [q.step for q in self._known[result.name]]
        if any(q.key == result.name and q.step not in own for q in run.established):
            message = f"`{result.name}` is the key of a step already, so no result can be called so"
            rejected("name-clash", message, result.name.place, "give the result another name")


def _called(name: str, steps: Mapping[str, Quantity]) -> tuple[Quantity, ...]:
    """The step of that key; else all that have it with a number; `rest_1` is also a single `rest`."""
    if name in steps:
        return (steps[name],)
    for form in (name, *_in_other_number(name)):
        found = tuple(q for key, q in steps.items() if key.rstrip(DIGITS) == f"{form}_")
        if found or form in steps:
            return found or (steps[form],)
    alone = name.removesuffix("_1")
    return (steps[alone],) if alone != name and alone in steps and f"{alone}_2" not in steps else ()


def _in_other_number(name: str) -> Iterator[str]:
    """The same name with its first or its last word in the plural where it is in the singular, and the other way."""
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
