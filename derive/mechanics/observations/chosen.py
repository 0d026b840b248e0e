"""The table of observations, in the order of their value, and the choice of those that a page prints."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from derive.mechanics.observations.frequencies import exact, modes, one_frequency, orbit, pendulum
from derive.mechanics.observations.view import View
from derive.steps.step import Quantity

MOST = 2  # observations of a problem, unless the author chooses


@dataclass(frozen=True)
class Observation:
    """A kind of observation.

    name    the name by which an author chooses it
    found   yields the steps of this kind about the answers of a part
    at_end  whether the last part with such a step states it, instead of the first part
    """

    name: str
    found: Callable[[View], Iterator[Quantity]]
    at_end: bool = False


OBSERVATIONS = (
    Observation("orbit", orbit),
    Observation("exact", exact, at_end=True),
    Observation("pendulum", pendulum),
    Observation("modes", modes),
    Observation("one_frequency", one_frequency),
)
NAMES = tuple(each.name for each in OBSERVATIONS)


def best(views: Sequence[View], most: int = MOST) -> list[list[Quantity]]:
    """Return the observations of each part: at most `most` in all, at most one of each kind."""
    found: list[list[Quantity]] = [[] for _ in views]
    for kind in OBSERVATIONS:
        places = range(len(views))
        first = next(((i, q) for i in (reversed(places) if kind.at_end else places) for q in kind.found(views[i])), None)
        if first is not None:
            found[first[0]].append(first[1])
        if sum(map(len, found)) == most:
            break
    return found


def of_kinds(view: View, names: Collection[str]) -> dict[str, list[Quantity]]:
    """Return every observation of these kinds about the answers of a part."""
    return {kind.name: list(kind.found(view)) for kind in OBSERVATIONS if kind.name in names}
