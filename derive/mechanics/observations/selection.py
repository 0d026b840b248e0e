"""The kinds of observations, the most instructive first, and the choice of the observations that a page prints."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass

from derive.errors import Rejected, Unverified
from derive.mechanics.observations.comparisons import (
    circling,
    familiar,
    multiple,
    order,
    polhode,
    reduced,
    unaffected,
)
from derive.mechanics.observations.dependence import (
    angle,
    anywhere,
    balanced,
    below,
    branches,
    flat,
    independent,
    one_sign,
    resonance,
    zero_of,
)
from derive.mechanics.observations.frequencies import exact, longer, modes, one_frequency, orbit, pair, pendulum
from derive.mechanics.observations.view import Observed, View
from derive.steps.step import Quantity

Steps = list[Quantity]
MOST = 2  # greatest number of observations in a problem, if the author does not choose them


@dataclass(frozen=True)
class Observation:
    """A kind of observation.

    name    the name by which an author chooses this kind
    found   a function that yields the steps of this kind about the answers of a part
    at_end  whether the default choice, among several parts with such an observation, is the last part, not the first
    """

    name: str
    found: Callable[[View], Observed]
    at_end: bool = False


OBSERVATIONS = (
    Observation("orbit", orbit),
    Observation("exact", exact, at_end=True),
    Observation("branches", branches),
    Observation("anywhere", anywhere),
    Observation("one_sign", one_sign),
    Observation("balanced", balanced),
    Observation("order", order),
    Observation("reduced", reduced),
    Observation("polhode", polhode),
    Observation("circling", circling),
    Observation("angle", angle),
    Observation("below", below),
    Observation("pendulum", pendulum),
    Observation("pair", pair),
    Observation("longer", longer),
    Observation("resonance", resonance),
    Observation("unaffected", unaffected),
    Observation("familiar", familiar),
    Observation("independent", independent, at_end=True),
    Observation("multiple", multiple),
    Observation("one_frequency", one_frequency),
    Observation("flat", flat),
    Observation("modes", modes),
    Observation("zero", zero_of),
)
NAMES = tuple(each.name for each in OBSERVATIONS)


def best(views: Sequence[View], most: int = MOST) -> list[Steps]:
    """Return the observations of each part: at most `most` in all, at most one of each kind."""
    found: list[Steps] = [[] for _ in views]
    for kind in OBSERVATIONS:
        places = range(len(views))
        tried = reversed(places) if kind.at_end else places
        first = next(((i, q) for i in tried for q in confirmed(kind, views[i])), None)
        if first is not None:
            found[first[0]].append(first[1])
        if sum(map(len, found)) == most:
            break
    return found


def confirmed(kind: Observation, view: View) -> Observed:
    """Yield the observations of a kind; stop at the first observation that fails its predicate or its check."""
    with suppress(Unverified, Rejected):
        yield from kind.found(view)


def of_kinds(view: View, names: Collection[str]) -> dict[str, Steps]:
    """Return, for each of these kinds, every observation about the answers of a part."""
    return {kind.name: list(kind.found(view)) for kind in OBSERVATIONS if kind.name in names}
